/* Where a hull floats, and what follows; see hydrostatics.h. */
#include "vessel/hydrostatics.h"

#include "base/transcendental.h"

/* Newton steps in heel and trim: a dozen where the sides are straight, some forty from far off. */
enum { MOST_STEPS = 200, MOST_LEVEL_STEPS = 100, MOST_HALVINGS = 30 };
/* Largest turn of one step [rad]: the stiffness is that of the present water plane. */
#define LARGEST_TURN 0.1
/* Arms of the buoyancy this small, relative to the length, are rounding. */
#define ARM_ROUNDING 1e-12
/* Arms that are good enough when no step betters them. */
#define ARM_TOLERANCE 1e-9
/* A hull that is wet or dry over less than this part of its size only touches the water: files hold six digits. */
#define LEAST_IMMERSION 1e-6
/* Levels this near, relative to the depth, are one. */
#define LEVEL_ROUNDING 1e-15

mat3 hull_rotation(const hull_attitude *a) { return quat_matrix(quat_from_roll_pitch_yaw(a->heel, a->trim, 0)); }

static bool turn_mesh(context *ctx, const mesh *surface, mat3 r, mesh *out)
{
    if (!mesh_copy(ctx, out, surface))
        return false;
    for (int32_t i = 0; i < out->vertex.count; i++)
        out->vertex.data[i] = mat3_mul_vec(r, surface->vertex.data[i]);
    return true;
}

fram_status hull_hydrostatics_in(context *ctx, const mesh *surface, const hull_attitude *a, hull_hydrostatics *out,
                                 fram_error *error)
{
    if (a->heel == 0 && a->trim == 0)
        return hull_hydrostatics_at(ctx, surface, a->level, out, error);
    mesh turned = {0};
    fram_status status = turn_mesh(ctx, surface, hull_rotation(a), &turned) ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK)
        status = hull_hydrostatics_at(ctx, &turned, a->level, out, error);
    mesh_free(ctx, &turned);
    return status;
}

/* ---- equilibrium ---- */

/* A hull while its equilibrium is sought. */
typedef struct floating {
    const mesh *surface;
    double volume;
    vec3 centre;
    double length;
    mesh turned;
    hull_attitude attitude;
    hull_hydrostatics h;
    vec3 arm; /* from the centre of mass to that of buoyancy, frame of the still water */
} floating;

/* The level at which the turned hull displaces the volume: Newton's method inside a bracket. */
static fram_status find_level(context *ctx, floating *f, fram_error *error)
{
    box3 box = mesh_bounds(&f->turned);
    double lo = box.lo.z, hi = box.hi.z, depth = hi - lo, level = f->attitude.level;
    fram_status status = FRAM_OK;
    for (int i = 0; i < MOST_LEVEL_STEPS && status == FRAM_OK; i++) {
        if (!(level > lo && level < hi))
            level = 0.5 * (lo + hi);
        status = hull_hydrostatics_at(ctx, &f->turned, level, &f->h, error);
        double missing = f->volume - f->h.volume;
        if (missing > 0)
            lo = level;
        else
            hi = level;
        double step = f->h.waterplane_area > 0 ? missing / f->h.waterplane_area : HUGE_VAL;
        if (missing == 0 || fabs(step) <= LEVEL_ROUNDING * depth || hi - lo <= LEVEL_ROUNDING * depth)
            break;
        level += step;
    }
    f->attitude.level = level;
    return status;
}

static fram_status settle(context *ctx, floating *f, fram_error *error)
{
    mat3 r = hull_rotation(&f->attitude);
    if (!turn_mesh(ctx, f->surface, r, &f->turned))
        return error_memory(error);
    fram_status status = find_level(ctx, f, error);
    f->arm = vec3_sub(f->h.centre_of_buoyancy, mat3_mul_vec(r, f->centre));
    return status;
}

/* Turn [rad] about x and y that Newton's method asks for.  With the volume held, the moments of the buoyancy change by
   the stiffness [[kt, -cxy], [-cxy, kl]], kt = I_xx + V arm_z and so on; its eigenvalues are taken positive, so that
   the step leads downhill in energy wherever it starts. */
static vec2 newton_turn(const floating *f)
{
    double kt = f->h.waterplane_xx + f->h.volume * f->arm.z, kl = f->h.waterplane_yy + f->h.volume * f->arm.z;
    double c = -f->h.waterplane_xy, mx = f->h.volume * f->arm.y, my = -f->h.volume * f->arm.x;
    double middle = 0.5 * (kt + kl), half = 0.5 * (kt - kl), radius = sqrt(half * half + c * c);
    double low = fmax(fabs(middle - radius), 1e-12 * fabs(middle)), high = fmax(fabs(middle + radius), low);
    /* Unit eigenvector of the higher eigenvalue. */
    double ex = half >= 0 ? half + radius : c, ey = half >= 0 ? c : radius - half, size = sqrt(ex * ex + ey * ey);
    if (!(size > 0)) {
        ex = size = 1;
        ey = 0;
    }
    vec2 e = {ex / size, ey / size}, m = {mx, my};
    double along = vec2_dot(e, m) / high, across = vec2_cross(e, m) / low;
    vec2 turn = {e.x * along - e.y * across, e.y * along + e.x * across};
    double most = fmax(fabs(turn.x), fabs(turn.y));
    return most > LARGEST_TURN ? vec2_scale(turn, LARGEST_TURN / most) : turn;
}

static double arm_of(const floating *f) { return sqrt(f->arm.x * f->arm.x + f->arm.y * f->arm.y); }

/* One step, halved until energy or arm falls; false when neither does. */
static fram_status step(context *ctx, floating *f, bool *better, fram_error *error)
{
    hull_attitude from = f->attitude;
    double energy = -f->arm.z, arm = arm_of(f);
    vec2 turn = newton_turn(f);
    *better = false;
    for (int i = 0; i < MOST_HALVINGS; i++) {
        mat3 small = quat_matrix(quat_unit((quat){1, 0.5 * turn.x, 0.5 * turn.y, 0}));
        vec3 angles = quat_roll_pitch_yaw(quat_from_matrix(mat3_mul(small, hull_rotation(&from))));
        f->attitude = (hull_attitude){from.level, angles.x, angles.y};
        fram_status status = settle(ctx, f, error);
        if (status != FRAM_OK)
            return status;
        *better = arm_of(f) < arm || -f->arm.z < energy - ARM_ROUNDING * f->length;
        if (*better)
            return FRAM_OK;
        turn = vec2_scale(turn, 0.5);
    }
    f->attitude = from;
    return settle(ctx, f, error);
}

static fram_status find_equilibrium(context *ctx, floating *f, fram_error *error)
{
    fram_status status = settle(ctx, f, error);
    bool better = true;
    for (int i = 0; i < MOST_STEPS && better && status == FRAM_OK && arm_of(f) > ARM_ROUNDING * f->length; i++)
        status = step(ctx, f, &better, error);
    if (status == FRAM_OK && !(arm_of(f) <= ARM_TOLERANCE * f->length))
        return error_set(
            error, FRAM_ERROR_INPUT, NULL, 0, "centre",
            "with its centre of mass at (%g, %g, %g) m the hull finds no equilibrium: at heel %g and trim %g "
            "degrees the buoyancy still has an arm of %g m; lower the centre or move it amidships",
            f->centre.x, f->centre.y, f->centre.z, degrees(f->attitude.heel), degrees(f->attitude.trim), arm_of(f));
    return status;
}

static fram_status begin(const mesh *surface, double volume, vec3 centre, floating *f, fram_error *error)
{
    box3 box = mesh_bounds(surface);
    double enclosed = mesh_solid_properties(surface).volume;
    *f = (floating){.surface = surface, .volume = volume, .centre = centre, .length = box.hi.x - box.lo.x};
    f->attitude.level = 0.5 * (box.lo.z + box.hi.z);
    if (volume > 0 && volume < enclosed)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "mass",
                     "a hull that encloses %.9g m3 floats when its mass displaces more than 0 and less than that; this "
                     "one displaces %.9g m3",
                     enclosed, volume);
}

fram_status hull_level_of(context *ctx, const mesh *surface, double volume, double *level, fram_error *error)
{
    floating f;
    fram_status status = begin(surface, volume, (vec3){0, 0, 0}, &f, error);
    if (status == FRAM_OK)
        status = settle(ctx, &f, error);
    mesh_free(ctx, &f.turned);
    if (status == FRAM_OK)
        *level = f.attitude.level;
    return status;
}

fram_status hull_float(context *ctx, const mesh *surface, double volume, vec3 centre, hull_attitude *out,
                       fram_error *error)
{
    floating f;
    fram_status status = begin(surface, volume, centre, &f, error);
    if (status == FRAM_OK)
        status = find_equilibrium(ctx, &f, error);
    mesh_free(ctx, &f.turned);
    if (status == FRAM_OK)
        *out = f.attitude;
    return status;
}

/* ---- sections ---- */

fram_status hull_slicer_make(context *ctx, const mesh *surface, int axis, hull_slicer *out, fram_error *error)
{
    *out = (hull_slicer){.axis = axis};
    bool done = mesh_copy(ctx, &out->turned, surface);
    for (int32_t i = 0; done && i < surface->vertex.count; i++) {
        vec3 p = surface->vertex.data[i];
        out->turned.vertex.data[i] = axis == 0 ? vec3_make(p.y, p.z, p.x) : axis == 1 ? vec3_make(p.z, p.x, p.y) : p;
    }
    if (done && mesh_adjacency_build(ctx, &out->turned, &out->adjacency) == FRAM_OK)
        return FRAM_OK;
    hull_slicer_free(ctx, out);
    return error_memory(error);
}

void hull_slicer_free(context *ctx, hull_slicer *s)
{
    mesh_free(ctx, &s->turned);
    mesh_adjacency_free(ctx, &s->adjacency);
}

fram_status hull_slice(context *ctx, const hull_slicer *s, double at, polygon_list *out, fram_error *error)
{
    return mesh_section_along(ctx, &s->turned, &s->adjacency, at, out, error);
}

/* Area of the section x = at on the wet side of normal . p = level. */
static fram_status wet_section_area(context *ctx, const mesh *surface, double at, vec3 normal, double level,
                                    double *area, fram_error *error)
{
    hull_slicer slicer;
    polygon_list rings = {0};
    vec2_array wet = {0};
    *area = 0;
    fram_status status = hull_slicer_make(ctx, surface, 0, &slicer, error);
    if (status != FRAM_OK)
        return status;
    status = hull_slice(ctx, &slicer, at, &rings, error);
    for (int32_t i = 0; i < polygon_list_count(&rings) && status == FRAM_OK; i++) {
        if (!polygon_clip_half_plane(ctx, polygon_list_get(&rings, i), vec2_make(normal.y, normal.z),
                                     level - normal.x * at, &wet))
            status = error_memory(error);
        else
            *area += polygon_area((polygon){wet.data, wet.count});
    }
    array_free(ctx, &wet);
    polygon_list_free(ctx, &rings);
    hull_slicer_free(ctx, &slicer);
    return status;
}

/* ---- stability ---- */

static void set_stiffness(hull_stability *s, vec3 centre)
{
    const hull_hydrostatics *h = &s->at;
    double a = h->waterplane_area, v = h->volume, arm = h->centre_of_buoyancy.z - centre.z;
    double dx = h->centre_of_flotation.x - centre.x, dy = h->centre_of_flotation.y - centre.y;
    s->bm_transverse = h->waterplane_xx / v;
    s->bm_longitudinal = h->waterplane_yy / v;
    s->gm_transverse = s->bm_transverse + arm;
    s->gm_longitudinal = s->bm_longitudinal + arm;
    double kt = h->waterplane_xx + v * arm, kl = h->waterplane_yy + v * arm;
    s->stable = kt > 0 && kl > 0 && kt * kl > h->waterplane_xy * h->waterplane_xy;
    s->c33 = a;
    s->c34 = a * dy;
    s->c35 = -a * dx;
    s->c44 = kt + a * dy * dy;
    s->c45 = -(h->waterplane_xy + a * dx * dy);
    s->c55 = kl + a * dx * dx;
}

/* Height of the water over the lowest point of the hull, above (x, 0), along the hull's z. */
static double draught_at(const hull_attitude *a, vec3 normal, double keel, double x)
{
    return (a->level - normal.x * x) / normal.z - keel;
}

static void set_lengths(hull_stability *s, const mesh *surface, const hull_attitude *a, mat3 rotation)
{
    box3 box = mesh_bounds(surface);
    vec3 normal = {rotation.m[2][0], rotation.m[2][1], rotation.m[2][2]};
    box2 line = s->at.waterline;
    s->length_overall = box.hi.x - box.lo.x;
    s->breadth_overall = box.hi.y - box.lo.y;
    s->depth = box.hi.z - box.lo.z;
    s->length_waterline = line.hi.x - line.lo.x;
    s->breadth_waterline = line.hi.y - line.lo.y;
    vec3 aft = mat3_tmul_vec(rotation, vec3_make(line.lo.x, s->at.centre_of_flotation.y, a->level));
    vec3 fore = mat3_tmul_vec(rotation, vec3_make(line.hi.x, s->at.centre_of_flotation.y, a->level));
    s->midships = 0.5 * (aft.x + fore.x);
    s->draught = draught_at(a, normal, box.lo.z, s->midships);
    s->draught_fore = draught_at(a, normal, box.lo.z, fore.x);
    s->draught_aft = draught_at(a, normal, box.lo.z, aft.x);
    s->kb = s->centre_of_buoyancy.z - box.lo.z;
    s->kg = s->centre.z - box.lo.z;
}

static double ratio(double part, double whole) { return whole > 0 ? part / whole : 0; }

bool hull_is_cut(const mesh *surface, const hull_attitude *a)
{
    box3 box = mesh_bounds(surface);
    mat3 rotation = hull_rotation(a);
    double size = vec3_length(vec3_sub(box.hi, box.lo)), lo = HUGE_VAL, hi = -HUGE_VAL;
    for (int32_t i = 0; i < surface->vertex.count; i++) {
        double z = mat3_mul_vec(rotation, surface->vertex.data[i]).z;
        lo = fmin(lo, z);
        hi = fmax(hi, z);
    }
    return a->level - lo > LEAST_IMMERSION * size && hi - a->level > LEAST_IMMERSION * size;
}

static fram_status refuse_level(const mesh *surface, const hull_attitude *a, fram_error *error)
{
    box3 box = mesh_bounds(surface);
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "draught",
                     "the water at z = %g m does not cut the hull, which reaches from z = %g to %g m; give a draught "
                     "or a mass, or a file whose z = 0 is its waterline",
                     a->level, box.lo.z, box.hi.z);
}

fram_status hull_stability_of(context *ctx, const mesh *surface, const hull_attitude *a, vec3 centre,
                              hull_stability *out, fram_error *error)
{
    *out = (hull_stability){.centre = centre};
    fram_status status = hull_hydrostatics_in(ctx, surface, a, &out->at, error);
    if (status != FRAM_OK)
        return status;
    const hull_hydrostatics *h = &out->at;
    if (!(h->volume > 0 && h->waterplane_area > 0) || !hull_is_cut(surface, a))
        return refuse_level(surface, a, error);
    mat3 rotation = hull_rotation(a);
    vec2 f = h->centre_of_flotation;
    out->enclosed_volume = mesh_solid_properties(surface).volume;
    out->centre_of_buoyancy = mat3_tmul_vec(rotation, h->centre_of_buoyancy);
    out->centre_of_flotation = mat3_tmul_vec(rotation, vec3_make(f.x, f.y, a->level));
    set_stiffness(out, mat3_mul_vec(rotation, centre));
    set_lengths(out, surface, a, rotation);
    vec3 normal = {rotation.m[2][0], rotation.m[2][1], rotation.m[2][2]};
    status = wet_section_area(ctx, surface, out->midships, normal, a->level, &out->midship_area, error);
    double plane = out->length_waterline * out->breadth_waterline;
    out->block = ratio(h->volume, plane * out->draught);
    out->waterplane = ratio(h->waterplane_area, plane);
    out->midship = ratio(out->midship_area, out->breadth_waterline * out->draught);
    out->prismatic = ratio(h->volume, out->midship_area * out->length_waterline);
    return status;
}
