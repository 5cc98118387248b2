/* Crushing patches against areas known in closed form, and what their contacts carry. */
#include "base/random.h"
#include "base/transcendental.h"
#include "ice_rig.h"

/* Somewhere in the world, turned: nothing may depend on the frame. */
static const vec3 PLACE = {100, -50, -0.4};
static const double YAW = 0.7;

/* Moves everything rigidly, so that the floe stands at PLACE, with the given tilt. */
static void place_all(ice_rig *r, double roll, double pitch)
{
    quat q = quat_from_roll_pitch_yaw(roll, pitch, YAW);
    mat3 turn = quat_matrix(q);
    for (int32_t i = 0; i < r->bodies.count; i++) {
        r->bodies.position[i] = vec3_add(PLACE, mat3_mul_vec(turn, r->bodies.position[i]));
        r->bodies.orientation[i] = quat_unit(quat_mul(q, r->bodies.orientation[i]));
    }
}

static vec3 moved(double roll, double pitch, vec3 v)
{
    return vec3_add(PLACE, mat3_mul_vec(quat_matrix(quat_from_roll_pitch_yaw(roll, pitch, YAW)), v));
}

static vec3 turned(double roll, double pitch, vec3 v)
{
    return mat3_mul_vec(quat_matrix(quat_from_roll_pitch_yaw(roll, pitch, YAW)), v);
}

/* Weights sum to one, and the points have the centroid and second moments of the patch. */
static void check_points(const ice_rig *r, const crushing_patch *p)
{
    double weight = 0;
    vec3 centre = {0, 0, 0};
    for (int32_t i = p->contact_first; i < p->contact_first + p->contact_count; i++) {
        const contact *c = &r->contacts.data[i];
        double w = c->impulse_limit / (p->pressure * p->area * r->settings.time_step);
        ck_assert(w > 0);
        weight += w;
        centre = vec3_mad(centre, c->point, w);
        ck_assert_int_eq(c->a, p->floe_body);
        ck_assert_int_eq(c->b, p->surface_body);
        ck_assert_int_eq(r->patches.data + c->patch == p, 1);
        assert_vec3_close(c->normal, p->normal, 0);
        ck_assert(c->depth >= 0);
        for (int32_t k = 0; k < i; k++)
            ck_assert(r->contacts.data[k].key != c->key);
    }
    assert_absolute(weight, 1, 1e-14);
    assert_vec3_close(centre, p->centre, 1e-11 * (1 + vec3_length(p->centre)));
    assert_absolute(vec3_length(p->normal), 1, 1e-14);
}

/* The second moment of the points along a unit direction [m2]. */
static double points_spread(const ice_rig *r, const crushing_patch *p, vec3 direction)
{
    double sum = 0;
    for (int32_t i = p->contact_first; i < p->contact_first + p->contact_count; i++) {
        double d = vec3_dot(vec3_sub(r->contacts.data[i].point, p->centre), direction);
        sum += d * d / p->contact_count;
    }
    return sum;
}

static const crushing_patch *only_patch(const ice_rig *r)
{
    ck_assert_int_eq(r->patches.count, 1);
    check_points(r, &r->patches.data[0]);
    return &r->patches.data[0];
}

/* The floe 10 x 10 x 1, and a box that covers everything beyond x = 5 - overlap. */
static void wall_scene(ice_rig *r, double overlap, double roll, double pitch)
{
    ice_rig_make(r, 0.01);
    int32_t row = ice_rig_plate(r, 10, 10, 1, MOTION_DYNAMIC);
    int32_t wall = ice_rig_box(r, (vec3){0, -40, -30}, (vec3){20, 40, 30}, MOTION_STATIC, MATERIAL_HULL);
    ice_rig_place(r, wall, (vec3){5 - overlap, 0, 0}, 0, 0, 0);
    ice_rig_pair(r, r->floes.body[row], wall);
    place_all(r, roll, pitch);
    ice_rig_crush(r);
}

START_TEST(vertical_wall)
{
    ice_rig r;
    for (int turn = 0; turn < 2; turn++) {
        double roll = turn * 0.3, pitch = turn * -0.2;
        wall_scene(&r, 0.2, roll, pitch);
        const crushing_patch *p = only_patch(&r);
        assert_relative(p->area, 10, 1e-12);
        assert_absolute(p->horizontal_area, 0, 1e-12);
        assert_vec3_close(p->normal, turned(roll, pitch, (vec3){-1, 0, 0}), 1e-13);
        assert_vec3_close(p->centre, moved(roll, pitch, (vec3){4.8, 0, 0}), 1e-11);
        ck_assert_int_eq(p->contact_count, 4);
        assert_relative(points_spread(&r, p, turned(roll, pitch, (vec3){0, 1, 0})), 100.0 / 12, 1e-11);
        assert_relative(points_spread(&r, p, turned(roll, pitch, (vec3){0, 0, 1})), 1.0 / 12, 1e-11);
        for (int i = 0; i < 4; i++) {
            assert_absolute(r.contacts.data[i].depth, 0.2, 1e-12);
            assert_relative(r.contacts.data[i].impulse_limit, 2e6 * 10 * 0.01 / 4, 1e-12);
        }
        ice_rig_free(&r);
    }
}
END_TEST

/* A wall driven to 3 h and further into the floe: the area stays length times thickness, the normal level. */
START_TEST(overlap_over_the_thickness)
{
    for (int i = 0; i <= 40; i++) {
        ice_rig r;
        double overlap = 0.1 * i;
        wall_scene(&r, overlap, 0, 0);
        const crushing_patch *p = only_patch(&r);
        assert_relative(p->area, 10, 1e-12);
        assert_vec3_close(p->normal, turned(0, 0, (vec3){-1, 0, 0}), 1e-13);
        assert_absolute(r.contacts.data[0].depth, overlap, 1e-9);
        ice_rig_free(&r);
    }
}
END_TEST

/* A plate at 45 degrees over the edge, driven `overlap` beyond the top edge.  Downward breaking, or its mirror image.
 */
static void plate_scene(ice_rig *r, double overlap, bool up)
{
    ice_rig_make(r, 0.01);
    int32_t row = ice_rig_plate(r, 10, 10, 1, MOTION_DYNAMIC);
    int32_t plate = ice_rig_box(r, (vec3){0, -40, -60}, (vec3){60, 40, 60}, MOTION_STATIC, MATERIAL_HULL);
    ice_rig_place(r, plate, (vec3){5 - overlap, 0, up ? -0.5 : 0.5}, 0, (up ? -1 : 1) * -PI / 4, 0);
    ice_rig_pair(r, r->floes.body[row], plate);
    place_all(r, 0, 0);
}

START_TEST(inclined_plate)
{
    for (int turn = 0; turn < 2; turn++) {
        ice_rig r;
        bool up = turn == 1;
        double sign = up ? 1 : -1, root = sqrt(0.5);
        /* The plate leaves through the side. */
        plate_scene(&r, 0.3, up);
        ice_rig_crush(&r);
        const crushing_patch *p = only_patch(&r);
        assert_relative(p->area, 10 * 0.3 / root, 1e-11);
        assert_relative(p->horizontal_area, 10 * 0.3, 1e-11);
        assert_vec3_close(p->normal, turned(0, 0, (vec3){-root, 0, sign * root}), 1e-12);
        assert_vec3_close(p->centre, moved(0, 0, (vec3){4.85, 0, -sign * 0.35}), 1e-11);
        for (int i = 0; i < p->contact_count; i++)
            assert_absolute(r.contacts.data[i].depth, 0.3 * root, 0.15);
        ice_rig_free(&r);
        /* It comes out at the other face. */
        plate_scene(&r, 1.5, up);
        ice_rig_crush(&r);
        p = only_patch(&r);
        assert_relative(p->area, 10 / root, 1e-11);
        assert_relative(p->horizontal_area, 10, 1e-11);
        assert_vec3_close(p->centre, moved(0, 0, (vec3){4, 0, 0}), 1e-11);
        ice_rig_free(&r);
    }
}
END_TEST

/* The corner of a floe against a flat wall: area 2 h delta. */
START_TEST(corner)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    int32_t row = ice_rig_plate(&r, 10, 10, 0.8, MOTION_DYNAMIC);
    int32_t slot = r.floes.body[row];
    ice_rig_place(&r, slot, (vec3){0, 0, 0}, 0, 0, PI / 4);
    int32_t wall = ice_rig_box(&r, (vec3){0, -40, -30}, (vec3){20, 40, 30}, MOTION_STATIC, MATERIAL_WALL);
    ice_rig_place(&r, wall, (vec3){sqrt(50) - 0.05, 0, 0}, 0, 0, 0);
    ice_rig_pair(&r, slot, wall);
    place_all(&r, 0, 0);
    ice_rig_crush(&r);
    const crushing_patch *p = only_patch(&r);
    assert_relative(p->area, 2 * 0.8 * 0.05, 1e-9);
    assert_vec3_close(p->normal, turned(0, 0, (vec3){-1, 0, 0}), 1e-12);
    ck_assert(!r.contacts.data[0].correct);
    ice_rig_free(&r);
}
END_TEST

/* A floe that tilts against a vertical wall: the cut is longer than the thickness, its horizontal area no longer zero.
 */
START_TEST(tilted_floe)
{
    ice_rig r;
    double tilt = 0.25;
    ice_rig_make(&r, 0.01);
    int32_t row = ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC), slot = r.floes.body[row];
    ice_rig_place(&r, slot, (vec3){0, 0, 0}, 0, tilt, 0);
    int32_t wall = ice_rig_box(&r, (vec3){0, -40, -30}, (vec3){20, 40, 30}, MOTION_STATIC, MATERIAL_HULL);
    ice_rig_place(&r, wall, (vec3){3.5, 0, 0}, 0, 0, 0);
    ice_rig_pair(&r, slot, wall);
    ice_rig_crush(&r);
    const crushing_patch *p = only_patch(&r);
    assert_relative(p->area, 10 / real_cos(tilt), 1e-12);
    assert_relative(p->horizontal_area, 10 * real_tan(tilt), 1e-12);
    assert_vec3_close(p->normal, ((vec3){-1, 0, 0}), 1e-13);
    ice_rig_free(&r);
}
END_TEST

/* A floe held under a flat bottom: wholly under it, under its edge, and a bottom smaller than the floe. */
START_TEST(flat_bottom)
{
    static const double side[3] = {40, 10, 4}, shift[3] = {0, 5, 0}, area[3] = {100, 50, 16};
    for (int i = 0; i < 3; i++) {
        ice_rig r;
        ice_rig_make(&r, 0.01);
        int32_t row = ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC);
        double b = side[i] / 2;
        int32_t hull = ice_rig_box(&r, (vec3){-b, -b, 0}, (vec3){b, b, 20}, MOTION_STATIC, MATERIAL_HULL);
        ice_rig_place(&r, hull, (vec3){shift[i], 0, 0.4}, 0, 0, 0);
        ice_rig_pair(&r, r.floes.body[row], hull);
        place_all(&r, 0.1, 0.2);
        ice_rig_crush(&r);
        const crushing_patch *p = only_patch(&r);
        if (i != 1) {
            assert_relative(p->area, area[i], 1e-12);
            assert_relative(p->horizontal_area, area[i], 1e-12);
            assert_vec3_close(p->normal, turned(0.1, 0.2, (vec3){0, 0, -1}), 1e-12);
        } else {
            /* Bottom and one side of the hull in one component. */
            assert_relative(p->horizontal_area, area[i], 1e-12);
            assert_relative(p->area, sqrt(area[i] * area[i] + 1), 1e-12);
        }
        for (int32_t k = 0; i == 0 && k < p->contact_count; k++)
            assert_absolute(r.contacts.data[k].depth, 0.1, 1e-12);
        ice_rig_free(&r);
    }
}
END_TEST

/* The bow in the edge of a floe 20 x 20 x 1, floe cut into n x n pieces, mesh refined. */
static crushing_patch bow_patch(int pieces, int refined, vec3 *force_moment)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    int32_t row = ice_rig_plate(&r, 20, 20, 1, MOTION_DYNAMIC);
    mesh m = {0};
    ice_rig_bow(&r.ctx, &m);
    ice_rig_refine(&r.ctx, &m, refined);
    int32_t hull = ice_rig_hull(&r, &m, MOTION_PRESCRIBED, MATERIAL_HULL);
    ice_rig_place(&r, hull, (vec3){-6.5, 2.2, 2.1}, 0.03, 0.02, 0.04);
    ice_rig_pair(&r, r.floes.body[row], hull);
    if (pieces > 1)
        ice_rig_cut(&r, r.bodies.shape[r.floes.body[row]], pieces);
    ice_rig_crush(&r);
    crushing_patch p = *only_patch(&r);
    /* Moment of the capped forces about the floe, and about a far point through the second moments. */
    *force_moment = (vec3){0, 0, 0};
    for (int32_t i = 0; i < r.contacts.count; i++) {
        const contact *c = &r.contacts.data[i];
        vec3 f = vec3_scale(c->normal, c->impulse_limit / 0.01);
        *force_moment = vec3_add(*force_moment, vec3_cross(c->point, f));
    }
    ice_rig_free(&r);
    return p;
}

START_TEST(independent_of_cuts)
{
    vec3 moment, other_moment;
    crushing_patch p = bow_patch(1, 0, &moment);
    ck_assert(p.area > 1 && p.horizontal_area > 0.1 && p.normal.x > 0.3 && p.normal.z < -0.1);
    /* 4, 16 and 49 pieces of the floe; 4, 16 and 64 triangles for each of the hull's. */
    static const int cuts[6][2] = {{2, 0}, {4, 0}, {1, 2}, {1, 3}, {4, 3}, {7, 1}};
    for (int i = 0; i < 6; i++) {
        crushing_patch q = bow_patch(cuts[i][0], cuts[i][1], &other_moment);
        assert_relative(q.area, p.area, 1e-9);
        assert_relative(q.horizontal_area, p.horizontal_area, 1e-9);
        assert_vec3_close(q.normal, p.normal, 1e-9);
        assert_vec3_close(q.centre, p.centre, 1e-9);
        assert_vec3_close(other_moment, moment, 1e-9 * vec3_length(moment));
        ck_assert_int_eq(q.contact_count, p.contact_count);
    }
}
END_TEST

/* A box in any pose against a floe in any pose: cutting the floe and refining the box change nothing, and the two
   surfaces inside each other close the common body: their area vectors cancel. */
START_TEST(random_poses)
{
    int patches = 0;
    for (uint32_t i = 0; i < 300; i++) {
        random_stream s = random_begin(5, 0, i);
        double angle[6];
        for (int k = 0; k < 6; k++)
            angle[k] = random_uniform(&s, -0.5, 0.5) * (k % 3 == 2 ? 6 : 1);
        vec3 half = {random_uniform(&s, 0.3, 6), random_uniform(&s, 0.3, 6), random_uniform(&s, 0.3, 3)};
        vec3 at = {random_uniform(&s, -7, 7), random_uniform(&s, -7, 7), random_uniform(&s, -2, 2)};
        crushing_patch_array seen[3] = {{.count = 0}, {.count = 0}, {.count = 0}};
        vec3 sum[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
        ice_rig r[3];
        for (int turn = 0; turn < 3; turn++) {
            ice_rig_make(&r[turn], 0.01);
            int32_t row = ice_rig_plate(&r[turn], 10, 6, 1, MOTION_DYNAMIC), slot = r[turn].floes.body[row], other;
            ice_rig_place(&r[turn], slot, (vec3){0, 0, 0}, angle[0], angle[1], angle[2]);
            if (turn < 2) {
                mesh m = {0};
                ck_assert(mesh_make_box(&r[turn].ctx, vec3_neg(half), half, &m));
                ice_rig_refine(&r[turn].ctx, &m, 2 * turn);
                other = ice_rig_hull(&r[turn], &m, MOTION_STATIC, MATERIAL_HULL);
                if (turn == 1)
                    ice_rig_cut(&r[turn], r[turn].bodies.shape[slot], 3);
            } else {
                /* The box as the floe, the plate as what cuts into it. */
                row = ice_rig_plate(&r[turn], 2 * half.x, 2 * half.y, 2 * half.z, MOTION_DYNAMIC);
                other = r[turn].floes.body[row];
                r[turn].bodies.material[slot] = MATERIAL_WALL;
            }
            ice_rig_place(&r[turn], other, at, angle[3], angle[4], angle[5]);
            ice_rig_pair(&r[turn], slot, other);
            ice_rig_crush(&r[turn]);
            for (int32_t k = 0; k < r[turn].patches.count; k++) {
                const crushing_patch *p = &r[turn].patches.data[k];
                check_points(&r[turn], p);
                sum[turn] = vec3_mad(sum[turn], p->normal, p->area);
            }
            seen[turn].count = r[turn].patches.count;
            seen[turn].data = r[turn].patches.data;
        }
        patches += seen[0].count;
        ck_assert_int_eq(seen[1].count, seen[0].count);
        bool buried = seen[0].count == 1 && seen[0].data[0].contact_count == 1;
        bool closed = seen[0].count == 0 || seen[2].count == 0;
        for (int32_t k = 0; k < seen[0].count; k++) {
            const crushing_patch *p = &seen[0].data[k], *q = &seen[1].data[k];
            assert_relative(q->area, p->area, 1e-9);
            assert_absolute(q->horizontal_area, p->horizontal_area, 1e-9);
            assert_vec3_close(q->normal, p->normal, 1e-8);
            assert_vec3_close(q->centre, p->centre, 1e-8);
        }
        if (!buried && !closed)
            assert_vec3_close(sum[2], vec3_neg(sum[0]), 1e-9);
        for (int turn = 0; turn < 3; turn++)
            ice_rig_free(&r[turn]);
    }
    ck_assert_int_gt(patches, 100);
}
END_TEST

/* A surface that lies on the seams of the pieces counts once, whatever the rounding of its pose. */
START_TEST(surface_on_a_seam)
{
    for (int i = 0; i < 24; i++) {
        ice_rig r;
        ice_rig_make(&r, 0.01);
        int32_t row = ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC);
        ice_rig_cut(&r, r.bodies.shape[r.floes.body[row]], 4);
        int32_t wall = ice_rig_box(&r, (vec3){0, -40, -30}, (vec3){20, 40, 30}, MOTION_STATIC, MATERIAL_HULL);
        ice_rig_place(&r, wall, (vec3){i % 2 ? 0 : 2.5, 0, 0}, 0, 0, 0);
        ice_rig_pair(&r, r.floes.body[row], wall);
        quat q = quat_from_roll_pitch_yaw(0.01 * i, -0.02 * i, 0.3 * i);
        for (int32_t k = 0; k < 2; k++) {
            r.bodies.position[k] =
                vec3_add((vec3){7.1 * i, -3.3, 0.1}, mat3_mul_vec(quat_matrix(q), r.bodies.position[k]));
            r.bodies.orientation[k] = q;
        }
        ice_rig_crush(&r);
        const crushing_patch *p = only_patch(&r);
        assert_relative(p->area, 10, 1e-9);
        assert_absolute(r.contacts.data[0].depth, i % 2 ? 5 : 2.5, 1e-9);
        ice_rig_free(&r);
    }
}
END_TEST

/* Surfaces that push nowhere: a box wholly inside the floe, and a pile through it. */
START_TEST(closed_patches)
{
    for (int i = 0; i < 2; i++) {
        ice_rig r;
        ice_rig_make(&r, 0.01);
        int32_t row = ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC);
        double b = i == 0 ? 0.2 : 5;
        int32_t hull = ice_rig_box(&r, (vec3){-0.2, -0.2, -b}, (vec3){0.2, 0.2, b}, MOTION_STATIC, MATERIAL_HULL);
        ice_rig_pair(&r, r.floes.body[row], hull);
        ice_rig_place(&r, hull, (vec3){1, 2, 0.05}, 0.2, 0.1, 0.4);
        place_all(&r, 0.3, 0.1);
        ice_rig_crush(&r);
        ck_assert_int_eq(r.patches.count, 0);
        ck_assert_int_eq(r.contacts.count, 0);
        ice_rig_free(&r);
    }
}
END_TEST

/* Two legs of one hull make two patches, numbered by their least triangle; so do the two arms of one concave floe
   against one face. */
START_TEST(several_patches)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    int32_t row = ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC);
    mesh legs = {0}, box = {0};
    for (int i = 0; i < 2; i++) {
        double y = i == 0 ? 3 : -3;
        ck_assert(mesh_make_box(&r.ctx, (vec3){4.5, y - 1, -5}, (vec3){9, y + 1 + i, 5}, &box));
        int32_t first = legs.vertex.count;
        for (int32_t v = 0; v < box.vertex.count; v++)
            ck_assert(mesh_add_vertex(&r.ctx, &legs, box.vertex.data[v]));
        for (int32_t f = 0; f < box.face.count; f++) {
            const int32_t *v = box.face.data[f].v;
            ck_assert(mesh_add_triangle(&r.ctx, &legs, first + v[0], first + v[1], first + v[2]));
        }
        mesh_clear(&box);
    }
    mesh_free(&r.ctx, &box);
    int32_t hull = ice_rig_hull(&r, &legs, MOTION_STATIC, MATERIAL_HULL);
    ice_rig_pair(&r, r.floes.body[row], hull);
    ice_rig_crush(&r);
    ck_assert_int_eq(r.patches.count, 2);
    for (int i = 0; i < 2; i++) {
        const crushing_patch *p = &r.patches.data[i];
        check_points(&r, p);
        ck_assert_int_eq(p->component, i);
        /* The sides of a leg cancel: what counts is its front. */
        assert_relative(p->area, i == 0 ? 2 : 3, 1e-12);
        assert_vec3_close(p->normal, ((vec3){-1, 0, 0}), 1e-13);
        ck_assert(i == 0 ? p->centre.y > 2 : p->centre.y < -2);
    }
    ck_assert_int_eq(r.contacts.count, 8);
    ice_rig_free(&r);

    ice_rig_make(&r, 0.01);
    vec2 fork[8] = {{-5, -5}, {5, -5}, {5, -2}, {-2, -2}, {-2, 2}, {5, 2}, {5, 5}, {-5, 5}};
    row = ice_rig_floe(&r, (polygon){fork, 8}, 1, MOTION_DYNAMIC);
    ck_assert_int_gt(r.shapes.shapes.piece_count[r.bodies.shape[0]], 1);
    int32_t wall = ice_rig_box(&r, (vec3){4, -40, -30}, (vec3){20, 40, 30}, MOTION_STATIC, MATERIAL_HULL);
    ice_rig_pair(&r, r.floes.body[row], wall);
    ice_rig_crush(&r);
    ck_assert_int_eq(r.patches.count, 2);
    for (int i = 0; i < 2; i++) {
        assert_relative(r.patches.data[i].area, 3, 1e-12);
        assert_absolute(fabs(r.patches.data[i].centre.y), 3.5, 1e-12);
    }
    /* In the back of the fork the whole floe is cut: one patch. */
    ice_rig_place(&r, wall, (vec3){-7, 0, 0}, 0, 0, 0);
    ice_rig_crush(&r);
    const crushing_patch *p = only_patch(&r);
    assert_relative(p->area, 10, 1e-12);
    /* The way out of the wall is 8 m through the arms and 1 m through the back: on the mean 5.2 m, to the few places
       where it is taken. */
    for (int i = 0; i < p->contact_count; i++)
        assert_absolute(r.contacts.data[i].depth, 5.2, 0.5);
    ice_rig_free(&r);
}
END_TEST

/* A piece that has slipped inside is held against the nearest way out, corrected even though it is breakable. */
START_TEST(slipped_inside)
{
    for (int i = 0; i < 2; i++) {
        ice_rig r;
        ice_rig_make(&r, 0.01);
        int32_t row = ice_rig_plate(&r, 0.5, 0.4, 0.2, MOTION_DYNAMIC), slot = r.floes.body[row], body;
        if (i == 0) {
            body = ice_rig_box(&r, (vec3){-8, -4, -3}, (vec3){8, 4, 3}, MOTION_STATIC, MATERIAL_HULL);
        } else {
            int32_t wall = ice_rig_plate(&r, 16, 8, 6, MOTION_STATIC);
            body = r.floes.body[wall];
            r.bodies.material[body] = MATERIAL_WALL;
        }
        ice_rig_place(&r, slot, (vec3){7, 1, 0.5}, 0, 0, 0);
        ice_rig_pair(&r, slot, body);
        place_all(&r, 0.1, 0.3);
        ice_rig_crush(&r);
        const crushing_patch *p = only_patch(&r);
        assert_relative(p->area, 2 * 0.9 * 0.2, 1e-12);
        assert_bits(p->horizontal_area, 0);
        assert_vec3_close(p->normal, turned(0.1, 0.3, (vec3){1, 0, 0}), 1e-12);
        ck_assert_int_eq(r.contacts.count, 1);
        ck_assert(r.contacts.data[0].correct);
        assert_relative(r.contacts.data[0].depth, 0.2, 1e-12); /* a thickness at most, of 1.25 m */
        /* Beside it: nothing. */
        r.bodies.position[slot] = moved(0.1, 0.3, (vec3){8.5, 1, 0.5});
        ice_rig_crush(&r);
        ck_assert_int_eq(r.patches.count, 0);
        /* It comes free until it meets the surface, where it is not corrected any more: the overlap is crushed. */
        r.bodies.position[slot] = moved(0.1, 0.3, (vec3){7, 1, 0.5});
        for (int step = 0; step < 40; step++)
            ice_rig_step(&r);
        vec3 at = body_to_local(&r.bodies, body, r.bodies.position[slot]);
        ck_assert_msg(at.x > 7.75 && at.x < 8.3, "stands at %g", at.x);
        ice_rig_free(&r);
    }
}
END_TEST

START_TEST(flags)
{
    ice_rig r;
    wall_scene(&r, 0.2, 0, 0);
    ck_assert(!r.contacts.data[0].correct); /* breakable, hull */
    ck_assert(!r.contacts.data[0].crush_infinite);
    r.floes.breakable[0] = 0;
    r.policies.of[MATERIAL_ICE][MATERIAL_HULL] =
        (pair_policy){.friction_static = 0.2, .friction_kinetic = 0.1, .patch = true};
    r.bodies.motion[0] = MOTION_STATIC;
    ice_rig_crush(&r);
    ck_assert(!r.contacts.data[0].correct); /* nor when it cannot break: the overlap is crushed */
    ck_assert(r.contacts.data[0].crush_infinite);
    r.settings.correct_unbreakable = true;
    ice_rig_crush(&r);
    ck_assert(r.contacts.data[0].correct);
    assert_bits(r.contacts.data[0].friction_static, 0.2);
    assert_bits(r.contacts.data[0].friction_kinetic, 0.1);
    r.floes.breakable[0] = 1;
    r.bodies.material[1] = MATERIAL_WALL;
    ice_rig_crush(&r);
    ck_assert(!r.contacts.data[0].correct); /* nor by a wall that crushes */
    /* Patches are appended. */
    fram_error e = {0};
    assert_ok(crushing_contacts(&r.ctx, r.scratch, &r.settings, &r.bodies, &r.shapes, &r.floes, NULL, &r.pairs,
                                &r.patch_pairs, &r.policies, &r.patches, &r.contacts, &e),
              e);
    ck_assert_int_eq(r.patches.count, 2);
    ck_assert_int_eq(r.contacts.count, 8);
    ck_assert_int_eq(r.contacts.data[7].patch, 1);
    ck_assert_int_eq(r.patches.data[1].contact_first, 4);
    /* Too small, and no ice at all. */
    r.settings.smallest_area = 10.5;
    ice_rig_crush(&r);
    ck_assert_int_eq(r.patches.count, 0);
    r.bodies.material[0] = MATERIAL_WALL;
    assert_fails(ice_rig_try(&r, &e), e, FRAM_ERROR_USAGE, "neither is a floe");
    ice_rig_free(&r);
}
END_TEST

/* Where a patch was expected and there is none, the narrow phase has to look again. */
START_TEST(a_patch_that_is_gone)
{
    ice_rig r;
    wall_scene(&r, 0.2, 0, 0);
    r.pairs.clear[0] = PAIR_HAS_PATCH;
    ice_rig_crush(&r);
    ck_assert_int_eq(r.patches.count, 1);
    assert_bits(r.pairs.clear[0], PAIR_HAS_PATCH);
    r.bodies.position[1].x += 5;
    r.bodies.position[0].x -= 5;
    ice_rig_crush(&r);
    ck_assert_int_eq(r.patches.count, 0);
    assert_bits(r.pairs.clear[0], 0);
    r.pairs.clear[0] = 3; /* what else is remembered stays */
    ice_rig_crush(&r);
    assert_bits(r.pairs.clear[0], 3);
    ice_rig_free(&r);
}
END_TEST

/* Keys stay with the points while the wall moves on, and name other contacts after the floe's slot was used again. */
START_TEST(keys)
{
    ice_rig r;
    wall_scene(&r, 0.2, 0, 0);
    uint64_t key[4];
    vec3 point[4];
    for (int i = 0; i < 4; i++) {
        key[i] = r.contacts.data[i].key;
        point[i] = r.contacts.data[i].point;
    }
    r.bodies.position[1] = vec3_add(r.bodies.position[1], (vec3){-0.05, -0.03, 0.02});
    ice_rig_crush(&r);
    for (int i = 0; i < 4; i++) {
        ck_assert(r.contacts.data[i].key == key[i]);
        ck_assert(vec3_length(vec3_sub(r.contacts.data[i].point, point[i])) < 0.1);
    }
    r.bodies.generation[0]++;
    ice_rig_crush(&r);
    for (int i = 0; i < 4; i++)
        ck_assert(r.contacts.data[i].key != key[i]);
    ice_rig_free(&r);
}
END_TEST

START_TEST(pressure_area_law)
{
    ice_rig r;
    wall_scene(&r, 0.2, 0, 0);
    r.floes.material[0].crushing_exponent = -0.1;
    ice_rig_crush(&r);
    assert_relative(r.patches.data[0].pressure, 2e6 * real_pow(10, -0.1), 1e-12);
    assert_relative(r.contacts.data[0].impulse_limit, 2e7 * real_pow(10, -0.1) * 0.01 / 4, 1e-12);
    ice_rig_free(&r);
}
END_TEST

/* The reference's way agrees while the plate leaves through the side, is too large once it has come out below (the cut
   of the top plane goes on growing), and has no value at a vertical side, where ours is kept. */
START_TEST(top_plane_area)
{
    ice_rig r;
    plate_scene(&r, 0.3, false);
    r.settings.top_plane_area = true;
    ice_rig_crush(&r);
    assert_relative(only_patch(&r)->area, 3 * sqrt(2), 1e-11);
    assert_relative(r.patches.data[0].horizontal_area, 3, 1e-11);
    ice_rig_free(&r);
    plate_scene(&r, 1.5, false);
    r.settings.top_plane_area = true;
    ice_rig_crush(&r);
    assert_relative(only_patch(&r)->area, 15 * sqrt(2), 1e-11);
    ice_rig_free(&r);
    wall_scene(&r, 0.2, 0, 0);
    r.settings.top_plane_area = true;
    ice_rig_crush(&r);
    assert_relative(only_patch(&r)->area, 10, 1e-12);
    ice_rig_free(&r);
}
END_TEST

/* Two floes: the same area and opposite normals, whichever counts as the floe; the weaker one's pressure. */
START_TEST(floe_against_floe)
{
    crushing_patch seen[2];
    for (int turn = 0; turn < 2; turn++) {
        ice_rig r;
        ice_rig_make(&r, 0.01);
        vec2 hexagon[6] = {{3, 0}, {1.5, 2.5}, {-1.5, 2.5}, {-3, 0}, {-1.5, -2.5}, {1.5, -2.5}};
        int32_t plate = -1;
        for (int i = 0; i < 2; i++) {
            if (i == turn) {
                plate = ice_rig_plate(&r, 6, 4, 0.8, MOTION_DYNAMIC);
                r.floes.material[plate].crushing_strength = 1.5e6;
            } else {
                int32_t row = ice_rig_floe(&r, (polygon){hexagon, 6}, 1.1, MOTION_DYNAMIC);
                ice_rig_place(&r, r.floes.body[row], (vec3){5.5, 0.8, 0.2}, 0.05, 0.1, 0.4);
            }
        }
        ice_rig_pair(&r, 0, 1);
        ice_rig_crush(&r);
        seen[turn] = *only_patch(&r);
        ck_assert_int_eq(seen[turn].floe_body, 1);
        for (int k = 0; k < r.contacts.count; k++)
            ck_assert(!r.contacts.data[k].correct); /* crushed overlap stays */
        assert_relative(seen[turn].pressure, 1.5e6, 1e-15);
        ice_rig_free(&r);
    }
    assert_relative(seen[0].area, seen[1].area, 1e-10);
    assert_vec3_close(seen[0].normal, vec3_neg(seen[1].normal), 1e-10);
    ck_assert(seen[0].normal.x > 0.5);
}
END_TEST

/* Frames far away: areas of a small patch on a floe of a kilometre. */
START_TEST(large_and_small)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    int32_t row = ice_rig_plate(&r, 1000, 1000, 1, MOTION_STATIC);
    int32_t hull = ice_rig_box(&r, (vec3){0, -2, -30}, (vec3){20, 2, 30}, MOTION_PRESCRIBED, MATERIAL_HULL);
    ice_rig_place(&r, hull, (vec3){500 - 1e-3, 400, 0}, 0, 0, 0);
    ice_rig_pair(&r, r.floes.body[row], hull);
    place_all(&r, 0, 0);
    ice_rig_crush(&r);
    const crushing_patch *p = only_patch(&r);
    assert_relative(p->area, 4, 1e-9);
    assert_absolute(r.contacts.data[0].depth, 1e-3, 1e-6); /* the sides of the hull shift the centroid */
    assert_relative(points_spread(&r, p, turned(0, 0, (vec3){0, 1, 0})), 16.0 / 12, 1e-2);
    ice_rig_free(&r);
}
END_TEST

/* A long low patch gets two points, as far apart as its length of gyration says. */
START_TEST(two_points)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    int32_t row = ice_rig_plate(&r, 10, 10, 0.05, MOTION_DYNAMIC);
    int32_t wall = ice_rig_box(&r, (vec3){0, -40, -30}, (vec3){20, 40, 30}, MOTION_STATIC, MATERIAL_HULL);
    ice_rig_place(&r, wall, (vec3){4.8, 0, 0}, 0, 0, 0);
    ice_rig_pair(&r, r.floes.body[row], wall);
    place_all(&r, 0.1, 0.2);
    ice_rig_crush(&r);
    const crushing_patch *p = only_patch(&r);
    ck_assert_int_eq(p->contact_count, 2);
    vec3 along = vec3_scale(turned(0.1, 0.2, (vec3){0, 1, 0}), sqrt((100 + 0.05 * 0.05) / 12));
    double sign = vec3_dot(vec3_sub(r.contacts.data[0].point, p->centre), along) > 0 ? 1 : -1;
    assert_vec3_close(r.contacts.data[0].point, vec3_mad(p->centre, along, sign), 1e-9);
    assert_vec3_close(r.contacts.data[1].point, vec3_mad(p->centre, along, -sign), 1e-9);
    ice_rig_free(&r);
}
END_TEST

/* The horizontal area of a bottom that lies over the seams of a floe: that of the whole bottom, once. */
START_TEST(horizontal_area_over_a_seam)
{
    for (int pieces = 1; pieces <= 5; pieces++) {
        ice_rig r;
        ice_rig_make(&r, 0.01);
        int32_t row = ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC), slot = r.floes.body[row];
        if (pieces > 1)
            ice_rig_cut(&r, r.bodies.shape[slot], pieces);
        int32_t hull = ice_rig_box(&r, (vec3){-2.5, -1.5, 0}, (vec3){2.5, 1.5, 9}, MOTION_STATIC, MATERIAL_HULL);
        ice_rig_place(&r, hull, (vec3){0.3, -0.2, 0.4}, 0, 0, 0.3);
        ice_rig_pair(&r, slot, hull);
        place_all(&r, 0.1, 0.2);
        ice_rig_crush(&r);
        const crushing_patch *p = only_patch(&r);
        assert_relative(p->horizontal_area, 15, 1e-11);
        assert_relative(p->area, 15, 1e-11);
        assert_absolute(r.contacts.data[0].depth, 0.1, 1e-11);
        /* The points have the second moments of the turned bottom of 5 x 3 m and of 0.1 m of the sides over it, in any
           direction. */
        vec3 along = {real_cos(0.3), real_sin(0.3), 0}, across = {-along.y, along.x, 0};
        vec3 between = vec3_scale(vec3_add(along, across), sqrt(0.5));
        double ends = 0.1 * 3 * 2, sides = 0.1 * 5 * 2, all = 15 + ends + sides;
        double longer = ((15 + sides) * 25 / 12 + ends * 2.5 * 2.5) / all;
        double shorter = ((15 + ends) * 9 / 12 + sides * 1.5 * 1.5) / all;
        assert_relative(points_spread(&r, p, turned(0.1, 0.2, along)), longer, 1e-11);
        assert_relative(points_spread(&r, p, turned(0.1, 0.2, across)), shorter, 1e-11);
        assert_relative(points_spread(&r, p, turned(0.1, 0.2, between)), (longer + shorter) / 2, 1e-11);
        ice_rig_free(&r);
    }
}
END_TEST

static fram_status whole_scene(context ctx)
{
    ice_rig r;
    fram_error e = {0};
    fram_status status = FRAM_ERROR_MEMORY;
    vec2 fork[8] = {{-5, -5}, {5, -5}, {5, -2}, {-2, -2}, {-2, 2}, {5, 2}, {5, 5}, {-5, 5}};
    static const vec2 square[4] = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
    failing_memory *memory = ctx.memory_user;
    long fail_at = memory->fail_at;
    /* The scene itself is made with all the memory there is. */
    memory->fail_at = 0;
    ck_assert(ice_rig_start(&r, ctx, 0.01));
    ice_rig_floe(&r, (polygon){fork, 8}, 1, MOTION_DYNAMIC);
    ice_rig_floe(&r, (polygon){square, 4}, 1, MOTION_DYNAMIC);
    ice_rig_place(&r, 1, (vec3){0, 9.5, 0.1}, 0.1, 0, 0);
    ice_rig_box(&r, (vec3){4, -40, -30}, (vec3){20, 40, 30}, MOTION_STATIC, MATERIAL_HULL);
    ice_rig_pair(&r, 0, 1);
    ice_rig_pair(&r, 0, 2);
    r.settings.top_plane_area = true;
    memory->requests = 0;
    memory->fail_at = fail_at;
    status = ice_rig_try(&r, &e);
    memory->fail_at = 0;
    ice_rig_free(&r);
    return status;
}

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        turn.status = whole_scene(turn.ctx);
        if (!turn.memory.failed)
            ck_assert_int_gt(turn.n, 10);
    }
    for (long n = 1; n <= 2; n++) {
        failing_memory memory;
        context ctx = failing_context(&memory, n);
        ck_assert_ptr_null(crushing_scratch_create(&ctx));
        ck_assert_int_eq(memory.live, 0);
    }
    context ctx;
    context_init(&ctx);
    crushing_scratch_free(&ctx, NULL);
}
END_TEST

TEST_MAIN("crushing", vertical_wall, overlap_over_the_thickness, inclined_plate, corner, tilted_floe, flat_bottom,
          independent_of_cuts, random_poses, surface_on_a_seam, closed_patches, several_patches, slipped_inside, flags,
          keys, two_points, horizontal_area_over_a_seam, pressure_area_law, top_plane_area, floe_against_floe,
          large_and_small, a_patch_that_is_gone, memory_runs_out)
