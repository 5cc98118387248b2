/* Pieces that share a side are united, whatever rounding did to the ends of it. */
#include "fracture_rig.h"

#include "ice/fracture_parts.h"

enum { CASES = 400 };

/* A place as another cut would have computed it: up to two units in the last place away, in each coordinate. */
static vec2 cut_anew(random_stream *s, vec2 p)
{
    for (int turns = (int)random_uniform(s, 0, 3); turns > 0; turns--) {
        p.x = nextafter(p.x, random_unit(s) < 0.5 ? -HUGE_VAL : HUGE_VAL);
        p.y = nextafter(p.y, random_unit(s) < 0.5 ? -HUGE_VAL : HUGE_VAL);
    }
    return p;
}

static int32_t gather(fracture_rig *r, const vec2 *corner, int32_t count)
{
    polygon_list rings = {0};
    ck_assert(polygon_list_push(&r->ctx, &rings, (polygon){(vec2 *)corner, count}));
    ck_assert(fracture_gather(&r->ctx, r->scratch, &rings, MOTION_DYNAMIC, 0, 0));
    polygon_list_free(&r->ctx, &rings);
    return r->scratch->piece.rows.count - 1;
}

/* A triangle on the edge of a box that is `before` and `after` times as long as the triangle's side at the side's ends,
   not at all where that is 0: are the two united? */
static bool unites(fracture_rig *r, random_stream *s, double before, double after)
{
    double size = random_power_law(s, 0.5, 50, 0), angle = random_uniform(s, 0, 2 * PI);
    vec2 along = {real_cos(angle), real_sin(angle)}, aside = {-along.y * size, along.x * size};
    vec2 p = vec2_scale(along, random_uniform(s, 0, 1e4)), q = vec2_add(p, vec2_scale(along, size));
    vec2 tip = vec2_add(vec2_add(p, vec2_scale(along, size * random_unit(s))), vec2_scale(aside, 0.7));
    vec2 from = before > 0 ? vec2_sub(p, vec2_scale(along, before * size)) : cut_anew(s, p);
    vec2 to = after > 0 ? vec2_add(q, vec2_scale(along, after * size)) : cut_anew(s, q);
    vec2 peak[] = {p, q, tip}, box[] = {vec2_sub(from, aside), vec2_sub(to, aside), to, from};
    int32_t i = gather(r, peak, 3), k = gather(r, box, 4);
    double area = r->scratch->piece.rows.data[i].area + r->scratch->piece.rows.data[k].area;
    bool one;
    ck_assert_int_eq(fracture_unite(&r->ctx, r->scratch, r->plane, i, k, &one, NULL), FRAM_OK);
    if (one)
        ck_assert_double_eq_tol(r->scratch->piece.rows.data[k].area, area, 1e-9 * area);
    return one;
}

static int left_apart(double before, double after)
{
    fracture_rig r;
    fracture_rig_make(&r);
    int apart = 0;
    for (int i = 0; i < CASES; i++) {
        random_stream s = random_begin(31, 1, (uint32_t)i);
        apart += !unites(&r, &s, before, after);
    }
    fracture_rig_free(&r);
    return apart;
}

START_TEST(a_side_with_the_same_ends_but_for_rounding_unites) { ck_assert_int_eq(left_apart(0, 0), 0); }
END_TEST
START_TEST(a_side_that_is_longer_at_one_end_unites) { ck_assert_int_eq(left_apart(0.4, 0), 0); }
END_TEST
START_TEST(a_side_that_is_a_part_of_the_other_unites) { ck_assert_int_eq(left_apart(0.4, 0.7), 0); }
END_TEST

/* A crack that is narrower than rounding ends where the side begins: the corners on both sides of it are not one. */
START_TEST(a_notch_without_width_stays_open)
{
    fracture_rig r;
    fracture_rig_make(&r);
    vec2 box[] = {{0, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0.5, 0.5}, {nextafter(0.5, 0), 1}, {0, 1}};
    vec2 peak[] = {{0.5, 1}, {1, 1}, {0.75, 1.5}};
    int32_t i = gather(&r, peak, 3), k = gather(&r, box, 7);
    bool one;
    ck_assert_int_eq(fracture_unite(&r.ctx, r.scratch, r.plane, i, k, &one, NULL), FRAM_OK);
    ck_assert(one);
    fracture_rig_free(&r);
}
END_TEST

/* What only comes near stays apart, and each keeps its outline. */
START_TEST(pieces_with_a_gap_stay_apart)
{
    fracture_rig r;
    fracture_rig_make(&r);
    vec2 mine[] = {{0, 0}, {1, 0}, {0.5, 1}}, theirs[] = {{0, -1}, {1, -1}, {1, -1e-5}, {0, -1e-5}};
    int32_t i = gather(&r, mine, 3), k = gather(&r, theirs, 4);
    bool one;
    ck_assert_int_eq(fracture_unite(&r.ctx, r.scratch, r.plane, i, k, &one, NULL), FRAM_OK);
    ck_assert(!one);
    ck_assert_int_eq(r.scratch->piece.rows.data[k].ring, k);
    fracture_rig_free(&r);
}
END_TEST

TEST_MAIN("fracture_dust", a_side_with_the_same_ends_but_for_rounding_unites, a_side_that_is_longer_at_one_end_unites,
          a_side_that_is_a_part_of_the_other_unites, a_notch_without_width_stays_open, pieces_with_a_gap_stay_apart)
