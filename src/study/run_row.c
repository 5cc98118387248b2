#include "study/run_row.h"

#include "base/number_text.h"
#include "ice/fracture.h"
#include "io/atomic_file.h"
#include "io/path.h"
#include "io/utf8.h"
#include "model/scenario_vessel.h"
#include "results/load_shares.h"
#include "results/mechanism_curve.h"
#include "results/run_channels.h"
#include "results/station_results.h"
#include "study/cells.h"
#include "vessel/event.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const struct {
    const char *name, *unit;
} figures[ROW_FIGURES] = {
#define RUN_ROW_HEAD(name, unit) [ROW_##name] = {#name, unit},
    RUN_ROW_FIGURES(RUN_ROW_HEAD)
#undef RUN_ROW_HEAD
};

run_figure run_figure_find(const char *name)
{
    int i = 0;
    while (i < ROW_FIGURES && strcmp(figures[i].name, name) != 0)
        i++;
    return (run_figure)i;
}

const char *run_figure_name(run_figure figure) { return figures[figure].name; }
const char *run_figure_unit(run_figure figure) { return figures[figure].unit; }

/* ---- from a run ---- */

/* The largest tension of a line as it parted [N], after the transient; NaN without.  Series have what came before and
   after that step, which begins with the event. */
static double tension_of_parting(const run_data *d, int32_t vessel)
{
    const char *name = scenario_vessel_name(&d->s, vessel);
    double most = (double)NAN;
    for (int32_t i = 0; i < d->note.events.count; i++) {
        const run_event *e = &d->note.events.data[i];
        if (time_is_after(e->time + d->s.run.time_step, d->s.run.transient) &&
            strcmp(e->kind, event_name(EVENT_LINE_BREAK)) == 0 && strcmp(e->vessel, name ? name : "") == 0)
            most = fmax(most, e->value);
    }
    return most;
}

static fram_status add_station(context *ctx, const run_data *d, int32_t vessel, run_row *out, fram_error *error)
{
    channel_statistics offset, heading, tension, power, parted;
    const scenario_vessel *v = scenario_vessel_entry(&d->s, vessel).keys;
    double *range = &out->figure[ROW_line_tension_range_equivalent];
    bool good = run_size_statistics(ctx, d, vessel, "offset_x", "offset_y", &offset) &&
                run_size_statistics(ctx, d, vessel, "heading_deviation", NULL, &heading) &&
                run_size_statistics(ctx, d, vessel, "line_tension_max", NULL, &tension) &&
                run_size_statistics(ctx, d, vessel, "thruster_power", NULL, &power) &&
                run_size_statistics(ctx, d, vessel, "lines_parted", NULL, &parted);
    if (good && v->mooring.lines.count > 0)
        good = run_equivalent_range(ctx, d, run_vessel_channel(d, vessel, "line_tension_max"), range);
    if (!good)
        return error_memory(error);
    out->figure[ROW_offset_mean] = offset.mean;
    out->figure[ROW_offset_largest] = offset.greatest;
    out->figure[ROW_heading_deviation_largest] = heading.greatest;
    /* The series have a 0 of what the vessel does not have. */
    if (v->mooring.lines.count > 0) {
        out->figure[ROW_line_tension_significant] = tension.significant;
        out->figure[ROW_line_tension_largest] = fmax(tension.greatest, tension_of_parting(d, vessel));
        out->figure[ROW_lines_parted] = parted.greatest;
        out->figure[ROW_lines_broken] = run_lines_broken(d, vessel);
    }
    if (v->thrusters.count > 0)
        out->figure[ROW_thruster_power_mean] = power.mean;
    return FRAM_OK;
}

static double channel_mean(const run_data *d, int32_t vessel, const char *channel)
{
    const double *time = run_channel(d, "time"), *value = run_vessel_channel(d, vessel, channel);
    return time && value ? channel_statistics_of(time, value, d->series.rows, d->s.run.transient).mean : (double)NAN;
}

/* Stay empty without a load, and for runs that did not split theirs. */
static void fill_shares(const run_data *d, int32_t vessel, run_row *out)
{
    mechanism_columns c;
    double share[MECHANISM_COUNT];
    if (mechanism_columns_find(d, vessel, &c) && load_shares(d, c.x, c.y, MECHANISM_COUNT, share))
        memcpy(&out->figure[ROW_share_splitting], share, sizeof share);
}

_Static_assert(ROW_share_friction - ROW_share_splitting == (int)MECHANISM_FRICTION - (int)MECHANISM_SPLITTING &&
                   ROW_FIGURES - ROW_share_splitting == (int)MECHANISM_COUNT,
               "a share for each mechanism, in their order");

/* Of the horizontal magnitude of the averaged ice load. */
static fram_status add_load(context *ctx, const run_data *d, int32_t vessel, run_row *out, fram_error *error)
{
    const char *x = "ice_force_averaged_x", *y = "ice_force_averaged_y";
    channel_statistics load;
    double_array size = {0};
    bool good = run_size_statistics(ctx, d, vessel, x, y, &load) && run_size_channel(ctx, d, vessel, x, y, &size) &&
                run_equivalent_range(ctx, d, size.data, &out->figure[ROW_load_range_equivalent]);
    array_free(ctx, &size);
    out->figure[ROW_load_mean] = load.mean;
    out->figure[ROW_load_deviation] = load.deviation;
    out->figure[ROW_load_significant] = load.significant;
    out->figure[ROW_load_largest] = load.greatest;
    return good ? FRAM_OK : error_memory(error);
}

static fram_status fill(context *ctx, const run_data *d, int32_t vessel, run_row *out, fram_error *error)
{
    fram_status status = add_load(ctx, d, vessel, out, error);
    if (status == FRAM_OK && station_has_results(&d->s, vessel))
        status = add_station(ctx, d, vessel, out, error);
    out->figure[ROW_time] = d->note.time;
    out->figure[ROW_force_x_mean] = channel_mean(d, vessel, "ice_force_averaged_x");
    out->figure[ROW_force_y_mean] = channel_mean(d, vessel, "ice_force_averaged_y");
    out->figure[ROW_fractures] = run_fractures(d, FRACTURE_SPLIT) + run_fractures(d, FRACTURE_BENDING);
    fill_shares(d, vessel, out);
    snprintf(out->state_hash, sizeof out->state_hash, "%s", d->note.state_hash);
    if (vessel < scenario_vessel_count(&d->s))
        snprintf(out->vessel, sizeof out->vessel, "%.*s", (int)VESSEL_NAME_MOST,
                 scenario_vessel_entry(&d->s, vessel).keys->name);
    return status;
}

static void begin_row(run_row *out)
{
    memset(out, 0, sizeof *out);
    for (int i = 0; i < ROW_FIGURES; i++)
        out->figure[i] = (double)NAN;
}

/* What has ended is kept, also when the context is asked to stop. */
static fram_status read_ended(context *ctx, const char *folder, run_data *out, fram_error *error)
{
    context own = context_unstopped(ctx);
    return run_data_read(&own, folder, false, NULL, out, error);
}

/* A scenario without a vessel has a row too: of its ice. */
fram_status run_rows_of(context *ctx, const char *folder, run_rows *out, fram_error *error)
{
    run_data d;
    *out = (run_rows){0};
    fram_status status = read_ended(ctx, folder, &d, error);
    if (status != FRAM_OK)
        return status;
    int32_t vessels = scenario_vessel_count(&d.s);
    for (int32_t v = 0; v < (vessels > 0 ? vessels : 1) && status == FRAM_OK; v++) {
        run_row row;
        begin_row(&row);
        status = fill(ctx, &d, v, &row, error);
        if (status == FRAM_OK && !array_push(ctx, out, row))
            status = error_memory(error);
    }
    run_data_free(ctx, &d);
    if (status != FRAM_OK)
        array_free(ctx, out);
    return status;
}

/* A reason is one line for people: whatever made it, a program's log or a row that is read, nothing in it acts on the
   terminal or the page where it is shown. */
static void replace_controls(char *text)
{
    const char *end = text + strlen(text);
    for (char *c = text; *c;) {
        const char *next = c, *plain = c;
        int32_t shown = utf8_shown(&next, end);
        if (shown < ' ' || shown != utf8_next(&plain, end))
            memset(c, ' ', (size_t)(next - c));
        c += next - c;
    }
}

bool run_log_reason(context *ctx, const char *log, char out[ROW_REASON])
{
    static const char error[] = "fram: ", conditions[] = "/conditions/";
    char *text = NULL;
    size_t size = 0;
    bool found = false;
    if (file_read(ctx, log, RUN_LOG_MOST, &text, &size, NULL) == FRAM_OK) {
        while (size > 0 && text[size - 1] == '\n')
            text[--size] = '\0';
        const char *line = strrchr(text, '\n');
        line = line ? line + 1 : text;
        found = strncmp(line, error, sizeof error - 1) == 0;
        if (found) {
            line += sizeof error - 1;
            const char *file = strstr(line, conditions), *place = strstr(line, ": ");
            snprintf(out, ROW_REASON, "%s", file && place && file < place ? file + sizeof conditions - 1 : line);
            replace_controls(out);
        }
    }
    memory_free(ctx, text);
    return found;
}

/* Without a run.json the scenario was none, and the log beside the folder says why. */
static void read_log_beside(context *ctx, const char *folder, char out[ROW_REASON])
{
    text_buffer log = {0};
    text_format(ctx, &log, "%s.log", folder);
    if (!log.failed)
        (void)run_log_reason(ctx, log.data, out);
    text_free(ctx, &log);
}

/* Codes of programs that a signal ended, as a shell tells them; an interrupted run ends with one of them by itself. */
enum { CODE_INTERRUPTED = 130, CODE_OF_SIGNAL = 128 };
static void tell_end(int exit_code, char out[ROW_REASON])
{
    if (exit_code == CODE_INTERRUPTED)
        snprintf(out, ROW_REASON, "it was stopped before its end, as by a limit of time");
    else if (exit_code > CODE_OF_SIGNAL)
        snprintf(out, ROW_REASON, "it was killed by signal %d, as where memory runs out or a task is lost",
                 exit_code - CODE_OF_SIGNAL);
    else
        snprintf(out, ROW_REASON, "it ended with exit code %d", exit_code);
}

static void fill_failure(context *ctx, const char *folder, int exit_code, run_row *out)
{
    run_data d;
    begin_row(out);
    out->failed = true;
    tell_end(exit_code, out->reason);
    if (read_ended(ctx, folder, &d, NULL) != FRAM_OK) {
        read_log_beside(ctx, folder, out->reason);
        return;
    }
    if (d.note.message[0])
        snprintf(out->reason, sizeof out->reason, "%s", d.note.message);
    out->figure[ROW_time] = d.note.time;
    run_data_free(ctx, &d);
    replace_controls(out->reason);
}

fram_status run_rows_failed(context *ctx, const char *folder, int exit_code, run_rows *out, fram_error *error)
{
    run_row row;
    *out = (run_rows){0};
    fill_failure(ctx, folder, exit_code, &row);
    return array_push(ctx, out, row) ? FRAM_OK : error_memory(error);
}

const run_row *run_rows_find(const run_rows *rows, const char *vessel)
{
    for (int32_t i = 0; i < rows->count; i++)
        if (!vessel || rows->data[i].failed || strcmp(rows->data[i].vessel, vessel) == 0)
            return &rows->data[i];
    return NULL;
}

bool run_rows_alike(const run_row *rows, int32_t count)
{
    bool alike = count > 1;
    for (int32_t i = 0; i < count && alike; i++) {
        const double *f = rows[i].figure;
        bool acted = f[ROW_load_mean] > 0 || f[ROW_offset_largest] > 0 || f[ROW_line_tension_largest] > 0;
        alike = !rows[i].failed && acted && memcmp(f, rows[0].figure, sizeof rows[0].figure) == 0;
    }
    return alike;
}

/* ---- as a file ---- */

/* Behind it stand the number of the columns and that of the decision by which loads are shared among mechanisms.
   COLUMNS_MEAN is raised when there are other columns, and when one comes to mean something else. */
static const char mark[] = "fram study row ";
enum { COLUMNS_MEAN = 8, HEAD_ROOM = 64 };

static void write_head(char out[HEAD_ROOM])
{
    snprintf(out, HEAD_ROOM, "%s%d, mechanisms %d", mark, (int)COLUMNS_MEAN, (int)MECHANISM_DECISION);
}

static void number(context *ctx, text_buffer *out, double value)
{
    char text[NUMBER_TEXT_SIZE];
    real_to_text(value, text);
    text_add(ctx, out, isfinite(value) ? text : "");
}

void run_rows_text(context *ctx, const run_rows *rows, text_buffer *out)
{
    char head[HEAD_ROOM];
    write_head(head);
    text_format(ctx, out, "%s\n", head);
    for (int32_t k = 0; k < rows->count; k++) {
        const run_row *row = &rows->data[k];
        text_format(ctx, out, "%s\n%s\n%s\n%s\n", row->failed ? "failed" : "finished", row->vessel, row->reason,
                    row->state_hash);
        for (int i = 0; i < ROW_FIGURES; i++) {
            text_format(ctx, out, "%s ", figures[i].name);
            number(ctx, out, row->figure[i]);
            text_add(ctx, out, "\n");
        }
    }
    text_add(ctx, out, "end\n");
}

fram_status run_rows_write(context *ctx, const char *path, const run_rows *rows, fram_error *error)
{
    text_buffer text = {0};
    run_rows_text(ctx, rows, &text);
    fram_status status = path_claim(path, error);
    if (status == FRAM_OK)
        status = text_file_write(ctx, path, &text, error);
    text_free(ctx, &text);
    return status;
}

/* The next line without its end; NULL after the last. */
static char *cut_line(char **rest)
{
    char *line = *rest, *end = line ? strchr(line, '\n') : NULL;
    if (!end)
        return NULL;
    *end = '\0';
    *rest = end + 1;
    return line;
}

/* Copies a line that fits. */
static bool take_line(char **rest, char *out, size_t room)
{
    const char *line = cut_line(rest);
    if (!line || strlen(line) >= room)
        return false;
    memcpy(out, line, strlen(line) + 1);
    return true;
}

static bool read_figures(char **rest, run_row *row)
{
    for (int i = 0; i < ROW_FIGURES; i++) {
        char *line = cut_line(rest);
        size_t length = strlen(figures[i].name);
        if (!line || strncmp(line, figures[i].name, length) != 0 || line[length] != ' ')
            return false;
        if (!line[length + 1])
            continue;
        if (real_from_text(line + length + 1, &row->figure[i]) != NUMBER_GOOD)
            return false;
    }
    return true;
}

/* The head of a file: whether its rows may be whole. */
static row_file read_head(char **rest)
{
    char own[HEAD_ROOM];
    const char *head = cut_line(rest);
    write_head(own);
    if (!head || strncmp(head, mark, sizeof mark - 1) != 0)
        return ROWS_CUT;
    return strcmp(head, own) == 0 ? ROWS_WHOLE : ROWS_OTHER;
}

/* What is there behind the head is added to rows; false, too, where it is not whole. */
static bool read_row_lines(context *ctx, char *text, run_rows *rows, bool *no_memory)
{
    for (const char *state = cut_line(&text); state; state = cut_line(&text)) {
        run_row row;
        begin_row(&row);
        if (strcmp(state, "end") == 0)
            return rows->count > 0;
        row.failed = strcmp(state, "failed") == 0;
        if (!row.failed && strcmp(state, "finished") != 0)
            return false;
        if (!take_line(&text, row.vessel, sizeof row.vessel) || !take_line(&text, row.reason, sizeof row.reason) ||
            !take_line(&text, row.state_hash, sizeof row.state_hash) || !read_figures(&text, &row) ||
            row.state_hash[strspn(row.state_hash, "0123456789abcdef")])
            return false;
        replace_controls(row.vessel);
        replace_controls(row.reason);
        *no_memory = !array_push(ctx, rows, row);
        if (*no_memory)
            return false;
    }
    return false;
}

fram_status run_rows_read(context *ctx, const char *path, run_rows *rows, row_file *found, fram_error *error)
{
    char *text = NULL;
    size_t size = 0;
    struct stat about;
    bool no_memory = false;
    *found = ROWS_NONE;
    *rows = (run_rows){0};
    if (stat(path, &about) == 0 && !S_ISREG(about.st_mode))
        return file_check(path, error); /* before a run whose row could not be written there */
    if (!file_is_readable(path))
        return FRAM_OK;
    fram_status status = file_read(ctx, path, ROW_FILE_LIMIT, &text, &size, error);
    if (status == FRAM_OK) {
        char *rest = text;
        *found = strlen(text) == size ? read_head(&rest) : ROWS_CUT;
        if (*found == ROWS_WHOLE && !read_row_lines(ctx, rest, rows, &no_memory))
            *found = ROWS_CUT;
    }
    memory_free(ctx, text);
    if (*found != ROWS_WHOLE)
        array_free(ctx, rows);
    return no_memory ? error_memory(error) : status;
}

/* ---- in summary.csv ---- */

void run_row_heads(context *ctx, text_buffer *out)
{
    text_add(ctx, out, ",status");
    for (int i = 0; i < ROW_FIGURES; i++)
        text_format(ctx, out, ",%s[%s]", figures[i].name, figures[i].unit);
    text_add(ctx, out, ",state_hash,reason\n");
}

void run_row_line(context *ctx, const run_row *row, text_buffer *out)
{
    text_add(ctx, out, row->failed ? ",failed" : ",finished");
    for (int i = 0; i < ROW_FIGURES; i++)
        cell_number(ctx, out, row->figure[i]);
    text_format(ctx, out, ",%s", row->state_hash);
    if (row->reason[0])
        cell_quoted(ctx, out, row->reason);
    text_add(ctx, out, row->reason[0] ? "\n" : ",\n");
}
