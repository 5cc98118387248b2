/* geojson_parse and the import on any bytes, dropping and repairing, cropped and simplified.
   Promises: a refusal says why and where; what is taken in is sound: every floe is a valid ring, reaches no farther
   than the window, and has a place in the file. */
#include "fuzzing.h"
#include "io/geojson.h"
#include <string.h>

/* Overlays of rings of thousands of vertices that all cross are slow, and no finding. */
enum { VERTICES_MOST = 300 };

static void check_refusal(fram_status status, const fram_error *error)
{
    if (status != FRAM_OK)
        PROMISE(error->status == status && error->message[0] != '\0');
}

static void check_field(overlay *plane, const import_rings *rings, const import_field *field, box2 window)
{
    int32_t count = polygon_list_count(&field->outlines);
    PROMISE(count > 0 && count == field->ring.count && count == field->thickness.count);
    for (int32_t i = 0; i < count; i++) {
        polygon p = polygon_list_get(&field->outlines, i);
        box2 box = polygon_bounds(p);
        PROMISE(overlay_is_valid(plane, p, NULL, NULL));
        PROMISE(box.lo.x >= window.lo.x - 1e-6 && box.lo.y >= window.lo.y - 1e-6);
        PROMISE(box.hi.x <= window.hi.x + 1e-6 && box.hi.y <= window.hi.y + 1e-6);
        PROMISE(field->ring.data[i] >= 0 && field->ring.data[i] < rings->place.count);
    }
}

static void import_all(context *ctx, overlay *plane, const import_rings *rings, import_bad bad)
{
    const import_options options = {.name = "input",
                                    .scale = 1,
                                    .crop = true,
                                    .domain = {{-1000, -1000}, {1000, 1000}},
                                    .simplify = bad == IMPORT_DROP ? 0.5 : 0,
                                    .bad = bad,
                                    .smallest_area = 1e-3};
    import_field field = {0};
    import_measure measure;
    fram_error error = {0};
    fram_status status = import_field_make(ctx, plane, rings, &options, &field, &error);
    check_refusal(status, &error);
    if (status == FRAM_OK) {
        check_field(plane, rings, &field, options.domain);
        status = import_field_measure(ctx, plane, NULL, &field.outlines, &measure, &error);
        check_refusal(status, &error);
    }
    import_field_free(ctx, &field);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    context ctx;
    context_init(&ctx);
    import_rings rings = {0};
    fram_error error = {0};
    fram_status status = geojson_parse(&ctx, "input", (const char *)data, size, &rings, &error);
    check_refusal(status, &error);
    if (status != FRAM_OK) {
        PROMISE(status == FRAM_ERROR_INPUT && error.line > 0 && error.column > 0);
        return 0;
    }
    PROMISE(polygon_list_count(&rings.rings) == rings.place.count);
    overlay *plane = overlay_create(&ctx);
    for (int bad = IMPORT_REFUSE; plane && rings.rings.vertex.count <= VERTICES_MOST && bad <= IMPORT_REPAIR; bad++)
        import_all(&ctx, plane, &rings, (import_bad)bad);
    if (plane)
        overlay_free(plane);
    import_rings_free(&ctx, &rings);
    return 0;
}
