/* Answers of the command: errors for people and programs, and a JSON writer for flat results. */
#include "cli/cli.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int exit_code_of(fram_status status)
{
    switch (status) {
    case FRAM_OK:
        return EXIT_GOOD;
    case FRAM_ERROR_USAGE:
    case FRAM_ERROR_INPUT:
        return EXIT_BAD_INPUT;
    case FRAM_INTERRUPTED:
        return EXIT_INTERRUPTED;
    default:
        return EXIT_RUN_FAILED;
    }
}

/* The library names what its caller gave by the names of its headers; here they were options: "speed_step" was
   --speed-step, an angle that is radians there ends in -deg, and these have other names. */
static const struct {
    const char *key, *option;
} other_names[] = {
    {"folder", "--output"},          {"probability", "--level"},
    {"poisson_ratio", "--nu"},       {"seal_width", "--seal"},
    {"slopes", "--slope"},           {"frames_per_second", "--fps"},
    {"smallest_area", "--smallest"}, {"slurm_partition", "--partition"},
    {"slurm_time", "--time"},        {"slurm_options", "--sbatch"},
    {"slurm_poll", "--poll"},        {"slurm_runs_per_task", "--runs-per-task"},
    {"time_step", "--dt"},           {"most", "--pieces"},
};

/* Whether an option, "--stem-angle-deg", has the name of a member, "stem_angle". */
static bool is_option_of(const char *option, const char *key)
{
    const char *o = option + strlen("--");
    for (; *key && *o; o++, key++) {
        if (*key != *o && !(*key == '_' && *o == '-'))
            return false;
    }
    return !*key && (!*o || strcmp(o, "-deg") == 0);
}

/* The option of this command that the key stands for; NULL: none. */
static const char *option_of(const common_options *common, const char *key)
{
    const char *wanted = NULL;
    for (size_t i = 0; i < sizeof other_names / sizeof *other_names; i++)
        wanted = strcmp(other_names[i].key, key) == 0 ? other_names[i].option : wanted;
    for (const char *const *option = common->option; *key && *option; option++) {
        if (wanted ? strcmp(*option, wanted) == 0 : is_option_of(*option, key))
            return *option;
    }
    return NULL;
}

static bool is_folder(const char *path)
{
    struct stat state;
    return stat(path, &state) == 0 && S_ISDIR(state.st_mode);
}

static fram_error in_words_of_command(const common_options *common, const fram_error *error)
{
    fram_error e = *error;
    /* At a line of a file it is a column or a key of that, and `vessel` of a file is the section of a scenario; of the
       folder of a run it is the one that was asked for. */
    bool of_scenario = error->file[0] && !is_folder(error->file) && strcmp(error->key, "vessel") == 0;
    bool of_file = error->line > 0 || of_scenario;
    const char *option = of_file ? NULL : option_of(common, error->key);
    if (option)
        snprintf(e.key, sizeof e.key, "%s", option);
    if (strcmp(error->file, "(override)") == 0)
        snprintf(e.file, sizeof e.file, "--set");
    /* Of one that is not empty; a file in it that the command reads is never written over. */
    if (error->status == FRAM_ERROR_USAGE && strcmp(error->key, "folder") == 0 && is_folder(error->file))
        snprintf(e.message, sizeof e.message, "%.480s (--force)", error->message);
    return e;
}

static void print_error_for_people(const fram_error *e)
{
    terminal_clear();
    fputs("fram: ", stderr);
    if (e->file[0]) {
        tell(stderr, "%s", e->file);
        if (e->line > 0)
            fprintf(stderr, ":%d", e->line);
        if (e->line > 0 && e->column > 0)
            fprintf(stderr, ":%d", e->column);
        fputs(": ", stderr);
    }
    if (e->key[0])
        tell(stderr, "%s: ", e->key);
    tell(stderr, "%s\n", e->message);
}

int answer_error(const common_options *common, const fram_error *error)
{
    const fram_error told = in_words_of_command(common, error);
    error = &told;
    print_error_for_people(error);
    if (common->json) {
        json j = json_begin();
        json_open(&j, "error");
        json_text(&j, "status", fram_status_name(error->status));
        json_text(&j, "file", error->file);
        json_integer(&j, "line", error->line);
        json_integer(&j, "column", error->column);
        json_text(&j, "key", error->key);
        json_text(&j, "message", error->message);
        json_close(&j);
        json_end(&j);
    }
    return exit_code_of(error->status);
}

int answer_memory(const common_options *common)
{
    return answer_error(common, &(fram_error){.status = FRAM_ERROR_MEMORY, .message = "not enough memory"});
}

int answer_usage(const common_options *common, const char *key, const char *message)
{
    fram_error error = {.status = FRAM_ERROR_USAGE};
    snprintf(error.key, sizeof error.key, "%s", key);
    snprintf(error.message, sizeof error.message, "%s", message);
    return answer_error(common, &error);
}

json json_begin(void)
{
    json j = {stdout, true};
    fputc('{', j.file);
    return j;
}

void json_end(json *j)
{
    fputs("}\n", j->file);
    fflush(j->file);
}

/* JSON is UTF-8, names of files are any bytes: others than UTF-8 become the replacement character.  What would act on a
   terminal (control_code) is escaped, which to a program is the same. */
static void quoted(FILE *file, const char *text)
{
    fputc('"', file);
    while (*text) {
        int length = utf8_sequence(text), code = length > 0 ? control_code(text) : 0;
        if (length == 0)
            fputs("\\ufffd", file);
        else if (*text == '"' || *text == '\\')
            fprintf(file, "\\%c", *text);
        else if (code == '\n')
            fputs("\\n", file);
        else if (code > 0)
            fprintf(file, "\\u%04x", (unsigned)code);
        else
            fwrite(text, 1, (size_t)length, file);
        text += length > 0 ? length : 1;
    }
    fputc('"', file);
}

static void member(json *j, const char *key)
{
    if (!j->first)
        fputc(',', j->file);
    j->first = false;
    if (!key)
        return; /* an element of a list */
    quoted(j->file, key);
    fputc(':', j->file);
}

static void number(FILE *file, double value)
{
    if (!isfinite(value)) {
        fputs("null", file);
        return;
    }
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    fputs(text, file);
}

void json_text(json *j, const char *key, const char *value)
{
    member(j, key);
    quoted(j->file, value);
}

void json_real(json *j, const char *key, double value)
{
    member(j, key);
    number(j->file, value);
}

void json_integer(json *j, const char *key, long long value)
{
    member(j, key);
    fprintf(j->file, "%lld", value);
}

void json_boolean(json *j, const char *key, bool value)
{
    member(j, key);
    fputs(value ? "true" : "false", j->file);
}

void json_hash(json *j, const char *key, uint64_t value)
{
    member(j, key);
    fprintf(j->file, "\"%016" PRIx64 "\"", value);
}

void json_reals(json *j, const char *key, const double *values, int count)
{
    member(j, key);
    fputc('[', j->file);
    for (int i = 0; i < count; i++) {
        if (i)
            fputc(',', j->file);
        number(j->file, values[i]);
    }
    fputc(']', j->file);
}

void json_open(json *j, const char *key)
{
    member(j, key);
    fputc('{', j->file);
    j->first = true;
}

void json_close(json *j)
{
    fputc('}', j->file);
    j->first = false;
}

void json_open_list(json *j, const char *key)
{
    member(j, key);
    fputc('[', j->file);
    j->first = true;
}

void json_close_list(json *j)
{
    fputc(']', j->file);
    j->first = false;
}
