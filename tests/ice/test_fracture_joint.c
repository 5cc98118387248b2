/* Loads near each other on the same ice bend its edge together (docs/decisions/0564). */
#include "sheet_rig.h"

/* Ice of 1 m with its edge at y = 0: a sheet of tiles of 400 or 30 m, or a floe that floats. */
typedef enum edge_kind { EDGE_OF_TILE, EDGE_OF_TILES, EDGE_OF_FLOE, EDGE_KINDS } edge_kind;

/* Loads each for itself, together, and together on an edge with inertia: they come in one step of 10 ms. */
typedef enum edge_rules { APART, JOINT, RISING } edge_rules;

static void make_edge(fracture_rig *r, edge_kind kind, edge_rules rules)
{
    fracture_rig_make(r);
    r->settings.splitting = SPLITTING_NONE;
    r->settings.wide_contacts = true;
    r->settings.joint_loads = rules != APART;
    r->settings.edges_give = r->settings.edge_inertia = rules == RISING;
    if (kind == EDGE_OF_FLOE) {
        static const vec2 FLOE[] = {{-150, 0}, {150, 0}, {150, 200}, {-150, 200}};
        ck_assert_int_ge(fracture_rig_floe(r, (polygon){FLOE, 4}, 1, MOTION_DYNAMIC), 0);
    } else {
        sheet_make(r, (box2){{-150, 0}, {150, 200}}, kind == EDGE_OF_TILE ? 400 : 30, NULL);
    }
}

/* A load of 1 N by default on 0.01 m2, 1 cm inside the edge at x, over a width along it; negative: up. */
static void press(fracture_rig *r, edge_kind kind, vec2 at, double load, double width)
{
    if (kind == EDGE_OF_FLOE) {
        vec3 origin = r->bodies.position[r->floes.body[0]];
        ck_assert(fracture_rig_load(r, 0, (vec2){at.x - origin.x, at.y - origin.y}, load, 0.01));
    } else {
        ck_assert(sheet_load(r, at, load, 0.01));
    }
    ck_assert(!(width > 0) || fracture_rig_widen(r, (vec2){width / 2, 0}));
}

typedef struct edge_press {
    double x, load, width;
} edge_press;

static bool breaks(edge_kind kind, edge_rules rules, const edge_press *loads, int count, double part)
{
    fracture_rig r;
    make_edge(&r, kind, rules);
    for (int i = 0; i < count; i++)
        press(&r, kind, (vec2){loads[i].x, 0.01}, part * loads[i].load, loads[i].width);
    int events = fracture_rig_break(&r);
    fracture_rig_free(&r);
    return events > 0;
}

/* By how many times these loads break the edge, to 2e-4. */
static double ratio_of(edge_kind kind, edge_rules rules, const edge_press *loads, int count)
{
    double lo = 0.1, hi = 1;
    ck_assert(breaks(kind, rules, loads, count, hi) && !breaks(kind, rules, loads, count, lo));
    while (hi > lo * (1 + 2e-4)) {
        double part = sqrt(lo * hi);
        *(breaks(kind, rules, loads, count, part) ? &hi : &lo) = part;
    }
    return 1 / hi;
}

/* A load of 20 m, its halves, its thirds and quarters break the ice alike; each alone they bear more. */
START_TEST(parts_are_a_whole)
{
    for (edge_kind kind = 0; kind < EDGE_KINDS; kind++) {
        const edge_press whole = {1, 1e6, 20};
        double together = ratio_of(kind, JOINT, &whole, 1);
        assert_relative(1e6 / together, 550e3, 0.05);
        for (int parts = 2; parts <= 4; parts++) {
            edge_press part[4];
            for (int i = 0; i < parts; i++)
                part[i] = (edge_press){1 + 20 * ((i + 0.5) / parts - 0.5), 1e6 / parts, 20.0 / parts};
            assert_relative(ratio_of(kind, JOINT, part, parts), together, 1e-3);
            if (parts == 2)
                ck_assert_double_lt(ratio_of(kind, APART, part, parts), 0.7 * together);
        }
    }
}
END_TEST

/* So does one of 100 m in halves, whose middles are farther apart than narrow loads are near. */
START_TEST(wide_halves)
{
    for (edge_kind kind = 0; kind < EDGE_KINDS; kind++) {
        const edge_press whole = {0, 2e6, 100}, half[2] = {{-25, 1e6, 50}, {25, 1e6, 50}};
        assert_relative(ratio_of(kind, JOINT, half, 2), ratio_of(kind, JOINT, &whole, 1), 1e-3);
    }
}
END_TEST

/* Two narrow loads P bear 2/(1/A + A/(A + 2 B d)^2), each alone A; beyond three characteristic lengths they are alone.
   One that lifts the edge holds it against the other.  Inertia makes A and B larger alike. */
START_TEST(two_columns)
{
    static const double WAYS[] = {0.5, 2, 5, 10, 20, 40, 60};
    double l = ice_characteristic_length(&FRACTURE_RIG_ICE, 1, 1025, 9.81), strip = 0.5e6 / 6 / (0.4559381 * l);
    for (int turn = 0; turn < 2 * EDGE_KINDS; turn++) {
        edge_kind kind = (edge_kind)(turn / 2);
        edge_rules rules = turn % 2 ? RISING : JOINT;
        const edge_press one = {2, 1e6, 0};
        double bears = 1e6 / ratio_of(kind, rules, &one, 1), at_rest = 1e6 / ratio_of(kind, APART, &one, 1);
        double metre = strip * bears / at_rest;
        if (rules == RISING && kind != EDGE_OF_FLOE)
            ck_assert_double_gt(bears, 1.1 * at_rest);
        else
            assert_relative(bears, at_rest, 1e-12);
        for (int i = 0; i < 7; i++) {
            double d = WAYS[i], at = bears + 2 * metre * d, other = d < 3 * l ? bears / (at * at) : 0;
            const edge_press pair[] = {{2, 1e6, 0}, {2 - d, 1e6, 0}}, apart[] = {{2, 1e6, 0}, {2 - d, -2e5, 0}};
            assert_relative(ratio_of(kind, rules, pair, 2), 1e6 * (1 / bears + other), 2e-3);
            assert_relative(ratio_of(kind, rules, apart, 2), 1e6 / bears - 2e5 * other, 2e-3);
        }
    }
}
END_TEST

/* Around a corner of the floe the way is that along its sides; over a lead there is none. */
START_TEST(as_the_edge_leads)
{
    fracture_rig r;
    double found[4];
    for (int i = 0; i < 4; i++) {
        make_edge(&r, EDGE_OF_FLOE, JOINT);
        if (i != 1)
            press(&r, EDGE_OF_FLOE, (vec2){-143, 0.01}, 1e6, 0);
        if (i > 0)
            press(&r, EDGE_OF_FLOE, (vec2){i < 3 ? -149.99 : -126, i < 3 ? 10 : 0.01}, 1e5, 0);
        fracture_rig_break(&r);
        found[i] = r.events.count ? r.events.data[0].stress_ratio : 0;
        fracture_rig_free(&r);
    }
    /* 17 m around the corner as straight on. */
    ck_assert_double_gt(found[2], found[0] * 1.01);
    assert_relative(found[2], found[3], 1e-3);

    static const vec2 LEAD[4] = {{-1, -1}, {1, -1}, {1, 60}, {-1, 60}};
    for (int i = 0; i < 2; i++) {
        polygon_list openings = {0};
        fracture_rig_make(&r);
        r.settings.joint_loads = true;
        ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){LEAD, 4}));
        sheet_make(&r, (box2){{-60, 0}, {60, 200}}, 30, &openings);
        press(&r, EDGE_OF_TILES, (vec2){-1.01, 10}, 1e6, 0);
        if (i)
            press(&r, EDGE_OF_TILES, (vec2){1.01, 10}, 1e6, 0);
        fracture_rig_break(&r);
        found[i] = r.events.data[0].stress_ratio;
        polygon_list_free(&r.ctx, &openings);
        fracture_rig_free(&r);
    }
    assert_relative(found[1], found[0], 1e-12);
}
END_TEST

/* What a piece presses down, or lifts, beside a hull counts as what a hull does, whichever of both is the floe of the
   patch. */
START_TEST(pieces_beside_a_hull)
{
    static const vec2 PIECE[] = {{-3, -9}, {3, -9}, {3, -4}, {-3, -4}};
    for (edge_kind kind = EDGE_OF_TILE; kind <= EDGE_OF_TILES; kind++) {
        for (int up = 0; up < 2; up++) {
            double ratio[3];
            for (int by = 0; by < 3; by++) {
                fracture_rig r;
                make_edge(&r, kind, JOINT);
                r.settings.under_pieces = true;
                int32_t piece = fracture_rig_floe(&r, (polygon){PIECE, 4}, 1, MOTION_DYNAMIC);
                press(&r, kind, (vec2){2, 0.01}, 1e6, 0);
                press(&r, kind, (vec2){-2, 0.01}, up ? -1e5 : 1e5, 0);
                if (by > 0)
                    fracture_rig_push_by(&r, r.floes.body[piece], by == 2);
                ck_assert_int_ge(fracture_rig_break(&r), 1);
                ratio[by] = r.events.data[0].stress_ratio;
                fracture_rig_free(&r);
            }
            assert_relative(ratio[1], ratio[0], 1e-12);
            assert_relative(ratio[2], ratio[0], 1e-12);
        }
    }
}
END_TEST

/* Loads at the same place of another floe's frame are none of this one's. */
START_TEST(each_floe_by_itself)
{
    static const vec2 FLOE[] = {{-150, 0}, {150, 0}, {150, 200}, {-150, 200}};
    double found[2];
    for (int i = 0; i < 2; i++) {
        fracture_rig r;
        make_edge(&r, EDGE_OF_FLOE, JOINT);
        press(&r, EDGE_OF_FLOE, (vec2){2, 0.01}, 1e6, 0);
        int32_t other = fracture_rig_floe(&r, (polygon){FLOE, 4}, 1, MOTION_DYNAMIC);
        ck_assert_int_ge(other, 0);
        if (i)
            ck_assert(fracture_rig_load(&r, other, (vec2){5, -99.99}, 1e5, 0.01));
        ck_assert_int_eq(fracture_rig_break(&r), 1);
        found[i] = r.events.data[0].stress_ratio;
        fracture_rig_free(&r);
    }
    assert_relative(found[1], found[0], 1e-12);
}
END_TEST

/* The edge breaks under the load that bends it most, as far as that one reaches, not under a slight one at the place
   where the sum is largest. */
START_TEST(under_the_heavier)
{
    for (edge_kind kind = 0; kind < EDGE_KINDS; kind++) {
        double ratio[2];
        for (int slight = 0; slight < 2; slight++) {
            fracture_rig r;
            make_edge(&r, kind, JOINT);
            press(&r, kind, (vec2){-3, 0.01}, 4e5, 10);
            press(&r, kind, (vec2){7, 0.01}, 4e5, 10);
            r.patches.data[0].horizontal_area = r.patches.data[1].horizontal_area = 4;
            if (slight)
                press(&r, kind, (vec2){2, 0.01}, 10, 0);
            ck_assert_int_ge(fracture_rig_break(&r), 1);
            ratio[slight] = r.events.data[0].stress_ratio;
            for (int32_t i = 0; i < r.events.count; i++)
                ck_assert_double_gt(r.events.data[i].load, 1e5);
            fracture_rig_free(&r);
        }
        /* On the slight one's own area the wedges would be 7 % weaker. */
        assert_relative(ratio[1], ratio[0], 1e-3);
    }
}
END_TEST

/* More load breaks no less: a heavier load that itself holds takes over what both make at the place of the slighter. */
START_TEST(no_load_hides_another)
{
    for (edge_kind kind = 0; kind < EDGE_KINDS; kind++) {
        double least = 0;
        for (int i = 0; i < 12; i++) {
            const edge_press pair[] = {{0, 939e3 * (0.6 + 0.03 * i), 50}, {12.5, 313e3 * 0.74, 0}};
            double ratio = ratio_of(kind, JOINT, pair, 2);
            ck_assert_double_gt(ratio, fmax(least, 1.15));
            least = ratio;
        }
    }
}
END_TEST

/* A hole by which tiles are divided does not lengthen the way along the edge. */
START_TEST(cuts_lead_nowhere)
{
    static const vec2 HOLE[] = {{20, 40}, {40, 40}, {40, 60}, {20, 60}};
    static const double SIZES[] = {200, 100, 67, 50, 40, 30};
    for (int corner = 0; corner < 4; corner++) {
        double found[6];
        for (int i = 0; i < 6; i++) {
            fracture_rig r;
            polygon_list openings = {0};
            fracture_rig_make(&r);
            r.settings.joint_loads = true;
            ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){HOLE, 4}));
            sheet_make(&r, (box2){{-60, 0}, {140, 200}}, SIZES[i], &openings);
            vec2 at = HOLE[corner], x = {at.x < 30 ? 1 : -1, 0}, y = {0, at.y < 50 ? 1 : -1};
            press(&r, EDGE_OF_TILES, vec2_sub(vec2_add(at, vec2_scale(x, 1.5)), vec2_scale(y, 0.01)), 1e6, 0);
            press(&r, EDGE_OF_TILES, vec2_sub(vec2_add(at, vec2_scale(y, 1.5)), vec2_scale(x, 0.01)), 1e6, 0);
            ck_assert_int_ge(fracture_rig_break(&r), 1);
            found[i] = r.events.data[0].stress_ratio;
            polygon_list_free(&r.ctx, &openings);
            fracture_rig_free(&r);
            assert_relative(found[i], found[0], 1e-6);
        }
    }
}
END_TEST

/* Many loads of a hull of which each holds break what their sum does, without a limit to how many. */
START_TEST(many_small_ones)
{
    edge_press loads[40];
    for (int i = 0; i < 40; i++)
        loads[i] = (edge_press){0.5 * (i - 19.5), 1e6 / 40, 0};
    const edge_press whole = {0, 1e6, 20};
    for (edge_kind kind = 0; kind < EDGE_KINDS; kind++)
        for (edge_rules rules = JOINT; rules <= RISING; rules++)
            assert_relative(ratio_of(kind, rules, loads, 40), ratio_of(kind, rules, &whole, 1), 0.02);
}
END_TEST

TEST_MAIN("fracture_joint", parts_are_a_whole, wide_halves, two_columns, as_the_edge_leads, pieces_beside_a_hull,
          each_floe_by_itself, under_the_heavier, no_load_hides_another, cuts_lead_nowhere, many_small_ones)
