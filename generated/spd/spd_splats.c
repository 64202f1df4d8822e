/*
 * spd: Symmetric positive definite n x n matrices with the affine-invariant metric trace(P^-1 dP P^-1 dP).
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "spd.h"

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

/* exp = 2^k exp(r), |r| <= log(2) / 2, within 1 unit in the last place; below 3e-308 it is 0. */
INLINE vector exp_each(vector x) {
    const vector shifted = x * 1.4426950408889634 + 6755399441055744.0, k = shifted - 6755399441055744.0;
    const vector r = (x - k * 0.6931471805601177) - k * -1.7239444525614835e-13;
    const vector part = r + r * r * (0.5000000000000001 + r * (0.16666666666666669 + r * (0.041666666666624136 + r * (0.008333333333330063 + r * (0.001388888891720967 + r * (0.00019841269863050506 + r * (2.4801521302241082e-05 + r * (2.7557268464831627e-06 + r * (2.7620085455018414e-07 + r * 2.510038319586702e-08)))))))));
    const vector scale = vector_from_bits((vector_to_bits(shifted) + 1022) << 52); /* 2^(k - 1) */
    const vector y = vector_select(x > 709.782712893384, vector_of(HUGE_VAL), (scale + scale * part) * 2);
    return vector_select(x < -707.9, vector_of(0), y);
}

/* Eigenvalues, ascending, and eigenvectors of a symmetric 1 x 1 matrix, by Jacobi's rotations. */
static void symmetric_eigh_1(const double *in, double *out) {
    double a[1][1] = {{in[0]}}, v[1][1] = {{0}}, poison = 0;
    for (int i = 0; i < 1; ++i) v[i][i] = 1;
    for (int sweep = 0; sweep < 0; ++sweep) {
        for (int p = 0; p < 1; ++p) {
            for (int q = p + 1; q < 1; ++q) {
                const double twice = 2 * a[p][q], gap = a[q][q] - a[p][p];
                if (twice == 0) continue;
                const double theta = gap / twice;
                const double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
                const double c = 1 / sqrt(t * t + 1), s = t * c, part = s / (1 + c);
                a[p][p] -= t * a[p][q];
                a[q][q] += t * a[p][q];
                a[p][q] = a[q][p] = 0;
                for (int k = 0; k < 1; ++k) {
                    const double x = v[k][p], y = v[k][q];
                    v[k][p] = x - s * (y + part * x);
                    v[k][q] = y + s * (x - part * y);
                    if (k == p || k == q) continue;
                    const double ap = a[k][p], aq = a[k][q];
                    a[k][p] = a[p][k] = ap - s * (aq + part * ap);
                    a[k][q] = a[q][k] = aq + s * (ap - part * aq);
                }
            }
        }
    }
    for (int i = 0; i < 1; ++i)
        for (int j = 0; j < 1; ++j) poison += 0 * a[i][j] + 0 * v[i][j]; /* NaN when one of them is not finite */
    for (int i = 0; i < 1; ++i) a[i][i] += poison;
    for (int i = 0; i < 1; ++i) {
        int rank = 0; /* how many come before: equal ones in their order */
        for (int j = 0; j < 1; ++j) rank += a[j][j] < a[i][i] || (j < i && !(a[j][j] > a[i][i]));
        out[rank] = a[i][i];
        for (int k = 0; k < 1; ++k) out[1 + 1 * k + rank] = v[k][i];
    }
}

/* Eigenvalues, ascending, and eigenvectors of a symmetric 2 x 2 matrix, by Jacobi's rotations. */
static void symmetric_eigh_2(const double *in, double *out) {
    double a[2][2] = {{in[0], in[1]}, {in[1], in[2]}}, v[2][2] = {{0}}, poison = 0;
    for (int i = 0; i < 2; ++i) v[i][i] = 1;
    for (int sweep = 0; sweep < 1; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 2; ++q) {
                const double twice = 2 * a[p][q], gap = a[q][q] - a[p][p];
                if (twice == 0) continue;
                const double theta = gap / twice;
                const double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
                const double c = 1 / sqrt(t * t + 1), s = t * c, part = s / (1 + c);
                a[p][p] -= t * a[p][q];
                a[q][q] += t * a[p][q];
                a[p][q] = a[q][p] = 0;
                for (int k = 0; k < 2; ++k) {
                    const double x = v[k][p], y = v[k][q];
                    v[k][p] = x - s * (y + part * x);
                    v[k][q] = y + s * (x - part * y);
                    if (k == p || k == q) continue;
                    const double ap = a[k][p], aq = a[k][q];
                    a[k][p] = a[p][k] = ap - s * (aq + part * ap);
                    a[k][q] = a[q][k] = aq + s * (ap - part * aq);
                }
            }
        }
    }
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) poison += 0 * a[i][j] + 0 * v[i][j]; /* NaN when one of them is not finite */
    for (int i = 0; i < 2; ++i) a[i][i] += poison;
    for (int i = 0; i < 2; ++i) {
        int rank = 0; /* how many come before: equal ones in their order */
        for (int j = 0; j < 2; ++j) rank += a[j][j] < a[i][i] || (j < i && !(a[j][j] > a[i][i]));
        out[rank] = a[i][i];
        for (int k = 0; k < 2; ++k) out[2 + 2 * k + rank] = v[k][i];
    }
}

static double scalar_invsqrt(double x) { return 1 / sqrt(x); }

static double slope_invsqrt(double a, double b) { return -1 / (sqrt(a) * sqrt(b) * (sqrt(a) + sqrt(b))); }

static double scale_invsqrt(double c) {
    return c;
}

/* The coefficients in t of invsqrt(c + scale(c) t). */
static void taylor_invsqrt(double c, int count, double *out) {
    out[0] = 1 / sqrt(c);
    for (int k = 1; k < count; ++k) out[k] = out[k - 1] * (0.5 - (double)k) / (double)k;
}

/* The divided difference of `order` + 1 points within a quarter of the scale of their middle. */
static double near_invsqrt(const double *x, int order, double middle) {
    const double scale = scale_invsqrt(middle);
    double coefficients[20 + 8], symmetric[20] = {1}, sum = 0;
    const int terms = x[order] == x[0] ? 1 : 20;
    taylor_invsqrt(middle, terms + order, coefficients);
    for (int i = 0; i <= order; ++i)
        for (int k = 1; k < terms; ++k) symmetric[k] += (x[i] - middle) / scale * symmetric[k - 1];
    for (int k = 0; k < terms; ++k) sum += coefficients[order + k] * symmetric[k];
    for (int i = 0; i < order; ++i) sum /= scale;
    return sum;
}

static double scalar_log(double x) { return log(x); }

static double slope_log(double a, double b) { return log(b / a) / (b - a); }

static double scale_log(double c) {
    return c;
}

/* The coefficients in t of log(c + scale(c) t). */
static void taylor_log(double c, int count, double *out) {
    out[0] = log(c);
    for (int k = 1; k < count; ++k) out[k] = (k & 1 ? 1 : -1) / (double)k;
}

/* The divided difference of `order` + 1 points within a quarter of the scale of their middle. */
static double near_log(const double *x, int order, double middle) {
    const double scale = scale_log(middle);
    double coefficients[20 + 8], symmetric[20] = {1}, sum = 0;
    const int terms = x[order] == x[0] ? 1 : 20;
    taylor_log(middle, terms + order, coefficients);
    for (int i = 0; i <= order; ++i)
        for (int k = 1; k < terms; ++k) symmetric[k] += (x[i] - middle) / scale * symmetric[k - 1];
    for (int k = 0; k < terms; ++k) sum += coefficients[order + k] * symmetric[k];
    for (int i = 0; i < order; ++i) sum /= scale;
    return sum;
}

/* sinh(sqrt x) / sqrt x = 1 + x times this, for x < 4. */
static double scalar_sinhc_rest(double x) {
    double sum = 0;
    for (int k = 11; k >= 0; --k) sum = (1 + x * sum) / (double)((2 * k + 2) * (2 * k + 3));
    return sum;
}

static double scalar_log_sinhc_sqrt(double x) { return x < 4 ? log1p(x * scalar_sinhc_rest(x)) : sqrt(x) - log(2 * sqrt(x)) + log1p(-exp(-2 * sqrt(x))); }

static double slope_log_sinhc_sqrt(double a, double b) { return (scalar_log_sinhc_sqrt(b) - scalar_log_sinhc_sqrt(a)) / (b - a); }

static double scale_log_sinhc_sqrt(double c) {
    return c + 9.8696044010893586;
}

/* The coefficients in t of log_sinhc_sqrt(c + scale(c) t). */
static void taylor_log_sinhc_sqrt(double c, int count, double *out) {
    const double scale = scale_log_sinhc_sqrt(c), large = c > 400, x = large ? 400 : c;
    double ratio[64], g[64], power = sqrt(c), log = 1;
    ratio[count + 24] = 0;
    for (int k = count + 23; k >= 0; --k)
        ratio[k] = 1 / ((double)(k + 1) * ((double)(4 * k + 6) / scale + (double)(4 * k + 8) * x / (scale * scale) * ratio[k + 1]));
    g[0] = 1;
    out[0] = scalar_log_sinhc_sqrt(c);
    for (int k = 1; k < count; ++k) {
        double sum = 0;
        g[k] = g[k - 1] * ratio[k - 1];
        for (int j = 1; j < k; ++j) sum += (double)j * out[j] * g[k - j];
        power *= (1.5 - (double)k) / (double)k * scale / c;
        log *= -scale / c;
        out[k] = large ? power + log / (double)(2 * k) : g[k] - sum / (double)k;
    }
}

/* The divided difference of `order` + 1 points within a quarter of the scale of their middle. */
static double near_log_sinhc_sqrt(const double *x, int order, double middle) {
    const double scale = scale_log_sinhc_sqrt(middle);
    double coefficients[20 + 8], symmetric[20] = {1}, sum = 0;
    const int terms = x[order] == x[0] ? 1 : 20;
    taylor_log_sinhc_sqrt(middle, terms + order, coefficients);
    for (int i = 0; i <= order; ++i)
        for (int k = 1; k < terms; ++k) symmetric[k] += (x[i] - middle) / scale * symmetric[k - 1];
    for (int k = 0; k < terms; ++k) sum += coefficients[order + k] * symmetric[k];
    for (int i = 0; i < order; ++i) sum /= scale;
    return sum;
}

static double scalar_sqrt(double x) { return sqrt(x); }

/* V^T E V of a packed matrix E. */
static void into_eigenbasis_1(const double *eigh, const double *in, double (*out)[1]) {
    const double e[1][1] = {{in[0]}}, *v = eigh + 1;
    double half[1][1] = {{0}};
    for (int i = 0; i < 1; ++i)
        for (int k = 0; k < 1; ++k)
            for (int j = 0; j < 1; ++j) half[i][j] += e[i][k] * v[1 * k + j];
    for (int i = 0; i < 1; ++i) {
        for (int j = 0; j < 1; ++j) {
            out[i][j] = 0;
            for (int k = 0; k < 1; ++k) out[i][j] += v[1 * k + i] * half[k][j];
        }
    }
}

/* V^T E V of a packed matrix E. */
static void into_eigenbasis_2(const double *eigh, const double *in, double (*out)[2]) {
    const double e[2][2] = {{in[0], in[1]}, {in[1], in[2]}}, *v = eigh + 2;
    double half[2][2] = {{0}};
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k)
            for (int j = 0; j < 2; ++j) half[i][j] += e[i][k] * v[2 * k + j];
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            out[i][j] = 0;
            for (int k = 0; k < 2; ++k) out[i][j] += v[2 * k + i] * half[k][j];
        }
    }
}

/* V A V^T, packed. */
static void out_of_eigenbasis_1(const double *eigh, const double (*in)[1], double *out) {
    const double *v = eigh + 1;
    for (int i = 0; i < 1; ++i) {
        double half[1] = {0};
        for (int k = 0; k < 1; ++k)
            for (int j = 0; j < 1; ++j) half[j] += v[1 * i + k] * in[k][j];
        for (int j = i; j < 1; ++j) {
            double sum = 0;
            for (int k = 0; k < 1; ++k) sum += half[k] * v[1 * j + k];
            *out++ = sum;
        }
    }
}

/* V A V^T, packed. */
static void out_of_eigenbasis_2(const double *eigh, const double (*in)[2], double *out) {
    const double *v = eigh + 2;
    for (int i = 0; i < 2; ++i) {
        double half[2] = {0};
        for (int k = 0; k < 2; ++k)
            for (int j = 0; j < 2; ++j) half[j] += v[2 * i + k] * in[k][j];
        for (int j = i; j < 2; ++j) {
            double sum = 0;
            for (int k = 0; k < 2; ++k) sum += half[k] * v[2 * j + k];
            *out++ = sum;
        }
    }
}

/* invsqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_invsqrt_2(const double *eigh, double *out) {
    double w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_invsqrt(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_2(eigh, (const double (*)[2])total, out);
}

/* D^1 invsqrt(A)[E] of the eigen-decomposition of A, packed. */
static void symmetric_invsqrt_2_derivative1(const double *eigh, const double *in_0, double *out) {
    double w1[2][2], total[2][2] = {{0}};
    double e0[2][2];
    into_eigenbasis_2(eigh, in_0, e0);
    for (int i0 = 0; i0 < 2; ++i0)
        for (int i1 = i0; i1 < 2; ++i1) {
            const double x[2] = {eigh[i0], eigh[i1]}, gap = eigh[i1] - eigh[i0], middle = (eigh[i0] + eigh[i1]) / 2;
            const double w = 4 * gap <= scale_invsqrt(middle) || !(gap > 0) ? near_invsqrt(x, 1, middle)
                : slope_invsqrt(eigh[i0], eigh[i1]);
            w1[i0][i1] = w1[i1][i0] = w;
        }
    for (int i0 = 0; i0 < 2; ++i0) for (int i1 = 0; i1 < 2; ++i1)
        total[i0][i1] += w1[i0][i1] * e0[i0][i1];
    out_of_eigenbasis_2(eigh, (const double (*)[2])total, out);
}

/* log(A) of the eigen-decomposition of A, packed. */
static void symmetric_log_2(const double *eigh, double *out) {
    double w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_log(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_2(eigh, (const double (*)[2])total, out);
}

/* D^1 log(A)[E] of the eigen-decomposition of A, packed. */
static void symmetric_log_2_derivative1(const double *eigh, const double *in_0, double *out) {
    double w1[2][2], total[2][2] = {{0}};
    double e0[2][2];
    into_eigenbasis_2(eigh, in_0, e0);
    for (int i0 = 0; i0 < 2; ++i0)
        for (int i1 = i0; i1 < 2; ++i1) {
            const double x[2] = {eigh[i0], eigh[i1]}, gap = eigh[i1] - eigh[i0], middle = (eigh[i0] + eigh[i1]) / 2;
            const double w = 4 * gap <= scale_log(middle) || !(gap > 0) ? near_log(x, 1, middle)
                : slope_log(eigh[i0], eigh[i1]);
            w1[i0][i1] = w1[i1][i0] = w;
        }
    for (int i0 = 0; i0 < 2; ++i0) for (int i1 = 0; i1 < 2; ++i1)
        total[i0][i1] += w1[i0][i1] * e0[i0][i1];
    out_of_eigenbasis_2(eigh, (const double (*)[2])total, out);
}

/* D^2 log(A)[E, E] of the eigen-decomposition of A, packed. */
static void symmetric_log_2_derivative2(const double *eigh, const double *in_0, const double *in_1, double *out) {
    double w1[2][2], w2[2][2][2], total[2][2] = {{0}};
    double e0[2][2], e1[2][2];
    into_eigenbasis_2(eigh, in_0, e0);
    into_eigenbasis_2(eigh, in_1, e1);
    for (int i0 = 0; i0 < 2; ++i0)
        for (int i1 = i0; i1 < 2; ++i1) {
            const double x[2] = {eigh[i0], eigh[i1]}, gap = eigh[i1] - eigh[i0], middle = (eigh[i0] + eigh[i1]) / 2;
            const double w = 4 * gap <= scale_log(middle) || !(gap > 0) ? near_log(x, 1, middle)
                : slope_log(eigh[i0], eigh[i1]);
            w1[i0][i1] = w1[i1][i0] = w;
        }
    for (int i0 = 0; i0 < 2; ++i0)
        for (int i1 = i0; i1 < 2; ++i1)
            for (int i2 = i1; i2 < 2; ++i2) {
                const double x[3] = {eigh[i0], eigh[i1], eigh[i2]}, gap = eigh[i2] - eigh[i0], middle = (eigh[i0] + eigh[i2]) / 2;
                const double w = 4 * gap <= scale_log(middle) || !(gap > 0) ? near_log(x, 2, middle)
                    : (w1[i1][i2] - w1[i0][i1]) / gap;
                w2[i0][i1][i2] = w2[i0][i2][i1] = w2[i1][i0][i2] = w2[i1][i2][i0] = w2[i2][i0][i1] = w2[i2][i1][i0] = w;
            }
    for (int i0 = 0; i0 < 2; ++i0) for (int i1 = 0; i1 < 2; ++i1) for (int i2 = 0; i2 < 2; ++i2)
        total[i0][i2] += w2[i0][i1][i2] * (e0[i0][i1] * e1[i1][i2] + e1[i0][i1] * e0[i1][i2]);
    out_of_eigenbasis_2(eigh, (const double (*)[2])total, out);
}

/* log_sinhc_sqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_log_sinhc_sqrt_1(const double *eigh, double *out) {
    double w0[1], total[1][1] = {{0}};
    for (int i0 = 0; i0 < 1; ++i0) w0[i0] = scalar_log_sinhc_sqrt(eigh[i0]);
    for (int i0 = 0; i0 < 1; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_1(eigh, (const double (*)[1])total, out);
}

/* D^1 log_sinhc_sqrt(A)[E] of the eigen-decomposition of A, packed. */
static void symmetric_log_sinhc_sqrt_1_derivative1(const double *eigh, const double *in_0, double *out) {
    double w1[1][1], total[1][1] = {{0}};
    double e0[1][1];
    into_eigenbasis_1(eigh, in_0, e0);
    for (int i0 = 0; i0 < 1; ++i0)
        for (int i1 = i0; i1 < 1; ++i1) {
            const double x[2] = {eigh[i0], eigh[i1]}, gap = eigh[i1] - eigh[i0], middle = (eigh[i0] + eigh[i1]) / 2;
            const double w = 4 * gap <= scale_log_sinhc_sqrt(middle) || !(gap > 0) ? near_log_sinhc_sqrt(x, 1, middle)
                : slope_log_sinhc_sqrt(eigh[i0], eigh[i1]);
            w1[i0][i1] = w1[i1][i0] = w;
        }
    for (int i0 = 0; i0 < 1; ++i0) for (int i1 = 0; i1 < 1; ++i1)
        total[i0][i1] += w1[i0][i1] * e0[i0][i1];
    out_of_eigenbasis_1(eigh, (const double (*)[1])total, out);
}

/* D^2 log_sinhc_sqrt(A)[E, E] of the eigen-decomposition of A, packed. */
static void symmetric_log_sinhc_sqrt_1_derivative2(const double *eigh, const double *in_0, const double *in_1, double *out) {
    double w1[1][1], w2[1][1][1], total[1][1] = {{0}};
    double e0[1][1], e1[1][1];
    into_eigenbasis_1(eigh, in_0, e0);
    into_eigenbasis_1(eigh, in_1, e1);
    for (int i0 = 0; i0 < 1; ++i0)
        for (int i1 = i0; i1 < 1; ++i1) {
            const double x[2] = {eigh[i0], eigh[i1]}, gap = eigh[i1] - eigh[i0], middle = (eigh[i0] + eigh[i1]) / 2;
            const double w = 4 * gap <= scale_log_sinhc_sqrt(middle) || !(gap > 0) ? near_log_sinhc_sqrt(x, 1, middle)
                : slope_log_sinhc_sqrt(eigh[i0], eigh[i1]);
            w1[i0][i1] = w1[i1][i0] = w;
        }
    for (int i0 = 0; i0 < 1; ++i0)
        for (int i1 = i0; i1 < 1; ++i1)
            for (int i2 = i1; i2 < 1; ++i2) {
                const double x[3] = {eigh[i0], eigh[i1], eigh[i2]}, gap = eigh[i2] - eigh[i0], middle = (eigh[i0] + eigh[i2]) / 2;
                const double w = 4 * gap <= scale_log_sinhc_sqrt(middle) || !(gap > 0) ? near_log_sinhc_sqrt(x, 2, middle)
                    : (w1[i1][i2] - w1[i0][i1]) / gap;
                w2[i0][i1][i2] = w2[i0][i2][i1] = w2[i1][i0][i2] = w2[i1][i2][i0] = w2[i2][i0][i1] = w2[i2][i1][i0] = w;
            }
    for (int i0 = 0; i0 < 1; ++i0) for (int i1 = 0; i1 < 1; ++i1) for (int i2 = 0; i2 < 1; ++i2)
        total[i0][i2] += w2[i0][i1][i2] * (e0[i0][i1] * e1[i1][i2] + e1[i0][i1] * e0[i1][i2]);
    out_of_eigenbasis_1(eigh, (const double (*)[1])total, out);
}

/* sqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_sqrt_2(const double *eigh, double *out) {
    double w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_sqrt(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_2(eigh, (const double (*)[2])total, out);
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
    const vector p_0_1 = 0.5 * mu1 + 0.5 * mu2;
    vector p_0_1_eigh[6];
    {
        const vector given_lanes[3] = {mu0, p_0_1, mu3};
        for (size_t lane = 0; lane < LANES; ++lane) {
            double given[3];
            for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
            double found[6];
            {
                const double in_0[3] = {given[0], given[1], given[2]};
                symmetric_eigh_2(in_0, found);
            }
            for (int i = 0; i < 6; ++i) LANE(p_0_1_eigh[i], lane) = found[i];
        }
    }
    vector invsqrtm[3];
    {
        for (size_t lane = 0; lane < LANES; ++lane) {
            double whole[6];
            for (int i = 0; i < 6; ++i) whole[i] = LANE(p_0_1_eigh[i], lane);
            double found[3];
            symmetric_invsqrt_2(whole, found);
            for (int i = 0; i < 3; ++i) LANE(invsqrtm[i], lane) = found[i];
        }
    }
    const vector r0_0 = invsqrtm[0];
    const vector r0_1 = invsqrtm[1];
    const vector r1_1 = invsqrtm[2];
    const vector M0_0 = W0_0 * W0_0 + W1_0 * W1_0 + W2_0 * W2_0;
    const vector M0_1 = W0_0 * W0_1 + W1_0 * W1_1 + W2_0 * W2_1;
    const vector M0_2 = W0_0 * W0_2 + W1_0 * W1_2 + W2_0 * W2_2;
    const vector M1_1 = W0_1 * W0_1 + W1_1 * W1_1 + W2_1 * W2_1;
    const vector M1_2 = W0_1 * W0_2 + W1_1 * W1_2 + W2_1 * W2_2;
    const vector M2_2 = W0_2 * W0_2 + W1_2 * W1_2 + W2_2 * W2_2;
    S[0] = W0_0;
    S[1] = W0_1;
    S[2] = W0_2;
    S[3] = W1_0;
    S[4] = W1_1;
    S[5] = W1_2;
    S[6] = W2_0;
    S[7] = W2_1;
    S[8] = W2_2;
    S[9] = its_amplitude;
    S[10] = r0_0;
    S[11] = r0_1;
    S[12] = r1_1;
    S[13] = 0.5 * r0_0;
    S[14] = 0.5 * r0_1;
    S[15] = 0.5 * r1_1;
    S[16] = M0_0;
    S[17] = M0_1;
    S[18] = M0_2;
    S[19] = M1_1;
    S[20] = M1_2;
    S[21] = M2_2;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_value(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values) {
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 22 * near[k];
        const double W0_0 = S[0];
        const double W0_1 = S[1];
        const double W0_2 = S[2];
        const double W1_0 = S[3];
        const double W1_1 = S[4];
        const double W1_2 = S[5];
        const double W2_0 = S[6];
        const double W2_1 = S[7];
        const double W2_2 = S[8];
        const double amplitude = S[9];
        const double r0_0 = S[10];
        const double r0_1 = S[11];
        const double r1_1 = S[12];
        const double mul_of_one = S[13];
        const double mul_of_one_2 = S[14];
        const double mul_of_one_3 = S[15];
        for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 4 * b;
            vector *value = values + b;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector total_2 = x0 * r0_0 + x2 * r0_1;
            const vector total_3 = x1 * r0_0 + x3 * r0_1;
            const vector entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
            const vector total_4 = x0 * r0_1 + x2 * r1_1;
            const vector total_5 = x1 * r0_1 + x3 * r1_1;
            const vector entry_0_1 = mul_of_one * total_4 + total_2 * mul_of_one_2 + mul_of_one_2 * total_5 + total_3
                * mul_of_one_3;
            const vector entry_1_1 = r0_1 * total_4 + r1_1 * total_5;
            vector entry_0_0_eigh[6];
            {
                const vector given_lanes[3] = {entry_0_0, entry_0_1, entry_1_1};
                for (size_t lane = 0; lane < LANES; ++lane) {
                    double given[3];
                    for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                    double found[6];
                    {
                        const double in_0[3] = {given[0], given[1], given[2]};
                        symmetric_eigh_2(in_0, found);
                    }
                    for (int i = 0; i < 6; ++i) LANE(entry_0_0_eigh[i], lane) = found[i];
                }
            }
            vector logm[3];
            {
                for (size_t lane = 0; lane < LANES; ++lane) {
                    double whole[6];
                    for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                    double found[3];
                    symmetric_log_2(whole, found);
                    for (int i = 0; i < 3; ++i) LANE(logm[i], lane) = found[i];
                }
            }
            const vector L0_1 = logm[1];
            const vector L0_0 = logm[0];
            const vector L1_1 = logm[2];
            const vector L0_0_gap = L0_0 - L1_1;
            const vector entry_0_0_2 = L0_1 * L0_1 + 0.25 * (L0_0_gap * L0_0_gap);
            vector entry_0_0_2_eigh[2];
            {
                const vector given_lanes[1] = {entry_0_0_2};
                for (size_t lane = 0; lane < LANES; ++lane) {
                    double given[1];
                    for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                    double found[2];
                    {
                        const double in_0[1] = {given[0]};
                        symmetric_eigh_1(in_0, found);
                    }
                    for (int i = 0; i < 2; ++i) LANE(entry_0_0_2_eigh[i], lane) = found[i];
                }
            }
            vector log_sinhc_sqrtm[1];
            {
                for (size_t lane = 0; lane < LANES; ++lane) {
                    double whole[2];
                    for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                    double found[1];
                    symmetric_log_sinhc_sqrt_1(whole, found);
                    for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm[i], lane) = found[i];
                }
            }
            const vector log_sinhc_sqrtm_value0_0 = log_sinhc_sqrtm[0];
            const vector v1 = 1.4142135623730951 * L0_1;
            const vector z0 = W0_0 * L0_0 + W0_1 * v1 + W0_2 * L1_1;
            const vector z1 = W1_0 * L0_0 + W1_1 * v1 + W1_2 * L1_1;
            const vector z2 = W2_0 * L0_0 + W2_1 * v1 + W2_2 * L1_1;
            const vector gap = -log_sinhc_sqrtm_value0_0 - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
            const vector phi = exp_each(gap);
            value[0] = value[0] + amplitude * phi;
        }
    }
}

/*
 * Adds the values phi of some splats at 2 vectors of points, and slope = d phi / d X.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_forward(
    size_t count, const vector *points, const double *splats, const uint32_t *near, vector *values, vector *slopes) {
    for (size_t k = 0; k < count; ++k) {
        const double *S = splats + 22 * near[k];
        const double W0_0 = S[0];
        const double W0_1 = S[1];
        const double W0_2 = S[2];
        const double W1_0 = S[3];
        const double W1_1 = S[4];
        const double W1_2 = S[5];
        const double W2_0 = S[6];
        const double W2_1 = S[7];
        const double W2_2 = S[8];
        const double amplitude = S[9];
        const double r0_0 = S[10];
        const double r0_1 = S[11];
        const double r1_1 = S[12];
        const double mul_of_one = S[13];
        const double mul_of_one_2 = S[14];
        const double mul_of_one_3 = S[15];
        for (size_t b = 0; b < 2; ++b) {
            const vector *X = points + 4 * b;
            vector *value = values + b;
            vector *slope = slopes + 4 * b;
            const vector x0 = X[0];
            const vector x1 = X[1];
            const vector x2 = X[2];
            const vector x3 = X[3];
            const vector total_2 = x0 * r0_0 + x2 * r0_1;
            const vector total_3 = x1 * r0_0 + x3 * r0_1;
            const vector entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
            const vector total_4 = x0 * r0_1 + x2 * r1_1;
            const vector total_5 = x1 * r0_1 + x3 * r1_1;
            const vector entry_0_1 = mul_of_one * total_4 + total_2 * mul_of_one_2 + mul_of_one_2 * total_5 + total_3
                * mul_of_one_3;
            const vector entry_1_1 = r0_1 * total_4 + r1_1 * total_5;
            vector entry_0_0_eigh[6];
            {
                const vector given_lanes[3] = {entry_0_0, entry_0_1, entry_1_1};
                for (size_t lane = 0; lane < LANES; ++lane) {
                    double given[3];
                    for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                    double found[6];
                    {
                        const double in_0[3] = {given[0], given[1], given[2]};
                        symmetric_eigh_2(in_0, found);
                    }
                    for (int i = 0; i < 6; ++i) LANE(entry_0_0_eigh[i], lane) = found[i];
                }
            }
            vector logm[3];
            {
                for (size_t lane = 0; lane < LANES; ++lane) {
                    double whole[6];
                    for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                    double found[3];
                    symmetric_log_2(whole, found);
                    for (int i = 0; i < 3; ++i) LANE(logm[i], lane) = found[i];
                }
            }
            const vector L0_1 = logm[1];
            const vector L0_0 = logm[0];
            const vector L1_1 = logm[2];
            const vector L0_0_gap = L0_0 - L1_1;
            const vector entry_0_0_2 = L0_1 * L0_1 + 0.25 * (L0_0_gap * L0_0_gap);
            vector entry_0_0_2_eigh[2];
            {
                const vector given_lanes[1] = {entry_0_0_2};
                for (size_t lane = 0; lane < LANES; ++lane) {
                    double given[1];
                    for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                    double found[2];
                    {
                        const double in_0[1] = {given[0]};
                        symmetric_eigh_1(in_0, found);
                    }
                    for (int i = 0; i < 2; ++i) LANE(entry_0_0_2_eigh[i], lane) = found[i];
                }
            }
            vector log_sinhc_sqrtm[1];
            {
                for (size_t lane = 0; lane < LANES; ++lane) {
                    double whole[2];
                    for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                    double found[1];
                    symmetric_log_sinhc_sqrt_1(whole, found);
                    for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm[i], lane) = found[i];
                }
            }
            const vector log_sinhc_sqrtm_value0_0 = log_sinhc_sqrtm[0];
            const vector v1 = 1.4142135623730951 * L0_1;
            const vector z0 = W0_0 * L0_0 + W0_1 * v1 + W0_2 * L1_1;
            const vector z1 = W1_0 * L0_0 + W1_1 * v1 + W1_2 * L1_1;
            const vector z2 = W2_0 * L0_0 + W2_1 * v1 + W2_2 * L1_1;
            const vector gap = -log_sinhc_sqrtm_value0_0 - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
            const vector phi = exp_each(gap);
            const vector phi_2 = amplitude * phi;
            vector log_sinhc_sqrtm_slope[1];
            {
                const vector given_lanes[1] = {-phi_2};
                for (size_t lane = 0; lane < LANES; ++lane) {
                    double given[1];
                    for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                    double whole[2];
                    for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                    double found[1];
                    {
                        const double in_0[1] = {given[0]};
                        symmetric_log_sinhc_sqrt_1_derivative1(whole, in_0, found);
                    }
                    for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm_slope[i], lane) = found[i];
                }
            }
            const vector by_entry_0_0_2 = log_sinhc_sqrtm_slope[0];
            const vector product = L0_0_gap * (0.5 * by_entry_0_0_2);
            const vector gap_2 = product - phi_2 * (W2_0 * z2 + (W1_0 * z1 + W0_0 * z0));
            const vector product_2 = 1.4142135623730951 * (phi_2 * (W2_1 * z2 + (W1_1 * z1 + W0_1 * z0)));
            const vector minus = -(phi_2 * (W2_2 * z2 + (W1_2 * z1 + W0_2 * z0)));
            vector logm_slope[3];
            {
                const vector given_lanes[3] = {gap_2, 0.5 * (L0_1 * (2.0 * by_entry_0_0_2) - product_2), minus - product};
                for (size_t lane = 0; lane < LANES; ++lane) {
                    double given[3];
                    for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                    double whole[6];
                    for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                    double found[3];
                    {
                        const double in_0[3] = {given[0], given[1], given[2]};
                        symmetric_log_2_derivative1(whole, in_0, found);
                    }
                    for (int i = 0; i < 3; ++i) LANE(logm_slope[i], lane) = found[i];
                }
            }
            const vector by_entry_1_1 = logm_slope[2];
            const vector by_entry_0_1 = 2.0 * logm_slope[1];
            const vector total_6 = r0_1 * by_entry_1_1 + mul_of_one * by_entry_0_1;
            const vector product_3 = mul_of_one_2 * by_entry_0_1;
            const vector by_entry_0_0 = logm_slope[0];
            const vector total_7 = product_3 + r0_0 * by_entry_0_0;
            const vector total_8 = r1_1 * by_entry_1_1 + product_3;
            const vector total_9 = mul_of_one_3 * by_entry_0_1 + r0_1 * by_entry_0_0;
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] + r0_1 * total_6 + r0_0 * total_7;
            slope[1] = slope[1] + r0_1 * total_8 + r0_0 * total_9;
            slope[2] = slope[2] + r1_1 * total_6 + r0_1 * total_7;
            slope[3] = slope[3] + r1_1 * total_8 + r0_1 * total_9;
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
    const vector p_0_1 = 0.5 * x1 + 0.5 * x2;
    vector p_0_1_eigh[6];
    {
        const vector given_lanes[3] = {x0, p_0_1, x3};
        for (size_t lane = 0; lane < LANES; ++lane) {
            double given[3];
            for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
            double found[6];
            {
                const double in_0[3] = {given[0], given[1], given[2]};
                symmetric_eigh_2(in_0, found);
            }
            for (int i = 0; i < 6; ++i) LANE(p_0_1_eigh[i], lane) = found[i];
        }
    }
    vector sqrtm[3];
    {
        for (size_t lane = 0; lane < LANES; ++lane) {
            double whole[6];
            for (int i = 0; i < 6; ++i) whole[i] = LANE(p_0_1_eigh[i], lane);
            double found[3];
            symmetric_sqrt_2(whole, found);
            for (int i = 0; i < 3; ++i) LANE(sqrtm[i], lane) = found[i];
        }
    }
    const vector sqrtm_p0_0 = sqrtm[0];
    const vector sqrtm_p0_1 = sqrtm[1];
    const vector sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
    const vector total_2 = slope_x0 * (sqrtm_p0_0 * sqrtm_p0_0) + slope_x3 * sqrtm_p0_1_squared + sqrtm_p0_1 *
        (slope_x1 * sqrtm_p0_0) + sqrtm_p0_1 * (slope_x2 * sqrtm_p0_0);
    const vector sqrtm_p1_1 = sqrtm[2];
    const vector total_3 = 0.7071067811865476 * sqrtm_p0_1_squared + 1.4142135623730951 * (sqrtm_p1_1 * (0.5 *
        sqrtm_p0_0));
    const vector total_4 = slope_x1 * total_3 + slope_x2 * total_3 + 1.4142135623730951 * (sqrtm_p0_1 *
        (slope_x0 * sqrtm_p0_0)) + 1.4142135623730951 * (sqrtm_p1_1 * (slope_x3 * sqrtm_p0_1));
    const vector total_5 = slope_x0 * sqrtm_p0_1_squared + slope_x3 * (sqrtm_p1_1 * sqrtm_p1_1) + sqrtm_p1_1 *
        (slope_x1 * sqrtm_p0_1) + sqrtm_p1_1 * (slope_x2 * sqrtm_p0_1);
    gradient[0] = total_2;
    gradient[1] = total_4;
    gradient[2] = total_5;
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
    const vector p_0_1 = 0.5 * x1 + 0.5 * x2;
    vector p_0_1_eigh[6];
    {
        const vector given_lanes[3] = {x0, p_0_1, x3};
        for (size_t lane = 0; lane < LANES; ++lane) {
            double given[3];
            for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
            double found[6];
            {
                const double in_0[3] = {given[0], given[1], given[2]};
                symmetric_eigh_2(in_0, found);
            }
            for (int i = 0; i < 6; ++i) LANE(p_0_1_eigh[i], lane) = found[i];
        }
    }
    vector sqrtm[3];
    {
        for (size_t lane = 0; lane < LANES; ++lane) {
            double whole[6];
            for (int i = 0; i < 6; ++i) whole[i] = LANE(p_0_1_eigh[i], lane);
            double found[3];
            symmetric_sqrt_2(whole, found);
            for (int i = 0; i < 3; ++i) LANE(sqrtm[i], lane) = found[i];
        }
    }
    const vector sqrtm_p0_1 = sqrtm[1];
    const vector sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
    const vector sqrtm_p0_0 = sqrtm[0];
    const vector product = 1.4142135623730951 * gradient_bar1;
    const vector sqrtm_p1_1 = sqrtm[2];
    const vector product_2 = (0.7071067811865476 * sqrtm_p0_1_squared + 1.4142135623730951 * (sqrtm_p1_1 *
        (0.5 * sqrtm_p0_0))) * gradient_bar1;
    const vector total_2 = sqrtm_p0_1 * (sqrtm_p1_1 * gradient_bar2) + product_2 + sqrtm_p0_0 * (sqrtm_p0_1 *
        gradient_bar0);
    slope_bar[0] = sqrtm_p0_1_squared * gradient_bar2 + sqrtm_p0_0 * (sqrtm_p0_1 * product) + sqrtm_p0_0 *
            sqrtm_p0_0 * gradient_bar0;
    slope_bar[1] = total_2;
    slope_bar[2] = total_2;
    slope_bar[3] = sqrtm_p1_1 * sqrtm_p1_1 * gradient_bar2 + sqrtm_p0_1 * (sqrtm_p1_1 * product) +
            sqrtm_p0_1_squared * gradient_bar0;
}

/*
 * Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
OUTLINE void pair_backward(
    size_t count, const vector *points, const uint32_t *near, const double *S, vector *sums) {
    for (size_t i = 0; i < count; ++i) {
        const vector *X = points + 9 * (size_t)near[i];
        const vector *value_bar = points + 9 * (size_t)near[i] + 4;
        const vector *slope_bar = points + 9 * (size_t)near[i] + 4 + 1;
        const vector x0 = X[0];
        const vector x1 = X[1];
        const vector x2 = X[2];
        const vector x3 = X[3];
        const double W0_0 = S[0];
        const double W0_1 = S[1];
        const double W0_2 = S[2];
        const double W1_0 = S[3];
        const double W1_1 = S[4];
        const double W1_2 = S[5];
        const double W2_0 = S[6];
        const double W2_1 = S[7];
        const double W2_2 = S[8];
        const double r0_0 = S[10];
        const double r0_1 = S[11];
        const double r1_1 = S[12];
        const double mul_of_one = S[13];
        const double mul_of_one_2 = S[14];
        const double mul_of_one_3 = S[15];
        const double M0_0 = S[16];
        const double M0_1 = S[17];
        const double M0_2 = S[18];
        const double M1_1 = S[19];
        const double M1_2 = S[20];
        const double M2_2 = S[21];
        const vector its_value_bar = value_bar[0];
        const vector x0_bar = slope_bar[0];
        const vector x1_bar = slope_bar[1];
        const vector x2_bar = slope_bar[2];
        const vector x3_bar = slope_bar[3];
        const vector total_2 = x0 * r0_0 + x2 * r0_1;
        const vector total_3 = x1 * r0_0 + x3 * r0_1;
        const vector entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
        const vector total_4 = x0 * r0_1 + x2 * r1_1;
        const vector total_5 = x1 * r0_1 + x3 * r1_1;
        const vector entry_0_1 = mul_of_one * total_4 + total_2 * mul_of_one_2 + mul_of_one_2 * total_5 + total_3
            * mul_of_one_3;
        const vector entry_1_1 = r0_1 * total_4 + r1_1 * total_5;
        vector entry_0_0_eigh[6];
        {
            const vector given_lanes[3] = {entry_0_0, entry_0_1, entry_1_1};
            for (size_t lane = 0; lane < LANES; ++lane) {
                double given[3];
                for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                double found[6];
                {
                    const double in_0[3] = {given[0], given[1], given[2]};
                    symmetric_eigh_2(in_0, found);
                }
                for (int i = 0; i < 6; ++i) LANE(entry_0_0_eigh[i], lane) = found[i];
            }
        }
        vector logm[3];
        {
            for (size_t lane = 0; lane < LANES; ++lane) {
                double whole[6];
                for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                double found[3];
                symmetric_log_2(whole, found);
                for (int i = 0; i < 3; ++i) LANE(logm[i], lane) = found[i];
            }
        }
        const vector L0_1 = logm[1];
        const vector L0_0 = logm[0];
        const vector L1_1 = logm[2];
        const vector L0_0_gap = L0_0 - L1_1;
        const vector entry_0_0_2 = L0_1 * L0_1 + 0.25 * (L0_0_gap * L0_0_gap);
        vector entry_0_0_2_eigh[2];
        {
            const vector given_lanes[1] = {entry_0_0_2};
            for (size_t lane = 0; lane < LANES; ++lane) {
                double given[1];
                for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                double found[2];
                {
                    const double in_0[1] = {given[0]};
                    symmetric_eigh_1(in_0, found);
                }
                for (int i = 0; i < 2; ++i) LANE(entry_0_0_2_eigh[i], lane) = found[i];
            }
        }
        vector log_sinhc_sqrtm[1];
        {
            for (size_t lane = 0; lane < LANES; ++lane) {
                double whole[2];
                for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                double found[1];
                symmetric_log_sinhc_sqrt_1(whole, found);
                for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm[i], lane) = found[i];
            }
        }
        const vector log_sinhc_sqrtm_value0_0 = log_sinhc_sqrtm[0];
        const vector v1 = 1.4142135623730951 * L0_1;
        const vector z0 = W0_0 * L0_0 + W0_1 * v1 + W0_2 * L1_1;
        const vector z1 = W1_0 * L0_0 + W1_1 * v1 + W1_2 * L1_1;
        const vector z2 = W2_0 * L0_0 + W2_1 * v1 + W2_2 * L1_1;
        const vector gap = -log_sinhc_sqrtm_value0_0 - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
        const vector phi = exp_each(gap);
        const vector total_6 = W2_2 * z2 + (W1_2 * z1 + W0_2 * z0);
        const vector total_7 = r0_0 * x0_bar + r0_1 * x2_bar;
        const vector total_8 = r0_0 * x1_bar + r0_1 * x3_bar;
        const vector total_9 = r0_0 * total_7 + r0_1 * total_8;
        const vector total_10 = r0_1 * x0_bar + r1_1 * x2_bar;
        const vector total_11 = r0_1 * x1_bar + r1_1 * x3_bar;
        const vector total_12 = total_7 + total_11;
        const vector by_by_entry_0_1 = mul_of_one * total_10 + mul_of_one_2 * total_12 + mul_of_one_3 * total_8;
        const vector total_13 = r0_1 * total_10 + r1_1 * total_11;
        vector logm_slope[3];
        {
            const vector given_lanes[3] = {total_9, by_by_entry_0_1, total_13};
            for (size_t lane = 0; lane < LANES; ++lane) {
                double given[3];
                for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                double whole[6];
                for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                double found[3];
                {
                    const double in_0[3] = {given[0], given[1], given[2]};
                    symmetric_log_2_derivative1(whole, in_0, found);
                }
                for (int i = 0; i < 3; ++i) LANE(logm_slope[i], lane) = found[i];
            }
        }
        const vector total_14 = W2_1 * z2 + (W1_1 * z1 + W0_1 * z0);
        const vector product = 1.4142135623730951 * logm_slope[1];
        const vector total_15 = W2_0 * z2 + (W1_0 * z1 + W0_0 * z0);
        const vector gap_2 = logm_slope[0] - logm_slope[2];
        const vector total_16 = 2.0 * (L0_1 * logm_slope[1]) + 0.5 * (L0_0_gap * gap_2);
        vector log_sinhc_sqrtm_slope[1];
        {
            const vector given_lanes[1] = {total_16};
            for (size_t lane = 0; lane < LANES; ++lane) {
                double given[1];
                for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                double whole[2];
                for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                double found[1];
                {
                    const double in_0[1] = {given[0]};
                    symmetric_log_sinhc_sqrt_1_derivative1(whole, in_0, found);
                }
                for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm_slope[i], lane) = found[i];
            }
        }
        const vector by_phi = its_value_bar - total_6 * logm_slope[2] - total_14 * product - total_15 *
            logm_slope[0] - log_sinhc_sqrtm_slope[0];
        const vector phi_product = phi * by_phi;
        const vector phi_minus = -phi;
        vector log_sinhc_sqrtm_slope_2[1];
        {
            const vector given_lanes[1] = {phi_minus};
            for (size_t lane = 0; lane < LANES; ++lane) {
                double given[1];
                for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                double whole[2];
                for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                double found[1];
                {
                    const double in_0[1] = {given[0]};
                    symmetric_log_sinhc_sqrt_1_derivative1(whole, in_0, found);
                }
                for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm_slope_2[i], lane) = found[i];
            }
        }
        const vector by_entry_0_0_2 = log_sinhc_sqrtm_slope_2[0];
        const vector product_2 = 0.5 * by_entry_0_0_2;
        const vector product_3 = L0_0_gap * product_2;
        const vector gap_3 = product_3 - phi * total_15;
        const vector product_4 = 2.0 * by_entry_0_0_2;
        const vector product_5 = 0.5 * (L0_1 * product_4 - 1.4142135623730951 * (phi * total_14));
        const vector gap_4 = -(phi * total_6) - product_3;
        vector logm_slope_2[3];
        {
            const vector given_lanes[3] = {gap_3, product_5, gap_4};
            for (size_t lane = 0; lane < LANES; ++lane) {
                double given[3];
                for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                double whole[6];
                for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                double found[3];
                {
                    const double in_0[3] = {given[0], given[1], given[2]};
                    symmetric_log_2_derivative1(whole, in_0, found);
                }
                for (int i = 0; i < 3; ++i) LANE(logm_slope_2[i], lane) = found[i];
            }
        }
        const vector by_entry_0_1 = 2.0 * logm_slope_2[1];
        const vector product_6 = mul_of_one_2 * by_entry_0_1;
        const vector by_entry_0_0 = logm_slope_2[0];
        const vector total_17 = product_6 + r0_0 * by_entry_0_0;
        const vector total_18 = mul_of_one_3 * by_entry_0_1 + r0_1 * by_entry_0_0;
        vector logm_derivative2[3];
        {
            const vector given_lanes[6] = {gap_3, product_5, gap_4, total_9, by_by_entry_0_1, total_13};
            for (size_t lane = 0; lane < LANES; ++lane) {
                double given[6];
                for (int i = 0; i < 6; ++i) given[i] = LANE(given_lanes[i], lane);
                double whole[6];
                for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                double found[3];
                {
                    const double in_0[3] = {given[0], given[1], given[2]};
                    const double in_1[3] = {given[3], given[4], given[5]};
                    symmetric_log_2_derivative2(whole, in_0, in_1, found);
                }
                for (int i = 0; i < 3; ++i) LANE(logm_derivative2[i], lane) = found[i];
            }
        }
        const vector phi_product_2 = phi * logm_slope[0];
        const vector phi_product_3 = phi * product;
        const vector phi_product_4 = phi * logm_slope[2];
        const vector gap_5 = -(M0_0 * phi_product_2) - M0_1 * phi_product_3 - M0_2 * phi_product_4 - total_15 *
            phi_product;
        vector log_sinhc_sqrtm_derivative2[1];
        {
            const vector given_lanes[2] = {phi_minus, total_16};
            for (size_t lane = 0; lane < LANES; ++lane) {
                double given[2];
                for (int i = 0; i < 2; ++i) given[i] = LANE(given_lanes[i], lane);
                double whole[2];
                for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                double found[1];
                {
                    const double in_0[1] = {given[0]};
                    const double in_1[1] = {given[1]};
                    symmetric_log_sinhc_sqrt_1_derivative2(whole, in_0, in_1, found);
                }
                for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm_derivative2[i], lane) = found[i];
            }
        }
        vector log_sinhc_sqrtm_slope_3[1];
        {
            const vector given_lanes[1] = {-phi_product};
            for (size_t lane = 0; lane < LANES; ++lane) {
                double given[1];
                for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                double whole[2];
                for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                double found[1];
                {
                    const double in_0[1] = {given[0]};
                    symmetric_log_sinhc_sqrt_1_derivative1(whole, in_0, found);
                }
                for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm_slope_3[i], lane) = found[i];
            }
        }
        const vector by_entry_0_0_2_2 = log_sinhc_sqrtm_derivative2[0] + log_sinhc_sqrtm_slope_3[0];
        const vector total_19 = product_2 * gap_2 + L0_0_gap * (0.5 * by_entry_0_0_2_2);
        const vector by_v1 = -(M0_1 * phi_product_2) - M1_1 * phi_product_3 - M1_2 * phi_product_4 - total_14 *
            phi_product;
        const vector gap_6 = -(M0_2 * phi_product_2) - M1_2 * phi_product_3 - M2_2 * phi_product_4 - total_6 *
            phi_product;
        vector logm_slope_3[3];
        {
            const vector given_lanes[3] = {gap_5 + total_19, 0.5 * (product_4 * logm_slope[1] + 1.4142135623730951 * by_v1 + L0_1 * (2.0 * by_entry_0_0_2_2)), gap_6 - total_19};
            for (size_t lane = 0; lane < LANES; ++lane) {
                double given[3];
                for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                double whole[6];
                for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                double found[3];
                {
                    const double in_0[3] = {given[0], given[1], given[2]};
                    symmetric_log_2_derivative1(whole, in_0, found);
                }
                for (int i = 0; i < 3; ++i) LANE(logm_slope_3[i], lane) = found[i];
            }
        }
        const vector by_entry_0_1_2 = 2.0 * logm_derivative2[1] + 2.0 * logm_slope_3[1];
        const vector by_entry_0_0_3 = logm_derivative2[0] + logm_slope_3[0];
        const vector total_20 = mul_of_one_3 * by_entry_0_1_2 + r0_1 * by_entry_0_0_3;
        const vector product_7 = mul_of_one_2 * by_entry_0_1_2;
        const vector total_22 = product_7 + r0_0 * by_entry_0_0_3;
        const vector by_entry_1_1 = logm_slope_2[2];
        const vector total_23 = r0_1 * by_entry_1_1 + mul_of_one * by_entry_0_1;
        const vector total_24 = r1_1 * by_entry_1_1 + product_6;
        const vector by_entry_1_1_2 = logm_derivative2[2] + logm_slope_3[2];
        const vector total_26 = r1_1 * by_entry_1_1_2 + product_7;
        const vector total_27 = r0_1 * by_entry_1_1_2 + mul_of_one * by_entry_0_1_2;
        const vector product_8 = 0.5 * phi_product;
        const vector gap_7 = -phi_product_2 - L0_0 * product_8;
        const vector gap_8 = -phi_product_3 - v1 * product_8;
        const vector gap_9 = -phi_product_4 - L1_1 * product_8;
        sums[0] = sums[0] + phi_product;
        sums[1] = sums[1] + total_17 * x0_bar + by_entry_0_0 * total_7 + total_18 * x1_bar + x1 * total_20 +
                total_2 * by_entry_0_0_3 + x0 * total_22;
        sums[2] = sums[2] + total_17 * x2_bar + total_18 * x3_bar + by_entry_0_0 * total_8 + total_23 * x0_bar +
                total_24 * x1_bar + by_entry_1_1 * total_10 + total_4 * by_entry_1_1_2 + x1 * total_26 + x0 * total_27
                + total_3 * by_entry_0_0_3 + x3 * total_20 + x2 * total_22;
        sums[3] = sums[3] + total_23 * x2_bar + total_24 * x3_bar + by_entry_1_1 * total_11 + total_5 *
                by_entry_1_1_2 + x3 * total_26 + x2 * total_27;
        sums[4] = sums[4] + by_entry_0_1 * total_10 + total_4 * by_entry_0_1_2;
        sums[5] = sums[5] + by_entry_0_1 * total_12 + total_5 * by_entry_0_1_2 + total_2 * by_entry_0_1_2;
        sums[6] = sums[6] + by_entry_0_1 * total_8 + total_3 * by_entry_0_1_2;
        sums[7] = sums[7] + L0_0 * gap_7;
        sums[8] = sums[8] + L0_0 * gap_8 + v1 * gap_7;
        sums[9] = sums[9] + L0_0 * gap_9 + L1_1 * gap_7;
        sums[10] = sums[10] + v1 * gap_8;
        sums[11] = sums[11] + v1 * gap_9 + L1_1 * gap_8;
        sums[12] = sums[12] + L1_1 * gap_9;
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
    const vector p_0_1 = 0.5 * mu1 + 0.5 * mu2;
    vector p_0_1_eigh[6];
    {
        const vector given_lanes[3] = {mu0, p_0_1, mu3};
        for (size_t lane = 0; lane < LANES; ++lane) {
            double given[3];
            for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
            double found[6];
            {
                const double in_0[3] = {given[0], given[1], given[2]};
                symmetric_eigh_2(in_0, found);
            }
            for (int i = 0; i < 6; ++i) LANE(p_0_1_eigh[i], lane) = found[i];
        }
    }
    vector invsqrtm_slope[3];
    {
        const vector given_lanes[3] = {sum1 + 0.5 * sum4, 0.5 * (sum2 + 0.5 * sum5), sum3 + 0.5 * sum6};
        for (size_t lane = 0; lane < LANES; ++lane) {
            double given[3];
            for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
            double whole[6];
            for (int i = 0; i < 6; ++i) whole[i] = LANE(p_0_1_eigh[i], lane);
            double found[3];
            {
                const double in_0[3] = {given[0], given[1], given[2]};
                symmetric_invsqrt_2_derivative1(whole, in_0, found);
            }
            for (int i = 0; i < 3; ++i) LANE(invsqrtm_slope[i], lane) = found[i];
        }
    }
    const vector product = its_amplitude * invsqrtm_slope[1];
    const vector product_2 = 2.0 * sum7;
    const vector product_3 = 2.0 * sum10;
    const vector product_4 = 2.0 * sum12;
    mu_bar[0] = its_amplitude * invsqrtm_slope[0];
    mu_bar[1] = product;
    mu_bar[2] = product;
    mu_bar[3] = its_amplitude * invsqrtm_slope[2];
    W_bar[0] = its_amplitude * (W0_0 * product_2 + W0_1 * sum8 + W0_2 * sum9);
    W_bar[1] = its_amplitude * (W0_0 * sum8 + W0_1 * product_3 + W0_2 * sum11);
    W_bar[2] = its_amplitude * (W0_0 * sum9 + W0_1 * sum11 + W0_2 * product_4);
    W_bar[3] = its_amplitude * (W1_0 * product_2 + W1_1 * sum8 + W1_2 * sum9);
    W_bar[4] = its_amplitude * (W1_0 * sum8 + W1_1 * product_3 + W1_2 * sum11);
    W_bar[5] = its_amplitude * (W1_0 * sum9 + W1_1 * sum11 + W1_2 * product_4);
    W_bar[6] = its_amplitude * (W2_0 * product_2 + W2_1 * sum8 + W2_2 * sum9);
    W_bar[7] = its_amplitude * (W2_0 * sum8 + W2_1 * product_3 + W2_2 * sum11);
    W_bar[8] = its_amplitude * (W2_0 * sum9 + W2_1 * sum11 + W2_2 * product_4);
    amplitude_bar[0] = sum0;
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
size_t spd_splats_work(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES - 1) / LANES, blocks = (points + 2 - 1) / 2;
    const size_t places = 0 * ((splat_count + LANES - 1) / LANES + (blocks + LANES - 1) / LANES);
    return (points * 9 + places + 1) * LANES + 22 * splat_count;
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
    return work_points(work) + (count + LANES - 1) / LANES * 9;
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
    vector own_mu[4], own_W[9], own_amplitude[1], S[22];
    vector_rows(mu, splat_count, start, 4, own_mu);
    vector_rows(W, splat_count, start, 9, own_W);
    vector_rows(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants(own_mu, own_W, own_amplitude, S);
    vector_to_rows(S, constants, splat_count, start, 22, 22);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void spd_splats(
    size_t count, size_t splat_count, const double *SPD_RESTRICT x, const double *SPD_RESTRICT mu, const double *SPD_RESTRICT W, const double *SPD_RESTRICT amplitude, const double *SPD_RESTRICT width,
    double *SPD_RESTRICT value, double *SPD_RESTRICT gradient, double *SPD_RESTRICT work, int threads) {
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

void spd_splats_value(
    size_t count, size_t splat_count, const double *SPD_RESTRICT x, const double *SPD_RESTRICT mu, const double *SPD_RESTRICT W, const double *SPD_RESTRICT amplitude, const double *SPD_RESTRICT width,
    double *SPD_RESTRICT value, double *SPD_RESTRICT work, int threads) {
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
    vector sum[13] = {ZERO};
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
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void spd_splats_vjp(
    size_t count, size_t splat_count, const double *SPD_RESTRICT x, const double *SPD_RESTRICT mu, const double *SPD_RESTRICT W, const double *SPD_RESTRICT amplitude, const double *SPD_RESTRICT width, const double *SPD_RESTRICT value_bar, const double *SPD_RESTRICT gradient_bar,
    double *SPD_RESTRICT mu_bar, double *SPD_RESTRICT W_bar, double *SPD_RESTRICT amplitude_bar, double *SPD_RESTRICT work, int threads) {
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
                for (int i = 0; i < 0; ++i) {
                    double *row = (double *)(places + block / LANES * 0 + i);
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
            double sums[LANES][13] = {{0}};
            uint32_t near[131072 / (9 * sizeof(vector)) + 2];
            vector own_mu[4], own_W[9], own_amplitude[1], own_sums[13], bars[14];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const double *reach = width ? splat_at(splats, k) + 4 * LANES : NULL;
                    const size_t some = blocks_near(mu + 4 * k, reach, places, first, first + size, near);
                    splat_sums(points + 9 * first, near, some, constants + 22 * k, sums[k - start]);
                }
            }
            vector_rows(mu, end, start, 4, own_mu);
            vector_rows(W, end, start, 9, own_W);
            vector_rows(amplitude, end, start, 1, own_amplitude);
            vector_rows(sums[0], LANES, 0, 13, own_sums);
            pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 4, bars + 4 + 9);
            vector_to_rows(bars, mu_bar, end, start, 4, 4);
            vector_to_rows(bars + 4, W_bar, end, start, 9, 9);
            vector_to_rows(bars + 4 + 9, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void spd_splats_rows(
    size_t count, size_t splat_count, const double *SPD_RESTRICT x, const double *SPD_RESTRICT mu, const double *SPD_RESTRICT W, const double *SPD_RESTRICT amplitude, const double *SPD_RESTRICT value_bar, const double *SPD_RESTRICT gradient_bar,
    double *SPD_RESTRICT rows, double *SPD_RESTRICT work, int threads) {
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
                vector own_mu[4], own_W[9], own_amplitude[1], own_sums[13] = {ZERO}, bars[14];
                for (int i = 0; i < 4; ++i) own_mu[i] = vector_of(mu[4 * k + i]);
                for (int i = 0; i < 9; ++i) own_W[i] = vector_of(W[9 * k + i]);
                own_amplitude[0] = vector_of(amplitude[k]);
                pair_backward(1, point, &only, constants + 22 * k, own_sums);
                pair_constants_vjp(own_mu, own_W, own_amplitude, own_sums, bars, bars + 4, bars + 4 + 9);
                vector_to_rows(bars, rows + 14 * k, count, block * LANES, 14, 14 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

double spd_splats_order(
    size_t count, size_t splat_count, const double *SPD_RESTRICT x, const double *SPD_RESTRICT mu, const double *SPD_RESTRICT amplitude, const double *SPD_RESTRICT width,
    double limit, size_t *SPD_RESTRICT order, double *SPD_RESTRICT work) {
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

/* exp = 2^k exp(r), |r| <= log(2) / 2, within 1 unit in the last place; below 1.6e-38 it is 0. */
INLINE vector_f exp_each_f(vector_f x) {
    const vector_f shifted = x * 1.4426950408889634f + 12582912.0f, k = shifted - 12582912.0f;
    const vector_f r = (x - k * 0.693145751953125f) - k * 1.4286068203094173e-06f;
    const vector_f part = r + r * r * (0.5f + r * (0.16666576998242924f + r * (0.041666554627878084f + r * (0.008363177629994445f + r * 0.0013926181810489343f))));
    const vector_f scale = vector_from_bits_f((vector_to_bits_f(shifted) + 126) << 23); /* 2^(k - 1) */
    const vector_f y = vector_select_f(x > 88.722839f, vector_of_f(HUGE_VALF), (scale + scale * part) * 2);
    return vector_select_f(x < -86.9f, vector_of_f(0), y);
}

/* Eigenvalues, ascending, and eigenvectors of a symmetric 1 x 1 matrix, by Jacobi's rotations. */
static void symmetric_eigh_1_f(const float *in, float *out) {
    float a[1][1] = {{in[0]}}, v[1][1] = {{0}}, poison = 0;
    for (int i = 0; i < 1; ++i) v[i][i] = 1;
    for (int sweep = 0; sweep < 0; ++sweep) {
        for (int p = 0; p < 1; ++p) {
            for (int q = p + 1; q < 1; ++q) {
                const float twice = 2 * a[p][q], gap = a[q][q] - a[p][p];
                if (twice == 0) continue;
                const float theta = gap / twice;
                const float t = (theta < 0 ? -1 : 1) / (fabsf(theta) + sqrtf(theta * theta + 1));
                const float c = 1 / sqrtf(t * t + 1), s = t * c, part = s / (1 + c);
                a[p][p] -= t * a[p][q];
                a[q][q] += t * a[p][q];
                a[p][q] = a[q][p] = 0;
                for (int k = 0; k < 1; ++k) {
                    const float x = v[k][p], y = v[k][q];
                    v[k][p] = x - s * (y + part * x);
                    v[k][q] = y + s * (x - part * y);
                    if (k == p || k == q) continue;
                    const float ap = a[k][p], aq = a[k][q];
                    a[k][p] = a[p][k] = ap - s * (aq + part * ap);
                    a[k][q] = a[q][k] = aq + s * (ap - part * aq);
                }
            }
        }
    }
    for (int i = 0; i < 1; ++i)
        for (int j = 0; j < 1; ++j) poison += 0 * a[i][j] + 0 * v[i][j]; /* NaN when one of them is not finite */
    for (int i = 0; i < 1; ++i) a[i][i] += poison;
    for (int i = 0; i < 1; ++i) {
        int rank = 0; /* how many come before: equal ones in their order */
        for (int j = 0; j < 1; ++j) rank += a[j][j] < a[i][i] || (j < i && !(a[j][j] > a[i][i]));
        out[rank] = a[i][i];
        for (int k = 0; k < 1; ++k) out[1 + 1 * k + rank] = v[k][i];
    }
}

/* Eigenvalues, ascending, and eigenvectors of a symmetric 2 x 2 matrix, by Jacobi's rotations. */
static void symmetric_eigh_2_f(const float *in, float *out) {
    float a[2][2] = {{in[0], in[1]}, {in[1], in[2]}}, v[2][2] = {{0}}, poison = 0;
    for (int i = 0; i < 2; ++i) v[i][i] = 1;
    for (int sweep = 0; sweep < 1; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 2; ++q) {
                const float twice = 2 * a[p][q], gap = a[q][q] - a[p][p];
                if (twice == 0) continue;
                const float theta = gap / twice;
                const float t = (theta < 0 ? -1 : 1) / (fabsf(theta) + sqrtf(theta * theta + 1));
                const float c = 1 / sqrtf(t * t + 1), s = t * c, part = s / (1 + c);
                a[p][p] -= t * a[p][q];
                a[q][q] += t * a[p][q];
                a[p][q] = a[q][p] = 0;
                for (int k = 0; k < 2; ++k) {
                    const float x = v[k][p], y = v[k][q];
                    v[k][p] = x - s * (y + part * x);
                    v[k][q] = y + s * (x - part * y);
                    if (k == p || k == q) continue;
                    const float ap = a[k][p], aq = a[k][q];
                    a[k][p] = a[p][k] = ap - s * (aq + part * ap);
                    a[k][q] = a[q][k] = aq + s * (ap - part * aq);
                }
            }
        }
    }
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) poison += 0 * a[i][j] + 0 * v[i][j]; /* NaN when one of them is not finite */
    for (int i = 0; i < 2; ++i) a[i][i] += poison;
    for (int i = 0; i < 2; ++i) {
        int rank = 0; /* how many come before: equal ones in their order */
        for (int j = 0; j < 2; ++j) rank += a[j][j] < a[i][i] || (j < i && !(a[j][j] > a[i][i]));
        out[rank] = a[i][i];
        for (int k = 0; k < 2; ++k) out[2 + 2 * k + rank] = v[k][i];
    }
}

static float scalar_invsqrt_f(float x) { return 1 / sqrtf(x); }

static float slope_invsqrt_f(float a, float b) { return -1 / (sqrtf(a) * sqrtf(b) * (sqrtf(a) + sqrtf(b))); }

static float scale_invsqrt_f(float c) {
    return c;
}

/* The coefficients in t of invsqrt(c + scale(c) t). */
static void taylor_invsqrt_f(float c, int count, float *out) {
    out[0] = 1 / sqrtf(c);
    for (int k = 1; k < count; ++k) out[k] = out[k - 1] * (0.5f - (float)k) / (float)k;
}

/* The divided difference of `order` + 1 points within a quarter of the scale of their middle. */
static float near_invsqrt_f(const float *x, int order, float middle) {
    const float scale = scale_invsqrt_f(middle);
    float coefficients[20 + 8], symmetric[20] = {1}, sum = 0;
    const int terms = x[order] == x[0] ? 1 : 20;
    taylor_invsqrt_f(middle, terms + order, coefficients);
    for (int i = 0; i <= order; ++i)
        for (int k = 1; k < terms; ++k) symmetric[k] += (x[i] - middle) / scale * symmetric[k - 1];
    for (int k = 0; k < terms; ++k) sum += coefficients[order + k] * symmetric[k];
    for (int i = 0; i < order; ++i) sum /= scale;
    return sum;
}

static float scalar_log_f(float x) { return logf(x); }

static float slope_log_f(float a, float b) { return logf(b / a) / (b - a); }

static float scale_log_f(float c) {
    return c;
}

/* The coefficients in t of log(c + scale(c) t). */
static void taylor_log_f(float c, int count, float *out) {
    out[0] = logf(c);
    for (int k = 1; k < count; ++k) out[k] = (k & 1 ? 1 : -1) / (float)k;
}

/* The divided difference of `order` + 1 points within a quarter of the scale of their middle. */
static float near_log_f(const float *x, int order, float middle) {
    const float scale = scale_log_f(middle);
    float coefficients[20 + 8], symmetric[20] = {1}, sum = 0;
    const int terms = x[order] == x[0] ? 1 : 20;
    taylor_log_f(middle, terms + order, coefficients);
    for (int i = 0; i <= order; ++i)
        for (int k = 1; k < terms; ++k) symmetric[k] += (x[i] - middle) / scale * symmetric[k - 1];
    for (int k = 0; k < terms; ++k) sum += coefficients[order + k] * symmetric[k];
    for (int i = 0; i < order; ++i) sum /= scale;
    return sum;
}

/* sinh(sqrt x) / sqrt x = 1 + x times this, for x < 4. */
static float scalar_sinhc_rest_f(float x) {
    float sum = 0;
    for (int k = 11; k >= 0; --k) sum = (1 + x * sum) / (float)((2 * k + 2) * (2 * k + 3));
    return sum;
}

static float scalar_log_sinhc_sqrt_f(float x) { return x < 4 ? log1pf(x * scalar_sinhc_rest_f(x)) : sqrtf(x) - logf(2 * sqrtf(x)) + log1pf(-expf(-2 * sqrtf(x))); }

static float slope_log_sinhc_sqrt_f(float a, float b) { return (scalar_log_sinhc_sqrt_f(b) - scalar_log_sinhc_sqrt_f(a)) / (b - a); }

static float scale_log_sinhc_sqrt_f(float c) {
    return c + 9.8696044010893586f;
}

/* The coefficients in t of log_sinhc_sqrt(c + scale(c) t). */
static void taylor_log_sinhc_sqrt_f(float c, int count, float *out) {
    const float scale = scale_log_sinhc_sqrt_f(c), large = c > 400, x = large ? 400 : c;
    float ratio[64], g[64], power = sqrtf(c), log = 1;
    ratio[count + 24] = 0;
    for (int k = count + 23; k >= 0; --k)
        ratio[k] = 1 / ((float)(k + 1) * ((float)(4 * k + 6) / scale + (float)(4 * k + 8) * x / (scale * scale) * ratio[k + 1]));
    g[0] = 1;
    out[0] = scalar_log_sinhc_sqrt_f(c);
    for (int k = 1; k < count; ++k) {
        float sum = 0;
        g[k] = g[k - 1] * ratio[k - 1];
        for (int j = 1; j < k; ++j) sum += (float)j * out[j] * g[k - j];
        power *= (1.5f - (float)k) / (float)k * scale / c;
        log *= -scale / c;
        out[k] = large ? power + log / (float)(2 * k) : g[k] - sum / (float)k;
    }
}

/* The divided difference of `order` + 1 points within a quarter of the scale of their middle. */
static float near_log_sinhc_sqrt_f(const float *x, int order, float middle) {
    const float scale = scale_log_sinhc_sqrt_f(middle);
    float coefficients[20 + 8], symmetric[20] = {1}, sum = 0;
    const int terms = x[order] == x[0] ? 1 : 20;
    taylor_log_sinhc_sqrt_f(middle, terms + order, coefficients);
    for (int i = 0; i <= order; ++i)
        for (int k = 1; k < terms; ++k) symmetric[k] += (x[i] - middle) / scale * symmetric[k - 1];
    for (int k = 0; k < terms; ++k) sum += coefficients[order + k] * symmetric[k];
    for (int i = 0; i < order; ++i) sum /= scale;
    return sum;
}

static float scalar_sqrt_f(float x) { return sqrtf(x); }

/* V^T E V of a packed matrix E. */
static void into_eigenbasis_1_f(const float *eigh, const float *in, float (*out)[1]) {
    const float e[1][1] = {{in[0]}}, *v = eigh + 1;
    float half[1][1] = {{0}};
    for (int i = 0; i < 1; ++i)
        for (int k = 0; k < 1; ++k)
            for (int j = 0; j < 1; ++j) half[i][j] += e[i][k] * v[1 * k + j];
    for (int i = 0; i < 1; ++i) {
        for (int j = 0; j < 1; ++j) {
            out[i][j] = 0;
            for (int k = 0; k < 1; ++k) out[i][j] += v[1 * k + i] * half[k][j];
        }
    }
}

/* V^T E V of a packed matrix E. */
static void into_eigenbasis_2_f(const float *eigh, const float *in, float (*out)[2]) {
    const float e[2][2] = {{in[0], in[1]}, {in[1], in[2]}}, *v = eigh + 2;
    float half[2][2] = {{0}};
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k)
            for (int j = 0; j < 2; ++j) half[i][j] += e[i][k] * v[2 * k + j];
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            out[i][j] = 0;
            for (int k = 0; k < 2; ++k) out[i][j] += v[2 * k + i] * half[k][j];
        }
    }
}

/* V A V^T, packed. */
static void out_of_eigenbasis_1_f(const float *eigh, const float (*in)[1], float *out) {
    const float *v = eigh + 1;
    for (int i = 0; i < 1; ++i) {
        float half[1] = {0};
        for (int k = 0; k < 1; ++k)
            for (int j = 0; j < 1; ++j) half[j] += v[1 * i + k] * in[k][j];
        for (int j = i; j < 1; ++j) {
            float sum = 0;
            for (int k = 0; k < 1; ++k) sum += half[k] * v[1 * j + k];
            *out++ = sum;
        }
    }
}

/* V A V^T, packed. */
static void out_of_eigenbasis_2_f(const float *eigh, const float (*in)[2], float *out) {
    const float *v = eigh + 2;
    for (int i = 0; i < 2; ++i) {
        float half[2] = {0};
        for (int k = 0; k < 2; ++k)
            for (int j = 0; j < 2; ++j) half[j] += v[2 * i + k] * in[k][j];
        for (int j = i; j < 2; ++j) {
            float sum = 0;
            for (int k = 0; k < 2; ++k) sum += half[k] * v[2 * j + k];
            *out++ = sum;
        }
    }
}

/* invsqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_invsqrt_2_f(const float *eigh, float *out) {
    float w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_invsqrt_f(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_2_f(eigh, (const float (*)[2])total, out);
}

/* D^1 invsqrt(A)[E] of the eigen-decomposition of A, packed. */
static void symmetric_invsqrt_2_derivative1_f(const float *eigh, const float *in_0, float *out) {
    float w1[2][2], total[2][2] = {{0}};
    float e0[2][2];
    into_eigenbasis_2_f(eigh, in_0, e0);
    for (int i0 = 0; i0 < 2; ++i0)
        for (int i1 = i0; i1 < 2; ++i1) {
            const float x[2] = {eigh[i0], eigh[i1]}, gap = eigh[i1] - eigh[i0], middle = (eigh[i0] + eigh[i1]) / 2;
            const float w = 4 * gap <= scale_invsqrt_f(middle) || !(gap > 0) ? near_invsqrt_f(x, 1, middle)
                : slope_invsqrt_f(eigh[i0], eigh[i1]);
            w1[i0][i1] = w1[i1][i0] = w;
        }
    for (int i0 = 0; i0 < 2; ++i0) for (int i1 = 0; i1 < 2; ++i1)
        total[i0][i1] += w1[i0][i1] * e0[i0][i1];
    out_of_eigenbasis_2_f(eigh, (const float (*)[2])total, out);
}

/* log(A) of the eigen-decomposition of A, packed. */
static void symmetric_log_2_f(const float *eigh, float *out) {
    float w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_log_f(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_2_f(eigh, (const float (*)[2])total, out);
}

/* D^1 log(A)[E] of the eigen-decomposition of A, packed. */
static void symmetric_log_2_derivative1_f(const float *eigh, const float *in_0, float *out) {
    float w1[2][2], total[2][2] = {{0}};
    float e0[2][2];
    into_eigenbasis_2_f(eigh, in_0, e0);
    for (int i0 = 0; i0 < 2; ++i0)
        for (int i1 = i0; i1 < 2; ++i1) {
            const float x[2] = {eigh[i0], eigh[i1]}, gap = eigh[i1] - eigh[i0], middle = (eigh[i0] + eigh[i1]) / 2;
            const float w = 4 * gap <= scale_log_f(middle) || !(gap > 0) ? near_log_f(x, 1, middle)
                : slope_log_f(eigh[i0], eigh[i1]);
            w1[i0][i1] = w1[i1][i0] = w;
        }
    for (int i0 = 0; i0 < 2; ++i0) for (int i1 = 0; i1 < 2; ++i1)
        total[i0][i1] += w1[i0][i1] * e0[i0][i1];
    out_of_eigenbasis_2_f(eigh, (const float (*)[2])total, out);
}

/* D^2 log(A)[E, E] of the eigen-decomposition of A, packed. */
static void symmetric_log_2_derivative2_f(const float *eigh, const float *in_0, const float *in_1, float *out) {
    float w1[2][2], w2[2][2][2], total[2][2] = {{0}};
    float e0[2][2], e1[2][2];
    into_eigenbasis_2_f(eigh, in_0, e0);
    into_eigenbasis_2_f(eigh, in_1, e1);
    for (int i0 = 0; i0 < 2; ++i0)
        for (int i1 = i0; i1 < 2; ++i1) {
            const float x[2] = {eigh[i0], eigh[i1]}, gap = eigh[i1] - eigh[i0], middle = (eigh[i0] + eigh[i1]) / 2;
            const float w = 4 * gap <= scale_log_f(middle) || !(gap > 0) ? near_log_f(x, 1, middle)
                : slope_log_f(eigh[i0], eigh[i1]);
            w1[i0][i1] = w1[i1][i0] = w;
        }
    for (int i0 = 0; i0 < 2; ++i0)
        for (int i1 = i0; i1 < 2; ++i1)
            for (int i2 = i1; i2 < 2; ++i2) {
                const float x[3] = {eigh[i0], eigh[i1], eigh[i2]}, gap = eigh[i2] - eigh[i0], middle = (eigh[i0] + eigh[i2]) / 2;
                const float w = 4 * gap <= scale_log_f(middle) || !(gap > 0) ? near_log_f(x, 2, middle)
                    : (w1[i1][i2] - w1[i0][i1]) / gap;
                w2[i0][i1][i2] = w2[i0][i2][i1] = w2[i1][i0][i2] = w2[i1][i2][i0] = w2[i2][i0][i1] = w2[i2][i1][i0] = w;
            }
    for (int i0 = 0; i0 < 2; ++i0) for (int i1 = 0; i1 < 2; ++i1) for (int i2 = 0; i2 < 2; ++i2)
        total[i0][i2] += w2[i0][i1][i2] * (e0[i0][i1] * e1[i1][i2] + e1[i0][i1] * e0[i1][i2]);
    out_of_eigenbasis_2_f(eigh, (const float (*)[2])total, out);
}

/* log_sinhc_sqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_log_sinhc_sqrt_1_f(const float *eigh, float *out) {
    float w0[1], total[1][1] = {{0}};
    for (int i0 = 0; i0 < 1; ++i0) w0[i0] = scalar_log_sinhc_sqrt_f(eigh[i0]);
    for (int i0 = 0; i0 < 1; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_1_f(eigh, (const float (*)[1])total, out);
}

/* D^1 log_sinhc_sqrt(A)[E] of the eigen-decomposition of A, packed. */
static void symmetric_log_sinhc_sqrt_1_derivative1_f(const float *eigh, const float *in_0, float *out) {
    float w1[1][1], total[1][1] = {{0}};
    float e0[1][1];
    into_eigenbasis_1_f(eigh, in_0, e0);
    for (int i0 = 0; i0 < 1; ++i0)
        for (int i1 = i0; i1 < 1; ++i1) {
            const float x[2] = {eigh[i0], eigh[i1]}, gap = eigh[i1] - eigh[i0], middle = (eigh[i0] + eigh[i1]) / 2;
            const float w = 4 * gap <= scale_log_sinhc_sqrt_f(middle) || !(gap > 0) ? near_log_sinhc_sqrt_f(x, 1, middle)
                : slope_log_sinhc_sqrt_f(eigh[i0], eigh[i1]);
            w1[i0][i1] = w1[i1][i0] = w;
        }
    for (int i0 = 0; i0 < 1; ++i0) for (int i1 = 0; i1 < 1; ++i1)
        total[i0][i1] += w1[i0][i1] * e0[i0][i1];
    out_of_eigenbasis_1_f(eigh, (const float (*)[1])total, out);
}

/* D^2 log_sinhc_sqrt(A)[E, E] of the eigen-decomposition of A, packed. */
static void symmetric_log_sinhc_sqrt_1_derivative2_f(const float *eigh, const float *in_0, const float *in_1, float *out) {
    float w1[1][1], w2[1][1][1], total[1][1] = {{0}};
    float e0[1][1], e1[1][1];
    into_eigenbasis_1_f(eigh, in_0, e0);
    into_eigenbasis_1_f(eigh, in_1, e1);
    for (int i0 = 0; i0 < 1; ++i0)
        for (int i1 = i0; i1 < 1; ++i1) {
            const float x[2] = {eigh[i0], eigh[i1]}, gap = eigh[i1] - eigh[i0], middle = (eigh[i0] + eigh[i1]) / 2;
            const float w = 4 * gap <= scale_log_sinhc_sqrt_f(middle) || !(gap > 0) ? near_log_sinhc_sqrt_f(x, 1, middle)
                : slope_log_sinhc_sqrt_f(eigh[i0], eigh[i1]);
            w1[i0][i1] = w1[i1][i0] = w;
        }
    for (int i0 = 0; i0 < 1; ++i0)
        for (int i1 = i0; i1 < 1; ++i1)
            for (int i2 = i1; i2 < 1; ++i2) {
                const float x[3] = {eigh[i0], eigh[i1], eigh[i2]}, gap = eigh[i2] - eigh[i0], middle = (eigh[i0] + eigh[i2]) / 2;
                const float w = 4 * gap <= scale_log_sinhc_sqrt_f(middle) || !(gap > 0) ? near_log_sinhc_sqrt_f(x, 2, middle)
                    : (w1[i1][i2] - w1[i0][i1]) / gap;
                w2[i0][i1][i2] = w2[i0][i2][i1] = w2[i1][i0][i2] = w2[i1][i2][i0] = w2[i2][i0][i1] = w2[i2][i1][i0] = w;
            }
    for (int i0 = 0; i0 < 1; ++i0) for (int i1 = 0; i1 < 1; ++i1) for (int i2 = 0; i2 < 1; ++i2)
        total[i0][i2] += w2[i0][i1][i2] * (e0[i0][i1] * e1[i1][i2] + e1[i0][i1] * e0[i1][i2]);
    out_of_eigenbasis_1_f(eigh, (const float (*)[1])total, out);
}

/* sqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_sqrt_2_f(const float *eigh, float *out) {
    float w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_sqrt_f(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_2_f(eigh, (const float (*)[2])total, out);
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
    const vector_f p_0_1 = 0.5f * mu1 + 0.5f * mu2;
    vector_f p_0_1_eigh[6];
    {
        const vector_f given_lanes[3] = {mu0, p_0_1, mu3};
        for (size_t lane = 0; lane < LANES_f; ++lane) {
            float given[3];
            for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
            float found[6];
            {
                const float in_0[3] = {given[0], given[1], given[2]};
                symmetric_eigh_2_f(in_0, found);
            }
            for (int i = 0; i < 6; ++i) LANE(p_0_1_eigh[i], lane) = found[i];
        }
    }
    vector_f invsqrtm[3];
    {
        for (size_t lane = 0; lane < LANES_f; ++lane) {
            float whole[6];
            for (int i = 0; i < 6; ++i) whole[i] = LANE(p_0_1_eigh[i], lane);
            float found[3];
            symmetric_invsqrt_2_f(whole, found);
            for (int i = 0; i < 3; ++i) LANE(invsqrtm[i], lane) = found[i];
        }
    }
    const vector_f r0_0 = invsqrtm[0];
    const vector_f r0_1 = invsqrtm[1];
    const vector_f r1_1 = invsqrtm[2];
    const vector_f M0_0 = W0_0 * W0_0 + W1_0 * W1_0 + W2_0 * W2_0;
    const vector_f M0_1 = W0_0 * W0_1 + W1_0 * W1_1 + W2_0 * W2_1;
    const vector_f M0_2 = W0_0 * W0_2 + W1_0 * W1_2 + W2_0 * W2_2;
    const vector_f M1_1 = W0_1 * W0_1 + W1_1 * W1_1 + W2_1 * W2_1;
    const vector_f M1_2 = W0_1 * W0_2 + W1_1 * W1_2 + W2_1 * W2_2;
    const vector_f M2_2 = W0_2 * W0_2 + W1_2 * W1_2 + W2_2 * W2_2;
    S[0] = W0_0;
    S[1] = W0_1;
    S[2] = W0_2;
    S[3] = W1_0;
    S[4] = W1_1;
    S[5] = W1_2;
    S[6] = W2_0;
    S[7] = W2_1;
    S[8] = W2_2;
    S[9] = its_amplitude;
    S[10] = r0_0;
    S[11] = r0_1;
    S[12] = r1_1;
    S[13] = 0.5f * r0_0;
    S[14] = 0.5f * r0_1;
    S[15] = 0.5f * r1_1;
    S[16] = M0_0;
    S[17] = M0_1;
    S[18] = M0_2;
    S[19] = M1_1;
    S[20] = M1_2;
    S[21] = M2_2;
}

/*
 * Adds the values phi of some splats at 2 vectors of points.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_value_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values) {
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 22 * near[k];
        const float W0_0 = S[0];
        const float W0_1 = S[1];
        const float W0_2 = S[2];
        const float W1_0 = S[3];
        const float W1_1 = S[4];
        const float W1_2 = S[5];
        const float W2_0 = S[6];
        const float W2_1 = S[7];
        const float W2_2 = S[8];
        const float amplitude = S[9];
        const float r0_0 = S[10];
        const float r0_1 = S[11];
        const float r1_1 = S[12];
        const float mul_of_one = S[13];
        const float mul_of_one_2 = S[14];
        const float mul_of_one_3 = S[15];
        for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 4 * b;
            vector_f *value = values + b;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f total_2 = x0 * r0_0 + x2 * r0_1;
            const vector_f total_3 = x1 * r0_0 + x3 * r0_1;
            const vector_f entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
            const vector_f total_4 = x0 * r0_1 + x2 * r1_1;
            const vector_f total_5 = x1 * r0_1 + x3 * r1_1;
            const vector_f entry_0_1 = mul_of_one * total_4 + total_2 * mul_of_one_2 + mul_of_one_2 * total_5 +
                total_3 * mul_of_one_3;
            const vector_f entry_1_1 = r0_1 * total_4 + r1_1 * total_5;
            vector_f entry_0_0_eigh[6];
            {
                const vector_f given_lanes[3] = {entry_0_0, entry_0_1, entry_1_1};
                for (size_t lane = 0; lane < LANES_f; ++lane) {
                    float given[3];
                    for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                    float found[6];
                    {
                        const float in_0[3] = {given[0], given[1], given[2]};
                        symmetric_eigh_2_f(in_0, found);
                    }
                    for (int i = 0; i < 6; ++i) LANE(entry_0_0_eigh[i], lane) = found[i];
                }
            }
            vector_f logm[3];
            {
                for (size_t lane = 0; lane < LANES_f; ++lane) {
                    float whole[6];
                    for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                    float found[3];
                    symmetric_log_2_f(whole, found);
                    for (int i = 0; i < 3; ++i) LANE(logm[i], lane) = found[i];
                }
            }
            const vector_f L0_1 = logm[1];
            const vector_f L0_0 = logm[0];
            const vector_f L1_1 = logm[2];
            const vector_f L0_0_gap = L0_0 - L1_1;
            const vector_f entry_0_0_2 = L0_1 * L0_1 + 0.25f * (L0_0_gap * L0_0_gap);
            vector_f entry_0_0_2_eigh[2];
            {
                const vector_f given_lanes[1] = {entry_0_0_2};
                for (size_t lane = 0; lane < LANES_f; ++lane) {
                    float given[1];
                    for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                    float found[2];
                    {
                        const float in_0[1] = {given[0]};
                        symmetric_eigh_1_f(in_0, found);
                    }
                    for (int i = 0; i < 2; ++i) LANE(entry_0_0_2_eigh[i], lane) = found[i];
                }
            }
            vector_f log_sinhc_sqrtm[1];
            {
                for (size_t lane = 0; lane < LANES_f; ++lane) {
                    float whole[2];
                    for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                    float found[1];
                    symmetric_log_sinhc_sqrt_1_f(whole, found);
                    for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm[i], lane) = found[i];
                }
            }
            const vector_f log_sinhc_sqrtm_value0_0 = log_sinhc_sqrtm[0];
            const vector_f v1 = 1.4142135623730951f * L0_1;
            const vector_f z0 = W0_0 * L0_0 + W0_1 * v1 + W0_2 * L1_1;
            const vector_f z1 = W1_0 * L0_0 + W1_1 * v1 + W1_2 * L1_1;
            const vector_f z2 = W2_0 * L0_0 + W2_1 * v1 + W2_2 * L1_1;
            const vector_f gap = -log_sinhc_sqrtm_value0_0 - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
            const vector_f phi = exp_each_f(gap);
            value[0] = value[0] + amplitude * phi;
        }
    }
}

/*
 * Adds the values phi of some splats at 2 vectors of points, and slope = d phi / d X.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
INLINE void pair_forward_f(
    size_t count, const vector_f *points, const float *splats, const uint32_t *near, vector_f *values, vector_f *slopes) {
    for (size_t k = 0; k < count; ++k) {
        const float *S = splats + 22 * near[k];
        const float W0_0 = S[0];
        const float W0_1 = S[1];
        const float W0_2 = S[2];
        const float W1_0 = S[3];
        const float W1_1 = S[4];
        const float W1_2 = S[5];
        const float W2_0 = S[6];
        const float W2_1 = S[7];
        const float W2_2 = S[8];
        const float amplitude = S[9];
        const float r0_0 = S[10];
        const float r0_1 = S[11];
        const float r1_1 = S[12];
        const float mul_of_one = S[13];
        const float mul_of_one_2 = S[14];
        const float mul_of_one_3 = S[15];
        for (size_t b = 0; b < 2; ++b) {
            const vector_f *X = points + 4 * b;
            vector_f *value = values + b;
            vector_f *slope = slopes + 4 * b;
            const vector_f x0 = X[0];
            const vector_f x1 = X[1];
            const vector_f x2 = X[2];
            const vector_f x3 = X[3];
            const vector_f total_2 = x0 * r0_0 + x2 * r0_1;
            const vector_f total_3 = x1 * r0_0 + x3 * r0_1;
            const vector_f entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
            const vector_f total_4 = x0 * r0_1 + x2 * r1_1;
            const vector_f total_5 = x1 * r0_1 + x3 * r1_1;
            const vector_f entry_0_1 = mul_of_one * total_4 + total_2 * mul_of_one_2 + mul_of_one_2 * total_5 +
                total_3 * mul_of_one_3;
            const vector_f entry_1_1 = r0_1 * total_4 + r1_1 * total_5;
            vector_f entry_0_0_eigh[6];
            {
                const vector_f given_lanes[3] = {entry_0_0, entry_0_1, entry_1_1};
                for (size_t lane = 0; lane < LANES_f; ++lane) {
                    float given[3];
                    for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                    float found[6];
                    {
                        const float in_0[3] = {given[0], given[1], given[2]};
                        symmetric_eigh_2_f(in_0, found);
                    }
                    for (int i = 0; i < 6; ++i) LANE(entry_0_0_eigh[i], lane) = found[i];
                }
            }
            vector_f logm[3];
            {
                for (size_t lane = 0; lane < LANES_f; ++lane) {
                    float whole[6];
                    for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                    float found[3];
                    symmetric_log_2_f(whole, found);
                    for (int i = 0; i < 3; ++i) LANE(logm[i], lane) = found[i];
                }
            }
            const vector_f L0_1 = logm[1];
            const vector_f L0_0 = logm[0];
            const vector_f L1_1 = logm[2];
            const vector_f L0_0_gap = L0_0 - L1_1;
            const vector_f entry_0_0_2 = L0_1 * L0_1 + 0.25f * (L0_0_gap * L0_0_gap);
            vector_f entry_0_0_2_eigh[2];
            {
                const vector_f given_lanes[1] = {entry_0_0_2};
                for (size_t lane = 0; lane < LANES_f; ++lane) {
                    float given[1];
                    for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                    float found[2];
                    {
                        const float in_0[1] = {given[0]};
                        symmetric_eigh_1_f(in_0, found);
                    }
                    for (int i = 0; i < 2; ++i) LANE(entry_0_0_2_eigh[i], lane) = found[i];
                }
            }
            vector_f log_sinhc_sqrtm[1];
            {
                for (size_t lane = 0; lane < LANES_f; ++lane) {
                    float whole[2];
                    for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                    float found[1];
                    symmetric_log_sinhc_sqrt_1_f(whole, found);
                    for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm[i], lane) = found[i];
                }
            }
            const vector_f log_sinhc_sqrtm_value0_0 = log_sinhc_sqrtm[0];
            const vector_f v1 = 1.4142135623730951f * L0_1;
            const vector_f z0 = W0_0 * L0_0 + W0_1 * v1 + W0_2 * L1_1;
            const vector_f z1 = W1_0 * L0_0 + W1_1 * v1 + W1_2 * L1_1;
            const vector_f z2 = W2_0 * L0_0 + W2_1 * v1 + W2_2 * L1_1;
            const vector_f gap = -log_sinhc_sqrtm_value0_0 - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
            const vector_f phi = exp_each_f(gap);
            const vector_f phi_2 = amplitude * phi;
            vector_f log_sinhc_sqrtm_slope[1];
            {
                const vector_f given_lanes[1] = {-phi_2};
                for (size_t lane = 0; lane < LANES_f; ++lane) {
                    float given[1];
                    for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                    float whole[2];
                    for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                    float found[1];
                    {
                        const float in_0[1] = {given[0]};
                        symmetric_log_sinhc_sqrt_1_derivative1_f(whole, in_0, found);
                    }
                    for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm_slope[i], lane) = found[i];
                }
            }
            const vector_f by_entry_0_0_2 = log_sinhc_sqrtm_slope[0];
            const vector_f product = L0_0_gap * (0.5f * by_entry_0_0_2);
            const vector_f gap_2 = product - phi_2 * (W2_0 * z2 + (W1_0 * z1 + W0_0 * z0));
            const vector_f product_2 = 1.4142135623730951f * (phi_2 * (W2_1 * z2 + (W1_1 * z1 + W0_1 * z0)));
            const vector_f minus = -(phi_2 * (W2_2 * z2 + (W1_2 * z1 + W0_2 * z0)));
            vector_f logm_slope[3];
            {
                const vector_f given_lanes[3] = {gap_2, 0.5f * (L0_1 * (2.0f * by_entry_0_0_2) - product_2), minus - product};
                for (size_t lane = 0; lane < LANES_f; ++lane) {
                    float given[3];
                    for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                    float whole[6];
                    for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                    float found[3];
                    {
                        const float in_0[3] = {given[0], given[1], given[2]};
                        symmetric_log_2_derivative1_f(whole, in_0, found);
                    }
                    for (int i = 0; i < 3; ++i) LANE(logm_slope[i], lane) = found[i];
                }
            }
            const vector_f by_entry_1_1 = logm_slope[2];
            const vector_f by_entry_0_1 = 2.0f * logm_slope[1];
            const vector_f total_6 = r0_1 * by_entry_1_1 + mul_of_one * by_entry_0_1;
            const vector_f product_3 = mul_of_one_2 * by_entry_0_1;
            const vector_f by_entry_0_0 = logm_slope[0];
            const vector_f total_7 = product_3 + r0_0 * by_entry_0_0;
            const vector_f total_8 = r1_1 * by_entry_1_1 + product_3;
            const vector_f total_9 = mul_of_one_3 * by_entry_0_1 + r0_1 * by_entry_0_0;
            value[0] = value[0] + phi_2;
            slope[0] = slope[0] + r0_1 * total_6 + r0_0 * total_7;
            slope[1] = slope[1] + r0_1 * total_8 + r0_0 * total_9;
            slope[2] = slope[2] + r1_1 * total_6 + r0_1 * total_7;
            slope[3] = slope[3] + r1_1 * total_8 + r0_1 * total_9;
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
    const vector_f p_0_1 = 0.5f * x1 + 0.5f * x2;
    vector_f p_0_1_eigh[6];
    {
        const vector_f given_lanes[3] = {x0, p_0_1, x3};
        for (size_t lane = 0; lane < LANES_f; ++lane) {
            float given[3];
            for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
            float found[6];
            {
                const float in_0[3] = {given[0], given[1], given[2]};
                symmetric_eigh_2_f(in_0, found);
            }
            for (int i = 0; i < 6; ++i) LANE(p_0_1_eigh[i], lane) = found[i];
        }
    }
    vector_f sqrtm[3];
    {
        for (size_t lane = 0; lane < LANES_f; ++lane) {
            float whole[6];
            for (int i = 0; i < 6; ++i) whole[i] = LANE(p_0_1_eigh[i], lane);
            float found[3];
            symmetric_sqrt_2_f(whole, found);
            for (int i = 0; i < 3; ++i) LANE(sqrtm[i], lane) = found[i];
        }
    }
    const vector_f sqrtm_p0_0 = sqrtm[0];
    const vector_f sqrtm_p0_1 = sqrtm[1];
    const vector_f sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
    const vector_f total_2 = slope_x0 * (sqrtm_p0_0 * sqrtm_p0_0) + slope_x3 * sqrtm_p0_1_squared + sqrtm_p0_1
        * (slope_x1 * sqrtm_p0_0) + sqrtm_p0_1 * (slope_x2 * sqrtm_p0_0);
    const vector_f sqrtm_p1_1 = sqrtm[2];
    const vector_f total_3 = 0.7071067811865476f * sqrtm_p0_1_squared + 1.4142135623730951f * (sqrtm_p1_1 *
        (0.5f * sqrtm_p0_0));
    const vector_f total_4 = slope_x1 * total_3 + slope_x2 * total_3 + 1.4142135623730951f * (sqrtm_p0_1 *
        (slope_x0 * sqrtm_p0_0)) + 1.4142135623730951f * (sqrtm_p1_1 * (slope_x3 * sqrtm_p0_1));
    const vector_f total_5 = slope_x0 * sqrtm_p0_1_squared + slope_x3 * (sqrtm_p1_1 * sqrtm_p1_1) + sqrtm_p1_1
        * (slope_x1 * sqrtm_p0_1) + sqrtm_p1_1 * (slope_x2 * sqrtm_p0_1);
    gradient[0] = total_2;
    gradient[1] = total_4;
    gradient[2] = total_5;
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
    const vector_f p_0_1 = 0.5f * x1 + 0.5f * x2;
    vector_f p_0_1_eigh[6];
    {
        const vector_f given_lanes[3] = {x0, p_0_1, x3};
        for (size_t lane = 0; lane < LANES_f; ++lane) {
            float given[3];
            for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
            float found[6];
            {
                const float in_0[3] = {given[0], given[1], given[2]};
                symmetric_eigh_2_f(in_0, found);
            }
            for (int i = 0; i < 6; ++i) LANE(p_0_1_eigh[i], lane) = found[i];
        }
    }
    vector_f sqrtm[3];
    {
        for (size_t lane = 0; lane < LANES_f; ++lane) {
            float whole[6];
            for (int i = 0; i < 6; ++i) whole[i] = LANE(p_0_1_eigh[i], lane);
            float found[3];
            symmetric_sqrt_2_f(whole, found);
            for (int i = 0; i < 3; ++i) LANE(sqrtm[i], lane) = found[i];
        }
    }
    const vector_f sqrtm_p0_1 = sqrtm[1];
    const vector_f sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
    const vector_f sqrtm_p0_0 = sqrtm[0];
    const vector_f product = 1.4142135623730951f * gradient_bar1;
    const vector_f sqrtm_p1_1 = sqrtm[2];
    const vector_f product_2 = (0.7071067811865476f * sqrtm_p0_1_squared + 1.4142135623730951f * (sqrtm_p1_1 *
        (0.5f * sqrtm_p0_0))) * gradient_bar1;
    const vector_f total_2 = sqrtm_p0_1 * (sqrtm_p1_1 * gradient_bar2) + product_2 + sqrtm_p0_0 * (sqrtm_p0_1
        * gradient_bar0);
    slope_bar[0] = sqrtm_p0_1_squared * gradient_bar2 + sqrtm_p0_0 * (sqrtm_p0_1 * product) + sqrtm_p0_0 *
            sqrtm_p0_0 * gradient_bar0;
    slope_bar[1] = total_2;
    slope_bar[2] = total_2;
    slope_bar[3] = sqrtm_p1_1 * sqrtm_p1_1 * gradient_bar2 + sqrtm_p0_1 * (sqrtm_p1_1 * product) +
            sqrtm_p0_1_squared * gradient_bar0;
}

/*
 * Adds what makes the derivatives of phi value_bar + slope . slope_bar, of a splat at some vectors of points.
 *
 * phi = amplitude |det D Log_mu(x)| exp(-|z|^2 / 2), z = W Log_mu(x)
 */
OUTLINE void pair_backward_f(
    size_t count, const vector_f *points, const uint32_t *near, const float *S, vector_f *sums) {
    for (size_t i = 0; i < count; ++i) {
        const vector_f *X = points + 9 * (size_t)near[i];
        const vector_f *value_bar = points + 9 * (size_t)near[i] + 4;
        const vector_f *slope_bar = points + 9 * (size_t)near[i] + 4 + 1;
        const vector_f x0 = X[0];
        const vector_f x1 = X[1];
        const vector_f x2 = X[2];
        const vector_f x3 = X[3];
        const float W0_0 = S[0];
        const float W0_1 = S[1];
        const float W0_2 = S[2];
        const float W1_0 = S[3];
        const float W1_1 = S[4];
        const float W1_2 = S[5];
        const float W2_0 = S[6];
        const float W2_1 = S[7];
        const float W2_2 = S[8];
        const float r0_0 = S[10];
        const float r0_1 = S[11];
        const float r1_1 = S[12];
        const float mul_of_one = S[13];
        const float mul_of_one_2 = S[14];
        const float mul_of_one_3 = S[15];
        const float M0_0 = S[16];
        const float M0_1 = S[17];
        const float M0_2 = S[18];
        const float M1_1 = S[19];
        const float M1_2 = S[20];
        const float M2_2 = S[21];
        const vector_f its_value_bar = value_bar[0];
        const vector_f x0_bar = slope_bar[0];
        const vector_f x1_bar = slope_bar[1];
        const vector_f x2_bar = slope_bar[2];
        const vector_f x3_bar = slope_bar[3];
        const vector_f total_2 = x0 * r0_0 + x2 * r0_1;
        const vector_f total_3 = x1 * r0_0 + x3 * r0_1;
        const vector_f entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
        const vector_f total_4 = x0 * r0_1 + x2 * r1_1;
        const vector_f total_5 = x1 * r0_1 + x3 * r1_1;
        const vector_f entry_0_1 = mul_of_one * total_4 + total_2 * mul_of_one_2 + mul_of_one_2 * total_5 +
            total_3 * mul_of_one_3;
        const vector_f entry_1_1 = r0_1 * total_4 + r1_1 * total_5;
        vector_f entry_0_0_eigh[6];
        {
            const vector_f given_lanes[3] = {entry_0_0, entry_0_1, entry_1_1};
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float given[3];
                for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                float found[6];
                {
                    const float in_0[3] = {given[0], given[1], given[2]};
                    symmetric_eigh_2_f(in_0, found);
                }
                for (int i = 0; i < 6; ++i) LANE(entry_0_0_eigh[i], lane) = found[i];
            }
        }
        vector_f logm[3];
        {
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float whole[6];
                for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                float found[3];
                symmetric_log_2_f(whole, found);
                for (int i = 0; i < 3; ++i) LANE(logm[i], lane) = found[i];
            }
        }
        const vector_f L0_1 = logm[1];
        const vector_f L0_0 = logm[0];
        const vector_f L1_1 = logm[2];
        const vector_f L0_0_gap = L0_0 - L1_1;
        const vector_f entry_0_0_2 = L0_1 * L0_1 + 0.25f * (L0_0_gap * L0_0_gap);
        vector_f entry_0_0_2_eigh[2];
        {
            const vector_f given_lanes[1] = {entry_0_0_2};
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float given[1];
                for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                float found[2];
                {
                    const float in_0[1] = {given[0]};
                    symmetric_eigh_1_f(in_0, found);
                }
                for (int i = 0; i < 2; ++i) LANE(entry_0_0_2_eigh[i], lane) = found[i];
            }
        }
        vector_f log_sinhc_sqrtm[1];
        {
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float whole[2];
                for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                float found[1];
                symmetric_log_sinhc_sqrt_1_f(whole, found);
                for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm[i], lane) = found[i];
            }
        }
        const vector_f log_sinhc_sqrtm_value0_0 = log_sinhc_sqrtm[0];
        const vector_f v1 = 1.4142135623730951f * L0_1;
        const vector_f z0 = W0_0 * L0_0 + W0_1 * v1 + W0_2 * L1_1;
        const vector_f z1 = W1_0 * L0_0 + W1_1 * v1 + W1_2 * L1_1;
        const vector_f z2 = W2_0 * L0_0 + W2_1 * v1 + W2_2 * L1_1;
        const vector_f gap = -log_sinhc_sqrtm_value0_0 - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
        const vector_f phi = exp_each_f(gap);
        const vector_f total_6 = W2_2 * z2 + (W1_2 * z1 + W0_2 * z0);
        const vector_f total_7 = r0_0 * x0_bar + r0_1 * x2_bar;
        const vector_f total_8 = r0_0 * x1_bar + r0_1 * x3_bar;
        const vector_f total_9 = r0_0 * total_7 + r0_1 * total_8;
        const vector_f total_10 = r0_1 * x0_bar + r1_1 * x2_bar;
        const vector_f total_11 = r0_1 * x1_bar + r1_1 * x3_bar;
        const vector_f total_12 = total_7 + total_11;
        const vector_f by_by_entry_0_1 = mul_of_one * total_10 + mul_of_one_2 * total_12 + mul_of_one_3 * total_8;
        const vector_f total_13 = r0_1 * total_10 + r1_1 * total_11;
        vector_f logm_slope[3];
        {
            const vector_f given_lanes[3] = {total_9, by_by_entry_0_1, total_13};
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float given[3];
                for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                float whole[6];
                for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                float found[3];
                {
                    const float in_0[3] = {given[0], given[1], given[2]};
                    symmetric_log_2_derivative1_f(whole, in_0, found);
                }
                for (int i = 0; i < 3; ++i) LANE(logm_slope[i], lane) = found[i];
            }
        }
        const vector_f total_14 = W2_1 * z2 + (W1_1 * z1 + W0_1 * z0);
        const vector_f product = 1.4142135623730951f * logm_slope[1];
        const vector_f total_15 = W2_0 * z2 + (W1_0 * z1 + W0_0 * z0);
        const vector_f gap_2 = logm_slope[0] - logm_slope[2];
        const vector_f total_16 = 2.0f * (L0_1 * logm_slope[1]) + 0.5f * (L0_0_gap * gap_2);
        vector_f log_sinhc_sqrtm_slope[1];
        {
            const vector_f given_lanes[1] = {total_16};
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float given[1];
                for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                float whole[2];
                for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                float found[1];
                {
                    const float in_0[1] = {given[0]};
                    symmetric_log_sinhc_sqrt_1_derivative1_f(whole, in_0, found);
                }
                for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm_slope[i], lane) = found[i];
            }
        }
        const vector_f by_phi = its_value_bar - total_6 * logm_slope[2] - total_14 * product - total_15 *
            logm_slope[0] - log_sinhc_sqrtm_slope[0];
        const vector_f phi_product = phi * by_phi;
        const vector_f phi_minus = -phi;
        vector_f log_sinhc_sqrtm_slope_2[1];
        {
            const vector_f given_lanes[1] = {phi_minus};
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float given[1];
                for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                float whole[2];
                for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                float found[1];
                {
                    const float in_0[1] = {given[0]};
                    symmetric_log_sinhc_sqrt_1_derivative1_f(whole, in_0, found);
                }
                for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm_slope_2[i], lane) = found[i];
            }
        }
        const vector_f by_entry_0_0_2 = log_sinhc_sqrtm_slope_2[0];
        const vector_f product_2 = 0.5f * by_entry_0_0_2;
        const vector_f product_3 = L0_0_gap * product_2;
        const vector_f gap_3 = product_3 - phi * total_15;
        const vector_f product_4 = 2.0f * by_entry_0_0_2;
        const vector_f product_5 = 0.5f * (L0_1 * product_4 - 1.4142135623730951f * (phi * total_14));
        const vector_f gap_4 = -(phi * total_6) - product_3;
        vector_f logm_slope_2[3];
        {
            const vector_f given_lanes[3] = {gap_3, product_5, gap_4};
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float given[3];
                for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                float whole[6];
                for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                float found[3];
                {
                    const float in_0[3] = {given[0], given[1], given[2]};
                    symmetric_log_2_derivative1_f(whole, in_0, found);
                }
                for (int i = 0; i < 3; ++i) LANE(logm_slope_2[i], lane) = found[i];
            }
        }
        const vector_f by_entry_0_1 = 2.0f * logm_slope_2[1];
        const vector_f product_6 = mul_of_one_2 * by_entry_0_1;
        const vector_f by_entry_0_0 = logm_slope_2[0];
        const vector_f total_17 = product_6 + r0_0 * by_entry_0_0;
        const vector_f total_18 = mul_of_one_3 * by_entry_0_1 + r0_1 * by_entry_0_0;
        vector_f logm_derivative2[3];
        {
            const vector_f given_lanes[6] = {gap_3, product_5, gap_4, total_9, by_by_entry_0_1, total_13};
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float given[6];
                for (int i = 0; i < 6; ++i) given[i] = LANE(given_lanes[i], lane);
                float whole[6];
                for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                float found[3];
                {
                    const float in_0[3] = {given[0], given[1], given[2]};
                    const float in_1[3] = {given[3], given[4], given[5]};
                    symmetric_log_2_derivative2_f(whole, in_0, in_1, found);
                }
                for (int i = 0; i < 3; ++i) LANE(logm_derivative2[i], lane) = found[i];
            }
        }
        const vector_f phi_product_2 = phi * logm_slope[0];
        const vector_f phi_product_3 = phi * product;
        const vector_f phi_product_4 = phi * logm_slope[2];
        const vector_f gap_5 = -(M0_0 * phi_product_2) - M0_1 * phi_product_3 - M0_2 * phi_product_4 - total_15 *
            phi_product;
        vector_f log_sinhc_sqrtm_derivative2[1];
        {
            const vector_f given_lanes[2] = {phi_minus, total_16};
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float given[2];
                for (int i = 0; i < 2; ++i) given[i] = LANE(given_lanes[i], lane);
                float whole[2];
                for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                float found[1];
                {
                    const float in_0[1] = {given[0]};
                    const float in_1[1] = {given[1]};
                    symmetric_log_sinhc_sqrt_1_derivative2_f(whole, in_0, in_1, found);
                }
                for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm_derivative2[i], lane) = found[i];
            }
        }
        vector_f log_sinhc_sqrtm_slope_3[1];
        {
            const vector_f given_lanes[1] = {-phi_product};
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float given[1];
                for (int i = 0; i < 1; ++i) given[i] = LANE(given_lanes[i], lane);
                float whole[2];
                for (int i = 0; i < 2; ++i) whole[i] = LANE(entry_0_0_2_eigh[i], lane);
                float found[1];
                {
                    const float in_0[1] = {given[0]};
                    symmetric_log_sinhc_sqrt_1_derivative1_f(whole, in_0, found);
                }
                for (int i = 0; i < 1; ++i) LANE(log_sinhc_sqrtm_slope_3[i], lane) = found[i];
            }
        }
        const vector_f by_entry_0_0_2_2 = log_sinhc_sqrtm_derivative2[0] + log_sinhc_sqrtm_slope_3[0];
        const vector_f total_19 = product_2 * gap_2 + L0_0_gap * (0.5f * by_entry_0_0_2_2);
        const vector_f by_v1 = -(M0_1 * phi_product_2) - M1_1 * phi_product_3 - M1_2 * phi_product_4 - total_14 *
            phi_product;
        const vector_f gap_6 = -(M0_2 * phi_product_2) - M1_2 * phi_product_3 - M2_2 * phi_product_4 - total_6 *
            phi_product;
        vector_f logm_slope_3[3];
        {
            const vector_f given_lanes[3] = {gap_5 + total_19, 0.5f * (product_4 * logm_slope[1] + 1.4142135623730951f * by_v1 + L0_1 * (2.0f * by_entry_0_0_2_2)), gap_6 - total_19};
            for (size_t lane = 0; lane < LANES_f; ++lane) {
                float given[3];
                for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
                float whole[6];
                for (int i = 0; i < 6; ++i) whole[i] = LANE(entry_0_0_eigh[i], lane);
                float found[3];
                {
                    const float in_0[3] = {given[0], given[1], given[2]};
                    symmetric_log_2_derivative1_f(whole, in_0, found);
                }
                for (int i = 0; i < 3; ++i) LANE(logm_slope_3[i], lane) = found[i];
            }
        }
        const vector_f by_entry_0_1_2 = 2.0f * logm_derivative2[1] + 2.0f * logm_slope_3[1];
        const vector_f by_entry_0_0_3 = logm_derivative2[0] + logm_slope_3[0];
        const vector_f total_20 = mul_of_one_3 * by_entry_0_1_2 + r0_1 * by_entry_0_0_3;
        const vector_f product_7 = mul_of_one_2 * by_entry_0_1_2;
        const vector_f total_22 = product_7 + r0_0 * by_entry_0_0_3;
        const vector_f by_entry_1_1 = logm_slope_2[2];
        const vector_f total_23 = r0_1 * by_entry_1_1 + mul_of_one * by_entry_0_1;
        const vector_f total_24 = r1_1 * by_entry_1_1 + product_6;
        const vector_f by_entry_1_1_2 = logm_derivative2[2] + logm_slope_3[2];
        const vector_f total_26 = r1_1 * by_entry_1_1_2 + product_7;
        const vector_f total_27 = r0_1 * by_entry_1_1_2 + mul_of_one * by_entry_0_1_2;
        const vector_f product_8 = 0.5f * phi_product;
        const vector_f gap_7 = -phi_product_2 - L0_0 * product_8;
        const vector_f gap_8 = -phi_product_3 - v1 * product_8;
        const vector_f gap_9 = -phi_product_4 - L1_1 * product_8;
        sums[0] = sums[0] + phi_product;
        sums[1] = sums[1] + total_17 * x0_bar + by_entry_0_0 * total_7 + total_18 * x1_bar + x1 * total_20 +
                total_2 * by_entry_0_0_3 + x0 * total_22;
        sums[2] = sums[2] + total_17 * x2_bar + total_18 * x3_bar + by_entry_0_0 * total_8 + total_23 * x0_bar +
                total_24 * x1_bar + by_entry_1_1 * total_10 + total_4 * by_entry_1_1_2 + x1 * total_26 + x0 * total_27
                + total_3 * by_entry_0_0_3 + x3 * total_20 + x2 * total_22;
        sums[3] = sums[3] + total_23 * x2_bar + total_24 * x3_bar + by_entry_1_1 * total_11 + total_5 *
                by_entry_1_1_2 + x3 * total_26 + x2 * total_27;
        sums[4] = sums[4] + by_entry_0_1 * total_10 + total_4 * by_entry_0_1_2;
        sums[5] = sums[5] + by_entry_0_1 * total_12 + total_5 * by_entry_0_1_2 + total_2 * by_entry_0_1_2;
        sums[6] = sums[6] + by_entry_0_1 * total_8 + total_3 * by_entry_0_1_2;
        sums[7] = sums[7] + L0_0 * gap_7;
        sums[8] = sums[8] + L0_0 * gap_8 + v1 * gap_7;
        sums[9] = sums[9] + L0_0 * gap_9 + L1_1 * gap_7;
        sums[10] = sums[10] + v1 * gap_8;
        sums[11] = sums[11] + v1 * gap_9 + L1_1 * gap_8;
        sums[12] = sums[12] + L1_1 * gap_9;
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
    const vector_f p_0_1 = 0.5f * mu1 + 0.5f * mu2;
    vector_f p_0_1_eigh[6];
    {
        const vector_f given_lanes[3] = {mu0, p_0_1, mu3};
        for (size_t lane = 0; lane < LANES_f; ++lane) {
            float given[3];
            for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
            float found[6];
            {
                const float in_0[3] = {given[0], given[1], given[2]};
                symmetric_eigh_2_f(in_0, found);
            }
            for (int i = 0; i < 6; ++i) LANE(p_0_1_eigh[i], lane) = found[i];
        }
    }
    vector_f invsqrtm_slope[3];
    {
        const vector_f given_lanes[3] = {sum1 + 0.5f * sum4, 0.5f * (sum2 + 0.5f * sum5), sum3 + 0.5f * sum6};
        for (size_t lane = 0; lane < LANES_f; ++lane) {
            float given[3];
            for (int i = 0; i < 3; ++i) given[i] = LANE(given_lanes[i], lane);
            float whole[6];
            for (int i = 0; i < 6; ++i) whole[i] = LANE(p_0_1_eigh[i], lane);
            float found[3];
            {
                const float in_0[3] = {given[0], given[1], given[2]};
                symmetric_invsqrt_2_derivative1_f(whole, in_0, found);
            }
            for (int i = 0; i < 3; ++i) LANE(invsqrtm_slope[i], lane) = found[i];
        }
    }
    const vector_f product = its_amplitude * invsqrtm_slope[1];
    const vector_f product_2 = 2.0f * sum7;
    const vector_f product_3 = 2.0f * sum10;
    const vector_f product_4 = 2.0f * sum12;
    mu_bar[0] = its_amplitude * invsqrtm_slope[0];
    mu_bar[1] = product;
    mu_bar[2] = product;
    mu_bar[3] = its_amplitude * invsqrtm_slope[2];
    W_bar[0] = its_amplitude * (W0_0 * product_2 + W0_1 * sum8 + W0_2 * sum9);
    W_bar[1] = its_amplitude * (W0_0 * sum8 + W0_1 * product_3 + W0_2 * sum11);
    W_bar[2] = its_amplitude * (W0_0 * sum9 + W0_1 * sum11 + W0_2 * product_4);
    W_bar[3] = its_amplitude * (W1_0 * product_2 + W1_1 * sum8 + W1_2 * sum9);
    W_bar[4] = its_amplitude * (W1_0 * sum8 + W1_1 * product_3 + W1_2 * sum11);
    W_bar[5] = its_amplitude * (W1_0 * sum9 + W1_1 * sum11 + W1_2 * product_4);
    W_bar[6] = its_amplitude * (W2_0 * product_2 + W2_1 * sum8 + W2_2 * sum9);
    W_bar[7] = its_amplitude * (W2_0 * sum8 + W2_1 * product_3 + W2_2 * sum11);
    W_bar[8] = its_amplitude * (W2_0 * sum9 + W2_1 * sum11 + W2_2 * product_4);
    amplitude_bar[0] = sum0;
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
size_t spd_splats_work_f(size_t count, size_t splat_count, int threads) {
    (void)threads;
    const size_t points = (count + LANES_f - 1) / LANES_f, blocks = (points + 2 - 1) / 2;
    const size_t places = 0 * ((splat_count + LANES_f - 1) / LANES_f + (blocks + LANES_f - 1) / LANES_f);
    return (points * 9 + places + 1) * LANES_f + 22 * splat_count;
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
    return work_points_f(work) + (count + LANES_f - 1) / LANES_f * 9;
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
    vector_f own_mu[4], own_W[9], own_amplitude[1], S[22];
    vector_rows_f(mu, splat_count, start, 4, own_mu);
    vector_rows_f(W, splat_count, start, 9, own_W);
    vector_rows_f(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach_f(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants_f(own_mu, own_W, own_amplitude, S);
    vector_to_rows_f(S, constants, splat_count, start, 22, 22);
}

/* 2 vectors of points at a time while all splats pass, some at a time. */
void spd_splats_f(
    size_t count, size_t splat_count, const float *SPD_RESTRICT x, const float *SPD_RESTRICT mu, const float *SPD_RESTRICT W, const float *SPD_RESTRICT amplitude, const float *SPD_RESTRICT width,
    float *SPD_RESTRICT value, float *SPD_RESTRICT gradient, float *SPD_RESTRICT work, int threads) {
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

void spd_splats_value_f(
    size_t count, size_t splat_count, const float *SPD_RESTRICT x, const float *SPD_RESTRICT mu, const float *SPD_RESTRICT W, const float *SPD_RESTRICT amplitude, const float *SPD_RESTRICT width,
    float *SPD_RESTRICT value, float *SPD_RESTRICT work, int threads) {
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
    vector_f sum[13] = {ZERO};
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
}

/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
void spd_splats_vjp_f(
    size_t count, size_t splat_count, const float *SPD_RESTRICT x, const float *SPD_RESTRICT mu, const float *SPD_RESTRICT W, const float *SPD_RESTRICT amplitude, const float *SPD_RESTRICT width, const float *SPD_RESTRICT value_bar, const float *SPD_RESTRICT gradient_bar,
    float *SPD_RESTRICT mu_bar, float *SPD_RESTRICT W_bar, float *SPD_RESTRICT amplitude_bar, float *SPD_RESTRICT work, int threads) {
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
                for (int i = 0; i < 0; ++i) {
                    float *row = (float *)(places + block / LANES_f * 0 + i);
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
            float sums[LANES_f][13] = {{0}};
            uint32_t near[131072 / (9 * sizeof(vector_f)) + 2];
            vector_f own_mu[4], own_W[9], own_amplitude[1], own_sums[13], bars[14];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const float *reach = width ? splat_at_f(splats, k) + 4 * LANES_f : NULL;
                    const size_t some = blocks_near_f(mu + 4 * k, reach, places, first, first + size, near);
                    splat_sums_f(points + 9 * first, near, some, constants + 22 * k, sums[k - start]);
                }
            }
            vector_rows_f(mu, end, start, 4, own_mu);
            vector_rows_f(W, end, start, 9, own_W);
            vector_rows_f(amplitude, end, start, 1, own_amplitude);
            vector_rows_f(sums[0], LANES_f, 0, 13, own_sums);
            pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 4, bars + 4 + 9);
            vector_to_rows_f(bars, mu_bar, end, start, 4, 4);
            vector_to_rows_f(bars + 4, W_bar, end, start, 9, 9);
            vector_to_rows_f(bars + 4 + 9, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}

/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
void spd_splats_rows_f(
    size_t count, size_t splat_count, const float *SPD_RESTRICT x, const float *SPD_RESTRICT mu, const float *SPD_RESTRICT W, const float *SPD_RESTRICT amplitude, const float *SPD_RESTRICT value_bar, const float *SPD_RESTRICT gradient_bar,
    float *SPD_RESTRICT rows, float *SPD_RESTRICT work, int threads) {
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
                vector_f own_mu[4], own_W[9], own_amplitude[1], own_sums[13] = {ZERO}, bars[14];
                for (int i = 0; i < 4; ++i) own_mu[i] = vector_of_f(mu[4 * k + i]);
                for (int i = 0; i < 9; ++i) own_W[i] = vector_of_f(W[9 * k + i]);
                own_amplitude[0] = vector_of_f(amplitude[k]);
                pair_backward_f(1, point, &only, constants + 22 * k, own_sums);
                pair_constants_vjp_f(own_mu, own_W, own_amplitude, own_sums, bars, bars + 4, bars + 4 + 9);
                vector_to_rows_f(bars, rows + 14 * k, count, block * LANES_f, 14, 14 * splat_count);
            }
        }
        restore_denormals(mode);
    }
}

double spd_splats_order_f(
    size_t count, size_t splat_count, const float *SPD_RESTRICT x, const float *SPD_RESTRICT mu, const float *SPD_RESTRICT amplitude, const float *SPD_RESTRICT width,
    double limit, size_t *SPD_RESTRICT order, float *SPD_RESTRICT work) {
    (void)x, (void)mu, (void)amplitude, (void)width, (void)limit, (void)work;
    (void)splat_count;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    return 1;
}

#endif /* float */
