/* Particulars, generated hulls and zones. */
#include "vessel/hull.h"

#include "base/transcendental.h"

/* Two faces this far apart, relative to the length, are one face of the convex piece. */
#define FACE_TOLERANCE 1e-9
/* The parallel body keeps at least this share of the length at keel and deck, so that no triangle degenerates. */
#define LEAST_PARALLEL 1e-6

static double cotangent(double angle) { return real_cos(angle) / real_sin(angle); }

/* ---- lines of the icebreaking hull; all are straight in z ---- */

typedef struct hull_lines {
    double half_length, half_beam;
    double flare;         /* tan: half beam per height */
    double stem, stern;   /* cot: length per height */
    double entrance, run; /* cot: length per half beam */
} hull_lines;

static hull_lines lines_of(const hull_particulars *p)
{
    double half_beam = 0.5 * p->beam, entrance = cotangent(p->entrance_angle);
    double left = p->length * (1 - p->parallel_midbody) - half_beam * entrance;
    return (hull_lines){.half_length = 0.5 * p->length,
                        .half_beam = half_beam,
                        .flare = real_tan(p->flare_angle),
                        .stem = cotangent(p->stem_angle),
                        .stern = cotangent(p->stern_angle),
                        .entrance = entrance,
                        .run = fmax(left, 0) / half_beam};
}

static double half_beam_at(const hull_lines *l, double z) { return l->half_beam + l->flare * z; }
static double stem_at(const hull_lines *l, double z) { return l->half_length + l->stem * z; }
static double stern_at(const hull_lines *l, double z) { return -l->half_length - l->stern * z; }
/* Ends of the parallel sides. */
static double fore_at(const hull_lines *l, double z) { return stem_at(l, z) - l->entrance * half_beam_at(l, z); }
static double aft_at(const hull_lines *l, double z) { return stern_at(l, z) + l->run * half_beam_at(l, z); }

/* ---- particulars ---- */

static fram_status refuse(fram_error *error, const char *key, const char *rule, double found)
{
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, key, "%s must be %s, found %g", key, rule, found);
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
            return refuse(error, lengths[i].key, "a positive number of metres", lengths[i].value);
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
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, angles[i].key,
                             "%s must be over 0 and at most 90 degrees, found %g", angles[i].key,
                             degrees(angles[i].value));
    if (!(fabs(p->flare_angle) < 0.5 * PI))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "flare_angle",
                         "flare_angle must be between -90 and 90 degrees, found %g", degrees(p->flare_angle));
    if (!(p->parallel_midbody > 0 && p->parallel_midbody <= 1))
        return refuse(error, "parallel_midbody", "a share of the length over 0 and at most 1", p->parallel_midbody);
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
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "parallel_midbody",
                     "no parallel body is left at the %s (z = %g m): the bow reaches aft to x = %g m, the stern "
                     "forward to x = %g m; enlarge parallel_midbody (%g), stem_angle or stern_angle",
                     end.name, end.z, fore, aft, p->parallel_midbody);
}

fram_status hull_particulars_check(const hull_particulars *p, fram_error *error)
{
    fram_status status = check_lengths(p, error);
    if (status != FRAM_OK || p->form != HULL_ICEBREAKER)
        return status;
    status = check_angles(p, error);
    if (status != FRAM_OK)
        return status;
    double entrance = 0.5 * p->beam * cotangent(p->entrance_angle), parallel = p->length * p->parallel_midbody;
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
    return status;
}

/* ---- surfaces ---- */

/* Rings of six at keel (0..5) and deck (6..11), counter-clockwise from above: stem, fore and aft shoulder to port,
   stern, aft and fore shoulder to starboard. */
enum { RING = 6 };

static bool add_ring(context *ctx, mesh *m, const hull_lines *l, double z)
{
    double b = half_beam_at(l, z), fore = fore_at(l, z), aft = aft_at(l, z);
    const vec3 ring[RING] = {{stem_at(l, z), 0, z},  {fore, b, z}, {aft, b, z},
                             {stern_at(l, z), 0, z}, {aft, -b, z}, {fore, -b, z}};
    for (int i = 0; i < RING; i++)
        if (!mesh_add_vertex(ctx, m, ring[i]))
            return false;
    return true;
}

static bool make_icebreaker(context *ctx, const hull_particulars *p, mesh *m)
{
    /* Port side from stem to stern; its mirror image has the other turn. */
    static const int32_t port[][3] = {{0, 1, 7}, {0, 7, 6}, {1, 2, 8}, {1, 8, 7}, {2, 3, 9}, {2, 9, 8}};
    static const int32_t mirror[2 * RING] = {0, 5, 4, 3, 2, 1, 6, 11, 10, 9, 8, 7};
    hull_lines lines = lines_of(p);
    if (!add_ring(ctx, m, &lines, -p->draught) || !add_ring(ctx, m, &lines, p->freeboard))
        return false;
    for (int i = 0; i < 6; i++) {
        const int32_t *t = port[i];
        if (!mesh_add_triangle(ctx, m, t[0], t[1], t[2]) ||
            !mesh_add_triangle(ctx, m, mirror[t[0]], mirror[t[2]], mirror[t[1]]))
            return false;
    }
    /* Keel and deck as fans from the stem: no triangle of them is flat, even with a transom or a blunt bow. */
    for (int32_t i = 1; i + 1 < RING; i++)
        if (!mesh_add_triangle(ctx, m, 0, i + 1, i) || !mesh_add_triangle(ctx, m, RING, RING + i, RING + i + 1))
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
            "a hull of form mesh comes from a mesh file; only box and icebreaker are made from particulars");
    bool made = p->form == HULL_BOX ? make_box(ctx, p, surface) : make_icebreaker(ctx, p, surface);
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

/* ---- zones ---- */

const char *hull_zone_name(hull_zone z)
{
    static const char *const names[ZONE_COUNT] = {"bow", "shoulder", "midbody", "stern", "bottom"};
    return (int)z >= 0 && z < ZONE_COUNT ? names[z] : "none";
}

hull_zones hull_zones_of(const hull_particulars *p)
{
    double bow = 0, stern = 0, least = p->length / 20;
    if (p->form == HULL_ICEBREAKER) {
        hull_lines lines = lines_of(p);
        bow = lines.entrance * lines.half_beam;
        stern = lines.run * lines.half_beam;
    } else if (p->form == HULL_MESH) {
        bow = stern = p->length / 5;
    }
    double end = 0.5 * p->length, fore = end - fmax(bow, least);
    return (hull_zones){fore, fore - p->length / 10, -end + fmax(stern, least), -0.95 * p->draught};
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
