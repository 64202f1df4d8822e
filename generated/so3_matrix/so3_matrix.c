/*
 * so3_matrix: Rotations of R^3 as 3 x 3 matrices; distances are rotation angles in radians.
 *
 * See the header for what the functions promise.
 */

#include "so3_matrix.h"

#include <float.h>

/* Of degree 7 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_cos__near(double x) {
    return 1.0 + x * (-0.4951964999999998 + x * (0.040869928935371204 + x * (-0.0013492430509063418 + x *
        (2.386215832835464e-05 + x * (-2.6258769338145326e-07 + x * (1.9699011755063933e-09 + x *
        -1.0543922273218809e-11))))));
}

/* Of degree 7 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_sinc__near(double x) {
    return 1.0 + x * (-0.16506549999999998 + x * (0.008173985787074777 + x * (-0.00019274900727486046 + x *
        (2.6513509314873062e-06 + x * (-2.3871616416234012e-08 + x * (1.5153609321464116e-10 + x *
        -7.043102821193199e-13))))));
}

/* Of degree 13 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_t_over_norm_s_near(double x) {
    return 2.0 + x * (0.08309566666666784 + x * (0.009321601255279904 + x * (0.0013831869136529075 + x *
        (0.00023466269139487824 + x * (4.307622244387224e-05 + x * (8.328318196009972e-06 + x *
        (1.6734198264338605e-06 + x * (3.3892571731146964e-07 + x * (8.160810786979752e-08 + x *
        (5.559604423994873e-09 + x * (1.0797473542320039e-08 + x * (-2.6805393136717492e-09 + x *
        9.765079763039615e-10))))))))))));
}

/* Of degree 13 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_log_det_series(double x) {
    return 0.3333333333333333 + x * (0.030468411111111815 + x * (0.004186774461502485 + x *
        (0.0006822355998616309 + x * (0.0001221617222686508 + x * (2.3226222426586787e-05 + x *
        (4.602679660683086e-06 + x * (9.419944287901338e-07 + x * (1.9330673844597264e-07 + x *
        (4.732354384237477e-08 + x * (3.0572329018458638e-09 + x * (6.43891495522262e-09 + x *
        (-1.6163842503256483e-09 + x * 5.84780397346594e-10))))))))))));
}

/* Of degree 12 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_log_det_series_slope(double x) {
    return 0.030468411111111815 + x * (0.00837354892300497 + x * (0.002046706799584893 + x *
        (0.0004886468890746032 + x * (0.00011613111213293394 + x * (2.7616077964098513e-05 + x *
        (6.5939610015309365e-06 + x * (1.5464539075677811e-06 + x * (4.2591189458137294e-07 + x *
        (3.057232901845864e-08 + x * (7.082806450744882e-08 + x * (-1.939661100390778e-08 + x *
        7.602145165505722e-09)))))))))));
}

/* Of degree 12 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_t_over_norm_s_near_slope(double x) {
    return 0.08309566666666784 + x * (0.018643202510559807 + x * (0.004149560740958722 + x *
        (0.0009386507655795129 + x * (0.0002153811122193612 + x * (4.996990917605983e-05 + x *
        (1.1713938785037024e-05 + x * (2.711405738491757e-06 + x * (7.344729708281776e-07 + x *
        (5.559604423994873e-08 + x * (1.1877220896552043e-07 + x * (-3.2166471764060994e-08 + x *
        1.2694603691951498e-08)))))))))));
}

/* Eigenvalues, ascending, and eigenvectors of a symmetric 3 x 3 matrix, by Jacobi's rotations. */
static void symmetric_eigh_3(const double *in, double *out) {
    double a[3][3] = {{in[0], in[1], in[2]}, {in[1], in[3], in[4]}, {in[2], in[4], in[5]}}, v[3][3] = {{0}}, poison = 0;
    for (int i = 0; i < 3; ++i) v[i][i] = 1;
    for (int sweep = 0; sweep < 8; ++sweep) {
        for (int p = 0; p < 3; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                const double twice = 2 * a[p][q], gap = a[q][q] - a[p][p];
                if (twice == 0) continue;
                const double theta = gap / twice;
                const double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
                const double c = 1 / sqrt(t * t + 1), s = t * c, part = s / (1 + c);
                a[p][p] -= t * a[p][q];
                a[q][q] += t * a[p][q];
                a[p][q] = a[q][p] = 0;
                for (int k = 0; k < 3; ++k) {
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
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) poison += 0 * a[i][j] + 0 * v[i][j]; /* NaN when one of them is not finite */
    for (int i = 0; i < 3; ++i) a[i][i] += poison;
    for (int i = 0; i < 3; ++i) {
        int rank = 0; /* how many come before: equal ones in their order */
        for (int j = 0; j < 3; ++j) rank += a[j][j] < a[i][i] || (j < i && !(a[j][j] > a[i][i]));
        out[rank] = a[i][i];
        for (int k = 0; k < 3; ++k) out[3 + 3 * k + rank] = v[k][i];
    }
}

static double scalar_invsqrt(double x) { return 1 / sqrt(x); }

/* V A V^T, packed. */
static void out_of_eigenbasis_3(const double *eigh, const double (*in)[3], double *out) {
    const double *v = eigh + 3;
    for (int i = 0; i < 3; ++i) {
        double half[3] = {0};
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j) half[j] += v[3 * i + k] * in[k][j];
        for (int j = i; j < 3; ++j) {
            double sum = 0;
            for (int k = 0; k < 3; ++k) sum += half[k] * v[3 * j + k];
            *out++ = sum;
        }
    }
}

/* invsqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_invsqrt_3(const double *eigh, double *out) {
    double w0[3], total[3][3] = {{0}};
    for (int i0 = 0; i0 < 3; ++i0) w0[i0] = scalar_invsqrt(eigh[i0]);
    for (int i0 = 0; i0 < 3; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_3(eigh, (const double (*)[3])total, out);
}

/* p * invsqrtm(transpose(p) * p) */
void so3_matrix_project(const double *SO3_MATRIX_RESTRICT x, double *SO3_MATRIX_RESTRICT p_out) {
    const double entry_0_0 = x[0] * x[0] + x[3] * x[3] + x[6] * x[6];
    const double entry_0_1 = x[0] * x[1] + x[3] * x[4] + x[6] * x[7];
    const double entry_0_2 = x[0] * x[2] + x[3] * x[5] + x[6] * x[8];
    const double entry_1_1 = x[1] * x[1] + x[4] * x[4] + x[7] * x[7];
    const double entry_1_2 = x[1] * x[2] + x[4] * x[5] + x[7] * x[8];
    const double entry_2_2 = x[2] * x[2] + x[5] * x[5] + x[8] * x[8];
    double entry_0_0_eigh[12];
    {
        const double in_0[6] = {entry_0_0, entry_0_1, entry_0_2, entry_1_1, entry_1_2, entry_2_2};
        symmetric_eigh_3(in_0, entry_0_0_eigh);
    }
    double invsqrtm[6];
    symmetric_invsqrt_3(entry_0_0_eigh, invsqrtm);
    const double invsqrtm_value0_0 = invsqrtm[0];
    const double invsqrtm_value0_1 = invsqrtm[1];
    const double invsqrtm_value0_2 = invsqrtm[2];
    const double invsqrtm_value1_1 = invsqrtm[3];
    const double invsqrtm_value1_2 = invsqrtm[4];
    const double invsqrtm_value2_2 = invsqrtm[5];
    const double p0 = x[0] * invsqrtm_value0_0 + x[1] * invsqrtm_value0_1 + x[2] * invsqrtm_value0_2;
    const double p1 = x[0] * invsqrtm_value0_1 + x[1] * invsqrtm_value1_1 + x[2] * invsqrtm_value1_2;
    const double p2 = x[0] * invsqrtm_value0_2 + x[1] * invsqrtm_value1_2 + x[2] * invsqrtm_value2_2;
    const double p3 = x[3] * invsqrtm_value0_0 + x[4] * invsqrtm_value0_1 + x[5] * invsqrtm_value0_2;
    const double p4 = x[3] * invsqrtm_value0_1 + x[4] * invsqrtm_value1_1 + x[5] * invsqrtm_value1_2;
    const double p5 = x[3] * invsqrtm_value0_2 + x[4] * invsqrtm_value1_2 + x[5] * invsqrtm_value2_2;
    const double p6 = x[6] * invsqrtm_value0_0 + x[7] * invsqrtm_value0_1 + x[8] * invsqrtm_value0_2;
    const double p7 = x[6] * invsqrtm_value0_1 + x[7] * invsqrtm_value1_1 + x[8] * invsqrtm_value1_2;
    const double p8 = x[6] * invsqrtm_value0_2 + x[7] * invsqrtm_value1_2 + x[8] * invsqrtm_value2_2;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
    p_out[7] = p7;
    p_out[8] = p8;
}

void so3_matrix_project_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT x,
    double *SO3_MATRIX_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_project(x + 9 * i, p_out + 9 * i);
}

/* (E E^T)^-1 E x */
void so3_matrix_to_tangent(
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT x,
    double *SO3_MATRIX_RESTRICT v_out) {
    const double product = 0.5 * p[2];
    const double product_2 = 0.5 * p[5];
    const double product_3 = 0.5 * p[8];
    const double product_4 = 0.5 * p[1];
    const double product_5 = 0.5 * p[4];
    const double gap = x[1] * product + x[4] * product_2 + x[7] * product_3 - x[2] * product_4 - x[5] *
        product_5;
    const double product_6 = 0.5 * p[7];
    const double v0 = gap - x[8] * product_6;
    const double product_7 = 0.5 * p[0];
    const double product_8 = 0.5 * p[3];
    const double product_9 = 0.5 * p[6];
    const double gap_2 = x[2] * product_7 + x[5] * product_8 + x[8] * product_9 - x[0] * product - x[3] *
        product_2;
    const double v1 = gap_2 - x[6] * product_3;
    const double gap_3 = x[0] * product_4 + x[3] * product_5 + x[6] * product_6 - x[1] * product_7 - x[4] *
        product_8;
    const double v2 = gap_3 - x[7] * product_9;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void so3_matrix_to_tangent_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT x,
    double *SO3_MATRIX_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_to_tangent(p + 9 * i, x + 9 * i, v_out + 3 * i);
}

/* dot(u, v) */
double so3_matrix_inner(
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT u,
    const double *SO3_MATRIX_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void so3_matrix_inner_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT u,
    const double *SO3_MATRIX_RESTRICT v,
    double *SO3_MATRIX_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = so3_matrix_inner(p + 9 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(<v, v>_p) */
double so3_matrix_norm(const double *SO3_MATRIX_RESTRICT p, const double *SO3_MATRIX_RESTRICT v) {
    (void)p;
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void so3_matrix_norm_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT v,
    double *SO3_MATRIX_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = so3_matrix_norm(p + 9 * i, v + 3 * i);
}

/* G(p) v */
void so3_matrix_flat(
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT v,
    double *SO3_MATRIX_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void so3_matrix_flat_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT v,
    double *SO3_MATRIX_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_flat(p + 9 * i, v + 3 * i, covector_out + 3 * i);
}

/* p * rotation([cos(norm(v) / 2), sinc(norm(v) / 2) / 2 * v]) */
void so3_matrix_exp(
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT v,
    double *SO3_MATRIX_RESTRICT q_out) {
    const double squared = v[0] * v[0];
    const double squared_2 = v[1] * v[1];
    const double squared_3 = v[2] * v[2];
    const double norm_v_squared = squared + squared_2 + squared_3;
    const int near = 0.25 * norm_v_squared < 0.990393;
    const double near_chosen = (near ? 0.2524250474306664 * norm_v_squared : 0.0);
    const double cos__near = polynomial_cos__near(near_chosen);
    const double norm_v = sqrt((near ? 1.0 : norm_v_squared));
    const double norm_v_product = 0.5 * norm_v;
    const double cos_ = (near ? cos__near : cos(norm_v_product));
    const double sinc__near = polynomial_sinc__near(near_chosen);
    const double sinc_ = (near ? sinc__near : 2.0 * sin(norm_v_product) / norm_v);
    const double scale = 0.5 * sinc_;
    const double scale_squared = scale * scale;
    const double product = 2.0 * scale_squared;
    const double product_2 = squared_2 * product;
    const double product_3 = squared_3 * product;
    const double gap = 1.0 - product_2 - product_3;
    const double cos__product = cos_ * sinc_;
    const double product_4 = v[2] * cos__product;
    const double product_5 = 2.0 * v[0];
    const double product_6 = scale_squared * (v[1] * product_5);
    const double total_2 = product_4 + product_6;
    const double product_7 = scale_squared * (v[2] * product_5);
    const double product_8 = v[1] * cos__product;
    const double gap_2 = product_7 - product_8;
    const double q0 = p[0] * gap + p[1] * total_2 + p[2] * gap_2;
    const double gap_3 = product_6 - product_4;
    const double gap_4 = 1.0 - squared * product;
    const double gap_5 = gap_4 - product_3;
    const double product_9 = v[0] * cos__product;
    const double product_10 = scale_squared * (v[2] * (2.0 * v[1]));
    const double total_3 = product_9 + product_10;
    const double q1 = p[0] * gap_3 + p[1] * gap_5 + p[2] * total_3;
    const double total_4 = product_7 + product_8;
    const double gap_6 = product_10 - product_9;
    const double gap_7 = gap_4 - product_2;
    const double q2 = p[0] * total_4 + p[1] * gap_6 + p[2] * gap_7;
    const double q3 = p[3] * gap + p[4] * total_2 + p[5] * gap_2;
    const double q4 = p[3] * gap_3 + p[4] * gap_5 + p[5] * total_3;
    const double q5 = p[3] * total_4 + p[4] * gap_6 + p[5] * gap_7;
    const double q6 = p[6] * gap + p[7] * total_2 + p[8] * gap_2;
    const double q7 = p[6] * gap_3 + p[7] * gap_5 + p[8] * total_3;
    const double q8 = p[6] * total_4 + p[7] * gap_6 + p[8] * gap_7;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
    q_out[4] = q4;
    q_out[5] = q5;
    q_out[6] = q6;
    q_out[7] = q7;
    q_out[8] = q8;
}

void so3_matrix_exp_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT v,
    double *SO3_MATRIX_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_exp(p + 9 * i, v + 3 * i, q_out + 9 * i);
}

/* sign(g[0]) * t * s / norm(s) */
void so3_matrix_log(
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT q,
    double *SO3_MATRIX_RESTRICT v_out) {
    const double R0_0 = p[0] * q[0] + p[3] * q[3] + p[6] * q[6];
    const double R0_1 = p[0] * q[1] + p[3] * q[4] + p[6] * q[7];
    const double R0_2 = p[0] * q[2] + p[3] * q[5] + p[6] * q[8];
    const double R1_0 = p[1] * q[0] + p[4] * q[3] + p[7] * q[6];
    const double R1_1 = p[1] * q[1] + p[4] * q[4] + p[7] * q[7];
    const double R1_2 = p[1] * q[2] + p[4] * q[5] + p[7] * q[8];
    const double R2_0 = p[2] * q[0] + p[5] * q[3] + p[8] * q[6];
    const double R2_1 = p[2] * q[1] + p[5] * q[4] + p[8] * q[7];
    const double R2_2 = p[2] * q[2] + p[5] * q[5] + p[8] * q[8];
    const double R0_0_total = 1.0 + R0_0;
    const double square0 = R2_2 + (R1_1 + R0_0_total);
    const double square1 = R0_0_total - R1_1 - R2_2;
    const double square2 = 1.0 + R1_1 - R0_0 - R2_2;
    const double square3 = 1.0 + R2_2 - R0_0 - R1_1;
    const int is_less = square0 < square1;
    const double R2_1_gap = R2_1 - R1_2;
    const double row = (is_less ? R2_1_gap : square0);
    const double row_2 = (is_less ? square1 : R2_1_gap);
    const double R0_1_total = R0_1 + R1_0;
    const double R0_2_gap = R0_2 - R2_0;
    const double row_3 = (is_less ? R0_1_total : R0_2_gap);
    const double R0_2_total = R0_2 + R2_0;
    const double R1_0_gap = R1_0 - R0_1;
    const double row_4 = (is_less ? R0_2_total : R1_0_gap);
    const double largest = (is_less ? square1 : square0);
    const int is_less_2 = largest < square2;
    const double row_5 = (is_less_2 ? R0_2_gap : row);
    const double row_6 = (is_less_2 ? R0_1_total : row_2);
    const double row_7 = (is_less_2 ? square2 : row_3);
    const double R1_2_total = R1_2 + R2_1;
    const double row_8 = (is_less_2 ? R1_2_total : row_4);
    const double largest_2 = (is_less_2 ? square2 : largest);
    const int is_less_3 = largest_2 < square3;
    const double row_9 = (is_less_3 ? R1_0_gap : row_5);
    const double row_10 = (is_less_3 ? R0_2_total : row_6);
    const double row_11 = (is_less_3 ? R1_2_total : row_7);
    const double row_12 = (is_less_3 ? square3 : row_8);
    const double row_length = sqrt(row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9);
    const double g0 = row_9 / row_length;
    const double g1 = row_10 / row_length;
    const double g2 = row_11 / row_length;
    const double g3 = row_12 / row_length;
    const double norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const double abs_g0 = fabs(g0);
    const int near = norm_s_squared < 0.249287;
    const double t_over_norm_s_near = polynomial_t_over_norm_s_near((near ? 4.011440628672975 * norm_s_squared
        : 0.0));
    const double norm_s = sqrt((near ? 1.0 : norm_s_squared));
    const double atan2_norm_s_abs_g0 = atan2(norm_s, abs_g0);
    const double t = 2.0 * atan2_norm_s_abs_g0;
    const double t_over_norm_s = (near ? t_over_norm_s_near : t / norm_s);
    const double scale = t_over_norm_s * (g0 < 0.0 ? -1.0 : 1.0);
    const double v0 = g1 * scale;
    const double v1 = g2 * scale;
    const double v2 = g3 * scale;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void so3_matrix_log_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT q,
    double *SO3_MATRIX_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_log(p + 9 * i, q + 9 * i, v_out + 3 * i);
}

/* t */
double so3_matrix_distance(const double *SO3_MATRIX_RESTRICT p, const double *SO3_MATRIX_RESTRICT q) {
    const double R0_0 = p[0] * q[0] + p[3] * q[3] + p[6] * q[6];
    const double R0_1 = p[0] * q[1] + p[3] * q[4] + p[6] * q[7];
    const double R0_2 = p[0] * q[2] + p[3] * q[5] + p[6] * q[8];
    const double R1_0 = p[1] * q[0] + p[4] * q[3] + p[7] * q[6];
    const double R1_1 = p[1] * q[1] + p[4] * q[4] + p[7] * q[7];
    const double R1_2 = p[1] * q[2] + p[4] * q[5] + p[7] * q[8];
    const double R2_0 = p[2] * q[0] + p[5] * q[3] + p[8] * q[6];
    const double R2_1 = p[2] * q[1] + p[5] * q[4] + p[8] * q[7];
    const double R2_2 = p[2] * q[2] + p[5] * q[5] + p[8] * q[8];
    const double R0_0_total = 1.0 + R0_0;
    const double square0 = R2_2 + (R1_1 + R0_0_total);
    const double square1 = R0_0_total - R1_1 - R2_2;
    const double square2 = 1.0 + R1_1 - R0_0 - R2_2;
    const double square3 = 1.0 + R2_2 - R0_0 - R1_1;
    const int is_less = square0 < square1;
    const double R2_1_gap = R2_1 - R1_2;
    const double row = (is_less ? R2_1_gap : square0);
    const double row_2 = (is_less ? square1 : R2_1_gap);
    const double R0_1_total = R0_1 + R1_0;
    const double R0_2_gap = R0_2 - R2_0;
    const double row_3 = (is_less ? R0_1_total : R0_2_gap);
    const double R0_2_total = R0_2 + R2_0;
    const double R1_0_gap = R1_0 - R0_1;
    const double row_4 = (is_less ? R0_2_total : R1_0_gap);
    const double largest = (is_less ? square1 : square0);
    const int is_less_2 = largest < square2;
    const double row_5 = (is_less_2 ? R0_2_gap : row);
    const double row_6 = (is_less_2 ? R0_1_total : row_2);
    const double row_7 = (is_less_2 ? square2 : row_3);
    const double R1_2_total = R1_2 + R2_1;
    const double row_8 = (is_less_2 ? R1_2_total : row_4);
    const double largest_2 = (is_less_2 ? square2 : largest);
    const int is_less_3 = largest_2 < square3;
    const double row_9 = (is_less_3 ? R1_0_gap : row_5);
    const double row_10 = (is_less_3 ? R0_2_total : row_6);
    const double row_11 = (is_less_3 ? R1_2_total : row_7);
    const double row_12 = (is_less_3 ? square3 : row_8);
    const double row_length = sqrt(row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9);
    const double g0 = row_9 / row_length;
    const double g1 = row_10 / row_length;
    const double g2 = row_11 / row_length;
    const double g3 = row_12 / row_length;
    const double norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const double norm_s = sqrt(norm_s_squared);
    const double abs_g0 = fabs(g0);
    const double atan2_norm_s_abs_g0 = atan2(norm_s, abs_g0);
    const double t = 2.0 * atan2_norm_s_abs_g0;
    return t;
}

void so3_matrix_distance_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT q,
    double *SO3_MATRIX_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = so3_matrix_distance(p + 9 * i, q + 9 * i);
}

/* 2*log(t_over_norm_s/2) */
double so3_matrix_log_abs_det(const double *SO3_MATRIX_RESTRICT p, const double *SO3_MATRIX_RESTRICT q) {
    const double R0_0 = p[0] * q[0] + p[3] * q[3] + p[6] * q[6];
    const double R0_1 = p[0] * q[1] + p[3] * q[4] + p[6] * q[7];
    const double R0_2 = p[0] * q[2] + p[3] * q[5] + p[6] * q[8];
    const double R1_0 = p[1] * q[0] + p[4] * q[3] + p[7] * q[6];
    const double R1_1 = p[1] * q[1] + p[4] * q[4] + p[7] * q[7];
    const double R1_2 = p[1] * q[2] + p[4] * q[5] + p[7] * q[8];
    const double R2_0 = p[2] * q[0] + p[5] * q[3] + p[8] * q[6];
    const double R2_1 = p[2] * q[1] + p[5] * q[4] + p[8] * q[7];
    const double R2_2 = p[2] * q[2] + p[5] * q[5] + p[8] * q[8];
    const double R0_0_total = 1.0 + R0_0;
    const double square0 = R2_2 + (R1_1 + R0_0_total);
    const double square1 = R0_0_total - R1_1 - R2_2;
    const double square2 = 1.0 + R1_1 - R0_0 - R2_2;
    const double square3 = 1.0 + R2_2 - R0_0 - R1_1;
    const int is_less = square0 < square1;
    const double R2_1_gap = R2_1 - R1_2;
    const double row = (is_less ? R2_1_gap : square0);
    const double row_2 = (is_less ? square1 : R2_1_gap);
    const double R0_1_total = R0_1 + R1_0;
    const double R0_2_gap = R0_2 - R2_0;
    const double row_3 = (is_less ? R0_1_total : R0_2_gap);
    const double R0_2_total = R0_2 + R2_0;
    const double R1_0_gap = R1_0 - R0_1;
    const double row_4 = (is_less ? R0_2_total : R1_0_gap);
    const double largest = (is_less ? square1 : square0);
    const int is_less_2 = largest < square2;
    const double row_5 = (is_less_2 ? R0_2_gap : row);
    const double row_6 = (is_less_2 ? R0_1_total : row_2);
    const double row_7 = (is_less_2 ? square2 : row_3);
    const double R1_2_total = R1_2 + R2_1;
    const double row_8 = (is_less_2 ? R1_2_total : row_4);
    const double largest_2 = (is_less_2 ? square2 : largest);
    const int is_less_3 = largest_2 < square3;
    const double row_9 = (is_less_3 ? R1_0_gap : row_5);
    const double row_10 = (is_less_3 ? R0_2_total : row_6);
    const double row_11 = (is_less_3 ? R1_2_total : row_7);
    const double row_12 = (is_less_3 ? square3 : row_8);
    const double row_length = sqrt(row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9);
    const double g0 = row_9 / row_length;
    const double g1 = row_10 / row_length;
    const double g2 = row_11 / row_length;
    const double g3 = row_12 / row_length;
    const double norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const double abs_g0 = fabs(g0);
    const int near = norm_s_squared < 0.249287;
    const double norm_s = sqrt((near ? 1.0 : norm_s_squared));
    const double atan2_norm_s_abs_g0 = atan2(norm_s, abs_g0);
    const double t = 2.0 * atan2_norm_s_abs_g0;
    const double log_det_series = polynomial_log_det_series((near ? 4.011440628672975 * norm_s_squared :
        0.0));
    const double log_det_near = norm_s_squared * log_det_series;
    const double log_det = (near ? log_det_near : 2.0 * log(0.5 * (t / norm_s)));
    return log_det;
}

void so3_matrix_log_abs_det_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT q,
    double *SO3_MATRIX_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = so3_matrix_log_abs_det(p + 9 * i, q + 9 * i);
}

/* G^-1 E df */
void so3_matrix_riemannian_gradient(
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT df,
    double *SO3_MATRIX_RESTRICT gradient_out) {
    const double gap = p[2] * df[1] + p[5] * df[4] + p[8] * df[7] - p[1] * df[2] - p[4] * df[5];
    const double gradient0 = gap - p[7] * df[8];
    const double gap_2 = p[0] * df[2] + p[3] * df[5] + p[6] * df[8] - p[2] * df[0] - p[5] * df[3];
    const double gradient1 = gap_2 - p[8] * df[6];
    const double gap_3 = p[1] * df[0] + p[4] * df[3] + p[7] * df[6] - p[0] * df[1] - p[3] * df[4];
    const double gradient2 = gap_3 - p[6] * df[7];
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void so3_matrix_riemannian_gradient_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT df,
    double *SO3_MATRIX_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_riemannian_gradient(p + 9 * i, df + 9 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
double so3_matrix_gradient_norm(const double *SO3_MATRIX_RESTRICT p, const double *SO3_MATRIX_RESTRICT df) {
    const double gap = p[2] * df[1] + p[5] * df[4] + p[8] * df[7] - p[1] * df[2] - p[4] * df[5];
    const double gradient0 = gap - p[7] * df[8];
    const double gap_2 = p[0] * df[2] + p[3] * df[5] + p[6] * df[8] - p[2] * df[0] - p[5] * df[3];
    const double gradient1 = gap_2 - p[8] * df[6];
    const double gap_3 = p[1] * df[0] + p[4] * df[3] + p[7] * df[6] - p[0] * df[1] - p[3] * df[4];
    const double gradient2 = gap_3 - p[6] * df[7];
    return sqrt(gradient0 * gradient0 + gradient1 * gradient1 + gradient2 * gradient2);
}

void so3_matrix_gradient_norm_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT df,
    double *SO3_MATRIX_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = so3_matrix_gradient_norm(p + 9 * i, df + 9 * i);
}

/* rotation(h / norm(h)) * v */
void so3_matrix_transport(
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT q,
    const double *SO3_MATRIX_RESTRICT v,
    double *SO3_MATRIX_RESTRICT w_out) {
    const double R0_0 = p[0] * q[0] + p[3] * q[3] + p[6] * q[6];
    const double R0_1 = p[0] * q[1] + p[3] * q[4] + p[6] * q[7];
    const double R0_2 = p[0] * q[2] + p[3] * q[5] + p[6] * q[8];
    const double R1_0 = p[1] * q[0] + p[4] * q[3] + p[7] * q[6];
    const double R1_1 = p[1] * q[1] + p[4] * q[4] + p[7] * q[7];
    const double R1_2 = p[1] * q[2] + p[4] * q[5] + p[7] * q[8];
    const double R2_0 = p[2] * q[0] + p[5] * q[3] + p[8] * q[6];
    const double R2_1 = p[2] * q[1] + p[5] * q[4] + p[8] * q[7];
    const double R2_2 = p[2] * q[2] + p[5] * q[5] + p[8] * q[8];
    const double R0_0_total = 1.0 + R0_0;
    const double square0 = R2_2 + (R1_1 + R0_0_total);
    const double square1 = R0_0_total - R1_1 - R2_2;
    const double square2 = 1.0 + R1_1 - R0_0 - R2_2;
    const double square3 = 1.0 + R2_2 - R0_0 - R1_1;
    const int is_less = square0 < square1;
    const double R2_1_gap = R2_1 - R1_2;
    const double row = (is_less ? R2_1_gap : square0);
    const double row_2 = (is_less ? square1 : R2_1_gap);
    const double R0_1_total = R0_1 + R1_0;
    const double R0_2_gap = R0_2 - R2_0;
    const double row_3 = (is_less ? R0_1_total : R0_2_gap);
    const double R0_2_total = R0_2 + R2_0;
    const double R1_0_gap = R1_0 - R0_1;
    const double row_4 = (is_less ? R0_2_total : R1_0_gap);
    const double largest = (is_less ? square1 : square0);
    const int is_less_2 = largest < square2;
    const double row_5 = (is_less_2 ? R0_2_gap : row);
    const double row_6 = (is_less_2 ? R0_1_total : row_2);
    const double row_7 = (is_less_2 ? square2 : row_3);
    const double R1_2_total = R1_2 + R2_1;
    const double row_8 = (is_less_2 ? R1_2_total : row_4);
    const double largest_2 = (is_less_2 ? square2 : largest);
    const int is_less_3 = largest_2 < square3;
    const double row_9 = (is_less_3 ? R1_0_gap : row_5);
    const double row_10 = (is_less_3 ? R0_2_total : row_6);
    const double row_11 = (is_less_3 ? R1_2_total : row_7);
    const double row_12 = (is_less_3 ? square3 : row_8);
    const double row_length = sqrt(row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9);
    const double g0 = row_9 / row_length;
    const double g1 = row_10 / row_length;
    const double g2 = row_11 / row_length;
    const double g3 = row_12 / row_length;
    const double abs_g0 = fabs(g0);
    const double chosen = (g0 < 0.0 ? -1.0 : 1.0);
    const double h0 = 1.0 + abs_g0;
    const double g1_product = g1 * chosen;
    const double g2_product = g2 * chosen;
    const double g3_product = g3 * chosen;
    const double squared = g1_product * g1_product;
    const double squared_2 = g2_product * g2_product;
    const double squared_3 = g3_product * g3_product;
    const double norm_h_squared = h0 * h0 + squared + squared_2 + squared_3;
    const double norm_h = sqrt(norm_h_squared);
    const double scale_3 = 1.0 / norm_h;
    const double scale_3_squared = scale_3 * scale_3;
    const double product = 2.0 * squared_2 * scale_3_squared;
    const double product_2 = scale_3_squared * (2.0 * squared_3);
    const double product_3 = 2.0 * g1_product;
    const double product_4 = scale_3_squared * (g2_product * product_3);
    const double h0_product = 2.0 * h0;
    const double product_5 = scale_3_squared * (g3_product * h0_product);
    const double product_6 = scale_3_squared * (g2_product * h0_product);
    const double product_7 = scale_3_squared * (g3_product * product_3);
    const double w0 = v[0] * (1.0 - product - product_2) + v[1] * (product_4 + product_5) + v[2] * (product_7
        - product_6);
    const double gap = 1.0 - scale_3_squared * (2.0 * squared);
    const double product_8 = scale_3_squared * (g3_product * (2.0 * g2_product));
    const double product_9 = scale_3_squared * (g1_product * h0_product);
    const double w1 = v[0] * (product_4 - product_5) + v[1] * (gap - product_2) + v[2] * (product_8 +
        product_9);
    const double w2 = v[0] * (product_6 + product_7) + v[1] * (product_8 - product_9) + v[2] * (gap -
        product);
    w_out[0] = w0;
    w_out[1] = w1;
    w_out[2] = w2;
}

void so3_matrix_transport_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT p,
    const double *SO3_MATRIX_RESTRICT q,
    const double *SO3_MATRIX_RESTRICT v,
    double *SO3_MATRIX_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_transport(p + 9 * i, q + 9 * i, v + 3 * i, w_out + 3 * i);
}

/* rotation(a / norm(a)) */
void so3_matrix_sample(
    const double *SO3_MATRIX_RESTRICT normal,
    const double *SO3_MATRIX_RESTRICT uniform,
    double *SO3_MATRIX_RESTRICT p_out) {
    (void)uniform;
    const double squared = normal[1] * normal[1];
    const double squared_2 = normal[2] * normal[2];
    const double squared_3 = normal[3] * normal[3];
    const double norm_a_squared = normal[0] * normal[0] + squared + squared_2 + squared_3;
    const double norm_a = sqrt(norm_a_squared);
    const double scale = 1.0 / norm_a;
    const double scale_squared = scale * scale;
    const double product = 2.0 * squared_2 * scale_squared;
    const double product_2 = scale_squared * (2.0 * squared_3);
    const double p0 = 1.0 - product - product_2;
    const double product_3 = 2.0 * normal[1];
    const double product_4 = scale_squared * (normal[2] * product_3);
    const double product_5 = 2.0 * normal[0];
    const double product_6 = scale_squared * (normal[3] * product_5);
    const double p1 = product_4 - product_6;
    const double product_7 = scale_squared * (normal[2] * product_5);
    const double product_8 = scale_squared * (normal[3] * product_3);
    const double p2 = product_7 + product_8;
    const double p3 = product_4 + product_6;
    const double gap = 1.0 - scale_squared * (2.0 * squared);
    const double p4 = gap - product_2;
    const double product_9 = scale_squared * (normal[3] * (2.0 * normal[2]));
    const double product_10 = scale_squared * (normal[1] * product_5);
    const double p5 = product_9 - product_10;
    const double p6 = product_8 - product_7;
    const double p7 = product_9 + product_10;
    const double p8 = gap - product;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
    p_out[7] = p7;
    p_out[8] = p8;
}

void so3_matrix_sample_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT normal,
    const double *SO3_MATRIX_RESTRICT uniform,
    double *SO3_MATRIX_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_sample(normal + 9 * i, uniform + 9 * i, p_out + 9 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void so3_matrix_splat(
    const double *SO3_MATRIX_RESTRICT x,
    const double *SO3_MATRIX_RESTRICT mu,
    const double *SO3_MATRIX_RESTRICT W,
    double amplitude,
    double *SO3_MATRIX_RESTRICT value_out,
    double *SO3_MATRIX_RESTRICT gradient_out) {
    const double R0_0 = x[0] * mu[0] + x[3] * mu[3] + x[6] * mu[6];
    const double R0_1 = x[1] * mu[0] + x[4] * mu[3] + x[7] * mu[6];
    const double R0_2 = x[2] * mu[0] + x[5] * mu[3] + x[8] * mu[6];
    const double R1_0 = x[0] * mu[1] + x[3] * mu[4] + x[6] * mu[7];
    const double R1_1 = x[1] * mu[1] + x[4] * mu[4] + x[7] * mu[7];
    const double R1_2 = x[2] * mu[1] + x[5] * mu[4] + x[8] * mu[7];
    const double R2_0 = x[0] * mu[2] + x[3] * mu[5] + x[6] * mu[8];
    const double R2_1 = x[1] * mu[2] + x[4] * mu[5] + x[7] * mu[8];
    const double R2_2 = x[2] * mu[2] + x[5] * mu[5] + x[8] * mu[8];
    const double R0_0_total = 1.0 + R0_0;
    const double square0 = R2_2 + (R1_1 + R0_0_total);
    const double square1 = R0_0_total - R1_1 - R2_2;
    const double square2 = 1.0 + R1_1 - R0_0 - R2_2;
    const double square3 = 1.0 + R2_2 - R0_0 - R1_1;
    const int is_less = square0 < square1;
    const double R2_1_gap = R2_1 - R1_2;
    const double row = (is_less ? R2_1_gap : square0);
    const double row_2 = (is_less ? square1 : R2_1_gap);
    const double R0_1_total = R0_1 + R1_0;
    const double R0_2_gap = R0_2 - R2_0;
    const double row_3 = (is_less ? R0_1_total : R0_2_gap);
    const double R0_2_total = R0_2 + R2_0;
    const double R1_0_gap = R1_0 - R0_1;
    const double row_4 = (is_less ? R0_2_total : R1_0_gap);
    const double largest = (is_less ? square1 : square0);
    const int is_less_2 = largest < square2;
    const double row_5 = (is_less_2 ? R0_2_gap : row);
    const double row_6 = (is_less_2 ? R0_1_total : row_2);
    const double row_7 = (is_less_2 ? square2 : row_3);
    const double R1_2_total = R1_2 + R2_1;
    const double row_8 = (is_less_2 ? R1_2_total : row_4);
    const double largest_2 = (is_less_2 ? square2 : largest);
    const int is_less_3 = largest_2 < square3;
    const double row_9 = (is_less_3 ? R1_0_gap : row_5);
    const double row_10 = (is_less_3 ? R0_2_total : row_6);
    const double row_11 = (is_less_3 ? R1_2_total : row_7);
    const double row_12 = (is_less_3 ? square3 : row_8);
    const double total_2 = row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9;
    const double row_length = sqrt(total_2);
    const double g0 = row_9 / row_length;
    const double g1 = row_10 / row_length;
    const double g2 = row_11 / row_length;
    const double g3 = row_12 / row_length;
    const double norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const double abs_g0 = fabs(g0);
    const int near = norm_s_squared < 0.249287;
    const double near_chosen = (near ? 4.011440628672975 * norm_s_squared : 0.0);
    const double t_over_norm_s_near = polynomial_t_over_norm_s_near(near_chosen);
    const double near_chosen_2 = (near ? 1.0 : norm_s_squared);
    const double norm_s = sqrt(near_chosen_2);
    const double atan2_norm_s_abs_g0 = atan2(norm_s, abs_g0);
    const double t = 2.0 * atan2_norm_s_abs_g0;
    const double t_ratio = t / norm_s;
    const double t_over_norm_s = (near ? t_over_norm_s_near : t_ratio);
    const int is_small = g0 < 0.0;
    const double chosen = (is_small ? -1.0 : 1.0);
    const double scale = t_over_norm_s * chosen;
    const double v0 = g1 * scale;
    const double v1 = g2 * scale;
    const double v2 = g3 * scale;
    const double log_det_series = polynomial_log_det_series(near_chosen);
    const double log_det_near = norm_s_squared * log_det_series;
    const double product = 0.5 * t_ratio;
    const double log_det = (near ? log_det_near : 2.0 * log(product));
    const double z0 = W[0] * v0 + W[1] * v1 + W[2] * v2;
    const double z1 = W[3] * v0 + W[4] * v1 + W[5] * v2;
    const double z2 = W[6] * v0 + W[7] * v1 + W[8] * v2;
    const double log_det_gap = log_det - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
    const double phi = amplitude * exp(log_det_gap);
    const double by_v2 = -(W[8] * z2) - W[5] * z1 - W[2] * z0;
    const double by_v1 = -(W[7] * z2) - W[4] * z1 - W[1] * z0;
    const double by_v0 = -(W[6] * z2) - W[3] * z1 - W[0] * z0;
    const double by_log_det_near = (near ? 1.0 : 0.0);
    const double by_log_det_series = norm_s_squared * by_log_det_near;
    const double log_det_series_slope = polynomial_log_det_series_slope(near_chosen);
    const double by_scale = g3 * by_v2 + g2 * by_v1 + g1 * by_v0;
    const double by_t_over_norm_s = chosen * by_scale;
    const double by_t_over_norm_s_near = (near ? by_t_over_norm_s : 0.0);
    const double total_3 = 0.5 * (2.0 * (near ? 0.0 : 1.0) / product) + (near ? 0.0 : by_t_over_norm_s);
    const double by_t = total_3 / norm_s;
    const double by_atan2_norm_s_abs_g0 = 2.0 * by_t;
    const double ratio = by_atan2_norm_s_abs_g0 / (near_chosen_2 + abs_g0 * abs_g0);
    const double norm_s_product = norm_s * ratio;
    const double by_abs_g0 = -norm_s_product;
    const double by_norm_s = abs_g0 * ratio - t_ratio * by_t;
    const double t_over_norm_s_near_slope = polynomial_t_over_norm_s_near_slope(near_chosen);
    const double by_norm_s_squared = log_det_series * by_log_det_near + (near ? 0.0 : by_norm_s / (2.0 *
        norm_s)) + 4.011440628672975 * (near ? by_log_det_series * log_det_series_slope +
        by_t_over_norm_s_near * t_over_norm_s_near_slope : 0.0);
    const double by_g0 = (is_small ? norm_s_product : by_abs_g0);
    const double product_2 = 2.0 * by_norm_s_squared;
    const double by_g3 = scale * by_v2 + g3 * product_2;
    const double by_g2 = scale * by_v1 + g2 * product_2;
    const double by_g1 = scale * by_v0 + g1 * product_2;
    const double by_g3_ratio = by_g3 / row_length;
    const double by_g2_ratio = by_g2 / row_length;
    const double by_g1_ratio = by_g1 / row_length;
    const double by_g0_ratio = by_g0 / row_length;
    const double by_row_length = -(g3 * by_g3_ratio) - g2 * by_g2_ratio - g1 * by_g1_ratio - g0 * by_g0_ratio;
    const int is_small_2 = total_2 == 0.0;
    const double product_3 = 2.0 * (is_small_2 ? 0.0 : by_row_length / (2.0 * (is_small_2 ? 1.0 :
        row_length)));
    const double by_row_9 = by_g0_ratio + row_9 * product_3;
    const double by_row_12 = by_g3_ratio + row_12 * product_3;
    const double by_row_11 = by_g2_ratio + row_11 * product_3;
    const double by_row_10 = by_g1_ratio + row_10 * product_3;
    const double by_square3 = (is_less_3 ? by_row_12 : 0.0);
    const double by_row_8 = (is_less_3 ? 0.0 : by_row_12);
    const double by_row_7 = (is_less_3 ? 0.0 : by_row_11);
    const double by_row_6 = (is_less_3 ? 0.0 : by_row_10);
    const double by_row_5 = (is_less_3 ? 0.0 : by_row_9);
    const double by_row_4 = (is_less_2 ? 0.0 : by_row_8);
    const double total_4 = (is_less_3 ? by_row_11 : 0.0) + (is_less_2 ? by_row_8 : 0.0);
    const double by_square2 = (is_less_2 ? by_row_7 : 0.0);
    const double by_row_3 = (is_less_2 ? 0.0 : by_row_7);
    const double by_row_2 = (is_less_2 ? 0.0 : by_row_6);
    const double by_row = (is_less_2 ? 0.0 : by_row_5);
    const double total_5 = (is_less_3 ? by_row_10 : 0.0) + (is_less ? by_row_4 : 0.0);
    const double total_6 = (is_less_3 ? by_row_9 : 0.0) + (is_less ? 0.0 : by_row_4);
    const double total_7 = (is_less_2 ? by_row_6 : 0.0) + (is_less ? by_row_3 : 0.0);
    const double total_8 = (is_less_2 ? by_row_5 : 0.0) + (is_less ? 0.0 : by_row_3);
    const double by_R0_2 = total_5 + total_8;
    const double by_R2_0 = total_5 - total_8;
    const double by_R0_1 = total_7 - total_6;
    const double by_R1_0 = total_6 + total_7;
    const double by_square1 = (is_less ? by_row_2 : 0.0);
    const double by_square0 = (is_less ? 0.0 : by_row);
    const double total_9 = (is_less ? 0.0 : by_row_2) + (is_less ? by_row : 0.0);
    const double by_R2_1 = total_4 + total_9;
    const double by_R1_2 = total_4 - total_9;
    const double by_R2_2 = by_square0 + (by_square3 - by_square2 - by_square1);
    const double by_R1_1 = by_square0 + (by_square2 - by_square3 - by_square1);
    const double by_R0_0 = -by_square3 - by_square2 + (by_square1 + by_square0);
    const double exponent_by_x8 = mu[8] * by_R2_2 + mu[7] * by_R1_2 + mu[6] * by_R0_2;
    const double exponent_by_x5 = mu[5] * by_R2_2 + mu[4] * by_R1_2 + mu[3] * by_R0_2;
    const double exponent_by_x2 = mu[2] * by_R2_2 + mu[1] * by_R1_2 + mu[0] * by_R0_2;
    const double exponent_by_x7 = mu[8] * by_R2_1 + mu[7] * by_R1_1 + mu[6] * by_R0_1;
    const double exponent_by_x4 = mu[5] * by_R2_1 + mu[4] * by_R1_1 + mu[3] * by_R0_1;
    const double exponent_by_x1 = mu[2] * by_R2_1 + mu[1] * by_R1_1 + mu[0] * by_R0_1;
    const double exponent_by_x6 = mu[8] * by_R2_0 + mu[7] * by_R1_0 + mu[6] * by_R0_0;
    const double exponent_by_x3 = mu[5] * by_R2_0 + mu[4] * by_R1_0 + mu[3] * by_R0_0;
    const double exponent_by_x0 = mu[2] * by_R2_0 + mu[1] * by_R1_0 + mu[0] * by_R0_0;
    const double df0 = phi * exponent_by_x0;
    const double df1 = phi * exponent_by_x1;
    const double df2 = phi * exponent_by_x2;
    const double df3 = phi * exponent_by_x3;
    const double df4 = phi * exponent_by_x4;
    const double df5 = phi * exponent_by_x5;
    const double df6 = phi * exponent_by_x6;
    const double df7 = phi * exponent_by_x7;
    const double df8 = phi * exponent_by_x8;
    const double gap = x[2] * df1 + x[5] * df4 + x[8] * df7 - x[1] * df2 - x[4] * df5;
    const double gradient0 = gap - x[7] * df8;
    const double gap_2 = x[0] * df2 + x[3] * df5 + x[6] * df8 - x[2] * df0 - x[5] * df3;
    const double gradient1 = gap_2 - x[8] * df6;
    const double gap_3 = x[1] * df0 + x[4] * df3 + x[7] * df6 - x[0] * df1 - x[3] * df4;
    const double gradient2 = gap_3 - x[6] * df7;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void so3_matrix_splat_batch(
    size_t count,
    const double *SO3_MATRIX_RESTRICT x,
    const double *SO3_MATRIX_RESTRICT mu,
    const double *SO3_MATRIX_RESTRICT W,
    const double *SO3_MATRIX_RESTRICT amplitude,
    double *SO3_MATRIX_RESTRICT value_out,
    double *SO3_MATRIX_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_splat(x + 9 * i, mu + 9 * i, W + 9 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void so3_matrix_frame(const double *SO3_MATRIX_RESTRICT p, double *SO3_MATRIX_RESTRICT frame) {
    double left[9][3];
    for (int i = 0; i < 9; ++i) {
        double axis[9];
        for (int j = 0; j < 9; ++j) axis[j] = i == j ? 1.0 : 0.0;
        so3_matrix_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 3; ++row) {
        double *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 9; ++i)
            if (so3_matrix_norm(p, left[i]) > so3_matrix_norm(p, left[longest])) longest = i;
        const double length = so3_matrix_norm(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 9; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 9];
            const double part = so3_matrix_inner(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}

/* Of degree 4, within 2^-30 of that of double precision. */
static inline float polynomial_cos__near_f(float x) {
    return 0.9999999994976135f + x * (-0.49519647485985047f + x * (0.040869727563992035f + x *
        (-0.0013486780417677447f + x * 2.3213754968692044e-05f)));
}

/* Of degree 4, within 2^-34 of that of double precision. */
static inline float polynomial_sinc__near_f(float x) {
    return 0.999999999954183f + x * (-0.1650654977075424f + x * (0.008173967428130452f + x *
        (-0.00019269751212383233f + x * 2.592292971066502e-06f)));
}

/* Of degree 5, within 2^-27 of that of double precision. */
static inline float polynomial_t_over_norm_s_near_f(float x) {
    return 1.9999999916408444f + x * (0.08309625685133959f + x * (0.009314899571001777f + x *
        (0.001410660168357637f + x * (0.0001850457232808171f + x * 8.1767340923012e-05f))));
}

/* Of degree 6, within 2^-30 of that of double precision. */
static inline float polynomial_log_det_series_f(float x) {
    return 0.33333333360654344f + x * (0.030468384794974636f + x * (0.004187186052703318f + x *
        (0.0006798423432636281f + x * (0.00012869008203200835f + x * (1.4352383872053921e-05f + x *
        1.0146648022958735e-05f)))));
}

/* Of degree 7, within 2^-29 of that of double precision. */
static inline float polynomial_log_det_series_slope_f(float x) {
    return 0.030468411075324144f + x * (0.00837355342611542f + x * (0.0020466142655597187f + x *
        (0.0004893663510207316f + x * (0.00011341332759154923f + x * (3.308965514831338e-05f + x *
        (7.033240749837545e-07f + x * 4.5653796914644905e-06f))))));
}

/* Of degree 7, within 2^-30 of that of double precision. */
static inline float polynomial_t_over_norm_s_near_slope_f(float x) {
    return 0.08309566660530374f + x * (0.0186432102329603f + x * (0.004149402027001096f + x *
        (0.0009398850567115093f + x * (0.00021071714765224622f + x * (5.936713146666543e-05f + x *
        (1.5937893933276167e-06f + x * 7.904358196252664e-06f))))));
}

/* Eigenvalues, ascending, and eigenvectors of a symmetric 3 x 3 matrix, by Jacobi's rotations. */
static void symmetric_eigh_3_f(const float *in, float *out) {
    float a[3][3] = {{in[0], in[1], in[2]}, {in[1], in[3], in[4]}, {in[2], in[4], in[5]}}, v[3][3] = {{0}}, poison = 0;
    for (int i = 0; i < 3; ++i) v[i][i] = 1;
    for (int sweep = 0; sweep < 8; ++sweep) {
        for (int p = 0; p < 3; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                const float twice = 2 * a[p][q], gap = a[q][q] - a[p][p];
                if (twice == 0) continue;
                const float theta = gap / twice;
                const float t = (theta < 0 ? -1 : 1) / (fabsf(theta) + sqrtf(theta * theta + 1));
                const float c = 1 / sqrtf(t * t + 1), s = t * c, part = s / (1 + c);
                a[p][p] -= t * a[p][q];
                a[q][q] += t * a[p][q];
                a[p][q] = a[q][p] = 0;
                for (int k = 0; k < 3; ++k) {
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
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) poison += 0 * a[i][j] + 0 * v[i][j]; /* NaN when one of them is not finite */
    for (int i = 0; i < 3; ++i) a[i][i] += poison;
    for (int i = 0; i < 3; ++i) {
        int rank = 0; /* how many come before: equal ones in their order */
        for (int j = 0; j < 3; ++j) rank += a[j][j] < a[i][i] || (j < i && !(a[j][j] > a[i][i]));
        out[rank] = a[i][i];
        for (int k = 0; k < 3; ++k) out[3 + 3 * k + rank] = v[k][i];
    }
}

static float scalar_invsqrt_f(float x) { return 1 / sqrtf(x); }

/* V A V^T, packed. */
static void out_of_eigenbasis_3_f(const float *eigh, const float (*in)[3], float *out) {
    const float *v = eigh + 3;
    for (int i = 0; i < 3; ++i) {
        float half[3] = {0};
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j) half[j] += v[3 * i + k] * in[k][j];
        for (int j = i; j < 3; ++j) {
            float sum = 0;
            for (int k = 0; k < 3; ++k) sum += half[k] * v[3 * j + k];
            *out++ = sum;
        }
    }
}

/* invsqrt(A) of the eigen-decomposition of A, packed. */
static void symmetric_invsqrt_3_f(const float *eigh, float *out) {
    float w0[3], total[3][3] = {{0}};
    for (int i0 = 0; i0 < 3; ++i0) w0[i0] = scalar_invsqrt_f(eigh[i0]);
    for (int i0 = 0; i0 < 3; ++i0)
        total[i0][i0] += w0[i0];
    out_of_eigenbasis_3_f(eigh, (const float (*)[3])total, out);
}

/* p * invsqrtm(transpose(p) * p) */
void so3_matrix_project_f(const float *SO3_MATRIX_RESTRICT x, float *SO3_MATRIX_RESTRICT p_out) {
    const float entry_0_0 = x[0] * x[0] + x[3] * x[3] + x[6] * x[6];
    const float entry_0_1 = x[0] * x[1] + x[3] * x[4] + x[6] * x[7];
    const float entry_0_2 = x[0] * x[2] + x[3] * x[5] + x[6] * x[8];
    const float entry_1_1 = x[1] * x[1] + x[4] * x[4] + x[7] * x[7];
    const float entry_1_2 = x[1] * x[2] + x[4] * x[5] + x[7] * x[8];
    const float entry_2_2 = x[2] * x[2] + x[5] * x[5] + x[8] * x[8];
    float entry_0_0_eigh[12];
    {
        const float in_0[6] = {entry_0_0, entry_0_1, entry_0_2, entry_1_1, entry_1_2, entry_2_2};
        symmetric_eigh_3_f(in_0, entry_0_0_eigh);
    }
    float invsqrtm[6];
    symmetric_invsqrt_3_f(entry_0_0_eigh, invsqrtm);
    const float invsqrtm_value0_0 = invsqrtm[0];
    const float invsqrtm_value0_1 = invsqrtm[1];
    const float invsqrtm_value0_2 = invsqrtm[2];
    const float invsqrtm_value1_1 = invsqrtm[3];
    const float invsqrtm_value1_2 = invsqrtm[4];
    const float invsqrtm_value2_2 = invsqrtm[5];
    const float p0 = x[0] * invsqrtm_value0_0 + x[1] * invsqrtm_value0_1 + x[2] * invsqrtm_value0_2;
    const float p1 = x[0] * invsqrtm_value0_1 + x[1] * invsqrtm_value1_1 + x[2] * invsqrtm_value1_2;
    const float p2 = x[0] * invsqrtm_value0_2 + x[1] * invsqrtm_value1_2 + x[2] * invsqrtm_value2_2;
    const float p3 = x[3] * invsqrtm_value0_0 + x[4] * invsqrtm_value0_1 + x[5] * invsqrtm_value0_2;
    const float p4 = x[3] * invsqrtm_value0_1 + x[4] * invsqrtm_value1_1 + x[5] * invsqrtm_value1_2;
    const float p5 = x[3] * invsqrtm_value0_2 + x[4] * invsqrtm_value1_2 + x[5] * invsqrtm_value2_2;
    const float p6 = x[6] * invsqrtm_value0_0 + x[7] * invsqrtm_value0_1 + x[8] * invsqrtm_value0_2;
    const float p7 = x[6] * invsqrtm_value0_1 + x[7] * invsqrtm_value1_1 + x[8] * invsqrtm_value1_2;
    const float p8 = x[6] * invsqrtm_value0_2 + x[7] * invsqrtm_value1_2 + x[8] * invsqrtm_value2_2;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
    p_out[7] = p7;
    p_out[8] = p8;
}

void so3_matrix_project_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT x,
    float *SO3_MATRIX_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_project_f(x + 9 * i, p_out + 9 * i);
}

/* (E E^T)^-1 E x */
void so3_matrix_to_tangent_f(
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT x,
    float *SO3_MATRIX_RESTRICT v_out) {
    const float product = 0.5f * p[2];
    const float product_2 = 0.5f * p[5];
    const float product_3 = 0.5f * p[8];
    const float product_4 = 0.5f * p[1];
    const float product_5 = 0.5f * p[4];
    const float gap = x[1] * product + x[4] * product_2 + x[7] * product_3 - x[2] * product_4 - x[5] *
        product_5;
    const float product_6 = 0.5f * p[7];
    const float v0 = gap - x[8] * product_6;
    const float product_7 = 0.5f * p[0];
    const float product_8 = 0.5f * p[3];
    const float product_9 = 0.5f * p[6];
    const float gap_2 = x[2] * product_7 + x[5] * product_8 + x[8] * product_9 - x[0] * product - x[3] *
        product_2;
    const float v1 = gap_2 - x[6] * product_3;
    const float gap_3 = x[0] * product_4 + x[3] * product_5 + x[6] * product_6 - x[1] * product_7 - x[4] *
        product_8;
    const float v2 = gap_3 - x[7] * product_9;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void so3_matrix_to_tangent_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT x,
    float *SO3_MATRIX_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_to_tangent_f(p + 9 * i, x + 9 * i, v_out + 3 * i);
}

/* dot(u, v) */
float so3_matrix_inner_f(
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT u,
    const float *SO3_MATRIX_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void so3_matrix_inner_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT u,
    const float *SO3_MATRIX_RESTRICT v,
    float *SO3_MATRIX_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = so3_matrix_inner_f(p + 9 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(<v, v>_p) */
float so3_matrix_norm_f(const float *SO3_MATRIX_RESTRICT p, const float *SO3_MATRIX_RESTRICT v) {
    (void)p;
    return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void so3_matrix_norm_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT v,
    float *SO3_MATRIX_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = so3_matrix_norm_f(p + 9 * i, v + 3 * i);
}

/* G(p) v */
void so3_matrix_flat_f(
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT v,
    float *SO3_MATRIX_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void so3_matrix_flat_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT v,
    float *SO3_MATRIX_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_flat_f(p + 9 * i, v + 3 * i, covector_out + 3 * i);
}

/* p * rotation([cos(norm(v) / 2), sinc(norm(v) / 2) / 2 * v]) */
void so3_matrix_exp_f(
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT v,
    float *SO3_MATRIX_RESTRICT q_out) {
    const float squared = v[0] * v[0];
    const float squared_2 = v[1] * v[1];
    const float squared_3 = v[2] * v[2];
    const float norm_v_squared = squared + squared_2 + squared_3;
    const int near = 0.25f * norm_v_squared < 0.990393f;
    const float near_chosen = (near ? 0.2524250474306664f * norm_v_squared : 0.0f);
    const float cos__near = polynomial_cos__near_f(near_chosen);
    const float norm_v = sqrtf((near ? 1.0f : norm_v_squared));
    const float norm_v_product = 0.5f * norm_v;
    const float cos_ = (near ? cos__near : cosf(norm_v_product));
    const float sinc__near = polynomial_sinc__near_f(near_chosen);
    const float sinc_ = (near ? sinc__near : 2.0f * sinf(norm_v_product) / norm_v);
    const float scale = 0.5f * sinc_;
    const float scale_squared = scale * scale;
    const float product = 2.0f * scale_squared;
    const float product_2 = squared_2 * product;
    const float product_3 = squared_3 * product;
    const float gap = 1.0f - product_2 - product_3;
    const float cos__product = cos_ * sinc_;
    const float product_4 = v[2] * cos__product;
    const float product_5 = 2.0f * v[0];
    const float product_6 = scale_squared * (v[1] * product_5);
    const float total_2 = product_4 + product_6;
    const float product_7 = scale_squared * (v[2] * product_5);
    const float product_8 = v[1] * cos__product;
    const float gap_2 = product_7 - product_8;
    const float q0 = p[0] * gap + p[1] * total_2 + p[2] * gap_2;
    const float gap_3 = product_6 - product_4;
    const float gap_4 = 1.0f - squared * product;
    const float gap_5 = gap_4 - product_3;
    const float product_9 = v[0] * cos__product;
    const float product_10 = scale_squared * (v[2] * (2.0f * v[1]));
    const float total_3 = product_9 + product_10;
    const float q1 = p[0] * gap_3 + p[1] * gap_5 + p[2] * total_3;
    const float total_4 = product_7 + product_8;
    const float gap_6 = product_10 - product_9;
    const float gap_7 = gap_4 - product_2;
    const float q2 = p[0] * total_4 + p[1] * gap_6 + p[2] * gap_7;
    const float q3 = p[3] * gap + p[4] * total_2 + p[5] * gap_2;
    const float q4 = p[3] * gap_3 + p[4] * gap_5 + p[5] * total_3;
    const float q5 = p[3] * total_4 + p[4] * gap_6 + p[5] * gap_7;
    const float q6 = p[6] * gap + p[7] * total_2 + p[8] * gap_2;
    const float q7 = p[6] * gap_3 + p[7] * gap_5 + p[8] * total_3;
    const float q8 = p[6] * total_4 + p[7] * gap_6 + p[8] * gap_7;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
    q_out[4] = q4;
    q_out[5] = q5;
    q_out[6] = q6;
    q_out[7] = q7;
    q_out[8] = q8;
}

void so3_matrix_exp_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT v,
    float *SO3_MATRIX_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_exp_f(p + 9 * i, v + 3 * i, q_out + 9 * i);
}

/* sign(g[0]) * t * s / norm(s) */
void so3_matrix_log_f(
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT q,
    float *SO3_MATRIX_RESTRICT v_out) {
    const float R0_0 = p[0] * q[0] + p[3] * q[3] + p[6] * q[6];
    const float R0_1 = p[0] * q[1] + p[3] * q[4] + p[6] * q[7];
    const float R0_2 = p[0] * q[2] + p[3] * q[5] + p[6] * q[8];
    const float R1_0 = p[1] * q[0] + p[4] * q[3] + p[7] * q[6];
    const float R1_1 = p[1] * q[1] + p[4] * q[4] + p[7] * q[7];
    const float R1_2 = p[1] * q[2] + p[4] * q[5] + p[7] * q[8];
    const float R2_0 = p[2] * q[0] + p[5] * q[3] + p[8] * q[6];
    const float R2_1 = p[2] * q[1] + p[5] * q[4] + p[8] * q[7];
    const float R2_2 = p[2] * q[2] + p[5] * q[5] + p[8] * q[8];
    const float R0_0_total = 1.0f + R0_0;
    const float square0 = R2_2 + (R1_1 + R0_0_total);
    const float square1 = R0_0_total - R1_1 - R2_2;
    const float square2 = 1.0f + R1_1 - R0_0 - R2_2;
    const float square3 = 1.0f + R2_2 - R0_0 - R1_1;
    const int is_less = square0 < square1;
    const float R2_1_gap = R2_1 - R1_2;
    const float row = (is_less ? R2_1_gap : square0);
    const float row_2 = (is_less ? square1 : R2_1_gap);
    const float R0_1_total = R0_1 + R1_0;
    const float R0_2_gap = R0_2 - R2_0;
    const float row_3 = (is_less ? R0_1_total : R0_2_gap);
    const float R0_2_total = R0_2 + R2_0;
    const float R1_0_gap = R1_0 - R0_1;
    const float row_4 = (is_less ? R0_2_total : R1_0_gap);
    const float largest = (is_less ? square1 : square0);
    const int is_less_2 = largest < square2;
    const float row_5 = (is_less_2 ? R0_2_gap : row);
    const float row_6 = (is_less_2 ? R0_1_total : row_2);
    const float row_7 = (is_less_2 ? square2 : row_3);
    const float R1_2_total = R1_2 + R2_1;
    const float row_8 = (is_less_2 ? R1_2_total : row_4);
    const float largest_2 = (is_less_2 ? square2 : largest);
    const int is_less_3 = largest_2 < square3;
    const float row_9 = (is_less_3 ? R1_0_gap : row_5);
    const float row_10 = (is_less_3 ? R0_2_total : row_6);
    const float row_11 = (is_less_3 ? R1_2_total : row_7);
    const float row_12 = (is_less_3 ? square3 : row_8);
    const float row_length = sqrtf(row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9);
    const float g0 = row_9 / row_length;
    const float g1 = row_10 / row_length;
    const float g2 = row_11 / row_length;
    const float g3 = row_12 / row_length;
    const float norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const float abs_g0 = fabsf(g0);
    const int near = norm_s_squared < 0.249287f;
    const float t_over_norm_s_near = polynomial_t_over_norm_s_near_f((near ? 4.011440628672975f *
        norm_s_squared : 0.0f));
    const float norm_s = sqrtf((near ? 1.0f : norm_s_squared));
    const float atan2_norm_s_abs_g0 = atan2f(norm_s, abs_g0);
    const float t = 2.0f * atan2_norm_s_abs_g0;
    const float t_over_norm_s = (near ? t_over_norm_s_near : t / norm_s);
    const float scale = t_over_norm_s * (g0 < 0.0f ? -1.0f : 1.0f);
    const float v0 = g1 * scale;
    const float v1 = g2 * scale;
    const float v2 = g3 * scale;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void so3_matrix_log_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT q,
    float *SO3_MATRIX_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_log_f(p + 9 * i, q + 9 * i, v_out + 3 * i);
}

/* t */
float so3_matrix_distance_f(const float *SO3_MATRIX_RESTRICT p, const float *SO3_MATRIX_RESTRICT q) {
    const float R0_0 = p[0] * q[0] + p[3] * q[3] + p[6] * q[6];
    const float R0_1 = p[0] * q[1] + p[3] * q[4] + p[6] * q[7];
    const float R0_2 = p[0] * q[2] + p[3] * q[5] + p[6] * q[8];
    const float R1_0 = p[1] * q[0] + p[4] * q[3] + p[7] * q[6];
    const float R1_1 = p[1] * q[1] + p[4] * q[4] + p[7] * q[7];
    const float R1_2 = p[1] * q[2] + p[4] * q[5] + p[7] * q[8];
    const float R2_0 = p[2] * q[0] + p[5] * q[3] + p[8] * q[6];
    const float R2_1 = p[2] * q[1] + p[5] * q[4] + p[8] * q[7];
    const float R2_2 = p[2] * q[2] + p[5] * q[5] + p[8] * q[8];
    const float R0_0_total = 1.0f + R0_0;
    const float square0 = R2_2 + (R1_1 + R0_0_total);
    const float square1 = R0_0_total - R1_1 - R2_2;
    const float square2 = 1.0f + R1_1 - R0_0 - R2_2;
    const float square3 = 1.0f + R2_2 - R0_0 - R1_1;
    const int is_less = square0 < square1;
    const float R2_1_gap = R2_1 - R1_2;
    const float row = (is_less ? R2_1_gap : square0);
    const float row_2 = (is_less ? square1 : R2_1_gap);
    const float R0_1_total = R0_1 + R1_0;
    const float R0_2_gap = R0_2 - R2_0;
    const float row_3 = (is_less ? R0_1_total : R0_2_gap);
    const float R0_2_total = R0_2 + R2_0;
    const float R1_0_gap = R1_0 - R0_1;
    const float row_4 = (is_less ? R0_2_total : R1_0_gap);
    const float largest = (is_less ? square1 : square0);
    const int is_less_2 = largest < square2;
    const float row_5 = (is_less_2 ? R0_2_gap : row);
    const float row_6 = (is_less_2 ? R0_1_total : row_2);
    const float row_7 = (is_less_2 ? square2 : row_3);
    const float R1_2_total = R1_2 + R2_1;
    const float row_8 = (is_less_2 ? R1_2_total : row_4);
    const float largest_2 = (is_less_2 ? square2 : largest);
    const int is_less_3 = largest_2 < square3;
    const float row_9 = (is_less_3 ? R1_0_gap : row_5);
    const float row_10 = (is_less_3 ? R0_2_total : row_6);
    const float row_11 = (is_less_3 ? R1_2_total : row_7);
    const float row_12 = (is_less_3 ? square3 : row_8);
    const float row_length = sqrtf(row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9);
    const float g0 = row_9 / row_length;
    const float g1 = row_10 / row_length;
    const float g2 = row_11 / row_length;
    const float g3 = row_12 / row_length;
    const float norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const float norm_s = sqrtf(norm_s_squared);
    const float abs_g0 = fabsf(g0);
    const float atan2_norm_s_abs_g0 = atan2f(norm_s, abs_g0);
    const float t = 2.0f * atan2_norm_s_abs_g0;
    return t;
}

void so3_matrix_distance_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT q,
    float *SO3_MATRIX_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = so3_matrix_distance_f(p + 9 * i, q + 9 * i);
}

/* 2*log(t_over_norm_s/2) */
float so3_matrix_log_abs_det_f(const float *SO3_MATRIX_RESTRICT p, const float *SO3_MATRIX_RESTRICT q) {
    const float R0_0 = p[0] * q[0] + p[3] * q[3] + p[6] * q[6];
    const float R0_1 = p[0] * q[1] + p[3] * q[4] + p[6] * q[7];
    const float R0_2 = p[0] * q[2] + p[3] * q[5] + p[6] * q[8];
    const float R1_0 = p[1] * q[0] + p[4] * q[3] + p[7] * q[6];
    const float R1_1 = p[1] * q[1] + p[4] * q[4] + p[7] * q[7];
    const float R1_2 = p[1] * q[2] + p[4] * q[5] + p[7] * q[8];
    const float R2_0 = p[2] * q[0] + p[5] * q[3] + p[8] * q[6];
    const float R2_1 = p[2] * q[1] + p[5] * q[4] + p[8] * q[7];
    const float R2_2 = p[2] * q[2] + p[5] * q[5] + p[8] * q[8];
    const float R0_0_total = 1.0f + R0_0;
    const float square0 = R2_2 + (R1_1 + R0_0_total);
    const float square1 = R0_0_total - R1_1 - R2_2;
    const float square2 = 1.0f + R1_1 - R0_0 - R2_2;
    const float square3 = 1.0f + R2_2 - R0_0 - R1_1;
    const int is_less = square0 < square1;
    const float R2_1_gap = R2_1 - R1_2;
    const float row = (is_less ? R2_1_gap : square0);
    const float row_2 = (is_less ? square1 : R2_1_gap);
    const float R0_1_total = R0_1 + R1_0;
    const float R0_2_gap = R0_2 - R2_0;
    const float row_3 = (is_less ? R0_1_total : R0_2_gap);
    const float R0_2_total = R0_2 + R2_0;
    const float R1_0_gap = R1_0 - R0_1;
    const float row_4 = (is_less ? R0_2_total : R1_0_gap);
    const float largest = (is_less ? square1 : square0);
    const int is_less_2 = largest < square2;
    const float row_5 = (is_less_2 ? R0_2_gap : row);
    const float row_6 = (is_less_2 ? R0_1_total : row_2);
    const float row_7 = (is_less_2 ? square2 : row_3);
    const float R1_2_total = R1_2 + R2_1;
    const float row_8 = (is_less_2 ? R1_2_total : row_4);
    const float largest_2 = (is_less_2 ? square2 : largest);
    const int is_less_3 = largest_2 < square3;
    const float row_9 = (is_less_3 ? R1_0_gap : row_5);
    const float row_10 = (is_less_3 ? R0_2_total : row_6);
    const float row_11 = (is_less_3 ? R1_2_total : row_7);
    const float row_12 = (is_less_3 ? square3 : row_8);
    const float row_length = sqrtf(row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9);
    const float g0 = row_9 / row_length;
    const float g1 = row_10 / row_length;
    const float g2 = row_11 / row_length;
    const float g3 = row_12 / row_length;
    const float norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const float abs_g0 = fabsf(g0);
    const int near = norm_s_squared < 0.249287f;
    const float norm_s = sqrtf((near ? 1.0f : norm_s_squared));
    const float atan2_norm_s_abs_g0 = atan2f(norm_s, abs_g0);
    const float t = 2.0f * atan2_norm_s_abs_g0;
    const float log_det_series = polynomial_log_det_series_f((near ? 4.011440628672975f * norm_s_squared :
        0.0f));
    const float log_det_near = norm_s_squared * log_det_series;
    const float log_det = (near ? log_det_near : 2.0f * logf(0.5f * (t / norm_s)));
    return log_det;
}

void so3_matrix_log_abs_det_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT q,
    float *SO3_MATRIX_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = so3_matrix_log_abs_det_f(p + 9 * i, q + 9 * i);
}

/* G^-1 E df */
void so3_matrix_riemannian_gradient_f(
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT df,
    float *SO3_MATRIX_RESTRICT gradient_out) {
    const float gap = p[2] * df[1] + p[5] * df[4] + p[8] * df[7] - p[1] * df[2] - p[4] * df[5];
    const float gradient0 = gap - p[7] * df[8];
    const float gap_2 = p[0] * df[2] + p[3] * df[5] + p[6] * df[8] - p[2] * df[0] - p[5] * df[3];
    const float gradient1 = gap_2 - p[8] * df[6];
    const float gap_3 = p[1] * df[0] + p[4] * df[3] + p[7] * df[6] - p[0] * df[1] - p[3] * df[4];
    const float gradient2 = gap_3 - p[6] * df[7];
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void so3_matrix_riemannian_gradient_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT df,
    float *SO3_MATRIX_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_riemannian_gradient_f(p + 9 * i, df + 9 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
float so3_matrix_gradient_norm_f(const float *SO3_MATRIX_RESTRICT p, const float *SO3_MATRIX_RESTRICT df) {
    const float gap = p[2] * df[1] + p[5] * df[4] + p[8] * df[7] - p[1] * df[2] - p[4] * df[5];
    const float gradient0 = gap - p[7] * df[8];
    const float gap_2 = p[0] * df[2] + p[3] * df[5] + p[6] * df[8] - p[2] * df[0] - p[5] * df[3];
    const float gradient1 = gap_2 - p[8] * df[6];
    const float gap_3 = p[1] * df[0] + p[4] * df[3] + p[7] * df[6] - p[0] * df[1] - p[3] * df[4];
    const float gradient2 = gap_3 - p[6] * df[7];
    return sqrtf(gradient0 * gradient0 + gradient1 * gradient1 + gradient2 * gradient2);
}

void so3_matrix_gradient_norm_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT df,
    float *SO3_MATRIX_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = so3_matrix_gradient_norm_f(p + 9 * i, df + 9 * i);
}

/* rotation(h / norm(h)) * v */
void so3_matrix_transport_f(
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT q,
    const float *SO3_MATRIX_RESTRICT v,
    float *SO3_MATRIX_RESTRICT w_out) {
    const float R0_0 = p[0] * q[0] + p[3] * q[3] + p[6] * q[6];
    const float R0_1 = p[0] * q[1] + p[3] * q[4] + p[6] * q[7];
    const float R0_2 = p[0] * q[2] + p[3] * q[5] + p[6] * q[8];
    const float R1_0 = p[1] * q[0] + p[4] * q[3] + p[7] * q[6];
    const float R1_1 = p[1] * q[1] + p[4] * q[4] + p[7] * q[7];
    const float R1_2 = p[1] * q[2] + p[4] * q[5] + p[7] * q[8];
    const float R2_0 = p[2] * q[0] + p[5] * q[3] + p[8] * q[6];
    const float R2_1 = p[2] * q[1] + p[5] * q[4] + p[8] * q[7];
    const float R2_2 = p[2] * q[2] + p[5] * q[5] + p[8] * q[8];
    const float R0_0_total = 1.0f + R0_0;
    const float square0 = R2_2 + (R1_1 + R0_0_total);
    const float square1 = R0_0_total - R1_1 - R2_2;
    const float square2 = 1.0f + R1_1 - R0_0 - R2_2;
    const float square3 = 1.0f + R2_2 - R0_0 - R1_1;
    const int is_less = square0 < square1;
    const float R2_1_gap = R2_1 - R1_2;
    const float row = (is_less ? R2_1_gap : square0);
    const float row_2 = (is_less ? square1 : R2_1_gap);
    const float R0_1_total = R0_1 + R1_0;
    const float R0_2_gap = R0_2 - R2_0;
    const float row_3 = (is_less ? R0_1_total : R0_2_gap);
    const float R0_2_total = R0_2 + R2_0;
    const float R1_0_gap = R1_0 - R0_1;
    const float row_4 = (is_less ? R0_2_total : R1_0_gap);
    const float largest = (is_less ? square1 : square0);
    const int is_less_2 = largest < square2;
    const float row_5 = (is_less_2 ? R0_2_gap : row);
    const float row_6 = (is_less_2 ? R0_1_total : row_2);
    const float row_7 = (is_less_2 ? square2 : row_3);
    const float R1_2_total = R1_2 + R2_1;
    const float row_8 = (is_less_2 ? R1_2_total : row_4);
    const float largest_2 = (is_less_2 ? square2 : largest);
    const int is_less_3 = largest_2 < square3;
    const float row_9 = (is_less_3 ? R1_0_gap : row_5);
    const float row_10 = (is_less_3 ? R0_2_total : row_6);
    const float row_11 = (is_less_3 ? R1_2_total : row_7);
    const float row_12 = (is_less_3 ? square3 : row_8);
    const float row_length = sqrtf(row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9);
    const float g0 = row_9 / row_length;
    const float g1 = row_10 / row_length;
    const float g2 = row_11 / row_length;
    const float g3 = row_12 / row_length;
    const float abs_g0 = fabsf(g0);
    const float chosen = (g0 < 0.0f ? -1.0f : 1.0f);
    const float h0 = 1.0f + abs_g0;
    const float g1_product = g1 * chosen;
    const float g2_product = g2 * chosen;
    const float g3_product = g3 * chosen;
    const float squared = g1_product * g1_product;
    const float squared_2 = g2_product * g2_product;
    const float squared_3 = g3_product * g3_product;
    const float norm_h_squared = h0 * h0 + squared + squared_2 + squared_3;
    const float norm_h = sqrtf(norm_h_squared);
    const float scale_3 = 1.0f / norm_h;
    const float scale_3_squared = scale_3 * scale_3;
    const float product = 2.0f * squared_2 * scale_3_squared;
    const float product_2 = scale_3_squared * (2.0f * squared_3);
    const float product_3 = 2.0f * g1_product;
    const float product_4 = scale_3_squared * (g2_product * product_3);
    const float h0_product = 2.0f * h0;
    const float product_5 = scale_3_squared * (g3_product * h0_product);
    const float product_6 = scale_3_squared * (g2_product * h0_product);
    const float product_7 = scale_3_squared * (g3_product * product_3);
    const float w0 = v[0] * (1.0f - product - product_2) + v[1] * (product_4 + product_5) + v[2] * (product_7
        - product_6);
    const float gap = 1.0f - scale_3_squared * (2.0f * squared);
    const float product_8 = scale_3_squared * (g3_product * (2.0f * g2_product));
    const float product_9 = scale_3_squared * (g1_product * h0_product);
    const float w1 = v[0] * (product_4 - product_5) + v[1] * (gap - product_2) + v[2] * (product_8 +
        product_9);
    const float w2 = v[0] * (product_6 + product_7) + v[1] * (product_8 - product_9) + v[2] * (gap - product);
    w_out[0] = w0;
    w_out[1] = w1;
    w_out[2] = w2;
}

void so3_matrix_transport_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT p,
    const float *SO3_MATRIX_RESTRICT q,
    const float *SO3_MATRIX_RESTRICT v,
    float *SO3_MATRIX_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_transport_f(p + 9 * i, q + 9 * i, v + 3 * i, w_out + 3 * i);
}

/* rotation(a / norm(a)) */
void so3_matrix_sample_f(
    const float *SO3_MATRIX_RESTRICT normal,
    const float *SO3_MATRIX_RESTRICT uniform,
    float *SO3_MATRIX_RESTRICT p_out) {
    (void)uniform;
    const float squared = normal[1] * normal[1];
    const float squared_2 = normal[2] * normal[2];
    const float squared_3 = normal[3] * normal[3];
    const float norm_a_squared = normal[0] * normal[0] + squared + squared_2 + squared_3;
    const float norm_a = sqrtf(norm_a_squared);
    const float scale = 1.0f / norm_a;
    const float scale_squared = scale * scale;
    const float product = 2.0f * squared_2 * scale_squared;
    const float product_2 = scale_squared * (2.0f * squared_3);
    const float p0 = 1.0f - product - product_2;
    const float product_3 = 2.0f * normal[1];
    const float product_4 = scale_squared * (normal[2] * product_3);
    const float product_5 = 2.0f * normal[0];
    const float product_6 = scale_squared * (normal[3] * product_5);
    const float p1 = product_4 - product_6;
    const float product_7 = scale_squared * (normal[2] * product_5);
    const float product_8 = scale_squared * (normal[3] * product_3);
    const float p2 = product_7 + product_8;
    const float p3 = product_4 + product_6;
    const float gap = 1.0f - scale_squared * (2.0f * squared);
    const float p4 = gap - product_2;
    const float product_9 = scale_squared * (normal[3] * (2.0f * normal[2]));
    const float product_10 = scale_squared * (normal[1] * product_5);
    const float p5 = product_9 - product_10;
    const float p6 = product_8 - product_7;
    const float p7 = product_9 + product_10;
    const float p8 = gap - product;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
    p_out[7] = p7;
    p_out[8] = p8;
}

void so3_matrix_sample_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT normal,
    const float *SO3_MATRIX_RESTRICT uniform,
    float *SO3_MATRIX_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_sample_f(normal + 9 * i, uniform + 9 * i, p_out + 9 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void so3_matrix_splat_f(
    const float *SO3_MATRIX_RESTRICT x,
    const float *SO3_MATRIX_RESTRICT mu,
    const float *SO3_MATRIX_RESTRICT W,
    float amplitude,
    float *SO3_MATRIX_RESTRICT value_out,
    float *SO3_MATRIX_RESTRICT gradient_out) {
    const float R0_0 = x[0] * mu[0] + x[3] * mu[3] + x[6] * mu[6];
    const float R0_1 = x[1] * mu[0] + x[4] * mu[3] + x[7] * mu[6];
    const float R0_2 = x[2] * mu[0] + x[5] * mu[3] + x[8] * mu[6];
    const float R1_0 = x[0] * mu[1] + x[3] * mu[4] + x[6] * mu[7];
    const float R1_1 = x[1] * mu[1] + x[4] * mu[4] + x[7] * mu[7];
    const float R1_2 = x[2] * mu[1] + x[5] * mu[4] + x[8] * mu[7];
    const float R2_0 = x[0] * mu[2] + x[3] * mu[5] + x[6] * mu[8];
    const float R2_1 = x[1] * mu[2] + x[4] * mu[5] + x[7] * mu[8];
    const float R2_2 = x[2] * mu[2] + x[5] * mu[5] + x[8] * mu[8];
    const float R0_0_total = 1.0f + R0_0;
    const float square0 = R2_2 + (R1_1 + R0_0_total);
    const float square1 = R0_0_total - R1_1 - R2_2;
    const float square2 = 1.0f + R1_1 - R0_0 - R2_2;
    const float square3 = 1.0f + R2_2 - R0_0 - R1_1;
    const int is_less = square0 < square1;
    const float R2_1_gap = R2_1 - R1_2;
    const float row = (is_less ? R2_1_gap : square0);
    const float row_2 = (is_less ? square1 : R2_1_gap);
    const float R0_1_total = R0_1 + R1_0;
    const float R0_2_gap = R0_2 - R2_0;
    const float row_3 = (is_less ? R0_1_total : R0_2_gap);
    const float R0_2_total = R0_2 + R2_0;
    const float R1_0_gap = R1_0 - R0_1;
    const float row_4 = (is_less ? R0_2_total : R1_0_gap);
    const float largest = (is_less ? square1 : square0);
    const int is_less_2 = largest < square2;
    const float row_5 = (is_less_2 ? R0_2_gap : row);
    const float row_6 = (is_less_2 ? R0_1_total : row_2);
    const float row_7 = (is_less_2 ? square2 : row_3);
    const float R1_2_total = R1_2 + R2_1;
    const float row_8 = (is_less_2 ? R1_2_total : row_4);
    const float largest_2 = (is_less_2 ? square2 : largest);
    const int is_less_3 = largest_2 < square3;
    const float row_9 = (is_less_3 ? R1_0_gap : row_5);
    const float row_10 = (is_less_3 ? R0_2_total : row_6);
    const float row_11 = (is_less_3 ? R1_2_total : row_7);
    const float row_12 = (is_less_3 ? square3 : row_8);
    const float total_2 = row_10 * row_10 + row_11 * row_11 + row_12 * row_12 + row_9 * row_9;
    const float row_length = sqrtf(total_2);
    const float g0 = row_9 / row_length;
    const float g1 = row_10 / row_length;
    const float g2 = row_11 / row_length;
    const float g3 = row_12 / row_length;
    const float norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const float abs_g0 = fabsf(g0);
    const int near = norm_s_squared < 0.249287f;
    const float near_chosen = (near ? 4.011440628672975f * norm_s_squared : 0.0f);
    const float t_over_norm_s_near = polynomial_t_over_norm_s_near_f(near_chosen);
    const float near_chosen_2 = (near ? 1.0f : norm_s_squared);
    const float norm_s = sqrtf(near_chosen_2);
    const float atan2_norm_s_abs_g0 = atan2f(norm_s, abs_g0);
    const float t = 2.0f * atan2_norm_s_abs_g0;
    const float t_ratio = t / norm_s;
    const float t_over_norm_s = (near ? t_over_norm_s_near : t_ratio);
    const int is_small = g0 < 0.0f;
    const float chosen = (is_small ? -1.0f : 1.0f);
    const float scale = t_over_norm_s * chosen;
    const float v0 = g1 * scale;
    const float v1 = g2 * scale;
    const float v2 = g3 * scale;
    const float log_det_series = polynomial_log_det_series_f(near_chosen);
    const float log_det_near = norm_s_squared * log_det_series;
    const float product = 0.5f * t_ratio;
    const float log_det = (near ? log_det_near : 2.0f * logf(product));
    const float z0 = W[0] * v0 + W[1] * v1 + W[2] * v2;
    const float z1 = W[3] * v0 + W[4] * v1 + W[5] * v2;
    const float z2 = W[6] * v0 + W[7] * v1 + W[8] * v2;
    const float log_det_gap = log_det - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
    const float phi = amplitude * expf(log_det_gap);
    const float by_v2 = -(W[8] * z2) - W[5] * z1 - W[2] * z0;
    const float by_v1 = -(W[7] * z2) - W[4] * z1 - W[1] * z0;
    const float by_v0 = -(W[6] * z2) - W[3] * z1 - W[0] * z0;
    const float by_log_det_near = (near ? 1.0f : 0.0f);
    const float by_log_det_series = norm_s_squared * by_log_det_near;
    const float log_det_series_slope = polynomial_log_det_series_slope_f(near_chosen);
    const float by_scale = g3 * by_v2 + g2 * by_v1 + g1 * by_v0;
    const float by_t_over_norm_s = chosen * by_scale;
    const float by_t_over_norm_s_near = (near ? by_t_over_norm_s : 0.0f);
    const float total_3 = 0.5f * (2.0f * (near ? 0.0f : 1.0f) / product) + (near ? 0.0f : by_t_over_norm_s);
    const float by_t = total_3 / norm_s;
    const float by_atan2_norm_s_abs_g0 = 2.0f * by_t;
    const float ratio = by_atan2_norm_s_abs_g0 / (near_chosen_2 + abs_g0 * abs_g0);
    const float norm_s_product = norm_s * ratio;
    const float by_abs_g0 = -norm_s_product;
    const float by_norm_s = abs_g0 * ratio - t_ratio * by_t;
    const float t_over_norm_s_near_slope = polynomial_t_over_norm_s_near_slope_f(near_chosen);
    const float by_norm_s_squared = log_det_series * by_log_det_near + (near ? 0.0f : by_norm_s / (2.0f *
        norm_s)) + 4.011440628672975f * (near ? by_log_det_series * log_det_series_slope +
        by_t_over_norm_s_near * t_over_norm_s_near_slope : 0.0f);
    const float by_g0 = (is_small ? norm_s_product : by_abs_g0);
    const float product_2 = 2.0f * by_norm_s_squared;
    const float by_g3 = scale * by_v2 + g3 * product_2;
    const float by_g2 = scale * by_v1 + g2 * product_2;
    const float by_g1 = scale * by_v0 + g1 * product_2;
    const float by_g3_ratio = by_g3 / row_length;
    const float by_g2_ratio = by_g2 / row_length;
    const float by_g1_ratio = by_g1 / row_length;
    const float by_g0_ratio = by_g0 / row_length;
    const float by_row_length = -(g3 * by_g3_ratio) - g2 * by_g2_ratio - g1 * by_g1_ratio - g0 * by_g0_ratio;
    const int is_small_2 = total_2 == 0.0f;
    const float product_3 = 2.0f * (is_small_2 ? 0.0f : by_row_length / (2.0f * (is_small_2 ? 1.0f :
        row_length)));
    const float by_row_9 = by_g0_ratio + row_9 * product_3;
    const float by_row_12 = by_g3_ratio + row_12 * product_3;
    const float by_row_11 = by_g2_ratio + row_11 * product_3;
    const float by_row_10 = by_g1_ratio + row_10 * product_3;
    const float by_square3 = (is_less_3 ? by_row_12 : 0.0f);
    const float by_row_8 = (is_less_3 ? 0.0f : by_row_12);
    const float by_row_7 = (is_less_3 ? 0.0f : by_row_11);
    const float by_row_6 = (is_less_3 ? 0.0f : by_row_10);
    const float by_row_5 = (is_less_3 ? 0.0f : by_row_9);
    const float by_row_4 = (is_less_2 ? 0.0f : by_row_8);
    const float total_4 = (is_less_3 ? by_row_11 : 0.0f) + (is_less_2 ? by_row_8 : 0.0f);
    const float by_square2 = (is_less_2 ? by_row_7 : 0.0f);
    const float by_row_3 = (is_less_2 ? 0.0f : by_row_7);
    const float by_row_2 = (is_less_2 ? 0.0f : by_row_6);
    const float by_row = (is_less_2 ? 0.0f : by_row_5);
    const float total_5 = (is_less_3 ? by_row_10 : 0.0f) + (is_less ? by_row_4 : 0.0f);
    const float total_6 = (is_less_3 ? by_row_9 : 0.0f) + (is_less ? 0.0f : by_row_4);
    const float total_7 = (is_less_2 ? by_row_6 : 0.0f) + (is_less ? by_row_3 : 0.0f);
    const float total_8 = (is_less_2 ? by_row_5 : 0.0f) + (is_less ? 0.0f : by_row_3);
    const float by_R0_2 = total_5 + total_8;
    const float by_R2_0 = total_5 - total_8;
    const float by_R0_1 = total_7 - total_6;
    const float by_R1_0 = total_6 + total_7;
    const float by_square1 = (is_less ? by_row_2 : 0.0f);
    const float by_square0 = (is_less ? 0.0f : by_row);
    const float total_9 = (is_less ? 0.0f : by_row_2) + (is_less ? by_row : 0.0f);
    const float by_R2_1 = total_4 + total_9;
    const float by_R1_2 = total_4 - total_9;
    const float by_R2_2 = by_square0 + (by_square3 - by_square2 - by_square1);
    const float by_R1_1 = by_square0 + (by_square2 - by_square3 - by_square1);
    const float by_R0_0 = -by_square3 - by_square2 + (by_square1 + by_square0);
    const float exponent_by_x8 = mu[8] * by_R2_2 + mu[7] * by_R1_2 + mu[6] * by_R0_2;
    const float exponent_by_x5 = mu[5] * by_R2_2 + mu[4] * by_R1_2 + mu[3] * by_R0_2;
    const float exponent_by_x2 = mu[2] * by_R2_2 + mu[1] * by_R1_2 + mu[0] * by_R0_2;
    const float exponent_by_x7 = mu[8] * by_R2_1 + mu[7] * by_R1_1 + mu[6] * by_R0_1;
    const float exponent_by_x4 = mu[5] * by_R2_1 + mu[4] * by_R1_1 + mu[3] * by_R0_1;
    const float exponent_by_x1 = mu[2] * by_R2_1 + mu[1] * by_R1_1 + mu[0] * by_R0_1;
    const float exponent_by_x6 = mu[8] * by_R2_0 + mu[7] * by_R1_0 + mu[6] * by_R0_0;
    const float exponent_by_x3 = mu[5] * by_R2_0 + mu[4] * by_R1_0 + mu[3] * by_R0_0;
    const float exponent_by_x0 = mu[2] * by_R2_0 + mu[1] * by_R1_0 + mu[0] * by_R0_0;
    const float df0 = phi * exponent_by_x0;
    const float df1 = phi * exponent_by_x1;
    const float df2 = phi * exponent_by_x2;
    const float df3 = phi * exponent_by_x3;
    const float df4 = phi * exponent_by_x4;
    const float df5 = phi * exponent_by_x5;
    const float df6 = phi * exponent_by_x6;
    const float df7 = phi * exponent_by_x7;
    const float df8 = phi * exponent_by_x8;
    const float gap = x[2] * df1 + x[5] * df4 + x[8] * df7 - x[1] * df2 - x[4] * df5;
    const float gradient0 = gap - x[7] * df8;
    const float gap_2 = x[0] * df2 + x[3] * df5 + x[6] * df8 - x[2] * df0 - x[5] * df3;
    const float gradient1 = gap_2 - x[8] * df6;
    const float gap_3 = x[1] * df0 + x[4] * df3 + x[7] * df6 - x[0] * df1 - x[3] * df4;
    const float gradient2 = gap_3 - x[6] * df7;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void so3_matrix_splat_batch_f(
    size_t count,
    const float *SO3_MATRIX_RESTRICT x,
    const float *SO3_MATRIX_RESTRICT mu,
    const float *SO3_MATRIX_RESTRICT W,
    const float *SO3_MATRIX_RESTRICT amplitude,
    float *SO3_MATRIX_RESTRICT value_out,
    float *SO3_MATRIX_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so3_matrix_splat_f(x + 9 * i, mu + 9 * i, W + 9 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void so3_matrix_frame_f(const float *SO3_MATRIX_RESTRICT p, float *SO3_MATRIX_RESTRICT frame) {
    float left[9][3];
    for (int i = 0; i < 9; ++i) {
        float axis[9];
        for (int j = 0; j < 9; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        so3_matrix_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 3; ++row) {
        float *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 9; ++i)
            if (so3_matrix_norm_f(p, left[i]) > so3_matrix_norm_f(p, left[longest])) longest = i;
        const float length = so3_matrix_norm_f(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 9; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 9];
            const float part = so3_matrix_inner_f(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}
