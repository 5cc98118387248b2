/* What an output may not be written over: the one rule of all commands, told in docs/results.md. */
#include "cli/cli.h"

#include "fram/live.h"
#include "fram/results.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static const char is_read[] = "names what the command reads; give it a file of its own";

/* The folder that a file is to be made in, and the rest of its name. */
static bool find_place(const char *path, struct stat *folder, const char **name)
{
    char above[PATH_MAX] = ".";
    const char *slash = strrchr(path, '/');
    *name = slash ? slash + 1 : path;
    if (slash && snprintf(above, sizeof above, "%.*s", (int)(*name - path), path) >= (int)sizeof above)
        return false;
    return stat(above, folder) == 0;
}

/* However the names are spelt; of files that are not there yet, whether they would be one. */
static bool is_one_file(const char *a, const char *b)
{
    struct stat one, other;
    const char *name, *other_name;
    bool there = stat(a, &one) == 0, other_there = stat(b, &other) == 0;
    if (strcmp(a, b) == 0)
        return true;
    if (there != other_there)
        return false;
    if (!there && !(find_place(a, &one, &name) && find_place(b, &other, &other_name) && strcmp(name, other_name) == 0))
        return false;
    return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

bool has_ending(const char *path, const char *endings)
{
    const char *dot = strrchr(path, '.');
    size_t length = dot ? strlen(dot + 1) : 0;
    for (const char *e = endings; length > 0 && *e; e += strcspn(e, " ") + (e[strcspn(e, " ")] == ' ')) {
        if (strcspn(e, " ") == length && strncasecmp(e, dot + 1, length) == 0)
            return true;
    }
    return false;
}

/* What goes into a device or a pipe has no kind, nor what goes where the command's own streams go, which a shell may
   have led into a file.  A folder is for the writer to refuse. */
static bool has_no_kind(const char *path)
{
    struct stat about;
    return fram_path_is_stream(path) || (stat(path, &about) == 0 && S_ISDIR(about.st_mode));
}

/* Pictures, pages, videos and tables are of the kind that their name tells.  What the name was expected to be, NULL
   where it is. */
static const char *expected_name(const output_file *o)
{
    static const char *const kinds[][2] = {{PICTURE_ENDINGS, "expected a picture's name that ends in .png or .svg"},
                                           {PAGE_ENDINGS, "expected a page's name that ends in .html or .htm"},
                                           {VIDEO_ENDINGS, "expected a video's name that ends in .mp4"},
                                           {TABLE_ENDINGS, "expected a table's name that ends in .csv"}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds && o->endings && !has_no_kind(o->path); i++)
        if (strcmp(o->endings, kinds[i][0]) == 0 && !has_ending(o->path, o->endings))
            return kinds[i][1];
    return NULL;
}

/* A file with something in it that a name does not tell to be of the kind that is to be written. */
static bool is_of_another_kind(const output_file *o)
{
    struct stat about;
    return o->endings && !has_no_kind(o->path) && stat(o->path, &about) == 0 && about.st_size > 0 &&
           !has_ending(o->path, o->endings);
}

static bool is_for_folder(const output_file *o) { return o->endings && strcmp(o->endings, FOLDER_OUTPUT) == 0; }

/* A folder with something in it, which is to be written into; one that cannot be listed is for the writer to refuse. */
static bool is_filled_folder(const output_file *o)
{
    DIR *folder = is_for_folder(o) ? opendir(o->path) : NULL;
    bool filled = false;
    for (const struct dirent *e; !filled && folder && (e = readdir(folder));)
        filled = strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0;
    if (folder)
        closedir(folder);
    return filled;
}

/* What would be told only when all is computed, and perhaps other files are written. */
static bool is_too_long(const char *path)
{
    struct stat about;
    return lstat(path, &about) != 0 && errno == ENAMETOOLONG;
}

static bool is_input(const command_files *files, const char *path)
{
    for (int i = 0; i < FILES_ROOM; i++) {
        if ((files->inputs[i] && is_one_file(files->inputs[i], path)) || fram_run_has_file(files->runs[i], path))
            return true;
    }
    return false;
}

/* A link in the folder of a run is replaced by the file, wherever it leads. */
static bool is_replaced(const command_files *files, const char *path)
{
    struct stat link, folder, run;
    const char *name;
    bool found = false;
    if (lstat(path, &link) != 0 || !S_ISLNK(link.st_mode) || !find_place(path, &folder, &name))
        return false;
    for (int i = 0; i < FILES_ROOM && !found; i++)
        found = files->runs[i] && stat(files->runs[i], &run) == 0 && run.st_dev == folder.st_dev &&
                run.st_ino == folder.st_ino;
    return found;
}

int refuse_outputs(const common_options *common, const command_files *files)
{
    fram_error error = {0};
    for (int i = 0; i < FILES_ROOM; i++) {
        const output_file *o = &files->outputs[i];
        if (!o->path)
            continue;
        if (is_too_long(o->path))
            return answer_usage(common, o->option, "expected a shorter name: the file system does not take this one");
        if (*o->path && !is_replaced(files, o->path) &&
            fram_path_check_place(o->path, is_for_folder(o), &error) != FRAM_OK)
            return answer_error(common, &error);
        if (is_input(files, o->path))
            return answer_usage(common, o->option, is_read);
        for (int k = 0; k < i; k++) {
            if (files->outputs[k].path && is_one_file(files->outputs[k].path, o->path))
                return answer_usage(common, o->option, "names another output too; give it a file of its own");
        }
        if (expected_name(o))
            return answer_usage(common, o->option, expected_name(o));
        if (!common->force && is_of_another_kind(o))
            return answer_usage(common, o->option,
                                "names a file that is there and, by its name, of another kind; give it another name, "
                                "or write over it with --force");
        if (!common->force && is_filled_folder(o))
            return answer_usage(common, o->option,
                                "names a folder that is not empty; give it another name, or write into it with "
                                "--force");
    }
    return -1;
}

int refuse_scenario_files(const common_options *common, const command_files *files, const fram_scenario *scenario)
{
    const char *input;
    for (int n = 0; (input = fram_scenario_file(scenario, n)) != NULL; n++) {
        for (int i = 0; i < FILES_ROOM; i++) {
            const output_file *o = &files->outputs[i];
            if (o->path && is_one_file(input, o->path))
                return answer_usage(common, o->option, is_read);
        }
    }
    return -1;
}

int refuse_run_folder(const common_options *common, const char *path, const fram_scenario *scenario, const char *folder)
{
    const char *input = path;
    for (int n = 0; input; input = fram_scenario_file(scenario, n++)) {
        if (fram_run_has_file(folder, input))
            return answer_usage(common, "--output",
                                input == path
                                    ? "names a folder in which the run would write over the scenario that it reads; "
                                      "give it a folder of its own"
                                    : "names a folder in which the run would write over a file that its scenario "
                                      "names; give it a folder of its own");
    }
    return -1;
}
