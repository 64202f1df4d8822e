/*
 * hyperbolic: Hyperbolic space H^n, points on the upper sheet of the unit hyperboloid in R^(n+1), time
 *
 * See the header for what the functions promise.
 */

#include "hyperbolic.h"

#include <float.h>

/* Of degree 7 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_cosh_r_near(double x) {
    return 1.0 + x * (0.4951965000000002 + x * (0.04086992893537111 + x * (0.0013492430509672866 + x *
        (2.386215832545237e-05 + x * (2.6258819438387563e-07 + x * (1.969895131891319e-09 + x *
        1.0901310028051077e-11))))));
}

/* Of degree 7 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_sinhc_r_near(double x) {
    return 1.0 + x * (0.1650655 + x * (0.008173985787074772 + x * (0.0001927490072784454 + x *
        (2.6513509313345557e-06 + x * (2.3871645886590894e-08 + x * (1.5153577513073096e-10 + x *
        7.253329405682668e-13))))));
}

/* Of degree 10 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_r_over_sinh_r_near(double x) {
    return 1.0 + x * (-0.07645299999999933 + x * (0.007014073450772367 + x * (-0.0006894603735308533 + x *
        (7.028174834933066e-05 + x * (-7.3271429095332685e-06 + x * (7.755870671311039e-07 + x *
        (-8.292078427084355e-08 + x * (8.836830738665055e-09 + x * (-8.752687130842103e-10 + x *
        5.971322045969486e-11)))))))));
}

/* Of degree 10 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_log_det_series(double x) {
    return -0.16666666666666666 + x * (0.008919516666666636 + x * (-0.0006587291203781074 + x *
        (5.5433465232930376e-05 + x * (-5.007870461546201e-06 + x * (4.73041328179866e-07 + x *
        (-4.606998930627231e-08 + x * (4.58397192789824e-09 + x * (-4.5918780409089634e-10 + x *
        (4.3272540326081547e-11 + x * -2.8538336906095128e-12)))))))));
}

/* Of degree 9 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_log_det_series_slope(double x) {
    return 0.008919516666666636 + x * (-0.0013174582407562147 + x * (0.00016630039569879112 + x *
        (-2.0031481846184804e-05 + x * (2.36520664089933e-06 + x * (-2.7641993583763386e-07 + x *
        (3.208780349528768e-08 + x * (-3.6735024327271707e-09 + x * (3.8945286293473394e-10 + x *
        -2.8538336906095128e-11))))))));
}

/* Of degree 9 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_r_over_sinh_r_near_slope(double x) {
    return -0.07645299999999933 + x * (0.014028146901544735 + x * (-0.00206838112059256 + x *
        (0.00028112699339732266 + x * (-3.663571454766634e-05 + x * (4.6535224027866236e-06 + x *
        (-5.804454898959049e-07 + x * (7.069464590932044e-08 + x * (-7.877418417757893e-09 + x *
        5.971322045969487e-10))))))));
}

/* [sqrt(1 + dot(p[1:], p[1:])), p[1:]] */
void hyperbolic_project(const double *HYPERBOLIC_RESTRICT x, double *HYPERBOLIC_RESTRICT p_out) {
    const double dot_ps_ps = x[1] * x[1] + x[2] * x[2];
    const double sqrt_value = sqrt(1.0 + dot_ps_ps);
    p_out[0] = sqrt_value;
    p_out[1] = x[1];
    p_out[2] = x[2];
}

void hyperbolic_project_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT x,
    double *HYPERBOLIC_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_project(x + 3 * i, p_out + 3 * i);
}

/* x - N (dc N)^-1 dc x */
void hyperbolic_to_tangent(
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT x,
    double *HYPERBOLIC_RESTRICT v_out) {
    const double normal_part = p[1] * x[1] + p[2] * x[2] - p[0] * x[0];
    const double v0 = x[0] + p[0] * normal_part;
    const double v1 = x[1] + p[1] * normal_part;
    const double v2 = x[2] + p[2] * normal_part;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void hyperbolic_to_tangent_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT x,
    double *HYPERBOLIC_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_to_tangent(p + 3 * i, x + 3 * i, v_out + 3 * i);
}

/* dot(u[1:], v[1:]) - u[0] * v[0] */
double hyperbolic_inner(
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT u,
    const double *HYPERBOLIC_RESTRICT v) {
    (void)p;
    return u[1] * v[1] + u[2] * v[2] - u[0] * v[0];
}

void hyperbolic_inner_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT u,
    const double *HYPERBOLIC_RESTRICT v,
    double *HYPERBOLIC_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = hyperbolic_inner(p + 3 * i, u + 3 * i, v + 3 * i);
}

/* r */
double hyperbolic_norm(const double *HYPERBOLIC_RESTRICT p, const double *HYPERBOLIC_RESTRICT v) {
    const double dot_s_s = p[1] * p[1] + p[2] * p[2];
    const double dot_h_h = v[1] * v[1] + v[2] * v[2];
    const double dot_s_h = p[1] * v[1] + p[2] * v[2];
    const double dot_s_s_total = 1.0 + dot_s_s;
    const int is_small = dot_s_s < 1.0;
    const double dot_s_h_ratio = dot_s_h / (is_small ? 1.0 : dot_s_s);
    const double rest0 = v[1] - p[1] * dot_s_h_ratio;
    const double rest1 = v[2] - p[2] * dot_s_h_ratio;
    const double dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const double vv = (is_small ? dot_h_h - dot_s_h * dot_s_h / dot_s_s_total : dot_rest_rest + dot_s_h *
        dot_s_h_ratio / dot_s_s_total);
    const double r = sqrt(vv);
    return r;
}

void hyperbolic_norm_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT v,
    double *HYPERBOLIC_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = hyperbolic_norm(p + 3 * i, v + 3 * i);
}

/* G(p) v */
void hyperbolic_flat(
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT v,
    double *HYPERBOLIC_RESTRICT covector_out) {
    (void)p;
    const double covector0 = -v[0];
    covector_out[0] = covector0;
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void hyperbolic_flat_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT v,
    double *HYPERBOLIC_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_flat(p + 3 * i, v + 3 * i, covector_out + 3 * i);
}

/* cosh(r) * [a, s] + sinhc(r) * [dot(s, h) / a, h] */
void hyperbolic_exp(
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT v,
    double *HYPERBOLIC_RESTRICT q_out) {
    const double dot_s_s = p[1] * p[1] + p[2] * p[2];
    const double dot_h_h = v[1] * v[1] + v[2] * v[2];
    const double dot_s_h = p[1] * v[1] + p[2] * v[2];
    const double dot_s_s_total = 1.0 + dot_s_s;
    const double a = sqrt(dot_s_s_total);
    const int is_small = dot_s_s < 1.0;
    const double dot_s_s_chosen = (is_small ? 1.0 : dot_s_s);
    const double dot_s_h_ratio = dot_s_h / dot_s_s_chosen;
    const double dot_h_h_gap = dot_h_h - dot_s_h * dot_s_h / dot_s_s_total;
    const double rest0 = v[1] - p[1] * dot_s_h_ratio;
    const double rest1 = v[2] - p[2] * dot_s_h_ratio;
    const double dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const double vv = (is_small ? dot_h_h_gap : dot_rest_rest + dot_s_h * dot_s_h_ratio / dot_s_s_total);
    const int near = vv < 0.990393;
    const double near_chosen = (near ? 1.0097001897226656 * vv : 0.0);
    const double cosh_r_near = polynomial_cosh_r_near(near_chosen);
    const double dot_s_h_ratio_2 = dot_s_h / (near ? 1.0 : dot_s_s_chosen);
    const double rest0_2 = v[1] - p[1] * dot_s_h_ratio_2;
    const double rest1_2 = v[2] - p[2] * dot_s_h_ratio_2;
    const double dot_rest_rest_2 = rest0_2 * rest0_2 + rest1_2 * rest1_2;
    const double vv_2 = (is_small ? dot_h_h_gap : dot_rest_rest_2 + dot_s_h * dot_s_h_ratio_2 /
        dot_s_s_total);
    const double r = sqrt((near ? 1.0 : vv_2));
    const double cosh_r = (near ? cosh_r_near : cosh(r));
    const double sinhc_r_near = polynomial_sinhc_r_near(near_chosen);
    const double sinhc_r = (near ? sinhc_r_near : sinh(r) / r);
    const double q0 = a * cosh_r + dot_s_h * sinhc_r / a;
    const double q1 = p[1] * cosh_r + v[1] * sinhc_r;
    const double q2 = p[2] * cosh_r + v[2] * sinhc_r;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
}

void hyperbolic_exp_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT v,
    double *HYPERBOLIC_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_exp(p + 3 * i, v + 3 * i, q_out + 3 * i);
}

/* r / sinh_r * ([e, D] - ww / 2 * [a, p[1:]]) */
void hyperbolic_log(
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT q,
    double *HYPERBOLIC_RESTRICT v_out) {
    const double S0 = p[1] + q[1];
    const double S1 = p[2] + q[2];
    const double dot_S_S = S0 * S0 + S1 * S1;
    const double D0 = q[1] - p[1];
    const double D1 = q[2] - p[2];
    const double dot_D_D = D0 * D0 + D1 * D1;
    const double dot_D_S = S0 * D0 + S1 * D1;
    const double dot_ps_ps = p[1] * p[1] + p[2] * p[2];
    const double a = sqrt(1.0 + dot_ps_ps);
    const double dot_qs_qs = q[1] * q[1] + q[2] * q[2];
    const double b = sqrt(1.0 + dot_qs_qs);
    const double a_total = a + b;
    const double e = dot_D_S / a_total;
    const int is_small = dot_S_S < 1.0;
    const double dot_D_S_ratio = dot_D_S / (is_small ? 1.0 : dot_S_S);
    const double dot_ps_qs = p[1] * q[1] + p[2] * q[2];
    const double c = (2.0 + b * (2.0 * a) - 2.0 * dot_ps_qs) / (a_total * a_total);
    const double rest0 = D0 - S0 * dot_D_S_ratio;
    const double rest1 = D1 - S1 * dot_D_S_ratio;
    const double dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const double ww = (is_small ? dot_D_D - e * e : dot_rest_rest + dot_D_S_ratio * (dot_D_S * c));
    const int near = ww < 0.458718;
    const double r_over_sinh_r_near = polynomial_r_over_sinh_r_near((near ? 2.1799885768598575 * ww : 0.0));
    const double sqrt_ww = sqrt((near ? 1.0 : ww));
    const double asinh_sqrt_ww_over_2 = asinh(0.5 * sqrt_ww);
    const double r = 2.0 * asinh_sqrt_ww_over_2;
    const double sinh_r = sqrt((near ? 1.0 : ww * (1.0 + 0.25 * ww)));
    const double r_over_sinh_r = (near ? r_over_sinh_r_near : r / sinh_r);
    const double scale = 0.5 * ww;
    const double v0 = r_over_sinh_r * (e - a * scale);
    const double v1 = r_over_sinh_r * (D0 - p[1] * scale);
    const double v2 = r_over_sinh_r * (D1 - p[2] * scale);
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void hyperbolic_log_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT q,
    double *HYPERBOLIC_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_log(p + 3 * i, q + 3 * i, v_out + 3 * i);
}

/* r */
double hyperbolic_distance(const double *HYPERBOLIC_RESTRICT p, const double *HYPERBOLIC_RESTRICT q) {
    const double S0 = p[1] + q[1];
    const double S1 = p[2] + q[2];
    const double dot_S_S = S0 * S0 + S1 * S1;
    const double D0 = q[1] - p[1];
    const double D1 = q[2] - p[2];
    const double dot_D_D = D0 * D0 + D1 * D1;
    const double dot_D_S = S0 * D0 + S1 * D1;
    const double dot_ps_ps = p[1] * p[1] + p[2] * p[2];
    const double a = sqrt(1.0 + dot_ps_ps);
    const double dot_qs_qs = q[1] * q[1] + q[2] * q[2];
    const double b = sqrt(1.0 + dot_qs_qs);
    const double a_total = a + b;
    const double e = dot_D_S / a_total;
    const int is_small = dot_S_S < 1.0;
    const double dot_D_S_ratio = dot_D_S / (is_small ? 1.0 : dot_S_S);
    const double dot_ps_qs = p[1] * q[1] + p[2] * q[2];
    const double c = (2.0 + b * (2.0 * a) - 2.0 * dot_ps_qs) / (a_total * a_total);
    const double rest0 = D0 - S0 * dot_D_S_ratio;
    const double rest1 = D1 - S1 * dot_D_S_ratio;
    const double dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const double ww = (is_small ? dot_D_D - e * e : dot_rest_rest + dot_D_S_ratio * (dot_D_S * c));
    const double sqrt_ww = sqrt(ww);
    const double asinh_sqrt_ww_over_2 = asinh(0.5 * sqrt_ww);
    const double r = 2.0 * asinh_sqrt_ww_over_2;
    return r;
}

void hyperbolic_distance_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT q,
    double *HYPERBOLIC_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = hyperbolic_distance(p + 3 * i, q + 3 * i);
}

/* log(r_over_sinh_r) */
double hyperbolic_log_abs_det(const double *HYPERBOLIC_RESTRICT p, const double *HYPERBOLIC_RESTRICT q) {
    const double S0 = p[1] + q[1];
    const double S1 = p[2] + q[2];
    const double dot_S_S = S0 * S0 + S1 * S1;
    const double D0 = q[1] - p[1];
    const double D1 = q[2] - p[2];
    const double dot_D_D = D0 * D0 + D1 * D1;
    const double dot_D_S = S0 * D0 + S1 * D1;
    const double dot_ps_ps = p[1] * p[1] + p[2] * p[2];
    const double a = sqrt(1.0 + dot_ps_ps);
    const double dot_qs_qs = q[1] * q[1] + q[2] * q[2];
    const double b = sqrt(1.0 + dot_qs_qs);
    const double a_total = a + b;
    const double e = dot_D_S / a_total;
    const int is_small = dot_S_S < 1.0;
    const double dot_D_S_ratio = dot_D_S / (is_small ? 1.0 : dot_S_S);
    const double dot_ps_qs = p[1] * q[1] + p[2] * q[2];
    const double c = (2.0 + b * (2.0 * a) - 2.0 * dot_ps_qs) / (a_total * a_total);
    const double rest0 = D0 - S0 * dot_D_S_ratio;
    const double rest1 = D1 - S1 * dot_D_S_ratio;
    const double dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const double ww = (is_small ? dot_D_D - e * e : dot_rest_rest + dot_D_S_ratio * (dot_D_S * c));
    const int near = ww < 0.458718;
    const double sqrt_ww = sqrt((near ? 1.0 : ww));
    const double asinh_sqrt_ww_over_2 = asinh(0.5 * sqrt_ww);
    const double r = 2.0 * asinh_sqrt_ww_over_2;
    const double sinh_r = sqrt((near ? 1.0 : ww * (1.0 + 0.25 * ww)));
    const double log_det_series = polynomial_log_det_series((near ? 2.1799885768598575 * ww : 0.0));
    const double log_det_near = ww * log_det_series;
    const double log_det = (near ? log_det_near : log(r / sinh_r));
    return log_det;
}

void hyperbolic_log_abs_det_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT q,
    double *HYPERBOLIC_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = hyperbolic_log_abs_det(p + 3 * i, q + 3 * i);
}

/* the tangential part of G^-1 df */
void hyperbolic_riemannian_gradient(
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT df,
    double *HYPERBOLIC_RESTRICT gradient_out) {
    const double normal_part = p[0] * df[0] + p[1] * df[1] + p[2] * df[2];
    const double gradient0 = p[0] * normal_part - df[0];
    const double gradient1 = df[1] + p[1] * normal_part;
    const double gradient2 = df[2] + p[2] * normal_part;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void hyperbolic_riemannian_gradient_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT df,
    double *HYPERBOLIC_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_riemannian_gradient(p + 3 * i, df + 3 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
double hyperbolic_gradient_norm(const double *HYPERBOLIC_RESTRICT p, const double *HYPERBOLIC_RESTRICT df) {
    const double normal_part = p[0] * df[0] + p[1] * df[1] + p[2] * df[2];
    const double gradient1 = df[1] + p[1] * normal_part;
    const double gradient2 = df[2] + p[2] * normal_part;
    const double dot_s_s = p[1] * p[1] + p[2] * p[2];
    const double dot_h_h = gradient1 * gradient1 + gradient2 * gradient2;
    const double dot_s_h = p[1] * gradient1 + p[2] * gradient2;
    const double dot_s_s_total = 1.0 + dot_s_s;
    const int is_small = dot_s_s < 1.0;
    const double dot_s_h_ratio = dot_s_h / (is_small ? 1.0 : dot_s_s);
    const double rest0 = gradient1 - p[1] * dot_s_h_ratio;
    const double rest1 = gradient2 - p[2] * dot_s_h_ratio;
    const double dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const double vv = (is_small ? dot_h_h - dot_s_h * dot_s_h / dot_s_s_total : dot_rest_rest + dot_s_h *
        dot_s_h_ratio / dot_s_s_total);
    const double r = sqrt(vv);
    return r;
}

void hyperbolic_gradient_norm_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT p,
    const double *HYPERBOLIC_RESTRICT df,
    double *HYPERBOLIC_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = hyperbolic_gradient_norm(p + 3 * i, df + 3 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void hyperbolic_splat(
    const double *HYPERBOLIC_RESTRICT x,
    const double *HYPERBOLIC_RESTRICT mu,
    const double *HYPERBOLIC_RESTRICT W,
    double amplitude,
    double *HYPERBOLIC_RESTRICT value_out,
    double *HYPERBOLIC_RESTRICT gradient_out) {
    const double S0 = x[1] + mu[1];
    const double S1 = x[2] + mu[2];
    const double dot_S_S = S0 * S0 + S1 * S1;
    const double D0 = x[1] - mu[1];
    const double D1 = x[2] - mu[2];
    const double dot_D_D = D0 * D0 + D1 * D1;
    const double dot_D_S = S0 * D0 + S1 * D1;
    const double dot_ps_ps = mu[1] * mu[1] + mu[2] * mu[2];
    const double a = sqrt(1.0 + dot_ps_ps);
    const double dot_qs_qs = x[1] * x[1] + x[2] * x[2];
    const double dot_qs_qs_total = 1.0 + dot_qs_qs;
    const double b = sqrt(dot_qs_qs_total);
    const double a_total = a + b;
    const double e = dot_D_S / a_total;
    const int is_small = dot_S_S < 1.0;
    const double dot_S_S_chosen = (is_small ? 1.0 : dot_S_S);
    const double dot_D_S_ratio = dot_D_S / dot_S_S_chosen;
    const double dot_ps_qs = x[1] * mu[1] + x[2] * mu[2];
    const double squared = a_total * a_total;
    const double a_product = 2.0 * a;
    const double c = (2.0 + b * a_product - 2.0 * dot_ps_qs) / squared;
    const double dot_D_S_product = dot_D_S * c;
    const double rest0 = D0 - S0 * dot_D_S_ratio;
    const double rest1 = D1 - S1 * dot_D_S_ratio;
    const double dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const double ww = (is_small ? dot_D_D - e * e : dot_rest_rest + dot_D_S_ratio * dot_D_S_product);
    const double total_2 = 1.0 + 0.25 * ww;
    const int near = ww < 0.458718;
    const double near_chosen = (near ? 2.1799885768598575 * ww : 0.0);
    const double r_over_sinh_r_near = polynomial_r_over_sinh_r_near(near_chosen);
    const double sqrt_ww = sqrt((near ? 1.0 : ww));
    const double sqrt_ww_product = 0.5 * sqrt_ww;
    const double asinh_sqrt_ww_over_2 = asinh(sqrt_ww_product);
    const double r = 2.0 * asinh_sqrt_ww_over_2;
    const double sinh_r = sqrt((near ? 1.0 : ww * total_2));
    const double r_ratio = r / sinh_r;
    const double r_over_sinh_r = (near ? r_over_sinh_r_near : r_ratio);
    const double scale = 0.5 * ww;
    const double e_gap = e - a * scale;
    const double v0 = r_over_sinh_r * e_gap;
    const double D0_gap = D0 - mu[1] * scale;
    const double v1 = r_over_sinh_r * D0_gap;
    const double D1_gap = D1 - mu[2] * scale;
    const double v2 = r_over_sinh_r * D1_gap;
    const double log_det_series = polynomial_log_det_series(near_chosen);
    const double log_det_near = ww * log_det_series;
    const double log_det = (near ? log_det_near : log(r_ratio));
    const double z0 = W[0] * v0 + W[1] * v1 + W[2] * v2;
    const double z1 = W[3] * v0 + W[4] * v1 + W[5] * v2;
    const double exp_2 = exp(log_det - 0.5 * (z0 * z0 + z1 * z1));
    const double phi = amplitude * exp_2;
    const double by_v2 = -(W[5] * z1) - W[2] * z0;
    const double by_v1 = -(W[4] * z1) - W[1] * z0;
    const double by_v0 = -(W[3] * z1) - W[0] * z0;
    const double by_log_det_near = (near ? 1.0 : 0.0);
    const double by_log_det_series = ww * by_log_det_near;
    const double log_det_series_slope = polynomial_log_det_series_slope(near_chosen);
    const double product = r_over_sinh_r * by_v2;
    const double product_2 = r_over_sinh_r * by_v1;
    const double product_3 = r_over_sinh_r * by_v0;
    const double by_r_over_sinh_r = D1_gap * by_v2 + D0_gap * by_v1 + e_gap * by_v0;
    const double by_scale = -(mu[2] * product) - mu[1] * product_2 - a * product_3;
    const double by_r_over_sinh_r_near = (near ? by_r_over_sinh_r : 0.0);
    const double by_r = ((near ? 0.0 : 1.0) / r_ratio + (near ? 0.0 : by_r_over_sinh_r)) / sinh_r;
    const double near_chosen_2 = (near ? 0.0 : -(r_ratio * by_r / (2.0 * sinh_r)));
    const double by_asinh_sqrt_ww_over_2 = 2.0 * by_r;
    const double by_sqrt_ww = 0.5 * (by_asinh_sqrt_ww_over_2 / sqrt(1.0 + sqrt_ww_product * sqrt_ww_product));
    const double r_over_sinh_r_near_slope = polynomial_r_over_sinh_r_near_slope(near_chosen);
    const double total_3 = log_det_series * by_log_det_near + 0.5 * by_scale + (near ? 0.0 : by_sqrt_ww / (2.0
        * sqrt_ww)) + 2.1799885768598575 * (near ? by_log_det_series * log_det_series_slope +
        by_r_over_sinh_r_near * r_over_sinh_r_near_slope : 0.0);
    const double by_ww = total_3 + total_2 * near_chosen_2 + 0.25 * (ww * near_chosen_2);
    const double by_dot_D_D = (is_small ? by_ww : 0.0);
    const double by_dot_rest_rest = (is_small ? 0.0 : by_ww);
    const double product_4 = dot_D_S_ratio * by_dot_rest_rest;
    const double product_5 = 2.0 * by_dot_rest_rest;
    const double by_rest1 = rest1 * product_5;
    const double by_rest0 = rest0 * product_5;
    const double by_c = dot_D_S * product_4;
    const double by_dot_D_D_product = 2.0 * by_dot_D_D;
    const double by_e = product_3 - e * by_dot_D_D_product;
    const double by_c_ratio = by_c / squared;
    const double product_6 = 2.0 * by_c_ratio;
    const double ratio = (dot_D_S_product * by_dot_rest_rest - S1 * by_rest1 - S0 * by_rest0) /
        dot_S_S_chosen;
    const double by_dot_S_S = (is_small ? 0.0 : -(dot_D_S_ratio * ratio));
    const double by_e_ratio = by_e / a_total;
    const double by_dot_D_S = c * product_4 + ratio + by_e_ratio;
    const double gap = -(a_total * (2.0 * (c * by_c_ratio))) - e * by_e_ratio;
    const double by_b = a_product * by_c_ratio + gap;
    const int is_small_2 = dot_qs_qs_total == 0.0;
    const double by_dot_qs_qs = (is_small_2 ? 0.0 : by_b / (2.0 * (is_small_2 ? 1.0 : b)));
    const double product_7 = 2.0 * by_dot_qs_qs;
    const double by_D1 = product + by_rest1 + S1 * by_dot_D_S + D1 * by_dot_D_D_product;
    const double by_D0 = product_2 + by_rest0 + S0 * by_dot_D_S + D0 * by_dot_D_D_product;
    const double by_dot_S_S_product = 2.0 * by_dot_S_S;
    const double by_S1 = D1 * by_dot_D_S - dot_D_S_ratio * by_rest1 + S1 * by_dot_S_S_product;
    const double by_S0 = D0 * by_dot_D_S - dot_D_S_ratio * by_rest0 + S0 * by_dot_S_S_product;
    const double exponent_by_x2 = x[2] * product_7 - mu[2] * product_6 + by_D1 + by_S1;
    const double exponent_by_x1 = x[1] * product_7 - mu[1] * product_6 + by_D0 + by_S0;
    const double df1 = phi * exponent_by_x1;
    const double df2 = phi * exponent_by_x2;
    const double normal_part = x[1] * df1 + x[2] * df2;
    const double gradient0 = x[0] * normal_part;
    const double gradient1 = df1 + x[1] * normal_part;
    const double gradient2 = df2 + x[2] * normal_part;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void hyperbolic_splat_batch(
    size_t count,
    const double *HYPERBOLIC_RESTRICT x,
    const double *HYPERBOLIC_RESTRICT mu,
    const double *HYPERBOLIC_RESTRICT W,
    const double *HYPERBOLIC_RESTRICT amplitude,
    double *HYPERBOLIC_RESTRICT value_out,
    double *HYPERBOLIC_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_splat(x + 3 * i, mu + 3 * i, W + 6 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void hyperbolic_frame(const double *HYPERBOLIC_RESTRICT p, double *HYPERBOLIC_RESTRICT frame) {
    double left[3][3];
    for (int i = 0; i < 3; ++i) {
        double axis[3];
        for (int j = 0; j < 3; ++j) axis[j] = i == j ? 1.0 : 0.0;
        hyperbolic_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        double *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 3; ++i)
            if (hyperbolic_norm(p, left[i]) > hyperbolic_norm(p, left[longest])) longest = i;
        const double length = hyperbolic_norm(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 3; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 3];
            const double part = hyperbolic_inner(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}

/* Of degree 4, within 2^-30 of that of double precision. */
static inline float polynomial_cosh_r_near_f(float x) {
    return 1.0000000005235519f + x * (0.4951964738439144f + x * (0.04087013792625056f + x *
        (0.0013486590777951736f + x * 2.4526816630031896e-05f)));
}

/* Of degree 4, within 2^-34 of that of double precision. */
static inline float polynomial_sinhc_r_near_f(float x) {
    return 1.0000000000474452f + x * (0.1650654976293945f + x * (0.008174004732127246f + x *
        (0.0001926960533726536f + x * 2.7116592564545465e-06f)));
}

/* Of degree 5, within 2^-31 of that of double precision. */
static inline float polynomial_r_over_sinh_r_near_f(float x) {
    return 0.9999999997286667f + x * (-0.07645298027983063f + x * (0.007013840321617159f + x *
        (-0.0006884456440228125f + x * (6.825821538408094e-05f + x * -5.404229500574623e-06f))));
}

/* Of degree 4, within 2^-27 of that of double precision. */
static inline float polynomial_log_det_series_f(float x) {
    return -0.16666666595221144f + x * (0.008919480570751447f + x * (-0.0006584357892223718f + x *
        (5.459026336080359e-05f + x * -3.992163980997263e-06f)));
}

/* Of degree 5, within 2^-29 of that of double precision. */
static inline float polynomial_log_det_series_slope_f(float x) {
    return 0.00891951665572841f + x * (-0.0013174574451573387f + x * (0.00016629097984357212f + x *
        (-1.9990429482366592e-05f + x * (2.2831133769576623e-06f + x * -1.9798298019555835e-07f))));
}

/* Of degree 5, within 2^-28 of that of double precision. */
static inline float polynomial_r_over_sinh_r_near_slope_f(float x) {
    return -0.07645299980662094f + x * (0.014028132826532107f + x * (-0.0020682143844877664f + x *
        (0.0002803989835272717f + x * (-3.5176357383446374e-05f + x * 3.2524719164358603e-06f))));
}

/* [sqrt(1 + dot(p[1:], p[1:])), p[1:]] */
void hyperbolic_project_f(const float *HYPERBOLIC_RESTRICT x, float *HYPERBOLIC_RESTRICT p_out) {
    const float dot_ps_ps = x[1] * x[1] + x[2] * x[2];
    const float sqrt_value = sqrtf(1.0f + dot_ps_ps);
    p_out[0] = sqrt_value;
    p_out[1] = x[1];
    p_out[2] = x[2];
}

void hyperbolic_project_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT x,
    float *HYPERBOLIC_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_project_f(x + 3 * i, p_out + 3 * i);
}

/* x - N (dc N)^-1 dc x */
void hyperbolic_to_tangent_f(
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT x,
    float *HYPERBOLIC_RESTRICT v_out) {
    const float normal_part = p[1] * x[1] + p[2] * x[2] - p[0] * x[0];
    const float v0 = x[0] + p[0] * normal_part;
    const float v1 = x[1] + p[1] * normal_part;
    const float v2 = x[2] + p[2] * normal_part;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void hyperbolic_to_tangent_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT x,
    float *HYPERBOLIC_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_to_tangent_f(p + 3 * i, x + 3 * i, v_out + 3 * i);
}

/* dot(u[1:], v[1:]) - u[0] * v[0] */
float hyperbolic_inner_f(
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT u,
    const float *HYPERBOLIC_RESTRICT v) {
    (void)p;
    return u[1] * v[1] + u[2] * v[2] - u[0] * v[0];
}

void hyperbolic_inner_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT u,
    const float *HYPERBOLIC_RESTRICT v,
    float *HYPERBOLIC_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = hyperbolic_inner_f(p + 3 * i, u + 3 * i, v + 3 * i);
}

/* r */
float hyperbolic_norm_f(const float *HYPERBOLIC_RESTRICT p, const float *HYPERBOLIC_RESTRICT v) {
    const float dot_s_s = p[1] * p[1] + p[2] * p[2];
    const float dot_h_h = v[1] * v[1] + v[2] * v[2];
    const float dot_s_h = p[1] * v[1] + p[2] * v[2];
    const float dot_s_s_total = 1.0f + dot_s_s;
    const int is_small = dot_s_s < 1.0f;
    const float dot_s_h_ratio = dot_s_h / (is_small ? 1.0f : dot_s_s);
    const float rest0 = v[1] - p[1] * dot_s_h_ratio;
    const float rest1 = v[2] - p[2] * dot_s_h_ratio;
    const float dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const float vv = (is_small ? dot_h_h - dot_s_h * dot_s_h / dot_s_s_total : dot_rest_rest + dot_s_h *
        dot_s_h_ratio / dot_s_s_total);
    const float r = sqrtf(vv);
    return r;
}

void hyperbolic_norm_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT v,
    float *HYPERBOLIC_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = hyperbolic_norm_f(p + 3 * i, v + 3 * i);
}

/* G(p) v */
void hyperbolic_flat_f(
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT v,
    float *HYPERBOLIC_RESTRICT covector_out) {
    (void)p;
    const float covector0 = -v[0];
    covector_out[0] = covector0;
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void hyperbolic_flat_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT v,
    float *HYPERBOLIC_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_flat_f(p + 3 * i, v + 3 * i, covector_out + 3 * i);
}

/* cosh(r) * [a, s] + sinhc(r) * [dot(s, h) / a, h] */
void hyperbolic_exp_f(
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT v,
    float *HYPERBOLIC_RESTRICT q_out) {
    const float dot_s_s = p[1] * p[1] + p[2] * p[2];
    const float dot_h_h = v[1] * v[1] + v[2] * v[2];
    const float dot_s_h = p[1] * v[1] + p[2] * v[2];
    const float dot_s_s_total = 1.0f + dot_s_s;
    const float a = sqrtf(dot_s_s_total);
    const int is_small = dot_s_s < 1.0f;
    const float dot_s_s_chosen = (is_small ? 1.0f : dot_s_s);
    const float dot_s_h_ratio = dot_s_h / dot_s_s_chosen;
    const float dot_h_h_gap = dot_h_h - dot_s_h * dot_s_h / dot_s_s_total;
    const float rest0 = v[1] - p[1] * dot_s_h_ratio;
    const float rest1 = v[2] - p[2] * dot_s_h_ratio;
    const float dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const float vv = (is_small ? dot_h_h_gap : dot_rest_rest + dot_s_h * dot_s_h_ratio / dot_s_s_total);
    const int near = vv < 0.990393f;
    const float near_chosen = (near ? 1.0097001897226656f * vv : 0.0f);
    const float cosh_r_near = polynomial_cosh_r_near_f(near_chosen);
    const float dot_s_h_ratio_2 = dot_s_h / (near ? 1.0f : dot_s_s_chosen);
    const float rest0_2 = v[1] - p[1] * dot_s_h_ratio_2;
    const float rest1_2 = v[2] - p[2] * dot_s_h_ratio_2;
    const float dot_rest_rest_2 = rest0_2 * rest0_2 + rest1_2 * rest1_2;
    const float vv_2 = (is_small ? dot_h_h_gap : dot_rest_rest_2 + dot_s_h * dot_s_h_ratio_2 / dot_s_s_total);
    const float r = sqrtf((near ? 1.0f : vv_2));
    const float cosh_r = (near ? cosh_r_near : coshf(r));
    const float sinhc_r_near = polynomial_sinhc_r_near_f(near_chosen);
    const float sinhc_r = (near ? sinhc_r_near : sinhf(r) / r);
    const float q0 = a * cosh_r + dot_s_h * sinhc_r / a;
    const float q1 = p[1] * cosh_r + v[1] * sinhc_r;
    const float q2 = p[2] * cosh_r + v[2] * sinhc_r;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
}

void hyperbolic_exp_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT v,
    float *HYPERBOLIC_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_exp_f(p + 3 * i, v + 3 * i, q_out + 3 * i);
}

/* r / sinh_r * ([e, D] - ww / 2 * [a, p[1:]]) */
void hyperbolic_log_f(
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT q,
    float *HYPERBOLIC_RESTRICT v_out) {
    const float S0 = p[1] + q[1];
    const float S1 = p[2] + q[2];
    const float dot_S_S = S0 * S0 + S1 * S1;
    const float D0 = q[1] - p[1];
    const float D1 = q[2] - p[2];
    const float dot_D_D = D0 * D0 + D1 * D1;
    const float dot_D_S = S0 * D0 + S1 * D1;
    const float dot_ps_ps = p[1] * p[1] + p[2] * p[2];
    const float a = sqrtf(1.0f + dot_ps_ps);
    const float dot_qs_qs = q[1] * q[1] + q[2] * q[2];
    const float b = sqrtf(1.0f + dot_qs_qs);
    const float a_total = a + b;
    const float e = dot_D_S / a_total;
    const int is_small = dot_S_S < 1.0f;
    const float dot_D_S_ratio = dot_D_S / (is_small ? 1.0f : dot_S_S);
    const float dot_ps_qs = p[1] * q[1] + p[2] * q[2];
    const float c = (2.0f + b * (2.0f * a) - 2.0f * dot_ps_qs) / (a_total * a_total);
    const float rest0 = D0 - S0 * dot_D_S_ratio;
    const float rest1 = D1 - S1 * dot_D_S_ratio;
    const float dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const float ww = (is_small ? dot_D_D - e * e : dot_rest_rest + dot_D_S_ratio * (dot_D_S * c));
    const int near = ww < 0.458718f;
    const float r_over_sinh_r_near = polynomial_r_over_sinh_r_near_f((near ? 2.1799885768598575f * ww :
        0.0f));
    const float sqrt_ww = sqrtf((near ? 1.0f : ww));
    const float asinh_sqrt_ww_over_2 = asinhf(0.5f * sqrt_ww);
    const float r = 2.0f * asinh_sqrt_ww_over_2;
    const float sinh_r = sqrtf((near ? 1.0f : ww * (1.0f + 0.25f * ww)));
    const float r_over_sinh_r = (near ? r_over_sinh_r_near : r / sinh_r);
    const float scale = 0.5f * ww;
    const float v0 = r_over_sinh_r * (e - a * scale);
    const float v1 = r_over_sinh_r * (D0 - p[1] * scale);
    const float v2 = r_over_sinh_r * (D1 - p[2] * scale);
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void hyperbolic_log_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT q,
    float *HYPERBOLIC_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_log_f(p + 3 * i, q + 3 * i, v_out + 3 * i);
}

/* r */
float hyperbolic_distance_f(const float *HYPERBOLIC_RESTRICT p, const float *HYPERBOLIC_RESTRICT q) {
    const float S0 = p[1] + q[1];
    const float S1 = p[2] + q[2];
    const float dot_S_S = S0 * S0 + S1 * S1;
    const float D0 = q[1] - p[1];
    const float D1 = q[2] - p[2];
    const float dot_D_D = D0 * D0 + D1 * D1;
    const float dot_D_S = S0 * D0 + S1 * D1;
    const float dot_ps_ps = p[1] * p[1] + p[2] * p[2];
    const float a = sqrtf(1.0f + dot_ps_ps);
    const float dot_qs_qs = q[1] * q[1] + q[2] * q[2];
    const float b = sqrtf(1.0f + dot_qs_qs);
    const float a_total = a + b;
    const float e = dot_D_S / a_total;
    const int is_small = dot_S_S < 1.0f;
    const float dot_D_S_ratio = dot_D_S / (is_small ? 1.0f : dot_S_S);
    const float dot_ps_qs = p[1] * q[1] + p[2] * q[2];
    const float c = (2.0f + b * (2.0f * a) - 2.0f * dot_ps_qs) / (a_total * a_total);
    const float rest0 = D0 - S0 * dot_D_S_ratio;
    const float rest1 = D1 - S1 * dot_D_S_ratio;
    const float dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const float ww = (is_small ? dot_D_D - e * e : dot_rest_rest + dot_D_S_ratio * (dot_D_S * c));
    const float sqrt_ww = sqrtf(ww);
    const float asinh_sqrt_ww_over_2 = asinhf(0.5f * sqrt_ww);
    const float r = 2.0f * asinh_sqrt_ww_over_2;
    return r;
}

void hyperbolic_distance_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT q,
    float *HYPERBOLIC_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = hyperbolic_distance_f(p + 3 * i, q + 3 * i);
}

/* log(r_over_sinh_r) */
float hyperbolic_log_abs_det_f(const float *HYPERBOLIC_RESTRICT p, const float *HYPERBOLIC_RESTRICT q) {
    const float S0 = p[1] + q[1];
    const float S1 = p[2] + q[2];
    const float dot_S_S = S0 * S0 + S1 * S1;
    const float D0 = q[1] - p[1];
    const float D1 = q[2] - p[2];
    const float dot_D_D = D0 * D0 + D1 * D1;
    const float dot_D_S = S0 * D0 + S1 * D1;
    const float dot_ps_ps = p[1] * p[1] + p[2] * p[2];
    const float a = sqrtf(1.0f + dot_ps_ps);
    const float dot_qs_qs = q[1] * q[1] + q[2] * q[2];
    const float b = sqrtf(1.0f + dot_qs_qs);
    const float a_total = a + b;
    const float e = dot_D_S / a_total;
    const int is_small = dot_S_S < 1.0f;
    const float dot_D_S_ratio = dot_D_S / (is_small ? 1.0f : dot_S_S);
    const float dot_ps_qs = p[1] * q[1] + p[2] * q[2];
    const float c = (2.0f + b * (2.0f * a) - 2.0f * dot_ps_qs) / (a_total * a_total);
    const float rest0 = D0 - S0 * dot_D_S_ratio;
    const float rest1 = D1 - S1 * dot_D_S_ratio;
    const float dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const float ww = (is_small ? dot_D_D - e * e : dot_rest_rest + dot_D_S_ratio * (dot_D_S * c));
    const int near = ww < 0.458718f;
    const float sqrt_ww = sqrtf((near ? 1.0f : ww));
    const float asinh_sqrt_ww_over_2 = asinhf(0.5f * sqrt_ww);
    const float r = 2.0f * asinh_sqrt_ww_over_2;
    const float sinh_r = sqrtf((near ? 1.0f : ww * (1.0f + 0.25f * ww)));
    const float log_det_series = polynomial_log_det_series_f((near ? 2.1799885768598575f * ww : 0.0f));
    const float log_det_near = ww * log_det_series;
    const float log_det = (near ? log_det_near : logf(r / sinh_r));
    return log_det;
}

void hyperbolic_log_abs_det_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT q,
    float *HYPERBOLIC_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = hyperbolic_log_abs_det_f(p + 3 * i, q + 3 * i);
}

/* the tangential part of G^-1 df */
void hyperbolic_riemannian_gradient_f(
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT df,
    float *HYPERBOLIC_RESTRICT gradient_out) {
    const float normal_part = p[0] * df[0] + p[1] * df[1] + p[2] * df[2];
    const float gradient0 = p[0] * normal_part - df[0];
    const float gradient1 = df[1] + p[1] * normal_part;
    const float gradient2 = df[2] + p[2] * normal_part;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void hyperbolic_riemannian_gradient_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT df,
    float *HYPERBOLIC_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_riemannian_gradient_f(p + 3 * i, df + 3 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
float hyperbolic_gradient_norm_f(const float *HYPERBOLIC_RESTRICT p, const float *HYPERBOLIC_RESTRICT df) {
    const float normal_part = p[0] * df[0] + p[1] * df[1] + p[2] * df[2];
    const float gradient1 = df[1] + p[1] * normal_part;
    const float gradient2 = df[2] + p[2] * normal_part;
    const float dot_s_s = p[1] * p[1] + p[2] * p[2];
    const float dot_h_h = gradient1 * gradient1 + gradient2 * gradient2;
    const float dot_s_h = p[1] * gradient1 + p[2] * gradient2;
    const float dot_s_s_total = 1.0f + dot_s_s;
    const int is_small = dot_s_s < 1.0f;
    const float dot_s_h_ratio = dot_s_h / (is_small ? 1.0f : dot_s_s);
    const float rest0 = gradient1 - p[1] * dot_s_h_ratio;
    const float rest1 = gradient2 - p[2] * dot_s_h_ratio;
    const float dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const float vv = (is_small ? dot_h_h - dot_s_h * dot_s_h / dot_s_s_total : dot_rest_rest + dot_s_h *
        dot_s_h_ratio / dot_s_s_total);
    const float r = sqrtf(vv);
    return r;
}

void hyperbolic_gradient_norm_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT p,
    const float *HYPERBOLIC_RESTRICT df,
    float *HYPERBOLIC_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = hyperbolic_gradient_norm_f(p + 3 * i, df + 3 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void hyperbolic_splat_f(
    const float *HYPERBOLIC_RESTRICT x,
    const float *HYPERBOLIC_RESTRICT mu,
    const float *HYPERBOLIC_RESTRICT W,
    float amplitude,
    float *HYPERBOLIC_RESTRICT value_out,
    float *HYPERBOLIC_RESTRICT gradient_out) {
    const float S0 = x[1] + mu[1];
    const float S1 = x[2] + mu[2];
    const float dot_S_S = S0 * S0 + S1 * S1;
    const float D0 = x[1] - mu[1];
    const float D1 = x[2] - mu[2];
    const float dot_D_D = D0 * D0 + D1 * D1;
    const float dot_D_S = S0 * D0 + S1 * D1;
    const float dot_ps_ps = mu[1] * mu[1] + mu[2] * mu[2];
    const float a = sqrtf(1.0f + dot_ps_ps);
    const float dot_qs_qs = x[1] * x[1] + x[2] * x[2];
    const float dot_qs_qs_total = 1.0f + dot_qs_qs;
    const float b = sqrtf(dot_qs_qs_total);
    const float a_total = a + b;
    const float e = dot_D_S / a_total;
    const int is_small = dot_S_S < 1.0f;
    const float dot_S_S_chosen = (is_small ? 1.0f : dot_S_S);
    const float dot_D_S_ratio = dot_D_S / dot_S_S_chosen;
    const float dot_ps_qs = x[1] * mu[1] + x[2] * mu[2];
    const float squared = a_total * a_total;
    const float a_product = 2.0f * a;
    const float c = (2.0f + b * a_product - 2.0f * dot_ps_qs) / squared;
    const float dot_D_S_product = dot_D_S * c;
    const float rest0 = D0 - S0 * dot_D_S_ratio;
    const float rest1 = D1 - S1 * dot_D_S_ratio;
    const float dot_rest_rest = rest0 * rest0 + rest1 * rest1;
    const float ww = (is_small ? dot_D_D - e * e : dot_rest_rest + dot_D_S_ratio * dot_D_S_product);
    const float total_2 = 1.0f + 0.25f * ww;
    const int near = ww < 0.458718f;
    const float near_chosen = (near ? 2.1799885768598575f * ww : 0.0f);
    const float r_over_sinh_r_near = polynomial_r_over_sinh_r_near_f(near_chosen);
    const float sqrt_ww = sqrtf((near ? 1.0f : ww));
    const float sqrt_ww_product = 0.5f * sqrt_ww;
    const float asinh_sqrt_ww_over_2 = asinhf(sqrt_ww_product);
    const float r = 2.0f * asinh_sqrt_ww_over_2;
    const float sinh_r = sqrtf((near ? 1.0f : ww * total_2));
    const float r_ratio = r / sinh_r;
    const float r_over_sinh_r = (near ? r_over_sinh_r_near : r_ratio);
    const float scale = 0.5f * ww;
    const float e_gap = e - a * scale;
    const float v0 = r_over_sinh_r * e_gap;
    const float D0_gap = D0 - mu[1] * scale;
    const float v1 = r_over_sinh_r * D0_gap;
    const float D1_gap = D1 - mu[2] * scale;
    const float v2 = r_over_sinh_r * D1_gap;
    const float log_det_series = polynomial_log_det_series_f(near_chosen);
    const float log_det_near = ww * log_det_series;
    const float log_det = (near ? log_det_near : logf(r_ratio));
    const float z0 = W[0] * v0 + W[1] * v1 + W[2] * v2;
    const float z1 = W[3] * v0 + W[4] * v1 + W[5] * v2;
    const float exp_2 = expf(log_det - 0.5f * (z0 * z0 + z1 * z1));
    const float phi = amplitude * exp_2;
    const float by_v2 = -(W[5] * z1) - W[2] * z0;
    const float by_v1 = -(W[4] * z1) - W[1] * z0;
    const float by_v0 = -(W[3] * z1) - W[0] * z0;
    const float by_log_det_near = (near ? 1.0f : 0.0f);
    const float by_log_det_series = ww * by_log_det_near;
    const float log_det_series_slope = polynomial_log_det_series_slope_f(near_chosen);
    const float product = r_over_sinh_r * by_v2;
    const float product_2 = r_over_sinh_r * by_v1;
    const float product_3 = r_over_sinh_r * by_v0;
    const float by_r_over_sinh_r = D1_gap * by_v2 + D0_gap * by_v1 + e_gap * by_v0;
    const float by_scale = -(mu[2] * product) - mu[1] * product_2 - a * product_3;
    const float by_r_over_sinh_r_near = (near ? by_r_over_sinh_r : 0.0f);
    const float by_r = ((near ? 0.0f : 1.0f) / r_ratio + (near ? 0.0f : by_r_over_sinh_r)) / sinh_r;
    const float near_chosen_2 = (near ? 0.0f : -(r_ratio * by_r / (2.0f * sinh_r)));
    const float by_asinh_sqrt_ww_over_2 = 2.0f * by_r;
    const float by_sqrt_ww = 0.5f * (by_asinh_sqrt_ww_over_2 / sqrtf(1.0f + sqrt_ww_product *
        sqrt_ww_product));
    const float r_over_sinh_r_near_slope = polynomial_r_over_sinh_r_near_slope_f(near_chosen);
    const float total_3 = log_det_series * by_log_det_near + 0.5f * by_scale + (near ? 0.0f : by_sqrt_ww /
        (2.0f * sqrt_ww)) + 2.1799885768598575f * (near ? by_log_det_series * log_det_series_slope +
        by_r_over_sinh_r_near * r_over_sinh_r_near_slope : 0.0f);
    const float by_ww = total_3 + total_2 * near_chosen_2 + 0.25f * (ww * near_chosen_2);
    const float by_dot_D_D = (is_small ? by_ww : 0.0f);
    const float by_dot_rest_rest = (is_small ? 0.0f : by_ww);
    const float product_4 = dot_D_S_ratio * by_dot_rest_rest;
    const float product_5 = 2.0f * by_dot_rest_rest;
    const float by_rest1 = rest1 * product_5;
    const float by_rest0 = rest0 * product_5;
    const float by_c = dot_D_S * product_4;
    const float by_dot_D_D_product = 2.0f * by_dot_D_D;
    const float by_e = product_3 - e * by_dot_D_D_product;
    const float by_c_ratio = by_c / squared;
    const float product_6 = 2.0f * by_c_ratio;
    const float ratio = (dot_D_S_product * by_dot_rest_rest - S1 * by_rest1 - S0 * by_rest0) / dot_S_S_chosen;
    const float by_dot_S_S = (is_small ? 0.0f : -(dot_D_S_ratio * ratio));
    const float by_e_ratio = by_e / a_total;
    const float by_dot_D_S = c * product_4 + ratio + by_e_ratio;
    const float gap = -(a_total * (2.0f * (c * by_c_ratio))) - e * by_e_ratio;
    const float by_b = a_product * by_c_ratio + gap;
    const int is_small_2 = dot_qs_qs_total == 0.0f;
    const float by_dot_qs_qs = (is_small_2 ? 0.0f : by_b / (2.0f * (is_small_2 ? 1.0f : b)));
    const float product_7 = 2.0f * by_dot_qs_qs;
    const float by_D1 = product + by_rest1 + S1 * by_dot_D_S + D1 * by_dot_D_D_product;
    const float by_D0 = product_2 + by_rest0 + S0 * by_dot_D_S + D0 * by_dot_D_D_product;
    const float by_dot_S_S_product = 2.0f * by_dot_S_S;
    const float by_S1 = D1 * by_dot_D_S - dot_D_S_ratio * by_rest1 + S1 * by_dot_S_S_product;
    const float by_S0 = D0 * by_dot_D_S - dot_D_S_ratio * by_rest0 + S0 * by_dot_S_S_product;
    const float exponent_by_x2 = x[2] * product_7 - mu[2] * product_6 + by_D1 + by_S1;
    const float exponent_by_x1 = x[1] * product_7 - mu[1] * product_6 + by_D0 + by_S0;
    const float df1 = phi * exponent_by_x1;
    const float df2 = phi * exponent_by_x2;
    const float normal_part = x[1] * df1 + x[2] * df2;
    const float gradient0 = x[0] * normal_part;
    const float gradient1 = df1 + x[1] * normal_part;
    const float gradient2 = df2 + x[2] * normal_part;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
    gradient_out[2] = gradient2;
}

void hyperbolic_splat_batch_f(
    size_t count,
    const float *HYPERBOLIC_RESTRICT x,
    const float *HYPERBOLIC_RESTRICT mu,
    const float *HYPERBOLIC_RESTRICT W,
    const float *HYPERBOLIC_RESTRICT amplitude,
    float *HYPERBOLIC_RESTRICT value_out,
    float *HYPERBOLIC_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) hyperbolic_splat_f(x + 3 * i, mu + 3 * i, W + 6 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void hyperbolic_frame_f(const float *HYPERBOLIC_RESTRICT p, float *HYPERBOLIC_RESTRICT frame) {
    float left[3][3];
    for (int i = 0; i < 3; ++i) {
        float axis[3];
        for (int j = 0; j < 3; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        hyperbolic_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        float *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 3; ++i)
            if (hyperbolic_norm_f(p, left[i]) > hyperbolic_norm_f(p, left[longest])) longest = i;
        const float length = hyperbolic_norm_f(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 3; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 3];
            const float part = hyperbolic_inner_f(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}
