/*
 * mobile_manipulator: A mobile base in the plane and an arm of six revolute joints; lengths are those of the
 *
 * Sums of splats, forward and backward. See the header for what the functions promise.
 */

#include "mobile_manipulator.h"

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

void mobile_manipulator_splats(
    size_t count,
    size_t splat_count,
    const double *MOBILE_MANIPULATOR_RESTRICT x,
    const double *MOBILE_MANIPULATOR_RESTRICT mu,
    const double *MOBILE_MANIPULATOR_RESTRICT W,
    const double *MOBILE_MANIPULATOR_RESTRICT amplitude,
    double *MOBILE_MANIPULATOR_RESTRICT value,
    double *MOBILE_MANIPULATOR_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[9][LANES], sum[10][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 9; ++i) x_block[i][lane] = x[9 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const double mu0 = mu[9 * k + 0];
            const double mu1 = mu[9 * k + 1];
            const double mu2 = mu[9 * k + 2];
            const double mu3 = mu[9 * k + 3];
            const double mu4 = mu[9 * k + 4];
            const double mu5 = mu[9 * k + 5];
            const double mu6 = mu[9 * k + 6];
            const double mu7 = mu[9 * k + 7];
            const double mu8 = mu[9 * k + 8];
            const double W0_0 = W[81 * k + 0];
            const double W0_1 = W[81 * k + 1];
            const double W0_2 = W[81 * k + 2];
            const double W0_3 = W[81 * k + 3];
            const double W0_4 = W[81 * k + 4];
            const double W0_5 = W[81 * k + 5];
            const double W0_6 = W[81 * k + 6];
            const double W0_7 = W[81 * k + 7];
            const double W0_8 = W[81 * k + 8];
            const double W1_0 = W[81 * k + 9];
            const double W1_1 = W[81 * k + 10];
            const double W1_2 = W[81 * k + 11];
            const double W1_3 = W[81 * k + 12];
            const double W1_4 = W[81 * k + 13];
            const double W1_5 = W[81 * k + 14];
            const double W1_6 = W[81 * k + 15];
            const double W1_7 = W[81 * k + 16];
            const double W1_8 = W[81 * k + 17];
            const double W2_0 = W[81 * k + 18];
            const double W2_1 = W[81 * k + 19];
            const double W2_2 = W[81 * k + 20];
            const double W2_3 = W[81 * k + 21];
            const double W2_4 = W[81 * k + 22];
            const double W2_5 = W[81 * k + 23];
            const double W2_6 = W[81 * k + 24];
            const double W2_7 = W[81 * k + 25];
            const double W2_8 = W[81 * k + 26];
            const double W3_0 = W[81 * k + 27];
            const double W3_1 = W[81 * k + 28];
            const double W3_2 = W[81 * k + 29];
            const double W3_3 = W[81 * k + 30];
            const double W3_4 = W[81 * k + 31];
            const double W3_5 = W[81 * k + 32];
            const double W3_6 = W[81 * k + 33];
            const double W3_7 = W[81 * k + 34];
            const double W3_8 = W[81 * k + 35];
            const double W4_0 = W[81 * k + 36];
            const double W4_1 = W[81 * k + 37];
            const double W4_2 = W[81 * k + 38];
            const double W4_3 = W[81 * k + 39];
            const double W4_4 = W[81 * k + 40];
            const double W4_5 = W[81 * k + 41];
            const double W4_6 = W[81 * k + 42];
            const double W4_7 = W[81 * k + 43];
            const double W4_8 = W[81 * k + 44];
            const double W5_0 = W[81 * k + 45];
            const double W5_1 = W[81 * k + 46];
            const double W5_2 = W[81 * k + 47];
            const double W5_3 = W[81 * k + 48];
            const double W5_4 = W[81 * k + 49];
            const double W5_5 = W[81 * k + 50];
            const double W5_6 = W[81 * k + 51];
            const double W5_7 = W[81 * k + 52];
            const double W5_8 = W[81 * k + 53];
            const double W6_0 = W[81 * k + 54];
            const double W6_1 = W[81 * k + 55];
            const double W6_2 = W[81 * k + 56];
            const double W6_3 = W[81 * k + 57];
            const double W6_4 = W[81 * k + 58];
            const double W6_5 = W[81 * k + 59];
            const double W6_6 = W[81 * k + 60];
            const double W6_7 = W[81 * k + 61];
            const double W6_8 = W[81 * k + 62];
            const double W7_0 = W[81 * k + 63];
            const double W7_1 = W[81 * k + 64];
            const double W7_2 = W[81 * k + 65];
            const double W7_3 = W[81 * k + 66];
            const double W7_4 = W[81 * k + 67];
            const double W7_5 = W[81 * k + 68];
            const double W7_6 = W[81 * k + 69];
            const double W7_7 = W[81 * k + 70];
            const double W7_8 = W[81 * k + 71];
            const double W8_0 = W[81 * k + 72];
            const double W8_1 = W[81 * k + 73];
            const double W8_2 = W[81 * k + 74];
            const double W8_3 = W[81 * k + 75];
            const double W8_4 = W[81 * k + 76];
            const double W8_5 = W[81 * k + 77];
            const double W8_6 = W[81 * k + 78];
            const double W8_7 = W[81 * k + 79];
            const double W8_8 = W[81 * k + 80];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double v0 = x_block[0][lane] - mu0;
                const double v1 = x_block[1][lane] - mu1;
                const double gap = x_block[2][lane] - mu2;
                const double round_2 = rint(0.15915494309189535 * gap);
                const double v2 = gap - 6.28125 * round_2 - 0.0019350051879882812 * round_2 - 3.019915981956753e-07 *
                    round_2;
                const double gap_2 = x_block[3][lane] - mu3;
                const double round_3 = rint(0.15915494309189535 * gap_2);
                const double v3 = gap_2 - 6.28125 * round_3 - 0.0019350051879882812 * round_3 - 3.019915981956753e-07 *
                    round_3;
                const double gap_3 = x_block[4][lane] - mu4;
                const double round_4 = rint(0.15915494309189535 * gap_3);
                const double v4 = gap_3 - 6.28125 * round_4 - 0.0019350051879882812 * round_4 - 3.019915981956753e-07 *
                    round_4;
                const double gap_4 = x_block[5][lane] - mu5;
                const double round_5 = rint(0.15915494309189535 * gap_4);
                const double v5 = gap_4 - 6.28125 * round_5 - 0.0019350051879882812 * round_5 - 3.019915981956753e-07 *
                    round_5;
                const double gap_5 = x_block[6][lane] - mu6;
                const double round_6 = rint(0.15915494309189535 * gap_5);
                const double v6 = gap_5 - 6.28125 * round_6 - 0.0019350051879882812 * round_6 - 3.019915981956753e-07 *
                    round_6;
                const double gap_6 = x_block[7][lane] - mu7;
                const double round_7 = rint(0.15915494309189535 * gap_6);
                const double v7 = gap_6 - 6.28125 * round_7 - 0.0019350051879882812 * round_7 - 3.019915981956753e-07 *
                    round_7;
                const double gap_7 = x_block[8][lane] - mu8;
                const double round_8 = rint(0.15915494309189535 * gap_7);
                const double v8 = gap_7 - 6.28125 * round_8 - 0.0019350051879882812 * round_8 - 3.019915981956753e-07 *
                    round_8;
                const double total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
                const double z0 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
                const double total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
                const double z1 = total_3 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
                const double total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
                const double z2 = total_4 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
                const double total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
                const double z3 = total_5 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
                const double total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
                const double z4 = total_6 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
                const double total_7 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
                const double z5 = total_7 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
                const double total_8 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
                const double z6 = total_8 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
                const double total_9 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
                const double z7 = total_9 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
                const double total_10 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
                const double z8 = total_10 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
                const double total_11 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
                const double total_12 = total_11 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
                const double phi = amplitude_k * exp(-(0.5 * total_12));
                const double gap_8 = -(W8_8 * z8) - W7_8 * z7 - W6_8 * z6 - W5_8 * z5;
                const double gap_9 = -(W8_7 * z8) - W7_7 * z7 - W6_7 * z6 - W5_7 * z5;
                const double gap_10 = -(W8_6 * z8) - W7_6 * z7 - W6_6 * z6 - W5_6 * z5;
                const double gap_11 = -(W8_5 * z8) - W7_5 * z7 - W6_5 * z6 - W5_5 * z5;
                const double gap_12 = -(W8_4 * z8) - W7_4 * z7 - W6_4 * z6 - W5_4 * z5;
                const double gap_13 = -(W8_3 * z8) - W7_3 * z7 - W6_3 * z6 - W5_3 * z5;
                const double gap_14 = -(W8_2 * z8) - W7_2 * z7 - W6_2 * z6 - W5_2 * z5;
                const double gap_15 = -(W8_1 * z8) - W7_1 * z7 - W6_1 * z6 - W5_1 * z5;
                const double gap_16 = -(W8_0 * z8) - W7_0 * z7 - W6_0 * z6 - W5_0 * z5;
                const double gap_17 = gap_8 - W4_8 * z4 - W3_8 * z3 - W2_8 * z2 - W1_8 * z1;
                const double gap_18 = gap_9 - W4_7 * z4 - W3_7 * z3 - W2_7 * z2 - W1_7 * z1;
                const double gap_19 = gap_10 - W4_6 * z4 - W3_6 * z3 - W2_6 * z2 - W1_6 * z1;
                const double gap_20 = gap_11 - W4_5 * z4 - W3_5 * z3 - W2_5 * z2 - W1_5 * z1;
                const double gap_21 = gap_12 - W4_4 * z4 - W3_4 * z3 - W2_4 * z2 - W1_4 * z1;
                const double gap_22 = gap_13 - W4_3 * z4 - W3_3 * z3 - W2_3 * z2 - W1_3 * z1;
                const double gap_23 = gap_14 - W4_2 * z4 - W3_2 * z3 - W2_2 * z2 - W1_2 * z1;
                const double gap_24 = gap_15 - W4_1 * z4 - W3_1 * z3 - W2_1 * z2 - W1_1 * z1;
                const double gap_25 = gap_16 - W4_0 * z4 - W3_0 * z3 - W2_0 * z2 - W1_0 * z1;
                const double by_v8 = gap_17 - W0_8 * z0;
                const double by_v7 = gap_18 - W0_7 * z0;
                const double by_v6 = gap_19 - W0_6 * z0;
                const double by_v5 = gap_20 - W0_5 * z0;
                const double by_v4 = gap_21 - W0_4 * z0;
                const double by_v3 = gap_22 - W0_3 * z0;
                const double by_v2 = gap_23 - W0_2 * z0;
                const double by_v1 = gap_24 - W0_1 * z0;
                const double by_v0 = gap_25 - W0_0 * z0;
                const double df0 = phi * by_v0;
                const double df1 = phi * by_v1;
                const double df2 = phi * by_v2;
                const double df3 = phi * by_v3;
                const double df4 = phi * by_v4;
                const double df5 = phi * by_v5;
                const double df6 = phi * by_v6;
                const double df7 = phi * by_v7;
                const double df8 = phi * by_v8;
                const double gradient2 = 4.0 * df2;
                const double gradient3 = 16.0 * df3;
                const double gradient4 = 16.0 * df4;
                const double gradient5 = 16.0 * df5;
                const double gradient6 = 16.0 * df6;
                const double gradient7 = 16.0 * df7;
                const double gradient8 = 16.0 * df8;
                sum[0][lane] += phi;
                sum[1][lane] += df0;
                sum[2][lane] += df1;
                sum[3][lane] += gradient2;
                sum[4][lane] += gradient3;
                sum[5][lane] += gradient4;
                sum[6][lane] += gradient5;
                sum[7][lane] += gradient6;
                sum[8][lane] += gradient7;
                sum[9][lane] += gradient8;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 9; ++i) gradient[9 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void mobile_manipulator_splats_vjp(
    size_t count,
    size_t splat_count,
    const double *MOBILE_MANIPULATOR_RESTRICT x,
    const double *MOBILE_MANIPULATOR_RESTRICT mu,
    const double *MOBILE_MANIPULATOR_RESTRICT W,
    const double *MOBILE_MANIPULATOR_RESTRICT amplitude,
    const double *MOBILE_MANIPULATOR_RESTRICT value_bar,
    const double *MOBILE_MANIPULATOR_RESTRICT gradient_bar,
    double *MOBILE_MANIPULATOR_RESTRICT mu_bar,
    double *MOBILE_MANIPULATOR_RESTRICT W_bar,
    double *MOBILE_MANIPULATOR_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 9 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 81 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        double x_block[9][LANES], value_bar_block[1][LANES], gradient_bar_block[9][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const double weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 9; ++i) x_block[i][lane] = x[9 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 9; ++i) gradient_bar_block[i][lane] = gradient_bar[9 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 9; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            double sum[91][LANES] = {{0}}, total[91] = {0};
            const double mu0 = mu[9 * k + 0];
            const double mu1 = mu[9 * k + 1];
            const double mu2 = mu[9 * k + 2];
            const double mu3 = mu[9 * k + 3];
            const double mu4 = mu[9 * k + 4];
            const double mu5 = mu[9 * k + 5];
            const double mu6 = mu[9 * k + 6];
            const double mu7 = mu[9 * k + 7];
            const double mu8 = mu[9 * k + 8];
            const double W0_0 = W[81 * k + 0];
            const double W0_1 = W[81 * k + 1];
            const double W0_2 = W[81 * k + 2];
            const double W0_3 = W[81 * k + 3];
            const double W0_4 = W[81 * k + 4];
            const double W0_5 = W[81 * k + 5];
            const double W0_6 = W[81 * k + 6];
            const double W0_7 = W[81 * k + 7];
            const double W0_8 = W[81 * k + 8];
            const double W1_0 = W[81 * k + 9];
            const double W1_1 = W[81 * k + 10];
            const double W1_2 = W[81 * k + 11];
            const double W1_3 = W[81 * k + 12];
            const double W1_4 = W[81 * k + 13];
            const double W1_5 = W[81 * k + 14];
            const double W1_6 = W[81 * k + 15];
            const double W1_7 = W[81 * k + 16];
            const double W1_8 = W[81 * k + 17];
            const double W2_0 = W[81 * k + 18];
            const double W2_1 = W[81 * k + 19];
            const double W2_2 = W[81 * k + 20];
            const double W2_3 = W[81 * k + 21];
            const double W2_4 = W[81 * k + 22];
            const double W2_5 = W[81 * k + 23];
            const double W2_6 = W[81 * k + 24];
            const double W2_7 = W[81 * k + 25];
            const double W2_8 = W[81 * k + 26];
            const double W3_0 = W[81 * k + 27];
            const double W3_1 = W[81 * k + 28];
            const double W3_2 = W[81 * k + 29];
            const double W3_3 = W[81 * k + 30];
            const double W3_4 = W[81 * k + 31];
            const double W3_5 = W[81 * k + 32];
            const double W3_6 = W[81 * k + 33];
            const double W3_7 = W[81 * k + 34];
            const double W3_8 = W[81 * k + 35];
            const double W4_0 = W[81 * k + 36];
            const double W4_1 = W[81 * k + 37];
            const double W4_2 = W[81 * k + 38];
            const double W4_3 = W[81 * k + 39];
            const double W4_4 = W[81 * k + 40];
            const double W4_5 = W[81 * k + 41];
            const double W4_6 = W[81 * k + 42];
            const double W4_7 = W[81 * k + 43];
            const double W4_8 = W[81 * k + 44];
            const double W5_0 = W[81 * k + 45];
            const double W5_1 = W[81 * k + 46];
            const double W5_2 = W[81 * k + 47];
            const double W5_3 = W[81 * k + 48];
            const double W5_4 = W[81 * k + 49];
            const double W5_5 = W[81 * k + 50];
            const double W5_6 = W[81 * k + 51];
            const double W5_7 = W[81 * k + 52];
            const double W5_8 = W[81 * k + 53];
            const double W6_0 = W[81 * k + 54];
            const double W6_1 = W[81 * k + 55];
            const double W6_2 = W[81 * k + 56];
            const double W6_3 = W[81 * k + 57];
            const double W6_4 = W[81 * k + 58];
            const double W6_5 = W[81 * k + 59];
            const double W6_6 = W[81 * k + 60];
            const double W6_7 = W[81 * k + 61];
            const double W6_8 = W[81 * k + 62];
            const double W7_0 = W[81 * k + 63];
            const double W7_1 = W[81 * k + 64];
            const double W7_2 = W[81 * k + 65];
            const double W7_3 = W[81 * k + 66];
            const double W7_4 = W[81 * k + 67];
            const double W7_5 = W[81 * k + 68];
            const double W7_6 = W[81 * k + 69];
            const double W7_7 = W[81 * k + 70];
            const double W7_8 = W[81 * k + 71];
            const double W8_0 = W[81 * k + 72];
            const double W8_1 = W[81 * k + 73];
            const double W8_2 = W[81 * k + 74];
            const double W8_3 = W[81 * k + 75];
            const double W8_4 = W[81 * k + 76];
            const double W8_5 = W[81 * k + 77];
            const double W8_6 = W[81 * k + 78];
            const double W8_7 = W[81 * k + 79];
            const double W8_8 = W[81 * k + 80];
            const double amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const double v0 = x_block[0][lane] - mu0;
                const double v1 = x_block[1][lane] - mu1;
                const double gap = x_block[2][lane] - mu2;
                const double round_2 = rint(0.15915494309189535 * gap);
                const double v2 = gap - 6.28125 * round_2 - 0.0019350051879882812 * round_2 - 3.019915981956753e-07 *
                    round_2;
                const double gap_2 = x_block[3][lane] - mu3;
                const double round_3 = rint(0.15915494309189535 * gap_2);
                const double v3 = gap_2 - 6.28125 * round_3 - 0.0019350051879882812 * round_3 - 3.019915981956753e-07 *
                    round_3;
                const double gap_3 = x_block[4][lane] - mu4;
                const double round_4 = rint(0.15915494309189535 * gap_3);
                const double v4 = gap_3 - 6.28125 * round_4 - 0.0019350051879882812 * round_4 - 3.019915981956753e-07 *
                    round_4;
                const double gap_4 = x_block[5][lane] - mu5;
                const double round_5 = rint(0.15915494309189535 * gap_4);
                const double v5 = gap_4 - 6.28125 * round_5 - 0.0019350051879882812 * round_5 - 3.019915981956753e-07 *
                    round_5;
                const double gap_5 = x_block[6][lane] - mu6;
                const double round_6 = rint(0.15915494309189535 * gap_5);
                const double v6 = gap_5 - 6.28125 * round_6 - 0.0019350051879882812 * round_6 - 3.019915981956753e-07 *
                    round_6;
                const double gap_6 = x_block[7][lane] - mu7;
                const double round_7 = rint(0.15915494309189535 * gap_6);
                const double v7 = gap_6 - 6.28125 * round_7 - 0.0019350051879882812 * round_7 - 3.019915981956753e-07 *
                    round_7;
                const double gap_7 = x_block[8][lane] - mu8;
                const double round_8 = rint(0.15915494309189535 * gap_7);
                const double v8 = gap_7 - 6.28125 * round_8 - 0.0019350051879882812 * round_8 - 3.019915981956753e-07 *
                    round_8;
                const double total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
                const double z0 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
                const double total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
                const double z1 = total_3 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
                const double total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
                const double z2 = total_4 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
                const double total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
                const double z3 = total_5 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
                const double total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
                const double z4 = total_6 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
                const double total_7 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
                const double z5 = total_7 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
                const double total_8 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
                const double z6 = total_8 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
                const double total_9 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
                const double z7 = total_9 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
                const double total_10 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
                const double z8 = total_10 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
                const double total_11 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
                const double total_12 = total_11 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
                const double exp_2 = exp(-(0.5 * total_12));
                const double phi = amplitude_k * exp_2;
                const double gap_8 = -(W8_8 * z8) - W7_8 * z7 - W6_8 * z6 - W5_8 * z5;
                const double gap_9 = -(W8_7 * z8) - W7_7 * z7 - W6_7 * z6 - W5_7 * z5;
                const double gap_10 = -(W8_6 * z8) - W7_6 * z7 - W6_6 * z6 - W5_6 * z5;
                const double gap_11 = -(W8_5 * z8) - W7_5 * z7 - W6_5 * z6 - W5_5 * z5;
                const double gap_12 = -(W8_4 * z8) - W7_4 * z7 - W6_4 * z6 - W5_4 * z5;
                const double gap_13 = -(W8_3 * z8) - W7_3 * z7 - W6_3 * z6 - W5_3 * z5;
                const double gap_14 = -(W8_2 * z8) - W7_2 * z7 - W6_2 * z6 - W5_2 * z5;
                const double gap_15 = -(W8_1 * z8) - W7_1 * z7 - W6_1 * z6 - W5_1 * z5;
                const double gap_16 = -(W8_0 * z8) - W7_0 * z7 - W6_0 * z6 - W5_0 * z5;
                const double gap_17 = gap_8 - W4_8 * z4 - W3_8 * z3 - W2_8 * z2 - W1_8 * z1;
                const double gap_18 = gap_9 - W4_7 * z4 - W3_7 * z3 - W2_7 * z2 - W1_7 * z1;
                const double gap_19 = gap_10 - W4_6 * z4 - W3_6 * z3 - W2_6 * z2 - W1_6 * z1;
                const double gap_20 = gap_11 - W4_5 * z4 - W3_5 * z3 - W2_5 * z2 - W1_5 * z1;
                const double gap_21 = gap_12 - W4_4 * z4 - W3_4 * z3 - W2_4 * z2 - W1_4 * z1;
                const double gap_22 = gap_13 - W4_3 * z4 - W3_3 * z3 - W2_3 * z2 - W1_3 * z1;
                const double gap_23 = gap_14 - W4_2 * z4 - W3_2 * z3 - W2_2 * z2 - W1_2 * z1;
                const double gap_24 = gap_15 - W4_1 * z4 - W3_1 * z3 - W2_1 * z2 - W1_1 * z1;
                const double gap_25 = gap_16 - W4_0 * z4 - W3_0 * z3 - W2_0 * z2 - W1_0 * z1;
                const double by_v8 = gap_17 - W0_8 * z0;
                const double by_v7 = gap_18 - W0_7 * z0;
                const double by_v6 = gap_19 - W0_6 * z0;
                const double by_v5 = gap_20 - W0_5 * z0;
                const double by_v4 = gap_21 - W0_4 * z0;
                const double by_v3 = gap_22 - W0_3 * z0;
                const double by_v2 = gap_23 - W0_2 * z0;
                const double by_v1 = gap_24 - W0_1 * z0;
                const double by_v0 = gap_25 - W0_0 * z0;
                const double by_df8 = 16.0 * gradient_bar_block[8][lane];
                const double by_df7 = 16.0 * gradient_bar_block[7][lane];
                const double by_df6 = 16.0 * gradient_bar_block[6][lane];
                const double by_df5 = 16.0 * gradient_bar_block[5][lane];
                const double by_df4 = 16.0 * gradient_bar_block[4][lane];
                const double by_df3 = 16.0 * gradient_bar_block[3][lane];
                const double by_df2 = 4.0 * gradient_bar_block[2][lane];
                const double by_by_v8 = phi * by_df8;
                const double by_by_v7 = phi * by_df7;
                const double by_by_v6 = phi * by_df6;
                const double by_by_v5 = phi * by_df5;
                const double total_13 = value_bar_block[0][lane] + by_v8 * by_df8 + by_v7 * by_df7 + by_v6 * by_df6 +
                    by_v5 * by_df5;
                const double by_by_v4 = phi * by_df4;
                const double by_by_v3 = phi * by_df3;
                const double by_by_v2 = phi * by_df2;
                const double by_by_v1 = phi * gradient_bar_block[1][lane];
                const double total_14 = total_13 + by_v4 * by_df4 + by_v3 * by_df3 + by_v2 * by_df2 + by_v1 *
                    gradient_bar_block[1][lane];
                const double by_by_v0 = phi * gradient_bar_block[0][lane];
                const double by_phi = total_14 + by_v0 * gradient_bar_block[0][lane];
                const double gap_26 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - W0_3 * by_by_v3;
                const double gap_27 = gap_26 - W0_4 * by_by_v4 - W0_5 * by_by_v5 - W0_6 * by_by_v6 - W0_7 * by_by_v7;
                const double gap_28 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - W1_3 * by_by_v3;
                const double gap_29 = gap_28 - W1_4 * by_by_v4 - W1_5 * by_by_v5 - W1_6 * by_by_v6 - W1_7 * by_by_v7;
                const double gap_30 = -(W2_0 * by_by_v0) - W2_1 * by_by_v1 - W2_2 * by_by_v2 - W2_3 * by_by_v3;
                const double gap_31 = gap_30 - W2_4 * by_by_v4 - W2_5 * by_by_v5 - W2_6 * by_by_v6 - W2_7 * by_by_v7;
                const double gap_32 = -(W3_0 * by_by_v0) - W3_1 * by_by_v1 - W3_2 * by_by_v2 - W3_3 * by_by_v3;
                const double gap_33 = gap_32 - W3_4 * by_by_v4 - W3_5 * by_by_v5 - W3_6 * by_by_v6 - W3_7 * by_by_v7;
                const double gap_34 = -(W4_0 * by_by_v0) - W4_1 * by_by_v1 - W4_2 * by_by_v2 - W4_3 * by_by_v3;
                const double gap_35 = gap_34 - W4_4 * by_by_v4 - W4_5 * by_by_v5 - W4_6 * by_by_v6 - W4_7 * by_by_v7;
                const double gap_36 = -(W5_0 * by_by_v0) - W5_1 * by_by_v1 - W5_2 * by_by_v2 - W5_3 * by_by_v3;
                const double gap_37 = gap_36 - W5_4 * by_by_v4 - W5_5 * by_by_v5 - W5_6 * by_by_v6 - W5_7 * by_by_v7;
                const double gap_38 = -(W6_0 * by_by_v0) - W6_1 * by_by_v1 - W6_2 * by_by_v2 - W6_3 * by_by_v3;
                const double gap_39 = gap_38 - W6_4 * by_by_v4 - W6_5 * by_by_v5 - W6_6 * by_by_v6 - W6_7 * by_by_v7;
                const double gap_40 = -(W7_0 * by_by_v0) - W7_1 * by_by_v1 - W7_2 * by_by_v2 - W7_3 * by_by_v3;
                const double gap_41 = gap_40 - W7_4 * by_by_v4 - W7_5 * by_by_v5 - W7_6 * by_by_v6 - W7_7 * by_by_v7;
                const double gap_42 = -(W8_0 * by_by_v0) - W8_1 * by_by_v1 - W8_2 * by_by_v2 - W8_3 * by_by_v3;
                const double gap_43 = gap_42 - W8_4 * by_by_v4 - W8_5 * by_by_v5 - W8_6 * by_by_v6 - W8_7 * by_by_v7;
                const double product = exp_2 * (amplitude_k * by_phi);
                const double by_z8 = gap_43 - W8_8 * by_by_v8 - z8 * product;
                const double by_z7 = gap_41 - W7_8 * by_by_v8 - z7 * product;
                const double by_z6 = gap_39 - W6_8 * by_by_v8 - z6 * product;
                const double by_z5 = gap_37 - W5_8 * by_by_v8 - z5 * product;
                const double by_z4 = gap_35 - W4_8 * by_by_v8 - z4 * product;
                const double by_z3 = gap_33 - W3_8 * by_by_v8 - z3 * product;
                const double by_z2 = gap_31 - W2_8 * by_by_v8 - z2 * product;
                const double by_z1 = gap_29 - W1_8 * by_by_v8 - z1 * product;
                const double by_z0 = gap_27 - W0_8 * by_by_v8 - z0 * product;
                const double total_15 = W8_8 * by_z8 + W7_8 * by_z7 + W6_8 * by_z6 + W5_8 * by_z5 + W4_8 * by_z4;
                const double total_16 = W8_7 * by_z8 + W7_7 * by_z7 + W6_7 * by_z6 + W5_7 * by_z5 + W4_7 * by_z4;
                const double total_17 = W8_6 * by_z8 + W7_6 * by_z7 + W6_6 * by_z6 + W5_6 * by_z5 + W4_6 * by_z4;
                const double total_18 = W8_5 * by_z8 + W7_5 * by_z7 + W6_5 * by_z6 + W5_5 * by_z5 + W4_5 * by_z4;
                const double total_19 = W8_4 * by_z8 + W7_4 * by_z7 + W6_4 * by_z6 + W5_4 * by_z5 + W4_4 * by_z4;
                const double total_20 = W8_3 * by_z8 + W7_3 * by_z7 + W6_3 * by_z6 + W5_3 * by_z5 + W4_3 * by_z4;
                const double total_21 = W8_2 * by_z8 + W7_2 * by_z7 + W6_2 * by_z6 + W5_2 * by_z5 + W4_2 * by_z4;
                const double total_22 = W8_1 * by_z8 + W7_1 * by_z7 + W6_1 * by_z6 + W5_1 * by_z5 + W4_1 * by_z4;
                const double total_23 = W8_0 * by_z8 + W7_0 * by_z7 + W6_0 * by_z6 + W5_0 * by_z5 + W4_0 * by_z4;
                const double by_v8_2 = total_15 + W3_8 * by_z3 + W2_8 * by_z2 + W1_8 * by_z1 + W0_8 * by_z0;
                const double by_v7_2 = total_16 + W3_7 * by_z3 + W2_7 * by_z2 + W1_7 * by_z1 + W0_7 * by_z0;
                const double by_v6_2 = total_17 + W3_6 * by_z3 + W2_6 * by_z2 + W1_6 * by_z1 + W0_6 * by_z0;
                const double by_v5_2 = total_18 + W3_5 * by_z3 + W2_5 * by_z2 + W1_5 * by_z1 + W0_5 * by_z0;
                const double by_v4_2 = total_19 + W3_4 * by_z3 + W2_4 * by_z2 + W1_4 * by_z1 + W0_4 * by_z0;
                const double by_v3_2 = total_20 + W3_3 * by_z3 + W2_3 * by_z2 + W1_3 * by_z1 + W0_3 * by_z0;
                const double by_v2_2 = total_21 + W3_2 * by_z3 + W2_2 * by_z2 + W1_2 * by_z1 + W0_2 * by_z0;
                const double by_v1_2 = total_22 + W3_1 * by_z3 + W2_1 * by_z2 + W1_1 * by_z1 + W0_1 * by_z0;
                const double by_v0_2 = total_23 + W3_0 * by_z3 + W2_0 * by_z2 + W1_0 * by_z1 + W0_0 * by_z0;
                sum[0][lane] += -by_v0_2;
                sum[1][lane] += -by_v1_2;
                sum[2][lane] += -by_v2_2;
                sum[3][lane] += -by_v3_2;
                sum[4][lane] += -by_v4_2;
                sum[5][lane] += -by_v5_2;
                sum[6][lane] += -by_v6_2;
                sum[7][lane] += -by_v7_2;
                sum[8][lane] += -by_v8_2;
                sum[9][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[10][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[11][lane] += v2 * by_z0 - z0 * by_by_v2;
                sum[12][lane] += v3 * by_z0 - z0 * by_by_v3;
                sum[13][lane] += v4 * by_z0 - z0 * by_by_v4;
                sum[14][lane] += v5 * by_z0 - z0 * by_by_v5;
                sum[15][lane] += v6 * by_z0 - z0 * by_by_v6;
                sum[16][lane] += v7 * by_z0 - z0 * by_by_v7;
                sum[17][lane] += v8 * by_z0 - z0 * by_by_v8;
                sum[18][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[19][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[20][lane] += v2 * by_z1 - z1 * by_by_v2;
                sum[21][lane] += v3 * by_z1 - z1 * by_by_v3;
                sum[22][lane] += v4 * by_z1 - z1 * by_by_v4;
                sum[23][lane] += v5 * by_z1 - z1 * by_by_v5;
                sum[24][lane] += v6 * by_z1 - z1 * by_by_v6;
                sum[25][lane] += v7 * by_z1 - z1 * by_by_v7;
                sum[26][lane] += v8 * by_z1 - z1 * by_by_v8;
                sum[27][lane] += v0 * by_z2 - z2 * by_by_v0;
                sum[28][lane] += v1 * by_z2 - z2 * by_by_v1;
                sum[29][lane] += v2 * by_z2 - z2 * by_by_v2;
                sum[30][lane] += v3 * by_z2 - z2 * by_by_v3;
                sum[31][lane] += v4 * by_z2 - z2 * by_by_v4;
                sum[32][lane] += v5 * by_z2 - z2 * by_by_v5;
                sum[33][lane] += v6 * by_z2 - z2 * by_by_v6;
                sum[34][lane] += v7 * by_z2 - z2 * by_by_v7;
                sum[35][lane] += v8 * by_z2 - z2 * by_by_v8;
                sum[36][lane] += v0 * by_z3 - z3 * by_by_v0;
                sum[37][lane] += v1 * by_z3 - z3 * by_by_v1;
                sum[38][lane] += v2 * by_z3 - z3 * by_by_v2;
                sum[39][lane] += v3 * by_z3 - z3 * by_by_v3;
                sum[40][lane] += v4 * by_z3 - z3 * by_by_v4;
                sum[41][lane] += v5 * by_z3 - z3 * by_by_v5;
                sum[42][lane] += v6 * by_z3 - z3 * by_by_v6;
                sum[43][lane] += v7 * by_z3 - z3 * by_by_v7;
                sum[44][lane] += v8 * by_z3 - z3 * by_by_v8;
                sum[45][lane] += v0 * by_z4 - z4 * by_by_v0;
                sum[46][lane] += v1 * by_z4 - z4 * by_by_v1;
                sum[47][lane] += v2 * by_z4 - z4 * by_by_v2;
                sum[48][lane] += v3 * by_z4 - z4 * by_by_v3;
                sum[49][lane] += v4 * by_z4 - z4 * by_by_v4;
                sum[50][lane] += v5 * by_z4 - z4 * by_by_v5;
                sum[51][lane] += v6 * by_z4 - z4 * by_by_v6;
                sum[52][lane] += v7 * by_z4 - z4 * by_by_v7;
                sum[53][lane] += v8 * by_z4 - z4 * by_by_v8;
                sum[54][lane] += v0 * by_z5 - z5 * by_by_v0;
                sum[55][lane] += v1 * by_z5 - z5 * by_by_v1;
                sum[56][lane] += v2 * by_z5 - z5 * by_by_v2;
                sum[57][lane] += v3 * by_z5 - z5 * by_by_v3;
                sum[58][lane] += v4 * by_z5 - z5 * by_by_v4;
                sum[59][lane] += v5 * by_z5 - z5 * by_by_v5;
                sum[60][lane] += v6 * by_z5 - z5 * by_by_v6;
                sum[61][lane] += v7 * by_z5 - z5 * by_by_v7;
                sum[62][lane] += v8 * by_z5 - z5 * by_by_v8;
                sum[63][lane] += v0 * by_z6 - z6 * by_by_v0;
                sum[64][lane] += v1 * by_z6 - z6 * by_by_v1;
                sum[65][lane] += v2 * by_z6 - z6 * by_by_v2;
                sum[66][lane] += v3 * by_z6 - z6 * by_by_v3;
                sum[67][lane] += v4 * by_z6 - z6 * by_by_v4;
                sum[68][lane] += v5 * by_z6 - z6 * by_by_v5;
                sum[69][lane] += v6 * by_z6 - z6 * by_by_v6;
                sum[70][lane] += v7 * by_z6 - z6 * by_by_v7;
                sum[71][lane] += v8 * by_z6 - z6 * by_by_v8;
                sum[72][lane] += v0 * by_z7 - z7 * by_by_v0;
                sum[73][lane] += v1 * by_z7 - z7 * by_by_v1;
                sum[74][lane] += v2 * by_z7 - z7 * by_by_v2;
                sum[75][lane] += v3 * by_z7 - z7 * by_by_v3;
                sum[76][lane] += v4 * by_z7 - z7 * by_by_v4;
                sum[77][lane] += v5 * by_z7 - z7 * by_by_v5;
                sum[78][lane] += v6 * by_z7 - z7 * by_by_v6;
                sum[79][lane] += v7 * by_z7 - z7 * by_by_v7;
                sum[80][lane] += v8 * by_z7 - z7 * by_by_v8;
                sum[81][lane] += v0 * by_z8 - z8 * by_by_v0;
                sum[82][lane] += v1 * by_z8 - z8 * by_by_v1;
                sum[83][lane] += v2 * by_z8 - z8 * by_by_v2;
                sum[84][lane] += v3 * by_z8 - z8 * by_by_v3;
                sum[85][lane] += v4 * by_z8 - z8 * by_by_v4;
                sum[86][lane] += v5 * by_z8 - z8 * by_by_v5;
                sum[87][lane] += v6 * by_z8 - z8 * by_by_v6;
                sum[88][lane] += v7 * by_z8 - z8 * by_by_v7;
                sum[89][lane] += v8 * by_z8 - z8 * by_by_v8;
                sum[90][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 91; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[9 * k + 0] += total[0];
            mu_bar[9 * k + 1] += total[1];
            mu_bar[9 * k + 2] += total[2];
            mu_bar[9 * k + 3] += total[3];
            mu_bar[9 * k + 4] += total[4];
            mu_bar[9 * k + 5] += total[5];
            mu_bar[9 * k + 6] += total[6];
            mu_bar[9 * k + 7] += total[7];
            mu_bar[9 * k + 8] += total[8];
            W_bar[81 * k + 0] += total[9];
            W_bar[81 * k + 1] += total[10];
            W_bar[81 * k + 2] += total[11];
            W_bar[81 * k + 3] += total[12];
            W_bar[81 * k + 4] += total[13];
            W_bar[81 * k + 5] += total[14];
            W_bar[81 * k + 6] += total[15];
            W_bar[81 * k + 7] += total[16];
            W_bar[81 * k + 8] += total[17];
            W_bar[81 * k + 9] += total[18];
            W_bar[81 * k + 10] += total[19];
            W_bar[81 * k + 11] += total[20];
            W_bar[81 * k + 12] += total[21];
            W_bar[81 * k + 13] += total[22];
            W_bar[81 * k + 14] += total[23];
            W_bar[81 * k + 15] += total[24];
            W_bar[81 * k + 16] += total[25];
            W_bar[81 * k + 17] += total[26];
            W_bar[81 * k + 18] += total[27];
            W_bar[81 * k + 19] += total[28];
            W_bar[81 * k + 20] += total[29];
            W_bar[81 * k + 21] += total[30];
            W_bar[81 * k + 22] += total[31];
            W_bar[81 * k + 23] += total[32];
            W_bar[81 * k + 24] += total[33];
            W_bar[81 * k + 25] += total[34];
            W_bar[81 * k + 26] += total[35];
            W_bar[81 * k + 27] += total[36];
            W_bar[81 * k + 28] += total[37];
            W_bar[81 * k + 29] += total[38];
            W_bar[81 * k + 30] += total[39];
            W_bar[81 * k + 31] += total[40];
            W_bar[81 * k + 32] += total[41];
            W_bar[81 * k + 33] += total[42];
            W_bar[81 * k + 34] += total[43];
            W_bar[81 * k + 35] += total[44];
            W_bar[81 * k + 36] += total[45];
            W_bar[81 * k + 37] += total[46];
            W_bar[81 * k + 38] += total[47];
            W_bar[81 * k + 39] += total[48];
            W_bar[81 * k + 40] += total[49];
            W_bar[81 * k + 41] += total[50];
            W_bar[81 * k + 42] += total[51];
            W_bar[81 * k + 43] += total[52];
            W_bar[81 * k + 44] += total[53];
            W_bar[81 * k + 45] += total[54];
            W_bar[81 * k + 46] += total[55];
            W_bar[81 * k + 47] += total[56];
            W_bar[81 * k + 48] += total[57];
            W_bar[81 * k + 49] += total[58];
            W_bar[81 * k + 50] += total[59];
            W_bar[81 * k + 51] += total[60];
            W_bar[81 * k + 52] += total[61];
            W_bar[81 * k + 53] += total[62];
            W_bar[81 * k + 54] += total[63];
            W_bar[81 * k + 55] += total[64];
            W_bar[81 * k + 56] += total[65];
            W_bar[81 * k + 57] += total[66];
            W_bar[81 * k + 58] += total[67];
            W_bar[81 * k + 59] += total[68];
            W_bar[81 * k + 60] += total[69];
            W_bar[81 * k + 61] += total[70];
            W_bar[81 * k + 62] += total[71];
            W_bar[81 * k + 63] += total[72];
            W_bar[81 * k + 64] += total[73];
            W_bar[81 * k + 65] += total[74];
            W_bar[81 * k + 66] += total[75];
            W_bar[81 * k + 67] += total[76];
            W_bar[81 * k + 68] += total[77];
            W_bar[81 * k + 69] += total[78];
            W_bar[81 * k + 70] += total[79];
            W_bar[81 * k + 71] += total[80];
            W_bar[81 * k + 72] += total[81];
            W_bar[81 * k + 73] += total[82];
            W_bar[81 * k + 74] += total[83];
            W_bar[81 * k + 75] += total[84];
            W_bar[81 * k + 76] += total[85];
            W_bar[81 * k + 77] += total[86];
            W_bar[81 * k + 78] += total[87];
            W_bar[81 * k + 79] += total[88];
            W_bar[81 * k + 80] += total[89];
            amplitude_bar[1 * k + 0] += total[90];
        }
    }
    restore_denormals(mode);
}

void mobile_manipulator_splats_f(
    size_t count,
    size_t splat_count,
    const float *MOBILE_MANIPULATOR_RESTRICT x,
    const float *MOBILE_MANIPULATOR_RESTRICT mu,
    const float *MOBILE_MANIPULATOR_RESTRICT W,
    const float *MOBILE_MANIPULATOR_RESTRICT amplitude,
    float *MOBILE_MANIPULATOR_RESTRICT value,
    float *MOBILE_MANIPULATOR_RESTRICT gradient) {
    const unsigned mode = flush_denormals();
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[9][LANES], sum[10][LANES] = {{0}};
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            for (size_t i = 0; i < 9; ++i) x_block[i][lane] = x[9 * n + i];
        }
        for (size_t k = 0; k < splat_count; ++k) {
            const float mu0 = mu[9 * k + 0];
            const float mu1 = mu[9 * k + 1];
            const float mu2 = mu[9 * k + 2];
            const float mu3 = mu[9 * k + 3];
            const float mu4 = mu[9 * k + 4];
            const float mu5 = mu[9 * k + 5];
            const float mu6 = mu[9 * k + 6];
            const float mu7 = mu[9 * k + 7];
            const float mu8 = mu[9 * k + 8];
            const float W0_0 = W[81 * k + 0];
            const float W0_1 = W[81 * k + 1];
            const float W0_2 = W[81 * k + 2];
            const float W0_3 = W[81 * k + 3];
            const float W0_4 = W[81 * k + 4];
            const float W0_5 = W[81 * k + 5];
            const float W0_6 = W[81 * k + 6];
            const float W0_7 = W[81 * k + 7];
            const float W0_8 = W[81 * k + 8];
            const float W1_0 = W[81 * k + 9];
            const float W1_1 = W[81 * k + 10];
            const float W1_2 = W[81 * k + 11];
            const float W1_3 = W[81 * k + 12];
            const float W1_4 = W[81 * k + 13];
            const float W1_5 = W[81 * k + 14];
            const float W1_6 = W[81 * k + 15];
            const float W1_7 = W[81 * k + 16];
            const float W1_8 = W[81 * k + 17];
            const float W2_0 = W[81 * k + 18];
            const float W2_1 = W[81 * k + 19];
            const float W2_2 = W[81 * k + 20];
            const float W2_3 = W[81 * k + 21];
            const float W2_4 = W[81 * k + 22];
            const float W2_5 = W[81 * k + 23];
            const float W2_6 = W[81 * k + 24];
            const float W2_7 = W[81 * k + 25];
            const float W2_8 = W[81 * k + 26];
            const float W3_0 = W[81 * k + 27];
            const float W3_1 = W[81 * k + 28];
            const float W3_2 = W[81 * k + 29];
            const float W3_3 = W[81 * k + 30];
            const float W3_4 = W[81 * k + 31];
            const float W3_5 = W[81 * k + 32];
            const float W3_6 = W[81 * k + 33];
            const float W3_7 = W[81 * k + 34];
            const float W3_8 = W[81 * k + 35];
            const float W4_0 = W[81 * k + 36];
            const float W4_1 = W[81 * k + 37];
            const float W4_2 = W[81 * k + 38];
            const float W4_3 = W[81 * k + 39];
            const float W4_4 = W[81 * k + 40];
            const float W4_5 = W[81 * k + 41];
            const float W4_6 = W[81 * k + 42];
            const float W4_7 = W[81 * k + 43];
            const float W4_8 = W[81 * k + 44];
            const float W5_0 = W[81 * k + 45];
            const float W5_1 = W[81 * k + 46];
            const float W5_2 = W[81 * k + 47];
            const float W5_3 = W[81 * k + 48];
            const float W5_4 = W[81 * k + 49];
            const float W5_5 = W[81 * k + 50];
            const float W5_6 = W[81 * k + 51];
            const float W5_7 = W[81 * k + 52];
            const float W5_8 = W[81 * k + 53];
            const float W6_0 = W[81 * k + 54];
            const float W6_1 = W[81 * k + 55];
            const float W6_2 = W[81 * k + 56];
            const float W6_3 = W[81 * k + 57];
            const float W6_4 = W[81 * k + 58];
            const float W6_5 = W[81 * k + 59];
            const float W6_6 = W[81 * k + 60];
            const float W6_7 = W[81 * k + 61];
            const float W6_8 = W[81 * k + 62];
            const float W7_0 = W[81 * k + 63];
            const float W7_1 = W[81 * k + 64];
            const float W7_2 = W[81 * k + 65];
            const float W7_3 = W[81 * k + 66];
            const float W7_4 = W[81 * k + 67];
            const float W7_5 = W[81 * k + 68];
            const float W7_6 = W[81 * k + 69];
            const float W7_7 = W[81 * k + 70];
            const float W7_8 = W[81 * k + 71];
            const float W8_0 = W[81 * k + 72];
            const float W8_1 = W[81 * k + 73];
            const float W8_2 = W[81 * k + 74];
            const float W8_3 = W[81 * k + 75];
            const float W8_4 = W[81 * k + 76];
            const float W8_5 = W[81 * k + 77];
            const float W8_6 = W[81 * k + 78];
            const float W8_7 = W[81 * k + 79];
            const float W8_8 = W[81 * k + 80];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float v0 = x_block[0][lane] - mu0;
                const float v1 = x_block[1][lane] - mu1;
                const float gap = x_block[2][lane] - mu2;
                const float round_2 = rintf(0.15915494309189535f * gap);
                const float v2 = gap - 6.28125f * round_2 - 0.0019350051879882812f * round_2 - 3.019915981956753e-07f *
                    round_2;
                const float gap_2 = x_block[3][lane] - mu3;
                const float round_3 = rintf(0.15915494309189535f * gap_2);
                const float v3 = gap_2 - 6.28125f * round_3 - 0.0019350051879882812f * round_3 - 3.019915981956753e-07f *
                    round_3;
                const float gap_3 = x_block[4][lane] - mu4;
                const float round_4 = rintf(0.15915494309189535f * gap_3);
                const float v4 = gap_3 - 6.28125f * round_4 - 0.0019350051879882812f * round_4 - 3.019915981956753e-07f *
                    round_4;
                const float gap_4 = x_block[5][lane] - mu5;
                const float round_5 = rintf(0.15915494309189535f * gap_4);
                const float v5 = gap_4 - 6.28125f * round_5 - 0.0019350051879882812f * round_5 - 3.019915981956753e-07f *
                    round_5;
                const float gap_5 = x_block[6][lane] - mu6;
                const float round_6 = rintf(0.15915494309189535f * gap_5);
                const float v6 = gap_5 - 6.28125f * round_6 - 0.0019350051879882812f * round_6 - 3.019915981956753e-07f *
                    round_6;
                const float gap_6 = x_block[7][lane] - mu7;
                const float round_7 = rintf(0.15915494309189535f * gap_6);
                const float v7 = gap_6 - 6.28125f * round_7 - 0.0019350051879882812f * round_7 - 3.019915981956753e-07f *
                    round_7;
                const float gap_7 = x_block[8][lane] - mu8;
                const float round_8 = rintf(0.15915494309189535f * gap_7);
                const float v8 = gap_7 - 6.28125f * round_8 - 0.0019350051879882812f * round_8 - 3.019915981956753e-07f *
                    round_8;
                const float total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
                const float z0 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
                const float total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
                const float z1 = total_3 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
                const float total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
                const float z2 = total_4 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
                const float total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
                const float z3 = total_5 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
                const float total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
                const float z4 = total_6 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
                const float total_7 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
                const float z5 = total_7 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
                const float total_8 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
                const float z6 = total_8 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
                const float total_9 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
                const float z7 = total_9 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
                const float total_10 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
                const float z8 = total_10 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
                const float total_11 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
                const float total_12 = total_11 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
                const float phi = amplitude_k * expf(-(0.5f * total_12));
                const float gap_8 = -(W8_8 * z8) - W7_8 * z7 - W6_8 * z6 - W5_8 * z5;
                const float gap_9 = -(W8_7 * z8) - W7_7 * z7 - W6_7 * z6 - W5_7 * z5;
                const float gap_10 = -(W8_6 * z8) - W7_6 * z7 - W6_6 * z6 - W5_6 * z5;
                const float gap_11 = -(W8_5 * z8) - W7_5 * z7 - W6_5 * z6 - W5_5 * z5;
                const float gap_12 = -(W8_4 * z8) - W7_4 * z7 - W6_4 * z6 - W5_4 * z5;
                const float gap_13 = -(W8_3 * z8) - W7_3 * z7 - W6_3 * z6 - W5_3 * z5;
                const float gap_14 = -(W8_2 * z8) - W7_2 * z7 - W6_2 * z6 - W5_2 * z5;
                const float gap_15 = -(W8_1 * z8) - W7_1 * z7 - W6_1 * z6 - W5_1 * z5;
                const float gap_16 = -(W8_0 * z8) - W7_0 * z7 - W6_0 * z6 - W5_0 * z5;
                const float gap_17 = gap_8 - W4_8 * z4 - W3_8 * z3 - W2_8 * z2 - W1_8 * z1;
                const float gap_18 = gap_9 - W4_7 * z4 - W3_7 * z3 - W2_7 * z2 - W1_7 * z1;
                const float gap_19 = gap_10 - W4_6 * z4 - W3_6 * z3 - W2_6 * z2 - W1_6 * z1;
                const float gap_20 = gap_11 - W4_5 * z4 - W3_5 * z3 - W2_5 * z2 - W1_5 * z1;
                const float gap_21 = gap_12 - W4_4 * z4 - W3_4 * z3 - W2_4 * z2 - W1_4 * z1;
                const float gap_22 = gap_13 - W4_3 * z4 - W3_3 * z3 - W2_3 * z2 - W1_3 * z1;
                const float gap_23 = gap_14 - W4_2 * z4 - W3_2 * z3 - W2_2 * z2 - W1_2 * z1;
                const float gap_24 = gap_15 - W4_1 * z4 - W3_1 * z3 - W2_1 * z2 - W1_1 * z1;
                const float gap_25 = gap_16 - W4_0 * z4 - W3_0 * z3 - W2_0 * z2 - W1_0 * z1;
                const float by_v8 = gap_17 - W0_8 * z0;
                const float by_v7 = gap_18 - W0_7 * z0;
                const float by_v6 = gap_19 - W0_6 * z0;
                const float by_v5 = gap_20 - W0_5 * z0;
                const float by_v4 = gap_21 - W0_4 * z0;
                const float by_v3 = gap_22 - W0_3 * z0;
                const float by_v2 = gap_23 - W0_2 * z0;
                const float by_v1 = gap_24 - W0_1 * z0;
                const float by_v0 = gap_25 - W0_0 * z0;
                const float df0 = phi * by_v0;
                const float df1 = phi * by_v1;
                const float df2 = phi * by_v2;
                const float df3 = phi * by_v3;
                const float df4 = phi * by_v4;
                const float df5 = phi * by_v5;
                const float df6 = phi * by_v6;
                const float df7 = phi * by_v7;
                const float df8 = phi * by_v8;
                const float gradient2 = 4.0f * df2;
                const float gradient3 = 16.0f * df3;
                const float gradient4 = 16.0f * df4;
                const float gradient5 = 16.0f * df5;
                const float gradient6 = 16.0f * df6;
                const float gradient7 = 16.0f * df7;
                const float gradient8 = 16.0f * df8;
                sum[0][lane] += phi;
                sum[1][lane] += df0;
                sum[2][lane] += df1;
                sum[3][lane] += gradient2;
                sum[4][lane] += gradient3;
                sum[5][lane] += gradient4;
                sum[6][lane] += gradient5;
                sum[7][lane] += gradient6;
                sum[8][lane] += gradient7;
                sum[9][lane] += gradient8;
            }
        }
        for (size_t lane = 0; lane < lanes; ++lane) {
            value[start + lane] = sum[0][lane];
            for (size_t i = 0; i < 9; ++i) gradient[9 * (start + lane) + i] = sum[i + 1][lane];
        }
    }
    restore_denormals(mode);
}

void mobile_manipulator_splats_vjp_f(
    size_t count,
    size_t splat_count,
    const float *MOBILE_MANIPULATOR_RESTRICT x,
    const float *MOBILE_MANIPULATOR_RESTRICT mu,
    const float *MOBILE_MANIPULATOR_RESTRICT W,
    const float *MOBILE_MANIPULATOR_RESTRICT amplitude,
    const float *MOBILE_MANIPULATOR_RESTRICT value_bar,
    const float *MOBILE_MANIPULATOR_RESTRICT gradient_bar,
    float *MOBILE_MANIPULATOR_RESTRICT mu_bar,
    float *MOBILE_MANIPULATOR_RESTRICT W_bar,
    float *MOBILE_MANIPULATOR_RESTRICT amplitude_bar) {
    const unsigned mode = flush_denormals();
    for (size_t i = 0; i < 9 * splat_count; ++i) mu_bar[i] = 0;
    for (size_t i = 0; i < 81 * splat_count; ++i) W_bar[i] = 0;
    for (size_t i = 0; i < 1 * splat_count; ++i) amplitude_bar[i] = 0;
    for (size_t start = 0; start < count; start += LANES) {
        const size_t lanes = count - start < LANES ? count - start : LANES;
        float x_block[9][LANES], value_bar_block[1][LANES], gradient_bar_block[9][LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t n = start + (lane < lanes ? lane : lanes - 1);
            const float weight = lane < lanes ? 1 : 0;
            for (size_t i = 0; i < 9; ++i) x_block[i][lane] = x[9 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] = value_bar[1 * n + i];
            for (size_t i = 0; i < 9; ++i) gradient_bar_block[i][lane] = gradient_bar[9 * n + i];
            for (size_t i = 0; i < 1; ++i) value_bar_block[i][lane] *= weight;
            for (size_t i = 0; i < 9; ++i) gradient_bar_block[i][lane] *= weight;
        }
        for (size_t k = 0; k < splat_count; ++k) {
            float sum[91][LANES] = {{0}}, total[91] = {0};
            const float mu0 = mu[9 * k + 0];
            const float mu1 = mu[9 * k + 1];
            const float mu2 = mu[9 * k + 2];
            const float mu3 = mu[9 * k + 3];
            const float mu4 = mu[9 * k + 4];
            const float mu5 = mu[9 * k + 5];
            const float mu6 = mu[9 * k + 6];
            const float mu7 = mu[9 * k + 7];
            const float mu8 = mu[9 * k + 8];
            const float W0_0 = W[81 * k + 0];
            const float W0_1 = W[81 * k + 1];
            const float W0_2 = W[81 * k + 2];
            const float W0_3 = W[81 * k + 3];
            const float W0_4 = W[81 * k + 4];
            const float W0_5 = W[81 * k + 5];
            const float W0_6 = W[81 * k + 6];
            const float W0_7 = W[81 * k + 7];
            const float W0_8 = W[81 * k + 8];
            const float W1_0 = W[81 * k + 9];
            const float W1_1 = W[81 * k + 10];
            const float W1_2 = W[81 * k + 11];
            const float W1_3 = W[81 * k + 12];
            const float W1_4 = W[81 * k + 13];
            const float W1_5 = W[81 * k + 14];
            const float W1_6 = W[81 * k + 15];
            const float W1_7 = W[81 * k + 16];
            const float W1_8 = W[81 * k + 17];
            const float W2_0 = W[81 * k + 18];
            const float W2_1 = W[81 * k + 19];
            const float W2_2 = W[81 * k + 20];
            const float W2_3 = W[81 * k + 21];
            const float W2_4 = W[81 * k + 22];
            const float W2_5 = W[81 * k + 23];
            const float W2_6 = W[81 * k + 24];
            const float W2_7 = W[81 * k + 25];
            const float W2_8 = W[81 * k + 26];
            const float W3_0 = W[81 * k + 27];
            const float W3_1 = W[81 * k + 28];
            const float W3_2 = W[81 * k + 29];
            const float W3_3 = W[81 * k + 30];
            const float W3_4 = W[81 * k + 31];
            const float W3_5 = W[81 * k + 32];
            const float W3_6 = W[81 * k + 33];
            const float W3_7 = W[81 * k + 34];
            const float W3_8 = W[81 * k + 35];
            const float W4_0 = W[81 * k + 36];
            const float W4_1 = W[81 * k + 37];
            const float W4_2 = W[81 * k + 38];
            const float W4_3 = W[81 * k + 39];
            const float W4_4 = W[81 * k + 40];
            const float W4_5 = W[81 * k + 41];
            const float W4_6 = W[81 * k + 42];
            const float W4_7 = W[81 * k + 43];
            const float W4_8 = W[81 * k + 44];
            const float W5_0 = W[81 * k + 45];
            const float W5_1 = W[81 * k + 46];
            const float W5_2 = W[81 * k + 47];
            const float W5_3 = W[81 * k + 48];
            const float W5_4 = W[81 * k + 49];
            const float W5_5 = W[81 * k + 50];
            const float W5_6 = W[81 * k + 51];
            const float W5_7 = W[81 * k + 52];
            const float W5_8 = W[81 * k + 53];
            const float W6_0 = W[81 * k + 54];
            const float W6_1 = W[81 * k + 55];
            const float W6_2 = W[81 * k + 56];
            const float W6_3 = W[81 * k + 57];
            const float W6_4 = W[81 * k + 58];
            const float W6_5 = W[81 * k + 59];
            const float W6_6 = W[81 * k + 60];
            const float W6_7 = W[81 * k + 61];
            const float W6_8 = W[81 * k + 62];
            const float W7_0 = W[81 * k + 63];
            const float W7_1 = W[81 * k + 64];
            const float W7_2 = W[81 * k + 65];
            const float W7_3 = W[81 * k + 66];
            const float W7_4 = W[81 * k + 67];
            const float W7_5 = W[81 * k + 68];
            const float W7_6 = W[81 * k + 69];
            const float W7_7 = W[81 * k + 70];
            const float W7_8 = W[81 * k + 71];
            const float W8_0 = W[81 * k + 72];
            const float W8_1 = W[81 * k + 73];
            const float W8_2 = W[81 * k + 74];
            const float W8_3 = W[81 * k + 75];
            const float W8_4 = W[81 * k + 76];
            const float W8_5 = W[81 * k + 77];
            const float W8_6 = W[81 * k + 78];
            const float W8_7 = W[81 * k + 79];
            const float W8_8 = W[81 * k + 80];
            const float amplitude_k = amplitude[1 * k + 0];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const float v0 = x_block[0][lane] - mu0;
                const float v1 = x_block[1][lane] - mu1;
                const float gap = x_block[2][lane] - mu2;
                const float round_2 = rintf(0.15915494309189535f * gap);
                const float v2 = gap - 6.28125f * round_2 - 0.0019350051879882812f * round_2 - 3.019915981956753e-07f *
                    round_2;
                const float gap_2 = x_block[3][lane] - mu3;
                const float round_3 = rintf(0.15915494309189535f * gap_2);
                const float v3 = gap_2 - 6.28125f * round_3 - 0.0019350051879882812f * round_3 - 3.019915981956753e-07f *
                    round_3;
                const float gap_3 = x_block[4][lane] - mu4;
                const float round_4 = rintf(0.15915494309189535f * gap_3);
                const float v4 = gap_3 - 6.28125f * round_4 - 0.0019350051879882812f * round_4 - 3.019915981956753e-07f *
                    round_4;
                const float gap_4 = x_block[5][lane] - mu5;
                const float round_5 = rintf(0.15915494309189535f * gap_4);
                const float v5 = gap_4 - 6.28125f * round_5 - 0.0019350051879882812f * round_5 - 3.019915981956753e-07f *
                    round_5;
                const float gap_5 = x_block[6][lane] - mu6;
                const float round_6 = rintf(0.15915494309189535f * gap_5);
                const float v6 = gap_5 - 6.28125f * round_6 - 0.0019350051879882812f * round_6 - 3.019915981956753e-07f *
                    round_6;
                const float gap_6 = x_block[7][lane] - mu7;
                const float round_7 = rintf(0.15915494309189535f * gap_6);
                const float v7 = gap_6 - 6.28125f * round_7 - 0.0019350051879882812f * round_7 - 3.019915981956753e-07f *
                    round_7;
                const float gap_7 = x_block[8][lane] - mu8;
                const float round_8 = rintf(0.15915494309189535f * gap_7);
                const float v8 = gap_7 - 6.28125f * round_8 - 0.0019350051879882812f * round_8 - 3.019915981956753e-07f *
                    round_8;
                const float total_2 = W0_0 * v0 + W0_1 * v1 + W0_2 * v2 + W0_3 * v3 + W0_4 * v4;
                const float z0 = total_2 + W0_5 * v5 + W0_6 * v6 + W0_7 * v7 + W0_8 * v8;
                const float total_3 = W1_0 * v0 + W1_1 * v1 + W1_2 * v2 + W1_3 * v3 + W1_4 * v4;
                const float z1 = total_3 + W1_5 * v5 + W1_6 * v6 + W1_7 * v7 + W1_8 * v8;
                const float total_4 = W2_0 * v0 + W2_1 * v1 + W2_2 * v2 + W2_3 * v3 + W2_4 * v4;
                const float z2 = total_4 + W2_5 * v5 + W2_6 * v6 + W2_7 * v7 + W2_8 * v8;
                const float total_5 = W3_0 * v0 + W3_1 * v1 + W3_2 * v2 + W3_3 * v3 + W3_4 * v4;
                const float z3 = total_5 + W3_5 * v5 + W3_6 * v6 + W3_7 * v7 + W3_8 * v8;
                const float total_6 = W4_0 * v0 + W4_1 * v1 + W4_2 * v2 + W4_3 * v3 + W4_4 * v4;
                const float z4 = total_6 + W4_5 * v5 + W4_6 * v6 + W4_7 * v7 + W4_8 * v8;
                const float total_7 = W5_0 * v0 + W5_1 * v1 + W5_2 * v2 + W5_3 * v3 + W5_4 * v4;
                const float z5 = total_7 + W5_5 * v5 + W5_6 * v6 + W5_7 * v7 + W5_8 * v8;
                const float total_8 = W6_0 * v0 + W6_1 * v1 + W6_2 * v2 + W6_3 * v3 + W6_4 * v4;
                const float z6 = total_8 + W6_5 * v5 + W6_6 * v6 + W6_7 * v7 + W6_8 * v8;
                const float total_9 = W7_0 * v0 + W7_1 * v1 + W7_2 * v2 + W7_3 * v3 + W7_4 * v4;
                const float z7 = total_9 + W7_5 * v5 + W7_6 * v6 + W7_7 * v7 + W7_8 * v8;
                const float total_10 = W8_0 * v0 + W8_1 * v1 + W8_2 * v2 + W8_3 * v3 + W8_4 * v4;
                const float z8 = total_10 + W8_5 * v5 + W8_6 * v6 + W8_7 * v7 + W8_8 * v8;
                const float total_11 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
                const float total_12 = total_11 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
                const float exp_2 = expf(-(0.5f * total_12));
                const float phi = amplitude_k * exp_2;
                const float gap_8 = -(W8_8 * z8) - W7_8 * z7 - W6_8 * z6 - W5_8 * z5;
                const float gap_9 = -(W8_7 * z8) - W7_7 * z7 - W6_7 * z6 - W5_7 * z5;
                const float gap_10 = -(W8_6 * z8) - W7_6 * z7 - W6_6 * z6 - W5_6 * z5;
                const float gap_11 = -(W8_5 * z8) - W7_5 * z7 - W6_5 * z6 - W5_5 * z5;
                const float gap_12 = -(W8_4 * z8) - W7_4 * z7 - W6_4 * z6 - W5_4 * z5;
                const float gap_13 = -(W8_3 * z8) - W7_3 * z7 - W6_3 * z6 - W5_3 * z5;
                const float gap_14 = -(W8_2 * z8) - W7_2 * z7 - W6_2 * z6 - W5_2 * z5;
                const float gap_15 = -(W8_1 * z8) - W7_1 * z7 - W6_1 * z6 - W5_1 * z5;
                const float gap_16 = -(W8_0 * z8) - W7_0 * z7 - W6_0 * z6 - W5_0 * z5;
                const float gap_17 = gap_8 - W4_8 * z4 - W3_8 * z3 - W2_8 * z2 - W1_8 * z1;
                const float gap_18 = gap_9 - W4_7 * z4 - W3_7 * z3 - W2_7 * z2 - W1_7 * z1;
                const float gap_19 = gap_10 - W4_6 * z4 - W3_6 * z3 - W2_6 * z2 - W1_6 * z1;
                const float gap_20 = gap_11 - W4_5 * z4 - W3_5 * z3 - W2_5 * z2 - W1_5 * z1;
                const float gap_21 = gap_12 - W4_4 * z4 - W3_4 * z3 - W2_4 * z2 - W1_4 * z1;
                const float gap_22 = gap_13 - W4_3 * z4 - W3_3 * z3 - W2_3 * z2 - W1_3 * z1;
                const float gap_23 = gap_14 - W4_2 * z4 - W3_2 * z3 - W2_2 * z2 - W1_2 * z1;
                const float gap_24 = gap_15 - W4_1 * z4 - W3_1 * z3 - W2_1 * z2 - W1_1 * z1;
                const float gap_25 = gap_16 - W4_0 * z4 - W3_0 * z3 - W2_0 * z2 - W1_0 * z1;
                const float by_v8 = gap_17 - W0_8 * z0;
                const float by_v7 = gap_18 - W0_7 * z0;
                const float by_v6 = gap_19 - W0_6 * z0;
                const float by_v5 = gap_20 - W0_5 * z0;
                const float by_v4 = gap_21 - W0_4 * z0;
                const float by_v3 = gap_22 - W0_3 * z0;
                const float by_v2 = gap_23 - W0_2 * z0;
                const float by_v1 = gap_24 - W0_1 * z0;
                const float by_v0 = gap_25 - W0_0 * z0;
                const float by_df8 = 16.0f * gradient_bar_block[8][lane];
                const float by_df7 = 16.0f * gradient_bar_block[7][lane];
                const float by_df6 = 16.0f * gradient_bar_block[6][lane];
                const float by_df5 = 16.0f * gradient_bar_block[5][lane];
                const float by_df4 = 16.0f * gradient_bar_block[4][lane];
                const float by_df3 = 16.0f * gradient_bar_block[3][lane];
                const float by_df2 = 4.0f * gradient_bar_block[2][lane];
                const float by_by_v8 = phi * by_df8;
                const float by_by_v7 = phi * by_df7;
                const float by_by_v6 = phi * by_df6;
                const float by_by_v5 = phi * by_df5;
                const float total_13 = value_bar_block[0][lane] + by_v8 * by_df8 + by_v7 * by_df7 + by_v6 * by_df6 + by_v5
                    * by_df5;
                const float by_by_v4 = phi * by_df4;
                const float by_by_v3 = phi * by_df3;
                const float by_by_v2 = phi * by_df2;
                const float by_by_v1 = phi * gradient_bar_block[1][lane];
                const float total_14 = total_13 + by_v4 * by_df4 + by_v3 * by_df3 + by_v2 * by_df2 + by_v1 *
                    gradient_bar_block[1][lane];
                const float by_by_v0 = phi * gradient_bar_block[0][lane];
                const float by_phi = total_14 + by_v0 * gradient_bar_block[0][lane];
                const float gap_26 = -(W0_0 * by_by_v0) - W0_1 * by_by_v1 - W0_2 * by_by_v2 - W0_3 * by_by_v3;
                const float gap_27 = gap_26 - W0_4 * by_by_v4 - W0_5 * by_by_v5 - W0_6 * by_by_v6 - W0_7 * by_by_v7;
                const float gap_28 = -(W1_0 * by_by_v0) - W1_1 * by_by_v1 - W1_2 * by_by_v2 - W1_3 * by_by_v3;
                const float gap_29 = gap_28 - W1_4 * by_by_v4 - W1_5 * by_by_v5 - W1_6 * by_by_v6 - W1_7 * by_by_v7;
                const float gap_30 = -(W2_0 * by_by_v0) - W2_1 * by_by_v1 - W2_2 * by_by_v2 - W2_3 * by_by_v3;
                const float gap_31 = gap_30 - W2_4 * by_by_v4 - W2_5 * by_by_v5 - W2_6 * by_by_v6 - W2_7 * by_by_v7;
                const float gap_32 = -(W3_0 * by_by_v0) - W3_1 * by_by_v1 - W3_2 * by_by_v2 - W3_3 * by_by_v3;
                const float gap_33 = gap_32 - W3_4 * by_by_v4 - W3_5 * by_by_v5 - W3_6 * by_by_v6 - W3_7 * by_by_v7;
                const float gap_34 = -(W4_0 * by_by_v0) - W4_1 * by_by_v1 - W4_2 * by_by_v2 - W4_3 * by_by_v3;
                const float gap_35 = gap_34 - W4_4 * by_by_v4 - W4_5 * by_by_v5 - W4_6 * by_by_v6 - W4_7 * by_by_v7;
                const float gap_36 = -(W5_0 * by_by_v0) - W5_1 * by_by_v1 - W5_2 * by_by_v2 - W5_3 * by_by_v3;
                const float gap_37 = gap_36 - W5_4 * by_by_v4 - W5_5 * by_by_v5 - W5_6 * by_by_v6 - W5_7 * by_by_v7;
                const float gap_38 = -(W6_0 * by_by_v0) - W6_1 * by_by_v1 - W6_2 * by_by_v2 - W6_3 * by_by_v3;
                const float gap_39 = gap_38 - W6_4 * by_by_v4 - W6_5 * by_by_v5 - W6_6 * by_by_v6 - W6_7 * by_by_v7;
                const float gap_40 = -(W7_0 * by_by_v0) - W7_1 * by_by_v1 - W7_2 * by_by_v2 - W7_3 * by_by_v3;
                const float gap_41 = gap_40 - W7_4 * by_by_v4 - W7_5 * by_by_v5 - W7_6 * by_by_v6 - W7_7 * by_by_v7;
                const float gap_42 = -(W8_0 * by_by_v0) - W8_1 * by_by_v1 - W8_2 * by_by_v2 - W8_3 * by_by_v3;
                const float gap_43 = gap_42 - W8_4 * by_by_v4 - W8_5 * by_by_v5 - W8_6 * by_by_v6 - W8_7 * by_by_v7;
                const float product = exp_2 * (amplitude_k * by_phi);
                const float by_z8 = gap_43 - W8_8 * by_by_v8 - z8 * product;
                const float by_z7 = gap_41 - W7_8 * by_by_v8 - z7 * product;
                const float by_z6 = gap_39 - W6_8 * by_by_v8 - z6 * product;
                const float by_z5 = gap_37 - W5_8 * by_by_v8 - z5 * product;
                const float by_z4 = gap_35 - W4_8 * by_by_v8 - z4 * product;
                const float by_z3 = gap_33 - W3_8 * by_by_v8 - z3 * product;
                const float by_z2 = gap_31 - W2_8 * by_by_v8 - z2 * product;
                const float by_z1 = gap_29 - W1_8 * by_by_v8 - z1 * product;
                const float by_z0 = gap_27 - W0_8 * by_by_v8 - z0 * product;
                const float total_15 = W8_8 * by_z8 + W7_8 * by_z7 + W6_8 * by_z6 + W5_8 * by_z5 + W4_8 * by_z4;
                const float total_16 = W8_7 * by_z8 + W7_7 * by_z7 + W6_7 * by_z6 + W5_7 * by_z5 + W4_7 * by_z4;
                const float total_17 = W8_6 * by_z8 + W7_6 * by_z7 + W6_6 * by_z6 + W5_6 * by_z5 + W4_6 * by_z4;
                const float total_18 = W8_5 * by_z8 + W7_5 * by_z7 + W6_5 * by_z6 + W5_5 * by_z5 + W4_5 * by_z4;
                const float total_19 = W8_4 * by_z8 + W7_4 * by_z7 + W6_4 * by_z6 + W5_4 * by_z5 + W4_4 * by_z4;
                const float total_20 = W8_3 * by_z8 + W7_3 * by_z7 + W6_3 * by_z6 + W5_3 * by_z5 + W4_3 * by_z4;
                const float total_21 = W8_2 * by_z8 + W7_2 * by_z7 + W6_2 * by_z6 + W5_2 * by_z5 + W4_2 * by_z4;
                const float total_22 = W8_1 * by_z8 + W7_1 * by_z7 + W6_1 * by_z6 + W5_1 * by_z5 + W4_1 * by_z4;
                const float total_23 = W8_0 * by_z8 + W7_0 * by_z7 + W6_0 * by_z6 + W5_0 * by_z5 + W4_0 * by_z4;
                const float by_v8_2 = total_15 + W3_8 * by_z3 + W2_8 * by_z2 + W1_8 * by_z1 + W0_8 * by_z0;
                const float by_v7_2 = total_16 + W3_7 * by_z3 + W2_7 * by_z2 + W1_7 * by_z1 + W0_7 * by_z0;
                const float by_v6_2 = total_17 + W3_6 * by_z3 + W2_6 * by_z2 + W1_6 * by_z1 + W0_6 * by_z0;
                const float by_v5_2 = total_18 + W3_5 * by_z3 + W2_5 * by_z2 + W1_5 * by_z1 + W0_5 * by_z0;
                const float by_v4_2 = total_19 + W3_4 * by_z3 + W2_4 * by_z2 + W1_4 * by_z1 + W0_4 * by_z0;
                const float by_v3_2 = total_20 + W3_3 * by_z3 + W2_3 * by_z2 + W1_3 * by_z1 + W0_3 * by_z0;
                const float by_v2_2 = total_21 + W3_2 * by_z3 + W2_2 * by_z2 + W1_2 * by_z1 + W0_2 * by_z0;
                const float by_v1_2 = total_22 + W3_1 * by_z3 + W2_1 * by_z2 + W1_1 * by_z1 + W0_1 * by_z0;
                const float by_v0_2 = total_23 + W3_0 * by_z3 + W2_0 * by_z2 + W1_0 * by_z1 + W0_0 * by_z0;
                sum[0][lane] += -by_v0_2;
                sum[1][lane] += -by_v1_2;
                sum[2][lane] += -by_v2_2;
                sum[3][lane] += -by_v3_2;
                sum[4][lane] += -by_v4_2;
                sum[5][lane] += -by_v5_2;
                sum[6][lane] += -by_v6_2;
                sum[7][lane] += -by_v7_2;
                sum[8][lane] += -by_v8_2;
                sum[9][lane] += v0 * by_z0 - z0 * by_by_v0;
                sum[10][lane] += v1 * by_z0 - z0 * by_by_v1;
                sum[11][lane] += v2 * by_z0 - z0 * by_by_v2;
                sum[12][lane] += v3 * by_z0 - z0 * by_by_v3;
                sum[13][lane] += v4 * by_z0 - z0 * by_by_v4;
                sum[14][lane] += v5 * by_z0 - z0 * by_by_v5;
                sum[15][lane] += v6 * by_z0 - z0 * by_by_v6;
                sum[16][lane] += v7 * by_z0 - z0 * by_by_v7;
                sum[17][lane] += v8 * by_z0 - z0 * by_by_v8;
                sum[18][lane] += v0 * by_z1 - z1 * by_by_v0;
                sum[19][lane] += v1 * by_z1 - z1 * by_by_v1;
                sum[20][lane] += v2 * by_z1 - z1 * by_by_v2;
                sum[21][lane] += v3 * by_z1 - z1 * by_by_v3;
                sum[22][lane] += v4 * by_z1 - z1 * by_by_v4;
                sum[23][lane] += v5 * by_z1 - z1 * by_by_v5;
                sum[24][lane] += v6 * by_z1 - z1 * by_by_v6;
                sum[25][lane] += v7 * by_z1 - z1 * by_by_v7;
                sum[26][lane] += v8 * by_z1 - z1 * by_by_v8;
                sum[27][lane] += v0 * by_z2 - z2 * by_by_v0;
                sum[28][lane] += v1 * by_z2 - z2 * by_by_v1;
                sum[29][lane] += v2 * by_z2 - z2 * by_by_v2;
                sum[30][lane] += v3 * by_z2 - z2 * by_by_v3;
                sum[31][lane] += v4 * by_z2 - z2 * by_by_v4;
                sum[32][lane] += v5 * by_z2 - z2 * by_by_v5;
                sum[33][lane] += v6 * by_z2 - z2 * by_by_v6;
                sum[34][lane] += v7 * by_z2 - z2 * by_by_v7;
                sum[35][lane] += v8 * by_z2 - z2 * by_by_v8;
                sum[36][lane] += v0 * by_z3 - z3 * by_by_v0;
                sum[37][lane] += v1 * by_z3 - z3 * by_by_v1;
                sum[38][lane] += v2 * by_z3 - z3 * by_by_v2;
                sum[39][lane] += v3 * by_z3 - z3 * by_by_v3;
                sum[40][lane] += v4 * by_z3 - z3 * by_by_v4;
                sum[41][lane] += v5 * by_z3 - z3 * by_by_v5;
                sum[42][lane] += v6 * by_z3 - z3 * by_by_v6;
                sum[43][lane] += v7 * by_z3 - z3 * by_by_v7;
                sum[44][lane] += v8 * by_z3 - z3 * by_by_v8;
                sum[45][lane] += v0 * by_z4 - z4 * by_by_v0;
                sum[46][lane] += v1 * by_z4 - z4 * by_by_v1;
                sum[47][lane] += v2 * by_z4 - z4 * by_by_v2;
                sum[48][lane] += v3 * by_z4 - z4 * by_by_v3;
                sum[49][lane] += v4 * by_z4 - z4 * by_by_v4;
                sum[50][lane] += v5 * by_z4 - z4 * by_by_v5;
                sum[51][lane] += v6 * by_z4 - z4 * by_by_v6;
                sum[52][lane] += v7 * by_z4 - z4 * by_by_v7;
                sum[53][lane] += v8 * by_z4 - z4 * by_by_v8;
                sum[54][lane] += v0 * by_z5 - z5 * by_by_v0;
                sum[55][lane] += v1 * by_z5 - z5 * by_by_v1;
                sum[56][lane] += v2 * by_z5 - z5 * by_by_v2;
                sum[57][lane] += v3 * by_z5 - z5 * by_by_v3;
                sum[58][lane] += v4 * by_z5 - z5 * by_by_v4;
                sum[59][lane] += v5 * by_z5 - z5 * by_by_v5;
                sum[60][lane] += v6 * by_z5 - z5 * by_by_v6;
                sum[61][lane] += v7 * by_z5 - z5 * by_by_v7;
                sum[62][lane] += v8 * by_z5 - z5 * by_by_v8;
                sum[63][lane] += v0 * by_z6 - z6 * by_by_v0;
                sum[64][lane] += v1 * by_z6 - z6 * by_by_v1;
                sum[65][lane] += v2 * by_z6 - z6 * by_by_v2;
                sum[66][lane] += v3 * by_z6 - z6 * by_by_v3;
                sum[67][lane] += v4 * by_z6 - z6 * by_by_v4;
                sum[68][lane] += v5 * by_z6 - z6 * by_by_v5;
                sum[69][lane] += v6 * by_z6 - z6 * by_by_v6;
                sum[70][lane] += v7 * by_z6 - z6 * by_by_v7;
                sum[71][lane] += v8 * by_z6 - z6 * by_by_v8;
                sum[72][lane] += v0 * by_z7 - z7 * by_by_v0;
                sum[73][lane] += v1 * by_z7 - z7 * by_by_v1;
                sum[74][lane] += v2 * by_z7 - z7 * by_by_v2;
                sum[75][lane] += v3 * by_z7 - z7 * by_by_v3;
                sum[76][lane] += v4 * by_z7 - z7 * by_by_v4;
                sum[77][lane] += v5 * by_z7 - z7 * by_by_v5;
                sum[78][lane] += v6 * by_z7 - z7 * by_by_v6;
                sum[79][lane] += v7 * by_z7 - z7 * by_by_v7;
                sum[80][lane] += v8 * by_z7 - z7 * by_by_v8;
                sum[81][lane] += v0 * by_z8 - z8 * by_by_v0;
                sum[82][lane] += v1 * by_z8 - z8 * by_by_v1;
                sum[83][lane] += v2 * by_z8 - z8 * by_by_v2;
                sum[84][lane] += v3 * by_z8 - z8 * by_by_v3;
                sum[85][lane] += v4 * by_z8 - z8 * by_by_v4;
                sum[86][lane] += v5 * by_z8 - z8 * by_by_v5;
                sum[87][lane] += v6 * by_z8 - z8 * by_by_v6;
                sum[88][lane] += v7 * by_z8 - z8 * by_by_v7;
                sum[89][lane] += v8 * by_z8 - z8 * by_by_v8;
                sum[90][lane] += exp_2 * by_phi;
            }
            for (size_t i = 0; i < 91; ++i)
                for (size_t lane = 0; lane < LANES; ++lane) total[i] += sum[i][lane];
            mu_bar[9 * k + 0] += total[0];
            mu_bar[9 * k + 1] += total[1];
            mu_bar[9 * k + 2] += total[2];
            mu_bar[9 * k + 3] += total[3];
            mu_bar[9 * k + 4] += total[4];
            mu_bar[9 * k + 5] += total[5];
            mu_bar[9 * k + 6] += total[6];
            mu_bar[9 * k + 7] += total[7];
            mu_bar[9 * k + 8] += total[8];
            W_bar[81 * k + 0] += total[9];
            W_bar[81 * k + 1] += total[10];
            W_bar[81 * k + 2] += total[11];
            W_bar[81 * k + 3] += total[12];
            W_bar[81 * k + 4] += total[13];
            W_bar[81 * k + 5] += total[14];
            W_bar[81 * k + 6] += total[15];
            W_bar[81 * k + 7] += total[16];
            W_bar[81 * k + 8] += total[17];
            W_bar[81 * k + 9] += total[18];
            W_bar[81 * k + 10] += total[19];
            W_bar[81 * k + 11] += total[20];
            W_bar[81 * k + 12] += total[21];
            W_bar[81 * k + 13] += total[22];
            W_bar[81 * k + 14] += total[23];
            W_bar[81 * k + 15] += total[24];
            W_bar[81 * k + 16] += total[25];
            W_bar[81 * k + 17] += total[26];
            W_bar[81 * k + 18] += total[27];
            W_bar[81 * k + 19] += total[28];
            W_bar[81 * k + 20] += total[29];
            W_bar[81 * k + 21] += total[30];
            W_bar[81 * k + 22] += total[31];
            W_bar[81 * k + 23] += total[32];
            W_bar[81 * k + 24] += total[33];
            W_bar[81 * k + 25] += total[34];
            W_bar[81 * k + 26] += total[35];
            W_bar[81 * k + 27] += total[36];
            W_bar[81 * k + 28] += total[37];
            W_bar[81 * k + 29] += total[38];
            W_bar[81 * k + 30] += total[39];
            W_bar[81 * k + 31] += total[40];
            W_bar[81 * k + 32] += total[41];
            W_bar[81 * k + 33] += total[42];
            W_bar[81 * k + 34] += total[43];
            W_bar[81 * k + 35] += total[44];
            W_bar[81 * k + 36] += total[45];
            W_bar[81 * k + 37] += total[46];
            W_bar[81 * k + 38] += total[47];
            W_bar[81 * k + 39] += total[48];
            W_bar[81 * k + 40] += total[49];
            W_bar[81 * k + 41] += total[50];
            W_bar[81 * k + 42] += total[51];
            W_bar[81 * k + 43] += total[52];
            W_bar[81 * k + 44] += total[53];
            W_bar[81 * k + 45] += total[54];
            W_bar[81 * k + 46] += total[55];
            W_bar[81 * k + 47] += total[56];
            W_bar[81 * k + 48] += total[57];
            W_bar[81 * k + 49] += total[58];
            W_bar[81 * k + 50] += total[59];
            W_bar[81 * k + 51] += total[60];
            W_bar[81 * k + 52] += total[61];
            W_bar[81 * k + 53] += total[62];
            W_bar[81 * k + 54] += total[63];
            W_bar[81 * k + 55] += total[64];
            W_bar[81 * k + 56] += total[65];
            W_bar[81 * k + 57] += total[66];
            W_bar[81 * k + 58] += total[67];
            W_bar[81 * k + 59] += total[68];
            W_bar[81 * k + 60] += total[69];
            W_bar[81 * k + 61] += total[70];
            W_bar[81 * k + 62] += total[71];
            W_bar[81 * k + 63] += total[72];
            W_bar[81 * k + 64] += total[73];
            W_bar[81 * k + 65] += total[74];
            W_bar[81 * k + 66] += total[75];
            W_bar[81 * k + 67] += total[76];
            W_bar[81 * k + 68] += total[77];
            W_bar[81 * k + 69] += total[78];
            W_bar[81 * k + 70] += total[79];
            W_bar[81 * k + 71] += total[80];
            W_bar[81 * k + 72] += total[81];
            W_bar[81 * k + 73] += total[82];
            W_bar[81 * k + 74] += total[83];
            W_bar[81 * k + 75] += total[84];
            W_bar[81 * k + 76] += total[85];
            W_bar[81 * k + 77] += total[86];
            W_bar[81 * k + 78] += total[87];
            W_bar[81 * k + 79] += total[88];
            W_bar[81 * k + 80] += total[89];
            amplitude_bar[1 * k + 0] += total[90];
        }
    }
    restore_denormals(mode);
}
