/* Pictures and the table of an ice field. */
#include "api/arguments.h"
#include "api/field_handle.h"

#include "base/number_text.h"
#include "base/transcendental.h"
#include "ice/field_measure.h"
#include "io/atomic_file.h"
#include "io/plan_view.h"
#include "io/text_buffer.h"

#include <stdio.h>

enum { PICTURE_PIXELS = 1600 };
/* Cells of a cover map along the longer side: unless told, and at most. */
enum { COVER_CELLS = 40, MOST_COVER_CELLS = 1000 };

fram_status fram_field_draw(const fram_field *f, const char *title, const char *path, fram_error *error)
{
    fram_status status = field_check_output(f, path, error);
    if (status != FRAM_OK)
        return status;
    context *ctx = &f->context->inner;
    const fram_field_summary *a = &f->about;
    plan_shape *shapes = memory_array(ctx, (size_t)a->floes, sizeof *shapes);
    if (!shapes)
        return error_memory(error);
    for (int i = 0; i < a->floes; i++)
        shapes[i] = (plan_shape){.outline = polygon_list_get(&f->floes.outlines, i), .style = PLAN_FLOE};
    char caption[160];
    snprintf(caption, sizeof caption, "%d floe%s, %.4g km\302\262, concentration %.1f %%, largest %.4g m across",
             a->floes, a->floes == 1 ? "" : "s", a->area / 1e6, 100 * a->concentration, a->largest_diameter);
    const plan_view view = {.window = f->window,
                            .title = title ? title : "Ice field",
                            .caption = caption,
                            .shapes = shapes,
                            .shape_count = a->floes};
    status = plan_view_write(ctx, &view, path, PICTURE_PIXELS, error);
    memory_free(ctx, shapes);
    return status;
}

/* ---- cover map ---- */

static int32_t cells_along(double length, double cell)
{
    double n = floor(length / cell + 0.5);
    return n < 1 ? 1 : (int32_t)n;
}

/* Cells as shapes; corners: 4 of each. */
static void cover_cells(box2 box, int32_t nx, int32_t ny, const double *cover, vec2 *corners, plan_shape *shapes)
{
    double wide = (box.hi.x - box.lo.x) / nx, high = (box.hi.y - box.lo.y) / ny;
    for (int32_t y = 0; y < ny; y++)
        for (int32_t x = 0; x < nx; x++) {
            int32_t i = y * nx + x;
            vec2 *c = corners + 4 * (size_t)i, lo = {box.lo.x + x * wide, box.lo.y + y * high};
            c[0] = lo;
            c[1] = (vec2){lo.x + wide, lo.y};
            c[2] = (vec2){lo.x + wide, lo.y + high};
            c[3] = (vec2){lo.x, lo.y + high};
            shapes[i] = (plan_shape){.outline = {c, 4}, .has_value = true, .value = (float)cover[i]};
        }
}

fram_status fram_field_draw_cover(const fram_field *f, double cell, const char *title, const char *path,
                                  fram_error *error)
{
    fram_status status = field_check_output(f, path, error);
    if (status != FRAM_OK)
        return status;
    context *ctx = &f->context->inner;
    double wide = f->window.hi.x - f->window.lo.x, high = f->window.hi.y - f->window.lo.y, longest = fmax(wide, high);
    if (!(isfinite(longest) && longest > 0))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "field", "expected a field with floes, found none to map");
    cell = cell == 0 ? longest / COVER_CELLS : cell;
    const range_text range = range_text_of(longest / MOST_COVER_CELLS, longest, 4);
    if (!(cell >= longest / MOST_COVER_CELLS && cell <= longest))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "cell",
                         "expected cells of %s to %s m (a thousandth of the field to all of it), found %g m",
                         range.least.text, range.most.text, cell);
    int32_t nx = cells_along(wide, cell), ny = cells_along(high, cell);
    size_t cells = (size_t)nx * (size_t)ny;
    double *cover = memory_array(ctx, cells, sizeof *cover);
    vec2 *corners = memory_array(ctx, 4 * cells, sizeof *corners);
    plan_shape *shapes = memory_array(ctx, cells, sizeof *shapes);
    status = cover && corners && shapes ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK) {
        field_cover_map(&f->floes.outlines, f->period, f->window, nx, ny, cover);
        cover_cells(f->window, nx, ny, cover, corners, shapes);
        double least = 1, most = 0;
        for (size_t i = 0; i < cells; i++) {
            least = fmin(least, cover[i]);
            most = fmax(most, cover[i]);
        }
        char caption[160];
        snprintf(caption, sizeof caption, "cells of %.4g m: %.1f to %.1f %% ice, %.2f %% of the whole", wide / nx,
                 100 * least, 100 * most, 100 * f->about.concentration);
        const plan_view view = {.window = f->window,
                                .title = title ? title : "Concentration",
                                .caption = caption,
                                .shapes = shapes,
                                .shape_count = (int32_t)cells,
                                .scale_name = "concentration",
                                .scale_lo = 0,
                                .scale_hi = 1};
        status = plan_view_write(ctx, &view, path, PICTURE_PIXELS, error);
    }
    memory_free(ctx, cover);
    memory_free(ctx, corners);
    memory_free(ctx, shapes);
    return status;
}

/* ---- table ---- */

static void add_real(context *ctx, text_buffer *b, double value)
{
    char text[NUMBER_TEXT_SIZE];
    real_to_text(value, text);
    text_add(ctx, b, ",");
    text_add(ctx, b, isnan(value) ? "" : text);
}

fram_status fram_field_table(const fram_field *f, const char *path, fram_error *error)
{
    fram_status status = field_check_output(f, path, error);
    if (status != FRAM_OK)
        return status;
    context *ctx = &f->context->inner;
    text_buffer b = {0};
    text_add(ctx, &b,
             "floe,diameter[m],area[m2],vertices[1],thickness[m],population,drawn_area[m2],drawn_vertices[1]\n");
    for (int32_t i = 0; i < f->about.floes; i++) {
        polygon p = polygon_list_get(&f->floes.outlines, i);
        double area = polygon_area(p);
        bool moved = f->generated && i >= f->drawn.placed;
        field_floe none = {.population = -1, .area = (double)NAN},
                   drawn = moved ? f->drawn.shapes.data[i - f->drawn.placed] : none;
        text_format(ctx, &b, "%d", (int)i);
        add_real(ctx, &b, sqrt(4 / PI * area));
        add_real(ctx, &b, area);
        text_format(ctx, &b, ",%d", (int)p.count);
        add_real(ctx, &b, f->floes.thickness.data[i]);
        text_format(ctx, &b, ",%d", (int)drawn.population);
        add_real(ctx, &b, drawn.area);
        if (moved)
            text_format(ctx, &b, ",%d\n", (int)drawn.vertices);
        else
            text_add(ctx, &b, ",\n");
    }
    status = text_file_write(ctx, path, &b, error);
    text_free(ctx, &b);
    return status;
}
