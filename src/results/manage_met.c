/* The ice that came to a vessel, for who makes a field of it. */
#include "results/manage_parts.h"

#include "base/channel_statistics.h"

int manage_came_from(const manage_moment *at)
{
    if (at->looked[MANAGE_BEHIND] >= 0)
        return MANAGE_BEHIND;
    if (at->looked[MANAGE_UPSTREAM] >= 0)
        return MANAGE_UPSTREAM;
    return at->looked[MANAGE_AT] >= 0 ? MANAGE_AT : -1;
}

fram_status manage_met_ice(context *ctx, const char *folder, const char *name, double unit, managed_ice *sum,
                           fram_error *error)
{
    const manage_options options = {
        .vessel = name, .limit = (double)NAN, .depth = (double)NAN, .met = true, .unit = unit};
    manage_run m;
    double before = sum->windows;
    fram_status status = manage_read(ctx, folder, &options, &m, error);
    if (status != FRAM_OK)
        return status;
    for (int32_t i = 0; i < m.moments.count; i++) {
        const manage_moment *at = &m.moments.data[i];
        int place = manage_came_from(at);
        if (place >= 0 && time_is_after(at->time, m.d.s.run.transient))
            managed_ice_add(sum, &m.met.data[i], at->cover[place].largest / unit);
    }
    manage_free(&m);
    if (sum->windows > before)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL,
                     "no ice drifts to the vessel in a frame of the record after run.transient: run it longer, or "
                     "record more (output.frame_interval)");
}

fram_status manage_met_law(const managed_ice *sum, double unit, double sheet_as, managed_law *out, fram_error *error)
{
    fram_status status = managed_law_of(sum, sheet_as / unit, out, error);
    for (int32_t i = 0; status == FRAM_OK && i <= out->bins; i++)
        out->edge[i] *= unit;
    out->mean *= unit;
    out->largest *= unit;
    return status;
}
