/*
 * dual_arm: Two arms of seven revolute joints each; distances are in radians.
 *
 * See the header for what the functions promise.
 */

#include "dual_arm.h"

#include <float.h>

/* arm1: x, periodic coordinates wrapped, arm2: x, periodic coordinates wrapped */
void dual_arm_project(const double *DUAL_ARM_RESTRICT x, double *DUAL_ARM_RESTRICT p_out) {
    const double round_2 = rint(0.15915494309189535 * x[0]);
    const double p0 = x[0] - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double round_3 = rint(0.15915494309189535 * x[1]);
    const double p1 = x[1] - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double round_4 = rint(0.15915494309189535 * x[2]);
    const double p2 = x[2] - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double round_5 = rint(0.15915494309189535 * x[3]);
    const double p3 = x[3] - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double round_6 = rint(0.15915494309189535 * x[4]);
    const double p4 = x[4] - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double round_7 = rint(0.15915494309189535 * x[5]);
    const double p5 = x[5] - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double round_8 = rint(0.15915494309189535 * x[6]);
    const double p6 = x[6] - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    const double round_9 = rint(0.15915494309189535 * x[7]);
    const double p7 = x[7] - 6.28125 * round_9 - 0.001935307179586477 * round_9;
    const double round_10 = rint(0.15915494309189535 * x[8]);
    const double p8 = x[8] - 6.28125 * round_10 - 0.001935307179586477 * round_10;
    const double round_11 = rint(0.15915494309189535 * x[9]);
    const double p9 = x[9] - 6.28125 * round_11 - 0.001935307179586477 * round_11;
    const double round_12 = rint(0.15915494309189535 * x[10]);
    const double p10 = x[10] - 6.28125 * round_12 - 0.001935307179586477 * round_12;
    const double round_13 = rint(0.15915494309189535 * x[11]);
    const double p11 = x[11] - 6.28125 * round_13 - 0.001935307179586477 * round_13;
    const double round_14 = rint(0.15915494309189535 * x[12]);
    const double p12 = x[12] - 6.28125 * round_14 - 0.001935307179586477 * round_14;
    const double round_15 = rint(0.15915494309189535 * x[13]);
    const double p13 = x[13] - 6.28125 * round_15 - 0.001935307179586477 * round_15;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
    p_out[7] = p7;
    p_out[8] = p8;
    p_out[9] = p9;
    p_out[10] = p10;
    p_out[11] = p11;
    p_out[12] = p12;
    p_out[13] = p13;
}

void dual_arm_project_batch(size_t count, const double *DUAL_ARM_RESTRICT x, double *DUAL_ARM_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_project(x + 14 * i, p_out + 14 * i);
}

/* arm1: x, arm2: x */
void dual_arm_to_tangent(
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT x,
    double *DUAL_ARM_RESTRICT v_out) {
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
    v_out[9] = x[9];
    v_out[10] = x[10];
    v_out[11] = x[11];
    v_out[12] = x[12];
    v_out[13] = x[13];
}

void dual_arm_to_tangent_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT x,
    double *DUAL_ARM_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_to_tangent(p + 14 * i, x + 14 * i, v_out + 14 * i);
}

/* inner(arm1) + inner(arm2) */
double dual_arm_inner(
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT u,
    const double *DUAL_ARM_RESTRICT v) {
    (void)p;
    const double total_2 = u[0] * v[0] + u[1] * v[1] + u[10] * v[10] + u[11] * v[11] + u[12] * v[12];
    const double total_3 = total_2 + u[13] * v[13] + u[2] * v[2] + u[3] * v[3] + u[4] * v[4];
    const double total_4 = total_3 + u[5] * v[5] + u[6] * v[6] + u[7] * v[7] + u[8] * v[8];
    return total_4 + u[9] * v[9];
}

void dual_arm_inner_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT u,
    const double *DUAL_ARM_RESTRICT v,
    double *DUAL_ARM_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = dual_arm_inner(p + 14 * i, u + 14 * i, v + 14 * i);
}

/* sqrt(norm(arm1)^2 + norm(arm2)^2) */
double dual_arm_norm(const double *DUAL_ARM_RESTRICT p, const double *DUAL_ARM_RESTRICT v) {
    (void)p;
    const double total_2 = v[0] * v[0] + v[1] * v[1] + v[10] * v[10] + v[11] * v[11] + v[12] * v[12];
    const double total_3 = total_2 + v[13] * v[13] + v[2] * v[2] + v[3] * v[3] + v[4] * v[4];
    const double total_4 = total_3 + v[5] * v[5] + v[6] * v[6] + v[7] * v[7] + v[8] * v[8];
    return sqrt(total_4 + v[9] * v[9]);
}

void dual_arm_norm_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT v,
    double *DUAL_ARM_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = dual_arm_norm(p + 14 * i, v + 14 * i);
}

/* arm1: G(p) v, arm2: G(p) v */
void dual_arm_flat(
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT v,
    double *DUAL_ARM_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
    covector_out[3] = v[3];
    covector_out[4] = v[4];
    covector_out[5] = v[5];
    covector_out[6] = v[6];
    covector_out[7] = v[7];
    covector_out[8] = v[8];
    covector_out[9] = v[9];
    covector_out[10] = v[10];
    covector_out[11] = v[11];
    covector_out[12] = v[12];
    covector_out[13] = v[13];
}

void dual_arm_flat_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT v,
    double *DUAL_ARM_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_flat(p + 14 * i, v + 14 * i, covector_out + 14 * i);
}

/* arm1: wrap(p + v), arm2: wrap(p + v) */
void dual_arm_exp(
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT v,
    double *DUAL_ARM_RESTRICT q_out) {
    const double total_2 = p[0] + v[0];
    const double round_2 = rint(0.15915494309189535 * total_2);
    const double q0 = total_2 - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double total_3 = p[1] + v[1];
    const double round_3 = rint(0.15915494309189535 * total_3);
    const double q1 = total_3 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double total_4 = p[2] + v[2];
    const double round_4 = rint(0.15915494309189535 * total_4);
    const double q2 = total_4 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double total_5 = p[3] + v[3];
    const double round_5 = rint(0.15915494309189535 * total_5);
    const double q3 = total_5 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double total_6 = p[4] + v[4];
    const double round_6 = rint(0.15915494309189535 * total_6);
    const double q4 = total_6 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double total_7 = p[5] + v[5];
    const double round_7 = rint(0.15915494309189535 * total_7);
    const double q5 = total_7 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double total_8 = p[6] + v[6];
    const double round_8 = rint(0.15915494309189535 * total_8);
    const double q6 = total_8 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    const double total_9 = p[7] + v[7];
    const double round_9 = rint(0.15915494309189535 * total_9);
    const double q7 = total_9 - 6.28125 * round_9 - 0.001935307179586477 * round_9;
    const double total_10 = p[8] + v[8];
    const double round_10 = rint(0.15915494309189535 * total_10);
    const double q8 = total_10 - 6.28125 * round_10 - 0.001935307179586477 * round_10;
    const double total_11 = p[9] + v[9];
    const double round_11 = rint(0.15915494309189535 * total_11);
    const double q9 = total_11 - 6.28125 * round_11 - 0.001935307179586477 * round_11;
    const double total_12 = p[10] + v[10];
    const double round_12 = rint(0.15915494309189535 * total_12);
    const double q10 = total_12 - 6.28125 * round_12 - 0.001935307179586477 * round_12;
    const double total_13 = p[11] + v[11];
    const double round_13 = rint(0.15915494309189535 * total_13);
    const double q11 = total_13 - 6.28125 * round_13 - 0.001935307179586477 * round_13;
    const double total_14 = p[12] + v[12];
    const double round_14 = rint(0.15915494309189535 * total_14);
    const double q12 = total_14 - 6.28125 * round_14 - 0.001935307179586477 * round_14;
    const double total_15 = p[13] + v[13];
    const double round_15 = rint(0.15915494309189535 * total_15);
    const double q13 = total_15 - 6.28125 * round_15 - 0.001935307179586477 * round_15;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
    q_out[4] = q4;
    q_out[5] = q5;
    q_out[6] = q6;
    q_out[7] = q7;
    q_out[8] = q8;
    q_out[9] = q9;
    q_out[10] = q10;
    q_out[11] = q11;
    q_out[12] = q12;
    q_out[13] = q13;
}

void dual_arm_exp_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT v,
    double *DUAL_ARM_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_exp(p + 14 * i, v + 14 * i, q_out + 14 * i);
}

/* arm1: wrap(q - p), arm2: wrap(q - p) */
void dual_arm_log(
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT q,
    double *DUAL_ARM_RESTRICT v_out) {
    const double gap = q[0] - p[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = q[1] - p[1];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double gap_3 = q[2] - p[2];
    const double round_4 = rint(0.15915494309189535 * gap_3);
    const double v2 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double gap_4 = q[3] - p[3];
    const double round_5 = rint(0.15915494309189535 * gap_4);
    const double v3 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double gap_5 = q[4] - p[4];
    const double round_6 = rint(0.15915494309189535 * gap_5);
    const double v4 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double gap_6 = q[5] - p[5];
    const double round_7 = rint(0.15915494309189535 * gap_6);
    const double v5 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double gap_7 = q[6] - p[6];
    const double round_8 = rint(0.15915494309189535 * gap_7);
    const double v6 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    const double gap_8 = q[7] - p[7];
    const double round_9 = rint(0.15915494309189535 * gap_8);
    const double v7 = gap_8 - 6.28125 * round_9 - 0.001935307179586477 * round_9;
    const double gap_9 = q[8] - p[8];
    const double round_10 = rint(0.15915494309189535 * gap_9);
    const double v8 = gap_9 - 6.28125 * round_10 - 0.001935307179586477 * round_10;
    const double gap_10 = q[9] - p[9];
    const double round_11 = rint(0.15915494309189535 * gap_10);
    const double v9 = gap_10 - 6.28125 * round_11 - 0.001935307179586477 * round_11;
    const double gap_11 = q[10] - p[10];
    const double round_12 = rint(0.15915494309189535 * gap_11);
    const double v10 = gap_11 - 6.28125 * round_12 - 0.001935307179586477 * round_12;
    const double gap_12 = q[11] - p[11];
    const double round_13 = rint(0.15915494309189535 * gap_12);
    const double v11 = gap_12 - 6.28125 * round_13 - 0.001935307179586477 * round_13;
    const double gap_13 = q[12] - p[12];
    const double round_14 = rint(0.15915494309189535 * gap_13);
    const double v12 = gap_13 - 6.28125 * round_14 - 0.001935307179586477 * round_14;
    const double gap_14 = q[13] - p[13];
    const double round_15 = rint(0.15915494309189535 * gap_14);
    const double v13 = gap_14 - 6.28125 * round_15 - 0.001935307179586477 * round_15;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
    v_out[3] = v3;
    v_out[4] = v4;
    v_out[5] = v5;
    v_out[6] = v6;
    v_out[7] = v7;
    v_out[8] = v8;
    v_out[9] = v9;
    v_out[10] = v10;
    v_out[11] = v11;
    v_out[12] = v12;
    v_out[13] = v13;
}

void dual_arm_log_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT q,
    double *DUAL_ARM_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_log(p + 14 * i, q + 14 * i, v_out + 14 * i);
}

/* sqrt(distance(arm1)^2 + distance(arm2)^2) */
double dual_arm_distance(const double *DUAL_ARM_RESTRICT p, const double *DUAL_ARM_RESTRICT q) {
    const double gap = q[0] - p[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double arm1_log0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = q[1] - p[1];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double arm1_log1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double gap_3 = q[2] - p[2];
    const double round_4 = rint(0.15915494309189535 * gap_3);
    const double arm1_log2 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double gap_4 = q[3] - p[3];
    const double round_5 = rint(0.15915494309189535 * gap_4);
    const double arm1_log3 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double gap_5 = q[4] - p[4];
    const double round_6 = rint(0.15915494309189535 * gap_5);
    const double arm1_log4 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double gap_6 = q[5] - p[5];
    const double round_7 = rint(0.15915494309189535 * gap_6);
    const double arm1_log5 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double gap_7 = q[6] - p[6];
    const double round_8 = rint(0.15915494309189535 * gap_7);
    const double arm1_log6 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    const double gap_8 = q[7] - p[7];
    const double round_9 = rint(0.15915494309189535 * gap_8);
    const double arm2_log0 = gap_8 - 6.28125 * round_9 - 0.001935307179586477 * round_9;
    const double gap_9 = q[8] - p[8];
    const double round_10 = rint(0.15915494309189535 * gap_9);
    const double arm2_log1 = gap_9 - 6.28125 * round_10 - 0.001935307179586477 * round_10;
    const double gap_10 = q[9] - p[9];
    const double round_11 = rint(0.15915494309189535 * gap_10);
    const double arm2_log2 = gap_10 - 6.28125 * round_11 - 0.001935307179586477 * round_11;
    const double gap_11 = q[10] - p[10];
    const double round_12 = rint(0.15915494309189535 * gap_11);
    const double arm2_log3 = gap_11 - 6.28125 * round_12 - 0.001935307179586477 * round_12;
    const double gap_12 = q[11] - p[11];
    const double round_13 = rint(0.15915494309189535 * gap_12);
    const double arm2_log4 = gap_12 - 6.28125 * round_13 - 0.001935307179586477 * round_13;
    const double gap_13 = q[12] - p[12];
    const double round_14 = rint(0.15915494309189535 * gap_13);
    const double arm2_log5 = gap_13 - 6.28125 * round_14 - 0.001935307179586477 * round_14;
    const double gap_14 = q[13] - p[13];
    const double round_15 = rint(0.15915494309189535 * gap_14);
    const double arm2_log6 = gap_14 - 6.28125 * round_15 - 0.001935307179586477 * round_15;
    const double total_2 = arm1_log0 * arm1_log0 + arm1_log1 * arm1_log1 + arm1_log2 * arm1_log2 + arm1_log3 *
        arm1_log3 + arm1_log4 * arm1_log4;
    const double total_3 = total_2 + arm1_log5 * arm1_log5 + arm1_log6 * arm1_log6 + arm2_log0 * arm2_log0 +
        arm2_log1 * arm2_log1;
    const double total_4 = total_3 + arm2_log2 * arm2_log2 + arm2_log3 * arm2_log3 + arm2_log4 * arm2_log4 +
        arm2_log5 * arm2_log5;
    return sqrt(total_4 + arm2_log6 * arm2_log6);
}

void dual_arm_distance_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT q,
    double *DUAL_ARM_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = dual_arm_distance(p + 14 * i, q + 14 * i);
}

/* log_abs_det(arm1) + log_abs_det(arm2) */
double dual_arm_log_abs_det(const double *DUAL_ARM_RESTRICT p, const double *DUAL_ARM_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0;
}

void dual_arm_log_abs_det_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT q,
    double *DUAL_ARM_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = dual_arm_log_abs_det(p + 14 * i, q + 14 * i);
}

/* arm1: G(p)^-1 df, arm2: G(p)^-1 df */
void dual_arm_riemannian_gradient(
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT df,
    double *DUAL_ARM_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
    gradient_out[2] = df[2];
    gradient_out[3] = df[3];
    gradient_out[4] = df[4];
    gradient_out[5] = df[5];
    gradient_out[6] = df[6];
    gradient_out[7] = df[7];
    gradient_out[8] = df[8];
    gradient_out[9] = df[9];
    gradient_out[10] = df[10];
    gradient_out[11] = df[11];
    gradient_out[12] = df[12];
    gradient_out[13] = df[13];
}

void dual_arm_riemannian_gradient_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT df,
    double *DUAL_ARM_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_riemannian_gradient(p + 14 * i, df + 14 * i, gradient_out + 14 * i);
}

/* sqrt(gradient_norm(arm1)^2 + gradient_norm(arm2)^2) */
double dual_arm_gradient_norm(const double *DUAL_ARM_RESTRICT p, const double *DUAL_ARM_RESTRICT df) {
    (void)p;
    const double total_2 = df[0] * df[0] + df[1] * df[1] + df[10] * df[10] + df[11] * df[11] + df[12] *
        df[12];
    const double total_3 = total_2 + df[13] * df[13] + df[2] * df[2] + df[3] * df[3] + df[4] * df[4];
    const double total_4 = total_3 + df[5] * df[5] + df[6] * df[6] + df[7] * df[7] + df[8] * df[8];
    return sqrt(total_4 + df[9] * df[9]);
}

void dual_arm_gradient_norm_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT df,
    double *DUAL_ARM_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = dual_arm_gradient_norm(p + 14 * i, df + 14 * i);
}

/* arm1: v, arm2: v */
void dual_arm_transport(
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT q,
    const double *DUAL_ARM_RESTRICT v,
    double *DUAL_ARM_RESTRICT w_out) {
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
    w_out[9] = v[9];
    w_out[10] = v[10];
    w_out[11] = v[11];
    w_out[12] = v[12];
    w_out[13] = v[13];
}

void dual_arm_transport_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT p,
    const double *DUAL_ARM_RESTRICT q,
    const double *DUAL_ARM_RESTRICT v,
    double *DUAL_ARM_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_transport(p + 14 * i, q + 14 * i, v + 14 * i, w_out + 14 * i);
}

/* arm1: wrap(2 * pi * uniform), arm2: wrap(2 * pi * uniform) */
void dual_arm_sample(
    const double *DUAL_ARM_RESTRICT normal,
    const double *DUAL_ARM_RESTRICT uniform,
    double *DUAL_ARM_RESTRICT p_out) {
    (void)normal;
    const double round_2 = rint(uniform[0]);
    const double p0 = 6.283185307179586 * uniform[0] - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double round_3 = rint(uniform[1]);
    const double p1 = 6.283185307179586 * uniform[1] - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double round_4 = rint(uniform[2]);
    const double p2 = 6.283185307179586 * uniform[2] - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double round_5 = rint(uniform[3]);
    const double p3 = 6.283185307179586 * uniform[3] - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double round_6 = rint(uniform[4]);
    const double p4 = 6.283185307179586 * uniform[4] - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double round_7 = rint(uniform[5]);
    const double p5 = 6.283185307179586 * uniform[5] - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double round_8 = rint(uniform[6]);
    const double p6 = 6.283185307179586 * uniform[6] - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    const double round_9 = rint(uniform[7]);
    const double p7 = 6.283185307179586 * uniform[7] - 6.28125 * round_9 - 0.001935307179586477 * round_9;
    const double round_10 = rint(uniform[8]);
    const double p8 = 6.283185307179586 * uniform[8] - 6.28125 * round_10 - 0.001935307179586477 * round_10;
    const double round_11 = rint(uniform[9]);
    const double p9 = 6.283185307179586 * uniform[9] - 6.28125 * round_11 - 0.001935307179586477 * round_11;
    const double round_12 = rint(uniform[10]);
    const double p10 = 6.283185307179586 * uniform[10] - 6.28125 * round_12 - 0.001935307179586477 * round_12;
    const double round_13 = rint(uniform[11]);
    const double p11 = 6.283185307179586 * uniform[11] - 6.28125 * round_13 - 0.001935307179586477 * round_13;
    const double round_14 = rint(uniform[12]);
    const double p12 = 6.283185307179586 * uniform[12] - 6.28125 * round_14 - 0.001935307179586477 * round_14;
    const double round_15 = rint(uniform[13]);
    const double p13 = 6.283185307179586 * uniform[13] - 6.28125 * round_15 - 0.001935307179586477 * round_15;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
    p_out[7] = p7;
    p_out[8] = p8;
    p_out[9] = p9;
    p_out[10] = p10;
    p_out[11] = p11;
    p_out[12] = p12;
    p_out[13] = p13;
}

void dual_arm_sample_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT normal,
    const double *DUAL_ARM_RESTRICT uniform,
    double *DUAL_ARM_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_sample(normal + 14 * i, uniform + 14 * i, p_out + 14 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void dual_arm_splat(
    const double *DUAL_ARM_RESTRICT x,
    const double *DUAL_ARM_RESTRICT mu,
    const double *DUAL_ARM_RESTRICT W,
    double amplitude,
    double *DUAL_ARM_RESTRICT value_out,
    double *DUAL_ARM_RESTRICT gradient_out) {
    const double gap = x[0] - mu[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = x[1] - mu[1];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double gap_3 = x[2] - mu[2];
    const double round_4 = rint(0.15915494309189535 * gap_3);
    const double v2 = gap_3 - 6.28125 * round_4 - 0.001935307179586477 * round_4;
    const double gap_4 = x[3] - mu[3];
    const double round_5 = rint(0.15915494309189535 * gap_4);
    const double v3 = gap_4 - 6.28125 * round_5 - 0.001935307179586477 * round_5;
    const double gap_5 = x[4] - mu[4];
    const double round_6 = rint(0.15915494309189535 * gap_5);
    const double v4 = gap_5 - 6.28125 * round_6 - 0.001935307179586477 * round_6;
    const double gap_6 = x[5] - mu[5];
    const double round_7 = rint(0.15915494309189535 * gap_6);
    const double v5 = gap_6 - 6.28125 * round_7 - 0.001935307179586477 * round_7;
    const double gap_7 = x[6] - mu[6];
    const double round_8 = rint(0.15915494309189535 * gap_7);
    const double v6 = gap_7 - 6.28125 * round_8 - 0.001935307179586477 * round_8;
    const double gap_8 = x[7] - mu[7];
    const double round_9 = rint(0.15915494309189535 * gap_8);
    const double v7 = gap_8 - 6.28125 * round_9 - 0.001935307179586477 * round_9;
    const double gap_9 = x[8] - mu[8];
    const double round_10 = rint(0.15915494309189535 * gap_9);
    const double v8 = gap_9 - 6.28125 * round_10 - 0.001935307179586477 * round_10;
    const double gap_10 = x[9] - mu[9];
    const double round_11 = rint(0.15915494309189535 * gap_10);
    const double v9 = gap_10 - 6.28125 * round_11 - 0.001935307179586477 * round_11;
    const double gap_11 = x[10] - mu[10];
    const double round_12 = rint(0.15915494309189535 * gap_11);
    const double v10 = gap_11 - 6.28125 * round_12 - 0.001935307179586477 * round_12;
    const double gap_12 = x[11] - mu[11];
    const double round_13 = rint(0.15915494309189535 * gap_12);
    const double v11 = gap_12 - 6.28125 * round_13 - 0.001935307179586477 * round_13;
    const double gap_13 = x[12] - mu[12];
    const double round_14 = rint(0.15915494309189535 * gap_13);
    const double v12 = gap_13 - 6.28125 * round_14 - 0.001935307179586477 * round_14;
    const double gap_14 = x[13] - mu[13];
    const double round_15 = rint(0.15915494309189535 * gap_14);
    const double v13 = gap_14 - 6.28125 * round_15 - 0.001935307179586477 * round_15;
    const double total_2 = W[0] * v0 + W[1] * v1 + W[2] * v2 + W[3] * v3 + W[4] * v4;
    const double total_3 = total_2 + W[5] * v5 + W[6] * v6 + W[7] * v7 + W[8] * v8;
    const double total_4 = total_3 + W[9] * v9 + W[10] * v10 + W[11] * v11 + W[12] * v12;
    const double z0 = total_4 + W[13] * v13;
    const double total_5 = W[14] * v0 + W[15] * v1 + W[16] * v2 + W[17] * v3 + W[18] * v4;
    const double total_6 = total_5 + W[19] * v5 + W[20] * v6 + W[21] * v7 + W[22] * v8;
    const double total_7 = total_6 + W[23] * v9 + W[24] * v10 + W[25] * v11 + W[26] * v12;
    const double z1 = total_7 + W[27] * v13;
    const double total_8 = W[28] * v0 + W[29] * v1 + W[30] * v2 + W[31] * v3 + W[32] * v4;
    const double total_9 = total_8 + W[33] * v5 + W[34] * v6 + W[35] * v7 + W[36] * v8;
    const double total_10 = total_9 + W[37] * v9 + W[38] * v10 + W[39] * v11 + W[40] * v12;
    const double z2 = total_10 + W[41] * v13;
    const double total_11 = W[42] * v0 + W[43] * v1 + W[44] * v2 + W[45] * v3 + W[46] * v4;
    const double total_12 = total_11 + W[47] * v5 + W[48] * v6 + W[49] * v7 + W[50] * v8;
    const double total_13 = total_12 + W[51] * v9 + W[52] * v10 + W[53] * v11 + W[54] * v12;
    const double z3 = total_13 + W[55] * v13;
    const double total_14 = W[56] * v0 + W[57] * v1 + W[58] * v2 + W[59] * v3 + W[60] * v4;
    const double total_15 = total_14 + W[61] * v5 + W[62] * v6 + W[63] * v7 + W[64] * v8;
    const double total_16 = total_15 + W[65] * v9 + W[66] * v10 + W[67] * v11 + W[68] * v12;
    const double z4 = total_16 + W[69] * v13;
    const double total_17 = W[70] * v0 + W[71] * v1 + W[72] * v2 + W[73] * v3 + W[74] * v4;
    const double total_18 = total_17 + W[75] * v5 + W[76] * v6 + W[77] * v7 + W[78] * v8;
    const double total_19 = total_18 + W[79] * v9 + W[80] * v10 + W[81] * v11 + W[82] * v12;
    const double z5 = total_19 + W[83] * v13;
    const double total_20 = W[84] * v0 + W[85] * v1 + W[86] * v2 + W[87] * v3 + W[88] * v4;
    const double total_21 = total_20 + W[89] * v5 + W[90] * v6 + W[91] * v7 + W[92] * v8;
    const double total_22 = total_21 + W[93] * v9 + W[94] * v10 + W[95] * v11 + W[96] * v12;
    const double z6 = total_22 + W[97] * v13;
    const double total_23 = W[98] * v0 + W[99] * v1 + W[100] * v2 + W[101] * v3 + W[102] * v4;
    const double total_24 = total_23 + W[103] * v5 + W[104] * v6 + W[105] * v7 + W[106] * v8;
    const double total_25 = total_24 + W[107] * v9 + W[108] * v10 + W[109] * v11 + W[110] * v12;
    const double z7 = total_25 + W[111] * v13;
    const double total_26 = W[112] * v0 + W[113] * v1 + W[114] * v2 + W[115] * v3 + W[116] * v4;
    const double total_27 = total_26 + W[117] * v5 + W[118] * v6 + W[119] * v7 + W[120] * v8;
    const double total_28 = total_27 + W[121] * v9 + W[122] * v10 + W[123] * v11 + W[124] * v12;
    const double z8 = total_28 + W[125] * v13;
    const double total_29 = W[126] * v0 + W[127] * v1 + W[128] * v2 + W[129] * v3 + W[130] * v4;
    const double total_30 = total_29 + W[131] * v5 + W[132] * v6 + W[133] * v7 + W[134] * v8;
    const double total_31 = total_30 + W[135] * v9 + W[136] * v10 + W[137] * v11 + W[138] * v12;
    const double z9 = total_31 + W[139] * v13;
    const double total_32 = W[140] * v0 + W[141] * v1 + W[142] * v2 + W[143] * v3 + W[144] * v4;
    const double total_33 = total_32 + W[145] * v5 + W[146] * v6 + W[147] * v7 + W[148] * v8;
    const double total_34 = total_33 + W[149] * v9 + W[150] * v10 + W[151] * v11 + W[152] * v12;
    const double z10 = total_34 + W[153] * v13;
    const double total_35 = W[154] * v0 + W[155] * v1 + W[156] * v2 + W[157] * v3 + W[158] * v4;
    const double total_36 = total_35 + W[159] * v5 + W[160] * v6 + W[161] * v7 + W[162] * v8;
    const double total_37 = total_36 + W[163] * v9 + W[164] * v10 + W[165] * v11 + W[166] * v12;
    const double z11 = total_37 + W[167] * v13;
    const double total_38 = W[168] * v0 + W[169] * v1 + W[170] * v2 + W[171] * v3 + W[172] * v4;
    const double total_39 = total_38 + W[173] * v5 + W[174] * v6 + W[175] * v7 + W[176] * v8;
    const double total_40 = total_39 + W[177] * v9 + W[178] * v10 + W[179] * v11 + W[180] * v12;
    const double z12 = total_40 + W[181] * v13;
    const double total_41 = W[182] * v0 + W[183] * v1 + W[184] * v2 + W[185] * v3 + W[186] * v4;
    const double total_42 = total_41 + W[187] * v5 + W[188] * v6 + W[189] * v7 + W[190] * v8;
    const double total_43 = total_42 + W[191] * v9 + W[192] * v10 + W[193] * v11 + W[194] * v12;
    const double z13 = total_43 + W[195] * v13;
    const double total_44 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
    const double total_45 = total_44 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
    const double total_46 = total_45 + z9 * z9 + z10 * z10 + z11 * z11 + z12 * z12;
    const double exp_2 = exp(-(0.5 * (total_46 + z13 * z13)));
    const double phi = amplitude * exp_2;
    const double gap_15 = -(W[195] * z13) - W[181] * z12 - W[167] * z11 - W[153] * z10;
    const double gap_16 = -(W[194] * z13) - W[180] * z12 - W[166] * z11 - W[152] * z10;
    const double gap_17 = -(W[193] * z13) - W[179] * z12 - W[165] * z11 - W[151] * z10;
    const double gap_18 = -(W[192] * z13) - W[178] * z12 - W[164] * z11 - W[150] * z10;
    const double gap_19 = -(W[191] * z13) - W[177] * z12 - W[163] * z11 - W[149] * z10;
    const double gap_20 = -(W[190] * z13) - W[176] * z12 - W[162] * z11 - W[148] * z10;
    const double gap_21 = -(W[189] * z13) - W[175] * z12 - W[161] * z11 - W[147] * z10;
    const double gap_22 = -(W[188] * z13) - W[174] * z12 - W[160] * z11 - W[146] * z10;
    const double gap_23 = -(W[187] * z13) - W[173] * z12 - W[159] * z11 - W[145] * z10;
    const double gap_24 = -(W[186] * z13) - W[172] * z12 - W[158] * z11 - W[144] * z10;
    const double gap_25 = -(W[185] * z13) - W[171] * z12 - W[157] * z11 - W[143] * z10;
    const double gap_26 = -(W[184] * z13) - W[170] * z12 - W[156] * z11 - W[142] * z10;
    const double gap_27 = -(W[183] * z13) - W[169] * z12 - W[155] * z11 - W[141] * z10;
    const double gap_28 = -(W[182] * z13) - W[168] * z12 - W[154] * z11 - W[140] * z10;
    const double gap_29 = gap_15 - W[139] * z9 - W[125] * z8 - W[111] * z7 - W[97] * z6;
    const double gap_30 = gap_16 - W[138] * z9 - W[124] * z8 - W[110] * z7 - W[96] * z6;
    const double gap_31 = gap_17 - W[137] * z9 - W[123] * z8 - W[109] * z7 - W[95] * z6;
    const double gap_32 = gap_18 - W[136] * z9 - W[122] * z8 - W[108] * z7 - W[94] * z6;
    const double gap_33 = gap_19 - W[135] * z9 - W[121] * z8 - W[107] * z7 - W[93] * z6;
    const double gap_34 = gap_20 - W[134] * z9 - W[120] * z8 - W[106] * z7 - W[92] * z6;
    const double gap_35 = gap_21 - W[133] * z9 - W[119] * z8 - W[105] * z7 - W[91] * z6;
    const double gap_36 = gap_22 - W[132] * z9 - W[118] * z8 - W[104] * z7 - W[90] * z6;
    const double gap_37 = gap_23 - W[131] * z9 - W[117] * z8 - W[103] * z7 - W[89] * z6;
    const double gap_38 = gap_24 - W[130] * z9 - W[116] * z8 - W[102] * z7 - W[88] * z6;
    const double gap_39 = gap_25 - W[129] * z9 - W[115] * z8 - W[101] * z7 - W[87] * z6;
    const double gap_40 = gap_26 - W[128] * z9 - W[114] * z8 - W[100] * z7 - W[86] * z6;
    const double gap_41 = gap_27 - W[127] * z9 - W[113] * z8 - W[99] * z7 - W[85] * z6;
    const double gap_42 = gap_28 - W[126] * z9 - W[112] * z8 - W[98] * z7 - W[84] * z6;
    const double gap_43 = gap_29 - W[83] * z5 - W[69] * z4 - W[55] * z3 - W[41] * z2;
    const double gap_44 = gap_30 - W[82] * z5 - W[68] * z4 - W[54] * z3 - W[40] * z2;
    const double gap_45 = gap_31 - W[81] * z5 - W[67] * z4 - W[53] * z3 - W[39] * z2;
    const double gap_46 = gap_32 - W[80] * z5 - W[66] * z4 - W[52] * z3 - W[38] * z2;
    const double gap_47 = gap_33 - W[79] * z5 - W[65] * z4 - W[51] * z3 - W[37] * z2;
    const double gap_48 = gap_34 - W[78] * z5 - W[64] * z4 - W[50] * z3 - W[36] * z2;
    const double gap_49 = gap_35 - W[77] * z5 - W[63] * z4 - W[49] * z3 - W[35] * z2;
    const double gap_50 = gap_36 - W[76] * z5 - W[62] * z4 - W[48] * z3 - W[34] * z2;
    const double gap_51 = gap_37 - W[75] * z5 - W[61] * z4 - W[47] * z3 - W[33] * z2;
    const double gap_52 = gap_38 - W[74] * z5 - W[60] * z4 - W[46] * z3 - W[32] * z2;
    const double gap_53 = gap_39 - W[73] * z5 - W[59] * z4 - W[45] * z3 - W[31] * z2;
    const double gap_54 = gap_40 - W[72] * z5 - W[58] * z4 - W[44] * z3 - W[30] * z2;
    const double gap_55 = gap_41 - W[71] * z5 - W[57] * z4 - W[43] * z3 - W[29] * z2;
    const double gap_56 = gap_42 - W[70] * z5 - W[56] * z4 - W[42] * z3 - W[28] * z2;
    const double by_v13 = gap_43 - W[27] * z1 - W[13] * z0;
    const double by_v12 = gap_44 - W[26] * z1 - W[12] * z0;
    const double by_v11 = gap_45 - W[25] * z1 - W[11] * z0;
    const double by_v10 = gap_46 - W[24] * z1 - W[10] * z0;
    const double by_v9 = gap_47 - W[23] * z1 - W[9] * z0;
    const double by_v8 = gap_48 - W[22] * z1 - W[8] * z0;
    const double by_v7 = gap_49 - W[21] * z1 - W[7] * z0;
    const double by_v6 = gap_50 - W[20] * z1 - W[6] * z0;
    const double by_v5 = gap_51 - W[19] * z1 - W[5] * z0;
    const double by_v4 = gap_52 - W[18] * z1 - W[4] * z0;
    const double by_v3 = gap_53 - W[17] * z1 - W[3] * z0;
    const double by_v2 = gap_54 - W[16] * z1 - W[2] * z0;
    const double by_v1 = gap_55 - W[15] * z1 - W[1] * z0;
    const double by_v0 = gap_56 - W[14] * z1 - W[0] * z0;
    const double df0 = phi * by_v0;
    const double df1 = phi * by_v1;
    const double df2 = phi * by_v2;
    const double df3 = phi * by_v3;
    const double df4 = phi * by_v4;
    const double df5 = phi * by_v5;
    const double df6 = phi * by_v6;
    const double df7 = phi * by_v7;
    const double df8 = phi * by_v8;
    const double df9 = phi * by_v9;
    const double df10 = phi * by_v10;
    const double df11 = phi * by_v11;
    const double df12 = phi * by_v12;
    const double df13 = phi * by_v13;
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
    gradient_out[2] = df2;
    gradient_out[3] = df3;
    gradient_out[4] = df4;
    gradient_out[5] = df5;
    gradient_out[6] = df6;
    gradient_out[7] = df7;
    gradient_out[8] = df8;
    gradient_out[9] = df9;
    gradient_out[10] = df10;
    gradient_out[11] = df11;
    gradient_out[12] = df12;
    gradient_out[13] = df13;
}

void dual_arm_splat_batch(
    size_t count,
    const double *DUAL_ARM_RESTRICT x,
    const double *DUAL_ARM_RESTRICT mu,
    const double *DUAL_ARM_RESTRICT W,
    const double *DUAL_ARM_RESTRICT amplitude,
    double *DUAL_ARM_RESTRICT value_out,
    double *DUAL_ARM_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_splat(x + 14 * i, mu + 14 * i, W + 196 * i, amplitude[i], value_out + i, gradient_out + 14 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void dual_arm_frame(const double *DUAL_ARM_RESTRICT p, double *DUAL_ARM_RESTRICT frame) {
    double left[14][14];
    for (int i = 0; i < 14; ++i) {
        double axis[14];
        for (int j = 0; j < 14; ++j) axis[j] = i == j ? 1.0 : 0.0;
        dual_arm_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 14; ++row) {
        double *e = frame + 14 * row;
        int longest = 0;
        for (int i = 1; i < 14; ++i)
            if (dual_arm_norm(p, left[i]) > dual_arm_norm(p, left[longest])) longest = i;
        const double length = dual_arm_norm(p, left[longest]);
        for (int j = 0; j < 14; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 14; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 14];
            const double part = dual_arm_inner(p, e, rest);
            for (int j = 0; j < 14; ++j) rest[j] -= part * e[j];
        }
    }
}

/* arm1: x, periodic coordinates wrapped, arm2: x, periodic coordinates wrapped */
void dual_arm_project_f(const float *DUAL_ARM_RESTRICT x, float *DUAL_ARM_RESTRICT p_out) {
    const float round_2 = rintf(0.15915494309189535f * x[0]);
    const float p0 = x[0] - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float round_3 = rintf(0.15915494309189535f * x[1]);
    const float p1 = x[1] - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float round_4 = rintf(0.15915494309189535f * x[2]);
    const float p2 = x[2] - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float round_5 = rintf(0.15915494309189535f * x[3]);
    const float p3 = x[3] - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float round_6 = rintf(0.15915494309189535f * x[4]);
    const float p4 = x[4] - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float round_7 = rintf(0.15915494309189535f * x[5]);
    const float p5 = x[5] - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float round_8 = rintf(0.15915494309189535f * x[6]);
    const float p6 = x[6] - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    const float round_9 = rintf(0.15915494309189535f * x[7]);
    const float p7 = x[7] - 6.28125f * round_9 - 0.001935307179586477f * round_9;
    const float round_10 = rintf(0.15915494309189535f * x[8]);
    const float p8 = x[8] - 6.28125f * round_10 - 0.001935307179586477f * round_10;
    const float round_11 = rintf(0.15915494309189535f * x[9]);
    const float p9 = x[9] - 6.28125f * round_11 - 0.001935307179586477f * round_11;
    const float round_12 = rintf(0.15915494309189535f * x[10]);
    const float p10 = x[10] - 6.28125f * round_12 - 0.001935307179586477f * round_12;
    const float round_13 = rintf(0.15915494309189535f * x[11]);
    const float p11 = x[11] - 6.28125f * round_13 - 0.001935307179586477f * round_13;
    const float round_14 = rintf(0.15915494309189535f * x[12]);
    const float p12 = x[12] - 6.28125f * round_14 - 0.001935307179586477f * round_14;
    const float round_15 = rintf(0.15915494309189535f * x[13]);
    const float p13 = x[13] - 6.28125f * round_15 - 0.001935307179586477f * round_15;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
    p_out[7] = p7;
    p_out[8] = p8;
    p_out[9] = p9;
    p_out[10] = p10;
    p_out[11] = p11;
    p_out[12] = p12;
    p_out[13] = p13;
}

void dual_arm_project_batch_f(size_t count, const float *DUAL_ARM_RESTRICT x, float *DUAL_ARM_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_project_f(x + 14 * i, p_out + 14 * i);
}

/* arm1: x, arm2: x */
void dual_arm_to_tangent_f(
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT x,
    float *DUAL_ARM_RESTRICT v_out) {
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
    v_out[9] = x[9];
    v_out[10] = x[10];
    v_out[11] = x[11];
    v_out[12] = x[12];
    v_out[13] = x[13];
}

void dual_arm_to_tangent_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT x,
    float *DUAL_ARM_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_to_tangent_f(p + 14 * i, x + 14 * i, v_out + 14 * i);
}

/* inner(arm1) + inner(arm2) */
float dual_arm_inner_f(
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT u,
    const float *DUAL_ARM_RESTRICT v) {
    (void)p;
    const float total_2 = u[0] * v[0] + u[1] * v[1] + u[10] * v[10] + u[11] * v[11] + u[12] * v[12];
    const float total_3 = total_2 + u[13] * v[13] + u[2] * v[2] + u[3] * v[3] + u[4] * v[4];
    const float total_4 = total_3 + u[5] * v[5] + u[6] * v[6] + u[7] * v[7] + u[8] * v[8];
    return total_4 + u[9] * v[9];
}

void dual_arm_inner_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT u,
    const float *DUAL_ARM_RESTRICT v,
    float *DUAL_ARM_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = dual_arm_inner_f(p + 14 * i, u + 14 * i, v + 14 * i);
}

/* sqrt(norm(arm1)^2 + norm(arm2)^2) */
float dual_arm_norm_f(const float *DUAL_ARM_RESTRICT p, const float *DUAL_ARM_RESTRICT v) {
    (void)p;
    const float total_2 = v[0] * v[0] + v[1] * v[1] + v[10] * v[10] + v[11] * v[11] + v[12] * v[12];
    const float total_3 = total_2 + v[13] * v[13] + v[2] * v[2] + v[3] * v[3] + v[4] * v[4];
    const float total_4 = total_3 + v[5] * v[5] + v[6] * v[6] + v[7] * v[7] + v[8] * v[8];
    return sqrtf(total_4 + v[9] * v[9]);
}

void dual_arm_norm_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT v,
    float *DUAL_ARM_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = dual_arm_norm_f(p + 14 * i, v + 14 * i);
}

/* arm1: G(p) v, arm2: G(p) v */
void dual_arm_flat_f(
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT v,
    float *DUAL_ARM_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
    covector_out[3] = v[3];
    covector_out[4] = v[4];
    covector_out[5] = v[5];
    covector_out[6] = v[6];
    covector_out[7] = v[7];
    covector_out[8] = v[8];
    covector_out[9] = v[9];
    covector_out[10] = v[10];
    covector_out[11] = v[11];
    covector_out[12] = v[12];
    covector_out[13] = v[13];
}

void dual_arm_flat_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT v,
    float *DUAL_ARM_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_flat_f(p + 14 * i, v + 14 * i, covector_out + 14 * i);
}

/* arm1: wrap(p + v), arm2: wrap(p + v) */
void dual_arm_exp_f(
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT v,
    float *DUAL_ARM_RESTRICT q_out) {
    const float total_2 = p[0] + v[0];
    const float round_2 = rintf(0.15915494309189535f * total_2);
    const float q0 = total_2 - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float total_3 = p[1] + v[1];
    const float round_3 = rintf(0.15915494309189535f * total_3);
    const float q1 = total_3 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float total_4 = p[2] + v[2];
    const float round_4 = rintf(0.15915494309189535f * total_4);
    const float q2 = total_4 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float total_5 = p[3] + v[3];
    const float round_5 = rintf(0.15915494309189535f * total_5);
    const float q3 = total_5 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float total_6 = p[4] + v[4];
    const float round_6 = rintf(0.15915494309189535f * total_6);
    const float q4 = total_6 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float total_7 = p[5] + v[5];
    const float round_7 = rintf(0.15915494309189535f * total_7);
    const float q5 = total_7 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float total_8 = p[6] + v[6];
    const float round_8 = rintf(0.15915494309189535f * total_8);
    const float q6 = total_8 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    const float total_9 = p[7] + v[7];
    const float round_9 = rintf(0.15915494309189535f * total_9);
    const float q7 = total_9 - 6.28125f * round_9 - 0.001935307179586477f * round_9;
    const float total_10 = p[8] + v[8];
    const float round_10 = rintf(0.15915494309189535f * total_10);
    const float q8 = total_10 - 6.28125f * round_10 - 0.001935307179586477f * round_10;
    const float total_11 = p[9] + v[9];
    const float round_11 = rintf(0.15915494309189535f * total_11);
    const float q9 = total_11 - 6.28125f * round_11 - 0.001935307179586477f * round_11;
    const float total_12 = p[10] + v[10];
    const float round_12 = rintf(0.15915494309189535f * total_12);
    const float q10 = total_12 - 6.28125f * round_12 - 0.001935307179586477f * round_12;
    const float total_13 = p[11] + v[11];
    const float round_13 = rintf(0.15915494309189535f * total_13);
    const float q11 = total_13 - 6.28125f * round_13 - 0.001935307179586477f * round_13;
    const float total_14 = p[12] + v[12];
    const float round_14 = rintf(0.15915494309189535f * total_14);
    const float q12 = total_14 - 6.28125f * round_14 - 0.001935307179586477f * round_14;
    const float total_15 = p[13] + v[13];
    const float round_15 = rintf(0.15915494309189535f * total_15);
    const float q13 = total_15 - 6.28125f * round_15 - 0.001935307179586477f * round_15;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
    q_out[3] = q3;
    q_out[4] = q4;
    q_out[5] = q5;
    q_out[6] = q6;
    q_out[7] = q7;
    q_out[8] = q8;
    q_out[9] = q9;
    q_out[10] = q10;
    q_out[11] = q11;
    q_out[12] = q12;
    q_out[13] = q13;
}

void dual_arm_exp_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT v,
    float *DUAL_ARM_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_exp_f(p + 14 * i, v + 14 * i, q_out + 14 * i);
}

/* arm1: wrap(q - p), arm2: wrap(q - p) */
void dual_arm_log_f(
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT q,
    float *DUAL_ARM_RESTRICT v_out) {
    const float gap = q[0] - p[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = q[1] - p[1];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float gap_3 = q[2] - p[2];
    const float round_4 = rintf(0.15915494309189535f * gap_3);
    const float v2 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float gap_4 = q[3] - p[3];
    const float round_5 = rintf(0.15915494309189535f * gap_4);
    const float v3 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float gap_5 = q[4] - p[4];
    const float round_6 = rintf(0.15915494309189535f * gap_5);
    const float v4 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float gap_6 = q[5] - p[5];
    const float round_7 = rintf(0.15915494309189535f * gap_6);
    const float v5 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float gap_7 = q[6] - p[6];
    const float round_8 = rintf(0.15915494309189535f * gap_7);
    const float v6 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    const float gap_8 = q[7] - p[7];
    const float round_9 = rintf(0.15915494309189535f * gap_8);
    const float v7 = gap_8 - 6.28125f * round_9 - 0.001935307179586477f * round_9;
    const float gap_9 = q[8] - p[8];
    const float round_10 = rintf(0.15915494309189535f * gap_9);
    const float v8 = gap_9 - 6.28125f * round_10 - 0.001935307179586477f * round_10;
    const float gap_10 = q[9] - p[9];
    const float round_11 = rintf(0.15915494309189535f * gap_10);
    const float v9 = gap_10 - 6.28125f * round_11 - 0.001935307179586477f * round_11;
    const float gap_11 = q[10] - p[10];
    const float round_12 = rintf(0.15915494309189535f * gap_11);
    const float v10 = gap_11 - 6.28125f * round_12 - 0.001935307179586477f * round_12;
    const float gap_12 = q[11] - p[11];
    const float round_13 = rintf(0.15915494309189535f * gap_12);
    const float v11 = gap_12 - 6.28125f * round_13 - 0.001935307179586477f * round_13;
    const float gap_13 = q[12] - p[12];
    const float round_14 = rintf(0.15915494309189535f * gap_13);
    const float v12 = gap_13 - 6.28125f * round_14 - 0.001935307179586477f * round_14;
    const float gap_14 = q[13] - p[13];
    const float round_15 = rintf(0.15915494309189535f * gap_14);
    const float v13 = gap_14 - 6.28125f * round_15 - 0.001935307179586477f * round_15;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
    v_out[3] = v3;
    v_out[4] = v4;
    v_out[5] = v5;
    v_out[6] = v6;
    v_out[7] = v7;
    v_out[8] = v8;
    v_out[9] = v9;
    v_out[10] = v10;
    v_out[11] = v11;
    v_out[12] = v12;
    v_out[13] = v13;
}

void dual_arm_log_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT q,
    float *DUAL_ARM_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_log_f(p + 14 * i, q + 14 * i, v_out + 14 * i);
}

/* sqrt(distance(arm1)^2 + distance(arm2)^2) */
float dual_arm_distance_f(const float *DUAL_ARM_RESTRICT p, const float *DUAL_ARM_RESTRICT q) {
    const float gap = q[0] - p[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float arm1_log0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = q[1] - p[1];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float arm1_log1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float gap_3 = q[2] - p[2];
    const float round_4 = rintf(0.15915494309189535f * gap_3);
    const float arm1_log2 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float gap_4 = q[3] - p[3];
    const float round_5 = rintf(0.15915494309189535f * gap_4);
    const float arm1_log3 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float gap_5 = q[4] - p[4];
    const float round_6 = rintf(0.15915494309189535f * gap_5);
    const float arm1_log4 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float gap_6 = q[5] - p[5];
    const float round_7 = rintf(0.15915494309189535f * gap_6);
    const float arm1_log5 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float gap_7 = q[6] - p[6];
    const float round_8 = rintf(0.15915494309189535f * gap_7);
    const float arm1_log6 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    const float gap_8 = q[7] - p[7];
    const float round_9 = rintf(0.15915494309189535f * gap_8);
    const float arm2_log0 = gap_8 - 6.28125f * round_9 - 0.001935307179586477f * round_9;
    const float gap_9 = q[8] - p[8];
    const float round_10 = rintf(0.15915494309189535f * gap_9);
    const float arm2_log1 = gap_9 - 6.28125f * round_10 - 0.001935307179586477f * round_10;
    const float gap_10 = q[9] - p[9];
    const float round_11 = rintf(0.15915494309189535f * gap_10);
    const float arm2_log2 = gap_10 - 6.28125f * round_11 - 0.001935307179586477f * round_11;
    const float gap_11 = q[10] - p[10];
    const float round_12 = rintf(0.15915494309189535f * gap_11);
    const float arm2_log3 = gap_11 - 6.28125f * round_12 - 0.001935307179586477f * round_12;
    const float gap_12 = q[11] - p[11];
    const float round_13 = rintf(0.15915494309189535f * gap_12);
    const float arm2_log4 = gap_12 - 6.28125f * round_13 - 0.001935307179586477f * round_13;
    const float gap_13 = q[12] - p[12];
    const float round_14 = rintf(0.15915494309189535f * gap_13);
    const float arm2_log5 = gap_13 - 6.28125f * round_14 - 0.001935307179586477f * round_14;
    const float gap_14 = q[13] - p[13];
    const float round_15 = rintf(0.15915494309189535f * gap_14);
    const float arm2_log6 = gap_14 - 6.28125f * round_15 - 0.001935307179586477f * round_15;
    const float total_2 = arm1_log0 * arm1_log0 + arm1_log1 * arm1_log1 + arm1_log2 * arm1_log2 + arm1_log3 *
        arm1_log3 + arm1_log4 * arm1_log4;
    const float total_3 = total_2 + arm1_log5 * arm1_log5 + arm1_log6 * arm1_log6 + arm2_log0 * arm2_log0 +
        arm2_log1 * arm2_log1;
    const float total_4 = total_3 + arm2_log2 * arm2_log2 + arm2_log3 * arm2_log3 + arm2_log4 * arm2_log4 +
        arm2_log5 * arm2_log5;
    return sqrtf(total_4 + arm2_log6 * arm2_log6);
}

void dual_arm_distance_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT q,
    float *DUAL_ARM_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = dual_arm_distance_f(p + 14 * i, q + 14 * i);
}

/* log_abs_det(arm1) + log_abs_det(arm2) */
float dual_arm_log_abs_det_f(const float *DUAL_ARM_RESTRICT p, const float *DUAL_ARM_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0f;
}

void dual_arm_log_abs_det_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT q,
    float *DUAL_ARM_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = dual_arm_log_abs_det_f(p + 14 * i, q + 14 * i);
}

/* arm1: G(p)^-1 df, arm2: G(p)^-1 df */
void dual_arm_riemannian_gradient_f(
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT df,
    float *DUAL_ARM_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
    gradient_out[2] = df[2];
    gradient_out[3] = df[3];
    gradient_out[4] = df[4];
    gradient_out[5] = df[5];
    gradient_out[6] = df[6];
    gradient_out[7] = df[7];
    gradient_out[8] = df[8];
    gradient_out[9] = df[9];
    gradient_out[10] = df[10];
    gradient_out[11] = df[11];
    gradient_out[12] = df[12];
    gradient_out[13] = df[13];
}

void dual_arm_riemannian_gradient_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT df,
    float *DUAL_ARM_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_riemannian_gradient_f(p + 14 * i, df + 14 * i, gradient_out + 14 * i);
}

/* sqrt(gradient_norm(arm1)^2 + gradient_norm(arm2)^2) */
float dual_arm_gradient_norm_f(const float *DUAL_ARM_RESTRICT p, const float *DUAL_ARM_RESTRICT df) {
    (void)p;
    const float total_2 = df[0] * df[0] + df[1] * df[1] + df[10] * df[10] + df[11] * df[11] + df[12] * df[12];
    const float total_3 = total_2 + df[13] * df[13] + df[2] * df[2] + df[3] * df[3] + df[4] * df[4];
    const float total_4 = total_3 + df[5] * df[5] + df[6] * df[6] + df[7] * df[7] + df[8] * df[8];
    return sqrtf(total_4 + df[9] * df[9]);
}

void dual_arm_gradient_norm_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT df,
    float *DUAL_ARM_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = dual_arm_gradient_norm_f(p + 14 * i, df + 14 * i);
}

/* arm1: v, arm2: v */
void dual_arm_transport_f(
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT q,
    const float *DUAL_ARM_RESTRICT v,
    float *DUAL_ARM_RESTRICT w_out) {
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
    w_out[9] = v[9];
    w_out[10] = v[10];
    w_out[11] = v[11];
    w_out[12] = v[12];
    w_out[13] = v[13];
}

void dual_arm_transport_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT p,
    const float *DUAL_ARM_RESTRICT q,
    const float *DUAL_ARM_RESTRICT v,
    float *DUAL_ARM_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_transport_f(p + 14 * i, q + 14 * i, v + 14 * i, w_out + 14 * i);
}

/* arm1: wrap(2 * pi * uniform), arm2: wrap(2 * pi * uniform) */
void dual_arm_sample_f(
    const float *DUAL_ARM_RESTRICT normal,
    const float *DUAL_ARM_RESTRICT uniform,
    float *DUAL_ARM_RESTRICT p_out) {
    (void)normal;
    const float round_2 = rintf(uniform[0]);
    const float p0 = 6.283185307179586f * uniform[0] - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float round_3 = rintf(uniform[1]);
    const float p1 = 6.283185307179586f * uniform[1] - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float round_4 = rintf(uniform[2]);
    const float p2 = 6.283185307179586f * uniform[2] - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float round_5 = rintf(uniform[3]);
    const float p3 = 6.283185307179586f * uniform[3] - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float round_6 = rintf(uniform[4]);
    const float p4 = 6.283185307179586f * uniform[4] - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float round_7 = rintf(uniform[5]);
    const float p5 = 6.283185307179586f * uniform[5] - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float round_8 = rintf(uniform[6]);
    const float p6 = 6.283185307179586f * uniform[6] - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    const float round_9 = rintf(uniform[7]);
    const float p7 = 6.283185307179586f * uniform[7] - 6.28125f * round_9 - 0.001935307179586477f * round_9;
    const float round_10 = rintf(uniform[8]);
    const float p8 = 6.283185307179586f * uniform[8] - 6.28125f * round_10 - 0.001935307179586477f * round_10;
    const float round_11 = rintf(uniform[9]);
    const float p9 = 6.283185307179586f * uniform[9] - 6.28125f * round_11 - 0.001935307179586477f * round_11;
    const float round_12 = rintf(uniform[10]);
    const float p10 = 6.283185307179586f * uniform[10] - 6.28125f * round_12 - 0.001935307179586477f *
        round_12;
    const float round_13 = rintf(uniform[11]);
    const float p11 = 6.283185307179586f * uniform[11] - 6.28125f * round_13 - 0.001935307179586477f *
        round_13;
    const float round_14 = rintf(uniform[12]);
    const float p12 = 6.283185307179586f * uniform[12] - 6.28125f * round_14 - 0.001935307179586477f *
        round_14;
    const float round_15 = rintf(uniform[13]);
    const float p13 = 6.283185307179586f * uniform[13] - 6.28125f * round_15 - 0.001935307179586477f *
        round_15;
    p_out[0] = p0;
    p_out[1] = p1;
    p_out[2] = p2;
    p_out[3] = p3;
    p_out[4] = p4;
    p_out[5] = p5;
    p_out[6] = p6;
    p_out[7] = p7;
    p_out[8] = p8;
    p_out[9] = p9;
    p_out[10] = p10;
    p_out[11] = p11;
    p_out[12] = p12;
    p_out[13] = p13;
}

void dual_arm_sample_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT normal,
    const float *DUAL_ARM_RESTRICT uniform,
    float *DUAL_ARM_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_sample_f(normal + 14 * i, uniform + 14 * i, p_out + 14 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void dual_arm_splat_f(
    const float *DUAL_ARM_RESTRICT x,
    const float *DUAL_ARM_RESTRICT mu,
    const float *DUAL_ARM_RESTRICT W,
    float amplitude,
    float *DUAL_ARM_RESTRICT value_out,
    float *DUAL_ARM_RESTRICT gradient_out) {
    const float gap = x[0] - mu[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = x[1] - mu[1];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float gap_3 = x[2] - mu[2];
    const float round_4 = rintf(0.15915494309189535f * gap_3);
    const float v2 = gap_3 - 6.28125f * round_4 - 0.001935307179586477f * round_4;
    const float gap_4 = x[3] - mu[3];
    const float round_5 = rintf(0.15915494309189535f * gap_4);
    const float v3 = gap_4 - 6.28125f * round_5 - 0.001935307179586477f * round_5;
    const float gap_5 = x[4] - mu[4];
    const float round_6 = rintf(0.15915494309189535f * gap_5);
    const float v4 = gap_5 - 6.28125f * round_6 - 0.001935307179586477f * round_6;
    const float gap_6 = x[5] - mu[5];
    const float round_7 = rintf(0.15915494309189535f * gap_6);
    const float v5 = gap_6 - 6.28125f * round_7 - 0.001935307179586477f * round_7;
    const float gap_7 = x[6] - mu[6];
    const float round_8 = rintf(0.15915494309189535f * gap_7);
    const float v6 = gap_7 - 6.28125f * round_8 - 0.001935307179586477f * round_8;
    const float gap_8 = x[7] - mu[7];
    const float round_9 = rintf(0.15915494309189535f * gap_8);
    const float v7 = gap_8 - 6.28125f * round_9 - 0.001935307179586477f * round_9;
    const float gap_9 = x[8] - mu[8];
    const float round_10 = rintf(0.15915494309189535f * gap_9);
    const float v8 = gap_9 - 6.28125f * round_10 - 0.001935307179586477f * round_10;
    const float gap_10 = x[9] - mu[9];
    const float round_11 = rintf(0.15915494309189535f * gap_10);
    const float v9 = gap_10 - 6.28125f * round_11 - 0.001935307179586477f * round_11;
    const float gap_11 = x[10] - mu[10];
    const float round_12 = rintf(0.15915494309189535f * gap_11);
    const float v10 = gap_11 - 6.28125f * round_12 - 0.001935307179586477f * round_12;
    const float gap_12 = x[11] - mu[11];
    const float round_13 = rintf(0.15915494309189535f * gap_12);
    const float v11 = gap_12 - 6.28125f * round_13 - 0.001935307179586477f * round_13;
    const float gap_13 = x[12] - mu[12];
    const float round_14 = rintf(0.15915494309189535f * gap_13);
    const float v12 = gap_13 - 6.28125f * round_14 - 0.001935307179586477f * round_14;
    const float gap_14 = x[13] - mu[13];
    const float round_15 = rintf(0.15915494309189535f * gap_14);
    const float v13 = gap_14 - 6.28125f * round_15 - 0.001935307179586477f * round_15;
    const float total_2 = W[0] * v0 + W[1] * v1 + W[2] * v2 + W[3] * v3 + W[4] * v4;
    const float total_3 = total_2 + W[5] * v5 + W[6] * v6 + W[7] * v7 + W[8] * v8;
    const float total_4 = total_3 + W[9] * v9 + W[10] * v10 + W[11] * v11 + W[12] * v12;
    const float z0 = total_4 + W[13] * v13;
    const float total_5 = W[14] * v0 + W[15] * v1 + W[16] * v2 + W[17] * v3 + W[18] * v4;
    const float total_6 = total_5 + W[19] * v5 + W[20] * v6 + W[21] * v7 + W[22] * v8;
    const float total_7 = total_6 + W[23] * v9 + W[24] * v10 + W[25] * v11 + W[26] * v12;
    const float z1 = total_7 + W[27] * v13;
    const float total_8 = W[28] * v0 + W[29] * v1 + W[30] * v2 + W[31] * v3 + W[32] * v4;
    const float total_9 = total_8 + W[33] * v5 + W[34] * v6 + W[35] * v7 + W[36] * v8;
    const float total_10 = total_9 + W[37] * v9 + W[38] * v10 + W[39] * v11 + W[40] * v12;
    const float z2 = total_10 + W[41] * v13;
    const float total_11 = W[42] * v0 + W[43] * v1 + W[44] * v2 + W[45] * v3 + W[46] * v4;
    const float total_12 = total_11 + W[47] * v5 + W[48] * v6 + W[49] * v7 + W[50] * v8;
    const float total_13 = total_12 + W[51] * v9 + W[52] * v10 + W[53] * v11 + W[54] * v12;
    const float z3 = total_13 + W[55] * v13;
    const float total_14 = W[56] * v0 + W[57] * v1 + W[58] * v2 + W[59] * v3 + W[60] * v4;
    const float total_15 = total_14 + W[61] * v5 + W[62] * v6 + W[63] * v7 + W[64] * v8;
    const float total_16 = total_15 + W[65] * v9 + W[66] * v10 + W[67] * v11 + W[68] * v12;
    const float z4 = total_16 + W[69] * v13;
    const float total_17 = W[70] * v0 + W[71] * v1 + W[72] * v2 + W[73] * v3 + W[74] * v4;
    const float total_18 = total_17 + W[75] * v5 + W[76] * v6 + W[77] * v7 + W[78] * v8;
    const float total_19 = total_18 + W[79] * v9 + W[80] * v10 + W[81] * v11 + W[82] * v12;
    const float z5 = total_19 + W[83] * v13;
    const float total_20 = W[84] * v0 + W[85] * v1 + W[86] * v2 + W[87] * v3 + W[88] * v4;
    const float total_21 = total_20 + W[89] * v5 + W[90] * v6 + W[91] * v7 + W[92] * v8;
    const float total_22 = total_21 + W[93] * v9 + W[94] * v10 + W[95] * v11 + W[96] * v12;
    const float z6 = total_22 + W[97] * v13;
    const float total_23 = W[98] * v0 + W[99] * v1 + W[100] * v2 + W[101] * v3 + W[102] * v4;
    const float total_24 = total_23 + W[103] * v5 + W[104] * v6 + W[105] * v7 + W[106] * v8;
    const float total_25 = total_24 + W[107] * v9 + W[108] * v10 + W[109] * v11 + W[110] * v12;
    const float z7 = total_25 + W[111] * v13;
    const float total_26 = W[112] * v0 + W[113] * v1 + W[114] * v2 + W[115] * v3 + W[116] * v4;
    const float total_27 = total_26 + W[117] * v5 + W[118] * v6 + W[119] * v7 + W[120] * v8;
    const float total_28 = total_27 + W[121] * v9 + W[122] * v10 + W[123] * v11 + W[124] * v12;
    const float z8 = total_28 + W[125] * v13;
    const float total_29 = W[126] * v0 + W[127] * v1 + W[128] * v2 + W[129] * v3 + W[130] * v4;
    const float total_30 = total_29 + W[131] * v5 + W[132] * v6 + W[133] * v7 + W[134] * v8;
    const float total_31 = total_30 + W[135] * v9 + W[136] * v10 + W[137] * v11 + W[138] * v12;
    const float z9 = total_31 + W[139] * v13;
    const float total_32 = W[140] * v0 + W[141] * v1 + W[142] * v2 + W[143] * v3 + W[144] * v4;
    const float total_33 = total_32 + W[145] * v5 + W[146] * v6 + W[147] * v7 + W[148] * v8;
    const float total_34 = total_33 + W[149] * v9 + W[150] * v10 + W[151] * v11 + W[152] * v12;
    const float z10 = total_34 + W[153] * v13;
    const float total_35 = W[154] * v0 + W[155] * v1 + W[156] * v2 + W[157] * v3 + W[158] * v4;
    const float total_36 = total_35 + W[159] * v5 + W[160] * v6 + W[161] * v7 + W[162] * v8;
    const float total_37 = total_36 + W[163] * v9 + W[164] * v10 + W[165] * v11 + W[166] * v12;
    const float z11 = total_37 + W[167] * v13;
    const float total_38 = W[168] * v0 + W[169] * v1 + W[170] * v2 + W[171] * v3 + W[172] * v4;
    const float total_39 = total_38 + W[173] * v5 + W[174] * v6 + W[175] * v7 + W[176] * v8;
    const float total_40 = total_39 + W[177] * v9 + W[178] * v10 + W[179] * v11 + W[180] * v12;
    const float z12 = total_40 + W[181] * v13;
    const float total_41 = W[182] * v0 + W[183] * v1 + W[184] * v2 + W[185] * v3 + W[186] * v4;
    const float total_42 = total_41 + W[187] * v5 + W[188] * v6 + W[189] * v7 + W[190] * v8;
    const float total_43 = total_42 + W[191] * v9 + W[192] * v10 + W[193] * v11 + W[194] * v12;
    const float z13 = total_43 + W[195] * v13;
    const float total_44 = z0 * z0 + z1 * z1 + z2 * z2 + z3 * z3 + z4 * z4;
    const float total_45 = total_44 + z5 * z5 + z6 * z6 + z7 * z7 + z8 * z8;
    const float total_46 = total_45 + z9 * z9 + z10 * z10 + z11 * z11 + z12 * z12;
    const float exp_2 = expf(-(0.5f * (total_46 + z13 * z13)));
    const float phi = amplitude * exp_2;
    const float gap_15 = -(W[195] * z13) - W[181] * z12 - W[167] * z11 - W[153] * z10;
    const float gap_16 = -(W[194] * z13) - W[180] * z12 - W[166] * z11 - W[152] * z10;
    const float gap_17 = -(W[193] * z13) - W[179] * z12 - W[165] * z11 - W[151] * z10;
    const float gap_18 = -(W[192] * z13) - W[178] * z12 - W[164] * z11 - W[150] * z10;
    const float gap_19 = -(W[191] * z13) - W[177] * z12 - W[163] * z11 - W[149] * z10;
    const float gap_20 = -(W[190] * z13) - W[176] * z12 - W[162] * z11 - W[148] * z10;
    const float gap_21 = -(W[189] * z13) - W[175] * z12 - W[161] * z11 - W[147] * z10;
    const float gap_22 = -(W[188] * z13) - W[174] * z12 - W[160] * z11 - W[146] * z10;
    const float gap_23 = -(W[187] * z13) - W[173] * z12 - W[159] * z11 - W[145] * z10;
    const float gap_24 = -(W[186] * z13) - W[172] * z12 - W[158] * z11 - W[144] * z10;
    const float gap_25 = -(W[185] * z13) - W[171] * z12 - W[157] * z11 - W[143] * z10;
    const float gap_26 = -(W[184] * z13) - W[170] * z12 - W[156] * z11 - W[142] * z10;
    const float gap_27 = -(W[183] * z13) - W[169] * z12 - W[155] * z11 - W[141] * z10;
    const float gap_28 = -(W[182] * z13) - W[168] * z12 - W[154] * z11 - W[140] * z10;
    const float gap_29 = gap_15 - W[139] * z9 - W[125] * z8 - W[111] * z7 - W[97] * z6;
    const float gap_30 = gap_16 - W[138] * z9 - W[124] * z8 - W[110] * z7 - W[96] * z6;
    const float gap_31 = gap_17 - W[137] * z9 - W[123] * z8 - W[109] * z7 - W[95] * z6;
    const float gap_32 = gap_18 - W[136] * z9 - W[122] * z8 - W[108] * z7 - W[94] * z6;
    const float gap_33 = gap_19 - W[135] * z9 - W[121] * z8 - W[107] * z7 - W[93] * z6;
    const float gap_34 = gap_20 - W[134] * z9 - W[120] * z8 - W[106] * z7 - W[92] * z6;
    const float gap_35 = gap_21 - W[133] * z9 - W[119] * z8 - W[105] * z7 - W[91] * z6;
    const float gap_36 = gap_22 - W[132] * z9 - W[118] * z8 - W[104] * z7 - W[90] * z6;
    const float gap_37 = gap_23 - W[131] * z9 - W[117] * z8 - W[103] * z7 - W[89] * z6;
    const float gap_38 = gap_24 - W[130] * z9 - W[116] * z8 - W[102] * z7 - W[88] * z6;
    const float gap_39 = gap_25 - W[129] * z9 - W[115] * z8 - W[101] * z7 - W[87] * z6;
    const float gap_40 = gap_26 - W[128] * z9 - W[114] * z8 - W[100] * z7 - W[86] * z6;
    const float gap_41 = gap_27 - W[127] * z9 - W[113] * z8 - W[99] * z7 - W[85] * z6;
    const float gap_42 = gap_28 - W[126] * z9 - W[112] * z8 - W[98] * z7 - W[84] * z6;
    const float gap_43 = gap_29 - W[83] * z5 - W[69] * z4 - W[55] * z3 - W[41] * z2;
    const float gap_44 = gap_30 - W[82] * z5 - W[68] * z4 - W[54] * z3 - W[40] * z2;
    const float gap_45 = gap_31 - W[81] * z5 - W[67] * z4 - W[53] * z3 - W[39] * z2;
    const float gap_46 = gap_32 - W[80] * z5 - W[66] * z4 - W[52] * z3 - W[38] * z2;
    const float gap_47 = gap_33 - W[79] * z5 - W[65] * z4 - W[51] * z3 - W[37] * z2;
    const float gap_48 = gap_34 - W[78] * z5 - W[64] * z4 - W[50] * z3 - W[36] * z2;
    const float gap_49 = gap_35 - W[77] * z5 - W[63] * z4 - W[49] * z3 - W[35] * z2;
    const float gap_50 = gap_36 - W[76] * z5 - W[62] * z4 - W[48] * z3 - W[34] * z2;
    const float gap_51 = gap_37 - W[75] * z5 - W[61] * z4 - W[47] * z3 - W[33] * z2;
    const float gap_52 = gap_38 - W[74] * z5 - W[60] * z4 - W[46] * z3 - W[32] * z2;
    const float gap_53 = gap_39 - W[73] * z5 - W[59] * z4 - W[45] * z3 - W[31] * z2;
    const float gap_54 = gap_40 - W[72] * z5 - W[58] * z4 - W[44] * z3 - W[30] * z2;
    const float gap_55 = gap_41 - W[71] * z5 - W[57] * z4 - W[43] * z3 - W[29] * z2;
    const float gap_56 = gap_42 - W[70] * z5 - W[56] * z4 - W[42] * z3 - W[28] * z2;
    const float by_v13 = gap_43 - W[27] * z1 - W[13] * z0;
    const float by_v12 = gap_44 - W[26] * z1 - W[12] * z0;
    const float by_v11 = gap_45 - W[25] * z1 - W[11] * z0;
    const float by_v10 = gap_46 - W[24] * z1 - W[10] * z0;
    const float by_v9 = gap_47 - W[23] * z1 - W[9] * z0;
    const float by_v8 = gap_48 - W[22] * z1 - W[8] * z0;
    const float by_v7 = gap_49 - W[21] * z1 - W[7] * z0;
    const float by_v6 = gap_50 - W[20] * z1 - W[6] * z0;
    const float by_v5 = gap_51 - W[19] * z1 - W[5] * z0;
    const float by_v4 = gap_52 - W[18] * z1 - W[4] * z0;
    const float by_v3 = gap_53 - W[17] * z1 - W[3] * z0;
    const float by_v2 = gap_54 - W[16] * z1 - W[2] * z0;
    const float by_v1 = gap_55 - W[15] * z1 - W[1] * z0;
    const float by_v0 = gap_56 - W[14] * z1 - W[0] * z0;
    const float df0 = phi * by_v0;
    const float df1 = phi * by_v1;
    const float df2 = phi * by_v2;
    const float df3 = phi * by_v3;
    const float df4 = phi * by_v4;
    const float df5 = phi * by_v5;
    const float df6 = phi * by_v6;
    const float df7 = phi * by_v7;
    const float df8 = phi * by_v8;
    const float df9 = phi * by_v9;
    const float df10 = phi * by_v10;
    const float df11 = phi * by_v11;
    const float df12 = phi * by_v12;
    const float df13 = phi * by_v13;
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
    gradient_out[2] = df2;
    gradient_out[3] = df3;
    gradient_out[4] = df4;
    gradient_out[5] = df5;
    gradient_out[6] = df6;
    gradient_out[7] = df7;
    gradient_out[8] = df8;
    gradient_out[9] = df9;
    gradient_out[10] = df10;
    gradient_out[11] = df11;
    gradient_out[12] = df12;
    gradient_out[13] = df13;
}

void dual_arm_splat_batch_f(
    size_t count,
    const float *DUAL_ARM_RESTRICT x,
    const float *DUAL_ARM_RESTRICT mu,
    const float *DUAL_ARM_RESTRICT W,
    const float *DUAL_ARM_RESTRICT amplitude,
    float *DUAL_ARM_RESTRICT value_out,
    float *DUAL_ARM_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) dual_arm_splat_f(x + 14 * i, mu + 14 * i, W + 196 * i, amplitude[i], value_out + i, gradient_out + 14 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void dual_arm_frame_f(const float *DUAL_ARM_RESTRICT p, float *DUAL_ARM_RESTRICT frame) {
    float left[14][14];
    for (int i = 0; i < 14; ++i) {
        float axis[14];
        for (int j = 0; j < 14; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        dual_arm_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 14; ++row) {
        float *e = frame + 14 * row;
        int longest = 0;
        for (int i = 1; i < 14; ++i)
            if (dual_arm_norm_f(p, left[i]) > dual_arm_norm_f(p, left[longest])) longest = i;
        const float length = dual_arm_norm_f(p, left[longest]);
        for (int j = 0; j < 14; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 14; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 14];
            const float part = dual_arm_inner_f(p, e, rest);
            for (int j = 0; j < 14; ++j) rest[j] -= part * e[j];
        }
    }
}
