/*
 * se3: Poses of a rigid body, R^3 x SO(3); a rotation by one radian is as long as `radius`, in the unit of the
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "se3.h"

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

/* Of degree 11 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_rotation_t_over_norm_s_near_slope_slope(double x) {
    return 0.018643202510559807 + x * (0.008299121481917445 + x * (0.0028159522967385387 + x *
        (0.0008615244488774448 + x * (0.00024984954588029915 + x * (7.028363271022215e-05 + x *
        (1.89798401694423e-05 + x * (5.875783766625421e-06 + x * (5.003643981595386e-07 + x *
        (1.1877220896552042e-06 + x * (-3.538311894046709e-07 + x * 1.5233524430341798e-07))))))))));
}

/* Of degree 11 on [0, 1], the derivative of a polynomial. */
static inline double polynomial_rotation_log_det_series_slope_slope(double x) {
    return 0.00837354892300497 + x * (0.004093413599169786 + x * (0.0014659406672238098 + x *
        (0.00046452444853173575 + x * (0.00013808038982049257 + x * (3.956376600918562e-05 + x *
        (1.0825177352974468e-05 + x * (3.4072951566509835e-06 + x * (2.7515096116612774e-07 + x *
        (7.082806450744882e-07 + x * (-2.1336272104298557e-07 + x * 9.122574198606865e-08))))))))));
}

void se3_splats(
    size_t count,
    size_t splat_count,
    const double *SE3_RESTRICT x,
    const double *SE3_RESTRICT mu,
    const double *SE3_RESTRICT W,
    const double *SE3_RESTRICT amplitude,
    double *SE3_RESTRICT value,
    double *SE3_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[7][LANES], sum[7][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 7; ++i) x_block[i][lane] = x[7 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const double mu0 = mu[7 * k + 0];
            const double mu1 = mu[7 * k + 1];
            const double mu2 = mu[7 * k + 2];
            const double mu3 = mu[7 * k + 3];
            const double mu4 = mu[7 * k + 4];
            const double mu5 = mu[7 * k + 5];
            const double mu6 = mu[7 * k + 6];
            const double W0_0 = W[36 * k + 0];
            const double W0_1 = W[36 * k + 1];
            const double W0_2 = W[36 * k + 2];
            const double W0_3 = W[36 * k + 3];
            const double W0_4 = W[36 * k + 4];
            const double W0_5 = W[36 * k + 5];
            const double W1_0 = W[36 * k + 6];
            const double W1_1 = W[36 * k + 7];
            const double W1_2 = W[36 * k + 8];
            const double W1_3 = W[36 * k + 9];
            const double W1_4 = W[36 * k + 10];
            const double W1_5 = W[36 * k + 11];
            const double W2_0 = W[36 * k + 12];
            const double W2_1 = W[36 * k + 13];
            const double W2_2 = W[36 * k + 14];
            const double W2_3 = W[36 * k + 15];
            const double W2_4 = W[36 * k + 16];
            const double W2_5 = W[36 * k + 17];
            const double W3_0 = W[36 * k + 18];
            const double W3_1 = W[36 * k + 19];
            const double W3_2 = W[36 * k + 20];
            const double W3_3 = W[36 * k + 21];
            const double W3_4 = W[36 * k + 22];
            const double W3_5 = W[36 * k + 23];
            const double W4_0 = W[36 * k + 24];
            const double W4_1 = W[36 * k + 25];
            const double W4_2 = W[36 * k + 26];
            const double W4_3 = W[36 * k + 27];
            const double W4_4 = W[36 * k + 28];
            const double W4_5 = W[36 * k + 29];
            const double W5_0 = W[36 * k + 30];
            const double W5_1 = W[36 * k + 31];
            const double W5_2 = W[36 * k + 32];
            const double W5_3 = W[36 * k + 33];
            const double W5_4 = W[36 * k + 34];
            const double W5_5 = W[36 * k + 35];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double rotation_g0 = x_block[3][lane] * mu3 + x_block[4][lane] * mu4 + x_block[5][lane] * mu5 +
                    x_block[6][lane] * mu6;
                const double rotation_g1 = x_block[4][lane] * mu3 + x_block[5][lane] * mu6 - x_block[3][lane] * mu4 -
                    x_block[6][lane] * mu5;
                const double rotation_g2 = x_block[5][lane] * mu3 + x_block[6][lane] * mu4 - x_block[3][lane] * mu5 -
                    x_block[4][lane] * mu6;
                const double rotation_g3 = x_block[6][lane] * mu3 + x_block[4][lane] * mu5 - x_block[5][lane] * mu4 -
                    x_block[3][lane] * mu6;
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
                const double v0 = x_block[0][lane] - mu0;
                const double v1 = x_block[1][lane] - mu1;
                const double v2 = x_block[2][lane] - mu2;
                const double v3 = rotation_g1 * rotation_scale;
                const double v4 = rotation_g2 * rotation_scale;
                const double v5 = rotation_g3 * rotation_scale;
                const double rotation_log_det_series = polynomial_rotation_log_det_series(near_chosen);
                const double rotation_log_det_near = rotation_norm_s_squared * rotation_log_det_series;
                const double product = 0.5 * rotation_t_ratio;
                const double rotation_log_det = (near ? rotation_log_det_near : 2.0 * log(product));
                const double total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
                const double z0 = total_2 + W0_5 * v5;
                const double total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
                const double z1 = total_3 + W1_5 * v5;
                const double total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
                const double z2 = total_4 + W2_5 * v5;
                const double total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
                const double z3 = total_5 + W3_5 * v5;
                const double total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
                const double z4 = total_6 + W4_5 * v5;
                const double total_7 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
                const double z5 = total_7 + W5_5 * v5;
                const double total_8 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
                const double exp_2 = exp(rotation_log_det - 0.5 * (total_8 + z5 * z5));
                const double phi = amplitude_k * exp_2;
                const double gap = -(W5_5 * z5) - W4_5 * z4 - W3_5 * z3 - W2_5 * z2;
                const double gap_2 = -(W5_4 * z5) - W4_4 * z4 - W3_4 * z3 - W2_4 * z2;
                const double gap_3 = -(W5_3 * z5) - W4_3 * z4 - W3_3 * z3 - W2_3 * z2;
                const double gap_4 = -(W5_2 * z5) - W4_2 * z4 - W3_2 * z3 - W2_2 * z2;
                const double gap_5 = -(W5_1 * z5) - W4_1 * z4 - W3_1 * z3 - W2_1 * z2;
                const double gap_6 = -(W5_0 * z5) - W4_0 * z4 - W3_0 * z3 - W2_0 * z2;
                const double by_v5 = gap - W1_5 * z1 - W0_5 * z0;
                const double by_v4 = gap_2 - W1_4 * z1 - W0_4 * z0;
                const double by_v3 = gap_3 - W1_3 * z1 - W0_3 * z0;
                const double by_v2 = gap_4 - W1_2 * z1 - W0_2 * z0;
                const double by_v1 = gap_5 - W1_1 * z1 - W0_1 * z0;
                const double by_v0 = gap_6 - W1_0 * z1 - W0_0 * z0;
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
                const double exponent_by_x6 = mu3 * by_rotation_g3 + mu4 * by_rotation_g2 - mu5 * by_rotation_g1 + mu6 *
                    by_rotation_g0;
                const double exponent_by_x5 = mu3 * by_rotation_g2 - mu4 * by_rotation_g3 + mu6 * by_rotation_g1 + mu5 *
                    by_rotation_g0;
                const double exponent_by_x4 = mu5 * by_rotation_g3 - mu6 * by_rotation_g2 + mu3 * by_rotation_g1 + mu4 *
                    by_rotation_g0;
                const double exponent_by_x3 = -(mu6 * by_rotation_g3) - mu5 * by_rotation_g2 - mu4 * by_rotation_g1 + mu3
                    * by_rotation_g0;
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
                const double gradient3 = x_block[3][lane] * df4_product + x_block[6][lane] * df5_product -
                    x_block[4][lane] * df3_product - x_block[5][lane] * df6_product;
                const double gradient4 = x_block[3][lane] * df5_product + x_block[4][lane] * df6_product -
                    x_block[5][lane] * df3_product - x_block[6][lane] * df4_product;
                const double gradient5 = x_block[5][lane] * df4_product + x_block[3][lane] * df6_product -
                    x_block[6][lane] * df3_product - x_block[4][lane] * df5_product;
                sum[0][lane] += phi;
                sum[1][lane] += df0;
                sum[2][lane] += df1;
                sum[3][lane] += df2;
                sum[4][lane] += gradient3;
                sum[5][lane] += gradient4;
                sum[6][lane] += gradient5;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 6; ++i) gradient[6 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void se3_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *SE3_RESTRICT x,
    const double *SE3_RESTRICT mu,
    const double *SE3_RESTRICT W,
    const double *SE3_RESTRICT amplitude,
    const double *SE3_RESTRICT value_bar,
    const double *SE3_RESTRICT gradient_bar,
    double *SE3_RESTRICT mu_bar,
    double *SE3_RESTRICT W_bar,
    double *SE3_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 7 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 36 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[7][LANES], value_bar_block[1][LANES], gradient_bar_block[6][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const double weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 7; ++i) x_block[i][lane] = x[7 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 6; ++i) gradient_bar_block[i][lane] = gradient_bar[6 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 6; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            double sum[44][LANES] = {{0}}, total[44] = {0};
            const double mu0 = mu[7 * k + 0];
            const double mu1 = mu[7 * k + 1];
            const double mu2 = mu[7 * k + 2];
            const double mu3 = mu[7 * k + 3];
            const double mu4 = mu[7 * k + 4];
            const double mu5 = mu[7 * k + 5];
            const double mu6 = mu[7 * k + 6];
            const double W0_0 = W[36 * k + 0];
            const double W0_1 = W[36 * k + 1];
            const double W0_2 = W[36 * k + 2];
            const double W0_3 = W[36 * k + 3];
            const double W0_4 = W[36 * k + 4];
            const double W0_5 = W[36 * k + 5];
            const double W1_0 = W[36 * k + 6];
            const double W1_1 = W[36 * k + 7];
            const double W1_2 = W[36 * k + 8];
            const double W1_3 = W[36 * k + 9];
            const double W1_4 = W[36 * k + 10];
            const double W1_5 = W[36 * k + 11];
            const double W2_0 = W[36 * k + 12];
            const double W2_1 = W[36 * k + 13];
            const double W2_2 = W[36 * k + 14];
            const double W2_3 = W[36 * k + 15];
            const double W2_4 = W[36 * k + 16];
            const double W2_5 = W[36 * k + 17];
            const double W3_0 = W[36 * k + 18];
            const double W3_1 = W[36 * k + 19];
            const double W3_2 = W[36 * k + 20];
            const double W3_3 = W[36 * k + 21];
            const double W3_4 = W[36 * k + 22];
            const double W3_5 = W[36 * k + 23];
            const double W4_0 = W[36 * k + 24];
            const double W4_1 = W[36 * k + 25];
            const double W4_2 = W[36 * k + 26];
            const double W4_3 = W[36 * k + 27];
            const double W4_4 = W[36 * k + 28];
            const double W4_5 = W[36 * k + 29];
            const double W5_0 = W[36 * k + 30];
            const double W5_1 = W[36 * k + 31];
            const double W5_2 = W[36 * k + 32];
            const double W5_3 = W[36 * k + 33];
            const double W5_4 = W[36 * k + 34];
            const double W5_5 = W[36 * k + 35];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double rotation_g0 = x_block[3][lane] * mu3 + x_block[4][lane] * mu4 + x_block[5][lane] * mu5 +
                    x_block[6][lane] * mu6;
                const double rotation_g1 = x_block[4][lane] * mu3 + x_block[5][lane] * mu6 - x_block[3][lane] * mu4 -
                    x_block[6][lane] * mu5;
                const double rotation_g2 = x_block[5][lane] * mu3 + x_block[6][lane] * mu4 - x_block[3][lane] * mu5 -
                    x_block[4][lane] * mu6;
                const double rotation_g3 = x_block[6][lane] * mu3 + x_block[4][lane] * mu5 - x_block[5][lane] * mu4 -
                    x_block[3][lane] * mu6;
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
                const double v0 = x_block[0][lane] - mu0;
                const double v1 = x_block[1][lane] - mu1;
                const double v2 = x_block[2][lane] - mu2;
                const double v3 = rotation_g1 * rotation_scale;
                const double v4 = rotation_g2 * rotation_scale;
                const double v5 = rotation_g3 * rotation_scale;
                const double rotation_log_det_series = polynomial_rotation_log_det_series(near_chosen);
                const double rotation_log_det_near = rotation_norm_s_squared * rotation_log_det_series;
                const double product = 0.5 * rotation_t_ratio;
                const double rotation_log_det = (near ? rotation_log_det_near : 2.0 * log(product));
                const double total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
                const double z0 = total_2 + W0_5 * v5;
                const double total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
                const double z1 = total_3 + W1_5 * v5;
                const double total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
                const double z2 = total_4 + W2_5 * v5;
                const double total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
                const double z3 = total_5 + W3_5 * v5;
                const double total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
                const double z4 = total_6 + W4_5 * v5;
                const double total_7 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
                const double z5 = total_7 + W5_5 * v5;
                const double total_8 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
                const double exp_2 = exp(rotation_log_det - 0.5 * (total_8 + z5 * z5));
                const double phi = amplitude_k * exp_2;
                const double gap = -(W5_5 * z5) - W4_5 * z4 - W3_5 * z3 - W2_5 * z2;
                const double gap_2 = -(W5_4 * z5) - W4_4 * z4 - W3_4 * z3 - W2_4 * z2;
                const double gap_3 = -(W5_3 * z5) - W4_3 * z4 - W3_3 * z3 - W2_3 * z2;
                const double gap_4 = -(W5_2 * z5) - W4_2 * z4 - W3_2 * z3 - W2_2 * z2;
                const double gap_5 = -(W5_1 * z5) - W4_1 * z4 - W3_1 * z3 - W2_1 * z2;
                const double gap_6 = -(W5_0 * z5) - W4_0 * z4 - W3_0 * z3 - W2_0 * z2;
                const double by_v5 = gap - W1_5 * z1 - W0_5 * z0;
                const double by_v4 = gap_2 - W1_4 * z1 - W0_4 * z0;
                const double by_v3 = gap_3 - W1_3 * z1 - W0_3 * z0;
                const double by_v2 = gap_4 - W1_2 * z1 - W0_2 * z0;
                const double by_v1 = gap_5 - W1_1 * z1 - W0_1 * z0;
                const double by_v0 = gap_6 - W1_0 * z1 - W0_0 * z0;
                const double by_rotation_log_det_near = (near ? 1.0 : 0.0);
                const double ratio = 2.0 * (near ? 0.0 : 1.0) / product;
                const double by_rotation_log_det_series = rotation_norm_s_squared * by_rotation_log_det_near;
                const double rotation_log_det_series_slope = polynomial_rotation_log_det_series_slope(near_chosen);
                const double by_rotation_scale = rotation_g3 * by_v5 + rotation_g2 * by_v4 + rotation_g1 * by_v3;
                const double by_rotation_t_over_norm_s = chosen * by_rotation_scale;
                const double by_rotation_t_over_norm_s_near = (near ? by_rotation_t_over_norm_s : 0.0);
                const double by_rotation_t = (0.5 * ratio + (near ? 0.0 : by_rotation_t_over_norm_s)) / rotation_norm_s;
                const double by_rotation_atan2_norm_s_abs_g0 = 2.0 * by_rotation_t;
                const double total_9 = near_chosen_2 + rotation_abs_g0 * rotation_abs_g0;
                const double ratio_2 = by_rotation_atan2_norm_s_abs_g0 / total_9;
                const double product_2 = rotation_norm_s * ratio_2;
                const double by_rotation_abs_g0 = -product_2;
                const double by_rotation_norm_s = rotation_abs_g0 * ratio_2 - rotation_t_ratio * by_rotation_t;
                const double product_3 = 2.0 * rotation_norm_s;
                const double ratio_3 = by_rotation_norm_s / product_3;
                const double rotation_t_over_norm_s_near_slope =
                    polynomial_rotation_t_over_norm_s_near_slope(near_chosen);
                const double by_rotation_norm_s_squared = rotation_log_det_series * by_rotation_log_det_near + (near ? 0.0
                    : ratio_3) + 4.011440628672975 * (near ? by_rotation_log_det_series * rotation_log_det_series_slope +
                    by_rotation_t_over_norm_s_near * rotation_t_over_norm_s_near_slope : 0.0);
                const double by_rotation_g0 = (is_small ? product_2 : by_rotation_abs_g0);
                const double product_4 = 2.0 * by_rotation_norm_s_squared;
                const double by_rotation_g3 = rotation_scale * by_v5 + rotation_g3 * product_4;
                const double by_rotation_g2 = rotation_scale * by_v4 + rotation_g2 * product_4;
                const double by_rotation_g1 = rotation_scale * by_v3 + rotation_g1 * product_4;
                const double exponent_by_x6 = mu3 * by_rotation_g3 + mu4 * by_rotation_g2 - mu5 * by_rotation_g1 + mu6 *
                    by_rotation_g0;
                const double exponent_by_x5 = mu3 * by_rotation_g2 - mu4 * by_rotation_g3 + mu6 * by_rotation_g1 + mu5 *
                    by_rotation_g0;
                const double exponent_by_x4 = mu5 * by_rotation_g3 - mu6 * by_rotation_g2 + mu3 * by_rotation_g1 + mu4 *
                    by_rotation_g0;
                const double exponent_by_x3 = -(mu6 * by_rotation_g3) - mu5 * by_rotation_g2 - mu4 * by_rotation_g1 + mu3
                    * by_rotation_g0;
                const double by_df6 = 0.5 * (x_block[3][lane] * gradient_bar_block[5][lane] + x_block[4][lane] *
                    gradient_bar_block[4][lane] - x_block[5][lane] * gradient_bar_block[3][lane]);
                const double by_df3 = 0.5 * (-(x_block[6][lane] * gradient_bar_block[5][lane]) - x_block[5][lane] *
                    gradient_bar_block[4][lane] - x_block[4][lane] * gradient_bar_block[3][lane]);
                const double by_df5 = 0.5 * (x_block[3][lane] * gradient_bar_block[4][lane] - x_block[4][lane] *
                    gradient_bar_block[5][lane] + x_block[6][lane] * gradient_bar_block[3][lane]);
                const double by_df4 = 0.5 * (x_block[5][lane] * gradient_bar_block[5][lane] - x_block[6][lane] *
                    gradient_bar_block[4][lane] + x_block[3][lane] * gradient_bar_block[3][lane]);
                const double by_exponent_by_x6 = phi * by_df6;
                const double by_exponent_by_x5 = phi * by_df5;
                const double by_exponent_by_x4 = phi * by_df4;
                const double by_exponent_by_x3 = phi * by_df3;
                const double total_10 = value_bar_block[0][lane] + exponent_by_x6 * by_df6 + exponent_by_x5 * by_df5 +
                    exponent_by_x4 * by_df4 + exponent_by_x3 * by_df3;
                const double by_by_v2 = phi * gradient_bar_block[2][lane];
                const double by_by_v1 = phi * gradient_bar_block[1][lane];
                const double by_by_v0 = phi * gradient_bar_block[0][lane];
                const double by_phi = total_10 + by_v2 * gradient_bar_block[2][lane] + by_v1 * gradient_bar_block[1][lane]
                    + by_v0 * gradient_bar_block[0][lane];
                const double by_by_rotation_g0 = mu3 * by_exponent_by_x3 + mu4 * by_exponent_by_x4 + mu5 *
                    by_exponent_by_x5 + mu6 * by_exponent_by_x6;
                const double by_by_rotation_g1 = mu3 * by_exponent_by_x4 + mu6 * by_exponent_by_x5 - mu4 *
                    by_exponent_by_x3 - mu5 * by_exponent_by_x6;
                const double by_by_rotation_g2 = mu3 * by_exponent_by_x5 + mu4 * by_exponent_by_x6 - mu5 *
                    by_exponent_by_x3 - mu6 * by_exponent_by_x4;
                const double by_by_rotation_g3 = mu3 * by_exponent_by_x6 + mu5 * by_exponent_by_x4 - mu4 *
                    by_exponent_by_x5 - mu6 * by_exponent_by_x3;
                const double total_11 = rotation_g1 * by_by_rotation_g1 + rotation_g2 * by_by_rotation_g2 + rotation_g3 *
                    by_by_rotation_g3;
                const double by_by_rotation_norm_s_squared = 2.0 * total_11;
                const double by_by_rotation_abs_g0 = (is_small ? 0.0 : by_by_rotation_g0);
                const double near_chosen_3 = (near ? 8.02288125734595 * total_11 : 0.0);
                const double by_by_rotation_t_over_norm_s_near = rotation_t_over_norm_s_near_slope * near_chosen_3;
                const double by_rotation_t_over_norm_s_near_slope = by_rotation_t_over_norm_s_near * near_chosen_3;
                const double rotation_t_over_norm_s_near_slope_slope =
                    polynomial_rotation_t_over_norm_s_near_slope_slope(near_chosen);
                const double by_by_rotation_norm_s = (near ? 0.0 : by_by_rotation_norm_s_squared) / product_3;
                const double gap_7 = (is_small ? by_by_rotation_g0 : 0.0) - by_by_rotation_abs_g0;
                const double by_by_rotation_atan2_norm_s_abs_g0 = (rotation_norm_s * gap_7 + rotation_abs_g0 *
                    by_by_rotation_norm_s) / total_9;
                const double product_5 = ratio_2 * by_by_rotation_atan2_norm_s_abs_g0;
                const double gap_8 = ratio_2 * by_by_rotation_norm_s - rotation_abs_g0 * (2.0 * product_5);
                const double by_by_rotation_t = 2.0 * by_by_rotation_atan2_norm_s_abs_g0 - rotation_t_ratio *
                    by_by_rotation_norm_s;
                const double ratio_4 = by_by_rotation_t / rotation_norm_s;
                const double by_by_rotation_t_over_norm_s = (near ? 0.0 : ratio_4) + (near ?
                    by_by_rotation_t_over_norm_s_near : 0.0);
                const double by_by_rotation_scale = chosen * by_by_rotation_t_over_norm_s;
                const double by_by_v3 = rotation_g1 * by_by_rotation_scale + rotation_scale * by_by_rotation_g1;
                const double by_by_v4 = rotation_g2 * by_by_rotation_scale + rotation_scale * by_by_rotation_g2;
                const double by_by_v5 = rotation_g3 * by_by_rotation_scale + rotation_scale * by_by_rotation_g3;
                const double by_by_rotation_log_det_series = rotation_log_det_series_slope * near_chosen_3;
                const double by_rotation_log_det_series_slope = by_rotation_log_det_series * near_chosen_3;
                const double rotation_log_det_series_slope_slope =
                    polynomial_rotation_log_det_series_slope_slope(near_chosen);
                const double gap_9 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - W0_3 * by_by_v3;
                const double gap_10 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - W1_3 * by_by_v3;
                const double gap_11 = -(W2_0 * by_by_v0) - W2_1 * by_by_v1 - W2_2 * by_by_v2 - W2_3 * by_by_v3;
                const double gap_12 = -(W3_0 * by_by_v0) - W3_1 * by_by_v1 - W3_2 * by_by_v2 - W3_3 * by_by_v3;
                const double gap_13 = -(W4_0 * by_by_v0) - W4_1 * by_by_v1 - W4_2 * by_by_v2 - W4_3 * by_by_v3;
                const double gap_14 = -(W5_0 * by_by_v0) - W5_1 * by_by_v1 - W5_2 * by_by_v2 - W5_3 * by_by_v3;
                const double by_rotation_log_det = exp_2 * (amplitude_k * by_phi);
                const double by_z5 = gap_14 - W5_4 * by_by_v4 - W5_5 * by_by_v5 - z5 * by_rotation_log_det;
                const double by_z4 = gap_13 - W4_4 * by_by_v4 - W4_5 * by_by_v5 - z4 * by_rotation_log_det;
                const double by_z3 = gap_12 - W3_4 * by_by_v4 - W3_5 * by_by_v5 - z3 * by_rotation_log_det;
                const double by_z2 = gap_11 - W2_4 * by_by_v4 - W2_5 * by_by_v5 - z2 * by_rotation_log_det;
                const double by_z1 = gap_10 - W1_4 * by_by_v4 - W1_5 * by_by_v5 - z1 * by_rotation_log_det;
                const double by_z0 = gap_9 - W0_4 * by_by_v4 - W0_5 * by_by_v5 - z0 * by_rotation_log_det;
                const double total_12 = W5_5 * by_z5 + W4_5 * by_z4 + W3_5 * by_z3 + W2_5 * by_z2 + W1_5 * by_z1;
                const double total_13 = W5_4 * by_z5 + W4_4 * by_z4 + W3_4 * by_z3 + W2_4 * by_z2 + W1_4 * by_z1;
                const double total_14 = W5_3 * by_z5 + W4_3 * by_z4 + W3_3 * by_z3 + W2_3 * by_z2 + W1_3 * by_z1;
                const double total_15 = W5_2 * by_z5 + W4_2 * by_z4 + W3_2 * by_z3 + W2_2 * by_z2 + W1_2 * by_z1;
                const double total_16 = W5_1 * by_z5 + W4_1 * by_z4 + W3_1 * by_z3 + W2_1 * by_z2 + W1_1 * by_z1;
                const double total_17 = W5_0 * by_z5 + W4_0 * by_z4 + W3_0 * by_z3 + W2_0 * by_z2 + W1_0 * by_z1;
                const double by_v5_2 = total_12 + W0_5 * by_z0;
                const double by_v4_2 = total_13 + W0_4 * by_z0;
                const double by_v3_2 = total_14 + W0_3 * by_z0;
                const double by_v2_2 = total_15 + W0_2 * by_z0;
                const double by_v1_2 = total_16 + W0_1 * by_z0;
                const double by_v0_2 = total_17 + W0_0 * by_z0;
                const double by_rotation_log_det_near_2 = (near ? by_rotation_log_det : 0.0);
                const double product_6 = 0.5 * (2.0 * (near ? 0.0 : by_rotation_log_det) / product - ratio * (0.5 *
                    ratio_4 / product));
                const double by_rotation_log_det_series_2 = by_rotation_log_det_near * by_by_rotation_norm_s_squared +
                    rotation_norm_s_squared * by_rotation_log_det_near_2;
                const double total_18 = by_v3 * by_by_rotation_g1 + by_v4 * by_by_rotation_g2 + by_v5 * by_by_rotation_g3
                    + rotation_g3 * by_v5_2 + rotation_g2 * by_v4_2;
                const double by_rotation_scale_2 = total_18 + rotation_g1 * by_v3_2;
                const double by_rotation_t_over_norm_s_2 = chosen * by_rotation_scale_2;
                const double by_rotation_t_over_norm_s_near_2 = (near ? by_rotation_t_over_norm_s_2 : 0.0);
                const double by_rotation_t_2 = (product_6 - by_rotation_t * by_by_rotation_norm_s + (near ? 0.0 :
                    by_rotation_t_over_norm_s_2)) / rotation_norm_s;
                const double gap_15 = ratio_2 * gap_7 - 2.0 * (ratio_3 * by_by_rotation_norm_s) - by_rotation_t * ratio_4
                    - rotation_t_ratio * by_rotation_t_2;
                const double by_rotation_atan2_norm_s_abs_g0_2 = 2.0 * by_rotation_t_2;
                const double ratio_5 = by_rotation_atan2_norm_s_abs_g0_2 / total_9;
                const double product_7 = rotation_norm_s * ratio_5;
                const double by_rotation_norm_s_2 = gap_15 + rotation_abs_g0 * ratio_5;
                const double by_rotation_abs_g0_2 = gap_8 - product_7;
                const double near_chosen_4 = (near ? by_rotation_t_over_norm_s_near_slope *
                    rotation_t_over_norm_s_near_slope_slope + by_rotation_log_det_series_slope *
                    rotation_log_det_series_slope_slope + rotation_log_det_series_slope * by_rotation_log_det_series_2 +
                    rotation_t_over_norm_s_near_slope * by_rotation_t_over_norm_s_near_2 : 0.0);
                const double by_rotation_norm_s_squared_2 = by_rotation_log_det_near * by_by_rotation_log_det_series +
                    rotation_log_det_series * by_rotation_log_det_near_2 + (near ? 0.0 : by_rotation_norm_s_2 / product_3
                    - product_5) + 4.011440628672975 * near_chosen_4;
                const double by_rotation_g0_2 = (is_small ? product_7 - gap_8 : by_rotation_abs_g0_2);
                const double product_8 = 2.0 * by_rotation_norm_s_squared_2;
                const double by_rotation_g3_2 = product_4 * by_by_rotation_g3 + by_v5 * by_by_rotation_scale +
                    rotation_scale * by_v5_2 + rotation_g3 * product_8;
                const double by_rotation_g2_2 = product_4 * by_by_rotation_g2 + by_v4 * by_by_rotation_scale +
                    rotation_scale * by_v4_2 + rotation_g2 * product_8;
                const double by_rotation_g1_2 = product_4 * by_by_rotation_g1 + by_v3 * by_by_rotation_scale +
                    rotation_scale * by_v3_2 + rotation_g1 * product_8;
                const double gap_16 = by_rotation_g0 * by_exponent_by_x6 + by_rotation_g1 * by_exponent_by_x5 -
                    by_rotation_g2 * by_exponent_by_x4 - by_rotation_g3 * by_exponent_by_x3 - x_block[3][lane] *
                    by_rotation_g3_2;
                const double gap_17 = by_rotation_g0 * by_exponent_by_x4 - by_rotation_g1 * by_exponent_by_x3 +
                    by_rotation_g2 * by_exponent_by_x6 - by_rotation_g3 * by_exponent_by_x5 - x_block[5][lane] *
                    by_rotation_g3_2;
                const double total_19 = by_rotation_g0 * by_exponent_by_x5 - by_rotation_g1 * by_exponent_by_x6 -
                    by_rotation_g2 * by_exponent_by_x3 + by_rotation_g3 * by_exponent_by_x4 + x_block[4][lane] *
                    by_rotation_g3_2;
                const double total_20 = by_rotation_g0 * by_exponent_by_x3 + by_rotation_g1 * by_exponent_by_x4 +
                    by_rotation_g2 * by_exponent_by_x5 + by_rotation_g3 * by_exponent_by_x6 + x_block[6][lane] *
                    by_rotation_g3_2;
                sum[0][lane] += -by_v0_2;
                sum[1][lane] += -by_v1_2;
                sum[2][lane] += -by_v2_2;
                sum[3][lane] += total_20 + x_block[5][lane] * by_rotation_g2_2 + x_block[4][lane] * by_rotation_g1_2 + x_block[3][lane] * by_rotation_g0_2;
                sum[4][lane] += gap_17 + x_block[6][lane] * by_rotation_g2_2 - x_block[3][lane] * by_rotation_g1_2 + x_block[4][lane] * by_rotation_g0_2;
                sum[5][lane] += total_19 - x_block[3][lane] * by_rotation_g2_2 - x_block[6][lane] * by_rotation_g1_2 + x_block[5][lane] * by_rotation_g0_2;
                sum[6][lane] += gap_16 - x_block[4][lane] * by_rotation_g2_2 + x_block[5][lane] * by_rotation_g1_2 + x_block[6][lane] * by_rotation_g0_2;
                sum[7][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[8][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[9][lane] += v2 * by_z0 - z0 * by_by_v2;
                sum[10][lane] += v3 * by_z0 - z0 * by_by_v3;
                sum[11][lane] += v4 * by_z0 - z0 * by_by_v4;
                sum[12][lane] += v5 * by_z0 - z0 * by_by_v5;
                sum[13][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[14][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[15][lane] += v2 * by_z1 - z1 * by_by_v2;
                sum[16][lane] += v3 * by_z1 - z1 * by_by_v3;
                sum[17][lane] += v4 * by_z1 - z1 * by_by_v4;
                sum[18][lane] += v5 * by_z1 - z1 * by_by_v5;
                sum[19][lane] += v0 * by_z2 - z2 * by_by_v0;
                sum[20][lane] += v1 * by_z2 - z2 * by_by_v1;
                sum[21][lane] += v2 * by_z2 - z2 * by_by_v2;
                sum[22][lane] += v3 * by_z2 - z2 * by_by_v3;
                sum[23][lane] += v4 * by_z2 - z2 * by_by_v4;
                sum[24][lane] += v5 * by_z2 - z2 * by_by_v5;
                sum[25][lane] += v0 * by_z3 - z3 * by_by_v0;
                sum[26][lane] += v1 * by_z3 - z3 * by_by_v1;
                sum[27][lane] += v2 * by_z3 - z3 * by_by_v2;
                sum[28][lane] += v3 * by_z3 - z3 * by_by_v3;
                sum[29][lane] += v4 * by_z3 - z3 * by_by_v4;
                sum[30][lane] += v5 * by_z3 - z3 * by_by_v5;
                sum[31][lane] += v0 * by_z4 - z4 * by_by_v0;
                sum[32][lane] += v1 * by_z4 - z4 * by_by_v1;
                sum[33][lane] += v2 * by_z4 - z4 * by_by_v2;
                sum[34][lane] += v3 * by_z4 - z4 * by_by_v3;
                sum[35][lane] += v4 * by_z4 - z4 * by_by_v4;
                sum[36][lane] += v5 * by_z4 - z4 * by_by_v5;
                sum[37][lane] += v0 * by_z5 - z5 * by_by_v0;
                sum[38][lane] += v1 * by_z5 - z5 * by_by_v1;
                sum[39][lane] += v2 * by_z5 - z5 * by_by_v2;
                sum[40][lane] += v3 * by_z5 - z5 * by_by_v3;
                sum[41][lane] += v4 * by_z5 - z5 * by_by_v4;
                sum[42][lane] += v5 * by_z5 - z5 * by_by_v5;
                sum[43][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 44; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[7 * k + 0] += total[0];
            mu_bar[7 * k + 1] += total[1];
            mu_bar[7 * k + 2] += total[2];
            mu_bar[7 * k + 3] += total[3];
            mu_bar[7 * k + 4] += total[4];
            mu_bar[7 * k + 5] += total[5];
            mu_bar[7 * k + 6] += total[6];
            W_bar[36 * k + 0] += total[7];
            W_bar[36 * k + 1] += total[8];
            W_bar[36 * k + 2] += total[9];
            W_bar[36 * k + 3] += total[10];
            W_bar[36 * k + 4] += total[11];
            W_bar[36 * k + 5] += total[12];
            W_bar[36 * k + 6] += total[13];
            W_bar[36 * k + 7] += total[14];
            W_bar[36 * k + 8] += total[15];
            W_bar[36 * k + 9] += total[16];
            W_bar[36 * k + 10] += total[17];
            W_bar[36 * k + 11] += total[18];
            W_bar[36 * k + 12] += total[19];
            W_bar[36 * k + 13] += total[20];
            W_bar[36 * k + 14] += total[21];
            W_bar[36 * k + 15] += total[22];
            W_bar[36 * k + 16] += total[23];
            W_bar[36 * k + 17] += total[24];
            W_bar[36 * k + 18] += total[25];
            W_bar[36 * k + 19] += total[26];
            W_bar[36 * k + 20] += total[27];
            W_bar[36 * k + 21] += total[28];
            W_bar[36 * k + 22] += total[29];
            W_bar[36 * k + 23] += total[30];
            W_bar[36 * k + 24] += total[31];
            W_bar[36 * k + 25] += total[32];
            W_bar[36 * k + 26] += total[33];
            W_bar[36 * k + 27] += total[34];
            W_bar[36 * k + 28] += total[35];
            W_bar[36 * k + 29] += total[36];
            W_bar[36 * k + 30] += total[37];
            W_bar[36 * k + 31] += total[38];
            W_bar[36 * k + 32] += total[39];
            W_bar[36 * k + 33] += total[40];
            W_bar[36 * k + 34] += total[41];
            W_bar[36 * k + 35] += total[42];
            amplitude_bar[1 * k + 0] += total[43];
        }
    }
    restore_denormals(mode);
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

/* Of degree 8, within 2^-30 of that of double precision. */
static inline float polynomial_rotation_t_over_norm_s_near_slope_slope_f(float x) {
    return 0.01864320252205291f + x * (0.008299119649304472f + x * (0.0028160002314375336f + x *
        (0.0008610440047704579f + x * (0.0002522458975272004f + x * (6.363291448779077e-05f + x *
        (2.9672627598761578e-05f + x * (-3.950664599532621e-06f + x * 5.308935243478486e-06f)))))));
}

/* Of degree 8, within 2^-29 of that of double precision. */
static inline float polynomial_rotation_log_det_series_slope_slope_f(float x) {
    return 0.008373548929811502f + x * (0.00409341251393332f + x * (0.0014659690505062421f + x *
        (0.0004642399977336899f + x * (0.00013949898494014724f + x * (3.562723292198236e-05f + x *
        (1.715338253936205e-05f + x * (-2.4083903642194996e-06f + x * 3.123850968155648e-06f)))))));
}

void se3_splats_f(
    size_t count,
    size_t splat_count,
    const float *SE3_RESTRICT x,
    const float *SE3_RESTRICT mu,
    const float *SE3_RESTRICT W,
    const float *SE3_RESTRICT amplitude,
    float *SE3_RESTRICT value,
    float *SE3_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[7][LANES], sum[7][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 7; ++i) x_block[i][lane] = x[7 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const float mu0 = mu[7 * k + 0];
            const float mu1 = mu[7 * k + 1];
            const float mu2 = mu[7 * k + 2];
            const float mu3 = mu[7 * k + 3];
            const float mu4 = mu[7 * k + 4];
            const float mu5 = mu[7 * k + 5];
            const float mu6 = mu[7 * k + 6];
            const float W0_0 = W[36 * k + 0];
            const float W0_1 = W[36 * k + 1];
            const float W0_2 = W[36 * k + 2];
            const float W0_3 = W[36 * k + 3];
            const float W0_4 = W[36 * k + 4];
            const float W0_5 = W[36 * k + 5];
            const float W1_0 = W[36 * k + 6];
            const float W1_1 = W[36 * k + 7];
            const float W1_2 = W[36 * k + 8];
            const float W1_3 = W[36 * k + 9];
            const float W1_4 = W[36 * k + 10];
            const float W1_5 = W[36 * k + 11];
            const float W2_0 = W[36 * k + 12];
            const float W2_1 = W[36 * k + 13];
            const float W2_2 = W[36 * k + 14];
            const float W2_3 = W[36 * k + 15];
            const float W2_4 = W[36 * k + 16];
            const float W2_5 = W[36 * k + 17];
            const float W3_0 = W[36 * k + 18];
            const float W3_1 = W[36 * k + 19];
            const float W3_2 = W[36 * k + 20];
            const float W3_3 = W[36 * k + 21];
            const float W3_4 = W[36 * k + 22];
            const float W3_5 = W[36 * k + 23];
            const float W4_0 = W[36 * k + 24];
            const float W4_1 = W[36 * k + 25];
            const float W4_2 = W[36 * k + 26];
            const float W4_3 = W[36 * k + 27];
            const float W4_4 = W[36 * k + 28];
            const float W4_5 = W[36 * k + 29];
            const float W5_0 = W[36 * k + 30];
            const float W5_1 = W[36 * k + 31];
            const float W5_2 = W[36 * k + 32];
            const float W5_3 = W[36 * k + 33];
            const float W5_4 = W[36 * k + 34];
            const float W5_5 = W[36 * k + 35];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float rotation_g0 = x_block[3][lane] * mu3 + x_block[4][lane] * mu4 + x_block[5][lane] * mu5 +
                    x_block[6][lane] * mu6;
                const float rotation_g1 = x_block[4][lane] * mu3 + x_block[5][lane] * mu6 - x_block[3][lane] * mu4 -
                    x_block[6][lane] * mu5;
                const float rotation_g2 = x_block[5][lane] * mu3 + x_block[6][lane] * mu4 - x_block[3][lane] * mu5 -
                    x_block[4][lane] * mu6;
                const float rotation_g3 = x_block[6][lane] * mu3 + x_block[4][lane] * mu5 - x_block[5][lane] * mu4 -
                    x_block[3][lane] * mu6;
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
                const float v0 = x_block[0][lane] - mu0;
                const float v1 = x_block[1][lane] - mu1;
                const float v2 = x_block[2][lane] - mu2;
                const float v3 = rotation_g1 * rotation_scale;
                const float v4 = rotation_g2 * rotation_scale;
                const float v5 = rotation_g3 * rotation_scale;
                const float rotation_log_det_series = polynomial_rotation_log_det_series_f(near_chosen);
                const float rotation_log_det_near = rotation_norm_s_squared * rotation_log_det_series;
                const float product = 0.5f * rotation_t_ratio;
                const float rotation_log_det = (near ? rotation_log_det_near : 2.0f * logf(product));
                const float total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
                const float z0 = total_2 + W0_5 * v5;
                const float total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
                const float z1 = total_3 + W1_5 * v5;
                const float total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
                const float z2 = total_4 + W2_5 * v5;
                const float total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
                const float z3 = total_5 + W3_5 * v5;
                const float total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
                const float z4 = total_6 + W4_5 * v5;
                const float total_7 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
                const float z5 = total_7 + W5_5 * v5;
                const float total_8 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
                const float exp_2 = expf(rotation_log_det - 0.5f * (total_8 + z5 * z5));
                const float phi = amplitude_k * exp_2;
                const float gap = -(W5_5 * z5) - W4_5 * z4 - W3_5 * z3 - W2_5 * z2;
                const float gap_2 = -(W5_4 * z5) - W4_4 * z4 - W3_4 * z3 - W2_4 * z2;
                const float gap_3 = -(W5_3 * z5) - W4_3 * z4 - W3_3 * z3 - W2_3 * z2;
                const float gap_4 = -(W5_2 * z5) - W4_2 * z4 - W3_2 * z3 - W2_2 * z2;
                const float gap_5 = -(W5_1 * z5) - W4_1 * z4 - W3_1 * z3 - W2_1 * z2;
                const float gap_6 = -(W5_0 * z5) - W4_0 * z4 - W3_0 * z3 - W2_0 * z2;
                const float by_v5 = gap - W1_5 * z1 - W0_5 * z0;
                const float by_v4 = gap_2 - W1_4 * z1 - W0_4 * z0;
                const float by_v3 = gap_3 - W1_3 * z1 - W0_3 * z0;
                const float by_v2 = gap_4 - W1_2 * z1 - W0_2 * z0;
                const float by_v1 = gap_5 - W1_1 * z1 - W0_1 * z0;
                const float by_v0 = gap_6 - W1_0 * z1 - W0_0 * z0;
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
                const float exponent_by_x6 = mu3 * by_rotation_g3 + mu4 * by_rotation_g2 - mu5 * by_rotation_g1 + mu6 *
                    by_rotation_g0;
                const float exponent_by_x5 = mu3 * by_rotation_g2 - mu4 * by_rotation_g3 + mu6 * by_rotation_g1 + mu5 *
                    by_rotation_g0;
                const float exponent_by_x4 = mu5 * by_rotation_g3 - mu6 * by_rotation_g2 + mu3 * by_rotation_g1 + mu4 *
                    by_rotation_g0;
                const float exponent_by_x3 = -(mu6 * by_rotation_g3) - mu5 * by_rotation_g2 - mu4 * by_rotation_g1 + mu3 *
                    by_rotation_g0;
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
                const float gradient3 = x_block[3][lane] * df4_product + x_block[6][lane] * df5_product - x_block[4][lane]
                    * df3_product - x_block[5][lane] * df6_product;
                const float gradient4 = x_block[3][lane] * df5_product + x_block[4][lane] * df6_product - x_block[5][lane]
                    * df3_product - x_block[6][lane] * df4_product;
                const float gradient5 = x_block[5][lane] * df4_product + x_block[3][lane] * df6_product - x_block[6][lane]
                    * df3_product - x_block[4][lane] * df5_product;
                sum[0][lane] += phi;
                sum[1][lane] += df0;
                sum[2][lane] += df1;
                sum[3][lane] += df2;
                sum[4][lane] += gradient3;
                sum[5][lane] += gradient4;
                sum[6][lane] += gradient5;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 6; ++i) gradient[6 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void se3_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *SE3_RESTRICT x,
    const float *SE3_RESTRICT mu,
    const float *SE3_RESTRICT W,
    const float *SE3_RESTRICT amplitude,
    const float *SE3_RESTRICT value_bar,
    const float *SE3_RESTRICT gradient_bar,
    float *SE3_RESTRICT mu_bar,
    float *SE3_RESTRICT W_bar,
    float *SE3_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 7 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 36 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[7][LANES], value_bar_block[1][LANES], gradient_bar_block[6][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const float weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 7; ++i) x_block[i][lane] = x[7 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 6; ++i) gradient_bar_block[i][lane] = gradient_bar[6 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 6; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            float sum[44][LANES] = {{0}}, total[44] = {0};
            const float mu0 = mu[7 * k + 0];
            const float mu1 = mu[7 * k + 1];
            const float mu2 = mu[7 * k + 2];
            const float mu3 = mu[7 * k + 3];
            const float mu4 = mu[7 * k + 4];
            const float mu5 = mu[7 * k + 5];
            const float mu6 = mu[7 * k + 6];
            const float W0_0 = W[36 * k + 0];
            const float W0_1 = W[36 * k + 1];
            const float W0_2 = W[36 * k + 2];
            const float W0_3 = W[36 * k + 3];
            const float W0_4 = W[36 * k + 4];
            const float W0_5 = W[36 * k + 5];
            const float W1_0 = W[36 * k + 6];
            const float W1_1 = W[36 * k + 7];
            const float W1_2 = W[36 * k + 8];
            const float W1_3 = W[36 * k + 9];
            const float W1_4 = W[36 * k + 10];
            const float W1_5 = W[36 * k + 11];
            const float W2_0 = W[36 * k + 12];
            const float W2_1 = W[36 * k + 13];
            const float W2_2 = W[36 * k + 14];
            const float W2_3 = W[36 * k + 15];
            const float W2_4 = W[36 * k + 16];
            const float W2_5 = W[36 * k + 17];
            const float W3_0 = W[36 * k + 18];
            const float W3_1 = W[36 * k + 19];
            const float W3_2 = W[36 * k + 20];
            const float W3_3 = W[36 * k + 21];
            const float W3_4 = W[36 * k + 22];
            const float W3_5 = W[36 * k + 23];
            const float W4_0 = W[36 * k + 24];
            const float W4_1 = W[36 * k + 25];
            const float W4_2 = W[36 * k + 26];
            const float W4_3 = W[36 * k + 27];
            const float W4_4 = W[36 * k + 28];
            const float W4_5 = W[36 * k + 29];
            const float W5_0 = W[36 * k + 30];
            const float W5_1 = W[36 * k + 31];
            const float W5_2 = W[36 * k + 32];
            const float W5_3 = W[36 * k + 33];
            const float W5_4 = W[36 * k + 34];
            const float W5_5 = W[36 * k + 35];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float rotation_g0 = x_block[3][lane] * mu3 + x_block[4][lane] * mu4 + x_block[5][lane] * mu5 +
                    x_block[6][lane] * mu6;
                const float rotation_g1 = x_block[4][lane] * mu3 + x_block[5][lane] * mu6 - x_block[3][lane] * mu4 -
                    x_block[6][lane] * mu5;
                const float rotation_g2 = x_block[5][lane] * mu3 + x_block[6][lane] * mu4 - x_block[3][lane] * mu5 -
                    x_block[4][lane] * mu6;
                const float rotation_g3 = x_block[6][lane] * mu3 + x_block[4][lane] * mu5 - x_block[5][lane] * mu4 -
                    x_block[3][lane] * mu6;
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
                const float v0 = x_block[0][lane] - mu0;
                const float v1 = x_block[1][lane] - mu1;
                const float v2 = x_block[2][lane] - mu2;
                const float v3 = rotation_g1 * rotation_scale;
                const float v4 = rotation_g2 * rotation_scale;
                const float v5 = rotation_g3 * rotation_scale;
                const float rotation_log_det_series = polynomial_rotation_log_det_series_f(near_chosen);
                const float rotation_log_det_near = rotation_norm_s_squared * rotation_log_det_series;
                const float product = 0.5f * rotation_t_ratio;
                const float rotation_log_det = (near ? rotation_log_det_near : 2.0f * logf(product));
                const float total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
                const float z0 = total_2 + W0_5 * v5;
                const float total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
                const float z1 = total_3 + W1_5 * v5;
                const float total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
                const float z2 = total_4 + W2_5 * v5;
                const float total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
                const float z3 = total_5 + W3_5 * v5;
                const float total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
                const float z4 = total_6 + W4_5 * v5;
                const float total_7 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
                const float z5 = total_7 + W5_5 * v5;
                const float total_8 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
                const float exp_2 = expf(rotation_log_det - 0.5f * (total_8 + z5 * z5));
                const float phi = amplitude_k * exp_2;
                const float gap = -(W5_5 * z5) - W4_5 * z4 - W3_5 * z3 - W2_5 * z2;
                const float gap_2 = -(W5_4 * z5) - W4_4 * z4 - W3_4 * z3 - W2_4 * z2;
                const float gap_3 = -(W5_3 * z5) - W4_3 * z4 - W3_3 * z3 - W2_3 * z2;
                const float gap_4 = -(W5_2 * z5) - W4_2 * z4 - W3_2 * z3 - W2_2 * z2;
                const float gap_5 = -(W5_1 * z5) - W4_1 * z4 - W3_1 * z3 - W2_1 * z2;
                const float gap_6 = -(W5_0 * z5) - W4_0 * z4 - W3_0 * z3 - W2_0 * z2;
                const float by_v5 = gap - W1_5 * z1 - W0_5 * z0;
                const float by_v4 = gap_2 - W1_4 * z1 - W0_4 * z0;
                const float by_v3 = gap_3 - W1_3 * z1 - W0_3 * z0;
                const float by_v2 = gap_4 - W1_2 * z1 - W0_2 * z0;
                const float by_v1 = gap_5 - W1_1 * z1 - W0_1 * z0;
                const float by_v0 = gap_6 - W1_0 * z1 - W0_0 * z0;
                const float by_rotation_log_det_near = (near ? 1.0f : 0.0f);
                const float ratio = 2.0f * (near ? 0.0f : 1.0f) / product;
                const float by_rotation_log_det_series = rotation_norm_s_squared * by_rotation_log_det_near;
                const float rotation_log_det_series_slope = polynomial_rotation_log_det_series_slope_f(near_chosen);
                const float by_rotation_scale = rotation_g3 * by_v5 + rotation_g2 * by_v4 + rotation_g1 * by_v3;
                const float by_rotation_t_over_norm_s = chosen * by_rotation_scale;
                const float by_rotation_t_over_norm_s_near = (near ? by_rotation_t_over_norm_s : 0.0f);
                const float by_rotation_t = (0.5f * ratio + (near ? 0.0f : by_rotation_t_over_norm_s)) / rotation_norm_s;
                const float by_rotation_atan2_norm_s_abs_g0 = 2.0f * by_rotation_t;
                const float total_9 = near_chosen_2 + rotation_abs_g0 * rotation_abs_g0;
                const float ratio_2 = by_rotation_atan2_norm_s_abs_g0 / total_9;
                const float product_2 = rotation_norm_s * ratio_2;
                const float by_rotation_abs_g0 = -product_2;
                const float by_rotation_norm_s = rotation_abs_g0 * ratio_2 - rotation_t_ratio * by_rotation_t;
                const float product_3 = 2.0f * rotation_norm_s;
                const float ratio_3 = by_rotation_norm_s / product_3;
                const float rotation_t_over_norm_s_near_slope =
                    polynomial_rotation_t_over_norm_s_near_slope_f(near_chosen);
                const float by_rotation_norm_s_squared = rotation_log_det_series * by_rotation_log_det_near + (near ? 0.0f
                    : ratio_3) + 4.011440628672975f * (near ? by_rotation_log_det_series * rotation_log_det_series_slope +
                    by_rotation_t_over_norm_s_near * rotation_t_over_norm_s_near_slope : 0.0f);
                const float by_rotation_g0 = (is_small ? product_2 : by_rotation_abs_g0);
                const float product_4 = 2.0f * by_rotation_norm_s_squared;
                const float by_rotation_g3 = rotation_scale * by_v5 + rotation_g3 * product_4;
                const float by_rotation_g2 = rotation_scale * by_v4 + rotation_g2 * product_4;
                const float by_rotation_g1 = rotation_scale * by_v3 + rotation_g1 * product_4;
                const float exponent_by_x6 = mu3 * by_rotation_g3 + mu4 * by_rotation_g2 - mu5 * by_rotation_g1 + mu6 *
                    by_rotation_g0;
                const float exponent_by_x5 = mu3 * by_rotation_g2 - mu4 * by_rotation_g3 + mu6 * by_rotation_g1 + mu5 *
                    by_rotation_g0;
                const float exponent_by_x4 = mu5 * by_rotation_g3 - mu6 * by_rotation_g2 + mu3 * by_rotation_g1 + mu4 *
                    by_rotation_g0;
                const float exponent_by_x3 = -(mu6 * by_rotation_g3) - mu5 * by_rotation_g2 - mu4 * by_rotation_g1 + mu3 *
                    by_rotation_g0;
                const float by_df6 = 0.5f * (x_block[3][lane] * gradient_bar_block[5][lane] + x_block[4][lane] *
                    gradient_bar_block[4][lane] - x_block[5][lane] * gradient_bar_block[3][lane]);
                const float by_df3 = 0.5f * (-(x_block[6][lane] * gradient_bar_block[5][lane]) - x_block[5][lane] *
                    gradient_bar_block[4][lane] - x_block[4][lane] * gradient_bar_block[3][lane]);
                const float by_df5 = 0.5f * (x_block[3][lane] * gradient_bar_block[4][lane] - x_block[4][lane] *
                    gradient_bar_block[5][lane] + x_block[6][lane] * gradient_bar_block[3][lane]);
                const float by_df4 = 0.5f * (x_block[5][lane] * gradient_bar_block[5][lane] - x_block[6][lane] *
                    gradient_bar_block[4][lane] + x_block[3][lane] * gradient_bar_block[3][lane]);
                const float by_exponent_by_x6 = phi * by_df6;
                const float by_exponent_by_x5 = phi * by_df5;
                const float by_exponent_by_x4 = phi * by_df4;
                const float by_exponent_by_x3 = phi * by_df3;
                const float total_10 = value_bar_block[0][lane] + exponent_by_x6 * by_df6 + exponent_by_x5 * by_df5 +
                    exponent_by_x4 * by_df4 + exponent_by_x3 * by_df3;
                const float by_by_v2 = phi * gradient_bar_block[2][lane];
                const float by_by_v1 = phi * gradient_bar_block[1][lane];
                const float by_by_v0 = phi * gradient_bar_block[0][lane];
                const float by_phi = total_10 + by_v2 * gradient_bar_block[2][lane] + by_v1 * gradient_bar_block[1][lane]
                    + by_v0 * gradient_bar_block[0][lane];
                const float by_by_rotation_g0 = mu3 * by_exponent_by_x3 + mu4 * by_exponent_by_x4 + mu5 *
                    by_exponent_by_x5 + mu6 * by_exponent_by_x6;
                const float by_by_rotation_g1 = mu3 * by_exponent_by_x4 + mu6 * by_exponent_by_x5 - mu4 *
                    by_exponent_by_x3 - mu5 * by_exponent_by_x6;
                const float by_by_rotation_g2 = mu3 * by_exponent_by_x5 + mu4 * by_exponent_by_x6 - mu5 *
                    by_exponent_by_x3 - mu6 * by_exponent_by_x4;
                const float by_by_rotation_g3 = mu3 * by_exponent_by_x6 + mu5 * by_exponent_by_x4 - mu4 *
                    by_exponent_by_x5 - mu6 * by_exponent_by_x3;
                const float total_11 = rotation_g1 * by_by_rotation_g1 + rotation_g2 * by_by_rotation_g2 + rotation_g3 *
                    by_by_rotation_g3;
                const float by_by_rotation_norm_s_squared = 2.0f * total_11;
                const float by_by_rotation_abs_g0 = (is_small ? 0.0f : by_by_rotation_g0);
                const float near_chosen_3 = (near ? 8.02288125734595f * total_11 : 0.0f);
                const float by_by_rotation_t_over_norm_s_near = rotation_t_over_norm_s_near_slope * near_chosen_3;
                const float by_rotation_t_over_norm_s_near_slope = by_rotation_t_over_norm_s_near * near_chosen_3;
                const float rotation_t_over_norm_s_near_slope_slope =
                    polynomial_rotation_t_over_norm_s_near_slope_slope_f(near_chosen);
                const float by_by_rotation_norm_s = (near ? 0.0f : by_by_rotation_norm_s_squared) / product_3;
                const float gap_7 = (is_small ? by_by_rotation_g0 : 0.0f) - by_by_rotation_abs_g0;
                const float by_by_rotation_atan2_norm_s_abs_g0 = (rotation_norm_s * gap_7 + rotation_abs_g0 *
                    by_by_rotation_norm_s) / total_9;
                const float product_5 = ratio_2 * by_by_rotation_atan2_norm_s_abs_g0;
                const float gap_8 = ratio_2 * by_by_rotation_norm_s - rotation_abs_g0 * (2.0f * product_5);
                const float by_by_rotation_t = 2.0f * by_by_rotation_atan2_norm_s_abs_g0 - rotation_t_ratio *
                    by_by_rotation_norm_s;
                const float ratio_4 = by_by_rotation_t / rotation_norm_s;
                const float by_by_rotation_t_over_norm_s = (near ? 0.0f : ratio_4) + (near ?
                    by_by_rotation_t_over_norm_s_near : 0.0f);
                const float by_by_rotation_scale = chosen * by_by_rotation_t_over_norm_s;
                const float by_by_v3 = rotation_g1 * by_by_rotation_scale + rotation_scale * by_by_rotation_g1;
                const float by_by_v4 = rotation_g2 * by_by_rotation_scale + rotation_scale * by_by_rotation_g2;
                const float by_by_v5 = rotation_g3 * by_by_rotation_scale + rotation_scale * by_by_rotation_g3;
                const float by_by_rotation_log_det_series = rotation_log_det_series_slope * near_chosen_3;
                const float by_rotation_log_det_series_slope = by_rotation_log_det_series * near_chosen_3;
                const float rotation_log_det_series_slope_slope =
                    polynomial_rotation_log_det_series_slope_slope_f(near_chosen);
                const float gap_9 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - W0_3 * by_by_v3;
                const float gap_10 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - W1_3 * by_by_v3;
                const float gap_11 = -(W2_0 * by_by_v0) - W2_1 * by_by_v1 - W2_2 * by_by_v2 - W2_3 * by_by_v3;
                const float gap_12 = -(W3_0 * by_by_v0) - W3_1 * by_by_v1 - W3_2 * by_by_v2 - W3_3 * by_by_v3;
                const float gap_13 = -(W4_0 * by_by_v0) - W4_1 * by_by_v1 - W4_2 * by_by_v2 - W4_3 * by_by_v3;
                const float gap_14 = -(W5_0 * by_by_v0) - W5_1 * by_by_v1 - W5_2 * by_by_v2 - W5_3 * by_by_v3;
                const float by_rotation_log_det = exp_2 * (amplitude_k * by_phi);
                const float by_z5 = gap_14 - W5_4 * by_by_v4 - W5_5 * by_by_v5 - z5 * by_rotation_log_det;
                const float by_z4 = gap_13 - W4_4 * by_by_v4 - W4_5 * by_by_v5 - z4 * by_rotation_log_det;
                const float by_z3 = gap_12 - W3_4 * by_by_v4 - W3_5 * by_by_v5 - z3 * by_rotation_log_det;
                const float by_z2 = gap_11 - W2_4 * by_by_v4 - W2_5 * by_by_v5 - z2 * by_rotation_log_det;
                const float by_z1 = gap_10 - W1_4 * by_by_v4 - W1_5 * by_by_v5 - z1 * by_rotation_log_det;
                const float by_z0 = gap_9 - W0_4 * by_by_v4 - W0_5 * by_by_v5 - z0 * by_rotation_log_det;
                const float total_12 = W5_5 * by_z5 + W4_5 * by_z4 + W3_5 * by_z3 + W2_5 * by_z2 + W1_5 * by_z1;
                const float total_13 = W5_4 * by_z5 + W4_4 * by_z4 + W3_4 * by_z3 + W2_4 * by_z2 + W1_4 * by_z1;
                const float total_14 = W5_3 * by_z5 + W4_3 * by_z4 + W3_3 * by_z3 + W2_3 * by_z2 + W1_3 * by_z1;
                const float total_15 = W5_2 * by_z5 + W4_2 * by_z4 + W3_2 * by_z3 + W2_2 * by_z2 + W1_2 * by_z1;
                const float total_16 = W5_1 * by_z5 + W4_1 * by_z4 + W3_1 * by_z3 + W2_1 * by_z2 + W1_1 * by_z1;
                const float total_17 = W5_0 * by_z5 + W4_0 * by_z4 + W3_0 * by_z3 + W2_0 * by_z2 + W1_0 * by_z1;
                const float by_v5_2 = total_12 + W0_5 * by_z0;
                const float by_v4_2 = total_13 + W0_4 * by_z0;
                const float by_v3_2 = total_14 + W0_3 * by_z0;
                const float by_v2_2 = total_15 + W0_2 * by_z0;
                const float by_v1_2 = total_16 + W0_1 * by_z0;
                const float by_v0_2 = total_17 + W0_0 * by_z0;
                const float by_rotation_log_det_near_2 = (near ? by_rotation_log_det : 0.0f);
                const float product_6 = 0.5f * (2.0f * (near ? 0.0f : by_rotation_log_det) / product - ratio * (0.5f *
                    ratio_4 / product));
                const float by_rotation_log_det_series_2 = by_rotation_log_det_near * by_by_rotation_norm_s_squared +
                    rotation_norm_s_squared * by_rotation_log_det_near_2;
                const float total_18 = by_v3 * by_by_rotation_g1 + by_v4 * by_by_rotation_g2 + by_v5 * by_by_rotation_g3 +
                    rotation_g3 * by_v5_2 + rotation_g2 * by_v4_2;
                const float by_rotation_scale_2 = total_18 + rotation_g1 * by_v3_2;
                const float by_rotation_t_over_norm_s_2 = chosen * by_rotation_scale_2;
                const float by_rotation_t_over_norm_s_near_2 = (near ? by_rotation_t_over_norm_s_2 : 0.0f);
                const float by_rotation_t_2 = (product_6 - by_rotation_t * by_by_rotation_norm_s + (near ? 0.0f :
                    by_rotation_t_over_norm_s_2)) / rotation_norm_s;
                const float gap_15 = ratio_2 * gap_7 - 2.0f * (ratio_3 * by_by_rotation_norm_s) - by_rotation_t * ratio_4
                    - rotation_t_ratio * by_rotation_t_2;
                const float by_rotation_atan2_norm_s_abs_g0_2 = 2.0f * by_rotation_t_2;
                const float ratio_5 = by_rotation_atan2_norm_s_abs_g0_2 / total_9;
                const float product_7 = rotation_norm_s * ratio_5;
                const float by_rotation_norm_s_2 = gap_15 + rotation_abs_g0 * ratio_5;
                const float by_rotation_abs_g0_2 = gap_8 - product_7;
                const float near_chosen_4 = (near ? by_rotation_t_over_norm_s_near_slope *
                    rotation_t_over_norm_s_near_slope_slope + by_rotation_log_det_series_slope *
                    rotation_log_det_series_slope_slope + rotation_log_det_series_slope * by_rotation_log_det_series_2 +
                    rotation_t_over_norm_s_near_slope * by_rotation_t_over_norm_s_near_2 : 0.0f);
                const float by_rotation_norm_s_squared_2 = by_rotation_log_det_near * by_by_rotation_log_det_series +
                    rotation_log_det_series * by_rotation_log_det_near_2 + (near ? 0.0f : by_rotation_norm_s_2 / product_3
                    - product_5) + 4.011440628672975f * near_chosen_4;
                const float by_rotation_g0_2 = (is_small ? product_7 - gap_8 : by_rotation_abs_g0_2);
                const float product_8 = 2.0f * by_rotation_norm_s_squared_2;
                const float by_rotation_g3_2 = product_4 * by_by_rotation_g3 + by_v5 * by_by_rotation_scale +
                    rotation_scale * by_v5_2 + rotation_g3 * product_8;
                const float by_rotation_g2_2 = product_4 * by_by_rotation_g2 + by_v4 * by_by_rotation_scale +
                    rotation_scale * by_v4_2 + rotation_g2 * product_8;
                const float by_rotation_g1_2 = product_4 * by_by_rotation_g1 + by_v3 * by_by_rotation_scale +
                    rotation_scale * by_v3_2 + rotation_g1 * product_8;
                const float gap_16 = by_rotation_g0 * by_exponent_by_x6 + by_rotation_g1 * by_exponent_by_x5 -
                    by_rotation_g2 * by_exponent_by_x4 - by_rotation_g3 * by_exponent_by_x3 - x_block[3][lane] *
                    by_rotation_g3_2;
                const float gap_17 = by_rotation_g0 * by_exponent_by_x4 - by_rotation_g1 * by_exponent_by_x3 +
                    by_rotation_g2 * by_exponent_by_x6 - by_rotation_g3 * by_exponent_by_x5 - x_block[5][lane] *
                    by_rotation_g3_2;
                const float total_19 = by_rotation_g0 * by_exponent_by_x5 - by_rotation_g1 * by_exponent_by_x6 -
                    by_rotation_g2 * by_exponent_by_x3 + by_rotation_g3 * by_exponent_by_x4 + x_block[4][lane] *
                    by_rotation_g3_2;
                const float total_20 = by_rotation_g0 * by_exponent_by_x3 + by_rotation_g1 * by_exponent_by_x4 +
                    by_rotation_g2 * by_exponent_by_x5 + by_rotation_g3 * by_exponent_by_x6 + x_block[6][lane] *
                    by_rotation_g3_2;
                sum[0][lane] += -by_v0_2;
                sum[1][lane] += -by_v1_2;
                sum[2][lane] += -by_v2_2;
                sum[3][lane] += total_20 + x_block[5][lane] * by_rotation_g2_2 + x_block[4][lane] * by_rotation_g1_2 + x_block[3][lane] * by_rotation_g0_2;
                sum[4][lane] += gap_17 + x_block[6][lane] * by_rotation_g2_2 - x_block[3][lane] * by_rotation_g1_2 + x_block[4][lane] * by_rotation_g0_2;
                sum[5][lane] += total_19 - x_block[3][lane] * by_rotation_g2_2 - x_block[6][lane] * by_rotation_g1_2 + x_block[5][lane] * by_rotation_g0_2;
                sum[6][lane] += gap_16 - x_block[4][lane] * by_rotation_g2_2 + x_block[5][lane] * by_rotation_g1_2 + x_block[6][lane] * by_rotation_g0_2;
                sum[7][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[8][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[9][lane] += v2 * by_z0 - z0 * by_by_v2;
                sum[10][lane] += v3 * by_z0 - z0 * by_by_v3;
                sum[11][lane] += v4 * by_z0 - z0 * by_by_v4;
                sum[12][lane] += v5 * by_z0 - z0 * by_by_v5;
                sum[13][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[14][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[15][lane] += v2 * by_z1 - z1 * by_by_v2;
                sum[16][lane] += v3 * by_z1 - z1 * by_by_v3;
                sum[17][lane] += v4 * by_z1 - z1 * by_by_v4;
                sum[18][lane] += v5 * by_z1 - z1 * by_by_v5;
                sum[19][lane] += v0 * by_z2 - z2 * by_by_v0;
                sum[20][lane] += v1 * by_z2 - z2 * by_by_v1;
                sum[21][lane] += v2 * by_z2 - z2 * by_by_v2;
                sum[22][lane] += v3 * by_z2 - z2 * by_by_v3;
                sum[23][lane] += v4 * by_z2 - z2 * by_by_v4;
                sum[24][lane] += v5 * by_z2 - z2 * by_by_v5;
                sum[25][lane] += v0 * by_z3 - z3 * by_by_v0;
                sum[26][lane] += v1 * by_z3 - z3 * by_by_v1;
                sum[27][lane] += v2 * by_z3 - z3 * by_by_v2;
                sum[28][lane] += v3 * by_z3 - z3 * by_by_v3;
                sum[29][lane] += v4 * by_z3 - z3 * by_by_v4;
                sum[30][lane] += v5 * by_z3 - z3 * by_by_v5;
                sum[31][lane] += v0 * by_z4 - z4 * by_by_v0;
                sum[32][lane] += v1 * by_z4 - z4 * by_by_v1;
                sum[33][lane] += v2 * by_z4 - z4 * by_by_v2;
                sum[34][lane] += v3 * by_z4 - z4 * by_by_v3;
                sum[35][lane] += v4 * by_z4 - z4 * by_by_v4;
                sum[36][lane] += v5 * by_z4 - z4 * by_by_v5;
                sum[37][lane] += v0 * by_z5 - z5 * by_by_v0;
                sum[38][lane] += v1 * by_z5 - z5 * by_by_v1;
                sum[39][lane] += v2 * by_z5 - z5 * by_by_v2;
                sum[40][lane] += v3 * by_z5 - z5 * by_by_v3;
                sum[41][lane] += v4 * by_z5 - z5 * by_by_v4;
                sum[42][lane] += v5 * by_z5 - z5 * by_by_v5;
                sum[43][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 44; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[7 * k + 0] += total[0];
            mu_bar[7 * k + 1] += total[1];
            mu_bar[7 * k + 2] += total[2];
            mu_bar[7 * k + 3] += total[3];
            mu_bar[7 * k + 4] += total[4];
            mu_bar[7 * k + 5] += total[5];
            mu_bar[7 * k + 6] += total[6];
            W_bar[36 * k + 0] += total[7];
            W_bar[36 * k + 1] += total[8];
            W_bar[36 * k + 2] += total[9];
            W_bar[36 * k + 3] += total[10];
            W_bar[36 * k + 4] += total[11];
            W_bar[36 * k + 5] += total[12];
            W_bar[36 * k + 6] += total[13];
            W_bar[36 * k + 7] += total[14];
            W_bar[36 * k + 8] += total[15];
            W_bar[36 * k + 9] += total[16];
            W_bar[36 * k + 10] += total[17];
            W_bar[36 * k + 11] += total[18];
            W_bar[36 * k + 12] += total[19];
            W_bar[36 * k + 13] += total[20];
            W_bar[36 * k + 14] += total[21];
            W_bar[36 * k + 15] += total[22];
            W_bar[36 * k + 16] += total[23];
            W_bar[36 * k + 17] += total[24];
            W_bar[36 * k + 18] += total[25];
            W_bar[36 * k + 19] += total[26];
            W_bar[36 * k + 20] += total[27];
            W_bar[36 * k + 21] += total[28];
            W_bar[36 * k + 22] += total[29];
            W_bar[36 * k + 23] += total[30];
            W_bar[36 * k + 24] += total[31];
            W_bar[36 * k + 25] += total[32];
            W_bar[36 * k + 26] += total[33];
            W_bar[36 * k + 27] += total[34];
            W_bar[36 * k + 28] += total[35];
            W_bar[36 * k + 29] += total[36];
            W_bar[36 * k + 30] += total[37];
            W_bar[36 * k + 31] += total[38];
            W_bar[36 * k + 32] += total[39];
            W_bar[36 * k + 33] += total[40];
            W_bar[36 * k + 34] += total[41];
            W_bar[36 * k + 35] += total[42];
            amplitude_bar[1 * k + 0] += total[43];
        }
    }
    restore_denormals(mode);
}
