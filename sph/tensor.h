/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* tensor.h: small tensors on lanes. A symmetric tensor is kept as its diagonal, then xy, xz, yz (SPH_NT components);
   the deviatoric stress of the state lacks the last diagonal component in 3-D (SPH_NS). Loops run over SPH_DIM axes.
   */
#ifndef SPH_TENSOR_H
#define SPH_TENSOR_H

#include "fields.h"

/* places of the components of a symmetric tensor */
static const uint8_t sph_sym[3][3] __attribute__((unused)) =
#if SPH_DIM == 1
    {{0}};
#elif SPH_DIM == 2
    {{0, 2}, {2, 1}};
#else
    {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
#endif

/* a . b */
SPH_INLINE vreal sph_dot(const vreal *a, const vreal *b)
{
    vreal s = a[0] * b[0];
    SPH_UNROLL
    for (int k = 1; k < SPH_DIM; k++)
        s = s + a[k] * b[k];
    return s;
}

/* D, the damage, from its root D^(1/SPH_DIM) that the state keeps */
SPH_INLINE vreal sph_power_of_dim(vreal root) { return SPH_DIM == 3 ? root * root * root : root * root; }

/* the deviatoric stress as a symmetric tensor from what the state keeps; s has SPH_NT components */
SPH_INLINE void sph_deviator(const vreal *kept, vreal *s)
{
    SPH_UNROLL
    for (int k = 0; k < SPH_NS; k++)
        s[SPH_DIM == 3 && k > 1 ? k + 1 : k] = kept[k];
    if (SPH_DIM == 3)
        s[SPH_NT / 3] = -(kept[0] + kept[SPH_NS > 1 ? 1 : 0]);
}

/* One turn of Jacobi's rule: rotates a symmetric a so that a[p][q] vanishes, and the axes e (columns) with it. */
SPH_INLINE void sph_jacobi_turn(vreal (*a)[3], vreal (*e)[3], int p, int q)
{
    const vreal none = v_set(0), one = v_set(1);
    const vint still = ~v_less(none, v_abs(a[p][q]));
    const vreal theta = (a[q][q] - a[p][p]) / (2 * v_select(still, one, a[p][q]));
    const vreal big = v_set(SPH_DOUBLE ? (sph_real)1e100 : (sph_real)1e15);
    const vreal size = v_select(v_less(v_abs(theta), big), v_abs(theta), big);
    const vreal root = 1 / (size + v_sqrt(size * size + 1));
    const vreal t = v_select(still, none, v_select(v_less(theta, none), -root, root));
    const vreal c = 1 / v_sqrt(t * t + 1), s = t * c;
    const int r = 3 - p - q;
    const vreal apq = a[p][q], arp = a[r][p], arq = a[r][q];
    a[p][p] = a[p][p] - t * apq;
    a[q][q] = a[q][q] + t * apq;
    a[p][q] = a[q][p] = v_select(still, apq, none);
    a[r][p] = a[p][r] = c * arp - s * arq;
    a[r][q] = a[q][r] = s * arp + c * arq;
    for (int k = 0; k < 3; k++) {
        const vreal x = e[k][p], y = e[k][q];
        e[k][p] = c * x - s * y;
        e[k][q] = s * x + c * y;
    }
}

/* Principal values of a symmetric 3 x 3 tensor onto its diagonal, principal axes into the columns of e: cyclic Jacobi,
   four sweeps. */
SPH_INLINE void sph_principal(vreal (*a)[3], vreal (*e)[3])
{
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            e[k][l] = v_set(k == l ? 1 : 0);
    for (int turn = 0; turn < 4; turn++) {
        sph_jacobi_turn(a, e, 0, 1);
        sph_jacobi_turn(a, e, 0, 2);
        sph_jacobi_turn(a, e, 1, 2);
    }
}

/* the cofactor of component k, l */
SPH_INLINE sph_real sph_cofactor(const sph_real (*m)[SPH_DIM], int k, int l)
{
    const int a = (k + 1) % SPH_DIM, c = (l + 1) % SPH_DIM;
    if (SPH_DIM == 1)
        return 1;
    if (SPH_DIM == 2)
        return k == l ? m[a][c] : -m[a][c];
    const int b = (k + 2) % SPH_DIM, d = (l + 2) % SPH_DIM;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
}

/* Inverse of m, or false where it is nearly singular: a determinant below a thousandth of a ball's with the same norm
   (not the trace: where a body has turned since its reference position, M has turned on one side), or not above
   `least`. */
SPH_INLINE_BIG bool sph_invert(const sph_real (*m)[SPH_DIM], sph_real (*inv)[SPH_DIM], sph_real least)
{
    sph_real mean = 0, co[SPH_DIM][SPH_DIM];
    for (int k = 0; k < SPH_NL; k++) {
        mean += m[k / SPH_DIM][k % SPH_DIM] * m[k / SPH_DIM][k % SPH_DIM];
        co[k / SPH_DIM][k % SPH_DIM] = sph_cofactor(m, k / SPH_DIM, k % SPH_DIM);
    }
    mean = SPH_SQRT(mean / SPH_DIM);
    sph_real power = mean;
    for (int k = 1; k < SPH_DIM; k++)
        power *= mean;
    sph_real det = m[0][0] * co[0][0];
    for (int k = 1; k < SPH_DIM; k++)
        det += m[0][k] * co[0][k];
    if (!(det > (sph_real)1e-3 * power && det > least))
        return false;
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            inv[k][l] = co[l][k] / det;
    return true;
}

/* Inverse of a sum M = -sum m_j x_ij (x) K g around a particle, or false where its neighbours do not span space: where
   M is nearly singular, or smaller than six tenths of what a particle in the corner of a block has, `whole` times
   2^-SPH_DIM on every axis (lone particles, pairs, drops: of neighbours at the edge of the support M is as small as one
   likes, of whatever shape). whole: what it is inside a body, rho; in the weak scheme 1. */
SPH_INLINE bool sph_invert_sum(const sph_real (*m)[SPH_DIM], sph_real (*inv)[SPH_DIM], sph_real whole)
{
    const sph_real edge = (sph_real)0.6 / (1 << SPH_DIM) * whole;
    return sph_invert(m, inv, SPH_DIM == 1 ? edge : SPH_DIM == 2 ? edge * edge : edge * edge * edge);
}

#endif
