/* Added mass of plates and ellipsoids, and 6 x 6 matrices. */
#include "fluid/added_mass.h"
#include "samples.h"

static plate_added_mass plate(polygon outline)
{
    polygon_moments m = polygon_moments_of(outline);
    return plate_added_mass_of(&m, 1025);
}

/* Oracles section 5: 10 x 10 m in heave, 233 t where the surface yields. */
START_TEST(plates)
{
    plate_added_mass square = plate(OUTLINE(square_outline));
    assert_relative(square.heave, 233e3, 1e-3);
    assert_relative(square.roll, square.heave * 8.0 / 15 * 100 / 12, 1e-12);
    assert_bits(square.roll, square.pitch);
    /* A disc of radius 5 has 4/3 rho r^3, 170.8 t; taken for the square of its area it has 5.1 % less. */
    vec2 circle[128];
    for (int i = 0; i < 128; i++)
        circle[i] = vec2_make(5 * real_cos(2 * PI * i / 128), 5 * real_sin(2 * PI * i / 128));
    plate_added_mass disc = plate((polygon){circle, 128});
    assert_relative(disc.heave, 162.1e3, 1e-3);
    assert_relative(disc.roll / disc.heave, 2.0 / 15 * 25, 2e-3);
    /* A strip: pi/8 rho a^2 a metre, of one of 100 m by 1 m half a per cent less; its own turn does not matter to
     * heave. */
    static const vec2 band[] = {{-5000, -0.5}, {5000, -0.5}, {5000, 0.5}, {-5000, 0.5}};
    assert_relative(plate(OUTLINE(band)).heave, PI / 8 * 1025 * 10000, 1e-3);
    static const vec2 strip[] = {{-50, -0.5}, {50, -0.5}, {50, 0.5}, {-50, 0.5}};
    assert_relative(plate(OUTLINE(strip)).heave, 0.9947 * PI / 8 * 1025 * 100, 1e-3);
    static const vec2 anti[] = {{-40.3, -29.6}, {-39.7, -30.4}, {40.3, 29.6}, {39.7, 30.4}};
    assert_relative(plate(OUTLINE(anti)).heave, plate(OUTLINE(strip)).heave, 1e-3);
}
END_TEST

/* The oracle's other limit, 485 t: under a rigid lid the plate is a sheet of sources of strength w/(2 pi), and its
   added mass rho/(2 pi) int int dS dS'/|r - r'|, 4 (ln(1 + sqrt 2) + (1 - sqrt 2)/3) for a square of side 1.  The
   integral is tried by rings about the source, which need no care at r = r'. */
START_TEST(square_under_a_rigid_lid)
{
    double unit = 4 * (real_log(1 + sqrt(2.0)) + (1 - sqrt(2.0)) / 3);
    enum { N = 40, RAYS = 400 };
    double sum = 0;
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            double x = (i + 0.5) / N, y = (j + 0.5) / N;
            for (int k = 0; k < RAYS; k++) {
                double angle = 2 * PI * (k + 0.5) / RAYS, c = real_cos(angle), s = real_sin(angle);
                double to_x = c > 0 ? (1 - x) / c : -x / c, to_y = s > 0 ? (1 - y) / s : -y / s;
                sum += fmin(to_x, to_y) * (2 * PI / RAYS) / (N * N);
            }
        }
    }
    assert_relative(sum, unit, 1e-3);
    double low = 1025 * 1000 * unit / (2 * PI);
    assert_relative(low, 485e3, 1e-3);
    /* Fram has the other limit. */
    assert_relative(low / plate(OUTLINE(square_outline)).heave, 2.08, 2e-3);
}
END_TEST

START_TEST(ellipsoids)
{
    /* Half a sphere: half of its displaced mass along every axis, nothing when it turns. */
    double volume = 2.0 / 3 * PI * 27;
    matrix6 ball = ellipsoid_added_mass(vec3_make(3, 3, 3), volume, 1000);
    for (int i = 0; i < 3; i++) {
        assert_relative(ball.m[i][i], 0.5 * 1000 * volume, 1e-13);
        assert_absolute(ball.m[3 + i][3 + i], 0, 1e-9);
    }
    /* Prolate 5:1 (Lamb 1932, section 114): k1 .059, k2 .895, k' .701. */
    volume = 2.0 / 3 * PI * 5;
    matrix6 ship = ellipsoid_added_mass(vec3_make(5, 1, 1), volume, 1000);
    assert_absolute(ship.m[0][0] / (1000 * volume), 0.0591, 1e-4);
    assert_absolute(ship.m[1][1] / (1000 * volume), 0.8943, 1e-3);
    assert_absolute(ship.m[4][4] / (1000 * volume * 26.0 / 5), 0.7000, 2e-3);
    assert_bits(ship.m[1][1], ship.m[2][2]);
    assert_absolute(ship.m[3][3], 0, 1e-9);
    /* A flat disc deep under water, both sides: 8/3 rho r^3 along z, 16/45 rho r^5 when it turns over. */
    double thin = 1e-5;
    matrix6 disc = ellipsoid_added_mass(vec3_make(2, 2, thin), 4.0 / 3 * PI * 4 * thin, 1000);
    assert_relative(disc.m[2][2], 8.0 / 3 * 1000 * 8, 1e-4);
    assert_relative(disc.m[3][3], 16.0 / 45 * 1000 * 32, 1e-4);
    assert_relative(disc.m[4][4], disc.m[3][3], 1e-9);
    ck_assert(disc.m[0][0] > 0 && disc.m[0][1] == 0);
}
END_TEST

static matrix6 random_matrix(random_stream *r)
{
    matrix6 a;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            a.m[i][j] = random_uniform(r, -1, 1) + (i == j ? 4 : 0);
    return a;
}

/* The same force on the same body, whichever point it is told about and whichever way z points. */
START_TEST(reference_points_and_axes)
{
    random_stream r = random_begin(31, 0, 0);
    for (int n = 0; n < 50; n++) {
        matrix6 at_p = random_matrix(&r);
        vec3 arm = random_vector(&r, 3), v = random_vector(&r, 1), w = random_vector(&r, 1);
        matrix6 at_q = matrix6_moved(&at_p, arm);
        pair6 p = matrix6_mul(&at_p, (pair6){vec3_add(v, vec3_cross(w, arm)), w});
        pair6 q = matrix6_mul(&at_q, (pair6){v, w});
        assert_vec3_close(q.linear, p.linear, 1e-12);
        assert_vec3_close(q.angular, vec3_add(p.angular, vec3_cross(arm, p.linear)), 1e-12);
        matrix6 over = matrix6_turned_over(&at_p);
        pair6 x = {{v.x, -v.y, -v.z}, {w.x, -w.y, -w.z}};
        pair6 up = matrix6_mul(&over, (pair6){v, w}), down = matrix6_mul(&at_p, x);
        assert_vec3_close(up.linear, vec3_make(down.linear.x, -down.linear.y, -down.linear.z), 1e-13);
        assert_vec3_close(up.angular, vec3_make(down.angular.x, -down.angular.y, -down.angular.z), 1e-13);
        pair6 back;
        ck_assert(matrix6_solve(&at_p, p, &back));
        assert_vec3_close(back.angular, w, 1e-12);
    }
    /* The supply ship of the MSS toolbox (docs/oracles.md, section 7), sway and yaw about midships, z down: a point 3 m
       ahead of midships sees m23 + 3 m22 ... with the sign of the other axes. */
    matrix6 fossen = {{{6.7644e6},
                       {0, 1.13412e7, 0, 0, 0, -3.401568e7},
                       {0, 0, 1},
                       {0, 0, 0, 1},
                       {0, 0, 0, 0, 1},
                       {0, -3.401568e7, 0, 0, 0, 4.452378e9}}};
    matrix6 ours = matrix6_turned_over(&fossen);
    assert_relative(ours.m[1][5], -3.401568e7, 1e-15);
    matrix6 moved = matrix6_moved(&ours, vec3_make(3, 0, 0));
    assert_relative(moved.m[1][5], -3.401568e7 + 3 * 1.13412e7, 1e-9);
    assert_relative(moved.m[5][5], 4.452378e9 - 6 * 3.401568e7 + 9 * 1.13412e7, 1e-14);
    matrix6 none = {0};
    pair6 x;
    /* Regular without a single number on its diagonal: each row of a permutation. */
    matrix6 turned = {{{[3] = 2}, {[0] = 4}, {[5] = 0.5}, {[1] = 1}, {[2] = 8}, {[4] = -1}}};
    ck_assert(matrix6_solve(&turned, (pair6){{2, 4, 3}, {4, 8, 6}}, &x));
    assert_vec3_close(x.linear, vec3_make(1, 4, 1), 1e-15);
    assert_vec3_close(x.angular, vec3_make(1, -6, 6), 1e-15);
    ck_assert(!matrix6_solve(&none, (pair6){{1, 2, 3}, {4, 5, 6}}, &x));
}
END_TEST

TEST_MAIN("added_mass", plates, square_under_a_rigid_lid, ellipsoids, reference_points_and_axes)
