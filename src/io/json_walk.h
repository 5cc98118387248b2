/* A strict walk over a JSON text (RFC 8259) in memory, without a tree: for readers of large files that take what they
   know and pass over the rest.  A walk is a value: a copy of one remembers a place, to be gone on from later.  Knows
   JSON; must not know what a file means. */
#ifndef IO_JSON_WALK_H
#define IO_JSON_WALK_H

#include "base/context.h"

typedef struct json_walk {
    const char *name; /* of the file, for errors */
    const char *at, *end;
    const char *line_start;
    int32_t line;        /* from 1 */
    int32_t depth;       /* objects and arrays that are open */
    int32_t depth_limit; /* most of them */
} json_walk;

typedef enum json_kind {
    JSON_OBJECT = 0,
    JSON_ARRAY,
    JSON_STRING,
    JSON_NUMBER,
    JSON_TRUE,
    JSON_FALSE,
    JSON_NULL
} json_kind;

/* At the first value; a byte order mark is passed over. */
json_walk json_walk_begin(const char *name, const char *data, size_t size, int32_t depth_limit);
/* Column of the walk, from 1, in bytes. */
int32_t json_walk_column(const json_walk *w);
/* FRAM_ERROR_INPUT at the walk's place. */
fram_status json_walk_refuse(const json_walk *w, const char *key, fram_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* All below return FRAM_ERROR_INPUT with line and column where the text is no JSON or not of the kind asked for, and
   then leave the walk anywhere. */

/* The kind of the value that comes next; the walk moves to its first character. */
fram_status json_walk_kind(json_walk *w, json_kind *kind, fram_error *error);
/* The way through an array or an object: while (json_walk_next(w, &loop, error)) loop.status = what became of the
   element, which must have been passed. */
typedef struct json_loop {
    fram_status status; /* the loop ends at another one than FRAM_OK, of the walk or of its user */
    bool first;         /* no item was met yet */
} json_loop;
/* Into an object or array. */
json_loop json_walk_into(json_walk *w, json_kind kind, fram_error *error);
/* To the next element of an array; false where there is none, and the array is left, or the loop has failed. */
bool json_walk_next(json_walk *w, json_loop *loop, fram_error *error);
/* The same for an object: to the value of the next member.  Its name goes to key as UTF-8, of what its escapes mean;
   what has no room in `room` bytes with the NUL is cut off between characters.  U+0000 and half a pair of surrogates,
   which no text can hold, become U+FFFD. */
bool json_walk_next_member(json_walk *w, json_loop *loop, char *key, size_t room, fram_error *error);
/* A string, in the same way. */
fram_status json_walk_text(json_walk *w, char *text, size_t room, fram_error *error);
/* The same, or null, which is an empty text: none. */
fram_status json_walk_text_or_null(json_walk *w, char *text, size_t room, fram_error *error);
/* A number; one that overflows is refused. */
fram_status json_walk_number(json_walk *w, double *value, fram_error *error);
/* The same, or null, which is NaN. */
fram_status json_walk_number_or_null(json_walk *w, double *value, fram_error *error);
/* Past a value of any kind. */
fram_status json_walk_skip(json_walk *w, fram_error *error);
/* Only blanks are left. */
fram_status json_walk_end(json_walk *w, fram_error *error);

#endif
