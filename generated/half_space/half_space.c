/*
 * half_space: Hyperbolic space H^n of curvature -1 as the upper half of R^n, above the plane where the last
 *
 * See the header for what the functions promise.
 */

#include "half_space.h"

#include <float.h>

/* Of degree 7 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_sinhc_r_near(double x) {
    return 1.0 + x * (0.1650655 + x * (0.008173985787074772 + x * (0.0001927490072784454 + x *
        (2.6513509313345557e-06 + x * (2.3871645886590894e-08 + x * (1.5153577513073096e-10 + x *
        7.253329405682668e-13))))));
}

/* Of degree 7 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_cosh_r_near(double x) {
    return 1.0 + x * (0.4951965000000002 + x * (0.04086992893537111 + x * (0.0013492430509672866 + x *
        (2.386215832545237e-05 + x * (2.6258819438387563e-07 + x * (1.969895131891319e-09 + x *
        1.0901310028051077e-11))))));
}

/* Of degree 10 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_t_over_sinh_t_near(double x) {
    return 1.0 + x * (-0.07645333333333267 + x * (0.0070141346133057005 + x * (-0.0006894693916646029 + x *
        (7.028297406461528e-05 + x * (-7.327302641804558e-06 + x * (7.756073566036173e-07 + x *
        (-8.292331503302048e-08 + x * (8.837138970409671e-09 + x * (-8.75303059047528e-10 + x *
        5.971582399354532e-11)))))))));
}

/* Of degree 10 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_log_det_series(double x) {
    return -0.6666666666666666 + x * (0.0356782222222221 + x * (-0.0026349394579138403 + x *
        (0.0002217367612080702 + x * (-2.003183119568235e-05 + x * (1.8922065620668275e-06 + x *
        (-1.8428477801605567e-07 + x * (1.833644732727326e-08 + x * (-1.8368152828879524e-09 + x *
        (1.7309695344511901e-10 + x * -1.1415832478190767e-11)))))))));
}

/* Of degree 9 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_log_det_series_slope(double x) {
    return 0.0356782222222221 + x * (-0.005269878915827681 + x * (0.0006652102836242106 + x *
        (-8.01273247827294e-05 + x * (9.461032810334137e-06 + x * (-1.1057086680963339e-06 + x *
        (1.2835513129091284e-07 + x * (-1.4694522263103619e-08 + x * (1.5578725810060713e-09 + x *
        -1.1415832478190767e-10))))))));
}

/* Of degree 9 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_t_over_sinh_t_near_slope(double x) {
    return -0.07645333333333267 + x * (0.014028269226611401 + x * (-0.002068408174993809 + x *
        (0.0002811318962584611 + x * (-3.663651320902279e-05 + x * (4.653644139621704e-06 + x *
        (-5.804632052311434e-07 + x * (7.069711176327737e-08 + x * (-7.877727531427753e-09 + x *
        5.971582399354532e-10))))))));
}

/* x */
void half_space_project(const double *HALF_SPACE_RESTRICT x, double *HALF_SPACE_RESTRICT p_out) {
    p_out[0] = x[0];
    p_out[1] = x[1];
}

void half_space_project_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT x,
    double *HALF_SPACE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) half_space_project(x + 2 * i, p_out + 2 * i);
}

/* x */
void half_space_to_tangent(
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT x,
    double *HALF_SPACE_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
}

void half_space_to_tangent_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT x,
    double *HALF_SPACE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) half_space_to_tangent(p + 2 * i, x + 2 * i, v_out + 2 * i);
}

/* dot(u, v) / p[n-1]^2 */
double half_space_inner(
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT u,
    const double *HALF_SPACE_RESTRICT v) {
    return (u[0] * v[0] + u[1] * v[1]) / (p[1] * p[1]);
}

void half_space_inner_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT u,
    const double *HALF_SPACE_RESTRICT v,
    double *HALF_SPACE_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = half_space_inner(p + 2 * i, u + 2 * i, v + 2 * i);
}

/* sqrt(<v, v>_p) */
double half_space_norm(const double *HALF_SPACE_RESTRICT p, const double *HALF_SPACE_RESTRICT v) {
    return sqrt(v[0] * v[0] + v[1] * v[1]) / fabs(p[1]);
}

void half_space_norm_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT v,
    double *HALF_SPACE_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = half_space_norm(p + 2 * i, v + 2 * i);
}

/* G(p) v */
void half_space_flat(
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT v,
    double *HALF_SPACE_RESTRICT covector_out) {
    const double squared = p[1] * p[1];
    const double covector0 = v[0] / squared;
    const double covector1 = v[1] / squared;
    covector_out[0] = covector0;
    covector_out[1] = covector1;
}

void half_space_flat_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT v,
    double *HALF_SPACE_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) half_space_flat(p + 2 * i, v + 2 * i, covector_out + 2 * i);
}

/* [p[:n-1] + y * sinhc(r) / z * h, y / z] */
void half_space_exp(
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT v,
    double *HALF_SPACE_RESTRICT q_out) {
    const double scale = 1.0 / p[1];
    const double v_over_y0 = v[0] * scale;
    const double v_over_y1 = v[1] * scale;
    const double r_squared = v_over_y0 * v_over_y0 + v_over_y1 * v_over_y1;
    const int near = r_squared < 0.990393;
    const double sinhc_r_near = polynomial_sinhc_r_near((near ? 1.0097001897226656 * r_squared : 0.0));
    const double near_chosen = (near ? 1.0 : p[1]);
    const double scale_2 = 1.0 / near_chosen;
    const double v_over_y0_2 = v[0] * scale_2;
    const double v_over_y1_2 = v[1] * scale_2;
    const double r_squared_2 = v_over_y0_2 * v_over_y0_2 + v_over_y1_2 * v_over_y1_2;
    const double r = sqrt((near ? 1.0 : r_squared_2));
    const double sinhc_r = (near ? sinhc_r_near : sinh(r) / r);
    const double k_2 = v[1] / p[1];
    const int is_small = k_2 < 1.0;
    const double chosen = (is_small ? 1.0 : p[1]);
    const double k_3 = v[1] / chosen;
    const double chosen_2 = (is_small ? p[1] : 1.0);
    const double scale_3 = 1.0 / chosen_2;
    const double v_over_y0_3 = v[0] * scale_3;
    const double v_over_y1_3 = v[1] * scale_3;
    const double r_squared_3 = v_over_y0_3 * v_over_y0_3 + v_over_y1_3 * v_over_y1_3;
    const double chosen_3 = (is_small ? (near ? 1.0097001897226656 * r_squared_3 : 0.0) : 0.0);
    const double cosh_r_near = polynomial_cosh_r_near(chosen_3);
    const double scale_4 = 1.0 / (is_small ? near_chosen : 1.0);
    const double v_over_y0_4 = v[0] * scale_4;
    const double v_over_y1_4 = v[1] * scale_4;
    const double r_squared_4 = v_over_y0_4 * v_over_y0_4 + v_over_y1_4 * v_over_y1_4;
    const double r_2 = sqrt((is_small ? (near ? 1.0 : r_squared_4) : 1.0));
    const double r_chosen = (is_small ? r_2 : 0.0);
    const double cosh_r = (near ? cosh_r_near : cosh(r_chosen));
    const double sinhc_r_near_2 = polynomial_sinhc_r_near(chosen_3);
    const double sinhc_r_2 = (near ? sinhc_r_near_2 : sinh(r_chosen) / r_2);
    const double k_4 = v[1] / chosen_2;
    const double scale_5 = 1.0 / chosen;
    const double v_over_y0_5 = v[0] * scale_5;
    const double v_over_y1_5 = v[1] * scale_5;
    const double r_squared_5 = v_over_y0_5 * v_over_y0_5 + v_over_y1_5 * v_over_y1_5;
    const double r_3 = sqrt((is_small ? 1.0 : r_squared_5));
    const double exp_minus_r = exp(-r_3);
    const double sinhc_r_near_3 = polynomial_sinhc_r_near((is_small ? 0.0 : (near ? 1.0097001897226656 *
        r_squared_5 : 0.0)));
    const double scale_6 = 1.0 / (is_small ? 1.0 : near_chosen);
    const double v_over_y0_6 = v[0] * scale_6;
    const double v_over_y1_6 = v[1] * scale_6;
    const double r_squared_6 = v_over_y0_6 * v_over_y0_6 + v_over_y1_6 * v_over_y1_6;
    const double r_4 = sqrt((is_small ? 1.0 : (near ? 1.0 : r_squared_6)));
    const double sinhc_r_3 = (near ? sinhc_r_near_3 : sinh((is_small ? 0.0 : r_4)) / r_4);
    const double h0 = v[0] / chosen;
    const double dot_h_h = h0 * h0;
    const double c = r_3 + k_3;
    const double z = (is_small ? cosh_r - sinhc_r_2 * k_4 : exp_minus_r + sinhc_r_3 * dot_h_h / (is_small ?
        1.0 : c));
    const double q0 = p[0] + v[0] * sinhc_r / z;
    const double q1 = p[1] / z;
    q_out[0] = q0;
    q_out[1] = q1;
}

void half_space_exp_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT v,
    double *HALF_SPACE_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) half_space_exp(p + 2 * i, v + 2 * i, q_out + 2 * i);
}

/* t / sinh_t / z * [y * d[:n-1], up] */
void half_space_log(
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT q,
    double *HALF_SPACE_RESTRICT v_out) {
    const double d0 = q[0] - p[0];
    const double d1 = q[1] - p[1];
    const double sqrt_value = 2.0 * sqrt(p[1] * q[1]);
    const double scale = 1.0 / sqrt_value;
    const double part0 = d0 * scale;
    const double part1 = d1 * scale;
    const double h_squared = part0 * part0 + part1 * part1;
    const double sqrt_1_plus_h_to_2 = sqrt(1.0 + h_squared);
    const int near = h_squared < 0.11468;
    const double t_over_sinh_t_near = polynomial_t_over_sinh_t_near((near ? 8.719916288803628 * h_squared :
        0.0));
    const double h = sqrt((near ? 1.0 : h_squared));
    const double asinh_h = asinh(h);
    const double t = 2.0 * asinh_h;
    const double sinh_t = sqrt_1_plus_h_to_2 * (2.0 * h);
    const double t_over_sinh_t = (near ? t_over_sinh_t_near : t / sinh_t);
    const double dot_ds_ds = d0 * d0;
    const double up = 0.5 * dot_ds_ds + 0.5 * d1 * (p[1] + q[1]);
    const double scale_2 = t_over_sinh_t / q[1];
    const double v0 = scale_2 * (p[1] * d0);
    const double v1 = up * scale_2;
    v_out[0] = v0;
    v_out[1] = v1;
}

void half_space_log_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT q,
    double *HALF_SPACE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) half_space_log(p + 2 * i, q + 2 * i, v_out + 2 * i);
}

/* t */
double half_space_distance(const double *HALF_SPACE_RESTRICT p, const double *HALF_SPACE_RESTRICT q) {
    const double d0 = q[0] - p[0];
    const double d1 = q[1] - p[1];
    const double sqrt_value = 2.0 * sqrt(p[1] * q[1]);
    const double scale = 1.0 / sqrt_value;
    const double part0 = d0 * scale;
    const double part1 = d1 * scale;
    const double h_squared = part0 * part0 + part1 * part1;
    const double h = sqrt(h_squared);
    const double asinh_h = asinh(h);
    const double t = 2.0 * asinh_h;
    return t;
}

void half_space_distance_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT q,
    double *HALF_SPACE_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = half_space_distance(p + 2 * i, q + 2 * i);
}

/* log(t_over_sinh_t) */
double half_space_log_abs_det(const double *HALF_SPACE_RESTRICT p, const double *HALF_SPACE_RESTRICT q) {
    const double d0 = q[0] - p[0];
    const double d1 = q[1] - p[1];
    const double sqrt_value = 2.0 * sqrt(p[1] * q[1]);
    const double scale = 1.0 / sqrt_value;
    const double part0 = d0 * scale;
    const double part1 = d1 * scale;
    const double h_squared = part0 * part0 + part1 * part1;
    const double sqrt_1_plus_h_to_2 = sqrt(1.0 + h_squared);
    const int near = h_squared < 0.11468;
    const double h = sqrt((near ? 1.0 : h_squared));
    const double asinh_h = asinh(h);
    const double t = 2.0 * asinh_h;
    const double sinh_t = sqrt_1_plus_h_to_2 * (2.0 * h);
    const double log_det_series = polynomial_log_det_series((near ? 8.719916288803628 * h_squared : 0.0));
    const double log_det_near = h_squared * log_det_series;
    const double log_det = (near ? log_det_near : log(t / sinh_t));
    return log_det;
}

void half_space_log_abs_det_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT q,
    double *HALF_SPACE_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = half_space_log_abs_det(p + 2 * i, q + 2 * i);
}

/* G(p)^-1 df */
void half_space_riemannian_gradient(
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT df,
    double *HALF_SPACE_RESTRICT gradient_out) {
    const double squared = p[1] * p[1];
    const double gradient0 = df[0] * squared;
    const double gradient1 = df[1] * squared;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void half_space_riemannian_gradient_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT df,
    double *HALF_SPACE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) half_space_riemannian_gradient(p + 2 * i, df + 2 * i, gradient_out + 2 * i);
}

/* |grad f|_p */
double half_space_gradient_norm(const double *HALF_SPACE_RESTRICT p, const double *HALF_SPACE_RESTRICT df) {
    const double squared = p[1] * p[1];
    const double gradient0 = df[0] * squared;
    const double gradient1 = df[1] * squared;
    return sqrt(gradient0 * gradient0 + gradient1 * gradient1) / fabs(p[1]);
}

void half_space_gradient_norm_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT p,
    const double *HALF_SPACE_RESTRICT df,
    double *HALF_SPACE_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = half_space_gradient_norm(p + 2 * i, df + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void half_space_splat(
    const double *HALF_SPACE_RESTRICT x,
    const double *HALF_SPACE_RESTRICT mu,
    const double *HALF_SPACE_RESTRICT W,
    double amplitude,
    double *HALF_SPACE_RESTRICT value_out,
    double *HALF_SPACE_RESTRICT gradient_out) {
    const double d0 = x[0] - mu[0];
    const double d1 = x[1] - mu[1];
    const double product = x[1] * mu[1];
    const double length = sqrt(product);
    const double sqrt_value = 2.0 * length;
    const double scale = 1.0 / sqrt_value;
    const double part0 = d0 * scale;
    const double part1 = d1 * scale;
    const double h_squared = part0 * part0 + part1 * part1;
    const double h_squared_total = 1.0 + h_squared;
    const double sqrt_1_plus_h_to_2 = sqrt(h_squared_total);
    const int near = h_squared < 0.11468;
    const double near_chosen = (near ? 8.719916288803628 * h_squared : 0.0);
    const double t_over_sinh_t_near = polynomial_t_over_sinh_t_near(near_chosen);
    const double near_chosen_2 = (near ? 1.0 : h_squared);
    const double h = sqrt(near_chosen_2);
    const double asinh_h = asinh(h);
    const double t = 2.0 * asinh_h;
    const double h_product = 2.0 * h;
    const double sinh_t = sqrt_1_plus_h_to_2 * h_product;
    const double t_ratio = t / sinh_t;
    const double t_over_sinh_t = (near ? t_over_sinh_t_near : t_ratio);
    const double dot_ds_ds = d0 * d0;
    const double d1_product = 0.5 * d1;
    const double total_2 = x[1] + mu[1];
    const double up = 0.5 * dot_ds_ds + d1_product * total_2;
    const double scale_2 = t_over_sinh_t / x[1];
    const double d0_product = mu[1] * d0;
    const double v0 = scale_2 * d0_product;
    const double v1 = up * scale_2;
    const double log_det_series = polynomial_log_det_series(near_chosen);
    const double log_det_near = h_squared * log_det_series;
    const double log_det = (near ? log_det_near : log(t_ratio));
    const double z0 = W[0] * v0 + W[1] * v1;
    const double z1 = W[2] * v0 + W[3] * v1;
    const double exp_2 = exp(log_det - 0.5 * (z0 * z0 + z1 * z1));
    const double phi = amplitude * exp_2;
    const double by_v1 = -(W[3] * z1) - W[1] * z0;
    const double by_v0 = -(W[2] * z1) - W[0] * z0;
    const double by_log_det_near = (near ? 1.0 : 0.0);
    const double by_log_det_series = h_squared * by_log_det_near;
    const double log_det_series_slope = polynomial_log_det_series_slope(near_chosen);
    const double by_up = scale_2 * by_v1;
    const double by_scale_2 = up * by_v1 + d0_product * by_v0;
    const double by_t_over_sinh_t = by_scale_2 / x[1];
    const double by_t_over_sinh_t_near = (near ? by_t_over_sinh_t : 0.0);
    const double by_t = ((near ? 0.0 : 1.0) / t_ratio + (near ? 0.0 : by_t_over_sinh_t)) / sinh_t;
    const double by_t_product = t_ratio * by_t;
    const double by_asinh_h = 2.0 * by_t;
    const double by_h = by_asinh_h / sqrt(1.0 + near_chosen_2) - 2.0 * (sqrt_1_plus_h_to_2 * by_t_product);
    const double t_over_sinh_t_near_slope = polynomial_t_over_sinh_t_near_slope(near_chosen);
    const double total_3 = log_det_series * by_log_det_near + (near ? 0.0 : by_h / h_product) +
        8.719916288803628 * (near ? by_log_det_series * log_det_series_slope + by_t_over_sinh_t_near *
        t_over_sinh_t_near_slope : 0.0);
    const int is_small = h_squared_total == 0.0;
    const double chosen = (is_small ? 0.0 : -(h_product * by_t_product / (2.0 * (is_small ? 1.0 :
        sqrt_1_plus_h_to_2))));
    const double by_h_squared = total_3 + chosen;
    const double product_2 = 2.0 * by_h_squared;
    const double by_part1 = part1 * product_2;
    const double by_part0 = part0 * product_2;
    const double by_d1 = 0.5 * (total_2 * by_up) + scale * by_part1;
    const double by_d0 = mu[1] * (scale_2 * by_v0) + d0 * by_up + scale * by_part0;
    const double by_scale = d1 * by_part1 + d0 * by_part0;
    const int is_small_2 = product == 0.0;
    const double minus = -(2.0 * (scale * (by_scale / sqrt_value)) / (2.0 * (is_small_2 ? 1.0 : length)));
    const double exponent_by_x1 = by_d1 + (d1_product * by_up - scale_2 * by_t_over_sinh_t + mu[1] *
        (is_small_2 ? 0.0 : minus));
    const double df0 = phi * by_d0;
    const double df1 = phi * exponent_by_x1;
    const double squared = x[1] * x[1];
    const double gradient0 = df0 * squared;
    const double gradient1 = df1 * squared;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void half_space_splat_batch(
    size_t count,
    const double *HALF_SPACE_RESTRICT x,
    const double *HALF_SPACE_RESTRICT mu,
    const double *HALF_SPACE_RESTRICT W,
    const double *HALF_SPACE_RESTRICT amplitude,
    double *HALF_SPACE_RESTRICT value_out,
    double *HALF_SPACE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) half_space_splat(x + 2 * i, mu + 2 * i, W + 4 * i, amplitude[i], value_out + i, gradient_out + 2 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void half_space_frame(const double *HALF_SPACE_RESTRICT p, double *HALF_SPACE_RESTRICT frame) {
    double left[2][2];
    for (int i = 0; i < 2; ++i) {
        double axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0 : 0.0;
        half_space_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        double *e = frame + 2 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (half_space_norm(p, left[i]) > half_space_norm(p, left[longest])) longest = i;
        const double length = half_space_norm(p, left[longest]);
        for (int j = 0; j < 2; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 2];
            const double part = half_space_inner(p, e, rest);
            for (int j = 0; j < 2; ++j) rest[j] -= part * e[j];
        }
    }
}

/* Of degree 4, within 2^-34 of that of double precision. */
static inline float polynomial_sinhc_r_near_f(float x) {
    return 1.0000000000474452f + x * (0.1650654976293945f + x * (0.008174004732127246f + x *
        (0.0001926960533726536f + x * 2.7116592564545465e-06f)));
}

/* Of degree 4, within 2^-30 of that of double precision. */
static inline float polynomial_cosh_r_near_f(float x) {
    return 1.0000000005235519f + x * (0.4951964738439144f + x * (0.04087013792625056f + x *
        (0.0013486590777951736f + x * 2.4526816630031896e-05f)));
}

/* Of degree 5, within 2^-31 of that of double precision. */
static inline float polynomial_t_over_sinh_t_near_f(float x) {
    return 0.9999999997286599f + x * (-0.07645331361267481f + x * (0.007013901478354614f + x *
        (-0.0006884546368422935f + x * (6.82593903267903e-05f + x * -5.404340432232951e-06f))));
}

/* Of degree 4, within 2^-27 of that of double precision. */
static inline float polynomial_log_det_series_f(float x) {
    return -0.6666666638087865f + x * (0.0356780778355629f + x * (-0.0026337661088458894f + x *
        (0.00021836388307107678f + x * -1.5968919256418406e-05f)));
}

/* Of degree 5, within 2^-29 of that of double precision. */
static inline float polynomial_log_det_series_slope_f(float x) {
    return 0.03567822217846793f + x * (-0.005269875733339704f + x * (0.0006651726191066225f + x *
        (-7.996311053059585e-05f + x * (9.132650110662127e-06f + x * -7.919515332371028e-07f))));
}

/* Of degree 5, within 2^-28 of that of double precision. */
static inline float polynomial_t_over_sinh_t_near_slope_f(float x) {
    return -0.07645333313994869f + x * (0.014028255151191082f + x * (-0.0020682414340485013f + x *
        (0.0002804038651811389f + x * (-3.5177113288273015e-05f + x * 3.25255213826865e-06f))));
}

/* x */
void half_space_project_f(const float *HALF_SPACE_RESTRICT x, float *HALF_SPACE_RESTRICT p_out) {
    p_out[0] = x[0];
    p_out[1] = x[1];
}

void half_space_project_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT x,
    float *HALF_SPACE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) half_space_project_f(x + 2 * i, p_out + 2 * i);
}

/* x */
void half_space_to_tangent_f(
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT x,
    float *HALF_SPACE_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
}

void half_space_to_tangent_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT x,
    float *HALF_SPACE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) half_space_to_tangent_f(p + 2 * i, x + 2 * i, v_out + 2 * i);
}

/* dot(u, v) / p[n-1]^2 */
float half_space_inner_f(
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT u,
    const float *HALF_SPACE_RESTRICT v) {
    return (u[0] * v[0] + u[1] * v[1]) / (p[1] * p[1]);
}

void half_space_inner_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT u,
    const float *HALF_SPACE_RESTRICT v,
    float *HALF_SPACE_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = half_space_inner_f(p + 2 * i, u + 2 * i, v + 2 * i);
}

/* sqrt(<v, v>_p) */
float half_space_norm_f(const float *HALF_SPACE_RESTRICT p, const float *HALF_SPACE_RESTRICT v) {
    return sqrtf(v[0] * v[0] + v[1] * v[1]) / fabsf(p[1]);
}

void half_space_norm_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT v,
    float *HALF_SPACE_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = half_space_norm_f(p + 2 * i, v + 2 * i);
}

/* G(p) v */
void half_space_flat_f(
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT v,
    float *HALF_SPACE_RESTRICT covector_out) {
    const float squared = p[1] * p[1];
    const float covector0 = v[0] / squared;
    const float covector1 = v[1] / squared;
    covector_out[0] = covector0;
    covector_out[1] = covector1;
}

void half_space_flat_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT v,
    float *HALF_SPACE_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) half_space_flat_f(p + 2 * i, v + 2 * i, covector_out + 2 * i);
}

/* [p[:n-1] + y * sinhc(r) / z * h, y / z] */
void half_space_exp_f(
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT v,
    float *HALF_SPACE_RESTRICT q_out) {
    const float scale = 1.0f / p[1];
    const float v_over_y0 = v[0] * scale;
    const float v_over_y1 = v[1] * scale;
    const float r_squared = v_over_y0 * v_over_y0 + v_over_y1 * v_over_y1;
    const int near = r_squared < 0.990393f;
    const float sinhc_r_near = polynomial_sinhc_r_near_f((near ? 1.0097001897226656f * r_squared : 0.0f));
    const float near_chosen = (near ? 1.0f : p[1]);
    const float scale_2 = 1.0f / near_chosen;
    const float v_over_y0_2 = v[0] * scale_2;
    const float v_over_y1_2 = v[1] * scale_2;
    const float r_squared_2 = v_over_y0_2 * v_over_y0_2 + v_over_y1_2 * v_over_y1_2;
    const float r = sqrtf((near ? 1.0f : r_squared_2));
    const float sinhc_r = (near ? sinhc_r_near : sinhf(r) / r);
    const float k_2 = v[1] / p[1];
    const int is_small = k_2 < 1.0f;
    const float chosen = (is_small ? 1.0f : p[1]);
    const float k_3 = v[1] / chosen;
    const float chosen_2 = (is_small ? p[1] : 1.0f);
    const float scale_3 = 1.0f / chosen_2;
    const float v_over_y0_3 = v[0] * scale_3;
    const float v_over_y1_3 = v[1] * scale_3;
    const float r_squared_3 = v_over_y0_3 * v_over_y0_3 + v_over_y1_3 * v_over_y1_3;
    const float chosen_3 = (is_small ? (near ? 1.0097001897226656f * r_squared_3 : 0.0f) : 0.0f);
    const float cosh_r_near = polynomial_cosh_r_near_f(chosen_3);
    const float scale_4 = 1.0f / (is_small ? near_chosen : 1.0f);
    const float v_over_y0_4 = v[0] * scale_4;
    const float v_over_y1_4 = v[1] * scale_4;
    const float r_squared_4 = v_over_y0_4 * v_over_y0_4 + v_over_y1_4 * v_over_y1_4;
    const float r_2 = sqrtf((is_small ? (near ? 1.0f : r_squared_4) : 1.0f));
    const float r_chosen = (is_small ? r_2 : 0.0f);
    const float cosh_r = (near ? cosh_r_near : coshf(r_chosen));
    const float sinhc_r_near_2 = polynomial_sinhc_r_near_f(chosen_3);
    const float sinhc_r_2 = (near ? sinhc_r_near_2 : sinhf(r_chosen) / r_2);
    const float k_4 = v[1] / chosen_2;
    const float scale_5 = 1.0f / chosen;
    const float v_over_y0_5 = v[0] * scale_5;
    const float v_over_y1_5 = v[1] * scale_5;
    const float r_squared_5 = v_over_y0_5 * v_over_y0_5 + v_over_y1_5 * v_over_y1_5;
    const float r_3 = sqrtf((is_small ? 1.0f : r_squared_5));
    const float exp_minus_r = expf(-r_3);
    const float sinhc_r_near_3 = polynomial_sinhc_r_near_f((is_small ? 0.0f : (near ? 1.0097001897226656f *
        r_squared_5 : 0.0f)));
    const float scale_6 = 1.0f / (is_small ? 1.0f : near_chosen);
    const float v_over_y0_6 = v[0] * scale_6;
    const float v_over_y1_6 = v[1] * scale_6;
    const float r_squared_6 = v_over_y0_6 * v_over_y0_6 + v_over_y1_6 * v_over_y1_6;
    const float r_4 = sqrtf((is_small ? 1.0f : (near ? 1.0f : r_squared_6)));
    const float sinhc_r_3 = (near ? sinhc_r_near_3 : sinhf((is_small ? 0.0f : r_4)) / r_4);
    const float h0 = v[0] / chosen;
    const float dot_h_h = h0 * h0;
    const float c = r_3 + k_3;
    const float z = (is_small ? cosh_r - sinhc_r_2 * k_4 : exp_minus_r + sinhc_r_3 * dot_h_h / (is_small ?
        1.0f : c));
    const float q0 = p[0] + v[0] * sinhc_r / z;
    const float q1 = p[1] / z;
    q_out[0] = q0;
    q_out[1] = q1;
}

void half_space_exp_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT v,
    float *HALF_SPACE_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) half_space_exp_f(p + 2 * i, v + 2 * i, q_out + 2 * i);
}

/* t / sinh_t / z * [y * d[:n-1], up] */
void half_space_log_f(
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT q,
    float *HALF_SPACE_RESTRICT v_out) {
    const float d0 = q[0] - p[0];
    const float d1 = q[1] - p[1];
    const float sqrt_value = 2.0f * sqrtf(p[1] * q[1]);
    const float scale = 1.0f / sqrt_value;
    const float part0 = d0 * scale;
    const float part1 = d1 * scale;
    const float h_squared = part0 * part0 + part1 * part1;
    const float sqrt_1_plus_h_to_2 = sqrtf(1.0f + h_squared);
    const int near = h_squared < 0.11468f;
    const float t_over_sinh_t_near = polynomial_t_over_sinh_t_near_f((near ? 8.719916288803628f * h_squared :
        0.0f));
    const float h = sqrtf((near ? 1.0f : h_squared));
    const float asinh_h = asinhf(h);
    const float t = 2.0f * asinh_h;
    const float sinh_t = sqrt_1_plus_h_to_2 * (2.0f * h);
    const float t_over_sinh_t = (near ? t_over_sinh_t_near : t / sinh_t);
    const float dot_ds_ds = d0 * d0;
    const float up = 0.5f * dot_ds_ds + 0.5f * d1 * (p[1] + q[1]);
    const float scale_2 = t_over_sinh_t / q[1];
    const float v0 = scale_2 * (p[1] * d0);
    const float v1 = up * scale_2;
    v_out[0] = v0;
    v_out[1] = v1;
}

void half_space_log_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT q,
    float *HALF_SPACE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) half_space_log_f(p + 2 * i, q + 2 * i, v_out + 2 * i);
}

/* t */
float half_space_distance_f(const float *HALF_SPACE_RESTRICT p, const float *HALF_SPACE_RESTRICT q) {
    const float d0 = q[0] - p[0];
    const float d1 = q[1] - p[1];
    const float sqrt_value = 2.0f * sqrtf(p[1] * q[1]);
    const float scale = 1.0f / sqrt_value;
    const float part0 = d0 * scale;
    const float part1 = d1 * scale;
    const float h_squared = part0 * part0 + part1 * part1;
    const float h = sqrtf(h_squared);
    const float asinh_h = asinhf(h);
    const float t = 2.0f * asinh_h;
    return t;
}

void half_space_distance_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT q,
    float *HALF_SPACE_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = half_space_distance_f(p + 2 * i, q + 2 * i);
}

/* log(t_over_sinh_t) */
float half_space_log_abs_det_f(const float *HALF_SPACE_RESTRICT p, const float *HALF_SPACE_RESTRICT q) {
    const float d0 = q[0] - p[0];
    const float d1 = q[1] - p[1];
    const float sqrt_value = 2.0f * sqrtf(p[1] * q[1]);
    const float scale = 1.0f / sqrt_value;
    const float part0 = d0 * scale;
    const float part1 = d1 * scale;
    const float h_squared = part0 * part0 + part1 * part1;
    const float sqrt_1_plus_h_to_2 = sqrtf(1.0f + h_squared);
    const int near = h_squared < 0.11468f;
    const float h = sqrtf((near ? 1.0f : h_squared));
    const float asinh_h = asinhf(h);
    const float t = 2.0f * asinh_h;
    const float sinh_t = sqrt_1_plus_h_to_2 * (2.0f * h);
    const float log_det_series = polynomial_log_det_series_f((near ? 8.719916288803628f * h_squared : 0.0f));
    const float log_det_near = h_squared * log_det_series;
    const float log_det = (near ? log_det_near : logf(t / sinh_t));
    return log_det;
}

void half_space_log_abs_det_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT q,
    float *HALF_SPACE_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = half_space_log_abs_det_f(p + 2 * i, q + 2 * i);
}

/* G(p)^-1 df */
void half_space_riemannian_gradient_f(
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT df,
    float *HALF_SPACE_RESTRICT gradient_out) {
    const float squared = p[1] * p[1];
    const float gradient0 = df[0] * squared;
    const float gradient1 = df[1] * squared;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void half_space_riemannian_gradient_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT df,
    float *HALF_SPACE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) half_space_riemannian_gradient_f(p + 2 * i, df + 2 * i, gradient_out + 2 * i);
}

/* |grad f|_p */
float half_space_gradient_norm_f(const float *HALF_SPACE_RESTRICT p, const float *HALF_SPACE_RESTRICT df) {
    const float squared = p[1] * p[1];
    const float gradient0 = df[0] * squared;
    const float gradient1 = df[1] * squared;
    return sqrtf(gradient0 * gradient0 + gradient1 * gradient1) / fabsf(p[1]);
}

void half_space_gradient_norm_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT p,
    const float *HALF_SPACE_RESTRICT df,
    float *HALF_SPACE_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = half_space_gradient_norm_f(p + 2 * i, df + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void half_space_splat_f(
    const float *HALF_SPACE_RESTRICT x,
    const float *HALF_SPACE_RESTRICT mu,
    const float *HALF_SPACE_RESTRICT W,
    float amplitude,
    float *HALF_SPACE_RESTRICT value_out,
    float *HALF_SPACE_RESTRICT gradient_out) {
    const float d0 = x[0] - mu[0];
    const float d1 = x[1] - mu[1];
    const float product = x[1] * mu[1];
    const float length = sqrtf(product);
    const float sqrt_value = 2.0f * length;
    const float scale = 1.0f / sqrt_value;
    const float part0 = d0 * scale;
    const float part1 = d1 * scale;
    const float h_squared = part0 * part0 + part1 * part1;
    const float h_squared_total = 1.0f + h_squared;
    const float sqrt_1_plus_h_to_2 = sqrtf(h_squared_total);
    const int near = h_squared < 0.11468f;
    const float near_chosen = (near ? 8.719916288803628f * h_squared : 0.0f);
    const float t_over_sinh_t_near = polynomial_t_over_sinh_t_near_f(near_chosen);
    const float near_chosen_2 = (near ? 1.0f : h_squared);
    const float h = sqrtf(near_chosen_2);
    const float asinh_h = asinhf(h);
    const float t = 2.0f * asinh_h;
    const float h_product = 2.0f * h;
    const float sinh_t = sqrt_1_plus_h_to_2 * h_product;
    const float t_ratio = t / sinh_t;
    const float t_over_sinh_t = (near ? t_over_sinh_t_near : t_ratio);
    const float dot_ds_ds = d0 * d0;
    const float d1_product = 0.5f * d1;
    const float total_2 = x[1] + mu[1];
    const float up = 0.5f * dot_ds_ds + d1_product * total_2;
    const float scale_2 = t_over_sinh_t / x[1];
    const float d0_product = mu[1] * d0;
    const float v0 = scale_2 * d0_product;
    const float v1 = up * scale_2;
    const float log_det_series = polynomial_log_det_series_f(near_chosen);
    const float log_det_near = h_squared * log_det_series;
    const float log_det = (near ? log_det_near : logf(t_ratio));
    const float z0 = W[0] * v0 + W[1] * v1;
    const float z1 = W[2] * v0 + W[3] * v1;
    const float exp_2 = expf(log_det - 0.5f * (z0 * z0 + z1 * z1));
    const float phi = amplitude * exp_2;
    const float by_v1 = -(W[3] * z1) - W[1] * z0;
    const float by_v0 = -(W[2] * z1) - W[0] * z0;
    const float by_log_det_near = (near ? 1.0f : 0.0f);
    const float by_log_det_series = h_squared * by_log_det_near;
    const float log_det_series_slope = polynomial_log_det_series_slope_f(near_chosen);
    const float by_up = scale_2 * by_v1;
    const float by_scale_2 = up * by_v1 + d0_product * by_v0;
    const float by_t_over_sinh_t = by_scale_2 / x[1];
    const float by_t_over_sinh_t_near = (near ? by_t_over_sinh_t : 0.0f);
    const float by_t = ((near ? 0.0f : 1.0f) / t_ratio + (near ? 0.0f : by_t_over_sinh_t)) / sinh_t;
    const float by_t_product = t_ratio * by_t;
    const float by_asinh_h = 2.0f * by_t;
    const float by_h = by_asinh_h / sqrtf(1.0f + near_chosen_2) - 2.0f * (sqrt_1_plus_h_to_2 * by_t_product);
    const float t_over_sinh_t_near_slope = polynomial_t_over_sinh_t_near_slope_f(near_chosen);
    const float total_3 = log_det_series * by_log_det_near + (near ? 0.0f : by_h / h_product) +
        8.719916288803628f * (near ? by_log_det_series * log_det_series_slope + by_t_over_sinh_t_near *
        t_over_sinh_t_near_slope : 0.0f);
    const int is_small = h_squared_total == 0.0f;
    const float chosen = (is_small ? 0.0f : -(h_product * by_t_product / (2.0f * (is_small ? 1.0f :
        sqrt_1_plus_h_to_2))));
    const float by_h_squared = total_3 + chosen;
    const float product_2 = 2.0f * by_h_squared;
    const float by_part1 = part1 * product_2;
    const float by_part0 = part0 * product_2;
    const float by_d1 = 0.5f * (total_2 * by_up) + scale * by_part1;
    const float by_d0 = mu[1] * (scale_2 * by_v0) + d0 * by_up + scale * by_part0;
    const float by_scale = d1 * by_part1 + d0 * by_part0;
    const int is_small_2 = product == 0.0f;
    const float minus = -(2.0f * (scale * (by_scale / sqrt_value)) / (2.0f * (is_small_2 ? 1.0f : length)));
    const float exponent_by_x1 = by_d1 + (d1_product * by_up - scale_2 * by_t_over_sinh_t + mu[1] *
        (is_small_2 ? 0.0f : minus));
    const float df0 = phi * by_d0;
    const float df1 = phi * exponent_by_x1;
    const float squared = x[1] * x[1];
    const float gradient0 = df0 * squared;
    const float gradient1 = df1 * squared;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void half_space_splat_batch_f(
    size_t count,
    const float *HALF_SPACE_RESTRICT x,
    const float *HALF_SPACE_RESTRICT mu,
    const float *HALF_SPACE_RESTRICT W,
    const float *HALF_SPACE_RESTRICT amplitude,
    float *HALF_SPACE_RESTRICT value_out,
    float *HALF_SPACE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) half_space_splat_f(x + 2 * i, mu + 2 * i, W + 4 * i, amplitude[i], value_out + i, gradient_out + 2 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void half_space_frame_f(const float *HALF_SPACE_RESTRICT p, float *HALF_SPACE_RESTRICT frame) {
    float left[2][2];
    for (int i = 0; i < 2; ++i) {
        float axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        half_space_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        float *e = frame + 2 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (half_space_norm_f(p, left[i]) > half_space_norm_f(p, left[longest])) longest = i;
        const float length = half_space_norm_f(p, left[longest]);
        for (int j = 0; j < 2; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 2];
            const float part = half_space_inner_f(p, e, rest);
            for (int j = 0; j < 2; ++j) rest[j] -= part * e[j];
        }
    }
}
