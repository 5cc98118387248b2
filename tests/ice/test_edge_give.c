/* Edges that give before they break (docs/decisions/0220): the deflection of a loaded tip, what of a patch is left
   then, and what it stands on. */
#include "base/transcendental.h"
#include "ice/edge_give.h"
#include "ice/fracture.h"
#include "ice/wedge.h"
#include "ice_rig.h"
#include "sheet_rig.h"

static const edge_compliance GIVES = {true, false, 1025, 9.81, 3, false, false};
static const double FOUNDATION = 1025 * 9.81;

/* A plate 2 m wide that leans by `slope` (x over z), `way` beyond the first touch with ice that begins at x = 0; the
   ice is one fixed floe of 1 m, or two with a seam at y = `seam`, and strong: no load here breaks it. */
static void ramp_make(ice_rig *r, double slope, double way, double seam)
{
    ice_rig_make(r, 0.01);
    r->settings.edges = GIVES;
    bool two = seam < 40;
    double width[2] = {seam + 40, 40 - seam}, middle[2] = {(seam - 40) / 2, (seam + 40) / 2};
    int32_t hull = ice_rig_slanted(r, slope, 1, 6);
    r->bodies.position[hull] = (vec3){way - 0.5 * fabs(slope), 0, 0};
    r->bodies.velocity[hull] = (vec3){0.1, 0, 0};
    for (int i = 0; i < (two ? 2 : 1); i++) {
        int32_t row = ice_rig_plate(r, 60, two ? width[i] : 80, 1, MOTION_STATIC), ice = r->floes.body[row];
        r->floes.material[row].flexural_strength = 1e9;
        r->bodies.position[ice] = (vec3){30, two ? middle[i] : 0, 0};
        ice_rig_pair(r, ice, hull);
    }
}

/* Load over deflection of a straight edge with Nevel's solution written out [N/m]. */
static double nevel(double area)
{
    double length = pow(5e9 / (12 * (1 - 0.09)) / FOUNDATION, 0.25), width = 6 * tan(PI / 6);
    return FOUNDATION * length * length * width / wedge_solve(sqrt(2 * area / width) / length).tip_deflection;
}

/* What crushes on the plate is what bends the edge, at any way, downward and upward: the contact is that of the plate
   in ice that has gone down by w = P/K. */
START_TEST(balance)
{
    static const double WAYS[] = {1e-4, 0.01, 0.05, 0.1, 0.3};
    for (int i = 0; i < 10; i++) {
        double slope = i < 5 ? 1 : -1, way = WAYS[i % 5];
        ice_rig r;
        ramp_make(&r, slope, way, 40);
        ice_rig_crush(&r);
        ck_assert_int_eq(r.patches.count, 1);
        const crushing_patch *p = &r.patches.data[0];
        double area = p->horizontal_area, give = 2e6 * area / nevel(area);
        assert_relative(2 * (way - give), area, 1e-8);
        assert_relative(p->area, area * sqrt(2.0), 1e-9);
        assert_relative(p->pressure, 2e6, 1e-9);
        double limit = 0;
        for (int32_t k = 0; k < r.contacts.count; k++)
            limit += r.contacts.data[k].impulse_limit;
        assert_relative(limit, 2e6 * p->area * 0.01, 1e-9);
        /* The middle of what is left: of a face of 2 m and the triangles of both sides, whose pushes cancel. */
        double c = way - give, face = 2 * sqrt(2.0), middle = (face * c / 2 + c * c / 3) / (face + c);
        assert_absolute(p->centre.x, middle, 1e-8);
        assert_absolute(fabs(p->centre.z), 0.5 - give - middle, 1e-8);
        ice_rig_free(&r);
    }
}
END_TEST

/* Friction of a hull that slides along the edge takes part of the load off that bends it: what crushes less what is
   dragged up is K w; under the friction angle nothing is left, and the edge stays.  At rest it is as without. */
START_TEST(friction_bears_a_part)
{
    static const double SLOPES[] = {1, -1, 0.2, 0.05};
    for (int i = 0; i < 4; i++) {
        double slope = SLOPES[i], way = 0.04, mu = 0.1, lean = 1 / sqrt(1 + slope * slope);
        for (int moves = 0; moves < 2; moves++) {
            ice_rig r;
            ramp_make(&r, slope, way, 40);
            r.policies.of[MATERIAL_ICE][MATERIAL_HULL].friction_kinetic = mu;
            r.policies.of[MATERIAL_HULL][MATERIAL_ICE].friction_kinetic = mu;
            if (!moves)
                r.bodies.velocity[0] = (vec3){0, 0, 0};
            ice_rig_crush(&r);
            ck_assert_int_eq(r.patches.count, 1);
            const crushing_patch *p = &r.patches.data[0];
            /* Upright load over p A: the lean of the normal, less mu along the slope. */
            double share = moves ? 1 - mu / fabs(slope) : 1, area = p->horizontal_area;
            double give = share > 0 ? share * p->pressure * area / nevel(area) : 0;
            assert_relative(2 * (way - fabs(slope) * give), area, 1e-7);
            assert_relative(p->area * fabs(slope) * lean, area, 1e-9);
            ck_assert((p->compliance > 0) == (share > 0));
            ice_rig_free(&r);
        }
    }
}
END_TEST

/* 362 kN on a wedge tip of 0.1 l put it down by 0.101 m (1 m, 5 GPa). */
START_TEST(stiffness_of_an_edge)
{
    ice_material m = ICE_RIG_MATERIAL;
    double length = 14.6079, width = 6 * tan(PI / 6), area = width * 0.01 * length * length / 2;
    double k = edge_stiffness(&GIVES, &m, 1, area, EDGE_STAND_STRAIGHT);
    assert_relative(k, FOUNDATION * length * length * width / 2.067333645437, 1e-5);
    assert_relative(362e3 / k, 0.101, 5e-3);
    /* Half the ice on a tip of the same length is half as stiff; a strip of 10 m adds k l w / sqrt(2). */
    edge_stand half = {.wedges = 0.5}, wide = {.wedges = 1, .strip = 10 * length * sqrt(0.5)};
    assert_relative(edge_stiffness(&GIVES, &m, 1, area / 2, half), k / 2, 1e-12);
    assert_relative(edge_stiffness(&GIVES, &m, 1, area, wide), k + FOUNDATION * 10 * length * sqrt(0.5), 1e-9);
}
END_TEST

/* Switched off, under a free floe, one that cannot break, or another floe, nothing gives. */
START_TEST(what_does_not_give)
{
    for (int i = 0; i < 4; i++) {
        ice_rig r;
        ramp_make(&r, 1, 0.1, 40);
        int32_t ice = r.floes.body[0];
        r.settings.edges.gives = i != 0;
        if (i == 1)
            r.bodies.motion[ice] = MOTION_DYNAMIC;
        if (i == 2)
            r.floes.breakable[0] = false;
        if (i == 3)
            r.settings.top_plane_area = true;
        ice_rig_crush(&r);
        assert_relative(r.patches.data[0].area, 0.2 * sqrt(2.0), 1e-9);
        ice_rig_free(&r);
    }
}
END_TEST

/* A flat face on the top of the edge, 10 mm in it: the edge goes down by 10 mm and bears K w, far less than crushes. */
START_TEST(flat_face)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    r.settings.edges = GIVES;
    int32_t row = ice_rig_plate(&r, 60, 80, 1, MOTION_STATIC), ice = r.floes.body[row];
    r.bodies.position[ice] = (vec3){30, 0, 0};
    int32_t hull = ice_rig_box(&r, (vec3){-1, -1, 0.49}, (vec3){1, 1, 3}, MOTION_PRESCRIBED, MATERIAL_HULL);
    r.bodies.velocity[hull] = (vec3){0, 0, -0.1};
    ice_rig_pair(&r, ice, hull);
    ice_rig_crush(&r);
    ck_assert_int_eq(r.patches.count, 1);
    const crushing_patch *p = &r.patches.data[0];
    assert_relative(p->horizontal_area, 2, 1e-9);
    assert_relative(p->pressure * p->horizontal_area, nevel(2) * 0.01, 1e-6);
    ck_assert(p->pressure < 0.1 * 2e6);
    ice_rig_free(&r);
}
END_TEST

/* Soft ice gives on past half its thickness, and is as stiff there as before: no load comes at once. */
START_TEST(large_deflections)
{
    for (int i = 0; i < 2; i++) {
        ice_rig r;
        double way = i ? 0.7 : 0.95;
        ramp_make(&r, 1, way, 40);
        r.floes.material[0].elastic_modulus = 1e7;
        ice_rig_crush(&r);
        double area = r.patches.data[0].horizontal_area;
        double give =
            2e6 * area / edge_stiffness(&r.settings.edges, &r.floes.material[0], 1, area, EDGE_STAND_STRAIGHT);
        ck_assert(give > 0.5 && give < way);
        assert_relative(2 * (way - give), area, 1e-8);
        assert_relative(r.patches.data[0].pressure, 2e6, 1e-9);
        ice_rig_free(&r);
    }
}
END_TEST

/* What fracture would note for the patches at hand. */
static void support_by_hand(ice_rig *r, double wedges)
{
    double sum = 0;
    for (int32_t i = 0; i < r->patches.count; i++)
        sum += r->patches.data[i].horizontal_area;
    ck_assert(table_resize(&r->ctx, &r->supports, &edge_support_table_info, r->patches.count));
    for (int32_t i = 0; i < r->patches.count; i++) {
        const crushing_patch *p = &r->patches.data[i];
        r->supports.surface[i] = p->surface_body;
        r->supports.generation[i] = r->bodies.generation[p->surface_body];
        r->supports.place[i] = body_to_local(&r->bodies, p->surface_body, p->centre);
        r->supports.wedges[i] = wedges;
        r->supports.part[i] = p->horizontal_area / sum;
        r->supports.strip[i] = r->supports.strip_bears[i] = 0;
        r->supports.known[i] = 1;
        r->supports.over[i] = 0;
    }
}

/* A seam does not make an edge stiffer: after some steps of the same way both parts give as the whole. */
START_TEST(seams)
{
    static const double SEAMS[] = {0, 0.3, 0.95};
    ice_rig whole;
    ramp_make(&whole, 1, 0.15, 40);
    ice_rig_crush(&whole);
    for (int i = 0; i < 3; i++) {
        ice_rig r;
        ramp_make(&r, 1, 0.15, SEAMS[i]);
        for (int step = 0; step < 60; step++) {
            ice_rig_crush(&r);
            ck_assert_int_eq(r.patches.count, 2);
            support_by_hand(&r, 1);
        }
        double sum = r.patches.data[0].horizontal_area + r.patches.data[1].horizontal_area;
        assert_relative(sum, whole.patches.data[0].horizontal_area, 1e-6);
        assert_relative(r.patches.data[1].horizontal_area / sum, (1 - SEAMS[i]) / 2, 1e-6);
        ice_rig_free(&r);
    }
    ice_rig_free(&whole);
}
END_TEST

/* A plate that is turned by `yaw` and goes on into ice that is cut into `tiles` across it: horizontal areas that are
   left, step by step [m2]. */
static void areas_over_tiles(int tiles, double yaw, int steps, double out[])
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    r.settings.edges = GIVES;
    int32_t hull = ice_rig_slanted(&r, 1, 1, 6);
    r.bodies.orientation[hull] = quat_from_roll_pitch_yaw(0, 0, yaw);
    r.bodies.velocity[hull] = (vec3){0.1, 0, 0};
    for (int i = 0; i < tiles; i++) {
        double lo = i == 0 ? -40 : -1 + 2.0 * i / tiles, hi = i == tiles - 1 ? 40 : -1 + 2.0 * (i + 1) / tiles;
        int32_t row = ice_rig_plate(&r, 60, hi - lo, 1, MOTION_STATIC), ice = r.floes.body[row];
        r.bodies.position[ice] = (vec3){30, (lo + hi) / 2, 0};
        ice_rig_pair(&r, ice, hull);
    }
    for (int step = 0; step < steps; step++) {
        r.bodies.position[hull] = (vec3){0.1 + 1e-3 * step - 0.5, 0, 0};
        ice_rig_crush(&r);
        support_by_hand(&r, 1);
        out[step] = 0;
        for (int32_t i = 0; i < r.patches.count; i++)
            out[step] += r.patches.data[i].horizontal_area;
    }
    ice_rig_free(&r);
}

/* However many tiles lie under a load it grows as without seams: at once where all are met alike, and within a
   twentieth after some steps where they are not; it never swings. */
START_TEST(many_seams)
{
    enum { STEPS = 40 };
    static const int TILES[] = {3, 5, 9};
    for (int i = 0; i < 6; i++) {
        double whole[STEPS], cut[STEPS], yaw = i < 3 ? 0 : 0.03;
        areas_over_tiles(1, yaw, STEPS, whole);
        areas_over_tiles(TILES[i % 3], yaw, STEPS, cut);
        for (int step = 20; step < STEPS; step++) {
            assert_relative(cut[step], whole[step], i < 3 ? 1e-6 : 0.05);
            ck_assert_double_gt(cut[step], cut[step - 1]);
        }
    }
}
END_TEST

/* Less ice under the load gives more; a row of another body, of one that is gone, or of far away is not its own. */
START_TEST(less_ice)
{
    for (int i = 0; i < 4; i++) {
        ice_rig r;
        ramp_make(&r, 1, 0.15, 40);
        ice_rig_crush(&r);
        double straight = r.patches.data[0].horizontal_area;
        support_by_hand(&r, 0.5);
        if (i == 1)
            r.supports.surface[0]++;
        if (i == 2)
            r.supports.generation[0]++;
        if (i == 3)
            r.supports.place[0].y += 10;
        ice_rig_crush(&r);
        double area = r.patches.data[0].horizontal_area;
        if (i > 0)
            assert_relative(area, straight, 1e-12);
        else
            assert_relative(2 * (0.15 - 2e6 * area / (nevel(2 * area) / 2)), area, 1e-8);
        ice_rig_free(&r);
    }
}
END_TEST

/* Ice that a step would load past what breaks it is loaded a tenth past that: Nevel's wedges by hand, P = sigma_f h^2/6
   N b0 C.  Once: what did not break then is loaded as it is, until its load is under that again. */
START_TEST(no_more_than_breaks_it)
{
    const double strength = 5e5, width = 6 * tan(PI / 6);
    for (int i = 0; i < 4; i++) {
        ice_rig r;
        ramp_make(&r, i == 1 ? -1 : 1, 0.3, 40);
        ice_rig_crush(&r);
        double free = r.patches.data[0].pressure, area = r.patches.data[0].horizontal_area;
        ck_assert(!r.patches.data[0].over);
        r.floes.material[0].flexural_strength = strength;
        if (i > 1)
            support_by_hand(&r, 1);
        if (i > 2)
            r.supports.over[0] = 1;
        ice_rig_crush(&r);
        const crushing_patch *p = &r.patches.data[0];
        double length = pow(5e9 / (12 * (1 - 0.09)) / FOUNDATION, 0.25);
        double breaks = strength / 6 * width * wedge_solve(sqrt(2 * area / width) / length).capacity;
        assert_relative(p->horizontal_area, area, 1e-12);
        ck_assert(free * area > 1.2 * breaks);
        assert_relative(p->pressure * area, i == 3 ? free * area : 1.1 * breaks, 1e-9);
        ck_assert_int_eq(p->over, i > 1); /* of ice that is not known yet nothing is kept */
        ice_rig_free(&r);
    }
}
END_TEST

/* A strip bears its own besides; an edge with inertia breaks at the load over the moment's ratio, of a load that rose
   as its impulse says; of one that is surely less nothing is worked out. */
START_TEST(breaking_load)
{
    const ice_material ice = {.density = 920,
                              .elastic_modulus = 5e9,
                              .poisson_ratio = 0.3,
                              .flexural_strength = 5e5,
                              .crushing_strength = 2e6};
    edge_compliance heavy = GIVES;
    heavy.inertia = true;
    edge_stand stand = EDGE_STAND_STRAIGHT, strip = stand;
    strip.strip_bears = edge_strip_bears(10, 0.46 * 14.6, 1);
    stand.rise = strip.rise = 0.05;
    double width = 6 * tan(PI / 6), least = 5e5 / 6 * width,
           rest = edge_breaking_load(&GIVES, &ice, 1, 0.2, stand, 1e9);
    assert_relative(strip.strip_bears, 10 / (6 * 0.46 * 14.6), 1e-12);
    edge_bearing both = edge_bears(&GIVES, &ice, 1, 0.2, 1, 5e5 * strip.strip_bears);
    assert_relative(edge_breaking_load(&GIVES, &ice, 1, 0.2, strip, 1e9), both.load, 1e-12);
    ck_assert(both.load > 5e5 * strip.strip_bears + least && both.load < rest + 5e5 * strip.strip_bears);
    double radius = edge_bears(&GIVES, &ice, 1, 0.2, 1, 0).radius;
    wedge_ramp r = edge_rise(&heavy, &ice, 1, radius, 0.05);
    ck_assert(r.moment < 0.97);
    assert_relative(edge_breaking_load(&heavy, &ice, 1, 0.2, stand, 1e9), rest / r.moment, 1e-12);
    ck_assert(isinf(edge_breaking_load(&heavy, &ice, 1, 0.2, stand, 0.9 * least)));
}
END_TEST

/* What a sheet's loads stand on is kept: a corner's ice, the parts at a seam, nothing of loads between floes. */
START_TEST(kept_by_fracture)
{
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.edges_give = true;
    sheet_make(&r, (box2){{0, 0}, {60, 60}}, 30, NULL);
    /* At the corner of the sheet and on a straight edge, strong enough to look at the ice and too weak to break it. */
    ck_assert(sheet_load(&r, (vec2){0, 0}, 2e4, 0.2));
    ck_assert(sheet_load(&r, (vec2){15, 0}, 2e4, 0.3));
    /* Both sides of the seam at x = 30. */
    ck_assert(sheet_load(&r, (vec2){29.9999999999, 60}, 2e4, 0.4));
    ck_assert(sheet_load(&r, (vec2){30.0000000001, 60}, 2e4, 0.1));
    for (int i = 0; i < 4; i++)
        r.patches.data[i].compliance = 1e-7;
    r.patches.data[1].over = r.patches.data[3].over = true;
    r.contacts.data[3].impulse_limit = 1.2 * r.contacts.data[3].impulse[0]; /* which it did not bear */
    ck_assert(sheet_load(&r, (vec2){45, 0}, 10, 0.1));                      /* too small to look at its ice */
    r.patches.data[4].compliance = 1e-7;
    ck_assert_int_eq(fracture_rig_break(&r), 0);
    const edge_support_table *e = &r.supports;
    ck_assert_int_eq(e->count, 5);
    ck_assert_int_eq(e->known[4], 0);
    static const double WEDGES[] = {0.5, 1, 1, 1}, PART[] = {1, 1, 0.8, 0.2};
    for (int i = 0; i < 4; i++) {
        ck_assert_int_eq(e->surface[i], r.hull);
        assert_relative(e->wedges[i], WEDGES[i], i == 0 ? 0.1 : 1e-6);
        assert_absolute(e->part[i], PART[i], 1e-12);
        ck_assert(e->strip[i] == 0 && e->strip_bears[i] == 0);
        ck_assert_int_eq(e->known[i], 1);
        ck_assert_int_eq(e->over[i], i == 1);
        assert_relative(e->own[i], -2e4, 1e-9); /* each its own, not that of the whole load */
        assert_relative(e->rise[i], -2e-3, 1e-9);
    }
    ck_assert_int_eq(fracture_rig_break(&r), 0);
    ck_assert_int_eq(e->count, 0);
    r.settings.edges_give = false;
    ck_assert(sheet_load(&r, (vec2){15, 0}, 2e4, 0.3));
    fracture_rig_break(&r);
    ck_assert_int_eq(e->count, 0);
    fracture_rig_free(&r);
}
END_TEST

/* What is left after a break is other ice than what was looked at; what holds elsewhere is as it was. */
START_TEST(broken_ice_is_not_known)
{
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.edges_give = true;
    sheet_make(&r, (box2){{0, 0}, {90, 60}}, 30, NULL);
    double bears = fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, 0.2, EDGE_STRAIGHT).wedge_capacity;
    for (int i = 0; i < 3; i++) {
        ck_assert(sheet_load(&r, (vec2){15 + 30 * i, 0}, (i == 1 ? 1.05 : 0.9) * bears, 0.2));
        r.patches.data[i].over = true;
    }
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    const edge_support_table *e = &r.supports;
    ck_assert_int_eq(e->count, 3);
    for (int i = 0; i < 3; i++) {
        ck_assert_int_eq(e->known[i], i != 1);
        ck_assert_int_eq(e->over[i], i != 1);
    }
    fracture_rig_free(&r);
}
END_TEST

TEST_MAIN("edge_give", balance, friction_bears_a_part, stiffness_of_an_edge, what_does_not_give, flat_face,
          large_deflections, seams, many_seams, less_ice, no_more_than_breaks_it, breaking_load, kept_by_fracture,
          broken_ice_is_not_known)
