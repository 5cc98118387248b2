/* Which form it is, and what the forms share; see outline_file.h. */
#include "io/outline_file.h"

#include "base/number_text.h"
#include "io/file.h"
#include "io/geojson.h"
#include "io/outline_walk.h"
#include "io/utf8.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ---- the walk ---- */

fram_status outline_refuse(const outline_walk *w, const char *format, ...)
{
    char key[IMPORT_NAME_SIZE] = "", message[256];
    if (w->place.ring > 0)
        import_place_name(&w->place, key);
    else if (w->place.feature > 0)
        snprintf(key, sizeof key, "feature %d", (int)w->place.feature);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    error_set(w->error, FRAM_ERROR_INPUT, w->name, (int)w->line, key[0] ? key : NULL, "%s", message);
    if (w->error)
        w->error->column = (int)(w->at - w->line_start) + 1;
    return FRAM_ERROR_INPUT;
}

void outline_skip_blanks(outline_walk *w)
{
    while (w->at < w->end && (*w->at == ' ' || *w->at == '\t' || *w->at == '\r'))
        w->at++;
}

void outline_skip_line(outline_walk *w)
{
    while (w->at < w->end && *w->at != '\n')
        w->at++;
    if (w->at == w->end)
        return;
    w->line_start = ++w->at;
    w->line++;
}

static bool ends_number(char c) { return strchr(" \t\r\n,;()", c) != NULL; /* NUL too */ }

fram_status outline_number(outline_walk *w, double *value)
{
    char text[NUMBER_LENGTH_MOST + 1];
    size_t length = 0;
    while (w->at + length < w->end && !ends_number(w->at[length]))
        length++;
    if (length == 0 || length > NUMBER_LENGTH_MOST)
        return outline_refuse(w, "expected a number, found %s", length ? "a word that is too long" : "none");
    memcpy(text, w->at, length);
    text[length] = '\0';
    if (real_from_text(text, value) != NUMBER_GOOD)
        return outline_refuse(w, "expected a finite number such as -12.5e3, found other text of %zu characters",
                              length);
    w->at += length;
    return FRAM_OK;
}

/* ---- rings ---- */

fram_status outline_ring_begin(outline_walk *w, int32_t number)
{
    if (w->out->place.count == GEOJSON_RINGS_MOST)
        return outline_refuse(w, "the file has more than %d rings", (int)GEOJSON_RINGS_MOST);
    w->place.ring = number;
    w->place.line = w->line;
    w->place.column = (int32_t)(w->at - w->line_start) + 1;
    w->place.thickness = (double)NAN;
    w->first = w->out->rings.vertex.count;
    return FRAM_OK;
}

fram_status outline_ring_add(outline_walk *w, vec2 position)
{
    vec2_array *vertices = &w->out->rings.vertex;
    if (vertices->count - w->first == GEOJSON_RING_VERTICES_MOST)
        return outline_refuse(w, "a ring has more than %d positions", (int)GEOJSON_RING_VERTICES_MOST);
    if (vertices->count == GEOJSON_VERTICES_MOST)
        return outline_refuse(w, "the file has more than %d positions", (int)GEOJSON_VERTICES_MOST);
    return array_push(w->ctx, vertices, position) ? FRAM_OK : error_memory(w->error);
}

fram_status outline_ring_end(outline_walk *w, bool implied)
{
    polygon_list *rings = &w->out->rings;
    int32_t count = rings->vertex.count - w->first;
    const vec2 *v = rings->vertex.data + w->first;
    bool repeated = count >= 2 && v[0].x == v[count - 1].x && v[0].y == v[count - 1].y;
    w->place.open = !repeated && !implied;
    rings->vertex.count -= repeated;
    if ((rings->start.count == 0 && !array_push(w->ctx, &rings->start, 0)) ||
        !array_push(w->ctx, &w->out->place, w->place) || !array_push(w->ctx, &rings->start, rings->vertex.count))
        return error_memory(w->error);
    w->place.ring = 0;
    return FRAM_OK;
}

/* ---- plain points ---- */

/* What parts two numbers. */
static void skip_separator(outline_walk *w)
{
    outline_skip_blanks(w);
    if (w->at < w->end && (*w->at == ',' || *w->at == ';'))
        w->at++;
    outline_skip_blanks(w);
}

static bool at_line_end(const outline_walk *w) { return w->at == w->end || *w->at == '\n'; }

static fram_status read_point(outline_walk *w)
{
    vec2 p = {0, 0};
    fram_status status = outline_number(w, &p.x);
    if (status == FRAM_OK) {
        skip_separator(w);
        status = outline_number(w, &p.y);
    }
    if (status != FRAM_OK)
        return status;
    outline_skip_blanks(w);
    if (!at_line_end(w))
        return outline_refuse(w, "expected x and y on a line, found more");
    return outline_ring_add(w, p);
}

/* The outline at work has come back to its first position. */
static bool is_closed(const outline_walk *w)
{
    int32_t count = w->out->rings.vertex.count - w->first;
    const vec2 *v = w->out->rings.vertex.data + w->first;
    return count > 3 && v[0].x == v[count - 1].x && v[0].y == v[count - 1].y;
}

/* behind: the walk at the first row after one that closed the outline, if its line is not 0.  One that is closed again
   in the end touches itself there; other rows are the next outline, which nothing divides from it. */
static fram_status end_points(outline_walk *w, outline_walk *behind)
{
    if (w->place.ring == 0)
        return FRAM_OK;
    if (behind->line > 0 && !is_closed(w))
        return outline_refuse(behind, "the row before closes its outline: outlines are divided by a blank line");
    behind->line = 0;
    return outline_ring_end(w, true);
}

static fram_status outline_read_points(outline_walk *w)
{
    fram_status status = FRAM_OK;
    outline_walk behind = {.line = 0};
    for (; status == FRAM_OK && w->at < w->end; outline_skip_line(w)) {
        outline_skip_blanks(w);
        if (w->at < w->end && *w->at == '#')
            continue;
        if (at_line_end(w) || *w->at == '>') {
            status = end_points(w, &behind);
            continue;
        }
        if (w->place.ring == 0) {
            w->place.feature++;
            w->place.polygon = 1;
            status = outline_ring_begin(w, 1);
        } else if (behind.line == 0 && is_closed(w)) {
            behind = *w;
        }
        if (status == FRAM_OK)
            status = read_point(w);
    }
    return status == FRAM_OK ? end_points(w, &behind) : status;
}

/* ---- forms ---- */

/* The first character that is neither blank nor in a line that begins with #; 0 when there is none. */
static char first_character(const char *data, size_t size)
{
    bool begun = false, comment = false;
    for (size_t i = 0; i < size; i++) {
        char c = data[i];
        if (c == '\n') {
            begun = comment = false;
        } else if (!comment && c != ' ' && c != '\t' && c != '\r') {
            if (begun || c != '#')
                return c;
            comment = true;
        }
    }
    return 0;
}

fram_status outline_file_parse(context *ctx, const char *name, const char *data, size_t size, import_rings *out,
                               fram_error *error)
{
    size_t mark = utf8_mark(data, size);
    data += mark;
    size -= mark;
    char c = first_character(data, size);
    if (c == '{' || c == '[')
        return geojson_parse(ctx, name, data, size, out, error);
    outline_walk w = {.ctx = ctx,
                      .name = name,
                      .at = data,
                      .end = data + size,
                      .line_start = data,
                      .line = 1,
                      .out = out,
                      .error = error};
    fram_status status;
    if (size > 0 && memchr(data, '\0', size))
        status =
            outline_refuse(&w, "expected GeoJSON, WKT or lines of x and y, found a binary file: export GeoJSON, as "
                               "\"ogr2ogr\" does of a Shapefile or a GeoPackage");
    else if ((c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'))
        status = outline_read_wkt(&w);
    else if ((c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == '>')
        status = outline_read_points(&w);
    else
        status = outline_refuse(&w, "expected GeoJSON, WKT or lines of x and y, found %s",
                                c ? "none of them" : "an empty file");
    if (status != FRAM_OK)
        import_rings_free(ctx, out);
    return status;
}

fram_status outline_file_read(context *ctx, const char *path, import_rings *out, fram_error *error)
{
    char *data = NULL;
    size_t size = 0;
    fram_status status = file_read(ctx, path, GEOJSON_BYTES_MOST, &data, &size, error);
    if (status == FRAM_OK)
        status = outline_file_parse(ctx, path, data, size, out, error);
    memory_free(ctx, data);
    return status;
}
