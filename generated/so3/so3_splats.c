/*
 * so3: Rotations of R^3 as unit quaternions (w, x, y, z), q and -q the same; distances are rotation angles in
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "so3.h"

#include <float.h>
#include <stdint.h>
#include <string.h>

/*
 * A vector is as wide as the machine's registers, or one number where the compiler has no vectors (or is asked for none
 * by -DRSRM_NO_VECTORS). Comparisons of vectors are masks; `vector_select` is the ?: of vectors.
 */
#if defined(__GNUC__) && !defined(RSRM_NO_VECTORS)
#if defined(__AVX512F__)
#define VECTOR_BYTES 64
#elif defined(__AVX__)
#define VECTOR_BYTES 32
#else
#define VECTOR_BYTES 16
#endif
#define LANE(vector, i) (vector)[i]
#define ZERO {0}
typedef double vector __attribute__((vector_size(VECTOR_BYTES)));
typedef float vector_f __attribute__((vector_size(VECTOR_BYTES)));
typedef int64_t vector_mask __attribute__((vector_size(VECTOR_BYTES)));
typedef int32_t vector_mask_f __attribute__((vector_size(VECTOR_BYTES)));
typedef uint64_t vector_bits __attribute__((vector_size(VECTOR_BYTES)));
typedef uint32_t vector_bits_f __attribute__((vector_size(VECTOR_BYTES)));
#else
#define LANE(vector, i) (vector)
#define ZERO 0
typedef double vector;
typedef float vector_f;
typedef int64_t vector_mask;
typedef int32_t vector_mask_f;
typedef uint64_t vector_bits;
typedef uint32_t vector_bits_f;
#endif
#if defined(__GNUC__)
#define INLINE static inline __attribute__((always_inline, unused))
#else
#define INLINE static inline
#endif
/* `used` keeps signatures: clang 14 at -O3 passes vectors of AVX-512 by value where caller and callee disagree how. */
#if defined(__clang__)
#define OUTLINE static __attribute__((noinline, used))
#elif defined(__GNUC__)
#define OUTLINE static __attribute__((noinline, noclone, used))
#else
#define OUTLINE static
#endif
/* UNROLLED: the few turns of a loop, one after another. EACH_LANE: what gcc makes one instruction as long as it is a loop. */
#if defined(__clang__)
#define UNROLLED _Pragma("clang loop unroll(full)")
#define EACH_LANE
#elif defined(__GNUC__) && __GNUC__ >= 8
#define UNROLLED _Pragma("GCC unroll 8")
#define EACH_LANE _Pragma("GCC unroll 1")
#else
#define UNROLLED
#define EACH_LANE
#endif
#define LANES (sizeof(vector) / sizeof(double))
#define LANES_f (sizeof(vector_f) / sizeof(float))

/* Threads, where the compiler has OpenMP. */
#if defined(_OPENMP)
#define OMP(directive) _Pragma(#directive)
#else
#define OMP(directive)
#endif

/* Denormal numbers count as zero while the sums run: far splats are many, and slow. */
#if defined(__SSE2__)
#include <xmmintrin.h>
INLINE uint64_t flush_denormals(void) {
    const unsigned mode = _mm_getcsr();
    _mm_setcsr(mode | 0x8040u);
    return mode;
}
INLINE void restore_denormals(uint64_t mode) { _mm_setcsr((unsigned)mode); }
#elif defined(__aarch64__) && defined(__GNUC__)
INLINE uint64_t flush_denormals(void) {
    uint64_t mode;
    __asm__ __volatile__("mrs %0, fpcr" : "=r"(mode));
    __asm__ __volatile__("msr fpcr, %0" : : "r"(mode | (UINT64_C(1) << 24)));
    return mode;
}
INLINE void restore_denormals(uint64_t mode) { __asm__ __volatile__("msr fpcr, %0" : : "r"(mode)); }
#else
INLINE uint64_t flush_denormals(void) { return 0; }
INLINE void restore_denormals(uint64_t mode) { (void)mode; }
#endif

#if !defined(RSRM_ONLY_FLOAT) /* double */

/* The same number in all lanes. */
INLINE vector vector_of(double x) {
    const vector zero = ZERO;
    return x - zero;
}

/* x in the lanes of the mask, y in the others; clang knows this by its bits, gcc as a loop. */
INLINE vector vector_select(vector_mask mask, vector x, vector y) {
#if defined(__clang__) && !defined(RSRM_NO_VECTORS)
    return (vector)((mask & (vector_mask)x) | (~mask & (vector_mask)y));
#else
    EACH_LANE for (size_t i = 0; i < LANES; ++i) LANE(x, i) = LANE(mask, i) ? LANE(x, i) : LANE(y, i);
    return x;
#endif
}

/* Numbers in memory to a vector, and back. */
INLINE vector vector_load(const double *from) {
    vector x;
    memcpy(&x, from, sizeof x);
    return x;
}
INLINE void vector_store(double *to, vector x) { memcpy(to, &x, sizeof x); }

/* The sum over the lanes, by halves. */
INLINE double vector_sum(vector x) {
    double lanes[LANES];
    vector_store(lanes, x);
    for (size_t half = LANES / 2; half > 0; half /= 2)
        for (size_t i = 0; i < half; ++i) lanes[i] += lanes[i + half];
    return lanes[0];
}

/* The bits of a vector as integers, and back. */
INLINE vector_bits vector_to_bits(vector x) {
    vector_bits bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
INLINE vector vector_from_bits(vector_bits bits) {
    vector x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* x >= 0 with the sign of another. */
INLINE vector signed_each(vector x, vector sign) {
    return vector_from_bits(vector_to_bits(x) | (vector_to_bits(sign) & 0x8000000000000000));
}

/* abs of every lane; one instruction where the machine has it. */
INLINE vector abs_each(vector x) {
    EACH_LANE for (size_t i = 0; i < LANES; ++i) LANE(x, i) = fabs(LANE(x, i));
    return x;
}

/* sqrt of every lane; one instruction where the machine has it. */
INLINE vector sqrt_each(vector x) {
    EACH_LANE for (size_t i = 0; i < LANES; ++i) LANE(x, i) = sqrt(LANE(x, i));
    return x;
}

/* exp(-s / 2) of s >= 0, as 2^k exp(-r / 2), |r| <= log(2), within 1 unit in the last place; below 3.8e-308 it is 0. */
INLINE vector gaussian_each(vector s) {
    const vector shifted = s * -0.7213475204444817 + 6755399441056767.0, k = shifted - 6755399441056767.0;
    const vector r = (s + k * 1.3862943611202354) + k * -3.447888905122967e-13;
    const vector part = r * (-0.5 + r * (0.12500000000000003 + r * (-0.020833333333333336 + r * (0.0026041666666640085 + r * (-0.0002604166666665645 + r * (2.170138893314011e-05 + r * (-1.5500992080508208e-06 + r * (9.688094258687923e-08 + r * (-5.382278997037427e-09 + r * (2.697273970216642e-10 + r * -1.2256046482356944e-11))))))))));
    const vector scale = vector_from_bits(vector_to_bits(shifted) << 52); /* 2^k */
    return vector_select(s > 1415.8, vector_of(0), scale + scale * part);
}

/* atan2, within 3 units in the last place. */
INLINE vector atan2_each(vector y, vector x) {
    const vector a = abs_each(y), b = abs_each(x), one = vector_of(1);
    const vector less = vector_select(a > b, b, a), more = vector_select(a > b, a, b);
    const vector low = vector_select(less > 1.7976931348623157e308, one, less);
    const vector high = vector_select(less > 1.7976931348623157e308, one, vector_select(more == 0, one, more));
    const vector top = vector_select(low > 0.4142135623730951 * high, low - high, low);
    const vector bottom = vector_select(low > 0.4142135623730951 * high, low * 0.5 + high * 0.5, high * 0.5);
    const vector t = top / bottom * 0.5, z = t * t;
    const vector angle = t + t * z * (-0.3333333333333333 + z * (0.19999999999999804 + z * (-0.14285714285659806 + z * (0.11111111105153429 + z * (-0.09090908753400499 + z * (0.07692296372129964 + z * (-0.06666424833613552 + z * (0.05878928398517232 + z * (-0.052304498567092406 + z * (0.04551573086664191 + z * (-0.034570044186095536 + z * 0.016285183029865667)))))))))));
    const vector first = vector_select(low > 0.4142135623730951 * high, 0.7853981633974483 + (angle + 3.061616997868383e-17), angle);
    const vector second = vector_select(a > b, 1.5707963267948966 - (first - 6.123233995736766e-17), first);
    const vector third = vector_select((vector_to_bits(x) & 0x8000000000000000) != 0, 3.141592653589793 - (second - 1.2246467991473532e-16), second);
    return signed_each(third, y);
}

/* Of degree 22 on [0, 1], its relative error below 2^-56. */
INLINE vector vector_polynomial_eta(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4, x16 = x8 * x8;
    return -0.3333333333333333 + x * -0.15555555555555417 + x2 * (-0.0751322751325185 + x *
        -0.03675485007122077) + x4 * (-0.018096307611278978 + x * -0.008943374809421614 + x2 *
        (-0.004430925385329046 + x * -0.0021964703384272457)) + x8 * (-0.0011104899422210344 + x *
        -0.00043588704846449504 + x2 * (-0.0007657550487225839 + x * 0.0016571322482715526) + x4 *
        (-0.005201036361742151 + x * 0.011686077913434692 + x2 * (-0.021370123691407478 + x *
        0.030980832139913622))) + x16 * (-0.03558600284661443 + x * 0.0319201664739325 + x2 *
        (-0.021918764490751072 + x * 0.011133610751913487) + x4 * (-0.003950943563875907 + x *
        0.0008768185204850178 + x2 * -9.231518464940076e-05));
}

/* Of degree 24 on [0, 1], the derivative of a polynomial. */
INLINE vector vector_polynomial_eta_slope(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4, x16 = x8 * x8;
    return 0.15555555555555556 + x * 0.15026455026454938 + x2 * (0.11026455026473153 + x *
        0.07238522792583003) + x4 * (0.044716945477134895 + x * 0.026584251371183424 + x2 *
        (0.015391620467330733 + x * 0.008735778127899076)) + x8 * (0.0049282202879051655 + x *
        0.0024267420372403327 + x2 * (0.0030390346356601126 + x * -0.006123591852401879) + x4 *
        (0.025102822589180937 + x * -0.07064869504587278 + x2 * (0.16530578140602667 + x *
        -0.31271015508815947))) + x16 * (0.4807082529660211 + x * -0.5967654210780935 + x2 *
        (0.5934034512823599 + x * -0.46583818796288984) + x4 * (0.2823845184351827 + x * -0.12759583319351508
        + x2 * (0.04051757743528327 + x * -0.008083579736595401)) + x8 * 0.0007658488591020234);
}

/* What pairs read of points x. */
OUTLINE void pair_features(
    const vector *x, vector *X) {
    const vector x0 = x[0];
    const vector x1 = x[1];
    const vector x2 = x[2];
    const vector x3 = x[3];
    X[0] = x0;
    X[1] = x1;
    X[2] = x2;
    X[3] = x3;
}

/* What pairs read of a splat, of some splats. */
OUTLINE void pair_constants(
    const vector *mu, const vector *W, const vector *amplitude, vector *S) {
    const vector mu0 = mu[0];
    const vector mu1 = mu[1];
    const vector mu2 = mu[2];
    const vector mu3 = mu[3];
    const vector W0_0 = W[0];
    const vector W0_1 = W[1];
    const vector W0_2 = W[2];
    const vector W1_0 = W[3];
    const vector W1_1 = W[4];
    const vector W1_2 = W[5];
    const vector W2_0 = W[6];
    const vector W2_1 = W[7];
    const vector W2_2 = W[8];
    const vector its_amplitude = amplitude[0];
    const vector product = 2.0 * mu0;
    const vector product_2 = 2.0 * mu1;
    const vector product_3 = 2.0 * mu2;
    const vector R0_3 = W0_2 * product + W0_1 * product_2 - W0_0 * product_3;
    const vector product_4 = 2.0 * mu3;
    const vector R0_0 = -(W0_2 * product_4) - W0_1 * product_3 - W0_0 * product_2;
    const vector R0_2 = W0_1 * product - W0_2 * product_2 + W0_0 * product_4;
    const vector R0_1 = W0_2 * product_3 - W0_1 * product_4 + W0_0 * product;
    const vector R1_3 = W1_2 * product + W1_1 * product_2 - W1_0 * product_3;
    const vector R1_0 = -(W1_2 * product_4) - W1_1 * product_3 - W1_0 * product_2;
    const vector R1_2 = W1_1 * product - W1_2 * product_2 + W1_0 * product_4;
    const vector R1_1 = W1_2 * product_3 - W1_1 * product_4 + W1_0 * product;
    const vector R2_3 = W2_2 * product + W2_1 * product_2 - W2_0 * product_3;
    const vector R2_0 = -(W2_2 * product_4) - W2_1 * product_3 - W2_0 * product_2;
    const vector R2_2 = W2_1 * product - W2_2 * product_2 + W2_0 * product_4;
    const vector R2_1 = W2_2 * product_3 - W2_1 * product_4 + W2_0 * product;
    S[0] = mu0;
    S[1] = mu1;
    S[2] = mu2;
    S[3] = mu3;
    S[4] = its_amplitude;
    S[5] = R0_3;
    S[6] = R0_0;
    S[7] = R0_2;
    S[8] = R0_1;
    S[9] = R1_3;
    S[10] = R1_0;
    S[11] = R1_2;
    S[12] = R1_1;
    S[13] = R2_3;
    S[14] = R2_0;
    S[15] = R2_2;
    S[16] = R2_1;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
 * w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
 * eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
 * Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
 * r = R h = W (tangent part of x), phi = amplitude a^k exp(-a^2 |r|^2 / 2)
 */
INLINE void pair_value(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values) {
    struct { vector a, gaussian; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 17 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 4 * b;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector g0 = x0 * mu0 + x1 * mu1 + x2 * mu2 + x3 * mu3;
            const vector abs_g0 = abs_each(g0);
            const vector eta = vector_polynomial_eta(1.0 - abs_g0);
            const vector a = 1.0 / (abs_g0 - eta * (1.0 - abs_g0 * abs_g0));
            kept[k][b].a = a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 17 * near[k];
        const double R0_3 = S[5];
        const double R0_0 = S[6];
        const double R0_2 = S[7];
        const double R0_1 = S[8];
        const double R1_3 = S[9];
        const double R1_0 = S[10];
        const double R1_2 = S[11];
        const double R1_1 = S[12];
        const double R2_3 = S[13];
        const double R2_0 = S[14];
        const double R2_2 = S[15];
        const double R2_1 = S[16];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 4 * b;
            const vector a = kept[k][b].a;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector a_squared = a * a;
            const vector r0 = x0 * R0_0 + x1 * R0_1 + x2 * R0_2 + x3 * R0_3;
            const vector r1 = x0 * R1_0 + x1 * R1_1 + x2 * R1_2 + x3 * R1_3;
            const vector r2 = x0 * R2_0 + x1 * R2_1 + x2 * R2_2 + x3 * R2_3;
            const vector square = a_squared * (r0 * r0 + r1 * r1 + r2 * r2);
            const vector gaussian = gaussian_each(square);
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 17 * near[k];
        const double amplitude = S[4];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            const vector a = kept[k][b].a;
            const vector gaussian = kept[k][b].gaussian;
            const vector phi = a * (a * gaussian);
            value[0] = value[0] + amplitude * phi;
        }
    }
}

/*
 * Adds the values phi of some splats at 2 vectors of points, and slope = d phi / d X.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
 * w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
 * eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
 * Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
 * r = R h = W (tangent part of x), phi = amplitude a^k exp(-a^2 |r|^2 / 2)
 */
INLINE void pair_forward(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values, vector *slopes) {
    struct { vector g0, eta, a, a_squared, r0, r1, r2, square, gaussian; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 17 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 4 * b;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector g0 = x0 * mu0 + x1 * mu1 + x2 * mu2 + x3 * mu3;
            const vector abs_g0 = abs_each(g0);
            const vector eta = vector_polynomial_eta(1.0 - abs_g0);
            const vector a = 1.0 / (abs_g0 - eta * (1.0 - abs_g0 * abs_g0));
            kept[k][b].g0 = g0;
            kept[k][b].eta = eta;
            kept[k][b].a = a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 17 * near[k];
        const double R0_3 = S[5];
        const double R0_0 = S[6];
        const double R0_2 = S[7];
        const double R0_1 = S[8];
        const double R1_3 = S[9];
        const double R1_0 = S[10];
        const double R1_2 = S[11];
        const double R1_1 = S[12];
        const double R2_3 = S[13];
        const double R2_0 = S[14];
        const double R2_2 = S[15];
        const double R2_1 = S[16];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 4 * b;
            const vector a = kept[k][b].a;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector a_squared = a * a;
            const vector r0 = x0 * R0_0 + x1 * R0_1 + x2 * R0_2 + x3 * R0_3;
            const vector r1 = x0 * R1_0 + x1 * R1_1 + x2 * R1_2 + x3 * R1_3;
            const vector r2 = x0 * R2_0 + x1 * R2_1 + x2 * R2_2 + x3 * R2_3;
            const vector square = a_squared * (r0 * r0 + r1 * r1 + r2 * r2);
            const vector gaussian = gaussian_each(square);
            kept[k][b].a_squared = a_squared;
            kept[k][b].r0 = r0;
            kept[k][b].r1 = r1;
            kept[k][b].r2 = r2;
            kept[k][b].square = square;
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 17 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double amplitude = S[4];
        const double R0_3 = S[5];
        const double R0_0 = S[6];
        const double R0_2 = S[7];
        const double R0_1 = S[8];
        const double R1_3 = S[9];
        const double R1_0 = S[10];
        const double R1_2 = S[11];
        const double R1_1 = S[12];
        const double R2_3 = S[13];
        const double R2_0 = S[14];
        const double R2_2 = S[15];
        const double R2_1 = S[16];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            vector *slope = slopes + 4 * b;
            const vector g0 = kept[k][b].g0;
            const vector eta = kept[k][b].eta;
            const vector a = kept[k][b].a;
            const vector a_squared = kept[k][b].a_squared;
            const vector r0 = kept[k][b].r0;
            const vector r1 = kept[k][b].r1;
            const vector r2 = kept[k][b].r2;
            const vector square = kept[k][b].square;
            const vector gaussian = kept[k][b].gaussian;
            const vector phi = a * (a * gaussian);
            const vector phi_2 = amplitude * phi;
            const vector by_abs_g0 = eta * (2.0 * phi_2 - phi_2 * square);
            const vector by_g0 = vector_select(g0 < 0.0, -by_abs_g0, by_abs_g0);
            const vector phi_product = phi_2 * a_squared;
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] + mu0 * by_g0 - (R0_0 * r0 + R1_0 * r1 + R2_0 * r2) * phi_product;
            slope[1] = slope[1] + mu1 * by_g0 - (R0_1 * r0 + R1_1 * r1 + R2_1 * r2) * phi_product;
            slope[2] = slope[2] + mu2 * by_g0 - (R0_2 * r0 + R1_2 * r1 + R2_2 * r2) * phi_product;
            slope[3] = slope[3] + mu3 * by_g0 - (R0_3 * r0 + R1_3 * r1 + R2_3 * r2) * phi_product;
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient(
    const vector *x, const vector *slope, vector *gradient) {
    const vector x0 = x[0];
    const vector x1 = x[1];
    const vector x2 = x[2];
    const vector x3 = x[3];
    const vector slope_x0 = slope[0];
    const vector slope_x1 = slope[1];
    const vector slope_x2 = slope[2];
    const vector slope_x3 = slope[3];
    const vector product = 0.5 * slope_x1;
    const vector product_2 = 0.5 * slope_x2;
    const vector product_3 = 0.5 * slope_x0;
    const vector product_4 = 0.5 * slope_x3;
    gradient[0] = x0 * product + x3 * product_2 - x1 * product_3 - x2 * product_4;
    gradient[1] = x0 * product_2 + x1 * product_4 - x2 * product_3 - x3 * product;
    gradient[2] = x2 * product + x0 * product_4 - x3 * product_3 - x1 * product_2;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp(
    const vector *x, const vector *gradient_bar, vector *slope_bar) {
    const vector x0 = x[0];
    const vector x1 = x[1];
    const vector x2 = x[2];
    const vector x3 = x[3];
    const vector gradient_bar0 = gradient_bar[0];
    const vector gradient_bar1 = gradient_bar[1];
    const vector gradient_bar2 = gradient_bar[2];
    const vector product = 0.5 * (-(x3 * gradient_bar2) - x2 * gradient_bar1 - x1 * gradient_bar0);
    slope_bar[0] = product;
    slope_bar[1] = 0.5 * (x2 * gradient_bar2 - x3 * gradient_bar1 + x0 * gradient_bar0);
    slope_bar[2] = 0.5 * (x0 * gradient_bar1 - x1 * gradient_bar2 + x3 * gradient_bar0);
    slope_bar[3] = 0.5 * (x0 * gradient_bar2 + x1 * gradient_bar1 - x2 * gradient_bar0);
}

/*
 * Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
 * w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
 * eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
 * Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
 * r = R h = W (tangent part of x), phi = amplitude a^k exp(-a^2 |r|^2 / 2)
 */
INLINE void pair_backward(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *sums) {
    struct { vector g0, abs_g0_gap, eta, a, a_squared, r0, r1, r2, square, gaussian; } kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 9 * (size_t)near[i];
        const vector x0 = X[0];
        const vector x1 = X[1];
        const vector x2 = X[2];
        const vector x3 = X[3];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const vector g0 = x0 * mu0 + x1 * mu1 + x2 * mu2 + x3 * mu3;
        const vector abs_g0 = abs_each(g0);
        const vector abs_g0_gap = 1.0 - abs_g0;
        const vector eta = vector_polynomial_eta(abs_g0_gap);
        const vector a = 1.0 / (abs_g0 - eta * (1.0 - abs_g0 * abs_g0));
        kept[i].g0 = g0;
        kept[i].abs_g0_gap = abs_g0_gap;
        kept[i].eta = eta;
        kept[i].a = a;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 9 * (size_t)near[i];
        const vector a = kept[i].a;
        const vector x0 = X[0];
        const vector x1 = X[1];
        const vector x2 = X[2];
        const vector x3 = X[3];
        const double R0_3 = S[5];
        const double R0_0 = S[6];
        const double R0_2 = S[7];
        const double R0_1 = S[8];
        const double R1_3 = S[9];
        const double R1_0 = S[10];
        const double R1_2 = S[11];
        const double R1_1 = S[12];
        const double R2_3 = S[13];
        const double R2_0 = S[14];
        const double R2_2 = S[15];
        const double R2_1 = S[16];
        const vector a_squared = a * a;
        const vector r0 = x0 * R0_0 + x1 * R0_1 + x2 * R0_2 + x3 * R0_3;
        const vector r1 = x0 * R1_0 + x1 * R1_1 + x2 * R1_2 + x3 * R1_3;
        const vector r2 = x0 * R2_0 + x1 * R2_1 + x2 * R2_2 + x3 * R2_3;
        const vector square = a_squared * (r0 * r0 + r1 * r1 + r2 * r2);
        const vector gaussian = gaussian_each(square);
        kept[i].a_squared = a_squared;
        kept[i].r0 = r0;
        kept[i].r1 = r1;
        kept[i].r2 = r2;
        kept[i].square = square;
        kept[i].gaussian = gaussian;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 9 * (size_t)near[i];
        const vector *value_bar = points + 9 * (size_t)near[i] + 4;
        const vector *slope_bar = points + 9 * (size_t)near[i] + 4 + 1;
        const vector g0 = kept[i].g0;
        const vector abs_g0_gap = kept[i].abs_g0_gap;
        const vector eta = kept[i].eta;
        const vector a = kept[i].a;
        const vector a_squared = kept[i].a_squared;
        const vector r0 = kept[i].r0;
        const vector r1 = kept[i].r1;
        const vector r2 = kept[i].r2;
        const vector square = kept[i].square;
        const vector gaussian = kept[i].gaussian;
        const vector x0 = X[0];
        const vector x1 = X[1];
        const vector x2 = X[2];
        const vector x3 = X[3];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double R0_3 = S[5];
        const double R0_0 = S[6];
        const double R0_2 = S[7];
        const double R0_1 = S[8];
        const double R1_3 = S[9];
        const double R1_0 = S[10];
        const double R1_2 = S[11];
        const double R1_1 = S[12];
        const double R2_3 = S[13];
        const double R2_0 = S[14];
        const double R2_2 = S[15];
        const double R2_1 = S[16];
        const vector its_value_bar = value_bar[0];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector x2_bar = slope_bar[2];
        const vector x3_bar = slope_bar[3];
        const vector_mask is_small = g0 < 0.0;
        const vector phi = a * (a * gaussian);
        const vector gap = 2.0 * phi - phi * square;
        const vector by_abs_g0 = eta * gap;
        const vector by_g0 = vector_select(is_small, -by_abs_g0, by_abs_g0);
        const vector eta_slope = vector_polynomial_eta_slope(abs_g0_gap);
        const vector by_by_g0 = mu0 * x0_bar + mu1 * x1_bar + mu2 * x2_bar + mu3 * x3_bar;
        const vector by_by_abs_g0 = vector_select(is_small, vector_of(0.0), by_by_g0) - vector_select(is_small,
            by_by_g0, vector_of(0.0));
        const vector minus = -((R0_3 * r0 + R1_3 * r1 + R2_3 * r2) * x3_bar);
        const vector gap_2 = minus - (R0_2 * r0 + R1_2 * r1 + R2_2 * r2) * x2_bar;
        const vector gap_3 = gap_2 - (R0_1 * r0 + R1_1 * r1 + R2_1 * r2) * x1_bar;
        const vector gap_4 = gap_3 - (R0_0 * r0 + R1_0 * r1 + R2_0 * r2) * x0_bar;
        const vector eta_product = eta * by_by_abs_g0;
        const vector by_phi = its_value_bar + a_squared * gap_4 - square * eta_product + 2.0 * eta_product;
        const vector phi_product = phi * by_phi;
        const vector gap_5 = -2.0 * (phi * eta_product) - phi_product;
        const vector eta_product_2 = eta * (2.0 * a_squared * (phi * gap_4) + 2.0 * phi_product + square * gap_5);
        const vector by_abs_g0_2 = eta_slope * (gap * by_by_abs_g0) + eta_product_2;
        const vector by_g0_2 = vector_select(is_small, -by_abs_g0_2, by_abs_g0_2);
        const vector product = 0.5 * (a_squared * gap_5);
        const vector phi_product_2 = phi * a_squared;
        const vector gap_6 = x0 * product - phi_product_2 * x0_bar;
        const vector gap_7 = x1 * product - phi_product_2 * x1_bar;
        const vector gap_8 = x2 * product - phi_product_2 * x2_bar;
        const vector gap_9 = x3 * product - phi_product_2 * x3_bar;
        sums[0] = sums[0] + by_g0 * x0_bar + x0 * by_g0_2;
        sums[1] = sums[1] + by_g0 * x1_bar + x1 * by_g0_2;
        sums[2] = sums[2] + by_g0 * x2_bar + x2 * by_g0_2;
        sums[3] = sums[3] + by_g0 * x3_bar + x3 * by_g0_2;
        sums[4] = sums[4] + phi_product;
        sums[5] = sums[5] + x0 * gap_6;
        sums[6] = sums[6] + x0 * gap_7 + x1 * gap_6;
        sums[7] = sums[7] + x0 * gap_8 + x2 * gap_6;
        sums[8] = sums[8] + x0 * gap_9 + x3 * gap_6;
        sums[9] = sums[9] + x1 * gap_7;
        sums[10] = sums[10] + x1 * gap_8 + x2 * gap_7;
        sums[11] = sums[11] + x1 * gap_9 + x3 * gap_7;
        sums[12] = sums[12] + x2 * gap_8;
        sums[13] = sums[13] + x2 * gap_9 + x3 * gap_8;
        sums[14] = sums[14] + x3 * gap_9;
    }
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp(
    const vector *mu, const vector *W, const vector *amplitude, const vector *sums, vector *mu_bar, vector *W_bar, vector *amplitude_bar) {
    const vector mu0 = mu[0];
    const vector mu1 = mu[1];
    const vector mu2 = mu[2];
    const vector mu3 = mu[3];
    const vector W0_0 = W[0];
    const vector W0_1 = W[1];
    const vector W0_2 = W[2];
    const vector W1_0 = W[3];
    const vector W1_1 = W[4];
    const vector W1_2 = W[5];
    const vector W2_0 = W[6];
    const vector W2_1 = W[7];
    const vector W2_2 = W[8];
    const vector its_amplitude = amplitude[0];
    const vector sum0 = sums[0];
    const vector sum1 = sums[1];
    const vector sum2 = sums[2];
    const vector sum3 = sums[3];
    const vector sum4 = sums[4];
    const vector sum5 = sums[5];
    const vector sum6 = sums[6];
    const vector sum7 = sums[7];
    const vector sum8 = sums[8];
    const vector sum9 = sums[9];
    const vector sum10 = sums[10];
    const vector sum11 = sums[11];
    const vector sum12 = sums[12];
    const vector sum13 = sums[13];
    const vector sum14 = sums[14];
    const vector product = 2.0 * mu3;
    const vector product_2 = 2.0 * mu2;
    const vector product_3 = 2.0 * mu1;
    const vector R2_0 = -(W2_2 * product) - W2_1 * product_2 - W2_0 * product_3;
    const vector product_4 = 2.0 * mu0;
    const vector R2_1 = W2_2 * product_2 - W2_1 * product + W2_0 * product_4;
    const vector product_5 = 2.0 * sum9;
    const vector R2_2 = W2_1 * product_4 - W2_2 * product_3 + W2_0 * product;
    const vector R2_3 = W2_2 * product_4 + W2_1 * product_3 - W2_0 * product_2;
    const vector by_R2_1 = R2_0 * sum6 + R2_1 * product_5 + R2_2 * sum10 + R2_3 * sum11;
    const vector R1_0 = -(W1_2 * product) - W1_1 * product_2 - W1_0 * product_3;
    const vector R1_1 = W1_2 * product_2 - W1_1 * product + W1_0 * product_4;
    const vector R1_2 = W1_1 * product_4 - W1_2 * product_3 + W1_0 * product;
    const vector R1_3 = W1_2 * product_4 + W1_1 * product_3 - W1_0 * product_2;
    const vector by_R1_1 = R1_0 * sum6 + R1_1 * product_5 + R1_2 * sum10 + R1_3 * sum11;
    const vector R0_0 = -(W0_2 * product) - W0_1 * product_2 - W0_0 * product_3;
    const vector R0_1 = W0_2 * product_2 - W0_1 * product + W0_0 * product_4;
    const vector R0_2 = W0_1 * product_4 - W0_2 * product_3 + W0_0 * product;
    const vector R0_3 = W0_2 * product_4 + W0_1 * product_3 - W0_0 * product_2;
    const vector by_R0_1 = R0_0 * sum6 + R0_1 * product_5 + R0_2 * sum10 + R0_3 * sum11;
    const vector product_6 = 2.0 * sum12;
    const vector by_R2_2 = R2_0 * sum7 + R2_1 * sum10 + R2_2 * product_6 + R2_3 * sum13;
    const vector by_R1_2 = R1_0 * sum7 + R1_1 * sum10 + R1_2 * product_6 + R1_3 * sum13;
    const vector total_2 = W2_0 * by_R2_1 + W1_0 * by_R1_1 + W0_0 * by_R0_1 + W2_1 * by_R2_2 + W1_1 * by_R1_2;
    const vector by_R0_2 = R0_0 * sum7 + R0_1 * sum10 + R0_2 * product_6 + R0_3 * sum13;
    const vector product_7 = 2.0 * sum14;
    const vector by_R2_3 = R2_0 * sum8 + R2_1 * sum11 + R2_2 * sum13 + R2_3 * product_7;
    const vector by_R1_3 = R1_0 * sum8 + R1_1 * sum11 + R1_2 * sum13 + R1_3 * product_7;
    const vector by_R0_3 = R0_0 * sum8 + R0_1 * sum11 + R0_2 * sum13 + R0_3 * product_7;
    const vector total_3 = total_2 + W0_1 * by_R0_2 + W2_2 * by_R2_3 + W1_2 * by_R1_3 + W0_2 * by_R0_3;
    const vector product_8 = 2.0 * sum5;
    const vector by_R2_0 = R2_0 * product_8 + R2_1 * sum6 + R2_2 * sum7 + R2_3 * sum8;
    const vector by_R1_0 = R1_0 * product_8 + R1_1 * sum6 + R1_2 * sum7 + R1_3 * sum8;
    const vector by_R0_0 = R0_0 * product_8 + R0_1 * sum6 + R0_2 * sum7 + R0_3 * sum8;
    const vector gap = -(W2_0 * by_R2_0) - W1_0 * by_R1_0 - W0_0 * by_R0_0 - W2_2 * by_R2_2;
    const vector total_4 = gap - W1_2 * by_R1_2 - W0_2 * by_R0_2 + W2_1 * by_R2_3 + W1_1 * by_R1_3;
    const vector product_9 = its_amplitude * (sum1 + 2.0 * (total_4 + W0_1 * by_R0_3));
    const vector total_5 = -(W2_1 * by_R2_0) - W1_1 * by_R1_0 - W0_1 * by_R0_0 + W2_2 * by_R2_1;
    const vector gap_2 = total_5 + W1_2 * by_R1_1 + W0_2 * by_R0_1 - W2_0 * by_R2_3 - W1_0 * by_R1_3;
    const vector product_10 = its_amplitude * (sum2 + 2.0 * (gap_2 - W0_0 * by_R0_3));
    const vector gap_3 = -(W2_2 * by_R2_0) - W1_2 * by_R1_0 - W0_2 * by_R0_0 - W2_1 * by_R2_1;
    const vector total_6 = gap_3 - W1_1 * by_R1_1 - W0_1 * by_R0_1 + W2_0 * by_R2_2 + W1_0 * by_R1_2;
    const vector product_11 = its_amplitude * (sum3 + 2.0 * (total_6 + W0_0 * by_R0_2));
    const vector product_12 = its_amplitude * (product_4 * by_R0_1 - product_3 * by_R0_0 + product * by_R0_2 -
        product_2 * by_R0_3);
    const vector total_7 = -(product_2 * by_R0_0) - product * by_R0_1 + product_4 * by_R0_2 + product_3 *
        by_R0_3;
    const vector product_13 = its_amplitude * (product_2 * by_R0_1 - product * by_R0_0 - product_3 * by_R0_2 +
        product_4 * by_R0_3);
    const vector product_14 = its_amplitude * (product_4 * by_R1_1 - product_3 * by_R1_0 + product * by_R1_2 -
        product_2 * by_R1_3);
    const vector total_8 = -(product_2 * by_R1_0) - product * by_R1_1 + product_4 * by_R1_2 + product_3 *
        by_R1_3;
    const vector product_15 = its_amplitude * (product_2 * by_R1_1 - product * by_R1_0 - product_3 * by_R1_2 +
        product_4 * by_R1_3);
    const vector product_16 = its_amplitude * (product_4 * by_R2_1 - product_3 * by_R2_0 + product * by_R2_2 -
        product_2 * by_R2_3);
    const vector total_9 = -(product_2 * by_R2_0) - product * by_R2_1 + product_4 * by_R2_2 + product_3 *
        by_R2_3;
    const vector product_17 = its_amplitude * (product_2 * by_R2_1 - product * by_R2_0 - product_3 * by_R2_2 +
        product_4 * by_R2_3);
    mu_bar[0] = its_amplitude * (sum0 + 2.0 * total_3);
    mu_bar[1] = product_9;
    mu_bar[2] = product_10;
    mu_bar[3] = product_11;
    W_bar[0] = product_12;
    W_bar[1] = its_amplitude * total_7;
    W_bar[2] = product_13;
    W_bar[3] = product_14;
    W_bar[4] = its_amplitude * total_8;
    W_bar[5] = product_15;
    W_bar[6] = product_16;
    W_bar[7] = its_amplitude * total_9;
    W_bar[8] = product_17;
    amplitude_bar[0] = sum4;
}

/* The distances of some points q from one point p. */
OUTLINE void pair_distances(
    const double *p, const vector *q, vector *distance) {
    const double p0 = p[0];
    const double p1 = p[1];
    const double p2 = p[2];
    const double p3 = p[3];
    const vector q0 = q[0];
    const vector q1 = q[1];
    const vector q2 = q[2];
    const vector q3 = q[3];
    const vector g0 = p0 * q0 + p1 * q1 + p2 * q2 + p3 * q3;
    const vector g1 = p0 * q1 + p3 * q2 - p1 * q0 - p2 * q3;
    const vector g2 = p0 * q2 + p1 * q3 - p2 * q0 - p3 * q1;
    const vector g3 = p0 * q3 + p2 * q1 - p1 * q2 - p3 * q0;
    const vector norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const vector norm_s = sqrt_each(norm_s_squared);
    const vector abs_g0 = abs_each(g0);
    const vector atan2_norm_s_abs_g0 = atan2_each(norm_s, abs_g0);
    const vector t = 2.0 * atan2_norm_s_abs_g0;
    distance[0] = t;
}

/* The numbers of LANES rows from `start` on, transposed; past the end, the last row again. */
OUTLINE void vector_rows(const double *rows, size_t count, size_t start, size_t size, vector *columns) {
    for (size_t i = 0; i < size; ++i) {
        double column[LANES];
        for (size_t lane = 0; lane < LANES; ++lane)
            column[lane] = rows[size * (start + lane < count ? start + lane : count - 1) + i];
        columns[i] = vector_load(column);
    }
}

/* Back to rows that are `stride` apart; nothing past the end. */
OUTLINE void vector_to_rows(
    const vector *columns, double *rows, size_t count, size_t start, size_t size, size_t stride) {
    const size_t lanes = start >= count ? 0 : count - start < LANES ? count - start : LANES;
    for (size_t lane = 0; lane < lanes; ++lane)
        for (size_t i = 0; i < size; ++i) rows[stride * (start + lane) + i] = LANE(columns[i], lane);
}

/* Zero in the lanes past the end. */
OUTLINE void vector_end(size_t count, size_t start, size_t size, vector *columns) {
    for (size_t lane = start >= count ? 0 : count - start; lane < LANES; ++lane)
        for (size_t i = 0; i < size; ++i) LANE(columns[i], lane) = 0;
}

/* Scratch memory: 9 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t so3_splats_work(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES - 1) / LANES, blocks = (points + 2 - 1) / 2;
    const size_t places = 5 * ((splat_count + LANES - 1) / LANES + (blocks + LANES - 1) / LANES);
    return (points * 9 + places + 1) * LANES + 17 * splat_count;
}

static vector *work_points(double *work) {
    const uintptr_t size = sizeof(vector), start = (uintptr_t)work;
    return (vector *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const double *splat_at(const vector *splats, size_t k) {
    const size_t row = k / LANES;
    return (const double *)(splats + 5 * row) + (k - row * LANES);
}

static vector *work_reaches(double *work, size_t count) {
    return work_points(work) + (count + LANES - 1) / LANES * 9;
}

static vector *work_blocks(double *work, size_t count, size_t splat_count) {
    return work_reaches(work, count) + 5 * ((splat_count + LANES - 1) / LANES);
}

static double *work_constants(double *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES, blocks = (count + size - 1) / size;
    return (double *)(work_blocks(work, count, splat_count) + 5 * ((blocks + LANES - 1) / LANES));
}

/* Zero, or NaN where a number is not finite: what has one is near everything. */
INLINE vector vector_spoilt(const vector *x, size_t size) {
    vector sum = ZERO;
    for (size_t i = 0; i < size; ++i) sum += x[i] - x[i];
    return sum;
}

/* mu and reach of LANES splats, side by side. */
OUTLINE void splat_reach(
    const vector *mu, const vector *amplitude, const double *width, size_t splat_count, size_t start, vector *splats) {
    vector *own = splats + start / LANES * (4 + 1);
    vector_rows(width, splat_count, start, 1, own + 4);
    own[4] = own[4] * 9.115346828320313 + vector_spoilt(mu, 4) + vector_spoilt(amplitude, 1);
    for (int i = 0; i < 4; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place(const double *x, size_t count, size_t start, double *place) {
    const size_t size = count - start < 2 * LANES ? count - start : 2 * LANES;
    vector at[2][4], spoilt = ZERO;
    for (size_t b = 0; b < 2; ++b) {
        vector_rows(x, count, start + b * LANES, 4, at[b]);
        spoilt += vector_spoilt(at[b], 4);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const double *middle = x + 4 * (start + i * size / 8);
        double radius = 0, column[LANES];
        for (size_t b = 0; b < 2; ++b) {
            vector distance[1];
            pair_distances(middle, at[b], distance);
            vector_store(column, distance[0]);
            for (size_t lane = 0; lane < LANES; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[4]) {
            for (int j = 0; j < 4; ++j) place[j] = middle[j];
            place[4] = radius;
        }
    }
    place[4] = place[4] * 1.0078125 + vector_sum(spoilt);
}

/* Where a splat is too far from all of a block; never where a distance is not a number. */
INLINE vector_mask vector_far(vector distance, vector reach, vector radius) {
    return (distance > reach + radius);
}

/* The splats from `first` (a multiple of LANES) to `end` that are near a block, all if there is none; how many. */
OUTLINE size_t splats_near(const double *place, const vector *splats, size_t first, size_t end, uint32_t *near) {
    size_t size = 0;
    if (!place) {
        for (size_t k = first; k < end; ++k) near[size++] = (uint32_t)k;
        return size;
    }
    for (size_t start = first; start < end; start += LANES) {
        const vector *own = splats + start / LANES * (4 + 1);
        vector distance[1];
        pair_distances(place, own, distance);
        const vector_mask far = vector_far(distance[0], own[4], vector_of(place[4]));
        const size_t lanes = end - start < LANES ? end - start : LANES;
        for (size_t lane = 0; lane < lanes; ++lane) {
            near[size] = (uint32_t)(start + lane);
            size += !LANE(far, lane);
        }
    }
    return size;
}

/* The vectors of points from `first` to `end` whose blocks are near a splat, all if there are none, less `first`. */
OUTLINE size_t blocks_near(
    const double *mu, const double *reach, const vector *blocks, size_t first, size_t end, uint32_t *near) {
    const size_t group = 2 * LANES;  // vectors of points whose middles are one vector
    size_t size = 0;
    if (!reach) {
        for (size_t b = first; b < end; ++b) near[size++] = (uint32_t)(b - first);
        return size;
    }
    for (size_t start = first / group * group; start < end; start += group) {
        const vector *own = blocks + start / group * (4 + 1);
        vector distance[1];
        pair_distances(mu, own, distance);
        const vector_mask far = vector_far(distance[0], vector_of(*reach), own[4]);
        for (size_t lane = 0; lane < group; ++lane) {
            const size_t b = start + lane;
            near[size] = (uint32_t)(b - first);
            size += b >= first && b < end && !LANE(far, lane / 2);
        }
    }
    return size;
}

/* The constants of LANES splats, as rows; with `width`, how far they reach. */
OUTLINE void splat_constants(
    size_t splat_count, size_t start, const double *mu, const double *W, const double *amplitude, const double *width, double *constants,
    vector *splats) {
    vector own_mu[4], own_W[9], own_amplitude[1], S[17];
    vector_rows(mu, splat_count, start, 4, own_mu);
    vector_rows(W, splat_count, start, 9, own_W);
    vector_rows(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants(own_mu, own_W, own_amplitude, S);
    vector_to_rows(S, constants, splat_count, start, 17, 17);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void so3_splats(
    size_t count, size_t splat_count, const double *SO3_RESTRICT x, const double *SO3_RESTRICT mu, const double *SO3_RESTRICT W, const double *SO3_RESTRICT amplitude, const double *SO3_RESTRICT width,
    double *SO3_RESTRICT value, double *SO3_RESTRICT gradient, double *SO3_RESTRICT work, int threads) {
    (void)threads;
    double *constants = work_constants(work, 0, splat_count);
    vector *splats = work_reaches(work, 0);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += LANES)
            splat_constants(splat_count, start, mu, W, amplitude, width, constants, splats);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < count; start += 2 * LANES) {
            vector at[2][4], X[2 * 4], grad[3];
            vector value_sum[2] = {ZERO}, slope_sum[2 * 4] = {ZERO};
            double place[4 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 4, at[b]);
                pair_features(at[b], X + 4 * b);
            }
            if (width) block_place(x, count, start, place);
            for (size_t first = 0; first < splat_count; first += 256) {
                const size_t end = splat_count - first < 256 ? splat_count : first + 256;
                const size_t size = splats_near(width ? place : NULL, splats, first, end, near);
                for (size_t i = 0; i < size; i += 8) {
                    const size_t some = size - i < 8 ? size - i : 8;
                    pair_forward(some, X, constants, near + i, value_sum, slope_sum);
                }
            }
            for (size_t b = 0; b < 2; ++b) {
                pair_gradient(at[b], slope_sum + 4 * b, grad);
                vector_to_rows(value_sum + b, value, count, start + b * LANES, 1, 1);
                vector_to_rows(grad, gradient, count, start + b * LANES, 3, 3);
            }
        }
        restore_denormals(mode);
    }
}

void so3_splats_value(
    size_t count, size_t splat_count, const double *SO3_RESTRICT x, const double *SO3_RESTRICT mu, const double *SO3_RESTRICT W, const double *SO3_RESTRICT amplitude, const double *SO3_RESTRICT width,
    double *SO3_RESTRICT value, double *SO3_RESTRICT work, int threads) {
    (void)threads;
    double *constants = work_constants(work, 0, splat_count);
    vector *splats = work_reaches(work, 0);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += LANES)
            splat_constants(splat_count, start, mu, W, amplitude, width, constants, splats);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < count; start += 2 * LANES) {
            vector at[4], X[2 * 4], value_sum[2] = {ZERO};
            double place[4 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 4, at);
                pair_features(at, X + 4 * b);
            }
            if (width) block_place(x, count, start, place);
            for (size_t first = 0; first < splat_count; first += 256) {
                const size_t end = splat_count - first < 256 ? splat_count : first + 256;
                const size_t size = splats_near(width ? place : NULL, splats, first, end, near);
                for (size_t i = 0; i < size; i += 8) {
                    const size_t some = size - i < 8 ? size - i : 8;
                    pair_value(some, X, constants, near + i, value_sum);
                }
            }
            for (size_t b = 0; b < 2; ++b)
                vector_to_rows(value_sum + b, value, count, start + b * LANES, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* What backward reads of LANES points: X, value_bar, slope_bar; the adjoints past the end are zero. */
OUTLINE void splat_points(
    size_t count, size_t start, const double *x, const double *value_bar, const double *gradient_bar, vector *point) {
    vector at[4], grad_bar[3], slope_bar[4];
    vector_rows(x, count, start, 4, at);
    vector_rows(gradient_bar, count, start, 3, grad_bar);
    vector_rows(value_bar, count, start, 1, point + 4);
    pair_features(at, point);
    pair_gradient_vjp(at, grad_bar, slope_bar);
    for (int i = 0; i < 4; ++i) point[4 + 1 + i] = slope_bar[i];
    vector_end(count, start, 4 + 1, point + 4);
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums(const vector *points, const uint32_t *near, size_t size, const double *S, double *sums) {
    vector sum[15] = {ZERO};
    for (size_t b = 0; b < size; b += 16)
        pair_backward(size - b < 16 ? size - b : 16, points, near + b, S, sum);
    sums[0] += vector_sum(sum[0]);
    sums[1] += vector_sum(sum[1]);
    sums[2] += vector_sum(sum[2]);
    sums[3] += vector_sum(sum[3]);
    sums[4] += vector_sum(sum[4]);
    sums[5] += vector_sum(sum[5]);
    sums[6] += vector_sum(sum[6]);
    sums[7] += vector_sum(sum[7]);
    sums[8] += vector_sum(sum[8]);
    sums[9] += vector_sum(sum[9]);
    sums[10] += vector_sum(sum[10]);
    sums[11] += vector_sum(sum[11]);
    sums[12] += vector_sum(sum[12]);
    sums[13] += vector_sum(sum[13]);
    sums[14] += vector_sum(sum[14]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void so3_splats_vjp(
    size_t count, size_t splat_count, const double *SO3_RESTRICT x, const double *SO3_RESTRICT mu, const double *SO3_RESTRICT W, const double *SO3_RESTRICT amplitude, const double *SO3_RESTRICT width, const double *SO3_RESTRICT value_bar, const double *SO3_RESTRICT gradient_bar,
    double *SO3_RESTRICT mu_bar, double *SO3_RESTRICT W_bar, double *SO3_RESTRICT amplitude_bar, double *SO3_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES - 1) / LANES;
    const size_t chunk = 131072 / (9 * sizeof(vector)) + 1;
    const size_t rows = ((blocks + 2 - 1) / 2 + LANES - 1) / LANES * LANES;
    const size_t part = splat_count / (4 * (size_t)(threads > 1 ? threads : 1)) + 1;
    const size_t share = part < LANES ? part : LANES;
    vector *points = work_points(work);
    vector *splats = work_reaches(work, count), *places = work_blocks(work, count, splat_count);
    double *constants = work_constants(work, count, splat_count);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic) nowait)
        for (size_t start = 0; start < splat_count; start += LANES)
            splat_constants(splat_count, start, mu, W, amplitude, width, constants, splats);
        if (width) {
            OMP(omp for schedule(dynamic, 8) nowait)
            for (size_t block = 0; block < rows; ++block) {
                double place[4 + 1];
                const size_t last = (blocks - 1) / 2, start = (block < last ? block : last) * 2;
                block_place(x, count, start * LANES, place);
                for (int i = 0; i < 5; ++i) {
                    double *row = (double *)(places + block / LANES * 5 + i);
                    row[block - block / LANES * LANES] = place[i];
                }
            }
        }
        OMP(omp for schedule(dynamic, 8))
        for (size_t block = 0; block < blocks; ++block)
            splat_points(count, block * LANES, x, value_bar, gradient_bar, points + 9 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            double sums[LANES][15] = {{0}};
            uint32_t near[131072 / (9 * sizeof(vector)) + 2];
            vector own_mu[4], own_W[9], own_amplitude[1], own_sums[15], bars[14];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const double *reach = width ? splat_at(splats, k) + 4 * LANES : NULL;
                    const size_t some = blocks_near(mu + 4 * k, reach, places, first, first + size, near);
                    splat_sums(points + 9 * first, near, some, constants + 17 * k, sums[k - start]);
                }
            }
            vector_rows(mu, end, start, 4, own_mu);
            vector_rows(W, end, start, 9, own_W);
            vector_rows(amplitude, end, start, 1, own_amplitude);
            vector_rows(sums[0], LANES, 0, 15, own_sums);
            pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 4, bars + 4 + 9);
            vector_to_rows(bars, mu_bar, end, start, 4, 4);
            vector_to_rows(bars + 4, W_bar, end, start, 9, 9);
            vector_to_rows(bars + 4 + 9, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void so3_splats_rows(
    size_t count, size_t splat_count, const double *SO3_RESTRICT x, const double *SO3_RESTRICT mu, const double *SO3_RESTRICT W, const double *SO3_RESTRICT amplitude, const double *SO3_RESTRICT value_bar, const double *SO3_RESTRICT gradient_bar,
    double *SO3_RESTRICT rows, double *SO3_RESTRICT work, int threads) {
    (void)threads;
    const size_t blocks = (count + LANES - 1) / LANES;
    const uint32_t only = 0;
    double *constants = work_constants(work, 0, splat_count);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += LANES)
            splat_constants(splat_count, start, mu, W, amplitude, NULL, constants, NULL);
        OMP(omp for schedule(dynamic))
        for (size_t block = 0; block < blocks; ++block) {
            vector point[9];
            splat_points(count, block * LANES, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector own_mu[4], own_W[9], own_amplitude[1], own_sums[15] = {ZERO}, bars[14];
                for (int i = 0; i < 4; ++i) own_mu[i] = vector_of(mu[4 * k + i]);
                for (int i = 0; i < 9; ++i) own_W[i] = vector_of(W[9 * k + i]);
                own_amplitude[0] = vector_of(amplitude[k]);
                pair_backward(1, point, &only, constants + 17 * k, own_sums);
                pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 4, bars + 4 + 9);
                vector_to_rows(bars, rows + 14 * k, count, block * LANES, 14, 14 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

/* A coordinate to sort by. */
INLINE double order_key(const double *x, size_t row, size_t axis) {
    const double key = x[4 * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest(const double *x, const size_t *order, size_t count) {
    double low[4], high[4];
    size_t widest = 0;
    for (size_t axis = 0; axis < 4; ++axis) low[axis] = high[axis] = order_key(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < 4; ++axis) {
            const double key = order_key(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < 4; ++axis)
        if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
    return widest;
}

/* Order points and their keys such that none of the first `part` has a larger key than one of the others. */
static void split_at(double *keys, size_t *order, size_t count, size_t part) {
    size_t low = 0, high = count;  // the part-th smallest key is in [low, high)
    while (high - low > 1) {
        const double a = keys[low], b = keys[low + (high - low) / 2], c = keys[high - 1];
        const double least = a < b ? a : b, most = a < b ? b : a, pivot = c < least ? least : c > most ? most : c;
        size_t less = low, equal = low;
        for (int inclusive = 0; inclusive < 2; ++inclusive) {  // without branches, which nobody can foresee
            size_t end = equal = less;
            for (; end < high; ++end) {
                const double key = keys[end];
                const size_t row = order[end];
                keys[end] = keys[equal], order[end] = order[equal];
                keys[equal] = key, order[equal] = row;
                equal += inclusive ? key <= pivot : key < pivot;
            }
            if (!inclusive) less = equal;
            if (part < less) break;
        }
        if (part < less)
            high = less;
        else if (part < equal)
            return;
        else
            low = equal;
    }
}

/* Halve points at their medians until they are blocks. */
static void sorted_blocks(const double *x, size_t *order, size_t count, double *keys) {
    const size_t block = 2 * LANES;
    while (count > block) {
        const size_t part = ((count + block - 1) / block + 1) / 2 * block, axis = widest(x, order, count);
        for (size_t i = 0; i < count; ++i) keys[i] = order_key(x, order[i], axis);
        split_at(keys, order, count, part);
        sorted_blocks(x, order + part, count - part, keys);
        count = part;
    }
}

double so3_splats_order(
    size_t count, size_t splat_count, const double *SO3_RESTRICT x, const double *SO3_RESTRICT mu, const double *SO3_RESTRICT amplitude, const double *SO3_RESTRICT width,
    double limit, size_t *SO3_RESTRICT order, double *SO3_RESTRICT work) {
    const size_t block = 2 * LANES;
    vector *splats = work_reaches(work, 0);
    uint32_t near[256];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES) {
        vector own_mu[4], own_amplitude[1];
        vector_rows(mu, splat_count, start, 4, own_mu);
        vector_rows(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks(x, order, count, (double *)work_blocks(work, 0, splat_count));
        for (size_t i = 1; i < 2 * 16; i += 2) {
            double rows[2 * LANES * 4], place[4 + 1];
            const size_t some = i * count / (2 * 16), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < 4; ++j) rows[4 * n + j] = x[4 * order[start + n] + j];
            block_place(rows, size, 0, place);
            for (size_t first = 0; first < splat_count; first += 256) {
                const size_t end = splat_count - first < 256 ? splat_count : first + 256;
                pairs += splats_near(place, splats, first, end, near);
            }
        }
        share = (double)pairs / ((double)splat_count * 16);
        if (share > limit) return share;
    }
    return share;
}

#endif /* double */

#if !defined(RSRM_ONLY_DOUBLE) /* float */

/* The same number in all lanes. */
INLINE vector_f vector_of_f(float x) {
    const vector_f zero = ZERO;
    return x - zero;
}

/* x in the lanes of the mask, y in the others; clang knows this by its bits, gcc as a loop. */
INLINE vector_f vector_select_f(vector_mask_f mask, vector_f x, vector_f y) {
#if defined(__clang__) && !defined(RSRM_NO_VECTORS)
    return (vector_f)((mask & (vector_mask_f)x) | (~mask & (vector_mask_f)y));
#else
    EACH_LANE for (size_t i = 0; i < LANES_f; ++i) LANE(x, i) = LANE(mask, i) ? LANE(x, i) : LANE(y, i);
    return x;
#endif
}

/* Numbers in memory to a vector, and back. */
INLINE vector_f vector_load_f(const float *from) {
    vector_f x;
    memcpy(&x, from, sizeof x);
    return x;
}
INLINE void vector_store_f(float *to, vector_f x) { memcpy(to, &x, sizeof x); }

/* The sum over the lanes, by halves. */
INLINE float vector_sum_f(vector_f x) {
    float lanes[LANES_f];
    vector_store_f(lanes, x);
    for (size_t half = LANES_f / 2; half > 0; half /= 2)
        for (size_t i = 0; i < half; ++i) lanes[i] += lanes[i + half];
    return lanes[0];
}

/* The bits of a vector as integers, and back. */
INLINE vector_bits_f vector_to_bits_f(vector_f x) {
    vector_bits_f bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
INLINE vector_f vector_from_bits_f(vector_bits_f bits) {
    vector_f x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* x >= 0 with the sign of another. */
INLINE vector_f signed_each_f(vector_f x, vector_f sign) {
    return vector_from_bits_f(vector_to_bits_f(x) | (vector_to_bits_f(sign) & 0x80000000));
}

/* abs of every lane; one instruction where the machine has it. */
INLINE vector_f abs_each_f(vector_f x) {
    EACH_LANE for (size_t i = 0; i < LANES_f; ++i) LANE(x, i) = fabsf(LANE(x, i));
    return x;
}

/* sqrt of every lane; one instruction where the machine has it. */
INLINE vector_f sqrt_each_f(vector_f x) {
    EACH_LANE for (size_t i = 0; i < LANES_f; ++i) LANE(x, i) = sqrtf(LANE(x, i));
    return x;
}

/* exp(-s / 2) of s >= 0, as 2^k exp(-r / 2), |r| <= log(2), within 1 unit in the last place; below 1.8e-38 it is 0. */
INLINE vector_f gaussian_each_f(vector_f s) {
    const vector_f shifted = s * -0.7213475204444817f + 12583039.0f, k = shifted - 12583039.0f;
    const vector_f r = (s + k * 1.38629150390625f) + k * 2.8572136406188345e-06f;
    const vector_f part = r * (-0.5f + r * (0.125f + r * (-0.020833221247803655f + r * (0.0026041596642423803f + r * (-0.0002613493009373264f + r * 2.1759659078889598e-05f)))));
    const vector_f scale = vector_from_bits_f(vector_to_bits_f(shifted) << 23); /* 2^k */
    return vector_select_f(s > 173.8f, vector_of_f(0), scale + scale * part);
}

/* atan2, within 3 units in the last place. */
INLINE vector_f atan2_each_f(vector_f y, vector_f x) {
    const vector_f a = abs_each_f(y), b = abs_each_f(x), one = vector_of_f(1);
    const vector_f less = vector_select_f(a > b, b, a), more = vector_select_f(a > b, a, b);
    const vector_f low = vector_select_f(less > 3.4028234663852886e38f, one, less);
    const vector_f high = vector_select_f(less > 3.4028234663852886e38f, one, vector_select_f(more == 0, one, more));
    const vector_f top = vector_select_f(low > 0.4142135623730951f * high, low - high, low);
    const vector_f bottom = vector_select_f(low > 0.4142135623730951f * high, low * 0.5f + high * 0.5f, high * 0.5f);
    const vector_f t = top / bottom * 0.5f, z = t * t;
    const vector_f angle = t + t * z * (-0.33333333279242233f + z * (0.19999977254347343f + z * (-0.14284150959481018f + z * (0.11071360682318138f + z * (-0.08624643784438366f + z * 0.05048055010223574f)))));
    const vector_f first = vector_select_f(low > 0.4142135623730951f * high, 0.7853981852531433f + (angle + -2.1855695000931213e-08f), angle);
    const vector_f second = vector_select_f(a > b, 1.5707963705062866f - (first - -4.3711390001862426e-08f), first);
    const vector_f third = vector_select_f((vector_to_bits_f(x) & 0x80000000) != 0, 3.1415927410125732f - (second - -8.742278000372485e-08f), second);
    return signed_each_f(third, y);
}

/* Of degree 11, within 2^-29 of that of double precision. */
INLINE vector_f vector_polynomial_eta_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return -0.3333333329074172f + x * -0.15555567514484153f + x2 * (-0.07512673968454313f + x *
        -0.036854683410814014f) + x4 * (-0.017172242426810813f + x * -0.013945774438806282f + x2 *
        (0.01253044380771583f + x * -0.03940423726113369f)) + x8 * (0.051921663529563705f + x *
        -0.048257650185791916f + x2 * (0.024694517679698283f + x * -0.006116061322664089f));
}

/* Of degree 13, within 2^-27 of that of double precision. */
INLINE vector_f vector_polynomial_eta_slope_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.15555555542437843f + x * 0.1502646005226573f + x2 * (0.11026136698101077f + x *
        0.07246434664202496f) + x4 * (0.04369556901094827f + x * 0.034436310057583616f + x2 *
        (-0.023420697975480978f + x * 0.13766190227481526f)) + x8 * (-0.2894962884105508f + x *
        0.4671003677933079f + x2 * (-0.49758073887669707f + x * 0.35140202925299413f) + x4 *
        (-0.1460207286663636f + x * 0.028391671210260493f));
}

/* What pairs read of points x. */
OUTLINE void pair_features_f(
    const vector_f *x, vector_f *X) {
    const vector_f x0 = x[0];
    const vector_f x1 = x[1];
    const vector_f x2 = x[2];
    const vector_f x3 = x[3];
    X[0] = x0;
    X[1] = x1;
    X[2] = x2;
    X[3] = x3;
}

/* What pairs read of a splat, of some splats. */
OUTLINE void pair_constants_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, vector_f *S) {
    const vector_f mu0 = mu[0];
    const vector_f mu1 = mu[1];
    const vector_f mu2 = mu[2];
    const vector_f mu3 = mu[3];
    const vector_f W0_0 = W[0];
    const vector_f W0_1 = W[1];
    const vector_f W0_2 = W[2];
    const vector_f W1_0 = W[3];
    const vector_f W1_1 = W[4];
    const vector_f W1_2 = W[5];
    const vector_f W2_0 = W[6];
    const vector_f W2_1 = W[7];
    const vector_f W2_2 = W[8];
    const vector_f its_amplitude = amplitude[0];
    const vector_f product = 2.0f * mu0;
    const vector_f product_2 = 2.0f * mu1;
    const vector_f product_3 = 2.0f * mu2;
    const vector_f R0_3 = W0_2 * product + W0_1 * product_2 - W0_0 * product_3;
    const vector_f product_4 = 2.0f * mu3;
    const vector_f R0_0 = -(W0_2 * product_4) - W0_1 * product_3 - W0_0 * product_2;
    const vector_f R0_2 = W0_1 * product - W0_2 * product_2 + W0_0 * product_4;
    const vector_f R0_1 = W0_2 * product_3 - W0_1 * product_4 + W0_0 * product;
    const vector_f R1_3 = W1_2 * product + W1_1 * product_2 - W1_0 * product_3;
    const vector_f R1_0 = -(W1_2 * product_4) - W1_1 * product_3 - W1_0 * product_2;
    const vector_f R1_2 = W1_1 * product - W1_2 * product_2 + W1_0 * product_4;
    const vector_f R1_1 = W1_2 * product_3 - W1_1 * product_4 + W1_0 * product;
    const vector_f R2_3 = W2_2 * product + W2_1 * product_2 - W2_0 * product_3;
    const vector_f R2_0 = -(W2_2 * product_4) - W2_1 * product_3 - W2_0 * product_2;
    const vector_f R2_2 = W2_1 * product - W2_2 * product_2 + W2_0 * product_4;
    const vector_f R2_1 = W2_2 * product_3 - W2_1 * product_4 + W2_0 * product;
    S[0] = mu0;
    S[1] = mu1;
    S[2] = mu2;
    S[3] = mu3;
    S[4] = its_amplitude;
    S[5] = R0_3;
    S[6] = R0_0;
    S[7] = R0_2;
    S[8] = R0_1;
    S[9] = R1_3;
    S[10] = R1_0;
    S[11] = R1_2;
    S[12] = R1_1;
    S[13] = R2_3;
    S[14] = R2_0;
    S[15] = R2_2;
    S[16] = R2_1;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
 * w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
 * eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
 * Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
 * r = R h = W (tangent part of x), phi = amplitude a^k exp(-a^2 |r|^2 / 2)
 */
INLINE void pair_value_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values) {
    struct { vector_f a, gaussian; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 17 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 4 * b;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f g0 = x0 * mu0 + x1 * mu1 + x2 * mu2 + x3 * mu3;
            const vector_f abs_g0 = abs_each_f(g0);
            const vector_f eta = vector_polynomial_eta_f(1.0f - abs_g0);
            const vector_f a = 1.0f / (abs_g0 - eta * (1.0f - abs_g0 * abs_g0));
            kept[k][b].a = a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 17 * near[k];
        const float R0_3 = S[5];
        const float R0_0 = S[6];
        const float R0_2 = S[7];
        const float R0_1 = S[8];
        const float R1_3 = S[9];
        const float R1_0 = S[10];
        const float R1_2 = S[11];
        const float R1_1 = S[12];
        const float R2_3 = S[13];
        const float R2_0 = S[14];
        const float R2_2 = S[15];
        const float R2_1 = S[16];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 4 * b;
            const vector_f a = kept[k][b].a;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f a_squared = a * a;
            const vector_f r0 = x0 * R0_0 + x1 * R0_1 + x2 * R0_2 + x3 * R0_3;
            const vector_f r1 = x0 * R1_0 + x1 * R1_1 + x2 * R1_2 + x3 * R1_3;
            const vector_f r2 = x0 * R2_0 + x1 * R2_1 + x2 * R2_2 + x3 * R2_3;
            const vector_f square = a_squared * (r0 * r0 + r1 * r1 + r2 * r2);
            const vector_f gaussian = gaussian_each_f(square);
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 17 * near[k];
        const float amplitude = S[4];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            const vector_f a = kept[k][b].a;
            const vector_f gaussian = kept[k][b].gaussian;
            const vector_f phi = a * (a * gaussian);
            value[0] = value[0] + amplitude * phi;
        }
    }
}

/*
 * Adds the values phi of some splats at 2 vectors of points, and slope = d phi / d X.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
 * w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
 * eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
 * Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
 * r = R h = W (tangent part of x), phi = amplitude a^k exp(-a^2 |r|^2 / 2)
 */
INLINE void pair_forward_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values, vector_f *slopes) {
    struct { vector_f g0, eta, a, a_squared, r0, r1, r2, square, gaussian; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 17 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 4 * b;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f g0 = x0 * mu0 + x1 * mu1 + x2 * mu2 + x3 * mu3;
            const vector_f abs_g0 = abs_each_f(g0);
            const vector_f eta = vector_polynomial_eta_f(1.0f - abs_g0);
            const vector_f a = 1.0f / (abs_g0 - eta * (1.0f - abs_g0 * abs_g0));
            kept[k][b].g0 = g0;
            kept[k][b].eta = eta;
            kept[k][b].a = a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 17 * near[k];
        const float R0_3 = S[5];
        const float R0_0 = S[6];
        const float R0_2 = S[7];
        const float R0_1 = S[8];
        const float R1_3 = S[9];
        const float R1_0 = S[10];
        const float R1_2 = S[11];
        const float R1_1 = S[12];
        const float R2_3 = S[13];
        const float R2_0 = S[14];
        const float R2_2 = S[15];
        const float R2_1 = S[16];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 4 * b;
            const vector_f a = kept[k][b].a;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f a_squared = a * a;
            const vector_f r0 = x0 * R0_0 + x1 * R0_1 + x2 * R0_2 + x3 * R0_3;
            const vector_f r1 = x0 * R1_0 + x1 * R1_1 + x2 * R1_2 + x3 * R1_3;
            const vector_f r2 = x0 * R2_0 + x1 * R2_1 + x2 * R2_2 + x3 * R2_3;
            const vector_f square = a_squared * (r0 * r0 + r1 * r1 + r2 * r2);
            const vector_f gaussian = gaussian_each_f(square);
            kept[k][b].a_squared = a_squared;
            kept[k][b].r0 = r0;
            kept[k][b].r1 = r1;
            kept[k][b].r2 = r2;
            kept[k][b].square = square;
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 17 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float amplitude = S[4];
        const float R0_3 = S[5];
        const float R0_0 = S[6];
        const float R0_2 = S[7];
        const float R0_1 = S[8];
        const float R1_3 = S[9];
        const float R1_0 = S[10];
        const float R1_2 = S[11];
        const float R1_1 = S[12];
        const float R2_3 = S[13];
        const float R2_0 = S[14];
        const float R2_2 = S[15];
        const float R2_1 = S[16];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            vector_f *slope = slopes + 4 * b;
            const vector_f g0 = kept[k][b].g0;
            const vector_f eta = kept[k][b].eta;
            const vector_f a = kept[k][b].a;
            const vector_f a_squared = kept[k][b].a_squared;
            const vector_f r0 = kept[k][b].r0;
            const vector_f r1 = kept[k][b].r1;
            const vector_f r2 = kept[k][b].r2;
            const vector_f square = kept[k][b].square;
            const vector_f gaussian = kept[k][b].gaussian;
            const vector_f phi = a * (a * gaussian);
            const vector_f phi_2 = amplitude * phi;
            const vector_f by_abs_g0 = eta * (2.0f * phi_2 - phi_2 * square);
            const vector_f by_g0 = vector_select_f(g0 < 0.0f, -by_abs_g0, by_abs_g0);
            const vector_f phi_product = phi_2 * a_squared;
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] + mu0 * by_g0 - (R0_0 * r0 + R1_0 * r1 + R2_0 * r2) * phi_product;
            slope[1] = slope[1] + mu1 * by_g0 - (R0_1 * r0 + R1_1 * r1 + R2_1 * r2) * phi_product;
            slope[2] = slope[2] + mu2 * by_g0 - (R0_2 * r0 + R1_2 * r1 + R2_2 * r2) * phi_product;
            slope[3] = slope[3] + mu3 * by_g0 - (R0_3 * r0 + R1_3 * r1 + R2_3 * r2) * phi_product;
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient_f(
    const vector_f *x, const vector_f *slope, vector_f *gradient) {
    const vector_f x0 = x[0];
    const vector_f x1 = x[1];
    const vector_f x2 = x[2];
    const vector_f x3 = x[3];
    const vector_f slope_x0 = slope[0];
    const vector_f slope_x1 = slope[1];
    const vector_f slope_x2 = slope[2];
    const vector_f slope_x3 = slope[3];
    const vector_f product = 0.5f * slope_x1;
    const vector_f product_2 = 0.5f * slope_x2;
    const vector_f product_3 = 0.5f * slope_x0;
    const vector_f product_4 = 0.5f * slope_x3;
    gradient[0] = x0 * product + x3 * product_2 - x1 * product_3 - x2 * product_4;
    gradient[1] = x0 * product_2 + x1 * product_4 - x2 * product_3 - x3 * product;
    gradient[2] = x2 * product + x0 * product_4 - x3 * product_3 - x1 * product_2;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp_f(
    const vector_f *x, const vector_f *gradient_bar, vector_f *slope_bar) {
    const vector_f x0 = x[0];
    const vector_f x1 = x[1];
    const vector_f x2 = x[2];
    const vector_f x3 = x[3];
    const vector_f gradient_bar0 = gradient_bar[0];
    const vector_f gradient_bar1 = gradient_bar[1];
    const vector_f gradient_bar2 = gradient_bar[2];
    const vector_f product = 0.5f * (-(x3 * gradient_bar2) - x2 * gradient_bar1 - x1 * gradient_bar0);
    slope_bar[0] = product;
    slope_bar[1] = 0.5f * (x2 * gradient_bar2 - x3 * gradient_bar1 + x0 * gradient_bar0);
    slope_bar[2] = 0.5f * (x0 * gradient_bar1 - x1 * gradient_bar2 + x3 * gradient_bar0);
    slope_bar[3] = 0.5f * (x0 * gradient_bar2 + x1 * gradient_bar1 - x2 * gradient_bar0);
}

/*
 * Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
 * w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
 * eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
 * Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
 * r = R h = W (tangent part of x), phi = amplitude a^k exp(-a^2 |r|^2 / 2)
 */
INLINE void pair_backward_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *sums) {
    struct { vector_f g0, abs_g0_gap, eta, a, a_squared, r0, r1, r2, square, gaussian; } kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 9 * (size_t)near[i];
        const vector_f x0 = X[0];
        const vector_f x1 = X[1];
        const vector_f x2 = X[2];
        const vector_f x3 = X[3];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const vector_f g0 = x0 * mu0 + x1 * mu1 + x2 * mu2 + x3 * mu3;
        const vector_f abs_g0 = abs_each_f(g0);
        const vector_f abs_g0_gap = 1.0f - abs_g0;
        const vector_f eta = vector_polynomial_eta_f(abs_g0_gap);
        const vector_f a = 1.0f / (abs_g0 - eta * (1.0f - abs_g0 * abs_g0));
        kept[i].g0 = g0;
        kept[i].abs_g0_gap = abs_g0_gap;
        kept[i].eta = eta;
        kept[i].a = a;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 9 * (size_t)near[i];
        const vector_f a = kept[i].a;
        const vector_f x0 = X[0];
        const vector_f x1 = X[1];
        const vector_f x2 = X[2];
        const vector_f x3 = X[3];
        const float R0_3 = S[5];
        const float R0_0 = S[6];
        const float R0_2 = S[7];
        const float R0_1 = S[8];
        const float R1_3 = S[9];
        const float R1_0 = S[10];
        const float R1_2 = S[11];
        const float R1_1 = S[12];
        const float R2_3 = S[13];
        const float R2_0 = S[14];
        const float R2_2 = S[15];
        const float R2_1 = S[16];
        const vector_f a_squared = a * a;
        const vector_f r0 = x0 * R0_0 + x1 * R0_1 + x2 * R0_2 + x3 * R0_3;
        const vector_f r1 = x0 * R1_0 + x1 * R1_1 + x2 * R1_2 + x3 * R1_3;
        const vector_f r2 = x0 * R2_0 + x1 * R2_1 + x2 * R2_2 + x3 * R2_3;
        const vector_f square = a_squared * (r0 * r0 + r1 * r1 + r2 * r2);
        const vector_f gaussian = gaussian_each_f(square);
        kept[i].a_squared = a_squared;
        kept[i].r0 = r0;
        kept[i].r1 = r1;
        kept[i].r2 = r2;
        kept[i].square = square;
        kept[i].gaussian = gaussian;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 9 * (size_t)near[i];
        const vector_f *value_bar = points + 9 * (size_t)near[i] + 4;
        const vector_f *slope_bar = points + 9 * (size_t)near[i] + 4 + 1;
        const vector_f g0 = kept[i].g0;
        const vector_f abs_g0_gap = kept[i].abs_g0_gap;
        const vector_f eta = kept[i].eta;
        const vector_f a = kept[i].a;
        const vector_f a_squared = kept[i].a_squared;
        const vector_f r0 = kept[i].r0;
        const vector_f r1 = kept[i].r1;
        const vector_f r2 = kept[i].r2;
        const vector_f square = kept[i].square;
        const vector_f gaussian = kept[i].gaussian;
        const vector_f x0 = X[0];
        const vector_f x1 = X[1];
        const vector_f x2 = X[2];
        const vector_f x3 = X[3];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float R0_3 = S[5];
        const float R0_0 = S[6];
        const float R0_2 = S[7];
        const float R0_1 = S[8];
        const float R1_3 = S[9];
        const float R1_0 = S[10];
        const float R1_2 = S[11];
        const float R1_1 = S[12];
        const float R2_3 = S[13];
        const float R2_0 = S[14];
        const float R2_2 = S[15];
        const float R2_1 = S[16];
        const vector_f its_value_bar = value_bar[0];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_f x2_bar = slope_bar[2];
        const vector_f x3_bar = slope_bar[3];
        const vector_mask_f is_small = g0 < 0.0f;
        const vector_f phi = a * (a * gaussian);
        const vector_f gap = 2.0f * phi - phi * square;
        const vector_f by_abs_g0 = eta * gap;
        const vector_f by_g0 = vector_select_f(is_small, -by_abs_g0, by_abs_g0);
        const vector_f eta_slope = vector_polynomial_eta_slope_f(abs_g0_gap);
        const vector_f by_by_g0 = mu0 * x0_bar + mu1 * x1_bar + mu2 * x2_bar + mu3 * x3_bar;
        const vector_f by_by_abs_g0 = vector_select_f(is_small, vector_of_f(0.0f), by_by_g0) -
            vector_select_f(is_small, by_by_g0, vector_of_f(0.0f));
        const vector_f minus = -((R0_3 * r0 + R1_3 * r1 + R2_3 * r2) * x3_bar);
        const vector_f gap_2 = minus - (R0_2 * r0 + R1_2 * r1 + R2_2 * r2) * x2_bar;
        const vector_f gap_3 = gap_2 - (R0_1 * r0 + R1_1 * r1 + R2_1 * r2) * x1_bar;
        const vector_f gap_4 = gap_3 - (R0_0 * r0 + R1_0 * r1 + R2_0 * r2) * x0_bar;
        const vector_f eta_product = eta * by_by_abs_g0;
        const vector_f by_phi = its_value_bar + a_squared * gap_4 - square * eta_product + 2.0f * eta_product;
        const vector_f phi_product = phi * by_phi;
        const vector_f gap_5 = -2.0f * (phi * eta_product) - phi_product;
        const vector_f eta_product_2 = eta * (2.0f * a_squared * (phi * gap_4) + 2.0f * phi_product + square *
            gap_5);
        const vector_f by_abs_g0_2 = eta_slope * (gap * by_by_abs_g0) + eta_product_2;
        const vector_f by_g0_2 = vector_select_f(is_small, -by_abs_g0_2, by_abs_g0_2);
        const vector_f product = 0.5f * (a_squared * gap_5);
        const vector_f phi_product_2 = phi * a_squared;
        const vector_f gap_6 = x0 * product - phi_product_2 * x0_bar;
        const vector_f gap_7 = x1 * product - phi_product_2 * x1_bar;
        const vector_f gap_8 = x2 * product - phi_product_2 * x2_bar;
        const vector_f gap_9 = x3 * product - phi_product_2 * x3_bar;
        sums[0] = sums[0] + by_g0 * x0_bar + x0 * by_g0_2;
        sums[1] = sums[1] + by_g0 * x1_bar + x1 * by_g0_2;
        sums[2] = sums[2] + by_g0 * x2_bar + x2 * by_g0_2;
        sums[3] = sums[3] + by_g0 * x3_bar + x3 * by_g0_2;
        sums[4] = sums[4] + phi_product;
        sums[5] = sums[5] + x0 * gap_6;
        sums[6] = sums[6] + x0 * gap_7 + x1 * gap_6;
        sums[7] = sums[7] + x0 * gap_8 + x2 * gap_6;
        sums[8] = sums[8] + x0 * gap_9 + x3 * gap_6;
        sums[9] = sums[9] + x1 * gap_7;
        sums[10] = sums[10] + x1 * gap_8 + x2 * gap_7;
        sums[11] = sums[11] + x1 * gap_9 + x3 * gap_7;
        sums[12] = sums[12] + x2 * gap_8;
        sums[13] = sums[13] + x2 * gap_9 + x3 * gap_8;
        sums[14] = sums[14] + x3 * gap_9;
    }
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, const vector_f *sums, vector_f *mu_bar, vector_f *W_bar, vector_f *amplitude_bar) {
    const vector_f mu0 = mu[0];
    const vector_f mu1 = mu[1];
    const vector_f mu2 = mu[2];
    const vector_f mu3 = mu[3];
    const vector_f W0_0 = W[0];
    const vector_f W0_1 = W[1];
    const vector_f W0_2 = W[2];
    const vector_f W1_0 = W[3];
    const vector_f W1_1 = W[4];
    const vector_f W1_2 = W[5];
    const vector_f W2_0 = W[6];
    const vector_f W2_1 = W[7];
    const vector_f W2_2 = W[8];
    const vector_f its_amplitude = amplitude[0];
    const vector_f sum0 = sums[0];
    const vector_f sum1 = sums[1];
    const vector_f sum2 = sums[2];
    const vector_f sum3 = sums[3];
    const vector_f sum4 = sums[4];
    const vector_f sum5 = sums[5];
    const vector_f sum6 = sums[6];
    const vector_f sum7 = sums[7];
    const vector_f sum8 = sums[8];
    const vector_f sum9 = sums[9];
    const vector_f sum10 = sums[10];
    const vector_f sum11 = sums[11];
    const vector_f sum12 = sums[12];
    const vector_f sum13 = sums[13];
    const vector_f sum14 = sums[14];
    const vector_f product = 2.0f * mu3;
    const vector_f product_2 = 2.0f * mu2;
    const vector_f product_3 = 2.0f * mu1;
    const vector_f R2_0 = -(W2_2 * product) - W2_1 * product_2 - W2_0 * product_3;
    const vector_f product_4 = 2.0f * mu0;
    const vector_f R2_1 = W2_2 * product_2 - W2_1 * product + W2_0 * product_4;
    const vector_f product_5 = 2.0f * sum9;
    const vector_f R2_2 = W2_1 * product_4 - W2_2 * product_3 + W2_0 * product;
    const vector_f R2_3 = W2_2 * product_4 + W2_1 * product_3 - W2_0 * product_2;
    const vector_f by_R2_1 = R2_0 * sum6 + R2_1 * product_5 + R2_2 * sum10 + R2_3 * sum11;
    const vector_f R1_0 = -(W1_2 * product) - W1_1 * product_2 - W1_0 * product_3;
    const vector_f R1_1 = W1_2 * product_2 - W1_1 * product + W1_0 * product_4;
    const vector_f R1_2 = W1_1 * product_4 - W1_2 * product_3 + W1_0 * product;
    const vector_f R1_3 = W1_2 * product_4 + W1_1 * product_3 - W1_0 * product_2;
    const vector_f by_R1_1 = R1_0 * sum6 + R1_1 * product_5 + R1_2 * sum10 + R1_3 * sum11;
    const vector_f R0_0 = -(W0_2 * product) - W0_1 * product_2 - W0_0 * product_3;
    const vector_f R0_1 = W0_2 * product_2 - W0_1 * product + W0_0 * product_4;
    const vector_f R0_2 = W0_1 * product_4 - W0_2 * product_3 + W0_0 * product;
    const vector_f R0_3 = W0_2 * product_4 + W0_1 * product_3 - W0_0 * product_2;
    const vector_f by_R0_1 = R0_0 * sum6 + R0_1 * product_5 + R0_2 * sum10 + R0_3 * sum11;
    const vector_f product_6 = 2.0f * sum12;
    const vector_f by_R2_2 = R2_0 * sum7 + R2_1 * sum10 + R2_2 * product_6 + R2_3 * sum13;
    const vector_f by_R1_2 = R1_0 * sum7 + R1_1 * sum10 + R1_2 * product_6 + R1_3 * sum13;
    const vector_f total_2 = W2_0 * by_R2_1 + W1_0 * by_R1_1 + W0_0 * by_R0_1 + W2_1 * by_R2_2 + W1_1 *
        by_R1_2;
    const vector_f by_R0_2 = R0_0 * sum7 + R0_1 * sum10 + R0_2 * product_6 + R0_3 * sum13;
    const vector_f product_7 = 2.0f * sum14;
    const vector_f by_R2_3 = R2_0 * sum8 + R2_1 * sum11 + R2_2 * sum13 + R2_3 * product_7;
    const vector_f by_R1_3 = R1_0 * sum8 + R1_1 * sum11 + R1_2 * sum13 + R1_3 * product_7;
    const vector_f by_R0_3 = R0_0 * sum8 + R0_1 * sum11 + R0_2 * sum13 + R0_3 * product_7;
    const vector_f total_3 = total_2 + W0_1 * by_R0_2 + W2_2 * by_R2_3 + W1_2 * by_R1_3 + W0_2 * by_R0_3;
    const vector_f product_8 = 2.0f * sum5;
    const vector_f by_R2_0 = R2_0 * product_8 + R2_1 * sum6 + R2_2 * sum7 + R2_3 * sum8;
    const vector_f by_R1_0 = R1_0 * product_8 + R1_1 * sum6 + R1_2 * sum7 + R1_3 * sum8;
    const vector_f by_R0_0 = R0_0 * product_8 + R0_1 * sum6 + R0_2 * sum7 + R0_3 * sum8;
    const vector_f gap = -(W2_0 * by_R2_0) - W1_0 * by_R1_0 - W0_0 * by_R0_0 - W2_2 * by_R2_2;
    const vector_f total_4 = gap - W1_2 * by_R1_2 - W0_2 * by_R0_2 + W2_1 * by_R2_3 + W1_1 * by_R1_3;
    const vector_f product_9 = its_amplitude * (sum1 + 2.0f * (total_4 + W0_1 * by_R0_3));
    const vector_f total_5 = -(W2_1 * by_R2_0) - W1_1 * by_R1_0 - W0_1 * by_R0_0 + W2_2 * by_R2_1;
    const vector_f gap_2 = total_5 + W1_2 * by_R1_1 + W0_2 * by_R0_1 - W2_0 * by_R2_3 - W1_0 * by_R1_3;
    const vector_f product_10 = its_amplitude * (sum2 + 2.0f * (gap_2 - W0_0 * by_R0_3));
    const vector_f gap_3 = -(W2_2 * by_R2_0) - W1_2 * by_R1_0 - W0_2 * by_R0_0 - W2_1 * by_R2_1;
    const vector_f total_6 = gap_3 - W1_1 * by_R1_1 - W0_1 * by_R0_1 + W2_0 * by_R2_2 + W1_0 * by_R1_2;
    const vector_f product_11 = its_amplitude * (sum3 + 2.0f * (total_6 + W0_0 * by_R0_2));
    const vector_f product_12 = its_amplitude * (product_4 * by_R0_1 - product_3 * by_R0_0 + product * by_R0_2
        - product_2 * by_R0_3);
    const vector_f total_7 = -(product_2 * by_R0_0) - product * by_R0_1 + product_4 * by_R0_2 + product_3 *
        by_R0_3;
    const vector_f product_13 = its_amplitude * (product_2 * by_R0_1 - product * by_R0_0 - product_3 * by_R0_2
        + product_4 * by_R0_3);
    const vector_f product_14 = its_amplitude * (product_4 * by_R1_1 - product_3 * by_R1_0 + product * by_R1_2
        - product_2 * by_R1_3);
    const vector_f total_8 = -(product_2 * by_R1_0) - product * by_R1_1 + product_4 * by_R1_2 + product_3 *
        by_R1_3;
    const vector_f product_15 = its_amplitude * (product_2 * by_R1_1 - product * by_R1_0 - product_3 * by_R1_2
        + product_4 * by_R1_3);
    const vector_f product_16 = its_amplitude * (product_4 * by_R2_1 - product_3 * by_R2_0 + product * by_R2_2
        - product_2 * by_R2_3);
    const vector_f total_9 = -(product_2 * by_R2_0) - product * by_R2_1 + product_4 * by_R2_2 + product_3 *
        by_R2_3;
    const vector_f product_17 = its_amplitude * (product_2 * by_R2_1 - product * by_R2_0 - product_3 * by_R2_2
        + product_4 * by_R2_3);
    mu_bar[0] = its_amplitude * (sum0 + 2.0f * total_3);
    mu_bar[1] = product_9;
    mu_bar[2] = product_10;
    mu_bar[3] = product_11;
    W_bar[0] = product_12;
    W_bar[1] = its_amplitude * total_7;
    W_bar[2] = product_13;
    W_bar[3] = product_14;
    W_bar[4] = its_amplitude * total_8;
    W_bar[5] = product_15;
    W_bar[6] = product_16;
    W_bar[7] = its_amplitude * total_9;
    W_bar[8] = product_17;
    amplitude_bar[0] = sum4;
}

/* The distances of some points q from one point p. */
OUTLINE void pair_distances_f(
    const float *p, const vector_f *q, vector_f *distance) {
    const float p0 = p[0];
    const float p1 = p[1];
    const float p2 = p[2];
    const float p3 = p[3];
    const vector_f q0 = q[0];
    const vector_f q1 = q[1];
    const vector_f q2 = q[2];
    const vector_f q3 = q[3];
    const vector_f g0 = p0 * q0 + p1 * q1 + p2 * q2 + p3 * q3;
    const vector_f g1 = p0 * q1 + p3 * q2 - p1 * q0 - p2 * q3;
    const vector_f g2 = p0 * q2 + p1 * q3 - p2 * q0 - p3 * q1;
    const vector_f g3 = p0 * q3 + p2 * q1 - p1 * q2 - p3 * q0;
    const vector_f norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const vector_f norm_s = sqrt_each_f(norm_s_squared);
    const vector_f abs_g0 = abs_each_f(g0);
    const vector_f atan2_norm_s_abs_g0 = atan2_each_f(norm_s, abs_g0);
    const vector_f t = 2.0f * atan2_norm_s_abs_g0;
    distance[0] = t;
}

/* The numbers of LANES rows from `start` on, transposed; past the end, the last row again. */
OUTLINE void vector_rows_f(const float *rows, size_t count, size_t start, size_t size, vector_f *columns) {
    for (size_t i = 0; i < size; ++i) {
        float column[LANES_f];
        for (size_t lane = 0; lane < LANES_f; ++lane)
            column[lane] = rows[size * (start + lane < count ? start + lane : count - 1) + i];
        columns[i] = vector_load_f(column);
    }
}

/* Back to rows that are `stride` apart; nothing past the end. */
OUTLINE void vector_to_rows_f(
    const vector_f *columns, float *rows, size_t count, size_t start, size_t size, size_t stride) {
    const size_t lanes = start >= count ? 0 : count - start < LANES_f ? count - start : LANES_f;
    for (size_t lane = 0; lane < lanes; ++lane)
        for (size_t i = 0; i < size; ++i) rows[stride * (start + lane) + i] = LANE(columns[i], lane);
}

/* Zero in the lanes past the end. */
OUTLINE void vector_end_f(size_t count, size_t start, size_t size, vector_f *columns) {
    for (size_t lane = start >= count ? 0 : count - start; lane < LANES_f; ++lane)
        for (size_t i = 0; i < size; ++i) LANE(columns[i], lane) = 0;
}

/* Scratch memory: 9 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t so3_splats_work_f(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES_f - 1) / LANES_f, blocks = (points + 2 - 1) / 2;
    const size_t places = 5 * ((splat_count + LANES_f - 1) / LANES_f + (blocks + LANES_f - 1) / LANES_f);
    return (points * 9 + places + 1) * LANES_f + 17 * splat_count;
}

static vector_f *work_points_f(float *work) {
    const uintptr_t size = sizeof(vector_f), start = (uintptr_t)work;
    return (vector_f *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const float *splat_at_f(const vector_f *splats, size_t k) {
    const size_t row = k / LANES_f;
    return (const float *)(splats + 5 * row) + (k - row * LANES_f);
}

static vector_f *work_reaches_f(float *work, size_t count) {
    return work_points_f(work) + (count + LANES_f - 1) / LANES_f * 9;
}

static vector_f *work_blocks_f(float *work, size_t count, size_t splat_count) {
    return work_reaches_f(work, count) + 5 * ((splat_count + LANES_f - 1) / LANES_f);
}

static float *work_constants_f(float *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES_f, blocks = (count + size - 1) / size;
    return (float *)(work_blocks_f(work, count, splat_count) + 5 * ((blocks + LANES_f - 1) / LANES_f));
}

/* Zero, or NaN where a number is not finite: what has one is near everything. */
INLINE vector_f vector_spoilt_f(const vector_f *x, size_t size) {
    vector_f sum = ZERO;
    for (size_t i = 0; i < size; ++i) sum += x[i] - x[i];
    return sum;
}

/* mu and reach of LANES splats, side by side. */
OUTLINE void splat_reach_f(
    const vector_f *mu, const vector_f *amplitude, const float *width, size_t splat_count, size_t start, vector_f *splats) {
    vector_f *own = splats + start / LANES_f * (4 + 1);
    vector_rows_f(width, splat_count, start, 1, own + 4);
    own[4] = own[4] * 6.516295450218751f + vector_spoilt_f(mu, 4) + vector_spoilt_f(amplitude, 1);
    for (int i = 0; i < 4; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place_f(const float *x, size_t count, size_t start, float *place) {
    const size_t size = count - start < 2 * LANES_f ? count - start : 2 * LANES_f;
    vector_f at[2][4], spoilt = ZERO;
    for (size_t b = 0; b < 2; ++b) {
        vector_rows_f(x, count, start + b * LANES_f, 4, at[b]);
        spoilt += vector_spoilt_f(at[b], 4);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const float *middle = x + 4 * (start + i * size / 8);
        float radius = 0, column[LANES_f];
        for (size_t b = 0; b < 2; ++b) {
            vector_f distance[1];
            pair_distances_f(middle, at[b], distance);
            vector_store_f(column, distance[0]);
            for (size_t lane = 0; lane < LANES_f; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[4]) {
            for (int j = 0; j < 4; ++j) place[j] = middle[j];
            place[4] = radius;
        }
    }
    place[4] = place[4] * 1.0078125f + vector_sum_f(spoilt);
}

/* Where a splat is too far from all of a block; never where a distance is not a number. */
INLINE vector_mask_f vector_far_f(vector_f distance, vector_f reach, vector_f radius) {
    return (distance > reach + radius);
}

/* The splats from `first` (a multiple of LANES) to `end` that are near a block, all if there is none; how many. */
OUTLINE size_t splats_near_f(const float *place, const vector_f *splats, size_t first, size_t end, uint32_t *near) {
    size_t size = 0;
    if (!place) {
        for (size_t k = first; k < end; ++k) near[size++] = (uint32_t)k;
        return size;
    }
    for (size_t start = first; start < end; start += LANES_f) {
        const vector_f *own = splats + start / LANES_f * (4 + 1);
        vector_f distance[1];
        pair_distances_f(place, own, distance);
        const vector_mask_f far = vector_far_f(distance[0], own[4], vector_of_f(place[4]));
        const size_t lanes = end - start < LANES_f ? end - start : LANES_f;
        for (size_t lane = 0; lane < lanes; ++lane) {
            near[size] = (uint32_t)(start + lane);
            size += !LANE(far, lane);
        }
    }
    return size;
}

/* The vectors of points from `first` to `end` whose blocks are near a splat, all if there are none, less `first`. */
OUTLINE size_t blocks_near_f(
    const float *mu, const float *reach, const vector_f *blocks, size_t first, size_t end, uint32_t *near) {
    const size_t group = 2 * LANES_f;  // vectors of points whose middles are one vector
    size_t size = 0;
    if (!reach) {
        for (size_t b = first; b < end; ++b) near[size++] = (uint32_t)(b - first);
        return size;
    }
    for (size_t start = first / group * group; start < end; start += group) {
        const vector_f *own = blocks + start / group * (4 + 1);
        vector_f distance[1];
        pair_distances_f(mu, own, distance);
        const vector_mask_f far = vector_far_f(distance[0], vector_of_f(*reach), own[4]);
        for (size_t lane = 0; lane < group; ++lane) {
            const size_t b = start + lane;
            near[size] = (uint32_t)(b - first);
            size += b >= first && b < end && !LANE(far, lane / 2);
        }
    }
    return size;
}

/* The constants of LANES splats, as rows; with `width`, how far they reach. */
OUTLINE void splat_constants_f(
    size_t splat_count, size_t start, const float *mu, const float *W, const float *amplitude, const float *width, float *constants,
    vector_f *splats) {
    vector_f own_mu[4], own_W[9], own_amplitude[1], S[17];
    vector_rows_f(mu, splat_count, start, 4, own_mu);
    vector_rows_f(W, splat_count, start, 9, own_W);
    vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants_f(own_mu, own_W, own_amplitude, S);
    vector_to_rows_f(S, constants, splat_count, start, 17, 17);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void so3_splats_f(
    size_t count, size_t splat_count, const float *SO3_RESTRICT x, const float *SO3_RESTRICT mu, const float *SO3_RESTRICT W, const float *SO3_RESTRICT amplitude, const float *SO3_RESTRICT width,
    float *SO3_RESTRICT value, float *SO3_RESTRICT gradient, float *SO3_RESTRICT work, int threads) {
    (void)threads;
    float *constants = work_constants_f(work, 0, splat_count);
    vector_f *splats = work_reaches_f(work, 0);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += LANES_f)
            splat_constants_f(splat_count, start, mu, W, amplitude, width, constants, splats);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < count; start += 2 * LANES_f) {
            vector_f at[2][4], X[2 * 4], grad[3];
            vector_f value_sum[2] = {ZERO}, slope_sum[2 * 4] = {ZERO};
            float place[4 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 4, at[b]);
                pair_features_f(at[b], X + 4 * b);
            }
            if (width) block_place_f(x, count, start, place);
            for (size_t first = 0; first < splat_count; first += 256) {
                const size_t end = splat_count - first < 256 ? splat_count : first + 256;
                const size_t size = splats_near_f(width ? place : NULL, splats, first, end, near);
                for (size_t i = 0; i < size; i += 8) {
                    const size_t some = size - i < 8 ? size - i : 8;
                    pair_forward_f(some, X, constants, near + i, value_sum, slope_sum);
                }
            }
            for (size_t b = 0; b < 2; ++b) {
                pair_gradient_f(at[b], slope_sum + 4 * b, grad);
                vector_to_rows_f(value_sum + b, value, count, start + b * LANES_f, 1, 1);
                vector_to_rows_f(grad, gradient, count, start + b * LANES_f, 3, 3);
            }
        }
        restore_denormals(mode);
    }
}

void so3_splats_value_f(
    size_t count, size_t splat_count, const float *SO3_RESTRICT x, const float *SO3_RESTRICT mu, const float *SO3_RESTRICT W, const float *SO3_RESTRICT amplitude, const float *SO3_RESTRICT width,
    float *SO3_RESTRICT value, float *SO3_RESTRICT work, int threads) {
    (void)threads;
    float *constants = work_constants_f(work, 0, splat_count);
    vector_f *splats = work_reaches_f(work, 0);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += LANES_f)
            splat_constants_f(splat_count, start, mu, W, amplitude, width, constants, splats);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < count; start += 2 * LANES_f) {
            vector_f at[4], X[2 * 4], value_sum[2] = {ZERO};
            float place[4 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 4, at);
                pair_features_f(at, X + 4 * b);
            }
            if (width) block_place_f(x, count, start, place);
            for (size_t first = 0; first < splat_count; first += 256) {
                const size_t end = splat_count - first < 256 ? splat_count : first + 256;
                const size_t size = splats_near_f(width ? place : NULL, splats, first, end, near);
                for (size_t i = 0; i < size; i += 8) {
                    const size_t some = size - i < 8 ? size - i : 8;
                    pair_value_f(some, X, constants, near + i, value_sum);
                }
            }
            for (size_t b = 0; b < 2; ++b)
                vector_to_rows_f(value_sum + b, value, count, start + b * LANES_f, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* What backward reads of LANES points: X, value_bar, slope_bar; the adjoints past the end are zero. */
OUTLINE void splat_points_f(
    size_t count, size_t start, const float *x, const float *value_bar, const float *gradient_bar, vector_f *point) {
    vector_f at[4], grad_bar[3], slope_bar[4];
    vector_rows_f(x, count, start, 4, at);
    vector_rows_f(gradient_bar, count, start, 3, grad_bar);
    vector_rows_f(value_bar, count, start, 1, point + 4);
    pair_features_f(at, point);
    pair_gradient_vjp_f(at, grad_bar, slope_bar);
    for (int i = 0; i < 4; ++i) point[4 + 1 + i] = slope_bar[i];
    vector_end_f(count, start, 4 + 1, point + 4);
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums_f(const vector_f *points, const uint32_t *near, size_t size, const float *S, float *sums) {
    vector_f sum[15] = {ZERO};
    for (size_t b = 0; b < size; b += 16)
        pair_backward_f(size - b < 16 ? size - b : 16, points, near + b, S, sum);
    sums[0] += vector_sum_f(sum[0]);
    sums[1] += vector_sum_f(sum[1]);
    sums[2] += vector_sum_f(sum[2]);
    sums[3] += vector_sum_f(sum[3]);
    sums[4] += vector_sum_f(sum[4]);
    sums[5] += vector_sum_f(sum[5]);
    sums[6] += vector_sum_f(sum[6]);
    sums[7] += vector_sum_f(sum[7]);
    sums[8] += vector_sum_f(sum[8]);
    sums[9] += vector_sum_f(sum[9]);
    sums[10] += vector_sum_f(sum[10]);
    sums[11] += vector_sum_f(sum[11]);
    sums[12] += vector_sum_f(sum[12]);
    sums[13] += vector_sum_f(sum[13]);
    sums[14] += vector_sum_f(sum[14]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void so3_splats_vjp_f(
    size_t count, size_t splat_count, const float *SO3_RESTRICT x, const float *SO3_RESTRICT mu, const float *SO3_RESTRICT W, const float *SO3_RESTRICT amplitude, const float *SO3_RESTRICT width, const float *SO3_RESTRICT value_bar, const float *SO3_RESTRICT gradient_bar,
    float *SO3_RESTRICT mu_bar, float *SO3_RESTRICT W_bar, float *SO3_RESTRICT amplitude_bar, float *SO3_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES_f - 1) / LANES_f;
    const size_t chunk = 131072 / (9 * sizeof(vector_f)) + 1;
    const size_t rows = ((blocks + 2 - 1) / 2 + LANES_f - 1) / LANES_f * LANES_f;
    const size_t part = splat_count / (4 * (size_t)(threads > 1 ? threads : 1)) + 1;
    const size_t share = part < LANES_f ? part : LANES_f;
    vector_f *points = work_points_f(work);
    vector_f *splats = work_reaches_f(work, count), *places = work_blocks_f(work, count, splat_count);
    float *constants = work_constants_f(work, count, splat_count);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic) nowait)
        for (size_t start = 0; start < splat_count; start += LANES_f)
            splat_constants_f(splat_count, start, mu, W, amplitude, width, constants, splats);
        if (width) {
            OMP(omp for schedule(dynamic, 8) nowait)
            for (size_t block = 0; block < rows; ++block) {
                float place[4 + 1];
                const size_t last = (blocks - 1) / 2, start = (block < last ? block : last) * 2;
                block_place_f(x, count, start * LANES_f, place);
                for (int i = 0; i < 5; ++i) {
                    float *row = (float *)(places + block / LANES_f * 5 + i);
                    row[block - block / LANES_f * LANES_f] = place[i];
                }
            }
        }
        OMP(omp for schedule(dynamic, 8))
        for (size_t block = 0; block < blocks; ++block)
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, points + 9 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            float sums[LANES_f][15] = {{0}};
            uint32_t near[131072 / (9 * sizeof(vector_f)) + 2];
            vector_f own_mu[4], own_W[9], own_amplitude[1], own_sums[15], bars[14];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const float *reach = width ? splat_at_f(splats, k) + 4 * LANES_f : NULL;
                    const size_t some = blocks_near_f(mu + 4 * k, reach, places, first, first + size, near);
                    splat_sums_f(points + 9 * first, near, some, constants + 17 * k, sums[k - start]);
                }
            }
            vector_rows_f(mu, end, start, 4, own_mu);
            vector_rows_f(W, end, start, 9, own_W);
            vector_rows_f(amplitude, end, start, 1, own_amplitude);
            vector_rows_f(sums[0], LANES_f, 0, 15, own_sums);
            pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 4, bars + 4 + 9);
            vector_to_rows_f(bars, mu_bar, end, start, 4, 4);
            vector_to_rows_f(bars + 4, W_bar, end, start, 9, 9);
            vector_to_rows_f(bars + 4 + 9, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void so3_splats_rows_f(
    size_t count, size_t splat_count, const float *SO3_RESTRICT x, const float *SO3_RESTRICT mu, const float *SO3_RESTRICT W, const float *SO3_RESTRICT amplitude, const float *SO3_RESTRICT value_bar, const float *SO3_RESTRICT gradient_bar,
    float *SO3_RESTRICT rows, float *SO3_RESTRICT work, int threads) {
    (void)threads;
    const size_t blocks = (count + LANES_f - 1) / LANES_f;
    const uint32_t only = 0;
    float *constants = work_constants_f(work, 0, splat_count);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += LANES_f)
            splat_constants_f(splat_count, start, mu, W, amplitude, NULL, constants, NULL);
        OMP(omp for schedule(dynamic))
        for (size_t block = 0; block < blocks; ++block) {
            vector_f point[9];
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector_f own_mu[4], own_W[9], own_amplitude[1], own_sums[15] = {ZERO}, bars[14];
                for (int i = 0; i < 4; ++i) own_mu[i] = vector_of_f(mu[4 * k + i]);
                for (int i = 0; i < 9; ++i) own_W[i] = vector_of_f(W[9 * k + i]);
                own_amplitude[0] = vector_of_f(amplitude[k]);
                pair_backward_f(1, point, &only, constants + 17 * k, own_sums);
                pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 4, bars + 4 + 9);
                vector_to_rows_f(bars, rows + 14 * k, count, block * LANES_f, 14, 14 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

/* A coordinate to sort by. */
INLINE float order_key_f(const float *x, size_t row, size_t axis) {
    const float key = x[4 * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest_f(const float *x, const size_t *order, size_t count) {
    float low[4], high[4];
    size_t widest = 0;
    for (size_t axis = 0; axis < 4; ++axis) low[axis] = high[axis] = order_key_f(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < 4; ++axis) {
            const float key = order_key_f(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < 4; ++axis)
        if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
    return widest;
}

/* Order points and their keys such that none of the first `part` has a larger key than one of the others. */
static void split_at_f(float *keys, size_t *order, size_t count, size_t part) {
    size_t low = 0, high = count;  // the part-th smallest key is in [low, high)
    while (high - low > 1) {
        const float a = keys[low], b = keys[low + (high - low) / 2], c = keys[high - 1];
        const float least = a < b ? a : b, most = a < b ? b : a, pivot = c < least ? least : c > most ? most : c;
        size_t less = low, equal = low;
        for (int inclusive = 0; inclusive < 2; ++inclusive) {  // without branches, which nobody can foresee
            size_t end = equal = less;
            for (; end < high; ++end) {
                const float key = keys[end];
                const size_t row = order[end];
                keys[end] = keys[equal], order[end] = order[equal];
                keys[equal] = key, order[equal] = row;
                equal += inclusive ? key <= pivot : key < pivot;
            }
            if (!inclusive) less = equal;
            if (part < less) break;
        }
        if (part < less)
            high = less;
        else if (part < equal)
            return;
        else
            low = equal;
    }
}

/* Halve points at their medians until they are blocks. */
static void sorted_blocks_f(const float *x, size_t *order, size_t count, float *keys) {
    const size_t block = 2 * LANES_f;
    while (count > block) {
        const size_t part = ((count + block - 1) / block + 1) / 2 * block, axis = widest_f(x, order, count);
        for (size_t i = 0; i < count; ++i) keys[i] = order_key_f(x, order[i], axis);
        split_at_f(keys, order, count, part);
        sorted_blocks_f(x, order + part, count - part, keys);
        count = part;
    }
}

double so3_splats_order_f(
    size_t count, size_t splat_count, const float *SO3_RESTRICT x, const float *SO3_RESTRICT mu, const float *SO3_RESTRICT amplitude, const float *SO3_RESTRICT width,
    double limit, size_t *SO3_RESTRICT order, float *SO3_RESTRICT work) {
    const size_t block = 2 * LANES_f;
    vector_f *splats = work_reaches_f(work, 0);
    uint32_t near[256];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES_f) {
        vector_f own_mu[4], own_amplitude[1];
        vector_rows_f(mu, splat_count, start, 4, own_mu);
        vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks_f(x, order, count, (float *)work_blocks_f(work, 0, splat_count));
        for (size_t i = 1; i < 2 * 16; i += 2) {
            float rows[2 * LANES_f * 4], place[4 + 1];
            const size_t some = i * count / (2 * 16), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < 4; ++j) rows[4 * n + j] = x[4 * order[start + n] + j];
            block_place_f(rows, size, 0, place);
            for (size_t first = 0; first < splat_count; first += 256) {
                const size_t end = splat_count - first < 256 ? splat_count : first + 256;
                pairs += splats_near_f(place, splats, first, end, near);
            }
        }
        share = (double)pairs / ((double)splat_count * 16);
        if (share > limit) return share;
    }
    return share;
}

#endif /* float */
