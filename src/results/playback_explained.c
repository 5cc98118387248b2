#include "results/playback_explained.h"

#include "io/chart.h"
#include "io/record_layout.h"
#include "results/mechanism_curve.h"
#include "results/why.h"

#include <math.h>
#include <string.h>

/* Digits of the curve: more than a screen shows. */
enum { DIGITS = 5 };

static void add_block(context *ctx, uint32_t type, const char *data, size_t size, text_buffer *blocks)
{
    static const char zeros[8];
    unsigned char head[RECORD_BLOCK_HEAD];
    record_block_head(type, data, size, head);
    text_add_bytes(ctx, blocks, (const char *)head, sizeof head);
    text_add_bytes(ctx, blocks, data, size);
    text_add_bytes(ctx, blocks, zeros, (8 - size % 8) % 8);
}

/* ---- curves and peaks: JSON, SI units ---- */

static void add_numbers(context *ctx, const double *value, int32_t count, int digits, text_buffer *out)
{
    text_add(ctx, out, "[");
    for (int32_t i = 0; i < count; i++) {
        text_add(ctx, out, i > 0 ? "," : "");
        text_digits_or_null(ctx, out, value[i], digits);
    }
    text_add(ctx, out, "]");
}

static void add_curve(context *ctx, const mechanism_curve *c, text_buffer *out)
{
    text_add(ctx, out, ",\"time\":");
    add_numbers(ctx, c->time, c->count, 9, out);
    text_add(ctx, out, ",\"load\":");
    add_numbers(ctx, c->load, c->count, DIGITS, out);
    text_add(ctx, out, ",\"parts\":[");
    for (int m = 0; m < MECHANISM_COUNT; m++) {
        text_add(ctx, out, m > 0 ? "," : "");
        add_numbers(ctx, c->part[m], c->count, DIGITS, out);
    }
    text_add(ctx, out, "]");
}

/* Sentences are of letters, figures and stops: nothing in them has to be escaped. */
static fram_status add_peaks(const why *y, text_buffer *out, fram_error *error)
{
    const why_check none = {0};
    fram_status status = FRAM_OK;
    text_add(y->ctx, out, ",\"peaks\":[");
    for (int32_t i = 0; i < y->peaks.count && status == FRAM_OK; i++) {
        text_format(y->ctx, out, "%s{\"sentence\":\"", i > 0 ? "," : "");
        peak_sentence(y->ctx, &y->run, y->peaks.peak[i], out);
        text_add(y->ctx, out, "\",\"detail\":");
        status = why_json(y, y->peaks.peak[i], i + 1, &none, out, error);
        text_add(y->ctx, out, "}");
    }
    text_add(y->ctx, out, "]");
    return status;
}

static fram_status add_vessel(why *y, int32_t vessel, text_buffer *out, fram_error *error)
{
    mechanism_curve curve;
    vessel_entry entry = scenario_vessel_entry(&y->run.s, vessel);
    y->vessel = vessel;
    fram_status status = mechanism_curve_make(y->ctx, &y->run, vessel, &curve, error);
    if (status != FRAM_OK)
        return status;
    for (int32_t i = 0; i < y->peaks.count && curve.count > 0; i++)
        mechanism_curve_add(&curve, y->peaks.peak[i]->time, y->peaks.peak[i]->load, y->peaks.peak[i]->mechanism);
    text_format(y->ctx, out, "%s{\"name\":\"%s\",\"window\":%.9g,\"transient\":%.9g", vessel > 0 ? "," : "",
                scenario_names_vessels(&y->run.s) ? entry.keys->name : "", scenario_averaging_window(&y->run.s),
                y->run.s.run.transient);
    add_curve(y->ctx, &curve, out);
    mechanism_curve_free(y->ctx, &curve);
    status = add_peaks(y, out, error);
    text_add(y->ctx, out, "}");
    return status;
}

/* Names and texts, so that the page has none of its own; mechanisms in the colours of the report's chart. */
static void add_words(context *ctx, text_buffer *out)
{
    text_add(ctx, out, "\"mechanisms\":[");
    for (int m = 0; m < MECHANISM_COUNT; m++) {
        char colour[CHART_COLOUR_TEXT];
        chart_colour_text(m + 1, colour);
        text_format(ctx, out, "%s[\"%s\",\"%s\",\"%s\"]", m > 0 ? "," : "", mechanism_name((ice_mechanism)m),
                    mechanism_text((ice_mechanism)m), colour);
    }
    text_add(ctx, out, "],\"ends\":[");
    for (int e = 0; e < CHAIN_END_COUNT; e++)
        text_format(ctx, out, "%s[\"%s\",\"%s\"]", e > 0 ? "," : "", chain_end_name((chain_end)e),
                    chain_end_text((chain_end)e));
    text_add(ctx, out, "]");
}

static fram_status add_loads(why *y, text_buffer *out, fram_error *error)
{
    fram_status status = FRAM_OK;
    bool unread = false;
    text_add(y->ctx, out, "{");
    add_words(y->ctx, out);
    text_add(y->ctx, out, ",\"vessels\":[");
    for (int32_t v = 0; v < scenario_vessel_count(&y->run.s) && status == FRAM_OK; v++) {
        peak_list_free(y->ctx, &y->peaks);
        status = peak_list_try(y->ctx, y->run.folder, v, "the page", &unread, &y->peaks, error);
        if (status == FRAM_OK)
            status = add_vessel(y, v, out, error);
    }
    text_add(y->ctx, out, "]}");
    return status;
}

/* ---- pressure on a hull ---- */

static fram_status not_of_this_run(const char *path, const char *reason, fram_error *error)
{
    return error_set(error, FRAM_ERROR_INPUT, path, 0, "pressure",
                     "%s: make it again with fram pressure RUN -o DIR, and give that DIR", reason);
}

static fram_status add_pressure(context *ctx, const char *folder, const run_data *run, text_buffer *blocks,
                                fram_error *error)
{
    char path[PATH_ROOM];
    record_reader r;
    record_block block = {0};
    bool found = false;
    fram_status status = path_join(folder, "pressure.fram", path, error);
    if (status == FRAM_OK)
        status = record_open(ctx, path, &r, error);
    if (status != FRAM_OK)
        return status;
    status = record_next(&r, &block, &found, error);
    if (status == FRAM_OK && (!found || block.type != BLOCK_PRESSURE || block.size < PRESSURE_HEAD_SIZE))
        status = not_of_this_run(path, "it holds no pressure on a hull", error);
    else if (status == FRAM_OK && memcmp(block.data, run->note.scenario_hash, PRESSURE_HASH_SIZE) != 0)
        status = not_of_this_run(path, "it is of another scenario than this run", error);
    if (status == FRAM_OK)
        add_block(ctx, BLOCK_PRESSURE, block.data, block.size, blocks);
    record_reader_close(&r);
    return status;
}

/* ---- all ---- */

static fram_status explain(why *y, const char *pressure, text_buffer *blocks, fram_error *error)
{
    text_buffer loads = {0};
    fram_status status = scenario_vessel_count(&y->run.s) > 0 ? add_loads(y, &loads, error) : FRAM_OK;
    if (status == FRAM_OK && !loads.failed && loads.count > 0)
        add_block(y->ctx, BLOCK_LOADS, loads.data, (size_t)loads.count, blocks);
    if (status == FRAM_OK && pressure)
        status = add_pressure(y->ctx, pressure, &y->run, blocks, error);
    if (status == FRAM_OK && (loads.failed || blocks->failed))
        status = error_memory(error);
    text_free(y->ctx, &loads);
    return status;
}

fram_status playback_explain(context *ctx, const char *folder, const char *pressure, text_buffer *blocks,
                             fram_error *error)
{
    fram_error reason = {0};
    why y = {.ctx = ctx};
    fram_status status = run_data_read(ctx, folder, false, NULL, &y.run, &reason);
    if (status == FRAM_OK) {
        run_warn_change(ctx, &y.run);
        status = explain(&y, pressure, blocks, &reason);
        why_close(&y);
    }
    if (!pressure && (status == FRAM_ERROR_INPUT || status == FRAM_ERROR_IO)) {
        char text[ERROR_TEXT_SIZE];
        error_text(&reason, text);
        log_write(ctx, LOG_WARNING, "the page tells no loads by mechanism and no peaks: %s", text);
        return FRAM_OK;
    }
    if (status != FRAM_OK && error)
        *error = reason;
    return status;
}
