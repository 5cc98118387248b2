#include "ice/import_frame.h"

#include "base/transcendental.h"

#include <math.h>
#include <stdio.h>

/* Lengths are too long by (r / 2R)^2, 0.6 % so far from the centre [m]. */
#define REACH_MOST 1e6
/* Sea ice begins at the south coast of the Bohai Sea, and a floe of 50 km covers a quarter of a square degree of
   latitude: no planar field of full size is so far from its origin with floes so small, but one in the metres of a tank
   [deg]. */
#define LATITUDE_LEAST 37
#define FLOE_MOST 0.5
/* Of the floes of a field so many tell what its coordinates are: an ice chart has a few vast ones, too. */
#define PLAIN_LEAST 0.9
#define HALF_TURN 180.0 /* [deg] */

static polygon all_vertices(const import_rings *r) { return (polygon){r->rings.vertex.data, r->rings.vertex.count}; }

static fram_status fault(const import_rings *r, const import_options *o, int32_t ring, fram_error *error,
                         const char *what)
{
    char key[IMPORT_NAME_SIZE] = "";
    const import_place *place = &r->place.data[ring];
    import_place_name(place, key);
    error_set(error, FRAM_ERROR_INPUT, o->name, (int)place->line, key, "%s", what);
    if (error)
        error->column = (int)place->column;
    return FRAM_ERROR_INPUT;
}

/* Longitudes of one field differ by half a turn at most: those behind the date line are taken a turn on. */
static double near(double longitude, double to) { return longitude - 360 * floor((longitude - to) / 360 + 0.5); }

/* Longitude and latitude of a vertex; swapped: latitude stands first. */
static vec2 position_of(vec2 vertex, bool swapped) { return swapped ? vec2_make(vertex.y, vertex.x) : vertex; }

/* Around vertices in degrees. */
static box2 box_of(polygon p, bool swapped)
{
    vec2 first = position_of(p.vertex[0], swapped);
    box2 box = {first, first};
    for (int32_t i = 1; i < p.count; i++) {
        vec2 v = position_of(p.vertex[i], swapped);
        v.x = near(v.x, first.x);
        box.lo = vec2_make(fmin(box.lo.x, v.x), fmin(box.lo.y, v.y));
        box.hi = vec2_make(fmax(box.hi.x, v.x), fmax(box.hi.y, v.y));
    }
    return box;
}

static bool on_earth(polygon p, bool swapped)
{
    for (int32_t i = 0; i < p.count; i++) {
        vec2 v = position_of(p.vertex[i], swapped);
        if (!(fabs(v.x) <= 360 && fabs(v.y) <= 90))
            return false;
    }
    return true;
}

static bool is_icy(box2 box) { return box.lo.y >= LATITUDE_LEAST || box.hi.y <= -LATITUDE_LEAST; }

static bool is_plain_floe(polygon p, bool swapped)
{
    box2 box = box_of(p, swapped);
    double narrow = real_cos(radians(0.5 * (box.lo.y + box.hi.y))); /* degrees of longitude, over those of latitude */
    double size = narrow * (box.hi.x - box.lo.x) * (box.hi.y - box.lo.y);
    return is_icy(box) && size <= FLOE_MOST * FLOE_MOST;
}

static bool look_like_degrees(const import_rings *r, bool swapped)
{
    int32_t rings = 0, plain = 0;
    for (int32_t i = 0; i < r->place.count; i++) {
        polygon p = polygon_list_get(&r->rings, i);
        if (p.count == 0)
            continue;
        rings++;
        plain += is_plain_floe(p, swapped);
    }
    return rings > 0 && plain >= PLAIN_LEAST * rings && on_earth(all_vertices(r), swapped);
}

/* Latitude first: told only by what can be no latitude. */
static bool look_swapped(const import_rings *r)
{
    return !on_earth(all_vertices(r), false) && on_earth(all_vertices(r), true);
}

/* Both numbers may be latitudes, but sea ice lies at one of them only. */
static void warn_of_swapped(context *ctx, const import_rings *r, const import_options *o, box2 box)
{
    bool warm = box.lo.y > -LATITUDE_LEAST && box.hi.y < LATITUDE_LEAST;
    if (warm && on_earth(all_vertices(r), true) && is_icy(box_of(all_vertices(r), true)))
        log_write(ctx, LOG_WARNING, "%.200s: ice at latitude %.4g: longitude comes first; are they swapped?",
                  o->name ? o->name : "degrees", 0.5 * (box.lo.y + box.hi.y));
}

/* Round everything in its place. */
static box2 box_projected(const stereographic *s, polygon p)
{
    vec2 first = stereographic_project(s, p.vertex[0]);
    box2 box = {first, first};
    for (int32_t i = 1; i < p.count; i++) {
        vec2 v = stereographic_project(s, p.vertex[i]);
        box.lo = vec2_make(fmin(box.lo.x, v.x), fmin(box.lo.y, v.y));
        box.hi = vec2_make(fmax(box.hi.x, v.x), fmax(box.hi.y, v.y));
    }
    return box;
}

static fram_status project(context *ctx, const import_rings *r, const import_options *o, import_frame *out,
                           fram_error *error)
{
    if (o->scale != 1)
        return error_set(error, FRAM_ERROR_INPUT, o->name, 0, NULL,
                         "coordinates in degrees have no scale: expected a scale of 1, found %g", o->scale);
    for (int32_t i = 0; i < r->place.count; i++) {
        if (!on_earth(polygon_list_get(&r->rings, i), false))
            return fault(r, o, i, error,
                         look_swapped(r)
                             ? "expected longitudes from -360 to 360 first, and latitudes from -90 to 90 degrees "
                               "second, for the coordinates are to be degrees: are they swapped?"
                             : "expected longitudes from -360 to 360 and latitudes from -90 to 90 degrees, for the "
                               "coordinates are to be degrees");
    }
    if (r->rings.vertex.count == 0)
        return FRAM_OK;
    box2 box = box_of(all_vertices(r), false);
    warn_of_swapped(ctx, r, o, box);
    out->projection = stereographic_make(ELLIPSOID_WGS84, vec2_scale(vec2_add(box.lo, box.hi), 0.5), 1);
    for (int32_t i = 0; i < r->place.count; i++) {
        polygon p = polygon_list_get(&r->rings, i);
        for (int32_t k = 0; k < p.count; k++)
            if (!(vec2_length(stereographic_project(&out->projection, p.vertex[k])) <= REACH_MOST))
                return fault(r, o, i, error,
                             "the field reaches farther than 1000 km from its centre, where it cannot be laid flat; "
                             "cut it, or project it before");
    }
    /* Of a field round a pole the middle of its degrees lies beside it. */
    if (o->centre || box.hi.x - box.lo.x >= HALF_TURN) {
        box2 laid = box_projected(&out->projection, all_vertices(r));
        out->shift = vec2_sub(o->offset, vec2_scale(vec2_add(laid.lo, laid.hi), 0.5));
    }
    return FRAM_OK;
}

static fram_status refuse_degrees(const import_rings *r, const import_options *o, bool swapped, fram_error *error)
{
    char what[400];
    snprintf(what, sizeof what, "the coordinates look like degrees of %s, and %s%s%s",
             swapped ? "latitude and longitude, which are swapped (longitude comes first)" : "longitude and latitude",
             o->as_it_is ? "only lengths are taken here: project them before, as \"fram field\" does"
                         : "lengths are expected: have them projected as degrees, or give the scale that makes metres "
                           "of them",
             o->say_lengths ? "; " : ", 1 too", o->say_lengths ? o->say_lengths : "");
    return fault(r, o, 0, error, what);
}

fram_status import_frame_make(context *ctx, const import_rings *r, const import_options *o, import_frame *out,
                              fram_error *error)
{
    *out = (import_frame){.degrees = o->degrees, .scale = o->scale, .shift = o->offset};
    if (o->degrees)
        return project(ctx, r, o, out, error);
    bool in_question = !o->lengths && o->scale == 1, swapped = in_question && look_swapped(r);
    if (in_question && look_like_degrees(r, swapped))
        return refuse_degrees(r, o, swapped, error);
    if (o->centre && r->rings.vertex.count > 0) {
        box2 box = polygon_bounds(all_vertices(r));
        out->shift = vec2_sub(o->offset, vec2_scale(vec2_add(box.lo, box.hi), 0.5 * o->scale));
    }
    return FRAM_OK;
}

vec2 import_frame_place(const import_frame *f, vec2 position)
{
    vec2 metres = f->degrees ? stereographic_project(&f->projection, position) : vec2_scale(position, f->scale);
    return vec2_add(metres, f->shift);
}
