/*
 * sphere: The sphere S^n as unit vectors of R^(n+1); distances are angles in radians, times the radius.
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "sphere.h"

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

/* Of degree 12 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_t_over_norm_w_near_slope_slope(double x) {
    return 0.06633574501534423 + x * (0.04253843612879113 + x * (0.01885899109573648 + x *
        (0.007125793473117345 + x * (0.0024605949962752485 + x * (0.000801221638505051 + x *
        (0.0002528934817317952 + x * (7.121595173612734e-05 + x * (3.1371953208965205e-05 + x *
        (-3.9300127146556635e-06 + x * (1.0326437124379481e-05 + x * (-3.620302200480517e-06 + x *
        1.185519326503373e-06)))))))))));
}

/* Of degree 12 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_log_det_series_slope_slope(double x) {
    return 0.0062299443069765426 + x * (0.0034201427826052676 + x * (0.0013437824595684026 + x *
        (0.0004600422003457931 + x * (0.00014615507008033484 + x * (4.429380489494613e-05 + x *
        (1.3085823480304379e-05 + x * (3.5570305708548004e-06 + x * (1.3664068876122816e-06 + x *
        (-8.38146084321007e-08 + x * (3.833569024093774e-07 + x * (-1.2780387682666445e-07 + x *
        4.350990036456014e-08)))))))))));
}

void sphere_splats(
    size_t count,
    size_t splat_count,
    const double *SPHERE_RESTRICT x,
    const double *SPHERE_RESTRICT mu,
    const double *SPHERE_RESTRICT W,
    const double *SPHERE_RESTRICT amplitude,
    double *SPHERE_RESTRICT value,
    double *SPHERE_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[3][LANES], sum[4][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 3; ++i) x_block[i][lane] = x[3 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const double mu0 = mu[3 * k + 0];
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
                const double q_plus_p0 = x_block[0][lane] + mu0;
                const double q_plus_p1 = x_block[1][lane] + mu1;
                const double q_plus_p2 = x_block[2][lane] + mu2;
                const double norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 *
                    q_plus_p2;
                const double norm_q_plus_p = sqrt(norm_q_plus_p_squared);
                const double squared = mu0 * mu0;
                const double gap = 1.0 - squared;
                const double gap_2 = 1.0 - mu1 * mu1;
                const int on_cut_locus = norm_q_plus_p <= 4.0 * DBL_EPSILON;
                const double q0_off_cut = (on_cut_locus ? mu0 : x_block[0][lane]);
                const double q1_off_cut = (on_cut_locus ? mu1 : x_block[1][lane]);
                const double q2_off_cut = (on_cut_locus ? mu2 : x_block[2][lane]);
                const double d0 = q0_off_cut - mu0;
                const double d1 = q1_off_cut - mu1;
                const double d2 = q2_off_cut - mu2;
                const double norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
                const double q_plus_p0_2 = mu0 + q0_off_cut;
                const double q_plus_p1_2 = mu1 + q1_off_cut;
                const double q_plus_p2_2 = mu2 + q2_off_cut;
                const double norm_q_plus_p_squared_2 = q_plus_p0_2 * q_plus_p0_2 + q_plus_p1_2 * q_plus_p1_2 + q_plus_p2_2
                    * q_plus_p2_2;
                const double norm_q_plus_p_2 = sqrt(norm_q_plus_p_squared_2);
                const double dot_p_q = mu0 * q0_off_cut + mu1 * q1_off_cut + mu2 * q2_off_cut;
                const int is_small = dot_p_q < 0.0;
                const double e0 = (is_small ? q_plus_p0_2 : d0);
                const double e1 = (is_small ? q_plus_p1_2 : d1);
                const double e2 = (is_small ? q_plus_p2_2 : d2);
                const double dot_p_e = mu0 * e0 + mu1 * e1 + mu2 * e2;
                const double w0 = e0 - mu0 * dot_p_e;
                const double w1 = e1 - mu1 * dot_p_e;
                const double w2 = e2 - mu2 * dot_p_e;
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
                const double product = mu0 * mu1;
                const double sine_to_axis1 = sqrt((is_small_2 ? 1.0 : gap_2));
                const double v0 = (on_cut_locus ? 3.141592653589793 * (is_small_2 ? gap / sine_to_axis0 : -(product /
                    sine_to_axis1)) : w0 * t_over_norm_w);
                const double v1 = (on_cut_locus ? 3.141592653589793 * (is_small_2 ? -(product / sine_to_axis0) : gap_2 /
                    sine_to_axis1) : w1 * t_over_norm_w);
                const double product_2 = 3.141592653589793 * (is_small_2 ? -(mu0 * mu2 / sine_to_axis0) : -(mu1 * mu2 /
                    sine_to_axis1));
                const double v2 = (on_cut_locus ? product_2 : w2 * t_over_norm_w);
                const double log_value = log(0.7853981633974483 / DBL_EPSILON);
                const double log_det_series = polynomial_log_det_series(near_chosen);
                const double log_det_near = norm_d_squared * log_det_series;
                const double log_det = (near ? log_det_near : log(t_ratio));
                const double z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const double z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const double exp_2 = exp((on_cut_locus ? log_value : log_det) - 0.5 * (z0 * z0 + z1 * z1));
                const double phi = amplitude_k * exp_2;
                const double by_v2 = -(W1_2 * z1) - W0_2 * z0;
                const double by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const double by_v0 = -(W1_0 * z1) - W0_0 * z0;
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
                const double by_dot_p_e = -(mu2 * by_w2) - mu1 * by_w1 - mu0 * by_w0;
                const double by_e2 = by_w2 + mu2 * by_dot_p_e;
                const double by_e1 = by_w1 + mu1 * by_dot_p_e;
                const double by_e0 = by_w0 + mu0 * by_dot_p_e;
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
                const double normal_part = x_block[0][lane] * df0 + x_block[1][lane] * df1 + x_block[2][lane] * df2;
                const double gradient0 = df0 - x_block[0][lane] * normal_part;
                const double gradient1 = df1 - x_block[1][lane] * normal_part;
                const double gradient2 = df2 - x_block[2][lane] * normal_part;
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

void sphere_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *SPHERE_RESTRICT x,
    const double *SPHERE_RESTRICT mu,
    const double *SPHERE_RESTRICT W,
    const double *SPHERE_RESTRICT amplitude,
    const double *SPHERE_RESTRICT value_bar,
    const double *SPHERE_RESTRICT gradient_bar,
    double *SPHERE_RESTRICT mu_bar,
    double *SPHERE_RESTRICT W_bar,
    double *SPHERE_RESTRICT amplitude_bar) {
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
            const double mu0 = mu[3 * k + 0];
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
                const double q_plus_p0 = x_block[0][lane] + mu0;
                const double q_plus_p1 = x_block[1][lane] + mu1;
                const double q_plus_p2 = x_block[2][lane] + mu2;
                const double norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 *
                    q_plus_p2;
                const double norm_q_plus_p = sqrt(norm_q_plus_p_squared);
                const double squared = mu0 * mu0;
                const double gap = 1.0 - squared;
                const double gap_2 = 1.0 - mu1 * mu1;
                const int on_cut_locus = norm_q_plus_p <= 4.0 * DBL_EPSILON;
                const double q0_off_cut = (on_cut_locus ? mu0 : x_block[0][lane]);
                const double q1_off_cut = (on_cut_locus ? mu1 : x_block[1][lane]);
                const double q2_off_cut = (on_cut_locus ? mu2 : x_block[2][lane]);
                const double d0 = q0_off_cut - mu0;
                const double d1 = q1_off_cut - mu1;
                const double d2 = q2_off_cut - mu2;
                const double norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
                const double q_plus_p0_2 = mu0 + q0_off_cut;
                const double q_plus_p1_2 = mu1 + q1_off_cut;
                const double q_plus_p2_2 = mu2 + q2_off_cut;
                const double norm_q_plus_p_squared_2 = q_plus_p0_2 * q_plus_p0_2 + q_plus_p1_2 * q_plus_p1_2 + q_plus_p2_2
                    * q_plus_p2_2;
                const double norm_q_plus_p_2 = sqrt(norm_q_plus_p_squared_2);
                const double dot_p_q = mu0 * q0_off_cut + mu1 * q1_off_cut + mu2 * q2_off_cut;
                const int is_small = dot_p_q < 0.0;
                const double e0 = (is_small ? q_plus_p0_2 : d0);
                const double e1 = (is_small ? q_plus_p1_2 : d1);
                const double e2 = (is_small ? q_plus_p2_2 : d2);
                const double dot_p_e = mu0 * e0 + mu1 * e1 + mu2 * e2;
                const double w0 = e0 - mu0 * dot_p_e;
                const double w1 = e1 - mu1 * dot_p_e;
                const double w2 = e2 - mu2 * dot_p_e;
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
                const double chosen = (is_small_2 ? gap : 1.0);
                const double sine_to_axis0 = sqrt(chosen);
                const double ratio = gap / sine_to_axis0;
                const double product = mu0 * mu1;
                const double chosen_2 = (is_small_2 ? 1.0 : gap_2);
                const double sine_to_axis1 = sqrt(chosen_2);
                const double ratio_2 = product / sine_to_axis1;
                const double v0 = (on_cut_locus ? 3.141592653589793 * (is_small_2 ? ratio : -ratio_2) : w0 *
                    t_over_norm_w);
                const double ratio_3 = product / sine_to_axis0;
                const double ratio_4 = gap_2 / sine_to_axis1;
                const double v1 = (on_cut_locus ? 3.141592653589793 * (is_small_2 ? -ratio_3 : ratio_4) : w1 *
                    t_over_norm_w);
                const double ratio_5 = mu0 * mu2 / sine_to_axis0;
                const double ratio_6 = mu1 * mu2 / sine_to_axis1;
                const double v2 = (on_cut_locus ? 3.141592653589793 * (is_small_2 ? -ratio_5 : -ratio_6) : w2 *
                    t_over_norm_w);
                const double log_value = log(0.7853981633974483 / DBL_EPSILON);
                const double log_det_series = polynomial_log_det_series(near_chosen);
                const double log_det_near = norm_d_squared * log_det_series;
                const double log_det = (near ? log_det_near : log(t_ratio));
                const double z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const double z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const double exp_2 = exp((on_cut_locus ? log_value : log_det) - 0.5 * (z0 * z0 + z1 * z1));
                const double phi = amplitude_k * exp_2;
                const double by_v2 = -(W1_2 * z1) - W0_2 * z0;
                const double by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const double by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const double by_log_det = (on_cut_locus ? 0.0 : 1.0);
                const double by_log_det_near = (near ? by_log_det : 0.0);
                const double ratio_7 = (near ? 0.0 : by_log_det) / t_ratio;
                const double by_log_det_series = norm_d_squared * by_log_det_near;
                const double log_det_series_slope = polynomial_log_det_series_slope(near_chosen);
                const double chosen_3 = (on_cut_locus ? 0.0 : by_v2);
                const double chosen_4 = (on_cut_locus ? 0.0 : by_v1);
                const double chosen_5 = (on_cut_locus ? 0.0 : by_v0);
                const double by_t_over_norm_w = w2 * chosen_3 + w1 * chosen_4 + w0 * chosen_5;
                const double by_t_over_norm_w_near = (near ? by_t_over_norm_w : 0.0);
                const double by_t = (ratio_7 + (near ? 0.0 : by_t_over_norm_w)) / norm_w;
                const double norm_w_product = 2.0 * norm_w;
                const double ratio_8 = t_ratio * by_t / norm_w_product;
                const double by_norm_w_squared = (near ? 0.0 : -ratio_8);
                const double by_atan2_value = 2.0 * by_t;
                const double total_2 = norm_q_plus_p_squared_2 + near_chosen_2;
                const double ratio_9 = by_atan2_value / total_2;
                const double by_norm_d = norm_q_plus_p_2 * ratio_9;
                const double norm_d_product = 2.0 * norm_d;
                const double by_norm_d_ratio = by_norm_d / norm_d_product;
                const double t_over_norm_w_near_slope = polynomial_t_over_norm_w_near_slope(near_chosen);
                const double by_norm_d_squared = log_det_series * by_log_det_near + (near ? 0.0 : by_norm_d_ratio) +
                    1.0024911906086624 * (near ? by_log_det_series * log_det_series_slope + by_t_over_norm_w_near *
                    t_over_norm_w_near_slope : 0.0);
                const double product_2 = 2.0 * by_norm_w_squared;
                const double by_w2 = t_over_norm_w * chosen_3 + w2 * product_2;
                const double by_w1 = t_over_norm_w * chosen_4 + w1 * product_2;
                const double by_w0 = t_over_norm_w * chosen_5 + w0 * product_2;
                const double by_dot_p_e = -(mu2 * by_w2) - mu1 * by_w1 - mu0 * by_w0;
                const double by_e2 = by_w2 + mu2 * by_dot_p_e;
                const double by_e1 = by_w1 + mu1 * by_dot_p_e;
                const double by_e0 = by_w0 + mu0 * by_dot_p_e;
                const int is_small_3 = norm_q_plus_p_squared_2 == 0.0;
                const double product_3 = 2.0 * (is_small_3 ? 1.0 : norm_q_plus_p_2);
                const double ratio_10 = norm_d * ratio_9 / product_3;
                const double by_norm_q_plus_p_squared_2 = (is_small_3 ? 0.0 : -ratio_10);
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
                const double by_normal_part = -(x_block[2][lane] * gradient_bar_block[2][lane]) - x_block[1][lane] *
                    gradient_bar_block[1][lane] - x_block[0][lane] * gradient_bar_block[0][lane];
                const double by_df2 = gradient_bar_block[2][lane] + x_block[2][lane] * by_normal_part;
                const double by_df1 = gradient_bar_block[1][lane] + x_block[1][lane] * by_normal_part;
                const double by_df0 = gradient_bar_block[0][lane] + x_block[0][lane] * by_normal_part;
                const double by_exponent_by_x2 = phi * by_df2;
                const double by_exponent_by_x1 = phi * by_df1;
                const double by_exponent_by_x0 = phi * by_df0;
                const double by_phi = value_bar_block[0][lane] + exponent_by_x2 * by_df2 + exponent_by_x1 * by_df1 +
                    exponent_by_x0 * by_df0;
                const double by_by_q0_off_cut = (on_cut_locus ? 0.0 : by_exponent_by_x0);
                const double by_by_q1_off_cut = (on_cut_locus ? 0.0 : by_exponent_by_x1);
                const double by_by_q2_off_cut = (on_cut_locus ? 0.0 : by_exponent_by_x2);
                const double total_3 = d0 * by_by_q0_off_cut + d1 * by_by_q1_off_cut + d2 * by_by_q2_off_cut;
                const double by_by_norm_d_squared = 2.0 * total_3;
                const double by_by_norm_q_plus_p_squared_2 = 2.0 * (q_plus_p0_2 * by_by_q0_off_cut + q_plus_p1_2 *
                    by_by_q1_off_cut + q_plus_p2_2 * by_by_q2_off_cut);
                const double ratio_11 = (is_small_3 ? 0.0 : by_by_norm_q_plus_p_squared_2) / product_3;
                const double by_by_e0 = (is_small ? by_by_q0_off_cut : 0.0) + (is_small ? 0.0 : by_by_q0_off_cut);
                const double by_by_e1 = (is_small ? by_by_q1_off_cut : 0.0) + (is_small ? 0.0 : by_by_q1_off_cut);
                const double by_by_e2 = (is_small ? by_by_q2_off_cut : 0.0) + (is_small ? 0.0 : by_by_q2_off_cut);
                const double by_by_dot_p_e = mu0 * by_by_e0 + mu1 * by_by_e1 + mu2 * by_by_e2;
                const double by_by_w0 = by_by_e0 - mu0 * by_by_dot_p_e;
                const double by_by_w1 = by_by_e1 - mu1 * by_by_dot_p_e;
                const double by_by_w2 = by_by_e2 - mu2 * by_by_dot_p_e;
                const double by_by_norm_w_squared = 2.0 * (w0 * by_by_w0 + w1 * by_by_w1 + w2 * by_by_w2);
                const double near_chosen_3 = (near ? 2.004982381217325 * total_3 : 0.0);
                const double by_by_t_over_norm_w_near = t_over_norm_w_near_slope * near_chosen_3;
                const double by_t_over_norm_w_near_slope = by_t_over_norm_w_near * near_chosen_3;
                const double t_over_norm_w_near_slope_slope = polynomial_t_over_norm_w_near_slope_slope(near_chosen);
                const double by_by_norm_d = (near ? 0.0 : by_by_norm_d_squared) / norm_d_product;
                const double by_by_atan2_value = (norm_q_plus_p_2 * by_by_norm_d - norm_d * ratio_11) / total_2;
                const double product_6 = ratio_9 * by_by_atan2_value;
                const double ratio_12 = (near ? 0.0 : by_by_norm_w_squared) / norm_w_product;
                const double by_by_t = 2.0 * by_by_atan2_value - t_ratio * ratio_12;
                const double by_by_t_ratio = by_by_t / norm_w;
                const double by_by_t_over_norm_w = (near ? 0.0 : by_by_t_ratio) + (near ? by_by_t_over_norm_w_near : 0.0);
                const double by_by_v0 = (on_cut_locus ? 0.0 : w0 * by_by_t_over_norm_w + t_over_norm_w * by_by_w0);
                const double by_by_v1 = (on_cut_locus ? 0.0 : w1 * by_by_t_over_norm_w + t_over_norm_w * by_by_w1);
                const double by_by_v2 = (on_cut_locus ? 0.0 : w2 * by_by_t_over_norm_w + t_over_norm_w * by_by_w2);
                const double by_by_log_det_series = log_det_series_slope * near_chosen_3;
                const double by_log_det_series_slope = by_log_det_series * near_chosen_3;
                const double log_det_series_slope_slope = polynomial_log_det_series_slope_slope(near_chosen);
                const double product_7 = exp_2 * (amplitude_k * by_phi);
                const double by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - z1 * product_7;
                const double by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - z0 * product_7;
                const double by_v2_2 = W1_2 * by_z1 + W0_2 * by_z0;
                const double by_v1_2 = W1_1 * by_z1 + W0_1 * by_z0;
                const double by_v0_2 = W1_0 * by_z1 + W0_0 * by_z0;
                const double by_log_det_2 = (on_cut_locus ? 0.0 : product_7);
                const double by_log_det_near_2 = (near ? by_log_det_2 : 0.0);
                const double by_log_det_series_2 = by_log_det_near * by_by_norm_d_squared + norm_d_squared *
                    by_log_det_near_2;
                const double chosen_6 = (on_cut_locus ? 0.0 : by_v2_2);
                const double product_8 = 3.141592653589793 * (on_cut_locus ? by_v2_2 : 0.0);
                const double ratio_13 = (is_small_2 ? 0.0 : product_8) / sine_to_axis1;
                const double ratio_14 = (is_small_2 ? product_8 : 0.0) / sine_to_axis0;
                const double chosen_7 = (on_cut_locus ? 0.0 : by_v1_2);
                const double total_4 = chosen_5 * by_by_w0 + chosen_4 * by_by_w1 + chosen_3 * by_by_w2 + w2 * chosen_6 +
                    w1 * chosen_7;
                const double product_9 = 3.141592653589793 * (on_cut_locus ? by_v1_2 : 0.0);
                const double ratio_15 = (is_small_2 ? 0.0 : product_9) / sine_to_axis1;
                const double ratio_16 = (is_small_2 ? product_9 : 0.0) / sine_to_axis0;
                const double chosen_8 = (on_cut_locus ? 0.0 : by_v0_2);
                const double by_t_over_norm_w_2 = total_4 + w0 * chosen_8;
                const double product_10 = 3.141592653589793 * (on_cut_locus ? by_v0_2 : 0.0);
                const double ratio_17 = (is_small_2 ? 0.0 : product_10) / sine_to_axis1;
                const double gap_3 = -ratio_16 - ratio_17;
                const double by_sine_to_axis1 = ratio_6 * ratio_13 - ratio_4 * ratio_15 + ratio_2 * ratio_17;
                const int is_small_4 = chosen_2 == 0.0;
                const double chosen_9 = (is_small_2 ? 0.0 : (is_small_4 ? 0.0 : by_sine_to_axis1 / (2.0 * (is_small_4 ?
                    1.0 : sine_to_axis1))));
                const double ratio_18 = (is_small_2 ? product_10 : 0.0) / sine_to_axis0;
                const double by_sine_to_axis0 = ratio_5 * ratio_14 + ratio_3 * ratio_16 - ratio * ratio_18;
                const int is_small_5 = chosen == 0.0;
                const double chosen_10 = (is_small_2 ? (is_small_5 ? 0.0 : by_sine_to_axis0 / (2.0 * (is_small_5 ? 1.0 :
                    sine_to_axis0))) : 0.0);
                const double by_t_over_norm_w_near_2 = (near ? by_t_over_norm_w_2 : 0.0);
                const double total_5 = -(by_t * ratio_12) - ratio_7 * (by_by_t_ratio / t_ratio) + (near ? 0.0 :
                    by_log_det_2) / t_ratio + (near ? 0.0 : by_t_over_norm_w_2);
                const double by_t_2 = total_5 / norm_w;
                const double by_norm_w = 2.0 * (ratio_8 * ratio_12) - by_t * by_by_t_ratio - t_ratio * by_t_2;
                const double by_norm_w_squared_2 = (near ? 0.0 : by_norm_w / norm_w_product);
                const double by_atan2_value_2 = 2.0 * by_t_2;
                const double ratio_19 = by_atan2_value_2 / total_2;
                const double by_norm_d_2 = -(2.0 * (by_norm_d_ratio * by_by_norm_d)) - ratio_9 * ratio_11 +
                    norm_q_plus_p_2 * ratio_19;
                const double by_norm_q_plus_p_2 = (is_small_3 ? 0.0 : 2.0 * (ratio_10 * ratio_11)) + ratio_9 *
                    by_by_norm_d - norm_d * ratio_19;
                const double near_chosen_4 = (near ? by_t_over_norm_w_near_slope * t_over_norm_w_near_slope_slope +
                    by_log_det_series_slope * log_det_series_slope_slope + log_det_series_slope * by_log_det_series_2 +
                    t_over_norm_w_near_slope * by_t_over_norm_w_near_2 : 0.0);
                const double by_norm_d_squared_2 = by_log_det_near * by_by_log_det_series + log_det_series *
                    by_log_det_near_2 + (near ? 0.0 : by_norm_d_2 / norm_d_product - product_6) + 1.0024911906086624 *
                    near_chosen_4;
                const double product_11 = 2.0 * by_norm_w_squared_2;
                const double by_w2_2 = product_2 * by_by_w2 + chosen_3 * by_by_t_over_norm_w + t_over_norm_w * chosen_6 +
                    w2 * product_11;
                const double by_w1_2 = product_2 * by_by_w1 + chosen_4 * by_by_t_over_norm_w + t_over_norm_w * chosen_7 +
                    w1 * product_11;
                const double by_w0_2 = product_2 * by_by_w0 + chosen_5 * by_by_t_over_norm_w + t_over_norm_w * chosen_8 +
                    w0 * product_11;
                const double gap_4 = by_dot_p_e * by_by_e2 - by_w2 * by_by_dot_p_e - mu1 * ratio_13 - mu0 * ratio_14 -
                    dot_p_e * by_w2_2;
                const double gap_5 = by_dot_p_e * by_by_e1 - by_w1 * by_by_dot_p_e - mu2 * ratio_13 + mu0 * gap_3 -
                    dot_p_e * by_w1_2;
                const double gap_6 = by_dot_p_e * by_by_e0 - by_w0 * by_by_dot_p_e - mu2 * ratio_14 + mu1 * gap_3 -
                    dot_p_e * by_w0_2;
                const double by_dot_p_e_2 = -(mu2 * by_w2_2) - mu1 * by_w1_2 - mu0 * by_w0_2;
                const double by_e2_2 = by_w2_2 + mu2 * by_dot_p_e_2;
                const double by_e1_2 = by_w1_2 + mu1 * by_dot_p_e_2;
                const double by_e0_2 = by_w0_2 + mu0 * by_dot_p_e_2;
                const double by_norm_q_plus_p_squared_2_2 = (is_small_3 ? 0.0 : by_norm_q_plus_p_2 / product_3) -
                    product_6;
                const double product_12 = 2.0 * by_norm_q_plus_p_squared_2_2;
                const double by_q_plus_p2_2_2 = product_4 * by_by_q2_off_cut + (is_small ? by_e2_2 : 0.0) + q_plus_p2_2 *
                    product_12;
                const double by_q_plus_p1_2_2 = product_4 * by_by_q1_off_cut + (is_small ? by_e1_2 : 0.0) + q_plus_p1_2 *
                    product_12;
                const double by_q_plus_p0_2_2 = product_4 * by_by_q0_off_cut + (is_small ? by_e0_2 : 0.0) + q_plus_p0_2 *
                    product_12;
                const double product_13 = 2.0 * by_norm_d_squared_2;
                const double by_d2_2 = product_5 * by_by_q2_off_cut + (is_small ? 0.0 : by_e2_2) + d2 * product_13;
                const double by_d1_2 = product_5 * by_by_q1_off_cut + (is_small ? 0.0 : by_e1_2) + d1 * product_13;
                const double by_d0_2 = product_5 * by_by_q0_off_cut + (is_small ? 0.0 : by_e0_2) + d0 * product_13;
                const double by_q2_off_cut_2 = by_q_plus_p2_2_2 + by_d2_2;
                const double by_q1_off_cut_2 = by_q_plus_p1_2_2 + by_d1_2;
                const double by_q0_off_cut_2 = by_q_plus_p0_2_2 + by_d0_2;
                const double total_6 = gap_4 + e2 * by_dot_p_e_2 + by_q_plus_p2_2_2 - by_d2_2 + (on_cut_locus ?
                    by_q2_off_cut_2 : 0.0);
                const double total_7 = gap_5 + e1 * by_dot_p_e_2 + by_q_plus_p1_2_2 - by_d1_2 + (on_cut_locus ?
                    by_q1_off_cut_2 : 0.0);
                const double total_8 = gap_6 + e0 * by_dot_p_e_2 + by_q_plus_p0_2_2 - by_d0_2 + (on_cut_locus ?
                    by_q0_off_cut_2 : 0.0);
                sum[0][lane] += total_8 - mu0 * (2.0 * (ratio_18 + chosen_10));
                sum[1][lane] += total_7 - mu1 * (2.0 * (ratio_15 + chosen_9));
                sum[2][lane] += total_6;
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

/* Of degree 8, within 2^-27 of that of double precision. */
static inline float polynomial_t_over_norm_w_near_slope_slope_f(float x) {
    return 0.06633574524735136f + x * (0.04253839921568694f + x * (0.018859953714945116f + x *
        (0.007116187388862165f + x * (0.0025081773727685867f + x * (0.0006707717309135404f + x *
        (0.00045739113274665544f + x * (-0.00010480883009425309f + x * 9.840812906558691e-05f)))))));
}

/* Of degree 8, within 2^-29 of that of double precision. */
static inline float polynomial_log_det_series_slope_slope_f(float x) {
    return 0.006229944316617849f + x * (0.0034201412475210677f + x * (0.0013438225275634516f + x *
        (0.0004596418976622537f + x * (0.00014814095627058545f + x * (3.883739899285821e-05f + x *
        (2.1669920296332757e-05f + x * (-3.885466858431985e-06f + x * 4.272324365863415e-06f)))))));
}

void sphere_splats_f(
    size_t count,
    size_t splat_count,
    const float *SPHERE_RESTRICT x,
    const float *SPHERE_RESTRICT mu,
    const float *SPHERE_RESTRICT W,
    const float *SPHERE_RESTRICT amplitude,
    float *SPHERE_RESTRICT value,
    float *SPHERE_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[3][LANES], sum[4][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 3; ++i) x_block[i][lane] = x[3 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const float mu0 = mu[3 * k + 0];
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
                const float q_plus_p0 = x_block[0][lane] + mu0;
                const float q_plus_p1 = x_block[1][lane] + mu1;
                const float q_plus_p2 = x_block[2][lane] + mu2;
                const float norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 * q_plus_p2;
                const float norm_q_plus_p = sqrtf(norm_q_plus_p_squared);
                const float squared = mu0 * mu0;
                const float gap = 1.0f - squared;
                const float gap_2 = 1.0f - mu1 * mu1;
                const int on_cut_locus = norm_q_plus_p <= 4.0f * FLT_EPSILON;
                const float q0_off_cut = (on_cut_locus ? mu0 : x_block[0][lane]);
                const float q1_off_cut = (on_cut_locus ? mu1 : x_block[1][lane]);
                const float q2_off_cut = (on_cut_locus ? mu2 : x_block[2][lane]);
                const float d0 = q0_off_cut - mu0;
                const float d1 = q1_off_cut - mu1;
                const float d2 = q2_off_cut - mu2;
                const float norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
                const float q_plus_p0_2 = mu0 + q0_off_cut;
                const float q_plus_p1_2 = mu1 + q1_off_cut;
                const float q_plus_p2_2 = mu2 + q2_off_cut;
                const float norm_q_plus_p_squared_2 = q_plus_p0_2 * q_plus_p0_2 + q_plus_p1_2 * q_plus_p1_2 + q_plus_p2_2
                    * q_plus_p2_2;
                const float norm_q_plus_p_2 = sqrtf(norm_q_plus_p_squared_2);
                const float dot_p_q = mu0 * q0_off_cut + mu1 * q1_off_cut + mu2 * q2_off_cut;
                const int is_small = dot_p_q < 0.0f;
                const float e0 = (is_small ? q_plus_p0_2 : d0);
                const float e1 = (is_small ? q_plus_p1_2 : d1);
                const float e2 = (is_small ? q_plus_p2_2 : d2);
                const float dot_p_e = mu0 * e0 + mu1 * e1 + mu2 * e2;
                const float w0 = e0 - mu0 * dot_p_e;
                const float w1 = e1 - mu1 * dot_p_e;
                const float w2 = e2 - mu2 * dot_p_e;
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
                const float product = mu0 * mu1;
                const float sine_to_axis1 = sqrtf((is_small_2 ? 1.0f : gap_2));
                const float v0 = (on_cut_locus ? 3.141592653589793f * (is_small_2 ? gap / sine_to_axis0 : -(product /
                    sine_to_axis1)) : w0 * t_over_norm_w);
                const float v1 = (on_cut_locus ? 3.141592653589793f * (is_small_2 ? -(product / sine_to_axis0) : gap_2 /
                    sine_to_axis1) : w1 * t_over_norm_w);
                const float product_2 = 3.141592653589793f * (is_small_2 ? -(mu0 * mu2 / sine_to_axis0) : -(mu1 * mu2 /
                    sine_to_axis1));
                const float v2 = (on_cut_locus ? product_2 : w2 * t_over_norm_w);
                const float log_value = logf(0.7853981633974483f / FLT_EPSILON);
                const float log_det_series = polynomial_log_det_series_f(near_chosen);
                const float log_det_near = norm_d_squared * log_det_series;
                const float log_det = (near ? log_det_near : logf(t_ratio));
                const float z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const float z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const float exp_2 = expf((on_cut_locus ? log_value : log_det) - 0.5f * (z0 * z0 + z1 * z1));
                const float phi = amplitude_k * exp_2;
                const float by_v2 = -(W1_2 * z1) - W0_2 * z0;
                const float by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const float by_v0 = -(W1_0 * z1) - W0_0 * z0;
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
                const float by_dot_p_e = -(mu2 * by_w2) - mu1 * by_w1 - mu0 * by_w0;
                const float by_e2 = by_w2 + mu2 * by_dot_p_e;
                const float by_e1 = by_w1 + mu1 * by_dot_p_e;
                const float by_e0 = by_w0 + mu0 * by_dot_p_e;
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
                const float normal_part = x_block[0][lane] * df0 + x_block[1][lane] * df1 + x_block[2][lane] * df2;
                const float gradient0 = df0 - x_block[0][lane] * normal_part;
                const float gradient1 = df1 - x_block[1][lane] * normal_part;
                const float gradient2 = df2 - x_block[2][lane] * normal_part;
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

void sphere_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *SPHERE_RESTRICT x,
    const float *SPHERE_RESTRICT mu,
    const float *SPHERE_RESTRICT W,
    const float *SPHERE_RESTRICT amplitude,
    const float *SPHERE_RESTRICT value_bar,
    const float *SPHERE_RESTRICT gradient_bar,
    float *SPHERE_RESTRICT mu_bar,
    float *SPHERE_RESTRICT W_bar,
    float *SPHERE_RESTRICT amplitude_bar) {
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
            const float mu0 = mu[3 * k + 0];
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
                const float q_plus_p0 = x_block[0][lane] + mu0;
                const float q_plus_p1 = x_block[1][lane] + mu1;
                const float q_plus_p2 = x_block[2][lane] + mu2;
                const float norm_q_plus_p_squared = q_plus_p0 * q_plus_p0 + q_plus_p1 * q_plus_p1 + q_plus_p2 * q_plus_p2;
                const float norm_q_plus_p = sqrtf(norm_q_plus_p_squared);
                const float squared = mu0 * mu0;
                const float gap = 1.0f - squared;
                const float gap_2 = 1.0f - mu1 * mu1;
                const int on_cut_locus = norm_q_plus_p <= 4.0f * FLT_EPSILON;
                const float q0_off_cut = (on_cut_locus ? mu0 : x_block[0][lane]);
                const float q1_off_cut = (on_cut_locus ? mu1 : x_block[1][lane]);
                const float q2_off_cut = (on_cut_locus ? mu2 : x_block[2][lane]);
                const float d0 = q0_off_cut - mu0;
                const float d1 = q1_off_cut - mu1;
                const float d2 = q2_off_cut - mu2;
                const float norm_d_squared = d0 * d0 + d1 * d1 + d2 * d2;
                const float q_plus_p0_2 = mu0 + q0_off_cut;
                const float q_plus_p1_2 = mu1 + q1_off_cut;
                const float q_plus_p2_2 = mu2 + q2_off_cut;
                const float norm_q_plus_p_squared_2 = q_plus_p0_2 * q_plus_p0_2 + q_plus_p1_2 * q_plus_p1_2 + q_plus_p2_2
                    * q_plus_p2_2;
                const float norm_q_plus_p_2 = sqrtf(norm_q_plus_p_squared_2);
                const float dot_p_q = mu0 * q0_off_cut + mu1 * q1_off_cut + mu2 * q2_off_cut;
                const int is_small = dot_p_q < 0.0f;
                const float e0 = (is_small ? q_plus_p0_2 : d0);
                const float e1 = (is_small ? q_plus_p1_2 : d1);
                const float e2 = (is_small ? q_plus_p2_2 : d2);
                const float dot_p_e = mu0 * e0 + mu1 * e1 + mu2 * e2;
                const float w0 = e0 - mu0 * dot_p_e;
                const float w1 = e1 - mu1 * dot_p_e;
                const float w2 = e2 - mu2 * dot_p_e;
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
                const float chosen = (is_small_2 ? gap : 1.0f);
                const float sine_to_axis0 = sqrtf(chosen);
                const float ratio = gap / sine_to_axis0;
                const float product = mu0 * mu1;
                const float chosen_2 = (is_small_2 ? 1.0f : gap_2);
                const float sine_to_axis1 = sqrtf(chosen_2);
                const float ratio_2 = product / sine_to_axis1;
                const float v0 = (on_cut_locus ? 3.141592653589793f * (is_small_2 ? ratio : -ratio_2) : w0 *
                    t_over_norm_w);
                const float ratio_3 = product / sine_to_axis0;
                const float ratio_4 = gap_2 / sine_to_axis1;
                const float v1 = (on_cut_locus ? 3.141592653589793f * (is_small_2 ? -ratio_3 : ratio_4) : w1 *
                    t_over_norm_w);
                const float ratio_5 = mu0 * mu2 / sine_to_axis0;
                const float ratio_6 = mu1 * mu2 / sine_to_axis1;
                const float v2 = (on_cut_locus ? 3.141592653589793f * (is_small_2 ? -ratio_5 : -ratio_6) : w2 *
                    t_over_norm_w);
                const float log_value = logf(0.7853981633974483f / FLT_EPSILON);
                const float log_det_series = polynomial_log_det_series_f(near_chosen);
                const float log_det_near = norm_d_squared * log_det_series;
                const float log_det = (near ? log_det_near : logf(t_ratio));
                const float z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const float z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const float exp_2 = expf((on_cut_locus ? log_value : log_det) - 0.5f * (z0 * z0 + z1 * z1));
                const float phi = amplitude_k * exp_2;
                const float by_v2 = -(W1_2 * z1) - W0_2 * z0;
                const float by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const float by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const float by_log_det = (on_cut_locus ? 0.0f : 1.0f);
                const float by_log_det_near = (near ? by_log_det : 0.0f);
                const float ratio_7 = (near ? 0.0f : by_log_det) / t_ratio;
                const float by_log_det_series = norm_d_squared * by_log_det_near;
                const float log_det_series_slope = polynomial_log_det_series_slope_f(near_chosen);
                const float chosen_3 = (on_cut_locus ? 0.0f : by_v2);
                const float chosen_4 = (on_cut_locus ? 0.0f : by_v1);
                const float chosen_5 = (on_cut_locus ? 0.0f : by_v0);
                const float by_t_over_norm_w = w2 * chosen_3 + w1 * chosen_4 + w0 * chosen_5;
                const float by_t_over_norm_w_near = (near ? by_t_over_norm_w : 0.0f);
                const float by_t = (ratio_7 + (near ? 0.0f : by_t_over_norm_w)) / norm_w;
                const float norm_w_product = 2.0f * norm_w;
                const float ratio_8 = t_ratio * by_t / norm_w_product;
                const float by_norm_w_squared = (near ? 0.0f : -ratio_8);
                const float by_atan2_value = 2.0f * by_t;
                const float total_2 = norm_q_plus_p_squared_2 + near_chosen_2;
                const float ratio_9 = by_atan2_value / total_2;
                const float by_norm_d = norm_q_plus_p_2 * ratio_9;
                const float norm_d_product = 2.0f * norm_d;
                const float by_norm_d_ratio = by_norm_d / norm_d_product;
                const float t_over_norm_w_near_slope = polynomial_t_over_norm_w_near_slope_f(near_chosen);
                const float by_norm_d_squared = log_det_series * by_log_det_near + (near ? 0.0f : by_norm_d_ratio) +
                    1.0024911906086624f * (near ? by_log_det_series * log_det_series_slope + by_t_over_norm_w_near *
                    t_over_norm_w_near_slope : 0.0f);
                const float product_2 = 2.0f * by_norm_w_squared;
                const float by_w2 = t_over_norm_w * chosen_3 + w2 * product_2;
                const float by_w1 = t_over_norm_w * chosen_4 + w1 * product_2;
                const float by_w0 = t_over_norm_w * chosen_5 + w0 * product_2;
                const float by_dot_p_e = -(mu2 * by_w2) - mu1 * by_w1 - mu0 * by_w0;
                const float by_e2 = by_w2 + mu2 * by_dot_p_e;
                const float by_e1 = by_w1 + mu1 * by_dot_p_e;
                const float by_e0 = by_w0 + mu0 * by_dot_p_e;
                const int is_small_3 = norm_q_plus_p_squared_2 == 0.0f;
                const float product_3 = 2.0f * (is_small_3 ? 1.0f : norm_q_plus_p_2);
                const float ratio_10 = norm_d * ratio_9 / product_3;
                const float by_norm_q_plus_p_squared_2 = (is_small_3 ? 0.0f : -ratio_10);
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
                const float by_normal_part = -(x_block[2][lane] * gradient_bar_block[2][lane]) - x_block[1][lane] *
                    gradient_bar_block[1][lane] - x_block[0][lane] * gradient_bar_block[0][lane];
                const float by_df2 = gradient_bar_block[2][lane] + x_block[2][lane] * by_normal_part;
                const float by_df1 = gradient_bar_block[1][lane] + x_block[1][lane] * by_normal_part;
                const float by_df0 = gradient_bar_block[0][lane] + x_block[0][lane] * by_normal_part;
                const float by_exponent_by_x2 = phi * by_df2;
                const float by_exponent_by_x1 = phi * by_df1;
                const float by_exponent_by_x0 = phi * by_df0;
                const float by_phi = value_bar_block[0][lane] + exponent_by_x2 * by_df2 + exponent_by_x1 * by_df1 +
                    exponent_by_x0 * by_df0;
                const float by_by_q0_off_cut = (on_cut_locus ? 0.0f : by_exponent_by_x0);
                const float by_by_q1_off_cut = (on_cut_locus ? 0.0f : by_exponent_by_x1);
                const float by_by_q2_off_cut = (on_cut_locus ? 0.0f : by_exponent_by_x2);
                const float total_3 = d0 * by_by_q0_off_cut + d1 * by_by_q1_off_cut + d2 * by_by_q2_off_cut;
                const float by_by_norm_d_squared = 2.0f * total_3;
                const float by_by_norm_q_plus_p_squared_2 = 2.0f * (q_plus_p0_2 * by_by_q0_off_cut + q_plus_p1_2 *
                    by_by_q1_off_cut + q_plus_p2_2 * by_by_q2_off_cut);
                const float ratio_11 = (is_small_3 ? 0.0f : by_by_norm_q_plus_p_squared_2) / product_3;
                const float by_by_e0 = (is_small ? by_by_q0_off_cut : 0.0f) + (is_small ? 0.0f : by_by_q0_off_cut);
                const float by_by_e1 = (is_small ? by_by_q1_off_cut : 0.0f) + (is_small ? 0.0f : by_by_q1_off_cut);
                const float by_by_e2 = (is_small ? by_by_q2_off_cut : 0.0f) + (is_small ? 0.0f : by_by_q2_off_cut);
                const float by_by_dot_p_e = mu0 * by_by_e0 + mu1 * by_by_e1 + mu2 * by_by_e2;
                const float by_by_w0 = by_by_e0 - mu0 * by_by_dot_p_e;
                const float by_by_w1 = by_by_e1 - mu1 * by_by_dot_p_e;
                const float by_by_w2 = by_by_e2 - mu2 * by_by_dot_p_e;
                const float by_by_norm_w_squared = 2.0f * (w0 * by_by_w0 + w1 * by_by_w1 + w2 * by_by_w2);
                const float near_chosen_3 = (near ? 2.004982381217325f * total_3 : 0.0f);
                const float by_by_t_over_norm_w_near = t_over_norm_w_near_slope * near_chosen_3;
                const float by_t_over_norm_w_near_slope = by_t_over_norm_w_near * near_chosen_3;
                const float t_over_norm_w_near_slope_slope = polynomial_t_over_norm_w_near_slope_slope_f(near_chosen);
                const float by_by_norm_d = (near ? 0.0f : by_by_norm_d_squared) / norm_d_product;
                const float by_by_atan2_value = (norm_q_plus_p_2 * by_by_norm_d - norm_d * ratio_11) / total_2;
                const float product_6 = ratio_9 * by_by_atan2_value;
                const float ratio_12 = (near ? 0.0f : by_by_norm_w_squared) / norm_w_product;
                const float by_by_t = 2.0f * by_by_atan2_value - t_ratio * ratio_12;
                const float by_by_t_ratio = by_by_t / norm_w;
                const float by_by_t_over_norm_w = (near ? 0.0f : by_by_t_ratio) + (near ? by_by_t_over_norm_w_near :
                    0.0f);
                const float by_by_v0 = (on_cut_locus ? 0.0f : w0 * by_by_t_over_norm_w + t_over_norm_w * by_by_w0);
                const float by_by_v1 = (on_cut_locus ? 0.0f : w1 * by_by_t_over_norm_w + t_over_norm_w * by_by_w1);
                const float by_by_v2 = (on_cut_locus ? 0.0f : w2 * by_by_t_over_norm_w + t_over_norm_w * by_by_w2);
                const float by_by_log_det_series = log_det_series_slope * near_chosen_3;
                const float by_log_det_series_slope = by_log_det_series * near_chosen_3;
                const float log_det_series_slope_slope = polynomial_log_det_series_slope_slope_f(near_chosen);
                const float product_7 = exp_2 * (amplitude_k * by_phi);
                const float by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - z1 * product_7;
                const float by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - z0 * product_7;
                const float by_v2_2 = W1_2 * by_z1 + W0_2 * by_z0;
                const float by_v1_2 = W1_1 * by_z1 + W0_1 * by_z0;
                const float by_v0_2 = W1_0 * by_z1 + W0_0 * by_z0;
                const float by_log_det_2 = (on_cut_locus ? 0.0f : product_7);
                const float by_log_det_near_2 = (near ? by_log_det_2 : 0.0f);
                const float by_log_det_series_2 = by_log_det_near * by_by_norm_d_squared + norm_d_squared *
                    by_log_det_near_2;
                const float chosen_6 = (on_cut_locus ? 0.0f : by_v2_2);
                const float product_8 = 3.141592653589793f * (on_cut_locus ? by_v2_2 : 0.0f);
                const float ratio_13 = (is_small_2 ? 0.0f : product_8) / sine_to_axis1;
                const float ratio_14 = (is_small_2 ? product_8 : 0.0f) / sine_to_axis0;
                const float chosen_7 = (on_cut_locus ? 0.0f : by_v1_2);
                const float total_4 = chosen_5 * by_by_w0 + chosen_4 * by_by_w1 + chosen_3 * by_by_w2 + w2 * chosen_6 + w1
                    * chosen_7;
                const float product_9 = 3.141592653589793f * (on_cut_locus ? by_v1_2 : 0.0f);
                const float ratio_15 = (is_small_2 ? 0.0f : product_9) / sine_to_axis1;
                const float ratio_16 = (is_small_2 ? product_9 : 0.0f) / sine_to_axis0;
                const float chosen_8 = (on_cut_locus ? 0.0f : by_v0_2);
                const float by_t_over_norm_w_2 = total_4 + w0 * chosen_8;
                const float product_10 = 3.141592653589793f * (on_cut_locus ? by_v0_2 : 0.0f);
                const float ratio_17 = (is_small_2 ? 0.0f : product_10) / sine_to_axis1;
                const float gap_3 = -ratio_16 - ratio_17;
                const float by_sine_to_axis1 = ratio_6 * ratio_13 - ratio_4 * ratio_15 + ratio_2 * ratio_17;
                const int is_small_4 = chosen_2 == 0.0f;
                const float chosen_9 = (is_small_2 ? 0.0f : (is_small_4 ? 0.0f : by_sine_to_axis1 / (2.0f * (is_small_4 ?
                    1.0f : sine_to_axis1))));
                const float ratio_18 = (is_small_2 ? product_10 : 0.0f) / sine_to_axis0;
                const float by_sine_to_axis0 = ratio_5 * ratio_14 + ratio_3 * ratio_16 - ratio * ratio_18;
                const int is_small_5 = chosen == 0.0f;
                const float chosen_10 = (is_small_2 ? (is_small_5 ? 0.0f : by_sine_to_axis0 / (2.0f * (is_small_5 ? 1.0f :
                    sine_to_axis0))) : 0.0f);
                const float by_t_over_norm_w_near_2 = (near ? by_t_over_norm_w_2 : 0.0f);
                const float total_5 = -(by_t * ratio_12) - ratio_7 * (by_by_t_ratio / t_ratio) + (near ? 0.0f :
                    by_log_det_2) / t_ratio + (near ? 0.0f : by_t_over_norm_w_2);
                const float by_t_2 = total_5 / norm_w;
                const float by_norm_w = 2.0f * (ratio_8 * ratio_12) - by_t * by_by_t_ratio - t_ratio * by_t_2;
                const float by_norm_w_squared_2 = (near ? 0.0f : by_norm_w / norm_w_product);
                const float by_atan2_value_2 = 2.0f * by_t_2;
                const float ratio_19 = by_atan2_value_2 / total_2;
                const float by_norm_d_2 = -(2.0f * (by_norm_d_ratio * by_by_norm_d)) - ratio_9 * ratio_11 +
                    norm_q_plus_p_2 * ratio_19;
                const float by_norm_q_plus_p_2 = (is_small_3 ? 0.0f : 2.0f * (ratio_10 * ratio_11)) + ratio_9 *
                    by_by_norm_d - norm_d * ratio_19;
                const float near_chosen_4 = (near ? by_t_over_norm_w_near_slope * t_over_norm_w_near_slope_slope +
                    by_log_det_series_slope * log_det_series_slope_slope + log_det_series_slope * by_log_det_series_2 +
                    t_over_norm_w_near_slope * by_t_over_norm_w_near_2 : 0.0f);
                const float by_norm_d_squared_2 = by_log_det_near * by_by_log_det_series + log_det_series *
                    by_log_det_near_2 + (near ? 0.0f : by_norm_d_2 / norm_d_product - product_6) + 1.0024911906086624f *
                    near_chosen_4;
                const float product_11 = 2.0f * by_norm_w_squared_2;
                const float by_w2_2 = product_2 * by_by_w2 + chosen_3 * by_by_t_over_norm_w + t_over_norm_w * chosen_6 +
                    w2 * product_11;
                const float by_w1_2 = product_2 * by_by_w1 + chosen_4 * by_by_t_over_norm_w + t_over_norm_w * chosen_7 +
                    w1 * product_11;
                const float by_w0_2 = product_2 * by_by_w0 + chosen_5 * by_by_t_over_norm_w + t_over_norm_w * chosen_8 +
                    w0 * product_11;
                const float gap_4 = by_dot_p_e * by_by_e2 - by_w2 * by_by_dot_p_e - mu1 * ratio_13 - mu0 * ratio_14 -
                    dot_p_e * by_w2_2;
                const float gap_5 = by_dot_p_e * by_by_e1 - by_w1 * by_by_dot_p_e - mu2 * ratio_13 + mu0 * gap_3 - dot_p_e
                    * by_w1_2;
                const float gap_6 = by_dot_p_e * by_by_e0 - by_w0 * by_by_dot_p_e - mu2 * ratio_14 + mu1 * gap_3 - dot_p_e
                    * by_w0_2;
                const float by_dot_p_e_2 = -(mu2 * by_w2_2) - mu1 * by_w1_2 - mu0 * by_w0_2;
                const float by_e2_2 = by_w2_2 + mu2 * by_dot_p_e_2;
                const float by_e1_2 = by_w1_2 + mu1 * by_dot_p_e_2;
                const float by_e0_2 = by_w0_2 + mu0 * by_dot_p_e_2;
                const float by_norm_q_plus_p_squared_2_2 = (is_small_3 ? 0.0f : by_norm_q_plus_p_2 / product_3) -
                    product_6;
                const float product_12 = 2.0f * by_norm_q_plus_p_squared_2_2;
                const float by_q_plus_p2_2_2 = product_4 * by_by_q2_off_cut + (is_small ? by_e2_2 : 0.0f) + q_plus_p2_2 *
                    product_12;
                const float by_q_plus_p1_2_2 = product_4 * by_by_q1_off_cut + (is_small ? by_e1_2 : 0.0f) + q_plus_p1_2 *
                    product_12;
                const float by_q_plus_p0_2_2 = product_4 * by_by_q0_off_cut + (is_small ? by_e0_2 : 0.0f) + q_plus_p0_2 *
                    product_12;
                const float product_13 = 2.0f * by_norm_d_squared_2;
                const float by_d2_2 = product_5 * by_by_q2_off_cut + (is_small ? 0.0f : by_e2_2) + d2 * product_13;
                const float by_d1_2 = product_5 * by_by_q1_off_cut + (is_small ? 0.0f : by_e1_2) + d1 * product_13;
                const float by_d0_2 = product_5 * by_by_q0_off_cut + (is_small ? 0.0f : by_e0_2) + d0 * product_13;
                const float by_q2_off_cut_2 = by_q_plus_p2_2_2 + by_d2_2;
                const float by_q1_off_cut_2 = by_q_plus_p1_2_2 + by_d1_2;
                const float by_q0_off_cut_2 = by_q_plus_p0_2_2 + by_d0_2;
                const float total_6 = gap_4 + e2 * by_dot_p_e_2 + by_q_plus_p2_2_2 - by_d2_2 + (on_cut_locus ?
                    by_q2_off_cut_2 : 0.0f);
                const float total_7 = gap_5 + e1 * by_dot_p_e_2 + by_q_plus_p1_2_2 - by_d1_2 + (on_cut_locus ?
                    by_q1_off_cut_2 : 0.0f);
                const float total_8 = gap_6 + e0 * by_dot_p_e_2 + by_q_plus_p0_2_2 - by_d0_2 + (on_cut_locus ?
                    by_q0_off_cut_2 : 0.0f);
                sum[0][lane] += total_8 - mu0 * (2.0f * (ratio_18 + chosen_10));
                sum[1][lane] += total_7 - mu1 * (2.0f * (ratio_15 + chosen_9));
                sum[2][lane] += total_6;
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
