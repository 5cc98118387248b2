#include "io/template_file.h"

#include "io/outline_file.h"

static fram_status none_sound(const char *path, const import_rings *rings, fram_error *error)
{
    return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                     "none of its %d outlines can be the shape of a floe: each crosses itself, has no area or fewer "
                     "than 3 vertices; \"fram field\" with this file names the first fault",
                     (int)rings->place.count);
}

fram_status template_file_read(context *ctx, overlay *o, const char *path, polygon_list *out, fram_error *error)
{
    import_rings rings = {0};
    import_field field = {0};
    const import_options options = {.name = path,
                                    .scale = 1,
                                    .bad = IMPORT_DROP,
                                    .as_it_is = true,
                                    .say_lengths = "lengths go nearer to the origin, for only the shape counts"};
    fram_status status = outline_file_read(ctx, path, &rings, error);
    for (int32_t i = 0; status == FRAM_OK && i < rings.place.count; i++)
        rings.place.data[i].open = false;
    if (status == FRAM_OK)
        status = import_field_make(ctx, o, &rings, &options, &field, error);
    /* What has a place (coordinates beyond the limit) says enough. */
    if (status == FRAM_ERROR_INPUT && error && !error->line)
        status = none_sound(path, &rings, error);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&field.outlines); i++)
        if (!polygon_list_push(ctx, out, polygon_list_get(&field.outlines, i)))
            status = error_memory(error);
    import_rings_free(ctx, &rings);
    import_field_free(ctx, &field);
    return status;
}
