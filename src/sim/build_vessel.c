#include "sim/build_vessel.h"

#include "base/number_text.h"
#include "base/transcendental.h"
#include "sim/build_ice.h"
#include "sim/build_propulsion.h"
#include "sim/build_station.h"
#include "sim/vessel_check.h"
#include "vessel/plane_motion.h"
#include "vessel/prescribed_path.h"

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
    double reach = world_reach_about(w, w->vessels.body[row], vec3_make(0, 0, 1));
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

/* How much of two hulls is in each other, seen from above, decks and overhangs included [m2]; 0: they touch at most. */
static fram_status hulls_overlap(context *ctx, const world *w, int32_t a, int32_t b, double *common, fram_error *error)
{
    polygon_list one = {0}, other = {0};
    fram_status status = build_plan(ctx, w, w->vessels.body[a], build_slab_all(), &one, error);
    if (status == FRAM_OK)
        status = build_plan(ctx, w, w->vessels.body[b], build_slab_all(), &other, error);
    if (status == FRAM_OK) {
        *common = plans_overlap(&one, &other);
        if (!(*common > TOUCHING * fmin(build_plan_area(&one), build_plan_area(&other))))
            *common = 0;
    }
    polygon_list_free(ctx, &one);
    polygon_list_free(ctx, &other);
    return status;
}

static void trade_pose(world *w, int32_t row, vessel_pose *other)
{
    int32_t body = w->vessels.body[row];
    vessel_pose had = {w->bodies.position[body], w->bodies.orientation[body]};
    w->bodies.position[body] = other->position;
    w->bodies.orientation[body] = other->orientation;
    *other = had;
}

/* Who is put well and moved by lines into something has to look at the lines, not at the place. */
static fram_status lines_fault(const scenario *s, const world *w, int32_t row, vessel_pose put, const char *found_in,
                               fram_error *error)
{
    const vessel_entry entry = scenario_vessel_entry(s, row);
    int32_t body = w->vessels.body[row];
    vec3 by = vec3_sub(w->bodies.position[body], put.position);
    const double largest = fmax(fabs(by.x), fabs(by.y));
    quat moored = w->bodies.orientation[body];
    double turn = plane_angle(quat_roll_pitch_yaw(moored).z - quat_roll_pitch_yaw(put.orientation).z);
    return vessel_fault(s, &entry, "mooring.lines", error,
                        "where they balance current and wind, (%.4g, %.4g) m from where it is put and turned by %.3g "
                        "degrees, the hull stands in %s: look at their count, spacing_deg, direction_deg and "
                        "pretension, or take mooring.equilibrium: false",
                        told_beside(by.x, largest, LEAST_TOLD), told_beside(by.y, largest, LEAST_TOLD),
                        told_beside(degrees(turn), 0, LEAST_TOLD), found_in);
}

static fram_status check_walls(context *ctx, const scenario *s, const vessel_entry *entry, world *w, int32_t row,
                               const vessel_pose_array *put, fram_error *error)
{
    vessel_pose pose = put->data[row];
    fram_status status = check_clear_of_walls(ctx, s, entry, w, row, error);
    if (status != FRAM_ERROR_INPUT)
        return status;
    trade_pose(w, row, &pose);
    status = check_clear_of_walls(ctx, s, entry, w, row, error);
    trade_pose(w, row, &pose);
    return status == FRAM_OK ? lines_fault(s, w, row, pose, "the walls of the domain", error) : status;
}

/* Of two hulls that are in each other the one whose lines moved it there, the later one where those of both did; -1:
   they are where they are put. */
static fram_status find_moved(context *ctx, world *w, int32_t row, int32_t v, const vessel_pose_array *put,
                              int32_t *moved, fram_error *error)
{
    static const struct {
        bool own, other;
    } tries[] = {{true, false}, {false, true}, {true, true}};
    fram_status status = FRAM_OK;
    *moved = -1;
    for (size_t i = 0; i < sizeof tries / sizeof *tries && status == FRAM_OK && *moved < 0; i++) {
        vessel_pose own = put->data[row], other = put->data[v];
        double common = 0;
        if (tries[i].own)
            trade_pose(w, row, &own);
        if (tries[i].other)
            trade_pose(w, v, &other);
        status = hulls_overlap(ctx, w, row, v, &common, error);
        if (status == FRAM_OK && common == 0)
            *moved = tries[i].own ? row : v;
        if (tries[i].own)
            trade_pose(w, row, &own);
        if (tries[i].other)
            trade_pose(w, v, &other);
    }
    return status;
}

/* Two hulls that are in each other would be thrown apart by the first step. */
static fram_status check_vessels(context *ctx, const scenario *s, const vessel_entry *entry, world *w, int32_t row,
                                 const vessel_pose_array *put, fram_error *error)
{
    for (int32_t v = 0; v < row; v++) {
        double common = 0;
        int32_t moved;
        fram_status status = hulls_overlap(ctx, w, row, v, &common, error);
        if (status == FRAM_OK && common == 0)
            continue;
        if (status == FRAM_OK)
            status = find_moved(ctx, w, row, v, put, &moved, error);
        if (status != FRAM_OK)
            return status;
        if (moved >= 0)
            return lines_fault(s, w, moved, put->data[moved], "another vessel", error);
        return vessel_fault(s, entry, "x", error,
                            "the hull lies in that of %s at the start, by %.4g m2 as seen from above: move one of them",
                            title_of_row(s, v).text, common);
    }
    return FRAM_OK;
}

fram_status build_vessel(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, world *w,
                         vessel_pose_array *put, fram_error *error)
{
    int32_t row = w->vessels.count;
    vessel_mesh_warnings(ctx, s, entry, m, row);
    fram_status status = vessel_check(s, entry, m, row, error);
    if (status == FRAM_OK)
        status = add_vessel(ctx, s, entry->keys, &m->vessels.data[row], w, error);
    if (status == FRAM_OK)
        status = check_turns(s, entry, w, row, error);
    if (status != FRAM_OK)
        return status;
    int32_t body = w->vessels.body[row];
    const vessel_pose own = {w->bodies.position[body], w->bodies.orientation[body]};
    if (!array_push(ctx, put, own))
        return error_memory(error);
    status = build_station(ctx, s, entry, m, row, w, error);
    if (status == FRAM_OK)
        status = build_propulsion(ctx, s, entry, m, row, w, error);
    if (status == FRAM_OK)
        status = check_walls(ctx, s, entry, w, row, put, error);
    if (status == FRAM_OK)
        status = check_vessels(ctx, s, entry, w, row, put, error);
    if (status == FRAM_OK)
        status = vessel_warnings(ctx, s, entry, m, w, row, error);
    return status;
}
