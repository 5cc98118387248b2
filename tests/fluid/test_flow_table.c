/* Wind and current by tables of coefficients, against the formula by hand. */
#include "base/transcendental.h"
#include "fluid/flow_apply.h"
#include "testing.h"

/* CX = -cos, CY = sin, CN = 0.1 sin 2 a at 0, 45, ... 180 degrees. */
static flow_table sides_alike(void)
{
    flow_table t = {.count = 5, .frontal = 200, .lateral = 900, .length = 80, .point = {2, 0, -3}};
    for (int i = 0; i < 5; i++) {
        double a = i * PI / 4;
        t.angle[i] = a;
        t.coefficient[i] = vec3_make(real_cos(a), i % 4 == 0 ? 0 : real_sin(a), i % 4 == 0 ? 0 : 0.1 * real_sin(2 * a));
    }
    return t;
}

START_TEST(coefficients_between_rows)
{
    flow_table t = sides_alike();
    assert_absolute(flow_coefficients(&t, PI / 4).x, real_cos(PI / 4), 1e-12);
    assert_absolute(flow_coefficients(&t, PI / 8).y, 0.5 * real_sin(PI / 4), 1e-12);
    assert_absolute(flow_coefficients(&t, -PI / 8).y, -0.5 * real_sin(PI / 4), 1e-12);
    assert_absolute(flow_coefficients(&t, 2 * PI - PI / 4).z, -0.1, 1e-12);
    assert_absolute(flow_coefficients(&t, PI).x, -1, 1e-12);
    assert_absolute(flow_coefficients(&t, 5 * PI).x, -1, 1e-12);
    /* A whole circle of its own: nothing is mirrored. */
    t = (flow_table){.count = 3, .angle = {0, PI, 2 * PI}, .coefficient = {{1, 2, 3}, {4, 5, 6}, {1, 2, 3}}};
    assert_vec3_close(flow_coefficients(&t, 1.5 * PI), vec3_make(2.5, 3.5, 4.5), 1e-12);
}
END_TEST

START_TEST(load_by_hand)
{
    flow_table t = sides_alike();
    double rho = 1025, u = 0.7;
    mat3 level = quat_matrix(quat_identity());
    /* From starboard: to port. */
    wrench load = flow_load(&t, rho, level, vec3_make(0, u, 0));
    double side = 0.5 * rho * u * u * 900;
    assert_vec3_close(load.force, vec3_make(0, side, 0), 1e-6);
    assert_vec3_close(load.moment, vec3_make(3 * side, 0, 2 * side), 1e-6);
    /* On the quarter, with a yaw moment of its own. */
    double q = 0.5 * rho * u * u, c = real_cos(PI / 4);
    load = flow_load(&t, rho, level, vec3_make(u * c, u * c, 5));
    assert_vec3_close(load.force, vec3_make(q * c * 200, q * c * 900, 0), 1e-6);
    assert_absolute(load.moment.z, 2 * q * c * 900 + 0.1 * q * 900 * 80, 1e-6);
    /* The ship turned, the flow turned with it. */
    double a = 1.1;
    mat3 turned = quat_matrix(quat_from_roll_pitch_yaw(0, 0, a));
    wrench same = flow_load(&t, rho, turned, mat3_mul_vec(turned, vec3_make(u * c, u * c, 0)));
    assert_vec3_close(same.force, mat3_mul_vec(turned, load.force), 1e-6);
    assert_absolute(same.moment.z, load.moment.z, 1e-6);
    load = flow_load(&t, rho, level, vec3_make(0, 0, 3));
    assert_absolute(vec3_length(load.force), 0, 0);
}
END_TEST

START_TEST(panels_meet_a_medium_at_rest)
{
    hull_flows flows = {.water = sides_alike()};
    media m = {.current = {1, 2, 0}, .wind = {3, 0, 0}, .water_density = 1025};
    media own = flows_media(&m, &flows, vec3_make(0.5, -0.5, 0.1));
    assert_vec3_close(own.current, vec3_make(0.5, -0.5, 0), 0);
    assert_vec3_close(own.wind, m.wind, 0);
    fluid_load load = {0};
    flows_add(&m, &flows, quat_matrix(quat_identity()), vec3_make(1, 1, 0), &load);
    assert_absolute(load.water_drag.force.y, 0.5 * 1025 * 900, 1e-6);
    assert_absolute(load.wind_drag.force.x, 0, 0);
}
END_TEST

TEST_MAIN("flow_table", coefficients_between_rows, load_by_hand, panels_meet_a_medium_at_rest)
