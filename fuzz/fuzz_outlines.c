/* outline_file_parse on any bytes: GeoJSON, WKT, lines of points; and what ice/import makes of the rings.
   Promises: a refusal says where and why and leaves nothing behind; rings that are taken have places and finite
   vertices; floes that come of them are simple, counter-clockwise and have an area. */
#include "fuzzing.h"
#include "io/outline_file.h"

#include <math.h>
#include <string.h>

/* Overlays of thousands of vertices take their time and find nothing new. */
enum { VERTICES_IMPORTED = 400 };

static void check_rings(const import_rings *r)
{
    PROMISE(r->place.count == polygon_list_count(&r->rings));
    for (int32_t i = 0; i < r->place.count; i++) {
        const import_place *p = &r->place.data[i];
        PROMISE(p->feature > 0 && p->polygon > 0 && p->ring > 0 && p->line > 0 && p->column > 0);
        PROMISE(isnan(p->thickness) || p->thickness > 0);
    }
    for (int32_t i = 0; i < r->rings.vertex.count; i++)
        PROMISE(isfinite(r->rings.vertex.data[i].x) && isfinite(r->rings.vertex.data[i].y));
}

static void check_import(context *ctx, const import_rings *rings)
{
    overlay *plane = overlay_create(ctx);
    import_field field = {0};
    fram_error error = {0};
    const import_options options = {.name = "fuzz", .scale = 1, .bad = IMPORT_DROP};
    fram_status status = plane ? import_field_make(ctx, plane, rings, &options, &field, &error) : FRAM_ERROR_MEMORY;
    PROMISE(status == FRAM_OK || status == FRAM_ERROR_INPUT || status == FRAM_ERROR_MEMORY);
    for (int32_t i = 0; i < polygon_list_count(&field.outlines); i++) {
        polygon p = polygon_list_get(&field.outlines, i);
        PROMISE(p.count >= 3 && polygon_orientation(p) > 0 && !polygon_self_intersects(ctx, p, NULL, NULL));
    }
    import_field_free(ctx, &field);
    overlay_free(plane);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    context ctx;
    context_init(&ctx);
    char *copy = malloc(size + 1);
    if (!copy)
        return 0;
    if (size > 0)
        memcpy(copy, data, size);
    copy[size] = '\0';
    import_rings rings = {0};
    fram_error error = {0};
    fram_status status = outline_file_parse(&ctx, "fuzz", copy, size, &rings, &error);
    if (status == FRAM_OK) {
        check_rings(&rings);
        if (rings.rings.vertex.count <= VERTICES_IMPORTED)
            check_import(&ctx, &rings);
    } else {
        PROMISE(status == FRAM_ERROR_INPUT && error.status == status);
        PROMISE(strcmp(error.file, "fuzz") == 0 && error.message[0] != '\0');
        PROMISE(!rings.place.data && !rings.rings.vertex.data);
    }
    import_rings_free(&ctx, &rings);
    free(copy);
    return 0;
}
