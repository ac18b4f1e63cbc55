/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* validate.c: what SPH_VALIDATE asks after a sort and before a tile is worked off (checks.h), and what it does to
   memory that nobody may read before it was written. No array: ids are marked in the scratch of thread 0, as many at a
   time as it has bits. */
#include "sweep.h"
#include "arithmetic.h"

SPH_OBJECT(validate)

/* every index of the source buffer stands at most once in buffer dst */
static bool each_once(const sph_sim *sim)
{
    unsigned char *const seen = (unsigned char *)sim->thread[0].sum;
    const uint32_t *const from = sph_source_index(sim);
    const uint32_t bits = (uint32_t)sizeof sim->thread[0].sum * 8;
    bool once = true;
    for (uint32_t first = 0; once && first < sim->src_count; first += bits) {
        memset(seen, 0, sizeof sim->thread[0].sum);
        for (uint32_t i = 0; once && i < sim->next.count; i++) {
            const uint32_t at = from[i] - first;
            once = from[i] < sim->src_count && (at >= bits || !(seen[at / 8] >> at % 8 & 1));
            if (at < bits)
                seen[at / 8] = (unsigned char)(seen[at / 8] | 1u << at % 8);
        }
    }
    return once;
}

/* where a slab begins, from its first particle's cell on */
static uint32_t slab_start(const sph_sim *sim, uint32_t slab)
{
    const uint32_t c = sph_skip(sim, slab * sim->grid.slab_cells, sim->grid.cells, SPH_PEOPLED);
    return c < sim->grid.cells ? sim->cell[c] : sim->next.count;
}

bool sph_is_sorted(const sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    bool fine = sim->cell[0] == 0 && sim->cell[sim->grid.cells] == sim->next.count && each_once(sim);
    uint32_t before = 0;
    for (uint32_t c = 0; fine && c < sim->grid.cells; c++) {
        c = sph_skip(sim, c, sim->grid.cells, SPH_PEOPLED);
        if (c == sim->grid.cells)
            break;
        fine = sim->cell[c] == before;
        before = sim->cell[c + 1];
        for (uint32_t i = sim->cell[c]; fine && i < sim->cell[c + 1]; i++) {
            sph_pos q[SPH_DIM];
            for (uint32_t k = 0; k < SPH_DIM; k++) {
                q[k] = b->pos[k][i];
                fine &= q[k] >= 0 && q[k] < sim->grid.extent[k];
            }
            fine = fine && sph_cell_of(sim, q) == c;
            fine &= i == sim->cell[c] || sph_source_id(sim, i - 1) < sph_source_id(sim, i);
        }
    }
    for (uint32_t s = 0; fine && s <= sim->grid.slabs; s++) /* by them the next sort finds its way */
        fine = slab_start(sim, s) == sim->cell[s * sim->grid.slab_cells];
    return fine && before == sim->next.count;
}

bool sph_is_tile_sound(const sph_tile *t)
{
    bool fine = t->n <= SPH_TILE;
    for (uint32_t j = 0; j < t->n; j++) {
        sph_real sum = t->m[j];
        for (uint32_t k = 0; k < SPH_DIM; k++)
            sum += t->x[k][j];
        fine &= sum - sum == 0 && t->m[j] > 0;
    }
    return fine;
}

/* ---- poison ---- */

/* Every byte: reals that are not numbers in one arena, huge ones in the next (by its address), so that two runs of a
   scene which read them, in arenas side by side, differ. */
static int poison_of(const sph_sim *sim) { return (uintptr_t)sim / SPH_ALIGN % 2 ? 0x7e : 0xff; }

/* what a scene keeps longer than a stage is in arrays of other types than sph_real and double (arrays.h) */
static bool of_a_stage(const char *type) { return type[0] == 'd' || (type[0] == 's' && type[4] == 'r'); }

static void fill(void *array, int poison, bool wanted, size_t bytes)
{
    if (array && wanted)
        memset(array, poison, bytes);
}

bool sph_poison_stage(sph_sim *sim)
{
    const sph_config *c = &sim->cfg;
    const int poison = poison_of(sim);
    for (const sph_field *f = sph_fields; f < sph_fields + SPH_FIELD_COUNT; f++)
        for (uint32_t k = 0; k < f->comps; k++)
            fill(sph_array(&sim->buf[sim->dst], f->at + k), poison, true, SPH_ROOM(c) * f->bytes);
    fill(sim->cell, poison, true, ((size_t)sim->grid.cells + 1) * sizeof *sim->cell);
#define extra_reals(c, at) sim->extra_reals
#define ONE(name, type, count, when, what) fill(sim->name, poison, of_a_stage(#type), (size_t)(count) * sizeof(type));
#define MANY(name, type, components, count, when, what)                                                            \
    for (uint32_t k = 0; k < (components); k++)                                                                    \
        fill(sim->name[k], poison, of_a_stage(#type), (size_t)(count) * sizeof(type));
    const sph_grid *const g = &sim->grid;
    SPH_SCENE_ARRAYS(ONE, MANY)
#undef ONE
#undef MANY
#undef extra_reals
    (void)g;
    return true;
}

bool sph_poison_thread(const sph_sim *sim, sph_thread *t)
{
    memset(t, poison_of(sim), offsetof(sph_thread, work));
    memset(sim->extra + (size_t)(t - sim->thread) * sim->extra_reals, poison_of(sim),
           sim->extra_reals * sizeof *sim->extra);
    return true;
}
