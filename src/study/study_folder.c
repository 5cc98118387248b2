#include "study/study_folder.h"

#include "base/clock.h"
#include "base/hash.h"
#include "fram/version.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/path.h"
#include "io/run_note.h"
#include "io/scenario_file.h"
#include "io/temporary.h"
#include "sim/run_folder.h"
#include "sim/run_inputs.h"
#include "sim/scene_size.h"
#include "study/processes.h"
#include "study/study_file.h"
#include "study/study_record.h"
#include "study/study_warnings.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* ---- names ---- */

static char *joined(context *ctx, const text_buffer *b) { return b->failed ? NULL : memory_string(ctx, b->data); }

char *study_run_path(const study_folder *f, int32_t condition, int64_t seed, const char *ending)
{
    text_buffer b = {0};
    text_format(f->ctx, &b, "%s/runs/%s/%lld%s", f->path, f->id[condition], (long long)seed, ending);
    char *path = joined(f->ctx, &b);
    text_free(f->ctx, &b);
    return path;
}

char *study_scenario_path(const study_folder *f, int32_t condition)
{
    text_buffer b = {0};
    text_format(f->ctx, &b, "%s/conditions/%s.yaml", f->path, f->id[condition]);
    char *path = joined(f->ctx, &b);
    text_free(f->ctx, &b);
    return path;
}

fram_status study_blocks(const study_folder *f, double **out, fram_error *error)
{
    double *block = memory_array(f->ctx, (size_t)f->s->conditions, sizeof *block);
    fram_status status = block ? FRAM_OK : error_memory(error);
    for (int32_t c = 0; c < f->s->conditions && status == FRAM_OK; c++) {
        const scenario_overrides none = {0};
        scenario one = {0};
        char *path = study_scenario_path(f, c);
        status = path ? scenario_read(f->ctx, path, &none, &one, error) : error_memory(error);
        memory_free(f->ctx, path);
        if (status != FRAM_OK)
            break;
        block[c] = fmax(one.run.duration - one.run.transient, one.run.time_step);
        scenario_free(f->ctx, &one);
    }
    *out = block;
    return status;
}

/* ---- making the folder ---- */

fram_status condition_name_find(context *ctx, const scenario *one, text_buffer *known, condition_name *name,
                                fram_error *error)
{
    char hash[SHA256_TEXT_SIZE] = "";
    text_buffer b = {0};
    *name = (condition_name){.id = ""};
    fram_status status = scenario_hash(ctx, one, name->scenario_hash, error);
    if (status == FRAM_OK)
        status = run_inputs_list(ctx, one, known, &name->files, error);
    if (status != FRAM_OK)
        return status;
    text_format(ctx, &b, "%s %s", FRAM_VERSION, name->scenario_hash);
    /* Of each file the hash: the same files elsewhere are the same input. */
    run_input file;
    const char *at = name->files.data, *end = at + name->files.count;
    while (run_inputs_next(&at, end, &file))
        text_format(ctx, &b, " %s", file.digest);
    if (b.failed)
        status = error_memory(error);
    else
        sha256_text(b.data, (size_t)b.count, hash);
    if (status == FRAM_OK)
        memcpy(name->id, hash, CONDITION_ID - 1);
    text_free(ctx, &b);
    return status;
}

static fram_status name_condition(study_folder *f, int32_t condition, const scenario *one, fram_error *error)
{
    condition_name name;
    fram_status status = condition_name_find(f->ctx, one, &f->inputs, &name, error);
    if (status == FRAM_OK) {
        memcpy(f->id[condition], name.id, CONDITION_ID);
        study_index_row(f, condition, name.scenario_hash, name.files.data);
        f->files[condition] = name.files.count > 0 ? memory_string(f->ctx, name.files.data) : NULL;
        if (name.files.count > 0 && !f->files[condition])
            status = error_memory(error);
    }
    text_free(f->ctx, &name.files);
    return status;
}

/* Removes what programs that were killed were about to put in place: only one study writes here at a time. */
static void sweep(const char *path)
{
    DIR *dir = opendir(path);
    if (!dir)
        return;
    int failure; /* what is not listed stays, and harms nobody */
    for (const char *name = folder_next(dir, &failure); name; name = folder_next(dir, &failure))
        if (temporary_is_name(name))
            (void)unlinkat(dirfd(dir), name, 0);
    closedir(dir);
}

/* A link to a folder, which a run would be made in; one to a file is replaced by the file (path_claim). */
static bool leads_to_folder(DIR *dir, const char *name)
{
    struct stat about;
    return fstatat(dirfd(dir), name, &about, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(about.st_mode) &&
           fstatat(dirfd(dir), name, &about, 0) == 0 && S_ISDIR(about.st_mode);
}

fram_status study_folder_make(context *ctx, const char *path, fram_error *error)
{
    fram_status status = folder_make_own(path, error);
    DIR *dir = status == FRAM_OK ? folder_open_own(path) : NULL;
    int failure;
    for (const char *name = dir ? folder_next(dir, &failure) : NULL; name; name = folder_next(dir, &failure)) {
        if (!leads_to_folder(dir, name))
            continue;
        text_buffer b = {0};
        text_format(ctx, &b, "%s/%s", path, name);
        status = b.failed ? error_memory(error) : folder_refuse_other(b.data, error);
        text_free(ctx, &b);
        break;
    }
    if (dir)
        closedir(dir);
    if (status == FRAM_OK)
        sweep(path);
    return status;
}

static fram_status make_folder(const study_folder *f, const char *name, const char *under, fram_error *error)
{
    text_buffer b = {0};
    text_format(f->ctx, &b, under ? "%s/%s/%s" : "%s/%s", f->path, name, under);
    fram_status status = b.failed ? error_memory(error) : study_folder_make(f->ctx, b.data, error);
    text_free(f->ctx, &b);
    return status;
}

/* Whether the file is there with this text: renaming ten thousand files costs more than reading them. */
static bool holds(context *ctx, const char *path, const text_buffer *text)
{
    char *data = NULL;
    size_t size = 0;
    bool same = access(path, F_OK) == 0 && file_read(ctx, path, (uint64_t)text->count, &data, &size, NULL) == FRAM_OK &&
                size == (size_t)text->count && memcmp(data, text->data, size) == 0;
    memory_free(ctx, data);
    return same;
}

/* The scenario of a condition at seed 0, to be run with other seeds from any folder. */
static fram_status write_condition(study_folder *f, int32_t condition, hull_store *store, study_warnings *warnings,
                                   fram_error *error)
{
    const scenario_print_options options = {.absolute_paths = true};
    scenario one = {0};
    text_buffer text = {0};
    fram_status status = study_scenario(f->ctx, f->s, condition, 0, &one, error);
    if (status != FRAM_OK)
        return status;
    f->run_bytes = fmax(f->run_bytes, scene_size_of(&one).bytes);
    status = name_condition(f, condition, &one, error);
    if (status == FRAM_OK)
        status = scenario_print(f->ctx, &one, &options, &text, error);
    char *path = status == FRAM_OK ? study_scenario_path(f, condition) : NULL;
    if (status == FRAM_OK && !path)
        status = error_memory(error);
    bool fresh = status == FRAM_OK && !holds(f->ctx, path, &text);
    if (fresh)
        status = study_build_check(warnings, condition, &one, store, error);
    else if (status == FRAM_OK)
        study_warnings_pass(warnings, condition, &one);
    if (status == FRAM_OK)
        status = make_folder(f, "runs", f->id[condition], error);
    if (status == FRAM_OK && fresh)
        status = path_claim(path, error);
    if (status == FRAM_OK && fresh)
        status = atomic_file_put(f->ctx, path, text.data, (size_t)text.count, error);
    memory_free(f->ctx, path);
    text_free(f->ctx, &text);
    scenario_free(f->ctx, &one);
    return status;
}

/* A study of another scenario in the folder: nothing that was computed is lost, but the tables are.  The record of the
   study before has the whole path of its scenario, its file only that from where it lay; one that was moved with its
   files has its conditions still. */
static void tell_other(const study_folder *f)
{
    study other;
    char *data = NULL, *whole = study_scenario_whole(f->ctx, f->s);
    size_t size = 0;
    text_buffer path = {0};
    text_format(f->ctx, &path, "%s/effective.yaml", f->path);
    /* What is written differently, or by another version, is of no scenario that can be told. */
    if (whole && !path.failed && file_is_readable(path.data) &&
        file_read(f->ctx, path.data, STUDY_FILE_LIMIT, &data, &size, NULL) == FRAM_OK &&
        study_parse(f->ctx, path.data, data, size, &other, NULL) == FRAM_OK) {
        if (strcmp(other.scenario, whole) != 0 && !study_index_is_within(f))
            log_write(
                f->ctx, LOG_WARNING,
                "%s was of a study of %s: its runs stay, but the tables and the page are of this study now; give the "
                "other one again to have them back",
                f->path, other.scenario);
        study_free(f->ctx, &other);
    }
    memory_free(f->ctx, data);
    text_free(f->ctx, &path);
    memory_free(f->ctx, whole);
}

static fram_status copy_study(const study_folder *f, fram_error *error)
{
    char *data = NULL;
    size_t size = 0;
    text_buffer path = {0};
    text_format(f->ctx, &path, "%s/study.yaml", f->path);
    fram_status status = path.failed ? error_memory(error) : FRAM_OK;
    if (status == FRAM_OK)
        status = file_read(f->ctx, f->s->file, STUDY_FILE_LIMIT, &data, &size, error);
    if (status == FRAM_OK)
        status = path_claim(path.data, error);
    if (status == FRAM_OK)
        status = atomic_file_write(f->ctx, path.data, data, size, error);
    memory_free(f->ctx, data);
    text_free(f->ctx, &path);
    return status;
}

/* A program that is being started holds what its starter held until it is another program: a study that was killed in
   that moment has its folder a little longer than itself. */
#define LOCK_SECONDS 1.0
enum { LOCK_NANOSECONDS = 10000000 };
static fram_status lock_folder(const char *path, int *lock, fram_error *error)
{
    const struct timespec pause = {0, LOCK_NANOSECONDS};
    double began = clock_wall();
    fram_status status = run_folder_lock(path, lock, error);
    while (status == FRAM_ERROR_USAGE && clock_wall() - began < LOCK_SECONDS) {
        nanosleep(&pause, NULL);
        status = run_folder_lock(path, lock, error);
    }
    if (status == FRAM_ERROR_USAGE)
        return error_set(error, status, path, 0, NULL,
                         "another study is writing into this folder; wait for its end, or name another folder");
    return status;
}

static fram_status write_conditions(study_folder *f, fram_error *error)
{
    hull_store store = {.next = 0};
    study_warnings warnings = {.ctx = f->ctx, .s = f->s};
    fram_status status = FRAM_OK;
    for (int32_t c = 0; c < f->s->conditions && status == FRAM_OK; c++) {
        status = work_continue(f->ctx, "looking at the conditions", c, f->s->conditions, error);
        if (status == FRAM_OK)
            status = write_condition(f, c, &store, &warnings, error);
    }
    status = study_warnings_end(&warnings, status, error);
    hull_store_free(f->ctx, &store);
    if (status == FRAM_INTERRUPTED)
        status = error_set(error, status, f->path, 0, NULL,
                           "interrupted before all conditions were looked at; continue with the same command");
    return status;
}

fram_status study_folder_open(context *ctx, const study *s, const char *path, bool dry, study_folder *f,
                              fram_error *error)
{
    char(*id)[CONDITION_ID] = memory_array(ctx, (size_t)s->conditions, CONDITION_ID);
    char **files = memory_array(ctx, (size_t)s->conditions, sizeof *files);
    *f = (study_folder){.ctx = ctx, .s = s, .path = path, .id = id, .files = files, .lock = -1};
    study_index_heads(f);
    fram_status status = id && files ? study_folder_check(ctx, s, path, error) : error_memory(error);
    if (status == FRAM_OK)
        status = run_folder_make(path, error);
    if (status == FRAM_OK)
        status = lock_folder(path, &f->lock, error);
    bool stays = status == FRAM_OK && dry && study_record_is_there(path);
    if (status == FRAM_OK)
        sweep(path);
    if (status == FRAM_OK && !stays)
        status = copy_study(f, error);
    if (status == FRAM_OK)
        status = make_folder(f, "conditions", NULL, error);
    if (status == FRAM_OK)
        status = make_folder(f, "runs", NULL, error);
    if (status == FRAM_OK)
        status = write_conditions(f, error);
    if (status == FRAM_OK)
        status = study_folder_check_inputs(f, error);
    if (status == FRAM_OK && !stays) {
        tell_other(f);
        status = study_record_write(f, error);
    }
    text_free(ctx, &f->index);
    text_free(ctx, &f->inputs);
    if (status != FRAM_OK)
        study_folder_close(f);
    return status;
}

void study_folder_close(study_folder *f)
{
    run_folder_unlock(f->lock);
    f->lock = -1;
    for (int32_t c = 0; f->files && c < f->s->conditions; c++)
        memory_free(f->ctx, f->files[c]);
    memory_free(f->ctx, f->files);
    memory_free(f->ctx, f->id);
    f->files = NULL;
    f->id = NULL;
}

fram_status study_interrupted(fram_error *error)
{
    return error_set(error, FRAM_INTERRUPTED, NULL, 0, NULL,
                     "interrupted; what ended is kept, continue with the same command");
}

int study_folder_jobs(const study_folder *f, int jobs)
{
    if (jobs > 0)
        return jobs;
    int cores = processes_cores();
    double memory = processes_memory();
    int fit = processes_that_fit(cores, memory, f->run_bytes);
    if (fit < cores)
        log_write(f->ctx, LOG_WARNING,
                  "%d of %d cores: a run takes about %.2g GB, and %.2g GB of memory are free; "
                  "a number of jobs that is given takes more",
                  fit, cores, f->run_bytes * 1e-9, memory * 1e-9);
    return fit;
}

/* ---- what stays of a run ---- */

/* All files of a folder but those named, and the folder when it is empty then. */
static void remove_but(context *ctx, const char *folder, const char *const *kept, int32_t count)
{
    DIR *dir = folder_open_own(folder);
    if (!dir)
        return;
    int failure; /* what is not listed stays */
    for (const char *name = folder_next(dir, &failure); name; name = folder_next(dir, &failure)) {
        bool keep = false;
        for (int32_t i = 0; i < count; i++)
            keep = keep || strcmp(name, kept[i]) == 0;
        text_buffer path = {0};
        text_format(ctx, &path, "%s/%s", folder, name);
        struct stat state;
        if (!keep && !path.failed && lstat(path.data, &state) == 0) {
            /* Pictures and chunks of a page stand in folders of their own. */
            if (S_ISDIR(state.st_mode))
                remove_but(ctx, path.data, NULL, 0);
            else
                (void)unlink(path.data);
        }
        text_free(ctx, &path);
    }
    closedir(dir);
    (void)rmdir(folder);
}

void study_run_finish(const study_folder *f, int32_t condition, int64_t seed, study_keep keep)
{
    static const char *const series[] = {"scenario.yaml", "run.json", "series.csv", "fractures.csv"};
    char *log = study_run_path(f, condition, seed, ".log"), *folder = study_run_path(f, condition, seed, "");
    /* A study that was killed in here finds the log, and goes on. */
    if (log && folder && access(log, F_OK) == 0) {
        if (keep != KEEP_ALL)
            remove_but(f->ctx, folder, series, keep == KEEP_SERIES ? 4 : 0);
        (void)unlink(log);
    }
    memory_free(f->ctx, log);
    memory_free(f->ctx, folder);
}

/* The lock of a run's folder, for run_folder_unlock; -1 where there is no folder, or *busy. */
static fram_status lock_run(const char *folder, int *lock, bool *busy, fram_error *error)
{
    *lock = -1;
    *busy = false;
    if (access(folder, F_OK) != 0)
        return FRAM_OK;
    fram_status status = run_folder_lock(folder, lock, error);
    *busy = status == FRAM_ERROR_USAGE;
    return *busy ? FRAM_OK : status;
}

/* The folder goes while it is locked: a program that begins to write there meets that. */
static fram_status remove_unheld(context *ctx, const char *folder, bool *busy, fram_error *error)
{
    int lock;
    fram_status status = lock_run(folder, &lock, busy, error);
    if (lock >= 0)
        remove_but(ctx, folder, NULL, 0);
    run_folder_unlock(lock);
    return status;
}

fram_status study_run_forget(context *ctx, const char *folder, bool anew, bool *busy, fram_error *error)
{
    /* The row goes last: while it is there a call that goes on behind one that was killed in here does this again. */
    static const char *const endings[] = {".exit", ".row"};
    *busy = false;
    fram_status status = anew ? remove_unheld(ctx, folder, busy, error) : FRAM_OK;
    for (int i = 0; i < 2 && status == FRAM_OK && !*busy; i++) {
        text_buffer path = {0};
        text_format(ctx, &path, "%s%s", folder, endings[i]);
        if (path.failed)
            status = error_memory(error);
        else
            (void)unlink(path.data);
        text_free(ctx, &path);
    }
    return status;
}

bool study_run_has_kept(const study_folder *f, int32_t condition, int64_t seed, study_keep keep)
{
    static const char *const last[] = {
        [KEEP_SUMMARY] = ".row", [KEEP_SERIES] = "/series.csv", [KEEP_ALL] = "/peaks.fram"};
    char *path = study_run_path(f, condition, seed, last[keep]);
    bool kept = path && access(path, F_OK) == 0;
    memory_free(f->ctx, path);
    return kept;
}

fram_status study_run_check_files(const study_folder *f, int32_t condition, const char *folder, fram_error *error)
{
    char *text = NULL;
    run_input file;
    const char *at = f->files[condition];
    if (!at || !run_note_is_there(folder))
        return FRAM_OK;
    fram_status status = run_note_load(f->ctx, folder, &text, error);
    for (const char *end = at + strlen(at); status == FRAM_OK && run_inputs_next(&at, end, &file);)
        if (!run_note_mentions(text, file.digest))
            status = error_set(error, FRAM_ERROR_INPUT, folder, 0, "inputs",
                               "%.*s was changed while the study ran; what ended before is kept: restore the file, or "
                               "have all runs made of what it is now, and give the same command again",
                               file.path_length, file.path);
    memory_free(f->ctx, text);
    return status;
}

fram_status study_folder_busy(const char *folder, bool *busy, fram_error *error)
{
    int lock;
    fram_status status = lock_run(folder, &lock, busy, error);
    run_folder_unlock(lock);
    return status;
}

fram_status study_run_met_another(context *ctx, const char *folder, const char *log, bool *met, fram_error *error)
{
    char *text = NULL;
    size_t size = 0;
    fram_status status = study_folder_busy(folder, met, error);
    if (status == FRAM_OK && !*met && file_read(ctx, log, RUN_LOG_MOST, &text, &size, NULL) == FRAM_OK)
        *met = strstr(text, RUN_FOLDER_TAKEN) != NULL;
    memory_free(ctx, text);
    return status;
}
