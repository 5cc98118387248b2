/* The conical hull: volume in closed form, symmetry, refusals. */
#include "base/transcendental.h"
#include "hull_memory.h"
#include "testing.h"
#include "vessel/hull.h"

static hull_particulars cone(void)
{
    return (hull_particulars){
        .form = HULL_CONE, .length = 70, .beam = 70, .draught = 11.5, .freeboard = 3.3, .flare_angle = radians(59)};
}

START_TEST(volume_of_a_frustum)
{
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    hull_particulars p = cone();
    mesh surface = {0};
    polyhedron_array pieces = {0};
    assert_ok(hull_make(&ctx, &p, &surface, &pieces, &error), error);
    ck_assert_int_eq(pieces.count, 1);
    ck_assert_int_eq(pieces.data[0].face.count, 26);
    hull_hydrostatics h;
    assert_ok(hull_hydrostatics_at(&ctx, &surface, 0, &h, &error), error);
    /* A regular polygon of n corners on a circle of radius r: n / 2 r^2 sin(2 pi / n). */
    double shape = 12 * real_sin(2 * PI / 24), top = 35, bottom = 35 - 11.5 * real_tan(radians(59));
    assert_relative(h.waterplane_area, shape * top * top, 1e-12);
    assert_relative(h.volume, shape * 11.5 / 3 * (top * top + top * bottom + bottom * bottom), 1e-12);
    assert_absolute(h.centre_of_buoyancy.x, 0, 1e-12);
    assert_absolute(h.centre_of_buoyancy.y, 0, 1e-12);
    assert_absolute(h.waterline.hi.x, 35, 1e-12);
    assert_absolute(h.waterline.hi.y, 35, 1e-12);
    polyhedron_array_free(&ctx, &pieces);
    mesh_free(&ctx, &surface);
}
END_TEST

START_TEST(refusals)
{
    fram_error error = {0};
    hull_particulars p = cone();
    p.beam = 60;
    assert_fails(hull_particulars_check(&p, &error), error, FRAM_ERROR_INPUT, "beam of a cone");
    p = cone();
    p.flare_angle = radians(75);
    assert_fails(hull_particulars_check(&p, &error), error, FRAM_ERROR_INPUT, "no bottom is left");
    ck_assert_str_eq(error.key, "flare_angle");
    p.flare_angle = radians(90);
    assert_fails(hull_particulars_check(&p, &error), error, FRAM_ERROR_INPUT, "less than 89");
}
END_TEST

START_TEST(memory_runs_out) { hull_make_without_memory(cone()); }
END_TEST

TEST_MAIN("hull_cone", volume_of_a_frustum, refusals, memory_runs_out)
