/* Reading a command's words by its option table; the same table prints its help. */
#include "cli/cli.h"

#include "fram/statistics.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COMMON_ROWS = 7 };

static void common_rows(common_options *c, option_row rows[COMMON_ROWS])
{
    rows[0] = (option_row){"--json", NULL, OPTION_FLAG, &c->json, NULL, "end with one JSON object on standard output"};
    rows[1] = (option_row){"--threads", NULL, OPTION_INTEGER,
                           &c->threads, "N",  "threads to use (1); results never depend on it"};
    rows[2] = (option_row){
        "--isa", NULL,   OPTION_TEXT,
        &c->isa, "NAME", "baseline, avx2 or avx512 (the best that the processor has); results never depend on it"};
    rows[3] = (option_row){"--quiet", "-q", OPTION_FLAG, &c->quiet, NULL, "errors only on standard error"};
    rows[4] = (option_row){"--verbose", "-v", OPTION_FLAG, &c->verbose, NULL, "more on standard error"};
    rows[5] =
        (option_row){"--force", NULL, OPTION_FLAG,
                     &c->force, NULL, "overwrite a file of another type, or write into a folder that is not empty"};
    rows[6] = (option_row){"--help", "-h", OPTION_FLAG, &c->help, NULL, "this text"};
}

static const option_row *find_row(const option_row *rows, int count, const char *word, size_t length)
{
    for (int i = 0; i < count; i++) {
        const option_row *r = &rows[i];
        if (strlen(r->name) == length && strncmp(r->name, word, length) == 0)
            return r;
        if (r->short_name && strlen(r->short_name) == length && strncmp(r->short_name, word, length) == 0)
            return r;
    }
    return NULL;
}

/* Rows without those that a command has for itself under the same name. */
static void print_options(const option_row *rows, int count, const option_row *own, int own_count)
{
    for (int i = 0; i < count; i++) {
        if (find_row(own, own_count, rows[i].name, strlen(rows[i].name)))
            continue;
        char name[64];
        snprintf(name, sizeof name, "%s%s%s%s%s", rows[i].short_name ? rows[i].short_name : "",
                 rows[i].short_name ? ", " : "", rows[i].name, rows[i].argument ? " " : "",
                 rows[i].argument ? rows[i].argument : "");
        printf("  %-24s %s\n", name, rows[i].meaning);
    }
}

static void print_command_help(const command_row *command, const option_row *rows, int row_count,
                               const option_row *common)
{
    printf("fram %s%s%s\n  %s\n\n", command->name, *command->arguments ? " " : "", command->arguments,
           command->summary);
    printf("Examples:\n%s\nOptions:\n", command->examples);
    print_options(rows, row_count, NULL, 0);
    print_options(common, COMMON_ROWS, rows, row_count);
}

bool take_number(const char **at, const char *ends, double *out, fram_error *error)
{
    enum { LONGEST = 400 }; /* that is read; what is longer is none */
    static const char blanks[] = " \t";
    char text[LONGEST + 2];
    const char *first = *at + (*ends ? strspn(*at, blanks) : 0);
    size_t length = strcspn(first, ends);
    *at = first + length;
    while (*ends && length > 0 && strchr(blanks, first[length - 1]))
        length--;
    snprintf(text, sizeof text, "%.*s", (int)(length > LONGEST ? LONGEST + 1 : length), first);
    return fram_number_read(text, out, error) == FRAM_OK;
}

static bool store_integer(const char *text, int *out)
{
    const char *digits = text + (*text == '+' || *text == '-');
    errno = 0;
    long value = strtol(text, NULL, 10);
    if (!*digits || digits[strspn(digits, "0123456789")] || errno == ERANGE || value < INT_MIN || value > INT_MAX)
        return false;
    *out = (int)value;
    return true;
}

/* A number that is whole is told what else is at fault: how it is written, 1e3 or 2.0, or its size. */
static const char *whole_number_wanted(const char *text, bool above_zero)
{
    static const char *const words[][2] = {
        {"needs a whole number, as 1000", "needs a whole number above zero, as 1000"},
        {"needs a whole number, as 1000, not 1e3 or 1000.0",
         "needs a whole number above zero, as 1000, not 1e3 or 1000.0"},
        {"needs a whole number of at most nine digits", "needs a whole number from 1 to 2147483647"}};
    const char *at = text, *digits = text + (*text == '+' || *text == '-');
    double value = 0;
    const bool number = take_number(&at, "", &value, NULL);
    const bool plain = *digits && !digits[strspn(digits, "0123456789")];
    const bool whole = plain || (number && value == floor(value));
    const bool fits = number && value >= INT_MIN && value <= INT_MAX; /* one of 500 digits is read as none */
    return words[!whole ? 0 : !fits ? 2 : !plain][above_zero];
}

static const char *store_real(const char *text, double *out, fram_error *error)
{
    return take_number(&text, "", out, error) ? NULL : error->message;
}

/* NULL when stored, otherwise what is wrong: a text of its own or that of the error. */
static const char *store_value(const option_row *row, const char *text, fram_error *error)
{
    const char *wrong;
    switch (row->kind) {
    case OPTION_TEXT:
        *(const char **)row->value = text;
        return NULL;
    case OPTION_REAL:
        return store_real(text, row->value, error);
    case OPTION_SIZE:
        wrong = store_real(text, row->value, error);
        return wrong || *(double *)row->value > 0 ? wrong : "needs a number above zero, as 0.5 or 1e3";
    case OPTION_INTEGER:
        return store_integer(text, row->value) ? NULL : whole_number_wanted(text, false);
    case OPTION_COUNT:
        return store_integer(text, row->value) && *(int *)row->value > 0 ? NULL : whole_number_wanted(text, true);
    case OPTION_LIST: {
        option_list *list = row->value;
        if (list->count == OPTION_LIST_ROOM)
            return "is given more often than 64 times";
        list->value[list->count++] = text;
        return NULL;
    }
    case OPTION_FLAG:
        break;
    }
    return "takes no value";
}

int options_read(const command_row *command, const option_row *rows, int row_count, common_options *common, int argc,
                 char **argv, const char **positional, int positional_count)
{
    return options_read_some(command, rows, row_count, common, argc, argv, positional, positional_count,
                             positional_count);
}

/* A command's words and what they may be. */
typedef struct word_list {
    const option_row *rows, *shared;
    int row_count;
    common_options *common;
    int count, at;         /* the next one */
    const char *arguments; /* as the help has them */
    char **word;
} word_list;

static const option_row *find_option(const word_list *list, const char *word, size_t length)
{
    const option_row *row = find_row(list->rows, list->row_count, word, length);
    return row ? row : find_row(list->shared, COMMON_ROWS, word, length);
}

/* The option at list->at and its value.  -1 to go on. */
static int read_option(word_list *list)
{
    const char *word = list->word[list->at++];
    const char *equals = strncmp(word, "--", 2) == 0 ? strchr(word, '=') : NULL;
    const option_row *row = find_option(list, word, equals ? (size_t)(equals - word) : strlen(word));
    if (!row)
        return answer_usage(list->common, word, "is not an option of this command; see --help");
    if (row->kind == OPTION_FLAG) {
        if (equals)
            return answer_usage(list->common, row->name, "takes no value");
        *(bool *)row->value = true;
        return -1;
    }
    const char *text = equals ? equals + 1 : list->at < list->count ? list->word[list->at++] : NULL;
    if (!text || !*text)
        return answer_usage(list->common, row->name, text ? "needs a value, found an empty word" : "needs a value");
    /* "-o --force" forgot a name: it asks for no folder called --force. */
    if (!equals && find_option(list, text, strlen(text)))
        return answer_usage(list->common, row->name,
                            "needs a value, found an option; a file of that name is ./--name, a value --option=--name");
    fram_error error = {0};
    const char *wrong = store_value(row, text, &error);
    return wrong ? answer_usage(list->common, row->name, wrong) : -1;
}

/* Options to where they go, all other words into positional.  -1 to go on. */
static int read_words(word_list *list, const char **positional, int most, int *found)
{
    bool only_positional = false;
    while (list->at < list->count) {
        const char *word = list->word[list->at];
        if (!only_positional && strcmp(word, "--") == 0) {
            only_positional = true;
            list->at++;
        } else if (!only_positional && word[0] == '-' && word[1] != '\0') {
            int code = read_option(list);
            if (code >= 0)
                return code;
        } else {
            if (!*word)
                return answer_usage(list->common, list->arguments, "expected a word, found an empty one; see --help");
            if (*found == most)
                return answer_usage(list->common, word, "is one argument too many; see --help");
            positional[(*found)++] = word;
            list->at++;
        }
    }
    return -1;
}

bool words_ask_for_json(int count, char **words)
{
    for (int i = 0; i < count && strcmp(words[i], "--") != 0; i++) {
        if (strcmp(words[i], "--json") == 0)
            return true;
    }
    return false;
}

/* For errors, which may come when the rows are gone. */
static void note_names(const option_row *rows, int count, common_options *common)
{
    int noted = 0;
    while (common->option[noted])
        noted++;
    for (int i = 0; i < count && noted + 1 < OPTION_NAMES_ROOM; i++)
        common->option[noted++] = rows[i].name;
}

static int answer_command_help(const command_row *command, const word_list *list)
{
    print_command_help(command, list->rows, list->row_count, list->shared);
    if (list->common->json) {
        json j = json_begin();
        json_text(&j, "help", command->name);
        json_end(&j);
    }
    return EXIT_GOOD;
}

int options_read_some(const command_row *command, const option_row *rows, int row_count, common_options *common,
                      int argc, char **argv, const char **positional, int least, int most)
{
    *common = (common_options){.threads = 1};
    /* --json anywhere, so that a usage error before it is JSON too. */
    common->json = words_ask_for_json(argc, argv);
    option_row shared[COMMON_ROWS];
    common_rows(common, shared);
    note_names(rows, row_count, common);
    note_names(shared, COMMON_ROWS, common);
    word_list list = {
        rows, shared, row_count, common, argc, 0, *command->arguments ? command->arguments : command->name, argv};
    int found = 0, code = read_words(&list, positional, most, &found);
    if (code >= 0)
        return code;
    if (common->help)
        return answer_command_help(command, &list);
    char message[160];
    if (common->threads < 1 || common->threads > FRAM_THREADS) {
        snprintf(message, sizeof message, "must lie between 1 and %d", FRAM_THREADS);
        return answer_usage(common, "--threads", message);
    }
    if (found < least) {
        snprintf(message, sizeof message, "lacks an argument: fram %s %s", command->name, command->arguments);
        return answer_usage(common, command->name, message);
    }
    return -1;
}
