#include "sim/build_feeding.h"

#include "model/scenario_vessel.h"
#include "sim/build_ice.h"
#include "sim/build_keep_out.h"
#include "sim/build_level.h"
#include "sim/build_packed.h"
#include "sim/feed.h"

#include <stdio.h>
#include <string.h>

/* The tile, where the scenario does not say: larger than the window by this factor, so that the ice does not come back
   with the same neighbours at once, and by this many mean floes at least. */
#define TILE_FACTOR 1.25
#define TILE_FLOES 6

static double tile_length(double floe_area, double given, double window)
{
    double spare = fmax((TILE_FACTOR - 1) * window, TILE_FLOES * sqrt(floe_area));
    return automatic_or(given, window + spare);
}

/* Window, tile and band are keys of the domain. */
static fram_status name_key(const scenario *s, fram_status status, fram_error *error)
{
    if (status != FRAM_ERROR_INPUT || !error)
        return status;
    if (strcmp(error->key, "tile") == 0)
        snprintf(error->key, sizeof error->key, "domain.tile_x");
    else if (strcmp(error->key, "band") == 0)
        snprintf(error->key, sizeof error->key, "domain.band");
    else if (strcmp(error->key, "window") == 0)
        snprintf(error->key, sizeof error->key, "domain");
    scenario_locate(s, error);
    return status;
}

/* A vessel must lie inside the band at the start; the water that is kept clear around it may reach into that. */
static fram_status check_place(context *ctx, const scenario *s, const world *w, box2 window, double band,
                               fram_error *error)
{
    static const char *const sides[] = {"x_min", "x_max", "y_min", "y_max"};
    polygon_list hulls = {0};
    fram_status status = build_footprints(ctx, w, &hulls, error);
    for (int32_t i = 0; i < polygon_list_count(&hulls) && status == FRAM_OK; i++) {
        box2 box = polygon_bounds(polygon_list_get(&hulls, i));
        const double room[] = {box.lo.x - window.lo.x, window.hi.x - box.hi.x, box.lo.y - window.lo.y,
                               window.hi.y - box.hi.y};
        int32_t side = 0;
        for (int32_t k = 1; k < 4; k++)
            side = room[k] < room[side] ? k : side;
        if (room[side] >= band)
            continue;
        const vessel_entry entry = scenario_vessel_entry(s, i);
        status = error_set(error, FRAM_ERROR_INPUT, NULL, 0, "band",
                           "expected %s inside the band of %.4g m whose floes go with the field, found %.4g m between "
                           "it and domain.%s; make the domain larger on that side or the band narrower",
                           vessel_title_of(&entry).text, band, room[side], sides[side]);
    }
    polygon_list_free(ctx, &hulls);
    return status;
}

/* Of all that the tile holds. */
static double thickest_made(const floe_table *f)
{
    double most = 0;
    for (int32_t i = 0; i < f->count; i++)
        most = f->body[i] >= 0 ? fmax(most, f->thickness[i]) : most;
    return most;
}

static fram_status begin(context *ctx, const scenario *s, const model *m, vec2 tile, world *w, fram_error *error)
{
    polygon_list keep_out = {0};
    fram_status status = build_keep_out(ctx, s, w, thickest_made(&w->floes), &keep_out, error);
    feeding_definition d = {.window = m->domain,
                            .tile = tile,
                            .band = s->domain.band,
                            .velocity = feed_drift(m, &w->inputs, 0),
                            .keep_out = &keep_out,
                            .smallest_area = s->ice.smallest_floe_area,
                            .given = s->ice.source == ICE_FILE && s->ice.populations.count == 0,
                            .piece_area_limit = s->ice.smallest_piece_area};
    feeding_world fed = feed_world(w);
    if (status == FRAM_OK)
        status = feeding_begin(ctx, w->scratch.plane, &d, &fed, error);
    if (status == FRAM_OK)
        status = check_place(ctx, s, w, m->domain, w->feeding.band[0], error);
    polygon_list_free(ctx, &keep_out);
    return name_key(s, status, error);
}

static vec2 tile_of(const scenario *s, box2 window, double floe_area)
{
    return vec2_make(tile_length(floe_area, s->domain.tile_x, window.hi.x - window.lo.x),
                     tile_length(floe_area, s->domain.tile_y, window.hi.y - window.lo.y));
}

fram_status feeding_floe_area(context *ctx, const scenario *s, double *area, fram_error *error)
{
    bool asked = is_automatic(s->domain.tile_x) || is_automatic(s->domain.tile_y);
    *area = s->ice.mean_floe_area;
    return asked && s->ice.populations.count > 0 ? population_mean_area(ctx, s, area, error) : FRAM_OK;
}

/* The same ice in a larger domain; what is shared with the scenario is only read. */
scenario feeding_scenario(const scenario *s, double floe_area)
{
    box2 window = domain_box(&s->domain);
    vec2 middle = vec2_scale(vec2_add(window.lo, window.hi), 0.5), tile = tile_of(s, window, floe_area);
    scenario larger = *s;
    larger.domain.x_min = middle.x - tile.x / 2;
    larger.domain.x_max = middle.x + tile.x / 2;
    larger.domain.y_min = middle.y - tile.y / 2;
    larger.domain.y_max = middle.y + tile.y / 2;
    return larger;
}

fram_status feeding_outlines_check(context *ctx, const scenario *s, const model *m, const world *w, double floe_area,
                                   const polygon_list *outlines, fram_error *error)
{
    const feeding_definition d = {
        .window = m->domain, .tile = tile_of(s, m->domain, floe_area), .band = s->domain.band};
    double radius = 0, band;
    for (int32_t i = 0; i < polygon_list_count(outlines); i++) {
        polygon floe = polygon_list_get(outlines, i);
        vec2 centre = polygon_moments_of(floe).centroid;
        for (int32_t k = 0; k < floe.count; k++)
            radius = fmax(radius, vec2_length(vec2_sub(floe.vertex[k], centre)));
    }
    fram_status status = feeding_check(&d, radius, &band, error);
    if (status == FRAM_OK)
        status = check_place(ctx, s, w, m->domain, band, error);
    return name_key(s, status, error);
}

fram_status feeding_place_check(context *ctx, const scenario *s, const model *m, const world *w, fram_error *error)
{
    if (s->domain.boundary != DOMAIN_FEEDING || m->sheet.drifts || is_automatic(s->domain.band))
        return FRAM_OK;
    return name_key(s, check_place(ctx, s, w, m->domain, s->domain.band, error), error);
}

fram_status build_field(context *ctx, const scenario *s, const model *m, world *w, field_report *report,
                        fram_error *error)
{
    if (s->domain.boundary != DOMAIN_FEEDING)
        return build_ice(ctx, s, w, report, error);
    if (m->sheet.drifts) {
        drift_world sheet = feed_sheet(m, w);
        fram_status status = build_drifting(ctx, s, m, w, report, error);
        return status == FRAM_OK ? drift_begin(ctx, &sheet, feed_drift(m, &w->inputs, 0), error) : status;
    }
    double floe_area;
    fram_status status = feeding_floe_area(ctx, s, &floe_area, error);
    if (status != FRAM_OK)
        return status;
    scenario larger = feeding_scenario(s, floe_area);
    status = build_ice(ctx, &larger, w, report, error);
    return status == FRAM_OK ? begin(ctx, s, m, tile_of(s, m->domain, floe_area), w, error) : status;
}
