/* fram_why: finished results and the computing again of a moment meet here, for they do not know each other. */
#include "results/why.h"
#include "api/arguments.h"
#include "api/handles.h"
#include "fram/results.h"
#include "sim/rerun.h"

static void fram_why_fill(fram_why_definition *definition)
{
    *definition = (fram_why_definition){.size = sizeof *definition, .rerun = true};
}
DEFINITION_DEFAULT(fram_why, fram_why_definition)

static fram_status take_why(const fram_why_definition *given, fram_why_definition *d, fram_error *error)
{
    fram_why_fill(d);
    fram_status status = definition_take(d, given, sizeof *d, DEFINITION_LEAST, "fram_why", error);
    if (status == FRAM_OK && d->peak < 0)
        status =
            error_set(error, FRAM_ERROR_USAGE, NULL, 0, "peak", "expected 1, the largest, or more, found %d", d->peak);
    if (status == FRAM_OK && d->peak == 0)
        status = number_check("time", d->time, -TIME_MOST, TIME_MOST, error);
    return status;
}

/* Rank of a recorded peak, 0 for another moment. */
static int32_t rank_of(const why *y, const peak_detail *d)
{
    for (int32_t i = 0; i < y->peaks.count; i++)
        if (y->peaks.peak[i] == d)
            return i + 1;
    return 0;
}

/* A moment that must be computed again, where that may not be done. */
static fram_status refuse_unrecorded(const why *y, double time, fram_error *error)
{
    const char *folder = y->run.folder;
    int count = (int)y->peaks.count;
    if (count == 0)
        return error_set(error, FRAM_ERROR_INPUT, folder, 0, "time",
                         "the run keeps no peaks of this vessel: let the moment be computed again");
    if (count == 1)
        return error_set(error, FRAM_ERROR_INPUT, folder, 0, "time",
                         "contacts are kept of the largest peak, and %g s is not at it; name that peak, or let the "
                         "moment be computed again",
                         time);
    return error_set(error, FRAM_ERROR_INPUT, folder, 0, "time",
                     "contacts are kept of the %d largest peaks, and %g s is at none of them; name a peak, or let the "
                     "moment be computed again",
                     count, time);
}

/* What is recorded of the moment; NULL: it must be computed again. */
static fram_status find(const why *y, const fram_why_definition *d, const peak_detail **found, fram_error *error)
{
    *found = NULL;
    if (d->peak > 0)
        return why_peak(y, d->peak, found, error);
    fram_status status = why_check_time(y, d->time, error);
    if (status != FRAM_OK)
        return status;
    *found = why_recorded_at(y, d->time);
    if (*found || d->rerun)
        return FRAM_OK;
    if (y->unread.status != FRAM_OK)
        return why_peak(y, 1, found, error);
    return refuse_unrecorded(y, d->time, error);
}

/* The caller's own troubles say nothing of the run. */
static bool is_of_run(fram_status status)
{
    return status != FRAM_OK && status != FRAM_ERROR_MEMORY && status != FRAM_INTERRUPTED &&
           status != FRAM_ERROR_INTERNAL;
}

static void tell_hindrance(const fram_error *reason, bool told, why_check *checked)
{
    const char *key = told ? "" : reason->key;
    checked->told = told;
    snprintf(checked->hindrance, sizeof checked->hindrance, "%s%s%s", key, key[0] ? ": " : "", reason->message);
}

/* What is kept of a peak is told though its moment cannot be computed again, as where a program steered the run, whose
   own computing alone knows what it was told, or another Fram made it. */
static fram_status compute_again(context *ctx, const why *y, double time, const peak_detail *kept, rerun_result *again,
                                 why_check *checked, fram_error *error)
{
    const bool steered = y->run.note.told.count > 0;
    fram_error reason = {0};
    fram_status status =
        rerun_moment(ctx, y->run.folder, time, steered ? run_recorded_from(&y->run) : 0, y->vessel, again, &reason);
    if (status == FRAM_OK)
        *checked = (why_check){.done = true,
                               .start = again->start,
                               .fork = again->fork,
                               .first = again->first,
                               .last = again->last,
                               .same = again->same.load,
                               .half_step = {again->half_step.load, again->half_step.wrong},
                               .accurate = {again->accurate.load, again->accurate.wrong}};
    const bool is_hindered = kept && is_of_run(status);
    if (is_hindered)
        tell_hindrance(&reason, steered && again->untold, checked);
    else if (status != FRAM_OK && error)
        *error = reason;
    return is_hindered ? FRAM_OK : status;
}

static fram_status explain(context *ctx, const why *y, const fram_why_definition *d, text_buffer *out,
                           fram_error *error)
{
    const peak_detail *detail;
    rerun_result *again = NULL;
    why_check checked = {.done = false};
    fram_status status = find(y, d, &detail, error);
    if (status == FRAM_OK && d->picture)
        status = why_picture_check(y, d->picture, error);
    if (status == FRAM_OK && d->rerun) {
        again = memory_array(ctx, 1, sizeof *again);
        status = again ? compute_again(ctx, y, detail ? detail->time : d->time, detail, again, &checked, error)
                       : error_memory(error);
        detail = detail || !again ? detail : &again->detail;
    }
    int32_t rank = rank_of(y, detail);
    if (status == FRAM_OK)
        status =
            d->json ? why_json(y, detail, rank, &checked, out, error) : why_text(y, detail, rank, &checked, out, error);
    if (status == FRAM_OK && d->picture)
        status = why_picture(y, detail, rank, d->picture, error);
    memory_free(ctx, again);
    return status;
}

fram_status fram_why(fram_context *c, const char *run, const fram_why_definition *definition, char **text,
                     fram_error *error)
{
    fram_why_definition taken, *d = &taken;
    fram_status status = REFUSE_NULL(error, {"context", c}, {"run", run}, {"text", text});
    if (status == FRAM_OK)
        status = take_why(definition, d, error);
    if (status != FRAM_OK)
        return status;
    why y;
    context own = c->inner, *ctx = &own; /* other threads may be at work in the program's */
    status = why_open(ctx, run, d->vessel, &y, error);
    if (status != FRAM_OK)
        return status;
    text_buffer out = {0};
    if (d->stop)
        ctx->stop = d->stop;
    status = explain(ctx, &y, d, &out, error);
    if (status == FRAM_OK) /* a refusal says so itself */
        run_warn_change(ctx, &y.run);
    why_close(&y);
    if (status == FRAM_OK)
        *text = out.data;
    else
        text_free(ctx, &out);
    return status;
}
