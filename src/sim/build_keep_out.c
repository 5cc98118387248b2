#include "sim/build_keep_out.h"

#include "base/transcendental.h"
#include "geometry/predicate.h"
#include "ice/field_cells.h"
#include "ice/field_measure.h"
#include "io/outline_file.h"
#include "sim/build_ice.h"

/* Corners of a convex piece of a zone. */
enum { ZONE_PIECE_VERTICES = 16 };

fram_status build_footprints(context *ctx, const world *w, polygon_list *out, fram_error *error)
{
    vec2_array footprint = {0};
    fram_status status = FRAM_OK;
    for (int32_t i = 0; status == FRAM_OK && i < w->vessels.count; i++) {
        status = build_footprint(ctx, w, w->vessels.body[i], false, &footprint, error);
        if (status == FRAM_OK && !polygon_list_push(ctx, out, (polygon){footprint.data, footprint.count}))
            status = error_memory(error);
    }
    array_free(ctx, &footprint);
    return status;
}

/* ---- hulls in parts ---- */

/* The first two zones that have something in common; false: none. */
static bool find_meeting(const polygon_list *zones, int32_t *a, int32_t *b)
{
    for (*b = 1; *b < polygon_list_count(zones); ++*b)
        for (*a = 0; *a < *b; ++*a)
            if (field_common_area(polygon_list_get(zones, *a), polygon_list_get(zones, *b)) > 0)
                return true;
    return false;
}

/* The outlines `a` and `b` give way to the convex one around both.  zones: those around the outlines, made anew. */
static bool join_outlines(context *ctx, int32_t a, int32_t b, double margin, polygon_list *outlines,
                          polygon_list *zones)
{
    polygon_list rest = {0};
    vec2_array points = {0}, around = {0};
    bool good = true;
    for (int32_t i = 0; i < polygon_list_count(outlines) && good; i++) {
        polygon p = polygon_list_get(outlines, i);
        if (i != a && i != b)
            good = polygon_list_push(ctx, &rest, p);
        for (int32_t k = 0; k < p.count && good && (i == a || i == b); k++)
            good = array_push(ctx, &points, p.vertex[k]);
    }
    good = good && polygon_convex_hull(ctx, (polygon){points.data, points.count}, &around) &&
           polygon_list_push(ctx, &rest, (polygon){around.data, around.count});
    polygon_list_clear(zones);
    good = good && zones_grow(ctx, &rest, margin, zones);
    polygon_list had = *outlines;
    *outlines = rest;
    polygon_list_free(ctx, &had);
    array_free(ctx, &points);
    array_free(ctx, &around);
    return good;
}

/* Convex outlines with their margin of the parts of a body in a slab; parts without water between them are one. */
static fram_status zones_of_parts(context *ctx, const world *w, int32_t body, build_slab slab, double margin,
                                  polygon_list *zones, fram_error *error)
{
    polygon_list plan = {0}, outlines = {0};
    vec2_array around = {0};
    int32_t a, b;
    fram_status status = build_plan(ctx, w, body, slab, &plan, error);
    bool good = status == FRAM_OK;
    for (int32_t i = 0; i < polygon_list_count(&plan) && good; i++)
        good = polygon_convex_hull(ctx, polygon_list_get(&plan, i), &around) &&
               polygon_list_push(ctx, &outlines, (polygon){around.data, around.count});
    good = good && zones_grow(ctx, &outlines, margin, zones);
    while (good && find_meeting(zones, &a, &b))
        good = join_outlines(ctx, a, b, margin, &outlines, zones);
    polygon_list_free(ctx, &plan);
    polygon_list_free(ctx, &outlines);
    array_free(ctx, &around);
    return status == FRAM_OK && !good ? error_memory(error) : status;
}

/* Of a hull in one part all that is seen from above, its deck too. */
static fram_status add_vessel_zones(context *ctx, const scenario *s, const world *w, int32_t vessel, polygon footprint,
                                    double thickest, polygon_list *out, fram_error *error)
{
    polygon_list whole = {0}, parts = {0};
    double margin = s->ice.keep_out_margin;
    build_slab slab = thickest < HUGE_VAL ? build_slab_of_ice(s, thickest) : build_slab_all();
    fram_status status = zones_of_parts(ctx, w, w->vessels.body[vessel], slab, margin, &parts, error);
    bool apart = polygon_list_count(&parts) > 1, good = status == FRAM_OK;
    for (int32_t i = 0; i < polygon_list_count(&parts) && good && apart; i++)
        good = polygon_list_push(ctx, out, polygon_list_get(&parts, i));
    if (good && !apart)
        good = polygon_list_push(ctx, &whole, footprint) && zones_grow(ctx, &whole, margin, out);
    polygon_list_free(ctx, &whole);
    polygon_list_free(ctx, &parts);
    return status == FRAM_OK && !good ? error_memory(error) : status;
}

fram_status build_wide_footprints(context *ctx, const scenario *s, const world *w, double thickest, polygon_list *out,
                                  fram_error *error)
{
    polygon_list all = {0};
    fram_status status = build_footprints(ctx, w, &all, error);
    for (int32_t i = 0; i < polygon_list_count(&all) && status == FRAM_OK; i++)
        status = add_vessel_zones(ctx, s, w, i, polygon_list_get(&all, i), thickest, out, error);
    polygon_list_free(ctx, &all);
    return status;
}

/* Does a zone lie where there is ice at the start?  Edges alone do not count. */
static bool reaches_ice(const scenario *s, polygon zone)
{
    const scenario_domain *d = &s->domain;
    box2 b = polygon_bounds(zone);
    /* Of the domain what is as large as the zone: rounding of a whole ocean would be as much as a small zone. */
    vec2 lo = {real_max(b.lo.x, d->x_min), real_max(b.lo.y, d->y_min)};
    vec2 hi = {real_min(b.hi.x, d->x_max), real_min(b.hi.y, d->y_max)};
    if (!(lo.x < hi.x && lo.y < hi.y))
        return false;
    const vec2 corner[4] = {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
    return field_common_area(zone, (polygon){corner, 4}) > 0;
}

static bool add_rectangle(context *ctx, const scenario_opening *z, polygon_list *out)
{
    double c = real_cos(radians(z->angle_deg)), sn = real_sin(radians(z->angle_deg));
    vec2 along = {0.5 * z->length * c, 0.5 * z->length * sn}, across = {-0.5 * z->width * sn, 0.5 * z->width * c};
    vec2 middle = {z->x, z->y}, near = vec2_sub(middle, along), far = vec2_add(middle, along);
    const vec2 corner[4] = {vec2_sub(near, across), vec2_sub(far, across), vec2_add(far, across),
                            vec2_add(near, across)};
    return polygon_list_push(ctx, out, (polygon){corner, 4});
}

static fram_status add_rectangles(context *ctx, const scenario *s, polygon_list *out, fram_error *error)
{
    for (int32_t i = 0; i < s->ice.open_water.count; i++) {
        if (!add_rectangle(ctx, &s->ice.open_water.data[i], out))
            return error_memory(error);
        if (!reaches_ice(s, polygon_list_get(out, polygon_list_count(out) - 1)))
            log_write(ctx, LOG_WARNING, "ice.open_water[%d]: it lies beside the domain and keeps no ice away", (int)i);
    }
    return FRAM_OK;
}

/* Zones in other coordinates than the scenario's keep nothing away. */
static void tell_zones_elsewhere(context *ctx, const scenario *s, const polygon_list *zones)
{
    box2 all = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int32_t i = 0; i < polygon_list_count(zones); i++) {
        polygon zone = polygon_list_get(zones, i);
        if (reaches_ice(s, zone))
            return;
        box2 box = polygon_bounds(zone);
        all.lo = vec2_make(real_min(all.lo.x, box.lo.x), real_min(all.lo.y, box.lo.y));
        all.hi = vec2_make(real_max(all.hi.x, box.hi.x), real_max(all.hi.y, box.hi.y));
    }
    if (polygon_list_count(zones) > 0)
        log_write(ctx, LOG_WARNING,
                  "ice.open_water_file: all of it lies beside the domain and keeps no ice away: x from %.9g to %.9g, y "
                  "from %.9g to %.9g m",
                  all.lo.x, all.hi.x, all.lo.y, all.hi.y);
}

static fram_status add_file(context *ctx, const scenario *s, const world *w, polygon_list *out, fram_error *error)
{
    char path[SCENARIO_PATH_ROOM];
    if (!s->ice.open_water_file[0])
        return FRAM_OK;
    import_rings rings = {0};
    import_field field = {0};
    const import_options options = {.name = path,
                                    .scale = 1,
                                    .bad = IMPORT_REFUSE,
                                    .as_it_is = true,
                                    .lengths = build_is_of_tank(s),
                                    .say_lengths = BUILD_SAY_TANK};
    fram_status status = scenario_file_path(s, "ice.open_water_file", s->ice.open_water_file, path, error);
    if (status == FRAM_OK)
        status = outline_file_read(ctx, path, &rings, error);
    if (status == FRAM_OK)
        status = import_field_make(ctx, w->scratch.plane, &rings, &options, &field, error);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&field.outlines); i++)
        status = overlay_convex_pieces(w->scratch.plane, polygon_list_get(&field.outlines, i), 0, ZONE_PIECE_VERTICES,
                                       out, NULL, error);
    if (status == FRAM_OK)
        tell_zones_elsewhere(ctx, s, &field.outlines);
    import_rings_free(ctx, &rings);
    import_field_free(ctx, &field);
    return status;
}

fram_status build_keep_out(context *ctx, const scenario *s, const world *w, double thickest, polygon_list *out,
                           fram_error *error)
{
    fram_status status = build_wide_footprints(ctx, s, w, thickest, out, error);
    if (status == FRAM_OK)
        status = add_rectangles(ctx, s, out, error);
    return status == FRAM_OK ? add_file(ctx, s, w, out, error) : status;
}
