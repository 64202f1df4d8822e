/*
 * circle: The unit circle in R^2; tangent vectors are one number, the angle in radians, counterclockwise.
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "circle.h"

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

void circle_splats(
    size_t count,
    size_t splat_count,
    const double *CIRCLE_RESTRICT x,
    const double *CIRCLE_RESTRICT mu,
    const double *CIRCLE_RESTRICT W,
    const double *CIRCLE_RESTRICT amplitude,
    double *CIRCLE_RESTRICT value,
    double *CIRCLE_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[2][LANES], sum[2][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 2; ++i) x_block[i][lane] = x[2 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const double mu0 = mu[2 * k + 0];
            const double mu1 = mu[2 * k + 1];
            const double W0_0 = W[1 * k + 0];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double d0 = x_block[0][lane] - mu0;
                const double d1 = x_block[1][lane] - mu1;
                const double s = mu0 * d1 - mu1 * d0;
                const double dot_p_q = x_block[0][lane] * mu0 + x_block[1][lane] * mu1;
                const double t = atan2(s, dot_p_q);
                const double z0 = W0_0 * t;
                const double phi = amplitude_k * exp(-(0.5 * (z0 * z0)));
                const double ratio = W0_0 * z0 / (dot_p_q * dot_p_q + s * s);
                const double dot_p_q_product = dot_p_q * ratio;
                const double by_dot_p_q = s * ratio;
                const double by_d0 = mu1 * dot_p_q_product;
                const double exponent_by_x1 = mu1 * by_dot_p_q - mu0 * dot_p_q_product;
                const double exponent_by_x0 = mu0 * by_dot_p_q + by_d0;
                const double df0 = phi * exponent_by_x0;
                const double df1 = phi * exponent_by_x1;
                const double gradient0 = x_block[0][lane] * df1 - x_block[1][lane] * df0;
                sum[0][lane] += phi;
                sum[1][lane] += gradient0;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 1; ++i) gradient[1 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void circle_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *CIRCLE_RESTRICT x,
    const double *CIRCLE_RESTRICT mu,
    const double *CIRCLE_RESTRICT W,
    const double *CIRCLE_RESTRICT amplitude,
    const double *CIRCLE_RESTRICT value_bar,
    const double *CIRCLE_RESTRICT gradient_bar,
    double *CIRCLE_RESTRICT mu_bar,
    double *CIRCLE_RESTRICT W_bar,
    double *CIRCLE_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 2 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[2][LANES], value_bar_block[1][LANES], gradient_bar_block[1][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const double weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 2; ++i) x_block[i][lane] = x[2 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 1; ++i) gradient_bar_block[i][lane] = gradient_bar[1 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 1; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            double sum[4][LANES] = {{0}}, total[4] = {0};
            const double mu0 = mu[2 * k + 0];
            const double mu1 = mu[2 * k + 1];
            const double W0_0 = W[1 * k + 0];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double d0 = x_block[0][lane] - mu0;
                const double d1 = x_block[1][lane] - mu1;
                const double s = mu0 * d1 - mu1 * d0;
                const double dot_p_q = x_block[0][lane] * mu0 + x_block[1][lane] * mu1;
                const double t = atan2(s, dot_p_q);
                const double z0 = W0_0 * t;
                const double exp_2 = exp(-(0.5 * (z0 * z0)));
                const double phi = amplitude_k * exp_2;
                const double total_2 = dot_p_q * dot_p_q + s * s;
                const double ratio = W0_0 * z0 / total_2;
                const double dot_p_q_product = dot_p_q * ratio;
                const double by_dot_p_q = s * ratio;
                const double by_d0 = mu1 * dot_p_q_product;
                const double exponent_by_x1 = mu1 * by_dot_p_q - mu0 * dot_p_q_product;
                const double exponent_by_x0 = mu0 * by_dot_p_q + by_d0;
                const double product = x_block[1][lane] * gradient_bar_block[0][lane];
                const double by_df1 = x_block[0][lane] * gradient_bar_block[0][lane];
                const double by_exponent_by_x1 = phi * by_df1;
                const double phi_product = phi * product;
                const double by_phi = value_bar_block[0][lane] + exponent_by_x1 * by_df1 - exponent_by_x0 * product;
                const double gap = -(mu0 * by_exponent_by_x1) - mu1 * phi_product;
                const double by_by_dot_p_q = mu1 * by_exponent_by_x1 - mu0 * phi_product;
                const double ratio_2 = (s * by_by_dot_p_q + dot_p_q * gap) / total_2;
                const double product_2 = 2.0 * (ratio * ratio_2);
                const double by_z0 = W0_0 * ratio_2 - z0 * (exp_2 * (amplitude_k * by_phi));
                const double by_t = W0_0 * by_z0;
                const double by_t_ratio = by_t / total_2;
                const double by_s = ratio * by_by_dot_p_q - s * product_2 + dot_p_q * by_t_ratio;
                const double by_dot_p_q_2 = ratio * gap - dot_p_q * product_2 - s * by_t_ratio;
                const double by_d1 = mu0 * by_s;
                const double total_3 = -(dot_p_q_product * by_exponent_by_x1) - by_dot_p_q * phi_product +
                    x_block[0][lane] * by_dot_p_q_2 + d1 * by_s;
                const double by_d1_gap = by_dot_p_q * by_exponent_by_x1 - dot_p_q_product * phi_product + x_block[1][lane]
                    * by_dot_p_q_2 - d0 * by_s - by_d1;
                sum[0][lane] += mu1 * by_s + total_3;
                sum[1][lane] += by_d1_gap;
                sum[2][lane] += z0 * ratio_2 + t * by_z0;
                sum[3][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 4; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[2 * k + 0] += total[0];
            mu_bar[2 * k + 1] += total[1];
            W_bar[1 * k + 0] += total[2];
            amplitude_bar[1 * k + 0] += total[3];
        }
    }
    restore_denormals(mode);
}

void circle_splats_f(
    size_t count,
    size_t splat_count,
    const float *CIRCLE_RESTRICT x,
    const float *CIRCLE_RESTRICT mu,
    const float *CIRCLE_RESTRICT W,
    const float *CIRCLE_RESTRICT amplitude,
    float *CIRCLE_RESTRICT value,
    float *CIRCLE_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[2][LANES], sum[2][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 2; ++i) x_block[i][lane] = x[2 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const float mu0 = mu[2 * k + 0];
            const float mu1 = mu[2 * k + 1];
            const float W0_0 = W[1 * k + 0];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float d0 = x_block[0][lane] - mu0;
                const float d1 = x_block[1][lane] - mu1;
                const float s = mu0 * d1 - mu1 * d0;
                const float dot_p_q = x_block[0][lane] * mu0 + x_block[1][lane] * mu1;
                const float t = atan2f(s, dot_p_q);
                const float z0 = W0_0 * t;
                const float phi = amplitude_k * expf(-(0.5f * (z0 * z0)));
                const float ratio = W0_0 * z0 / (dot_p_q * dot_p_q + s * s);
                const float dot_p_q_product = dot_p_q * ratio;
                const float by_dot_p_q = s * ratio;
                const float by_d0 = mu1 * dot_p_q_product;
                const float exponent_by_x1 = mu1 * by_dot_p_q - mu0 * dot_p_q_product;
                const float exponent_by_x0 = mu0 * by_dot_p_q + by_d0;
                const float df0 = phi * exponent_by_x0;
                const float df1 = phi * exponent_by_x1;
                const float gradient0 = x_block[0][lane] * df1 - x_block[1][lane] * df0;
                sum[0][lane] += phi;
                sum[1][lane] += gradient0;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 1; ++i) gradient[1 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void circle_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *CIRCLE_RESTRICT x,
    const float *CIRCLE_RESTRICT mu,
    const float *CIRCLE_RESTRICT W,
    const float *CIRCLE_RESTRICT amplitude,
    const float *CIRCLE_RESTRICT value_bar,
    const float *CIRCLE_RESTRICT gradient_bar,
    float *CIRCLE_RESTRICT mu_bar,
    float *CIRCLE_RESTRICT W_bar,
    float *CIRCLE_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 2 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[2][LANES], value_bar_block[1][LANES], gradient_bar_block[1][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const float weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 2; ++i) x_block[i][lane] = x[2 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 1; ++i) gradient_bar_block[i][lane] = gradient_bar[1 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 1; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            float sum[4][LANES] = {{0}}, total[4] = {0};
            const float mu0 = mu[2 * k + 0];
            const float mu1 = mu[2 * k + 1];
            const float W0_0 = W[1 * k + 0];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float d0 = x_block[0][lane] - mu0;
                const float d1 = x_block[1][lane] - mu1;
                const float s = mu0 * d1 - mu1 * d0;
                const float dot_p_q = x_block[0][lane] * mu0 + x_block[1][lane] * mu1;
                const float t = atan2f(s, dot_p_q);
                const float z0 = W0_0 * t;
                const float exp_2 = expf(-(0.5f * (z0 * z0)));
                const float phi = amplitude_k * exp_2;
                const float total_2 = dot_p_q * dot_p_q + s * s;
                const float ratio = W0_0 * z0 / total_2;
                const float dot_p_q_product = dot_p_q * ratio;
                const float by_dot_p_q = s * ratio;
                const float by_d0 = mu1 * dot_p_q_product;
                const float exponent_by_x1 = mu1 * by_dot_p_q - mu0 * dot_p_q_product;
                const float exponent_by_x0 = mu0 * by_dot_p_q + by_d0;
                const float product = x_block[1][lane] * gradient_bar_block[0][lane];
                const float by_df1 = x_block[0][lane] * gradient_bar_block[0][lane];
                const float by_exponent_by_x1 = phi * by_df1;
                const float phi_product = phi * product;
                const float by_phi = value_bar_block[0][lane] + exponent_by_x1 * by_df1 - exponent_by_x0 * product;
                const float gap = -(mu0 * by_exponent_by_x1) - mu1 * phi_product;
                const float by_by_dot_p_q = mu1 * by_exponent_by_x1 - mu0 * phi_product;
                const float ratio_2 = (s * by_by_dot_p_q + dot_p_q * gap) / total_2;
                const float product_2 = 2.0f * (ratio * ratio_2);
                const float by_z0 = W0_0 * ratio_2 - z0 * (exp_2 * (amplitude_k * by_phi));
                const float by_t = W0_0 * by_z0;
                const float by_t_ratio = by_t / total_2;
                const float by_s = ratio * by_by_dot_p_q - s * product_2 + dot_p_q * by_t_ratio;
                const float by_dot_p_q_2 = ratio * gap - dot_p_q * product_2 - s * by_t_ratio;
                const float by_d1 = mu0 * by_s;
                const float total_3 = -(dot_p_q_product * by_exponent_by_x1) - by_dot_p_q * phi_product + x_block[0][lane]
                    * by_dot_p_q_2 + d1 * by_s;
                const float by_d1_gap = by_dot_p_q * by_exponent_by_x1 - dot_p_q_product * phi_product + x_block[1][lane]
                    * by_dot_p_q_2 - d0 * by_s - by_d1;
                sum[0][lane] += mu1 * by_s + total_3;
                sum[1][lane] += by_d1_gap;
                sum[2][lane] += z0 * ratio_2 + t * by_z0;
                sum[3][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 4; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[2 * k + 0] += total[0];
            mu_bar[2 * k + 1] += total[1];
            W_bar[1 * k + 0] += total[2];
            amplitude_bar[1 * k + 0] += total[3];
        }
    }
    restore_denormals(mode);
}
