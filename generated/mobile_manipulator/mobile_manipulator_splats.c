/*
 * mobile_manipulator: A mobile base in the plane and an arm of six revolute joints; lengths are those of the
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "mobile_manipulator.h"

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

/* round to even, of numbers below 2^51; of larger ones, a whole number close by. */
INLINE vector round_each(vector x) { return (x + 6755399441055744.0) - 6755399441055744.0; }

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
    const vector W0_3 = W[3];
    const vector W0_4 = W[4];
    const vector W0_5 = W[5];
    const vector W0_6 = W[6];
    const vector W0_7 = W[7];
    const vector W0_8 = W[8];
    const vector W1_0 = W[9];
    const vector W1_1 = W[10];
    const vector W1_2 = W[11];
    const vector W1_3 = W[12];
    const vector W1_4 = W[13];
    const vector W1_5 = W[14];
    const vector W1_6 = W[15];
    const vector W1_7 = W[16];
    const vector W1_8 = W[17];
    const vector W2_0 = W[18];
    const vector W2_1 = W[19];
    const vector W2_2 = W[20];
    const vector W2_3 = W[21];
    const vector W2_4 = W[22];
    const vector W2_5 = W[23];
    const vector W2_6 = W[24];
    const vector W2_7 = W[25];
    const vector W2_8 = W[26];
    const vector W3_0 = W[27];
    const vector W3_1 = W[28];
    const vector W3_2 = W[29];
    const vector W3_3 = W[30];
    const vector W3_4 = W[31];
    const vector W3_5 = W[32];
    const vector W3_6 = W[33];
    const vector W3_7 = W[34];
    const vector W3_8 = W[35];
    const vector W4_0 = W[36];
    const vector W4_1 = W[37];
    const vector W4_2 = W[38];
    const vector W4_3 = W[39];
    const vector W4_4 = W[40];
    const vector W4_5 = W[41];
    const vector W4_6 = W[42];
    const vector W4_7 = W[43];
    const vector W4_8 = W[44];
    const vector W5_0 = W[45];
    const vector W5_1 = W[46];
    const vector W5_2 = W[47];
    const vector W5_3 = W[48];
    const vector W5_4 = W[49];
    const vector W5_5 = W[50];
    const vector W5_6 = W[51];
    const vector W5_7 = W[52];
    const vector W5_8 = W[53];
    const vector W6_0 = W[54];
    const vector W6_1 = W[55];
    const vector W6_2 = W[56];
    const vector W6_3 = W[57];
    const vector W6_4 = W[58];
    const vector W6_5 = W[59];
    const vector W6_6 = W[60];
    const vector W6_7 = W[61];
    const vector W6_8 = W[62];
    const vector W7_0 = W[63];
    const vector W7_1 = W[64];
    const vector W7_2 = W[65];
    const vector W7_3 = W[66];
    const vector W7_4 = W[67];
    const vector W7_5 = W[68];
    const vector W7_6 = W[69];
    const vector W7_7 = W[70];
    const vector W7_8 = W[71];
    const vector W8_0 = W[72];
    const vector W8_1 = W[73];
    const vector W8_2 = W[74];
    const vector W8_3 = W[75];
    const vector W8_4 = W[76];
    const vector W8_5 = W[77];
    const vector W8_6 = W[78];
    const vector W8_7 = W[79];
    const vector W8_8 = W[80];
    const vector its_amplitude = amplitude[0];
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
    S[12] = W0_3;
    S[13] = W0_4;
    S[14] = W0_5;
    S[15] = W0_6;
    S[16] = W0_7;
    S[17] = W0_8;
    S[18] = W1_0;
    S[19] = W1_1;
    S[20] = W1_2;
    S[21] = W1_3;
    S[22] = W1_4;
    S[23] = W1_5;
    S[24] = W1_6;
    S[25] = W1_7;
    S[26] = W1_8;
    S[27] = W2_0;
    S[28] = W2_1;
    S[29] = W2_2;
    S[30] = W2_3;
    S[31] = W2_4;
    S[32] = W2_5;
    S[33] = W2_6;
    S[34] = W2_7;
    S[35] = W2_8;
    S[36] = W3_0;
    S[37] = W3_1;
    S[38] = W3_2;
    S[39] = W3_3;
    S[40] = W3_4;
    S[41] = W3_5;
    S[42] = W3_6;
    S[43] = W3_7;
    S[44] = W3_8;
    S[45] = W4_0;
    S[46] = W4_1;
    S[47] = W4_2;
    S[48] = W4_3;
    S[49] = W4_4;
    S[50] = W4_5;
    S[51] = W4_6;
    S[52] = W4_7;
    S[53] = W4_8;
    S[54] = W5_0;
    S[55] = W5_1;
    S[56] = W5_2;
    S[57] = W5_3;
    S[58] = W5_4;
    S[59] = W5_5;
    S[60] = W5_6;
    S[61] = W5_7;
    S[62] = W5_8;
    S[63] = W6_0;
    S[64] = W6_1;
    S[65] = W6_2;
    S[66] = W6_3;
    S[67] = W6_4;
    S[68] = W6_5;
    S[69] = W6_6;
    S[70] = W6_7;
    S[71] = W6_8;
    S[72] = W7_0;
    S[73] = W7_1;
    S[74] = W7_2;
    S[75] = W7_3;
    S[76] = W7_4;
    S[77] = W7_5;
    S[78] = W7_6;
    S[79] = W7_7;
    S[80] = W7_8;
    S[81] = W8_0;
    S[82] = W8_1;
    S[83] = W8_2;
    S[84] = W8_3;
    S[85] = W8_4;
    S[86] = W8_5;
    S[87] = W8_6;
    S[88] = W8_7;
    S[89] = W8_8;
    S[90] = its_amplitude;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_value(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values) {
    struct { vector phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 91 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double mu7 = S[7];
        const double mu8 = S[8];
        const double W0_0 = S[9];
        const double W0_1 = S[10];
        const double W0_2 = S[11];
        const double W0_3 = S[12];
        const double W0_4 = S[13];
        const double W0_5 = S[14];
        const double W0_6 = S[15];
        const double W0_7 = S[16];
        const double W0_8 = S[17];
        const double W1_0 = S[18];
        const double W1_1 = S[19];
        const double W1_2 = S[20];
        const double W1_3 = S[21];
        const double W1_4 = S[22];
        const double W1_5 = S[23];
        const double W1_6 = S[24];
        const double W1_7 = S[25];
        const double W1_8 = S[26];
        const double W2_0 = S[27];
        const double W2_1 = S[28];
        const double W2_2 = S[29];
        const double W2_3 = S[30];
        const double W2_4 = S[31];
        const double W2_5 = S[32];
        const double W2_6 = S[33];
        const double W2_7 = S[34];
        const double W2_8 = S[35];
        const double W3_0 = S[36];
        const double W3_1 = S[37];
        const double W3_2 = S[38];
        const double W3_3 = S[39];
        const double W3_4 = S[40];
        const double W3_5 = S[41];
        const double W3_6 = S[42];
        const double W3_7 = S[43];
        const double W3_8 = S[44];
        const double W4_0 = S[45];
        const double W4_1 = S[46];
        const double W4_2 = S[47];
        const double W4_3 = S[48];
        const double W4_4 = S[49];
        const double W4_5 = S[50];
        const double W4_6 = S[51];
        const double W4_7 = S[52];
        const double W4_8 = S[53];
        const double W5_0 = S[54];
        const double W5_1 = S[55];
        const double W5_2 = S[56];
        const double W5_3 = S[57];
        const double W5_4 = S[58];
        const double W5_5 = S[59];
        const double W5_6 = S[60];
        const double W5_7 = S[61];
        const double W5_8 = S[62];
        const double W6_0 = S[63];
        const double W6_1 = S[64];
        const double W6_2 = S[65];
        const double W6_3 = S[66];
        const double W6_4 = S[67];
        const double W6_5 = S[68];
        const double W6_6 = S[69];
        const double W6_7 = S[70];
        const double W6_8 = S[71];
        const double W7_0 = S[72];
        const double W7_1 = S[73];
        const double W7_2 = S[74];
        const double W7_3 = S[75];
        const double W7_4 = S[76];
        const double W7_5 = S[77];
        const double W7_6 = S[78];
        const double W7_7 = S[79];
        const double W7_8 = S[80];
        const double W8_0 = S[81];
        const double W8_1 = S[82];
        const double W8_2 = S[83];
        const double W8_3 = S[84];
        const double W8_4 = S[85];
        const double W8_5 = S[86];
        const double W8_6 = S[87];
        const double W8_7 = S[88];
        const double W8_8 = S[89];
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
            const vector v0 = x0 - mu0;
            const vector v1 = x1 - mu1;
            const vector gap = x2 - mu2;
            const vector round_2 = round_each(0.15915494309189535 * gap);
            const vector v2 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
            const vector gap_2 = x3 - mu3;
            const vector round_3 = round_each(0.15915494309189535 * gap_2);
            const vector v3 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
            const vector gap_3 = x4 - mu4;
            const vector round_4 = round_each(0.15915494309189535 * gap_3);
            const vector v4 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
            const vector total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
            const vector gap_4 = x5 - mu5;
            const vector round_5 = round_each(0.15915494309189535 * gap_4);
            const vector v5 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
            const vector gap_5 = x6 - mu6;
            const vector round_6 = round_each(0.15915494309189535 * gap_5);
            const vector v6 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
            const vector gap_6 = x7 - mu7;
            const vector round_7 = round_each(0.15915494309189535 * gap_6);
            const vector v7 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
            const vector gap_7 = x8 - mu8;
            const vector round_8 = round_each(0.15915494309189535 * gap_7);
            const vector v8 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
            const vector z0 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
            const vector total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
            const vector z1 = total_3 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
            const vector total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
            const vector z2 = total_4 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
            const vector total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
            const vector z3 = total_5 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
            const vector total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
            const vector z4 = total_6 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
            const vector total_7 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
            const vector total_8 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
            const vector z5 = total_8 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
            const vector total_9 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
            const vector z6 = total_9 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
            const vector total_10 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
            const vector z7 = total_10 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
            const vector total_11 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
            const vector z8 = total_11 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
            const vector total_12 = total_7 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
            const vector phi = gaussian_each(total_12);
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 91 * near[k];
        const double amplitude = S[90];
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
    struct { vector z0, z1, z2, z3, z4, z5, z6, z7, z8, phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 91 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double mu7 = S[7];
        const double mu8 = S[8];
        const double W0_0 = S[9];
        const double W0_1 = S[10];
        const double W0_2 = S[11];
        const double W0_3 = S[12];
        const double W0_4 = S[13];
        const double W0_5 = S[14];
        const double W0_6 = S[15];
        const double W0_7 = S[16];
        const double W0_8 = S[17];
        const double W1_0 = S[18];
        const double W1_1 = S[19];
        const double W1_2 = S[20];
        const double W1_3 = S[21];
        const double W1_4 = S[22];
        const double W1_5 = S[23];
        const double W1_6 = S[24];
        const double W1_7 = S[25];
        const double W1_8 = S[26];
        const double W2_0 = S[27];
        const double W2_1 = S[28];
        const double W2_2 = S[29];
        const double W2_3 = S[30];
        const double W2_4 = S[31];
        const double W2_5 = S[32];
        const double W2_6 = S[33];
        const double W2_7 = S[34];
        const double W2_8 = S[35];
        const double W3_0 = S[36];
        const double W3_1 = S[37];
        const double W3_2 = S[38];
        const double W3_3 = S[39];
        const double W3_4 = S[40];
        const double W3_5 = S[41];
        const double W3_6 = S[42];
        const double W3_7 = S[43];
        const double W3_8 = S[44];
        const double W4_0 = S[45];
        const double W4_1 = S[46];
        const double W4_2 = S[47];
        const double W4_3 = S[48];
        const double W4_4 = S[49];
        const double W4_5 = S[50];
        const double W4_6 = S[51];
        const double W4_7 = S[52];
        const double W4_8 = S[53];
        const double W5_0 = S[54];
        const double W5_1 = S[55];
        const double W5_2 = S[56];
        const double W5_3 = S[57];
        const double W5_4 = S[58];
        const double W5_5 = S[59];
        const double W5_6 = S[60];
        const double W5_7 = S[61];
        const double W5_8 = S[62];
        const double W6_0 = S[63];
        const double W6_1 = S[64];
        const double W6_2 = S[65];
        const double W6_3 = S[66];
        const double W6_4 = S[67];
        const double W6_5 = S[68];
        const double W6_6 = S[69];
        const double W6_7 = S[70];
        const double W6_8 = S[71];
        const double W7_0 = S[72];
        const double W7_1 = S[73];
        const double W7_2 = S[74];
        const double W7_3 = S[75];
        const double W7_4 = S[76];
        const double W7_5 = S[77];
        const double W7_6 = S[78];
        const double W7_7 = S[79];
        const double W7_8 = S[80];
        const double W8_0 = S[81];
        const double W8_1 = S[82];
        const double W8_2 = S[83];
        const double W8_3 = S[84];
        const double W8_4 = S[85];
        const double W8_5 = S[86];
        const double W8_6 = S[87];
        const double W8_7 = S[88];
        const double W8_8 = S[89];
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
            const vector v0 = x0 - mu0;
            const vector v1 = x1 - mu1;
            const vector gap = x2 - mu2;
            const vector round_2 = round_each(0.15915494309189535 * gap);
            const vector v2 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
            const vector gap_2 = x3 - mu3;
            const vector round_3 = round_each(0.15915494309189535 * gap_2);
            const vector v3 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
            const vector gap_3 = x4 - mu4;
            const vector round_4 = round_each(0.15915494309189535 * gap_3);
            const vector v4 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
            const vector total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
            const vector gap_4 = x5 - mu5;
            const vector round_5 = round_each(0.15915494309189535 * gap_4);
            const vector v5 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
            const vector gap_5 = x6 - mu6;
            const vector round_6 = round_each(0.15915494309189535 * gap_5);
            const vector v6 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
            const vector gap_6 = x7 - mu7;
            const vector round_7 = round_each(0.15915494309189535 * gap_6);
            const vector v7 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
            const vector gap_7 = x8 - mu8;
            const vector round_8 = round_each(0.15915494309189535 * gap_7);
            const vector v8 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
            const vector z0 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
            const vector total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
            const vector z1 = total_3 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
            const vector total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
            const vector z2 = total_4 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
            const vector total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
            const vector z3 = total_5 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
            const vector total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
            const vector z4 = total_6 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
            const vector total_7 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
            const vector total_8 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
            const vector z5 = total_8 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
            const vector total_9 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
            const vector z6 = total_9 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
            const vector total_10 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
            const vector z7 = total_10 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
            const vector total_11 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
            const vector z8 = total_11 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
            const vector total_12 = total_7 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
            const vector phi = gaussian_each(total_12);
            kept[k][b].z0 = z0;
            kept[k][b].z1 = z1;
            kept[k][b].z2 = z2;
            kept[k][b].z3 = z3;
            kept[k][b].z4 = z4;
            kept[k][b].z5 = z5;
            kept[k][b].z6 = z6;
            kept[k][b].z7 = z7;
            kept[k][b].z8 = z8;
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 91 * near[k];
        const double W0_0 = S[9];
        const double W0_1 = S[10];
        const double W0_2 = S[11];
        const double W0_3 = S[12];
        const double W0_4 = S[13];
        const double W0_5 = S[14];
        const double W0_6 = S[15];
        const double W0_7 = S[16];
        const double W0_8 = S[17];
        const double W1_0 = S[18];
        const double W1_1 = S[19];
        const double W1_2 = S[20];
        const double W1_3 = S[21];
        const double W1_4 = S[22];
        const double W1_5 = S[23];
        const double W1_6 = S[24];
        const double W1_7 = S[25];
        const double W1_8 = S[26];
        const double W2_0 = S[27];
        const double W2_1 = S[28];
        const double W2_2 = S[29];
        const double W2_3 = S[30];
        const double W2_4 = S[31];
        const double W2_5 = S[32];
        const double W2_6 = S[33];
        const double W2_7 = S[34];
        const double W2_8 = S[35];
        const double W3_0 = S[36];
        const double W3_1 = S[37];
        const double W3_2 = S[38];
        const double W3_3 = S[39];
        const double W3_4 = S[40];
        const double W3_5 = S[41];
        const double W3_6 = S[42];
        const double W3_7 = S[43];
        const double W3_8 = S[44];
        const double W4_0 = S[45];
        const double W4_1 = S[46];
        const double W4_2 = S[47];
        const double W4_3 = S[48];
        const double W4_4 = S[49];
        const double W4_5 = S[50];
        const double W4_6 = S[51];
        const double W4_7 = S[52];
        const double W4_8 = S[53];
        const double W5_0 = S[54];
        const double W5_1 = S[55];
        const double W5_2 = S[56];
        const double W5_3 = S[57];
        const double W5_4 = S[58];
        const double W5_5 = S[59];
        const double W5_6 = S[60];
        const double W5_7 = S[61];
        const double W5_8 = S[62];
        const double W6_0 = S[63];
        const double W6_1 = S[64];
        const double W6_2 = S[65];
        const double W6_3 = S[66];
        const double W6_4 = S[67];
        const double W6_5 = S[68];
        const double W6_6 = S[69];
        const double W6_7 = S[70];
        const double W6_8 = S[71];
        const double W7_0 = S[72];
        const double W7_1 = S[73];
        const double W7_2 = S[74];
        const double W7_3 = S[75];
        const double W7_4 = S[76];
        const double W7_5 = S[77];
        const double W7_6 = S[78];
        const double W7_7 = S[79];
        const double W7_8 = S[80];
        const double W8_0 = S[81];
        const double W8_1 = S[82];
        const double W8_2 = S[83];
        const double W8_3 = S[84];
        const double W8_4 = S[85];
        const double W8_5 = S[86];
        const double W8_6 = S[87];
        const double W8_7 = S[88];
        const double W8_8 = S[89];
        const double amplitude = S[90];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            vector *slope = slopes + 9 * b;
            const vector z0 = kept[k][b].z0;
            const vector z1 = kept[k][b].z1;
            const vector z2 = kept[k][b].z2;
            const vector z3 = kept[k][b].z3;
            const vector z4 = kept[k][b].z4;
            const vector z5 = kept[k][b].z5;
            const vector z6 = kept[k][b].z6;
            const vector z7 = kept[k][b].z7;
            const vector z8 = kept[k][b].z8;
            const vector phi = kept[k][b].phi;
            const vector phi_2 = amplitude * phi;
            const vector z8_product = z8 * phi_2;
            const vector z7_product = z7 * phi_2;
            const vector z6_product = z6 * phi_2;
            const vector z5_product = z5 * phi_2;
            const vector z4_product = z4 * phi_2;
            const vector z3_product = z3 * phi_2;
            const vector z2_product = z2 * phi_2;
            const vector z1_product = z1 * phi_2;
            const vector z0_product = z0 * phi_2;
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] - W8_0 * z8_product - W7_0 * z7_product - W6_0 * z6_product - W5_0 * z5_product - W4_0
                    * z4_product - W3_0 * z3_product - W2_0 * z2_product - W1_0 * z1_product - W0_0 * z0_product;
            slope[1] = slope[1] - W8_1 * z8_product - W7_1 * z7_product - W6_1 * z6_product - W5_1 * z5_product - W4_1
                    * z4_product - W3_1 * z3_product - W2_1 * z2_product - W1_1 * z1_product - W0_1 * z0_product;
            slope[2] = slope[2] - W8_2 * z8_product - W7_2 * z7_product - W6_2 * z6_product - W5_2 * z5_product - W4_2
                    * z4_product - W3_2 * z3_product - W2_2 * z2_product - W1_2 * z1_product - W0_2 * z0_product;
            slope[3] = slope[3] - W8_3 * z8_product - W7_3 * z7_product - W6_3 * z6_product - W5_3 * z5_product - W4_3
                    * z4_product - W3_3 * z3_product - W2_3 * z2_product - W1_3 * z1_product - W0_3 * z0_product;
            slope[4] = slope[4] - W8_4 * z8_product - W7_4 * z7_product - W6_4 * z6_product - W5_4 * z5_product - W4_4
                    * z4_product - W3_4 * z3_product - W2_4 * z2_product - W1_4 * z1_product - W0_4 * z0_product;
            slope[5] = slope[5] - W8_5 * z8_product - W7_5 * z7_product - W6_5 * z6_product - W5_5 * z5_product - W4_5
                    * z4_product - W3_5 * z3_product - W2_5 * z2_product - W1_5 * z1_product - W0_5 * z0_product;
            slope[6] = slope[6] - W8_6 * z8_product - W7_6 * z7_product - W6_6 * z6_product - W5_6 * z5_product - W4_6
                    * z4_product - W3_6 * z3_product - W2_6 * z2_product - W1_6 * z1_product - W0_6 * z0_product;
            slope[7] = slope[7] - W8_7 * z8_product - W7_7 * z7_product - W6_7 * z6_product - W5_7 * z5_product - W4_7
                    * z4_product - W3_7 * z3_product - W2_7 * z2_product - W1_7 * z1_product - W0_7 * z0_product;
            slope[8] = slope[8] - W8_8 * z8_product - W7_8 * z7_product - W6_8 * z6_product - W5_8 * z5_product - W4_8
                    * z4_product - W3_8 * z3_product - W2_8 * z2_product - W1_8 * z1_product - W0_8 * z0_product;
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient(
    const vector *x, const vector *slope, vector *gradient) {
    (void)x;
    const vector slope_x0 = slope[0];
    const vector slope_x1 = slope[1];
    const vector slope_x2 = slope[2];
    const vector slope_x3 = slope[3];
    const vector slope_x4 = slope[4];
    const vector slope_x5 = slope[5];
    const vector slope_x6 = slope[6];
    const vector slope_x7 = slope[7];
    const vector slope_x8 = slope[8];
    gradient[0] = slope_x0;
    gradient[1] = slope_x1;
    gradient[2] = 4.0 * slope_x2;
    gradient[3] = 16.0 * slope_x3;
    gradient[4] = 16.0 * slope_x4;
    gradient[5] = 16.0 * slope_x5;
    gradient[6] = 16.0 * slope_x6;
    gradient[7] = 16.0 * slope_x7;
    gradient[8] = 16.0 * slope_x8;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp(
    const vector *x, const vector *gradient_bar, vector *slope_bar) {
    (void)x;
    const vector gradient_bar0 = gradient_bar[0];
    const vector gradient_bar1 = gradient_bar[1];
    const vector gradient_bar2 = gradient_bar[2];
    const vector gradient_bar3 = gradient_bar[3];
    const vector gradient_bar4 = gradient_bar[4];
    const vector gradient_bar5 = gradient_bar[5];
    const vector gradient_bar6 = gradient_bar[6];
    const vector gradient_bar7 = gradient_bar[7];
    const vector gradient_bar8 = gradient_bar[8];
    slope_bar[0] = gradient_bar0;
    slope_bar[1] = gradient_bar1;
    slope_bar[2] = 4.0 * gradient_bar2;
    slope_bar[3] = 16.0 * gradient_bar3;
    slope_bar[4] = 16.0 * gradient_bar4;
    slope_bar[5] = 16.0 * gradient_bar5;
    slope_bar[6] = 16.0 * gradient_bar6;
    slope_bar[7] = 16.0 * gradient_bar7;
    slope_bar[8] = 16.0 * gradient_bar8;
}

/*
 * The factors of whose products are what is summed over the points, for some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_factors(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *factors) {
    struct { vector v0, v1, v2, v3, v4, v5, v6, v7, v8, z0, z1, z2, z3, z4, z5, z6, z7, z8, phi; } kept[10];
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
        const double W0_0 = S[9];
        const double W0_1 = S[10];
        const double W0_2 = S[11];
        const double W0_3 = S[12];
        const double W0_4 = S[13];
        const double W0_5 = S[14];
        const double W0_6 = S[15];
        const double W0_7 = S[16];
        const double W0_8 = S[17];
        const double W1_0 = S[18];
        const double W1_1 = S[19];
        const double W1_2 = S[20];
        const double W1_3 = S[21];
        const double W1_4 = S[22];
        const double W1_5 = S[23];
        const double W1_6 = S[24];
        const double W1_7 = S[25];
        const double W1_8 = S[26];
        const double W2_0 = S[27];
        const double W2_1 = S[28];
        const double W2_2 = S[29];
        const double W2_3 = S[30];
        const double W2_4 = S[31];
        const double W2_5 = S[32];
        const double W2_6 = S[33];
        const double W2_7 = S[34];
        const double W2_8 = S[35];
        const double W3_0 = S[36];
        const double W3_1 = S[37];
        const double W3_2 = S[38];
        const double W3_3 = S[39];
        const double W3_4 = S[40];
        const double W3_5 = S[41];
        const double W3_6 = S[42];
        const double W3_7 = S[43];
        const double W3_8 = S[44];
        const double W4_0 = S[45];
        const double W4_1 = S[46];
        const double W4_2 = S[47];
        const double W4_3 = S[48];
        const double W4_4 = S[49];
        const double W4_5 = S[50];
        const double W4_6 = S[51];
        const double W4_7 = S[52];
        const double W4_8 = S[53];
        const double W5_0 = S[54];
        const double W5_1 = S[55];
        const double W5_2 = S[56];
        const double W5_3 = S[57];
        const double W5_4 = S[58];
        const double W5_5 = S[59];
        const double W5_6 = S[60];
        const double W5_7 = S[61];
        const double W5_8 = S[62];
        const double W6_0 = S[63];
        const double W6_1 = S[64];
        const double W6_2 = S[65];
        const double W6_3 = S[66];
        const double W6_4 = S[67];
        const double W6_5 = S[68];
        const double W6_6 = S[69];
        const double W6_7 = S[70];
        const double W6_8 = S[71];
        const double W7_0 = S[72];
        const double W7_1 = S[73];
        const double W7_2 = S[74];
        const double W7_3 = S[75];
        const double W7_4 = S[76];
        const double W7_5 = S[77];
        const double W7_6 = S[78];
        const double W7_7 = S[79];
        const double W7_8 = S[80];
        const double W8_0 = S[81];
        const double W8_1 = S[82];
        const double W8_2 = S[83];
        const double W8_3 = S[84];
        const double W8_4 = S[85];
        const double W8_5 = S[86];
        const double W8_6 = S[87];
        const double W8_7 = S[88];
        const double W8_8 = S[89];
        const vector v0 = x0 - mu0;
        const vector v1 = x1 - mu1;
        const vector gap = x2 - mu2;
        const vector round_2 = round_each(0.15915494309189535 * gap);
        const vector v2 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
        const vector gap_2 = x3 - mu3;
        const vector round_3 = round_each(0.15915494309189535 * gap_2);
        const vector v3 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
        const vector gap_3 = x4 - mu4;
        const vector round_4 = round_each(0.15915494309189535 * gap_3);
        const vector v4 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
        const vector total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
        const vector gap_4 = x5 - mu5;
        const vector round_5 = round_each(0.15915494309189535 * gap_4);
        const vector v5 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
        const vector gap_5 = x6 - mu6;
        const vector round_6 = round_each(0.15915494309189535 * gap_5);
        const vector v6 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
        const vector gap_6 = x7 - mu7;
        const vector round_7 = round_each(0.15915494309189535 * gap_6);
        const vector v7 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
        const vector gap_7 = x8 - mu8;
        const vector round_8 = round_each(0.15915494309189535 * gap_7);
        const vector v8 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
        const vector z0 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
        const vector total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
        const vector z1 = total_3 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
        const vector total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
        const vector z2 = total_4 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
        const vector total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
        const vector z3 = total_5 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
        const vector total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
        const vector z4 = total_6 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
        const vector total_7 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
        const vector total_8 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
        const vector z5 = total_8 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
        const vector total_9 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
        const vector z6 = total_9 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
        const vector total_10 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
        const vector z7 = total_10 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
        const vector total_11 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
        const vector z8 = total_11 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
        const vector total_12 = total_7 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
        const vector phi = gaussian_each(total_12);
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].v2 = v2;
        kept[i].v3 = v3;
        kept[i].v4 = v4;
        kept[i].v5 = v5;
        kept[i].v6 = v6;
        kept[i].v7 = v7;
        kept[i].v8 = v8;
        kept[i].z0 = z0;
        kept[i].z1 = z1;
        kept[i].z2 = z2;
        kept[i].z3 = z3;
        kept[i].z4 = z4;
        kept[i].z5 = z5;
        kept[i].z6 = z6;
        kept[i].z7 = z7;
        kept[i].z8 = z8;
        kept[i].phi = phi;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *value_bar = points + 19 * (size_t)near[i] + 9;
        const vector *slope_bar = points + 19 * (size_t)near[i] + 9 + 1;
        vector *factor = factors + 37 * i;
        const vector v0 = kept[i].v0;
        const vector v1 = kept[i].v1;
        const vector v2 = kept[i].v2;
        const vector v3 = kept[i].v3;
        const vector v4 = kept[i].v4;
        const vector v5 = kept[i].v5;
        const vector v6 = kept[i].v6;
        const vector v7 = kept[i].v7;
        const vector v8 = kept[i].v8;
        const vector z0 = kept[i].z0;
        const vector z1 = kept[i].z1;
        const vector z2 = kept[i].z2;
        const vector z3 = kept[i].z3;
        const vector z4 = kept[i].z4;
        const vector z5 = kept[i].z5;
        const vector z6 = kept[i].z6;
        const vector z7 = kept[i].z7;
        const vector z8 = kept[i].z8;
        const vector phi = kept[i].phi;
        const double W0_0 = S[9];
        const double W0_1 = S[10];
        const double W0_2 = S[11];
        const double W0_3 = S[12];
        const double W0_4 = S[13];
        const double W0_5 = S[14];
        const double W0_6 = S[15];
        const double W0_7 = S[16];
        const double W0_8 = S[17];
        const double W1_0 = S[18];
        const double W1_1 = S[19];
        const double W1_2 = S[20];
        const double W1_3 = S[21];
        const double W1_4 = S[22];
        const double W1_5 = S[23];
        const double W1_6 = S[24];
        const double W1_7 = S[25];
        const double W1_8 = S[26];
        const double W2_0 = S[27];
        const double W2_1 = S[28];
        const double W2_2 = S[29];
        const double W2_3 = S[30];
        const double W2_4 = S[31];
        const double W2_5 = S[32];
        const double W2_6 = S[33];
        const double W2_7 = S[34];
        const double W2_8 = S[35];
        const double W3_0 = S[36];
        const double W3_1 = S[37];
        const double W3_2 = S[38];
        const double W3_3 = S[39];
        const double W3_4 = S[40];
        const double W3_5 = S[41];
        const double W3_6 = S[42];
        const double W3_7 = S[43];
        const double W3_8 = S[44];
        const double W4_0 = S[45];
        const double W4_1 = S[46];
        const double W4_2 = S[47];
        const double W4_3 = S[48];
        const double W4_4 = S[49];
        const double W4_5 = S[50];
        const double W4_6 = S[51];
        const double W4_7 = S[52];
        const double W4_8 = S[53];
        const double W5_0 = S[54];
        const double W5_1 = S[55];
        const double W5_2 = S[56];
        const double W5_3 = S[57];
        const double W5_4 = S[58];
        const double W5_5 = S[59];
        const double W5_6 = S[60];
        const double W5_7 = S[61];
        const double W5_8 = S[62];
        const double W6_0 = S[63];
        const double W6_1 = S[64];
        const double W6_2 = S[65];
        const double W6_3 = S[66];
        const double W6_4 = S[67];
        const double W6_5 = S[68];
        const double W6_6 = S[69];
        const double W6_7 = S[70];
        const double W6_8 = S[71];
        const double W7_0 = S[72];
        const double W7_1 = S[73];
        const double W7_2 = S[74];
        const double W7_3 = S[75];
        const double W7_4 = S[76];
        const double W7_5 = S[77];
        const double W7_6 = S[78];
        const double W7_7 = S[79];
        const double W7_8 = S[80];
        const double W8_0 = S[81];
        const double W8_1 = S[82];
        const double W8_2 = S[83];
        const double W8_3 = S[84];
        const double W8_4 = S[85];
        const double W8_5 = S[86];
        const double W8_6 = S[87];
        const double W8_7 = S[88];
        const double W8_8 = S[89];
        const vector its_value_bar = value_bar[0];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector x2_bar = slope_bar[2];
        const vector x3_bar = slope_bar[3];
        const vector x4_bar = slope_bar[4];
        const vector x5_bar = slope_bar[5];
        const vector x6_bar = slope_bar[6];
        const vector x7_bar = slope_bar[7];
        const vector x8_bar = slope_bar[8];
        const vector gap_8 = -(W8_0 * x0_bar) - W8_1 * x1_bar - W8_2 * x2_bar - W8_3 * x3_bar;
        const vector gap_9 = gap_8 - W8_4 * x4_bar - W8_5 * x5_bar - W8_6 * x6_bar - W8_7 * x7_bar;
        const vector gap_10 = gap_9 - W8_8 * x8_bar;
        const vector gap_11 = -(W0_0 * x0_bar) - W0_1 * x1_bar - W0_2 * x2_bar - W0_3 * x3_bar;
        const vector gap_12 = gap_11 - W0_4 * x4_bar - W0_5 * x5_bar - W0_6 * x6_bar - W0_7 * x7_bar;
        const vector gap_13 = gap_12 - W0_8 * x8_bar;
        const vector gap_14 = -(W1_0 * x0_bar) - W1_1 * x1_bar - W1_2 * x2_bar - W1_3 * x3_bar;
        const vector gap_15 = gap_14 - W1_4 * x4_bar - W1_5 * x5_bar - W1_6 * x6_bar - W1_7 * x7_bar;
        const vector gap_16 = gap_15 - W1_8 * x8_bar;
        const vector gap_17 = -(W2_0 * x0_bar) - W2_1 * x1_bar - W2_2 * x2_bar - W2_3 * x3_bar;
        const vector gap_18 = gap_17 - W2_4 * x4_bar - W2_5 * x5_bar - W2_6 * x6_bar - W2_7 * x7_bar;
        const vector gap_19 = gap_18 - W2_8 * x8_bar;
        const vector gap_20 = -(W3_0 * x0_bar) - W3_1 * x1_bar - W3_2 * x2_bar - W3_3 * x3_bar;
        const vector gap_21 = gap_20 - W3_4 * x4_bar - W3_5 * x5_bar - W3_6 * x6_bar - W3_7 * x7_bar;
        const vector gap_22 = gap_21 - W3_8 * x8_bar;
        const vector total_13 = its_value_bar + z0 * gap_13 + z1 * gap_16 + z2 * gap_19 + z3 * gap_22;
        const vector gap_23 = -(W4_0 * x0_bar) - W4_1 * x1_bar - W4_2 * x2_bar - W4_3 * x3_bar;
        const vector gap_24 = gap_23 - W4_4 * x4_bar - W4_5 * x5_bar - W4_6 * x6_bar - W4_7 * x7_bar;
        const vector gap_25 = gap_24 - W4_8 * x8_bar;
        const vector gap_26 = -(W5_0 * x0_bar) - W5_1 * x1_bar - W5_2 * x2_bar - W5_3 * x3_bar;
        const vector gap_27 = gap_26 - W5_4 * x4_bar - W5_5 * x5_bar - W5_6 * x6_bar - W5_7 * x7_bar;
        const vector gap_28 = gap_27 - W5_8 * x8_bar;
        const vector gap_29 = -(W6_0 * x0_bar) - W6_1 * x1_bar - W6_2 * x2_bar - W6_3 * x3_bar;
        const vector gap_30 = gap_29 - W6_4 * x4_bar - W6_5 * x5_bar - W6_6 * x6_bar - W6_7 * x7_bar;
        const vector gap_31 = gap_30 - W6_8 * x8_bar;
        const vector gap_32 = -(W7_0 * x0_bar) - W7_1 * x1_bar - W7_2 * x2_bar - W7_3 * x3_bar;
        const vector gap_33 = gap_32 - W7_4 * x4_bar - W7_5 * x5_bar - W7_6 * x6_bar - W7_7 * x7_bar;
        const vector gap_34 = gap_33 - W7_8 * x8_bar;
        const vector total_14 = total_13 + z4 * gap_25 + z5 * gap_28 + z6 * gap_31 + z7 * gap_34;
        const vector by_phi = total_14 + z8 * gap_10;
        const vector phi_product = phi * by_phi;
        const vector by_z8 = phi * gap_10 - z8 * phi_product;
        const vector by_z7 = phi * gap_34 - z7 * phi_product;
        const vector by_z6 = phi * gap_31 - z6 * phi_product;
        const vector by_z5 = phi * gap_28 - z5 * phi_product;
        const vector by_z4 = phi * gap_25 - z4 * phi_product;
        const vector total_15 = W8_0 * by_z8 + W7_0 * by_z7 + W6_0 * by_z6 + W5_0 * by_z5 + W4_0 * by_z4;
        const vector by_z3 = phi * gap_22 - z3 * phi_product;
        const vector by_z2 = phi * gap_19 - z2 * phi_product;
        const vector by_z1 = phi * gap_16 - z1 * phi_product;
        const vector by_z0 = phi * gap_13 - z0 * phi_product;
        const vector by_v0 = total_15 + W3_0 * by_z3 + W2_0 * by_z2 + W1_0 * by_z1 + W0_0 * by_z0;
        const vector total_16 = W8_1 * by_z8 + W7_1 * by_z7 + W6_1 * by_z6 + W5_1 * by_z5 + W4_1 * by_z4;
        const vector by_v1 = total_16 + W3_1 * by_z3 + W2_1 * by_z2 + W1_1 * by_z1 + W0_1 * by_z0;
        const vector total_17 = W8_2 * by_z8 + W7_2 * by_z7 + W6_2 * by_z6 + W5_2 * by_z5 + W4_2 * by_z4;
        const vector by_v2 = total_17 + W3_2 * by_z3 + W2_2 * by_z2 + W1_2 * by_z1 + W0_2 * by_z0;
        const vector total_18 = W8_3 * by_z8 + W7_3 * by_z7 + W6_3 * by_z6 + W5_3 * by_z5 + W4_3 * by_z4;
        const vector by_v3 = total_18 + W3_3 * by_z3 + W2_3 * by_z2 + W1_3 * by_z1 + W0_3 * by_z0;
        const vector total_19 = W8_4 * by_z8 + W7_4 * by_z7 + W6_4 * by_z6 + W5_4 * by_z5 + W4_4 * by_z4;
        const vector by_v4 = total_19 + W3_4 * by_z3 + W2_4 * by_z2 + W1_4 * by_z1 + W0_4 * by_z0;
        const vector total_20 = W8_5 * by_z8 + W7_5 * by_z7 + W6_5 * by_z6 + W5_5 * by_z5 + W4_5 * by_z4;
        const vector by_v5 = total_20 + W3_5 * by_z3 + W2_5 * by_z2 + W1_5 * by_z1 + W0_5 * by_z0;
        const vector total_21 = W8_6 * by_z8 + W7_6 * by_z7 + W6_6 * by_z6 + W5_6 * by_z5 + W4_6 * by_z4;
        const vector by_v6 = total_21 + W3_6 * by_z3 + W2_6 * by_z2 + W1_6 * by_z1 + W0_6 * by_z0;
        const vector total_22 = W8_7 * by_z8 + W7_7 * by_z7 + W6_7 * by_z6 + W5_7 * by_z5 + W4_7 * by_z4;
        const vector by_v7 = total_22 + W3_7 * by_z3 + W2_7 * by_z2 + W1_7 * by_z1 + W0_7 * by_z0;
        const vector total_23 = W8_8 * by_z8 + W7_8 * by_z7 + W6_8 * by_z6 + W5_8 * by_z5 + W4_8 * by_z4;
        const vector by_v8 = total_23 + W3_8 * by_z3 + W2_8 * by_z2 + W1_8 * by_z1 + W0_8 * by_z0;
        const vector z0_product = z0 * phi;
        const vector z1_product = z1 * phi;
        const vector z2_product = z2 * phi;
        const vector z3_product = z3 * phi;
        const vector z4_product = z4 * phi;
        const vector z5_product = z5 * phi;
        const vector z6_product = z6 * phi;
        const vector z7_product = z7 * phi;
        const vector z8_product = z8 * phi;
        factor[0] = v0;
        factor[1] = v1;
        factor[2] = v2;
        factor[3] = v3;
        factor[4] = v4;
        factor[5] = v5;
        factor[6] = v6;
        factor[7] = v7;
        factor[8] = v8;
        factor[9] = phi_product;
        factor[10] = by_z8;
        factor[11] = by_z7;
        factor[12] = by_z6;
        factor[13] = by_z5;
        factor[14] = by_z4;
        factor[15] = by_z3;
        factor[16] = by_z2;
        factor[17] = by_z1;
        factor[18] = by_z0;
        factor[19] = -by_v0;
        factor[20] = -by_v1;
        factor[21] = -by_v2;
        factor[22] = -by_v3;
        factor[23] = -by_v4;
        factor[24] = -by_v5;
        factor[25] = -by_v6;
        factor[26] = -by_v7;
        factor[27] = -by_v8;
        factor[28] = z0_product;
        factor[29] = z1_product;
        factor[30] = z2_product;
        factor[31] = z3_product;
        factor[32] = z4_product;
        factor[33] = z5_product;
        factor[34] = z6_product;
        factor[35] = z7_product;
        factor[36] = z8_product;
    }
}

/* Adds some of the sums, as products. */
INLINE void pair_products_0(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[19];
    sum[1] = sum[1] + factor[20];
    sum[2] = sum[2] + factor[21];
    sum[3] = sum[3] + factor[22];
    sum[4] = sum[4] + factor[23];
    sum[5] = sum[5] + factor[24];
    sum[6] = sum[6] + factor[25];
    sum[7] = sum[7] + factor[26];
    sum[8] = sum[8] + factor[27];
    sum[9] = sum[9] + factor[9];
    sum[10] = sum[10] + factor[0] * factor[18] - factor[28] * point[10];
    sum[11] = sum[11] + factor[1] * factor[18] - factor[28] * point[11];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_1(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[18] - factor[28] * point[12];
    sum[1] = sum[1] + factor[3] * factor[18] - factor[28] * point[13];
    sum[2] = sum[2] + factor[4] * factor[18] - factor[28] * point[14];
    sum[3] = sum[3] + factor[5] * factor[18] - factor[28] * point[15];
    sum[4] = sum[4] + factor[6] * factor[18] - factor[28] * point[16];
    sum[5] = sum[5] + factor[7] * factor[18] - factor[28] * point[17];
    sum[6] = sum[6] + factor[8] * factor[18] - factor[28] * point[18];
    sum[7] = sum[7] + factor[2] * factor[17] - factor[29] * point[12];
    sum[8] = sum[8] + factor[3] * factor[17] - factor[29] * point[13];
    sum[9] = sum[9] + factor[4] * factor[17] - factor[29] * point[14];
    sum[10] = sum[10] + factor[5] * factor[17] - factor[29] * point[15];
    sum[11] = sum[11] + factor[6] * factor[17] - factor[29] * point[16];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_2(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[17] - factor[29] * point[10];
    sum[1] = sum[1] + factor[1] * factor[17] - factor[29] * point[11];
    sum[2] = sum[2] + factor[7] * factor[17] - factor[29] * point[17];
    sum[3] = sum[3] + factor[8] * factor[17] - factor[29] * point[18];
    sum[4] = sum[4] + factor[0] * factor[16] - factor[30] * point[10];
    sum[5] = sum[5] + factor[1] * factor[16] - factor[30] * point[11];
    sum[6] = sum[6] + factor[7] * factor[16] - factor[30] * point[17];
    sum[7] = sum[7] + factor[8] * factor[16] - factor[30] * point[18];
    sum[8] = sum[8] + factor[2] * factor[16] - factor[30] * point[12];
    sum[9] = sum[9] + factor[3] * factor[16] - factor[30] * point[13];
    sum[10] = sum[10] + factor[4] * factor[16] - factor[30] * point[14];
    sum[11] = sum[11] + factor[5] * factor[16] - factor[30] * point[15];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_3(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[6] * factor[16] - factor[30] * point[16];
    sum[1] = sum[1] + factor[6] * factor[15] - factor[31] * point[16];
    sum[2] = sum[2] + factor[0] * factor[15] - factor[31] * point[10];
    sum[3] = sum[3] + factor[1] * factor[15] - factor[31] * point[11];
    sum[4] = sum[4] + factor[2] * factor[15] - factor[31] * point[12];
    sum[5] = sum[5] + factor[3] * factor[15] - factor[31] * point[13];
    sum[6] = sum[6] + factor[4] * factor[15] - factor[31] * point[14];
    sum[7] = sum[7] + factor[5] * factor[15] - factor[31] * point[15];
    sum[8] = sum[8] + factor[7] * factor[15] - factor[31] * point[17];
    sum[9] = sum[9] + factor[8] * factor[15] - factor[31] * point[18];
    sum[10] = sum[10] + factor[0] * factor[14] - factor[32] * point[10];
    sum[11] = sum[11] + factor[1] * factor[14] - factor[32] * point[11];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_4(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[14] - factor[32] * point[12];
    sum[1] = sum[1] + factor[3] * factor[14] - factor[32] * point[13];
    sum[2] = sum[2] + factor[4] * factor[14] - factor[32] * point[14];
    sum[3] = sum[3] + factor[5] * factor[14] - factor[32] * point[15];
    sum[4] = sum[4] + factor[6] * factor[14] - factor[32] * point[16];
    sum[5] = sum[5] + factor[7] * factor[14] - factor[32] * point[17];
    sum[6] = sum[6] + factor[8] * factor[14] - factor[32] * point[18];
    sum[7] = sum[7] + factor[2] * factor[13] - factor[33] * point[12];
    sum[8] = sum[8] + factor[3] * factor[13] - factor[33] * point[13];
    sum[9] = sum[9] + factor[4] * factor[13] - factor[33] * point[14];
    sum[10] = sum[10] + factor[5] * factor[13] - factor[33] * point[15];
    sum[11] = sum[11] + factor[6] * factor[13] - factor[33] * point[16];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_5(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[13] - factor[33] * point[10];
    sum[1] = sum[1] + factor[1] * factor[13] - factor[33] * point[11];
    sum[2] = sum[2] + factor[7] * factor[13] - factor[33] * point[17];
    sum[3] = sum[3] + factor[8] * factor[13] - factor[33] * point[18];
    sum[4] = sum[4] + factor[0] * factor[12] - factor[34] * point[10];
    sum[5] = sum[5] + factor[1] * factor[12] - factor[34] * point[11];
    sum[6] = sum[6] + factor[7] * factor[12] - factor[34] * point[17];
    sum[7] = sum[7] + factor[8] * factor[12] - factor[34] * point[18];
    sum[8] = sum[8] + factor[2] * factor[12] - factor[34] * point[12];
    sum[9] = sum[9] + factor[3] * factor[12] - factor[34] * point[13];
    sum[10] = sum[10] + factor[4] * factor[12] - factor[34] * point[14];
    sum[11] = sum[11] + factor[5] * factor[12] - factor[34] * point[15];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_6(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[6] * factor[12] - factor[34] * point[16];
    sum[1] = sum[1] + factor[6] * factor[11] - factor[35] * point[16];
    sum[2] = sum[2] + factor[0] * factor[11] - factor[35] * point[10];
    sum[3] = sum[3] + factor[1] * factor[11] - factor[35] * point[11];
    sum[4] = sum[4] + factor[2] * factor[11] - factor[35] * point[12];
    sum[5] = sum[5] + factor[3] * factor[11] - factor[35] * point[13];
    sum[6] = sum[6] + factor[4] * factor[11] - factor[35] * point[14];
    sum[7] = sum[7] + factor[5] * factor[11] - factor[35] * point[15];
    sum[8] = sum[8] + factor[7] * factor[11] - factor[35] * point[17];
    sum[9] = sum[9] + factor[8] * factor[11] - factor[35] * point[18];
    sum[10] = sum[10] + factor[0] * factor[10] - factor[36] * point[10];
    sum[11] = sum[11] + factor[1] * factor[10] - factor[36] * point[11];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_7(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[10] - factor[36] * point[12];
    sum[1] = sum[1] + factor[3] * factor[10] - factor[36] * point[13];
    sum[2] = sum[2] + factor[4] * factor[10] - factor[36] * point[14];
    sum[3] = sum[3] + factor[5] * factor[10] - factor[36] * point[15];
    sum[4] = sum[4] + factor[6] * factor[10] - factor[36] * point[16];
    sum[5] = sum[5] + factor[7] * factor[10] - factor[36] * point[17];
    sum[6] = sum[6] + factor[8] * factor[10] - factor[36] * point[18];
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp(
    const vector *mu, const vector *W, const vector *amplitude, const vector *sums, vector *mu_bar, vector *W_bar, vector *amplitude_bar) {
    (void)mu;
    (void)W;
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
    const vector sum36 = sums[36];
    const vector sum37 = sums[37];
    const vector sum38 = sums[38];
    const vector sum39 = sums[39];
    const vector sum40 = sums[40];
    const vector sum41 = sums[41];
    const vector sum42 = sums[42];
    const vector sum43 = sums[43];
    const vector sum44 = sums[44];
    const vector sum45 = sums[45];
    const vector sum46 = sums[46];
    const vector sum47 = sums[47];
    const vector sum48 = sums[48];
    const vector sum49 = sums[49];
    const vector sum50 = sums[50];
    const vector sum51 = sums[51];
    const vector sum52 = sums[52];
    const vector sum53 = sums[53];
    const vector sum54 = sums[54];
    const vector sum55 = sums[55];
    const vector sum56 = sums[56];
    const vector sum57 = sums[57];
    const vector sum58 = sums[58];
    const vector sum59 = sums[59];
    const vector sum60 = sums[60];
    const vector sum61 = sums[61];
    const vector sum62 = sums[62];
    const vector sum63 = sums[63];
    const vector sum64 = sums[64];
    const vector sum65 = sums[65];
    const vector sum66 = sums[66];
    const vector sum67 = sums[67];
    const vector sum68 = sums[68];
    const vector sum69 = sums[69];
    const vector sum70 = sums[70];
    const vector sum71 = sums[71];
    const vector sum72 = sums[72];
    const vector sum73 = sums[73];
    const vector sum74 = sums[74];
    const vector sum75 = sums[75];
    const vector sum76 = sums[76];
    const vector sum77 = sums[77];
    const vector sum78 = sums[78];
    const vector sum79 = sums[79];
    const vector sum80 = sums[80];
    const vector sum81 = sums[81];
    const vector sum82 = sums[82];
    const vector sum83 = sums[83];
    const vector sum84 = sums[84];
    const vector sum85 = sums[85];
    const vector sum86 = sums[86];
    const vector sum87 = sums[87];
    const vector sum88 = sums[88];
    const vector sum89 = sums[89];
    const vector sum90 = sums[90];
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = its_amplitude * sum1;
    mu_bar[2] = its_amplitude * sum2;
    mu_bar[3] = its_amplitude * sum3;
    mu_bar[4] = its_amplitude * sum4;
    mu_bar[5] = its_amplitude * sum5;
    mu_bar[6] = its_amplitude * sum6;
    mu_bar[7] = its_amplitude * sum7;
    mu_bar[8] = its_amplitude * sum8;
    W_bar[0] = its_amplitude * sum9;
    W_bar[1] = its_amplitude * sum10;
    W_bar[2] = its_amplitude * sum11;
    W_bar[3] = its_amplitude * sum12;
    W_bar[4] = its_amplitude * sum13;
    W_bar[5] = its_amplitude * sum14;
    W_bar[6] = its_amplitude * sum15;
    W_bar[7] = its_amplitude * sum16;
    W_bar[8] = its_amplitude * sum17;
    W_bar[9] = its_amplitude * sum18;
    W_bar[10] = its_amplitude * sum19;
    W_bar[11] = its_amplitude * sum20;
    W_bar[12] = its_amplitude * sum21;
    W_bar[13] = its_amplitude * sum22;
    W_bar[14] = its_amplitude * sum23;
    W_bar[15] = its_amplitude * sum24;
    W_bar[16] = its_amplitude * sum25;
    W_bar[17] = its_amplitude * sum26;
    W_bar[18] = its_amplitude * sum27;
    W_bar[19] = its_amplitude * sum28;
    W_bar[20] = its_amplitude * sum29;
    W_bar[21] = its_amplitude * sum30;
    W_bar[22] = its_amplitude * sum31;
    W_bar[23] = its_amplitude * sum32;
    W_bar[24] = its_amplitude * sum33;
    W_bar[25] = its_amplitude * sum34;
    W_bar[26] = its_amplitude * sum35;
    W_bar[27] = its_amplitude * sum36;
    W_bar[28] = its_amplitude * sum37;
    W_bar[29] = its_amplitude * sum38;
    W_bar[30] = its_amplitude * sum39;
    W_bar[31] = its_amplitude * sum40;
    W_bar[32] = its_amplitude * sum41;
    W_bar[33] = its_amplitude * sum42;
    W_bar[34] = its_amplitude * sum43;
    W_bar[35] = its_amplitude * sum44;
    W_bar[36] = its_amplitude * sum45;
    W_bar[37] = its_amplitude * sum46;
    W_bar[38] = its_amplitude * sum47;
    W_bar[39] = its_amplitude * sum48;
    W_bar[40] = its_amplitude * sum49;
    W_bar[41] = its_amplitude * sum50;
    W_bar[42] = its_amplitude * sum51;
    W_bar[43] = its_amplitude * sum52;
    W_bar[44] = its_amplitude * sum53;
    W_bar[45] = its_amplitude * sum54;
    W_bar[46] = its_amplitude * sum55;
    W_bar[47] = its_amplitude * sum56;
    W_bar[48] = its_amplitude * sum57;
    W_bar[49] = its_amplitude * sum58;
    W_bar[50] = its_amplitude * sum59;
    W_bar[51] = its_amplitude * sum60;
    W_bar[52] = its_amplitude * sum61;
    W_bar[53] = its_amplitude * sum62;
    W_bar[54] = its_amplitude * sum63;
    W_bar[55] = its_amplitude * sum64;
    W_bar[56] = its_amplitude * sum65;
    W_bar[57] = its_amplitude * sum66;
    W_bar[58] = its_amplitude * sum67;
    W_bar[59] = its_amplitude * sum68;
    W_bar[60] = its_amplitude * sum69;
    W_bar[61] = its_amplitude * sum70;
    W_bar[62] = its_amplitude * sum71;
    W_bar[63] = its_amplitude * sum72;
    W_bar[64] = its_amplitude * sum73;
    W_bar[65] = its_amplitude * sum74;
    W_bar[66] = its_amplitude * sum75;
    W_bar[67] = its_amplitude * sum76;
    W_bar[68] = its_amplitude * sum77;
    W_bar[69] = its_amplitude * sum78;
    W_bar[70] = its_amplitude * sum79;
    W_bar[71] = its_amplitude * sum80;
    W_bar[72] = its_amplitude * sum81;
    W_bar[73] = its_amplitude * sum82;
    W_bar[74] = its_amplitude * sum83;
    W_bar[75] = its_amplitude * sum84;
    W_bar[76] = its_amplitude * sum85;
    W_bar[77] = its_amplitude * sum86;
    W_bar[78] = its_amplitude * sum87;
    W_bar[79] = its_amplitude * sum88;
    W_bar[80] = its_amplitude * sum89;
    amplitude_bar[0] = sum90;
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
    const double p7 = p[7];
    const double p8 = p[8];
    const vector q0 = q[0];
    const vector q1 = q[1];
    const vector q2 = q[2];
    const vector q3 = q[3];
    const vector q4 = q[4];
    const vector q5 = q[5];
    const vector q6 = q[6];
    const vector q7 = q[7];
    const vector q8 = q[8];
    const vector base_position_log0 = q0 - p0;
    const vector base_position_log1 = q1 - p1;
    const vector gap = q2 - p2;
    const vector round_2 = round_each(0.15915494309189535 * gap);
    const vector base_heading_log0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const vector gap_2 = q3 - p3;
    const vector round_3 = round_each(0.15915494309189535 * gap_2);
    const vector arm_log0 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const vector gap_3 = q4 - p4;
    const vector round_4 = round_each(0.15915494309189535 * gap_3);
    const vector arm_log1 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const vector gap_4 = q5 - p5;
    const vector round_5 = round_each(0.15915494309189535 * gap_4);
    const vector arm_log2 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const vector gap_5 = q6 - p6;
    const vector round_6 = round_each(0.15915494309189535 * gap_5);
    const vector arm_log3 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const vector gap_6 = q7 - p7;
    const vector round_7 = round_each(0.15915494309189535 * gap_6);
    const vector arm_log4 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const vector gap_7 = q8 - p8;
    const vector round_8 = round_each(0.15915494309189535 * gap_7);
    const vector arm_log5 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    const vector total_2 = base_position_log0 * base_position_log0 + base_position_log1 * base_position_log1 +
        0.25 * (base_heading_log0 * base_heading_log0) + 0.0625 * (arm_log0 * arm_log0) + 0.0625 * (arm_log1 *
        arm_log1);
    const vector total_3 = total_2 + 0.0625 * (arm_log2 * arm_log2) + 0.0625 * (arm_log3 * arm_log3) + 0.0625
        * (arm_log4 * arm_log4);
    distance[0] = sqrt_each(total_3 + 0.0625 * (arm_log5 * arm_log5));
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
size_t mobile_manipulator_splats_work(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES - 1) / LANES, blocks = (points + 2 - 1) / 2;
    const size_t places = 10 * ((splat_count + LANES - 1) / LANES + (blocks + LANES - 1) / LANES);
    return (points * 19 + places + 1) * LANES + 91 * splat_count;
}

static vector *work_points(double *work) {
    const uintptr_t size = sizeof(vector), start = (uintptr_t)work;
    return (vector *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const double *splat_at(const vector *splats, size_t k) {
    const size_t row = k / LANES;
    return (const double *)(splats + 10 * row) + (k - row * LANES);
}

static vector *work_reaches(double *work, size_t count) {
    return work_points(work) + (count + LANES - 1) / LANES * 19;
}

static vector *work_blocks(double *work, size_t count, size_t splat_count) {
    return work_reaches(work, count) + 10 * ((splat_count + LANES - 1) / LANES);
}

static double *work_constants(double *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES, blocks = (count + size - 1) / size;
    return (double *)(work_blocks(work, count, splat_count) + 10 * ((blocks + LANES - 1) / LANES));
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
    vector *own = splats + start / LANES * (9 + 1);
    vector_rows(width, splat_count, start, 1, own + 9);
    own[9] = own[9] * 9.014149034296874 + vector_spoilt(mu, 9) + vector_spoilt(amplitude, 1);
    for (int i = 0; i < 9; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place(const double *x, size_t count, size_t start, double *place) {
    const size_t size = count - start < 2 * LANES ? count - start : 2 * LANES;
    vector at[2][9], spoilt = ZERO;
    for (size_t b = 0; b < 2; ++b) {
        vector_rows(x, count, start + b * LANES, 9, at[b]);
        spoilt += vector_spoilt(at[b], 9);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const double *middle = x + 9 * (start + i * size / 8);
        double radius = 0, column[LANES];
        for (size_t b = 0; b < 2; ++b) {
            vector distance[1];
            pair_distances(middle, at[b], distance);
            vector_store(column, distance[0]);
            for (size_t lane = 0; lane < LANES; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[9]) {
            for (int j = 0; j < 9; ++j) place[j] = middle[j];
            place[9] = radius;
        }
    }
    place[9] = place[9] * 1.0078125 + vector_sum(spoilt);
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
        const vector *own = splats + start / LANES * (9 + 1);
        vector distance[1];
        pair_distances(place, own, distance);
        const vector_mask far = vector_far(distance[0], own[9], vector_of(place[9]));
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
        const vector *own = blocks + start / group * (9 + 1);
        vector distance[1];
        pair_distances(mu, own, distance);
        const vector_mask far = vector_far(distance[0], vector_of(*reach), own[9]);
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
    vector own_mu[9], own_W[81], own_amplitude[1], S[91];
    vector_rows(mu, splat_count, start, 9, own_mu);
    vector_rows(W, splat_count, start, 81, own_W);
    vector_rows(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants(own_mu, own_W, own_amplitude, S);
    vector_to_rows(S, constants, splat_count, start, 91, 91);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void mobile_manipulator_splats(
    size_t count, size_t splat_count, const double *MOBILE_MANIPULATOR_RESTRICT x, const double *MOBILE_MANIPULATOR_RESTRICT mu, const double *MOBILE_MANIPULATOR_RESTRICT W, const double *MOBILE_MANIPULATOR_RESTRICT amplitude, const double *MOBILE_MANIPULATOR_RESTRICT width,
    double *MOBILE_MANIPULATOR_RESTRICT value, double *MOBILE_MANIPULATOR_RESTRICT gradient, double *MOBILE_MANIPULATOR_RESTRICT work, int threads) {
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
            vector at[2][9], X[2 * 9], grad[9];
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
                vector_to_rows(grad, gradient, count, start + b * LANES, 9, 9);
            }
        }
        restore_denormals(mode);
    }
}

void mobile_manipulator_splats_value(
    size_t count, size_t splat_count, const double *MOBILE_MANIPULATOR_RESTRICT x, const double *MOBILE_MANIPULATOR_RESTRICT mu, const double *MOBILE_MANIPULATOR_RESTRICT W, const double *MOBILE_MANIPULATOR_RESTRICT amplitude, const double *MOBILE_MANIPULATOR_RESTRICT width,
    double *MOBILE_MANIPULATOR_RESTRICT value, double *MOBILE_MANIPULATOR_RESTRICT work, int threads) {
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
    vector at[9], grad_bar[9], slope_bar[9];
    vector_rows(x, count, start, 9, at);
    vector_rows(gradient_bar, count, start, 9, grad_bar);
    vector_rows(value_bar, count, start, 1, point + 9);
    pair_features(at, point);
    pair_gradient_vjp(at, grad_bar, slope_bar);
    for (int i = 0; i < 9; ++i) point[9 + 1 + i] = slope_bar[i];
    vector_end(count, start, 9 + 1, point + 9);
}

/* Adds what makes the derivatives, of a splat at some vectors of points: their factors, then the products of these. */
INLINE void pair_backward(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *sums) {
    vector factor[10 * 37];
    pair_factors(count, points, near, S, factor);
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_0(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[0] += sum[0];
        sums[1] += sum[1];
        sums[2] += sum[2];
        sums[3] += sum[3];
        sums[4] += sum[4];
        sums[5] += sum[5];
        sums[6] += sum[6];
        sums[7] += sum[7];
        sums[8] += sum[8];
        sums[90] += sum[9];
        sums[9] += sum[10];
        sums[10] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_1(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[11] += sum[0];
        sums[12] += sum[1];
        sums[13] += sum[2];
        sums[14] += sum[3];
        sums[15] += sum[4];
        sums[16] += sum[5];
        sums[17] += sum[6];
        sums[20] += sum[7];
        sums[21] += sum[8];
        sums[22] += sum[9];
        sums[23] += sum[10];
        sums[24] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_2(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[18] += sum[0];
        sums[19] += sum[1];
        sums[25] += sum[2];
        sums[26] += sum[3];
        sums[27] += sum[4];
        sums[28] += sum[5];
        sums[34] += sum[6];
        sums[35] += sum[7];
        sums[29] += sum[8];
        sums[30] += sum[9];
        sums[31] += sum[10];
        sums[32] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_3(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[33] += sum[0];
        sums[42] += sum[1];
        sums[36] += sum[2];
        sums[37] += sum[3];
        sums[38] += sum[4];
        sums[39] += sum[5];
        sums[40] += sum[6];
        sums[41] += sum[7];
        sums[43] += sum[8];
        sums[44] += sum[9];
        sums[45] += sum[10];
        sums[46] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_4(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[47] += sum[0];
        sums[48] += sum[1];
        sums[49] += sum[2];
        sums[50] += sum[3];
        sums[51] += sum[4];
        sums[52] += sum[5];
        sums[53] += sum[6];
        sums[56] += sum[7];
        sums[57] += sum[8];
        sums[58] += sum[9];
        sums[59] += sum[10];
        sums[60] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_5(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[54] += sum[0];
        sums[55] += sum[1];
        sums[61] += sum[2];
        sums[62] += sum[3];
        sums[63] += sum[4];
        sums[64] += sum[5];
        sums[70] += sum[6];
        sums[71] += sum[7];
        sums[65] += sum[8];
        sums[66] += sum[9];
        sums[67] += sum[10];
        sums[68] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_6(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[69] += sum[0];
        sums[78] += sum[1];
        sums[72] += sum[2];
        sums[73] += sum[3];
        sums[74] += sum[4];
        sums[75] += sum[5];
        sums[76] += sum[6];
        sums[77] += sum[7];
        sums[79] += sum[8];
        sums[80] += sum[9];
        sums[81] += sum[10];
        sums[82] += sum[11];
    }
    {
        vector sum[7] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_7(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[83] += sum[0];
        sums[84] += sum[1];
        sums[85] += sum[2];
        sums[86] += sum[3];
        sums[87] += sum[4];
        sums[88] += sum[5];
        sums[89] += sum[6];
    }
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums(const vector *points, const uint32_t *near, size_t size, const double *S, double *sums) {
    vector sum[91] = {ZERO};
    for (size_t b = 0; b < size; b += 10)
        pair_backward(size - b < 10 ? size - b : 10, points, near + b, S, sum);
    for (size_t i = 0; i < 91; ++i) sums[i] += vector_sum(sum[i]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void mobile_manipulator_splats_vjp(
    size_t count, size_t splat_count, const double *MOBILE_MANIPULATOR_RESTRICT x, const double *MOBILE_MANIPULATOR_RESTRICT mu, const double *MOBILE_MANIPULATOR_RESTRICT W, const double *MOBILE_MANIPULATOR_RESTRICT amplitude, const double *MOBILE_MANIPULATOR_RESTRICT width, const double *MOBILE_MANIPULATOR_RESTRICT value_bar, const double *MOBILE_MANIPULATOR_RESTRICT gradient_bar,
    double *MOBILE_MANIPULATOR_RESTRICT mu_bar, double *MOBILE_MANIPULATOR_RESTRICT W_bar, double *MOBILE_MANIPULATOR_RESTRICT amplitude_bar, double *MOBILE_MANIPULATOR_RESTRICT work, int threads) {
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
                for (int i = 0; i < 10; ++i) {
                    double *row = (double *)(places + block / LANES * 10 + i);
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
            double sums[LANES][91] = {{0}};
            uint32_t near[131072 / (19 * sizeof(vector)) + 2];
            vector own_mu[9], own_W[81], own_amplitude[1], own_sums[91], bars[91];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const double *reach = width ? splat_at(splats, k) + 9 * LANES : NULL;
                    const size_t some = blocks_near(mu + 9 * k, reach, places, first, first + size, near);
                    splat_sums(points + 19 * first, near, some, constants + 91 * k, sums[k - start]);
                }
            }
            vector_rows(mu, end, start, 9, own_mu);
            vector_rows(W, end, start, 81, own_W);
            vector_rows(amplitude, end, start, 1, own_amplitude);
            vector_rows(sums[0], LANES, 0, 91, own_sums);
            pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 9, bars + 9 + 81);
            vector_to_rows(bars, mu_bar, end, start, 9, 9);
            vector_to_rows(bars + 9, W_bar, end, start, 81, 81);
            vector_to_rows(bars + 9 + 81, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void mobile_manipulator_splats_rows(
    size_t count, size_t splat_count, const double *MOBILE_MANIPULATOR_RESTRICT x, const double *MOBILE_MANIPULATOR_RESTRICT mu, const double *MOBILE_MANIPULATOR_RESTRICT W, const double *MOBILE_MANIPULATOR_RESTRICT amplitude, const double *MOBILE_MANIPULATOR_RESTRICT value_bar, const double *MOBILE_MANIPULATOR_RESTRICT gradient_bar,
    double *MOBILE_MANIPULATOR_RESTRICT rows, double *MOBILE_MANIPULATOR_RESTRICT work, int threads) {
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
                vector own_mu[9], own_W[81], own_amplitude[1], own_sums[91] = {ZERO}, bars[91];
                for (int i = 0; i < 9; ++i) own_mu[i] = vector_of(mu[9 * k + i]);
                for (int i = 0; i < 81; ++i) own_W[i] = vector_of(W[81 * k + i]);
                own_amplitude[0] = vector_of(amplitude[k]);
                pair_backward(1, point, &only, constants + 91 * k, own_sums);
                pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 9, bars + 9 + 81);
                vector_to_rows(bars, rows + 91 * k, count, block * LANES, 91, 91 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

/* A coordinate to sort by. */
INLINE double order_key(const double *x, size_t row, size_t axis) {
    const double key = x[9 * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest(const double *x, const size_t *order, size_t count) {
    double low[9], high[9];
    size_t widest = 0;
    for (size_t axis = 0; axis < 9; ++axis) low[axis] = high[axis] = order_key(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < 9; ++axis) {
            const double key = order_key(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < 9; ++axis)
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

double mobile_manipulator_splats_order(
    size_t count, size_t splat_count, const double *MOBILE_MANIPULATOR_RESTRICT x, const double *MOBILE_MANIPULATOR_RESTRICT mu, const double *MOBILE_MANIPULATOR_RESTRICT amplitude, const double *MOBILE_MANIPULATOR_RESTRICT width,
    double limit, size_t *MOBILE_MANIPULATOR_RESTRICT order, double *MOBILE_MANIPULATOR_RESTRICT work) {
    const size_t block = 2 * LANES;
    vector *splats = work_reaches(work, 0);
    uint32_t near[256];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES) {
        vector own_mu[9], own_amplitude[1];
        vector_rows(mu, splat_count, start, 9, own_mu);
        vector_rows(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks(x, order, count, (double *)work_blocks(work, 0, splat_count));
        for (size_t i = 1; i < 2 * 16; i += 2) {
            double rows[2 * LANES * 9], place[9 + 1];
            const size_t some = i * count / (2 * 16), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < 9; ++j) rows[9 * n + j] = x[9 * order[start + n] + j];
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

/* round to even, of numbers below 2^22; of larger ones, a whole number close by. */
INLINE vector_f round_each_f(vector_f x) { return (x + 12582912.0f) - 12582912.0f; }

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
    const vector_f W0_3 = W[3];
    const vector_f W0_4 = W[4];
    const vector_f W0_5 = W[5];
    const vector_f W0_6 = W[6];
    const vector_f W0_7 = W[7];
    const vector_f W0_8 = W[8];
    const vector_f W1_0 = W[9];
    const vector_f W1_1 = W[10];
    const vector_f W1_2 = W[11];
    const vector_f W1_3 = W[12];
    const vector_f W1_4 = W[13];
    const vector_f W1_5 = W[14];
    const vector_f W1_6 = W[15];
    const vector_f W1_7 = W[16];
    const vector_f W1_8 = W[17];
    const vector_f W2_0 = W[18];
    const vector_f W2_1 = W[19];
    const vector_f W2_2 = W[20];
    const vector_f W2_3 = W[21];
    const vector_f W2_4 = W[22];
    const vector_f W2_5 = W[23];
    const vector_f W2_6 = W[24];
    const vector_f W2_7 = W[25];
    const vector_f W2_8 = W[26];
    const vector_f W3_0 = W[27];
    const vector_f W3_1 = W[28];
    const vector_f W3_2 = W[29];
    const vector_f W3_3 = W[30];
    const vector_f W3_4 = W[31];
    const vector_f W3_5 = W[32];
    const vector_f W3_6 = W[33];
    const vector_f W3_7 = W[34];
    const vector_f W3_8 = W[35];
    const vector_f W4_0 = W[36];
    const vector_f W4_1 = W[37];
    const vector_f W4_2 = W[38];
    const vector_f W4_3 = W[39];
    const vector_f W4_4 = W[40];
    const vector_f W4_5 = W[41];
    const vector_f W4_6 = W[42];
    const vector_f W4_7 = W[43];
    const vector_f W4_8 = W[44];
    const vector_f W5_0 = W[45];
    const vector_f W5_1 = W[46];
    const vector_f W5_2 = W[47];
    const vector_f W5_3 = W[48];
    const vector_f W5_4 = W[49];
    const vector_f W5_5 = W[50];
    const vector_f W5_6 = W[51];
    const vector_f W5_7 = W[52];
    const vector_f W5_8 = W[53];
    const vector_f W6_0 = W[54];
    const vector_f W6_1 = W[55];
    const vector_f W6_2 = W[56];
    const vector_f W6_3 = W[57];
    const vector_f W6_4 = W[58];
    const vector_f W6_5 = W[59];
    const vector_f W6_6 = W[60];
    const vector_f W6_7 = W[61];
    const vector_f W6_8 = W[62];
    const vector_f W7_0 = W[63];
    const vector_f W7_1 = W[64];
    const vector_f W7_2 = W[65];
    const vector_f W7_3 = W[66];
    const vector_f W7_4 = W[67];
    const vector_f W7_5 = W[68];
    const vector_f W7_6 = W[69];
    const vector_f W7_7 = W[70];
    const vector_f W7_8 = W[71];
    const vector_f W8_0 = W[72];
    const vector_f W8_1 = W[73];
    const vector_f W8_2 = W[74];
    const vector_f W8_3 = W[75];
    const vector_f W8_4 = W[76];
    const vector_f W8_5 = W[77];
    const vector_f W8_6 = W[78];
    const vector_f W8_7 = W[79];
    const vector_f W8_8 = W[80];
    const vector_f its_amplitude = amplitude[0];
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
    S[12] = W0_3;
    S[13] = W0_4;
    S[14] = W0_5;
    S[15] = W0_6;
    S[16] = W0_7;
    S[17] = W0_8;
    S[18] = W1_0;
    S[19] = W1_1;
    S[20] = W1_2;
    S[21] = W1_3;
    S[22] = W1_4;
    S[23] = W1_5;
    S[24] = W1_6;
    S[25] = W1_7;
    S[26] = W1_8;
    S[27] = W2_0;
    S[28] = W2_1;
    S[29] = W2_2;
    S[30] = W2_3;
    S[31] = W2_4;
    S[32] = W2_5;
    S[33] = W2_6;
    S[34] = W2_7;
    S[35] = W2_8;
    S[36] = W3_0;
    S[37] = W3_1;
    S[38] = W3_2;
    S[39] = W3_3;
    S[40] = W3_4;
    S[41] = W3_5;
    S[42] = W3_6;
    S[43] = W3_7;
    S[44] = W3_8;
    S[45] = W4_0;
    S[46] = W4_1;
    S[47] = W4_2;
    S[48] = W4_3;
    S[49] = W4_4;
    S[50] = W4_5;
    S[51] = W4_6;
    S[52] = W4_7;
    S[53] = W4_8;
    S[54] = W5_0;
    S[55] = W5_1;
    S[56] = W5_2;
    S[57] = W5_3;
    S[58] = W5_4;
    S[59] = W5_5;
    S[60] = W5_6;
    S[61] = W5_7;
    S[62] = W5_8;
    S[63] = W6_0;
    S[64] = W6_1;
    S[65] = W6_2;
    S[66] = W6_3;
    S[67] = W6_4;
    S[68] = W6_5;
    S[69] = W6_6;
    S[70] = W6_7;
    S[71] = W6_8;
    S[72] = W7_0;
    S[73] = W7_1;
    S[74] = W7_2;
    S[75] = W7_3;
    S[76] = W7_4;
    S[77] = W7_5;
    S[78] = W7_6;
    S[79] = W7_7;
    S[80] = W7_8;
    S[81] = W8_0;
    S[82] = W8_1;
    S[83] = W8_2;
    S[84] = W8_3;
    S[85] = W8_4;
    S[86] = W8_5;
    S[87] = W8_6;
    S[88] = W8_7;
    S[89] = W8_8;
    S[90] = its_amplitude;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_value_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values) {
    struct { vector_f phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 91 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float mu7 = S[7];
        const float mu8 = S[8];
        const float W0_0 = S[9];
        const float W0_1 = S[10];
        const float W0_2 = S[11];
        const float W0_3 = S[12];
        const float W0_4 = S[13];
        const float W0_5 = S[14];
        const float W0_6 = S[15];
        const float W0_7 = S[16];
        const float W0_8 = S[17];
        const float W1_0 = S[18];
        const float W1_1 = S[19];
        const float W1_2 = S[20];
        const float W1_3 = S[21];
        const float W1_4 = S[22];
        const float W1_5 = S[23];
        const float W1_6 = S[24];
        const float W1_7 = S[25];
        const float W1_8 = S[26];
        const float W2_0 = S[27];
        const float W2_1 = S[28];
        const float W2_2 = S[29];
        const float W2_3 = S[30];
        const float W2_4 = S[31];
        const float W2_5 = S[32];
        const float W2_6 = S[33];
        const float W2_7 = S[34];
        const float W2_8 = S[35];
        const float W3_0 = S[36];
        const float W3_1 = S[37];
        const float W3_2 = S[38];
        const float W3_3 = S[39];
        const float W3_4 = S[40];
        const float W3_5 = S[41];
        const float W3_6 = S[42];
        const float W3_7 = S[43];
        const float W3_8 = S[44];
        const float W4_0 = S[45];
        const float W4_1 = S[46];
        const float W4_2 = S[47];
        const float W4_3 = S[48];
        const float W4_4 = S[49];
        const float W4_5 = S[50];
        const float W4_6 = S[51];
        const float W4_7 = S[52];
        const float W4_8 = S[53];
        const float W5_0 = S[54];
        const float W5_1 = S[55];
        const float W5_2 = S[56];
        const float W5_3 = S[57];
        const float W5_4 = S[58];
        const float W5_5 = S[59];
        const float W5_6 = S[60];
        const float W5_7 = S[61];
        const float W5_8 = S[62];
        const float W6_0 = S[63];
        const float W6_1 = S[64];
        const float W6_2 = S[65];
        const float W6_3 = S[66];
        const float W6_4 = S[67];
        const float W6_5 = S[68];
        const float W6_6 = S[69];
        const float W6_7 = S[70];
        const float W6_8 = S[71];
        const float W7_0 = S[72];
        const float W7_1 = S[73];
        const float W7_2 = S[74];
        const float W7_3 = S[75];
        const float W7_4 = S[76];
        const float W7_5 = S[77];
        const float W7_6 = S[78];
        const float W7_7 = S[79];
        const float W7_8 = S[80];
        const float W8_0 = S[81];
        const float W8_1 = S[82];
        const float W8_2 = S[83];
        const float W8_3 = S[84];
        const float W8_4 = S[85];
        const float W8_5 = S[86];
        const float W8_6 = S[87];
        const float W8_7 = S[88];
        const float W8_8 = S[89];
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
            const vector_f v0 = x0 - mu0;
            const vector_f v1 = x1 - mu1;
            const vector_f gap = x2 - mu2;
            const vector_f round_2 = round_each_f(0.15915494309189535f * gap);
            const vector_f v2 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
            const vector_f gap_2 = x3 - mu3;
            const vector_f round_3 = round_each_f(0.15915494309189535f * gap_2);
            const vector_f v3 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
            const vector_f gap_3 = x4 - mu4;
            const vector_f round_4 = round_each_f(0.15915494309189535f * gap_3);
            const vector_f v4 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
            const vector_f total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
            const vector_f gap_4 = x5 - mu5;
            const vector_f round_5 = round_each_f(0.15915494309189535f * gap_4);
            const vector_f v5 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
            const vector_f gap_5 = x6 - mu6;
            const vector_f round_6 = round_each_f(0.15915494309189535f * gap_5);
            const vector_f v6 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
            const vector_f gap_6 = x7 - mu7;
            const vector_f round_7 = round_each_f(0.15915494309189535f * gap_6);
            const vector_f v7 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
            const vector_f gap_7 = x8 - mu8;
            const vector_f round_8 = round_each_f(0.15915494309189535f * gap_7);
            const vector_f v8 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
            const vector_f z0 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
            const vector_f total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
            const vector_f z1 = total_3 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
            const vector_f total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
            const vector_f z2 = total_4 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
            const vector_f total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
            const vector_f z3 = total_5 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
            const vector_f total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
            const vector_f z4 = total_6 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
            const vector_f total_7 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
            const vector_f total_8 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
            const vector_f z5 = total_8 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
            const vector_f total_9 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
            const vector_f z6 = total_9 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
            const vector_f total_10 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
            const vector_f z7 = total_10 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
            const vector_f total_11 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
            const vector_f z8 = total_11 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
            const vector_f total_12 = total_7 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
            const vector_f phi = gaussian_each_f(total_12);
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 91 * near[k];
        const float amplitude = S[90];
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
    struct { vector_f z0, z1, z2, z3, z4, z5, z6, z7, z8, phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 91 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float mu7 = S[7];
        const float mu8 = S[8];
        const float W0_0 = S[9];
        const float W0_1 = S[10];
        const float W0_2 = S[11];
        const float W0_3 = S[12];
        const float W0_4 = S[13];
        const float W0_5 = S[14];
        const float W0_6 = S[15];
        const float W0_7 = S[16];
        const float W0_8 = S[17];
        const float W1_0 = S[18];
        const float W1_1 = S[19];
        const float W1_2 = S[20];
        const float W1_3 = S[21];
        const float W1_4 = S[22];
        const float W1_5 = S[23];
        const float W1_6 = S[24];
        const float W1_7 = S[25];
        const float W1_8 = S[26];
        const float W2_0 = S[27];
        const float W2_1 = S[28];
        const float W2_2 = S[29];
        const float W2_3 = S[30];
        const float W2_4 = S[31];
        const float W2_5 = S[32];
        const float W2_6 = S[33];
        const float W2_7 = S[34];
        const float W2_8 = S[35];
        const float W3_0 = S[36];
        const float W3_1 = S[37];
        const float W3_2 = S[38];
        const float W3_3 = S[39];
        const float W3_4 = S[40];
        const float W3_5 = S[41];
        const float W3_6 = S[42];
        const float W3_7 = S[43];
        const float W3_8 = S[44];
        const float W4_0 = S[45];
        const float W4_1 = S[46];
        const float W4_2 = S[47];
        const float W4_3 = S[48];
        const float W4_4 = S[49];
        const float W4_5 = S[50];
        const float W4_6 = S[51];
        const float W4_7 = S[52];
        const float W4_8 = S[53];
        const float W5_0 = S[54];
        const float W5_1 = S[55];
        const float W5_2 = S[56];
        const float W5_3 = S[57];
        const float W5_4 = S[58];
        const float W5_5 = S[59];
        const float W5_6 = S[60];
        const float W5_7 = S[61];
        const float W5_8 = S[62];
        const float W6_0 = S[63];
        const float W6_1 = S[64];
        const float W6_2 = S[65];
        const float W6_3 = S[66];
        const float W6_4 = S[67];
        const float W6_5 = S[68];
        const float W6_6 = S[69];
        const float W6_7 = S[70];
        const float W6_8 = S[71];
        const float W7_0 = S[72];
        const float W7_1 = S[73];
        const float W7_2 = S[74];
        const float W7_3 = S[75];
        const float W7_4 = S[76];
        const float W7_5 = S[77];
        const float W7_6 = S[78];
        const float W7_7 = S[79];
        const float W7_8 = S[80];
        const float W8_0 = S[81];
        const float W8_1 = S[82];
        const float W8_2 = S[83];
        const float W8_3 = S[84];
        const float W8_4 = S[85];
        const float W8_5 = S[86];
        const float W8_6 = S[87];
        const float W8_7 = S[88];
        const float W8_8 = S[89];
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
            const vector_f v0 = x0 - mu0;
            const vector_f v1 = x1 - mu1;
            const vector_f gap = x2 - mu2;
            const vector_f round_2 = round_each_f(0.15915494309189535f * gap);
            const vector_f v2 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
            const vector_f gap_2 = x3 - mu3;
            const vector_f round_3 = round_each_f(0.15915494309189535f * gap_2);
            const vector_f v3 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
            const vector_f gap_3 = x4 - mu4;
            const vector_f round_4 = round_each_f(0.15915494309189535f * gap_3);
            const vector_f v4 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
            const vector_f total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
            const vector_f gap_4 = x5 - mu5;
            const vector_f round_5 = round_each_f(0.15915494309189535f * gap_4);
            const vector_f v5 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
            const vector_f gap_5 = x6 - mu6;
            const vector_f round_6 = round_each_f(0.15915494309189535f * gap_5);
            const vector_f v6 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
            const vector_f gap_6 = x7 - mu7;
            const vector_f round_7 = round_each_f(0.15915494309189535f * gap_6);
            const vector_f v7 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
            const vector_f gap_7 = x8 - mu8;
            const vector_f round_8 = round_each_f(0.15915494309189535f * gap_7);
            const vector_f v8 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
            const vector_f z0 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
            const vector_f total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
            const vector_f z1 = total_3 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
            const vector_f total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
            const vector_f z2 = total_4 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
            const vector_f total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
            const vector_f z3 = total_5 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
            const vector_f total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
            const vector_f z4 = total_6 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
            const vector_f total_7 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
            const vector_f total_8 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
            const vector_f z5 = total_8 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
            const vector_f total_9 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
            const vector_f z6 = total_9 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
            const vector_f total_10 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
            const vector_f z7 = total_10 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
            const vector_f total_11 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
            const vector_f z8 = total_11 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
            const vector_f total_12 = total_7 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
            const vector_f phi = gaussian_each_f(total_12);
            kept[k][b].z0 = z0;
            kept[k][b].z1 = z1;
            kept[k][b].z2 = z2;
            kept[k][b].z3 = z3;
            kept[k][b].z4 = z4;
            kept[k][b].z5 = z5;
            kept[k][b].z6 = z6;
            kept[k][b].z7 = z7;
            kept[k][b].z8 = z8;
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 91 * near[k];
        const float W0_0 = S[9];
        const float W0_1 = S[10];
        const float W0_2 = S[11];
        const float W0_3 = S[12];
        const float W0_4 = S[13];
        const float W0_5 = S[14];
        const float W0_6 = S[15];
        const float W0_7 = S[16];
        const float W0_8 = S[17];
        const float W1_0 = S[18];
        const float W1_1 = S[19];
        const float W1_2 = S[20];
        const float W1_3 = S[21];
        const float W1_4 = S[22];
        const float W1_5 = S[23];
        const float W1_6 = S[24];
        const float W1_7 = S[25];
        const float W1_8 = S[26];
        const float W2_0 = S[27];
        const float W2_1 = S[28];
        const float W2_2 = S[29];
        const float W2_3 = S[30];
        const float W2_4 = S[31];
        const float W2_5 = S[32];
        const float W2_6 = S[33];
        const float W2_7 = S[34];
        const float W2_8 = S[35];
        const float W3_0 = S[36];
        const float W3_1 = S[37];
        const float W3_2 = S[38];
        const float W3_3 = S[39];
        const float W3_4 = S[40];
        const float W3_5 = S[41];
        const float W3_6 = S[42];
        const float W3_7 = S[43];
        const float W3_8 = S[44];
        const float W4_0 = S[45];
        const float W4_1 = S[46];
        const float W4_2 = S[47];
        const float W4_3 = S[48];
        const float W4_4 = S[49];
        const float W4_5 = S[50];
        const float W4_6 = S[51];
        const float W4_7 = S[52];
        const float W4_8 = S[53];
        const float W5_0 = S[54];
        const float W5_1 = S[55];
        const float W5_2 = S[56];
        const float W5_3 = S[57];
        const float W5_4 = S[58];
        const float W5_5 = S[59];
        const float W5_6 = S[60];
        const float W5_7 = S[61];
        const float W5_8 = S[62];
        const float W6_0 = S[63];
        const float W6_1 = S[64];
        const float W6_2 = S[65];
        const float W6_3 = S[66];
        const float W6_4 = S[67];
        const float W6_5 = S[68];
        const float W6_6 = S[69];
        const float W6_7 = S[70];
        const float W6_8 = S[71];
        const float W7_0 = S[72];
        const float W7_1 = S[73];
        const float W7_2 = S[74];
        const float W7_3 = S[75];
        const float W7_4 = S[76];
        const float W7_5 = S[77];
        const float W7_6 = S[78];
        const float W7_7 = S[79];
        const float W7_8 = S[80];
        const float W8_0 = S[81];
        const float W8_1 = S[82];
        const float W8_2 = S[83];
        const float W8_3 = S[84];
        const float W8_4 = S[85];
        const float W8_5 = S[86];
        const float W8_6 = S[87];
        const float W8_7 = S[88];
        const float W8_8 = S[89];
        const float amplitude = S[90];
        UNROLLED for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            vector_f *slope = slopes + 9 * b;
            const vector_f z0 = kept[k][b].z0;
            const vector_f z1 = kept[k][b].z1;
            const vector_f z2 = kept[k][b].z2;
            const vector_f z3 = kept[k][b].z3;
            const vector_f z4 = kept[k][b].z4;
            const vector_f z5 = kept[k][b].z5;
            const vector_f z6 = kept[k][b].z6;
            const vector_f z7 = kept[k][b].z7;
            const vector_f z8 = kept[k][b].z8;
            const vector_f phi = kept[k][b].phi;
            const vector_f phi_2 = amplitude * phi;
            const vector_f z8_product = z8 * phi_2;
            const vector_f z7_product = z7 * phi_2;
            const vector_f z6_product = z6 * phi_2;
            const vector_f z5_product = z5 * phi_2;
            const vector_f z4_product = z4 * phi_2;
            const vector_f z3_product = z3 * phi_2;
            const vector_f z2_product = z2 * phi_2;
            const vector_f z1_product = z1 * phi_2;
            const vector_f z0_product = z0 * phi_2;
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] - W8_0 * z8_product - W7_0 * z7_product - W6_0 * z6_product - W5_0 * z5_product - W4_0
                    * z4_product - W3_0 * z3_product - W2_0 * z2_product - W1_0 * z1_product - W0_0 * z0_product;
            slope[1] = slope[1] - W8_1 * z8_product - W7_1 * z7_product - W6_1 * z6_product - W5_1 * z5_product - W4_1
                    * z4_product - W3_1 * z3_product - W2_1 * z2_product - W1_1 * z1_product - W0_1 * z0_product;
            slope[2] = slope[2] - W8_2 * z8_product - W7_2 * z7_product - W6_2 * z6_product - W5_2 * z5_product - W4_2
                    * z4_product - W3_2 * z3_product - W2_2 * z2_product - W1_2 * z1_product - W0_2 * z0_product;
            slope[3] = slope[3] - W8_3 * z8_product - W7_3 * z7_product - W6_3 * z6_product - W5_3 * z5_product - W4_3
                    * z4_product - W3_3 * z3_product - W2_3 * z2_product - W1_3 * z1_product - W0_3 * z0_product;
            slope[4] = slope[4] - W8_4 * z8_product - W7_4 * z7_product - W6_4 * z6_product - W5_4 * z5_product - W4_4
                    * z4_product - W3_4 * z3_product - W2_4 * z2_product - W1_4 * z1_product - W0_4 * z0_product;
            slope[5] = slope[5] - W8_5 * z8_product - W7_5 * z7_product - W6_5 * z6_product - W5_5 * z5_product - W4_5
                    * z4_product - W3_5 * z3_product - W2_5 * z2_product - W1_5 * z1_product - W0_5 * z0_product;
            slope[6] = slope[6] - W8_6 * z8_product - W7_6 * z7_product - W6_6 * z6_product - W5_6 * z5_product - W4_6
                    * z4_product - W3_6 * z3_product - W2_6 * z2_product - W1_6 * z1_product - W0_6 * z0_product;
            slope[7] = slope[7] - W8_7 * z8_product - W7_7 * z7_product - W6_7 * z6_product - W5_7 * z5_product - W4_7
                    * z4_product - W3_7 * z3_product - W2_7 * z2_product - W1_7 * z1_product - W0_7 * z0_product;
            slope[8] = slope[8] - W8_8 * z8_product - W7_8 * z7_product - W6_8 * z6_product - W5_8 * z5_product - W4_8
                    * z4_product - W3_8 * z3_product - W2_8 * z2_product - W1_8 * z1_product - W0_8 * z0_product;
        }
    }
}

/* The Riemannian gradient at some points, of the sums of slopes. */
OUTLINE void pair_gradient_f(
    const vector_f *x, const vector_f *slope, vector_f *gradient) {
    (void)x;
    const vector_f slope_x0 = slope[0];
    const vector_f slope_x1 = slope[1];
    const vector_f slope_x2 = slope[2];
    const vector_f slope_x3 = slope[3];
    const vector_f slope_x4 = slope[4];
    const vector_f slope_x5 = slope[5];
    const vector_f slope_x6 = slope[6];
    const vector_f slope_x7 = slope[7];
    const vector_f slope_x8 = slope[8];
    gradient[0] = slope_x0;
    gradient[1] = slope_x1;
    gradient[2] = 4.0f * slope_x2;
    gradient[3] = 16.0f * slope_x3;
    gradient[4] = 16.0f * slope_x4;
    gradient[5] = 16.0f * slope_x5;
    gradient[6] = 16.0f * slope_x6;
    gradient[7] = 16.0f * slope_x7;
    gradient[8] = 16.0f * slope_x8;
}

/* The adjoint of slope at some points, of that of the gradient. */
OUTLINE void pair_gradient_vjp_f(
    const vector_f *x, const vector_f *gradient_bar, vector_f *slope_bar) {
    (void)x;
    const vector_f gradient_bar0 = gradient_bar[0];
    const vector_f gradient_bar1 = gradient_bar[1];
    const vector_f gradient_bar2 = gradient_bar[2];
    const vector_f gradient_bar3 = gradient_bar[3];
    const vector_f gradient_bar4 = gradient_bar[4];
    const vector_f gradient_bar5 = gradient_bar[5];
    const vector_f gradient_bar6 = gradient_bar[6];
    const vector_f gradient_bar7 = gradient_bar[7];
    const vector_f gradient_bar8 = gradient_bar[8];
    slope_bar[0] = gradient_bar0;
    slope_bar[1] = gradient_bar1;
    slope_bar[2] = 4.0f * gradient_bar2;
    slope_bar[3] = 16.0f * gradient_bar3;
    slope_bar[4] = 16.0f * gradient_bar4;
    slope_bar[5] = 16.0f * gradient_bar5;
    slope_bar[6] = 16.0f * gradient_bar6;
    slope_bar[7] = 16.0f * gradient_bar7;
    slope_bar[8] = 16.0f * gradient_bar8;
}

/*
 * The factors of whose products are what is summed over the points, for some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_factors_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *factors) {
    struct { vector_f v0, v1, v2, v3, v4, v5, v6, v7, v8, z0, z1, z2, z3, z4, z5, z6, z7, z8, phi; } kept[10];
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
        const float W0_0 = S[9];
        const float W0_1 = S[10];
        const float W0_2 = S[11];
        const float W0_3 = S[12];
        const float W0_4 = S[13];
        const float W0_5 = S[14];
        const float W0_6 = S[15];
        const float W0_7 = S[16];
        const float W0_8 = S[17];
        const float W1_0 = S[18];
        const float W1_1 = S[19];
        const float W1_2 = S[20];
        const float W1_3 = S[21];
        const float W1_4 = S[22];
        const float W1_5 = S[23];
        const float W1_6 = S[24];
        const float W1_7 = S[25];
        const float W1_8 = S[26];
        const float W2_0 = S[27];
        const float W2_1 = S[28];
        const float W2_2 = S[29];
        const float W2_3 = S[30];
        const float W2_4 = S[31];
        const float W2_5 = S[32];
        const float W2_6 = S[33];
        const float W2_7 = S[34];
        const float W2_8 = S[35];
        const float W3_0 = S[36];
        const float W3_1 = S[37];
        const float W3_2 = S[38];
        const float W3_3 = S[39];
        const float W3_4 = S[40];
        const float W3_5 = S[41];
        const float W3_6 = S[42];
        const float W3_7 = S[43];
        const float W3_8 = S[44];
        const float W4_0 = S[45];
        const float W4_1 = S[46];
        const float W4_2 = S[47];
        const float W4_3 = S[48];
        const float W4_4 = S[49];
        const float W4_5 = S[50];
        const float W4_6 = S[51];
        const float W4_7 = S[52];
        const float W4_8 = S[53];
        const float W5_0 = S[54];
        const float W5_1 = S[55];
        const float W5_2 = S[56];
        const float W5_3 = S[57];
        const float W5_4 = S[58];
        const float W5_5 = S[59];
        const float W5_6 = S[60];
        const float W5_7 = S[61];
        const float W5_8 = S[62];
        const float W6_0 = S[63];
        const float W6_1 = S[64];
        const float W6_2 = S[65];
        const float W6_3 = S[66];
        const float W6_4 = S[67];
        const float W6_5 = S[68];
        const float W6_6 = S[69];
        const float W6_7 = S[70];
        const float W6_8 = S[71];
        const float W7_0 = S[72];
        const float W7_1 = S[73];
        const float W7_2 = S[74];
        const float W7_3 = S[75];
        const float W7_4 = S[76];
        const float W7_5 = S[77];
        const float W7_6 = S[78];
        const float W7_7 = S[79];
        const float W7_8 = S[80];
        const float W8_0 = S[81];
        const float W8_1 = S[82];
        const float W8_2 = S[83];
        const float W8_3 = S[84];
        const float W8_4 = S[85];
        const float W8_5 = S[86];
        const float W8_6 = S[87];
        const float W8_7 = S[88];
        const float W8_8 = S[89];
        const vector_f v0 = x0 - mu0;
        const vector_f v1 = x1 - mu1;
        const vector_f gap = x2 - mu2;
        const vector_f round_2 = round_each_f(0.15915494309189535f * gap);
        const vector_f v2 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
        const vector_f gap_2 = x3 - mu3;
        const vector_f round_3 = round_each_f(0.15915494309189535f * gap_2);
        const vector_f v3 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
        const vector_f gap_3 = x4 - mu4;
        const vector_f round_4 = round_each_f(0.15915494309189535f * gap_3);
        const vector_f v4 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
        const vector_f total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
        const vector_f gap_4 = x5 - mu5;
        const vector_f round_5 = round_each_f(0.15915494309189535f * gap_4);
        const vector_f v5 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
        const vector_f gap_5 = x6 - mu6;
        const vector_f round_6 = round_each_f(0.15915494309189535f * gap_5);
        const vector_f v6 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
        const vector_f gap_6 = x7 - mu7;
        const vector_f round_7 = round_each_f(0.15915494309189535f * gap_6);
        const vector_f v7 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
        const vector_f gap_7 = x8 - mu8;
        const vector_f round_8 = round_each_f(0.15915494309189535f * gap_7);
        const vector_f v8 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
        const vector_f z0 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
        const vector_f total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
        const vector_f z1 = total_3 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
        const vector_f total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
        const vector_f z2 = total_4 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
        const vector_f total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
        const vector_f z3 = total_5 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
        const vector_f total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
        const vector_f z4 = total_6 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
        const vector_f total_7 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
        const vector_f total_8 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
        const vector_f z5 = total_8 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
        const vector_f total_9 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
        const vector_f z6 = total_9 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
        const vector_f total_10 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
        const vector_f z7 = total_10 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
        const vector_f total_11 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
        const vector_f z8 = total_11 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
        const vector_f total_12 = total_7 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
        const vector_f phi = gaussian_each_f(total_12);
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].v2 = v2;
        kept[i].v3 = v3;
        kept[i].v4 = v4;
        kept[i].v5 = v5;
        kept[i].v6 = v6;
        kept[i].v7 = v7;
        kept[i].v8 = v8;
        kept[i].z0 = z0;
        kept[i].z1 = z1;
        kept[i].z2 = z2;
        kept[i].z3 = z3;
        kept[i].z4 = z4;
        kept[i].z5 = z5;
        kept[i].z6 = z6;
        kept[i].z7 = z7;
        kept[i].z8 = z8;
        kept[i].phi = phi;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *value_bar = points + 19 * (size_t)near[i] + 9;
        const vector_f *slope_bar = points + 19 * (size_t)near[i] + 9 + 1;
        vector_f *factor = factors + 37 * i;
        const vector_f v0 = kept[i].v0;
        const vector_f v1 = kept[i].v1;
        const vector_f v2 = kept[i].v2;
        const vector_f v3 = kept[i].v3;
        const vector_f v4 = kept[i].v4;
        const vector_f v5 = kept[i].v5;
        const vector_f v6 = kept[i].v6;
        const vector_f v7 = kept[i].v7;
        const vector_f v8 = kept[i].v8;
        const vector_f z0 = kept[i].z0;
        const vector_f z1 = kept[i].z1;
        const vector_f z2 = kept[i].z2;
        const vector_f z3 = kept[i].z3;
        const vector_f z4 = kept[i].z4;
        const vector_f z5 = kept[i].z5;
        const vector_f z6 = kept[i].z6;
        const vector_f z7 = kept[i].z7;
        const vector_f z8 = kept[i].z8;
        const vector_f phi = kept[i].phi;
        const float W0_0 = S[9];
        const float W0_1 = S[10];
        const float W0_2 = S[11];
        const float W0_3 = S[12];
        const float W0_4 = S[13];
        const float W0_5 = S[14];
        const float W0_6 = S[15];
        const float W0_7 = S[16];
        const float W0_8 = S[17];
        const float W1_0 = S[18];
        const float W1_1 = S[19];
        const float W1_2 = S[20];
        const float W1_3 = S[21];
        const float W1_4 = S[22];
        const float W1_5 = S[23];
        const float W1_6 = S[24];
        const float W1_7 = S[25];
        const float W1_8 = S[26];
        const float W2_0 = S[27];
        const float W2_1 = S[28];
        const float W2_2 = S[29];
        const float W2_3 = S[30];
        const float W2_4 = S[31];
        const float W2_5 = S[32];
        const float W2_6 = S[33];
        const float W2_7 = S[34];
        const float W2_8 = S[35];
        const float W3_0 = S[36];
        const float W3_1 = S[37];
        const float W3_2 = S[38];
        const float W3_3 = S[39];
        const float W3_4 = S[40];
        const float W3_5 = S[41];
        const float W3_6 = S[42];
        const float W3_7 = S[43];
        const float W3_8 = S[44];
        const float W4_0 = S[45];
        const float W4_1 = S[46];
        const float W4_2 = S[47];
        const float W4_3 = S[48];
        const float W4_4 = S[49];
        const float W4_5 = S[50];
        const float W4_6 = S[51];
        const float W4_7 = S[52];
        const float W4_8 = S[53];
        const float W5_0 = S[54];
        const float W5_1 = S[55];
        const float W5_2 = S[56];
        const float W5_3 = S[57];
        const float W5_4 = S[58];
        const float W5_5 = S[59];
        const float W5_6 = S[60];
        const float W5_7 = S[61];
        const float W5_8 = S[62];
        const float W6_0 = S[63];
        const float W6_1 = S[64];
        const float W6_2 = S[65];
        const float W6_3 = S[66];
        const float W6_4 = S[67];
        const float W6_5 = S[68];
        const float W6_6 = S[69];
        const float W6_7 = S[70];
        const float W6_8 = S[71];
        const float W7_0 = S[72];
        const float W7_1 = S[73];
        const float W7_2 = S[74];
        const float W7_3 = S[75];
        const float W7_4 = S[76];
        const float W7_5 = S[77];
        const float W7_6 = S[78];
        const float W7_7 = S[79];
        const float W7_8 = S[80];
        const float W8_0 = S[81];
        const float W8_1 = S[82];
        const float W8_2 = S[83];
        const float W8_3 = S[84];
        const float W8_4 = S[85];
        const float W8_5 = S[86];
        const float W8_6 = S[87];
        const float W8_7 = S[88];
        const float W8_8 = S[89];
        const vector_f its_value_bar = value_bar[0];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_f x2_bar = slope_bar[2];
        const vector_f x3_bar = slope_bar[3];
        const vector_f x4_bar = slope_bar[4];
        const vector_f x5_bar = slope_bar[5];
        const vector_f x6_bar = slope_bar[6];
        const vector_f x7_bar = slope_bar[7];
        const vector_f x8_bar = slope_bar[8];
        const vector_f gap_8 = -(W8_0 * x0_bar) - W8_1 * x1_bar - W8_2 * x2_bar - W8_3 * x3_bar;
        const vector_f gap_9 = gap_8 - W8_4 * x4_bar - W8_5 * x5_bar - W8_6 * x6_bar - W8_7 * x7_bar;
        const vector_f gap_10 = gap_9 - W8_8 * x8_bar;
        const vector_f gap_11 = -(W0_0 * x0_bar) - W0_1 * x1_bar - W0_2 * x2_bar - W0_3 * x3_bar;
        const vector_f gap_12 = gap_11 - W0_4 * x4_bar - W0_5 * x5_bar - W0_6 * x6_bar - W0_7 * x7_bar;
        const vector_f gap_13 = gap_12 - W0_8 * x8_bar;
        const vector_f gap_14 = -(W1_0 * x0_bar) - W1_1 * x1_bar - W1_2 * x2_bar - W1_3 * x3_bar;
        const vector_f gap_15 = gap_14 - W1_4 * x4_bar - W1_5 * x5_bar - W1_6 * x6_bar - W1_7 * x7_bar;
        const vector_f gap_16 = gap_15 - W1_8 * x8_bar;
        const vector_f gap_17 = -(W2_0 * x0_bar) - W2_1 * x1_bar - W2_2 * x2_bar - W2_3 * x3_bar;
        const vector_f gap_18 = gap_17 - W2_4 * x4_bar - W2_5 * x5_bar - W2_6 * x6_bar - W2_7 * x7_bar;
        const vector_f gap_19 = gap_18 - W2_8 * x8_bar;
        const vector_f gap_20 = -(W3_0 * x0_bar) - W3_1 * x1_bar - W3_2 * x2_bar - W3_3 * x3_bar;
        const vector_f gap_21 = gap_20 - W3_4 * x4_bar - W3_5 * x5_bar - W3_6 * x6_bar - W3_7 * x7_bar;
        const vector_f gap_22 = gap_21 - W3_8 * x8_bar;
        const vector_f total_13 = its_value_bar + z0 * gap_13 + z1 * gap_16 + z2 * gap_19 + z3 * gap_22;
        const vector_f gap_23 = -(W4_0 * x0_bar) - W4_1 * x1_bar - W4_2 * x2_bar - W4_3 * x3_bar;
        const vector_f gap_24 = gap_23 - W4_4 * x4_bar - W4_5 * x5_bar - W4_6 * x6_bar - W4_7 * x7_bar;
        const vector_f gap_25 = gap_24 - W4_8 * x8_bar;
        const vector_f gap_26 = -(W5_0 * x0_bar) - W5_1 * x1_bar - W5_2 * x2_bar - W5_3 * x3_bar;
        const vector_f gap_27 = gap_26 - W5_4 * x4_bar - W5_5 * x5_bar - W5_6 * x6_bar - W5_7 * x7_bar;
        const vector_f gap_28 = gap_27 - W5_8 * x8_bar;
        const vector_f gap_29 = -(W6_0 * x0_bar) - W6_1 * x1_bar - W6_2 * x2_bar - W6_3 * x3_bar;
        const vector_f gap_30 = gap_29 - W6_4 * x4_bar - W6_5 * x5_bar - W6_6 * x6_bar - W6_7 * x7_bar;
        const vector_f gap_31 = gap_30 - W6_8 * x8_bar;
        const vector_f gap_32 = -(W7_0 * x0_bar) - W7_1 * x1_bar - W7_2 * x2_bar - W7_3 * x3_bar;
        const vector_f gap_33 = gap_32 - W7_4 * x4_bar - W7_5 * x5_bar - W7_6 * x6_bar - W7_7 * x7_bar;
        const vector_f gap_34 = gap_33 - W7_8 * x8_bar;
        const vector_f total_14 = total_13 + z4 * gap_25 + z5 * gap_28 + z6 * gap_31 + z7 * gap_34;
        const vector_f by_phi = total_14 + z8 * gap_10;
        const vector_f phi_product = phi * by_phi;
        const vector_f by_z8 = phi * gap_10 - z8 * phi_product;
        const vector_f by_z7 = phi * gap_34 - z7 * phi_product;
        const vector_f by_z6 = phi * gap_31 - z6 * phi_product;
        const vector_f by_z5 = phi * gap_28 - z5 * phi_product;
        const vector_f by_z4 = phi * gap_25 - z4 * phi_product;
        const vector_f total_15 = W8_0 * by_z8 + W7_0 * by_z7 + W6_0 * by_z6 + W5_0 * by_z5 + W4_0 * by_z4;
        const vector_f by_z3 = phi * gap_22 - z3 * phi_product;
        const vector_f by_z2 = phi * gap_19 - z2 * phi_product;
        const vector_f by_z1 = phi * gap_16 - z1 * phi_product;
        const vector_f by_z0 = phi * gap_13 - z0 * phi_product;
        const vector_f by_v0 = total_15 + W3_0 * by_z3 + W2_0 * by_z2 + W1_0 * by_z1 + W0_0 * by_z0;
        const vector_f total_16 = W8_1 * by_z8 + W7_1 * by_z7 + W6_1 * by_z6 + W5_1 * by_z5 + W4_1 * by_z4;
        const vector_f by_v1 = total_16 + W3_1 * by_z3 + W2_1 * by_z2 + W1_1 * by_z1 + W0_1 * by_z0;
        const vector_f total_17 = W8_2 * by_z8 + W7_2 * by_z7 + W6_2 * by_z6 + W5_2 * by_z5 + W4_2 * by_z4;
        const vector_f by_v2 = total_17 + W3_2 * by_z3 + W2_2 * by_z2 + W1_2 * by_z1 + W0_2 * by_z0;
        const vector_f total_18 = W8_3 * by_z8 + W7_3 * by_z7 + W6_3 * by_z6 + W5_3 * by_z5 + W4_3 * by_z4;
        const vector_f by_v3 = total_18 + W3_3 * by_z3 + W2_3 * by_z2 + W1_3 * by_z1 + W0_3 * by_z0;
        const vector_f total_19 = W8_4 * by_z8 + W7_4 * by_z7 + W6_4 * by_z6 + W5_4 * by_z5 + W4_4 * by_z4;
        const vector_f by_v4 = total_19 + W3_4 * by_z3 + W2_4 * by_z2 + W1_4 * by_z1 + W0_4 * by_z0;
        const vector_f total_20 = W8_5 * by_z8 + W7_5 * by_z7 + W6_5 * by_z6 + W5_5 * by_z5 + W4_5 * by_z4;
        const vector_f by_v5 = total_20 + W3_5 * by_z3 + W2_5 * by_z2 + W1_5 * by_z1 + W0_5 * by_z0;
        const vector_f total_21 = W8_6 * by_z8 + W7_6 * by_z7 + W6_6 * by_z6 + W5_6 * by_z5 + W4_6 * by_z4;
        const vector_f by_v6 = total_21 + W3_6 * by_z3 + W2_6 * by_z2 + W1_6 * by_z1 + W0_6 * by_z0;
        const vector_f total_22 = W8_7 * by_z8 + W7_7 * by_z7 + W6_7 * by_z6 + W5_7 * by_z5 + W4_7 * by_z4;
        const vector_f by_v7 = total_22 + W3_7 * by_z3 + W2_7 * by_z2 + W1_7 * by_z1 + W0_7 * by_z0;
        const vector_f total_23 = W8_8 * by_z8 + W7_8 * by_z7 + W6_8 * by_z6 + W5_8 * by_z5 + W4_8 * by_z4;
        const vector_f by_v8 = total_23 + W3_8 * by_z3 + W2_8 * by_z2 + W1_8 * by_z1 + W0_8 * by_z0;
        const vector_f z0_product = z0 * phi;
        const vector_f z1_product = z1 * phi;
        const vector_f z2_product = z2 * phi;
        const vector_f z3_product = z3 * phi;
        const vector_f z4_product = z4 * phi;
        const vector_f z5_product = z5 * phi;
        const vector_f z6_product = z6 * phi;
        const vector_f z7_product = z7 * phi;
        const vector_f z8_product = z8 * phi;
        factor[0] = v0;
        factor[1] = v1;
        factor[2] = v2;
        factor[3] = v3;
        factor[4] = v4;
        factor[5] = v5;
        factor[6] = v6;
        factor[7] = v7;
        factor[8] = v8;
        factor[9] = phi_product;
        factor[10] = by_z8;
        factor[11] = by_z7;
        factor[12] = by_z6;
        factor[13] = by_z5;
        factor[14] = by_z4;
        factor[15] = by_z3;
        factor[16] = by_z2;
        factor[17] = by_z1;
        factor[18] = by_z0;
        factor[19] = -by_v0;
        factor[20] = -by_v1;
        factor[21] = -by_v2;
        factor[22] = -by_v3;
        factor[23] = -by_v4;
        factor[24] = -by_v5;
        factor[25] = -by_v6;
        factor[26] = -by_v7;
        factor[27] = -by_v8;
        factor[28] = z0_product;
        factor[29] = z1_product;
        factor[30] = z2_product;
        factor[31] = z3_product;
        factor[32] = z4_product;
        factor[33] = z5_product;
        factor[34] = z6_product;
        factor[35] = z7_product;
        factor[36] = z8_product;
    }
}

/* Adds some of the sums, as products. */
INLINE void pair_products_0_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[19];
    sum[1] = sum[1] + factor[20];
    sum[2] = sum[2] + factor[21];
    sum[3] = sum[3] + factor[22];
    sum[4] = sum[4] + factor[23];
    sum[5] = sum[5] + factor[24];
    sum[6] = sum[6] + factor[25];
    sum[7] = sum[7] + factor[26];
    sum[8] = sum[8] + factor[27];
    sum[9] = sum[9] + factor[9];
    sum[10] = sum[10] + factor[0] * factor[18] - factor[28] * point[10];
    sum[11] = sum[11] + factor[1] * factor[18] - factor[28] * point[11];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_1_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[18] - factor[28] * point[12];
    sum[1] = sum[1] + factor[3] * factor[18] - factor[28] * point[13];
    sum[2] = sum[2] + factor[4] * factor[18] - factor[28] * point[14];
    sum[3] = sum[3] + factor[5] * factor[18] - factor[28] * point[15];
    sum[4] = sum[4] + factor[6] * factor[18] - factor[28] * point[16];
    sum[5] = sum[5] + factor[7] * factor[18] - factor[28] * point[17];
    sum[6] = sum[6] + factor[8] * factor[18] - factor[28] * point[18];
    sum[7] = sum[7] + factor[2] * factor[17] - factor[29] * point[12];
    sum[8] = sum[8] + factor[3] * factor[17] - factor[29] * point[13];
    sum[9] = sum[9] + factor[4] * factor[17] - factor[29] * point[14];
    sum[10] = sum[10] + factor[5] * factor[17] - factor[29] * point[15];
    sum[11] = sum[11] + factor[6] * factor[17] - factor[29] * point[16];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_2_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[17] - factor[29] * point[10];
    sum[1] = sum[1] + factor[1] * factor[17] - factor[29] * point[11];
    sum[2] = sum[2] + factor[7] * factor[17] - factor[29] * point[17];
    sum[3] = sum[3] + factor[8] * factor[17] - factor[29] * point[18];
    sum[4] = sum[4] + factor[0] * factor[16] - factor[30] * point[10];
    sum[5] = sum[5] + factor[1] * factor[16] - factor[30] * point[11];
    sum[6] = sum[6] + factor[7] * factor[16] - factor[30] * point[17];
    sum[7] = sum[7] + factor[8] * factor[16] - factor[30] * point[18];
    sum[8] = sum[8] + factor[2] * factor[16] - factor[30] * point[12];
    sum[9] = sum[9] + factor[3] * factor[16] - factor[30] * point[13];
    sum[10] = sum[10] + factor[4] * factor[16] - factor[30] * point[14];
    sum[11] = sum[11] + factor[5] * factor[16] - factor[30] * point[15];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_3_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[6] * factor[16] - factor[30] * point[16];
    sum[1] = sum[1] + factor[6] * factor[15] - factor[31] * point[16];
    sum[2] = sum[2] + factor[0] * factor[15] - factor[31] * point[10];
    sum[3] = sum[3] + factor[1] * factor[15] - factor[31] * point[11];
    sum[4] = sum[4] + factor[2] * factor[15] - factor[31] * point[12];
    sum[5] = sum[5] + factor[3] * factor[15] - factor[31] * point[13];
    sum[6] = sum[6] + factor[4] * factor[15] - factor[31] * point[14];
    sum[7] = sum[7] + factor[5] * factor[15] - factor[31] * point[15];
    sum[8] = sum[8] + factor[7] * factor[15] - factor[31] * point[17];
    sum[9] = sum[9] + factor[8] * factor[15] - factor[31] * point[18];
    sum[10] = sum[10] + factor[0] * factor[14] - factor[32] * point[10];
    sum[11] = sum[11] + factor[1] * factor[14] - factor[32] * point[11];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_4_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[14] - factor[32] * point[12];
    sum[1] = sum[1] + factor[3] * factor[14] - factor[32] * point[13];
    sum[2] = sum[2] + factor[4] * factor[14] - factor[32] * point[14];
    sum[3] = sum[3] + factor[5] * factor[14] - factor[32] * point[15];
    sum[4] = sum[4] + factor[6] * factor[14] - factor[32] * point[16];
    sum[5] = sum[5] + factor[7] * factor[14] - factor[32] * point[17];
    sum[6] = sum[6] + factor[8] * factor[14] - factor[32] * point[18];
    sum[7] = sum[7] + factor[2] * factor[13] - factor[33] * point[12];
    sum[8] = sum[8] + factor[3] * factor[13] - factor[33] * point[13];
    sum[9] = sum[9] + factor[4] * factor[13] - factor[33] * point[14];
    sum[10] = sum[10] + factor[5] * factor[13] - factor[33] * point[15];
    sum[11] = sum[11] + factor[6] * factor[13] - factor[33] * point[16];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_5_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[13] - factor[33] * point[10];
    sum[1] = sum[1] + factor[1] * factor[13] - factor[33] * point[11];
    sum[2] = sum[2] + factor[7] * factor[13] - factor[33] * point[17];
    sum[3] = sum[3] + factor[8] * factor[13] - factor[33] * point[18];
    sum[4] = sum[4] + factor[0] * factor[12] - factor[34] * point[10];
    sum[5] = sum[5] + factor[1] * factor[12] - factor[34] * point[11];
    sum[6] = sum[6] + factor[7] * factor[12] - factor[34] * point[17];
    sum[7] = sum[7] + factor[8] * factor[12] - factor[34] * point[18];
    sum[8] = sum[8] + factor[2] * factor[12] - factor[34] * point[12];
    sum[9] = sum[9] + factor[3] * factor[12] - factor[34] * point[13];
    sum[10] = sum[10] + factor[4] * factor[12] - factor[34] * point[14];
    sum[11] = sum[11] + factor[5] * factor[12] - factor[34] * point[15];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_6_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[6] * factor[12] - factor[34] * point[16];
    sum[1] = sum[1] + factor[6] * factor[11] - factor[35] * point[16];
    sum[2] = sum[2] + factor[0] * factor[11] - factor[35] * point[10];
    sum[3] = sum[3] + factor[1] * factor[11] - factor[35] * point[11];
    sum[4] = sum[4] + factor[2] * factor[11] - factor[35] * point[12];
    sum[5] = sum[5] + factor[3] * factor[11] - factor[35] * point[13];
    sum[6] = sum[6] + factor[4] * factor[11] - factor[35] * point[14];
    sum[7] = sum[7] + factor[5] * factor[11] - factor[35] * point[15];
    sum[8] = sum[8] + factor[7] * factor[11] - factor[35] * point[17];
    sum[9] = sum[9] + factor[8] * factor[11] - factor[35] * point[18];
    sum[10] = sum[10] + factor[0] * factor[10] - factor[36] * point[10];
    sum[11] = sum[11] + factor[1] * factor[10] - factor[36] * point[11];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_7_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[10] - factor[36] * point[12];
    sum[1] = sum[1] + factor[3] * factor[10] - factor[36] * point[13];
    sum[2] = sum[2] + factor[4] * factor[10] - factor[36] * point[14];
    sum[3] = sum[3] + factor[5] * factor[10] - factor[36] * point[15];
    sum[4] = sum[4] + factor[6] * factor[10] - factor[36] * point[16];
    sum[5] = sum[5] + factor[7] * factor[10] - factor[36] * point[17];
    sum[6] = sum[6] + factor[8] * factor[10] - factor[36] * point[18];
}

/* The adjoints of some splats' parameters, of their sums over the points. */
OUTLINE void pair_constants_vjp_f(
    const vector_f *mu, const vector_f *W, const vector_f *amplitude, const vector_f *sums, vector_f *mu_bar, vector_f *W_bar, vector_f *amplitude_bar) {
    (void)mu;
    (void)W;
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
    const vector_f sum36 = sums[36];
    const vector_f sum37 = sums[37];
    const vector_f sum38 = sums[38];
    const vector_f sum39 = sums[39];
    const vector_f sum40 = sums[40];
    const vector_f sum41 = sums[41];
    const vector_f sum42 = sums[42];
    const vector_f sum43 = sums[43];
    const vector_f sum44 = sums[44];
    const vector_f sum45 = sums[45];
    const vector_f sum46 = sums[46];
    const vector_f sum47 = sums[47];
    const vector_f sum48 = sums[48];
    const vector_f sum49 = sums[49];
    const vector_f sum50 = sums[50];
    const vector_f sum51 = sums[51];
    const vector_f sum52 = sums[52];
    const vector_f sum53 = sums[53];
    const vector_f sum54 = sums[54];
    const vector_f sum55 = sums[55];
    const vector_f sum56 = sums[56];
    const vector_f sum57 = sums[57];
    const vector_f sum58 = sums[58];
    const vector_f sum59 = sums[59];
    const vector_f sum60 = sums[60];
    const vector_f sum61 = sums[61];
    const vector_f sum62 = sums[62];
    const vector_f sum63 = sums[63];
    const vector_f sum64 = sums[64];
    const vector_f sum65 = sums[65];
    const vector_f sum66 = sums[66];
    const vector_f sum67 = sums[67];
    const vector_f sum68 = sums[68];
    const vector_f sum69 = sums[69];
    const vector_f sum70 = sums[70];
    const vector_f sum71 = sums[71];
    const vector_f sum72 = sums[72];
    const vector_f sum73 = sums[73];
    const vector_f sum74 = sums[74];
    const vector_f sum75 = sums[75];
    const vector_f sum76 = sums[76];
    const vector_f sum77 = sums[77];
    const vector_f sum78 = sums[78];
    const vector_f sum79 = sums[79];
    const vector_f sum80 = sums[80];
    const vector_f sum81 = sums[81];
    const vector_f sum82 = sums[82];
    const vector_f sum83 = sums[83];
    const vector_f sum84 = sums[84];
    const vector_f sum85 = sums[85];
    const vector_f sum86 = sums[86];
    const vector_f sum87 = sums[87];
    const vector_f sum88 = sums[88];
    const vector_f sum89 = sums[89];
    const vector_f sum90 = sums[90];
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = its_amplitude * sum1;
    mu_bar[2] = its_amplitude * sum2;
    mu_bar[3] = its_amplitude * sum3;
    mu_bar[4] = its_amplitude * sum4;
    mu_bar[5] = its_amplitude * sum5;
    mu_bar[6] = its_amplitude * sum6;
    mu_bar[7] = its_amplitude * sum7;
    mu_bar[8] = its_amplitude * sum8;
    W_bar[0] = its_amplitude * sum9;
    W_bar[1] = its_amplitude * sum10;
    W_bar[2] = its_amplitude * sum11;
    W_bar[3] = its_amplitude * sum12;
    W_bar[4] = its_amplitude * sum13;
    W_bar[5] = its_amplitude * sum14;
    W_bar[6] = its_amplitude * sum15;
    W_bar[7] = its_amplitude * sum16;
    W_bar[8] = its_amplitude * sum17;
    W_bar[9] = its_amplitude * sum18;
    W_bar[10] = its_amplitude * sum19;
    W_bar[11] = its_amplitude * sum20;
    W_bar[12] = its_amplitude * sum21;
    W_bar[13] = its_amplitude * sum22;
    W_bar[14] = its_amplitude * sum23;
    W_bar[15] = its_amplitude * sum24;
    W_bar[16] = its_amplitude * sum25;
    W_bar[17] = its_amplitude * sum26;
    W_bar[18] = its_amplitude * sum27;
    W_bar[19] = its_amplitude * sum28;
    W_bar[20] = its_amplitude * sum29;
    W_bar[21] = its_amplitude * sum30;
    W_bar[22] = its_amplitude * sum31;
    W_bar[23] = its_amplitude * sum32;
    W_bar[24] = its_amplitude * sum33;
    W_bar[25] = its_amplitude * sum34;
    W_bar[26] = its_amplitude * sum35;
    W_bar[27] = its_amplitude * sum36;
    W_bar[28] = its_amplitude * sum37;
    W_bar[29] = its_amplitude * sum38;
    W_bar[30] = its_amplitude * sum39;
    W_bar[31] = its_amplitude * sum40;
    W_bar[32] = its_amplitude * sum41;
    W_bar[33] = its_amplitude * sum42;
    W_bar[34] = its_amplitude * sum43;
    W_bar[35] = its_amplitude * sum44;
    W_bar[36] = its_amplitude * sum45;
    W_bar[37] = its_amplitude * sum46;
    W_bar[38] = its_amplitude * sum47;
    W_bar[39] = its_amplitude * sum48;
    W_bar[40] = its_amplitude * sum49;
    W_bar[41] = its_amplitude * sum50;
    W_bar[42] = its_amplitude * sum51;
    W_bar[43] = its_amplitude * sum52;
    W_bar[44] = its_amplitude * sum53;
    W_bar[45] = its_amplitude * sum54;
    W_bar[46] = its_amplitude * sum55;
    W_bar[47] = its_amplitude * sum56;
    W_bar[48] = its_amplitude * sum57;
    W_bar[49] = its_amplitude * sum58;
    W_bar[50] = its_amplitude * sum59;
    W_bar[51] = its_amplitude * sum60;
    W_bar[52] = its_amplitude * sum61;
    W_bar[53] = its_amplitude * sum62;
    W_bar[54] = its_amplitude * sum63;
    W_bar[55] = its_amplitude * sum64;
    W_bar[56] = its_amplitude * sum65;
    W_bar[57] = its_amplitude * sum66;
    W_bar[58] = its_amplitude * sum67;
    W_bar[59] = its_amplitude * sum68;
    W_bar[60] = its_amplitude * sum69;
    W_bar[61] = its_amplitude * sum70;
    W_bar[62] = its_amplitude * sum71;
    W_bar[63] = its_amplitude * sum72;
    W_bar[64] = its_amplitude * sum73;
    W_bar[65] = its_amplitude * sum74;
    W_bar[66] = its_amplitude * sum75;
    W_bar[67] = its_amplitude * sum76;
    W_bar[68] = its_amplitude * sum77;
    W_bar[69] = its_amplitude * sum78;
    W_bar[70] = its_amplitude * sum79;
    W_bar[71] = its_amplitude * sum80;
    W_bar[72] = its_amplitude * sum81;
    W_bar[73] = its_amplitude * sum82;
    W_bar[74] = its_amplitude * sum83;
    W_bar[75] = its_amplitude * sum84;
    W_bar[76] = its_amplitude * sum85;
    W_bar[77] = its_amplitude * sum86;
    W_bar[78] = its_amplitude * sum87;
    W_bar[79] = its_amplitude * sum88;
    W_bar[80] = its_amplitude * sum89;
    amplitude_bar[0] = sum90;
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
    const float p7 = p[7];
    const float p8 = p[8];
    const vector_f q0 = q[0];
    const vector_f q1 = q[1];
    const vector_f q2 = q[2];
    const vector_f q3 = q[3];
    const vector_f q4 = q[4];
    const vector_f q5 = q[5];
    const vector_f q6 = q[6];
    const vector_f q7 = q[7];
    const vector_f q8 = q[8];
    const vector_f base_position_log0 = q0 - p0;
    const vector_f base_position_log1 = q1 - p1;
    const vector_f gap = q2 - p2;
    const vector_f round_2 = round_each_f(0.15915494309189535f * gap);
    const vector_f base_heading_log0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const vector_f gap_2 = q3 - p3;
    const vector_f round_3 = round_each_f(0.15915494309189535f * gap_2);
    const vector_f arm_log0 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const vector_f gap_3 = q4 - p4;
    const vector_f round_4 = round_each_f(0.15915494309189535f * gap_3);
    const vector_f arm_log1 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const vector_f gap_4 = q5 - p5;
    const vector_f round_5 = round_each_f(0.15915494309189535f * gap_4);
    const vector_f arm_log2 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const vector_f gap_5 = q6 - p6;
    const vector_f round_6 = round_each_f(0.15915494309189535f * gap_5);
    const vector_f arm_log3 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const vector_f gap_6 = q7 - p7;
    const vector_f round_7 = round_each_f(0.15915494309189535f * gap_6);
    const vector_f arm_log4 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const vector_f gap_7 = q8 - p8;
    const vector_f round_8 = round_each_f(0.15915494309189535f * gap_7);
    const vector_f arm_log5 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    const vector_f total_2 = base_position_log0 * base_position_log0 + base_position_log1 * base_position_log1
        + 0.25f * (base_heading_log0 * base_heading_log0) + 0.0625f * (arm_log0 * arm_log0) + 0.0625f *
        (arm_log1 * arm_log1);
    const vector_f total_3 = total_2 + 0.0625f * (arm_log2 * arm_log2) + 0.0625f * (arm_log3 * arm_log3) +
        0.0625f * (arm_log4 * arm_log4);
    distance[0] = sqrt_each_f(total_3 + 0.0625f * (arm_log5 * arm_log5));
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
size_t mobile_manipulator_splats_work_f(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES_f - 1) / LANES_f, blocks = (points + 2 - 1) / 2;
    const size_t places = 10 * ((splat_count + LANES_f - 1) / LANES_f + (blocks + LANES_f - 1) / LANES_f);
    return (points * 19 + places + 1) * LANES_f + 91 * splat_count;
}

static vector_f *work_points_f(float *work) {
    const uintptr_t size = sizeof(vector_f), start = (uintptr_t)work;
    return (vector_f *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const float *splat_at_f(const vector_f *splats, size_t k) {
    const size_t row = k / LANES_f;
    return (const float *)(splats + 10 * row) + (k - row * LANES_f);
}

static vector_f *work_reaches_f(float *work, size_t count) {
    return work_points_f(work) + (count + LANES_f - 1) / LANES_f * 19;
}

static vector_f *work_blocks_f(float *work, size_t count, size_t splat_count) {
    return work_reaches_f(work, count) + 10 * ((splat_count + LANES_f - 1) / LANES_f);
}

static float *work_constants_f(float *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES_f, blocks = (count + size - 1) / size;
    return (float *)(work_blocks_f(work, count, splat_count) + 10 * ((blocks + LANES_f - 1) / LANES_f));
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
    vector_f *own = splats + start / LANES_f * (9 + 1);
    vector_rows_f(width, splat_count, start, 1, own + 9);
    own[9] = own[9] * 6.3739659084374996f + vector_spoilt_f(mu, 9) + vector_spoilt_f(amplitude, 1);
    for (int i = 0; i < 9; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place_f(const float *x, size_t count, size_t start, float *place) {
    const size_t size = count - start < 2 * LANES_f ? count - start : 2 * LANES_f;
    vector_f at[2][9], spoilt = ZERO;
    for (size_t b = 0; b < 2; ++b) {
        vector_rows_f(x, count, start + b * LANES_f, 9, at[b]);
        spoilt += vector_spoilt_f(at[b], 9);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const float *middle = x + 9 * (start + i * size / 8);
        float radius = 0, column[LANES_f];
        for (size_t b = 0; b < 2; ++b) {
            vector_f distance[1];
            pair_distances_f(middle, at[b], distance);
            vector_store_f(column, distance[0]);
            for (size_t lane = 0; lane < LANES_f; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[9]) {
            for (int j = 0; j < 9; ++j) place[j] = middle[j];
            place[9] = radius;
        }
    }
    place[9] = place[9] * 1.0078125f + vector_sum_f(spoilt);
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
        const vector_f *own = splats + start / LANES_f * (9 + 1);
        vector_f distance[1];
        pair_distances_f(place, own, distance);
        const vector_mask_f far = vector_far_f(distance[0], own[9], vector_of_f(place[9]));
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
        const vector_f *own = blocks + start / group * (9 + 1);
        vector_f distance[1];
        pair_distances_f(mu, own, distance);
        const vector_mask_f far = vector_far_f(distance[0], vector_of_f(*reach), own[9]);
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
    vector_f own_mu[9], own_W[81], own_amplitude[1], S[91];
    vector_rows_f(mu, splat_count, start, 9, own_mu);
    vector_rows_f(W, splat_count, start, 81, own_W);
    vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants_f(own_mu, own_W, own_amplitude, S);
    vector_to_rows_f(S, constants, splat_count, start, 91, 91);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void mobile_manipulator_splats_f(
    size_t count, size_t splat_count, const float *MOBILE_MANIPULATOR_RESTRICT x, const float *MOBILE_MANIPULATOR_RESTRICT mu, const float *MOBILE_MANIPULATOR_RESTRICT W, const float *MOBILE_MANIPULATOR_RESTRICT amplitude, const float *MOBILE_MANIPULATOR_RESTRICT width,
    float *MOBILE_MANIPULATOR_RESTRICT value, float *MOBILE_MANIPULATOR_RESTRICT gradient, float *MOBILE_MANIPULATOR_RESTRICT work, int threads) {
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
            vector_f at[2][9], X[2 * 9], grad[9];
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
                vector_to_rows_f(grad, gradient, count, start + b * LANES_f, 9, 9);
            }
        }
        restore_denormals(mode);
    }
}

void mobile_manipulator_splats_value_f(
    size_t count, size_t splat_count, const float *MOBILE_MANIPULATOR_RESTRICT x, const float *MOBILE_MANIPULATOR_RESTRICT mu, const float *MOBILE_MANIPULATOR_RESTRICT W, const float *MOBILE_MANIPULATOR_RESTRICT amplitude, const float *MOBILE_MANIPULATOR_RESTRICT width,
    float *MOBILE_MANIPULATOR_RESTRICT value, float *MOBILE_MANIPULATOR_RESTRICT work, int threads) {
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
    vector_f at[9], grad_bar[9], slope_bar[9];
    vector_rows_f(x, count, start, 9, at);
    vector_rows_f(gradient_bar, count, start, 9, grad_bar);
    vector_rows_f(value_bar, count, start, 1, point + 9);
    pair_features_f(at, point);
    pair_gradient_vjp_f(at, grad_bar, slope_bar);
    for (int i = 0; i < 9; ++i) point[9 + 1 + i] = slope_bar[i];
    vector_end_f(count, start, 9 + 1, point + 9);
}

/* Adds what makes the derivatives, of a splat at some vectors of points: their factors, then the products of these. */
INLINE void pair_backward_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *sums) {
    vector_f factor[10 * 37];
    pair_factors_f(count, points, near, S, factor);
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_0_f(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[0] += sum[0];
        sums[1] += sum[1];
        sums[2] += sum[2];
        sums[3] += sum[3];
        sums[4] += sum[4];
        sums[5] += sum[5];
        sums[6] += sum[6];
        sums[7] += sum[7];
        sums[8] += sum[8];
        sums[90] += sum[9];
        sums[9] += sum[10];
        sums[10] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_1_f(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[11] += sum[0];
        sums[12] += sum[1];
        sums[13] += sum[2];
        sums[14] += sum[3];
        sums[15] += sum[4];
        sums[16] += sum[5];
        sums[17] += sum[6];
        sums[20] += sum[7];
        sums[21] += sum[8];
        sums[22] += sum[9];
        sums[23] += sum[10];
        sums[24] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_2_f(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[18] += sum[0];
        sums[19] += sum[1];
        sums[25] += sum[2];
        sums[26] += sum[3];
        sums[27] += sum[4];
        sums[28] += sum[5];
        sums[34] += sum[6];
        sums[35] += sum[7];
        sums[29] += sum[8];
        sums[30] += sum[9];
        sums[31] += sum[10];
        sums[32] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_3_f(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[33] += sum[0];
        sums[42] += sum[1];
        sums[36] += sum[2];
        sums[37] += sum[3];
        sums[38] += sum[4];
        sums[39] += sum[5];
        sums[40] += sum[6];
        sums[41] += sum[7];
        sums[43] += sum[8];
        sums[44] += sum[9];
        sums[45] += sum[10];
        sums[46] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_4_f(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[47] += sum[0];
        sums[48] += sum[1];
        sums[49] += sum[2];
        sums[50] += sum[3];
        sums[51] += sum[4];
        sums[52] += sum[5];
        sums[53] += sum[6];
        sums[56] += sum[7];
        sums[57] += sum[8];
        sums[58] += sum[9];
        sums[59] += sum[10];
        sums[60] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_5_f(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[54] += sum[0];
        sums[55] += sum[1];
        sums[61] += sum[2];
        sums[62] += sum[3];
        sums[63] += sum[4];
        sums[64] += sum[5];
        sums[70] += sum[6];
        sums[71] += sum[7];
        sums[65] += sum[8];
        sums[66] += sum[9];
        sums[67] += sum[10];
        sums[68] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_6_f(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[69] += sum[0];
        sums[78] += sum[1];
        sums[72] += sum[2];
        sums[73] += sum[3];
        sums[74] += sum[4];
        sums[75] += sum[5];
        sums[76] += sum[6];
        sums[77] += sum[7];
        sums[79] += sum[8];
        sums[80] += sum[9];
        sums[81] += sum[10];
        sums[82] += sum[11];
    }
    {
        vector_f sum[7] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_7_f(factor + 37 * i, points + 19 * (size_t)near[i], sum);
        sums[83] += sum[0];
        sums[84] += sum[1];
        sums[85] += sum[2];
        sums[86] += sum[3];
        sums[87] += sum[4];
        sums[88] += sum[5];
        sums[89] += sum[6];
    }
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums_f(const vector_f *points, const uint32_t *near, size_t size, const float *S, float *sums) {
    vector_f sum[91] = {ZERO};
    for (size_t b = 0; b < size; b += 10)
        pair_backward_f(size - b < 10 ? size - b : 10, points, near + b, S, sum);
    for (size_t i = 0; i < 91; ++i) sums[i] += vector_sum_f(sum[i]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void mobile_manipulator_splats_vjp_f(
    size_t count, size_t splat_count, const float *MOBILE_MANIPULATOR_RESTRICT x, const float *MOBILE_MANIPULATOR_RESTRICT mu, const float *MOBILE_MANIPULATOR_RESTRICT W, const float *MOBILE_MANIPULATOR_RESTRICT amplitude, const float *MOBILE_MANIPULATOR_RESTRICT width, const float *MOBILE_MANIPULATOR_RESTRICT value_bar, const float *MOBILE_MANIPULATOR_RESTRICT gradient_bar,
    float *MOBILE_MANIPULATOR_RESTRICT mu_bar, float *MOBILE_MANIPULATOR_RESTRICT W_bar, float *MOBILE_MANIPULATOR_RESTRICT amplitude_bar, float *MOBILE_MANIPULATOR_RESTRICT work, int threads) {
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
                for (int i = 0; i < 10; ++i) {
                    float *row = (float *)(places + block / LANES_f * 10 + i);
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
            float sums[LANES_f][91] = {{0}};
            uint32_t near[131072 / (19 * sizeof(vector_f)) + 2];
            vector_f own_mu[9], own_W[81], own_amplitude[1], own_sums[91], bars[91];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const float *reach = width ? splat_at_f(splats, k) + 9 * LANES_f : NULL;
                    const size_t some = blocks_near_f(mu + 9 * k, reach, places, first, first + size, near);
                    splat_sums_f(points + 19 * first, near, some, constants + 91 * k, sums[k - start]);
                }
            }
            vector_rows_f(mu, end, start, 9, own_mu);
            vector_rows_f(W, end, start, 81, own_W);
            vector_rows_f(amplitude, end, start, 1, own_amplitude);
            vector_rows_f(sums[0], LANES_f, 0, 91, own_sums);
            pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 9, bars + 9 + 81);
            vector_to_rows_f(bars, mu_bar, end, start, 9, 9);
            vector_to_rows_f(bars + 9, W_bar, end, start, 81, 81);
            vector_to_rows_f(bars + 9 + 81, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void mobile_manipulator_splats_rows_f(
    size_t count, size_t splat_count, const float *MOBILE_MANIPULATOR_RESTRICT x, const float *MOBILE_MANIPULATOR_RESTRICT mu, const float *MOBILE_MANIPULATOR_RESTRICT W, const float *MOBILE_MANIPULATOR_RESTRICT amplitude, const float *MOBILE_MANIPULATOR_RESTRICT value_bar, const float *MOBILE_MANIPULATOR_RESTRICT gradient_bar,
    float *MOBILE_MANIPULATOR_RESTRICT rows, float *MOBILE_MANIPULATOR_RESTRICT work, int threads) {
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
                vector_f own_mu[9], own_W[81], own_amplitude[1], own_sums[91] = {ZERO}, bars[91];
                for (int i = 0; i < 9; ++i) own_mu[i] = vector_of_f(mu[9 * k + i]);
                for (int i = 0; i < 81; ++i) own_W[i] = vector_of_f(W[81 * k + i]);
                own_amplitude[0] = vector_of_f(amplitude[k]);
                pair_backward_f(1, point, &only, constants + 91 * k, own_sums);
                pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 9, bars + 9 + 81);
                vector_to_rows_f(bars, rows + 91 * k, count, block * LANES_f, 91, 91 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

/* A coordinate to sort by. */
INLINE float order_key_f(const float *x, size_t row, size_t axis) {
    const float key = x[9 * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest_f(const float *x, const size_t *order, size_t count) {
    float low[9], high[9];
    size_t widest = 0;
    for (size_t axis = 0; axis < 9; ++axis) low[axis] = high[axis] = order_key_f(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < 9; ++axis) {
            const float key = order_key_f(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < 9; ++axis)
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

double mobile_manipulator_splats_order_f(
    size_t count, size_t splat_count, const float *MOBILE_MANIPULATOR_RESTRICT x, const float *MOBILE_MANIPULATOR_RESTRICT mu, const float *MOBILE_MANIPULATOR_RESTRICT amplitude, const float *MOBILE_MANIPULATOR_RESTRICT width,
    double limit, size_t *MOBILE_MANIPULATOR_RESTRICT order, float *MOBILE_MANIPULATOR_RESTRICT work) {
    const size_t block = 2 * LANES_f;
    vector_f *splats = work_reaches_f(work, 0);
    uint32_t near[256];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES_f) {
        vector_f own_mu[9], own_amplitude[1];
        vector_rows_f(mu, splat_count, start, 9, own_mu);
        vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks_f(x, order, count, (float *)work_blocks_f(work, 0, splat_count));
        for (size_t i = 1; i < 2 * 16; i += 2) {
            float rows[2 * LANES_f * 9], place[9 + 1];
            const size_t some = i * count / (2 * 16), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < 9; ++j) rows[9 * n + j] = x[9 * order[start + n] + j];
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
