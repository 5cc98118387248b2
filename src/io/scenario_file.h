/* Scenario files: block-style YAML to a checked scenario, and a scenario back to text.  All that the keys are is in
   model/scenario_keys.h.

   Refused before any key is looked at: files over SCENARIO_FILE_LIMIT bytes, more than SCENARIO_BRACKET_LIMIT bytes
   between brackets, nesting deeper than SCENARIO_DEPTH_LIMIT,
   text that is not UTF-8, anchors, aliases, tags, merge keys, duplicate keys, more than one document.  Every error is
   one fram_error with file, line, column, key, and a message "expected ..., found ...". */
#ifndef IO_SCENARIO_FILE_H
#define IO_SCENARIO_FILE_H

#include "base/hash.h"
#include "io/text_buffer.h"
#include "model/scenario.h"

/* The effective scenario, which a run writes and others read again, has 25 MB with all lists of 32 vessels full. Fram
   writes no brackets, for which a file needs much memory (io/yaml_tree.h). */
enum { SCENARIO_FILE_LIMIT = 1 << 25, SCENARIO_BRACKET_LIMIT = 1 << 20, SCENARIO_DEPTH_LIMIT = 16 };

/* Values given over those of the file, each "key=value" ("run.seed=7", "ice.floes[0].x=3"), the last one of a key wins.
   In errors their file is SCENARIO_OVERRIDE. */
typedef struct scenario_overrides {
    const char *const *items;
    int32_t count;
} scenario_overrides;

/* Reads and checks a file; the files that it names must be there.  overrides may be NULL.  On success free with
   scenario_free; on failure nothing is left to free. */
fram_status scenario_read(context *ctx, const char *path, const scenario_overrides *overrides, scenario *s,
                          fram_error *error);
/* The same without looking for the files that it names: of a run that is over they may be gone. */
fram_status scenario_read_alone(context *ctx, const char *path, const scenario_overrides *overrides, scenario *s,
                                fram_error *error);
/* The same from memory; `name` stands for the file in errors and for relative paths. */
fram_status scenario_parse(context *ctx, const char *name, const char *text, size_t size,
                           const scenario_overrides *overrides, scenario *s, fram_error *error);

/* That the files which a scenario names are there; on failure the scenario is freed. */
fram_status scenario_find_files(context *ctx, scenario *s, fram_error *error);

typedef struct scenario_print_options {
    bool comments;       /* unit and meaning after every key */
    bool absolute_paths; /* so that the text can be used from another folder */
    bool names_only;     /* files by their name alone, so that the text tells nothing of this machine */
    /* Where the file of this absolute path is for whoever reads the text; NULL: as the other members say. */
    const char *(*file_name)(void *user, const char *path);
    void *file_user;
} scenario_print_options;
/* The effective scenario, every key with its value, appended to out.  Reading it again gives the same scenario to the
   bit. options NULL: comments, paths as given. */
fram_status scenario_print(context *ctx, const scenario *s, const scenario_print_options *options, text_buffer *out,
                           fram_error *error);
/* The path of a file that the scenario names under `key`, the same from every folder.  FRAM_ERROR_INPUT when it is too
   long for a scenario, or cannot be written into one. */
fram_status scenario_absolute_path(const scenario *s, const char *key, const char *path, char out[SCENARIO_TEXT_SIZE],
                                   fram_error *error);
/* SHA-256 of the effective scenario without comments, with files by their name alone and "1e-06" for "1.0e-06",
   hexadecimal: the same wherever the files lie.  Their contents are to be hashed on their own. */
fram_status scenario_hash(context *ctx, const scenario *s, char out[SHA256_TEXT_SIZE], fram_error *error);

/* The input reference, every key with type, unit, default, range and meaning, as Markdown. */
fram_status scenario_reference(context *ctx, text_buffer *out, fram_error *error);

#endif
