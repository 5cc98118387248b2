#include "sim/build_vessel.h"

#include "base/number_text.h"
#include "base/transcendental.h"
#include "sim/build_ice.h"
#include "sim/build_propulsion.h"
#include "sim/build_station.h"
#include "sim/vessel_check.h"
#include "vessel/path.h"
#include "vessel/plane_motion.h"

/* Radii of gyration where nothing is given: parts of the beam (roll) and of the length (pitch, yaw), as is usual for
   ships; of what is wider than long yaw goes by the beam.  Roll and yaw are no more than any body has with the others.
 */
static const double GYRATION_ROLL = 0.35, GYRATION_LENGTH = 0.25;

vec3 build_gyration(const scenario_vessel *v, const hull_particulars *p)
{
    double pitch = automatic_or(v->gyration_pitch, GYRATION_LENGTH * p->length);
    double usual = GYRATION_LENGTH * fmax(p->length, p->beam);
    double given = automatic_or(v->gyration_roll, HUGE_VAL);
    double yaw = automatic_or(v->gyration_yaw, fmin(usual, sqrt(given * given + pitch * pitch)));
    double roll = fmin(GYRATION_ROLL * p->beam, sqrt(pitch * pitch + yaw * yaw));
    return vec3_make(automatic_or(v->gyration_roll, roll), pitch, yaw);
}

/* Where the path begins, and the velocity of its first step. */
static fram_status begin_path(context *ctx, const scenario *s, const scenario_vessel *v, int32_t row, world *w,
                              vessel_definition *d, fram_error *error)
{
    if (v->path.count == 0)
        return FRAM_OK;
    int32_t had = w->waypoints.count;
    if (!table_resize(ctx, &w->waypoints, &waypoint_table_info, had + v->path.count))
        return error_memory(error);
    for (int32_t i = 0; i < v->path.count; i++) {
        const scenario_path_point *p = &v->path.data[i];
        w->waypoints.vessel[had + i] = row;
        w->waypoints.time[had + i] = p->time;
        w->waypoints.place[had + i] = vec3_make(p->x, p->y, radians(p->heading_deg));
    }
    double dt = s->run.time_step;
    vec3 begin = path_place(&w->waypoints, row, 0), next = path_place(&w->waypoints, row, dt);
    d->position = vec3_make(begin.x, begin.y, 0);
    d->heading = begin.z;
    d->tow_velocity = vec3_make((next.x - begin.x) / dt, (next.y - begin.y) / dt, 0);
    d->tow_ramp = 0;
    return FRAM_OK;
}

/* The body has the diagonal of the added mass; the rest acts through the loads (fluid/response.h). */
static void give_added_mass(const vessel_model *fixed, int32_t body, body_table *bodies)
{
    if (!fixed->has_hydrodynamics)
        return;
    const matrix6 *a = &fixed->hydrodynamics.added_mass;
    bodies->added_mass[body] = vec3_make(a->m[0][0], a->m[1][1], a->m[2][2]);
    bodies->added_inertia[body] = vec3_make(a->m[3][3], a->m[4][4], a->m[5][5]);
}

static fram_status add_vessel(context *ctx, const scenario *s, const scenario_vessel *v, const vessel_model *fixed,
                              world *w, fram_error *error)
{
    vessel_definition d = {
        .solid = fixed->solid,
        .centre = fixed->centre,
        .mass = automatic_or(v->mass, fixed->displaced_mass),
        .gyration = build_gyration(v, &fixed->particulars),
        .particulars = fixed->particulars,
        .mode = v->mode,
        .position = {v->x, v->y, 0},
        .heading = radians(v->heading_deg),
        .tow_velocity = scenario_velocity(v->speed, automatic_or(v->course_deg, v->heading_deg)),
        .tow_ramp = v->ramp,
    };
    int32_t row = w->vessels.count;
    fram_status status = begin_path(ctx, s, v, row, w, &d, error);
    if (status == FRAM_OK)
        status = vessel_create(ctx, &d, &w->bodies, &w->shapes, &w->joints, &w->vessels, &row, error);
    if (status == FRAM_OK)
        give_added_mass(fixed, w->vessels.body[row], &w->bodies);
    return status;
}

/* The rim of a hull that turns along its path keeps under the speed at which a run ends, as its places do. */
static fram_status check_turns(const scenario *s, const vessel_entry *entry, const world *w, int32_t row,
                               fram_error *error)
{
    const scenario_path_point_list *path = &entry->keys->path;
    double reach = world_reach(w, w->vessels.body[row]);
    for (int32_t i = 1; i < path->count; i++) {
        const scenario_path_point *a = &path->data[i - 1], *b = &path->data[i];
        double turn = fabs(radians(b->heading_deg - a->heading_deg)) / (b->time - a->time);
        if (turn * reach < s->run.speed_limit)
            continue;
        char key[48];
        snprintf(key, sizeof key, "path[%d].heading_deg", (int)i);
        return vessel_fault(s, entry, key, error,
                            "expected a turn at less than run.speed_limit, at which a run ends, %g m/s, found %g m/s "
                            "at %g m from the centre of mass",
                            s->run.speed_limit, turn * reach, reach);
    }
    return FRAM_OK;
}

/* A hull inside a wall would be thrown out of it by the first step. */
static fram_status check_clear_of_walls(context *ctx, const scenario *s, const vessel_entry *entry, const world *w,
                                        int32_t row, fram_error *error)
{
    if (s->domain.boundary != DOMAIN_WALLS)
        return FRAM_OK;
    const scenario_domain *d = &s->domain;
    vec2_array plan = {0};
    fram_status status = build_footprint(ctx, w, w->vessels.body[row], false, &plan, error);
    if (status != FRAM_OK)
        return status;
    box2 hull = polygon_bounds((polygon){plan.data, plan.count});
    array_free(ctx, &plan);
    bool inside_x = hull.lo.x >= d->x_min && hull.hi.x <= d->x_max;
    bool inside_y = hull.lo.y >= d->y_min && hull.hi.y <= d->y_max;
    if (inside_x && inside_y)
        return FRAM_OK;
    return vessel_fault(s, entry, inside_x ? "y" : "x", error,
                        "the hull covers x from %s to %s m, y from %s to %s m, and so reaches into the walls "
                        "of the domain: move it or the walls, or choose domain.boundary: open",
                        coordinate_text_of(hull.lo.x).text, coordinate_text_of(hull.hi.x).text,
                        coordinate_text_of(hull.lo.y).text, coordinate_text_of(hull.hi.y).text);
}

static vessel_title title_of_row(const scenario *s, int32_t row)
{
    vessel_entry entry = scenario_vessel_entry(s, row);
    return vessel_title_of(&entry);
}

/* Part of the smaller footprint that rounding may take for an overlap. */
#define TOUCHING 1e-9

static double plans_overlap(const polygon_list *a, const polygon_list *b)
{
    double common = 0;
    for (int32_t k = 0; k < polygon_list_count(b); k++)
        common += build_plan_overlap(a, polygon_list_get(b, k));
    return common;
}

/* Two hulls that are in each other would be thrown apart by the first step.  Seen from above, decks and overhangs
   included. */
static fram_status check_clear_of_vessels(context *ctx, const scenario *s, const vessel_entry *entry, const world *w,
                                          int32_t row, fram_error *error)
{
    polygon_list own = {0}, other = {0};
    fram_status status = FRAM_OK;
    if (row > 0)
        status = build_plan(ctx, w, w->vessels.body[row], build_slab_all(), &own, error);
    for (int32_t v = 0; v < row && status == FRAM_OK; v++) {
        polygon_list_clear(&other);
        status = build_plan(ctx, w, w->vessels.body[v], build_slab_all(), &other, error);
        double common = status == FRAM_OK ? plans_overlap(&own, &other) : 0;
        if (common > TOUCHING * fmin(build_plan_area(&own), build_plan_area(&other)))
            status = vessel_fault(s, entry, "x", error,
                                  "the hull lies in that of %s at the start, by %.4g m2 as seen from above: move one "
                                  "of them",
                                  title_of_row(s, v).text, common);
    }
    polygon_list_free(ctx, &own);
    polygon_list_free(ctx, &other);
    return status;
}

typedef fram_status (*place_check)(context *ctx, const scenario *s, const vessel_entry *entry, const world *w,
                                   int32_t row, fram_error *error);

typedef struct vessel_pose {
    vec3 position;
    quat orientation;
} vessel_pose;

static vessel_pose trade_pose(body_table *bodies, int32_t body, vessel_pose next)
{
    vessel_pose had = {bodies->position[body], bodies->orientation[body]};
    bodies->position[body] = next.position;
    bodies->orientation[body] = next.orientation;
    return had;
}

/* Who is put well and moved by lines into what the check finds has to look at the lines, not at the place. */
static fram_status check_moored_place(context *ctx, const scenario *s, const vessel_entry *entry, world *w, int32_t row,
                                      vessel_pose put, place_check check, const char *found_in, fram_error *error)
{
    int32_t body = w->vessels.body[row];
    fram_status status = check(ctx, s, entry, w, row, error);
    if (status != FRAM_ERROR_INPUT)
        return status;
    vessel_pose moored = trade_pose(&w->bodies, body, put);
    status = check(ctx, s, entry, w, row, error);
    trade_pose(&w->bodies, body, moored);
    if (status != FRAM_OK)
        return status;
    vec3 by = vec3_sub(moored.position, put.position);
    double turn = plane_angle(quat_roll_pitch_yaw(moored.orientation).z - quat_roll_pitch_yaw(put.orientation).z);
    return vessel_fault(s, entry, "mooring.lines", error,
                        "where they balance current and wind, (%.4g, %.4g) m from where it is put and turned by %.3g "
                        "degrees, the hull stands in %s: look at their count, spacing_deg, direction_deg and "
                        "pretension, or take mooring.equilibrium: false",
                        by.x, by.y, degrees(turn), found_in);
}

fram_status build_vessel(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, world *w,
                         fram_error *error)
{
    int32_t row = w->vessels.count;
    vessel_mesh_warnings(ctx, s, entry, &m->vessels.data[row]);
    fram_status status = vessel_check(s, entry, m, row, error);
    if (status == FRAM_OK)
        status = add_vessel(ctx, s, entry->keys, &m->vessels.data[row], w, error);
    if (status == FRAM_OK)
        status = check_turns(s, entry, w, row, error);
    if (status != FRAM_OK)
        return status;
    int32_t body = w->vessels.body[row];
    const vessel_pose put = {w->bodies.position[body], w->bodies.orientation[body]};
    status = build_station(ctx, s, entry, m, row, w, error);
    if (status == FRAM_OK)
        status = build_propulsion(ctx, s, entry, m, row, w, error);
    if (status == FRAM_OK)
        status = check_moored_place(ctx, s, entry, w, row, put, check_clear_of_walls, "the walls of the domain", error);
    if (status == FRAM_OK)
        status = check_moored_place(ctx, s, entry, w, row, put, check_clear_of_vessels, "another vessel", error);
    if (status == FRAM_OK)
        status = vessel_warnings(ctx, s, entry, m, w, row, error);
    return status;
}
