#include "sim/rerun_check.h"

#include "base/number_text.h"
#include "io/csv_read.h"
#include "io/path.h"
#include "io/run_note.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Rows have CSV_DIGITS digits: two numbers that differ by more than this part of them are not the same. */
static const double SAME_PART = 1e-11;
/* Bytes of series.csv that are read at once, about twenty rows. */
enum { READ_AT_ONCE = 1 << 16, WORD_SIZE = 32 };

/* ---- rows ---- */

/* What is left of the part moves to its beginning, and more of the file comes behind it. */
static fram_status read_more(rerun_check *c, fram_error *error)
{
    uint64_t left = c->size - c->offset;
    int32_t kept = c->text.count - c->used, more = left < READ_AT_ONCE ? (int32_t)left : READ_AT_ONCE;
    if (kept > CSV_LINE_MOST)
        return error_set(error, FRAM_ERROR_INPUT, c->path, c->line, NULL, "the row is longer than %d bytes",
                         (int)CSV_LINE_MOST);
    if (kept > 0 && c->text.data)
        memmove(c->text.data, c->text.data + c->used, (size_t)kept);
    c->used = 0;
    if (!array_resize(c->ctx, &c->text, kept + more))
        return error_memory(error);
    fram_status status = file_read_at(c->descriptor, c->path, c->offset, c->text.data + kept, (size_t)more, error);
    c->offset += (uint64_t)more;
    return status;
}

/* The next line; one without its end was cut short and is none. */
static fram_status next_line(rerun_check *c, fram_error *error)
{
    c->row = NULL;
    for (;;) {
        char *begin = c->text.count > c->used ? c->text.data + c->used : NULL;
        char *end = begin ? memchr(begin, '\n', (size_t)(c->text.count - c->used)) : NULL;
        if (end) {
            *end = '\0';
            c->used += (int32_t)(end - begin) + 1;
            c->line++;
            c->row = begin;
            return FRAM_OK;
        }
        if (c->offset >= c->size)
            return FRAM_OK;
        fram_status status = read_more(c, error);
        if (status != FRAM_OK)
            return status;
    }
}

static fram_status next_row(rerun_check *c, fram_error *error)
{
    char *end;
    fram_status status = next_line(c, error);
    if (status == FRAM_OK && c->row)
        c->time = real_read(c->row, &end);
    return status;
}

/* Wall times are never the same. */
static int32_t column_of(const series_layout *l, const char *cell)
{
    size_t length = strcspn(cell, ",[");
    for (int32_t k = 0; k < l->columns.count; k++) {
        const char *name = l->columns.data[k].name;
        if (strlen(name) == length && memcmp(name, cell, length) == 0)
            return strcmp(name, "step_wall_time") == 0 ? -1 : k;
    }
    return -1;
}

static const char *next_cell(const char *cell)
{
    cell += strcspn(cell, ",");
    return *cell ? cell + 1 : NULL;
}

static fram_status read_header(rerun_check *c, fram_error *error)
{
    fram_status status = next_line(c, error);
    for (const char *cell = status == FRAM_OK ? c->row : NULL; cell; cell = next_cell(cell))
        if (!array_push(c->ctx, &c->column, column_of(&c->layout, cell)))
            return error_memory(error);
    return status;
}

static fram_status open_series(context *ctx, const char *folder, rerun_check *c, fram_error *error)
{
    *c = (rerun_check){.ctx = ctx, .folder = folder, .descriptor = -1, .same = -1};
    c->path = memory_array(ctx, PATH_ROOM, 1);
    if (!c->path)
        return error_memory(error);
    fram_status status = path_join(folder, "series.csv", c->path, error);
    return status == FRAM_OK ? file_open_regular(c->path, CSV_BYTES_MOST, &c->descriptor, &c->size, error) : status;
}

fram_status rerun_check_open(context *ctx, const char *folder, const scenario *s, rerun_check *c, fram_error *error)
{
    fram_error reason = {0};
    fram_status status = open_series(ctx, folder, c, &reason);
    if (status == FRAM_ERROR_INPUT) {
        log_write(ctx, LOG_WARNING, "series.csv: %s; whether what is computed again is the run is not known",
                  reason.message);
        return FRAM_OK;
    }
    if (status == FRAM_OK)
        status = series_columns(ctx, s, &c->layout, &reason);
    if (status == FRAM_OK && !array_resize(ctx, &c->value, c->layout.columns.count))
        status = error_memory(&reason);
    if (status == FRAM_OK)
        status = read_header(c, &reason);
    if (status == FRAM_OK)
        status = next_row(c, &reason);
    if (status != FRAM_OK) {
        rerun_check_close(c);
        if (error)
            *error = reason;
    }
    return status;
}

void rerun_check_close(rerun_check *c)
{
    context *ctx = c->ctx;
    if (!ctx)
        return;
    if (c->descriptor >= 0)
        close(c->descriptor);
    memory_free(ctx, c->path);
    array_free(ctx, &c->text);
    series_layout_free(ctx, &c->layout);
    array_free(ctx, &c->value);
    array_free(ctx, &c->column);
    *c = (rerun_check){.descriptor = -1, .same = -1};
}

static bool is_same(double a, double b)
{
    return fabs(a - b) <= SAME_PART * fmax(fabs(a), fabs(b)) || (isnan(a) && isnan(b)) || a == b;
}

/* With all digits of a row: fewer may show one number twice. */
static fram_status tell_difference(const rerun_check *c, int32_t column, double run, fram_error *error)
{
    char before[WORD_SIZE + NUMBER_TEXT_SIZE] = "";
    if (c->same >= 0)
        snprintf(before, sizeof before, "up to t = %g s it is the same; ", c->same);
    return error_set(error, FRAM_ERROR_INPUT, c->path, c->line, c->layout.columns.data[column].name,
                     "at t = %g s it was %.*g in the run and is %.*g when that is computed again from its scenario; "
                     "%sa program told the run what stands in no file, or another Fram made it, or a file was changed",
                     c->time, CSV_DIGITS, run, CSV_DIGITS, c->value.data[column], before);
}

/* What is counted as which mechanism changes no motion: those who read the run's numbers are to know, no more. */
static void warn_of_mechanisms(rerun_check *c, int32_t column)
{
    if (c->told_mechanisms)
        return;
    c->told_mechanisms = true;
    log_write(
        c->ctx, LOG_WARNING,
        "%s:%d: %s is not what is computed again, at t = %g s for the first time, while all but such parts of the "
        "load by mechanism is the same: another Fram, which counted contacts otherwise, made the run, or the file "
        "was changed",
        c->path, (int)c->line, c->layout.columns.data[column].name, c->time);
}

static fram_status check_row(rerun_check *c, const world *w, fram_error *error)
{
    series_row(c->ctx, &c->layout, w, 0, c->value.data);
    const char *cell = c->row;
    int32_t mechanism = -1;
    for (int32_t i = 0; i < c->column.count && cell; i++, cell = next_cell(cell)) {
        char *end;
        int32_t column = c->column.data[i];
        double run = column >= 0 ? real_read(cell, &end) : 0;
        if (column < 0 || is_same(run, c->value.data[column]))
            continue;
        if (!c->layout.names.data[column].of_mechanism)
            return tell_difference(c, column, run, error);
        mechanism = mechanism < 0 ? column : mechanism;
    }
    if (mechanism >= 0)
        warn_of_mechanisms(c, mechanism);
    c->same = w->clock.time[0];
    return FRAM_OK;
}

fram_status rerun_check_step(rerun_check *c, const world *w, fram_error *error)
{
    double now = w->clock.time[0], slack = SAME_PART * now;
    fram_status status = FRAM_OK;
    while (status == FRAM_OK && c->row && c->time < now - slack)
        status = next_row(c, error);
    if (status == FRAM_OK && c->row && c->time <= now + slack)
        status = check_row(c, w, error);
    return status;
}

bool rerun_check_awaits(const rerun_check *c, double time)
{
    return c->row && c->same < time * (1 - SAME_PART) && c->time >= time * (1 - SAME_PART);
}

/* ---- the end ---- */

typedef struct run_end {
    char hash[WORD_SIZE];
    double time, steps; /* steps -1: nothing tells; time -1: neither does the note of a failure */
} run_end;

/* Of a run that came to an end of its own; of one that failed only how far it went; a file that is not there, is
   damaged, or of one that was killed tells nothing. */
static fram_status find_end(context *ctx, const char *folder, run_end *e, fram_error *error)
{
    run_note n;
    fram_status status = run_note_read(ctx, folder, &n, NULL);
    bool ended =
        strcmp(n.status, "finished") == 0 || strcmp(n.status, "stopped") == 0 || strcmp(n.status, "interrupted") == 0;
    *e = (run_end){.steps = -1, .time = -1};
    if (status == FRAM_OK) {
        double time = ended ? n.time : n.good_until;
        e->time = isnan(time) ? -1 : time;
        e->steps = ended && !isnan(n.steps) ? n.steps : -1;
        snprintf(e->hash, sizeof e->hash, "%s", ended ? n.state_hash : "");
    }
    run_note_free(ctx, &n);
    return status == FRAM_ERROR_MEMORY ? error_memory(error) : FRAM_OK;
}

fram_status rerun_check_end(const rerun_check *c, const world *w, double time, fram_error *error)
{
    run_end e;
    char hash[WORD_SIZE];
    if (c->descriptor < 0 || c->same >= time * (1 - SAME_PART))
        return FRAM_OK;
    fram_status status = find_end(c->ctx, c->folder, &e, error);
    if (status != FRAM_OK)
        return status;
    snprintf(hash, sizeof hash, "%016" PRIx64, world_hash(w));
    if ((int64_t)e.steps == w->clock.step[0])
        return strcmp(hash, e.hash) == 0
                   ? FRAM_OK
                   : error_set(error, FRAM_ERROR_INPUT, c->folder, 0, "state_hash",
                               "the run ended in another state than is found when it is computed again from its "
                               "scenario; a program told the run what stands in no file, or another Fram made it");
    log_write(c->ctx, LOG_WARNING,
              "series.csv has no row at t = %g s or later: whether what is computed again is the run is known up to "
              "t = %g s",
              time, fmax(c->same, 0));
    return FRAM_OK;
}

fram_status rerun_run_end(context *ctx, const char *folder, double *time, fram_error *error)
{
    run_end e;
    rerun_check c;
    fram_status status = find_end(ctx, folder, &e, error);
    *time = e.time;
    if (status != FRAM_OK || e.time >= 0)
        return status;
    fram_error reason = {0};
    status = open_series(ctx, folder, &c, &reason);
    if (status == FRAM_OK)
        status = next_line(&c, &reason);
    /* The line of names is no row. */
    if (status == FRAM_OK)
        status = next_row(&c, &reason);
    while (status == FRAM_OK && c.row) {
        *time = c.time;
        status = next_row(&c, &reason);
    }
    rerun_check_close(&c);
    /* Rows that cannot be read tell no end. */
    return status == FRAM_ERROR_MEMORY ? error_memory(error) : FRAM_OK;
}
