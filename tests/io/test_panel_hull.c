/* Panels with cracks (tests/data/cracked_panels.gdf, made by the script beside it): sealed, closed, and with the
   hydrostatics of the shape that the panels stand for. */
#include "base/transcendental.h"
#include "io/hull_file.h"
#include "testing.h"
#include "vessel/hydrostatics.h"

#define HULL "tests/data/cracked_panels.gdf"

/* The barge: a rectangle of 138 m, and half a circle of 22 m, as chords of the side's panels and of the bottom's. */
static const double length = 138, radius = 22, draught = 12;
enum { SIDE_CHORDS = 40, BOTTOM_CHORDS = 24 };

static double half_circle(int chords) { return 0.5 * radius * radius * chords * real_sin(PI / chords); }

static mesh read_hull(context *ctx, hull_file_report *report)
{
    const hull_file_options options = hull_file_defaults();
    mesh m = {0};
    fram_error error = {0};
    assert_ok(hull_file_read(ctx, HULL, &options, &m, report, &error), error);
    return m;
}

START_TEST(cracks_are_sealed)
{
    context ctx;
    context_init(&ctx);
    hull_file_report r;
    mesh m = read_hull(&ctx, &r);
    ck_assert(r.mirror_y && !r.mirror_x);
    /* The chords of side and bottom leave a gap in z = -12, which is as large as the half circles differ. */
    double gap = half_circle(SIDE_CHORDS) - half_circle(BOTTOM_CHORDS);
    assert_absolute(r.seal.area_vector.z, -gap, 1e-3);
    assert_absolute(r.seal.area_vector.x, 0, 1e-3);
    assert_absolute(r.seal.area_vector.y, 0, 1e-3);
    /* Sides that are led over the bottom's corners lean by what the crack is wide. */
    assert_relative(r.seal.volume.z, draught * gap, 0.02);
    /* Nothing is farther off than the bottom's chords from their arc. */
    double sagitta = radius * (1 - real_cos(0.5 * PI / BOTTOM_CHORDS));
    ck_assert(r.seal.width > 0.5 * sagitta && r.seal.width < 1.01 * sagitta);
    mesh_report report;
    ck_assert_int_eq(mesh_check(&ctx, &m, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(hydrostatics)
{
    context ctx;
    context_init(&ctx);
    hull_file_report r;
    mesh m = read_hull(&ctx, &r);
    const hull_attitude upright = {0, 0, 0};
    hull_stability s;
    fram_error error = {0};
    assert_ok(hull_stability_of(&ctx, &m, &upright, vec3_make(0, 0, -1), &s, &error), error);
    vec3 v = s.at.volume_integrals;
    assert_relative(v.x, v.z, 1e-9);
    assert_relative(v.y, v.z, 1e-9);
    double plane = 2 * radius * length + half_circle(SIDE_CHORDS);
    /* The water plane is that of the side's panels; at the bottom the crack moves a part in 1e5 of the volume. */
    assert_relative(s.at.waterplane_area, plane, 1e-6);
    assert_relative(s.at.volume, plane * draught, 1e-5);
    assert_relative(s.centre_of_buoyancy.z, -0.5 * draught, 1e-4);
    assert_absolute(s.length_waterline, length + radius, 1e-9);
    assert_absolute(s.breadth_waterline, 2 * radius, 1e-9);
    mesh_free(&ctx, &m);
}
END_TEST

TEST_MAIN("panel_hull", cracks_are_sealed, hydrostatics)
