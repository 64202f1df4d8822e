/*
 * so2: Rotations of the plane by their angle in radians, modulo 2 pi.
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "so2.h"

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

void so2_splats(
    size_t count,
    size_t splat_count,
    const double *SO2_RESTRICT x,
    const double *SO2_RESTRICT mu,
    const double *SO2_RESTRICT W,
    const double *SO2_RESTRICT amplitude,
    double *SO2_RESTRICT value,
    double *SO2_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[1][LANES], sum[2][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 1; ++i) x_block[i][lane] = x[1 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const double mu0 = mu[1 * k + 0];
            const double W0_0 = W[1 * k + 0];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double gap = x_block[0][lane] - mu0;
                const double round_2 = rint(0.15915494309189535 * gap);
                const double v0 = gap - 6.28125 * round_2 - 0.0019350051879882812 * round_2 - 3.019915981956753e-07 *
                    round_2;
                const double z0 = W0_0 * v0;
                const double phi = amplitude_k * exp(-(0.5 * (z0 * z0)));
                const double df0 = -(phi * (W0_0 * z0));
                sum[0][lane] += phi;
                sum[1][lane] += df0;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 1; ++i) gradient[1 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void so2_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *SO2_RESTRICT x,
    const double *SO2_RESTRICT mu,
    const double *SO2_RESTRICT W,
    const double *SO2_RESTRICT amplitude,
    const double *SO2_RESTRICT value_bar,
    const double *SO2_RESTRICT gradient_bar,
    double *SO2_RESTRICT mu_bar,
    double *SO2_RESTRICT W_bar,
    double *SO2_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 1 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[1][LANES], value_bar_block[1][LANES], gradient_bar_block[1][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const double weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 1; ++i) x_block[i][lane] = x[1 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 1; ++i) gradient_bar_block[i][lane] = gradient_bar[1 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 1; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            double sum[3][LANES] = {{0}}, total[3] = {0};
            const double mu0 = mu[1 * k + 0];
            const double W0_0 = W[1 * k + 0];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double gap = x_block[0][lane] - mu0;
                const double round_2 = rint(0.15915494309189535 * gap);
                const double v0 = gap - 6.28125 * round_2 - 0.0019350051879882812 * round_2 - 3.019915981956753e-07 *
                    round_2;
                const double z0 = W0_0 * v0;
                const double exp_2 = exp(-(0.5 * (z0 * z0)));
                const double phi = amplitude_k * exp_2;
                const double phi_product = phi * gradient_bar_block[0][lane];
                const double by_phi = value_bar_block[0][lane] - W0_0 * z0 * gradient_bar_block[0][lane];
                const double by_z0 = -(W0_0 * phi_product) - z0 * (exp_2 * (amplitude_k * by_phi));
                const double by_v0 = W0_0 * by_z0;
                sum[0][lane] += -by_v0;
                sum[1][lane] += v0 * by_z0 - z0 * phi_product;
                sum[2][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 3; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[1 * k + 0] += total[0];
            W_bar[1 * k + 0] += total[1];
            amplitude_bar[1 * k + 0] += total[2];
        }
    }
    restore_denormals(mode);
}

void so2_splats_f(
    size_t count,
    size_t splat_count,
    const float *SO2_RESTRICT x,
    const float *SO2_RESTRICT mu,
    const float *SO2_RESTRICT W,
    const float *SO2_RESTRICT amplitude,
    float *SO2_RESTRICT value,
    float *SO2_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[1][LANES], sum[2][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 1; ++i) x_block[i][lane] = x[1 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const float mu0 = mu[1 * k + 0];
            const float W0_0 = W[1 * k + 0];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float gap = x_block[0][lane] - mu0;
                const float round_2 = rintf(0.15915494309189535f * gap);
                const float v0 = gap - 6.28125f * round_2 - 0.0019350051879882812f * round_2 - 3.019915981956753e-07f *
                    round_2;
                const float z0 = W0_0 * v0;
                const float phi = amplitude_k * expf(-(0.5f * (z0 * z0)));
                const float df0 = -(phi * (W0_0 * z0));
                sum[0][lane] += phi;
                sum[1][lane] += df0;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 1; ++i) gradient[1 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void so2_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *SO2_RESTRICT x,
    const float *SO2_RESTRICT mu,
    const float *SO2_RESTRICT W,
    const float *SO2_RESTRICT amplitude,
    const float *SO2_RESTRICT value_bar,
    const float *SO2_RESTRICT gradient_bar,
    float *SO2_RESTRICT mu_bar,
    float *SO2_RESTRICT W_bar,
    float *SO2_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 1 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[1][LANES], value_bar_block[1][LANES], gradient_bar_block[1][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const float weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 1; ++i) x_block[i][lane] = x[1 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 1; ++i) gradient_bar_block[i][lane] = gradient_bar[1 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 1; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            float sum[3][LANES] = {{0}}, total[3] = {0};
            const float mu0 = mu[1 * k + 0];
            const float W0_0 = W[1 * k + 0];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float gap = x_block[0][lane] - mu0;
                const float round_2 = rintf(0.15915494309189535f * gap);
                const float v0 = gap - 6.28125f * round_2 - 0.0019350051879882812f * round_2 - 3.019915981956753e-07f *
                    round_2;
                const float z0 = W0_0 * v0;
                const float exp_2 = expf(-(0.5f * (z0 * z0)));
                const float phi = amplitude_k * exp_2;
                const float phi_product = phi * gradient_bar_block[0][lane];
                const float by_phi = value_bar_block[0][lane] - W0_0 * z0 * gradient_bar_block[0][lane];
                const float by_z0 = -(W0_0 * phi_product) - z0 * (exp_2 * (amplitude_k * by_phi));
                const float by_v0 = W0_0 * by_z0;
                sum[0][lane] += -by_v0;
                sum[1][lane] += v0 * by_z0 - z0 * phi_product;
                sum[2][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 3; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[1 * k + 0] += total[0];
            W_bar[1 * k + 0] += total[1];
            amplitude_bar[1 * k + 0] += total[2];
        }
    }
    restore_denormals(mode);
}
