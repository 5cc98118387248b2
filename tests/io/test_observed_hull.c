/* The FPSO of the Marine Systems Simulator (WAMIT panels, half hull, with cracks): sealed, closed, and with the
   hydrostatics of an independent computation and of WAMIT's own printout. Skipped where the file is not there. */
#include "io/hull_file.h"
#include "testing.h"
#include "vessel/hydrostatics.h"
#include <stdio.h>
#include <unistd.h>

#define HULL "../shared/data/hulls/fpso_low.gdf"
enum { SKIPPED = 77 };

static mesh read_fpso(context *ctx, hull_file_report *report)
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
    mesh m = read_fpso(&ctx, &r);
    ck_assert_int_eq(r.elements, 1775);
    ck_assert(r.mirror_y && !r.mirror_x);
    /* The chords of the bottom's bow and of the bow's bottom leave a gap of 0.828 m2 in z = -12. */
    assert_absolute(r.seal.area_vector.z, -0.828, 0.001);
    assert_absolute(r.seal.area_vector.x, 0, 1e-3);
    assert_absolute(r.seal.area_vector.y, 0, 1e-3);
    assert_absolute(r.seal.volume.z, 12 * 0.828, 0.2);
    ck_assert(r.seal.width > 0.03 && r.seal.width < 0.05);
    /* What is left open is the waterline: 115 edges on either side. */
    ck_assert_int_eq(r.seal.open_after, 230);
    mesh_report report;
    ck_assert_int_eq(mesh_check(&ctx, &m, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
    mesh_free(&ctx, &m);
}
END_TEST

/* The 470 edges with one triangle, away from the waterline, that are not just badly rounded corners. */
START_TEST(open_edges)
{
    context ctx;
    context_init(&ctx);
    mesh_file f;
    fram_error error = {0};
    int32_t joined;
    assert_ok(mesh_file_read(&ctx, HULL, &f, &error), error);
    ck_assert_int_eq(mesh_weld(&ctx, &f.surface, 1e-3, &joined), FRAM_OK);
    mesh_seal_report r;
    ck_assert_int_eq(mesh_seal(&ctx, &f.surface, 0, NULL, &r), FRAM_OK);
    ck_assert_int_eq(r.open_before, 470 + 230);
    mesh_file_free(&ctx, &f);
}
END_TEST

START_TEST(hydrostatics)
{
    context ctx;
    context_init(&ctx);
    hull_file_report r;
    mesh m = read_fpso(&ctx, &r);
    const hull_attitude upright = {0, 0, 0};
    hull_stability s;
    fram_error error = {0};
    assert_ok(hull_stability_of(&ctx, &m, &upright, vec3_make(0, 0, -1), &s, &error), error);
    vec3 v = s.at.volume_integrals;
    assert_relative(v.x, v.z, 1e-6);
    assert_relative(v.y, v.z, 1e-6);
    /* An independent computation, and WAMIT's printout. */
    const double volume = 97947.92, wamit_volume = 97960.9;
    assert_relative(s.at.volume, volume, 1e-5);
    assert_relative(s.at.volume, wamit_volume, 0.005);
    assert_relative(s.centre_of_buoyancy.z, -5.922808, 1e-5);
    assert_relative(s.at.waterplane_area, 8315.66, 1e-5);
    assert_relative(s.at.waterplane_area, 8316.7, 0.005);
    assert_relative(s.c44, 0.7788e6, 1e-3);
    assert_relative(s.c44, 0.77917e6, 0.005);
    assert_relative(s.c55, 0.2462e8, 1e-3);
    assert_relative(s.c55, 0.24630e8, 0.005);
    assert_absolute(s.length_waterline, 200, 1e-9);
    assert_absolute(s.breadth_waterline, 44, 1e-9);
    assert_absolute(s.draught, 12, 1e-9);
    /* It floats there with its own mass. */
    hull_attitude found;
    assert_ok(hull_float(&ctx, &m, s.at.volume, vec3_make(s.centre_of_buoyancy.x, s.centre_of_buoyancy.y, -1), &found,
                         &error),
              error);
    assert_absolute(found.level, 0, 1e-9);
    assert_absolute(found.heel, 0, 1e-9);
    assert_absolute(found.trim, 0, 1e-9);
    mesh_free(&ctx, &m);
}
END_TEST

int main(void)
{
    if (access(HULL, R_OK) != 0) {
        puts("skipped: io/observed_hull, " HULL " is not there");
        return SKIPPED;
    }
    const TTest *const list[] = {cracks_are_sealed, open_edges, hydrostatics};
    return testing_run("observed_hull", list, (int)(sizeof list / sizeof *list));
}
