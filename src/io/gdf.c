/* WAMIT's low-order geometric data file (WAMIT User Manual, version 7, section 6.1): a line of text, ULEN GRAV, ISX
   ISY, NPAN, then four corners a panel, counter-clockwise seen from the water.  A corner given twice makes a triangle.
   Words after the numbers of a header line are passed over, as WAMIT does.
   Coordinates are in metres: ULEN only scales WAMIT's results.  ISX = 1 (ISY = 1): the other half is the mirror image
   in x = 0 (y = 0). */
#include "io/mesh_reader.h"

#include "base/number_text.h"

#include <string.h>

/* Gravity that is that of the earth in another unit tells in which one lengths are. */
static const struct {
    double least, most, metres;
    const char *name;
} gdf_units[] = {{31, 33, 0.3048, "feet"},
                 {380, 392, 0.0254, "inches"},
                 {970, 990, 0.01, "centimetres"},
                 {9700, 9900, 0.001, "millimetres"}};

typedef struct gdf_words {
    word_reader reader;
    const char *rest, *rest_end;
} gdf_words;

/* Commas separate numbers as blanks do, so that a word may hold several.  next: word_next, or of this line alone. */
static bool next_number(gdf_words *w, bool (*next)(word_reader *r))
{
    while (w->rest < w->rest_end && *w->rest == ',')
        ++w->rest;
    while (w->rest == w->rest_end) {
        if (!next(&w->reader))
            return false;
        w->rest = w->reader.word;
        w->rest_end = w->reader.word + w->reader.length;
        while (w->rest < w->rest_end && *w->rest == ',')
            ++w->rest;
    }
    w->reader.word = w->rest;
    while (w->rest < w->rest_end && *w->rest != ',')
        ++w->rest;
    w->reader.length = (size_t)(w->rest - w->reader.word);
    return true;
}

static fram_status read_real(const mesh_reading *r, gdf_words *w, int32_t panel, const char *what, double *value)
{
    if (!next_number(w, word_next))
        return mesh_refuse(r, w->reader.line, panel, "expected %s, found the end of the file", what);
    return mesh_read_number(r, &w->reader, panel, what, value);
}

static fram_status read_integer(const mesh_reading *r, gdf_words *w, const char *what, int64_t lo, int64_t hi,
                                int64_t *value)
{
    char text[32] = "";
    word_reader *d = &w->reader;
    if (!next_number(w, word_next))
        return mesh_refuse(r, d->line, 0, "expected %s, found the end of the file", what);
    if (d->length < sizeof text)
        memcpy(text, d->word, d->length);
    if (strlen(text) != d->length || integer_from_text(text, value) != NUMBER_GOOD || *value < lo || *value > hi)
        return mesh_refuse(r, d->word_line, 0, "expected %s from %lld to %lld, found \"%.*s\"", what, (long long)lo,
                           (long long)hi, word_shown(d), d->word);
    return FRAM_OK;
}

/* What follows on a header's line is for people: WAMIT reads the numbers that it wants and goes on in the next line. */
static void skip_words(gdf_words *w)
{
    w->rest = w->rest_end;
    word_skip_line(&w->reader);
}

bool mesh_looks_like_gdf(const char *data, size_t size)
{
    gdf_words w = {.reader = word_reader_begin(data, size)};
    mesh_file none = {.format = MESH_GDF};
    const mesh_reading r = {.out = &none};
    for (int line = 2; line <= 3; line++) {
        skip_words(&w);
        for (int i = 0; i < 2; i++) {
            double value;
            if (!next_number(&w, word_next_in_line) ||
                mesh_read_number(&r, &w.reader, 0, "a number", &value) != FRAM_OK)
                return false;
        }
    }
    return true;
}

static fram_status read_lengths(const mesh_reading *r, gdf_words *w)
{
    double length = 0, gravity = 0;
    fram_status status = read_real(r, w, 0, "ULEN, the length scale", &length);
    if (status == FRAM_OK)
        status = read_real(r, w, 0, "GRAV, the acceleration of gravity", &gravity);
    if (status != FRAM_OK)
        return status;
    int32_t line = w->reader.word_line;
    skip_words(w);
    if (!(length > 0))
        return mesh_refuse(r, line, 0, "expected a positive ULEN, found %g; a control surface or force file is no hull",
                           length);
    if (!(gravity > 0))
        return mesh_refuse(r, line, 0, "expected a positive GRAV, found %g", gravity);
    for (size_t i = 0; i < sizeof gdf_units / sizeof *gdf_units; i++)
        if (gravity > gdf_units[i].least && gravity < gdf_units[i].most)
            r->out->unit = (mesh_file_unit){gdf_units[i].name, gdf_units[i].metres, gravity, line};
    return FRAM_OK;
}

static fram_status read_symmetry(const mesh_reading *r, gdf_words *w)
{
    int64_t isx = 0, isy = 0;
    fram_status status = read_integer(r, w, "ISX", 0, 1, &isx);
    if (status == FRAM_OK)
        status = read_integer(r, w, "ISY", 0, 1, &isy);
    if (status == FRAM_OK)
        skip_words(w);
    r->out->mirror_x = isx == 1;
    r->out->mirror_y = isy == 1;
    return status;
}

/* NPAN; a second integer is the IGDEF of a higher-order file (section 7), of which only flat quadrilaterals (0) are
   panels. */
static fram_status read_count(const mesh_reading *r, gdf_words *w, int32_t *panels)
{
    int64_t count = 0, kind = 0;
    fram_status status =
        read_integer(r, w, "NPAN, the number of panels of a low-order file,", 1, MESH_FILE_TRIANGLES / 8, &count);
    if (status != FRAM_OK)
        return status;
    *panels = (int32_t)count;
    int32_t line = w->reader.word_line;
    word_reader after = w->reader;
    char text[32] = "";
    if (w->rest == w->rest_end && word_next_in_line(&after) && after.length < sizeof text)
        memcpy(text, after.word, after.length);
    if (text[0] && integer_from_text(text, &kind) == NUMBER_GOOD && kind != 0)
        return mesh_refuse(r, line, 0,
                           "IGDEF %lld says that this is a higher-order GDF file (%s), whose patches are no panels; "
                           "export low-order panels (ILOWHI 0)",
                           (long long)kind,
                           kind == 1   ? "B-splines"
                           : kind == 2 ? "a MultiSurf model"
                                       : "a shape that WAMIT computes itself");
    skip_words(w);
    return FRAM_OK;
}

static fram_status read_head(const mesh_reading *r, gdf_words *w, int32_t *panels)
{
    word_skip_line(&w->reader);
    fram_status status = read_lengths(r, w);
    if (status == FRAM_OK)
        status = read_symmetry(r, w);
    return status == FRAM_OK ? read_count(r, w, panels) : status;
}

/* A panel, and its mirror images, which are turned the other way. */
static fram_status place_panel(const mesh_reading *r, const vec3 corner[4], int32_t panel, int32_t line)
{
    mesh *m = &r->out->surface;
    for (int image = 0; image < 4; image++) {
        bool x = image & 1, y = image & 2;
        if ((x && !r->out->mirror_x) || (y && !r->out->mirror_y))
            continue;
        int32_t ring[4], first = m->vertex.count;
        for (int k = 0; k < 4; k++) {
            vec3 p = corner[x != y ? 3 - k : k];
            /* Adding 0: a point on the plane is its own image, to the sign. */
            if (!mesh_add_vertex(r->ctx, m, vec3_make((x ? -p.x : p.x) + 0.0, (y ? -p.y : p.y) + 0.0, p.z)))
                return error_memory(r->error);
            ring[k] = first + k;
        }
        fram_status status = mesh_place_polygon(r, ring, 4, panel, line);
        if (status != FRAM_OK)
            return status;
    }
    return FRAM_OK;
}

/* More panels, numbers that begin a line or go on over lines; anything else after the last panel is for people.  The
   reader is at the first of the numbers then. */
static bool goes_on(gdf_words *w)
{
    enum { POINT = 3 };
    mesh_file none = {.format = MESH_GDF};
    const mesh_reading r = {.out = &none};
    gdf_words first = *w;
    int numbers = 0;
    while (numbers < POINT && next_number(w, word_next)) {
        double value;
        if (mesh_read_number(&r, &w->reader, 0, "a number", &value) != FRAM_OK) {
            skip_words(w);
            numbers = 0;
        } else if (numbers++ == 0) {
            first = *w;
        }
    }
    *w = first;
    return numbers == POINT;
}

fram_status mesh_read_gdf(const mesh_reading *r, const char *data, size_t size)
{
    gdf_words w = {.reader = word_reader_begin(data, size)};
    int32_t panels = 0;
    fram_status status = read_head(r, &w, &panels);
    for (int32_t i = 1; i <= panels && status == FRAM_OK; i++) {
        double c[12];
        int32_t line = 0;
        for (int k = 0; k < 12 && status == FRAM_OK; k++) {
            status = read_real(r, &w, i, "a coordinate [m] of a panel's four corners", &c[k]);
            line = k == 0 ? w.reader.word_line : line;
        }
        if (status != FRAM_OK)
            return status;
        vec3 corner[4];
        for (int k = 0; k < 4; k++)
            corner[k] = vec3_make(c[3 * k] + 0.0, c[3 * k + 1] + 0.0, c[3 * k + 2] + 0.0);
        status = place_panel(r, corner, i, line);
    }
    if (status == FRAM_OK && goes_on(&w))
        return mesh_refuse(r, w.reader.word_line, 0,
                           "expected the end of the file after %d panels, found \"%.*s\"; NPAN may be too small",
                           panels, word_shown(&w.reader), w.reader.word);
    r->out->elements = panels;
    return status;
}

void mesh_write_gdf(context *ctx, const mesh *m, text_buffer *out)
{
    text_add(ctx, out, "a hull, metres\n1 9.80665\n0 0\n");
    text_format(ctx, out, "%d\n", m->face.count);
    for (int32_t f = 0; f < m->face.count; f++)
        for (int k = 0; k < 4; k++) {
            vec3 p = m->vertex.data[m->face.data[f].v[k < 3 ? k : 2]];
            char x[NUMBER_TEXT_SIZE], y[NUMBER_TEXT_SIZE], z[NUMBER_TEXT_SIZE];
            real_to_text(p.x, x);
            real_to_text(p.y, y);
            real_to_text(p.z, z);
            text_format(ctx, out, "%s %s %s\n", x, y, z);
        }
}
