/*
 * hyperbolic: Hyperbolic space H^n, points on the upper sheet of the unit hyperboloid in R^(n+1), time
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "hyperbolic.h"

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

/* Of degree 8 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_r_over_sinh_r_near_slope_slope(double x) {
    return 0.014028146901544735 + x * (-0.00413676224118512 + x * (0.000843380980191968 + x *
        (-0.00014654285819066536 + x * (2.3267612013933116e-05 + x * (-3.482672939375429e-06 + x *
        (4.948625213652431e-07 + x * (-6.301934734206314e-08 + x * 5.3741898413725385e-09)))))));
}

/* Of degree 8 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_log_det_series_slope_slope(double x) {
    return -0.0013174582407562147 + x * (0.00033260079139758224 + x * (-6.009444553855441e-05 + x *
        (9.46082656359732e-06 + x * (-1.3820996791881693e-06 + x * (1.925268209717261e-07 + x *
        (-2.5714517029090196e-08 + x * (3.1156229034778715e-09 + x * -2.5684503215485614e-10)))))));
}

void hyperbolic_splats(
    size_t count,
    size_t splat_count,
    const double *HYPERBOLIC_RESTRICT x,
    const double *HYPERBOLIC_RESTRICT mu,
    const double *HYPERBOLIC_RESTRICT W,
    const double *HYPERBOLIC_RESTRICT amplitude,
    double *HYPERBOLIC_RESTRICT value,
    double *HYPERBOLIC_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[3][LANES], sum[4][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 3; ++i) x_block[i][lane] = x[3 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const double mu1 = mu[3 * k + 1];
            const double mu2 = mu[3 * k + 2];
            const double W0_0 = W[6 * k + 0];
            const double W0_1 = W[6 * k + 1];
            const double W0_2 = W[6 * k + 2];
            const double W1_0 = W[6 * k + 3];
            const double W1_1 = W[6 * k + 4];
            const double W1_2 = W[6 * k + 5];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double S0 = x_block[1][lane] + mu1;
                const double S1 = x_block[2][lane] + mu2;
                const double dot_S_S = S0 * S0 + S1 * S1;
                const double D0 = x_block[1][lane] - mu1;
                const double D1 = x_block[2][lane] - mu2;
                const double dot_D_D = D0 * D0 + D1 * D1;
                const double dot_D_S = S0 * D0 + S1 * D1;
                const double dot_ps_ps = mu1 * mu1 + mu2 * mu2;
                const double a = sqrt(1.0 + dot_ps_ps);
                const double dot_qs_qs = x_block[1][lane] * x_block[1][lane] + x_block[2][lane] * x_block[2][lane];
                const double dot_qs_qs_total = 1.0 + dot_qs_qs;
                const double b = sqrt(dot_qs_qs_total);
                const double a_total = a + b;
                const double e = dot_D_S / a_total;
                const int is_small = dot_S_S < 1.0;
                const double dot_S_S_chosen = (is_small ? 1.0 : dot_S_S);
                const double dot_D_S_ratio = dot_D_S / dot_S_S_chosen;
                const double dot_ps_qs = x_block[1][lane] * mu1 + x_block[2][lane] * mu2;
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
                const double D0_gap = D0 - mu1 * scale;
                const double v1 = r_over_sinh_r * D0_gap;
                const double D1_gap = D1 - mu2 * scale;
                const double v2 = r_over_sinh_r * D1_gap;
                const double log_det_series = polynomial_log_det_series(near_chosen);
                const double log_det_near = ww * log_det_series;
                const double log_det = (near ? log_det_near : log(r_ratio));
                const double z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const double z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const double exp_2 = exp(log_det - 0.5 * (z0 * z0 + z1 * z1));
                const double phi = amplitude_k * exp_2;
                const double by_v2 = -(W1_2 * z1) - W0_2 * z0;
                const double by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const double by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const double by_log_det_near = (near ? 1.0 : 0.0);
                const double by_log_det_series = ww * by_log_det_near;
                const double log_det_series_slope = polynomial_log_det_series_slope(near_chosen);
                const double product = r_over_sinh_r * by_v2;
                const double product_2 = r_over_sinh_r * by_v1;
                const double product_3 = r_over_sinh_r * by_v0;
                const double by_r_over_sinh_r = D1_gap * by_v2 + D0_gap * by_v1 + e_gap * by_v0;
                const double by_scale = -(mu2 * product) - mu1 * product_2 - a * product_3;
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
                const double exponent_by_x2 = x_block[2][lane] * product_7 - mu2 * product_6 + by_D1 + by_S1;
                const double exponent_by_x1 = x_block[1][lane] * product_7 - mu1 * product_6 + by_D0 + by_S0;
                const double df1 = phi * exponent_by_x1;
                const double df2 = phi * exponent_by_x2;
                const double normal_part = x_block[1][lane] * df1 + x_block[2][lane] * df2;
                const double gradient0 = x_block[0][lane] * normal_part;
                const double gradient1 = df1 + x_block[1][lane] * normal_part;
                const double gradient2 = df2 + x_block[2][lane] * normal_part;
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

void hyperbolic_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *HYPERBOLIC_RESTRICT x,
    const double *HYPERBOLIC_RESTRICT mu,
    const double *HYPERBOLIC_RESTRICT W,
    const double *HYPERBOLIC_RESTRICT amplitude,
    const double *HYPERBOLIC_RESTRICT value_bar,
    const double *HYPERBOLIC_RESTRICT gradient_bar,
    double *HYPERBOLIC_RESTRICT mu_bar,
    double *HYPERBOLIC_RESTRICT W_bar,
    double *HYPERBOLIC_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 3 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 6 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[3][LANES], value_bar_block[1][LANES], gradient_bar_block[3][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const double weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 3; ++i) x_block[i][lane] = x[3 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] = gradient_bar[3 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            double sum[10][LANES] = {{0}}, total[10] = {0};
            const double mu1 = mu[3 * k + 1];
            const double mu2 = mu[3 * k + 2];
            const double W0_0 = W[6 * k + 0];
            const double W0_1 = W[6 * k + 1];
            const double W0_2 = W[6 * k + 2];
            const double W1_0 = W[6 * k + 3];
            const double W1_1 = W[6 * k + 4];
            const double W1_2 = W[6 * k + 5];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double S0 = x_block[1][lane] + mu1;
                const double S1 = x_block[2][lane] + mu2;
                const double dot_S_S = S0 * S0 + S1 * S1;
                const double D0 = x_block[1][lane] - mu1;
                const double D1 = x_block[2][lane] - mu2;
                const double dot_D_D = D0 * D0 + D1 * D1;
                const double dot_D_S = S0 * D0 + S1 * D1;
                const double dot_ps_ps = mu1 * mu1 + mu2 * mu2;
                const double dot_ps_ps_total = 1.0 + dot_ps_ps;
                const double a = sqrt(dot_ps_ps_total);
                const double dot_qs_qs = x_block[1][lane] * x_block[1][lane] + x_block[2][lane] * x_block[2][lane];
                const double dot_qs_qs_total = 1.0 + dot_qs_qs;
                const double b = sqrt(dot_qs_qs_total);
                const double a_total = a + b;
                const double e = dot_D_S / a_total;
                const int is_small = dot_S_S < 1.0;
                const double dot_S_S_chosen = (is_small ? 1.0 : dot_S_S);
                const double dot_D_S_ratio = dot_D_S / dot_S_S_chosen;
                const double dot_ps_qs = x_block[1][lane] * mu1 + x_block[2][lane] * mu2;
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
                const double D0_gap = D0 - mu1 * scale;
                const double v1 = r_over_sinh_r * D0_gap;
                const double D1_gap = D1 - mu2 * scale;
                const double v2 = r_over_sinh_r * D1_gap;
                const double log_det_series = polynomial_log_det_series(near_chosen);
                const double log_det_near = ww * log_det_series;
                const double log_det = (near ? log_det_near : log(r_ratio));
                const double z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const double z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const double exp_2 = exp(log_det - 0.5 * (z0 * z0 + z1 * z1));
                const double phi = amplitude_k * exp_2;
                const double by_v2 = -(W1_2 * z1) - W0_2 * z0;
                const double by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const double by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const double by_log_det_near = (near ? 1.0 : 0.0);
                const double ratio = (near ? 0.0 : 1.0) / r_ratio;
                const double by_log_det_series = ww * by_log_det_near;
                const double log_det_series_slope = polynomial_log_det_series_slope(near_chosen);
                const double product = r_over_sinh_r * by_v2;
                const double product_2 = r_over_sinh_r * by_v1;
                const double product_3 = r_over_sinh_r * by_v0;
                const double by_r_over_sinh_r = D1_gap * by_v2 + D0_gap * by_v1 + e_gap * by_v0;
                const double by_scale = -(mu2 * product) - mu1 * product_2 - a * product_3;
                const double by_r_over_sinh_r_near = (near ? by_r_over_sinh_r : 0.0);
                const double by_r = (ratio + (near ? 0.0 : by_r_over_sinh_r)) / sinh_r;
                const double sinh_r_product = 2.0 * sinh_r;
                const double ratio_2 = r_ratio * by_r / sinh_r_product;
                const double near_chosen_2 = (near ? 0.0 : -ratio_2);
                const double by_asinh_sqrt_ww_over_2 = 2.0 * by_r;
                const double sqrt_2 = sqrt(1.0 + sqrt_ww_product * sqrt_ww_product);
                const double ratio_3 = by_asinh_sqrt_ww_over_2 / sqrt_2;
                const double by_sqrt_ww = 0.5 * ratio_3;
                const double sqrt_ww_product_2 = 2.0 * sqrt_ww;
                const double by_sqrt_ww_ratio = by_sqrt_ww / sqrt_ww_product_2;
                const double r_over_sinh_r_near_slope = polynomial_r_over_sinh_r_near_slope(near_chosen);
                const double total_3 = log_det_series * by_log_det_near + 0.5 * by_scale + (near ? 0.0 : by_sqrt_ww_ratio)
                    + 2.1799885768598575 * (near ? by_log_det_series * log_det_series_slope + by_r_over_sinh_r_near *
                    r_over_sinh_r_near_slope : 0.0);
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
                const double product_7 = 2.0 * (c * by_c_ratio);
                const double ratio_4 = (dot_D_S_product * by_dot_rest_rest - S1 * by_rest1 - S0 * by_rest0) /
                    dot_S_S_chosen;
                const double by_dot_S_S = (is_small ? 0.0 : -(dot_D_S_ratio * ratio_4));
                const double by_e_ratio = by_e / a_total;
                const double by_dot_D_S = c * product_4 + ratio_4 + by_e_ratio;
                const double by_b = a_product * by_c_ratio + (-(a_total * product_7) - e * by_e_ratio);
                const int is_small_2 = dot_qs_qs_total == 0.0;
                const double product_8 = 2.0 * (is_small_2 ? 1.0 : b);
                const double by_dot_qs_qs = (is_small_2 ? 0.0 : by_b / product_8);
                const double product_9 = 2.0 * by_dot_qs_qs;
                const double by_D1 = product + by_rest1 + S1 * by_dot_D_S + D1 * by_dot_D_D_product;
                const double by_D0 = product_2 + by_rest0 + S0 * by_dot_D_S + D0 * by_dot_D_D_product;
                const double by_dot_S_S_product = 2.0 * by_dot_S_S;
                const double by_S1 = D1 * by_dot_D_S - dot_D_S_ratio * by_rest1 + S1 * by_dot_S_S_product;
                const double by_S0 = D0 * by_dot_D_S - dot_D_S_ratio * by_rest0 + S0 * by_dot_S_S_product;
                const double exponent_by_x2 = x_block[2][lane] * product_9 - mu2 * product_6 + by_D1 + by_S1;
                const double exponent_by_x1 = x_block[1][lane] * product_9 - mu1 * product_6 + by_D0 + by_S0;
                const double by_normal_part = x_block[2][lane] * gradient_bar_block[2][lane] + x_block[1][lane] *
                    gradient_bar_block[1][lane] + x_block[0][lane] * gradient_bar_block[0][lane];
                const double by_df2 = gradient_bar_block[2][lane] + x_block[2][lane] * by_normal_part;
                const double by_df1 = gradient_bar_block[1][lane] + x_block[1][lane] * by_normal_part;
                const double by_exponent_by_x2 = phi * by_df2;
                const double by_exponent_by_x1 = phi * by_df1;
                const double by_phi = value_bar_block[0][lane] + exponent_by_x2 * by_df2 + exponent_by_x1 * by_df1;
                const double S0_product = S0 * by_exponent_by_x1;
                const double S1_product = S1 * by_exponent_by_x2;
                const double by_by_dot_S_S = 2.0 * (S0_product + S1_product);
                const double D0_product = D0 * by_exponent_by_x1;
                const double D1_product = D1 * by_exponent_by_x2;
                const double by_dot_D_S_product = by_dot_D_S * by_exponent_by_x1;
                const double by_dot_D_S_product_2 = by_dot_D_S * by_exponent_by_x2;
                const double by_by_dot_D_S = D1_product + (S1_product + (S0_product + D0_product));
                const double by_by_dot_qs_qs = 2.0 * (x_block[1][lane] * by_exponent_by_x1 + x_block[2][lane] *
                    by_exponent_by_x2);
                const double by_by_b = (is_small_2 ? 0.0 : by_by_dot_qs_qs) / product_8;
                const double by_by_e = (by_by_dot_D_S - e * by_by_b) / a_total;
                const double chosen = (is_small ? 0.0 : by_by_dot_S_S);
                const double ratio_5 = (by_by_dot_D_S - dot_D_S_ratio * chosen) / dot_S_S_chosen;
                const double product_10 = 2.0 * (a_total * by_by_b);
                const double total_4 = a_product * by_by_b + 2.0 * (-(mu1 * by_exponent_by_x1) - mu2 * by_exponent_by_x2);
                const double by_by_c = (total_4 - c * product_10) / squared;
                const double by_by_dot_D_D = 2.0 * (D0_product + D1_product - e * by_by_e);
                const double total_5 = dot_D_S * by_by_c + c * by_by_dot_D_S;
                const double by_by_rest0 = by_exponent_by_x1 + (-(S0 * ratio_5) - dot_D_S_ratio * by_exponent_by_x1);
                const double by_by_rest1 = by_exponent_by_x2 + (-(S1 * ratio_5) - dot_D_S_ratio * by_exponent_by_x2);
                const double total_6 = -(ratio_4 * chosen) - by_rest0 * by_exponent_by_x1 - by_rest1 * by_exponent_by_x2 +
                    by_dot_rest_rest * total_5;
                const double by_by_dot_rest_rest = 2.0 * (rest0 * by_by_rest0 + rest1 * by_by_rest1) + dot_D_S_ratio *
                    total_5 + dot_D_S_product * ratio_5;
                const double by_by_ww = (is_small ? 0.0 : by_by_dot_rest_rest) + (is_small ? by_by_dot_D_D : 0.0);
                const double by_by_ww_product = 0.25 * by_by_ww;
                const double near_chosen_3 = (near ? 2.1799885768598575 * by_by_ww : 0.0);
                const double by_by_r_over_sinh_r_near = r_over_sinh_r_near_slope * near_chosen_3;
                const double by_r_over_sinh_r_near_slope = by_r_over_sinh_r_near * near_chosen_3;
                const double r_over_sinh_r_near_slope_slope = polynomial_r_over_sinh_r_near_slope_slope(near_chosen);
                const double by_by_sqrt_ww = (near ? 0.0 : by_by_ww) / sqrt_ww_product_2;
                const double by_by_asinh_sqrt_ww_over_2 = 0.5 * by_by_sqrt_ww / sqrt_2;
                const double ratio_6 = (near ? 0.0 : ww * by_by_ww_product + total_2 * by_by_ww) / sinh_r_product;
                const double by_by_r = 2.0 * by_by_asinh_sqrt_ww_over_2 - r_ratio * ratio_6;
                const double by_by_r_ratio = by_by_r / sinh_r;
                const double by_by_r_over_sinh_r = (near ? 0.0 : by_by_r_ratio) + (near ? by_by_r_over_sinh_r_near : 0.0);
                const double by_by_scale = 0.5 * by_by_ww;
                const double by_by_e_gap = by_by_e - a * by_by_scale;
                const double by_by_v0 = r_over_sinh_r * by_by_e_gap + e_gap * by_by_r_over_sinh_r;
                const double gap = by_exponent_by_x1 - mu1 * by_by_scale;
                const double by_by_v1 = r_over_sinh_r * gap + D0_gap * by_by_r_over_sinh_r;
                const double gap_2 = by_exponent_by_x2 - mu2 * by_by_scale;
                const double by_by_v2 = r_over_sinh_r * gap_2 + D1_gap * by_by_r_over_sinh_r;
                const double by_by_log_det_series = log_det_series_slope * near_chosen_3;
                const double by_log_det_series_slope = by_log_det_series * near_chosen_3;
                const double log_det_series_slope_slope = polynomial_log_det_series_slope_slope(near_chosen);
                const double by_log_det = exp_2 * (amplitude_k * by_phi);
                const double by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - z1 * by_log_det;
                const double by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - z0 * by_log_det;
                const double by_v2_2 = W1_2 * by_z1 + W0_2 * by_z0;
                const double by_v1_2 = W1_1 * by_z1 + W0_1 * by_z0;
                const double by_v0_2 = W1_0 * by_z1 + W0_0 * by_z0;
                const double by_log_det_near_2 = (near ? by_log_det : 0.0);
                const double by_log_det_series_2 = by_log_det_near * by_by_ww + ww * by_log_det_near_2;
                const double total_7 = by_v2 * by_by_r_over_sinh_r + r_over_sinh_r * by_v2_2;
                const double total_8 = by_v0 * by_by_e_gap + by_v1 * gap + by_v2 * gap_2 + D1_gap * by_v2_2 + D0_gap *
                    by_v1_2;
                const double total_9 = by_v1 * by_by_r_over_sinh_r + r_over_sinh_r * by_v1_2;
                const double by_r_over_sinh_r_2 = total_8 + e_gap * by_v0_2;
                const double total_10 = by_v0 * by_by_r_over_sinh_r + r_over_sinh_r * by_v0_2;
                const double by_scale_2 = -(mu2 * total_7) - mu1 * total_9 - a * total_10;
                const double by_r_over_sinh_r_near_2 = (near ? by_r_over_sinh_r_2 : 0.0);
                const double total_11 = -(by_r * ratio_6) - ratio * (by_by_r_ratio / r_ratio) + (near ? 0.0 : by_log_det)
                    / r_ratio + (near ? 0.0 : by_r_over_sinh_r_2);
                const double by_r_2 = total_11 / sinh_r;
                const double by_sinh_r = 2.0 * (ratio_2 * ratio_6) - by_r * by_by_r_ratio - r_ratio * by_r_2;
                const double near_chosen_4 = (near ? 0.0 : by_sinh_r / sinh_r_product);
                const double by_asinh_sqrt_ww_over_2_2 = 2.0 * by_r_2;
                const double gap_3 = by_asinh_sqrt_ww_over_2_2 / sqrt_2 - sqrt_ww_product * (2.0 * (ratio_3 *
                    by_by_asinh_sqrt_ww_over_2 / (2.0 * sqrt_2)));
                const double by_sqrt_ww_2 = 0.5 * gap_3 - 2.0 * (by_sqrt_ww_ratio * by_by_sqrt_ww);
                const double total_12 = near_chosen_2 * by_by_ww_product + by_log_det_near * by_by_log_det_series +
                    log_det_series * by_log_det_near_2 + 0.5 * by_scale_2 + (near ? 0.0 : by_sqrt_ww_2 /
                    sqrt_ww_product_2);
                const double near_chosen_5 = (near ? by_r_over_sinh_r_near_slope * r_over_sinh_r_near_slope_slope +
                    by_log_det_series_slope * log_det_series_slope_slope + log_det_series_slope * by_log_det_series_2 +
                    r_over_sinh_r_near_slope * by_r_over_sinh_r_near_2 : 0.0);
                const double by_ww_2 = total_12 + 2.1799885768598575 * near_chosen_5 + total_2 * near_chosen_4 + 0.25 *
                    (near_chosen_2 * by_by_ww + ww * near_chosen_4);
                const double by_dot_D_D_2 = (is_small ? by_ww_2 : 0.0);
                const double by_dot_rest_rest_2 = (is_small ? 0.0 : by_ww_2);
                const double total_13 = by_dot_rest_rest * ratio_5 + dot_D_S_ratio * by_dot_rest_rest_2;
                const double product_11 = 2.0 * by_dot_rest_rest_2;
                const double by_rest1_2 = product_5 * by_by_rest1 + rest1 * product_11;
                const double by_rest0_2 = product_5 * by_by_rest0 + rest0 * product_11;
                const double by_c_2 = product_4 * by_by_dot_D_S - by_c_ratio * product_10 + dot_D_S * total_13;
                const double by_dot_D_D_product_2 = 2.0 * by_dot_D_D_2;
                const double by_e_2 = -(by_e_ratio * by_by_b) - by_dot_D_D_product * by_by_e + total_10 - e *
                    by_dot_D_D_product_2;
                const double by_c_ratio_2 = by_c_2 / squared;
                const double product_12 = 2.0 * by_c_ratio_2;
                const double product_13 = a_total * (2.0 * (-(by_c_ratio * by_by_c) - c * by_c_ratio_2));
                const double gap_4 = -(product_6 * by_exponent_by_x2) - product * by_by_scale - scale * total_7 -
                    x_block[2][lane] * product_12;
                const double gap_5 = -(product_6 * by_exponent_by_x1) - product_2 * by_by_scale - scale * total_9 -
                    x_block[1][lane] * product_12;
                const double ratio_7 = (total_6 + dot_D_S_product * by_dot_rest_rest_2 - S1 * by_rest1_2 - S0 *
                    by_rest0_2) / dot_S_S_chosen;
                const double by_dot_S_S_2 = (is_small ? 0.0 : -(ratio_4 * ratio_5) - dot_D_S_ratio * ratio_7);
                const double by_e_ratio_2 = by_e_2 / a_total;
                const double by_dot_D_S_2 = product_4 * by_by_c + c * total_13 + ratio_7 + by_e_ratio_2;
                const double gap_6 = -(by_e_ratio * by_by_e) - product_7 * by_by_b + product_13 - e * by_e_ratio_2;
                const double by_a = -(product_3 * by_by_scale) - scale * total_10 + 2.0 * (by_c_ratio * by_by_b + b *
                    by_c_ratio_2) + gap_6;
                const int is_small_3 = dot_ps_ps_total == 0.0;
                const double by_dot_ps_ps = (is_small_3 ? 0.0 : by_a / (2.0 * (is_small_3 ? 1.0 : a)));
                const double product_14 = 2.0 * by_dot_ps_ps;
                const double total_14 = by_dot_S_S_product * by_exponent_by_x2 + by_dot_D_S_product_2 - by_rest1 * ratio_5
                    - dot_D_S_ratio * by_rest1_2 + D1 * by_dot_D_S_2;
                const double total_15 = by_dot_D_D_product * by_exponent_by_x2 + by_dot_D_S_product_2 + total_7 +
                    by_rest1_2 + S1 * by_dot_D_S_2;
                const double total_16 = by_dot_S_S_product * by_exponent_by_x1 + by_dot_D_S_product - by_rest0 * ratio_5 -
                    dot_D_S_ratio * by_rest0_2 + D0 * by_dot_D_S_2;
                const double total_17 = by_dot_D_D_product * by_exponent_by_x1 + by_dot_D_S_product + total_9 + by_rest0_2
                    + S0 * by_dot_D_S_2;
                const double by_D1_2 = total_15 + D1 * by_dot_D_D_product_2;
                const double by_D0_2 = total_17 + D0 * by_dot_D_D_product_2;
                const double by_dot_S_S_product_2 = 2.0 * by_dot_S_S_2;
                const double by_S1_2 = total_14 + S1 * by_dot_S_S_product_2;
                const double by_S0_2 = total_16 + S0 * by_dot_S_S_product_2;
                sum[0][lane] += 0.0;
                sum[1][lane] += gap_5 + mu1 * product_14 - by_D0_2 + by_S0_2;
                sum[2][lane] += gap_4 + mu2 * product_14 - by_D1_2 + by_S1_2;
                sum[3][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[4][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[5][lane] += v2 * by_z0 - z0 * by_by_v2;
                sum[6][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[7][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[8][lane] += v2 * by_z1 - z1 * by_by_v2;
                sum[9][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 10; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[3 * k + 0] += total[0];
            mu_bar[3 * k + 1] += total[1];
            mu_bar[3 * k + 2] += total[2];
            W_bar[6 * k + 0] += total[3];
            W_bar[6 * k + 1] += total[4];
            W_bar[6 * k + 2] += total[5];
            W_bar[6 * k + 3] += total[6];
            W_bar[6 * k + 4] += total[7];
            W_bar[6 * k + 5] += total[8];
            amplitude_bar[1 * k + 0] += total[9];
        }
    }
    restore_denormals(mode);
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

/* Of degree 6, within 2^-30 of that of double precision. */
static inline float polynomial_r_over_sinh_r_near_slope_slope_f(float x) {
    return 0.014028146896312052f + x * (-0.004136761723462013f + x * (0.0008433725916576027f + x *
        (-0.00014649164528145262f + x * (2.3117510688950196e-05f + x * (-3.2532874406106227e-06f + x *
        3.146012294783161e-07f)))));
}

/* Of degree 6, within 2^-31 of that of double precision. */
static inline float polynomial_log_det_series_slope_slope_f(float x) {
    return -0.001317458240493464f + x * (0.0003326007654128614f + x * (-6.009402476651674e-05f + x *
        (9.458259792733216e-06f + x * (-1.3745854539846409e-06f + x * (1.8106450494086812e-07f + x *
        -1.6736174608079068e-08f)))));
}

void hyperbolic_splats_f(
    size_t count,
    size_t splat_count,
    const float *HYPERBOLIC_RESTRICT x,
    const float *HYPERBOLIC_RESTRICT mu,
    const float *HYPERBOLIC_RESTRICT W,
    const float *HYPERBOLIC_RESTRICT amplitude,
    float *HYPERBOLIC_RESTRICT value,
    float *HYPERBOLIC_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[3][LANES], sum[4][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 3; ++i) x_block[i][lane] = x[3 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const float mu1 = mu[3 * k + 1];
            const float mu2 = mu[3 * k + 2];
            const float W0_0 = W[6 * k + 0];
            const float W0_1 = W[6 * k + 1];
            const float W0_2 = W[6 * k + 2];
            const float W1_0 = W[6 * k + 3];
            const float W1_1 = W[6 * k + 4];
            const float W1_2 = W[6 * k + 5];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float S0 = x_block[1][lane] + mu1;
                const float S1 = x_block[2][lane] + mu2;
                const float dot_S_S = S0 * S0 + S1 * S1;
                const float D0 = x_block[1][lane] - mu1;
                const float D1 = x_block[2][lane] - mu2;
                const float dot_D_D = D0 * D0 + D1 * D1;
                const float dot_D_S = S0 * D0 + S1 * D1;
                const float dot_ps_ps = mu1 * mu1 + mu2 * mu2;
                const float a = sqrtf(1.0f + dot_ps_ps);
                const float dot_qs_qs = x_block[1][lane] * x_block[1][lane] + x_block[2][lane] * x_block[2][lane];
                const float dot_qs_qs_total = 1.0f + dot_qs_qs;
                const float b = sqrtf(dot_qs_qs_total);
                const float a_total = a + b;
                const float e = dot_D_S / a_total;
                const int is_small = dot_S_S < 1.0f;
                const float dot_S_S_chosen = (is_small ? 1.0f : dot_S_S);
                const float dot_D_S_ratio = dot_D_S / dot_S_S_chosen;
                const float dot_ps_qs = x_block[1][lane] * mu1 + x_block[2][lane] * mu2;
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
                const float D0_gap = D0 - mu1 * scale;
                const float v1 = r_over_sinh_r * D0_gap;
                const float D1_gap = D1 - mu2 * scale;
                const float v2 = r_over_sinh_r * D1_gap;
                const float log_det_series = polynomial_log_det_series_f(near_chosen);
                const float log_det_near = ww * log_det_series;
                const float log_det = (near ? log_det_near : logf(r_ratio));
                const float z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const float z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const float exp_2 = expf(log_det - 0.5f * (z0 * z0 + z1 * z1));
                const float phi = amplitude_k * exp_2;
                const float by_v2 = -(W1_2 * z1) - W0_2 * z0;
                const float by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const float by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const float by_log_det_near = (near ? 1.0f : 0.0f);
                const float by_log_det_series = ww * by_log_det_near;
                const float log_det_series_slope = polynomial_log_det_series_slope_f(near_chosen);
                const float product = r_over_sinh_r * by_v2;
                const float product_2 = r_over_sinh_r * by_v1;
                const float product_3 = r_over_sinh_r * by_v0;
                const float by_r_over_sinh_r = D1_gap * by_v2 + D0_gap * by_v1 + e_gap * by_v0;
                const float by_scale = -(mu2 * product) - mu1 * product_2 - a * product_3;
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
                const float exponent_by_x2 = x_block[2][lane] * product_7 - mu2 * product_6 + by_D1 + by_S1;
                const float exponent_by_x1 = x_block[1][lane] * product_7 - mu1 * product_6 + by_D0 + by_S0;
                const float df1 = phi * exponent_by_x1;
                const float df2 = phi * exponent_by_x2;
                const float normal_part = x_block[1][lane] * df1 + x_block[2][lane] * df2;
                const float gradient0 = x_block[0][lane] * normal_part;
                const float gradient1 = df1 + x_block[1][lane] * normal_part;
                const float gradient2 = df2 + x_block[2][lane] * normal_part;
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

void hyperbolic_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *HYPERBOLIC_RESTRICT x,
    const float *HYPERBOLIC_RESTRICT mu,
    const float *HYPERBOLIC_RESTRICT W,
    const float *HYPERBOLIC_RESTRICT amplitude,
    const float *HYPERBOLIC_RESTRICT value_bar,
    const float *HYPERBOLIC_RESTRICT gradient_bar,
    float *HYPERBOLIC_RESTRICT mu_bar,
    float *HYPERBOLIC_RESTRICT W_bar,
    float *HYPERBOLIC_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 3 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 6 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[3][LANES], value_bar_block[1][LANES], gradient_bar_block[3][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const float weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 3; ++i) x_block[i][lane] = x[3 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] = gradient_bar[3 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            float sum[10][LANES] = {{0}}, total[10] = {0};
            const float mu1 = mu[3 * k + 1];
            const float mu2 = mu[3 * k + 2];
            const float W0_0 = W[6 * k + 0];
            const float W0_1 = W[6 * k + 1];
            const float W0_2 = W[6 * k + 2];
            const float W1_0 = W[6 * k + 3];
            const float W1_1 = W[6 * k + 4];
            const float W1_2 = W[6 * k + 5];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float S0 = x_block[1][lane] + mu1;
                const float S1 = x_block[2][lane] + mu2;
                const float dot_S_S = S0 * S0 + S1 * S1;
                const float D0 = x_block[1][lane] - mu1;
                const float D1 = x_block[2][lane] - mu2;
                const float dot_D_D = D0 * D0 + D1 * D1;
                const float dot_D_S = S0 * D0 + S1 * D1;
                const float dot_ps_ps = mu1 * mu1 + mu2 * mu2;
                const float dot_ps_ps_total = 1.0f + dot_ps_ps;
                const float a = sqrtf(dot_ps_ps_total);
                const float dot_qs_qs = x_block[1][lane] * x_block[1][lane] + x_block[2][lane] * x_block[2][lane];
                const float dot_qs_qs_total = 1.0f + dot_qs_qs;
                const float b = sqrtf(dot_qs_qs_total);
                const float a_total = a + b;
                const float e = dot_D_S / a_total;
                const int is_small = dot_S_S < 1.0f;
                const float dot_S_S_chosen = (is_small ? 1.0f : dot_S_S);
                const float dot_D_S_ratio = dot_D_S / dot_S_S_chosen;
                const float dot_ps_qs = x_block[1][lane] * mu1 + x_block[2][lane] * mu2;
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
                const float D0_gap = D0 - mu1 * scale;
                const float v1 = r_over_sinh_r * D0_gap;
                const float D1_gap = D1 - mu2 * scale;
                const float v2 = r_over_sinh_r * D1_gap;
                const float log_det_series = polynomial_log_det_series_f(near_chosen);
                const float log_det_near = ww * log_det_series;
                const float log_det = (near ? log_det_near : logf(r_ratio));
                const float z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const float z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const float exp_2 = expf(log_det - 0.5f * (z0 * z0 + z1 * z1));
                const float phi = amplitude_k * exp_2;
                const float by_v2 = -(W1_2 * z1) - W0_2 * z0;
                const float by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const float by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const float by_log_det_near = (near ? 1.0f : 0.0f);
                const float ratio = (near ? 0.0f : 1.0f) / r_ratio;
                const float by_log_det_series = ww * by_log_det_near;
                const float log_det_series_slope = polynomial_log_det_series_slope_f(near_chosen);
                const float product = r_over_sinh_r * by_v2;
                const float product_2 = r_over_sinh_r * by_v1;
                const float product_3 = r_over_sinh_r * by_v0;
                const float by_r_over_sinh_r = D1_gap * by_v2 + D0_gap * by_v1 + e_gap * by_v0;
                const float by_scale = -(mu2 * product) - mu1 * product_2 - a * product_3;
                const float by_r_over_sinh_r_near = (near ? by_r_over_sinh_r : 0.0f);
                const float by_r = (ratio + (near ? 0.0f : by_r_over_sinh_r)) / sinh_r;
                const float sinh_r_product = 2.0f * sinh_r;
                const float ratio_2 = r_ratio * by_r / sinh_r_product;
                const float near_chosen_2 = (near ? 0.0f : -ratio_2);
                const float by_asinh_sqrt_ww_over_2 = 2.0f * by_r;
                const float sqrt_2 = sqrtf(1.0f + sqrt_ww_product * sqrt_ww_product);
                const float ratio_3 = by_asinh_sqrt_ww_over_2 / sqrt_2;
                const float by_sqrt_ww = 0.5f * ratio_3;
                const float sqrt_ww_product_2 = 2.0f * sqrt_ww;
                const float by_sqrt_ww_ratio = by_sqrt_ww / sqrt_ww_product_2;
                const float r_over_sinh_r_near_slope = polynomial_r_over_sinh_r_near_slope_f(near_chosen);
                const float total_3 = log_det_series * by_log_det_near + 0.5f * by_scale + (near ? 0.0f :
                    by_sqrt_ww_ratio) + 2.1799885768598575f * (near ? by_log_det_series * log_det_series_slope +
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
                const float product_7 = 2.0f * (c * by_c_ratio);
                const float ratio_4 = (dot_D_S_product * by_dot_rest_rest - S1 * by_rest1 - S0 * by_rest0) /
                    dot_S_S_chosen;
                const float by_dot_S_S = (is_small ? 0.0f : -(dot_D_S_ratio * ratio_4));
                const float by_e_ratio = by_e / a_total;
                const float by_dot_D_S = c * product_4 + ratio_4 + by_e_ratio;
                const float by_b = a_product * by_c_ratio + (-(a_total * product_7) - e * by_e_ratio);
                const int is_small_2 = dot_qs_qs_total == 0.0f;
                const float product_8 = 2.0f * (is_small_2 ? 1.0f : b);
                const float by_dot_qs_qs = (is_small_2 ? 0.0f : by_b / product_8);
                const float product_9 = 2.0f * by_dot_qs_qs;
                const float by_D1 = product + by_rest1 + S1 * by_dot_D_S + D1 * by_dot_D_D_product;
                const float by_D0 = product_2 + by_rest0 + S0 * by_dot_D_S + D0 * by_dot_D_D_product;
                const float by_dot_S_S_product = 2.0f * by_dot_S_S;
                const float by_S1 = D1 * by_dot_D_S - dot_D_S_ratio * by_rest1 + S1 * by_dot_S_S_product;
                const float by_S0 = D0 * by_dot_D_S - dot_D_S_ratio * by_rest0 + S0 * by_dot_S_S_product;
                const float exponent_by_x2 = x_block[2][lane] * product_9 - mu2 * product_6 + by_D1 + by_S1;
                const float exponent_by_x1 = x_block[1][lane] * product_9 - mu1 * product_6 + by_D0 + by_S0;
                const float by_normal_part = x_block[2][lane] * gradient_bar_block[2][lane] + x_block[1][lane] *
                    gradient_bar_block[1][lane] + x_block[0][lane] * gradient_bar_block[0][lane];
                const float by_df2 = gradient_bar_block[2][lane] + x_block[2][lane] * by_normal_part;
                const float by_df1 = gradient_bar_block[1][lane] + x_block[1][lane] * by_normal_part;
                const float by_exponent_by_x2 = phi * by_df2;
                const float by_exponent_by_x1 = phi * by_df1;
                const float by_phi = value_bar_block[0][lane] + exponent_by_x2 * by_df2 + exponent_by_x1 * by_df1;
                const float S0_product = S0 * by_exponent_by_x1;
                const float S1_product = S1 * by_exponent_by_x2;
                const float by_by_dot_S_S = 2.0f * (S0_product + S1_product);
                const float D0_product = D0 * by_exponent_by_x1;
                const float D1_product = D1 * by_exponent_by_x2;
                const float by_dot_D_S_product = by_dot_D_S * by_exponent_by_x1;
                const float by_dot_D_S_product_2 = by_dot_D_S * by_exponent_by_x2;
                const float by_by_dot_D_S = D1_product + (S1_product + (S0_product + D0_product));
                const float by_by_dot_qs_qs = 2.0f * (x_block[1][lane] * by_exponent_by_x1 + x_block[2][lane] *
                    by_exponent_by_x2);
                const float by_by_b = (is_small_2 ? 0.0f : by_by_dot_qs_qs) / product_8;
                const float by_by_e = (by_by_dot_D_S - e * by_by_b) / a_total;
                const float chosen = (is_small ? 0.0f : by_by_dot_S_S);
                const float ratio_5 = (by_by_dot_D_S - dot_D_S_ratio * chosen) / dot_S_S_chosen;
                const float product_10 = 2.0f * (a_total * by_by_b);
                const float total_4 = a_product * by_by_b + 2.0f * (-(mu1 * by_exponent_by_x1) - mu2 * by_exponent_by_x2);
                const float by_by_c = (total_4 - c * product_10) / squared;
                const float by_by_dot_D_D = 2.0f * (D0_product + D1_product - e * by_by_e);
                const float total_5 = dot_D_S * by_by_c + c * by_by_dot_D_S;
                const float by_by_rest0 = by_exponent_by_x1 + (-(S0 * ratio_5) - dot_D_S_ratio * by_exponent_by_x1);
                const float by_by_rest1 = by_exponent_by_x2 + (-(S1 * ratio_5) - dot_D_S_ratio * by_exponent_by_x2);
                const float total_6 = -(ratio_4 * chosen) - by_rest0 * by_exponent_by_x1 - by_rest1 * by_exponent_by_x2 +
                    by_dot_rest_rest * total_5;
                const float by_by_dot_rest_rest = 2.0f * (rest0 * by_by_rest0 + rest1 * by_by_rest1) + dot_D_S_ratio *
                    total_5 + dot_D_S_product * ratio_5;
                const float by_by_ww = (is_small ? 0.0f : by_by_dot_rest_rest) + (is_small ? by_by_dot_D_D : 0.0f);
                const float by_by_ww_product = 0.25f * by_by_ww;
                const float near_chosen_3 = (near ? 2.1799885768598575f * by_by_ww : 0.0f);
                const float by_by_r_over_sinh_r_near = r_over_sinh_r_near_slope * near_chosen_3;
                const float by_r_over_sinh_r_near_slope = by_r_over_sinh_r_near * near_chosen_3;
                const float r_over_sinh_r_near_slope_slope = polynomial_r_over_sinh_r_near_slope_slope_f(near_chosen);
                const float by_by_sqrt_ww = (near ? 0.0f : by_by_ww) / sqrt_ww_product_2;
                const float by_by_asinh_sqrt_ww_over_2 = 0.5f * by_by_sqrt_ww / sqrt_2;
                const float ratio_6 = (near ? 0.0f : ww * by_by_ww_product + total_2 * by_by_ww) / sinh_r_product;
                const float by_by_r = 2.0f * by_by_asinh_sqrt_ww_over_2 - r_ratio * ratio_6;
                const float by_by_r_ratio = by_by_r / sinh_r;
                const float by_by_r_over_sinh_r = (near ? 0.0f : by_by_r_ratio) + (near ? by_by_r_over_sinh_r_near :
                    0.0f);
                const float by_by_scale = 0.5f * by_by_ww;
                const float by_by_e_gap = by_by_e - a * by_by_scale;
                const float by_by_v0 = r_over_sinh_r * by_by_e_gap + e_gap * by_by_r_over_sinh_r;
                const float gap = by_exponent_by_x1 - mu1 * by_by_scale;
                const float by_by_v1 = r_over_sinh_r * gap + D0_gap * by_by_r_over_sinh_r;
                const float gap_2 = by_exponent_by_x2 - mu2 * by_by_scale;
                const float by_by_v2 = r_over_sinh_r * gap_2 + D1_gap * by_by_r_over_sinh_r;
                const float by_by_log_det_series = log_det_series_slope * near_chosen_3;
                const float by_log_det_series_slope = by_log_det_series * near_chosen_3;
                const float log_det_series_slope_slope = polynomial_log_det_series_slope_slope_f(near_chosen);
                const float by_log_det = exp_2 * (amplitude_k * by_phi);
                const float by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - z1 * by_log_det;
                const float by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - z0 * by_log_det;
                const float by_v2_2 = W1_2 * by_z1 + W0_2 * by_z0;
                const float by_v1_2 = W1_1 * by_z1 + W0_1 * by_z0;
                const float by_v0_2 = W1_0 * by_z1 + W0_0 * by_z0;
                const float by_log_det_near_2 = (near ? by_log_det : 0.0f);
                const float by_log_det_series_2 = by_log_det_near * by_by_ww + ww * by_log_det_near_2;
                const float total_7 = by_v2 * by_by_r_over_sinh_r + r_over_sinh_r * by_v2_2;
                const float total_8 = by_v0 * by_by_e_gap + by_v1 * gap + by_v2 * gap_2 + D1_gap * by_v2_2 + D0_gap *
                    by_v1_2;
                const float total_9 = by_v1 * by_by_r_over_sinh_r + r_over_sinh_r * by_v1_2;
                const float by_r_over_sinh_r_2 = total_8 + e_gap * by_v0_2;
                const float total_10 = by_v0 * by_by_r_over_sinh_r + r_over_sinh_r * by_v0_2;
                const float by_scale_2 = -(mu2 * total_7) - mu1 * total_9 - a * total_10;
                const float by_r_over_sinh_r_near_2 = (near ? by_r_over_sinh_r_2 : 0.0f);
                const float total_11 = -(by_r * ratio_6) - ratio * (by_by_r_ratio / r_ratio) + (near ? 0.0f : by_log_det)
                    / r_ratio + (near ? 0.0f : by_r_over_sinh_r_2);
                const float by_r_2 = total_11 / sinh_r;
                const float by_sinh_r = 2.0f * (ratio_2 * ratio_6) - by_r * by_by_r_ratio - r_ratio * by_r_2;
                const float near_chosen_4 = (near ? 0.0f : by_sinh_r / sinh_r_product);
                const float by_asinh_sqrt_ww_over_2_2 = 2.0f * by_r_2;
                const float gap_3 = by_asinh_sqrt_ww_over_2_2 / sqrt_2 - sqrt_ww_product * (2.0f * (ratio_3 *
                    by_by_asinh_sqrt_ww_over_2 / (2.0f * sqrt_2)));
                const float by_sqrt_ww_2 = 0.5f * gap_3 - 2.0f * (by_sqrt_ww_ratio * by_by_sqrt_ww);
                const float total_12 = near_chosen_2 * by_by_ww_product + by_log_det_near * by_by_log_det_series +
                    log_det_series * by_log_det_near_2 + 0.5f * by_scale_2 + (near ? 0.0f : by_sqrt_ww_2 /
                    sqrt_ww_product_2);
                const float near_chosen_5 = (near ? by_r_over_sinh_r_near_slope * r_over_sinh_r_near_slope_slope +
                    by_log_det_series_slope * log_det_series_slope_slope + log_det_series_slope * by_log_det_series_2 +
                    r_over_sinh_r_near_slope * by_r_over_sinh_r_near_2 : 0.0f);
                const float by_ww_2 = total_12 + 2.1799885768598575f * near_chosen_5 + total_2 * near_chosen_4 + 0.25f *
                    (near_chosen_2 * by_by_ww + ww * near_chosen_4);
                const float by_dot_D_D_2 = (is_small ? by_ww_2 : 0.0f);
                const float by_dot_rest_rest_2 = (is_small ? 0.0f : by_ww_2);
                const float total_13 = by_dot_rest_rest * ratio_5 + dot_D_S_ratio * by_dot_rest_rest_2;
                const float product_11 = 2.0f * by_dot_rest_rest_2;
                const float by_rest1_2 = product_5 * by_by_rest1 + rest1 * product_11;
                const float by_rest0_2 = product_5 * by_by_rest0 + rest0 * product_11;
                const float by_c_2 = product_4 * by_by_dot_D_S - by_c_ratio * product_10 + dot_D_S * total_13;
                const float by_dot_D_D_product_2 = 2.0f * by_dot_D_D_2;
                const float by_e_2 = -(by_e_ratio * by_by_b) - by_dot_D_D_product * by_by_e + total_10 - e *
                    by_dot_D_D_product_2;
                const float by_c_ratio_2 = by_c_2 / squared;
                const float product_12 = 2.0f * by_c_ratio_2;
                const float product_13 = a_total * (2.0f * (-(by_c_ratio * by_by_c) - c * by_c_ratio_2));
                const float gap_4 = -(product_6 * by_exponent_by_x2) - product * by_by_scale - scale * total_7 -
                    x_block[2][lane] * product_12;
                const float gap_5 = -(product_6 * by_exponent_by_x1) - product_2 * by_by_scale - scale * total_9 -
                    x_block[1][lane] * product_12;
                const float ratio_7 = (total_6 + dot_D_S_product * by_dot_rest_rest_2 - S1 * by_rest1_2 - S0 * by_rest0_2)
                    / dot_S_S_chosen;
                const float by_dot_S_S_2 = (is_small ? 0.0f : -(ratio_4 * ratio_5) - dot_D_S_ratio * ratio_7);
                const float by_e_ratio_2 = by_e_2 / a_total;
                const float by_dot_D_S_2 = product_4 * by_by_c + c * total_13 + ratio_7 + by_e_ratio_2;
                const float gap_6 = -(by_e_ratio * by_by_e) - product_7 * by_by_b + product_13 - e * by_e_ratio_2;
                const float by_a = -(product_3 * by_by_scale) - scale * total_10 + 2.0f * (by_c_ratio * by_by_b + b *
                    by_c_ratio_2) + gap_6;
                const int is_small_3 = dot_ps_ps_total == 0.0f;
                const float by_dot_ps_ps = (is_small_3 ? 0.0f : by_a / (2.0f * (is_small_3 ? 1.0f : a)));
                const float product_14 = 2.0f * by_dot_ps_ps;
                const float total_14 = by_dot_S_S_product * by_exponent_by_x2 + by_dot_D_S_product_2 - by_rest1 * ratio_5
                    - dot_D_S_ratio * by_rest1_2 + D1 * by_dot_D_S_2;
                const float total_15 = by_dot_D_D_product * by_exponent_by_x2 + by_dot_D_S_product_2 + total_7 +
                    by_rest1_2 + S1 * by_dot_D_S_2;
                const float total_16 = by_dot_S_S_product * by_exponent_by_x1 + by_dot_D_S_product - by_rest0 * ratio_5 -
                    dot_D_S_ratio * by_rest0_2 + D0 * by_dot_D_S_2;
                const float total_17 = by_dot_D_D_product * by_exponent_by_x1 + by_dot_D_S_product + total_9 + by_rest0_2
                    + S0 * by_dot_D_S_2;
                const float by_D1_2 = total_15 + D1 * by_dot_D_D_product_2;
                const float by_D0_2 = total_17 + D0 * by_dot_D_D_product_2;
                const float by_dot_S_S_product_2 = 2.0f * by_dot_S_S_2;
                const float by_S1_2 = total_14 + S1 * by_dot_S_S_product_2;
                const float by_S0_2 = total_16 + S0 * by_dot_S_S_product_2;
                sum[0][lane] += 0.0f;
                sum[1][lane] += gap_5 + mu1 * product_14 - by_D0_2 + by_S0_2;
                sum[2][lane] += gap_4 + mu2 * product_14 - by_D1_2 + by_S1_2;
                sum[3][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[4][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[5][lane] += v2 * by_z0 - z0 * by_by_v2;
                sum[6][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[7][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[8][lane] += v2 * by_z1 - z1 * by_by_v2;
                sum[9][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 10; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[3 * k + 0] += total[0];
            mu_bar[3 * k + 1] += total[1];
            mu_bar[3 * k + 2] += total[2];
            W_bar[6 * k + 0] += total[3];
            W_bar[6 * k + 1] += total[4];
            W_bar[6 * k + 2] += total[5];
            W_bar[6 * k + 3] += total[6];
            W_bar[6 * k + 4] += total[7];
            W_bar[6 * k + 5] += total[8];
            amplitude_bar[1 * k + 0] += total[9];
        }
    }
    restore_denormals(mode);
}
