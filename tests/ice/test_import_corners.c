/* ice/import_corners: rings that touch themselves are cut at common corners into what an overlay makes of them. */
#include "base/random.h"
#include "geometry/polygon_pieces.h"
#include "ice/import_parts.h"
#include "testing.h"

enum { CELLS = 7, CORNERS = CELLS + 1, RING_MOST = 4 * CELLS * CELLS };

/* Corners of a raster's cells, moved a little so that no three lie on a line, and the sides of filled cells that leave
   them to the right, up, left and down, with ice on the left. */
typedef struct raster {
    vec2 place[CORNERS][CORNERS];
    bool leaves[CORNERS][CORNERS][4];
} raster;

static void raster_fill(raster *c, random_stream *random)
{
    bool ice[CELLS + 2][CELLS + 2] = {{false}};
    double part = random_uniform(random, 0.3, 0.8);
    for (int x = 1; x <= CELLS; x++)
        for (int y = 1; y <= CELLS; y++)
            ice[x][y] = random_unit(random) < part;
    for (int x = 0; x < CORNERS; x++)
        for (int y = 0; y < CORNERS; y++) {
            bool here = ice[x + 1][y + 1], left = ice[x][y + 1], under = ice[x + 1][y], across = ice[x][y];
            c->place[x][y] = vec2_make(x + random_uniform(random, -0.2, 0.2), y + random_uniform(random, -0.2, 0.2));
            c->leaves[x][y][0] = here && !under;
            c->leaves[x][y][1] = left && !here;
            c->leaves[x][y][2] = across && !left;
            c->leaves[x][y][3] = under && !across;
        }
}

/* A ring of sides that are left, from a corner on until no more goes from it, either way where there are two. */
static polygon raster_walk(raster *c, random_stream *random, int x, int y, vec2 out[RING_MOST])
{
    int32_t count = 0;
    for (;;) {
        bool *leaves = c->leaves[x][y];
        int first = random_unit(random) < 0.5 ? 0 : 2, way = -1;
        for (int k = 0; k < 4 && way < 0; k++)
            way = leaves[(first + k) % 4] ? (first + k) % 4 : -1;
        if (way < 0)
            return (polygon){out, count};
        leaves[way] = false;
        out[count++] = c->place[x][y];
        x += (way == 0) - (way == 2);
        y += (way == 1) - (way == 3);
    }
}

typedef struct rig {
    context ctx;
    overlay *plane;
    random_stream random;
    raster cells;
    fram_error error;
} rig;

static void rig_open(rig *r, uint64_t seed)
{
    *r = (rig){.random = random_begin(seed, 0, 0)};
    context_init(&r->ctx);
    r->plane = overlay_create(&r->ctx);
    ck_assert_ptr_nonnull(r->plane);
}

/* Where a ring is cut at corners the same outlines come of it, to the bit, as from GEOS.  1: it is, 0: it is not. */
static int check_cut(rig *r, polygon ring)
{
    import_meetings met = {0};
    polygon_list cut = {0}, whole = {0};
    bool done = false;
    if (ring.count > 0)
        assert_ok(import_count_meetings(&r->ctx, ring, &met, &r->error), r->error);
    if (met.corners > 0 && met.elsewhere == 0)
        assert_ok(import_cut_at_corners(&r->ctx, ring, &cut, &done, &r->error), r->error);
    if (done)
        assert_ok(overlay_make_valid(r->plane, ring, &whole, &r->error), r->error);
    ck_assert_int_eq(polygon_list_count(&cut), polygon_list_count(&whole));
    for (int32_t i = 0; i < polygon_list_count(&cut); i++) {
        polygon p = polygon_list_get(&cut, i), q = polygon_list_get(&whole, i);
        ck_assert_int_eq(p.count, q.count);
        ck_assert_mem_eq(p.vertex, q.vertex, (size_t)p.count * sizeof *p.vertex);
    }
    polygon_list_free(&r->ctx, &cut);
    polygon_list_free(&r->ctx, &whole);
    return done;
}

/* Some with holes, some with islands in these, either way round. */
START_TEST(rings_about_cells_are_cut)
{
    enum { RASTERS = 60 };
    rig r;
    rig_open(&r, 75);
    for (int round = 0, cut = 0; round < RASTERS; round++) {
        raster_fill(&r.cells, &r.random);
        for (int i = 0; i < CORNERS * CORNERS; i++) {
            vec2 v[RING_MOST];
            polygon ring = raster_walk(&r.cells, &r.random, i % CORNERS, i / CORNERS, v);
            if (round % 2)
                ring_reverse(v, ring.count);
            int32_t place[RING_MOST];
            vec2 at[RING_MOST];
            bool touches = ring.count > 0 && vertex_places(&r.ctx, v, ring.count, at, place) < ring.count;
            ck_assert_int_eq(check_cut(&r, ring), touches);
            cut += touches;
        }
        ck_assert(round + 1 < RASTERS || cut > RASTERS);
    }
    overlay_free(r.plane);
}
END_TEST

/* Few corners in any order: most rings cross themselves, some at corners alone. */
START_TEST(rings_that_cross_at_corners_are_not_cut)
{
    enum { RINGS = 3000, ACROSS = 3, PLACES = 12, MOST = 9 };
    rig r;
    rig_open(&r, 76);
    int cut = 0;
    for (int round = 0; round < RINGS; round++) {
        vec2 v[MOST];
        int32_t count = 5 + round % (MOST - 4), order[PLACES];
        raster_fill(&r.cells, &r.random);
        random_order(&r.random, order, PLACES);
        for (int32_t i = 0; i < count; i++) {
            /* One of those before it comes again at times, but for the last one and the first. */
            int32_t k = i > 2 && i < count - 1 && random_unit(&r.random) < 0.5 ? order[i - 3] : order[i];
            v[i] = r.cells.place[k % ACROSS][k / ACROSS];
        }
        cut += check_cut(&r, (polygon){v, count});
    }
    ck_assert_int_gt(cut, 0);
    overlay_free(r.plane);
}
END_TEST

/* Ice that touches a floe which a hole touches as well: in the hole it is the floe's, beside the floe another one. */
START_TEST(ice_in_filled_holes_is_no_floe)
{
    static const struct {
        vec2 corner[12];
        int count, floes;
    } row[] = {
        /* at a corner that juts out, in the hole and beside the floe */
        {{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {1, 7}, {7, 7}, {7, 1}, {0, 0}, {3, 2}, {2, 3}}, 11, 1},
        {{{0, 0}, {9, 0}, {9, 1}, {1, 1}, {4, 5}, {6, 4}, {6, 6}, {4, 5}, {0, 9}, {0, 0}, {0.3, 0.8}, {0.8, 0.3}},
         12,
         2},
        /* at a hollow one */
        {{{0, 0}, {9, 0}, {9, 8}, {0, 8}, {6, 4}, {8, 5}, {8, 3}, {6, 4}, {7.5, 3.8}, {7.5, 4.2}, {6, 4}}, 11, 1},
        {{{0, 0}, {9, 0}, {3, 4}, {8, 3.5}, {8, 4.5}, {3, 4}, {9, 8}, {0, 8}, {0, 0}, {1, 3}, {2, 1}}, 11, 2},
        /* at the hole alone */
        {{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {1, 7}, {7, 7}, {4, 4}, {6, 2}, {7, 7}, {7, 1}}, 11, 1},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        rig r;
        polygon_list out = {0};
        bool cut = false;
        rig_open(&r, 0);
        const polygon ring = {row[i].corner, row[i].count};
        ck_assert_int_eq(check_cut(&r, ring), 1);
        assert_ok(import_cut_at_corners(&r.ctx, ring, &out, &cut, &r.error), r.error);
        ck_assert_msg(polygon_list_count(&out) == row[i].floes, "row %zu: %d", i, (int)polygon_list_count(&out));
        polygon_list_free(&r.ctx, &out);
        overlay_free(r.plane);
    }
}
END_TEST

START_TEST(meetings_are_counted_once)
{
    static const struct {
        vec2 corner[7];
        int count, corners, elsewhere;
    } row[] = {
        {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 4, 0, 0},
        {{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, 4, 0, 1},                         /* a bow tie */
        {{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, 5, 0, 1},                 /* a corner on an edge before it */
        {{{4, 4}, {2, 0}, {0, 4}, {0, 0}, {4, 0}}, 5, 0, 1},                 /* and on one behind it */
        {{{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}, 6, 1, 0},         /* two triangles at a corner */
        {{{0, 0}, {4, 0}, {6, 0}, {4, 0}, {4, 4}, {0, 4}}, 6, 1, 0},         /* a spike from a corner */
        {{{0, 0}, {4, 0}, {6, 0}, {5, 0}, {4, 4}, {0, 4}}, 6, 0, 1},         /* one that ends on itself */
        {{{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {1, 4}, {1, 0}}, 7, 1, 1}, /* a corner, and a crossing */
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        rig r;
        import_meetings met;
        rig_open(&r, 0);
        assert_ok(import_count_meetings(&r.ctx, (polygon){row[i].corner, row[i].count}, &met, &r.error), r.error);
        ck_assert_msg(met.corners == row[i].corners && met.elsewhere == row[i].elsewhere, "row %zu: %lld, %lld", i,
                      (long long)met.corners, (long long)met.elsewhere);
        overlay_free(r.plane);
    }
}
END_TEST

/* By what repairs took: neither a large ring with few meetings nor a small one with many is left to minutes. */
START_TEST(long_repairs_are_told_by_meetings_and_corners)
{
    static const struct {
        int count, corners, elsewhere;
        bool often;
    } row[] = {
        {90180, 0, 120, false}, /* a round floe with 60 loops: 1.4 s */
        {90390, 0, 260, false}, /* with 130: 3 s */
        {2000, 0, 1000, false}, /* two zigzags: 6 s */
        {4000, 1000, 2, false}, /* a staircase of cells: 4 s */
        {100000, 0, 400, false}, {100000, 0, 500, true}, {3200, 0, 1600, true}, {3200, 1600, 1, true},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        const import_meetings met = {row[i].corners, row[i].elsewhere};
        ck_assert_msg(import_meets_too_often((polygon){NULL, row[i].count}, &met) == row[i].often, "row %zu", i);
    }
}
END_TEST

/* GEOS has its own memory; Fram's runs out at every request in turn. */
START_TEST(memory_runs_out)
{
    /* A square with a square hole at a corner, in which a triangle lies. */
    static const vec2 v[] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {1, 7}, {7, 7}, {4, 4}, {6, 2}, {7, 7}, {7, 1}};
    const polygon ring = {v, sizeof v / sizeof *v};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        import_meetings met;
        polygon_list out = {0};
        bool cut = false;
        turn.status = import_count_meetings(&turn.ctx, ring, &met, &turn.error);
        if (turn.status == FRAM_OK)
            turn.status = import_cut_at_corners(&turn.ctx, ring, &out, &cut, &turn.error);
        if (turn.status == FRAM_OK) {
            ck_assert(cut && met.corners == 2 && met.elsewhere == 0);
            ck_assert_int_eq(polygon_list_count(&out), 1);
            assert_bits(polygon_area(polygon_list_get(&out, 0)), 81);
        }
        polygon_list_free(&turn.ctx, &out);
    }
}
END_TEST

TEST_MAIN("import_corners", rings_about_cells_are_cut, rings_that_cross_at_corners_are_not_cut,
          ice_in_filled_holes_is_no_floe, meetings_are_counted_once, long_repairs_are_told_by_meetings_and_corners,
          memory_runs_out)
