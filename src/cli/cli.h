/* The command: turns words into calls of the public API, and answers into text, JSON and exit codes.
   Includes fram/ headers only; whatever it does, a program can do through the library. */
#ifndef CLI_CLI_H
#define CLI_CLI_H

#include "fram/fram.h"
#include <stdio.h>

/* Exit codes. */
enum { EXIT_GOOD = 0, EXIT_RUN_FAILED = 1, EXIT_BAD_INPUT = 2, EXIT_INTERRUPTED = 130 };

/* OPTION_SIZE and OPTION_COUNT: a real and a whole number above zero, where the API takes zero for the default. */
typedef enum option_kind {
    OPTION_FLAG,
    OPTION_TEXT,
    OPTION_REAL,
    OPTION_SIZE,
    OPTION_INTEGER,
    OPTION_COUNT,
    OPTION_LIST
} option_kind;

enum { OPTION_LIST_ROOM = 64 };
typedef struct option_list {
    const char *value[OPTION_LIST_ROOM];
    int count;
} option_list;

/* One option of a command; `value` points to where it goes: bool, const char *, double, int, option_list. */
typedef struct option_row {
    const char *name;       /* "--until" */
    const char *short_name; /* "-o" or NULL */
    option_kind kind;
    void *value;
    const char *argument; /* "T", NULL for a flag */
    const char *meaning;
} option_row;

/* What every command takes, besides its own options. */
enum { OPTION_NAMES_ROOM = 48 };
typedef struct common_options {
    bool json, quiet, verbose, help, force;
    int threads;
    const char *isa;
    const char *option[OPTION_NAMES_ROOM]; /* names of the options of the command, then NULL: for words of errors */
} common_options;

/* One command of `fram`. */
typedef struct command_row {
    const char *name;
    const char *arguments; /* "SCENARIO -o DIR" */
    const char *summary;   /* one line */
    const char *examples;  /* lines of the help */
    int (*run)(const struct command_row *self, int argc, char **argv);
} command_row;

/* --- options.c --- */

/* Read a command's words: options by the table, everything else into positional[0..positional_count), which must
   hold exactly `positional_count` words.  Returns -1 to go on, or an exit code: help was asked for and printed, or a
   usage error was reported. */
int options_read(const command_row *command, const option_row *rows, int row_count, common_options *common, int argc,
                 char **argv, const char **positional, int positional_count);

/* The same for a command whose last positional words may be left out: at least `least`, the others stay as they
   were. */
int options_read_some(const command_row *command, const option_row *rows, int row_count, common_options *common,
                      int argc, char **argv, const char **positional, int least, int most);

/* A decimal number up to one of the characters `ends` or the text's end, where *at is left: the numbers of all options,
   by the rule of scenarios (fram_number_read); those of lists, which have such characters between them, may have blanks
   about them.  false: no such number, and `error` (NULL: not wanted) says what is wrong. */
bool take_number(const char **at, const char *ends, double *out, fram_error *error);

/* Whether --json is among the words, before a -- that ends the options. */
bool words_ask_for_json(int count, char **words);

/* --- shown.c --- */

/* Bytes of the well-formed UTF-8 sequence that a text begins with (Unicode 15, table 3-7); 0: there is none. */
int utf8_sequence(const char *at);
/* The code of a well-formed sequence that does something where it is shown instead of being seen: control characters,
   with which a text takes hold of a terminal, and what ends a line or turns the direction of writing; 0: none. */
int control_code(const char *at);
/* A text for people, of which nothing acts on their terminal: what does, and what is no UTF-8, is U+FFFD; tabs and line
   ends stay. */
void put_shown(FILE *file, const char *text);
/* The same where the stream is a terminal; elsewhere every byte, for programs. */
void put_given(FILE *file, const char *text);
/* printf of one line, shown so: no line ends but those that the format begins and ends with, so that no name makes a
 * line. */
void tell(FILE *file, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/* --- answer.c --- */

/* Print an error for people on standard error, and as JSON on standard output if asked; returns the exit code. */
int answer_error(const common_options *common, const fram_error *error);
/* That there was no memory, in the same way. */
int answer_memory(const common_options *common);
/* A usage error in the same way. */
int answer_usage(const common_options *common, const char *key, const char *message);

/* One JSON object on one line of standard output. */
typedef struct json {
    FILE *file;
    bool first;
} json;
json json_begin(void);
void json_end(json *j);
void json_text(json *j, const char *key, const char *value);
void json_real(json *j, const char *key,
               double value); /* null when not finite; shortest text that reads back the same */
void json_integer(json *j, const char *key, long long value);
void json_boolean(json *j, const char *key, bool value);
void json_hash(json *j, const char *key, uint64_t value); /* 16 hexadecimal digits */
void json_reals(json *j, const char *key, const double *values, int count);
/* A nested object: begin, members, end. */
void json_open(json *j, const char *key);
void json_close(json *j);
/* A list: begin, elements that are objects (json_open with key NULL), end. */
void json_open_list(json *j, const char *key);
void json_close_list(json *j);

/* --- beside.c --- */

enum { BESIDE_SIZE = 1024 };
/* The first of the places, relative to the folder of the command's own file, where a file can be read; false: none. */
bool find_beside(const char *const *places, size_t count, char out[BESIDE_SIZE]);

/* --- outputs.c --- */

/* The kinds of pictures, pages, videos and tables.  A name with another ending is refused. */
#define PICTURE_ENDINGS "png svg"
#define PAGE_ENDINGS "html htm"
#define VIDEO_ENDINGS "mp4"
#define TABLE_ENDINGS "csv"
/* In place of endings: a folder of files. */
#define FOLDER_OUTPUT "/"

/* Whether a name ends in one of the endings, "png svg". */
bool has_ending(const char *path, const char *endings);
/* A file that a command writes: the option that names it, and the endings of the names of its kind, "stl obj" (NULL:
   any).  NULL as path: none is asked for. */
typedef struct output_file {
    const char *option, *path, *endings;
} output_file;
/* What a command reads and writes; NULL in places that are free.  runs: folders, of which all is read. */
enum { FILES_ROOM = 6 };
typedef struct command_files {
    const char *inputs[FILES_ROOM], *runs[FILES_ROOM];
    output_file outputs[FILES_ROOM];
} command_files;
/* A usage error, else -1: what is read is never written over, nor one output by another; a file that is there is
   replaced when its name has an ending of the kind that is written, otherwise with --force only, as a folder that is
   not empty is written into. */
int refuse_outputs(const common_options *common, const command_files *files);
/* The same for the files that a scenario names, when it has been read. */
int refuse_scenario_files(const common_options *common, const command_files *files, const fram_scenario *scenario);
/* The same for the folder of a run: its files must not be the scenario that is read, nor what that names. */
int refuse_run_folder(const common_options *common, const char *path, const fram_scenario *scenario,
                      const char *folder);

/* --- terminal.c --- */

/* Whether standard error is a terminal whose lines can be drawn over: TERM=dumb and no TERM are none. */
bool terminal_draws(void);
/* Whoever writes to standard error while a line may be drawn there clears it first; nothing elsewhere. */
void terminal_clear(void);
/* One line of parts: drawn over the last one on a terminal, where those of the highest rank are left out until it is no
   longer than that is wide; elsewhere whole, with its end. */
typedef struct line_part {
    int rank; /* 0: never left out */
    char text[256];
} line_part;
void terminal_line(const line_part *parts, int count);

/* --- session.c --- */

/* Context with log to standard error as the common options say; on failure reports and returns an exit code, else -1.
   Ctrl-C ends the process until session_stop_flag is called, which the context has; who writes a file calls it before.
 */
int session_open(const common_options *common, fram_context **context);
/* The same for commands that make worlds or fields, or files of a run: Ctrl-C ends the making (see session_stop_flag),
   so that no half-written file stays, and how far it is is shown on standard error, by a view that lives as long as the
   context. */
typedef struct work_view {
    char what[80];
    double begun, shown; /* wall clock [s] */
    double first, done;  /* of its total: when it was begun, and now */
    bool terminal;
} work_view;
int session_open_making(const common_options *common, work_view *view, fram_context **context);
/* For commands that read long runs or compute parts of them again: how far it is is shown, and Ctrl-C is as above.
 */
int session_open_reading(const common_options *common, work_view *view, fram_context **context);
/* The one or the other: with a file to write, or NULL. */
typedef enum session_kind { SESSION_READS, SESSION_MAKES } session_kind;
session_kind session_kind_for(const char *file);
int session_open_for(const char *file, const common_options *common, work_view *view, fram_context **context);
/* The one or the other, when nothing speaks against the files (refuse_outputs). */
int session_open_files(const common_options *common, const command_files *files, session_kind kind, work_view *view,
                       fram_context **context);
/* Of no beginning in particular, never turned back [s]. */
double wall_clock(void);
enum { DURATION_ROOM = 64 }; /* of fram_duration_text */
/* An estimate in whole seconds, "3 min 20 s", "less than 1 s", "not known yet" for a NaN; as a text, or to standard
   error. */
const char *duration_words(double seconds, char out[DURATION_ROOM]);
void print_duration(double seconds);
/* The s of a plural: 1 run, 2 runs. */
const char *plural(int64_t count);
/* A flag that Ctrl-C, SIGTERM and a terminal that closes set; the first signal asks for a checkpoint, a Ctrl-C or
   SIGTERM half a second later ends the process.  From now on a pipe that closes is an error of the write, and does not
   end it.
 */
const volatile int *session_stop_flag(void);
/* Progress line on standard error: redrawn on a terminal; elsewhere a line every ten percent and every five seconds. */
typedef struct progress_view {
    bool terminal;
    int last_tenth;
    double shown; /* wall clock [s] */
    bool drawn;
} progress_view;
void progress_begin(progress_view *view);
void progress_show(void *user, const fram_progress *p);
void progress_end(progress_view *view);

/* --- command_view.c --- */

/* The viewer's page, where `make viewer` or an installation put it; false: it is not there. */
bool viewer_page_find(char out[BESIDE_SIZE]);

/* --- the commands, one file each --- */
int command_run(const command_row *self, int argc, char **argv);
int command_study(const command_row *self, int argc, char **argv);
int command_extremes(const command_row *self, int argc, char **argv);
int command_fatigue(const command_row *self, int argc, char **argv);
int command_check(const command_row *self, int argc, char **argv);
int command_resume(const command_row *self, int argc, char **argv);
int command_bench(const command_row *self, int argc, char **argv);
int command_fmu(const command_row *self, int argc, char **argv);
int command_view(const command_row *self, int argc, char **argv);
int command_keys(const command_row *self, int argc, char **argv);
int command_ice(const command_row *self, int argc, char **argv);
int command_hull(const command_row *self, int argc, char **argv);
int command_field(const command_row *self, int argc, char **argv);
int command_export(const command_row *self, int argc, char **argv);
int command_report(const command_row *self, int argc, char **argv);
int command_plot(const command_row *self, int argc, char **argv);
int command_manage(const command_row *self, int argc, char **argv);
int command_compare(const command_row *self, int argc, char **argv);
int command_capability(const command_row *self, int argc, char **argv);
int command_pressure(const command_row *self, int argc, char **argv);
int command_why(const command_row *self, int argc, char **argv);
int command_video(const command_row *self, int argc, char **argv);

#endif
