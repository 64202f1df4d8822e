/*
 * spd: Symmetric positive definite n x n matrices with the affine-invariant metric trace(P^-1 dP P^-1 dP).
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "spd.h"

#include <float.h>

#define LANES 64

/* Denormal numbers count as zero while the sums run: far splats are many, and slow. */
#if defined(__SSE2__)
#include <xmmintrin.h>
static unsigned flush_denormals(void) {
    const unsigned mode = _mm_getcsr();
    _mm_setcsr(mode | 0x8040u);
    return mode;
}
static void restore_denormals(unsigned mode) { _mm_setcsr(mode); }
#else
static unsigned flush_denormals(void) { return 0; }
static void restore_denormals(unsigned mode) { (void)mode; }
#endif

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

void spd_splats(
    size_t count,
    size_t splat_count,
    const double *SPD_RESTRICT x,
    const double *SPD_RESTRICT mu,
    const double *SPD_RESTRICT W,
    const double *SPD_RESTRICT amplitude,
    double *SPD_RESTRICT value,
    double *SPD_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[4][LANES], sum[4][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 4; ++i) x_block[i][lane] = x[4 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const double mu0 = mu[4 * k + 0];
            const double mu1 = mu[4 * k + 1];
            const double mu2 = mu[4 * k + 2];
            const double mu3 = mu[4 * k + 3];
            const double W0_0 = W[9 * k + 0];
            const double W0_1 = W[9 * k + 1];
            const double W0_2 = W[9 * k + 2];
            const double W1_0 = W[9 * k + 3];
            const double W1_1 = W[9 * k + 4];
            const double W1_2 = W[9 * k + 5];
            const double W2_0 = W[9 * k + 6];
            const double W2_1 = W[9 * k + 7];
            const double W2_2 = W[9 * k + 8];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double p_0_1 = 0.5 * mu1 + 0.5 * mu2;
                double p_0_1_eigh[6];
                {
                    const double in_0[3] = {mu0, p_0_1, mu3};
                    symmetric_eigh_2(in_0, p_0_1_eigh);
                }
                double invsqrtm[3];
                symmetric_invsqrt_2(p_0_1_eigh, invsqrtm);
                const double r0_0 = invsqrtm[0];
                const double r0_1 = invsqrtm[1];
                const double r1_1 = invsqrtm[2];
                const double total_2 = x_block[0][lane] * r0_0 + x_block[2][lane] * r0_1;
                const double total_3 = x_block[1][lane] * r0_0 + x_block[3][lane] * r0_1;
                const double entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
                const double r0_0_product = 0.5 * r0_0;
                const double total_4 = x_block[0][lane] * r0_1 + x_block[2][lane] * r1_1;
                const double r0_1_product = 0.5 * r0_1;
                const double total_5 = x_block[1][lane] * r0_1 + x_block[3][lane] * r1_1;
                const double r1_1_product = 0.5 * r1_1;
                const double entry_0_1 = r0_0_product * total_4 + total_2 * r0_1_product + r0_1_product * total_5 +
                    total_3 * r1_1_product;
                const double entry_1_1 = r0_1 * total_4 + r1_1 * total_5;
                double entry_0_0_eigh[6];
                {
                    const double in_0[3] = {entry_0_0, entry_0_1, entry_1_1};
                    symmetric_eigh_2(in_0, entry_0_0_eigh);
                }
                double logm[3];
                symmetric_log_2(entry_0_0_eigh, logm);
                const double L0_0 = logm[0];
                const double L0_1 = logm[1];
                const double L1_1 = logm[2];
                const double v1 = 1.4142135623730951 * L0_1;
                const double L0_0_gap = L0_0 - L1_1;
                const double entry_0_0_2 = L0_1 * L0_1 + 0.25 * (L0_0_gap * L0_0_gap);
                double entry_0_0_2_eigh[2];
                {
                    const double in_0[1] = {entry_0_0_2};
                    symmetric_eigh_1(in_0, entry_0_0_2_eigh);
                }
                double log_sinhc_sqrtm[1];
                symmetric_log_sinhc_sqrt_1(entry_0_0_2_eigh, log_sinhc_sqrtm);
                const double log_sinhc_sqrtm_value0_0 = log_sinhc_sqrtm[0];
                const double z0 = W0_0 * L0_0 + W0_1 * v1 + W0_2 * L1_1;
                const double z1 = W1_0 * L0_0 + W1_1 * v1 + W1_2 * L1_1;
                const double z2 = W2_0 * L0_0 + W2_1 * v1 + W2_2 * L1_1;
                const double gap = -log_sinhc_sqrtm_value0_0 - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
                const double phi = amplitude_k * exp(gap);
                const double by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                double log_sinhc_sqrtm_slope[1];
                {
                    const double in_0[1] = {-1.0};
                    symmetric_log_sinhc_sqrt_1_derivative1(entry_0_0_2_eigh, in_0, log_sinhc_sqrtm_slope);
                }
                const double by_entry_0_0_2 = log_sinhc_sqrtm_slope[0];
                const double product = L0_0_gap * (0.5 * by_entry_0_0_2);
                const double total_6 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0 + product;
                const double gap_2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0 - product;
                double logm_slope[3];
                {
                    const double in_0[3] = {total_6, 0.5 * (L0_1 * (2.0 * by_entry_0_0_2) + 1.4142135623730951 * by_v1), gap_2};
                    symmetric_log_2_derivative1(entry_0_0_eigh, in_0, logm_slope);
                }
                const double by_entry_0_0 = logm_slope[0];
                const double by_entry_1_1 = logm_slope[2];
                const double by_entry_0_1 = 2.0 * logm_slope[1];
                const double product_2 = r0_1_product * by_entry_0_1;
                const double total_7 = r1_1 * by_entry_1_1 + product_2;
                const double total_8 = r0_1 * by_entry_1_1 + r0_0_product * by_entry_0_1;
                const double total_9 = r1_1_product * by_entry_0_1 + r0_1 * by_entry_0_0;
                const double exponent_by_x3 = r1_1 * total_7 + r0_1 * total_9;
                const double exponent_by_x1 = r0_1 * total_7 + r0_0 * total_9;
                const double total_10 = product_2 + r0_0 * by_entry_0_0;
                const double exponent_by_x2 = r1_1 * total_8 + r0_1 * total_10;
                const double exponent_by_x0 = r0_1 * total_8 + r0_0 * total_10;
                const double df0 = phi * exponent_by_x0;
                const double df1 = phi * exponent_by_x1;
                const double df2 = phi * exponent_by_x2;
                const double df3 = phi * exponent_by_x3;
                const double p_0_1_2 = 0.5 * x_block[1][lane] + 0.5 * x_block[2][lane];
                double p_0_1_eigh_2[6];
                {
                    const double in_0[3] = {x_block[0][lane], p_0_1_2, x_block[3][lane]};
                    symmetric_eigh_2(in_0, p_0_1_eigh_2);
                }
                double sqrtm[3];
                symmetric_sqrt_2(p_0_1_eigh_2, sqrtm);
                const double sqrtm_p0_0 = sqrtm[0];
                const double sqrtm_p0_1 = sqrtm[1];
                const double sqrtm_p1_1 = sqrtm[2];
                const double sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
                const double gradient0 = df0 * (sqrtm_p0_0 * sqrtm_p0_0) + df3 * sqrtm_p0_1_squared + sqrtm_p0_1 * (df1 *
                    sqrtm_p0_0) + sqrtm_p0_1 * (df2 * sqrtm_p0_0);
                const double total_11 = 0.7071067811865476 * sqrtm_p0_1_squared + 1.4142135623730951 * (sqrtm_p1_1 * (0.5
                    * sqrtm_p0_0));
                const double gradient1 = df1 * total_11 + df2 * total_11 + 1.4142135623730951 * (sqrtm_p0_1 * (df0 *
                    sqrtm_p0_0)) + 1.4142135623730951 * (sqrtm_p1_1 * (df3 * sqrtm_p0_1));
                const double gradient2 = df0 * sqrtm_p0_1_squared + df3 * (sqrtm_p1_1 * sqrtm_p1_1) + sqrtm_p1_1 * (df1 *
                    sqrtm_p0_1) + sqrtm_p1_1 * (df2 * sqrtm_p0_1);
                sum[0][lane] += phi;
                sum[1][lane] += gradient0;
                sum[2][lane] += gradient1;
                sum[3][lane] += gradient2;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 3; ++i) gradient[3 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void spd_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *SPD_RESTRICT x,
    const double *SPD_RESTRICT mu,
    const double *SPD_RESTRICT W,
    const double *SPD_RESTRICT amplitude,
    const double *SPD_RESTRICT value_bar,
    const double *SPD_RESTRICT gradient_bar,
    double *SPD_RESTRICT mu_bar,
    double *SPD_RESTRICT W_bar,
    double *SPD_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 4 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 9 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[4][LANES], value_bar_block[1][LANES], gradient_bar_block[3][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const double weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 4; ++i) x_block[i][lane] = x[4 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] = gradient_bar[3 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            double sum[14][LANES] = {{0}}, total[14] = {0};
            const double mu0 = mu[4 * k + 0];
            const double mu1 = mu[4 * k + 1];
            const double mu2 = mu[4 * k + 2];
            const double mu3 = mu[4 * k + 3];
            const double W0_0 = W[9 * k + 0];
            const double W0_1 = W[9 * k + 1];
            const double W0_2 = W[9 * k + 2];
            const double W1_0 = W[9 * k + 3];
            const double W1_1 = W[9 * k + 4];
            const double W1_2 = W[9 * k + 5];
            const double W2_0 = W[9 * k + 6];
            const double W2_1 = W[9 * k + 7];
            const double W2_2 = W[9 * k + 8];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double p_0_1 = 0.5 * mu1 + 0.5 * mu2;
                double p_0_1_eigh[6];
                {
                    const double in_0[3] = {mu0, p_0_1, mu3};
                    symmetric_eigh_2(in_0, p_0_1_eigh);
                }
                double invsqrtm[3];
                symmetric_invsqrt_2(p_0_1_eigh, invsqrtm);
                const double r0_0 = invsqrtm[0];
                const double r0_1 = invsqrtm[1];
                const double r1_1 = invsqrtm[2];
                const double total_2 = x_block[0][lane] * r0_0 + x_block[2][lane] * r0_1;
                const double total_3 = x_block[1][lane] * r0_0 + x_block[3][lane] * r0_1;
                const double entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
                const double r0_0_product = 0.5 * r0_0;
                const double total_4 = x_block[0][lane] * r0_1 + x_block[2][lane] * r1_1;
                const double r0_1_product = 0.5 * r0_1;
                const double total_5 = x_block[1][lane] * r0_1 + x_block[3][lane] * r1_1;
                const double r1_1_product = 0.5 * r1_1;
                const double entry_0_1 = r0_0_product * total_4 + total_2 * r0_1_product + r0_1_product * total_5 +
                    total_3 * r1_1_product;
                const double entry_1_1 = r0_1 * total_4 + r1_1 * total_5;
                double entry_0_0_eigh[6];
                {
                    const double in_0[3] = {entry_0_0, entry_0_1, entry_1_1};
                    symmetric_eigh_2(in_0, entry_0_0_eigh);
                }
                double logm[3];
                symmetric_log_2(entry_0_0_eigh, logm);
                const double L0_0 = logm[0];
                const double L0_1 = logm[1];
                const double L1_1 = logm[2];
                const double v1 = 1.4142135623730951 * L0_1;
                const double L0_0_gap = L0_0 - L1_1;
                const double entry_0_0_2 = L0_1 * L0_1 + 0.25 * (L0_0_gap * L0_0_gap);
                double entry_0_0_2_eigh[2];
                {
                    const double in_0[1] = {entry_0_0_2};
                    symmetric_eigh_1(in_0, entry_0_0_2_eigh);
                }
                double log_sinhc_sqrtm[1];
                symmetric_log_sinhc_sqrt_1(entry_0_0_2_eigh, log_sinhc_sqrtm);
                const double log_sinhc_sqrtm_value0_0 = log_sinhc_sqrtm[0];
                const double z0 = W0_0 * L0_0 + W0_1 * v1 + W0_2 * L1_1;
                const double z1 = W1_0 * L0_0 + W1_1 * v1 + W1_2 * L1_1;
                const double z2 = W2_0 * L0_0 + W2_1 * v1 + W2_2 * L1_1;
                const double gap = -log_sinhc_sqrtm_value0_0 - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
                const double exp_2 = exp(gap);
                const double phi = amplitude_k * exp_2;
                const double by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                double log_sinhc_sqrtm_slope[1];
                {
                    const double in_0[1] = {-1.0};
                    symmetric_log_sinhc_sqrt_1_derivative1(entry_0_0_2_eigh, in_0, log_sinhc_sqrtm_slope);
                }
                const double by_entry_0_0_2 = log_sinhc_sqrtm_slope[0];
                const double product = 0.5 * by_entry_0_0_2;
                const double product_2 = L0_0_gap * product;
                const double total_6 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0 + product_2;
                const double gap_2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0 - product_2;
                const double product_3 = 2.0 * by_entry_0_0_2;
                const double product_4 = 0.5 * (L0_1 * product_3 + 1.4142135623730951 * by_v1);
                double logm_slope[3];
                {
                    const double in_0[3] = {total_6, product_4, gap_2};
                    symmetric_log_2_derivative1(entry_0_0_eigh, in_0, logm_slope);
                }
                const double by_entry_0_0 = logm_slope[0];
                const double by_entry_1_1 = logm_slope[2];
                const double by_entry_0_1 = 2.0 * logm_slope[1];
                const double product_5 = r0_1_product * by_entry_0_1;
                const double total_7 = r1_1 * by_entry_1_1 + product_5;
                const double total_8 = r0_1 * by_entry_1_1 + r0_0_product * by_entry_0_1;
                const double total_9 = r1_1_product * by_entry_0_1 + r0_1 * by_entry_0_0;
                const double exponent_by_x3 = r1_1 * total_7 + r0_1 * total_9;
                const double exponent_by_x1 = r0_1 * total_7 + r0_0 * total_9;
                const double total_10 = product_5 + r0_0 * by_entry_0_0;
                const double exponent_by_x2 = r1_1 * total_8 + r0_1 * total_10;
                const double exponent_by_x0 = r0_1 * total_8 + r0_0 * total_10;
                const double p_0_1_2 = 0.5 * x_block[1][lane] + 0.5 * x_block[2][lane];
                double p_0_1_eigh_2[6];
                {
                    const double in_0[3] = {x_block[0][lane], p_0_1_2, x_block[3][lane]};
                    symmetric_eigh_2(in_0, p_0_1_eigh_2);
                }
                double sqrtm[3];
                symmetric_sqrt_2(p_0_1_eigh_2, sqrtm);
                const double sqrtm_p0_0 = sqrtm[0];
                const double sqrtm_p0_1 = sqrtm[1];
                const double sqrtm_p1_1 = sqrtm[2];
                const double sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
                const double product_6 = 1.4142135623730951 * gradient_bar_block[1][lane];
                const double product_7 = (0.7071067811865476 * sqrtm_p0_1_squared + 1.4142135623730951 * (sqrtm_p1_1 *
                    (0.5 * sqrtm_p0_0))) * gradient_bar_block[1][lane];
                const double by_df2 = sqrtm_p0_1 * (sqrtm_p1_1 * gradient_bar_block[2][lane]) + product_7 + sqrtm_p0_0 *
                    (sqrtm_p0_1 * gradient_bar_block[0][lane]);
                const double by_df3 = sqrtm_p1_1 * sqrtm_p1_1 * gradient_bar_block[2][lane] + sqrtm_p0_1 * (sqrtm_p1_1 *
                    product_6) + sqrtm_p0_1_squared * gradient_bar_block[0][lane];
                const double by_df0 = sqrtm_p0_1_squared * gradient_bar_block[2][lane] + sqrtm_p0_0 * (sqrtm_p0_1 *
                    product_6) + sqrtm_p0_0 * sqrtm_p0_0 * gradient_bar_block[0][lane];
                const double by_exponent_by_x3 = phi * by_df3;
                const double by_exponent_by_x2 = phi * by_df2;
                const double by_exponent_by_x0 = phi * by_df0;
                const double by_phi = value_bar_block[0][lane] + exponent_by_x3 * by_df3 + exponent_by_x2 * by_df2 +
                    exponent_by_x1 * by_df2 + exponent_by_x0 * by_df0;
                const double r0_1_product_2 = r0_1 * by_exponent_by_x2;
                const double total_11 = r0_0 * by_exponent_by_x0 + r0_1_product_2;
                const double total_12 = r0_0 * by_exponent_by_x2 + r0_1 * by_exponent_by_x3;
                const double total_13 = r0_0 * total_11 + r0_1 * total_12;
                const double total_14 = r0_1 * by_exponent_by_x0 + r1_1 * by_exponent_by_x2;
                const double total_15 = total_10 * by_exponent_by_x2 + total_9 * by_exponent_by_x3 + by_entry_0_0 *
                    total_12 + total_8 * by_exponent_by_x0 + total_7 * by_exponent_by_x2;
                const double total_16 = r0_1_product_2 + r1_1 * by_exponent_by_x3;
                const double total_17 = total_11 + total_16;
                const double by_by_entry_0_1 = r0_0_product * total_14 + r0_1_product * total_17 + r1_1_product *
                    total_12;
                const double total_18 = r0_1 * total_14 + r1_1 * total_16;
                double logm_derivative2[3];
                {
                    const double in_0[3] = {total_6, product_4, gap_2};
                    const double in_1[3] = {total_13, by_by_entry_0_1, total_18};
                    symmetric_log_2_derivative2(entry_0_0_eigh, in_0, in_1, logm_derivative2);
                }
                double logm_slope_2[3];
                {
                    const double in_0[3] = {total_13, by_by_entry_0_1, total_18};
                    symmetric_log_2_derivative1(entry_0_0_eigh, in_0, logm_slope_2);
                }
                const double by_by_v1 = 1.4142135623730951 * logm_slope_2[1];
                const double gap_3 = logm_slope_2[0] - logm_slope_2[2];
                double log_sinhc_sqrtm_derivative2[1];
                {
                    const double in_0[1] = {-1.0};
                    const double in_1[1] = {2.0 * (L0_1 * logm_slope_2[1]) + 0.5 * (L0_0_gap * gap_3)};
                    symmetric_log_sinhc_sqrt_1_derivative2(entry_0_0_2_eigh, in_0, in_1, log_sinhc_sqrtm_derivative2);
                }
                const double product_8 = exp_2 * (amplitude_k * by_phi);
                const double by_z2 = -(W2_0 * logm_slope_2[0]) - W2_1 * by_by_v1 - W2_2 * logm_slope_2[2] - z2 *
                    product_8;
                const double by_z1 = -(W1_0 * logm_slope_2[0]) - W1_1 * by_by_v1 - W1_2 * logm_slope_2[2] - z1 *
                    product_8;
                const double by_z0 = -(W0_0 * logm_slope_2[0]) - W0_1 * by_by_v1 - W0_2 * logm_slope_2[2] - z0 *
                    product_8;
                const double by_v1_2 = W2_1 * by_z2 + W1_1 * by_z1 + W0_1 * by_z0;
                double log_sinhc_sqrtm_slope_2[1];
                {
                    const double in_0[1] = {-product_8};
                    symmetric_log_sinhc_sqrt_1_derivative1(entry_0_0_2_eigh, in_0, log_sinhc_sqrtm_slope_2);
                }
                const double by_entry_0_0_2_2 = log_sinhc_sqrtm_derivative2[0] + log_sinhc_sqrtm_slope_2[0];
                const double total_19 = product * gap_3 + L0_0_gap * (0.5 * by_entry_0_0_2_2);
                const double product_9 = 0.5 * (product_3 * logm_slope_2[1] + L0_1 * (2.0 * by_entry_0_0_2_2) +
                    1.4142135623730951 * by_v1_2);
                double logm_slope_3[3];
                {
                    const double in_0[3] = {W2_0 * by_z2 + W1_0 * by_z1 + W0_0 * by_z0 + total_19, product_9, W2_2 * by_z2 + W1_2 * by_z1 + W0_2 * by_z0 - total_19};
                    symmetric_log_2_derivative1(entry_0_0_eigh, in_0, logm_slope_3);
                }
                const double by_entry_0_0_3 = logm_derivative2[0] + logm_slope_3[0];
                const double by_entry_0_1_2 = 2.0 * logm_derivative2[1] + 2.0 * logm_slope_3[1];
                const double by_entry_1_1_2 = logm_derivative2[2] + logm_slope_3[2];
                const double total_20 = total_8 * by_exponent_by_x2 + total_7 * by_exponent_by_x3 + by_entry_1_1 *
                    total_16 + total_5 * by_entry_1_1_2 + 0.5 * (by_entry_0_1 * total_12 + total_3 * by_entry_0_1_2);
                const double product_10 = r0_1_product * by_entry_0_1_2;
                const double total_21 = r1_1 * by_entry_1_1_2 + product_10;
                const double total_22 = total_15 + by_entry_1_1 * total_14 + total_4 * by_entry_1_1_2 + x_block[1][lane] *
                    total_21 + 0.5 * (by_entry_0_1 * total_17 + total_5 * by_entry_0_1_2 + total_2 * by_entry_0_1_2);
                const double total_23 = r0_1 * by_entry_1_1_2 + r0_0_product * by_entry_0_1_2;
                const double total_24 = r1_1_product * by_entry_0_1_2 + r0_1 * by_entry_0_0_3;
                const double total_25 = total_10 * by_exponent_by_x0 + by_entry_0_0 * total_11 + total_9 *
                    by_exponent_by_x2 + 0.5 * (by_entry_0_1 * total_14 + total_4 * by_entry_0_1_2) + x_block[1][lane] *
                    total_24;
                const double total_26 = product_10 + r0_0 * by_entry_0_0_3;
                const double total_27 = total_22 + x_block[0][lane] * total_23 + total_3 * by_entry_0_0_3 +
                    x_block[3][lane] * total_24 + x_block[2][lane] * total_26;
                double invsqrtm_slope[3];
                {
                    const double in_0[3] = {total_25 + total_2 * by_entry_0_0_3 + x_block[0][lane] * total_26, 0.5 * total_27, total_20 + x_block[3][lane] * total_21 + x_block[2][lane] * total_23};
                    symmetric_invsqrt_2_derivative1(p_0_1_eigh, in_0, invsqrtm_slope);
                }
                sum[0][lane] += invsqrtm_slope[0];
                sum[1][lane] += invsqrtm_slope[1];
                sum[2][lane] += invsqrtm_slope[1];
                sum[3][lane] += invsqrtm_slope[2];
                sum[4][lane] += L0_0 * by_z0 - z0 * logm_slope_2[0];
                sum[5][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[6][lane] += L1_1 * by_z0 - z0 * logm_slope_2[2];
                sum[7][lane] += L0_0 * by_z1 - z1 * logm_slope_2[0];
                sum[8][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[9][lane] += L1_1 * by_z1 - z1 * logm_slope_2[2];
                sum[10][lane] += L0_0 * by_z2 - z2 * logm_slope_2[0];
                sum[11][lane] += v1 * by_z2 - z2 * by_by_v1;
                sum[12][lane] += L1_1 * by_z2 - z2 * logm_slope_2[2];
                sum[13][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 14; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[4 * k + 0] += total[0];
            mu_bar[4 * k + 1] += total[1];
            mu_bar[4 * k + 2] += total[2];
            mu_bar[4 * k + 3] += total[3];
            W_bar[9 * k + 0] += total[4];
            W_bar[9 * k + 1] += total[5];
            W_bar[9 * k + 2] += total[6];
            W_bar[9 * k + 3] += total[7];
            W_bar[9 * k + 4] += total[8];
            W_bar[9 * k + 5] += total[9];
            W_bar[9 * k + 6] += total[10];
            W_bar[9 * k + 7] += total[11];
            W_bar[9 * k + 8] += total[12];
            amplitude_bar[1 * k + 0] += total[13];
        }
    }
    restore_denormals(mode);
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

void spd_splats_f(
    size_t count,
    size_t splat_count,
    const float *SPD_RESTRICT x,
    const float *SPD_RESTRICT mu,
    const float *SPD_RESTRICT W,
    const float *SPD_RESTRICT amplitude,
    float *SPD_RESTRICT value,
    float *SPD_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[4][LANES], sum[4][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 4; ++i) x_block[i][lane] = x[4 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const float mu0 = mu[4 * k + 0];
            const float mu1 = mu[4 * k + 1];
            const float mu2 = mu[4 * k + 2];
            const float mu3 = mu[4 * k + 3];
            const float W0_0 = W[9 * k + 0];
            const float W0_1 = W[9 * k + 1];
            const float W0_2 = W[9 * k + 2];
            const float W1_0 = W[9 * k + 3];
            const float W1_1 = W[9 * k + 4];
            const float W1_2 = W[9 * k + 5];
            const float W2_0 = W[9 * k + 6];
            const float W2_1 = W[9 * k + 7];
            const float W2_2 = W[9 * k + 8];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float p_0_1 = 0.5f * mu1 + 0.5f * mu2;
                float p_0_1_eigh[6];
                {
                    const float in_0[3] = {mu0, p_0_1, mu3};
                    symmetric_eigh_2_f(in_0, p_0_1_eigh);
                }
                float invsqrtm[3];
                symmetric_invsqrt_2_f(p_0_1_eigh, invsqrtm);
                const float r0_0 = invsqrtm[0];
                const float r0_1 = invsqrtm[1];
                const float r1_1 = invsqrtm[2];
                const float total_2 = x_block[0][lane] * r0_0 + x_block[2][lane] * r0_1;
                const float total_3 = x_block[1][lane] * r0_0 + x_block[3][lane] * r0_1;
                const float entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
                const float r0_0_product = 0.5f * r0_0;
                const float total_4 = x_block[0][lane] * r0_1 + x_block[2][lane] * r1_1;
                const float r0_1_product = 0.5f * r0_1;
                const float total_5 = x_block[1][lane] * r0_1 + x_block[3][lane] * r1_1;
                const float r1_1_product = 0.5f * r1_1;
                const float entry_0_1 = r0_0_product * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
                    * r1_1_product;
                const float entry_1_1 = r0_1 * total_4 + r1_1 * total_5;
                float entry_0_0_eigh[6];
                {
                    const float in_0[3] = {entry_0_0, entry_0_1, entry_1_1};
                    symmetric_eigh_2_f(in_0, entry_0_0_eigh);
                }
                float logm[3];
                symmetric_log_2_f(entry_0_0_eigh, logm);
                const float L0_0 = logm[0];
                const float L0_1 = logm[1];
                const float L1_1 = logm[2];
                const float v1 = 1.4142135623730951f * L0_1;
                const float L0_0_gap = L0_0 - L1_1;
                const float entry_0_0_2 = L0_1 * L0_1 + 0.25f * (L0_0_gap * L0_0_gap);
                float entry_0_0_2_eigh[2];
                {
                    const float in_0[1] = {entry_0_0_2};
                    symmetric_eigh_1_f(in_0, entry_0_0_2_eigh);
                }
                float log_sinhc_sqrtm[1];
                symmetric_log_sinhc_sqrt_1_f(entry_0_0_2_eigh, log_sinhc_sqrtm);
                const float log_sinhc_sqrtm_value0_0 = log_sinhc_sqrtm[0];
                const float z0 = W0_0 * L0_0 + W0_1 * v1 + W0_2 * L1_1;
                const float z1 = W1_0 * L0_0 + W1_1 * v1 + W1_2 * L1_1;
                const float z2 = W2_0 * L0_0 + W2_1 * v1 + W2_2 * L1_1;
                const float gap = -log_sinhc_sqrtm_value0_0 - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
                const float phi = amplitude_k * expf(gap);
                const float by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                float log_sinhc_sqrtm_slope[1];
                {
                    const float in_0[1] = {-1.0f};
                    symmetric_log_sinhc_sqrt_1_derivative1_f(entry_0_0_2_eigh, in_0, log_sinhc_sqrtm_slope);
                }
                const float by_entry_0_0_2 = log_sinhc_sqrtm_slope[0];
                const float product = L0_0_gap * (0.5f * by_entry_0_0_2);
                const float total_6 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0 + product;
                const float gap_2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0 - product;
                float logm_slope[3];
                {
                    const float in_0[3] = {total_6, 0.5f * (L0_1 * (2.0f * by_entry_0_0_2) + 1.4142135623730951f * by_v1), gap_2};
                    symmetric_log_2_derivative1_f(entry_0_0_eigh, in_0, logm_slope);
                }
                const float by_entry_0_0 = logm_slope[0];
                const float by_entry_1_1 = logm_slope[2];
                const float by_entry_0_1 = 2.0f * logm_slope[1];
                const float product_2 = r0_1_product * by_entry_0_1;
                const float total_7 = r1_1 * by_entry_1_1 + product_2;
                const float total_8 = r0_1 * by_entry_1_1 + r0_0_product * by_entry_0_1;
                const float total_9 = r1_1_product * by_entry_0_1 + r0_1 * by_entry_0_0;
                const float exponent_by_x3 = r1_1 * total_7 + r0_1 * total_9;
                const float exponent_by_x1 = r0_1 * total_7 + r0_0 * total_9;
                const float total_10 = product_2 + r0_0 * by_entry_0_0;
                const float exponent_by_x2 = r1_1 * total_8 + r0_1 * total_10;
                const float exponent_by_x0 = r0_1 * total_8 + r0_0 * total_10;
                const float df0 = phi * exponent_by_x0;
                const float df1 = phi * exponent_by_x1;
                const float df2 = phi * exponent_by_x2;
                const float df3 = phi * exponent_by_x3;
                const float p_0_1_2 = 0.5f * x_block[1][lane] + 0.5f * x_block[2][lane];
                float p_0_1_eigh_2[6];
                {
                    const float in_0[3] = {x_block[0][lane], p_0_1_2, x_block[3][lane]};
                    symmetric_eigh_2_f(in_0, p_0_1_eigh_2);
                }
                float sqrtm[3];
                symmetric_sqrt_2_f(p_0_1_eigh_2, sqrtm);
                const float sqrtm_p0_0 = sqrtm[0];
                const float sqrtm_p0_1 = sqrtm[1];
                const float sqrtm_p1_1 = sqrtm[2];
                const float sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
                const float gradient0 = df0 * (sqrtm_p0_0 * sqrtm_p0_0) + df3 * sqrtm_p0_1_squared + sqrtm_p0_1 * (df1 *
                    sqrtm_p0_0) + sqrtm_p0_1 * (df2 * sqrtm_p0_0);
                const float total_11 = 0.7071067811865476f * sqrtm_p0_1_squared + 1.4142135623730951f * (sqrtm_p1_1 *
                    (0.5f * sqrtm_p0_0));
                const float gradient1 = df1 * total_11 + df2 * total_11 + 1.4142135623730951f * (sqrtm_p0_1 * (df0 *
                    sqrtm_p0_0)) + 1.4142135623730951f * (sqrtm_p1_1 * (df3 * sqrtm_p0_1));
                const float gradient2 = df0 * sqrtm_p0_1_squared + df3 * (sqrtm_p1_1 * sqrtm_p1_1) + sqrtm_p1_1 * (df1 *
                    sqrtm_p0_1) + sqrtm_p1_1 * (df2 * sqrtm_p0_1);
                sum[0][lane] += phi;
                sum[1][lane] += gradient0;
                sum[2][lane] += gradient1;
                sum[3][lane] += gradient2;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 3; ++i) gradient[3 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void spd_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *SPD_RESTRICT x,
    const float *SPD_RESTRICT mu,
    const float *SPD_RESTRICT W,
    const float *SPD_RESTRICT amplitude,
    const float *SPD_RESTRICT value_bar,
    const float *SPD_RESTRICT gradient_bar,
    float *SPD_RESTRICT mu_bar,
    float *SPD_RESTRICT W_bar,
    float *SPD_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 4 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 9 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[4][LANES], value_bar_block[1][LANES], gradient_bar_block[3][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const float weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 4; ++i) x_block[i][lane] = x[4 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] = gradient_bar[3 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            float sum[14][LANES] = {{0}}, total[14] = {0};
            const float mu0 = mu[4 * k + 0];
            const float mu1 = mu[4 * k + 1];
            const float mu2 = mu[4 * k + 2];
            const float mu3 = mu[4 * k + 3];
            const float W0_0 = W[9 * k + 0];
            const float W0_1 = W[9 * k + 1];
            const float W0_2 = W[9 * k + 2];
            const float W1_0 = W[9 * k + 3];
            const float W1_1 = W[9 * k + 4];
            const float W1_2 = W[9 * k + 5];
            const float W2_0 = W[9 * k + 6];
            const float W2_1 = W[9 * k + 7];
            const float W2_2 = W[9 * k + 8];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float p_0_1 = 0.5f * mu1 + 0.5f * mu2;
                float p_0_1_eigh[6];
                {
                    const float in_0[3] = {mu0, p_0_1, mu3};
                    symmetric_eigh_2_f(in_0, p_0_1_eigh);
                }
                float invsqrtm[3];
                symmetric_invsqrt_2_f(p_0_1_eigh, invsqrtm);
                const float r0_0 = invsqrtm[0];
                const float r0_1 = invsqrtm[1];
                const float r1_1 = invsqrtm[2];
                const float total_2 = x_block[0][lane] * r0_0 + x_block[2][lane] * r0_1;
                const float total_3 = x_block[1][lane] * r0_0 + x_block[3][lane] * r0_1;
                const float entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
                const float r0_0_product = 0.5f * r0_0;
                const float total_4 = x_block[0][lane] * r0_1 + x_block[2][lane] * r1_1;
                const float r0_1_product = 0.5f * r0_1;
                const float total_5 = x_block[1][lane] * r0_1 + x_block[3][lane] * r1_1;
                const float r1_1_product = 0.5f * r1_1;
                const float entry_0_1 = r0_0_product * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
                    * r1_1_product;
                const float entry_1_1 = r0_1 * total_4 + r1_1 * total_5;
                float entry_0_0_eigh[6];
                {
                    const float in_0[3] = {entry_0_0, entry_0_1, entry_1_1};
                    symmetric_eigh_2_f(in_0, entry_0_0_eigh);
                }
                float logm[3];
                symmetric_log_2_f(entry_0_0_eigh, logm);
                const float L0_0 = logm[0];
                const float L0_1 = logm[1];
                const float L1_1 = logm[2];
                const float v1 = 1.4142135623730951f * L0_1;
                const float L0_0_gap = L0_0 - L1_1;
                const float entry_0_0_2 = L0_1 * L0_1 + 0.25f * (L0_0_gap * L0_0_gap);
                float entry_0_0_2_eigh[2];
                {
                    const float in_0[1] = {entry_0_0_2};
                    symmetric_eigh_1_f(in_0, entry_0_0_2_eigh);
                }
                float log_sinhc_sqrtm[1];
                symmetric_log_sinhc_sqrt_1_f(entry_0_0_2_eigh, log_sinhc_sqrtm);
                const float log_sinhc_sqrtm_value0_0 = log_sinhc_sqrtm[0];
                const float z0 = W0_0 * L0_0 + W0_1 * v1 + W0_2 * L1_1;
                const float z1 = W1_0 * L0_0 + W1_1 * v1 + W1_2 * L1_1;
                const float z2 = W2_0 * L0_0 + W2_1 * v1 + W2_2 * L1_1;
                const float gap = -log_sinhc_sqrtm_value0_0 - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
                const float exp_2 = expf(gap);
                const float phi = amplitude_k * exp_2;
                const float by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                float log_sinhc_sqrtm_slope[1];
                {
                    const float in_0[1] = {-1.0f};
                    symmetric_log_sinhc_sqrt_1_derivative1_f(entry_0_0_2_eigh, in_0, log_sinhc_sqrtm_slope);
                }
                const float by_entry_0_0_2 = log_sinhc_sqrtm_slope[0];
                const float product = 0.5f * by_entry_0_0_2;
                const float product_2 = L0_0_gap * product;
                const float total_6 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0 + product_2;
                const float gap_2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0 - product_2;
                const float product_3 = 2.0f * by_entry_0_0_2;
                const float product_4 = 0.5f * (L0_1 * product_3 + 1.4142135623730951f * by_v1);
                float logm_slope[3];
                {
                    const float in_0[3] = {total_6, product_4, gap_2};
                    symmetric_log_2_derivative1_f(entry_0_0_eigh, in_0, logm_slope);
                }
                const float by_entry_0_0 = logm_slope[0];
                const float by_entry_1_1 = logm_slope[2];
                const float by_entry_0_1 = 2.0f * logm_slope[1];
                const float product_5 = r0_1_product * by_entry_0_1;
                const float total_7 = r1_1 * by_entry_1_1 + product_5;
                const float total_8 = r0_1 * by_entry_1_1 + r0_0_product * by_entry_0_1;
                const float total_9 = r1_1_product * by_entry_0_1 + r0_1 * by_entry_0_0;
                const float exponent_by_x3 = r1_1 * total_7 + r0_1 * total_9;
                const float exponent_by_x1 = r0_1 * total_7 + r0_0 * total_9;
                const float total_10 = product_5 + r0_0 * by_entry_0_0;
                const float exponent_by_x2 = r1_1 * total_8 + r0_1 * total_10;
                const float exponent_by_x0 = r0_1 * total_8 + r0_0 * total_10;
                const float p_0_1_2 = 0.5f * x_block[1][lane] + 0.5f * x_block[2][lane];
                float p_0_1_eigh_2[6];
                {
                    const float in_0[3] = {x_block[0][lane], p_0_1_2, x_block[3][lane]};
                    symmetric_eigh_2_f(in_0, p_0_1_eigh_2);
                }
                float sqrtm[3];
                symmetric_sqrt_2_f(p_0_1_eigh_2, sqrtm);
                const float sqrtm_p0_0 = sqrtm[0];
                const float sqrtm_p0_1 = sqrtm[1];
                const float sqrtm_p1_1 = sqrtm[2];
                const float sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
                const float product_6 = 1.4142135623730951f * gradient_bar_block[1][lane];
                const float product_7 = (0.7071067811865476f * sqrtm_p0_1_squared + 1.4142135623730951f * (sqrtm_p1_1 *
                    (0.5f * sqrtm_p0_0))) * gradient_bar_block[1][lane];
                const float by_df2 = sqrtm_p0_1 * (sqrtm_p1_1 * gradient_bar_block[2][lane]) + product_7 + sqrtm_p0_0 *
                    (sqrtm_p0_1 * gradient_bar_block[0][lane]);
                const float by_df3 = sqrtm_p1_1 * sqrtm_p1_1 * gradient_bar_block[2][lane] + sqrtm_p0_1 * (sqrtm_p1_1 *
                    product_6) + sqrtm_p0_1_squared * gradient_bar_block[0][lane];
                const float by_df0 = sqrtm_p0_1_squared * gradient_bar_block[2][lane] + sqrtm_p0_0 * (sqrtm_p0_1 *
                    product_6) + sqrtm_p0_0 * sqrtm_p0_0 * gradient_bar_block[0][lane];
                const float by_exponent_by_x3 = phi * by_df3;
                const float by_exponent_by_x2 = phi * by_df2;
                const float by_exponent_by_x0 = phi * by_df0;
                const float by_phi = value_bar_block[0][lane] + exponent_by_x3 * by_df3 + exponent_by_x2 * by_df2 +
                    exponent_by_x1 * by_df2 + exponent_by_x0 * by_df0;
                const float r0_1_product_2 = r0_1 * by_exponent_by_x2;
                const float total_11 = r0_0 * by_exponent_by_x0 + r0_1_product_2;
                const float total_12 = r0_0 * by_exponent_by_x2 + r0_1 * by_exponent_by_x3;
                const float total_13 = r0_0 * total_11 + r0_1 * total_12;
                const float total_14 = r0_1 * by_exponent_by_x0 + r1_1 * by_exponent_by_x2;
                const float total_15 = total_10 * by_exponent_by_x2 + total_9 * by_exponent_by_x3 + by_entry_0_0 *
                    total_12 + total_8 * by_exponent_by_x0 + total_7 * by_exponent_by_x2;
                const float total_16 = r0_1_product_2 + r1_1 * by_exponent_by_x3;
                const float total_17 = total_11 + total_16;
                const float by_by_entry_0_1 = r0_0_product * total_14 + r0_1_product * total_17 + r1_1_product * total_12;
                const float total_18 = r0_1 * total_14 + r1_1 * total_16;
                float logm_derivative2[3];
                {
                    const float in_0[3] = {total_6, product_4, gap_2};
                    const float in_1[3] = {total_13, by_by_entry_0_1, total_18};
                    symmetric_log_2_derivative2_f(entry_0_0_eigh, in_0, in_1, logm_derivative2);
                }
                float logm_slope_2[3];
                {
                    const float in_0[3] = {total_13, by_by_entry_0_1, total_18};
                    symmetric_log_2_derivative1_f(entry_0_0_eigh, in_0, logm_slope_2);
                }
                const float by_by_v1 = 1.4142135623730951f * logm_slope_2[1];
                const float gap_3 = logm_slope_2[0] - logm_slope_2[2];
                float log_sinhc_sqrtm_derivative2[1];
                {
                    const float in_0[1] = {-1.0f};
                    const float in_1[1] = {2.0f * (L0_1 * logm_slope_2[1]) + 0.5f * (L0_0_gap * gap_3)};
                    symmetric_log_sinhc_sqrt_1_derivative2_f(entry_0_0_2_eigh, in_0, in_1, log_sinhc_sqrtm_derivative2);
                }
                const float product_8 = exp_2 * (amplitude_k * by_phi);
                const float by_z2 = -(W2_0 * logm_slope_2[0]) - W2_1 * by_by_v1 - W2_2 * logm_slope_2[2] - z2 * product_8;
                const float by_z1 = -(W1_0 * logm_slope_2[0]) - W1_1 * by_by_v1 - W1_2 * logm_slope_2[2] - z1 * product_8;
                const float by_z0 = -(W0_0 * logm_slope_2[0]) - W0_1 * by_by_v1 - W0_2 * logm_slope_2[2] - z0 * product_8;
                const float by_v1_2 = W2_1 * by_z2 + W1_1 * by_z1 + W0_1 * by_z0;
                float log_sinhc_sqrtm_slope_2[1];
                {
                    const float in_0[1] = {-product_8};
                    symmetric_log_sinhc_sqrt_1_derivative1_f(entry_0_0_2_eigh, in_0, log_sinhc_sqrtm_slope_2);
                }
                const float by_entry_0_0_2_2 = log_sinhc_sqrtm_derivative2[0] + log_sinhc_sqrtm_slope_2[0];
                const float total_19 = product * gap_3 + L0_0_gap * (0.5f * by_entry_0_0_2_2);
                const float product_9 = 0.5f * (product_3 * logm_slope_2[1] + L0_1 * (2.0f * by_entry_0_0_2_2) +
                    1.4142135623730951f * by_v1_2);
                float logm_slope_3[3];
                {
                    const float in_0[3] = {W2_0 * by_z2 + W1_0 * by_z1 + W0_0 * by_z0 + total_19, product_9, W2_2 * by_z2 + W1_2 * by_z1 + W0_2 * by_z0 - total_19};
                    symmetric_log_2_derivative1_f(entry_0_0_eigh, in_0, logm_slope_3);
                }
                const float by_entry_0_0_3 = logm_derivative2[0] + logm_slope_3[0];
                const float by_entry_0_1_2 = 2.0f * logm_derivative2[1] + 2.0f * logm_slope_3[1];
                const float by_entry_1_1_2 = logm_derivative2[2] + logm_slope_3[2];
                const float total_20 = total_8 * by_exponent_by_x2 + total_7 * by_exponent_by_x3 + by_entry_1_1 * total_16
                    + total_5 * by_entry_1_1_2 + 0.5f * (by_entry_0_1 * total_12 + total_3 * by_entry_0_1_2);
                const float product_10 = r0_1_product * by_entry_0_1_2;
                const float total_21 = r1_1 * by_entry_1_1_2 + product_10;
                const float total_22 = total_15 + by_entry_1_1 * total_14 + total_4 * by_entry_1_1_2 + x_block[1][lane] *
                    total_21 + 0.5f * (by_entry_0_1 * total_17 + total_5 * by_entry_0_1_2 + total_2 * by_entry_0_1_2);
                const float total_23 = r0_1 * by_entry_1_1_2 + r0_0_product * by_entry_0_1_2;
                const float total_24 = r1_1_product * by_entry_0_1_2 + r0_1 * by_entry_0_0_3;
                const float total_25 = total_10 * by_exponent_by_x0 + by_entry_0_0 * total_11 + total_9 *
                    by_exponent_by_x2 + 0.5f * (by_entry_0_1 * total_14 + total_4 * by_entry_0_1_2) + x_block[1][lane] *
                    total_24;
                const float total_26 = product_10 + r0_0 * by_entry_0_0_3;
                const float total_27 = total_22 + x_block[0][lane] * total_23 + total_3 * by_entry_0_0_3 +
                    x_block[3][lane] * total_24 + x_block[2][lane] * total_26;
                float invsqrtm_slope[3];
                {
                    const float in_0[3] = {total_25 + total_2 * by_entry_0_0_3 + x_block[0][lane] * total_26, 0.5f * total_27, total_20 + x_block[3][lane] * total_21 + x_block[2][lane] * total_23};
                    symmetric_invsqrt_2_derivative1_f(p_0_1_eigh, in_0, invsqrtm_slope);
                }
                sum[0][lane] += invsqrtm_slope[0];
                sum[1][lane] += invsqrtm_slope[1];
                sum[2][lane] += invsqrtm_slope[1];
                sum[3][lane] += invsqrtm_slope[2];
                sum[4][lane] += L0_0 * by_z0 - z0 * logm_slope_2[0];
                sum[5][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[6][lane] += L1_1 * by_z0 - z0 * logm_slope_2[2];
                sum[7][lane] += L0_0 * by_z1 - z1 * logm_slope_2[0];
                sum[8][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[9][lane] += L1_1 * by_z1 - z1 * logm_slope_2[2];
                sum[10][lane] += L0_0 * by_z2 - z2 * logm_slope_2[0];
                sum[11][lane] += v1 * by_z2 - z2 * by_by_v1;
                sum[12][lane] += L1_1 * by_z2 - z2 * logm_slope_2[2];
                sum[13][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 14; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[4 * k + 0] += total[0];
            mu_bar[4 * k + 1] += total[1];
            mu_bar[4 * k + 2] += total[2];
            mu_bar[4 * k + 3] += total[3];
            W_bar[9 * k + 0] += total[4];
            W_bar[9 * k + 1] += total[5];
            W_bar[9 * k + 2] += total[6];
            W_bar[9 * k + 3] += total[7];
            W_bar[9 * k + 4] += total[8];
            W_bar[9 * k + 5] += total[9];
            W_bar[9 * k + 6] += total[10];
            W_bar[9 * k + 7] += total[11];
            W_bar[9 * k + 8] += total[12];
            amplitude_bar[1 * k + 0] += total[13];
        }
    }
    restore_denormals(mode);
}
