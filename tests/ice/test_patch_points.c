/* Points of small patches: what they leave of a patch's second moments, and which patches they are for. */
#include "base/random.h"
#include "ice/patch_points.h"
#include "ice_rig.h"

static const double SMALL = 0.02; /* [m] */

static double along(sym3 c, vec3 u) { return vec3_dot(u, sym3_mul_vec(c, u)); }

static sym3 draw_spread(random_stream *draw, vec3 normal)
{
    vec3 t = vec3_unit(vec3_cross(normal, (vec3){0.3, -0.5, 0.2})), b = vec3_cross(normal, t);
    double angle = random_uniform(draw, 0, PI), x = SMALL * real_pow(10, random_uniform(draw, -0.8, 0.8)),
           y = SMALL * real_pow(10, random_uniform(draw, -0.8, 0.8));
    vec3 s = vec3_scale(vec3_add(vec3_scale(t, real_cos(angle)), vec3_scale(b, real_sin(angle))), x);
    vec3 r = vec3_scale(vec3_sub(vec3_scale(b, real_cos(angle)), vec3_scale(t, real_sin(angle))), y);
    return (sym3){s.x * s.x + r.x * r.x, s.y * s.y + r.y * r.y, s.z * s.z + r.z * r.z,
                  s.x * s.y + r.x * r.y, s.x * s.z + r.x * r.z, s.y * s.z + r.y * r.z};
}

/* Ellipses of any size about `small`, none so narrow that it counts as a line: the centroid is kept, no second moment
   is too large, none more than small^2 too small; the numbers of points are those of the lengths. */
START_TEST(second_moments_miss_at_most_the_small_length)
{
    random_stream draw = random_begin(5, 0, 0);
    int seen[PATCH_MOST_POINTS + 1] = {0};
    for (int turn = 0; turn < 3000; turn++) {
        vec3 normal = vec3_unit((vec3){random_normal(&draw), random_normal(&draw), random_normal(&draw)});
        patch_component c = {.centre = {3, -2, 0.5}, .spread = draw_spread(&draw, normal)};
        vec3 point[PATCH_MOST_POINTS], centre = {0, 0, 0};
        int count = patch_points(&c, normal, SMALL, point);
        seen[count]++;
        for (int i = 0; i < count; i++)
            centre = vec3_mad(centre, point[i], 1.0 / count);
        assert_vec3_close(centre, c.centre, 1e-13);
        vec3 t = vec3_unit(vec3_cross(normal, (vec3){0, 0, 1})), b = vec3_cross(normal, t);
        for (int k = 0; k < 16; k++) {
            vec3 u = vec3_add(vec3_scale(t, real_cos(PI * k / 16)), vec3_scale(b, real_sin(PI * k / 16)));
            double sum = 0, wanted = along(c.spread, u), slack = 1e-12 * (c.spread.xx + c.spread.yy + c.spread.zz);
            for (int i = 0; i < count; i++)
                sum += vec3_dot(vec3_sub(point[i], c.centre), u) * vec3_dot(vec3_sub(point[i], c.centre), u) / count;
            ck_assert(sum <= wanted + slack);
            ck_assert(sum >= wanted - SMALL * SMALL - slack);
        }
    }
    ck_assert(seen[1] > 300 && seen[2] > 300 && seen[4] > 300);
}
END_TEST

/* Points in which a body that reaches over a plate of 4 x 4 m by these lengths touches it. */
static int points_of(double over_x, double over_y, bool hull, double small_patch)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    r.settings.small_patch = small_patch;
    int32_t plate = ice_rig_plate(&r, 4, 4, 1, MOTION_DYNAMIC), upper = -1, other = -1;
    if (hull)
        other = ice_rig_box(&r, (vec3){-2, -2, -0.5}, (vec3){2, 2, 0.5}, MOTION_STATIC, MATERIAL_HULL);
    else
        upper = ice_rig_plate(&r, 4, 4, 1, MOTION_DYNAMIC);
    plate = r.floes.body[plate];
    other = hull ? other : r.floes.body[upper];
    ice_rig_place(&r, other, (vec3){4 - over_x, 4 - over_y, 0.999}, 0, 0, 0);
    ice_rig_pair(&r, plate, other);
    ice_rig_crush(&r);
    ck_assert_int_eq(r.patches.count, 1);
    int count = r.patches.data[0].contact_count;
    ice_rig_free(&r);
    return count;
}

/* The radius of a plate is sqrt(8.25) m: 29 mm are small. */
START_TEST(small_patches_of_floes_touch_in_few_points)
{
    ck_assert_int_eq(points_of(1, 2, false, 0.01), 4);
    ck_assert_int_eq(points_of(0.06, 2, false, 0.01), 2);
    ck_assert_int_eq(points_of(0.2, 2, false, 0.01), 4);
    ck_assert_int_eq(points_of(0.06, 0.06, false, 0.01), 1);
    ck_assert_int_eq(points_of(0.06, 0.06, false, 0), 4);
    ck_assert_int_eq(points_of(0.06, 0.06, true, 0.01), 4);
}
END_TEST

TEST_MAIN("patch points", second_moments_miss_at_most_the_small_length, small_patches_of_floes_touch_in_few_points)
