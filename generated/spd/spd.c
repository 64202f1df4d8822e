/*
 * spd: Symmetric positive definite n x n matrices with the affine-invariant metric trace(P^-1 dP P^-1 dP).
 *
 * See the header for what the functions promise.
 */

#include "spd.h"

#include <float.h>

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

static double scalar_exp(double x) { return exp(x); }

static double scalar_invsqrt(double x) { return 1 / sqrt(x); }

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

/* exp(A) of the eigen-decomposition of A, packed. */
static void symmetric_exp_2(const double *eigh, double *out) {
    double w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_exp(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_2(eigh, (const double (*)[2])total, out);
}

/* invsqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_invsqrt_2(const double *eigh, double *out) {
    double w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_invsqrt(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
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

/* sqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_sqrt_2(const double *eigh, double *out) {
    double w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_sqrt(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_2(eigh, (const double (*)[2])total, out);
}

/* where(eigh(S)[0] > 0, S, sqrtm(S * S)) */
void spd_project(const double *SPD_RESTRICT x, double *SPD_RESTRICT p_out) {
    const double S0_1 = 0.5 * x[1] + 0.5 * x[2];
    const double S0_1_squared = S0_1 * S0_1;
    const double S_times_S_0_0 = S0_1_squared + x[0] * x[0];
    const double S_times_S_0_1 = x[0] * S0_1 + x[3] * S0_1;
    const double S_times_S_1_1 = S0_1_squared + x[3] * x[3];
    double S0_1_eigh[6];
    {
        const double in_0[3] = {x[0], S0_1, x[3]};
        symmetric_eigh_2(in_0, S0_1_eigh);
    }
    const int is_less = 0.0 < S0_1_eigh[0];
    double eigh[6];
    {
        const double in_0[3] = {(is_less ? 1.0 : S_times_S_0_0), (is_less ? 0.0 : S_times_S_0_1), (is_less ? 1.0 : S_times_S_1_1)};
        symmetric_eigh_2(in_0, eigh);
    }
    double sqrtm[3];
    symmetric_sqrt_2(eigh, sqrtm);
    const double sqrtm_S_times_S0_0 = sqrtm[0];
    const double p0 = (is_less ? x[0] : sqrtm_S_times_S0_0);
    const double sqrtm_S_times_S0_1 = sqrtm[1];
    const double p1 = (is_less ? S0_1 : sqrtm_S_times_S0_1);
    const double sqrtm_S_times_S1_1 = sqrtm[2];
    const double p3 = (is_less ? x[3] : sqrtm_S_times_S1_1);
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p1;
    p_out[3] = p3;
}

void spd_project_batch(size_t count, const double *SPD_RESTRICT x, double *SPD_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) spd_project(x + 4 * i, p_out + 4 * i);
}

/* (E E^T)^-1 E x */
void spd_to_tangent(const double *SPD_RESTRICT p, const double *SPD_RESTRICT x, double *SPD_RESTRICT v_out) {
    const double p_0_1 = 0.5 * p[1] + 0.5 * p[2];
    double p_0_1_eigh[6];
    {
        const double in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2(in_0, p_0_1_eigh);
    }
    double sqrtm[3];
    symmetric_sqrt_2(p_0_1_eigh, sqrtm);
    const double sqrtm_p0_0 = sqrtm[0];
    const double sqrtm_p0_1 = sqrtm[1];
    const double sqrtm_p1_1 = sqrtm[2];
    const double e0_0 = sqrtm_p0_0 * sqrtm_p0_0;
    const double e0_1 = sqrtm_p0_0 * sqrtm_p0_1;
    const double e0_3 = sqrtm_p0_1 * sqrtm_p0_1;
    const double e1_0 = 1.4142135623730951 * e0_1;
    const double e1_1 = 0.7071067811865476 * e0_3 + 1.4142135623730951 * (sqrtm_p1_1 * (0.5 * sqrtm_p0_0));
    const double e2_1 = sqrtm_p0_1 * sqrtm_p1_1;
    const double e1_3 = 1.4142135623730951 * e2_1;
    const double e2_3 = sqrtm_p1_1 * sqrtm_p1_1;
    const double e0_squared = e0_0 * e0_0 + e0_3 * e0_3 + 2.0 * (e0_1 * e0_1);
    const double part0 = (x[0] * e0_0 + x[1] * e0_1 + x[2] * e0_1 + x[3] * e0_3) / e0_squared;
    const double rest_0 = x[0] - e0_0 * part0;
    const double e0_1_product = e0_1 * part0;
    const double rest_1 = x[1] - e0_1_product;
    const double rest_2 = x[2] - e0_1_product;
    const double rest_3 = x[3] - e0_3 * part0;
    const double e0_1_product_2 = 2.0 * e0_1;
    const double shear0_1 = (e0_0 * e1_0 + e0_3 * e1_3 + e1_1 * e0_1_product_2) / e0_squared;
    const double e1_0_2 = e1_0 - e0_0 * shear0_1;
    const double e1_1_2 = e1_1 - e0_1 * shear0_1;
    const double e1_3_2 = e1_3 - e0_3 * shear0_1;
    const double shear0_2 = (e0_0 * e0_3 + e0_3 * e2_3 + e2_1 * e0_1_product_2) / e0_squared;
    const double e2_0 = e0_3 - e0_0 * shear0_2;
    const double e2_1_2 = e2_1 - e0_1 * shear0_2;
    const double e2_3_2 = e2_3 - e0_3 * shear0_2;
    const double e1_squared = e1_0_2 * e1_0_2 + e1_3_2 * e1_3_2 + 2.0 * (e1_1_2 * e1_1_2);
    const double part1 = (rest_0 * e1_0_2 + rest_1 * e1_1_2 + rest_2 * e1_1_2 + rest_3 * e1_3_2) / e1_squared;
    const double rest_0_2 = rest_0 - e1_0_2 * part1;
    const double e1_1_2_product = e1_1_2 * part1;
    const double rest_1_2 = rest_1 - e1_1_2_product;
    const double rest_2_2 = rest_2 - e1_1_2_product;
    const double rest_3_2 = rest_3 - e1_3_2 * part1;
    const double shear1_2 = (e1_0_2 * e2_0 + e1_3_2 * e2_3_2 + e2_1_2 * (2.0 * e1_1_2)) / e1_squared;
    const double e2_0_2 = e2_0 - e1_0_2 * shear1_2;
    const double e2_1_3 = e2_1_2 - e1_1_2 * shear1_2;
    const double e2_3_3 = e2_3_2 - e1_3_2 * shear1_2;
    const double e2_squared = e2_0_2 * e2_0_2 + e2_3_3 * e2_3_3 + 2.0 * (e2_1_3 * e2_1_3);
    const double part2 = (rest_0_2 * e2_0_2 + rest_1_2 * e2_1_3 + rest_2_2 * e2_1_3 + rest_3_2 * e2_3_3) /
        e2_squared;
    const double component1 = part1 - shear1_2 * part2;
    const double component0 = part0 - shear0_1 * component1 - shear0_2 * part2;
    v_out[0] = component0;
    v_out[1] = component1;
    v_out[2] = part2;
}

void spd_to_tangent_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT x,
    double *SPD_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) spd_to_tangent(p + 4 * i, x + 4 * i, v_out + 3 * i);
}

/* dot(u, v) */
double spd_inner(const double *SPD_RESTRICT p, const double *SPD_RESTRICT u, const double *SPD_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void spd_inner_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT u,
    const double *SPD_RESTRICT v,
    double *SPD_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = spd_inner(p + 4 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(<v, v>_p) */
double spd_norm(const double *SPD_RESTRICT p, const double *SPD_RESTRICT v) {
    (void)p;
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void spd_norm_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT v,
    double *SPD_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = spd_norm(p + 4 * i, v + 3 * i);
}

/* G(p) v */
void spd_flat(const double *SPD_RESTRICT p, const double *SPD_RESTRICT v, double *SPD_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void spd_flat_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT v,
    double *SPD_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) spd_flat(p + 4 * i, v + 3 * i, covector_out + 3 * i);
}

/* s * expm(smat(v)) * s */
void spd_exp(const double *SPD_RESTRICT p, const double *SPD_RESTRICT v, double *SPD_RESTRICT q_out) {
    const double p_0_1 = 0.5 * p[1] + 0.5 * p[2];
    double p_0_1_eigh[6];
    {
        const double in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2(in_0, p_0_1_eigh);
    }
    double sqrtm[3];
    symmetric_sqrt_2(p_0_1_eigh, sqrtm);
    const double s0_0 = sqrtm[0];
    const double s0_1 = sqrtm[1];
    const double s1_1 = sqrtm[2];
    const double smat_v_0_1 = 0.7071067811865476 * v[1];
    double smat_v_0_1_eigh[6];
    {
        const double in_0[3] = {v[0], smat_v_0_1, v[2]};
        symmetric_eigh_2(in_0, smat_v_0_1_eigh);
    }
    double expm[3];
    symmetric_exp_2(smat_v_0_1_eigh, expm);
    const double expm_smat_v0_0 = expm[0];
    const double expm_smat_v0_1 = expm[1];
    const double expm_smat_v1_1 = expm[2];
    const double s0_1_product = s0_1 * expm_smat_v0_1;
    const double total_2 = s0_0 * expm_smat_v0_0 + s0_1_product;
    const double total_3 = s0_0 * expm_smat_v0_1 + s0_1 * expm_smat_v1_1;
    const double q0 = s0_0 * total_2 + s0_1 * total_3;
    const double q1 = s0_1 * total_2 + s1_1 * total_3;
    const double total_4 = s0_1 * expm_smat_v0_0 + s1_1 * expm_smat_v0_1;
    const double total_5 = s0_1_product + s1_1 * expm_smat_v1_1;
    const double q2 = s0_0 * total_4 + s0_1 * total_5;
    const double q3 = s0_1 * total_4 + s1_1 * total_5;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
}

void spd_exp_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT v,
    double *SPD_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) spd_exp(p + 4 * i, v + 3 * i, q_out + 4 * i);
}

/* svec(L) */
void spd_log(const double *SPD_RESTRICT p, const double *SPD_RESTRICT q, double *SPD_RESTRICT v_out) {
    const double p_0_1 = 0.5 * p[1] + 0.5 * p[2];
    double p_0_1_eigh[6];
    {
        const double in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2(in_0, p_0_1_eigh);
    }
    double invsqrtm[3];
    symmetric_invsqrt_2(p_0_1_eigh, invsqrtm);
    const double r0_0 = invsqrtm[0];
    const double r0_1 = invsqrtm[1];
    const double r1_1 = invsqrtm[2];
    const double total_2 = q[0] * r0_0 + q[2] * r0_1;
    const double total_3 = q[1] * r0_0 + q[3] * r0_1;
    const double entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
    const double total_4 = q[0] * r0_1 + q[2] * r1_1;
    const double r0_1_product = 0.5 * r0_1;
    const double total_5 = q[1] * r0_1 + q[3] * r1_1;
    const double entry_0_1 = 0.5 * r0_0 * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
        * (0.5 * r1_1);
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
    v_out[0] = L0_0;
    v_out[1] = v1;
    v_out[2] = L1_1;
}

void spd_log_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT q,
    double *SPD_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) spd_log(p + 4 * i, q + 4 * i, v_out + 3 * i);
}

/* norm(L) */
double spd_distance(const double *SPD_RESTRICT p, const double *SPD_RESTRICT q) {
    const double p_0_1 = 0.5 * p[1] + 0.5 * p[2];
    double p_0_1_eigh[6];
    {
        const double in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2(in_0, p_0_1_eigh);
    }
    double invsqrtm[3];
    symmetric_invsqrt_2(p_0_1_eigh, invsqrtm);
    const double r0_0 = invsqrtm[0];
    const double r0_1 = invsqrtm[1];
    const double r1_1 = invsqrtm[2];
    const double total_2 = q[0] * r0_0 + q[2] * r0_1;
    const double total_3 = q[1] * r0_0 + q[3] * r0_1;
    const double entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
    const double total_4 = q[0] * r0_1 + q[2] * r1_1;
    const double r0_1_product = 0.5 * r0_1;
    const double total_5 = q[1] * r0_1 + q[3] * r1_1;
    const double entry_0_1 = 0.5 * r0_0 * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
        * (0.5 * r1_1);
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
    const double norm_L_squared = L0_0 * L0_0 + L1_1 * L1_1 + 2.0 * (L0_1 * L0_1);
    const double norm_L = sqrt(norm_L_squared);
    return norm_L;
}

void spd_distance_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT q,
    double *SPD_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = spd_distance(p + 4 * i, q + 4 * i);
}

/* -trace(log_sinhc_sqrtm(ad_squared(L) / 4)) */
double spd_log_abs_det(const double *SPD_RESTRICT p, const double *SPD_RESTRICT q) {
    const double p_0_1 = 0.5 * p[1] + 0.5 * p[2];
    double p_0_1_eigh[6];
    {
        const double in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2(in_0, p_0_1_eigh);
    }
    double invsqrtm[3];
    symmetric_invsqrt_2(p_0_1_eigh, invsqrtm);
    const double r0_0 = invsqrtm[0];
    const double r0_1 = invsqrtm[1];
    const double r1_1 = invsqrtm[2];
    const double total_2 = q[0] * r0_0 + q[2] * r0_1;
    const double total_3 = q[1] * r0_0 + q[3] * r0_1;
    const double entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
    const double total_4 = q[0] * r0_1 + q[2] * r1_1;
    const double r0_1_product = 0.5 * r0_1;
    const double total_5 = q[1] * r0_1 + q[3] * r1_1;
    const double entry_0_1 = 0.5 * r0_0 * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
        * (0.5 * r1_1);
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
    return -log_sinhc_sqrtm_value0_0;
}

void spd_log_abs_det_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT q,
    double *SPD_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = spd_log_abs_det(p + 4 * i, q + 4 * i);
}

/* G^-1 E df */
void spd_riemannian_gradient(
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT df,
    double *SPD_RESTRICT gradient_out) {
    const double p_0_1 = 0.5 * p[1] + 0.5 * p[2];
    double p_0_1_eigh[6];
    {
        const double in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2(in_0, p_0_1_eigh);
    }
    double sqrtm[3];
    symmetric_sqrt_2(p_0_1_eigh, sqrtm);
    const double sqrtm_p0_0 = sqrtm[0];
    const double sqrtm_p0_1 = sqrtm[1];
    const double sqrtm_p1_1 = sqrtm[2];
    const double sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
    const double gradient0 = df[0] * (sqrtm_p0_0 * sqrtm_p0_0) + df[3] * sqrtm_p0_1_squared + sqrtm_p0_1 *
        (df[1] * sqrtm_p0_0) + sqrtm_p0_1 * (df[2] * sqrtm_p0_0);
    const double total_2 = 0.7071067811865476 * sqrtm_p0_1_squared + 1.4142135623730951 * (sqrtm_p1_1 * (0.5 *
        sqrtm_p0_0));
    const double gradient1 = df[1] * total_2 + df[2] * total_2 + 1.4142135623730951 * (sqrtm_p0_1 * (df[0] *
        sqrtm_p0_0)) + 1.4142135623730951 * (sqrtm_p1_1 * (df[3] * sqrtm_p0_1));
    const double gradient2 = df[0] * sqrtm_p0_1_squared + df[3] * (sqrtm_p1_1 * sqrtm_p1_1) + sqrtm_p1_1 *
        (df[1] * sqrtm_p0_1) + sqrtm_p1_1 * (df[2] * sqrtm_p0_1);
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void spd_riemannian_gradient_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT df,
    double *SPD_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) spd_riemannian_gradient(p + 4 * i, df + 4 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
double spd_gradient_norm(const double *SPD_RESTRICT p, const double *SPD_RESTRICT df) {
    const double p_0_1 = 0.5 * p[1] + 0.5 * p[2];
    double p_0_1_eigh[6];
    {
        const double in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2(in_0, p_0_1_eigh);
    }
    double sqrtm[3];
    symmetric_sqrt_2(p_0_1_eigh, sqrtm);
    const double sqrtm_p0_0 = sqrtm[0];
    const double sqrtm_p0_1 = sqrtm[1];
    const double sqrtm_p1_1 = sqrtm[2];
    const double sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
    const double gradient0 = df[0] * (sqrtm_p0_0 * sqrtm_p0_0) + df[3] * sqrtm_p0_1_squared + sqrtm_p0_1 *
        (df[1] * sqrtm_p0_0) + sqrtm_p0_1 * (df[2] * sqrtm_p0_0);
    const double total_2 = 0.7071067811865476 * sqrtm_p0_1_squared + 1.4142135623730951 * (sqrtm_p1_1 * (0.5 *
        sqrtm_p0_0));
    const double gradient1 = df[1] * total_2 + df[2] * total_2 + 1.4142135623730951 * (sqrtm_p0_1 * (df[0] *
        sqrtm_p0_0)) + 1.4142135623730951 * (sqrtm_p1_1 * (df[3] * sqrtm_p0_1));
    const double gradient2 = df[0] * sqrtm_p0_1_squared + df[3] * (sqrtm_p1_1 * sqrtm_p1_1) + sqrtm_p1_1 *
        (df[1] * sqrtm_p0_1) + sqrtm_p1_1 * (df[2] * sqrtm_p0_1);
    return sqrt(gradient0 * gradient0 + gradient1 * gradient1 + gradient2 * gradient2);
}

void spd_gradient_norm_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT df,
    double *SPD_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = spd_gradient_norm(p + 4 * i, df + 4 * i);
}

/* svec(O * smat(v) * transpose(O)) */
void spd_transport(
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT q,
    const double *SPD_RESTRICT v,
    double *SPD_RESTRICT w_out) {
    const double p_0_1 = 0.5 * p[1] + 0.5 * p[2];
    double p_0_1_eigh[6];
    {
        const double in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2(in_0, p_0_1_eigh);
    }
    double invsqrtm[3];
    symmetric_invsqrt_2(p_0_1_eigh, invsqrtm);
    const double r0_0 = invsqrtm[0];
    const double r0_1 = invsqrtm[1];
    const double r1_1 = invsqrtm[2];
    const double total_2 = q[0] * r0_0 + q[2] * r0_1;
    const double total_3 = q[1] * r0_0 + q[3] * r0_1;
    const double entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
    const double total_4 = q[0] * r0_1 + q[2] * r1_1;
    const double r0_1_product = 0.5 * r0_1;
    const double total_5 = q[1] * r0_1 + q[3] * r1_1;
    const double entry_0_1 = 0.5 * r0_0 * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
        * (0.5 * r1_1);
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
    const double q_0_1 = 0.5 * q[1] + 0.5 * q[2];
    double q_0_1_eigh[6];
    {
        const double in_0[3] = {q[0], q_0_1, q[3]};
        symmetric_eigh_2(in_0, q_0_1_eigh);
    }
    double invsqrtm_2[3];
    symmetric_invsqrt_2(q_0_1_eigh, invsqrtm_2);
    const double invsqrtm_q0_0 = invsqrtm_2[0];
    const double invsqrtm_q0_1 = invsqrtm_2[1];
    const double invsqrtm_q1_1 = invsqrtm_2[2];
    double sqrtm[3];
    symmetric_sqrt_2(p_0_1_eigh, sqrtm);
    const double sqrtm_p0_0 = sqrtm[0];
    const double sqrtm_p0_1 = sqrtm[1];
    const double sqrtm_p1_1 = sqrtm[2];
    const double L_over_2_0_0 = 0.5 * L0_0;
    const double L_over_2_0_1 = 0.5 * L0_1;
    const double L_over_2_1_1 = 0.5 * L1_1;
    double eigh[6];
    {
        const double in_0[3] = {L_over_2_0_0, L_over_2_0_1, L_over_2_1_1};
        symmetric_eigh_2(in_0, eigh);
    }
    double expm[3];
    symmetric_exp_2(eigh, expm);
    const double expm_L_over_20_0 = expm[0];
    const double expm_L_over_20_1 = expm[1];
    const double expm_L_over_21_1 = expm[2];
    const double product = invsqrtm_q0_1 * sqrtm_p0_1;
    const double total_6 = invsqrtm_q0_0 * sqrtm_p0_0 + product;
    const double total_7 = invsqrtm_q0_0 * sqrtm_p0_1 + invsqrtm_q0_1 * sqrtm_p1_1;
    const double O0_0 = expm_L_over_20_0 * total_6 + expm_L_over_20_1 * total_7;
    const double O0_1 = expm_L_over_20_1 * total_6 + expm_L_over_21_1 * total_7;
    const double total_8 = invsqrtm_q0_1 * sqrtm_p0_0 + invsqrtm_q1_1 * sqrtm_p0_1;
    const double total_9 = product + invsqrtm_q1_1 * sqrtm_p1_1;
    const double O1_0 = expm_L_over_20_0 * total_8 + expm_L_over_20_1 * total_9;
    const double O1_1 = expm_L_over_20_1 * total_8 + expm_L_over_21_1 * total_9;
    const double total_10 = v[0] * O0_0 + 1.4142135623730951 * (v[1] * (0.5 * O0_1));
    const double total_11 = v[2] * O0_1 + 1.4142135623730951 * (v[1] * (0.5 * O0_0));
    const double w0 = O0_0 * total_10 + O0_1 * total_11;
    const double w1 = 1.4142135623730951 * (O1_0 * total_10 + O1_1 * total_11);
    const double O1_0_product = O1_0 * (v[0] * O1_0 + 1.4142135623730951 * (v[1] * (0.5 * O1_1)));
    const double O1_1_product = O1_1 * (v[2] * O1_1 + 1.4142135623730951 * (v[1] * (0.5 * O1_0)));
    const double w2 = O1_0_product + O1_1_product;
    w_out[0] = w0;
    w_out[1] = w1;
    w_out[2] = w2;
}

void spd_transport_batch(
    size_t count,
    const double *SPD_RESTRICT p,
    const double *SPD_RESTRICT q,
    const double *SPD_RESTRICT v,
    double *SPD_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) spd_transport(p + 4 * i, q + 4 * i, v + 3 * i, w_out + 3 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void spd_splat(
    const double *SPD_RESTRICT x,
    const double *SPD_RESTRICT mu,
    const double *SPD_RESTRICT W,
    double amplitude,
    double *SPD_RESTRICT value_out,
    double *SPD_RESTRICT gradient_out) {
    const double p_0_1 = 0.5 * mu[1] + 0.5 * mu[2];
    double p_0_1_eigh[6];
    {
        const double in_0[3] = {mu[0], p_0_1, mu[3]};
        symmetric_eigh_2(in_0, p_0_1_eigh);
    }
    double invsqrtm[3];
    symmetric_invsqrt_2(p_0_1_eigh, invsqrtm);
    const double r0_0 = invsqrtm[0];
    const double r0_1 = invsqrtm[1];
    const double r1_1 = invsqrtm[2];
    const double total_2 = x[0] * r0_0 + x[2] * r0_1;
    const double total_3 = x[1] * r0_0 + x[3] * r0_1;
    const double entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
    const double total_4 = x[0] * r0_1 + x[2] * r1_1;
    const double r0_1_product = 0.5 * r0_1;
    const double total_5 = x[1] * r0_1 + x[3] * r1_1;
    const double entry_0_1 = 0.5 * r0_0 * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
        * (0.5 * r1_1);
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
    const double z0 = W[0] * L0_0 + W[1] * v1 + W[2] * L1_1;
    const double z1 = W[3] * L0_0 + W[4] * v1 + W[5] * L1_1;
    const double z2 = W[6] * L0_0 + W[7] * v1 + W[8] * L1_1;
    const double gap = -log_sinhc_sqrtm_value0_0 - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
    const double phi = amplitude * exp(gap);
    const double by_v1 = -(W[7] * z2) - W[4] * z1 - W[1] * z0;
    double log_sinhc_sqrtm_slope[1];
    {
        const double in_0[1] = {-1.0};
        symmetric_log_sinhc_sqrt_1_derivative1(entry_0_0_2_eigh, in_0, log_sinhc_sqrtm_slope);
    }
    const double by_entry_0_0_2 = log_sinhc_sqrtm_slope[0];
    const double product = L0_0_gap * (0.5 * by_entry_0_0_2);
    const double total_6 = -(W[6] * z2) - W[3] * z1 - W[0] * z0 + product;
    const double gap_2 = -(W[8] * z2) - W[5] * z1 - W[2] * z0 - product;
    double logm_slope[3];
    {
        const double in_0[3] = {total_6, 0.5 * (L0_1 * (2.0 * by_entry_0_0_2) + 1.4142135623730951 * by_v1), gap_2};
        symmetric_log_2_derivative1(entry_0_0_eigh, in_0, logm_slope);
    }
    const double by_entry_0_0 = logm_slope[0];
    const double by_entry_1_1 = logm_slope[2];
    const double r0_1_product_2 = r0_1 * logm_slope[1];
    const double total_7 = r1_1 * by_entry_1_1 + r0_1_product_2;
    const double total_8 = r0_1 * by_entry_1_1 + r0_0 * logm_slope[1];
    const double total_9 = r1_1 * logm_slope[1] + r0_1 * by_entry_0_0;
    const double exponent_by_x3 = r1_1 * total_7 + r0_1 * total_9;
    const double exponent_by_x1 = r0_1 * total_7 + r0_0 * total_9;
    const double total_10 = r0_1_product_2 + r0_0 * by_entry_0_0;
    const double exponent_by_x2 = r1_1 * total_8 + r0_1 * total_10;
    const double exponent_by_x0 = r0_1 * total_8 + r0_0 * total_10;
    const double df0 = phi * exponent_by_x0;
    const double df1 = phi * exponent_by_x1;
    const double df2 = phi * exponent_by_x2;
    const double df3 = phi * exponent_by_x3;
    const double p_0_1_2 = 0.5 * x[1] + 0.5 * x[2];
    double p_0_1_eigh_2[6];
    {
        const double in_0[3] = {x[0], p_0_1_2, x[3]};
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
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void spd_splat_batch(
    size_t count,
    const double *SPD_RESTRICT x,
    const double *SPD_RESTRICT mu,
    const double *SPD_RESTRICT W,
    const double *SPD_RESTRICT amplitude,
    double *SPD_RESTRICT value_out,
    double *SPD_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) spd_splat(x + 4 * i, mu + 4 * i, W + 9 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void spd_frame(const double *SPD_RESTRICT p, double *SPD_RESTRICT frame) {
    double left[4][3];
    for (int i = 0; i < 4; ++i) {
        double axis[4];
        for (int j = 0; j < 4; ++j) axis[j] = i == j ? 1.0 : 0.0;
        spd_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 3; ++row) {
        double *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 4; ++i)
            if (spd_norm(p, left[i]) > spd_norm(p, left[longest])) longest = i;
        const double length = spd_norm(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 4; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 4];
            const double part = spd_inner(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
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

static float scalar_exp_f(float x) { return expf(x); }

static float scalar_invsqrt_f(float x) { return 1 / sqrtf(x); }

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

/* exp(A) of the eigen-decomposition of A, packed. */
static void symmetric_exp_2_f(const float *eigh, float *out) {
    float w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_exp_f(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_2_f(eigh, (const float (*)[2])total, out);
}

/* invsqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_invsqrt_2_f(const float *eigh, float *out) {
    float w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_invsqrt_f(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
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

/* sqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_sqrt_2_f(const float *eigh, float *out) {
    float w0[2], total[2][2] = {{0}};
    for (int i0 = 0; i0 < 2; ++i0) w0[i0] = scalar_sqrt_f(eigh[i0]);
    for (int i0 = 0; i0 < 2; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_2_f(eigh, (const float (*)[2])total, out);
}

/* where(eigh(S)[0] > 0, S, sqrtm(S * S)) */
void spd_project_f(const float *SPD_RESTRICT x, float *SPD_RESTRICT p_out) {
    const float S0_1 = 0.5f * x[1] + 0.5f * x[2];
    const float S0_1_squared = S0_1 * S0_1;
    const float S_times_S_0_0 = S0_1_squared + x[0] * x[0];
    const float S_times_S_0_1 = x[0] * S0_1 + x[3] * S0_1;
    const float S_times_S_1_1 = S0_1_squared + x[3] * x[3];
    float S0_1_eigh[6];
    {
        const float in_0[3] = {x[0], S0_1, x[3]};
        symmetric_eigh_2_f(in_0, S0_1_eigh);
    }
    const int is_less = 0.0f < S0_1_eigh[0];
    float eigh[6];
    {
        const float in_0[3] = {(is_less ? 1.0f : S_times_S_0_0), (is_less ? 0.0f : S_times_S_0_1), (is_less ? 1.0f : S_times_S_1_1)};
        symmetric_eigh_2_f(in_0, eigh);
    }
    float sqrtm[3];
    symmetric_sqrt_2_f(eigh, sqrtm);
    const float sqrtm_S_times_S0_0 = sqrtm[0];
    const float p0 = (is_less ? x[0] : sqrtm_S_times_S0_0);
    const float sqrtm_S_times_S0_1 = sqrtm[1];
    const float p1 = (is_less ? S0_1 : sqrtm_S_times_S0_1);
    const float sqrtm_S_times_S1_1 = sqrtm[2];
    const float p3 = (is_less ? x[3] : sqrtm_S_times_S1_1);
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p1;
    p_out[3] = p3;
}

void spd_project_batch_f(size_t count, const float *SPD_RESTRICT x, float *SPD_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) spd_project_f(x + 4 * i, p_out + 4 * i);
}

/* (E E^T)^-1 E x */
void spd_to_tangent_f(const float *SPD_RESTRICT p, const float *SPD_RESTRICT x, float *SPD_RESTRICT v_out) {
    const float p_0_1 = 0.5f * p[1] + 0.5f * p[2];
    float p_0_1_eigh[6];
    {
        const float in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2_f(in_0, p_0_1_eigh);
    }
    float sqrtm[3];
    symmetric_sqrt_2_f(p_0_1_eigh, sqrtm);
    const float sqrtm_p0_0 = sqrtm[0];
    const float sqrtm_p0_1 = sqrtm[1];
    const float sqrtm_p1_1 = sqrtm[2];
    const float e0_0 = sqrtm_p0_0 * sqrtm_p0_0;
    const float e0_1 = sqrtm_p0_0 * sqrtm_p0_1;
    const float e0_3 = sqrtm_p0_1 * sqrtm_p0_1;
    const float e1_0 = 1.4142135623730951f * e0_1;
    const float e1_1 = 0.7071067811865476f * e0_3 + 1.4142135623730951f * (sqrtm_p1_1 * (0.5f * sqrtm_p0_0));
    const float e2_1 = sqrtm_p0_1 * sqrtm_p1_1;
    const float e1_3 = 1.4142135623730951f * e2_1;
    const float e2_3 = sqrtm_p1_1 * sqrtm_p1_1;
    const float e0_squared = e0_0 * e0_0 + e0_3 * e0_3 + 2.0f * (e0_1 * e0_1);
    const float part0 = (x[0] * e0_0 + x[1] * e0_1 + x[2] * e0_1 + x[3] * e0_3) / e0_squared;
    const float rest_0 = x[0] - e0_0 * part0;
    const float e0_1_product = e0_1 * part0;
    const float rest_1 = x[1] - e0_1_product;
    const float rest_2 = x[2] - e0_1_product;
    const float rest_3 = x[3] - e0_3 * part0;
    const float e0_1_product_2 = 2.0f * e0_1;
    const float shear0_1 = (e0_0 * e1_0 + e0_3 * e1_3 + e1_1 * e0_1_product_2) / e0_squared;
    const float e1_0_2 = e1_0 - e0_0 * shear0_1;
    const float e1_1_2 = e1_1 - e0_1 * shear0_1;
    const float e1_3_2 = e1_3 - e0_3 * shear0_1;
    const float shear0_2 = (e0_0 * e0_3 + e0_3 * e2_3 + e2_1 * e0_1_product_2) / e0_squared;
    const float e2_0 = e0_3 - e0_0 * shear0_2;
    const float e2_1_2 = e2_1 - e0_1 * shear0_2;
    const float e2_3_2 = e2_3 - e0_3 * shear0_2;
    const float e1_squared = e1_0_2 * e1_0_2 + e1_3_2 * e1_3_2 + 2.0f * (e1_1_2 * e1_1_2);
    const float part1 = (rest_0 * e1_0_2 + rest_1 * e1_1_2 + rest_2 * e1_1_2 + rest_3 * e1_3_2) / e1_squared;
    const float rest_0_2 = rest_0 - e1_0_2 * part1;
    const float e1_1_2_product = e1_1_2 * part1;
    const float rest_1_2 = rest_1 - e1_1_2_product;
    const float rest_2_2 = rest_2 - e1_1_2_product;
    const float rest_3_2 = rest_3 - e1_3_2 * part1;
    const float shear1_2 = (e1_0_2 * e2_0 + e1_3_2 * e2_3_2 + e2_1_2 * (2.0f * e1_1_2)) / e1_squared;
    const float e2_0_2 = e2_0 - e1_0_2 * shear1_2;
    const float e2_1_3 = e2_1_2 - e1_1_2 * shear1_2;
    const float e2_3_3 = e2_3_2 - e1_3_2 * shear1_2;
    const float e2_squared = e2_0_2 * e2_0_2 + e2_3_3 * e2_3_3 + 2.0f * (e2_1_3 * e2_1_3);
    const float part2 = (rest_0_2 * e2_0_2 + rest_1_2 * e2_1_3 + rest_2_2 * e2_1_3 + rest_3_2 * e2_3_3) /
        e2_squared;
    const float component1 = part1 - shear1_2 * part2;
    const float component0 = part0 - shear0_1 * component1 - shear0_2 * part2;
    v_out[0] = component0;
    v_out[1] = component1;
    v_out[2] = part2;
}

void spd_to_tangent_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT x,
    float *SPD_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) spd_to_tangent_f(p + 4 * i, x + 4 * i, v_out + 3 * i);
}

/* dot(u, v) */
float spd_inner_f(const float *SPD_RESTRICT p, const float *SPD_RESTRICT u, const float *SPD_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void spd_inner_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT u,
    const float *SPD_RESTRICT v,
    float *SPD_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = spd_inner_f(p + 4 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(<v, v>_p) */
float spd_norm_f(const float *SPD_RESTRICT p, const float *SPD_RESTRICT v) {
    (void)p;
    return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void spd_norm_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT v,
    float *SPD_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = spd_norm_f(p + 4 * i, v + 3 * i);
}

/* G(p) v */
void spd_flat_f(const float *SPD_RESTRICT p, const float *SPD_RESTRICT v, float *SPD_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void spd_flat_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT v,
    float *SPD_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) spd_flat_f(p + 4 * i, v + 3 * i, covector_out + 3 * i);
}

/* s * expm(smat(v)) * s */
void spd_exp_f(const float *SPD_RESTRICT p, const float *SPD_RESTRICT v, float *SPD_RESTRICT q_out) {
    const float p_0_1 = 0.5f * p[1] + 0.5f * p[2];
    float p_0_1_eigh[6];
    {
        const float in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2_f(in_0, p_0_1_eigh);
    }
    float sqrtm[3];
    symmetric_sqrt_2_f(p_0_1_eigh, sqrtm);
    const float s0_0 = sqrtm[0];
    const float s0_1 = sqrtm[1];
    const float s1_1 = sqrtm[2];
    const float smat_v_0_1 = 0.7071067811865476f * v[1];
    float smat_v_0_1_eigh[6];
    {
        const float in_0[3] = {v[0], smat_v_0_1, v[2]};
        symmetric_eigh_2_f(in_0, smat_v_0_1_eigh);
    }
    float expm[3];
    symmetric_exp_2_f(smat_v_0_1_eigh, expm);
    const float expm_smat_v0_0 = expm[0];
    const float expm_smat_v0_1 = expm[1];
    const float expm_smat_v1_1 = expm[2];
    const float s0_1_product = s0_1 * expm_smat_v0_1;
    const float total_2 = s0_0 * expm_smat_v0_0 + s0_1_product;
    const float total_3 = s0_0 * expm_smat_v0_1 + s0_1 * expm_smat_v1_1;
    const float q0 = s0_0 * total_2 + s0_1 * total_3;
    const float q1 = s0_1 * total_2 + s1_1 * total_3;
    const float total_4 = s0_1 * expm_smat_v0_0 + s1_1 * expm_smat_v0_1;
    const float total_5 = s0_1_product + s1_1 * expm_smat_v1_1;
    const float q2 = s0_0 * total_4 + s0_1 * total_5;
    const float q3 = s0_1 * total_4 + s1_1 * total_5;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
}

void spd_exp_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT v,
    float *SPD_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) spd_exp_f(p + 4 * i, v + 3 * i, q_out + 4 * i);
}

/* svec(L) */
void spd_log_f(const float *SPD_RESTRICT p, const float *SPD_RESTRICT q, float *SPD_RESTRICT v_out) {
    const float p_0_1 = 0.5f * p[1] + 0.5f * p[2];
    float p_0_1_eigh[6];
    {
        const float in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2_f(in_0, p_0_1_eigh);
    }
    float invsqrtm[3];
    symmetric_invsqrt_2_f(p_0_1_eigh, invsqrtm);
    const float r0_0 = invsqrtm[0];
    const float r0_1 = invsqrtm[1];
    const float r1_1 = invsqrtm[2];
    const float total_2 = q[0] * r0_0 + q[2] * r0_1;
    const float total_3 = q[1] * r0_0 + q[3] * r0_1;
    const float entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
    const float total_4 = q[0] * r0_1 + q[2] * r1_1;
    const float r0_1_product = 0.5f * r0_1;
    const float total_5 = q[1] * r0_1 + q[3] * r1_1;
    const float entry_0_1 = 0.5f * r0_0 * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
        * (0.5f * r1_1);
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
    v_out[0] = L0_0;
    v_out[1] = v1;
    v_out[2] = L1_1;
}

void spd_log_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT q,
    float *SPD_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) spd_log_f(p + 4 * i, q + 4 * i, v_out + 3 * i);
}

/* norm(L) */
float spd_distance_f(const float *SPD_RESTRICT p, const float *SPD_RESTRICT q) {
    const float p_0_1 = 0.5f * p[1] + 0.5f * p[2];
    float p_0_1_eigh[6];
    {
        const float in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2_f(in_0, p_0_1_eigh);
    }
    float invsqrtm[3];
    symmetric_invsqrt_2_f(p_0_1_eigh, invsqrtm);
    const float r0_0 = invsqrtm[0];
    const float r0_1 = invsqrtm[1];
    const float r1_1 = invsqrtm[2];
    const float total_2 = q[0] * r0_0 + q[2] * r0_1;
    const float total_3 = q[1] * r0_0 + q[3] * r0_1;
    const float entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
    const float total_4 = q[0] * r0_1 + q[2] * r1_1;
    const float r0_1_product = 0.5f * r0_1;
    const float total_5 = q[1] * r0_1 + q[3] * r1_1;
    const float entry_0_1 = 0.5f * r0_0 * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
        * (0.5f * r1_1);
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
    const float norm_L_squared = L0_0 * L0_0 + L1_1 * L1_1 + 2.0f * (L0_1 * L0_1);
    const float norm_L = sqrtf(norm_L_squared);
    return norm_L;
}

void spd_distance_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT q,
    float *SPD_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = spd_distance_f(p + 4 * i, q + 4 * i);
}

/* -trace(log_sinhc_sqrtm(ad_squared(L) / 4)) */
float spd_log_abs_det_f(const float *SPD_RESTRICT p, const float *SPD_RESTRICT q) {
    const float p_0_1 = 0.5f * p[1] + 0.5f * p[2];
    float p_0_1_eigh[6];
    {
        const float in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2_f(in_0, p_0_1_eigh);
    }
    float invsqrtm[3];
    symmetric_invsqrt_2_f(p_0_1_eigh, invsqrtm);
    const float r0_0 = invsqrtm[0];
    const float r0_1 = invsqrtm[1];
    const float r1_1 = invsqrtm[2];
    const float total_2 = q[0] * r0_0 + q[2] * r0_1;
    const float total_3 = q[1] * r0_0 + q[3] * r0_1;
    const float entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
    const float total_4 = q[0] * r0_1 + q[2] * r1_1;
    const float r0_1_product = 0.5f * r0_1;
    const float total_5 = q[1] * r0_1 + q[3] * r1_1;
    const float entry_0_1 = 0.5f * r0_0 * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
        * (0.5f * r1_1);
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
    return -log_sinhc_sqrtm_value0_0;
}

void spd_log_abs_det_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT q,
    float *SPD_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = spd_log_abs_det_f(p + 4 * i, q + 4 * i);
}

/* G^-1 E df */
void spd_riemannian_gradient_f(
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT df,
    float *SPD_RESTRICT gradient_out) {
    const float p_0_1 = 0.5f * p[1] + 0.5f * p[2];
    float p_0_1_eigh[6];
    {
        const float in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2_f(in_0, p_0_1_eigh);
    }
    float sqrtm[3];
    symmetric_sqrt_2_f(p_0_1_eigh, sqrtm);
    const float sqrtm_p0_0 = sqrtm[0];
    const float sqrtm_p0_1 = sqrtm[1];
    const float sqrtm_p1_1 = sqrtm[2];
    const float sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
    const float gradient0 = df[0] * (sqrtm_p0_0 * sqrtm_p0_0) + df[3] * sqrtm_p0_1_squared + sqrtm_p0_1 *
        (df[1] * sqrtm_p0_0) + sqrtm_p0_1 * (df[2] * sqrtm_p0_0);
    const float total_2 = 0.7071067811865476f * sqrtm_p0_1_squared + 1.4142135623730951f * (sqrtm_p1_1 * (0.5f
        * sqrtm_p0_0));
    const float gradient1 = df[1] * total_2 + df[2] * total_2 + 1.4142135623730951f * (sqrtm_p0_1 * (df[0] *
        sqrtm_p0_0)) + 1.4142135623730951f * (sqrtm_p1_1 * (df[3] * sqrtm_p0_1));
    const float gradient2 = df[0] * sqrtm_p0_1_squared + df[3] * (sqrtm_p1_1 * sqrtm_p1_1) + sqrtm_p1_1 *
        (df[1] * sqrtm_p0_1) + sqrtm_p1_1 * (df[2] * sqrtm_p0_1);
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void spd_riemannian_gradient_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT df,
    float *SPD_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) spd_riemannian_gradient_f(p + 4 * i, df + 4 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
float spd_gradient_norm_f(const float *SPD_RESTRICT p, const float *SPD_RESTRICT df) {
    const float p_0_1 = 0.5f * p[1] + 0.5f * p[2];
    float p_0_1_eigh[6];
    {
        const float in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2_f(in_0, p_0_1_eigh);
    }
    float sqrtm[3];
    symmetric_sqrt_2_f(p_0_1_eigh, sqrtm);
    const float sqrtm_p0_0 = sqrtm[0];
    const float sqrtm_p0_1 = sqrtm[1];
    const float sqrtm_p1_1 = sqrtm[2];
    const float sqrtm_p0_1_squared = sqrtm_p0_1 * sqrtm_p0_1;
    const float gradient0 = df[0] * (sqrtm_p0_0 * sqrtm_p0_0) + df[3] * sqrtm_p0_1_squared + sqrtm_p0_1 *
        (df[1] * sqrtm_p0_0) + sqrtm_p0_1 * (df[2] * sqrtm_p0_0);
    const float total_2 = 0.7071067811865476f * sqrtm_p0_1_squared + 1.4142135623730951f * (sqrtm_p1_1 * (0.5f
        * sqrtm_p0_0));
    const float gradient1 = df[1] * total_2 + df[2] * total_2 + 1.4142135623730951f * (sqrtm_p0_1 * (df[0] *
        sqrtm_p0_0)) + 1.4142135623730951f * (sqrtm_p1_1 * (df[3] * sqrtm_p0_1));
    const float gradient2 = df[0] * sqrtm_p0_1_squared + df[3] * (sqrtm_p1_1 * sqrtm_p1_1) + sqrtm_p1_1 *
        (df[1] * sqrtm_p0_1) + sqrtm_p1_1 * (df[2] * sqrtm_p0_1);
    return sqrtf(gradient0 * gradient0 + gradient1 * gradient1 + gradient2 * gradient2);
}

void spd_gradient_norm_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT df,
    float *SPD_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = spd_gradient_norm_f(p + 4 * i, df + 4 * i);
}

/* svec(O * smat(v) * transpose(O)) */
void spd_transport_f(
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT q,
    const float *SPD_RESTRICT v,
    float *SPD_RESTRICT w_out) {
    const float p_0_1 = 0.5f * p[1] + 0.5f * p[2];
    float p_0_1_eigh[6];
    {
        const float in_0[3] = {p[0], p_0_1, p[3]};
        symmetric_eigh_2_f(in_0, p_0_1_eigh);
    }
    float invsqrtm[3];
    symmetric_invsqrt_2_f(p_0_1_eigh, invsqrtm);
    const float r0_0 = invsqrtm[0];
    const float r0_1 = invsqrtm[1];
    const float r1_1 = invsqrtm[2];
    const float total_2 = q[0] * r0_0 + q[2] * r0_1;
    const float total_3 = q[1] * r0_0 + q[3] * r0_1;
    const float entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
    const float total_4 = q[0] * r0_1 + q[2] * r1_1;
    const float r0_1_product = 0.5f * r0_1;
    const float total_5 = q[1] * r0_1 + q[3] * r1_1;
    const float entry_0_1 = 0.5f * r0_0 * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
        * (0.5f * r1_1);
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
    const float q_0_1 = 0.5f * q[1] + 0.5f * q[2];
    float q_0_1_eigh[6];
    {
        const float in_0[3] = {q[0], q_0_1, q[3]};
        symmetric_eigh_2_f(in_0, q_0_1_eigh);
    }
    float invsqrtm_2[3];
    symmetric_invsqrt_2_f(q_0_1_eigh, invsqrtm_2);
    const float invsqrtm_q0_0 = invsqrtm_2[0];
    const float invsqrtm_q0_1 = invsqrtm_2[1];
    const float invsqrtm_q1_1 = invsqrtm_2[2];
    float sqrtm[3];
    symmetric_sqrt_2_f(p_0_1_eigh, sqrtm);
    const float sqrtm_p0_0 = sqrtm[0];
    const float sqrtm_p0_1 = sqrtm[1];
    const float sqrtm_p1_1 = sqrtm[2];
    const float L_over_2_0_0 = 0.5f * L0_0;
    const float L_over_2_0_1 = 0.5f * L0_1;
    const float L_over_2_1_1 = 0.5f * L1_1;
    float eigh[6];
    {
        const float in_0[3] = {L_over_2_0_0, L_over_2_0_1, L_over_2_1_1};
        symmetric_eigh_2_f(in_0, eigh);
    }
    float expm[3];
    symmetric_exp_2_f(eigh, expm);
    const float expm_L_over_20_0 = expm[0];
    const float expm_L_over_20_1 = expm[1];
    const float expm_L_over_21_1 = expm[2];
    const float product = invsqrtm_q0_1 * sqrtm_p0_1;
    const float total_6 = invsqrtm_q0_0 * sqrtm_p0_0 + product;
    const float total_7 = invsqrtm_q0_0 * sqrtm_p0_1 + invsqrtm_q0_1 * sqrtm_p1_1;
    const float O0_0 = expm_L_over_20_0 * total_6 + expm_L_over_20_1 * total_7;
    const float O0_1 = expm_L_over_20_1 * total_6 + expm_L_over_21_1 * total_7;
    const float total_8 = invsqrtm_q0_1 * sqrtm_p0_0 + invsqrtm_q1_1 * sqrtm_p0_1;
    const float total_9 = product + invsqrtm_q1_1 * sqrtm_p1_1;
    const float O1_0 = expm_L_over_20_0 * total_8 + expm_L_over_20_1 * total_9;
    const float O1_1 = expm_L_over_20_1 * total_8 + expm_L_over_21_1 * total_9;
    const float total_10 = v[0] * O0_0 + 1.4142135623730951f * (v[1] * (0.5f * O0_1));
    const float total_11 = v[2] * O0_1 + 1.4142135623730951f * (v[1] * (0.5f * O0_0));
    const float w0 = O0_0 * total_10 + O0_1 * total_11;
    const float w1 = 1.4142135623730951f * (O1_0 * total_10 + O1_1 * total_11);
    const float O1_0_product = O1_0 * (v[0] * O1_0 + 1.4142135623730951f * (v[1] * (0.5f * O1_1)));
    const float O1_1_product = O1_1 * (v[2] * O1_1 + 1.4142135623730951f * (v[1] * (0.5f * O1_0)));
    const float w2 = O1_0_product + O1_1_product;
    w_out[0] = w0;
    w_out[1] = w1;
    w_out[2] = w2;
}

void spd_transport_batch_f(
    size_t count,
    const float *SPD_RESTRICT p,
    const float *SPD_RESTRICT q,
    const float *SPD_RESTRICT v,
    float *SPD_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) spd_transport_f(p + 4 * i, q + 4 * i, v + 3 * i, w_out + 3 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void spd_splat_f(
    const float *SPD_RESTRICT x,
    const float *SPD_RESTRICT mu,
    const float *SPD_RESTRICT W,
    float amplitude,
    float *SPD_RESTRICT value_out,
    float *SPD_RESTRICT gradient_out) {
    const float p_0_1 = 0.5f * mu[1] + 0.5f * mu[2];
    float p_0_1_eigh[6];
    {
        const float in_0[3] = {mu[0], p_0_1, mu[3]};
        symmetric_eigh_2_f(in_0, p_0_1_eigh);
    }
    float invsqrtm[3];
    symmetric_invsqrt_2_f(p_0_1_eigh, invsqrtm);
    const float r0_0 = invsqrtm[0];
    const float r0_1 = invsqrtm[1];
    const float r1_1 = invsqrtm[2];
    const float total_2 = x[0] * r0_0 + x[2] * r0_1;
    const float total_3 = x[1] * r0_0 + x[3] * r0_1;
    const float entry_0_0 = r0_0 * total_2 + r0_1 * total_3;
    const float total_4 = x[0] * r0_1 + x[2] * r1_1;
    const float r0_1_product = 0.5f * r0_1;
    const float total_5 = x[1] * r0_1 + x[3] * r1_1;
    const float entry_0_1 = 0.5f * r0_0 * total_4 + total_2 * r0_1_product + r0_1_product * total_5 + total_3
        * (0.5f * r1_1);
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
    const float z0 = W[0] * L0_0 + W[1] * v1 + W[2] * L1_1;
    const float z1 = W[3] * L0_0 + W[4] * v1 + W[5] * L1_1;
    const float z2 = W[6] * L0_0 + W[7] * v1 + W[8] * L1_1;
    const float gap = -log_sinhc_sqrtm_value0_0 - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
    const float phi = amplitude * expf(gap);
    const float by_v1 = -(W[7] * z2) - W[4] * z1 - W[1] * z0;
    float log_sinhc_sqrtm_slope[1];
    {
        const float in_0[1] = {-1.0f};
        symmetric_log_sinhc_sqrt_1_derivative1_f(entry_0_0_2_eigh, in_0, log_sinhc_sqrtm_slope);
    }
    const float by_entry_0_0_2 = log_sinhc_sqrtm_slope[0];
    const float product = L0_0_gap * (0.5f * by_entry_0_0_2);
    const float total_6 = -(W[6] * z2) - W[3] * z1 - W[0] * z0 + product;
    const float gap_2 = -(W[8] * z2) - W[5] * z1 - W[2] * z0 - product;
    float logm_slope[3];
    {
        const float in_0[3] = {total_6, 0.5f * (L0_1 * (2.0f * by_entry_0_0_2) + 1.4142135623730951f * by_v1), gap_2};
        symmetric_log_2_derivative1_f(entry_0_0_eigh, in_0, logm_slope);
    }
    const float by_entry_0_0 = logm_slope[0];
    const float by_entry_1_1 = logm_slope[2];
    const float r0_1_product_2 = r0_1 * logm_slope[1];
    const float total_7 = r1_1 * by_entry_1_1 + r0_1_product_2;
    const float total_8 = r0_1 * by_entry_1_1 + r0_0 * logm_slope[1];
    const float total_9 = r1_1 * logm_slope[1] + r0_1 * by_entry_0_0;
    const float exponent_by_x3 = r1_1 * total_7 + r0_1 * total_9;
    const float exponent_by_x1 = r0_1 * total_7 + r0_0 * total_9;
    const float total_10 = r0_1_product_2 + r0_0 * by_entry_0_0;
    const float exponent_by_x2 = r1_1 * total_8 + r0_1 * total_10;
    const float exponent_by_x0 = r0_1 * total_8 + r0_0 * total_10;
    const float df0 = phi * exponent_by_x0;
    const float df1 = phi * exponent_by_x1;
    const float df2 = phi * exponent_by_x2;
    const float df3 = phi * exponent_by_x3;
    const float p_0_1_2 = 0.5f * x[1] + 0.5f * x[2];
    float p_0_1_eigh_2[6];
    {
        const float in_0[3] = {x[0], p_0_1_2, x[3]};
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
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void spd_splat_batch_f(
    size_t count,
    const float *SPD_RESTRICT x,
    const float *SPD_RESTRICT mu,
    const float *SPD_RESTRICT W,
    const float *SPD_RESTRICT amplitude,
    float *SPD_RESTRICT value_out,
    float *SPD_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) spd_splat_f(x + 4 * i, mu + 4 * i, W + 9 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void spd_frame_f(const float *SPD_RESTRICT p, float *SPD_RESTRICT frame) {
    float left[4][3];
    for (int i = 0; i < 4; ++i) {
        float axis[4];
        for (int j = 0; j < 4; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        spd_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 3; ++row) {
        float *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 4; ++i)
            if (spd_norm_f(p, left[i]) > spd_norm_f(p, left[longest])) longest = i;
        const float length = spd_norm_f(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 4; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 4];
            const float part = spd_inner_f(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}
