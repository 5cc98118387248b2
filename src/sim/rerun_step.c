#include "sim/rerun_step.h"

#include "sim/build.h"

/* Where the new window reaches further back than the old one, for lengths are rounded, it begins with its first load.
 */
static void divide_loads(const world *from, int32_t parts, world *w)
{
    int64_t now = w->clock.step[0], oldest = from->clock.step[0] - load_window_length(from);
    int64_t first = now - load_window_length(w);
    for (int64_t i = first < 0 ? 0 : first; i < now; i++) {
        int64_t then = i / parts < oldest ? oldest : i / parts;
        for (int32_t v = 0; v < w->vessels.count; v++) {
            int64_t row = load_window_row(w, i, v), old = load_window_row(from, then, v);
            w->load_window.force[row] = from->load_window.force[old];
            w->load_window.moment[row] = from->load_window.moment[old];
        }
    }
}

fram_status rerun_divide_step(context *ctx, const scenario *s, const world *from, int32_t parts, world *w,
                              fram_error *error)
{
    w->clock.step[0] = from->clock.step[0] * parts;
    fram_status status = build_load_window(ctx, s, w->vessels.count, w, error);
    if (status != FRAM_OK)
        return status;
    divide_loads(from, parts, w);
    for (int32_t v = 0; v < w->stations.count; v++) {
        w->stations.control_every[v] *= parts;
        w->stations.sample_every[v] *= parts;
    }
    return FRAM_OK;
}
