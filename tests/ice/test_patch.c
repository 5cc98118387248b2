/* Patches by shortcuts and in batches, against the plain loops that they stand for. */
#include "base/random.h"
#include "geometry/outlines.h"
#include "ice/patch_parts.h"
#include "ice/prism_surfaces.h"
#include "ice_rig.h"

enum { LINES = 64 };

static const vec2 ANGLE[] = {{-3, -2}, {3, -2}, {3, 0}, {0, 0}, {0, 2}, {-3, 2}};

static int32_t add_prism(ice_rig *r, const vec2 *outline, int32_t count, double half_height)
{
    int32_t row = -1;
    fram_error e = {0};
    assert_ok(shape_add_prism(&r->ctx, &r->shapes, r->plane, (polygon){outline, count}, half_height, 0, &row, &e), e);
    return row;
}

static void draw_regular(vec2 *v, int32_t count, double radius)
{
    for (int32_t i = 0; i < count; i++)
        v[i] = (vec2){radius * real_cos(2 * PI * i / count), radius * real_sin(2 * PI * i / count)};
}

static vec3 draw_vec3(random_stream *draw, double x, double y, double z)
{
    return (vec3){random_uniform(draw, -x, x), random_uniform(draw, -y, y), random_uniform(draw, -z, z)};
}

START_TEST(codes_say_where_points_lie)
{
    ice_rig r;
    ice_rig_make(&r, 0.1);
    random_stream draw = random_begin(31, 0, 0);
    const double margin = 0.1;
    for (int32_t n = 3; n <= PIECE_MOST_VERTICES; n++) {
        vec2 ring[PIECE_MOST_VERTICES];
        draw_regular(ring, n, 2);
        patch_floe floe = {&r.shapes, add_prism(&r, ring, n, 1)};
        piece_sides piece = sides_of(&floe, 0);
        vec3 point[20];
        uint32_t code[20];
        for (int i = 0; i < 20; i++)
            point[i] = draw_vec3(&draw, 3, 3, 1);
        for (isa set = ISA_BASELINE; set <= isa_best(); set++) {
            r.ctx.isa = set;
            KERNEL_PICK(&r.ctx, patch_codes)(&piece, margin, point, 20, code);
            for (int i = 0; i < 20; i++)
                for (int32_t k = 0; k < PATCH_INSIDE; k++) {
                    half_space side = piece_side(&piece, k < n ? k : 0);
                    double d = vec3_dot(side.n, point[i]) - side.d;
                    ck_assert_uint_eq(code[i] >> k & 1u, k < n && d > margin);
                    ck_assert_uint_eq(code[i] >> (PATCH_INSIDE + k) & 1u, k >= n || d < -margin);
                }
        }
    }
    ice_rig_free(&r);
}
END_TEST

/* ---- ways out ---- */

static void plain_cut(double room, double rate, double *lo, double *hi)
{
    if (rate > 0)
        *hi = fmin(room / rate, *hi);
    else if (rate < 0)
        *lo = fmax(room / rate, *lo);
    else if (room < 0)
        *hi = -HUGE_VAL;
}

static double plain_way(const patch_floe *floe, vec3 point, vec3 direction)
{
    double tolerance = tolerance_of(floe), half_height = half_height_of(floe), way = 0;
    for (bool further = true; further;) {
        further = false;
        for (int32_t p = 0; p < piece_count_of(floe); p++) {
            piece_sides piece = sides_of(floe, p);
            double lo = -HUGE_VAL, hi = HUGE_VAL;
            plain_cut(half_height - point.z, direction.z, &lo, &hi);
            plain_cut(half_height + point.z, -direction.z, &lo, &hi);
            for (int32_t k = 0; k < piece.count; k++) {
                vec2 n = piece.normal[k], v = piece.vertex[k];
                plain_cut(n.x * (v.x - point.x) + n.y * (v.y - point.y), n.x * direction.x + n.y * direction.y, &lo,
                          &hi);
            }
            if (lo <= way + tolerance && hi > way + tolerance) {
                way = hi;
                further = true;
            }
        }
    }
    return way;
}

/* Starts inside, outside and on faces; directions askew, level and upright. */
static void draw_line(random_stream *draw, int i, vec3 *start, vec3 *direction)
{
    *start = draw_vec3(draw, 3.5, 2.5, 1.2);
    *direction = vec3_unit(draw_vec3(draw, 1, 1, 1));
    if (i % 4 == 1)
        *direction = (vec3){0, 0, i % 8 < 4 ? 1 : -1};
    if (i % 4 == 2)
        *direction = (vec3){i % 8 < 4 ? 1 : -1, 0, 0};
    if (i % 8 == 3)
        start->z = 1;
}

START_TEST(ways_equal_the_plain_loops)
{
    ice_rig r;
    ice_rig_make(&r, 0.1);
    random_stream draw = random_begin(32, 0, 0);
    vec2 ring[13];
    draw_regular(ring, 13, 3);
    vec2 star[90];
    outline_star(&draw, (vec2){0, 0}, 1.4, 3, 90, star);
    const patch_floe floes[] = {{&r.shapes, add_prism(&r, ANGLE, 6, 1)},
                                {&r.shapes, add_prism(&r, ring, 13, 1)},
                                {&r.shapes, add_prism(&r, star, 90, 1)}};
    patch_scratch *s = patch_scratch_create(&r.ctx);
    ck_assert_int_gt(piece_count_of(&floes[0]), 1);
    ck_assert_int_gt(piece_count_of(&floes[2]), 30); /* so many that those that a ray passes are picked out */
    int inside = 0;
    for (int i = 0; i < LINES * 8; i++) {
        vec3 start, direction;
        draw_line(&draw, i, &start, &direction);
        for (int k = 0; k < 3; k++) {
            double plain = plain_way(&floes[k], start, direction), way;
            inside += plain > 0;
            for (isa set = ISA_BASELINE; set <= isa_best(); set++) {
                r.ctx.isa = set;
                ck_assert(patch_way_out(&r.ctx, s, &floes[k], start, direction, &way));
                assert_bits(way, plain);
            }
        }
    }
    ck_assert_int_gt(inside, LINES);
    patch_scratch_free(&r.ctx, s);
    ice_rig_free(&r);
}
END_TEST

/* ---- components ---- */

static void expect_same(const patch_component_array *a, const patch_component *b, int32_t count)
{
    ck_assert_int_eq(a->count, count);
    for (int32_t i = 0; i < count; i++) {
        assert_vec3_close(a->data[i].area, b[i].area, 0);
        assert_vec3_close(a->data[i].centre, b[i].centre, 0);
        assert_bits(a->data[i].surface, b[i].surface);
        assert_bits(a->data[i].way, b[i].way);
        assert_bits(a->data[i].spread.xy, b[i].spread.xy);
    }
}

/* Triangles that a tree finds near the floe, and all of them: the same patches to the bit, for every instruction set.
 */
START_TEST(searched_and_whole_surfaces_have_the_same_patches)
{
    enum { SIDES = 48, MOST = 8 };
    ice_rig r;
    ice_rig_make(&r, 0.1);
    random_stream draw = random_begin(33, 0, 0);
    vec2 ring[SIDES];
    draw_regular(ring, SIDES, 2);
    mesh m = {0};
    mesh_adjacency adjacency = {0};
    mesh_bvh tree = {0};
    fram_error e = {0};
    assert_ok(mesh_make_prism(&r.ctx, (polygon){ring, SIDES}, -0.8, 0.8, &m, &e), e);
    assert_ok(mesh_adjacency_build(&r.ctx, &m, &adjacency), e);
    assert_ok(mesh_bvh_build(&r.ctx, &m, &tree), e);
    patch_floe floe = {&r.shapes, add_prism(&r, ANGLE, 6, 1)};
    patch_scratch *s = patch_scratch_create(&r.ctx);
    int found = 0;
    for (int i = 0; i < 200; i++) {
        patch_surface surface = {.surface = &m, .adjacency = &adjacency, .tree = &tree, .prism = -1};
        surface.offset = draw_vec3(&draw, 4.5, 3.5, 1.5);
        vec3 turn = draw_vec3(&draw, 0.5, 0.5, 3);
        surface.rotation = quat_matrix(quat_from_roll_pitch_yaw(turn.x, turn.y, turn.z));
        const patch_component_array *out;
        patch_component first[MOST];
        r.ctx.isa = ISA_BASELINE;
        ck_assert(patch_components(&r.ctx, s, &surface, &floe, &out));
        int32_t count = out->count;
        ck_assert_int_le(count, MOST);
        for (int32_t k = 0; k < count; k++)
            first[k] = out->data[k];
        found += count;
        for (isa set = ISA_BASELINE; set <= isa_best(); set++) {
            r.ctx.isa = set;
            surface.tree = set == ISA_BASELINE ? NULL : &tree;
            ck_assert(patch_components(&r.ctx, s, &surface, &floe, &out));
            expect_same(out, first, count);
        }
    }
    ck_assert_int_gt(found, 50);
    patch_scratch_free(&r.ctx, s);
    mesh_free(&r.ctx, &m);
    mesh_adjacency_free(&r.ctx, &adjacency);
    mesh_bvh_free(&r.ctx, &tree);
    ice_rig_free(&r);
}
END_TEST

/* ---- faces ---- */

/* Every edge belongs to two faces that run along it in opposite directions and know each other; faces turn left, and
   their area vectors cancel. */
static void expect_closed(const mesh *m, const prism_faces *f)
{
    vec3 sum = {0, 0, 0};
    for (int32_t face = 0; face < prism_faces_count(f); face++) {
        int32_t first = f->first.data[face], count = f->first.data[face + 1] - first, shared = 0;
        const int32_t *v = f->corner.data + first;
        vec3 area = {0, 0, 0};
        ck_assert_int_ge(count, 3);
        ck_assert_int_le(count, PRISM_FACE_MOST_CORNERS);
        for (int32_t i = 0; i < count; i++) {
            int32_t from = v[i], to = v[(i + 1) % count], across = f->neighbour.data[first + i];
            ck_assert_int_ge(across, 0);
            shared = 0;
            for (int32_t k = f->first.data[across]; k < f->first.data[across + 1]; k++) {
                int32_t next = k + 1 < f->first.data[across + 1] ? k + 1 : f->first.data[across];
                shared += f->corner.data[k] == to && f->corner.data[next] == from && f->neighbour.data[k] == face;
            }
            ck_assert_int_eq(shared, 1);
            area = vec3_add(area, vec3_cross(m->vertex.data[from], m->vertex.data[to]));
        }
        for (int32_t i = 0; i < count; i++) {
            vec3 a = m->vertex.data[v[i]], b = m->vertex.data[v[(i + 1) % count]];
            vec3 c = m->vertex.data[v[(i + 2) % count]];
            ck_assert_double_ge(vec3_dot(vec3_cross(vec3_sub(b, a), vec3_sub(c, b)), area), 0);
        }
        sum = vec3_add(sum, area);
    }
    ck_assert_double_lt(vec3_length(sum), 1e-12);
}

/* A prism's surface by its triangles and by its faces: the same patches, with fewer parts. */
START_TEST(faces_and_triangles_have_the_same_patches)
{
    enum { SIDES = 7, MANY = 20, MOST = 8 };
    ice_rig r;
    ice_rig_make(&r, 0.1);
    random_stream draw = random_begin(35, 0, 0);
    vec2 ring[SIDES], many[MANY];
    draw_regular(ring, SIDES, 2);
    draw_regular(many, MANY, 2.5);
    const polygon outlines[3] = {{ANGLE, 6}, {ring, SIDES}, {many, MANY}};
    const int32_t lids[3] = {2, 1, 2};
    patch_floe floe = {&r.shapes, add_prism(&r, ANGLE, 6, 1)};
    patch_scratch *s = patch_scratch_create(&r.ctx);
    int found = 0;
    for (int32_t i = 0; i < 300; i++) {
        polygon outline = outlines[i % 3];
        mesh m = {0};
        mesh_adjacency adjacency = {0};
        prism_faces faces = {0};
        fram_error e = {0};
        assert_ok(mesh_make_prism(&r.ctx, outline, -0.8, 0.8, &m, &e), e);
        assert_ok(mesh_adjacency_build(&r.ctx, &m, &adjacency), e);
        ck_assert(prism_faces_make(&r.ctx, &m, &faces));
        ck_assert_int_eq(prism_faces_count(&faces), outline.count + 2 * lids[i % 3]);
        expect_closed(&m, &faces);
        patch_surface surface = {.surface = &m, .adjacency = &adjacency, .prism = -1};
        surface.offset = draw_vec3(&draw, 4.5, 3.5, 1.5);
        vec3 turn = draw_vec3(&draw, 0.5, 0.5, 3);
        surface.rotation = quat_matrix(quat_from_roll_pitch_yaw(turn.x, turn.y, turn.z));
        const patch_component_array *out;
        patch_component first[MOST];
        ck_assert(patch_components(&r.ctx, s, &surface, &floe, &out));
        int32_t count = out->count, parts = s->parts.count;
        ck_assert_int_le(count, MOST);
        for (int32_t k = 0; k < count; k++)
            first[k] = out->data[k];
        surface.faces = &faces;
        ck_assert(patch_components(&r.ctx, s, &surface, &floe, &out));
        ck_assert_int_eq(out->count, count);
        ck_assert_int_le(s->parts.count, parts);
        found += count;
        for (int32_t k = 0; k < count; k++) {
            int32_t same = 0;
            for (int32_t l = 1; l < count; l++)
                if (vec3_length(vec3_sub(first[l].centre, out->data[k].centre)) <
                    vec3_length(vec3_sub(first[same].centre, out->data[k].centre)))
                    same = l;
            assert_vec3_close(out->data[k].area, first[same].area, 1e-12);
            assert_vec3_close(out->data[k].centre, first[same].centre, 1e-12);
            assert_absolute(out->data[k].surface, first[same].surface, 1e-12);
            assert_absolute(out->data[k].spread.xx, first[same].spread.xx, 1e-12);
            assert_absolute(out->data[k].spread.yz, first[same].spread.yz, 1e-12);
        }
        mesh_free(&r.ctx, &m);
        mesh_adjacency_free(&r.ctx, &adjacency);
        prism_faces_free(&r.ctx, &faces);
    }
    ck_assert_int_gt(found, 100);
    patch_scratch_free(&r.ctx, s);
    ice_rig_free(&r);
}
END_TEST

/* The volume under a level lid that sinks into a floe, over its area: exact with one way a part too, and where the lid
   is tilted, since the way is linear over it. */
START_TEST(rough_ways_are_exact_where_they_are_linear)
{
    ice_rig r;
    ice_rig_make(&r, 0.1);
    fram_error e = {0};
    vec2 large[4] = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}, small[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    patch_floe floe = {&r.shapes, add_prism(&r, large, 4, 1)};
    int32_t row = add_prism(&r, small, 4, 4);
    prism_surfaces kept = {0};
    const prism_surface *p;
    assert_ok(prism_surfaces_get(&r.ctx, &kept, &r.shapes, row, &p, &e), e);
    patch_scratch *s = patch_scratch_create(&r.ctx);
    for (int i = 0; i < 2; i++) {
        patch_surface surface = {.surface = &p->surface, .adjacency = &p->adjacency, .faces = &p->faces, .prism = row};
        surface.rough_way = true;
        surface.rotation = quat_matrix(quat_from_roll_pitch_yaw(0, 0.05 * i, 0));
        surface.offset = vec3_add((vec3){0, 0, 0.7}, mat3_mul_vec(surface.rotation, (vec3){0, 0, 4}));
        const patch_component_array *out;
        ck_assert(patch_components(&r.ctx, s, &surface, &floe, &out));
        ck_assert_int_eq(out->count, 1);
        /* Sides cancel when level; tilted by q the lid's way is that of its middle, 0.3 m up, along the normal. */
        if (i == 0)
            assert_absolute(out->data[0].way, 0.3, 1e-12);
        else
            ck_assert(fabs(out->data[0].way - 0.3) < 0.01);
    }
    patch_scratch_free(&r.ctx, s);
    prism_surfaces_free(&r.ctx, &kept);
    ice_rig_free(&r);
}
END_TEST

/* ---- kept surfaces ---- */

/* A row that holds another prism has another surface, though it is the same row; a row as it was keeps its own. */
START_TEST(surfaces_are_kept_while_shapes_stay)
{
    ice_rig r;
    ice_rig_make(&r, 0.1);
    fram_error e = {0};
    prism_surfaces kept = {0};
    const prism_surface *p;
    int32_t row = add_prism(&r, ANGLE, 6, 1);
    assert_ok(prism_surfaces_get(&r.ctx, &kept, &r.shapes, row, &p, &e), e);
    ck_assert_int_eq(p->surface.vertex.count, 12);
    assert_bits(p->surface.vertex.data[0].x, -3);
    p->surface.vertex.data[0].x = 7; /* what is kept is not made anew */
    assert_ok(prism_surfaces_get(&r.ctx, &kept, &r.shapes, row, &p, &e), e);
    assert_bits(p->surface.vertex.data[0].x, 7);
    shape_remove(&r.shapes, row);
    vec2 moved[6];
    for (int i = 0; i < 6; i++)
        moved[i] = (vec2){ANGLE[i].x * (i == 1 || i == 2 ? 1.5 : 1), ANGLE[i].y};
    ck_assert_int_eq(add_prism(&r, moved, 6, 1), row);
    assert_ok(prism_surfaces_get(&r.ctx, &kept, &r.shapes, row, &p, &e), e);
    assert_bits(p->surface.vertex.data[0].x, -3);
    assert_bits(p->surface.vertex.data[1].x, 4.5);
    shape_remove(&r.shapes, row);
    ck_assert_int_eq(add_prism(&r, moved, 6, 2), row);
    assert_ok(prism_surfaces_get(&r.ctx, &kept, &r.shapes, row, &p, &e), e);
    assert_bits(p->surface.vertex.data[0].z, -2);
    prism_surfaces_free(&r.ctx, &kept);
    ice_rig_free(&r);
}
END_TEST

TEST_MAIN("patch", codes_say_where_points_lie, ways_equal_the_plain_loops,
          searched_and_whole_surfaces_have_the_same_patches, faces_and_triangles_have_the_same_patches,
          rough_ways_are_exact_where_they_are_linear, surfaces_are_kept_while_shapes_stay)
