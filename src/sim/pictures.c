#include "sim/pictures.h"

#include "io/chart.h"
#include "io/csv_read.h"
#include "io/plan_view.h"
#include "sim/build_ice.h"

#include <stdio.h>

enum { PLAN_PIXELS = 1000, CHART_WIDTH = 1280, CHART_HEIGHT = 560 };

/* Shapes of a plan view with the vertices they point to. */
typedef struct plan_store {
    vec2_array vertex;
    ARRAY(int32_t) start;
    ARRAY(plan_shape) shape;
} plan_store;

static void plan_store_free(context *ctx, plan_store *p)
{
    array_free(ctx, &p->vertex);
    array_free(ctx, &p->start);
    array_free(ctx, &p->shape);
}

/* What is added next begins here; its outline is set when all vertices are there. */
static bool begin_shape(context *ctx, plan_store *p, plan_shape shape)
{
    return array_push(ctx, &p->start, p->vertex.count) && array_push(ctx, &p->shape, shape);
}

static bool add_prism(context *ctx, plan_store *p, const world *w, int32_t body)
{
    polygon outline = shape_outline(&w->shapes, w->bodies.shape[body]);
    bool wall = w->bodies.material[body] == MATERIAL_WALL;
    int32_t owner = w->bodies.owner[body];
    plan_style style = wall                                      ? PLAN_WALL
                       : owner >= 0 && w->floes.tile[owner] != 0 ? PLAN_LEVEL_ICE
                       : w->bodies.motion[body] == MOTION_STATIC ? PLAN_FIXED_ICE
                                                                 : PLAN_FLOE;
    plan_shape shape = {.style = style};
    plan_shape_stand(&shape, w->bodies.position[body], w->bodies.orientation[body],
                     2 * w->shapes.shapes.half_height[w->bodies.shape[body]]);
    bool good = begin_shape(ctx, p, shape);
    for (int32_t i = 0; good && i < outline.count; i++) {
        vec3 g = body_to_global(&w->bodies, body, vec3_make(outline.vertex[i].x, outline.vertex[i].y, 0));
        good = array_push(ctx, &p->vertex, vec2_make(g.x, g.y));
    }
    return good;
}

static fram_status add_hull(context *ctx, plan_store *p, const world *w, int32_t body, fram_error *error)
{
    for (int below = 0; below < 2; below++) {
        vec2_array outline = {0};
        fram_status status = build_footprint(ctx, w, body, below == 1, &outline, error);
        plan_shape shape = {.style = below ? PLAN_WATERLINE : PLAN_DECK, .height = HUGE_VAL};
        bool good = status == FRAM_OK && begin_shape(ctx, p, shape);
        for (int32_t i = 0; good && i < outline.count; i++)
            good = array_push(ctx, &p->vertex, outline.data[i]);
        array_free(ctx, &outline);
        if (status != FRAM_OK)
            return status;
        if (!good)
            return error_memory(error);
    }
    return FRAM_OK;
}

static bool is_kind(const world *w, int32_t body, shape_kind kind)
{
    return body_is_alive(&w->bodies, body) && w->bodies.shape[body] >= 0 &&
           w->shapes.shapes.kind[w->bodies.shape[body]] == kind;
}

static fram_status collect(context *ctx, plan_store *p, const world *w, fram_error *error)
{
    for (int32_t i = 0; i < w->bodies.count; i++) {
        if (is_kind(w, i, SHAPE_PRISM) && !add_prism(ctx, p, w, i))
            return error_memory(error);
    }
    for (int32_t i = 0; i < w->bodies.count; i++) {
        if (!is_kind(w, i, SHAPE_SOLID))
            continue;
        fram_status status = add_hull(ctx, p, w, i, error);
        if (status != FRAM_OK)
            return status;
    }
    for (int32_t k = 0; k < p->start.count; k++) {
        int32_t first = p->start.data[k], end = k + 1 < p->start.count ? p->start.data[k + 1] : p->vertex.count;
        p->shape.data[k].outline = (polygon){p->vertex.data + first, end - first};
    }
    plan_shapes_sort(p->shape.data, p->shape.count);
    return FRAM_OK;
}

fram_status picture_plan(context *ctx, const scenario *s, const world *w, const char *path, fram_error *error)
{
    plan_store p = {0};
    fram_status status = collect(ctx, &p, w, error);
    char caption[256];
    int32_t floes = 0;
    for (int32_t i = 0; i < w->floes.count; i++)
        floes += w->floes.body[i] >= 0;
    snprintf(caption, sizeof caption, "t = %.2f s, %d floes", w->clock.time[0], (int)floes);
    double border = s->domain.boundary == DOMAIN_WALLS ? s->domain.wall_thickness : 0;
    plan_view view = {.window = {{s->domain.x_min - border, s->domain.y_min - border},
                                 {s->domain.x_max + border, s->domain.y_max + border}},
                      .title = s->title[0] ? s->title : "Fram",
                      .caption = caption,
                      .shapes = p.shape.data,
                      .shape_count = p.shape.count};
    if (status == FRAM_OK)
        status = plan_view_write(ctx, &view, path, PLAN_PIXELS, error);
    plan_store_free(ctx, &p);
    return status;
}

static double mean_after(const double_array *time, const double_array *value, double transient)
{
    double sum = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < value->count; i++) {
        if (time->data[i] < transient)
            continue;
        sum += value->data[i];
        n++;
    }
    return n > 0 ? sum / n : 0;
}

fram_status picture_loads(context *ctx, const scenario *s, const char *folder, fram_error *error)
{
    static const char *const names[] = {"time", "ice_force_body_x", "ice_force_body_y", "ice_force_averaged_x",
                                        "ice_force_averaged_y"};
    enum { TIME, RAW_X, RAW_Y, MEAN_X, MEAN_Y, COUNT };
    char from[1024], to[1024];
    int n = snprintf(from, sizeof from, "%s/series.csv", folder), m = snprintf(to, sizeof to, "%s/loads.png", folder);
    if (n < 0 || m < 0 || n >= (int)sizeof from || m >= (int)sizeof to)
        return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL, "the folder's name is too long");
    double_array column[COUNT] = {0};
    fram_status status = csv_read(ctx, from, names, COUNT, column, error);
    if (status == FRAM_OK) {
        double mean = mean_after(&column[TIME], &column[RAW_X], s->run.transient);
        for (int k = RAW_X; k < COUNT; k++) {
            for (int32_t i = 0; i < column[k].count; i++)
                column[k].data[i] *= 1e-3;
        }
        int32_t rows = column[TIME].count;
        const chart_line lines[] = {
            chart_line_make("along the vessel, each step", column[TIME].data, column[RAW_X].data, rows, false),
            chart_line_make("along X, averaged", column[TIME].data, column[MEAN_X].data, rows, true),
            chart_line_make("along Y, averaged", column[TIME].data, column[MEAN_Y].data, rows, true),
        };
        char subtitle[256];
        snprintf(
            subtitle, sizeof subtitle,
            "averaged over %.3g s; mean along the vessel (x forward) %.4g kN after %g s; a resisting load is negative",
            s->output.averaging_window, mean * 1e-3, s->run.transient);
        chart c = chart_make("Ice load on the vessel", subtitle, "time [s]", "force [kN]", lines, 3);
        status = chart_write(ctx, &c, to, CHART_WIDTH, CHART_HEIGHT, error);
    }
    for (int k = 0; k < COUNT; k++)
        array_free(ctx, &column[k]);
    return status;
}
