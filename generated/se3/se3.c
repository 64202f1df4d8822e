/*
 * se3: Poses of a rigid body, R^3 x SO(3); a rotation by one radian is as long as `radius`, in the unit of the
 *
 * See the header for what the functions promise.
 */

#include "se3.h"

#include <float.h>

/* Of degree 7 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_rotation_cos__near(double x) {
    return 1.0 + x * (-0.4951964999999998 + x * (0.040869928935371204 + x * (-0.0013492430509063418 + x *
        (2.386215832835464e-05 + x * (-2.6258769338145326e-07 + x * (1.9699011755063933e-09 + x *
        -1.0543922273218809e-11))))));
}

/* Of degree 7 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_rotation_sinc__near(double x) {
    return 1.0 + x * (-0.16506549999999998 + x * (0.008173985787074777 + x * (-0.00019274900727486046 + x *
        (2.6513509314873062e-06 + x * (-2.3871616416234012e-08 + x * (1.5153609321464116e-10 + x *
        -7.043102821193199e-13))))));
}

/* Of degree 13 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_rotation_t_over_norm_s_near(double x) {
    return 2.0 + x * (0.08309566666666784 + x * (0.009321601255279904 + x * (0.0013831869136529075 + x *
        (0.00023466269139487824 + x * (4.307622244387224e-05 + x * (8.328318196009972e-06 + x *
        (1.6734198264338605e-06 + x * (3.3892571731146964e-07 + x * (8.160810786979752e-08 + x *
        (5.559604423994873e-09 + x * (1.0797473542320039e-08 + x * (-2.6805393136717492e-09 + x *
        9.765079763039615e-10))))))))))));
}

/* Of degree 13 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_rotation_log_det_series(double x) {
    return 0.3333333333333333 + x * (0.030468411111111815 + x * (0.004186774461502485 + x *
        (0.0006822355998616309 + x * (0.0001221617222686508 + x * (2.3226222426586787e-05 + x *
        (4.602679660683086e-06 + x * (9.419944287901338e-07 + x * (1.9330673844597264e-07 + x *
        (4.732354384237477e-08 + x * (3.0572329018458638e-09 + x * (6.43891495522262e-09 + x *
        (-1.6163842503256483e-09 + x * 5.84780397346594e-10))))))))))));
}

/* Of degree 12 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_rotation_log_det_series_slope(double x) {
    return 0.030468411111111815 + x * (0.00837354892300497 + x * (0.002046706799584893 + x *
        (0.0004886468890746032 + x * (0.00011613111213293394 + x * (2.7616077964098513e-05 + x *
        (6.5939610015309365e-06 + x * (1.5464539075677811e-06 + x * (4.2591189458137294e-07 + x *
        (3.057232901845864e-08 + x * (7.082806450744882e-08 + x * (-1.939661100390778e-08 + x *
        7.602145165505722e-09)))))))))));
}

/* Of degree 12 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_rotation_t_over_norm_s_near_slope(double x) {
    return 0.08309566666666784 + x * (0.018643202510559807 + x * (0.004149560740958722 + x *
        (0.0009386507655795129 + x * (0.0002153811122193612 + x * (4.996990917605983e-05 + x *
        (1.1713938785037024e-05 + x * (2.711405738491757e-06 + x * (7.344729708281776e-07 + x *
        (5.559604423994873e-08 + x * (1.1877220896552043e-07 + x * (-3.2166471764060994e-08 + x *
        1.2694603691951498e-08)))))))))));
}

/* position: x, rotation: p / norm(p) */
void se3_project(const double *SE3_RESTRICT x, double *SE3_RESTRICT p_out) {
    const double rotation_norm_p_squared = x[3] * x[3] + x[4] * x[4] + x[5] * x[5] + x[6] * x[6];
    const double rotation_norm_p = sqrt(rotation_norm_p_squared);
    const double rotation_scale = 1.0 / rotation_norm_p;
    const double p3 = x[3] * rotation_scale;
    const double p4 = x[4] * rotation_scale;
    const double p5 = x[5] * rotation_scale;
    const double p6 = x[6] * rotation_scale;
    p_out[0] = x[0];
    p_out[1] = x[1];
    p_out[2] = x[2];
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
}

void se3_project_batch(size_t count, const double *SE3_RESTRICT x, double *SE3_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) se3_project(x + 7 * i, p_out + 7 * i);
}

/* position: x, rotation: (E E^T)^-1 E x */
void se3_to_tangent(const double *SE3_RESTRICT p, const double *SE3_RESTRICT x, double *SE3_RESTRICT v_out) {
    const double product = 2.0 * p[3];
    const double product_2 = 2.0 * p[6];
    const double product_3 = 2.0 * p[4];
    const double product_4 = 2.0 * p[5];
    const double v3 = x[4] * product + x[5] * product_2 - x[3] * product_3 - x[6] * product_4;
    const double v4 = x[5] * product + x[6] * product_3 - x[3] * product_4 - x[4] * product_2;
    const double v5 = x[6] * product + x[4] * product_4 - x[5] * product_3 - x[3] * product_2;
    v_out[0] = x[0];
    v_out[1] = x[1];
    v_out[2] = x[2];
    v_out[3] = v3;
    v_out[4] = v4;
    v_out[5] = v5;
}

void se3_to_tangent_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT x,
    double *SE3_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) se3_to_tangent(p + 7 * i, x + 7 * i, v_out + 6 * i);
}

/* inner(position) + inner(rotation) */
double se3_inner(const double *SE3_RESTRICT p, const double *SE3_RESTRICT u, const double *SE3_RESTRICT v) {
    (void)p;
    const double total_2 = u[0] * v[0] + u[1] * v[1] + u[2] * v[2] + u[3] * v[3] + u[4] * v[4];
    return total_2 + u[5] * v[5];
}

void se3_inner_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT u,
    const double *SE3_RESTRICT v,
    double *SE3_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = se3_inner(p + 7 * i, u + 6 * i, v + 6 * i);
}

/* sqrt(norm(position)^2 + norm(rotation)^2) */
double se3_norm(const double *SE3_RESTRICT p, const double *SE3_RESTRICT v) {
    (void)p;
    const double total_2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3] + v[4] * v[4];
    return sqrt(total_2 + v[5] * v[5]);
}

void se3_norm_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT v,
    double *SE3_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = se3_norm(p + 7 * i, v + 6 * i);
}

/* position: G(p) v, rotation: G(p) v */
void se3_flat(const double *SE3_RESTRICT p, const double *SE3_RESTRICT v, double *SE3_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
    covector_out[3] = v[3];
    covector_out[4] = v[4];
    covector_out[5] = v[5];
}

void se3_flat_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT v,
    double *SE3_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) se3_flat(p + 7 * i, v + 6 * i, covector_out + 6 * i);
}

/* position: p + v, rotation: qmul(p, [cos(norm(v) / 2), sinc(norm(v) / 2) / 2 * v]) */
void se3_exp(const double *SE3_RESTRICT p, const double *SE3_RESTRICT v, double *SE3_RESTRICT q_out) {
    const double rotation_norm_v_squared = v[3] * v[3] + v[4] * v[4] + v[5] * v[5];
    const int near = 0.25 * rotation_norm_v_squared < 0.990393;
    const double near_chosen = (near ? 0.2524250474306664 * rotation_norm_v_squared : 0.0);
    const double rotation_cos__near = polynomial_rotation_cos__near(near_chosen);
    const double rotation_norm_v = sqrt((near ? 1.0 : rotation_norm_v_squared));
    const double product = 0.5 * rotation_norm_v;
    const double rotation_cos_ = (near ? rotation_cos__near : cos(product));
    const double rotation_sinc__near = polynomial_rotation_sinc__near(near_chosen);
    const double rotation_sinc_ = (near ? rotation_sinc__near : 2.0 * sin(product) / rotation_norm_v);
    const double rotation_scale = 0.5 * rotation_sinc_;
    const double q0 = p[0] + v[0];
    const double q1 = p[1] + v[1];
    const double q2 = p[2] + v[2];
    const double product_2 = p[4] * rotation_scale;
    const double product_3 = p[5] * rotation_scale;
    const double product_4 = p[6] * rotation_scale;
    const double q3 = p[3] * rotation_cos_ - v[3] * product_2 - v[4] * product_3 - v[5] * product_4;
    const double product_5 = p[3] * rotation_scale;
    const double q4 = p[4] * rotation_cos_ + v[3] * product_5 + v[5] * product_3 - v[4] * product_4;
    const double q5 = p[5] * rotation_cos_ + v[4] * product_5 + v[3] * product_4 - v[5] * product_2;
    const double q6 = p[6] * rotation_cos_ + v[5] * product_5 + v[4] * product_2 - v[3] * product_3;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
    q_out[4] = q4;
    q_out[5] = q5;
    q_out[6] = q6;
}

void se3_exp_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT v,
    double *SE3_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) se3_exp(p + 7 * i, v + 6 * i, q_out + 7 * i);
}

/* position: q - p, rotation: sign(g[0]) * t * s / norm(s) */
void se3_log(const double *SE3_RESTRICT p, const double *SE3_RESTRICT q, double *SE3_RESTRICT v_out) {
    const double rotation_g0 = p[3] * q[3] + p[4] * q[4] + p[5] * q[5] + p[6] * q[6];
    const double rotation_g1 = p[3] * q[4] + p[6] * q[5] - p[4] * q[3] - p[5] * q[6];
    const double rotation_g2 = p[3] * q[5] + p[4] * q[6] - p[5] * q[3] - p[6] * q[4];
    const double rotation_g3 = p[3] * q[6] + p[5] * q[4] - p[4] * q[5] - p[6] * q[3];
    const double rotation_norm_s_squared = rotation_g1 * rotation_g1 + rotation_g2 * rotation_g2 + rotation_g3
        * rotation_g3;
    const double rotation_abs_g0 = fabs(rotation_g0);
    const int near = rotation_norm_s_squared < 0.249287;
    const double rotation_t_over_norm_s_near = polynomial_rotation_t_over_norm_s_near((near ?
        4.011440628672975 * rotation_norm_s_squared : 0.0));
    const double rotation_norm_s = sqrt((near ? 1.0 : rotation_norm_s_squared));
    const double rotation_atan2_norm_s_abs_g0 = atan2(rotation_norm_s, rotation_abs_g0);
    const double rotation_t = 2.0 * rotation_atan2_norm_s_abs_g0;
    const double rotation_t_over_norm_s = (near ? rotation_t_over_norm_s_near : rotation_t / rotation_norm_s);
    const double rotation_scale = rotation_t_over_norm_s * (rotation_g0 < 0.0 ? -1.0 : 1.0);
    const double v0 = q[0] - p[0];
    const double v1 = q[1] - p[1];
    const double v2 = q[2] - p[2];
    const double v3 = rotation_g1 * rotation_scale;
    const double v4 = rotation_g2 * rotation_scale;
    const double v5 = rotation_g3 * rotation_scale;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
    v_out[3] = v3;
    v_out[4] = v4;
    v_out[5] = v5;
}

void se3_log_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT q,
    double *SE3_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) se3_log(p + 7 * i, q + 7 * i, v_out + 6 * i);
}

/* sqrt(distance(position)^2 + distance(rotation)^2) */
double se3_distance(const double *SE3_RESTRICT p, const double *SE3_RESTRICT q) {
    const double position_log0 = q[0] - p[0];
    const double position_log1 = q[1] - p[1];
    const double position_log2 = q[2] - p[2];
    const double rotation_g0 = p[3] * q[3] + p[4] * q[4] + p[5] * q[5] + p[6] * q[6];
    const double rotation_g1 = p[3] * q[4] + p[6] * q[5] - p[4] * q[3] - p[5] * q[6];
    const double rotation_g2 = p[3] * q[5] + p[4] * q[6] - p[5] * q[3] - p[6] * q[4];
    const double rotation_g3 = p[3] * q[6] + p[5] * q[4] - p[4] * q[5] - p[6] * q[3];
    const double rotation_norm_s_squared = rotation_g1 * rotation_g1 + rotation_g2 * rotation_g2 + rotation_g3
        * rotation_g3;
    const double rotation_norm_s = sqrt(rotation_norm_s_squared);
    const double rotation_abs_g0 = fabs(rotation_g0);
    const double rotation_atan2_norm_s_abs_g0 = atan2(rotation_norm_s, rotation_abs_g0);
    const double rotation_t = 2.0 * rotation_atan2_norm_s_abs_g0;
    const double length = sqrt(position_log0 * position_log0 + position_log1 * position_log1 + position_log2 *
        position_log2 + rotation_t * rotation_t);
    return length;
}

void se3_distance_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT q,
    double *SE3_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = se3_distance(p + 7 * i, q + 7 * i);
}

/* log_abs_det(position) + log_abs_det(rotation) */
double se3_log_abs_det(const double *SE3_RESTRICT p, const double *SE3_RESTRICT q) {
    const double rotation_g0 = p[3] * q[3] + p[4] * q[4] + p[5] * q[5] + p[6] * q[6];
    const double rotation_g1 = p[3] * q[4] + p[6] * q[5] - p[4] * q[3] - p[5] * q[6];
    const double rotation_g2 = p[3] * q[5] + p[4] * q[6] - p[5] * q[3] - p[6] * q[4];
    const double rotation_g3 = p[3] * q[6] + p[5] * q[4] - p[4] * q[5] - p[6] * q[3];
    const double rotation_norm_s_squared = rotation_g1 * rotation_g1 + rotation_g2 * rotation_g2 + rotation_g3
        * rotation_g3;
    const double rotation_abs_g0 = fabs(rotation_g0);
    const int near = rotation_norm_s_squared < 0.249287;
    const double rotation_norm_s = sqrt((near ? 1.0 : rotation_norm_s_squared));
    const double rotation_atan2_norm_s_abs_g0 = atan2(rotation_norm_s, rotation_abs_g0);
    const double rotation_t = 2.0 * rotation_atan2_norm_s_abs_g0;
    const double rotation_log_det_series = polynomial_rotation_log_det_series((near ? 4.011440628672975 *
        rotation_norm_s_squared : 0.0));
    const double rotation_log_det_near = rotation_norm_s_squared * rotation_log_det_series;
    const double rotation_log_det = (near ? rotation_log_det_near : 2.0 * log(0.5 * (rotation_t /
        rotation_norm_s)));
    return rotation_log_det;
}

void se3_log_abs_det_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT q,
    double *SE3_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = se3_log_abs_det(p + 7 * i, q + 7 * i);
}

/* position: G(p)^-1 df, rotation: G^-1 E df */
void se3_riemannian_gradient(
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT df,
    double *SE3_RESTRICT gradient_out) {
    const double product = 0.5 * df[4];
    const double product_2 = 0.5 * df[5];
    const double product_3 = 0.5 * df[3];
    const double product_4 = 0.5 * df[6];
    const double gradient3 = p[3] * product + p[6] * product_2 - p[4] * product_3 - p[5] * product_4;
    const double gradient4 = p[3] * product_2 + p[4] * product_4 - p[5] * product_3 - p[6] * product;
    const double gradient5 = p[5] * product + p[3] * product_4 - p[6] * product_3 - p[4] * product_2;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
    gradient_out[2] = df[2];
    gradient_out[3] = gradient3;
    gradient_out[4] = gradient4;
    gradient_out[5] = gradient5;
}

void se3_riemannian_gradient_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT df,
    double *SE3_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) se3_riemannian_gradient(p + 7 * i, df + 7 * i, gradient_out + 6 * i);
}

/* sqrt(gradient_norm(position)^2 + gradient_norm(rotation)^2) */
double se3_gradient_norm(const double *SE3_RESTRICT p, const double *SE3_RESTRICT df) {
    const double product = 0.5 * df[4];
    const double product_2 = 0.5 * df[5];
    const double product_3 = 0.5 * df[3];
    const double product_4 = 0.5 * df[6];
    const double rotation_gradient0 = p[3] * product + p[6] * product_2 - p[4] * product_3 - p[5] * product_4;
    const double rotation_gradient1 = p[3] * product_2 + p[4] * product_4 - p[5] * product_3 - p[6] * product;
    const double rotation_gradient2 = p[5] * product + p[3] * product_4 - p[6] * product_3 - p[4] * product_2;
    const double total_2 = df[0] * df[0] + df[1] * df[1] + df[2] * df[2] + rotation_gradient0 *
        rotation_gradient0 + rotation_gradient1 * rotation_gradient1;
    return sqrt(total_2 + rotation_gradient2 * rotation_gradient2);
}

void se3_gradient_norm_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT df,
    double *SE3_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = se3_gradient_norm(p + 7 * i, df + 7 * i);
}

/* position: v, rotation: qmul(qmul(h, [0, v]), conj(h))[1:] / dot(h, h) */
void se3_transport(
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT q,
    const double *SE3_RESTRICT v,
    double *SE3_RESTRICT w_out) {
    const double rotation_g0 = p[3] * q[3] + p[4] * q[4] + p[5] * q[5] + p[6] * q[6];
    const double rotation_g1 = p[3] * q[4] + p[6] * q[5] - p[4] * q[3] - p[5] * q[6];
    const double rotation_g2 = p[3] * q[5] + p[4] * q[6] - p[5] * q[3] - p[6] * q[4];
    const double rotation_g3 = p[3] * q[6] + p[5] * q[4] - p[4] * q[5] - p[6] * q[3];
    const double rotation_abs_g0 = fabs(rotation_g0);
    const double chosen = (rotation_g0 < 0.0 ? -1.0 : 1.0);
    const double rotation_h0 = 1.0 + rotation_abs_g0;
    const double rotation_g1_product = rotation_g1 * chosen;
    const double rotation_g2_product = rotation_g2 * chosen;
    const double rotation_g3_product = rotation_g3 * chosen;
    const double rotation_dot_h_h = rotation_h0 * rotation_h0 + rotation_g1_product * rotation_g1_product +
        rotation_g2_product * rotation_g2_product + rotation_g3_product * rotation_g3_product;
    const double rotation_scale_3 = 1.0 / rotation_dot_h_h;
    const double total_2 = v[3] * rotation_h0 - v[5] * rotation_g2_product + v[4] * rotation_g3_product;
    const double total_3 = v[5] * rotation_h0 - v[4] * rotation_g1_product + v[3] * rotation_g2_product;
    const double total_4 = v[3] * rotation_g1_product + v[4] * rotation_g2_product + v[5] *
        rotation_g3_product;
    const double total_5 = v[4] * rotation_h0 - v[3] * rotation_g3_product + v[5] * rotation_g1_product;
    const double w3 = rotation_scale_3 * (rotation_h0 * total_2 - rotation_g2_product * total_3 +
        rotation_g1_product * total_4 + rotation_g3_product * total_5);
    const double w4 = rotation_scale_3 * (rotation_h0 * total_5 - rotation_g3_product * total_2 +
        rotation_g1_product * total_3 + rotation_g2_product * total_4);
    const double w5 = rotation_scale_3 * (rotation_h0 * total_3 - rotation_g1_product * total_5 +
        rotation_g2_product * total_2 + rotation_g3_product * total_4);
    w_out[0] = v[0];
    w_out[1] = v[1];
    w_out[2] = v[2];
    w_out[3] = w3;
    w_out[4] = w4;
    w_out[5] = w5;
}

void se3_transport_batch(
    size_t count,
    const double *SE3_RESTRICT p,
    const double *SE3_RESTRICT q,
    const double *SE3_RESTRICT v,
    double *SE3_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) se3_transport(p + 7 * i, q + 7 * i, v + 6 * i, w_out + 6 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void se3_splat(
    const double *SE3_RESTRICT x,
    const double *SE3_RESTRICT mu,
    const double *SE3_RESTRICT W,
    double amplitude,
    double *SE3_RESTRICT value_out,
    double *SE3_RESTRICT gradient_out) {
    const double rotation_g0 = x[3] * mu[3] + x[4] * mu[4] + x[5] * mu[5] + x[6] * mu[6];
    const double rotation_g1 = x[4] * mu[3] + x[5] * mu[6] - x[3] * mu[4] - x[6] * mu[5];
    const double rotation_g2 = x[5] * mu[3] + x[6] * mu[4] - x[3] * mu[5] - x[4] * mu[6];
    const double rotation_g3 = x[6] * mu[3] + x[4] * mu[5] - x[5] * mu[4] - x[3] * mu[6];
    const double rotation_norm_s_squared = rotation_g1 * rotation_g1 + rotation_g2 * rotation_g2 + rotation_g3
        * rotation_g3;
    const double rotation_abs_g0 = fabs(rotation_g0);
    const int near = rotation_norm_s_squared < 0.249287;
    const double near_chosen = (near ? 4.011440628672975 * rotation_norm_s_squared : 0.0);
    const double rotation_t_over_norm_s_near = polynomial_rotation_t_over_norm_s_near(near_chosen);
    const double near_chosen_2 = (near ? 1.0 : rotation_norm_s_squared);
    const double rotation_norm_s = sqrt(near_chosen_2);
    const double rotation_atan2_norm_s_abs_g0 = atan2(rotation_norm_s, rotation_abs_g0);
    const double rotation_t = 2.0 * rotation_atan2_norm_s_abs_g0;
    const double rotation_t_ratio = rotation_t / rotation_norm_s;
    const double rotation_t_over_norm_s = (near ? rotation_t_over_norm_s_near : rotation_t_ratio);
    const int is_small = rotation_g0 < 0.0;
    const double chosen = (is_small ? -1.0 : 1.0);
    const double rotation_scale = rotation_t_over_norm_s * chosen;
    const double v0 = x[0] - mu[0];
    const double v1 = x[1] - mu[1];
    const double v2 = x[2] - mu[2];
    const double v3 = rotation_g1 * rotation_scale;
    const double v4 = rotation_g2 * rotation_scale;
    const double v5 = rotation_g3 * rotation_scale;
    const double rotation_log_det_series = polynomial_rotation_log_det_series(near_chosen);
    const double rotation_log_det_near = rotation_norm_s_squared * rotation_log_det_series;
    const double product = 0.5 * rotation_t_ratio;
    const double rotation_log_det = (near ? rotation_log_det_near : 2.0 * log(product));
    const double total_2 = W[0] * v0 + W[1] * v1 + W[2] * v2 + W[3] * v3 + W[4] * v4;
    const double z0 = total_2 + W[5] * v5;
    const double total_3 = W[6] * v0 + W[7] * v1 + W[8] * v2 + W[9] * v3 + W[10] * v4;
    const double z1 = total_3 + W[11] * v5;
    const double total_4 = W[12] * v0 + W[13] * v1 + W[14] * v2 + W[15] * v3 + W[16] * v4;
    const double z2 = total_4 + W[17] * v5;
    const double total_5 = W[18] * v0 + W[19] * v1 + W[20] * v2 + W[21] * v3 + W[22] * v4;
    const double z3 = total_5 + W[23] * v5;
    const double total_6 = W[24] * v0 + W[25] * v1 + W[26] * v2 + W[27] * v3 + W[28] * v4;
    const double z4 = total_6 + W[29] * v5;
    const double total_7 = W[30] * v0 + W[31] * v1 + W[32] * v2 + W[33] * v3 + W[34] * v4;
    const double z5 = total_7 + W[35] * v5;
    const double total_8 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
    const double exp_2 = exp(rotation_log_det - 0.5 * (total_8 + z5 * z5));
    const double phi = amplitude * exp_2;
    const double gap = -(W[35] * z5) - W[29] * z4 - W[23] * z3 - W[17] * z2;
    const double gap_2 = -(W[34] * z5) - W[28] * z4 - W[22] * z3 - W[16] * z2;
    const double gap_3 = -(W[33] * z5) - W[27] * z4 - W[21] * z3 - W[15] * z2;
    const double gap_4 = -(W[32] * z5) - W[26] * z4 - W[20] * z3 - W[14] * z2;
    const double gap_5 = -(W[31] * z5) - W[25] * z4 - W[19] * z3 - W[13] * z2;
    const double gap_6 = -(W[30] * z5) - W[24] * z4 - W[18] * z3 - W[12] * z2;
    const double by_v5 = gap - W[11] * z1 - W[5] * z0;
    const double by_v4 = gap_2 - W[10] * z1 - W[4] * z0;
    const double by_v3 = gap_3 - W[9] * z1 - W[3] * z0;
    const double by_v2 = gap_4 - W[8] * z1 - W[2] * z0;
    const double by_v1 = gap_5 - W[7] * z1 - W[1] * z0;
    const double by_v0 = gap_6 - W[6] * z1 - W[0] * z0;
    const double by_rotation_log_det_near = (near ? 1.0 : 0.0);
    const double by_rotation_log_det_series = rotation_norm_s_squared * by_rotation_log_det_near;
    const double rotation_log_det_series_slope = polynomial_rotation_log_det_series_slope(near_chosen);
    const double by_rotation_scale = rotation_g3 * by_v5 + rotation_g2 * by_v4 + rotation_g1 * by_v3;
    const double by_rotation_t_over_norm_s = chosen * by_rotation_scale;
    const double by_rotation_t_over_norm_s_near = (near ? by_rotation_t_over_norm_s : 0.0);
    const double total_9 = 0.5 * (2.0 * (near ? 0.0 : 1.0) / product) + (near ? 0.0 :
        by_rotation_t_over_norm_s);
    const double by_rotation_t = total_9 / rotation_norm_s;
    const double by_rotation_atan2_norm_s_abs_g0 = 2.0 * by_rotation_t;
    const double ratio = by_rotation_atan2_norm_s_abs_g0 / (near_chosen_2 + rotation_abs_g0 *
        rotation_abs_g0);
    const double product_2 = rotation_norm_s * ratio;
    const double by_rotation_abs_g0 = -product_2;
    const double by_rotation_norm_s = rotation_abs_g0 * ratio - rotation_t_ratio * by_rotation_t;
    const double rotation_t_over_norm_s_near_slope =
        polynomial_rotation_t_over_norm_s_near_slope(near_chosen);
    const double by_rotation_norm_s_squared = rotation_log_det_series * by_rotation_log_det_near + (near ? 0.0
        : by_rotation_norm_s / (2.0 * rotation_norm_s)) + 4.011440628672975 * (near ?
        by_rotation_log_det_series * rotation_log_det_series_slope + by_rotation_t_over_norm_s_near *
        rotation_t_over_norm_s_near_slope : 0.0);
    const double by_rotation_g0 = (is_small ? product_2 : by_rotation_abs_g0);
    const double product_3 = 2.0 * by_rotation_norm_s_squared;
    const double by_rotation_g3 = rotation_scale * by_v5 + rotation_g3 * product_3;
    const double by_rotation_g2 = rotation_scale * by_v4 + rotation_g2 * product_3;
    const double by_rotation_g1 = rotation_scale * by_v3 + rotation_g1 * product_3;
    const double exponent_by_x6 = mu[3] * by_rotation_g3 + mu[4] * by_rotation_g2 - mu[5] * by_rotation_g1 +
        mu[6] * by_rotation_g0;
    const double exponent_by_x5 = mu[3] * by_rotation_g2 - mu[4] * by_rotation_g3 + mu[6] * by_rotation_g1 +
        mu[5] * by_rotation_g0;
    const double exponent_by_x4 = mu[5] * by_rotation_g3 - mu[6] * by_rotation_g2 + mu[3] * by_rotation_g1 +
        mu[4] * by_rotation_g0;
    const double exponent_by_x3 = -(mu[6] * by_rotation_g3) - mu[5] * by_rotation_g2 - mu[4] * by_rotation_g1
        + mu[3] * by_rotation_g0;
    const double df0 = phi * by_v0;
    const double df1 = phi * by_v1;
    const double df2 = phi * by_v2;
    const double df3 = phi * exponent_by_x3;
    const double df4 = phi * exponent_by_x4;
    const double df5 = phi * exponent_by_x5;
    const double df6 = phi * exponent_by_x6;
    const double df4_product = 0.5 * df4;
    const double df5_product = 0.5 * df5;
    const double df3_product = 0.5 * df3;
    const double df6_product = 0.5 * df6;
    const double gradient3 = x[3] * df4_product + x[6] * df5_product - x[4] * df3_product - x[5] *
        df6_product;
    const double gradient4 = x[3] * df5_product + x[4] * df6_product - x[5] * df3_product - x[6] *
        df4_product;
    const double gradient5 = x[5] * df4_product + x[3] * df6_product - x[6] * df3_product - x[4] *
        df5_product;
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
    gradient_out[2] = df2;
    gradient_out[3] = gradient3;
    gradient_out[4] = gradient4;
    gradient_out[5] = gradient5;
}

void se3_splat_batch(
    size_t count,
    const double *SE3_RESTRICT x,
    const double *SE3_RESTRICT mu,
    const double *SE3_RESTRICT W,
    const double *SE3_RESTRICT amplitude,
    double *SE3_RESTRICT value_out,
    double *SE3_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) se3_splat(x + 7 * i, mu + 7 * i, W + 36 * i, amplitude[i], value_out + i, gradient_out + 6 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void se3_frame(const double *SE3_RESTRICT p, double *SE3_RESTRICT frame) {
    double left[7][6];
    for (int i = 0; i < 7; ++i) {
        double axis[7];
        for (int j = 0; j < 7; ++j) axis[j] = i == j ? 1.0 : 0.0;
        se3_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 6; ++row) {
        double *e = frame + 6 * row;
        int longest = 0;
        for (int i = 1; i < 7; ++i)
            if (se3_norm(p, left[i]) > se3_norm(p, left[longest])) longest = i;
        const double length = se3_norm(p, left[longest]);
        for (int j = 0; j < 6; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 7; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 7];
            const double part = se3_inner(p, e, rest);
            for (int j = 0; j < 6; ++j) rest[j] -= part * e[j];
        }
    }
}

/* Of degree 4, within 2^-30 of that of double precision. */
static inline float polynomial_rotation_cos__near_f(float x) {
    return 0.9999999994976135f + x * (-0.49519647485985047f + x * (0.040869727563992035f + x *
        (-0.0013486780417677447f + x * 2.3213754968692044e-05f)));
}

/* Of degree 4, within 2^-34 of that of double precision. */
static inline float polynomial_rotation_sinc__near_f(float x) {
    return 0.999999999954183f + x * (-0.1650654977075424f + x * (0.008173967428130452f + x *
        (-0.00019269751212383233f + x * 2.592292971066502e-06f)));
}

/* Of degree 5, within 2^-27 of that of double precision. */
static inline float polynomial_rotation_t_over_norm_s_near_f(float x) {
    return 1.9999999916408444f + x * (0.08309625685133959f + x * (0.009314899571001777f + x *
        (0.001410660168357637f + x * (0.0001850457232808171f + x * 8.1767340923012e-05f))));
}

/* Of degree 6, within 2^-30 of that of double precision. */
static inline float polynomial_rotation_log_det_series_f(float x) {
    return 0.33333333360654344f + x * (0.030468384794974636f + x * (0.004187186052703318f + x *
        (0.0006798423432636281f + x * (0.00012869008203200835f + x * (1.4352383872053921e-05f + x *
        1.0146648022958735e-05f)))));
}

/* Of degree 7, within 2^-29 of that of double precision. */
static inline float polynomial_rotation_log_det_series_slope_f(float x) {
    return 0.030468411075324144f + x * (0.00837355342611542f + x * (0.0020466142655597187f + x *
        (0.0004893663510207316f + x * (0.00011341332759154923f + x * (3.308965514831338e-05f + x *
        (7.033240749837545e-07f + x * 4.5653796914644905e-06f))))));
}

/* Of degree 7, within 2^-30 of that of double precision. */
static inline float polynomial_rotation_t_over_norm_s_near_slope_f(float x) {
    return 0.08309566660530374f + x * (0.0186432102329603f + x * (0.004149402027001096f + x *
        (0.0009398850567115093f + x * (0.00021071714765224622f + x * (5.936713146666543e-05f + x *
        (1.5937893933276167e-06f + x * 7.904358196252664e-06f))))));
}

/* position: x, rotation: p / norm(p) */
void se3_project_f(const float *SE3_RESTRICT x, float *SE3_RESTRICT p_out) {
    const float rotation_norm_p_squared = x[3] * x[3] + x[4] * x[4] + x[5] * x[5] + x[6] * x[6];
    const float rotation_norm_p = sqrtf(rotation_norm_p_squared);
    const float rotation_scale = 1.0f / rotation_norm_p;
    const float p3 = x[3] * rotation_scale;
    const float p4 = x[4] * rotation_scale;
    const float p5 = x[5] * rotation_scale;
    const float p6 = x[6] * rotation_scale;
    p_out[0] = x[0];
    p_out[1] = x[1];
    p_out[2] = x[2];
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
}

void se3_project_batch_f(size_t count, const float *SE3_RESTRICT x, float *SE3_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) se3_project_f(x + 7 * i, p_out + 7 * i);
}

/* position: x, rotation: (E E^T)^-1 E x */
void se3_to_tangent_f(const float *SE3_RESTRICT p, const float *SE3_RESTRICT x, float *SE3_RESTRICT v_out) {
    const float product = 2.0f * p[3];
    const float product_2 = 2.0f * p[6];
    const float product_3 = 2.0f * p[4];
    const float product_4 = 2.0f * p[5];
    const float v3 = x[4] * product + x[5] * product_2 - x[3] * product_3 - x[6] * product_4;
    const float v4 = x[5] * product + x[6] * product_3 - x[3] * product_4 - x[4] * product_2;
    const float v5 = x[6] * product + x[4] * product_4 - x[5] * product_3 - x[3] * product_2;
    v_out[0] = x[0];
    v_out[1] = x[1];
    v_out[2] = x[2];
    v_out[3] = v3;
    v_out[4] = v4;
    v_out[5] = v5;
}

void se3_to_tangent_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT x,
    float *SE3_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) se3_to_tangent_f(p + 7 * i, x + 7 * i, v_out + 6 * i);
}

/* inner(position) + inner(rotation) */
float se3_inner_f(const float *SE3_RESTRICT p, const float *SE3_RESTRICT u, const float *SE3_RESTRICT v) {
    (void)p;
    const float total_2 = u[0] * v[0] + u[1] * v[1] + u[2] * v[2] + u[3] * v[3] + u[4] * v[4];
    return total_2 + u[5] * v[5];
}

void se3_inner_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT u,
    const float *SE3_RESTRICT v,
    float *SE3_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = se3_inner_f(p + 7 * i, u + 6 * i, v + 6 * i);
}

/* sqrt(norm(position)^2 + norm(rotation)^2) */
float se3_norm_f(const float *SE3_RESTRICT p, const float *SE3_RESTRICT v) {
    (void)p;
    const float total_2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3] + v[4] * v[4];
    return sqrtf(total_2 + v[5] * v[5]);
}

void se3_norm_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT v,
    float *SE3_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = se3_norm_f(p + 7 * i, v + 6 * i);
}

/* position: G(p) v, rotation: G(p) v */
void se3_flat_f(const float *SE3_RESTRICT p, const float *SE3_RESTRICT v, float *SE3_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
    covector_out[3] = v[3];
    covector_out[4] = v[4];
    covector_out[5] = v[5];
}

void se3_flat_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT v,
    float *SE3_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) se3_flat_f(p + 7 * i, v + 6 * i, covector_out + 6 * i);
}

/* position: p + v, rotation: qmul(p, [cos(norm(v) / 2), sinc(norm(v) / 2) / 2 * v]) */
void se3_exp_f(const float *SE3_RESTRICT p, const float *SE3_RESTRICT v, float *SE3_RESTRICT q_out) {
    const float rotation_norm_v_squared = v[3] * v[3] + v[4] * v[4] + v[5] * v[5];
    const int near = 0.25f * rotation_norm_v_squared < 0.990393f;
    const float near_chosen = (near ? 0.2524250474306664f * rotation_norm_v_squared : 0.0f);
    const float rotation_cos__near = polynomial_rotation_cos__near_f(near_chosen);
    const float rotation_norm_v = sqrtf((near ? 1.0f : rotation_norm_v_squared));
    const float product = 0.5f * rotation_norm_v;
    const float rotation_cos_ = (near ? rotation_cos__near : cosf(product));
    const float rotation_sinc__near = polynomial_rotation_sinc__near_f(near_chosen);
    const float rotation_sinc_ = (near ? rotation_sinc__near : 2.0f * sinf(product) / rotation_norm_v);
    const float rotation_scale = 0.5f * rotation_sinc_;
    const float q0 = p[0] + v[0];
    const float q1 = p[1] + v[1];
    const float q2 = p[2] + v[2];
    const float product_2 = p[4] * rotation_scale;
    const float product_3 = p[5] * rotation_scale;
    const float product_4 = p[6] * rotation_scale;
    const float q3 = p[3] * rotation_cos_ - v[3] * product_2 - v[4] * product_3 - v[5] * product_4;
    const float product_5 = p[3] * rotation_scale;
    const float q4 = p[4] * rotation_cos_ + v[3] * product_5 + v[5] * product_3 - v[4] * product_4;
    const float q5 = p[5] * rotation_cos_ + v[4] * product_5 + v[3] * product_4 - v[5] * product_2;
    const float q6 = p[6] * rotation_cos_ + v[5] * product_5 + v[4] * product_2 - v[3] * product_3;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
    q_out[4] = q4;
    q_out[5] = q5;
    q_out[6] = q6;
}

void se3_exp_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT v,
    float *SE3_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) se3_exp_f(p + 7 * i, v + 6 * i, q_out + 7 * i);
}

/* position: q - p, rotation: sign(g[0]) * t * s / norm(s) */
void se3_log_f(const float *SE3_RESTRICT p, const float *SE3_RESTRICT q, float *SE3_RESTRICT v_out) {
    const float rotation_g0 = p[3] * q[3] + p[4] * q[4] + p[5] * q[5] + p[6] * q[6];
    const float rotation_g1 = p[3] * q[4] + p[6] * q[5] - p[4] * q[3] - p[5] * q[6];
    const float rotation_g2 = p[3] * q[5] + p[4] * q[6] - p[5] * q[3] - p[6] * q[4];
    const float rotation_g3 = p[3] * q[6] + p[5] * q[4] - p[4] * q[5] - p[6] * q[3];
    const float rotation_norm_s_squared = rotation_g1 * rotation_g1 + rotation_g2 * rotation_g2 + rotation_g3
        * rotation_g3;
    const float rotation_abs_g0 = fabsf(rotation_g0);
    const int near = rotation_norm_s_squared < 0.249287f;
    const float rotation_t_over_norm_s_near = polynomial_rotation_t_over_norm_s_near_f((near ?
        4.011440628672975f * rotation_norm_s_squared : 0.0f));
    const float rotation_norm_s = sqrtf((near ? 1.0f : rotation_norm_s_squared));
    const float rotation_atan2_norm_s_abs_g0 = atan2f(rotation_norm_s, rotation_abs_g0);
    const float rotation_t = 2.0f * rotation_atan2_norm_s_abs_g0;
    const float rotation_t_over_norm_s = (near ? rotation_t_over_norm_s_near : rotation_t / rotation_norm_s);
    const float rotation_scale = rotation_t_over_norm_s * (rotation_g0 < 0.0f ? -1.0f : 1.0f);
    const float v0 = q[0] - p[0];
    const float v1 = q[1] - p[1];
    const float v2 = q[2] - p[2];
    const float v3 = rotation_g1 * rotation_scale;
    const float v4 = rotation_g2 * rotation_scale;
    const float v5 = rotation_g3 * rotation_scale;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
    v_out[3] = v3;
    v_out[4] = v4;
    v_out[5] = v5;
}

void se3_log_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT q,
    float *SE3_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) se3_log_f(p + 7 * i, q + 7 * i, v_out + 6 * i);
}

/* sqrt(distance(position)^2 + distance(rotation)^2) */
float se3_distance_f(const float *SE3_RESTRICT p, const float *SE3_RESTRICT q) {
    const float position_log0 = q[0] - p[0];
    const float position_log1 = q[1] - p[1];
    const float position_log2 = q[2] - p[2];
    const float rotation_g0 = p[3] * q[3] + p[4] * q[4] + p[5] * q[5] + p[6] * q[6];
    const float rotation_g1 = p[3] * q[4] + p[6] * q[5] - p[4] * q[3] - p[5] * q[6];
    const float rotation_g2 = p[3] * q[5] + p[4] * q[6] - p[5] * q[3] - p[6] * q[4];
    const float rotation_g3 = p[3] * q[6] + p[5] * q[4] - p[4] * q[5] - p[6] * q[3];
    const float rotation_norm_s_squared = rotation_g1 * rotation_g1 + rotation_g2 * rotation_g2 + rotation_g3
        * rotation_g3;
    const float rotation_norm_s = sqrtf(rotation_norm_s_squared);
    const float rotation_abs_g0 = fabsf(rotation_g0);
    const float rotation_atan2_norm_s_abs_g0 = atan2f(rotation_norm_s, rotation_abs_g0);
    const float rotation_t = 2.0f * rotation_atan2_norm_s_abs_g0;
    const float length = sqrtf(position_log0 * position_log0 + position_log1 * position_log1 + position_log2 *
        position_log2 + rotation_t * rotation_t);
    return length;
}

void se3_distance_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT q,
    float *SE3_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = se3_distance_f(p + 7 * i, q + 7 * i);
}

/* log_abs_det(position) + log_abs_det(rotation) */
float se3_log_abs_det_f(const float *SE3_RESTRICT p, const float *SE3_RESTRICT q) {
    const float rotation_g0 = p[3] * q[3] + p[4] * q[4] + p[5] * q[5] + p[6] * q[6];
    const float rotation_g1 = p[3] * q[4] + p[6] * q[5] - p[4] * q[3] - p[5] * q[6];
    const float rotation_g2 = p[3] * q[5] + p[4] * q[6] - p[5] * q[3] - p[6] * q[4];
    const float rotation_g3 = p[3] * q[6] + p[5] * q[4] - p[4] * q[5] - p[6] * q[3];
    const float rotation_norm_s_squared = rotation_g1 * rotation_g1 + rotation_g2 * rotation_g2 + rotation_g3
        * rotation_g3;
    const float rotation_abs_g0 = fabsf(rotation_g0);
    const int near = rotation_norm_s_squared < 0.249287f;
    const float rotation_norm_s = sqrtf((near ? 1.0f : rotation_norm_s_squared));
    const float rotation_atan2_norm_s_abs_g0 = atan2f(rotation_norm_s, rotation_abs_g0);
    const float rotation_t = 2.0f * rotation_atan2_norm_s_abs_g0;
    const float rotation_log_det_series = polynomial_rotation_log_det_series_f((near ? 4.011440628672975f *
        rotation_norm_s_squared : 0.0f));
    const float rotation_log_det_near = rotation_norm_s_squared * rotation_log_det_series;
    const float rotation_log_det = (near ? rotation_log_det_near : 2.0f * logf(0.5f * (rotation_t /
        rotation_norm_s)));
    return rotation_log_det;
}

void se3_log_abs_det_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT q,
    float *SE3_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = se3_log_abs_det_f(p + 7 * i, q + 7 * i);
}

/* position: G(p)^-1 df, rotation: G^-1 E df */
void se3_riemannian_gradient_f(
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT df,
    float *SE3_RESTRICT gradient_out) {
    const float product = 0.5f * df[4];
    const float product_2 = 0.5f * df[5];
    const float product_3 = 0.5f * df[3];
    const float product_4 = 0.5f * df[6];
    const float gradient3 = p[3] * product + p[6] * product_2 - p[4] * product_3 - p[5] * product_4;
    const float gradient4 = p[3] * product_2 + p[4] * product_4 - p[5] * product_3 - p[6] * product;
    const float gradient5 = p[5] * product + p[3] * product_4 - p[6] * product_3 - p[4] * product_2;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
    gradient_out[2] = df[2];
    gradient_out[3] = gradient3;
    gradient_out[4] = gradient4;
    gradient_out[5] = gradient5;
}

void se3_riemannian_gradient_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT df,
    float *SE3_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) se3_riemannian_gradient_f(p + 7 * i, df + 7 * i, gradient_out + 6 * i);
}

/* sqrt(gradient_norm(position)^2 + gradient_norm(rotation)^2) */
float se3_gradient_norm_f(const float *SE3_RESTRICT p, const float *SE3_RESTRICT df) {
    const float product = 0.5f * df[4];
    const float product_2 = 0.5f * df[5];
    const float product_3 = 0.5f * df[3];
    const float product_4 = 0.5f * df[6];
    const float rotation_gradient0 = p[3] * product + p[6] * product_2 - p[4] * product_3 - p[5] * product_4;
    const float rotation_gradient1 = p[3] * product_2 + p[4] * product_4 - p[5] * product_3 - p[6] * product;
    const float rotation_gradient2 = p[5] * product + p[3] * product_4 - p[6] * product_3 - p[4] * product_2;
    const float total_2 = df[0] * df[0] + df[1] * df[1] + df[2] * df[2] + rotation_gradient0 *
        rotation_gradient0 + rotation_gradient1 * rotation_gradient1;
    return sqrtf(total_2 + rotation_gradient2 * rotation_gradient2);
}

void se3_gradient_norm_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT df,
    float *SE3_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = se3_gradient_norm_f(p + 7 * i, df + 7 * i);
}

/* position: v, rotation: qmul(qmul(h, [0, v]), conj(h))[1:] / dot(h, h) */
void se3_transport_f(
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT q,
    const float *SE3_RESTRICT v,
    float *SE3_RESTRICT w_out) {
    const float rotation_g0 = p[3] * q[3] + p[4] * q[4] + p[5] * q[5] + p[6] * q[6];
    const float rotation_g1 = p[3] * q[4] + p[6] * q[5] - p[4] * q[3] - p[5] * q[6];
    const float rotation_g2 = p[3] * q[5] + p[4] * q[6] - p[5] * q[3] - p[6] * q[4];
    const float rotation_g3 = p[3] * q[6] + p[5] * q[4] - p[4] * q[5] - p[6] * q[3];
    const float rotation_abs_g0 = fabsf(rotation_g0);
    const float chosen = (rotation_g0 < 0.0f ? -1.0f : 1.0f);
    const float rotation_h0 = 1.0f + rotation_abs_g0;
    const float rotation_g1_product = rotation_g1 * chosen;
    const float rotation_g2_product = rotation_g2 * chosen;
    const float rotation_g3_product = rotation_g3 * chosen;
    const float rotation_dot_h_h = rotation_h0 * rotation_h0 + rotation_g1_product * rotation_g1_product +
        rotation_g2_product * rotation_g2_product + rotation_g3_product * rotation_g3_product;
    const float rotation_scale_3 = 1.0f / rotation_dot_h_h;
    const float total_2 = v[3] * rotation_h0 - v[5] * rotation_g2_product + v[4] * rotation_g3_product;
    const float total_3 = v[5] * rotation_h0 - v[4] * rotation_g1_product + v[3] * rotation_g2_product;
    const float total_4 = v[3] * rotation_g1_product + v[4] * rotation_g2_product + v[5] *
        rotation_g3_product;
    const float total_5 = v[4] * rotation_h0 - v[3] * rotation_g3_product + v[5] * rotation_g1_product;
    const float w3 = rotation_scale_3 * (rotation_h0 * total_2 - rotation_g2_product * total_3 +
        rotation_g1_product * total_4 + rotation_g3_product * total_5);
    const float w4 = rotation_scale_3 * (rotation_h0 * total_5 - rotation_g3_product * total_2 +
        rotation_g1_product * total_3 + rotation_g2_product * total_4);
    const float w5 = rotation_scale_3 * (rotation_h0 * total_3 - rotation_g1_product * total_5 +
        rotation_g2_product * total_2 + rotation_g3_product * total_4);
    w_out[0] = v[0];
    w_out[1] = v[1];
    w_out[2] = v[2];
    w_out[3] = w3;
    w_out[4] = w4;
    w_out[5] = w5;
}

void se3_transport_batch_f(
    size_t count,
    const float *SE3_RESTRICT p,
    const float *SE3_RESTRICT q,
    const float *SE3_RESTRICT v,
    float *SE3_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) se3_transport_f(p + 7 * i, q + 7 * i, v + 6 * i, w_out + 6 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void se3_splat_f(
    const float *SE3_RESTRICT x,
    const float *SE3_RESTRICT mu,
    const float *SE3_RESTRICT W,
    float amplitude,
    float *SE3_RESTRICT value_out,
    float *SE3_RESTRICT gradient_out) {
    const float rotation_g0 = x[3] * mu[3] + x[4] * mu[4] + x[5] * mu[5] + x[6] * mu[6];
    const float rotation_g1 = x[4] * mu[3] + x[5] * mu[6] - x[3] * mu[4] - x[6] * mu[5];
    const float rotation_g2 = x[5] * mu[3] + x[6] * mu[4] - x[3] * mu[5] - x[4] * mu[6];
    const float rotation_g3 = x[6] * mu[3] + x[4] * mu[5] - x[5] * mu[4] - x[3] * mu[6];
    const float rotation_norm_s_squared = rotation_g1 * rotation_g1 + rotation_g2 * rotation_g2 + rotation_g3
        * rotation_g3;
    const float rotation_abs_g0 = fabsf(rotation_g0);
    const int near = rotation_norm_s_squared < 0.249287f;
    const float near_chosen = (near ? 4.011440628672975f * rotation_norm_s_squared : 0.0f);
    const float rotation_t_over_norm_s_near = polynomial_rotation_t_over_norm_s_near_f(near_chosen);
    const float near_chosen_2 = (near ? 1.0f : rotation_norm_s_squared);
    const float rotation_norm_s = sqrtf(near_chosen_2);
    const float rotation_atan2_norm_s_abs_g0 = atan2f(rotation_norm_s, rotation_abs_g0);
    const float rotation_t = 2.0f * rotation_atan2_norm_s_abs_g0;
    const float rotation_t_ratio = rotation_t / rotation_norm_s;
    const float rotation_t_over_norm_s = (near ? rotation_t_over_norm_s_near : rotation_t_ratio);
    const int is_small = rotation_g0 < 0.0f;
    const float chosen = (is_small ? -1.0f : 1.0f);
    const float rotation_scale = rotation_t_over_norm_s * chosen;
    const float v0 = x[0] - mu[0];
    const float v1 = x[1] - mu[1];
    const float v2 = x[2] - mu[2];
    const float v3 = rotation_g1 * rotation_scale;
    const float v4 = rotation_g2 * rotation_scale;
    const float v5 = rotation_g3 * rotation_scale;
    const float rotation_log_det_series = polynomial_rotation_log_det_series_f(near_chosen);
    const float rotation_log_det_near = rotation_norm_s_squared * rotation_log_det_series;
    const float product = 0.5f * rotation_t_ratio;
    const float rotation_log_det = (near ? rotation_log_det_near : 2.0f * logf(product));
    const float total_2 = W[0] * v0 + W[1] * v1 + W[2] * v2 + W[3] * v3 + W[4] * v4;
    const float z0 = total_2 + W[5] * v5;
    const float total_3 = W[6] * v0 + W[7] * v1 + W[8] * v2 + W[9] * v3 + W[10] * v4;
    const float z1 = total_3 + W[11] * v5;
    const float total_4 = W[12] * v0 + W[13] * v1 + W[14] * v2 + W[15] * v3 + W[16] * v4;
    const float z2 = total_4 + W[17] * v5;
    const float total_5 = W[18] * v0 + W[19] * v1 + W[20] * v2 + W[21] * v3 + W[22] * v4;
    const float z3 = total_5 + W[23] * v5;
    const float total_6 = W[24] * v0 + W[25] * v1 + W[26] * v2 + W[27] * v3 + W[28] * v4;
    const float z4 = total_6 + W[29] * v5;
    const float total_7 = W[30] * v0 + W[31] * v1 + W[32] * v2 + W[33] * v3 + W[34] * v4;
    const float z5 = total_7 + W[35] * v5;
    const float total_8 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
    const float exp_2 = expf(rotation_log_det - 0.5f * (total_8 + z5 * z5));
    const float phi = amplitude * exp_2;
    const float gap = -(W[35] * z5) - W[29] * z4 - W[23] * z3 - W[17] * z2;
    const float gap_2 = -(W[34] * z5) - W[28] * z4 - W[22] * z3 - W[16] * z2;
    const float gap_3 = -(W[33] * z5) - W[27] * z4 - W[21] * z3 - W[15] * z2;
    const float gap_4 = -(W[32] * z5) - W[26] * z4 - W[20] * z3 - W[14] * z2;
    const float gap_5 = -(W[31] * z5) - W[25] * z4 - W[19] * z3 - W[13] * z2;
    const float gap_6 = -(W[30] * z5) - W[24] * z4 - W[18] * z3 - W[12] * z2;
    const float by_v5 = gap - W[11] * z1 - W[5] * z0;
    const float by_v4 = gap_2 - W[10] * z1 - W[4] * z0;
    const float by_v3 = gap_3 - W[9] * z1 - W[3] * z0;
    const float by_v2 = gap_4 - W[8] * z1 - W[2] * z0;
    const float by_v1 = gap_5 - W[7] * z1 - W[1] * z0;
    const float by_v0 = gap_6 - W[6] * z1 - W[0] * z0;
    const float by_rotation_log_det_near = (near ? 1.0f : 0.0f);
    const float by_rotation_log_det_series = rotation_norm_s_squared * by_rotation_log_det_near;
    const float rotation_log_det_series_slope = polynomial_rotation_log_det_series_slope_f(near_chosen);
    const float by_rotation_scale = rotation_g3 * by_v5 + rotation_g2 * by_v4 + rotation_g1 * by_v3;
    const float by_rotation_t_over_norm_s = chosen * by_rotation_scale;
    const float by_rotation_t_over_norm_s_near = (near ? by_rotation_t_over_norm_s : 0.0f);
    const float total_9 = 0.5f * (2.0f * (near ? 0.0f : 1.0f) / product) + (near ? 0.0f :
        by_rotation_t_over_norm_s);
    const float by_rotation_t = total_9 / rotation_norm_s;
    const float by_rotation_atan2_norm_s_abs_g0 = 2.0f * by_rotation_t;
    const float ratio = by_rotation_atan2_norm_s_abs_g0 / (near_chosen_2 + rotation_abs_g0 * rotation_abs_g0);
    const float product_2 = rotation_norm_s * ratio;
    const float by_rotation_abs_g0 = -product_2;
    const float by_rotation_norm_s = rotation_abs_g0 * ratio - rotation_t_ratio * by_rotation_t;
    const float rotation_t_over_norm_s_near_slope =
        polynomial_rotation_t_over_norm_s_near_slope_f(near_chosen);
    const float by_rotation_norm_s_squared = rotation_log_det_series * by_rotation_log_det_near + (near ? 0.0f
        : by_rotation_norm_s / (2.0f * rotation_norm_s)) + 4.011440628672975f * (near ?
        by_rotation_log_det_series * rotation_log_det_series_slope + by_rotation_t_over_norm_s_near *
        rotation_t_over_norm_s_near_slope : 0.0f);
    const float by_rotation_g0 = (is_small ? product_2 : by_rotation_abs_g0);
    const float product_3 = 2.0f * by_rotation_norm_s_squared;
    const float by_rotation_g3 = rotation_scale * by_v5 + rotation_g3 * product_3;
    const float by_rotation_g2 = rotation_scale * by_v4 + rotation_g2 * product_3;
    const float by_rotation_g1 = rotation_scale * by_v3 + rotation_g1 * product_3;
    const float exponent_by_x6 = mu[3] * by_rotation_g3 + mu[4] * by_rotation_g2 - mu[5] * by_rotation_g1 +
        mu[6] * by_rotation_g0;
    const float exponent_by_x5 = mu[3] * by_rotation_g2 - mu[4] * by_rotation_g3 + mu[6] * by_rotation_g1 +
        mu[5] * by_rotation_g0;
    const float exponent_by_x4 = mu[5] * by_rotation_g3 - mu[6] * by_rotation_g2 + mu[3] * by_rotation_g1 +
        mu[4] * by_rotation_g0;
    const float exponent_by_x3 = -(mu[6] * by_rotation_g3) - mu[5] * by_rotation_g2 - mu[4] * by_rotation_g1 +
        mu[3] * by_rotation_g0;
    const float df0 = phi * by_v0;
    const float df1 = phi * by_v1;
    const float df2 = phi * by_v2;
    const float df3 = phi * exponent_by_x3;
    const float df4 = phi * exponent_by_x4;
    const float df5 = phi * exponent_by_x5;
    const float df6 = phi * exponent_by_x6;
    const float df4_product = 0.5f * df4;
    const float df5_product = 0.5f * df5;
    const float df3_product = 0.5f * df3;
    const float df6_product = 0.5f * df6;
    const float gradient3 = x[3] * df4_product + x[6] * df5_product - x[4] * df3_product - x[5] * df6_product;
    const float gradient4 = x[3] * df5_product + x[4] * df6_product - x[5] * df3_product - x[6] * df4_product;
    const float gradient5 = x[5] * df4_product + x[3] * df6_product - x[6] * df3_product - x[4] * df5_product;
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
    gradient_out[2] = df2;
    gradient_out[3] = gradient3;
    gradient_out[4] = gradient4;
    gradient_out[5] = gradient5;
}

void se3_splat_batch_f(
    size_t count,
    const float *SE3_RESTRICT x,
    const float *SE3_RESTRICT mu,
    const float *SE3_RESTRICT W,
    const float *SE3_RESTRICT amplitude,
    float *SE3_RESTRICT value_out,
    float *SE3_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) se3_splat_f(x + 7 * i, mu + 7 * i, W + 36 * i, amplitude[i], value_out + i, gradient_out + 6 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void se3_frame_f(const float *SE3_RESTRICT p, float *SE3_RESTRICT frame) {
    float left[7][6];
    for (int i = 0; i < 7; ++i) {
        float axis[7];
        for (int j = 0; j < 7; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        se3_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 6; ++row) {
        float *e = frame + 6 * row;
        int longest = 0;
        for (int i = 1; i < 7; ++i)
            if (se3_norm_f(p, left[i]) > se3_norm_f(p, left[longest])) longest = i;
        const float length = se3_norm_f(p, left[longest]);
        for (int j = 0; j < 6; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 7; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 7];
            const float part = se3_inner_f(p, e, rest);
            for (int j = 0; j < 6; ++j) rest[j] -= part * e[j];
        }
    }
}
