/* The ice that came to a vessel, for who makes a field of it. */
#include "results/manage_parts.h"

/* Where the ice of a window is taken: the last time that it was seen before the hull was upon it. */
static const manage_cover *came_as(const manage_moment *at)
{
    if (at->looked[MANAGE_BEHIND] >= 0)
        return &at->cover[MANAGE_BEHIND];
    if (at->looked[MANAGE_UPSTREAM] >= 0)
        return &at->cover[MANAGE_UPSTREAM];
    return at->looked[MANAGE_AT] >= 0 ? &at->cover[MANAGE_AT] : NULL;
}

fram_status manage_met_ice(context *ctx, const char *folder, const char *name, managed_ice *sum, fram_error *error)
{
    const manage_options options = {.vessel = name, .limit = (double)NAN, .depth = (double)NAN};
    manage_run m;
    double before = sum->windows;
    fram_status status = manage_read(ctx, folder, &options, &m, error);
    if (status != FRAM_OK)
        return status;
    for (int32_t i = 0; i < m.moments.count; i++) {
        const manage_cover *cover = came_as(&m.moments.data[i]);
        if (cover && m.moments.data[i].time >= m.d.s.run.transient)
            managed_ice_add(sum, &cover->fine, cover->largest);
    }
    manage_free(&m);
    if (sum->windows > before)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL,
                     "no ice drifts to the vessel in a frame of the record after run.transient: run it longer, or "
                     "record more (output.frame_interval)");
}
