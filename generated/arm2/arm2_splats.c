/*
 * arm2: A two-link arm under its kinetic energy: |v|^2 / 2 is the energy of the joint velocities v. Exp and Log
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "arm2.h"

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

/* round to even, of numbers below 2^51; of larger ones, a whole number close by. */
INLINE vector round_each(vector x) { return (x + 6755399441055744.0) - 6755399441055744.0; }

/* exp = 2^k exp(r), |r| <= log(2) / 2, within 1 unit in the last place; below 3e-308 it is 0. */
INLINE vector exp_each(vector x) {
    const vector shifted = x * 1.4426950408889634 + 6755399441055744.0, k = shifted - 6755399441055744.0;
    const vector r = (x - k * 0.6931471805601177) - k * -1.7239444525614835e-13;
    const vector part = r + r * r * (0.5000000000000001 + r * (0.16666666666666669 + r * (0.041666666666624136 + r * (0.008333333333330063 + r * (0.001388888891720967 + r * (0.00019841269863050506 + r * (2.4801521302241082e-05 + r * (2.7557268464831627e-06 + r * (2.7620085455018414e-07 + r * 2.510038319586702e-08)))))))));
    const vector scale = vector_from_bits((vector_to_bits(shifted) + 1022) << 52); /* 2^(k - 1) */
    const vector y = vector_select(x > 709.782712893384, vector_of(HUGE_VAL), (scale + scale * part) * 2);
    return vector_select(x < -707.9, vector_of(0), y);
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

/* atanh, within 3 units in the last place. */
INLINE vector atanh_each(vector x) {
    const vector a = abs_each(x);
    return signed_each(0.5 * log1p_each(2 * a / (1 - a)), x);
}

/* sin: x = k pi/2 + r, |r| <= pi/4, within 2 units in the last place; beyond 1e5, by the library. */
INLINE vector sin_each(vector x) {
    const vector shifted = x * 0.6366197723675814 + 6755399441055744.0, k = shifted - 6755399441055744.0;
    const vector r = ((x - k * 1.5707963267923333) - k * 2.5633441515839558e-12) - k * 1.0562999066987428e-23, z = r * r;
    const vector_bits quarter = vector_to_bits(shifted);
    const vector sine = r + r * z * (-0.16666666666666666 + z * (0.008333333333333331 + z * (-0.00019841269841265063 + z * (2.7557319219337672e-06 + z * (-2.5052106231927857e-08 + z * (1.6058531536611833e-10 + z * -7.586692262094344e-13))))));
    const vector cosine = 1 - (0.5 * z - z * z * (0.041666666666666664 + z * (-0.0013888888888888887 + z * (2.4801587301584645e-05 + z * (-2.7557319221401993e-07 + z * (2.087675579079147e-09 + z * (-1.1470460841811526e-11 + z * 4.7458692024108734e-14)))))));
    const vector part = vector_select((quarter & 1) == 0, sine, cosine);
    vector y = vector_from_bits(vector_to_bits(part) ^ ((quarter & 2) << 62));
    int far = 0;
    for (size_t i = 0; i < LANES; ++i) far |= fabs(LANE(x, i)) > 1e5;
    if (far)
        for (size_t i = 0; i < LANES; ++i) LANE(y, i) = sin(LANE(x, i));
    return y;
}

/* cos: x = k pi/2 + r, |r| <= pi/4, within 2 units in the last place; beyond 1e5, by the library. */
INLINE vector cos_each(vector x) {
    const vector shifted = x * 0.6366197723675814 + 6755399441055744.0, k = shifted - 6755399441055744.0;
    const vector r = ((x - k * 1.5707963267923333) - k * 2.5633441515839558e-12) - k * 1.0562999066987428e-23, z = r * r;
    const vector_bits quarter = vector_to_bits(shifted) + 1;
    const vector sine = r + r * z * (-0.16666666666666666 + z * (0.008333333333333331 + z * (-0.00019841269841265063 + z * (2.7557319219337672e-06 + z * (-2.5052106231927857e-08 + z * (1.6058531536611833e-10 + z * -7.586692262094344e-13))))));
    const vector cosine = 1 - (0.5 * z - z * z * (0.041666666666666664 + z * (-0.0013888888888888887 + z * (2.4801587301584645e-05 + z * (-2.7557319221401993e-07 + z * (2.087675579079147e-09 + z * (-1.1470460841811526e-11 + z * 4.7458692024108734e-14)))))));
    const vector part = vector_select((quarter & 1) == 0, sine, cosine);
    vector y = vector_from_bits(vector_to_bits(part) ^ ((quarter & 2) << 62));
    int far = 0;
    for (size_t i = 0; i < LANES; ++i) far |= fabs(LANE(x, i)) > 1e5;
    if (far)
        for (size_t i = 0; i < LANES; ++i) LANE(y, i) = cos(LANE(x, i));
    return y;
}

/* What pairs read of points x. */
OUTLINE void pair_features(
    const vector *x, vector *X) {
    const vector x0 = x[0];
    const vector x1 = x[1];
    const vector cos_q1 = cos_each(x1);
    X[0] = x0;
    X[1] = x1;
    X[2] = 0.25 * (cos_q1 * cos_q1);
}

/* What pairs read of a splat, of some splats. */
OUTLINE void pair_constants(
    const vector *mu, const vector *W, const vector *amplitude, vector *S) {
    const vector mu0 = mu[0];
    const vector mu1 = mu[1];
    const vector W0_0 = W[0];
    const vector W0_1 = W[1];
    const vector W1_0 = W[2];
    const vector W1_1 = W[3];
    const vector its_amplitude = amplitude[0];
    const vector cos_p1 = cos_each(mu1);
    const vector M0_0 = W0_0 * W0_0 + W1_0 * W1_0;
    const vector M0_1 = W0_0 * W0_1 + W1_0 * W1_1;
    const vector M1_1 = W0_1 * W0_1 + W1_1 * W1_1;
    S[0] = mu0;
    S[1] = mu1;
    S[2] = W0_0;
    S[3] = W0_1;
    S[4] = W1_0;
    S[5] = W1_1;
    S[6] = its_amplitude;
    S[7] = 0.8888888888888888 - 0.25 * (cos_p1 * cos_p1);
    S[8] = M0_0;
    S[9] = M0_1;
    S[10] = M1_1;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_value(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values) {
    struct { vector sin_p1_plus_q1, sin_p1_minus_q1, atanh_value, phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 11 * near[k];
        const double mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 3 * b;
            const vector x1 = X[1];
            const vector sin_p1_plus_q1 = sin_each(x1 + mu1);
            const vector sin_p1_minus_q1 = sin_each(mu1 - x1);
            kept[k][b].sin_p1_plus_q1 = sin_p1_plus_q1;
            kept[k][b].sin_p1_minus_q1 = sin_p1_minus_q1;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 11 * near[k];
        const double sub_of_one = S[7];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 3 * b;
            const vector sin_p1_plus_q1 = kept[k][b].sin_p1_plus_q1;
            const vector sin_p1_minus_q1 = kept[k][b].sin_p1_minus_q1;
            const vector mul_of_one = X[2];
            const vector difference = sin_p1_plus_q1 * (0.25 * sin_p1_minus_q1);
            const vector total_2 = sub_of_one - mul_of_one;
            const vector atanh_value = atanh_each(difference / total_2);
            kept[k][b].atanh_value = atanh_value;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 11 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double W0_0 = S[2];
        const double W0_1 = S[3];
        const double W1_0 = S[4];
        const double W1_1 = S[5];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 3 * b;
            const vector atanh_value = kept[k][b].atanh_value;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector gap = x0 - mu0;
            const vector round_2 = round_each(0.15915494309189535 * gap);
            const vector v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
            const vector gap_2 = x1 - mu1;
            const vector round_3 = round_each(0.15915494309189535 * gap_2);
            const vector v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
            const vector z0 = W0_0 * v0 + W0_1 * v1;
            const vector z1 = W1_0 * v0 + W1_1 * v1;
            const vector phi = exp_each(atanh_value - 0.5 * (z0 * z0 + z1 * z1));
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 11 * near[k];
        const double amplitude = S[6];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            const vector phi = kept[k][b].phi;
            value[0] = value[0] + amplitude * phi;
        }
    }
}

/*
 * Adds the values phi of some splats at 2 vectors of points, and slope = d phi / d X.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_forward(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values, vector *slopes) {
    struct { vector total_2, sin_p1_plus_q1, gap, sin_p1_minus_q1, product, total_3, difference_ratio,
            atanh_value, z0, z1, phi, phi_2, by_difference; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 11 * near[k];
        const double mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 3 * b;
            const vector x1 = X[1];
            const vector total_2 = x1 + mu1;
            const vector sin_p1_plus_q1 = sin_each(total_2);
            const vector gap = mu1 - x1;
            const vector sin_p1_minus_q1 = sin_each(gap);
            kept[k][b].total_2 = total_2;
            kept[k][b].sin_p1_plus_q1 = sin_p1_plus_q1;
            kept[k][b].gap = gap;
            kept[k][b].sin_p1_minus_q1 = sin_p1_minus_q1;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 11 * near[k];
        const double sub_of_one = S[7];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 3 * b;
            const vector sin_p1_plus_q1 = kept[k][b].sin_p1_plus_q1;
            const vector sin_p1_minus_q1 = kept[k][b].sin_p1_minus_q1;
            const vector mul_of_one = X[2];
            const vector product = 0.25 * sin_p1_minus_q1;
            const vector difference = sin_p1_plus_q1 * product;
            const vector total_3 = sub_of_one - mul_of_one;
            const vector difference_ratio = difference / total_3;
            kept[k][b].product = product;
            kept[k][b].total_3 = total_3;
            kept[k][b].difference_ratio = difference_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector difference_ratio = kept[k][b].difference_ratio;
            const vector atanh_value = atanh_each(difference_ratio);
            kept[k][b].atanh_value = atanh_value;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 11 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double W0_0 = S[2];
        const double W0_1 = S[3];
        const double W1_0 = S[4];
        const double W1_1 = S[5];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 3 * b;
            const vector atanh_value = kept[k][b].atanh_value;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector gap_2 = x0 - mu0;
            const vector round_2 = round_each(0.15915494309189535 * gap_2);
            const vector v0 = gap_2 - 6.28125 * round_2 - 0.001935307179586477 * round_2;
            const vector gap_3 = x1 - mu1;
            const vector round_3 = round_each(0.15915494309189535 * gap_3);
            const vector v1 = gap_3 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
            const vector z0 = W0_0 * v0 + W0_1 * v1;
            const vector z1 = W1_0 * v0 + W1_1 * v1;
            const vector phi = exp_each(atanh_value - 0.5 * (z0 * z0 + z1 * z1));
            kept[k][b].z0 = z0;
            kept[k][b].z1 = z1;
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 11 * near[k];
        const double amplitude = S[6];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector total_3 = kept[k][b].total_3;
            const vector difference_ratio = kept[k][b].difference_ratio;
            const vector phi = kept[k][b].phi;
            const vector phi_2 = amplitude * phi;
            const vector by_difference = phi_2 / (1.0 - difference_ratio * difference_ratio) / total_3;
            kept[k][b].phi_2 = phi_2;
            kept[k][b].by_difference = by_difference;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 11 * near[k];
        const double W0_0 = S[2];
        const double W0_1 = S[3];
        const double W1_0 = S[4];
        const double W1_1 = S[5];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            vector *slope = slopes + 3 * b;
            const vector total_2 = kept[k][b].total_2;
            const vector sin_p1_plus_q1 = kept[k][b].sin_p1_plus_q1;
            const vector gap = kept[k][b].gap;
            const vector product = kept[k][b].product;
            const vector difference_ratio = kept[k][b].difference_ratio;
            const vector z0 = kept[k][b].z0;
            const vector z1 = kept[k][b].z1;
            const vector phi_2 = kept[k][b].phi_2;
            const vector by_difference = kept[k][b].by_difference;
            const vector by_sin_p1_minus_q1 = 0.25 * (sin_p1_plus_q1 * by_difference);
            const vector by_sin_p1_plus_q1 = product * by_difference;
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] - phi_2 * (W1_0 * z1 + W0_0 * z0);
            slope[1] = slope[1] - phi_2 * (W1_1 * z1 + W0_1 * z0) - by_sin_p1_minus_q1 * cos_each(gap) +
                    by_sin_p1_plus_q1 * cos_each(total_2);
            slope[2] = slope[2] + difference_ratio * by_difference;
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient(
    const vector *x, const vector *slope, vector *gradient) {
    const vector x1 = x[1];
    const vector slope_x0 = slope[0];
    const vector slope_x1 = slope[1];
    const vector slope_mul_of_one = slope[2];
    const vector cos_q1 = cos_each(x1);
    const vector by_cos_q1 = cos_q1 * (0.5 * slope_mul_of_one);
    const vector gap = slope_x1 - by_cos_q1 * sin_each(x1);
    const vector total_2 = 12.0 + 18.0 * cos_q1;
    const vector gap_2 = 9.0 * (cos_q1 * cos_q1) - 16.0;
    const vector total_3 = slope_x0 * total_2 / gap_2 + gap * (-60.0 - 36.0 * cos_q1) / gap_2;
    gradient[0] = gap * total_2 / gap_2 - 12.0 * slope_x0 / gap_2;
    gradient[1] = total_3;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp(
    const vector *x, const vector *gradient_bar, vector *slope_bar) {
    const vector x1 = x[1];
    const vector gradient_bar0 = gradient_bar[0];
    const vector gradient_bar1 = gradient_bar[1];
    const vector cos_q1 = cos_each(x1);
    const vector total_2 = 12.0 + 18.0 * cos_q1;
    const vector gap = 9.0 * (cos_q1 * cos_q1) - 16.0;
    const vector ratio = gradient_bar1 / gap;
    const vector ratio_2 = gradient_bar0 / gap;
    const vector total_3 = (-60.0 - 36.0 * cos_q1) * ratio + total_2 * ratio_2;
    const vector minus = -0.5 * (cos_q1 * (sin_each(x1) * total_3));
    slope_bar[0] = total_2 * ratio - 12.0 * ratio_2;
    slope_bar[1] = total_3;
    slope_bar[2] = minus;
}

/*
 * Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_backward(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *sums) {
    struct { vector v0, v1, z1, z0, total_2, total_3, sin_p1_plus_q1, gap_3, sin_p1_minus_q1, product,
            total_4, difference_ratio, atanh_value, phi, cos_2, by_by_sin_p1_plus_q1, cos_3, product_2, ratio,
            gap_4, ratio_2, total_5, by_atanh_value, phi_ratio, by_difference, total_6, by_difference_2; }
            kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 7 * (size_t)near[i];
        const vector x1 = X[1];
        const double mu1 = S[1];
        const vector total_3 = x1 + mu1;
        const vector sin_p1_plus_q1 = sin_each(total_3);
        const vector gap_3 = mu1 - x1;
        const vector sin_p1_minus_q1 = sin_each(gap_3);
        kept[i].total_3 = total_3;
        kept[i].sin_p1_plus_q1 = sin_p1_plus_q1;
        kept[i].gap_3 = gap_3;
        kept[i].sin_p1_minus_q1 = sin_p1_minus_q1;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 7 * (size_t)near[i];
        const vector sin_p1_plus_q1 = kept[i].sin_p1_plus_q1;
        const vector sin_p1_minus_q1 = kept[i].sin_p1_minus_q1;
        const vector mul_of_one = X[2];
        const double sub_of_one = S[7];
        const vector product = 0.25 * sin_p1_minus_q1;
        const vector difference = sin_p1_plus_q1 * product;
        const vector total_4 = sub_of_one - mul_of_one;
        const vector difference_ratio = difference / total_4;
        kept[i].product = product;
        kept[i].total_4 = total_4;
        kept[i].difference_ratio = difference_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector difference_ratio = kept[i].difference_ratio;
        const vector atanh_value = atanh_each(difference_ratio);
        kept[i].atanh_value = atanh_value;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 7 * (size_t)near[i];
        const vector total_3 = kept[i].total_3;
        const vector gap_3 = kept[i].gap_3;
        const vector atanh_value = kept[i].atanh_value;
        const vector x0 = X[0];
        const vector x1 = X[1];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double W0_0 = S[2];
        const double W0_1 = S[3];
        const double W1_0 = S[4];
        const double W1_1 = S[5];
        const vector gap = x0 - mu0;
        const vector round_2 = round_each(0.15915494309189535 * gap);
        const vector v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
        const vector gap_2 = x1 - mu1;
        const vector round_3 = round_each(0.15915494309189535 * gap_2);
        const vector v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
        const vector z1 = W1_0 * v0 + W1_1 * v1;
        const vector z0 = W0_0 * v0 + W0_1 * v1;
        const vector phi = exp_each(atanh_value - 0.5 * (z0 * z0 + z1 * z1));
        const vector cos_2 = cos_each(total_3);
        const vector cos_3 = cos_each(gap_3);
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].z1 = z1;
        kept[i].z0 = z0;
        kept[i].phi = phi;
        kept[i].cos_2 = cos_2;
        kept[i].cos_3 = cos_3;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *slope_bar = points + 7 * (size_t)near[i] + 3 + 1;
        const vector sin_p1_plus_q1 = kept[i].sin_p1_plus_q1;
        const vector product = kept[i].product;
        const vector total_4 = kept[i].total_4;
        const vector difference_ratio = kept[i].difference_ratio;
        const vector phi = kept[i].phi;
        const vector cos_2 = kept[i].cos_2;
        const vector cos_3 = kept[i].cos_3;
        const vector x1_bar = slope_bar[1];
        const vector mul_of_one_bar = slope_bar[2];
        const vector by_by_sin_p1_plus_q1 = cos_2 * x1_bar;
        const vector product_2 = 0.25 * (cos_3 * x1_bar);
        const vector by_by_difference = product * by_by_sin_p1_plus_q1 - sin_p1_plus_q1 * product_2 +
            difference_ratio * mul_of_one_bar;
        const vector ratio = by_by_difference / total_4;
        const vector gap_4 = 1.0 - difference_ratio * difference_ratio;
        const vector phi_ratio = phi / gap_4;
        kept[i].by_by_sin_p1_plus_q1 = by_by_sin_p1_plus_q1;
        kept[i].product_2 = product_2;
        kept[i].ratio = ratio;
        kept[i].gap_4 = gap_4;
        kept[i].phi_ratio = phi_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector total_4 = kept[i].total_4;
        const vector ratio = kept[i].ratio;
        const vector gap_4 = kept[i].gap_4;
        const vector phi_ratio = kept[i].phi_ratio;
        const vector ratio_2 = ratio / gap_4;
        const vector by_difference = phi_ratio / total_4;
        kept[i].ratio_2 = ratio_2;
        kept[i].by_difference = by_difference;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *value_bar = points + 7 * (size_t)near[i] + 3;
        const vector *slope_bar = points + 7 * (size_t)near[i] + 3 + 1;
        const vector z1 = kept[i].z1;
        const vector z0 = kept[i].z0;
        const vector difference_ratio = kept[i].difference_ratio;
        const vector phi = kept[i].phi;
        const vector gap_4 = kept[i].gap_4;
        const vector ratio_2 = kept[i].ratio_2;
        const vector phi_ratio = kept[i].phi_ratio;
        const vector by_difference = kept[i].by_difference;
        const double W0_0 = S[2];
        const double W0_1 = S[3];
        const double W1_0 = S[4];
        const double W1_1 = S[5];
        const vector its_value_bar = value_bar[0];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector mul_of_one_bar = slope_bar[2];
        const vector total_2 = W1_0 * z1 + W0_0 * z0;
        const vector total_5 = W1_1 * z1 + W0_1 * z0;
        const vector by_phi = its_value_bar + ratio_2 - total_5 * x1_bar - total_2 * x0_bar;
        const vector by_atanh_value = phi * by_phi;
        const vector total_6 = by_difference * mul_of_one_bar + difference_ratio * (2.0 * (phi_ratio * ratio_2)) +
            by_atanh_value / gap_4;
        kept[i].total_2 = total_2;
        kept[i].total_5 = total_5;
        kept[i].by_atanh_value = by_atanh_value;
        kept[i].total_6 = total_6;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector total_4 = kept[i].total_4;
        const vector total_6 = kept[i].total_6;
        const vector by_difference_2 = total_6 / total_4;
        kept[i].by_difference_2 = by_difference_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *slope_bar = points + 7 * (size_t)near[i] + 3 + 1;
        const vector v0 = kept[i].v0;
        const vector v1 = kept[i].v1;
        const vector total_2 = kept[i].total_2;
        const vector sin_p1_plus_q1 = kept[i].sin_p1_plus_q1;
        const vector sin_p1_minus_q1 = kept[i].sin_p1_minus_q1;
        const vector product = kept[i].product;
        const vector difference_ratio = kept[i].difference_ratio;
        const vector phi = kept[i].phi;
        const vector cos_2 = kept[i].cos_2;
        const vector by_by_sin_p1_plus_q1 = kept[i].by_by_sin_p1_plus_q1;
        const vector cos_3 = kept[i].cos_3;
        const vector product_2 = kept[i].product_2;
        const vector ratio = kept[i].ratio;
        const vector total_5 = kept[i].total_5;
        const vector by_atanh_value = kept[i].by_atanh_value;
        const vector by_difference = kept[i].by_difference;
        const vector by_difference_2 = kept[i].by_difference_2;
        const double M0_0 = S[8];
        const double M0_1 = S[9];
        const double M1_1 = S[10];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector phi_product = phi * x0_bar;
        const vector phi_product_2 = phi * x1_bar;
        const vector by_sin_p1_minus_q1 = 0.25 * (sin_p1_plus_q1 * by_difference);
        const vector by_sin_p1_minus_q1_2 = 0.25 * (by_difference * by_by_sin_p1_plus_q1 + sin_p1_plus_q1 *
            by_difference_2);
        const vector by_sin_p1_plus_q1 = product * by_difference_2 - by_difference * product_2;
        const vector by_sin_p1_plus_q1_2 = product * by_difference;
        const vector product_3 = 0.5 * by_atanh_value;
        const vector gap_5 = -phi_product - v0 * product_3;
        const vector gap_6 = -phi_product_2 - v1 * product_3;
        sums[0] = sums[0] + total_2 * by_atanh_value + M0_0 * phi_product + M0_1 * phi_product_2;
        sums[1] = sums[1] + total_5 * by_atanh_value + M0_1 * phi_product + M1_1 * phi_product_2 + sin_p1_minus_q1
                * (by_sin_p1_minus_q1 * x1_bar) + cos_3 * by_sin_p1_minus_q1_2 + cos_2 * by_sin_p1_plus_q1 -
                sin_p1_plus_q1 * (by_sin_p1_plus_q1_2 * x1_bar);
        sums[2] = sums[2] + by_atanh_value;
        sums[3] = sums[3] - by_difference * ratio - difference_ratio * by_difference_2;
        sums[4] = sums[4] + v0 * gap_5;
        sums[5] = sums[5] + v0 * gap_6 + v1 * gap_5;
        sums[6] = sums[6] + v1 * gap_6;
    }
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp(
    const vector *mu, const vector *W, const vector *amplitude, const vector *sums, vector *mu_bar, vector *W_bar, vector *amplitude_bar) {
    const vector mu1 = mu[1];
    const vector W0_0 = W[0];
    const vector W0_1 = W[1];
    const vector W1_0 = W[2];
    const vector W1_1 = W[3];
    const vector its_amplitude = amplitude[0];
    const vector sum0 = sums[0];
    const vector sum1 = sums[1];
    const vector sum2 = sums[2];
    const vector sum3 = sums[3];
    const vector sum4 = sums[4];
    const vector sum5 = sums[5];
    const vector sum6 = sums[6];
    const vector cos_p1 = cos_each(mu1);
    const vector product = its_amplitude * (sum1 + cos_p1 * (0.5 * sum3) * sin_each(mu1));
    const vector product_2 = 2.0 * sum4;
    const vector product_3 = 2.0 * sum6;
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = product;
    W_bar[0] = its_amplitude * (W0_0 * product_2 + W0_1 * sum5);
    W_bar[1] = its_amplitude * (W0_0 * sum5 + W0_1 * product_3);
    W_bar[2] = its_amplitude * (W1_0 * product_2 + W1_1 * sum5);
    W_bar[3] = its_amplitude * (W1_0 * sum5 + W1_1 * product_3);
    amplitude_bar[0] = sum2;
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
size_t arm2_splats_work(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES - 1) / LANES, blocks = (points + 2 - 1) / 2;
    const size_t places = 0 * ((splat_count + LANES - 1) / LANES + (blocks + LANES - 1) / LANES);
    return (points * 7 + places + 1) * LANES + 11 * splat_count;
}

static vector *work_points(double *work) {
    const uintptr_t size = sizeof(vector), start = (uintptr_t)work;
    return (vector *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const double *splat_at(const vector *splats, size_t k) {
    const size_t row = k / LANES;
    return (const double *)(splats + 0 * row) + (k - row * LANES);
}

static vector *work_reaches(double *work, size_t count) {
    return work_points(work) + (count + LANES - 1) / LANES * 7;
}

static vector *work_blocks(double *work, size_t count, size_t splat_count) {
    return work_reaches(work, count) + 0 * ((splat_count + LANES - 1) / LANES);
}

static double *work_constants(double *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES, blocks = (count + size - 1) / size;
    return (double *)(work_blocks(work, count, splat_count) + 0 * ((blocks + LANES - 1) / LANES));
}

/* Nothing bounds what a far splat adds on this manifold: all are near. */
static void splat_reach(
    const vector *mu, const vector *amplitude, const double *width, size_t splat_count, size_t start, vector *splats) {
    (void)mu, (void)amplitude, (void)width, (void)splat_count, (void)start, (void)splats;
}
static void block_place(const double *x, size_t count, size_t start, double *place) {
    (void)x, (void)count, (void)start, (void)place;
}
static size_t splats_near(const double *place, const vector *splats, size_t first, size_t end, uint32_t *near) {
    (void)place, (void)splats;
    for (size_t k = first; k < end; ++k) near[k - first] = (uint32_t)k;
    return end - first;
}
static size_t blocks_near(
    const double *mu, const double *reach, const vector *blocks, size_t first, size_t end, uint32_t *near) {
    (void)mu, (void)reach, (void)blocks;
    for (size_t b = first; b < end; ++b) near[b - first] = (uint32_t)(b - first);
    return end - first;
}

/* The constants of LANES splats, as rows; with `width`, how far they reach. */
OUTLINE void splat_constants(
    size_t splat_count, size_t start, const double *mu, const double *W, const double *amplitude, const double *width, double *constants,
    vector *splats) {
    vector own_mu[2], own_W[4], own_amplitude[1], S[11];
    vector_rows(mu, splat_count, start, 2, own_mu);
    vector_rows(W, splat_count, start, 4, own_W);
    vector_rows(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants(own_mu, own_W, own_amplitude, S);
    vector_to_rows(S, constants, splat_count, start, 11, 11);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void arm2_splats(
    size_t count, size_t splat_count, const double *ARM2_RESTRICT x, const double *ARM2_RESTRICT mu, const double *ARM2_RESTRICT W, const double *ARM2_RESTRICT amplitude, const double *ARM2_RESTRICT width,
    double *ARM2_RESTRICT value, double *ARM2_RESTRICT gradient, double *ARM2_RESTRICT work, int threads) {
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
            vector at[2][2], X[2 * 3], grad[2];
            vector value_sum[2] = {ZERO}, slope_sum[2 * 3] = {ZERO};
            double place[2 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 2, at[b]);
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
                vector_to_rows(grad, gradient, count, start + b * LANES, 2, 2);
            }
        }
        restore_denormals(mode);
    }
}

void arm2_splats_value(
    size_t count, size_t splat_count, const double *ARM2_RESTRICT x, const double *ARM2_RESTRICT mu, const double *ARM2_RESTRICT W, const double *ARM2_RESTRICT amplitude, const double *ARM2_RESTRICT width,
    double *ARM2_RESTRICT value, double *ARM2_RESTRICT work, int threads) {
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
            vector at[2], X[2 * 3], value_sum[2] = {ZERO};
            double place[2 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 2, at);
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
    vector at[2], grad_bar[2], slope_bar[3];
    vector_rows(x, count, start, 2, at);
    vector_rows(gradient_bar, count, start, 2, grad_bar);
    vector_rows(value_bar, count, start, 1, point + 3);
    pair_features(at, point);
    pair_gradient_vjp(at, grad_bar, slope_bar);
    for (int i = 0; i < 3; ++i) point[3 + 1 + i] = slope_bar[i];
    vector_end(count, start, 3 + 1, point + 3);
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums(const vector *points, const uint32_t *near, size_t size, const double *S, double *sums) {
    vector sum[7] = {ZERO};
    for (size_t b = 0; b < size; b += 16)
        pair_backward(size - b < 16 ? size - b : 16, points, near + b, S, sum);
    sums[0] += vector_sum(sum[0]);
    sums[1] += vector_sum(sum[1]);
    sums[2] += vector_sum(sum[2]);
    sums[3] += vector_sum(sum[3]);
    sums[4] += vector_sum(sum[4]);
    sums[5] += vector_sum(sum[5]);
    sums[6] += vector_sum(sum[6]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void arm2_splats_vjp(
    size_t count, size_t splat_count, const double *ARM2_RESTRICT x, const double *ARM2_RESTRICT mu, const double *ARM2_RESTRICT W, const double *ARM2_RESTRICT amplitude, const double *ARM2_RESTRICT width, const double *ARM2_RESTRICT value_bar, const double *ARM2_RESTRICT gradient_bar,
    double *ARM2_RESTRICT mu_bar, double *ARM2_RESTRICT W_bar, double *ARM2_RESTRICT amplitude_bar, double *ARM2_RESTRICT work, int threads) {
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
                double place[2 + 1];
                const size_t last = (blocks - 1) / 2, start = (block < last ? block : last) * 2;
                block_place(x, count, start * LANES, place);
                for (int i = 0; i < 0; ++i) {
                    double *row = (double *)(places + block / LANES * 0 + i);
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
            double sums[LANES][7] = {{0}};
            uint32_t near[131072 / (7 * sizeof(vector)) + 2];
            vector own_mu[2], own_W[4], own_amplitude[1], own_sums[7], bars[7];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const double *reach = width ? splat_at(splats, k) + 2 * LANES : NULL;
                    const size_t some = blocks_near(mu + 2 * k, reach, places, first, first + size, near);
                    splat_sums(points + 7 * first, near, some, constants + 11 * k, sums[k - start]);
                }
            }
            vector_rows(mu, end, start, 2, own_mu);
            vector_rows(W, end, start, 4, own_W);
            vector_rows(amplitude, end, start, 1, own_amplitude);
            vector_rows(sums[0], LANES, 0, 7, own_sums);
            pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 2, bars + 2 + 4);
            vector_to_rows(bars, mu_bar, end, start, 2, 2);
            vector_to_rows(bars + 2, W_bar, end, start, 4, 4);
            vector_to_rows(bars + 2 + 4, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void arm2_splats_rows(
    size_t count, size_t splat_count, const double *ARM2_RESTRICT x, const double *ARM2_RESTRICT mu, const double *ARM2_RESTRICT W, const double *ARM2_RESTRICT amplitude, const double *ARM2_RESTRICT value_bar, const double *ARM2_RESTRICT gradient_bar,
    double *ARM2_RESTRICT rows, double *ARM2_RESTRICT work, int threads) {
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
                vector own_mu[2], own_W[4], own_amplitude[1], own_sums[7] = {ZERO}, bars[7];
                for (int i = 0; i < 2; ++i) own_mu[i] = vector_of(mu[2 * k + i]);
                for (int i = 0; i < 4; ++i) own_W[i] = vector_of(W[4 * k + i]);
                own_amplitude[0] = vector_of(amplitude[k]);
                pair_backward(1, point, &only, constants + 11 * k, own_sums);
                pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 2, bars + 2 + 4);
                vector_to_rows(bars, rows + 7 * k, count, block * LANES, 7, 7 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

double arm2_splats_order(
    size_t count, size_t splat_count, const double *ARM2_RESTRICT x, const double *ARM2_RESTRICT mu, const double *ARM2_RESTRICT amplitude, const double *ARM2_RESTRICT width,
    double limit, size_t *ARM2_RESTRICT order, double *ARM2_RESTRICT work) {
    (void)x, (void)mu, (void)amplitude, (void)width, (void)limit, (void)work;
    (void)splat_count;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    return 1;
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

/* round to even, of numbers below 2^22; of larger ones, a whole number close by. */
INLINE vector_f round_each_f(vector_f x) { return (x + 12582912.0f) - 12582912.0f; }

/* exp = 2^k exp(r), |r| <= log(2) / 2, within 1 unit in the last place; below 1.6e-38 it is 0. */
INLINE vector_f exp_each_f(vector_f x) {
    const vector_f shifted = x * 1.4426950408889634f + 12582912.0f, k = shifted - 12582912.0f;
    const vector_f r = (x - k * 0.693145751953125f) - k * 1.4286068203094173e-06f;
    const vector_f part = r + r * r * (0.5f + r * (0.16666576998242924f + r * (0.041666554627878084f + r * (0.008363177629994445f + r * 0.0013926181810489343f))));
    const vector_f scale = vector_from_bits_f((vector_to_bits_f(shifted) + 126) << 23); /* 2^(k - 1) */
    const vector_f y = vector_select_f(x > 88.722839f, vector_of_f(HUGE_VALF), (scale + scale * part) * 2);
    return vector_select_f(x < -86.9f, vector_of_f(0), y);
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

/* atanh, within 3 units in the last place. */
INLINE vector_f atanh_each_f(vector_f x) {
    const vector_f a = abs_each_f(x);
    return signed_each_f(0.5f * log1p_each_f(2 * a / (1 - a)), x);
}

/* sin: x = k pi/2 + r, |r| <= pi/4, within 2 units in the last place; beyond 100.0, by the library. */
INLINE vector_f sin_each_f(vector_f x) {
    const vector_f shifted = x * 0.6366197723675814f + 12582912.0f, k = shifted - 12582912.0f;
    const vector_f r = ((x - k * 1.57080078125f) - k * -4.45445766672492e-06f) - k * 2.563344151594519e-12f, z = r * r;
    const vector_bits_f quarter = vector_to_bits_f(shifted);
    const vector_f sine = r + r * z * (-0.16666666663854385f + z * (0.008333331874358352f + z * (-0.0001984008654531293f + z * 2.724990115829391e-06f)));
    const vector_f cosine = 1 - (0.5f * z - z * z * (0.04166666666432045f + z * (-0.0013888887671723142f + z * (2.4800600218521467e-05f + z * -2.730093863463587e-07f))));
    const vector_f part = vector_select_f((quarter & 1) == 0, sine, cosine);
    vector_f y = vector_from_bits_f(vector_to_bits_f(part) ^ ((quarter & 2) << 30));
    int far = 0;
    for (size_t i = 0; i < LANES_f; ++i) far |= fabsf(LANE(x, i)) > 100.0f;
    if (far)
        for (size_t i = 0; i < LANES_f; ++i) LANE(y, i) = sinf(LANE(x, i));
    return y;
}

/* cos: x = k pi/2 + r, |r| <= pi/4, within 2 units in the last place; beyond 100.0, by the library. */
INLINE vector_f cos_each_f(vector_f x) {
    const vector_f shifted = x * 0.6366197723675814f + 12582912.0f, k = shifted - 12582912.0f;
    const vector_f r = ((x - k * 1.57080078125f) - k * -4.45445766672492e-06f) - k * 2.563344151594519e-12f, z = r * r;
    const vector_bits_f quarter = vector_to_bits_f(shifted) + 1;
    const vector_f sine = r + r * z * (-0.16666666663854385f + z * (0.008333331874358352f + z * (-0.0001984008654531293f + z * 2.724990115829391e-06f)));
    const vector_f cosine = 1 - (0.5f * z - z * z * (0.04166666666432045f + z * (-0.0013888887671723142f + z * (2.4800600218521467e-05f + z * -2.730093863463587e-07f))));
    const vector_f part = vector_select_f((quarter & 1) == 0, sine, cosine);
    vector_f y = vector_from_bits_f(vector_to_bits_f(part) ^ ((quarter & 2) << 30));
    int far = 0;
    for (size_t i = 0; i < LANES_f; ++i) far |= fabsf(LANE(x, i)) > 100.0f;
    if (far)
        for (size_t i = 0; i < LANES_f; ++i) LANE(y, i) = cosf(LANE(x, i));
    return y;
}

/* What pairs read of points x. */
OUTLINE void pair_features_f(
    const vector_f *x, vector_f *X) {
    const vector_f x0 = x[0];
    const vector_f x1 = x[1];
    const vector_f cos_q1 = cos_each_f(x1);
    X[0] = x0;
    X[1] = x1;
    X[2] = 0.25f * (cos_q1 * cos_q1);
}

/* What pairs read of a splat, of some splats. */
OUTLINE void pair_constants_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, vector_f *S) {
    const vector_f mu0 = mu[0];
    const vector_f mu1 = mu[1];
    const vector_f W0_0 = W[0];
    const vector_f W0_1 = W[1];
    const vector_f W1_0 = W[2];
    const vector_f W1_1 = W[3];
    const vector_f its_amplitude = amplitude[0];
    const vector_f cos_p1 = cos_each_f(mu1);
    const vector_f M0_0 = W0_0 * W0_0 + W1_0 * W1_0;
    const vector_f M0_1 = W0_0 * W0_1 + W1_0 * W1_1;
    const vector_f M1_1 = W0_1 * W0_1 + W1_1 * W1_1;
    S[0] = mu0;
    S[1] = mu1;
    S[2] = W0_0;
    S[3] = W0_1;
    S[4] = W1_0;
    S[5] = W1_1;
    S[6] = its_amplitude;
    S[7] = 0.8888888888888888f - 0.25f * (cos_p1 * cos_p1);
    S[8] = M0_0;
    S[9] = M0_1;
    S[10] = M1_1;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_value_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values) {
    struct { vector_f sin_p1_plus_q1, sin_p1_minus_q1, atanh_value, phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 11 * near[k];
        const float mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 3 * b;
            const vector_f x1 = X[1];
            const vector_f sin_p1_plus_q1 = sin_each_f(x1 + mu1);
            const vector_f sin_p1_minus_q1 = sin_each_f(mu1 - x1);
            kept[k][b].sin_p1_plus_q1 = sin_p1_plus_q1;
            kept[k][b].sin_p1_minus_q1 = sin_p1_minus_q1;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 11 * near[k];
        const float sub_of_one = S[7];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 3 * b;
            const vector_f sin_p1_plus_q1 = kept[k][b].sin_p1_plus_q1;
            const vector_f sin_p1_minus_q1 = kept[k][b].sin_p1_minus_q1;
            const vector_f mul_of_one = X[2];
            const vector_f difference = sin_p1_plus_q1 * (0.25f * sin_p1_minus_q1);
            const vector_f total_2 = sub_of_one - mul_of_one;
            const vector_f atanh_value = atanh_each_f(difference / total_2);
            kept[k][b].atanh_value = atanh_value;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 11 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float W0_0 = S[2];
        const float W0_1 = S[3];
        const float W1_0 = S[4];
        const float W1_1 = S[5];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 3 * b;
            const vector_f atanh_value = kept[k][b].atanh_value;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f gap = x0 - mu0;
            const vector_f round_2 = round_each_f(0.15915494309189535f * gap);
            const vector_f v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
            const vector_f gap_2 = x1 - mu1;
            const vector_f round_3 = round_each_f(0.15915494309189535f * gap_2);
            const vector_f v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
            const vector_f z0 = W0_0 * v0 + W0_1 * v1;
            const vector_f z1 = W1_0 * v0 + W1_1 * v1;
            const vector_f phi = exp_each_f(atanh_value - 0.5f * (z0 * z0 + z1 * z1));
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 11 * near[k];
        const float amplitude = S[6];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            const vector_f phi = kept[k][b].phi;
            value[0] = value[0] + amplitude * phi;
        }
    }
}

/*
 * Adds the values phi of some splats at 2 vectors of points, and slope = d phi / d X.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_forward_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values, vector_f *slopes) {
    struct { vector_f total_2, sin_p1_plus_q1, gap, sin_p1_minus_q1, product, total_3, difference_ratio,
            atanh_value, z0, z1, phi, phi_2, by_difference; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 11 * near[k];
        const float mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 3 * b;
            const vector_f x1 = X[1];
            const vector_f total_2 = x1 + mu1;
            const vector_f sin_p1_plus_q1 = sin_each_f(total_2);
            const vector_f gap = mu1 - x1;
            const vector_f sin_p1_minus_q1 = sin_each_f(gap);
            kept[k][b].total_2 = total_2;
            kept[k][b].sin_p1_plus_q1 = sin_p1_plus_q1;
            kept[k][b].gap = gap;
            kept[k][b].sin_p1_minus_q1 = sin_p1_minus_q1;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 11 * near[k];
        const float sub_of_one = S[7];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 3 * b;
            const vector_f sin_p1_plus_q1 = kept[k][b].sin_p1_plus_q1;
            const vector_f sin_p1_minus_q1 = kept[k][b].sin_p1_minus_q1;
            const vector_f mul_of_one = X[2];
            const vector_f product = 0.25f * sin_p1_minus_q1;
            const vector_f difference = sin_p1_plus_q1 * product;
            const vector_f total_3 = sub_of_one - mul_of_one;
            const vector_f difference_ratio = difference / total_3;
            kept[k][b].product = product;
            kept[k][b].total_3 = total_3;
            kept[k][b].difference_ratio = difference_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f difference_ratio = kept[k][b].difference_ratio;
            const vector_f atanh_value = atanh_each_f(difference_ratio);
            kept[k][b].atanh_value = atanh_value;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 11 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float W0_0 = S[2];
        const float W0_1 = S[3];
        const float W1_0 = S[4];
        const float W1_1 = S[5];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 3 * b;
            const vector_f atanh_value = kept[k][b].atanh_value;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f gap_2 = x0 - mu0;
            const vector_f round_2 = round_each_f(0.15915494309189535f * gap_2);
            const vector_f v0 = gap_2 - 6.28125f * round_2 - 0.001935307179586477f * round_2;
            const vector_f gap_3 = x1 - mu1;
            const vector_f round_3 = round_each_f(0.15915494309189535f * gap_3);
            const vector_f v1 = gap_3 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
            const vector_f z0 = W0_0 * v0 + W0_1 * v1;
            const vector_f z1 = W1_0 * v0 + W1_1 * v1;
            const vector_f phi = exp_each_f(atanh_value - 0.5f * (z0 * z0 + z1 * z1));
            kept[k][b].z0 = z0;
            kept[k][b].z1 = z1;
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 11 * near[k];
        const float amplitude = S[6];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f total_3 = kept[k][b].total_3;
            const vector_f difference_ratio = kept[k][b].difference_ratio;
            const vector_f phi = kept[k][b].phi;
            const vector_f phi_2 = amplitude * phi;
            const vector_f by_difference = phi_2 / (1.0f - difference_ratio * difference_ratio) / total_3;
            kept[k][b].phi_2 = phi_2;
            kept[k][b].by_difference = by_difference;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 11 * near[k];
        const float W0_0 = S[2];
        const float W0_1 = S[3];
        const float W1_0 = S[4];
        const float W1_1 = S[5];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            vector_f *slope = slopes + 3 * b;
            const vector_f total_2 = kept[k][b].total_2;
            const vector_f sin_p1_plus_q1 = kept[k][b].sin_p1_plus_q1;
            const vector_f gap = kept[k][b].gap;
            const vector_f product = kept[k][b].product;
            const vector_f difference_ratio = kept[k][b].difference_ratio;
            const vector_f z0 = kept[k][b].z0;
            const vector_f z1 = kept[k][b].z1;
            const vector_f phi_2 = kept[k][b].phi_2;
            const vector_f by_difference = kept[k][b].by_difference;
            const vector_f by_sin_p1_minus_q1 = 0.25f * (sin_p1_plus_q1 * by_difference);
            const vector_f by_sin_p1_plus_q1 = product * by_difference;
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] - phi_2 * (W1_0 * z1 + W0_0 * z0);
            slope[1] = slope[1] - phi_2 * (W1_1 * z1 + W0_1 * z0) - by_sin_p1_minus_q1 * cos_each_f(gap) +
                    by_sin_p1_plus_q1 * cos_each_f(total_2);
            slope[2] = slope[2] + difference_ratio * by_difference;
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient_f(
    const vector_f *x, const vector_f *slope, vector_f *gradient) {
    const vector_f x1 = x[1];
    const vector_f slope_x0 = slope[0];
    const vector_f slope_x1 = slope[1];
    const vector_f slope_mul_of_one = slope[2];
    const vector_f cos_q1 = cos_each_f(x1);
    const vector_f by_cos_q1 = cos_q1 * (0.5f * slope_mul_of_one);
    const vector_f gap = slope_x1 - by_cos_q1 * sin_each_f(x1);
    const vector_f total_2 = 12.0f + 18.0f * cos_q1;
    const vector_f gap_2 = 9.0f * (cos_q1 * cos_q1) - 16.0f;
    const vector_f total_3 = slope_x0 * total_2 / gap_2 + gap * (-60.0f - 36.0f * cos_q1) / gap_2;
    gradient[0] = gap * total_2 / gap_2 - 12.0f * slope_x0 / gap_2;
    gradient[1] = total_3;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp_f(
    const vector_f *x, const vector_f *gradient_bar, vector_f *slope_bar) {
    const vector_f x1 = x[1];
    const vector_f gradient_bar0 = gradient_bar[0];
    const vector_f gradient_bar1 = gradient_bar[1];
    const vector_f cos_q1 = cos_each_f(x1);
    const vector_f total_2 = 12.0f + 18.0f * cos_q1;
    const vector_f gap = 9.0f * (cos_q1 * cos_q1) - 16.0f;
    const vector_f ratio = gradient_bar1 / gap;
    const vector_f ratio_2 = gradient_bar0 / gap;
    const vector_f total_3 = (-60.0f - 36.0f * cos_q1) * ratio + total_2 * ratio_2;
    const vector_f minus = -0.5f * (cos_q1 * (sin_each_f(x1) * total_3));
    slope_bar[0] = total_2 * ratio - 12.0f * ratio_2;
    slope_bar[1] = total_3;
    slope_bar[2] = minus;
}

/*
 * Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_backward_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *sums) {
    struct { vector_f v0, v1, z1, z0, total_2, total_3, sin_p1_plus_q1, gap_3, sin_p1_minus_q1, product,
            total_4, difference_ratio, atanh_value, phi, cos_2, by_by_sin_p1_plus_q1, cos_3, product_2, ratio,
            gap_4, ratio_2, total_5, by_atanh_value, phi_ratio, by_difference, total_6, by_difference_2; }
            kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 7 * (size_t)near[i];
        const vector_f x1 = X[1];
        const float mu1 = S[1];
        const vector_f total_3 = x1 + mu1;
        const vector_f sin_p1_plus_q1 = sin_each_f(total_3);
        const vector_f gap_3 = mu1 - x1;
        const vector_f sin_p1_minus_q1 = sin_each_f(gap_3);
        kept[i].total_3 = total_3;
        kept[i].sin_p1_plus_q1 = sin_p1_plus_q1;
        kept[i].gap_3 = gap_3;
        kept[i].sin_p1_minus_q1 = sin_p1_minus_q1;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 7 * (size_t)near[i];
        const vector_f sin_p1_plus_q1 = kept[i].sin_p1_plus_q1;
        const vector_f sin_p1_minus_q1 = kept[i].sin_p1_minus_q1;
        const vector_f mul_of_one = X[2];
        const float sub_of_one = S[7];
        const vector_f product = 0.25f * sin_p1_minus_q1;
        const vector_f difference = sin_p1_plus_q1 * product;
        const vector_f total_4 = sub_of_one - mul_of_one;
        const vector_f difference_ratio = difference / total_4;
        kept[i].product = product;
        kept[i].total_4 = total_4;
        kept[i].difference_ratio = difference_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f difference_ratio = kept[i].difference_ratio;
        const vector_f atanh_value = atanh_each_f(difference_ratio);
        kept[i].atanh_value = atanh_value;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 7 * (size_t)near[i];
        const vector_f total_3 = kept[i].total_3;
        const vector_f gap_3 = kept[i].gap_3;
        const vector_f atanh_value = kept[i].atanh_value;
        const vector_f x0 = X[0];
        const vector_f x1 = X[1];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float W0_0 = S[2];
        const float W0_1 = S[3];
        const float W1_0 = S[4];
        const float W1_1 = S[5];
        const vector_f gap = x0 - mu0;
        const vector_f round_2 = round_each_f(0.15915494309189535f * gap);
        const vector_f v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
        const vector_f gap_2 = x1 - mu1;
        const vector_f round_3 = round_each_f(0.15915494309189535f * gap_2);
        const vector_f v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
        const vector_f z1 = W1_0 * v0 + W1_1 * v1;
        const vector_f z0 = W0_0 * v0 + W0_1 * v1;
        const vector_f phi = exp_each_f(atanh_value - 0.5f * (z0 * z0 + z1 * z1));
        const vector_f cos_2 = cos_each_f(total_3);
        const vector_f cos_3 = cos_each_f(gap_3);
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].z1 = z1;
        kept[i].z0 = z0;
        kept[i].phi = phi;
        kept[i].cos_2 = cos_2;
        kept[i].cos_3 = cos_3;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *slope_bar = points + 7 * (size_t)near[i] + 3 + 1;
        const vector_f sin_p1_plus_q1 = kept[i].sin_p1_plus_q1;
        const vector_f product = kept[i].product;
        const vector_f total_4 = kept[i].total_4;
        const vector_f difference_ratio = kept[i].difference_ratio;
        const vector_f phi = kept[i].phi;
        const vector_f cos_2 = kept[i].cos_2;
        const vector_f cos_3 = kept[i].cos_3;
        const vector_f x1_bar = slope_bar[1];
        const vector_f mul_of_one_bar = slope_bar[2];
        const vector_f by_by_sin_p1_plus_q1 = cos_2 * x1_bar;
        const vector_f product_2 = 0.25f * (cos_3 * x1_bar);
        const vector_f by_by_difference = product * by_by_sin_p1_plus_q1 - sin_p1_plus_q1 * product_2 +
            difference_ratio * mul_of_one_bar;
        const vector_f ratio = by_by_difference / total_4;
        const vector_f gap_4 = 1.0f - difference_ratio * difference_ratio;
        const vector_f phi_ratio = phi / gap_4;
        kept[i].by_by_sin_p1_plus_q1 = by_by_sin_p1_plus_q1;
        kept[i].product_2 = product_2;
        kept[i].ratio = ratio;
        kept[i].gap_4 = gap_4;
        kept[i].phi_ratio = phi_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f total_4 = kept[i].total_4;
        const vector_f ratio = kept[i].ratio;
        const vector_f gap_4 = kept[i].gap_4;
        const vector_f phi_ratio = kept[i].phi_ratio;
        const vector_f ratio_2 = ratio / gap_4;
        const vector_f by_difference = phi_ratio / total_4;
        kept[i].ratio_2 = ratio_2;
        kept[i].by_difference = by_difference;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *value_bar = points + 7 * (size_t)near[i] + 3;
        const vector_f *slope_bar = points + 7 * (size_t)near[i] + 3 + 1;
        const vector_f z1 = kept[i].z1;
        const vector_f z0 = kept[i].z0;
        const vector_f difference_ratio = kept[i].difference_ratio;
        const vector_f phi = kept[i].phi;
        const vector_f gap_4 = kept[i].gap_4;
        const vector_f ratio_2 = kept[i].ratio_2;
        const vector_f phi_ratio = kept[i].phi_ratio;
        const vector_f by_difference = kept[i].by_difference;
        const float W0_0 = S[2];
        const float W0_1 = S[3];
        const float W1_0 = S[4];
        const float W1_1 = S[5];
        const vector_f its_value_bar = value_bar[0];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_f mul_of_one_bar = slope_bar[2];
        const vector_f total_2 = W1_0 * z1 + W0_0 * z0;
        const vector_f total_5 = W1_1 * z1 + W0_1 * z0;
        const vector_f by_phi = its_value_bar + ratio_2 - total_5 * x1_bar - total_2 * x0_bar;
        const vector_f by_atanh_value = phi * by_phi;
        const vector_f total_6 = by_difference * mul_of_one_bar + difference_ratio * (2.0f * (phi_ratio *
            ratio_2)) + by_atanh_value / gap_4;
        kept[i].total_2 = total_2;
        kept[i].total_5 = total_5;
        kept[i].by_atanh_value = by_atanh_value;
        kept[i].total_6 = total_6;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f total_4 = kept[i].total_4;
        const vector_f total_6 = kept[i].total_6;
        const vector_f by_difference_2 = total_6 / total_4;
        kept[i].by_difference_2 = by_difference_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *slope_bar = points + 7 * (size_t)near[i] + 3 + 1;
        const vector_f v0 = kept[i].v0;
        const vector_f v1 = kept[i].v1;
        const vector_f total_2 = kept[i].total_2;
        const vector_f sin_p1_plus_q1 = kept[i].sin_p1_plus_q1;
        const vector_f sin_p1_minus_q1 = kept[i].sin_p1_minus_q1;
        const vector_f product = kept[i].product;
        const vector_f difference_ratio = kept[i].difference_ratio;
        const vector_f phi = kept[i].phi;
        const vector_f cos_2 = kept[i].cos_2;
        const vector_f by_by_sin_p1_plus_q1 = kept[i].by_by_sin_p1_plus_q1;
        const vector_f cos_3 = kept[i].cos_3;
        const vector_f product_2 = kept[i].product_2;
        const vector_f ratio = kept[i].ratio;
        const vector_f total_5 = kept[i].total_5;
        const vector_f by_atanh_value = kept[i].by_atanh_value;
        const vector_f by_difference = kept[i].by_difference;
        const vector_f by_difference_2 = kept[i].by_difference_2;
        const float M0_0 = S[8];
        const float M0_1 = S[9];
        const float M1_1 = S[10];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_f phi_product = phi * x0_bar;
        const vector_f phi_product_2 = phi * x1_bar;
        const vector_f by_sin_p1_minus_q1 = 0.25f * (sin_p1_plus_q1 * by_difference);
        const vector_f by_sin_p1_minus_q1_2 = 0.25f * (by_difference * by_by_sin_p1_plus_q1 + sin_p1_plus_q1 *
            by_difference_2);
        const vector_f by_sin_p1_plus_q1 = product * by_difference_2 - by_difference * product_2;
        const vector_f by_sin_p1_plus_q1_2 = product * by_difference;
        const vector_f product_3 = 0.5f * by_atanh_value;
        const vector_f gap_5 = -phi_product - v0 * product_3;
        const vector_f gap_6 = -phi_product_2 - v1 * product_3;
        sums[0] = sums[0] + total_2 * by_atanh_value + M0_0 * phi_product + M0_1 * phi_product_2;
        sums[1] = sums[1] + total_5 * by_atanh_value + M0_1 * phi_product + M1_1 * phi_product_2 + sin_p1_minus_q1
                * (by_sin_p1_minus_q1 * x1_bar) + cos_3 * by_sin_p1_minus_q1_2 + cos_2 * by_sin_p1_plus_q1 -
                sin_p1_plus_q1 * (by_sin_p1_plus_q1_2 * x1_bar);
        sums[2] = sums[2] + by_atanh_value;
        sums[3] = sums[3] - by_difference * ratio - difference_ratio * by_difference_2;
        sums[4] = sums[4] + v0 * gap_5;
        sums[5] = sums[5] + v0 * gap_6 + v1 * gap_5;
        sums[6] = sums[6] + v1 * gap_6;
    }
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, const vector_f *sums, vector_f *mu_bar, vector_f *W_bar, vector_f *amplitude_bar) {
    const vector_f mu1 = mu[1];
    const vector_f W0_0 = W[0];
    const vector_f W0_1 = W[1];
    const vector_f W1_0 = W[2];
    const vector_f W1_1 = W[3];
    const vector_f its_amplitude = amplitude[0];
    const vector_f sum0 = sums[0];
    const vector_f sum1 = sums[1];
    const vector_f sum2 = sums[2];
    const vector_f sum3 = sums[3];
    const vector_f sum4 = sums[4];
    const vector_f sum5 = sums[5];
    const vector_f sum6 = sums[6];
    const vector_f cos_p1 = cos_each_f(mu1);
    const vector_f product = its_amplitude * (sum1 + cos_p1 * (0.5f * sum3) * sin_each_f(mu1));
    const vector_f product_2 = 2.0f * sum4;
    const vector_f product_3 = 2.0f * sum6;
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = product;
    W_bar[0] = its_amplitude * (W0_0 * product_2 + W0_1 * sum5);
    W_bar[1] = its_amplitude * (W0_0 * sum5 + W0_1 * product_3);
    W_bar[2] = its_amplitude * (W1_0 * product_2 + W1_1 * sum5);
    W_bar[3] = its_amplitude * (W1_0 * sum5 + W1_1 * product_3);
    amplitude_bar[0] = sum2;
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
size_t arm2_splats_work_f(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES_f - 1) / LANES_f, blocks = (points + 2 - 1) / 2;
    const size_t places = 0 * ((splat_count + LANES_f - 1) / LANES_f + (blocks + LANES_f - 1) / LANES_f);
    return (points * 7 + places + 1) * LANES_f + 11 * splat_count;
}

static vector_f *work_points_f(float *work) {
    const uintptr_t size = sizeof(vector_f), start = (uintptr_t)work;
    return (vector_f *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const float *splat_at_f(const vector_f *splats, size_t k) {
    const size_t row = k / LANES_f;
    return (const float *)(splats + 0 * row) + (k - row * LANES_f);
}

static vector_f *work_reaches_f(float *work, size_t count) {
    return work_points_f(work) + (count + LANES_f - 1) / LANES_f * 7;
}

static vector_f *work_blocks_f(float *work, size_t count, size_t splat_count) {
    return work_reaches_f(work, count) + 0 * ((splat_count + LANES_f - 1) / LANES_f);
}

static float *work_constants_f(float *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES_f, blocks = (count + size - 1) / size;
    return (float *)(work_blocks_f(work, count, splat_count) + 0 * ((blocks + LANES_f - 1) / LANES_f));
}

/* Nothing bounds what a far splat adds on this manifold: all are near. */
static void splat_reach_f(
    const vector_f *mu, const vector_f *amplitude, const float *width, size_t splat_count, size_t start, vector_f *splats) {
    (void)mu, (void)amplitude, (void)width, (void)splat_count, (void)start, (void)splats;
}
static void block_place_f(const float *x, size_t count, size_t start, float *place) {
    (void)x, (void)count, (void)start, (void)place;
}
static size_t splats_near_f(const float *place, const vector_f *splats, size_t first, size_t end, uint32_t *near) {
    (void)place, (void)splats;
    for (size_t k = first; k < end; ++k) near[k - first] = (uint32_t)k;
    return end - first;
}
static size_t blocks_near_f(
    const float *mu, const float *reach, const vector_f *blocks, size_t first, size_t end, uint32_t *near) {
    (void)mu, (void)reach, (void)blocks;
    for (size_t b = first; b < end; ++b) near[b - first] = (uint32_t)(b - first);
    return end - first;
}

/* The constants of LANES splats, as rows; with `width`, how far they reach. */
OUTLINE void splat_constants_f(
    size_t splat_count, size_t start, const float *mu, const float *W, const float *amplitude, const float *width, float *constants,
    vector_f *splats) {
    vector_f own_mu[2], own_W[4], own_amplitude[1], S[11];
    vector_rows_f(mu, splat_count, start, 2, own_mu);
    vector_rows_f(W, splat_count, start, 4, own_W);
    vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants_f(own_mu, own_W, own_amplitude, S);
    vector_to_rows_f(S, constants, splat_count, start, 11, 11);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void arm2_splats_f(
    size_t count, size_t splat_count, const float *ARM2_RESTRICT x, const float *ARM2_RESTRICT mu, const float *ARM2_RESTRICT W, const float *ARM2_RESTRICT amplitude, const float *ARM2_RESTRICT width,
    float *ARM2_RESTRICT value, float *ARM2_RESTRICT gradient, float *ARM2_RESTRICT work, int threads) {
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
            vector_f at[2][2], X[2 * 3], grad[2];
            vector_f value_sum[2] = {ZERO}, slope_sum[2 * 3] = {ZERO};
            float place[2 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 2, at[b]);
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
                vector_to_rows_f(grad, gradient, count, start + b * LANES_f, 2, 2);
            }
        }
        restore_denormals(mode);
    }
}

void arm2_splats_value_f(
    size_t count, size_t splat_count, const float *ARM2_RESTRICT x, const float *ARM2_RESTRICT mu, const float *ARM2_RESTRICT W, const float *ARM2_RESTRICT amplitude, const float *ARM2_RESTRICT width,
    float *ARM2_RESTRICT value, float *ARM2_RESTRICT work, int threads) {
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
            vector_f at[2], X[2 * 3], value_sum[2] = {ZERO};
            float place[2 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 2, at);
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
    vector_f at[2], grad_bar[2], slope_bar[3];
    vector_rows_f(x, count, start, 2, at);
    vector_rows_f(gradient_bar, count, start, 2, grad_bar);
    vector_rows_f(value_bar, count, start, 1, point + 3);
    pair_features_f(at, point);
    pair_gradient_vjp_f(at, grad_bar, slope_bar);
    for (int i = 0; i < 3; ++i) point[3 + 1 + i] = slope_bar[i];
    vector_end_f(count, start, 3 + 1, point + 3);
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums_f(const vector_f *points, const uint32_t *near, size_t size, const float *S, float *sums) {
    vector_f sum[7] = {ZERO};
    for (size_t b = 0; b < size; b += 16)
        pair_backward_f(size - b < 16 ? size - b : 16, points, near + b, S, sum);
    sums[0] += vector_sum_f(sum[0]);
    sums[1] += vector_sum_f(sum[1]);
    sums[2] += vector_sum_f(sum[2]);
    sums[3] += vector_sum_f(sum[3]);
    sums[4] += vector_sum_f(sum[4]);
    sums[5] += vector_sum_f(sum[5]);
    sums[6] += vector_sum_f(sum[6]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void arm2_splats_vjp_f(
    size_t count, size_t splat_count, const float *ARM2_RESTRICT x, const float *ARM2_RESTRICT mu, const float *ARM2_RESTRICT W, const float *ARM2_RESTRICT amplitude, const float *ARM2_RESTRICT width, const float *ARM2_RESTRICT value_bar, const float *ARM2_RESTRICT gradient_bar,
    float *ARM2_RESTRICT mu_bar, float *ARM2_RESTRICT W_bar, float *ARM2_RESTRICT amplitude_bar, float *ARM2_RESTRICT work, int threads) {
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
                float place[2 + 1];
                const size_t last = (blocks - 1) / 2, start = (block < last ? block : last) * 2;
                block_place_f(x, count, start * LANES_f, place);
                for (int i = 0; i < 0; ++i) {
                    float *row = (float *)(places + block / LANES_f * 0 + i);
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
            float sums[LANES_f][7] = {{0}};
            uint32_t near[131072 / (7 * sizeof(vector_f)) + 2];
            vector_f own_mu[2], own_W[4], own_amplitude[1], own_sums[7], bars[7];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const float *reach = width ? splat_at_f(splats, k) + 2 * LANES_f : NULL;
                    const size_t some = blocks_near_f(mu + 2 * k, reach, places, first, first + size, near);
                    splat_sums_f(points + 7 * first, near, some, constants + 11 * k, sums[k - start]);
                }
            }
            vector_rows_f(mu, end, start, 2, own_mu);
            vector_rows_f(W, end, start, 4, own_W);
            vector_rows_f(amplitude, end, start, 1, own_amplitude);
            vector_rows_f(sums[0], LANES_f, 0, 7, own_sums);
            pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 2, bars + 2 + 4);
            vector_to_rows_f(bars, mu_bar, end, start, 2, 2);
            vector_to_rows_f(bars + 2, W_bar, end, start, 4, 4);
            vector_to_rows_f(bars + 2 + 4, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void arm2_splats_rows_f(
    size_t count, size_t splat_count, const float *ARM2_RESTRICT x, const float *ARM2_RESTRICT mu, const float *ARM2_RESTRICT W, const float *ARM2_RESTRICT amplitude, const float *ARM2_RESTRICT value_bar, const float *ARM2_RESTRICT gradient_bar,
    float *ARM2_RESTRICT rows, float *ARM2_RESTRICT work, int threads) {
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
                vector_f own_mu[2], own_W[4], own_amplitude[1], own_sums[7] = {ZERO}, bars[7];
                for (int i = 0; i < 2; ++i) own_mu[i] = vector_of_f(mu[2 * k + i]);
                for (int i = 0; i < 4; ++i) own_W[i] = vector_of_f(W[4 * k + i]);
                own_amplitude[0] = vector_of_f(amplitude[k]);
                pair_backward_f(1, point, &only, constants + 11 * k, own_sums);
                pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 2, bars + 2 + 4);
                vector_to_rows_f(bars, rows + 7 * k, count, block * LANES_f, 7, 7 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

double arm2_splats_order_f(
    size_t count, size_t splat_count, const float *ARM2_RESTRICT x, const float *ARM2_RESTRICT mu, const float *ARM2_RESTRICT amplitude, const float *ARM2_RESTRICT width,
    double limit, size_t *ARM2_RESTRICT order, float *ARM2_RESTRICT work) {
    (void)x, (void)mu, (void)amplitude, (void)width, (void)limit, (void)work;
    (void)splat_count;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    return 1;
}

#endif /* float */
