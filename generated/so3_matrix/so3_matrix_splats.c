/*
 * so3_matrix: Rotations of R^3 as 3 x 3 matrices; distances are rotation angles in radians.
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "so3_matrix.h"

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

/* Of degree 13 on [0, 1], its relative error below 2^-56. */
INLINE vector vector_polynomial_log_det_series(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.3333333333333333 + x * 0.030468411111111815 + x2 * (0.004186774461502485 + x *
        0.0006822355998616309) + x4 * (0.0001221617222686508 + x * 2.3226222426586787e-05 + x2 *
        (4.602679660683086e-06 + x * 9.419944287901338e-07)) + x8 * (1.9330673844597264e-07 + x *
        4.732354384237477e-08 + x2 * (3.0572329018458638e-09 + x * 6.43891495522262e-09) + x4 *
        (-1.6163842503256483e-09 + x * 5.84780397346594e-10));
}

/* Of degree 13 on [0, 1], its relative error below 2^-56. */
INLINE vector vector_polynomial_t_over_norm_s_near(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 2.0 + x * 0.08309566666666784 + x2 * (0.009321601255279904 + x * 0.0013831869136529075) + x4 *
        (0.00023466269139487824 + x * 4.307622244387224e-05 + x2 * (8.328318196009972e-06 + x *
        1.6734198264338605e-06)) + x8 * (3.3892571731146964e-07 + x * 8.160810786979752e-08 + x2 *
        (5.559604423994873e-09 + x * 1.0797473542320039e-08) + x4 * (-2.6805393136717492e-09 + x *
        9.765079763039615e-10));
}

/* Of degree 12 on [0, 1], the derivative of a polynomial. */
INLINE vector vector_polynomial_t_over_norm_s_near_slope(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.08309566666666784 + x * 0.018643202510559807 + x2 * (0.004149560740958722 + x *
        0.0009386507655795129) + x4 * (0.0002153811122193612 + x * 4.996990917605983e-05 + x2 *
        (1.1713938785037024e-05 + x * 2.711405738491757e-06)) + x8 * (7.344729708281776e-07 + x *
        5.559604423994873e-08 + x2 * (1.1877220896552043e-07 + x * -3.2166471764060994e-08) + x4 *
        1.2694603691951498e-08);
}

/* Of degree 12 on [0, 1], the derivative of a polynomial. */
INLINE vector vector_polynomial_log_det_series_slope(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.030468411111111815 + x * 0.00837354892300497 + x2 * (0.002046706799584893 + x *
        0.0004886468890746032) + x4 * (0.00011613111213293394 + x * 2.7616077964098513e-05 + x2 *
        (6.5939610015309365e-06 + x * 1.5464539075677811e-06)) + x8 * (4.2591189458137294e-07 + x *
        3.057232901845864e-08 + x2 * (7.082806450744882e-08 + x * -1.939661100390778e-08) + x4 *
        7.602145165505722e-09);
}

/* Of degree 11 on [0, 1], the derivative of a polynomial. */
INLINE vector vector_polynomial_log_det_series_slope_slope(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.00837354892300497 + x * 0.004093413599169786 + x2 * (0.0014659406672238098 + x *
        0.00046452444853173575) + x4 * (0.00013808038982049257 + x * 3.956376600918562e-05 + x2 *
        (1.0825177352974468e-05 + x * 3.4072951566509835e-06)) + x8 * (2.7515096116612774e-07 + x *
        7.082806450744882e-07 + x2 * (-2.1336272104298557e-07 + x * 9.122574198606865e-08));
}

/* Of degree 11 on [0, 1], the derivative of a polynomial. */
INLINE vector vector_polynomial_t_over_norm_s_near_slope_slope(vector x) {
    const vector x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.018643202510559807 + x * 0.008299121481917445 + x2 * (0.0028159522967385387 + x *
        0.0008615244488774448) + x4 * (0.00024984954588029915 + x * 7.028363271022215e-05 + x2 *
        (1.89798401694423e-05 + x * 5.875783766625421e-06)) + x8 * (5.003643981595386e-07 + x *
        1.1877220896552042e-06 + x2 * (-3.538311894046709e-07 + x * 1.5233524430341798e-07));
}

/* What pairs read of points x. */
OUTLINE void pair_features(
    const vector *x, vector *X) {
    const vector x0 = x[0];
    const vector x1 = x[1];
    const vector x2 = x[2];
    const vector x3 = x[3];
    const vector x4 = x[4];
    const vector x5 = x[5];
    const vector x6 = x[6];
    const vector x7 = x[7];
    const vector x8 = x[8];
    X[0] = x0;
    X[1] = x1;
    X[2] = x2;
    X[3] = x3;
    X[4] = x4;
    X[5] = x5;
    X[6] = x6;
    X[7] = x7;
    X[8] = x8;
}

/* What pairs read of a splat, of some splats. */
OUTLINE void pair_constants(
    const vector *mu, const vector *W, const vector *amplitude, vector *S) {
    const vector mu0 = mu[0];
    const vector mu1 = mu[1];
    const vector mu2 = mu[2];
    const vector mu3 = mu[3];
    const vector mu4 = mu[4];
    const vector mu5 = mu[5];
    const vector mu6 = mu[6];
    const vector mu7 = mu[7];
    const vector mu8 = mu[8];
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
    const vector M0_0 = W0_0 * W0_0 + W1_0 * W1_0 + W2_0 * W2_0;
    const vector M0_1 = W0_0 * W0_1 + W1_0 * W1_1 + W2_0 * W2_1;
    const vector M0_2 = W0_0 * W0_2 + W1_0 * W1_2 + W2_0 * W2_2;
    const vector M1_1 = W0_1 * W0_1 + W1_1 * W1_1 + W2_1 * W2_1;
    const vector M1_2 = W0_1 * W0_2 + W1_1 * W1_2 + W2_1 * W2_2;
    const vector M2_2 = W0_2 * W0_2 + W1_2 * W1_2 + W2_2 * W2_2;
    S[0] = mu0;
    S[1] = mu1;
    S[2] = mu2;
    S[3] = mu3;
    S[4] = mu4;
    S[5] = mu5;
    S[6] = mu6;
    S[7] = mu7;
    S[8] = mu8;
    S[9] = W0_0;
    S[10] = W0_1;
    S[11] = W0_2;
    S[12] = W1_0;
    S[13] = W1_1;
    S[14] = W1_2;
    S[15] = W2_0;
    S[16] = W2_1;
    S[17] = W2_2;
    S[18] = its_amplitude;
    S[19] = M0_0;
    S[20] = M0_1;
    S[21] = M0_2;
    S[22] = M1_1;
    S[23] = M1_2;
    S[24] = M2_2;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_value(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values) {
    struct { vector row_10, row_11, row_12, row_9, row_length, g1, g2, g3, norm_s_squared, near_chosen,
            norm_s, g0, atan2_norm_s_abs_g0, t_ratio, log_det, phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 25 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double mu7 = S[7];
        const double mu8 = S[8];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 9 * b;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector x4 = X[4];
            const vector x5 = X[5];
            const vector x6 = X[6];
            const vector x7 = X[7];
            const vector x8 = X[8];
            const vector R2_2 = x2 * mu2 + x5 * mu5 + x8 * mu8;
            const vector R1_1 = x1 * mu1 + x4 * mu4 + x7 * mu7;
            const vector R0_0 = x0 * mu0 + x3 * mu3 + x6 * mu6;
            const vector R0_0_total = 1.0 + R0_0;
            const vector square0 = R2_2 + (R1_1 + R0_0_total);
            const vector square1 = R0_0_total - R1_1 - R2_2;
            const vector_mask is_less = square0 < square1;
            const vector largest = vector_select(is_less, square1, square0);
            const vector square2 = 1.0 + R1_1 - R0_0 - R2_2;
            const vector_mask is_less_2 = largest < square2;
            const vector largest_2 = vector_select(is_less_2, square2, largest);
            const vector square3 = 1.0 + R2_2 - R0_0 - R1_1;
            const vector_mask is_less_3 = largest_2 < square3;
            const vector R0_2 = x2 * mu0 + x5 * mu3 + x8 * mu6;
            const vector R2_0 = x0 * mu2 + x3 * mu5 + x6 * mu8;
            const vector R0_2_total = R0_2 + R2_0;
            const vector R0_1 = x1 * mu0 + x4 * mu3 + x7 * mu6;
            const vector R1_0 = x0 * mu1 + x3 * mu4 + x6 * mu7;
            const vector R0_1_total = R0_1 + R1_0;
            const vector R2_1 = x1 * mu2 + x4 * mu5 + x7 * mu8;
            const vector R1_2 = x2 * mu1 + x5 * mu4 + x8 * mu7;
            const vector R2_1_gap = R2_1 - R1_2;
            const vector row_2 = vector_select(is_less, square1, R2_1_gap);
            const vector row_6 = vector_select(is_less_2, R0_1_total, row_2);
            const vector row_10 = vector_select(is_less_3, R0_2_total, row_6);
            const vector R1_2_total = R1_2 + R2_1;
            const vector R0_2_gap = R0_2 - R2_0;
            const vector row_3 = vector_select(is_less, R0_1_total, R0_2_gap);
            const vector row_7 = vector_select(is_less_2, square2, row_3);
            const vector row_11 = vector_select(is_less_3, R1_2_total, row_7);
            const vector R1_0_gap = R1_0 - R0_1;
            const vector row_4 = vector_select(is_less, R0_2_total, R1_0_gap);
            const vector row_8 = vector_select(is_less_2, R1_2_total, row_4);
            const vector row_12 = vector_select(is_less_3, square3, row_8);
            const vector row = vector_select(is_less, R2_1_gap, square0);
            const vector row_5 = vector_select(is_less_2, R0_2_gap, row);
            const vector row_9 = vector_select(is_less_3, R1_0_gap, row_5);
            const vector row_length = sqrt_each(row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9);
            kept[k][b].row_10 = row_10;
            kept[k][b].row_11 = row_11;
            kept[k][b].row_12 = row_12;
            kept[k][b].row_9 = row_9;
            kept[k][b].row_length = row_length;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector row_10 = kept[k][b].row_10;
            const vector row_11 = kept[k][b].row_11;
            const vector row_12 = kept[k][b].row_12;
            const vector row_length = kept[k][b].row_length;
            const vector g1 = row_10 / row_length;
            const vector g2 = row_11 / row_length;
            const vector g3 = row_12 / row_length;
            kept[k][b].g1 = g1;
            kept[k][b].g2 = g2;
            kept[k][b].g3 = g3;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector row_9 = kept[k][b].row_9;
            const vector row_length = kept[k][b].row_length;
            const vector g1 = kept[k][b].g1;
            const vector g2 = kept[k][b].g2;
            const vector g3 = kept[k][b].g3;
            const vector norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
            const vector_mask its_near = norm_s_squared < 0.249287;
            const vector norm_s = sqrt_each(vector_select(its_near, vector_of(1.0), norm_s_squared));
            const vector g0 = row_9 / row_length;
            kept[k][b].norm_s_squared = norm_s_squared;
            kept[k][b].norm_s = norm_s;
            kept[k][b].g0 = g0;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector norm_s = kept[k][b].norm_s;
            const vector g0 = kept[k][b].g0;
            const vector abs_g0 = abs_each(g0);
            const vector atan2_norm_s_abs_g0 = atan2_each(norm_s, abs_g0);
            kept[k][b].atan2_norm_s_abs_g0 = atan2_norm_s_abs_g0;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector norm_s = kept[k][b].norm_s;
            const vector atan2_norm_s_abs_g0 = kept[k][b].atan2_norm_s_abs_g0;
            const vector t = 2.0 * atan2_norm_s_abs_g0;
            const vector t_ratio = t / norm_s;
            kept[k][b].t_ratio = t_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector norm_s_squared = kept[k][b].norm_s_squared;
            const vector t_ratio = kept[k][b].t_ratio;
            const vector_mask its_near = norm_s_squared < 0.249287;
            const vector near_chosen = vector_select(its_near, 4.011440628672975 * norm_s_squared, vector_of(0.0));
            const vector log_det_series = vector_polynomial_log_det_series(near_chosen);
            const vector log_det_near = norm_s_squared * log_det_series;
            const vector log_det = vector_select(its_near, log_det_near, 2.0 * log_each(0.5 * t_ratio));
            kept[k][b].near_chosen = near_chosen;
            kept[k][b].log_det = log_det;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 25 * near[k];
        const double W0_0 = S[9];
        const double W0_1 = S[10];
        const double W0_2 = S[11];
        const double W1_0 = S[12];
        const double W1_1 = S[13];
        const double W1_2 = S[14];
        const double W2_0 = S[15];
        const double W2_1 = S[16];
        const double W2_2 = S[17];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector g1 = kept[k][b].g1;
            const vector g2 = kept[k][b].g2;
            const vector g3 = kept[k][b].g3;
            const vector norm_s_squared = kept[k][b].norm_s_squared;
            const vector near_chosen = kept[k][b].near_chosen;
            const vector g0 = kept[k][b].g0;
            const vector t_ratio = kept[k][b].t_ratio;
            const vector log_det = kept[k][b].log_det;
            const vector_mask its_near = norm_s_squared < 0.249287;
            const vector t_over_norm_s_near = vector_polynomial_t_over_norm_s_near(near_chosen);
            const vector t_over_norm_s = vector_select(its_near, t_over_norm_s_near, t_ratio);
            const vector scale = t_over_norm_s * vector_select(g0 < 0.0, vector_of(-1.0), vector_of(1.0));
            const vector v0 = g1 * scale;
            const vector v1 = g2 * scale;
            const vector v2 = g3 * scale;
            const vector z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
            const vector z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
            const vector z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
            const vector log_det_gap = log_det - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
            const vector phi = exp_each(log_det_gap);
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 25 * near[k];
        const double amplitude = S[18];
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
    struct { vector square0, square1, largest, square2, largest_2, square3, row_10, row_11, row_12, row_9,
            total_2, row_length, g1, g2, g3, norm_s_squared, near_chosen, log_det_series, near_chosen_2, norm_s,
            g0, abs_g0, atan2_norm_s_abs_g0, t_ratio, product, log_det, chosen, scale, z0, z1, z2, phi, phi_2,
            phi_product, phi_product_2, phi_product_3, by_t_over_norm_s, total_3, by_t, ratio, by_g0_ratio,
            by_norm_s_squared, by_g3_ratio, by_g2_ratio, by_g1_ratio, product_3; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 25 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double mu7 = S[7];
        const double mu8 = S[8];
        for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 9 * b;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector x4 = X[4];
            const vector x5 = X[5];
            const vector x6 = X[6];
            const vector x7 = X[7];
            const vector x8 = X[8];
            const vector R2_2 = x2 * mu2 + x5 * mu5 + x8 * mu8;
            const vector R1_1 = x1 * mu1 + x4 * mu4 + x7 * mu7;
            const vector R0_0 = x0 * mu0 + x3 * mu3 + x6 * mu6;
            const vector R0_0_total = 1.0 + R0_0;
            const vector square0 = R2_2 + (R1_1 + R0_0_total);
            const vector square1 = R0_0_total - R1_1 - R2_2;
            const vector_mask is_less = square0 < square1;
            const vector largest = vector_select(is_less, square1, square0);
            const vector square2 = 1.0 + R1_1 - R0_0 - R2_2;
            const vector_mask is_less_2 = largest < square2;
            const vector largest_2 = vector_select(is_less_2, square2, largest);
            const vector square3 = 1.0 + R2_2 - R0_0 - R1_1;
            const vector_mask is_less_3 = largest_2 < square3;
            const vector R0_2 = x2 * mu0 + x5 * mu3 + x8 * mu6;
            const vector R2_0 = x0 * mu2 + x3 * mu5 + x6 * mu8;
            const vector R0_2_total = R0_2 + R2_0;
            const vector R0_1 = x1 * mu0 + x4 * mu3 + x7 * mu6;
            const vector R1_0 = x0 * mu1 + x3 * mu4 + x6 * mu7;
            const vector R0_1_total = R0_1 + R1_0;
            const vector R2_1 = x1 * mu2 + x4 * mu5 + x7 * mu8;
            const vector R1_2 = x2 * mu1 + x5 * mu4 + x8 * mu7;
            const vector R2_1_gap = R2_1 - R1_2;
            const vector row_2 = vector_select(is_less, square1, R2_1_gap);
            const vector row_6 = vector_select(is_less_2, R0_1_total, row_2);
            const vector row_10 = vector_select(is_less_3, R0_2_total, row_6);
            const vector R1_2_total = R1_2 + R2_1;
            const vector R0_2_gap = R0_2 - R2_0;
            const vector row_3 = vector_select(is_less, R0_1_total, R0_2_gap);
            const vector row_7 = vector_select(is_less_2, square2, row_3);
            const vector row_11 = vector_select(is_less_3, R1_2_total, row_7);
            const vector R1_0_gap = R1_0 - R0_1;
            const vector row_4 = vector_select(is_less, R0_2_total, R1_0_gap);
            const vector row_8 = vector_select(is_less_2, R1_2_total, row_4);
            const vector row_12 = vector_select(is_less_3, square3, row_8);
            const vector row = vector_select(is_less, R2_1_gap, square0);
            const vector row_5 = vector_select(is_less_2, R0_2_gap, row);
            const vector row_9 = vector_select(is_less_3, R1_0_gap, row_5);
            const vector total_2 = row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9;
            const vector row_length = sqrt_each(total_2);
            kept[k][b].square0 = square0;
            kept[k][b].square1 = square1;
            kept[k][b].largest = largest;
            kept[k][b].square2 = square2;
            kept[k][b].largest_2 = largest_2;
            kept[k][b].square3 = square3;
            kept[k][b].row_10 = row_10;
            kept[k][b].row_11 = row_11;
            kept[k][b].row_12 = row_12;
            kept[k][b].row_9 = row_9;
            kept[k][b].total_2 = total_2;
            kept[k][b].row_length = row_length;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector row_10 = kept[k][b].row_10;
            const vector row_11 = kept[k][b].row_11;
            const vector row_12 = kept[k][b].row_12;
            const vector row_length = kept[k][b].row_length;
            const vector g1 = row_10 / row_length;
            const vector g2 = row_11 / row_length;
            const vector g3 = row_12 / row_length;
            kept[k][b].g1 = g1;
            kept[k][b].g2 = g2;
            kept[k][b].g3 = g3;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector row_9 = kept[k][b].row_9;
            const vector row_length = kept[k][b].row_length;
            const vector g1 = kept[k][b].g1;
            const vector g2 = kept[k][b].g2;
            const vector g3 = kept[k][b].g3;
            const vector norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
            const vector_mask its_near = norm_s_squared < 0.249287;
            const vector near_chosen_2 = vector_select(its_near, vector_of(1.0), norm_s_squared);
            const vector norm_s = sqrt_each(near_chosen_2);
            const vector g0 = row_9 / row_length;
            kept[k][b].norm_s_squared = norm_s_squared;
            kept[k][b].near_chosen_2 = near_chosen_2;
            kept[k][b].norm_s = norm_s;
            kept[k][b].g0 = g0;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector norm_s = kept[k][b].norm_s;
            const vector g0 = kept[k][b].g0;
            const vector abs_g0 = abs_each(g0);
            const vector atan2_norm_s_abs_g0 = atan2_each(norm_s, abs_g0);
            kept[k][b].abs_g0 = abs_g0;
            kept[k][b].atan2_norm_s_abs_g0 = atan2_norm_s_abs_g0;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector norm_s = kept[k][b].norm_s;
            const vector atan2_norm_s_abs_g0 = kept[k][b].atan2_norm_s_abs_g0;
            const vector t = 2.0 * atan2_norm_s_abs_g0;
            const vector t_ratio = t / norm_s;
            kept[k][b].t_ratio = t_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector norm_s_squared = kept[k][b].norm_s_squared;
            const vector t_ratio = kept[k][b].t_ratio;
            const vector_mask its_near = norm_s_squared < 0.249287;
            const vector near_chosen = vector_select(its_near, 4.011440628672975 * norm_s_squared, vector_of(0.0));
            const vector log_det_series = vector_polynomial_log_det_series(near_chosen);
            const vector log_det_near = norm_s_squared * log_det_series;
            const vector product = 0.5 * t_ratio;
            const vector log_det = vector_select(its_near, log_det_near, 2.0 * log_each(product));
            kept[k][b].near_chosen = near_chosen;
            kept[k][b].log_det_series = log_det_series;
            kept[k][b].product = product;
            kept[k][b].log_det = log_det;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 25 * near[k];
        const double W0_0 = S[9];
        const double W0_1 = S[10];
        const double W0_2 = S[11];
        const double W1_0 = S[12];
        const double W1_1 = S[13];
        const double W1_2 = S[14];
        const double W2_0 = S[15];
        const double W2_1 = S[16];
        const double W2_2 = S[17];
        for (size_t b = 0; b < 2; ++b) {
            const vector g1 = kept[k][b].g1;
            const vector g2 = kept[k][b].g2;
            const vector g3 = kept[k][b].g3;
            const vector norm_s_squared = kept[k][b].norm_s_squared;
            const vector near_chosen = kept[k][b].near_chosen;
            const vector g0 = kept[k][b].g0;
            const vector t_ratio = kept[k][b].t_ratio;
            const vector log_det = kept[k][b].log_det;
            const vector_mask its_near = norm_s_squared < 0.249287;
            const vector t_over_norm_s_near = vector_polynomial_t_over_norm_s_near(near_chosen);
            const vector t_over_norm_s = vector_select(its_near, t_over_norm_s_near, t_ratio);
            const vector_mask is_small = g0 < 0.0;
            const vector chosen = vector_select(is_small, vector_of(-1.0), vector_of(1.0));
            const vector scale = t_over_norm_s * chosen;
            const vector v0 = g1 * scale;
            const vector v1 = g2 * scale;
            const vector v2 = g3 * scale;
            const vector z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
            const vector z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
            const vector z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
            const vector log_det_gap = log_det - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
            const vector phi = exp_each(log_det_gap);
            kept[k][b].chosen = chosen;
            kept[k][b].scale = scale;
            kept[k][b].z0 = z0;
            kept[k][b].z1 = z1;
            kept[k][b].z2 = z2;
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 25 * near[k];
        const double W0_0 = S[9];
        const double W0_1 = S[10];
        const double W0_2 = S[11];
        const double W1_0 = S[12];
        const double W1_1 = S[13];
        const double W1_2 = S[14];
        const double W2_0 = S[15];
        const double W2_1 = S[16];
        const double W2_2 = S[17];
        const double amplitude = S[18];
        for (size_t b = 0; b < 2; ++b) {
            const vector g1 = kept[k][b].g1;
            const vector g2 = kept[k][b].g2;
            const vector g3 = kept[k][b].g3;
            const vector norm_s_squared = kept[k][b].norm_s_squared;
            const vector product = kept[k][b].product;
            const vector chosen = kept[k][b].chosen;
            const vector z0 = kept[k][b].z0;
            const vector z1 = kept[k][b].z1;
            const vector z2 = kept[k][b].z2;
            const vector phi = kept[k][b].phi;
            const vector_mask its_near = norm_s_squared < 0.249287;
            const vector phi_2 = amplitude * phi;
            const vector phi_product = phi_2 * (W2_2 * z2 + (W1_2 * z1 + W0_2 * z0));
            const vector phi_product_2 = phi_2 * (W2_1 * z2 + (W1_1 * z1 + W0_1 * z0));
            const vector phi_product_3 = phi_2 * (W2_0 * z2 + (W1_0 * z1 + W0_0 * z0));
            const vector by_scale = -(g3 * phi_product) - g2 * phi_product_2 - g1 * phi_product_3;
            const vector by_t_over_norm_s = chosen * by_scale;
            const vector total_3 = vector_select(its_near, vector_of(0.0), by_t_over_norm_s) + 0.5 * (2.0 *
                vector_select(its_near, vector_of(0.0), phi_2) / product);
            kept[k][b].phi_2 = phi_2;
            kept[k][b].phi_product = phi_product;
            kept[k][b].phi_product_2 = phi_product_2;
            kept[k][b].phi_product_3 = phi_product_3;
            kept[k][b].by_t_over_norm_s = by_t_over_norm_s;
            kept[k][b].total_3 = total_3;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector norm_s = kept[k][b].norm_s;
            const vector total_3 = kept[k][b].total_3;
            const vector by_t = total_3 / norm_s;
            kept[k][b].by_t = by_t;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector near_chosen_2 = kept[k][b].near_chosen_2;
            const vector abs_g0 = kept[k][b].abs_g0;
            const vector by_t = kept[k][b].by_t;
            const vector by_atan2_norm_s_abs_g0 = 2.0 * by_t;
            const vector ratio = by_atan2_norm_s_abs_g0 / (near_chosen_2 + abs_g0 * abs_g0);
            kept[k][b].ratio = ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector norm_s_squared = kept[k][b].norm_s_squared;
            const vector near_chosen = kept[k][b].near_chosen;
            const vector log_det_series = kept[k][b].log_det_series;
            const vector norm_s = kept[k][b].norm_s;
            const vector abs_g0 = kept[k][b].abs_g0;
            const vector t_ratio = kept[k][b].t_ratio;
            const vector phi_2 = kept[k][b].phi_2;
            const vector by_t_over_norm_s = kept[k][b].by_t_over_norm_s;
            const vector by_t = kept[k][b].by_t;
            const vector ratio = kept[k][b].ratio;
            const vector_mask its_near = norm_s_squared < 0.249287;
            const vector by_norm_s = abs_g0 * ratio - t_ratio * by_t;
            const vector by_log_det_near = vector_select(its_near, phi_2, vector_of(0.0));
            const vector by_t_over_norm_s_near = vector_select(its_near, by_t_over_norm_s, vector_of(0.0));
            const vector t_over_norm_s_near_slope = vector_polynomial_t_over_norm_s_near_slope(near_chosen);
            const vector by_log_det_series = norm_s_squared * by_log_det_near;
            const vector log_det_series_slope = vector_polynomial_log_det_series_slope(near_chosen);
            const vector by_norm_s_squared = vector_select(its_near, vector_of(0.0), by_norm_s / (2.0 * norm_s)) +
                log_det_series * by_log_det_near + 4.011440628672975 * vector_select(its_near, by_t_over_norm_s_near *
                t_over_norm_s_near_slope + by_log_det_series * log_det_series_slope, vector_of(0.0));
            kept[k][b].by_norm_s_squared = by_norm_s_squared;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector row_length = kept[k][b].row_length;
            const vector g1 = kept[k][b].g1;
            const vector g2 = kept[k][b].g2;
            const vector g3 = kept[k][b].g3;
            const vector norm_s = kept[k][b].norm_s;
            const vector g0 = kept[k][b].g0;
            const vector scale = kept[k][b].scale;
            const vector phi_product = kept[k][b].phi_product;
            const vector phi_product_2 = kept[k][b].phi_product_2;
            const vector phi_product_3 = kept[k][b].phi_product_3;
            const vector ratio = kept[k][b].ratio;
            const vector by_norm_s_squared = kept[k][b].by_norm_s_squared;
            const vector_mask is_small = g0 < 0.0;
            const vector norm_s_product = norm_s * ratio;
            const vector by_abs_g0 = -norm_s_product;
            const vector by_g0 = vector_select(is_small, norm_s_product, by_abs_g0);
            const vector by_g0_ratio = by_g0 / row_length;
            const vector product_2 = 2.0 * by_norm_s_squared;
            const vector by_g3 = g3 * product_2 - scale * phi_product;
            const vector by_g3_ratio = by_g3 / row_length;
            const vector by_g2 = g2 * product_2 - scale * phi_product_2;
            const vector by_g2_ratio = by_g2 / row_length;
            const vector by_g1 = g1 * product_2 - scale * phi_product_3;
            const vector by_g1_ratio = by_g1 / row_length;
            kept[k][b].by_g0_ratio = by_g0_ratio;
            kept[k][b].by_g3_ratio = by_g3_ratio;
            kept[k][b].by_g2_ratio = by_g2_ratio;
            kept[k][b].by_g1_ratio = by_g1_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector total_2 = kept[k][b].total_2;
            const vector row_length = kept[k][b].row_length;
            const vector g1 = kept[k][b].g1;
            const vector g2 = kept[k][b].g2;
            const vector g3 = kept[k][b].g3;
            const vector g0 = kept[k][b].g0;
            const vector by_g0_ratio = kept[k][b].by_g0_ratio;
            const vector by_g3_ratio = kept[k][b].by_g3_ratio;
            const vector by_g2_ratio = kept[k][b].by_g2_ratio;
            const vector by_g1_ratio = kept[k][b].by_g1_ratio;
            const vector_mask is_small_2 = total_2 == 0.0;
            const vector by_row_length = -(g0 * by_g0_ratio) - g3 * by_g3_ratio - g2 * by_g2_ratio - g1 * by_g1_ratio;
            const vector product_3 = 2.0 * vector_select(is_small_2, vector_of(0.0), by_row_length / (2.0 *
                vector_select(is_small_2, vector_of(1.0), row_length)));
            kept[k][b].product_3 = product_3;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 25 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double mu7 = S[7];
        const double mu8 = S[8];
        for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            vector *slope = slopes + 9 * b;
            const vector square0 = kept[k][b].square0;
            const vector square1 = kept[k][b].square1;
            const vector largest = kept[k][b].largest;
            const vector square2 = kept[k][b].square2;
            const vector largest_2 = kept[k][b].largest_2;
            const vector square3 = kept[k][b].square3;
            const vector row_10 = kept[k][b].row_10;
            const vector row_11 = kept[k][b].row_11;
            const vector row_12 = kept[k][b].row_12;
            const vector row_9 = kept[k][b].row_9;
            const vector phi_2 = kept[k][b].phi_2;
            const vector by_g0_ratio = kept[k][b].by_g0_ratio;
            const vector by_g3_ratio = kept[k][b].by_g3_ratio;
            const vector by_g2_ratio = kept[k][b].by_g2_ratio;
            const vector by_g1_ratio = kept[k][b].by_g1_ratio;
            const vector product_3 = kept[k][b].product_3;
            const vector_mask is_less = square0 < square1;
            const vector_mask is_less_2 = largest < square2;
            const vector_mask is_less_3 = largest_2 < square3;
            const vector by_row_9 = by_g0_ratio + row_9 * product_3;
            const vector by_row_12 = by_g3_ratio + row_12 * product_3;
            const vector by_row_8 = vector_select(is_less_3, vector_of(0.0), by_row_12);
            const vector by_row_4 = vector_select(is_less_2, vector_of(0.0), by_row_8);
            const vector total_4 = vector_select(is_less_3, by_row_9, vector_of(0.0)) + vector_select(is_less,
                vector_of(0.0), by_row_4);
            const vector by_row_11 = by_g2_ratio + row_11 * product_3;
            const vector by_row_7 = vector_select(is_less_3, vector_of(0.0), by_row_11);
            const vector by_row_3 = vector_select(is_less_2, vector_of(0.0), by_row_7);
            const vector by_row_10 = by_g1_ratio + row_10 * product_3;
            const vector by_row_6 = vector_select(is_less_3, vector_of(0.0), by_row_10);
            const vector total_5 = vector_select(is_less, by_row_3, vector_of(0.0)) + vector_select(is_less_2,
                by_row_6, vector_of(0.0));
            const vector by_R1_0 = total_4 + total_5;
            const vector total_6 = vector_select(is_less, by_row_4, vector_of(0.0)) + vector_select(is_less_3,
                by_row_10, vector_of(0.0));
            const vector by_row_5 = vector_select(is_less_3, vector_of(0.0), by_row_9);
            const vector total_7 = vector_select(is_less_2, by_row_5, vector_of(0.0)) + vector_select(is_less,
                vector_of(0.0), by_row_3);
            const vector by_R2_0 = total_6 - total_7;
            const vector by_square3 = vector_select(is_less_3, by_row_12, vector_of(0.0));
            const vector by_square2 = vector_select(is_less_2, by_row_7, vector_of(0.0));
            const vector by_row = vector_select(is_less_2, vector_of(0.0), by_row_5);
            const vector by_square0 = vector_select(is_less, vector_of(0.0), by_row);
            const vector by_row_2 = vector_select(is_less_2, vector_of(0.0), by_row_6);
            const vector by_square1 = vector_select(is_less, by_row_2, vector_of(0.0));
            const vector by_R0_0 = -by_square3 - by_square2 + (by_square0 + by_square1);
            const vector total_8 = vector_select(is_less_2, by_row_8, vector_of(0.0)) + vector_select(is_less_3,
                by_row_11, vector_of(0.0));
            const vector total_9 = vector_select(is_less, by_row, vector_of(0.0)) + vector_select(is_less,
                vector_of(0.0), by_row_2);
            const vector by_R2_1 = total_8 + total_9;
            const vector by_R0_1 = total_5 - total_4;
            const vector by_R1_1 = by_square0 + (by_square2 - by_square3 - by_square1);
            const vector by_R1_2 = total_8 - total_9;
            const vector by_R0_2 = total_7 + total_6;
            const vector by_R2_2 = by_square0 + (by_square3 - by_square2 - by_square1);
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] + mu1 * by_R1_0 + mu2 * by_R2_0 + mu0 * by_R0_0;
            slope[1] = slope[1] + mu2 * by_R2_1 + mu0 * by_R0_1 + mu1 * by_R1_1;
            slope[2] = slope[2] + mu1 * by_R1_2 + mu0 * by_R0_2 + mu2 * by_R2_2;
            slope[3] = slope[3] + mu4 * by_R1_0 + mu5 * by_R2_0 + mu3 * by_R0_0;
            slope[4] = slope[4] + mu5 * by_R2_1 + mu3 * by_R0_1 + mu4 * by_R1_1;
            slope[5] = slope[5] + mu4 * by_R1_2 + mu3 * by_R0_2 + mu5 * by_R2_2;
            slope[6] = slope[6] + mu7 * by_R1_0 + mu8 * by_R2_0 + mu6 * by_R0_0;
            slope[7] = slope[7] + mu8 * by_R2_1 + mu6 * by_R0_1 + mu7 * by_R1_1;
            slope[8] = slope[8] + mu7 * by_R1_2 + mu6 * by_R0_2 + mu8 * by_R2_2;
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
    const vector x4 = x[4];
    const vector x5 = x[5];
    const vector x6 = x[6];
    const vector x7 = x[7];
    const vector x8 = x[8];
    const vector slope_x0 = slope[0];
    const vector slope_x1 = slope[1];
    const vector slope_x2 = slope[2];
    const vector slope_x3 = slope[3];
    const vector slope_x4 = slope[4];
    const vector slope_x5 = slope[5];
    const vector slope_x6 = slope[6];
    const vector slope_x7 = slope[7];
    const vector slope_x8 = slope[8];
    const vector gap = x2 * slope_x1 + x5 * slope_x4 + x8 * slope_x7 - x1 * slope_x2 - x4 * slope_x5;
    const vector gap_2 = x0 * slope_x2 + x3 * slope_x5 + x6 * slope_x8 - x2 * slope_x0 - x5 * slope_x3;
    const vector gap_3 = x1 * slope_x0 + x4 * slope_x3 + x7 * slope_x6 - x0 * slope_x1 - x3 * slope_x4;
    gradient[0] = gap - x7 * slope_x8;
    gradient[1] = gap_2 - x8 * slope_x6;
    gradient[2] = gap_3 - x6 * slope_x7;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp(
    const vector *x, const vector *gradient_bar, vector *slope_bar) {
    const vector x0 = x[0];
    const vector x1 = x[1];
    const vector x2 = x[2];
    const vector x3 = x[3];
    const vector x4 = x[4];
    const vector x5 = x[5];
    const vector x6 = x[6];
    const vector x7 = x[7];
    const vector x8 = x[8];
    const vector gradient_bar0 = gradient_bar[0];
    const vector gradient_bar1 = gradient_bar[1];
    const vector gradient_bar2 = gradient_bar[2];
    slope_bar[0] = x1 * gradient_bar2 - x2 * gradient_bar1;
    slope_bar[1] = x2 * gradient_bar0 - x0 * gradient_bar2;
    slope_bar[2] = x0 * gradient_bar1 - x1 * gradient_bar0;
    slope_bar[3] = x4 * gradient_bar2 - x5 * gradient_bar1;
    slope_bar[4] = x5 * gradient_bar0 - x3 * gradient_bar2;
    slope_bar[5] = x3 * gradient_bar1 - x4 * gradient_bar0;
    slope_bar[6] = x7 * gradient_bar2 - x8 * gradient_bar1;
    slope_bar[7] = x8 * gradient_bar0 - x6 * gradient_bar2;
    slope_bar[8] = x6 * gradient_bar1 - x7 * gradient_bar0;
}

/*
 * Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
OUTLINE void pair_backward(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *sums) {
    struct { vector square0, square1, largest, square2, largest_2, square3, row_12, row_10, row_11, row_9,
            total_2, row_length, g3, g1, g2, norm_s_squared, g0, abs_g0, chosen, near_chosen, log_det_series,
            near_chosen_2, norm_s, atan2_norm_s_abs_g0, t_ratio, product, log_det, scale, v0, v1, v2, z0, z1, z2,
            phi, total_3, phi_product, total_4, phi_product_2, total_5, phi_product_3, by_t_over_norm_s, ratio,
            by_t, total_6, ratio_2, norm_s_product, by_norm_s_ratio, by_log_det_near, by_t_over_norm_s_near,
            t_over_norm_s_near_slope, by_log_det_series, log_det_series_slope, product_2, by_g3_ratio,
            by_g0_ratio, by_g2_ratio, by_g1_ratio, product_3, ratio_3, by_by_row_11, by_by_row_10, by_by_row_12,
            by_by_row_9, by_by_row_length, by_by_g2, by_by_g0, gap, by_by_g1, by_by_g3, total_11,
            by_by_norm_s_squared, by_by_norm_s, by_by_atan2_norm_s_abs_g0, by_by_t_ratio, near_chosen_3,
            by_by_scale, gap_2, phi_product_4, gap_3, phi_product_5, gap_4, phi_product_6, ratio_4,
            by_by_log_det_series, by_log_det, by_v1, by_v2, by_v0, by_t_over_norm_s_2, product_6, by_t_2, ratio_5,
            product_7, by_log_det_near_2, total_14, by_g2_ratio_2, by_g0_ratio_2, by_g3_ratio_2, by_g1_ratio_2,
            product_9; } kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 19 * (size_t)near[i];
        const vector x0 = X[0];
        const vector x1 = X[1];
        const vector x2 = X[2];
        const vector x3 = X[3];
        const vector x4 = X[4];
        const vector x5 = X[5];
        const vector x6 = X[6];
        const vector x7 = X[7];
        const vector x8 = X[8];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double mu7 = S[7];
        const double mu8 = S[8];
        const vector R2_2 = x2 * mu2 + x5 * mu5 + x8 * mu8;
        const vector R1_1 = x1 * mu1 + x4 * mu4 + x7 * mu7;
        const vector R0_0 = x0 * mu0 + x3 * mu3 + x6 * mu6;
        const vector R0_0_total = 1.0 + R0_0;
        const vector square0 = R2_2 + (R1_1 + R0_0_total);
        const vector square1 = R0_0_total - R1_1 - R2_2;
        const vector_mask is_less = square0 < square1;
        const vector largest = vector_select(is_less, square1, square0);
        const vector square2 = 1.0 + R1_1 - R0_0 - R2_2;
        const vector_mask is_less_2 = largest < square2;
        const vector largest_2 = vector_select(is_less_2, square2, largest);
        const vector square3 = 1.0 + R2_2 - R0_0 - R1_1;
        const vector_mask is_less_3 = largest_2 < square3;
        const vector R1_2 = x2 * mu1 + x5 * mu4 + x8 * mu7;
        const vector R2_1 = x1 * mu2 + x4 * mu5 + x7 * mu8;
        const vector R1_2_total = R1_2 + R2_1;
        const vector R0_2 = x2 * mu0 + x5 * mu3 + x8 * mu6;
        const vector R2_0 = x0 * mu2 + x3 * mu5 + x6 * mu8;
        const vector R0_2_total = R0_2 + R2_0;
        const vector R1_0 = x0 * mu1 + x3 * mu4 + x6 * mu7;
        const vector R0_1 = x1 * mu0 + x4 * mu3 + x7 * mu6;
        const vector R1_0_gap = R1_0 - R0_1;
        const vector row_4 = vector_select(is_less, R0_2_total, R1_0_gap);
        const vector row_8 = vector_select(is_less_2, R1_2_total, row_4);
        const vector row_12 = vector_select(is_less_3, square3, row_8);
        const vector R0_1_total = R0_1 + R1_0;
        const vector R2_1_gap = R2_1 - R1_2;
        const vector row_2 = vector_select(is_less, square1, R2_1_gap);
        const vector row_6 = vector_select(is_less_2, R0_1_total, row_2);
        const vector row_10 = vector_select(is_less_3, R0_2_total, row_6);
        const vector R0_2_gap = R0_2 - R2_0;
        const vector row_3 = vector_select(is_less, R0_1_total, R0_2_gap);
        const vector row_7 = vector_select(is_less_2, square2, row_3);
        const vector row_11 = vector_select(is_less_3, R1_2_total, row_7);
        const vector row = vector_select(is_less, R2_1_gap, square0);
        const vector row_5 = vector_select(is_less_2, R0_2_gap, row);
        const vector row_9 = vector_select(is_less_3, R1_0_gap, row_5);
        const vector total_2 = row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9;
        const vector row_length = sqrt_each(total_2);
        kept[i].square0 = square0;
        kept[i].square1 = square1;
        kept[i].largest = largest;
        kept[i].square2 = square2;
        kept[i].largest_2 = largest_2;
        kept[i].square3 = square3;
        kept[i].row_12 = row_12;
        kept[i].row_10 = row_10;
        kept[i].row_11 = row_11;
        kept[i].row_9 = row_9;
        kept[i].total_2 = total_2;
        kept[i].row_length = row_length;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector row_12 = kept[i].row_12;
        const vector row_10 = kept[i].row_10;
        const vector row_11 = kept[i].row_11;
        const vector row_length = kept[i].row_length;
        const vector g3 = row_12 / row_length;
        const vector g1 = row_10 / row_length;
        const vector g2 = row_11 / row_length;
        kept[i].g3 = g3;
        kept[i].g1 = g1;
        kept[i].g2 = g2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *slope_bar = points + 19 * (size_t)near[i] + 9 + 1;
        const vector square0 = kept[i].square0;
        const vector square1 = kept[i].square1;
        const vector largest = kept[i].largest;
        const vector square2 = kept[i].square2;
        const vector largest_2 = kept[i].largest_2;
        const vector square3 = kept[i].square3;
        const vector row_12 = kept[i].row_12;
        const vector row_10 = kept[i].row_10;
        const vector row_11 = kept[i].row_11;
        const vector row_9 = kept[i].row_9;
        const vector total_2 = kept[i].total_2;
        const vector row_length = kept[i].row_length;
        const vector g3 = kept[i].g3;
        const vector g1 = kept[i].g1;
        const vector g2 = kept[i].g2;
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double mu7 = S[7];
        const double mu8 = S[8];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector x2_bar = slope_bar[2];
        const vector x3_bar = slope_bar[3];
        const vector x4_bar = slope_bar[4];
        const vector x5_bar = slope_bar[5];
        const vector x6_bar = slope_bar[6];
        const vector x7_bar = slope_bar[7];
        const vector x8_bar = slope_bar[8];
        const vector_mask is_less = square0 < square1;
        const vector_mask is_less_2 = largest < square2;
        const vector_mask is_less_3 = largest_2 < square3;
        const vector norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
        const vector_mask its_near = norm_s_squared < 0.249287;
        const vector g0 = row_9 / row_length;
        const vector near_chosen_2 = vector_select(its_near, vector_of(1.0), norm_s_squared);
        const vector norm_s = sqrt_each(near_chosen_2);
        const vector_mask is_small_2 = total_2 == 0.0;
        const vector product_3 = 2.0 * vector_select(is_small_2, vector_of(1.0), row_length);
        const vector by_by_R0_2 = mu0 * x2_bar + mu3 * x5_bar + mu6 * x8_bar;
        const vector by_by_R2_0 = mu2 * x0_bar + mu5 * x3_bar + mu8 * x6_bar;
        const vector by_by_R0_2_gap = by_by_R0_2 - by_by_R2_0;
        const vector by_by_R0_1 = mu0 * x1_bar + mu3 * x4_bar + mu6 * x7_bar;
        const vector by_by_R1_0 = mu1 * x0_bar + mu4 * x3_bar + mu7 * x6_bar;
        const vector by_by_R0_1_total = by_by_R0_1 + by_by_R1_0;
        const vector by_by_row_3 = vector_select(is_less, vector_of(0.0), by_by_R0_2_gap) + vector_select(is_less,
            by_by_R0_1_total, vector_of(0.0));
        const vector by_by_R1_1 = mu1 * x1_bar + mu4 * x4_bar + mu7 * x7_bar;
        const vector by_by_R0_0 = mu0 * x0_bar + mu3 * x3_bar + mu6 * x6_bar;
        const vector by_by_R2_2 = mu2 * x2_bar + mu5 * x5_bar + mu8 * x8_bar;
        const vector by_by_square2 = by_by_R1_1 - by_by_R0_0 - by_by_R2_2;
        const vector by_by_row_7 = vector_select(is_less_2, vector_of(0.0), by_by_row_3) +
            vector_select(is_less_2, by_by_square2, vector_of(0.0));
        const vector by_by_R2_1 = mu2 * x1_bar + mu5 * x4_bar + mu8 * x7_bar;
        const vector by_by_R1_2 = mu1 * x2_bar + mu4 * x5_bar + mu7 * x8_bar;
        const vector by_by_R2_1_total = by_by_R2_1 + by_by_R1_2;
        const vector by_by_row_11 = vector_select(is_less_3, vector_of(0.0), by_by_row_7) +
            vector_select(is_less_3, by_by_R2_1_total, vector_of(0.0));
        const vector by_by_R2_1_gap = by_by_R2_1 - by_by_R1_2;
        const vector by_by_square1 = by_by_R0_0 - by_by_R1_1 - by_by_R2_2;
        const vector by_by_row_2 = vector_select(is_less, vector_of(0.0), by_by_R2_1_gap) + vector_select(is_less,
            by_by_square1, vector_of(0.0));
        const vector by_by_row_6 = vector_select(is_less_2, vector_of(0.0), by_by_row_2) +
            vector_select(is_less_2, by_by_R0_1_total, vector_of(0.0));
        const vector by_by_R0_2_total = by_by_R0_2 + by_by_R2_0;
        const vector by_by_row_10 = vector_select(is_less_3, vector_of(0.0), by_by_row_6) +
            vector_select(is_less_3, by_by_R0_2_total, vector_of(0.0));
        const vector by_by_R1_0_gap = by_by_R1_0 - by_by_R0_1;
        const vector by_by_row_4 = vector_select(is_less, vector_of(0.0), by_by_R1_0_gap) + vector_select(is_less,
            by_by_R0_2_total, vector_of(0.0));
        const vector by_by_row_8 = vector_select(is_less_2, vector_of(0.0), by_by_row_4) +
            vector_select(is_less_2, by_by_R2_1_total, vector_of(0.0));
        const vector by_by_square3 = by_by_R2_2 - by_by_R1_1 - by_by_R0_0;
        const vector by_by_row_12 = vector_select(is_less_3, vector_of(0.0), by_by_row_8) +
            vector_select(is_less_3, by_by_square3, vector_of(0.0));
        const vector by_by_square0 = by_by_R2_2 + (by_by_R1_1 + by_by_R0_0);
        const vector by_by_row = vector_select(is_less, by_by_R2_1_gap, vector_of(0.0)) + vector_select(is_less,
            vector_of(0.0), by_by_square0);
        const vector by_by_row_5 = vector_select(is_less_2, vector_of(0.0), by_by_row) + vector_select(is_less_2,
            by_by_R0_2_gap, vector_of(0.0));
        const vector by_by_row_9 = vector_select(is_less_3, vector_of(0.0), by_by_row_5) +
            vector_select(is_less_3, by_by_R1_0_gap, vector_of(0.0));
        const vector product_5 = 2.0 * (row_10 * by_by_row_10 + row_11 * by_by_row_11 + row_12 * by_by_row_12 +
            row_9 * by_by_row_9);
        const vector by_by_row_length = vector_select(is_small_2, vector_of(0.0), product_5) / product_3;
        kept[i].norm_s_squared = norm_s_squared;
        kept[i].g0 = g0;
        kept[i].near_chosen_2 = near_chosen_2;
        kept[i].norm_s = norm_s;
        kept[i].product_3 = product_3;
        kept[i].by_by_row_11 = by_by_row_11;
        kept[i].by_by_row_10 = by_by_row_10;
        kept[i].by_by_row_12 = by_by_row_12;
        kept[i].by_by_row_9 = by_by_row_9;
        kept[i].by_by_row_length = by_by_row_length;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector row_length = kept[i].row_length;
        const vector g3 = kept[i].g3;
        const vector g1 = kept[i].g1;
        const vector g2 = kept[i].g2;
        const vector g0 = kept[i].g0;
        const vector norm_s = kept[i].norm_s;
        const vector by_by_row_11 = kept[i].by_by_row_11;
        const vector by_by_row_10 = kept[i].by_by_row_10;
        const vector by_by_row_12 = kept[i].by_by_row_12;
        const vector by_by_row_length = kept[i].by_by_row_length;
        const vector abs_g0 = abs_each(g0);
        const vector atan2_norm_s_abs_g0 = atan2_each(norm_s, abs_g0);
        const vector by_by_g2 = (by_by_row_11 - g2 * by_by_row_length) / row_length;
        const vector by_by_g1 = (by_by_row_10 - g1 * by_by_row_length) / row_length;
        const vector by_by_g3 = (by_by_row_12 - g3 * by_by_row_length) / row_length;
        kept[i].abs_g0 = abs_g0;
        kept[i].atan2_norm_s_abs_g0 = atan2_norm_s_abs_g0;
        kept[i].by_by_g2 = by_by_g2;
        kept[i].by_by_g1 = by_by_g1;
        kept[i].by_by_g3 = by_by_g3;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector row_length = kept[i].row_length;
        const vector g3 = kept[i].g3;
        const vector g1 = kept[i].g1;
        const vector g2 = kept[i].g2;
        const vector norm_s_squared = kept[i].norm_s_squared;
        const vector g0 = kept[i].g0;
        const vector norm_s = kept[i].norm_s;
        const vector atan2_norm_s_abs_g0 = kept[i].atan2_norm_s_abs_g0;
        const vector by_by_row_9 = kept[i].by_by_row_9;
        const vector by_by_row_length = kept[i].by_by_row_length;
        const vector by_by_g2 = kept[i].by_by_g2;
        const vector by_by_g1 = kept[i].by_by_g1;
        const vector by_by_g3 = kept[i].by_by_g3;
        const vector_mask its_near = norm_s_squared < 0.249287;
        const vector t = 2.0 * atan2_norm_s_abs_g0;
        const vector t_ratio = t / norm_s;
        const vector norm_s_product = 2.0 * norm_s;
        const vector by_by_g0 = (by_by_row_9 - g0 * by_by_row_length) / row_length;
        const vector total_11 = g1 * by_by_g1 + g2 * by_by_g2 + g3 * by_by_g3;
        const vector by_by_norm_s_squared = 2.0 * total_11;
        const vector by_by_norm_s = vector_select(its_near, vector_of(0.0), by_by_norm_s_squared) /
            norm_s_product;
        kept[i].t_ratio = t_ratio;
        kept[i].norm_s_product = norm_s_product;
        kept[i].by_by_g0 = by_by_g0;
        kept[i].total_11 = total_11;
        kept[i].by_by_norm_s_squared = by_by_norm_s_squared;
        kept[i].by_by_norm_s = by_by_norm_s;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector norm_s_squared = kept[i].norm_s_squared;
        const vector g0 = kept[i].g0;
        const vector abs_g0 = kept[i].abs_g0;
        const vector near_chosen_2 = kept[i].near_chosen_2;
        const vector norm_s = kept[i].norm_s;
        const vector t_ratio = kept[i].t_ratio;
        const vector by_by_g0 = kept[i].by_by_g0;
        const vector by_by_norm_s = kept[i].by_by_norm_s;
        const vector_mask its_near = norm_s_squared < 0.249287;
        const vector_mask is_small = g0 < 0.0;
        const vector near_chosen = vector_select(its_near, 4.011440628672975 * norm_s_squared, vector_of(0.0));
        const vector log_det_series = vector_polynomial_log_det_series(near_chosen);
        const vector log_det_near = norm_s_squared * log_det_series;
        const vector product = 0.5 * t_ratio;
        const vector log_det = vector_select(its_near, log_det_near, 2.0 * log_each(product));
        const vector total_6 = near_chosen_2 + abs_g0 * abs_g0;
        const vector by_by_abs_g0 = vector_select(is_small, vector_of(0.0), by_by_g0);
        const vector gap = vector_select(is_small, by_by_g0, vector_of(0.0)) - by_by_abs_g0;
        const vector by_by_atan2_norm_s_abs_g0 = (norm_s * gap + abs_g0 * by_by_norm_s) / total_6;
        kept[i].near_chosen = near_chosen;
        kept[i].log_det_series = log_det_series;
        kept[i].product = product;
        kept[i].log_det = log_det;
        kept[i].total_6 = total_6;
        kept[i].gap = gap;
        kept[i].by_by_atan2_norm_s_abs_g0 = by_by_atan2_norm_s_abs_g0;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector g3 = kept[i].g3;
        const vector g1 = kept[i].g1;
        const vector g2 = kept[i].g2;
        const vector norm_s_squared = kept[i].norm_s_squared;
        const vector g0 = kept[i].g0;
        const vector near_chosen = kept[i].near_chosen;
        const vector norm_s = kept[i].norm_s;
        const vector t_ratio = kept[i].t_ratio;
        const vector log_det = kept[i].log_det;
        const vector by_by_norm_s = kept[i].by_by_norm_s;
        const vector by_by_atan2_norm_s_abs_g0 = kept[i].by_by_atan2_norm_s_abs_g0;
        const double W0_0 = S[9];
        const double W0_1 = S[10];
        const double W0_2 = S[11];
        const double W1_0 = S[12];
        const double W1_1 = S[13];
        const double W1_2 = S[14];
        const double W2_0 = S[15];
        const double W2_1 = S[16];
        const double W2_2 = S[17];
        const vector_mask its_near = norm_s_squared < 0.249287;
        const vector_mask is_small = g0 < 0.0;
        const vector chosen = vector_select(is_small, vector_of(-1.0), vector_of(1.0));
        const vector t_over_norm_s_near = vector_polynomial_t_over_norm_s_near(near_chosen);
        const vector t_over_norm_s = vector_select(its_near, t_over_norm_s_near, t_ratio);
        const vector scale = t_over_norm_s * chosen;
        const vector v0 = g1 * scale;
        const vector v1 = g2 * scale;
        const vector v2 = g3 * scale;
        const vector z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
        const vector z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
        const vector z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
        const vector log_det_gap = log_det - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
        const vector phi = exp_each(log_det_gap);
        const vector by_by_t = 2.0 * by_by_atan2_norm_s_abs_g0 - t_ratio * by_by_norm_s;
        const vector by_by_t_ratio = by_by_t / norm_s;
        kept[i].chosen = chosen;
        kept[i].scale = scale;
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].v2 = v2;
        kept[i].z0 = z0;
        kept[i].z1 = z1;
        kept[i].z2 = z2;
        kept[i].phi = phi;
        kept[i].by_by_t_ratio = by_by_t_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector norm_s_squared = kept[i].norm_s_squared;
        const vector product = kept[i].product;
        const vector phi = kept[i].phi;
        const vector by_by_t_ratio = kept[i].by_by_t_ratio;
        const vector_mask its_near = norm_s_squared < 0.249287;
        const vector ratio = 2.0 * vector_select(its_near, vector_of(0.0), phi) / product;
        const vector ratio_4 = 0.5 * by_by_t_ratio / product;
        kept[i].ratio = ratio;
        kept[i].ratio_4 = ratio_4;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *value_bar = points + 19 * (size_t)near[i] + 9;
        const vector g3 = kept[i].g3;
        const vector g1 = kept[i].g1;
        const vector g2 = kept[i].g2;
        const vector norm_s_squared = kept[i].norm_s_squared;
        const vector chosen = kept[i].chosen;
        const vector near_chosen = kept[i].near_chosen;
        const vector log_det_series = kept[i].log_det_series;
        const vector norm_s = kept[i].norm_s;
        const vector product = kept[i].product;
        const vector scale = kept[i].scale;
        const vector z0 = kept[i].z0;
        const vector z1 = kept[i].z1;
        const vector z2 = kept[i].z2;
        const vector phi = kept[i].phi;
        const vector ratio = kept[i].ratio;
        const vector by_by_g2 = kept[i].by_by_g2;
        const vector by_by_g1 = kept[i].by_by_g1;
        const vector by_by_g3 = kept[i].by_by_g3;
        const vector total_11 = kept[i].total_11;
        const vector by_by_norm_s_squared = kept[i].by_by_norm_s_squared;
        const vector by_by_t_ratio = kept[i].by_by_t_ratio;
        const vector ratio_4 = kept[i].ratio_4;
        const double W0_0 = S[9];
        const double W0_1 = S[10];
        const double W0_2 = S[11];
        const double W1_0 = S[12];
        const double W1_1 = S[13];
        const double W1_2 = S[14];
        const double W2_0 = S[15];
        const double W2_1 = S[16];
        const double W2_2 = S[17];
        const vector its_value_bar = value_bar[0];
        const vector_mask its_near = norm_s_squared < 0.249287;
        const vector total_3 = W2_2 * z2 + (W1_2 * z1 + W0_2 * z0);
        const vector phi_product = phi * total_3;
        const vector total_4 = W2_1 * z2 + (W1_1 * z1 + W0_1 * z0);
        const vector phi_product_2 = phi * total_4;
        const vector total_5 = W2_0 * z2 + (W1_0 * z1 + W0_0 * z0);
        const vector phi_product_3 = phi * total_5;
        const vector by_scale = -(g3 * phi_product) - g2 * phi_product_2 - g1 * phi_product_3;
        const vector by_t_over_norm_s = chosen * by_scale;
        const vector by_t = (vector_select(its_near, vector_of(0.0), by_t_over_norm_s) + 0.5 * ratio) / norm_s;
        const vector t_over_norm_s_near_slope = vector_polynomial_t_over_norm_s_near_slope(near_chosen);
        const vector log_det_series_slope = vector_polynomial_log_det_series_slope(near_chosen);
        const vector near_chosen_3 = vector_select(its_near, 8.02288125734595 * total_11, vector_of(0.0));
        const vector by_by_t_over_norm_s_near = t_over_norm_s_near_slope * near_chosen_3;
        const vector by_by_t_over_norm_s = vector_select(its_near, vector_of(0.0), by_by_t_ratio) +
            vector_select(its_near, by_by_t_over_norm_s_near, vector_of(0.0));
        const vector by_by_scale = chosen * by_by_t_over_norm_s;
        const vector gap_2 = -(g1 * by_by_scale) - scale * by_by_g1;
        const vector gap_3 = -(g2 * by_by_scale) - scale * by_by_g2;
        const vector gap_4 = -(g3 * by_by_scale) - scale * by_by_g3;
        const vector by_by_log_det_series = log_det_series_slope * near_chosen_3;
        const vector by_by_log_det_near = norm_s_squared * by_by_log_det_series + log_det_series *
            by_by_norm_s_squared;
        const vector total_12 = its_value_bar + vector_select(its_near, vector_of(0.0), 2.0 * ratio_4) +
            vector_select(its_near, by_by_log_det_near, vector_of(0.0)) + total_3 * gap_4;
        const vector by_phi = total_12 + total_4 * gap_3 + total_5 * gap_2;
        const vector by_log_det = phi * by_phi;
        const vector product_6 = 0.5 * (2.0 * vector_select(its_near, vector_of(0.0), by_log_det) / product -
            ratio * ratio_4);
        kept[i].total_3 = total_3;
        kept[i].phi_product = phi_product;
        kept[i].total_4 = total_4;
        kept[i].phi_product_2 = phi_product_2;
        kept[i].total_5 = total_5;
        kept[i].phi_product_3 = phi_product_3;
        kept[i].by_t_over_norm_s = by_t_over_norm_s;
        kept[i].by_t = by_t;
        kept[i].t_over_norm_s_near_slope = t_over_norm_s_near_slope;
        kept[i].log_det_series_slope = log_det_series_slope;
        kept[i].near_chosen_3 = near_chosen_3;
        kept[i].by_by_scale = by_by_scale;
        kept[i].gap_2 = gap_2;
        kept[i].gap_3 = gap_3;
        kept[i].gap_4 = gap_4;
        kept[i].by_by_log_det_series = by_by_log_det_series;
        kept[i].by_log_det = by_log_det;
        kept[i].product_6 = product_6;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector g3 = kept[i].g3;
        const vector g1 = kept[i].g1;
        const vector g2 = kept[i].g2;
        const vector norm_s_squared = kept[i].norm_s_squared;
        const vector chosen = kept[i].chosen;
        const vector norm_s = kept[i].norm_s;
        const vector phi = kept[i].phi;
        const vector total_3 = kept[i].total_3;
        const vector phi_product = kept[i].phi_product;
        const vector total_4 = kept[i].total_4;
        const vector phi_product_2 = kept[i].phi_product_2;
        const vector total_5 = kept[i].total_5;
        const vector phi_product_3 = kept[i].phi_product_3;
        const vector by_t = kept[i].by_t;
        const vector total_6 = kept[i].total_6;
        const vector by_by_g2 = kept[i].by_by_g2;
        const vector by_by_g1 = kept[i].by_by_g1;
        const vector by_by_g3 = kept[i].by_by_g3;
        const vector by_by_norm_s = kept[i].by_by_norm_s;
        const vector gap_2 = kept[i].gap_2;
        const vector gap_3 = kept[i].gap_3;
        const vector gap_4 = kept[i].gap_4;
        const vector by_log_det = kept[i].by_log_det;
        const vector product_6 = kept[i].product_6;
        const double M0_0 = S[19];
        const double M0_1 = S[20];
        const double M0_2 = S[21];
        const double M1_1 = S[22];
        const double M1_2 = S[23];
        const double M2_2 = S[24];
        const vector_mask its_near = norm_s_squared < 0.249287;
        const vector by_atan2_norm_s_abs_g0 = 2.0 * by_t;
        const vector ratio_2 = by_atan2_norm_s_abs_g0 / total_6;
        const vector phi_product_4 = phi * gap_2;
        const vector phi_product_5 = phi * gap_3;
        const vector phi_product_6 = phi * gap_4;
        const vector by_v1 = M0_1 * phi_product_4 + M1_1 * phi_product_5 + M1_2 * phi_product_6 - total_4 *
            by_log_det;
        const vector by_v2 = M0_2 * phi_product_4 + M1_2 * phi_product_5 + M2_2 * phi_product_6 - total_3 *
            by_log_det;
        const vector total_13 = -(phi_product_3 * by_by_g1) - phi_product_2 * by_by_g2 - phi_product * by_by_g3 +
            g3 * by_v2;
        const vector by_v0 = M0_0 * phi_product_4 + M0_1 * phi_product_5 + M0_2 * phi_product_6 - total_5 *
            by_log_det;
        const vector by_scale_2 = total_13 + g2 * by_v1 + g1 * by_v0;
        const vector by_t_over_norm_s_2 = chosen * by_scale_2;
        const vector by_t_2 = (vector_select(its_near, vector_of(0.0), by_t_over_norm_s_2) - by_t * by_by_norm_s +
            product_6) / norm_s;
        kept[i].ratio_2 = ratio_2;
        kept[i].phi_product_4 = phi_product_4;
        kept[i].phi_product_5 = phi_product_5;
        kept[i].phi_product_6 = phi_product_6;
        kept[i].by_v1 = by_v1;
        kept[i].by_v2 = by_v2;
        kept[i].by_v0 = by_v0;
        kept[i].by_t_over_norm_s_2 = by_t_over_norm_s_2;
        kept[i].by_t_2 = by_t_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector abs_g0 = kept[i].abs_g0;
        const vector t_ratio = kept[i].t_ratio;
        const vector by_t = kept[i].by_t;
        const vector total_6 = kept[i].total_6;
        const vector ratio_2 = kept[i].ratio_2;
        const vector norm_s_product = kept[i].norm_s_product;
        const vector by_t_2 = kept[i].by_t_2;
        const vector by_norm_s = abs_g0 * ratio_2 - t_ratio * by_t;
        const vector by_norm_s_ratio = by_norm_s / norm_s_product;
        const vector by_atan2_norm_s_abs_g0_2 = 2.0 * by_t_2;
        const vector ratio_5 = by_atan2_norm_s_abs_g0_2 / total_6;
        kept[i].by_norm_s_ratio = by_norm_s_ratio;
        kept[i].ratio_5 = ratio_5;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector row_length = kept[i].row_length;
        const vector g3 = kept[i].g3;
        const vector g1 = kept[i].g1;
        const vector g2 = kept[i].g2;
        const vector norm_s_squared = kept[i].norm_s_squared;
        const vector g0 = kept[i].g0;
        const vector abs_g0 = kept[i].abs_g0;
        const vector log_det_series = kept[i].log_det_series;
        const vector norm_s = kept[i].norm_s;
        const vector t_ratio = kept[i].t_ratio;
        const vector scale = kept[i].scale;
        const vector phi = kept[i].phi;
        const vector phi_product = kept[i].phi_product;
        const vector phi_product_2 = kept[i].phi_product_2;
        const vector phi_product_3 = kept[i].phi_product_3;
        const vector by_t_over_norm_s = kept[i].by_t_over_norm_s;
        const vector by_t = kept[i].by_t;
        const vector ratio_2 = kept[i].ratio_2;
        const vector norm_s_product = kept[i].norm_s_product;
        const vector by_norm_s_ratio = kept[i].by_norm_s_ratio;
        const vector t_over_norm_s_near_slope = kept[i].t_over_norm_s_near_slope;
        const vector log_det_series_slope = kept[i].log_det_series_slope;
        const vector gap = kept[i].gap;
        const vector by_by_norm_s = kept[i].by_by_norm_s;
        const vector by_by_atan2_norm_s_abs_g0 = kept[i].by_by_atan2_norm_s_abs_g0;
        const vector by_by_t_ratio = kept[i].by_by_t_ratio;
        const vector by_by_log_det_series = kept[i].by_by_log_det_series;
        const vector by_log_det = kept[i].by_log_det;
        const vector by_t_2 = kept[i].by_t_2;
        const vector ratio_5 = kept[i].ratio_5;
        const vector_mask its_near = norm_s_squared < 0.249287;
        const vector_mask is_small = g0 < 0.0;
        const vector by_log_det_near = vector_select(its_near, phi, vector_of(0.0));
        const vector by_t_over_norm_s_near = vector_select(its_near, by_t_over_norm_s, vector_of(0.0));
        const vector by_log_det_series = norm_s_squared * by_log_det_near;
        const vector by_norm_s_squared = vector_select(its_near, vector_of(0.0), by_norm_s_ratio) + log_det_series
            * by_log_det_near + 4.011440628672975 * vector_select(its_near, by_t_over_norm_s_near *
            t_over_norm_s_near_slope + by_log_det_series * log_det_series_slope, vector_of(0.0));
        const vector product_2 = 2.0 * by_norm_s_squared;
        const vector by_g3 = g3 * product_2 - scale * phi_product;
        const vector by_g3_ratio = by_g3 / row_length;
        const vector norm_s_product_2 = norm_s * ratio_2;
        const vector by_abs_g0 = -norm_s_product_2;
        const vector by_g0 = vector_select(is_small, norm_s_product_2, by_abs_g0);
        const vector by_g0_ratio = by_g0 / row_length;
        const vector by_g2 = g2 * product_2 - scale * phi_product_2;
        const vector by_g2_ratio = by_g2 / row_length;
        const vector by_g1 = g1 * product_2 - scale * phi_product_3;
        const vector by_g1_ratio = by_g1 / row_length;
        const vector gap_5 = ratio_2 * gap - 2.0 * (by_norm_s_ratio * by_by_norm_s) - by_t * by_by_t_ratio -
            t_ratio * by_t_2;
        const vector by_norm_s_2 = gap_5 + abs_g0 * ratio_5;
        const vector product_7 = ratio_2 * by_by_atan2_norm_s_abs_g0;
        const vector by_log_det_near_2 = vector_select(its_near, by_log_det, vector_of(0.0));
        const vector total_14 = by_log_det_near * by_by_log_det_series + vector_select(its_near, vector_of(0.0),
            by_norm_s_2 / norm_s_product - product_7) + log_det_series * by_log_det_near_2;
        kept[i].by_log_det_near = by_log_det_near;
        kept[i].by_t_over_norm_s_near = by_t_over_norm_s_near;
        kept[i].by_log_det_series = by_log_det_series;
        kept[i].product_2 = product_2;
        kept[i].by_g3_ratio = by_g3_ratio;
        kept[i].by_g0_ratio = by_g0_ratio;
        kept[i].by_g2_ratio = by_g2_ratio;
        kept[i].by_g1_ratio = by_g1_ratio;
        kept[i].product_7 = product_7;
        kept[i].by_log_det_near_2 = by_log_det_near_2;
        kept[i].total_14 = total_14;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector row_length = kept[i].row_length;
        const vector g3 = kept[i].g3;
        const vector g1 = kept[i].g1;
        const vector g2 = kept[i].g2;
        const vector norm_s_squared = kept[i].norm_s_squared;
        const vector g0 = kept[i].g0;
        const vector abs_g0 = kept[i].abs_g0;
        const vector near_chosen = kept[i].near_chosen;
        const vector norm_s = kept[i].norm_s;
        const vector scale = kept[i].scale;
        const vector phi_product = kept[i].phi_product;
        const vector phi_product_2 = kept[i].phi_product_2;
        const vector phi_product_3 = kept[i].phi_product_3;
        const vector ratio_2 = kept[i].ratio_2;
        const vector by_log_det_near = kept[i].by_log_det_near;
        const vector by_t_over_norm_s_near = kept[i].by_t_over_norm_s_near;
        const vector t_over_norm_s_near_slope = kept[i].t_over_norm_s_near_slope;
        const vector by_log_det_series = kept[i].by_log_det_series;
        const vector log_det_series_slope = kept[i].log_det_series_slope;
        const vector product_2 = kept[i].product_2;
        const vector by_g3_ratio = kept[i].by_g3_ratio;
        const vector by_g0_ratio = kept[i].by_g0_ratio;
        const vector by_g2_ratio = kept[i].by_g2_ratio;
        const vector by_g1_ratio = kept[i].by_g1_ratio;
        const vector product_3 = kept[i].product_3;
        const vector by_by_row_length = kept[i].by_by_row_length;
        const vector by_by_g2 = kept[i].by_by_g2;
        const vector by_by_g1 = kept[i].by_by_g1;
        const vector by_by_g3 = kept[i].by_by_g3;
        const vector by_by_norm_s_squared = kept[i].by_by_norm_s_squared;
        const vector by_by_norm_s = kept[i].by_by_norm_s;
        const vector near_chosen_3 = kept[i].near_chosen_3;
        const vector by_by_scale = kept[i].by_by_scale;
        const vector by_v1 = kept[i].by_v1;
        const vector by_v2 = kept[i].by_v2;
        const vector by_v0 = kept[i].by_v0;
        const vector by_t_over_norm_s_2 = kept[i].by_t_over_norm_s_2;
        const vector ratio_5 = kept[i].ratio_5;
        const vector product_7 = kept[i].product_7;
        const vector by_log_det_near_2 = kept[i].by_log_det_near_2;
        const vector total_14 = kept[i].total_14;
        const vector_mask its_near = norm_s_squared < 0.249287;
        const vector_mask is_small = g0 < 0.0;
        const vector by_row_length = -(g0 * by_g0_ratio) - g3 * by_g3_ratio - g2 * by_g2_ratio - g1 * by_g1_ratio;
        const vector ratio_3 = by_row_length / product_3;
        const vector by_log_det_series_slope = by_log_det_series * near_chosen_3;
        const vector log_det_series_slope_slope = vector_polynomial_log_det_series_slope_slope(near_chosen);
        const vector by_t_over_norm_s_near_slope = by_t_over_norm_s_near * near_chosen_3;
        const vector t_over_norm_s_near_slope_slope =
            vector_polynomial_t_over_norm_s_near_slope_slope(near_chosen);
        const vector by_t_over_norm_s_near_2 = vector_select(its_near, by_t_over_norm_s_2, vector_of(0.0));
        const vector by_log_det_series_2 = by_log_det_near * by_by_norm_s_squared + norm_s_squared *
            by_log_det_near_2;
        const vector near_chosen_4 = vector_select(its_near, by_log_det_series_slope * log_det_series_slope_slope
            + by_t_over_norm_s_near_slope * t_over_norm_s_near_slope_slope + t_over_norm_s_near_slope *
            by_t_over_norm_s_near_2 + log_det_series_slope * by_log_det_series_2, vector_of(0.0));
        const vector by_norm_s_squared_2 = total_14 + 4.011440628672975 * near_chosen_4;
        const vector product_8 = 2.0 * by_norm_s_squared_2;
        const vector by_g2_2 = product_2 * by_by_g2 - by_g2_ratio * by_by_row_length - phi_product_2 * by_by_scale
            + scale * by_v1 + g2 * product_8;
        const vector by_g2_ratio_2 = by_g2_2 / row_length;
        const vector norm_s_product_3 = norm_s * ratio_5;
        const vector gap_7 = ratio_2 * by_by_norm_s - abs_g0 * (2.0 * product_7);
        const vector by_abs_g0_2 = gap_7 - norm_s_product_3;
        const vector by_g0_2 = vector_select(is_small, norm_s_product_3 - gap_7, by_abs_g0_2) - by_g0_ratio *
            by_by_row_length;
        const vector by_g0_ratio_2 = by_g0_2 / row_length;
        const vector by_g3_2 = product_2 * by_by_g3 - by_g3_ratio * by_by_row_length - phi_product * by_by_scale +
            scale * by_v2 + g3 * product_8;
        const vector by_g3_ratio_2 = by_g3_2 / row_length;
        const vector by_g1_2 = product_2 * by_by_g1 - by_g1_ratio * by_by_row_length - phi_product_3 * by_by_scale
            + scale * by_v0 + g1 * product_8;
        const vector by_g1_ratio_2 = by_g1_2 / row_length;
        kept[i].ratio_3 = ratio_3;
        kept[i].by_g2_ratio_2 = by_g2_ratio_2;
        kept[i].by_g0_ratio_2 = by_g0_ratio_2;
        kept[i].by_g3_ratio_2 = by_g3_ratio_2;
        kept[i].by_g1_ratio_2 = by_g1_ratio_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector total_2 = kept[i].total_2;
        const vector g3 = kept[i].g3;
        const vector g1 = kept[i].g1;
        const vector g2 = kept[i].g2;
        const vector g0 = kept[i].g0;
        const vector by_g3_ratio = kept[i].by_g3_ratio;
        const vector by_g0_ratio = kept[i].by_g0_ratio;
        const vector by_g2_ratio = kept[i].by_g2_ratio;
        const vector by_g1_ratio = kept[i].by_g1_ratio;
        const vector product_3 = kept[i].product_3;
        const vector ratio_3 = kept[i].ratio_3;
        const vector by_by_row_length = kept[i].by_by_row_length;
        const vector by_by_g2 = kept[i].by_by_g2;
        const vector by_by_g0 = kept[i].by_by_g0;
        const vector by_by_g1 = kept[i].by_by_g1;
        const vector by_by_g3 = kept[i].by_by_g3;
        const vector by_g2_ratio_2 = kept[i].by_g2_ratio_2;
        const vector by_g0_ratio_2 = kept[i].by_g0_ratio_2;
        const vector by_g3_ratio_2 = kept[i].by_g3_ratio_2;
        const vector by_g1_ratio_2 = kept[i].by_g1_ratio_2;
        const vector_mask is_small_2 = total_2 == 0.0;
        const vector gap_6 = vector_select(is_small_2, vector_of(0.0), -2.0 * (ratio_3 * by_by_row_length)) -
            by_g1_ratio * by_by_g1;
        const vector gap_8 = gap_6 - by_g2_ratio * by_by_g2 - by_g3_ratio * by_by_g3 - by_g0_ratio * by_by_g0 - g0
            * by_g0_ratio_2;
        const vector by_row_length_2 = gap_8 - g3 * by_g3_ratio_2 - g2 * by_g2_ratio_2 - g1 * by_g1_ratio_2;
        const vector product_9 = 2.0 * vector_select(is_small_2, vector_of(0.0), by_row_length_2 / product_3);
        kept[i].product_9 = product_9;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 19 * (size_t)near[i];
        const vector *slope_bar = points + 19 * (size_t)near[i] + 9 + 1;
        const vector square0 = kept[i].square0;
        const vector square1 = kept[i].square1;
        const vector largest = kept[i].largest;
        const vector square2 = kept[i].square2;
        const vector largest_2 = kept[i].largest_2;
        const vector square3 = kept[i].square3;
        const vector row_12 = kept[i].row_12;
        const vector row_10 = kept[i].row_10;
        const vector row_11 = kept[i].row_11;
        const vector row_9 = kept[i].row_9;
        const vector total_2 = kept[i].total_2;
        const vector v0 = kept[i].v0;
        const vector v1 = kept[i].v1;
        const vector v2 = kept[i].v2;
        const vector by_g3_ratio = kept[i].by_g3_ratio;
        const vector by_g0_ratio = kept[i].by_g0_ratio;
        const vector by_g2_ratio = kept[i].by_g2_ratio;
        const vector by_g1_ratio = kept[i].by_g1_ratio;
        const vector ratio_3 = kept[i].ratio_3;
        const vector by_by_row_11 = kept[i].by_by_row_11;
        const vector by_by_row_10 = kept[i].by_by_row_10;
        const vector by_by_row_12 = kept[i].by_by_row_12;
        const vector by_by_row_9 = kept[i].by_by_row_9;
        const vector phi_product_4 = kept[i].phi_product_4;
        const vector phi_product_5 = kept[i].phi_product_5;
        const vector phi_product_6 = kept[i].phi_product_6;
        const vector by_log_det = kept[i].by_log_det;
        const vector by_g2_ratio_2 = kept[i].by_g2_ratio_2;
        const vector by_g0_ratio_2 = kept[i].by_g0_ratio_2;
        const vector by_g3_ratio_2 = kept[i].by_g3_ratio_2;
        const vector by_g1_ratio_2 = kept[i].by_g1_ratio_2;
        const vector product_9 = kept[i].product_9;
        const vector x0 = X[0];
        const vector x1 = X[1];
        const vector x2 = X[2];
        const vector x3 = X[3];
        const vector x4 = X[4];
        const vector x5 = X[5];
        const vector x6 = X[6];
        const vector x7 = X[7];
        const vector x8 = X[8];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector x2_bar = slope_bar[2];
        const vector x3_bar = slope_bar[3];
        const vector x4_bar = slope_bar[4];
        const vector x5_bar = slope_bar[5];
        const vector x6_bar = slope_bar[6];
        const vector x7_bar = slope_bar[7];
        const vector x8_bar = slope_bar[8];
        const vector_mask is_less = square0 < square1;
        const vector_mask is_less_2 = largest < square2;
        const vector_mask is_less_3 = largest_2 < square3;
        const vector_mask is_small_2 = total_2 == 0.0;
        const vector product_4 = 2.0 * vector_select(is_small_2, vector_of(0.0), ratio_3);
        const vector by_row_12 = by_g3_ratio + row_12 * product_4;
        const vector by_square3 = vector_select(is_less_3, by_row_12, vector_of(0.0));
        const vector by_row_11 = by_g2_ratio + row_11 * product_4;
        const vector by_row_7 = vector_select(is_less_3, vector_of(0.0), by_row_11);
        const vector by_square2 = vector_select(is_less_2, by_row_7, vector_of(0.0));
        const vector by_row_9 = by_g0_ratio + row_9 * product_4;
        const vector by_row_5 = vector_select(is_less_3, vector_of(0.0), by_row_9);
        const vector by_row = vector_select(is_less_2, vector_of(0.0), by_row_5);
        const vector by_square0 = vector_select(is_less, vector_of(0.0), by_row);
        const vector by_row_10 = by_g1_ratio + row_10 * product_4;
        const vector by_row_6 = vector_select(is_less_3, vector_of(0.0), by_row_10);
        const vector by_row_2 = vector_select(is_less_2, vector_of(0.0), by_row_6);
        const vector by_square1 = vector_select(is_less, by_row_2, vector_of(0.0));
        const vector by_R0_0 = -by_square3 - by_square2 + (by_square0 + by_square1);
        const vector by_row_3 = vector_select(is_less_2, vector_of(0.0), by_row_7);
        const vector total_7 = vector_select(is_less_2, by_row_5, vector_of(0.0)) + vector_select(is_less,
            vector_of(0.0), by_row_3);
        const vector by_row_8 = vector_select(is_less_3, vector_of(0.0), by_row_12);
        const vector by_row_4 = vector_select(is_less_2, vector_of(0.0), by_row_8);
        const vector total_8 = vector_select(is_less, by_row_4, vector_of(0.0)) + vector_select(is_less_3,
            by_row_10, vector_of(0.0));
        const vector by_R0_2 = total_7 + total_8;
        const vector total_9 = vector_select(is_less, by_row_3, vector_of(0.0)) + vector_select(is_less_2,
            by_row_6, vector_of(0.0));
        const vector total_10 = vector_select(is_less_3, by_row_9, vector_of(0.0)) + vector_select(is_less,
            vector_of(0.0), by_row_4);
        const vector by_R0_1 = total_9 - total_10;
        const vector by_row_11_2 = product_4 * by_by_row_11 + by_g2_ratio_2 + row_11 * product_9;
        const vector by_row_7_2 = vector_select(is_less_3, vector_of(0.0), by_row_11_2);
        const vector by_row_3_2 = vector_select(is_less_2, vector_of(0.0), by_row_7_2);
        const vector by_row_10_2 = product_4 * by_by_row_10 + by_g1_ratio_2 + row_10 * product_9;
        const vector by_row_6_2 = vector_select(is_less_3, vector_of(0.0), by_row_10_2);
        const vector total_15 = vector_select(is_less, by_row_3_2, vector_of(0.0)) + vector_select(is_less_2,
            by_row_6_2, vector_of(0.0));
        const vector by_row_9_2 = product_4 * by_by_row_9 + by_g0_ratio_2 + row_9 * product_9;
        const vector by_row_12_2 = product_4 * by_by_row_12 + by_g3_ratio_2 + row_12 * product_9;
        const vector by_row_8_2 = vector_select(is_less_3, vector_of(0.0), by_row_12_2);
        const vector by_row_4_2 = vector_select(is_less_2, vector_of(0.0), by_row_8_2);
        const vector total_16 = vector_select(is_less_3, by_row_9_2, vector_of(0.0)) + vector_select(is_less,
            vector_of(0.0), by_row_4_2);
        const vector by_R0_1_2 = total_15 - total_16;
        const vector by_row_5_2 = vector_select(is_less_3, vector_of(0.0), by_row_9_2);
        const vector total_17 = vector_select(is_less_2, by_row_5_2, vector_of(0.0)) + vector_select(is_less,
            vector_of(0.0), by_row_3_2);
        const vector total_18 = vector_select(is_less, by_row_4_2, vector_of(0.0)) + vector_select(is_less_3,
            by_row_10_2, vector_of(0.0));
        const vector by_R0_2_2 = total_17 + total_18;
        const vector by_square3_2 = vector_select(is_less_3, by_row_12_2, vector_of(0.0));
        const vector by_square2_2 = vector_select(is_less_2, by_row_7_2, vector_of(0.0));
        const vector by_row_13 = vector_select(is_less_2, vector_of(0.0), by_row_5_2);
        const vector by_square0_2 = vector_select(is_less, vector_of(0.0), by_row_13);
        const vector by_row_2_2 = vector_select(is_less_2, vector_of(0.0), by_row_6_2);
        const vector by_square1_2 = vector_select(is_less, by_row_2_2, vector_of(0.0));
        const vector by_R0_0_2 = -by_square3_2 - by_square2_2 + (by_square0_2 + by_square1_2);
        const vector by_R1_1 = by_square0 + (by_square2 - by_square3 - by_square1);
        const vector by_R1_0 = total_10 + total_9;
        const vector total_20 = vector_select(is_less_2, by_row_8, vector_of(0.0)) + vector_select(is_less_3,
            by_row_11, vector_of(0.0));
        const vector total_21 = vector_select(is_less, by_row, vector_of(0.0)) + vector_select(is_less,
            vector_of(0.0), by_row_2);
        const vector by_R1_2 = total_20 - total_21;
        const vector total_22 = vector_select(is_less_2, by_row_8_2, vector_of(0.0)) + vector_select(is_less_3,
            by_row_11_2, vector_of(0.0));
        const vector total_23 = vector_select(is_less, by_row_13, vector_of(0.0)) + vector_select(is_less,
            vector_of(0.0), by_row_2_2);
        const vector by_R1_2_2 = total_22 - total_23;
        const vector by_R1_0_2 = total_16 + total_15;
        const vector by_R1_1_2 = by_square0_2 + (by_square2_2 - by_square3_2 - by_square1_2);
        const vector by_R2_2 = by_square0 + (by_square3 - by_square2 - by_square1);
        const vector by_R2_0 = total_8 - total_7;
        const vector by_R2_1 = total_20 + total_21;
        const vector by_R2_1_2 = total_22 + total_23;
        const vector by_R2_0_2 = total_18 - total_17;
        const vector by_R2_2_2 = by_square0_2 + (by_square3_2 - by_square2_2 - by_square1_2);
        const vector by_log_det_product = 0.5 * by_log_det;
        const vector gap_9 = phi_product_4 - v0 * by_log_det_product;
        const vector gap_10 = phi_product_5 - v1 * by_log_det_product;
        const vector gap_11 = phi_product_6 - v2 * by_log_det_product;
        sums[0] = sums[0] + by_R0_0 * x0_bar + by_R0_2 * x2_bar + by_R0_1 * x1_bar + x1 * by_R0_1_2 + x2 *
                by_R0_2_2 + x0 * by_R0_0_2;
        sums[1] = sums[1] + by_R1_1 * x1_bar + by_R1_0 * x0_bar + by_R1_2 * x2_bar + x2 * by_R1_2_2 + x0 *
                by_R1_0_2 + x1 * by_R1_1_2;
        sums[2] = sums[2] + by_R2_2 * x2_bar + by_R2_0 * x0_bar + by_R2_1 * x1_bar + x1 * by_R2_1_2 + x0 *
                by_R2_0_2 + x2 * by_R2_2_2;
        sums[3] = sums[3] + by_R0_0 * x3_bar + by_R0_2 * x5_bar + by_R0_1 * x4_bar + x4 * by_R0_1_2 + x5 *
                by_R0_2_2 + x3 * by_R0_0_2;
        sums[4] = sums[4] + by_R1_1 * x4_bar + by_R1_0 * x3_bar + by_R1_2 * x5_bar + x5 * by_R1_2_2 + x3 *
                by_R1_0_2 + x4 * by_R1_1_2;
        sums[5] = sums[5] + by_R2_2 * x5_bar + by_R2_0 * x3_bar + by_R2_1 * x4_bar + x4 * by_R2_1_2 + x3 *
                by_R2_0_2 + x5 * by_R2_2_2;
        sums[6] = sums[6] + by_R0_0 * x6_bar + by_R0_2 * x8_bar + by_R0_1 * x7_bar + x7 * by_R0_1_2 + x8 *
                by_R0_2_2 + x6 * by_R0_0_2;
        sums[7] = sums[7] + by_R1_1 * x7_bar + by_R1_0 * x6_bar + by_R1_2 * x8_bar + x8 * by_R1_2_2 + x6 *
                by_R1_0_2 + x7 * by_R1_1_2;
        sums[8] = sums[8] + by_R2_2 * x8_bar + by_R2_0 * x6_bar + by_R2_1 * x7_bar + x7 * by_R2_1_2 + x6 *
                by_R2_0_2 + x8 * by_R2_2_2;
        sums[9] = sums[9] + by_log_det;
        sums[10] = sums[10] + v0 * gap_9;
        sums[11] = sums[11] + v0 * gap_10 + v1 * gap_9;
        sums[12] = sums[12] + v0 * gap_11 + v2 * gap_9;
        sums[13] = sums[13] + v1 * gap_10;
        sums[14] = sums[14] + v1 * gap_11 + v2 * gap_10;
        sums[15] = sums[15] + v2 * gap_11;
    }
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp(
    const vector *mu, const vector *W, const vector *amplitude, const vector *sums, vector *mu_bar, vector *W_bar, vector *amplitude_bar) {
    (void)mu;
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
    const vector sum15 = sums[15];
    const vector product = 2.0 * sum10;
    const vector product_2 = 2.0 * sum13;
    const vector product_3 = 2.0 * sum15;
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = its_amplitude * sum1;
    mu_bar[2] = its_amplitude * sum2;
    mu_bar[3] = its_amplitude * sum3;
    mu_bar[4] = its_amplitude * sum4;
    mu_bar[5] = its_amplitude * sum5;
    mu_bar[6] = its_amplitude * sum6;
    mu_bar[7] = its_amplitude * sum7;
    mu_bar[8] = its_amplitude * sum8;
    W_bar[0] = its_amplitude * (W0_0 * product + W0_1 * sum11 + W0_2 * sum12);
    W_bar[1] = its_amplitude * (W0_0 * sum11 + W0_1 * product_2 + W0_2 * sum14);
    W_bar[2] = its_amplitude * (W0_0 * sum12 + W0_1 * sum14 + W0_2 * product_3);
    W_bar[3] = its_amplitude * (W1_0 * product + W1_1 * sum11 + W1_2 * sum12);
    W_bar[4] = its_amplitude * (W1_0 * sum11 + W1_1 * product_2 + W1_2 * sum14);
    W_bar[5] = its_amplitude * (W1_0 * sum12 + W1_1 * sum14 + W1_2 * product_3);
    W_bar[6] = its_amplitude * (W2_0 * product + W2_1 * sum11 + W2_2 * sum12);
    W_bar[7] = its_amplitude * (W2_0 * sum11 + W2_1 * product_2 + W2_2 * sum14);
    W_bar[8] = its_amplitude * (W2_0 * sum12 + W2_1 * sum14 + W2_2 * product_3);
    amplitude_bar[0] = sum9;
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

/* Scratch memory: 19 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t so3_matrix_splats_work(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES - 1) / LANES, blocks = (points + 2 - 1) / 2;
    const size_t places = 0 * ((splat_count + LANES - 1) / LANES + (blocks + LANES - 1) / LANES);
    return (points * 19 + places + 1) * LANES + 25 * splat_count;
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
    return work_points(work) + (count + LANES - 1) / LANES * 19;
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
    vector own_mu[9], own_W[9], own_amplitude[1], S[25];
    vector_rows(mu, splat_count, start, 9, own_mu);
    vector_rows(W, splat_count, start, 9, own_W);
    vector_rows(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants(own_mu, own_W, own_amplitude, S);
    vector_to_rows(S, constants, splat_count, start, 25, 25);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void so3_matrix_splats(
    size_t count, size_t splat_count, const double *SO3_MATRIX_RESTRICT x, const double *SO3_MATRIX_RESTRICT mu, const double *SO3_MATRIX_RESTRICT W, const double *SO3_MATRIX_RESTRICT amplitude, const double *SO3_MATRIX_RESTRICT width,
    double *SO3_MATRIX_RESTRICT value, double *SO3_MATRIX_RESTRICT gradient, double *SO3_MATRIX_RESTRICT work, int threads) {
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
            vector at[2][9], X[2 * 9], grad[3];
            vector value_sum[2] = {ZERO}, slope_sum[2 * 9] = {ZERO};
            double place[9 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 9, at[b]);
                pair_features(at[b], X + 9 * b);
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
                pair_gradient(at[b], slope_sum + 9 * b, grad);
                vector_to_rows(value_sum + b, value, count, start + b * LANES, 1, 1);
                vector_to_rows(grad, gradient, count, start + b * LANES, 3, 3);
            }
        }
        restore_denormals(mode);
    }
}

void so3_matrix_splats_value(
    size_t count, size_t splat_count, const double *SO3_MATRIX_RESTRICT x, const double *SO3_MATRIX_RESTRICT mu, const double *SO3_MATRIX_RESTRICT W, const double *SO3_MATRIX_RESTRICT amplitude, const double *SO3_MATRIX_RESTRICT width,
    double *SO3_MATRIX_RESTRICT value, double *SO3_MATRIX_RESTRICT work, int threads) {
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
            vector at[9], X[2 * 9], value_sum[2] = {ZERO};
            double place[9 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 9, at);
                pair_features(at, X + 9 * b);
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
    vector at[9], grad_bar[3], slope_bar[9];
    vector_rows(x, count, start, 9, at);
    vector_rows(gradient_bar, count, start, 3, grad_bar);
    vector_rows(value_bar, count, start, 1, point + 9);
    pair_features(at, point);
    pair_gradient_vjp(at, grad_bar, slope_bar);
    for (int i = 0; i < 9; ++i) point[9 + 1 + i] = slope_bar[i];
    vector_end(count, start, 9 + 1, point + 9);
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums(const vector *points, const uint32_t *near, size_t size, const double *S, double *sums) {
    vector sum[16] = {ZERO};
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
    sums[15] += vector_sum(sum[15]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void so3_matrix_splats_vjp(
    size_t count, size_t splat_count, const double *SO3_MATRIX_RESTRICT x, const double *SO3_MATRIX_RESTRICT mu, const double *SO3_MATRIX_RESTRICT W, const double *SO3_MATRIX_RESTRICT amplitude, const double *SO3_MATRIX_RESTRICT width, const double *SO3_MATRIX_RESTRICT value_bar, const double *SO3_MATRIX_RESTRICT gradient_bar,
    double *SO3_MATRIX_RESTRICT mu_bar, double *SO3_MATRIX_RESTRICT W_bar, double *SO3_MATRIX_RESTRICT amplitude_bar, double *SO3_MATRIX_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES - 1) / LANES;
    const size_t chunk = 131072 / (19 * sizeof(vector)) + 1;
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
                double place[9 + 1];
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
            splat_points(count, block * LANES, x, value_bar, gradient_bar, points + 19 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            double sums[LANES][16] = {{0}};
            uint32_t near[131072 / (19 * sizeof(vector)) + 2];
            vector own_mu[9], own_W[9], own_amplitude[1], own_sums[16], bars[19];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const double *reach = width ? splat_at(splats, k) + 9 * LANES : NULL;
                    const size_t some = blocks_near(mu + 9 * k, reach, places, first, first + size, near);
                    splat_sums(points + 19 * first, near, some, constants + 25 * k, sums[k - start]);
                }
            }
            vector_rows(mu, end, start, 9, own_mu);
            vector_rows(W, end, start, 9, own_W);
            vector_rows(amplitude, end, start, 1, own_amplitude);
            vector_rows(sums[0], LANES, 0, 16, own_sums);
            pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 9, bars + 9 + 9);
            vector_to_rows(bars, mu_bar, end, start, 9, 9);
            vector_to_rows(bars + 9, W_bar, end, start, 9, 9);
            vector_to_rows(bars + 9 + 9, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void so3_matrix_splats_rows(
    size_t count, size_t splat_count, const double *SO3_MATRIX_RESTRICT x, const double *SO3_MATRIX_RESTRICT mu, const double *SO3_MATRIX_RESTRICT W, const double *SO3_MATRIX_RESTRICT amplitude, const double *SO3_MATRIX_RESTRICT value_bar, const double *SO3_MATRIX_RESTRICT gradient_bar,
    double *SO3_MATRIX_RESTRICT rows, double *SO3_MATRIX_RESTRICT work, int threads) {
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
            vector point[19];
            splat_points(count, block * LANES, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector own_mu[9], own_W[9], own_amplitude[1], own_sums[16] = {ZERO}, bars[19];
                for (int i = 0; i < 9; ++i) own_mu[i] = vector_of(mu[9 * k + i]);
                for (int i = 0; i < 9; ++i) own_W[i] = vector_of(W[9 * k + i]);
                own_amplitude[0] = vector_of(amplitude[k]);
                pair_backward(1, point, &only, constants + 25 * k, own_sums);
                pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 9, bars + 9 + 9);
                vector_to_rows(bars, rows + 19 * k, count, block * LANES, 19, 19 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

double so3_matrix_splats_order(
    size_t count, size_t splat_count, const double *SO3_MATRIX_RESTRICT x, const double *SO3_MATRIX_RESTRICT mu, const double *SO3_MATRIX_RESTRICT amplitude, const double *SO3_MATRIX_RESTRICT width,
    double limit, size_t *SO3_MATRIX_RESTRICT order, double *SO3_MATRIX_RESTRICT work) {
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

/* Of degree 6, within 2^-30 of that of double precision. */
INLINE vector_f vector_polynomial_log_det_series_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return 0.33333333360654344f + x * 0.030468384794974636f + x2 * (0.004187186052703318f + x *
        0.0006798423432636281f) + x4 * (0.00012869008203200835f + x * 1.4352383872053921e-05f + x2 *
        1.0146648022958735e-05f);
}

/* Of degree 5, within 2^-27 of that of double precision. */
INLINE vector_f vector_polynomial_t_over_norm_s_near_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return 1.9999999916408444f + x * 0.08309625685133959f + x2 * (0.009314899571001777f + x *
        0.001410660168357637f) + x4 * (0.0001850457232808171f + x * 8.1767340923012e-05f);
}

/* Of degree 7, within 2^-30 of that of double precision. */
INLINE vector_f vector_polynomial_t_over_norm_s_near_slope_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return 0.08309566660530374f + x * 0.0186432102329603f + x2 * (0.004149402027001096f + x *
        0.0009398850567115093f) + x4 * (0.00021071714765224622f + x * 5.936713146666543e-05f + x2 *
        (1.5937893933276167e-06f + x * 7.904358196252664e-06f));
}

/* Of degree 7, within 2^-29 of that of double precision. */
INLINE vector_f vector_polynomial_log_det_series_slope_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2;
    return 0.030468411075324144f + x * 0.00837355342611542f + x2 * (0.0020466142655597187f + x *
        0.0004893663510207316f) + x4 * (0.00011341332759154923f + x * 3.308965514831338e-05f + x2 *
        (7.033240749837545e-07f + x * 4.5653796914644905e-06f));
}

/* Of degree 8, within 2^-29 of that of double precision. */
INLINE vector_f vector_polynomial_log_det_series_slope_slope_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.008373548929811502f + x * 0.00409341251393332f + x2 * (0.0014659690505062421f + x *
        0.0004642399977336899f) + x4 * (0.00013949898494014724f + x * 3.562723292198236e-05f + x2 *
        (1.715338253936205e-05f + x * -2.4083903642194996e-06f)) + x8 * 3.123850968155648e-06f;
}

/* Of degree 8, within 2^-30 of that of double precision. */
INLINE vector_f vector_polynomial_t_over_norm_s_near_slope_slope_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return 0.01864320252205291f + x * 0.008299119649304472f + x2 * (0.0028160002314375336f + x *
        0.0008610440047704579f) + x4 * (0.0002522458975272004f + x * 6.363291448779077e-05f + x2 *
        (2.9672627598761578e-05f + x * -3.950664599532621e-06f)) + x8 * 5.308935243478486e-06f;
}

/* What pairs read of points x. */
OUTLINE void pair_features_f(
    const vector_f *x, vector_f *X) {
    const vector_f x0 = x[0];
    const vector_f x1 = x[1];
    const vector_f x2 = x[2];
    const vector_f x3 = x[3];
    const vector_f x4 = x[4];
    const vector_f x5 = x[5];
    const vector_f x6 = x[6];
    const vector_f x7 = x[7];
    const vector_f x8 = x[8];
    X[0] = x0;
    X[1] = x1;
    X[2] = x2;
    X[3] = x3;
    X[4] = x4;
    X[5] = x5;
    X[6] = x6;
    X[7] = x7;
    X[8] = x8;
}

/* What pairs read of a splat, of some splats. */
OUTLINE void pair_constants_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, vector_f *S) {
    const vector_f mu0 = mu[0];
    const vector_f mu1 = mu[1];
    const vector_f mu2 = mu[2];
    const vector_f mu3 = mu[3];
    const vector_f mu4 = mu[4];
    const vector_f mu5 = mu[5];
    const vector_f mu6 = mu[6];
    const vector_f mu7 = mu[7];
    const vector_f mu8 = mu[8];
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
    const vector_f M0_0 = W0_0 * W0_0 + W1_0 * W1_0 + W2_0 * W2_0;
    const vector_f M0_1 = W0_0 * W0_1 + W1_0 * W1_1 + W2_0 * W2_1;
    const vector_f M0_2 = W0_0 * W0_2 + W1_0 * W1_2 + W2_0 * W2_2;
    const vector_f M1_1 = W0_1 * W0_1 + W1_1 * W1_1 + W2_1 * W2_1;
    const vector_f M1_2 = W0_1 * W0_2 + W1_1 * W1_2 + W2_1 * W2_2;
    const vector_f M2_2 = W0_2 * W0_2 + W1_2 * W1_2 + W2_2 * W2_2;
    S[0] = mu0;
    S[1] = mu1;
    S[2] = mu2;
    S[3] = mu3;
    S[4] = mu4;
    S[5] = mu5;
    S[6] = mu6;
    S[7] = mu7;
    S[8] = mu8;
    S[9] = W0_0;
    S[10] = W0_1;
    S[11] = W0_2;
    S[12] = W1_0;
    S[13] = W1_1;
    S[14] = W1_2;
    S[15] = W2_0;
    S[16] = W2_1;
    S[17] = W2_2;
    S[18] = its_amplitude;
    S[19] = M0_0;
    S[20] = M0_1;
    S[21] = M0_2;
    S[22] = M1_1;
    S[23] = M1_2;
    S[24] = M2_2;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_value_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values) {
    struct { vector_f row_10, row_11, row_12, row_9, row_length, g1, g2, g3, norm_s_squared, near_chosen,
            norm_s, g0, atan2_norm_s_abs_g0, t_ratio, log_det, phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 25 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float mu7 = S[7];
        const float mu8 = S[8];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 9 * b;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f x4 = X[4];
            const vector_f x5 = X[5];
            const vector_f x6 = X[6];
            const vector_f x7 = X[7];
            const vector_f x8 = X[8];
            const vector_f R2_2 = x2 * mu2 + x5 * mu5 + x8 * mu8;
            const vector_f R1_1 = x1 * mu1 + x4 * mu4 + x7 * mu7;
            const vector_f R0_0 = x0 * mu0 + x3 * mu3 + x6 * mu6;
            const vector_f R0_0_total = 1.0f + R0_0;
            const vector_f square0 = R2_2 + (R1_1 + R0_0_total);
            const vector_f square1 = R0_0_total - R1_1 - R2_2;
            const vector_mask_f is_less = square0 < square1;
            const vector_f largest = vector_select_f(is_less, square1, square0);
            const vector_f square2 = 1.0f + R1_1 - R0_0 - R2_2;
            const vector_mask_f is_less_2 = largest < square2;
            const vector_f largest_2 = vector_select_f(is_less_2, square2, largest);
            const vector_f square3 = 1.0f + R2_2 - R0_0 - R1_1;
            const vector_mask_f is_less_3 = largest_2 < square3;
            const vector_f R0_2 = x2 * mu0 + x5 * mu3 + x8 * mu6;
            const vector_f R2_0 = x0 * mu2 + x3 * mu5 + x6 * mu8;
            const vector_f R0_2_total = R0_2 + R2_0;
            const vector_f R0_1 = x1 * mu0 + x4 * mu3 + x7 * mu6;
            const vector_f R1_0 = x0 * mu1 + x3 * mu4 + x6 * mu7;
            const vector_f R0_1_total = R0_1 + R1_0;
            const vector_f R2_1 = x1 * mu2 + x4 * mu5 + x7 * mu8;
            const vector_f R1_2 = x2 * mu1 + x5 * mu4 + x8 * mu7;
            const vector_f R2_1_gap = R2_1 - R1_2;
            const vector_f row_2 = vector_select_f(is_less, square1, R2_1_gap);
            const vector_f row_6 = vector_select_f(is_less_2, R0_1_total, row_2);
            const vector_f row_10 = vector_select_f(is_less_3, R0_2_total, row_6);
            const vector_f R1_2_total = R1_2 + R2_1;
            const vector_f R0_2_gap = R0_2 - R2_0;
            const vector_f row_3 = vector_select_f(is_less, R0_1_total, R0_2_gap);
            const vector_f row_7 = vector_select_f(is_less_2, square2, row_3);
            const vector_f row_11 = vector_select_f(is_less_3, R1_2_total, row_7);
            const vector_f R1_0_gap = R1_0 - R0_1;
            const vector_f row_4 = vector_select_f(is_less, R0_2_total, R1_0_gap);
            const vector_f row_8 = vector_select_f(is_less_2, R1_2_total, row_4);
            const vector_f row_12 = vector_select_f(is_less_3, square3, row_8);
            const vector_f row = vector_select_f(is_less, R2_1_gap, square0);
            const vector_f row_5 = vector_select_f(is_less_2, R0_2_gap, row);
            const vector_f row_9 = vector_select_f(is_less_3, R1_0_gap, row_5);
            const vector_f row_length = sqrt_each_f(row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 *
                row_9);
            kept[k][b].row_10 = row_10;
            kept[k][b].row_11 = row_11;
            kept[k][b].row_12 = row_12;
            kept[k][b].row_9 = row_9;
            kept[k][b].row_length = row_length;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f row_10 = kept[k][b].row_10;
            const vector_f row_11 = kept[k][b].row_11;
            const vector_f row_12 = kept[k][b].row_12;
            const vector_f row_length = kept[k][b].row_length;
            const vector_f g1 = row_10 / row_length;
            const vector_f g2 = row_11 / row_length;
            const vector_f g3 = row_12 / row_length;
            kept[k][b].g1 = g1;
            kept[k][b].g2 = g2;
            kept[k][b].g3 = g3;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f row_9 = kept[k][b].row_9;
            const vector_f row_length = kept[k][b].row_length;
            const vector_f g1 = kept[k][b].g1;
            const vector_f g2 = kept[k][b].g2;
            const vector_f g3 = kept[k][b].g3;
            const vector_f norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
            const vector_mask_f its_near = norm_s_squared < 0.249287f;
            const vector_f norm_s = sqrt_each_f(vector_select_f(its_near, vector_of_f(1.0f), norm_s_squared));
            const vector_f g0 = row_9 / row_length;
            kept[k][b].norm_s_squared = norm_s_squared;
            kept[k][b].norm_s = norm_s;
            kept[k][b].g0 = g0;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f norm_s = kept[k][b].norm_s;
            const vector_f g0 = kept[k][b].g0;
            const vector_f abs_g0 = abs_each_f(g0);
            const vector_f atan2_norm_s_abs_g0 = atan2_each_f(norm_s, abs_g0);
            kept[k][b].atan2_norm_s_abs_g0 = atan2_norm_s_abs_g0;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f norm_s = kept[k][b].norm_s;
            const vector_f atan2_norm_s_abs_g0 = kept[k][b].atan2_norm_s_abs_g0;
            const vector_f t = 2.0f * atan2_norm_s_abs_g0;
            const vector_f t_ratio = t / norm_s;
            kept[k][b].t_ratio = t_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f norm_s_squared = kept[k][b].norm_s_squared;
            const vector_f t_ratio = kept[k][b].t_ratio;
            const vector_mask_f its_near = norm_s_squared < 0.249287f;
            const vector_f near_chosen = vector_select_f(its_near, 4.011440628672975f * norm_s_squared,
                vector_of_f(0.0f));
            const vector_f log_det_series = vector_polynomial_log_det_series_f(near_chosen);
            const vector_f log_det_near = norm_s_squared * log_det_series;
            const vector_f log_det = vector_select_f(its_near, log_det_near, 2.0f * log_each_f(0.5f * t_ratio));
            kept[k][b].near_chosen = near_chosen;
            kept[k][b].log_det = log_det;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 25 * near[k];
        const float W0_0 = S[9];
        const float W0_1 = S[10];
        const float W0_2 = S[11];
        const float W1_0 = S[12];
        const float W1_1 = S[13];
        const float W1_2 = S[14];
        const float W2_0 = S[15];
        const float W2_1 = S[16];
        const float W2_2 = S[17];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f g1 = kept[k][b].g1;
            const vector_f g2 = kept[k][b].g2;
            const vector_f g3 = kept[k][b].g3;
            const vector_f norm_s_squared = kept[k][b].norm_s_squared;
            const vector_f near_chosen = kept[k][b].near_chosen;
            const vector_f g0 = kept[k][b].g0;
            const vector_f t_ratio = kept[k][b].t_ratio;
            const vector_f log_det = kept[k][b].log_det;
            const vector_mask_f its_near = norm_s_squared < 0.249287f;
            const vector_f t_over_norm_s_near = vector_polynomial_t_over_norm_s_near_f(near_chosen);
            const vector_f t_over_norm_s = vector_select_f(its_near, t_over_norm_s_near, t_ratio);
            const vector_f scale = t_over_norm_s * vector_select_f(g0 < 0.0f, vector_of_f(-1.0f), vector_of_f(1.0f));
            const vector_f v0 = g1 * scale;
            const vector_f v1 = g2 * scale;
            const vector_f v2 = g3 * scale;
            const vector_f z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
            const vector_f z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
            const vector_f z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
            const vector_f log_det_gap = log_det - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
            const vector_f phi = exp_each_f(log_det_gap);
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 25 * near[k];
        const float amplitude = S[18];
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
    struct { vector_f square0, square1, largest, square2, largest_2, square3, row_10, row_11, row_12, row_9,
            total_2, row_length, g1, g2, g3, norm_s_squared, near_chosen, log_det_series, near_chosen_2, norm_s,
            g0, abs_g0, atan2_norm_s_abs_g0, t_ratio, product, log_det, chosen, scale, z0, z1, z2, phi, phi_2,
            phi_product, phi_product_2, phi_product_3, by_t_over_norm_s, total_3, by_t, ratio, by_g0_ratio,
            by_norm_s_squared, by_g3_ratio, by_g2_ratio, by_g1_ratio, product_3; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 25 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float mu7 = S[7];
        const float mu8 = S[8];
        for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 9 * b;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f x4 = X[4];
            const vector_f x5 = X[5];
            const vector_f x6 = X[6];
            const vector_f x7 = X[7];
            const vector_f x8 = X[8];
            const vector_f R2_2 = x2 * mu2 + x5 * mu5 + x8 * mu8;
            const vector_f R1_1 = x1 * mu1 + x4 * mu4 + x7 * mu7;
            const vector_f R0_0 = x0 * mu0 + x3 * mu3 + x6 * mu6;
            const vector_f R0_0_total = 1.0f + R0_0;
            const vector_f square0 = R2_2 + (R1_1 + R0_0_total);
            const vector_f square1 = R0_0_total - R1_1 - R2_2;
            const vector_mask_f is_less = square0 < square1;
            const vector_f largest = vector_select_f(is_less, square1, square0);
            const vector_f square2 = 1.0f + R1_1 - R0_0 - R2_2;
            const vector_mask_f is_less_2 = largest < square2;
            const vector_f largest_2 = vector_select_f(is_less_2, square2, largest);
            const vector_f square3 = 1.0f + R2_2 - R0_0 - R1_1;
            const vector_mask_f is_less_3 = largest_2 < square3;
            const vector_f R0_2 = x2 * mu0 + x5 * mu3 + x8 * mu6;
            const vector_f R2_0 = x0 * mu2 + x3 * mu5 + x6 * mu8;
            const vector_f R0_2_total = R0_2 + R2_0;
            const vector_f R0_1 = x1 * mu0 + x4 * mu3 + x7 * mu6;
            const vector_f R1_0 = x0 * mu1 + x3 * mu4 + x6 * mu7;
            const vector_f R0_1_total = R0_1 + R1_0;
            const vector_f R2_1 = x1 * mu2 + x4 * mu5 + x7 * mu8;
            const vector_f R1_2 = x2 * mu1 + x5 * mu4 + x8 * mu7;
            const vector_f R2_1_gap = R2_1 - R1_2;
            const vector_f row_2 = vector_select_f(is_less, square1, R2_1_gap);
            const vector_f row_6 = vector_select_f(is_less_2, R0_1_total, row_2);
            const vector_f row_10 = vector_select_f(is_less_3, R0_2_total, row_6);
            const vector_f R1_2_total = R1_2 + R2_1;
            const vector_f R0_2_gap = R0_2 - R2_0;
            const vector_f row_3 = vector_select_f(is_less, R0_1_total, R0_2_gap);
            const vector_f row_7 = vector_select_f(is_less_2, square2, row_3);
            const vector_f row_11 = vector_select_f(is_less_3, R1_2_total, row_7);
            const vector_f R1_0_gap = R1_0 - R0_1;
            const vector_f row_4 = vector_select_f(is_less, R0_2_total, R1_0_gap);
            const vector_f row_8 = vector_select_f(is_less_2, R1_2_total, row_4);
            const vector_f row_12 = vector_select_f(is_less_3, square3, row_8);
            const vector_f row = vector_select_f(is_less, R2_1_gap, square0);
            const vector_f row_5 = vector_select_f(is_less_2, R0_2_gap, row);
            const vector_f row_9 = vector_select_f(is_less_3, R1_0_gap, row_5);
            const vector_f total_2 = row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9;
            const vector_f row_length = sqrt_each_f(total_2);
            kept[k][b].square0 = square0;
            kept[k][b].square1 = square1;
            kept[k][b].largest = largest;
            kept[k][b].square2 = square2;
            kept[k][b].largest_2 = largest_2;
            kept[k][b].square3 = square3;
            kept[k][b].row_10 = row_10;
            kept[k][b].row_11 = row_11;
            kept[k][b].row_12 = row_12;
            kept[k][b].row_9 = row_9;
            kept[k][b].total_2 = total_2;
            kept[k][b].row_length = row_length;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector_f row_10 = kept[k][b].row_10;
            const vector_f row_11 = kept[k][b].row_11;
            const vector_f row_12 = kept[k][b].row_12;
            const vector_f row_length = kept[k][b].row_length;
            const vector_f g1 = row_10 / row_length;
            const vector_f g2 = row_11 / row_length;
            const vector_f g3 = row_12 / row_length;
            kept[k][b].g1 = g1;
            kept[k][b].g2 = g2;
            kept[k][b].g3 = g3;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector_f row_9 = kept[k][b].row_9;
            const vector_f row_length = kept[k][b].row_length;
            const vector_f g1 = kept[k][b].g1;
            const vector_f g2 = kept[k][b].g2;
            const vector_f g3 = kept[k][b].g3;
            const vector_f norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
            const vector_mask_f its_near = norm_s_squared < 0.249287f;
            const vector_f near_chosen_2 = vector_select_f(its_near, vector_of_f(1.0f), norm_s_squared);
            const vector_f norm_s = sqrt_each_f(near_chosen_2);
            const vector_f g0 = row_9 / row_length;
            kept[k][b].norm_s_squared = norm_s_squared;
            kept[k][b].near_chosen_2 = near_chosen_2;
            kept[k][b].norm_s = norm_s;
            kept[k][b].g0 = g0;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector_f norm_s = kept[k][b].norm_s;
            const vector_f g0 = kept[k][b].g0;
            const vector_f abs_g0 = abs_each_f(g0);
            const vector_f atan2_norm_s_abs_g0 = atan2_each_f(norm_s, abs_g0);
            kept[k][b].abs_g0 = abs_g0;
            kept[k][b].atan2_norm_s_abs_g0 = atan2_norm_s_abs_g0;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector_f norm_s = kept[k][b].norm_s;
            const vector_f atan2_norm_s_abs_g0 = kept[k][b].atan2_norm_s_abs_g0;
            const vector_f t = 2.0f * atan2_norm_s_abs_g0;
            const vector_f t_ratio = t / norm_s;
            kept[k][b].t_ratio = t_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector_f norm_s_squared = kept[k][b].norm_s_squared;
            const vector_f t_ratio = kept[k][b].t_ratio;
            const vector_mask_f its_near = norm_s_squared < 0.249287f;
            const vector_f near_chosen = vector_select_f(its_near, 4.011440628672975f * norm_s_squared,
                vector_of_f(0.0f));
            const vector_f log_det_series = vector_polynomial_log_det_series_f(near_chosen);
            const vector_f log_det_near = norm_s_squared * log_det_series;
            const vector_f product = 0.5f * t_ratio;
            const vector_f log_det = vector_select_f(its_near, log_det_near, 2.0f * log_each_f(product));
            kept[k][b].near_chosen = near_chosen;
            kept[k][b].log_det_series = log_det_series;
            kept[k][b].product = product;
            kept[k][b].log_det = log_det;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 25 * near[k];
        const float W0_0 = S[9];
        const float W0_1 = S[10];
        const float W0_2 = S[11];
        const float W1_0 = S[12];
        const float W1_1 = S[13];
        const float W1_2 = S[14];
        const float W2_0 = S[15];
        const float W2_1 = S[16];
        const float W2_2 = S[17];
        for (size_t b = 0; b < 2; ++b) {
            const vector_f g1 = kept[k][b].g1;
            const vector_f g2 = kept[k][b].g2;
            const vector_f g3 = kept[k][b].g3;
            const vector_f norm_s_squared = kept[k][b].norm_s_squared;
            const vector_f near_chosen = kept[k][b].near_chosen;
            const vector_f g0 = kept[k][b].g0;
            const vector_f t_ratio = kept[k][b].t_ratio;
            const vector_f log_det = kept[k][b].log_det;
            const vector_mask_f its_near = norm_s_squared < 0.249287f;
            const vector_f t_over_norm_s_near = vector_polynomial_t_over_norm_s_near_f(near_chosen);
            const vector_f t_over_norm_s = vector_select_f(its_near, t_over_norm_s_near, t_ratio);
            const vector_mask_f is_small = g0 < 0.0f;
            const vector_f chosen = vector_select_f(is_small, vector_of_f(-1.0f), vector_of_f(1.0f));
            const vector_f scale = t_over_norm_s * chosen;
            const vector_f v0 = g1 * scale;
            const vector_f v1 = g2 * scale;
            const vector_f v2 = g3 * scale;
            const vector_f z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
            const vector_f z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
            const vector_f z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
            const vector_f log_det_gap = log_det - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
            const vector_f phi = exp_each_f(log_det_gap);
            kept[k][b].chosen = chosen;
            kept[k][b].scale = scale;
            kept[k][b].z0 = z0;
            kept[k][b].z1 = z1;
            kept[k][b].z2 = z2;
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 25 * near[k];
        const float W0_0 = S[9];
        const float W0_1 = S[10];
        const float W0_2 = S[11];
        const float W1_0 = S[12];
        const float W1_1 = S[13];
        const float W1_2 = S[14];
        const float W2_0 = S[15];
        const float W2_1 = S[16];
        const float W2_2 = S[17];
        const float amplitude = S[18];
        for (size_t b = 0; b < 2; ++b) {
            const vector_f g1 = kept[k][b].g1;
            const vector_f g2 = kept[k][b].g2;
            const vector_f g3 = kept[k][b].g3;
            const vector_f norm_s_squared = kept[k][b].norm_s_squared;
            const vector_f product = kept[k][b].product;
            const vector_f chosen = kept[k][b].chosen;
            const vector_f z0 = kept[k][b].z0;
            const vector_f z1 = kept[k][b].z1;
            const vector_f z2 = kept[k][b].z2;
            const vector_f phi = kept[k][b].phi;
            const vector_mask_f its_near = norm_s_squared < 0.249287f;
            const vector_f phi_2 = amplitude * phi;
            const vector_f phi_product = phi_2 * (W2_2 * z2 + (W1_2 * z1 + W0_2 * z0));
            const vector_f phi_product_2 = phi_2 * (W2_1 * z2 + (W1_1 * z1 + W0_1 * z0));
            const vector_f phi_product_3 = phi_2 * (W2_0 * z2 + (W1_0 * z1 + W0_0 * z0));
            const vector_f by_scale = -(g3 * phi_product) - g2 * phi_product_2 - g1 * phi_product_3;
            const vector_f by_t_over_norm_s = chosen * by_scale;
            const vector_f total_3 = vector_select_f(its_near, vector_of_f(0.0f), by_t_over_norm_s) + 0.5f * (2.0f *
                vector_select_f(its_near, vector_of_f(0.0f), phi_2) / product);
            kept[k][b].phi_2 = phi_2;
            kept[k][b].phi_product = phi_product;
            kept[k][b].phi_product_2 = phi_product_2;
            kept[k][b].phi_product_3 = phi_product_3;
            kept[k][b].by_t_over_norm_s = by_t_over_norm_s;
            kept[k][b].total_3 = total_3;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector_f norm_s = kept[k][b].norm_s;
            const vector_f total_3 = kept[k][b].total_3;
            const vector_f by_t = total_3 / norm_s;
            kept[k][b].by_t = by_t;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector_f near_chosen_2 = kept[k][b].near_chosen_2;
            const vector_f abs_g0 = kept[k][b].abs_g0;
            const vector_f by_t = kept[k][b].by_t;
            const vector_f by_atan2_norm_s_abs_g0 = 2.0f * by_t;
            const vector_f ratio = by_atan2_norm_s_abs_g0 / (near_chosen_2 + abs_g0 * abs_g0);
            kept[k][b].ratio = ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector_f norm_s_squared = kept[k][b].norm_s_squared;
            const vector_f near_chosen = kept[k][b].near_chosen;
            const vector_f log_det_series = kept[k][b].log_det_series;
            const vector_f norm_s = kept[k][b].norm_s;
            const vector_f abs_g0 = kept[k][b].abs_g0;
            const vector_f t_ratio = kept[k][b].t_ratio;
            const vector_f phi_2 = kept[k][b].phi_2;
            const vector_f by_t_over_norm_s = kept[k][b].by_t_over_norm_s;
            const vector_f by_t = kept[k][b].by_t;
            const vector_f ratio = kept[k][b].ratio;
            const vector_mask_f its_near = norm_s_squared < 0.249287f;
            const vector_f by_norm_s = abs_g0 * ratio - t_ratio * by_t;
            const vector_f by_log_det_near = vector_select_f(its_near, phi_2, vector_of_f(0.0f));
            const vector_f by_t_over_norm_s_near = vector_select_f(its_near, by_t_over_norm_s, vector_of_f(0.0f));
            const vector_f t_over_norm_s_near_slope = vector_polynomial_t_over_norm_s_near_slope_f(near_chosen);
            const vector_f by_log_det_series = norm_s_squared * by_log_det_near;
            const vector_f log_det_series_slope = vector_polynomial_log_det_series_slope_f(near_chosen);
            const vector_f by_norm_s_squared = vector_select_f(its_near, vector_of_f(0.0f), by_norm_s / (2.0f *
                norm_s)) + log_det_series * by_log_det_near + 4.011440628672975f * vector_select_f(its_near,
                by_t_over_norm_s_near * t_over_norm_s_near_slope + by_log_det_series * log_det_series_slope,
                vector_of_f(0.0f));
            kept[k][b].by_norm_s_squared = by_norm_s_squared;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector_f row_length = kept[k][b].row_length;
            const vector_f g1 = kept[k][b].g1;
            const vector_f g2 = kept[k][b].g2;
            const vector_f g3 = kept[k][b].g3;
            const vector_f norm_s = kept[k][b].norm_s;
            const vector_f g0 = kept[k][b].g0;
            const vector_f scale = kept[k][b].scale;
            const vector_f phi_product = kept[k][b].phi_product;
            const vector_f phi_product_2 = kept[k][b].phi_product_2;
            const vector_f phi_product_3 = kept[k][b].phi_product_3;
            const vector_f ratio = kept[k][b].ratio;
            const vector_f by_norm_s_squared = kept[k][b].by_norm_s_squared;
            const vector_mask_f is_small = g0 < 0.0f;
            const vector_f norm_s_product = norm_s * ratio;
            const vector_f by_abs_g0 = -norm_s_product;
            const vector_f by_g0 = vector_select_f(is_small, norm_s_product, by_abs_g0);
            const vector_f by_g0_ratio = by_g0 / row_length;
            const vector_f product_2 = 2.0f * by_norm_s_squared;
            const vector_f by_g3 = g3 * product_2 - scale * phi_product;
            const vector_f by_g3_ratio = by_g3 / row_length;
            const vector_f by_g2 = g2 * product_2 - scale * phi_product_2;
            const vector_f by_g2_ratio = by_g2 / row_length;
            const vector_f by_g1 = g1 * product_2 - scale * phi_product_3;
            const vector_f by_g1_ratio = by_g1 / row_length;
            kept[k][b].by_g0_ratio = by_g0_ratio;
            kept[k][b].by_g3_ratio = by_g3_ratio;
            kept[k][b].by_g2_ratio = by_g2_ratio;
            kept[k][b].by_g1_ratio = by_g1_ratio;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        for (size_t b = 0; b < 2; ++b) {
            const vector_f total_2 = kept[k][b].total_2;
            const vector_f row_length = kept[k][b].row_length;
            const vector_f g1 = kept[k][b].g1;
            const vector_f g2 = kept[k][b].g2;
            const vector_f g3 = kept[k][b].g3;
            const vector_f g0 = kept[k][b].g0;
            const vector_f by_g0_ratio = kept[k][b].by_g0_ratio;
            const vector_f by_g3_ratio = kept[k][b].by_g3_ratio;
            const vector_f by_g2_ratio = kept[k][b].by_g2_ratio;
            const vector_f by_g1_ratio = kept[k][b].by_g1_ratio;
            const vector_mask_f is_small_2 = total_2 == 0.0f;
            const vector_f by_row_length = -(g0 * by_g0_ratio) - g3 * by_g3_ratio - g2 * by_g2_ratio - g1 *
                by_g1_ratio;
            const vector_f product_3 = 2.0f * vector_select_f(is_small_2, vector_of_f(0.0f), by_row_length / (2.0f *
                vector_select_f(is_small_2, vector_of_f(1.0f), row_length)));
            kept[k][b].product_3 = product_3;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 25 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float mu7 = S[7];
        const float mu8 = S[8];
        for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            vector_f *slope = slopes + 9 * b;
            const vector_f square0 = kept[k][b].square0;
            const vector_f square1 = kept[k][b].square1;
            const vector_f largest = kept[k][b].largest;
            const vector_f square2 = kept[k][b].square2;
            const vector_f largest_2 = kept[k][b].largest_2;
            const vector_f square3 = kept[k][b].square3;
            const vector_f row_10 = kept[k][b].row_10;
            const vector_f row_11 = kept[k][b].row_11;
            const vector_f row_12 = kept[k][b].row_12;
            const vector_f row_9 = kept[k][b].row_9;
            const vector_f phi_2 = kept[k][b].phi_2;
            const vector_f by_g0_ratio = kept[k][b].by_g0_ratio;
            const vector_f by_g3_ratio = kept[k][b].by_g3_ratio;
            const vector_f by_g2_ratio = kept[k][b].by_g2_ratio;
            const vector_f by_g1_ratio = kept[k][b].by_g1_ratio;
            const vector_f product_3 = kept[k][b].product_3;
            const vector_mask_f is_less = square0 < square1;
            const vector_mask_f is_less_2 = largest < square2;
            const vector_mask_f is_less_3 = largest_2 < square3;
            const vector_f by_row_9 = by_g0_ratio + row_9 * product_3;
            const vector_f by_row_12 = by_g3_ratio + row_12 * product_3;
            const vector_f by_row_8 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_12);
            const vector_f by_row_4 = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_8);
            const vector_f total_4 = vector_select_f(is_less_3, by_row_9, vector_of_f(0.0f)) +
                vector_select_f(is_less, vector_of_f(0.0f), by_row_4);
            const vector_f by_row_11 = by_g2_ratio + row_11 * product_3;
            const vector_f by_row_7 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_11);
            const vector_f by_row_3 = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_7);
            const vector_f by_row_10 = by_g1_ratio + row_10 * product_3;
            const vector_f by_row_6 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_10);
            const vector_f total_5 = vector_select_f(is_less, by_row_3, vector_of_f(0.0f)) +
                vector_select_f(is_less_2, by_row_6, vector_of_f(0.0f));
            const vector_f by_R1_0 = total_4 + total_5;
            const vector_f total_6 = vector_select_f(is_less, by_row_4, vector_of_f(0.0f)) +
                vector_select_f(is_less_3, by_row_10, vector_of_f(0.0f));
            const vector_f by_row_5 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_9);
            const vector_f total_7 = vector_select_f(is_less_2, by_row_5, vector_of_f(0.0f)) +
                vector_select_f(is_less, vector_of_f(0.0f), by_row_3);
            const vector_f by_R2_0 = total_6 - total_7;
            const vector_f by_square3 = vector_select_f(is_less_3, by_row_12, vector_of_f(0.0f));
            const vector_f by_square2 = vector_select_f(is_less_2, by_row_7, vector_of_f(0.0f));
            const vector_f by_row = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_5);
            const vector_f by_square0 = vector_select_f(is_less, vector_of_f(0.0f), by_row);
            const vector_f by_row_2 = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_6);
            const vector_f by_square1 = vector_select_f(is_less, by_row_2, vector_of_f(0.0f));
            const vector_f by_R0_0 = -by_square3 - by_square2 + (by_square0 + by_square1);
            const vector_f total_8 = vector_select_f(is_less_2, by_row_8, vector_of_f(0.0f)) +
                vector_select_f(is_less_3, by_row_11, vector_of_f(0.0f));
            const vector_f total_9 = vector_select_f(is_less, by_row, vector_of_f(0.0f)) + vector_select_f(is_less,
                vector_of_f(0.0f), by_row_2);
            const vector_f by_R2_1 = total_8 + total_9;
            const vector_f by_R0_1 = total_5 - total_4;
            const vector_f by_R1_1 = by_square0 + (by_square2 - by_square3 - by_square1);
            const vector_f by_R1_2 = total_8 - total_9;
            const vector_f by_R0_2 = total_7 + total_6;
            const vector_f by_R2_2 = by_square0 + (by_square3 - by_square2 - by_square1);
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] + mu1 * by_R1_0 + mu2 * by_R2_0 + mu0 * by_R0_0;
            slope[1] = slope[1] + mu2 * by_R2_1 + mu0 * by_R0_1 + mu1 * by_R1_1;
            slope[2] = slope[2] + mu1 * by_R1_2 + mu0 * by_R0_2 + mu2 * by_R2_2;
            slope[3] = slope[3] + mu4 * by_R1_0 + mu5 * by_R2_0 + mu3 * by_R0_0;
            slope[4] = slope[4] + mu5 * by_R2_1 + mu3 * by_R0_1 + mu4 * by_R1_1;
            slope[5] = slope[5] + mu4 * by_R1_2 + mu3 * by_R0_2 + mu5 * by_R2_2;
            slope[6] = slope[6] + mu7 * by_R1_0 + mu8 * by_R2_0 + mu6 * by_R0_0;
            slope[7] = slope[7] + mu8 * by_R2_1 + mu6 * by_R0_1 + mu7 * by_R1_1;
            slope[8] = slope[8] + mu7 * by_R1_2 + mu6 * by_R0_2 + mu8 * by_R2_2;
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
    const vector_f x4 = x[4];
    const vector_f x5 = x[5];
    const vector_f x6 = x[6];
    const vector_f x7 = x[7];
    const vector_f x8 = x[8];
    const vector_f slope_x0 = slope[0];
    const vector_f slope_x1 = slope[1];
    const vector_f slope_x2 = slope[2];
    const vector_f slope_x3 = slope[3];
    const vector_f slope_x4 = slope[4];
    const vector_f slope_x5 = slope[5];
    const vector_f slope_x6 = slope[6];
    const vector_f slope_x7 = slope[7];
    const vector_f slope_x8 = slope[8];
    const vector_f gap = x2 * slope_x1 + x5 * slope_x4 + x8 * slope_x7 - x1 * slope_x2 - x4 * slope_x5;
    const vector_f gap_2 = x0 * slope_x2 + x3 * slope_x5 + x6 * slope_x8 - x2 * slope_x0 - x5 * slope_x3;
    const vector_f gap_3 = x1 * slope_x0 + x4 * slope_x3 + x7 * slope_x6 - x0 * slope_x1 - x3 * slope_x4;
    gradient[0] = gap - x7 * slope_x8;
    gradient[1] = gap_2 - x8 * slope_x6;
    gradient[2] = gap_3 - x6 * slope_x7;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp_f(
    const vector_f *x, const vector_f *gradient_bar, vector_f *slope_bar) {
    const vector_f x0 = x[0];
    const vector_f x1 = x[1];
    const vector_f x2 = x[2];
    const vector_f x3 = x[3];
    const vector_f x4 = x[4];
    const vector_f x5 = x[5];
    const vector_f x6 = x[6];
    const vector_f x7 = x[7];
    const vector_f x8 = x[8];
    const vector_f gradient_bar0 = gradient_bar[0];
    const vector_f gradient_bar1 = gradient_bar[1];
    const vector_f gradient_bar2 = gradient_bar[2];
    slope_bar[0] = x1 * gradient_bar2 - x2 * gradient_bar1;
    slope_bar[1] = x2 * gradient_bar0 - x0 * gradient_bar2;
    slope_bar[2] = x0 * gradient_bar1 - x1 * gradient_bar0;
    slope_bar[3] = x4 * gradient_bar2 - x5 * gradient_bar1;
    slope_bar[4] = x5 * gradient_bar0 - x3 * gradient_bar2;
    slope_bar[5] = x3 * gradient_bar1 - x4 * gradient_bar0;
    slope_bar[6] = x7 * gradient_bar2 - x8 * gradient_bar1;
    slope_bar[7] = x8 * gradient_bar0 - x6 * gradient_bar2;
    slope_bar[8] = x6 * gradient_bar1 - x7 * gradient_bar0;
}

/*
 * Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
OUTLINE void pair_backward_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *sums) {
    struct { vector_f square0, square1, largest, square2, largest_2, square3, row_12, row_10, row_11, row_9,
            total_2, row_length, g3, g1, g2, norm_s_squared, g0, abs_g0, chosen, near_chosen, log_det_series,
            near_chosen_2, norm_s, atan2_norm_s_abs_g0, t_ratio, product, log_det, scale, v0, v1, v2, z0, z1, z2,
            phi, total_3, phi_product, total_4, phi_product_2, total_5, phi_product_3, by_t_over_norm_s, ratio,
            by_t, total_6, ratio_2, norm_s_product, by_norm_s_ratio, by_log_det_near, by_t_over_norm_s_near,
            t_over_norm_s_near_slope, by_log_det_series, log_det_series_slope, product_2, by_g3_ratio,
            by_g0_ratio, by_g2_ratio, by_g1_ratio, product_3, ratio_3, by_by_row_11, by_by_row_10, by_by_row_12,
            by_by_row_9, by_by_row_length, by_by_g2, by_by_g0, gap, by_by_g1, by_by_g3, total_11,
            by_by_norm_s_squared, by_by_norm_s, by_by_atan2_norm_s_abs_g0, by_by_t_ratio, near_chosen_3,
            by_by_scale, gap_2, phi_product_4, gap_3, phi_product_5, gap_4, phi_product_6, ratio_4,
            by_by_log_det_series, by_log_det, by_v1, by_v2, by_v0, by_t_over_norm_s_2, product_6, by_t_2, ratio_5,
            product_7, by_log_det_near_2, total_14, by_g2_ratio_2, by_g0_ratio_2, by_g3_ratio_2, by_g1_ratio_2,
            product_9; } kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 19 * (size_t)near[i];
        const vector_f x0 = X[0];
        const vector_f x1 = X[1];
        const vector_f x2 = X[2];
        const vector_f x3 = X[3];
        const vector_f x4 = X[4];
        const vector_f x5 = X[5];
        const vector_f x6 = X[6];
        const vector_f x7 = X[7];
        const vector_f x8 = X[8];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float mu7 = S[7];
        const float mu8 = S[8];
        const vector_f R2_2 = x2 * mu2 + x5 * mu5 + x8 * mu8;
        const vector_f R1_1 = x1 * mu1 + x4 * mu4 + x7 * mu7;
        const vector_f R0_0 = x0 * mu0 + x3 * mu3 + x6 * mu6;
        const vector_f R0_0_total = 1.0f + R0_0;
        const vector_f square0 = R2_2 + (R1_1 + R0_0_total);
        const vector_f square1 = R0_0_total - R1_1 - R2_2;
        const vector_mask_f is_less = square0 < square1;
        const vector_f largest = vector_select_f(is_less, square1, square0);
        const vector_f square2 = 1.0f + R1_1 - R0_0 - R2_2;
        const vector_mask_f is_less_2 = largest < square2;
        const vector_f largest_2 = vector_select_f(is_less_2, square2, largest);
        const vector_f square3 = 1.0f + R2_2 - R0_0 - R1_1;
        const vector_mask_f is_less_3 = largest_2 < square3;
        const vector_f R1_2 = x2 * mu1 + x5 * mu4 + x8 * mu7;
        const vector_f R2_1 = x1 * mu2 + x4 * mu5 + x7 * mu8;
        const vector_f R1_2_total = R1_2 + R2_1;
        const vector_f R0_2 = x2 * mu0 + x5 * mu3 + x8 * mu6;
        const vector_f R2_0 = x0 * mu2 + x3 * mu5 + x6 * mu8;
        const vector_f R0_2_total = R0_2 + R2_0;
        const vector_f R1_0 = x0 * mu1 + x3 * mu4 + x6 * mu7;
        const vector_f R0_1 = x1 * mu0 + x4 * mu3 + x7 * mu6;
        const vector_f R1_0_gap = R1_0 - R0_1;
        const vector_f row_4 = vector_select_f(is_less, R0_2_total, R1_0_gap);
        const vector_f row_8 = vector_select_f(is_less_2, R1_2_total, row_4);
        const vector_f row_12 = vector_select_f(is_less_3, square3, row_8);
        const vector_f R0_1_total = R0_1 + R1_0;
        const vector_f R2_1_gap = R2_1 - R1_2;
        const vector_f row_2 = vector_select_f(is_less, square1, R2_1_gap);
        const vector_f row_6 = vector_select_f(is_less_2, R0_1_total, row_2);
        const vector_f row_10 = vector_select_f(is_less_3, R0_2_total, row_6);
        const vector_f R0_2_gap = R0_2 - R2_0;
        const vector_f row_3 = vector_select_f(is_less, R0_1_total, R0_2_gap);
        const vector_f row_7 = vector_select_f(is_less_2, square2, row_3);
        const vector_f row_11 = vector_select_f(is_less_3, R1_2_total, row_7);
        const vector_f row = vector_select_f(is_less, R2_1_gap, square0);
        const vector_f row_5 = vector_select_f(is_less_2, R0_2_gap, row);
        const vector_f row_9 = vector_select_f(is_less_3, R1_0_gap, row_5);
        const vector_f total_2 = row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9;
        const vector_f row_length = sqrt_each_f(total_2);
        kept[i].square0 = square0;
        kept[i].square1 = square1;
        kept[i].largest = largest;
        kept[i].square2 = square2;
        kept[i].largest_2 = largest_2;
        kept[i].square3 = square3;
        kept[i].row_12 = row_12;
        kept[i].row_10 = row_10;
        kept[i].row_11 = row_11;
        kept[i].row_9 = row_9;
        kept[i].total_2 = total_2;
        kept[i].row_length = row_length;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f row_12 = kept[i].row_12;
        const vector_f row_10 = kept[i].row_10;
        const vector_f row_11 = kept[i].row_11;
        const vector_f row_length = kept[i].row_length;
        const vector_f g3 = row_12 / row_length;
        const vector_f g1 = row_10 / row_length;
        const vector_f g2 = row_11 / row_length;
        kept[i].g3 = g3;
        kept[i].g1 = g1;
        kept[i].g2 = g2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *slope_bar = points + 19 * (size_t)near[i] + 9 + 1;
        const vector_f square0 = kept[i].square0;
        const vector_f square1 = kept[i].square1;
        const vector_f largest = kept[i].largest;
        const vector_f square2 = kept[i].square2;
        const vector_f largest_2 = kept[i].largest_2;
        const vector_f square3 = kept[i].square3;
        const vector_f row_12 = kept[i].row_12;
        const vector_f row_10 = kept[i].row_10;
        const vector_f row_11 = kept[i].row_11;
        const vector_f row_9 = kept[i].row_9;
        const vector_f total_2 = kept[i].total_2;
        const vector_f row_length = kept[i].row_length;
        const vector_f g3 = kept[i].g3;
        const vector_f g1 = kept[i].g1;
        const vector_f g2 = kept[i].g2;
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float mu7 = S[7];
        const float mu8 = S[8];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_f x2_bar = slope_bar[2];
        const vector_f x3_bar = slope_bar[3];
        const vector_f x4_bar = slope_bar[4];
        const vector_f x5_bar = slope_bar[5];
        const vector_f x6_bar = slope_bar[6];
        const vector_f x7_bar = slope_bar[7];
        const vector_f x8_bar = slope_bar[8];
        const vector_mask_f is_less = square0 < square1;
        const vector_mask_f is_less_2 = largest < square2;
        const vector_mask_f is_less_3 = largest_2 < square3;
        const vector_f norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
        const vector_mask_f its_near = norm_s_squared < 0.249287f;
        const vector_f g0 = row_9 / row_length;
        const vector_f near_chosen_2 = vector_select_f(its_near, vector_of_f(1.0f), norm_s_squared);
        const vector_f norm_s = sqrt_each_f(near_chosen_2);
        const vector_mask_f is_small_2 = total_2 == 0.0f;
        const vector_f product_3 = 2.0f * vector_select_f(is_small_2, vector_of_f(1.0f), row_length);
        const vector_f by_by_R0_2 = mu0 * x2_bar + mu3 * x5_bar + mu6 * x8_bar;
        const vector_f by_by_R2_0 = mu2 * x0_bar + mu5 * x3_bar + mu8 * x6_bar;
        const vector_f by_by_R0_2_gap = by_by_R0_2 - by_by_R2_0;
        const vector_f by_by_R0_1 = mu0 * x1_bar + mu3 * x4_bar + mu6 * x7_bar;
        const vector_f by_by_R1_0 = mu1 * x0_bar + mu4 * x3_bar + mu7 * x6_bar;
        const vector_f by_by_R0_1_total = by_by_R0_1 + by_by_R1_0;
        const vector_f by_by_row_3 = vector_select_f(is_less, vector_of_f(0.0f), by_by_R0_2_gap) +
            vector_select_f(is_less, by_by_R0_1_total, vector_of_f(0.0f));
        const vector_f by_by_R1_1 = mu1 * x1_bar + mu4 * x4_bar + mu7 * x7_bar;
        const vector_f by_by_R0_0 = mu0 * x0_bar + mu3 * x3_bar + mu6 * x6_bar;
        const vector_f by_by_R2_2 = mu2 * x2_bar + mu5 * x5_bar + mu8 * x8_bar;
        const vector_f by_by_square2 = by_by_R1_1 - by_by_R0_0 - by_by_R2_2;
        const vector_f by_by_row_7 = vector_select_f(is_less_2, vector_of_f(0.0f), by_by_row_3) +
            vector_select_f(is_less_2, by_by_square2, vector_of_f(0.0f));
        const vector_f by_by_R2_1 = mu2 * x1_bar + mu5 * x4_bar + mu8 * x7_bar;
        const vector_f by_by_R1_2 = mu1 * x2_bar + mu4 * x5_bar + mu7 * x8_bar;
        const vector_f by_by_R2_1_total = by_by_R2_1 + by_by_R1_2;
        const vector_f by_by_row_11 = vector_select_f(is_less_3, vector_of_f(0.0f), by_by_row_7) +
            vector_select_f(is_less_3, by_by_R2_1_total, vector_of_f(0.0f));
        const vector_f by_by_R2_1_gap = by_by_R2_1 - by_by_R1_2;
        const vector_f by_by_square1 = by_by_R0_0 - by_by_R1_1 - by_by_R2_2;
        const vector_f by_by_row_2 = vector_select_f(is_less, vector_of_f(0.0f), by_by_R2_1_gap) +
            vector_select_f(is_less, by_by_square1, vector_of_f(0.0f));
        const vector_f by_by_row_6 = vector_select_f(is_less_2, vector_of_f(0.0f), by_by_row_2) +
            vector_select_f(is_less_2, by_by_R0_1_total, vector_of_f(0.0f));
        const vector_f by_by_R0_2_total = by_by_R0_2 + by_by_R2_0;
        const vector_f by_by_row_10 = vector_select_f(is_less_3, vector_of_f(0.0f), by_by_row_6) +
            vector_select_f(is_less_3, by_by_R0_2_total, vector_of_f(0.0f));
        const vector_f by_by_R1_0_gap = by_by_R1_0 - by_by_R0_1;
        const vector_f by_by_row_4 = vector_select_f(is_less, vector_of_f(0.0f), by_by_R1_0_gap) +
            vector_select_f(is_less, by_by_R0_2_total, vector_of_f(0.0f));
        const vector_f by_by_row_8 = vector_select_f(is_less_2, vector_of_f(0.0f), by_by_row_4) +
            vector_select_f(is_less_2, by_by_R2_1_total, vector_of_f(0.0f));
        const vector_f by_by_square3 = by_by_R2_2 - by_by_R1_1 - by_by_R0_0;
        const vector_f by_by_row_12 = vector_select_f(is_less_3, vector_of_f(0.0f), by_by_row_8) +
            vector_select_f(is_less_3, by_by_square3, vector_of_f(0.0f));
        const vector_f by_by_square0 = by_by_R2_2 + (by_by_R1_1 + by_by_R0_0);
        const vector_f by_by_row = vector_select_f(is_less, by_by_R2_1_gap, vector_of_f(0.0f)) +
            vector_select_f(is_less, vector_of_f(0.0f), by_by_square0);
        const vector_f by_by_row_5 = vector_select_f(is_less_2, vector_of_f(0.0f), by_by_row) +
            vector_select_f(is_less_2, by_by_R0_2_gap, vector_of_f(0.0f));
        const vector_f by_by_row_9 = vector_select_f(is_less_3, vector_of_f(0.0f), by_by_row_5) +
            vector_select_f(is_less_3, by_by_R1_0_gap, vector_of_f(0.0f));
        const vector_f product_5 = 2.0f * (row_10 * by_by_row_10 + row_11 * by_by_row_11 + row_12 * by_by_row_12 +
            row_9 * by_by_row_9);
        const vector_f by_by_row_length = vector_select_f(is_small_2, vector_of_f(0.0f), product_5) / product_3;
        kept[i].norm_s_squared = norm_s_squared;
        kept[i].g0 = g0;
        kept[i].near_chosen_2 = near_chosen_2;
        kept[i].norm_s = norm_s;
        kept[i].product_3 = product_3;
        kept[i].by_by_row_11 = by_by_row_11;
        kept[i].by_by_row_10 = by_by_row_10;
        kept[i].by_by_row_12 = by_by_row_12;
        kept[i].by_by_row_9 = by_by_row_9;
        kept[i].by_by_row_length = by_by_row_length;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f row_length = kept[i].row_length;
        const vector_f g3 = kept[i].g3;
        const vector_f g1 = kept[i].g1;
        const vector_f g2 = kept[i].g2;
        const vector_f g0 = kept[i].g0;
        const vector_f norm_s = kept[i].norm_s;
        const vector_f by_by_row_11 = kept[i].by_by_row_11;
        const vector_f by_by_row_10 = kept[i].by_by_row_10;
        const vector_f by_by_row_12 = kept[i].by_by_row_12;
        const vector_f by_by_row_length = kept[i].by_by_row_length;
        const vector_f abs_g0 = abs_each_f(g0);
        const vector_f atan2_norm_s_abs_g0 = atan2_each_f(norm_s, abs_g0);
        const vector_f by_by_g2 = (by_by_row_11 - g2 * by_by_row_length) / row_length;
        const vector_f by_by_g1 = (by_by_row_10 - g1 * by_by_row_length) / row_length;
        const vector_f by_by_g3 = (by_by_row_12 - g3 * by_by_row_length) / row_length;
        kept[i].abs_g0 = abs_g0;
        kept[i].atan2_norm_s_abs_g0 = atan2_norm_s_abs_g0;
        kept[i].by_by_g2 = by_by_g2;
        kept[i].by_by_g1 = by_by_g1;
        kept[i].by_by_g3 = by_by_g3;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f row_length = kept[i].row_length;
        const vector_f g3 = kept[i].g3;
        const vector_f g1 = kept[i].g1;
        const vector_f g2 = kept[i].g2;
        const vector_f norm_s_squared = kept[i].norm_s_squared;
        const vector_f g0 = kept[i].g0;
        const vector_f norm_s = kept[i].norm_s;
        const vector_f atan2_norm_s_abs_g0 = kept[i].atan2_norm_s_abs_g0;
        const vector_f by_by_row_9 = kept[i].by_by_row_9;
        const vector_f by_by_row_length = kept[i].by_by_row_length;
        const vector_f by_by_g2 = kept[i].by_by_g2;
        const vector_f by_by_g1 = kept[i].by_by_g1;
        const vector_f by_by_g3 = kept[i].by_by_g3;
        const vector_mask_f its_near = norm_s_squared < 0.249287f;
        const vector_f t = 2.0f * atan2_norm_s_abs_g0;
        const vector_f t_ratio = t / norm_s;
        const vector_f norm_s_product = 2.0f * norm_s;
        const vector_f by_by_g0 = (by_by_row_9 - g0 * by_by_row_length) / row_length;
        const vector_f total_11 = g1 * by_by_g1 + g2 * by_by_g2 + g3 * by_by_g3;
        const vector_f by_by_norm_s_squared = 2.0f * total_11;
        const vector_f by_by_norm_s = vector_select_f(its_near, vector_of_f(0.0f), by_by_norm_s_squared) /
            norm_s_product;
        kept[i].t_ratio = t_ratio;
        kept[i].norm_s_product = norm_s_product;
        kept[i].by_by_g0 = by_by_g0;
        kept[i].total_11 = total_11;
        kept[i].by_by_norm_s_squared = by_by_norm_s_squared;
        kept[i].by_by_norm_s = by_by_norm_s;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f norm_s_squared = kept[i].norm_s_squared;
        const vector_f g0 = kept[i].g0;
        const vector_f abs_g0 = kept[i].abs_g0;
        const vector_f near_chosen_2 = kept[i].near_chosen_2;
        const vector_f norm_s = kept[i].norm_s;
        const vector_f t_ratio = kept[i].t_ratio;
        const vector_f by_by_g0 = kept[i].by_by_g0;
        const vector_f by_by_norm_s = kept[i].by_by_norm_s;
        const vector_mask_f its_near = norm_s_squared < 0.249287f;
        const vector_mask_f is_small = g0 < 0.0f;
        const vector_f near_chosen = vector_select_f(its_near, 4.011440628672975f * norm_s_squared,
            vector_of_f(0.0f));
        const vector_f log_det_series = vector_polynomial_log_det_series_f(near_chosen);
        const vector_f log_det_near = norm_s_squared * log_det_series;
        const vector_f product = 0.5f * t_ratio;
        const vector_f log_det = vector_select_f(its_near, log_det_near, 2.0f * log_each_f(product));
        const vector_f total_6 = near_chosen_2 + abs_g0 * abs_g0;
        const vector_f by_by_abs_g0 = vector_select_f(is_small, vector_of_f(0.0f), by_by_g0);
        const vector_f gap = vector_select_f(is_small, by_by_g0, vector_of_f(0.0f)) - by_by_abs_g0;
        const vector_f by_by_atan2_norm_s_abs_g0 = (norm_s * gap + abs_g0 * by_by_norm_s) / total_6;
        kept[i].near_chosen = near_chosen;
        kept[i].log_det_series = log_det_series;
        kept[i].product = product;
        kept[i].log_det = log_det;
        kept[i].total_6 = total_6;
        kept[i].gap = gap;
        kept[i].by_by_atan2_norm_s_abs_g0 = by_by_atan2_norm_s_abs_g0;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f g3 = kept[i].g3;
        const vector_f g1 = kept[i].g1;
        const vector_f g2 = kept[i].g2;
        const vector_f norm_s_squared = kept[i].norm_s_squared;
        const vector_f g0 = kept[i].g0;
        const vector_f near_chosen = kept[i].near_chosen;
        const vector_f norm_s = kept[i].norm_s;
        const vector_f t_ratio = kept[i].t_ratio;
        const vector_f log_det = kept[i].log_det;
        const vector_f by_by_norm_s = kept[i].by_by_norm_s;
        const vector_f by_by_atan2_norm_s_abs_g0 = kept[i].by_by_atan2_norm_s_abs_g0;
        const float W0_0 = S[9];
        const float W0_1 = S[10];
        const float W0_2 = S[11];
        const float W1_0 = S[12];
        const float W1_1 = S[13];
        const float W1_2 = S[14];
        const float W2_0 = S[15];
        const float W2_1 = S[16];
        const float W2_2 = S[17];
        const vector_mask_f its_near = norm_s_squared < 0.249287f;
        const vector_mask_f is_small = g0 < 0.0f;
        const vector_f chosen = vector_select_f(is_small, vector_of_f(-1.0f), vector_of_f(1.0f));
        const vector_f t_over_norm_s_near = vector_polynomial_t_over_norm_s_near_f(near_chosen);
        const vector_f t_over_norm_s = vector_select_f(its_near, t_over_norm_s_near, t_ratio);
        const vector_f scale = t_over_norm_s * chosen;
        const vector_f v0 = g1 * scale;
        const vector_f v1 = g2 * scale;
        const vector_f v2 = g3 * scale;
        const vector_f z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
        const vector_f z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
        const vector_f z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
        const vector_f log_det_gap = log_det - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
        const vector_f phi = exp_each_f(log_det_gap);
        const vector_f by_by_t = 2.0f * by_by_atan2_norm_s_abs_g0 - t_ratio * by_by_norm_s;
        const vector_f by_by_t_ratio = by_by_t / norm_s;
        kept[i].chosen = chosen;
        kept[i].scale = scale;
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].v2 = v2;
        kept[i].z0 = z0;
        kept[i].z1 = z1;
        kept[i].z2 = z2;
        kept[i].phi = phi;
        kept[i].by_by_t_ratio = by_by_t_ratio;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f norm_s_squared = kept[i].norm_s_squared;
        const vector_f product = kept[i].product;
        const vector_f phi = kept[i].phi;
        const vector_f by_by_t_ratio = kept[i].by_by_t_ratio;
        const vector_mask_f its_near = norm_s_squared < 0.249287f;
        const vector_f ratio = 2.0f * vector_select_f(its_near, vector_of_f(0.0f), phi) / product;
        const vector_f ratio_4 = 0.5f * by_by_t_ratio / product;
        kept[i].ratio = ratio;
        kept[i].ratio_4 = ratio_4;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *value_bar = points + 19 * (size_t)near[i] + 9;
        const vector_f g3 = kept[i].g3;
        const vector_f g1 = kept[i].g1;
        const vector_f g2 = kept[i].g2;
        const vector_f norm_s_squared = kept[i].norm_s_squared;
        const vector_f chosen = kept[i].chosen;
        const vector_f near_chosen = kept[i].near_chosen;
        const vector_f log_det_series = kept[i].log_det_series;
        const vector_f norm_s = kept[i].norm_s;
        const vector_f product = kept[i].product;
        const vector_f scale = kept[i].scale;
        const vector_f z0 = kept[i].z0;
        const vector_f z1 = kept[i].z1;
        const vector_f z2 = kept[i].z2;
        const vector_f phi = kept[i].phi;
        const vector_f ratio = kept[i].ratio;
        const vector_f by_by_g2 = kept[i].by_by_g2;
        const vector_f by_by_g1 = kept[i].by_by_g1;
        const vector_f by_by_g3 = kept[i].by_by_g3;
        const vector_f total_11 = kept[i].total_11;
        const vector_f by_by_norm_s_squared = kept[i].by_by_norm_s_squared;
        const vector_f by_by_t_ratio = kept[i].by_by_t_ratio;
        const vector_f ratio_4 = kept[i].ratio_4;
        const float W0_0 = S[9];
        const float W0_1 = S[10];
        const float W0_2 = S[11];
        const float W1_0 = S[12];
        const float W1_1 = S[13];
        const float W1_2 = S[14];
        const float W2_0 = S[15];
        const float W2_1 = S[16];
        const float W2_2 = S[17];
        const vector_f its_value_bar = value_bar[0];
        const vector_mask_f its_near = norm_s_squared < 0.249287f;
        const vector_f total_3 = W2_2 * z2 + (W1_2 * z1 + W0_2 * z0);
        const vector_f phi_product = phi * total_3;
        const vector_f total_4 = W2_1 * z2 + (W1_1 * z1 + W0_1 * z0);
        const vector_f phi_product_2 = phi * total_4;
        const vector_f total_5 = W2_0 * z2 + (W1_0 * z1 + W0_0 * z0);
        const vector_f phi_product_3 = phi * total_5;
        const vector_f by_scale = -(g3 * phi_product) - g2 * phi_product_2 - g1 * phi_product_3;
        const vector_f by_t_over_norm_s = chosen * by_scale;
        const vector_f by_t = (vector_select_f(its_near, vector_of_f(0.0f), by_t_over_norm_s) + 0.5f * ratio) /
            norm_s;
        const vector_f t_over_norm_s_near_slope = vector_polynomial_t_over_norm_s_near_slope_f(near_chosen);
        const vector_f log_det_series_slope = vector_polynomial_log_det_series_slope_f(near_chosen);
        const vector_f near_chosen_3 = vector_select_f(its_near, 8.02288125734595f * total_11, vector_of_f(0.0f));
        const vector_f by_by_t_over_norm_s_near = t_over_norm_s_near_slope * near_chosen_3;
        const vector_f by_by_t_over_norm_s = vector_select_f(its_near, vector_of_f(0.0f), by_by_t_ratio) +
            vector_select_f(its_near, by_by_t_over_norm_s_near, vector_of_f(0.0f));
        const vector_f by_by_scale = chosen * by_by_t_over_norm_s;
        const vector_f gap_2 = -(g1 * by_by_scale) - scale * by_by_g1;
        const vector_f gap_3 = -(g2 * by_by_scale) - scale * by_by_g2;
        const vector_f gap_4 = -(g3 * by_by_scale) - scale * by_by_g3;
        const vector_f by_by_log_det_series = log_det_series_slope * near_chosen_3;
        const vector_f by_by_log_det_near = norm_s_squared * by_by_log_det_series + log_det_series *
            by_by_norm_s_squared;
        const vector_f total_12 = its_value_bar + vector_select_f(its_near, vector_of_f(0.0f), 2.0f * ratio_4) +
            vector_select_f(its_near, by_by_log_det_near, vector_of_f(0.0f)) + total_3 * gap_4;
        const vector_f by_phi = total_12 + total_4 * gap_3 + total_5 * gap_2;
        const vector_f by_log_det = phi * by_phi;
        const vector_f product_6 = 0.5f * (2.0f * vector_select_f(its_near, vector_of_f(0.0f), by_log_det) /
            product - ratio * ratio_4);
        kept[i].total_3 = total_3;
        kept[i].phi_product = phi_product;
        kept[i].total_4 = total_4;
        kept[i].phi_product_2 = phi_product_2;
        kept[i].total_5 = total_5;
        kept[i].phi_product_3 = phi_product_3;
        kept[i].by_t_over_norm_s = by_t_over_norm_s;
        kept[i].by_t = by_t;
        kept[i].t_over_norm_s_near_slope = t_over_norm_s_near_slope;
        kept[i].log_det_series_slope = log_det_series_slope;
        kept[i].near_chosen_3 = near_chosen_3;
        kept[i].by_by_scale = by_by_scale;
        kept[i].gap_2 = gap_2;
        kept[i].gap_3 = gap_3;
        kept[i].gap_4 = gap_4;
        kept[i].by_by_log_det_series = by_by_log_det_series;
        kept[i].by_log_det = by_log_det;
        kept[i].product_6 = product_6;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f g3 = kept[i].g3;
        const vector_f g1 = kept[i].g1;
        const vector_f g2 = kept[i].g2;
        const vector_f norm_s_squared = kept[i].norm_s_squared;
        const vector_f chosen = kept[i].chosen;
        const vector_f norm_s = kept[i].norm_s;
        const vector_f phi = kept[i].phi;
        const vector_f total_3 = kept[i].total_3;
        const vector_f phi_product = kept[i].phi_product;
        const vector_f total_4 = kept[i].total_4;
        const vector_f phi_product_2 = kept[i].phi_product_2;
        const vector_f total_5 = kept[i].total_5;
        const vector_f phi_product_3 = kept[i].phi_product_3;
        const vector_f by_t = kept[i].by_t;
        const vector_f total_6 = kept[i].total_6;
        const vector_f by_by_g2 = kept[i].by_by_g2;
        const vector_f by_by_g1 = kept[i].by_by_g1;
        const vector_f by_by_g3 = kept[i].by_by_g3;
        const vector_f by_by_norm_s = kept[i].by_by_norm_s;
        const vector_f gap_2 = kept[i].gap_2;
        const vector_f gap_3 = kept[i].gap_3;
        const vector_f gap_4 = kept[i].gap_4;
        const vector_f by_log_det = kept[i].by_log_det;
        const vector_f product_6 = kept[i].product_6;
        const float M0_0 = S[19];
        const float M0_1 = S[20];
        const float M0_2 = S[21];
        const float M1_1 = S[22];
        const float M1_2 = S[23];
        const float M2_2 = S[24];
        const vector_mask_f its_near = norm_s_squared < 0.249287f;
        const vector_f by_atan2_norm_s_abs_g0 = 2.0f * by_t;
        const vector_f ratio_2 = by_atan2_norm_s_abs_g0 / total_6;
        const vector_f phi_product_4 = phi * gap_2;
        const vector_f phi_product_5 = phi * gap_3;
        const vector_f phi_product_6 = phi * gap_4;
        const vector_f by_v1 = M0_1 * phi_product_4 + M1_1 * phi_product_5 + M1_2 * phi_product_6 - total_4 *
            by_log_det;
        const vector_f by_v2 = M0_2 * phi_product_4 + M1_2 * phi_product_5 + M2_2 * phi_product_6 - total_3 *
            by_log_det;
        const vector_f total_13 = -(phi_product_3 * by_by_g1) - phi_product_2 * by_by_g2 - phi_product * by_by_g3
            + g3 * by_v2;
        const vector_f by_v0 = M0_0 * phi_product_4 + M0_1 * phi_product_5 + M0_2 * phi_product_6 - total_5 *
            by_log_det;
        const vector_f by_scale_2 = total_13 + g2 * by_v1 + g1 * by_v0;
        const vector_f by_t_over_norm_s_2 = chosen * by_scale_2;
        const vector_f by_t_2 = (vector_select_f(its_near, vector_of_f(0.0f), by_t_over_norm_s_2) - by_t *
            by_by_norm_s + product_6) / norm_s;
        kept[i].ratio_2 = ratio_2;
        kept[i].phi_product_4 = phi_product_4;
        kept[i].phi_product_5 = phi_product_5;
        kept[i].phi_product_6 = phi_product_6;
        kept[i].by_v1 = by_v1;
        kept[i].by_v2 = by_v2;
        kept[i].by_v0 = by_v0;
        kept[i].by_t_over_norm_s_2 = by_t_over_norm_s_2;
        kept[i].by_t_2 = by_t_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f abs_g0 = kept[i].abs_g0;
        const vector_f t_ratio = kept[i].t_ratio;
        const vector_f by_t = kept[i].by_t;
        const vector_f total_6 = kept[i].total_6;
        const vector_f ratio_2 = kept[i].ratio_2;
        const vector_f norm_s_product = kept[i].norm_s_product;
        const vector_f by_t_2 = kept[i].by_t_2;
        const vector_f by_norm_s = abs_g0 * ratio_2 - t_ratio * by_t;
        const vector_f by_norm_s_ratio = by_norm_s / norm_s_product;
        const vector_f by_atan2_norm_s_abs_g0_2 = 2.0f * by_t_2;
        const vector_f ratio_5 = by_atan2_norm_s_abs_g0_2 / total_6;
        kept[i].by_norm_s_ratio = by_norm_s_ratio;
        kept[i].ratio_5 = ratio_5;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f row_length = kept[i].row_length;
        const vector_f g3 = kept[i].g3;
        const vector_f g1 = kept[i].g1;
        const vector_f g2 = kept[i].g2;
        const vector_f norm_s_squared = kept[i].norm_s_squared;
        const vector_f g0 = kept[i].g0;
        const vector_f abs_g0 = kept[i].abs_g0;
        const vector_f log_det_series = kept[i].log_det_series;
        const vector_f norm_s = kept[i].norm_s;
        const vector_f t_ratio = kept[i].t_ratio;
        const vector_f scale = kept[i].scale;
        const vector_f phi = kept[i].phi;
        const vector_f phi_product = kept[i].phi_product;
        const vector_f phi_product_2 = kept[i].phi_product_2;
        const vector_f phi_product_3 = kept[i].phi_product_3;
        const vector_f by_t_over_norm_s = kept[i].by_t_over_norm_s;
        const vector_f by_t = kept[i].by_t;
        const vector_f ratio_2 = kept[i].ratio_2;
        const vector_f norm_s_product = kept[i].norm_s_product;
        const vector_f by_norm_s_ratio = kept[i].by_norm_s_ratio;
        const vector_f t_over_norm_s_near_slope = kept[i].t_over_norm_s_near_slope;
        const vector_f log_det_series_slope = kept[i].log_det_series_slope;
        const vector_f gap = kept[i].gap;
        const vector_f by_by_norm_s = kept[i].by_by_norm_s;
        const vector_f by_by_atan2_norm_s_abs_g0 = kept[i].by_by_atan2_norm_s_abs_g0;
        const vector_f by_by_t_ratio = kept[i].by_by_t_ratio;
        const vector_f by_by_log_det_series = kept[i].by_by_log_det_series;
        const vector_f by_log_det = kept[i].by_log_det;
        const vector_f by_t_2 = kept[i].by_t_2;
        const vector_f ratio_5 = kept[i].ratio_5;
        const vector_mask_f its_near = norm_s_squared < 0.249287f;
        const vector_mask_f is_small = g0 < 0.0f;
        const vector_f by_log_det_near = vector_select_f(its_near, phi, vector_of_f(0.0f));
        const vector_f by_t_over_norm_s_near = vector_select_f(its_near, by_t_over_norm_s, vector_of_f(0.0f));
        const vector_f by_log_det_series = norm_s_squared * by_log_det_near;
        const vector_f by_norm_s_squared = vector_select_f(its_near, vector_of_f(0.0f), by_norm_s_ratio) +
            log_det_series * by_log_det_near + 4.011440628672975f * vector_select_f(its_near,
            by_t_over_norm_s_near * t_over_norm_s_near_slope + by_log_det_series * log_det_series_slope,
            vector_of_f(0.0f));
        const vector_f product_2 = 2.0f * by_norm_s_squared;
        const vector_f by_g3 = g3 * product_2 - scale * phi_product;
        const vector_f by_g3_ratio = by_g3 / row_length;
        const vector_f norm_s_product_2 = norm_s * ratio_2;
        const vector_f by_abs_g0 = -norm_s_product_2;
        const vector_f by_g0 = vector_select_f(is_small, norm_s_product_2, by_abs_g0);
        const vector_f by_g0_ratio = by_g0 / row_length;
        const vector_f by_g2 = g2 * product_2 - scale * phi_product_2;
        const vector_f by_g2_ratio = by_g2 / row_length;
        const vector_f by_g1 = g1 * product_2 - scale * phi_product_3;
        const vector_f by_g1_ratio = by_g1 / row_length;
        const vector_f gap_5 = ratio_2 * gap - 2.0f * (by_norm_s_ratio * by_by_norm_s) - by_t * by_by_t_ratio -
            t_ratio * by_t_2;
        const vector_f by_norm_s_2 = gap_5 + abs_g0 * ratio_5;
        const vector_f product_7 = ratio_2 * by_by_atan2_norm_s_abs_g0;
        const vector_f by_log_det_near_2 = vector_select_f(its_near, by_log_det, vector_of_f(0.0f));
        const vector_f total_14 = by_log_det_near * by_by_log_det_series + vector_select_f(its_near,
            vector_of_f(0.0f), by_norm_s_2 / norm_s_product - product_7) + log_det_series * by_log_det_near_2;
        kept[i].by_log_det_near = by_log_det_near;
        kept[i].by_t_over_norm_s_near = by_t_over_norm_s_near;
        kept[i].by_log_det_series = by_log_det_series;
        kept[i].product_2 = product_2;
        kept[i].by_g3_ratio = by_g3_ratio;
        kept[i].by_g0_ratio = by_g0_ratio;
        kept[i].by_g2_ratio = by_g2_ratio;
        kept[i].by_g1_ratio = by_g1_ratio;
        kept[i].product_7 = product_7;
        kept[i].by_log_det_near_2 = by_log_det_near_2;
        kept[i].total_14 = total_14;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f row_length = kept[i].row_length;
        const vector_f g3 = kept[i].g3;
        const vector_f g1 = kept[i].g1;
        const vector_f g2 = kept[i].g2;
        const vector_f norm_s_squared = kept[i].norm_s_squared;
        const vector_f g0 = kept[i].g0;
        const vector_f abs_g0 = kept[i].abs_g0;
        const vector_f near_chosen = kept[i].near_chosen;
        const vector_f norm_s = kept[i].norm_s;
        const vector_f scale = kept[i].scale;
        const vector_f phi_product = kept[i].phi_product;
        const vector_f phi_product_2 = kept[i].phi_product_2;
        const vector_f phi_product_3 = kept[i].phi_product_3;
        const vector_f ratio_2 = kept[i].ratio_2;
        const vector_f by_log_det_near = kept[i].by_log_det_near;
        const vector_f by_t_over_norm_s_near = kept[i].by_t_over_norm_s_near;
        const vector_f t_over_norm_s_near_slope = kept[i].t_over_norm_s_near_slope;
        const vector_f by_log_det_series = kept[i].by_log_det_series;
        const vector_f log_det_series_slope = kept[i].log_det_series_slope;
        const vector_f product_2 = kept[i].product_2;
        const vector_f by_g3_ratio = kept[i].by_g3_ratio;
        const vector_f by_g0_ratio = kept[i].by_g0_ratio;
        const vector_f by_g2_ratio = kept[i].by_g2_ratio;
        const vector_f by_g1_ratio = kept[i].by_g1_ratio;
        const vector_f product_3 = kept[i].product_3;
        const vector_f by_by_row_length = kept[i].by_by_row_length;
        const vector_f by_by_g2 = kept[i].by_by_g2;
        const vector_f by_by_g1 = kept[i].by_by_g1;
        const vector_f by_by_g3 = kept[i].by_by_g3;
        const vector_f by_by_norm_s_squared = kept[i].by_by_norm_s_squared;
        const vector_f by_by_norm_s = kept[i].by_by_norm_s;
        const vector_f near_chosen_3 = kept[i].near_chosen_3;
        const vector_f by_by_scale = kept[i].by_by_scale;
        const vector_f by_v1 = kept[i].by_v1;
        const vector_f by_v2 = kept[i].by_v2;
        const vector_f by_v0 = kept[i].by_v0;
        const vector_f by_t_over_norm_s_2 = kept[i].by_t_over_norm_s_2;
        const vector_f ratio_5 = kept[i].ratio_5;
        const vector_f product_7 = kept[i].product_7;
        const vector_f by_log_det_near_2 = kept[i].by_log_det_near_2;
        const vector_f total_14 = kept[i].total_14;
        const vector_mask_f its_near = norm_s_squared < 0.249287f;
        const vector_mask_f is_small = g0 < 0.0f;
        const vector_f by_row_length = -(g0 * by_g0_ratio) - g3 * by_g3_ratio - g2 * by_g2_ratio - g1 *
            by_g1_ratio;
        const vector_f ratio_3 = by_row_length / product_3;
        const vector_f by_log_det_series_slope = by_log_det_series * near_chosen_3;
        const vector_f log_det_series_slope_slope = vector_polynomial_log_det_series_slope_slope_f(near_chosen);
        const vector_f by_t_over_norm_s_near_slope = by_t_over_norm_s_near * near_chosen_3;
        const vector_f t_over_norm_s_near_slope_slope =
            vector_polynomial_t_over_norm_s_near_slope_slope_f(near_chosen);
        const vector_f by_t_over_norm_s_near_2 = vector_select_f(its_near, by_t_over_norm_s_2, vector_of_f(0.0f));
        const vector_f by_log_det_series_2 = by_log_det_near * by_by_norm_s_squared + norm_s_squared *
            by_log_det_near_2;
        const vector_f near_chosen_4 = vector_select_f(its_near, by_log_det_series_slope *
            log_det_series_slope_slope + by_t_over_norm_s_near_slope * t_over_norm_s_near_slope_slope +
            t_over_norm_s_near_slope * by_t_over_norm_s_near_2 + log_det_series_slope * by_log_det_series_2,
            vector_of_f(0.0f));
        const vector_f by_norm_s_squared_2 = total_14 + 4.011440628672975f * near_chosen_4;
        const vector_f product_8 = 2.0f * by_norm_s_squared_2;
        const vector_f by_g2_2 = product_2 * by_by_g2 - by_g2_ratio * by_by_row_length - phi_product_2 *
            by_by_scale + scale * by_v1 + g2 * product_8;
        const vector_f by_g2_ratio_2 = by_g2_2 / row_length;
        const vector_f norm_s_product_3 = norm_s * ratio_5;
        const vector_f gap_7 = ratio_2 * by_by_norm_s - abs_g0 * (2.0f * product_7);
        const vector_f by_abs_g0_2 = gap_7 - norm_s_product_3;
        const vector_f by_g0_2 = vector_select_f(is_small, norm_s_product_3 - gap_7, by_abs_g0_2) - by_g0_ratio *
            by_by_row_length;
        const vector_f by_g0_ratio_2 = by_g0_2 / row_length;
        const vector_f by_g3_2 = product_2 * by_by_g3 - by_g3_ratio * by_by_row_length - phi_product * by_by_scale
            + scale * by_v2 + g3 * product_8;
        const vector_f by_g3_ratio_2 = by_g3_2 / row_length;
        const vector_f by_g1_2 = product_2 * by_by_g1 - by_g1_ratio * by_by_row_length - phi_product_3 *
            by_by_scale + scale * by_v0 + g1 * product_8;
        const vector_f by_g1_ratio_2 = by_g1_2 / row_length;
        kept[i].ratio_3 = ratio_3;
        kept[i].by_g2_ratio_2 = by_g2_ratio_2;
        kept[i].by_g0_ratio_2 = by_g0_ratio_2;
        kept[i].by_g3_ratio_2 = by_g3_ratio_2;
        kept[i].by_g1_ratio_2 = by_g1_ratio_2;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f total_2 = kept[i].total_2;
        const vector_f g3 = kept[i].g3;
        const vector_f g1 = kept[i].g1;
        const vector_f g2 = kept[i].g2;
        const vector_f g0 = kept[i].g0;
        const vector_f by_g3_ratio = kept[i].by_g3_ratio;
        const vector_f by_g0_ratio = kept[i].by_g0_ratio;
        const vector_f by_g2_ratio = kept[i].by_g2_ratio;
        const vector_f by_g1_ratio = kept[i].by_g1_ratio;
        const vector_f product_3 = kept[i].product_3;
        const vector_f ratio_3 = kept[i].ratio_3;
        const vector_f by_by_row_length = kept[i].by_by_row_length;
        const vector_f by_by_g2 = kept[i].by_by_g2;
        const vector_f by_by_g0 = kept[i].by_by_g0;
        const vector_f by_by_g1 = kept[i].by_by_g1;
        const vector_f by_by_g3 = kept[i].by_by_g3;
        const vector_f by_g2_ratio_2 = kept[i].by_g2_ratio_2;
        const vector_f by_g0_ratio_2 = kept[i].by_g0_ratio_2;
        const vector_f by_g3_ratio_2 = kept[i].by_g3_ratio_2;
        const vector_f by_g1_ratio_2 = kept[i].by_g1_ratio_2;
        const vector_mask_f is_small_2 = total_2 == 0.0f;
        const vector_f gap_6 = vector_select_f(is_small_2, vector_of_f(0.0f), -2.0f * (ratio_3 *
            by_by_row_length)) - by_g1_ratio * by_by_g1;
        const vector_f gap_8 = gap_6 - by_g2_ratio * by_by_g2 - by_g3_ratio * by_by_g3 - by_g0_ratio * by_by_g0 -
            g0 * by_g0_ratio_2;
        const vector_f by_row_length_2 = gap_8 - g3 * by_g3_ratio_2 - g2 * by_g2_ratio_2 - g1 * by_g1_ratio_2;
        const vector_f product_9 = 2.0f * vector_select_f(is_small_2, vector_of_f(0.0f), by_row_length_2 /
            product_3);
        kept[i].product_9 = product_9;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 19 * (size_t)near[i];
        const vector_f *slope_bar = points + 19 * (size_t)near[i] + 9 + 1;
        const vector_f square0 = kept[i].square0;
        const vector_f square1 = kept[i].square1;
        const vector_f largest = kept[i].largest;
        const vector_f square2 = kept[i].square2;
        const vector_f largest_2 = kept[i].largest_2;
        const vector_f square3 = kept[i].square3;
        const vector_f row_12 = kept[i].row_12;
        const vector_f row_10 = kept[i].row_10;
        const vector_f row_11 = kept[i].row_11;
        const vector_f row_9 = kept[i].row_9;
        const vector_f total_2 = kept[i].total_2;
        const vector_f v0 = kept[i].v0;
        const vector_f v1 = kept[i].v1;
        const vector_f v2 = kept[i].v2;
        const vector_f by_g3_ratio = kept[i].by_g3_ratio;
        const vector_f by_g0_ratio = kept[i].by_g0_ratio;
        const vector_f by_g2_ratio = kept[i].by_g2_ratio;
        const vector_f by_g1_ratio = kept[i].by_g1_ratio;
        const vector_f ratio_3 = kept[i].ratio_3;
        const vector_f by_by_row_11 = kept[i].by_by_row_11;
        const vector_f by_by_row_10 = kept[i].by_by_row_10;
        const vector_f by_by_row_12 = kept[i].by_by_row_12;
        const vector_f by_by_row_9 = kept[i].by_by_row_9;
        const vector_f phi_product_4 = kept[i].phi_product_4;
        const vector_f phi_product_5 = kept[i].phi_product_5;
        const vector_f phi_product_6 = kept[i].phi_product_6;
        const vector_f by_log_det = kept[i].by_log_det;
        const vector_f by_g2_ratio_2 = kept[i].by_g2_ratio_2;
        const vector_f by_g0_ratio_2 = kept[i].by_g0_ratio_2;
        const vector_f by_g3_ratio_2 = kept[i].by_g3_ratio_2;
        const vector_f by_g1_ratio_2 = kept[i].by_g1_ratio_2;
        const vector_f product_9 = kept[i].product_9;
        const vector_f x0 = X[0];
        const vector_f x1 = X[1];
        const vector_f x2 = X[2];
        const vector_f x3 = X[3];
        const vector_f x4 = X[4];
        const vector_f x5 = X[5];
        const vector_f x6 = X[6];
        const vector_f x7 = X[7];
        const vector_f x8 = X[8];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_f x2_bar = slope_bar[2];
        const vector_f x3_bar = slope_bar[3];
        const vector_f x4_bar = slope_bar[4];
        const vector_f x5_bar = slope_bar[5];
        const vector_f x6_bar = slope_bar[6];
        const vector_f x7_bar = slope_bar[7];
        const vector_f x8_bar = slope_bar[8];
        const vector_mask_f is_less = square0 < square1;
        const vector_mask_f is_less_2 = largest < square2;
        const vector_mask_f is_less_3 = largest_2 < square3;
        const vector_mask_f is_small_2 = total_2 == 0.0f;
        const vector_f product_4 = 2.0f * vector_select_f(is_small_2, vector_of_f(0.0f), ratio_3);
        const vector_f by_row_12 = by_g3_ratio + row_12 * product_4;
        const vector_f by_square3 = vector_select_f(is_less_3, by_row_12, vector_of_f(0.0f));
        const vector_f by_row_11 = by_g2_ratio + row_11 * product_4;
        const vector_f by_row_7 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_11);
        const vector_f by_square2 = vector_select_f(is_less_2, by_row_7, vector_of_f(0.0f));
        const vector_f by_row_9 = by_g0_ratio + row_9 * product_4;
        const vector_f by_row_5 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_9);
        const vector_f by_row = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_5);
        const vector_f by_square0 = vector_select_f(is_less, vector_of_f(0.0f), by_row);
        const vector_f by_row_10 = by_g1_ratio + row_10 * product_4;
        const vector_f by_row_6 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_10);
        const vector_f by_row_2 = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_6);
        const vector_f by_square1 = vector_select_f(is_less, by_row_2, vector_of_f(0.0f));
        const vector_f by_R0_0 = -by_square3 - by_square2 + (by_square0 + by_square1);
        const vector_f by_row_3 = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_7);
        const vector_f total_7 = vector_select_f(is_less_2, by_row_5, vector_of_f(0.0f)) +
            vector_select_f(is_less, vector_of_f(0.0f), by_row_3);
        const vector_f by_row_8 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_12);
        const vector_f by_row_4 = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_8);
        const vector_f total_8 = vector_select_f(is_less, by_row_4, vector_of_f(0.0f)) +
            vector_select_f(is_less_3, by_row_10, vector_of_f(0.0f));
        const vector_f by_R0_2 = total_7 + total_8;
        const vector_f total_9 = vector_select_f(is_less, by_row_3, vector_of_f(0.0f)) +
            vector_select_f(is_less_2, by_row_6, vector_of_f(0.0f));
        const vector_f total_10 = vector_select_f(is_less_3, by_row_9, vector_of_f(0.0f)) +
            vector_select_f(is_less, vector_of_f(0.0f), by_row_4);
        const vector_f by_R0_1 = total_9 - total_10;
        const vector_f by_row_11_2 = product_4 * by_by_row_11 + by_g2_ratio_2 + row_11 * product_9;
        const vector_f by_row_7_2 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_11_2);
        const vector_f by_row_3_2 = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_7_2);
        const vector_f by_row_10_2 = product_4 * by_by_row_10 + by_g1_ratio_2 + row_10 * product_9;
        const vector_f by_row_6_2 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_10_2);
        const vector_f total_15 = vector_select_f(is_less, by_row_3_2, vector_of_f(0.0f)) +
            vector_select_f(is_less_2, by_row_6_2, vector_of_f(0.0f));
        const vector_f by_row_9_2 = product_4 * by_by_row_9 + by_g0_ratio_2 + row_9 * product_9;
        const vector_f by_row_12_2 = product_4 * by_by_row_12 + by_g3_ratio_2 + row_12 * product_9;
        const vector_f by_row_8_2 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_12_2);
        const vector_f by_row_4_2 = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_8_2);
        const vector_f total_16 = vector_select_f(is_less_3, by_row_9_2, vector_of_f(0.0f)) +
            vector_select_f(is_less, vector_of_f(0.0f), by_row_4_2);
        const vector_f by_R0_1_2 = total_15 - total_16;
        const vector_f by_row_5_2 = vector_select_f(is_less_3, vector_of_f(0.0f), by_row_9_2);
        const vector_f total_17 = vector_select_f(is_less_2, by_row_5_2, vector_of_f(0.0f)) +
            vector_select_f(is_less, vector_of_f(0.0f), by_row_3_2);
        const vector_f total_18 = vector_select_f(is_less, by_row_4_2, vector_of_f(0.0f)) +
            vector_select_f(is_less_3, by_row_10_2, vector_of_f(0.0f));
        const vector_f by_R0_2_2 = total_17 + total_18;
        const vector_f by_square3_2 = vector_select_f(is_less_3, by_row_12_2, vector_of_f(0.0f));
        const vector_f by_square2_2 = vector_select_f(is_less_2, by_row_7_2, vector_of_f(0.0f));
        const vector_f by_row_13 = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_5_2);
        const vector_f by_square0_2 = vector_select_f(is_less, vector_of_f(0.0f), by_row_13);
        const vector_f by_row_2_2 = vector_select_f(is_less_2, vector_of_f(0.0f), by_row_6_2);
        const vector_f by_square1_2 = vector_select_f(is_less, by_row_2_2, vector_of_f(0.0f));
        const vector_f by_R0_0_2 = -by_square3_2 - by_square2_2 + (by_square0_2 + by_square1_2);
        const vector_f by_R1_1 = by_square0 + (by_square2 - by_square3 - by_square1);
        const vector_f by_R1_0 = total_10 + total_9;
        const vector_f total_20 = vector_select_f(is_less_2, by_row_8, vector_of_f(0.0f)) +
            vector_select_f(is_less_3, by_row_11, vector_of_f(0.0f));
        const vector_f total_21 = vector_select_f(is_less, by_row, vector_of_f(0.0f)) + vector_select_f(is_less,
            vector_of_f(0.0f), by_row_2);
        const vector_f by_R1_2 = total_20 - total_21;
        const vector_f total_22 = vector_select_f(is_less_2, by_row_8_2, vector_of_f(0.0f)) +
            vector_select_f(is_less_3, by_row_11_2, vector_of_f(0.0f));
        const vector_f total_23 = vector_select_f(is_less, by_row_13, vector_of_f(0.0f)) +
            vector_select_f(is_less, vector_of_f(0.0f), by_row_2_2);
        const vector_f by_R1_2_2 = total_22 - total_23;
        const vector_f by_R1_0_2 = total_16 + total_15;
        const vector_f by_R1_1_2 = by_square0_2 + (by_square2_2 - by_square3_2 - by_square1_2);
        const vector_f by_R2_2 = by_square0 + (by_square3 - by_square2 - by_square1);
        const vector_f by_R2_0 = total_8 - total_7;
        const vector_f by_R2_1 = total_20 + total_21;
        const vector_f by_R2_1_2 = total_22 + total_23;
        const vector_f by_R2_0_2 = total_18 - total_17;
        const vector_f by_R2_2_2 = by_square0_2 + (by_square3_2 - by_square2_2 - by_square1_2);
        const vector_f by_log_det_product = 0.5f * by_log_det;
        const vector_f gap_9 = phi_product_4 - v0 * by_log_det_product;
        const vector_f gap_10 = phi_product_5 - v1 * by_log_det_product;
        const vector_f gap_11 = phi_product_6 - v2 * by_log_det_product;
        sums[0] = sums[0] + by_R0_0 * x0_bar + by_R0_2 * x2_bar + by_R0_1 * x1_bar + x1 * by_R0_1_2 + x2 *
                by_R0_2_2 + x0 * by_R0_0_2;
        sums[1] = sums[1] + by_R1_1 * x1_bar + by_R1_0 * x0_bar + by_R1_2 * x2_bar + x2 * by_R1_2_2 + x0 *
                by_R1_0_2 + x1 * by_R1_1_2;
        sums[2] = sums[2] + by_R2_2 * x2_bar + by_R2_0 * x0_bar + by_R2_1 * x1_bar + x1 * by_R2_1_2 + x0 *
                by_R2_0_2 + x2 * by_R2_2_2;
        sums[3] = sums[3] + by_R0_0 * x3_bar + by_R0_2 * x5_bar + by_R0_1 * x4_bar + x4 * by_R0_1_2 + x5 *
                by_R0_2_2 + x3 * by_R0_0_2;
        sums[4] = sums[4] + by_R1_1 * x4_bar + by_R1_0 * x3_bar + by_R1_2 * x5_bar + x5 * by_R1_2_2 + x3 *
                by_R1_0_2 + x4 * by_R1_1_2;
        sums[5] = sums[5] + by_R2_2 * x5_bar + by_R2_0 * x3_bar + by_R2_1 * x4_bar + x4 * by_R2_1_2 + x3 *
                by_R2_0_2 + x5 * by_R2_2_2;
        sums[6] = sums[6] + by_R0_0 * x6_bar + by_R0_2 * x8_bar + by_R0_1 * x7_bar + x7 * by_R0_1_2 + x8 *
                by_R0_2_2 + x6 * by_R0_0_2;
        sums[7] = sums[7] + by_R1_1 * x7_bar + by_R1_0 * x6_bar + by_R1_2 * x8_bar + x8 * by_R1_2_2 + x6 *
                by_R1_0_2 + x7 * by_R1_1_2;
        sums[8] = sums[8] + by_R2_2 * x8_bar + by_R2_0 * x6_bar + by_R2_1 * x7_bar + x7 * by_R2_1_2 + x6 *
                by_R2_0_2 + x8 * by_R2_2_2;
        sums[9] = sums[9] + by_log_det;
        sums[10] = sums[10] + v0 * gap_9;
        sums[11] = sums[11] + v0 * gap_10 + v1 * gap_9;
        sums[12] = sums[12] + v0 * gap_11 + v2 * gap_9;
        sums[13] = sums[13] + v1 * gap_10;
        sums[14] = sums[14] + v1 * gap_11 + v2 * gap_10;
        sums[15] = sums[15] + v2 * gap_11;
    }
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, const vector_f *sums, vector_f *mu_bar, vector_f *W_bar, vector_f *amplitude_bar) {
    (void)mu;
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
    const vector_f sum15 = sums[15];
    const vector_f product = 2.0f * sum10;
    const vector_f product_2 = 2.0f * sum13;
    const vector_f product_3 = 2.0f * sum15;
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = its_amplitude * sum1;
    mu_bar[2] = its_amplitude * sum2;
    mu_bar[3] = its_amplitude * sum3;
    mu_bar[4] = its_amplitude * sum4;
    mu_bar[5] = its_amplitude * sum5;
    mu_bar[6] = its_amplitude * sum6;
    mu_bar[7] = its_amplitude * sum7;
    mu_bar[8] = its_amplitude * sum8;
    W_bar[0] = its_amplitude * (W0_0 * product + W0_1 * sum11 + W0_2 * sum12);
    W_bar[1] = its_amplitude * (W0_0 * sum11 + W0_1 * product_2 + W0_2 * sum14);
    W_bar[2] = its_amplitude * (W0_0 * sum12 + W0_1 * sum14 + W0_2 * product_3);
    W_bar[3] = its_amplitude * (W1_0 * product + W1_1 * sum11 + W1_2 * sum12);
    W_bar[4] = its_amplitude * (W1_0 * sum11 + W1_1 * product_2 + W1_2 * sum14);
    W_bar[5] = its_amplitude * (W1_0 * sum12 + W1_1 * sum14 + W1_2 * product_3);
    W_bar[6] = its_amplitude * (W2_0 * product + W2_1 * sum11 + W2_2 * sum12);
    W_bar[7] = its_amplitude * (W2_0 * sum11 + W2_1 * product_2 + W2_2 * sum14);
    W_bar[8] = its_amplitude * (W2_0 * sum12 + W2_1 * sum14 + W2_2 * product_3);
    amplitude_bar[0] = sum9;
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

/* Scratch memory: 19 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t so3_matrix_splats_work_f(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES_f - 1) / LANES_f, blocks = (points + 2 - 1) / 2;
    const size_t places = 0 * ((splat_count + LANES_f - 1) / LANES_f + (blocks + LANES_f - 1) / LANES_f);
    return (points * 19 + places + 1) * LANES_f + 25 * splat_count;
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
    return work_points_f(work) + (count + LANES_f - 1) / LANES_f * 19;
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
    vector_f own_mu[9], own_W[9], own_amplitude[1], S[25];
    vector_rows_f(mu, splat_count, start, 9, own_mu);
    vector_rows_f(W, splat_count, start, 9, own_W);
    vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants_f(own_mu, own_W, own_amplitude, S);
    vector_to_rows_f(S, constants, splat_count, start, 25, 25);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void so3_matrix_splats_f(
    size_t count, size_t splat_count, const float *SO3_MATRIX_RESTRICT x, const float *SO3_MATRIX_RESTRICT mu, const float *SO3_MATRIX_RESTRICT W, const float *SO3_MATRIX_RESTRICT amplitude, const float *SO3_MATRIX_RESTRICT width,
    float *SO3_MATRIX_RESTRICT value, float *SO3_MATRIX_RESTRICT gradient, float *SO3_MATRIX_RESTRICT work, int threads) {
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
            vector_f at[2][9], X[2 * 9], grad[3];
            vector_f value_sum[2] = {ZERO}, slope_sum[2 * 9] = {ZERO};
            float place[9 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 9, at[b]);
                pair_features_f(at[b], X + 9 * b);
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
                pair_gradient_f(at[b], slope_sum + 9 * b, grad);
                vector_to_rows_f(value_sum + b, value, count, start + b * LANES_f, 1, 1);
                vector_to_rows_f(grad, gradient, count, start + b * LANES_f, 3, 3);
            }
        }
        restore_denormals(mode);
    }
}

void so3_matrix_splats_value_f(
    size_t count, size_t splat_count, const float *SO3_MATRIX_RESTRICT x, const float *SO3_MATRIX_RESTRICT mu, const float *SO3_MATRIX_RESTRICT W, const float *SO3_MATRIX_RESTRICT amplitude, const float *SO3_MATRIX_RESTRICT width,
    float *SO3_MATRIX_RESTRICT value, float *SO3_MATRIX_RESTRICT work, int threads) {
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
            vector_f at[9], X[2 * 9], value_sum[2] = {ZERO};
            float place[9 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 9, at);
                pair_features_f(at, X + 9 * b);
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
    vector_f at[9], grad_bar[3], slope_bar[9];
    vector_rows_f(x, count, start, 9, at);
    vector_rows_f(gradient_bar, count, start, 3, grad_bar);
    vector_rows_f(value_bar, count, start, 1, point + 9);
    pair_features_f(at, point);
    pair_gradient_vjp_f(at, grad_bar, slope_bar);
    for (int i = 0; i < 9; ++i) point[9 + 1 + i] = slope_bar[i];
    vector_end_f(count, start, 9 + 1, point + 9);
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums_f(const vector_f *points, const uint32_t *near, size_t size, const float *S, float *sums) {
    vector_f sum[16] = {ZERO};
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
    sums[15] += vector_sum_f(sum[15]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void so3_matrix_splats_vjp_f(
    size_t count, size_t splat_count, const float *SO3_MATRIX_RESTRICT x, const float *SO3_MATRIX_RESTRICT mu, const float *SO3_MATRIX_RESTRICT W, const float *SO3_MATRIX_RESTRICT amplitude, const float *SO3_MATRIX_RESTRICT width, const float *SO3_MATRIX_RESTRICT value_bar, const float *SO3_MATRIX_RESTRICT gradient_bar,
    float *SO3_MATRIX_RESTRICT mu_bar, float *SO3_MATRIX_RESTRICT W_bar, float *SO3_MATRIX_RESTRICT amplitude_bar, float *SO3_MATRIX_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES_f - 1) / LANES_f;
    const size_t chunk = 131072 / (19 * sizeof(vector_f)) + 1;
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
                float place[9 + 1];
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
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, points + 19 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            float sums[LANES_f][16] = {{0}};
            uint32_t near[131072 / (19 * sizeof(vector_f)) + 2];
            vector_f own_mu[9], own_W[9], own_amplitude[1], own_sums[16], bars[19];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const float *reach = width ? splat_at_f(splats, k) + 9 * LANES_f : NULL;
                    const size_t some = blocks_near_f(mu + 9 * k, reach, places, first, first + size, near);
                    splat_sums_f(points + 19 * first, near, some, constants + 25 * k, sums[k - start]);
                }
            }
            vector_rows_f(mu, end, start, 9, own_mu);
            vector_rows_f(W, end, start, 9, own_W);
            vector_rows_f(amplitude, end, start, 1, own_amplitude);
            vector_rows_f(sums[0], LANES_f, 0, 16, own_sums);
            pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 9, bars + 9 + 9);
            vector_to_rows_f(bars, mu_bar, end, start, 9, 9);
            vector_to_rows_f(bars + 9, W_bar, end, start, 9, 9);
            vector_to_rows_f(bars + 9 + 9, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void so3_matrix_splats_rows_f(
    size_t count, size_t splat_count, const float *SO3_MATRIX_RESTRICT x, const float *SO3_MATRIX_RESTRICT mu, const float *SO3_MATRIX_RESTRICT W, const float *SO3_MATRIX_RESTRICT amplitude, const float *SO3_MATRIX_RESTRICT value_bar, const float *SO3_MATRIX_RESTRICT gradient_bar,
    float *SO3_MATRIX_RESTRICT rows, float *SO3_MATRIX_RESTRICT work, int threads) {
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
            vector_f point[19];
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector_f own_mu[9], own_W[9], own_amplitude[1], own_sums[16] = {ZERO}, bars[19];
                for (int i = 0; i < 9; ++i) own_mu[i] = vector_of_f(mu[9 * k + i]);
                for (int i = 0; i < 9; ++i) own_W[i] = vector_of_f(W[9 * k + i]);
                own_amplitude[0] = vector_of_f(amplitude[k]);
                pair_backward_f(1, point, &only, constants + 25 * k, own_sums);
                pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 9, bars + 9 + 9);
                vector_to_rows_f(bars, rows + 19 * k, count, block * LANES_f, 19, 19 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

double so3_matrix_splats_order_f(
    size_t count, size_t splat_count, const float *SO3_MATRIX_RESTRICT x, const float *SO3_MATRIX_RESTRICT mu, const float *SO3_MATRIX_RESTRICT amplitude, const float *SO3_MATRIX_RESTRICT width,
    double limit, size_t *SO3_MATRIX_RESTRICT order, float *SO3_MATRIX_RESTRICT work) {
    (void)x, (void)mu, (void)amplitude, (void)width, (void)limit, (void)work;
    (void)splat_count;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    return 1;
}

#endif /* float */
