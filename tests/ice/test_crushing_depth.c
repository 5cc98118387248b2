/* The depth of crushing patches over sweeps of poses. */
#include "base/random.h"
#include "base/transcendental.h"
#include "ice_rig.h"

#include <string.h>

typedef struct seen_patch {
    vec3 centre;
    double depth; /* infinite: not to be compared */
} seen_patch;

/* Against the patch at the same place before: their order may change. */
static double depth_change(const seen_patch *now, const seen_patch *before, int32_t count)
{
    const seen_patch *same = &before[0];
    for (int32_t i = 1; i < count; i++)
        if (vec3_length(vec3_sub(before[i].centre, now->centre)) < vec3_length(vec3_sub(same->centre, now->centre)))
            same = &before[i];
    return isfinite(now->depth) && isfinite(same->depth) ? fabs(now->depth - same->depth) : 0;
}

/* Largest change of the depth of a pair over one of many small steps of a random motion, per metre of the way that its
   points go at most.  Patches whose area vectors nearly cancel have no direction to speak of and are left out. */
static double steepest_depth(uint32_t number, int steps)
{
    enum { PATCHES = 8 };
    const double least_share = 0.2;
    random_stream s = random_begin(11, 0, number);
    ice_rig r;
    ice_rig_make(&r, 0.01);
    vec2 ring[6];
    for (int k = 0; k < 6; k++) {
        double angle = (k + random_uniform(&s, -0.3, 0.3)) * PI / 3;
        ring[k] = vec2_make(6 * real_cos(angle), 4 * real_sin(angle));
    }
    int32_t row = ice_rig_floe(&r, (polygon){ring, 6}, 1, MOTION_DYNAMIC), slot = r.floes.body[row], hull;
    mesh m = {0};
    if (number % 2) {
        ice_rig_bow(&r.ctx, &m);
    } else {
        vec3 half = {random_uniform(&s, 0.5, 5), random_uniform(&s, 0.5, 5), random_uniform(&s, 0.3, 3)};
        ck_assert(mesh_make_box(&r.ctx, vec3_neg(half), half, &m));
    }
    ice_rig_refine(&r.ctx, &m, (int)(number % 3));
    double reach = 0;
    for (int32_t i = 0; i < m.vertex.count; i++)
        reach = fmax(reach, vec3_length(m.vertex.data[i]));
    hull = ice_rig_hull(&r, &m, MOTION_PRESCRIBED, MATERIAL_HULL);
    ice_rig_pair(&r, slot, hull);
    double from[6], to[6];
    for (int k = 0; k < 6; k++) {
        double size = k < 2 ? 6 : k == 2 ? 1.5 : k == 5 ? 3 : 0.3;
        from[k] = random_uniform(&s, -size, size) - (number % 2 && k == 0 ? 6 : 0);
        to[k] = from[k] + random_uniform(&s, -1, 1) * (k < 3 ? 1 : 0.2);
    }
    seen_patch before[PATCHES];
    double steepest = 0, way = 0;
    for (int k = 0; k < 6; k++)
        way += fabs(to[k] - from[k]) * (k < 3 ? 1 : reach + 12) / steps;
    int32_t had = -1;
    for (int i = 0; i <= steps; i++) {
        double q[6], t = (double)i / steps;
        for (int k = 0; k < 6; k++)
            q[k] = from[k] + t * (to[k] - from[k]);
        ice_rig_place(&r, hull, (vec3){q[0], q[1], q[2]}, q[3], q[4], q[5]);
        ice_rig_crush(&r);
        seen_patch now[PATCHES];
        ck_assert_int_le(r.patches.count, PATCHES);
        for (int32_t k = 0; k < r.patches.count; k++) {
            const crushing_patch *p = &r.patches.data[k];
            bool directed = p->contact_count > 1 && p->area > least_share * p->surface_area;
            now[k] = (seen_patch){p->centre, directed ? r.contacts.data[p->contact_first].depth : HUGE_VAL};
        }
        if (had == r.patches.count)
            for (int32_t k = 0; k < had; k++)
                steepest = testing_larger(steepest, depth_change(&now[k], before, had) / way);
        had = r.patches.count;
        memcpy(before, now, sizeof before);
    }
    ice_rig_free(&r);
    return steepest;
}

/* Depth is continuous while the bodies are: it never changes by much more than the bodies move.  The bound is what the
   steepest of the motions shows (16 m/m, where a patch turns into another of its sides) and some more; lines along the
   normal from the points of a patch jump by 740. */
START_TEST(depth_is_continuous)
{
    double worst = 0;
    for (uint32_t i = 0; i < 60; i++)
        worst = testing_larger(worst, steepest_depth(i, 1000));
    ck_assert_msg(worst < 20, "depth changes by %g m per metre of way", worst);
    ck_assert_double_gt(worst, 0.1);
}
END_TEST

/* A floe that lies on a flat top is as deep in it as its bottom is under that, its lower ice being the thinner part. */
START_TEST(flat_top)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    int32_t row = ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC);
    int32_t hull = ice_rig_box(&r, (vec3){-20, -20, -20}, (vec3){20, 20, 0}, MOTION_STATIC, MATERIAL_HULL);
    ice_rig_place(&r, hull, (vec3){0, 0, -0.4}, 0, 0, 0);
    ice_rig_pair(&r, r.floes.body[row], hull);
    ice_rig_crush(&r);
    ck_assert_int_eq(r.patches.count, 1);
    const crushing_patch *p = &r.patches.data[0];
    assert_relative(p->area, 100, 1e-12);
    assert_vec3_close(p->normal, ((vec3){0, 0, 1}), 1e-12);
    for (int32_t k = 0; k < p->contact_count; k++)
        assert_absolute(r.contacts.data[k].depth, 0.1, 1e-12);
    ice_rig_free(&r);
}
END_TEST

/* The way out of a floe of many pieces leads through all of them, to each side: a wall that stands 8 m deep in it. */
START_TEST(ways_through_many_pieces)
{
    for (int i = 0; i < 4; i++) {
        ice_rig r;
        ice_rig_make(&r, 0.01);
        int32_t row = ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC);
        ice_rig_cut(&r, r.bodies.shape[r.floes.body[row]], 4);
        int32_t wall = ice_rig_box(&r, (vec3){0, -40, -30}, (vec3){20, 40, 30}, MOTION_STATIC, MATERIAL_HULL);
        double angle = i * PI / 2;
        ice_rig_place(&r, wall, (vec3){-3 * real_cos(angle), -3 * real_sin(angle), 0}, 0, 0, angle);
        ice_rig_pair(&r, r.floes.body[row], wall);
        ice_rig_crush(&r);
        ck_assert_int_eq(r.patches.count, 1);
        const crushing_patch *p = &r.patches.data[0];
        assert_relative(p->area, 10, 1e-9);
        assert_absolute(r.contacts.data[0].depth, 8, 1e-9);
        ice_rig_free(&r);
    }
}
END_TEST

/* Of two floes the one inside is pushed out, whichever has the lower number: up, where it is nearest to a face, or
   aside. */
START_TEST(one_floe_inside_another)
{
    for (int turn = 0; turn < 4; turn++) {
        bool small_first = turn % 2, aside = turn / 2;
        ice_rig r;
        ice_rig_make(&r, 0.01);
        int32_t slot[2];
        for (int i = 0; i < 2; i++) {
            bool is_small = small_first == (i == 0);
            slot[is_small] = is_small ? ice_rig_plate_body(&r, 1, 0.8, 0.3, MOTION_DYNAMIC)
                                      : ice_rig_plate_body(&r, 10, 8, 2, MOTION_STATIC);
        }
        vec3 at = aside ? (vec3){-4.3, 0, 0} : (vec3){-3, 1, 0.6}, out = aside ? (vec3){-1, 0, 0} : (vec3){0, 0, 1};
        ice_rig_place(&r, slot[1], at, 0, 0, 0);
        ice_rig_pair(&r, slot[0], slot[1]);
        ice_rig_crush(&r);
        ck_assert_int_eq(r.patches.count, 1);
        const crushing_patch *p = &r.patches.data[0];
        ck_assert_int_eq(p->floe_body, slot[1]);
        assert_relative(p->area, 2 * 1.8 * 0.3, 1e-12);
        assert_vec3_close(p->normal, out, 1e-12);
        ck_assert_int_eq(r.contacts.count, 1);
        assert_relative(r.contacts.data[0].depth, 0.3, 1e-12);
        ice_rig_free(&r);
    }
}
END_TEST

TEST_MAIN("crushing depth", depth_is_continuous, flat_top, ways_through_many_pieces, one_floe_inside_another)
