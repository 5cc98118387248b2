#include "vessel/hull_ship.h"

#include "base/number_text.h"
#include "base/transcendental.h"

#include <math.h>

/* Panels of entrance and run on a side, and strips of a bilge: twice as many change the displacement by less than a
   thousandth, and the mesh has some 250 vertices. */
enum { END_PANELS = 8, SHIP_BILGE_STRIPS = 5, MOST_SHIP_RINGS = SHIP_BILGE_STRIPS + 2, HALVINGS = 100 };
/* Entrance over run, in length: full forms have their finer end aft, and their centre of buoyancy forward. */
#define ENTRANCE_OVER_RUN 0.6
/* Half the waterline of an end is 1 - (1 - s)^n: a parabola where nothing else is asked. */
#define USUAL_FULLNESS 2.0
#define MOST_FULLNESS 12.0
/* An entrance shorter than this times half the beam is a wall, not a bow. */
#define LEAST_ENTRANCE 0.3
/* What is left of the parallel body at the keel, over the length. */
#define LEAST_SHIP_PARALLEL 1e-3
/* A bilge, over the beam, under which there is none. */
#define LEAST_SHIP_BILGE 1e-6
/* The first panel of an end, and a transom, go this much beyond the bilge, so that the keel has a corner there. */
#define BEYOND_BILGE 1.05
#define BLOCK_USUAL 0.8

void hull_ship_fill(hull_particulars *p)
{
    double root = sqrt(p->beam * p->draught);
    double bilge = fmin(0.1 * root, fmin(0.1 * p->beam, 0.5 * p->draught));
    p->stem_angle = isnan(p->stem_angle) ? radians(75) : p->stem_angle;
    p->stern_angle = isnan(p->stern_angle) ? radians(45) : p->stern_angle;
    p->flare_angle = isnan(p->flare_angle) ? 0 : p->flare_angle;
    p->bilge_radius = isnan(p->bilge_radius) ? bilge : p->bilge_radius;
    p->transom = isnan(p->transom) ? 0.5 : p->transom;
    if (p->block_coefficient == 0 && isnan(p->parallel_midbody))
        p->block_coefficient = BLOCK_USUAL;
}

/* ---- lines ---- */

/* One end of the waterline from its tip to the parallel body: how far from the tip, and half the breadth there. */
typedef struct ship_end {
    double along[END_PANELS + 1], half_beam[END_PANELS + 1];
} ship_end;

typedef struct ship_lines {
    double half_length, half_beam, draught, freeboard;
    double stem, stern; /* cot: length per height */
    ship_end fore, aft;
    int rings; /* from the keel to the deck */
    double z[MOST_SHIP_RINGS], inset[MOST_SHIP_RINGS];
} ship_lines;

/* What is left to choose: the length of both ends over the ship's, and the fullness of those whose angle is free. */
typedef struct ship_shape {
    double ends, fullness;
} ship_shape;

/* Breadth of the first panel over that of its end: as for a parabola of equal steps, and beyond the bilge. */
static double first_panel(double bilge_share)
{
    double left = (double)(END_PANELS - 1) / END_PANELS;
    return fmax(1 - left * left, fmin(BEYOND_BILGE * bilge_share, 0.5 * (1 + bilge_share)));
}

/* Fullness at which the first panel has this slope, in breadths of the end per its length (1: a wedge). */
static double fullness_of_slope(double slope, double first)
{
    return slope > 1 ? fmax(real_log(1 - first) / real_log(1 - first / slope), 1) : 1;
}

static ship_end end_of(double length, double fullness, double tip, double half_beam, double first)
{
    ship_end e = {.half_beam[0] = tip};
    for (int i = 1; i <= END_PANELS; i++) {
        double left = (double)(END_PANELS - i) / (END_PANELS - 1), short_of = (1 - first) * left * left;
        e.along[i] = i == END_PANELS ? length : length * (1 - real_pow(short_of, 1 / fullness));
        e.half_beam[i] = i == END_PANELS ? half_beam : tip + (half_beam - tip) * (1 - short_of);
    }
    return e;
}

static void set_rings(ship_lines *l, double radius, double beam)
{
    int strips = radius > LEAST_SHIP_BILGE * beam ? SHIP_BILGE_STRIPS : 0;
    for (int i = 0; i <= strips; i++) {
        double turn = strips ? 0.5 * PI * i / strips : 0.5 * PI;
        l->inset[i] = i == strips ? 0 : radius * (1 - real_sin(turn));
        l->z[i] = i == strips && strips ? radius - l->draught : radius * (1 - real_cos(turn)) - l->draught;
    }
    if (!strips)
        l->z[0] = -l->draught;
    l->inset[strips + 1] = 0;
    l->z[strips + 1] = l->freeboard;
    l->rings = strips + 2;
}

static ship_lines ship_lines_of(const hull_particulars *p, ship_shape shape)
{
    ship_lines l = {.half_length = 0.5 * p->length,
                    .half_beam = 0.5 * p->beam,
                    .draught = p->draught,
                    .freeboard = p->freeboard,
                    .stem = hull_cotangent(p->stem_angle),
                    .stern = hull_cotangent(p->stern_angle)};
    double run = shape.ends * p->length / (1 + ENTRANCE_OVER_RUN), entrance = ENTRANCE_OVER_RUN * run;
    double share = p->bilge_radius / l.half_beam, first = first_panel(share), full = shape.fullness;
    if (!isnan(p->entrance_angle))
        full = fullness_of_slope(real_tan(p->entrance_angle) * entrance / l.half_beam, first);
    l.fore = end_of(entrance, full, 0, l.half_beam, first);
    l.aft = end_of(run, shape.fullness, p->transom * l.half_beam, l.half_beam, first_panel(p->transom > 0 ? 0 : share));
    set_rings(&l, p->bilge_radius, p->beam);
    return l;
}

static double ship_stem_at(const ship_lines *l, double z) { return l->half_length + l->stem * z; }
static double ship_stern_at(const ship_lines *l, double z) { return -l->half_length - l->stern * z; }

/* How far from its tip an end begins at this inset: where its first panel crosses the centre plane. */
static double begin_of(const ship_end *e, double inset)
{
    double short_of = inset - e->half_beam[0];
    return short_of > 0 ? e->along[1] * short_of / (e->half_beam[1] - e->half_beam[0]) : 0;
}

/* ---- volume ---- */

/* Half the area of an end at an inset. */
static double end_area(const ship_end *e, double inset)
{
    double x = begin_of(e, inset), y = fmax(e->half_beam[0] - inset, 0), area = 0;
    for (int i = 1; i <= END_PANELS; i++) {
        double next = e->half_beam[i] - inset;
        area += 0.5 * (y + next) * (e->along[i] - x);
        x = e->along[i];
        y = next;
    }
    return area;
}

static double ship_plane_area(const ship_lines *l, double z, double inset)
{
    double parallel = ship_stem_at(l, z) - ship_stern_at(l, z) - l->fore.along[END_PANELS] - l->aft.along[END_PANELS];
    return 2 * (end_area(&l->fore, inset) + end_area(&l->aft, inset) + parallel * (l->half_beam - inset));
}

/* Under z = 0: corners move straight between rings, so that areas are quadratic in z and Simpson's rule is exact. */
static double ship_volume(const ship_lines *l)
{
    double volume = 0;
    for (int i = 0; i + 1 < l->rings; i++) {
        double low = l->z[i], high = fmin(l->z[i + 1], 0), middle = 0.5 * (low + high);
        double from = l->inset[i], to = l->inset[i + 1];
        volume += (high - low) / 6 *
                  (ship_plane_area(l, low, from) + 4 * ship_plane_area(l, middle, 0.5 * (from + to)) +
                   ship_plane_area(l, high, to));
    }
    return volume;
}

static double ship_block(const hull_particulars *p, ship_shape shape)
{
    ship_lines l = ship_lines_of(p, shape);
    return ship_volume(&l) / (p->length * p->beam * p->draught);
}

/* ---- what the block coefficient leaves open ---- */

/* Length of both ends over the ship's: not so long that the keel has no parallel body, not so short that the bow is a
   wall, or a wedge has to be blunter than asked. */
static double longest_ends(const hull_particulars *p)
{
    double rakes = (hull_cotangent(p->stem_angle) + hull_cotangent(p->stern_angle)) * p->draught / p->length;
    return 1 - rakes - LEAST_SHIP_PARALLEL;
}

static double shortest_ends(const hull_particulars *p)
{
    double entrance = LEAST_ENTRANCE * 0.5 * p->beam;
    if (!isnan(p->entrance_angle))
        entrance = fmax(entrance, 0.5 * p->beam * hull_cotangent(p->entrance_angle));
    return entrance * (1 + ENTRANCE_OVER_RUN) / (ENTRANCE_OVER_RUN * p->length);
}

/* The shapes in the order of their block coefficients, u from 0 to 2.  The longest ends get fuller up to 1, then
   shorter; where the parallel body is given, they get fuller all the way. */
static ship_shape shape_at(const hull_particulars *p, double u)
{
    if (!isnan(p->parallel_midbody))
        return (ship_shape){1 - p->parallel_midbody, 1 + 0.5 * u * (MOST_FULLNESS - 1)};
    double longest = longest_ends(p), shortest = shortest_ends(p);
    return (ship_shape){longest + fmax(u - 1, 0) * (shortest - longest), 1 + fmin(u, 1) * (USUAL_FULLNESS - 1)};
}

static ship_shape shape_of(const hull_particulars *p)
{
    double fine = 0, full = 2;
    if (p->block_coefficient == 0)
        return (ship_shape){1 - p->parallel_midbody, USUAL_FULLNESS};
    for (int i = 0; i < HALVINGS; i++) {
        double middle = 0.5 * (fine + full);
        if (ship_block(p, shape_at(p, middle)) < p->block_coefficient)
            fine = middle;
        else
            full = middle;
    }
    return shape_at(p, full);
}

void hull_ship_block_range(const hull_particulars *p, double *least, double *most)
{
    *least = ship_block(p, shape_at(p, 0));
    *most = ship_block(p, shape_at(p, 2));
}

void hull_ship_ends(const hull_particulars *p, double *entrance, double *run)
{
    ship_lines l = ship_lines_of(p, shape_of(p));
    *entrance = l.fore.along[END_PANELS];
    *run = l.aft.along[END_PANELS];
}

/* ---- particulars ---- */

static fram_status check_ship_angles(const hull_particulars *p, fram_error *error)
{
    const struct {
        const char *key;
        double value, most;
    } angles[] = {{"stem_angle", p->stem_angle, 90},
                  {"stern_angle", p->stern_angle, 90},
                  {"entrance_angle", p->entrance_angle, 85}};
    for (int i = 0; i < 3; i++) {
        bool free = i == 2 && isnan(p->entrance_angle);
        if (!free && !(angles[i].value > 0 && degrees(angles[i].value) <= angles[i].most + 1e-9))
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, angles[i].key,
                             "of a ship this must be over 0 and at most %g degrees, found %g", angles[i].most,
                             degrees(angles[i].value));
    }
    if (p->flare_angle == 0)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "flare_angle",
                     "the sides of form ship are upright, found %g degrees; leave it out, or take form icebreaker",
                     degrees(p->flare_angle));
}

static fram_status check_corners(const hull_particulars *p, fram_error *error)
{
    double most = fmin(0.45 * p->beam, 0.95 * p->draught), bilge = 2 * p->bilge_radius / p->beam;
    if (!(p->bilge_radius >= 0 && p->bilge_radius <= most))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "bilge_radius",
                         "must be 0 to %s m (0.45 of the beam and 0.95 of the draught at most), found %g",
                         most_text_of(most, 4).text, p->bilge_radius);
    if (!(p->transom >= 0 && p->transom <= 0.95))
        return error_value(error, "transom", "a share of the beam from 0 to 0.95", p->transom);
    if (p->transom == 0 || p->transom >= BEYOND_BILGE * bilge)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "transom",
                     "a transom of %g of the beam is narrower than the bilges under it; take 0 (a pointed stern), "
                     "%s or more, or reduce bilge_radius (%g m)",
                     p->transom, least_text_of(BEYOND_BILGE * bilge, 3).text, p->bilge_radius);
}

static fram_status check_room(const hull_particulars *p, fram_error *error)
{
    double longest = longest_ends(p), shortest = shortest_ends(p), parallel = p->parallel_midbody;
    /* What of the rest makes room: the least entrance is that of its angle, and upright ends leave nearly all. */
    bool angle = !isnan(p->entrance_angle) && hull_cotangent(p->entrance_angle) > LEAST_ENTRANCE;
    bool rakes = shortest < 1 - LEAST_SHIP_PARALLEL;
    if (longest < shortest)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "length",
                         "no parallel body is left: the rakes of stem and stern take %.3g of the length at the keel, "
                         "entrance and run at least %.3g; enlarge length%s%s",
                         1 - longest - LEAST_SHIP_PARALLEL, shortest,
                         !rakes  ? ""
                         : angle ? ", the angle of stem, stern"
                                 : ", or the angle of stem or stern",
                         !angle  ? ""
                         : rakes ? " or entrance"
                                 : " or the angle of entrance");
    if (isnan(parallel) || (1 - parallel >= shortest && 1 - parallel <= longest))
        return FRAM_OK;
    const range_text range = range_text_of(1 - longest, 1 - shortest, 3);
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "parallel_midbody",
                     "with the other particulars it can be %s to %s of the length, found %g; entrance and run "
                     "need their room, and the rakes of stem and stern shorten the keel",
                     range.least.text, range.most.text, parallel);
}

fram_status hull_block_refuse(double least, double most, double asked, const char *remedy, fram_error *error)
{
    const range_text range = range_text_of(least, most, 4);
    return error_set(
        error, FRAM_ERROR_INPUT, NULL, 0, "block_coefficient",
        "with the other particulars the block coefficient can be %s to %s, found %g; a larger one takes %s",
        range.least.text, range.most.text, asked, remedy);
}

fram_status hull_ship_check(const hull_particulars *p, fram_error *error)
{
    fram_status status = check_ship_angles(p, error);
    if (status == FRAM_OK)
        status = check_corners(p, error);
    if (status == FRAM_OK)
        status = check_room(p, error);
    double least, most, asked = p->block_coefficient;
    if (status != FRAM_OK || asked == 0)
        return status;
    hull_ship_block_range(p, &least, &most);
    if (asked >= least && asked <= most)
        return FRAM_OK;
    return hull_block_refuse(least, most, asked,
                             "a steeper stem or stern, a wider transom, a smaller bilge_radius or a larger angle of "
                             "entrance, a smaller one the opposite; parallel_midbody is best left out",
                             error);
}

/* ---- surface ---- */

/* A ring from the stem along port to the stern and back along starboard: corner i mirrors corner count - i. */
enum { MOST_HALF = 2 * END_PANELS + 3 };
typedef struct ship_half {
    int count; /* stem to the stern's corner in the centre plane */
    vec3 corner[MOST_HALF];
} ship_half;

static ship_half half_ring(const ship_lines *l, double z, double inset)
{
    ship_half h = {1, {{ship_stem_at(l, z) - begin_of(&l->fore, inset), 0, z}}};
    for (int i = 1; i <= END_PANELS; i++)
        h.corner[h.count++] = (vec3){ship_stem_at(l, z) - l->fore.along[i], l->fore.half_beam[i] - inset, z};
    for (int i = END_PANELS; i >= 1; i--)
        h.corner[h.count++] = (vec3){ship_stern_at(l, z) + l->aft.along[i], l->aft.half_beam[i] - inset, z};
    if (l->aft.half_beam[0] > 0)
        h.corner[h.count++] = (vec3){ship_stern_at(l, z), l->aft.half_beam[0] - inset, z};
    h.corner[h.count++] = (vec3){ship_stern_at(l, z) + begin_of(&l->aft, inset), 0, z};
    return h;
}

/* Corners of a ring; returns how many, 0 without memory. */
static int32_t add_ship_ring(context *ctx, mesh *m, const ship_lines *l, int ring)
{
    ship_half h = half_ring(l, l->z[ring], l->inset[ring]);
    int32_t count = 2 * (h.count - 1);
    for (int32_t i = 0; i < count; i++) {
        vec3 v = h.corner[i < h.count ? i : count - i];
        if (!mesh_add_vertex(ctx, m, i < h.count ? v : vec3_make(v.x, -v.y, v.z)))
            return 0;
    }
    return count;
}

/* A triangle of port, by its corners in the rings `low` and up, and its mirror image. */
static bool add_pair(context *ctx, mesh *m, int32_t count, int32_t low, const int32_t port[3])
{
    int32_t other[3];
    for (int k = 0; k < 3; k++)
        other[k] = port[k] / count * count + (count - port[k] % count) % count;
    return mesh_add_triangle(ctx, m, low + port[0], low + port[1], low + port[2]) &&
           mesh_add_triangle(ctx, m, low + other[0], low + other[2], low + other[1]);
}

static bool add_ship_strip(context *ctx, mesh *m, int32_t count, int32_t low)
{
    for (int32_t i = 0; i < count / 2; i++)
        if (!add_pair(ctx, m, count, low, (int32_t[]){i, i + 1, count + i + 1}) ||
            !add_pair(ctx, m, count, low, (int32_t[]){i, count + i + 1, count + i}))
            return false;
    return true;
}

bool hull_ship_make(context *ctx, const hull_particulars *p, mesh *m)
{
    ship_lines l = ship_lines_of(p, shape_of(p));
    int32_t count = 0;
    for (int i = 0; i < l.rings; i++) {
        count = add_ship_ring(ctx, m, &l, i);
        if (count == 0)
            return false;
    }
    int32_t deck = count * (l.rings - 1);
    for (int32_t low = 0; low < deck; low += count)
        if (!add_ship_strip(ctx, m, count, low))
            return false;
    /* Keel and deck as fans from the stem. */
    for (int32_t i = 1; i + 1 < count; i++)
        if (!mesh_add_triangle(ctx, m, 0, i + 1, i) || !mesh_add_triangle(ctx, m, deck, deck + i, deck + i + 1))
            return false;
    return true;
}
