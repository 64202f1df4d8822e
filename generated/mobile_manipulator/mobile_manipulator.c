/*
 * mobile_manipulator: A mobile base in the plane and an arm of six revolute joints; lengths are those of the
 *
 * See the header for what the functions promise.
 */

#include "mobile_manipulator.h"

#include <float.h>

/* base: position: x, heading: x, periodic coordinates wrapped, arm: x, periodic coordinates wrapped */
void mobile_manipulator_project(
    const double *MOBILE_MANIPULATOR_RESTRICT x,
    double *MOBILE_MANIPULATOR_RESTRICT p_out) {
    const double round_2 = rint(0.15915494309189535 * x[2]);
    const double p2 = x[2] - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double round_3 = rint(0.15915494309189535 * x[3]);
    const double p3 = x[3] - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double round_4 = rint(0.15915494309189535 * x[4]);
    const double p4 = x[4] - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double round_5 = rint(0.15915494309189535 * x[5]);
    const double p5 = x[5] - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double round_6 = rint(0.15915494309189535 * x[6]);
    const double p6 = x[6] - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double round_7 = rint(0.15915494309189535 * x[7]);
    const double p7 = x[7] - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double round_8 = rint(0.15915494309189535 * x[8]);
    const double p8 = x[8] - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    p_out[0] = x[0];
    p_out[1] = x[1];
    p_out[2] = p2;
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
    p_out[7] = p7;
    p_out[8] = p8;
}

void mobile_manipulator_project_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT x,
    double *MOBILE_MANIPULATOR_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_project(x + 9 * i, p_out + 9 * i);
}

/* base: position: x, heading: x, arm: x */
void mobile_manipulator_to_tangent(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT x,
    double *MOBILE_MANIPULATOR_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
    v_out[2] = x[2];
    v_out[3] = x[3];
    v_out[4] = x[4];
    v_out[5] = x[5];
    v_out[6] = x[6];
    v_out[7] = x[7];
    v_out[8] = x[8];
}

void mobile_manipulator_to_tangent_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT x,
    double *MOBILE_MANIPULATOR_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_to_tangent(p + 9 * i, x + 9 * i, v_out + 9 * i);
}

/* inner(base) + inner(arm) */
double mobile_manipulator_inner(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT u,
    const double *MOBILE_MANIPULATOR_RESTRICT v) {
    (void)p;
    const double total_2 = u[0] * v[0] + u[1] * v[1] + v[2] * (0.25 * u[2]) + v[3] * (0.0625 * u[3]) + v[4] *
        (0.0625 * u[4]);
    const double total_3 = total_2 + v[5] * (0.0625 * u[5]) + v[6] * (0.0625 * u[6]) + v[7] * (0.0625 * u[7]);
    return total_3 + v[8] * (0.0625 * u[8]);
}

void mobile_manipulator_inner_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT u,
    const double *MOBILE_MANIPULATOR_RESTRICT v,
    double *MOBILE_MANIPULATOR_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = mobile_manipulator_inner(p + 9 * i, u + 9 * i, v + 9 * i);
}

/* sqrt(norm(base)^2 + norm(arm)^2) */
double mobile_manipulator_norm(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT v) {
    (void)p;
    const double total_2 = v[0] * v[0] + v[1] * v[1] + 0.25 * (v[2] * v[2]) + 0.0625 * (v[3] * v[3]) + 0.0625
        * (v[4] * v[4]);
    const double total_3 = total_2 + 0.0625 * (v[5] * v[5]) + 0.0625 * (v[6] * v[6]) + 0.0625 * (v[7] * v[7]);
    return sqrt(total_3 + 0.0625 * (v[8] * v[8]));
}

void mobile_manipulator_norm_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT v,
    double *MOBILE_MANIPULATOR_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = mobile_manipulator_norm(p + 9 * i, v + 9 * i);
}

/* base: position: G(p) v, heading: (1/4) * (G(p) v), arm: (1/16) * (G(p) v) */
void mobile_manipulator_flat(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT v,
    double *MOBILE_MANIPULATOR_RESTRICT covector_out) {
    (void)p;
    const double covector2 = 0.25 * v[2];
    const double covector3 = 0.0625 * v[3];
    const double covector4 = 0.0625 * v[4];
    const double covector5 = 0.0625 * v[5];
    const double covector6 = 0.0625 * v[6];
    const double covector7 = 0.0625 * v[7];
    const double covector8 = 0.0625 * v[8];
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = covector2;
    covector_out[3] = covector3;
    covector_out[4] = covector4;
    covector_out[5] = covector5;
    covector_out[6] = covector6;
    covector_out[7] = covector7;
    covector_out[8] = covector8;
}

void mobile_manipulator_flat_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT v,
    double *MOBILE_MANIPULATOR_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_flat(p + 9 * i, v + 9 * i, covector_out + 9 * i);
}

/* base: position: p + v, heading: wrap(p + v), arm: wrap(p + v) */
void mobile_manipulator_exp(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT v,
    double *MOBILE_MANIPULATOR_RESTRICT q_out) {
    const double q0 = p[0] + v[0];
    const double q1 = p[1] + v[1];
    const double total_2 = p[2] + v[2];
    const double round_2 = rint(0.15915494309189535 * total_2);
    const double q2 = total_2 - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double total_3 = p[3] + v[3];
    const double round_3 = rint(0.15915494309189535 * total_3);
    const double q3 = total_3 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double total_4 = p[4] + v[4];
    const double round_4 = rint(0.15915494309189535 * total_4);
    const double q4 = total_4 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double total_5 = p[5] + v[5];
    const double round_5 = rint(0.15915494309189535 * total_5);
    const double q5 = total_5 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double total_6 = p[6] + v[6];
    const double round_6 = rint(0.15915494309189535 * total_6);
    const double q6 = total_6 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double total_7 = p[7] + v[7];
    const double round_7 = rint(0.15915494309189535 * total_7);
    const double q7 = total_7 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double total_8 = p[8] + v[8];
    const double round_8 = rint(0.15915494309189535 * total_8);
    const double q8 = total_8 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
    q_out[4] = q4;
    q_out[5] = q5;
    q_out[6] = q6;
    q_out[7] = q7;
    q_out[8] = q8;
}

void mobile_manipulator_exp_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT v,
    double *MOBILE_MANIPULATOR_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_exp(p + 9 * i, v + 9 * i, q_out + 9 * i);
}

/* base: position: q - p, heading: wrap(q - p), arm: wrap(q - p) */
void mobile_manipulator_log(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT q,
    double *MOBILE_MANIPULATOR_RESTRICT v_out) {
    const double v0 = q[0] - p[0];
    const double v1 = q[1] - p[1];
    const double gap = q[2] - p[2];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v2 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = q[3] - p[3];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double v3 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double gap_3 = q[4] - p[4];
    const double round_4 = rint(0.15915494309189535 * gap_3);
    const double v4 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double gap_4 = q[5] - p[5];
    const double round_5 = rint(0.15915494309189535 * gap_4);
    const double v5 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double gap_5 = q[6] - p[6];
    const double round_6 = rint(0.15915494309189535 * gap_5);
    const double v6 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double gap_6 = q[7] - p[7];
    const double round_7 = rint(0.15915494309189535 * gap_6);
    const double v7 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double gap_7 = q[8] - p[8];
    const double round_8 = rint(0.15915494309189535 * gap_7);
    const double v8 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
    v_out[3] = v3;
    v_out[4] = v4;
    v_out[5] = v5;
    v_out[6] = v6;
    v_out[7] = v7;
    v_out[8] = v8;
}

void mobile_manipulator_log_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT q,
    double *MOBILE_MANIPULATOR_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_log(p + 9 * i, q + 9 * i, v_out + 9 * i);
}

/* sqrt(distance(base)^2 + distance(arm)^2) */
double mobile_manipulator_distance(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT q) {
    const double base_position_log0 = q[0] - p[0];
    const double base_position_log1 = q[1] - p[1];
    const double gap = q[2] - p[2];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double base_heading_log0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = q[3] - p[3];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double arm_log0 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double gap_3 = q[4] - p[4];
    const double round_4 = rint(0.15915494309189535 * gap_3);
    const double arm_log1 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double gap_4 = q[5] - p[5];
    const double round_5 = rint(0.15915494309189535 * gap_4);
    const double arm_log2 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double gap_5 = q[6] - p[6];
    const double round_6 = rint(0.15915494309189535 * gap_5);
    const double arm_log3 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double gap_6 = q[7] - p[7];
    const double round_7 = rint(0.15915494309189535 * gap_6);
    const double arm_log4 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double gap_7 = q[8] - p[8];
    const double round_8 = rint(0.15915494309189535 * gap_7);
    const double arm_log5 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    const double total_2 = base_position_log0 * base_position_log0 + base_position_log1 * base_position_log1 +
        0.25 * (base_heading_log0 * base_heading_log0) + 0.0625 * (arm_log0 * arm_log0) + 0.0625 * (arm_log1 *
        arm_log1);
    const double total_3 = total_2 + 0.0625 * (arm_log2 * arm_log2) + 0.0625 * (arm_log3 * arm_log3) + 0.0625
        * (arm_log4 * arm_log4);
    return sqrt(total_3 + 0.0625 * (arm_log5 * arm_log5));
}

void mobile_manipulator_distance_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT q,
    double *MOBILE_MANIPULATOR_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = mobile_manipulator_distance(p + 9 * i, q + 9 * i);
}

/* log_abs_det(base) + log_abs_det(arm) */
double mobile_manipulator_log_abs_det(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0;
}

void mobile_manipulator_log_abs_det_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT q,
    double *MOBILE_MANIPULATOR_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = mobile_manipulator_log_abs_det(p + 9 * i, q + 9 * i);
}

/* base: position: G(p)^-1 df, heading: 4 * (G(p)^-1 df), arm: 16 * (G(p)^-1 df) */
void mobile_manipulator_riemannian_gradient(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT df,
    double *MOBILE_MANIPULATOR_RESTRICT gradient_out) {
    (void)p;
    const double gradient2 = 4.0 * df[2];
    const double gradient3 = 16.0 * df[3];
    const double gradient4 = 16.0 * df[4];
    const double gradient5 = 16.0 * df[5];
    const double gradient6 = 16.0 * df[6];
    const double gradient7 = 16.0 * df[7];
    const double gradient8 = 16.0 * df[8];
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
    gradient_out[2] = gradient2;
    gradient_out[3] = gradient3;
    gradient_out[4] = gradient4;
    gradient_out[5] = gradient5;
    gradient_out[6] = gradient6;
    gradient_out[7] = gradient7;
    gradient_out[8] = gradient8;
}

void mobile_manipulator_riemannian_gradient_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT df,
    double *MOBILE_MANIPULATOR_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_riemannian_gradient(p + 9 * i, df + 9 * i, gradient_out + 9 * i);
}

/* sqrt(gradient_norm(base)^2 + gradient_norm(arm)^2) */
double mobile_manipulator_gradient_norm(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT df) {
    (void)p;
    const double total_2 = df[0] * df[0] + df[1] * df[1] + 4.0 * (df[2] * df[2]) + 16.0 * (df[3] * df[3]) +
        16.0 * (df[4] * df[4]);
    const double total_3 = total_2 + 16.0 * (df[5] * df[5]) + 16.0 * (df[6] * df[6]) + 16.0 * (df[7] * df[7]);
    return sqrt(total_3 + 16.0 * (df[8] * df[8]));
}

void mobile_manipulator_gradient_norm_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT df,
    double *MOBILE_MANIPULATOR_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = mobile_manipulator_gradient_norm(p + 9 * i, df + 9 * i);
}

/* base: position: v, heading: v, arm: v */
void mobile_manipulator_transport(
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT q,
    const double *MOBILE_MANIPULATOR_RESTRICT v,
    double *MOBILE_MANIPULATOR_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
    w_out[1] = v[1];
    w_out[2] = v[2];
    w_out[3] = v[3];
    w_out[4] = v[4];
    w_out[5] = v[5];
    w_out[6] = v[6];
    w_out[7] = v[7];
    w_out[8] = v[8];
}

void mobile_manipulator_transport_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT p,
    const double *MOBILE_MANIPULATOR_RESTRICT q,
    const double *MOBILE_MANIPULATOR_RESTRICT v,
    double *MOBILE_MANIPULATOR_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_transport(p + 9 * i, q + 9 * i, v + 9 * i, w_out + 9 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void mobile_manipulator_splat(
    const double *MOBILE_MANIPULATOR_RESTRICT x,
    const double *MOBILE_MANIPULATOR_RESTRICT mu,
    const double *MOBILE_MANIPULATOR_RESTRICT W,
    double amplitude,
    double *MOBILE_MANIPULATOR_RESTRICT value_out,
    double *MOBILE_MANIPULATOR_RESTRICT gradient_out) {
    const double v0 = x[0] - mu[0];
    const double v1 = x[1] - mu[1];
    const double gap = x[2] - mu[2];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v2 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = x[3] - mu[3];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double v3 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double gap_3 = x[4] - mu[4];
    const double round_4 = rint(0.15915494309189535 * gap_3);
    const double v4 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double gap_4 = x[5] - mu[5];
    const double round_5 = rint(0.15915494309189535 * gap_4);
    const double v5 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double gap_5 = x[6] - mu[6];
    const double round_6 = rint(0.15915494309189535 * gap_5);
    const double v6 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double gap_6 = x[7] - mu[7];
    const double round_7 = rint(0.15915494309189535 * gap_6);
    const double v7 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double gap_7 = x[8] - mu[8];
    const double round_8 = rint(0.15915494309189535 * gap_7);
    const double v8 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    const double total_2 = W[0] * v0 + W[1] * v1 + W[2] * v2 + W[3] * v3 + W[4] * v4;
    const double z0 = total_2 + W[5] * v5 + W[6] * v6 + W[7] * v7 + W[8] * v8;
    const double total_3 = W[9] * v0 + W[10] * v1 + W[11] * v2 + W[12] * v3 + W[13] * v4;
    const double z1 = total_3 + W[14] * v5 + W[15] * v6 + W[16] * v7 + W[17] * v8;
    const double total_4 = W[18] * v0 + W[19] * v1 + W[20] * v2 + W[21] * v3 + W[22] * v4;
    const double z2 = total_4 + W[23] * v5 + W[24] * v6 + W[25] * v7 + W[26] * v8;
    const double total_5 = W[27] * v0 + W[28] * v1 + W[29] * v2 + W[30] * v3 + W[31] * v4;
    const double z3 = total_5 + W[32] * v5 + W[33] * v6 + W[34] * v7 + W[35] * v8;
    const double total_6 = W[36] * v0 + W[37] * v1 + W[38] * v2 + W[39] * v3 + W[40] * v4;
    const double z4 = total_6 + W[41] * v5 + W[42] * v6 + W[43] * v7 + W[44] * v8;
    const double total_7 = W[45] * v0 + W[46] * v1 + W[47] * v2 + W[48] * v3 + W[49] * v4;
    const double z5 = total_7 + W[50] * v5 + W[51] * v6 + W[52] * v7 + W[53] * v8;
    const double total_8 = W[54] * v0 + W[55] * v1 + W[56] * v2 + W[57] * v3 + W[58] * v4;
    const double z6 = total_8 + W[59] * v5 + W[60] * v6 + W[61] * v7 + W[62] * v8;
    const double total_9 = W[63] * v0 + W[64] * v1 + W[65] * v2 + W[66] * v3 + W[67] * v4;
    const double z7 = total_9 + W[68] * v5 + W[69] * v6 + W[70] * v7 + W[71] * v8;
    const double total_10 = W[72] * v0 + W[73] * v1 + W[74] * v2 + W[75] * v3 + W[76] * v4;
    const double z8 = total_10 + W[77] * v5 + W[78] * v6 + W[79] * v7 + W[80] * v8;
    const double total_11 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
    const double total_12 = total_11 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
    const double phi = amplitude * exp(-(0.5 * total_12));
    const double gap_8 = -(W[80] * z8) - W[71] * z7 - W[62] * z6 - W[53] * z5;
    const double gap_9 = -(W[79] * z8) - W[70] * z7 - W[61] * z6 - W[52] * z5;
    const double gap_10 = -(W[78] * z8) - W[69] * z7 - W[60] * z6 - W[51] * z5;
    const double gap_11 = -(W[77] * z8) - W[68] * z7 - W[59] * z6 - W[50] * z5;
    const double gap_12 = -(W[76] * z8) - W[67] * z7 - W[58] * z6 - W[49] * z5;
    const double gap_13 = -(W[75] * z8) - W[66] * z7 - W[57] * z6 - W[48] * z5;
    const double gap_14 = -(W[74] * z8) - W[65] * z7 - W[56] * z6 - W[47] * z5;
    const double gap_15 = -(W[73] * z8) - W[64] * z7 - W[55] * z6 - W[46] * z5;
    const double gap_16 = -(W[72] * z8) - W[63] * z7 - W[54] * z6 - W[45] * z5;
    const double gap_17 = gap_8 - W[44] * z4 - W[35] * z3 - W[26] * z2 - W[17] * z1;
    const double gap_18 = gap_9 - W[43] * z4 - W[34] * z3 - W[25] * z2 - W[16] * z1;
    const double gap_19 = gap_10 - W[42] * z4 - W[33] * z3 - W[24] * z2 - W[15] * z1;
    const double gap_20 = gap_11 - W[41] * z4 - W[32] * z3 - W[23] * z2 - W[14] * z1;
    const double gap_21 = gap_12 - W[40] * z4 - W[31] * z3 - W[22] * z2 - W[13] * z1;
    const double gap_22 = gap_13 - W[39] * z4 - W[30] * z3 - W[21] * z2 - W[12] * z1;
    const double gap_23 = gap_14 - W[38] * z4 - W[29] * z3 - W[20] * z2 - W[11] * z1;
    const double gap_24 = gap_15 - W[37] * z4 - W[28] * z3 - W[19] * z2 - W[10] * z1;
    const double gap_25 = gap_16 - W[36] * z4 - W[27] * z3 - W[18] * z2 - W[9] * z1;
    const double by_v8 = gap_17 - W[8] * z0;
    const double by_v7 = gap_18 - W[7] * z0;
    const double by_v6 = gap_19 - W[6] * z0;
    const double by_v5 = gap_20 - W[5] * z0;
    const double by_v4 = gap_21 - W[4] * z0;
    const double by_v3 = gap_22 - W[3] * z0;
    const double by_v2 = gap_23 - W[2] * z0;
    const double by_v1 = gap_24 - W[1] * z0;
    const double by_v0 = gap_25 - W[0] * z0;
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
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
    gradient_out[2] = gradient2;
    gradient_out[3] = gradient3;
    gradient_out[4] = gradient4;
    gradient_out[5] = gradient5;
    gradient_out[6] = gradient6;
    gradient_out[7] = gradient7;
    gradient_out[8] = gradient8;
}

void mobile_manipulator_splat_batch(
    size_t count,
    const double *MOBILE_MANIPULATOR_RESTRICT x,
    const double *MOBILE_MANIPULATOR_RESTRICT mu,
    const double *MOBILE_MANIPULATOR_RESTRICT W,
    const double *MOBILE_MANIPULATOR_RESTRICT amplitude,
    double *MOBILE_MANIPULATOR_RESTRICT value_out,
    double *MOBILE_MANIPULATOR_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_splat(x + 9 * i, mu + 9 * i, W + 81 * i, amplitude[i], value_out + i, gradient_out + 9 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void mobile_manipulator_frame(const double *MOBILE_MANIPULATOR_RESTRICT p, double *MOBILE_MANIPULATOR_RESTRICT frame) {
    double left[9][9];
    for (int i = 0; i < 9; ++i) {
        double axis[9];
        for (int j = 0; j < 9; ++j) axis[j] = i == j ? 1.0 : 0.0;
        mobile_manipulator_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 9; ++row) {
        double *e = frame + 9 * row;
        int longest = 0;
        for (int i = 1; i < 9; ++i)
            if (mobile_manipulator_norm(p, left[i]) > mobile_manipulator_norm(p, left[longest])) longest = i;
        const double length = mobile_manipulator_norm(p, left[longest]);
        for (int j = 0; j < 9; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 9; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 9];
            const double part = mobile_manipulator_inner(p, e, rest);
            for (int j = 0; j < 9; ++j) rest[j] -= part * e[j];
        }
    }
}

/* base: position: x, heading: x, periodic coordinates wrapped, arm: x, periodic coordinates wrapped */
void mobile_manipulator_project_f(
    const float *MOBILE_MANIPULATOR_RESTRICT x,
    float *MOBILE_MANIPULATOR_RESTRICT p_out) {
    const float round_2 = rintf(0.15915494309189535f * x[2]);
    const float p2 = x[2] - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float round_3 = rintf(0.15915494309189535f * x[3]);
    const float p3 = x[3] - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float round_4 = rintf(0.15915494309189535f * x[4]);
    const float p4 = x[4] - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float round_5 = rintf(0.15915494309189535f * x[5]);
    const float p5 = x[5] - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float round_6 = rintf(0.15915494309189535f * x[6]);
    const float p6 = x[6] - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float round_7 = rintf(0.15915494309189535f * x[7]);
    const float p7 = x[7] - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float round_8 = rintf(0.15915494309189535f * x[8]);
    const float p8 = x[8] - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    p_out[0] = x[0];
    p_out[1] = x[1];
    p_out[2] = p2;
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
    p_out[7] = p7;
    p_out[8] = p8;
}

void mobile_manipulator_project_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT x,
    float *MOBILE_MANIPULATOR_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_project_f(x + 9 * i, p_out + 9 * i);
}

/* base: position: x, heading: x, arm: x */
void mobile_manipulator_to_tangent_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT x,
    float *MOBILE_MANIPULATOR_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
    v_out[2] = x[2];
    v_out[3] = x[3];
    v_out[4] = x[4];
    v_out[5] = x[5];
    v_out[6] = x[6];
    v_out[7] = x[7];
    v_out[8] = x[8];
}

void mobile_manipulator_to_tangent_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT x,
    float *MOBILE_MANIPULATOR_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_to_tangent_f(p + 9 * i, x + 9 * i, v_out + 9 * i);
}

/* inner(base) + inner(arm) */
float mobile_manipulator_inner_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT u,
    const float *MOBILE_MANIPULATOR_RESTRICT v) {
    (void)p;
    const float total_2 = u[0] * v[0] + u[1] * v[1] + v[2] * (0.25f * u[2]) + v[3] * (0.0625f * u[3]) + v[4] *
        (0.0625f * u[4]);
    const float total_3 = total_2 + v[5] * (0.0625f * u[5]) + v[6] * (0.0625f * u[6]) + v[7] * (0.0625f *
        u[7]);
    return total_3 + v[8] * (0.0625f * u[8]);
}

void mobile_manipulator_inner_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT u,
    const float *MOBILE_MANIPULATOR_RESTRICT v,
    float *MOBILE_MANIPULATOR_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = mobile_manipulator_inner_f(p + 9 * i, u + 9 * i, v + 9 * i);
}

/* sqrt(norm(base)^2 + norm(arm)^2) */
float mobile_manipulator_norm_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT v) {
    (void)p;
    const float total_2 = v[0] * v[0] + v[1] * v[1] + 0.25f * (v[2] * v[2]) + 0.0625f * (v[3] * v[3]) +
        0.0625f * (v[4] * v[4]);
    const float total_3 = total_2 + 0.0625f * (v[5] * v[5]) + 0.0625f * (v[6] * v[6]) + 0.0625f * (v[7] *
        v[7]);
    return sqrtf(total_3 + 0.0625f * (v[8] * v[8]));
}

void mobile_manipulator_norm_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT v,
    float *MOBILE_MANIPULATOR_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = mobile_manipulator_norm_f(p + 9 * i, v + 9 * i);
}

/* base: position: G(p) v, heading: (1/4) * (G(p) v), arm: (1/16) * (G(p) v) */
void mobile_manipulator_flat_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT v,
    float *MOBILE_MANIPULATOR_RESTRICT covector_out) {
    (void)p;
    const float covector2 = 0.25f * v[2];
    const float covector3 = 0.0625f * v[3];
    const float covector4 = 0.0625f * v[4];
    const float covector5 = 0.0625f * v[5];
    const float covector6 = 0.0625f * v[6];
    const float covector7 = 0.0625f * v[7];
    const float covector8 = 0.0625f * v[8];
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = covector2;
    covector_out[3] = covector3;
    covector_out[4] = covector4;
    covector_out[5] = covector5;
    covector_out[6] = covector6;
    covector_out[7] = covector7;
    covector_out[8] = covector8;
}

void mobile_manipulator_flat_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT v,
    float *MOBILE_MANIPULATOR_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_flat_f(p + 9 * i, v + 9 * i, covector_out + 9 * i);
}

/* base: position: p + v, heading: wrap(p + v), arm: wrap(p + v) */
void mobile_manipulator_exp_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT v,
    float *MOBILE_MANIPULATOR_RESTRICT q_out) {
    const float q0 = p[0] + v[0];
    const float q1 = p[1] + v[1];
    const float total_2 = p[2] + v[2];
    const float round_2 = rintf(0.15915494309189535f * total_2);
    const float q2 = total_2 - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float total_3 = p[3] + v[3];
    const float round_3 = rintf(0.15915494309189535f * total_3);
    const float q3 = total_3 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float total_4 = p[4] + v[4];
    const float round_4 = rintf(0.15915494309189535f * total_4);
    const float q4 = total_4 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float total_5 = p[5] + v[5];
    const float round_5 = rintf(0.15915494309189535f * total_5);
    const float q5 = total_5 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float total_6 = p[6] + v[6];
    const float round_6 = rintf(0.15915494309189535f * total_6);
    const float q6 = total_6 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float total_7 = p[7] + v[7];
    const float round_7 = rintf(0.15915494309189535f * total_7);
    const float q7 = total_7 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float total_8 = p[8] + v[8];
    const float round_8 = rintf(0.15915494309189535f * total_8);
    const float q8 = total_8 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
    q_out[4] = q4;
    q_out[5] = q5;
    q_out[6] = q6;
    q_out[7] = q7;
    q_out[8] = q8;
}

void mobile_manipulator_exp_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT v,
    float *MOBILE_MANIPULATOR_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_exp_f(p + 9 * i, v + 9 * i, q_out + 9 * i);
}

/* base: position: q - p, heading: wrap(q - p), arm: wrap(q - p) */
void mobile_manipulator_log_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT q,
    float *MOBILE_MANIPULATOR_RESTRICT v_out) {
    const float v0 = q[0] - p[0];
    const float v1 = q[1] - p[1];
    const float gap = q[2] - p[2];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v2 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = q[3] - p[3];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float v3 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float gap_3 = q[4] - p[4];
    const float round_4 = rintf(0.15915494309189535f * gap_3);
    const float v4 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float gap_4 = q[5] - p[5];
    const float round_5 = rintf(0.15915494309189535f * gap_4);
    const float v5 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float gap_5 = q[6] - p[6];
    const float round_6 = rintf(0.15915494309189535f * gap_5);
    const float v6 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float gap_6 = q[7] - p[7];
    const float round_7 = rintf(0.15915494309189535f * gap_6);
    const float v7 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float gap_7 = q[8] - p[8];
    const float round_8 = rintf(0.15915494309189535f * gap_7);
    const float v8 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
    v_out[3] = v3;
    v_out[4] = v4;
    v_out[5] = v5;
    v_out[6] = v6;
    v_out[7] = v7;
    v_out[8] = v8;
}

void mobile_manipulator_log_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT q,
    float *MOBILE_MANIPULATOR_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_log_f(p + 9 * i, q + 9 * i, v_out + 9 * i);
}

/* sqrt(distance(base)^2 + distance(arm)^2) */
float mobile_manipulator_distance_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT q) {
    const float base_position_log0 = q[0] - p[0];
    const float base_position_log1 = q[1] - p[1];
    const float gap = q[2] - p[2];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float base_heading_log0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = q[3] - p[3];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float arm_log0 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float gap_3 = q[4] - p[4];
    const float round_4 = rintf(0.15915494309189535f * gap_3);
    const float arm_log1 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float gap_4 = q[5] - p[5];
    const float round_5 = rintf(0.15915494309189535f * gap_4);
    const float arm_log2 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float gap_5 = q[6] - p[6];
    const float round_6 = rintf(0.15915494309189535f * gap_5);
    const float arm_log3 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float gap_6 = q[7] - p[7];
    const float round_7 = rintf(0.15915494309189535f * gap_6);
    const float arm_log4 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float gap_7 = q[8] - p[8];
    const float round_8 = rintf(0.15915494309189535f * gap_7);
    const float arm_log5 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    const float total_2 = base_position_log0 * base_position_log0 + base_position_log1 * base_position_log1 +
        0.25f * (base_heading_log0 * base_heading_log0) + 0.0625f * (arm_log0 * arm_log0) + 0.0625f *
        (arm_log1 * arm_log1);
    const float total_3 = total_2 + 0.0625f * (arm_log2 * arm_log2) + 0.0625f * (arm_log3 * arm_log3) +
        0.0625f * (arm_log4 * arm_log4);
    return sqrtf(total_3 + 0.0625f * (arm_log5 * arm_log5));
}

void mobile_manipulator_distance_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT q,
    float *MOBILE_MANIPULATOR_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = mobile_manipulator_distance_f(p + 9 * i, q + 9 * i);
}

/* log_abs_det(base) + log_abs_det(arm) */
float mobile_manipulator_log_abs_det_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0f;
}

void mobile_manipulator_log_abs_det_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT q,
    float *MOBILE_MANIPULATOR_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = mobile_manipulator_log_abs_det_f(p + 9 * i, q + 9 * i);
}

/* base: position: G(p)^-1 df, heading: 4 * (G(p)^-1 df), arm: 16 * (G(p)^-1 df) */
void mobile_manipulator_riemannian_gradient_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT df,
    float *MOBILE_MANIPULATOR_RESTRICT gradient_out) {
    (void)p;
    const float gradient2 = 4.0f * df[2];
    const float gradient3 = 16.0f * df[3];
    const float gradient4 = 16.0f * df[4];
    const float gradient5 = 16.0f * df[5];
    const float gradient6 = 16.0f * df[6];
    const float gradient7 = 16.0f * df[7];
    const float gradient8 = 16.0f * df[8];
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
    gradient_out[2] = gradient2;
    gradient_out[3] = gradient3;
    gradient_out[4] = gradient4;
    gradient_out[5] = gradient5;
    gradient_out[6] = gradient6;
    gradient_out[7] = gradient7;
    gradient_out[8] = gradient8;
}

void mobile_manipulator_riemannian_gradient_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT df,
    float *MOBILE_MANIPULATOR_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_riemannian_gradient_f(p + 9 * i, df + 9 * i, gradient_out + 9 * i);
}

/* sqrt(gradient_norm(base)^2 + gradient_norm(arm)^2) */
float mobile_manipulator_gradient_norm_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT df) {
    (void)p;
    const float total_2 = df[0] * df[0] + df[1] * df[1] + 4.0f * (df[2] * df[2]) + 16.0f * (df[3] * df[3]) +
        16.0f * (df[4] * df[4]);
    const float total_3 = total_2 + 16.0f * (df[5] * df[5]) + 16.0f * (df[6] * df[6]) + 16.0f * (df[7] *
        df[7]);
    return sqrtf(total_3 + 16.0f * (df[8] * df[8]));
}

void mobile_manipulator_gradient_norm_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT df,
    float *MOBILE_MANIPULATOR_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = mobile_manipulator_gradient_norm_f(p + 9 * i, df + 9 * i);
}

/* base: position: v, heading: v, arm: v */
void mobile_manipulator_transport_f(
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT q,
    const float *MOBILE_MANIPULATOR_RESTRICT v,
    float *MOBILE_MANIPULATOR_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
    w_out[1] = v[1];
    w_out[2] = v[2];
    w_out[3] = v[3];
    w_out[4] = v[4];
    w_out[5] = v[5];
    w_out[6] = v[6];
    w_out[7] = v[7];
    w_out[8] = v[8];
}

void mobile_manipulator_transport_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT p,
    const float *MOBILE_MANIPULATOR_RESTRICT q,
    const float *MOBILE_MANIPULATOR_RESTRICT v,
    float *MOBILE_MANIPULATOR_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_transport_f(p + 9 * i, q + 9 * i, v + 9 * i, w_out + 9 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void mobile_manipulator_splat_f(
    const float *MOBILE_MANIPULATOR_RESTRICT x,
    const float *MOBILE_MANIPULATOR_RESTRICT mu,
    const float *MOBILE_MANIPULATOR_RESTRICT W,
    float amplitude,
    float *MOBILE_MANIPULATOR_RESTRICT value_out,
    float *MOBILE_MANIPULATOR_RESTRICT gradient_out) {
    const float v0 = x[0] - mu[0];
    const float v1 = x[1] - mu[1];
    const float gap = x[2] - mu[2];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v2 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = x[3] - mu[3];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float v3 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float gap_3 = x[4] - mu[4];
    const float round_4 = rintf(0.15915494309189535f * gap_3);
    const float v4 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float gap_4 = x[5] - mu[5];
    const float round_5 = rintf(0.15915494309189535f * gap_4);
    const float v5 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float gap_5 = x[6] - mu[6];
    const float round_6 = rintf(0.15915494309189535f * gap_5);
    const float v6 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float gap_6 = x[7] - mu[7];
    const float round_7 = rintf(0.15915494309189535f * gap_6);
    const float v7 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float gap_7 = x[8] - mu[8];
    const float round_8 = rintf(0.15915494309189535f * gap_7);
    const float v8 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    const float total_2 = W[0] * v0 + W[1] * v1 + W[2] * v2 + W[3] * v3 + W[4] * v4;
    const float z0 = total_2 + W[5] * v5 + W[6] * v6 + W[7] * v7 + W[8] * v8;
    const float total_3 = W[9] * v0 + W[10] * v1 + W[11] * v2 + W[12] * v3 + W[13] * v4;
    const float z1 = total_3 + W[14] * v5 + W[15] * v6 + W[16] * v7 + W[17] * v8;
    const float total_4 = W[18] * v0 + W[19] * v1 + W[20] * v2 + W[21] * v3 + W[22] * v4;
    const float z2 = total_4 + W[23] * v5 + W[24] * v6 + W[25] * v7 + W[26] * v8;
    const float total_5 = W[27] * v0 + W[28] * v1 + W[29] * v2 + W[30] * v3 + W[31] * v4;
    const float z3 = total_5 + W[32] * v5 + W[33] * v6 + W[34] * v7 + W[35] * v8;
    const float total_6 = W[36] * v0 + W[37] * v1 + W[38] * v2 + W[39] * v3 + W[40] * v4;
    const float z4 = total_6 + W[41] * v5 + W[42] * v6 + W[43] * v7 + W[44] * v8;
    const float total_7 = W[45] * v0 + W[46] * v1 + W[47] * v2 + W[48] * v3 + W[49] * v4;
    const float z5 = total_7 + W[50] * v5 + W[51] * v6 + W[52] * v7 + W[53] * v8;
    const float total_8 = W[54] * v0 + W[55] * v1 + W[56] * v2 + W[57] * v3 + W[58] * v4;
    const float z6 = total_8 + W[59] * v5 + W[60] * v6 + W[61] * v7 + W[62] * v8;
    const float total_9 = W[63] * v0 + W[64] * v1 + W[65] * v2 + W[66] * v3 + W[67] * v4;
    const float z7 = total_9 + W[68] * v5 + W[69] * v6 + W[70] * v7 + W[71] * v8;
    const float total_10 = W[72] * v0 + W[73] * v1 + W[74] * v2 + W[75] * v3 + W[76] * v4;
    const float z8 = total_10 + W[77] * v5 + W[78] * v6 + W[79] * v7 + W[80] * v8;
    const float total_11 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
    const float total_12 = total_11 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
    const float phi = amplitude * expf(-(0.5f * total_12));
    const float gap_8 = -(W[80] * z8) - W[71] * z7 - W[62] * z6 - W[53] * z5;
    const float gap_9 = -(W[79] * z8) - W[70] * z7 - W[61] * z6 - W[52] * z5;
    const float gap_10 = -(W[78] * z8) - W[69] * z7 - W[60] * z6 - W[51] * z5;
    const float gap_11 = -(W[77] * z8) - W[68] * z7 - W[59] * z6 - W[50] * z5;
    const float gap_12 = -(W[76] * z8) - W[67] * z7 - W[58] * z6 - W[49] * z5;
    const float gap_13 = -(W[75] * z8) - W[66] * z7 - W[57] * z6 - W[48] * z5;
    const float gap_14 = -(W[74] * z8) - W[65] * z7 - W[56] * z6 - W[47] * z5;
    const float gap_15 = -(W[73] * z8) - W[64] * z7 - W[55] * z6 - W[46] * z5;
    const float gap_16 = -(W[72] * z8) - W[63] * z7 - W[54] * z6 - W[45] * z5;
    const float gap_17 = gap_8 - W[44] * z4 - W[35] * z3 - W[26] * z2 - W[17] * z1;
    const float gap_18 = gap_9 - W[43] * z4 - W[34] * z3 - W[25] * z2 - W[16] * z1;
    const float gap_19 = gap_10 - W[42] * z4 - W[33] * z3 - W[24] * z2 - W[15] * z1;
    const float gap_20 = gap_11 - W[41] * z4 - W[32] * z3 - W[23] * z2 - W[14] * z1;
    const float gap_21 = gap_12 - W[40] * z4 - W[31] * z3 - W[22] * z2 - W[13] * z1;
    const float gap_22 = gap_13 - W[39] * z4 - W[30] * z3 - W[21] * z2 - W[12] * z1;
    const float gap_23 = gap_14 - W[38] * z4 - W[29] * z3 - W[20] * z2 - W[11] * z1;
    const float gap_24 = gap_15 - W[37] * z4 - W[28] * z3 - W[19] * z2 - W[10] * z1;
    const float gap_25 = gap_16 - W[36] * z4 - W[27] * z3 - W[18] * z2 - W[9] * z1;
    const float by_v8 = gap_17 - W[8] * z0;
    const float by_v7 = gap_18 - W[7] * z0;
    const float by_v6 = gap_19 - W[6] * z0;
    const float by_v5 = gap_20 - W[5] * z0;
    const float by_v4 = gap_21 - W[4] * z0;
    const float by_v3 = gap_22 - W[3] * z0;
    const float by_v2 = gap_23 - W[2] * z0;
    const float by_v1 = gap_24 - W[1] * z0;
    const float by_v0 = gap_25 - W[0] * z0;
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
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
    gradient_out[2] = gradient2;
    gradient_out[3] = gradient3;
    gradient_out[4] = gradient4;
    gradient_out[5] = gradient5;
    gradient_out[6] = gradient6;
    gradient_out[7] = gradient7;
    gradient_out[8] = gradient8;
}

void mobile_manipulator_splat_batch_f(
    size_t count,
    const float *MOBILE_MANIPULATOR_RESTRICT x,
    const float *MOBILE_MANIPULATOR_RESTRICT mu,
    const float *MOBILE_MANIPULATOR_RESTRICT W,
    const float *MOBILE_MANIPULATOR_RESTRICT amplitude,
    float *MOBILE_MANIPULATOR_RESTRICT value_out,
    float *MOBILE_MANIPULATOR_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) mobile_manipulator_splat_f(x + 9 * i, mu + 9 * i, W + 81 * i, amplitude[i], value_out + i, gradient_out + 9 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void mobile_manipulator_frame_f(const float *MOBILE_MANIPULATOR_RESTRICT p, float *MOBILE_MANIPULATOR_RESTRICT frame) {
    float left[9][9];
    for (int i = 0; i < 9; ++i) {
        float axis[9];
        for (int j = 0; j < 9; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        mobile_manipulator_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 9; ++row) {
        float *e = frame + 9 * row;
        int longest = 0;
        for (int i = 1; i < 9; ++i)
            if (mobile_manipulator_norm_f(p, left[i]) > mobile_manipulator_norm_f(p, left[longest])) longest = i;
        const float length = mobile_manipulator_norm_f(p, left[longest]);
        for (int j = 0; j < 9; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 9; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 9];
            const float part = mobile_manipulator_inner_f(p, e, rest);
            for (int j = 0; j < 9; ++j) rest[j] -= part * e[j];
        }
    }
}
