/* Wavefront OBJ: vertices and polygonal faces; textures, normals, groups, lines and points are passed over. */
#include "io/mesh_reader.h"

#include "base/number_text.h"

#include <string.h>

/* Most corners of a face: those of a deck are hundreds. */
enum { FACE_CORNERS = 100000 };

static fram_status read_vertex(const mesh_reading *r, word_reader *w)
{
    double p[3];
    for (int c = 0; c < 3; c++) {
        if (!word_next_in_line(w))
            return mesh_refuse(r, w->word_line, 0, "expected the three coordinates of vertex %d, found %d",
                               r->out->surface.vertex.count + 1, c);
        fram_status status = mesh_read_number(r, w, 0, "a coordinate [m]", &p[c]);
        if (status != FRAM_OK)
            return status;
    }
    if (r->out->surface.vertex.count >= 3 * MESH_FILE_TRIANGLES)
        return mesh_refuse(r, w->word_line, 0, "expected at most %d vertices", 3 * MESH_FILE_TRIANGLES);
    if (!mesh_add_vertex(r->ctx, &r->out->surface, vec3_make(p[0] + 0.0, p[1] + 0.0, p[2] + 0.0)))
        return error_memory(r->error);
    return FRAM_OK;
}

/* "7", "7/1", "7//3", "7/1/3", "-2": the vertex, from 0.  Texture and normal numbers must be numbers. */
static fram_status read_corner(const mesh_reading *r, const word_reader *w, int32_t face, int32_t *vertex)
{
    char text[64];
    int64_t number[3] = {0};
    size_t length = w->length < sizeof text ? w->length : 0;
    memcpy(text, w->word, length);
    text[length] = '\0';
    bool good = length > 0 && strlen(text) == length;
    char *part = text;
    for (int i = 0; good && part; i++) {
        char *slash = strchr(part, '/');
        if (slash)
            *slash = '\0';
        bool absent = i == 1 && !*part && slash;
        good = i < 3 && (absent || integer_from_text(part, &number[i]) == NUMBER_GOOD);
        part = slash ? slash + 1 : NULL;
    }
    if (!good)
        return mesh_refuse(r, w->word_line, face, "expected a corner such as 7, 7/1, 7//3 or 7/1/3, found \"%.*s\"",
                           word_shown(w), w->word);
    int32_t count = r->out->surface.vertex.count;
    if (number[0] == 0 || number[0] > count || number[0] < -(int64_t)count)
        return mesh_refuse(r, w->word_line, face,
                           "names vertex %lld, but %d vertices are given so far, counted from 1 (or back from -1)",
                           (long long)number[0], count);
    *vertex = (int32_t)(number[0] > 0 ? number[0] - 1 : count + number[0]);
    return FRAM_OK;
}

static fram_status read_face(const mesh_reading *r, word_reader *w, int32_t face, int32_array *ring)
{
    int32_t line = w->word_line;
    array_clear(ring);
    while (word_next_in_line(w) && w->word[0] != '#') {
        int32_t vertex = 0;
        fram_status status = read_corner(r, w, face, &vertex);
        if (status != FRAM_OK)
            return status;
        if (ring->count >= FACE_CORNERS)
            return mesh_refuse(r, line, face, "expected at most %d corners of a face", FACE_CORNERS);
        if (!array_push(r->ctx, ring, vertex))
            return error_memory(r->error);
    }
    if (ring->count < 3)
        return mesh_refuse(r, line, face, "expected at least 3 corners of a face, found %d", ring->count);
    return mesh_place_polygon(r, ring->data, ring->count, face, line);
}

static bool is_among(const word_reader *w, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (word_is(w, words[i]))
            return true;
    return false;
}

/* What is passed over: a comment or a name, which is as it stands, and numbers. */
static bool is_plain_text(const word_reader *w)
{
    static const char *const words[] = {"o", "g", "usemtl", "mtllib", "usemap", "maplib", "shadow_obj", "trace_obj"};
    return is_among(w, words, sizeof words / sizeof *words) || w->word[0] == '#';
}

static bool is_of_numbers(const word_reader *w)
{
    static const char *const words[] = {"vt", "vn", "s", "l", "p", "lod", "bevel", "c_interp", "d_interp", "mg"};
    return is_among(w, words, sizeof words / sizeof *words);
}

/* The rest of a line, which a backslash does not continue where it is text, as in the name of a folder. */
static void leave_line(word_reader *w)
{
    while (w->length > 0 && !is_plain_text(w) && word_next_in_line(w))
        continue;
    w->continued = false;
    word_skip_line(w);
    w->continued = true;
}

fram_status mesh_read_obj(const mesh_reading *r, const char *data, size_t size)
{
    word_reader w = word_reader_begin(data, size);
    w.continued = true;
    int32_array ring = {0};
    fram_status status = FRAM_OK;
    int32_t faces = 0;
    while (status == FRAM_OK && word_next(&w)) {
        if (word_is(&w, "v"))
            status = read_vertex(r, &w);
        else if (word_is(&w, "f"))
            status = read_face(r, &w, ++faces, &ring);
        else if (!is_plain_text(&w) && !is_of_numbers(&w))
            status =
                mesh_refuse(r, w.word_line, 0,
                            "expected a vertex (v) or a face (f), found \"%.*s\"; curves and surfaces must be made "
                            "into faces first",
                            word_shown(&w), w.word);
        leave_line(&w);
    }
    array_free(r->ctx, &ring);
    r->out->elements = faces;
    return status;
}

void mesh_write_obj(context *ctx, const mesh *m, text_buffer *out)
{
    text_add(ctx, out, "# a hull, metres\n");
    for (int32_t v = 0; v < m->vertex.count; v++) {
        char x[NUMBER_TEXT_SIZE], y[NUMBER_TEXT_SIZE], z[NUMBER_TEXT_SIZE];
        real_to_text(m->vertex.data[v].x, x);
        real_to_text(m->vertex.data[v].y, y);
        real_to_text(m->vertex.data[v].z, z);
        text_format(ctx, out, "v %s %s %s\n", x, y, z);
    }
    for (int32_t f = 0; f < m->face.count; f++) {
        const int32_t *v = m->face.data[f].v;
        text_format(ctx, out, "f %d %d %d\n", v[0] + 1, v[1] + 1, v[2] + 1);
    }
}
