/* STL, text and binary (3D Systems, StereoLithography Interface Specification, 1989).  Normals are read and not used:
   the order of the corners says the same. */
#include "io/mesh_reader.h"

#include "base/number_text.h"

#include <string.h>

enum { HEADER = 80, PREFIX = HEADER + 4, FACET = 50 };

_Static_assert(sizeof(float) == 4, "STL holds 4-byte floats");

static uint32_t read_u32(const char *at)
{
    const unsigned char *b = (const unsigned char *)at;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static float read_float(const char *at)
{
    uint32_t bits = read_u32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

bool mesh_is_binary_stl(const char *data, size_t size)
{
    return size >= PREFIX && size == PREFIX + (size_t)read_u32(data + HEADER) * FACET;
}

mesh_format mesh_solid_format(const char *data, size_t size)
{
    size_t head = size < PREFIX ? size : PREFIX;
    return mesh_is_binary_stl(data, size) || memchr(data, '\0', head) ? MESH_STL_BINARY : MESH_STL_TEXT;
}

/* Headers of binary files may be all text, but not the number of facets after them: it would be 150 million or more. */
static bool is_text(const char *data)
{
    for (int i = 0; i < PREFIX; i++) {
        unsigned char c = (unsigned char)data[i];
        if (c < ' ' && c != '\n' && c != '\r' && c != '\t')
            return false;
    }
    return true;
}

static fram_status read_binary(const mesh_reading *r, const char *data, size_t size)
{
    if (size < PREFIX)
        return mesh_refuse(r, 0, 0, "expected at least %d bytes of a binary STL file (or the word solid), found %zu",
                           PREFIX, size);
    if (is_text(data))
        return mesh_refuse(r, 1, 0, "expected an STL file, which begins with the word solid or is binary, found %s",
                           mesh_looks_like_obj(data, size)   ? "OBJ; let its name end in .obj"
                           : mesh_looks_like_gdf(data, size) ? "a GDF file; let its name end in .gdf"
                                                             : "other text; export the surface as STL or OBJ");
    uint32_t count = read_u32(data + HEADER);
    if (!mesh_is_binary_stl(data, size))
        return mesh_refuse(
            r, 0, 0, "a binary STL file of %u facets is %llu bytes long, but this one is %zu; it is %s, or no STL file",
            count, (unsigned long long)count * FACET + PREFIX, size,
            size < (unsigned long long)count * FACET + PREFIX ? "cut short" : "padded");
    if (count > MESH_FILE_TRIANGLES)
        return mesh_refuse(r, 0, 0, "expected at most %d facets, found %u", MESH_FILE_TRIANGLES, count);
    r->out->elements = (int32_t)count;
    mesh *m = &r->out->surface;
    for (int32_t i = 0; i < (int32_t)count; i++) {
        const char *at = data + PREFIX + (size_t)i * FACET + 12;
        for (int k = 0; k < 9; k += 3) {
            double p[3];
            for (int c = 0; c < 3; c++) {
                p[c] = (double)read_float(at + 4 * (k + c));
                if (!isfinite(p[c]))
                    return mesh_refuse(r, 0, i + 1, "coordinate %d of corner %d is not a finite number", c + 1,
                                       k / 3 + 1);
                fram_status status = mesh_check_number(r, 0, i + 1, p[c]);
                if (status != FRAM_OK)
                    return status;
            }
            /* Adding 0 makes a zero of either sign the same point. */
            if (!mesh_add_vertex(r->ctx, m, vec3_make(p[0] + 0.0, p[1] + 0.0, p[2] + 0.0)))
                return error_memory(r->error);
        }
        fram_status status = mesh_place_triangle(r, 3 * i, 3 * i + 1, 3 * i + 2, i + 1, 0);
        if (status != FRAM_OK)
            return status;
    }
    return FRAM_OK;
}

/* ---- text ---- */

static fram_status expect_word(const mesh_reading *r, word_reader *w, int32_t facet, const char *word)
{
    if (word_next(w) && word_is(w, word))
        return FRAM_OK;
    if (!w->length)
        return mesh_refuse(r, w->word_line, facet, "expected \"%s\", found the end of the file", word);
    return mesh_refuse(r, w->word_line, facet, "expected \"%s\", found \"%.*s\"", word, word_shown(w), w->word);
}

static fram_status read_facet_vertex(const mesh_reading *r, word_reader *w, int32_t facet)
{
    double p[3];
    fram_status status = expect_word(r, w, facet, "vertex");
    for (int c = 0; c < 3 && status == FRAM_OK; c++) {
        if (!word_next(w))
            return mesh_refuse(r, w->word_line, facet, "expected coordinate %d of a vertex, found the end of the file",
                               c + 1);
        status = mesh_read_number(r, w, facet, "a coordinate [m]", &p[c]);
    }
    if (status == FRAM_OK && !mesh_add_vertex(r->ctx, &r->out->surface, vec3_make(p[0] + 0.0, p[1] + 0.0, p[2] + 0.0)))
        return error_memory(r->error);
    return status;
}

/* After the word facet: its normal, which may be anything, and three vertices. */
static fram_status read_facet(const mesh_reading *r, word_reader *w, int32_t facet)
{
    int32_t line = w->word_line, first = r->out->surface.vertex.count;
    fram_status status = expect_word(r, w, facet, "normal");
    for (int c = 0; c < 3 && status == FRAM_OK; c++)
        if (!word_next(w) || word_is(w, "outer"))
            return mesh_refuse(r, w->word_line, facet, "expected the three numbers of the normal, found %d", c);
    if (status == FRAM_OK)
        status = expect_word(r, w, facet, "outer");
    if (status == FRAM_OK)
        status = expect_word(r, w, facet, "loop");
    for (int k = 0; k < 3 && status == FRAM_OK; k++)
        status = read_facet_vertex(r, w, facet);
    if (status == FRAM_OK)
        status = expect_word(r, w, facet, "endloop");
    if (status == FRAM_OK)
        status = expect_word(r, w, facet, "endfacet");
    return status == FRAM_OK ? mesh_place_triangle(r, first, first + 1, first + 2, facet, line) : status;
}

static fram_status read_text(const mesh_reading *r, const char *data, size_t size)
{
    word_reader w = word_reader_begin(data, size);
    fram_status status = FRAM_OK;
    int32_t facets = 0;
    while (status == FRAM_OK && word_next(&w)) {
        if (!word_is(&w, "solid"))
            return mesh_refuse(r, w.word_line, 0, "expected \"solid\", found \"%.*s\"", word_shown(&w), w.word);
        word_skip_line(&w);
        while (status == FRAM_OK && word_next(&w) && word_is(&w, "facet"))
            status = facets < MESH_FILE_TRIANGLES
                         ? read_facet(r, &w, ++facets)
                         : mesh_refuse(r, w.word_line, 0, "expected at most %d facets", MESH_FILE_TRIANGLES);
        if (status != FRAM_OK)
            return status;
        if (!w.length)
            return mesh_refuse(r, w.word_line, 0,
                               "expected \"facet\" or \"endsolid\" after facet %d, found the end of the file", facets);
        if (!word_is(&w, "endsolid"))
            return mesh_refuse(r, w.word_line, 0, "expected \"facet\" or \"endsolid\" after facet %d, found \"%.*s\"",
                               facets, word_shown(&w), w.word);
        word_skip_line(&w);
    }
    r->out->elements = facets;
    return status;
}

fram_status mesh_read_stl(const mesh_reading *r, const char *data, size_t size)
{
    return r->out->format == MESH_STL_TEXT ? read_text(r, data, size) : read_binary(r, data, size);
}

/* ---- writing ---- */

static void add_point(context *ctx, text_buffer *out, const char *before, vec3 p)
{
    char x[NUMBER_TEXT_SIZE], y[NUMBER_TEXT_SIZE], z[NUMBER_TEXT_SIZE];
    real_to_text(p.x, x);
    real_to_text(p.y, y);
    real_to_text(p.z, z);
    text_format(ctx, out, "%s %s %s %s\n", before, x, y, z);
}

void mesh_write_stl_text(context *ctx, const mesh *m, text_buffer *out)
{
    text_add(ctx, out, "solid hull\n");
    for (int32_t f = 0; f < m->face.count; f++) {
        vec3 p[3];
        mesh_face_points(m, f, p);
        add_point(ctx, out, "facet normal", vec3_unit(mesh_area_vector(m, f)));
        text_add(ctx, out, "  outer loop\n");
        for (int k = 0; k < 3; k++)
            add_point(ctx, out, "    vertex", p[k]);
        text_add(ctx, out, "  endloop\nendfacet\n");
    }
    text_add(ctx, out, "endsolid hull\n");
}

static void store_u32(char *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (char)(unsigned char)(value >> (8 * i));
}

static void put_point(char *at, vec3 p)
{
    const float value[3] = {(float)p.x, (float)p.y, (float)p.z};
    for (int c = 0; c < 3; c++) {
        uint32_t bits;
        memcpy(&bits, &value[c], sizeof bits);
        store_u32(at + 4 * c, bits);
    }
}

void mesh_write_stl_binary(context *ctx, const mesh *m, text_buffer *out)
{
    char prefix[PREFIX] = "a hull, metres";
    store_u32(prefix + HEADER, (uint32_t)m->face.count);
    text_add_bytes(ctx, out, prefix, sizeof prefix);
    for (int32_t f = 0; f < m->face.count; f++) {
        vec3 p[3];
        char facet[FACET] = {0};
        mesh_face_points(m, f, p);
        put_point(facet, vec3_unit(mesh_area_vector(m, f)));
        for (int k = 0; k < 3; k++)
            put_point(facet + 12 * (k + 1), p[k]);
        text_add_bytes(ctx, out, facet, sizeof facet);
    }
}
