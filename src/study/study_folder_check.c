/* What a study may write into: a folder that is empty or a study's, in which no file stands that it reads. */
#include "study/study_folder.h"

#include "io/file.h"
#include "io/folder.h"
#include "io/path.h"
#include "io/temporary.h"
#include "sim/run_folder.h"
#include "sim/run_inputs.h"
#include "study/study_file.h"
#include "study/study_record.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* ---- whose the folder is ---- */

static bool holds_only(const char *path, bool (*is_such)(const char *name))
{
    DIR *dir = opendir(path);
    bool only = dir != NULL;
    int failure = 0;
    for (const char *name = dir ? folder_next(dir, &failure) : NULL; name && only; name = folder_next(dir, &failure))
        only = is_such(name);
    if (dir)
        closedir(dir);
    return only && failure == 0;
}

/* A study that was killed while it wrote its first file left a part of that; one that has just begun has it there for a
   moment.  Which of them it is shows when the folder is locked: then it is swept. */
static bool is_first_part(const char *name) { return temporary_is_of(name, "study.yaml"); }

static bool is_of_beginning(const char *name)
{
    return strcmp(name, "study.yaml") == 0 || strcmp(name, "conditions") == 0 || strcmp(name, "runs") == 0 ||
           temporary_is_name(name);
}

static bool has_folder(const char *path, const char *name)
{
    char folder[PATH_ROOM];
    struct stat about;
    return path_join(path, name, folder, NULL) == FRAM_OK && stat(folder, &about) == 0 && S_ISDIR(about.st_mode);
}

/* Whether the file is another one with the same text. */
static bool is_copy(context *ctx, const char *path, const char *of)
{
    char *data[2] = {NULL, NULL};
    size_t size[2] = {0, 0};
    bool same = !path_is_same(path, of) &&
                file_read(ctx, path, STUDY_FILE_LIMIT, &data[0], &size[0], NULL) == FRAM_OK &&
                file_read(ctx, of, STUDY_FILE_LIMIT, &data[1], &size[1], NULL) == FRAM_OK && size[0] == size[1] &&
                memcmp(data[0], data[1], size[0]) == 0;
    memory_free(ctx, data[0]);
    memory_free(ctx, data[1]);
    return same;
}

/* A study that ended before its record was there, killed or refused in one of its conditions: nothing but what it makes
   first, and either both folders or, without them, a copy of the study file. */
static bool has_begun(context *ctx, const study *s, const char *path)
{
    char first[PATH_ROOM];
    return holds_only(path, is_of_beginning) && path_join(path, "study.yaml", first, NULL) == FRAM_OK &&
           file_is_readable(first) &&
           ((has_folder(path, "conditions") && has_folder(path, "runs")) || is_copy(ctx, first, s->file));
}

/* A file study.yaml alone may be somebody's own.  In this order, since a study that begins puts its record in place
   when all else is there. */
static bool is_of_study(context *ctx, const study *s, const char *path)
{
    return has_begun(ctx, s, path) || study_record_is_there(path);
}

static fram_status check_whose(context *ctx, const study *s, const char *path, fram_error *error)
{
    if (is_of_study(ctx, s, path))
        return FRAM_OK;
    fram_status status = run_folder_check(path, holds_only(path, is_first_part), error);
    /* Another study that begins may have made folder and file between these looks. */
    if (status == FRAM_ERROR_USAGE && (holds_only(path, is_first_part) || is_of_study(ctx, s, path)))
        return FRAM_OK;
    if (status == FRAM_ERROR_USAGE)
        return error_set(error, status, path, 0, NULL,
                         "the folder holds something else than a study; name another one");
    return status;
}

/* ---- what is read ---- */

/* The first two may be what is read as the study: both are the study that the folder is of. */
static const char *const written[] = {"study.yaml",     "effective.yaml",  "index.csv",       "summary.csv",
                                      "conditions.csv", "station.csv",     "differences.csv", "extremes.csv",
                                      "annual.csv",     "sensitivity.csv", "study.nc",        "study.html"};
enum { WRITTEN = sizeof written / sizeof *written, STUDY_ITSELF = 2 };

/* first: the first of the names above that the file must not have. */
static fram_status refuse_read(const char *folder, const char *path, int first, fram_error *error)
{
    char own[PATH_ROOM];
    for (int i = first; i < WRITTEN; i++)
        if (path_join(folder, written[i], own, NULL) == FRAM_OK && path_is_same(path, own))
            return error_set(error, FRAM_ERROR_USAGE, path, 0, NULL,
                             "the study reads this file and would write its own %s over it; name another folder",
                             written[i]);
    return FRAM_OK;
}

fram_status study_folder_check(context *ctx, const study *s, const char *path, fram_error *error)
{
    fram_status status = check_whose(ctx, s, path, error);
    if (status == FRAM_OK)
        status = refuse_read(path, s->file, STUDY_ITSELF, error);
    if (status == FRAM_OK)
        status = refuse_read(path, s->scenario, 0, error);
    return status == FRAM_OK && s->table ? refuse_read(path, s->table, 0, error) : status;
}

fram_status study_folder_check_inputs(const study_folder *f, fram_error *error)
{
    char path[PATH_ROOM];
    run_input file;
    fram_status status = FRAM_OK;
    const char *at = f->inputs.count > 0 ? f->inputs.data : "", *end = at + f->inputs.count;
    while (status == FRAM_OK && run_inputs_next(&at, end, &file)) {
        snprintf(path, sizeof path, "%.*s", file.path_length, file.path);
        status = refuse_read(f->path, path, 0, error);
    }
    return status;
}
