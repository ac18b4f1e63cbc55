/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* edges.c: accelerations in the layers before edges that let waves out, written from the conditions for an edge of
   normal n, with L = grad v, in the frame (n, t, b) (Powell 2012 eqs 2.42, 2.45, 2.33, and the listings of his section
   3.2; the sign of L as sph.h has it):
     P  dv_n/dt = -c_p d_n v_n,  dv_t/dt = -c_s d_n v_t;  and L v, because particles go with the flow
     M  dv_n/dt -= (c_p - c_s)(d_t v_t + d_b v_b),  dv_t/dt -= (c_p - c_s) d_t v_n
     H  P with c_p/cos a for both speeds, a between n and the line from the source; cos a not below 0.1
   as printed: M as his listing has it, with t = (n_y, -n_x); H with c cos a. Which particles are in a layer, and the
   normals, the plan makes up. */
#include "oracle.h"

/* every third is in the second layer */
uint32_t o_edge_mark(uint32_t id, double *normal)
{
    for (uint32_t k = 0; k < SPH_DIM; k++)
        normal[k] = (int)((id * 7 + k * 5) % 11) - 4.5;
    return id % 3 == 0 ? 2 : 0;
}

/* directions across n; of an orthonormal frame */
static void frame_of(double (*f)[3])
{
    if (SPH_DIM == 2) {
        f[1][0] = f[0][1];
        f[1][1] = -f[0][0];
    }
    if (SPH_DIM < 3)
        return;
    const int least = fabs(f[0][0]) < fabs(f[0][1]) ? 0 : 1;
    double size = 0;
    for (int k = 0; k < 3; k++)
        f[1][k] = (k == least) - f[0][least] * f[0][k];
    for (int k = 0; k < 3; k++)
        size += f[1][k] * f[1][k];
    for (int k = 0; k < 3; k++)
        f[1][k] /= sqrt(size);
    for (int k = 0; k < 3; k++)
        f[2][k] = f[0][(k + 1) % 3] * f[1][(k + 2) % 3] - f[0][(k + 2) % 3] * f[1][(k + 1) % 3];
}

/* derivative along direction a of the velocity along direction b */
static double slope(double (*l)[3], const double *a, const double *b)
{
    double sum = 0;
    for (int k = 0; k < SPH_DIM; k++)
        for (int c = 0; c < SPH_DIM; c++)
            sum += b[k] * l[k][c] * a[c];
    return sum;
}

void o_edges(const o_scene *s, o_particle *i)
{
    const uint32_t edge = s->cfg.edge;
    const o_set *set = &s->set[i->set];
    double f[3][3] = {{0}}, l[3][3] = {{0}}, size = 0, r = 0, along = 0, of[3] = {0}, most = 0;
    if (edge < SPH_EDGE_P || !o_is_solid(s, i) || !o_edge_mark(i->id, f[0]))
        return;
    const double scale = o_velocity_gradient(s, i, l), c = o_sound(set->eos, set->c0);
    for (int k = 0; k < SPH_DIM; k++)
        size += f[0][k] * f[0][k];
    for (int k = 0; k < SPH_DIM; k++)
        f[0][k] /= sqrt(size);
    frame_of(f);
    for (int k = 0; k < SPH_DIM; k++) { /* the source is at the origin, and the place that of the beginning */
        along += f[0][k] * i->home[k];
        r += i->home[k] * i->home[k];
        most = o_max(most, fabs(i->v[k]));
    }
    const double cosine = o_max(0.1, r > 0 ? along / sqrt(r) : 1), shear = sqrt(set->shear / set->rho0);
    const double whole = sqrt(c * c + 4 * set->shear / (3 * set->rho0));
    const double p = edge == SPH_EDGE_H ? whole / cosine : edge == SPH_EDGE_H_PRINTED ? whole * cosine : whole;
    const double t = edge == SPH_EDGE_H ? p : edge == SPH_EDGE_H_PRINTED ? shear * cosine : shear;
    of[0] = -p * slope(l, f[0], f[0]);
    for (int k = 1; k < SPH_DIM; k++) {
        of[k] = -t * slope(l, f[0], f[k]);
        if (edge == SPH_EDGE_M) {
            of[0] -= (whole - shear) * slope(l, f[k], f[k]);
            of[k] -= (whole - shear) * slope(l, f[k], f[0]);
        }
    }
    if (edge == SPH_EDGE_M_PRINTED) {
        of[0] += (whole - shear) * slope(l, f[1], f[0]);
        of[1] -= (whole - shear) * slope(l, f[1], f[1]);
    }
    for (int k = 0; k < SPH_DIM; k++) {
        i->a[k] = (o_sum){0, 0};
        for (int d = 0; d < SPH_DIM; d++)
            o_add(&i->a[k], of[d] * f[d][k] + l[k][d] * i->v[d], scale * (2 * o_max(p, whole) + most));
    }
}
