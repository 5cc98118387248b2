/* What the readers of outlines as text share: a walk over the characters with its place, numbers, rings.  Knows neither
   form; see outline_file.h. */
#ifndef IO_OUTLINE_WALK_H
#define IO_OUTLINE_WALK_H

#include "ice/import.h"

typedef struct outline_walk {
    context *ctx;
    const char *name; /* of the file */
    const char *at, *end, *line_start;
    int32_t line; /* from 1 */
    import_rings *out;
    fram_error *error;
    import_place place; /* of the ring at work */
    int32_t first;      /* its first vertex */
} outline_walk;

/* FRAM_ERROR_INPUT at the walk's place, with the ring's name as key while one is read. */
fram_status outline_refuse(const outline_walk *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Blanks and tabs. */
void outline_skip_blanks(outline_walk *w);
/* To the begin of the next line, or the end. */
void outline_skip_line(outline_walk *w);
/* A number that blanks, a comma, a semicolon, a bracket or the line's end follow. */
fram_status outline_number(outline_walk *w, double *value);

/* A ring of the walk's feature and polygon begins here; number is that in its polygon. */
fram_status outline_ring_begin(outline_walk *w, int32_t number);
fram_status outline_ring_add(outline_walk *w, vec2 position);
/* It ends; implied: it need not repeat its first position. */
fram_status outline_ring_end(outline_walk *w, bool implied);

fram_status outline_read_wkt(outline_walk *w);

#endif
