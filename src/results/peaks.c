#include "results/peaks.h"

#include "base/load_unit.h"
#include "ice/fracture.h"
#include "io/record_layout.h"
#include "io/text_buffer.h"
#include "model/scenario_vessel.h"
#include "vessel/hull.h"

#include <errno.h>
#include <math.h>
#include <unistd.h>

#define NAME(id, name, text) name,
#define TEXT(id, name, text) text,
static const char *const mechanism_names[] = {ICE_MECHANISMS(NAME)}, *const mechanism_texts[] = {ICE_MECHANISMS(TEXT)};
static const char *const end_names[] = {CHAIN_ENDS(NAME)}, *const end_texts[] = {CHAIN_ENDS(TEXT)};

const char *mechanism_name(ice_mechanism m) { return mechanism_names[m]; }
const char *mechanism_text(ice_mechanism m) { return mechanism_texts[m]; }
const char *chain_end_name(chain_end e) { return end_names[e]; }
const char *chain_end_text(chain_end e) { return end_texts[e]; }
const char *chain_end_noun(chain_end e)
{
    static const char *const nouns[CHAIN_END_COUNT] = {[CHAIN_SHEET] = "fixed ice",
                                                       [CHAIN_DRIVEN] = "driven ice",
                                                       [CHAIN_WALL] = "wall",
                                                       [CHAIN_VESSEL] = "vessel",
                                                       [CHAIN_ITSELF] = "hull"};
    return nouns[e] ? nouns[e] : "body";
}
chain_end peak_end(const run_data *d, const peak_floe *f)
{
    return f->end == CHAIN_VESSEL && scenario_vessel_count(&d->s) == 1 ? CHAIN_ITSELF : (chain_end)f->end;
}
const char *peak_end_vessel(const run_data *d, const peak_floe *f)
{
    return f->links > 0 && peak_end(d, f) == CHAIN_VESSEL ? scenario_vessel_name(&d->s, f->end_vessel) : NULL;
}
const char *peak_zone_name(int32_t zone) { return hull_zone_name((hull_zone)zone); }

ice_mechanism peak_main_mechanism(const double part[MECHANISM_COUNT])
{
    int best = 0;
    for (int i = 1; i < MECHANISM_COUNT; i++)
        best = part[i] > part[best] ? i : best;
    return (ice_mechanism)best;
}

/* ---- reading ---- */

/* A run writes what its picker kept, which stands apart and is no more than that. */
static fram_status add_peak(context *ctx, peak_list *list, const char *path, const peak_detail *d, fram_error *error)
{
    if (list->count == PEAKS_KEPT)
        return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                         "expected up to %d peaks of a vessel, found more: the file is damaged; run the scenario again",
                         (int)PEAKS_KEPT);
    peak_detail *peak = memory_array(ctx, 1, sizeof *peak);
    if (!peak)
        return error_memory(error);
    *peak = *d;
    list->peak[list->count++] = peak;
    return FRAM_OK;
}

static void sort(peak_list *list)
{
    for (int32_t i = 1; i < list->count; i++) {
        peak_detail *p = list->peak[i];
        int32_t k = i;
        for (; k > 0 && list->peak[k - 1]->load < p->load; k--)
            list->peak[k] = list->peak[k - 1];
        list->peak[k] = p;
    }
}

fram_status peak_list_read(context *ctx, const char *folder, int32_t vessel, peak_list *list, fram_error *error)
{
    char path[PATH_ROOM];
    *list = (peak_list){0};
    fram_status status = path_join(folder, "peaks.fram", path, error);
    if (status != FRAM_OK)
        return status;
    if (access(path, F_OK) != 0 && errno == ENOENT)
        return FRAM_OK;
    record_reader reader;
    status = record_open(ctx, path, &reader, error);
    if (status != FRAM_OK)
        return status;
    peak_detail *d = memory_array(ctx, 1, sizeof *d);
    status = d ? FRAM_OK : error_memory(error);
    bool found = true;
    vec2 origin = {0, 0};
    while (status == FRAM_OK && found) {
        record_block block;
        status = record_next(&reader, &block, &found, error);
        if (status == FRAM_OK && found && block.type == BLOCK_ORIGIN)
            status = record_take_origin(path, &block, &origin, error);
        if (status != FRAM_OK || !found || block.type != BLOCK_PEAK)
            continue;
        if (!peak_block_unpack(block.data, block.size, origin, d))
            status = error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                               "a peak in this file does not fit: another version of Fram wrote it; run the scenario "
                               "again");
        else if (d->vessel == vessel)
            status = add_peak(ctx, list, path, d, error);
    }
    sort(list);
    record_tell_damage(&reader, "peaks after it are missing");
    record_reader_close(&reader);
    memory_free(ctx, d);
    if (status != FRAM_OK)
        peak_list_free(ctx, list);
    return status;
}

fram_status peak_list_try(context *ctx, const char *folder, int32_t vessel, const char *what, bool *unread,
                          peak_list *list, fram_error *error)
{
    fram_error reason = {0};
    fram_status status = peak_list_read(ctx, folder, vessel, list, &reason);
    if (status == FRAM_ERROR_INPUT) {
        char text[ERROR_TEXT_SIZE];
        error_text(&reason, text);
        if (!*unread)
            log_write(ctx, LOG_WARNING, "%s tells no peaks: %s", what, text);
        *unread = true;
        return FRAM_OK;
    }
    if (status != FRAM_OK && error)
        *error = reason;
    return status;
}

void peak_list_free(context *ctx, peak_list *list)
{
    for (int32_t i = 0; i < list->count; i++)
        memory_free(ctx, list->peak[i]);
    list->count = 0;
}

/* ---- telling ---- */

double peak_span_before(const scenario *s) { return 5 * sqrt(scenario_size(s)); }

double peak_span_recorded(const run_data *d, double time)
{
    const double *row = run_channel(d, "time");
    double span = peak_span_before(&d->s), from = run_recorded_from(d);
    if (from > 0 && row && d->series.rows > 0)
        from = fmin(from, row[0]); /* the first frame may come later */
    return from > 0 && time - from < span ? fmax(time - from, 0) : span;
}

peak_breaks peak_breaks_before(const run_data *d, double time)
{
    peak_breaks b = {.last = (double)NAN};
    const csv_table_column *when = csv_table_find(&d->fractures, "time"), *kind = csv_table_find(&d->fractures, "kind");
    double span = peak_span_before(&d->s), slack = 1e-9 * (1 + fabs(time));
    for (int32_t i = 0; when && kind && i < d->fractures.rows; i++) {
        double t = when->value.data[i];
        if (t > time + slack || t < time - span)
            continue;
        bool split = kind->value.data[i] == FRACTURE_SPLIT, bending = kind->value.data[i] == FRACTURE_BENDING;
        b.splits += split;
        b.bendings += bending;
        if (split || bending)
            b.last = t > time - slack ? time : t;
    }
    return b;
}

void peak_tell_breaks(context *ctx, const peak_breaks *b, text_buffer *out)
{
    text_format(ctx, out, "%d break%s in bending and %d split%s", (int)b->bendings, b->bendings == 1 ? "" : "s",
                (int)b->splits, b->splits == 1 ? "" : "s");
}

/* Where a chain leads, after a count of floes; what is no floe is not counted. */
static const struct {
    const char *way, *what;
    bool floe;
} chain_leads[CHAIN_END_COUNT] = {
    [CHAIN_INERTIA] = {"to", "one that its inertia holds", true},
    [CHAIN_WATER] = {"to", "one that water and weight hold", true},
    [CHAIN_SHEET] = {"to", "fixed ice", true},
    [CHAIN_DRIVEN] = {"to", "driven ice", true},
    [CHAIN_WALL] = {"to", "a wall", false},
    [CHAIN_VESSEL] = {"to", "a vessel", false},
    [CHAIN_LOOP] = {"and back to", "one of them", true},
    [CHAIN_ITSELF] = {"and back to", "the vessel itself", false},
    [CHAIN_LONG] = {"and on beyond", "what is followed", true},
};

static void tell_chain_behind(context *ctx, const run_data *run, const peak_floe *f, text_buffer *out)
{
    chain_end end = peak_end(run, f);
    const char *vessel = peak_end_vessel(run, f), *what = vessel ? vessel : chain_leads[end].what;
    int32_t more = f->links + f->left_out - (chain_leads[end].floe ? 1 : 2);
    if (f->links <= 1)
        return;
    if (more > 0)
        text_format(ctx, out, ", behind it %d more %s %s", (int)more, chain_leads[end].way, what);
    else
        text_format(ctx, out, ", behind it %s", what);
}

static void tell_floe(context *ctx, const run_data *run, const peak_detail *d, text_buffer *out)
{
    const peak_floe *f = &d->floe[0];
    double part = 0;
    for (int i = 0; i < MECHANISM_COUNT; i++)
        part += f->part[i];
    if (d->floe_count == 0 || !(d->load > 0) || part < 0.3 * d->load)
        return;
    if (f->number < 0)
        text_format(ctx, out, "; one body that is no floe carries %.0f %%", 100 * part / d->load);
    else
        text_format(ctx, out, "; floe %d carries %.0f %%", (int)f->number, 100 * part / d->load);
    tell_chain_behind(ctx, run, f, out);
}

void peak_sentence(context *ctx, const run_data *run, const peak_detail *d, text_buffer *out)
{
    double zones[PEAK_ZONES] = {0};
    int32_t zone = 0;
    for (int32_t z = 0; z < PEAK_ZONES; z++) {
        for (int i = 0; i < MECHANISM_COUNT; i++)
            zones[z] += d->zone[z][i];
        zone = zones[z] > zones[zone] ? z : zone;
    }
    ice_mechanism first = peak_main_mechanism(d->mechanism);
    double share = d->load > 0 ? 100 / d->load : 0;
    text_format(ctx, out, "%s, %.0f %% of it by %s, %.0f %% on the %s, from %d %s", load_text_of(d->load, 4).text,
                d->mechanism[first] * share, mechanism_text(first), zones[zone] * share, peak_zone_name(zone),
                (int)d->bodies, d->bodies == 1 ? "body" : "bodies");
    tell_floe(ctx, run, d, out);
    peak_breaks b = peak_breaks_before(run, d->time);
    if (b.splits + b.bendings > 0) {
        text_add(ctx, out, "; in all of the ice ");
        peak_tell_breaks(ctx, &b, out);
        double span = peak_span_recorded(run, d->time);
        text_format(ctx, out,
                    span < peak_span_before(&run->s) ? " in the %.3g s since the recording began"
                                                     : " in the %.3g s before",
                    span);
    }
    text_add(ctx, out, ".");
}
