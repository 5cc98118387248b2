#include "sim/build_media.h"

#include "io/velocity_file.h"

static fram_status read_profile(context *ctx, const scenario *s, const char *file, current_profile *out,
                                fram_error *error)
{
    if (!*file)
        return FRAM_OK;
    velocity_rows rows = {0};
    fram_status status = velocity_rows_read(ctx, s, file, "depth[m]", &rows, error);
    int32_t count = rows.column[VELOCITY_AT].count;
    if (status == FRAM_OK && (count < 1 || count > CURRENT_LEVELS || rows.column[VELOCITY_AT].data[0] < 0))
        status = error_set(error, FRAM_ERROR_INPUT, file, 0, "depth[m]",
                           "expected 1 to %d depths, from 0 on, found %d, from %g on", (int)CURRENT_LEVELS, (int)count,
                           count < 1 ? 0 : rows.column[VELOCITY_AT].data[0]);
    for (int32_t i = 0; i < count && status == FRAM_OK; i++) {
        out->depth[i] = rows.column[VELOCITY_AT].data[i];
        out->velocity[i] = vec3_make(rows.column[VELOCITY_X].data[i], rows.column[VELOCITY_Y].data[i], 0);
        out->count = count;
    }
    velocity_rows_free(ctx, &rows);
    return status;
}

fram_status build_media(context *ctx, const scenario *s, media_history *out, fram_error *error)
{
    const scenario_environment *e = &s->environment;
    fram_status status = velocity_file_read(ctx, s, e->current_file, &out->current, error);
    if (status == FRAM_OK)
        status = velocity_file_read(ctx, s, e->wind_file, &out->wind, error);
    if (status == FRAM_OK)
        status = velocity_file_read(ctx, s, s->domain.drift_file, &out->drift, error);
    if (status == FRAM_OK)
        status = read_profile(ctx, s, e->current_profile_file, &out->profile, error);
    return status;
}
