/*
 * so3: Rotations of R^3 as unit quaternions (w, x, y, z), q and -q the same; distances are rotation angles in
 *
 * See the header for what the functions promise.
 */

#include "so3.h"

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

/* p / norm(p) */
void so3_project(const double *SO3_RESTRICT x, double *SO3_RESTRICT p_out) {
    const double norm_p_squared = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
    const double norm_p = sqrt(norm_p_squared);
    const double scale = 1.0 / norm_p;
    const double p0 = x[0] * scale;
    const double p1 = x[1] * scale;
    const double p2 = x[2] * scale;
    const double p3 = x[3] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
}

void so3_project_batch(size_t count, const double *SO3_RESTRICT x, double *SO3_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so3_project(x + 4 * i, p_out + 4 * i);
}

/* (E E^T)^-1 E x */
void so3_to_tangent(const double *SO3_RESTRICT p, const double *SO3_RESTRICT x, double *SO3_RESTRICT v_out) {
    const double product = 2.0 * p[0];
    const double product_2 = 2.0 * p[3];
    const double product_3 = 2.0 * p[1];
    const double product_4 = 2.0 * p[2];
    const double v0 = x[1] * product + x[2] * product_2 - x[0] * product_3 - x[3] * product_4;
    const double v1 = x[2] * product + x[3] * product_3 - x[0] * product_4 - x[1] * product_2;
    const double v2 = x[3] * product + x[1] * product_4 - x[2] * product_3 - x[0] * product_2;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void so3_to_tangent_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT x,
    double *SO3_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so3_to_tangent(p + 4 * i, x + 4 * i, v_out + 3 * i);
}

/* dot(u, v) */
double so3_inner(const double *SO3_RESTRICT p, const double *SO3_RESTRICT u, const double *SO3_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void so3_inner_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT u,
    const double *SO3_RESTRICT v,
    double *SO3_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = so3_inner(p + 4 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(<v, v>_p) */
double so3_norm(const double *SO3_RESTRICT p, const double *SO3_RESTRICT v) {
    (void)p;
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void so3_norm_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT v,
    double *SO3_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = so3_norm(p + 4 * i, v + 3 * i);
}

/* G(p) v */
void so3_flat(const double *SO3_RESTRICT p, const double *SO3_RESTRICT v, double *SO3_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void so3_flat_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT v,
    double *SO3_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) so3_flat(p + 4 * i, v + 3 * i, covector_out + 3 * i);
}

/* qmul(p, [cos(norm(v) / 2), sinc(norm(v) / 2) / 2 * v]) */
void so3_exp(const double *SO3_RESTRICT p, const double *SO3_RESTRICT v, double *SO3_RESTRICT q_out) {
    const double norm_v_squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const int near = 0.25 * norm_v_squared < 0.990393;
    const double near_chosen = (near ? 0.2524250474306664 * norm_v_squared : 0.0);
    const double cos__near = polynomial_cos__near(near_chosen);
    const double norm_v = sqrt((near ? 1.0 : norm_v_squared));
    const double norm_v_product = 0.5 * norm_v;
    const double cos_ = (near ? cos__near : cos(norm_v_product));
    const double sinc__near = polynomial_sinc__near(near_chosen);
    const double sinc_ = (near ? sinc__near : 2.0 * sin(norm_v_product) / norm_v);
    const double scale = 0.5 * sinc_;
    const double scale_product = p[1] * scale;
    const double scale_product_2 = p[2] * scale;
    const double scale_product_3 = p[3] * scale;
    const double q0 = p[0] * cos_ - v[0] * scale_product - v[1] * scale_product_2 - v[2] * scale_product_3;
    const double scale_product_4 = p[0] * scale;
    const double q1 = p[1] * cos_ + v[0] * scale_product_4 + v[2] * scale_product_2 - v[1] * scale_product_3;
    const double q2 = p[2] * cos_ + v[1] * scale_product_4 + v[0] * scale_product_3 - v[2] * scale_product;
    const double q3 = p[3] * cos_ + v[2] * scale_product_4 + v[1] * scale_product - v[0] * scale_product_2;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
}

void so3_exp_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT v,
    double *SO3_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) so3_exp(p + 4 * i, v + 3 * i, q_out + 4 * i);
}

/* sign(g[0]) * t * s / norm(s) */
void so3_log(const double *SO3_RESTRICT p, const double *SO3_RESTRICT q, double *SO3_RESTRICT v_out) {
    const double g0 = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    const double g1 = p[0] * q[1] + p[3] * q[2] - p[1] * q[0] - p[2] * q[3];
    const double g2 = p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1];
    const double g3 = p[0] * q[3] + p[2] * q[1] - p[1] * q[2] - p[3] * q[0];
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

void so3_log_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT q,
    double *SO3_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so3_log(p + 4 * i, q + 4 * i, v_out + 3 * i);
}

/* t */
double so3_distance(const double *SO3_RESTRICT p, const double *SO3_RESTRICT q) {
    const double g0 = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    const double g1 = p[0] * q[1] + p[3] * q[2] - p[1] * q[0] - p[2] * q[3];
    const double g2 = p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1];
    const double g3 = p[0] * q[3] + p[2] * q[1] - p[1] * q[2] - p[3] * q[0];
    const double norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const double norm_s = sqrt(norm_s_squared);
    const double abs_g0 = fabs(g0);
    const double atan2_norm_s_abs_g0 = atan2(norm_s, abs_g0);
    const double t = 2.0 * atan2_norm_s_abs_g0;
    return t;
}

void so3_distance_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT q,
    double *SO3_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = so3_distance(p + 4 * i, q + 4 * i);
}

/* 2*log(t_over_norm_s/2) */
double so3_log_abs_det(const double *SO3_RESTRICT p, const double *SO3_RESTRICT q) {
    const double g0 = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    const double g1 = p[0] * q[1] + p[3] * q[2] - p[1] * q[0] - p[2] * q[3];
    const double g2 = p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1];
    const double g3 = p[0] * q[3] + p[2] * q[1] - p[1] * q[2] - p[3] * q[0];
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

void so3_log_abs_det_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT q,
    double *SO3_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = so3_log_abs_det(p + 4 * i, q + 4 * i);
}

/* G^-1 E df */
void so3_riemannian_gradient(
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT df,
    double *SO3_RESTRICT gradient_out) {
    const double product = 0.5 * df[1];
    const double product_2 = 0.5 * df[2];
    const double product_3 = 0.5 * df[0];
    const double product_4 = 0.5 * df[3];
    const double gradient0 = p[0] * product + p[3] * product_2 - p[1] * product_3 - p[2] * product_4;
    const double gradient1 = p[0] * product_2 + p[1] * product_4 - p[2] * product_3 - p[3] * product;
    const double gradient2 = p[2] * product + p[0] * product_4 - p[3] * product_3 - p[1] * product_2;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void so3_riemannian_gradient_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT df,
    double *SO3_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so3_riemannian_gradient(p + 4 * i, df + 4 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
double so3_gradient_norm(const double *SO3_RESTRICT p, const double *SO3_RESTRICT df) {
    const double product = 0.5 * df[1];
    const double product_2 = 0.5 * df[2];
    const double product_3 = 0.5 * df[0];
    const double product_4 = 0.5 * df[3];
    const double gradient0 = p[0] * product + p[3] * product_2 - p[1] * product_3 - p[2] * product_4;
    const double gradient1 = p[0] * product_2 + p[1] * product_4 - p[2] * product_3 - p[3] * product;
    const double gradient2 = p[2] * product + p[0] * product_4 - p[3] * product_3 - p[1] * product_2;
    return sqrt(gradient0 * gradient0 + gradient1 * gradient1 + gradient2 * gradient2);
}

void so3_gradient_norm_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT df,
    double *SO3_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = so3_gradient_norm(p + 4 * i, df + 4 * i);
}

/* -p */
void so3_other_name(const double *SO3_RESTRICT p, double *SO3_RESTRICT q_out) {
    const double q0 = -p[0];
    const double q1 = -p[1];
    const double q2 = -p[2];
    const double q3 = -p[3];
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
}

void so3_other_name_batch(size_t count, const double *SO3_RESTRICT p, double *SO3_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) so3_other_name(p + 4 * i, q_out + 4 * i);
}

/* qmul(qmul(h, [0, v]), conj(h))[1:] / dot(h, h) */
void so3_transport(
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT q,
    const double *SO3_RESTRICT v,
    double *SO3_RESTRICT w_out) {
    const double g0 = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    const double g1 = p[0] * q[1] + p[3] * q[2] - p[1] * q[0] - p[2] * q[3];
    const double g2 = p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1];
    const double g3 = p[0] * q[3] + p[2] * q[1] - p[1] * q[2] - p[3] * q[0];
    const double abs_g0 = fabs(g0);
    const double chosen = (g0 < 0.0 ? -1.0 : 1.0);
    const double h0 = 1.0 + abs_g0;
    const double g1_product = g1 * chosen;
    const double g2_product = g2 * chosen;
    const double g3_product = g3 * chosen;
    const double dot_h_h = h0 * h0 + g1_product * g1_product + g2_product * g2_product + g3_product *
        g3_product;
    const double scale_3 = 1.0 / dot_h_h;
    const double total_2 = v[0] * h0 - v[2] * g2_product + v[1] * g3_product;
    const double total_3 = v[2] * h0 - v[1] * g1_product + v[0] * g2_product;
    const double total_4 = v[0] * g1_product + v[1] * g2_product + v[2] * g3_product;
    const double total_5 = v[1] * h0 - v[0] * g3_product + v[2] * g1_product;
    const double w0 = scale_3 * (h0 * total_2 - g2_product * total_3 + g1_product * total_4 + g3_product *
        total_5);
    const double w1 = scale_3 * (h0 * total_5 - g3_product * total_2 + g1_product * total_3 + g2_product *
        total_4);
    const double w2 = scale_3 * (h0 * total_3 - g1_product * total_5 + g2_product * total_2 + g3_product *
        total_4);
    w_out[0] = w0;
    w_out[1] = w1;
    w_out[2] = w2;
}

void so3_transport_batch(
    size_t count,
    const double *SO3_RESTRICT p,
    const double *SO3_RESTRICT q,
    const double *SO3_RESTRICT v,
    double *SO3_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) so3_transport(p + 4 * i, q + 4 * i, v + 3 * i, w_out + 3 * i);
}

/* normal / norm(normal) */
void so3_sample(
    const double *SO3_RESTRICT normal,
    const double *SO3_RESTRICT uniform,
    double *SO3_RESTRICT p_out) {
    (void)uniform;
    const double norm_normal_squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] +
        normal[3] * normal[3];
    const double norm_normal = sqrt(norm_normal_squared);
    const double scale = 1.0 / norm_normal;
    const double p0 = normal[0] * scale;
    const double p1 = normal[1] * scale;
    const double p2 = normal[2] * scale;
    const double p3 = normal[3] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
}

void so3_sample_batch(
    size_t count,
    const double *SO3_RESTRICT normal,
    const double *SO3_RESTRICT uniform,
    double *SO3_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so3_sample(normal + 4 * i, uniform + 4 * i, p_out + 4 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void so3_splat(
    const double *SO3_RESTRICT x,
    const double *SO3_RESTRICT mu,
    const double *SO3_RESTRICT W,
    double amplitude,
    double *SO3_RESTRICT value_out,
    double *SO3_RESTRICT gradient_out) {
    const double g0 = x[0] * mu[0] + x[1] * mu[1] + x[2] * mu[2] + x[3] * mu[3];
    const double g1 = x[1] * mu[0] + x[2] * mu[3] - x[0] * mu[1] - x[3] * mu[2];
    const double g2 = x[2] * mu[0] + x[3] * mu[1] - x[0] * mu[2] - x[1] * mu[3];
    const double g3 = x[3] * mu[0] + x[1] * mu[2] - x[2] * mu[1] - x[0] * mu[3];
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
    const double total_2 = 0.5 * (2.0 * (near ? 0.0 : 1.0) / product) + (near ? 0.0 : by_t_over_norm_s);
    const double by_t = total_2 / norm_s;
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
    const double exponent_by_x3 = mu[0] * by_g3 + mu[1] * by_g2 - mu[2] * by_g1 + mu[3] * by_g0;
    const double exponent_by_x2 = mu[0] * by_g2 - mu[1] * by_g3 + mu[3] * by_g1 + mu[2] * by_g0;
    const double exponent_by_x1 = mu[2] * by_g3 - mu[3] * by_g2 + mu[0] * by_g1 + mu[1] * by_g0;
    const double exponent_by_x0 = -(mu[3] * by_g3) - mu[2] * by_g2 - mu[1] * by_g1 + mu[0] * by_g0;
    const double df0 = phi * exponent_by_x0;
    const double df1 = phi * exponent_by_x1;
    const double df2 = phi * exponent_by_x2;
    const double df3 = phi * exponent_by_x3;
    const double df1_product = 0.5 * df1;
    const double df2_product = 0.5 * df2;
    const double df0_product = 0.5 * df0;
    const double df3_product = 0.5 * df3;
    const double gradient0 = x[0] * df1_product + x[3] * df2_product - x[1] * df0_product - x[2] *
        df3_product;
    const double gradient1 = x[0] * df2_product + x[1] * df3_product - x[2] * df0_product - x[3] *
        df1_product;
    const double gradient2 = x[2] * df1_product + x[0] * df3_product - x[3] * df0_product - x[1] *
        df2_product;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void so3_splat_batch(
    size_t count,
    const double *SO3_RESTRICT x,
    const double *SO3_RESTRICT mu,
    const double *SO3_RESTRICT W,
    const double *SO3_RESTRICT amplitude,
    double *SO3_RESTRICT value_out,
    double *SO3_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so3_splat(x + 4 * i, mu + 4 * i, W + 9 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void so3_frame(const double *SO3_RESTRICT p, double *SO3_RESTRICT frame) {
    double left[4][3];
    for (int i = 0; i < 4; ++i) {
        double axis[4];
        for (int j = 0; j < 4; ++j) axis[j] = i == j ? 1.0 : 0.0;
        so3_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 3; ++row) {
        double *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 4; ++i)
            if (so3_norm(p, left[i]) > so3_norm(p, left[longest])) longest = i;
        const double length = so3_norm(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 4; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 4];
            const double part = so3_inner(p, e, rest);
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

/* p / norm(p) */
void so3_project_f(const float *SO3_RESTRICT x, float *SO3_RESTRICT p_out) {
    const float norm_p_squared = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
    const float norm_p = sqrtf(norm_p_squared);
    const float scale = 1.0f / norm_p;
    const float p0 = x[0] * scale;
    const float p1 = x[1] * scale;
    const float p2 = x[2] * scale;
    const float p3 = x[3] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
}

void so3_project_batch_f(size_t count, const float *SO3_RESTRICT x, float *SO3_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so3_project_f(x + 4 * i, p_out + 4 * i);
}

/* (E E^T)^-1 E x */
void so3_to_tangent_f(const float *SO3_RESTRICT p, const float *SO3_RESTRICT x, float *SO3_RESTRICT v_out) {
    const float product = 2.0f * p[0];
    const float product_2 = 2.0f * p[3];
    const float product_3 = 2.0f * p[1];
    const float product_4 = 2.0f * p[2];
    const float v0 = x[1] * product + x[2] * product_2 - x[0] * product_3 - x[3] * product_4;
    const float v1 = x[2] * product + x[3] * product_3 - x[0] * product_4 - x[1] * product_2;
    const float v2 = x[3] * product + x[1] * product_4 - x[2] * product_3 - x[0] * product_2;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void so3_to_tangent_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT x,
    float *SO3_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so3_to_tangent_f(p + 4 * i, x + 4 * i, v_out + 3 * i);
}

/* dot(u, v) */
float so3_inner_f(const float *SO3_RESTRICT p, const float *SO3_RESTRICT u, const float *SO3_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void so3_inner_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT u,
    const float *SO3_RESTRICT v,
    float *SO3_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = so3_inner_f(p + 4 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(<v, v>_p) */
float so3_norm_f(const float *SO3_RESTRICT p, const float *SO3_RESTRICT v) {
    (void)p;
    return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void so3_norm_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT v,
    float *SO3_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = so3_norm_f(p + 4 * i, v + 3 * i);
}

/* G(p) v */
void so3_flat_f(const float *SO3_RESTRICT p, const float *SO3_RESTRICT v, float *SO3_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void so3_flat_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT v,
    float *SO3_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) so3_flat_f(p + 4 * i, v + 3 * i, covector_out + 3 * i);
}

/* qmul(p, [cos(norm(v) / 2), sinc(norm(v) / 2) / 2 * v]) */
void so3_exp_f(const float *SO3_RESTRICT p, const float *SO3_RESTRICT v, float *SO3_RESTRICT q_out) {
    const float norm_v_squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const int near = 0.25f * norm_v_squared < 0.990393f;
    const float near_chosen = (near ? 0.2524250474306664f * norm_v_squared : 0.0f);
    const float cos__near = polynomial_cos__near_f(near_chosen);
    const float norm_v = sqrtf((near ? 1.0f : norm_v_squared));
    const float norm_v_product = 0.5f * norm_v;
    const float cos_ = (near ? cos__near : cosf(norm_v_product));
    const float sinc__near = polynomial_sinc__near_f(near_chosen);
    const float sinc_ = (near ? sinc__near : 2.0f * sinf(norm_v_product) / norm_v);
    const float scale = 0.5f * sinc_;
    const float scale_product = p[1] * scale;
    const float scale_product_2 = p[2] * scale;
    const float scale_product_3 = p[3] * scale;
    const float q0 = p[0] * cos_ - v[0] * scale_product - v[1] * scale_product_2 - v[2] * scale_product_3;
    const float scale_product_4 = p[0] * scale;
    const float q1 = p[1] * cos_ + v[0] * scale_product_4 + v[2] * scale_product_2 - v[1] * scale_product_3;
    const float q2 = p[2] * cos_ + v[1] * scale_product_4 + v[0] * scale_product_3 - v[2] * scale_product;
    const float q3 = p[3] * cos_ + v[2] * scale_product_4 + v[1] * scale_product - v[0] * scale_product_2;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
}

void so3_exp_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT v,
    float *SO3_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) so3_exp_f(p + 4 * i, v + 3 * i, q_out + 4 * i);
}

/* sign(g[0]) * t * s / norm(s) */
void so3_log_f(const float *SO3_RESTRICT p, const float *SO3_RESTRICT q, float *SO3_RESTRICT v_out) {
    const float g0 = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    const float g1 = p[0] * q[1] + p[3] * q[2] - p[1] * q[0] - p[2] * q[3];
    const float g2 = p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1];
    const float g3 = p[0] * q[3] + p[2] * q[1] - p[1] * q[2] - p[3] * q[0];
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

void so3_log_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT q,
    float *SO3_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so3_log_f(p + 4 * i, q + 4 * i, v_out + 3 * i);
}

/* t */
float so3_distance_f(const float *SO3_RESTRICT p, const float *SO3_RESTRICT q) {
    const float g0 = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    const float g1 = p[0] * q[1] + p[3] * q[2] - p[1] * q[0] - p[2] * q[3];
    const float g2 = p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1];
    const float g3 = p[0] * q[3] + p[2] * q[1] - p[1] * q[2] - p[3] * q[0];
    const float norm_s_squared = g1 * g1 + g2 * g2 + g3 * g3;
    const float norm_s = sqrtf(norm_s_squared);
    const float abs_g0 = fabsf(g0);
    const float atan2_norm_s_abs_g0 = atan2f(norm_s, abs_g0);
    const float t = 2.0f * atan2_norm_s_abs_g0;
    return t;
}

void so3_distance_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT q,
    float *SO3_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = so3_distance_f(p + 4 * i, q + 4 * i);
}

/* 2*log(t_over_norm_s/2) */
float so3_log_abs_det_f(const float *SO3_RESTRICT p, const float *SO3_RESTRICT q) {
    const float g0 = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    const float g1 = p[0] * q[1] + p[3] * q[2] - p[1] * q[0] - p[2] * q[3];
    const float g2 = p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1];
    const float g3 = p[0] * q[3] + p[2] * q[1] - p[1] * q[2] - p[3] * q[0];
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

void so3_log_abs_det_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT q,
    float *SO3_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = so3_log_abs_det_f(p + 4 * i, q + 4 * i);
}

/* G^-1 E df */
void so3_riemannian_gradient_f(
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT df,
    float *SO3_RESTRICT gradient_out) {
    const float product = 0.5f * df[1];
    const float product_2 = 0.5f * df[2];
    const float product_3 = 0.5f * df[0];
    const float product_4 = 0.5f * df[3];
    const float gradient0 = p[0] * product + p[3] * product_2 - p[1] * product_3 - p[2] * product_4;
    const float gradient1 = p[0] * product_2 + p[1] * product_4 - p[2] * product_3 - p[3] * product;
    const float gradient2 = p[2] * product + p[0] * product_4 - p[3] * product_3 - p[1] * product_2;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void so3_riemannian_gradient_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT df,
    float *SO3_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so3_riemannian_gradient_f(p + 4 * i, df + 4 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
float so3_gradient_norm_f(const float *SO3_RESTRICT p, const float *SO3_RESTRICT df) {
    const float product = 0.5f * df[1];
    const float product_2 = 0.5f * df[2];
    const float product_3 = 0.5f * df[0];
    const float product_4 = 0.5f * df[3];
    const float gradient0 = p[0] * product + p[3] * product_2 - p[1] * product_3 - p[2] * product_4;
    const float gradient1 = p[0] * product_2 + p[1] * product_4 - p[2] * product_3 - p[3] * product;
    const float gradient2 = p[2] * product + p[0] * product_4 - p[3] * product_3 - p[1] * product_2;
    return sqrtf(gradient0 * gradient0 + gradient1 * gradient1 + gradient2 * gradient2);
}

void so3_gradient_norm_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT df,
    float *SO3_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = so3_gradient_norm_f(p + 4 * i, df + 4 * i);
}

/* -p */
void so3_other_name_f(const float *SO3_RESTRICT p, float *SO3_RESTRICT q_out) {
    const float q0 = -p[0];
    const float q1 = -p[1];
    const float q2 = -p[2];
    const float q3 = -p[3];
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
}

void so3_other_name_batch_f(size_t count, const float *SO3_RESTRICT p, float *SO3_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) so3_other_name_f(p + 4 * i, q_out + 4 * i);
}

/* qmul(qmul(h, [0, v]), conj(h))[1:] / dot(h, h) */
void so3_transport_f(
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT q,
    const float *SO3_RESTRICT v,
    float *SO3_RESTRICT w_out) {
    const float g0 = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    const float g1 = p[0] * q[1] + p[3] * q[2] - p[1] * q[0] - p[2] * q[3];
    const float g2 = p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1];
    const float g3 = p[0] * q[3] + p[2] * q[1] - p[1] * q[2] - p[3] * q[0];
    const float abs_g0 = fabsf(g0);
    const float chosen = (g0 < 0.0f ? -1.0f : 1.0f);
    const float h0 = 1.0f + abs_g0;
    const float g1_product = g1 * chosen;
    const float g2_product = g2 * chosen;
    const float g3_product = g3 * chosen;
    const float dot_h_h = h0 * h0 + g1_product * g1_product + g2_product * g2_product + g3_product *
        g3_product;
    const float scale_3 = 1.0f / dot_h_h;
    const float total_2 = v[0] * h0 - v[2] * g2_product + v[1] * g3_product;
    const float total_3 = v[2] * h0 - v[1] * g1_product + v[0] * g2_product;
    const float total_4 = v[0] * g1_product + v[1] * g2_product + v[2] * g3_product;
    const float total_5 = v[1] * h0 - v[0] * g3_product + v[2] * g1_product;
    const float w0 = scale_3 * (h0 * total_2 - g2_product * total_3 + g1_product * total_4 + g3_product *
        total_5);
    const float w1 = scale_3 * (h0 * total_5 - g3_product * total_2 + g1_product * total_3 + g2_product *
        total_4);
    const float w2 = scale_3 * (h0 * total_3 - g1_product * total_5 + g2_product * total_2 + g3_product *
        total_4);
    w_out[0] = w0;
    w_out[1] = w1;
    w_out[2] = w2;
}

void so3_transport_batch_f(
    size_t count,
    const float *SO3_RESTRICT p,
    const float *SO3_RESTRICT q,
    const float *SO3_RESTRICT v,
    float *SO3_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) so3_transport_f(p + 4 * i, q + 4 * i, v + 3 * i, w_out + 3 * i);
}

/* normal / norm(normal) */
void so3_sample_f(
    const float *SO3_RESTRICT normal,
    const float *SO3_RESTRICT uniform,
    float *SO3_RESTRICT p_out) {
    (void)uniform;
    const float norm_normal_squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] +
        normal[3] * normal[3];
    const float norm_normal = sqrtf(norm_normal_squared);
    const float scale = 1.0f / norm_normal;
    const float p0 = normal[0] * scale;
    const float p1 = normal[1] * scale;
    const float p2 = normal[2] * scale;
    const float p3 = normal[3] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
}

void so3_sample_batch_f(
    size_t count,
    const float *SO3_RESTRICT normal,
    const float *SO3_RESTRICT uniform,
    float *SO3_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so3_sample_f(normal + 4 * i, uniform + 4 * i, p_out + 4 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void so3_splat_f(
    const float *SO3_RESTRICT x,
    const float *SO3_RESTRICT mu,
    const float *SO3_RESTRICT W,
    float amplitude,
    float *SO3_RESTRICT value_out,
    float *SO3_RESTRICT gradient_out) {
    const float g0 = x[0] * mu[0] + x[1] * mu[1] + x[2] * mu[2] + x[3] * mu[3];
    const float g1 = x[1] * mu[0] + x[2] * mu[3] - x[0] * mu[1] - x[3] * mu[2];
    const float g2 = x[2] * mu[0] + x[3] * mu[1] - x[0] * mu[2] - x[1] * mu[3];
    const float g3 = x[3] * mu[0] + x[1] * mu[2] - x[2] * mu[1] - x[0] * mu[3];
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
    const float total_2 = 0.5f * (2.0f * (near ? 0.0f : 1.0f) / product) + (near ? 0.0f : by_t_over_norm_s);
    const float by_t = total_2 / norm_s;
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
    const float exponent_by_x3 = mu[0] * by_g3 + mu[1] * by_g2 - mu[2] * by_g1 + mu[3] * by_g0;
    const float exponent_by_x2 = mu[0] * by_g2 - mu[1] * by_g3 + mu[3] * by_g1 + mu[2] * by_g0;
    const float exponent_by_x1 = mu[2] * by_g3 - mu[3] * by_g2 + mu[0] * by_g1 + mu[1] * by_g0;
    const float exponent_by_x0 = -(mu[3] * by_g3) - mu[2] * by_g2 - mu[1] * by_g1 + mu[0] * by_g0;
    const float df0 = phi * exponent_by_x0;
    const float df1 = phi * exponent_by_x1;
    const float df2 = phi * exponent_by_x2;
    const float df3 = phi * exponent_by_x3;
    const float df1_product = 0.5f * df1;
    const float df2_product = 0.5f * df2;
    const float df0_product = 0.5f * df0;
    const float df3_product = 0.5f * df3;
    const float gradient0 = x[0] * df1_product + x[3] * df2_product - x[1] * df0_product - x[2] * df3_product;
    const float gradient1 = x[0] * df2_product + x[1] * df3_product - x[2] * df0_product - x[3] * df1_product;
    const float gradient2 = x[2] * df1_product + x[0] * df3_product - x[3] * df0_product - x[1] * df2_product;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void so3_splat_batch_f(
    size_t count,
    const float *SO3_RESTRICT x,
    const float *SO3_RESTRICT mu,
    const float *SO3_RESTRICT W,
    const float *SO3_RESTRICT amplitude,
    float *SO3_RESTRICT value_out,
    float *SO3_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so3_splat_f(x + 4 * i, mu + 4 * i, W + 9 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void so3_frame_f(const float *SO3_RESTRICT p, float *SO3_RESTRICT frame) {
    float left[4][3];
    for (int i = 0; i < 4; ++i) {
        float axis[4];
        for (int j = 0; j < 4; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        so3_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 3; ++row) {
        float *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 4; ++i)
            if (so3_norm_f(p, left[i]) > so3_norm_f(p, left[longest])) longest = i;
        const float length = so3_norm_f(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 4; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 4];
            const float part = so3_inner_f(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}
