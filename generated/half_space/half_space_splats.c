/*
 * half_space: Hyperbolic space H^n of curvature -1 as the upper half of R^n, above the plane where the last
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "half_space.h"

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

/* Of degree 8 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_t_over_sinh_t_near_slope_slope(double x) {
    return 0.014028269226611401 + x * (-0.004136816349987618 + x * (0.0008433956887753833 + x *
        (-0.00014654605283609116 + x * (2.326822069810852e-05 + x * (-3.4827792313868604e-06 + x *
        (4.948797823429416e-07 + x * (-6.302182025142203e-08 + x * 5.3744241594190786e-09)))))));
}

/* Of degree 8 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_log_det_series_slope_slope(double x) {
    return -0.005269878915827681 + x * (0.001330420567248421 + x * (-0.00024038197434818817 + x *
        (3.784413124133655e-05 + x * (-5.528543340481669e-06 + x * (7.70130787745477e-07 + x *
        (-1.0286165584172534e-07 + x * (1.246298064804857e-08 + x * -1.0274249230371691e-09)))))));
}

void half_space_splats(
    size_t count,
    size_t splat_count,
    const double *HALF_SPACE_RESTRICT x,
    const double *HALF_SPACE_RESTRICT mu,
    const double *HALF_SPACE_RESTRICT W,
    const double *HALF_SPACE_RESTRICT amplitude,
    double *HALF_SPACE_RESTRICT value,
    double *HALF_SPACE_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[2][LANES], sum[3][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 2; ++i) x_block[i][lane] = x[2 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const double mu0 = mu[2 * k + 0];
            const double mu1 = mu[2 * k + 1];
            const double W0_0 = W[4 * k + 0];
            const double W0_1 = W[4 * k + 1];
            const double W1_0 = W[4 * k + 2];
            const double W1_1 = W[4 * k + 3];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double d0 = x_block[0][lane] - mu0;
                const double d1 = x_block[1][lane] - mu1;
                const double product = x_block[1][lane] * mu1;
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
                const double total_2 = x_block[1][lane] + mu1;
                const double up = 0.5 * dot_ds_ds + d1_product * total_2;
                const double scale_2 = t_over_sinh_t / x_block[1][lane];
                const double d0_product = mu1 * d0;
                const double v0 = scale_2 * d0_product;
                const double v1 = up * scale_2;
                const double log_det_series = polynomial_log_det_series(near_chosen);
                const double log_det_near = h_squared * log_det_series;
                const double log_det = (near ? log_det_near : log(t_ratio));
                const double z0 = W0_0 * v0 + W0_1 * v1;
                const double z1 = W1_0 * v0 + W1_1 * v1;
                const double exp_2 = exp(log_det - 0.5 * (z0 * z0 + z1 * z1));
                const double phi = amplitude_k * exp_2;
                const double by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const double by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const double by_log_det_near = (near ? 1.0 : 0.0);
                const double by_log_det_series = h_squared * by_log_det_near;
                const double log_det_series_slope = polynomial_log_det_series_slope(near_chosen);
                const double by_up = scale_2 * by_v1;
                const double by_scale_2 = up * by_v1 + d0_product * by_v0;
                const double by_t_over_sinh_t = by_scale_2 / x_block[1][lane];
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
                const double by_d0 = mu1 * (scale_2 * by_v0) + d0 * by_up + scale * by_part0;
                const double by_scale = d1 * by_part1 + d0 * by_part0;
                const int is_small_2 = product == 0.0;
                const double minus = -(2.0 * (scale * (by_scale / sqrt_value)) / (2.0 * (is_small_2 ? 1.0 : length)));
                const double exponent_by_x1 = by_d1 + (d1_product * by_up - scale_2 * by_t_over_sinh_t + mu1 * (is_small_2
                    ? 0.0 : minus));
                const double df0 = phi * by_d0;
                const double df1 = phi * exponent_by_x1;
                const double squared = x_block[1][lane] * x_block[1][lane];
                const double gradient0 = df0 * squared;
                const double gradient1 = df1 * squared;
                sum[0][lane] += phi;
                sum[1][lane] += gradient0;
                sum[2][lane] += gradient1;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 2; ++i) gradient[2 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void half_space_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *HALF_SPACE_RESTRICT x,
    const double *HALF_SPACE_RESTRICT mu,
    const double *HALF_SPACE_RESTRICT W,
    const double *HALF_SPACE_RESTRICT amplitude,
    const double *HALF_SPACE_RESTRICT value_bar,
    const double *HALF_SPACE_RESTRICT gradient_bar,
    double *HALF_SPACE_RESTRICT mu_bar,
    double *HALF_SPACE_RESTRICT W_bar,
    double *HALF_SPACE_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 2 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 4 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[2][LANES], value_bar_block[1][LANES], gradient_bar_block[2][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const double weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 2; ++i) x_block[i][lane] = x[2 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 2; ++i) gradient_bar_block[i][lane] = gradient_bar[2 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 2; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            double sum[7][LANES] = {{0}}, total[7] = {0};
            const double mu0 = mu[2 * k + 0];
            const double mu1 = mu[2 * k + 1];
            const double W0_0 = W[4 * k + 0];
            const double W0_1 = W[4 * k + 1];
            const double W1_0 = W[4 * k + 2];
            const double W1_1 = W[4 * k + 3];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double d0 = x_block[0][lane] - mu0;
                const double d1 = x_block[1][lane] - mu1;
                const double product = x_block[1][lane] * mu1;
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
                const double total_2 = x_block[1][lane] + mu1;
                const double up = 0.5 * dot_ds_ds + d1_product * total_2;
                const double scale_2 = t_over_sinh_t / x_block[1][lane];
                const double d0_product = mu1 * d0;
                const double v0 = scale_2 * d0_product;
                const double v1 = up * scale_2;
                const double log_det_series = polynomial_log_det_series(near_chosen);
                const double log_det_near = h_squared * log_det_series;
                const double log_det = (near ? log_det_near : log(t_ratio));
                const double z0 = W0_0 * v0 + W0_1 * v1;
                const double z1 = W1_0 * v0 + W1_1 * v1;
                const double exp_2 = exp(log_det - 0.5 * (z0 * z0 + z1 * z1));
                const double phi = amplitude_k * exp_2;
                const double by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const double by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const double by_log_det_near = (near ? 1.0 : 0.0);
                const double ratio = (near ? 0.0 : 1.0) / t_ratio;
                const double by_log_det_series = h_squared * by_log_det_near;
                const double log_det_series_slope = polynomial_log_det_series_slope(near_chosen);
                const double by_up = scale_2 * by_v1;
                const double scale_2_product = scale_2 * by_v0;
                const double by_scale_2 = up * by_v1 + d0_product * by_v0;
                const double by_t_over_sinh_t = by_scale_2 / x_block[1][lane];
                const double by_t_over_sinh_t_near = (near ? by_t_over_sinh_t : 0.0);
                const double by_t = (ratio + (near ? 0.0 : by_t_over_sinh_t)) / sinh_t;
                const double by_t_product = t_ratio * by_t;
                const double by_asinh_h = 2.0 * by_t;
                const double sqrt_2 = sqrt(1.0 + near_chosen_2);
                const double by_asinh_h_ratio = by_asinh_h / sqrt_2;
                const double by_h = by_asinh_h_ratio - 2.0 * (sqrt_1_plus_h_to_2 * by_t_product);
                const double by_h_ratio = by_h / h_product;
                const double t_over_sinh_t_near_slope = polynomial_t_over_sinh_t_near_slope(near_chosen);
                const double total_3 = log_det_series * by_log_det_near + (near ? 0.0 : by_h_ratio) + 8.719916288803628 *
                    (near ? by_log_det_series * log_det_series_slope + by_t_over_sinh_t_near * t_over_sinh_t_near_slope :
                    0.0);
                const int is_small = h_squared_total == 0.0;
                const double product_2 = 2.0 * (is_small ? 1.0 : sqrt_1_plus_h_to_2);
                const double ratio_2 = h_product * by_t_product / product_2;
                const double by_h_squared = total_3 + (is_small ? 0.0 : -ratio_2);
                const double product_3 = 2.0 * by_h_squared;
                const double by_part1 = part1 * product_3;
                const double by_part0 = part0 * product_3;
                const double by_d1 = 0.5 * (total_2 * by_up) + scale * by_part1;
                const double by_d0 = mu1 * scale_2_product + d0 * by_up + scale * by_part0;
                const double by_scale = d1 * by_part1 + d0 * by_part0;
                const double by_scale_ratio = by_scale / sqrt_value;
                const int is_small_2 = product == 0.0;
                const double product_4 = 2.0 * (is_small_2 ? 1.0 : length);
                const double ratio_3 = 2.0 * (scale * by_scale_ratio) / product_4;
                const double chosen = (is_small_2 ? 0.0 : -ratio_3);
                const double exponent_by_x1 = by_d1 + (d1_product * by_up - scale_2 * by_t_over_sinh_t + mu1 * chosen);
                const double squared = x_block[1][lane] * x_block[1][lane];
                const double by_df1 = squared * gradient_bar_block[1][lane];
                const double by_df0 = squared * gradient_bar_block[0][lane];
                const double by_exponent_by_x1 = phi * by_df1;
                const double by_by_d0 = phi * by_df0;
                const double by_phi = value_bar_block[0][lane] + exponent_by_x1 * by_df1 + by_d0 * by_df0;
                const double ratio_4 = (is_small_2 ? 0.0 : mu1 * by_exponent_by_x1) / product_4;
                const double product_5 = 2.0 * ratio_4;
                const double sqrt_value_ratio = scale * product_5 / sqrt_value;
                const double by_by_part0 = scale * by_by_d0 - d0 * sqrt_value_ratio;
                const double by_by_part1 = scale * by_exponent_by_x1 - d1 * sqrt_value_ratio;
                const double total_4 = part0 * by_by_part0 + part1 * by_by_part1;
                const double by_by_h_squared = 2.0 * total_4;
                const double ratio_5 = (is_small ? 0.0 : by_by_h_squared) / product_2;
                const double near_chosen_3 = (near ? 17.439832577607255 * total_4 : 0.0);
                const double by_by_t_over_sinh_t_near = t_over_sinh_t_near_slope * near_chosen_3;
                const double by_t_over_sinh_t_near_slope = by_t_over_sinh_t_near * near_chosen_3;
                const double t_over_sinh_t_near_slope_slope = polynomial_t_over_sinh_t_near_slope_slope(near_chosen);
                const double by_by_h = (near ? 0.0 : by_by_h_squared) / h_product;
                const double by_by_asinh_h = by_by_h / sqrt_2;
                const double by_by_h_product = 2.0 * by_by_h;
                const double gap = -(sqrt_1_plus_h_to_2 * by_by_h_product) - h_product * ratio_5;
                const double by_by_t = 2.0 * by_by_asinh_h + t_ratio * gap;
                const double by_by_t_ratio = by_by_t / sinh_t;
                const double product_6 = 0.5 * by_exponent_by_x1;
                const double by_by_up = d0 * by_by_d0 + d1_product * by_exponent_by_x1 + total_2 * product_6;
                const double by_by_t_over_sinh_t = (near ? 0.0 : by_by_t_ratio) + (near ? by_by_t_over_sinh_t_near : 0.0)
                    - scale_2 * by_exponent_by_x1;
                const double by_by_scale_2 = by_by_t_over_sinh_t / x_block[1][lane];
                const double by_by_d0_product = mu1 * by_by_d0;
                const double by_by_v0 = scale_2 * by_by_d0_product + d0_product * by_by_scale_2;
                const double by_by_v1 = up * by_by_scale_2 + scale_2 * by_by_up;
                const double by_by_log_det_series = log_det_series_slope * near_chosen_3;
                const double by_log_det_series_slope = by_log_det_series * near_chosen_3;
                const double log_det_series_slope_slope = polynomial_log_det_series_slope_slope(near_chosen);
                const double by_log_det = exp_2 * (amplitude_k * by_phi);
                const double by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - z1 * by_log_det;
                const double by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - z0 * by_log_det;
                const double by_v1_2 = W1_1 * by_z1 + W0_1 * by_z0;
                const double by_v0_2 = W1_0 * by_z1 + W0_0 * by_z0;
                const double by_log_det_near_2 = (near ? by_log_det : 0.0);
                const double by_log_det_series_2 = by_log_det_near * by_by_h_squared + h_squared * by_log_det_near_2;
                const double by_up_2 = by_v1 * by_by_scale_2 + scale_2 * by_v1_2;
                const double by_scale_2_2 = by_v0 * by_by_d0_product - by_t_over_sinh_t * by_exponent_by_x1 + by_v1 *
                    by_by_up + up * by_v1_2 + d0_product * by_v0_2;
                const double total_5 = by_v0 * by_by_scale_2 + scale_2 * by_v0_2;
                const double by_t_over_sinh_t_2 = by_scale_2_2 / x_block[1][lane];
                const double by_t_over_sinh_t_near_2 = (near ? by_t_over_sinh_t_2 : 0.0);
                const double total_6 = by_t * gap - ratio * (by_by_t_ratio / t_ratio) + (near ? 0.0 : by_log_det) /
                    t_ratio + (near ? 0.0 : by_t_over_sinh_t_2);
                const double by_t_2 = total_6 / sinh_t;
                const double by_sinh_t = -(by_t * by_by_t_ratio) - t_ratio * by_t_2;
                const double by_sqrt_1_plus_h_to_2 = (is_small ? 0.0 : 2.0 * (ratio_2 * ratio_5)) - by_t_product *
                    by_by_h_product + h_product * by_sinh_t;
                const double product_7 = 2.0 * (-(by_h_ratio * by_by_h) - by_t_product * ratio_5 + sqrt_1_plus_h_to_2 *
                    by_sinh_t);
                const double by_asinh_h_2 = 2.0 * by_t_2;
                const double by_h_2 = product_7 + by_asinh_h_2 / sqrt_2;
                const double total_7 = by_log_det_near * by_by_log_det_series + log_det_series * by_log_det_near_2 + (near
                    ? 0.0 : by_h_2 / h_product - by_asinh_h_ratio * by_by_asinh_h / (2.0 * sqrt_2));
                const double near_chosen_4 = (near ? by_t_over_sinh_t_near_slope * t_over_sinh_t_near_slope_slope +
                    by_log_det_series_slope * log_det_series_slope_slope + log_det_series_slope * by_log_det_series_2 +
                    t_over_sinh_t_near_slope * by_t_over_sinh_t_near_2 : 0.0);
                const double by_h_squared_2 = total_7 + 8.719916288803628 * near_chosen_4 + (is_small ? 0.0 :
                    by_sqrt_1_plus_h_to_2 / product_2);
                const double product_8 = 2.0 * by_h_squared_2;
                const double by_part1_2 = product_3 * by_by_part1 + part1 * product_8;
                const double by_part0_2 = product_3 * by_by_part0 + part0 * product_8;
                const double by_d1_2 = 0.5 * (by_up * by_exponent_by_x1 + total_2 * by_up_2) - by_part1 * sqrt_value_ratio
                    + scale * by_part1_2;
                const double by_d0_2 = by_up * by_by_d0 - by_part0 * sqrt_value_ratio + mu1 * total_5 + d0 * by_up_2 +
                    scale * by_part0_2;
                const double by_scale_3 = by_part0 * by_by_d0 - by_scale_ratio * product_5 + by_part1 * by_exponent_by_x1
                    + d1 * by_part1_2 + d0 * by_part0_2;
                const double by_sqrt_value = by_scale_ratio * sqrt_value_ratio - scale * (by_scale_3 / sqrt_value);
                const double ratio_6 = ((is_small_2 ? 0.0 : 2.0 * (ratio_3 * ratio_4)) + 2.0 * by_sqrt_value) / product_4;
                const double total_8 = chosen * by_exponent_by_x1 + scale_2_product * by_by_d0 + d0 * total_5 + (by_up *
                    product_6 + d1_product * by_up_2) + x_block[1][lane] * (is_small_2 ? 0.0 : ratio_6);
                sum[0][lane] += -by_d0_2;
                sum[1][lane] += total_8 - by_d1_2;
                sum[2][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[3][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[4][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[5][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[6][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 7; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[2 * k + 0] += total[0];
            mu_bar[2 * k + 1] += total[1];
            W_bar[4 * k + 0] += total[2];
            W_bar[4 * k + 1] += total[3];
            W_bar[4 * k + 2] += total[4];
            W_bar[4 * k + 3] += total[5];
            amplitude_bar[1 * k + 0] += total[6];
        }
    }
    restore_denormals(mode);
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

/* Of degree 6, within 2^-30 of that of double precision. */
static inline float polynomial_t_over_sinh_t_near_slope_slope_f(float x) {
    return 0.014028269221378524f + x * (-0.004136815832245224f + x * (0.0008433872999278661f + x *
        (-0.00014649483800952389f + x * (2.3118113730214914e-05f + x * (-3.253385053618904e-06f + x *
        3.1461159265860754e-07f)))));
}

/* Of degree 6, within 2^-31 of that of double precision. */
static inline float polynomial_log_det_series_slope_slope_f(float x) {
    return -0.0052698789147766385f + x * (0.0013304204633056561f + x * (-0.00024038029119705448f + x *
        (3.783386377263302e-05f + x * (-5.498485307465418e-06f + x * (7.242797860685044e-07f + x *
        -6.694691049633411e-08f)))));
}

void half_space_splats_f(
    size_t count,
    size_t splat_count,
    const float *HALF_SPACE_RESTRICT x,
    const float *HALF_SPACE_RESTRICT mu,
    const float *HALF_SPACE_RESTRICT W,
    const float *HALF_SPACE_RESTRICT amplitude,
    float *HALF_SPACE_RESTRICT value,
    float *HALF_SPACE_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[2][LANES], sum[3][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 2; ++i) x_block[i][lane] = x[2 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const float mu0 = mu[2 * k + 0];
            const float mu1 = mu[2 * k + 1];
            const float W0_0 = W[4 * k + 0];
            const float W0_1 = W[4 * k + 1];
            const float W1_0 = W[4 * k + 2];
            const float W1_1 = W[4 * k + 3];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float d0 = x_block[0][lane] - mu0;
                const float d1 = x_block[1][lane] - mu1;
                const float product = x_block[1][lane] * mu1;
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
                const float total_2 = x_block[1][lane] + mu1;
                const float up = 0.5f * dot_ds_ds + d1_product * total_2;
                const float scale_2 = t_over_sinh_t / x_block[1][lane];
                const float d0_product = mu1 * d0;
                const float v0 = scale_2 * d0_product;
                const float v1 = up * scale_2;
                const float log_det_series = polynomial_log_det_series_f(near_chosen);
                const float log_det_near = h_squared * log_det_series;
                const float log_det = (near ? log_det_near : logf(t_ratio));
                const float z0 = W0_0 * v0 + W0_1 * v1;
                const float z1 = W1_0 * v0 + W1_1 * v1;
                const float exp_2 = expf(log_det - 0.5f * (z0 * z0 + z1 * z1));
                const float phi = amplitude_k * exp_2;
                const float by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const float by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const float by_log_det_near = (near ? 1.0f : 0.0f);
                const float by_log_det_series = h_squared * by_log_det_near;
                const float log_det_series_slope = polynomial_log_det_series_slope_f(near_chosen);
                const float by_up = scale_2 * by_v1;
                const float by_scale_2 = up * by_v1 + d0_product * by_v0;
                const float by_t_over_sinh_t = by_scale_2 / x_block[1][lane];
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
                const float by_d0 = mu1 * (scale_2 * by_v0) + d0 * by_up + scale * by_part0;
                const float by_scale = d1 * by_part1 + d0 * by_part0;
                const int is_small_2 = product == 0.0f;
                const float minus = -(2.0f * (scale * (by_scale / sqrt_value)) / (2.0f * (is_small_2 ? 1.0f : length)));
                const float exponent_by_x1 = by_d1 + (d1_product * by_up - scale_2 * by_t_over_sinh_t + mu1 * (is_small_2
                    ? 0.0f : minus));
                const float df0 = phi * by_d0;
                const float df1 = phi * exponent_by_x1;
                const float squared = x_block[1][lane] * x_block[1][lane];
                const float gradient0 = df0 * squared;
                const float gradient1 = df1 * squared;
                sum[0][lane] += phi;
                sum[1][lane] += gradient0;
                sum[2][lane] += gradient1;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 2; ++i) gradient[2 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void half_space_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *HALF_SPACE_RESTRICT x,
    const float *HALF_SPACE_RESTRICT mu,
    const float *HALF_SPACE_RESTRICT W,
    const float *HALF_SPACE_RESTRICT amplitude,
    const float *HALF_SPACE_RESTRICT value_bar,
    const float *HALF_SPACE_RESTRICT gradient_bar,
    float *HALF_SPACE_RESTRICT mu_bar,
    float *HALF_SPACE_RESTRICT W_bar,
    float *HALF_SPACE_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 2 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 4 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[2][LANES], value_bar_block[1][LANES], gradient_bar_block[2][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const float weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 2; ++i) x_block[i][lane] = x[2 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 2; ++i) gradient_bar_block[i][lane] = gradient_bar[2 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 2; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            float sum[7][LANES] = {{0}}, total[7] = {0};
            const float mu0 = mu[2 * k + 0];
            const float mu1 = mu[2 * k + 1];
            const float W0_0 = W[4 * k + 0];
            const float W0_1 = W[4 * k + 1];
            const float W1_0 = W[4 * k + 2];
            const float W1_1 = W[4 * k + 3];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float d0 = x_block[0][lane] - mu0;
                const float d1 = x_block[1][lane] - mu1;
                const float product = x_block[1][lane] * mu1;
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
                const float total_2 = x_block[1][lane] + mu1;
                const float up = 0.5f * dot_ds_ds + d1_product * total_2;
                const float scale_2 = t_over_sinh_t / x_block[1][lane];
                const float d0_product = mu1 * d0;
                const float v0 = scale_2 * d0_product;
                const float v1 = up * scale_2;
                const float log_det_series = polynomial_log_det_series_f(near_chosen);
                const float log_det_near = h_squared * log_det_series;
                const float log_det = (near ? log_det_near : logf(t_ratio));
                const float z0 = W0_0 * v0 + W0_1 * v1;
                const float z1 = W1_0 * v0 + W1_1 * v1;
                const float exp_2 = expf(log_det - 0.5f * (z0 * z0 + z1 * z1));
                const float phi = amplitude_k * exp_2;
                const float by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const float by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const float by_log_det_near = (near ? 1.0f : 0.0f);
                const float ratio = (near ? 0.0f : 1.0f) / t_ratio;
                const float by_log_det_series = h_squared * by_log_det_near;
                const float log_det_series_slope = polynomial_log_det_series_slope_f(near_chosen);
                const float by_up = scale_2 * by_v1;
                const float scale_2_product = scale_2 * by_v0;
                const float by_scale_2 = up * by_v1 + d0_product * by_v0;
                const float by_t_over_sinh_t = by_scale_2 / x_block[1][lane];
                const float by_t_over_sinh_t_near = (near ? by_t_over_sinh_t : 0.0f);
                const float by_t = (ratio + (near ? 0.0f : by_t_over_sinh_t)) / sinh_t;
                const float by_t_product = t_ratio * by_t;
                const float by_asinh_h = 2.0f * by_t;
                const float sqrt_2 = sqrtf(1.0f + near_chosen_2);
                const float by_asinh_h_ratio = by_asinh_h / sqrt_2;
                const float by_h = by_asinh_h_ratio - 2.0f * (sqrt_1_plus_h_to_2 * by_t_product);
                const float by_h_ratio = by_h / h_product;
                const float t_over_sinh_t_near_slope = polynomial_t_over_sinh_t_near_slope_f(near_chosen);
                const float total_3 = log_det_series * by_log_det_near + (near ? 0.0f : by_h_ratio) + 8.719916288803628f *
                    (near ? by_log_det_series * log_det_series_slope + by_t_over_sinh_t_near * t_over_sinh_t_near_slope :
                    0.0f);
                const int is_small = h_squared_total == 0.0f;
                const float product_2 = 2.0f * (is_small ? 1.0f : sqrt_1_plus_h_to_2);
                const float ratio_2 = h_product * by_t_product / product_2;
                const float by_h_squared = total_3 + (is_small ? 0.0f : -ratio_2);
                const float product_3 = 2.0f * by_h_squared;
                const float by_part1 = part1 * product_3;
                const float by_part0 = part0 * product_3;
                const float by_d1 = 0.5f * (total_2 * by_up) + scale * by_part1;
                const float by_d0 = mu1 * scale_2_product + d0 * by_up + scale * by_part0;
                const float by_scale = d1 * by_part1 + d0 * by_part0;
                const float by_scale_ratio = by_scale / sqrt_value;
                const int is_small_2 = product == 0.0f;
                const float product_4 = 2.0f * (is_small_2 ? 1.0f : length);
                const float ratio_3 = 2.0f * (scale * by_scale_ratio) / product_4;
                const float chosen = (is_small_2 ? 0.0f : -ratio_3);
                const float exponent_by_x1 = by_d1 + (d1_product * by_up - scale_2 * by_t_over_sinh_t + mu1 * chosen);
                const float squared = x_block[1][lane] * x_block[1][lane];
                const float by_df1 = squared * gradient_bar_block[1][lane];
                const float by_df0 = squared * gradient_bar_block[0][lane];
                const float by_exponent_by_x1 = phi * by_df1;
                const float by_by_d0 = phi * by_df0;
                const float by_phi = value_bar_block[0][lane] + exponent_by_x1 * by_df1 + by_d0 * by_df0;
                const float ratio_4 = (is_small_2 ? 0.0f : mu1 * by_exponent_by_x1) / product_4;
                const float product_5 = 2.0f * ratio_4;
                const float sqrt_value_ratio = scale * product_5 / sqrt_value;
                const float by_by_part0 = scale * by_by_d0 - d0 * sqrt_value_ratio;
                const float by_by_part1 = scale * by_exponent_by_x1 - d1 * sqrt_value_ratio;
                const float total_4 = part0 * by_by_part0 + part1 * by_by_part1;
                const float by_by_h_squared = 2.0f * total_4;
                const float ratio_5 = (is_small ? 0.0f : by_by_h_squared) / product_2;
                const float near_chosen_3 = (near ? 17.439832577607255f * total_4 : 0.0f);
                const float by_by_t_over_sinh_t_near = t_over_sinh_t_near_slope * near_chosen_3;
                const float by_t_over_sinh_t_near_slope = by_t_over_sinh_t_near * near_chosen_3;
                const float t_over_sinh_t_near_slope_slope = polynomial_t_over_sinh_t_near_slope_slope_f(near_chosen);
                const float by_by_h = (near ? 0.0f : by_by_h_squared) / h_product;
                const float by_by_asinh_h = by_by_h / sqrt_2;
                const float by_by_h_product = 2.0f * by_by_h;
                const float gap = -(sqrt_1_plus_h_to_2 * by_by_h_product) - h_product * ratio_5;
                const float by_by_t = 2.0f * by_by_asinh_h + t_ratio * gap;
                const float by_by_t_ratio = by_by_t / sinh_t;
                const float product_6 = 0.5f * by_exponent_by_x1;
                const float by_by_up = d0 * by_by_d0 + d1_product * by_exponent_by_x1 + total_2 * product_6;
                const float by_by_t_over_sinh_t = (near ? 0.0f : by_by_t_ratio) + (near ? by_by_t_over_sinh_t_near : 0.0f)
                    - scale_2 * by_exponent_by_x1;
                const float by_by_scale_2 = by_by_t_over_sinh_t / x_block[1][lane];
                const float by_by_d0_product = mu1 * by_by_d0;
                const float by_by_v0 = scale_2 * by_by_d0_product + d0_product * by_by_scale_2;
                const float by_by_v1 = up * by_by_scale_2 + scale_2 * by_by_up;
                const float by_by_log_det_series = log_det_series_slope * near_chosen_3;
                const float by_log_det_series_slope = by_log_det_series * near_chosen_3;
                const float log_det_series_slope_slope = polynomial_log_det_series_slope_slope_f(near_chosen);
                const float by_log_det = exp_2 * (amplitude_k * by_phi);
                const float by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - z1 * by_log_det;
                const float by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - z0 * by_log_det;
                const float by_v1_2 = W1_1 * by_z1 + W0_1 * by_z0;
                const float by_v0_2 = W1_0 * by_z1 + W0_0 * by_z0;
                const float by_log_det_near_2 = (near ? by_log_det : 0.0f);
                const float by_log_det_series_2 = by_log_det_near * by_by_h_squared + h_squared * by_log_det_near_2;
                const float by_up_2 = by_v1 * by_by_scale_2 + scale_2 * by_v1_2;
                const float by_scale_2_2 = by_v0 * by_by_d0_product - by_t_over_sinh_t * by_exponent_by_x1 + by_v1 *
                    by_by_up + up * by_v1_2 + d0_product * by_v0_2;
                const float total_5 = by_v0 * by_by_scale_2 + scale_2 * by_v0_2;
                const float by_t_over_sinh_t_2 = by_scale_2_2 / x_block[1][lane];
                const float by_t_over_sinh_t_near_2 = (near ? by_t_over_sinh_t_2 : 0.0f);
                const float total_6 = by_t * gap - ratio * (by_by_t_ratio / t_ratio) + (near ? 0.0f : by_log_det) /
                    t_ratio + (near ? 0.0f : by_t_over_sinh_t_2);
                const float by_t_2 = total_6 / sinh_t;
                const float by_sinh_t = -(by_t * by_by_t_ratio) - t_ratio * by_t_2;
                const float by_sqrt_1_plus_h_to_2 = (is_small ? 0.0f : 2.0f * (ratio_2 * ratio_5)) - by_t_product *
                    by_by_h_product + h_product * by_sinh_t;
                const float product_7 = 2.0f * (-(by_h_ratio * by_by_h) - by_t_product * ratio_5 + sqrt_1_plus_h_to_2 *
                    by_sinh_t);
                const float by_asinh_h_2 = 2.0f * by_t_2;
                const float by_h_2 = product_7 + by_asinh_h_2 / sqrt_2;
                const float total_7 = by_log_det_near * by_by_log_det_series + log_det_series * by_log_det_near_2 + (near
                    ? 0.0f : by_h_2 / h_product - by_asinh_h_ratio * by_by_asinh_h / (2.0f * sqrt_2));
                const float near_chosen_4 = (near ? by_t_over_sinh_t_near_slope * t_over_sinh_t_near_slope_slope +
                    by_log_det_series_slope * log_det_series_slope_slope + log_det_series_slope * by_log_det_series_2 +
                    t_over_sinh_t_near_slope * by_t_over_sinh_t_near_2 : 0.0f);
                const float by_h_squared_2 = total_7 + 8.719916288803628f * near_chosen_4 + (is_small ? 0.0f :
                    by_sqrt_1_plus_h_to_2 / product_2);
                const float product_8 = 2.0f * by_h_squared_2;
                const float by_part1_2 = product_3 * by_by_part1 + part1 * product_8;
                const float by_part0_2 = product_3 * by_by_part0 + part0 * product_8;
                const float by_d1_2 = 0.5f * (by_up * by_exponent_by_x1 + total_2 * by_up_2) - by_part1 * sqrt_value_ratio
                    + scale * by_part1_2;
                const float by_d0_2 = by_up * by_by_d0 - by_part0 * sqrt_value_ratio + mu1 * total_5 + d0 * by_up_2 +
                    scale * by_part0_2;
                const float by_scale_3 = by_part0 * by_by_d0 - by_scale_ratio * product_5 + by_part1 * by_exponent_by_x1 +
                    d1 * by_part1_2 + d0 * by_part0_2;
                const float by_sqrt_value = by_scale_ratio * sqrt_value_ratio - scale * (by_scale_3 / sqrt_value);
                const float ratio_6 = ((is_small_2 ? 0.0f : 2.0f * (ratio_3 * ratio_4)) + 2.0f * by_sqrt_value) /
                    product_4;
                const float total_8 = chosen * by_exponent_by_x1 + scale_2_product * by_by_d0 + d0 * total_5 + (by_up *
                    product_6 + d1_product * by_up_2) + x_block[1][lane] * (is_small_2 ? 0.0f : ratio_6);
                sum[0][lane] += -by_d0_2;
                sum[1][lane] += total_8 - by_d1_2;
                sum[2][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[3][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[4][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[5][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[6][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 7; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[2 * k + 0] += total[0];
            mu_bar[2 * k + 1] += total[1];
            W_bar[4 * k + 0] += total[2];
            W_bar[4 * k + 1] += total[3];
            W_bar[4 * k + 2] += total[4];
            W_bar[4 * k + 3] += total[5];
            amplitude_bar[1 * k + 0] += total[6];
        }
    }
    restore_denormals(mode);
}
