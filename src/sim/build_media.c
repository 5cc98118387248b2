#include "sim/build_media.h"

#include "io/velocity_file.h"
#include "sim/usual.h"

#include <math.h>

fram_status build_media(context *ctx, const scenario *s, media_history *out, fram_error *error)
{
    const scenario_environment *e = &s->environment;
    fram_status status = velocity_file_read(ctx, s, e->current_file, &out->current, error);
    if (status == FRAM_OK)
        status = velocity_file_read(ctx, s, e->wind_file, &out->wind, error);
    if (status == FRAM_OK)
        status = velocity_file_read(ctx, s, s->domain.drift_file, &out->drift, error);
    if (status == FRAM_OK)
        status = velocity_profile_read(ctx, s, e->current_profile_file, &out->profile, error);
    return status;
}

/* ---- what is likely a slip in a history ---- */

/* Part of the run that a history of several rows covers at least: one in minutes covers a sixtieth. */
#define LEAST_COVER 0.1

typedef struct history_rule {
    const char *key, *file;
    const velocity_series *rows;
    const char *constant; /* the key of one that is constant, which usually has the same speeds */
} history_rule;

static void warn_of_speed(context *ctx, const scenario *s, const history_rule *r, double fastest)
{
    double most = usual_range_of(s, r->constant).most;
    if (fastest > most)
        log_write(ctx, LOG_WARNING, "%s: %s goes up to %.4g m/s, more than %.3g: give m/s, not knots, km/h or cm/s",
                  r->key, r->file, fastest, most);
}

static void warn_of_history(context *ctx, const scenario *s, const history_rule *r)
{
    int32_t n = r->rows->count;
    if (n < 1)
        return;
    double first = r->rows->time[0], last = r->rows->time[n - 1], end = s->run.duration, fastest = 0;
    for (int32_t i = 0; i < n; i++)
        fastest = fmax(fastest, vec3_length(r->rows->velocity[i]));
    if (n > 1 && last > first && last < LEAST_COVER * end)
        log_write(ctx, LOG_WARNING,
                  "%s: the last row of %s is of %.6g s, and the run goes on to %.6g s: times are seconds, not minutes "
                  "or hours",
                  r->key, r->file, last, end);
    if (first > end)
        log_write(
            ctx, LOG_WARNING,
            "%s: the first row of %s is of %.6g s, after the end of the run at %.6g s: times count from its start",
            r->key, r->file, first, end);
    warn_of_speed(ctx, s, r, fastest);
}

void history_warnings(context *ctx, const scenario *s, const media_history *h)
{
    const scenario_environment *e = &s->environment;
    const history_rule rules[] = {
        {"environment.current_file", e->current_file, &h->current, "environment.current_speed"},
        {"environment.wind_file", e->wind_file, &h->wind, "environment.wind_speed"},
        {"domain.drift_file", s->domain.drift_file, &h->drift, "domain.drift_speed"}};
    const history_rule over_depth = {"environment.current_profile_file", e->current_profile_file, NULL,
                                     "environment.current_speed"};
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        warn_of_history(ctx, s, &rules[i]);
    double fastest = 0;
    for (int32_t i = 0; i < h->profile.count; i++)
        fastest = fmax(fastest, vec3_length(h->profile.velocity[i]));
    warn_of_speed(ctx, s, &over_depth, fastest);
}
