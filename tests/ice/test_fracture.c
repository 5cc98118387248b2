/* Fracture of single floes: criteria, cracks, splits, stencils, new floes. */
#include "fracture_rig.h"

#include <stdio.h>

static int32_t first_floe(const fracture_rig *r)
{
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0)
            return i;
    return -1;
}

/* ---- formulas ---- */

START_TEST(loaded_radius)
{
    assert_relative(fracture_loaded_radius(2, PI / 2, 1, false), sqrt(4 / PI), 1e-15);
    assert_relative(fracture_loaded_radius(0, PI / 2, 2, true), 0.65, 1e-15);
    /* Westergaard's radius meets the plain one at 1.724 h. */
    double a = 1.7239, area = a * a * PI / 2;
    assert_relative(fracture_loaded_radius(area, PI / 2, 1, true), fracture_loaded_radius(area, PI / 2, 1, false),
                    2e-4);
    assert_relative(fracture_loaded_radius(4 * area, PI / 2, 1, true), 2 * a, 1e-14);
}
END_TEST

/* Nevel 1961 (docs/theory.md): N = 3, a/l = 0.1. */
START_TEST(wedge_capacity)
{
    fracture_settings s = fracture_rig_settings();
    s.thick_plate_radius = false;
    double l = ice_characteristic_length(&FRACTURE_RIG_ICE, 1, 1025, 9.81);
    double area = 0.01 * l * l * 3 * fracture_wedge_width(3) / 2;
    edge_stress e = fracture_edge_stress(&s, &FRACTURE_RIG_ICE, 1, 1e5, area, EDGE_STRAIGHT);
    assert_absolute(e.length, 14.6079, 5e-5);
    assert_relative(e.wedge_radius, 0.1 * l, 1e-14);
    assert_absolute(e.wedge_capacity / 0.5e6, 0.7248, 5e-5);
    assert_absolute(e.breaking_radius, 7.47, 5e-3);
    assert_relative(e.wedge_stress / 0.5e6, 1e5 / e.wedge_capacity, 1e-14);
    assert_relative(e.radial_stress / 0.5e6, 1e5 / e.radial_capacity, 1e-14);
    ck_assert(e.radial_capacity < e.wedge_capacity);
}
END_TEST

/* Published factors by width over length, middle of a side (docs/oracles.md, section 3). */
START_TEST(splitting_force)
{
    static const double PUBLISHED[6][2] = {{0.5, 0.1334}, {2.0 / 3, 0.1540}, {1, 0.1869},
                                           {1.5, 0.2077}, {2, 0.2105},       {3, 0.2107}};
    for (int i = 0; i < 6; i++) {
        double side = PUBLISHED[i][0] / 2;
        assert_relative(fracture_splitting_factor(1, side, side), PUBLISHED[i][1], 2e-3);
    }
    assert_absolute(fracture_splitting_force(1, 150e3, 50, 25, 25), 198e3, 500);
    assert_relative(fracture_splitting_force(2, 150e3, 50, 25, 25), 2 * fracture_splitting_force(1, 150e3, 50, 25, 25),
                    1e-15);
}
END_TEST

/* Off the middle, off the nodes of the table, and in the limits: finite elements on meshes of their own
   (validation/splitting_factors.py). */
START_TEST(splitting_beside_the_middle)
{
    static const double ELEMENTS[][3] = {
        {0.0070, 0.1000, 0.0249}, {0.0217, 0.3100, 0.0439}, {0.0233, 0.3333, 0.0456}, {0.0308, 0.4400, 0.0524},
        {0.0440, 0.1000, 0.0621}, {0.0476, 0.6800, 0.0652}, {0.0600, 0.1000, 0.0711}, {0.0609, 0.8700, 0.0737},
        {0.0651, 0.9300, 0.0762}, {0.0690, 0.1000, 0.0751}, {0.0784, 1.1200, 0.0837}, {0.0820, 0.1000, 0.0797},
        {0.0840, 1.2000, 0.0866}, {0.0940, 0.1000, 0.0830}, {0.1000, 0.1000, 0.0844}, {0.1364, 0.3100, 0.1094},
        {0.1400, 2.0000, 0.1118}, {0.1467, 0.3333, 0.1134}, {0.1936, 0.4400, 0.1303}, {0.2000, 0.3333, 0.1299},
        {0.2139, 0.3100, 0.1323}, {0.2300, 0.3333, 0.1372}, {0.2640, 0.4400, 0.1493}, {0.2733, 0.3333, 0.1456},
        {0.2914, 0.3100, 0.1462}, {0.2992, 0.6800, 0.1616}, {0.3036, 0.4400, 0.1576}, {0.3100, 0.3100, 0.1486},
        {0.3133, 0.3333, 0.1516}, {0.3333, 0.3333, 0.1540}, {0.3608, 0.4400, 0.1672}, {0.3828, 0.8700, 0.1804},
        {0.4080, 0.6800, 0.1833}, {0.4092, 0.9300, 0.1851}, {0.4136, 0.4400, 0.1738}, {0.4400, 0.4400, 0.1765},
        {0.4692, 0.6800, 0.1916}, {0.4928, 1.1200, 0.1964}, {0.5280, 1.2000, 0.1997}, {0.5576, 0.6800, 0.1995},
        {0.5580, 0.9300, 0.2018}, {0.6003, 0.8700, 0.2042}, {0.6392, 0.6800, 0.2036}, {0.6720, 1.1200, 0.2074},
        {0.6800, 0.6800, 0.2048}, {0.7626, 0.9300, 0.2091}, {0.8178, 0.8700, 0.2094}, {0.8280, 1.2000, 0.2099},
        {0.8700, 0.8700, 0.2097}, {0.8800, 2.0000, 0.2101}, {0.9184, 1.1200, 0.2103}, {0.9300, 0.9300, 0.2102},
        {1.1200, 1.1200, 0.2105}, {1.1280, 1.2000, 0.2105}, {1.2000, 1.2000, 0.2105}, {1.2000, 2.0000, 0.2105},
        {1.3800, 2.0000, 0.2105}, {1.6400, 2.0000, 0.2105}, {1.8800, 2.0000, 0.2105}, {2.0000, 2.0000, 0.2104}};
    for (size_t i = 0; i < sizeof ELEMENTS / sizeof *ELEMENTS; i++) {
        assert_relative(fracture_splitting_factor(1, ELEMENTS[i][0], ELEMENTS[i][1]), ELEMENTS[i][2], 6e-3);
        assert_bits(fracture_splitting_factor(1, ELEMENTS[i][0], ELEMENTS[i][1]),
                    fracture_splitting_factor(1, ELEMENTS[i][1], ELEMENTS[i][0]));
    }
    /* A strip's load goes with the square root of its width, however long it is; a floe's width has an end. */
    assert_relative(fracture_splitting_factor(16, 0.5, 0.5), fracture_splitting_factor(4, 0.5, 0.5) / 2, 1e-12);
    assert_bits(fracture_splitting_factor(1, 5, 5), fracture_splitting_factor(1, 90, 7));
    ck_assert(fracture_splitting_factor(1, 0, 1) == 0);
}
END_TEST

/* ---- thresholds ---- */

START_TEST(strong_enough)
{
    fracture_rig r;
    fracture_rig_make(&r);
    int32_t row = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC);
    edge_stress e = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, 0.5, EDGE_STRAIGHT);
    ck_assert(fracture_rig_load(&r, row, (vec2){49.9, 0}, 0.9999 * e.wedge_capacity, 0.5));
    ck_assert_int_eq(fracture_rig_break(&r), 0);
    ck_assert_int_eq(fracture_rig_count(&r), 1);
    ck_assert(fracture_rig_load(&r, row, (vec2){49.9, 0}, 1.0001 * e.wedge_capacity, 0.5));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    ck_assert_int_eq(r.events.data[0].kind, FRACTURE_BENDING);
    assert_relative(r.events.data[0].stress_ratio, 1.0001, 1e-12);
    assert_relative(r.events.data[0].crack_length, e.breaking_radius, 1e-12);
    fracture_rig_free(&r);
}
END_TEST

START_TEST(unbreakable)
{
    fracture_rig r;
    fracture_rig_make(&r);
    int32_t row = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC);
    r.floes.breakable[row] = 0;
    ck_assert(fracture_rig_load(&r, row, (vec2){49.9, 0}, 1e8, 0.5));
    ck_assert_int_eq(fracture_rig_break(&r), 0);
    fracture_rig_free(&r);
}
END_TEST

/* ---- splitting ---- */

/* R_bending is about 5 m on this area: a crack of 10 m runs through, one of 4 m or 20 m does not. */
static const double AREA = 0.5;

START_TEST(split_in_two)
{
    fracture_rig r;
    fracture_rig_make(&r);
    int32_t row = fracture_rig_plate(&r, 20, 10, MOTION_DYNAMIC);
    double radius = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, AREA, EDGE_STRAIGHT).breaking_radius;
    ck_assert(radius > 10 / 3.0 && radius < 10);
    ck_assert(fracture_rig_load(&r, row, (vec2){2, -4.9}, 1e7, AREA));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    const fracture_event *e = &r.events.data[0];
    ck_assert_int_eq(e->kind, FRACTURE_SPLIT);
    ck_assert_int_eq(e->pieces, 2);
    ck_assert_int_eq(e->first_piece, 1);
    ck_assert_int_eq(e->floe, 0);
    assert_relative(e->crack_length, 10, 1e-14);
    assert_relative(e->load, 1e7, 1e-12);
    assert_vec3_close(e->place, ((vec3){2, -5, 0}), 1e-12);
    ck_assert_int_eq(fracture_rig_count(&r), 2);
    double areas[2] = {0};
    int n = 0;
    for (int32_t i = 0; i < r.floes.count; i++)
        if (r.floes.body[i] >= 0)
            areas[n++] = r.floes.area[i];
    assert_relative(fmin(areas[0], areas[1]), 80, 1e-13);
    assert_relative(fmax(areas[0], areas[1]), 120, 1e-13);
    fracture_rig_free(&r);
}
END_TEST

START_TEST(no_split)
{
    fracture_rig r;
    fracture_rig_make(&r);
    double radius = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, AREA, EDGE_STRAIGHT).breaking_radius;
    /* Too long, too short, S_k = 1, switched off. */
    const double width[4] = {3.01 * radius, 0.99 * radius, 2 * radius, 2 * radius};
    for (int i = 0; i < 4; i++) {
        r.settings.splitting_factor = i == 2 ? 1 : 3;
        r.settings.splitting = i == 3 ? SPLITTING_NONE : SPLITTING_LENGTH;
        int32_t row = fracture_rig_plate(&r, 2 * width[i], width[i], MOTION_DYNAMIC);
        ck_assert(fracture_rig_load(&r, row, (vec2){0.5, -width[i] / 2}, 1e7, AREA));
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        ck_assert_int_eq(r.events.data[0].kind, FRACTURE_BENDING);
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* A child of 2 x 10 m is narrower than R_size = 4; the floe bends instead.  With R_size = 5.1 it splits. */
START_TEST(narrow_child)
{
    fracture_rig r;
    fracture_rig_make(&r);
    for (int turn = 0; turn < 2; turn++) {
        r.settings.narrowness = turn ? 5.1 : 4;
        int32_t row = fracture_rig_plate(&r, 30, 10, MOTION_DYNAMIC);
        ck_assert(fracture_rig_load(&r, row, (vec2){13, -5}, 1e7, AREA));
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        ck_assert_int_eq(r.events.data[0].kind, turn ? FRACTURE_SPLIT : FRACTURE_BENDING);
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* Two arms beyond a slot: the crack ends at the slot, the first boundary that it meets. */
START_TEST(concave_shortest_crack)
{
    fracture_rig r;
    fracture_rig_make(&r);
    const vec2 slotted[8] = {{-15, -10}, {15, -10}, {15, 20}, {12, 20}, {12, 0}, {-12, 0}, {-12, 20}, {-15, 20}};
    int32_t row = fracture_rig_floe(&r, (polygon){slotted, 8}, 1, MOTION_DYNAMIC);
    vec3 centre = r.bodies.position[r.floes.body[row]];
    ck_assert(fracture_rig_load(&r, row, (vec2){1 - centre.x, -10 - centre.y}, 1e7, AREA));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    ck_assert_int_eq(r.events.data[0].kind, FRACTURE_SPLIT);
    assert_relative(r.events.data[0].crack_length, 10, 1e-12);
    assert_absolute(fracture_rig_area(&r), 900 - 24 * 20, 1e-9);
    fracture_rig_free(&r);
}
END_TEST

/* At a corner the crack runs along the mean of the normals: the diagonal of a square, whose halves are triangles. */
START_TEST(crack_from_a_corner)
{
    fracture_rig r;
    fracture_rig_make(&r);
    int32_t row = fracture_rig_plate(&r, 8, 8, MOTION_DYNAMIC);
    ck_assert(fracture_rig_load(&r, row, (vec2){-4.1, -4.2}, 1e7, AREA));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    ck_assert_int_eq(r.events.data[0].kind, FRACTURE_SPLIT);
    assert_relative(r.events.data[0].crack_length, 8 * sqrt(2), 1e-13);
    for (int32_t i = 0; i < r.floes.count; i++) {
        if (r.floes.body[i] < 0)
            continue;
        ck_assert_int_eq(fracture_rig_outline(&r, i).count, 3);
        assert_relative(r.floes.area[i], 32, 1e-13);
    }
    fracture_rig_free(&r);
}
END_TEST

/* The option: the crack runs when the load in the plane is what fracture mechanics asks for, whatever the load across
   it: none, too little for a radial crack, or more (docs/oracles.md, section 3: 0.627 MN for a floe of 500 m). */
START_TEST(split_by_toughness)
{
    static const double SIDES[] = {50, 500}, ACROSS[] = {0, 1e3, 1e6};
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.splitting = SPLITTING_TOUGHNESS;
    for (int i = 0; i < 12; i++) {
        double side = SIDES[i % 2], across = ACROSS[i / 2 % 3], over = i < 6 ? 1.001 : 0.999;
        double needed = fracture_splitting_force(1, 150e3, side, side / 2, side / 2);
        if (side > 100)
            assert_relative(needed, 0.1869 * 150e3 * sqrt(500.0), 2e-3);
        int32_t row = fracture_rig_plate(&r, side, side, MOTION_DYNAMIC);
        ck_assert(fracture_rig_load(&r, row, (vec2){0, -side / 2}, across, AREA));
        /* Friction brings the load in the plane. */
        r.contacts.data[0].impulse[1] = over * needed * r.settings.time_step;
        ck_assert_int_eq(fracture_rig_break(&r), over > 1 || across > 1e5);
        if (over > 1) {
            ck_assert_int_eq(r.events.data[0].kind, FRACTURE_SPLIT);
            ck_assert_int_eq(fracture_rig_count(&r), 2);
            assert_relative(r.events.data[0].load, over * needed, 1e-9);
            assert_relative(r.events.data[0].stress_ratio, over, 1e-9);
            assert_relative(r.events.data[0].crack_length, side, 1e-12);
        } else if (across > 1e5) {
            ck_assert_int_eq(r.events.data[0].kind, FRACTURE_BENDING);
        }
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* A wedge of half angle b whose sides press frictionless parts the ice by F/(2 tan b): at 15 and 25 degrees it splits
   at 0.536 and 0.933 of the mouth load, at 35 at no more than that load itself; tilted, too. */
START_TEST(split_by_a_wedge)
{
    static const double HALF_ANGLE[] = {15, 25, 35}, PART[] = {0.535898, 0.932615, 1};
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.splitting = SPLITTING_TOUGHNESS;
    for (int i = 0; i < 12; i++) {
        double over = i < 6 ? 1.001 : 0.999, tilt = i / 3 % 2 ? radians(20) : 0;
        double needed = PART[i % 3] * fracture_splitting_force(1, 150e3, 50, 25, 25);
        int32_t row = fracture_rig_plate(&r, 50, 50, MOTION_DYNAMIC), body = r.floes.body[row];
        r.bodies.orientation[body] = quat_from_roll_pitch_yaw(tilt, tilt, 0.5);
        ck_assert(fracture_rig_load(&r, row, (vec2){0, -25}, over * needed, AREA));
        vec3 into = mat3_mul_vec(quat_matrix(r.bodies.orientation[body]), (vec3){0, 1, 0});
        r.contacts.data[0].normal = r.patches.data[0].normal = into;
        r.patches.data[0].horizontal_area = 0;
        r.patches.data[0].surface_area = AREA / sin(radians(HALF_ANGLE[i % 3]));
        ck_assert_int_eq(fracture_rig_break(&r), over > 1);
        if (over > 1) {
            assert_relative(r.events.data[0].load, over * needed, 1e-9);
            assert_relative(r.events.data[0].stress_ratio, over, 1e-5);
        }
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* A floe at 20 deg tilt, spinning, split in two: corners, momenta and energy stay. */
START_TEST(split_while_spinning)
{
    fracture_rig r;
    fracture_rig_make(&r);
    int32_t row = fracture_rig_plate(&r, 20, 10, MOTION_DYNAMIC), body = r.floes.body[row];
    r.bodies.position[body] = (vec3){100, -50, 0.3};
    r.bodies.orientation[body] = quat_from_roll_pitch_yaw(radians(20), 0, 0.5);
    r.bodies.velocity[body] = (vec3){1, -2, 0.3};
    r.bodies.angular_velocity[body] = (vec3){0.2, -0.1, 0.7};
    vec3 corner[4];
    for (int i = 0; i < 4; i++)
        corner[i] = body_to_global(&r.bodies, body, (vec3){i & 1 ? 10 : -10, i & 2 ? 5 : -5, 0.5});
    body_books before = body_books_of(&r.bodies);
    ck_assert(fracture_rig_load(&r, row, (vec2){0, -5}, 1e7, AREA));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    ck_assert_int_eq(fracture_rig_count(&r), 2);
    body_books after = body_books_of(&r.bodies);
    assert_relative(after.mass, before.mass, 1e-13);
    assert_relative(after.kinetic_energy, before.kinetic_energy, 1e-12);
    assert_vec3_close(after.momentum, before.momentum, 1e-12 * vec3_length(before.momentum));
    assert_vec3_close(after.angular_momentum, before.angular_momentum, 1e-12 * vec3_length(before.angular_momentum));
    for (int i = 0; i < 4; i++) {
        double nearest = HUGE_VAL;
        for (int32_t f = 0; f < r.floes.count; f++) {
            polygon p = fracture_rig_outline(&r, f);
            for (int32_t k = 0; k < p.count; k++) {
                vec3 v = body_to_global(&r.bodies, r.floes.body[f], (vec3){p.vertex[k].x, p.vertex[k].y, 0.5});
                nearest = fmin(nearest, vec3_length(vec3_sub(v, corner[i])));
            }
        }
        assert_absolute(nearest, 0, 1e-12);
    }
    fracture_rig_free(&r);
}
END_TEST

/* ---- bending ---- */

/* A straight edge and N = 3: wedges of 30, 60, 60 and 30 degrees, and one remnant (docs/theory.md); for other N
   the angles there too.  Nevel's beams are b0 R wide where they break, R from the load: N b0 R^2/2 of ice. */
START_TEST(wedge_angles)
{
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.edge_threshold = 0;
    static const int pieces[] = {2, 4, 4, 6};
    for (int i = 0; i < 8; i++) {
        int32_t n = r.settings.wedges = 2 + i / 2;
        r.settings.radius_along = i % 2 ? RADIUS_ALONG_CRACKS : RADIUS_ALONG_AXES;
        int32_t row = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC);
        ck_assert(fracture_rig_load(&r, row, (vec2){0, -50}, 1e7, AREA));
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        const fracture_event *e = &r.events.data[0];
        ck_assert_int_eq(e->pieces, pieces[n - 2] + 1);
        double axis = e->crack_length * (i % 2 ? real_cos(PI / (2 * n)) : 1), cut = 0;
        for (int32_t f = 0; f < r.floes.count; f++)
            if (r.floes.body[f] >= 0 && r.floes.area[f] < 5000)
                cut += r.floes.area[f];
        assert_relative(cut, n * fracture_wedge_width(n) * axis * axis / 2, 1e-9);
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* Smaller than R_bending: no remnant is left, only sectors. */
START_TEST(floe_smaller_than_the_stencil)
{
    fracture_rig r;
    fracture_rig_make(&r);
    for (int room = 0; room < 2; room++) {
        r.settings.wedge_room = room;
        int32_t row = fracture_rig_plate(&r, 4, 3, MOTION_DYNAMIC);
        ck_assert(fracture_rig_load(&r, row, (vec2){0, -1.5}, 1e7, AREA));
        ck_assert_int_eq(fracture_rig_break(&r), room ? 0 : 1);
        if (!room) {
            ck_assert_int_eq(r.events.data[0].pieces, 4);
            assert_absolute(fracture_rig_area(&r), 12, 12e-3);
        }
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* A floe of 10 km breaks as one of 100 m does at the same edge. */
START_TEST(huge_floe)
{
    enum { MOST = 16 };
    const double sizes[] = {100, 10000};
    double area[2][MOST] = {{0}};
    int count[2] = {0};
    for (int i = 0; i < 2; i++) {
        fracture_rig r;
        fracture_rig_make(&r);
        double size = sizes[i];
        int32_t row = fracture_rig_plate(&r, size, size, MOTION_DYNAMIC);
        ck_assert(fracture_rig_load(&r, row, (vec2){3, 0.1 - size / 2}, 1e7, AREA));
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        const fracture_event *e = &r.events.data[0];
        ck_assert_int_eq(e->kind, FRACTURE_BENDING);
        assert_absolute(e->parent_area, e->piece_area + e->area_lost - e->area_gained, 1e-9 * e->parent_area);
        ck_assert(e->area_lost + e->area_gained <= 1e-3 * e->parent_area);
        for (int32_t k = 0; k < r.floes.count && count[i] < MOST; k++)
            if (r.floes.body[k] >= 0 && r.floes.area[k] < 1000)
                area[i][count[i]++] = r.floes.area[k];
        fracture_rig_free(&r);
    }
    ck_assert_int_eq(count[0], count[1]);
    ck_assert_int_gt(count[0], 2);
    for (int k = 0; k < count[0]; k++)
        assert_relative(area[1][k], area[0][k], 1e-7);
}
END_TEST

START_TEST(level_ice_stays)
{
    fracture_rig r;
    fracture_rig_make(&r);
    int32_t row = fracture_rig_plate(&r, 100, 100, MOTION_STATIC);
    ck_assert(fracture_rig_load(&r, row, (vec2){0, -50}, 1e7, AREA));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    for (int32_t i = 0; i < r.floes.count; i++) {
        int32_t body = r.floes.body[i];
        ck_assert_int_eq(r.bodies.motion[body], r.floes.area[i] > 5000 ? MOTION_STATIC : MOTION_DYNAMIC);
        assert_vec3_close(r.bodies.velocity[body], ((vec3){0, 0, 0}), 0);
        ck_assert_int_eq(r.floes.breakable[i], 1);
        assert_bits(r.floes.thickness[i], 1);
    }
    fracture_rig_free(&r);
}
END_TEST

/* ---- several patches ---- */

/* Far apart: both cut in the same event.  At the same place: the second start is gone. */
START_TEST(several_patches)
{
    fracture_rig r;
    fracture_rig_make(&r);
    for (int turn = 0; turn < 2; turn++) {
        int32_t row = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC);
        ck_assert(fracture_rig_load(&r, row, (vec2){-20, -50}, 1e7, AREA));
        ck_assert(fracture_rig_load(&r, row, (vec2){turn ? -19 : 20, -50}, 0.9e7, AREA));
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        ck_assert_int_eq(r.events.data[0].pieces, turn ? 5 : 9);
        assert_vec3_close(r.events.data[0].place, ((vec3){-20, -50, 0}), 1e-12);
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* Overlapping stencils: wedges of the second are cut from what the first left. */
START_TEST(overlapping_patches)
{
    fracture_rig r;
    fracture_rig_make(&r);
    int32_t row = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC);
    ck_assert(fracture_rig_load(&r, row, (vec2){-3, -50}, 1e7, AREA));
    ck_assert(fracture_rig_load(&r, row, (vec2){3, -50}, 1e7, AREA));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    const fracture_event *e = &r.events.data[0];
    assert_vec3_close(e->place, ((vec3){-3, -50, 0}), 1e-12); /* a tie: the lower patch */
    ck_assert_int_gt(e->pieces, 5);
    assert_absolute(fracture_rig_area(&r), 1e4, 10);
    assert_absolute(e->piece_area + e->area_lost - e->area_gained, 1e4, 1e-8);
    fracture_rig_free(&r);
}
END_TEST

/* The order of patches in the list does not matter where their stresses differ. */
START_TEST(order_of_patches)
{
    double area[2][64];
    int count[2];
    for (int turn = 0; turn < 2; turn++) {
        fracture_rig r;
        fracture_rig_make(&r);
        int32_t row = fracture_rig_plate(&r, 100, 100, MOTION_DYNAMIC);
        for (int k = 0; k < 3; k++) {
            int i = turn ? 2 - k : k;
            ck_assert(fracture_rig_load(&r, row, (vec2){5.0 * i - 5, -50}, 1e7 + 1e6 * i, AREA));
        }
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        count[turn] = 0;
        for (int32_t i = 0; i < r.floes.count && count[turn] < 64; i++)
            if (r.floes.body[i] >= 0)
                area[turn][count[turn]++] = r.floes.area[i];
        fracture_rig_free(&r);
    }
    ck_assert_int_eq(count[0], count[1]);
    assert_array_bits(area[1], area[0], count[0]);
}
END_TEST

/* Floes break in the order of their slots; the pieces take the lowest free ones. */
START_TEST(several_floes)
{
    fracture_rig r;
    fracture_rig_make(&r);
    int32_t a = fracture_rig_plate(&r, 20, 10, MOTION_DYNAMIC), b = fracture_rig_plate(&r, 20, 10, MOTION_DYNAMIC);
    int32_t slot = r.floes.body[a];
    ck_assert(fracture_rig_load(&r, b, (vec2){0, -5}, 2e7, AREA));
    ck_assert(fracture_rig_load(&r, a, (vec2){0, -5}, 1e7, AREA));
    ck_assert_int_eq(fracture_rig_break(&r), 2);
    ck_assert_int_eq(r.events.data[0].floe, 0);
    ck_assert_int_eq(r.events.data[1].floe, 1);
    ck_assert_int_eq(r.events.data[0].first_piece, 2);
    ck_assert_int_eq(r.events.data[1].first_piece, 4);
    ck_assert_int_eq(r.floes.number[r.bodies.owner[slot]], 2);
    ck_assert_int_eq(r.bodies.generation[slot], 2);
    fracture_rig_free(&r);
}
END_TEST

/* ---- contacts ---- */

START_TEST(void_contacts)
{
    fracture_rig r;
    fracture_rig_make(&r);
    int32_t a = fracture_rig_plate(&r, 20, 10, MOTION_DYNAMIC), b = fracture_rig_plate(&r, 20, 10, MOTION_DYNAMIC);
    ck_assert(fracture_rig_load(&r, a, (vec2){0, -5}, 1e7, AREA));
    ck_assert(fracture_rig_load(&r, b, (vec2){0, -5}, 1, AREA));
    contact between = {.a = r.floes.body[b], .b = r.floes.body[a], .correct = true, .patch = -1, .key = 102};
    ck_assert(array_push(&r.ctx, &r.contacts, between));
    ck_assert(table_resize(&r.ctx, &r.memory, &contact_memory_table_info, 4));
    for (int i = 0; i < 4; i++) {
        r.memory.key[i] = 100 + (uint64_t)i;
        r.memory.on_lower[i] = (vec3){i, 0, 0};
    }
    fram_error e = {0};
    assert_ok(fracture_rig_try(&r, &e), e);
    ck_assert_int_eq(r.events.count, 1);
    ck_assert(!r.contacts.data[0].correct);
    ck_assert(r.contacts.data[1].correct);
    ck_assert(!r.contacts.data[2].correct);
    ck_assert_int_eq(r.memory.count, 2);
    ck_assert_uint_eq(r.memory.key[0], 101);
    ck_assert_uint_eq(r.memory.key[1], 103);
    assert_bits(r.memory.on_lower[1].x, 3);
    fracture_rig_free(&r);
}
END_TEST

/* Between floes only with the option, and then both may break. */
START_TEST(under_ice_contacts)
{
    fracture_rig r;
    fracture_rig_make(&r);
    for (int option = 0; option < 2; option++) {
        r.settings.under_ice_contacts = option;
        int32_t a = fracture_rig_plate(&r, 20, 10, MOTION_DYNAMIC), b = fracture_rig_plate(&r, 20, 10, MOTION_DYNAMIC);
        ck_assert(fracture_rig_load(&r, a, (vec2){0, -5}, 1e7, AREA));
        r.contacts.data[0].b = r.patches.data[0].surface_body = r.floes.body[b];
        ck_assert_int_eq(fracture_rig_break(&r), option ? 2 : 0);
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* Held ice breaks under pieces where it is asked to, at the load of a hull. */
START_TEST(under_pieces)
{
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.splitting = SPLITTING_NONE;
    double bears = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, AREA, EDGE_STRAIGHT).wedge_capacity;
    for (int i = 0; i < 4; i++) {
        r.settings.under_pieces = i > 0;
        int32_t held = fracture_rig_plate(&r, 80, 80, MOTION_STATIC),
                piece = fracture_rig_plate(&r, 20, 10, MOTION_DYNAMIC);
        ck_assert(fracture_rig_load(&r, held, (vec2){0, -40}, (i == 1 ? 0.99 : 1.01) * bears, AREA));
        if (i < 3)
            r.contacts.data[0].b = r.patches.data[0].surface_body = r.floes.body[piece];
        ck_assert_int_eq(fracture_rig_break(&r), i >= 2);
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* A floe that sleeps floats as one that is awake: it does not break under pieces, and breaks under hulls. */
START_TEST(asleep_is_not_held)
{
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.splitting = SPLITTING_NONE;
    r.settings.under_pieces = true;
    double bears = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, AREA, EDGE_STRAIGHT).wedge_capacity;
    for (int hull = 0; hull < 2; hull++) {
        int32_t floe = fracture_rig_plate(&r, 80, 80, MOTION_DYNAMIC),
                piece = fracture_rig_plate(&r, 20, 10, MOTION_DYNAMIC);
        r.bodies.motion[r.floes.body[floe]] = MOTION_ASLEEP;
        ck_assert(fracture_rig_load(&r, floe, (vec2){0, -40}, 1.5 * bears, AREA));
        if (!hull)
            fracture_rig_push_by(&r, r.floes.body[piece], false);
        ck_assert_int_eq(fracture_rig_break(&r), hull);
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* ---- dust ---- */

/* Least angle between two edges of an outline, inside or outside the ice [rad]: what a cleaned one keeps (Algorithm 10:
   the cosine of the turn is at least -0.99). */
static double least_angle(polygon p)
{
    double least = PI;
    for (int32_t i = 0; i < p.count; i++) {
        vec2 to_next = vec2_sub(p.vertex[(i + 1) % p.count], p.vertex[i]);
        vec2 to_last = vec2_sub(p.vertex[(i + p.count - 1) % p.count], p.vertex[i]);
        double angle = fabs(real_atan2(vec2_cross(to_next, to_last), vec2_dot(to_next, to_last)));
        least = testing_smaller(least, angle);
    }
    return least;
}

/* What is guaranteed of every piece: no floe under the least area, no edge under the threshold, no corner sharper than
   a cosine of 0.99. Returns the sharpest corner [rad]. */
static double check_pieces(const fracture_rig *r)
{
    double smallest = PI;
    for (int32_t i = 0; i < r->floes.count; i++) {
        if (r->floes.body[i] < 0)
            continue;
        polygon p = fracture_rig_outline(r, i);
        ck_assert(r->floes.area[i] >= r->settings.smallest_floe_area * (1 - 1e-12));
        for (int32_t k = 0; k < p.count; k++) {
            vec2 e = vec2_sub(p.vertex[(k + 1) % p.count], p.vertex[k]);
            ck_assert(vec2_length(e) >= r->settings.edge_threshold * (1 - 1e-9));
        }
        smallest = testing_smaller(smallest, least_angle(p));
    }
    ck_assert_msg(smallest >= real_acos(0.99) * (1 - 1e-9), "a corner of %g degrees", smallest * 180 / PI);
    return smallest;
}

/* All floes but the largest go; its row. */
static int32_t keep_largest(fracture_rig *r)
{
    int32_t largest = -1;
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0 && (largest < 0 || r->floes.area[i] > r->floes.area[largest]))
            largest = i;
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0 && i != largest)
            floe_remove(&r->bodies, &r->shapes, &r->floes, i);
    ck_assert_int_eq(shape_compact(&r->ctx, &r->shapes), FRAM_OK);
    return largest;
}

/* 600 bites along one side of one floe, of each number of wedges: edges, corners, areas and vertex counts stay
   bounded. */
START_TEST(six_hundred_bites)
{
    double smallest = PI;
    for (int wedges = 2; wedges <= 5; wedges++) {
        fracture_rig r;
        fracture_rig_make(&r);
        r.settings.splitting = SPLITTING_NONE;
        r.settings.wedges = wedges;
        int32_t row = fracture_rig_plate(&r, 400, 300, MOTION_STATIC);
        double lost = 0;
        random_stream s = random_begin(5, 1, (uint32_t)wedges);
        for (int bite = 0; bite < 600; bite++) {
            /* Always at the same part of the boundary, the way a ship comes back. */
            vec2 place = {random_uniform(&s, -150, 150), -200};
            ck_assert(fracture_rig_load(&r, row, place, 1e7, random_uniform(&s, 0.05, 2)));
            ck_assert_int_eq(fracture_rig_break(&r), 1);
            lost += r.events.data[0].area_lost + r.events.data[0].area_gained;
            smallest = fmin(smallest, check_pieces(&r));
            row = keep_largest(&r);
            ck_assert_int_lt(fracture_rig_outline(&r, row).count, 240);
        }
        ck_assert(lost < 0.005 * 400 * 300);
        fracture_rig_free(&r);
    }
    printf("sharpest corner of the pieces: %.1f degrees\n", smallest * 180 / PI);
}
END_TEST

/* ---- memory ---- */

/* Of a floe of 40 by 20 m that bends, or of 20 by 10 m that splits. */
static void break_without_memory(double half, int32_t kind)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        fracture_rig r;
        turn.status = FRAM_ERROR_MEMORY;
        bool good = fracture_rig_start(&r, turn.ctx);
        const vec2 corner[4] = {{-2 * half, -half}, {2 * half, -half}, {2 * half, half}, {-2 * half, half}};
        int32_t row = good ? fracture_rig_floe(&r, (polygon){corner, 4}, 1, MOTION_DYNAMIC) : -1;
        if (row >= 0 && fracture_rig_load(&r, row, (vec2){0, -half}, 1e7, AREA))
            turn.status = fracture_rig_try(&r, &turn.error);
        bool broke = r.events.count == 1 && r.events.data[0].kind == kind;
        fracture_rig_free(&r);
        if (!turn.memory.failed)
            ck_assert(broke);
    }
}

START_TEST(memory_runs_out)
{
    break_without_memory(10, FRACTURE_BENDING);
    break_without_memory(5, FRACTURE_SPLIT);
}
END_TEST

START_TEST(nothing_to_do)
{
    fracture_rig r;
    fracture_rig_make(&r);
    ck_assert_int_eq(fracture_rig_break(&r), 0);
    ck_assert_int_eq(first_floe(&r), -1);
    fracture_rig_free(&r);
}
END_TEST

TEST_MAIN("fracture", loaded_radius, wedge_capacity, splitting_force, splitting_beside_the_middle, strong_enough,
          unbreakable, split_in_two, no_split, narrow_child, concave_shortest_crack, crack_from_a_corner,
          split_by_toughness, split_by_a_wedge, split_while_spinning, wedge_angles, floe_smaller_than_the_stencil,
          huge_floe, level_ice_stays, several_patches, overlapping_patches, order_of_patches, several_floes,
          void_contacts, under_ice_contacts, under_pieces, asleep_is_not_held, six_hundred_bites, memory_runs_out,
          nothing_to_do)
