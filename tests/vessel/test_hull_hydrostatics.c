/* What floats of a mesh: closed forms of boxes, wedges and the icebreaker, and meshes that leak. */
#include "samples.h"

static hull_hydrostatics at_level(const mesh *m, double level)
{
    context ctx;
    context_init(&ctx);
    hull_hydrostatics out;
    fram_error error = {0};
    assert_ok(hull_hydrostatics_at(&ctx, m, level, &out, &error), error);
    return out;
}

START_TEST(box_levels)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    ck_assert(mesh_make_box(&ctx, vec3_make(-3, 1, -4), vec3_make(7, 5, 2), &m));
    for (double level = -3.5; level < 2; level += 1.25) {
        hull_hydrostatics h = at_level(&m, level);
        assert_relative(h.volume, 40 * (level + 4), 1e-13);
        assert_vec3_close(h.centre_of_buoyancy, vec3_make(2, 3, 0.5 * (level - 4)), 1e-12);
        assert_relative(h.waterplane_area, 40, 1e-13);
        assert_vec2_close(h.centre_of_flotation, vec2_make(2, 3), 1e-12);
        assert_relative(h.waterplane_xx, 10 * 64 / 12.0, 1e-12);
        assert_relative(h.waterplane_yy, 4 * 1000 / 12.0, 1e-12);
    }
    /* Under water: no water plane.  Above it: nothing. */
    hull_hydrostatics h = at_level(&m, 6);
    assert_relative(h.volume, 240, 1e-13);
    assert_vec3_close(h.centre_of_buoyancy, vec3_make(2, 3, -1), 1e-12);
    assert_bits(h.waterplane_area, 0);
    h = at_level(&m, -5);
    assert_bits(h.volume, 0);
    assert_bits(h.waterplane_area, 0);
    mesh_free(&ctx, &m);
}
END_TEST

/* Water plane of the icebreaker: rectangle of the parallel body and two triangles. */
START_TEST(icebreaker)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = icebreaker_particulars();
    mesh m = {0};
    polyhedron_array pieces = {0};
    fram_error error = {0};
    assert_ok(hull_make(&ctx, &p, &m, &pieces, &error), error);
    hull_hydrostatics h = at_level(&m, 0);
    double entrance = 10 / real_tan(p.entrance_angle), run_length = 55 - entrance, fore = 50 - entrance,
           aft = fore - 45;
    double area[3] = {45 * 20, 10 * entrance, 10 * run_length};
    double x[3] = {0.5 * (fore + aft), fore + entrance / 3, aft - run_length / 3};
    double own[3] = {45 * 45 / 12.0, entrance * entrance / 18, run_length * run_length / 18};
    double sum = area[0] + area[1] + area[2], centre = (area[0] * x[0] + area[1] * x[1] + area[2] * x[2]) / sum, yy = 0;
    for (int i = 0; i < 3; i++)
        yy += area[i] * (own[i] + (x[i] - centre) * (x[i] - centre));
    assert_relative(h.waterplane_area, sum, 1e-13);
    assert_vec2_close(h.centre_of_flotation, vec2_make(centre, 0), 1e-11);
    assert_relative(h.waterplane_xx, 45 * 8000 / 12.0 + (entrance + run_length) * 8000 / 48.0, 1e-12);
    assert_relative(h.waterplane_yy, yy, 1e-12);

    /* The water plane is the growth of the volume with the draught (central difference of a cubic: error h^2/6 V''').
     */
    double step = 1e-3, growth = (at_level(&m, step).volume - at_level(&m, -step).volume) / (2 * step);
    assert_relative(growth, sum, 1e-7);
    /* The centre of buoyancy moves towards the added layer: d(V zB)/dz = z A, here at z = 0. */
    hull_hydrostatics up = at_level(&m, step), down = at_level(&m, -step);
    assert_absolute((up.volume * up.centre_of_buoyancy.z - down.volume * down.centre_of_buoyancy.z) / (2 * step), 0,
                    1e-3);
    assert_absolute((up.volume * up.centre_of_buoyancy.x - down.volume * down.centre_of_buoyancy.x) / (2 * step),
                    sum * centre, 1e-3);
    assert_absolute(h.centre_of_buoyancy.y, 0, 1e-12);
    mesh_free(&ctx, &m);
    polyhedron_array_free(&ctx, &pieces);
}
END_TEST

START_TEST(leaking_mesh)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    ck_assert(mesh_make_box(&ctx, vec3_make(-3, -1, -4), vec3_make(7, 5, 2), &m));
    /* Without a lid it floats all the same; without a side it does not. */
    hull_hydrostatics whole = at_level(&m, 0), open;
    for (int32_t i = m.face.count - 1; i >= 0; i--)
        if (mesh_area_vector(&m, i).z > 0)
            m.face.data[i] = m.face.data[--m.face.count];
    open = at_level(&m, 0);
    assert_relative(open.volume, whole.volume, 1e-13);
    m.face.count--;
    fram_error error = {0};
    assert_fails(hull_hydrostatics_at(&ctx, &m, 0, &open, &error), error, FRAM_ERROR_INPUT, "not closed below z = 0 m");
    ck_assert_str_eq(error.key, "mesh");
    mesh_free(&ctx, &m);
}
END_TEST

TEST_MAIN("hull_hydrostatics", box_levels, icebreaker, leaking_mesh)
