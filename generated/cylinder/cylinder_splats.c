/*
 * cylinder: The flat cylinder of a radius, as (angle, height); the angle in radians modulo 2 pi, the height in
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "cylinder.h"

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

void cylinder_splats(
    size_t count,
    size_t splat_count,
    const double *CYLINDER_RESTRICT x,
    const double *CYLINDER_RESTRICT mu,
    const double *CYLINDER_RESTRICT W,
    const double *CYLINDER_RESTRICT amplitude,
    double *CYLINDER_RESTRICT value,
    double *CYLINDER_RESTRICT gradient) {
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
                const double v1 = x_block[1][lane] - mu1;
                const double z0 = W0_0 * v0 + W0_1 * v1;
                const double z1 = W1_0 * v0 + W1_1 * v1;
                const double exp_2 = exp(-(0.5 * (z0 * z0 + z1 * z1)));
                const double phi = amplitude_k * exp_2;
                const double by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const double by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const double df0 = phi * by_v0;
                const double df1 = phi * by_v1;
                sum[0][lane] += phi;
                sum[1][lane] += df0;
                sum[2][lane] += df1;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 2; ++i) gradient[2 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void cylinder_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *CYLINDER_RESTRICT x,
    const double *CYLINDER_RESTRICT mu,
    const double *CYLINDER_RESTRICT W,
    const double *CYLINDER_RESTRICT amplitude,
    const double *CYLINDER_RESTRICT value_bar,
    const double *CYLINDER_RESTRICT gradient_bar,
    double *CYLINDER_RESTRICT mu_bar,
    double *CYLINDER_RESTRICT W_bar,
    double *CYLINDER_RESTRICT amplitude_bar) {
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
                const double v1 = x_block[1][lane] - mu1;
                const double z0 = W0_0 * v0 + W0_1 * v1;
                const double z1 = W1_0 * v0 + W1_1 * v1;
                const double exp_2 = exp(-(0.5 * (z0 * z0 + z1 * z1)));
                const double phi = amplitude_k * exp_2;
                const double by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const double by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const double by_by_v1 = phi * gradient_bar_block[1][lane];
                const double by_by_v0 = phi * gradient_bar_block[0][lane];
                const double by_phi = value_bar_block[0][lane] + by_v1 * gradient_bar_block[1][lane] + by_v0 *
                    gradient_bar_block[0][lane];
                const double product = exp_2 * (amplitude_k * by_phi);
                const double by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - z1 * product;
                const double by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - z0 * product;
                const double by_v1_2 = W1_1 * by_z1 + W0_1 * by_z0;
                const double by_v0_2 = W1_0 * by_z1 + W0_0 * by_z0;
                sum[0][lane] += -by_v0_2;
                sum[1][lane] += -by_v1_2;
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

void cylinder_splats_f(
    size_t count,
    size_t splat_count,
    const float *CYLINDER_RESTRICT x,
    const float *CYLINDER_RESTRICT mu,
    const float *CYLINDER_RESTRICT W,
    const float *CYLINDER_RESTRICT amplitude,
    float *CYLINDER_RESTRICT value,
    float *CYLINDER_RESTRICT gradient) {
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
                const float v1 = x_block[1][lane] - mu1;
                const float z0 = W0_0 * v0 + W0_1 * v1;
                const float z1 = W1_0 * v0 + W1_1 * v1;
                const float exp_2 = expf(-(0.5f * (z0 * z0 + z1 * z1)));
                const float phi = amplitude_k * exp_2;
                const float by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const float by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const float df0 = phi * by_v0;
                const float df1 = phi * by_v1;
                sum[0][lane] += phi;
                sum[1][lane] += df0;
                sum[2][lane] += df1;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 2; ++i) gradient[2 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void cylinder_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *CYLINDER_RESTRICT x,
    const float *CYLINDER_RESTRICT mu,
    const float *CYLINDER_RESTRICT W,
    const float *CYLINDER_RESTRICT amplitude,
    const float *CYLINDER_RESTRICT value_bar,
    const float *CYLINDER_RESTRICT gradient_bar,
    float *CYLINDER_RESTRICT mu_bar,
    float *CYLINDER_RESTRICT W_bar,
    float *CYLINDER_RESTRICT amplitude_bar) {
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
                const float v1 = x_block[1][lane] - mu1;
                const float z0 = W0_0 * v0 + W0_1 * v1;
                const float z1 = W1_0 * v0 + W1_1 * v1;
                const float exp_2 = expf(-(0.5f * (z0 * z0 + z1 * z1)));
                const float phi = amplitude_k * exp_2;
                const float by_v1 = -(W1_1 * z1) - W0_1 * z0;
                const float by_v0 = -(W1_0 * z1) - W0_0 * z0;
                const float by_by_v1 = phi * gradient_bar_block[1][lane];
                const float by_by_v0 = phi * gradient_bar_block[0][lane];
                const float by_phi = value_bar_block[0][lane] + by_v1 * gradient_bar_block[1][lane] + by_v0 *
                    gradient_bar_block[0][lane];
                const float product = exp_2 * (amplitude_k * by_phi);
                const float by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - z1 * product;
                const float by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - z0 * product;
                const float by_v1_2 = W1_1 * by_z1 + W0_1 * by_z0;
                const float by_v0_2 = W1_0 * by_z1 + W0_0 * by_z0;
                sum[0][lane] += -by_v0_2;
                sum[1][lane] += -by_v1_2;
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
