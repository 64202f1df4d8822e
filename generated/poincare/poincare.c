/*
 * poincare: Hyperbolic space H^n of curvature -1 as the unit ball, in which angles are those of R^n (the
 *
 * See the header for what the functions promise.
 */

#include "poincare.h"

#include <float.h>

/* Of degree 8 on [0, 1], its relative error below 2^-56. */
static inline double polynomial_t_over_r_near(double x) {
    return 1.0 + x * (-0.03675566666666605 + x * (0.0016211748385168904 + x * (-7.235608222843233e-05 + x *
        (3.233111978970216e-06 + x * (-1.444816237404098e-07 + x * (6.4526839940018596e-09 + x *
        (-2.843223247528475e-10 + x * 1.0565261682358543e-11)))))));
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
void poincare_project(const double *POINCARE_RESTRICT x, double *POINCARE_RESTRICT p_out) {
    p_out[0] = x[0];
    p_out[1] = x[1];
}

void poincare_project_batch(size_t count, const double *POINCARE_RESTRICT x, double *POINCARE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) poincare_project(x + 2 * i, p_out + 2 * i);
}

/* x */
void poincare_to_tangent(
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT x,
    double *POINCARE_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
}

void poincare_to_tangent_batch(
    size_t count,
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT x,
    double *POINCARE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) poincare_to_tangent(p + 2 * i, x + 2 * i, v_out + 2 * i);
}

/* 4 * dot(u, v) / (1 - dot(p, p))^2 */
double poincare_inner(
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT u,
    const double *POINCARE_RESTRICT v) {
    const double gap = 1.0 - p[0] * p[0] - p[1] * p[1];
    return 4.0 * (u[0] * v[0] + u[1] * v[1]) / (gap * gap);
}

void poincare_inner_batch(
    size_t count,
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT u,
    const double *POINCARE_RESTRICT v,
    double *POINCARE_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = poincare_inner(p + 2 * i, u + 2 * i, v + 2 * i);
}

/* sqrt(<v, v>_p) */
double poincare_norm(const double *POINCARE_RESTRICT p, const double *POINCARE_RESTRICT v) {
    const double ratio = 2.0 * sqrt(v[0] * v[0] + v[1] * v[1]) / fabs(p[0] * p[0] + p[1] * p[1] - 1.0);
    return ratio;
}

void poincare_norm_batch(
    size_t count,
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT v,
    double *POINCARE_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = poincare_norm(p + 2 * i, v + 2 * i);
}

/* G(p) v */
void poincare_flat(
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT v,
    double *POINCARE_RESTRICT covector_out) {
    const double gap = 1.0 - p[0] * p[0] - p[1] * p[1];
    const double squared = gap * gap;
    const double covector0 = 4.0 * v[0] / squared;
    const double covector1 = 4.0 * v[1] / squared;
    covector_out[0] = covector0;
    covector_out[1] = covector1;
}

void poincare_flat_batch(
    size_t count,
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT v,
    double *POINCARE_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) poincare_flat(p + 2 * i, v + 2 * i, covector_out + 2 * i);
}

/* (ss * p + a * s) / (ss + a / cosh(r)^2) */
void poincare_exp(
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT v,
    double *POINCARE_RESTRICT q_out) {
    const double dot_p_p = p[0] * p[0] + p[1] * p[1];
    const double a = 1.0 - dot_p_p;
    const double scale = 1.0 / a;
    const double w0 = v[0] * scale;
    const double w1 = v[1] * scale;
    const double r_squared = w0 * w0 + w1 * w1;
    const int near = r_squared < 0.110267;
    const double t_over_r_near = polynomial_t_over_r_near((near ? 9.068896405996353 * r_squared : 0.0));
    const double r = sqrt((near ? 1.0 : r_squared));
    const double t = tanh(r);
    const double t_over_r = (near ? t_over_r_near : t / r);
    const double scale_2 = t_over_r / a;
    const double s0 = p[0] + v[0] * scale_2;
    const double s1 = p[1] + v[1] * scale_2;
    const double ss = s0 * s0 + s1 * s1;
    const int near_2 = r_squared < 0.990393;
    const double cosh_r_near = polynomial_cosh_r_near((near_2 ? 1.0097001897226656 * r_squared : 0.0));
    const double scale_3 = 1.0 / (near_2 ? 1.0 : a);
    const double w0_2 = v[0] * scale_3;
    const double w1_2 = v[1] * scale_3;
    const double r_squared_2 = w0_2 * w0_2 + w1_2 * w1_2;
    const double r_2 = sqrt((near_2 ? 1.0 : r_squared_2));
    const double cosh_r = (near_2 ? cosh_r_near : cosh(r_2));
    const double scale_3_2 = 1.0 / (ss + a / (cosh_r * cosh_r));
    const double q0 = scale_3_2 * (a * s0 + p[0] * ss);
    const double q1 = scale_3_2 * (a * s1 + p[1] * ss);
    q_out[0] = q0;
    q_out[1] = q1;
}

void poincare_exp_batch(
    size_t count,
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT v,
    double *POINCARE_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) poincare_exp(p + 2 * i, v + 2 * i, q_out + 2 * i);
}

/* t / sinh_t / b * (a * d - dd * p) */
void poincare_log(
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT q,
    double *POINCARE_RESTRICT v_out) {
    const double d0 = q[0] - p[0];
    const double d1 = q[1] - p[1];
    const double dot_p_p = p[0] * p[0] + p[1] * p[1];
    const double a = 1.0 - dot_p_p;
    const double dot_q_q = q[0] * q[0] + q[1] * q[1];
    const double b = 1.0 - dot_q_q;
    const double sqrt_a_times_b = sqrt(a * b);
    const double scale = 1.0 / sqrt_a_times_b;
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
    const double dd = d0 * d0 + d1 * d1;
    const double scale_2 = t_over_sinh_t / b;
    const double v0 = scale_2 * (d0 * a - p[0] * dd);
    const double v1 = scale_2 * (d1 * a - p[1] * dd);
    v_out[0] = v0;
    v_out[1] = v1;
}

void poincare_log_batch(
    size_t count,
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT q,
    double *POINCARE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) poincare_log(p + 2 * i, q + 2 * i, v_out + 2 * i);
}

/* t */
double poincare_distance(const double *POINCARE_RESTRICT p, const double *POINCARE_RESTRICT q) {
    const double d0 = q[0] - p[0];
    const double d1 = q[1] - p[1];
    const double dot_p_p = p[0] * p[0] + p[1] * p[1];
    const double a = 1.0 - dot_p_p;
    const double dot_q_q = q[0] * q[0] + q[1] * q[1];
    const double b = 1.0 - dot_q_q;
    const double sqrt_a_times_b = sqrt(a * b);
    const double scale = 1.0 / sqrt_a_times_b;
    const double part0 = d0 * scale;
    const double part1 = d1 * scale;
    const double h_squared = part0 * part0 + part1 * part1;
    const double h = sqrt(h_squared);
    const double asinh_h = asinh(h);
    const double t = 2.0 * asinh_h;
    return t;
}

void poincare_distance_batch(
    size_t count,
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT q,
    double *POINCARE_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = poincare_distance(p + 2 * i, q + 2 * i);
}

/* log(t_over_sinh_t) */
double poincare_log_abs_det(const double *POINCARE_RESTRICT p, const double *POINCARE_RESTRICT q) {
    const double d0 = q[0] - p[0];
    const double d1 = q[1] - p[1];
    const double dot_p_p = p[0] * p[0] + p[1] * p[1];
    const double a = 1.0 - dot_p_p;
    const double dot_q_q = q[0] * q[0] + q[1] * q[1];
    const double b = 1.0 - dot_q_q;
    const double sqrt_a_times_b = sqrt(a * b);
    const double scale = 1.0 / sqrt_a_times_b;
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

void poincare_log_abs_det_batch(
    size_t count,
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT q,
    double *POINCARE_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = poincare_log_abs_det(p + 2 * i, q + 2 * i);
}

/* G(p)^-1 df */
void poincare_riemannian_gradient(
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT df,
    double *POINCARE_RESTRICT gradient_out) {
    const double gap = 1.0 - p[0] * p[0] - p[1] * p[1];
    const double squared = gap * gap;
    const double gradient0 = 0.25 * df[0] * squared;
    const double gradient1 = squared * (0.25 * df[1]);
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void poincare_riemannian_gradient_batch(
    size_t count,
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT df,
    double *POINCARE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) poincare_riemannian_gradient(p + 2 * i, df + 2 * i, gradient_out + 2 * i);
}

/* |grad f|_p */
double poincare_gradient_norm(const double *POINCARE_RESTRICT p, const double *POINCARE_RESTRICT df) {
    const double squared = p[0] * p[0];
    const double squared_2 = p[1] * p[1];
    const double gap = 1.0 - squared - squared_2;
    const double squared_3 = gap * gap;
    const double gradient0 = 0.25 * df[0] * squared_3;
    const double gradient1 = squared_3 * (0.25 * df[1]);
    const double ratio = 2.0 * sqrt(gradient0 * gradient0 + gradient1 * gradient1) / fabs(squared + squared_2
        - 1.0);
    return ratio;
}

void poincare_gradient_norm_batch(
    size_t count,
    const double *POINCARE_RESTRICT p,
    const double *POINCARE_RESTRICT df,
    double *POINCARE_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = poincare_gradient_norm(p + 2 * i, df + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void poincare_splat(
    const double *POINCARE_RESTRICT x,
    const double *POINCARE_RESTRICT mu,
    const double *POINCARE_RESTRICT W,
    double amplitude,
    double *POINCARE_RESTRICT value_out,
    double *POINCARE_RESTRICT gradient_out) {
    const double d0 = x[0] - mu[0];
    const double d1 = x[1] - mu[1];
    const double dot_p_p = mu[0] * mu[0] + mu[1] * mu[1];
    const double a = 1.0 - dot_p_p;
    const double squared = x[0] * x[0];
    const double squared_2 = x[1] * x[1];
    const double dot_q_q = squared + squared_2;
    const double b = 1.0 - dot_q_q;
    const double a_product = a * b;
    const double sqrt_a_times_b = sqrt(a_product);
    const double scale = 1.0 / sqrt_a_times_b;
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
    const double dd = d0 * d0 + d1 * d1;
    const double scale_2 = t_over_sinh_t / b;
    const double gap = d0 * a - mu[0] * dd;
    const double v0 = scale_2 * gap;
    const double gap_2 = d1 * a - mu[1] * dd;
    const double v1 = scale_2 * gap_2;
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
    const double scale_2_product = scale_2 * by_v1;
    const double scale_2_product_2 = scale_2 * by_v0;
    const double by_scale_2 = gap_2 * by_v1 + gap * by_v0;
    const double by_dd = -(mu[1] * scale_2_product) - mu[0] * scale_2_product_2;
    const double by_t_over_sinh_t = by_scale_2 / b;
    const double by_dd_product = 2.0 * by_dd;
    const double by_t_over_sinh_t_near = (near ? by_t_over_sinh_t : 0.0);
    const double by_t = ((near ? 0.0 : 1.0) / t_ratio + (near ? 0.0 : by_t_over_sinh_t)) / sinh_t;
    const double by_t_product = t_ratio * by_t;
    const double by_asinh_h = 2.0 * by_t;
    const double by_h = by_asinh_h / sqrt(1.0 + near_chosen_2) - 2.0 * (sqrt_1_plus_h_to_2 * by_t_product);
    const double t_over_sinh_t_near_slope = polynomial_t_over_sinh_t_near_slope(near_chosen);
    const double total_2 = log_det_series * by_log_det_near + (near ? 0.0 : by_h / h_product) +
        8.719916288803628 * (near ? by_log_det_series * log_det_series_slope + by_t_over_sinh_t_near *
        t_over_sinh_t_near_slope : 0.0);
    const int is_small = h_squared_total == 0.0;
    const double chosen = (is_small ? 0.0 : -(h_product * by_t_product / (2.0 * (is_small ? 1.0 :
        sqrt_1_plus_h_to_2))));
    const double by_h_squared = total_2 + chosen;
    const double product = 2.0 * by_h_squared;
    const double by_part1 = part1 * product;
    const double by_part0 = part0 * product;
    const double by_d1 = a * scale_2_product + d1 * by_dd_product + scale * by_part1;
    const double by_d0 = a * scale_2_product_2 + d0 * by_dd_product + scale * by_part0;
    const double by_scale = d1 * by_part1 + d0 * by_part0;
    const int is_small_2 = a_product == 0.0;
    const double chosen_2 = (is_small_2 ? 0.0 : -(scale * (by_scale / sqrt_a_times_b) / (2.0 * (is_small_2 ?
        1.0 : sqrt_a_times_b))));
    const double by_dot_q_q = scale_2 * by_t_over_sinh_t - a * chosen_2;
    const double by_dot_q_q_product = 2.0 * by_dot_q_q;
    const double exponent_by_x1 = by_d1 + x[1] * by_dot_q_q_product;
    const double exponent_by_x0 = by_d0 + x[0] * by_dot_q_q_product;
    const double df0 = phi * exponent_by_x0;
    const double df1 = phi * exponent_by_x1;
    const double gap_3 = 1.0 - squared - squared_2;
    const double squared_3 = gap_3 * gap_3;
    const double gradient0 = 0.25 * df0 * squared_3;
    const double gradient1 = squared_3 * (0.25 * df1);
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void poincare_splat_batch(
    size_t count,
    const double *POINCARE_RESTRICT x,
    const double *POINCARE_RESTRICT mu,
    const double *POINCARE_RESTRICT W,
    const double *POINCARE_RESTRICT amplitude,
    double *POINCARE_RESTRICT value_out,
    double *POINCARE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) poincare_splat(x + 2 * i, mu + 2 * i, W + 4 * i, amplitude[i], value_out + i, gradient_out + 2 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void poincare_frame(const double *POINCARE_RESTRICT p, double *POINCARE_RESTRICT frame) {
    double left[2][2];
    for (int i = 0; i < 2; ++i) {
        double axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0 : 0.0;
        poincare_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        double *e = frame + 2 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (poincare_norm(p, left[i]) > poincare_norm(p, left[longest])) longest = i;
        const double length = poincare_norm(p, left[longest]);
        for (int j = 0; j < 2; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 2];
            const double part = poincare_inner(p, e, rest);
            for (int j = 0; j < 2; ++j) rest[j] -= part * e[j];
        }
    }
}

/* Of degree 4, within 2^-31 of that of double precision. */
static inline float polynomial_t_over_r_near_f(float x) {
    return 0.9999999997499068f + x * (-0.03675565410108691f + x * (0.001621073576453727f + x *
        (-7.206906495386258e-05f + x * 2.8969832702796903e-06f)));
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
void poincare_project_f(const float *POINCARE_RESTRICT x, float *POINCARE_RESTRICT p_out) {
    p_out[0] = x[0];
    p_out[1] = x[1];
}

void poincare_project_batch_f(size_t count, const float *POINCARE_RESTRICT x, float *POINCARE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) poincare_project_f(x + 2 * i, p_out + 2 * i);
}

/* x */
void poincare_to_tangent_f(
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT x,
    float *POINCARE_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
}

void poincare_to_tangent_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT x,
    float *POINCARE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) poincare_to_tangent_f(p + 2 * i, x + 2 * i, v_out + 2 * i);
}

/* 4 * dot(u, v) / (1 - dot(p, p))^2 */
float poincare_inner_f(
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT u,
    const float *POINCARE_RESTRICT v) {
    const float gap = 1.0f - p[0] * p[0] - p[1] * p[1];
    return 4.0f * (u[0] * v[0] + u[1] * v[1]) / (gap * gap);
}

void poincare_inner_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT u,
    const float *POINCARE_RESTRICT v,
    float *POINCARE_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = poincare_inner_f(p + 2 * i, u + 2 * i, v + 2 * i);
}

/* sqrt(<v, v>_p) */
float poincare_norm_f(const float *POINCARE_RESTRICT p, const float *POINCARE_RESTRICT v) {
    const float ratio = 2.0f * sqrtf(v[0] * v[0] + v[1] * v[1]) / fabsf(p[0] * p[0] + p[1] * p[1] - 1.0f);
    return ratio;
}

void poincare_norm_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT v,
    float *POINCARE_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = poincare_norm_f(p + 2 * i, v + 2 * i);
}

/* G(p) v */
void poincare_flat_f(
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT v,
    float *POINCARE_RESTRICT covector_out) {
    const float gap = 1.0f - p[0] * p[0] - p[1] * p[1];
    const float squared = gap * gap;
    const float covector0 = 4.0f * v[0] / squared;
    const float covector1 = 4.0f * v[1] / squared;
    covector_out[0] = covector0;
    covector_out[1] = covector1;
}

void poincare_flat_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT v,
    float *POINCARE_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) poincare_flat_f(p + 2 * i, v + 2 * i, covector_out + 2 * i);
}

/* (ss * p + a * s) / (ss + a / cosh(r)^2) */
void poincare_exp_f(
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT v,
    float *POINCARE_RESTRICT q_out) {
    const float dot_p_p = p[0] * p[0] + p[1] * p[1];
    const float a = 1.0f - dot_p_p;
    const float scale = 1.0f / a;
    const float w0 = v[0] * scale;
    const float w1 = v[1] * scale;
    const float r_squared = w0 * w0 + w1 * w1;
    const int near = r_squared < 0.110267f;
    const float t_over_r_near = polynomial_t_over_r_near_f((near ? 9.068896405996353f * r_squared : 0.0f));
    const float r = sqrtf((near ? 1.0f : r_squared));
    const float t = tanhf(r);
    const float t_over_r = (near ? t_over_r_near : t / r);
    const float scale_2 = t_over_r / a;
    const float s0 = p[0] + v[0] * scale_2;
    const float s1 = p[1] + v[1] * scale_2;
    const float ss = s0 * s0 + s1 * s1;
    const int near_2 = r_squared < 0.990393f;
    const float cosh_r_near = polynomial_cosh_r_near_f((near_2 ? 1.0097001897226656f * r_squared : 0.0f));
    const float scale_3 = 1.0f / (near_2 ? 1.0f : a);
    const float w0_2 = v[0] * scale_3;
    const float w1_2 = v[1] * scale_3;
    const float r_squared_2 = w0_2 * w0_2 + w1_2 * w1_2;
    const float r_2 = sqrtf((near_2 ? 1.0f : r_squared_2));
    const float cosh_r = (near_2 ? cosh_r_near : coshf(r_2));
    const float scale_3_2 = 1.0f / (ss + a / (cosh_r * cosh_r));
    const float q0 = scale_3_2 * (a * s0 + p[0] * ss);
    const float q1 = scale_3_2 * (a * s1 + p[1] * ss);
    q_out[0] = q0;
    q_out[1] = q1;
}

void poincare_exp_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT v,
    float *POINCARE_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) poincare_exp_f(p + 2 * i, v + 2 * i, q_out + 2 * i);
}

/* t / sinh_t / b * (a * d - dd * p) */
void poincare_log_f(
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT q,
    float *POINCARE_RESTRICT v_out) {
    const float d0 = q[0] - p[0];
    const float d1 = q[1] - p[1];
    const float dot_p_p = p[0] * p[0] + p[1] * p[1];
    const float a = 1.0f - dot_p_p;
    const float dot_q_q = q[0] * q[0] + q[1] * q[1];
    const float b = 1.0f - dot_q_q;
    const float sqrt_a_times_b = sqrtf(a * b);
    const float scale = 1.0f / sqrt_a_times_b;
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
    const float dd = d0 * d0 + d1 * d1;
    const float scale_2 = t_over_sinh_t / b;
    const float v0 = scale_2 * (d0 * a - p[0] * dd);
    const float v1 = scale_2 * (d1 * a - p[1] * dd);
    v_out[0] = v0;
    v_out[1] = v1;
}

void poincare_log_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT q,
    float *POINCARE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) poincare_log_f(p + 2 * i, q + 2 * i, v_out + 2 * i);
}

/* t */
float poincare_distance_f(const float *POINCARE_RESTRICT p, const float *POINCARE_RESTRICT q) {
    const float d0 = q[0] - p[0];
    const float d1 = q[1] - p[1];
    const float dot_p_p = p[0] * p[0] + p[1] * p[1];
    const float a = 1.0f - dot_p_p;
    const float dot_q_q = q[0] * q[0] + q[1] * q[1];
    const float b = 1.0f - dot_q_q;
    const float sqrt_a_times_b = sqrtf(a * b);
    const float scale = 1.0f / sqrt_a_times_b;
    const float part0 = d0 * scale;
    const float part1 = d1 * scale;
    const float h_squared = part0 * part0 + part1 * part1;
    const float h = sqrtf(h_squared);
    const float asinh_h = asinhf(h);
    const float t = 2.0f * asinh_h;
    return t;
}

void poincare_distance_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT q,
    float *POINCARE_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = poincare_distance_f(p + 2 * i, q + 2 * i);
}

/* log(t_over_sinh_t) */
float poincare_log_abs_det_f(const float *POINCARE_RESTRICT p, const float *POINCARE_RESTRICT q) {
    const float d0 = q[0] - p[0];
    const float d1 = q[1] - p[1];
    const float dot_p_p = p[0] * p[0] + p[1] * p[1];
    const float a = 1.0f - dot_p_p;
    const float dot_q_q = q[0] * q[0] + q[1] * q[1];
    const float b = 1.0f - dot_q_q;
    const float sqrt_a_times_b = sqrtf(a * b);
    const float scale = 1.0f / sqrt_a_times_b;
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

void poincare_log_abs_det_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT q,
    float *POINCARE_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = poincare_log_abs_det_f(p + 2 * i, q + 2 * i);
}

/* G(p)^-1 df */
void poincare_riemannian_gradient_f(
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT df,
    float *POINCARE_RESTRICT gradient_out) {
    const float gap = 1.0f - p[0] * p[0] - p[1] * p[1];
    const float squared = gap * gap;
    const float gradient0 = 0.25f * df[0] * squared;
    const float gradient1 = squared * (0.25f * df[1]);
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void poincare_riemannian_gradient_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT df,
    float *POINCARE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) poincare_riemannian_gradient_f(p + 2 * i, df + 2 * i, gradient_out + 2 * i);
}

/* |grad f|_p */
float poincare_gradient_norm_f(const float *POINCARE_RESTRICT p, const float *POINCARE_RESTRICT df) {
    const float squared = p[0] * p[0];
    const float squared_2 = p[1] * p[1];
    const float gap = 1.0f - squared - squared_2;
    const float squared_3 = gap * gap;
    const float gradient0 = 0.25f * df[0] * squared_3;
    const float gradient1 = squared_3 * (0.25f * df[1]);
    const float ratio = 2.0f * sqrtf(gradient0 * gradient0 + gradient1 * gradient1) / fabsf(squared +
        squared_2 - 1.0f);
    return ratio;
}

void poincare_gradient_norm_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT p,
    const float *POINCARE_RESTRICT df,
    float *POINCARE_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = poincare_gradient_norm_f(p + 2 * i, df + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void poincare_splat_f(
    const float *POINCARE_RESTRICT x,
    const float *POINCARE_RESTRICT mu,
    const float *POINCARE_RESTRICT W,
    float amplitude,
    float *POINCARE_RESTRICT value_out,
    float *POINCARE_RESTRICT gradient_out) {
    const float d0 = x[0] - mu[0];
    const float d1 = x[1] - mu[1];
    const float dot_p_p = mu[0] * mu[0] + mu[1] * mu[1];
    const float a = 1.0f - dot_p_p;
    const float squared = x[0] * x[0];
    const float squared_2 = x[1] * x[1];
    const float dot_q_q = squared + squared_2;
    const float b = 1.0f - dot_q_q;
    const float a_product = a * b;
    const float sqrt_a_times_b = sqrtf(a_product);
    const float scale = 1.0f / sqrt_a_times_b;
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
    const float dd = d0 * d0 + d1 * d1;
    const float scale_2 = t_over_sinh_t / b;
    const float gap = d0 * a - mu[0] * dd;
    const float v0 = scale_2 * gap;
    const float gap_2 = d1 * a - mu[1] * dd;
    const float v1 = scale_2 * gap_2;
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
    const float scale_2_product = scale_2 * by_v1;
    const float scale_2_product_2 = scale_2 * by_v0;
    const float by_scale_2 = gap_2 * by_v1 + gap * by_v0;
    const float by_dd = -(mu[1] * scale_2_product) - mu[0] * scale_2_product_2;
    const float by_t_over_sinh_t = by_scale_2 / b;
    const float by_dd_product = 2.0f * by_dd;
    const float by_t_over_sinh_t_near = (near ? by_t_over_sinh_t : 0.0f);
    const float by_t = ((near ? 0.0f : 1.0f) / t_ratio + (near ? 0.0f : by_t_over_sinh_t)) / sinh_t;
    const float by_t_product = t_ratio * by_t;
    const float by_asinh_h = 2.0f * by_t;
    const float by_h = by_asinh_h / sqrtf(1.0f + near_chosen_2) - 2.0f * (sqrt_1_plus_h_to_2 * by_t_product);
    const float t_over_sinh_t_near_slope = polynomial_t_over_sinh_t_near_slope_f(near_chosen);
    const float total_2 = log_det_series * by_log_det_near + (near ? 0.0f : by_h / h_product) +
        8.719916288803628f * (near ? by_log_det_series * log_det_series_slope + by_t_over_sinh_t_near *
        t_over_sinh_t_near_slope : 0.0f);
    const int is_small = h_squared_total == 0.0f;
    const float chosen = (is_small ? 0.0f : -(h_product * by_t_product / (2.0f * (is_small ? 1.0f :
        sqrt_1_plus_h_to_2))));
    const float by_h_squared = total_2 + chosen;
    const float product = 2.0f * by_h_squared;
    const float by_part1 = part1 * product;
    const float by_part0 = part0 * product;
    const float by_d1 = a * scale_2_product + d1 * by_dd_product + scale * by_part1;
    const float by_d0 = a * scale_2_product_2 + d0 * by_dd_product + scale * by_part0;
    const float by_scale = d1 * by_part1 + d0 * by_part0;
    const int is_small_2 = a_product == 0.0f;
    const float chosen_2 = (is_small_2 ? 0.0f : -(scale * (by_scale / sqrt_a_times_b) / (2.0f * (is_small_2 ?
        1.0f : sqrt_a_times_b))));
    const float by_dot_q_q = scale_2 * by_t_over_sinh_t - a * chosen_2;
    const float by_dot_q_q_product = 2.0f * by_dot_q_q;
    const float exponent_by_x1 = by_d1 + x[1] * by_dot_q_q_product;
    const float exponent_by_x0 = by_d0 + x[0] * by_dot_q_q_product;
    const float df0 = phi * exponent_by_x0;
    const float df1 = phi * exponent_by_x1;
    const float gap_3 = 1.0f - squared - squared_2;
    const float squared_3 = gap_3 * gap_3;
    const float gradient0 = 0.25f * df0 * squared_3;
    const float gradient1 = squared_3 * (0.25f * df1);
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void poincare_splat_batch_f(
    size_t count,
    const float *POINCARE_RESTRICT x,
    const float *POINCARE_RESTRICT mu,
    const float *POINCARE_RESTRICT W,
    const float *POINCARE_RESTRICT amplitude,
    float *POINCARE_RESTRICT value_out,
    float *POINCARE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) poincare_splat_f(x + 2 * i, mu + 2 * i, W + 4 * i, amplitude[i], value_out + i, gradient_out + 2 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void poincare_frame_f(const float *POINCARE_RESTRICT p, float *POINCARE_RESTRICT frame) {
    float left[2][2];
    for (int i = 0; i < 2; ++i) {
        float axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        poincare_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        float *e = frame + 2 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (poincare_norm_f(p, left[i]) > poincare_norm_f(p, left[longest])) longest = i;
        const float length = poincare_norm_f(p, left[longest]);
        for (int j = 0; j < 2; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 2];
            const float part = poincare_inner_f(p, e, rest);
            for (int j = 0; j < 2; ++j) rest[j] -= part * e[j];
        }
    }
}
