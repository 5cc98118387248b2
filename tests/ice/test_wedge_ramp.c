/* A wedge under a rising load: solutions of the equation between the nodes of the table, and its limits. */
#include "ice/edge_give.h"
#include "ice/wedge.h"
#include "ice/wedge_ramp.h"
#include "ice_rig.h"

/* a/l, tau, and the three ratios by all modes of a beam of finite elements (validation/wedge_ramp.py); none is a node.
 */
static const double SOLVED[][5] = {
    {0.02, 0.3, 0.9593, 0.6538, 0.14649},  {0.02, 2, 1.0009, 1.0159, 0.84785},   {0.06, 0.05, 0.7136, 0.3784, 0.02039},
    {0.06, 0.3, 0.9095, 0.6521, 0.14063},  {0.06, 1.2, 0.9916, 0.9479, 0.55753}, {0.15, 0.12, 0.6491, 0.5033, 0.04407},
    {0.15, 0.7, 0.9313, 0.8278, 0.31914},  {0.4, 0.25, 0.5137, 0.6440, 0.07283}, {0.4, 1.5, 0.9806, 0.9695, 0.63892},
    {0.9, 0.033, 0.0232, 0.7098, 0.00036}, {0.9, 0.6, 0.4827, 0.8227, 0.15525},
};

START_TEST(between_nodes)
{
    for (size_t i = 0; i < sizeof SOLVED / sizeof *SOLVED; i++) {
        wedge_ramp r = wedge_ramp_at(SOLVED[i][0], SOLVED[i][1]);
        /* Nodes are coarse for wide loads. */
        double tolerance = SOLVED[i][0] < 0.3 ? 0.003 : 0.05;
        assert_relative(r.moment, SOLVED[i][2], tolerance);
        assert_relative(r.place, SOLVED[i][3], tolerance);
        assert_relative(r.tip, SOLVED[i][4], tolerance);
    }
}
END_TEST

START_TEST(limits)
{
    wedge_ramp r = wedge_ramp_at(0.1, 20);
    ck_assert(r.moment == 1 && r.place == 1 && r.tip == 1);
    r = wedge_ramp_at(0.1, HUGE_VAL);
    ck_assert(r.moment == 1 && r.place == 1 && r.tip == 1);
    /* At once the mass alone resists: under an even load eta_tt = p t/tau, eta = p tau^2/6 under the middle of the
     * load. */
    double tau = 0.03, a = 1;
    assert_relative(wedge_ramp_at(a, tau).tip, 2 / (a * a) * tau * tau / 6 / wedge_tip_deflection(a), 0.15);
    /* Beyond the ends of the table its ends; never a tip without deflection, nor more of a moment than is said. */
    for (double x = 1e-4; x < 10; x *= 1.1)
        for (double t = 0; t < 20; t = 1.1 * t + 1e-3) {
            r = wedge_ramp_at(x, t);
            ck_assert(r.tip >= WEDGE_RAMP_LEAST_TIP && r.moment > 0 && r.moment <= WEDGE_RAMP_MOST_MOMENT &&
                      r.place > 0);
        }
}
END_TEST

/* Time goes with the mass of ice and of the water under waves of the length of the break: 1 m on a radius of 0.3 m, R
   of 4.15 m at rest, 9,000 kg/m2 of which 8 % are ice's. */
START_TEST(time_of_an_edge)
{
    const edge_compliance e = {true, true, 1025, 9.81, 3, false, false};
    const edge_compliance massless = {true, false, 1025, 9.81, 3, false, false};
    const ice_material m = ICE_RIG_MATERIAL;
    double length = ice_characteristic_length(&m, 1, 1025, 9.81), radius = 0.3, time = 0.2, place = 1;
    double reach = length * wedge_solve(radius / length).x_max;
    wedge_ramp r = edge_rise(&e, &m, 1, radius, time), exact = WEDGE_RAMP_STATIC;
    for (int turn = 0; turn < 50; turn++) {
        double mass = m.density + 1025 * reach * place / (PI / 4);
        exact = wedge_ramp_at(radius / length, time / sqrt(mass / (1025 * 9.81)));
        place = exact.place;
    }
    assert_relative(r.place, exact.place, 0.02);
    assert_relative(r.moment, exact.moment, 0.01);
    ck_assert(r.place < 0.8 && r.tip < 0.3);
    r = edge_rise(&massless, &m, 1, radius, time);
    ck_assert(r.moment == 1 && r.place == 1 && r.tip == 1);
    r = edge_rise(&e, &m, 1, radius, HUGE_VAL);
    ck_assert(r.moment == 1 && r.place == 1 && r.tip == 1);
    /* An even rise lasts as long as it lasted, a load that stays counts twice its time. */
    ck_assert(edge_rise_time(50, 100) == 1 && edge_rise_time(5, 0) == HUGE_VAL);
}
END_TEST

TEST_MAIN("wedge_ramp", between_nodes, limits, time_of_an_edge)
