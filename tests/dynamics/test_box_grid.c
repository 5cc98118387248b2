/* Boxes that are filed and taken out again, against a look at each. */
#include "dynamics/box_grid.h"

#include "base/random.h"
#include "sizes.h"
#include "testing.h"

enum { SLOTS = 400 };

typedef struct meeting {
    const box3 *box;
    box3 around;
    int32_t met[SLOTS];
    int32_t left; /* calls before it says stop, negative: never */
} meeting;

static bool meet(void *user, int32_t other)
{
    meeting *m = user;
    m->met[other]++;
    return m->left < 0 || --m->left > 0;
}

/* Of a crowd whose boxes share cells, so that buckets hold several. */
static box3 crowded_box(random_stream *draw)
{
    vec3 lo = {random_uniform(draw, 0, 12), random_uniform(draw, 0, 12), -1};
    return (box3){lo, {lo.x + random_uniform(draw, 1.1, 1.9), lo.y + 1, 1}};
}
enum { CROWD_GRID = 17 }; /* of boxes between 1 and 2 m */

static box3 some_box(random_stream *draw)
{
    /* From a decimetre to a kilometre, long ones too. */
    double width = random_power_law(draw, 0.1, 1000, 1.3), length = width * random_uniform(draw, 0.2, 1);
    vec3 lo = {random_uniform(draw, -300, 300), random_uniform(draw, -300, 300), -1};
    return (box3){lo, {lo.x + width, lo.y + length, 1}};
}

/* Whoever meets the box in the plane is met once, and nobody who is not filed. */
static void assert_search(const box_grid *g, const box3 *box, const bool *filed, box3 around)
{
    meeting m = {box, around, {0}, -1};
    for (int32_t grid = 0; grid < BOX_GRIDS; grid++)
        ck_assert(box_grid_search(g, grid, around, meet, &m));
    for (int32_t i = 0; i < SLOTS; i++) {
        ck_assert_int_le(m.met[i], filed[i]);
        if (filed[i] && box3_meet(box[i], around))
            ck_assert_int_eq(m.met[i], 1);
    }
}

START_TEST(who_is_near_is_met_once)
{
    context ctx;
    context_init(&ctx);
    box_grid g = {0};
    box3 box[SLOTS];
    bool filed[SLOTS] = {false};
    random_stream draw = random_begin(5, 0, 0);
    for (int round = 0; round < 120; round++) {
        box3 (*draw_box)(random_stream *) = round < 60 ? some_box : crowded_box;
        if (round == 40 || round == 60) {
            box_grid_clear(&g);
            memset(filed, 0, sizeof filed);
        }
        int32_t count = 0;
        for (int k = 0; k < 60; k++) {
            int32_t slot = (int32_t)random_uniform(&draw, 0, SLOTS - 0.001);
            if (random_uniform(&draw, 0, 1) < 0.3) {
                box_grid_take(&g, slot);
                filed[slot] = false;
            } else {
                box[slot] = draw_box(&draw);
                filed[slot] = true;
                ck_assert(box_grid_put(&ctx, &g, slot, box[slot]));
            }
        }
        for (int32_t i = 0; i < SLOTS; i++)
            count += filed[i];
        ck_assert_int_eq(g.count, count);
        for (int k = 0; k < 20; k++)
            assert_search(&g, box, filed, draw_box(&draw));
    }
    /* A search ends when it is told to. */
    meeting m = {box, {{-1e4, -1e4, -1}, {1e4, 1e4, 1}}, {0}, 1};
    int32_t sum = 0;
    ck_assert(!box_grid_search(&g, CROWD_GRID, m.around, meet, &m));
    for (int32_t i = 0; i < SLOTS; i++)
        sum += m.met[i];
    ck_assert_int_eq(sum, 1);
    box_grid_free(&ctx, &g);
}
END_TEST

/* A slot that could not be filed is filed nowhere, and the others can be searched. */
START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        box_grid g = {0};
        box3 box[SLOTS];
        bool filed[SLOTS] = {false};
        random_stream draw = random_begin(6, 0, 0);
        turn.status = FRAM_OK;
        for (int32_t i = 0; i < SLOTS; i++) {
            box[i] = some_box(&draw);
            filed[i] = box_grid_put(&turn.ctx, &g, i, box[i]);
            if (!filed[i])
                turn.status = FRAM_ERROR_MEMORY;
        }
        if (g.bucket.count > 0)
            assert_search(&g, box, filed, (box3){{-100, -100, -1}, {100, 100, 1}});
        box_grid_free(&turn.ctx, &g);
        ck_assert_int_lt(turn.n, 10000);
    }
}
END_TEST

TEST_MAIN("box_grid", who_is_near_is_met_once, memory_runs_out)
