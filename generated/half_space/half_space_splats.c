/*
 * half_space: Hyperbolic space H^n of curvature -1 as the upper half of R^n, above the plane where the last
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "half_space.h"

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

/* asinh, within 3 units in the last place. */
INLINE vector asinh_each(vector x) {
    const vector a = abs_each(x), square = a * a;
    const vector near = log1p_each(a + square / (1 + sqrt_each(1 + square)));
    return signed_each(vector_select(a > 134217728.0, log_each(a) + 0.6931471805599453, near), x);
}

/* Of degree 10 on [0, 1], its relative error below 2^-56. */
INLINE vector vector_polynomial_log_det_series(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return -0.6666666666666666 + x * 0.0356782222222221 + x2 * (-0.0026349394579138403 + x *
        0.0002217367612080702) + x4 * (-2.003183119568235e-05 + x * 1.8922065620668275e-06 + x2 *
        (-1.8428477801605567e-07 + x * 1.833644732727326e-08)) + x8 * (-1.8368152828879524e-09 + x *
        1.7309695344511901e-10 + x2 * -1.1415832478190767e-11);
}

/* Of degree 10 on [0, 1], its relative error below 2^-56. */
INLINE vector vector_polynomial_t_over_sinh_t_near(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 1.0 + x * -0.07645333333333267 + x2 * (0.0070141346133057005 + x * -0.0006894693916646029) + x4 *
        (7.028297406461528e-05 + x * -7.327302641804558e-06 + x2 * (7.756073566036173e-07 + x *
        -8.292331503302048e-08)) + x8 * (8.837138970409671e-09 + x * -8.75303059047528e-10 + x2 *
        5.971582399354532e-11);
}

/* Of degree 9 on [0, 1], the derivative of a polynomial. */
INLINE vector vector_polynomial_t_over_sinh_t_near_slope(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return -0.07645333333333267 + x * 0.014028269226611401 + x2 * (-0.002068408174993809 + x *
        0.0002811318962584611) + x4 * (-3.663651320902279e-05 + x * 4.653644139621704e-06 + x2 *
        (-5.804632052311434e-07 + x * 7.069711176327737e-08)) + x8 * (-7.877727531427753e-09 + x *
        5.971582399354532e-10);
}

/* Of degree 9 on [0, 1], the derivative of a polynomial. */
INLINE vector vector_polynomial_log_det_series_slope(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.0356782222222221 + x * -0.005269878915827681 + x2 * (0.0006652102836242106 + x *
        -8.01273247827294e-05) + x4 * (9.461032810334137e-06 + x * -1.1057086680963339e-06 + x2 *
        (1.2835513129091284e-07 + x * -1.4694522263103619e-08)) + x8 * (1.5578725810060713e-09 + x *
        -1.1415832478190767e-10);
}

/* Of degree 8 on [0, 1], the derivative of a polynomial. */
INLINE vector vector_polynomial_log_det_series_slope_slope(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return -0.005269878915827681 + x * 0.001330420567248421 + x2 * (-0.00024038197434818817 + x *
        3.784413124133655e-05) + x4 * (-5.528543340481669e-06 + x * 7.70130787745477e-07 + x2 *
        (-1.0286165584172534e-07 + x * 1.246298064804857e-08)) + x8 * -1.0274249230371691e-09;
}

/* Of degree 8 on [0, 1], the derivative of a polynomial. */
INLINE vector vector_polynomial_t_over_sinh_t_near_slope_slope(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.014028269226611401 + x * -0.004136816349987618 + x2 * (0.0008433956887753833 + x *
        -0.00014654605283609116) + x4 * (2.326822069810852e-05 + x * -3.4827792313868604e-06 + x2 *
        (4.948797823429416e-07 + x * -6.302182025142203e-08)) + x8 * 5.3744241594190786e-09;
}

/* What pairs read of points x. */
OUTLINE void pair_features(
    const vector *x, vector *X) {
    const vector x0 = x[0];
    const vector x1 = x[1];
    X[0] = x0;
    X[1] = x1;
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
    S[7] = M0_0;
    S[8] = M0_1;
    S[9] = M1_1;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_value(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values) {
    struct { vector d0, sqrt_value, scale, d1, h_squared, h, asinh_h, sqrt_1_plus_h_to_2, t_ratio, log_det,
            scale_2, phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 2 * b;
            const vector x1 = X[1];
            const vector sqrt_value = 2.0 * sqrt_each(x1 * mu1);
            kept[k][b].sqrt_value = sqrt_value;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector sqrt_value = kept[k][b].sqrt_value;
            const vector scale = 1.0 / sqrt_value;
            kept[k][b].scale = scale;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 2 * b;
            const vector scale = kept[k][b].scale;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector d0 = x0 - mu0;
            const vector part0 = d0 * scale;
            const vector d1 = x1 - mu1;
            const vector part1 = d1 * scale;
            const vector h_squared = part0 * part0 + part1 * part1;
            const vector_mask its_near = h_squared < 0.11468;
            const vector h = sqrt_each(vector_select(its_near, vector_of(1.0), h_squared));
            kept[k][b].d0 = d0;
            kept[k][b].d1 = d1;
            kept[k][b].h_squared = h_squared;
            kept[k][b].h = h;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector h_squared = kept[k][b].h_squared;
            const vector h = kept[k][b].h;
            const vector asinh_h = asinh_each(h);
            const vector sqrt_1_plus_h_to_2 = sqrt_each(1.0 + h_squared);
            kept[k][b].asinh_h = asinh_h;
            kept[k][b].sqrt_1_plus_h_to_2 = sqrt_1_plus_h_to_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector h = kept[k][b].h;
            const vector asinh_h = kept[k][b].asinh_h;
            const vector sqrt_1_plus_h_to_2 = kept[k][b].sqrt_1_plus_h_to_2;
            const vector t = 2.0 * asinh_h;
            const vector sinh_t = sqrt_1_plus_h_to_2 * (2.0 * h);
            const vector t_ratio = t / sinh_t;
            kept[k][b].t_ratio = t_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 2 * b;
            const vector h_squared = kept[k][b].h_squared;
            const vector t_ratio = kept[k][b].t_ratio;
            const vector x1 = X[1];
            const vector_mask its_near = h_squared < 0.11468;
            const vector near_chosen = vector_select(its_near, 8.719916288803628 * h_squared, vector_of(0.0));
            const vector log_det_series = vector_polynomial_log_det_series(near_chosen);
            const vector log_det_near = h_squared * log_det_series;
            const vector log_det = vector_select(its_near, log_det_near, log_each(t_ratio));
            const vector t_over_sinh_t_near = vector_polynomial_t_over_sinh_t_near(near_chosen);
            const vector t_over_sinh_t = vector_select(its_near, t_over_sinh_t_near, t_ratio);
            const vector scale_2 = t_over_sinh_t / x1;
            kept[k][b].log_det = log_det;
            kept[k][b].scale_2 = scale_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double mu1 = S[1];
        const double W0_0 = S[2];
        const double W0_1 = S[3];
        const double W1_0 = S[4];
        const double W1_1 = S[5];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 2 * b;
            const vector d0 = kept[k][b].d0;
            const vector d1 = kept[k][b].d1;
            const vector log_det = kept[k][b].log_det;
            const vector scale_2 = kept[k][b].scale_2;
            const vector x1 = X[1];
            const vector v0 = scale_2 * (mu1 * d0);
            const vector dot_ds_ds = d0 * d0;
            const vector up = 0.5 * dot_ds_ds + 0.5 * d1 * (x1 + mu1);
            const vector v1 = up * scale_2;
            const vector z0 = W0_0 * v0 + W0_1 * v1;
            const vector z1 = W1_0 * v0 + W1_1 * v1;
            const vector phi = exp_each(log_det - 0.5 * (z0 * z0 + z1 * z1));
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
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
    struct { vector d0, product, length, sqrt_value, scale, part0, d1, part1, h_squared, near_chosen,
            log_det_series, near_chosen_2, h, asinh_h, h_squared_total, sqrt_1_plus_h_to_2, h_product, sinh_t,
            t_ratio, log_det, scale_2, d0_product, d1_product, total_2, up, z0, z1, phi, phi_2, phi_product,
            phi_product_2, by_t_over_sinh_t, by_t, chosen, by_h, by_h_squared, by_part0, by_part1, minus; }
            kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 2 * b;
            const vector x1 = X[1];
            const vector product = x1 * mu1;
            const vector length = sqrt_each(product);
            kept[k][b].product = product;
            kept[k][b].length = length;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector length = kept[k][b].length;
            const vector sqrt_value = 2.0 * length;
            const vector scale = 1.0 / sqrt_value;
            kept[k][b].sqrt_value = sqrt_value;
            kept[k][b].scale = scale;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 2 * b;
            const vector scale = kept[k][b].scale;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector d0 = x0 - mu0;
            const vector part0 = d0 * scale;
            const vector d1 = x1 - mu1;
            const vector part1 = d1 * scale;
            const vector h_squared = part0 * part0 + part1 * part1;
            const vector_mask its_near = h_squared < 0.11468;
            const vector near_chosen_2 = vector_select(its_near, vector_of(1.0), h_squared);
            const vector h = sqrt_each(near_chosen_2);
            kept[k][b].d0 = d0;
            kept[k][b].part0 = part0;
            kept[k][b].d1 = d1;
            kept[k][b].part1 = part1;
            kept[k][b].h_squared = h_squared;
            kept[k][b].near_chosen_2 = near_chosen_2;
            kept[k][b].h = h;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector h_squared = kept[k][b].h_squared;
            const vector h = kept[k][b].h;
            const vector asinh_h = asinh_each(h);
            const vector h_squared_total = 1.0 + h_squared;
            const vector sqrt_1_plus_h_to_2 = sqrt_each(h_squared_total);
            kept[k][b].asinh_h = asinh_h;
            kept[k][b].h_squared_total = h_squared_total;
            kept[k][b].sqrt_1_plus_h_to_2 = sqrt_1_plus_h_to_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector h = kept[k][b].h;
            const vector asinh_h = kept[k][b].asinh_h;
            const vector sqrt_1_plus_h_to_2 = kept[k][b].sqrt_1_plus_h_to_2;
            const vector t = 2.0 * asinh_h;
            const vector h_product = 2.0 * h;
            const vector sinh_t = sqrt_1_plus_h_to_2 * h_product;
            const vector t_ratio = t / sinh_t;
            kept[k][b].h_product = h_product;
            kept[k][b].sinh_t = sinh_t;
            kept[k][b].t_ratio = t_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 2 * b;
            const vector h_squared = kept[k][b].h_squared;
            const vector t_ratio = kept[k][b].t_ratio;
            const vector x1 = X[1];
            const vector_mask its_near = h_squared < 0.11468;
            const vector near_chosen = vector_select(its_near, 8.719916288803628 * h_squared, vector_of(0.0));
            const vector log_det_series = vector_polynomial_log_det_series(near_chosen);
            const vector log_det_near = h_squared * log_det_series;
            const vector log_det = vector_select(its_near, log_det_near, log_each(t_ratio));
            const vector t_over_sinh_t_near = vector_polynomial_t_over_sinh_t_near(near_chosen);
            const vector t_over_sinh_t = vector_select(its_near, t_over_sinh_t_near, t_ratio);
            const vector scale_2 = t_over_sinh_t / x1;
            kept[k][b].near_chosen = near_chosen;
            kept[k][b].log_det_series = log_det_series;
            kept[k][b].log_det = log_det;
            kept[k][b].scale_2 = scale_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double mu1 = S[1];
        const double W0_0 = S[2];
        const double W0_1 = S[3];
        const double W1_0 = S[4];
        const double W1_1 = S[5];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 2 * b;
            const vector d0 = kept[k][b].d0;
            const vector d1 = kept[k][b].d1;
            const vector log_det = kept[k][b].log_det;
            const vector scale_2 = kept[k][b].scale_2;
            const vector x1 = X[1];
            const vector d0_product = mu1 * d0;
            const vector v0 = scale_2 * d0_product;
            const vector dot_ds_ds = d0 * d0;
            const vector d1_product = 0.5 * d1;
            const vector total_2 = x1 + mu1;
            const vector up = 0.5 * dot_ds_ds + d1_product * total_2;
            const vector v1 = up * scale_2;
            const vector z0 = W0_0 * v0 + W0_1 * v1;
            const vector z1 = W1_0 * v0 + W1_1 * v1;
            const vector phi = exp_each(log_det - 0.5 * (z0 * z0 + z1 * z1));
            kept[k][b].d0_product = d0_product;
            kept[k][b].d1_product = d1_product;
            kept[k][b].total_2 = total_2;
            kept[k][b].up = up;
            kept[k][b].z0 = z0;
            kept[k][b].z1 = z1;
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double W0_0 = S[2];
        const double W0_1 = S[3];
        const double W1_0 = S[4];
        const double W1_1 = S[5];
        const double amplitude = S[6];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 2 * b;
            const vector d0_product = kept[k][b].d0_product;
            const vector up = kept[k][b].up;
            const vector z0 = kept[k][b].z0;
            const vector z1 = kept[k][b].z1;
            const vector phi = kept[k][b].phi;
            const vector x1 = X[1];
            const vector phi_2 = amplitude * phi;
            const vector phi_product = phi_2 * (W1_1 * z1 + W0_1 * z0);
            const vector phi_product_2 = phi_2 * (W1_0 * z1 + W0_0 * z0);
            const vector by_scale_2 = -(up * phi_product) - d0_product * phi_product_2;
            const vector by_t_over_sinh_t = by_scale_2 / x1;
            kept[k][b].phi_2 = phi_2;
            kept[k][b].phi_product = phi_product;
            kept[k][b].phi_product_2 = phi_product_2;
            kept[k][b].by_t_over_sinh_t = by_t_over_sinh_t;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector h_squared = kept[k][b].h_squared;
            const vector sinh_t = kept[k][b].sinh_t;
            const vector t_ratio = kept[k][b].t_ratio;
            const vector phi_2 = kept[k][b].phi_2;
            const vector by_t_over_sinh_t = kept[k][b].by_t_over_sinh_t;
            const vector_mask its_near = h_squared < 0.11468;
            const vector by_t = (vector_select(its_near, vector_of(0.0), by_t_over_sinh_t) + vector_select(its_near,
                vector_of(0.0), phi_2) / t_ratio) / sinh_t;
            kept[k][b].by_t = by_t;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector near_chosen_2 = kept[k][b].near_chosen_2;
            const vector h_squared_total = kept[k][b].h_squared_total;
            const vector sqrt_1_plus_h_to_2 = kept[k][b].sqrt_1_plus_h_to_2;
            const vector h_product = kept[k][b].h_product;
            const vector t_ratio = kept[k][b].t_ratio;
            const vector by_t = kept[k][b].by_t;
            const vector_mask is_small = h_squared_total == 0.0;
            const vector by_t_product = t_ratio * by_t;
            const vector chosen = vector_select(is_small, vector_of(0.0), -(h_product * by_t_product / (2.0 *
                vector_select(is_small, vector_of(1.0), sqrt_1_plus_h_to_2))));
            const vector by_asinh_h = 2.0 * by_t;
            const vector by_h = by_asinh_h / sqrt_each(1.0 + near_chosen_2) - 2.0 * (sqrt_1_plus_h_to_2 *
                by_t_product);
            kept[k][b].chosen = chosen;
            kept[k][b].by_h = by_h;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector h_squared = kept[k][b].h_squared;
            const vector near_chosen = kept[k][b].near_chosen;
            const vector log_det_series = kept[k][b].log_det_series;
            const vector h_product = kept[k][b].h_product;
            const vector phi_2 = kept[k][b].phi_2;
            const vector by_t_over_sinh_t = kept[k][b].by_t_over_sinh_t;
            const vector chosen = kept[k][b].chosen;
            const vector by_h = kept[k][b].by_h;
            const vector_mask its_near = h_squared < 0.11468;
            const vector by_log_det_near = vector_select(its_near, phi_2, vector_of(0.0));
            const vector by_t_over_sinh_t_near = vector_select(its_near, by_t_over_sinh_t, vector_of(0.0));
            const vector t_over_sinh_t_near_slope = vector_polynomial_t_over_sinh_t_near_slope(near_chosen);
            const vector by_log_det_series = h_squared * by_log_det_near;
            const vector log_det_series_slope = vector_polynomial_log_det_series_slope(near_chosen);
            const vector by_h_squared = chosen + vector_select(its_near, vector_of(0.0), by_h / h_product) +
                log_det_series * by_log_det_near + 8.719916288803628 * vector_select(its_near, by_t_over_sinh_t_near *
                t_over_sinh_t_near_slope + by_log_det_series * log_det_series_slope, vector_of(0.0));
            kept[k][b].by_h_squared = by_h_squared;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector d0 = kept[k][b].d0;
            const vector product = kept[k][b].product;
            const vector length = kept[k][b].length;
            const vector sqrt_value = kept[k][b].sqrt_value;
            const vector scale = kept[k][b].scale;
            const vector part0 = kept[k][b].part0;
            const vector d1 = kept[k][b].d1;
            const vector part1 = kept[k][b].part1;
            const vector by_h_squared = kept[k][b].by_h_squared;
            const vector product_2 = 2.0 * by_h_squared;
            const vector by_part0 = part0 * product_2;
            const vector by_part1 = part1 * product_2;
            const vector_mask is_small_2 = product == 0.0;
            const vector by_scale = d1 * by_part1 + d0 * by_part0;
            const vector minus = -(2.0 * (scale * (by_scale / sqrt_value)) / (2.0 * vector_select(is_small_2,
                vector_of(1.0), length)));
            kept[k][b].by_part0 = by_part0;
            kept[k][b].by_part1 = by_part1;
            kept[k][b].minus = minus;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 10 * near[k];
        const double mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            vector *slope = slopes + 2 * b;
            const vector d0 = kept[k][b].d0;
            const vector product = kept[k][b].product;
            const vector scale = kept[k][b].scale;
            const vector scale_2 = kept[k][b].scale_2;
            const vector d1_product = kept[k][b].d1_product;
            const vector total_2 = kept[k][b].total_2;
            const vector phi_2 = kept[k][b].phi_2;
            const vector phi_product = kept[k][b].phi_product;
            const vector phi_product_2 = kept[k][b].phi_product_2;
            const vector by_t_over_sinh_t = kept[k][b].by_t_over_sinh_t;
            const vector by_part0 = kept[k][b].by_part0;
            const vector by_part1 = kept[k][b].by_part1;
            const vector minus = kept[k][b].minus;
            const vector scale_2_product = scale_2 * phi_product;
            const vector_mask is_small_2 = product == 0.0;
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] - d0 * scale_2_product - mu1 * (scale_2 * phi_product_2) + scale * by_part0;
            slope[1] = slope[1] - d1_product * scale_2_product - scale_2 * by_t_over_sinh_t + scale * by_part1 - 0.5 *
                    (total_2 * scale_2_product) + mu1 * vector_select(is_small_2, vector_of(0.0), minus);
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient(
    const vector *x, const vector *slope, vector *gradient) {
    const vector x1 = x[1];
    const vector slope_x0 = slope[0];
    const vector slope_x1 = slope[1];
    const vector squared = x1 * x1;
    gradient[0] = slope_x0 * squared;
    gradient[1] = slope_x1 * squared;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp(
    const vector *x, const vector *gradient_bar, vector *slope_bar) {
    const vector x1 = x[1];
    const vector gradient_bar0 = gradient_bar[0];
    const vector gradient_bar1 = gradient_bar[1];
    const vector squared = x1 * x1;
    slope_bar[0] = squared * gradient_bar0;
    slope_bar[1] = squared * gradient_bar1;
}

/*
 * Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_backward(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *sums) {
    struct { vector d0, product, length, sqrt_value, scale, part0, d1, part1, h_squared, h_squared_total,
            near_chosen, h, h_product, asinh_h, sqrt_1_plus_h_to_2, sinh_t, t_ratio, d1_product, total_2, up,
            near_chosen_2, log_det_series, log_det, scale_2, d0_product, v0, v1, z0, z1, phi, total_3,
            phi_product, total_4, phi_product_2, by_t_over_sinh_t, ratio, by_t, by_t_product, product_2, ratio_2,
            sqrt_2, by_asinh_h_ratio, by_h_ratio, by_log_det_near, by_t_over_sinh_t_near,
            t_over_sinh_t_near_slope, by_log_det_series, log_det_series_slope, product_3, by_part0, product_4,
            ratio_3, product_5, sqrt_value_ratio, by_by_part0, by_by_part1, total_5, by_by_h_squared, by_by_h,
            by_by_asinh_h, by_by_h_product, ratio_4, gap, by_by_t_ratio, near_chosen_3, by_by_scale_2,
            phi_product_3, product_7, phi_product_4, ratio_5, by_by_log_det_series, by_log_det, by_v1, by_v0,
            by_t_over_sinh_t_2, by_t_2, by_sinh_t, by_h_2, total_8, by_part0_2, by_part1, by_scale_ratio, ratio_6,
            by_part1_2, by_sqrt_value, ratio_7; } kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 5 * (size_t)near[i];
        const vector x1 = X[1];
        const double mu1 = S[1];
        const vector product = x1 * mu1;
        const vector length = sqrt_each(product);
        kept[i].product = product;
        kept[i].length = length;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector length = kept[i].length;
        const vector sqrt_value = 2.0 * length;
        const vector scale = 1.0 / sqrt_value;
        kept[i].sqrt_value = sqrt_value;
        kept[i].scale = scale;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 5 * (size_t)near[i];
        const vector scale = kept[i].scale;
        const vector x0 = X[0];
        const vector x1 = X[1];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const vector d0 = x0 - mu0;
        const vector part0 = d0 * scale;
        const vector d1 = x1 - mu1;
        const vector part1 = d1 * scale;
        const vector h_squared = part0 * part0 + part1 * part1;
        const vector_mask its_near = h_squared < 0.11468;
        const vector near_chosen = vector_select(its_near, vector_of(1.0), h_squared);
        const vector h = sqrt_each(near_chosen);
        kept[i].d0 = d0;
        kept[i].part0 = part0;
        kept[i].d1 = d1;
        kept[i].part1 = part1;
        kept[i].h_squared = h_squared;
        kept[i].near_chosen = near_chosen;
        kept[i].h = h;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector product = kept[i].product;
        const vector length = kept[i].length;
        const vector h_squared = kept[i].h_squared;
        const vector h = kept[i].h;
        const double mu1 = S[1];
        const vector x1_bar = slope_bar[1];
        const vector h_squared_total = 1.0 + h_squared;
        const vector asinh_h = asinh_each(h);
        const vector sqrt_1_plus_h_to_2 = sqrt_each(h_squared_total);
        const vector_mask is_small_2 = product == 0.0;
        const vector product_4 = 2.0 * vector_select(is_small_2, vector_of(1.0), length);
        const vector ratio_3 = vector_select(is_small_2, vector_of(0.0), mu1 * x1_bar) / product_4;
        kept[i].h_squared_total = h_squared_total;
        kept[i].asinh_h = asinh_h;
        kept[i].sqrt_1_plus_h_to_2 = sqrt_1_plus_h_to_2;
        kept[i].product_4 = product_4;
        kept[i].ratio_3 = ratio_3;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector sqrt_value = kept[i].sqrt_value;
        const vector scale = kept[i].scale;
        const vector h = kept[i].h;
        const vector asinh_h = kept[i].asinh_h;
        const vector sqrt_1_plus_h_to_2 = kept[i].sqrt_1_plus_h_to_2;
        const vector ratio_3 = kept[i].ratio_3;
        const vector h_product = 2.0 * h;
        const vector t = 2.0 * asinh_h;
        const vector sinh_t = sqrt_1_plus_h_to_2 * h_product;
        const vector t_ratio = t / sinh_t;
        const vector product_5 = 2.0 * ratio_3;
        const vector sqrt_value_ratio = scale * product_5 / sqrt_value;
        kept[i].h_product = h_product;
        kept[i].sinh_t = sinh_t;
        kept[i].t_ratio = t_ratio;
        kept[i].product_5 = product_5;
        kept[i].sqrt_value_ratio = sqrt_value_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 5 * (size_t)near[i];
        const vector *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector d0 = kept[i].d0;
        const vector scale = kept[i].scale;
        const vector part0 = kept[i].part0;
        const vector d1 = kept[i].d1;
        const vector part1 = kept[i].part1;
        const vector h_squared = kept[i].h_squared;
        const vector near_chosen = kept[i].near_chosen;
        const vector h_product = kept[i].h_product;
        const vector t_ratio = kept[i].t_ratio;
        const vector sqrt_value_ratio = kept[i].sqrt_value_ratio;
        const vector x1 = X[1];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector_mask its_near = h_squared < 0.11468;
        const vector near_chosen_2 = vector_select(its_near, 8.719916288803628 * h_squared, vector_of(0.0));
        const vector log_det_series = vector_polynomial_log_det_series(near_chosen_2);
        const vector log_det_near = h_squared * log_det_series;
        const vector log_det = vector_select(its_near, log_det_near, log_each(t_ratio));
        const vector t_over_sinh_t_near = vector_polynomial_t_over_sinh_t_near(near_chosen_2);
        const vector t_over_sinh_t = vector_select(its_near, t_over_sinh_t_near, t_ratio);
        const vector scale_2 = t_over_sinh_t / x1;
        const vector sqrt_2 = sqrt_each(1.0 + near_chosen);
        const vector by_by_part0 = scale * x0_bar - d0 * sqrt_value_ratio;
        const vector by_by_part1 = scale * x1_bar - d1 * sqrt_value_ratio;
        const vector total_5 = part0 * by_by_part0 + part1 * by_by_part1;
        const vector by_by_h_squared = 2.0 * total_5;
        const vector by_by_h = vector_select(its_near, vector_of(0.0), by_by_h_squared) / h_product;
        kept[i].near_chosen_2 = near_chosen_2;
        kept[i].log_det_series = log_det_series;
        kept[i].log_det = log_det;
        kept[i].scale_2 = scale_2;
        kept[i].sqrt_2 = sqrt_2;
        kept[i].by_by_part0 = by_by_part0;
        kept[i].by_by_part1 = by_by_part1;
        kept[i].total_5 = total_5;
        kept[i].by_by_h_squared = by_by_h_squared;
        kept[i].by_by_h = by_by_h;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 5 * (size_t)near[i];
        const vector d0 = kept[i].d0;
        const vector d1 = kept[i].d1;
        const vector h_squared_total = kept[i].h_squared_total;
        const vector sqrt_1_plus_h_to_2 = kept[i].sqrt_1_plus_h_to_2;
        const vector log_det = kept[i].log_det;
        const vector scale_2 = kept[i].scale_2;
        const vector sqrt_2 = kept[i].sqrt_2;
        const vector by_by_h_squared = kept[i].by_by_h_squared;
        const vector by_by_h = kept[i].by_by_h;
        const vector x1 = X[1];
        const double mu1 = S[1];
        const double W0_0 = S[2];
        const double W0_1 = S[3];
        const double W1_0 = S[4];
        const double W1_1 = S[5];
        const vector_mask is_small = h_squared_total == 0.0;
        const vector dot_ds_ds = d0 * d0;
        const vector d1_product = 0.5 * d1;
        const vector total_2 = x1 + mu1;
        const vector up = 0.5 * dot_ds_ds + d1_product * total_2;
        const vector d0_product = mu1 * d0;
        const vector v0 = scale_2 * d0_product;
        const vector v1 = up * scale_2;
        const vector z0 = W0_0 * v0 + W0_1 * v1;
        const vector z1 = W1_0 * v0 + W1_1 * v1;
        const vector phi = exp_each(log_det - 0.5 * (z0 * z0 + z1 * z1));
        const vector product_2 = 2.0 * vector_select(is_small, vector_of(1.0), sqrt_1_plus_h_to_2);
        const vector by_by_asinh_h = by_by_h / sqrt_2;
        const vector ratio_4 = vector_select(is_small, vector_of(0.0), by_by_h_squared) / product_2;
        kept[i].d1_product = d1_product;
        kept[i].total_2 = total_2;
        kept[i].up = up;
        kept[i].d0_product = d0_product;
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].z0 = z0;
        kept[i].z1 = z1;
        kept[i].phi = phi;
        kept[i].product_2 = product_2;
        kept[i].by_by_asinh_h = by_by_asinh_h;
        kept[i].ratio_4 = ratio_4;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 5 * (size_t)near[i];
        const vector h_squared = kept[i].h_squared;
        const vector h_product = kept[i].h_product;
        const vector sqrt_1_plus_h_to_2 = kept[i].sqrt_1_plus_h_to_2;
        const vector sinh_t = kept[i].sinh_t;
        const vector t_ratio = kept[i].t_ratio;
        const vector up = kept[i].up;
        const vector d0_product = kept[i].d0_product;
        const vector z0 = kept[i].z0;
        const vector z1 = kept[i].z1;
        const vector phi = kept[i].phi;
        const vector by_by_h = kept[i].by_by_h;
        const vector by_by_asinh_h = kept[i].by_by_asinh_h;
        const vector ratio_4 = kept[i].ratio_4;
        const vector x1 = X[1];
        const double W0_0 = S[2];
        const double W0_1 = S[3];
        const double W1_0 = S[4];
        const double W1_1 = S[5];
        const vector_mask its_near = h_squared < 0.11468;
        const vector total_3 = W1_1 * z1 + W0_1 * z0;
        const vector phi_product = phi * total_3;
        const vector total_4 = W1_0 * z1 + W0_0 * z0;
        const vector phi_product_2 = phi * total_4;
        const vector by_scale_2 = -(up * phi_product) - d0_product * phi_product_2;
        const vector by_t_over_sinh_t = by_scale_2 / x1;
        const vector ratio = vector_select(its_near, vector_of(0.0), phi) / t_ratio;
        const vector by_by_h_product = 2.0 * by_by_h;
        const vector gap = -(sqrt_1_plus_h_to_2 * by_by_h_product) - h_product * ratio_4;
        const vector by_by_t = 2.0 * by_by_asinh_h + t_ratio * gap;
        const vector by_by_t_ratio = by_by_t / sinh_t;
        kept[i].total_3 = total_3;
        kept[i].phi_product = phi_product;
        kept[i].total_4 = total_4;
        kept[i].phi_product_2 = phi_product_2;
        kept[i].by_t_over_sinh_t = by_t_over_sinh_t;
        kept[i].ratio = ratio;
        kept[i].by_by_h_product = by_by_h_product;
        kept[i].gap = gap;
        kept[i].by_by_t_ratio = by_by_t_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 5 * (size_t)near[i];
        const vector *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector h_squared = kept[i].h_squared;
        const vector sinh_t = kept[i].sinh_t;
        const vector t_ratio = kept[i].t_ratio;
        const vector near_chosen_2 = kept[i].near_chosen_2;
        const vector scale_2 = kept[i].scale_2;
        const vector by_t_over_sinh_t = kept[i].by_t_over_sinh_t;
        const vector ratio = kept[i].ratio;
        const vector total_5 = kept[i].total_5;
        const vector by_by_t_ratio = kept[i].by_by_t_ratio;
        const vector x1 = X[1];
        const vector x1_bar = slope_bar[1];
        const vector_mask its_near = h_squared < 0.11468;
        const vector by_t = (vector_select(its_near, vector_of(0.0), by_t_over_sinh_t) + ratio) / sinh_t;
        const vector t_over_sinh_t_near_slope = vector_polynomial_t_over_sinh_t_near_slope(near_chosen_2);
        const vector near_chosen_3 = vector_select(its_near, 17.439832577607255 * total_5, vector_of(0.0));
        const vector by_by_t_over_sinh_t_near = t_over_sinh_t_near_slope * near_chosen_3;
        const vector by_by_t_over_sinh_t = vector_select(its_near, vector_of(0.0), by_by_t_ratio) +
            vector_select(its_near, by_by_t_over_sinh_t_near, vector_of(0.0)) - scale_2 * x1_bar;
        const vector by_by_scale_2 = by_by_t_over_sinh_t / x1;
        const vector ratio_5 = by_by_t_ratio / t_ratio;
        kept[i].by_t = by_t;
        kept[i].t_over_sinh_t_near_slope = t_over_sinh_t_near_slope;
        kept[i].near_chosen_3 = near_chosen_3;
        kept[i].by_by_scale_2 = by_by_scale_2;
        kept[i].ratio_5 = ratio_5;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 5 * (size_t)near[i];
        const vector *value_bar = points + 5 * (size_t)near[i] + 2;
        const vector *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector d0 = kept[i].d0;
        const vector h_squared = kept[i].h_squared;
        const vector d1_product = kept[i].d1_product;
        const vector total_2 = kept[i].total_2;
        const vector up = kept[i].up;
        const vector near_chosen_2 = kept[i].near_chosen_2;
        const vector log_det_series = kept[i].log_det_series;
        const vector scale_2 = kept[i].scale_2;
        const vector d0_product = kept[i].d0_product;
        const vector phi = kept[i].phi;
        const vector total_3 = kept[i].total_3;
        const vector phi_product = kept[i].phi_product;
        const vector total_4 = kept[i].total_4;
        const vector phi_product_2 = kept[i].phi_product_2;
        const vector by_t_over_sinh_t = kept[i].by_t_over_sinh_t;
        const vector by_t = kept[i].by_t;
        const vector sqrt_2 = kept[i].sqrt_2;
        const vector by_by_h_squared = kept[i].by_by_h_squared;
        const vector near_chosen_3 = kept[i].near_chosen_3;
        const vector by_by_scale_2 = kept[i].by_by_scale_2;
        const vector ratio_5 = kept[i].ratio_5;
        const vector x1 = X[1];
        const double mu1 = S[1];
        const double M0_0 = S[7];
        const double M0_1 = S[8];
        const double M1_1 = S[9];
        const vector its_value_bar = value_bar[0];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector_mask its_near = h_squared < 0.11468;
        const vector by_asinh_h = 2.0 * by_t;
        const vector by_asinh_h_ratio = by_asinh_h / sqrt_2;
        const vector log_det_series_slope = vector_polynomial_log_det_series_slope(near_chosen_2);
        const vector product_6 = mu1 * x0_bar;
        const vector gap_2 = -(scale_2 * product_6) - d0_product * by_by_scale_2;
        const vector phi_product_3 = phi * gap_2;
        const vector product_7 = 0.5 * x1_bar;
        const vector gap_3 = -(d0 * x0_bar) - d1_product * x1_bar - total_2 * product_7;
        const vector gap_4 = scale_2 * gap_3 - up * by_by_scale_2;
        const vector phi_product_4 = phi * gap_4;
        const vector by_by_log_det_series = log_det_series_slope * near_chosen_3;
        const vector by_by_log_det_near = h_squared * by_by_log_det_series + log_det_series * by_by_h_squared;
        const vector by_phi = its_value_bar + vector_select(its_near, vector_of(0.0), ratio_5) +
            vector_select(its_near, by_by_log_det_near, vector_of(0.0)) + total_3 * gap_4 + total_4 * gap_2;
        const vector by_log_det = phi * by_phi;
        const vector by_v1 = M0_1 * phi_product_3 + M1_1 * phi_product_4 - total_3 * by_log_det;
        const vector by_v0 = M0_0 * phi_product_3 + M0_1 * phi_product_4 - total_4 * by_log_det;
        const vector total_7 = -(by_t_over_sinh_t * x1_bar) - phi_product_2 * product_6 + phi_product * gap_3 + up
            * by_v1;
        const vector by_scale_2_2 = total_7 + d0_product * by_v0;
        const vector by_t_over_sinh_t_2 = by_scale_2_2 / x1;
        kept[i].by_asinh_h_ratio = by_asinh_h_ratio;
        kept[i].log_det_series_slope = log_det_series_slope;
        kept[i].phi_product_3 = phi_product_3;
        kept[i].product_7 = product_7;
        kept[i].phi_product_4 = phi_product_4;
        kept[i].by_by_log_det_series = by_by_log_det_series;
        kept[i].by_log_det = by_log_det;
        kept[i].by_v1 = by_v1;
        kept[i].by_v0 = by_v0;
        kept[i].by_t_over_sinh_t_2 = by_t_over_sinh_t_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector h_squared = kept[i].h_squared;
        const vector h_product = kept[i].h_product;
        const vector sqrt_1_plus_h_to_2 = kept[i].sqrt_1_plus_h_to_2;
        const vector sinh_t = kept[i].sinh_t;
        const vector t_ratio = kept[i].t_ratio;
        const vector ratio = kept[i].ratio;
        const vector by_t = kept[i].by_t;
        const vector by_asinh_h_ratio = kept[i].by_asinh_h_ratio;
        const vector gap = kept[i].gap;
        const vector ratio_5 = kept[i].ratio_5;
        const vector by_log_det = kept[i].by_log_det;
        const vector by_t_over_sinh_t_2 = kept[i].by_t_over_sinh_t_2;
        const vector_mask its_near = h_squared < 0.11468;
        const vector by_t_product = t_ratio * by_t;
        const vector by_h = by_asinh_h_ratio - 2.0 * (sqrt_1_plus_h_to_2 * by_t_product);
        const vector by_h_ratio = by_h / h_product;
        const vector by_t_2 = (by_t * gap - ratio * ratio_5 + vector_select(its_near, vector_of(0.0),
            by_t_over_sinh_t_2) + vector_select(its_near, vector_of(0.0), by_log_det) / t_ratio) / sinh_t;
        kept[i].by_t_product = by_t_product;
        kept[i].by_h_ratio = by_h_ratio;
        kept[i].by_t_2 = by_t_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector h_product = kept[i].h_product;
        const vector sqrt_1_plus_h_to_2 = kept[i].sqrt_1_plus_h_to_2;
        const vector t_ratio = kept[i].t_ratio;
        const vector by_t = kept[i].by_t;
        const vector by_t_product = kept[i].by_t_product;
        const vector product_2 = kept[i].product_2;
        const vector sqrt_2 = kept[i].sqrt_2;
        const vector by_h_ratio = kept[i].by_h_ratio;
        const vector by_by_h = kept[i].by_by_h;
        const vector ratio_4 = kept[i].ratio_4;
        const vector by_by_t_ratio = kept[i].by_by_t_ratio;
        const vector by_t_2 = kept[i].by_t_2;
        const vector ratio_2 = h_product * by_t_product / product_2;
        const vector by_sinh_t = -(by_t * by_by_t_ratio) - t_ratio * by_t_2;
        const vector product_8 = 2.0 * (-(by_h_ratio * by_by_h) - by_t_product * ratio_4 + sqrt_1_plus_h_to_2 *
            by_sinh_t);
        const vector by_asinh_h_2 = 2.0 * by_t_2;
        const vector by_h_2 = product_8 + by_asinh_h_2 / sqrt_2;
        kept[i].ratio_2 = ratio_2;
        kept[i].by_sinh_t = by_sinh_t;
        kept[i].by_h_2 = by_h_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector d0 = kept[i].d0;
        const vector sqrt_value = kept[i].sqrt_value;
        const vector part0 = kept[i].part0;
        const vector d1 = kept[i].d1;
        const vector part1 = kept[i].part1;
        const vector h_squared = kept[i].h_squared;
        const vector h_squared_total = kept[i].h_squared_total;
        const vector h_product = kept[i].h_product;
        const vector log_det_series = kept[i].log_det_series;
        const vector phi = kept[i].phi;
        const vector by_t_over_sinh_t = kept[i].by_t_over_sinh_t;
        const vector by_t_product = kept[i].by_t_product;
        const vector product_2 = kept[i].product_2;
        const vector ratio_2 = kept[i].ratio_2;
        const vector sqrt_2 = kept[i].sqrt_2;
        const vector by_asinh_h_ratio = kept[i].by_asinh_h_ratio;
        const vector by_h_ratio = kept[i].by_h_ratio;
        const vector t_over_sinh_t_near_slope = kept[i].t_over_sinh_t_near_slope;
        const vector log_det_series_slope = kept[i].log_det_series_slope;
        const vector by_by_asinh_h = kept[i].by_by_asinh_h;
        const vector by_by_h_product = kept[i].by_by_h_product;
        const vector ratio_4 = kept[i].ratio_4;
        const vector by_by_log_det_series = kept[i].by_by_log_det_series;
        const vector by_sinh_t = kept[i].by_sinh_t;
        const vector by_h_2 = kept[i].by_h_2;
        const vector_mask is_small = h_squared_total == 0.0;
        const vector_mask its_near = h_squared < 0.11468;
        const vector by_log_det_near = vector_select(its_near, phi, vector_of(0.0));
        const vector by_t_over_sinh_t_near = vector_select(its_near, by_t_over_sinh_t, vector_of(0.0));
        const vector by_log_det_series = h_squared * by_log_det_near;
        const vector by_h_squared = vector_select(is_small, vector_of(0.0), -ratio_2) + vector_select(its_near,
            vector_of(0.0), by_h_ratio) + log_det_series * by_log_det_near + 8.719916288803628 *
            vector_select(its_near, by_t_over_sinh_t_near * t_over_sinh_t_near_slope + by_log_det_series *
            log_det_series_slope, vector_of(0.0));
        const vector product_3 = 2.0 * by_h_squared;
        const vector by_part0 = part0 * product_3;
        const vector by_sqrt_1_plus_h_to_2 = vector_select(is_small, vector_of(0.0), 2.0 * (ratio_2 * ratio_4)) -
            by_t_product * by_by_h_product + h_product * by_sinh_t;
        const vector total_8 = by_log_det_near * by_by_log_det_series + vector_select(is_small, vector_of(0.0),
            by_sqrt_1_plus_h_to_2 / product_2) + vector_select(its_near, vector_of(0.0), by_h_2 / h_product -
            by_asinh_h_ratio * by_by_asinh_h / (2.0 * sqrt_2));
        const vector by_part1 = part1 * product_3;
        const vector by_scale = d1 * by_part1 + d0 * by_part0;
        const vector by_scale_ratio = by_scale / sqrt_value;
        kept[i].by_log_det_near = by_log_det_near;
        kept[i].by_t_over_sinh_t_near = by_t_over_sinh_t_near;
        kept[i].by_log_det_series = by_log_det_series;
        kept[i].product_3 = product_3;
        kept[i].by_part0 = by_part0;
        kept[i].total_8 = total_8;
        kept[i].by_part1 = by_part1;
        kept[i].by_scale_ratio = by_scale_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector d0 = kept[i].d0;
        const vector sqrt_value = kept[i].sqrt_value;
        const vector scale = kept[i].scale;
        const vector part0 = kept[i].part0;
        const vector d1 = kept[i].d1;
        const vector part1 = kept[i].part1;
        const vector h_squared = kept[i].h_squared;
        const vector near_chosen_2 = kept[i].near_chosen_2;
        const vector log_det_series = kept[i].log_det_series;
        const vector by_log_det_near = kept[i].by_log_det_near;
        const vector by_t_over_sinh_t_near = kept[i].by_t_over_sinh_t_near;
        const vector t_over_sinh_t_near_slope = kept[i].t_over_sinh_t_near_slope;
        const vector by_log_det_series = kept[i].by_log_det_series;
        const vector log_det_series_slope = kept[i].log_det_series_slope;
        const vector product_3 = kept[i].product_3;
        const vector by_part0 = kept[i].by_part0;
        const vector product_4 = kept[i].product_4;
        const vector product_5 = kept[i].product_5;
        const vector sqrt_value_ratio = kept[i].sqrt_value_ratio;
        const vector by_by_part0 = kept[i].by_by_part0;
        const vector by_by_part1 = kept[i].by_by_part1;
        const vector by_by_h_squared = kept[i].by_by_h_squared;
        const vector near_chosen_3 = kept[i].near_chosen_3;
        const vector by_log_det = kept[i].by_log_det;
        const vector by_t_over_sinh_t_2 = kept[i].by_t_over_sinh_t_2;
        const vector total_8 = kept[i].total_8;
        const vector by_part1 = kept[i].by_part1;
        const vector by_scale_ratio = kept[i].by_scale_ratio;
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector_mask its_near = h_squared < 0.11468;
        const vector by_log_det_near_2 = vector_select(its_near, by_log_det, vector_of(0.0));
        const vector by_log_det_series_slope = by_log_det_series * near_chosen_3;
        const vector log_det_series_slope_slope = vector_polynomial_log_det_series_slope_slope(near_chosen_2);
        const vector by_t_over_sinh_t_near_slope = by_t_over_sinh_t_near * near_chosen_3;
        const vector t_over_sinh_t_near_slope_slope =
            vector_polynomial_t_over_sinh_t_near_slope_slope(near_chosen_2);
        const vector by_t_over_sinh_t_near_2 = vector_select(its_near, by_t_over_sinh_t_2, vector_of(0.0));
        const vector by_log_det_series_2 = by_log_det_near * by_by_h_squared + h_squared * by_log_det_near_2;
        const vector near_chosen_4 = vector_select(its_near, by_log_det_series_slope * log_det_series_slope_slope
            + by_t_over_sinh_t_near_slope * t_over_sinh_t_near_slope_slope + t_over_sinh_t_near_slope *
            by_t_over_sinh_t_near_2 + log_det_series_slope * by_log_det_series_2, vector_of(0.0));
        const vector by_h_squared_2 = total_8 + log_det_series * by_log_det_near_2 + 8.719916288803628 *
            near_chosen_4;
        const vector product_9 = 2.0 * by_h_squared_2;
        const vector by_part0_2 = product_3 * by_by_part0 + part0 * product_9;
        const vector ratio_6 = 2.0 * (scale * by_scale_ratio) / product_4;
        const vector by_part1_2 = product_3 * by_by_part1 + part1 * product_9;
        const vector by_scale_3 = by_part0 * x0_bar - by_scale_ratio * product_5 + by_part1 * x1_bar + d1 *
            by_part1_2 + d0 * by_part0_2;
        const vector by_sqrt_value = by_scale_ratio * sqrt_value_ratio - scale * (by_scale_3 / sqrt_value);
        kept[i].by_part0_2 = by_part0_2;
        kept[i].ratio_6 = ratio_6;
        kept[i].by_part1_2 = by_part1_2;
        kept[i].by_sqrt_value = by_sqrt_value;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector product = kept[i].product;
        const vector product_4 = kept[i].product_4;
        const vector ratio_3 = kept[i].ratio_3;
        const vector ratio_6 = kept[i].ratio_6;
        const vector by_sqrt_value = kept[i].by_sqrt_value;
        const vector_mask is_small_2 = product == 0.0;
        const vector ratio_7 = (vector_select(is_small_2, vector_of(0.0), 2.0 * (ratio_6 * ratio_3)) + 2.0 *
            by_sqrt_value) / product_4;
        kept[i].ratio_7 = ratio_7;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 5 * (size_t)near[i];
        const vector *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector d0 = kept[i].d0;
        const vector product = kept[i].product;
        const vector scale = kept[i].scale;
        const vector d1_product = kept[i].d1_product;
        const vector total_2 = kept[i].total_2;
        const vector scale_2 = kept[i].scale_2;
        const vector v0 = kept[i].v0;
        const vector v1 = kept[i].v1;
        const vector phi_product = kept[i].phi_product;
        const vector phi_product_2 = kept[i].phi_product_2;
        const vector by_part0 = kept[i].by_part0;
        const vector sqrt_value_ratio = kept[i].sqrt_value_ratio;
        const vector by_by_scale_2 = kept[i].by_by_scale_2;
        const vector phi_product_3 = kept[i].phi_product_3;
        const vector product_7 = kept[i].product_7;
        const vector phi_product_4 = kept[i].phi_product_4;
        const vector by_log_det = kept[i].by_log_det;
        const vector by_v1 = kept[i].by_v1;
        const vector by_v0 = kept[i].by_v0;
        const vector by_part0_2 = kept[i].by_part0_2;
        const vector by_part1 = kept[i].by_part1;
        const vector ratio_6 = kept[i].ratio_6;
        const vector by_part1_2 = kept[i].by_part1_2;
        const vector ratio_7 = kept[i].ratio_7;
        const vector x1 = X[1];
        const double mu1 = S[1];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector_mask is_small_2 = product == 0.0;
        const vector scale_2_product = scale_2 * phi_product;
        const vector by_up = scale_2 * by_v1 - phi_product * by_by_scale_2;
        const vector gap_5 = scale_2 * by_v0 - phi_product_2 * by_by_scale_2;
        const vector by_log_det_product = 0.5 * by_log_det;
        const vector gap_6 = phi_product_3 - v0 * by_log_det_product;
        const vector gap_7 = phi_product_4 - v1 * by_log_det_product;
        sums[0] = sums[0] + by_part0 * sqrt_value_ratio + scale_2_product * x0_bar - d0 * by_up - mu1 * gap_5 -
                scale * by_part0_2;
        sums[1] = sums[1] + vector_select(is_small_2, vector_of(0.0), -ratio_6) * x1_bar - (scale_2 *
                phi_product_2) * x0_bar + d1_product * by_up - scale_2_product * product_7 + d0 * gap_5 - 0.5 *
                (total_2 * by_up - scale_2_product * x1_bar) + by_part1 * sqrt_value_ratio - scale * by_part1_2 + x1 *
                vector_select(is_small_2, vector_of(0.0), ratio_7);
        sums[2] = sums[2] + by_log_det;
        sums[3] = sums[3] + v0 * gap_6;
        sums[4] = sums[4] + v0 * gap_7 + v1 * gap_6;
        sums[5] = sums[5] + v1 * gap_7;
    }
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp(
    const vector *mu, const vector *W, const vector *amplitude, const vector *sums, vector *mu_bar, vector *W_bar, vector *amplitude_bar) {
    (void)mu;
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
    const vector product = 2.0 * sum3;
    const vector product_2 = 2.0 * sum5;
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = its_amplitude * sum1;
    W_bar[0] = its_amplitude * (W0_0 * product + W0_1 * sum4);
    W_bar[1] = its_amplitude * (W0_0 * sum4 + W0_1 * product_2);
    W_bar[2] = its_amplitude * (W1_0 * product + W1_1 * sum4);
    W_bar[3] = its_amplitude * (W1_0 * sum4 + W1_1 * product_2);
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

/* Scratch memory: 5 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t half_space_splats_work(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES - 1) / LANES, blocks = (points + 2 - 1) / 2;
    const size_t places = 0 * ((splat_count + LANES - 1) / LANES + (blocks + LANES - 1) / LANES);
    return (points * 5 + places + 1) * LANES + 10 * splat_count;
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
    return work_points(work) + (count + LANES - 1) / LANES * 5;
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
    vector own_mu[2], own_W[4], own_amplitude[1], S[10];
    vector_rows(mu, splat_count, start, 2, own_mu);
    vector_rows(W, splat_count, start, 4, own_W);
    vector_rows(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants(own_mu, own_W, own_amplitude, S);
    vector_to_rows(S, constants, splat_count, start, 10, 10);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void half_space_splats(
    size_t count, size_t splat_count, const double *HALF_SPACE_RESTRICT x, const double *HALF_SPACE_RESTRICT mu, const double *HALF_SPACE_RESTRICT W, const double *HALF_SPACE_RESTRICT amplitude, const double *HALF_SPACE_RESTRICT width,
    double *HALF_SPACE_RESTRICT value, double *HALF_SPACE_RESTRICT gradient, double *HALF_SPACE_RESTRICT work, int threads) {
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
            vector at[2][2], X[2 * 2], grad[2];
            vector value_sum[2] = {ZERO}, slope_sum[2 * 2] = {ZERO};
            double place[2 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 2, at[b]);
                pair_features(at[b], X + 2 * b);
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
                pair_gradient(at[b], slope_sum + 2 * b, grad);
                vector_to_rows(value_sum + b, value, count, start + b * LANES, 1, 1);
                vector_to_rows(grad, gradient, count, start + b * LANES, 2, 2);
            }
        }
        restore_denormals(mode);
    }
}

void half_space_splats_value(
    size_t count, size_t splat_count, const double *HALF_SPACE_RESTRICT x, const double *HALF_SPACE_RESTRICT mu, const double *HALF_SPACE_RESTRICT W, const double *HALF_SPACE_RESTRICT amplitude, const double *HALF_SPACE_RESTRICT width,
    double *HALF_SPACE_RESTRICT value, double *HALF_SPACE_RESTRICT work, int threads) {
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
            vector at[2], X[2 * 2], value_sum[2] = {ZERO};
            double place[2 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 2, at);
                pair_features(at, X + 2 * b);
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
    vector at[2], grad_bar[2], slope_bar[2];
    vector_rows(x, count, start, 2, at);
    vector_rows(gradient_bar, count, start, 2, grad_bar);
    vector_rows(value_bar, count, start, 1, point + 2);
    pair_features(at, point);
    pair_gradient_vjp(at, grad_bar, slope_bar);
    for (int i = 0; i < 2; ++i) point[2 + 1 + i] = slope_bar[i];
    vector_end(count, start, 2 + 1, point + 2);
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums(const vector *points, const uint32_t *near, size_t size, const double *S, double *sums) {
    vector sum[6] = {ZERO};
    for (size_t b = 0; b < size; b += 16)
        pair_backward(size - b < 16 ? size - b : 16, points, near + b, S, sum);
    sums[0] += vector_sum(sum[0]);
    sums[1] += vector_sum(sum[1]);
    sums[2] += vector_sum(sum[2]);
    sums[3] += vector_sum(sum[3]);
    sums[4] += vector_sum(sum[4]);
    sums[5] += vector_sum(sum[5]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void half_space_splats_vjp(
    size_t count, size_t splat_count, const double *HALF_SPACE_RESTRICT x, const double *HALF_SPACE_RESTRICT mu, const double *HALF_SPACE_RESTRICT W, const double *HALF_SPACE_RESTRICT amplitude, const double *HALF_SPACE_RESTRICT width, const double *HALF_SPACE_RESTRICT value_bar, const double *HALF_SPACE_RESTRICT gradient_bar,
    double *HALF_SPACE_RESTRICT mu_bar, double *HALF_SPACE_RESTRICT W_bar, double *HALF_SPACE_RESTRICT amplitude_bar, double *HALF_SPACE_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES - 1) / LANES;
    const size_t chunk = 131072 / (5 * sizeof(vector)) + 1;
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
            splat_points(count, block * LANES, x, value_bar, gradient_bar, points + 5 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            double sums[LANES][6] = {{0}};
            uint32_t near[131072 / (5 * sizeof(vector)) + 2];
            vector own_mu[2], own_W[4], own_amplitude[1], own_sums[6], bars[7];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const double *reach = width ? splat_at(splats, k) + 2 * LANES : NULL;
                    const size_t some = blocks_near(mu + 2 * k, reach, places, first, first + size, near);
                    splat_sums(points + 5 * first, near, some, constants + 10 * k, sums[k - start]);
                }
            }
            vector_rows(mu, end, start, 2, own_mu);
            vector_rows(W, end, start, 4, own_W);
            vector_rows(amplitude, end, start, 1, own_amplitude);
            vector_rows(sums[0], LANES, 0, 6, own_sums);
            pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 2, bars + 2 + 4);
            vector_to_rows(bars, mu_bar, end, start, 2, 2);
            vector_to_rows(bars + 2, W_bar, end, start, 4, 4);
            vector_to_rows(bars + 2 + 4, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void half_space_splats_rows(
    size_t count, size_t splat_count, const double *HALF_SPACE_RESTRICT x, const double *HALF_SPACE_RESTRICT mu, const double *HALF_SPACE_RESTRICT W, const double *HALF_SPACE_RESTRICT amplitude, const double *HALF_SPACE_RESTRICT value_bar, const double *HALF_SPACE_RESTRICT gradient_bar,
    double *HALF_SPACE_RESTRICT rows, double *HALF_SPACE_RESTRICT work, int threads) {
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
            vector point[5];
            splat_points(count, block * LANES, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector own_mu[2], own_W[4], own_amplitude[1], own_sums[6] = {ZERO}, bars[7];
                for (int i = 0; i < 2; ++i) own_mu[i] = vector_of(mu[2 * k + i]);
                for (int i = 0; i < 4; ++i) own_W[i] = vector_of(W[4 * k + i]);
                own_amplitude[0] = vector_of(amplitude[k]);
                pair_backward(1, point, &only, constants + 10 * k, own_sums);
                pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 2, bars + 2 + 4);
                vector_to_rows(bars, rows + 7 * k, count, block * LANES, 7, 7 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

double half_space_splats_order(
    size_t count, size_t splat_count, const double *HALF_SPACE_RESTRICT x, const double *HALF_SPACE_RESTRICT mu, const double *HALF_SPACE_RESTRICT amplitude, const double *HALF_SPACE_RESTRICT width,
    double limit, size_t *HALF_SPACE_RESTRICT order, double *HALF_SPACE_RESTRICT work) {
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

/* sqrt of every lane; one instruction where the machine has it. */
INLINE vector_f sqrt_each_f(vector_f x) {
    EACH_LANE for (size_t i = 0; i < LANES_f; ++i) LANE(x, i) = sqrtf(LANE(x, i));
    return x;
}

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

/* asinh, within 3 units in the last place. */
INLINE vector_f asinh_each_f(vector_f x) {
    const vector_f a = abs_each_f(x), square = a * a;
    const vector_f near = log1p_each_f(a + square / (1 + sqrt_each_f(1 + square)));
    return signed_each_f(vector_select_f(a > 4096.0f, log_each_f(a) + 0.6931471805599453f, near), x);
}

/* Of degree 4, within 2^-27 of that of double precision. */
INLINE vector_f vector_polynomial_log_det_series_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return -0.6666666638087865f + x * 0.0356780778355629f + x2 * (-0.0026337661088458894f + x *
        0.00021836388307107678f) + x4 * -1.5968919256418406e-05f;
}

/* Of degree 5, within 2^-31 of that of double precision. */
INLINE vector_f vector_polynomial_t_over_sinh_t_near_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return 0.9999999997286599f + x * -0.07645331361267481f + x2 * (0.007013901478354614f + x *
        -0.0006884546368422935f) + x4 * (6.82593903267903e-05f + x * -5.404340432232951e-06f);
}

/* Of degree 5, within 2^-28 of that of double precision. */
INLINE vector_f vector_polynomial_t_over_sinh_t_near_slope_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return -0.07645333313994869f + x * 0.014028255151191082f + x2 * (-0.0020682414340485013f + x *
        0.0002804038651811389f) + x4 * (-3.5177113288273015e-05f + x * 3.25255213826865e-06f);
}

/* Of degree 5, within 2^-29 of that of double precision. */
INLINE vector_f vector_polynomial_log_det_series_slope_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return 0.03567822217846793f + x * -0.005269875733339704f + x2 * (0.0006651726191066225f + x *
        -7.996311053059585e-05f) + x4 * (9.132650110662127e-06f + x * -7.919515332371028e-07f);
}

/* Of degree 6, within 2^-31 of that of double precision. */
INLINE vector_f vector_polynomial_log_det_series_slope_slope_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return -0.0052698789147766385f + x * 0.0013304204633056561f + x2 * (-0.00024038029119705448f + x *
        3.783386377263302e-05f) + x4 * (-5.498485307465418e-06f + x * 7.242797860685044e-07f + x2 *
        -6.694691049633411e-08f);
}

/* Of degree 6, within 2^-30 of that of double precision. */
INLINE vector_f vector_polynomial_t_over_sinh_t_near_slope_slope_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return 0.014028269221378524f + x * -0.004136815832245224f + x2 * (0.0008433872999278661f + x *
        -0.00014649483800952389f) + x4 * (2.3118113730214914e-05f + x * -3.253385053618904e-06f + x2 *
        3.1461159265860754e-07f);
}

/* What pairs read of points x. */
OUTLINE void pair_features_f(
    const vector_f *x, vector_f *X) {
    const vector_f x0 = x[0];
    const vector_f x1 = x[1];
    X[0] = x0;
    X[1] = x1;
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
    S[7] = M0_0;
    S[8] = M0_1;
    S[9] = M1_1;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_value_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values) {
    struct { vector_f d0, sqrt_value, scale, d1, h_squared, h, asinh_h, sqrt_1_plus_h_to_2, t_ratio, log_det,
            scale_2, phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 2 * b;
            const vector_f x1 = X[1];
            const vector_f sqrt_value = 2.0f * sqrt_each_f(x1 * mu1);
            kept[k][b].sqrt_value = sqrt_value;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f sqrt_value = kept[k][b].sqrt_value;
            const vector_f scale = 1.0f / sqrt_value;
            kept[k][b].scale = scale;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 2 * b;
            const vector_f scale = kept[k][b].scale;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f d0 = x0 - mu0;
            const vector_f part0 = d0 * scale;
            const vector_f d1 = x1 - mu1;
            const vector_f part1 = d1 * scale;
            const vector_f h_squared = part0 * part0 + part1 * part1;
            const vector_mask_f its_near = h_squared < 0.11468f;
            const vector_f h = sqrt_each_f(vector_select_f(its_near, vector_of_f(1.0f), h_squared));
            kept[k][b].d0 = d0;
            kept[k][b].d1 = d1;
            kept[k][b].h_squared = h_squared;
            kept[k][b].h = h;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f h_squared = kept[k][b].h_squared;
            const vector_f h = kept[k][b].h;
            const vector_f asinh_h = asinh_each_f(h);
            const vector_f sqrt_1_plus_h_to_2 = sqrt_each_f(1.0f + h_squared);
            kept[k][b].asinh_h = asinh_h;
            kept[k][b].sqrt_1_plus_h_to_2 = sqrt_1_plus_h_to_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f h = kept[k][b].h;
            const vector_f asinh_h = kept[k][b].asinh_h;
            const vector_f sqrt_1_plus_h_to_2 = kept[k][b].sqrt_1_plus_h_to_2;
            const vector_f t = 2.0f * asinh_h;
            const vector_f sinh_t = sqrt_1_plus_h_to_2 * (2.0f * h);
            const vector_f t_ratio = t / sinh_t;
            kept[k][b].t_ratio = t_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 2 * b;
            const vector_f h_squared = kept[k][b].h_squared;
            const vector_f t_ratio = kept[k][b].t_ratio;
            const vector_f x1 = X[1];
            const vector_mask_f its_near = h_squared < 0.11468f;
            const vector_f near_chosen = vector_select_f(its_near, 8.719916288803628f * h_squared, vector_of_f(0.0f));
            const vector_f log_det_series = vector_polynomial_log_det_series_f(near_chosen);
            const vector_f log_det_near = h_squared * log_det_series;
            const vector_f log_det = vector_select_f(its_near, log_det_near, log_each_f(t_ratio));
            const vector_f t_over_sinh_t_near = vector_polynomial_t_over_sinh_t_near_f(near_chosen);
            const vector_f t_over_sinh_t = vector_select_f(its_near, t_over_sinh_t_near, t_ratio);
            const vector_f scale_2 = t_over_sinh_t / x1;
            kept[k][b].log_det = log_det;
            kept[k][b].scale_2 = scale_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float mu1 = S[1];
        const float W0_0 = S[2];
        const float W0_1 = S[3];
        const float W1_0 = S[4];
        const float W1_1 = S[5];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 2 * b;
            const vector_f d0 = kept[k][b].d0;
            const vector_f d1 = kept[k][b].d1;
            const vector_f log_det = kept[k][b].log_det;
            const vector_f scale_2 = kept[k][b].scale_2;
            const vector_f x1 = X[1];
            const vector_f v0 = scale_2 * (mu1 * d0);
            const vector_f dot_ds_ds = d0 * d0;
            const vector_f up = 0.5f * dot_ds_ds + 0.5f * d1 * (x1 + mu1);
            const vector_f v1 = up * scale_2;
            const vector_f z0 = W0_0 * v0 + W0_1 * v1;
            const vector_f z1 = W1_0 * v0 + W1_1 * v1;
            const vector_f phi = exp_each_f(log_det - 0.5f * (z0 * z0 + z1 * z1));
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
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
    struct { vector_f d0, product, length, sqrt_value, scale, part0, d1, part1, h_squared, near_chosen,
            log_det_series, near_chosen_2, h, asinh_h, h_squared_total, sqrt_1_plus_h_to_2, h_product, sinh_t,
            t_ratio, log_det, scale_2, d0_product, d1_product, total_2, up, z0, z1, phi, phi_2, phi_product,
            phi_product_2, by_t_over_sinh_t, by_t, chosen, by_h, by_h_squared, by_part0, by_part1, minus; }
            kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 2 * b;
            const vector_f x1 = X[1];
            const vector_f product = x1 * mu1;
            const vector_f length = sqrt_each_f(product);
            kept[k][b].product = product;
            kept[k][b].length = length;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f length = kept[k][b].length;
            const vector_f sqrt_value = 2.0f * length;
            const vector_f scale = 1.0f / sqrt_value;
            kept[k][b].sqrt_value = sqrt_value;
            kept[k][b].scale = scale;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 2 * b;
            const vector_f scale = kept[k][b].scale;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f d0 = x0 - mu0;
            const vector_f part0 = d0 * scale;
            const vector_f d1 = x1 - mu1;
            const vector_f part1 = d1 * scale;
            const vector_f h_squared = part0 * part0 + part1 * part1;
            const vector_mask_f its_near = h_squared < 0.11468f;
            const vector_f near_chosen_2 = vector_select_f(its_near, vector_of_f(1.0f), h_squared);
            const vector_f h = sqrt_each_f(near_chosen_2);
            kept[k][b].d0 = d0;
            kept[k][b].part0 = part0;
            kept[k][b].d1 = d1;
            kept[k][b].part1 = part1;
            kept[k][b].h_squared = h_squared;
            kept[k][b].near_chosen_2 = near_chosen_2;
            kept[k][b].h = h;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f h_squared = kept[k][b].h_squared;
            const vector_f h = kept[k][b].h;
            const vector_f asinh_h = asinh_each_f(h);
            const vector_f h_squared_total = 1.0f + h_squared;
            const vector_f sqrt_1_plus_h_to_2 = sqrt_each_f(h_squared_total);
            kept[k][b].asinh_h = asinh_h;
            kept[k][b].h_squared_total = h_squared_total;
            kept[k][b].sqrt_1_plus_h_to_2 = sqrt_1_plus_h_to_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f h = kept[k][b].h;
            const vector_f asinh_h = kept[k][b].asinh_h;
            const vector_f sqrt_1_plus_h_to_2 = kept[k][b].sqrt_1_plus_h_to_2;
            const vector_f t = 2.0f * asinh_h;
            const vector_f h_product = 2.0f * h;
            const vector_f sinh_t = sqrt_1_plus_h_to_2 * h_product;
            const vector_f t_ratio = t / sinh_t;
            kept[k][b].h_product = h_product;
            kept[k][b].sinh_t = sinh_t;
            kept[k][b].t_ratio = t_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 2 * b;
            const vector_f h_squared = kept[k][b].h_squared;
            const vector_f t_ratio = kept[k][b].t_ratio;
            const vector_f x1 = X[1];
            const vector_mask_f its_near = h_squared < 0.11468f;
            const vector_f near_chosen = vector_select_f(its_near, 8.719916288803628f * h_squared, vector_of_f(0.0f));
            const vector_f log_det_series = vector_polynomial_log_det_series_f(near_chosen);
            const vector_f log_det_near = h_squared * log_det_series;
            const vector_f log_det = vector_select_f(its_near, log_det_near, log_each_f(t_ratio));
            const vector_f t_over_sinh_t_near = vector_polynomial_t_over_sinh_t_near_f(near_chosen);
            const vector_f t_over_sinh_t = vector_select_f(its_near, t_over_sinh_t_near, t_ratio);
            const vector_f scale_2 = t_over_sinh_t / x1;
            kept[k][b].near_chosen = near_chosen;
            kept[k][b].log_det_series = log_det_series;
            kept[k][b].log_det = log_det;
            kept[k][b].scale_2 = scale_2;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float mu1 = S[1];
        const float W0_0 = S[2];
        const float W0_1 = S[3];
        const float W1_0 = S[4];
        const float W1_1 = S[5];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 2 * b;
            const vector_f d0 = kept[k][b].d0;
            const vector_f d1 = kept[k][b].d1;
            const vector_f log_det = kept[k][b].log_det;
            const vector_f scale_2 = kept[k][b].scale_2;
            const vector_f x1 = X[1];
            const vector_f d0_product = mu1 * d0;
            const vector_f v0 = scale_2 * d0_product;
            const vector_f dot_ds_ds = d0 * d0;
            const vector_f d1_product = 0.5f * d1;
            const vector_f total_2 = x1 + mu1;
            const vector_f up = 0.5f * dot_ds_ds + d1_product * total_2;
            const vector_f v1 = up * scale_2;
            const vector_f z0 = W0_0 * v0 + W0_1 * v1;
            const vector_f z1 = W1_0 * v0 + W1_1 * v1;
            const vector_f phi = exp_each_f(log_det - 0.5f * (z0 * z0 + z1 * z1));
            kept[k][b].d0_product = d0_product;
            kept[k][b].d1_product = d1_product;
            kept[k][b].total_2 = total_2;
            kept[k][b].up = up;
            kept[k][b].z0 = z0;
            kept[k][b].z1 = z1;
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float W0_0 = S[2];
        const float W0_1 = S[3];
        const float W1_0 = S[4];
        const float W1_1 = S[5];
        const float amplitude = S[6];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 2 * b;
            const vector_f d0_product = kept[k][b].d0_product;
            const vector_f up = kept[k][b].up;
            const vector_f z0 = kept[k][b].z0;
            const vector_f z1 = kept[k][b].z1;
            const vector_f phi = kept[k][b].phi;
            const vector_f x1 = X[1];
            const vector_f phi_2 = amplitude * phi;
            const vector_f phi_product = phi_2 * (W1_1 * z1 + W0_1 * z0);
            const vector_f phi_product_2 = phi_2 * (W1_0 * z1 + W0_0 * z0);
            const vector_f by_scale_2 = -(up * phi_product) - d0_product * phi_product_2;
            const vector_f by_t_over_sinh_t = by_scale_2 / x1;
            kept[k][b].phi_2 = phi_2;
            kept[k][b].phi_product = phi_product;
            kept[k][b].phi_product_2 = phi_product_2;
            kept[k][b].by_t_over_sinh_t = by_t_over_sinh_t;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f h_squared = kept[k][b].h_squared;
            const vector_f sinh_t = kept[k][b].sinh_t;
            const vector_f t_ratio = kept[k][b].t_ratio;
            const vector_f phi_2 = kept[k][b].phi_2;
            const vector_f by_t_over_sinh_t = kept[k][b].by_t_over_sinh_t;
            const vector_mask_f its_near = h_squared < 0.11468f;
            const vector_f by_t = (vector_select_f(its_near, vector_of_f(0.0f), by_t_over_sinh_t) +
                vector_select_f(its_near, vector_of_f(0.0f), phi_2) / t_ratio) / sinh_t;
            kept[k][b].by_t = by_t;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f near_chosen_2 = kept[k][b].near_chosen_2;
            const vector_f h_squared_total = kept[k][b].h_squared_total;
            const vector_f sqrt_1_plus_h_to_2 = kept[k][b].sqrt_1_plus_h_to_2;
            const vector_f h_product = kept[k][b].h_product;
            const vector_f t_ratio = kept[k][b].t_ratio;
            const vector_f by_t = kept[k][b].by_t;
            const vector_mask_f is_small = h_squared_total == 0.0f;
            const vector_f by_t_product = t_ratio * by_t;
            const vector_f chosen = vector_select_f(is_small, vector_of_f(0.0f), -(h_product * by_t_product / (2.0f *
                vector_select_f(is_small, vector_of_f(1.0f), sqrt_1_plus_h_to_2))));
            const vector_f by_asinh_h = 2.0f * by_t;
            const vector_f by_h = by_asinh_h / sqrt_each_f(1.0f + near_chosen_2) - 2.0f * (sqrt_1_plus_h_to_2 *
                by_t_product);
            kept[k][b].chosen = chosen;
            kept[k][b].by_h = by_h;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f h_squared = kept[k][b].h_squared;
            const vector_f near_chosen = kept[k][b].near_chosen;
            const vector_f log_det_series = kept[k][b].log_det_series;
            const vector_f h_product = kept[k][b].h_product;
            const vector_f phi_2 = kept[k][b].phi_2;
            const vector_f by_t_over_sinh_t = kept[k][b].by_t_over_sinh_t;
            const vector_f chosen = kept[k][b].chosen;
            const vector_f by_h = kept[k][b].by_h;
            const vector_mask_f its_near = h_squared < 0.11468f;
            const vector_f by_log_det_near = vector_select_f(its_near, phi_2, vector_of_f(0.0f));
            const vector_f by_t_over_sinh_t_near = vector_select_f(its_near, by_t_over_sinh_t, vector_of_f(0.0f));
            const vector_f t_over_sinh_t_near_slope = vector_polynomial_t_over_sinh_t_near_slope_f(near_chosen);
            const vector_f by_log_det_series = h_squared * by_log_det_near;
            const vector_f log_det_series_slope = vector_polynomial_log_det_series_slope_f(near_chosen);
            const vector_f by_h_squared = chosen + vector_select_f(its_near, vector_of_f(0.0f), by_h / h_product) +
                log_det_series * by_log_det_near + 8.719916288803628f * vector_select_f(its_near,
                by_t_over_sinh_t_near * t_over_sinh_t_near_slope + by_log_det_series * log_det_series_slope,
                vector_of_f(0.0f));
            kept[k][b].by_h_squared = by_h_squared;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f d0 = kept[k][b].d0;
            const vector_f product = kept[k][b].product;
            const vector_f length = kept[k][b].length;
            const vector_f sqrt_value = kept[k][b].sqrt_value;
            const vector_f scale = kept[k][b].scale;
            const vector_f part0 = kept[k][b].part0;
            const vector_f d1 = kept[k][b].d1;
            const vector_f part1 = kept[k][b].part1;
            const vector_f by_h_squared = kept[k][b].by_h_squared;
            const vector_f product_2 = 2.0f * by_h_squared;
            const vector_f by_part0 = part0 * product_2;
            const vector_f by_part1 = part1 * product_2;
            const vector_mask_f is_small_2 = product == 0.0f;
            const vector_f by_scale = d1 * by_part1 + d0 * by_part0;
            const vector_f minus = -(2.0f * (scale * (by_scale / sqrt_value)) / (2.0f * vector_select_f(is_small_2,
                vector_of_f(1.0f), length)));
            kept[k][b].by_part0 = by_part0;
            kept[k][b].by_part1 = by_part1;
            kept[k][b].minus = minus;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 10 * near[k];
        const float mu1 = S[1];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            vector_f *slope = slopes + 2 * b;
            const vector_f d0 = kept[k][b].d0;
            const vector_f product = kept[k][b].product;
            const vector_f scale = kept[k][b].scale;
            const vector_f scale_2 = kept[k][b].scale_2;
            const vector_f d1_product = kept[k][b].d1_product;
            const vector_f total_2 = kept[k][b].total_2;
            const vector_f phi_2 = kept[k][b].phi_2;
            const vector_f phi_product = kept[k][b].phi_product;
            const vector_f phi_product_2 = kept[k][b].phi_product_2;
            const vector_f by_t_over_sinh_t = kept[k][b].by_t_over_sinh_t;
            const vector_f by_part0 = kept[k][b].by_part0;
            const vector_f by_part1 = kept[k][b].by_part1;
            const vector_f minus = kept[k][b].minus;
            const vector_f scale_2_product = scale_2 * phi_product;
            const vector_mask_f is_small_2 = product == 0.0f;
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] - d0 * scale_2_product - mu1 * (scale_2 * phi_product_2) + scale * by_part0;
            slope[1] = slope[1] - d1_product * scale_2_product - scale_2 * by_t_over_sinh_t + scale * by_part1 - 0.5f
                    * (total_2 * scale_2_product) + mu1 * vector_select_f(is_small_2, vector_of_f(0.0f), minus);
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient_f(
    const vector_f *x, const vector_f *slope, vector_f *gradient) {
    const vector_f x1 = x[1];
    const vector_f slope_x0 = slope[0];
    const vector_f slope_x1 = slope[1];
    const vector_f squared = x1 * x1;
    gradient[0] = slope_x0 * squared;
    gradient[1] = slope_x1 * squared;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp_f(
    const vector_f *x, const vector_f *gradient_bar, vector_f *slope_bar) {
    const vector_f x1 = x[1];
    const vector_f gradient_bar0 = gradient_bar[0];
    const vector_f gradient_bar1 = gradient_bar[1];
    const vector_f squared = x1 * x1;
    slope_bar[0] = squared * gradient_bar0;
    slope_bar[1] = squared * gradient_bar1;
}

/*
 * Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_backward_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *sums) {
    struct { vector_f d0, product, length, sqrt_value, scale, part0, d1, part1, h_squared, h_squared_total,
            near_chosen, h, h_product, asinh_h, sqrt_1_plus_h_to_2, sinh_t, t_ratio, d1_product, total_2, up,
            near_chosen_2, log_det_series, log_det, scale_2, d0_product, v0, v1, z0, z1, phi, total_3,
            phi_product, total_4, phi_product_2, by_t_over_sinh_t, ratio, by_t, by_t_product, product_2, ratio_2,
            sqrt_2, by_asinh_h_ratio, by_h_ratio, by_log_det_near, by_t_over_sinh_t_near,
            t_over_sinh_t_near_slope, by_log_det_series, log_det_series_slope, product_3, by_part0, product_4,
            ratio_3, product_5, sqrt_value_ratio, by_by_part0, by_by_part1, total_5, by_by_h_squared, by_by_h,
            by_by_asinh_h, by_by_h_product, ratio_4, gap, by_by_t_ratio, near_chosen_3, by_by_scale_2,
            phi_product_3, product_7, phi_product_4, ratio_5, by_by_log_det_series, by_log_det, by_v1, by_v0,
            by_t_over_sinh_t_2, by_t_2, by_sinh_t, by_h_2, total_8, by_part0_2, by_part1, by_scale_ratio, ratio_6,
            by_part1_2, by_sqrt_value, ratio_7; } kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 5 * (size_t)near[i];
        const vector_f x1 = X[1];
        const float mu1 = S[1];
        const vector_f product = x1 * mu1;
        const vector_f length = sqrt_each_f(product);
        kept[i].product = product;
        kept[i].length = length;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f length = kept[i].length;
        const vector_f sqrt_value = 2.0f * length;
        const vector_f scale = 1.0f / sqrt_value;
        kept[i].sqrt_value = sqrt_value;
        kept[i].scale = scale;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 5 * (size_t)near[i];
        const vector_f scale = kept[i].scale;
        const vector_f x0 = X[0];
        const vector_f x1 = X[1];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const vector_f d0 = x0 - mu0;
        const vector_f part0 = d0 * scale;
        const vector_f d1 = x1 - mu1;
        const vector_f part1 = d1 * scale;
        const vector_f h_squared = part0 * part0 + part1 * part1;
        const vector_mask_f its_near = h_squared < 0.11468f;
        const vector_f near_chosen = vector_select_f(its_near, vector_of_f(1.0f), h_squared);
        const vector_f h = sqrt_each_f(near_chosen);
        kept[i].d0 = d0;
        kept[i].part0 = part0;
        kept[i].d1 = d1;
        kept[i].part1 = part1;
        kept[i].h_squared = h_squared;
        kept[i].near_chosen = near_chosen;
        kept[i].h = h;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector_f product = kept[i].product;
        const vector_f length = kept[i].length;
        const vector_f h_squared = kept[i].h_squared;
        const vector_f h = kept[i].h;
        const float mu1 = S[1];
        const vector_f x1_bar = slope_bar[1];
        const vector_f h_squared_total = 1.0f + h_squared;
        const vector_f asinh_h = asinh_each_f(h);
        const vector_f sqrt_1_plus_h_to_2 = sqrt_each_f(h_squared_total);
        const vector_mask_f is_small_2 = product == 0.0f;
        const vector_f product_4 = 2.0f * vector_select_f(is_small_2, vector_of_f(1.0f), length);
        const vector_f ratio_3 = vector_select_f(is_small_2, vector_of_f(0.0f), mu1 * x1_bar) / product_4;
        kept[i].h_squared_total = h_squared_total;
        kept[i].asinh_h = asinh_h;
        kept[i].sqrt_1_plus_h_to_2 = sqrt_1_plus_h_to_2;
        kept[i].product_4 = product_4;
        kept[i].ratio_3 = ratio_3;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f sqrt_value = kept[i].sqrt_value;
        const vector_f scale = kept[i].scale;
        const vector_f h = kept[i].h;
        const vector_f asinh_h = kept[i].asinh_h;
        const vector_f sqrt_1_plus_h_to_2 = kept[i].sqrt_1_plus_h_to_2;
        const vector_f ratio_3 = kept[i].ratio_3;
        const vector_f h_product = 2.0f * h;
        const vector_f t = 2.0f * asinh_h;
        const vector_f sinh_t = sqrt_1_plus_h_to_2 * h_product;
        const vector_f t_ratio = t / sinh_t;
        const vector_f product_5 = 2.0f * ratio_3;
        const vector_f sqrt_value_ratio = scale * product_5 / sqrt_value;
        kept[i].h_product = h_product;
        kept[i].sinh_t = sinh_t;
        kept[i].t_ratio = t_ratio;
        kept[i].product_5 = product_5;
        kept[i].sqrt_value_ratio = sqrt_value_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 5 * (size_t)near[i];
        const vector_f *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector_f d0 = kept[i].d0;
        const vector_f scale = kept[i].scale;
        const vector_f part0 = kept[i].part0;
        const vector_f d1 = kept[i].d1;
        const vector_f part1 = kept[i].part1;
        const vector_f h_squared = kept[i].h_squared;
        const vector_f near_chosen = kept[i].near_chosen;
        const vector_f h_product = kept[i].h_product;
        const vector_f t_ratio = kept[i].t_ratio;
        const vector_f sqrt_value_ratio = kept[i].sqrt_value_ratio;
        const vector_f x1 = X[1];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_mask_f its_near = h_squared < 0.11468f;
        const vector_f near_chosen_2 = vector_select_f(its_near, 8.719916288803628f * h_squared,
            vector_of_f(0.0f));
        const vector_f log_det_series = vector_polynomial_log_det_series_f(near_chosen_2);
        const vector_f log_det_near = h_squared * log_det_series;
        const vector_f log_det = vector_select_f(its_near, log_det_near, log_each_f(t_ratio));
        const vector_f t_over_sinh_t_near = vector_polynomial_t_over_sinh_t_near_f(near_chosen_2);
        const vector_f t_over_sinh_t = vector_select_f(its_near, t_over_sinh_t_near, t_ratio);
        const vector_f scale_2 = t_over_sinh_t / x1;
        const vector_f sqrt_2 = sqrt_each_f(1.0f + near_chosen);
        const vector_f by_by_part0 = scale * x0_bar - d0 * sqrt_value_ratio;
        const vector_f by_by_part1 = scale * x1_bar - d1 * sqrt_value_ratio;
        const vector_f total_5 = part0 * by_by_part0 + part1 * by_by_part1;
        const vector_f by_by_h_squared = 2.0f * total_5;
        const vector_f by_by_h = vector_select_f(its_near, vector_of_f(0.0f), by_by_h_squared) / h_product;
        kept[i].near_chosen_2 = near_chosen_2;
        kept[i].log_det_series = log_det_series;
        kept[i].log_det = log_det;
        kept[i].scale_2 = scale_2;
        kept[i].sqrt_2 = sqrt_2;
        kept[i].by_by_part0 = by_by_part0;
        kept[i].by_by_part1 = by_by_part1;
        kept[i].total_5 = total_5;
        kept[i].by_by_h_squared = by_by_h_squared;
        kept[i].by_by_h = by_by_h;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 5 * (size_t)near[i];
        const vector_f d0 = kept[i].d0;
        const vector_f d1 = kept[i].d1;
        const vector_f h_squared_total = kept[i].h_squared_total;
        const vector_f sqrt_1_plus_h_to_2 = kept[i].sqrt_1_plus_h_to_2;
        const vector_f log_det = kept[i].log_det;
        const vector_f scale_2 = kept[i].scale_2;
        const vector_f sqrt_2 = kept[i].sqrt_2;
        const vector_f by_by_h_squared = kept[i].by_by_h_squared;
        const vector_f by_by_h = kept[i].by_by_h;
        const vector_f x1 = X[1];
        const float mu1 = S[1];
        const float W0_0 = S[2];
        const float W0_1 = S[3];
        const float W1_0 = S[4];
        const float W1_1 = S[5];
        const vector_mask_f is_small = h_squared_total == 0.0f;
        const vector_f dot_ds_ds = d0 * d0;
        const vector_f d1_product = 0.5f * d1;
        const vector_f total_2 = x1 + mu1;
        const vector_f up = 0.5f * dot_ds_ds + d1_product * total_2;
        const vector_f d0_product = mu1 * d0;
        const vector_f v0 = scale_2 * d0_product;
        const vector_f v1 = up * scale_2;
        const vector_f z0 = W0_0 * v0 + W0_1 * v1;
        const vector_f z1 = W1_0 * v0 + W1_1 * v1;
        const vector_f phi = exp_each_f(log_det - 0.5f * (z0 * z0 + z1 * z1));
        const vector_f product_2 = 2.0f * vector_select_f(is_small, vector_of_f(1.0f), sqrt_1_plus_h_to_2);
        const vector_f by_by_asinh_h = by_by_h / sqrt_2;
        const vector_f ratio_4 = vector_select_f(is_small, vector_of_f(0.0f), by_by_h_squared) / product_2;
        kept[i].d1_product = d1_product;
        kept[i].total_2 = total_2;
        kept[i].up = up;
        kept[i].d0_product = d0_product;
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].z0 = z0;
        kept[i].z1 = z1;
        kept[i].phi = phi;
        kept[i].product_2 = product_2;
        kept[i].by_by_asinh_h = by_by_asinh_h;
        kept[i].ratio_4 = ratio_4;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 5 * (size_t)near[i];
        const vector_f h_squared = kept[i].h_squared;
        const vector_f h_product = kept[i].h_product;
        const vector_f sqrt_1_plus_h_to_2 = kept[i].sqrt_1_plus_h_to_2;
        const vector_f sinh_t = kept[i].sinh_t;
        const vector_f t_ratio = kept[i].t_ratio;
        const vector_f up = kept[i].up;
        const vector_f d0_product = kept[i].d0_product;
        const vector_f z0 = kept[i].z0;
        const vector_f z1 = kept[i].z1;
        const vector_f phi = kept[i].phi;
        const vector_f by_by_h = kept[i].by_by_h;
        const vector_f by_by_asinh_h = kept[i].by_by_asinh_h;
        const vector_f ratio_4 = kept[i].ratio_4;
        const vector_f x1 = X[1];
        const float W0_0 = S[2];
        const float W0_1 = S[3];
        const float W1_0 = S[4];
        const float W1_1 = S[5];
        const vector_mask_f its_near = h_squared < 0.11468f;
        const vector_f total_3 = W1_1 * z1 + W0_1 * z0;
        const vector_f phi_product = phi * total_3;
        const vector_f total_4 = W1_0 * z1 + W0_0 * z0;
        const vector_f phi_product_2 = phi * total_4;
        const vector_f by_scale_2 = -(up * phi_product) - d0_product * phi_product_2;
        const vector_f by_t_over_sinh_t = by_scale_2 / x1;
        const vector_f ratio = vector_select_f(its_near, vector_of_f(0.0f), phi) / t_ratio;
        const vector_f by_by_h_product = 2.0f * by_by_h;
        const vector_f gap = -(sqrt_1_plus_h_to_2 * by_by_h_product) - h_product * ratio_4;
        const vector_f by_by_t = 2.0f * by_by_asinh_h + t_ratio * gap;
        const vector_f by_by_t_ratio = by_by_t / sinh_t;
        kept[i].total_3 = total_3;
        kept[i].phi_product = phi_product;
        kept[i].total_4 = total_4;
        kept[i].phi_product_2 = phi_product_2;
        kept[i].by_t_over_sinh_t = by_t_over_sinh_t;
        kept[i].ratio = ratio;
        kept[i].by_by_h_product = by_by_h_product;
        kept[i].gap = gap;
        kept[i].by_by_t_ratio = by_by_t_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 5 * (size_t)near[i];
        const vector_f *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector_f h_squared = kept[i].h_squared;
        const vector_f sinh_t = kept[i].sinh_t;
        const vector_f t_ratio = kept[i].t_ratio;
        const vector_f near_chosen_2 = kept[i].near_chosen_2;
        const vector_f scale_2 = kept[i].scale_2;
        const vector_f by_t_over_sinh_t = kept[i].by_t_over_sinh_t;
        const vector_f ratio = kept[i].ratio;
        const vector_f total_5 = kept[i].total_5;
        const vector_f by_by_t_ratio = kept[i].by_by_t_ratio;
        const vector_f x1 = X[1];
        const vector_f x1_bar = slope_bar[1];
        const vector_mask_f its_near = h_squared < 0.11468f;
        const vector_f by_t = (vector_select_f(its_near, vector_of_f(0.0f), by_t_over_sinh_t) + ratio) / sinh_t;
        const vector_f t_over_sinh_t_near_slope = vector_polynomial_t_over_sinh_t_near_slope_f(near_chosen_2);
        const vector_f near_chosen_3 = vector_select_f(its_near, 17.439832577607255f * total_5,
            vector_of_f(0.0f));
        const vector_f by_by_t_over_sinh_t_near = t_over_sinh_t_near_slope * near_chosen_3;
        const vector_f by_by_t_over_sinh_t = vector_select_f(its_near, vector_of_f(0.0f), by_by_t_ratio) +
            vector_select_f(its_near, by_by_t_over_sinh_t_near, vector_of_f(0.0f)) - scale_2 * x1_bar;
        const vector_f by_by_scale_2 = by_by_t_over_sinh_t / x1;
        const vector_f ratio_5 = by_by_t_ratio / t_ratio;
        kept[i].by_t = by_t;
        kept[i].t_over_sinh_t_near_slope = t_over_sinh_t_near_slope;
        kept[i].near_chosen_3 = near_chosen_3;
        kept[i].by_by_scale_2 = by_by_scale_2;
        kept[i].ratio_5 = ratio_5;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 5 * (size_t)near[i];
        const vector_f *value_bar = points + 5 * (size_t)near[i] + 2;
        const vector_f *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector_f d0 = kept[i].d0;
        const vector_f h_squared = kept[i].h_squared;
        const vector_f d1_product = kept[i].d1_product;
        const vector_f total_2 = kept[i].total_2;
        const vector_f up = kept[i].up;
        const vector_f near_chosen_2 = kept[i].near_chosen_2;
        const vector_f log_det_series = kept[i].log_det_series;
        const vector_f scale_2 = kept[i].scale_2;
        const vector_f d0_product = kept[i].d0_product;
        const vector_f phi = kept[i].phi;
        const vector_f total_3 = kept[i].total_3;
        const vector_f phi_product = kept[i].phi_product;
        const vector_f total_4 = kept[i].total_4;
        const vector_f phi_product_2 = kept[i].phi_product_2;
        const vector_f by_t_over_sinh_t = kept[i].by_t_over_sinh_t;
        const vector_f by_t = kept[i].by_t;
        const vector_f sqrt_2 = kept[i].sqrt_2;
        const vector_f by_by_h_squared = kept[i].by_by_h_squared;
        const vector_f near_chosen_3 = kept[i].near_chosen_3;
        const vector_f by_by_scale_2 = kept[i].by_by_scale_2;
        const vector_f ratio_5 = kept[i].ratio_5;
        const vector_f x1 = X[1];
        const float mu1 = S[1];
        const float M0_0 = S[7];
        const float M0_1 = S[8];
        const float M1_1 = S[9];
        const vector_f its_value_bar = value_bar[0];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_mask_f its_near = h_squared < 0.11468f;
        const vector_f by_asinh_h = 2.0f * by_t;
        const vector_f by_asinh_h_ratio = by_asinh_h / sqrt_2;
        const vector_f log_det_series_slope = vector_polynomial_log_det_series_slope_f(near_chosen_2);
        const vector_f product_6 = mu1 * x0_bar;
        const vector_f gap_2 = -(scale_2 * product_6) - d0_product * by_by_scale_2;
        const vector_f phi_product_3 = phi * gap_2;
        const vector_f product_7 = 0.5f * x1_bar;
        const vector_f gap_3 = -(d0 * x0_bar) - d1_product * x1_bar - total_2 * product_7;
        const vector_f gap_4 = scale_2 * gap_3 - up * by_by_scale_2;
        const vector_f phi_product_4 = phi * gap_4;
        const vector_f by_by_log_det_series = log_det_series_slope * near_chosen_3;
        const vector_f by_by_log_det_near = h_squared * by_by_log_det_series + log_det_series * by_by_h_squared;
        const vector_f by_phi = its_value_bar + vector_select_f(its_near, vector_of_f(0.0f), ratio_5) +
            vector_select_f(its_near, by_by_log_det_near, vector_of_f(0.0f)) + total_3 * gap_4 + total_4 * gap_2;
        const vector_f by_log_det = phi * by_phi;
        const vector_f by_v1 = M0_1 * phi_product_3 + M1_1 * phi_product_4 - total_3 * by_log_det;
        const vector_f by_v0 = M0_0 * phi_product_3 + M0_1 * phi_product_4 - total_4 * by_log_det;
        const vector_f total_7 = -(by_t_over_sinh_t * x1_bar) - phi_product_2 * product_6 + phi_product * gap_3 +
            up * by_v1;
        const vector_f by_scale_2_2 = total_7 + d0_product * by_v0;
        const vector_f by_t_over_sinh_t_2 = by_scale_2_2 / x1;
        kept[i].by_asinh_h_ratio = by_asinh_h_ratio;
        kept[i].log_det_series_slope = log_det_series_slope;
        kept[i].phi_product_3 = phi_product_3;
        kept[i].product_7 = product_7;
        kept[i].phi_product_4 = phi_product_4;
        kept[i].by_by_log_det_series = by_by_log_det_series;
        kept[i].by_log_det = by_log_det;
        kept[i].by_v1 = by_v1;
        kept[i].by_v0 = by_v0;
        kept[i].by_t_over_sinh_t_2 = by_t_over_sinh_t_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f h_squared = kept[i].h_squared;
        const vector_f h_product = kept[i].h_product;
        const vector_f sqrt_1_plus_h_to_2 = kept[i].sqrt_1_plus_h_to_2;
        const vector_f sinh_t = kept[i].sinh_t;
        const vector_f t_ratio = kept[i].t_ratio;
        const vector_f ratio = kept[i].ratio;
        const vector_f by_t = kept[i].by_t;
        const vector_f by_asinh_h_ratio = kept[i].by_asinh_h_ratio;
        const vector_f gap = kept[i].gap;
        const vector_f ratio_5 = kept[i].ratio_5;
        const vector_f by_log_det = kept[i].by_log_det;
        const vector_f by_t_over_sinh_t_2 = kept[i].by_t_over_sinh_t_2;
        const vector_mask_f its_near = h_squared < 0.11468f;
        const vector_f by_t_product = t_ratio * by_t;
        const vector_f by_h = by_asinh_h_ratio - 2.0f * (sqrt_1_plus_h_to_2 * by_t_product);
        const vector_f by_h_ratio = by_h / h_product;
        const vector_f by_t_2 = (by_t * gap - ratio * ratio_5 + vector_select_f(its_near, vector_of_f(0.0f),
            by_t_over_sinh_t_2) + vector_select_f(its_near, vector_of_f(0.0f), by_log_det) / t_ratio) / sinh_t;
        kept[i].by_t_product = by_t_product;
        kept[i].by_h_ratio = by_h_ratio;
        kept[i].by_t_2 = by_t_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f h_product = kept[i].h_product;
        const vector_f sqrt_1_plus_h_to_2 = kept[i].sqrt_1_plus_h_to_2;
        const vector_f t_ratio = kept[i].t_ratio;
        const vector_f by_t = kept[i].by_t;
        const vector_f by_t_product = kept[i].by_t_product;
        const vector_f product_2 = kept[i].product_2;
        const vector_f sqrt_2 = kept[i].sqrt_2;
        const vector_f by_h_ratio = kept[i].by_h_ratio;
        const vector_f by_by_h = kept[i].by_by_h;
        const vector_f ratio_4 = kept[i].ratio_4;
        const vector_f by_by_t_ratio = kept[i].by_by_t_ratio;
        const vector_f by_t_2 = kept[i].by_t_2;
        const vector_f ratio_2 = h_product * by_t_product / product_2;
        const vector_f by_sinh_t = -(by_t * by_by_t_ratio) - t_ratio * by_t_2;
        const vector_f product_8 = 2.0f * (-(by_h_ratio * by_by_h) - by_t_product * ratio_4 + sqrt_1_plus_h_to_2 *
            by_sinh_t);
        const vector_f by_asinh_h_2 = 2.0f * by_t_2;
        const vector_f by_h_2 = product_8 + by_asinh_h_2 / sqrt_2;
        kept[i].ratio_2 = ratio_2;
        kept[i].by_sinh_t = by_sinh_t;
        kept[i].by_h_2 = by_h_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f d0 = kept[i].d0;
        const vector_f sqrt_value = kept[i].sqrt_value;
        const vector_f part0 = kept[i].part0;
        const vector_f d1 = kept[i].d1;
        const vector_f part1 = kept[i].part1;
        const vector_f h_squared = kept[i].h_squared;
        const vector_f h_squared_total = kept[i].h_squared_total;
        const vector_f h_product = kept[i].h_product;
        const vector_f log_det_series = kept[i].log_det_series;
        const vector_f phi = kept[i].phi;
        const vector_f by_t_over_sinh_t = kept[i].by_t_over_sinh_t;
        const vector_f by_t_product = kept[i].by_t_product;
        const vector_f product_2 = kept[i].product_2;
        const vector_f ratio_2 = kept[i].ratio_2;
        const vector_f sqrt_2 = kept[i].sqrt_2;
        const vector_f by_asinh_h_ratio = kept[i].by_asinh_h_ratio;
        const vector_f by_h_ratio = kept[i].by_h_ratio;
        const vector_f t_over_sinh_t_near_slope = kept[i].t_over_sinh_t_near_slope;
        const vector_f log_det_series_slope = kept[i].log_det_series_slope;
        const vector_f by_by_asinh_h = kept[i].by_by_asinh_h;
        const vector_f by_by_h_product = kept[i].by_by_h_product;
        const vector_f ratio_4 = kept[i].ratio_4;
        const vector_f by_by_log_det_series = kept[i].by_by_log_det_series;
        const vector_f by_sinh_t = kept[i].by_sinh_t;
        const vector_f by_h_2 = kept[i].by_h_2;
        const vector_mask_f is_small = h_squared_total == 0.0f;
        const vector_mask_f its_near = h_squared < 0.11468f;
        const vector_f by_log_det_near = vector_select_f(its_near, phi, vector_of_f(0.0f));
        const vector_f by_t_over_sinh_t_near = vector_select_f(its_near, by_t_over_sinh_t, vector_of_f(0.0f));
        const vector_f by_log_det_series = h_squared * by_log_det_near;
        const vector_f by_h_squared = vector_select_f(is_small, vector_of_f(0.0f), -ratio_2) +
            vector_select_f(its_near, vector_of_f(0.0f), by_h_ratio) + log_det_series * by_log_det_near +
            8.719916288803628f * vector_select_f(its_near, by_t_over_sinh_t_near * t_over_sinh_t_near_slope +
            by_log_det_series * log_det_series_slope, vector_of_f(0.0f));
        const vector_f product_3 = 2.0f * by_h_squared;
        const vector_f by_part0 = part0 * product_3;
        const vector_f by_sqrt_1_plus_h_to_2 = vector_select_f(is_small, vector_of_f(0.0f), 2.0f * (ratio_2 *
            ratio_4)) - by_t_product * by_by_h_product + h_product * by_sinh_t;
        const vector_f total_8 = by_log_det_near * by_by_log_det_series + vector_select_f(is_small,
            vector_of_f(0.0f), by_sqrt_1_plus_h_to_2 / product_2) + vector_select_f(its_near, vector_of_f(0.0f),
            by_h_2 / h_product - by_asinh_h_ratio * by_by_asinh_h / (2.0f * sqrt_2));
        const vector_f by_part1 = part1 * product_3;
        const vector_f by_scale = d1 * by_part1 + d0 * by_part0;
        const vector_f by_scale_ratio = by_scale / sqrt_value;
        kept[i].by_log_det_near = by_log_det_near;
        kept[i].by_t_over_sinh_t_near = by_t_over_sinh_t_near;
        kept[i].by_log_det_series = by_log_det_series;
        kept[i].product_3 = product_3;
        kept[i].by_part0 = by_part0;
        kept[i].total_8 = total_8;
        kept[i].by_part1 = by_part1;
        kept[i].by_scale_ratio = by_scale_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector_f d0 = kept[i].d0;
        const vector_f sqrt_value = kept[i].sqrt_value;
        const vector_f scale = kept[i].scale;
        const vector_f part0 = kept[i].part0;
        const vector_f d1 = kept[i].d1;
        const vector_f part1 = kept[i].part1;
        const vector_f h_squared = kept[i].h_squared;
        const vector_f near_chosen_2 = kept[i].near_chosen_2;
        const vector_f log_det_series = kept[i].log_det_series;
        const vector_f by_log_det_near = kept[i].by_log_det_near;
        const vector_f by_t_over_sinh_t_near = kept[i].by_t_over_sinh_t_near;
        const vector_f t_over_sinh_t_near_slope = kept[i].t_over_sinh_t_near_slope;
        const vector_f by_log_det_series = kept[i].by_log_det_series;
        const vector_f log_det_series_slope = kept[i].log_det_series_slope;
        const vector_f product_3 = kept[i].product_3;
        const vector_f by_part0 = kept[i].by_part0;
        const vector_f product_4 = kept[i].product_4;
        const vector_f product_5 = kept[i].product_5;
        const vector_f sqrt_value_ratio = kept[i].sqrt_value_ratio;
        const vector_f by_by_part0 = kept[i].by_by_part0;
        const vector_f by_by_part1 = kept[i].by_by_part1;
        const vector_f by_by_h_squared = kept[i].by_by_h_squared;
        const vector_f near_chosen_3 = kept[i].near_chosen_3;
        const vector_f by_log_det = kept[i].by_log_det;
        const vector_f by_t_over_sinh_t_2 = kept[i].by_t_over_sinh_t_2;
        const vector_f total_8 = kept[i].total_8;
        const vector_f by_part1 = kept[i].by_part1;
        const vector_f by_scale_ratio = kept[i].by_scale_ratio;
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_mask_f its_near = h_squared < 0.11468f;
        const vector_f by_log_det_near_2 = vector_select_f(its_near, by_log_det, vector_of_f(0.0f));
        const vector_f by_log_det_series_slope = by_log_det_series * near_chosen_3;
        const vector_f log_det_series_slope_slope = vector_polynomial_log_det_series_slope_slope_f(near_chosen_2);
        const vector_f by_t_over_sinh_t_near_slope = by_t_over_sinh_t_near * near_chosen_3;
        const vector_f t_over_sinh_t_near_slope_slope =
            vector_polynomial_t_over_sinh_t_near_slope_slope_f(near_chosen_2);
        const vector_f by_t_over_sinh_t_near_2 = vector_select_f(its_near, by_t_over_sinh_t_2, vector_of_f(0.0f));
        const vector_f by_log_det_series_2 = by_log_det_near * by_by_h_squared + h_squared * by_log_det_near_2;
        const vector_f near_chosen_4 = vector_select_f(its_near, by_log_det_series_slope *
            log_det_series_slope_slope + by_t_over_sinh_t_near_slope * t_over_sinh_t_near_slope_slope +
            t_over_sinh_t_near_slope * by_t_over_sinh_t_near_2 + log_det_series_slope * by_log_det_series_2,
            vector_of_f(0.0f));
        const vector_f by_h_squared_2 = total_8 + log_det_series * by_log_det_near_2 + 8.719916288803628f *
            near_chosen_4;
        const vector_f product_9 = 2.0f * by_h_squared_2;
        const vector_f by_part0_2 = product_3 * by_by_part0 + part0 * product_9;
        const vector_f ratio_6 = 2.0f * (scale * by_scale_ratio) / product_4;
        const vector_f by_part1_2 = product_3 * by_by_part1 + part1 * product_9;
        const vector_f by_scale_3 = by_part0 * x0_bar - by_scale_ratio * product_5 + by_part1 * x1_bar + d1 *
            by_part1_2 + d0 * by_part0_2;
        const vector_f by_sqrt_value = by_scale_ratio * sqrt_value_ratio - scale * (by_scale_3 / sqrt_value);
        kept[i].by_part0_2 = by_part0_2;
        kept[i].ratio_6 = ratio_6;
        kept[i].by_part1_2 = by_part1_2;
        kept[i].by_sqrt_value = by_sqrt_value;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f product = kept[i].product;
        const vector_f product_4 = kept[i].product_4;
        const vector_f ratio_3 = kept[i].ratio_3;
        const vector_f ratio_6 = kept[i].ratio_6;
        const vector_f by_sqrt_value = kept[i].by_sqrt_value;
        const vector_mask_f is_small_2 = product == 0.0f;
        const vector_f ratio_7 = (vector_select_f(is_small_2, vector_of_f(0.0f), 2.0f * (ratio_6 * ratio_3)) +
            2.0f * by_sqrt_value) / product_4;
        kept[i].ratio_7 = ratio_7;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 5 * (size_t)near[i];
        const vector_f *slope_bar = points + 5 * (size_t)near[i] + 2 + 1;
        const vector_f d0 = kept[i].d0;
        const vector_f product = kept[i].product;
        const vector_f scale = kept[i].scale;
        const vector_f d1_product = kept[i].d1_product;
        const vector_f total_2 = kept[i].total_2;
        const vector_f scale_2 = kept[i].scale_2;
        const vector_f v0 = kept[i].v0;
        const vector_f v1 = kept[i].v1;
        const vector_f phi_product = kept[i].phi_product;
        const vector_f phi_product_2 = kept[i].phi_product_2;
        const vector_f by_part0 = kept[i].by_part0;
        const vector_f sqrt_value_ratio = kept[i].sqrt_value_ratio;
        const vector_f by_by_scale_2 = kept[i].by_by_scale_2;
        const vector_f phi_product_3 = kept[i].phi_product_3;
        const vector_f product_7 = kept[i].product_7;
        const vector_f phi_product_4 = kept[i].phi_product_4;
        const vector_f by_log_det = kept[i].by_log_det;
        const vector_f by_v1 = kept[i].by_v1;
        const vector_f by_v0 = kept[i].by_v0;
        const vector_f by_part0_2 = kept[i].by_part0_2;
        const vector_f by_part1 = kept[i].by_part1;
        const vector_f ratio_6 = kept[i].ratio_6;
        const vector_f by_part1_2 = kept[i].by_part1_2;
        const vector_f ratio_7 = kept[i].ratio_7;
        const vector_f x1 = X[1];
        const float mu1 = S[1];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_mask_f is_small_2 = product == 0.0f;
        const vector_f scale_2_product = scale_2 * phi_product;
        const vector_f by_up = scale_2 * by_v1 - phi_product * by_by_scale_2;
        const vector_f gap_5 = scale_2 * by_v0 - phi_product_2 * by_by_scale_2;
        const vector_f by_log_det_product = 0.5f * by_log_det;
        const vector_f gap_6 = phi_product_3 - v0 * by_log_det_product;
        const vector_f gap_7 = phi_product_4 - v1 * by_log_det_product;
        sums[0] = sums[0] + by_part0 * sqrt_value_ratio + scale_2_product * x0_bar - d0 * by_up - mu1 * gap_5 -
                scale * by_part0_2;
        sums[1] = sums[1] + vector_select_f(is_small_2, vector_of_f(0.0f), -ratio_6) * x1_bar - (scale_2 *
                phi_product_2) * x0_bar + d1_product * by_up - scale_2_product * product_7 + d0 * gap_5 - 0.5f *
                (total_2 * by_up - scale_2_product * x1_bar) + by_part1 * sqrt_value_ratio - scale * by_part1_2 + x1 *
                vector_select_f(is_small_2, vector_of_f(0.0f), ratio_7);
        sums[2] = sums[2] + by_log_det;
        sums[3] = sums[3] + v0 * gap_6;
        sums[4] = sums[4] + v0 * gap_7 + v1 * gap_6;
        sums[5] = sums[5] + v1 * gap_7;
    }
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, const vector_f *sums, vector_f *mu_bar, vector_f *W_bar, vector_f *amplitude_bar) {
    (void)mu;
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
    const vector_f product = 2.0f * sum3;
    const vector_f product_2 = 2.0f * sum5;
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = its_amplitude * sum1;
    W_bar[0] = its_amplitude * (W0_0 * product + W0_1 * sum4);
    W_bar[1] = its_amplitude * (W0_0 * sum4 + W0_1 * product_2);
    W_bar[2] = its_amplitude * (W1_0 * product + W1_1 * sum4);
    W_bar[3] = its_amplitude * (W1_0 * sum4 + W1_1 * product_2);
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

/* Scratch memory: 5 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t half_space_splats_work_f(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES_f - 1) / LANES_f, blocks = (points + 2 - 1) / 2;
    const size_t places = 0 * ((splat_count + LANES_f - 1) / LANES_f + (blocks + LANES_f - 1) / LANES_f);
    return (points * 5 + places + 1) * LANES_f + 10 * splat_count;
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
    return work_points_f(work) + (count + LANES_f - 1) / LANES_f * 5;
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
    vector_f own_mu[2], own_W[4], own_amplitude[1], S[10];
    vector_rows_f(mu, splat_count, start, 2, own_mu);
    vector_rows_f(W, splat_count, start, 4, own_W);
    vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants_f(own_mu, own_W, own_amplitude, S);
    vector_to_rows_f(S, constants, splat_count, start, 10, 10);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void half_space_splats_f(
    size_t count, size_t splat_count, const float *HALF_SPACE_RESTRICT x, const float *HALF_SPACE_RESTRICT mu, const float *HALF_SPACE_RESTRICT W, const float *HALF_SPACE_RESTRICT amplitude, const float *HALF_SPACE_RESTRICT width,
    float *HALF_SPACE_RESTRICT value, float *HALF_SPACE_RESTRICT gradient, float *HALF_SPACE_RESTRICT work, int threads) {
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
            vector_f at[2][2], X[2 * 2], grad[2];
            vector_f value_sum[2] = {ZERO}, slope_sum[2 * 2] = {ZERO};
            float place[2 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 2, at[b]);
                pair_features_f(at[b], X + 2 * b);
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
                pair_gradient_f(at[b], slope_sum + 2 * b, grad);
                vector_to_rows_f(value_sum + b, value, count, start + b * LANES_f, 1, 1);
                vector_to_rows_f(grad, gradient, count, start + b * LANES_f, 2, 2);
            }
        }
        restore_denormals(mode);
    }
}

void half_space_splats_value_f(
    size_t count, size_t splat_count, const float *HALF_SPACE_RESTRICT x, const float *HALF_SPACE_RESTRICT mu, const float *HALF_SPACE_RESTRICT W, const float *HALF_SPACE_RESTRICT amplitude, const float *HALF_SPACE_RESTRICT width,
    float *HALF_SPACE_RESTRICT value, float *HALF_SPACE_RESTRICT work, int threads) {
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
            vector_f at[2], X[2 * 2], value_sum[2] = {ZERO};
            float place[2 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 2, at);
                pair_features_f(at, X + 2 * b);
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
    vector_f at[2], grad_bar[2], slope_bar[2];
    vector_rows_f(x, count, start, 2, at);
    vector_rows_f(gradient_bar, count, start, 2, grad_bar);
    vector_rows_f(value_bar, count, start, 1, point + 2);
    pair_features_f(at, point);
    pair_gradient_vjp_f(at, grad_bar, slope_bar);
    for (int i = 0; i < 2; ++i) point[2 + 1 + i] = slope_bar[i];
    vector_end_f(count, start, 2 + 1, point + 2);
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums_f(const vector_f *points, const uint32_t *near, size_t size, const float *S, float *sums) {
    vector_f sum[6] = {ZERO};
    for (size_t b = 0; b < size; b += 16)
        pair_backward_f(size - b < 16 ? size - b : 16, points, near + b, S, sum);
    sums[0] += vector_sum_f(sum[0]);
    sums[1] += vector_sum_f(sum[1]);
    sums[2] += vector_sum_f(sum[2]);
    sums[3] += vector_sum_f(sum[3]);
    sums[4] += vector_sum_f(sum[4]);
    sums[5] += vector_sum_f(sum[5]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void half_space_splats_vjp_f(
    size_t count, size_t splat_count, const float *HALF_SPACE_RESTRICT x, const float *HALF_SPACE_RESTRICT mu, const float *HALF_SPACE_RESTRICT W, const float *HALF_SPACE_RESTRICT amplitude, const float *HALF_SPACE_RESTRICT width, const float *HALF_SPACE_RESTRICT value_bar, const float *HALF_SPACE_RESTRICT gradient_bar,
    float *HALF_SPACE_RESTRICT mu_bar, float *HALF_SPACE_RESTRICT W_bar, float *HALF_SPACE_RESTRICT amplitude_bar, float *HALF_SPACE_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES_f - 1) / LANES_f;
    const size_t chunk = 131072 / (5 * sizeof(vector_f)) + 1;
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
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, points + 5 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            float sums[LANES_f][6] = {{0}};
            uint32_t near[131072 / (5 * sizeof(vector_f)) + 2];
            vector_f own_mu[2], own_W[4], own_amplitude[1], own_sums[6], bars[7];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const float *reach = width ? splat_at_f(splats, k) + 2 * LANES_f : NULL;
                    const size_t some = blocks_near_f(mu + 2 * k, reach, places, first, first + size, near);
                    splat_sums_f(points + 5 * first, near, some, constants + 10 * k, sums[k - start]);
                }
            }
            vector_rows_f(mu, end, start, 2, own_mu);
            vector_rows_f(W, end, start, 4, own_W);
            vector_rows_f(amplitude, end, start, 1, own_amplitude);
            vector_rows_f(sums[0], LANES_f, 0, 6, own_sums);
            pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 2, bars + 2 + 4);
            vector_to_rows_f(bars, mu_bar, end, start, 2, 2);
            vector_to_rows_f(bars + 2, W_bar, end, start, 4, 4);
            vector_to_rows_f(bars + 2 + 4, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void half_space_splats_rows_f(
    size_t count, size_t splat_count, const float *HALF_SPACE_RESTRICT x, const float *HALF_SPACE_RESTRICT mu, const float *HALF_SPACE_RESTRICT W, const float *HALF_SPACE_RESTRICT amplitude, const float *HALF_SPACE_RESTRICT value_bar, const float *HALF_SPACE_RESTRICT gradient_bar,
    float *HALF_SPACE_RESTRICT rows, float *HALF_SPACE_RESTRICT work, int threads) {
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
            vector_f point[5];
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector_f own_mu[2], own_W[4], own_amplitude[1], own_sums[6] = {ZERO}, bars[7];
                for (int i = 0; i < 2; ++i) own_mu[i] = vector_of_f(mu[2 * k + i]);
                for (int i = 0; i < 4; ++i) own_W[i] = vector_of_f(W[4 * k + i]);
                own_amplitude[0] = vector_of_f(amplitude[k]);
                pair_backward_f(1, point, &only, constants + 10 * k, own_sums);
                pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 2, bars + 2 + 4);
                vector_to_rows_f(bars, rows + 7 * k, count, block * LANES_f, 7, 7 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

double half_space_splats_order_f(
    size_t count, size_t splat_count, const float *HALF_SPACE_RESTRICT x, const float *HALF_SPACE_RESTRICT mu, const float *HALF_SPACE_RESTRICT amplitude, const float *HALF_SPACE_RESTRICT width,
    double limit, size_t *HALF_SPACE_RESTRICT order, float *HALF_SPACE_RESTRICT work) {
    (void)x, (void)mu, (void)amplitude, (void)width, (void)limit, (void)work;
    (void)splat_count;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    return 1;
}

#endif /* float */
