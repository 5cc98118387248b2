/* Scenes of the peers as worlds: walls, box ship and floes, with the scene's own water or Fram's. */
#include "base/transcendental.h"
#include "geometry/space_curve.h"
#include "io/atomic_file.h"
#include "sim/bench_measure.h"

#include <stdio.h>

/* Walls as the peers have them: this thick, and from -WALL_HEIGHT/2 to WALL_HEIGHT/2 [m]. */
#define WALL_THICKNESS 20.0
#define WALL_HEIGHT 40.0
/* Margin of the fat boxes [m], and how far ahead of a moving body they reach [s]: a share of the peers' floes, of 13 m
   at under a metre a second, that keeps boxes for tens of steps. */
#define BOX_MARGIN 0.5
#define BOX_LOOKAHEAD 0.5
/* A body this fast means that the run went wrong [m/s]. */
#define SPEED_LIMIT 100.0
/* What the accurate solver aims at, to judge the others by [m/s]. */
#define ACCURATE_TOLERANCE 1e-8
#define ACCURATE_ITERATIONS 5000

/* A world made from a scene. */
typedef struct bench_world {
    model m;
    world w;
    column_water water;
    int32_array slot; /* of each floe of the scene */
    int32_t ship;     /* slot, -1 without */
} bench_world;

static fram_status add_prism(context *ctx, world *w, motion kind, material substance, polygon outline, double height,
                             vec3 position, int32_t *slot, fram_error *error)
{
    int32_t shape;
    fram_status status = shape_add_prism(ctx, &w->shapes, NULL, outline, height / 2, 0, &shape, error);
    if (status != FRAM_OK)
        return status;
    *slot = body_create(ctx, &w->bodies, kind, substance);
    if (*slot < 0)
        return error_memory(error);
    w->bodies.position[*slot] = position;
    w->bodies.shape[*slot] = shape;
    return FRAM_OK;
}

static fram_status add_box(context *ctx, world *w, motion kind, material substance, vec3 size, vec3 position,
                           int32_t *slot, fram_error *error)
{
    double x = size.x / 2, y = size.y / 2;
    vec2 corner[4] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    return add_prism(ctx, w, kind, substance, (polygon){corner, 4}, size.z, position, slot, error);
}

static fram_status add_scene_walls(context *ctx, const scene_text *s, world *w, fram_error *error)
{
    double t = WALL_THICKNESS, long_x = s->domain.hi.x - s->domain.lo.x + 2 * t;
    double long_y = s->domain.hi.y - s->domain.lo.y + 2 * t;
    vec2 middle = vec2_scale(vec2_add(s->domain.lo, s->domain.hi), 0.5);
    const vec3 place[4] = {{s->domain.lo.x - t / 2, middle.y, 0},
                           {s->domain.hi.x + t / 2, middle.y, 0},
                           {middle.x, s->domain.lo.y - t / 2, 0},
                           {middle.x, s->domain.hi.y + t / 2, 0}};
    for (int i = 0; i < 4; i++) {
        int32_t slot;
        vec3 size = {i < 2 ? t : long_x, i < 2 ? long_y : t, WALL_HEIGHT};
        fram_status status = add_box(ctx, w, MOTION_STATIC, MATERIAL_WALL, size, place[i], &slot, error);
        if (status != FRAM_OK)
            return status;
    }
    return FRAM_OK;
}

static fram_status add_ship(context *ctx, const scene_text *s, bench_world *b, fram_error *error)
{
    b->ship = -1;
    if (!s->ship)
        return FRAM_OK;
    vec3 size = {s->ship_length, s->ship_beam, s->ship_depth};
    vec3 place = {s->ship_centre.x, s->ship_centre.y, 0.5 * s->ship_depth - s->ship_draught};
    fram_status status = add_box(ctx, &b->w, MOTION_PRESCRIBED, MATERIAL_HULL, size, place, &b->ship, error);
    if (status == FRAM_OK)
        b->w.bodies.velocity[b->ship] = vec3_make(s->ship_velocity.x, s->ship_velocity.y, 0);
    return status;
}

/* Mass and inertia as in the peers: about the body's origin, without products. */
static fram_status add_floe(context *ctx, const scene_text *s, bench_world *b, int32_t floe, fram_error *error)
{
    const scene_floe *f = &s->floes.data[floe];
    polygon outline = scene_floe_outline(s, floe);
    vec3 place = {f->centre.x, f->centre.y, floe_floating_elevation(f->thickness, f->density, s->water_density)};
    int32_t slot;
    fram_status status =
        add_prism(ctx, &b->w, MOTION_DYNAMIC, MATERIAL_ICE, outline, f->thickness, place, &slot, error);
    if (status != FRAM_OK)
        return status;
    polygon_moments m = polygon_moments_of(outline);
    double per_area = f->thickness * f->density, mass = per_area * m.area;
    double xx = m.xx + m.area * m.centroid.y * m.centroid.y, yy = m.yy + m.area * m.centroid.x * m.centroid.x;
    double flat = mass * f->thickness * f->thickness / 12;
    b->w.bodies.mass[slot] = mass;
    b->w.bodies.inertia[slot] =
        (sym3){.xx = per_area * xx + flat, .yy = per_area * yy + flat, .zz = per_area * (xx + yy)};
    b->slot.data[floe] = slot;
    return FRAM_OK;
}

/* Floes along a space-filling curve: neighbours in the water are neighbours in memory. */
static fram_status add_floes(context *ctx, const scene_text *s, bench_world *b, fram_error *error)
{
    int32_t count = s->floes.count;
    vec2 *centre = memory_array(ctx, (size_t)count, sizeof *centre);
    int32_t *order = memory_array(ctx, (size_t)count, sizeof *order);
    fram_status status = centre && order && array_resize(ctx, &b->slot, count) ? FRAM_OK : error_memory(error);
    if (centre && order && status == FRAM_OK) {
        for (int32_t i = 0; i < count; i++)
            centre[i] = s->floes.data[i].centre;
        if (!space_curve_order(ctx, centre, count, order))
            status = error_memory(error);
        for (int32_t i = 0; i < count && status == FRAM_OK; i++)
            status = add_floe(ctx, s, b, order[i], error);
    }
    memory_free(ctx, centre);
    memory_free(ctx, order);
    return status;
}

static void world_release(context *ctx, bench_world *b)
{
    world_free(ctx, &b->w);
    model_free(ctx, &b->m);
    column_water_free(ctx, &b->water);
    array_free(ctx, &b->slot);
}

static fram_status make_scene_world(context *ctx, const scene_text *s, bench_world *b, fram_error *error)
{
    *b = (bench_world){.ship = -1};
    fram_status status = world_init(ctx, &b->m, &b->w, error);
    if (status != FRAM_OK)
        return status;
    status = add_scene_walls(ctx, s, &b->w, error);
    if (status == FRAM_OK)
        status = add_ship(ctx, s, b, error);
    if (status == FRAM_OK)
        status = add_floes(ctx, s, b, error);
    column_medium medium = {s->gravity, s->water_density, s->current, s->form_drag, s->skin_drag};
    if (status == FRAM_OK)
        status = column_water_make(ctx, &medium, &b->w.bodies, &b->w.shapes, &b->water, error);
    if (status != FRAM_OK)
        world_release(ctx, b);
    return status;
}

static model model_of(const scene_text *s, const bench_scene_options *o, const bench_world *b)
{
    scenario usual;
    scenario_defaults(&usual, scenario_default_scale());
    const scenario_solver *keys = &usual.run.solver;
    model out = {
        .time_step = o->time_step,
        .forces = o->exact_water ? FORCES_FLUID : FORCES_COLUMNS,
        .media = {.gravity = s->gravity, .water_density = s->water_density, .current = {s->current.x, s->current.y, 0}},
        .drag = {[MATERIAL_ICE] = {.water_form = s->form_drag, .water_skin = s->skin_drag}},
        .columns = &b->water,
        .collision = {.margin = BOX_MARGIN, .lookahead = BOX_LOOKAHEAD},
        .crushing = {.time_step = o->time_step},
        .solver = {.kind = o->solver,
                   .iterations = o->iterations,
                   .position_iterations = o->iterations,
                   .warm_start = true,
                   .correction_rate = keys->correction_rate,
                   .contact_skin = keys->contact_skin,
                   .tolerance = o->solver == SOLVER_ACCURATE ? ACCURATE_TOLERANCE : keys->tolerance,
                   .most_iterations = ACCURATE_ITERATIONS},
        .boundary = DOMAIN_WALLS,
        .domain = s->domain,
        .speed_limit = SPEED_LIMIT,
    };
    for (int i = 0; i < MATERIAL_COUNT; i++)
        for (int j = 0; j < MATERIAL_COUNT; j++)
            out.policies.of[i][j] = (pair_policy){.friction_static = s->friction, .friction_kinetic = s->friction};
    return out;
}

/* ---- final poses ---- */

static fram_status write_pose(file_writer *file, const bench_world *b, int32_t floe, fram_error *error)
{
    int32_t slot = b->slot.data[floe];
    vec3 p = b->w.bodies.position[slot];
    quat q = b->w.bodies.orientation[slot];
    double upright = fmin(1, fabs(quat_matrix(q).m[2][2]));
    char line[400];
    int size = snprintf(line, sizeof line, "%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.3f\n", (int)floe, p.x, p.y, p.z,
                        q.x, q.y, q.z, q.w, degrees(real_acos(upright)));
    return file_write(file, line, (size_t)size, error);
}

/* The peers' own columns, so that one script reads the poses of every program. */
static fram_status dump_poses(context *ctx, const bench_world *b, const char *path, fram_error *error)
{
    static const char header[] = "id,x,y,z,qx,qy,qz,qw,tilt_deg\n";
    atomic_file file;
    fram_status status = atomic_file_begin(ctx, path, &file, error);
    if (status != FRAM_OK)
        return status;
    status = file_write(&file.writer, header, sizeof header - 1, error);
    for (int32_t i = 0; i < b->slot.count && status == FRAM_OK; i++)
        status = write_pose(&file.writer, b, i, error);
    if (status == FRAM_OK)
        return atomic_file_commit(&file, error);
    atomic_file_abandon(&file);
    return status;
}

fram_status bench_scene(context *ctx, const scene_text *scene, const bench_scene_options *options, bench_result *out,
                        fram_error *error)
{
    *out = (bench_result){0};
    bench_world b;
    fram_status status = make_scene_world(ctx, scene, &b, error);
    if (status != FRAM_OK)
        return status;
    b.m = model_of(scene, options, &b);
    int64_t warm = scenario_step_at(options->warm, options->time_step);
    int64_t steps = scenario_step_at(options->time, options->time_step) - warm;
    status = bench_measure(ctx, &b.m, &b.w, b.ship, warm, steps < 1 ? 1 : steps, out, error);
    out->floes = scene->floes.count;
    if (status == FRAM_OK && options->dump)
        status = dump_poses(ctx, &b, options->dump, error);
    world_release(ctx, &b);
    return status;
}
