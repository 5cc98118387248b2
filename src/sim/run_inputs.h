/* The files that a scenario names: what is in them decides a run as the scenario does.  Knows nothing of what they
   mean, nor of who keeps the list. */
#ifndef SIM_RUN_INPUTS_H
#define SIM_RUN_INPUTS_H

#include "base/hash.h"
#include "io/text_buffer.h"
#include "model/scenario.h"

/* "sha256  path" of every file the scenario names, a line each, the paths absolute.  known: lines of files that were
   looked at before and are not read again, to which the others are added; NULL: none. */
fram_status run_inputs_list(context *ctx, const scenario *s, text_buffer *known, text_buffer *out, fram_error *error);
/* A line of such a list. */
typedef struct run_input {
    char digest[SHA256_TEXT_SIZE];
    const char *path; /* in the list */
    int path_length;
} run_input;
/* The next line of a list, from *at on, which moves behind it; false at the end, and at what is no such line. */
bool run_inputs_next(const char **at, const char *end, run_input *out);
/* Whether a file is one of such a list, however its name is spelt. */
bool run_inputs_has(const char *inputs, const char *path);
/* FRAM_ERROR_USAGE, key "output", for a folder in which a file of the list has a name that is to be written. */
fram_status run_inputs_refuse(const char *inputs, const char *folder, bool (*is_written)(const char *name),
                              fram_error *error);
/* What such a list says of the files' contents, wherever they lie: SHA-256 of its digests, one after the other.  A text
   that is one digest already is taken as it is; FRAM_ERROR_INPUT, with no place, for any other. */
fram_status run_inputs_digest(context *ctx, const char *text, size_t size, char out[SHA256_TEXT_SIZE],
                              fram_error *error);

#endif
