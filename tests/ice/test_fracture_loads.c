/* Which area and which crack a load on a floe is judged by, against the capacities of the formulas. */
#include "sheet_rig.h"

#include "ice/fracture_parts.h"

static const double OVER = 1.001;

static double capacity(const fracture_rig *r, double horizontal_area)
{
    return fracture_edge_stress(&r->settings, &FRACTURE_RIG_ICE, 1, 1, horizontal_area, EDGE_STRAIGHT).wedge_capacity;
}

/* The level part of a steep patch bends the floe that it is on, not the whole of it. */
START_TEST(steep_patch_loads_its_level_part)
{
    for (int turn = 0; turn < 2; turn++) {
        fracture_rig r;
        fracture_rig_make(&r);
        r.settings.splitting = SPLITTING_NONE;
        int32_t row = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC);
        ck_assert(fracture_rig_load(&r, row, (vec2){49.9, 0}, (turn ? OVER : 1 / OVER) * capacity(&r, 0.4), 1.6));
        r.patches.data[0].horizontal_area = 0.4;
        ck_assert_int_eq(fracture_rig_break(&r), turn);
        if (turn)
            assert_relative(r.events.data[0].stress_ratio, OVER, 1e-12);
        fracture_rig_free(&r);
    }
}
END_TEST

/* Of two floes each is bent by what of the load and of the area stands across its own plane: the other one is tilted by
   50 degrees. */
START_TEST(each_floe_takes_the_area_across_its_plane)
{
    const double tilt = radians(50), area = 1.2, across = real_cos(tilt);
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.splitting = SPLITTING_NONE;
    r.settings.under_ice_contacts = true;
    int32_t level = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC),
            tilted = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC);
    r.floes.breakable[level] = 0;
    r.bodies.orientation[r.floes.body[tilted]] = quat_from_roll_pitch_yaw(tilt, 0, 0);
    double load = OVER * capacity(&r, area * across) / across;
    ck_assert(fracture_rig_load(&r, level, (vec2){49.9, 0}, load, area));
    r.contacts.data[0].b = r.patches.data[0].surface_body = r.floes.body[tilted];
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    assert_relative(r.events.data[0].stress_ratio, OVER, 1e-12);
    fracture_rig_free(&r);
}
END_TEST

/* Two halves of a load on both sides of a seam: of one hull they are one load on the area of both; of two hulls they
   are two loads, which the ice bears. */
START_TEST(halves_on_a_seam_are_one_load_of_one_hull)
{
    const double area = 0.6;
    for (int hulls = 1; hulls <= 2; hulls++) {
        fracture_rig r;
        fracture_rig_make(&r);
        sheet_make(&r, (box2){{-60, 0}, {60, 90}}, 30, NULL);
        int32_t second = body_create(&r.ctx, &r.bodies, MOTION_PRESCRIBED, MATERIAL_HULL);
        ck_assert_int_ge(second, 0);
        for (int side = -1; side <= 1; side += 2) {
            ck_assert(sheet_load(&r, (vec2){0.5 * side, 0.4}, OVER / 2 * capacity(&r, 2 * area), area));
            crushing_patch *p = &r.patches.data[r.patches.count - 1];
            vec3 at = r.bodies.position[p->floe_body];
            p->plan = (box2){{fmin(0, side) - at.x, -at.y}, {fmax(0, side) - at.x, 0.8 - at.y}};
            if (hulls == 2 && side > 0)
                r.contacts.data[r.contacts.count - 1].b = p->surface_body = second;
        }
        ck_assert_int_eq(fracture_rig_break(&r), hulls == 1);
        if (hulls == 1)
            assert_relative(r.events.data[0].stress_ratio, OVER, 1e-12);
        fracture_rig_free(&r);
    }
}
END_TEST

/* On a spike wedges break off under a load that opens no radial crack yet: without one, the floe does not split along
   it, though the crack would be short enough.  Under a load that opens it, it splits. */
START_TEST(without_a_radial_crack_no_floe_splits)
{
    const double area = 0.5, length = 9;
    fracture_rig r;
    fracture_rig_make(&r);
    fracture_state state = fracture_rig_state(&r);
    fram_error error = {0};
    fracture_job j = {&r.ctx, r.scratch, &r.settings, r.plane, &state, &r.events, &error};
    for (int turn = 0; turn < 2; turn++) {
        double half = length * real_tan(radians(20));
        const vec2 ring[3] = {{0, 0}, {length, -half}, {length, half}};
        int32_t row = fracture_rig_floe(&r, (polygon){ring, 3}, 1, MOTION_DYNAMIC);
        vec3 at = r.bodies.position[r.floes.body[row]];
        fracture_load l = {.body = r.floes.body[row],
                           .floe = row,
                           .force = 1e5,
                           .place = {-at.x, -at.y},
                           .horizontal_area = area,
                           .thickness = 1,
                           .ice = FRACTURE_RIG_ICE};
        edge_ice edge = fracture_floe_ice(&j, &l);
        edge_stress s = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, area, edge);
        ck_assert_double_gt(s.radial_capacity, 1.01 * s.wedge_capacity);
        ck_assert(length > s.breaking_radius && length < r.settings.splitting_factor * s.breaking_radius);
        double load = turn ? 1.001 * s.radial_capacity : 0.999 * s.radial_capacity;
        ck_assert(fracture_rig_load(&r, row, l.place, load, area));
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        ck_assert_int_eq(r.events.data[0].kind, turn ? FRACTURE_SPLIT : FRACTURE_BENDING);
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

TEST_MAIN("fracture loads", steep_patch_loads_its_level_part, each_floe_takes_the_area_across_its_plane,
          halves_on_a_seam_are_one_load_of_one_hull, without_a_radial_crack_no_floe_splits)
