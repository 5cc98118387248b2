#include "vessel/vessel.h"

#define TABLE_SELF vessel_table
TABLE_DEFINE(vessel, VESSEL_FIELDS)
#undef TABLE_SELF

static bool is_finite(double x) { return fabs(x) < HUGE_VAL; }
static bool is_finite_vector(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

static fram_status check_vessel(const vessel_definition *d, const shape_store *shapes, fram_error *error)
{
    if (d->solid < 0 || !shapes->solids || d->solid >= shapes->solids->count)
        return error_value(error, "solid", "a solid of the shape store", d->solid);
    if (!(d->mass > 0 && is_finite(d->mass)))
        return error_value(error, "mass", "a positive number of kilograms", d->mass);
    double least = fmin(d->gyration.x, fmin(d->gyration.y, d->gyration.z));
    if (!(least > 0) || !is_finite_vector(d->gyration))
        return error_value(error, "gyration", "three positive numbers of metres", least);
    if (!is_finite_vector(d->centre))
        return error_value(error, "centre", "three numbers of metres", d->centre.x);
    if (!is_finite_vector(d->position))
        return error_value(error, "position", "three numbers of metres", d->position.x);
    if (!is_finite(d->heading))
        return error_value(error, "heading", "an angle", d->heading);
    if (!is_finite_vector(d->tow_velocity))
        return error_value(error, "tow_velocity", "three numbers of metres per second", d->tow_velocity.x);
    if (!(d->tow_ramp >= 0 && is_finite(d->tow_ramp)))
        return error_value(error, "tow_ramp", "a number of seconds, 0 or more", d->tow_ramp);
    if ((int)d->mode < VESSEL_PRESCRIBED || d->mode > VESSEL_FREE)
        return error_value(error, "mode", "prescribed, towed or free", (int)d->mode);
    return hull_particulars_check(&d->particulars, error);
}

/* Tow velocity at a time: grows linearly, then stays. */
static vec3 tow_velocity_at(vec3 velocity, double ramp, double time)
{
    return time < ramp ? vec3_scale(velocity, fmax(time, 0) / ramp) : velocity;
}

static int32_t create_hull(context *ctx, const vessel_definition *d, body_table *bodies, int32_t shape, int32_t owner)
{
    int32_t slot =
        body_create(ctx, bodies, d->mode == VESSEL_PRESCRIBED ? MOTION_PRESCRIBED : MOTION_DYNAMIC, MATERIAL_HULL);
    if (slot < 0)
        return slot;
    bodies->orientation[slot] = quat_from_roll_pitch_yaw(0, 0, d->heading);
    bodies->position[slot] = vec3_add(d->position, mat3_mul_vec(quat_matrix(bodies->orientation[slot]), d->centre));
    bodies->velocity[slot] = tow_velocity_at(d->tow_velocity, d->mode == VESSEL_FREE ? 0 : d->tow_ramp, 0);
    vec3 k = d->gyration;
    bodies->mass[slot] = d->mass;
    bodies->inertia[slot] = (sym3){.xx = d->mass * k.x * k.x, .yy = d->mass * k.y * k.y, .zz = d->mass * k.z * k.z};
    bodies->shape[slot] = shape;
    bodies->owner[slot] = owner;
    return slot;
}

/* A bodiless point on the hull's centre of mass that moves as told. */
static int32_t create_carriage(context *ctx, body_table *bodies, int32_t hull, int32_t owner)
{
    int32_t slot = body_create(ctx, bodies, MOTION_PRESCRIBED, MATERIAL_WALL);
    if (slot < 0)
        return slot;
    bodies->position[slot] = bodies->position[hull];
    bodies->orientation[slot] = bodies->orientation[hull];
    bodies->velocity[slot] = bodies->velocity[hull];
    bodies->owner[slot] = owner;
    return slot;
}

/* Hull, carriage and joint; false: no memory, and none of them is left. */
static bool create_bodies(context *ctx, const vessel_definition *d, body_table *bodies, joint_table *joints,
                          vessel_table *vessels, int32_t row, int32_t shape)
{
    int32_t hull = create_hull(ctx, d, bodies, shape, row), carriage = -1, joint = -1;
    if (hull < 0)
        return false;
    if (d->mode == VESSEL_TOWED) {
        carriage = create_carriage(ctx, bodies, hull, row);
        joint = carriage < 0 ? -1
                             : joint_create(ctx, joints, bodies, carriage, hull, JOINT_PRISMATIC_Z,
                                            bodies->position[hull], quat_identity());
        if (joint < 0) {
            if (carriage >= 0)
                body_remove(bodies, carriage);
            body_remove(bodies, hull);
            return false;
        }
    }
    vessels->body[row] = hull;
    vessels->carriage[row] = carriage;
    vessels->joint[row] = joint;
    return true;
}

fram_status vessel_create(context *ctx, const vessel_definition *d, body_table *bodies, shape_store *shapes,
                          joint_table *joints, vessel_table *vessels, int32_t *row, fram_error *error)
{
    fram_status status = check_vessel(d, shapes, error);
    if (status != FRAM_OK)
        return status;
    int32_t new_row = vessels->count, shape = -1;
    if (!table_resize(ctx, vessels, &vessel_table_info, new_row + 1))
        return error_memory(error);
    status = shape_add_solid(ctx, shapes, d->solid, &shape, error);
    if (status == FRAM_OK && !create_bodies(ctx, d, bodies, joints, vessels, new_row, shape)) {
        shape_remove(shapes, shape);
        status = error_memory(error);
    }
    if (status != FRAM_OK) {
        vessels->count = new_row;
        return status;
    }
    vessels->mode[new_row] = (uint8_t)d->mode;
    vessels->centre[new_row] = d->centre;
    vessels->length[new_row] = d->particulars.length;
    vessels->beam[new_row] = d->particulars.beam;
    vessels->draught[new_row] = d->particulars.draught;
    vessels->zones[new_row] = hull_zones_of(&d->particulars);
    vessels->tow_velocity[new_row] = d->tow_velocity;
    vessels->tow_ramp[new_row] = d->tow_ramp;
    *row = new_row;
    return FRAM_OK;
}

void vessel_drive(const vessel_table *vessels, body_table *bodies, double time)
{
    for (int32_t i = 0; i < vessels->count; i++) {
        if (vessels->mode[i] == VESSEL_FREE)
            continue;
        int32_t slot = vessels->mode[i] == VESSEL_TOWED ? vessels->carriage[i] : vessels->body[i];
        bodies->velocity[slot] = tow_velocity_at(vessels->tow_velocity[i], vessels->tow_ramp[i], time);
        bodies->angular_velocity[slot] = vec3_make(0, 0, 0);
    }
}

vec3 vessel_ship_coordinates(const vessel_table *vessels, const body_table *bodies, int32_t row, vec3 point)
{
    return vec3_add(body_to_local(bodies, vessels->body[row], point), vessels->centre[row]);
}
