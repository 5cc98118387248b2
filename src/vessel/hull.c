/* Particulars, generated hulls and zones. */
#include "vessel/hull.h"

#include "base/transcendental.h"
#include "vessel/hull_cone.h"
#include "vessel/hull_ship.h"

/* Two faces this far apart, relative to the length, are one face of the convex piece. */
#define FACE_TOLERANCE 1e-9
/* The parallel body keeps at least this share of the length at keel and deck, so that no triangle degenerates. */
#define LEAST_PARALLEL 1e-6

double hull_cotangent(double angle) { return real_cos(angle) / real_sin(angle); }

/* ---- lines of the icebreaking hull; all are straight in z ---- */

typedef struct hull_lines {
    double half_length, half_beam;
    double flare;         /* tan: half beam per height */
    double stem, stern;   /* cot: length per height */
    double entrance, run; /* cot: length per half beam */
} hull_lines;

static hull_lines lines_of(const hull_particulars *p)
{
    double half_beam = 0.5 * p->beam, entrance = hull_cotangent(p->entrance_angle);
    double left = p->length * (1 - p->parallel_midbody) - half_beam * entrance;
    return (hull_lines){.half_length = 0.5 * p->length,
                        .half_beam = half_beam,
                        .flare = real_tan(p->flare_angle),
                        .stem = hull_cotangent(p->stem_angle),
                        .stern = hull_cotangent(p->stern_angle),
                        .entrance = entrance,
                        .run = fmax(left, 0) / half_beam};
}

static double half_beam_at(const hull_lines *l, double z) { return l->half_beam + l->flare * z; }
static double stem_at(const hull_lines *l, double z) { return l->half_length + l->stem * z; }
static double stern_at(const hull_lines *l, double z) { return -l->half_length - l->stern * z; }
/* Ends of the parallel sides. */
static double fore_at(const hull_lines *l, double z) { return stem_at(l, z) - l->entrance * half_beam_at(l, z); }
static double aft_at(const hull_lines *l, double z) { return stern_at(l, z) + l->run * half_beam_at(l, z); }

/* ---- sections ---- */

/* Strips of a bilge; as many again change the volume by a thousandth. */
enum { BILGE_STRIPS = 8, MOST_RINGS = BILGE_STRIPS + 2 };
/* The bilge reaches this far towards keel and waterline at most, so that some flat keel and side are left. */
#define BILGE_REACH 0.97
/* The bilge is drawn this far from its corner towards the chord at most: there its strips would be one plane. */
#define BILGE_FLATTENING 0.999
/* A bilge smaller than this is none: its strips would have no breadth, and it takes 1e-9 of the volume. */
#define LEAST_BILGE 1e-4
enum { BLOCK_HALVINGS = 100 };

/* Half the section amidships: half beam and height of each ring, from the keel to the deck. */
typedef struct hull_section {
    int count;
    double half_beam[MOST_RINGS], z[MOST_RINGS];
} hull_section;

/* bilge 0: a corner between keel and side; to 1: an arc of a parabola, tangent to both, that grows; to 2: its control
   point moves from the corner to the chord. */
static hull_section section_of(const hull_particulars *p, const hull_lines *l, double bilge)
{
    double corner = half_beam_at(l, -p->draught);
    hull_section s = {2, {corner, half_beam_at(l, p->freeboard)}, {-p->draught, p->freeboard}};
    if (bilge < LEAST_BILGE)
        return s;
    double reach = BILGE_REACH * fmin(bilge, 1), flattening = BILGE_FLATTENING * fmax(bilge - 1, 0);
    vec2 first = {(1 - reach) * corner, -p->draught}, last = {0, -p->draught * (1 - reach)};
    last.x = half_beam_at(l, last.y);
    vec2 control = vec2_make(corner, -p->draught), chord = vec2_scale(vec2_add(first, last), 0.5);
    control = vec2_add(control, vec2_scale(vec2_sub(chord, control), flattening));
    s.count = MOST_RINGS;
    for (int i = 0; i <= BILGE_STRIPS; i++) {
        double u = (double)i / BILGE_STRIPS, a = (1 - u) * (1 - u), b = 2 * u * (1 - u), c = u * u;
        s.half_beam[i] = a * first.x + b * control.x + c * last.x;
        s.z[i] = a * first.y + b * control.y + c * last.y;
    }
    s.half_beam[BILGE_STRIPS + 1] = half_beam_at(l, p->freeboard);
    s.z[BILGE_STRIPS + 1] = p->freeboard;
    return s;
}

/* Area of the water plane of a hexagon of half beam b at height z. */
static double plane_area(const hull_lines *l, double b, double z)
{
    return b * (2 * (stem_at(l, z) - stern_at(l, z)) - (l->entrance + l->run) * b);
}

/* Volume under z = 0: areas are quadratic in z between rings, so that Simpson's rule is exact. */
static double volume_of(const hull_lines *l, const hull_section *s)
{
    double volume = 0;
    for (int i = 0; i + 1 < s->count; i++) {
        double low = s->z[i], high = fmin(s->z[i + 1], 0), middle = 0.5 * (low + high), b = s->half_beam[i];
        double slope = (s->half_beam[i + 1] - b) / (s->z[i + 1] - low);
        volume += (high - low) / 6 *
                  (plane_area(l, b, low) + 4 * plane_area(l, b + slope * (middle - low), middle) +
                   plane_area(l, b + slope * (high - low), high));
    }
    return volume;
}

static double block_of(const hull_particulars *p, const hull_lines *l, double bilge)
{
    hull_section s = section_of(p, l, bilge);
    return volume_of(l, &s) / (p->length * p->beam * p->draught);
}

void hull_block_range(const hull_particulars *p, double *least, double *most)
{
    *least = *most = 1;
    if (p->form == HULL_SHIP)
        hull_ship_block_range(p, least, most);
    if (p->form != HULL_ICEBREAKER)
        return;
    hull_lines l = lines_of(p);
    *least = block_of(p, &l, 2);
    *most = block_of(p, &l, 0);
}

/* The bilge of a block coefficient within reach: it falls as the bilge grows. */
static double bilge_of(const hull_particulars *p, const hull_lines *l)
{
    double lo = 0, hi = 2;
    if (p->block_coefficient == 0 || p->block_coefficient >= block_of(p, l, 0))
        return 0;
    for (int i = 0; i < BLOCK_HALVINGS; i++) {
        double middle = 0.5 * (lo + hi);
        if (block_of(p, l, middle) > p->block_coefficient)
            lo = middle;
        else
            hi = middle;
    }
    return hi;
}

/* ---- particulars ---- */

void hull_particulars_fill(hull_particulars *p)
{
    if (p->form == HULL_SHIP) {
        hull_ship_fill(p);
        return;
    }
    double *angle[] = {&p->stem_angle, &p->entrance_angle, &p->stern_angle};
    for (int i = 0; i < 3; i++)
        *angle[i] = isnan(*angle[i]) ? radians(30) : *angle[i];
    p->flare_angle = isnan(p->flare_angle) ? radians(8) : p->flare_angle;
    p->parallel_midbody = isnan(p->parallel_midbody) ? 0.4 : p->parallel_midbody;
}

static fram_status check_lengths(const hull_particulars *p, fram_error *error)
{
    const struct {
        const char *key;
        double value;
    } lengths[] = {{"length", p->length}, {"beam", p->beam}, {"draught", p->draught}, {"freeboard", p->freeboard}};
    int count = p->form == HULL_MESH ? 3 : 4;
    for (int i = 0; i < count; i++)
        if (!(lengths[i].value > 0 && lengths[i].value < HUGE_VAL))
            return error_value(error, lengths[i].key, "a positive number of metres", lengths[i].value);
    return FRAM_OK;
}

static fram_status check_angles(const hull_particulars *p, fram_error *error)
{
    const struct {
        const char *key;
        double value;
    } angles[] = {
        {"stem_angle", p->stem_angle}, {"entrance_angle", p->entrance_angle}, {"stern_angle", p->stern_angle}};
    for (int i = 0; i < 3; i++)
        if (!(angles[i].value > 0 && angles[i].value <= 0.5 * PI))
            return error_value(error, angles[i].key, "an angle over 0 and at most 90 degrees",
                               degrees(angles[i].value));
    if (!(fabs(p->flare_angle) < 0.5 * PI))
        return error_value(error, "flare_angle", "an angle between -90 and 90 degrees", degrees(p->flare_angle));
    if (!(p->parallel_midbody > 0 && p->parallel_midbody <= 1))
        return error_value(error, "parallel_midbody", "a share of the length over 0 and at most 1",
                           p->parallel_midbody);
    return FRAM_OK;
}

/* One end of the lines: what is straight in z holds between them if it holds at both. */
typedef struct hull_end {
    const char *name;
    double z;
} hull_end;

static fram_status check_breadth(const hull_particulars *p, const hull_lines *l, hull_end end, fram_error *error)
{
    if (half_beam_at(l, end.z) > LEAST_PARALLEL * p->beam)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "flare_angle",
                     "with flare_angle %g degrees and a beam of %g m no breadth is left at the %s (z = %g m)",
                     degrees(p->flare_angle), p->beam, end.name, end.z);
}

static fram_status check_parallel(const hull_particulars *p, const hull_lines *l, hull_end end, fram_error *error)
{
    double fore = fore_at(l, end.z), aft = aft_at(l, end.z);
    if (fore - aft > LEAST_PARALLEL * p->length)
        return FRAM_OK;
    /* Rakes shorten the keel and lengthen the deck; flare makes a narrow keel and a broad deck, whose ends take more of
       the length. */
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "parallel_midbody",
                     "no parallel body is left at the %s (z = %g m): the bow reaches aft to x = %g m, the stern "
                     "forward to x = %g m; %s parallel_midbody (%g)",
                     end.name, end.z, fore, aft,
                     end.z < 0 ? "enlarge the flare or the angle of stem or stern, reduce draught, or enlarge"
                               : "reduce freeboard, the flare or the angle of stem or stern, or enlarge",
                     p->parallel_midbody);
}

static fram_status check_block(const hull_particulars *p, fram_error *error)
{
    double least, most, asked = p->block_coefficient, slack = LEAST_BILGE * LEAST_BILGE;
    if (asked == 0 || p->form == HULL_MESH || p->form == HULL_CONE)
        return FRAM_OK;
    hull_block_range(p, &least, &most);
    if (asked >= least - slack && asked <= most + slack)
        return FRAM_OK;
    if (p->form == HULL_BOX)
        return error_value(error, "block_coefficient", "1, that of a box, or none: a finer hull takes another form",
                           asked);
    return hull_block_refuse(least, most, asked,
                             "a steeper stem or stern, less flare or more parallel_midbody, a smaller "
                             "one the opposite",
                             error);
}

fram_status hull_particulars_check(const hull_particulars *p, fram_error *error)
{
    fram_status status = check_lengths(p, error);
    if (status == FRAM_OK && p->form == HULL_BOX)
        status = check_block(p, error);
    else if (status == FRAM_OK && p->form == HULL_CONE)
        status = hull_cone_check(p, error);
    else if (status == FRAM_OK && p->form == HULL_SHIP)
        status = hull_ship_check(p, error);
    if (status != FRAM_OK || p->form != HULL_ICEBREAKER)
        return status;
    status = check_angles(p, error);
    if (status != FRAM_OK)
        return status;
    double entrance = 0.5 * p->beam * hull_cotangent(p->entrance_angle), parallel = p->length * p->parallel_midbody;
    if (entrance + parallel > p->length * (1 + FACE_TOLERANCE))
        return error_set(
            error, FRAM_ERROR_INPUT, NULL, 0, "entrance_angle",
            "an entrance of %g m (half the beam at %g degrees) and a parallel body of %g m do not fit into a "
            "length of %g m; enlarge entrance_angle or length, or reduce parallel_midbody",
            entrance, degrees(p->entrance_angle), parallel, p->length);
    hull_lines lines = lines_of(p);
    const hull_end ends[2] = {{"keel", -p->draught}, {"deck", p->freeboard}};
    for (int i = 0; i < 2 && status == FRAM_OK; i++)
        status = check_breadth(p, &lines, ends[i], error);
    for (int i = 0; i < 2 && status == FRAM_OK; i++)
        status = check_parallel(p, &lines, ends[i], error);
    return status == FRAM_OK ? check_block(p, error) : status;
}

/* ---- surfaces ---- */

/* Rings of six from the keel to the deck, counter-clockwise from above: stem, fore and aft shoulder to port, stern, aft
   and fore shoulder to starboard. */
enum { RING = 6 };

static bool add_ring(context *ctx, mesh *m, const hull_lines *l, double b, double z)
{
    double fore = stem_at(l, z) - l->entrance * b, aft = stern_at(l, z) + l->run * b;
    const vec3 ring[RING] = {{stem_at(l, z), 0, z},  {fore, b, z}, {aft, b, z},
                             {stern_at(l, z), 0, z}, {aft, -b, z}, {fore, -b, z}};
    for (int i = 0; i < RING; i++)
        if (!mesh_add_vertex(ctx, m, ring[i]))
            return false;
    return true;
}

/* The strip between the ring that begins at vertex `low` and the next one. */
static bool add_strip(context *ctx, mesh *m, int32_t low)
{
    /* Port side from stem to stern; its mirror image has the other turn. */
    static const int32_t port[][3] = {{0, 1, 7}, {0, 7, 6}, {1, 2, 8}, {1, 8, 7}, {2, 3, 9}, {2, 9, 8}};
    static const int32_t mirror[2 * RING] = {0, 5, 4, 3, 2, 1, 6, 11, 10, 9, 8, 7};
    for (int i = 0; i < 6; i++) {
        const int32_t *t = port[i];
        if (!mesh_add_triangle(ctx, m, low + t[0], low + t[1], low + t[2]) ||
            !mesh_add_triangle(ctx, m, low + mirror[t[0]], low + mirror[t[2]], low + mirror[t[1]]))
            return false;
    }
    return true;
}

static bool make_icebreaker(context *ctx, const hull_particulars *p, mesh *m)
{
    hull_lines lines = lines_of(p);
    hull_section section = section_of(p, &lines, bilge_of(p, &lines));
    int32_t deck = RING * (section.count - 1);
    for (int i = 0; i < section.count; i++)
        if (!add_ring(ctx, m, &lines, section.half_beam[i], section.z[i]))
            return false;
    for (int32_t low = 0; low < deck; low += RING)
        if (!add_strip(ctx, m, low))
            return false;
    /* Keel and deck as fans from the stem: no triangle of them is flat, even with a transom or a blunt bow. */
    for (int32_t i = 1; i + 1 < RING; i++)
        if (!mesh_add_triangle(ctx, m, 0, i + 1, i) || !mesh_add_triangle(ctx, m, deck, deck + i, deck + i + 1))
            return false;
    return true;
}

static bool make_box(context *ctx, const hull_particulars *p, mesh *m)
{
    vec3 half = {0.5 * p->length, 0.5 * p->beam, 0};
    return mesh_make_box(ctx, vec3_make(-half.x, -half.y, -p->draught), vec3_make(half.x, half.y, p->freeboard), m);
}

fram_status hull_make(context *ctx, const hull_particulars *p, mesh *surface, polyhedron_array *pieces,
                      fram_error *error)
{
    fram_status status = hull_particulars_check(p, error);
    if (status != FRAM_OK)
        return status;
    if (p->form == HULL_MESH)
        return error_set(
            error, FRAM_ERROR_INPUT, NULL, 0, "form",
            "a hull of form mesh comes from a mesh file; box, icebreaker, cone and ship are made from particulars");
    bool made = p->form == HULL_BOX    ? make_box(ctx, p, surface)
                : p->form == HULL_CONE ? hull_cone_make(ctx, p, surface)
                : p->form == HULL_SHIP ? hull_ship_make(ctx, p, surface)
                                       : make_icebreaker(ctx, p, surface);
    polyhedron piece = {0};
    status = made ? polyhedron_hull(ctx, surface->vertex.data, surface->vertex.count, FACE_TOLERANCE * p->length,
                                    &piece, error)
                  : error_memory(error);
    if (status == FRAM_OK && array_push(ctx, pieces, piece))
        return FRAM_OK;
    if (status == FRAM_OK)
        status = error_memory(error);
    polyhedron_free(ctx, &piece);
    mesh_free(ctx, surface);
    return status;
}

/* ---- pieces ---- */

/* Concavity that is allowed where nothing is said, as a part of the breadth: floes are not much smaller than the
   breadth, and meet a surface that is off by less than their own thickness. */
#define DEFAULT_CONCAVITY 0.01

fram_status hull_cut(context *ctx, const mesh *surface, double *tolerance, int32_t most, polyhedron_array *pieces,
                     double *concavity, fram_error *error)
{
    box3 box = mesh_bounds(surface);
    if (isnan(*tolerance))
        *tolerance = DEFAULT_CONCAVITY * (box.hi.y - box.lo.y);
    return mesh_convex_pieces(ctx, surface, *tolerance, most, pieces, concavity, error);
}

/* ---- zones ---- */

hull_zones hull_zones_of(const hull_particulars *p)
{
    double bow = 0, stern = 0, least = p->length / 20;
    if (p->form == HULL_ICEBREAKER) {
        hull_lines lines = lines_of(p);
        bow = lines.entrance * lines.half_beam;
        stern = lines.run * lines.half_beam;
    } else if (p->form == HULL_SHIP) {
        hull_ship_ends(p, &bow, &stern);
    } else if (p->form == HULL_MESH || p->form == HULL_CONE) {
        bow = stern = p->length / 5;
    }
    double end = 0.5 * p->length, fore = p->midships + end - fmax(bow, least);
    return (hull_zones){fore, fore - p->length / 10, p->midships - end + fmax(stern, least), -0.95 * p->draught};
}

hull_zone hull_zone_at(const hull_zones *zones, vec3 point)
{
    if (point.z < zones->bottom)
        return ZONE_BOTTOM;
    if (point.x > zones->bow)
        return ZONE_BOW;
    /* A short parallel body: the stern takes what the shoulder would. */
    if (point.x <= zones->stern)
        return ZONE_STERN;
    return point.x > zones->shoulder ? ZONE_SHOULDER : ZONE_MIDBODY;
}

const char *hull_zone_name(hull_zone zone)
{
    static const char *const names[ZONE_COUNT] = {"bow", "shoulder", "midbody", "stern", "bottom"};
    return names[zone];
}
