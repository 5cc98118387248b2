/* What the readers of meshes share, inside io: a cursor over text, and adding triangles with their places. One module
   with mesh_file, whose inside this is. */
#ifndef IO_MESH_READER_H
#define IO_MESH_READER_H

#include "io/mesh_file.h"
#include "io/text_buffer.h"

/* Words of a text, with the line they stand in. */
typedef struct word_reader {
    const char *at, *end;
    bool continued; /* a backslash before the end of a line continues it; no format but OBJ has that */
    int32_t line;
    const char *word; /* the last one, not terminated */
    size_t length;
    int32_t word_line;
} word_reader;

word_reader word_reader_begin(const char *data, size_t size);
/* The next word, over ends of lines; false at the end. */
bool word_next(word_reader *r);
/* The next word of this line; false at its end. */
bool word_next_in_line(word_reader *r);
/* What is left of the line, and its end. */
void word_skip_line(word_reader *r);
/* The last word is `text`, whatever the case. */
bool word_is(const word_reader *r, const char *text);
/* How many of the last word's characters a message repeats, for %.*s. */
int word_shown(const word_reader *r);

/* One reading. */
typedef struct mesh_reading {
    context *ctx;
    const char *name;
    mesh_file *out;
    fram_error *error;
} mesh_reading;

/* FRAM_ERROR_INPUT at a line (0: none) and an element (0: none). */
fram_status mesh_refuse(const mesh_reading *r, int32_t line, int32_t element, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* The last word as a coordinate [m]; `what` names it for the error.  Fortran's exponent letter D is taken as E. */
fram_status mesh_read_number(const mesh_reading *r, const word_reader *w, int32_t element, const char *what,
                             double *value);
fram_status mesh_check_number(const mesh_reading *r, int32_t line, int32_t element, double value);
/* A triangle of vertices of out->surface, with its place; one that names a point twice is dropped and counted. */
fram_status mesh_place_triangle(const mesh_reading *r, int32_t a, int32_t b, int32_t c, int32_t element, int32_t line);
/* A polygon of 3 vertices or more; repeated ones in a row are taken once.  Refused when it crosses itself. */
fram_status mesh_place_polygon(const mesh_reading *r, int32_t *ring, int32_t count, int32_t element, int32_t line);

/* Refuses what others than STL, OBJ and GDF write, by what it begins with, and says what to do with it: FRAM_OK is no
   praise. */
fram_status mesh_refuse_others(const mesh_reading *r, const char *data, size_t size);
bool mesh_looks_like_obj(const char *data, size_t size);
fram_status mesh_read_stl(const mesh_reading *r, const char *data, size_t size);
fram_status mesh_read_obj(const mesh_reading *r, const char *data, size_t size);
fram_status mesh_read_gdf(const mesh_reading *r, const char *data, size_t size);
bool mesh_is_binary_stl(const char *data, size_t size);
/* STL that begins with the word solid, as headers of binary files may: no text has a NUL, and each number of facets of
   a binary file, whole or not, has one. */
mesh_format mesh_solid_format(const char *data, size_t size);
/* The second line begins with two numbers, and the third; words may follow. */
bool mesh_looks_like_gdf(const char *data, size_t size);
void mesh_write_stl_text(context *ctx, const mesh *m, text_buffer *out);
void mesh_write_stl_binary(context *ctx, const mesh *m, text_buffer *out);
void mesh_write_obj(context *ctx, const mesh *m, text_buffer *out);
void mesh_write_gdf(context *ctx, const mesh *m, text_buffer *out);

#endif
