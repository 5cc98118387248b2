/* Panels under a patch of which only some points carry: each covers its own quarter (half, of a patch of two points) of
   the rectangle that has the second moments of all of them, so that no panel bears more than the pressure law allows,
   and all forces arrive. */
#include "sim/hull_pressure_parts.h"
#include "testing.h"

/* The pressure law of the test, panels of half a metre, and a patch of 2 m by 1 m on the bow of a box, x = 3: its
   rectangle ends on lines of the grid. */
static const double PRESSURE = 2e6, PANEL = 0.5, WIDE = 2, HIGH = 1, MIDDLE_Z = -1;

typedef struct bow {
    context ctx;
    pressure_options options;
    pressure_map map;
} bow;

static void bow_open(bow *b)
{
    fram_error error = {0};
    mesh hull = {0};
    context_init(&b->ctx);
    b->options = (pressure_options){.rules = {.size = PANEL}};
    b->map = (pressure_map){.ctx = &b->ctx, .o = &b->options};
    ck_assert(mesh_make_box(&b->ctx, (vec3){-3, -3, -3}, (vec3){3, 3, 1}, &hull));
    assert_ok(pressure_begin(&b->map, &hull, &error), error);
    mesh_free(&b->ctx, &hull);
}

static void bow_close(bow *b) { pressure_free(&b->map); }

/* Point i of a patch of 4 points as ice/patch_points.h gives them: half sides over sqrt(3) from the middle. */
static vec3 point_of(int i)
{
    double y = WIDE / 2 / sqrt(3), z = HIGH / 2 / sqrt(3);
    return (vec3){3, i & 1 ? -y : y, MIDDLE_Z + (i & 2 ? -z : z)};
}

/* Largest pressure of a panel, and the sum of the forces; the step is over then. */
static double end_step(bow *b, vec3 *sum)
{
    double most = 0;
    *sum = (vec3){0, 0, 0};
    for (int32_t i = 0; i < b->map.panels.panel.count; i++) {
        most = testing_larger(most, b->map.load[i].step / b->map.panels.panel.data[i].area);
        *sum = vec3_add(*sum, b->map.load[i].force);
    }
    pressure_end_step(&b->map, 1, 1);
    return most;
}

/* Each set of loaded points: all at the law's pressure, a quarter of the patch each. */
START_TEST(quarters)
{
    const vec3 normal = {-PRESSURE * WIDE * HIGH / 4, 0, 0}, friction = {0, 3e4, -2e4};
    vec3 point[4], sum;
    for (int i = 0; i < 4; i++)
        point[i] = point_of(i);
    patch_area area = patch_area_of(point, 4);
    for (int loaded = 1; loaded < 16; loaded++) {
        bow b;
        int count = 0;
        bow_open(&b);
        for (int i = 0; i < 4; i++) {
            if (!(loaded >> i & 1))
                continue;
            count++;
            ck_assert(pressure_add(&b.map, &area, point[i], normal, friction));
            /* The panel at the outer corner of its quarter is under it, whole. */
            vec3 corner = {3, (i & 1 ? -1 : 1) * (WIDE / 2 - PANEL / 2), MIDDLE_Z + (i & 2 ? -1 : 1) * PANEL / 2};
            const panel_load *l = &b.map.load[hull_panel_at(&b.map.panels, corner, (vec3){1, 0, 0})];
            assert_relative(l->step, PRESSURE * PANEL * PANEL, 1e-9);
        }
        double most = end_step(&b, &sum);
        ck_assert_msg(most <= PRESSURE * (1 + 1e-9), "points %d: a panel bears %g Pa", loaded, most);
        assert_vec3_close(sum, vec3_scale(vec3_add(normal, friction), count), 1e-6);
        bow_close(&b);
    }
}
END_TEST

/* A patch that is a line of two points: half of the line for the one that carries. */
START_TEST(halves)
{
    bow b;
    vec3 sum, normal = {-8e5, 0, 0}, none = {0, 0, 0};
    const vec3 point[2] = {{3, WIDE / 2 / sqrt(3), MIDDLE_Z + PANEL / 2},
                           {3, -WIDE / 2 / sqrt(3), MIDDLE_Z + PANEL / 2}};
    patch_area area = patch_area_of(point, 2);
    bow_open(&b);
    ck_assert(pressure_add(&b.map, &area, point[1], normal, none));
    for (int i = 0; i < 4; i++) {
        vec3 at = {3, PANEL * (i - 1.5), MIDDLE_Z + PANEL / 2};
        const panel_load *l = &b.map.load[hull_panel_at(&b.map.panels, at, (vec3){1, 0, 0})];
        assert_absolute(l->step, at.y < 0 ? 4e5 : 0, 1e-6);
    }
    assert_relative(end_step(&b, &sum), 4e5 / (PANEL * PANEL), 1e-9);
    assert_vec3_close(sum, normal, 1e-6);
    bow_close(&b);
}
END_TEST

/* One point alone is where it is. */
START_TEST(a_point)
{
    bow b;
    vec3 sum, at = {3, 0.2, -0.2};
    bow_open(&b);
    patch_area area = patch_area_of(&at, 1);
    ck_assert(pressure_add(&b.map, &area, at, (vec3){-1e5, 0, 0}, (vec3){0, 0, 0}));
    assert_relative(end_step(&b, &sum), 1e5 / (PANEL * PANEL), 1e-9);
    bow_close(&b);
}
END_TEST

/* Around a corner of 4 m of the bow and 1 m of the side: the rectangle of both, which reaches 0.6 m past the corner.
   That part falls on the side, spread along it, and no panel of the bow bears more than the law. */
START_TEST(a_patch_around_a_corner)
{
    bow b;
    const double width = 4.497, past = 0.599, root = sqrt(17);
    const vec3 out = {4 / root, -1 / root, 0}, along = {1 / root, 4 / root, 0}, middle = {2.9, -1.4, MIDDLE_Z};
    vec3 point[4], sum, normal = vec3_scale(out, -PRESSURE * root * HIGH / 4), none = {0, 0, 0};
    for (int i = 0; i < 4; i++) {
        point[i] = vec3_mad(middle, along, (i & 1 ? -1 : 1) * width / 2 / sqrt(3));
        point[i].z += (i & 2 ? -1 : 1) * HIGH / 2 / sqrt(3);
    }
    patch_area area = patch_area_of(point, 4);
    bow_open(&b);
    for (int i = 0; i < 4; i++)
        ck_assert(pressure_add(&b.map, &area, point[i], normal, none));
    double side = 0;
    for (int32_t i = 0; i < b.map.panels.panel.count; i++)
        side += b.map.panels.panel.data[i].side == SIDE_STARBOARD ? b.map.load[i].step : 0;
    assert_relative(side, PRESSURE * root * HIGH * past / width, 0.05);
    double most = end_step(&b, &sum);
    ck_assert_msg(most < PRESSURE, "a panel bears %g Pa", most);
    assert_vec3_close(sum, vec3_scale(normal, 4), 1e-6);
    bow_close(&b);
}
END_TEST

TEST_MAIN("hull pressure", quarters, halves, a_point, a_patch_around_a_corner)
