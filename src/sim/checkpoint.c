#include "sim/checkpoint.h"

#include "fram/version.h"
#include "io/folder.h"
#include "io/path.h"
#include "io/table_file.h"
#include "model/world_check.h"
#include "sim/run_inputs.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { NUMBER_SERIES, NUMBER_RECORD, NUMBER_FRACTURES, NUMBER_HASH, NUMBER_FAILED, NUMBER_COUNT };
enum { BYTES_SCENARIO, BYTES_INPUTS, BYTES_VERSION, BYTES_PEAKS, BYTES_COUNT };
enum { CHECKPOINTS_KEPT = 2 };

/* ---- names ---- */

typedef struct checkpoint_name {
    char text[48];
} checkpoint_name;

static checkpoint_name name_of_step(int64_t step)
{
    checkpoint_name name;
    snprintf(name.text, sizeof name.text, "checkpoint-%012" PRId64 ".fram", step);
    return name;
}

/* The step in "checkpoint-000000001234.fram", or -1: what is read leniently counts where it is written so. */
static int64_t step_of_name(const char *name)
{
    int64_t step = -1;
    if (sscanf(name, "checkpoint-%" SCNd64, &step) != 1 || step < 0)
        return -1;
    return strcmp(name, name_of_step(step).text) == 0 ? step : -1;
}

bool checkpoint_is_name(const char *name) { return step_of_name(name) >= 0; }

static fram_status checkpoint_path(const char *folder, int64_t step, char out[PATH_ROOM], fram_error *error)
{
    return path_join(folder, name_of_step(step).text, out, error);
}

typedef ARRAY(int64_t) step_array;

static int newest_first(const void *a, const void *b)
{
    int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return x < y ? 1 : x > y ? -1 : 0;
}

/* Steps of all checkpoints of a folder, newest first. */
static fram_status list_steps(context *ctx, const char *folder, step_array *steps, fram_error *error)
{
    DIR *dir = opendir(folder);
    if (!dir)
        return FRAM_OK;
    bool good = true;
    int failure = 0;
    for (const char *name = folder_next(dir, &failure); name && good; name = folder_next(dir, &failure)) {
        int64_t step = step_of_name(name);
        if (step >= 0)
            good = array_push(ctx, steps, step);
    }
    closedir(dir);
    if (steps->count > 1)
        qsort(steps->data, (size_t)steps->count, sizeof *steps->data, newest_first);
    if (!good)
        return error_memory(error);
    return failure ? file_error(error, folder, "list the folder", failure) : FRAM_OK;
}

/* What cannot be listed or removed stays, and harms nobody.  false: no memory. */
static bool remove_from(context *ctx, const char *folder, int32_t keep)
{
    step_array steps = {0};
    char path[PATH_ROOM];
    fram_status listed = list_steps(ctx, folder, &steps, NULL);
    if (listed == FRAM_OK) {
        for (int32_t i = keep; i < steps.count; i++) {
            if (checkpoint_path(folder, steps.data[i], path, NULL) == FRAM_OK)
                (void)unlink(path);
        }
    }
    array_free(ctx, &steps);
    return listed != FRAM_ERROR_MEMORY;
}

void checkpoint_remove_all(context *ctx, const char *folder) { (void)remove_from(ctx, folder, 0); }

/* ---- writing ---- */

/* What a file of a state holds. */
typedef struct state_content {
    world_table tables[WORLD_TABLE_COUNT];
    table_file_number numbers[NUMBER_COUNT];
    table_file_bytes bytes[BYTES_COUNT];
    table_file file;
} state_content;

static void content_of(const world *w, const checkpoint_note *note, state_content *c)
{
    world_tables(w, c->tables);
    const table_file_number numbers[NUMBER_COUNT] = {{"series_length", note->series_length},
                                                     {"record_length", note->record_length},
                                                     {"fractures_length", note->fractures_length},
                                                     {"state_hash", world_hash(w)},
                                                     {"failed", note->failed}};
    /* Writing only reads; the container's one struct for both ways has no const. */
    const table_file_bytes bytes[BYTES_COUNT] = {
        {"scenario_hash", (void *)note->scenario_hash, strlen(note->scenario_hash)},
        {"inputs", (void *)note->inputs, strlen(note->inputs)},
        {"fram_version", (void *)FRAM_VERSION, strlen(FRAM_VERSION)},
        {"peaks", note->peaks ? note->peaks->data : NULL, note->peaks ? (size_t)note->peaks->count : 0}};
    memcpy(c->numbers, numbers, sizeof numbers);
    memcpy(c->bytes, bytes, sizeof bytes);
    c->file = (table_file){c->tables, WORLD_TABLE_COUNT, c->numbers, NUMBER_COUNT, c->bytes, BYTES_COUNT, false};
}

static fram_status begin_file(context *ctx, const char *path, const world *w, const checkpoint_note *note,
                              atomic_file *file, fram_error *error)
{
    state_content content;
    content_of(w, note, &content);
    return table_file_begin(ctx, path, &content.file, file, error);
}

fram_status state_encode(context *ctx, const world *w, const checkpoint_note *note, char **data, size_t *size,
                         fram_error *error)
{
    state_content content;
    recorded_table none = {0}; /* a recording begins with all bodies, and the same state has the same bytes without */
    content_of(w, note, &content);
    for (int t = 0; t < WORLD_TABLE_COUNT; t++)
        if (content.tables[t].info == &recorded_table_info)
            content.tables[t].table = &none;
    return table_file_encode(ctx, &content.file, data, size, error);
}

fram_status checkpoint_begin(context *ctx, const char *folder, const world *w, const checkpoint_note *note,
                             file_writer *const *streams, int stream_count, late_commit *commit, fram_error *error)
{
    char path[PATH_ROOM];
    atomic_file file;
    if (checkpoint_path(folder, w->clock.step[0], path, error) != FRAM_OK)
        return FRAM_ERROR_INPUT;
    fram_status status = begin_file(ctx, path, w, note, &file, error);
    return status == FRAM_OK ? late_commit_start(commit, &file, streams, stream_count, error) : status;
}

fram_status checkpoint_end(context *ctx, const char *folder, late_commit *commit, fram_error *error)
{
    if (!commit->pending)
        return FRAM_OK;
    fram_status status = late_commit_wait(commit, error);
    if (status == FRAM_OK && !remove_from(ctx, folder, CHECKPOINTS_KEPT))
        status = error_memory(error);
    return status;
}

fram_status checkpoint_write_failed(context *ctx, const char *folder, const world *w, const checkpoint_note *note,
                                    fram_error *error)
{
    char path[PATH_ROOM];
    if (path_join(folder, "failed.fram", path, error) != FRAM_OK)
        return FRAM_ERROR_INPUT;
    atomic_file file;
    checkpoint_note failed = *note;
    failed.failed = true;
    fram_status status = begin_file(ctx, path, w, &failed, &file, error);
    return status == FRAM_OK ? atomic_file_commit(&file, error) : status;
}

/* ---- reading ---- */

static bool same_text(const table_file_bytes *bytes, const char *text)
{
    /* Empty bytes have no data to compare. */
    return bytes->size == strlen(text) && (bytes->size == 0 || memcmp(bytes->data, text, bytes->size) == 0);
}

static bool copy_bytes(context *ctx, const table_file_bytes *from, byte_array *to)
{
    if (from->size > INT32_MAX || !array_resize(ctx, to, (int32_t)from->size))
        return false;
    if (from->size > 0)
        memcpy(to->data, from->data, from->size);
    return true;
}

/* The first file of a list that has other contents than the one in its place of the list that was found. */
static bool find_changed(const table_file_bytes *found, const char *expected, run_input *out)
{
    run_input before;
    const char *at = found->size > 0 ? found->data : "", *end = at + found->size;
    for (const char *stop = expected + strlen(expected); run_inputs_next(&expected, stop, out);)
        if (!run_inputs_next(&at, end, &before) || strcmp(before.digest, out->digest) != 0)
            return true;
    return false;
}

/* A run goes on with what its checkpoint's list says of the files' contents, wherever they lie now; so does a state
   alone (`alone`), whose expected text is a digest, and the state in a run's checkpoint. */
static fram_status check_inputs(context *ctx, const char *path, const table_file_bytes *found, const char *expected,
                                bool alone, bool *other, fram_error *error)
{
    char digest[SHA256_TEXT_SIZE], wanted[SHA256_TEXT_SIZE];
    fram_error reason = {0};
    if (same_text(found, expected))
        return FRAM_OK;
    fram_status status = run_inputs_digest(ctx, found->data, found->size, digest, &reason);
    if (status == FRAM_ERROR_INPUT)
        return error_set(error, status, path, 0, NULL, "%s", reason.message);
    if (status == FRAM_OK)
        status = run_inputs_digest(ctx, expected, strlen(expected), wanted, &reason);
    if (status != FRAM_OK)
        return error_memory(error);
    bool of_program = !alone && same_text(found, digest);
    if (!of_program && strcmp(digest, wanted) == 0)
        return FRAM_OK;
    *other = true;
    if (alone)
        return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                         "a file that the scenario names was changed since the state was saved; restore it");
    if (of_program)
        return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                         "expected a checkpoint of a run, found a state that a program saved from a world: load it "
                         "into one");
    run_input file;
    bool named = find_changed(found, expected, &file);
    return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                     "a file that the run was started with was changed since%s%.*s; restore it or start a new run",
                     named ? ": " : "", named ? file.path_length : 0, named ? file.path : "");
}

/* That the file is of this version, scenario and inputs; `other` is true when it is sound, but of others. */
static fram_status check_origin(context *ctx, const char *path, const table_file_bytes bytes[BYTES_COUNT],
                                const checkpoint_note *note, bool alone, bool *other, fram_error *error)
{
    if (!same_text(&bytes[BYTES_VERSION], FRAM_VERSION)) {
        *other = true;
        return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "expected a %s of Fram %s, found one of Fram %.*s: %s",
                         alone ? "state" : "checkpoint", FRAM_VERSION, (int)bytes[BYTES_VERSION].size,
                         bytes[BYTES_VERSION].data ? (const char *)bytes[BYTES_VERSION].data : "",
                         alone ? "load it with that version, or bring a world of this one to that state again"
                               : "continue the run with that version, or start it again");
    }
    if (!same_text(&bytes[BYTES_SCENARIO], note->scenario_hash)) {
        *other = true;
        return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                         alone ? "the state belongs to another scenario, or another Fram saved it: load it into a "
                                 "world of the one it is of (scenario.yaml in a run's folder; title and run.duration "
                                 "count, and a program may step beyond its duration), by that Fram"
                               : "the checkpoint belongs to another scenario: scenario.yaml in the folder was "
                                 "changed, or the run was begun by another Fram: restore it, continue with that "
                                 "Fram, or start the run again");
    }
    return check_inputs(ctx, path, &bytes[BYTES_INPUTS], note->inputs, alone, other, error);
}

/* Read one file, or `data` in its place; `other` is true when it is sound but belongs to something else. */
static fram_status read_one(context *ctx, const char *path, const void *data, size_t size, const model *m, world *w,
                            checkpoint_note *note, bool *other, fram_error *error)
{
    world_table tables[WORLD_TABLE_COUNT];
    world_forget(w);
    world_tables(w, tables);
    table_file_number numbers[NUMBER_COUNT] = {
        {"series_length", 0}, {"record_length", 0}, {"fractures_length", 0}, {"state_hash", 0}, {"failed", 0}};
    table_file_bytes bytes[BYTES_COUNT] = {
        {"scenario_hash", NULL, 0}, {"inputs", NULL, 0}, {"fram_version", NULL, 0}, {"peaks", NULL, 0}};
    table_file content = {tables, WORLD_TABLE_COUNT, numbers, NUMBER_COUNT, bytes, BYTES_COUNT, false};
    fram_error unsound = {0};
    fram_status status =
        data ? table_file_decode(ctx, path, data, size, &content, error) : table_file_read(ctx, path, &content, error);
    *other = false;
    note->differs = content.differs;
    if (status != FRAM_OK)
        return status;
    status = check_origin(ctx, path, bytes, note, data, other, error);
    bool failed = numbers[NUMBER_FAILED].value != 0;
    if (status == FRAM_OK &&
        (world_check(m, w, &unsound) != FRAM_OK || (!failed && world_check_numbers(m, w, &unsound) != FRAM_OK)))
        status = error_set(error, FRAM_ERROR_INPUT, path, 0, unsound.key, "%s", unsound.message);
    if (status == FRAM_OK && world_hash(w) != numbers[NUMBER_HASH].value)
        status = error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "the state is not the one that was written");
    if (status == FRAM_OK && !data && failed)
        status =
            error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                      "expected a checkpoint of a run, found the state of a step that failed: load it into a world "
                      "for a look at it");
    if (status == FRAM_OK && note->peaks && !copy_bytes(ctx, &bytes[BYTES_PEAKS], note->peaks))
        status = error_memory(error);
    note->series_length = numbers[NUMBER_SERIES].value;
    note->record_length = numbers[NUMBER_RECORD].value;
    note->fractures_length = numbers[NUMBER_FRACTURES].value;
    note->failed = failed;
    table_file_free_bytes(ctx, &content);
    return status;
}

fram_status state_decode(context *ctx, const char *name, const void *data, size_t size, const model *m, world *w,
                         const checkpoint_note *note, bool *failed, fram_error *error)
{
    checkpoint_note found = *note;
    bool other;
    fram_status status = read_one(ctx, name, data, size, m, w, &found, &other, error);
    *failed = found.failed;
    return status;
}

/* The newest good one that is not after a step; *found says whether there is any not after it, good or bad, *other
   whether one was good, but of another run, input or version. */
static fram_status read_newest(context *ctx, const char *folder, int64_t most, const model *m, world *w,
                               checkpoint_note *note, bool *found, bool *other, fram_error *error)
{
    step_array steps = {0};
    *found = *other = false;
    fram_status status = list_steps(ctx, folder, &steps, error);
    for (int32_t i = 0; i < steps.count && (status == FRAM_OK || *found); i++) {
        char path[PATH_ROOM];
        fram_error reason = {0};
        if (steps.data[i] > most || checkpoint_path(folder, steps.data[i], path, NULL) != FRAM_OK)
            continue;
        *found = true;
        status = read_one(ctx, path, NULL, 0, m, w, note, other, &reason);
        if (error && status != FRAM_OK)
            *error = reason;
        if (status == FRAM_OK || status == FRAM_ERROR_MEMORY || *other)
            break;
        log_write(ctx, LOG_WARNING, "%s: %s; trying the one before", path, reason.message);
    }
    array_free(ctx, &steps);
    return status;
}

fram_status checkpoint_read_newest(context *ctx, const char *folder, const model *m, world *w, checkpoint_note *note,
                                   fram_error *error)
{
    bool found, other;
    fram_status status = read_newest(ctx, folder, INT64_MAX, m, w, note, &found, &other, error);
    if (status != FRAM_OK || found)
        return status;
    return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL,
                     "there is no checkpoint in this folder to resume from: run its scenario again (that of the "
                     "folder into another one), with output.checkpoint_interval over 0 and under the time that it "
                     "reached to have one sooner");
}

fram_status checkpoint_read_before(context *ctx, const char *folder, double time, const model *m, world *w,
                                   checkpoint_note *note, bool *found, fram_error *error)
{
    double steps = floor(time / m->time_step + 1e-6);
    *found = false;
    if (steps < 0)
        return FRAM_OK;
    bool other;
    fram_error reason = {0};
    fram_status status = read_newest(ctx, folder, (int64_t)steps, m, w, note, found, &other, &reason);
    if (status == FRAM_ERROR_INPUT && *found && !other && !note->differs) {
        *found = false;
        return FRAM_OK;
    }
    if (status != FRAM_OK && error)
        *error = reason;
    return status;
}
