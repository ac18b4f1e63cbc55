/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* lanes.h: the eight virtual lanes. This is the one file that knows about vector registers.

   Every sum over neighbours runs in SPH_LANES = 8 partial sums: candidate number k of a particle (in
   three dimensions: neighbour number k) goes to lane k mod 8, and the lanes are folded in one fixed
   order. A machine handles the eight lanes in groups of W (1, 2, 4 or 8): the grouping changes who
   computes, never what. The pair formulas are written once, on the type `vreal`, which is a vector of
   W reals, or a plain real where W is 1; in that case pairs out of range are skipped, which adds no
   bit because the vector form adds a true zero there.

   Only + - * / and the square root are used, element by element, as IEEE 754 defines them. */
#ifndef SPH_LANES_H
#define SPH_LANES_H

#include <float.h>
#include <stdint.h>
#include <string.h>

#include "checks.h"
#include "sph.h"

#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "sph needs FLT_EVAL_METHOD 0 (on 32-bit x86: -msse2 -mfpmath=sse; gcc: -fexcess-precision=fast)"
#endif
#ifdef __FAST_MATH__
#error "sph must not be built with -ffast-math: it changes bits"
#endif

#define SPH_LANES 8

#if SPH_DOUBLE
#define SPH_SQRT(x) __builtin_sqrt(x)
#else
#define SPH_SQRT(x) __builtin_sqrtf(x)
#endif

#define SPH_INLINE static inline __attribute__((always_inline, unused))
#if defined(__OPTIMIZE_SIZE__) /* -Os: loops stay loops, and no text is compiled twice for speed */
#define SPH_SMALL 1
#define SPH_UNROLL
#define SPH_UNROLL_MANY
#elif defined(__clang__)
#define SPH_UNROLL _Pragma("unroll")
#define SPH_UNROLL_MANY _Pragma("unroll")
#elif defined(__GNUC__) && !defined(__TINYC__)
#define SPH_UNROLL _Pragma("GCC unroll 8")
#define SPH_UNROLL_MANY _Pragma("GCC unroll 32")
#else
#define SPH_UNROLL
#define SPH_UNROLL_MANY
#endif
#ifndef SPH_SMALL
#define SPH_SMALL 0
#endif
/* a form of a text that is compiled apart from its like */
#define SPH_APART static __attribute__((noinline, unused))
#if SPH_SMALL
#define SPH_INLINE_BIG static __attribute__((noinline, unused))
#else
#define SPH_INLINE_BIG SPH_INLINE
#endif

/* bytes of one vector register; SPH_VECTOR_BYTES=0 asks for the scalar form */
#ifndef SPH_VECTOR_BYTES
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define SPH_VECTOR_BYTES 64
#elif defined(__AVX2__)
#define SPH_VECTOR_BYTES 32
#elif defined(__SSE2__) || defined(__aarch64__) || defined(__wasm_simd128__)
#define SPH_VECTOR_BYTES 16
#else
#define SPH_VECTOR_BYTES 0
#endif
#endif

#if SPH_DOUBLE
typedef int64_t sph_int; /* the integer as wide as a real */
#define SPH_REAL_BYTES 8
#else
typedef int32_t sph_int;
#define SPH_REAL_BYTES 4
#endif

#if SPH_VECTOR_BYTES >= 2 * SPH_REAL_BYTES
#if SPH_VECTOR_BYTES / SPH_REAL_BYTES > SPH_LANES
#define SPH_W SPH_LANES
#else
#define SPH_W (SPH_VECTOR_BYTES / SPH_REAL_BYTES)
#endif
typedef sph_real vreal __attribute__((vector_size(SPH_W * SPH_REAL_BYTES)));
typedef sph_int vint __attribute__((vector_size(SPH_W * SPH_REAL_BYTES)));
#define SPH_SCALAR 0
SPH_INLINE vreal v_sqrt(vreal a)
{
    vreal r = a;
    for (int l = 0; l < SPH_W; l++)
        r[l] = SPH_SQRT(a[l]);
    return r;
}
SPH_INLINE vreal v_set(sph_real a) { return a - (vreal){0}; }
SPH_INLINE vreal v_from_int(vint a) { return __builtin_convertvector(a, vreal); }
SPH_INLINE vint v_to_int(vreal a) { return __builtin_convertvector(a, vint); } /* towards 0; |a| must be in range */
SPH_INLINE vint v_set_int(sph_int a) { return a - (vint){0}; }
SPH_INLINE vint v_less_int(vint a, vint b) { return a < b; }
/* a where m holds, else 0 */
SPH_INLINE vreal v_where(vint m, vreal a) { return (vreal)(m & (vint)a); }
SPH_INLINE vint v_less(vreal a, vreal b) { return a < b; }
SPH_INLINE vint v_equal(vreal a, vreal b) { return a == b; }
SPH_INLINE vreal v_select(vint m, vreal a, vreal b)
{
    return (vreal)((m & (vint)a) | (~m & (vint)b));
}
#else
#define SPH_W 1
typedef sph_real vreal;
typedef sph_int vint;
#define SPH_SCALAR 1
SPH_INLINE vreal v_sqrt(vreal a) { return SPH_SQRT(a); }
SPH_INLINE vreal v_set(sph_real a) { return a; }
SPH_INLINE vreal v_from_int(vint a) { return (vreal)a; }
SPH_INLINE vint v_to_int(vreal a) { return (vint)a; }
SPH_INLINE vint v_set_int(sph_int a) { return a; }
SPH_INLINE vint v_less_int(vint a, vint b) { return -(vint)(a < b); }
SPH_INLINE vreal v_where(vint m, vreal a) { return m ? a : 0; }
SPH_INLINE vint v_less(vreal a, vreal b) { return -(vint)(a < b); }
SPH_INLINE vint v_equal(vreal a, vreal b) { return -(vint)!(a < b || b < a); }
SPH_INLINE vreal v_select(vint m, vreal a, vreal b) { return m ? a : b; }
#endif

/* bit l: whether a mask holds in lane l; SPH_HAS_QUICK_BITS: by one instruction */
#if defined(__SSE2__) && SPH_W <= 8
#define SPH_HAS_QUICK_BITS 1
#else
#define SPH_HAS_QUICK_BITS 0
#endif
#if SPH_SCALAR
SPH_INLINE uint32_t v_bits(vint m) { return (uint32_t)m & 1; }
#elif defined(__SSE2__) && !SPH_DOUBLE && SPH_W == 4
SPH_INLINE uint32_t v_bits(vint m) { return (uint32_t)__builtin_ia32_movmskps((vreal)m); }
#elif defined(__SSE2__) && !SPH_DOUBLE && SPH_W == 8
SPH_INLINE uint32_t v_bits(vint m) { return (uint32_t)__builtin_ia32_movmskps256((vreal)m); }
#elif defined(__SSE2__) && SPH_DOUBLE && SPH_W == 2
SPH_INLINE uint32_t v_bits(vint m) { return (uint32_t)__builtin_ia32_movmskpd((vreal)m); }
#elif defined(__SSE2__) && SPH_DOUBLE && SPH_W == 4
SPH_INLINE uint32_t v_bits(vint m) { return (uint32_t)__builtin_ia32_movmskpd256((vreal)m); }
#else
SPH_INLINE uint32_t v_bits(vint m)
{
    uint32_t bits = 0;
    SPH_UNROLL
    for (int l = 0; l < SPH_W; l++)
        bits |= (uint32_t)(m[l] & 1) << l;
    return bits;
}
#endif

/* Whether pairs must be worked off; those out of reach need not, all their terms are 0. The scalar form skips them; of
   a vector all must be, and it is asked for. */
SPH_INLINE bool sph_within(vreal r2, sph_real reach2, bool skips)
{
    if (!SPH_SCALAR && !(skips && SPH_HAS_QUICK_BITS))
        return true;
    return v_bits(v_less(v_set(reach2), r2)) != (1u << SPH_W) - 1;
}

/* Four records side by side become n <= 4 columns: element k of record l goes to place l of column k. */
#if !SPH_SCALAR && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define SPH_SHUFFLES 1
#endif
#endif
typedef const sph_real *const sph_four_records[4];
typedef sph_real *const sph_four_columns[4];
#ifdef SPH_SHUFFLES
typedef sph_real vquad __attribute__((vector_size(4 * SPH_REAL_BYTES)));
SPH_INLINE void v_turn(sph_four_records r, uint32_t from, sph_four_columns to, uint32_t n)
{
    vquad a, b, c, d;
    memcpy(&a, r[0] + from, sizeof a);
    memcpy(&b, r[1] + from, sizeof b);
    memcpy(&c, r[2] + from, sizeof c);
    memcpy(&d, r[3] + from, sizeof d);
    const vquad ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const vquad ab2 = __builtin_shufflevector(a, b, 2, 6, 3, 7), cd2 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    const vquad turned[4] = {
        __builtin_shufflevector(ab, cd, 0, 1, 4, 5), __builtin_shufflevector(ab, cd, 2, 3, 6, 7),
        __builtin_shufflevector(ab2, cd2, 0, 1, 4, 5), __builtin_shufflevector(ab2, cd2, 2, 3, 6, 7)};
    SPH_UNROLL
    for (uint32_t k = 0; k < n; k++)
        memcpy(to[k], &turned[k], sizeof turned[k]);
}
#else
SPH_INLINE void v_turn(sph_four_records r, uint32_t from, sph_four_columns to, uint32_t n)
{
    SPH_UNROLL
    for (uint32_t k = 0; k < n; k++)
        SPH_UNROLL
        for (uint32_t l = 0; l < 4; l++)
            to[k][l] = r[l][from + k];
}
#endif

#define SPH_NV (SPH_LANES / SPH_W) /* vectors that make up the eight lanes */

SPH_INLINE vreal v_load(const sph_real *p)
{
    vreal v;
    memcpy(&v, p, sizeof v);
    return v;
}
SPH_INLINE void v_store(sph_real *p, vreal v) { memcpy(p, &v, sizeof v); }
SPH_INLINE void v_store_int(void *p, vint v) { memcpy(p, &v, sizeof v); }
SPH_INLINE vint v_load_int(const void *p)
{
    vint v;
    memcpy(&v, p, sizeof v);
    return v;
}
SPH_INLINE vreal v_max(vreal a, vreal b) { return v_select(v_less(a, b), b, a); }
SPH_INLINE vreal v_pos(vreal a) { return v_where(v_less(v_set(0), a), a); } /* max(a, 0) */
SPH_INLINE vreal v_abs(vreal a) { return v_max(a, -a); }

/* 0, 1, 2 ... */
static const sph_real sph_lane_numbers[SPH_LANES] __attribute__((unused)) = {0, 1, 2, 3, 4, 5, 6, 7};

/* the one order in which eight partial sums become a sum: ((0+4)+(2+6)) + ((1+5)+(3+7)) */
#if SPH_SCALAR
SPH_INLINE_BIG sph_real v_fold(const sph_real *l)
{
    return ((l[0] + l[4]) + (l[2] + l[6])) + ((l[1] + l[5]) + (l[3] + l[7]));
}
#else
typedef sph_real vhalf __attribute__((vector_size(4 * SPH_REAL_BYTES)));
SPH_INLINE sph_real v_fold(const sph_real *l)
{
    vhalf a, b;
    memcpy(&a, l, sizeof a);
    memcpy(&b, l + 4, sizeof b);
    a = a + b;
    return (a[0] + a[2]) + (a[1] + a[3]);
}
#endif
SPH_INLINE_BIG sph_real v_fold_max(const sph_real *l)
{
    sph_real m[4];
    for (int k = 0; k < 4; k++)
        m[k] = l[k] < l[k + 4] ? l[k + 4] : l[k];
    m[0] = m[0] < m[2] ? m[2] : m[0];
    m[1] = m[1] < m[3] ? m[3] : m[1];
    return m[0] < m[1] ? m[1] : m[0];
}

#endif
