/*
 * arm2: A two-link arm under its kinetic energy: |v|^2 / 2 is the energy of the joint velocities v. Exp and Log
 *
 * See the header for what the functions promise.
 */

#include "arm2.h"

#include <float.h>

/* x, periodic coordinates wrapped */
void arm2_project(const double *ARM2_RESTRICT x, double *ARM2_RESTRICT p_out) {
    const double round_2 = rint(0.15915494309189535 * x[0]);
    const double p0 = x[0] - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double round_3 = rint(0.15915494309189535 * x[1]);
    const double p1 = x[1] - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    p_out[0] = p0;
    p_out[1] = p1;
}

void arm2_project_batch(size_t count, const double *ARM2_RESTRICT x, double *ARM2_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) arm2_project(x + 2 * i, p_out + 2 * i);
}

/* x */
void arm2_to_tangent(
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT x,
    double *ARM2_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
}

void arm2_to_tangent_batch(
    size_t count,
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT x,
    double *ARM2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) arm2_to_tangent(p + 2 * i, x + 2 * i, v_out + 2 * i);
}

/* u^T G(p) v */
double arm2_inner(const double *ARM2_RESTRICT p, const double *ARM2_RESTRICT u, const double *ARM2_RESTRICT v) {
    const double cos_2 = cos(p[1]);
    const double total_2 = 0.3333333333333333 + 0.5 * cos_2;
    const double total_3 = v[0] * (u[0] * (1.6666666666666667 + cos_2) + u[1] * total_2) + v[1] *
        (0.3333333333333333 * u[1] + u[0] * total_2);
    return total_3;
}

void arm2_inner_batch(
    size_t count,
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT u,
    const double *ARM2_RESTRICT v,
    double *ARM2_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = arm2_inner(p + 2 * i, u + 2 * i, v + 2 * i);
}

/* sqrt(<v, v>_p) */
double arm2_norm(const double *ARM2_RESTRICT p, const double *ARM2_RESTRICT v) {
    const double cos_2 = cos(p[1]);
    const double total_2 = 0.3333333333333333 + 0.5 * cos_2;
    const double total_3 = v[0] * (v[0] * (1.6666666666666667 + cos_2) + v[1] * total_2) + v[1] *
        (0.3333333333333333 * v[1] + v[0] * total_2);
    return sqrt(total_3);
}

void arm2_norm_batch(
    size_t count,
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT v,
    double *ARM2_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = arm2_norm(p + 2 * i, v + 2 * i);
}

/* G(p) v */
void arm2_flat(
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT v,
    double *ARM2_RESTRICT covector_out) {
    const double cos_2 = cos(p[1]);
    const double total_2 = 0.3333333333333333 + 0.5 * cos_2;
    const double covector0 = v[0] * (1.6666666666666667 + cos_2) + v[1] * total_2;
    const double covector1 = 0.3333333333333333 * v[1] + v[0] * total_2;
    covector_out[0] = covector0;
    covector_out[1] = covector1;
}

void arm2_flat_batch(
    size_t count,
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT v,
    double *ARM2_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) arm2_flat(p + 2 * i, v + 2 * i, covector_out + 2 * i);
}

/* wrap(p + v) */
void arm2_exp(const double *ARM2_RESTRICT p, const double *ARM2_RESTRICT v, double *ARM2_RESTRICT q_out) {
    const double total_2 = p[0] + v[0];
    const double round_2 = rint(0.15915494309189535 * total_2);
    const double q0 = total_2 - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double total_3 = p[1] + v[1];
    const double round_3 = rint(0.15915494309189535 * total_3);
    const double q1 = total_3 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    q_out[0] = q0;
    q_out[1] = q1;
}

void arm2_exp_batch(
    size_t count,
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT v,
    double *ARM2_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) arm2_exp(p + 2 * i, v + 2 * i, q_out + 2 * i);
}

/* wrap(q - p) */
void arm2_log(const double *ARM2_RESTRICT p, const double *ARM2_RESTRICT q, double *ARM2_RESTRICT v_out) {
    const double gap = q[0] - p[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = q[1] - p[1];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    v_out[0] = v0;
    v_out[1] = v1;
}

void arm2_log_batch(
    size_t count,
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT q,
    double *ARM2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) arm2_log(p + 2 * i, q + 2 * i, v_out + 2 * i);
}

/* |Log_p(q)|_p */
double arm2_distance(const double *ARM2_RESTRICT p, const double *ARM2_RESTRICT q) {
    const double gap = q[0] - p[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double log0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = q[1] - p[1];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double log1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double cos_2 = cos(p[1]);
    const double total_2 = 0.3333333333333333 + 0.5 * cos_2;
    const double total_3 = log0 * (log0 * (1.6666666666666667 + cos_2) + log1 * total_2) + log1 *
        (0.3333333333333333 * log1 + log0 * total_2);
    return sqrt(total_3);
}

void arm2_distance_batch(
    size_t count,
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT q,
    double *ARM2_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = arm2_distance(p + 2 * i, q + 2 * i);
}

/* atanh(difference / total) */
double arm2_log_abs_det(const double *ARM2_RESTRICT p, const double *ARM2_RESTRICT q) {
    const double sin_p1_minus_q1 = sin(p[1] - q[1]);
    const double sin_p1_plus_q1 = sin(p[1] + q[1]);
    const double difference = sin_p1_plus_q1 * (0.25 * sin_p1_minus_q1);
    const double cos_p1 = cos(p[1]);
    const double cos_q1 = cos(q[1]);
    const double total_2 = 0.8888888888888888 - 0.25 * (cos_p1 * cos_p1) - 0.25 * (cos_q1 * cos_q1);
    const double atanh_value = atanh(difference / total_2);
    return atanh_value;
}

void arm2_log_abs_det_batch(
    size_t count,
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT q,
    double *ARM2_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = arm2_log_abs_det(p + 2 * i, q + 2 * i);
}

/* G(p)^-1 df */
void arm2_riemannian_gradient(
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT df,
    double *ARM2_RESTRICT gradient_out) {
    const double cos_2 = cos(p[1]);
    const double gap = 9.0 * (cos_2 * cos_2) - 16.0;
    const double total_2 = 12.0 + 18.0 * cos_2;
    const double gradient0 = df[1] * total_2 / gap - 12.0 * df[0] / gap;
    const double gradient1 = df[0] * total_2 / gap + df[1] * (-60.0 - 36.0 * cos_2) / gap;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void arm2_riemannian_gradient_batch(
    size_t count,
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT df,
    double *ARM2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) arm2_riemannian_gradient(p + 2 * i, df + 2 * i, gradient_out + 2 * i);
}

/* |grad f|_p */
double arm2_gradient_norm(const double *ARM2_RESTRICT p, const double *ARM2_RESTRICT df) {
    const double cos_2 = cos(p[1]);
    const double gap = 9.0 * (cos_2 * cos_2) - 16.0;
    const double total_2 = 12.0 + 18.0 * cos_2;
    const double gradient0 = df[1] * total_2 / gap - 12.0 * df[0] / gap;
    const double gradient1 = df[0] * total_2 / gap + df[1] * (-60.0 - 36.0 * cos_2) / gap;
    const double total_3 = 0.3333333333333333 + 0.5 * cos_2;
    const double total_4 = gradient0 * (gradient0 * (1.6666666666666667 + cos_2) + gradient1 * total_3) +
        gradient1 * (0.3333333333333333 * gradient1 + gradient0 * total_3);
    return sqrt(total_4);
}

void arm2_gradient_norm_batch(
    size_t count,
    const double *ARM2_RESTRICT p,
    const double *ARM2_RESTRICT df,
    double *ARM2_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = arm2_gradient_norm(p + 2 * i, df + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void arm2_splat(
    const double *ARM2_RESTRICT x,
    const double *ARM2_RESTRICT mu,
    const double *ARM2_RESTRICT W,
    double amplitude,
    double *ARM2_RESTRICT value_out,
    double *ARM2_RESTRICT gradient_out) {
    const double gap = x[0] - mu[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = x[1] - mu[1];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double gap_3 = mu[1] - x[1];
    const double sin_p1_minus_q1 = sin(gap_3);
    const double total_2 = x[1] + mu[1];
    const double sin_p1_plus_q1 = sin(total_2);
    const double product = 0.25 * sin_p1_minus_q1;
    const double difference = sin_p1_plus_q1 * product;
    const double cos_p1 = cos(mu[1]);
    const double cos_q1 = cos(x[1]);
    const double cos_q1_squared = cos_q1 * cos_q1;
    const double total_3 = 0.8888888888888888 - 0.25 * (cos_p1 * cos_p1) - 0.25 * cos_q1_squared;
    const double difference_ratio = difference / total_3;
    const double atanh_value = atanh(difference_ratio);
    const double z0 = W[0] * v0 + W[1] * v1;
    const double z1 = W[2] * v0 + W[3] * v1;
    const double exp_2 = exp(atanh_value - 0.5 * (z0 * z0 + z1 * z1));
    const double phi = amplitude * exp_2;
    const double by_v1 = -(W[3] * z1) - W[1] * z0;
    const double by_v0 = -(W[2] * z1) - W[0] * z0;
    const double by_difference = 1.0 / (1.0 - difference_ratio * difference_ratio) / total_3;
    const double by_cos_q1 = cos_q1 * (0.5 * (difference_ratio * by_difference));
    const double by_sin_p1_plus_q1 = product * by_difference;
    const double by_sin_p1_minus_q1 = 0.25 * (sin_p1_plus_q1 * by_difference);
    const double exponent_by_x1 = by_v1 + (by_sin_p1_plus_q1 * cos(total_2) - by_cos_q1 * sin(x[1]) -
        by_sin_p1_minus_q1 * cos(gap_3));
    const double df0 = phi * by_v0;
    const double df1 = phi * exponent_by_x1;
    const double gap_4 = 9.0 * cos_q1_squared - 16.0;
    const double total_4 = 12.0 + 18.0 * cos_q1;
    const double gradient0 = df1 * total_4 / gap_4 - 12.0 * df0 / gap_4;
    const double gradient1 = df0 * total_4 / gap_4 + df1 * (-60.0 - 36.0 * cos_q1) / gap_4;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void arm2_splat_batch(
    size_t count,
    const double *ARM2_RESTRICT x,
    const double *ARM2_RESTRICT mu,
    const double *ARM2_RESTRICT W,
    const double *ARM2_RESTRICT amplitude,
    double *ARM2_RESTRICT value_out,
    double *ARM2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) arm2_splat(x + 2 * i, mu + 2 * i, W + 4 * i, amplitude[i], value_out + i, gradient_out + 2 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void arm2_frame(const double *ARM2_RESTRICT p, double *ARM2_RESTRICT frame) {
    double left[2][2];
    for (int i = 0; i < 2; ++i) {
        double axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0 : 0.0;
        arm2_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        double *e = frame + 2 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (arm2_norm(p, left[i]) > arm2_norm(p, left[longest])) longest = i;
        const double length = arm2_norm(p, left[longest]);
        for (int j = 0; j < 2; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 2];
            const double part = arm2_inner(p, e, rest);
            for (int j = 0; j < 2; ++j) rest[j] -= part * e[j];
        }
    }
}

/* x, periodic coordinates wrapped */
void arm2_project_f(const float *ARM2_RESTRICT x, float *ARM2_RESTRICT p_out) {
    const float round_2 = rintf(0.15915494309189535f * x[0]);
    const float p0 = x[0] - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float round_3 = rintf(0.15915494309189535f * x[1]);
    const float p1 = x[1] - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    p_out[0] = p0;
    p_out[1] = p1;
}

void arm2_project_batch_f(size_t count, const float *ARM2_RESTRICT x, float *ARM2_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) arm2_project_f(x + 2 * i, p_out + 2 * i);
}

/* x */
void arm2_to_tangent_f(const float *ARM2_RESTRICT p, const float *ARM2_RESTRICT x, float *ARM2_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
}

void arm2_to_tangent_batch_f(
    size_t count,
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT x,
    float *ARM2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) arm2_to_tangent_f(p + 2 * i, x + 2 * i, v_out + 2 * i);
}

/* u^T G(p) v */
float arm2_inner_f(const float *ARM2_RESTRICT p, const float *ARM2_RESTRICT u, const float *ARM2_RESTRICT v) {
    const float cos_2 = cosf(p[1]);
    const float total_2 = 0.3333333333333333f + 0.5f * cos_2;
    const float total_3 = v[0] * (u[0] * (1.6666666666666667f + cos_2) + u[1] * total_2) + v[1] *
        (0.3333333333333333f * u[1] + u[0] * total_2);
    return total_3;
}

void arm2_inner_batch_f(
    size_t count,
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT u,
    const float *ARM2_RESTRICT v,
    float *ARM2_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = arm2_inner_f(p + 2 * i, u + 2 * i, v + 2 * i);
}

/* sqrt(<v, v>_p) */
float arm2_norm_f(const float *ARM2_RESTRICT p, const float *ARM2_RESTRICT v) {
    const float cos_2 = cosf(p[1]);
    const float total_2 = 0.3333333333333333f + 0.5f * cos_2;
    const float total_3 = v[0] * (v[0] * (1.6666666666666667f + cos_2) + v[1] * total_2) + v[1] *
        (0.3333333333333333f * v[1] + v[0] * total_2);
    return sqrtf(total_3);
}

void arm2_norm_batch_f(
    size_t count,
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT v,
    float *ARM2_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = arm2_norm_f(p + 2 * i, v + 2 * i);
}

/* G(p) v */
void arm2_flat_f(
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT v,
    float *ARM2_RESTRICT covector_out) {
    const float cos_2 = cosf(p[1]);
    const float total_2 = 0.3333333333333333f + 0.5f * cos_2;
    const float covector0 = v[0] * (1.6666666666666667f + cos_2) + v[1] * total_2;
    const float covector1 = 0.3333333333333333f * v[1] + v[0] * total_2;
    covector_out[0] = covector0;
    covector_out[1] = covector1;
}

void arm2_flat_batch_f(
    size_t count,
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT v,
    float *ARM2_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) arm2_flat_f(p + 2 * i, v + 2 * i, covector_out + 2 * i);
}

/* wrap(p + v) */
void arm2_exp_f(const float *ARM2_RESTRICT p, const float *ARM2_RESTRICT v, float *ARM2_RESTRICT q_out) {
    const float total_2 = p[0] + v[0];
    const float round_2 = rintf(0.15915494309189535f * total_2);
    const float q0 = total_2 - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float total_3 = p[1] + v[1];
    const float round_3 = rintf(0.15915494309189535f * total_3);
    const float q1 = total_3 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    q_out[0] = q0;
    q_out[1] = q1;
}

void arm2_exp_batch_f(
    size_t count,
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT v,
    float *ARM2_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) arm2_exp_f(p + 2 * i, v + 2 * i, q_out + 2 * i);
}

/* wrap(q - p) */
void arm2_log_f(const float *ARM2_RESTRICT p, const float *ARM2_RESTRICT q, float *ARM2_RESTRICT v_out) {
    const float gap = q[0] - p[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = q[1] - p[1];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    v_out[0] = v0;
    v_out[1] = v1;
}

void arm2_log_batch_f(
    size_t count,
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT q,
    float *ARM2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) arm2_log_f(p + 2 * i, q + 2 * i, v_out + 2 * i);
}

/* |Log_p(q)|_p */
float arm2_distance_f(const float *ARM2_RESTRICT p, const float *ARM2_RESTRICT q) {
    const float gap = q[0] - p[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float log0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = q[1] - p[1];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float log1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float cos_2 = cosf(p[1]);
    const float total_2 = 0.3333333333333333f + 0.5f * cos_2;
    const float total_3 = log0 * (log0 * (1.6666666666666667f + cos_2) + log1 * total_2) + log1 *
        (0.3333333333333333f * log1 + log0 * total_2);
    return sqrtf(total_3);
}

void arm2_distance_batch_f(
    size_t count,
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT q,
    float *ARM2_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = arm2_distance_f(p + 2 * i, q + 2 * i);
}

/* atanh(difference / total) */
float arm2_log_abs_det_f(const float *ARM2_RESTRICT p, const float *ARM2_RESTRICT q) {
    const float sin_p1_minus_q1 = sinf(p[1] - q[1]);
    const float sin_p1_plus_q1 = sinf(p[1] + q[1]);
    const float difference = sin_p1_plus_q1 * (0.25f * sin_p1_minus_q1);
    const float cos_p1 = cosf(p[1]);
    const float cos_q1 = cosf(q[1]);
    const float total_2 = 0.8888888888888888f - 0.25f * (cos_p1 * cos_p1) - 0.25f * (cos_q1 * cos_q1);
    const float atanh_value = atanhf(difference / total_2);
    return atanh_value;
}

void arm2_log_abs_det_batch_f(
    size_t count,
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT q,
    float *ARM2_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = arm2_log_abs_det_f(p + 2 * i, q + 2 * i);
}

/* G(p)^-1 df */
void arm2_riemannian_gradient_f(
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT df,
    float *ARM2_RESTRICT gradient_out) {
    const float cos_2 = cosf(p[1]);
    const float gap = 9.0f * (cos_2 * cos_2) - 16.0f;
    const float total_2 = 12.0f + 18.0f * cos_2;
    const float gradient0 = df[1] * total_2 / gap - 12.0f * df[0] / gap;
    const float gradient1 = df[0] * total_2 / gap + df[1] * (-60.0f - 36.0f * cos_2) / gap;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void arm2_riemannian_gradient_batch_f(
    size_t count,
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT df,
    float *ARM2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) arm2_riemannian_gradient_f(p + 2 * i, df + 2 * i, gradient_out + 2 * i);
}

/* |grad f|_p */
float arm2_gradient_norm_f(const float *ARM2_RESTRICT p, const float *ARM2_RESTRICT df) {
    const float cos_2 = cosf(p[1]);
    const float gap = 9.0f * (cos_2 * cos_2) - 16.0f;
    const float total_2 = 12.0f + 18.0f * cos_2;
    const float gradient0 = df[1] * total_2 / gap - 12.0f * df[0] / gap;
    const float gradient1 = df[0] * total_2 / gap + df[1] * (-60.0f - 36.0f * cos_2) / gap;
    const float total_3 = 0.3333333333333333f + 0.5f * cos_2;
    const float total_4 = gradient0 * (gradient0 * (1.6666666666666667f + cos_2) + gradient1 * total_3) +
        gradient1 * (0.3333333333333333f * gradient1 + gradient0 * total_3);
    return sqrtf(total_4);
}

void arm2_gradient_norm_batch_f(
    size_t count,
    const float *ARM2_RESTRICT p,
    const float *ARM2_RESTRICT df,
    float *ARM2_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = arm2_gradient_norm_f(p + 2 * i, df + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void arm2_splat_f(
    const float *ARM2_RESTRICT x,
    const float *ARM2_RESTRICT mu,
    const float *ARM2_RESTRICT W,
    float amplitude,
    float *ARM2_RESTRICT value_out,
    float *ARM2_RESTRICT gradient_out) {
    const float gap = x[0] - mu[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = x[1] - mu[1];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float gap_3 = mu[1] - x[1];
    const float sin_p1_minus_q1 = sinf(gap_3);
    const float total_2 = x[1] + mu[1];
    const float sin_p1_plus_q1 = sinf(total_2);
    const float product = 0.25f * sin_p1_minus_q1;
    const float difference = sin_p1_plus_q1 * product;
    const float cos_p1 = cosf(mu[1]);
    const float cos_q1 = cosf(x[1]);
    const float cos_q1_squared = cos_q1 * cos_q1;
    const float total_3 = 0.8888888888888888f - 0.25f * (cos_p1 * cos_p1) - 0.25f * cos_q1_squared;
    const float difference_ratio = difference / total_3;
    const float atanh_value = atanhf(difference_ratio);
    const float z0 = W[0] * v0 + W[1] * v1;
    const float z1 = W[2] * v0 + W[3] * v1;
    const float exp_2 = expf(atanh_value - 0.5f * (z0 * z0 + z1 * z1));
    const float phi = amplitude * exp_2;
    const float by_v1 = -(W[3] * z1) - W[1] * z0;
    const float by_v0 = -(W[2] * z1) - W[0] * z0;
    const float by_difference = 1.0f / (1.0f - difference_ratio * difference_ratio) / total_3;
    const float by_cos_q1 = cos_q1 * (0.5f * (difference_ratio * by_difference));
    const float by_sin_p1_plus_q1 = product * by_difference;
    const float by_sin_p1_minus_q1 = 0.25f * (sin_p1_plus_q1 * by_difference);
    const float exponent_by_x1 = by_v1 + (by_sin_p1_plus_q1 * cosf(total_2) - by_cos_q1 * sinf(x[1]) -
        by_sin_p1_minus_q1 * cosf(gap_3));
    const float df0 = phi * by_v0;
    const float df1 = phi * exponent_by_x1;
    const float gap_4 = 9.0f * cos_q1_squared - 16.0f;
    const float total_4 = 12.0f + 18.0f * cos_q1;
    const float gradient0 = df1 * total_4 / gap_4 - 12.0f * df0 / gap_4;
    const float gradient1 = df0 * total_4 / gap_4 + df1 * (-60.0f - 36.0f * cos_q1) / gap_4;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
    gradient_out[1] = gradient1;
}

void arm2_splat_batch_f(
    size_t count,
    const float *ARM2_RESTRICT x,
    const float *ARM2_RESTRICT mu,
    const float *ARM2_RESTRICT W,
    const float *ARM2_RESTRICT amplitude,
    float *ARM2_RESTRICT value_out,
    float *ARM2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) arm2_splat_f(x + 2 * i, mu + 2 * i, W + 4 * i, amplitude[i], value_out + i, gradient_out + 2 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void arm2_frame_f(const float *ARM2_RESTRICT p, float *ARM2_RESTRICT frame) {
    float left[2][2];
    for (int i = 0; i < 2; ++i) {
        float axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        arm2_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        float *e = frame + 2 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (arm2_norm_f(p, left[i]) > arm2_norm_f(p, left[longest])) longest = i;
        const float length = arm2_norm_f(p, left[longest]);
        for (int j = 0; j < 2; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 2];
            const float part = arm2_inner_f(p, e, rest);
            for (int j = 0; j < 2; ++j) rest[j] -= part * e[j];
        }
    }
}
