/*
 * hyperbolic: Hyperbolic space H^n, points on the upper sheet of the unit hyperboloid in R^(n+1), time
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "hyperbolic.h"

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

/* log = k log 2 + log m, sqrt(1/2) <= m < sqrt(2), within 1 unit in the last place. */
INLINE vector log_each(vector x) {
    const vector_bits bits = vector_to_bits(x), biased = (bits + 0x95f619980c433) >> 52; /* k + 1023 */
    const vector k = vector_from_bits(biased + 0x4338000000000000) - 6755399441056767.0;
    const vector f = vector_from_bits(bits - (biased << 52) + 0x3ff0000000000000) - 1, s = f / (2 + f), z = s * s;
    const vector half = f * f * 0.5;
    const vector rest = z * (0.6666666666666666 + z * (0.4000000000000088 + z * (0.28571428570801954 + z * (0.22222222392089008 + z * (0.18181795600060793 + z * (0.15386241881938595 + z * (0.13268714792348096 + z * 0.1308723619665962)))))));
    const vector y = k * 0.6931471805601177 - ((half - (s * (half + rest) + k * -1.7239444525614835e-13)) - f);
    const vector small = vector_select(x < 0, vector_of(NAN), vector_of(-HUGE_VAL));
    const vector finite = vector_select(x > 2.2250738585072009e-308, y, small);
    return vector_select(x <= 1.7976931348623157e308, finite, x);
}

/* log(1 + x), within 2 units in the last place. */
INLINE vector log1p_each(vector x) {
    const vector u = 1 + x;
    return vector_select(x <= 1.7976931348623157e308, log_each(u) + (x - (u - 1)) / u, x);
}

/* asinh, within 3 units in the last place. */
INLINE vector asinh_each(vector x) {
    const vector a = abs_each(x), square = a * a;
    const vector near = log1p_each(a + square / (1 + sqrt_each(1 + square)));
    return signed_each(vector_select(a > 134217728.0, log_each(a) + 0.6931471805599453, near), x);
}

/* Of degree 11 on [0, 1], its relative error below 2^-56. */
INLINE vector vector_polynomial_eta(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return -0.3333333333333333 + x * 0.03888888888888882 + x2 * (-0.004695767195763986 + x *
        0.0005742945325677045) + x4 * (-7.068869857715428e-05 + x * 8.73377493462523e-06 + x2 *
        (-1.081704433585778e-06 + x * 1.3417193242135835e-07)) + x8 * (-1.6621793563008396e-08 + x *
        2.0201168790031167e-09 + x2 * (-2.2052156012759445e-10 + x * 1.571171820836068e-11));
}

/* Of degree 11 on [0, 1], the derivative of a polynomial. */
INLINE vector vector_polynomial_eta_slope(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.15555555555555556 + x * -0.03756613756613715 + x2 * (0.00689153439151469 + x *
        -0.0011310191862053624) + x4 * (0.00017467556212788076 + x * -2.5961179550403887e-05 + x2 *
        (3.7575671816986786e-06 + x * -5.332547379314519e-07)) + x8 * (7.431542814507216e-08 + x *
        -9.989583870693198e-09 + x2 * (1.1796388215400893e-09 + x * -8.854985513574796e-11));
}

/* What pairs read of points x. */
OUTLINE void pair_features(
    const vector *x, vector *X) {
    const vector x0 = x[0];
    const vector x1 = x[1];
    const vector x2 = x[2];
    const vector h0 = 0.5 * x0;
    const vector h1 = 0.5 * x1;
    const vector h2 = 0.5 * x2;
    X[0] = h0;
    X[1] = h1;
    X[2] = h2;
}

/* What pairs read of a splat, of some splats. */
OUTLINE void pair_constants(
    const vector *mu, const vector *W, const vector *amplitude, vector *S) {
    const vector mu0 = mu[0];
    const vector mu1 = mu[1];
    const vector mu2 = mu[2];
    const vector W0_0 = W[0];
    const vector W0_1 = W[1];
    const vector W0_2 = W[2];
    const vector W1_0 = W[3];
    const vector W1_1 = W[4];
    const vector W1_2 = W[5];
    const vector its_amplitude = amplitude[0];
    const vector M0 = 0.5 * mu0;
    const vector M1 = 0.5 * mu1;
    const vector M2 = 0.5 * mu2;
    const vector by_normal_part = mu2 * W0_2 + mu1 * W0_1 + mu0 * W0_0;
    const vector gap = W0_0 - mu0 * by_normal_part;
    const vector R0_0 = gap + gap;
    const vector total_2 = W0_1 + mu1 * by_normal_part;
    const vector R0_1 = total_2 + total_2;
    const vector total_3 = W0_2 + mu2 * by_normal_part;
    const vector R0_2 = total_3 + total_3;
    const vector by_normal_part_2 = mu2 * W1_2 + mu1 * W1_1 + mu0 * W1_0;
    const vector gap_2 = W1_0 - mu0 * by_normal_part_2;
    const vector R1_0 = gap_2 + gap_2;
    const vector total_4 = W1_1 + mu1 * by_normal_part_2;
    const vector R1_1 = total_4 + total_4;
    const vector total_5 = W1_2 + mu2 * by_normal_part_2;
    const vector R1_2 = total_5 + total_5;
    S[0] = its_amplitude;
    S[1] = M0;
    S[2] = M1;
    S[3] = M2;
    S[4] = R0_0;
    S[5] = R0_1;
    S[6] = R0_2;
    S[7] = R1_0;
    S[8] = R1_1;
    S[9] = R1_2;
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
    struct { vector u, w, near_chosen, sqrt_2, half_angle, half_angle_product, ratio, a, gaussian; }
            kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double M0 = S[1];
        const double M1 = S[2];
        const double M2 = S[3];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 3 * b;
            const vector h0 = X[0];
            const vector h1 = X[1];
            const vector h2 = X[2];
            const vector gap = h0 - M0;
            const vector minus = -(gap * gap + (h1 - M1) * (M1 - h1) + (h2 - M2) * (M2 - h2));
            const vector u = vector_select(minus < 0.0, vector_of(0.0), minus);
            const vector w = sqrt_each(1.0 + u);
            kept[k][b].u = u;
            kept[k][b].w = w;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector u = kept[k][b].u;
            const vector w = kept[k][b].w;
            const vector_mask its_near = w < 1.25;
            const vector near_chosen = vector_select(its_near, vector_of(1.0), u);
            const vector sqrt_2 = sqrt_each(near_chosen);
            kept[k][b].near_chosen = near_chosen;
            kept[k][b].sqrt_2 = sqrt_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector w = kept[k][b].w;
            const vector sqrt_2 = kept[k][b].sqrt_2;
            const vector half_angle = log_each(w + sqrt_2);
            kept[k][b].half_angle = half_angle;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector near_chosen = kept[k][b].near_chosen;
            const vector sqrt_2 = kept[k][b].sqrt_2;
            const vector half_angle = kept[k][b].half_angle;
            const vector half_angle_product = sqrt_2 * half_angle;
            const vector ratio = 1.0 / (near_chosen * half_angle_product);
            kept[k][b].half_angle_product = half_angle_product;
            kept[k][b].ratio = ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector u = kept[k][b].u;
            const vector w = kept[k][b].w;
            const vector near_chosen = kept[k][b].near_chosen;
            const vector half_angle_product = kept[k][b].half_angle_product;
            const vector ratio = kept[k][b].ratio;
            const vector_mask its_near = w < 1.25;
            const vector eta = vector_polynomial_eta(4.0 * vector_select(its_near, w - 1.0, vector_of(0.0)));
            const vector u_product = u * vector_select(its_near, eta, near_chosen * ratio - w * (half_angle_product *
                ratio));
            const vector a = 1.0 / (w * (w + u_product));
            kept[k][b].a = a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double R0_0 = S[4];
        const double R0_1 = S[5];
        const double R0_2 = S[6];
        const double R1_0 = S[7];
        const double R1_1 = S[8];
        const double R1_2 = S[9];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 3 * b;
            const vector a = kept[k][b].a;
            const vector h0 = X[0];
            const vector h1 = X[1];
            const vector h2 = X[2];
            const vector a_squared = a * a;
            const vector r0 = h0 * R0_0 + h1 * R0_1 + h2 * R0_2;
            const vector r1 = h0 * R1_0 + h1 * R1_1 + h2 * R1_2;
            const vector square = a_squared * (r0 * r0 + r1 * r1);
            const vector gaussian = gaussian_each(square);
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double amplitude = S[0];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            const vector a = kept[k][b].a;
            const vector gaussian = kept[k][b].gaussian;
            const vector phi = a * gaussian;
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
    struct { vector u, w, near_chosen, sqrt_2, half_angle, half_angle_product, ratio, near_chosen_2, w_total,
            a, a_squared, r0, r1, square, gaussian; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double M0 = S[1];
        const double M1 = S[2];
        const double M2 = S[3];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 3 * b;
            const vector h0 = X[0];
            const vector h1 = X[1];
            const vector h2 = X[2];
            const vector gap = h0 - M0;
            const vector minus = -(gap * gap + (h1 - M1) * (M1 - h1) + (h2 - M2) * (M2 - h2));
            const vector u = vector_select(minus < 0.0, vector_of(0.0), minus);
            const vector w = sqrt_each(1.0 + u);
            kept[k][b].u = u;
            kept[k][b].w = w;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector u = kept[k][b].u;
            const vector w = kept[k][b].w;
            const vector_mask its_near = w < 1.25;
            const vector near_chosen = vector_select(its_near, vector_of(1.0), u);
            const vector sqrt_2 = sqrt_each(near_chosen);
            kept[k][b].near_chosen = near_chosen;
            kept[k][b].sqrt_2 = sqrt_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector w = kept[k][b].w;
            const vector sqrt_2 = kept[k][b].sqrt_2;
            const vector half_angle = log_each(w + sqrt_2);
            kept[k][b].half_angle = half_angle;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector near_chosen = kept[k][b].near_chosen;
            const vector sqrt_2 = kept[k][b].sqrt_2;
            const vector half_angle = kept[k][b].half_angle;
            const vector half_angle_product = sqrt_2 * half_angle;
            const vector ratio = 1.0 / (near_chosen * half_angle_product);
            kept[k][b].half_angle_product = half_angle_product;
            kept[k][b].ratio = ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector u = kept[k][b].u;
            const vector w = kept[k][b].w;
            const vector near_chosen = kept[k][b].near_chosen;
            const vector half_angle_product = kept[k][b].half_angle_product;
            const vector ratio = kept[k][b].ratio;
            const vector_mask its_near = w < 1.25;
            const vector eta = vector_polynomial_eta(4.0 * vector_select(its_near, w - 1.0, vector_of(0.0)));
            const vector near_chosen_2 = vector_select(its_near, eta, near_chosen * ratio - w * (half_angle_product *
                ratio));
            const vector w_total = w + u * near_chosen_2;
            const vector a = 1.0 / (w * w_total);
            kept[k][b].near_chosen_2 = near_chosen_2;
            kept[k][b].w_total = w_total;
            kept[k][b].a = a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double R0_0 = S[4];
        const double R0_1 = S[5];
        const double R0_2 = S[6];
        const double R1_0 = S[7];
        const double R1_1 = S[8];
        const double R1_2 = S[9];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 3 * b;
            const vector a = kept[k][b].a;
            const vector h0 = X[0];
            const vector h1 = X[1];
            const vector h2 = X[2];
            const vector a_squared = a * a;
            const vector r0 = h0 * R0_0 + h1 * R0_1 + h2 * R0_2;
            const vector r1 = h0 * R1_0 + h1 * R1_1 + h2 * R1_2;
            const vector square = a_squared * (r0 * r0 + r1 * r1);
            const vector gaussian = gaussian_each(square);
            kept[k][b].a_squared = a_squared;
            kept[k][b].r0 = r0;
            kept[k][b].r1 = r1;
            kept[k][b].square = square;
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double amplitude = S[0];
        const double M0 = S[1];
        const double M1 = S[2];
        const double M2 = S[3];
        const double R0_0 = S[4];
        const double R0_1 = S[5];
        const double R0_2 = S[6];
        const double R1_0 = S[7];
        const double R1_1 = S[8];
        const double R1_2 = S[9];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            vector *slope = slopes + 3 * b;
            const vector near_chosen_2 = kept[k][b].near_chosen_2;
            const vector w_total = kept[k][b].w_total;
            const vector a = kept[k][b].a;
            const vector a_squared = kept[k][b].a_squared;
            const vector r0 = kept[k][b].r0;
            const vector r1 = kept[k][b].r1;
            const vector square = kept[k][b].square;
            const vector gaussian = kept[k][b].gaussian;
            const vector phi = a * gaussian;
            const vector phi_2 = amplitude * phi;
            const vector phi_product = phi_2 * a_squared;
            const vector r1_product = r1 * phi_product;
            const vector r0_product = r0 * phi_product;
            const vector over_w = w_total * a;
            const vector over_w_product = over_w * ((near_chosen_2 - over_w) * (phi_2 - phi_2 * square));
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] - R1_0 * r1_product - R0_0 * r0_product + M0 * over_w_product;
            slope[1] = slope[1] - R1_1 * r1_product - R0_1 * r0_product - M1 * over_w_product;
            slope[2] = slope[2] - R1_2 * r1_product - R0_2 * r0_product - M2 * over_w_product;
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient(
    const vector *x, const vector *slope, vector *gradient) {
    const vector x0 = x[0];
    const vector x1 = x[1];
    const vector x2 = x[2];
    const vector slope_h0 = slope[0];
    const vector slope_h1 = slope[1];
    const vector slope_h2 = slope[2];
    const vector product = 0.5 * slope_h0;
    const vector product_2 = 0.5 * slope_h1;
    const vector product_3 = 0.5 * slope_h2;
    const vector normal_part = x0 * product + x1 * product_2 + x2 * product_3;
    gradient[0] = x0 * normal_part - product;
    gradient[1] = product_2 + x1 * normal_part;
    gradient[2] = product_3 + x2 * normal_part;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp(
    const vector *x, const vector *gradient_bar, vector *slope_bar) {
    const vector x0 = x[0];
    const vector x1 = x[1];
    const vector x2 = x[2];
    const vector gradient_bar0 = gradient_bar[0];
    const vector gradient_bar1 = gradient_bar[1];
    const vector gradient_bar2 = gradient_bar[2];
    const vector by_normal_part = x2 * gradient_bar2 + x1 * gradient_bar1 + x0 * gradient_bar0;
    slope_bar[0] = 0.5 * (x0 * by_normal_part - gradient_bar0);
    slope_bar[1] = 0.5 * (gradient_bar1 + x1 * by_normal_part);
    slope_bar[2] = 0.5 * (gradient_bar2 + x2 * by_normal_part);
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
    struct { vector u, w, product, near_chosen, sqrt_2, half_angle, half_angle_product, ratio, product_2,
            product_3, w_product, near_chosen_2, w_total, a, a_squared, r0, r1, square, gaussian; } kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 7 * (size_t)near[i];
        const vector h0 = X[0];
        const vector h1 = X[1];
        const vector h2 = X[2];
        const double M0 = S[1];
        const double M1 = S[2];
        const double M2 = S[3];
        const vector gap = h0 - M0;
        const vector minus = -(gap * gap + (h1 - M1) * (M1 - h1) + (h2 - M2) * (M2 - h2));
        const vector u = vector_select(minus < 0.0, vector_of(0.0), minus);
        const vector w = sqrt_each(1.0 + u);
        kept[i].u = u;
        kept[i].w = w;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector u = kept[i].u;
        const vector w = kept[i].w;
        const vector_mask its_near = w < 1.25;
        const vector near_chosen = vector_select(its_near, vector_of(1.0), u);
        const vector sqrt_2 = sqrt_each(near_chosen);
        kept[i].near_chosen = near_chosen;
        kept[i].sqrt_2 = sqrt_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector w = kept[i].w;
        const vector sqrt_2 = kept[i].sqrt_2;
        const vector half_angle = log_each(w + sqrt_2);
        kept[i].half_angle = half_angle;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector near_chosen = kept[i].near_chosen;
        const vector sqrt_2 = kept[i].sqrt_2;
        const vector half_angle = kept[i].half_angle;
        const vector half_angle_product = sqrt_2 * half_angle;
        const vector ratio = 1.0 / (near_chosen * half_angle_product);
        kept[i].half_angle_product = half_angle_product;
        kept[i].ratio = ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector u = kept[i].u;
        const vector w = kept[i].w;
        const vector near_chosen = kept[i].near_chosen;
        const vector half_angle_product = kept[i].half_angle_product;
        const vector ratio = kept[i].ratio;
        const vector_mask its_near = w < 1.25;
        const vector product = 4.0 * vector_select(its_near, w - 1.0, vector_of(0.0));
        const vector eta = vector_polynomial_eta(product);
        const vector product_2 = near_chosen * ratio;
        const vector product_3 = half_angle_product * ratio;
        const vector w_product = w * product_3;
        const vector near_chosen_2 = vector_select(its_near, eta, product_2 - w_product);
        const vector w_total = w + u * near_chosen_2;
        const vector a = 1.0 / (w * w_total);
        kept[i].product = product;
        kept[i].product_2 = product_2;
        kept[i].product_3 = product_3;
        kept[i].w_product = w_product;
        kept[i].near_chosen_2 = near_chosen_2;
        kept[i].w_total = w_total;
        kept[i].a = a;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 7 * (size_t)near[i];
        const vector a = kept[i].a;
        const vector h0 = X[0];
        const vector h1 = X[1];
        const vector h2 = X[2];
        const double R0_0 = S[4];
        const double R0_1 = S[5];
        const double R0_2 = S[6];
        const double R1_0 = S[7];
        const double R1_1 = S[8];
        const double R1_2 = S[9];
        const vector a_squared = a * a;
        const vector r0 = h0 * R0_0 + h1 * R0_1 + h2 * R0_2;
        const vector r1 = h0 * R1_0 + h1 * R1_1 + h2 * R1_2;
        const vector square = a_squared * (r0 * r0 + r1 * r1);
        const vector gaussian = gaussian_each(square);
        kept[i].a_squared = a_squared;
        kept[i].r0 = r0;
        kept[i].r1 = r1;
        kept[i].square = square;
        kept[i].gaussian = gaussian;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 7 * (size_t)near[i];
        const vector *value_bar = points + 7 * (size_t)near[i] + 3;
        const vector *slope_bar = points + 7 * (size_t)near[i] + 3 + 1;
        const vector w = kept[i].w;
        const vector product = kept[i].product;
        const vector near_chosen = kept[i].near_chosen;
        const vector product_2 = kept[i].product_2;
        const vector product_3 = kept[i].product_3;
        const vector w_product = kept[i].w_product;
        const vector near_chosen_2 = kept[i].near_chosen_2;
        const vector w_total = kept[i].w_total;
        const vector a = kept[i].a;
        const vector a_squared = kept[i].a_squared;
        const vector r0 = kept[i].r0;
        const vector r1 = kept[i].r1;
        const vector square = kept[i].square;
        const vector gaussian = kept[i].gaussian;
        const vector h0 = X[0];
        const vector h1 = X[1];
        const vector h2 = X[2];
        const double M0 = S[1];
        const double M1 = S[2];
        const double M2 = S[3];
        const double R0_0 = S[4];
        const double R0_1 = S[5];
        const double R0_2 = S[6];
        const double R1_0 = S[7];
        const double R1_1 = S[8];
        const double R1_2 = S[9];
        const vector its_value_bar = value_bar[0];
        const vector h0_bar = slope_bar[0];
        const vector h1_bar = slope_bar[1];
        const vector h2_bar = slope_bar[2];
        const vector_mask its_near = w < 1.25;
        const vector phi = a * gaussian;
        const vector over_w = w_total * a;
        const vector over_w_gap = near_chosen_2 - over_w;
        const vector gap_2 = M0 * h0_bar - M1 * h1_bar - M2 * h2_bar;
        const vector over_w_product = over_w * gap_2;
        const vector product_4 = over_w_gap * over_w_product;
        const vector gap_3 = -(R1_0 * h0_bar) - R1_1 * h1_bar - R1_2 * h2_bar;
        const vector gap_4 = -(R0_0 * h0_bar) - R0_1 * h1_bar - R0_2 * h2_bar;
        const vector total_2 = r1 * gap_3 + r0 * gap_4;
        const vector by_phi = its_value_bar + product_4 + a_squared * total_2 - square * product_4;
        const vector phi_product = phi * by_phi;
        const vector phi_gap = phi - phi * square;
        const vector product_5 = over_w_gap * phi_gap;
        const vector over_w_product_2 = over_w * product_5;
        const vector eta_slope = vector_polynomial_eta_slope(product);
        const vector product_6 = phi_gap * over_w_product;
        const vector product_7 = vector_select(its_near, eta_slope, (2.0 + near_chosen) * (product_3 * product_3)
            - product_2 * (product_2 + w_product)) * product_6;
        const vector gap_5 = -2.0 * (phi * product_4) - phi_product;
        const vector product_8 = over_w_gap * (2.0 * a_squared * (phi * total_2) + phi_product + square * gap_5);
        const vector total_3 = product_7 - over_w * over_w * (product_5 * gap_2 - product_6) + product_8;
        const vector over_w_product_3 = over_w * total_3;
        const vector phi_product_2 = phi * a_squared;
        const vector a_squared_product = a_squared * gap_5;
        const vector by_r0 = phi_product_2 * gap_4 + r0 * a_squared_product;
        const vector r0_product = r0 * phi_product_2;
        const vector by_r1 = phi_product_2 * gap_3 + r1 * a_squared_product;
        const vector r1_product = r1 * phi_product_2;
        sums[0] = sums[0] + phi_product;
        sums[1] = sums[1] + over_w_product_2 * h0_bar + h0 * over_w_product_3;
        sums[2] = sums[2] - over_w_product_2 * h1_bar - h1 * over_w_product_3;
        sums[3] = sums[3] - over_w_product_2 * h2_bar - h2 * over_w_product_3;
        sums[4] = sums[4] + h0 * by_r0 - r0_product * h0_bar;
        sums[5] = sums[5] + h1 * by_r0 - r0_product * h1_bar;
        sums[6] = sums[6] + h2 * by_r0 - r0_product * h2_bar;
        sums[7] = sums[7] + h0 * by_r1 - r1_product * h0_bar;
        sums[8] = sums[8] + h1 * by_r1 - r1_product * h1_bar;
        sums[9] = sums[9] + h2 * by_r1 - r1_product * h2_bar;
    }
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp(
    const vector *mu, const vector *W, const vector *amplitude, const vector *sums, vector *mu_bar, vector *W_bar, vector *amplitude_bar) {
    const vector mu0 = mu[0];
    const vector mu1 = mu[1];
    const vector mu2 = mu[2];
    const vector W0_0 = W[0];
    const vector W0_1 = W[1];
    const vector W0_2 = W[2];
    const vector W1_0 = W[3];
    const vector W1_1 = W[4];
    const vector W1_2 = W[5];
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
    const vector by_normal_part = mu2 * W0_2 + mu1 * W0_1 + mu0 * W0_0;
    const vector total_2 = sum4 + sum4;
    const vector total_3 = sum5 + sum5;
    const vector total_4 = sum6 + sum6;
    const vector by_by_normal_part = mu1 * total_3 - mu0 * total_2 + mu2 * total_4;
    const vector by_normal_part_2 = mu2 * W1_2 + mu1 * W1_1 + mu0 * W1_0;
    const vector total_5 = sum7 + sum7;
    const vector total_6 = sum8 + sum8;
    const vector total_7 = sum9 + sum9;
    const vector by_by_normal_part_2 = mu1 * total_6 - mu0 * total_5 + mu2 * total_7;
    const vector total_8 = 0.5 * sum1 - by_normal_part * total_2 + W0_0 * by_by_normal_part - by_normal_part_2
        * total_5 + W1_0 * by_by_normal_part_2;
    const vector total_9 = 0.5 * sum2 + by_normal_part * total_3 + W0_1 * by_by_normal_part + by_normal_part_2
        * total_6 + W1_1 * by_by_normal_part_2;
    const vector total_10 = 0.5 * sum3 + by_normal_part * total_4 + W0_2 * by_by_normal_part +
        by_normal_part_2 * total_7 + W1_2 * by_by_normal_part_2;
    mu_bar[0] = its_amplitude * total_8;
    mu_bar[1] = its_amplitude * total_9;
    mu_bar[2] = its_amplitude * total_10;
    W_bar[0] = its_amplitude * (total_2 + mu0 * by_by_normal_part);
    W_bar[1] = its_amplitude * (total_3 + mu1 * by_by_normal_part);
    W_bar[2] = its_amplitude * (total_4 + mu2 * by_by_normal_part);
    W_bar[3] = its_amplitude * (total_5 + mu0 * by_by_normal_part_2);
    W_bar[4] = its_amplitude * (total_6 + mu1 * by_by_normal_part_2);
    W_bar[5] = its_amplitude * (total_7 + mu2 * by_by_normal_part_2);
    amplitude_bar[0] = sum0;
}

/* The distances of some points q from one point p. */
OUTLINE void pair_distances(
    const double *p, const vector *q, vector *distance) {
    const double p1 = p[1];
    const double p2 = p[2];
    const vector q1 = q[1];
    const vector q2 = q[2];
    const vector S0 = p1 + q1;
    const vector S1 = p2 + q2;
    const vector dot_S_S = S0 * S0 + S1 * S1;
    const vector D0 = q1 - p1;
    const vector D1 = q2 - p2;
    const vector dot_D_D = D0 * D0 + D1 * D1;
    const vector dot_D_S = S0 * D0 + S1 * D1;
    const double dot_ps_ps = p1 * p1 + p2 * p2;
    const vector a = sqrt_each(vector_of(1.0 + dot_ps_ps));
    const vector dot_qs_qs = q1 * q1 + q2 * q2;
    const vector its_b = sqrt_each(1.0 + dot_qs_qs);
    const vector a_total = a + its_b;
    const vector e = dot_D_S / a_total;
    const vector_mask is_small = dot_S_S < 1.0;
    const vector dot_D_S_ratio = dot_D_S / vector_select(is_small, vector_of(1.0), dot_S_S);
    const vector dot_ps_qs = p1 * q1 + p2 * q2;
    const vector c = (2.0 + its_b * (2.0 * a) - 2.0 * dot_ps_qs) / (a_total * a_total);
    const vector rest0 = D0 - S0 * dot_D_S_ratio;
    const vector rest1 = D1 - S1 * dot_D_S_ratio;
    const vector dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const vector ww = vector_select(is_small, dot_D_D - e * e, dot_rest_rest + dot_D_S_ratio * (dot_D_S * c));
    const vector sqrt_ww = sqrt_each(ww);
    const vector asinh_sqrt_ww_over_2 = asinh_each(0.5 * sqrt_ww);
    const vector r = 2.0 * asinh_sqrt_ww_over_2;
    distance[0] = r;
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

/* Scratch memory: 7 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t hyperbolic_splats_work(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES - 1) / LANES, blocks = (points + 2 - 1) / 2;
    const size_t places = 4 * ((splat_count + LANES - 1) / LANES + (blocks + LANES - 1) / LANES);
    return (points * 7 + places + 1) * LANES + 10 * splat_count;
}

static vector *work_points(double *work) {
    const uintptr_t size = sizeof(vector), start = (uintptr_t)work;
    return (vector *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const double *splat_at(const vector *splats, size_t k) {
    const size_t row = k / LANES;
    return (const double *)(splats + 4 * row) + (k - row * LANES);
}

static vector *work_reaches(double *work, size_t count) {
    return work_points(work) + (count + LANES - 1) / LANES * 7;
}

static vector *work_blocks(double *work, size_t count, size_t splat_count) {
    return work_reaches(work, count) + 4 * ((splat_count + LANES - 1) / LANES);
}

static double *work_constants(double *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES, blocks = (count + size - 1) / size;
    return (double *)(work_blocks(work, count, splat_count) + 4 * ((blocks + LANES - 1) / LANES));
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
    vector *own = splats + start / LANES * (3 + 1);
    vector_rows(width, splat_count, start, 1, own + 3);
    own[3] = own[3] * 9.014149034296874 + vector_spoilt(mu, 3) + vector_spoilt(amplitude, 1);
    for (int i = 0; i < 3; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place(const double *x, size_t count, size_t start, double *place) {
    const size_t size = count - start < 2 * LANES ? count - start : 2 * LANES;
    vector at[2][3], spoilt = ZERO;
    for (size_t b = 0; b < 2; ++b) {
        vector_rows(x, count, start + b * LANES, 3, at[b]);
        spoilt += vector_spoilt(at[b], 3);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const double *middle = x + 3 * (start + i * size / 8);
        double radius = 0, column[LANES];
        for (size_t b = 0; b < 2; ++b) {
            vector distance[1];
            pair_distances(middle, at[b], distance);
            vector_store(column, distance[0]);
            for (size_t lane = 0; lane < LANES; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[3]) {
            for (int j = 0; j < 3; ++j) place[j] = middle[j];
            place[3] = radius;
        }
    }
    place[3] = place[3] * 1.0078125 + vector_sum(spoilt);
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
        const vector *own = splats + start / LANES * (3 + 1);
        vector distance[1];
        pair_distances(place, own, distance);
        const vector_mask far = vector_far(distance[0], own[3], vector_of(place[3]));
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
        const vector *own = blocks + start / group * (3 + 1);
        vector distance[1];
        pair_distances(mu, own, distance);
        const vector_mask far = vector_far(distance[0], vector_of(*reach), own[3]);
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
    vector own_mu[3], own_W[6], own_amplitude[1], S[10];
    vector_rows(mu, splat_count, start, 3, own_mu);
    vector_rows(W, splat_count, start, 6, own_W);
    vector_rows(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants(own_mu, own_W, own_amplitude, S);
    vector_to_rows(S, constants, splat_count, start, 10, 10);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void hyperbolic_splats(
    size_t count, size_t splat_count, const double *HYPERBOLIC_RESTRICT x, const double *HYPERBOLIC_RESTRICT mu, const double *HYPERBOLIC_RESTRICT W, const double *HYPERBOLIC_RESTRICT amplitude, const double *HYPERBOLIC_RESTRICT width,
    double *HYPERBOLIC_RESTRICT value, double *HYPERBOLIC_RESTRICT gradient, double *HYPERBOLIC_RESTRICT work, int threads) {
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
            vector at[2][3], X[2 * 3], grad[3];
            vector value_sum[2] = {ZERO}, slope_sum[2 * 3] = {ZERO};
            double place[3 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 3, at[b]);
                pair_features(at[b], X + 3 * b);
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
                pair_gradient(at[b], slope_sum + 3 * b, grad);
                vector_to_rows(value_sum + b, value, count, start + b * LANES, 1, 1);
                vector_to_rows(grad, gradient, count, start + b * LANES, 3, 3);
            }
        }
        restore_denormals(mode);
    }
}

void hyperbolic_splats_value(
    size_t count, size_t splat_count, const double *HYPERBOLIC_RESTRICT x, const double *HYPERBOLIC_RESTRICT mu, const double *HYPERBOLIC_RESTRICT W, const double *HYPERBOLIC_RESTRICT amplitude, const double *HYPERBOLIC_RESTRICT width,
    double *HYPERBOLIC_RESTRICT value, double *HYPERBOLIC_RESTRICT work, int threads) {
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
            vector at[3], X[2 * 3], value_sum[2] = {ZERO};
            double place[3 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 3, at);
                pair_features(at, X + 3 * b);
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
    vector at[3], grad_bar[3], slope_bar[3];
    vector_rows(x, count, start, 3, at);
    vector_rows(gradient_bar, count, start, 3, grad_bar);
    vector_rows(value_bar, count, start, 1, point + 3);
    pair_features(at, point);
    pair_gradient_vjp(at, grad_bar, slope_bar);
    for (int i = 0; i < 3; ++i) point[3 + 1 + i] = slope_bar[i];
    vector_end(count, start, 3 + 1, point + 3);
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums(const vector *points, const uint32_t *near, size_t size, const double *S, double *sums) {
    vector sum[10] = {ZERO};
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
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void hyperbolic_splats_vjp(
    size_t count, size_t splat_count, const double *HYPERBOLIC_RESTRICT x, const double *HYPERBOLIC_RESTRICT mu, const double *HYPERBOLIC_RESTRICT W, const double *HYPERBOLIC_RESTRICT amplitude, const double *HYPERBOLIC_RESTRICT width, const double *HYPERBOLIC_RESTRICT value_bar, const double *HYPERBOLIC_RESTRICT gradient_bar,
    double *HYPERBOLIC_RESTRICT mu_bar, double *HYPERBOLIC_RESTRICT W_bar, double *HYPERBOLIC_RESTRICT amplitude_bar, double *HYPERBOLIC_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES - 1) / LANES;
    const size_t chunk = 131072 / (7 * sizeof(vector)) + 1;
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
                double place[3 + 1];
                const size_t last = (blocks - 1) / 2, start = (block < last ? block : last) * 2;
                block_place(x, count, start * LANES, place);
                for (int i = 0; i < 4; ++i) {
                    double *row = (double *)(places + block / LANES * 4 + i);
                    row[block - block / LANES * LANES] = place[i];
                }
            }
        }
        OMP(omp for schedule(dynamic, 8))
        for (size_t block = 0; block < blocks; ++block)
            splat_points(count, block * LANES, x, value_bar, gradient_bar, points + 7 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            double sums[LANES][10] = {{0}};
            uint32_t near[131072 / (7 * sizeof(vector)) + 2];
            vector own_mu[3], own_W[6], own_amplitude[1], own_sums[10], bars[10];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const double *reach = width ? splat_at(splats, k) + 3 * LANES : NULL;
                    const size_t some = blocks_near(mu + 3 * k, reach, places, first, first + size, near);
                    splat_sums(points + 7 * first, near, some, constants + 10 * k, sums[k - start]);
                }
            }
            vector_rows(mu, end, start, 3, own_mu);
            vector_rows(W, end, start, 6, own_W);
            vector_rows(amplitude, end, start, 1, own_amplitude);
            vector_rows(sums[0], LANES, 0, 10, own_sums);
            pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 3, bars + 3 + 6);
            vector_to_rows(bars, mu_bar, end, start, 3, 3);
            vector_to_rows(bars + 3, W_bar, end, start, 6, 6);
            vector_to_rows(bars + 3 + 6, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void hyperbolic_splats_rows(
    size_t count, size_t splat_count, const double *HYPERBOLIC_RESTRICT x, const double *HYPERBOLIC_RESTRICT mu, const double *HYPERBOLIC_RESTRICT W, const double *HYPERBOLIC_RESTRICT amplitude, const double *HYPERBOLIC_RESTRICT value_bar, const double *HYPERBOLIC_RESTRICT gradient_bar,
    double *HYPERBOLIC_RESTRICT rows, double *HYPERBOLIC_RESTRICT work, int threads) {
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
            vector point[7];
            splat_points(count, block * LANES, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector own_mu[3], own_W[6], own_amplitude[1], own_sums[10] = {ZERO}, bars[10];
                for (int i = 0; i < 3; ++i) own_mu[i] = vector_of(mu[3 * k + i]);
                for (int i = 0; i < 6; ++i) own_W[i] = vector_of(W[6 * k + i]);
                own_amplitude[0] = vector_of(amplitude[k]);
                pair_backward(1, point, &only, constants + 10 * k, own_sums);
                pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 3, bars + 3 + 6);
                vector_to_rows(bars, rows + 10 * k, count, block * LANES, 10, 10 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

/* A coordinate to sort by. */
INLINE double order_key(const double *x, size_t row, size_t axis) {
    const double key = x[3 * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest(const double *x, const size_t *order, size_t count) {
    double low[3], high[3];
    size_t widest = 0;
    for (size_t axis = 0; axis < 3; ++axis) low[axis] = high[axis] = order_key(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < 3; ++axis) {
            const double key = order_key(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < 3; ++axis)
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

double hyperbolic_splats_order(
    size_t count, size_t splat_count, const double *HYPERBOLIC_RESTRICT x, const double *HYPERBOLIC_RESTRICT mu, const double *HYPERBOLIC_RESTRICT amplitude, const double *HYPERBOLIC_RESTRICT width,
    double limit, size_t *HYPERBOLIC_RESTRICT order, double *HYPERBOLIC_RESTRICT work) {
    const size_t block = 2 * LANES;
    vector *splats = work_reaches(work, 0);
    uint32_t near[256];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES) {
        vector own_mu[3], own_amplitude[1];
        vector_rows(mu, splat_count, start, 3, own_mu);
        vector_rows(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks(x, order, count, (double *)work_blocks(work, 0, splat_count));
        for (size_t i = 1; i < 2 * 16; i += 2) {
            double rows[2 * LANES * 3], place[3 + 1];
            const size_t some = i * count / (2 * 16), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < 3; ++j) rows[3 * n + j] = x[3 * order[start + n] + j];
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

/* log = k log 2 + log m, sqrt(1/2) <= m < sqrt(2), within 1 unit in the last place. */
INLINE vector_f log_each_f(vector_f x) {
    const vector_bits_f bits = vector_to_bits_f(x), biased = (bits + 0x4afb0d) >> 23; /* k + 127 */
    const vector_f k = vector_from_bits_f(biased + 0x4b400000) - 12583039.0f;
    const vector_f f = vector_from_bits_f(bits - (biased << 23) + 0x3f800000) - 1, s = f / (2 + f), z = s * s;
    const vector_f half = f * f * 0.5f;
    const vector_f rest = z * (0.6666666655430018f + z * (0.4000012200081688f + z * (0.2855080255327671f + z * 0.2333096405177204f)));
    const vector_f y = k * 0.693145751953125f - ((half - (s * (half + rest) + k * 1.4286068203094173e-06f)) - f);
    const vector_f small = vector_select_f(x < 0, vector_of_f(NAN), vector_of_f(-HUGE_VALF));
    const vector_f finite = vector_select_f(x > 1.17549421e-38f, y, small);
    return vector_select_f(x <= 3.4028234663852886e38f, finite, x);
}

/* log(1 + x), within 2 units in the last place. */
INLINE vector_f log1p_each_f(vector_f x) {
    const vector_f u = 1 + x;
    return vector_select_f(x <= 3.4028234663852886e38f, log_each_f(u) + (x - (u - 1)) / u, x);
}

/* asinh, within 3 units in the last place. */
INLINE vector_f asinh_each_f(vector_f x) {
    const vector_f a = abs_each_f(x), square = a * a;
    const vector_f near = log1p_each_f(a + square / (1 + sqrt_each_f(1 + square)));
    return signed_each_f(vector_select_f(a > 4096.0f, log_each_f(a) + 0.6931471805599453f, near), x);
}

/* Of degree 5, within 2^-29 of that of double precision. */
INLINE vector_f vector_polynomial_eta_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return -0.3333333329738172f + x * 0.038888862721119646f + x2 * (-0.004695457196731528f + x *
        0.0005729409253513102f) + x4 * (-6.797492497278703e-05f + x * 6.127417886832629e-06f);
}

/* Of degree 6, within 2^-31 of that of double precision. */
INLINE vector_f vector_polynomial_eta_slope_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return 0.15555555551604225f + x * -0.037566133653313336f + x2 * (0.006891470905338728f + x *
        -0.0011306306849031013f) + x4 * (0.00017353196911450256f + x * -2.4197931086547884e-05f + x2 *
        2.3412224833279386e-06f);
}

/* What pairs read of points x. */
OUTLINE void pair_features_f(
    const vector_f *x, vector_f *X) {
    const vector_f x0 = x[0];
    const vector_f x1 = x[1];
    const vector_f x2 = x[2];
    const vector_f h0 = 0.5f * x0;
    const vector_f h1 = 0.5f * x1;
    const vector_f h2 = 0.5f * x2;
    X[0] = h0;
    X[1] = h1;
    X[2] = h2;
}

/* What pairs read of a splat, of some splats. */
OUTLINE void pair_constants_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, vector_f *S) {
    const vector_f mu0 = mu[0];
    const vector_f mu1 = mu[1];
    const vector_f mu2 = mu[2];
    const vector_f W0_0 = W[0];
    const vector_f W0_1 = W[1];
    const vector_f W0_2 = W[2];
    const vector_f W1_0 = W[3];
    const vector_f W1_1 = W[4];
    const vector_f W1_2 = W[5];
    const vector_f its_amplitude = amplitude[0];
    const vector_f M0 = 0.5f * mu0;
    const vector_f M1 = 0.5f * mu1;
    const vector_f M2 = 0.5f * mu2;
    const vector_f by_normal_part = mu2 * W0_2 + mu1 * W0_1 + mu0 * W0_0;
    const vector_f gap = W0_0 - mu0 * by_normal_part;
    const vector_f R0_0 = gap + gap;
    const vector_f total_2 = W0_1 + mu1 * by_normal_part;
    const vector_f R0_1 = total_2 + total_2;
    const vector_f total_3 = W0_2 + mu2 * by_normal_part;
    const vector_f R0_2 = total_3 + total_3;
    const vector_f by_normal_part_2 = mu2 * W1_2 + mu1 * W1_1 + mu0 * W1_0;
    const vector_f gap_2 = W1_0 - mu0 * by_normal_part_2;
    const vector_f R1_0 = gap_2 + gap_2;
    const vector_f total_4 = W1_1 + mu1 * by_normal_part_2;
    const vector_f R1_1 = total_4 + total_4;
    const vector_f total_5 = W1_2 + mu2 * by_normal_part_2;
    const vector_f R1_2 = total_5 + total_5;
    S[0] = its_amplitude;
    S[1] = M0;
    S[2] = M1;
    S[3] = M2;
    S[4] = R0_0;
    S[5] = R0_1;
    S[6] = R0_2;
    S[7] = R1_0;
    S[8] = R1_1;
    S[9] = R1_2;
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
    struct { vector_f u, w, near_chosen, sqrt_2, half_angle, half_angle_product, ratio, a, gaussian; }
            kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float M0 = S[1];
        const float M1 = S[2];
        const float M2 = S[3];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 3 * b;
            const vector_f h0 = X[0];
            const vector_f h1 = X[1];
            const vector_f h2 = X[2];
            const vector_f gap = h0 - M0;
            const vector_f minus = -(gap * gap + (h1 - M1) * (M1 - h1) + (h2 - M2) * (M2 - h2));
            const vector_f u = vector_select_f(minus < 0.0f, vector_of_f(0.0f), minus);
            const vector_f w = sqrt_each_f(1.0f + u);
            kept[k][b].u = u;
            kept[k][b].w = w;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f u = kept[k][b].u;
            const vector_f w = kept[k][b].w;
            const vector_mask_f its_near = w < 1.25f;
            const vector_f near_chosen = vector_select_f(its_near, vector_of_f(1.0f), u);
            const vector_f sqrt_2 = sqrt_each_f(near_chosen);
            kept[k][b].near_chosen = near_chosen;
            kept[k][b].sqrt_2 = sqrt_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f w = kept[k][b].w;
            const vector_f sqrt_2 = kept[k][b].sqrt_2;
            const vector_f half_angle = log_each_f(w + sqrt_2);
            kept[k][b].half_angle = half_angle;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f near_chosen = kept[k][b].near_chosen;
            const vector_f sqrt_2 = kept[k][b].sqrt_2;
            const vector_f half_angle = kept[k][b].half_angle;
            const vector_f half_angle_product = sqrt_2 * half_angle;
            const vector_f ratio = 1.0f / (near_chosen * half_angle_product);
            kept[k][b].half_angle_product = half_angle_product;
            kept[k][b].ratio = ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f u = kept[k][b].u;
            const vector_f w = kept[k][b].w;
            const vector_f near_chosen = kept[k][b].near_chosen;
            const vector_f half_angle_product = kept[k][b].half_angle_product;
            const vector_f ratio = kept[k][b].ratio;
            const vector_mask_f its_near = w < 1.25f;
            const vector_f eta = vector_polynomial_eta_f(4.0f * vector_select_f(its_near, w - 1.0f,
                vector_of_f(0.0f)));
            const vector_f u_product = u * vector_select_f(its_near, eta, near_chosen * ratio - w *
                (half_angle_product * ratio));
            const vector_f a = 1.0f / (w * (w + u_product));
            kept[k][b].a = a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float R0_0 = S[4];
        const float R0_1 = S[5];
        const float R0_2 = S[6];
        const float R1_0 = S[7];
        const float R1_1 = S[8];
        const float R1_2 = S[9];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 3 * b;
            const vector_f a = kept[k][b].a;
            const vector_f h0 = X[0];
            const vector_f h1 = X[1];
            const vector_f h2 = X[2];
            const vector_f a_squared = a * a;
            const vector_f r0 = h0 * R0_0 + h1 * R0_1 + h2 * R0_2;
            const vector_f r1 = h0 * R1_0 + h1 * R1_1 + h2 * R1_2;
            const vector_f square = a_squared * (r0 * r0 + r1 * r1);
            const vector_f gaussian = gaussian_each_f(square);
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float amplitude = S[0];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            const vector_f a = kept[k][b].a;
            const vector_f gaussian = kept[k][b].gaussian;
            const vector_f phi = a * gaussian;
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
    struct { vector_f u, w, near_chosen, sqrt_2, half_angle, half_angle_product, ratio, near_chosen_2,
            w_total, a, a_squared, r0, r1, square, gaussian; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float M0 = S[1];
        const float M1 = S[2];
        const float M2 = S[3];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 3 * b;
            const vector_f h0 = X[0];
            const vector_f h1 = X[1];
            const vector_f h2 = X[2];
            const vector_f gap = h0 - M0;
            const vector_f minus = -(gap * gap + (h1 - M1) * (M1 - h1) + (h2 - M2) * (M2 - h2));
            const vector_f u = vector_select_f(minus < 0.0f, vector_of_f(0.0f), minus);
            const vector_f w = sqrt_each_f(1.0f + u);
            kept[k][b].u = u;
            kept[k][b].w = w;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f u = kept[k][b].u;
            const vector_f w = kept[k][b].w;
            const vector_mask_f its_near = w < 1.25f;
            const vector_f near_chosen = vector_select_f(its_near, vector_of_f(1.0f), u);
            const vector_f sqrt_2 = sqrt_each_f(near_chosen);
            kept[k][b].near_chosen = near_chosen;
            kept[k][b].sqrt_2 = sqrt_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f w = kept[k][b].w;
            const vector_f sqrt_2 = kept[k][b].sqrt_2;
            const vector_f half_angle = log_each_f(w + sqrt_2);
            kept[k][b].half_angle = half_angle;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f near_chosen = kept[k][b].near_chosen;
            const vector_f sqrt_2 = kept[k][b].sqrt_2;
            const vector_f half_angle = kept[k][b].half_angle;
            const vector_f half_angle_product = sqrt_2 * half_angle;
            const vector_f ratio = 1.0f / (near_chosen * half_angle_product);
            kept[k][b].half_angle_product = half_angle_product;
            kept[k][b].ratio = ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f u = kept[k][b].u;
            const vector_f w = kept[k][b].w;
            const vector_f near_chosen = kept[k][b].near_chosen;
            const vector_f half_angle_product = kept[k][b].half_angle_product;
            const vector_f ratio = kept[k][b].ratio;
            const vector_mask_f its_near = w < 1.25f;
            const vector_f eta = vector_polynomial_eta_f(4.0f * vector_select_f(its_near, w - 1.0f,
                vector_of_f(0.0f)));
            const vector_f near_chosen_2 = vector_select_f(its_near, eta, near_chosen * ratio - w *
                (half_angle_product * ratio));
            const vector_f w_total = w + u * near_chosen_2;
            const vector_f a = 1.0f / (w * w_total);
            kept[k][b].near_chosen_2 = near_chosen_2;
            kept[k][b].w_total = w_total;
            kept[k][b].a = a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float R0_0 = S[4];
        const float R0_1 = S[5];
        const float R0_2 = S[6];
        const float R1_0 = S[7];
        const float R1_1 = S[8];
        const float R1_2 = S[9];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 3 * b;
            const vector_f a = kept[k][b].a;
            const vector_f h0 = X[0];
            const vector_f h1 = X[1];
            const vector_f h2 = X[2];
            const vector_f a_squared = a * a;
            const vector_f r0 = h0 * R0_0 + h1 * R0_1 + h2 * R0_2;
            const vector_f r1 = h0 * R1_0 + h1 * R1_1 + h2 * R1_2;
            const vector_f square = a_squared * (r0 * r0 + r1 * r1);
            const vector_f gaussian = gaussian_each_f(square);
            kept[k][b].a_squared = a_squared;
            kept[k][b].r0 = r0;
            kept[k][b].r1 = r1;
            kept[k][b].square = square;
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float amplitude = S[0];
        const float M0 = S[1];
        const float M1 = S[2];
        const float M2 = S[3];
        const float R0_0 = S[4];
        const float R0_1 = S[5];
        const float R0_2 = S[6];
        const float R1_0 = S[7];
        const float R1_1 = S[8];
        const float R1_2 = S[9];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            vector_f *slope = slopes + 3 * b;
            const vector_f near_chosen_2 = kept[k][b].near_chosen_2;
            const vector_f w_total = kept[k][b].w_total;
            const vector_f a = kept[k][b].a;
            const vector_f a_squared = kept[k][b].a_squared;
            const vector_f r0 = kept[k][b].r0;
            const vector_f r1 = kept[k][b].r1;
            const vector_f square = kept[k][b].square;
            const vector_f gaussian = kept[k][b].gaussian;
            const vector_f phi = a * gaussian;
            const vector_f phi_2 = amplitude * phi;
            const vector_f phi_product = phi_2 * a_squared;
            const vector_f r1_product = r1 * phi_product;
            const vector_f r0_product = r0 * phi_product;
            const vector_f over_w = w_total * a;
            const vector_f over_w_product = over_w * ((near_chosen_2 - over_w) * (phi_2 - phi_2 * square));
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] - R1_0 * r1_product - R0_0 * r0_product + M0 * over_w_product;
            slope[1] = slope[1] - R1_1 * r1_product - R0_1 * r0_product - M1 * over_w_product;
            slope[2] = slope[2] - R1_2 * r1_product - R0_2 * r0_product - M2 * over_w_product;
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient_f(
    const vector_f *x, const vector_f *slope, vector_f *gradient) {
    const vector_f x0 = x[0];
    const vector_f x1 = x[1];
    const vector_f x2 = x[2];
    const vector_f slope_h0 = slope[0];
    const vector_f slope_h1 = slope[1];
    const vector_f slope_h2 = slope[2];
    const vector_f product = 0.5f * slope_h0;
    const vector_f product_2 = 0.5f * slope_h1;
    const vector_f product_3 = 0.5f * slope_h2;
    const vector_f normal_part = x0 * product + x1 * product_2 + x2 * product_3;
    gradient[0] = x0 * normal_part - product;
    gradient[1] = product_2 + x1 * normal_part;
    gradient[2] = product_3 + x2 * normal_part;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp_f(
    const vector_f *x, const vector_f *gradient_bar, vector_f *slope_bar) {
    const vector_f x0 = x[0];
    const vector_f x1 = x[1];
    const vector_f x2 = x[2];
    const vector_f gradient_bar0 = gradient_bar[0];
    const vector_f gradient_bar1 = gradient_bar[1];
    const vector_f gradient_bar2 = gradient_bar[2];
    const vector_f by_normal_part = x2 * gradient_bar2 + x1 * gradient_bar1 + x0 * gradient_bar0;
    slope_bar[0] = 0.5f * (x0 * by_normal_part - gradient_bar0);
    slope_bar[1] = 0.5f * (gradient_bar1 + x1 * by_normal_part);
    slope_bar[2] = 0.5f * (gradient_bar2 + x2 * by_normal_part);
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
    struct { vector_f u, w, product, near_chosen, sqrt_2, half_angle, half_angle_product, ratio, product_2,
            product_3, w_product, near_chosen_2, w_total, a, a_squared, r0, r1, square, gaussian; } kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 7 * (size_t)near[i];
        const vector_f h0 = X[0];
        const vector_f h1 = X[1];
        const vector_f h2 = X[2];
        const float M0 = S[1];
        const float M1 = S[2];
        const float M2 = S[3];
        const vector_f gap = h0 - M0;
        const vector_f minus = -(gap * gap + (h1 - M1) * (M1 - h1) + (h2 - M2) * (M2 - h2));
        const vector_f u = vector_select_f(minus < 0.0f, vector_of_f(0.0f), minus);
        const vector_f w = sqrt_each_f(1.0f + u);
        kept[i].u = u;
        kept[i].w = w;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f u = kept[i].u;
        const vector_f w = kept[i].w;
        const vector_mask_f its_near = w < 1.25f;
        const vector_f near_chosen = vector_select_f(its_near, vector_of_f(1.0f), u);
        const vector_f sqrt_2 = sqrt_each_f(near_chosen);
        kept[i].near_chosen = near_chosen;
        kept[i].sqrt_2 = sqrt_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f w = kept[i].w;
        const vector_f sqrt_2 = kept[i].sqrt_2;
        const vector_f half_angle = log_each_f(w + sqrt_2);
        kept[i].half_angle = half_angle;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f near_chosen = kept[i].near_chosen;
        const vector_f sqrt_2 = kept[i].sqrt_2;
        const vector_f half_angle = kept[i].half_angle;
        const vector_f half_angle_product = sqrt_2 * half_angle;
        const vector_f ratio = 1.0f / (near_chosen * half_angle_product);
        kept[i].half_angle_product = half_angle_product;
        kept[i].ratio = ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f u = kept[i].u;
        const vector_f w = kept[i].w;
        const vector_f near_chosen = kept[i].near_chosen;
        const vector_f half_angle_product = kept[i].half_angle_product;
        const vector_f ratio = kept[i].ratio;
        const vector_mask_f its_near = w < 1.25f;
        const vector_f product = 4.0f * vector_select_f(its_near, w - 1.0f, vector_of_f(0.0f));
        const vector_f eta = vector_polynomial_eta_f(product);
        const vector_f product_2 = near_chosen * ratio;
        const vector_f product_3 = half_angle_product * ratio;
        const vector_f w_product = w * product_3;
        const vector_f near_chosen_2 = vector_select_f(its_near, eta, product_2 - w_product);
        const vector_f w_total = w + u * near_chosen_2;
        const vector_f a = 1.0f / (w * w_total);
        kept[i].product = product;
        kept[i].product_2 = product_2;
        kept[i].product_3 = product_3;
        kept[i].w_product = w_product;
        kept[i].near_chosen_2 = near_chosen_2;
        kept[i].w_total = w_total;
        kept[i].a = a;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 7 * (size_t)near[i];
        const vector_f a = kept[i].a;
        const vector_f h0 = X[0];
        const vector_f h1 = X[1];
        const vector_f h2 = X[2];
        const float R0_0 = S[4];
        const float R0_1 = S[5];
        const float R0_2 = S[6];
        const float R1_0 = S[7];
        const float R1_1 = S[8];
        const float R1_2 = S[9];
        const vector_f a_squared = a * a;
        const vector_f r0 = h0 * R0_0 + h1 * R0_1 + h2 * R0_2;
        const vector_f r1 = h0 * R1_0 + h1 * R1_1 + h2 * R1_2;
        const vector_f square = a_squared * (r0 * r0 + r1 * r1);
        const vector_f gaussian = gaussian_each_f(square);
        kept[i].a_squared = a_squared;
        kept[i].r0 = r0;
        kept[i].r1 = r1;
        kept[i].square = square;
        kept[i].gaussian = gaussian;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 7 * (size_t)near[i];
        const vector_f *value_bar = points + 7 * (size_t)near[i] + 3;
        const vector_f *slope_bar = points + 7 * (size_t)near[i] + 3 + 1;
        const vector_f w = kept[i].w;
        const vector_f product = kept[i].product;
        const vector_f near_chosen = kept[i].near_chosen;
        const vector_f product_2 = kept[i].product_2;
        const vector_f product_3 = kept[i].product_3;
        const vector_f w_product = kept[i].w_product;
        const vector_f near_chosen_2 = kept[i].near_chosen_2;
        const vector_f w_total = kept[i].w_total;
        const vector_f a = kept[i].a;
        const vector_f a_squared = kept[i].a_squared;
        const vector_f r0 = kept[i].r0;
        const vector_f r1 = kept[i].r1;
        const vector_f square = kept[i].square;
        const vector_f gaussian = kept[i].gaussian;
        const vector_f h0 = X[0];
        const vector_f h1 = X[1];
        const vector_f h2 = X[2];
        const float M0 = S[1];
        const float M1 = S[2];
        const float M2 = S[3];
        const float R0_0 = S[4];
        const float R0_1 = S[5];
        const float R0_2 = S[6];
        const float R1_0 = S[7];
        const float R1_1 = S[8];
        const float R1_2 = S[9];
        const vector_f its_value_bar = value_bar[0];
        const vector_f h0_bar = slope_bar[0];
        const vector_f h1_bar = slope_bar[1];
        const vector_f h2_bar = slope_bar[2];
        const vector_mask_f its_near = w < 1.25f;
        const vector_f phi = a * gaussian;
        const vector_f over_w = w_total * a;
        const vector_f over_w_gap = near_chosen_2 - over_w;
        const vector_f gap_2 = M0 * h0_bar - M1 * h1_bar - M2 * h2_bar;
        const vector_f over_w_product = over_w * gap_2;
        const vector_f product_4 = over_w_gap * over_w_product;
        const vector_f gap_3 = -(R1_0 * h0_bar) - R1_1 * h1_bar - R1_2 * h2_bar;
        const vector_f gap_4 = -(R0_0 * h0_bar) - R0_1 * h1_bar - R0_2 * h2_bar;
        const vector_f total_2 = r1 * gap_3 + r0 * gap_4;
        const vector_f by_phi = its_value_bar + product_4 + a_squared * total_2 - square * product_4;
        const vector_f phi_product = phi * by_phi;
        const vector_f phi_gap = phi - phi * square;
        const vector_f product_5 = over_w_gap * phi_gap;
        const vector_f over_w_product_2 = over_w * product_5;
        const vector_f eta_slope = vector_polynomial_eta_slope_f(product);
        const vector_f product_6 = phi_gap * over_w_product;
        const vector_f product_7 = vector_select_f(its_near, eta_slope, (2.0f + near_chosen) * (product_3 *
            product_3) - product_2 * (product_2 + w_product)) * product_6;
        const vector_f gap_5 = -2.0f * (phi * product_4) - phi_product;
        const vector_f product_8 = over_w_gap * (2.0f * a_squared * (phi * total_2) + phi_product + square *
            gap_5);
        const vector_f total_3 = product_7 - over_w * over_w * (product_5 * gap_2 - product_6) + product_8;
        const vector_f over_w_product_3 = over_w * total_3;
        const vector_f phi_product_2 = phi * a_squared;
        const vector_f a_squared_product = a_squared * gap_5;
        const vector_f by_r0 = phi_product_2 * gap_4 + r0 * a_squared_product;
        const vector_f r0_product = r0 * phi_product_2;
        const vector_f by_r1 = phi_product_2 * gap_3 + r1 * a_squared_product;
        const vector_f r1_product = r1 * phi_product_2;
        sums[0] = sums[0] + phi_product;
        sums[1] = sums[1] + over_w_product_2 * h0_bar + h0 * over_w_product_3;
        sums[2] = sums[2] - over_w_product_2 * h1_bar - h1 * over_w_product_3;
        sums[3] = sums[3] - over_w_product_2 * h2_bar - h2 * over_w_product_3;
        sums[4] = sums[4] + h0 * by_r0 - r0_product * h0_bar;
        sums[5] = sums[5] + h1 * by_r0 - r0_product * h1_bar;
        sums[6] = sums[6] + h2 * by_r0 - r0_product * h2_bar;
        sums[7] = sums[7] + h0 * by_r1 - r1_product * h0_bar;
        sums[8] = sums[8] + h1 * by_r1 - r1_product * h1_bar;
        sums[9] = sums[9] + h2 * by_r1 - r1_product * h2_bar;
    }
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, const vector_f *sums, vector_f *mu_bar, vector_f *W_bar, vector_f *amplitude_bar) {
    const vector_f mu0 = mu[0];
    const vector_f mu1 = mu[1];
    const vector_f mu2 = mu[2];
    const vector_f W0_0 = W[0];
    const vector_f W0_1 = W[1];
    const vector_f W0_2 = W[2];
    const vector_f W1_0 = W[3];
    const vector_f W1_1 = W[4];
    const vector_f W1_2 = W[5];
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
    const vector_f by_normal_part = mu2 * W0_2 + mu1 * W0_1 + mu0 * W0_0;
    const vector_f total_2 = sum4 + sum4;
    const vector_f total_3 = sum5 + sum5;
    const vector_f total_4 = sum6 + sum6;
    const vector_f by_by_normal_part = mu1 * total_3 - mu0 * total_2 + mu2 * total_4;
    const vector_f by_normal_part_2 = mu2 * W1_2 + mu1 * W1_1 + mu0 * W1_0;
    const vector_f total_5 = sum7 + sum7;
    const vector_f total_6 = sum8 + sum8;
    const vector_f total_7 = sum9 + sum9;
    const vector_f by_by_normal_part_2 = mu1 * total_6 - mu0 * total_5 + mu2 * total_7;
    const vector_f total_8 = 0.5f * sum1 - by_normal_part * total_2 + W0_0 * by_by_normal_part -
        by_normal_part_2 * total_5 + W1_0 * by_by_normal_part_2;
    const vector_f total_9 = 0.5f * sum2 + by_normal_part * total_3 + W0_1 * by_by_normal_part +
        by_normal_part_2 * total_6 + W1_1 * by_by_normal_part_2;
    const vector_f total_10 = 0.5f * sum3 + by_normal_part * total_4 + W0_2 * by_by_normal_part +
        by_normal_part_2 * total_7 + W1_2 * by_by_normal_part_2;
    mu_bar[0] = its_amplitude * total_8;
    mu_bar[1] = its_amplitude * total_9;
    mu_bar[2] = its_amplitude * total_10;
    W_bar[0] = its_amplitude * (total_2 + mu0 * by_by_normal_part);
    W_bar[1] = its_amplitude * (total_3 + mu1 * by_by_normal_part);
    W_bar[2] = its_amplitude * (total_4 + mu2 * by_by_normal_part);
    W_bar[3] = its_amplitude * (total_5 + mu0 * by_by_normal_part_2);
    W_bar[4] = its_amplitude * (total_6 + mu1 * by_by_normal_part_2);
    W_bar[5] = its_amplitude * (total_7 + mu2 * by_by_normal_part_2);
    amplitude_bar[0] = sum0;
}

/* The distances of some points q from one point p. */
OUTLINE void pair_distances_f(
    const float *p, const vector_f *q, vector_f *distance) {
    const float p1 = p[1];
    const float p2 = p[2];
    const vector_f q1 = q[1];
    const vector_f q2 = q[2];
    const vector_f S0 = p1 + q1;
    const vector_f S1 = p2 + q2;
    const vector_f dot_S_S = S0 * S0 + S1 * S1;
    const vector_f D0 = q1 - p1;
    const vector_f D1 = q2 - p2;
    const vector_f dot_D_D = D0 * D0 + D1 * D1;
    const vector_f dot_D_S = S0 * D0 + S1 * D1;
    const float dot_ps_ps = p1 * p1 + p2 * p2;
    const vector_f a = sqrt_each_f(vector_of_f(1.0f + dot_ps_ps));
    const vector_f dot_qs_qs = q1 * q1 + q2 * q2;
    const vector_f its_b = sqrt_each_f(1.0f + dot_qs_qs);
    const vector_f a_total = a + its_b;
    const vector_f e = dot_D_S / a_total;
    const vector_mask_f is_small = dot_S_S < 1.0f;
    const vector_f dot_D_S_ratio = dot_D_S / vector_select_f(is_small, vector_of_f(1.0f), dot_S_S);
    const vector_f dot_ps_qs = p1 * q1 + p2 * q2;
    const vector_f c = (2.0f + its_b * (2.0f * a) - 2.0f * dot_ps_qs) / (a_total * a_total);
    const vector_f rest0 = D0 - S0 * dot_D_S_ratio;
    const vector_f rest1 = D1 - S1 * dot_D_S_ratio;
    const vector_f dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const vector_f ww = vector_select_f(is_small, dot_D_D - e * e, dot_rest_rest + dot_D_S_ratio * (dot_D_S *
        c));
    const vector_f sqrt_ww = sqrt_each_f(ww);
    const vector_f asinh_sqrt_ww_over_2 = asinh_each_f(0.5f * sqrt_ww);
    const vector_f r = 2.0f * asinh_sqrt_ww_over_2;
    distance[0] = r;
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

/* Scratch memory: 7 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t hyperbolic_splats_work_f(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES_f - 1) / LANES_f, blocks = (points + 2 - 1) / 2;
    const size_t places = 4 * ((splat_count + LANES_f - 1) / LANES_f + (blocks + LANES_f - 1) / LANES_f);
    return (points * 7 + places + 1) * LANES_f + 10 * splat_count;
}

static vector_f *work_points_f(float *work) {
    const uintptr_t size = sizeof(vector_f), start = (uintptr_t)work;
    return (vector_f *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const float *splat_at_f(const vector_f *splats, size_t k) {
    const size_t row = k / LANES_f;
    return (const float *)(splats + 4 * row) + (k - row * LANES_f);
}

static vector_f *work_reaches_f(float *work, size_t count) {
    return work_points_f(work) + (count + LANES_f - 1) / LANES_f * 7;
}

static vector_f *work_blocks_f(float *work, size_t count, size_t splat_count) {
    return work_reaches_f(work, count) + 4 * ((splat_count + LANES_f - 1) / LANES_f);
}

static float *work_constants_f(float *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES_f, blocks = (count + size - 1) / size;
    return (float *)(work_blocks_f(work, count, splat_count) + 4 * ((blocks + LANES_f - 1) / LANES_f));
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
    vector_f *own = splats + start / LANES_f * (3 + 1);
    vector_rows_f(width, splat_count, start, 1, own + 3);
    own[3] = own[3] * 6.3739659084374996f + vector_spoilt_f(mu, 3) + vector_spoilt_f(amplitude, 1);
    for (int i = 0; i < 3; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place_f(const float *x, size_t count, size_t start, float *place) {
    const size_t size = count - start < 2 * LANES_f ? count - start : 2 * LANES_f;
    vector_f at[2][3], spoilt = ZERO;
    for (size_t b = 0; b < 2; ++b) {
        vector_rows_f(x, count, start + b * LANES_f, 3, at[b]);
        spoilt += vector_spoilt_f(at[b], 3);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const float *middle = x + 3 * (start + i * size / 8);
        float radius = 0, column[LANES_f];
        for (size_t b = 0; b < 2; ++b) {
            vector_f distance[1];
            pair_distances_f(middle, at[b], distance);
            vector_store_f(column, distance[0]);
            for (size_t lane = 0; lane < LANES_f; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[3]) {
            for (int j = 0; j < 3; ++j) place[j] = middle[j];
            place[3] = radius;
        }
    }
    place[3] = place[3] * 1.0078125f + vector_sum_f(spoilt);
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
        const vector_f *own = splats + start / LANES_f * (3 + 1);
        vector_f distance[1];
        pair_distances_f(place, own, distance);
        const vector_mask_f far = vector_far_f(distance[0], own[3], vector_of_f(place[3]));
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
        const vector_f *own = blocks + start / group * (3 + 1);
        vector_f distance[1];
        pair_distances_f(mu, own, distance);
        const vector_mask_f far = vector_far_f(distance[0], vector_of_f(*reach), own[3]);
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
    vector_f own_mu[3], own_W[6], own_amplitude[1], S[10];
    vector_rows_f(mu, splat_count, start, 3, own_mu);
    vector_rows_f(W, splat_count, start, 6, own_W);
    vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants_f(own_mu, own_W, own_amplitude, S);
    vector_to_rows_f(S, constants, splat_count, start, 10, 10);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void hyperbolic_splats_f(
    size_t count, size_t splat_count, const float *HYPERBOLIC_RESTRICT x, const float *HYPERBOLIC_RESTRICT mu, const float *HYPERBOLIC_RESTRICT W, const float *HYPERBOLIC_RESTRICT amplitude, const float *HYPERBOLIC_RESTRICT width,
    float *HYPERBOLIC_RESTRICT value, float *HYPERBOLIC_RESTRICT gradient, float *HYPERBOLIC_RESTRICT work, int threads) {
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
            vector_f at[2][3], X[2 * 3], grad[3];
            vector_f value_sum[2] = {ZERO}, slope_sum[2 * 3] = {ZERO};
            float place[3 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 3, at[b]);
                pair_features_f(at[b], X + 3 * b);
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
                pair_gradient_f(at[b], slope_sum + 3 * b, grad);
                vector_to_rows_f(value_sum + b, value, count, start + b * LANES_f, 1, 1);
                vector_to_rows_f(grad, gradient, count, start + b * LANES_f, 3, 3);
            }
        }
        restore_denormals(mode);
    }
}

void hyperbolic_splats_value_f(
    size_t count, size_t splat_count, const float *HYPERBOLIC_RESTRICT x, const float *HYPERBOLIC_RESTRICT mu, const float *HYPERBOLIC_RESTRICT W, const float *HYPERBOLIC_RESTRICT amplitude, const float *HYPERBOLIC_RESTRICT width,
    float *HYPERBOLIC_RESTRICT value, float *HYPERBOLIC_RESTRICT work, int threads) {
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
            vector_f at[3], X[2 * 3], value_sum[2] = {ZERO};
            float place[3 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 3, at);
                pair_features_f(at, X + 3 * b);
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
    vector_f at[3], grad_bar[3], slope_bar[3];
    vector_rows_f(x, count, start, 3, at);
    vector_rows_f(gradient_bar, count, start, 3, grad_bar);
    vector_rows_f(value_bar, count, start, 1, point + 3);
    pair_features_f(at, point);
    pair_gradient_vjp_f(at, grad_bar, slope_bar);
    for (int i = 0; i < 3; ++i) point[3 + 1 + i] = slope_bar[i];
    vector_end_f(count, start, 3 + 1, point + 3);
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums_f(const vector_f *points, const uint32_t *near, size_t size, const float *S, float *sums) {
    vector_f sum[10] = {ZERO};
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
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void hyperbolic_splats_vjp_f(
    size_t count, size_t splat_count, const float *HYPERBOLIC_RESTRICT x, const float *HYPERBOLIC_RESTRICT mu, const float *HYPERBOLIC_RESTRICT W, const float *HYPERBOLIC_RESTRICT amplitude, const float *HYPERBOLIC_RESTRICT width, const float *HYPERBOLIC_RESTRICT value_bar, const float *HYPERBOLIC_RESTRICT gradient_bar,
    float *HYPERBOLIC_RESTRICT mu_bar, float *HYPERBOLIC_RESTRICT W_bar, float *HYPERBOLIC_RESTRICT amplitude_bar, float *HYPERBOLIC_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES_f - 1) / LANES_f;
    const size_t chunk = 131072 / (7 * sizeof(vector_f)) + 1;
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
                float place[3 + 1];
                const size_t last = (blocks - 1) / 2, start = (block < last ? block : last) * 2;
                block_place_f(x, count, start * LANES_f, place);
                for (int i = 0; i < 4; ++i) {
                    float *row = (float *)(places + block / LANES_f * 4 + i);
                    row[block - block / LANES_f * LANES_f] = place[i];
                }
            }
        }
        OMP(omp for schedule(dynamic, 8))
        for (size_t block = 0; block < blocks; ++block)
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, points + 7 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            float sums[LANES_f][10] = {{0}};
            uint32_t near[131072 / (7 * sizeof(vector_f)) + 2];
            vector_f own_mu[3], own_W[6], own_amplitude[1], own_sums[10], bars[10];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const float *reach = width ? splat_at_f(splats, k) + 3 * LANES_f : NULL;
                    const size_t some = blocks_near_f(mu + 3 * k, reach, places, first, first + size, near);
                    splat_sums_f(points + 7 * first, near, some, constants + 10 * k, sums[k - start]);
                }
            }
            vector_rows_f(mu, end, start, 3, own_mu);
            vector_rows_f(W, end, start, 6, own_W);
            vector_rows_f(amplitude, end, start, 1, own_amplitude);
            vector_rows_f(sums[0], LANES_f, 0, 10, own_sums);
            pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 3, bars + 3 + 6);
            vector_to_rows_f(bars, mu_bar, end, start, 3, 3);
            vector_to_rows_f(bars + 3, W_bar, end, start, 6, 6);
            vector_to_rows_f(bars + 3 + 6, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void hyperbolic_splats_rows_f(
    size_t count, size_t splat_count, const float *HYPERBOLIC_RESTRICT x, const float *HYPERBOLIC_RESTRICT mu, const float *HYPERBOLIC_RESTRICT W, const float *HYPERBOLIC_RESTRICT amplitude, const float *HYPERBOLIC_RESTRICT value_bar, const float *HYPERBOLIC_RESTRICT gradient_bar,
    float *HYPERBOLIC_RESTRICT rows, float *HYPERBOLIC_RESTRICT work, int threads) {
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
            vector_f point[7];
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector_f own_mu[3], own_W[6], own_amplitude[1], own_sums[10] = {ZERO}, bars[10];
                for (int i = 0; i < 3; ++i) own_mu[i] = vector_of_f(mu[3 * k + i]);
                for (int i = 0; i < 6; ++i) own_W[i] = vector_of_f(W[6 * k + i]);
                own_amplitude[0] = vector_of_f(amplitude[k]);
                pair_backward_f(1, point, &only, constants + 10 * k, own_sums);
                pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 3, bars + 3 + 6);
                vector_to_rows_f(bars, rows + 10 * k, count, block * LANES_f, 10, 10 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

/* A coordinate to sort by. */
INLINE float order_key_f(const float *x, size_t row, size_t axis) {
    const float key = x[3 * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest_f(const float *x, const size_t *order, size_t count) {
    float low[3], high[3];
    size_t widest = 0;
    for (size_t axis = 0; axis < 3; ++axis) low[axis] = high[axis] = order_key_f(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < 3; ++axis) {
            const float key = order_key_f(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < 3; ++axis)
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

double hyperbolic_splats_order_f(
    size_t count, size_t splat_count, const float *HYPERBOLIC_RESTRICT x, const float *HYPERBOLIC_RESTRICT mu, const float *HYPERBOLIC_RESTRICT amplitude, const float *HYPERBOLIC_RESTRICT width,
    double limit, size_t *HYPERBOLIC_RESTRICT order, float *HYPERBOLIC_RESTRICT work) {
    const size_t block = 2 * LANES_f;
    vector_f *splats = work_reaches_f(work, 0);
    uint32_t near[256];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES_f) {
        vector_f own_mu[3], own_amplitude[1];
        vector_rows_f(mu, splat_count, start, 3, own_mu);
        vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks_f(x, order, count, (float *)work_blocks_f(work, 0, splat_count));
        for (size_t i = 1; i < 2 * 16; i += 2) {
            float rows[2 * LANES_f * 3], place[3 + 1];
            const size_t some = i * count / (2 * 16), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < 3; ++j) rows[3 * n + j] = x[3 * order[start + n] + j];
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
