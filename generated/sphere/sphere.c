/*
 * sphere: The sphere S^n as unit vectors of R^(n+1); distances are angles in radians, times the radius.
 *
 * See the header for what the functions promise.
 */

#include "sphere.h"

#include <float.h>

/* Of degree 7 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_cos_norm_v_near(double x) {
    return 1.0 + x * (-0.4951964999999998 + x * (0.040869928935371204 + x * (-0.0013492430509063418 + x *
        (2.386215832835464e-05 + x * (-2.6258769338145326e-07 + x * (1.9699011755063933e-09 + x *
        -1.0543922273218809e-11))))));
}

/* Of degree 7 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_sinc_norm_v_near(double x) {
    return 1.0 + x * (-0.16506549999999998 + x * (0.008173985787074777 + x * (-0.00019274900727486046 + x *
        (2.6513509314873062e-06 + x * (-2.3871616416234012e-08 + x * (1.5153609321464116e-10 + x *
        -7.043102821193199e-13))))));
}

/* Of degree 14 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_t_over_norm_w_near(double x) {
    return 1.0 + x * (0.1662524999999975 + x * (0.033167872507672114 + x * (0.0070897393547985224 + x *
        (0.0015715825913113733 + x * (0.00035628967365586723 + x * (8.201983320917496e-05 + x *
        (1.907670567869169e-05 + x * (4.515955030924914e-06 + x * (9.891104407795466e-07 + x *
        (3.4857725787739116e-07 + x * (-3.572738831505148e-08 + x * (7.823058427560213e-08 + x *
        (-2.320706538769562e-08 + x * 6.513842453315236e-09)))))))))))));
}

/* Of degree 14 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_log_det_series(double x) {
    return 0.16666666666666666 + x * (0.01939612499999991 + x * (0.0031149721534882713 + x *
        (0.0005700237971008779 + x * (0.00011198187163070022 + x * (2.3002110017289655e-05 + x *
        (4.8718356693444944e-06 + x * (1.054614402260622e-06 + x * (2.3367541929114962e-07 + x *
        (4.9403202372983336e-08 + x * (1.5182298751247572e-08 + x * (-7.6195098574637e-10 + x *
        (2.9042189576467986e-09 + x * (-8.192556206837465e-10 + x * 2.390653866184623e-10)))))))))))));
}

/* Of degree 13 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_log_det_series_slope(double x) {
    return 0.01939612499999991 + x * (0.0062299443069765426 + x * (0.0017100713913026338 + x *
        (0.00044792748652280087 + x * (0.00011501055008644827 + x * (2.9231014016066968e-05 + x *
        (7.382300815824355e-06 + x * (1.869403354329197e-06 + x * (4.4462882135685005e-07 + x *
        (1.5182298751247571e-07 + x * (-8.38146084321007e-09 + x * (3.485062749176158e-08 + x *
        (-1.0650323068888705e-08 + x * 3.346915412658472e-09))))))))))));
}

/* Of degree 13 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_t_over_norm_w_near_slope(double x) {
    return 0.1662524999999975 + x * (0.06633574501534423 + x * (0.021269218064395565 + x *
        (0.006286330365245493 + x * (0.0017814483682793362 + x * (0.0004921189992550497 + x *
        (0.00013353693975084183 + x * (3.6127640247399315e-05 + x * (8.901993967015918e-06 + x *
        (3.485772578773912e-06 + x * (-3.930012714655663e-07 + x * (9.387670113072255e-07 + x *
        (-3.016918500400431e-07 + x * 9.119379434641331e-08))))))))))));
}

/* p / norm(p) */
void sphere_project(const double *SPHERE_RESTRICT x, double *SPHERE_RESTRICT p_out) {
    const double norm_p_squared = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    const double norm_p = sqrt(norm_p_squared);
    const double scale = 1.0 / norm_p;
    const double p0 = x[0] * scale;
    const double p1 = x[1] * scale;
    const double p2 = x[2] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
}

void sphere_project_batch(size_t count, const double *SPHERE_RESTRICT x, double *SPHERE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) sphere_project(x + 3 * i, p_out + 3 * i);
}

/* x - N (dc N)^-1 dc x */
void sphere_to_tangent(
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT x,
    double *SPHERE_RESTRICT v_out) {
    const double normal_part = p[0] * x[0] + p[1] * x[1] + p[2] * x[2];
    const double v0 = x[0] - p[0] * normal_part;
    const double v1 = x[1] - p[1] * normal_part;
    const double v2 = x[2] - p[2] * normal_part;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void sphere_to_tangent_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT x,
    double *SPHERE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) sphere_to_tangent(p + 3 * i, x + 3 * i, v_out + 3 * i);
}

/* dot(u, v) */
double sphere_inner(
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT u,
    const double *SPHERE_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void sphere_inner_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT u,
    const double *SPHERE_RESTRICT v,
    double *SPHERE_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = sphere_inner(p + 3 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(<v, v>_p) */
double sphere_norm(const double *SPHERE_RESTRICT p, const double *SPHERE_RESTRICT v) {
    (void)p;
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void sphere_norm_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT v,
    double *SPHERE_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = sphere_norm(p + 3 * i, v + 3 * i);
}

/* G(p) v */
void sphere_flat(
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT v,
    double *SPHERE_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void sphere_flat_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT v,
    double *SPHERE_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) sphere_flat(p + 3 * i, v + 3 * i, covector_out + 3 * i);
}

/* cos(norm(v)) * p + sinc(norm(v)) * v */
void sphere_exp(
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT v,
    double *SPHERE_RESTRICT q_out) {
    const double norm_v_squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const int near = norm_v_squared < 0.990393;
    const double near_chosen = (near ? 1.0097001897226656 * norm_v_squared : 0.0);
    const double cos_norm_v_near = polynomial_cos_norm_v_near(near_chosen);
    const double norm_v = sqrt((near ? 1.0 : norm_v_squared));
    const double cos_norm_v = (near ? cos_norm_v_near : cos(norm_v));
    const double sinc_norm_v_near = polynomial_sinc_norm_v_near(near_chosen);
    const double sinc_norm_v = (near ? sinc_norm_v_near : sin(norm_v) / norm_v);
    const double q0 = p[0] * cos_norm_v + v[0] * sinc_norm_v;
    const double q1 = p[1] * cos_norm_v + v[1] * sinc_norm_v;
    const double q2 = p[2] * cos_norm_v + v[2] * sinc_norm_v;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
}

void sphere_exp_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT v,
    double *SPHERE_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) sphere_exp(p + 3 * i, v + 3 * i, q_out + 3 * i);
}

/* t * w / norm(w) */
void sphere_log(
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT q,
    double *SPHERE_RESTRICT v_out) {
    const double q_plus_p0 = p[0] + q[0];
    const double q_plus_p1 = p[1] + q[1];
    const double q_plus_p2 = p[2] + q[2];
    const double norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 *
        q_plus_p2;
    const double norm_q_plus_p = sqrt(norm_q_plus_p_squared);
    const double squared = p[0] * p[0];
    const double gap = 1.0 - squared;
    const double gap_2 = 1.0 - p[1] * p[1];
    const int on_cut_locus = norm_q_plus_p <= 4.0 * DBL_EPSILON;
    const double q0_off_cut = (on_cut_locus ? p[0] : q[0]);
    const double q1_off_cut = (on_cut_locus ? p[1] : q[1]);
    const double q2_off_cut = (on_cut_locus ? p[2] : q[2]);
    const double d0 = q0_off_cut - p[0];
    const double d1 = q1_off_cut - p[1];
    const double d2 = q2_off_cut - p[2];
    const double norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
    const double q_plus_p0_2 = p[0] + q0_off_cut;
    const double q_plus_p1_2 = p[1] + q1_off_cut;
    const double q_plus_p2_2 = p[2] + q2_off_cut;
    const double norm_q_plus_p_squared_2 = q_plus_p0_2 * q_plus_p0_2 + q_plus_p1_2 * q_plus_p1_2 + q_plus_p2_2
        * q_plus_p2_2;
    const double norm_q_plus_p_2 = sqrt(norm_q_plus_p_squared_2);
    const double dot_p_q = p[0] * q0_off_cut + p[1] * q1_off_cut + p[2] * q2_off_cut;
    const int is_small = dot_p_q < 0.0;
    const double e0 = (is_small ? q_plus_p0_2 : d0);
    const double e1 = (is_small ? q_plus_p1_2 : d1);
    const double e2 = (is_small ? q_plus_p2_2 : d2);
    const double dot_p_e = p[0] * e0 + p[1] * e1 + p[2] * e2;
    const double w0 = e0 - p[0] * dot_p_e;
    const double w1 = e1 - p[1] * dot_p_e;
    const double w2 = e2 - p[2] * dot_p_e;
    const double norm_w_squared = w0 * w0 + w1 * w1 + w2 * w2;
    const int near = norm_d_squared < 0.997515;
    const double t_over_norm_w_near = polynomial_t_over_norm_w_near((near ? 1.0024911906086624 *
        norm_d_squared : 0.0));
    const double norm_d = sqrt((near ? 1.0 : norm_d_squared));
    const double atan2_value = atan2(norm_d, norm_q_plus_p_2);
    const double t = 2.0 * atan2_value;
    const double norm_w = sqrt((near ? 1.0 : norm_w_squared));
    const double t_over_norm_w = (near ? t_over_norm_w_near : t / norm_w);
    const int is_small_2 = squared < 0.5;
    const double sine_to_axis0 = sqrt((is_small_2 ? gap : 1.0));
    const double product = p[0] * p[1];
    const double sine_to_axis1 = sqrt((is_small_2 ? 1.0 : gap_2));
    const double v0 = (on_cut_locus ? 3.141592653589793 * (is_small_2 ? gap / sine_to_axis0 : -(product /
        sine_to_axis1)) : w0 * t_over_norm_w);
    const double v1 = (on_cut_locus ? 3.141592653589793 * (is_small_2 ? -(product / sine_to_axis0) : gap_2 /
        sine_to_axis1) : w1 * t_over_norm_w);
    const double product_2 = 3.141592653589793 * (is_small_2 ? -(p[0] * p[2] / sine_to_axis0) : -(p[1] * p[2]
        / sine_to_axis1));
    const double v2 = (on_cut_locus ? product_2 : w2 * t_over_norm_w);
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void sphere_log_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT q,
    double *SPHERE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) sphere_log(p + 3 * i, q + 3 * i, v_out + 3 * i);
}

/* t */
double sphere_distance(const double *SPHERE_RESTRICT p, const double *SPHERE_RESTRICT q) {
    const double d0 = q[0] - p[0];
    const double d1 = q[1] - p[1];
    const double d2 = q[2] - p[2];
    const double norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
    const double norm_d = sqrt(norm_d_squared);
    const double q_plus_p0 = p[0] + q[0];
    const double q_plus_p1 = p[1] + q[1];
    const double q_plus_p2 = p[2] + q[2];
    const double norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 *
        q_plus_p2;
    const double norm_q_plus_p = sqrt(norm_q_plus_p_squared);
    const double atan2_value = atan2(norm_d, norm_q_plus_p);
    const double t = 2.0 * atan2_value;
    return t;
}

void sphere_distance_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT q,
    double *SPHERE_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = sphere_distance(p + 3 * i, q + 3 * i);
}

/* log(t_over_norm_w) */
double sphere_log_abs_det(const double *SPHERE_RESTRICT p, const double *SPHERE_RESTRICT q) {
    const double q_plus_p0 = p[0] + q[0];
    const double q_plus_p1 = p[1] + q[1];
    const double q_plus_p2 = p[2] + q[2];
    const double norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 *
        q_plus_p2;
    const double norm_q_plus_p = sqrt(norm_q_plus_p_squared);
    const double log_value = log(0.7853981633974483 / DBL_EPSILON);
    const int on_cut_locus = norm_q_plus_p <= 4.0 * DBL_EPSILON;
    const double q0_off_cut = (on_cut_locus ? p[0] : q[0]);
    const double q1_off_cut = (on_cut_locus ? p[1] : q[1]);
    const double q2_off_cut = (on_cut_locus ? p[2] : q[2]);
    const double d0 = q0_off_cut - p[0];
    const double d1 = q1_off_cut - p[1];
    const double d2 = q2_off_cut - p[2];
    const double norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
    const double q_plus_p0_2 = p[0] + q0_off_cut;
    const double q_plus_p1_2 = p[1] + q1_off_cut;
    const double q_plus_p2_2 = p[2] + q2_off_cut;
    const double norm_q_plus_p_squared_2 = q_plus_p0_2 * q_plus_p0_2 + q_plus_p1_2 * q_plus_p1_2 + q_plus_p2_2
        * q_plus_p2_2;
    const double norm_q_plus_p_2 = sqrt(norm_q_plus_p_squared_2);
    const double dot_p_q = p[0] * q0_off_cut + p[1] * q1_off_cut + p[2] * q2_off_cut;
    const int is_small = dot_p_q < 0.0;
    const double e0 = (is_small ? q_plus_p0_2 : d0);
    const double e1 = (is_small ? q_plus_p1_2 : d1);
    const double e2 = (is_small ? q_plus_p2_2 : d2);
    const double dot_p_e = p[0] * e0 + p[1] * e1 + p[2] * e2;
    const double w0 = e0 - p[0] * dot_p_e;
    const double w1 = e1 - p[1] * dot_p_e;
    const double w2 = e2 - p[2] * dot_p_e;
    const double norm_w_squared = w0 * w0 + w1 * w1 + w2 * w2;
    const int near = norm_d_squared < 0.997515;
    const double norm_d = sqrt((near ? 1.0 : norm_d_squared));
    const double atan2_value = atan2(norm_d, norm_q_plus_p_2);
    const double t = 2.0 * atan2_value;
    const double norm_w = sqrt((near ? 1.0 : norm_w_squared));
    const double log_det_series = polynomial_log_det_series((near ? 1.0024911906086624 * norm_d_squared :
        0.0));
    const double log_det_near = norm_d_squared * log_det_series;
    const double log_det = (near ? log_det_near : log(t / norm_w));
    return (on_cut_locus ? log_value : log_det);
}

void sphere_log_abs_det_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT q,
    double *SPHERE_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = sphere_log_abs_det(p + 3 * i, q + 3 * i);
}

/* the tangential part of G^-1 df */
void sphere_riemannian_gradient(
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT df,
    double *SPHERE_RESTRICT gradient_out) {
    const double normal_part = p[0] * df[0] + p[1] * df[1] + p[2] * df[2];
    const double gradient0 = df[0] - p[0] * normal_part;
    const double gradient1 = df[1] - p[1] * normal_part;
    const double gradient2 = df[2] - p[2] * normal_part;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void sphere_riemannian_gradient_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT df,
    double *SPHERE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) sphere_riemannian_gradient(p + 3 * i, df + 3 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
double sphere_gradient_norm(const double *SPHERE_RESTRICT p, const double *SPHERE_RESTRICT df) {
    const double normal_part = p[0] * df[0] + p[1] * df[1] + p[2] * df[2];
    const double gradient0 = df[0] - p[0] * normal_part;
    const double gradient1 = df[1] - p[1] * normal_part;
    const double gradient2 = df[2] - p[2] * normal_part;
    return sqrt(gradient0 * gradient0 + gradient1 * gradient1 + gradient2 * gradient2);
}

void sphere_gradient_norm_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT df,
    double *SPHERE_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = sphere_gradient_norm(p + 3 * i, df + 3 * i);
}

/* where(norm(s) <= 4 * eps, v - 2 * dot(orthogonal(p), v) * orthogonal(p), v - 2 * dot(s, v) / [...] */
void sphere_transport(
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT q,
    const double *SPHERE_RESTRICT v,
    double *SPHERE_RESTRICT w_out) {
    const double q_plus_p0 = p[0] + q[0];
    const double q_plus_p1 = p[1] + q[1];
    const double q_plus_p2 = p[2] + q[2];
    const double norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 *
        q_plus_p2;
    const double norm_q_plus_p = sqrt(norm_q_plus_p_squared);
    const double squared = p[0] * p[0];
    const double gap = 1.0 - squared;
    const double gap_2 = 1.0 - p[1] * p[1];
    const int is_small = squared < 0.5;
    const double product = p[0] * p[1];
    const double dot_s_v = v[0] * q_plus_p0 + v[1] * q_plus_p1 + v[2] * q_plus_p2;
    const int is_less_equal = norm_q_plus_p <= 4.0 * DBL_EPSILON;
    const double sine_to_axis0 = sqrt((is_less_equal ? (is_small ? gap : 1.0) : 1.0));
    const double sine_to_axis1 = sqrt((is_less_equal ? (is_small ? 1.0 : gap_2) : 1.0));
    const double orthogonal_p0 = (is_small ? gap / sine_to_axis0 : -(product / sine_to_axis1));
    const double orthogonal_p1 = (is_small ? -(product / sine_to_axis0) : gap_2 / sine_to_axis1);
    const double orthogonal_p2 = (is_small ? -(p[0] * p[2] / sine_to_axis0) : -(p[1] * p[2] / sine_to_axis1));
    const double dot_orthogonal_p_v = v[0] * orthogonal_p0 + v[1] * orthogonal_p1 + v[2] * orthogonal_p2;
    const double scale = 2.0 * dot_orthogonal_p_v;
    const double scale_2 = 2.0 * dot_s_v / (is_less_equal ? 1.0 : norm_q_plus_p_squared);
    const double w0 = (is_less_equal ? v[0] - orthogonal_p0 * scale : v[0] - q_plus_p0 * scale_2);
    const double w1 = (is_less_equal ? v[1] - orthogonal_p1 * scale : v[1] - q_plus_p1 * scale_2);
    const double w2 = (is_less_equal ? v[2] - orthogonal_p2 * scale : v[2] - q_plus_p2 * scale_2);
    w_out[0] = w0;
    w_out[1] = w1;
    w_out[2] = w2;
}

void sphere_transport_batch(
    size_t count,
    const double *SPHERE_RESTRICT p,
    const double *SPHERE_RESTRICT q,
    const double *SPHERE_RESTRICT v,
    double *SPHERE_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) sphere_transport(p + 3 * i, q + 3 * i, v + 3 * i, w_out + 3 * i);
}

/* normal / norm(normal) */
void sphere_sample(
    const double *SPHERE_RESTRICT normal,
    const double *SPHERE_RESTRICT uniform,
    double *SPHERE_RESTRICT p_out) {
    (void)uniform;
    const double norm_normal_squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    const double norm_normal = sqrt(norm_normal_squared);
    const double scale = 1.0 / norm_normal;
    const double p0 = normal[0] * scale;
    const double p1 = normal[1] * scale;
    const double p2 = normal[2] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
}

void sphere_sample_batch(
    size_t count,
    const double *SPHERE_RESTRICT normal,
    const double *SPHERE_RESTRICT uniform,
    double *SPHERE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) sphere_sample(normal + 3 * i, uniform + 3 * i, p_out + 3 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void sphere_splat(
    const double *SPHERE_RESTRICT x,
    const double *SPHERE_RESTRICT mu,
    const double *SPHERE_RESTRICT W,
    double amplitude,
    double *SPHERE_RESTRICT value_out,
    double *SPHERE_RESTRICT gradient_out) {
    const double q_plus_p0 = x[0] + mu[0];
    const double q_plus_p1 = x[1] + mu[1];
    const double q_plus_p2 = x[2] + mu[2];
    const double norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 *
        q_plus_p2;
    const double norm_q_plus_p = sqrt(norm_q_plus_p_squared);
    const double squared = mu[0] * mu[0];
    const double gap = 1.0 - squared;
    const double gap_2 = 1.0 - mu[1] * mu[1];
    const int on_cut_locus = norm_q_plus_p <= 4.0 * DBL_EPSILON;
    const double q0_off_cut = (on_cut_locus ? mu[0] : x[0]);
    const double q1_off_cut = (on_cut_locus ? mu[1] : x[1]);
    const double q2_off_cut = (on_cut_locus ? mu[2] : x[2]);
    const double d0 = q0_off_cut - mu[0];
    const double d1 = q1_off_cut - mu[1];
    const double d2 = q2_off_cut - mu[2];
    const double norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
    const double q_plus_p0_2 = mu[0] + q0_off_cut;
    const double q_plus_p1_2 = mu[1] + q1_off_cut;
    const double q_plus_p2_2 = mu[2] + q2_off_cut;
    const double norm_q_plus_p_squared_2 = q_plus_p0_2 * q_plus_p0_2 + q_plus_p1_2 * q_plus_p1_2 + q_plus_p2_2
        * q_plus_p2_2;
    const double norm_q_plus_p_2 = sqrt(norm_q_plus_p_squared_2);
    const double dot_p_q = mu[0] * q0_off_cut + mu[1] * q1_off_cut + mu[2] * q2_off_cut;
    const int is_small = dot_p_q < 0.0;
    const double e0 = (is_small ? q_plus_p0_2 : d0);
    const double e1 = (is_small ? q_plus_p1_2 : d1);
    const double e2 = (is_small ? q_plus_p2_2 : d2);
    const double dot_p_e = mu[0] * e0 + mu[1] * e1 + mu[2] * e2;
    const double w0 = e0 - mu[0] * dot_p_e;
    const double w1 = e1 - mu[1] * dot_p_e;
    const double w2 = e2 - mu[2] * dot_p_e;
    const double norm_w_squared = w0 * w0 + w1 * w1 + w2 * w2;
    const int near = norm_d_squared < 0.997515;
    const double near_chosen = (near ? 1.0024911906086624 * norm_d_squared : 0.0);
    const double t_over_norm_w_near = polynomial_t_over_norm_w_near(near_chosen);
    const double near_chosen_2 = (near ? 1.0 : norm_d_squared);
    const double norm_d = sqrt(near_chosen_2);
    const double atan2_value = atan2(norm_d, norm_q_plus_p_2);
    const double t = 2.0 * atan2_value;
    const double norm_w = sqrt((near ? 1.0 : norm_w_squared));
    const double t_ratio = t / norm_w;
    const double t_over_norm_w = (near ? t_over_norm_w_near : t_ratio);
    const int is_small_2 = squared < 0.5;
    const double sine_to_axis0 = sqrt((is_small_2 ? gap : 1.0));
    const double product = mu[0] * mu[1];
    const double sine_to_axis1 = sqrt((is_small_2 ? 1.0 : gap_2));
    const double v0 = (on_cut_locus ? 3.141592653589793 * (is_small_2 ? gap / sine_to_axis0 : -(product /
        sine_to_axis1)) : w0 * t_over_norm_w);
    const double v1 = (on_cut_locus ? 3.141592653589793 * (is_small_2 ? -(product / sine_to_axis0) : gap_2 /
        sine_to_axis1) : w1 * t_over_norm_w);
    const double product_2 = 3.141592653589793 * (is_small_2 ? -(mu[0] * mu[2] / sine_to_axis0) : -(mu[1] *
        mu[2] / sine_to_axis1));
    const double v2 = (on_cut_locus ? product_2 : w2 * t_over_norm_w);
    const double log_value = log(0.7853981633974483 / DBL_EPSILON);
    const double log_det_series = polynomial_log_det_series(near_chosen);
    const double log_det_near = norm_d_squared * log_det_series;
    const double log_det = (near ? log_det_near : log(t_ratio));
    const double z0 = W[0] * v0 + W[1] * v1 + W[2] * v2;
    const double z1 = W[3] * v0 + W[4] * v1 + W[5] * v2;
    const double exp_2 = exp((on_cut_locus ? log_value : log_det) - 0.5 * (z0 * z0 + z1 * z1));
    const double phi = amplitude * exp_2;
    const double by_v2 = -(W[5] * z1) - W[2] * z0;
    const double by_v1 = -(W[4] * z1) - W[1] * z0;
    const double by_v0 = -(W[3] * z1) - W[0] * z0;
    const double by_log_det = (on_cut_locus ? 0.0 : 1.0);
    const double by_log_det_near = (near ? by_log_det : 0.0);
    const double by_log_det_series = norm_d_squared * by_log_det_near;
    const double log_det_series_slope = polynomial_log_det_series_slope(near_chosen);
    const double chosen = (on_cut_locus ? 0.0 : by_v2);
    const double chosen_2 = (on_cut_locus ? 0.0 : by_v1);
    const double chosen_3 = (on_cut_locus ? 0.0 : by_v0);
    const double by_t_over_norm_w = w2 * chosen + w1 * chosen_2 + w0 * chosen_3;
    const double by_t_over_norm_w_near = (near ? by_t_over_norm_w : 0.0);
    const double by_t = ((near ? 0.0 : by_log_det) / t_ratio + (near ? 0.0 : by_t_over_norm_w)) / norm_w;
    const double by_norm_w_squared = (near ? 0.0 : -(t_ratio * by_t / (2.0 * norm_w)));
    const double by_atan2_value = 2.0 * by_t;
    const double ratio = by_atan2_value / (norm_q_plus_p_squared_2 + near_chosen_2);
    const double by_norm_d = norm_q_plus_p_2 * ratio;
    const double t_over_norm_w_near_slope = polynomial_t_over_norm_w_near_slope(near_chosen);
    const double by_norm_d_squared = log_det_series * by_log_det_near + (near ? 0.0 : by_norm_d / (2.0 *
        norm_d)) + 1.0024911906086624 * (near ? by_log_det_series * log_det_series_slope +
        by_t_over_norm_w_near * t_over_norm_w_near_slope : 0.0);
    const double product_3 = 2.0 * by_norm_w_squared;
    const double by_w2 = t_over_norm_w * chosen + w2 * product_3;
    const double by_w1 = t_over_norm_w * chosen_2 + w1 * product_3;
    const double by_w0 = t_over_norm_w * chosen_3 + w0 * product_3;
    const double by_dot_p_e = -(mu[2] * by_w2) - mu[1] * by_w1 - mu[0] * by_w0;
    const double by_e2 = by_w2 + mu[2] * by_dot_p_e;
    const double by_e1 = by_w1 + mu[1] * by_dot_p_e;
    const double by_e0 = by_w0 + mu[0] * by_dot_p_e;
    const int is_small_3 = norm_q_plus_p_squared_2 == 0.0;
    const double by_norm_q_plus_p_squared_2 = (is_small_3 ? 0.0 : -(norm_d * ratio / (2.0 * (is_small_3 ? 1.0
        : norm_q_plus_p_2))));
    const double product_4 = 2.0 * by_norm_q_plus_p_squared_2;
    const double by_q_plus_p2_2 = (is_small ? by_e2 : 0.0) + q_plus_p2_2 * product_4;
    const double by_q_plus_p1_2 = (is_small ? by_e1 : 0.0) + q_plus_p1_2 * product_4;
    const double by_q_plus_p0_2 = (is_small ? by_e0 : 0.0) + q_plus_p0_2 * product_4;
    const double product_5 = 2.0 * by_norm_d_squared;
    const double by_d2 = (is_small ? 0.0 : by_e2) + d2 * product_5;
    const double by_d1 = (is_small ? 0.0 : by_e1) + d1 * product_5;
    const double by_d0 = (is_small ? 0.0 : by_e0) + d0 * product_5;
    const double by_q2_off_cut = by_q_plus_p2_2 + by_d2;
    const double by_q1_off_cut = by_q_plus_p1_2 + by_d1;
    const double by_q0_off_cut = by_q_plus_p0_2 + by_d0;
    const double exponent_by_x2 = (on_cut_locus ? 0.0 : by_q2_off_cut);
    const double exponent_by_x1 = (on_cut_locus ? 0.0 : by_q1_off_cut);
    const double exponent_by_x0 = (on_cut_locus ? 0.0 : by_q0_off_cut);
    const double df0 = phi * exponent_by_x0;
    const double df1 = phi * exponent_by_x1;
    const double df2 = phi * exponent_by_x2;
    const double normal_part = x[0] * df0 + x[1] * df1 + x[2] * df2;
    const double gradient0 = df0 - x[0] * normal_part;
    const double gradient1 = df1 - x[1] * normal_part;
    const double gradient2 = df2 - x[2] * normal_part;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void sphere_splat_batch(
    size_t count,
    const double *SPHERE_RESTRICT x,
    const double *SPHERE_RESTRICT mu,
    const double *SPHERE_RESTRICT W,
    const double *SPHERE_RESTRICT amplitude,
    double *SPHERE_RESTRICT value_out,
    double *SPHERE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) sphere_splat(x + 3 * i, mu + 3 * i, W + 6 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void sphere_frame(const double *SPHERE_RESTRICT p, double *SPHERE_RESTRICT frame) {
    double left[3][3];
    for (int i = 0; i < 3; ++i) {
        double axis[3];
        for (int j = 0; j < 3; ++j) axis[j] = i == j ? 1.0 : 0.0;
        sphere_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        double *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 3; ++i)
            if (sphere_norm(p, left[i]) > sphere_norm(p, left[longest])) longest = i;
        const double length = sphere_norm(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 3; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 3];
            const double part = sphere_inner(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}

/* Of degree 4, within 2^-30 of that of double precision. */
static inline float polynomial_cos_norm_v_near_f(float x) {
    return 0.9999999994976135f + x * (-0.49519647485985047f + x * (0.040869727563992035f + x *
        (-0.0013486780417677447f + x * 2.3213754968692044e-05f)));
}

/* Of degree 4, within 2^-34 of that of double precision. */
static inline float polynomial_sinc_norm_v_near_f(float x) {
    return 0.999999999954183f + x * (-0.1650654977075424f + x * (0.008173967428130452f + x *
        (-0.00019269751212383233f + x * 2.592292971066502e-06f)));
}

/* Of degree 6, within 2^-27 of that of double precision. */
static inline float polynomial_t_over_norm_w_near_f(float x) {
    return 1.00000000619894f + x * (0.16625190413032676f + x * (0.03317716716973815f + x *
        (0.007035890983780297f + x * (0.0017176917798953461f + x * (0.00015939746442501272f + x *
        0.00020289529759782475f)))));
}

/* Of degree 6, within 2^-28 of that of double precision. */
static inline float polynomial_log_det_series_f(float x) {
    return 0.16666666698842558f + x * (0.01939609403553286f + x * (0.003115455875791959f + x *
        (0.0005672156396303965f + x * (0.00011962406701481749f + x * (1.265383663821544e-05f + x *
        1.1287063796917841e-05f)))));
}

/* Of degree 7, within 2^-28 of that of double precision. */
static inline float polynomial_log_det_series_slope_f(float x) {
    return 0.019396124953314112f + x * (0.006229950177086295f + x * (0.0017099508786384825f + x *
        (0.0004488633398675725f + x * (0.00011148142766242262f + x * (3.631933110632547e-05f + x *
        (-2.054050626290468e-07f + x * 5.692314108989995e-06f))))));
}

/* Of degree 7, within 2^-27 of that of double precision. */
static inline float polynomial_t_over_norm_w_near_slope_f(float x) {
    return 0.166252498983116f + x * (0.06633587276024193f + x * (0.02126659841817475f + x *
        (0.006306643891312201f + x * (0.0017049970358088175f + x * (0.0006452315929490522f + x *
        (-2.9591250849232477e-05f + x * 0.0001174958124774389f))))));
}

/* p / norm(p) */
void sphere_project_f(const float *SPHERE_RESTRICT x, float *SPHERE_RESTRICT p_out) {
    const float norm_p_squared = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    const float norm_p = sqrtf(norm_p_squared);
    const float scale = 1.0f / norm_p;
    const float p0 = x[0] * scale;
    const float p1 = x[1] * scale;
    const float p2 = x[2] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
}

void sphere_project_batch_f(size_t count, const float *SPHERE_RESTRICT x, float *SPHERE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) sphere_project_f(x + 3 * i, p_out + 3 * i);
}

/* x - N (dc N)^-1 dc x */
void sphere_to_tangent_f(
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT x,
    float *SPHERE_RESTRICT v_out) {
    const float normal_part = p[0] * x[0] + p[1] * x[1] + p[2] * x[2];
    const float v0 = x[0] - p[0] * normal_part;
    const float v1 = x[1] - p[1] * normal_part;
    const float v2 = x[2] - p[2] * normal_part;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void sphere_to_tangent_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT x,
    float *SPHERE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) sphere_to_tangent_f(p + 3 * i, x + 3 * i, v_out + 3 * i);
}

/* dot(u, v) */
float sphere_inner_f(
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT u,
    const float *SPHERE_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void sphere_inner_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT u,
    const float *SPHERE_RESTRICT v,
    float *SPHERE_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = sphere_inner_f(p + 3 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(<v, v>_p) */
float sphere_norm_f(const float *SPHERE_RESTRICT p, const float *SPHERE_RESTRICT v) {
    (void)p;
    return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void sphere_norm_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT v,
    float *SPHERE_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = sphere_norm_f(p + 3 * i, v + 3 * i);
}

/* G(p) v */
void sphere_flat_f(
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT v,
    float *SPHERE_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void sphere_flat_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT v,
    float *SPHERE_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) sphere_flat_f(p + 3 * i, v + 3 * i, covector_out + 3 * i);
}

/* cos(norm(v)) * p + sinc(norm(v)) * v */
void sphere_exp_f(
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT v,
    float *SPHERE_RESTRICT q_out) {
    const float norm_v_squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const int near = norm_v_squared < 0.990393f;
    const float near_chosen = (near ? 1.0097001897226656f * norm_v_squared : 0.0f);
    const float cos_norm_v_near = polynomial_cos_norm_v_near_f(near_chosen);
    const float norm_v = sqrtf((near ? 1.0f : norm_v_squared));
    const float cos_norm_v = (near ? cos_norm_v_near : cosf(norm_v));
    const float sinc_norm_v_near = polynomial_sinc_norm_v_near_f(near_chosen);
    const float sinc_norm_v = (near ? sinc_norm_v_near : sinf(norm_v) / norm_v);
    const float q0 = p[0] * cos_norm_v + v[0] * sinc_norm_v;
    const float q1 = p[1] * cos_norm_v + v[1] * sinc_norm_v;
    const float q2 = p[2] * cos_norm_v + v[2] * sinc_norm_v;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
}

void sphere_exp_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT v,
    float *SPHERE_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) sphere_exp_f(p + 3 * i, v + 3 * i, q_out + 3 * i);
}

/* t * w / norm(w) */
void sphere_log_f(
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT q,
    float *SPHERE_RESTRICT v_out) {
    const float q_plus_p0 = p[0] + q[0];
    const float q_plus_p1 = p[1] + q[1];
    const float q_plus_p2 = p[2] + q[2];
    const float norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 * q_plus_p2;
    const float norm_q_plus_p = sqrtf(norm_q_plus_p_squared);
    const float squared = p[0] * p[0];
    const float gap = 1.0f - squared;
    const float gap_2 = 1.0f - p[1] * p[1];
    const int on_cut_locus = norm_q_plus_p <= 4.0f * FLT_EPSILON;
    const float q0_off_cut = (on_cut_locus ? p[0] : q[0]);
    const float q1_off_cut = (on_cut_locus ? p[1] : q[1]);
    const float q2_off_cut = (on_cut_locus ? p[2] : q[2]);
    const float d0 = q0_off_cut - p[0];
    const float d1 = q1_off_cut - p[1];
    const float d2 = q2_off_cut - p[2];
    const float norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
    const float q_plus_p0_2 = p[0] + q0_off_cut;
    const float q_plus_p1_2 = p[1] + q1_off_cut;
    const float q_plus_p2_2 = p[2] + q2_off_cut;
    const float norm_q_plus_p_squared_2 = q_plus_p0_2 * q_plus_p0_2 + q_plus_p1_2 * q_plus_p1_2 + q_plus_p2_2
        * q_plus_p2_2;
    const float norm_q_plus_p_2 = sqrtf(norm_q_plus_p_squared_2);
    const float dot_p_q = p[0] * q0_off_cut + p[1] * q1_off_cut + p[2] * q2_off_cut;
    const int is_small = dot_p_q < 0.0f;
    const float e0 = (is_small ? q_plus_p0_2 : d0);
    const float e1 = (is_small ? q_plus_p1_2 : d1);
    const float e2 = (is_small ? q_plus_p2_2 : d2);
    const float dot_p_e = p[0] * e0 + p[1] * e1 + p[2] * e2;
    const float w0 = e0 - p[0] * dot_p_e;
    const float w1 = e1 - p[1] * dot_p_e;
    const float w2 = e2 - p[2] * dot_p_e;
    const float norm_w_squared = w0 * w0 + w1 * w1 + w2 * w2;
    const int near = norm_d_squared < 0.997515f;
    const float t_over_norm_w_near = polynomial_t_over_norm_w_near_f((near ? 1.0024911906086624f *
        norm_d_squared : 0.0f));
    const float norm_d = sqrtf((near ? 1.0f : norm_d_squared));
    const float atan2_value = atan2f(norm_d, norm_q_plus_p_2);
    const float t = 2.0f * atan2_value;
    const float norm_w = sqrtf((near ? 1.0f : norm_w_squared));
    const float t_over_norm_w = (near ? t_over_norm_w_near : t / norm_w);
    const int is_small_2 = squared < 0.5f;
    const float sine_to_axis0 = sqrtf((is_small_2 ? gap : 1.0f));
    const float product = p[0] * p[1];
    const float sine_to_axis1 = sqrtf((is_small_2 ? 1.0f : gap_2));
    const float v0 = (on_cut_locus ? 3.141592653589793f * (is_small_2 ? gap / sine_to_axis0 : -(product /
        sine_to_axis1)) : w0 * t_over_norm_w);
    const float v1 = (on_cut_locus ? 3.141592653589793f * (is_small_2 ? -(product / sine_to_axis0) : gap_2 /
        sine_to_axis1) : w1 * t_over_norm_w);
    const float product_2 = 3.141592653589793f * (is_small_2 ? -(p[0] * p[2] / sine_to_axis0) : -(p[1] * p[2]
        / sine_to_axis1));
    const float v2 = (on_cut_locus ? product_2 : w2 * t_over_norm_w);
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void sphere_log_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT q,
    float *SPHERE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) sphere_log_f(p + 3 * i, q + 3 * i, v_out + 3 * i);
}

/* t */
float sphere_distance_f(const float *SPHERE_RESTRICT p, const float *SPHERE_RESTRICT q) {
    const float d0 = q[0] - p[0];
    const float d1 = q[1] - p[1];
    const float d2 = q[2] - p[2];
    const float norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
    const float norm_d = sqrtf(norm_d_squared);
    const float q_plus_p0 = p[0] + q[0];
    const float q_plus_p1 = p[1] + q[1];
    const float q_plus_p2 = p[2] + q[2];
    const float norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 * q_plus_p2;
    const float norm_q_plus_p = sqrtf(norm_q_plus_p_squared);
    const float atan2_value = atan2f(norm_d, norm_q_plus_p);
    const float t = 2.0f * atan2_value;
    return t;
}

void sphere_distance_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT q,
    float *SPHERE_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = sphere_distance_f(p + 3 * i, q + 3 * i);
}

/* log(t_over_norm_w) */
float sphere_log_abs_det_f(const float *SPHERE_RESTRICT p, const float *SPHERE_RESTRICT q) {
    const float q_plus_p0 = p[0] + q[0];
    const float q_plus_p1 = p[1] + q[1];
    const float q_plus_p2 = p[2] + q[2];
    const float norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 * q_plus_p2;
    const float norm_q_plus_p = sqrtf(norm_q_plus_p_squared);
    const float log_value = logf(0.7853981633974483f / FLT_EPSILON);
    const int on_cut_locus = norm_q_plus_p <= 4.0f * FLT_EPSILON;
    const float q0_off_cut = (on_cut_locus ? p[0] : q[0]);
    const float q1_off_cut = (on_cut_locus ? p[1] : q[1]);
    const float q2_off_cut = (on_cut_locus ? p[2] : q[2]);
    const float d0 = q0_off_cut - p[0];
    const float d1 = q1_off_cut - p[1];
    const float d2 = q2_off_cut - p[2];
    const float norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
    const float q_plus_p0_2 = p[0] + q0_off_cut;
    const float q_plus_p1_2 = p[1] + q1_off_cut;
    const float q_plus_p2_2 = p[2] + q2_off_cut;
    const float norm_q_plus_p_squared_2 = q_plus_p0_2 * q_plus_p0_2 + q_plus_p1_2 * q_plus_p1_2 + q_plus_p2_2
        * q_plus_p2_2;
    const float norm_q_plus_p_2 = sqrtf(norm_q_plus_p_squared_2);
    const float dot_p_q = p[0] * q0_off_cut + p[1] * q1_off_cut + p[2] * q2_off_cut;
    const int is_small = dot_p_q < 0.0f;
    const float e0 = (is_small ? q_plus_p0_2 : d0);
    const float e1 = (is_small ? q_plus_p1_2 : d1);
    const float e2 = (is_small ? q_plus_p2_2 : d2);
    const float dot_p_e = p[0] * e0 + p[1] * e1 + p[2] * e2;
    const float w0 = e0 - p[0] * dot_p_e;
    const float w1 = e1 - p[1] * dot_p_e;
    const float w2 = e2 - p[2] * dot_p_e;
    const float norm_w_squared = w0 * w0 + w1 * w1 + w2 * w2;
    const int near = norm_d_squared < 0.997515f;
    const float norm_d = sqrtf((near ? 1.0f : norm_d_squared));
    const float atan2_value = atan2f(norm_d, norm_q_plus_p_2);
    const float t = 2.0f * atan2_value;
    const float norm_w = sqrtf((near ? 1.0f : norm_w_squared));
    const float log_det_series = polynomial_log_det_series_f((near ? 1.0024911906086624f * norm_d_squared :
        0.0f));
    const float log_det_near = norm_d_squared * log_det_series;
    const float log_det = (near ? log_det_near : logf(t / norm_w));
    return (on_cut_locus ? log_value : log_det);
}

void sphere_log_abs_det_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT q,
    float *SPHERE_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = sphere_log_abs_det_f(p + 3 * i, q + 3 * i);
}

/* the tangential part of G^-1 df */
void sphere_riemannian_gradient_f(
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT df,
    float *SPHERE_RESTRICT gradient_out) {
    const float normal_part = p[0] * df[0] + p[1] * df[1] + p[2] * df[2];
    const float gradient0 = df[0] - p[0] * normal_part;
    const float gradient1 = df[1] - p[1] * normal_part;
    const float gradient2 = df[2] - p[2] * normal_part;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void sphere_riemannian_gradient_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT df,
    float *SPHERE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) sphere_riemannian_gradient_f(p + 3 * i, df + 3 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
float sphere_gradient_norm_f(const float *SPHERE_RESTRICT p, const float *SPHERE_RESTRICT df) {
    const float normal_part = p[0] * df[0] + p[1] * df[1] + p[2] * df[2];
    const float gradient0 = df[0] - p[0] * normal_part;
    const float gradient1 = df[1] - p[1] * normal_part;
    const float gradient2 = df[2] - p[2] * normal_part;
    return sqrtf(gradient0 * gradient0 + gradient1 * gradient1 + gradient2 * gradient2);
}

void sphere_gradient_norm_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT df,
    float *SPHERE_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = sphere_gradient_norm_f(p + 3 * i, df + 3 * i);
}

/* where(norm(s) <= 4 * eps, v - 2 * dot(orthogonal(p), v) * orthogonal(p), v - 2 * dot(s, v) / [...] */
void sphere_transport_f(
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT q,
    const float *SPHERE_RESTRICT v,
    float *SPHERE_RESTRICT w_out) {
    const float q_plus_p0 = p[0] + q[0];
    const float q_plus_p1 = p[1] + q[1];
    const float q_plus_p2 = p[2] + q[2];
    const float norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 * q_plus_p2;
    const float norm_q_plus_p = sqrtf(norm_q_plus_p_squared);
    const float squared = p[0] * p[0];
    const float gap = 1.0f - squared;
    const float gap_2 = 1.0f - p[1] * p[1];
    const int is_small = squared < 0.5f;
    const float product = p[0] * p[1];
    const float dot_s_v = v[0] * q_plus_p0 + v[1] * q_plus_p1 + v[2] * q_plus_p2;
    const int is_less_equal = norm_q_plus_p <= 4.0f * FLT_EPSILON;
    const float sine_to_axis0 = sqrtf((is_less_equal ? (is_small ? gap : 1.0f) : 1.0f));
    const float sine_to_axis1 = sqrtf((is_less_equal ? (is_small ? 1.0f : gap_2) : 1.0f));
    const float orthogonal_p0 = (is_small ? gap / sine_to_axis0 : -(product / sine_to_axis1));
    const float orthogonal_p1 = (is_small ? -(product / sine_to_axis0) : gap_2 / sine_to_axis1);
    const float orthogonal_p2 = (is_small ? -(p[0] * p[2] / sine_to_axis0) : -(p[1] * p[2] / sine_to_axis1));
    const float dot_orthogonal_p_v = v[0] * orthogonal_p0 + v[1] * orthogonal_p1 + v[2] * orthogonal_p2;
    const float scale = 2.0f * dot_orthogonal_p_v;
    const float scale_2 = 2.0f * dot_s_v / (is_less_equal ? 1.0f : norm_q_plus_p_squared);
    const float w0 = (is_less_equal ? v[0] - orthogonal_p0 * scale : v[0] - q_plus_p0 * scale_2);
    const float w1 = (is_less_equal ? v[1] - orthogonal_p1 * scale : v[1] - q_plus_p1 * scale_2);
    const float w2 = (is_less_equal ? v[2] - orthogonal_p2 * scale : v[2] - q_plus_p2 * scale_2);
    w_out[0] = w0;
    w_out[1] = w1;
    w_out[2] = w2;
}

void sphere_transport_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT p,
    const float *SPHERE_RESTRICT q,
    const float *SPHERE_RESTRICT v,
    float *SPHERE_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) sphere_transport_f(p + 3 * i, q + 3 * i, v + 3 * i, w_out + 3 * i);
}

/* normal / norm(normal) */
void sphere_sample_f(
    const float *SPHERE_RESTRICT normal,
    const float *SPHERE_RESTRICT uniform,
    float *SPHERE_RESTRICT p_out) {
    (void)uniform;
    const float norm_normal_squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    const float norm_normal = sqrtf(norm_normal_squared);
    const float scale = 1.0f / norm_normal;
    const float p0 = normal[0] * scale;
    const float p1 = normal[1] * scale;
    const float p2 = normal[2] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
}

void sphere_sample_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT normal,
    const float *SPHERE_RESTRICT uniform,
    float *SPHERE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) sphere_sample_f(normal + 3 * i, uniform + 3 * i, p_out + 3 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void sphere_splat_f(
    const float *SPHERE_RESTRICT x,
    const float *SPHERE_RESTRICT mu,
    const float *SPHERE_RESTRICT W,
    float amplitude,
    float *SPHERE_RESTRICT value_out,
    float *SPHERE_RESTRICT gradient_out) {
    const float q_plus_p0 = x[0] + mu[0];
    const float q_plus_p1 = x[1] + mu[1];
    const float q_plus_p2 = x[2] + mu[2];
    const float norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 * q_plus_p2;
    const float norm_q_plus_p = sqrtf(norm_q_plus_p_squared);
    const float squared = mu[0] * mu[0];
    const float gap = 1.0f - squared;
    const float gap_2 = 1.0f - mu[1] * mu[1];
    const int on_cut_locus = norm_q_plus_p <= 4.0f * FLT_EPSILON;
    const float q0_off_cut = (on_cut_locus ? mu[0] : x[0]);
    const float q1_off_cut = (on_cut_locus ? mu[1] : x[1]);
    const float q2_off_cut = (on_cut_locus ? mu[2] : x[2]);
    const float d0 = q0_off_cut - mu[0];
    const float d1 = q1_off_cut - mu[1];
    const float d2 = q2_off_cut - mu[2];
    const float norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
    const float q_plus_p0_2 = mu[0] + q0_off_cut;
    const float q_plus_p1_2 = mu[1] + q1_off_cut;
    const float q_plus_p2_2 = mu[2] + q2_off_cut;
    const float norm_q_plus_p_squared_2 = q_plus_p0_2 * q_plus_p0_2 + q_plus_p1_2 * q_plus_p1_2 + q_plus_p2_2
        * q_plus_p2_2;
    const float norm_q_plus_p_2 = sqrtf(norm_q_plus_p_squared_2);
    const float dot_p_q = mu[0] * q0_off_cut + mu[1] * q1_off_cut + mu[2] * q2_off_cut;
    const int is_small = dot_p_q < 0.0f;
    const float e0 = (is_small ? q_plus_p0_2 : d0);
    const float e1 = (is_small ? q_plus_p1_2 : d1);
    const float e2 = (is_small ? q_plus_p2_2 : d2);
    const float dot_p_e = mu[0] * e0 + mu[1] * e1 + mu[2] * e2;
    const float w0 = e0 - mu[0] * dot_p_e;
    const float w1 = e1 - mu[1] * dot_p_e;
    const float w2 = e2 - mu[2] * dot_p_e;
    const float norm_w_squared = w0 * w0 + w1 * w1 + w2 * w2;
    const int near = norm_d_squared < 0.997515f;
    const float near_chosen = (near ? 1.0024911906086624f * norm_d_squared : 0.0f);
    const float t_over_norm_w_near = polynomial_t_over_norm_w_near_f(near_chosen);
    const float near_chosen_2 = (near ? 1.0f : norm_d_squared);
    const float norm_d = sqrtf(near_chosen_2);
    const float atan2_value = atan2f(norm_d, norm_q_plus_p_2);
    const float t = 2.0f * atan2_value;
    const float norm_w = sqrtf((near ? 1.0f : norm_w_squared));
    const float t_ratio = t / norm_w;
    const float t_over_norm_w = (near ? t_over_norm_w_near : t_ratio);
    const int is_small_2 = squared < 0.5f;
    const float sine_to_axis0 = sqrtf((is_small_2 ? gap : 1.0f));
    const float product = mu[0] * mu[1];
    const float sine_to_axis1 = sqrtf((is_small_2 ? 1.0f : gap_2));
    const float v0 = (on_cut_locus ? 3.141592653589793f * (is_small_2 ? gap / sine_to_axis0 : -(product /
        sine_to_axis1)) : w0 * t_over_norm_w);
    const float v1 = (on_cut_locus ? 3.141592653589793f * (is_small_2 ? -(product / sine_to_axis0) : gap_2 /
        sine_to_axis1) : w1 * t_over_norm_w);
    const float product_2 = 3.141592653589793f * (is_small_2 ? -(mu[0] * mu[2] / sine_to_axis0) : -(mu[1] *
        mu[2] / sine_to_axis1));
    const float v2 = (on_cut_locus ? product_2 : w2 * t_over_norm_w);
    const float log_value = logf(0.7853981633974483f / FLT_EPSILON);
    const float log_det_series = polynomial_log_det_series_f(near_chosen);
    const float log_det_near = norm_d_squared * log_det_series;
    const float log_det = (near ? log_det_near : logf(t_ratio));
    const float z0 = W[0] * v0 + W[1] * v1 + W[2] * v2;
    const float z1 = W[3] * v0 + W[4] * v1 + W[5] * v2;
    const float exp_2 = expf((on_cut_locus ? log_value : log_det) - 0.5f * (z0 * z0 + z1 * z1));
    const float phi = amplitude * exp_2;
    const float by_v2 = -(W[5] * z1) - W[2] * z0;
    const float by_v1 = -(W[4] * z1) - W[1] * z0;
    const float by_v0 = -(W[3] * z1) - W[0] * z0;
    const float by_log_det = (on_cut_locus ? 0.0f : 1.0f);
    const float by_log_det_near = (near ? by_log_det : 0.0f);
    const float by_log_det_series = norm_d_squared * by_log_det_near;
    const float log_det_series_slope = polynomial_log_det_series_slope_f(near_chosen);
    const float chosen = (on_cut_locus ? 0.0f : by_v2);
    const float chosen_2 = (on_cut_locus ? 0.0f : by_v1);
    const float chosen_3 = (on_cut_locus ? 0.0f : by_v0);
    const float by_t_over_norm_w = w2 * chosen + w1 * chosen_2 + w0 * chosen_3;
    const float by_t_over_norm_w_near = (near ? by_t_over_norm_w : 0.0f);
    const float by_t = ((near ? 0.0f : by_log_det) / t_ratio + (near ? 0.0f : by_t_over_norm_w)) / norm_w;
    const float by_norm_w_squared = (near ? 0.0f : -(t_ratio * by_t / (2.0f * norm_w)));
    const float by_atan2_value = 2.0f * by_t;
    const float ratio = by_atan2_value / (norm_q_plus_p_squared_2 + near_chosen_2);
    const float by_norm_d = norm_q_plus_p_2 * ratio;
    const float t_over_norm_w_near_slope = polynomial_t_over_norm_w_near_slope_f(near_chosen);
    const float by_norm_d_squared = log_det_series * by_log_det_near + (near ? 0.0f : by_norm_d / (2.0f *
        norm_d)) + 1.0024911906086624f * (near ? by_log_det_series * log_det_series_slope +
        by_t_over_norm_w_near * t_over_norm_w_near_slope : 0.0f);
    const float product_3 = 2.0f * by_norm_w_squared;
    const float by_w2 = t_over_norm_w * chosen + w2 * product_3;
    const float by_w1 = t_over_norm_w * chosen_2 + w1 * product_3;
    const float by_w0 = t_over_norm_w * chosen_3 + w0 * product_3;
    const float by_dot_p_e = -(mu[2] * by_w2) - mu[1] * by_w1 - mu[0] * by_w0;
    const float by_e2 = by_w2 + mu[2] * by_dot_p_e;
    const float by_e1 = by_w1 + mu[1] * by_dot_p_e;
    const float by_e0 = by_w0 + mu[0] * by_dot_p_e;
    const int is_small_3 = norm_q_plus_p_squared_2 == 0.0f;
    const float by_norm_q_plus_p_squared_2 = (is_small_3 ? 0.0f : -(norm_d * ratio / (2.0f * (is_small_3 ?
        1.0f : norm_q_plus_p_2))));
    const float product_4 = 2.0f * by_norm_q_plus_p_squared_2;
    const float by_q_plus_p2_2 = (is_small ? by_e2 : 0.0f) + q_plus_p2_2 * product_4;
    const float by_q_plus_p1_2 = (is_small ? by_e1 : 0.0f) + q_plus_p1_2 * product_4;
    const float by_q_plus_p0_2 = (is_small ? by_e0 : 0.0f) + q_plus_p0_2 * product_4;
    const float product_5 = 2.0f * by_norm_d_squared;
    const float by_d2 = (is_small ? 0.0f : by_e2) + d2 * product_5;
    const float by_d1 = (is_small ? 0.0f : by_e1) + d1 * product_5;
    const float by_d0 = (is_small ? 0.0f : by_e0) + d0 * product_5;
    const float by_q2_off_cut = by_q_plus_p2_2 + by_d2;
    const float by_q1_off_cut = by_q_plus_p1_2 + by_d1;
    const float by_q0_off_cut = by_q_plus_p0_2 + by_d0;
    const float exponent_by_x2 = (on_cut_locus ? 0.0f : by_q2_off_cut);
    const float exponent_by_x1 = (on_cut_locus ? 0.0f : by_q1_off_cut);
    const float exponent_by_x0 = (on_cut_locus ? 0.0f : by_q0_off_cut);
    const float df0 = phi * exponent_by_x0;
    const float df1 = phi * exponent_by_x1;
    const float df2 = phi * exponent_by_x2;
    const float normal_part = x[0] * df0 + x[1] * df1 + x[2] * df2;
    const float gradient0 = df0 - x[0] * normal_part;
    const float gradient1 = df1 - x[1] * normal_part;
    const float gradient2 = df2 - x[2] * normal_part;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void sphere_splat_batch_f(
    size_t count,
    const float *SPHERE_RESTRICT x,
    const float *SPHERE_RESTRICT mu,
    const float *SPHERE_RESTRICT W,
    const float *SPHERE_RESTRICT amplitude,
    float *SPHERE_RESTRICT value_out,
    float *SPHERE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) sphere_splat_f(x + 3 * i, mu + 3 * i, W + 6 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void sphere_frame_f(const float *SPHERE_RESTRICT p, float *SPHERE_RESTRICT frame) {
    float left[3][3];
    for (int i = 0; i < 3; ++i) {
        float axis[3];
        for (int j = 0; j < 3; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        sphere_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        float *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 3; ++i)
            if (sphere_norm_f(p, left[i]) > sphere_norm_f(p, left[longest])) longest = i;
        const float length = sphere_norm_f(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 3; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 3];
            const float part = sphere_inner_f(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}
