/* Measures of ice management on fields of known sizes. */
#include "testing.h"

#include "base/transcendental.h"
#include "results/manage.h"

enum { MOST = 64 };

typedef struct field {
    context ctx;
    vec2 corner[MOST][4];
    manage_floe floe[MOST];
    int32_t count;
} field;

static void add(field *f, double x, double y, double side, bool sheet)
{
    vec2 *c = f->corner[f->count];
    double h = 0.5 * side;
    c[0] = vec2_make(x - h, y - h);
    c[1] = vec2_make(x + h, y - h);
    c[2] = vec2_make(x + h, y + h);
    c[3] = vec2_make(x - h, y + h);
    f->floe[f->count++] = (manage_floe){{c, 4}, {c[0], c[2]}, side * side, sheet, 1};
}

static manage_cover cover_of(field *f, manage_window w, double limit)
{
    manage_cover out;
    fram_error error = {0};
    assert_ok(manage_measure(&f->ctx, f->floe, f->count, &w, limit, 1, &out, NULL, &error), error);
    return out;
}

START_TEST(size_is_that_of_a_disc)
{
    assert_relative(manage_size(PI * 25), 10, 1e-15);
    assert_relative(manage_size(-PI * 25), 10, 1e-15);
}
END_TEST

/* Squares of 4 m (4.51 m across as discs) every 10 m, and one of 20 m (22.6 m) of which the window has a quarter. */
START_TEST(covers_are_areas_in_the_window)
{
    field f = {.count = 0};
    context_init(&f.ctx);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++)
            add(&f, 10 * i, 10 * k, 4, false);
    add(&f, 40, 30, 20, false);
    manage_cover c = cover_of(&f, (manage_window){{17.5, 12.5}, {1, 0}, 45, 35}, 10);
    const double whole = 45 * 35;
    assert_relative(c.ice, (12 * 16 + 100) / whole, 1e-12);
    assert_relative(c.managed, 12 * 16 / whole, 1e-12);
    assert_relative(c.of_class[2], 12 * 16 / whole, 1e-12);
    assert_relative(c.of_class[5], 100 / whole, 1e-12);
    assert_relative(c.largest, manage_size(400), 1e-12);
    assert_relative(c.size_area, (12 * 16 * manage_size(16) + 100 * manage_size(400)) / whole, 1e-12);
    ck_assert_double_eq(c.sheet, 0);
    managed_cover fine;
    fram_error error = {0};
    f.floe[12].thickness = 3;
    assert_ok(manage_measure(&f.ctx, f.floe, f.count, &(manage_window){{17.5, 12.5}, {1, 0}, 45, 35}, 10, 1, &c, &fine,
                             &error),
              error);
    assert_relative(fine.volume, (12 * 16 + 3 * 100) / whole, 1e-12);
    c = cover_of(&f, (manage_window){{17.5, 12.5}, {1, 0}, 45, 35}, 23);
    assert_relative(c.managed, c.ice, 1e-12);
}
END_TEST

/* Five squares of 4 and five of 20 cm in a model of 1:40. */
START_TEST(sizes_of_a_model_are_told_apart)
{
    const double unit = 1.0 / 40, size[2] = {manage_size(0.04 * 0.04), manage_size(0.2 * 0.2)};
    field f = {.count = 0};
    context_init(&f.ctx);
    fram_error error = {0};
    for (int i = 0; i < 10; i++)
        add(&f, 0.1 * i, 0, i < 5 ? 0.04 : 0.2, false);
    manage_cover c;
    managed_ice sum = {.windows = 0};
    managed_cover fine;
    managed_law law;
    const manage_window window = {{0.5, 0}, {1, 0}, 2, 1};
    assert_ok(manage_measure(&f.ctx, f.floe, f.count, &window, 0.1, unit, &c, &fine, &error), error);
    /* 1.8 and 9 m of full size: of the classes up to 2 and up to 10. */
    assert_relative(c.of_class[1], 5 * 0.0016 / 2, 1e-12);
    assert_relative(c.of_class[3], 5 * 0.04 / 2, 1e-12);
    managed_ice_add(&sum, &fine, c.largest / unit);
    assert_ok(manage_met_law(&sum, unit, (double)NAN, &law, &error), error);
    ck_assert(law.edge[0] < size[0] && law.edge[1] > size[0]);
    ck_assert(law.edge[law.bins - 1] < size[1] && law.edge[law.bins] > size[1]);
    assert_relative(law.mean, (0.0016 * size[0] + 0.04 * size[1]) / 0.0416, 1e-12);
    assert_relative(law.largest, size[1], 1e-12);
}
END_TEST

/* A window that is turned by 30 degrees in a sheet is all sheet; outside of all ice it is empty; half way, half. */
START_TEST(windows_turn_and_the_sheet_is_no_floe)
{
    field f = {.count = 0};
    context_init(&f.ctx);
    add(&f, 0, 0, 200, true);
    vec2 along = {sqrt(0.75), 0.5};
    manage_cover c = cover_of(&f, (manage_window){{10, 5}, along, 40, 20}, 1e9);
    assert_relative(c.sheet, 1, 1e-12);
    assert_relative(c.ice, 1, 1e-12);
    ck_assert_double_eq(c.managed, 0);
    ck_assert_double_eq(c.largest, 0);
    assert_relative(cover_of(&f, (manage_window){{100, 0}, along, 40, 20}, 1).ice, 0.5, 1e-12);
    ck_assert_double_eq(cover_of(&f, (manage_window){{300, 0}, along, 40, 20}, 1).ice, 0);
}
END_TEST

/* Two triangles that meet in a point, and a concave floe: a comb of two teeth with the window across them. */
START_TEST(concave_floes_count_by_area)
{
    static const vec2 comb[] = {{0, 0}, {30, 0}, {30, 20}, {20, 20}, {20, 5}, {10, 5}, {10, 20}, {0, 20}};
    field f = {.count = 1};
    context_init(&f.ctx);
    f.floe[0] = (manage_floe){{comb, 8}, {{0, 0}, {30, 20}}, 450, false, 1};
    manage_cover c = cover_of(&f, (manage_window){{15, 12.5}, {0, 1}, 5, 40}, 1);
    assert_relative(c.ice, 2 * 10 * 5 / 200.0, 1e-12);
}
END_TEST

/* Updrift is +x, the vessel at 0: floes of 30 m at 50 (edge at 35) and of 60 m at 300 (270), a sheet from 500 on;
   one of 40 m aside of the strip counts nowhere, and nor do those that are managed. */
START_TEST(threats_are_the_nearest_and_the_largest)
{
    field f = {.count = 0};
    context_init(&f.ctx);
    fram_error error = {0};
    manage_window strip = {{500, 0}, {1, 0}, 1000, 50};
    manage_threat t;
    add(&f, 20, 0, 8, false);
    add(&f, 100, 60, 40, false);
    assert_ok(manage_threat_in(&f.ctx, f.floe, f.count, &strip, 20, &t, &error), error);
    ck_assert(isinf(t.nearest) && isinf(t.largest) && t.size <= 0);
    add(&f, 300, 0, 60, false);
    add(&f, 50, 10, 30, false);
    assert_ok(manage_threat_in(&f.ctx, f.floe, f.count, &strip, 20, &t, &error), error);
    assert_relative(t.nearest, 35, 1e-12);
    assert_relative(t.largest, 270, 1e-12);
    assert_relative(t.size, manage_size(3600), 1e-12);
    add(&f, 700, 0, 400, true);
    assert_ok(manage_threat_in(&f.ctx, f.floe, f.count, &strip, 20, &t, &error), error);
    assert_relative(t.nearest, 35, 1e-12);
    assert_relative(t.largest, 500, 1e-12);
    ck_assert(isinf(t.size));
}
END_TEST

/* A sheet that reaches to the vessel is no rounding away, however the strip is turned and wherever it begins. */
START_TEST(ice_at_the_vessel_is_at_no_distance)
{
    field f = {.count = 0};
    context_init(&f.ctx);
    fram_error error = {0};
    add(&f, 0, 0, 200, true);
    for (int i = 1; i < 40; i++) {
        vec2 along = {cos(0.1 * i), sin(0.1 * i)};
        manage_threat t;
        manage_window strip = {{0.7 * i + 150 * along.x, -i / 3.0 + 150 * along.y}, along, 300, 50};
        assert_ok(manage_threat_in(&f.ctx, f.floe, f.count, &strip, 20, &t, &error), error);
        ck_assert_double_eq(t.nearest, 0);
    }
}
END_TEST

TEST_MAIN("manage_ice", size_is_that_of_a_disc, covers_are_areas_in_the_window, sizes_of_a_model_are_told_apart,
          windows_turn_and_the_sheet_is_no_floe, concave_floes_count_by_area, threats_are_the_nearest_and_the_largest,
          ice_at_the_vessel_is_at_no_distance)
