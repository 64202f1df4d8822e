/*
 * se2: Poses in the plane, R^2 x SO(2); a turn by one radian is as long as `radius`, in the unit of the
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "se2.h"

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

void se2_splats(
    size_t count,
    size_t splat_count,
    const double *SE2_RESTRICT x,
    const double *SE2_RESTRICT mu,
    const double *SE2_RESTRICT W,
    const double *SE2_RESTRICT amplitude,
    double *SE2_RESTRICT value,
    double *SE2_RESTRICT gradient) {
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
                const double v0 = x_block[0][lane] - mu0;
                const double v1 = x_block[1][lane] - mu1;
                const double gap = x_block[2][lane] - mu2;
                const double round_2 = rint(0.15915494309189535 * gap);
                const double v2 = gap - 6.28125 * round_2 - 0.0019350051879882812 * round_2 - 3.019915981956753e-07 *
                    round_2;
                const double z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const double z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const double z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
                const double minus = -(0.5 * (z0 * z0 + z1 * z1 + z2 * z2));
                const double phi = amplitude_k * exp(minus);
                const double by_v2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0;
                const double by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                const double by_v0 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0;
                const double df0 = phi * by_v0;
                const double df1 = phi * by_v1;
                const double df2 = phi * by_v2;
                sum[0][lane] += phi;
                sum[1][lane] += df0;
                sum[2][lane] += df1;
                sum[3][lane] += df2;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 3; ++i) gradient[3 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void se2_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *SE2_RESTRICT x,
    const double *SE2_RESTRICT mu,
    const double *SE2_RESTRICT W,
    const double *SE2_RESTRICT amplitude,
    const double *SE2_RESTRICT value_bar,
    const double *SE2_RESTRICT gradient_bar,
    double *SE2_RESTRICT mu_bar,
    double *SE2_RESTRICT W_bar,
    double *SE2_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 3 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 9 * splat_count; ++i) W_bar[i] = 0;
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
            double sum[13][LANES] = {{0}}, total[13] = {0};
            const double mu0 = mu[3 * k + 0];
            const double mu1 = mu[3 * k + 1];
            const double mu2 = mu[3 * k + 2];
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
                const double v0 = x_block[0][lane] - mu0;
                const double v1 = x_block[1][lane] - mu1;
                const double gap = x_block[2][lane] - mu2;
                const double round_2 = rint(0.15915494309189535 * gap);
                const double v2 = gap - 6.28125 * round_2 - 0.0019350051879882812 * round_2 - 3.019915981956753e-07 *
                    round_2;
                const double z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const double z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const double z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
                const double minus = -(0.5 * (z0 * z0 + z1 * z1 + z2 * z2));
                const double exp_2 = exp(minus);
                const double phi = amplitude_k * exp_2;
                const double by_v2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0;
                const double by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                const double by_v0 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0;
                const double by_by_v2 = phi * gradient_bar_block[2][lane];
                const double by_by_v1 = phi * gradient_bar_block[1][lane];
                const double by_by_v0 = phi * gradient_bar_block[0][lane];
                const double by_phi = value_bar_block[0][lane] + by_v2 * gradient_bar_block[2][lane] + by_v1 *
                    gradient_bar_block[1][lane] + by_v0 * gradient_bar_block[0][lane];
                const double product = exp_2 * (amplitude_k * by_phi);
                const double by_z2 = -(W2_0 * by_by_v0) - W2_1 * by_by_v1 - W2_2 * by_by_v2 - z2 * product;
                const double by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - z1 * product;
                const double by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - z0 * product;
                const double by_v2_2 = W2_2 * by_z2 + W1_2 * by_z1 + W0_2 * by_z0;
                const double by_v1_2 = W2_1 * by_z2 + W1_1 * by_z1 + W0_1 * by_z0;
                const double by_v0_2 = W2_0 * by_z2 + W1_0 * by_z1 + W0_0 * by_z0;
                sum[0][lane] += -by_v0_2;
                sum[1][lane] += -by_v1_2;
                sum[2][lane] += -by_v2_2;
                sum[3][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[4][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[5][lane] += v2 * by_z0 - z0 * by_by_v2;
                sum[6][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[7][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[8][lane] += v2 * by_z1 - z1 * by_by_v2;
                sum[9][lane] += v0 * by_z2 - z2 * by_by_v0;
                sum[10][lane] += v1 * by_z2 - z2 * by_by_v1;
                sum[11][lane] += v2 * by_z2 - z2 * by_by_v2;
                sum[12][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 13; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[3 * k + 0] += total[0];
            mu_bar[3 * k + 1] += total[1];
            mu_bar[3 * k + 2] += total[2];
            W_bar[9 * k + 0] += total[3];
            W_bar[9 * k + 1] += total[4];
            W_bar[9 * k + 2] += total[5];
            W_bar[9 * k + 3] += total[6];
            W_bar[9 * k + 4] += total[7];
            W_bar[9 * k + 5] += total[8];
            W_bar[9 * k + 6] += total[9];
            W_bar[9 * k + 7] += total[10];
            W_bar[9 * k + 8] += total[11];
            amplitude_bar[1 * k + 0] += total[12];
        }
    }
    restore_denormals(mode);
}

void se2_splats_f(
    size_t count,
    size_t splat_count,
    const float *SE2_RESTRICT x,
    const float *SE2_RESTRICT mu,
    const float *SE2_RESTRICT W,
    const float *SE2_RESTRICT amplitude,
    float *SE2_RESTRICT value,
    float *SE2_RESTRICT gradient) {
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
                const float v0 = x_block[0][lane] - mu0;
                const float v1 = x_block[1][lane] - mu1;
                const float gap = x_block[2][lane] - mu2;
                const float round_2 = rintf(0.15915494309189535f * gap);
                const float v2 = gap - 6.28125f * round_2 - 0.0019350051879882812f * round_2 - 3.019915981956753e-07f *
                    round_2;
                const float z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const float z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const float z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
                const float minus = -(0.5f * (z0 * z0 + z1 * z1 + z2 * z2));
                const float phi = amplitude_k * expf(minus);
                const float by_v2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0;
                const float by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                const float by_v0 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0;
                const float df0 = phi * by_v0;
                const float df1 = phi * by_v1;
                const float df2 = phi * by_v2;
                sum[0][lane] += phi;
                sum[1][lane] += df0;
                sum[2][lane] += df1;
                sum[3][lane] += df2;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 3; ++i) gradient[3 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void se2_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *SE2_RESTRICT x,
    const float *SE2_RESTRICT mu,
    const float *SE2_RESTRICT W,
    const float *SE2_RESTRICT amplitude,
    const float *SE2_RESTRICT value_bar,
    const float *SE2_RESTRICT gradient_bar,
    float *SE2_RESTRICT mu_bar,
    float *SE2_RESTRICT W_bar,
    float *SE2_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 3 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 9 * splat_count; ++i) W_bar[i] = 0;
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
            float sum[13][LANES] = {{0}}, total[13] = {0};
            const float mu0 = mu[3 * k + 0];
            const float mu1 = mu[3 * k + 1];
            const float mu2 = mu[3 * k + 2];
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
                const float v0 = x_block[0][lane] - mu0;
                const float v1 = x_block[1][lane] - mu1;
                const float gap = x_block[2][lane] - mu2;
                const float round_2 = rintf(0.15915494309189535f * gap);
                const float v2 = gap - 6.28125f * round_2 - 0.0019350051879882812f * round_2 - 3.019915981956753e-07f *
                    round_2;
                const float z0 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2;
                const float z1 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2;
                const float z2 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2;
                const float minus = -(0.5f * (z0 * z0 + z1 * z1 + z2 * z2));
                const float exp_2 = expf(minus);
                const float phi = amplitude_k * exp_2;
                const float by_v2 = -(W2_2 * z2) - W1_2 * z1 - W0_2 * z0;
                const float by_v1 = -(W2_1 * z2) - W1_1 * z1 - W0_1 * z0;
                const float by_v0 = -(W2_0 * z2) - W1_0 * z1 - W0_0 * z0;
                const float by_by_v2 = phi * gradient_bar_block[2][lane];
                const float by_by_v1 = phi * gradient_bar_block[1][lane];
                const float by_by_v0 = phi * gradient_bar_block[0][lane];
                const float by_phi = value_bar_block[0][lane] + by_v2 * gradient_bar_block[2][lane] + by_v1 *
                    gradient_bar_block[1][lane] + by_v0 * gradient_bar_block[0][lane];
                const float product = exp_2 * (amplitude_k * by_phi);
                const float by_z2 = -(W2_0 * by_by_v0) - W2_1 * by_by_v1 - W2_2 * by_by_v2 - z2 * product;
                const float by_z1 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - z1 * product;
                const float by_z0 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - z0 * product;
                const float by_v2_2 = W2_2 * by_z2 + W1_2 * by_z1 + W0_2 * by_z0;
                const float by_v1_2 = W2_1 * by_z2 + W1_1 * by_z1 + W0_1 * by_z0;
                const float by_v0_2 = W2_0 * by_z2 + W1_0 * by_z1 + W0_0 * by_z0;
                sum[0][lane] += -by_v0_2;
                sum[1][lane] += -by_v1_2;
                sum[2][lane] += -by_v2_2;
                sum[3][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[4][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[5][lane] += v2 * by_z0 - z0 * by_by_v2;
                sum[6][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[7][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[8][lane] += v2 * by_z1 - z1 * by_by_v2;
                sum[9][lane] += v0 * by_z2 - z2 * by_by_v0;
                sum[10][lane] += v1 * by_z2 - z2 * by_by_v1;
                sum[11][lane] += v2 * by_z2 - z2 * by_by_v2;
                sum[12][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 13; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[3 * k + 0] += total[0];
            mu_bar[3 * k + 1] += total[1];
            mu_bar[3 * k + 2] += total[2];
            W_bar[9 * k + 0] += total[3];
            W_bar[9 * k + 1] += total[4];
            W_bar[9 * k + 2] += total[5];
            W_bar[9 * k + 3] += total[6];
            W_bar[9 * k + 4] += total[7];
            W_bar[9 * k + 5] += total[8];
            W_bar[9 * k + 6] += total[9];
            W_bar[9 * k + 7] += total[10];
            W_bar[9 * k + 8] += total[11];
            amplitude_bar[1 * k + 0] += total[12];
        }
    }
    restore_denormals(mode);
}
