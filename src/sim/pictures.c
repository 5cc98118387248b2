#include "sim/pictures.h"

#include "io/plan_flows.h"
#include "io/plan_view.h"
#include "sim/build_ice.h"

#include <stdio.h>

enum { PLAN_PIXELS = 1000 };

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

static bool add_prism_plan(context *ctx, plan_store *p, const world *w, int32_t body)
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

/* Height of the waterline over the hull's size: rounding would miss what stands in one of no height. */
#define WATERLINE_PART 1e-6

static fram_status add_hull(context *ctx, plan_store *p, const world *w, int32_t vessel, fram_error *error)
{
    const int32_t body = w->vessels.body[vessel];
    const double high = WATERLINE_PART * w->shapes.shapes.radius[w->bodies.shape[body]];
    for (int wet = 0; wet < 2; wet++) {
        polygon_list plan = {0};
        fram_status status = build_plan(ctx, w, body, wet ? (build_slab){-high, high} : build_slab_all(), &plan, error);
        plan_shape shape = {.style = wet ? PLAN_WATERLINE : PLAN_DECK, .owner = vessel, .height = HUGE_VAL};
        bool good = status == FRAM_OK;
        for (int32_t k = 0; good && k < polygon_list_count(&plan); k++) {
            polygon outline = polygon_list_get(&plan, k);
            good = begin_shape(ctx, p, shape);
            for (int32_t i = 0; good && i < outline.count; i++)
                good = array_push(ctx, &p->vertex, outline.vertex[i]);
        }
        polygon_list_free(ctx, &plan);
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
        if (is_kind(w, i, SHAPE_PRISM) && !add_prism_plan(ctx, p, w, i))
            return error_memory(error);
    }
    for (int32_t i = 0; i < w->vessels.count; i++) {
        if (!is_kind(w, w->vessels.body[i], SHAPE_SOLID))
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

typedef ARRAY(plan_line) plan_line_array;

/* Lines that still hold. */
static bool collect_lines(context *ctx, const world *w, plan_line_array *out)
{
    for (int32_t i = 0; i < w->lines.count; i++) {
        vec3 upper = body_to_global(&w->bodies, w->vessels.body[w->lines.vessel[i]], w->lines.fairlead[i]);
        upper = vec3_add(upper, w->lines.arm[i]);
        vec3 anchor = w->lines.anchor[i];
        if (!w->lines.broken[i] && !array_push(ctx, out, ((plan_line){{upper.x, upper.y}, {anchor.x, anchor.y}})))
            return false;
    }
    return true;
}

/* Time and floes, of which the tiles of a sheet are none, as the playback page tells them. */
static void caption_of(const world *w, char *caption, size_t size)
{
    int32_t floes = 0, tiles = 0;
    for (int32_t i = 0; i < w->floes.count; i++) {
        bool tile = w->floes.tile[i] != 0;
        tiles += w->floes.body[i] >= 0 && tile;
        floes += w->floes.body[i] >= 0 && !tile;
    }
    if (tiles > 0 && floes == 0)
        snprintf(caption, size, "t = %.2f s, level ice", w->clock.time[0]);
    else
        snprintf(caption, size, "t = %.2f s, %s%d %s", w->clock.time[0], tiles > 0 ? "level ice and " : "", (int)floes,
                 floes == 1 ? "floe" : "floes");
}

fram_status picture_plan(context *ctx, const scenario *s, const world *w, const char *path, fram_error *error)
{
    plan_store p = {0};
    plan_line_array lines = {0};
    fram_status status = collect(ctx, &p, w, error);
    if (status == FRAM_OK && !collect_lines(ctx, w, &lines))
        status = error_memory(error);
    plan_flows flows = plan_flows_at(ctx, s, w->clock.time[0]);
    char caption[256];
    caption_of(w, caption, sizeof caption);
    plan_view view = {.window = plan_window(domain_with_walls(&s->domain), p.shape.data, p.shape.count),
                      .title = s->title[0] ? s->title : "Fram",
                      .caption = caption,
                      .shapes = p.shape.data,
                      .shape_count = p.shape.count,
                      .lines = lines.data,
                      .line_count = lines.count,
                      .flows = flows.flow,
                      .flow_count = flows.count};
    if (status == FRAM_OK)
        status = plan_view_write(ctx, &view, path, PLAN_PIXELS, error);
    array_free(ctx, &lines);
    plan_store_free(ctx, &p);
    return status;
}
