/*
 * se2: Poses in the plane, R^2 x SO(2); a turn by one radian is as long as `radius`, in the unit of the
 *
 * See the header for what the functions promise.
 */

#include "se2.h"

#include <float.h>

/* position: x, heading: x, periodic coordinates wrapped */
void se2_project(const double *SE2_RESTRICT x, double *SE2_RESTRICT p_out) {
    const double round_2 = rint(0.15915494309189535 * x[2]);
    const double p2 = x[2] - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    p_out[0] = x[0];
    p_out[1] = x[1];
    p_out[2] = p2;
}

void se2_project_batch(size_t count, const double *SE2_RESTRICT x, double *SE2_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) se2_project(x + 3 * i, p_out + 3 * i);
}

/* position: x, heading: x */
void se2_to_tangent(const double *SE2_RESTRICT p, const double *SE2_RESTRICT x, double *SE2_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
    v_out[2] = x[2];
}

void se2_to_tangent_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT x,
    double *SE2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) se2_to_tangent(p + 3 * i, x + 3 * i, v_out + 3 * i);
}

/* inner(position) + inner(heading) */
double se2_inner(const double *SE2_RESTRICT p, const double *SE2_RESTRICT u, const double *SE2_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void se2_inner_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT u,
    const double *SE2_RESTRICT v,
    double *SE2_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = se2_inner(p + 3 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(norm(position)^2 + norm(heading)^2) */
double se2_norm(const double *SE2_RESTRICT p, const double *SE2_RESTRICT v) {
    (void)p;
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void se2_norm_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT v,
    double *SE2_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = se2_norm(p + 3 * i, v + 3 * i);
}

/* position: G(p) v, heading: G(p) v */
void se2_flat(const double *SE2_RESTRICT p, const double *SE2_RESTRICT v, double *SE2_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void se2_flat_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT v,
    double *SE2_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) se2_flat(p + 3 * i, v + 3 * i, covector_out + 3 * i);
}

/* position: p + v, heading: wrap(p + v) */
void se2_exp(const double *SE2_RESTRICT p, const double *SE2_RESTRICT v, double *SE2_RESTRICT q_out) {
    const double q0 = p[0] + v[0];
    const double q1 = p[1] + v[1];
    const double total_2 = p[2] + v[2];
    const double round_2 = rint(0.15915494309189535 * total_2);
    const double q2 = total_2 - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
}

void se2_exp_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT v,
    double *SE2_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) se2_exp(p + 3 * i, v + 3 * i, q_out + 3 * i);
}

/* position: q - p, heading: wrap(q - p) */
void se2_log(const double *SE2_RESTRICT p, const double *SE2_RESTRICT q, double *SE2_RESTRICT v_out) {
    const double v0 = q[0] - p[0];
    const double v1 = q[1] - p[1];
    const double gap = q[2] - p[2];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v2 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void se2_log_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT q,
    double *SE2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) se2_log(p + 3 * i, q + 3 * i, v_out + 3 * i);
}

/* sqrt(distance(position)^2 + distance(heading)^2) */
double se2_distance(const double *SE2_RESTRICT p, const double *SE2_RESTRICT q) {
    const double position_log0 = q[0] - p[0];
    const double position_log1 = q[1] - p[1];
    const double gap = q[2] - p[2];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double heading_log0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    return sqrt(heading_log0 * heading_log0 + position_log0 * position_log0 + position_log1 * position_log1);
}

void se2_distance_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT q,
    double *SE2_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = se2_distance(p + 3 * i, q + 3 * i);
}

/* log_abs_det(position) + log_abs_det(heading) */
double se2_log_abs_det(const double *SE2_RESTRICT p, const double *SE2_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0;
}

void se2_log_abs_det_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT q,
    double *SE2_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = se2_log_abs_det(p + 3 * i, q + 3 * i);
}

/* position: G(p)^-1 df, heading: G(p)^-1 df */
void se2_riemannian_gradient(
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT df,
    double *SE2_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
    gradient_out[2] = df[2];
}

void se2_riemannian_gradient_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT df,
    double *SE2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) se2_riemannian_gradient(p + 3 * i, df + 3 * i, gradient_out + 3 * i);
}

/* sqrt(gradient_norm(position)^2 + gradient_norm(heading)^2) */
double se2_gradient_norm(const double *SE2_RESTRICT p, const double *SE2_RESTRICT df) {
    (void)p;
    return sqrt(df[0] * df[0] + df[1] * df[1] + df[2] * df[2]);
}

void se2_gradient_norm_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT df,
    double *SE2_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = se2_gradient_norm(p + 3 * i, df + 3 * i);
}

/* position: v, heading: v */
void se2_transport(
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT q,
    const double *SE2_RESTRICT v,
    double *SE2_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
    w_out[1] = v[1];
    w_out[2] = v[2];
}

void se2_transport_batch(
    size_t count,
    const double *SE2_RESTRICT p,
    const double *SE2_RESTRICT q,
    const double *SE2_RESTRICT v,
    double *SE2_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) se2_transport(p + 3 * i, q + 3 * i, v + 3 * i, w_out + 3 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void se2_splat(
    const double *SE2_RESTRICT x,
    const double *SE2_RESTRICT mu,
    const double *SE2_RESTRICT W,
    double amplitude,
    double *SE2_RESTRICT value_out,
    double *SE2_RESTRICT gradient_out) {
    const double v0 = x[0] - mu[0];
    const double v1 = x[1] - mu[1];
    const double gap = x[2] - mu[2];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v2 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double z0 = W[0] * v0 + W[1] * v1 + W[2] * v2;
    const double z1 = W[3] * v0 + W[4] * v1 + W[5] * v2;
    const double z2 = W[6] * v0 + W[7] * v1 + W[8] * v2;
    const double minus = -(0.5 * (z0 * z0 + z1 * z1 + z2 * z2));
    const double phi = amplitude * exp(minus);
    const double by_v2 = -(W[8] * z2) - W[5] * z1 - W[2] * z0;
    const double by_v1 = -(W[7] * z2) - W[4] * z1 - W[1] * z0;
    const double by_v0 = -(W[6] * z2) - W[3] * z1 - W[0] * z0;
    const double df0 = phi * by_v0;
    const double df1 = phi * by_v1;
    const double df2 = phi * by_v2;
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
    gradient_out[2] = df2;
}

void se2_splat_batch(
    size_t count,
    const double *SE2_RESTRICT x,
    const double *SE2_RESTRICT mu,
    const double *SE2_RESTRICT W,
    const double *SE2_RESTRICT amplitude,
    double *SE2_RESTRICT value_out,
    double *SE2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) se2_splat(x + 3 * i, mu + 3 * i, W + 9 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void se2_frame(const double *SE2_RESTRICT p, double *SE2_RESTRICT frame) {
    double left[3][3];
    for (int i = 0; i < 3; ++i) {
        double axis[3];
        for (int j = 0; j < 3; ++j) axis[j] = i == j ? 1.0 : 0.0;
        se2_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 3; ++row) {
        double *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 3; ++i)
            if (se2_norm(p, left[i]) > se2_norm(p, left[longest])) longest = i;
        const double length = se2_norm(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 3; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 3];
            const double part = se2_inner(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}

/* position: x, heading: x, periodic coordinates wrapped */
void se2_project_f(const float *SE2_RESTRICT x, float *SE2_RESTRICT p_out) {
    const float round_2 = rintf(0.15915494309189535f * x[2]);
    const float p2 = x[2] - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    p_out[0] = x[0];
    p_out[1] = x[1];
    p_out[2] = p2;
}

void se2_project_batch_f(size_t count, const float *SE2_RESTRICT x, float *SE2_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) se2_project_f(x + 3 * i, p_out + 3 * i);
}

/* position: x, heading: x */
void se2_to_tangent_f(const float *SE2_RESTRICT p, const float *SE2_RESTRICT x, float *SE2_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
    v_out[2] = x[2];
}

void se2_to_tangent_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT x,
    float *SE2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) se2_to_tangent_f(p + 3 * i, x + 3 * i, v_out + 3 * i);
}

/* inner(position) + inner(heading) */
float se2_inner_f(const float *SE2_RESTRICT p, const float *SE2_RESTRICT u, const float *SE2_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void se2_inner_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT u,
    const float *SE2_RESTRICT v,
    float *SE2_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = se2_inner_f(p + 3 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(norm(position)^2 + norm(heading)^2) */
float se2_norm_f(const float *SE2_RESTRICT p, const float *SE2_RESTRICT v) {
    (void)p;
    return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void se2_norm_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT v,
    float *SE2_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = se2_norm_f(p + 3 * i, v + 3 * i);
}

/* position: G(p) v, heading: G(p) v */
void se2_flat_f(const float *SE2_RESTRICT p, const float *SE2_RESTRICT v, float *SE2_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void se2_flat_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT v,
    float *SE2_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) se2_flat_f(p + 3 * i, v + 3 * i, covector_out + 3 * i);
}

/* position: p + v, heading: wrap(p + v) */
void se2_exp_f(const float *SE2_RESTRICT p, const float *SE2_RESTRICT v, float *SE2_RESTRICT q_out) {
    const float q0 = p[0] + v[0];
    const float q1 = p[1] + v[1];
    const float total_2 = p[2] + v[2];
    const float round_2 = rintf(0.15915494309189535f * total_2);
    const float q2 = total_2 - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
}

void se2_exp_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT v,
    float *SE2_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) se2_exp_f(p + 3 * i, v + 3 * i, q_out + 3 * i);
}

/* position: q - p, heading: wrap(q - p) */
void se2_log_f(const float *SE2_RESTRICT p, const float *SE2_RESTRICT q, float *SE2_RESTRICT v_out) {
    const float v0 = q[0] - p[0];
    const float v1 = q[1] - p[1];
    const float gap = q[2] - p[2];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v2 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void se2_log_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT q,
    float *SE2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) se2_log_f(p + 3 * i, q + 3 * i, v_out + 3 * i);
}

/* sqrt(distance(position)^2 + distance(heading)^2) */
float se2_distance_f(const float *SE2_RESTRICT p, const float *SE2_RESTRICT q) {
    const float position_log0 = q[0] - p[0];
    const float position_log1 = q[1] - p[1];
    const float gap = q[2] - p[2];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float heading_log0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    return sqrtf(heading_log0 * heading_log0 + position_log0 * position_log0 + position_log1 * position_log1);
}

void se2_distance_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT q,
    float *SE2_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = se2_distance_f(p + 3 * i, q + 3 * i);
}

/* log_abs_det(position) + log_abs_det(heading) */
float se2_log_abs_det_f(const float *SE2_RESTRICT p, const float *SE2_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0f;
}

void se2_log_abs_det_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT q,
    float *SE2_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = se2_log_abs_det_f(p + 3 * i, q + 3 * i);
}

/* position: G(p)^-1 df, heading: G(p)^-1 df */
void se2_riemannian_gradient_f(
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT df,
    float *SE2_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
    gradient_out[2] = df[2];
}

void se2_riemannian_gradient_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT df,
    float *SE2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) se2_riemannian_gradient_f(p + 3 * i, df + 3 * i, gradient_out + 3 * i);
}

/* sqrt(gradient_norm(position)^2 + gradient_norm(heading)^2) */
float se2_gradient_norm_f(const float *SE2_RESTRICT p, const float *SE2_RESTRICT df) {
    (void)p;
    return sqrtf(df[0] * df[0] + df[1] * df[1] + df[2] * df[2]);
}

void se2_gradient_norm_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT df,
    float *SE2_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = se2_gradient_norm_f(p + 3 * i, df + 3 * i);
}

/* position: v, heading: v */
void se2_transport_f(
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT q,
    const float *SE2_RESTRICT v,
    float *SE2_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
    w_out[1] = v[1];
    w_out[2] = v[2];
}

void se2_transport_batch_f(
    size_t count,
    const float *SE2_RESTRICT p,
    const float *SE2_RESTRICT q,
    const float *SE2_RESTRICT v,
    float *SE2_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) se2_transport_f(p + 3 * i, q + 3 * i, v + 3 * i, w_out + 3 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void se2_splat_f(
    const float *SE2_RESTRICT x,
    const float *SE2_RESTRICT mu,
    const float *SE2_RESTRICT W,
    float amplitude,
    float *SE2_RESTRICT value_out,
    float *SE2_RESTRICT gradient_out) {
    const float v0 = x[0] - mu[0];
    const float v1 = x[1] - mu[1];
    const float gap = x[2] - mu[2];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v2 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float z0 = W[0] * v0 + W[1] * v1 + W[2] * v2;
    const float z1 = W[3] * v0 + W[4] * v1 + W[5] * v2;
    const float z2 = W[6] * v0 + W[7] * v1 + W[8] * v2;
    const float minus = -(0.5f * (z0 * z0 + z1 * z1 + z2 * z2));
    const float phi = amplitude * expf(minus);
    const float by_v2 = -(W[8] * z2) - W[5] * z1 - W[2] * z0;
    const float by_v1 = -(W[7] * z2) - W[4] * z1 - W[1] * z0;
    const float by_v0 = -(W[6] * z2) - W[3] * z1 - W[0] * z0;
    const float df0 = phi * by_v0;
    const float df1 = phi * by_v1;
    const float df2 = phi * by_v2;
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
    gradient_out[2] = df2;
}

void se2_splat_batch_f(
    size_t count,
    const float *SE2_RESTRICT x,
    const float *SE2_RESTRICT mu,
    const float *SE2_RESTRICT W,
    const float *SE2_RESTRICT amplitude,
    float *SE2_RESTRICT value_out,
    float *SE2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) se2_splat_f(x + 3 * i, mu + 3 * i, W + 9 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void se2_frame_f(const float *SE2_RESTRICT p, float *SE2_RESTRICT frame) {
    float left[3][3];
    for (int i = 0; i < 3; ++i) {
        float axis[3];
        for (int j = 0; j < 3; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        se2_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 3; ++row) {
        float *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 3; ++i)
            if (se2_norm_f(p, left[i]) > se2_norm_f(p, left[longest])) longest = i;
        const float length = se2_norm_f(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 3; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 3];
            const float part = se2_inner_f(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}
