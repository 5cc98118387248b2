#include "sim/run_summary.h"

#include "base/build_parts.h"
#include "fram/version.h"
#include "io/run_note.h"
#include "sim/run_inputs.h"
#include "sim/run_told.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define SUMMARY_TEXT(room, text) snprintf(room, sizeof(room), "%s", text)

static bool note_files(context *ctx, const char *inputs, run_note *n)
{
    run_input file;
    for (const char *end = inputs + strlen(inputs); run_inputs_next(&inputs, end, &file);) {
        run_note_file f;
        memcpy(f.digest, file.digest, sizeof f.digest);
        snprintf(f.path, sizeof f.path, "%.*s", file.path_length, file.path);
        if (!array_push(ctx, &n->files, f))
            return false;
    }
    return true;
}

/* What befell the vessels, as far as a file that is read in one go can hold it. */
static bool note_events(context *ctx, const scenario *s, const event_table *events, run_note *n)
{
    enum { MOST = 1000 };
    int32_t shown = events->count < MOST ? events->count : MOST;
    n->events_left_out = events->count - shown;
    for (int32_t i = 0; i < shown; i++) {
        run_event e = {.time = events->time[i], .value = events->value[i], .ahead = events->ahead[i]};
        station_event kind = (station_event)events->kind[i];
        const char *name = scenario_vessel_name(s, events->vessel[i]);
        const char *other = event_is_of_two(kind) ? scenario_vessel_name(s, events->number[i]) : NULL;
        event_text(events, i, other, scenario_vessel_entry(s, events->vessel[i]).keys->approach.look_ahead, e.text,
                   sizeof e.text);
        SUMMARY_TEXT(e.kind, event_name(kind));
        SUMMARY_TEXT(e.vessel, name ? name : "");
        SUMMARY_TEXT(e.other, other ? other : "");
        if (!array_push(ctx, &n->events, e))
            return false;
    }
    return true;
}

/* How ships that drive themselves kept their tracks. */
static bool note_tracks(context *ctx, const scenario *s, const propulsion_table *p, run_note *n)
{
    for (int32_t i = 0; i < p->count; i++) {
        const scenario_propulsion *keys = &scenario_vessel_entry(s, p->vessel[i]).keys->propulsion;
        const char *name = scenario_vessel_name(s, p->vessel[i]);
        if (keys->pattern.kind == PATTERN_NONE && keys->waypoints.count == 0)
            continue;
        run_track t = {.limit = p->settings[i].track_limit,
                       .largest = p->off_most[i],
                       .rms = p->off_time[i] > 0 ? sqrt(p->off_square[i] / p->off_time[i]) : 0,
                       .time = p->off_time[i],
                       .rounds = (double)p->rounds[i]};
        SUMMARY_TEXT(t.vessel, name ? name : "");
        if (!array_push(ctx, &n->tracks, t))
            return false;
    }
    return true;
}

/* Wall times of steps, to the digits that their bins have. */
static void note_steps(const time_ranks *t, run_note *n)
{
    if (t->count == 0)
        return;
    n->step_median = 1e3 * time_ranks_at(t, 500);
    n->step_p99 = 1e3 * time_ranks_at(t, 990);
    n->step_p999 = 1e3 * time_ranks_at(t, 999);
    n->step_longest = 1e3 * t->longest;
}

static void note_texts(const context *ctx, const scenario *s, const run_summary *summary, run_note *n)
{
    SUMMARY_TEXT(n->version, FRAM_VERSION);
    SUMMARY_TEXT(n->compiler, build_compiler());
    SUMMARY_TEXT(n->libraries, build_parts());
    SUMMARY_TEXT(n->isa, isa_name(ctx->isa));
    SUMMARY_TEXT(n->title, s->title);
    SUMMARY_TEXT(n->scenario_hash, summary->scenario_hash);
    SUMMARY_TEXT(n->status, summary->status);
    SUMMARY_TEXT(n->message, summary->message ? summary->message : "");
    snprintf(n->state_hash, sizeof n->state_hash, "%016" PRIx64, summary->state_hash);
}

fram_status run_summary_write(context *ctx, const char *folder, const scenario *s, const world *w,
                              const run_summary *summary, fram_error *error)
{
    run_note n;
    run_note_init(&n);
    note_texts(ctx, s, summary, &n);
    note_steps(summary->step_times, &n);
    n.threads = summary->threads;
    n.seed = (double)s->run.seed;
    n.good_until = summary->good_until;
    n.recorded_from = summary->recorded_from;
    n.steps = (double)w->clock.step[0];
    n.time = w->clock.time[0];
    n.wall = summary->wall;
    n.recording = summary->recording;
    n.recording_end = summary->recording_end;
    run_told_list(ctx, s, w, &n.told);
    bool good = note_files(ctx, summary->inputs, &n) && note_events(ctx, s, &w->events, &n) &&
                note_tracks(ctx, s, &w->propulsion, &n) && !n.told.failed;
    fram_status status = good ? run_note_write(ctx, folder, &n, error) : error_memory(error);
    run_note_free(ctx, &n);
    return status;
}
