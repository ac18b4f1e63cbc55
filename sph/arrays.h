/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* arrays.h: the one list of what a scene keeps in its arena beside the state of its particles (fields.h): the members
   of the simulation that point to it, the layout of the arena and sph_arena_report follow from it.

   A line: ONE(name, type, count, when, what), or MANY(name, type, components, count, when, what) for that many arrays;
   count and condition are of the configuration `c` and its grid `g`. A module that the scene did not choose has no
   array. Arrays of sph_real and double are scratch of a stage: nothing in them is read before it was written
   (validate.c looks); what is kept for longer has another type. */
#ifndef SPH_ARRAYS_H
#define SPH_ARRAYS_H

#define SPH_SCENE_ARRAYS(ONE, MANY)                                                                                   \
    ONE(set, sph_set, c->max_sets, true, "sets")                                                                      \
    ONE(group, sph_group, SPH_MAX_GROUPS, true, "wall groups")                                                        \
    ONE(thread, struct sph_thread, c->max_threads, true, "thread scratch")                                            \
    ONE(material, sph_material, c->max_sets, sph_has_solids(c), "materials")                                          \
    ONE(extra, sph_real, (size_t)c->max_threads * extra_reals(c, NULL), true, "thread scratch of columns")        \
    ONE(cell, uint32_t, (size_t)g->cells + 2, true, "cell starts") /* cells + 1 of them are used */                   \
    ONE(strip, uint8_t, (size_t)g->cells / SPH_STRIP + 9, SPH_STRIPS, "strips of cells") /* SPH_PEOPLED ... */ \
    ONE(slab, uint32_t, (size_t)g->slabs + 1, true, "slab starts") /* in the source buffer */                         \
    ONE(turned, uint8_t, SPH_ROOM(c), sph_has_any_mirrors(c), "turned by mirrors") /* by source index */              \
    ONE(tmp, sph_real, SPH_ROOM(c), sph_filters(c) || sph_sums_density(c), "filtered density")                        \
    MANY(corr, sph_real, SPH_NL, SPH_ROOM(c), sph_corrects(c), "gradient correction") /* M^-1, destination buffer */  \
    MANY(row, sph_real, SPH_DIM, SPH_ROOM(c), sph_stabilises(c), "stabilised: means over rows")                       \
    MANY(drawn, sph_real, SPH_DIM + 1, SPH_ROOM(c), sph_stabilises(c), "stabilised: means over columns") /* level */  \
    MANY(tension, sph_real, SPH_DIM, SPH_ROOM(c), sph_stabilises(c), "stabilised: axes in tension") /* 1 or 0 */      \
    MANY(normal, sph_real, SPH_NL + SPH_DIM, SPH_ROOM(c), sph_normalises(c), "normalised kernels")                    \
    MANY(deform, sph_real, SPH_NL + 1, SPH_ROOM(c), sph_resists_hourglass(c), "deformation gradients")                \
    MANY(gradient, sph_real, SPH_NT, SPH_ROOM(c), sph_corrects_fluids(c), "gradient correction of fluids")            \
    MANY(density_gradient, sph_real, SPH_DIM, SPH_ROOM(c), sph_takes_density_gradient(c), "gradient of density")      \
    MANY(shear, sph_real, SPH_NL + 1, SPH_ROOM(c), sph_shears(c), "viscous stress of fluids")                         \
    /* by id: a particle's flaws are flaw[flaw_start[id] .. flaw_start[id + 1]) */                                    \
    ONE(flaw_start, uint32_t, (size_t)c->max_particles + 1, sph_damages(c), "flaws of a particle")                    \
    ONE(flaw, float, c->max_flaws, sph_damages(c), "flaws") /* thresholds */                                          \
    /* POWER_... of a particle, per unit mass */                                                                      \
    MANY(power, sph_real, SPH_POWERS, SPH_ROOM(c), sph_keeps_books(c), "powers for the books")                        \
    ONE(sponge, double, c->max_particles / SPH_LOCAL_CHUNK + 1, sph_has_sponge(c), "absorbed energy of chunks")       \
    ONE(flow, sph_flow_state, c->max_flows, sph_has_flows(c), "inflows and outflows")                                 \
    ONE(taken, uint8_t, c->max_particles, sph_has_flows(c), "ids in use") /* flow.c */                                \
    ONE(births, uint32_t, c->max_particles / SPH_LOCAL_CHUNK + 1, sph_has_flows(c), "births of chunks")               \
    MANY(disorder, sph_real, SPH_DIM + 1, SPH_ROOM(c), sph_shifts(c), "disorder") /* shifting.c */                    \
    ONE(wide, sph_real, SPH_ROOM(c), sph_varies_h(c), "smoothing lengths")                                            \
    ONE(damper_press, sph_real, SPH_ROOM(c), sph_quiets(c), "pressure of the damper")                                 \
    ONE(damper_loss, double, c->max_particles / SPH_LOCAL_CHUNK + 1, sph_quiets(c), "energy of the damper, of chunks") \
    ONE(slowing, double, c->max_particles / SPH_LOCAL_CHUNK + 1, sph_slows(c), "energy of damping, of chunks")       \
    ONE(evening, double, c->max_particles / SPH_LOCAL_CHUNK + 1, sph_evens(c), "energy of evening, of chunks")       \
    ONE(shifted, double, c->max_particles / SPH_LOCAL_CHUNK + 1, sph_shifts(c), "energy of shifting, of chunks")     \
    /* by id */                                                                                                       \
    ONE(edge_mark, sph_edge_mark, c->max_particles, sph_has_edges(c), "marks of edges")                               \
    ONE(edge_place, uint32_t, c->max_particles, sph_has_edges(c), "places by id, of edges")                           \
    ONE(edge_line, sph_edge_line, c->max_particles, sph_has_edges(c), "lines of edges")                               \
    MANY(layer, sph_real, SPH_NL, SPH_ROOM(c), sph_is_matched(c), "stress of the matched layer")                      \
    ONE(absorbing, sph_real, SPH_ROOM(c), sph_has_edges(c), "power that edges take")                                  \
    ONE(let_out, double, c->max_particles / SPH_LOCAL_CHUNK + 1, sph_has_edges(c), "absorbed energy, of chunks")      \
    /* SPH_PARTIALS of each chunk */                                                                                  \
    ONE(partial, double, (size_t)SPH_PARTIALS * (c->max_particles / SPH_LOCAL_CHUNK + 1), sph_keeps_books(c),         \
        "partial sums for the books")

/* elements of an array with one for each particle */
#define SPH_ROOM(c) ((size_t)(c)->max_particles + SPH_PAD)

#endif
