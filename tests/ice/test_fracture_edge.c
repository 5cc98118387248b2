/* The ice that a load stands on: corners, edges and what neighbours left, against the angles of the wedges
   (docs/decisions/0044). */
#include "sheet_rig.h"

#include "ice/fracture_parts.h"

/* Ice under a load at a place of a floe's frame, or of the global plan on a sheet. */
static edge_ice ice_under(fracture_rig *r, int32_t row, vec2 place, double area)
{
    fracture_state state = fracture_rig_state(r);
    fram_error error = {0};
    fracture_job j = {&r->ctx, r->scratch, &r->settings, r->plane, &state, &r->events, &error};
    fracture_load l = {.body = r->floes.body[row],
                       .floe = row,
                       .tile = r->floes.tile[row],
                       .force = 1e5,
                       .place = place,
                       .horizontal_area = area,
                       .thickness = 1,
                       .ice = FRACTURE_RIG_ICE};
    if (!l.tile)
        return fracture_floe_ice(&j, &l);
    edge_ice edge;
    r->scratch->sheet.index_is_made = false;
    assert_ok(fracture_sheet_ice(&j, &l, &edge), error);
    return edge;
}

/* At least, of a floe of its own. */
static double least_under(fracture_rig *r, int32_t row, vec2 place, double area)
{
    fracture_state state = fracture_rig_state(r);
    fram_error error = {0};
    fracture_job j = {&r->ctx, r->scratch, &r->settings, r->plane, &state, &r->events, &error};
    fracture_load l = {.body = r->floes.body[row],
                       .floe = row,
                       .force = 1e5,
                       .place = place,
                       .horizontal_area = area,
                       .thickness = 1,
                       .ice = FRACTURE_RIG_ICE};
    return fracture_least_ice(&j, &l);
}

/* A large floe whose corner at the origin has this included angle, its bisector along +x; the frame is the floe's. */
static int32_t corner_floe(fracture_rig *r, double angle, vec2 *corner)
{
    double x = 200 * real_cos(angle / 2), y = 200 * real_sin(angle / 2);
    const vec2 ring[3] = {{0, 0}, {x, -y}, {x, y}};
    int32_t row = fracture_rig_floe(r, (polygon){ring, 3}, 1, MOTION_DYNAMIC);
    ck_assert_int_ge(row, 0);
    vec3 at = r->bodies.position[r->floes.body[row]];
    *corner = (vec2){-at.x, -at.y};
    return row;
}

/* A corner has its angle's part of an edge: exactly where its sides lie on sectors' sides, and as N grows. */
START_TEST(corners)
{
    static const double DEGREES[3] = {60, 90, 120}, PART[3] = {1.0 / 3, 1.0 / 2, 2.0 / 3};
    fracture_rig r;
    fracture_rig_make(&r);
    for (int i = 0; i < 3; i++) {
        vec2 corner;
        int32_t row = corner_floe(&r, radians(DEGREES[i]), &corner);
        double last = 1;
        for (int32_t n = 2; n <= 32; n *= 2) {
            r.settings.wedges = n;
            double off = fabs(ice_under(&r, row, corner, 0.1).wedges / PART[i] - 1);
            ck_assert_double_lt(off, fmax(last, 1e-12));
            last = fmax(off, 1e-12);
        }
        ck_assert_double_lt(last, 1e-3);
        r.settings.wedges = 6; /* sectors of 30 degrees: no side inside one */
        assert_relative(ice_under(&r, row, corner, 0.1).wedges, PART[i], i == 1 ? 0.02 : 1e-9);
        r.settings.sharing = SHARING_EQUAL;
        ck_assert(ice_under(&r, row, corner, 0.1).wedges == 1);
        r.settings.sharing = SHARING_WIDTH;
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* The load that breaks a corner of 90 degrees: half of an edge's, and more by the larger tip that it stands on. */
START_TEST(corner_capacity)
{
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.splitting = SPLITTING_NONE;
    r.settings.wedges = 4;
    r.settings.thick_plate_radius = false;
    vec2 corner;
    int32_t row = corner_floe(&r, radians(90), &corner);
    double width = 4 * fracture_wedge_width(4) / 2, l = ice_characteristic_length(&FRACTURE_RIG_ICE, 1, 1025, 9.81);
    double area = 0.01 * l * l * width / 2; /* a/l = 0.1, of which Nevel's C is 1.255469567682 */
    double capacity = 0.5e6 * width / 6 * 1.255469567682;
    ck_assert(fracture_rig_load(&r, row, corner, 0.999 * capacity, area));
    ck_assert_int_eq(fracture_rig_break(&r), 0);
    ck_assert(fracture_rig_load(&r, row, corner, 1.001 * capacity, area));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    assert_relative(r.events.data[0].loaded_radius, 0.1 * l, 1e-9);
    assert_relative(r.events.data[0].crack_length, 0.5114858883249 * l, 1e-9);
    assert_relative(r.events.data[0].stress_ratio, 1.001, 1e-9);
    fracture_rig_free(&r);
}
END_TEST

/* An edge is Nevel's N wedges, whatever N, on floes and on sheets of any tiles. */
START_TEST(edges)
{
    static const double SIZES[4] = {200, 45, 17, 9};
    for (int i = 0; i < 4; i++) {
        fracture_rig r;
        fracture_rig_make(&r);
        sheet_make(&r, (box2){{-60, 0}, {60, 90}}, SIZES[i], NULL);
        int32_t row = sheet_tile_at(&r, (vec2){3.3, 0});
        for (int32_t n = 2; n < 10; n++) {
            r.settings.wedges = n;
            assert_relative(ice_under(&r, row, (vec2){3.3, 0.2}, 0.3).wedges, 1, 1e-9);
        }
        fracture_rig_free(&r);
    }
}
END_TEST

/* Beside a bite, the wedge that reaches into it carries what is left of it. */
START_TEST(beside_a_bite)
{
    fracture_rig r;
    fracture_rig_make(&r);
    polygon_list openings = {0};
    const vec2 bite[4] = {{1, -1}, {30, -1}, {30, 40}, {1, 40}};
    ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){bite, 4}));
    sheet_make(&r, (box2){{-60, 0}, {60, 90}}, 25, &openings);
    r.settings.wedges = 3;
    double radius = fracture_edge_reach(&r.settings, &FRACTURE_RIG_ICE, 1, 0.3);
    double exact = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, 0.3, EDGE_STRAIGHT).breaking_radius;
    assert_relative(radius, exact, 0.05);
    double part = ice_under(&r, sheet_tile_at(&r, (vec2){0, 0}), (vec2){0, 0.1}, 0.3).wedges;
    const vec2 left[4] = {{-50, 0}, {1, 0}, {1, 50}, {-50, 50}};
    /* Sectors of 60 degrees begin at the first crack, along +y, and end at x = R: the lower ones lie half outside. */
    double side = radius / real_cos(PI / 6);
    const vec2 stencil[6] = {{0, side},  {-radius, side / 2}, {-radius, -side / 2},
                             {0, -side}, {radius, -side / 2}, {radius, side / 2}};
    double there = polygon_overlap_area((polygon){stencil, 6}, (polygon){left, 4});
    ck_assert_double_lt(part, 0.8);
    assert_relative(part, 2 * there / polygon_area((polygon){stencil, 6}), 1e-9);
    polygon_list_free(&r.ctx, &openings);
    fracture_rig_free(&r);
}
END_TEST

/* A hull's contact lies beside the tip: there too a corner has its angle's part of an edge, where the first crack ends
   at its other side at once, but for what the tip adds.  Sharper than half a ray's part of the half turn none is
   measured. */
START_TEST(beside_the_tip)
{
    static const double DEGREES[5] = {20, 30, 45, 60, 80};
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.wedges = 16;
    for (int i = 0; i < 5; i++) {
        vec2 corner;
        double angle = radians(DEGREES[i]), part = DEGREES[i] / 180;
        int32_t row = corner_floe(&r, angle, &corner);
        for (int side = -1; side <= 1; side += 2) {
            vec2 along = {real_cos(angle / 2), side * real_sin(angle / 2)};
            double near = ice_under(&r, row, vec2_add(corner, vec2_scale(along, 0.02)), 0.3).wedges;
            ck_assert_msg(near >= part && near < part + 0.01, "%g degrees: %g of an edge, expected %g", DEGREES[i],
                          near, part);
        }
        fracture_rig_remove_all(&r);
    }
    fracture_rig_free(&r);
}
END_TEST

/* The same corner between two openings of a sheet. */
START_TEST(beside_the_tip_of_a_sheet)
{
    fracture_rig r;
    fracture_rig_make(&r);
    polygon_list openings = {0};
    const vec2 below[4] = {{-80, -80}, {80, -80}, {80, 30}, {-80, 30}}, left[3] = {{-80, -50}, {80, 110}, {-80, 110}};
    ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){below, 4}));
    ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){left, 3}));
    sheet_make(&r, (box2){{-60, 0}, {60, 90}}, 25, &openings);
    r.settings.wedges = 16;
    double near = ice_under(&r, sheet_tile_at(&r, (vec2){5, 32}), (vec2){0.02, 30}, 0.3).wedges;
    ck_assert_msg(near >= 0.25 && near < 0.26, "%g of an edge, expected a quarter", near);
    polygon_list_free(&r.ctx, &openings);
    fracture_rig_free(&r);
}
END_TEST

/* A long band bears what of it is in the whole stencil; a floe that is small every way is measured no farther than it
   goes: it does not break the more easily the smaller it is. */
START_TEST(narrow_ice)
{
    fracture_rig r;
    fracture_rig_make(&r);
    const vec2 band[4] = {{-50, -1}, {50, -1}, {50, 1}, {-50, 1}};
    int32_t row = fracture_rig_floe(&r, (polygon){band, 4}, 1, MOTION_DYNAMIC);
    double radius = fracture_edge_reach(&r.settings, &FRACTURE_RIG_ICE, 1, 0.3);
    double side = fracture_wedge_side(&r.settings, radius);
    vec2 stencil[MOST_STENCIL];
    int count =
        fracture_stencil(r.settings.wedges, side, &(crack_start){.point = {0, -1}, .direction = {0, 1}}, stencil);
    ck_assert_double_gt(side, 4);
    assert_relative(ice_under(&r, row, (vec2){0, -0.9}, 0.3).wedges,
                    2 * polygon_overlap_area((polygon){stencil, count}, (polygon){band, 4}) /
                        polygon_area((polygon){stencil, count}),
                    1e-9);
    double part[2];
    for (int i = 0; i < 2; i++) {
        double half = i ? 0.2 : 1;
        const vec2 square[4] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
        row = fracture_rig_floe(&r, (polygon){square, 4}, 1, MOTION_DYNAMIC);
        part[i] = ice_under(&r, row, (vec2){0, -half}, 0.3).wedges;
    }
    ck_assert_double_gt(part[0], 0.5);
    assert_relative(part[1], part[0], 1e-9);
    fracture_rig_free(&r);
}
END_TEST

/* A ring about the origin: its corners at random distances, some of them deep notches, some of them spikes. */
static int32_t star(random_stream *r, double size, double depth, vec2 *out)
{
    int32_t count = 3 + (int32_t)(9 * random_unit(r));
    for (int32_t i = 0; i < count; i++) {
        double angle = 2 * PI * i / count, far = size * (1 - depth * random_unit(r));
        out[i] = (vec2){far * real_cos(angle), far * real_sin(angle)};
    }
    return count;
}

/* The ice that there is at least is never more than the ice that there is, and not much less on an edge. */
START_TEST(at_least)
{
    fracture_rig r;
    fracture_rig_make(&r);
    random_stream random = random_begin(51, 0, 0);
    double told = 0, least = HUGE_VAL;
    int loads = 0;
    for (int i = 0; i < 300; i++) {
        vec2 ring[12];
        int32_t count =
            star(&random, random_uniform(&random, 1, 60), i % 3 ? random_uniform(&random, 0, 0.97) : 0, ring);
        int32_t row = fracture_rig_floe(&r, (polygon){ring, count}, 1, MOTION_DYNAMIC);
        ck_assert_int_ge(row, 0);
        polygon outline = shape_outline(&r.shapes, r.bodies.shape[r.floes.body[row]]);
        r.settings.wedges = 2 + (int32_t)(31 * random_unit(&random));
        for (int k = 0; k < 20; k++) {
            int32_t a = (int32_t)(outline.count * random_unit(&random)), b = a + 1 < outline.count ? a + 1 : 0;
            double part = k % 4 ? random_unit(&random) : 0;
            vec2 at = vec2_add(vec2_scale(outline.vertex[a], 1 - part), vec2_scale(outline.vertex[b], part));
            double area = random_uniform(&random, 0.01, 3), some = least_under(&r, row, at, area);
            double all = ice_under(&r, row, at, area).wedges;
            ck_assert_msg(some >= 0 && some <= all * (1 + 1e-9), "at least %g of %g", some, all);
            told += some / all;
            loads++;
        }
        fracture_rig_remove_all(&r);
    }
    ck_assert_msg(told > 0.25 * loads, "%g in the mean", told / loads);
    /* The stem of a T is loaded from above: beside the crack there is next to nothing. */
    const vec2 tee[8] = {{-10, 0}, {10, 0}, {10, 0.3}, {0.2, 0.3}, {0.2, 30}, {-0.2, 30}, {-0.2, 0.3}, {-10, 0.3}};
    int32_t row = fracture_rig_floe(&r, (polygon){tee, 8}, 1, MOTION_DYNAMIC);
    vec3 centre = r.bodies.position[r.floes.body[row]];
    vec2 foot = {-centre.x, -centre.y};
    r.settings.wedges = 32;
    ck_assert_double_le(least_under(&r, row, foot, 0.5), ice_under(&r, row, foot, 0.5).wedges);
    fracture_rig_remove_all(&r);
    const vec2 plate[4] = {{-100, -100}, {100, -100}, {100, 100}, {-100, 100}};
    row = fracture_rig_floe(&r, (polygon){plate, 4}, 1, MOTION_DYNAMIC);
    for (r.settings.wedges = 2; r.settings.wedges <= 32; r.settings.wedges++)
        least = testing_smaller(least, least_under(&r, row, (vec2){3, -100}, 0.5));
    ck_assert_msg(least > 0.4, "%g of an edge", least);
    ck_assert_double_gt(least_under(&r, row, (vec2){-100, -100}, 0.5), 0.2);
    r.settings.sharing = SHARING_EQUAL;
    ck_assert(least_under(&r, row, (vec2){3, -100}, 0.5) == 1);
    fracture_rig_free(&r);
}
END_TEST

TEST_MAIN("fracture_edge", at_least, corners, corner_capacity, edges, beside_the_tip, beside_the_tip_of_a_sheet,
          beside_a_bite, narrow_ice)
