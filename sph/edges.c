/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* edges.c: edges of solids that elastic waves leave through. The search for them, and what particles are told of it, is
   in outline.c. Kick-drift-kick only; n: outward normal, L = grad v, c_p and c_s: speeds of P and S waves.

   P, M, H replace the acceleration in the outermost layers, with L of the step's end:
     P  dv/dt = -c_p (Ln.n) n - c_s (Ln - (Ln.n) n) + L v                  (Powell 2012 eqs 2.42, 2.60, 2.62; 1-D: 2.69)
     M  P - (c_p - c_s) [(tr L - Ln.n) n + L^T n - (Ln.n) n]               (2.45; in the plane (Lt.t) n + (Lt.n) t)
     H  P with c_p/cos a for both speeds, a between n and the line from a source: exact for P waves from there (2.33)
   as printed: M with (c_p - c_s) [(Lt.n) n - (Lt.t) t] added, t = (n_y, -n_x); H with c_p cos a, c_s cos a.

   Natural, viscous: a traction -rho c_p v.n, -rho c_s v.t that answers the velocity at the edge (2.75; Lysmer &
   Kuhlemeyer 1969). Natural: on lines of particles that go in from the edge. A uniform stress sigma pushes particle
   k of a line that ends at a free edge by -A_k sigma n/(rho dx), the sum of A being 1. So the edge's velocity that
   does the same work is s = sum A_k v_k, and dv_k/dt = -A_k (c/dx) s, of which the exact solution is
     v_k' = v_k - A_k s (1 - exp(-c dt sum A^2/dx))/sum A^2.
   It only takes energy, at any dt. Viscous: the same of the outermost particle alone. The stress that stood when the
   edges were found is held: A_k sigma_0 n/(rho dx) is added to the acceleration.

   Matched layer (Berenger 1994; complex frequency shift: Roden & Gedney 2000), before the edge, along axes: the
   equations with d/dx_a divided by s_a = 1 + d_a/(alpha + i w), d_a = 3 c_p ln(1/R)/(2 width) (1 - depth/width)^2,
   alpha a small shift without which it would creep. Multiplied by the product of all s the momentum equation has
   ordinary derivatives of a stress whose column l is multiplied by the other axes' s:
     L_ka - psi_ka for L_ka:    dpsi/dt = d_a L_ka - (alpha + d_a) psi
     sigma_kl + e_kl:           e_kl = D_l r_kl + P_l q_kl;  dr/dt = sigma - sigma_0 - alpha r;  dq/dt = r - alpha q
                                (D_l: sum of d but d_l; P_l, 3-D: the product of those)
     dv/dt = a - D (v - alpha z) - D' w - D" u;  dz/dt = v - alpha z; dw/dt = v - alpha z - alpha w; du/dt = w - alpha u
                                (D, D', D": the sum, the sum of products of two, the product of d)
   psi goes by the exact exponential over a step with L of its middle, r likewise with sigma of its ends, half a step
   ahead; z, w, u and v by the implicit midpoint rule, once a step at its end. This and the edge's exponential make a
   symmetric splitting but for half a step at a run's beginning and end (as in sponge.c): of second order.

   Arrays: edge_mark, edge_line, edge_place, layer, absorbing, let_out; fields strain_memory, stress_memory, way_memory.
   Cost: local passes; of what has a matched layer DIM + 1 exponentials a particle of the layer. */
#include "marks.h"
#include "arithmetic.h"

SPH_OBJECT(edges)

#if SPH_HAS_EDGES
/* ---- the configuration ---- */

sph_status sph_check_edges(const sph_config *c, sph_report *r)
{
    if (!sph_has_edges(c))
        return c->edge_width > 0 ? sph_refuse(r, "edge", "another than SPH_NO_EDGE with edge_width", c->edge) : SPH_OK;
    if (!sph_has_solids(c))
        return sph_refuse(r, "edge", "SPH_NO_EDGE in scenes without solids", c->edge);
    if (c->solid > SPH_TOTAL || sph_resists_hourglass(c))
        return sph_refuse(r, "edge", "SPH_NO_EDGE in stabilised, normalised forms and with hourglass control", c->edge);
    if (!SPH_IS(c->integrator, KICK_DRIFT_KICK))
        return sph_refuse(r, "integrator", "SPH_KICK_DRIFT_KICK with edges that let waves out", c->integrator);
    if (c->edge_width > 0 && c->edge > SPH_EDGE_VISCOUS)
        return sph_refuse(r, "edge_width", "0 with the edges P, M and H", c->edge_width);
    if (c->edge == SPH_EDGE_M_PRINTED && SPH_DIM != 2)
        return sph_refuse(r, "edge", "not SPH_EDGE_M_PRINTED but in 2-D", c->edge);
    return SPH_OK;
}

/* ---- P, M, H ---- */

/* a vector times the share of it along n, and the rest: p a_n n + s (a - a_n n) */
static void split(const sph_real *a, const sph_real *n, sph_real p, sph_real s, sph_real *out)
{
    sph_real along = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        along += a[k] * n[k];
    for (uint32_t k = 0; k < SPH_DIM; k++)
        out[k] = p * along * n[k] + s * (a[k] - along * n[k]);
}

/* what M adds: L n and L^T n are given */
static void modify(const sph_real (*l)[SPH_DIM], const sph_real *n, const sph_real *ln, sph_real c, bool printed,
                   sph_real *acc)
{
    sph_real trace = 0, nn = 0, nl[SPH_DIM] = {0};
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        trace += l[k][k];
        nn += ln[k] * n[k];
        for (uint32_t m = 0; m < SPH_DIM; m++)
            nl[k] += n[m] * l[m][k];
    }
    if (!printed) {
        for (uint32_t k = 0; k < SPH_DIM; k++)
            acc[k] -= c * ((trace - nn) * n[k] + nl[k] - nn * n[k]);
        return;
    }
    if (SPH_DIM == 2) {
        const sph_real t[2] = {n[SPH_DIM > 1], -n[0]}, across = nl[0] * t[0] + nl[SPH_DIM > 1] * t[1]; /* Lt.n */
        acc[0] += c * (across * n[0] - (trace - nn) * t[0]);
        acc[SPH_DIM > 1] += c * (across * n[SPH_DIM > 1] - (trace - nn) * t[1]);
    }
}

/* the acceleration of particle i of a layer, in place of a; v: its velocity */
static void replace(const sph_sim *sim, const sph_set *set, const sph_edge_mark *m, const sph_real (*l)[SPH_DIM],
                    const sph_real *v, sph_real *acc)
{
    double p, s;
    sph_real ln[SPH_DIM], lv[SPH_DIM], a[SPH_DIM];
    const uint32_t edge = sim->cfg.edge;
    sph_edge_speeds(sim, set, &p, &s);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        ln[k] = lv[k] = 0;
        for (uint32_t c = 0; c < SPH_DIM; c++) {
            ln[k] += l[k][c] * m->normal[c];
            lv[k] += l[k][c] * v[c];
        }
    }
    if (edge == SPH_EDGE_H)
        p = s = p / (double)m->cosine;
    if (edge == SPH_EDGE_H_PRINTED) {
        p *= (double)m->cosine;
        s *= (double)m->cosine;
    }
    split(ln, m->normal, (sph_real)-p, (sph_real)-s, a);
    if (SPH_DIM > 1 && (edge == SPH_EDGE_M || edge == SPH_EDGE_M_PRINTED))
        modify(l, m->normal, ln, (sph_real)(p - s), edge == SPH_EDGE_M_PRINTED, a);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        acc[k] = a[k] + lv[k];
}

void sph_edge_force(const sph_sim *sim, const sph_set *set, uint32_t i, const sph_real (*l)[SPH_DIM],
                    const sph_real *v, sph_real *acc)
{
    const sph_edge_mark *m = &sim->edge_mark[sph_source_id(sim, i)];
    sph_real before = 0, after = 0;
    if (sph_in_layer(m)) /* `absorbing` holds what it took in the middle of the step */
        before = sim->absorbing[i];
    for (uint32_t k = 0; k < SPH_DIM; k++)
        before += acc[k] * v[k];
    const bool replaced = sph_replaces(&sim->cfg) && m->level > 0;
    if (replaced)
        replace(sim, set, m, l, v, acc);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        acc[k] += replaced ? 0 : m->push[k];
        after += acc[k] * v[k];
    }
    sim->absorbing[i] = before - after;
}

/* ---- the matched layer ---- */

/* the sum of d but that of axis l, and the product */
static void others(const sph_edge_mark *m, uint32_t l, double *sum, double *product)
{
    *sum = 0;
    *product = SPH_DIM > 2;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        if (k != l) {
            *sum += (double)m->damp[k];
            *product *= (double)m->damp[k];
        }
}

/* component k, l of a symmetric tensor in the order of sph_stress_of */
static const uint8_t full_at[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};

/* sigma:psi + e:L of particle i in the middle, W/kg; psi: of the middle */
static sph_real taken_by_stress(const sph_sim *sim, const sph_set *set, const sph_edge_mark *m, uint32_t i,
                                const sph_real (*l)[SPH_DIM], const sph_real (*psi)[SPH_DIM])
{
    const sph_buffer *b = &sim->buf[sim->dst];
    double stress[6], power = 0, sum, product;
    sph_stress_of(sim, b, i, stress);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t c = 0; c < SPH_DIM; c++) {
            const uint32_t n = sph_sym[k][c];
            others(m, c, &sum, &product);
            double e = sum * (double)b->stress_memory[n][i];
            if (SPH_DIM == 3)
                e += product * (double)b->stress_memory[(SPH_DIM == 3 ? SPH_NT : 0) + n][i];
            power += stress[full_at[k][c]] * (double)psi[k][c] + e * (double)l[k][c];
        }
    return (sph_real)(power / set->rho0);
}

void sph_match_gradient(const sph_sim *sim, const sph_set *set, uint32_t i, sph_real (*l)[SPH_DIM])
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const sph_edge_mark *m = &sim->edge_mark[sph_source_id(sim, i)];
    sph_real psi[SPH_DIM][SPH_DIM] = {{0}}, own[SPH_DIM][SPH_DIM];
    if (!sph_in_layer(m))
        return;
    const double alpha = sph_layer_shift(sim, set);
    memcpy(own, l, sizeof own);
    for (uint32_t a = 0; a < SPH_DIM; a++) {
        const double d = (double)m->damp[a], rate = alpha + d, left = d > 0 ? sph_exp(-rate * sim->dt) : 0;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const uint32_t n = k * SPH_DIM + a;
            const sph_real was = b->strain_memory[n][i];
            sph_real now = was;
            if (sph_in_middle(sim) && d > 0)
                now = (sph_real)left * was + (sph_real)((1 - left) * d / rate) * l[k][a];
            if (sph_in_middle(sim))
                sim->layer[n][i] = now;
            psi[k][a] = (was + now) * (sph_real)0.5;
            l[k][a] -= psi[k][a];
        }
    }
    sim->absorbing[i] = taken_by_stress(sim, set, m, i, (const sph_real(*)[SPH_DIM])own,
                                        (const sph_real(*)[SPH_DIM])psi);
}

/* r and q of a component go on by dt; both come back as their means */
static void remember(sph_real *r, sph_real *q, double stress, double left, double gain, double *mean, double *twice)
{
    const double now = left * (double)*r + gain * stress;
    *mean = 0.5 * ((double)*r + now);
    *r = (sph_real)now;
    *twice = 0;
    if (q) {
        const double then = left * (double)*q + gain * *mean;
        *twice = 0.5 * ((double)*q + then);
        *q = (sph_real)then;
    }
}

static void layer_stress(const sph_sim *sim, uint32_t i, const sph_edge_mark *m, double dt)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const double alpha = sph_layer_shift(sim, &sim->set[b->set[0][i]]);
    const double left = sph_exp(-alpha * dt), gain = (1 - left) / alpha;
    double stress[6], mean[SPH_NT] = {0}, twice[SPH_NT] = {0}, sum, product;
    sph_stress_of(sim, b, i, stress);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t l = k; l < SPH_DIM; l++) {
            const uint32_t n = sph_sym[k][l];
            sph_real *q = SPH_DIM == 3 ? &b->stress_memory[(SPH_DIM == 3 ? SPH_NT : 0) + n][i] : NULL;
            remember(&b->stress_memory[n][i], q, stress[full_at[k][l]] - (double)m->stress[n], left, gain, &mean[n],
                     &twice[n]);
        }
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t l = 0; l < SPH_DIM; l++) {
            const uint32_t n = sph_sym[k][l];
            others(m, l, &sum, &product);
            sim->layer[k * SPH_DIM + l][i] = (sph_real)(sum * mean[n] + product * twice[n]);
        }
}

static void layer_stress_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span span = sph_chunk_span(sim, chunk);
    const sph_buffer *b = &sim->buf[sim->dst];
    const bool steps = sim->stage->drift > 0; /* not when first forces are made */
    for (uint32_t i = span.first; i < span.last; i++) {
        const sph_edge_mark *m = &sim->edge_mark[sph_source_id(sim, i)];
        const bool in = sph_is_solid(&sim->set[b->set[0][i]]) && sph_in_layer(m);
        for (uint32_t k = 0; k < SPH_NL; k++) {
            if (in && steps)
                b->strain_memory[k][i] = sim->layer[k][i];
            sim->layer[k][i] = 0;
        }
        if (in && SPH_DIM > 1)
            layer_stress(sim, i, m, steps ? sim->dt : 0);
    }
    t->work += span.last - span.first;
}
static bool layer_wanted(const sph_sim *sim) { return sph_is_matched(&sim->cfg); }
const sph_pass sph_pass_layer_stress = {"layer stress", sph_local_chunks, layer_stress_chunk, NULL, layer_wanted};

/* the sums of d, of products of two, of all three */
static void damping_of(const sph_edge_mark *m, double *d)
{
    const double x = (double)m->damp[0], y = SPH_DIM > 1 ? (double)m->damp[SPH_DIM > 1] : 0;
    const double z = SPH_DIM > 2 ? (double)m->damp[SPH_DIM - 1] : 0;
    d[0] = x + y + z;
    d[1] = x * y + x * z + y * z;
    d[2] = x * y * z;
}

/* damps component k of a velocity less that of what lies beyond; returns the energy that it loses, J/kg */
static double damp_along(const sph_buffer *b, uint32_t i, uint32_t k, double ref, const double *d, double alpha,
                         double dt)
{
    const double h = 0.5 * dt, c = 1 / (1 + alpha * h), was = (double)b->vel[k][i], v = was - ref;
    sph_real *z = &b->way_memory[k][i], *w = SPH_DIM > 1 ? &b->way_memory[SPH_DIM > 1 ? SPH_DIM + k : 0][i] : NULL;
    sph_real *u = SPH_DIM > 2 ? &b->way_memory[SPH_DIM > 2 ? 2 * SPH_DIM + k : 0][i] : NULL;
    const double z0 = (double)*z, w0 = w ? (double)*w : 0, u0 = u ? (double)*u : 0, az = alpha * z0;
    const double under = 1 + h * (d[0] * c + d[1] * h * c * c + d[2] * h * h * c * c * c);
    const double more = d[0] * c * az - d[1] * (c * w0 - h * c * c * az) -
                        d[2] * (c * u0 + h * c * c * w0 - h * h * c * c * c * az);
    const double mean = (v + h * more) / under, way = c * (mean - az), wm = c * (w0 + h * way), um = c * (u0 + h * wm);
    const sph_real to = (sph_real)(ref + (2 * mean - v));
    *z = (sph_real)(z0 + dt * way);
    if (w)
        *w = (sph_real)(2 * wm - w0);
    if (u)
        *u = (sph_real)(2 * um - u0);
    b->vel[k][i] = to;
    return 0.5 * (was * was - (double)to * (double)to);
}

static void layer_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span span = sph_chunk_span(sim, chunk);
    const sph_buffer *b = &sim->buf[sim->dst];
    const bool matched = sph_is_matched(&sim->cfg);
    double sum = 0;
    for (uint32_t i = span.first; i < span.last; i++) {
        const uint8_t set = b->set[0][i];
        if (set == SPH_DEAD || !sph_is_solid(&sim->set[set]))
            continue;
        const sph_set *s = &sim->set[set];
        const sph_edge_mark *m = &sim->edge_mark[b->id[0][i]];
        const uint32_t held = sph_held(sim, s);
        double lost = (double)sim->absorbing[i] * sim->dt, d[3];
        sim->edge_place[b->id[0][i]] = i;
        damping_of(m, d);
        for (uint32_t k = 0; k < SPH_DIM && matched && d[0] > 0; k++)
            if (!(held >> k & 1))
                lost += damp_along(b, i, k, (double)m->velocity[k], d, sph_layer_shift(sim, s), sim->dt);
        sum += s->mass * lost;
    }
    sim->let_out[chunk] = sum;
    t->work += span.last - span.first;
}
static sph_status add_taken(sph_sim *sim, uint32_t chunks)
{
    double sum = 0;
    for (uint32_t chunk = 0; chunk < chunks; chunk++)
        sum += sim->let_out[chunk];
    sim->next.absorbed += sum;
    return SPH_OK;
}
static sph_status layer_end(sph_sim *sim) { return add_taken(sim, sph_local_chunks(sim)); }
static bool edges_wanted(const sph_sim *sim) { return sph_has_edges(&sim->cfg); }
const sph_pass sph_pass_layer = {"matched layer", sph_local_chunks, layer_chunk, layer_end, edges_wanted};

/* ---- lines ---- */

/* the particles of a line that are still there; false: one of them is gone or held, and the line is left alone */
static bool find_line(const sph_sim *sim, const sph_edge_line *l, uint32_t *at)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    for (uint32_t n = 0; n < l->count; n++) {
        at[n] = sim->edge_place[l->id[n]];
        const bool there = at[n] < sim->next.count && b->id[0][at[n]] == l->id[n] && b->set[0][at[n]] != SPH_DEAD;
        if (!there || sph_held(sim, &sim->set[b->set[0][at[n]]]))
            return false;
    }
    return true;
}

/* the edge's traction over a step; returns the energy that the line loses, J */
static double answer_line(const sph_sim *sim, const sph_edge_line *l, const uint32_t *at)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const double *weight = sim->edge_weight[l->count - 1];
    const sph_set *set = &sim->set[b->set[0][at[0]]];
    sph_real s[SPH_DIM], way[SPH_DIM];
    double cp, cs, squares = 0, lost = 0;
    sph_edge_speeds(sim, set, &cp, &cs);
    for (uint32_t n = 0; n < l->count; n++)
        squares += weight[n] * weight[n];
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        double sum = 0;
        for (uint32_t n = 0; n < l->count; n++)
            sum += weight[n] * (double)b->vel[k][at[n]];
        s[k] = (sph_real)(sum - (double)sim->edge_mark[l->id[0]].velocity[k]);
    }
    const double rate = sim->dt * squares / sim->cfg.spacing;
    split(s, l->normal, (sph_real)((1 - sph_exp(-cp * rate)) / squares),
          (sph_real)((1 - sph_exp(-cs * rate)) / squares), way);
    for (uint32_t n = 0; n < l->count; n++)
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            sph_real *v = &b->vel[k][at[n]];
            const sph_real to = *v - (sph_real)weight[n] * way[k];
            lost += 0.5 * ((double)*v * (double)*v - (double)to * (double)to);
            *v = to;
        }
    return set->mass * lost;
}

static uint32_t lines_along(const sph_sim *sim, uint32_t axis)
{
    return sim->edge_from[axis + 1] - sim->edge_from[axis];
}
static uint32_t line_chunks(const sph_sim *sim, uint32_t axis)
{
    return (lines_along(sim, axis) + SPH_LOCAL_CHUNK - 1) / SPH_LOCAL_CHUNK;
}
/* lines along one axis share no particle; those along different axes may, so they go one after the other */
static void line_chunk(sph_sim *sim, uint32_t axis, uint32_t chunk, sph_thread *t)
{
    const uint32_t first = chunk * SPH_LOCAL_CHUNK, all = lines_along(sim, axis);
    const uint32_t last = first + SPH_LOCAL_CHUNK < all ? first + SPH_LOCAL_CHUNK : all;
    double sum = 0;
    for (uint32_t n = first; n < last; n++) {
        const sph_edge_line *l = &sim->edge_line[sim->edge_from[axis] + n];
        uint32_t at[SPH_EDGE_LINE] = {0};
        if (find_line(sim, l, at))
            sum += answer_line(sim, l, at);
    }
    sim->let_out[chunk] = sum;
    t->work += last - first;
}
#define SPH_LINES(name, axis)                                                                                         \
    static uint32_t chunks_##name(const sph_sim *sim) { return line_chunks(sim, axis); }                              \
    static void line_chunk_##name(sph_sim *sim, uint32_t chunk, sph_thread *t) { line_chunk(sim, axis, chunk, t); }   \
    static sph_status line_end_##name(sph_sim *sim) { return add_taken(sim, line_chunks(sim, axis)); }                \
    static bool wanted_##name(const sph_sim *sim)                                                                     \
    {                                                                                                                 \
        return (axis) < SPH_DIM && sph_has_edges(&sim->cfg) && lines_along(sim, axis) > 0;                            \
    }                                                                                                                 \
    const sph_pass sph_pass_lines_##name = {"edge " #name, chunks_##name, line_chunk_##name, line_end_##name,         \
                                            wanted_##name};
SPH_LINES(x, 0)
#if SPH_DIM > 1
SPH_LINES(y, 1)
#endif
#if SPH_DIM > 2
SPH_LINES(z, 2)
#endif
#undef SPH_LINES
#endif
