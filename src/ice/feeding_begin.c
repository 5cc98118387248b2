/* The pattern of an endless field, and what the window shows of it at the start; see feeding.h. */
#include "base/number_text.h"
#include "ice/feeding_parts.h"

#include "ice/field_cells.h"
#include "ice/field_measure.h"

#include <math.h>

/* The band's width over the radius of the largest floe: it must be more than 1, so that no floe inside the band reaches
   out of the window, where others enter; half as much again lets the band hold together while its floes come and go. */
#define BAND_RADII 1.5
/* Pieces cut off by a zone under this part of their floe are slivers, and left as open water. */
#define SMALLEST_CUT_PIECE 0.02

/* What the tile has to be larger than the window on each side, over what a floe takes up there. */
#define TILE_ROOM 1.01

double feeding_band(double largest_radius) { return BAND_RADII * largest_radius; }

/* ---- the pattern ---- */

static fram_status add_pattern_floe(context *ctx, const feeding_world *w, int32_t floe, fram_error *error)
{
    pattern_table *p = w->pattern;
    int32_t body = w->floes->body[floe], row = p->count, first = w->vertices->count;
    polygon outline = shape_outline(w->shapes, w->bodies->shape[body]);
    if (!table_resize(ctx, p, &pattern_table_info, row + 1) ||
        !table_resize(ctx, w->vertices, &pattern_vertex_table_info, first + outline.count))
        return error_memory(error);
    mat3 turn = quat_matrix(w->bodies->orientation[body]);
    vec3 place = w->bodies->position[body];
    double reach = 0;
    for (int32_t i = 0; i < outline.count; i++) {
        vec3 v = mat3_mul_vec(turn, vec3_make(outline.vertex[i].x, outline.vertex[i].y, 0));
        w->vertices->point[first + i] = vec2_make(v.x, v.y);
        reach = fmax(reach, vec3_length(v));
    }
    p->place[row] = vec2_make(place.x, place.y);
    p->radius[row] = reach;
    p->area[row] = w->floes->area[floe];
    p->thickness[row] = w->floes->thickness[floe];
    p->elevation[row] = place.z;
    p->material[row] = w->floes->material[floe];
    p->breakable[row] = w->floes->breakable[floe];
    p->state[row] = PATTERN_OUTSIDE;
    p->body[row] = -1;
    p->first[row] = first;
    p->size[row] = outline.count;
    return FRAM_OK;
}

static fram_status make_pattern(context *ctx, const feeding_world *w, fram_error *error)
{
    for (int32_t i = 0; i < w->floes->count; i++) {
        fram_status status = w->floes->body[i] >= 0 ? add_pattern_floe(ctx, w, i, error) : FRAM_OK;
        if (status != FRAM_OK)
            return status;
    }
    for (int32_t i = w->floes->count - 1; i >= 0; i--)
        if (w->floes->body[i] >= 0)
            floe_remove(w->bodies, w->shapes, w->floes, i);
    *w->next_number = 0;
    return FRAM_OK;
}

static double largest_radius(const pattern_table *p)
{
    double most = 0;
    for (int32_t i = 0; i < p->count; i++)
        most = fmax(most, p->radius[i]);
    return most;
}

fram_status feeding_check(const feeding_definition *d, double radius, double *band_of, fram_error *error)
{
    double band = *band_of = isnan(d->band) ? feeding_band(radius) : d->band;
    vec2 size = vec2_sub(d->window.hi, d->window.lo), spare = vec2_sub(d->tile, size);
    double room = 2 * TILE_ROOM * (radius + feeding_clearance(band));
    if (!(spare.x >= room && spare.y >= room))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "tile",
                         "expected a tile that is %s m larger than the window both ways, for floes of %.4g m, so that "
                         "none is in the window twice; it is larger by %.4g m and %.4g m",
                         least_text_of(room, 4).text, 2 * radius, spare.x, spare.y);
    double half = 0.5 * fmin(size.x, size.y);
    if (!(radius < half))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "window",
                         "expected more than %s m both ways, as the largest floe measures, found %.4g m: make it "
                         "larger or the floes smaller",
                         least_text_of(2 * radius, 4).text, 2 * half);
    const range_text bounds = range_text_of(radius, half, 4);
    if (!(band >= radius && band < half))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "band",
                         "expected a band from %s m, the radius of the largest floe, to less than %s m, half of the "
                         "window; "
                         "it is %.4g m: give such a band, make the domain larger or the floes smaller",
                         bounds.least.text, bounds.most.text, band);
    return FRAM_OK;
}

/* ---- the first view ---- */

static bool meets_zone(const polygon_list *zones, polygon floe)
{
    for (int32_t i = 0; i < polygon_list_count(zones); i++)
        if (field_common_area(polygon_list_get(zones, i), floe) > 0)
            return true;
    return false;
}

/* Scratch of the first view. */
typedef struct view_work {
    polygon_list zones; /* grown */
    polygon_list one, parts;
    vec2_array outline;
    cells_scratch cells;
    int32_t left_out; /* concave floes in the way */
    int32_t covered;  /* convex ones of which a zone leaves nothing */
} view_work;

static void view_work_free(context *ctx, view_work *v)
{
    polygon_list_free(ctx, &v->zones);
    polygon_list_free(ctx, &v->one);
    polygon_list_free(ctx, &v->parts);
    array_free(ctx, &v->outline);
    cells_scratch_free(ctx, &v->cells);
}

/* A floe that a zone meets: cut when it is convex, otherwise left out. */
static fram_status cut_floe(context *ctx, overlay *o, const feeding_definition *d, const feeding_world *w, int32_t row,
                            view_work *v, fram_error *error)
{
    polygon p = {v->outline.data, v->outline.count};
    if (!polygon_is_convex(p)) {
        v->left_out++;
        return FRAM_OK;
    }
    vec2 place = feeding_place(w, row);
    double least = fmax(d->smallest_area, SMALLEST_CUT_PIECE * w->pattern->area[row]);
    polygon_list_clear(&v->one);
    polygon_list_clear(&v->parts);
    if (!polygon_list_push(ctx, &v->one, p))
        return error_memory(error);
    fram_status status = cells_outside_zones(ctx, &v->one, &v->zones, &v->cells, &v->parts, error);
    bool shown = false;
    for (int32_t i = 0; i < polygon_list_count(&v->parts) && status == FRAM_OK; i++) {
        polygon part = polygon_list_get(&v->parts, i);
        if (part.count < 3 || polygon_area(part) < least)
            continue;
        if (!array_resize(ctx, &v->outline, part.count))
            return error_memory(error);
        for (int32_t k = 0; k < part.count; k++)
            v->outline.data[k] = vec2_sub(part.vertex[k], place);
        shown = true;
        status = feeding_make_floe(ctx, o, w, row, (polygon){v->outline.data, part.count}, error);
    }
    v->covered += !shown;
    return status;
}

static fram_status show_floe(context *ctx, overlay *o, const feeding_definition *d, const feeding_world *w, int32_t row,
                             view_work *v, fram_error *error)
{
    vec2 place = feeding_place(w, row);
    if (!feeding_reaches(w, place, w->pattern->radius[row], 0))
        return FRAM_OK;
    w->pattern->state[row] = PATTERN_INSIDE;
    polygon own = feeding_outline(w, row);
    if (!array_resize(ctx, &v->outline, own.count))
        return error_memory(error);
    for (int32_t i = 0; i < own.count; i++)
        v->outline.data[i] = vec2_add(own.vertex[i], place);
    if (meets_zone(&v->zones, (polygon){v->outline.data, own.count}))
        return cut_floe(ctx, o, d, w, row, v, error);
    return feeding_make_floe(ctx, o, w, row, own, error);
}

/* Of floes that somebody gave those that are not there are told, as a warning where it is half of them; of a drawn
   field a hull covers some.  Even where none is there the next tile brings them once the field drifts. */
static void tell_left_out(context *ctx, const feeding_definition *d, const view_work *v, int32_t floes)
{
    int32_t all = v->left_out + v->covered;
    if (d->given && all > 0)
        log_write(
            ctx, 2 * all >= floes ? LOG_WARNING : LOG_INFO,
            "%d of %d floes left out at the start, %d of them concave: they are in the way of a vessel or of open "
            "water%s",
            (int)all, (int)floes, (int)v->left_out,
            all < floes ? "" : "; none is there until the field drifts on and repeats itself");
    else if (v->left_out > 0)
        log_write(ctx, LOG_INFO, "%d concave floes left out at the start, in the way of a vessel or of open water",
                  (int)v->left_out);
}

fram_status feeding_begin(context *ctx, overlay *o, const feeding_definition *d, const feeding_world *w,
                          fram_error *error)
{
    fram_status status = make_pattern(ctx, w, error);
    if (status != FRAM_OK)
        return status;
    double band;
    status = feeding_check(d, largest_radius(w->pattern), &band, error);
    if (status == FRAM_OK && !table_resize(ctx, w->feeding, &feeding_table_info, 1))
        status = error_memory(error);
    if (status != FRAM_OK)
        return status;
    w->feeding->lo[0] = d->window.lo;
    w->feeding->hi[0] = d->window.hi;
    w->feeding->tile[0] = d->tile;
    w->feeding->band[0] = band;
    w->feeding->velocity[0] = d->velocity;
    w->feeding->piece_area_limit[0] = d->piece_area_limit;
    view_work v = {0};
    if (d->keep_out && !zones_grow(ctx, d->keep_out, d->keep_out_margin, &v.zones))
        status = error_memory(error);
    for (int32_t row = 0; row < w->pattern->count && status == FRAM_OK; row++)
        status = show_floe(ctx, o, d, w, row, &v, error);
    if (status == FRAM_OK)
        tell_left_out(ctx, d, &v, w->pattern->count);
    view_work_free(ctx, &v);
    return status;
}
