/* The strip on water against its two limits and against the beam's equation solved another way. */
#include "base/transcendental.h"
#include "ice/strip.h"
#include "testing.h"

/* docs/oracles.md, section 1. */
START_TEST(semi_infinite)
{
    assert_relative(strip_solve(HUGE_VAL).moment, 0.455938127766, 1e-11);
    assert_relative(strip_solve(HUGE_VAL).x_max, 1.110720734540, 1e-11);
    assert_relative(strip_solve(HUGE_VAL).stiffness, sqrt(0.5), 1e-11);
    assert_relative(strip_solve(25).stiffness, sqrt(0.5), 1e-11);
    assert_relative(strip_solve(25).moment, 0.455938127766, 1e-11);
    assert_relative(strip_solve(29).x_max, strip_solve(27).x_max, 1e-11);
}
END_TEST

/* Rigid on the water's linear pressure: M = p L u (1 - u)^2 at u = x/L, largest at a third. */
START_TEST(rigid)
{
    for (double length = 1e-3; length < 0.2; length *= 2) {
        strip s = strip_solve(length);
        assert_relative(s.moment, 4.0 / 27 * length, 1e-5);
        assert_relative(s.x_max, length / 3, 1e-5);
    }
    assert_relative(strip_solve(0.0424).stiffness, strip_solve(0.0425).stiffness * 0.0424 / 0.0425, 1e-7);
    assert_relative(strip_solve(0.0424).moment / 0.0424, strip_solve(0.0425).moment / 0.0425, 1e-7);
}
END_TEST

enum { NODES = 800 };

/* Largest moment |w''|, and the deflection of the loaded end for a unit load, by integrating the beam's equation step
 * by step (k = D = 1, so that l = 1). */
static double by_steps(double length, double *place, double *tip)
{
    static double m[NODES + 1];
    double step = length / NODES, best = 0;
    /* Shooting for w'''' + w = 0 from the loaded end: w'' = 0 and w''' = 1 there; w and w' such that w'' and w'''
       vanish at the far end. Linear: three shots. */
    double end[3][2], start[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    for (int shot = 0; shot < 4; shot++) {
        double y[4] = {0, 0, 0, 1};
        if (shot < 3) {
            y[0] = start[shot][0];
            y[1] = start[shot][1];
        } else {
            double a = end[1][0] - end[0][0], b = end[2][0] - end[0][0], c = end[1][1] - end[0][1],
                   d = end[2][1] - end[0][1], det = a * d - b * c;
            y[0] = (-end[0][0] * d + end[0][1] * b) / det;
            y[1] = (-end[0][1] * a + end[0][0] * c) / det;
        }
        *tip = y[0];
        for (int i = 0; i <= NODES; i++) {
            m[i] = y[2];
            double k[4][4], at[4];
            for (int stage = 0; stage < 4; stage++) {
                for (int n = 0; n < 4; n++)
                    at[n] = y[n] + (stage ? (stage == 3 ? 1 : 0.5) * step * k[stage - 1][n] : 0);
                k[stage][0] = at[1];
                k[stage][1] = at[2];
                k[stage][2] = at[3];
                k[stage][3] = -at[0];
            }
            for (int n = 0; n < 4 && i < NODES; n++)
                y[n] += step / 6 * (k[0][n] + 2 * k[1][n] + 2 * k[2][n] + k[3][n]);
        }
        if (shot < 3) {
            end[shot][0] = y[2];
            end[shot][1] = y[3];
        }
    }
    for (int i = 0; i <= NODES; i++)
        if (fabs(m[i]) > best) {
            best = fabs(m[i]);
            *place = step * i;
        }
    return best;
}

START_TEST(lengths_between)
{
    static const double LENGTHS[] = {0.1, 0.5, 1, 2, 3, 4, 6};
    double last = 0;
    for (size_t i = 0; i < sizeof LENGTHS / sizeof *LENGTHS; i++) {
        double place = 0, tip = 0, moment = by_steps(LENGTHS[i], &place, &tip);
        strip s = strip_solve(LENGTHS[i]);
        assert_relative(s.moment, moment, 1e-5);
        assert_relative(s.stiffness, 1 / fabs(tip), 1e-5);
        assert_absolute(s.x_max, place, 1.5 * LENGTHS[i] / NODES);
        ck_assert(s.moment < 4.0 / 27 * LENGTHS[i] + 1e-12);
        ck_assert(s.moment > last || LENGTHS[i] > 3);
        last = s.moment;
    }
}
END_TEST

TEST_MAIN("strip", semi_infinite, rigid, lengths_between)
