/* Trees of boxes over a ring: what they find, against a look at every run. */
#include "base/random.h"
#include "geometry/ring_tree.h"
#include "testing.h"

enum { MOST_RUNS = 40, MOST_ITEMS = MOST_RUNS * RING_RUN };

/* Boxes in steps of one, so that many of them touch. */
static box2 draw_box(random_stream *r)
{
    double x = floor(random_uniform(r, 0, 40)), y = floor(random_uniform(r, 0, 40));
    return (box2){{x, y}, {x + floor(random_uniform(r, 0, 3)), y + floor(random_uniform(r, 0, 3))}};
}

static bool meet(box2 a, box2 b)
{
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y;
}

/* The first run from `run` on, by its items or, as the tree does, by the box around them. */
static int32_t plain_find(const box2 *run_box, int32_t runs, box2 box, int32_t run)
{
    for (; run < runs; run++)
        if (meet(run_box[run], box))
            return run;
    return -1;
}

static void expect_all(const ring_tree *t, const box2 *run_box, int32_t runs, random_stream *r)
{
    for (int k = 0; k < 20; k++) {
        box2 box = draw_box(r);
        for (int32_t from = 0; from <= runs + 1; from++)
            ck_assert_int_eq(ring_tree_find(t, box, from), plain_find(run_box, runs, box, from));
    }
}

START_TEST(runs_are_found_in_order)
{
    context ctx;
    context_init(&ctx);
    random_stream r = random_begin(41, 0, 0);
    for (int round = 0; round < 60; round++) {
        int32_t items = (int32_t)random_uniform(&r, 1, MOST_ITEMS), runs = (items + RING_RUN - 1) / RING_RUN;
        box2 run_box[MOST_RUNS];
        ring_tree t;
        ck_assert(ring_tree_init(&ctx, &t, items));
        for (int32_t i = 0; i < runs; i++)
            run_box[i] = (box2){{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
        for (int32_t i = 0; i < items; i++) {
            box2 box = draw_box(&r), *all = &run_box[i / RING_RUN];
            if (random_unit(&r) < 0.8) /* many boxes of a run would make all of them as large as the field */
                box = (box2){{1, 1}, {2, 2}};
            ring_tree_add(&t, i, box);
            *all = (box2){{fmin(all->lo.x, box.lo.x), fmin(all->lo.y, box.lo.y)},
                          {fmax(all->hi.x, box.hi.x), fmax(all->hi.y, box.hi.y)}};
        }
        ring_tree_close(&t);
        expect_all(&t, run_box, runs, &r);
        for (int32_t k = 0; k < runs; k += 2) {
            ring_tree_leave_out(&t, k);
            run_box[k] = (box2){{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
        }
        expect_all(&t, run_box, runs, &r);
        ring_tree_free(&ctx, &t);
    }
}
END_TEST

START_TEST(memory_runs_out)
{
    failing_memory memory;
    context ctx = failing_context(&memory, 1);
    ring_tree t;
    ck_assert(!ring_tree_init(&ctx, &t, 100));
    ck_assert(memory.failed);
    ck_assert_int_eq(memory.live, 0);
}
END_TEST

TEST_MAIN("ring_tree", runs_are_found_in_order, memory_runs_out)
