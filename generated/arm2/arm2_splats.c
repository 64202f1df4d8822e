/*
 * arm2: A two-link arm under its kinetic energy: |v|^2 / 2 is the energy of the joint velocities v. Exp and Log
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "arm2.h"

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

void arm2_splats(
    size_t count,
    size_t splat_count,
    const double *ARM2_RESTRICT x,
    const double *ARM2_RESTRICT mu,
    const double *ARM2_RESTRICT W,
    const double *ARM2_RESTRICT amplitude,
    double *ARM2_RESTRICT value,
    double *ARM2_RESTRICT gradient) {
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
                const double gap = x_block[0][lane] - mu0;
                const double round_2 = rint(0.15915494309189535 * gap);
                const double v0 = gap - 6.28125 * round_2 - 0.0019350051879882812 * round_2 - 3.019915981956753e-07 *
                    round_2;
                const double gap_2 = x_block[1][lane] - mu1;
                const double round_3 = rint(0.15915494309189535 * gap_2);
                const double v1 = gap_2 - 6.28125 * round_3 - 0.0019350051879882812 * round_3 - 3.019915981956753e-07 *
                    round_3;
                const double gap_3 = mu1 - x_block[1][lane];
                const double sin_p1_minus_q1 = sin(gap_3);
                const double total_2 = x_block[1][lane] + mu1;
                const double sin_p1_plus_q1 = sin(total_2);
                const double product = 0.25 * sin_p1_minus_q1;
                const double difference = sin_p1_plus_q1 * product;
                const double cos_p1 = cos(mu1);
                const double cos_q1 = cos(x_block[1][lane]);
                const double cos_q1_squared = cos_q1 * cos_q1;
                const double total_3 = 0.8888888888888888 - 0.25 * (cos_p1 * cos_p1) - 0.25 * cos_q1_squared;
                const double difference_ratio = difference / total_3;
                const double atanh_value = atanh(difference_ratio);
                const double z0 = W0_0 * v0 + W0_1 * v1;
                const double z1 = W1_0 * v0 + W1_1 * v1;
                const double exp_2 = exp(atanh_value - 0.5 * (z0 * z0 + z1 * z1));
                const double phi = amplitude_k * exp_2;
                const double by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const double by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const double by_difference = 1.0 / (1.0 - difference_ratio * difference_ratio) / total_3;
                const double by_cos_q1 = cos_q1 * (0.5 * (difference_ratio * by_difference));
                const double by_sin_p1_plus_q1 = product * by_difference;
                const double by_sin_p1_minus_q1 = 0.25 * (sin_p1_plus_q1 * by_difference);
                const double exponent_by_x1 = by_v1 + (by_sin_p1_plus_q1 * cos(total_2) - by_cos_q1 *
                    sin(x_block[1][lane]) - by_sin_p1_minus_q1 * cos(gap_3));
                const double df0 = phi * by_v0;
                const double df1 = phi * exponent_by_x1;
                const double gap_4 = 9.0 * cos_q1_squared - 16.0;
                const double total_4 = 12.0 + 18.0 * cos_q1;
                const double gradient0 = df1 * total_4 / gap_4 - 12.0 * df0 / gap_4;
                const double gradient1 = df0 * total_4 / gap_4 + df1 * (-60.0 - 36.0 * cos_q1) / gap_4;
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

void arm2_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *ARM2_RESTRICT x,
    const double *ARM2_RESTRICT mu,
    const double *ARM2_RESTRICT W,
    const double *ARM2_RESTRICT amplitude,
    const double *ARM2_RESTRICT value_bar,
    const double *ARM2_RESTRICT gradient_bar,
    double *ARM2_RESTRICT mu_bar,
    double *ARM2_RESTRICT W_bar,
    double *ARM2_RESTRICT amplitude_bar) {
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
                const double gap = x_block[0][lane] - mu0;
                const double round_2 = rint(0.15915494309189535 * gap);
                const double v0 = gap - 6.28125 * round_2 - 0.0019350051879882812 * round_2 - 3.019915981956753e-07 *
                    round_2;
                const double gap_2 = x_block[1][lane] - mu1;
                const double round_3 = rint(0.15915494309189535 * gap_2);
                const double v1 = gap_2 - 6.28125 * round_3 - 0.0019350051879882812 * round_3 - 3.019915981956753e-07 *
                    round_3;
                const double gap_3 = mu1 - x_block[1][lane];
                const double sin_p1_minus_q1 = sin(gap_3);
                const double total_2 = x_block[1][lane] + mu1;
                const double sin_p1_plus_q1 = sin(total_2);
                const double product = 0.25 * sin_p1_minus_q1;
                const double difference = sin_p1_plus_q1 * product;
                const double cos_p1 = cos(mu1);
                const double cos_q1 = cos(x_block[1][lane]);
                const double cos_q1_squared = cos_q1 * cos_q1;
                const double total_3 = 0.8888888888888888 - 0.25 * (cos_p1 * cos_p1) - 0.25 * cos_q1_squared;
                const double difference_ratio = difference / total_3;
                const double atanh_value = atanh(difference_ratio);
                const double z0 = W0_0 * v0 + W0_1 * v1;
                const double z1 = W1_0 * v0 + W1_1 * v1;
                const double exp_2 = exp(atanh_value - 0.5 * (z0 * z0 + z1 * z1));
                const double phi = amplitude_k * exp_2;
                const double by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const double by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const double gap_4 = 1.0 - difference_ratio * difference_ratio;
                const double ratio = 1.0 / gap_4;
                const double by_difference = ratio / total_3;
                const double by_cos_q1 = cos_q1 * (0.5 * (difference_ratio * by_difference));
                const double sin_2 = sin(x_block[1][lane]);
                const double by_sin_p1_plus_q1 = product * by_difference;
                const double by_sin_p1_minus_q1 = 0.25 * (sin_p1_plus_q1 * by_difference);
                const double cos_2 = cos(total_2);
                const double cos_3 = cos(gap_3);
                const double exponent_by_x1 = by_v1 + (by_sin_p1_plus_q1 * cos_2 - by_cos_q1 * sin_2 - by_sin_p1_minus_q1
                    * cos_3);
                const double gap_5 = 9.0 * cos_q1_squared - 16.0;
                const double total_4 = 12.0 + 18.0 * cos_q1;
                const double ratio_2 = gradient_bar_block[1][lane] / gap_5;
                const double ratio_3 = gradient_bar_block[0][lane] / gap_5;
                const double by_df0 = total_4 * ratio_2 - 12.0 * ratio_3;
                const double by_df1 = (-60.0 - 36.0 * cos_q1) * ratio_2 + total_4 * ratio_3;
                const double by_exponent_by_x1 = phi * by_df1;
                const double by_by_v0 = phi * by_df0;
                const double by_phi = value_bar_block[0][lane] + exponent_by_x1 * by_df1 + by_v0 * by_df0;
                const double by_by_sin_p1_plus_q1 = cos_2 * by_exponent_by_x1;
                const double product_2 = 0.25 * (cos_3 * by_exponent_by_x1);
                const double product_3 = 0.5 * (cos_q1 * (sin_2 * by_exponent_by_x1));
                const double by_by_difference = product * by_by_sin_p1_plus_q1 - sin_p1_plus_q1 * product_2 -
                    difference_ratio * product_3;
                const double ratio_4 = by_by_difference / total_3;
                const double gap_6 = difference_ratio * (2.0 * (ratio * (ratio_4 / gap_4))) - by_difference * product_3;
                const double by_atanh_value = exp_2 * (amplitude_k * by_phi);
                const double by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_exponent_by_x1 - z1 * by_atanh_value;
                const double by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_exponent_by_x1 - z0 * by_atanh_value;
                const double by_v1_2 = W1_1 * by_z1 + W0_1 * by_z0;
                const double by_v0_2 = W1_0 * by_z1 + W0_0 * by_z0;
                const double by_difference_2 = (gap_6 + by_atanh_value / gap_4) / total_3;
                const double by_cos_p1 = cos_p1 * (0.5 * (difference_ratio * by_difference_2 - -(by_difference *
                    ratio_4)));
                const double by_sin_p1_plus_q1_2 = product * by_difference_2 - by_difference * product_2;
                const double by_sin_p1_minus_q1_2 = 0.25 * (by_difference * by_by_sin_p1_plus_q1 + sin_p1_plus_q1 *
                    by_difference_2);
                const double total_5 = cos_2 * by_sin_p1_plus_q1_2 - sin_p1_plus_q1 * (by_sin_p1_plus_q1 *
                    by_exponent_by_x1) - by_cos_p1 * sin(mu1) + (sin_p1_minus_q1 * (by_sin_p1_minus_q1 *
                    by_exponent_by_x1) + cos_3 * by_sin_p1_minus_q1_2);
                sum[0][lane] += -by_v0_2;
                sum[1][lane] += total_5 - by_v1_2;
                sum[2][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[3][lane] += v1 * by_z0 - z0 * by_exponent_by_x1;
                sum[4][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[5][lane] += v1 * by_z1 - z1 * by_exponent_by_x1;
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

void arm2_splats_f(
    size_t count,
    size_t splat_count,
    const float *ARM2_RESTRICT x,
    const float *ARM2_RESTRICT mu,
    const float *ARM2_RESTRICT W,
    const float *ARM2_RESTRICT amplitude,
    float *ARM2_RESTRICT value,
    float *ARM2_RESTRICT gradient) {
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
                const float gap = x_block[0][lane] - mu0;
                const float round_2 = rintf(0.15915494309189535f * gap);
                const float v0 = gap - 6.28125f * round_2 - 0.0019350051879882812f * round_2 - 3.019915981956753e-07f *
                    round_2;
                const float gap_2 = x_block[1][lane] - mu1;
                const float round_3 = rintf(0.15915494309189535f * gap_2);
                const float v1 = gap_2 - 6.28125f * round_3 - 0.0019350051879882812f * round_3 - 3.019915981956753e-07f *
                    round_3;
                const float gap_3 = mu1 - x_block[1][lane];
                const float sin_p1_minus_q1 = sinf(gap_3);
                const float total_2 = x_block[1][lane] + mu1;
                const float sin_p1_plus_q1 = sinf(total_2);
                const float product = 0.25f * sin_p1_minus_q1;
                const float difference = sin_p1_plus_q1 * product;
                const float cos_p1 = cosf(mu1);
                const float cos_q1 = cosf(x_block[1][lane]);
                const float cos_q1_squared = cos_q1 * cos_q1;
                const float total_3 = 0.8888888888888888f - 0.25f * (cos_p1 * cos_p1) - 0.25f * cos_q1_squared;
                const float difference_ratio = difference / total_3;
                const float atanh_value = atanhf(difference_ratio);
                const float z0 = W0_0 * v0 + W0_1 * v1;
                const float z1 = W1_0 * v0 + W1_1 * v1;
                const float exp_2 = expf(atanh_value - 0.5f * (z0 * z0 + z1 * z1));
                const float phi = amplitude_k * exp_2;
                const float by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const float by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const float by_difference = 1.0f / (1.0f - difference_ratio * difference_ratio) / total_3;
                const float by_cos_q1 = cos_q1 * (0.5f * (difference_ratio * by_difference));
                const float by_sin_p1_plus_q1 = product * by_difference;
                const float by_sin_p1_minus_q1 = 0.25f * (sin_p1_plus_q1 * by_difference);
                const float exponent_by_x1 = by_v1 + (by_sin_p1_plus_q1 * cosf(total_2) - by_cos_q1 *
                    sinf(x_block[1][lane]) - by_sin_p1_minus_q1 * cosf(gap_3));
                const float df0 = phi * by_v0;
                const float df1 = phi * exponent_by_x1;
                const float gap_4 = 9.0f * cos_q1_squared - 16.0f;
                const float total_4 = 12.0f + 18.0f * cos_q1;
                const float gradient0 = df1 * total_4 / gap_4 - 12.0f * df0 / gap_4;
                const float gradient1 = df0 * total_4 / gap_4 + df1 * (-60.0f - 36.0f * cos_q1) / gap_4;
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

void arm2_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *ARM2_RESTRICT x,
    const float *ARM2_RESTRICT mu,
    const float *ARM2_RESTRICT W,
    const float *ARM2_RESTRICT amplitude,
    const float *ARM2_RESTRICT value_bar,
    const float *ARM2_RESTRICT gradient_bar,
    float *ARM2_RESTRICT mu_bar,
    float *ARM2_RESTRICT W_bar,
    float *ARM2_RESTRICT amplitude_bar) {
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
                const float gap = x_block[0][lane] - mu0;
                const float round_2 = rintf(0.15915494309189535f * gap);
                const float v0 = gap - 6.28125f * round_2 - 0.0019350051879882812f * round_2 - 3.019915981956753e-07f *
                    round_2;
                const float gap_2 = x_block[1][lane] - mu1;
                const float round_3 = rintf(0.15915494309189535f * gap_2);
                const float v1 = gap_2 - 6.28125f * round_3 - 0.0019350051879882812f * round_3 - 3.019915981956753e-07f *
                    round_3;
                const float gap_3 = mu1 - x_block[1][lane];
                const float sin_p1_minus_q1 = sinf(gap_3);
                const float total_2 = x_block[1][lane] + mu1;
                const float sin_p1_plus_q1 = sinf(total_2);
                const float product = 0.25f * sin_p1_minus_q1;
                const float difference = sin_p1_plus_q1 * product;
                const float cos_p1 = cosf(mu1);
                const float cos_q1 = cosf(x_block[1][lane]);
                const float cos_q1_squared = cos_q1 * cos_q1;
                const float total_3 = 0.8888888888888888f - 0.25f * (cos_p1 * cos_p1) - 0.25f * cos_q1_squared;
                const float difference_ratio = difference / total_3;
                const float atanh_value = atanhf(difference_ratio);
                const float z0 = W0_0 * v0 + W0_1 * v1;
                const float z1 = W1_0 * v0 + W1_1 * v1;
                const float exp_2 = expf(atanh_value - 0.5f * (z0 * z0 + z1 * z1));
                const float phi = amplitude_k * exp_2;
                const float by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const float by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const float gap_4 = 1.0f - difference_ratio * difference_ratio;
                const float ratio = 1.0f / gap_4;
                const float by_difference = ratio / total_3;
                const float by_cos_q1 = cos_q1 * (0.5f * (difference_ratio * by_difference));
                const float sin_2 = sinf(x_block[1][lane]);
                const float by_sin_p1_plus_q1 = product * by_difference;
                const float by_sin_p1_minus_q1 = 0.25f * (sin_p1_plus_q1 * by_difference);
                const float cos_2 = cosf(total_2);
                const float cos_3 = cosf(gap_3);
                const float exponent_by_x1 = by_v1 + (by_sin_p1_plus_q1 * cos_2 - by_cos_q1 * sin_2 - by_sin_p1_minus_q1 *
                    cos_3);
                const float gap_5 = 9.0f * cos_q1_squared - 16.0f;
                const float total_4 = 12.0f + 18.0f * cos_q1;
                const float ratio_2 = gradient_bar_block[1][lane] / gap_5;
                const float ratio_3 = gradient_bar_block[0][lane] / gap_5;
                const float by_df0 = total_4 * ratio_2 - 12.0f * ratio_3;
                const float by_df1 = (-60.0f - 36.0f * cos_q1) * ratio_2 + total_4 * ratio_3;
                const float by_exponent_by_x1 = phi * by_df1;
                const float by_by_v0 = phi * by_df0;
                const float by_phi = value_bar_block[0][lane] + exponent_by_x1 * by_df1 + by_v0 * by_df0;
                const float by_by_sin_p1_plus_q1 = cos_2 * by_exponent_by_x1;
                const float product_2 = 0.25f * (cos_3 * by_exponent_by_x1);
                const float product_3 = 0.5f * (cos_q1 * (sin_2 * by_exponent_by_x1));
                const float by_by_difference = product * by_by_sin_p1_plus_q1 - sin_p1_plus_q1 * product_2 -
                    difference_ratio * product_3;
                const float ratio_4 = by_by_difference / total_3;
                const float gap_6 = difference_ratio * (2.0f * (ratio * (ratio_4 / gap_4))) - by_difference * product_3;
                const float by_atanh_value = exp_2 * (amplitude_k * by_phi);
                const float by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_exponent_by_x1 - z1 * by_atanh_value;
                const float by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_exponent_by_x1 - z0 * by_atanh_value;
                const float by_v1_2 = W1_1 * by_z1 + W0_1 * by_z0;
                const float by_v0_2 = W1_0 * by_z1 + W0_0 * by_z0;
                const float by_difference_2 = (gap_6 + by_atanh_value / gap_4) / total_3;
                const float by_cos_p1 = cos_p1 * (0.5f * (difference_ratio * by_difference_2 - -(by_difference *
                    ratio_4)));
                const float by_sin_p1_plus_q1_2 = product * by_difference_2 - by_difference * product_2;
                const float by_sin_p1_minus_q1_2 = 0.25f * (by_difference * by_by_sin_p1_plus_q1 + sin_p1_plus_q1 *
                    by_difference_2);
                const float total_5 = cos_2 * by_sin_p1_plus_q1_2 - sin_p1_plus_q1 * (by_sin_p1_plus_q1 *
                    by_exponent_by_x1) - by_cos_p1 * sinf(mu1) + (sin_p1_minus_q1 * (by_sin_p1_minus_q1 *
                    by_exponent_by_x1) + cos_3 * by_sin_p1_minus_q1_2);
                sum[0][lane] += -by_v0_2;
                sum[1][lane] += total_5 - by_v1_2;
                sum[2][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[3][lane] += v1 * by_z0 - z0 * by_exponent_by_x1;
                sum[4][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[5][lane] += v1 * by_z1 - z1 * by_exponent_by_x1;
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
