/*
 * se3: Poses of a rigid body, R^3 x SO(3); a rotation by one radian is as long as `radius`, in the unit of the
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "se3.h"

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
INLINE vector vector_polynomial_rotation_eta(vector x) {
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
INLINE vector vector_polynomial_rotation_eta_slope(vector x) {
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
    const vector x4 = x[4];
    const vector x5 = x[5];
    const vector x6 = x[6];
    X[0] = x0;
    X[1] = x1;
    X[2] = x2;
    X[3] = x3;
    X[4] = x4;
    X[5] = x5;
    X[6] = x6;
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
    const vector W0_0 = W[0];
    const vector W0_1 = W[1];
    const vector W0_2 = W[2];
    const vector W0_3 = W[3];
    const vector W0_4 = W[4];
    const vector W0_5 = W[5];
    const vector W1_0 = W[6];
    const vector W1_1 = W[7];
    const vector W1_2 = W[8];
    const vector W1_3 = W[9];
    const vector W1_4 = W[10];
    const vector W1_5 = W[11];
    const vector W2_0 = W[12];
    const vector W2_1 = W[13];
    const vector W2_2 = W[14];
    const vector W2_3 = W[15];
    const vector W2_4 = W[16];
    const vector W2_5 = W[17];
    const vector W3_0 = W[18];
    const vector W3_1 = W[19];
    const vector W3_2 = W[20];
    const vector W3_3 = W[21];
    const vector W3_4 = W[22];
    const vector W3_5 = W[23];
    const vector W4_0 = W[24];
    const vector W4_1 = W[25];
    const vector W4_2 = W[26];
    const vector W4_3 = W[27];
    const vector W4_4 = W[28];
    const vector W4_5 = W[29];
    const vector W5_0 = W[30];
    const vector W5_1 = W[31];
    const vector W5_2 = W[32];
    const vector W5_3 = W[33];
    const vector W5_4 = W[34];
    const vector W5_5 = W[35];
    const vector its_amplitude = amplitude[0];
    const vector total_2 = W0_0 * W0_0 + W1_0 * W1_0 + W2_0 * W2_0 + W3_0 * W3_0 + W4_0 * W4_0;
    const vector M0_0 = total_2 + W5_0 * W5_0;
    const vector total_3 = W0_0 * W0_1 + W1_0 * W1_1 + W2_0 * W2_1 + W3_0 * W3_1 + W4_0 * W4_1;
    const vector M0_1 = total_3 + W5_0 * W5_1;
    const vector total_4 = W0_0 * W0_2 + W1_0 * W1_2 + W2_0 * W2_2 + W3_0 * W3_2 + W4_0 * W4_2;
    const vector M0_2 = total_4 + W5_0 * W5_2;
    const vector total_5 = W0_1 * W0_1 + W1_1 * W1_1 + W2_1 * W2_1 + W3_1 * W3_1 + W4_1 * W4_1;
    const vector M1_1 = total_5 + W5_1 * W5_1;
    const vector total_6 = W0_1 * W0_2 + W1_1 * W1_2 + W2_1 * W2_2 + W3_1 * W3_2 + W4_1 * W4_2;
    const vector M1_2 = total_6 + W5_1 * W5_2;
    const vector total_7 = W0_2 * W0_2 + W1_2 * W1_2 + W2_2 * W2_2 + W3_2 * W3_2 + W4_2 * W4_2;
    const vector M2_2 = total_7 + W5_2 * W5_2;
    const vector product = 2.0 * mu3;
    const vector product_2 = 2.0 * mu4;
    const vector product_3 = 2.0 * mu5;
    const vector rotation_R0_3 = W0_5 * product + W0_4 * product_2 - W0_3 * product_3;
    const vector product_4 = 2.0 * mu6;
    const vector rotation_R0_0 = -(W0_5 * product_4) - W0_4 * product_3 - W0_3 * product_2;
    const vector rotation_R0_2 = W0_4 * product - W0_5 * product_2 + W0_3 * product_4;
    const vector rotation_R0_1 = W0_5 * product_3 - W0_4 * product_4 + W0_3 * product;
    const vector rotation_R1_3 = W1_5 * product + W1_4 * product_2 - W1_3 * product_3;
    const vector rotation_R1_0 = -(W1_5 * product_4) - W1_4 * product_3 - W1_3 * product_2;
    const vector rotation_R1_2 = W1_4 * product - W1_5 * product_2 + W1_3 * product_4;
    const vector rotation_R1_1 = W1_5 * product_3 - W1_4 * product_4 + W1_3 * product;
    const vector rotation_R2_3 = W2_5 * product + W2_4 * product_2 - W2_3 * product_3;
    const vector rotation_R2_0 = -(W2_5 * product_4) - W2_4 * product_3 - W2_3 * product_2;
    const vector rotation_R2_2 = W2_4 * product - W2_5 * product_2 + W2_3 * product_4;
    const vector rotation_R2_1 = W2_5 * product_3 - W2_4 * product_4 + W2_3 * product;
    const vector rotation_R3_3 = W3_5 * product + W3_4 * product_2 - W3_3 * product_3;
    const vector rotation_R3_0 = -(W3_5 * product_4) - W3_4 * product_3 - W3_3 * product_2;
    const vector rotation_R3_2 = W3_4 * product - W3_5 * product_2 + W3_3 * product_4;
    const vector rotation_R3_1 = W3_5 * product_3 - W3_4 * product_4 + W3_3 * product;
    const vector rotation_R4_3 = W4_5 * product + W4_4 * product_2 - W4_3 * product_3;
    const vector rotation_R4_0 = -(W4_5 * product_4) - W4_4 * product_3 - W4_3 * product_2;
    const vector rotation_R4_2 = W4_4 * product - W4_5 * product_2 + W4_3 * product_4;
    const vector rotation_R4_1 = W4_5 * product_3 - W4_4 * product_4 + W4_3 * product;
    const vector rotation_R5_3 = W5_5 * product + W5_4 * product_2 - W5_3 * product_3;
    const vector rotation_R5_0 = -(W5_5 * product_4) - W5_4 * product_3 - W5_3 * product_2;
    const vector rotation_R5_2 = W5_4 * product - W5_5 * product_2 + W5_3 * product_4;
    const vector rotation_R5_1 = W5_5 * product_3 - W5_4 * product_4 + W5_3 * product;
    const vector total_8 = W0_0 * rotation_R0_0 + W1_0 * rotation_R1_0 + W2_0 * rotation_R2_0 + W3_0 *
        rotation_R3_0 + W4_0 * rotation_R4_0;
    const vector M0_3 = total_8 + W5_0 * rotation_R5_0;
    const vector total_9 = W0_0 * rotation_R0_1 + W1_0 * rotation_R1_1 + W2_0 * rotation_R2_1 + W3_0 *
        rotation_R3_1 + W4_0 * rotation_R4_1;
    const vector M0_4 = total_9 + W5_0 * rotation_R5_1;
    const vector total_10 = W0_0 * rotation_R0_2 + W1_0 * rotation_R1_2 + W2_0 * rotation_R2_2 + W3_0 *
        rotation_R3_2 + W4_0 * rotation_R4_2;
    const vector M0_5 = total_10 + W5_0 * rotation_R5_2;
    const vector total_11 = W0_0 * rotation_R0_3 + W1_0 * rotation_R1_3 + W2_0 * rotation_R2_3 + W3_0 *
        rotation_R3_3 + W4_0 * rotation_R4_3;
    const vector M0_6 = total_11 + W5_0 * rotation_R5_3;
    const vector total_12 = W0_1 * rotation_R0_0 + W1_1 * rotation_R1_0 + W2_1 * rotation_R2_0 + W3_1 *
        rotation_R3_0 + W4_1 * rotation_R4_0;
    const vector M1_3 = total_12 + W5_1 * rotation_R5_0;
    const vector total_13 = W0_1 * rotation_R0_1 + W1_1 * rotation_R1_1 + W2_1 * rotation_R2_1 + W3_1 *
        rotation_R3_1 + W4_1 * rotation_R4_1;
    const vector M1_4 = total_13 + W5_1 * rotation_R5_1;
    const vector total_14 = W0_1 * rotation_R0_2 + W1_1 * rotation_R1_2 + W2_1 * rotation_R2_2 + W3_1 *
        rotation_R3_2 + W4_1 * rotation_R4_2;
    const vector M1_5 = total_14 + W5_1 * rotation_R5_2;
    const vector total_15 = W0_1 * rotation_R0_3 + W1_1 * rotation_R1_3 + W2_1 * rotation_R2_3 + W3_1 *
        rotation_R3_3 + W4_1 * rotation_R4_3;
    const vector M1_6 = total_15 + W5_1 * rotation_R5_3;
    const vector total_16 = W0_2 * rotation_R0_0 + W1_2 * rotation_R1_0 + W2_2 * rotation_R2_0 + W3_2 *
        rotation_R3_0 + W4_2 * rotation_R4_0;
    const vector M2_3 = total_16 + W5_2 * rotation_R5_0;
    const vector total_17 = W0_2 * rotation_R0_1 + W1_2 * rotation_R1_1 + W2_2 * rotation_R2_1 + W3_2 *
        rotation_R3_1 + W4_2 * rotation_R4_1;
    const vector M2_4 = total_17 + W5_2 * rotation_R5_1;
    const vector total_18 = W0_2 * rotation_R0_2 + W1_2 * rotation_R1_2 + W2_2 * rotation_R2_2 + W3_2 *
        rotation_R3_2 + W4_2 * rotation_R4_2;
    const vector M2_5 = total_18 + W5_2 * rotation_R5_2;
    const vector total_19 = W0_2 * rotation_R0_3 + W1_2 * rotation_R1_3 + W2_2 * rotation_R2_3 + W3_2 *
        rotation_R3_3 + W4_2 * rotation_R4_3;
    const vector M2_6 = total_19 + W5_2 * rotation_R5_3;
    const vector total_20 = rotation_R0_0 * rotation_R0_0 + rotation_R1_0 * rotation_R1_0 + rotation_R2_0 *
        rotation_R2_0 + rotation_R3_0 * rotation_R3_0 + rotation_R4_0 * rotation_R4_0;
    const vector M3_3 = total_20 + rotation_R5_0 * rotation_R5_0;
    const vector total_21 = rotation_R0_0 * rotation_R0_1 + rotation_R1_0 * rotation_R1_1 + rotation_R2_0 *
        rotation_R2_1 + rotation_R3_0 * rotation_R3_1 + rotation_R4_0 * rotation_R4_1;
    const vector M3_4 = total_21 + rotation_R5_0 * rotation_R5_1;
    const vector total_22 = rotation_R0_0 * rotation_R0_2 + rotation_R1_0 * rotation_R1_2 + rotation_R2_0 *
        rotation_R2_2 + rotation_R3_0 * rotation_R3_2 + rotation_R4_0 * rotation_R4_2;
    const vector M3_5 = total_22 + rotation_R5_0 * rotation_R5_2;
    const vector total_23 = rotation_R0_3 * rotation_R0_0 + rotation_R1_3 * rotation_R1_0 + rotation_R2_3 *
        rotation_R2_0 + rotation_R3_3 * rotation_R3_0 + rotation_R4_3 * rotation_R4_0;
    const vector M3_6 = total_23 + rotation_R5_3 * rotation_R5_0;
    const vector total_24 = rotation_R0_1 * rotation_R0_1 + rotation_R1_1 * rotation_R1_1 + rotation_R2_1 *
        rotation_R2_1 + rotation_R3_1 * rotation_R3_1 + rotation_R4_1 * rotation_R4_1;
    const vector M4_4 = total_24 + rotation_R5_1 * rotation_R5_1;
    const vector total_25 = rotation_R0_2 * rotation_R0_1 + rotation_R1_2 * rotation_R1_1 + rotation_R2_2 *
        rotation_R2_1 + rotation_R3_2 * rotation_R3_1 + rotation_R4_2 * rotation_R4_1;
    const vector M4_5 = total_25 + rotation_R5_2 * rotation_R5_1;
    const vector total_26 = rotation_R0_3 * rotation_R0_1 + rotation_R1_3 * rotation_R1_1 + rotation_R2_3 *
        rotation_R2_1 + rotation_R3_3 * rotation_R3_1 + rotation_R4_3 * rotation_R4_1;
    const vector M4_6 = total_26 + rotation_R5_3 * rotation_R5_1;
    const vector total_27 = rotation_R0_2 * rotation_R0_2 + rotation_R1_2 * rotation_R1_2 + rotation_R2_2 *
        rotation_R2_2 + rotation_R3_2 * rotation_R3_2 + rotation_R4_2 * rotation_R4_2;
    const vector M5_5 = total_27 + rotation_R5_2 * rotation_R5_2;
    const vector total_28 = rotation_R0_3 * rotation_R0_2 + rotation_R1_3 * rotation_R1_2 + rotation_R2_3 *
        rotation_R2_2 + rotation_R3_3 * rotation_R3_2 + rotation_R4_3 * rotation_R4_2;
    const vector M5_6 = total_28 + rotation_R5_3 * rotation_R5_2;
    const vector total_29 = rotation_R0_3 * rotation_R0_3 + rotation_R1_3 * rotation_R1_3 + rotation_R2_3 *
        rotation_R2_3 + rotation_R3_3 * rotation_R3_3 + rotation_R4_3 * rotation_R4_3;
    const vector M6_6 = total_29 + rotation_R5_3 * rotation_R5_3;
    S[0] = mu0;
    S[1] = mu1;
    S[2] = mu2;
    S[3] = mu3;
    S[4] = mu4;
    S[5] = mu5;
    S[6] = mu6;
    S[7] = W0_0;
    S[8] = W0_1;
    S[9] = W0_2;
    S[10] = W1_0;
    S[11] = W1_1;
    S[12] = W1_2;
    S[13] = W2_0;
    S[14] = W2_1;
    S[15] = W2_2;
    S[16] = W3_0;
    S[17] = W3_1;
    S[18] = W3_2;
    S[19] = W4_0;
    S[20] = W4_1;
    S[21] = W4_2;
    S[22] = W5_0;
    S[23] = W5_1;
    S[24] = W5_2;
    S[25] = its_amplitude;
    S[26] = M0_0;
    S[27] = M0_1;
    S[28] = M0_2;
    S[29] = M1_1;
    S[30] = M1_2;
    S[31] = M2_2;
    S[32] = rotation_R0_3;
    S[33] = rotation_R0_0;
    S[34] = rotation_R0_2;
    S[35] = rotation_R0_1;
    S[36] = rotation_R1_3;
    S[37] = rotation_R1_0;
    S[38] = rotation_R1_2;
    S[39] = rotation_R1_1;
    S[40] = rotation_R2_3;
    S[41] = rotation_R2_0;
    S[42] = rotation_R2_2;
    S[43] = rotation_R2_1;
    S[44] = rotation_R3_3;
    S[45] = rotation_R3_0;
    S[46] = rotation_R3_2;
    S[47] = rotation_R3_1;
    S[48] = rotation_R4_3;
    S[49] = rotation_R4_0;
    S[50] = rotation_R4_2;
    S[51] = rotation_R4_1;
    S[52] = rotation_R5_3;
    S[53] = rotation_R5_0;
    S[54] = rotation_R5_2;
    S[55] = rotation_R5_1;
    S[56] = M0_3;
    S[57] = M0_4;
    S[58] = M0_5;
    S[59] = M0_6;
    S[60] = M1_3;
    S[61] = M1_4;
    S[62] = M1_5;
    S[63] = M1_6;
    S[64] = M2_3;
    S[65] = M2_4;
    S[66] = M2_5;
    S[67] = M2_6;
    S[68] = M3_3;
    S[69] = M3_4;
    S[70] = M3_5;
    S[71] = M3_6;
    S[72] = M4_4;
    S[73] = M4_5;
    S[74] = M4_6;
    S[75] = M5_5;
    S[76] = M5_6;
    S[77] = M6_6;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
 * w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
 * eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
 * Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
 * r = R h = W (tangent part of x), z = a r + what other factors add, phi = amplitude a^k exp(-|z|^2 / 2)
 */
INLINE void pair_value(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values) {
    struct { vector rotation_g0, rotation_a, gaussian; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 78 * near[k];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 7 * b;
            const vector x3 = X[3];
            const vector x4 = X[4];
            const vector x5 = X[5];
            const vector x6 = X[6];
            const vector rotation_g0 = x3 * mu3 + x4 * mu4 + x5 * mu5 + x6 * mu6;
            const vector rotation_abs_g0 = abs_each(rotation_g0);
            const vector rotation_eta = vector_polynomial_rotation_eta(1.0 - rotation_abs_g0);
            const vector rotation_a = 1.0 / (rotation_abs_g0 - rotation_eta * (1.0 - rotation_abs_g0 *
                rotation_abs_g0));
            kept[k][b].rotation_g0 = rotation_g0;
            kept[k][b].rotation_a = rotation_a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 78 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double W0_0 = S[7];
        const double W0_1 = S[8];
        const double W0_2 = S[9];
        const double W1_0 = S[10];
        const double W1_1 = S[11];
        const double W1_2 = S[12];
        const double W2_0 = S[13];
        const double W2_1 = S[14];
        const double W2_2 = S[15];
        const double W3_0 = S[16];
        const double W3_1 = S[17];
        const double W3_2 = S[18];
        const double W4_0 = S[19];
        const double W4_1 = S[20];
        const double W4_2 = S[21];
        const double W5_0 = S[22];
        const double W5_1 = S[23];
        const double W5_2 = S[24];
        const double rotation_R0_3 = S[32];
        const double rotation_R0_0 = S[33];
        const double rotation_R0_2 = S[34];
        const double rotation_R0_1 = S[35];
        const double rotation_R1_3 = S[36];
        const double rotation_R1_0 = S[37];
        const double rotation_R1_2 = S[38];
        const double rotation_R1_1 = S[39];
        const double rotation_R2_3 = S[40];
        const double rotation_R2_0 = S[41];
        const double rotation_R2_2 = S[42];
        const double rotation_R2_1 = S[43];
        const double rotation_R3_3 = S[44];
        const double rotation_R3_0 = S[45];
        const double rotation_R3_2 = S[46];
        const double rotation_R3_1 = S[47];
        const double rotation_R4_3 = S[48];
        const double rotation_R4_0 = S[49];
        const double rotation_R4_2 = S[50];
        const double rotation_R4_1 = S[51];
        const double rotation_R5_3 = S[52];
        const double rotation_R5_0 = S[53];
        const double rotation_R5_2 = S[54];
        const double rotation_R5_1 = S[55];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 7 * b;
            const vector rotation_g0 = kept[k][b].rotation_g0;
            const vector rotation_a = kept[k][b].rotation_a;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector x4 = X[4];
            const vector x5 = X[5];
            const vector x6 = X[6];
            const vector v0 = x0 - mu0;
            const vector v1 = x1 - mu1;
            const vector v2 = x2 - mu2;
            const vector rotation_a_chosen = vector_select(rotation_g0 < 0.0, -rotation_a, rotation_a);
            const vector product = x3 * rotation_a_chosen;
            const vector product_2 = x4 * rotation_a_chosen;
            const vector total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + rotation_R0_0 * product + rotation_R0_1 *
                product_2;
            const vector product_3 = x5 * rotation_a_chosen;
            const vector product_4 = x6 * rotation_a_chosen;
            const vector total_3 = total_2 + rotation_R0_2 * product_3 + rotation_R0_3 * product_4;
            const vector total_4 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + rotation_R1_0 * product + rotation_R1_1 *
                product_2;
            const vector total_5 = total_4 + rotation_R1_2 * product_3 + rotation_R1_3 * product_4;
            const vector total_6 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + rotation_R2_0 * product + rotation_R2_1 *
                product_2;
            const vector total_7 = total_6 + rotation_R2_2 * product_3 + rotation_R2_3 * product_4;
            const vector total_8 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + rotation_R3_0 * product + rotation_R3_1 *
                product_2;
            const vector total_9 = total_8 + rotation_R3_2 * product_3 + rotation_R3_3 * product_4;
            const vector total_10 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + rotation_R4_0 * product + rotation_R4_1 *
                product_2;
            const vector total_11 = total_10 + rotation_R4_2 * product_3 + rotation_R4_3 * product_4;
            const vector total_12 = total_3 * total_3 + total_5 * total_5 + total_7 * total_7 + total_9 * total_9 +
                total_11 * total_11;
            const vector total_13 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + rotation_R5_0 * product + rotation_R5_1 *
                product_2;
            const vector total_14 = total_13 + rotation_R5_2 * product_3 + rotation_R5_3 * product_4;
            const vector gaussian = gaussian_each(total_12 + total_14 * total_14);
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 78 * near[k];
        const double amplitude = S[25];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            const vector rotation_a = kept[k][b].rotation_a;
            const vector gaussian = kept[k][b].gaussian;
            const vector phi = rotation_a * (rotation_a * gaussian);
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
 * r = R h = W (tangent part of x), z = a r + what other factors add, phi = amplitude a^k exp(-|z|^2 / 2)
 */
INLINE void pair_forward(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values, vector *slopes) {
    struct { vector rotation_g0, rotation_eta, rotation_a, rotation_a_chosen, total_3, total_5, total_7,
            total_9, total_11, total_14, gaussian; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 78 * near[k];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 7 * b;
            const vector x3 = X[3];
            const vector x4 = X[4];
            const vector x5 = X[5];
            const vector x6 = X[6];
            const vector rotation_g0 = x3 * mu3 + x4 * mu4 + x5 * mu5 + x6 * mu6;
            const vector rotation_abs_g0 = abs_each(rotation_g0);
            const vector rotation_eta = vector_polynomial_rotation_eta(1.0 - rotation_abs_g0);
            const vector rotation_a = 1.0 / (rotation_abs_g0 - rotation_eta * (1.0 - rotation_abs_g0 *
                rotation_abs_g0));
            kept[k][b].rotation_g0 = rotation_g0;
            kept[k][b].rotation_eta = rotation_eta;
            kept[k][b].rotation_a = rotation_a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 78 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double W0_0 = S[7];
        const double W0_1 = S[8];
        const double W0_2 = S[9];
        const double W1_0 = S[10];
        const double W1_1 = S[11];
        const double W1_2 = S[12];
        const double W2_0 = S[13];
        const double W2_1 = S[14];
        const double W2_2 = S[15];
        const double W3_0 = S[16];
        const double W3_1 = S[17];
        const double W3_2 = S[18];
        const double W4_0 = S[19];
        const double W4_1 = S[20];
        const double W4_2 = S[21];
        const double W5_0 = S[22];
        const double W5_1 = S[23];
        const double W5_2 = S[24];
        const double rotation_R0_3 = S[32];
        const double rotation_R0_0 = S[33];
        const double rotation_R0_2 = S[34];
        const double rotation_R0_1 = S[35];
        const double rotation_R1_3 = S[36];
        const double rotation_R1_0 = S[37];
        const double rotation_R1_2 = S[38];
        const double rotation_R1_1 = S[39];
        const double rotation_R2_3 = S[40];
        const double rotation_R2_0 = S[41];
        const double rotation_R2_2 = S[42];
        const double rotation_R2_1 = S[43];
        const double rotation_R3_3 = S[44];
        const double rotation_R3_0 = S[45];
        const double rotation_R3_2 = S[46];
        const double rotation_R3_1 = S[47];
        const double rotation_R4_3 = S[48];
        const double rotation_R4_0 = S[49];
        const double rotation_R4_2 = S[50];
        const double rotation_R4_1 = S[51];
        const double rotation_R5_3 = S[52];
        const double rotation_R5_0 = S[53];
        const double rotation_R5_2 = S[54];
        const double rotation_R5_1 = S[55];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 7 * b;
            const vector rotation_g0 = kept[k][b].rotation_g0;
            const vector rotation_a = kept[k][b].rotation_a;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector x4 = X[4];
            const vector x5 = X[5];
            const vector x6 = X[6];
            const vector v0 = x0 - mu0;
            const vector v1 = x1 - mu1;
            const vector v2 = x2 - mu2;
            const vector_mask is_small = rotation_g0 < 0.0;
            const vector rotation_a_chosen = vector_select(is_small, -rotation_a, rotation_a);
            const vector product = x3 * rotation_a_chosen;
            const vector product_2 = x4 * rotation_a_chosen;
            const vector total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + rotation_R0_0 * product + rotation_R0_1 *
                product_2;
            const vector product_3 = x5 * rotation_a_chosen;
            const vector product_4 = x6 * rotation_a_chosen;
            const vector total_3 = total_2 + rotation_R0_2 * product_3 + rotation_R0_3 * product_4;
            const vector total_4 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + rotation_R1_0 * product + rotation_R1_1 *
                product_2;
            const vector total_5 = total_4 + rotation_R1_2 * product_3 + rotation_R1_3 * product_4;
            const vector total_6 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + rotation_R2_0 * product + rotation_R2_1 *
                product_2;
            const vector total_7 = total_6 + rotation_R2_2 * product_3 + rotation_R2_3 * product_4;
            const vector total_8 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + rotation_R3_0 * product + rotation_R3_1 *
                product_2;
            const vector total_9 = total_8 + rotation_R3_2 * product_3 + rotation_R3_3 * product_4;
            const vector total_10 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + rotation_R4_0 * product + rotation_R4_1 *
                product_2;
            const vector total_11 = total_10 + rotation_R4_2 * product_3 + rotation_R4_3 * product_4;
            const vector total_12 = total_3 * total_3 + total_5 * total_5 + total_7 * total_7 + total_9 * total_9 +
                total_11 * total_11;
            const vector total_13 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + rotation_R5_0 * product + rotation_R5_1 *
                product_2;
            const vector total_14 = total_13 + rotation_R5_2 * product_3 + rotation_R5_3 * product_4;
            const vector gaussian = gaussian_each(total_12 + total_14 * total_14);
            kept[k][b].rotation_a_chosen = rotation_a_chosen;
            kept[k][b].total_3 = total_3;
            kept[k][b].total_5 = total_5;
            kept[k][b].total_7 = total_7;
            kept[k][b].total_9 = total_9;
            kept[k][b].total_11 = total_11;
            kept[k][b].total_14 = total_14;
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 78 * near[k];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double W0_0 = S[7];
        const double W0_1 = S[8];
        const double W0_2 = S[9];
        const double W1_0 = S[10];
        const double W1_1 = S[11];
        const double W1_2 = S[12];
        const double W2_0 = S[13];
        const double W2_1 = S[14];
        const double W2_2 = S[15];
        const double W3_0 = S[16];
        const double W3_1 = S[17];
        const double W3_2 = S[18];
        const double W4_0 = S[19];
        const double W4_1 = S[20];
        const double W4_2 = S[21];
        const double W5_0 = S[22];
        const double W5_1 = S[23];
        const double W5_2 = S[24];
        const double amplitude = S[25];
        const double rotation_R0_3 = S[32];
        const double rotation_R0_0 = S[33];
        const double rotation_R0_2 = S[34];
        const double rotation_R0_1 = S[35];
        const double rotation_R1_3 = S[36];
        const double rotation_R1_0 = S[37];
        const double rotation_R1_2 = S[38];
        const double rotation_R1_1 = S[39];
        const double rotation_R2_3 = S[40];
        const double rotation_R2_0 = S[41];
        const double rotation_R2_2 = S[42];
        const double rotation_R2_1 = S[43];
        const double rotation_R3_3 = S[44];
        const double rotation_R3_0 = S[45];
        const double rotation_R3_2 = S[46];
        const double rotation_R3_1 = S[47];
        const double rotation_R4_3 = S[48];
        const double rotation_R4_0 = S[49];
        const double rotation_R4_2 = S[50];
        const double rotation_R4_1 = S[51];
        const double rotation_R5_3 = S[52];
        const double rotation_R5_0 = S[53];
        const double rotation_R5_2 = S[54];
        const double rotation_R5_1 = S[55];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 7 * b;
            vector *value = values + b;
            vector *slope = slopes + 7 * b;
            const vector rotation_g0 = kept[k][b].rotation_g0;
            const vector rotation_eta = kept[k][b].rotation_eta;
            const vector rotation_a = kept[k][b].rotation_a;
            const vector rotation_a_chosen = kept[k][b].rotation_a_chosen;
            const vector total_3 = kept[k][b].total_3;
            const vector total_5 = kept[k][b].total_5;
            const vector total_7 = kept[k][b].total_7;
            const vector total_9 = kept[k][b].total_9;
            const vector total_11 = kept[k][b].total_11;
            const vector total_14 = kept[k][b].total_14;
            const vector gaussian = kept[k][b].gaussian;
            const vector x3 = X[3];
            const vector x4 = X[4];
            const vector x5 = X[5];
            const vector x6 = X[6];
            const vector_mask is_small = rotation_g0 < 0.0;
            const vector phi = rotation_a * (rotation_a * gaussian);
            const vector phi_2 = amplitude * phi;
            const vector total_15 = W0_0 * total_3 + W1_0 * total_5 + W2_0 * total_7 + W3_0 * total_9 + W4_0 *
                total_11;
            const vector total_16 = W0_1 * total_3 + W1_1 * total_5 + W2_1 * total_7 + W3_1 * total_9 + W4_1 *
                total_11;
            const vector total_17 = W0_2 * total_3 + W1_2 * total_5 + W2_2 * total_7 + W3_2 * total_9 + W4_2 *
                total_11;
            const vector total_18 = rotation_R0_3 * total_3 + rotation_R1_3 * total_5 + rotation_R2_3 * total_7 +
                rotation_R3_3 * total_9 + rotation_R4_3 * total_11;
            const vector phi_product = phi_2 * (total_18 + rotation_R5_3 * total_14);
            const vector total_19 = rotation_R0_2 * total_3 + rotation_R1_2 * total_5 + rotation_R2_2 * total_7 +
                rotation_R3_2 * total_9 + rotation_R4_2 * total_11;
            const vector phi_product_2 = phi_2 * (total_19 + rotation_R5_2 * total_14);
            const vector total_20 = rotation_R0_1 * total_3 + rotation_R1_1 * total_5 + rotation_R2_1 * total_7 +
                rotation_R3_1 * total_9 + rotation_R4_1 * total_11;
            const vector phi_product_3 = phi_2 * (total_20 + rotation_R5_1 * total_14);
            const vector total_21 = rotation_R0_0 * total_3 + rotation_R1_0 * total_5 + rotation_R2_0 * total_7 +
                rotation_R3_0 * total_9 + rotation_R4_0 * total_11;
            const vector phi_product_4 = phi_2 * (total_21 + rotation_R5_0 * total_14);
            const vector gap = -(x6 * phi_product) - x5 * phi_product_2 - x4 * phi_product_3 - x3 * phi_product_4;
            const vector by_rotation_abs_g0 = rotation_eta * (2.0 * phi_2 + rotation_a_chosen * gap);
            const vector by_rotation_g0 = vector_select(is_small, -by_rotation_abs_g0, by_rotation_abs_g0);
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] - phi_2 * (total_15 + W5_0 * total_14);
            slope[1] = slope[1] - phi_2 * (total_16 + W5_1 * total_14);
            slope[2] = slope[2] - phi_2 * (total_17 + W5_2 * total_14);
            slope[3] = slope[3] + mu3 * by_rotation_g0 - rotation_a_chosen * phi_product_4;
            slope[4] = slope[4] + mu4 * by_rotation_g0 - rotation_a_chosen * phi_product_3;
            slope[5] = slope[5] + mu5 * by_rotation_g0 - rotation_a_chosen * phi_product_2;
            slope[6] = slope[6] + mu6 * by_rotation_g0 - rotation_a_chosen * phi_product;
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient(
    const vector *x, const vector *slope, vector *gradient) {
    const vector x3 = x[3];
    const vector x4 = x[4];
    const vector x5 = x[5];
    const vector x6 = x[6];
    const vector slope_x0 = slope[0];
    const vector slope_x1 = slope[1];
    const vector slope_x2 = slope[2];
    const vector slope_x3 = slope[3];
    const vector slope_x4 = slope[4];
    const vector slope_x5 = slope[5];
    const vector slope_x6 = slope[6];
    const vector product = 0.5 * slope_x4;
    const vector product_2 = 0.5 * slope_x5;
    const vector product_3 = 0.5 * slope_x3;
    const vector product_4 = 0.5 * slope_x6;
    gradient[0] = slope_x0;
    gradient[1] = slope_x1;
    gradient[2] = slope_x2;
    gradient[3] = x3 * product + x6 * product_2 - x4 * product_3 - x5 * product_4;
    gradient[4] = x3 * product_2 + x4 * product_4 - x5 * product_3 - x6 * product;
    gradient[5] = x5 * product + x3 * product_4 - x6 * product_3 - x4 * product_2;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp(
    const vector *x, const vector *gradient_bar, vector *slope_bar) {
    const vector x3 = x[3];
    const vector x4 = x[4];
    const vector x5 = x[5];
    const vector x6 = x[6];
    const vector gradient_bar0 = gradient_bar[0];
    const vector gradient_bar1 = gradient_bar[1];
    const vector gradient_bar2 = gradient_bar[2];
    const vector gradient_bar3 = gradient_bar[3];
    const vector gradient_bar4 = gradient_bar[4];
    const vector gradient_bar5 = gradient_bar[5];
    const vector product = 0.5 * (-(x6 * gradient_bar5) - x5 * gradient_bar4 - x4 * gradient_bar3);
    slope_bar[0] = gradient_bar0;
    slope_bar[1] = gradient_bar1;
    slope_bar[2] = gradient_bar2;
    slope_bar[3] = product;
    slope_bar[4] = 0.5 * (x5 * gradient_bar5 - x6 * gradient_bar4 + x3 * gradient_bar3);
    slope_bar[5] = 0.5 * (x3 * gradient_bar4 - x4 * gradient_bar5 + x6 * gradient_bar3);
    slope_bar[6] = 0.5 * (x3 * gradient_bar5 + x4 * gradient_bar4 - x5 * gradient_bar3);
}

/*
 * The factors of whose products are what is summed over the points, for some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
 * w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
 * eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
 * Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
 * r = R h = W (tangent part of x), z = a r + what other factors add, phi = amplitude a^k exp(-|z|^2 / 2)
 */
INLINE void pair_factors(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *factors) {
    struct { vector v0, v1, v2, rotation_g0, gap, rotation_eta, rotation_a, rotation_a_chosen, product,
            product_2, product_3, product_4, total_3, total_5, total_7, total_9, total_11, total_14, gaussian; }
            kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 15 * (size_t)near[i];
        const vector x3 = X[3];
        const vector x4 = X[4];
        const vector x5 = X[5];
        const vector x6 = X[6];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const vector rotation_g0 = x3 * mu3 + x4 * mu4 + x5 * mu5 + x6 * mu6;
        const vector rotation_abs_g0 = abs_each(rotation_g0);
        const vector gap = 1.0 - rotation_abs_g0;
        const vector rotation_eta = vector_polynomial_rotation_eta(gap);
        const vector rotation_a = 1.0 / (rotation_abs_g0 - rotation_eta * (1.0 - rotation_abs_g0 *
            rotation_abs_g0));
        kept[i].rotation_g0 = rotation_g0;
        kept[i].gap = gap;
        kept[i].rotation_eta = rotation_eta;
        kept[i].rotation_a = rotation_a;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 15 * (size_t)near[i];
        const vector rotation_g0 = kept[i].rotation_g0;
        const vector rotation_a = kept[i].rotation_a;
        const vector x0 = X[0];
        const vector x1 = X[1];
        const vector x2 = X[2];
        const vector x3 = X[3];
        const vector x4 = X[4];
        const vector x5 = X[5];
        const vector x6 = X[6];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double W0_0 = S[7];
        const double W0_1 = S[8];
        const double W0_2 = S[9];
        const double W1_0 = S[10];
        const double W1_1 = S[11];
        const double W1_2 = S[12];
        const double W2_0 = S[13];
        const double W2_1 = S[14];
        const double W2_2 = S[15];
        const double W3_0 = S[16];
        const double W3_1 = S[17];
        const double W3_2 = S[18];
        const double W4_0 = S[19];
        const double W4_1 = S[20];
        const double W4_2 = S[21];
        const double W5_0 = S[22];
        const double W5_1 = S[23];
        const double W5_2 = S[24];
        const double rotation_R0_3 = S[32];
        const double rotation_R0_0 = S[33];
        const double rotation_R0_2 = S[34];
        const double rotation_R0_1 = S[35];
        const double rotation_R1_3 = S[36];
        const double rotation_R1_0 = S[37];
        const double rotation_R1_2 = S[38];
        const double rotation_R1_1 = S[39];
        const double rotation_R2_3 = S[40];
        const double rotation_R2_0 = S[41];
        const double rotation_R2_2 = S[42];
        const double rotation_R2_1 = S[43];
        const double rotation_R3_3 = S[44];
        const double rotation_R3_0 = S[45];
        const double rotation_R3_2 = S[46];
        const double rotation_R3_1 = S[47];
        const double rotation_R4_3 = S[48];
        const double rotation_R4_0 = S[49];
        const double rotation_R4_2 = S[50];
        const double rotation_R4_1 = S[51];
        const double rotation_R5_3 = S[52];
        const double rotation_R5_0 = S[53];
        const double rotation_R5_2 = S[54];
        const double rotation_R5_1 = S[55];
        const vector v0 = x0 - mu0;
        const vector v1 = x1 - mu1;
        const vector v2 = x2 - mu2;
        const vector_mask is_small = rotation_g0 < 0.0;
        const vector rotation_a_chosen = vector_select(is_small, -rotation_a, rotation_a);
        const vector product = x3 * rotation_a_chosen;
        const vector product_2 = x4 * rotation_a_chosen;
        const vector total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + rotation_R0_0 * product + rotation_R0_1 *
            product_2;
        const vector product_3 = x5 * rotation_a_chosen;
        const vector product_4 = x6 * rotation_a_chosen;
        const vector total_3 = total_2 + rotation_R0_2 * product_3 + rotation_R0_3 * product_4;
        const vector total_4 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + rotation_R1_0 * product + rotation_R1_1 *
            product_2;
        const vector total_5 = total_4 + rotation_R1_2 * product_3 + rotation_R1_3 * product_4;
        const vector total_6 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + rotation_R2_0 * product + rotation_R2_1 *
            product_2;
        const vector total_7 = total_6 + rotation_R2_2 * product_3 + rotation_R2_3 * product_4;
        const vector total_8 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + rotation_R3_0 * product + rotation_R3_1 *
            product_2;
        const vector total_9 = total_8 + rotation_R3_2 * product_3 + rotation_R3_3 * product_4;
        const vector total_10 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + rotation_R4_0 * product + rotation_R4_1 *
            product_2;
        const vector total_11 = total_10 + rotation_R4_2 * product_3 + rotation_R4_3 * product_4;
        const vector total_13 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + rotation_R5_0 * product + rotation_R5_1 *
            product_2;
        const vector total_14 = total_13 + rotation_R5_2 * product_3 + rotation_R5_3 * product_4;
        const vector total_16 = total_3 * total_3 + total_5 * total_5 + total_7 * total_7 + total_9 * total_9 +
            total_11 * total_11;
        const vector gaussian = gaussian_each(total_16 + total_14 * total_14);
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].v2 = v2;
        kept[i].rotation_a_chosen = rotation_a_chosen;
        kept[i].product = product;
        kept[i].product_2 = product_2;
        kept[i].product_3 = product_3;
        kept[i].product_4 = product_4;
        kept[i].total_3 = total_3;
        kept[i].total_5 = total_5;
        kept[i].total_7 = total_7;
        kept[i].total_9 = total_9;
        kept[i].total_11 = total_11;
        kept[i].total_14 = total_14;
        kept[i].gaussian = gaussian;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 15 * (size_t)near[i];
        const vector *value_bar = points + 15 * (size_t)near[i] + 7;
        const vector *slope_bar = points + 15 * (size_t)near[i] + 7 + 1;
        vector *factor = factors + 20 * i;
        const vector v0 = kept[i].v0;
        const vector v1 = kept[i].v1;
        const vector v2 = kept[i].v2;
        const vector rotation_g0 = kept[i].rotation_g0;
        const vector gap = kept[i].gap;
        const vector rotation_eta = kept[i].rotation_eta;
        const vector rotation_a = kept[i].rotation_a;
        const vector rotation_a_chosen = kept[i].rotation_a_chosen;
        const vector product = kept[i].product;
        const vector product_2 = kept[i].product_2;
        const vector product_3 = kept[i].product_3;
        const vector product_4 = kept[i].product_4;
        const vector total_3 = kept[i].total_3;
        const vector total_5 = kept[i].total_5;
        const vector total_7 = kept[i].total_7;
        const vector total_9 = kept[i].total_9;
        const vector total_11 = kept[i].total_11;
        const vector total_14 = kept[i].total_14;
        const vector gaussian = kept[i].gaussian;
        const vector x3 = X[3];
        const vector x4 = X[4];
        const vector x5 = X[5];
        const vector x6 = X[6];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double W0_0 = S[7];
        const double W0_1 = S[8];
        const double W0_2 = S[9];
        const double W1_0 = S[10];
        const double W1_1 = S[11];
        const double W1_2 = S[12];
        const double W2_0 = S[13];
        const double W2_1 = S[14];
        const double W2_2 = S[15];
        const double W3_0 = S[16];
        const double W3_1 = S[17];
        const double W3_2 = S[18];
        const double W4_0 = S[19];
        const double W4_1 = S[20];
        const double W4_2 = S[21];
        const double W5_0 = S[22];
        const double W5_1 = S[23];
        const double W5_2 = S[24];
        const double M0_0 = S[26];
        const double M0_1 = S[27];
        const double M0_2 = S[28];
        const double M1_1 = S[29];
        const double M1_2 = S[30];
        const double M2_2 = S[31];
        const double rotation_R0_3 = S[32];
        const double rotation_R0_0 = S[33];
        const double rotation_R0_2 = S[34];
        const double rotation_R0_1 = S[35];
        const double rotation_R1_3 = S[36];
        const double rotation_R1_0 = S[37];
        const double rotation_R1_2 = S[38];
        const double rotation_R1_1 = S[39];
        const double rotation_R2_3 = S[40];
        const double rotation_R2_0 = S[41];
        const double rotation_R2_2 = S[42];
        const double rotation_R2_1 = S[43];
        const double rotation_R3_3 = S[44];
        const double rotation_R3_0 = S[45];
        const double rotation_R3_2 = S[46];
        const double rotation_R3_1 = S[47];
        const double rotation_R4_3 = S[48];
        const double rotation_R4_0 = S[49];
        const double rotation_R4_2 = S[50];
        const double rotation_R4_1 = S[51];
        const double rotation_R5_3 = S[52];
        const double rotation_R5_0 = S[53];
        const double rotation_R5_2 = S[54];
        const double rotation_R5_1 = S[55];
        const double M0_3 = S[56];
        const double M0_4 = S[57];
        const double M0_5 = S[58];
        const double M0_6 = S[59];
        const double M1_3 = S[60];
        const double M1_4 = S[61];
        const double M1_5 = S[62];
        const double M1_6 = S[63];
        const double M2_3 = S[64];
        const double M2_4 = S[65];
        const double M2_5 = S[66];
        const double M2_6 = S[67];
        const double M3_3 = S[68];
        const double M3_4 = S[69];
        const double M3_5 = S[70];
        const double M3_6 = S[71];
        const double M4_4 = S[72];
        const double M4_5 = S[73];
        const double M4_6 = S[74];
        const double M5_5 = S[75];
        const double M5_6 = S[76];
        const double M6_6 = S[77];
        const vector its_value_bar = value_bar[0];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector x2_bar = slope_bar[2];
        const vector x3_bar = slope_bar[3];
        const vector x4_bar = slope_bar[4];
        const vector x5_bar = slope_bar[5];
        const vector x6_bar = slope_bar[6];
        const vector_mask is_small = rotation_g0 < 0.0;
        const vector total_12 = W0_0 * total_3 + W1_0 * total_5 + W2_0 * total_7 + W3_0 * total_9 + W4_0 *
            total_11;
        const vector total_15 = total_12 + W5_0 * total_14;
        const vector phi = rotation_a * (rotation_a * gaussian);
        const vector total_17 = rotation_R0_3 * total_3 + rotation_R1_3 * total_5 + rotation_R2_3 * total_7 +
            rotation_R3_3 * total_9 + rotation_R4_3 * total_11;
        const vector total_18 = total_17 + rotation_R5_3 * total_14;
        const vector by_by_rotation_g0 = mu3 * x3_bar + mu4 * x4_bar + mu5 * x5_bar + mu6 * x6_bar;
        const vector by_by_rotation_abs_g0 = vector_select(is_small, vector_of(0.0), by_by_rotation_g0) -
            vector_select(is_small, by_by_rotation_g0, vector_of(0.0));
        const vector product_5 = rotation_eta * by_by_rotation_abs_g0;
        const vector product_6 = rotation_a_chosen * product_5;
        const vector gap_2 = -(x6 * product_6) - rotation_a_chosen * x6_bar;
        const vector total_19 = rotation_R0_2 * total_3 + rotation_R1_2 * total_5 + rotation_R2_2 * total_7 +
            rotation_R3_2 * total_9 + rotation_R4_2 * total_11;
        const vector total_20 = total_19 + rotation_R5_2 * total_14;
        const vector gap_3 = -(x5 * product_6) - rotation_a_chosen * x5_bar;
        const vector total_21 = rotation_R0_1 * total_3 + rotation_R1_1 * total_5 + rotation_R2_1 * total_7 +
            rotation_R3_1 * total_9 + rotation_R4_1 * total_11;
        const vector total_22 = total_21 + rotation_R5_1 * total_14;
        const vector gap_4 = -(x4 * product_6) - rotation_a_chosen * x4_bar;
        const vector total_23 = rotation_R0_0 * total_3 + rotation_R1_0 * total_5 + rotation_R2_0 * total_7 +
            rotation_R3_0 * total_9 + rotation_R4_0 * total_11;
        const vector total_24 = total_23 + rotation_R5_0 * total_14;
        const vector gap_5 = -(x3 * product_6) - rotation_a_chosen * x3_bar;
        const vector total_25 = its_value_bar + total_18 * gap_2 + total_20 * gap_3 + total_22 * gap_4 + total_24
            * gap_5;
        const vector total_26 = W0_2 * total_3 + W1_2 * total_5 + W2_2 * total_7 + W3_2 * total_9 + W4_2 *
            total_11;
        const vector total_27 = total_26 + W5_2 * total_14;
        const vector total_28 = W0_1 * total_3 + W1_1 * total_5 + W2_1 * total_7 + W3_1 * total_9 + W4_1 *
            total_11;
        const vector total_29 = total_28 + W5_1 * total_14;
        const vector by_phi = total_25 - total_27 * x2_bar - total_29 * x1_bar - total_15 * x0_bar + 2.0 *
            product_5;
        const vector phi_product = phi * by_phi;
        const vector phi_product_2 = phi * x0_bar;
        const vector phi_product_3 = phi * x1_bar;
        const vector phi_product_4 = phi * x2_bar;
        const vector phi_product_5 = phi * gap_5;
        const vector total_30 = -(M0_0 * phi_product_2) - M0_1 * phi_product_3 - M0_2 * phi_product_4 + M0_3 *
            phi_product_5;
        const vector phi_product_6 = phi * gap_4;
        const vector phi_product_7 = phi * gap_3;
        const vector phi_product_8 = phi * gap_2;
        const vector gap_6 = total_15 * phi_product - (total_30 + M0_4 * phi_product_6 + M0_5 * phi_product_7 +
            M0_6 * phi_product_8);
        const vector total_31 = -(M0_1 * phi_product_2) - M1_1 * phi_product_3 - M1_2 * phi_product_4 + M1_3 *
            phi_product_5;
        const vector gap_7 = total_29 * phi_product - (total_31 + M1_4 * phi_product_6 + M1_5 * phi_product_7 +
            M1_6 * phi_product_8);
        const vector total_32 = -(M0_2 * phi_product_2) - M1_2 * phi_product_3 - M2_2 * phi_product_4 + M2_3 *
            phi_product_5;
        const vector gap_8 = total_27 * phi_product - (total_32 + M2_4 * phi_product_6 + M2_5 * phi_product_7 +
            M2_6 * phi_product_8);
        const vector phi_product_9 = phi * total_18;
        const vector phi_product_10 = phi * total_20;
        const vector phi_product_11 = phi * total_22;
        const vector phi_product_12 = phi * total_24;
        const vector gap_9 = -(x6 * phi_product_9) - x5 * phi_product_10 - x4 * phi_product_11 - x3 *
            phi_product_12;
        const vector total_33 = 2.0 * phi + rotation_a_chosen * gap_9;
        const vector by_rotation_abs_g0 = rotation_eta * total_33;
        const vector by_rotation_g0 = vector_select(is_small, -by_rotation_abs_g0, by_rotation_abs_g0);
        const vector rotation_eta_slope = vector_polynomial_rotation_eta_slope(gap);
        const vector gap_10 = gap_9 * product_5 - phi_product_12 * x3_bar - phi_product_11 * x4_bar -
            phi_product_10 * x5_bar - phi_product_9 * x6_bar;
        const vector total_34 = -(M0_6 * phi_product_2) - M1_6 * phi_product_3 - M2_6 * phi_product_4 + M3_6 *
            phi_product_5;
        const vector gap_11 = total_34 + M4_6 * phi_product_6 + M5_6 * phi_product_7 + M6_6 * phi_product_8 -
            total_18 * phi_product;
        const vector total_35 = -(M0_5 * phi_product_2) - M1_5 * phi_product_3 - M2_5 * phi_product_4 + M3_5 *
            phi_product_5;
        const vector gap_12 = total_35 + M4_5 * phi_product_6 + M5_5 * phi_product_7 + M5_6 * phi_product_8 -
            total_20 * phi_product;
        const vector total_36 = -(M0_4 * phi_product_2) - M1_4 * phi_product_3 - M2_4 * phi_product_4 + M3_4 *
            phi_product_5;
        const vector gap_13 = total_36 + M4_4 * phi_product_6 + M4_5 * phi_product_7 + M4_6 * phi_product_8 -
            total_22 * phi_product;
        const vector total_37 = -(M0_3 * phi_product_2) - M1_3 * phi_product_3 - M2_3 * phi_product_4 + M3_3 *
            phi_product_5;
        const vector gap_14 = total_37 + M3_4 * phi_product_6 + M3_5 * phi_product_7 + M3_6 * phi_product_8 -
            total_24 * phi_product;
        const vector total_38 = gap_10 + x6 * gap_11 + x5 * gap_12 + x4 * gap_13 + x3 * gap_14;
        const vector by_rotation_abs_g0_2 = rotation_eta_slope * (total_33 * by_by_rotation_abs_g0) + rotation_eta
            * (2.0 * phi_product + rotation_a_chosen * total_38);
        const vector by_rotation_g0_2 = vector_select(is_small, -by_rotation_abs_g0_2, by_rotation_abs_g0_2);
        const vector product_7 = 0.5 * phi_product;
        const vector gap_15 = -phi_product_2 - v0 * product_7;
        const vector gap_16 = -phi_product_3 - v1 * product_7;
        const vector gap_17 = -phi_product_4 - v2 * product_7;
        const vector gap_18 = phi_product_5 - product * product_7;
        const vector gap_19 = phi_product_6 - product_2 * product_7;
        const vector gap_20 = phi_product_7 - product_3 * product_7;
        const vector gap_21 = phi_product_8 - product_4 * product_7;
        factor[0] = v0;
        factor[1] = v1;
        factor[2] = v2;
        factor[3] = product;
        factor[4] = product_2;
        factor[5] = product_3;
        factor[6] = product_4;
        factor[7] = phi_product;
        factor[8] = gap_6;
        factor[9] = gap_7;
        factor[10] = gap_8;
        factor[11] = by_rotation_g0;
        factor[12] = by_rotation_g0_2;
        factor[13] = gap_15;
        factor[14] = gap_16;
        factor[15] = gap_17;
        factor[16] = gap_18;
        factor[17] = gap_19;
        factor[18] = gap_20;
        factor[19] = gap_21;
    }
}

/* Adds some of the sums, as products. */
INLINE void pair_products_0(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[8];
    sum[1] = sum[1] + factor[9];
    sum[2] = sum[2] + factor[10];
    sum[3] = sum[3] + factor[7];
    sum[4] = sum[4] + factor[0] * factor[13];
    sum[5] = sum[5] + factor[0] * factor[14] + factor[1] * factor[13];
    sum[6] = sum[6] + factor[1] * factor[14];
    sum[7] = sum[7] + factor[0] * factor[15] + factor[2] * factor[13];
    sum[8] = sum[8] + factor[1] * factor[15] + factor[2] * factor[14];
    sum[9] = sum[9] + factor[2] * factor[15];
    sum[10] = sum[10] + factor[0] * factor[16] + factor[3] * factor[13];
    sum[11] = sum[11] + factor[1] * factor[16] + factor[3] * factor[14];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_1(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[11] * point[11] + point[3] * factor[12];
    sum[1] = sum[1] + factor[11] * point[12] + point[4] * factor[12];
    sum[2] = sum[2] + factor[11] * point[13] + point[5] * factor[12];
    sum[3] = sum[3] + factor[11] * point[14] + point[6] * factor[12];
    sum[4] = sum[4] + factor[3] * factor[16];
    sum[5] = sum[5] + factor[2] * factor[16] + factor[3] * factor[15];
    sum[6] = sum[6] + factor[2] * factor[17] + factor[4] * factor[15];
    sum[7] = sum[7] + factor[3] * factor[17] + factor[4] * factor[16];
    sum[8] = sum[8] + factor[4] * factor[17];
    sum[9] = sum[9] + factor[0] * factor[17] + factor[4] * factor[13];
    sum[10] = sum[10] + factor[0] * factor[18] + factor[5] * factor[13];
    sum[11] = sum[11] + factor[2] * factor[18] + factor[5] * factor[15];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_2(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[19] + factor[6] * factor[13];
    sum[1] = sum[1] + factor[6] * factor[19];
    sum[2] = sum[2] + factor[1] * factor[19] + factor[6] * factor[14];
    sum[3] = sum[3] + factor[1] * factor[17] + factor[4] * factor[14];
    sum[4] = sum[4] + factor[4] * factor[19] + factor[6] * factor[17];
    sum[5] = sum[5] + factor[1] * factor[18] + factor[5] * factor[14];
    sum[6] = sum[6] + factor[4] * factor[18] + factor[5] * factor[17];
    sum[7] = sum[7] + factor[5] * factor[18];
    sum[8] = sum[8] + factor[5] * factor[19] + factor[6] * factor[18];
    sum[9] = sum[9] + factor[2] * factor[19] + factor[6] * factor[15];
    sum[10] = sum[10] + factor[3] * factor[18] + factor[5] * factor[16];
    sum[11] = sum[11] + factor[3] * factor[19] + factor[6] * factor[16];
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp(
    const vector *mu, const vector *W, const vector *amplitude, const vector *sums, vector *mu_bar, vector *W_bar, vector *amplitude_bar) {
    const vector mu3 = mu[3];
    const vector mu4 = mu[4];
    const vector mu5 = mu[5];
    const vector mu6 = mu[6];
    const vector W0_0 = W[0];
    const vector W0_1 = W[1];
    const vector W0_2 = W[2];
    const vector W0_3 = W[3];
    const vector W0_4 = W[4];
    const vector W0_5 = W[5];
    const vector W1_0 = W[6];
    const vector W1_1 = W[7];
    const vector W1_2 = W[8];
    const vector W1_3 = W[9];
    const vector W1_4 = W[10];
    const vector W1_5 = W[11];
    const vector W2_0 = W[12];
    const vector W2_1 = W[13];
    const vector W2_2 = W[14];
    const vector W2_3 = W[15];
    const vector W2_4 = W[16];
    const vector W2_5 = W[17];
    const vector W3_0 = W[18];
    const vector W3_1 = W[19];
    const vector W3_2 = W[20];
    const vector W3_3 = W[21];
    const vector W3_4 = W[22];
    const vector W3_5 = W[23];
    const vector W4_0 = W[24];
    const vector W4_1 = W[25];
    const vector W4_2 = W[26];
    const vector W4_3 = W[27];
    const vector W4_4 = W[28];
    const vector W4_5 = W[29];
    const vector W5_0 = W[30];
    const vector W5_1 = W[31];
    const vector W5_2 = W[32];
    const vector W5_3 = W[33];
    const vector W5_4 = W[34];
    const vector W5_5 = W[35];
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
    const vector sum16 = sums[16];
    const vector sum17 = sums[17];
    const vector sum18 = sums[18];
    const vector sum19 = sums[19];
    const vector sum20 = sums[20];
    const vector sum21 = sums[21];
    const vector sum22 = sums[22];
    const vector sum23 = sums[23];
    const vector sum24 = sums[24];
    const vector sum25 = sums[25];
    const vector sum26 = sums[26];
    const vector sum27 = sums[27];
    const vector sum28 = sums[28];
    const vector sum29 = sums[29];
    const vector sum30 = sums[30];
    const vector sum31 = sums[31];
    const vector sum32 = sums[32];
    const vector sum33 = sums[33];
    const vector sum34 = sums[34];
    const vector sum35 = sums[35];
    const vector product = 2.0 * mu6;
    const vector product_2 = 2.0 * mu5;
    const vector product_3 = 2.0 * mu4;
    const vector rotation_R5_0 = -(W5_5 * product) - W5_4 * product_2 - W5_3 * product_3;
    const vector product_4 = 2.0 * mu3;
    const vector rotation_R5_1 = W5_5 * product_2 - W5_4 * product + W5_3 * product_4;
    const vector product_5 = 2.0 * sum30;
    const vector total_2 = W5_0 * sum15 + W5_1 * sum19 + W5_2 * sum23 + rotation_R5_0 * sum27 + rotation_R5_1
        * product_5;
    const vector rotation_R5_2 = W5_4 * product_4 - W5_5 * product_3 + W5_3 * product;
    const vector rotation_R5_3 = W5_5 * product_4 + W5_4 * product_3 - W5_3 * product_2;
    const vector by_rotation_R5_1 = total_2 + rotation_R5_2 * sum31 + rotation_R5_3 * sum32;
    const vector rotation_R4_0 = -(W4_5 * product) - W4_4 * product_2 - W4_3 * product_3;
    const vector rotation_R4_1 = W4_5 * product_2 - W4_4 * product + W4_3 * product_4;
    const vector total_3 = W4_0 * sum15 + W4_1 * sum19 + W4_2 * sum23 + rotation_R4_0 * sum27 + rotation_R4_1
        * product_5;
    const vector rotation_R4_2 = W4_4 * product_4 - W4_5 * product_3 + W4_3 * product;
    const vector rotation_R4_3 = W4_5 * product_4 + W4_4 * product_3 - W4_3 * product_2;
    const vector by_rotation_R4_1 = total_3 + rotation_R4_2 * sum31 + rotation_R4_3 * sum32;
    const vector rotation_R3_0 = -(W3_5 * product) - W3_4 * product_2 - W3_3 * product_3;
    const vector rotation_R3_1 = W3_5 * product_2 - W3_4 * product + W3_3 * product_4;
    const vector total_4 = W3_0 * sum15 + W3_1 * sum19 + W3_2 * sum23 + rotation_R3_0 * sum27 + rotation_R3_1
        * product_5;
    const vector rotation_R3_2 = W3_4 * product_4 - W3_5 * product_3 + W3_3 * product;
    const vector rotation_R3_3 = W3_5 * product_4 + W3_4 * product_3 - W3_3 * product_2;
    const vector by_rotation_R3_1 = total_4 + rotation_R3_2 * sum31 + rotation_R3_3 * sum32;
    const vector rotation_R2_0 = -(W2_5 * product) - W2_4 * product_2 - W2_3 * product_3;
    const vector rotation_R2_1 = W2_5 * product_2 - W2_4 * product + W2_3 * product_4;
    const vector total_5 = W2_0 * sum15 + W2_1 * sum19 + W2_2 * sum23 + rotation_R2_0 * sum27 + rotation_R2_1
        * product_5;
    const vector rotation_R2_2 = W2_4 * product_4 - W2_5 * product_3 + W2_3 * product;
    const vector rotation_R2_3 = W2_5 * product_4 + W2_4 * product_3 - W2_3 * product_2;
    const vector by_rotation_R2_1 = total_5 + rotation_R2_2 * sum31 + rotation_R2_3 * sum32;
    const vector rotation_R1_0 = -(W1_5 * product) - W1_4 * product_2 - W1_3 * product_3;
    const vector rotation_R1_1 = W1_5 * product_2 - W1_4 * product + W1_3 * product_4;
    const vector total_6 = W1_0 * sum15 + W1_1 * sum19 + W1_2 * sum23 + rotation_R1_0 * sum27 + rotation_R1_1
        * product_5;
    const vector rotation_R1_2 = W1_4 * product_4 - W1_5 * product_3 + W1_3 * product;
    const vector rotation_R1_3 = W1_5 * product_4 + W1_4 * product_3 - W1_3 * product_2;
    const vector by_rotation_R1_1 = total_6 + rotation_R1_2 * sum31 + rotation_R1_3 * sum32;
    const vector total_7 = W5_3 * by_rotation_R5_1 + W4_3 * by_rotation_R4_1 + W3_3 * by_rotation_R3_1 + W2_3
        * by_rotation_R2_1 + W1_3 * by_rotation_R1_1;
    const vector rotation_R0_0 = -(W0_5 * product) - W0_4 * product_2 - W0_3 * product_3;
    const vector rotation_R0_1 = W0_5 * product_2 - W0_4 * product + W0_3 * product_4;
    const vector total_8 = W0_0 * sum15 + W0_1 * sum19 + W0_2 * sum23 + rotation_R0_0 * sum27 + rotation_R0_1
        * product_5;
    const vector rotation_R0_2 = W0_4 * product_4 - W0_5 * product_3 + W0_3 * product;
    const vector rotation_R0_3 = W0_5 * product_4 + W0_4 * product_3 - W0_3 * product_2;
    const vector by_rotation_R0_1 = total_8 + rotation_R0_2 * sum31 + rotation_R0_3 * sum32;
    const vector total_9 = W5_0 * sum16 + W5_1 * sum20 + W5_2 * sum24 + rotation_R5_0 * sum28 + rotation_R5_1
        * sum31;
    const vector product_6 = 2.0 * sum33;
    const vector by_rotation_R5_2 = total_9 + rotation_R5_2 * product_6 + rotation_R5_3 * sum34;
    const vector total_10 = W4_0 * sum16 + W4_1 * sum20 + W4_2 * sum24 + rotation_R4_0 * sum28 + rotation_R4_1
        * sum31;
    const vector by_rotation_R4_2 = total_10 + rotation_R4_2 * product_6 + rotation_R4_3 * sum34;
    const vector total_11 = W3_0 * sum16 + W3_1 * sum20 + W3_2 * sum24 + rotation_R3_0 * sum28 + rotation_R3_1
        * sum31;
    const vector by_rotation_R3_2 = total_11 + rotation_R3_2 * product_6 + rotation_R3_3 * sum34;
    const vector total_12 = total_7 + W0_3 * by_rotation_R0_1 + W5_4 * by_rotation_R5_2 + W4_4 *
        by_rotation_R4_2 + W3_4 * by_rotation_R3_2;
    const vector total_13 = W2_0 * sum16 + W2_1 * sum20 + W2_2 * sum24 + rotation_R2_0 * sum28 + rotation_R2_1
        * sum31;
    const vector by_rotation_R2_2 = total_13 + rotation_R2_2 * product_6 + rotation_R2_3 * sum34;
    const vector total_14 = W1_0 * sum16 + W1_1 * sum20 + W1_2 * sum24 + rotation_R1_0 * sum28 + rotation_R1_1
        * sum31;
    const vector by_rotation_R1_2 = total_14 + rotation_R1_2 * product_6 + rotation_R1_3 * sum34;
    const vector total_15 = W0_0 * sum16 + W0_1 * sum20 + W0_2 * sum24 + rotation_R0_0 * sum28 + rotation_R0_1
        * sum31;
    const vector by_rotation_R0_2 = total_15 + rotation_R0_2 * product_6 + rotation_R0_3 * sum34;
    const vector total_16 = W5_0 * sum17 + W5_1 * sum21 + W5_2 * sum25 + rotation_R5_0 * sum29 + rotation_R5_1
        * sum32;
    const vector product_7 = 2.0 * sum35;
    const vector by_rotation_R5_3 = total_16 + rotation_R5_2 * sum34 + rotation_R5_3 * product_7;
    const vector total_17 = total_12 + W2_4 * by_rotation_R2_2 + W1_4 * by_rotation_R1_2 + W0_4 *
        by_rotation_R0_2 + W5_5 * by_rotation_R5_3;
    const vector total_18 = W4_0 * sum17 + W4_1 * sum21 + W4_2 * sum25 + rotation_R4_0 * sum29 + rotation_R4_1
        * sum32;
    const vector by_rotation_R4_3 = total_18 + rotation_R4_2 * sum34 + rotation_R4_3 * product_7;
    const vector total_19 = W3_0 * sum17 + W3_1 * sum21 + W3_2 * sum25 + rotation_R3_0 * sum29 + rotation_R3_1
        * sum32;
    const vector by_rotation_R3_3 = total_19 + rotation_R3_2 * sum34 + rotation_R3_3 * product_7;
    const vector total_20 = W2_0 * sum17 + W2_1 * sum21 + W2_2 * sum25 + rotation_R2_0 * sum29 + rotation_R2_1
        * sum32;
    const vector by_rotation_R2_3 = total_20 + rotation_R2_2 * sum34 + rotation_R2_3 * product_7;
    const vector total_21 = W1_0 * sum17 + W1_1 * sum21 + W1_2 * sum25 + rotation_R1_0 * sum29 + rotation_R1_1
        * sum32;
    const vector by_rotation_R1_3 = total_21 + rotation_R1_2 * sum34 + rotation_R1_3 * product_7;
    const vector total_22 = total_17 + W4_5 * by_rotation_R4_3 + W3_5 * by_rotation_R3_3 + W2_5 *
        by_rotation_R2_3 + W1_5 * by_rotation_R1_3;
    const vector total_23 = W0_0 * sum17 + W0_1 * sum21 + W0_2 * sum25 + rotation_R0_0 * sum29 + rotation_R0_1
        * sum32;
    const vector by_rotation_R0_3 = total_23 + rotation_R0_2 * sum34 + rotation_R0_3 * product_7;
    const vector product_8 = its_amplitude * (sum3 + 2.0 * (total_22 + W0_5 * by_rotation_R0_3));
    const vector product_9 = 2.0 * sum26;
    const vector total_24 = W5_0 * sum14 + W5_1 * sum18 + W5_2 * sum22 + rotation_R5_0 * product_9 +
        rotation_R5_1 * sum27;
    const vector by_rotation_R5_0 = total_24 + rotation_R5_2 * sum28 + rotation_R5_3 * sum29;
    const vector total_25 = W4_0 * sum14 + W4_1 * sum18 + W4_2 * sum22 + rotation_R4_0 * product_9 +
        rotation_R4_1 * sum27;
    const vector by_rotation_R4_0 = total_25 + rotation_R4_2 * sum28 + rotation_R4_3 * sum29;
    const vector total_26 = W3_0 * sum14 + W3_1 * sum18 + W3_2 * sum22 + rotation_R3_0 * product_9 +
        rotation_R3_1 * sum27;
    const vector by_rotation_R3_0 = total_26 + rotation_R3_2 * sum28 + rotation_R3_3 * sum29;
    const vector total_27 = W2_0 * sum14 + W2_1 * sum18 + W2_2 * sum22 + rotation_R2_0 * product_9 +
        rotation_R2_1 * sum27;
    const vector by_rotation_R2_0 = total_27 + rotation_R2_2 * sum28 + rotation_R2_3 * sum29;
    const vector gap = -(W5_3 * by_rotation_R5_0) - W4_3 * by_rotation_R4_0 - W3_3 * by_rotation_R3_0 - W2_3 *
        by_rotation_R2_0;
    const vector total_28 = W1_0 * sum14 + W1_1 * sum18 + W1_2 * sum22 + rotation_R1_0 * product_9 +
        rotation_R1_1 * sum27;
    const vector by_rotation_R1_0 = total_28 + rotation_R1_2 * sum28 + rotation_R1_3 * sum29;
    const vector total_29 = W0_0 * sum14 + W0_1 * sum18 + W0_2 * sum22 + rotation_R0_0 * product_9 +
        rotation_R0_1 * sum27;
    const vector by_rotation_R0_0 = total_29 + rotation_R0_2 * sum28 + rotation_R0_3 * sum29;
    const vector gap_2 = gap - W1_3 * by_rotation_R1_0 - W0_3 * by_rotation_R0_0 - W5_5 * by_rotation_R5_2 -
        W4_5 * by_rotation_R4_2;
    const vector gap_3 = gap_2 - W3_5 * by_rotation_R3_2 - W2_5 * by_rotation_R2_2 - W1_5 * by_rotation_R1_2 -
        W0_5 * by_rotation_R0_2;
    const vector total_30 = gap_3 + W5_4 * by_rotation_R5_3 + W4_4 * by_rotation_R4_3 + W3_4 *
        by_rotation_R3_3 + W2_4 * by_rotation_R2_3;
    const vector total_31 = sum4 + 2.0 * (total_30 + W1_4 * by_rotation_R1_3 + W0_4 * by_rotation_R0_3);
    const vector gap_4 = -(W5_4 * by_rotation_R5_0) - W4_4 * by_rotation_R4_0 - W3_4 * by_rotation_R3_0 - W2_4
        * by_rotation_R2_0;
    const vector total_32 = gap_4 - W1_4 * by_rotation_R1_0 - W0_4 * by_rotation_R0_0 + W5_5 *
        by_rotation_R5_1 + W4_5 * by_rotation_R4_1;
    const vector total_33 = total_32 + W3_5 * by_rotation_R3_1 + W2_5 * by_rotation_R2_1 + W1_5 *
        by_rotation_R1_1 + W0_5 * by_rotation_R0_1;
    const vector gap_5 = total_33 - W5_3 * by_rotation_R5_3 - W4_3 * by_rotation_R4_3 - W3_3 *
        by_rotation_R3_3 - W2_3 * by_rotation_R2_3;
    const vector total_34 = sum5 + 2.0 * (gap_5 - W1_3 * by_rotation_R1_3 - W0_3 * by_rotation_R0_3);
    const vector gap_6 = -(W5_5 * by_rotation_R5_0) - W4_5 * by_rotation_R4_0 - W3_5 * by_rotation_R3_0 - W2_5
        * by_rotation_R2_0;
    const vector gap_7 = gap_6 - W1_5 * by_rotation_R1_0 - W0_5 * by_rotation_R0_0 - W5_4 * by_rotation_R5_1 -
        W4_4 * by_rotation_R4_1;
    const vector gap_8 = gap_7 - W3_4 * by_rotation_R3_1 - W2_4 * by_rotation_R2_1 - W1_4 * by_rotation_R1_1 -
        W0_4 * by_rotation_R0_1;
    const vector total_35 = gap_8 + W5_3 * by_rotation_R5_2 + W4_3 * by_rotation_R4_2 + W3_3 *
        by_rotation_R3_2 + W2_3 * by_rotation_R2_2;
    const vector total_36 = sum6 + 2.0 * (total_35 + W1_3 * by_rotation_R1_2 + W0_3 * by_rotation_R0_2);
    const vector product_10 = 2.0 * sum8;
    const vector total_37 = W0_0 * product_10 + W0_1 * sum9 + W0_2 * sum10 + rotation_R0_0 * sum14 +
        rotation_R0_1 * sum15;
    const vector product_11 = 2.0 * sum11;
    const vector total_38 = W0_0 * sum9 + W0_1 * product_11 + W0_2 * sum12 + rotation_R0_0 * sum18 +
        rotation_R0_1 * sum19;
    const vector product_12 = 2.0 * sum13;
    const vector total_39 = W0_0 * sum10 + W0_1 * sum12 + W0_2 * product_12 + rotation_R0_0 * sum22 +
        rotation_R0_1 * sum23;
    const vector product_13 = its_amplitude * (product_4 * by_rotation_R0_1 - product_3 * by_rotation_R0_0 +
        product * by_rotation_R0_2 - product_2 * by_rotation_R0_3);
    const vector total_40 = -(product_2 * by_rotation_R0_0) - product * by_rotation_R0_1 + product_4 *
        by_rotation_R0_2 + product_3 * by_rotation_R0_3;
    const vector product_14 = its_amplitude * (product_2 * by_rotation_R0_1 - product * by_rotation_R0_0 -
        product_3 * by_rotation_R0_2 + product_4 * by_rotation_R0_3);
    const vector total_41 = W1_0 * product_10 + W1_1 * sum9 + W1_2 * sum10 + rotation_R1_0 * sum14 +
        rotation_R1_1 * sum15;
    const vector total_42 = W1_0 * sum9 + W1_1 * product_11 + W1_2 * sum12 + rotation_R1_0 * sum18 +
        rotation_R1_1 * sum19;
    const vector total_43 = W1_0 * sum10 + W1_1 * sum12 + W1_2 * product_12 + rotation_R1_0 * sum22 +
        rotation_R1_1 * sum23;
    const vector product_15 = its_amplitude * (product_4 * by_rotation_R1_1 - product_3 * by_rotation_R1_0 +
        product * by_rotation_R1_2 - product_2 * by_rotation_R1_3);
    const vector total_44 = -(product_2 * by_rotation_R1_0) - product * by_rotation_R1_1 + product_4 *
        by_rotation_R1_2 + product_3 * by_rotation_R1_3;
    const vector product_16 = its_amplitude * (product_2 * by_rotation_R1_1 - product * by_rotation_R1_0 -
        product_3 * by_rotation_R1_2 + product_4 * by_rotation_R1_3);
    const vector total_45 = W2_0 * product_10 + W2_1 * sum9 + W2_2 * sum10 + rotation_R2_0 * sum14 +
        rotation_R2_1 * sum15;
    const vector total_46 = W2_0 * sum9 + W2_1 * product_11 + W2_2 * sum12 + rotation_R2_0 * sum18 +
        rotation_R2_1 * sum19;
    const vector total_47 = W2_0 * sum10 + W2_1 * sum12 + W2_2 * product_12 + rotation_R2_0 * sum22 +
        rotation_R2_1 * sum23;
    const vector product_17 = its_amplitude * (product_4 * by_rotation_R2_1 - product_3 * by_rotation_R2_0 +
        product * by_rotation_R2_2 - product_2 * by_rotation_R2_3);
    const vector total_48 = -(product_2 * by_rotation_R2_0) - product * by_rotation_R2_1 + product_4 *
        by_rotation_R2_2 + product_3 * by_rotation_R2_3;
    const vector product_18 = its_amplitude * (product_2 * by_rotation_R2_1 - product * by_rotation_R2_0 -
        product_3 * by_rotation_R2_2 + product_4 * by_rotation_R2_3);
    const vector total_49 = W3_0 * product_10 + W3_1 * sum9 + W3_2 * sum10 + rotation_R3_0 * sum14 +
        rotation_R3_1 * sum15;
    const vector total_50 = W3_0 * sum9 + W3_1 * product_11 + W3_2 * sum12 + rotation_R3_0 * sum18 +
        rotation_R3_1 * sum19;
    const vector total_51 = W3_0 * sum10 + W3_1 * sum12 + W3_2 * product_12 + rotation_R3_0 * sum22 +
        rotation_R3_1 * sum23;
    const vector product_19 = its_amplitude * (product_4 * by_rotation_R3_1 - product_3 * by_rotation_R3_0 +
        product * by_rotation_R3_2 - product_2 * by_rotation_R3_3);
    const vector total_52 = -(product_2 * by_rotation_R3_0) - product * by_rotation_R3_1 + product_4 *
        by_rotation_R3_2 + product_3 * by_rotation_R3_3;
    const vector product_20 = its_amplitude * (product_2 * by_rotation_R3_1 - product * by_rotation_R3_0 -
        product_3 * by_rotation_R3_2 + product_4 * by_rotation_R3_3);
    const vector total_53 = W4_0 * product_10 + W4_1 * sum9 + W4_2 * sum10 + rotation_R4_0 * sum14 +
        rotation_R4_1 * sum15;
    const vector total_54 = W4_0 * sum9 + W4_1 * product_11 + W4_2 * sum12 + rotation_R4_0 * sum18 +
        rotation_R4_1 * sum19;
    const vector total_55 = W4_0 * sum10 + W4_1 * sum12 + W4_2 * product_12 + rotation_R4_0 * sum22 +
        rotation_R4_1 * sum23;
    const vector product_21 = its_amplitude * (product_4 * by_rotation_R4_1 - product_3 * by_rotation_R4_0 +
        product * by_rotation_R4_2 - product_2 * by_rotation_R4_3);
    const vector total_56 = -(product_2 * by_rotation_R4_0) - product * by_rotation_R4_1 + product_4 *
        by_rotation_R4_2 + product_3 * by_rotation_R4_3;
    const vector product_22 = its_amplitude * (product_2 * by_rotation_R4_1 - product * by_rotation_R4_0 -
        product_3 * by_rotation_R4_2 + product_4 * by_rotation_R4_3);
    const vector total_57 = W5_0 * product_10 + W5_1 * sum9 + W5_2 * sum10 + rotation_R5_0 * sum14 +
        rotation_R5_1 * sum15;
    const vector total_58 = W5_0 * sum9 + W5_1 * product_11 + W5_2 * sum12 + rotation_R5_0 * sum18 +
        rotation_R5_1 * sum19;
    const vector total_59 = W5_0 * sum10 + W5_1 * sum12 + W5_2 * product_12 + rotation_R5_0 * sum22 +
        rotation_R5_1 * sum23;
    const vector product_23 = its_amplitude * (product_4 * by_rotation_R5_1 - product_3 * by_rotation_R5_0 +
        product * by_rotation_R5_2 - product_2 * by_rotation_R5_3);
    const vector total_60 = -(product_2 * by_rotation_R5_0) - product * by_rotation_R5_1 + product_4 *
        by_rotation_R5_2 + product_3 * by_rotation_R5_3;
    const vector product_24 = its_amplitude * (product_2 * by_rotation_R5_1 - product * by_rotation_R5_0 -
        product_3 * by_rotation_R5_2 + product_4 * by_rotation_R5_3);
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = its_amplitude * sum1;
    mu_bar[2] = its_amplitude * sum2;
    mu_bar[3] = product_8;
    mu_bar[4] = its_amplitude * total_31;
    mu_bar[5] = its_amplitude * total_34;
    mu_bar[6] = its_amplitude * total_36;
    W_bar[0] = its_amplitude * (total_37 + rotation_R0_2 * sum16 + rotation_R0_3 * sum17);
    W_bar[1] = its_amplitude * (total_38 + rotation_R0_2 * sum20 + rotation_R0_3 * sum21);
    W_bar[2] = its_amplitude * (total_39 + rotation_R0_2 * sum24 + rotation_R0_3 * sum25);
    W_bar[3] = product_13;
    W_bar[4] = its_amplitude * total_40;
    W_bar[5] = product_14;
    W_bar[6] = its_amplitude * (total_41 + rotation_R1_2 * sum16 + rotation_R1_3 * sum17);
    W_bar[7] = its_amplitude * (total_42 + rotation_R1_2 * sum20 + rotation_R1_3 * sum21);
    W_bar[8] = its_amplitude * (total_43 + rotation_R1_2 * sum24 + rotation_R1_3 * sum25);
    W_bar[9] = product_15;
    W_bar[10] = its_amplitude * total_44;
    W_bar[11] = product_16;
    W_bar[12] = its_amplitude * (total_45 + rotation_R2_2 * sum16 + rotation_R2_3 * sum17);
    W_bar[13] = its_amplitude * (total_46 + rotation_R2_2 * sum20 + rotation_R2_3 * sum21);
    W_bar[14] = its_amplitude * (total_47 + rotation_R2_2 * sum24 + rotation_R2_3 * sum25);
    W_bar[15] = product_17;
    W_bar[16] = its_amplitude * total_48;
    W_bar[17] = product_18;
    W_bar[18] = its_amplitude * (total_49 + rotation_R3_2 * sum16 + rotation_R3_3 * sum17);
    W_bar[19] = its_amplitude * (total_50 + rotation_R3_2 * sum20 + rotation_R3_3 * sum21);
    W_bar[20] = its_amplitude * (total_51 + rotation_R3_2 * sum24 + rotation_R3_3 * sum25);
    W_bar[21] = product_19;
    W_bar[22] = its_amplitude * total_52;
    W_bar[23] = product_20;
    W_bar[24] = its_amplitude * (total_53 + rotation_R4_2 * sum16 + rotation_R4_3 * sum17);
    W_bar[25] = its_amplitude * (total_54 + rotation_R4_2 * sum20 + rotation_R4_3 * sum21);
    W_bar[26] = its_amplitude * (total_55 + rotation_R4_2 * sum24 + rotation_R4_3 * sum25);
    W_bar[27] = product_21;
    W_bar[28] = its_amplitude * total_56;
    W_bar[29] = product_22;
    W_bar[30] = its_amplitude * (total_57 + rotation_R5_2 * sum16 + rotation_R5_3 * sum17);
    W_bar[31] = its_amplitude * (total_58 + rotation_R5_2 * sum20 + rotation_R5_3 * sum21);
    W_bar[32] = its_amplitude * (total_59 + rotation_R5_2 * sum24 + rotation_R5_3 * sum25);
    W_bar[33] = product_23;
    W_bar[34] = its_amplitude * total_60;
    W_bar[35] = product_24;
    amplitude_bar[0] = sum7;
}

/* The distances of some points q from one point p. */
OUTLINE void pair_distances(
    const double *p, const vector *q, vector *distance) {
    const double p0 = p[0];
    const double p1 = p[1];
    const double p2 = p[2];
    const double p3 = p[3];
    const double p4 = p[4];
    const double p5 = p[5];
    const double p6 = p[6];
    const vector q0 = q[0];
    const vector q1 = q[1];
    const vector q2 = q[2];
    const vector q3 = q[3];
    const vector q4 = q[4];
    const vector q5 = q[5];
    const vector q6 = q[6];
    const vector position_log0 = q0 - p0;
    const vector position_log1 = q1 - p1;
    const vector position_log2 = q2 - p2;
    const vector rotation_g0 = p3 * q3 + p4 * q4 + p5 * q5 + p6 * q6;
    const vector rotation_g1 = p3 * q4 + p6 * q5 - p4 * q3 - p5 * q6;
    const vector rotation_g2 = p3 * q5 + p4 * q6 - p5 * q3 - p6 * q4;
    const vector rotation_g3 = p3 * q6 + p5 * q4 - p4 * q5 - p6 * q3;
    const vector rotation_norm_s_squared = rotation_g1 * rotation_g1 + rotation_g2 * rotation_g2 + rotation_g3
        * rotation_g3;
    const vector rotation_norm_s = sqrt_each(rotation_norm_s_squared);
    const vector rotation_abs_g0 = abs_each(rotation_g0);
    const vector rotation_atan2_norm_s_abs_g0 = atan2_each(rotation_norm_s, rotation_abs_g0);
    const vector rotation_t = 2.0 * rotation_atan2_norm_s_abs_g0;
    const vector length = sqrt_each(position_log0 * position_log0 + position_log1 * position_log1 +
        position_log2 * position_log2 + rotation_t * rotation_t);
    distance[0] = length;
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

/* Scratch memory: 15 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t se3_splats_work(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES - 1) / LANES, blocks = (points + 2 - 1) / 2;
    const size_t places = 8 * ((splat_count + LANES - 1) / LANES + (blocks + LANES - 1) / LANES);
    return (points * 15 + places + 1) * LANES + 78 * splat_count;
}

static vector *work_points(double *work) {
    const uintptr_t size = sizeof(vector), start = (uintptr_t)work;
    return (vector *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const double *splat_at(const vector *splats, size_t k) {
    const size_t row = k / LANES;
    return (const double *)(splats + 8 * row) + (k - row * LANES);
}

static vector *work_reaches(double *work, size_t count) {
    return work_points(work) + (count + LANES - 1) / LANES * 15;
}

static vector *work_blocks(double *work, size_t count, size_t splat_count) {
    return work_reaches(work, count) + 8 * ((splat_count + LANES - 1) / LANES);
}

static double *work_constants(double *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES, blocks = (count + size - 1) / size;
    return (double *)(work_blocks(work, count, splat_count) + 8 * ((blocks + LANES - 1) / LANES));
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
    vector *own = splats + start / LANES * (7 + 1);
    vector_rows(width, splat_count, start, 1, own + 7);
    own[7] = own[7] * 9.115346828320313 + vector_spoilt(mu, 7) + vector_spoilt(amplitude, 1);
    for (int i = 0; i < 7; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place(const double *x, size_t count, size_t start, double *place) {
    const size_t size = count - start < 2 * LANES ? count - start : 2 * LANES;
    vector at[2][7], spoilt = ZERO;
    for (size_t b = 0; b < 2; ++b) {
        vector_rows(x, count, start + b * LANES, 7, at[b]);
        spoilt += vector_spoilt(at[b], 7);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const double *middle = x + 7 * (start + i * size / 8);
        double radius = 0, column[LANES];
        for (size_t b = 0; b < 2; ++b) {
            vector distance[1];
            pair_distances(middle, at[b], distance);
            vector_store(column, distance[0]);
            for (size_t lane = 0; lane < LANES; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[7]) {
            for (int j = 0; j < 7; ++j) place[j] = middle[j];
            place[7] = radius;
        }
    }
    place[7] = place[7] * 1.0078125 + vector_sum(spoilt);
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
        const vector *own = splats + start / LANES * (7 + 1);
        vector distance[1];
        pair_distances(place, own, distance);
        const vector_mask far = vector_far(distance[0], own[7], vector_of(place[7]));
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
        const vector *own = blocks + start / group * (7 + 1);
        vector distance[1];
        pair_distances(mu, own, distance);
        const vector_mask far = vector_far(distance[0], vector_of(*reach), own[7]);
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
    vector own_mu[7], own_W[36], own_amplitude[1], S[78];
    vector_rows(mu, splat_count, start, 7, own_mu);
    vector_rows(W, splat_count, start, 36, own_W);
    vector_rows(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants(own_mu, own_W, own_amplitude, S);
    vector_to_rows(S, constants, splat_count, start, 78, 78);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void se3_splats(
    size_t count, size_t splat_count, const double *SE3_RESTRICT x, const double *SE3_RESTRICT mu, const double *SE3_RESTRICT W, const double *SE3_RESTRICT amplitude, const double *SE3_RESTRICT width,
    double *SE3_RESTRICT value, double *SE3_RESTRICT gradient, double *SE3_RESTRICT work, int threads) {
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
            vector at[2][7], X[2 * 7], grad[6];
            vector value_sum[2] = {ZERO}, slope_sum[2 * 7] = {ZERO};
            double place[7 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 7, at[b]);
                pair_features(at[b], X + 7 * b);
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
                pair_gradient(at[b], slope_sum + 7 * b, grad);
                vector_to_rows(value_sum + b, value, count, start + b * LANES, 1, 1);
                vector_to_rows(grad, gradient, count, start + b * LANES, 6, 6);
            }
        }
        restore_denormals(mode);
    }
}

void se3_splats_value(
    size_t count, size_t splat_count, const double *SE3_RESTRICT x, const double *SE3_RESTRICT mu, const double *SE3_RESTRICT W, const double *SE3_RESTRICT amplitude, const double *SE3_RESTRICT width,
    double *SE3_RESTRICT value, double *SE3_RESTRICT work, int threads) {
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
            vector at[7], X[2 * 7], value_sum[2] = {ZERO};
            double place[7 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 7, at);
                pair_features(at, X + 7 * b);
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
    vector at[7], grad_bar[6], slope_bar[7];
    vector_rows(x, count, start, 7, at);
    vector_rows(gradient_bar, count, start, 6, grad_bar);
    vector_rows(value_bar, count, start, 1, point + 7);
    pair_features(at, point);
    pair_gradient_vjp(at, grad_bar, slope_bar);
    for (int i = 0; i < 7; ++i) point[7 + 1 + i] = slope_bar[i];
    vector_end(count, start, 7 + 1, point + 7);
}

/* Adds what makes the derivatives, of a splat at some vectors of points: their factors, then the products of these. */
INLINE void pair_backward(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *sums) {
    vector factor[16 * 20];
    pair_factors(count, points, near, S, factor);
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_0(factor + 20 * i, points + 15 * (size_t)near[i], sum);
        sums[0] += sum[0];
        sums[1] += sum[1];
        sums[2] += sum[2];
        sums[7] += sum[3];
        sums[8] += sum[4];
        sums[9] += sum[5];
        sums[11] += sum[6];
        sums[10] += sum[7];
        sums[12] += sum[8];
        sums[13] += sum[9];
        sums[14] += sum[10];
        sums[18] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_1(factor + 20 * i, points + 15 * (size_t)near[i], sum);
        sums[3] += sum[0];
        sums[4] += sum[1];
        sums[5] += sum[2];
        sums[6] += sum[3];
        sums[26] += sum[4];
        sums[22] += sum[5];
        sums[23] += sum[6];
        sums[27] += sum[7];
        sums[30] += sum[8];
        sums[15] += sum[9];
        sums[16] += sum[10];
        sums[24] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_2(factor + 20 * i, points + 15 * (size_t)near[i], sum);
        sums[17] += sum[0];
        sums[35] += sum[1];
        sums[21] += sum[2];
        sums[19] += sum[3];
        sums[32] += sum[4];
        sums[20] += sum[5];
        sums[31] += sum[6];
        sums[33] += sum[7];
        sums[34] += sum[8];
        sums[25] += sum[9];
        sums[28] += sum[10];
        sums[29] += sum[11];
    }
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums(const vector *points, const uint32_t *near, size_t size, const double *S, double *sums) {
    vector sum[36] = {ZERO};
    for (size_t b = 0; b < size; b += 16)
        pair_backward(size - b < 16 ? size - b : 16, points, near + b, S, sum);
    for (size_t i = 0; i < 36; ++i) sums[i] += vector_sum(sum[i]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void se3_splats_vjp(
    size_t count, size_t splat_count, const double *SE3_RESTRICT x, const double *SE3_RESTRICT mu, const double *SE3_RESTRICT W, const double *SE3_RESTRICT amplitude, const double *SE3_RESTRICT width, const double *SE3_RESTRICT value_bar, const double *SE3_RESTRICT gradient_bar,
    double *SE3_RESTRICT mu_bar, double *SE3_RESTRICT W_bar, double *SE3_RESTRICT amplitude_bar, double *SE3_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES - 1) / LANES;
    const size_t chunk = 131072 / (15 * sizeof(vector)) + 1;
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
                double place[7 + 1];
                const size_t last = (blocks - 1) / 2, start = (block < last ? block : last) * 2;
                block_place(x, count, start * LANES, place);
                for (int i = 0; i < 8; ++i) {
                    double *row = (double *)(places + block / LANES * 8 + i);
                    row[block - block / LANES * LANES] = place[i];
                }
            }
        }
        OMP(omp for schedule(dynamic, 8))
        for (size_t block = 0; block < blocks; ++block)
            splat_points(count, block * LANES, x, value_bar, gradient_bar, points + 15 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            double sums[LANES][36] = {{0}};
            uint32_t near[131072 / (15 * sizeof(vector)) + 2];
            vector own_mu[7], own_W[36], own_amplitude[1], own_sums[36], bars[44];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const double *reach = width ? splat_at(splats, k) + 7 * LANES : NULL;
                    const size_t some = blocks_near(mu + 7 * k, reach, places, first, first + size, near);
                    splat_sums(points + 15 * first, near, some, constants + 78 * k, sums[k - start]);
                }
            }
            vector_rows(mu, end, start, 7, own_mu);
            vector_rows(W, end, start, 36, own_W);
            vector_rows(amplitude, end, start, 1, own_amplitude);
            vector_rows(sums[0], LANES, 0, 36, own_sums);
            pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 7, bars + 7 + 36);
            vector_to_rows(bars, mu_bar, end, start, 7, 7);
            vector_to_rows(bars + 7, W_bar, end, start, 36, 36);
            vector_to_rows(bars + 7 + 36, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void se3_splats_rows(
    size_t count, size_t splat_count, const double *SE3_RESTRICT x, const double *SE3_RESTRICT mu, const double *SE3_RESTRICT W, const double *SE3_RESTRICT amplitude, const double *SE3_RESTRICT value_bar, const double *SE3_RESTRICT gradient_bar,
    double *SE3_RESTRICT rows, double *SE3_RESTRICT work, int threads) {
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
            vector point[15];
            splat_points(count, block * LANES, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector own_mu[7], own_W[36], own_amplitude[1], own_sums[36] = {ZERO}, bars[44];
                for (int i = 0; i < 7; ++i) own_mu[i] = vector_of(mu[7 * k + i]);
                for (int i = 0; i < 36; ++i) own_W[i] = vector_of(W[36 * k + i]);
                own_amplitude[0] = vector_of(amplitude[k]);
                pair_backward(1, point, &only, constants + 78 * k, own_sums);
                pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 7, bars + 7 + 36);
                vector_to_rows(bars, rows + 44 * k, count, block * LANES, 44, 44 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

/* A coordinate to sort by. */
INLINE double order_key(const double *x, size_t row, size_t axis) {
    const double key = x[7 * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest(const double *x, const size_t *order, size_t count) {
    double low[7], high[7];
    size_t widest = 0;
    for (size_t axis = 0; axis < 7; ++axis) low[axis] = high[axis] = order_key(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < 7; ++axis) {
            const double key = order_key(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < 7; ++axis)
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

double se3_splats_order(
    size_t count, size_t splat_count, const double *SE3_RESTRICT x, const double *SE3_RESTRICT mu, const double *SE3_RESTRICT amplitude, const double *SE3_RESTRICT width,
    double limit, size_t *SE3_RESTRICT order, double *SE3_RESTRICT work) {
    const size_t block = 2 * LANES;
    vector *splats = work_reaches(work, 0);
    uint32_t near[256];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES) {
        vector own_mu[7], own_amplitude[1];
        vector_rows(mu, splat_count, start, 7, own_mu);
        vector_rows(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks(x, order, count, (double *)work_blocks(work, 0, splat_count));
        for (size_t i = 1; i < 2 * 16; i += 2) {
            double rows[2 * LANES * 7], place[7 + 1];
            const size_t some = i * count / (2 * 16), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < 7; ++j) rows[7 * n + j] = x[7 * order[start + n] + j];
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
INLINE vector_f vector_polynomial_rotation_eta_f(vector_f x) {
    const vector_f x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return -0.3333333329074172f + x * -0.15555567514484153f + x2 * (-0.07512673968454313f + x *
        -0.036854683410814014f) + x4 * (-0.017172242426810813f + x * -0.013945774438806282f + x2 *
        (0.01253044380771583f + x * -0.03940423726113369f)) + x8 * (0.051921663529563705f + x *
        -0.048257650185791916f + x2 * (0.024694517679698283f + x * -0.006116061322664089f));
}

/* Of degree 13, within 2^-27 of that of double precision. */
INLINE vector_f vector_polynomial_rotation_eta_slope_f(vector_f x) {
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
    const vector_f x4 = x[4];
    const vector_f x5 = x[5];
    const vector_f x6 = x[6];
    X[0] = x0;
    X[1] = x1;
    X[2] = x2;
    X[3] = x3;
    X[4] = x4;
    X[5] = x5;
    X[6] = x6;
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
    const vector_f W0_0 = W[0];
    const vector_f W0_1 = W[1];
    const vector_f W0_2 = W[2];
    const vector_f W0_3 = W[3];
    const vector_f W0_4 = W[4];
    const vector_f W0_5 = W[5];
    const vector_f W1_0 = W[6];
    const vector_f W1_1 = W[7];
    const vector_f W1_2 = W[8];
    const vector_f W1_3 = W[9];
    const vector_f W1_4 = W[10];
    const vector_f W1_5 = W[11];
    const vector_f W2_0 = W[12];
    const vector_f W2_1 = W[13];
    const vector_f W2_2 = W[14];
    const vector_f W2_3 = W[15];
    const vector_f W2_4 = W[16];
    const vector_f W2_5 = W[17];
    const vector_f W3_0 = W[18];
    const vector_f W3_1 = W[19];
    const vector_f W3_2 = W[20];
    const vector_f W3_3 = W[21];
    const vector_f W3_4 = W[22];
    const vector_f W3_5 = W[23];
    const vector_f W4_0 = W[24];
    const vector_f W4_1 = W[25];
    const vector_f W4_2 = W[26];
    const vector_f W4_3 = W[27];
    const vector_f W4_4 = W[28];
    const vector_f W4_5 = W[29];
    const vector_f W5_0 = W[30];
    const vector_f W5_1 = W[31];
    const vector_f W5_2 = W[32];
    const vector_f W5_3 = W[33];
    const vector_f W5_4 = W[34];
    const vector_f W5_5 = W[35];
    const vector_f its_amplitude = amplitude[0];
    const vector_f total_2 = W0_0 * W0_0 + W1_0 * W1_0 + W2_0 * W2_0 + W3_0 * W3_0 + W4_0 * W4_0;
    const vector_f M0_0 = total_2 + W5_0 * W5_0;
    const vector_f total_3 = W0_0 * W0_1 + W1_0 * W1_1 + W2_0 * W2_1 + W3_0 * W3_1 + W4_0 * W4_1;
    const vector_f M0_1 = total_3 + W5_0 * W5_1;
    const vector_f total_4 = W0_0 * W0_2 + W1_0 * W1_2 + W2_0 * W2_2 + W3_0 * W3_2 + W4_0 * W4_2;
    const vector_f M0_2 = total_4 + W5_0 * W5_2;
    const vector_f total_5 = W0_1 * W0_1 + W1_1 * W1_1 + W2_1 * W2_1 + W3_1 * W3_1 + W4_1 * W4_1;
    const vector_f M1_1 = total_5 + W5_1 * W5_1;
    const vector_f total_6 = W0_1 * W0_2 + W1_1 * W1_2 + W2_1 * W2_2 + W3_1 * W3_2 + W4_1 * W4_2;
    const vector_f M1_2 = total_6 + W5_1 * W5_2;
    const vector_f total_7 = W0_2 * W0_2 + W1_2 * W1_2 + W2_2 * W2_2 + W3_2 * W3_2 + W4_2 * W4_2;
    const vector_f M2_2 = total_7 + W5_2 * W5_2;
    const vector_f product = 2.0f * mu3;
    const vector_f product_2 = 2.0f * mu4;
    const vector_f product_3 = 2.0f * mu5;
    const vector_f rotation_R0_3 = W0_5 * product + W0_4 * product_2 - W0_3 * product_3;
    const vector_f product_4 = 2.0f * mu6;
    const vector_f rotation_R0_0 = -(W0_5 * product_4) - W0_4 * product_3 - W0_3 * product_2;
    const vector_f rotation_R0_2 = W0_4 * product - W0_5 * product_2 + W0_3 * product_4;
    const vector_f rotation_R0_1 = W0_5 * product_3 - W0_4 * product_4 + W0_3 * product;
    const vector_f rotation_R1_3 = W1_5 * product + W1_4 * product_2 - W1_3 * product_3;
    const vector_f rotation_R1_0 = -(W1_5 * product_4) - W1_4 * product_3 - W1_3 * product_2;
    const vector_f rotation_R1_2 = W1_4 * product - W1_5 * product_2 + W1_3 * product_4;
    const vector_f rotation_R1_1 = W1_5 * product_3 - W1_4 * product_4 + W1_3 * product;
    const vector_f rotation_R2_3 = W2_5 * product + W2_4 * product_2 - W2_3 * product_3;
    const vector_f rotation_R2_0 = -(W2_5 * product_4) - W2_4 * product_3 - W2_3 * product_2;
    const vector_f rotation_R2_2 = W2_4 * product - W2_5 * product_2 + W2_3 * product_4;
    const vector_f rotation_R2_1 = W2_5 * product_3 - W2_4 * product_4 + W2_3 * product;
    const vector_f rotation_R3_3 = W3_5 * product + W3_4 * product_2 - W3_3 * product_3;
    const vector_f rotation_R3_0 = -(W3_5 * product_4) - W3_4 * product_3 - W3_3 * product_2;
    const vector_f rotation_R3_2 = W3_4 * product - W3_5 * product_2 + W3_3 * product_4;
    const vector_f rotation_R3_1 = W3_5 * product_3 - W3_4 * product_4 + W3_3 * product;
    const vector_f rotation_R4_3 = W4_5 * product + W4_4 * product_2 - W4_3 * product_3;
    const vector_f rotation_R4_0 = -(W4_5 * product_4) - W4_4 * product_3 - W4_3 * product_2;
    const vector_f rotation_R4_2 = W4_4 * product - W4_5 * product_2 + W4_3 * product_4;
    const vector_f rotation_R4_1 = W4_5 * product_3 - W4_4 * product_4 + W4_3 * product;
    const vector_f rotation_R5_3 = W5_5 * product + W5_4 * product_2 - W5_3 * product_3;
    const vector_f rotation_R5_0 = -(W5_5 * product_4) - W5_4 * product_3 - W5_3 * product_2;
    const vector_f rotation_R5_2 = W5_4 * product - W5_5 * product_2 + W5_3 * product_4;
    const vector_f rotation_R5_1 = W5_5 * product_3 - W5_4 * product_4 + W5_3 * product;
    const vector_f total_8 = W0_0 * rotation_R0_0 + W1_0 * rotation_R1_0 + W2_0 * rotation_R2_0 + W3_0 *
        rotation_R3_0 + W4_0 * rotation_R4_0;
    const vector_f M0_3 = total_8 + W5_0 * rotation_R5_0;
    const vector_f total_9 = W0_0 * rotation_R0_1 + W1_0 * rotation_R1_1 + W2_0 * rotation_R2_1 + W3_0 *
        rotation_R3_1 + W4_0 * rotation_R4_1;
    const vector_f M0_4 = total_9 + W5_0 * rotation_R5_1;
    const vector_f total_10 = W0_0 * rotation_R0_2 + W1_0 * rotation_R1_2 + W2_0 * rotation_R2_2 + W3_0 *
        rotation_R3_2 + W4_0 * rotation_R4_2;
    const vector_f M0_5 = total_10 + W5_0 * rotation_R5_2;
    const vector_f total_11 = W0_0 * rotation_R0_3 + W1_0 * rotation_R1_3 + W2_0 * rotation_R2_3 + W3_0 *
        rotation_R3_3 + W4_0 * rotation_R4_3;
    const vector_f M0_6 = total_11 + W5_0 * rotation_R5_3;
    const vector_f total_12 = W0_1 * rotation_R0_0 + W1_1 * rotation_R1_0 + W2_1 * rotation_R2_0 + W3_1 *
        rotation_R3_0 + W4_1 * rotation_R4_0;
    const vector_f M1_3 = total_12 + W5_1 * rotation_R5_0;
    const vector_f total_13 = W0_1 * rotation_R0_1 + W1_1 * rotation_R1_1 + W2_1 * rotation_R2_1 + W3_1 *
        rotation_R3_1 + W4_1 * rotation_R4_1;
    const vector_f M1_4 = total_13 + W5_1 * rotation_R5_1;
    const vector_f total_14 = W0_1 * rotation_R0_2 + W1_1 * rotation_R1_2 + W2_1 * rotation_R2_2 + W3_1 *
        rotation_R3_2 + W4_1 * rotation_R4_2;
    const vector_f M1_5 = total_14 + W5_1 * rotation_R5_2;
    const vector_f total_15 = W0_1 * rotation_R0_3 + W1_1 * rotation_R1_3 + W2_1 * rotation_R2_3 + W3_1 *
        rotation_R3_3 + W4_1 * rotation_R4_3;
    const vector_f M1_6 = total_15 + W5_1 * rotation_R5_3;
    const vector_f total_16 = W0_2 * rotation_R0_0 + W1_2 * rotation_R1_0 + W2_2 * rotation_R2_0 + W3_2 *
        rotation_R3_0 + W4_2 * rotation_R4_0;
    const vector_f M2_3 = total_16 + W5_2 * rotation_R5_0;
    const vector_f total_17 = W0_2 * rotation_R0_1 + W1_2 * rotation_R1_1 + W2_2 * rotation_R2_1 + W3_2 *
        rotation_R3_1 + W4_2 * rotation_R4_1;
    const vector_f M2_4 = total_17 + W5_2 * rotation_R5_1;
    const vector_f total_18 = W0_2 * rotation_R0_2 + W1_2 * rotation_R1_2 + W2_2 * rotation_R2_2 + W3_2 *
        rotation_R3_2 + W4_2 * rotation_R4_2;
    const vector_f M2_5 = total_18 + W5_2 * rotation_R5_2;
    const vector_f total_19 = W0_2 * rotation_R0_3 + W1_2 * rotation_R1_3 + W2_2 * rotation_R2_3 + W3_2 *
        rotation_R3_3 + W4_2 * rotation_R4_3;
    const vector_f M2_6 = total_19 + W5_2 * rotation_R5_3;
    const vector_f total_20 = rotation_R0_0 * rotation_R0_0 + rotation_R1_0 * rotation_R1_0 + rotation_R2_0 *
        rotation_R2_0 + rotation_R3_0 * rotation_R3_0 + rotation_R4_0 * rotation_R4_0;
    const vector_f M3_3 = total_20 + rotation_R5_0 * rotation_R5_0;
    const vector_f total_21 = rotation_R0_0 * rotation_R0_1 + rotation_R1_0 * rotation_R1_1 + rotation_R2_0 *
        rotation_R2_1 + rotation_R3_0 * rotation_R3_1 + rotation_R4_0 * rotation_R4_1;
    const vector_f M3_4 = total_21 + rotation_R5_0 * rotation_R5_1;
    const vector_f total_22 = rotation_R0_0 * rotation_R0_2 + rotation_R1_0 * rotation_R1_2 + rotation_R2_0 *
        rotation_R2_2 + rotation_R3_0 * rotation_R3_2 + rotation_R4_0 * rotation_R4_2;
    const vector_f M3_5 = total_22 + rotation_R5_0 * rotation_R5_2;
    const vector_f total_23 = rotation_R0_3 * rotation_R0_0 + rotation_R1_3 * rotation_R1_0 + rotation_R2_3 *
        rotation_R2_0 + rotation_R3_3 * rotation_R3_0 + rotation_R4_3 * rotation_R4_0;
    const vector_f M3_6 = total_23 + rotation_R5_3 * rotation_R5_0;
    const vector_f total_24 = rotation_R0_1 * rotation_R0_1 + rotation_R1_1 * rotation_R1_1 + rotation_R2_1 *
        rotation_R2_1 + rotation_R3_1 * rotation_R3_1 + rotation_R4_1 * rotation_R4_1;
    const vector_f M4_4 = total_24 + rotation_R5_1 * rotation_R5_1;
    const vector_f total_25 = rotation_R0_2 * rotation_R0_1 + rotation_R1_2 * rotation_R1_1 + rotation_R2_2 *
        rotation_R2_1 + rotation_R3_2 * rotation_R3_1 + rotation_R4_2 * rotation_R4_1;
    const vector_f M4_5 = total_25 + rotation_R5_2 * rotation_R5_1;
    const vector_f total_26 = rotation_R0_3 * rotation_R0_1 + rotation_R1_3 * rotation_R1_1 + rotation_R2_3 *
        rotation_R2_1 + rotation_R3_3 * rotation_R3_1 + rotation_R4_3 * rotation_R4_1;
    const vector_f M4_6 = total_26 + rotation_R5_3 * rotation_R5_1;
    const vector_f total_27 = rotation_R0_2 * rotation_R0_2 + rotation_R1_2 * rotation_R1_2 + rotation_R2_2 *
        rotation_R2_2 + rotation_R3_2 * rotation_R3_2 + rotation_R4_2 * rotation_R4_2;
    const vector_f M5_5 = total_27 + rotation_R5_2 * rotation_R5_2;
    const vector_f total_28 = rotation_R0_3 * rotation_R0_2 + rotation_R1_3 * rotation_R1_2 + rotation_R2_3 *
        rotation_R2_2 + rotation_R3_3 * rotation_R3_2 + rotation_R4_3 * rotation_R4_2;
    const vector_f M5_6 = total_28 + rotation_R5_3 * rotation_R5_2;
    const vector_f total_29 = rotation_R0_3 * rotation_R0_3 + rotation_R1_3 * rotation_R1_3 + rotation_R2_3 *
        rotation_R2_3 + rotation_R3_3 * rotation_R3_3 + rotation_R4_3 * rotation_R4_3;
    const vector_f M6_6 = total_29 + rotation_R5_3 * rotation_R5_3;
    S[0] = mu0;
    S[1] = mu1;
    S[2] = mu2;
    S[3] = mu3;
    S[4] = mu4;
    S[5] = mu5;
    S[6] = mu6;
    S[7] = W0_0;
    S[8] = W0_1;
    S[9] = W0_2;
    S[10] = W1_0;
    S[11] = W1_1;
    S[12] = W1_2;
    S[13] = W2_0;
    S[14] = W2_1;
    S[15] = W2_2;
    S[16] = W3_0;
    S[17] = W3_1;
    S[18] = W3_2;
    S[19] = W4_0;
    S[20] = W4_1;
    S[21] = W4_2;
    S[22] = W5_0;
    S[23] = W5_1;
    S[24] = W5_2;
    S[25] = its_amplitude;
    S[26] = M0_0;
    S[27] = M0_1;
    S[28] = M0_2;
    S[29] = M1_1;
    S[30] = M1_2;
    S[31] = M2_2;
    S[32] = rotation_R0_3;
    S[33] = rotation_R0_0;
    S[34] = rotation_R0_2;
    S[35] = rotation_R0_1;
    S[36] = rotation_R1_3;
    S[37] = rotation_R1_0;
    S[38] = rotation_R1_2;
    S[39] = rotation_R1_1;
    S[40] = rotation_R2_3;
    S[41] = rotation_R2_0;
    S[42] = rotation_R2_2;
    S[43] = rotation_R2_1;
    S[44] = rotation_R3_3;
    S[45] = rotation_R3_0;
    S[46] = rotation_R3_2;
    S[47] = rotation_R3_1;
    S[48] = rotation_R4_3;
    S[49] = rotation_R4_0;
    S[50] = rotation_R4_2;
    S[51] = rotation_R4_1;
    S[52] = rotation_R5_3;
    S[53] = rotation_R5_0;
    S[54] = rotation_R5_2;
    S[55] = rotation_R5_1;
    S[56] = M0_3;
    S[57] = M0_4;
    S[58] = M0_5;
    S[59] = M0_6;
    S[60] = M1_3;
    S[61] = M1_4;
    S[62] = M1_5;
    S[63] = M1_6;
    S[64] = M2_3;
    S[65] = M2_4;
    S[66] = M2_5;
    S[67] = M2_6;
    S[68] = M3_3;
    S[69] = M3_4;
    S[70] = M3_5;
    S[71] = M3_6;
    S[72] = M4_4;
    S[73] = M4_5;
    S[74] = M4_6;
    S[75] = M5_5;
    S[76] = M5_6;
    S[77] = M6_6;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
 * w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
 * eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
 * Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
 * r = R h = W (tangent part of x), z = a r + what other factors add, phi = amplitude a^k exp(-|z|^2 / 2)
 */
INLINE void pair_value_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values) {
    struct { vector_f rotation_g0, rotation_a, gaussian; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 78 * near[k];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 7 * b;
            const vector_f x3 = X[3];
            const vector_f x4 = X[4];
            const vector_f x5 = X[5];
            const vector_f x6 = X[6];
            const vector_f rotation_g0 = x3 * mu3 + x4 * mu4 + x5 * mu5 + x6 * mu6;
            const vector_f rotation_abs_g0 = abs_each_f(rotation_g0);
            const vector_f rotation_eta = vector_polynomial_rotation_eta_f(1.0f - rotation_abs_g0);
            const vector_f rotation_a = 1.0f / (rotation_abs_g0 - rotation_eta * (1.0f - rotation_abs_g0 *
                rotation_abs_g0));
            kept[k][b].rotation_g0 = rotation_g0;
            kept[k][b].rotation_a = rotation_a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 78 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float W0_0 = S[7];
        const float W0_1 = S[8];
        const float W0_2 = S[9];
        const float W1_0 = S[10];
        const float W1_1 = S[11];
        const float W1_2 = S[12];
        const float W2_0 = S[13];
        const float W2_1 = S[14];
        const float W2_2 = S[15];
        const float W3_0 = S[16];
        const float W3_1 = S[17];
        const float W3_2 = S[18];
        const float W4_0 = S[19];
        const float W4_1 = S[20];
        const float W4_2 = S[21];
        const float W5_0 = S[22];
        const float W5_1 = S[23];
        const float W5_2 = S[24];
        const float rotation_R0_3 = S[32];
        const float rotation_R0_0 = S[33];
        const float rotation_R0_2 = S[34];
        const float rotation_R0_1 = S[35];
        const float rotation_R1_3 = S[36];
        const float rotation_R1_0 = S[37];
        const float rotation_R1_2 = S[38];
        const float rotation_R1_1 = S[39];
        const float rotation_R2_3 = S[40];
        const float rotation_R2_0 = S[41];
        const float rotation_R2_2 = S[42];
        const float rotation_R2_1 = S[43];
        const float rotation_R3_3 = S[44];
        const float rotation_R3_0 = S[45];
        const float rotation_R3_2 = S[46];
        const float rotation_R3_1 = S[47];
        const float rotation_R4_3 = S[48];
        const float rotation_R4_0 = S[49];
        const float rotation_R4_2 = S[50];
        const float rotation_R4_1 = S[51];
        const float rotation_R5_3 = S[52];
        const float rotation_R5_0 = S[53];
        const float rotation_R5_2 = S[54];
        const float rotation_R5_1 = S[55];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 7 * b;
            const vector_f rotation_g0 = kept[k][b].rotation_g0;
            const vector_f rotation_a = kept[k][b].rotation_a;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f x4 = X[4];
            const vector_f x5 = X[5];
            const vector_f x6 = X[6];
            const vector_f v0 = x0 - mu0;
            const vector_f v1 = x1 - mu1;
            const vector_f v2 = x2 - mu2;
            const vector_f rotation_a_chosen = vector_select_f(rotation_g0 < 0.0f, -rotation_a, rotation_a);
            const vector_f product = x3 * rotation_a_chosen;
            const vector_f product_2 = x4 * rotation_a_chosen;
            const vector_f total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + rotation_R0_0 * product + rotation_R0_1 *
                product_2;
            const vector_f product_3 = x5 * rotation_a_chosen;
            const vector_f product_4 = x6 * rotation_a_chosen;
            const vector_f total_3 = total_2 + rotation_R0_2 * product_3 + rotation_R0_3 * product_4;
            const vector_f total_4 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + rotation_R1_0 * product + rotation_R1_1 *
                product_2;
            const vector_f total_5 = total_4 + rotation_R1_2 * product_3 + rotation_R1_3 * product_4;
            const vector_f total_6 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + rotation_R2_0 * product + rotation_R2_1 *
                product_2;
            const vector_f total_7 = total_6 + rotation_R2_2 * product_3 + rotation_R2_3 * product_4;
            const vector_f total_8 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + rotation_R3_0 * product + rotation_R3_1 *
                product_2;
            const vector_f total_9 = total_8 + rotation_R3_2 * product_3 + rotation_R3_3 * product_4;
            const vector_f total_10 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + rotation_R4_0 * product + rotation_R4_1 *
                product_2;
            const vector_f total_11 = total_10 + rotation_R4_2 * product_3 + rotation_R4_3 * product_4;
            const vector_f total_12 = total_3 * total_3 + total_5 * total_5 + total_7 * total_7 + total_9 * total_9 +
                total_11 * total_11;
            const vector_f total_13 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + rotation_R5_0 * product + rotation_R5_1 *
                product_2;
            const vector_f total_14 = total_13 + rotation_R5_2 * product_3 + rotation_R5_3 * product_4;
            const vector_f gaussian = gaussian_each_f(total_12 + total_14 * total_14);
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 78 * near[k];
        const float amplitude = S[25];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            const vector_f rotation_a = kept[k][b].rotation_a;
            const vector_f gaussian = kept[k][b].gaussian;
            const vector_f phi = rotation_a * (rotation_a * gaussian);
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
 * r = R h = W (tangent part of x), z = a r + what other factors add, phi = amplitude a^k exp(-|z|^2 / 2)
 */
INLINE void pair_forward_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values, vector_f *slopes) {
    struct { vector_f rotation_g0, rotation_eta, rotation_a, rotation_a_chosen, total_3, total_5, total_7,
            total_9, total_11, total_14, gaussian; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 78 * near[k];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 7 * b;
            const vector_f x3 = X[3];
            const vector_f x4 = X[4];
            const vector_f x5 = X[5];
            const vector_f x6 = X[6];
            const vector_f rotation_g0 = x3 * mu3 + x4 * mu4 + x5 * mu5 + x6 * mu6;
            const vector_f rotation_abs_g0 = abs_each_f(rotation_g0);
            const vector_f rotation_eta = vector_polynomial_rotation_eta_f(1.0f - rotation_abs_g0);
            const vector_f rotation_a = 1.0f / (rotation_abs_g0 - rotation_eta * (1.0f - rotation_abs_g0 *
                rotation_abs_g0));
            kept[k][b].rotation_g0 = rotation_g0;
            kept[k][b].rotation_eta = rotation_eta;
            kept[k][b].rotation_a = rotation_a;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 78 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float W0_0 = S[7];
        const float W0_1 = S[8];
        const float W0_2 = S[9];
        const float W1_0 = S[10];
        const float W1_1 = S[11];
        const float W1_2 = S[12];
        const float W2_0 = S[13];
        const float W2_1 = S[14];
        const float W2_2 = S[15];
        const float W3_0 = S[16];
        const float W3_1 = S[17];
        const float W3_2 = S[18];
        const float W4_0 = S[19];
        const float W4_1 = S[20];
        const float W4_2 = S[21];
        const float W5_0 = S[22];
        const float W5_1 = S[23];
        const float W5_2 = S[24];
        const float rotation_R0_3 = S[32];
        const float rotation_R0_0 = S[33];
        const float rotation_R0_2 = S[34];
        const float rotation_R0_1 = S[35];
        const float rotation_R1_3 = S[36];
        const float rotation_R1_0 = S[37];
        const float rotation_R1_2 = S[38];
        const float rotation_R1_1 = S[39];
        const float rotation_R2_3 = S[40];
        const float rotation_R2_0 = S[41];
        const float rotation_R2_2 = S[42];
        const float rotation_R2_1 = S[43];
        const float rotation_R3_3 = S[44];
        const float rotation_R3_0 = S[45];
        const float rotation_R3_2 = S[46];
        const float rotation_R3_1 = S[47];
        const float rotation_R4_3 = S[48];
        const float rotation_R4_0 = S[49];
        const float rotation_R4_2 = S[50];
        const float rotation_R4_1 = S[51];
        const float rotation_R5_3 = S[52];
        const float rotation_R5_0 = S[53];
        const float rotation_R5_2 = S[54];
        const float rotation_R5_1 = S[55];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 7 * b;
            const vector_f rotation_g0 = kept[k][b].rotation_g0;
            const vector_f rotation_a = kept[k][b].rotation_a;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f x4 = X[4];
            const vector_f x5 = X[5];
            const vector_f x6 = X[6];
            const vector_f v0 = x0 - mu0;
            const vector_f v1 = x1 - mu1;
            const vector_f v2 = x2 - mu2;
            const vector_mask_f is_small = rotation_g0 < 0.0f;
            const vector_f rotation_a_chosen = vector_select_f(is_small, -rotation_a, rotation_a);
            const vector_f product = x3 * rotation_a_chosen;
            const vector_f product_2 = x4 * rotation_a_chosen;
            const vector_f total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + rotation_R0_0 * product + rotation_R0_1 *
                product_2;
            const vector_f product_3 = x5 * rotation_a_chosen;
            const vector_f product_4 = x6 * rotation_a_chosen;
            const vector_f total_3 = total_2 + rotation_R0_2 * product_3 + rotation_R0_3 * product_4;
            const vector_f total_4 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + rotation_R1_0 * product + rotation_R1_1 *
                product_2;
            const vector_f total_5 = total_4 + rotation_R1_2 * product_3 + rotation_R1_3 * product_4;
            const vector_f total_6 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + rotation_R2_0 * product + rotation_R2_1 *
                product_2;
            const vector_f total_7 = total_6 + rotation_R2_2 * product_3 + rotation_R2_3 * product_4;
            const vector_f total_8 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + rotation_R3_0 * product + rotation_R3_1 *
                product_2;
            const vector_f total_9 = total_8 + rotation_R3_2 * product_3 + rotation_R3_3 * product_4;
            const vector_f total_10 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + rotation_R4_0 * product + rotation_R4_1 *
                product_2;
            const vector_f total_11 = total_10 + rotation_R4_2 * product_3 + rotation_R4_3 * product_4;
            const vector_f total_12 = total_3 * total_3 + total_5 * total_5 + total_7 * total_7 + total_9 * total_9 +
                total_11 * total_11;
            const vector_f total_13 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + rotation_R5_0 * product + rotation_R5_1 *
                product_2;
            const vector_f total_14 = total_13 + rotation_R5_2 * product_3 + rotation_R5_3 * product_4;
            const vector_f gaussian = gaussian_each_f(total_12 + total_14 * total_14);
            kept[k][b].rotation_a_chosen = rotation_a_chosen;
            kept[k][b].total_3 = total_3;
            kept[k][b].total_5 = total_5;
            kept[k][b].total_7 = total_7;
            kept[k][b].total_9 = total_9;
            kept[k][b].total_11 = total_11;
            kept[k][b].total_14 = total_14;
            kept[k][b].gaussian = gaussian;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 78 * near[k];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float W0_0 = S[7];
        const float W0_1 = S[8];
        const float W0_2 = S[9];
        const float W1_0 = S[10];
        const float W1_1 = S[11];
        const float W1_2 = S[12];
        const float W2_0 = S[13];
        const float W2_1 = S[14];
        const float W2_2 = S[15];
        const float W3_0 = S[16];
        const float W3_1 = S[17];
        const float W3_2 = S[18];
        const float W4_0 = S[19];
        const float W4_1 = S[20];
        const float W4_2 = S[21];
        const float W5_0 = S[22];
        const float W5_1 = S[23];
        const float W5_2 = S[24];
        const float amplitude = S[25];
        const float rotation_R0_3 = S[32];
        const float rotation_R0_0 = S[33];
        const float rotation_R0_2 = S[34];
        const float rotation_R0_1 = S[35];
        const float rotation_R1_3 = S[36];
        const float rotation_R1_0 = S[37];
        const float rotation_R1_2 = S[38];
        const float rotation_R1_1 = S[39];
        const float rotation_R2_3 = S[40];
        const float rotation_R2_0 = S[41];
        const float rotation_R2_2 = S[42];
        const float rotation_R2_1 = S[43];
        const float rotation_R3_3 = S[44];
        const float rotation_R3_0 = S[45];
        const float rotation_R3_2 = S[46];
        const float rotation_R3_1 = S[47];
        const float rotation_R4_3 = S[48];
        const float rotation_R4_0 = S[49];
        const float rotation_R4_2 = S[50];
        const float rotation_R4_1 = S[51];
        const float rotation_R5_3 = S[52];
        const float rotation_R5_0 = S[53];
        const float rotation_R5_2 = S[54];
        const float rotation_R5_1 = S[55];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 7 * b;
            vector_f *value = values + b;
            vector_f *slope = slopes + 7 * b;
            const vector_f rotation_g0 = kept[k][b].rotation_g0;
            const vector_f rotation_eta = kept[k][b].rotation_eta;
            const vector_f rotation_a = kept[k][b].rotation_a;
            const vector_f rotation_a_chosen = kept[k][b].rotation_a_chosen;
            const vector_f total_3 = kept[k][b].total_3;
            const vector_f total_5 = kept[k][b].total_5;
            const vector_f total_7 = kept[k][b].total_7;
            const vector_f total_9 = kept[k][b].total_9;
            const vector_f total_11 = kept[k][b].total_11;
            const vector_f total_14 = kept[k][b].total_14;
            const vector_f gaussian = kept[k][b].gaussian;
            const vector_f x3 = X[3];
            const vector_f x4 = X[4];
            const vector_f x5 = X[5];
            const vector_f x6 = X[6];
            const vector_mask_f is_small = rotation_g0 < 0.0f;
            const vector_f phi = rotation_a * (rotation_a * gaussian);
            const vector_f phi_2 = amplitude * phi;
            const vector_f total_15 = W0_0 * total_3 + W1_0 * total_5 + W2_0 * total_7 + W3_0 * total_9 + W4_0 *
                total_11;
            const vector_f total_16 = W0_1 * total_3 + W1_1 * total_5 + W2_1 * total_7 + W3_1 * total_9 + W4_1 *
                total_11;
            const vector_f total_17 = W0_2 * total_3 + W1_2 * total_5 + W2_2 * total_7 + W3_2 * total_9 + W4_2 *
                total_11;
            const vector_f total_18 = rotation_R0_3 * total_3 + rotation_R1_3 * total_5 + rotation_R2_3 * total_7 +
                rotation_R3_3 * total_9 + rotation_R4_3 * total_11;
            const vector_f phi_product = phi_2 * (total_18 + rotation_R5_3 * total_14);
            const vector_f total_19 = rotation_R0_2 * total_3 + rotation_R1_2 * total_5 + rotation_R2_2 * total_7 +
                rotation_R3_2 * total_9 + rotation_R4_2 * total_11;
            const vector_f phi_product_2 = phi_2 * (total_19 + rotation_R5_2 * total_14);
            const vector_f total_20 = rotation_R0_1 * total_3 + rotation_R1_1 * total_5 + rotation_R2_1 * total_7 +
                rotation_R3_1 * total_9 + rotation_R4_1 * total_11;
            const vector_f phi_product_3 = phi_2 * (total_20 + rotation_R5_1 * total_14);
            const vector_f total_21 = rotation_R0_0 * total_3 + rotation_R1_0 * total_5 + rotation_R2_0 * total_7 +
                rotation_R3_0 * total_9 + rotation_R4_0 * total_11;
            const vector_f phi_product_4 = phi_2 * (total_21 + rotation_R5_0 * total_14);
            const vector_f gap = -(x6 * phi_product) - x5 * phi_product_2 - x4 * phi_product_3 - x3 * phi_product_4;
            const vector_f by_rotation_abs_g0 = rotation_eta * (2.0f * phi_2 + rotation_a_chosen * gap);
            const vector_f by_rotation_g0 = vector_select_f(is_small, -by_rotation_abs_g0, by_rotation_abs_g0);
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] - phi_2 * (total_15 + W5_0 * total_14);
            slope[1] = slope[1] - phi_2 * (total_16 + W5_1 * total_14);
            slope[2] = slope[2] - phi_2 * (total_17 + W5_2 * total_14);
            slope[3] = slope[3] + mu3 * by_rotation_g0 - rotation_a_chosen * phi_product_4;
            slope[4] = slope[4] + mu4 * by_rotation_g0 - rotation_a_chosen * phi_product_3;
            slope[5] = slope[5] + mu5 * by_rotation_g0 - rotation_a_chosen * phi_product_2;
            slope[6] = slope[6] + mu6 * by_rotation_g0 - rotation_a_chosen * phi_product;
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient_f(
    const vector_f *x, const vector_f *slope, vector_f *gradient) {
    const vector_f x3 = x[3];
    const vector_f x4 = x[4];
    const vector_f x5 = x[5];
    const vector_f x6 = x[6];
    const vector_f slope_x0 = slope[0];
    const vector_f slope_x1 = slope[1];
    const vector_f slope_x2 = slope[2];
    const vector_f slope_x3 = slope[3];
    const vector_f slope_x4 = slope[4];
    const vector_f slope_x5 = slope[5];
    const vector_f slope_x6 = slope[6];
    const vector_f product = 0.5f * slope_x4;
    const vector_f product_2 = 0.5f * slope_x5;
    const vector_f product_3 = 0.5f * slope_x3;
    const vector_f product_4 = 0.5f * slope_x6;
    gradient[0] = slope_x0;
    gradient[1] = slope_x1;
    gradient[2] = slope_x2;
    gradient[3] = x3 * product + x6 * product_2 - x4 * product_3 - x5 * product_4;
    gradient[4] = x3 * product_2 + x4 * product_4 - x5 * product_3 - x6 * product;
    gradient[5] = x5 * product + x3 * product_4 - x6 * product_3 - x4 * product_2;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp_f(
    const vector_f *x, const vector_f *gradient_bar, vector_f *slope_bar) {
    const vector_f x3 = x[3];
    const vector_f x4 = x[4];
    const vector_f x5 = x[5];
    const vector_f x6 = x[6];
    const vector_f gradient_bar0 = gradient_bar[0];
    const vector_f gradient_bar1 = gradient_bar[1];
    const vector_f gradient_bar2 = gradient_bar[2];
    const vector_f gradient_bar3 = gradient_bar[3];
    const vector_f gradient_bar4 = gradient_bar[4];
    const vector_f gradient_bar5 = gradient_bar[5];
    const vector_f product = 0.5f * (-(x6 * gradient_bar5) - x5 * gradient_bar4 - x4 * gradient_bar3);
    slope_bar[0] = gradient_bar0;
    slope_bar[1] = gradient_bar1;
    slope_bar[2] = gradient_bar2;
    slope_bar[3] = product;
    slope_bar[4] = 0.5f * (x5 * gradient_bar5 - x6 * gradient_bar4 + x3 * gradient_bar3);
    slope_bar[5] = 0.5f * (x3 * gradient_bar4 - x4 * gradient_bar5 + x6 * gradient_bar3);
    slope_bar[6] = 0.5f * (x3 * gradient_bar5 + x4 * gradient_bar4 - x5 * gradient_bar3);
}

/*
 * The factors of whose products are what is summed over the points, for some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * h = x / 2, M = mu / 2 (x and mu where x and -x are one point)
 * w = cos(t / 2), or cosh, of the distance t: w^2 = <h + M, h + M>, or w = |<M, h>| where x and -x are one point
 * eta = d log A / dw, 1 / A = w - (1 - w^2) eta, a = A / w (A where x and -x are one point)
 * Log_mu(x) = a (tangent part of x), |det D Log_mu(x)| = a^k
 * r = R h = W (tangent part of x), z = a r + what other factors add, phi = amplitude a^k exp(-|z|^2 / 2)
 */
INLINE void pair_factors_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *factors) {
    struct { vector_f v0, v1, v2, rotation_g0, gap, rotation_eta, rotation_a, rotation_a_chosen, product,
            product_2, product_3, product_4, total_3, total_5, total_7, total_9, total_11, total_14, gaussian; }
            kept[16];
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 15 * (size_t)near[i];
        const vector_f x3 = X[3];
        const vector_f x4 = X[4];
        const vector_f x5 = X[5];
        const vector_f x6 = X[6];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const vector_f rotation_g0 = x3 * mu3 + x4 * mu4 + x5 * mu5 + x6 * mu6;
        const vector_f rotation_abs_g0 = abs_each_f(rotation_g0);
        const vector_f gap = 1.0f - rotation_abs_g0;
        const vector_f rotation_eta = vector_polynomial_rotation_eta_f(gap);
        const vector_f rotation_a = 1.0f / (rotation_abs_g0 - rotation_eta * (1.0f - rotation_abs_g0 *
            rotation_abs_g0));
        kept[i].rotation_g0 = rotation_g0;
        kept[i].gap = gap;
        kept[i].rotation_eta = rotation_eta;
        kept[i].rotation_a = rotation_a;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 15 * (size_t)near[i];
        const vector_f rotation_g0 = kept[i].rotation_g0;
        const vector_f rotation_a = kept[i].rotation_a;
        const vector_f x0 = X[0];
        const vector_f x1 = X[1];
        const vector_f x2 = X[2];
        const vector_f x3 = X[3];
        const vector_f x4 = X[4];
        const vector_f x5 = X[5];
        const vector_f x6 = X[6];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float W0_0 = S[7];
        const float W0_1 = S[8];
        const float W0_2 = S[9];
        const float W1_0 = S[10];
        const float W1_1 = S[11];
        const float W1_2 = S[12];
        const float W2_0 = S[13];
        const float W2_1 = S[14];
        const float W2_2 = S[15];
        const float W3_0 = S[16];
        const float W3_1 = S[17];
        const float W3_2 = S[18];
        const float W4_0 = S[19];
        const float W4_1 = S[20];
        const float W4_2 = S[21];
        const float W5_0 = S[22];
        const float W5_1 = S[23];
        const float W5_2 = S[24];
        const float rotation_R0_3 = S[32];
        const float rotation_R0_0 = S[33];
        const float rotation_R0_2 = S[34];
        const float rotation_R0_1 = S[35];
        const float rotation_R1_3 = S[36];
        const float rotation_R1_0 = S[37];
        const float rotation_R1_2 = S[38];
        const float rotation_R1_1 = S[39];
        const float rotation_R2_3 = S[40];
        const float rotation_R2_0 = S[41];
        const float rotation_R2_2 = S[42];
        const float rotation_R2_1 = S[43];
        const float rotation_R3_3 = S[44];
        const float rotation_R3_0 = S[45];
        const float rotation_R3_2 = S[46];
        const float rotation_R3_1 = S[47];
        const float rotation_R4_3 = S[48];
        const float rotation_R4_0 = S[49];
        const float rotation_R4_2 = S[50];
        const float rotation_R4_1 = S[51];
        const float rotation_R5_3 = S[52];
        const float rotation_R5_0 = S[53];
        const float rotation_R5_2 = S[54];
        const float rotation_R5_1 = S[55];
        const vector_f v0 = x0 - mu0;
        const vector_f v1 = x1 - mu1;
        const vector_f v2 = x2 - mu2;
        const vector_mask_f is_small = rotation_g0 < 0.0f;
        const vector_f rotation_a_chosen = vector_select_f(is_small, -rotation_a, rotation_a);
        const vector_f product = x3 * rotation_a_chosen;
        const vector_f product_2 = x4 * rotation_a_chosen;
        const vector_f total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + rotation_R0_0 * product + rotation_R0_1 *
            product_2;
        const vector_f product_3 = x5 * rotation_a_chosen;
        const vector_f product_4 = x6 * rotation_a_chosen;
        const vector_f total_3 = total_2 + rotation_R0_2 * product_3 + rotation_R0_3 * product_4;
        const vector_f total_4 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + rotation_R1_0 * product + rotation_R1_1 *
            product_2;
        const vector_f total_5 = total_4 + rotation_R1_2 * product_3 + rotation_R1_3 * product_4;
        const vector_f total_6 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + rotation_R2_0 * product + rotation_R2_1 *
            product_2;
        const vector_f total_7 = total_6 + rotation_R2_2 * product_3 + rotation_R2_3 * product_4;
        const vector_f total_8 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + rotation_R3_0 * product + rotation_R3_1 *
            product_2;
        const vector_f total_9 = total_8 + rotation_R3_2 * product_3 + rotation_R3_3 * product_4;
        const vector_f total_10 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + rotation_R4_0 * product + rotation_R4_1 *
            product_2;
        const vector_f total_11 = total_10 + rotation_R4_2 * product_3 + rotation_R4_3 * product_4;
        const vector_f total_13 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + rotation_R5_0 * product + rotation_R5_1 *
            product_2;
        const vector_f total_14 = total_13 + rotation_R5_2 * product_3 + rotation_R5_3 * product_4;
        const vector_f total_16 = total_3 * total_3 + total_5 * total_5 + total_7 * total_7 + total_9 * total_9 +
            total_11 * total_11;
        const vector_f gaussian = gaussian_each_f(total_16 + total_14 * total_14);
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].v2 = v2;
        kept[i].rotation_a_chosen = rotation_a_chosen;
        kept[i].product = product;
        kept[i].product_2 = product_2;
        kept[i].product_3 = product_3;
        kept[i].product_4 = product_4;
        kept[i].total_3 = total_3;
        kept[i].total_5 = total_5;
        kept[i].total_7 = total_7;
        kept[i].total_9 = total_9;
        kept[i].total_11 = total_11;
        kept[i].total_14 = total_14;
        kept[i].gaussian = gaussian;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 15 * (size_t)near[i];
        const vector_f *value_bar = points + 15 * (size_t)near[i] + 7;
        const vector_f *slope_bar = points + 15 * (size_t)near[i] + 7 + 1;
        vector_f *factor = factors + 20 * i;
        const vector_f v0 = kept[i].v0;
        const vector_f v1 = kept[i].v1;
        const vector_f v2 = kept[i].v2;
        const vector_f rotation_g0 = kept[i].rotation_g0;
        const vector_f gap = kept[i].gap;
        const vector_f rotation_eta = kept[i].rotation_eta;
        const vector_f rotation_a = kept[i].rotation_a;
        const vector_f rotation_a_chosen = kept[i].rotation_a_chosen;
        const vector_f product = kept[i].product;
        const vector_f product_2 = kept[i].product_2;
        const vector_f product_3 = kept[i].product_3;
        const vector_f product_4 = kept[i].product_4;
        const vector_f total_3 = kept[i].total_3;
        const vector_f total_5 = kept[i].total_5;
        const vector_f total_7 = kept[i].total_7;
        const vector_f total_9 = kept[i].total_9;
        const vector_f total_11 = kept[i].total_11;
        const vector_f total_14 = kept[i].total_14;
        const vector_f gaussian = kept[i].gaussian;
        const vector_f x3 = X[3];
        const vector_f x4 = X[4];
        const vector_f x5 = X[5];
        const vector_f x6 = X[6];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float W0_0 = S[7];
        const float W0_1 = S[8];
        const float W0_2 = S[9];
        const float W1_0 = S[10];
        const float W1_1 = S[11];
        const float W1_2 = S[12];
        const float W2_0 = S[13];
        const float W2_1 = S[14];
        const float W2_2 = S[15];
        const float W3_0 = S[16];
        const float W3_1 = S[17];
        const float W3_2 = S[18];
        const float W4_0 = S[19];
        const float W4_1 = S[20];
        const float W4_2 = S[21];
        const float W5_0 = S[22];
        const float W5_1 = S[23];
        const float W5_2 = S[24];
        const float M0_0 = S[26];
        const float M0_1 = S[27];
        const float M0_2 = S[28];
        const float M1_1 = S[29];
        const float M1_2 = S[30];
        const float M2_2 = S[31];
        const float rotation_R0_3 = S[32];
        const float rotation_R0_0 = S[33];
        const float rotation_R0_2 = S[34];
        const float rotation_R0_1 = S[35];
        const float rotation_R1_3 = S[36];
        const float rotation_R1_0 = S[37];
        const float rotation_R1_2 = S[38];
        const float rotation_R1_1 = S[39];
        const float rotation_R2_3 = S[40];
        const float rotation_R2_0 = S[41];
        const float rotation_R2_2 = S[42];
        const float rotation_R2_1 = S[43];
        const float rotation_R3_3 = S[44];
        const float rotation_R3_0 = S[45];
        const float rotation_R3_2 = S[46];
        const float rotation_R3_1 = S[47];
        const float rotation_R4_3 = S[48];
        const float rotation_R4_0 = S[49];
        const float rotation_R4_2 = S[50];
        const float rotation_R4_1 = S[51];
        const float rotation_R5_3 = S[52];
        const float rotation_R5_0 = S[53];
        const float rotation_R5_2 = S[54];
        const float rotation_R5_1 = S[55];
        const float M0_3 = S[56];
        const float M0_4 = S[57];
        const float M0_5 = S[58];
        const float M0_6 = S[59];
        const float M1_3 = S[60];
        const float M1_4 = S[61];
        const float M1_5 = S[62];
        const float M1_6 = S[63];
        const float M2_3 = S[64];
        const float M2_4 = S[65];
        const float M2_5 = S[66];
        const float M2_6 = S[67];
        const float M3_3 = S[68];
        const float M3_4 = S[69];
        const float M3_5 = S[70];
        const float M3_6 = S[71];
        const float M4_4 = S[72];
        const float M4_5 = S[73];
        const float M4_6 = S[74];
        const float M5_5 = S[75];
        const float M5_6 = S[76];
        const float M6_6 = S[77];
        const vector_f its_value_bar = value_bar[0];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_f x2_bar = slope_bar[2];
        const vector_f x3_bar = slope_bar[3];
        const vector_f x4_bar = slope_bar[4];
        const vector_f x5_bar = slope_bar[5];
        const vector_f x6_bar = slope_bar[6];
        const vector_mask_f is_small = rotation_g0 < 0.0f;
        const vector_f total_12 = W0_0 * total_3 + W1_0 * total_5 + W2_0 * total_7 + W3_0 * total_9 + W4_0 *
            total_11;
        const vector_f total_15 = total_12 + W5_0 * total_14;
        const vector_f phi = rotation_a * (rotation_a * gaussian);
        const vector_f total_17 = rotation_R0_3 * total_3 + rotation_R1_3 * total_5 + rotation_R2_3 * total_7 +
            rotation_R3_3 * total_9 + rotation_R4_3 * total_11;
        const vector_f total_18 = total_17 + rotation_R5_3 * total_14;
        const vector_f by_by_rotation_g0 = mu3 * x3_bar + mu4 * x4_bar + mu5 * x5_bar + mu6 * x6_bar;
        const vector_f by_by_rotation_abs_g0 = vector_select_f(is_small, vector_of_f(0.0f), by_by_rotation_g0) -
            vector_select_f(is_small, by_by_rotation_g0, vector_of_f(0.0f));
        const vector_f product_5 = rotation_eta * by_by_rotation_abs_g0;
        const vector_f product_6 = rotation_a_chosen * product_5;
        const vector_f gap_2 = -(x6 * product_6) - rotation_a_chosen * x6_bar;
        const vector_f total_19 = rotation_R0_2 * total_3 + rotation_R1_2 * total_5 + rotation_R2_2 * total_7 +
            rotation_R3_2 * total_9 + rotation_R4_2 * total_11;
        const vector_f total_20 = total_19 + rotation_R5_2 * total_14;
        const vector_f gap_3 = -(x5 * product_6) - rotation_a_chosen * x5_bar;
        const vector_f total_21 = rotation_R0_1 * total_3 + rotation_R1_1 * total_5 + rotation_R2_1 * total_7 +
            rotation_R3_1 * total_9 + rotation_R4_1 * total_11;
        const vector_f total_22 = total_21 + rotation_R5_1 * total_14;
        const vector_f gap_4 = -(x4 * product_6) - rotation_a_chosen * x4_bar;
        const vector_f total_23 = rotation_R0_0 * total_3 + rotation_R1_0 * total_5 + rotation_R2_0 * total_7 +
            rotation_R3_0 * total_9 + rotation_R4_0 * total_11;
        const vector_f total_24 = total_23 + rotation_R5_0 * total_14;
        const vector_f gap_5 = -(x3 * product_6) - rotation_a_chosen * x3_bar;
        const vector_f total_25 = its_value_bar + total_18 * gap_2 + total_20 * gap_3 + total_22 * gap_4 +
            total_24 * gap_5;
        const vector_f total_26 = W0_2 * total_3 + W1_2 * total_5 + W2_2 * total_7 + W3_2 * total_9 + W4_2 *
            total_11;
        const vector_f total_27 = total_26 + W5_2 * total_14;
        const vector_f total_28 = W0_1 * total_3 + W1_1 * total_5 + W2_1 * total_7 + W3_1 * total_9 + W4_1 *
            total_11;
        const vector_f total_29 = total_28 + W5_1 * total_14;
        const vector_f by_phi = total_25 - total_27 * x2_bar - total_29 * x1_bar - total_15 * x0_bar + 2.0f *
            product_5;
        const vector_f phi_product = phi * by_phi;
        const vector_f phi_product_2 = phi * x0_bar;
        const vector_f phi_product_3 = phi * x1_bar;
        const vector_f phi_product_4 = phi * x2_bar;
        const vector_f phi_product_5 = phi * gap_5;
        const vector_f total_30 = -(M0_0 * phi_product_2) - M0_1 * phi_product_3 - M0_2 * phi_product_4 + M0_3 *
            phi_product_5;
        const vector_f phi_product_6 = phi * gap_4;
        const vector_f phi_product_7 = phi * gap_3;
        const vector_f phi_product_8 = phi * gap_2;
        const vector_f gap_6 = total_15 * phi_product - (total_30 + M0_4 * phi_product_6 + M0_5 * phi_product_7 +
            M0_6 * phi_product_8);
        const vector_f total_31 = -(M0_1 * phi_product_2) - M1_1 * phi_product_3 - M1_2 * phi_product_4 + M1_3 *
            phi_product_5;
        const vector_f gap_7 = total_29 * phi_product - (total_31 + M1_4 * phi_product_6 + M1_5 * phi_product_7 +
            M1_6 * phi_product_8);
        const vector_f total_32 = -(M0_2 * phi_product_2) - M1_2 * phi_product_3 - M2_2 * phi_product_4 + M2_3 *
            phi_product_5;
        const vector_f gap_8 = total_27 * phi_product - (total_32 + M2_4 * phi_product_6 + M2_5 * phi_product_7 +
            M2_6 * phi_product_8);
        const vector_f phi_product_9 = phi * total_18;
        const vector_f phi_product_10 = phi * total_20;
        const vector_f phi_product_11 = phi * total_22;
        const vector_f phi_product_12 = phi * total_24;
        const vector_f gap_9 = -(x6 * phi_product_9) - x5 * phi_product_10 - x4 * phi_product_11 - x3 *
            phi_product_12;
        const vector_f total_33 = 2.0f * phi + rotation_a_chosen * gap_9;
        const vector_f by_rotation_abs_g0 = rotation_eta * total_33;
        const vector_f by_rotation_g0 = vector_select_f(is_small, -by_rotation_abs_g0, by_rotation_abs_g0);
        const vector_f rotation_eta_slope = vector_polynomial_rotation_eta_slope_f(gap);
        const vector_f gap_10 = gap_9 * product_5 - phi_product_12 * x3_bar - phi_product_11 * x4_bar -
            phi_product_10 * x5_bar - phi_product_9 * x6_bar;
        const vector_f total_34 = -(M0_6 * phi_product_2) - M1_6 * phi_product_3 - M2_6 * phi_product_4 + M3_6 *
            phi_product_5;
        const vector_f gap_11 = total_34 + M4_6 * phi_product_6 + M5_6 * phi_product_7 + M6_6 * phi_product_8 -
            total_18 * phi_product;
        const vector_f total_35 = -(M0_5 * phi_product_2) - M1_5 * phi_product_3 - M2_5 * phi_product_4 + M3_5 *
            phi_product_5;
        const vector_f gap_12 = total_35 + M4_5 * phi_product_6 + M5_5 * phi_product_7 + M5_6 * phi_product_8 -
            total_20 * phi_product;
        const vector_f total_36 = -(M0_4 * phi_product_2) - M1_4 * phi_product_3 - M2_4 * phi_product_4 + M3_4 *
            phi_product_5;
        const vector_f gap_13 = total_36 + M4_4 * phi_product_6 + M4_5 * phi_product_7 + M4_6 * phi_product_8 -
            total_22 * phi_product;
        const vector_f total_37 = -(M0_3 * phi_product_2) - M1_3 * phi_product_3 - M2_3 * phi_product_4 + M3_3 *
            phi_product_5;
        const vector_f gap_14 = total_37 + M3_4 * phi_product_6 + M3_5 * phi_product_7 + M3_6 * phi_product_8 -
            total_24 * phi_product;
        const vector_f total_38 = gap_10 + x6 * gap_11 + x5 * gap_12 + x4 * gap_13 + x3 * gap_14;
        const vector_f by_rotation_abs_g0_2 = rotation_eta_slope * (total_33 * by_by_rotation_abs_g0) +
            rotation_eta * (2.0f * phi_product + rotation_a_chosen * total_38);
        const vector_f by_rotation_g0_2 = vector_select_f(is_small, -by_rotation_abs_g0_2, by_rotation_abs_g0_2);
        const vector_f product_7 = 0.5f * phi_product;
        const vector_f gap_15 = -phi_product_2 - v0 * product_7;
        const vector_f gap_16 = -phi_product_3 - v1 * product_7;
        const vector_f gap_17 = -phi_product_4 - v2 * product_7;
        const vector_f gap_18 = phi_product_5 - product * product_7;
        const vector_f gap_19 = phi_product_6 - product_2 * product_7;
        const vector_f gap_20 = phi_product_7 - product_3 * product_7;
        const vector_f gap_21 = phi_product_8 - product_4 * product_7;
        factor[0] = v0;
        factor[1] = v1;
        factor[2] = v2;
        factor[3] = product;
        factor[4] = product_2;
        factor[5] = product_3;
        factor[6] = product_4;
        factor[7] = phi_product;
        factor[8] = gap_6;
        factor[9] = gap_7;
        factor[10] = gap_8;
        factor[11] = by_rotation_g0;
        factor[12] = by_rotation_g0_2;
        factor[13] = gap_15;
        factor[14] = gap_16;
        factor[15] = gap_17;
        factor[16] = gap_18;
        factor[17] = gap_19;
        factor[18] = gap_20;
        factor[19] = gap_21;
    }
}

/* Adds some of the sums, as products. */
INLINE void pair_products_0_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[8];
    sum[1] = sum[1] + factor[9];
    sum[2] = sum[2] + factor[10];
    sum[3] = sum[3] + factor[7];
    sum[4] = sum[4] + factor[0] * factor[13];
    sum[5] = sum[5] + factor[0] * factor[14] + factor[1] * factor[13];
    sum[6] = sum[6] + factor[1] * factor[14];
    sum[7] = sum[7] + factor[0] * factor[15] + factor[2] * factor[13];
    sum[8] = sum[8] + factor[1] * factor[15] + factor[2] * factor[14];
    sum[9] = sum[9] + factor[2] * factor[15];
    sum[10] = sum[10] + factor[0] * factor[16] + factor[3] * factor[13];
    sum[11] = sum[11] + factor[1] * factor[16] + factor[3] * factor[14];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_1_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[11] * point[11] + point[3] * factor[12];
    sum[1] = sum[1] + factor[11] * point[12] + point[4] * factor[12];
    sum[2] = sum[2] + factor[11] * point[13] + point[5] * factor[12];
    sum[3] = sum[3] + factor[11] * point[14] + point[6] * factor[12];
    sum[4] = sum[4] + factor[3] * factor[16];
    sum[5] = sum[5] + factor[2] * factor[16] + factor[3] * factor[15];
    sum[6] = sum[6] + factor[2] * factor[17] + factor[4] * factor[15];
    sum[7] = sum[7] + factor[3] * factor[17] + factor[4] * factor[16];
    sum[8] = sum[8] + factor[4] * factor[17];
    sum[9] = sum[9] + factor[0] * factor[17] + factor[4] * factor[13];
    sum[10] = sum[10] + factor[0] * factor[18] + factor[5] * factor[13];
    sum[11] = sum[11] + factor[2] * factor[18] + factor[5] * factor[15];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_2_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[19] + factor[6] * factor[13];
    sum[1] = sum[1] + factor[6] * factor[19];
    sum[2] = sum[2] + factor[1] * factor[19] + factor[6] * factor[14];
    sum[3] = sum[3] + factor[1] * factor[17] + factor[4] * factor[14];
    sum[4] = sum[4] + factor[4] * factor[19] + factor[6] * factor[17];
    sum[5] = sum[5] + factor[1] * factor[18] + factor[5] * factor[14];
    sum[6] = sum[6] + factor[4] * factor[18] + factor[5] * factor[17];
    sum[7] = sum[7] + factor[5] * factor[18];
    sum[8] = sum[8] + factor[5] * factor[19] + factor[6] * factor[18];
    sum[9] = sum[9] + factor[2] * factor[19] + factor[6] * factor[15];
    sum[10] = sum[10] + factor[3] * factor[18] + factor[5] * factor[16];
    sum[11] = sum[11] + factor[3] * factor[19] + factor[6] * factor[16];
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, const vector_f *sums, vector_f *mu_bar, vector_f *W_bar, vector_f *amplitude_bar) {
    const vector_f mu3 = mu[3];
    const vector_f mu4 = mu[4];
    const vector_f mu5 = mu[5];
    const vector_f mu6 = mu[6];
    const vector_f W0_0 = W[0];
    const vector_f W0_1 = W[1];
    const vector_f W0_2 = W[2];
    const vector_f W0_3 = W[3];
    const vector_f W0_4 = W[4];
    const vector_f W0_5 = W[5];
    const vector_f W1_0 = W[6];
    const vector_f W1_1 = W[7];
    const vector_f W1_2 = W[8];
    const vector_f W1_3 = W[9];
    const vector_f W1_4 = W[10];
    const vector_f W1_5 = W[11];
    const vector_f W2_0 = W[12];
    const vector_f W2_1 = W[13];
    const vector_f W2_2 = W[14];
    const vector_f W2_3 = W[15];
    const vector_f W2_4 = W[16];
    const vector_f W2_5 = W[17];
    const vector_f W3_0 = W[18];
    const vector_f W3_1 = W[19];
    const vector_f W3_2 = W[20];
    const vector_f W3_3 = W[21];
    const vector_f W3_4 = W[22];
    const vector_f W3_5 = W[23];
    const vector_f W4_0 = W[24];
    const vector_f W4_1 = W[25];
    const vector_f W4_2 = W[26];
    const vector_f W4_3 = W[27];
    const vector_f W4_4 = W[28];
    const vector_f W4_5 = W[29];
    const vector_f W5_0 = W[30];
    const vector_f W5_1 = W[31];
    const vector_f W5_2 = W[32];
    const vector_f W5_3 = W[33];
    const vector_f W5_4 = W[34];
    const vector_f W5_5 = W[35];
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
    const vector_f sum16 = sums[16];
    const vector_f sum17 = sums[17];
    const vector_f sum18 = sums[18];
    const vector_f sum19 = sums[19];
    const vector_f sum20 = sums[20];
    const vector_f sum21 = sums[21];
    const vector_f sum22 = sums[22];
    const vector_f sum23 = sums[23];
    const vector_f sum24 = sums[24];
    const vector_f sum25 = sums[25];
    const vector_f sum26 = sums[26];
    const vector_f sum27 = sums[27];
    const vector_f sum28 = sums[28];
    const vector_f sum29 = sums[29];
    const vector_f sum30 = sums[30];
    const vector_f sum31 = sums[31];
    const vector_f sum32 = sums[32];
    const vector_f sum33 = sums[33];
    const vector_f sum34 = sums[34];
    const vector_f sum35 = sums[35];
    const vector_f product = 2.0f * mu6;
    const vector_f product_2 = 2.0f * mu5;
    const vector_f product_3 = 2.0f * mu4;
    const vector_f rotation_R5_0 = -(W5_5 * product) - W5_4 * product_2 - W5_3 * product_3;
    const vector_f product_4 = 2.0f * mu3;
    const vector_f rotation_R5_1 = W5_5 * product_2 - W5_4 * product + W5_3 * product_4;
    const vector_f product_5 = 2.0f * sum30;
    const vector_f total_2 = W5_0 * sum15 + W5_1 * sum19 + W5_2 * sum23 + rotation_R5_0 * sum27 +
        rotation_R5_1 * product_5;
    const vector_f rotation_R5_2 = W5_4 * product_4 - W5_5 * product_3 + W5_3 * product;
    const vector_f rotation_R5_3 = W5_5 * product_4 + W5_4 * product_3 - W5_3 * product_2;
    const vector_f by_rotation_R5_1 = total_2 + rotation_R5_2 * sum31 + rotation_R5_3 * sum32;
    const vector_f rotation_R4_0 = -(W4_5 * product) - W4_4 * product_2 - W4_3 * product_3;
    const vector_f rotation_R4_1 = W4_5 * product_2 - W4_4 * product + W4_3 * product_4;
    const vector_f total_3 = W4_0 * sum15 + W4_1 * sum19 + W4_2 * sum23 + rotation_R4_0 * sum27 +
        rotation_R4_1 * product_5;
    const vector_f rotation_R4_2 = W4_4 * product_4 - W4_5 * product_3 + W4_3 * product;
    const vector_f rotation_R4_3 = W4_5 * product_4 + W4_4 * product_3 - W4_3 * product_2;
    const vector_f by_rotation_R4_1 = total_3 + rotation_R4_2 * sum31 + rotation_R4_3 * sum32;
    const vector_f rotation_R3_0 = -(W3_5 * product) - W3_4 * product_2 - W3_3 * product_3;
    const vector_f rotation_R3_1 = W3_5 * product_2 - W3_4 * product + W3_3 * product_4;
    const vector_f total_4 = W3_0 * sum15 + W3_1 * sum19 + W3_2 * sum23 + rotation_R3_0 * sum27 +
        rotation_R3_1 * product_5;
    const vector_f rotation_R3_2 = W3_4 * product_4 - W3_5 * product_3 + W3_3 * product;
    const vector_f rotation_R3_3 = W3_5 * product_4 + W3_4 * product_3 - W3_3 * product_2;
    const vector_f by_rotation_R3_1 = total_4 + rotation_R3_2 * sum31 + rotation_R3_3 * sum32;
    const vector_f rotation_R2_0 = -(W2_5 * product) - W2_4 * product_2 - W2_3 * product_3;
    const vector_f rotation_R2_1 = W2_5 * product_2 - W2_4 * product + W2_3 * product_4;
    const vector_f total_5 = W2_0 * sum15 + W2_1 * sum19 + W2_2 * sum23 + rotation_R2_0 * sum27 +
        rotation_R2_1 * product_5;
    const vector_f rotation_R2_2 = W2_4 * product_4 - W2_5 * product_3 + W2_3 * product;
    const vector_f rotation_R2_3 = W2_5 * product_4 + W2_4 * product_3 - W2_3 * product_2;
    const vector_f by_rotation_R2_1 = total_5 + rotation_R2_2 * sum31 + rotation_R2_3 * sum32;
    const vector_f rotation_R1_0 = -(W1_5 * product) - W1_4 * product_2 - W1_3 * product_3;
    const vector_f rotation_R1_1 = W1_5 * product_2 - W1_4 * product + W1_3 * product_4;
    const vector_f total_6 = W1_0 * sum15 + W1_1 * sum19 + W1_2 * sum23 + rotation_R1_0 * sum27 +
        rotation_R1_1 * product_5;
    const vector_f rotation_R1_2 = W1_4 * product_4 - W1_5 * product_3 + W1_3 * product;
    const vector_f rotation_R1_3 = W1_5 * product_4 + W1_4 * product_3 - W1_3 * product_2;
    const vector_f by_rotation_R1_1 = total_6 + rotation_R1_2 * sum31 + rotation_R1_3 * sum32;
    const vector_f total_7 = W5_3 * by_rotation_R5_1 + W4_3 * by_rotation_R4_1 + W3_3 * by_rotation_R3_1 +
        W2_3 * by_rotation_R2_1 + W1_3 * by_rotation_R1_1;
    const vector_f rotation_R0_0 = -(W0_5 * product) - W0_4 * product_2 - W0_3 * product_3;
    const vector_f rotation_R0_1 = W0_5 * product_2 - W0_4 * product + W0_3 * product_4;
    const vector_f total_8 = W0_0 * sum15 + W0_1 * sum19 + W0_2 * sum23 + rotation_R0_0 * sum27 +
        rotation_R0_1 * product_5;
    const vector_f rotation_R0_2 = W0_4 * product_4 - W0_5 * product_3 + W0_3 * product;
    const vector_f rotation_R0_3 = W0_5 * product_4 + W0_4 * product_3 - W0_3 * product_2;
    const vector_f by_rotation_R0_1 = total_8 + rotation_R0_2 * sum31 + rotation_R0_3 * sum32;
    const vector_f total_9 = W5_0 * sum16 + W5_1 * sum20 + W5_2 * sum24 + rotation_R5_0 * sum28 +
        rotation_R5_1 * sum31;
    const vector_f product_6 = 2.0f * sum33;
    const vector_f by_rotation_R5_2 = total_9 + rotation_R5_2 * product_6 + rotation_R5_3 * sum34;
    const vector_f total_10 = W4_0 * sum16 + W4_1 * sum20 + W4_2 * sum24 + rotation_R4_0 * sum28 +
        rotation_R4_1 * sum31;
    const vector_f by_rotation_R4_2 = total_10 + rotation_R4_2 * product_6 + rotation_R4_3 * sum34;
    const vector_f total_11 = W3_0 * sum16 + W3_1 * sum20 + W3_2 * sum24 + rotation_R3_0 * sum28 +
        rotation_R3_1 * sum31;
    const vector_f by_rotation_R3_2 = total_11 + rotation_R3_2 * product_6 + rotation_R3_3 * sum34;
    const vector_f total_12 = total_7 + W0_3 * by_rotation_R0_1 + W5_4 * by_rotation_R5_2 + W4_4 *
        by_rotation_R4_2 + W3_4 * by_rotation_R3_2;
    const vector_f total_13 = W2_0 * sum16 + W2_1 * sum20 + W2_2 * sum24 + rotation_R2_0 * sum28 +
        rotation_R2_1 * sum31;
    const vector_f by_rotation_R2_2 = total_13 + rotation_R2_2 * product_6 + rotation_R2_3 * sum34;
    const vector_f total_14 = W1_0 * sum16 + W1_1 * sum20 + W1_2 * sum24 + rotation_R1_0 * sum28 +
        rotation_R1_1 * sum31;
    const vector_f by_rotation_R1_2 = total_14 + rotation_R1_2 * product_6 + rotation_R1_3 * sum34;
    const vector_f total_15 = W0_0 * sum16 + W0_1 * sum20 + W0_2 * sum24 + rotation_R0_0 * sum28 +
        rotation_R0_1 * sum31;
    const vector_f by_rotation_R0_2 = total_15 + rotation_R0_2 * product_6 + rotation_R0_3 * sum34;
    const vector_f total_16 = W5_0 * sum17 + W5_1 * sum21 + W5_2 * sum25 + rotation_R5_0 * sum29 +
        rotation_R5_1 * sum32;
    const vector_f product_7 = 2.0f * sum35;
    const vector_f by_rotation_R5_3 = total_16 + rotation_R5_2 * sum34 + rotation_R5_3 * product_7;
    const vector_f total_17 = total_12 + W2_4 * by_rotation_R2_2 + W1_4 * by_rotation_R1_2 + W0_4 *
        by_rotation_R0_2 + W5_5 * by_rotation_R5_3;
    const vector_f total_18 = W4_0 * sum17 + W4_1 * sum21 + W4_2 * sum25 + rotation_R4_0 * sum29 +
        rotation_R4_1 * sum32;
    const vector_f by_rotation_R4_3 = total_18 + rotation_R4_2 * sum34 + rotation_R4_3 * product_7;
    const vector_f total_19 = W3_0 * sum17 + W3_1 * sum21 + W3_2 * sum25 + rotation_R3_0 * sum29 +
        rotation_R3_1 * sum32;
    const vector_f by_rotation_R3_3 = total_19 + rotation_R3_2 * sum34 + rotation_R3_3 * product_7;
    const vector_f total_20 = W2_0 * sum17 + W2_1 * sum21 + W2_2 * sum25 + rotation_R2_0 * sum29 +
        rotation_R2_1 * sum32;
    const vector_f by_rotation_R2_3 = total_20 + rotation_R2_2 * sum34 + rotation_R2_3 * product_7;
    const vector_f total_21 = W1_0 * sum17 + W1_1 * sum21 + W1_2 * sum25 + rotation_R1_0 * sum29 +
        rotation_R1_1 * sum32;
    const vector_f by_rotation_R1_3 = total_21 + rotation_R1_2 * sum34 + rotation_R1_3 * product_7;
    const vector_f total_22 = total_17 + W4_5 * by_rotation_R4_3 + W3_5 * by_rotation_R3_3 + W2_5 *
        by_rotation_R2_3 + W1_5 * by_rotation_R1_3;
    const vector_f total_23 = W0_0 * sum17 + W0_1 * sum21 + W0_2 * sum25 + rotation_R0_0 * sum29 +
        rotation_R0_1 * sum32;
    const vector_f by_rotation_R0_3 = total_23 + rotation_R0_2 * sum34 + rotation_R0_3 * product_7;
    const vector_f product_8 = its_amplitude * (sum3 + 2.0f * (total_22 + W0_5 * by_rotation_R0_3));
    const vector_f product_9 = 2.0f * sum26;
    const vector_f total_24 = W5_0 * sum14 + W5_1 * sum18 + W5_2 * sum22 + rotation_R5_0 * product_9 +
        rotation_R5_1 * sum27;
    const vector_f by_rotation_R5_0 = total_24 + rotation_R5_2 * sum28 + rotation_R5_3 * sum29;
    const vector_f total_25 = W4_0 * sum14 + W4_1 * sum18 + W4_2 * sum22 + rotation_R4_0 * product_9 +
        rotation_R4_1 * sum27;
    const vector_f by_rotation_R4_0 = total_25 + rotation_R4_2 * sum28 + rotation_R4_3 * sum29;
    const vector_f total_26 = W3_0 * sum14 + W3_1 * sum18 + W3_2 * sum22 + rotation_R3_0 * product_9 +
        rotation_R3_1 * sum27;
    const vector_f by_rotation_R3_0 = total_26 + rotation_R3_2 * sum28 + rotation_R3_3 * sum29;
    const vector_f total_27 = W2_0 * sum14 + W2_1 * sum18 + W2_2 * sum22 + rotation_R2_0 * product_9 +
        rotation_R2_1 * sum27;
    const vector_f by_rotation_R2_0 = total_27 + rotation_R2_2 * sum28 + rotation_R2_3 * sum29;
    const vector_f gap = -(W5_3 * by_rotation_R5_0) - W4_3 * by_rotation_R4_0 - W3_3 * by_rotation_R3_0 - W2_3
        * by_rotation_R2_0;
    const vector_f total_28 = W1_0 * sum14 + W1_1 * sum18 + W1_2 * sum22 + rotation_R1_0 * product_9 +
        rotation_R1_1 * sum27;
    const vector_f by_rotation_R1_0 = total_28 + rotation_R1_2 * sum28 + rotation_R1_3 * sum29;
    const vector_f total_29 = W0_0 * sum14 + W0_1 * sum18 + W0_2 * sum22 + rotation_R0_0 * product_9 +
        rotation_R0_1 * sum27;
    const vector_f by_rotation_R0_0 = total_29 + rotation_R0_2 * sum28 + rotation_R0_3 * sum29;
    const vector_f gap_2 = gap - W1_3 * by_rotation_R1_0 - W0_3 * by_rotation_R0_0 - W5_5 * by_rotation_R5_2 -
        W4_5 * by_rotation_R4_2;
    const vector_f gap_3 = gap_2 - W3_5 * by_rotation_R3_2 - W2_5 * by_rotation_R2_2 - W1_5 * by_rotation_R1_2
        - W0_5 * by_rotation_R0_2;
    const vector_f total_30 = gap_3 + W5_4 * by_rotation_R5_3 + W4_4 * by_rotation_R4_3 + W3_4 *
        by_rotation_R3_3 + W2_4 * by_rotation_R2_3;
    const vector_f total_31 = sum4 + 2.0f * (total_30 + W1_4 * by_rotation_R1_3 + W0_4 * by_rotation_R0_3);
    const vector_f gap_4 = -(W5_4 * by_rotation_R5_0) - W4_4 * by_rotation_R4_0 - W3_4 * by_rotation_R3_0 -
        W2_4 * by_rotation_R2_0;
    const vector_f total_32 = gap_4 - W1_4 * by_rotation_R1_0 - W0_4 * by_rotation_R0_0 + W5_5 *
        by_rotation_R5_1 + W4_5 * by_rotation_R4_1;
    const vector_f total_33 = total_32 + W3_5 * by_rotation_R3_1 + W2_5 * by_rotation_R2_1 + W1_5 *
        by_rotation_R1_1 + W0_5 * by_rotation_R0_1;
    const vector_f gap_5 = total_33 - W5_3 * by_rotation_R5_3 - W4_3 * by_rotation_R4_3 - W3_3 *
        by_rotation_R3_3 - W2_3 * by_rotation_R2_3;
    const vector_f total_34 = sum5 + 2.0f * (gap_5 - W1_3 * by_rotation_R1_3 - W0_3 * by_rotation_R0_3);
    const vector_f gap_6 = -(W5_5 * by_rotation_R5_0) - W4_5 * by_rotation_R4_0 - W3_5 * by_rotation_R3_0 -
        W2_5 * by_rotation_R2_0;
    const vector_f gap_7 = gap_6 - W1_5 * by_rotation_R1_0 - W0_5 * by_rotation_R0_0 - W5_4 * by_rotation_R5_1
        - W4_4 * by_rotation_R4_1;
    const vector_f gap_8 = gap_7 - W3_4 * by_rotation_R3_1 - W2_4 * by_rotation_R2_1 - W1_4 * by_rotation_R1_1
        - W0_4 * by_rotation_R0_1;
    const vector_f total_35 = gap_8 + W5_3 * by_rotation_R5_2 + W4_3 * by_rotation_R4_2 + W3_3 *
        by_rotation_R3_2 + W2_3 * by_rotation_R2_2;
    const vector_f total_36 = sum6 + 2.0f * (total_35 + W1_3 * by_rotation_R1_2 + W0_3 * by_rotation_R0_2);
    const vector_f product_10 = 2.0f * sum8;
    const vector_f total_37 = W0_0 * product_10 + W0_1 * sum9 + W0_2 * sum10 + rotation_R0_0 * sum14 +
        rotation_R0_1 * sum15;
    const vector_f product_11 = 2.0f * sum11;
    const vector_f total_38 = W0_0 * sum9 + W0_1 * product_11 + W0_2 * sum12 + rotation_R0_0 * sum18 +
        rotation_R0_1 * sum19;
    const vector_f product_12 = 2.0f * sum13;
    const vector_f total_39 = W0_0 * sum10 + W0_1 * sum12 + W0_2 * product_12 + rotation_R0_0 * sum22 +
        rotation_R0_1 * sum23;
    const vector_f product_13 = its_amplitude * (product_4 * by_rotation_R0_1 - product_3 * by_rotation_R0_0 +
        product * by_rotation_R0_2 - product_2 * by_rotation_R0_3);
    const vector_f total_40 = -(product_2 * by_rotation_R0_0) - product * by_rotation_R0_1 + product_4 *
        by_rotation_R0_2 + product_3 * by_rotation_R0_3;
    const vector_f product_14 = its_amplitude * (product_2 * by_rotation_R0_1 - product * by_rotation_R0_0 -
        product_3 * by_rotation_R0_2 + product_4 * by_rotation_R0_3);
    const vector_f total_41 = W1_0 * product_10 + W1_1 * sum9 + W1_2 * sum10 + rotation_R1_0 * sum14 +
        rotation_R1_1 * sum15;
    const vector_f total_42 = W1_0 * sum9 + W1_1 * product_11 + W1_2 * sum12 + rotation_R1_0 * sum18 +
        rotation_R1_1 * sum19;
    const vector_f total_43 = W1_0 * sum10 + W1_1 * sum12 + W1_2 * product_12 + rotation_R1_0 * sum22 +
        rotation_R1_1 * sum23;
    const vector_f product_15 = its_amplitude * (product_4 * by_rotation_R1_1 - product_3 * by_rotation_R1_0 +
        product * by_rotation_R1_2 - product_2 * by_rotation_R1_3);
    const vector_f total_44 = -(product_2 * by_rotation_R1_0) - product * by_rotation_R1_1 + product_4 *
        by_rotation_R1_2 + product_3 * by_rotation_R1_3;
    const vector_f product_16 = its_amplitude * (product_2 * by_rotation_R1_1 - product * by_rotation_R1_0 -
        product_3 * by_rotation_R1_2 + product_4 * by_rotation_R1_3);
    const vector_f total_45 = W2_0 * product_10 + W2_1 * sum9 + W2_2 * sum10 + rotation_R2_0 * sum14 +
        rotation_R2_1 * sum15;
    const vector_f total_46 = W2_0 * sum9 + W2_1 * product_11 + W2_2 * sum12 + rotation_R2_0 * sum18 +
        rotation_R2_1 * sum19;
    const vector_f total_47 = W2_0 * sum10 + W2_1 * sum12 + W2_2 * product_12 + rotation_R2_0 * sum22 +
        rotation_R2_1 * sum23;
    const vector_f product_17 = its_amplitude * (product_4 * by_rotation_R2_1 - product_3 * by_rotation_R2_0 +
        product * by_rotation_R2_2 - product_2 * by_rotation_R2_3);
    const vector_f total_48 = -(product_2 * by_rotation_R2_0) - product * by_rotation_R2_1 + product_4 *
        by_rotation_R2_2 + product_3 * by_rotation_R2_3;
    const vector_f product_18 = its_amplitude * (product_2 * by_rotation_R2_1 - product * by_rotation_R2_0 -
        product_3 * by_rotation_R2_2 + product_4 * by_rotation_R2_3);
    const vector_f total_49 = W3_0 * product_10 + W3_1 * sum9 + W3_2 * sum10 + rotation_R3_0 * sum14 +
        rotation_R3_1 * sum15;
    const vector_f total_50 = W3_0 * sum9 + W3_1 * product_11 + W3_2 * sum12 + rotation_R3_0 * sum18 +
        rotation_R3_1 * sum19;
    const vector_f total_51 = W3_0 * sum10 + W3_1 * sum12 + W3_2 * product_12 + rotation_R3_0 * sum22 +
        rotation_R3_1 * sum23;
    const vector_f product_19 = its_amplitude * (product_4 * by_rotation_R3_1 - product_3 * by_rotation_R3_0 +
        product * by_rotation_R3_2 - product_2 * by_rotation_R3_3);
    const vector_f total_52 = -(product_2 * by_rotation_R3_0) - product * by_rotation_R3_1 + product_4 *
        by_rotation_R3_2 + product_3 * by_rotation_R3_3;
    const vector_f product_20 = its_amplitude * (product_2 * by_rotation_R3_1 - product * by_rotation_R3_0 -
        product_3 * by_rotation_R3_2 + product_4 * by_rotation_R3_3);
    const vector_f total_53 = W4_0 * product_10 + W4_1 * sum9 + W4_2 * sum10 + rotation_R4_0 * sum14 +
        rotation_R4_1 * sum15;
    const vector_f total_54 = W4_0 * sum9 + W4_1 * product_11 + W4_2 * sum12 + rotation_R4_0 * sum18 +
        rotation_R4_1 * sum19;
    const vector_f total_55 = W4_0 * sum10 + W4_1 * sum12 + W4_2 * product_12 + rotation_R4_0 * sum22 +
        rotation_R4_1 * sum23;
    const vector_f product_21 = its_amplitude * (product_4 * by_rotation_R4_1 - product_3 * by_rotation_R4_0 +
        product * by_rotation_R4_2 - product_2 * by_rotation_R4_3);
    const vector_f total_56 = -(product_2 * by_rotation_R4_0) - product * by_rotation_R4_1 + product_4 *
        by_rotation_R4_2 + product_3 * by_rotation_R4_3;
    const vector_f product_22 = its_amplitude * (product_2 * by_rotation_R4_1 - product * by_rotation_R4_0 -
        product_3 * by_rotation_R4_2 + product_4 * by_rotation_R4_3);
    const vector_f total_57 = W5_0 * product_10 + W5_1 * sum9 + W5_2 * sum10 + rotation_R5_0 * sum14 +
        rotation_R5_1 * sum15;
    const vector_f total_58 = W5_0 * sum9 + W5_1 * product_11 + W5_2 * sum12 + rotation_R5_0 * sum18 +
        rotation_R5_1 * sum19;
    const vector_f total_59 = W5_0 * sum10 + W5_1 * sum12 + W5_2 * product_12 + rotation_R5_0 * sum22 +
        rotation_R5_1 * sum23;
    const vector_f product_23 = its_amplitude * (product_4 * by_rotation_R5_1 - product_3 * by_rotation_R5_0 +
        product * by_rotation_R5_2 - product_2 * by_rotation_R5_3);
    const vector_f total_60 = -(product_2 * by_rotation_R5_0) - product * by_rotation_R5_1 + product_4 *
        by_rotation_R5_2 + product_3 * by_rotation_R5_3;
    const vector_f product_24 = its_amplitude * (product_2 * by_rotation_R5_1 - product * by_rotation_R5_0 -
        product_3 * by_rotation_R5_2 + product_4 * by_rotation_R5_3);
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = its_amplitude * sum1;
    mu_bar[2] = its_amplitude * sum2;
    mu_bar[3] = product_8;
    mu_bar[4] = its_amplitude * total_31;
    mu_bar[5] = its_amplitude * total_34;
    mu_bar[6] = its_amplitude * total_36;
    W_bar[0] = its_amplitude * (total_37 + rotation_R0_2 * sum16 + rotation_R0_3 * sum17);
    W_bar[1] = its_amplitude * (total_38 + rotation_R0_2 * sum20 + rotation_R0_3 * sum21);
    W_bar[2] = its_amplitude * (total_39 + rotation_R0_2 * sum24 + rotation_R0_3 * sum25);
    W_bar[3] = product_13;
    W_bar[4] = its_amplitude * total_40;
    W_bar[5] = product_14;
    W_bar[6] = its_amplitude * (total_41 + rotation_R1_2 * sum16 + rotation_R1_3 * sum17);
    W_bar[7] = its_amplitude * (total_42 + rotation_R1_2 * sum20 + rotation_R1_3 * sum21);
    W_bar[8] = its_amplitude * (total_43 + rotation_R1_2 * sum24 + rotation_R1_3 * sum25);
    W_bar[9] = product_15;
    W_bar[10] = its_amplitude * total_44;
    W_bar[11] = product_16;
    W_bar[12] = its_amplitude * (total_45 + rotation_R2_2 * sum16 + rotation_R2_3 * sum17);
    W_bar[13] = its_amplitude * (total_46 + rotation_R2_2 * sum20 + rotation_R2_3 * sum21);
    W_bar[14] = its_amplitude * (total_47 + rotation_R2_2 * sum24 + rotation_R2_3 * sum25);
    W_bar[15] = product_17;
    W_bar[16] = its_amplitude * total_48;
    W_bar[17] = product_18;
    W_bar[18] = its_amplitude * (total_49 + rotation_R3_2 * sum16 + rotation_R3_3 * sum17);
    W_bar[19] = its_amplitude * (total_50 + rotation_R3_2 * sum20 + rotation_R3_3 * sum21);
    W_bar[20] = its_amplitude * (total_51 + rotation_R3_2 * sum24 + rotation_R3_3 * sum25);
    W_bar[21] = product_19;
    W_bar[22] = its_amplitude * total_52;
    W_bar[23] = product_20;
    W_bar[24] = its_amplitude * (total_53 + rotation_R4_2 * sum16 + rotation_R4_3 * sum17);
    W_bar[25] = its_amplitude * (total_54 + rotation_R4_2 * sum20 + rotation_R4_3 * sum21);
    W_bar[26] = its_amplitude * (total_55 + rotation_R4_2 * sum24 + rotation_R4_3 * sum25);
    W_bar[27] = product_21;
    W_bar[28] = its_amplitude * total_56;
    W_bar[29] = product_22;
    W_bar[30] = its_amplitude * (total_57 + rotation_R5_2 * sum16 + rotation_R5_3 * sum17);
    W_bar[31] = its_amplitude * (total_58 + rotation_R5_2 * sum20 + rotation_R5_3 * sum21);
    W_bar[32] = its_amplitude * (total_59 + rotation_R5_2 * sum24 + rotation_R5_3 * sum25);
    W_bar[33] = product_23;
    W_bar[34] = its_amplitude * total_60;
    W_bar[35] = product_24;
    amplitude_bar[0] = sum7;
}

/* The distances of some points q from one point p. */
OUTLINE void pair_distances_f(
    const float *p, const vector_f *q, vector_f *distance) {
    const float p0 = p[0];
    const float p1 = p[1];
    const float p2 = p[2];
    const float p3 = p[3];
    const float p4 = p[4];
    const float p5 = p[5];
    const float p6 = p[6];
    const vector_f q0 = q[0];
    const vector_f q1 = q[1];
    const vector_f q2 = q[2];
    const vector_f q3 = q[3];
    const vector_f q4 = q[4];
    const vector_f q5 = q[5];
    const vector_f q6 = q[6];
    const vector_f position_log0 = q0 - p0;
    const vector_f position_log1 = q1 - p1;
    const vector_f position_log2 = q2 - p2;
    const vector_f rotation_g0 = p3 * q3 + p4 * q4 + p5 * q5 + p6 * q6;
    const vector_f rotation_g1 = p3 * q4 + p6 * q5 - p4 * q3 - p5 * q6;
    const vector_f rotation_g2 = p3 * q5 + p4 * q6 - p5 * q3 - p6 * q4;
    const vector_f rotation_g3 = p3 * q6 + p5 * q4 - p4 * q5 - p6 * q3;
    const vector_f rotation_norm_s_squared = rotation_g1 * rotation_g1 + rotation_g2 * rotation_g2 +
        rotation_g3 * rotation_g3;
    const vector_f rotation_norm_s = sqrt_each_f(rotation_norm_s_squared);
    const vector_f rotation_abs_g0 = abs_each_f(rotation_g0);
    const vector_f rotation_atan2_norm_s_abs_g0 = atan2_each_f(rotation_norm_s, rotation_abs_g0);
    const vector_f rotation_t = 2.0f * rotation_atan2_norm_s_abs_g0;
    const vector_f length = sqrt_each_f(position_log0 * position_log0 + position_log1 * position_log1 +
        position_log2 * position_log2 + rotation_t * rotation_t);
    distance[0] = length;
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

/* Scratch memory: 15 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t se3_splats_work_f(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES_f - 1) / LANES_f, blocks = (points + 2 - 1) / 2;
    const size_t places = 8 * ((splat_count + LANES_f - 1) / LANES_f + (blocks + LANES_f - 1) / LANES_f);
    return (points * 15 + places + 1) * LANES_f + 78 * splat_count;
}

static vector_f *work_points_f(float *work) {
    const uintptr_t size = sizeof(vector_f), start = (uintptr_t)work;
    return (vector_f *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const float *splat_at_f(const vector_f *splats, size_t k) {
    const size_t row = k / LANES_f;
    return (const float *)(splats + 8 * row) + (k - row * LANES_f);
}

static vector_f *work_reaches_f(float *work, size_t count) {
    return work_points_f(work) + (count + LANES_f - 1) / LANES_f * 15;
}

static vector_f *work_blocks_f(float *work, size_t count, size_t splat_count) {
    return work_reaches_f(work, count) + 8 * ((splat_count + LANES_f - 1) / LANES_f);
}

static float *work_constants_f(float *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES_f, blocks = (count + size - 1) / size;
    return (float *)(work_blocks_f(work, count, splat_count) + 8 * ((blocks + LANES_f - 1) / LANES_f));
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
    vector_f *own = splats + start / LANES_f * (7 + 1);
    vector_rows_f(width, splat_count, start, 1, own + 7);
    own[7] = own[7] * 6.516295450218751f + vector_spoilt_f(mu, 7) + vector_spoilt_f(amplitude, 1);
    for (int i = 0; i < 7; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place_f(const float *x, size_t count, size_t start, float *place) {
    const size_t size = count - start < 2 * LANES_f ? count - start : 2 * LANES_f;
    vector_f at[2][7], spoilt = ZERO;
    for (size_t b = 0; b < 2; ++b) {
        vector_rows_f(x, count, start + b * LANES_f, 7, at[b]);
        spoilt += vector_spoilt_f(at[b], 7);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const float *middle = x + 7 * (start + i * size / 8);
        float radius = 0, column[LANES_f];
        for (size_t b = 0; b < 2; ++b) {
            vector_f distance[1];
            pair_distances_f(middle, at[b], distance);
            vector_store_f(column, distance[0]);
            for (size_t lane = 0; lane < LANES_f; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[7]) {
            for (int j = 0; j < 7; ++j) place[j] = middle[j];
            place[7] = radius;
        }
    }
    place[7] = place[7] * 1.0078125f + vector_sum_f(spoilt);
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
        const vector_f *own = splats + start / LANES_f * (7 + 1);
        vector_f distance[1];
        pair_distances_f(place, own, distance);
        const vector_mask_f far = vector_far_f(distance[0], own[7], vector_of_f(place[7]));
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
        const vector_f *own = blocks + start / group * (7 + 1);
        vector_f distance[1];
        pair_distances_f(mu, own, distance);
        const vector_mask_f far = vector_far_f(distance[0], vector_of_f(*reach), own[7]);
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
    vector_f own_mu[7], own_W[36], own_amplitude[1], S[78];
    vector_rows_f(mu, splat_count, start, 7, own_mu);
    vector_rows_f(W, splat_count, start, 36, own_W);
    vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants_f(own_mu, own_W, own_amplitude, S);
    vector_to_rows_f(S, constants, splat_count, start, 78, 78);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void se3_splats_f(
    size_t count, size_t splat_count, const float *SE3_RESTRICT x, const float *SE3_RESTRICT mu, const float *SE3_RESTRICT W, const float *SE3_RESTRICT amplitude, const float *SE3_RESTRICT width,
    float *SE3_RESTRICT value, float *SE3_RESTRICT gradient, float *SE3_RESTRICT work, int threads) {
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
            vector_f at[2][7], X[2 * 7], grad[6];
            vector_f value_sum[2] = {ZERO}, slope_sum[2 * 7] = {ZERO};
            float place[7 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 7, at[b]);
                pair_features_f(at[b], X + 7 * b);
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
                pair_gradient_f(at[b], slope_sum + 7 * b, grad);
                vector_to_rows_f(value_sum + b, value, count, start + b * LANES_f, 1, 1);
                vector_to_rows_f(grad, gradient, count, start + b * LANES_f, 6, 6);
            }
        }
        restore_denormals(mode);
    }
}

void se3_splats_value_f(
    size_t count, size_t splat_count, const float *SE3_RESTRICT x, const float *SE3_RESTRICT mu, const float *SE3_RESTRICT W, const float *SE3_RESTRICT amplitude, const float *SE3_RESTRICT width,
    float *SE3_RESTRICT value, float *SE3_RESTRICT work, int threads) {
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
            vector_f at[7], X[2 * 7], value_sum[2] = {ZERO};
            float place[7 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 7, at);
                pair_features_f(at, X + 7 * b);
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
    vector_f at[7], grad_bar[6], slope_bar[7];
    vector_rows_f(x, count, start, 7, at);
    vector_rows_f(gradient_bar, count, start, 6, grad_bar);
    vector_rows_f(value_bar, count, start, 1, point + 7);
    pair_features_f(at, point);
    pair_gradient_vjp_f(at, grad_bar, slope_bar);
    for (int i = 0; i < 7; ++i) point[7 + 1 + i] = slope_bar[i];
    vector_end_f(count, start, 7 + 1, point + 7);
}

/* Adds what makes the derivatives, of a splat at some vectors of points: their factors, then the products of these. */
INLINE void pair_backward_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *sums) {
    vector_f factor[16 * 20];
    pair_factors_f(count, points, near, S, factor);
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_0_f(factor + 20 * i, points + 15 * (size_t)near[i], sum);
        sums[0] += sum[0];
        sums[1] += sum[1];
        sums[2] += sum[2];
        sums[7] += sum[3];
        sums[8] += sum[4];
        sums[9] += sum[5];
        sums[11] += sum[6];
        sums[10] += sum[7];
        sums[12] += sum[8];
        sums[13] += sum[9];
        sums[14] += sum[10];
        sums[18] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_1_f(factor + 20 * i, points + 15 * (size_t)near[i], sum);
        sums[3] += sum[0];
        sums[4] += sum[1];
        sums[5] += sum[2];
        sums[6] += sum[3];
        sums[26] += sum[4];
        sums[22] += sum[5];
        sums[23] += sum[6];
        sums[27] += sum[7];
        sums[30] += sum[8];
        sums[15] += sum[9];
        sums[16] += sum[10];
        sums[24] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_2_f(factor + 20 * i, points + 15 * (size_t)near[i], sum);
        sums[17] += sum[0];
        sums[35] += sum[1];
        sums[21] += sum[2];
        sums[19] += sum[3];
        sums[32] += sum[4];
        sums[20] += sum[5];
        sums[31] += sum[6];
        sums[33] += sum[7];
        sums[34] += sum[8];
        sums[25] += sum[9];
        sums[28] += sum[10];
        sums[29] += sum[11];
    }
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums_f(const vector_f *points, const uint32_t *near, size_t size, const float *S, float *sums) {
    vector_f sum[36] = {ZERO};
    for (size_t b = 0; b < size; b += 16)
        pair_backward_f(size - b < 16 ? size - b : 16, points, near + b, S, sum);
    for (size_t i = 0; i < 36; ++i) sums[i] += vector_sum_f(sum[i]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void se3_splats_vjp_f(
    size_t count, size_t splat_count, const float *SE3_RESTRICT x, const float *SE3_RESTRICT mu, const float *SE3_RESTRICT W, const float *SE3_RESTRICT amplitude, const float *SE3_RESTRICT width, const float *SE3_RESTRICT value_bar, const float *SE3_RESTRICT gradient_bar,
    float *SE3_RESTRICT mu_bar, float *SE3_RESTRICT W_bar, float *SE3_RESTRICT amplitude_bar, float *SE3_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES_f - 1) / LANES_f;
    const size_t chunk = 131072 / (15 * sizeof(vector_f)) + 1;
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
                float place[7 + 1];
                const size_t last = (blocks - 1) / 2, start = (block < last ? block : last) * 2;
                block_place_f(x, count, start * LANES_f, place);
                for (int i = 0; i < 8; ++i) {
                    float *row = (float *)(places + block / LANES_f * 8 + i);
                    row[block - block / LANES_f * LANES_f] = place[i];
                }
            }
        }
        OMP(omp for schedule(dynamic, 8))
        for (size_t block = 0; block < blocks; ++block)
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, points + 15 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            float sums[LANES_f][36] = {{0}};
            uint32_t near[131072 / (15 * sizeof(vector_f)) + 2];
            vector_f own_mu[7], own_W[36], own_amplitude[1], own_sums[36], bars[44];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const float *reach = width ? splat_at_f(splats, k) + 7 * LANES_f : NULL;
                    const size_t some = blocks_near_f(mu + 7 * k, reach, places, first, first + size, near);
                    splat_sums_f(points + 15 * first, near, some, constants + 78 * k, sums[k - start]);
                }
            }
            vector_rows_f(mu, end, start, 7, own_mu);
            vector_rows_f(W, end, start, 36, own_W);
            vector_rows_f(amplitude, end, start, 1, own_amplitude);
            vector_rows_f(sums[0], LANES_f, 0, 36, own_sums);
            pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 7, bars + 7 + 36);
            vector_to_rows_f(bars, mu_bar, end, start, 7, 7);
            vector_to_rows_f(bars + 7, W_bar, end, start, 36, 36);
            vector_to_rows_f(bars + 7 + 36, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void se3_splats_rows_f(
    size_t count, size_t splat_count, const float *SE3_RESTRICT x, const float *SE3_RESTRICT mu, const float *SE3_RESTRICT W, const float *SE3_RESTRICT amplitude, const float *SE3_RESTRICT value_bar, const float *SE3_RESTRICT gradient_bar,
    float *SE3_RESTRICT rows, float *SE3_RESTRICT work, int threads) {
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
            vector_f point[15];
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector_f own_mu[7], own_W[36], own_amplitude[1], own_sums[36] = {ZERO}, bars[44];
                for (int i = 0; i < 7; ++i) own_mu[i] = vector_of_f(mu[7 * k + i]);
                for (int i = 0; i < 36; ++i) own_W[i] = vector_of_f(W[36 * k + i]);
                own_amplitude[0] = vector_of_f(amplitude[k]);
                pair_backward_f(1, point, &only, constants + 78 * k, own_sums);
                pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 7, bars + 7 + 36);
                vector_to_rows_f(bars, rows + 44 * k, count, block * LANES_f, 44, 44 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

/* A coordinate to sort by. */
INLINE float order_key_f(const float *x, size_t row, size_t axis) {
    const float key = x[7 * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest_f(const float *x, const size_t *order, size_t count) {
    float low[7], high[7];
    size_t widest = 0;
    for (size_t axis = 0; axis < 7; ++axis) low[axis] = high[axis] = order_key_f(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < 7; ++axis) {
            const float key = order_key_f(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < 7; ++axis)
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

double se3_splats_order_f(
    size_t count, size_t splat_count, const float *SE3_RESTRICT x, const float *SE3_RESTRICT mu, const float *SE3_RESTRICT amplitude, const float *SE3_RESTRICT width,
    double limit, size_t *SE3_RESTRICT order, float *SE3_RESTRICT work) {
    const size_t block = 2 * LANES_f;
    vector_f *splats = work_reaches_f(work, 0);
    uint32_t near[256];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES_f) {
        vector_f own_mu[7], own_amplitude[1];
        vector_rows_f(mu, splat_count, start, 7, own_mu);
        vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks_f(x, order, count, (float *)work_blocks_f(work, 0, splat_count));
        for (size_t i = 1; i < 2 * 16; i += 2) {
            float rows[2 * LANES_f * 7], place[7 + 1];
            const size_t some = i * count / (2 * 16), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < 7; ++j) rows[7 * n + j] = x[7 * order[start + n] + j];
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
