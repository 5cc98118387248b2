#include "study/no_answer.h"

#include "io/file.h"
#include "io/run_note.h"
#include "io/text_buffer.h"
#include "study/run_row.h"

#include <errno.h>
#include <locale.h>
#include <stdio.h>
#include <string.h>

/* ---- the disk ---- */

/* What the command fram, which keeps the locale "C", calls an error, whatever the language of this program. */
static void name_fault(int number, char out[128])
{
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    snprintf(out, 128, "%s", plain ? strerror_l(number, plain) : strerror(number));
    if (plain)
        freelocale(plain);
}

/* A fault of the disk that a text names, or of what may be written there, as a cluster limits it; false: none. */
static bool find_fault(const char *text, char name[128])
{
    static const int faults[] = {ENOSPC, EDQUOT, EROFS, EIO, EFBIG, ESTALE};
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        name_fault(faults[i], name);
        if (strstr(text, name))
            return true;
    }
    return false;
}

static fram_status check_disk_in(context *ctx, const char *path, uint64_t limit, fram_error *error)
{
    char *text = NULL, name[128];
    size_t size = 0;
    fram_status status = FRAM_OK;
    if (file_read(ctx, path, limit, &text, &size, NULL) == FRAM_OK && find_fault(text, name))
        status = error_set(error, FRAM_ERROR_IO, path, 0, NULL,
                           "a run could not write: %s; what ended is kept: mend that, and give the same command again",
                           name);
    memory_free(ctx, text);
    return status;
}

static fram_status check_disk(context *ctx, const char *folder, const char *log, fram_error *error)
{
    fram_status status = check_disk_in(ctx, log, RUN_LOG_MOST, error);
    if (status != FRAM_OK)
        return status;
    /* The log lies on the same disk: where that was full the run may have told its own record alone. */
    text_buffer note = {0};
    text_format(ctx, &note, "%s/run.json", folder);
    status = note.failed ? error_memory(error) : check_disk_in(ctx, note.data, RUN_NOTE_MOST, error);
    text_free(ctx, &note);
    return status;
}

/* ---- the program ---- */

/* The last line of a log that is not empty, cut, without control characters; false: it has none. */
static bool last_line(context *ctx, const char *log, char *out, size_t room)
{
    char *text = NULL;
    size_t size = 0;
    out[0] = '\0';
    if (file_read(ctx, log, RUN_LOG_MOST, &text, &size, NULL) == FRAM_OK) {
        while (size > 0 && (unsigned char)text[size - 1] <= ' ')
            text[--size] = '\0';
        const char *line = strrchr(text, '\n');
        snprintf(out, room, "%s", line ? line + 1 : text);
        for (char *c = out; *c; c++)
            *c = (unsigned char)*c < ' ' ? ' ' : *c;
    }
    memory_free(ctx, text);
    return out[0] != '\0';
}

void study_run_why_not_started(context *ctx, const char *log, char out[NO_START_REASON])
{
    if (!last_line(ctx, log, out, NO_START_REASON))
        snprintf(out, NO_START_REASON, "its log says nothing");
}

static fram_status refuse_start(context *ctx, const ended_run *run, fram_error *error)
{
    char said[NO_START_REASON];
    bool far = run->node && *run->node;
    study_run_why_not_started(ctx, run->log, said);
    /* As where the system refuses to start it. */
    return error_set(error, FRAM_ERROR_INPUT, run->log, 0, NULL,
                     "%.150s did not start%s%.60s (exit code %d): %.180s; what ended is kept: mend that, and give the "
                     "same command again",
                     run->program, far ? " on the node " : "", far ? run->node : "", run->exit_code, said);
}

fram_status study_run_check_answer(context *ctx, const ended_run *run, fram_error *error)
{
    return process_not_started(run->exit_code) ? refuse_start(ctx, run, error)
                                               : check_disk(ctx, run->folder, run->log, error);
}
