/* The elastic catenary against its closed form, its own inverse and limits. */
#include "base/transcendental.h"
#include "testing.h"
#include "vessel/catenary.h"

static const double inextensible = HUGE_VAL;

START_TEST(oracle)
{
    /* Oracles section 7: w 1 kN/m, H 400 kN, depth 50 m. */
    const catenary_line line = {500, 1000, inextensible};
    catenary_pull pull;
    double distance = catenary_distance(&line, 50, 400e3, &pull);
    /* What hangs free weighs what the line pulls down with. */
    double suspended = pull.vertical / line.weight;
    assert_absolute(suspended, 206.1553, 5e-5);
    assert_absolute(distance - (line.length - suspended), 197.9732, 5e-5);
    assert_relative(catenary_tension(pull), 450e3, 1e-12);
    pull = catenary_solve(&line, 50, distance, 0);
    assert_relative(pull.horizontal, 400e3, 1e-10);
    assert_relative(catenary_tension(pull), 450e3, 1e-10);
}
END_TEST

/* The shape of a line by marching along it in small steps from the bottom end: x and z of the upper end. */
static void march(const catenary_line *line, double h, double v, double *x, double *z)
{
    enum { STEPS = 20000 };
    double ds = line->length / STEPS;
    *x = *z = 0;
    for (int i = 0; i < STEPS; i++) {
        double up = fmax(v - line->weight * (line->length - (i + 0.5) * ds), 0), t = sqrt(h * h + up * up);
        double stretch = isfinite(line->stiffness) ? 1 + t / line->stiffness : 1;
        *x += ds * stretch * (t > 0 ? h / t : 0);
        *z += ds * stretch * (t > 0 ? up / t : 0);
    }
}

START_TEST(agrees_with_the_line_marched_in_small_steps)
{
    const catenary_line lines[] = {{500, 1000, inextensible}, {500, 1000, 2e7}, {300, 1500, 5e6}, {180, 200, 1e8}};
    const double pulls[] = {1e3, 5e4, 4e5, 3e6};
    for (int l = 0; l < 4; l++) {
        for (int p = 0; p < 4; p++) {
            catenary_pull pull;
            double distance = catenary_distance(&lines[l], 100, pulls[p], &pull), x, z;
            march(&lines[l], pulls[p], pull.vertical, &x, &z);
            assert_absolute(z, 100, 2e-2);
            assert_absolute(x, distance, 2e-2);
        }
    }
}
END_TEST

START_TEST(solving_undoes_the_distance_from_slack_to_taut)
{
    const catenary_line lines[] = {{500, 1000, inextensible}, {500, 1000, 2e7}, {120, 1500, 5e6}};
    for (int l = 0; l < 3; l++) {
        double before = 0;
        for (double h = 1; h < 1e8; h *= 3) {
            catenary_pull pull, found, again;
            double distance = catenary_distance(&lines[l], 100, h, &pull);
            ck_assert(distance > before || h > 1e6);
            before = distance;
            found = catenary_solve(&lines[l], 100, distance, 0);
            again = catenary_solve(&lines[l], 100, distance, 1.1 * h);
            assert_relative(catenary_tension(again), catenary_tension(found),
                            isfinite(lines[l].stiffness) ? 1e-9 : 1e-3);
            assert_relative(catenary_tension(found), catenary_tension(pull),
                            isfinite(lines[l].stiffness) ? 1e-9 : 1e-3);
        }
    }
}
END_TEST

START_TEST(slack_taut_and_too_short)
{
    catenary_line line = {500, 1000, 1e9};
    /* All of the height hangs below the upper end, the rest lies there. */
    catenary_pull pull = catenary_solve(&line, 100, 50, 0);
    ck_assert(pull.horizontal == 0);
    assert_relative(pull.vertical, 1e5, 1e-4);
    line = (catenary_line){100, 1, 1e8};
    /* A light line stretched by a tenth is a spring: T = EA (straight / L - 1). */
    pull = catenary_solve(&line, 66, 88, 0);
    assert_relative(catenary_tension(pull), 1e8 * 0.1, 1e-4);
    assert_relative(pull.vertical / pull.horizontal, 66.0 / 88.0, 1e-4);
    line.stiffness = inextensible;
    pull = catenary_solve(&line, 66, 88, 0);
    ck_assert(catenary_tension(pull) >= CATENARY_MOST);
}
END_TEST

START_TEST(length_for_a_pretension)
{
    catenary_line line = {0, 1000, 5e8};
    for (double tension = 1.2e5; tension < 3e6; tension *= 1.7) {
        ck_assert(catenary_length_for(line, 100, 600, tension, &line.length));
        assert_relative(catenary_tension(catenary_solve(&line, 100, 600, 0)), tension, 1e-6);
    }
    double untouched = -1;
    ck_assert(!catenary_length_for(line, 100, 600, 9e4, &untouched));
    ck_assert(untouched == -1);
}
END_TEST

TEST_MAIN("catenary", oracle, agrees_with_the_line_marched_in_small_steps,
          solving_undoes_the_distance_from_slack_to_taut, slack_taut_and_too_short, length_for_a_pretension)
