#include "sim/rerun_step.h"

/* A window of as long a time: of `parts` times as many steps, whatever the scenario's comes to in these. */
static fram_status divide_loads(context *ctx, const world *from, int32_t parts, world *w, fram_error *error)
{
    int64_t now = w->clock.step[0], first = now - parts * load_window_length(from);
    if (!table_resize(ctx, &w->load_window, &load_window_table_info, parts * from->load_window.count))
        return error_memory(error);
    for (int64_t i = first < 0 ? 0 : first; i < now; i++) {
        for (int32_t v = 0; v < w->vessels.count; v++) {
            int64_t row = load_window_row(w, i, v), old = load_window_row(from, i / parts, v);
            w->load_window.force[row] = from->load_window.force[old];
            w->load_window.moment[row] = from->load_window.moment[old];
        }
    }
    return FRAM_OK;
}

/* Shorter steps pass on as much less each: by impulses of whole steps warm starts would push too hard, and what sleeps
   under a steady push would miss some of it.  Sums over time stay. */
static void divide_impulses(double part, world *w)
{
    for (int32_t i = 0; i < w->memory.count; i++)
        w->memory.on_lower[i] = vec3_scale(w->memory.on_lower[i], part);
    for (int32_t i = 0; i < w->joints.count; i++)
        for (int r = 0; r < 6; r++)
            w->joints.impulse[i].row[r] *= part;
    for (int32_t i = 0; i < w->rest.count; i++) {
        w->rest.push[i] = vec3_scale(w->rest.push[i], part);
        w->rest.turn[i] = vec3_scale(w->rest.turn[i], part);
        w->rest.mean_push[i] = vec3_scale(w->rest.mean_push[i], part);
        w->rest.mean_turn[i] = vec3_scale(w->rest.mean_turn[i], part);
    }
}

fram_status rerun_divide_step(context *ctx, const world *from, int32_t parts, model *m, world *w, fram_error *error)
{
    m->step_parts = parts;
    w->clock.step[0] = from->clock.step[0] * parts;
    fram_status status = divide_loads(ctx, from, parts, w, error);
    divide_impulses(1.0 / parts, w);
    for (int32_t v = 0; v < w->stations.count && status == FRAM_OK; v++) {
        w->stations.control_every[v] *= parts;
        w->stations.sample_every[v] *= parts;
    }
    return status;
}
