/*
 * so3: Rotations of R^3 as unit quaternions (w, x, y, z), q and -q the same; distances are rotation angles in
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "so3.h"

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

/* Of degree 11 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_t_over_norm_s_near_slope_slope(double x) {
    return 0.018643202510559807 + x * (0.008299121481917445 + x * (0.0028159522967385387 + x *
        (0.0008615244488774448 + x * (0.00024984954588029915 + x * (7.028363271022215e-05 + x *
        (1.89798401694423e-05 + x * (5.875783766625421e-06 + x * (5.003643981595386e-07 + x *
        (1.1877220896552042e-06 + x * (-3.538311894046709e-07 + x * 1.5233524430341798e-07))))))))));
}

/* Of degree 11 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_log_det_series_slope_slope(double x) {
    return 0.00837354892300497 + x * (0.004093413599169786 + x * (0.0014659406672238098 + x *
        (0.00046452444853173575 + x * (0.00013808038982049257 + x * (3.956376600918562e-05 + x *
        (1.0825177352974468e-05 + x * (3.4072951566509835e-06 + x * (2.7515096116612774e-07 + x *
        (7.082806450744882e-07 + x * (-2.1336272104298557e-07 + x * 9.122574198606865e-08))))))))));
}

void so3_splats(
    size_t count,
    size_t splat_count,
    const double *SO3_RESTRICT x,
    const double *SO3_RESTRICT mu,
    const double *SO3_RESTRICT W,
    const double *SO3_RESTRICT amplitude,
    double *SO3_RESTRICT value,
    double *SO3_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[4][LANES], sum[4][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 4; ++i) x_block[i][lane] = x[4 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const double mu0 = mu[4 * k + 0];
            const double mu1 = mu[4 * k + 1];
            const double mu2 = mu[4 * k + 2];
            const double mu3 = mu[4 * k + 3];
            const double W0_0 = W[9 * k + 0];
            const double W0_1 = W[9 * k + 1];
            const double W0_2 = W[9 * k + 2];
            const double W1_0 = W[9 * k + 3];
            const double W1_1 = W[9 * k + 4];
            const double W1_2 = W[9 * k + 5];
            const double W2_0 = W[9 * k + 6];
            const double W2_1 = W[9 * k + 7];
            const double W2_2 = W[9 * k + 8];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double g0 = x_block[0][lane] * mu0 + x_block[1][lane] * mu1 + x_block[2][lane] * mu2 +
                    x_block[3][lane] * mu3;
                const double g1 = x_block[1][lane] * mu0 + x_block[2][lane] * mu3 - x_block[0][lane] * mu1 -
                    x_block[3][lane] * mu2;
                const double g2 = x_block[2][lane] * mu0 + x_block[3][lane] * mu1 - x_block[0][lane] * mu2 -
                    x_block[1][lane] * mu3;
                const double g3 = x_block[3][lane] * mu0 + x_block[1][lane] * mu2 - x_block[2][lane] * mu1 -
                    x_block[0][lane] * mu3;
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
                const double z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const double z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const double z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
                const double log_det_gap = log_det - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
                const double phi = amplitude_k * exp(log_det_gap);
                const double by_v2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0;
                const double by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                const double by_v0 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0;
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
                const double exponent_by_x3 = mu0 * by_g3 + mu1 * by_g2 - mu2 * by_g1 + mu3 * by_g0;
                const double exponent_by_x2 = mu0 * by_g2 - mu1 * by_g3 + mu3 * by_g1 + mu2 * by_g0;
                const double exponent_by_x1 = mu2 * by_g3 - mu3 * by_g2 + mu0 * by_g1 + mu1 * by_g0;
                const double exponent_by_x0 = -(mu3 * by_g3) - mu2 * by_g2 - mu1 * by_g1 + mu0 * by_g0;
                const double df0 = phi * exponent_by_x0;
                const double df1 = phi * exponent_by_x1;
                const double df2 = phi * exponent_by_x2;
                const double df3 = phi * exponent_by_x3;
                const double df1_product = 0.5 * df1;
                const double df2_product = 0.5 * df2;
                const double df0_product = 0.5 * df0;
                const double df3_product = 0.5 * df3;
                const double gradient0 = x_block[0][lane] * df1_product + x_block[3][lane] * df2_product -
                    x_block[1][lane] * df0_product - x_block[2][lane] * df3_product;
                const double gradient1 = x_block[0][lane] * df2_product + x_block[1][lane] * df3_product -
                    x_block[2][lane] * df0_product - x_block[3][lane] * df1_product;
                const double gradient2 = x_block[2][lane] * df1_product + x_block[0][lane] * df3_product -
                    x_block[3][lane] * df0_product - x_block[1][lane] * df2_product;
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

void so3_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *SO3_RESTRICT x,
    const double *SO3_RESTRICT mu,
    const double *SO3_RESTRICT W,
    const double *SO3_RESTRICT amplitude,
    const double *SO3_RESTRICT value_bar,
    const double *SO3_RESTRICT gradient_bar,
    double *SO3_RESTRICT mu_bar,
    double *SO3_RESTRICT W_bar,
    double *SO3_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 4 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 9 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[4][LANES], value_bar_block[1][LANES], gradient_bar_block[3][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const double weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 4; ++i) x_block[i][lane] = x[4 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] = gradient_bar[3 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            double sum[14][LANES] = {{0}}, total[14] = {0};
            const double mu0 = mu[4 * k + 0];
            const double mu1 = mu[4 * k + 1];
            const double mu2 = mu[4 * k + 2];
            const double mu3 = mu[4 * k + 3];
            const double W0_0 = W[9 * k + 0];
            const double W0_1 = W[9 * k + 1];
            const double W0_2 = W[9 * k + 2];
            const double W1_0 = W[9 * k + 3];
            const double W1_1 = W[9 * k + 4];
            const double W1_2 = W[9 * k + 5];
            const double W2_0 = W[9 * k + 6];
            const double W2_1 = W[9 * k + 7];
            const double W2_2 = W[9 * k + 8];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double g0 = x_block[0][lane] * mu0 + x_block[1][lane] * mu1 + x_block[2][lane] * mu2 +
                    x_block[3][lane] * mu3;
                const double g1 = x_block[1][lane] * mu0 + x_block[2][lane] * mu3 - x_block[0][lane] * mu1 -
                    x_block[3][lane] * mu2;
                const double g2 = x_block[2][lane] * mu0 + x_block[3][lane] * mu1 - x_block[0][lane] * mu2 -
                    x_block[1][lane] * mu3;
                const double g3 = x_block[3][lane] * mu0 + x_block[1][lane] * mu2 - x_block[2][lane] * mu1 -
                    x_block[0][lane] * mu3;
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
                const double z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const double z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const double z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
                const double log_det_gap = log_det - 0.5 * (z0 * z0 + z1 * z1 + z2 * z2);
                const double exp_2 = exp(log_det_gap);
                const double phi = amplitude_k * exp_2;
                const double by_v2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0;
                const double by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                const double by_v0 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0;
                const double by_log_det_near = (near ? 1.0 : 0.0);
                const double ratio = 2.0 * (near ? 0.0 : 1.0) / product;
                const double by_log_det_series = norm_s_squared * by_log_det_near;
                const double log_det_series_slope = polynomial_log_det_series_slope(near_chosen);
                const double by_scale = g3 * by_v2 + g2 * by_v1 + g1 * by_v0;
                const double by_t_over_norm_s = chosen * by_scale;
                const double by_t_over_norm_s_near = (near ? by_t_over_norm_s : 0.0);
                const double by_t = (0.5 * ratio + (near ? 0.0 : by_t_over_norm_s)) / norm_s;
                const double by_atan2_norm_s_abs_g0 = 2.0 * by_t;
                const double total_2 = near_chosen_2 + abs_g0 * abs_g0;
                const double ratio_2 = by_atan2_norm_s_abs_g0 / total_2;
                const double norm_s_product = norm_s * ratio_2;
                const double by_abs_g0 = -norm_s_product;
                const double by_norm_s = abs_g0 * ratio_2 - t_ratio * by_t;
                const double norm_s_product_2 = 2.0 * norm_s;
                const double by_norm_s_ratio = by_norm_s / norm_s_product_2;
                const double t_over_norm_s_near_slope = polynomial_t_over_norm_s_near_slope(near_chosen);
                const double by_norm_s_squared = log_det_series * by_log_det_near + (near ? 0.0 : by_norm_s_ratio) +
                    4.011440628672975 * (near ? by_log_det_series * log_det_series_slope + by_t_over_norm_s_near *
                    t_over_norm_s_near_slope : 0.0);
                const double by_g0 = (is_small ? norm_s_product : by_abs_g0);
                const double product_2 = 2.0 * by_norm_s_squared;
                const double by_g3 = scale * by_v2 + g3 * product_2;
                const double by_g2 = scale * by_v1 + g2 * product_2;
                const double by_g1 = scale * by_v0 + g1 * product_2;
                const double exponent_by_x3 = mu0 * by_g3 + mu1 * by_g2 - mu2 * by_g1 + mu3 * by_g0;
                const double exponent_by_x2 = mu0 * by_g2 - mu1 * by_g3 + mu3 * by_g1 + mu2 * by_g0;
                const double exponent_by_x1 = mu2 * by_g3 - mu3 * by_g2 + mu0 * by_g1 + mu1 * by_g0;
                const double exponent_by_x0 = -(mu3 * by_g3) - mu2 * by_g2 - mu1 * by_g1 + mu0 * by_g0;
                const double by_df3 = 0.5 * (x_block[0][lane] * gradient_bar_block[2][lane] + x_block[1][lane] *
                    gradient_bar_block[1][lane] - x_block[2][lane] * gradient_bar_block[0][lane]);
                const double by_df0 = 0.5 * (-(x_block[3][lane] * gradient_bar_block[2][lane]) - x_block[2][lane] *
                    gradient_bar_block[1][lane] - x_block[1][lane] * gradient_bar_block[0][lane]);
                const double by_df2 = 0.5 * (x_block[0][lane] * gradient_bar_block[1][lane] - x_block[1][lane] *
                    gradient_bar_block[2][lane] + x_block[3][lane] * gradient_bar_block[0][lane]);
                const double by_df1 = 0.5 * (x_block[2][lane] * gradient_bar_block[2][lane] - x_block[3][lane] *
                    gradient_bar_block[1][lane] + x_block[0][lane] * gradient_bar_block[0][lane]);
                const double by_exponent_by_x3 = phi * by_df3;
                const double by_exponent_by_x2 = phi * by_df2;
                const double by_exponent_by_x1 = phi * by_df1;
                const double by_exponent_by_x0 = phi * by_df0;
                const double by_phi = value_bar_block[0][lane] + exponent_by_x3 * by_df3 + exponent_by_x2 * by_df2 +
                    exponent_by_x1 * by_df1 + exponent_by_x0 * by_df0;
                const double by_by_g0 = mu0 * by_exponent_by_x0 + mu1 * by_exponent_by_x1 + mu2 * by_exponent_by_x2 + mu3
                    * by_exponent_by_x3;
                const double by_by_g1 = mu0 * by_exponent_by_x1 + mu3 * by_exponent_by_x2 - mu1 * by_exponent_by_x0 - mu2
                    * by_exponent_by_x3;
                const double by_by_g2 = mu0 * by_exponent_by_x2 + mu1 * by_exponent_by_x3 - mu2 * by_exponent_by_x0 - mu3
                    * by_exponent_by_x1;
                const double by_by_g3 = mu0 * by_exponent_by_x3 + mu2 * by_exponent_by_x1 - mu1 * by_exponent_by_x2 - mu3
                    * by_exponent_by_x0;
                const double total_3 = g1 * by_by_g1 + g2 * by_by_g2 + g3 * by_by_g3;
                const double by_by_norm_s_squared = 2.0 * total_3;
                const double by_by_abs_g0 = (is_small ? 0.0 : by_by_g0);
                const double near_chosen_3 = (near ? 8.02288125734595 * total_3 : 0.0);
                const double by_by_t_over_norm_s_near = t_over_norm_s_near_slope * near_chosen_3;
                const double by_t_over_norm_s_near_slope = by_t_over_norm_s_near * near_chosen_3;
                const double t_over_norm_s_near_slope_slope = polynomial_t_over_norm_s_near_slope_slope(near_chosen);
                const double by_by_norm_s = (near ? 0.0 : by_by_norm_s_squared) / norm_s_product_2;
                const double gap = (is_small ? by_by_g0 : 0.0) - by_by_abs_g0;
                const double by_by_atan2_norm_s_abs_g0 = (norm_s * gap + abs_g0 * by_by_norm_s) / total_2;
                const double product_3 = ratio_2 * by_by_atan2_norm_s_abs_g0;
                const double gap_2 = ratio_2 * by_by_norm_s - abs_g0 * (2.0 * product_3);
                const double by_by_t = 2.0 * by_by_atan2_norm_s_abs_g0 - t_ratio * by_by_norm_s;
                const double by_by_t_ratio = by_by_t / norm_s;
                const double by_by_t_over_norm_s = (near ? 0.0 : by_by_t_ratio) + (near ? by_by_t_over_norm_s_near : 0.0);
                const double by_by_scale = chosen * by_by_t_over_norm_s;
                const double by_by_v0 = g1 * by_by_scale + scale * by_by_g1;
                const double by_by_v1 = g2 * by_by_scale + scale * by_by_g2;
                const double by_by_v2 = g3 * by_by_scale + scale * by_by_g3;
                const double by_by_log_det_series = log_det_series_slope * near_chosen_3;
                const double by_log_det_series_slope = by_log_det_series * near_chosen_3;
                const double log_det_series_slope_slope = polynomial_log_det_series_slope_slope(near_chosen);
                const double by_log_det = exp_2 * (amplitude_k * by_phi);
                const double by_z2 = -(W2_0 * by_by_v0) - W2_1 * by_by_v1 - W2_2 * by_by_v2 - z2 * by_log_det;
                const double by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - z1 * by_log_det;
                const double by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - z0 * by_log_det;
                const double by_v2_2 = W2_2 * by_z2 + W1_2 * by_z1 + W0_2 * by_z0;
                const double by_v1_2 = W2_1 * by_z2 + W1_1 * by_z1 + W0_1 * by_z0;
                const double by_v0_2 = W2_0 * by_z2 + W1_0 * by_z1 + W0_0 * by_z0;
                const double by_log_det_near_2 = (near ? by_log_det : 0.0);
                const double product_4 = 0.5 * (2.0 * (near ? 0.0 : by_log_det) / product - ratio * (0.5 * by_by_t_ratio /
                    product));
                const double by_log_det_series_2 = by_log_det_near * by_by_norm_s_squared + norm_s_squared *
                    by_log_det_near_2;
                const double total_4 = by_v0 * by_by_g1 + by_v1 * by_by_g2 + by_v2 * by_by_g3 + g3 * by_v2_2 + g2 *
                    by_v1_2;
                const double by_scale_2 = total_4 + g1 * by_v0_2;
                const double by_t_over_norm_s_2 = chosen * by_scale_2;
                const double by_t_over_norm_s_near_2 = (near ? by_t_over_norm_s_2 : 0.0);
                const double by_t_2 = (product_4 - by_t * by_by_norm_s + (near ? 0.0 : by_t_over_norm_s_2)) / norm_s;
                const double gap_3 = ratio_2 * gap - 2.0 * (by_norm_s_ratio * by_by_norm_s) - by_t * by_by_t_ratio -
                    t_ratio * by_t_2;
                const double by_atan2_norm_s_abs_g0_2 = 2.0 * by_t_2;
                const double ratio_3 = by_atan2_norm_s_abs_g0_2 / total_2;
                const double norm_s_product_3 = norm_s * ratio_3;
                const double by_norm_s_2 = gap_3 + abs_g0 * ratio_3;
                const double by_abs_g0_2 = gap_2 - norm_s_product_3;
                const double near_chosen_4 = (near ? by_t_over_norm_s_near_slope * t_over_norm_s_near_slope_slope +
                    by_log_det_series_slope * log_det_series_slope_slope + log_det_series_slope * by_log_det_series_2 +
                    t_over_norm_s_near_slope * by_t_over_norm_s_near_2 : 0.0);
                const double by_norm_s_squared_2 = by_log_det_near * by_by_log_det_series + log_det_series *
                    by_log_det_near_2 + (near ? 0.0 : by_norm_s_2 / norm_s_product_2 - product_3) + 4.011440628672975 *
                    near_chosen_4;
                const double by_g0_2 = (is_small ? norm_s_product_3 - gap_2 : by_abs_g0_2);
                const double product_5 = 2.0 * by_norm_s_squared_2;
                const double by_g3_2 = product_2 * by_by_g3 + by_v2 * by_by_scale + scale * by_v2_2 + g3 * product_5;
                const double by_g2_2 = product_2 * by_by_g2 + by_v1 * by_by_scale + scale * by_v1_2 + g2 * product_5;
                const double by_g1_2 = product_2 * by_by_g1 + by_v0 * by_by_scale + scale * by_v0_2 + g1 * product_5;
                const double gap_4 = by_g0 * by_exponent_by_x3 + by_g1 * by_exponent_by_x2 - by_g2 * by_exponent_by_x1 -
                    by_g3 * by_exponent_by_x0 - x_block[0][lane] * by_g3_2;
                const double gap_5 = by_g0 * by_exponent_by_x1 - by_g1 * by_exponent_by_x0 + by_g2 * by_exponent_by_x3 -
                    by_g3 * by_exponent_by_x2 - x_block[2][lane] * by_g3_2;
                const double total_5 = by_g0 * by_exponent_by_x2 - by_g1 * by_exponent_by_x3 - by_g2 * by_exponent_by_x0 +
                    by_g3 * by_exponent_by_x1 + x_block[1][lane] * by_g3_2;
                const double total_6 = by_g0 * by_exponent_by_x0 + by_g1 * by_exponent_by_x1 + by_g2 * by_exponent_by_x2 +
                    by_g3 * by_exponent_by_x3 + x_block[3][lane] * by_g3_2;
                sum[0][lane] += total_6 + x_block[2][lane] * by_g2_2 + x_block[1][lane] * by_g1_2 + x_block[0][lane] * by_g0_2;
                sum[1][lane] += gap_5 + x_block[3][lane] * by_g2_2 - x_block[0][lane] * by_g1_2 + x_block[1][lane] * by_g0_2;
                sum[2][lane] += total_5 - x_block[0][lane] * by_g2_2 - x_block[3][lane] * by_g1_2 + x_block[2][lane] * by_g0_2;
                sum[3][lane] += gap_4 - x_block[1][lane] * by_g2_2 + x_block[2][lane] * by_g1_2 + x_block[3][lane] * by_g0_2;
                sum[4][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[5][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[6][lane] += v2 * by_z0 - z0 * by_by_v2;
                sum[7][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[8][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[9][lane] += v2 * by_z1 - z1 * by_by_v2;
                sum[10][lane] += v0 * by_z2 - z2 * by_by_v0;
                sum[11][lane] += v1 * by_z2 - z2 * by_by_v1;
                sum[12][lane] += v2 * by_z2 - z2 * by_by_v2;
                sum[13][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 14; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[4 * k + 0] += total[0];
            mu_bar[4 * k + 1] += total[1];
            mu_bar[4 * k + 2] += total[2];
            mu_bar[4 * k + 3] += total[3];
            W_bar[9 * k + 0] += total[4];
            W_bar[9 * k + 1] += total[5];
            W_bar[9 * k + 2] += total[6];
            W_bar[9 * k + 3] += total[7];
            W_bar[9 * k + 4] += total[8];
            W_bar[9 * k + 5] += total[9];
            W_bar[9 * k + 6] += total[10];
            W_bar[9 * k + 7] += total[11];
            W_bar[9 * k + 8] += total[12];
            amplitude_bar[1 * k + 0] += total[13];
        }
    }
    restore_denormals(mode);
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

/* Of degree 8, within 2^-30 of that of double precision. */
static inline float polynomial_t_over_norm_s_near_slope_slope_f(float x) {
    return 0.01864320252205291f + x * (0.008299119649304472f + x * (0.0028160002314375336f + x *
        (0.0008610440047704579f + x * (0.0002522458975272004f + x * (6.363291448779077e-05f + x *
        (2.9672627598761578e-05f + x * (-3.950664599532621e-06f + x * 5.308935243478486e-06f)))))));
}

/* Of degree 8, within 2^-29 of that of double precision. */
static inline float polynomial_log_det_series_slope_slope_f(float x) {
    return 0.008373548929811502f + x * (0.00409341251393332f + x * (0.0014659690505062421f + x *
        (0.0004642399977336899f + x * (0.00013949898494014724f + x * (3.562723292198236e-05f + x *
        (1.715338253936205e-05f + x * (-2.4083903642194996e-06f + x * 3.123850968155648e-06f)))))));
}

void so3_splats_f(
    size_t count,
    size_t splat_count,
    const float *SO3_RESTRICT x,
    const float *SO3_RESTRICT mu,
    const float *SO3_RESTRICT W,
    const float *SO3_RESTRICT amplitude,
    float *SO3_RESTRICT value,
    float *SO3_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[4][LANES], sum[4][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 4; ++i) x_block[i][lane] = x[4 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const float mu0 = mu[4 * k + 0];
            const float mu1 = mu[4 * k + 1];
            const float mu2 = mu[4 * k + 2];
            const float mu3 = mu[4 * k + 3];
            const float W0_0 = W[9 * k + 0];
            const float W0_1 = W[9 * k + 1];
            const float W0_2 = W[9 * k + 2];
            const float W1_0 = W[9 * k + 3];
            const float W1_1 = W[9 * k + 4];
            const float W1_2 = W[9 * k + 5];
            const float W2_0 = W[9 * k + 6];
            const float W2_1 = W[9 * k + 7];
            const float W2_2 = W[9 * k + 8];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float g0 = x_block[0][lane] * mu0 + x_block[1][lane] * mu1 + x_block[2][lane] * mu2 +
                    x_block[3][lane] * mu3;
                const float g1 = x_block[1][lane] * mu0 + x_block[2][lane] * mu3 - x_block[0][lane] * mu1 -
                    x_block[3][lane] * mu2;
                const float g2 = x_block[2][lane] * mu0 + x_block[3][lane] * mu1 - x_block[0][lane] * mu2 -
                    x_block[1][lane] * mu3;
                const float g3 = x_block[3][lane] * mu0 + x_block[1][lane] * mu2 - x_block[2][lane] * mu1 -
                    x_block[0][lane] * mu3;
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
                const float z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const float z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const float z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
                const float log_det_gap = log_det - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
                const float phi = amplitude_k * expf(log_det_gap);
                const float by_v2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0;
                const float by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                const float by_v0 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0;
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
                const float exponent_by_x3 = mu0 * by_g3 + mu1 * by_g2 - mu2 * by_g1 + mu3 * by_g0;
                const float exponent_by_x2 = mu0 * by_g2 - mu1 * by_g3 + mu3 * by_g1 + mu2 * by_g0;
                const float exponent_by_x1 = mu2 * by_g3 - mu3 * by_g2 + mu0 * by_g1 + mu1 * by_g0;
                const float exponent_by_x0 = -(mu3 * by_g3) - mu2 * by_g2 - mu1 * by_g1 + mu0 * by_g0;
                const float df0 = phi * exponent_by_x0;
                const float df1 = phi * exponent_by_x1;
                const float df2 = phi * exponent_by_x2;
                const float df3 = phi * exponent_by_x3;
                const float df1_product = 0.5f * df1;
                const float df2_product = 0.5f * df2;
                const float df0_product = 0.5f * df0;
                const float df3_product = 0.5f * df3;
                const float gradient0 = x_block[0][lane] * df1_product + x_block[3][lane] * df2_product - x_block[1][lane]
                    * df0_product - x_block[2][lane] * df3_product;
                const float gradient1 = x_block[0][lane] * df2_product + x_block[1][lane] * df3_product - x_block[2][lane]
                    * df0_product - x_block[3][lane] * df1_product;
                const float gradient2 = x_block[2][lane] * df1_product + x_block[0][lane] * df3_product - x_block[3][lane]
                    * df0_product - x_block[1][lane] * df2_product;
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

void so3_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *SO3_RESTRICT x,
    const float *SO3_RESTRICT mu,
    const float *SO3_RESTRICT W,
    const float *SO3_RESTRICT amplitude,
    const float *SO3_RESTRICT value_bar,
    const float *SO3_RESTRICT gradient_bar,
    float *SO3_RESTRICT mu_bar,
    float *SO3_RESTRICT W_bar,
    float *SO3_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 4 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 9 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[4][LANES], value_bar_block[1][LANES], gradient_bar_block[3][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const float weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 4; ++i) x_block[i][lane] = x[4 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] = gradient_bar[3 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 3; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            float sum[14][LANES] = {{0}}, total[14] = {0};
            const float mu0 = mu[4 * k + 0];
            const float mu1 = mu[4 * k + 1];
            const float mu2 = mu[4 * k + 2];
            const float mu3 = mu[4 * k + 3];
            const float W0_0 = W[9 * k + 0];
            const float W0_1 = W[9 * k + 1];
            const float W0_2 = W[9 * k + 2];
            const float W1_0 = W[9 * k + 3];
            const float W1_1 = W[9 * k + 4];
            const float W1_2 = W[9 * k + 5];
            const float W2_0 = W[9 * k + 6];
            const float W2_1 = W[9 * k + 7];
            const float W2_2 = W[9 * k + 8];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float g0 = x_block[0][lane] * mu0 + x_block[1][lane] * mu1 + x_block[2][lane] * mu2 +
                    x_block[3][lane] * mu3;
                const float g1 = x_block[1][lane] * mu0 + x_block[2][lane] * mu3 - x_block[0][lane] * mu1 -
                    x_block[3][lane] * mu2;
                const float g2 = x_block[2][lane] * mu0 + x_block[3][lane] * mu1 - x_block[0][lane] * mu2 -
                    x_block[1][lane] * mu3;
                const float g3 = x_block[3][lane] * mu0 + x_block[1][lane] * mu2 - x_block[2][lane] * mu1 -
                    x_block[0][lane] * mu3;
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
                const float z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const float z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const float z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
                const float log_det_gap = log_det - 0.5f * (z0 * z0 + z1 * z1 + z2 * z2);
                const float exp_2 = expf(log_det_gap);
                const float phi = amplitude_k * exp_2;
                const float by_v2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0;
                const float by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                const float by_v0 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0;
                const float by_log_det_near = (near ? 1.0f : 0.0f);
                const float ratio = 2.0f * (near ? 0.0f : 1.0f) / product;
                const float by_log_det_series = norm_s_squared * by_log_det_near;
                const float log_det_series_slope = polynomial_log_det_series_slope_f(near_chosen);
                const float by_scale = g3 * by_v2 + g2 * by_v1 + g1 * by_v0;
                const float by_t_over_norm_s = chosen * by_scale;
                const float by_t_over_norm_s_near = (near ? by_t_over_norm_s : 0.0f);
                const float by_t = (0.5f * ratio + (near ? 0.0f : by_t_over_norm_s)) / norm_s;
                const float by_atan2_norm_s_abs_g0 = 2.0f * by_t;
                const float total_2 = near_chosen_2 + abs_g0 * abs_g0;
                const float ratio_2 = by_atan2_norm_s_abs_g0 / total_2;
                const float norm_s_product = norm_s * ratio_2;
                const float by_abs_g0 = -norm_s_product;
                const float by_norm_s = abs_g0 * ratio_2 - t_ratio * by_t;
                const float norm_s_product_2 = 2.0f * norm_s;
                const float by_norm_s_ratio = by_norm_s / norm_s_product_2;
                const float t_over_norm_s_near_slope = polynomial_t_over_norm_s_near_slope_f(near_chosen);
                const float by_norm_s_squared = log_det_series * by_log_det_near + (near ? 0.0f : by_norm_s_ratio) +
                    4.011440628672975f * (near ? by_log_det_series * log_det_series_slope + by_t_over_norm_s_near *
                    t_over_norm_s_near_slope : 0.0f);
                const float by_g0 = (is_small ? norm_s_product : by_abs_g0);
                const float product_2 = 2.0f * by_norm_s_squared;
                const float by_g3 = scale * by_v2 + g3 * product_2;
                const float by_g2 = scale * by_v1 + g2 * product_2;
                const float by_g1 = scale * by_v0 + g1 * product_2;
                const float exponent_by_x3 = mu0 * by_g3 + mu1 * by_g2 - mu2 * by_g1 + mu3 * by_g0;
                const float exponent_by_x2 = mu0 * by_g2 - mu1 * by_g3 + mu3 * by_g1 + mu2 * by_g0;
                const float exponent_by_x1 = mu2 * by_g3 - mu3 * by_g2 + mu0 * by_g1 + mu1 * by_g0;
                const float exponent_by_x0 = -(mu3 * by_g3) - mu2 * by_g2 - mu1 * by_g1 + mu0 * by_g0;
                const float by_df3 = 0.5f * (x_block[0][lane] * gradient_bar_block[2][lane] + x_block[1][lane] *
                    gradient_bar_block[1][lane] - x_block[2][lane] * gradient_bar_block[0][lane]);
                const float by_df0 = 0.5f * (-(x_block[3][lane] * gradient_bar_block[2][lane]) - x_block[2][lane] *
                    gradient_bar_block[1][lane] - x_block[1][lane] * gradient_bar_block[0][lane]);
                const float by_df2 = 0.5f * (x_block[0][lane] * gradient_bar_block[1][lane] - x_block[1][lane] *
                    gradient_bar_block[2][lane] + x_block[3][lane] * gradient_bar_block[0][lane]);
                const float by_df1 = 0.5f * (x_block[2][lane] * gradient_bar_block[2][lane] - x_block[3][lane] *
                    gradient_bar_block[1][lane] + x_block[0][lane] * gradient_bar_block[0][lane]);
                const float by_exponent_by_x3 = phi * by_df3;
                const float by_exponent_by_x2 = phi * by_df2;
                const float by_exponent_by_x1 = phi * by_df1;
                const float by_exponent_by_x0 = phi * by_df0;
                const float by_phi = value_bar_block[0][lane] + exponent_by_x3 * by_df3 + exponent_by_x2 * by_df2 +
                    exponent_by_x1 * by_df1 + exponent_by_x0 * by_df0;
                const float by_by_g0 = mu0 * by_exponent_by_x0 + mu1 * by_exponent_by_x1 + mu2 * by_exponent_by_x2 + mu3 *
                    by_exponent_by_x3;
                const float by_by_g1 = mu0 * by_exponent_by_x1 + mu3 * by_exponent_by_x2 - mu1 * by_exponent_by_x0 - mu2 *
                    by_exponent_by_x3;
                const float by_by_g2 = mu0 * by_exponent_by_x2 + mu1 * by_exponent_by_x3 - mu2 * by_exponent_by_x0 - mu3 *
                    by_exponent_by_x1;
                const float by_by_g3 = mu0 * by_exponent_by_x3 + mu2 * by_exponent_by_x1 - mu1 * by_exponent_by_x2 - mu3 *
                    by_exponent_by_x0;
                const float total_3 = g1 * by_by_g1 + g2 * by_by_g2 + g3 * by_by_g3;
                const float by_by_norm_s_squared = 2.0f * total_3;
                const float by_by_abs_g0 = (is_small ? 0.0f : by_by_g0);
                const float near_chosen_3 = (near ? 8.02288125734595f * total_3 : 0.0f);
                const float by_by_t_over_norm_s_near = t_over_norm_s_near_slope * near_chosen_3;
                const float by_t_over_norm_s_near_slope = by_t_over_norm_s_near * near_chosen_3;
                const float t_over_norm_s_near_slope_slope = polynomial_t_over_norm_s_near_slope_slope_f(near_chosen);
                const float by_by_norm_s = (near ? 0.0f : by_by_norm_s_squared) / norm_s_product_2;
                const float gap = (is_small ? by_by_g0 : 0.0f) - by_by_abs_g0;
                const float by_by_atan2_norm_s_abs_g0 = (norm_s * gap + abs_g0 * by_by_norm_s) / total_2;
                const float product_3 = ratio_2 * by_by_atan2_norm_s_abs_g0;
                const float gap_2 = ratio_2 * by_by_norm_s - abs_g0 * (2.0f * product_3);
                const float by_by_t = 2.0f * by_by_atan2_norm_s_abs_g0 - t_ratio * by_by_norm_s;
                const float by_by_t_ratio = by_by_t / norm_s;
                const float by_by_t_over_norm_s = (near ? 0.0f : by_by_t_ratio) + (near ? by_by_t_over_norm_s_near :
                    0.0f);
                const float by_by_scale = chosen * by_by_t_over_norm_s;
                const float by_by_v0 = g1 * by_by_scale + scale * by_by_g1;
                const float by_by_v1 = g2 * by_by_scale + scale * by_by_g2;
                const float by_by_v2 = g3 * by_by_scale + scale * by_by_g3;
                const float by_by_log_det_series = log_det_series_slope * near_chosen_3;
                const float by_log_det_series_slope = by_log_det_series * near_chosen_3;
                const float log_det_series_slope_slope = polynomial_log_det_series_slope_slope_f(near_chosen);
                const float by_log_det = exp_2 * (amplitude_k * by_phi);
                const float by_z2 = -(W2_0 * by_by_v0) - W2_1 * by_by_v1 - W2_2 * by_by_v2 - z2 * by_log_det;
                const float by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - z1 * by_log_det;
                const float by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - z0 * by_log_det;
                const float by_v2_2 = W2_2 * by_z2 + W1_2 * by_z1 + W0_2 * by_z0;
                const float by_v1_2 = W2_1 * by_z2 + W1_1 * by_z1 + W0_1 * by_z0;
                const float by_v0_2 = W2_0 * by_z2 + W1_0 * by_z1 + W0_0 * by_z0;
                const float by_log_det_near_2 = (near ? by_log_det : 0.0f);
                const float product_4 = 0.5f * (2.0f * (near ? 0.0f : by_log_det) / product - ratio * (0.5f *
                    by_by_t_ratio / product));
                const float by_log_det_series_2 = by_log_det_near * by_by_norm_s_squared + norm_s_squared *
                    by_log_det_near_2;
                const float total_4 = by_v0 * by_by_g1 + by_v1 * by_by_g2 + by_v2 * by_by_g3 + g3 * by_v2_2 + g2 *
                    by_v1_2;
                const float by_scale_2 = total_4 + g1 * by_v0_2;
                const float by_t_over_norm_s_2 = chosen * by_scale_2;
                const float by_t_over_norm_s_near_2 = (near ? by_t_over_norm_s_2 : 0.0f);
                const float by_t_2 = (product_4 - by_t * by_by_norm_s + (near ? 0.0f : by_t_over_norm_s_2)) / norm_s;
                const float gap_3 = ratio_2 * gap - 2.0f * (by_norm_s_ratio * by_by_norm_s) - by_t * by_by_t_ratio -
                    t_ratio * by_t_2;
                const float by_atan2_norm_s_abs_g0_2 = 2.0f * by_t_2;
                const float ratio_3 = by_atan2_norm_s_abs_g0_2 / total_2;
                const float norm_s_product_3 = norm_s * ratio_3;
                const float by_norm_s_2 = gap_3 + abs_g0 * ratio_3;
                const float by_abs_g0_2 = gap_2 - norm_s_product_3;
                const float near_chosen_4 = (near ? by_t_over_norm_s_near_slope * t_over_norm_s_near_slope_slope +
                    by_log_det_series_slope * log_det_series_slope_slope + log_det_series_slope * by_log_det_series_2 +
                    t_over_norm_s_near_slope * by_t_over_norm_s_near_2 : 0.0f);
                const float by_norm_s_squared_2 = by_log_det_near * by_by_log_det_series + log_det_series *
                    by_log_det_near_2 + (near ? 0.0f : by_norm_s_2 / norm_s_product_2 - product_3) + 4.011440628672975f *
                    near_chosen_4;
                const float by_g0_2 = (is_small ? norm_s_product_3 - gap_2 : by_abs_g0_2);
                const float product_5 = 2.0f * by_norm_s_squared_2;
                const float by_g3_2 = product_2 * by_by_g3 + by_v2 * by_by_scale + scale * by_v2_2 + g3 * product_5;
                const float by_g2_2 = product_2 * by_by_g2 + by_v1 * by_by_scale + scale * by_v1_2 + g2 * product_5;
                const float by_g1_2 = product_2 * by_by_g1 + by_v0 * by_by_scale + scale * by_v0_2 + g1 * product_5;
                const float gap_4 = by_g0 * by_exponent_by_x3 + by_g1 * by_exponent_by_x2 - by_g2 * by_exponent_by_x1 -
                    by_g3 * by_exponent_by_x0 - x_block[0][lane] * by_g3_2;
                const float gap_5 = by_g0 * by_exponent_by_x1 - by_g1 * by_exponent_by_x0 + by_g2 * by_exponent_by_x3 -
                    by_g3 * by_exponent_by_x2 - x_block[2][lane] * by_g3_2;
                const float total_5 = by_g0 * by_exponent_by_x2 - by_g1 * by_exponent_by_x3 - by_g2 * by_exponent_by_x0 +
                    by_g3 * by_exponent_by_x1 + x_block[1][lane] * by_g3_2;
                const float total_6 = by_g0 * by_exponent_by_x0 + by_g1 * by_exponent_by_x1 + by_g2 * by_exponent_by_x2 +
                    by_g3 * by_exponent_by_x3 + x_block[3][lane] * by_g3_2;
                sum[0][lane] += total_6 + x_block[2][lane] * by_g2_2 + x_block[1][lane] * by_g1_2 + x_block[0][lane] * by_g0_2;
                sum[1][lane] += gap_5 + x_block[3][lane] * by_g2_2 - x_block[0][lane] * by_g1_2 + x_block[1][lane] * by_g0_2;
                sum[2][lane] += total_5 - x_block[0][lane] * by_g2_2 - x_block[3][lane] * by_g1_2 + x_block[2][lane] * by_g0_2;
                sum[3][lane] += gap_4 - x_block[1][lane] * by_g2_2 + x_block[2][lane] * by_g1_2 + x_block[3][lane] * by_g0_2;
                sum[4][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[5][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[6][lane] += v2 * by_z0 - z0 * by_by_v2;
                sum[7][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[8][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[9][lane] += v2 * by_z1 - z1 * by_by_v2;
                sum[10][lane] += v0 * by_z2 - z2 * by_by_v0;
                sum[11][lane] += v1 * by_z2 - z2 * by_by_v1;
                sum[12][lane] += v2 * by_z2 - z2 * by_by_v2;
                sum[13][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 14; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[4 * k + 0] += total[0];
            mu_bar[4 * k + 1] += total[1];
            mu_bar[4 * k + 2] += total[2];
            mu_bar[4 * k + 3] += total[3];
            W_bar[9 * k + 0] += total[4];
            W_bar[9 * k + 1] += total[5];
            W_bar[9 * k + 2] += total[6];
            W_bar[9 * k + 3] += total[7];
            W_bar[9 * k + 4] += total[8];
            W_bar[9 * k + 5] += total[9];
            W_bar[9 * k + 6] += total[10];
            W_bar[9 * k + 7] += total[11];
            W_bar[9 * k + 8] += total[12];
            amplitude_bar[1 * k + 0] += total[13];
        }
    }
    restore_denormals(mode);
}
