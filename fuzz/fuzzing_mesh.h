/* What the fuzz targets of the mesh readers share: any bytes as a file of one format, through to a sound solid.
   Promises: a refusal names the file and says why; what is read has finite coordinates and a place for every triangle;
   a hull that passes is closed, whatever was done to it, and reads back as it was written. */
#ifndef FUZZING_MESH_H
#define FUZZING_MESH_H

#include "fuzzing.h"
#include "io/hull_file.h"
#include "io/mesh_reader.h"
#include <math.h>
#include <string.h>

/* Larger surfaces are only read: their checks take too long to find anything. */
enum { FUZZ_TRIANGLES = 400 };

static inline void fuzz_refusal(fram_status status, const fram_error *error)
{
    PROMISE(status == FRAM_ERROR_INPUT);
    PROMISE(error->status == status && strcmp(error->file, "fuzz") == 0 && error->message[0] != '\0');
}

static inline void fuzz_surface(const mesh_file *f)
{
    const mesh *m = &f->surface;
    PROMISE(m->face.count > 0 && f->element.count == m->face.count && f->line.count == m->face.count);
    for (int32_t i = 0; i < m->vertex.count; i++) {
        vec3 p = m->vertex.data[i];
        PROMISE(fabs(p.x) <= MESH_FILE_REACH && fabs(p.y) <= MESH_FILE_REACH && fabs(p.z) <= MESH_FILE_REACH);
    }
    for (int32_t i = 0; i < m->face.count; i++) {
        const int32_t *v = m->face.data[i].v;
        for (int k = 0; k < 3; k++)
            PROMISE(v[k] >= 0 && v[k] < m->vertex.count);
        PROMISE(v[0] != v[1] && v[1] != v[2] && v[2] != v[0]);
        PROMISE(f->element.data[i] >= 1 && f->element.data[i] <= f->elements);
    }
}

/* As text, which is exact: the 4-byte floats of a binary file may lay corners of a narrow triangle together. */
static inline void fuzz_round_trip(context *ctx, mesh_format format, const mesh *m)
{
    static void (*const write[MESH_FORMAT_COUNT])(context *, const mesh *, text_buffer *) = {
        mesh_write_stl_text, mesh_write_obj, mesh_write_obj, mesh_write_gdf};
    mesh_format exact = format == MESH_STL_BINARY ? MESH_OBJ : format;
    box3 box = mesh_bounds(m);
    double reach = fmax(fmax(fabs(box.lo.x), fabs(box.hi.x)),
                        fmax(fmax(fabs(box.lo.y), fabs(box.hi.y)), fmax(fabs(box.lo.z), fabs(box.hi.z))));
    if (reach > MESH_FILE_REACH) /* topsides that were added may be beyond what is read */
        return;
    text_buffer text = {0};
    write[exact](ctx, m, &text);
    if (!text.failed) {
        mesh_file again;
        fram_error error = {0};
        double size = vec3_length(vec3_sub(box.hi, box.lo));
        PROMISE(mesh_file_parse_as(ctx, "fuzz", exact, text.data, (size_t)text.count, &again, &error) == FRAM_OK);
        PROMISE(again.surface.face.count == m->face.count);
        PROMISE(fabs(mesh_solid_properties(&again.surface).volume - mesh_solid_properties(m).volume) <=
                1e-9 * size * size * size);
        mesh_file_free(ctx, &again);
    }
    text_free(ctx, &text);
}

static inline void fuzz_hull(context *ctx, mesh_format format, const char *text, size_t size, bool repair)
{
    mesh_file f;
    fram_error error = {0};
    fram_status status = mesh_file_parse_as(ctx, "fuzz", format, text, size, &f, &error);
    if (status != FRAM_OK) {
        fuzz_refusal(status, &error);
        return;
    }
    fuzz_surface(&f);
    if (f.surface.face.count > FUZZ_TRIANGLES) {
        mesh_file_free(ctx, &f);
        return;
    }
    hull_file_options options = hull_file_defaults();
    options.repair = repair;
    options.freeboard = repair ? 1 : options.freeboard;
    mesh m = {0};
    hull_file_report report;
    status = hull_file_finish(ctx, "fuzz", &f, &options, &m, &report, &error);
    if (status == FRAM_OK) {
        mesh_report found;
        PROMISE(mesh_check(ctx, &m, true, &found) == FRAM_OK && found.defect == MESH_CLOSED);
        PROMISE(mesh_solid_properties(&m).volume > 0);
        fuzz_round_trip(ctx, format, &m);
    } else {
        fuzz_refusal(status, &error);
    }
    mesh_free(ctx, &m);
}

static inline int fuzz_mesh(mesh_format format, const uint8_t *data, size_t size)
{
    context ctx;
    context_init(&ctx);
    char *text = malloc(size + 1);
    if (!text)
        return 0;
    if (size)
        memcpy(text, data, size);
    text[size] = '\0';
    fuzz_hull(&ctx, format, text, size, false);
    fuzz_hull(&ctx, format, text, size, true);
    free(text);
    return 0;
}

#endif
