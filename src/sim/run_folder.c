#include "sim/run_folder.h"

#include "io/file.h"
#include "io/folder.h"
#include "io/path.h"
#include "io/run_files.h"
#include "io/run_note.h"
#include "io/temporary.h"
#include "sim/checkpoint.h"
#include "sim/run_inputs.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- folder ---- */

fram_status run_folder_make(const char *folder, fram_error *error)
{
    char path[PATH_ROOM];
    size_t length = strlen(folder);
    if (length == 0 || length >= sizeof path)
        return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL, "the folder's name is empty or too long");
    memcpy(path, folder, length + 1);
    for (size_t i = 1; i <= length; i++) {
        if (path[i] != '/' && path[i] != '\0')
            continue;
        char keep = path[i];
        path[i] = '\0';
        if (mkdir(path, 0777) != 0 && errno != EEXIST)
            return file_error(error, path, "make the folder", errno);
        path[i] = keep;
    }
    return FRAM_OK;
}

/* The run's scenario is read again, by a resume and by reports, and its path is a text of a scenario. */
static fram_status check_length(const char *folder, fram_error *error)
{
    static const char name[] = "/scenario.yaml";
    size_t most = SCENARIO_TEXT_SIZE - sizeof name;
    if (strlen(folder) <= most)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, folder, 0, "folder", "expected a name of at most %zu bytes, found %zu",
                     most, strlen(folder));
}

/* Whether files can be written into the folder or, when it is not there, it can be made in the nearest one that is. */
static fram_status can_be_written(const char *folder, fram_error *error)
{
    char path[PATH_ROOM];
    if (snprintf(path, sizeof path, "%s", folder) >= PATH_ROOM)
        return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL, "the folder's name is too long");
    while (access(path, W_OK | X_OK) != 0) {
        int found = errno;
        struct stat about;
        if (found == ENOENT && lstat(path, &about) == 0)
            return file_place_error(error, folder, "make the folder", found); /* a link that leads nowhere */
        char *slash = strrchr(path, '/');
        if (found != ENOENT || strcmp(path, ".") == 0 || strcmp(path, "/") == 0)
            return file_error(error, path, "write into the folder", found);
        if (!slash)
            memcpy(path, ".", 2);
        else
            slash[slash == path] = '\0'; /* the root's name is the slash */
    }
    return FRAM_OK;
}

fram_status run_folder_check(const char *folder, bool force, fram_error *error)
{
    bool empty = true;
    fram_status status = check_length(folder, error);
    if (status == FRAM_OK)
        status = folder_is_empty(folder, &empty, error);
    if (status == FRAM_OK && (empty || force))
        status = can_be_written(folder, error);
    if (status != FRAM_OK || empty || force)
        return status;
    return folder_refuse(folder, error);
}

/* A file of results that there is for each of several vessels: "loads-NAME.png". */
static bool is_of_vessel(const char *name)
{
    static const char *const kinds[][2] = {{"loads-", ".png"}, {"station-", ".png"}, {"station-", ".json"}};
    size_t size = strlen(name);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        size_t begin = strlen(kinds[i][0]), end = strlen(kinds[i][1]);
        if (size > begin + end && strncmp(name, kinds[i][0], begin) == 0 && strcmp(name + size - end, kinds[i][1]) == 0)
            return true;
    }
    return false;
}

/* A plan that a run draws every output.picture_interval. */
static bool is_numbered_plan(const char *name)
{
    size_t size = strlen(name);
    return size > 9 && strncmp(name, "plan-", 5) == 0 && strcmp(name + size - 4, ".png") == 0;
}

/* Files of an export for ParaView, of a page's frames and of a video's pictures, each in a folder of its own. */
static bool is_vtk_frame(const char *name)
{
    return name_is_numbered(name, "floes_", 6, ".vtp") || name_is_numbered(name, "hull_", 6, ".vtp") ||
           name_is_numbered(name, "forces_", 6, ".vtp");
}
static bool is_vtk_list(const char *name)
{
    static const char *const names[] = {"run.pvd", "floes.pvd", "hull.pvd", "forces.pvd"};
    bool found = false;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        found = found || strcmp(name, names[i]) == 0;
    return found;
}
static bool is_page_frame(const char *name) { return name_is_numbered(name, "", 4, ".js"); }
static bool is_video_frame(const char *name) { return name_is_numbered(name, "frame-", 6, ".png"); }

/* The ice at one time: "field-12.5.geojson". */
static bool is_field(const char *name)
{
    static const char begin[] = "field-", end[] = ".geojson";
    size_t size = strlen(name), around = sizeof begin + sizeof end - 2;
    return size > around && strncmp(name, begin, sizeof begin - 1) == 0 &&
           strcmp(name + size - (sizeof end - 1), end) == 0 &&
           strspn(name + sizeof begin - 1, "0123456789.e+-") >= size - around;
}

/* What run.json and the record of any version begin with. */
#define SUMMARY_BEGINS "{\n  \"fram_version\": "
#define RECORD_BEGINS "FRAMREC\n"

static run_file_end end_of(const char *name)
{
    const run_file *file = run_file_find(name);
    return file ? file->end : RUN_FILE_STAYS;
}

static bool is_summary(const char *name) { return end_of(name) == RUN_FILE_GOES_FIRST; }
static bool is_stream(const char *name) { return end_of(name) == RUN_FILE_GOES_LAST; }
/* All others that a run, or what is made of it, leaves in its folder. */
static bool is_result(const char *name)
{
    return end_of(name) == RUN_FILE_GOES || is_of_vessel(name) || is_field(name);
}

/* What is made of a run, in its folder or one inside. */
typedef struct result_part {
    const char *folder;
    bool (*is_such)(const char *name);
    bool goes;       /* the folder, when nothing else is in it */
    bool links_stay; /* as to a larger disk: what they lead to is emptied when the run begins */
} result_part;

static void remove_part(const char *folder, const result_part *part, const char *inputs)
{
    DIR *dir = folder_open_own(folder);
    struct stat about;
    int failure;
    for (const char *name = dir ? folder_next(dir, &failure) : NULL; name; name = folder_next(dir, &failure)) {
        char path[PATH_ROOM];
        if (part->is_such(name) && path_join(folder, name, path, NULL) == FRAM_OK && lstat(path, &about) == 0 &&
            (S_ISREG(about.st_mode) || !part->links_stay) && !run_inputs_has(inputs, path))
            (void)unlink(path);
    }
    if (dir)
        closedir(dir);
    if (dir && part->goes)
        (void)rmdir(folder);
}

/* Whether no folder on the way from the run's to the part's is a link, which may lead anywhere. */
static bool is_reached(const char *folder, char *part)
{
    bool reached = true;
    for (char *at = strchr(part + strlen(folder) + 1, '/'); at && reached; at = strchr(at + 1, '/')) {
        *at = '\0';
        reached = folder_refuse_other(part, NULL) == FRAM_OK;
        *at = '/';
    }
    return reached;
}

/* Results of the run before: next to the files of a new one that stops before it has written its own, or never writes
   such, they would be taken for its own.  First of all how that run ended; last its record, by which the folder of a
   run is known. */
static void remove_results(const char *folder, const char *inputs)
{
    static const result_part parts[] = {{".", is_summary, false, false},
                                        {".", is_result, false, false},
                                        {"vtk/data", is_vtk_frame, true, false},
                                        {"vtk", is_vtk_list, true, false},
                                        {"playback-frames", is_page_frame, true, false},
                                        {"video", is_video_frame, true, false},
                                        {"pictures", is_numbered_plan, false, false},
                                        {".", is_stream, false, true}};
    char path[PATH_ROOM];
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (path_join(folder, parts[i].folder, path, NULL) == FRAM_OK && is_reached(folder, path))
            remove_part(path, &parts[i], inputs);
    }
}

/* Whether there was a run in the folder: other files in it, whatever their names, are nobody's results. */
static bool has_run(const char *folder)
{
    bool found = folder_file_begins(folder, "run.json", SUMMARY_BEGINS) ||
                 folder_file_begins(folder, "record.fram", RECORD_BEGINS);
    DIR *dir = opendir(folder);
    int failure;
    for (const char *name = dir ? folder_next(dir, &failure) : NULL; name; name = folder_next(dir, &failure))
        found = found || checkpoint_is_name(name);
    if (dir)
        closedir(dir);
    return found;
}

/* What a run writes over, however it ends. */
static bool is_written(const char *name)
{
    const run_file *file = run_file_find(name);
    return (file && file->written) || is_of_vessel(name) || checkpoint_is_name(name);
}

fram_status run_folder_refuse_inputs(const char *folder, const char *inputs, fram_error *error)
{
    return run_inputs_refuse(inputs, folder, is_written, error);
}

static fram_status refuse_pipes(const char *folder, bool (*is_such)(const char *name), fram_error *error)
{
    char path[PATH_ROOM];
    struct stat about;
    int failure;
    fram_status status = FRAM_OK;
    DIR *dir = opendir(folder);
    for (const char *name = dir ? folder_next(dir, &failure) : NULL; name && status == FRAM_OK;
         name = folder_next(dir, &failure))
        if (is_such(name) && path_join(folder, name, path, NULL) == FRAM_OK && stat(path, &about) == 0 &&
            S_ISFIFO(about.st_mode))
            status = file_check(path, error);
    if (dir)
        closedir(dir);
    return status;
}

fram_status run_folder_refuse_pipes(const char *folder, fram_error *error)
{
    char pictures[PATH_ROOM];
    fram_status status = refuse_pipes(folder, is_written, error);
    if (status == FRAM_OK && path_join(folder, "pictures", pictures, NULL) == FRAM_OK)
        status = refuse_pipes(pictures, is_numbered_plan, error);
    return status;
}

/* A file that a run writes in one go: where a run was killed, its temporary file stays. */
static bool is_leftover(const char *name)
{
    const run_file *file;
    if (strcmp(name, "peaks.fram.new") == 0) /* of older versions */
        return true;
    for (int32_t i = 0; (file = run_file_at(i)) != NULL; i++) {
        if (file->in_one_go && temporary_is_of(name, file->name))
            return true;
    }
    static const char *const kinds[] = {".fram.", ".png.", ".json."};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        char base[64];
        const char *dot = strstr(name, kinds[i]);
        int length = dot ? (int)(dot - name + (ptrdiff_t)strlen(kinds[i])) - 1 : 0;
        if (length <= 0 || length >= (int)sizeof base)
            continue;
        snprintf(base, sizeof base, "%.*s", length, name);
        if ((checkpoint_is_name(base) || is_of_vessel(base)) && temporary_is_of(name, base))
            return true;
    }
    return false;
}

fram_status run_folder_lock(const char *folder, int *lock, fram_error *error)
{
    *lock = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (*lock < 0)
        return file_error(error, folder, "open the folder", errno);
    if (flock(*lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) {
        char inside[PATH_ROOM]; /* the run's folder, where its name is that of a link */
        if (path_join(folder, ".", inside, NULL) == FRAM_OK)
            folder_remove_files(inside, is_leftover);
        return FRAM_OK;
    }
    run_folder_unlock(*lock);
    *lock = -1;
    return error_set(error, FRAM_ERROR_USAGE, folder, 0, NULL,
                     RUN_FOLDER_TAKEN "; wait for its end, or name another folder");
}

void run_folder_unlock(int lock)
{
    if (lock >= 0)
        close(lock);
}

fram_status run_folder_prepare(context *ctx, const char *folder, bool force, const char *inputs, int *lock,
                               fram_error *error)
{
    fram_status status = run_folder_make(folder, error);
    if (status == FRAM_OK)
        status = run_folder_lock(folder, lock, error);
    if (status == FRAM_OK)
        status = run_folder_check(folder, force, error);
    if (status != FRAM_OK)
        return status;
    if (has_run(folder)) {
        checkpoint_remove_all(ctx, folder);
        remove_results(folder, inputs ? inputs : "");
    }
    return FRAM_OK;
}

fram_status run_folder_unchanged(context *ctx, const char *folder, const char *scenario_hash, const char *inputs,
                                 fram_error *error)
{
    char *text = NULL;
    run_input file;
    fram_status status = run_note_load(ctx, folder, &text, error);
    if (status == FRAM_OK && !run_note_mentions(text, scenario_hash))
        status = error_set(error, FRAM_ERROR_INPUT, folder, 0, "scenario.yaml",
                           "was changed since the run was made, or is read by another version of Fram: restore it or "
                           "make the run again");
    for (const char *end = inputs + strlen(inputs); status == FRAM_OK && run_inputs_next(&inputs, end, &file);) {
        if (!run_note_mentions(text, file.digest))
            status = error_set(error, FRAM_ERROR_INPUT, folder, 0, "inputs",
                               "%.*s was changed since the run was made; restore it or make the run again",
                               file.path_length, file.path);
    }
    memory_free(ctx, text);
    return status;
}

fram_status run_folder_recorded_from(context *ctx, const char *folder, double *time, fram_error *error)
{
    run_note n;
    fram_status status = run_note_read(ctx, folder, &n, NULL);
    *time = status == FRAM_OK ? n.recorded_from : -1;
    run_note_free(ctx, &n);
    return status == FRAM_ERROR_MEMORY ? error_memory(error) : FRAM_OK;
}
