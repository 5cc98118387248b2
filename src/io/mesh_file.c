/* Which reader a file is for, and what the readers share. */
#include "io/mesh_file.h"

#include "base/number_text.h"
#include "geometry/mesh_repair.h"
#include "io/atomic_file.h"
#include "io/mesh_reader.h"
#include "io/utf8.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* ---- words ---- */

/* Characters of a word that a message repeats. */
enum { SHOWN = 40 };

static bool is_space_in_line(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

word_reader word_reader_begin(const char *data, size_t size)
{
    const char *first = data + utf8_mark(data, size);
    return (word_reader){.at = first, .end = data + size, .line = 1, .word = first, .word_line = 1};
}

/* A line feed, or a carriage return that none follows: files of old Macs, and mixtures. */
static bool ends_line(const word_reader *r)
{
    const char *c = r->at;
    if (*c != '\r')
        return *c == '\n';
    bool feeds = r->end - c > 1 && (c[1] == '\n' || (c[1] == '\r' && r->end - c > 2 && c[2] == '\n'));
    return !feeds;
}

static bool continues(const word_reader *r)
{
    if (!r->continued || *r->at != '\\')
        return false;
    const char *next = r->at + 1;
    while (next < r->end && *next == '\r')
        next++;
    return next < r->end && *next == '\n';
}

bool word_next_in_line(word_reader *r)
{
    while (r->at < r->end) {
        if (continues(r)) {
            r->at = memchr(r->at, '\n', (size_t)(r->end - r->at));
            r->line++;
        } else if (!is_space_in_line(*r->at) || ends_line(r)) {
            break;
        }
        r->at++;
    }
    r->word = r->at;
    r->word_line = r->line;
    while (r->at < r->end && !is_space_in_line(*r->at) && !ends_line(r) && !continues(r))
        r->at++;
    r->length = (size_t)(r->at - r->word);
    return r->length > 0;
}

void word_skip_line(word_reader *r)
{
    while (word_next_in_line(r))
        continue;
    if (r->at < r->end) {
        r->at++;
        r->line++;
    }
}

bool word_next(word_reader *r)
{
    while (!word_next_in_line(r)) {
        if (r->at == r->end)
            return false;
        r->at++;
        r->line++;
    }
    return true;
}

bool word_is(const word_reader *r, const char *text)
{
    return r->length == strlen(text) && strncasecmp(r->word, text, r->length) == 0;
}

int word_shown(const word_reader *r) { return r->length < SHOWN ? (int)r->length : SHOWN; }

/* ---- errors and numbers ---- */

fram_status mesh_refuse(const mesh_reading *r, int32_t line, int32_t element, const char *format, ...)
{
    char key[64] = "", message[512];
    if (element > 0)
        snprintf(key, sizeof key, "%s %d", mesh_format_element(r->out->format), element);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return error_set(r->error, FRAM_ERROR_INPUT, r->name, line, key[0] ? key : NULL, "%s", message);
}

fram_status mesh_check_number(const mesh_reading *r, int32_t line, int32_t element, double value)
{
    if (fabs(value) <= MESH_FILE_REACH)
        return FRAM_OK;
    return mesh_refuse(
        r, line, element,
        "expected a coordinate of at most %g, found %g; bring the mesh to metres about the origin in the program that "
        "made the file",
        MESH_FILE_REACH, value);
}

fram_status mesh_read_number(const mesh_reading *r, const word_reader *w, int32_t element, const char *what,
                             double *value)
{
    char text[64];
    int shown = word_shown(w);
    number_fault fault = NUMBER_NOT_A_NUMBER;
    if (w->length < sizeof text) {
        memcpy(text, w->word, w->length);
        text[w->length] = '\0';
        for (char *c = text; *c; c++)
            if (*c == 'D' || *c == 'd')
                *c = 'e';
        if (strlen(text) == w->length)
            fault = real_from_text(text, value);
    }
    if (fault == NUMBER_TOO_LARGE)
        return mesh_refuse(r, w->word_line, element, "expected %s, found \"%.*s\", which is too large", what, shown,
                           w->word);
    if (fault != NUMBER_GOOD)
        return mesh_refuse(r, w->word_line, element, "expected %s, found \"%.*s\"", what, shown, w->word);
    return mesh_check_number(r, w->word_line, element, *value);
}

/* ---- triangles ---- */

static bool push_place(const mesh_reading *r, int32_t element, int32_t line)
{
    return array_push(r->ctx, &r->out->element, element) && array_push(r->ctx, &r->out->line, line);
}

fram_status mesh_place_triangle(const mesh_reading *r, int32_t a, int32_t b, int32_t c, int32_t element, int32_t line)
{
    mesh *m = &r->out->surface;
    const vec3 *p = m->vertex.data;
    bool flat = memcmp(&p[a], &p[b], sizeof *p) == 0 || memcmp(&p[b], &p[c], sizeof *p) == 0 ||
                memcmp(&p[c], &p[a], sizeof *p) == 0;
    if (flat) {
        r->out->dropped++;
        return FRAM_OK;
    }
    if (m->face.count >= MESH_FILE_TRIANGLES)
        return mesh_refuse(r, line, element, "the surface has more than %d triangles", MESH_FILE_TRIANGLES);
    if (!mesh_add_triangle(r->ctx, m, a, b, c) || !push_place(r, element, line))
        return error_memory(r->error);
    return FRAM_OK;
}

fram_status mesh_place_polygon(const mesh_reading *r, int32_t *ring, int32_t count, int32_t element, int32_t line)
{
    mesh *m = &r->out->surface;
    const vec3 *p = m->vertex.data;
    int32_t n = 0;
    for (int32_t i = 0; i < count; i++)
        if (memcmp(&p[ring[i]], &p[ring[n ? n - 1 : count - 1]], sizeof *p) != 0)
            ring[n++] = ring[i];
    if (n < 3) {
        r->out->dropped++;
        return FRAM_OK;
    }
    if (n == 3)
        return mesh_place_triangle(r, ring[0], ring[1], ring[2], element, line);
    int32_t before = m->face.count;
    fram_status status = mesh_add_polygon(r->ctx, m, ring, n);
    if (status == FRAM_ERROR_INPUT)
        return mesh_refuse(r, line, element,
                           "its %d corners cross themselves or lie on a line; split it into triangles", n);
    if (status != FRAM_OK)
        return error_memory(r->error);
    if (m->face.count > MESH_FILE_TRIANGLES)
        return mesh_refuse(r, line, element, "the surface has more than %d triangles", MESH_FILE_TRIANGLES);
    for (int32_t f = before; f < m->face.count; f++)
        if (!push_place(r, element, line))
            return error_memory(r->error);
    return FRAM_OK;
}

/* ---- formats ---- */

const char *mesh_format_name(mesh_format f)
{
    static const char *const names[MESH_FORMAT_COUNT] = {"STL (text)", "STL (binary)", "OBJ", "GDF"};
    return (int)f >= 0 && f < MESH_FORMAT_COUNT ? names[f] : "unknown";
}

const char *mesh_format_element(mesh_format f) { return f == MESH_OBJ ? "face" : f == MESH_GDF ? "panel" : "facet"; }

bool mesh_file_ends_with(const char *name, const char *ending)
{
    size_t length = strlen(name), tail = strlen(ending);
    return length > tail && strcasecmp(name + length - tail, ending) == 0;
}

static fram_status find_format(const mesh_reading *r, const char *data, size_t size)
{
    word_reader w = word_reader_begin(data, size);
    mesh_format *f = &r->out->format;
    if (size == 0)
        return mesh_refuse(r, 0, 0, "the file is empty");
    bool solid = word_next(&w) && word_is(&w, "solid");
    const bool binary = mesh_is_binary_stl(data, size);
    if (binary && (mesh_file_ends_with(r->name, ".obj") || mesh_file_ends_with(r->name, ".gdf")))
        return mesh_refuse(r, 0, 0, "found a binary STL file; let its name end in .stl");
    /* The header of a binary file may be anything, and the title of a GDF. */
    fram_status status = binary || mesh_looks_like_gdf(data, size) ? FRAM_OK : mesh_refuse_others(r, data, size);
    if (status != FRAM_OK)
        return status;
    if (mesh_file_ends_with(r->name, ".stl"))
        *f = solid ? mesh_solid_format(data, size) : MESH_STL_BINARY;
    else if (mesh_file_ends_with(r->name, ".obj"))
        *f = MESH_OBJ;
    else if (mesh_file_ends_with(r->name, ".gdf"))
        *f = MESH_GDF;
    else if (binary)
        *f = MESH_STL_BINARY;
    else if (solid)
        *f = mesh_solid_format(data, size);
    else if (mesh_looks_like_gdf(data, size))
        *f = MESH_GDF;
    else if (mesh_looks_like_obj(data, size))
        *f = MESH_OBJ;
    else
        return mesh_refuse(r, 0, 0,
                           "expected a mesh (STL, OBJ or GDF), found neither its ending nor its content; "
                           "export the surface as STL or OBJ in the program that made the file");
    return FRAM_OK;
}

void mesh_file_free(context *ctx, mesh_file *f)
{
    mesh_free(ctx, &f->surface);
    array_free(ctx, &f->element);
    array_free(ctx, &f->line);
}

/* Points nearer to each other than this part of the longest side are one that an exporter computed twice, as a pole by
   the sine of pi: some rounding steps of doubles, a thousandth of those of floats. */
#define ROUNDING 1e-12

/* The distance at which points are one: 0 when it would take a triangle away. */
static double rounding_of(const mesh *m)
{
    box3 box = mesh_bounds(m);
    vec3 size = vec3_sub(box.hi, box.lo);
    double distance = ROUNDING * fmax(size.x, fmax(size.y, size.z));
    for (int32_t f = 0; f < m->face.count; f++) {
        vec3 p[3];
        mesh_face_points(m, f, p);
        for (int k = 0; k < 3; k++)
            if (!(vec3_length(vec3_sub(p[k], p[(k + 1) % 3])) > 2 * distance))
                return 0;
    }
    return isfinite(distance) ? distance : 0;
}

/* Equal points become one.  No triangle names equal points, so none goes. */
static fram_status finish_mesh(const mesh_reading *r)
{
    mesh *m = &r->out->surface;
    if (m->face.count == 0)
        return mesh_refuse(r, 0, 0, "the file has no triangles with an area");
    int32_t joined = 0;
    if (!mesh_drop_unused_vertices(r->ctx, m) || mesh_weld(r->ctx, m, rounding_of(m), &joined) != FRAM_OK)
        return error_memory(r->error);
    return FRAM_OK;
}

fram_status mesh_file_parse_as(context *ctx, const char *name, mesh_format format, const char *data, size_t size,
                               mesh_file *out, fram_error *error)
{
    *out = (mesh_file){.format = format};
    const mesh_reading r = {ctx, name, out, error};
    fram_status status = format == MESH_OBJ   ? mesh_read_obj(&r, data, size)
                         : format == MESH_GDF ? mesh_read_gdf(&r, data, size)
                                              : mesh_read_stl(&r, data, size);
    if (status == FRAM_OK)
        status = finish_mesh(&r);
    if (status != FRAM_OK) {
        mesh_file_free(ctx, out);
        *out = (mesh_file){0};
    }
    return status;
}

fram_status mesh_file_parse(context *ctx, const char *name, const char *data, size_t size, mesh_file *out,
                            fram_error *error)
{
    *out = (mesh_file){0};
    const mesh_reading r = {ctx, name, out, error};
    fram_status status = find_format(&r, data, size);
    return status == FRAM_OK ? mesh_file_parse_as(ctx, name, out->format, data, size, out, error) : status;
}

fram_status mesh_file_read(context *ctx, const char *path, mesh_file *out, fram_error *error)
{
    char *data = NULL;
    size_t size = 0;
    *out = (mesh_file){0};
    fram_status status = file_read(ctx, path, MESH_FILE_BYTES, &data, &size, error);
    if (status == FRAM_OK)
        status = mesh_file_parse(ctx, path, data, size, out, error);
    memory_free(ctx, data);
    return status;
}

fram_status mesh_file_write_as(context *ctx, const char *path, mesh_format format, const mesh *m, fram_error *error)
{
    static void (*const write[MESH_FORMAT_COUNT])(context *, const mesh *, text_buffer *) = {
        mesh_write_stl_text, mesh_write_stl_binary, mesh_write_obj, mesh_write_gdf};
    text_buffer text = {0};
    write[format](ctx, m, &text);
    fram_status status = text_file_write(ctx, path, &text, error);
    text_free(ctx, &text);
    return status;
}

fram_status mesh_file_write(context *ctx, const char *path, const mesh *m, fram_error *error)
{
    if (mesh_file_ends_with(path, ".stl"))
        return mesh_file_write_as(ctx, path, MESH_STL_BINARY, m, error);
    if (mesh_file_ends_with(path, ".obj"))
        return mesh_file_write_as(ctx, path, MESH_OBJ, m, error);
    if (mesh_file_ends_with(path, ".gdf"))
        return mesh_file_write_as(ctx, path, MESH_GDF, m, error);
    return error_set(error, FRAM_ERROR_USAGE, path, 0, NULL,
                     "expected a name that ends in .stl, .obj or .gdf for a mesh to be written");
}
