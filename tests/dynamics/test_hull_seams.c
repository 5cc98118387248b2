/* Hulls that were cut into convex pieces: no contact takes its normal from a cut, and none is lost for it. */
#include "base/transcendental.h"
#include "rig.h"

/* A solid of this outline, 9 m high, cut into convex pieces. */
static int32_t cut_solid(rig *r, solid_array *solids, polygon outline, int32_t least)
{
    int32_t slot = body_create(&r->ctx, &r->bodies, MOTION_STATIC, MATERIAL_HULL), index;
    mesh surface = {0};
    polyhedron_array pieces = {0};
    double concavity;
    fram_error e = {0};
    assert_ok(mesh_make_prism(&r->ctx, outline, -5, 4, &surface, &e), e);
    assert_ok(mesh_convex_pieces(&r->ctx, &surface, 0.2, 20, &pieces, &concavity, &e), e);
    ck_assert_int_ge(pieces.count, least);
    r->shapes.solids = solids;
    assert_ok(solid_add(&r->ctx, solids, &surface, &pieces, concavity, &index, &e), e);
    assert_ok(shape_add_solid(&r->ctx, &r->shapes, index, &r->bodies.shape[slot], &e), e);
    ck_assert(array_resize(&r->ctx, &r->loads, r->bodies.count));
    return slot;
}

/* Straight on the sides with +y, -x and +x; a wedge or a dock in the fourth. */
static const vec2 wedged[] = {{-30, -10}, {0, 8}, {30, -10}, {30, 10}, {-30, 10}};
static const vec2 docked[] = {{-30, -10}, {-10, -10}, {-10, -2}, {10, -2}, {10, -10}, {30, -10}, {30, 10}, {-30, 10}};

/* Obtuse hollow corners, with cuts along one of their sides: a tip that has come in by millimetres or half a metre
   meets one of the two pieces, each of which takes its face there for the other's inside. */
START_TEST(a_tip_in_a_hollow_corner_is_held)
{
    const vec2 star[] = {{18.4007, 0},  {12.0254, 4.9811},   {11.4218, 11.4218},   {6.0630, 14.6375},
                         {0, 15.8374},  {-7.4390, 17.9592},  {-10.5500, 10.5500},  {-16.1252, 6.6793},
                         {-14.0138, 0}, {-13.4242, -5.5605}, {-11.7572, -11.7572}, {-5.5531, -13.4065},
                         {0, -16.3472}, {6.7737, -16.3531},  {10.6449, -10.6449},  {14.7998, -6.1303}};
    const double half = 2.75, depths[] = {0.002, 0.02, 0.1, 0.5};
    rig r = rig_make(0.1);
    solid_array solids = {0};
    cut_solid(&r, &solids, (polygon){star, sizeof star / sizeof *star}, 2);
    int32_t box = rig_box(&r, MOTION_DYNAMIC, vec3_make(2 * half, 2 * half, 4), 900, vec3_make(0, 0, 0));
    vec2 corner = star[6];
    for (int d = 0; d < 4; d++) {
        for (int k = 0; k < 45; k++) {
            /* The tip's way in and the box behind it, about the corner's middle line. */
            double way = -0.745 + 0.6 * (k % 5 - 2) / 2, lie = -0.745 + 0.45 * (k / 5 - 4) / 4;
            vec2 tip = vec2_add(corner, vec2_scale(vec2_make(real_cos(way), real_sin(way)), depths[d]));
            vec2 at = vec2_sub(tip, vec2_scale(vec2_make(real_cos(lie), real_sin(lie)), half * sqrt(2)));
            r.bodies.position[box] = vec3_make(at.x, at.y, 0);
            r.bodies.orientation[box] = quat_from_roll_pitch_yaw(0, 0, lie - PI / 4);
            rig_detect(&r);
            /* Out again, the way that it came. */
            vec3 back = {-real_cos(way), -real_sin(way), 0};
            double most = -1;
            for (int32_t i = 0; i < r.contacts.count; i++)
                most = fmax(most, vec3_dot(r.contacts.data[i].normal, back) * (r.contacts.data[i].a == box ? 1 : -1));
            ck_assert_msg(rig_deepest(&r) > 0 && most > 0.5, "a tip %g m past the corner, %d: %g of it out", depths[d],
                          k, most);
        }
    }
    rig_free(&r);
    solid_array_free(&r.ctx, &solids);
}
END_TEST

/* A box of 6 by 6 by 4 m, turned, is pushed `normal` and no other way all along a line, 5 cm deep. */
static void assert_pushed_along(polygon outline, vec2 from, vec2 to, double turn, vec2 normal)
{
    rig r = rig_make(0.1);
    solid_array solids = {0};
    cut_solid(&r, &solids, outline, 2);
    int32_t box = rig_box(&r, MOTION_DYNAMIC, vec3_make(6, 6, 4), 900, vec3_make(0, 0, 0));
    r.bodies.orientation[box] = quat_from_roll_pitch_yaw(0, 0, turn);
    double lost = 0.05 / 8 * real_sin(turn) / real_cos(turn);
    double reach = 3 * (fabs(real_sin(turn)) + fabs(real_cos(turn))) - 0.05;
    for (int k = 0; k <= 325; k++) {
        vec2 at = vec2_add(from, vec2_scale(vec2_sub(to, from), k / 325.0));
        r.bodies.position[box] = vec3_make(at.x - reach * normal.x, at.y - reach * normal.y, 0);
        rig_detect(&r);
        ck_assert_msg(r.contacts.count > 0, "box at (%g, %g) is not seen", at.x, at.y);
        for (int32_t i = 0; i < r.contacts.count; i++)
            assert_vec3_close(r.contacts.data[i].normal, vec3_make(normal.x, normal.y, 0), 1e-9);
        /* A corner that reaches past a cut by less than an eighth of its depth is not seen there. */
        assert_absolute(rig_deepest(&r), 0.05 - lost / 2, lost / 2 + 1e-9);
    }
    rig_free(&r);
    solid_array_free(&r.ctx, &solids);
}

START_TEST(no_contact_takes_the_normal_of_a_cut)
{
    polygon shapes[] = {{wedged, sizeof wedged / sizeof *wedged}, {docked, sizeof docked / sizeof *docked}};
    const double turns[] = {0, 0.003, 0.3, PI / 4};
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 2; k++)
            assert_pushed_along(shapes[k], vec2_make(-12.96, 10), vec2_make(13.04, 10), turns[i], vec2_make(0, -1));
        assert_pushed_along(shapes[1], vec2_make(30, -7), vec2_make(30, 7), turns[i], vec2_make(-1, 0));
        /* Cuts go along floor or walls of the dock, which are met all the same. */
        assert_pushed_along(shapes[1], vec2_make(-5, -2), vec2_make(5, -2), turns[i], vec2_make(0, 1));
        assert_pushed_along(shapes[1], vec2_make(10, -6.9), vec2_make(10, -6.3), turns[i], vec2_make(1, 0));
    }
}
END_TEST

/* Pressed along a side without friction a box keeps its way.  One step ends a little past a cut. */
START_TEST(a_box_slides_over_a_cut)
{
    rig r = rig_make(0.05);
    r.gravity = vec3_make(0, 0, 0);
    solid_array solids = {0};
    cut_solid(&r, &solids, (polygon){wedged, sizeof wedged / sizeof *wedged}, 2);
    int32_t box = rig_box(&r, MOTION_DYNAMIC, vec3_make(10, 6, 4), 500, vec3_make(-6.64, 13.01, 0));
    r.bodies.velocity[box] = vec3_make(1, 0, 0);
    r.loads.data[box].force = vec3_make(0, -1433, 0);
    for (int k = 0; k < 320; k++) {
        rig_step(&r);
        assert_absolute(r.bodies.velocity[box].x, 1, 1e-9);
        assert_absolute(r.bodies.angular_velocity[box].z, 0, 1e-6);
    }
    assert_absolute(r.bodies.position[box].y, 13, 1e-3);
    rig_free(&r);
    solid_array_free(&r.ctx, &solids);
}
END_TEST

TEST_MAIN("hull seams", no_contact_takes_the_normal_of_a_cut, a_tip_in_a_hollow_corner_is_held, a_box_slides_over_a_cut)
