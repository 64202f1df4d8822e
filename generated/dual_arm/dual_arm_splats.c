/*
 * dual_arm: Two arms of seven revolute joints each; distances are in radians.
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "dual_arm.h"

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
    const vector x9 = x[9];
    const vector x10 = x[10];
    const vector x11 = x[11];
    const vector x12 = x[12];
    const vector x13 = x[13];
    X[0] = x0;
    X[1] = x1;
    X[2] = x2;
    X[3] = x3;
    X[4] = x4;
    X[5] = x5;
    X[6] = x6;
    X[7] = x7;
    X[8] = x8;
    X[9] = x9;
    X[10] = x10;
    X[11] = x11;
    X[12] = x12;
    X[13] = x13;
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
    const vector mu9 = mu[9];
    const vector mu10 = mu[10];
    const vector mu11 = mu[11];
    const vector mu12 = mu[12];
    const vector mu13 = mu[13];
    const vector W0_0 = W[0];
    const vector W0_1 = W[1];
    const vector W0_2 = W[2];
    const vector W0_3 = W[3];
    const vector W0_4 = W[4];
    const vector W0_5 = W[5];
    const vector W0_6 = W[6];
    const vector W0_7 = W[7];
    const vector W0_8 = W[8];
    const vector W0_9 = W[9];
    const vector W0_10 = W[10];
    const vector W0_11 = W[11];
    const vector W0_12 = W[12];
    const vector W0_13 = W[13];
    const vector W1_0 = W[14];
    const vector W1_1 = W[15];
    const vector W1_2 = W[16];
    const vector W1_3 = W[17];
    const vector W1_4 = W[18];
    const vector W1_5 = W[19];
    const vector W1_6 = W[20];
    const vector W1_7 = W[21];
    const vector W1_8 = W[22];
    const vector W1_9 = W[23];
    const vector W1_10 = W[24];
    const vector W1_11 = W[25];
    const vector W1_12 = W[26];
    const vector W1_13 = W[27];
    const vector W2_0 = W[28];
    const vector W2_1 = W[29];
    const vector W2_2 = W[30];
    const vector W2_3 = W[31];
    const vector W2_4 = W[32];
    const vector W2_5 = W[33];
    const vector W2_6 = W[34];
    const vector W2_7 = W[35];
    const vector W2_8 = W[36];
    const vector W2_9 = W[37];
    const vector W2_10 = W[38];
    const vector W2_11 = W[39];
    const vector W2_12 = W[40];
    const vector W2_13 = W[41];
    const vector W3_0 = W[42];
    const vector W3_1 = W[43];
    const vector W3_2 = W[44];
    const vector W3_3 = W[45];
    const vector W3_4 = W[46];
    const vector W3_5 = W[47];
    const vector W3_6 = W[48];
    const vector W3_7 = W[49];
    const vector W3_8 = W[50];
    const vector W3_9 = W[51];
    const vector W3_10 = W[52];
    const vector W3_11 = W[53];
    const vector W3_12 = W[54];
    const vector W3_13 = W[55];
    const vector W4_0 = W[56];
    const vector W4_1 = W[57];
    const vector W4_2 = W[58];
    const vector W4_3 = W[59];
    const vector W4_4 = W[60];
    const vector W4_5 = W[61];
    const vector W4_6 = W[62];
    const vector W4_7 = W[63];
    const vector W4_8 = W[64];
    const vector W4_9 = W[65];
    const vector W4_10 = W[66];
    const vector W4_11 = W[67];
    const vector W4_12 = W[68];
    const vector W4_13 = W[69];
    const vector W5_0 = W[70];
    const vector W5_1 = W[71];
    const vector W5_2 = W[72];
    const vector W5_3 = W[73];
    const vector W5_4 = W[74];
    const vector W5_5 = W[75];
    const vector W5_6 = W[76];
    const vector W5_7 = W[77];
    const vector W5_8 = W[78];
    const vector W5_9 = W[79];
    const vector W5_10 = W[80];
    const vector W5_11 = W[81];
    const vector W5_12 = W[82];
    const vector W5_13 = W[83];
    const vector W6_0 = W[84];
    const vector W6_1 = W[85];
    const vector W6_2 = W[86];
    const vector W6_3 = W[87];
    const vector W6_4 = W[88];
    const vector W6_5 = W[89];
    const vector W6_6 = W[90];
    const vector W6_7 = W[91];
    const vector W6_8 = W[92];
    const vector W6_9 = W[93];
    const vector W6_10 = W[94];
    const vector W6_11 = W[95];
    const vector W6_12 = W[96];
    const vector W6_13 = W[97];
    const vector W7_0 = W[98];
    const vector W7_1 = W[99];
    const vector W7_2 = W[100];
    const vector W7_3 = W[101];
    const vector W7_4 = W[102];
    const vector W7_5 = W[103];
    const vector W7_6 = W[104];
    const vector W7_7 = W[105];
    const vector W7_8 = W[106];
    const vector W7_9 = W[107];
    const vector W7_10 = W[108];
    const vector W7_11 = W[109];
    const vector W7_12 = W[110];
    const vector W7_13 = W[111];
    const vector W8_0 = W[112];
    const vector W8_1 = W[113];
    const vector W8_2 = W[114];
    const vector W8_3 = W[115];
    const vector W8_4 = W[116];
    const vector W8_5 = W[117];
    const vector W8_6 = W[118];
    const vector W8_7 = W[119];
    const vector W8_8 = W[120];
    const vector W8_9 = W[121];
    const vector W8_10 = W[122];
    const vector W8_11 = W[123];
    const vector W8_12 = W[124];
    const vector W8_13 = W[125];
    const vector W9_0 = W[126];
    const vector W9_1 = W[127];
    const vector W9_2 = W[128];
    const vector W9_3 = W[129];
    const vector W9_4 = W[130];
    const vector W9_5 = W[131];
    const vector W9_6 = W[132];
    const vector W9_7 = W[133];
    const vector W9_8 = W[134];
    const vector W9_9 = W[135];
    const vector W9_10 = W[136];
    const vector W9_11 = W[137];
    const vector W9_12 = W[138];
    const vector W9_13 = W[139];
    const vector W10_0 = W[140];
    const vector W10_1 = W[141];
    const vector W10_2 = W[142];
    const vector W10_3 = W[143];
    const vector W10_4 = W[144];
    const vector W10_5 = W[145];
    const vector W10_6 = W[146];
    const vector W10_7 = W[147];
    const vector W10_8 = W[148];
    const vector W10_9 = W[149];
    const vector W10_10 = W[150];
    const vector W10_11 = W[151];
    const vector W10_12 = W[152];
    const vector W10_13 = W[153];
    const vector W11_0 = W[154];
    const vector W11_1 = W[155];
    const vector W11_2 = W[156];
    const vector W11_3 = W[157];
    const vector W11_4 = W[158];
    const vector W11_5 = W[159];
    const vector W11_6 = W[160];
    const vector W11_7 = W[161];
    const vector W11_8 = W[162];
    const vector W11_9 = W[163];
    const vector W11_10 = W[164];
    const vector W11_11 = W[165];
    const vector W11_12 = W[166];
    const vector W11_13 = W[167];
    const vector W12_0 = W[168];
    const vector W12_1 = W[169];
    const vector W12_2 = W[170];
    const vector W12_3 = W[171];
    const vector W12_4 = W[172];
    const vector W12_5 = W[173];
    const vector W12_6 = W[174];
    const vector W12_7 = W[175];
    const vector W12_8 = W[176];
    const vector W12_9 = W[177];
    const vector W12_10 = W[178];
    const vector W12_11 = W[179];
    const vector W12_12 = W[180];
    const vector W12_13 = W[181];
    const vector W13_0 = W[182];
    const vector W13_1 = W[183];
    const vector W13_2 = W[184];
    const vector W13_3 = W[185];
    const vector W13_4 = W[186];
    const vector W13_5 = W[187];
    const vector W13_6 = W[188];
    const vector W13_7 = W[189];
    const vector W13_8 = W[190];
    const vector W13_9 = W[191];
    const vector W13_10 = W[192];
    const vector W13_11 = W[193];
    const vector W13_12 = W[194];
    const vector W13_13 = W[195];
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
    S[9] = mu9;
    S[10] = mu10;
    S[11] = mu11;
    S[12] = mu12;
    S[13] = mu13;
    S[14] = W0_0;
    S[15] = W0_1;
    S[16] = W0_2;
    S[17] = W0_3;
    S[18] = W0_4;
    S[19] = W0_5;
    S[20] = W0_6;
    S[21] = W0_7;
    S[22] = W0_8;
    S[23] = W0_9;
    S[24] = W0_10;
    S[25] = W0_11;
    S[26] = W0_12;
    S[27] = W0_13;
    S[28] = W1_0;
    S[29] = W1_1;
    S[30] = W1_2;
    S[31] = W1_3;
    S[32] = W1_4;
    S[33] = W1_5;
    S[34] = W1_6;
    S[35] = W1_7;
    S[36] = W1_8;
    S[37] = W1_9;
    S[38] = W1_10;
    S[39] = W1_11;
    S[40] = W1_12;
    S[41] = W1_13;
    S[42] = W2_0;
    S[43] = W2_1;
    S[44] = W2_2;
    S[45] = W2_3;
    S[46] = W2_4;
    S[47] = W2_5;
    S[48] = W2_6;
    S[49] = W2_7;
    S[50] = W2_8;
    S[51] = W2_9;
    S[52] = W2_10;
    S[53] = W2_11;
    S[54] = W2_12;
    S[55] = W2_13;
    S[56] = W3_0;
    S[57] = W3_1;
    S[58] = W3_2;
    S[59] = W3_3;
    S[60] = W3_4;
    S[61] = W3_5;
    S[62] = W3_6;
    S[63] = W3_7;
    S[64] = W3_8;
    S[65] = W3_9;
    S[66] = W3_10;
    S[67] = W3_11;
    S[68] = W3_12;
    S[69] = W3_13;
    S[70] = W4_0;
    S[71] = W4_1;
    S[72] = W4_2;
    S[73] = W4_3;
    S[74] = W4_4;
    S[75] = W4_5;
    S[76] = W4_6;
    S[77] = W4_7;
    S[78] = W4_8;
    S[79] = W4_9;
    S[80] = W4_10;
    S[81] = W4_11;
    S[82] = W4_12;
    S[83] = W4_13;
    S[84] = W5_0;
    S[85] = W5_1;
    S[86] = W5_2;
    S[87] = W5_3;
    S[88] = W5_4;
    S[89] = W5_5;
    S[90] = W5_6;
    S[91] = W5_7;
    S[92] = W5_8;
    S[93] = W5_9;
    S[94] = W5_10;
    S[95] = W5_11;
    S[96] = W5_12;
    S[97] = W5_13;
    S[98] = W6_0;
    S[99] = W6_1;
    S[100] = W6_2;
    S[101] = W6_3;
    S[102] = W6_4;
    S[103] = W6_5;
    S[104] = W6_6;
    S[105] = W6_7;
    S[106] = W6_8;
    S[107] = W6_9;
    S[108] = W6_10;
    S[109] = W6_11;
    S[110] = W6_12;
    S[111] = W6_13;
    S[112] = W7_0;
    S[113] = W7_1;
    S[114] = W7_2;
    S[115] = W7_3;
    S[116] = W7_4;
    S[117] = W7_5;
    S[118] = W7_6;
    S[119] = W7_7;
    S[120] = W7_8;
    S[121] = W7_9;
    S[122] = W7_10;
    S[123] = W7_11;
    S[124] = W7_12;
    S[125] = W7_13;
    S[126] = W8_0;
    S[127] = W8_1;
    S[128] = W8_2;
    S[129] = W8_3;
    S[130] = W8_4;
    S[131] = W8_5;
    S[132] = W8_6;
    S[133] = W8_7;
    S[134] = W8_8;
    S[135] = W8_9;
    S[136] = W8_10;
    S[137] = W8_11;
    S[138] = W8_12;
    S[139] = W8_13;
    S[140] = W9_0;
    S[141] = W9_1;
    S[142] = W9_2;
    S[143] = W9_3;
    S[144] = W9_4;
    S[145] = W9_5;
    S[146] = W9_6;
    S[147] = W9_7;
    S[148] = W9_8;
    S[149] = W9_9;
    S[150] = W9_10;
    S[151] = W9_11;
    S[152] = W9_12;
    S[153] = W9_13;
    S[154] = W10_0;
    S[155] = W10_1;
    S[156] = W10_2;
    S[157] = W10_3;
    S[158] = W10_4;
    S[159] = W10_5;
    S[160] = W10_6;
    S[161] = W10_7;
    S[162] = W10_8;
    S[163] = W10_9;
    S[164] = W10_10;
    S[165] = W10_11;
    S[166] = W10_12;
    S[167] = W10_13;
    S[168] = W11_0;
    S[169] = W11_1;
    S[170] = W11_2;
    S[171] = W11_3;
    S[172] = W11_4;
    S[173] = W11_5;
    S[174] = W11_6;
    S[175] = W11_7;
    S[176] = W11_8;
    S[177] = W11_9;
    S[178] = W11_10;
    S[179] = W11_11;
    S[180] = W11_12;
    S[181] = W11_13;
    S[182] = W12_0;
    S[183] = W12_1;
    S[184] = W12_2;
    S[185] = W12_3;
    S[186] = W12_4;
    S[187] = W12_5;
    S[188] = W12_6;
    S[189] = W12_7;
    S[190] = W12_8;
    S[191] = W12_9;
    S[192] = W12_10;
    S[193] = W12_11;
    S[194] = W12_12;
    S[195] = W12_13;
    S[196] = W13_0;
    S[197] = W13_1;
    S[198] = W13_2;
    S[199] = W13_3;
    S[200] = W13_4;
    S[201] = W13_5;
    S[202] = W13_6;
    S[203] = W13_7;
    S[204] = W13_8;
    S[205] = W13_9;
    S[206] = W13_10;
    S[207] = W13_11;
    S[208] = W13_12;
    S[209] = W13_13;
    S[210] = its_amplitude;
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
        const double *S = splats + 211 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double mu7 = S[7];
        const double mu8 = S[8];
        const double mu9 = S[9];
        const double mu10 = S[10];
        const double mu11 = S[11];
        const double mu12 = S[12];
        const double mu13 = S[13];
        const double W0_0 = S[14];
        const double W0_1 = S[15];
        const double W0_2 = S[16];
        const double W0_3 = S[17];
        const double W0_4 = S[18];
        const double W0_5 = S[19];
        const double W0_6 = S[20];
        const double W0_7 = S[21];
        const double W0_8 = S[22];
        const double W0_9 = S[23];
        const double W0_10 = S[24];
        const double W0_11 = S[25];
        const double W0_12 = S[26];
        const double W0_13 = S[27];
        const double W1_0 = S[28];
        const double W1_1 = S[29];
        const double W1_2 = S[30];
        const double W1_3 = S[31];
        const double W1_4 = S[32];
        const double W1_5 = S[33];
        const double W1_6 = S[34];
        const double W1_7 = S[35];
        const double W1_8 = S[36];
        const double W1_9 = S[37];
        const double W1_10 = S[38];
        const double W1_11 = S[39];
        const double W1_12 = S[40];
        const double W1_13 = S[41];
        const double W2_0 = S[42];
        const double W2_1 = S[43];
        const double W2_2 = S[44];
        const double W2_3 = S[45];
        const double W2_4 = S[46];
        const double W2_5 = S[47];
        const double W2_6 = S[48];
        const double W2_7 = S[49];
        const double W2_8 = S[50];
        const double W2_9 = S[51];
        const double W2_10 = S[52];
        const double W2_11 = S[53];
        const double W2_12 = S[54];
        const double W2_13 = S[55];
        const double W3_0 = S[56];
        const double W3_1 = S[57];
        const double W3_2 = S[58];
        const double W3_3 = S[59];
        const double W3_4 = S[60];
        const double W3_5 = S[61];
        const double W3_6 = S[62];
        const double W3_7 = S[63];
        const double W3_8 = S[64];
        const double W3_9 = S[65];
        const double W3_10 = S[66];
        const double W3_11 = S[67];
        const double W3_12 = S[68];
        const double W3_13 = S[69];
        const double W4_0 = S[70];
        const double W4_1 = S[71];
        const double W4_2 = S[72];
        const double W4_3 = S[73];
        const double W4_4 = S[74];
        const double W4_5 = S[75];
        const double W4_6 = S[76];
        const double W4_7 = S[77];
        const double W4_8 = S[78];
        const double W4_9 = S[79];
        const double W4_10 = S[80];
        const double W4_11 = S[81];
        const double W4_12 = S[82];
        const double W4_13 = S[83];
        const double W5_0 = S[84];
        const double W5_1 = S[85];
        const double W5_2 = S[86];
        const double W5_3 = S[87];
        const double W5_4 = S[88];
        const double W5_5 = S[89];
        const double W5_6 = S[90];
        const double W5_7 = S[91];
        const double W5_8 = S[92];
        const double W5_9 = S[93];
        const double W5_10 = S[94];
        const double W5_11 = S[95];
        const double W5_12 = S[96];
        const double W5_13 = S[97];
        const double W6_0 = S[98];
        const double W6_1 = S[99];
        const double W6_2 = S[100];
        const double W6_3 = S[101];
        const double W6_4 = S[102];
        const double W6_5 = S[103];
        const double W6_6 = S[104];
        const double W6_7 = S[105];
        const double W6_8 = S[106];
        const double W6_9 = S[107];
        const double W6_10 = S[108];
        const double W6_11 = S[109];
        const double W6_12 = S[110];
        const double W6_13 = S[111];
        const double W7_0 = S[112];
        const double W7_1 = S[113];
        const double W7_2 = S[114];
        const double W7_3 = S[115];
        const double W7_4 = S[116];
        const double W7_5 = S[117];
        const double W7_6 = S[118];
        const double W7_7 = S[119];
        const double W7_8 = S[120];
        const double W7_9 = S[121];
        const double W7_10 = S[122];
        const double W7_11 = S[123];
        const double W7_12 = S[124];
        const double W7_13 = S[125];
        const double W8_0 = S[126];
        const double W8_1 = S[127];
        const double W8_2 = S[128];
        const double W8_3 = S[129];
        const double W8_4 = S[130];
        const double W8_5 = S[131];
        const double W8_6 = S[132];
        const double W8_7 = S[133];
        const double W8_8 = S[134];
        const double W8_9 = S[135];
        const double W8_10 = S[136];
        const double W8_11 = S[137];
        const double W8_12 = S[138];
        const double W8_13 = S[139];
        const double W9_0 = S[140];
        const double W9_1 = S[141];
        const double W9_2 = S[142];
        const double W9_3 = S[143];
        const double W9_4 = S[144];
        const double W9_5 = S[145];
        const double W9_6 = S[146];
        const double W9_7 = S[147];
        const double W9_8 = S[148];
        const double W9_9 = S[149];
        const double W9_10 = S[150];
        const double W9_11 = S[151];
        const double W9_12 = S[152];
        const double W9_13 = S[153];
        const double W10_0 = S[154];
        const double W10_1 = S[155];
        const double W10_2 = S[156];
        const double W10_3 = S[157];
        const double W10_4 = S[158];
        const double W10_5 = S[159];
        const double W10_6 = S[160];
        const double W10_7 = S[161];
        const double W10_8 = S[162];
        const double W10_9 = S[163];
        const double W10_10 = S[164];
        const double W10_11 = S[165];
        const double W10_12 = S[166];
        const double W10_13 = S[167];
        const double W11_0 = S[168];
        const double W11_1 = S[169];
        const double W11_2 = S[170];
        const double W11_3 = S[171];
        const double W11_4 = S[172];
        const double W11_5 = S[173];
        const double W11_6 = S[174];
        const double W11_7 = S[175];
        const double W11_8 = S[176];
        const double W11_9 = S[177];
        const double W11_10 = S[178];
        const double W11_11 = S[179];
        const double W11_12 = S[180];
        const double W11_13 = S[181];
        const double W12_0 = S[182];
        const double W12_1 = S[183];
        const double W12_2 = S[184];
        const double W12_3 = S[185];
        const double W12_4 = S[186];
        const double W12_5 = S[187];
        const double W12_6 = S[188];
        const double W12_7 = S[189];
        const double W12_8 = S[190];
        const double W12_9 = S[191];
        const double W12_10 = S[192];
        const double W12_11 = S[193];
        const double W12_12 = S[194];
        const double W12_13 = S[195];
        const double W13_0 = S[196];
        const double W13_1 = S[197];
        const double W13_2 = S[198];
        const double W13_3 = S[199];
        const double W13_4 = S[200];
        const double W13_5 = S[201];
        const double W13_6 = S[202];
        const double W13_7 = S[203];
        const double W13_8 = S[204];
        const double W13_9 = S[205];
        const double W13_10 = S[206];
        const double W13_11 = S[207];
        const double W13_12 = S[208];
        const double W13_13 = S[209];
        for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 14 * b;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector x4 = X[4];
            const vector x5 = X[5];
            const vector x6 = X[6];
            const vector x7 = X[7];
            const vector x8 = X[8];
            const vector x9 = X[9];
            const vector x10 = X[10];
            const vector x11 = X[11];
            const vector x12 = X[12];
            const vector x13 = X[13];
            const vector gap = x0 - mu0;
            const vector round_2 = round_each(0.15915494309189535 * gap);
            const vector v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
            const vector gap_2 = x1 - mu1;
            const vector round_3 = round_each(0.15915494309189535 * gap_2);
            const vector v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
            const vector gap_3 = x2 - mu2;
            const vector round_4 = round_each(0.15915494309189535 * gap_3);
            const vector v2 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
            const vector gap_4 = x3 - mu3;
            const vector round_5 = round_each(0.15915494309189535 * gap_4);
            const vector v3 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
            const vector gap_5 = x4 - mu4;
            const vector round_6 = round_each(0.15915494309189535 * gap_5);
            const vector v4 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
            const vector total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
            const vector gap_6 = x5 - mu5;
            const vector round_7 = round_each(0.15915494309189535 * gap_6);
            const vector v5 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
            const vector gap_7 = x6 - mu6;
            const vector round_8 = round_each(0.15915494309189535 * gap_7);
            const vector v6 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
            const vector gap_8 = x7 - mu7;
            const vector round_9 = round_each(0.15915494309189535 * gap_8);
            const vector v7 = gap_8 - 6.28125 * round_9 - 0.001935307179586477 * round_9;
            const vector gap_9 = x8 - mu8;
            const vector round_10 = round_each(0.15915494309189535 * gap_9);
            const vector v8 = gap_9 - 6.28125 * round_10 - 0.001935307179586477 * round_10;
            const vector total_3 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
            const vector gap_10 = x9 - mu9;
            const vector round_11 = round_each(0.15915494309189535 * gap_10);
            const vector v9 = gap_10 - 6.28125 * round_11 - 0.001935307179586477 * round_11;
            const vector gap_11 = x10 - mu10;
            const vector round_12 = round_each(0.15915494309189535 * gap_11);
            const vector v10 = gap_11 - 6.28125 * round_12 - 0.001935307179586477 * round_12;
            const vector gap_12 = x11 - mu11;
            const vector round_13 = round_each(0.15915494309189535 * gap_12);
            const vector v11 = gap_12 - 6.28125 * round_13 - 0.001935307179586477 * round_13;
            const vector gap_13 = x12 - mu12;
            const vector round_14 = round_each(0.15915494309189535 * gap_13);
            const vector v12 = gap_13 - 6.28125 * round_14 - 0.001935307179586477 * round_14;
            const vector total_4 = total_3 + W0_9 * v9 + W0_10 * v10 + W0_11 * v11 + W0_12 * v12;
            const vector gap_14 = x13 - mu13;
            const vector round_15 = round_each(0.15915494309189535 * gap_14);
            const vector v13 = gap_14 - 6.28125 * round_15 - 0.001935307179586477 * round_15;
            const vector z0 = total_4 + W0_13 * v13;
            const vector total_5 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
            const vector total_6 = total_5 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
            const vector total_7 = total_6 + W1_9 * v9 + W1_10 * v10 + W1_11 * v11 + W1_12 * v12;
            const vector z1 = total_7 + W1_13 * v13;
            const vector total_8 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
            const vector total_9 = total_8 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
            const vector total_10 = total_9 + W2_9 * v9 + W2_10 * v10 + W2_11 * v11 + W2_12 * v12;
            const vector z2 = total_10 + W2_13 * v13;
            const vector total_11 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
            const vector total_12 = total_11 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
            const vector total_13 = total_12 + W3_9 * v9 + W3_10 * v10 + W3_11 * v11 + W3_12 * v12;
            const vector z3 = total_13 + W3_13 * v13;
            const vector total_14 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
            const vector total_15 = total_14 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
            const vector total_16 = total_15 + W4_9 * v9 + W4_10 * v10 + W4_11 * v11 + W4_12 * v12;
            const vector z4 = total_16 + W4_13 * v13;
            const vector total_17 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
            const vector total_18 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
            const vector total_19 = total_18 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
            const vector total_20 = total_19 + W5_9 * v9 + W5_10 * v10 + W5_11 * v11 + W5_12 * v12;
            const vector z5 = total_20 + W5_13 * v13;
            const vector total_21 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
            const vector total_22 = total_21 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
            const vector total_23 = total_22 + W6_9 * v9 + W6_10 * v10 + W6_11 * v11 + W6_12 * v12;
            const vector z6 = total_23 + W6_13 * v13;
            const vector total_24 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
            const vector total_25 = total_24 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
            const vector total_26 = total_25 + W7_9 * v9 + W7_10 * v10 + W7_11 * v11 + W7_12 * v12;
            const vector z7 = total_26 + W7_13 * v13;
            const vector total_27 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
            const vector total_28 = total_27 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
            const vector total_29 = total_28 + W8_9 * v9 + W8_10 * v10 + W8_11 * v11 + W8_12 * v12;
            const vector z8 = total_29 + W8_13 * v13;
            const vector total_30 = total_17 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
            const vector total_31 = W9_0 * v0 + W9_1 * v1 + W9_2 * v2 + W9_3 * v3 + W9_4 * v4;
            const vector total_32 = total_31 + W9_5 * v5 + W9_6 * v6 + W9_7 * v7 + W9_8 * v8;
            const vector total_33 = total_32 + W9_9 * v9 + W9_10 * v10 + W9_11 * v11 + W9_12 * v12;
            const vector z9 = total_33 + W9_13 * v13;
            const vector total_34 = W10_0 * v0 + W10_1 * v1 + W10_2 * v2 + W10_3 * v3 + W10_4 * v4;
            const vector total_35 = total_34 + W10_5 * v5 + W10_6 * v6 + W10_7 * v7 + W10_8 * v8;
            const vector total_36 = total_35 + W10_9 * v9 + W10_10 * v10 + W10_11 * v11 + W10_12 * v12;
            const vector z10 = total_36 + W10_13 * v13;
            const vector total_37 = W11_0 * v0 + W11_1 * v1 + W11_2 * v2 + W11_3 * v3 + W11_4 * v4;
            const vector total_38 = total_37 + W11_5 * v5 + W11_6 * v6 + W11_7 * v7 + W11_8 * v8;
            const vector total_39 = total_38 + W11_9 * v9 + W11_10 * v10 + W11_11 * v11 + W11_12 * v12;
            const vector z11 = total_39 + W11_13 * v13;
            const vector total_40 = W12_0 * v0 + W12_1 * v1 + W12_2 * v2 + W12_3 * v3 + W12_4 * v4;
            const vector total_41 = total_40 + W12_5 * v5 + W12_6 * v6 + W12_7 * v7 + W12_8 * v8;
            const vector total_42 = total_41 + W12_9 * v9 + W12_10 * v10 + W12_11 * v11 + W12_12 * v12;
            const vector z12 = total_42 + W12_13 * v13;
            const vector total_43 = total_30 + z9 * z9 + z10 * z10 + z11 * z11 + z12 * z12;
            const vector total_44 = W13_0 * v0 + W13_1 * v1 + W13_2 * v2 + W13_3 * v3 + W13_4 * v4;
            const vector total_45 = total_44 + W13_5 * v5 + W13_6 * v6 + W13_7 * v7 + W13_8 * v8;
            const vector total_46 = total_45 + W13_9 * v9 + W13_10 * v10 + W13_11 * v11 + W13_12 * v12;
            const vector z13 = total_46 + W13_13 * v13;
            const vector phi = gaussian_each(total_43 + z13 * z13);
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 211 * near[k];
        const double amplitude = S[210];
        for (size_t b = 0; b < 2; ++b) {
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
OUTLINE void pair_forward(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values, vector *slopes) {
    struct { vector z0, z1, z2, z3, z4, z5, z6, z7, z8, z9, z10, z11, z12, z13, phi; } kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 211 * near[k];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double mu7 = S[7];
        const double mu8 = S[8];
        const double mu9 = S[9];
        const double mu10 = S[10];
        const double mu11 = S[11];
        const double mu12 = S[12];
        const double mu13 = S[13];
        const double W0_0 = S[14];
        const double W0_1 = S[15];
        const double W0_2 = S[16];
        const double W0_3 = S[17];
        const double W0_4 = S[18];
        const double W0_5 = S[19];
        const double W0_6 = S[20];
        const double W0_7 = S[21];
        const double W0_8 = S[22];
        const double W0_9 = S[23];
        const double W0_10 = S[24];
        const double W0_11 = S[25];
        const double W0_12 = S[26];
        const double W0_13 = S[27];
        const double W1_0 = S[28];
        const double W1_1 = S[29];
        const double W1_2 = S[30];
        const double W1_3 = S[31];
        const double W1_4 = S[32];
        const double W1_5 = S[33];
        const double W1_6 = S[34];
        const double W1_7 = S[35];
        const double W1_8 = S[36];
        const double W1_9 = S[37];
        const double W1_10 = S[38];
        const double W1_11 = S[39];
        const double W1_12 = S[40];
        const double W1_13 = S[41];
        const double W2_0 = S[42];
        const double W2_1 = S[43];
        const double W2_2 = S[44];
        const double W2_3 = S[45];
        const double W2_4 = S[46];
        const double W2_5 = S[47];
        const double W2_6 = S[48];
        const double W2_7 = S[49];
        const double W2_8 = S[50];
        const double W2_9 = S[51];
        const double W2_10 = S[52];
        const double W2_11 = S[53];
        const double W2_12 = S[54];
        const double W2_13 = S[55];
        const double W3_0 = S[56];
        const double W3_1 = S[57];
        const double W3_2 = S[58];
        const double W3_3 = S[59];
        const double W3_4 = S[60];
        const double W3_5 = S[61];
        const double W3_6 = S[62];
        const double W3_7 = S[63];
        const double W3_8 = S[64];
        const double W3_9 = S[65];
        const double W3_10 = S[66];
        const double W3_11 = S[67];
        const double W3_12 = S[68];
        const double W3_13 = S[69];
        const double W4_0 = S[70];
        const double W4_1 = S[71];
        const double W4_2 = S[72];
        const double W4_3 = S[73];
        const double W4_4 = S[74];
        const double W4_5 = S[75];
        const double W4_6 = S[76];
        const double W4_7 = S[77];
        const double W4_8 = S[78];
        const double W4_9 = S[79];
        const double W4_10 = S[80];
        const double W4_11 = S[81];
        const double W4_12 = S[82];
        const double W4_13 = S[83];
        const double W5_0 = S[84];
        const double W5_1 = S[85];
        const double W5_2 = S[86];
        const double W5_3 = S[87];
        const double W5_4 = S[88];
        const double W5_5 = S[89];
        const double W5_6 = S[90];
        const double W5_7 = S[91];
        const double W5_8 = S[92];
        const double W5_9 = S[93];
        const double W5_10 = S[94];
        const double W5_11 = S[95];
        const double W5_12 = S[96];
        const double W5_13 = S[97];
        const double W6_0 = S[98];
        const double W6_1 = S[99];
        const double W6_2 = S[100];
        const double W6_3 = S[101];
        const double W6_4 = S[102];
        const double W6_5 = S[103];
        const double W6_6 = S[104];
        const double W6_7 = S[105];
        const double W6_8 = S[106];
        const double W6_9 = S[107];
        const double W6_10 = S[108];
        const double W6_11 = S[109];
        const double W6_12 = S[110];
        const double W6_13 = S[111];
        const double W7_0 = S[112];
        const double W7_1 = S[113];
        const double W7_2 = S[114];
        const double W7_3 = S[115];
        const double W7_4 = S[116];
        const double W7_5 = S[117];
        const double W7_6 = S[118];
        const double W7_7 = S[119];
        const double W7_8 = S[120];
        const double W7_9 = S[121];
        const double W7_10 = S[122];
        const double W7_11 = S[123];
        const double W7_12 = S[124];
        const double W7_13 = S[125];
        const double W8_0 = S[126];
        const double W8_1 = S[127];
        const double W8_2 = S[128];
        const double W8_3 = S[129];
        const double W8_4 = S[130];
        const double W8_5 = S[131];
        const double W8_6 = S[132];
        const double W8_7 = S[133];
        const double W8_8 = S[134];
        const double W8_9 = S[135];
        const double W8_10 = S[136];
        const double W8_11 = S[137];
        const double W8_12 = S[138];
        const double W8_13 = S[139];
        const double W9_0 = S[140];
        const double W9_1 = S[141];
        const double W9_2 = S[142];
        const double W9_3 = S[143];
        const double W9_4 = S[144];
        const double W9_5 = S[145];
        const double W9_6 = S[146];
        const double W9_7 = S[147];
        const double W9_8 = S[148];
        const double W9_9 = S[149];
        const double W9_10 = S[150];
        const double W9_11 = S[151];
        const double W9_12 = S[152];
        const double W9_13 = S[153];
        const double W10_0 = S[154];
        const double W10_1 = S[155];
        const double W10_2 = S[156];
        const double W10_3 = S[157];
        const double W10_4 = S[158];
        const double W10_5 = S[159];
        const double W10_6 = S[160];
        const double W10_7 = S[161];
        const double W10_8 = S[162];
        const double W10_9 = S[163];
        const double W10_10 = S[164];
        const double W10_11 = S[165];
        const double W10_12 = S[166];
        const double W10_13 = S[167];
        const double W11_0 = S[168];
        const double W11_1 = S[169];
        const double W11_2 = S[170];
        const double W11_3 = S[171];
        const double W11_4 = S[172];
        const double W11_5 = S[173];
        const double W11_6 = S[174];
        const double W11_7 = S[175];
        const double W11_8 = S[176];
        const double W11_9 = S[177];
        const double W11_10 = S[178];
        const double W11_11 = S[179];
        const double W11_12 = S[180];
        const double W11_13 = S[181];
        const double W12_0 = S[182];
        const double W12_1 = S[183];
        const double W12_2 = S[184];
        const double W12_3 = S[185];
        const double W12_4 = S[186];
        const double W12_5 = S[187];
        const double W12_6 = S[188];
        const double W12_7 = S[189];
        const double W12_8 = S[190];
        const double W12_9 = S[191];
        const double W12_10 = S[192];
        const double W12_11 = S[193];
        const double W12_12 = S[194];
        const double W12_13 = S[195];
        const double W13_0 = S[196];
        const double W13_1 = S[197];
        const double W13_2 = S[198];
        const double W13_3 = S[199];
        const double W13_4 = S[200];
        const double W13_5 = S[201];
        const double W13_6 = S[202];
        const double W13_7 = S[203];
        const double W13_8 = S[204];
        const double W13_9 = S[205];
        const double W13_10 = S[206];
        const double W13_11 = S[207];
        const double W13_12 = S[208];
        const double W13_13 = S[209];
        for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 14 * b;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector x4 = X[4];
            const vector x5 = X[5];
            const vector x6 = X[6];
            const vector x7 = X[7];
            const vector x8 = X[8];
            const vector x9 = X[9];
            const vector x10 = X[10];
            const vector x11 = X[11];
            const vector x12 = X[12];
            const vector x13 = X[13];
            const vector gap = x0 - mu0;
            const vector round_2 = round_each(0.15915494309189535 * gap);
            const vector v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
            const vector gap_2 = x1 - mu1;
            const vector round_3 = round_each(0.15915494309189535 * gap_2);
            const vector v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
            const vector gap_3 = x2 - mu2;
            const vector round_4 = round_each(0.15915494309189535 * gap_3);
            const vector v2 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
            const vector gap_4 = x3 - mu3;
            const vector round_5 = round_each(0.15915494309189535 * gap_4);
            const vector v3 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
            const vector gap_5 = x4 - mu4;
            const vector round_6 = round_each(0.15915494309189535 * gap_5);
            const vector v4 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
            const vector total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
            const vector gap_6 = x5 - mu5;
            const vector round_7 = round_each(0.15915494309189535 * gap_6);
            const vector v5 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
            const vector gap_7 = x6 - mu6;
            const vector round_8 = round_each(0.15915494309189535 * gap_7);
            const vector v6 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
            const vector gap_8 = x7 - mu7;
            const vector round_9 = round_each(0.15915494309189535 * gap_8);
            const vector v7 = gap_8 - 6.28125 * round_9 - 0.001935307179586477 * round_9;
            const vector gap_9 = x8 - mu8;
            const vector round_10 = round_each(0.15915494309189535 * gap_9);
            const vector v8 = gap_9 - 6.28125 * round_10 - 0.001935307179586477 * round_10;
            const vector total_3 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
            const vector gap_10 = x9 - mu9;
            const vector round_11 = round_each(0.15915494309189535 * gap_10);
            const vector v9 = gap_10 - 6.28125 * round_11 - 0.001935307179586477 * round_11;
            const vector gap_11 = x10 - mu10;
            const vector round_12 = round_each(0.15915494309189535 * gap_11);
            const vector v10 = gap_11 - 6.28125 * round_12 - 0.001935307179586477 * round_12;
            const vector gap_12 = x11 - mu11;
            const vector round_13 = round_each(0.15915494309189535 * gap_12);
            const vector v11 = gap_12 - 6.28125 * round_13 - 0.001935307179586477 * round_13;
            const vector gap_13 = x12 - mu12;
            const vector round_14 = round_each(0.15915494309189535 * gap_13);
            const vector v12 = gap_13 - 6.28125 * round_14 - 0.001935307179586477 * round_14;
            const vector total_4 = total_3 + W0_9 * v9 + W0_10 * v10 + W0_11 * v11 + W0_12 * v12;
            const vector gap_14 = x13 - mu13;
            const vector round_15 = round_each(0.15915494309189535 * gap_14);
            const vector v13 = gap_14 - 6.28125 * round_15 - 0.001935307179586477 * round_15;
            const vector z0 = total_4 + W0_13 * v13;
            const vector total_5 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
            const vector total_6 = total_5 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
            const vector total_7 = total_6 + W1_9 * v9 + W1_10 * v10 + W1_11 * v11 + W1_12 * v12;
            const vector z1 = total_7 + W1_13 * v13;
            const vector total_8 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
            const vector total_9 = total_8 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
            const vector total_10 = total_9 + W2_9 * v9 + W2_10 * v10 + W2_11 * v11 + W2_12 * v12;
            const vector z2 = total_10 + W2_13 * v13;
            const vector total_11 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
            const vector total_12 = total_11 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
            const vector total_13 = total_12 + W3_9 * v9 + W3_10 * v10 + W3_11 * v11 + W3_12 * v12;
            const vector z3 = total_13 + W3_13 * v13;
            const vector total_14 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
            const vector total_15 = total_14 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
            const vector total_16 = total_15 + W4_9 * v9 + W4_10 * v10 + W4_11 * v11 + W4_12 * v12;
            const vector z4 = total_16 + W4_13 * v13;
            const vector total_17 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
            const vector total_18 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
            const vector total_19 = total_18 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
            const vector total_20 = total_19 + W5_9 * v9 + W5_10 * v10 + W5_11 * v11 + W5_12 * v12;
            const vector z5 = total_20 + W5_13 * v13;
            const vector total_21 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
            const vector total_22 = total_21 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
            const vector total_23 = total_22 + W6_9 * v9 + W6_10 * v10 + W6_11 * v11 + W6_12 * v12;
            const vector z6 = total_23 + W6_13 * v13;
            const vector total_24 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
            const vector total_25 = total_24 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
            const vector total_26 = total_25 + W7_9 * v9 + W7_10 * v10 + W7_11 * v11 + W7_12 * v12;
            const vector z7 = total_26 + W7_13 * v13;
            const vector total_27 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
            const vector total_28 = total_27 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
            const vector total_29 = total_28 + W8_9 * v9 + W8_10 * v10 + W8_11 * v11 + W8_12 * v12;
            const vector z8 = total_29 + W8_13 * v13;
            const vector total_30 = total_17 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
            const vector total_31 = W9_0 * v0 + W9_1 * v1 + W9_2 * v2 + W9_3 * v3 + W9_4 * v4;
            const vector total_32 = total_31 + W9_5 * v5 + W9_6 * v6 + W9_7 * v7 + W9_8 * v8;
            const vector total_33 = total_32 + W9_9 * v9 + W9_10 * v10 + W9_11 * v11 + W9_12 * v12;
            const vector z9 = total_33 + W9_13 * v13;
            const vector total_34 = W10_0 * v0 + W10_1 * v1 + W10_2 * v2 + W10_3 * v3 + W10_4 * v4;
            const vector total_35 = total_34 + W10_5 * v5 + W10_6 * v6 + W10_7 * v7 + W10_8 * v8;
            const vector total_36 = total_35 + W10_9 * v9 + W10_10 * v10 + W10_11 * v11 + W10_12 * v12;
            const vector z10 = total_36 + W10_13 * v13;
            const vector total_37 = W11_0 * v0 + W11_1 * v1 + W11_2 * v2 + W11_3 * v3 + W11_4 * v4;
            const vector total_38 = total_37 + W11_5 * v5 + W11_6 * v6 + W11_7 * v7 + W11_8 * v8;
            const vector total_39 = total_38 + W11_9 * v9 + W11_10 * v10 + W11_11 * v11 + W11_12 * v12;
            const vector z11 = total_39 + W11_13 * v13;
            const vector total_40 = W12_0 * v0 + W12_1 * v1 + W12_2 * v2 + W12_3 * v3 + W12_4 * v4;
            const vector total_41 = total_40 + W12_5 * v5 + W12_6 * v6 + W12_7 * v7 + W12_8 * v8;
            const vector total_42 = total_41 + W12_9 * v9 + W12_10 * v10 + W12_11 * v11 + W12_12 * v12;
            const vector z12 = total_42 + W12_13 * v13;
            const vector total_43 = total_30 + z9 * z9 + z10 * z10 + z11 * z11 + z12 * z12;
            const vector total_44 = W13_0 * v0 + W13_1 * v1 + W13_2 * v2 + W13_3 * v3 + W13_4 * v4;
            const vector total_45 = total_44 + W13_5 * v5 + W13_6 * v6 + W13_7 * v7 + W13_8 * v8;
            const vector total_46 = total_45 + W13_9 * v9 + W13_10 * v10 + W13_11 * v11 + W13_12 * v12;
            const vector z13 = total_46 + W13_13 * v13;
            const vector phi = gaussian_each(total_43 + z13 * z13);
            kept[k][b].z0 = z0;
            kept[k][b].z1 = z1;
            kept[k][b].z2 = z2;
            kept[k][b].z3 = z3;
            kept[k][b].z4 = z4;
            kept[k][b].z5 = z5;
            kept[k][b].z6 = z6;
            kept[k][b].z7 = z7;
            kept[k][b].z8 = z8;
            kept[k][b].z9 = z9;
            kept[k][b].z10 = z10;
            kept[k][b].z11 = z11;
            kept[k][b].z12 = z12;
            kept[k][b].z13 = z13;
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 211 * near[k];
        const double W0_0 = S[14];
        const double W0_1 = S[15];
        const double W0_2 = S[16];
        const double W0_3 = S[17];
        const double W0_4 = S[18];
        const double W0_5 = S[19];
        const double W0_6 = S[20];
        const double W0_7 = S[21];
        const double W0_8 = S[22];
        const double W0_9 = S[23];
        const double W0_10 = S[24];
        const double W0_11 = S[25];
        const double W0_12 = S[26];
        const double W0_13 = S[27];
        const double W1_0 = S[28];
        const double W1_1 = S[29];
        const double W1_2 = S[30];
        const double W1_3 = S[31];
        const double W1_4 = S[32];
        const double W1_5 = S[33];
        const double W1_6 = S[34];
        const double W1_7 = S[35];
        const double W1_8 = S[36];
        const double W1_9 = S[37];
        const double W1_10 = S[38];
        const double W1_11 = S[39];
        const double W1_12 = S[40];
        const double W1_13 = S[41];
        const double W2_0 = S[42];
        const double W2_1 = S[43];
        const double W2_2 = S[44];
        const double W2_3 = S[45];
        const double W2_4 = S[46];
        const double W2_5 = S[47];
        const double W2_6 = S[48];
        const double W2_7 = S[49];
        const double W2_8 = S[50];
        const double W2_9 = S[51];
        const double W2_10 = S[52];
        const double W2_11 = S[53];
        const double W2_12 = S[54];
        const double W2_13 = S[55];
        const double W3_0 = S[56];
        const double W3_1 = S[57];
        const double W3_2 = S[58];
        const double W3_3 = S[59];
        const double W3_4 = S[60];
        const double W3_5 = S[61];
        const double W3_6 = S[62];
        const double W3_7 = S[63];
        const double W3_8 = S[64];
        const double W3_9 = S[65];
        const double W3_10 = S[66];
        const double W3_11 = S[67];
        const double W3_12 = S[68];
        const double W3_13 = S[69];
        const double W4_0 = S[70];
        const double W4_1 = S[71];
        const double W4_2 = S[72];
        const double W4_3 = S[73];
        const double W4_4 = S[74];
        const double W4_5 = S[75];
        const double W4_6 = S[76];
        const double W4_7 = S[77];
        const double W4_8 = S[78];
        const double W4_9 = S[79];
        const double W4_10 = S[80];
        const double W4_11 = S[81];
        const double W4_12 = S[82];
        const double W4_13 = S[83];
        const double W5_0 = S[84];
        const double W5_1 = S[85];
        const double W5_2 = S[86];
        const double W5_3 = S[87];
        const double W5_4 = S[88];
        const double W5_5 = S[89];
        const double W5_6 = S[90];
        const double W5_7 = S[91];
        const double W5_8 = S[92];
        const double W5_9 = S[93];
        const double W5_10 = S[94];
        const double W5_11 = S[95];
        const double W5_12 = S[96];
        const double W5_13 = S[97];
        const double W6_0 = S[98];
        const double W6_1 = S[99];
        const double W6_2 = S[100];
        const double W6_3 = S[101];
        const double W6_4 = S[102];
        const double W6_5 = S[103];
        const double W6_6 = S[104];
        const double W6_7 = S[105];
        const double W6_8 = S[106];
        const double W6_9 = S[107];
        const double W6_10 = S[108];
        const double W6_11 = S[109];
        const double W6_12 = S[110];
        const double W6_13 = S[111];
        const double W7_0 = S[112];
        const double W7_1 = S[113];
        const double W7_2 = S[114];
        const double W7_3 = S[115];
        const double W7_4 = S[116];
        const double W7_5 = S[117];
        const double W7_6 = S[118];
        const double W7_7 = S[119];
        const double W7_8 = S[120];
        const double W7_9 = S[121];
        const double W7_10 = S[122];
        const double W7_11 = S[123];
        const double W7_12 = S[124];
        const double W7_13 = S[125];
        const double W8_0 = S[126];
        const double W8_1 = S[127];
        const double W8_2 = S[128];
        const double W8_3 = S[129];
        const double W8_4 = S[130];
        const double W8_5 = S[131];
        const double W8_6 = S[132];
        const double W8_7 = S[133];
        const double W8_8 = S[134];
        const double W8_9 = S[135];
        const double W8_10 = S[136];
        const double W8_11 = S[137];
        const double W8_12 = S[138];
        const double W8_13 = S[139];
        const double W9_0 = S[140];
        const double W9_1 = S[141];
        const double W9_2 = S[142];
        const double W9_3 = S[143];
        const double W9_4 = S[144];
        const double W9_5 = S[145];
        const double W9_6 = S[146];
        const double W9_7 = S[147];
        const double W9_8 = S[148];
        const double W9_9 = S[149];
        const double W9_10 = S[150];
        const double W9_11 = S[151];
        const double W9_12 = S[152];
        const double W9_13 = S[153];
        const double W10_0 = S[154];
        const double W10_1 = S[155];
        const double W10_2 = S[156];
        const double W10_3 = S[157];
        const double W10_4 = S[158];
        const double W10_5 = S[159];
        const double W10_6 = S[160];
        const double W10_7 = S[161];
        const double W10_8 = S[162];
        const double W10_9 = S[163];
        const double W10_10 = S[164];
        const double W10_11 = S[165];
        const double W10_12 = S[166];
        const double W10_13 = S[167];
        const double W11_0 = S[168];
        const double W11_1 = S[169];
        const double W11_2 = S[170];
        const double W11_3 = S[171];
        const double W11_4 = S[172];
        const double W11_5 = S[173];
        const double W11_6 = S[174];
        const double W11_7 = S[175];
        const double W11_8 = S[176];
        const double W11_9 = S[177];
        const double W11_10 = S[178];
        const double W11_11 = S[179];
        const double W11_12 = S[180];
        const double W11_13 = S[181];
        const double W12_0 = S[182];
        const double W12_1 = S[183];
        const double W12_2 = S[184];
        const double W12_3 = S[185];
        const double W12_4 = S[186];
        const double W12_5 = S[187];
        const double W12_6 = S[188];
        const double W12_7 = S[189];
        const double W12_8 = S[190];
        const double W12_9 = S[191];
        const double W12_10 = S[192];
        const double W12_11 = S[193];
        const double W12_12 = S[194];
        const double W12_13 = S[195];
        const double W13_0 = S[196];
        const double W13_1 = S[197];
        const double W13_2 = S[198];
        const double W13_3 = S[199];
        const double W13_4 = S[200];
        const double W13_5 = S[201];
        const double W13_6 = S[202];
        const double W13_7 = S[203];
        const double W13_8 = S[204];
        const double W13_9 = S[205];
        const double W13_10 = S[206];
        const double W13_11 = S[207];
        const double W13_12 = S[208];
        const double W13_13 = S[209];
        const double amplitude = S[210];
        for (size_t b = 0; b < 2; ++b) {
            vector *value = values + b;
            vector *slope = slopes + 14 * b;
            const vector z0 = kept[k][b].z0;
            const vector z1 = kept[k][b].z1;
            const vector z2 = kept[k][b].z2;
            const vector z3 = kept[k][b].z3;
            const vector z4 = kept[k][b].z4;
            const vector z5 = kept[k][b].z5;
            const vector z6 = kept[k][b].z6;
            const vector z7 = kept[k][b].z7;
            const vector z8 = kept[k][b].z8;
            const vector z9 = kept[k][b].z9;
            const vector z10 = kept[k][b].z10;
            const vector z11 = kept[k][b].z11;
            const vector z12 = kept[k][b].z12;
            const vector z13 = kept[k][b].z13;
            const vector phi = kept[k][b].phi;
            const vector phi_2 = amplitude * phi;
            const vector z13_product = z13 * phi_2;
            const vector z12_product = z12 * phi_2;
            const vector z11_product = z11 * phi_2;
            const vector z10_product = z10 * phi_2;
            const vector z9_product = z9 * phi_2;
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
            slope[0] = slope[0] - W13_0 * z13_product - W12_0 * z12_product - W11_0 * z11_product - W10_0 *
                    z10_product - W9_0 * z9_product - W8_0 * z8_product - W7_0 * z7_product - W6_0 * z6_product - W5_0 *
                    z5_product - W4_0 * z4_product - W3_0 * z3_product - W2_0 * z2_product - W1_0 * z1_product - W0_0 *
                    z0_product;
            slope[1] = slope[1] - W13_1 * z13_product - W12_1 * z12_product - W11_1 * z11_product - W10_1 *
                    z10_product - W9_1 * z9_product - W8_1 * z8_product - W7_1 * z7_product - W6_1 * z6_product - W5_1 *
                    z5_product - W4_1 * z4_product - W3_1 * z3_product - W2_1 * z2_product - W1_1 * z1_product - W0_1 *
                    z0_product;
            slope[2] = slope[2] - W13_2 * z13_product - W12_2 * z12_product - W11_2 * z11_product - W10_2 *
                    z10_product - W9_2 * z9_product - W8_2 * z8_product - W7_2 * z7_product - W6_2 * z6_product - W5_2 *
                    z5_product - W4_2 * z4_product - W3_2 * z3_product - W2_2 * z2_product - W1_2 * z1_product - W0_2 *
                    z0_product;
            slope[3] = slope[3] - W13_3 * z13_product - W12_3 * z12_product - W11_3 * z11_product - W10_3 *
                    z10_product - W9_3 * z9_product - W8_3 * z8_product - W7_3 * z7_product - W6_3 * z6_product - W5_3 *
                    z5_product - W4_3 * z4_product - W3_3 * z3_product - W2_3 * z2_product - W1_3 * z1_product - W0_3 *
                    z0_product;
            slope[4] = slope[4] - W13_4 * z13_product - W12_4 * z12_product - W11_4 * z11_product - W10_4 *
                    z10_product - W9_4 * z9_product - W8_4 * z8_product - W7_4 * z7_product - W6_4 * z6_product - W5_4 *
                    z5_product - W4_4 * z4_product - W3_4 * z3_product - W2_4 * z2_product - W1_4 * z1_product - W0_4 *
                    z0_product;
            slope[5] = slope[5] - W13_5 * z13_product - W12_5 * z12_product - W11_5 * z11_product - W10_5 *
                    z10_product - W9_5 * z9_product - W8_5 * z8_product - W7_5 * z7_product - W6_5 * z6_product - W5_5 *
                    z5_product - W4_5 * z4_product - W3_5 * z3_product - W2_5 * z2_product - W1_5 * z1_product - W0_5 *
                    z0_product;
            slope[6] = slope[6] - W13_6 * z13_product - W12_6 * z12_product - W11_6 * z11_product - W10_6 *
                    z10_product - W9_6 * z9_product - W8_6 * z8_product - W7_6 * z7_product - W6_6 * z6_product - W5_6 *
                    z5_product - W4_6 * z4_product - W3_6 * z3_product - W2_6 * z2_product - W1_6 * z1_product - W0_6 *
                    z0_product;
            slope[7] = slope[7] - W13_7 * z13_product - W12_7 * z12_product - W11_7 * z11_product - W10_7 *
                    z10_product - W9_7 * z9_product - W8_7 * z8_product - W7_7 * z7_product - W6_7 * z6_product - W5_7 *
                    z5_product - W4_7 * z4_product - W3_7 * z3_product - W2_7 * z2_product - W1_7 * z1_product - W0_7 *
                    z0_product;
            slope[8] = slope[8] - W13_8 * z13_product - W12_8 * z12_product - W11_8 * z11_product - W10_8 *
                    z10_product - W9_8 * z9_product - W8_8 * z8_product - W7_8 * z7_product - W6_8 * z6_product - W5_8 *
                    z5_product - W4_8 * z4_product - W3_8 * z3_product - W2_8 * z2_product - W1_8 * z1_product - W0_8 *
                    z0_product;
            slope[9] = slope[9] - W13_9 * z13_product - W12_9 * z12_product - W11_9 * z11_product - W10_9 *
                    z10_product - W9_9 * z9_product - W8_9 * z8_product - W7_9 * z7_product - W6_9 * z6_product - W5_9 *
                    z5_product - W4_9 * z4_product - W3_9 * z3_product - W2_9 * z2_product - W1_9 * z1_product - W0_9 *
                    z0_product;
            slope[10] = slope[10] - W13_10 * z13_product - W12_10 * z12_product - W11_10 * z11_product - W10_10 *
                    z10_product - W9_10 * z9_product - W8_10 * z8_product - W7_10 * z7_product - W6_10 * z6_product -
                    W5_10 * z5_product - W4_10 * z4_product - W3_10 * z3_product - W2_10 * z2_product - W1_10 * z1_product
                    - W0_10 * z0_product;
            slope[11] = slope[11] - W13_11 * z13_product - W12_11 * z12_product - W11_11 * z11_product - W10_11 *
                    z10_product - W9_11 * z9_product - W8_11 * z8_product - W7_11 * z7_product - W6_11 * z6_product -
                    W5_11 * z5_product - W4_11 * z4_product - W3_11 * z3_product - W2_11 * z2_product - W1_11 * z1_product
                    - W0_11 * z0_product;
            slope[12] = slope[12] - W13_12 * z13_product - W12_12 * z12_product - W11_12 * z11_product - W10_12 *
                    z10_product - W9_12 * z9_product - W8_12 * z8_product - W7_12 * z7_product - W6_12 * z6_product -
                    W5_12 * z5_product - W4_12 * z4_product - W3_12 * z3_product - W2_12 * z2_product - W1_12 * z1_product
                    - W0_12 * z0_product;
            slope[13] = slope[13] - W13_13 * z13_product - W12_13 * z12_product - W11_13 * z11_product - W10_13 *
                    z10_product - W9_13 * z9_product - W8_13 * z8_product - W7_13 * z7_product - W6_13 * z6_product -
                    W5_13 * z5_product - W4_13 * z4_product - W3_13 * z3_product - W2_13 * z2_product - W1_13 * z1_product
                    - W0_13 * z0_product;
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
    const vector slope_x9 = slope[9];
    const vector slope_x10 = slope[10];
    const vector slope_x11 = slope[11];
    const vector slope_x12 = slope[12];
    const vector slope_x13 = slope[13];
    gradient[0] = slope_x0;
    gradient[1] = slope_x1;
    gradient[2] = slope_x2;
    gradient[3] = slope_x3;
    gradient[4] = slope_x4;
    gradient[5] = slope_x5;
    gradient[6] = slope_x6;
    gradient[7] = slope_x7;
    gradient[8] = slope_x8;
    gradient[9] = slope_x9;
    gradient[10] = slope_x10;
    gradient[11] = slope_x11;
    gradient[12] = slope_x12;
    gradient[13] = slope_x13;
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
    const vector gradient_bar9 = gradient_bar[9];
    const vector gradient_bar10 = gradient_bar[10];
    const vector gradient_bar11 = gradient_bar[11];
    const vector gradient_bar12 = gradient_bar[12];
    const vector gradient_bar13 = gradient_bar[13];
    slope_bar[0] = gradient_bar0;
    slope_bar[1] = gradient_bar1;
    slope_bar[2] = gradient_bar2;
    slope_bar[3] = gradient_bar3;
    slope_bar[4] = gradient_bar4;
    slope_bar[5] = gradient_bar5;
    slope_bar[6] = gradient_bar6;
    slope_bar[7] = gradient_bar7;
    slope_bar[8] = gradient_bar8;
    slope_bar[9] = gradient_bar9;
    slope_bar[10] = gradient_bar10;
    slope_bar[11] = gradient_bar11;
    slope_bar[12] = gradient_bar12;
    slope_bar[13] = gradient_bar13;
}

/*
 * The factors of whose products are what is summed over the points, for some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
OUTLINE void pair_factors(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *factors) {
    struct { vector v0, v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, z0, z1, z2, z3, z4, z5, z6,
            z7, z8, z9, z10, z11, z12, z13, phi; } kept[6];
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 29 * (size_t)near[i];
        const vector x0 = X[0];
        const vector x1 = X[1];
        const vector x2 = X[2];
        const vector x3 = X[3];
        const vector x4 = X[4];
        const vector x5 = X[5];
        const vector x6 = X[6];
        const vector x7 = X[7];
        const vector x8 = X[8];
        const vector x9 = X[9];
        const vector x10 = X[10];
        const vector x11 = X[11];
        const vector x12 = X[12];
        const vector x13 = X[13];
        const double mu0 = S[0];
        const double mu1 = S[1];
        const double mu2 = S[2];
        const double mu3 = S[3];
        const double mu4 = S[4];
        const double mu5 = S[5];
        const double mu6 = S[6];
        const double mu7 = S[7];
        const double mu8 = S[8];
        const double mu9 = S[9];
        const double mu10 = S[10];
        const double mu11 = S[11];
        const double mu12 = S[12];
        const double mu13 = S[13];
        const double W0_0 = S[14];
        const double W0_1 = S[15];
        const double W0_2 = S[16];
        const double W0_3 = S[17];
        const double W0_4 = S[18];
        const double W0_5 = S[19];
        const double W0_6 = S[20];
        const double W0_7 = S[21];
        const double W0_8 = S[22];
        const double W0_9 = S[23];
        const double W0_10 = S[24];
        const double W0_11 = S[25];
        const double W0_12 = S[26];
        const double W0_13 = S[27];
        const double W1_0 = S[28];
        const double W1_1 = S[29];
        const double W1_2 = S[30];
        const double W1_3 = S[31];
        const double W1_4 = S[32];
        const double W1_5 = S[33];
        const double W1_6 = S[34];
        const double W1_7 = S[35];
        const double W1_8 = S[36];
        const double W1_9 = S[37];
        const double W1_10 = S[38];
        const double W1_11 = S[39];
        const double W1_12 = S[40];
        const double W1_13 = S[41];
        const double W2_0 = S[42];
        const double W2_1 = S[43];
        const double W2_2 = S[44];
        const double W2_3 = S[45];
        const double W2_4 = S[46];
        const double W2_5 = S[47];
        const double W2_6 = S[48];
        const double W2_7 = S[49];
        const double W2_8 = S[50];
        const double W2_9 = S[51];
        const double W2_10 = S[52];
        const double W2_11 = S[53];
        const double W2_12 = S[54];
        const double W2_13 = S[55];
        const double W3_0 = S[56];
        const double W3_1 = S[57];
        const double W3_2 = S[58];
        const double W3_3 = S[59];
        const double W3_4 = S[60];
        const double W3_5 = S[61];
        const double W3_6 = S[62];
        const double W3_7 = S[63];
        const double W3_8 = S[64];
        const double W3_9 = S[65];
        const double W3_10 = S[66];
        const double W3_11 = S[67];
        const double W3_12 = S[68];
        const double W3_13 = S[69];
        const double W4_0 = S[70];
        const double W4_1 = S[71];
        const double W4_2 = S[72];
        const double W4_3 = S[73];
        const double W4_4 = S[74];
        const double W4_5 = S[75];
        const double W4_6 = S[76];
        const double W4_7 = S[77];
        const double W4_8 = S[78];
        const double W4_9 = S[79];
        const double W4_10 = S[80];
        const double W4_11 = S[81];
        const double W4_12 = S[82];
        const double W4_13 = S[83];
        const double W5_0 = S[84];
        const double W5_1 = S[85];
        const double W5_2 = S[86];
        const double W5_3 = S[87];
        const double W5_4 = S[88];
        const double W5_5 = S[89];
        const double W5_6 = S[90];
        const double W5_7 = S[91];
        const double W5_8 = S[92];
        const double W5_9 = S[93];
        const double W5_10 = S[94];
        const double W5_11 = S[95];
        const double W5_12 = S[96];
        const double W5_13 = S[97];
        const double W6_0 = S[98];
        const double W6_1 = S[99];
        const double W6_2 = S[100];
        const double W6_3 = S[101];
        const double W6_4 = S[102];
        const double W6_5 = S[103];
        const double W6_6 = S[104];
        const double W6_7 = S[105];
        const double W6_8 = S[106];
        const double W6_9 = S[107];
        const double W6_10 = S[108];
        const double W6_11 = S[109];
        const double W6_12 = S[110];
        const double W6_13 = S[111];
        const double W7_0 = S[112];
        const double W7_1 = S[113];
        const double W7_2 = S[114];
        const double W7_3 = S[115];
        const double W7_4 = S[116];
        const double W7_5 = S[117];
        const double W7_6 = S[118];
        const double W7_7 = S[119];
        const double W7_8 = S[120];
        const double W7_9 = S[121];
        const double W7_10 = S[122];
        const double W7_11 = S[123];
        const double W7_12 = S[124];
        const double W7_13 = S[125];
        const double W8_0 = S[126];
        const double W8_1 = S[127];
        const double W8_2 = S[128];
        const double W8_3 = S[129];
        const double W8_4 = S[130];
        const double W8_5 = S[131];
        const double W8_6 = S[132];
        const double W8_7 = S[133];
        const double W8_8 = S[134];
        const double W8_9 = S[135];
        const double W8_10 = S[136];
        const double W8_11 = S[137];
        const double W8_12 = S[138];
        const double W8_13 = S[139];
        const double W9_0 = S[140];
        const double W9_1 = S[141];
        const double W9_2 = S[142];
        const double W9_3 = S[143];
        const double W9_4 = S[144];
        const double W9_5 = S[145];
        const double W9_6 = S[146];
        const double W9_7 = S[147];
        const double W9_8 = S[148];
        const double W9_9 = S[149];
        const double W9_10 = S[150];
        const double W9_11 = S[151];
        const double W9_12 = S[152];
        const double W9_13 = S[153];
        const double W10_0 = S[154];
        const double W10_1 = S[155];
        const double W10_2 = S[156];
        const double W10_3 = S[157];
        const double W10_4 = S[158];
        const double W10_5 = S[159];
        const double W10_6 = S[160];
        const double W10_7 = S[161];
        const double W10_8 = S[162];
        const double W10_9 = S[163];
        const double W10_10 = S[164];
        const double W10_11 = S[165];
        const double W10_12 = S[166];
        const double W10_13 = S[167];
        const double W11_0 = S[168];
        const double W11_1 = S[169];
        const double W11_2 = S[170];
        const double W11_3 = S[171];
        const double W11_4 = S[172];
        const double W11_5 = S[173];
        const double W11_6 = S[174];
        const double W11_7 = S[175];
        const double W11_8 = S[176];
        const double W11_9 = S[177];
        const double W11_10 = S[178];
        const double W11_11 = S[179];
        const double W11_12 = S[180];
        const double W11_13 = S[181];
        const double W12_0 = S[182];
        const double W12_1 = S[183];
        const double W12_2 = S[184];
        const double W12_3 = S[185];
        const double W12_4 = S[186];
        const double W12_5 = S[187];
        const double W12_6 = S[188];
        const double W12_7 = S[189];
        const double W12_8 = S[190];
        const double W12_9 = S[191];
        const double W12_10 = S[192];
        const double W12_11 = S[193];
        const double W12_12 = S[194];
        const double W12_13 = S[195];
        const double W13_0 = S[196];
        const double W13_1 = S[197];
        const double W13_2 = S[198];
        const double W13_3 = S[199];
        const double W13_4 = S[200];
        const double W13_5 = S[201];
        const double W13_6 = S[202];
        const double W13_7 = S[203];
        const double W13_8 = S[204];
        const double W13_9 = S[205];
        const double W13_10 = S[206];
        const double W13_11 = S[207];
        const double W13_12 = S[208];
        const double W13_13 = S[209];
        const vector gap = x0 - mu0;
        const vector round_2 = round_each(0.15915494309189535 * gap);
        const vector v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
        const vector gap_2 = x1 - mu1;
        const vector round_3 = round_each(0.15915494309189535 * gap_2);
        const vector v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
        const vector gap_3 = x2 - mu2;
        const vector round_4 = round_each(0.15915494309189535 * gap_3);
        const vector v2 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
        const vector gap_4 = x3 - mu3;
        const vector round_5 = round_each(0.15915494309189535 * gap_4);
        const vector v3 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
        const vector gap_5 = x4 - mu4;
        const vector round_6 = round_each(0.15915494309189535 * gap_5);
        const vector v4 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
        const vector total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
        const vector gap_6 = x5 - mu5;
        const vector round_7 = round_each(0.15915494309189535 * gap_6);
        const vector v5 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
        const vector gap_7 = x6 - mu6;
        const vector round_8 = round_each(0.15915494309189535 * gap_7);
        const vector v6 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
        const vector gap_8 = x7 - mu7;
        const vector round_9 = round_each(0.15915494309189535 * gap_8);
        const vector v7 = gap_8 - 6.28125 * round_9 - 0.001935307179586477 * round_9;
        const vector gap_9 = x8 - mu8;
        const vector round_10 = round_each(0.15915494309189535 * gap_9);
        const vector v8 = gap_9 - 6.28125 * round_10 - 0.001935307179586477 * round_10;
        const vector total_3 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
        const vector gap_10 = x9 - mu9;
        const vector round_11 = round_each(0.15915494309189535 * gap_10);
        const vector v9 = gap_10 - 6.28125 * round_11 - 0.001935307179586477 * round_11;
        const vector gap_11 = x10 - mu10;
        const vector round_12 = round_each(0.15915494309189535 * gap_11);
        const vector v10 = gap_11 - 6.28125 * round_12 - 0.001935307179586477 * round_12;
        const vector gap_12 = x11 - mu11;
        const vector round_13 = round_each(0.15915494309189535 * gap_12);
        const vector v11 = gap_12 - 6.28125 * round_13 - 0.001935307179586477 * round_13;
        const vector gap_13 = x12 - mu12;
        const vector round_14 = round_each(0.15915494309189535 * gap_13);
        const vector v12 = gap_13 - 6.28125 * round_14 - 0.001935307179586477 * round_14;
        const vector total_4 = total_3 + W0_9 * v9 + W0_10 * v10 + W0_11 * v11 + W0_12 * v12;
        const vector gap_14 = x13 - mu13;
        const vector round_15 = round_each(0.15915494309189535 * gap_14);
        const vector v13 = gap_14 - 6.28125 * round_15 - 0.001935307179586477 * round_15;
        const vector z0 = total_4 + W0_13 * v13;
        const vector total_5 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
        const vector total_6 = total_5 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
        const vector total_7 = total_6 + W1_9 * v9 + W1_10 * v10 + W1_11 * v11 + W1_12 * v12;
        const vector z1 = total_7 + W1_13 * v13;
        const vector total_8 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
        const vector total_9 = total_8 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
        const vector total_10 = total_9 + W2_9 * v9 + W2_10 * v10 + W2_11 * v11 + W2_12 * v12;
        const vector z2 = total_10 + W2_13 * v13;
        const vector total_11 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
        const vector total_12 = total_11 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
        const vector total_13 = total_12 + W3_9 * v9 + W3_10 * v10 + W3_11 * v11 + W3_12 * v12;
        const vector z3 = total_13 + W3_13 * v13;
        const vector total_14 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
        const vector total_15 = total_14 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
        const vector total_16 = total_15 + W4_9 * v9 + W4_10 * v10 + W4_11 * v11 + W4_12 * v12;
        const vector z4 = total_16 + W4_13 * v13;
        const vector total_17 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
        const vector total_18 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
        const vector total_19 = total_18 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
        const vector total_20 = total_19 + W5_9 * v9 + W5_10 * v10 + W5_11 * v11 + W5_12 * v12;
        const vector z5 = total_20 + W5_13 * v13;
        const vector total_21 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
        const vector total_22 = total_21 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
        const vector total_23 = total_22 + W6_9 * v9 + W6_10 * v10 + W6_11 * v11 + W6_12 * v12;
        const vector z6 = total_23 + W6_13 * v13;
        const vector total_24 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
        const vector total_25 = total_24 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
        const vector total_26 = total_25 + W7_9 * v9 + W7_10 * v10 + W7_11 * v11 + W7_12 * v12;
        const vector z7 = total_26 + W7_13 * v13;
        const vector total_27 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
        const vector total_28 = total_27 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
        const vector total_29 = total_28 + W8_9 * v9 + W8_10 * v10 + W8_11 * v11 + W8_12 * v12;
        const vector z8 = total_29 + W8_13 * v13;
        const vector total_30 = total_17 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
        const vector total_31 = W9_0 * v0 + W9_1 * v1 + W9_2 * v2 + W9_3 * v3 + W9_4 * v4;
        const vector total_32 = total_31 + W9_5 * v5 + W9_6 * v6 + W9_7 * v7 + W9_8 * v8;
        const vector total_33 = total_32 + W9_9 * v9 + W9_10 * v10 + W9_11 * v11 + W9_12 * v12;
        const vector z9 = total_33 + W9_13 * v13;
        const vector total_34 = W10_0 * v0 + W10_1 * v1 + W10_2 * v2 + W10_3 * v3 + W10_4 * v4;
        const vector total_35 = total_34 + W10_5 * v5 + W10_6 * v6 + W10_7 * v7 + W10_8 * v8;
        const vector total_36 = total_35 + W10_9 * v9 + W10_10 * v10 + W10_11 * v11 + W10_12 * v12;
        const vector z10 = total_36 + W10_13 * v13;
        const vector total_37 = W11_0 * v0 + W11_1 * v1 + W11_2 * v2 + W11_3 * v3 + W11_4 * v4;
        const vector total_38 = total_37 + W11_5 * v5 + W11_6 * v6 + W11_7 * v7 + W11_8 * v8;
        const vector total_39 = total_38 + W11_9 * v9 + W11_10 * v10 + W11_11 * v11 + W11_12 * v12;
        const vector z11 = total_39 + W11_13 * v13;
        const vector total_40 = W12_0 * v0 + W12_1 * v1 + W12_2 * v2 + W12_3 * v3 + W12_4 * v4;
        const vector total_41 = total_40 + W12_5 * v5 + W12_6 * v6 + W12_7 * v7 + W12_8 * v8;
        const vector total_42 = total_41 + W12_9 * v9 + W12_10 * v10 + W12_11 * v11 + W12_12 * v12;
        const vector z12 = total_42 + W12_13 * v13;
        const vector total_43 = total_30 + z9 * z9 + z10 * z10 + z11 * z11 + z12 * z12;
        const vector total_44 = W13_0 * v0 + W13_1 * v1 + W13_2 * v2 + W13_3 * v3 + W13_4 * v4;
        const vector total_45 = total_44 + W13_5 * v5 + W13_6 * v6 + W13_7 * v7 + W13_8 * v8;
        const vector total_46 = total_45 + W13_9 * v9 + W13_10 * v10 + W13_11 * v11 + W13_12 * v12;
        const vector z13 = total_46 + W13_13 * v13;
        const vector phi = gaussian_each(total_43 + z13 * z13);
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].v2 = v2;
        kept[i].v3 = v3;
        kept[i].v4 = v4;
        kept[i].v5 = v5;
        kept[i].v6 = v6;
        kept[i].v7 = v7;
        kept[i].v8 = v8;
        kept[i].v9 = v9;
        kept[i].v10 = v10;
        kept[i].v11 = v11;
        kept[i].v12 = v12;
        kept[i].v13 = v13;
        kept[i].z0 = z0;
        kept[i].z1 = z1;
        kept[i].z2 = z2;
        kept[i].z3 = z3;
        kept[i].z4 = z4;
        kept[i].z5 = z5;
        kept[i].z6 = z6;
        kept[i].z7 = z7;
        kept[i].z8 = z8;
        kept[i].z9 = z9;
        kept[i].z10 = z10;
        kept[i].z11 = z11;
        kept[i].z12 = z12;
        kept[i].z13 = z13;
        kept[i].phi = phi;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector *value_bar = points + 29 * (size_t)near[i] + 14;
        const vector *slope_bar = points + 29 * (size_t)near[i] + 14 + 1;
        vector *factor = factors + 57 * i;
        const vector v0 = kept[i].v0;
        const vector v1 = kept[i].v1;
        const vector v2 = kept[i].v2;
        const vector v3 = kept[i].v3;
        const vector v4 = kept[i].v4;
        const vector v5 = kept[i].v5;
        const vector v6 = kept[i].v6;
        const vector v7 = kept[i].v7;
        const vector v8 = kept[i].v8;
        const vector v9 = kept[i].v9;
        const vector v10 = kept[i].v10;
        const vector v11 = kept[i].v11;
        const vector v12 = kept[i].v12;
        const vector v13 = kept[i].v13;
        const vector z0 = kept[i].z0;
        const vector z1 = kept[i].z1;
        const vector z2 = kept[i].z2;
        const vector z3 = kept[i].z3;
        const vector z4 = kept[i].z4;
        const vector z5 = kept[i].z5;
        const vector z6 = kept[i].z6;
        const vector z7 = kept[i].z7;
        const vector z8 = kept[i].z8;
        const vector z9 = kept[i].z9;
        const vector z10 = kept[i].z10;
        const vector z11 = kept[i].z11;
        const vector z12 = kept[i].z12;
        const vector z13 = kept[i].z13;
        const vector phi = kept[i].phi;
        const double W0_0 = S[14];
        const double W0_1 = S[15];
        const double W0_2 = S[16];
        const double W0_3 = S[17];
        const double W0_4 = S[18];
        const double W0_5 = S[19];
        const double W0_6 = S[20];
        const double W0_7 = S[21];
        const double W0_8 = S[22];
        const double W0_9 = S[23];
        const double W0_10 = S[24];
        const double W0_11 = S[25];
        const double W0_12 = S[26];
        const double W0_13 = S[27];
        const double W1_0 = S[28];
        const double W1_1 = S[29];
        const double W1_2 = S[30];
        const double W1_3 = S[31];
        const double W1_4 = S[32];
        const double W1_5 = S[33];
        const double W1_6 = S[34];
        const double W1_7 = S[35];
        const double W1_8 = S[36];
        const double W1_9 = S[37];
        const double W1_10 = S[38];
        const double W1_11 = S[39];
        const double W1_12 = S[40];
        const double W1_13 = S[41];
        const double W2_0 = S[42];
        const double W2_1 = S[43];
        const double W2_2 = S[44];
        const double W2_3 = S[45];
        const double W2_4 = S[46];
        const double W2_5 = S[47];
        const double W2_6 = S[48];
        const double W2_7 = S[49];
        const double W2_8 = S[50];
        const double W2_9 = S[51];
        const double W2_10 = S[52];
        const double W2_11 = S[53];
        const double W2_12 = S[54];
        const double W2_13 = S[55];
        const double W3_0 = S[56];
        const double W3_1 = S[57];
        const double W3_2 = S[58];
        const double W3_3 = S[59];
        const double W3_4 = S[60];
        const double W3_5 = S[61];
        const double W3_6 = S[62];
        const double W3_7 = S[63];
        const double W3_8 = S[64];
        const double W3_9 = S[65];
        const double W3_10 = S[66];
        const double W3_11 = S[67];
        const double W3_12 = S[68];
        const double W3_13 = S[69];
        const double W4_0 = S[70];
        const double W4_1 = S[71];
        const double W4_2 = S[72];
        const double W4_3 = S[73];
        const double W4_4 = S[74];
        const double W4_5 = S[75];
        const double W4_6 = S[76];
        const double W4_7 = S[77];
        const double W4_8 = S[78];
        const double W4_9 = S[79];
        const double W4_10 = S[80];
        const double W4_11 = S[81];
        const double W4_12 = S[82];
        const double W4_13 = S[83];
        const double W5_0 = S[84];
        const double W5_1 = S[85];
        const double W5_2 = S[86];
        const double W5_3 = S[87];
        const double W5_4 = S[88];
        const double W5_5 = S[89];
        const double W5_6 = S[90];
        const double W5_7 = S[91];
        const double W5_8 = S[92];
        const double W5_9 = S[93];
        const double W5_10 = S[94];
        const double W5_11 = S[95];
        const double W5_12 = S[96];
        const double W5_13 = S[97];
        const double W6_0 = S[98];
        const double W6_1 = S[99];
        const double W6_2 = S[100];
        const double W6_3 = S[101];
        const double W6_4 = S[102];
        const double W6_5 = S[103];
        const double W6_6 = S[104];
        const double W6_7 = S[105];
        const double W6_8 = S[106];
        const double W6_9 = S[107];
        const double W6_10 = S[108];
        const double W6_11 = S[109];
        const double W6_12 = S[110];
        const double W6_13 = S[111];
        const double W7_0 = S[112];
        const double W7_1 = S[113];
        const double W7_2 = S[114];
        const double W7_3 = S[115];
        const double W7_4 = S[116];
        const double W7_5 = S[117];
        const double W7_6 = S[118];
        const double W7_7 = S[119];
        const double W7_8 = S[120];
        const double W7_9 = S[121];
        const double W7_10 = S[122];
        const double W7_11 = S[123];
        const double W7_12 = S[124];
        const double W7_13 = S[125];
        const double W8_0 = S[126];
        const double W8_1 = S[127];
        const double W8_2 = S[128];
        const double W8_3 = S[129];
        const double W8_4 = S[130];
        const double W8_5 = S[131];
        const double W8_6 = S[132];
        const double W8_7 = S[133];
        const double W8_8 = S[134];
        const double W8_9 = S[135];
        const double W8_10 = S[136];
        const double W8_11 = S[137];
        const double W8_12 = S[138];
        const double W8_13 = S[139];
        const double W9_0 = S[140];
        const double W9_1 = S[141];
        const double W9_2 = S[142];
        const double W9_3 = S[143];
        const double W9_4 = S[144];
        const double W9_5 = S[145];
        const double W9_6 = S[146];
        const double W9_7 = S[147];
        const double W9_8 = S[148];
        const double W9_9 = S[149];
        const double W9_10 = S[150];
        const double W9_11 = S[151];
        const double W9_12 = S[152];
        const double W9_13 = S[153];
        const double W10_0 = S[154];
        const double W10_1 = S[155];
        const double W10_2 = S[156];
        const double W10_3 = S[157];
        const double W10_4 = S[158];
        const double W10_5 = S[159];
        const double W10_6 = S[160];
        const double W10_7 = S[161];
        const double W10_8 = S[162];
        const double W10_9 = S[163];
        const double W10_10 = S[164];
        const double W10_11 = S[165];
        const double W10_12 = S[166];
        const double W10_13 = S[167];
        const double W11_0 = S[168];
        const double W11_1 = S[169];
        const double W11_2 = S[170];
        const double W11_3 = S[171];
        const double W11_4 = S[172];
        const double W11_5 = S[173];
        const double W11_6 = S[174];
        const double W11_7 = S[175];
        const double W11_8 = S[176];
        const double W11_9 = S[177];
        const double W11_10 = S[178];
        const double W11_11 = S[179];
        const double W11_12 = S[180];
        const double W11_13 = S[181];
        const double W12_0 = S[182];
        const double W12_1 = S[183];
        const double W12_2 = S[184];
        const double W12_3 = S[185];
        const double W12_4 = S[186];
        const double W12_5 = S[187];
        const double W12_6 = S[188];
        const double W12_7 = S[189];
        const double W12_8 = S[190];
        const double W12_9 = S[191];
        const double W12_10 = S[192];
        const double W12_11 = S[193];
        const double W12_12 = S[194];
        const double W12_13 = S[195];
        const double W13_0 = S[196];
        const double W13_1 = S[197];
        const double W13_2 = S[198];
        const double W13_3 = S[199];
        const double W13_4 = S[200];
        const double W13_5 = S[201];
        const double W13_6 = S[202];
        const double W13_7 = S[203];
        const double W13_8 = S[204];
        const double W13_9 = S[205];
        const double W13_10 = S[206];
        const double W13_11 = S[207];
        const double W13_12 = S[208];
        const double W13_13 = S[209];
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
        const vector x9_bar = slope_bar[9];
        const vector x10_bar = slope_bar[10];
        const vector x11_bar = slope_bar[11];
        const vector x12_bar = slope_bar[12];
        const vector x13_bar = slope_bar[13];
        const vector gap_15 = -(W13_0 * x0_bar) - W13_1 * x1_bar - W13_2 * x2_bar - W13_3 * x3_bar;
        const vector gap_16 = gap_15 - W13_4 * x4_bar - W13_5 * x5_bar - W13_6 * x6_bar - W13_7 * x7_bar;
        const vector gap_17 = gap_16 - W13_8 * x8_bar - W13_9 * x9_bar - W13_10 * x10_bar - W13_11 * x11_bar;
        const vector gap_18 = gap_17 - W13_12 * x12_bar - W13_13 * x13_bar;
        const vector gap_19 = -(W0_0 * x0_bar) - W0_1 * x1_bar - W0_2 * x2_bar - W0_3 * x3_bar;
        const vector gap_20 = gap_19 - W0_4 * x4_bar - W0_5 * x5_bar - W0_6 * x6_bar - W0_7 * x7_bar;
        const vector gap_21 = gap_20 - W0_8 * x8_bar - W0_9 * x9_bar - W0_10 * x10_bar - W0_11 * x11_bar;
        const vector gap_22 = gap_21 - W0_12 * x12_bar - W0_13 * x13_bar;
        const vector gap_23 = -(W1_0 * x0_bar) - W1_1 * x1_bar - W1_2 * x2_bar - W1_3 * x3_bar;
        const vector gap_24 = gap_23 - W1_4 * x4_bar - W1_5 * x5_bar - W1_6 * x6_bar - W1_7 * x7_bar;
        const vector gap_25 = gap_24 - W1_8 * x8_bar - W1_9 * x9_bar - W1_10 * x10_bar - W1_11 * x11_bar;
        const vector gap_26 = gap_25 - W1_12 * x12_bar - W1_13 * x13_bar;
        const vector gap_27 = -(W2_0 * x0_bar) - W2_1 * x1_bar - W2_2 * x2_bar - W2_3 * x3_bar;
        const vector gap_28 = gap_27 - W2_4 * x4_bar - W2_5 * x5_bar - W2_6 * x6_bar - W2_7 * x7_bar;
        const vector gap_29 = gap_28 - W2_8 * x8_bar - W2_9 * x9_bar - W2_10 * x10_bar - W2_11 * x11_bar;
        const vector gap_30 = gap_29 - W2_12 * x12_bar - W2_13 * x13_bar;
        const vector gap_31 = -(W3_0 * x0_bar) - W3_1 * x1_bar - W3_2 * x2_bar - W3_3 * x3_bar;
        const vector gap_32 = gap_31 - W3_4 * x4_bar - W3_5 * x5_bar - W3_6 * x6_bar - W3_7 * x7_bar;
        const vector gap_33 = gap_32 - W3_8 * x8_bar - W3_9 * x9_bar - W3_10 * x10_bar - W3_11 * x11_bar;
        const vector gap_34 = gap_33 - W3_12 * x12_bar - W3_13 * x13_bar;
        const vector total_47 = its_value_bar + z0 * gap_22 + z1 * gap_26 + z2 * gap_30 + z3 * gap_34;
        const vector gap_35 = -(W4_0 * x0_bar) - W4_1 * x1_bar - W4_2 * x2_bar - W4_3 * x3_bar;
        const vector gap_36 = gap_35 - W4_4 * x4_bar - W4_5 * x5_bar - W4_6 * x6_bar - W4_7 * x7_bar;
        const vector gap_37 = gap_36 - W4_8 * x8_bar - W4_9 * x9_bar - W4_10 * x10_bar - W4_11 * x11_bar;
        const vector gap_38 = gap_37 - W4_12 * x12_bar - W4_13 * x13_bar;
        const vector gap_39 = -(W5_0 * x0_bar) - W5_1 * x1_bar - W5_2 * x2_bar - W5_3 * x3_bar;
        const vector gap_40 = gap_39 - W5_4 * x4_bar - W5_5 * x5_bar - W5_6 * x6_bar - W5_7 * x7_bar;
        const vector gap_41 = gap_40 - W5_8 * x8_bar - W5_9 * x9_bar - W5_10 * x10_bar - W5_11 * x11_bar;
        const vector gap_42 = gap_41 - W5_12 * x12_bar - W5_13 * x13_bar;
        const vector gap_43 = -(W6_0 * x0_bar) - W6_1 * x1_bar - W6_2 * x2_bar - W6_3 * x3_bar;
        const vector gap_44 = gap_43 - W6_4 * x4_bar - W6_5 * x5_bar - W6_6 * x6_bar - W6_7 * x7_bar;
        const vector gap_45 = gap_44 - W6_8 * x8_bar - W6_9 * x9_bar - W6_10 * x10_bar - W6_11 * x11_bar;
        const vector gap_46 = gap_45 - W6_12 * x12_bar - W6_13 * x13_bar;
        const vector gap_47 = -(W7_0 * x0_bar) - W7_1 * x1_bar - W7_2 * x2_bar - W7_3 * x3_bar;
        const vector gap_48 = gap_47 - W7_4 * x4_bar - W7_5 * x5_bar - W7_6 * x6_bar - W7_7 * x7_bar;
        const vector gap_49 = gap_48 - W7_8 * x8_bar - W7_9 * x9_bar - W7_10 * x10_bar - W7_11 * x11_bar;
        const vector gap_50 = gap_49 - W7_12 * x12_bar - W7_13 * x13_bar;
        const vector total_48 = total_47 + z4 * gap_38 + z5 * gap_42 + z6 * gap_46 + z7 * gap_50;
        const vector gap_51 = -(W8_0 * x0_bar) - W8_1 * x1_bar - W8_2 * x2_bar - W8_3 * x3_bar;
        const vector gap_52 = gap_51 - W8_4 * x4_bar - W8_5 * x5_bar - W8_6 * x6_bar - W8_7 * x7_bar;
        const vector gap_53 = gap_52 - W8_8 * x8_bar - W8_9 * x9_bar - W8_10 * x10_bar - W8_11 * x11_bar;
        const vector gap_54 = gap_53 - W8_12 * x12_bar - W8_13 * x13_bar;
        const vector gap_55 = -(W9_0 * x0_bar) - W9_1 * x1_bar - W9_2 * x2_bar - W9_3 * x3_bar;
        const vector gap_56 = gap_55 - W9_4 * x4_bar - W9_5 * x5_bar - W9_6 * x6_bar - W9_7 * x7_bar;
        const vector gap_57 = gap_56 - W9_8 * x8_bar - W9_9 * x9_bar - W9_10 * x10_bar - W9_11 * x11_bar;
        const vector gap_58 = gap_57 - W9_12 * x12_bar - W9_13 * x13_bar;
        const vector gap_59 = -(W10_0 * x0_bar) - W10_1 * x1_bar - W10_2 * x2_bar - W10_3 * x3_bar;
        const vector gap_60 = gap_59 - W10_4 * x4_bar - W10_5 * x5_bar - W10_6 * x6_bar - W10_7 * x7_bar;
        const vector gap_61 = gap_60 - W10_8 * x8_bar - W10_9 * x9_bar - W10_10 * x10_bar - W10_11 * x11_bar;
        const vector gap_62 = gap_61 - W10_12 * x12_bar - W10_13 * x13_bar;
        const vector gap_63 = -(W11_0 * x0_bar) - W11_1 * x1_bar - W11_2 * x2_bar - W11_3 * x3_bar;
        const vector gap_64 = gap_63 - W11_4 * x4_bar - W11_5 * x5_bar - W11_6 * x6_bar - W11_7 * x7_bar;
        const vector gap_65 = gap_64 - W11_8 * x8_bar - W11_9 * x9_bar - W11_10 * x10_bar - W11_11 * x11_bar;
        const vector gap_66 = gap_65 - W11_12 * x12_bar - W11_13 * x13_bar;
        const vector total_49 = total_48 + z8 * gap_54 + z9 * gap_58 + z10 * gap_62 + z11 * gap_66;
        const vector gap_67 = -(W12_0 * x0_bar) - W12_1 * x1_bar - W12_2 * x2_bar - W12_3 * x3_bar;
        const vector gap_68 = gap_67 - W12_4 * x4_bar - W12_5 * x5_bar - W12_6 * x6_bar - W12_7 * x7_bar;
        const vector gap_69 = gap_68 - W12_8 * x8_bar - W12_9 * x9_bar - W12_10 * x10_bar - W12_11 * x11_bar;
        const vector gap_70 = gap_69 - W12_12 * x12_bar - W12_13 * x13_bar;
        const vector by_phi = total_49 + z12 * gap_70 + z13 * gap_18;
        const vector phi_product = phi * by_phi;
        const vector by_z13 = phi * gap_18 - z13 * phi_product;
        const vector by_z12 = phi * gap_70 - z12 * phi_product;
        const vector by_z11 = phi * gap_66 - z11 * phi_product;
        const vector by_z10 = phi * gap_62 - z10 * phi_product;
        const vector by_z9 = phi * gap_58 - z9 * phi_product;
        const vector total_50 = W13_0 * by_z13 + W12_0 * by_z12 + W11_0 * by_z11 + W10_0 * by_z10 + W9_0 * by_z9;
        const vector by_z8 = phi * gap_54 - z8 * phi_product;
        const vector by_z7 = phi * gap_50 - z7 * phi_product;
        const vector by_z6 = phi * gap_46 - z6 * phi_product;
        const vector by_z5 = phi * gap_42 - z5 * phi_product;
        const vector total_51 = total_50 + W8_0 * by_z8 + W7_0 * by_z7 + W6_0 * by_z6 + W5_0 * by_z5;
        const vector by_z4 = phi * gap_38 - z4 * phi_product;
        const vector by_z3 = phi * gap_34 - z3 * phi_product;
        const vector by_z2 = phi * gap_30 - z2 * phi_product;
        const vector by_z1 = phi * gap_26 - z1 * phi_product;
        const vector total_52 = total_51 + W4_0 * by_z4 + W3_0 * by_z3 + W2_0 * by_z2 + W1_0 * by_z1;
        const vector by_z0 = phi * gap_22 - z0 * phi_product;
        const vector by_v0 = total_52 + W0_0 * by_z0;
        const vector total_53 = W13_1 * by_z13 + W12_1 * by_z12 + W11_1 * by_z11 + W10_1 * by_z10 + W9_1 * by_z9;
        const vector total_54 = total_53 + W8_1 * by_z8 + W7_1 * by_z7 + W6_1 * by_z6 + W5_1 * by_z5;
        const vector total_55 = total_54 + W4_1 * by_z4 + W3_1 * by_z3 + W2_1 * by_z2 + W1_1 * by_z1;
        const vector by_v1 = total_55 + W0_1 * by_z0;
        const vector total_56 = W13_2 * by_z13 + W12_2 * by_z12 + W11_2 * by_z11 + W10_2 * by_z10 + W9_2 * by_z9;
        const vector total_57 = total_56 + W8_2 * by_z8 + W7_2 * by_z7 + W6_2 * by_z6 + W5_2 * by_z5;
        const vector total_58 = total_57 + W4_2 * by_z4 + W3_2 * by_z3 + W2_2 * by_z2 + W1_2 * by_z1;
        const vector by_v2 = total_58 + W0_2 * by_z0;
        const vector total_59 = W13_3 * by_z13 + W12_3 * by_z12 + W11_3 * by_z11 + W10_3 * by_z10 + W9_3 * by_z9;
        const vector total_60 = total_59 + W8_3 * by_z8 + W7_3 * by_z7 + W6_3 * by_z6 + W5_3 * by_z5;
        const vector total_61 = total_60 + W4_3 * by_z4 + W3_3 * by_z3 + W2_3 * by_z2 + W1_3 * by_z1;
        const vector by_v3 = total_61 + W0_3 * by_z0;
        const vector total_62 = W13_4 * by_z13 + W12_4 * by_z12 + W11_4 * by_z11 + W10_4 * by_z10 + W9_4 * by_z9;
        const vector total_63 = total_62 + W8_4 * by_z8 + W7_4 * by_z7 + W6_4 * by_z6 + W5_4 * by_z5;
        const vector total_64 = total_63 + W4_4 * by_z4 + W3_4 * by_z3 + W2_4 * by_z2 + W1_4 * by_z1;
        const vector by_v4 = total_64 + W0_4 * by_z0;
        const vector total_65 = W13_5 * by_z13 + W12_5 * by_z12 + W11_5 * by_z11 + W10_5 * by_z10 + W9_5 * by_z9;
        const vector total_66 = total_65 + W8_5 * by_z8 + W7_5 * by_z7 + W6_5 * by_z6 + W5_5 * by_z5;
        const vector total_67 = total_66 + W4_5 * by_z4 + W3_5 * by_z3 + W2_5 * by_z2 + W1_5 * by_z1;
        const vector by_v5 = total_67 + W0_5 * by_z0;
        const vector total_68 = W13_6 * by_z13 + W12_6 * by_z12 + W11_6 * by_z11 + W10_6 * by_z10 + W9_6 * by_z9;
        const vector total_69 = total_68 + W8_6 * by_z8 + W7_6 * by_z7 + W6_6 * by_z6 + W5_6 * by_z5;
        const vector total_70 = total_69 + W4_6 * by_z4 + W3_6 * by_z3 + W2_6 * by_z2 + W1_6 * by_z1;
        const vector by_v6 = total_70 + W0_6 * by_z0;
        const vector total_71 = W13_7 * by_z13 + W12_7 * by_z12 + W11_7 * by_z11 + W10_7 * by_z10 + W9_7 * by_z9;
        const vector total_72 = total_71 + W8_7 * by_z8 + W7_7 * by_z7 + W6_7 * by_z6 + W5_7 * by_z5;
        const vector total_73 = total_72 + W4_7 * by_z4 + W3_7 * by_z3 + W2_7 * by_z2 + W1_7 * by_z1;
        const vector by_v7 = total_73 + W0_7 * by_z0;
        const vector total_74 = W13_8 * by_z13 + W12_8 * by_z12 + W11_8 * by_z11 + W10_8 * by_z10 + W9_8 * by_z9;
        const vector total_75 = total_74 + W8_8 * by_z8 + W7_8 * by_z7 + W6_8 * by_z6 + W5_8 * by_z5;
        const vector total_76 = total_75 + W4_8 * by_z4 + W3_8 * by_z3 + W2_8 * by_z2 + W1_8 * by_z1;
        const vector by_v8 = total_76 + W0_8 * by_z0;
        const vector total_77 = W13_9 * by_z13 + W12_9 * by_z12 + W11_9 * by_z11 + W10_9 * by_z10 + W9_9 * by_z9;
        const vector total_78 = total_77 + W8_9 * by_z8 + W7_9 * by_z7 + W6_9 * by_z6 + W5_9 * by_z5;
        const vector total_79 = total_78 + W4_9 * by_z4 + W3_9 * by_z3 + W2_9 * by_z2 + W1_9 * by_z1;
        const vector by_v9 = total_79 + W0_9 * by_z0;
        const vector total_80 = W13_10 * by_z13 + W12_10 * by_z12 + W11_10 * by_z11 + W10_10 * by_z10 + W9_10 *
            by_z9;
        const vector total_81 = total_80 + W8_10 * by_z8 + W7_10 * by_z7 + W6_10 * by_z6 + W5_10 * by_z5;
        const vector total_82 = total_81 + W4_10 * by_z4 + W3_10 * by_z3 + W2_10 * by_z2 + W1_10 * by_z1;
        const vector by_v10 = total_82 + W0_10 * by_z0;
        const vector total_83 = W13_11 * by_z13 + W12_11 * by_z12 + W11_11 * by_z11 + W10_11 * by_z10 + W9_11 *
            by_z9;
        const vector total_84 = total_83 + W8_11 * by_z8 + W7_11 * by_z7 + W6_11 * by_z6 + W5_11 * by_z5;
        const vector total_85 = total_84 + W4_11 * by_z4 + W3_11 * by_z3 + W2_11 * by_z2 + W1_11 * by_z1;
        const vector by_v11 = total_85 + W0_11 * by_z0;
        const vector total_86 = W13_12 * by_z13 + W12_12 * by_z12 + W11_12 * by_z11 + W10_12 * by_z10 + W9_12 *
            by_z9;
        const vector total_87 = total_86 + W8_12 * by_z8 + W7_12 * by_z7 + W6_12 * by_z6 + W5_12 * by_z5;
        const vector total_88 = total_87 + W4_12 * by_z4 + W3_12 * by_z3 + W2_12 * by_z2 + W1_12 * by_z1;
        const vector by_v12 = total_88 + W0_12 * by_z0;
        const vector total_89 = W13_13 * by_z13 + W12_13 * by_z12 + W11_13 * by_z11 + W10_13 * by_z10 + W9_13 *
            by_z9;
        const vector total_90 = total_89 + W8_13 * by_z8 + W7_13 * by_z7 + W6_13 * by_z6 + W5_13 * by_z5;
        const vector total_91 = total_90 + W4_13 * by_z4 + W3_13 * by_z3 + W2_13 * by_z2 + W1_13 * by_z1;
        const vector by_v13 = total_91 + W0_13 * by_z0;
        const vector z0_product = z0 * phi;
        const vector z1_product = z1 * phi;
        const vector z2_product = z2 * phi;
        const vector z3_product = z3 * phi;
        const vector z4_product = z4 * phi;
        const vector z5_product = z5 * phi;
        const vector z6_product = z6 * phi;
        const vector z7_product = z7 * phi;
        const vector z8_product = z8 * phi;
        const vector z9_product = z9 * phi;
        const vector z10_product = z10 * phi;
        const vector z11_product = z11 * phi;
        const vector z12_product = z12 * phi;
        const vector z13_product = z13 * phi;
        factor[0] = v0;
        factor[1] = v1;
        factor[2] = v2;
        factor[3] = v3;
        factor[4] = v4;
        factor[5] = v5;
        factor[6] = v6;
        factor[7] = v7;
        factor[8] = v8;
        factor[9] = v9;
        factor[10] = v10;
        factor[11] = v11;
        factor[12] = v12;
        factor[13] = v13;
        factor[14] = phi_product;
        factor[15] = by_z13;
        factor[16] = by_z12;
        factor[17] = by_z11;
        factor[18] = by_z10;
        factor[19] = by_z9;
        factor[20] = by_z8;
        factor[21] = by_z7;
        factor[22] = by_z6;
        factor[23] = by_z5;
        factor[24] = by_z4;
        factor[25] = by_z3;
        factor[26] = by_z2;
        factor[27] = by_z1;
        factor[28] = by_z0;
        factor[29] = -by_v0;
        factor[30] = -by_v1;
        factor[31] = -by_v2;
        factor[32] = -by_v3;
        factor[33] = -by_v4;
        factor[34] = -by_v5;
        factor[35] = -by_v6;
        factor[36] = -by_v7;
        factor[37] = -by_v8;
        factor[38] = -by_v9;
        factor[39] = -by_v10;
        factor[40] = -by_v11;
        factor[41] = -by_v12;
        factor[42] = -by_v13;
        factor[43] = z0_product;
        factor[44] = z1_product;
        factor[45] = z2_product;
        factor[46] = z3_product;
        factor[47] = z4_product;
        factor[48] = z5_product;
        factor[49] = z6_product;
        factor[50] = z7_product;
        factor[51] = z8_product;
        factor[52] = z9_product;
        factor[53] = z10_product;
        factor[54] = z11_product;
        factor[55] = z12_product;
        factor[56] = z13_product;
    }
}

/* Adds some of the sums, as products. */
INLINE void pair_products_0(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[29];
    sum[1] = sum[1] + factor[30];
    sum[2] = sum[2] + factor[31];
    sum[3] = sum[3] + factor[32];
    sum[4] = sum[4] + factor[33];
    sum[5] = sum[5] + factor[34];
    sum[6] = sum[6] + factor[35];
    sum[7] = sum[7] + factor[36];
    sum[8] = sum[8] + factor[37];
    sum[9] = sum[9] + factor[38];
    sum[10] = sum[10] + factor[39];
    sum[11] = sum[11] + factor[40];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_1(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[41];
    sum[1] = sum[1] + factor[42];
    sum[2] = sum[2] + factor[14];
    sum[3] = sum[3] + factor[0] * factor[28] - factor[43] * point[15];
    sum[4] = sum[4] + factor[1] * factor[28] - factor[43] * point[16];
    sum[5] = sum[5] + factor[2] * factor[28] - factor[43] * point[17];
    sum[6] = sum[6] + factor[3] * factor[28] - factor[43] * point[18];
    sum[7] = sum[7] + factor[4] * factor[28] - factor[43] * point[19];
    sum[8] = sum[8] + factor[5] * factor[28] - factor[43] * point[20];
    sum[9] = sum[9] + factor[6] * factor[28] - factor[43] * point[21];
    sum[10] = sum[10] + factor[7] * factor[28] - factor[43] * point[22];
    sum[11] = sum[11] + factor[8] * factor[28] - factor[43] * point[23];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_2(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[9] * factor[28] - factor[43] * point[24];
    sum[1] = sum[1] + factor[10] * factor[28] - factor[43] * point[25];
    sum[2] = sum[2] + factor[11] * factor[28] - factor[43] * point[26];
    sum[3] = sum[3] + factor[12] * factor[28] - factor[43] * point[27];
    sum[4] = sum[4] + factor[13] * factor[28] - factor[43] * point[28];
    sum[5] = sum[5] + factor[9] * factor[27] - factor[44] * point[24];
    sum[6] = sum[6] + factor[10] * factor[27] - factor[44] * point[25];
    sum[7] = sum[7] + factor[11] * factor[27] - factor[44] * point[26];
    sum[8] = sum[8] + factor[12] * factor[27] - factor[44] * point[27];
    sum[9] = sum[9] + factor[13] * factor[27] - factor[44] * point[28];
    sum[10] = sum[10] + factor[0] * factor[27] - factor[44] * point[15];
    sum[11] = sum[11] + factor[1] * factor[27] - factor[44] * point[16];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_3(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[27] - factor[44] * point[17];
    sum[1] = sum[1] + factor[3] * factor[27] - factor[44] * point[18];
    sum[2] = sum[2] + factor[4] * factor[27] - factor[44] * point[19];
    sum[3] = sum[3] + factor[5] * factor[27] - factor[44] * point[20];
    sum[4] = sum[4] + factor[6] * factor[27] - factor[44] * point[21];
    sum[5] = sum[5] + factor[7] * factor[27] - factor[44] * point[22];
    sum[6] = sum[6] + factor[8] * factor[27] - factor[44] * point[23];
    sum[7] = sum[7] + factor[2] * factor[26] - factor[45] * point[17];
    sum[8] = sum[8] + factor[3] * factor[26] - factor[45] * point[18];
    sum[9] = sum[9] + factor[4] * factor[26] - factor[45] * point[19];
    sum[10] = sum[10] + factor[5] * factor[26] - factor[45] * point[20];
    sum[11] = sum[11] + factor[6] * factor[26] - factor[45] * point[21];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_4(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[26] - factor[45] * point[15];
    sum[1] = sum[1] + factor[1] * factor[26] - factor[45] * point[16];
    sum[2] = sum[2] + factor[7] * factor[26] - factor[45] * point[22];
    sum[3] = sum[3] + factor[8] * factor[26] - factor[45] * point[23];
    sum[4] = sum[4] + factor[9] * factor[26] - factor[45] * point[24];
    sum[5] = sum[5] + factor[10] * factor[26] - factor[45] * point[25];
    sum[6] = sum[6] + factor[11] * factor[26] - factor[45] * point[26];
    sum[7] = sum[7] + factor[12] * factor[26] - factor[45] * point[27];
    sum[8] = sum[8] + factor[13] * factor[26] - factor[45] * point[28];
    sum[9] = sum[9] + factor[0] * factor[25] - factor[46] * point[15];
    sum[10] = sum[10] + factor[1] * factor[25] - factor[46] * point[16];
    sum[11] = sum[11] + factor[7] * factor[25] - factor[46] * point[22];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_5(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[25] - factor[46] * point[17];
    sum[1] = sum[1] + factor[3] * factor[25] - factor[46] * point[18];
    sum[2] = sum[2] + factor[4] * factor[25] - factor[46] * point[19];
    sum[3] = sum[3] + factor[5] * factor[25] - factor[46] * point[20];
    sum[4] = sum[4] + factor[6] * factor[25] - factor[46] * point[21];
    sum[5] = sum[5] + factor[8] * factor[25] - factor[46] * point[23];
    sum[6] = sum[6] + factor[9] * factor[25] - factor[46] * point[24];
    sum[7] = sum[7] + factor[10] * factor[25] - factor[46] * point[25];
    sum[8] = sum[8] + factor[11] * factor[25] - factor[46] * point[26];
    sum[9] = sum[9] + factor[12] * factor[25] - factor[46] * point[27];
    sum[10] = sum[10] + factor[13] * factor[25] - factor[46] * point[28];
    sum[11] = sum[11] + factor[2] * factor[24] - factor[47] * point[17];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_6(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[24] - factor[47] * point[15];
    sum[1] = sum[1] + factor[1] * factor[24] - factor[47] * point[16];
    sum[2] = sum[2] + factor[3] * factor[24] - factor[47] * point[18];
    sum[3] = sum[3] + factor[4] * factor[24] - factor[47] * point[19];
    sum[4] = sum[4] + factor[5] * factor[24] - factor[47] * point[20];
    sum[5] = sum[5] + factor[6] * factor[24] - factor[47] * point[21];
    sum[6] = sum[6] + factor[7] * factor[24] - factor[47] * point[22];
    sum[7] = sum[7] + factor[8] * factor[24] - factor[47] * point[23];
    sum[8] = sum[8] + factor[9] * factor[24] - factor[47] * point[24];
    sum[9] = sum[9] + factor[10] * factor[24] - factor[47] * point[25];
    sum[10] = sum[10] + factor[11] * factor[24] - factor[47] * point[26];
    sum[11] = sum[11] + factor[12] * factor[24] - factor[47] * point[27];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_7(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[13] * factor[24] - factor[47] * point[28];
    sum[1] = sum[1] + factor[13] * factor[23] - factor[48] * point[28];
    sum[2] = sum[2] + factor[0] * factor[23] - factor[48] * point[15];
    sum[3] = sum[3] + factor[1] * factor[23] - factor[48] * point[16];
    sum[4] = sum[4] + factor[2] * factor[23] - factor[48] * point[17];
    sum[5] = sum[5] + factor[3] * factor[23] - factor[48] * point[18];
    sum[6] = sum[6] + factor[4] * factor[23] - factor[48] * point[19];
    sum[7] = sum[7] + factor[5] * factor[23] - factor[48] * point[20];
    sum[8] = sum[8] + factor[6] * factor[23] - factor[48] * point[21];
    sum[9] = sum[9] + factor[7] * factor[23] - factor[48] * point[22];
    sum[10] = sum[10] + factor[8] * factor[23] - factor[48] * point[23];
    sum[11] = sum[11] + factor[9] * factor[23] - factor[48] * point[24];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_8(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[10] * factor[23] - factor[48] * point[25];
    sum[1] = sum[1] + factor[11] * factor[23] - factor[48] * point[26];
    sum[2] = sum[2] + factor[12] * factor[23] - factor[48] * point[27];
    sum[3] = sum[3] + factor[10] * factor[22] - factor[49] * point[25];
    sum[4] = sum[4] + factor[11] * factor[22] - factor[49] * point[26];
    sum[5] = sum[5] + factor[12] * factor[22] - factor[49] * point[27];
    sum[6] = sum[6] + factor[0] * factor[22] - factor[49] * point[15];
    sum[7] = sum[7] + factor[1] * factor[22] - factor[49] * point[16];
    sum[8] = sum[8] + factor[2] * factor[22] - factor[49] * point[17];
    sum[9] = sum[9] + factor[3] * factor[22] - factor[49] * point[18];
    sum[10] = sum[10] + factor[4] * factor[22] - factor[49] * point[19];
    sum[11] = sum[11] + factor[5] * factor[22] - factor[49] * point[20];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_9(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[6] * factor[22] - factor[49] * point[21];
    sum[1] = sum[1] + factor[7] * factor[22] - factor[49] * point[22];
    sum[2] = sum[2] + factor[8] * factor[22] - factor[49] * point[23];
    sum[3] = sum[3] + factor[9] * factor[22] - factor[49] * point[24];
    sum[4] = sum[4] + factor[13] * factor[22] - factor[49] * point[28];
    sum[5] = sum[5] + factor[6] * factor[21] - factor[50] * point[21];
    sum[6] = sum[6] + factor[7] * factor[21] - factor[50] * point[22];
    sum[7] = sum[7] + factor[8] * factor[21] - factor[50] * point[23];
    sum[8] = sum[8] + factor[9] * factor[21] - factor[50] * point[24];
    sum[9] = sum[9] + factor[13] * factor[21] - factor[50] * point[28];
    sum[10] = sum[10] + factor[0] * factor[21] - factor[50] * point[15];
    sum[11] = sum[11] + factor[1] * factor[21] - factor[50] * point[16];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_10(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[21] - factor[50] * point[17];
    sum[1] = sum[1] + factor[3] * factor[21] - factor[50] * point[18];
    sum[2] = sum[2] + factor[4] * factor[21] - factor[50] * point[19];
    sum[3] = sum[3] + factor[5] * factor[21] - factor[50] * point[20];
    sum[4] = sum[4] + factor[10] * factor[21] - factor[50] * point[25];
    sum[5] = sum[5] + factor[11] * factor[21] - factor[50] * point[26];
    sum[6] = sum[6] + factor[12] * factor[21] - factor[50] * point[27];
    sum[7] = sum[7] + factor[2] * factor[20] - factor[51] * point[17];
    sum[8] = sum[8] + factor[3] * factor[20] - factor[51] * point[18];
    sum[9] = sum[9] + factor[4] * factor[20] - factor[51] * point[19];
    sum[10] = sum[10] + factor[5] * factor[20] - factor[51] * point[20];
    sum[11] = sum[11] + factor[10] * factor[20] - factor[51] * point[25];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_11(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[20] - factor[51] * point[15];
    sum[1] = sum[1] + factor[1] * factor[20] - factor[51] * point[16];
    sum[2] = sum[2] + factor[6] * factor[20] - factor[51] * point[21];
    sum[3] = sum[3] + factor[7] * factor[20] - factor[51] * point[22];
    sum[4] = sum[4] + factor[8] * factor[20] - factor[51] * point[23];
    sum[5] = sum[5] + factor[9] * factor[20] - factor[51] * point[24];
    sum[6] = sum[6] + factor[11] * factor[20] - factor[51] * point[26];
    sum[7] = sum[7] + factor[12] * factor[20] - factor[51] * point[27];
    sum[8] = sum[8] + factor[13] * factor[20] - factor[51] * point[28];
    sum[9] = sum[9] + factor[0] * factor[19] - factor[52] * point[15];
    sum[10] = sum[10] + factor[1] * factor[19] - factor[52] * point[16];
    sum[11] = sum[11] + factor[6] * factor[19] - factor[52] * point[21];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_12(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[19] - factor[52] * point[17];
    sum[1] = sum[1] + factor[3] * factor[19] - factor[52] * point[18];
    sum[2] = sum[2] + factor[4] * factor[19] - factor[52] * point[19];
    sum[3] = sum[3] + factor[5] * factor[19] - factor[52] * point[20];
    sum[4] = sum[4] + factor[7] * factor[19] - factor[52] * point[22];
    sum[5] = sum[5] + factor[8] * factor[19] - factor[52] * point[23];
    sum[6] = sum[6] + factor[9] * factor[19] - factor[52] * point[24];
    sum[7] = sum[7] + factor[10] * factor[19] - factor[52] * point[25];
    sum[8] = sum[8] + factor[11] * factor[19] - factor[52] * point[26];
    sum[9] = sum[9] + factor[12] * factor[19] - factor[52] * point[27];
    sum[10] = sum[10] + factor[13] * factor[19] - factor[52] * point[28];
    sum[11] = sum[11] + factor[2] * factor[18] - factor[53] * point[17];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_13(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[18] - factor[53] * point[15];
    sum[1] = sum[1] + factor[1] * factor[18] - factor[53] * point[16];
    sum[2] = sum[2] + factor[3] * factor[18] - factor[53] * point[18];
    sum[3] = sum[3] + factor[4] * factor[18] - factor[53] * point[19];
    sum[4] = sum[4] + factor[5] * factor[18] - factor[53] * point[20];
    sum[5] = sum[5] + factor[6] * factor[18] - factor[53] * point[21];
    sum[6] = sum[6] + factor[7] * factor[18] - factor[53] * point[22];
    sum[7] = sum[7] + factor[8] * factor[18] - factor[53] * point[23];
    sum[8] = sum[8] + factor[9] * factor[18] - factor[53] * point[24];
    sum[9] = sum[9] + factor[10] * factor[18] - factor[53] * point[25];
    sum[10] = sum[10] + factor[11] * factor[18] - factor[53] * point[26];
    sum[11] = sum[11] + factor[12] * factor[18] - factor[53] * point[27];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_14(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[13] * factor[18] - factor[53] * point[28];
    sum[1] = sum[1] + factor[13] * factor[17] - factor[54] * point[28];
    sum[2] = sum[2] + factor[0] * factor[17] - factor[54] * point[15];
    sum[3] = sum[3] + factor[1] * factor[17] - factor[54] * point[16];
    sum[4] = sum[4] + factor[2] * factor[17] - factor[54] * point[17];
    sum[5] = sum[5] + factor[3] * factor[17] - factor[54] * point[18];
    sum[6] = sum[6] + factor[4] * factor[17] - factor[54] * point[19];
    sum[7] = sum[7] + factor[5] * factor[17] - factor[54] * point[20];
    sum[8] = sum[8] + factor[6] * factor[17] - factor[54] * point[21];
    sum[9] = sum[9] + factor[7] * factor[17] - factor[54] * point[22];
    sum[10] = sum[10] + factor[8] * factor[17] - factor[54] * point[23];
    sum[11] = sum[11] + factor[9] * factor[17] - factor[54] * point[24];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_15(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[10] * factor[17] - factor[54] * point[25];
    sum[1] = sum[1] + factor[11] * factor[17] - factor[54] * point[26];
    sum[2] = sum[2] + factor[12] * factor[17] - factor[54] * point[27];
    sum[3] = sum[3] + factor[10] * factor[16] - factor[55] * point[25];
    sum[4] = sum[4] + factor[11] * factor[16] - factor[55] * point[26];
    sum[5] = sum[5] + factor[12] * factor[16] - factor[55] * point[27];
    sum[6] = sum[6] + factor[0] * factor[16] - factor[55] * point[15];
    sum[7] = sum[7] + factor[1] * factor[16] - factor[55] * point[16];
    sum[8] = sum[8] + factor[2] * factor[16] - factor[55] * point[17];
    sum[9] = sum[9] + factor[3] * factor[16] - factor[55] * point[18];
    sum[10] = sum[10] + factor[4] * factor[16] - factor[55] * point[19];
    sum[11] = sum[11] + factor[5] * factor[16] - factor[55] * point[20];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_16(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[6] * factor[16] - factor[55] * point[21];
    sum[1] = sum[1] + factor[7] * factor[16] - factor[55] * point[22];
    sum[2] = sum[2] + factor[8] * factor[16] - factor[55] * point[23];
    sum[3] = sum[3] + factor[9] * factor[16] - factor[55] * point[24];
    sum[4] = sum[4] + factor[13] * factor[16] - factor[55] * point[28];
    sum[5] = sum[5] + factor[6] * factor[15] - factor[56] * point[21];
    sum[6] = sum[6] + factor[7] * factor[15] - factor[56] * point[22];
    sum[7] = sum[7] + factor[8] * factor[15] - factor[56] * point[23];
    sum[8] = sum[8] + factor[9] * factor[15] - factor[56] * point[24];
    sum[9] = sum[9] + factor[13] * factor[15] - factor[56] * point[28];
    sum[10] = sum[10] + factor[0] * factor[15] - factor[56] * point[15];
    sum[11] = sum[11] + factor[1] * factor[15] - factor[56] * point[16];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_17(const vector *factor, const vector *point, vector *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[15] - factor[56] * point[17];
    sum[1] = sum[1] + factor[3] * factor[15] - factor[56] * point[18];
    sum[2] = sum[2] + factor[4] * factor[15] - factor[56] * point[19];
    sum[3] = sum[3] + factor[5] * factor[15] - factor[56] * point[20];
    sum[4] = sum[4] + factor[10] * factor[15] - factor[56] * point[25];
    sum[5] = sum[5] + factor[11] * factor[15] - factor[56] * point[26];
    sum[6] = sum[6] + factor[12] * factor[15] - factor[56] * point[27];
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
    const vector sum91 = sums[91];
    const vector sum92 = sums[92];
    const vector sum93 = sums[93];
    const vector sum94 = sums[94];
    const vector sum95 = sums[95];
    const vector sum96 = sums[96];
    const vector sum97 = sums[97];
    const vector sum98 = sums[98];
    const vector sum99 = sums[99];
    const vector sum100 = sums[100];
    const vector sum101 = sums[101];
    const vector sum102 = sums[102];
    const vector sum103 = sums[103];
    const vector sum104 = sums[104];
    const vector sum105 = sums[105];
    const vector sum106 = sums[106];
    const vector sum107 = sums[107];
    const vector sum108 = sums[108];
    const vector sum109 = sums[109];
    const vector sum110 = sums[110];
    const vector sum111 = sums[111];
    const vector sum112 = sums[112];
    const vector sum113 = sums[113];
    const vector sum114 = sums[114];
    const vector sum115 = sums[115];
    const vector sum116 = sums[116];
    const vector sum117 = sums[117];
    const vector sum118 = sums[118];
    const vector sum119 = sums[119];
    const vector sum120 = sums[120];
    const vector sum121 = sums[121];
    const vector sum122 = sums[122];
    const vector sum123 = sums[123];
    const vector sum124 = sums[124];
    const vector sum125 = sums[125];
    const vector sum126 = sums[126];
    const vector sum127 = sums[127];
    const vector sum128 = sums[128];
    const vector sum129 = sums[129];
    const vector sum130 = sums[130];
    const vector sum131 = sums[131];
    const vector sum132 = sums[132];
    const vector sum133 = sums[133];
    const vector sum134 = sums[134];
    const vector sum135 = sums[135];
    const vector sum136 = sums[136];
    const vector sum137 = sums[137];
    const vector sum138 = sums[138];
    const vector sum139 = sums[139];
    const vector sum140 = sums[140];
    const vector sum141 = sums[141];
    const vector sum142 = sums[142];
    const vector sum143 = sums[143];
    const vector sum144 = sums[144];
    const vector sum145 = sums[145];
    const vector sum146 = sums[146];
    const vector sum147 = sums[147];
    const vector sum148 = sums[148];
    const vector sum149 = sums[149];
    const vector sum150 = sums[150];
    const vector sum151 = sums[151];
    const vector sum152 = sums[152];
    const vector sum153 = sums[153];
    const vector sum154 = sums[154];
    const vector sum155 = sums[155];
    const vector sum156 = sums[156];
    const vector sum157 = sums[157];
    const vector sum158 = sums[158];
    const vector sum159 = sums[159];
    const vector sum160 = sums[160];
    const vector sum161 = sums[161];
    const vector sum162 = sums[162];
    const vector sum163 = sums[163];
    const vector sum164 = sums[164];
    const vector sum165 = sums[165];
    const vector sum166 = sums[166];
    const vector sum167 = sums[167];
    const vector sum168 = sums[168];
    const vector sum169 = sums[169];
    const vector sum170 = sums[170];
    const vector sum171 = sums[171];
    const vector sum172 = sums[172];
    const vector sum173 = sums[173];
    const vector sum174 = sums[174];
    const vector sum175 = sums[175];
    const vector sum176 = sums[176];
    const vector sum177 = sums[177];
    const vector sum178 = sums[178];
    const vector sum179 = sums[179];
    const vector sum180 = sums[180];
    const vector sum181 = sums[181];
    const vector sum182 = sums[182];
    const vector sum183 = sums[183];
    const vector sum184 = sums[184];
    const vector sum185 = sums[185];
    const vector sum186 = sums[186];
    const vector sum187 = sums[187];
    const vector sum188 = sums[188];
    const vector sum189 = sums[189];
    const vector sum190 = sums[190];
    const vector sum191 = sums[191];
    const vector sum192 = sums[192];
    const vector sum193 = sums[193];
    const vector sum194 = sums[194];
    const vector sum195 = sums[195];
    const vector sum196 = sums[196];
    const vector sum197 = sums[197];
    const vector sum198 = sums[198];
    const vector sum199 = sums[199];
    const vector sum200 = sums[200];
    const vector sum201 = sums[201];
    const vector sum202 = sums[202];
    const vector sum203 = sums[203];
    const vector sum204 = sums[204];
    const vector sum205 = sums[205];
    const vector sum206 = sums[206];
    const vector sum207 = sums[207];
    const vector sum208 = sums[208];
    const vector sum209 = sums[209];
    const vector sum210 = sums[210];
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = its_amplitude * sum1;
    mu_bar[2] = its_amplitude * sum2;
    mu_bar[3] = its_amplitude * sum3;
    mu_bar[4] = its_amplitude * sum4;
    mu_bar[5] = its_amplitude * sum5;
    mu_bar[6] = its_amplitude * sum6;
    mu_bar[7] = its_amplitude * sum7;
    mu_bar[8] = its_amplitude * sum8;
    mu_bar[9] = its_amplitude * sum9;
    mu_bar[10] = its_amplitude * sum10;
    mu_bar[11] = its_amplitude * sum11;
    mu_bar[12] = its_amplitude * sum12;
    mu_bar[13] = its_amplitude * sum13;
    W_bar[0] = its_amplitude * sum14;
    W_bar[1] = its_amplitude * sum15;
    W_bar[2] = its_amplitude * sum16;
    W_bar[3] = its_amplitude * sum17;
    W_bar[4] = its_amplitude * sum18;
    W_bar[5] = its_amplitude * sum19;
    W_bar[6] = its_amplitude * sum20;
    W_bar[7] = its_amplitude * sum21;
    W_bar[8] = its_amplitude * sum22;
    W_bar[9] = its_amplitude * sum23;
    W_bar[10] = its_amplitude * sum24;
    W_bar[11] = its_amplitude * sum25;
    W_bar[12] = its_amplitude * sum26;
    W_bar[13] = its_amplitude * sum27;
    W_bar[14] = its_amplitude * sum28;
    W_bar[15] = its_amplitude * sum29;
    W_bar[16] = its_amplitude * sum30;
    W_bar[17] = its_amplitude * sum31;
    W_bar[18] = its_amplitude * sum32;
    W_bar[19] = its_amplitude * sum33;
    W_bar[20] = its_amplitude * sum34;
    W_bar[21] = its_amplitude * sum35;
    W_bar[22] = its_amplitude * sum36;
    W_bar[23] = its_amplitude * sum37;
    W_bar[24] = its_amplitude * sum38;
    W_bar[25] = its_amplitude * sum39;
    W_bar[26] = its_amplitude * sum40;
    W_bar[27] = its_amplitude * sum41;
    W_bar[28] = its_amplitude * sum42;
    W_bar[29] = its_amplitude * sum43;
    W_bar[30] = its_amplitude * sum44;
    W_bar[31] = its_amplitude * sum45;
    W_bar[32] = its_amplitude * sum46;
    W_bar[33] = its_amplitude * sum47;
    W_bar[34] = its_amplitude * sum48;
    W_bar[35] = its_amplitude * sum49;
    W_bar[36] = its_amplitude * sum50;
    W_bar[37] = its_amplitude * sum51;
    W_bar[38] = its_amplitude * sum52;
    W_bar[39] = its_amplitude * sum53;
    W_bar[40] = its_amplitude * sum54;
    W_bar[41] = its_amplitude * sum55;
    W_bar[42] = its_amplitude * sum56;
    W_bar[43] = its_amplitude * sum57;
    W_bar[44] = its_amplitude * sum58;
    W_bar[45] = its_amplitude * sum59;
    W_bar[46] = its_amplitude * sum60;
    W_bar[47] = its_amplitude * sum61;
    W_bar[48] = its_amplitude * sum62;
    W_bar[49] = its_amplitude * sum63;
    W_bar[50] = its_amplitude * sum64;
    W_bar[51] = its_amplitude * sum65;
    W_bar[52] = its_amplitude * sum66;
    W_bar[53] = its_amplitude * sum67;
    W_bar[54] = its_amplitude * sum68;
    W_bar[55] = its_amplitude * sum69;
    W_bar[56] = its_amplitude * sum70;
    W_bar[57] = its_amplitude * sum71;
    W_bar[58] = its_amplitude * sum72;
    W_bar[59] = its_amplitude * sum73;
    W_bar[60] = its_amplitude * sum74;
    W_bar[61] = its_amplitude * sum75;
    W_bar[62] = its_amplitude * sum76;
    W_bar[63] = its_amplitude * sum77;
    W_bar[64] = its_amplitude * sum78;
    W_bar[65] = its_amplitude * sum79;
    W_bar[66] = its_amplitude * sum80;
    W_bar[67] = its_amplitude * sum81;
    W_bar[68] = its_amplitude * sum82;
    W_bar[69] = its_amplitude * sum83;
    W_bar[70] = its_amplitude * sum84;
    W_bar[71] = its_amplitude * sum85;
    W_bar[72] = its_amplitude * sum86;
    W_bar[73] = its_amplitude * sum87;
    W_bar[74] = its_amplitude * sum88;
    W_bar[75] = its_amplitude * sum89;
    W_bar[76] = its_amplitude * sum90;
    W_bar[77] = its_amplitude * sum91;
    W_bar[78] = its_amplitude * sum92;
    W_bar[79] = its_amplitude * sum93;
    W_bar[80] = its_amplitude * sum94;
    W_bar[81] = its_amplitude * sum95;
    W_bar[82] = its_amplitude * sum96;
    W_bar[83] = its_amplitude * sum97;
    W_bar[84] = its_amplitude * sum98;
    W_bar[85] = its_amplitude * sum99;
    W_bar[86] = its_amplitude * sum100;
    W_bar[87] = its_amplitude * sum101;
    W_bar[88] = its_amplitude * sum102;
    W_bar[89] = its_amplitude * sum103;
    W_bar[90] = its_amplitude * sum104;
    W_bar[91] = its_amplitude * sum105;
    W_bar[92] = its_amplitude * sum106;
    W_bar[93] = its_amplitude * sum107;
    W_bar[94] = its_amplitude * sum108;
    W_bar[95] = its_amplitude * sum109;
    W_bar[96] = its_amplitude * sum110;
    W_bar[97] = its_amplitude * sum111;
    W_bar[98] = its_amplitude * sum112;
    W_bar[99] = its_amplitude * sum113;
    W_bar[100] = its_amplitude * sum114;
    W_bar[101] = its_amplitude * sum115;
    W_bar[102] = its_amplitude * sum116;
    W_bar[103] = its_amplitude * sum117;
    W_bar[104] = its_amplitude * sum118;
    W_bar[105] = its_amplitude * sum119;
    W_bar[106] = its_amplitude * sum120;
    W_bar[107] = its_amplitude * sum121;
    W_bar[108] = its_amplitude * sum122;
    W_bar[109] = its_amplitude * sum123;
    W_bar[110] = its_amplitude * sum124;
    W_bar[111] = its_amplitude * sum125;
    W_bar[112] = its_amplitude * sum126;
    W_bar[113] = its_amplitude * sum127;
    W_bar[114] = its_amplitude * sum128;
    W_bar[115] = its_amplitude * sum129;
    W_bar[116] = its_amplitude * sum130;
    W_bar[117] = its_amplitude * sum131;
    W_bar[118] = its_amplitude * sum132;
    W_bar[119] = its_amplitude * sum133;
    W_bar[120] = its_amplitude * sum134;
    W_bar[121] = its_amplitude * sum135;
    W_bar[122] = its_amplitude * sum136;
    W_bar[123] = its_amplitude * sum137;
    W_bar[124] = its_amplitude * sum138;
    W_bar[125] = its_amplitude * sum139;
    W_bar[126] = its_amplitude * sum140;
    W_bar[127] = its_amplitude * sum141;
    W_bar[128] = its_amplitude * sum142;
    W_bar[129] = its_amplitude * sum143;
    W_bar[130] = its_amplitude * sum144;
    W_bar[131] = its_amplitude * sum145;
    W_bar[132] = its_amplitude * sum146;
    W_bar[133] = its_amplitude * sum147;
    W_bar[134] = its_amplitude * sum148;
    W_bar[135] = its_amplitude * sum149;
    W_bar[136] = its_amplitude * sum150;
    W_bar[137] = its_amplitude * sum151;
    W_bar[138] = its_amplitude * sum152;
    W_bar[139] = its_amplitude * sum153;
    W_bar[140] = its_amplitude * sum154;
    W_bar[141] = its_amplitude * sum155;
    W_bar[142] = its_amplitude * sum156;
    W_bar[143] = its_amplitude * sum157;
    W_bar[144] = its_amplitude * sum158;
    W_bar[145] = its_amplitude * sum159;
    W_bar[146] = its_amplitude * sum160;
    W_bar[147] = its_amplitude * sum161;
    W_bar[148] = its_amplitude * sum162;
    W_bar[149] = its_amplitude * sum163;
    W_bar[150] = its_amplitude * sum164;
    W_bar[151] = its_amplitude * sum165;
    W_bar[152] = its_amplitude * sum166;
    W_bar[153] = its_amplitude * sum167;
    W_bar[154] = its_amplitude * sum168;
    W_bar[155] = its_amplitude * sum169;
    W_bar[156] = its_amplitude * sum170;
    W_bar[157] = its_amplitude * sum171;
    W_bar[158] = its_amplitude * sum172;
    W_bar[159] = its_amplitude * sum173;
    W_bar[160] = its_amplitude * sum174;
    W_bar[161] = its_amplitude * sum175;
    W_bar[162] = its_amplitude * sum176;
    W_bar[163] = its_amplitude * sum177;
    W_bar[164] = its_amplitude * sum178;
    W_bar[165] = its_amplitude * sum179;
    W_bar[166] = its_amplitude * sum180;
    W_bar[167] = its_amplitude * sum181;
    W_bar[168] = its_amplitude * sum182;
    W_bar[169] = its_amplitude * sum183;
    W_bar[170] = its_amplitude * sum184;
    W_bar[171] = its_amplitude * sum185;
    W_bar[172] = its_amplitude * sum186;
    W_bar[173] = its_amplitude * sum187;
    W_bar[174] = its_amplitude * sum188;
    W_bar[175] = its_amplitude * sum189;
    W_bar[176] = its_amplitude * sum190;
    W_bar[177] = its_amplitude * sum191;
    W_bar[178] = its_amplitude * sum192;
    W_bar[179] = its_amplitude * sum193;
    W_bar[180] = its_amplitude * sum194;
    W_bar[181] = its_amplitude * sum195;
    W_bar[182] = its_amplitude * sum196;
    W_bar[183] = its_amplitude * sum197;
    W_bar[184] = its_amplitude * sum198;
    W_bar[185] = its_amplitude * sum199;
    W_bar[186] = its_amplitude * sum200;
    W_bar[187] = its_amplitude * sum201;
    W_bar[188] = its_amplitude * sum202;
    W_bar[189] = its_amplitude * sum203;
    W_bar[190] = its_amplitude * sum204;
    W_bar[191] = its_amplitude * sum205;
    W_bar[192] = its_amplitude * sum206;
    W_bar[193] = its_amplitude * sum207;
    W_bar[194] = its_amplitude * sum208;
    W_bar[195] = its_amplitude * sum209;
    amplitude_bar[0] = sum210;
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
    const double p9 = p[9];
    const double p10 = p[10];
    const double p11 = p[11];
    const double p12 = p[12];
    const double p13 = p[13];
    const vector q0 = q[0];
    const vector q1 = q[1];
    const vector q2 = q[2];
    const vector q3 = q[3];
    const vector q4 = q[4];
    const vector q5 = q[5];
    const vector q6 = q[6];
    const vector q7 = q[7];
    const vector q8 = q[8];
    const vector q9 = q[9];
    const vector q10 = q[10];
    const vector q11 = q[11];
    const vector q12 = q[12];
    const vector q13 = q[13];
    const vector gap = q0 - p0;
    const vector round_2 = round_each(0.15915494309189535 * gap);
    const vector arm1_log0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const vector gap_2 = q1 - p1;
    const vector round_3 = round_each(0.15915494309189535 * gap_2);
    const vector arm1_log1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const vector gap_3 = q2 - p2;
    const vector round_4 = round_each(0.15915494309189535 * gap_3);
    const vector arm1_log2 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const vector gap_4 = q3 - p3;
    const vector round_5 = round_each(0.15915494309189535 * gap_4);
    const vector arm1_log3 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const vector gap_5 = q4 - p4;
    const vector round_6 = round_each(0.15915494309189535 * gap_5);
    const vector arm1_log4 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const vector gap_6 = q5 - p5;
    const vector round_7 = round_each(0.15915494309189535 * gap_6);
    const vector arm1_log5 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const vector gap_7 = q6 - p6;
    const vector round_8 = round_each(0.15915494309189535 * gap_7);
    const vector arm1_log6 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    const vector gap_8 = q7 - p7;
    const vector round_9 = round_each(0.15915494309189535 * gap_8);
    const vector arm2_log0 = gap_8 - 6.28125 * round_9 - 0.001935307179586477 * round_9;
    const vector gap_9 = q8 - p8;
    const vector round_10 = round_each(0.15915494309189535 * gap_9);
    const vector arm2_log1 = gap_9 - 6.28125 * round_10 - 0.001935307179586477 * round_10;
    const vector gap_10 = q9 - p9;
    const vector round_11 = round_each(0.15915494309189535 * gap_10);
    const vector arm2_log2 = gap_10 - 6.28125 * round_11 - 0.001935307179586477 * round_11;
    const vector gap_11 = q10 - p10;
    const vector round_12 = round_each(0.15915494309189535 * gap_11);
    const vector arm2_log3 = gap_11 - 6.28125 * round_12 - 0.001935307179586477 * round_12;
    const vector gap_12 = q11 - p11;
    const vector round_13 = round_each(0.15915494309189535 * gap_12);
    const vector arm2_log4 = gap_12 - 6.28125 * round_13 - 0.001935307179586477 * round_13;
    const vector gap_13 = q12 - p12;
    const vector round_14 = round_each(0.15915494309189535 * gap_13);
    const vector arm2_log5 = gap_13 - 6.28125 * round_14 - 0.001935307179586477 * round_14;
    const vector gap_14 = q13 - p13;
    const vector round_15 = round_each(0.15915494309189535 * gap_14);
    const vector arm2_log6 = gap_14 - 6.28125 * round_15 - 0.001935307179586477 * round_15;
    const vector total_2 = arm1_log0 * arm1_log0 + arm1_log1 * arm1_log1 + arm1_log2 * arm1_log2 + arm1_log3 *
        arm1_log3 + arm1_log4 * arm1_log4;
    const vector total_3 = total_2 + arm1_log5 * arm1_log5 + arm1_log6 * arm1_log6 + arm2_log0 * arm2_log0 +
        arm2_log1 * arm2_log1;
    const vector total_4 = total_3 + arm2_log2 * arm2_log2 + arm2_log3 * arm2_log3 + arm2_log4 * arm2_log4 +
        arm2_log5 * arm2_log5;
    distance[0] = sqrt_each(total_4 + arm2_log6 * arm2_log6);
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

/* Scratch memory: 29 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t dual_arm_splats_work(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES - 1) / LANES, blocks = (points + 2 - 1) / 2;
    const size_t places = 15 * ((splat_count + LANES - 1) / LANES + (blocks + LANES - 1) / LANES);
    return (points * 29 + places + 1) * LANES + 211 * splat_count;
}

static vector *work_points(double *work) {
    const uintptr_t size = sizeof(vector), start = (uintptr_t)work;
    return (vector *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const double *splat_at(const vector *splats, size_t k) {
    const size_t row = k / LANES;
    return (const double *)(splats + 15 * row) + (k - row * LANES);
}

static vector *work_reaches(double *work, size_t count) {
    return work_points(work) + (count + LANES - 1) / LANES * 29;
}

static vector *work_blocks(double *work, size_t count, size_t splat_count) {
    return work_reaches(work, count) + 15 * ((splat_count + LANES - 1) / LANES);
}

static double *work_constants(double *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES, blocks = (count + size - 1) / size;
    return (double *)(work_blocks(work, count, splat_count) + 15 * ((blocks + LANES - 1) / LANES));
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
    vector *own = splats + start / LANES * (14 + 1);
    vector_rows(width, splat_count, start, 1, own + 14);
    own[14] = own[14] * 9.014149034296874 + vector_spoilt(mu, 14) + vector_spoilt(amplitude, 1);
    for (int i = 0; i < 14; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place(const double *x, size_t count, size_t start, double *place) {
    const size_t size = count - start < 2 * LANES ? count - start : 2 * LANES;
    vector at[2][14], spoilt = ZERO;
    for (size_t b = 0; b < 2; ++b) {
        vector_rows(x, count, start + b * LANES, 14, at[b]);
        spoilt += vector_spoilt(at[b], 14);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const double *middle = x + 14 * (start + i * size / 8);
        double radius = 0, column[LANES];
        for (size_t b = 0; b < 2; ++b) {
            vector distance[1];
            pair_distances(middle, at[b], distance);
            vector_store(column, distance[0]);
            for (size_t lane = 0; lane < LANES; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[14]) {
            for (int j = 0; j < 14; ++j) place[j] = middle[j];
            place[14] = radius;
        }
    }
    place[14] = place[14] * 1.0078125 + vector_sum(spoilt);
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
        const vector *own = splats + start / LANES * (14 + 1);
        vector distance[1];
        pair_distances(place, own, distance);
        const vector_mask far = vector_far(distance[0], own[14], vector_of(place[14]));
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
        const vector *own = blocks + start / group * (14 + 1);
        vector distance[1];
        pair_distances(mu, own, distance);
        const vector_mask far = vector_far(distance[0], vector_of(*reach), own[14]);
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
    vector own_mu[14], own_W[196], own_amplitude[1], S[211];
    vector_rows(mu, splat_count, start, 14, own_mu);
    vector_rows(W, splat_count, start, 196, own_W);
    vector_rows(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants(own_mu, own_W, own_amplitude, S);
    vector_to_rows(S, constants, splat_count, start, 211, 211);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void dual_arm_splats(
    size_t count, size_t splat_count, const double *DUAL_ARM_RESTRICT x, const double *DUAL_ARM_RESTRICT mu, const double *DUAL_ARM_RESTRICT W, const double *DUAL_ARM_RESTRICT amplitude, const double *DUAL_ARM_RESTRICT width,
    double *DUAL_ARM_RESTRICT value, double *DUAL_ARM_RESTRICT gradient, double *DUAL_ARM_RESTRICT work, int threads) {
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
            vector at[2][14], X[2 * 14], grad[14];
            vector value_sum[2] = {ZERO}, slope_sum[2 * 14] = {ZERO};
            double place[14 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 14, at[b]);
                pair_features(at[b], X + 14 * b);
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
                pair_gradient(at[b], slope_sum + 14 * b, grad);
                vector_to_rows(value_sum + b, value, count, start + b * LANES, 1, 1);
                vector_to_rows(grad, gradient, count, start + b * LANES, 14, 14);
            }
        }
        restore_denormals(mode);
    }
}

void dual_arm_splats_value(
    size_t count, size_t splat_count, const double *DUAL_ARM_RESTRICT x, const double *DUAL_ARM_RESTRICT mu, const double *DUAL_ARM_RESTRICT W, const double *DUAL_ARM_RESTRICT amplitude, const double *DUAL_ARM_RESTRICT width,
    double *DUAL_ARM_RESTRICT value, double *DUAL_ARM_RESTRICT work, int threads) {
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
            vector at[14], X[2 * 14], value_sum[2] = {ZERO};
            double place[14 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows(x, count, start + b * LANES, 14, at);
                pair_features(at, X + 14 * b);
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
    vector at[14], grad_bar[14], slope_bar[14];
    vector_rows(x, count, start, 14, at);
    vector_rows(gradient_bar, count, start, 14, grad_bar);
    vector_rows(value_bar, count, start, 1, point + 14);
    pair_features(at, point);
    pair_gradient_vjp(at, grad_bar, slope_bar);
    for (int i = 0; i < 14; ++i) point[14 + 1 + i] = slope_bar[i];
    vector_end(count, start, 14 + 1, point + 14);
}

/* Adds what makes the derivatives, of a splat at some vectors of points: their factors, then the products of these. */
INLINE void pair_backward(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *sums) {
    vector factor[6 * 57];
    pair_factors(count, points, near, S, factor);
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_0(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[0] += sum[0];
        sums[1] += sum[1];
        sums[2] += sum[2];
        sums[3] += sum[3];
        sums[4] += sum[4];
        sums[5] += sum[5];
        sums[6] += sum[6];
        sums[7] += sum[7];
        sums[8] += sum[8];
        sums[9] += sum[9];
        sums[10] += sum[10];
        sums[11] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_1(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[12] += sum[0];
        sums[13] += sum[1];
        sums[210] += sum[2];
        sums[14] += sum[3];
        sums[15] += sum[4];
        sums[16] += sum[5];
        sums[17] += sum[6];
        sums[18] += sum[7];
        sums[19] += sum[8];
        sums[20] += sum[9];
        sums[21] += sum[10];
        sums[22] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_2(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[23] += sum[0];
        sums[24] += sum[1];
        sums[25] += sum[2];
        sums[26] += sum[3];
        sums[27] += sum[4];
        sums[37] += sum[5];
        sums[38] += sum[6];
        sums[39] += sum[7];
        sums[40] += sum[8];
        sums[41] += sum[9];
        sums[28] += sum[10];
        sums[29] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_3(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[30] += sum[0];
        sums[31] += sum[1];
        sums[32] += sum[2];
        sums[33] += sum[3];
        sums[34] += sum[4];
        sums[35] += sum[5];
        sums[36] += sum[6];
        sums[44] += sum[7];
        sums[45] += sum[8];
        sums[46] += sum[9];
        sums[47] += sum[10];
        sums[48] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_4(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[42] += sum[0];
        sums[43] += sum[1];
        sums[49] += sum[2];
        sums[50] += sum[3];
        sums[51] += sum[4];
        sums[52] += sum[5];
        sums[53] += sum[6];
        sums[54] += sum[7];
        sums[55] += sum[8];
        sums[56] += sum[9];
        sums[57] += sum[10];
        sums[63] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_5(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[58] += sum[0];
        sums[59] += sum[1];
        sums[60] += sum[2];
        sums[61] += sum[3];
        sums[62] += sum[4];
        sums[64] += sum[5];
        sums[65] += sum[6];
        sums[66] += sum[7];
        sums[67] += sum[8];
        sums[68] += sum[9];
        sums[69] += sum[10];
        sums[72] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_6(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[70] += sum[0];
        sums[71] += sum[1];
        sums[73] += sum[2];
        sums[74] += sum[3];
        sums[75] += sum[4];
        sums[76] += sum[5];
        sums[77] += sum[6];
        sums[78] += sum[7];
        sums[79] += sum[8];
        sums[80] += sum[9];
        sums[81] += sum[10];
        sums[82] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_7(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[83] += sum[0];
        sums[97] += sum[1];
        sums[84] += sum[2];
        sums[85] += sum[3];
        sums[86] += sum[4];
        sums[87] += sum[5];
        sums[88] += sum[6];
        sums[89] += sum[7];
        sums[90] += sum[8];
        sums[91] += sum[9];
        sums[92] += sum[10];
        sums[93] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_8(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[94] += sum[0];
        sums[95] += sum[1];
        sums[96] += sum[2];
        sums[108] += sum[3];
        sums[109] += sum[4];
        sums[110] += sum[5];
        sums[98] += sum[6];
        sums[99] += sum[7];
        sums[100] += sum[8];
        sums[101] += sum[9];
        sums[102] += sum[10];
        sums[103] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_9(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[104] += sum[0];
        sums[105] += sum[1];
        sums[106] += sum[2];
        sums[107] += sum[3];
        sums[111] += sum[4];
        sums[118] += sum[5];
        sums[119] += sum[6];
        sums[120] += sum[7];
        sums[121] += sum[8];
        sums[125] += sum[9];
        sums[112] += sum[10];
        sums[113] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_10(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[114] += sum[0];
        sums[115] += sum[1];
        sums[116] += sum[2];
        sums[117] += sum[3];
        sums[122] += sum[4];
        sums[123] += sum[5];
        sums[124] += sum[6];
        sums[128] += sum[7];
        sums[129] += sum[8];
        sums[130] += sum[9];
        sums[131] += sum[10];
        sums[136] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_11(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[126] += sum[0];
        sums[127] += sum[1];
        sums[132] += sum[2];
        sums[133] += sum[3];
        sums[134] += sum[4];
        sums[135] += sum[5];
        sums[137] += sum[6];
        sums[138] += sum[7];
        sums[139] += sum[8];
        sums[140] += sum[9];
        sums[141] += sum[10];
        sums[146] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_12(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[142] += sum[0];
        sums[143] += sum[1];
        sums[144] += sum[2];
        sums[145] += sum[3];
        sums[147] += sum[4];
        sums[148] += sum[5];
        sums[149] += sum[6];
        sums[150] += sum[7];
        sums[151] += sum[8];
        sums[152] += sum[9];
        sums[153] += sum[10];
        sums[156] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_13(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[154] += sum[0];
        sums[155] += sum[1];
        sums[157] += sum[2];
        sums[158] += sum[3];
        sums[159] += sum[4];
        sums[160] += sum[5];
        sums[161] += sum[6];
        sums[162] += sum[7];
        sums[163] += sum[8];
        sums[164] += sum[9];
        sums[165] += sum[10];
        sums[166] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_14(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[167] += sum[0];
        sums[181] += sum[1];
        sums[168] += sum[2];
        sums[169] += sum[3];
        sums[170] += sum[4];
        sums[171] += sum[5];
        sums[172] += sum[6];
        sums[173] += sum[7];
        sums[174] += sum[8];
        sums[175] += sum[9];
        sums[176] += sum[10];
        sums[177] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_15(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[178] += sum[0];
        sums[179] += sum[1];
        sums[180] += sum[2];
        sums[192] += sum[3];
        sums[193] += sum[4];
        sums[194] += sum[5];
        sums[182] += sum[6];
        sums[183] += sum[7];
        sums[184] += sum[8];
        sums[185] += sum[9];
        sums[186] += sum[10];
        sums[187] += sum[11];
    }
    {
        vector sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_16(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[188] += sum[0];
        sums[189] += sum[1];
        sums[190] += sum[2];
        sums[191] += sum[3];
        sums[195] += sum[4];
        sums[202] += sum[5];
        sums[203] += sum[6];
        sums[204] += sum[7];
        sums[205] += sum[8];
        sums[209] += sum[9];
        sums[196] += sum[10];
        sums[197] += sum[11];
    }
    {
        vector sum[7] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_17(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[198] += sum[0];
        sums[199] += sum[1];
        sums[200] += sum[2];
        sums[201] += sum[3];
        sums[206] += sum[4];
        sums[207] += sum[5];
        sums[208] += sum[6];
    }
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums(const vector *points, const uint32_t *near, size_t size, const double *S, double *sums) {
    vector sum[211] = {ZERO};
    for (size_t b = 0; b < size; b += 6)
        pair_backward(size - b < 6 ? size - b : 6, points, near + b, S, sum);
    for (size_t i = 0; i < 211; ++i) sums[i] += vector_sum(sum[i]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void dual_arm_splats_vjp(
    size_t count, size_t splat_count, const double *DUAL_ARM_RESTRICT x, const double *DUAL_ARM_RESTRICT mu, const double *DUAL_ARM_RESTRICT W, const double *DUAL_ARM_RESTRICT amplitude, const double *DUAL_ARM_RESTRICT width, const double *DUAL_ARM_RESTRICT value_bar, const double *DUAL_ARM_RESTRICT gradient_bar,
    double *DUAL_ARM_RESTRICT mu_bar, double *DUAL_ARM_RESTRICT W_bar, double *DUAL_ARM_RESTRICT amplitude_bar, double *DUAL_ARM_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES - 1) / LANES;
    const size_t chunk = 131072 / (29 * sizeof(vector)) + 1;
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
                double place[14 + 1];
                const size_t last = (blocks - 1) / 2, start = (block < last ? block : last) * 2;
                block_place(x, count, start * LANES, place);
                for (int i = 0; i < 15; ++i) {
                    double *row = (double *)(places + block / LANES * 15 + i);
                    row[block - block / LANES * LANES] = place[i];
                }
            }
        }
        OMP(omp for schedule(dynamic, 8))
        for (size_t block = 0; block < blocks; ++block)
            splat_points(count, block * LANES, x, value_bar, gradient_bar, points + 29 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            double sums[LANES][211] = {{0}};
            uint32_t near[131072 / (29 * sizeof(vector)) + 2];
            vector own_mu[14], own_W[196], own_amplitude[1], own_sums[211], bars[211];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const double *reach = width ? splat_at(splats, k) + 14 * LANES : NULL;
                    const size_t some = blocks_near(mu + 14 * k, reach, places, first, first + size, near);
                    splat_sums(points + 29 * first, near, some, constants + 211 * k, sums[k - start]);
                }
            }
            vector_rows(mu, end, start, 14, own_mu);
            vector_rows(W, end, start, 196, own_W);
            vector_rows(amplitude, end, start, 1, own_amplitude);
            vector_rows(sums[0], LANES, 0, 211, own_sums);
            pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 14, bars + 14 + 196);
            vector_to_rows(bars, mu_bar, end, start, 14, 14);
            vector_to_rows(bars + 14, W_bar, end, start, 196, 196);
            vector_to_rows(bars + 14 + 196, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void dual_arm_splats_rows(
    size_t count, size_t splat_count, const double *DUAL_ARM_RESTRICT x, const double *DUAL_ARM_RESTRICT mu, const double *DUAL_ARM_RESTRICT W, const double *DUAL_ARM_RESTRICT amplitude, const double *DUAL_ARM_RESTRICT value_bar, const double *DUAL_ARM_RESTRICT gradient_bar,
    double *DUAL_ARM_RESTRICT rows, double *DUAL_ARM_RESTRICT work, int threads) {
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
            vector point[29];
            splat_points(count, block * LANES, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector own_mu[14], own_W[196], own_amplitude[1], own_sums[211] = {ZERO}, bars[211];
                for (int i = 0; i < 14; ++i) own_mu[i] = vector_of(mu[14 * k + i]);
                for (int i = 0; i < 196; ++i) own_W[i] = vector_of(W[196 * k + i]);
                own_amplitude[0] = vector_of(amplitude[k]);
                pair_backward(1, point, &only, constants + 211 * k, own_sums);
                pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 14, bars + 14 + 196);
                vector_to_rows(bars, rows + 211 * k, count, block * LANES, 211, 211 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

/* A coordinate to sort by. */
INLINE double order_key(const double *x, size_t row, size_t axis) {
    const double key = x[14 * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest(const double *x, const size_t *order, size_t count) {
    double low[14], high[14];
    size_t widest = 0;
    for (size_t axis = 0; axis < 14; ++axis) low[axis] = high[axis] = order_key(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < 14; ++axis) {
            const double key = order_key(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < 14; ++axis)
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

double dual_arm_splats_order(
    size_t count, size_t splat_count, const double *DUAL_ARM_RESTRICT x, const double *DUAL_ARM_RESTRICT mu, const double *DUAL_ARM_RESTRICT amplitude, const double *DUAL_ARM_RESTRICT width,
    double limit, size_t *DUAL_ARM_RESTRICT order, double *DUAL_ARM_RESTRICT work) {
    const size_t block = 2 * LANES;
    vector *splats = work_reaches(work, 0);
    uint32_t near[256];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES) {
        vector own_mu[14], own_amplitude[1];
        vector_rows(mu, splat_count, start, 14, own_mu);
        vector_rows(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks(x, order, count, (double *)work_blocks(work, 0, splat_count));
        for (size_t i = 1; i < 2 * 16; i += 2) {
            double rows[2 * LANES * 14], place[14 + 1];
            const size_t some = i * count / (2 * 16), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < 14; ++j) rows[14 * n + j] = x[14 * order[start + n] + j];
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
    const vector_f x9 = x[9];
    const vector_f x10 = x[10];
    const vector_f x11 = x[11];
    const vector_f x12 = x[12];
    const vector_f x13 = x[13];
    X[0] = x0;
    X[1] = x1;
    X[2] = x2;
    X[3] = x3;
    X[4] = x4;
    X[5] = x5;
    X[6] = x6;
    X[7] = x7;
    X[8] = x8;
    X[9] = x9;
    X[10] = x10;
    X[11] = x11;
    X[12] = x12;
    X[13] = x13;
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
    const vector_f mu9 = mu[9];
    const vector_f mu10 = mu[10];
    const vector_f mu11 = mu[11];
    const vector_f mu12 = mu[12];
    const vector_f mu13 = mu[13];
    const vector_f W0_0 = W[0];
    const vector_f W0_1 = W[1];
    const vector_f W0_2 = W[2];
    const vector_f W0_3 = W[3];
    const vector_f W0_4 = W[4];
    const vector_f W0_5 = W[5];
    const vector_f W0_6 = W[6];
    const vector_f W0_7 = W[7];
    const vector_f W0_8 = W[8];
    const vector_f W0_9 = W[9];
    const vector_f W0_10 = W[10];
    const vector_f W0_11 = W[11];
    const vector_f W0_12 = W[12];
    const vector_f W0_13 = W[13];
    const vector_f W1_0 = W[14];
    const vector_f W1_1 = W[15];
    const vector_f W1_2 = W[16];
    const vector_f W1_3 = W[17];
    const vector_f W1_4 = W[18];
    const vector_f W1_5 = W[19];
    const vector_f W1_6 = W[20];
    const vector_f W1_7 = W[21];
    const vector_f W1_8 = W[22];
    const vector_f W1_9 = W[23];
    const vector_f W1_10 = W[24];
    const vector_f W1_11 = W[25];
    const vector_f W1_12 = W[26];
    const vector_f W1_13 = W[27];
    const vector_f W2_0 = W[28];
    const vector_f W2_1 = W[29];
    const vector_f W2_2 = W[30];
    const vector_f W2_3 = W[31];
    const vector_f W2_4 = W[32];
    const vector_f W2_5 = W[33];
    const vector_f W2_6 = W[34];
    const vector_f W2_7 = W[35];
    const vector_f W2_8 = W[36];
    const vector_f W2_9 = W[37];
    const vector_f W2_10 = W[38];
    const vector_f W2_11 = W[39];
    const vector_f W2_12 = W[40];
    const vector_f W2_13 = W[41];
    const vector_f W3_0 = W[42];
    const vector_f W3_1 = W[43];
    const vector_f W3_2 = W[44];
    const vector_f W3_3 = W[45];
    const vector_f W3_4 = W[46];
    const vector_f W3_5 = W[47];
    const vector_f W3_6 = W[48];
    const vector_f W3_7 = W[49];
    const vector_f W3_8 = W[50];
    const vector_f W3_9 = W[51];
    const vector_f W3_10 = W[52];
    const vector_f W3_11 = W[53];
    const vector_f W3_12 = W[54];
    const vector_f W3_13 = W[55];
    const vector_f W4_0 = W[56];
    const vector_f W4_1 = W[57];
    const vector_f W4_2 = W[58];
    const vector_f W4_3 = W[59];
    const vector_f W4_4 = W[60];
    const vector_f W4_5 = W[61];
    const vector_f W4_6 = W[62];
    const vector_f W4_7 = W[63];
    const vector_f W4_8 = W[64];
    const vector_f W4_9 = W[65];
    const vector_f W4_10 = W[66];
    const vector_f W4_11 = W[67];
    const vector_f W4_12 = W[68];
    const vector_f W4_13 = W[69];
    const vector_f W5_0 = W[70];
    const vector_f W5_1 = W[71];
    const vector_f W5_2 = W[72];
    const vector_f W5_3 = W[73];
    const vector_f W5_4 = W[74];
    const vector_f W5_5 = W[75];
    const vector_f W5_6 = W[76];
    const vector_f W5_7 = W[77];
    const vector_f W5_8 = W[78];
    const vector_f W5_9 = W[79];
    const vector_f W5_10 = W[80];
    const vector_f W5_11 = W[81];
    const vector_f W5_12 = W[82];
    const vector_f W5_13 = W[83];
    const vector_f W6_0 = W[84];
    const vector_f W6_1 = W[85];
    const vector_f W6_2 = W[86];
    const vector_f W6_3 = W[87];
    const vector_f W6_4 = W[88];
    const vector_f W6_5 = W[89];
    const vector_f W6_6 = W[90];
    const vector_f W6_7 = W[91];
    const vector_f W6_8 = W[92];
    const vector_f W6_9 = W[93];
    const vector_f W6_10 = W[94];
    const vector_f W6_11 = W[95];
    const vector_f W6_12 = W[96];
    const vector_f W6_13 = W[97];
    const vector_f W7_0 = W[98];
    const vector_f W7_1 = W[99];
    const vector_f W7_2 = W[100];
    const vector_f W7_3 = W[101];
    const vector_f W7_4 = W[102];
    const vector_f W7_5 = W[103];
    const vector_f W7_6 = W[104];
    const vector_f W7_7 = W[105];
    const vector_f W7_8 = W[106];
    const vector_f W7_9 = W[107];
    const vector_f W7_10 = W[108];
    const vector_f W7_11 = W[109];
    const vector_f W7_12 = W[110];
    const vector_f W7_13 = W[111];
    const vector_f W8_0 = W[112];
    const vector_f W8_1 = W[113];
    const vector_f W8_2 = W[114];
    const vector_f W8_3 = W[115];
    const vector_f W8_4 = W[116];
    const vector_f W8_5 = W[117];
    const vector_f W8_6 = W[118];
    const vector_f W8_7 = W[119];
    const vector_f W8_8 = W[120];
    const vector_f W8_9 = W[121];
    const vector_f W8_10 = W[122];
    const vector_f W8_11 = W[123];
    const vector_f W8_12 = W[124];
    const vector_f W8_13 = W[125];
    const vector_f W9_0 = W[126];
    const vector_f W9_1 = W[127];
    const vector_f W9_2 = W[128];
    const vector_f W9_3 = W[129];
    const vector_f W9_4 = W[130];
    const vector_f W9_5 = W[131];
    const vector_f W9_6 = W[132];
    const vector_f W9_7 = W[133];
    const vector_f W9_8 = W[134];
    const vector_f W9_9 = W[135];
    const vector_f W9_10 = W[136];
    const vector_f W9_11 = W[137];
    const vector_f W9_12 = W[138];
    const vector_f W9_13 = W[139];
    const vector_f W10_0 = W[140];
    const vector_f W10_1 = W[141];
    const vector_f W10_2 = W[142];
    const vector_f W10_3 = W[143];
    const vector_f W10_4 = W[144];
    const vector_f W10_5 = W[145];
    const vector_f W10_6 = W[146];
    const vector_f W10_7 = W[147];
    const vector_f W10_8 = W[148];
    const vector_f W10_9 = W[149];
    const vector_f W10_10 = W[150];
    const vector_f W10_11 = W[151];
    const vector_f W10_12 = W[152];
    const vector_f W10_13 = W[153];
    const vector_f W11_0 = W[154];
    const vector_f W11_1 = W[155];
    const vector_f W11_2 = W[156];
    const vector_f W11_3 = W[157];
    const vector_f W11_4 = W[158];
    const vector_f W11_5 = W[159];
    const vector_f W11_6 = W[160];
    const vector_f W11_7 = W[161];
    const vector_f W11_8 = W[162];
    const vector_f W11_9 = W[163];
    const vector_f W11_10 = W[164];
    const vector_f W11_11 = W[165];
    const vector_f W11_12 = W[166];
    const vector_f W11_13 = W[167];
    const vector_f W12_0 = W[168];
    const vector_f W12_1 = W[169];
    const vector_f W12_2 = W[170];
    const vector_f W12_3 = W[171];
    const vector_f W12_4 = W[172];
    const vector_f W12_5 = W[173];
    const vector_f W12_6 = W[174];
    const vector_f W12_7 = W[175];
    const vector_f W12_8 = W[176];
    const vector_f W12_9 = W[177];
    const vector_f W12_10 = W[178];
    const vector_f W12_11 = W[179];
    const vector_f W12_12 = W[180];
    const vector_f W12_13 = W[181];
    const vector_f W13_0 = W[182];
    const vector_f W13_1 = W[183];
    const vector_f W13_2 = W[184];
    const vector_f W13_3 = W[185];
    const vector_f W13_4 = W[186];
    const vector_f W13_5 = W[187];
    const vector_f W13_6 = W[188];
    const vector_f W13_7 = W[189];
    const vector_f W13_8 = W[190];
    const vector_f W13_9 = W[191];
    const vector_f W13_10 = W[192];
    const vector_f W13_11 = W[193];
    const vector_f W13_12 = W[194];
    const vector_f W13_13 = W[195];
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
    S[9] = mu9;
    S[10] = mu10;
    S[11] = mu11;
    S[12] = mu12;
    S[13] = mu13;
    S[14] = W0_0;
    S[15] = W0_1;
    S[16] = W0_2;
    S[17] = W0_3;
    S[18] = W0_4;
    S[19] = W0_5;
    S[20] = W0_6;
    S[21] = W0_7;
    S[22] = W0_8;
    S[23] = W0_9;
    S[24] = W0_10;
    S[25] = W0_11;
    S[26] = W0_12;
    S[27] = W0_13;
    S[28] = W1_0;
    S[29] = W1_1;
    S[30] = W1_2;
    S[31] = W1_3;
    S[32] = W1_4;
    S[33] = W1_5;
    S[34] = W1_6;
    S[35] = W1_7;
    S[36] = W1_8;
    S[37] = W1_9;
    S[38] = W1_10;
    S[39] = W1_11;
    S[40] = W1_12;
    S[41] = W1_13;
    S[42] = W2_0;
    S[43] = W2_1;
    S[44] = W2_2;
    S[45] = W2_3;
    S[46] = W2_4;
    S[47] = W2_5;
    S[48] = W2_6;
    S[49] = W2_7;
    S[50] = W2_8;
    S[51] = W2_9;
    S[52] = W2_10;
    S[53] = W2_11;
    S[54] = W2_12;
    S[55] = W2_13;
    S[56] = W3_0;
    S[57] = W3_1;
    S[58] = W3_2;
    S[59] = W3_3;
    S[60] = W3_4;
    S[61] = W3_5;
    S[62] = W3_6;
    S[63] = W3_7;
    S[64] = W3_8;
    S[65] = W3_9;
    S[66] = W3_10;
    S[67] = W3_11;
    S[68] = W3_12;
    S[69] = W3_13;
    S[70] = W4_0;
    S[71] = W4_1;
    S[72] = W4_2;
    S[73] = W4_3;
    S[74] = W4_4;
    S[75] = W4_5;
    S[76] = W4_6;
    S[77] = W4_7;
    S[78] = W4_8;
    S[79] = W4_9;
    S[80] = W4_10;
    S[81] = W4_11;
    S[82] = W4_12;
    S[83] = W4_13;
    S[84] = W5_0;
    S[85] = W5_1;
    S[86] = W5_2;
    S[87] = W5_3;
    S[88] = W5_4;
    S[89] = W5_5;
    S[90] = W5_6;
    S[91] = W5_7;
    S[92] = W5_8;
    S[93] = W5_9;
    S[94] = W5_10;
    S[95] = W5_11;
    S[96] = W5_12;
    S[97] = W5_13;
    S[98] = W6_0;
    S[99] = W6_1;
    S[100] = W6_2;
    S[101] = W6_3;
    S[102] = W6_4;
    S[103] = W6_5;
    S[104] = W6_6;
    S[105] = W6_7;
    S[106] = W6_8;
    S[107] = W6_9;
    S[108] = W6_10;
    S[109] = W6_11;
    S[110] = W6_12;
    S[111] = W6_13;
    S[112] = W7_0;
    S[113] = W7_1;
    S[114] = W7_2;
    S[115] = W7_3;
    S[116] = W7_4;
    S[117] = W7_5;
    S[118] = W7_6;
    S[119] = W7_7;
    S[120] = W7_8;
    S[121] = W7_9;
    S[122] = W7_10;
    S[123] = W7_11;
    S[124] = W7_12;
    S[125] = W7_13;
    S[126] = W8_0;
    S[127] = W8_1;
    S[128] = W8_2;
    S[129] = W8_3;
    S[130] = W8_4;
    S[131] = W8_5;
    S[132] = W8_6;
    S[133] = W8_7;
    S[134] = W8_8;
    S[135] = W8_9;
    S[136] = W8_10;
    S[137] = W8_11;
    S[138] = W8_12;
    S[139] = W8_13;
    S[140] = W9_0;
    S[141] = W9_1;
    S[142] = W9_2;
    S[143] = W9_3;
    S[144] = W9_4;
    S[145] = W9_5;
    S[146] = W9_6;
    S[147] = W9_7;
    S[148] = W9_8;
    S[149] = W9_9;
    S[150] = W9_10;
    S[151] = W9_11;
    S[152] = W9_12;
    S[153] = W9_13;
    S[154] = W10_0;
    S[155] = W10_1;
    S[156] = W10_2;
    S[157] = W10_3;
    S[158] = W10_4;
    S[159] = W10_5;
    S[160] = W10_6;
    S[161] = W10_7;
    S[162] = W10_8;
    S[163] = W10_9;
    S[164] = W10_10;
    S[165] = W10_11;
    S[166] = W10_12;
    S[167] = W10_13;
    S[168] = W11_0;
    S[169] = W11_1;
    S[170] = W11_2;
    S[171] = W11_3;
    S[172] = W11_4;
    S[173] = W11_5;
    S[174] = W11_6;
    S[175] = W11_7;
    S[176] = W11_8;
    S[177] = W11_9;
    S[178] = W11_10;
    S[179] = W11_11;
    S[180] = W11_12;
    S[181] = W11_13;
    S[182] = W12_0;
    S[183] = W12_1;
    S[184] = W12_2;
    S[185] = W12_3;
    S[186] = W12_4;
    S[187] = W12_5;
    S[188] = W12_6;
    S[189] = W12_7;
    S[190] = W12_8;
    S[191] = W12_9;
    S[192] = W12_10;
    S[193] = W12_11;
    S[194] = W12_12;
    S[195] = W12_13;
    S[196] = W13_0;
    S[197] = W13_1;
    S[198] = W13_2;
    S[199] = W13_3;
    S[200] = W13_4;
    S[201] = W13_5;
    S[202] = W13_6;
    S[203] = W13_7;
    S[204] = W13_8;
    S[205] = W13_9;
    S[206] = W13_10;
    S[207] = W13_11;
    S[208] = W13_12;
    S[209] = W13_13;
    S[210] = its_amplitude;
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
        const float *S = splats + 211 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float mu7 = S[7];
        const float mu8 = S[8];
        const float mu9 = S[9];
        const float mu10 = S[10];
        const float mu11 = S[11];
        const float mu12 = S[12];
        const float mu13 = S[13];
        const float W0_0 = S[14];
        const float W0_1 = S[15];
        const float W0_2 = S[16];
        const float W0_3 = S[17];
        const float W0_4 = S[18];
        const float W0_5 = S[19];
        const float W0_6 = S[20];
        const float W0_7 = S[21];
        const float W0_8 = S[22];
        const float W0_9 = S[23];
        const float W0_10 = S[24];
        const float W0_11 = S[25];
        const float W0_12 = S[26];
        const float W0_13 = S[27];
        const float W1_0 = S[28];
        const float W1_1 = S[29];
        const float W1_2 = S[30];
        const float W1_3 = S[31];
        const float W1_4 = S[32];
        const float W1_5 = S[33];
        const float W1_6 = S[34];
        const float W1_7 = S[35];
        const float W1_8 = S[36];
        const float W1_9 = S[37];
        const float W1_10 = S[38];
        const float W1_11 = S[39];
        const float W1_12 = S[40];
        const float W1_13 = S[41];
        const float W2_0 = S[42];
        const float W2_1 = S[43];
        const float W2_2 = S[44];
        const float W2_3 = S[45];
        const float W2_4 = S[46];
        const float W2_5 = S[47];
        const float W2_6 = S[48];
        const float W2_7 = S[49];
        const float W2_8 = S[50];
        const float W2_9 = S[51];
        const float W2_10 = S[52];
        const float W2_11 = S[53];
        const float W2_12 = S[54];
        const float W2_13 = S[55];
        const float W3_0 = S[56];
        const float W3_1 = S[57];
        const float W3_2 = S[58];
        const float W3_3 = S[59];
        const float W3_4 = S[60];
        const float W3_5 = S[61];
        const float W3_6 = S[62];
        const float W3_7 = S[63];
        const float W3_8 = S[64];
        const float W3_9 = S[65];
        const float W3_10 = S[66];
        const float W3_11 = S[67];
        const float W3_12 = S[68];
        const float W3_13 = S[69];
        const float W4_0 = S[70];
        const float W4_1 = S[71];
        const float W4_2 = S[72];
        const float W4_3 = S[73];
        const float W4_4 = S[74];
        const float W4_5 = S[75];
        const float W4_6 = S[76];
        const float W4_7 = S[77];
        const float W4_8 = S[78];
        const float W4_9 = S[79];
        const float W4_10 = S[80];
        const float W4_11 = S[81];
        const float W4_12 = S[82];
        const float W4_13 = S[83];
        const float W5_0 = S[84];
        const float W5_1 = S[85];
        const float W5_2 = S[86];
        const float W5_3 = S[87];
        const float W5_4 = S[88];
        const float W5_5 = S[89];
        const float W5_6 = S[90];
        const float W5_7 = S[91];
        const float W5_8 = S[92];
        const float W5_9 = S[93];
        const float W5_10 = S[94];
        const float W5_11 = S[95];
        const float W5_12 = S[96];
        const float W5_13 = S[97];
        const float W6_0 = S[98];
        const float W6_1 = S[99];
        const float W6_2 = S[100];
        const float W6_3 = S[101];
        const float W6_4 = S[102];
        const float W6_5 = S[103];
        const float W6_6 = S[104];
        const float W6_7 = S[105];
        const float W6_8 = S[106];
        const float W6_9 = S[107];
        const float W6_10 = S[108];
        const float W6_11 = S[109];
        const float W6_12 = S[110];
        const float W6_13 = S[111];
        const float W7_0 = S[112];
        const float W7_1 = S[113];
        const float W7_2 = S[114];
        const float W7_3 = S[115];
        const float W7_4 = S[116];
        const float W7_5 = S[117];
        const float W7_6 = S[118];
        const float W7_7 = S[119];
        const float W7_8 = S[120];
        const float W7_9 = S[121];
        const float W7_10 = S[122];
        const float W7_11 = S[123];
        const float W7_12 = S[124];
        const float W7_13 = S[125];
        const float W8_0 = S[126];
        const float W8_1 = S[127];
        const float W8_2 = S[128];
        const float W8_3 = S[129];
        const float W8_4 = S[130];
        const float W8_5 = S[131];
        const float W8_6 = S[132];
        const float W8_7 = S[133];
        const float W8_8 = S[134];
        const float W8_9 = S[135];
        const float W8_10 = S[136];
        const float W8_11 = S[137];
        const float W8_12 = S[138];
        const float W8_13 = S[139];
        const float W9_0 = S[140];
        const float W9_1 = S[141];
        const float W9_2 = S[142];
        const float W9_3 = S[143];
        const float W9_4 = S[144];
        const float W9_5 = S[145];
        const float W9_6 = S[146];
        const float W9_7 = S[147];
        const float W9_8 = S[148];
        const float W9_9 = S[149];
        const float W9_10 = S[150];
        const float W9_11 = S[151];
        const float W9_12 = S[152];
        const float W9_13 = S[153];
        const float W10_0 = S[154];
        const float W10_1 = S[155];
        const float W10_2 = S[156];
        const float W10_3 = S[157];
        const float W10_4 = S[158];
        const float W10_5 = S[159];
        const float W10_6 = S[160];
        const float W10_7 = S[161];
        const float W10_8 = S[162];
        const float W10_9 = S[163];
        const float W10_10 = S[164];
        const float W10_11 = S[165];
        const float W10_12 = S[166];
        const float W10_13 = S[167];
        const float W11_0 = S[168];
        const float W11_1 = S[169];
        const float W11_2 = S[170];
        const float W11_3 = S[171];
        const float W11_4 = S[172];
        const float W11_5 = S[173];
        const float W11_6 = S[174];
        const float W11_7 = S[175];
        const float W11_8 = S[176];
        const float W11_9 = S[177];
        const float W11_10 = S[178];
        const float W11_11 = S[179];
        const float W11_12 = S[180];
        const float W11_13 = S[181];
        const float W12_0 = S[182];
        const float W12_1 = S[183];
        const float W12_2 = S[184];
        const float W12_3 = S[185];
        const float W12_4 = S[186];
        const float W12_5 = S[187];
        const float W12_6 = S[188];
        const float W12_7 = S[189];
        const float W12_8 = S[190];
        const float W12_9 = S[191];
        const float W12_10 = S[192];
        const float W12_11 = S[193];
        const float W12_12 = S[194];
        const float W12_13 = S[195];
        const float W13_0 = S[196];
        const float W13_1 = S[197];
        const float W13_2 = S[198];
        const float W13_3 = S[199];
        const float W13_4 = S[200];
        const float W13_5 = S[201];
        const float W13_6 = S[202];
        const float W13_7 = S[203];
        const float W13_8 = S[204];
        const float W13_9 = S[205];
        const float W13_10 = S[206];
        const float W13_11 = S[207];
        const float W13_12 = S[208];
        const float W13_13 = S[209];
        for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 14 * b;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f x4 = X[4];
            const vector_f x5 = X[5];
            const vector_f x6 = X[6];
            const vector_f x7 = X[7];
            const vector_f x8 = X[8];
            const vector_f x9 = X[9];
            const vector_f x10 = X[10];
            const vector_f x11 = X[11];
            const vector_f x12 = X[12];
            const vector_f x13 = X[13];
            const vector_f gap = x0 - mu0;
            const vector_f round_2 = round_each_f(0.15915494309189535f * gap);
            const vector_f v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
            const vector_f gap_2 = x1 - mu1;
            const vector_f round_3 = round_each_f(0.15915494309189535f * gap_2);
            const vector_f v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
            const vector_f gap_3 = x2 - mu2;
            const vector_f round_4 = round_each_f(0.15915494309189535f * gap_3);
            const vector_f v2 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
            const vector_f gap_4 = x3 - mu3;
            const vector_f round_5 = round_each_f(0.15915494309189535f * gap_4);
            const vector_f v3 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
            const vector_f gap_5 = x4 - mu4;
            const vector_f round_6 = round_each_f(0.15915494309189535f * gap_5);
            const vector_f v4 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
            const vector_f total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
            const vector_f gap_6 = x5 - mu5;
            const vector_f round_7 = round_each_f(0.15915494309189535f * gap_6);
            const vector_f v5 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
            const vector_f gap_7 = x6 - mu6;
            const vector_f round_8 = round_each_f(0.15915494309189535f * gap_7);
            const vector_f v6 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
            const vector_f gap_8 = x7 - mu7;
            const vector_f round_9 = round_each_f(0.15915494309189535f * gap_8);
            const vector_f v7 = gap_8 - 6.28125f * round_9 - 0.001935307179586477f * round_9;
            const vector_f gap_9 = x8 - mu8;
            const vector_f round_10 = round_each_f(0.15915494309189535f * gap_9);
            const vector_f v8 = gap_9 - 6.28125f * round_10 - 0.001935307179586477f * round_10;
            const vector_f total_3 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
            const vector_f gap_10 = x9 - mu9;
            const vector_f round_11 = round_each_f(0.15915494309189535f * gap_10);
            const vector_f v9 = gap_10 - 6.28125f * round_11 - 0.001935307179586477f * round_11;
            const vector_f gap_11 = x10 - mu10;
            const vector_f round_12 = round_each_f(0.15915494309189535f * gap_11);
            const vector_f v10 = gap_11 - 6.28125f * round_12 - 0.001935307179586477f * round_12;
            const vector_f gap_12 = x11 - mu11;
            const vector_f round_13 = round_each_f(0.15915494309189535f * gap_12);
            const vector_f v11 = gap_12 - 6.28125f * round_13 - 0.001935307179586477f * round_13;
            const vector_f gap_13 = x12 - mu12;
            const vector_f round_14 = round_each_f(0.15915494309189535f * gap_13);
            const vector_f v12 = gap_13 - 6.28125f * round_14 - 0.001935307179586477f * round_14;
            const vector_f total_4 = total_3 + W0_9 * v9 + W0_10 * v10 + W0_11 * v11 + W0_12 * v12;
            const vector_f gap_14 = x13 - mu13;
            const vector_f round_15 = round_each_f(0.15915494309189535f * gap_14);
            const vector_f v13 = gap_14 - 6.28125f * round_15 - 0.001935307179586477f * round_15;
            const vector_f z0 = total_4 + W0_13 * v13;
            const vector_f total_5 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
            const vector_f total_6 = total_5 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
            const vector_f total_7 = total_6 + W1_9 * v9 + W1_10 * v10 + W1_11 * v11 + W1_12 * v12;
            const vector_f z1 = total_7 + W1_13 * v13;
            const vector_f total_8 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
            const vector_f total_9 = total_8 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
            const vector_f total_10 = total_9 + W2_9 * v9 + W2_10 * v10 + W2_11 * v11 + W2_12 * v12;
            const vector_f z2 = total_10 + W2_13 * v13;
            const vector_f total_11 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
            const vector_f total_12 = total_11 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
            const vector_f total_13 = total_12 + W3_9 * v9 + W3_10 * v10 + W3_11 * v11 + W3_12 * v12;
            const vector_f z3 = total_13 + W3_13 * v13;
            const vector_f total_14 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
            const vector_f total_15 = total_14 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
            const vector_f total_16 = total_15 + W4_9 * v9 + W4_10 * v10 + W4_11 * v11 + W4_12 * v12;
            const vector_f z4 = total_16 + W4_13 * v13;
            const vector_f total_17 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
            const vector_f total_18 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
            const vector_f total_19 = total_18 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
            const vector_f total_20 = total_19 + W5_9 * v9 + W5_10 * v10 + W5_11 * v11 + W5_12 * v12;
            const vector_f z5 = total_20 + W5_13 * v13;
            const vector_f total_21 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
            const vector_f total_22 = total_21 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
            const vector_f total_23 = total_22 + W6_9 * v9 + W6_10 * v10 + W6_11 * v11 + W6_12 * v12;
            const vector_f z6 = total_23 + W6_13 * v13;
            const vector_f total_24 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
            const vector_f total_25 = total_24 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
            const vector_f total_26 = total_25 + W7_9 * v9 + W7_10 * v10 + W7_11 * v11 + W7_12 * v12;
            const vector_f z7 = total_26 + W7_13 * v13;
            const vector_f total_27 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
            const vector_f total_28 = total_27 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
            const vector_f total_29 = total_28 + W8_9 * v9 + W8_10 * v10 + W8_11 * v11 + W8_12 * v12;
            const vector_f z8 = total_29 + W8_13 * v13;
            const vector_f total_30 = total_17 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
            const vector_f total_31 = W9_0 * v0 + W9_1 * v1 + W9_2 * v2 + W9_3 * v3 + W9_4 * v4;
            const vector_f total_32 = total_31 + W9_5 * v5 + W9_6 * v6 + W9_7 * v7 + W9_8 * v8;
            const vector_f total_33 = total_32 + W9_9 * v9 + W9_10 * v10 + W9_11 * v11 + W9_12 * v12;
            const vector_f z9 = total_33 + W9_13 * v13;
            const vector_f total_34 = W10_0 * v0 + W10_1 * v1 + W10_2 * v2 + W10_3 * v3 + W10_4 * v4;
            const vector_f total_35 = total_34 + W10_5 * v5 + W10_6 * v6 + W10_7 * v7 + W10_8 * v8;
            const vector_f total_36 = total_35 + W10_9 * v9 + W10_10 * v10 + W10_11 * v11 + W10_12 * v12;
            const vector_f z10 = total_36 + W10_13 * v13;
            const vector_f total_37 = W11_0 * v0 + W11_1 * v1 + W11_2 * v2 + W11_3 * v3 + W11_4 * v4;
            const vector_f total_38 = total_37 + W11_5 * v5 + W11_6 * v6 + W11_7 * v7 + W11_8 * v8;
            const vector_f total_39 = total_38 + W11_9 * v9 + W11_10 * v10 + W11_11 * v11 + W11_12 * v12;
            const vector_f z11 = total_39 + W11_13 * v13;
            const vector_f total_40 = W12_0 * v0 + W12_1 * v1 + W12_2 * v2 + W12_3 * v3 + W12_4 * v4;
            const vector_f total_41 = total_40 + W12_5 * v5 + W12_6 * v6 + W12_7 * v7 + W12_8 * v8;
            const vector_f total_42 = total_41 + W12_9 * v9 + W12_10 * v10 + W12_11 * v11 + W12_12 * v12;
            const vector_f z12 = total_42 + W12_13 * v13;
            const vector_f total_43 = total_30 + z9 * z9 + z10 * z10 + z11 * z11 + z12 * z12;
            const vector_f total_44 = W13_0 * v0 + W13_1 * v1 + W13_2 * v2 + W13_3 * v3 + W13_4 * v4;
            const vector_f total_45 = total_44 + W13_5 * v5 + W13_6 * v6 + W13_7 * v7 + W13_8 * v8;
            const vector_f total_46 = total_45 + W13_9 * v9 + W13_10 * v10 + W13_11 * v11 + W13_12 * v12;
            const vector_f z13 = total_46 + W13_13 * v13;
            const vector_f phi = gaussian_each_f(total_43 + z13 * z13);
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 211 * near[k];
        const float amplitude = S[210];
        for (size_t b = 0; b < 2; ++b) {
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
OUTLINE void pair_forward_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values, vector_f *slopes) {
    struct { vector_f z0, z1, z2, z3, z4, z5, z6, z7, z8, z9, z10, z11, z12, z13, phi; }
            kept[8][2];
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 211 * near[k];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float mu7 = S[7];
        const float mu8 = S[8];
        const float mu9 = S[9];
        const float mu10 = S[10];
        const float mu11 = S[11];
        const float mu12 = S[12];
        const float mu13 = S[13];
        const float W0_0 = S[14];
        const float W0_1 = S[15];
        const float W0_2 = S[16];
        const float W0_3 = S[17];
        const float W0_4 = S[18];
        const float W0_5 = S[19];
        const float W0_6 = S[20];
        const float W0_7 = S[21];
        const float W0_8 = S[22];
        const float W0_9 = S[23];
        const float W0_10 = S[24];
        const float W0_11 = S[25];
        const float W0_12 = S[26];
        const float W0_13 = S[27];
        const float W1_0 = S[28];
        const float W1_1 = S[29];
        const float W1_2 = S[30];
        const float W1_3 = S[31];
        const float W1_4 = S[32];
        const float W1_5 = S[33];
        const float W1_6 = S[34];
        const float W1_7 = S[35];
        const float W1_8 = S[36];
        const float W1_9 = S[37];
        const float W1_10 = S[38];
        const float W1_11 = S[39];
        const float W1_12 = S[40];
        const float W1_13 = S[41];
        const float W2_0 = S[42];
        const float W2_1 = S[43];
        const float W2_2 = S[44];
        const float W2_3 = S[45];
        const float W2_4 = S[46];
        const float W2_5 = S[47];
        const float W2_6 = S[48];
        const float W2_7 = S[49];
        const float W2_8 = S[50];
        const float W2_9 = S[51];
        const float W2_10 = S[52];
        const float W2_11 = S[53];
        const float W2_12 = S[54];
        const float W2_13 = S[55];
        const float W3_0 = S[56];
        const float W3_1 = S[57];
        const float W3_2 = S[58];
        const float W3_3 = S[59];
        const float W3_4 = S[60];
        const float W3_5 = S[61];
        const float W3_6 = S[62];
        const float W3_7 = S[63];
        const float W3_8 = S[64];
        const float W3_9 = S[65];
        const float W3_10 = S[66];
        const float W3_11 = S[67];
        const float W3_12 = S[68];
        const float W3_13 = S[69];
        const float W4_0 = S[70];
        const float W4_1 = S[71];
        const float W4_2 = S[72];
        const float W4_3 = S[73];
        const float W4_4 = S[74];
        const float W4_5 = S[75];
        const float W4_6 = S[76];
        const float W4_7 = S[77];
        const float W4_8 = S[78];
        const float W4_9 = S[79];
        const float W4_10 = S[80];
        const float W4_11 = S[81];
        const float W4_12 = S[82];
        const float W4_13 = S[83];
        const float W5_0 = S[84];
        const float W5_1 = S[85];
        const float W5_2 = S[86];
        const float W5_3 = S[87];
        const float W5_4 = S[88];
        const float W5_5 = S[89];
        const float W5_6 = S[90];
        const float W5_7 = S[91];
        const float W5_8 = S[92];
        const float W5_9 = S[93];
        const float W5_10 = S[94];
        const float W5_11 = S[95];
        const float W5_12 = S[96];
        const float W5_13 = S[97];
        const float W6_0 = S[98];
        const float W6_1 = S[99];
        const float W6_2 = S[100];
        const float W6_3 = S[101];
        const float W6_4 = S[102];
        const float W6_5 = S[103];
        const float W6_6 = S[104];
        const float W6_7 = S[105];
        const float W6_8 = S[106];
        const float W6_9 = S[107];
        const float W6_10 = S[108];
        const float W6_11 = S[109];
        const float W6_12 = S[110];
        const float W6_13 = S[111];
        const float W7_0 = S[112];
        const float W7_1 = S[113];
        const float W7_2 = S[114];
        const float W7_3 = S[115];
        const float W7_4 = S[116];
        const float W7_5 = S[117];
        const float W7_6 = S[118];
        const float W7_7 = S[119];
        const float W7_8 = S[120];
        const float W7_9 = S[121];
        const float W7_10 = S[122];
        const float W7_11 = S[123];
        const float W7_12 = S[124];
        const float W7_13 = S[125];
        const float W8_0 = S[126];
        const float W8_1 = S[127];
        const float W8_2 = S[128];
        const float W8_3 = S[129];
        const float W8_4 = S[130];
        const float W8_5 = S[131];
        const float W8_6 = S[132];
        const float W8_7 = S[133];
        const float W8_8 = S[134];
        const float W8_9 = S[135];
        const float W8_10 = S[136];
        const float W8_11 = S[137];
        const float W8_12 = S[138];
        const float W8_13 = S[139];
        const float W9_0 = S[140];
        const float W9_1 = S[141];
        const float W9_2 = S[142];
        const float W9_3 = S[143];
        const float W9_4 = S[144];
        const float W9_5 = S[145];
        const float W9_6 = S[146];
        const float W9_7 = S[147];
        const float W9_8 = S[148];
        const float W9_9 = S[149];
        const float W9_10 = S[150];
        const float W9_11 = S[151];
        const float W9_12 = S[152];
        const float W9_13 = S[153];
        const float W10_0 = S[154];
        const float W10_1 = S[155];
        const float W10_2 = S[156];
        const float W10_3 = S[157];
        const float W10_4 = S[158];
        const float W10_5 = S[159];
        const float W10_6 = S[160];
        const float W10_7 = S[161];
        const float W10_8 = S[162];
        const float W10_9 = S[163];
        const float W10_10 = S[164];
        const float W10_11 = S[165];
        const float W10_12 = S[166];
        const float W10_13 = S[167];
        const float W11_0 = S[168];
        const float W11_1 = S[169];
        const float W11_2 = S[170];
        const float W11_3 = S[171];
        const float W11_4 = S[172];
        const float W11_5 = S[173];
        const float W11_6 = S[174];
        const float W11_7 = S[175];
        const float W11_8 = S[176];
        const float W11_9 = S[177];
        const float W11_10 = S[178];
        const float W11_11 = S[179];
        const float W11_12 = S[180];
        const float W11_13 = S[181];
        const float W12_0 = S[182];
        const float W12_1 = S[183];
        const float W12_2 = S[184];
        const float W12_3 = S[185];
        const float W12_4 = S[186];
        const float W12_5 = S[187];
        const float W12_6 = S[188];
        const float W12_7 = S[189];
        const float W12_8 = S[190];
        const float W12_9 = S[191];
        const float W12_10 = S[192];
        const float W12_11 = S[193];
        const float W12_12 = S[194];
        const float W12_13 = S[195];
        const float W13_0 = S[196];
        const float W13_1 = S[197];
        const float W13_2 = S[198];
        const float W13_3 = S[199];
        const float W13_4 = S[200];
        const float W13_5 = S[201];
        const float W13_6 = S[202];
        const float W13_7 = S[203];
        const float W13_8 = S[204];
        const float W13_9 = S[205];
        const float W13_10 = S[206];
        const float W13_11 = S[207];
        const float W13_12 = S[208];
        const float W13_13 = S[209];
        for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 14 * b;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f x4 = X[4];
            const vector_f x5 = X[5];
            const vector_f x6 = X[6];
            const vector_f x7 = X[7];
            const vector_f x8 = X[8];
            const vector_f x9 = X[9];
            const vector_f x10 = X[10];
            const vector_f x11 = X[11];
            const vector_f x12 = X[12];
            const vector_f x13 = X[13];
            const vector_f gap = x0 - mu0;
            const vector_f round_2 = round_each_f(0.15915494309189535f * gap);
            const vector_f v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
            const vector_f gap_2 = x1 - mu1;
            const vector_f round_3 = round_each_f(0.15915494309189535f * gap_2);
            const vector_f v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
            const vector_f gap_3 = x2 - mu2;
            const vector_f round_4 = round_each_f(0.15915494309189535f * gap_3);
            const vector_f v2 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
            const vector_f gap_4 = x3 - mu3;
            const vector_f round_5 = round_each_f(0.15915494309189535f * gap_4);
            const vector_f v3 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
            const vector_f gap_5 = x4 - mu4;
            const vector_f round_6 = round_each_f(0.15915494309189535f * gap_5);
            const vector_f v4 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
            const vector_f total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
            const vector_f gap_6 = x5 - mu5;
            const vector_f round_7 = round_each_f(0.15915494309189535f * gap_6);
            const vector_f v5 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
            const vector_f gap_7 = x6 - mu6;
            const vector_f round_8 = round_each_f(0.15915494309189535f * gap_7);
            const vector_f v6 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
            const vector_f gap_8 = x7 - mu7;
            const vector_f round_9 = round_each_f(0.15915494309189535f * gap_8);
            const vector_f v7 = gap_8 - 6.28125f * round_9 - 0.001935307179586477f * round_9;
            const vector_f gap_9 = x8 - mu8;
            const vector_f round_10 = round_each_f(0.15915494309189535f * gap_9);
            const vector_f v8 = gap_9 - 6.28125f * round_10 - 0.001935307179586477f * round_10;
            const vector_f total_3 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
            const vector_f gap_10 = x9 - mu9;
            const vector_f round_11 = round_each_f(0.15915494309189535f * gap_10);
            const vector_f v9 = gap_10 - 6.28125f * round_11 - 0.001935307179586477f * round_11;
            const vector_f gap_11 = x10 - mu10;
            const vector_f round_12 = round_each_f(0.15915494309189535f * gap_11);
            const vector_f v10 = gap_11 - 6.28125f * round_12 - 0.001935307179586477f * round_12;
            const vector_f gap_12 = x11 - mu11;
            const vector_f round_13 = round_each_f(0.15915494309189535f * gap_12);
            const vector_f v11 = gap_12 - 6.28125f * round_13 - 0.001935307179586477f * round_13;
            const vector_f gap_13 = x12 - mu12;
            const vector_f round_14 = round_each_f(0.15915494309189535f * gap_13);
            const vector_f v12 = gap_13 - 6.28125f * round_14 - 0.001935307179586477f * round_14;
            const vector_f total_4 = total_3 + W0_9 * v9 + W0_10 * v10 + W0_11 * v11 + W0_12 * v12;
            const vector_f gap_14 = x13 - mu13;
            const vector_f round_15 = round_each_f(0.15915494309189535f * gap_14);
            const vector_f v13 = gap_14 - 6.28125f * round_15 - 0.001935307179586477f * round_15;
            const vector_f z0 = total_4 + W0_13 * v13;
            const vector_f total_5 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
            const vector_f total_6 = total_5 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
            const vector_f total_7 = total_6 + W1_9 * v9 + W1_10 * v10 + W1_11 * v11 + W1_12 * v12;
            const vector_f z1 = total_7 + W1_13 * v13;
            const vector_f total_8 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
            const vector_f total_9 = total_8 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
            const vector_f total_10 = total_9 + W2_9 * v9 + W2_10 * v10 + W2_11 * v11 + W2_12 * v12;
            const vector_f z2 = total_10 + W2_13 * v13;
            const vector_f total_11 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
            const vector_f total_12 = total_11 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
            const vector_f total_13 = total_12 + W3_9 * v9 + W3_10 * v10 + W3_11 * v11 + W3_12 * v12;
            const vector_f z3 = total_13 + W3_13 * v13;
            const vector_f total_14 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
            const vector_f total_15 = total_14 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
            const vector_f total_16 = total_15 + W4_9 * v9 + W4_10 * v10 + W4_11 * v11 + W4_12 * v12;
            const vector_f z4 = total_16 + W4_13 * v13;
            const vector_f total_17 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
            const vector_f total_18 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
            const vector_f total_19 = total_18 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
            const vector_f total_20 = total_19 + W5_9 * v9 + W5_10 * v10 + W5_11 * v11 + W5_12 * v12;
            const vector_f z5 = total_20 + W5_13 * v13;
            const vector_f total_21 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
            const vector_f total_22 = total_21 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
            const vector_f total_23 = total_22 + W6_9 * v9 + W6_10 * v10 + W6_11 * v11 + W6_12 * v12;
            const vector_f z6 = total_23 + W6_13 * v13;
            const vector_f total_24 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
            const vector_f total_25 = total_24 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
            const vector_f total_26 = total_25 + W7_9 * v9 + W7_10 * v10 + W7_11 * v11 + W7_12 * v12;
            const vector_f z7 = total_26 + W7_13 * v13;
            const vector_f total_27 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
            const vector_f total_28 = total_27 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
            const vector_f total_29 = total_28 + W8_9 * v9 + W8_10 * v10 + W8_11 * v11 + W8_12 * v12;
            const vector_f z8 = total_29 + W8_13 * v13;
            const vector_f total_30 = total_17 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
            const vector_f total_31 = W9_0 * v0 + W9_1 * v1 + W9_2 * v2 + W9_3 * v3 + W9_4 * v4;
            const vector_f total_32 = total_31 + W9_5 * v5 + W9_6 * v6 + W9_7 * v7 + W9_8 * v8;
            const vector_f total_33 = total_32 + W9_9 * v9 + W9_10 * v10 + W9_11 * v11 + W9_12 * v12;
            const vector_f z9 = total_33 + W9_13 * v13;
            const vector_f total_34 = W10_0 * v0 + W10_1 * v1 + W10_2 * v2 + W10_3 * v3 + W10_4 * v4;
            const vector_f total_35 = total_34 + W10_5 * v5 + W10_6 * v6 + W10_7 * v7 + W10_8 * v8;
            const vector_f total_36 = total_35 + W10_9 * v9 + W10_10 * v10 + W10_11 * v11 + W10_12 * v12;
            const vector_f z10 = total_36 + W10_13 * v13;
            const vector_f total_37 = W11_0 * v0 + W11_1 * v1 + W11_2 * v2 + W11_3 * v3 + W11_4 * v4;
            const vector_f total_38 = total_37 + W11_5 * v5 + W11_6 * v6 + W11_7 * v7 + W11_8 * v8;
            const vector_f total_39 = total_38 + W11_9 * v9 + W11_10 * v10 + W11_11 * v11 + W11_12 * v12;
            const vector_f z11 = total_39 + W11_13 * v13;
            const vector_f total_40 = W12_0 * v0 + W12_1 * v1 + W12_2 * v2 + W12_3 * v3 + W12_4 * v4;
            const vector_f total_41 = total_40 + W12_5 * v5 + W12_6 * v6 + W12_7 * v7 + W12_8 * v8;
            const vector_f total_42 = total_41 + W12_9 * v9 + W12_10 * v10 + W12_11 * v11 + W12_12 * v12;
            const vector_f z12 = total_42 + W12_13 * v13;
            const vector_f total_43 = total_30 + z9 * z9 + z10 * z10 + z11 * z11 + z12 * z12;
            const vector_f total_44 = W13_0 * v0 + W13_1 * v1 + W13_2 * v2 + W13_3 * v3 + W13_4 * v4;
            const vector_f total_45 = total_44 + W13_5 * v5 + W13_6 * v6 + W13_7 * v7 + W13_8 * v8;
            const vector_f total_46 = total_45 + W13_9 * v9 + W13_10 * v10 + W13_11 * v11 + W13_12 * v12;
            const vector_f z13 = total_46 + W13_13 * v13;
            const vector_f phi = gaussian_each_f(total_43 + z13 * z13);
            kept[k][b].z0 = z0;
            kept[k][b].z1 = z1;
            kept[k][b].z2 = z2;
            kept[k][b].z3 = z3;
            kept[k][b].z4 = z4;
            kept[k][b].z5 = z5;
            kept[k][b].z6 = z6;
            kept[k][b].z7 = z7;
            kept[k][b].z8 = z8;
            kept[k][b].z9 = z9;
            kept[k][b].z10 = z10;
            kept[k][b].z11 = z11;
            kept[k][b].z12 = z12;
            kept[k][b].z13 = z13;
            kept[k][b].phi = phi;
        }
    }
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 211 * near[k];
        const float W0_0 = S[14];
        const float W0_1 = S[15];
        const float W0_2 = S[16];
        const float W0_3 = S[17];
        const float W0_4 = S[18];
        const float W0_5 = S[19];
        const float W0_6 = S[20];
        const float W0_7 = S[21];
        const float W0_8 = S[22];
        const float W0_9 = S[23];
        const float W0_10 = S[24];
        const float W0_11 = S[25];
        const float W0_12 = S[26];
        const float W0_13 = S[27];
        const float W1_0 = S[28];
        const float W1_1 = S[29];
        const float W1_2 = S[30];
        const float W1_3 = S[31];
        const float W1_4 = S[32];
        const float W1_5 = S[33];
        const float W1_6 = S[34];
        const float W1_7 = S[35];
        const float W1_8 = S[36];
        const float W1_9 = S[37];
        const float W1_10 = S[38];
        const float W1_11 = S[39];
        const float W1_12 = S[40];
        const float W1_13 = S[41];
        const float W2_0 = S[42];
        const float W2_1 = S[43];
        const float W2_2 = S[44];
        const float W2_3 = S[45];
        const float W2_4 = S[46];
        const float W2_5 = S[47];
        const float W2_6 = S[48];
        const float W2_7 = S[49];
        const float W2_8 = S[50];
        const float W2_9 = S[51];
        const float W2_10 = S[52];
        const float W2_11 = S[53];
        const float W2_12 = S[54];
        const float W2_13 = S[55];
        const float W3_0 = S[56];
        const float W3_1 = S[57];
        const float W3_2 = S[58];
        const float W3_3 = S[59];
        const float W3_4 = S[60];
        const float W3_5 = S[61];
        const float W3_6 = S[62];
        const float W3_7 = S[63];
        const float W3_8 = S[64];
        const float W3_9 = S[65];
        const float W3_10 = S[66];
        const float W3_11 = S[67];
        const float W3_12 = S[68];
        const float W3_13 = S[69];
        const float W4_0 = S[70];
        const float W4_1 = S[71];
        const float W4_2 = S[72];
        const float W4_3 = S[73];
        const float W4_4 = S[74];
        const float W4_5 = S[75];
        const float W4_6 = S[76];
        const float W4_7 = S[77];
        const float W4_8 = S[78];
        const float W4_9 = S[79];
        const float W4_10 = S[80];
        const float W4_11 = S[81];
        const float W4_12 = S[82];
        const float W4_13 = S[83];
        const float W5_0 = S[84];
        const float W5_1 = S[85];
        const float W5_2 = S[86];
        const float W5_3 = S[87];
        const float W5_4 = S[88];
        const float W5_5 = S[89];
        const float W5_6 = S[90];
        const float W5_7 = S[91];
        const float W5_8 = S[92];
        const float W5_9 = S[93];
        const float W5_10 = S[94];
        const float W5_11 = S[95];
        const float W5_12 = S[96];
        const float W5_13 = S[97];
        const float W6_0 = S[98];
        const float W6_1 = S[99];
        const float W6_2 = S[100];
        const float W6_3 = S[101];
        const float W6_4 = S[102];
        const float W6_5 = S[103];
        const float W6_6 = S[104];
        const float W6_7 = S[105];
        const float W6_8 = S[106];
        const float W6_9 = S[107];
        const float W6_10 = S[108];
        const float W6_11 = S[109];
        const float W6_12 = S[110];
        const float W6_13 = S[111];
        const float W7_0 = S[112];
        const float W7_1 = S[113];
        const float W7_2 = S[114];
        const float W7_3 = S[115];
        const float W7_4 = S[116];
        const float W7_5 = S[117];
        const float W7_6 = S[118];
        const float W7_7 = S[119];
        const float W7_8 = S[120];
        const float W7_9 = S[121];
        const float W7_10 = S[122];
        const float W7_11 = S[123];
        const float W7_12 = S[124];
        const float W7_13 = S[125];
        const float W8_0 = S[126];
        const float W8_1 = S[127];
        const float W8_2 = S[128];
        const float W8_3 = S[129];
        const float W8_4 = S[130];
        const float W8_5 = S[131];
        const float W8_6 = S[132];
        const float W8_7 = S[133];
        const float W8_8 = S[134];
        const float W8_9 = S[135];
        const float W8_10 = S[136];
        const float W8_11 = S[137];
        const float W8_12 = S[138];
        const float W8_13 = S[139];
        const float W9_0 = S[140];
        const float W9_1 = S[141];
        const float W9_2 = S[142];
        const float W9_3 = S[143];
        const float W9_4 = S[144];
        const float W9_5 = S[145];
        const float W9_6 = S[146];
        const float W9_7 = S[147];
        const float W9_8 = S[148];
        const float W9_9 = S[149];
        const float W9_10 = S[150];
        const float W9_11 = S[151];
        const float W9_12 = S[152];
        const float W9_13 = S[153];
        const float W10_0 = S[154];
        const float W10_1 = S[155];
        const float W10_2 = S[156];
        const float W10_3 = S[157];
        const float W10_4 = S[158];
        const float W10_5 = S[159];
        const float W10_6 = S[160];
        const float W10_7 = S[161];
        const float W10_8 = S[162];
        const float W10_9 = S[163];
        const float W10_10 = S[164];
        const float W10_11 = S[165];
        const float W10_12 = S[166];
        const float W10_13 = S[167];
        const float W11_0 = S[168];
        const float W11_1 = S[169];
        const float W11_2 = S[170];
        const float W11_3 = S[171];
        const float W11_4 = S[172];
        const float W11_5 = S[173];
        const float W11_6 = S[174];
        const float W11_7 = S[175];
        const float W11_8 = S[176];
        const float W11_9 = S[177];
        const float W11_10 = S[178];
        const float W11_11 = S[179];
        const float W11_12 = S[180];
        const float W11_13 = S[181];
        const float W12_0 = S[182];
        const float W12_1 = S[183];
        const float W12_2 = S[184];
        const float W12_3 = S[185];
        const float W12_4 = S[186];
        const float W12_5 = S[187];
        const float W12_6 = S[188];
        const float W12_7 = S[189];
        const float W12_8 = S[190];
        const float W12_9 = S[191];
        const float W12_10 = S[192];
        const float W12_11 = S[193];
        const float W12_12 = S[194];
        const float W12_13 = S[195];
        const float W13_0 = S[196];
        const float W13_1 = S[197];
        const float W13_2 = S[198];
        const float W13_3 = S[199];
        const float W13_4 = S[200];
        const float W13_5 = S[201];
        const float W13_6 = S[202];
        const float W13_7 = S[203];
        const float W13_8 = S[204];
        const float W13_9 = S[205];
        const float W13_10 = S[206];
        const float W13_11 = S[207];
        const float W13_12 = S[208];
        const float W13_13 = S[209];
        const float amplitude = S[210];
        for (size_t b = 0; b < 2; ++b) {
            vector_f *value = values + b;
            vector_f *slope = slopes + 14 * b;
            const vector_f z0 = kept[k][b].z0;
            const vector_f z1 = kept[k][b].z1;
            const vector_f z2 = kept[k][b].z2;
            const vector_f z3 = kept[k][b].z3;
            const vector_f z4 = kept[k][b].z4;
            const vector_f z5 = kept[k][b].z5;
            const vector_f z6 = kept[k][b].z6;
            const vector_f z7 = kept[k][b].z7;
            const vector_f z8 = kept[k][b].z8;
            const vector_f z9 = kept[k][b].z9;
            const vector_f z10 = kept[k][b].z10;
            const vector_f z11 = kept[k][b].z11;
            const vector_f z12 = kept[k][b].z12;
            const vector_f z13 = kept[k][b].z13;
            const vector_f phi = kept[k][b].phi;
            const vector_f phi_2 = amplitude * phi;
            const vector_f z13_product = z13 * phi_2;
            const vector_f z12_product = z12 * phi_2;
            const vector_f z11_product = z11 * phi_2;
            const vector_f z10_product = z10 * phi_2;
            const vector_f z9_product = z9 * phi_2;
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
            slope[0] = slope[0] - W13_0 * z13_product - W12_0 * z12_product - W11_0 * z11_product - W10_0 *
                    z10_product - W9_0 * z9_product - W8_0 * z8_product - W7_0 * z7_product - W6_0 * z6_product - W5_0 *
                    z5_product - W4_0 * z4_product - W3_0 * z3_product - W2_0 * z2_product - W1_0 * z1_product - W0_0 *
                    z0_product;
            slope[1] = slope[1] - W13_1 * z13_product - W12_1 * z12_product - W11_1 * z11_product - W10_1 *
                    z10_product - W9_1 * z9_product - W8_1 * z8_product - W7_1 * z7_product - W6_1 * z6_product - W5_1 *
                    z5_product - W4_1 * z4_product - W3_1 * z3_product - W2_1 * z2_product - W1_1 * z1_product - W0_1 *
                    z0_product;
            slope[2] = slope[2] - W13_2 * z13_product - W12_2 * z12_product - W11_2 * z11_product - W10_2 *
                    z10_product - W9_2 * z9_product - W8_2 * z8_product - W7_2 * z7_product - W6_2 * z6_product - W5_2 *
                    z5_product - W4_2 * z4_product - W3_2 * z3_product - W2_2 * z2_product - W1_2 * z1_product - W0_2 *
                    z0_product;
            slope[3] = slope[3] - W13_3 * z13_product - W12_3 * z12_product - W11_3 * z11_product - W10_3 *
                    z10_product - W9_3 * z9_product - W8_3 * z8_product - W7_3 * z7_product - W6_3 * z6_product - W5_3 *
                    z5_product - W4_3 * z4_product - W3_3 * z3_product - W2_3 * z2_product - W1_3 * z1_product - W0_3 *
                    z0_product;
            slope[4] = slope[4] - W13_4 * z13_product - W12_4 * z12_product - W11_4 * z11_product - W10_4 *
                    z10_product - W9_4 * z9_product - W8_4 * z8_product - W7_4 * z7_product - W6_4 * z6_product - W5_4 *
                    z5_product - W4_4 * z4_product - W3_4 * z3_product - W2_4 * z2_product - W1_4 * z1_product - W0_4 *
                    z0_product;
            slope[5] = slope[5] - W13_5 * z13_product - W12_5 * z12_product - W11_5 * z11_product - W10_5 *
                    z10_product - W9_5 * z9_product - W8_5 * z8_product - W7_5 * z7_product - W6_5 * z6_product - W5_5 *
                    z5_product - W4_5 * z4_product - W3_5 * z3_product - W2_5 * z2_product - W1_5 * z1_product - W0_5 *
                    z0_product;
            slope[6] = slope[6] - W13_6 * z13_product - W12_6 * z12_product - W11_6 * z11_product - W10_6 *
                    z10_product - W9_6 * z9_product - W8_6 * z8_product - W7_6 * z7_product - W6_6 * z6_product - W5_6 *
                    z5_product - W4_6 * z4_product - W3_6 * z3_product - W2_6 * z2_product - W1_6 * z1_product - W0_6 *
                    z0_product;
            slope[7] = slope[7] - W13_7 * z13_product - W12_7 * z12_product - W11_7 * z11_product - W10_7 *
                    z10_product - W9_7 * z9_product - W8_7 * z8_product - W7_7 * z7_product - W6_7 * z6_product - W5_7 *
                    z5_product - W4_7 * z4_product - W3_7 * z3_product - W2_7 * z2_product - W1_7 * z1_product - W0_7 *
                    z0_product;
            slope[8] = slope[8] - W13_8 * z13_product - W12_8 * z12_product - W11_8 * z11_product - W10_8 *
                    z10_product - W9_8 * z9_product - W8_8 * z8_product - W7_8 * z7_product - W6_8 * z6_product - W5_8 *
                    z5_product - W4_8 * z4_product - W3_8 * z3_product - W2_8 * z2_product - W1_8 * z1_product - W0_8 *
                    z0_product;
            slope[9] = slope[9] - W13_9 * z13_product - W12_9 * z12_product - W11_9 * z11_product - W10_9 *
                    z10_product - W9_9 * z9_product - W8_9 * z8_product - W7_9 * z7_product - W6_9 * z6_product - W5_9 *
                    z5_product - W4_9 * z4_product - W3_9 * z3_product - W2_9 * z2_product - W1_9 * z1_product - W0_9 *
                    z0_product;
            slope[10] = slope[10] - W13_10 * z13_product - W12_10 * z12_product - W11_10 * z11_product - W10_10 *
                    z10_product - W9_10 * z9_product - W8_10 * z8_product - W7_10 * z7_product - W6_10 * z6_product -
                    W5_10 * z5_product - W4_10 * z4_product - W3_10 * z3_product - W2_10 * z2_product - W1_10 * z1_product
                    - W0_10 * z0_product;
            slope[11] = slope[11] - W13_11 * z13_product - W12_11 * z12_product - W11_11 * z11_product - W10_11 *
                    z10_product - W9_11 * z9_product - W8_11 * z8_product - W7_11 * z7_product - W6_11 * z6_product -
                    W5_11 * z5_product - W4_11 * z4_product - W3_11 * z3_product - W2_11 * z2_product - W1_11 * z1_product
                    - W0_11 * z0_product;
            slope[12] = slope[12] - W13_12 * z13_product - W12_12 * z12_product - W11_12 * z11_product - W10_12 *
                    z10_product - W9_12 * z9_product - W8_12 * z8_product - W7_12 * z7_product - W6_12 * z6_product -
                    W5_12 * z5_product - W4_12 * z4_product - W3_12 * z3_product - W2_12 * z2_product - W1_12 * z1_product
                    - W0_12 * z0_product;
            slope[13] = slope[13] - W13_13 * z13_product - W12_13 * z12_product - W11_13 * z11_product - W10_13 *
                    z10_product - W9_13 * z9_product - W8_13 * z8_product - W7_13 * z7_product - W6_13 * z6_product -
                    W5_13 * z5_product - W4_13 * z4_product - W3_13 * z3_product - W2_13 * z2_product - W1_13 * z1_product
                    - W0_13 * z0_product;
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
    const vector_f slope_x9 = slope[9];
    const vector_f slope_x10 = slope[10];
    const vector_f slope_x11 = slope[11];
    const vector_f slope_x12 = slope[12];
    const vector_f slope_x13 = slope[13];
    gradient[0] = slope_x0;
    gradient[1] = slope_x1;
    gradient[2] = slope_x2;
    gradient[3] = slope_x3;
    gradient[4] = slope_x4;
    gradient[5] = slope_x5;
    gradient[6] = slope_x6;
    gradient[7] = slope_x7;
    gradient[8] = slope_x8;
    gradient[9] = slope_x9;
    gradient[10] = slope_x10;
    gradient[11] = slope_x11;
    gradient[12] = slope_x12;
    gradient[13] = slope_x13;
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
    const vector_f gradient_bar9 = gradient_bar[9];
    const vector_f gradient_bar10 = gradient_bar[10];
    const vector_f gradient_bar11 = gradient_bar[11];
    const vector_f gradient_bar12 = gradient_bar[12];
    const vector_f gradient_bar13 = gradient_bar[13];
    slope_bar[0] = gradient_bar0;
    slope_bar[1] = gradient_bar1;
    slope_bar[2] = gradient_bar2;
    slope_bar[3] = gradient_bar3;
    slope_bar[4] = gradient_bar4;
    slope_bar[5] = gradient_bar5;
    slope_bar[6] = gradient_bar6;
    slope_bar[7] = gradient_bar7;
    slope_bar[8] = gradient_bar8;
    slope_bar[9] = gradient_bar9;
    slope_bar[10] = gradient_bar10;
    slope_bar[11] = gradient_bar11;
    slope_bar[12] = gradient_bar12;
    slope_bar[13] = gradient_bar13;
}

/*
 * The factors of whose products are what is summed over the points, for some vectors of points.
 * In steps, each for all pairs before the next, so that what is slow overlaps; `kept` is what later steps read.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
OUTLINE void pair_factors_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *factors) {
    struct { vector_f v0, v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, z0, z1, z2, z3, z4, z5, z6,
            z7, z8, z9, z10, z11, z12, z13, phi; } kept[6];
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 29 * (size_t)near[i];
        const vector_f x0 = X[0];
        const vector_f x1 = X[1];
        const vector_f x2 = X[2];
        const vector_f x3 = X[3];
        const vector_f x4 = X[4];
        const vector_f x5 = X[5];
        const vector_f x6 = X[6];
        const vector_f x7 = X[7];
        const vector_f x8 = X[8];
        const vector_f x9 = X[9];
        const vector_f x10 = X[10];
        const vector_f x11 = X[11];
        const vector_f x12 = X[12];
        const vector_f x13 = X[13];
        const float mu0 = S[0];
        const float mu1 = S[1];
        const float mu2 = S[2];
        const float mu3 = S[3];
        const float mu4 = S[4];
        const float mu5 = S[5];
        const float mu6 = S[6];
        const float mu7 = S[7];
        const float mu8 = S[8];
        const float mu9 = S[9];
        const float mu10 = S[10];
        const float mu11 = S[11];
        const float mu12 = S[12];
        const float mu13 = S[13];
        const float W0_0 = S[14];
        const float W0_1 = S[15];
        const float W0_2 = S[16];
        const float W0_3 = S[17];
        const float W0_4 = S[18];
        const float W0_5 = S[19];
        const float W0_6 = S[20];
        const float W0_7 = S[21];
        const float W0_8 = S[22];
        const float W0_9 = S[23];
        const float W0_10 = S[24];
        const float W0_11 = S[25];
        const float W0_12 = S[26];
        const float W0_13 = S[27];
        const float W1_0 = S[28];
        const float W1_1 = S[29];
        const float W1_2 = S[30];
        const float W1_3 = S[31];
        const float W1_4 = S[32];
        const float W1_5 = S[33];
        const float W1_6 = S[34];
        const float W1_7 = S[35];
        const float W1_8 = S[36];
        const float W1_9 = S[37];
        const float W1_10 = S[38];
        const float W1_11 = S[39];
        const float W1_12 = S[40];
        const float W1_13 = S[41];
        const float W2_0 = S[42];
        const float W2_1 = S[43];
        const float W2_2 = S[44];
        const float W2_3 = S[45];
        const float W2_4 = S[46];
        const float W2_5 = S[47];
        const float W2_6 = S[48];
        const float W2_7 = S[49];
        const float W2_8 = S[50];
        const float W2_9 = S[51];
        const float W2_10 = S[52];
        const float W2_11 = S[53];
        const float W2_12 = S[54];
        const float W2_13 = S[55];
        const float W3_0 = S[56];
        const float W3_1 = S[57];
        const float W3_2 = S[58];
        const float W3_3 = S[59];
        const float W3_4 = S[60];
        const float W3_5 = S[61];
        const float W3_6 = S[62];
        const float W3_7 = S[63];
        const float W3_8 = S[64];
        const float W3_9 = S[65];
        const float W3_10 = S[66];
        const float W3_11 = S[67];
        const float W3_12 = S[68];
        const float W3_13 = S[69];
        const float W4_0 = S[70];
        const float W4_1 = S[71];
        const float W4_2 = S[72];
        const float W4_3 = S[73];
        const float W4_4 = S[74];
        const float W4_5 = S[75];
        const float W4_6 = S[76];
        const float W4_7 = S[77];
        const float W4_8 = S[78];
        const float W4_9 = S[79];
        const float W4_10 = S[80];
        const float W4_11 = S[81];
        const float W4_12 = S[82];
        const float W4_13 = S[83];
        const float W5_0 = S[84];
        const float W5_1 = S[85];
        const float W5_2 = S[86];
        const float W5_3 = S[87];
        const float W5_4 = S[88];
        const float W5_5 = S[89];
        const float W5_6 = S[90];
        const float W5_7 = S[91];
        const float W5_8 = S[92];
        const float W5_9 = S[93];
        const float W5_10 = S[94];
        const float W5_11 = S[95];
        const float W5_12 = S[96];
        const float W5_13 = S[97];
        const float W6_0 = S[98];
        const float W6_1 = S[99];
        const float W6_2 = S[100];
        const float W6_3 = S[101];
        const float W6_4 = S[102];
        const float W6_5 = S[103];
        const float W6_6 = S[104];
        const float W6_7 = S[105];
        const float W6_8 = S[106];
        const float W6_9 = S[107];
        const float W6_10 = S[108];
        const float W6_11 = S[109];
        const float W6_12 = S[110];
        const float W6_13 = S[111];
        const float W7_0 = S[112];
        const float W7_1 = S[113];
        const float W7_2 = S[114];
        const float W7_3 = S[115];
        const float W7_4 = S[116];
        const float W7_5 = S[117];
        const float W7_6 = S[118];
        const float W7_7 = S[119];
        const float W7_8 = S[120];
        const float W7_9 = S[121];
        const float W7_10 = S[122];
        const float W7_11 = S[123];
        const float W7_12 = S[124];
        const float W7_13 = S[125];
        const float W8_0 = S[126];
        const float W8_1 = S[127];
        const float W8_2 = S[128];
        const float W8_3 = S[129];
        const float W8_4 = S[130];
        const float W8_5 = S[131];
        const float W8_6 = S[132];
        const float W8_7 = S[133];
        const float W8_8 = S[134];
        const float W8_9 = S[135];
        const float W8_10 = S[136];
        const float W8_11 = S[137];
        const float W8_12 = S[138];
        const float W8_13 = S[139];
        const float W9_0 = S[140];
        const float W9_1 = S[141];
        const float W9_2 = S[142];
        const float W9_3 = S[143];
        const float W9_4 = S[144];
        const float W9_5 = S[145];
        const float W9_6 = S[146];
        const float W9_7 = S[147];
        const float W9_8 = S[148];
        const float W9_9 = S[149];
        const float W9_10 = S[150];
        const float W9_11 = S[151];
        const float W9_12 = S[152];
        const float W9_13 = S[153];
        const float W10_0 = S[154];
        const float W10_1 = S[155];
        const float W10_2 = S[156];
        const float W10_3 = S[157];
        const float W10_4 = S[158];
        const float W10_5 = S[159];
        const float W10_6 = S[160];
        const float W10_7 = S[161];
        const float W10_8 = S[162];
        const float W10_9 = S[163];
        const float W10_10 = S[164];
        const float W10_11 = S[165];
        const float W10_12 = S[166];
        const float W10_13 = S[167];
        const float W11_0 = S[168];
        const float W11_1 = S[169];
        const float W11_2 = S[170];
        const float W11_3 = S[171];
        const float W11_4 = S[172];
        const float W11_5 = S[173];
        const float W11_6 = S[174];
        const float W11_7 = S[175];
        const float W11_8 = S[176];
        const float W11_9 = S[177];
        const float W11_10 = S[178];
        const float W11_11 = S[179];
        const float W11_12 = S[180];
        const float W11_13 = S[181];
        const float W12_0 = S[182];
        const float W12_1 = S[183];
        const float W12_2 = S[184];
        const float W12_3 = S[185];
        const float W12_4 = S[186];
        const float W12_5 = S[187];
        const float W12_6 = S[188];
        const float W12_7 = S[189];
        const float W12_8 = S[190];
        const float W12_9 = S[191];
        const float W12_10 = S[192];
        const float W12_11 = S[193];
        const float W12_12 = S[194];
        const float W12_13 = S[195];
        const float W13_0 = S[196];
        const float W13_1 = S[197];
        const float W13_2 = S[198];
        const float W13_3 = S[199];
        const float W13_4 = S[200];
        const float W13_5 = S[201];
        const float W13_6 = S[202];
        const float W13_7 = S[203];
        const float W13_8 = S[204];
        const float W13_9 = S[205];
        const float W13_10 = S[206];
        const float W13_11 = S[207];
        const float W13_12 = S[208];
        const float W13_13 = S[209];
        const vector_f gap = x0 - mu0;
        const vector_f round_2 = round_each_f(0.15915494309189535f * gap);
        const vector_f v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
        const vector_f gap_2 = x1 - mu1;
        const vector_f round_3 = round_each_f(0.15915494309189535f * gap_2);
        const vector_f v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
        const vector_f gap_3 = x2 - mu2;
        const vector_f round_4 = round_each_f(0.15915494309189535f * gap_3);
        const vector_f v2 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
        const vector_f gap_4 = x3 - mu3;
        const vector_f round_5 = round_each_f(0.15915494309189535f * gap_4);
        const vector_f v3 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
        const vector_f gap_5 = x4 - mu4;
        const vector_f round_6 = round_each_f(0.15915494309189535f * gap_5);
        const vector_f v4 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
        const vector_f total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
        const vector_f gap_6 = x5 - mu5;
        const vector_f round_7 = round_each_f(0.15915494309189535f * gap_6);
        const vector_f v5 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
        const vector_f gap_7 = x6 - mu6;
        const vector_f round_8 = round_each_f(0.15915494309189535f * gap_7);
        const vector_f v6 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
        const vector_f gap_8 = x7 - mu7;
        const vector_f round_9 = round_each_f(0.15915494309189535f * gap_8);
        const vector_f v7 = gap_8 - 6.28125f * round_9 - 0.001935307179586477f * round_9;
        const vector_f gap_9 = x8 - mu8;
        const vector_f round_10 = round_each_f(0.15915494309189535f * gap_9);
        const vector_f v8 = gap_9 - 6.28125f * round_10 - 0.001935307179586477f * round_10;
        const vector_f total_3 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
        const vector_f gap_10 = x9 - mu9;
        const vector_f round_11 = round_each_f(0.15915494309189535f * gap_10);
        const vector_f v9 = gap_10 - 6.28125f * round_11 - 0.001935307179586477f * round_11;
        const vector_f gap_11 = x10 - mu10;
        const vector_f round_12 = round_each_f(0.15915494309189535f * gap_11);
        const vector_f v10 = gap_11 - 6.28125f * round_12 - 0.001935307179586477f * round_12;
        const vector_f gap_12 = x11 - mu11;
        const vector_f round_13 = round_each_f(0.15915494309189535f * gap_12);
        const vector_f v11 = gap_12 - 6.28125f * round_13 - 0.001935307179586477f * round_13;
        const vector_f gap_13 = x12 - mu12;
        const vector_f round_14 = round_each_f(0.15915494309189535f * gap_13);
        const vector_f v12 = gap_13 - 6.28125f * round_14 - 0.001935307179586477f * round_14;
        const vector_f total_4 = total_3 + W0_9 * v9 + W0_10 * v10 + W0_11 * v11 + W0_12 * v12;
        const vector_f gap_14 = x13 - mu13;
        const vector_f round_15 = round_each_f(0.15915494309189535f * gap_14);
        const vector_f v13 = gap_14 - 6.28125f * round_15 - 0.001935307179586477f * round_15;
        const vector_f z0 = total_4 + W0_13 * v13;
        const vector_f total_5 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
        const vector_f total_6 = total_5 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
        const vector_f total_7 = total_6 + W1_9 * v9 + W1_10 * v10 + W1_11 * v11 + W1_12 * v12;
        const vector_f z1 = total_7 + W1_13 * v13;
        const vector_f total_8 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
        const vector_f total_9 = total_8 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
        const vector_f total_10 = total_9 + W2_9 * v9 + W2_10 * v10 + W2_11 * v11 + W2_12 * v12;
        const vector_f z2 = total_10 + W2_13 * v13;
        const vector_f total_11 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
        const vector_f total_12 = total_11 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
        const vector_f total_13 = total_12 + W3_9 * v9 + W3_10 * v10 + W3_11 * v11 + W3_12 * v12;
        const vector_f z3 = total_13 + W3_13 * v13;
        const vector_f total_14 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
        const vector_f total_15 = total_14 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
        const vector_f total_16 = total_15 + W4_9 * v9 + W4_10 * v10 + W4_11 * v11 + W4_12 * v12;
        const vector_f z4 = total_16 + W4_13 * v13;
        const vector_f total_17 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
        const vector_f total_18 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
        const vector_f total_19 = total_18 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
        const vector_f total_20 = total_19 + W5_9 * v9 + W5_10 * v10 + W5_11 * v11 + W5_12 * v12;
        const vector_f z5 = total_20 + W5_13 * v13;
        const vector_f total_21 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
        const vector_f total_22 = total_21 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
        const vector_f total_23 = total_22 + W6_9 * v9 + W6_10 * v10 + W6_11 * v11 + W6_12 * v12;
        const vector_f z6 = total_23 + W6_13 * v13;
        const vector_f total_24 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
        const vector_f total_25 = total_24 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
        const vector_f total_26 = total_25 + W7_9 * v9 + W7_10 * v10 + W7_11 * v11 + W7_12 * v12;
        const vector_f z7 = total_26 + W7_13 * v13;
        const vector_f total_27 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
        const vector_f total_28 = total_27 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
        const vector_f total_29 = total_28 + W8_9 * v9 + W8_10 * v10 + W8_11 * v11 + W8_12 * v12;
        const vector_f z8 = total_29 + W8_13 * v13;
        const vector_f total_30 = total_17 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
        const vector_f total_31 = W9_0 * v0 + W9_1 * v1 + W9_2 * v2 + W9_3 * v3 + W9_4 * v4;
        const vector_f total_32 = total_31 + W9_5 * v5 + W9_6 * v6 + W9_7 * v7 + W9_8 * v8;
        const vector_f total_33 = total_32 + W9_9 * v9 + W9_10 * v10 + W9_11 * v11 + W9_12 * v12;
        const vector_f z9 = total_33 + W9_13 * v13;
        const vector_f total_34 = W10_0 * v0 + W10_1 * v1 + W10_2 * v2 + W10_3 * v3 + W10_4 * v4;
        const vector_f total_35 = total_34 + W10_5 * v5 + W10_6 * v6 + W10_7 * v7 + W10_8 * v8;
        const vector_f total_36 = total_35 + W10_9 * v9 + W10_10 * v10 + W10_11 * v11 + W10_12 * v12;
        const vector_f z10 = total_36 + W10_13 * v13;
        const vector_f total_37 = W11_0 * v0 + W11_1 * v1 + W11_2 * v2 + W11_3 * v3 + W11_4 * v4;
        const vector_f total_38 = total_37 + W11_5 * v5 + W11_6 * v6 + W11_7 * v7 + W11_8 * v8;
        const vector_f total_39 = total_38 + W11_9 * v9 + W11_10 * v10 + W11_11 * v11 + W11_12 * v12;
        const vector_f z11 = total_39 + W11_13 * v13;
        const vector_f total_40 = W12_0 * v0 + W12_1 * v1 + W12_2 * v2 + W12_3 * v3 + W12_4 * v4;
        const vector_f total_41 = total_40 + W12_5 * v5 + W12_6 * v6 + W12_7 * v7 + W12_8 * v8;
        const vector_f total_42 = total_41 + W12_9 * v9 + W12_10 * v10 + W12_11 * v11 + W12_12 * v12;
        const vector_f z12 = total_42 + W12_13 * v13;
        const vector_f total_43 = total_30 + z9 * z9 + z10 * z10 + z11 * z11 + z12 * z12;
        const vector_f total_44 = W13_0 * v0 + W13_1 * v1 + W13_2 * v2 + W13_3 * v3 + W13_4 * v4;
        const vector_f total_45 = total_44 + W13_5 * v5 + W13_6 * v6 + W13_7 * v7 + W13_8 * v8;
        const vector_f total_46 = total_45 + W13_9 * v9 + W13_10 * v10 + W13_11 * v11 + W13_12 * v12;
        const vector_f z13 = total_46 + W13_13 * v13;
        const vector_f phi = gaussian_each_f(total_43 + z13 * z13);
        kept[i].v0 = v0;
        kept[i].v1 = v1;
        kept[i].v2 = v2;
        kept[i].v3 = v3;
        kept[i].v4 = v4;
        kept[i].v5 = v5;
        kept[i].v6 = v6;
        kept[i].v7 = v7;
        kept[i].v8 = v8;
        kept[i].v9 = v9;
        kept[i].v10 = v10;
        kept[i].v11 = v11;
        kept[i].v12 = v12;
        kept[i].v13 = v13;
        kept[i].z0 = z0;
        kept[i].z1 = z1;
        kept[i].z2 = z2;
        kept[i].z3 = z3;
        kept[i].z4 = z4;
        kept[i].z5 = z5;
        kept[i].z6 = z6;
        kept[i].z7 = z7;
        kept[i].z8 = z8;
        kept[i].z9 = z9;
        kept[i].z10 = z10;
        kept[i].z11 = z11;
        kept[i].z12 = z12;
        kept[i].z13 = z13;
        kept[i].phi = phi;
    }
    for (size_t i = 0; i < count; ++i) {
        const vector_f *value_bar = points + 29 * (size_t)near[i] + 14;
        const vector_f *slope_bar = points + 29 * (size_t)near[i] + 14 + 1;
        vector_f *factor = factors + 57 * i;
        const vector_f v0 = kept[i].v0;
        const vector_f v1 = kept[i].v1;
        const vector_f v2 = kept[i].v2;
        const vector_f v3 = kept[i].v3;
        const vector_f v4 = kept[i].v4;
        const vector_f v5 = kept[i].v5;
        const vector_f v6 = kept[i].v6;
        const vector_f v7 = kept[i].v7;
        const vector_f v8 = kept[i].v8;
        const vector_f v9 = kept[i].v9;
        const vector_f v10 = kept[i].v10;
        const vector_f v11 = kept[i].v11;
        const vector_f v12 = kept[i].v12;
        const vector_f v13 = kept[i].v13;
        const vector_f z0 = kept[i].z0;
        const vector_f z1 = kept[i].z1;
        const vector_f z2 = kept[i].z2;
        const vector_f z3 = kept[i].z3;
        const vector_f z4 = kept[i].z4;
        const vector_f z5 = kept[i].z5;
        const vector_f z6 = kept[i].z6;
        const vector_f z7 = kept[i].z7;
        const vector_f z8 = kept[i].z8;
        const vector_f z9 = kept[i].z9;
        const vector_f z10 = kept[i].z10;
        const vector_f z11 = kept[i].z11;
        const vector_f z12 = kept[i].z12;
        const vector_f z13 = kept[i].z13;
        const vector_f phi = kept[i].phi;
        const float W0_0 = S[14];
        const float W0_1 = S[15];
        const float W0_2 = S[16];
        const float W0_3 = S[17];
        const float W0_4 = S[18];
        const float W0_5 = S[19];
        const float W0_6 = S[20];
        const float W0_7 = S[21];
        const float W0_8 = S[22];
        const float W0_9 = S[23];
        const float W0_10 = S[24];
        const float W0_11 = S[25];
        const float W0_12 = S[26];
        const float W0_13 = S[27];
        const float W1_0 = S[28];
        const float W1_1 = S[29];
        const float W1_2 = S[30];
        const float W1_3 = S[31];
        const float W1_4 = S[32];
        const float W1_5 = S[33];
        const float W1_6 = S[34];
        const float W1_7 = S[35];
        const float W1_8 = S[36];
        const float W1_9 = S[37];
        const float W1_10 = S[38];
        const float W1_11 = S[39];
        const float W1_12 = S[40];
        const float W1_13 = S[41];
        const float W2_0 = S[42];
        const float W2_1 = S[43];
        const float W2_2 = S[44];
        const float W2_3 = S[45];
        const float W2_4 = S[46];
        const float W2_5 = S[47];
        const float W2_6 = S[48];
        const float W2_7 = S[49];
        const float W2_8 = S[50];
        const float W2_9 = S[51];
        const float W2_10 = S[52];
        const float W2_11 = S[53];
        const float W2_12 = S[54];
        const float W2_13 = S[55];
        const float W3_0 = S[56];
        const float W3_1 = S[57];
        const float W3_2 = S[58];
        const float W3_3 = S[59];
        const float W3_4 = S[60];
        const float W3_5 = S[61];
        const float W3_6 = S[62];
        const float W3_7 = S[63];
        const float W3_8 = S[64];
        const float W3_9 = S[65];
        const float W3_10 = S[66];
        const float W3_11 = S[67];
        const float W3_12 = S[68];
        const float W3_13 = S[69];
        const float W4_0 = S[70];
        const float W4_1 = S[71];
        const float W4_2 = S[72];
        const float W4_3 = S[73];
        const float W4_4 = S[74];
        const float W4_5 = S[75];
        const float W4_6 = S[76];
        const float W4_7 = S[77];
        const float W4_8 = S[78];
        const float W4_9 = S[79];
        const float W4_10 = S[80];
        const float W4_11 = S[81];
        const float W4_12 = S[82];
        const float W4_13 = S[83];
        const float W5_0 = S[84];
        const float W5_1 = S[85];
        const float W5_2 = S[86];
        const float W5_3 = S[87];
        const float W5_4 = S[88];
        const float W5_5 = S[89];
        const float W5_6 = S[90];
        const float W5_7 = S[91];
        const float W5_8 = S[92];
        const float W5_9 = S[93];
        const float W5_10 = S[94];
        const float W5_11 = S[95];
        const float W5_12 = S[96];
        const float W5_13 = S[97];
        const float W6_0 = S[98];
        const float W6_1 = S[99];
        const float W6_2 = S[100];
        const float W6_3 = S[101];
        const float W6_4 = S[102];
        const float W6_5 = S[103];
        const float W6_6 = S[104];
        const float W6_7 = S[105];
        const float W6_8 = S[106];
        const float W6_9 = S[107];
        const float W6_10 = S[108];
        const float W6_11 = S[109];
        const float W6_12 = S[110];
        const float W6_13 = S[111];
        const float W7_0 = S[112];
        const float W7_1 = S[113];
        const float W7_2 = S[114];
        const float W7_3 = S[115];
        const float W7_4 = S[116];
        const float W7_5 = S[117];
        const float W7_6 = S[118];
        const float W7_7 = S[119];
        const float W7_8 = S[120];
        const float W7_9 = S[121];
        const float W7_10 = S[122];
        const float W7_11 = S[123];
        const float W7_12 = S[124];
        const float W7_13 = S[125];
        const float W8_0 = S[126];
        const float W8_1 = S[127];
        const float W8_2 = S[128];
        const float W8_3 = S[129];
        const float W8_4 = S[130];
        const float W8_5 = S[131];
        const float W8_6 = S[132];
        const float W8_7 = S[133];
        const float W8_8 = S[134];
        const float W8_9 = S[135];
        const float W8_10 = S[136];
        const float W8_11 = S[137];
        const float W8_12 = S[138];
        const float W8_13 = S[139];
        const float W9_0 = S[140];
        const float W9_1 = S[141];
        const float W9_2 = S[142];
        const float W9_3 = S[143];
        const float W9_4 = S[144];
        const float W9_5 = S[145];
        const float W9_6 = S[146];
        const float W9_7 = S[147];
        const float W9_8 = S[148];
        const float W9_9 = S[149];
        const float W9_10 = S[150];
        const float W9_11 = S[151];
        const float W9_12 = S[152];
        const float W9_13 = S[153];
        const float W10_0 = S[154];
        const float W10_1 = S[155];
        const float W10_2 = S[156];
        const float W10_3 = S[157];
        const float W10_4 = S[158];
        const float W10_5 = S[159];
        const float W10_6 = S[160];
        const float W10_7 = S[161];
        const float W10_8 = S[162];
        const float W10_9 = S[163];
        const float W10_10 = S[164];
        const float W10_11 = S[165];
        const float W10_12 = S[166];
        const float W10_13 = S[167];
        const float W11_0 = S[168];
        const float W11_1 = S[169];
        const float W11_2 = S[170];
        const float W11_3 = S[171];
        const float W11_4 = S[172];
        const float W11_5 = S[173];
        const float W11_6 = S[174];
        const float W11_7 = S[175];
        const float W11_8 = S[176];
        const float W11_9 = S[177];
        const float W11_10 = S[178];
        const float W11_11 = S[179];
        const float W11_12 = S[180];
        const float W11_13 = S[181];
        const float W12_0 = S[182];
        const float W12_1 = S[183];
        const float W12_2 = S[184];
        const float W12_3 = S[185];
        const float W12_4 = S[186];
        const float W12_5 = S[187];
        const float W12_6 = S[188];
        const float W12_7 = S[189];
        const float W12_8 = S[190];
        const float W12_9 = S[191];
        const float W12_10 = S[192];
        const float W12_11 = S[193];
        const float W12_12 = S[194];
        const float W12_13 = S[195];
        const float W13_0 = S[196];
        const float W13_1 = S[197];
        const float W13_2 = S[198];
        const float W13_3 = S[199];
        const float W13_4 = S[200];
        const float W13_5 = S[201];
        const float W13_6 = S[202];
        const float W13_7 = S[203];
        const float W13_8 = S[204];
        const float W13_9 = S[205];
        const float W13_10 = S[206];
        const float W13_11 = S[207];
        const float W13_12 = S[208];
        const float W13_13 = S[209];
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
        const vector_f x9_bar = slope_bar[9];
        const vector_f x10_bar = slope_bar[10];
        const vector_f x11_bar = slope_bar[11];
        const vector_f x12_bar = slope_bar[12];
        const vector_f x13_bar = slope_bar[13];
        const vector_f gap_15 = -(W13_0 * x0_bar) - W13_1 * x1_bar - W13_2 * x2_bar - W13_3 * x3_bar;
        const vector_f gap_16 = gap_15 - W13_4 * x4_bar - W13_5 * x5_bar - W13_6 * x6_bar - W13_7 * x7_bar;
        const vector_f gap_17 = gap_16 - W13_8 * x8_bar - W13_9 * x9_bar - W13_10 * x10_bar - W13_11 * x11_bar;
        const vector_f gap_18 = gap_17 - W13_12 * x12_bar - W13_13 * x13_bar;
        const vector_f gap_19 = -(W0_0 * x0_bar) - W0_1 * x1_bar - W0_2 * x2_bar - W0_3 * x3_bar;
        const vector_f gap_20 = gap_19 - W0_4 * x4_bar - W0_5 * x5_bar - W0_6 * x6_bar - W0_7 * x7_bar;
        const vector_f gap_21 = gap_20 - W0_8 * x8_bar - W0_9 * x9_bar - W0_10 * x10_bar - W0_11 * x11_bar;
        const vector_f gap_22 = gap_21 - W0_12 * x12_bar - W0_13 * x13_bar;
        const vector_f gap_23 = -(W1_0 * x0_bar) - W1_1 * x1_bar - W1_2 * x2_bar - W1_3 * x3_bar;
        const vector_f gap_24 = gap_23 - W1_4 * x4_bar - W1_5 * x5_bar - W1_6 * x6_bar - W1_7 * x7_bar;
        const vector_f gap_25 = gap_24 - W1_8 * x8_bar - W1_9 * x9_bar - W1_10 * x10_bar - W1_11 * x11_bar;
        const vector_f gap_26 = gap_25 - W1_12 * x12_bar - W1_13 * x13_bar;
        const vector_f gap_27 = -(W2_0 * x0_bar) - W2_1 * x1_bar - W2_2 * x2_bar - W2_3 * x3_bar;
        const vector_f gap_28 = gap_27 - W2_4 * x4_bar - W2_5 * x5_bar - W2_6 * x6_bar - W2_7 * x7_bar;
        const vector_f gap_29 = gap_28 - W2_8 * x8_bar - W2_9 * x9_bar - W2_10 * x10_bar - W2_11 * x11_bar;
        const vector_f gap_30 = gap_29 - W2_12 * x12_bar - W2_13 * x13_bar;
        const vector_f gap_31 = -(W3_0 * x0_bar) - W3_1 * x1_bar - W3_2 * x2_bar - W3_3 * x3_bar;
        const vector_f gap_32 = gap_31 - W3_4 * x4_bar - W3_5 * x5_bar - W3_6 * x6_bar - W3_7 * x7_bar;
        const vector_f gap_33 = gap_32 - W3_8 * x8_bar - W3_9 * x9_bar - W3_10 * x10_bar - W3_11 * x11_bar;
        const vector_f gap_34 = gap_33 - W3_12 * x12_bar - W3_13 * x13_bar;
        const vector_f total_47 = its_value_bar + z0 * gap_22 + z1 * gap_26 + z2 * gap_30 + z3 * gap_34;
        const vector_f gap_35 = -(W4_0 * x0_bar) - W4_1 * x1_bar - W4_2 * x2_bar - W4_3 * x3_bar;
        const vector_f gap_36 = gap_35 - W4_4 * x4_bar - W4_5 * x5_bar - W4_6 * x6_bar - W4_7 * x7_bar;
        const vector_f gap_37 = gap_36 - W4_8 * x8_bar - W4_9 * x9_bar - W4_10 * x10_bar - W4_11 * x11_bar;
        const vector_f gap_38 = gap_37 - W4_12 * x12_bar - W4_13 * x13_bar;
        const vector_f gap_39 = -(W5_0 * x0_bar) - W5_1 * x1_bar - W5_2 * x2_bar - W5_3 * x3_bar;
        const vector_f gap_40 = gap_39 - W5_4 * x4_bar - W5_5 * x5_bar - W5_6 * x6_bar - W5_7 * x7_bar;
        const vector_f gap_41 = gap_40 - W5_8 * x8_bar - W5_9 * x9_bar - W5_10 * x10_bar - W5_11 * x11_bar;
        const vector_f gap_42 = gap_41 - W5_12 * x12_bar - W5_13 * x13_bar;
        const vector_f gap_43 = -(W6_0 * x0_bar) - W6_1 * x1_bar - W6_2 * x2_bar - W6_3 * x3_bar;
        const vector_f gap_44 = gap_43 - W6_4 * x4_bar - W6_5 * x5_bar - W6_6 * x6_bar - W6_7 * x7_bar;
        const vector_f gap_45 = gap_44 - W6_8 * x8_bar - W6_9 * x9_bar - W6_10 * x10_bar - W6_11 * x11_bar;
        const vector_f gap_46 = gap_45 - W6_12 * x12_bar - W6_13 * x13_bar;
        const vector_f gap_47 = -(W7_0 * x0_bar) - W7_1 * x1_bar - W7_2 * x2_bar - W7_3 * x3_bar;
        const vector_f gap_48 = gap_47 - W7_4 * x4_bar - W7_5 * x5_bar - W7_6 * x6_bar - W7_7 * x7_bar;
        const vector_f gap_49 = gap_48 - W7_8 * x8_bar - W7_9 * x9_bar - W7_10 * x10_bar - W7_11 * x11_bar;
        const vector_f gap_50 = gap_49 - W7_12 * x12_bar - W7_13 * x13_bar;
        const vector_f total_48 = total_47 + z4 * gap_38 + z5 * gap_42 + z6 * gap_46 + z7 * gap_50;
        const vector_f gap_51 = -(W8_0 * x0_bar) - W8_1 * x1_bar - W8_2 * x2_bar - W8_3 * x3_bar;
        const vector_f gap_52 = gap_51 - W8_4 * x4_bar - W8_5 * x5_bar - W8_6 * x6_bar - W8_7 * x7_bar;
        const vector_f gap_53 = gap_52 - W8_8 * x8_bar - W8_9 * x9_bar - W8_10 * x10_bar - W8_11 * x11_bar;
        const vector_f gap_54 = gap_53 - W8_12 * x12_bar - W8_13 * x13_bar;
        const vector_f gap_55 = -(W9_0 * x0_bar) - W9_1 * x1_bar - W9_2 * x2_bar - W9_3 * x3_bar;
        const vector_f gap_56 = gap_55 - W9_4 * x4_bar - W9_5 * x5_bar - W9_6 * x6_bar - W9_7 * x7_bar;
        const vector_f gap_57 = gap_56 - W9_8 * x8_bar - W9_9 * x9_bar - W9_10 * x10_bar - W9_11 * x11_bar;
        const vector_f gap_58 = gap_57 - W9_12 * x12_bar - W9_13 * x13_bar;
        const vector_f gap_59 = -(W10_0 * x0_bar) - W10_1 * x1_bar - W10_2 * x2_bar - W10_3 * x3_bar;
        const vector_f gap_60 = gap_59 - W10_4 * x4_bar - W10_5 * x5_bar - W10_6 * x6_bar - W10_7 * x7_bar;
        const vector_f gap_61 = gap_60 - W10_8 * x8_bar - W10_9 * x9_bar - W10_10 * x10_bar - W10_11 * x11_bar;
        const vector_f gap_62 = gap_61 - W10_12 * x12_bar - W10_13 * x13_bar;
        const vector_f gap_63 = -(W11_0 * x0_bar) - W11_1 * x1_bar - W11_2 * x2_bar - W11_3 * x3_bar;
        const vector_f gap_64 = gap_63 - W11_4 * x4_bar - W11_5 * x5_bar - W11_6 * x6_bar - W11_7 * x7_bar;
        const vector_f gap_65 = gap_64 - W11_8 * x8_bar - W11_9 * x9_bar - W11_10 * x10_bar - W11_11 * x11_bar;
        const vector_f gap_66 = gap_65 - W11_12 * x12_bar - W11_13 * x13_bar;
        const vector_f total_49 = total_48 + z8 * gap_54 + z9 * gap_58 + z10 * gap_62 + z11 * gap_66;
        const vector_f gap_67 = -(W12_0 * x0_bar) - W12_1 * x1_bar - W12_2 * x2_bar - W12_3 * x3_bar;
        const vector_f gap_68 = gap_67 - W12_4 * x4_bar - W12_5 * x5_bar - W12_6 * x6_bar - W12_7 * x7_bar;
        const vector_f gap_69 = gap_68 - W12_8 * x8_bar - W12_9 * x9_bar - W12_10 * x10_bar - W12_11 * x11_bar;
        const vector_f gap_70 = gap_69 - W12_12 * x12_bar - W12_13 * x13_bar;
        const vector_f by_phi = total_49 + z12 * gap_70 + z13 * gap_18;
        const vector_f phi_product = phi * by_phi;
        const vector_f by_z13 = phi * gap_18 - z13 * phi_product;
        const vector_f by_z12 = phi * gap_70 - z12 * phi_product;
        const vector_f by_z11 = phi * gap_66 - z11 * phi_product;
        const vector_f by_z10 = phi * gap_62 - z10 * phi_product;
        const vector_f by_z9 = phi * gap_58 - z9 * phi_product;
        const vector_f total_50 = W13_0 * by_z13 + W12_0 * by_z12 + W11_0 * by_z11 + W10_0 * by_z10 + W9_0 *
            by_z9;
        const vector_f by_z8 = phi * gap_54 - z8 * phi_product;
        const vector_f by_z7 = phi * gap_50 - z7 * phi_product;
        const vector_f by_z6 = phi * gap_46 - z6 * phi_product;
        const vector_f by_z5 = phi * gap_42 - z5 * phi_product;
        const vector_f total_51 = total_50 + W8_0 * by_z8 + W7_0 * by_z7 + W6_0 * by_z6 + W5_0 * by_z5;
        const vector_f by_z4 = phi * gap_38 - z4 * phi_product;
        const vector_f by_z3 = phi * gap_34 - z3 * phi_product;
        const vector_f by_z2 = phi * gap_30 - z2 * phi_product;
        const vector_f by_z1 = phi * gap_26 - z1 * phi_product;
        const vector_f total_52 = total_51 + W4_0 * by_z4 + W3_0 * by_z3 + W2_0 * by_z2 + W1_0 * by_z1;
        const vector_f by_z0 = phi * gap_22 - z0 * phi_product;
        const vector_f by_v0 = total_52 + W0_0 * by_z0;
        const vector_f total_53 = W13_1 * by_z13 + W12_1 * by_z12 + W11_1 * by_z11 + W10_1 * by_z10 + W9_1 *
            by_z9;
        const vector_f total_54 = total_53 + W8_1 * by_z8 + W7_1 * by_z7 + W6_1 * by_z6 + W5_1 * by_z5;
        const vector_f total_55 = total_54 + W4_1 * by_z4 + W3_1 * by_z3 + W2_1 * by_z2 + W1_1 * by_z1;
        const vector_f by_v1 = total_55 + W0_1 * by_z0;
        const vector_f total_56 = W13_2 * by_z13 + W12_2 * by_z12 + W11_2 * by_z11 + W10_2 * by_z10 + W9_2 *
            by_z9;
        const vector_f total_57 = total_56 + W8_2 * by_z8 + W7_2 * by_z7 + W6_2 * by_z6 + W5_2 * by_z5;
        const vector_f total_58 = total_57 + W4_2 * by_z4 + W3_2 * by_z3 + W2_2 * by_z2 + W1_2 * by_z1;
        const vector_f by_v2 = total_58 + W0_2 * by_z0;
        const vector_f total_59 = W13_3 * by_z13 + W12_3 * by_z12 + W11_3 * by_z11 + W10_3 * by_z10 + W9_3 *
            by_z9;
        const vector_f total_60 = total_59 + W8_3 * by_z8 + W7_3 * by_z7 + W6_3 * by_z6 + W5_3 * by_z5;
        const vector_f total_61 = total_60 + W4_3 * by_z4 + W3_3 * by_z3 + W2_3 * by_z2 + W1_3 * by_z1;
        const vector_f by_v3 = total_61 + W0_3 * by_z0;
        const vector_f total_62 = W13_4 * by_z13 + W12_4 * by_z12 + W11_4 * by_z11 + W10_4 * by_z10 + W9_4 *
            by_z9;
        const vector_f total_63 = total_62 + W8_4 * by_z8 + W7_4 * by_z7 + W6_4 * by_z6 + W5_4 * by_z5;
        const vector_f total_64 = total_63 + W4_4 * by_z4 + W3_4 * by_z3 + W2_4 * by_z2 + W1_4 * by_z1;
        const vector_f by_v4 = total_64 + W0_4 * by_z0;
        const vector_f total_65 = W13_5 * by_z13 + W12_5 * by_z12 + W11_5 * by_z11 + W10_5 * by_z10 + W9_5 *
            by_z9;
        const vector_f total_66 = total_65 + W8_5 * by_z8 + W7_5 * by_z7 + W6_5 * by_z6 + W5_5 * by_z5;
        const vector_f total_67 = total_66 + W4_5 * by_z4 + W3_5 * by_z3 + W2_5 * by_z2 + W1_5 * by_z1;
        const vector_f by_v5 = total_67 + W0_5 * by_z0;
        const vector_f total_68 = W13_6 * by_z13 + W12_6 * by_z12 + W11_6 * by_z11 + W10_6 * by_z10 + W9_6 *
            by_z9;
        const vector_f total_69 = total_68 + W8_6 * by_z8 + W7_6 * by_z7 + W6_6 * by_z6 + W5_6 * by_z5;
        const vector_f total_70 = total_69 + W4_6 * by_z4 + W3_6 * by_z3 + W2_6 * by_z2 + W1_6 * by_z1;
        const vector_f by_v6 = total_70 + W0_6 * by_z0;
        const vector_f total_71 = W13_7 * by_z13 + W12_7 * by_z12 + W11_7 * by_z11 + W10_7 * by_z10 + W9_7 *
            by_z9;
        const vector_f total_72 = total_71 + W8_7 * by_z8 + W7_7 * by_z7 + W6_7 * by_z6 + W5_7 * by_z5;
        const vector_f total_73 = total_72 + W4_7 * by_z4 + W3_7 * by_z3 + W2_7 * by_z2 + W1_7 * by_z1;
        const vector_f by_v7 = total_73 + W0_7 * by_z0;
        const vector_f total_74 = W13_8 * by_z13 + W12_8 * by_z12 + W11_8 * by_z11 + W10_8 * by_z10 + W9_8 *
            by_z9;
        const vector_f total_75 = total_74 + W8_8 * by_z8 + W7_8 * by_z7 + W6_8 * by_z6 + W5_8 * by_z5;
        const vector_f total_76 = total_75 + W4_8 * by_z4 + W3_8 * by_z3 + W2_8 * by_z2 + W1_8 * by_z1;
        const vector_f by_v8 = total_76 + W0_8 * by_z0;
        const vector_f total_77 = W13_9 * by_z13 + W12_9 * by_z12 + W11_9 * by_z11 + W10_9 * by_z10 + W9_9 *
            by_z9;
        const vector_f total_78 = total_77 + W8_9 * by_z8 + W7_9 * by_z7 + W6_9 * by_z6 + W5_9 * by_z5;
        const vector_f total_79 = total_78 + W4_9 * by_z4 + W3_9 * by_z3 + W2_9 * by_z2 + W1_9 * by_z1;
        const vector_f by_v9 = total_79 + W0_9 * by_z0;
        const vector_f total_80 = W13_10 * by_z13 + W12_10 * by_z12 + W11_10 * by_z11 + W10_10 * by_z10 + W9_10 *
            by_z9;
        const vector_f total_81 = total_80 + W8_10 * by_z8 + W7_10 * by_z7 + W6_10 * by_z6 + W5_10 * by_z5;
        const vector_f total_82 = total_81 + W4_10 * by_z4 + W3_10 * by_z3 + W2_10 * by_z2 + W1_10 * by_z1;
        const vector_f by_v10 = total_82 + W0_10 * by_z0;
        const vector_f total_83 = W13_11 * by_z13 + W12_11 * by_z12 + W11_11 * by_z11 + W10_11 * by_z10 + W9_11 *
            by_z9;
        const vector_f total_84 = total_83 + W8_11 * by_z8 + W7_11 * by_z7 + W6_11 * by_z6 + W5_11 * by_z5;
        const vector_f total_85 = total_84 + W4_11 * by_z4 + W3_11 * by_z3 + W2_11 * by_z2 + W1_11 * by_z1;
        const vector_f by_v11 = total_85 + W0_11 * by_z0;
        const vector_f total_86 = W13_12 * by_z13 + W12_12 * by_z12 + W11_12 * by_z11 + W10_12 * by_z10 + W9_12 *
            by_z9;
        const vector_f total_87 = total_86 + W8_12 * by_z8 + W7_12 * by_z7 + W6_12 * by_z6 + W5_12 * by_z5;
        const vector_f total_88 = total_87 + W4_12 * by_z4 + W3_12 * by_z3 + W2_12 * by_z2 + W1_12 * by_z1;
        const vector_f by_v12 = total_88 + W0_12 * by_z0;
        const vector_f total_89 = W13_13 * by_z13 + W12_13 * by_z12 + W11_13 * by_z11 + W10_13 * by_z10 + W9_13 *
            by_z9;
        const vector_f total_90 = total_89 + W8_13 * by_z8 + W7_13 * by_z7 + W6_13 * by_z6 + W5_13 * by_z5;
        const vector_f total_91 = total_90 + W4_13 * by_z4 + W3_13 * by_z3 + W2_13 * by_z2 + W1_13 * by_z1;
        const vector_f by_v13 = total_91 + W0_13 * by_z0;
        const vector_f z0_product = z0 * phi;
        const vector_f z1_product = z1 * phi;
        const vector_f z2_product = z2 * phi;
        const vector_f z3_product = z3 * phi;
        const vector_f z4_product = z4 * phi;
        const vector_f z5_product = z5 * phi;
        const vector_f z6_product = z6 * phi;
        const vector_f z7_product = z7 * phi;
        const vector_f z8_product = z8 * phi;
        const vector_f z9_product = z9 * phi;
        const vector_f z10_product = z10 * phi;
        const vector_f z11_product = z11 * phi;
        const vector_f z12_product = z12 * phi;
        const vector_f z13_product = z13 * phi;
        factor[0] = v0;
        factor[1] = v1;
        factor[2] = v2;
        factor[3] = v3;
        factor[4] = v4;
        factor[5] = v5;
        factor[6] = v6;
        factor[7] = v7;
        factor[8] = v8;
        factor[9] = v9;
        factor[10] = v10;
        factor[11] = v11;
        factor[12] = v12;
        factor[13] = v13;
        factor[14] = phi_product;
        factor[15] = by_z13;
        factor[16] = by_z12;
        factor[17] = by_z11;
        factor[18] = by_z10;
        factor[19] = by_z9;
        factor[20] = by_z8;
        factor[21] = by_z7;
        factor[22] = by_z6;
        factor[23] = by_z5;
        factor[24] = by_z4;
        factor[25] = by_z3;
        factor[26] = by_z2;
        factor[27] = by_z1;
        factor[28] = by_z0;
        factor[29] = -by_v0;
        factor[30] = -by_v1;
        factor[31] = -by_v2;
        factor[32] = -by_v3;
        factor[33] = -by_v4;
        factor[34] = -by_v5;
        factor[35] = -by_v6;
        factor[36] = -by_v7;
        factor[37] = -by_v8;
        factor[38] = -by_v9;
        factor[39] = -by_v10;
        factor[40] = -by_v11;
        factor[41] = -by_v12;
        factor[42] = -by_v13;
        factor[43] = z0_product;
        factor[44] = z1_product;
        factor[45] = z2_product;
        factor[46] = z3_product;
        factor[47] = z4_product;
        factor[48] = z5_product;
        factor[49] = z6_product;
        factor[50] = z7_product;
        factor[51] = z8_product;
        factor[52] = z9_product;
        factor[53] = z10_product;
        factor[54] = z11_product;
        factor[55] = z12_product;
        factor[56] = z13_product;
    }
}

/* Adds some of the sums, as products. */
INLINE void pair_products_0_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[29];
    sum[1] = sum[1] + factor[30];
    sum[2] = sum[2] + factor[31];
    sum[3] = sum[3] + factor[32];
    sum[4] = sum[4] + factor[33];
    sum[5] = sum[5] + factor[34];
    sum[6] = sum[6] + factor[35];
    sum[7] = sum[7] + factor[36];
    sum[8] = sum[8] + factor[37];
    sum[9] = sum[9] + factor[38];
    sum[10] = sum[10] + factor[39];
    sum[11] = sum[11] + factor[40];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_1_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[41];
    sum[1] = sum[1] + factor[42];
    sum[2] = sum[2] + factor[14];
    sum[3] = sum[3] + factor[0] * factor[28] - factor[43] * point[15];
    sum[4] = sum[4] + factor[1] * factor[28] - factor[43] * point[16];
    sum[5] = sum[5] + factor[2] * factor[28] - factor[43] * point[17];
    sum[6] = sum[6] + factor[3] * factor[28] - factor[43] * point[18];
    sum[7] = sum[7] + factor[4] * factor[28] - factor[43] * point[19];
    sum[8] = sum[8] + factor[5] * factor[28] - factor[43] * point[20];
    sum[9] = sum[9] + factor[6] * factor[28] - factor[43] * point[21];
    sum[10] = sum[10] + factor[7] * factor[28] - factor[43] * point[22];
    sum[11] = sum[11] + factor[8] * factor[28] - factor[43] * point[23];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_2_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[9] * factor[28] - factor[43] * point[24];
    sum[1] = sum[1] + factor[10] * factor[28] - factor[43] * point[25];
    sum[2] = sum[2] + factor[11] * factor[28] - factor[43] * point[26];
    sum[3] = sum[3] + factor[12] * factor[28] - factor[43] * point[27];
    sum[4] = sum[4] + factor[13] * factor[28] - factor[43] * point[28];
    sum[5] = sum[5] + factor[9] * factor[27] - factor[44] * point[24];
    sum[6] = sum[6] + factor[10] * factor[27] - factor[44] * point[25];
    sum[7] = sum[7] + factor[11] * factor[27] - factor[44] * point[26];
    sum[8] = sum[8] + factor[12] * factor[27] - factor[44] * point[27];
    sum[9] = sum[9] + factor[13] * factor[27] - factor[44] * point[28];
    sum[10] = sum[10] + factor[0] * factor[27] - factor[44] * point[15];
    sum[11] = sum[11] + factor[1] * factor[27] - factor[44] * point[16];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_3_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[27] - factor[44] * point[17];
    sum[1] = sum[1] + factor[3] * factor[27] - factor[44] * point[18];
    sum[2] = sum[2] + factor[4] * factor[27] - factor[44] * point[19];
    sum[3] = sum[3] + factor[5] * factor[27] - factor[44] * point[20];
    sum[4] = sum[4] + factor[6] * factor[27] - factor[44] * point[21];
    sum[5] = sum[5] + factor[7] * factor[27] - factor[44] * point[22];
    sum[6] = sum[6] + factor[8] * factor[27] - factor[44] * point[23];
    sum[7] = sum[7] + factor[2] * factor[26] - factor[45] * point[17];
    sum[8] = sum[8] + factor[3] * factor[26] - factor[45] * point[18];
    sum[9] = sum[9] + factor[4] * factor[26] - factor[45] * point[19];
    sum[10] = sum[10] + factor[5] * factor[26] - factor[45] * point[20];
    sum[11] = sum[11] + factor[6] * factor[26] - factor[45] * point[21];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_4_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[26] - factor[45] * point[15];
    sum[1] = sum[1] + factor[1] * factor[26] - factor[45] * point[16];
    sum[2] = sum[2] + factor[7] * factor[26] - factor[45] * point[22];
    sum[3] = sum[3] + factor[8] * factor[26] - factor[45] * point[23];
    sum[4] = sum[4] + factor[9] * factor[26] - factor[45] * point[24];
    sum[5] = sum[5] + factor[10] * factor[26] - factor[45] * point[25];
    sum[6] = sum[6] + factor[11] * factor[26] - factor[45] * point[26];
    sum[7] = sum[7] + factor[12] * factor[26] - factor[45] * point[27];
    sum[8] = sum[8] + factor[13] * factor[26] - factor[45] * point[28];
    sum[9] = sum[9] + factor[0] * factor[25] - factor[46] * point[15];
    sum[10] = sum[10] + factor[1] * factor[25] - factor[46] * point[16];
    sum[11] = sum[11] + factor[7] * factor[25] - factor[46] * point[22];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_5_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[25] - factor[46] * point[17];
    sum[1] = sum[1] + factor[3] * factor[25] - factor[46] * point[18];
    sum[2] = sum[2] + factor[4] * factor[25] - factor[46] * point[19];
    sum[3] = sum[3] + factor[5] * factor[25] - factor[46] * point[20];
    sum[4] = sum[4] + factor[6] * factor[25] - factor[46] * point[21];
    sum[5] = sum[5] + factor[8] * factor[25] - factor[46] * point[23];
    sum[6] = sum[6] + factor[9] * factor[25] - factor[46] * point[24];
    sum[7] = sum[7] + factor[10] * factor[25] - factor[46] * point[25];
    sum[8] = sum[8] + factor[11] * factor[25] - factor[46] * point[26];
    sum[9] = sum[9] + factor[12] * factor[25] - factor[46] * point[27];
    sum[10] = sum[10] + factor[13] * factor[25] - factor[46] * point[28];
    sum[11] = sum[11] + factor[2] * factor[24] - factor[47] * point[17];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_6_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[24] - factor[47] * point[15];
    sum[1] = sum[1] + factor[1] * factor[24] - factor[47] * point[16];
    sum[2] = sum[2] + factor[3] * factor[24] - factor[47] * point[18];
    sum[3] = sum[3] + factor[4] * factor[24] - factor[47] * point[19];
    sum[4] = sum[4] + factor[5] * factor[24] - factor[47] * point[20];
    sum[5] = sum[5] + factor[6] * factor[24] - factor[47] * point[21];
    sum[6] = sum[6] + factor[7] * factor[24] - factor[47] * point[22];
    sum[7] = sum[7] + factor[8] * factor[24] - factor[47] * point[23];
    sum[8] = sum[8] + factor[9] * factor[24] - factor[47] * point[24];
    sum[9] = sum[9] + factor[10] * factor[24] - factor[47] * point[25];
    sum[10] = sum[10] + factor[11] * factor[24] - factor[47] * point[26];
    sum[11] = sum[11] + factor[12] * factor[24] - factor[47] * point[27];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_7_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[13] * factor[24] - factor[47] * point[28];
    sum[1] = sum[1] + factor[13] * factor[23] - factor[48] * point[28];
    sum[2] = sum[2] + factor[0] * factor[23] - factor[48] * point[15];
    sum[3] = sum[3] + factor[1] * factor[23] - factor[48] * point[16];
    sum[4] = sum[4] + factor[2] * factor[23] - factor[48] * point[17];
    sum[5] = sum[5] + factor[3] * factor[23] - factor[48] * point[18];
    sum[6] = sum[6] + factor[4] * factor[23] - factor[48] * point[19];
    sum[7] = sum[7] + factor[5] * factor[23] - factor[48] * point[20];
    sum[8] = sum[8] + factor[6] * factor[23] - factor[48] * point[21];
    sum[9] = sum[9] + factor[7] * factor[23] - factor[48] * point[22];
    sum[10] = sum[10] + factor[8] * factor[23] - factor[48] * point[23];
    sum[11] = sum[11] + factor[9] * factor[23] - factor[48] * point[24];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_8_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[10] * factor[23] - factor[48] * point[25];
    sum[1] = sum[1] + factor[11] * factor[23] - factor[48] * point[26];
    sum[2] = sum[2] + factor[12] * factor[23] - factor[48] * point[27];
    sum[3] = sum[3] + factor[10] * factor[22] - factor[49] * point[25];
    sum[4] = sum[4] + factor[11] * factor[22] - factor[49] * point[26];
    sum[5] = sum[5] + factor[12] * factor[22] - factor[49] * point[27];
    sum[6] = sum[6] + factor[0] * factor[22] - factor[49] * point[15];
    sum[7] = sum[7] + factor[1] * factor[22] - factor[49] * point[16];
    sum[8] = sum[8] + factor[2] * factor[22] - factor[49] * point[17];
    sum[9] = sum[9] + factor[3] * factor[22] - factor[49] * point[18];
    sum[10] = sum[10] + factor[4] * factor[22] - factor[49] * point[19];
    sum[11] = sum[11] + factor[5] * factor[22] - factor[49] * point[20];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_9_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[6] * factor[22] - factor[49] * point[21];
    sum[1] = sum[1] + factor[7] * factor[22] - factor[49] * point[22];
    sum[2] = sum[2] + factor[8] * factor[22] - factor[49] * point[23];
    sum[3] = sum[3] + factor[9] * factor[22] - factor[49] * point[24];
    sum[4] = sum[4] + factor[13] * factor[22] - factor[49] * point[28];
    sum[5] = sum[5] + factor[6] * factor[21] - factor[50] * point[21];
    sum[6] = sum[6] + factor[7] * factor[21] - factor[50] * point[22];
    sum[7] = sum[7] + factor[8] * factor[21] - factor[50] * point[23];
    sum[8] = sum[8] + factor[9] * factor[21] - factor[50] * point[24];
    sum[9] = sum[9] + factor[13] * factor[21] - factor[50] * point[28];
    sum[10] = sum[10] + factor[0] * factor[21] - factor[50] * point[15];
    sum[11] = sum[11] + factor[1] * factor[21] - factor[50] * point[16];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_10_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[21] - factor[50] * point[17];
    sum[1] = sum[1] + factor[3] * factor[21] - factor[50] * point[18];
    sum[2] = sum[2] + factor[4] * factor[21] - factor[50] * point[19];
    sum[3] = sum[3] + factor[5] * factor[21] - factor[50] * point[20];
    sum[4] = sum[4] + factor[10] * factor[21] - factor[50] * point[25];
    sum[5] = sum[5] + factor[11] * factor[21] - factor[50] * point[26];
    sum[6] = sum[6] + factor[12] * factor[21] - factor[50] * point[27];
    sum[7] = sum[7] + factor[2] * factor[20] - factor[51] * point[17];
    sum[8] = sum[8] + factor[3] * factor[20] - factor[51] * point[18];
    sum[9] = sum[9] + factor[4] * factor[20] - factor[51] * point[19];
    sum[10] = sum[10] + factor[5] * factor[20] - factor[51] * point[20];
    sum[11] = sum[11] + factor[10] * factor[20] - factor[51] * point[25];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_11_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[20] - factor[51] * point[15];
    sum[1] = sum[1] + factor[1] * factor[20] - factor[51] * point[16];
    sum[2] = sum[2] + factor[6] * factor[20] - factor[51] * point[21];
    sum[3] = sum[3] + factor[7] * factor[20] - factor[51] * point[22];
    sum[4] = sum[4] + factor[8] * factor[20] - factor[51] * point[23];
    sum[5] = sum[5] + factor[9] * factor[20] - factor[51] * point[24];
    sum[6] = sum[6] + factor[11] * factor[20] - factor[51] * point[26];
    sum[7] = sum[7] + factor[12] * factor[20] - factor[51] * point[27];
    sum[8] = sum[8] + factor[13] * factor[20] - factor[51] * point[28];
    sum[9] = sum[9] + factor[0] * factor[19] - factor[52] * point[15];
    sum[10] = sum[10] + factor[1] * factor[19] - factor[52] * point[16];
    sum[11] = sum[11] + factor[6] * factor[19] - factor[52] * point[21];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_12_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[19] - factor[52] * point[17];
    sum[1] = sum[1] + factor[3] * factor[19] - factor[52] * point[18];
    sum[2] = sum[2] + factor[4] * factor[19] - factor[52] * point[19];
    sum[3] = sum[3] + factor[5] * factor[19] - factor[52] * point[20];
    sum[4] = sum[4] + factor[7] * factor[19] - factor[52] * point[22];
    sum[5] = sum[5] + factor[8] * factor[19] - factor[52] * point[23];
    sum[6] = sum[6] + factor[9] * factor[19] - factor[52] * point[24];
    sum[7] = sum[7] + factor[10] * factor[19] - factor[52] * point[25];
    sum[8] = sum[8] + factor[11] * factor[19] - factor[52] * point[26];
    sum[9] = sum[9] + factor[12] * factor[19] - factor[52] * point[27];
    sum[10] = sum[10] + factor[13] * factor[19] - factor[52] * point[28];
    sum[11] = sum[11] + factor[2] * factor[18] - factor[53] * point[17];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_13_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[0] * factor[18] - factor[53] * point[15];
    sum[1] = sum[1] + factor[1] * factor[18] - factor[53] * point[16];
    sum[2] = sum[2] + factor[3] * factor[18] - factor[53] * point[18];
    sum[3] = sum[3] + factor[4] * factor[18] - factor[53] * point[19];
    sum[4] = sum[4] + factor[5] * factor[18] - factor[53] * point[20];
    sum[5] = sum[5] + factor[6] * factor[18] - factor[53] * point[21];
    sum[6] = sum[6] + factor[7] * factor[18] - factor[53] * point[22];
    sum[7] = sum[7] + factor[8] * factor[18] - factor[53] * point[23];
    sum[8] = sum[8] + factor[9] * factor[18] - factor[53] * point[24];
    sum[9] = sum[9] + factor[10] * factor[18] - factor[53] * point[25];
    sum[10] = sum[10] + factor[11] * factor[18] - factor[53] * point[26];
    sum[11] = sum[11] + factor[12] * factor[18] - factor[53] * point[27];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_14_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[13] * factor[18] - factor[53] * point[28];
    sum[1] = sum[1] + factor[13] * factor[17] - factor[54] * point[28];
    sum[2] = sum[2] + factor[0] * factor[17] - factor[54] * point[15];
    sum[3] = sum[3] + factor[1] * factor[17] - factor[54] * point[16];
    sum[4] = sum[4] + factor[2] * factor[17] - factor[54] * point[17];
    sum[5] = sum[5] + factor[3] * factor[17] - factor[54] * point[18];
    sum[6] = sum[6] + factor[4] * factor[17] - factor[54] * point[19];
    sum[7] = sum[7] + factor[5] * factor[17] - factor[54] * point[20];
    sum[8] = sum[8] + factor[6] * factor[17] - factor[54] * point[21];
    sum[9] = sum[9] + factor[7] * factor[17] - factor[54] * point[22];
    sum[10] = sum[10] + factor[8] * factor[17] - factor[54] * point[23];
    sum[11] = sum[11] + factor[9] * factor[17] - factor[54] * point[24];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_15_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[10] * factor[17] - factor[54] * point[25];
    sum[1] = sum[1] + factor[11] * factor[17] - factor[54] * point[26];
    sum[2] = sum[2] + factor[12] * factor[17] - factor[54] * point[27];
    sum[3] = sum[3] + factor[10] * factor[16] - factor[55] * point[25];
    sum[4] = sum[4] + factor[11] * factor[16] - factor[55] * point[26];
    sum[5] = sum[5] + factor[12] * factor[16] - factor[55] * point[27];
    sum[6] = sum[6] + factor[0] * factor[16] - factor[55] * point[15];
    sum[7] = sum[7] + factor[1] * factor[16] - factor[55] * point[16];
    sum[8] = sum[8] + factor[2] * factor[16] - factor[55] * point[17];
    sum[9] = sum[9] + factor[3] * factor[16] - factor[55] * point[18];
    sum[10] = sum[10] + factor[4] * factor[16] - factor[55] * point[19];
    sum[11] = sum[11] + factor[5] * factor[16] - factor[55] * point[20];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_16_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[6] * factor[16] - factor[55] * point[21];
    sum[1] = sum[1] + factor[7] * factor[16] - factor[55] * point[22];
    sum[2] = sum[2] + factor[8] * factor[16] - factor[55] * point[23];
    sum[3] = sum[3] + factor[9] * factor[16] - factor[55] * point[24];
    sum[4] = sum[4] + factor[13] * factor[16] - factor[55] * point[28];
    sum[5] = sum[5] + factor[6] * factor[15] - factor[56] * point[21];
    sum[6] = sum[6] + factor[7] * factor[15] - factor[56] * point[22];
    sum[7] = sum[7] + factor[8] * factor[15] - factor[56] * point[23];
    sum[8] = sum[8] + factor[9] * factor[15] - factor[56] * point[24];
    sum[9] = sum[9] + factor[13] * factor[15] - factor[56] * point[28];
    sum[10] = sum[10] + factor[0] * factor[15] - factor[56] * point[15];
    sum[11] = sum[11] + factor[1] * factor[15] - factor[56] * point[16];
}

/* Adds some of the sums, as products. */
INLINE void pair_products_17_f(const vector_f *factor, const vector_f *point, vector_f *sum) {
    (void)factor;
    (void)point;
    sum[0] = sum[0] + factor[2] * factor[15] - factor[56] * point[17];
    sum[1] = sum[1] + factor[3] * factor[15] - factor[56] * point[18];
    sum[2] = sum[2] + factor[4] * factor[15] - factor[56] * point[19];
    sum[3] = sum[3] + factor[5] * factor[15] - factor[56] * point[20];
    sum[4] = sum[4] + factor[10] * factor[15] - factor[56] * point[25];
    sum[5] = sum[5] + factor[11] * factor[15] - factor[56] * point[26];
    sum[6] = sum[6] + factor[12] * factor[15] - factor[56] * point[27];
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
    const vector_f sum91 = sums[91];
    const vector_f sum92 = sums[92];
    const vector_f sum93 = sums[93];
    const vector_f sum94 = sums[94];
    const vector_f sum95 = sums[95];
    const vector_f sum96 = sums[96];
    const vector_f sum97 = sums[97];
    const vector_f sum98 = sums[98];
    const vector_f sum99 = sums[99];
    const vector_f sum100 = sums[100];
    const vector_f sum101 = sums[101];
    const vector_f sum102 = sums[102];
    const vector_f sum103 = sums[103];
    const vector_f sum104 = sums[104];
    const vector_f sum105 = sums[105];
    const vector_f sum106 = sums[106];
    const vector_f sum107 = sums[107];
    const vector_f sum108 = sums[108];
    const vector_f sum109 = sums[109];
    const vector_f sum110 = sums[110];
    const vector_f sum111 = sums[111];
    const vector_f sum112 = sums[112];
    const vector_f sum113 = sums[113];
    const vector_f sum114 = sums[114];
    const vector_f sum115 = sums[115];
    const vector_f sum116 = sums[116];
    const vector_f sum117 = sums[117];
    const vector_f sum118 = sums[118];
    const vector_f sum119 = sums[119];
    const vector_f sum120 = sums[120];
    const vector_f sum121 = sums[121];
    const vector_f sum122 = sums[122];
    const vector_f sum123 = sums[123];
    const vector_f sum124 = sums[124];
    const vector_f sum125 = sums[125];
    const vector_f sum126 = sums[126];
    const vector_f sum127 = sums[127];
    const vector_f sum128 = sums[128];
    const vector_f sum129 = sums[129];
    const vector_f sum130 = sums[130];
    const vector_f sum131 = sums[131];
    const vector_f sum132 = sums[132];
    const vector_f sum133 = sums[133];
    const vector_f sum134 = sums[134];
    const vector_f sum135 = sums[135];
    const vector_f sum136 = sums[136];
    const vector_f sum137 = sums[137];
    const vector_f sum138 = sums[138];
    const vector_f sum139 = sums[139];
    const vector_f sum140 = sums[140];
    const vector_f sum141 = sums[141];
    const vector_f sum142 = sums[142];
    const vector_f sum143 = sums[143];
    const vector_f sum144 = sums[144];
    const vector_f sum145 = sums[145];
    const vector_f sum146 = sums[146];
    const vector_f sum147 = sums[147];
    const vector_f sum148 = sums[148];
    const vector_f sum149 = sums[149];
    const vector_f sum150 = sums[150];
    const vector_f sum151 = sums[151];
    const vector_f sum152 = sums[152];
    const vector_f sum153 = sums[153];
    const vector_f sum154 = sums[154];
    const vector_f sum155 = sums[155];
    const vector_f sum156 = sums[156];
    const vector_f sum157 = sums[157];
    const vector_f sum158 = sums[158];
    const vector_f sum159 = sums[159];
    const vector_f sum160 = sums[160];
    const vector_f sum161 = sums[161];
    const vector_f sum162 = sums[162];
    const vector_f sum163 = sums[163];
    const vector_f sum164 = sums[164];
    const vector_f sum165 = sums[165];
    const vector_f sum166 = sums[166];
    const vector_f sum167 = sums[167];
    const vector_f sum168 = sums[168];
    const vector_f sum169 = sums[169];
    const vector_f sum170 = sums[170];
    const vector_f sum171 = sums[171];
    const vector_f sum172 = sums[172];
    const vector_f sum173 = sums[173];
    const vector_f sum174 = sums[174];
    const vector_f sum175 = sums[175];
    const vector_f sum176 = sums[176];
    const vector_f sum177 = sums[177];
    const vector_f sum178 = sums[178];
    const vector_f sum179 = sums[179];
    const vector_f sum180 = sums[180];
    const vector_f sum181 = sums[181];
    const vector_f sum182 = sums[182];
    const vector_f sum183 = sums[183];
    const vector_f sum184 = sums[184];
    const vector_f sum185 = sums[185];
    const vector_f sum186 = sums[186];
    const vector_f sum187 = sums[187];
    const vector_f sum188 = sums[188];
    const vector_f sum189 = sums[189];
    const vector_f sum190 = sums[190];
    const vector_f sum191 = sums[191];
    const vector_f sum192 = sums[192];
    const vector_f sum193 = sums[193];
    const vector_f sum194 = sums[194];
    const vector_f sum195 = sums[195];
    const vector_f sum196 = sums[196];
    const vector_f sum197 = sums[197];
    const vector_f sum198 = sums[198];
    const vector_f sum199 = sums[199];
    const vector_f sum200 = sums[200];
    const vector_f sum201 = sums[201];
    const vector_f sum202 = sums[202];
    const vector_f sum203 = sums[203];
    const vector_f sum204 = sums[204];
    const vector_f sum205 = sums[205];
    const vector_f sum206 = sums[206];
    const vector_f sum207 = sums[207];
    const vector_f sum208 = sums[208];
    const vector_f sum209 = sums[209];
    const vector_f sum210 = sums[210];
    mu_bar[0] = its_amplitude * sum0;
    mu_bar[1] = its_amplitude * sum1;
    mu_bar[2] = its_amplitude * sum2;
    mu_bar[3] = its_amplitude * sum3;
    mu_bar[4] = its_amplitude * sum4;
    mu_bar[5] = its_amplitude * sum5;
    mu_bar[6] = its_amplitude * sum6;
    mu_bar[7] = its_amplitude * sum7;
    mu_bar[8] = its_amplitude * sum8;
    mu_bar[9] = its_amplitude * sum9;
    mu_bar[10] = its_amplitude * sum10;
    mu_bar[11] = its_amplitude * sum11;
    mu_bar[12] = its_amplitude * sum12;
    mu_bar[13] = its_amplitude * sum13;
    W_bar[0] = its_amplitude * sum14;
    W_bar[1] = its_amplitude * sum15;
    W_bar[2] = its_amplitude * sum16;
    W_bar[3] = its_amplitude * sum17;
    W_bar[4] = its_amplitude * sum18;
    W_bar[5] = its_amplitude * sum19;
    W_bar[6] = its_amplitude * sum20;
    W_bar[7] = its_amplitude * sum21;
    W_bar[8] = its_amplitude * sum22;
    W_bar[9] = its_amplitude * sum23;
    W_bar[10] = its_amplitude * sum24;
    W_bar[11] = its_amplitude * sum25;
    W_bar[12] = its_amplitude * sum26;
    W_bar[13] = its_amplitude * sum27;
    W_bar[14] = its_amplitude * sum28;
    W_bar[15] = its_amplitude * sum29;
    W_bar[16] = its_amplitude * sum30;
    W_bar[17] = its_amplitude * sum31;
    W_bar[18] = its_amplitude * sum32;
    W_bar[19] = its_amplitude * sum33;
    W_bar[20] = its_amplitude * sum34;
    W_bar[21] = its_amplitude * sum35;
    W_bar[22] = its_amplitude * sum36;
    W_bar[23] = its_amplitude * sum37;
    W_bar[24] = its_amplitude * sum38;
    W_bar[25] = its_amplitude * sum39;
    W_bar[26] = its_amplitude * sum40;
    W_bar[27] = its_amplitude * sum41;
    W_bar[28] = its_amplitude * sum42;
    W_bar[29] = its_amplitude * sum43;
    W_bar[30] = its_amplitude * sum44;
    W_bar[31] = its_amplitude * sum45;
    W_bar[32] = its_amplitude * sum46;
    W_bar[33] = its_amplitude * sum47;
    W_bar[34] = its_amplitude * sum48;
    W_bar[35] = its_amplitude * sum49;
    W_bar[36] = its_amplitude * sum50;
    W_bar[37] = its_amplitude * sum51;
    W_bar[38] = its_amplitude * sum52;
    W_bar[39] = its_amplitude * sum53;
    W_bar[40] = its_amplitude * sum54;
    W_bar[41] = its_amplitude * sum55;
    W_bar[42] = its_amplitude * sum56;
    W_bar[43] = its_amplitude * sum57;
    W_bar[44] = its_amplitude * sum58;
    W_bar[45] = its_amplitude * sum59;
    W_bar[46] = its_amplitude * sum60;
    W_bar[47] = its_amplitude * sum61;
    W_bar[48] = its_amplitude * sum62;
    W_bar[49] = its_amplitude * sum63;
    W_bar[50] = its_amplitude * sum64;
    W_bar[51] = its_amplitude * sum65;
    W_bar[52] = its_amplitude * sum66;
    W_bar[53] = its_amplitude * sum67;
    W_bar[54] = its_amplitude * sum68;
    W_bar[55] = its_amplitude * sum69;
    W_bar[56] = its_amplitude * sum70;
    W_bar[57] = its_amplitude * sum71;
    W_bar[58] = its_amplitude * sum72;
    W_bar[59] = its_amplitude * sum73;
    W_bar[60] = its_amplitude * sum74;
    W_bar[61] = its_amplitude * sum75;
    W_bar[62] = its_amplitude * sum76;
    W_bar[63] = its_amplitude * sum77;
    W_bar[64] = its_amplitude * sum78;
    W_bar[65] = its_amplitude * sum79;
    W_bar[66] = its_amplitude * sum80;
    W_bar[67] = its_amplitude * sum81;
    W_bar[68] = its_amplitude * sum82;
    W_bar[69] = its_amplitude * sum83;
    W_bar[70] = its_amplitude * sum84;
    W_bar[71] = its_amplitude * sum85;
    W_bar[72] = its_amplitude * sum86;
    W_bar[73] = its_amplitude * sum87;
    W_bar[74] = its_amplitude * sum88;
    W_bar[75] = its_amplitude * sum89;
    W_bar[76] = its_amplitude * sum90;
    W_bar[77] = its_amplitude * sum91;
    W_bar[78] = its_amplitude * sum92;
    W_bar[79] = its_amplitude * sum93;
    W_bar[80] = its_amplitude * sum94;
    W_bar[81] = its_amplitude * sum95;
    W_bar[82] = its_amplitude * sum96;
    W_bar[83] = its_amplitude * sum97;
    W_bar[84] = its_amplitude * sum98;
    W_bar[85] = its_amplitude * sum99;
    W_bar[86] = its_amplitude * sum100;
    W_bar[87] = its_amplitude * sum101;
    W_bar[88] = its_amplitude * sum102;
    W_bar[89] = its_amplitude * sum103;
    W_bar[90] = its_amplitude * sum104;
    W_bar[91] = its_amplitude * sum105;
    W_bar[92] = its_amplitude * sum106;
    W_bar[93] = its_amplitude * sum107;
    W_bar[94] = its_amplitude * sum108;
    W_bar[95] = its_amplitude * sum109;
    W_bar[96] = its_amplitude * sum110;
    W_bar[97] = its_amplitude * sum111;
    W_bar[98] = its_amplitude * sum112;
    W_bar[99] = its_amplitude * sum113;
    W_bar[100] = its_amplitude * sum114;
    W_bar[101] = its_amplitude * sum115;
    W_bar[102] = its_amplitude * sum116;
    W_bar[103] = its_amplitude * sum117;
    W_bar[104] = its_amplitude * sum118;
    W_bar[105] = its_amplitude * sum119;
    W_bar[106] = its_amplitude * sum120;
    W_bar[107] = its_amplitude * sum121;
    W_bar[108] = its_amplitude * sum122;
    W_bar[109] = its_amplitude * sum123;
    W_bar[110] = its_amplitude * sum124;
    W_bar[111] = its_amplitude * sum125;
    W_bar[112] = its_amplitude * sum126;
    W_bar[113] = its_amplitude * sum127;
    W_bar[114] = its_amplitude * sum128;
    W_bar[115] = its_amplitude * sum129;
    W_bar[116] = its_amplitude * sum130;
    W_bar[117] = its_amplitude * sum131;
    W_bar[118] = its_amplitude * sum132;
    W_bar[119] = its_amplitude * sum133;
    W_bar[120] = its_amplitude * sum134;
    W_bar[121] = its_amplitude * sum135;
    W_bar[122] = its_amplitude * sum136;
    W_bar[123] = its_amplitude * sum137;
    W_bar[124] = its_amplitude * sum138;
    W_bar[125] = its_amplitude * sum139;
    W_bar[126] = its_amplitude * sum140;
    W_bar[127] = its_amplitude * sum141;
    W_bar[128] = its_amplitude * sum142;
    W_bar[129] = its_amplitude * sum143;
    W_bar[130] = its_amplitude * sum144;
    W_bar[131] = its_amplitude * sum145;
    W_bar[132] = its_amplitude * sum146;
    W_bar[133] = its_amplitude * sum147;
    W_bar[134] = its_amplitude * sum148;
    W_bar[135] = its_amplitude * sum149;
    W_bar[136] = its_amplitude * sum150;
    W_bar[137] = its_amplitude * sum151;
    W_bar[138] = its_amplitude * sum152;
    W_bar[139] = its_amplitude * sum153;
    W_bar[140] = its_amplitude * sum154;
    W_bar[141] = its_amplitude * sum155;
    W_bar[142] = its_amplitude * sum156;
    W_bar[143] = its_amplitude * sum157;
    W_bar[144] = its_amplitude * sum158;
    W_bar[145] = its_amplitude * sum159;
    W_bar[146] = its_amplitude * sum160;
    W_bar[147] = its_amplitude * sum161;
    W_bar[148] = its_amplitude * sum162;
    W_bar[149] = its_amplitude * sum163;
    W_bar[150] = its_amplitude * sum164;
    W_bar[151] = its_amplitude * sum165;
    W_bar[152] = its_amplitude * sum166;
    W_bar[153] = its_amplitude * sum167;
    W_bar[154] = its_amplitude * sum168;
    W_bar[155] = its_amplitude * sum169;
    W_bar[156] = its_amplitude * sum170;
    W_bar[157] = its_amplitude * sum171;
    W_bar[158] = its_amplitude * sum172;
    W_bar[159] = its_amplitude * sum173;
    W_bar[160] = its_amplitude * sum174;
    W_bar[161] = its_amplitude * sum175;
    W_bar[162] = its_amplitude * sum176;
    W_bar[163] = its_amplitude * sum177;
    W_bar[164] = its_amplitude * sum178;
    W_bar[165] = its_amplitude * sum179;
    W_bar[166] = its_amplitude * sum180;
    W_bar[167] = its_amplitude * sum181;
    W_bar[168] = its_amplitude * sum182;
    W_bar[169] = its_amplitude * sum183;
    W_bar[170] = its_amplitude * sum184;
    W_bar[171] = its_amplitude * sum185;
    W_bar[172] = its_amplitude * sum186;
    W_bar[173] = its_amplitude * sum187;
    W_bar[174] = its_amplitude * sum188;
    W_bar[175] = its_amplitude * sum189;
    W_bar[176] = its_amplitude * sum190;
    W_bar[177] = its_amplitude * sum191;
    W_bar[178] = its_amplitude * sum192;
    W_bar[179] = its_amplitude * sum193;
    W_bar[180] = its_amplitude * sum194;
    W_bar[181] = its_amplitude * sum195;
    W_bar[182] = its_amplitude * sum196;
    W_bar[183] = its_amplitude * sum197;
    W_bar[184] = its_amplitude * sum198;
    W_bar[185] = its_amplitude * sum199;
    W_bar[186] = its_amplitude * sum200;
    W_bar[187] = its_amplitude * sum201;
    W_bar[188] = its_amplitude * sum202;
    W_bar[189] = its_amplitude * sum203;
    W_bar[190] = its_amplitude * sum204;
    W_bar[191] = its_amplitude * sum205;
    W_bar[192] = its_amplitude * sum206;
    W_bar[193] = its_amplitude * sum207;
    W_bar[194] = its_amplitude * sum208;
    W_bar[195] = its_amplitude * sum209;
    amplitude_bar[0] = sum210;
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
    const float p9 = p[9];
    const float p10 = p[10];
    const float p11 = p[11];
    const float p12 = p[12];
    const float p13 = p[13];
    const vector_f q0 = q[0];
    const vector_f q1 = q[1];
    const vector_f q2 = q[2];
    const vector_f q3 = q[3];
    const vector_f q4 = q[4];
    const vector_f q5 = q[5];
    const vector_f q6 = q[6];
    const vector_f q7 = q[7];
    const vector_f q8 = q[8];
    const vector_f q9 = q[9];
    const vector_f q10 = q[10];
    const vector_f q11 = q[11];
    const vector_f q12 = q[12];
    const vector_f q13 = q[13];
    const vector_f gap = q0 - p0;
    const vector_f round_2 = round_each_f(0.15915494309189535f * gap);
    const vector_f arm1_log0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const vector_f gap_2 = q1 - p1;
    const vector_f round_3 = round_each_f(0.15915494309189535f * gap_2);
    const vector_f arm1_log1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const vector_f gap_3 = q2 - p2;
    const vector_f round_4 = round_each_f(0.15915494309189535f * gap_3);
    const vector_f arm1_log2 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const vector_f gap_4 = q3 - p3;
    const vector_f round_5 = round_each_f(0.15915494309189535f * gap_4);
    const vector_f arm1_log3 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const vector_f gap_5 = q4 - p4;
    const vector_f round_6 = round_each_f(0.15915494309189535f * gap_5);
    const vector_f arm1_log4 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const vector_f gap_6 = q5 - p5;
    const vector_f round_7 = round_each_f(0.15915494309189535f * gap_6);
    const vector_f arm1_log5 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const vector_f gap_7 = q6 - p6;
    const vector_f round_8 = round_each_f(0.15915494309189535f * gap_7);
    const vector_f arm1_log6 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    const vector_f gap_8 = q7 - p7;
    const vector_f round_9 = round_each_f(0.15915494309189535f * gap_8);
    const vector_f arm2_log0 = gap_8 - 6.28125f * round_9 - 0.001935307179586477f * round_9;
    const vector_f gap_9 = q8 - p8;
    const vector_f round_10 = round_each_f(0.15915494309189535f * gap_9);
    const vector_f arm2_log1 = gap_9 - 6.28125f * round_10 - 0.001935307179586477f * round_10;
    const vector_f gap_10 = q9 - p9;
    const vector_f round_11 = round_each_f(0.15915494309189535f * gap_10);
    const vector_f arm2_log2 = gap_10 - 6.28125f * round_11 - 0.001935307179586477f * round_11;
    const vector_f gap_11 = q10 - p10;
    const vector_f round_12 = round_each_f(0.15915494309189535f * gap_11);
    const vector_f arm2_log3 = gap_11 - 6.28125f * round_12 - 0.001935307179586477f * round_12;
    const vector_f gap_12 = q11 - p11;
    const vector_f round_13 = round_each_f(0.15915494309189535f * gap_12);
    const vector_f arm2_log4 = gap_12 - 6.28125f * round_13 - 0.001935307179586477f * round_13;
    const vector_f gap_13 = q12 - p12;
    const vector_f round_14 = round_each_f(0.15915494309189535f * gap_13);
    const vector_f arm2_log5 = gap_13 - 6.28125f * round_14 - 0.001935307179586477f * round_14;
    const vector_f gap_14 = q13 - p13;
    const vector_f round_15 = round_each_f(0.15915494309189535f * gap_14);
    const vector_f arm2_log6 = gap_14 - 6.28125f * round_15 - 0.001935307179586477f * round_15;
    const vector_f total_2 = arm1_log0 * arm1_log0 + arm1_log1 * arm1_log1 + arm1_log2 * arm1_log2 + arm1_log3
        * arm1_log3 + arm1_log4 * arm1_log4;
    const vector_f total_3 = total_2 + arm1_log5 * arm1_log5 + arm1_log6 * arm1_log6 + arm2_log0 * arm2_log0 +
        arm2_log1 * arm2_log1;
    const vector_f total_4 = total_3 + arm2_log2 * arm2_log2 + arm2_log3 * arm2_log3 + arm2_log4 * arm2_log4 +
        arm2_log5 * arm2_log5;
    distance[0] = sqrt_each_f(total_4 + arm2_log6 * arm2_log6);
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

/* Scratch memory: 29 vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
size_t dual_arm_splats_work_f(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES_f - 1) / LANES_f, blocks = (points + 2 - 1) / 2;
    const size_t places = 15 * ((splat_count + LANES_f - 1) / LANES_f + (blocks + LANES_f - 1) / LANES_f);
    return (points * 29 + places + 1) * LANES_f + 211 * splat_count;
}

static vector_f *work_points_f(float *work) {
    const uintptr_t size = sizeof(vector_f), start = (uintptr_t)work;
    return (vector_f *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const float *splat_at_f(const vector_f *splats, size_t k) {
    const size_t row = k / LANES_f;
    return (const float *)(splats + 15 * row) + (k - row * LANES_f);
}

static vector_f *work_reaches_f(float *work, size_t count) {
    return work_points_f(work) + (count + LANES_f - 1) / LANES_f * 29;
}

static vector_f *work_blocks_f(float *work, size_t count, size_t splat_count) {
    return work_reaches_f(work, count) + 15 * ((splat_count + LANES_f - 1) / LANES_f);
}

static float *work_constants_f(float *work, size_t count, size_t splat_count) {
    const size_t size = 2 * LANES_f, blocks = (count + size - 1) / size;
    return (float *)(work_blocks_f(work, count, splat_count) + 15 * ((blocks + LANES_f - 1) / LANES_f));
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
    vector_f *own = splats + start / LANES_f * (14 + 1);
    vector_rows_f(width, splat_count, start, 1, own + 14);
    own[14] = own[14] * 6.3739659084374996f + vector_spoilt_f(mu, 14) + vector_spoilt_f(amplitude, 1);
    for (int i = 0; i < 14; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place_f(const float *x, size_t count, size_t start, float *place) {
    const size_t size = count - start < 2 * LANES_f ? count - start : 2 * LANES_f;
    vector_f at[2][14], spoilt = ZERO;
    for (size_t b = 0; b < 2; ++b) {
        vector_rows_f(x, count, start + b * LANES_f, 14, at[b]);
        spoilt += vector_spoilt_f(at[b], 14);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const float *middle = x + 14 * (start + i * size / 8);
        float radius = 0, column[LANES_f];
        for (size_t b = 0; b < 2; ++b) {
            vector_f distance[1];
            pair_distances_f(middle, at[b], distance);
            vector_store_f(column, distance[0]);
            for (size_t lane = 0; lane < LANES_f; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[14]) {
            for (int j = 0; j < 14; ++j) place[j] = middle[j];
            place[14] = radius;
        }
    }
    place[14] = place[14] * 1.0078125f + vector_sum_f(spoilt);
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
        const vector_f *own = splats + start / LANES_f * (14 + 1);
        vector_f distance[1];
        pair_distances_f(place, own, distance);
        const vector_mask_f far = vector_far_f(distance[0], own[14], vector_of_f(place[14]));
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
        const vector_f *own = blocks + start / group * (14 + 1);
        vector_f distance[1];
        pair_distances_f(mu, own, distance);
        const vector_mask_f far = vector_far_f(distance[0], vector_of_f(*reach), own[14]);
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
    vector_f own_mu[14], own_W[196], own_amplitude[1], S[211];
    vector_rows_f(mu, splat_count, start, 14, own_mu);
    vector_rows_f(W, splat_count, start, 196, own_W);
    vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants_f(own_mu, own_W, own_amplitude, S);
    vector_to_rows_f(S, constants, splat_count, start, 211, 211);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void dual_arm_splats_f(
    size_t count, size_t splat_count, const float *DUAL_ARM_RESTRICT x, const float *DUAL_ARM_RESTRICT mu, const float *DUAL_ARM_RESTRICT W, const float *DUAL_ARM_RESTRICT amplitude, const float *DUAL_ARM_RESTRICT width,
    float *DUAL_ARM_RESTRICT value, float *DUAL_ARM_RESTRICT gradient, float *DUAL_ARM_RESTRICT work, int threads) {
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
            vector_f at[2][14], X[2 * 14], grad[14];
            vector_f value_sum[2] = {ZERO}, slope_sum[2 * 14] = {ZERO};
            float place[14 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 14, at[b]);
                pair_features_f(at[b], X + 14 * b);
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
                pair_gradient_f(at[b], slope_sum + 14 * b, grad);
                vector_to_rows_f(value_sum + b, value, count, start + b * LANES_f, 1, 1);
                vector_to_rows_f(grad, gradient, count, start + b * LANES_f, 14, 14);
            }
        }
        restore_denormals(mode);
    }
}

void dual_arm_splats_value_f(
    size_t count, size_t splat_count, const float *DUAL_ARM_RESTRICT x, const float *DUAL_ARM_RESTRICT mu, const float *DUAL_ARM_RESTRICT W, const float *DUAL_ARM_RESTRICT amplitude, const float *DUAL_ARM_RESTRICT width,
    float *DUAL_ARM_RESTRICT value, float *DUAL_ARM_RESTRICT work, int threads) {
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
            vector_f at[14], X[2 * 14], value_sum[2] = {ZERO};
            float place[14 + 1];
            uint32_t near[256];
            for (size_t b = 0; b < 2; ++b) {
                vector_rows_f(x, count, start + b * LANES_f, 14, at);
                pair_features_f(at, X + 14 * b);
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
    vector_f at[14], grad_bar[14], slope_bar[14];
    vector_rows_f(x, count, start, 14, at);
    vector_rows_f(gradient_bar, count, start, 14, grad_bar);
    vector_rows_f(value_bar, count, start, 1, point + 14);
    pair_features_f(at, point);
    pair_gradient_vjp_f(at, grad_bar, slope_bar);
    for (int i = 0; i < 14; ++i) point[14 + 1 + i] = slope_bar[i];
    vector_end_f(count, start, 14 + 1, point + 14);
}

/* Adds what makes the derivatives, of a splat at some vectors of points: their factors, then the products of these. */
INLINE void pair_backward_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *sums) {
    vector_f factor[6 * 57];
    pair_factors_f(count, points, near, S, factor);
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_0_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[0] += sum[0];
        sums[1] += sum[1];
        sums[2] += sum[2];
        sums[3] += sum[3];
        sums[4] += sum[4];
        sums[5] += sum[5];
        sums[6] += sum[6];
        sums[7] += sum[7];
        sums[8] += sum[8];
        sums[9] += sum[9];
        sums[10] += sum[10];
        sums[11] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_1_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[12] += sum[0];
        sums[13] += sum[1];
        sums[210] += sum[2];
        sums[14] += sum[3];
        sums[15] += sum[4];
        sums[16] += sum[5];
        sums[17] += sum[6];
        sums[18] += sum[7];
        sums[19] += sum[8];
        sums[20] += sum[9];
        sums[21] += sum[10];
        sums[22] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_2_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[23] += sum[0];
        sums[24] += sum[1];
        sums[25] += sum[2];
        sums[26] += sum[3];
        sums[27] += sum[4];
        sums[37] += sum[5];
        sums[38] += sum[6];
        sums[39] += sum[7];
        sums[40] += sum[8];
        sums[41] += sum[9];
        sums[28] += sum[10];
        sums[29] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_3_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[30] += sum[0];
        sums[31] += sum[1];
        sums[32] += sum[2];
        sums[33] += sum[3];
        sums[34] += sum[4];
        sums[35] += sum[5];
        sums[36] += sum[6];
        sums[44] += sum[7];
        sums[45] += sum[8];
        sums[46] += sum[9];
        sums[47] += sum[10];
        sums[48] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_4_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[42] += sum[0];
        sums[43] += sum[1];
        sums[49] += sum[2];
        sums[50] += sum[3];
        sums[51] += sum[4];
        sums[52] += sum[5];
        sums[53] += sum[6];
        sums[54] += sum[7];
        sums[55] += sum[8];
        sums[56] += sum[9];
        sums[57] += sum[10];
        sums[63] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_5_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[58] += sum[0];
        sums[59] += sum[1];
        sums[60] += sum[2];
        sums[61] += sum[3];
        sums[62] += sum[4];
        sums[64] += sum[5];
        sums[65] += sum[6];
        sums[66] += sum[7];
        sums[67] += sum[8];
        sums[68] += sum[9];
        sums[69] += sum[10];
        sums[72] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_6_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[70] += sum[0];
        sums[71] += sum[1];
        sums[73] += sum[2];
        sums[74] += sum[3];
        sums[75] += sum[4];
        sums[76] += sum[5];
        sums[77] += sum[6];
        sums[78] += sum[7];
        sums[79] += sum[8];
        sums[80] += sum[9];
        sums[81] += sum[10];
        sums[82] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_7_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[83] += sum[0];
        sums[97] += sum[1];
        sums[84] += sum[2];
        sums[85] += sum[3];
        sums[86] += sum[4];
        sums[87] += sum[5];
        sums[88] += sum[6];
        sums[89] += sum[7];
        sums[90] += sum[8];
        sums[91] += sum[9];
        sums[92] += sum[10];
        sums[93] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_8_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[94] += sum[0];
        sums[95] += sum[1];
        sums[96] += sum[2];
        sums[108] += sum[3];
        sums[109] += sum[4];
        sums[110] += sum[5];
        sums[98] += sum[6];
        sums[99] += sum[7];
        sums[100] += sum[8];
        sums[101] += sum[9];
        sums[102] += sum[10];
        sums[103] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_9_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[104] += sum[0];
        sums[105] += sum[1];
        sums[106] += sum[2];
        sums[107] += sum[3];
        sums[111] += sum[4];
        sums[118] += sum[5];
        sums[119] += sum[6];
        sums[120] += sum[7];
        sums[121] += sum[8];
        sums[125] += sum[9];
        sums[112] += sum[10];
        sums[113] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_10_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[114] += sum[0];
        sums[115] += sum[1];
        sums[116] += sum[2];
        sums[117] += sum[3];
        sums[122] += sum[4];
        sums[123] += sum[5];
        sums[124] += sum[6];
        sums[128] += sum[7];
        sums[129] += sum[8];
        sums[130] += sum[9];
        sums[131] += sum[10];
        sums[136] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_11_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[126] += sum[0];
        sums[127] += sum[1];
        sums[132] += sum[2];
        sums[133] += sum[3];
        sums[134] += sum[4];
        sums[135] += sum[5];
        sums[137] += sum[6];
        sums[138] += sum[7];
        sums[139] += sum[8];
        sums[140] += sum[9];
        sums[141] += sum[10];
        sums[146] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_12_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[142] += sum[0];
        sums[143] += sum[1];
        sums[144] += sum[2];
        sums[145] += sum[3];
        sums[147] += sum[4];
        sums[148] += sum[5];
        sums[149] += sum[6];
        sums[150] += sum[7];
        sums[151] += sum[8];
        sums[152] += sum[9];
        sums[153] += sum[10];
        sums[156] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_13_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[154] += sum[0];
        sums[155] += sum[1];
        sums[157] += sum[2];
        sums[158] += sum[3];
        sums[159] += sum[4];
        sums[160] += sum[5];
        sums[161] += sum[6];
        sums[162] += sum[7];
        sums[163] += sum[8];
        sums[164] += sum[9];
        sums[165] += sum[10];
        sums[166] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_14_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[167] += sum[0];
        sums[181] += sum[1];
        sums[168] += sum[2];
        sums[169] += sum[3];
        sums[170] += sum[4];
        sums[171] += sum[5];
        sums[172] += sum[6];
        sums[173] += sum[7];
        sums[174] += sum[8];
        sums[175] += sum[9];
        sums[176] += sum[10];
        sums[177] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_15_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[178] += sum[0];
        sums[179] += sum[1];
        sums[180] += sum[2];
        sums[192] += sum[3];
        sums[193] += sum[4];
        sums[194] += sum[5];
        sums[182] += sum[6];
        sums[183] += sum[7];
        sums[184] += sum[8];
        sums[185] += sum[9];
        sums[186] += sum[10];
        sums[187] += sum[11];
    }
    {
        vector_f sum[12] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_16_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[188] += sum[0];
        sums[189] += sum[1];
        sums[190] += sum[2];
        sums[191] += sum[3];
        sums[195] += sum[4];
        sums[202] += sum[5];
        sums[203] += sum[6];
        sums[204] += sum[7];
        sums[205] += sum[8];
        sums[209] += sum[9];
        sums[196] += sum[10];
        sums[197] += sum[11];
    }
    {
        vector_f sum[7] = {ZERO};
        for (size_t i = 0; i < count; ++i) pair_products_17_f(factor + 57 * i, points + 29 * (size_t)near[i], sum);
        sums[198] += sum[0];
        sums[199] += sum[1];
        sums[200] += sum[2];
        sums[201] += sum[3];
        sums[206] += sum[4];
        sums[207] += sum[5];
        sums[208] += sum[6];
    }
}

/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums_f(const vector_f *points, const uint32_t *near, size_t size, const float *S, float *sums) {
    vector_f sum[211] = {ZERO};
    for (size_t b = 0; b < size; b += 6)
        pair_backward_f(size - b < 6 ? size - b : 6, points, near + b, S, sum);
    for (size_t i = 0; i < 211; ++i) sums[i] += vector_sum_f(sum[i]);
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void dual_arm_splats_vjp_f(
    size_t count, size_t splat_count, const float *DUAL_ARM_RESTRICT x, const float *DUAL_ARM_RESTRICT mu, const float *DUAL_ARM_RESTRICT W, const float *DUAL_ARM_RESTRICT amplitude, const float *DUAL_ARM_RESTRICT width, const float *DUAL_ARM_RESTRICT value_bar, const float *DUAL_ARM_RESTRICT gradient_bar,
    float *DUAL_ARM_RESTRICT mu_bar, float *DUAL_ARM_RESTRICT W_bar, float *DUAL_ARM_RESTRICT amplitude_bar, float *DUAL_ARM_RESTRICT work, int threads) {
    const size_t blocks = (count + LANES_f - 1) / LANES_f;
    const size_t chunk = 131072 / (29 * sizeof(vector_f)) + 1;
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
                float place[14 + 1];
                const size_t last = (blocks - 1) / 2, start = (block < last ? block : last) * 2;
                block_place_f(x, count, start * LANES_f, place);
                for (int i = 0; i < 15; ++i) {
                    float *row = (float *)(places + block / LANES_f * 15 + i);
                    row[block - block / LANES_f * LANES_f] = place[i];
                }
            }
        }
        OMP(omp for schedule(dynamic, 8))
        for (size_t block = 0; block < blocks; ++block)
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, points + 29 * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            float sums[LANES_f][211] = {{0}};
            uint32_t near[131072 / (29 * sizeof(vector_f)) + 2];
            vector_f own_mu[14], own_W[196], own_amplitude[1], own_sums[211], bars[211];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const float *reach = width ? splat_at_f(splats, k) + 14 * LANES_f : NULL;
                    const size_t some = blocks_near_f(mu + 14 * k, reach, places, first, first + size, near);
                    splat_sums_f(points + 29 * first, near, some, constants + 211 * k, sums[k - start]);
                }
            }
            vector_rows_f(mu, end, start, 14, own_mu);
            vector_rows_f(W, end, start, 196, own_W);
            vector_rows_f(amplitude, end, start, 1, own_amplitude);
            vector_rows_f(sums[0], LANES_f, 0, 211, own_sums);
            pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 14, bars + 14 + 196);
            vector_to_rows_f(bars, mu_bar, end, start, 14, 14);
            vector_to_rows_f(bars + 14, W_bar, end, start, 196, 196);
            vector_to_rows_f(bars + 14 + 196, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void dual_arm_splats_rows_f(
    size_t count, size_t splat_count, const float *DUAL_ARM_RESTRICT x, const float *DUAL_ARM_RESTRICT mu, const float *DUAL_ARM_RESTRICT W, const float *DUAL_ARM_RESTRICT amplitude, const float *DUAL_ARM_RESTRICT value_bar, const float *DUAL_ARM_RESTRICT gradient_bar,
    float *DUAL_ARM_RESTRICT rows, float *DUAL_ARM_RESTRICT work, int threads) {
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
            vector_f point[29];
            splat_points_f(count, block * LANES_f, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector_f own_mu[14], own_W[196], own_amplitude[1], own_sums[211] = {ZERO}, bars[211];
                for (int i = 0; i < 14; ++i) own_mu[i] = vector_of_f(mu[14 * k + i]);
                for (int i = 0; i < 196; ++i) own_W[i] = vector_of_f(W[196 * k + i]);
                own_amplitude[0] = vector_of_f(amplitude[k]);
                pair_backward_f(1, point, &only, constants + 211 * k, own_sums);
                pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 14, bars + 14 + 196);
                vector_to_rows_f(bars, rows + 211 * k, count, block * LANES_f, 211, 211 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

/* A coordinate to sort by. */
INLINE float order_key_f(const float *x, size_t row, size_t axis) {
    const float key = x[14 * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest_f(const float *x, const size_t *order, size_t count) {
    float low[14], high[14];
    size_t widest = 0;
    for (size_t axis = 0; axis < 14; ++axis) low[axis] = high[axis] = order_key_f(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < 14; ++axis) {
            const float key = order_key_f(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < 14; ++axis)
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

double dual_arm_splats_order_f(
    size_t count, size_t splat_count, const float *DUAL_ARM_RESTRICT x, const float *DUAL_ARM_RESTRICT mu, const float *DUAL_ARM_RESTRICT amplitude, const float *DUAL_ARM_RESTRICT width,
    double limit, size_t *DUAL_ARM_RESTRICT order, float *DUAL_ARM_RESTRICT work) {
    const size_t block = 2 * LANES_f;
    vector_f *splats = work_reaches_f(work, 0);
    uint32_t near[256];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES_f) {
        vector_f own_mu[14], own_amplitude[1];
        vector_rows_f(mu, splat_count, start, 14, own_mu);
        vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks_f(x, order, count, (float *)work_blocks_f(work, 0, splat_count));
        for (size_t i = 1; i < 2 * 16; i += 2) {
            float rows[2 * LANES_f * 14], place[14 + 1];
            const size_t some = i * count / (2 * 16), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < 14; ++j) rows[14 * n + j] = x[14 * order[start + n] + j];
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
