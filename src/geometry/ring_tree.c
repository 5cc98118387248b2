/* Trees of boxes over a ring; see ring_tree.h. */
#include "geometry/ring_tree.h"

#include "geometry/predicate.h"

#include <assert.h>

static const box2 NOTHING = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};

static box2 both(box2 a, box2 b)
{
    return (box2){{real_min(a.lo.x, b.lo.x), real_min(a.lo.y, b.lo.y)},
                  {real_max(a.hi.x, b.hi.x), real_max(a.hi.y, b.hi.y)}};
}

static bool meet(const box2 *a, const box2 *b)
{
    return a->lo.x <= b->hi.x && a->hi.x >= b->lo.x && a->lo.y <= b->hi.y && a->hi.y >= b->lo.y;
}

bool ring_tree_init(context *ctx, ring_tree *t, int32_t items)
{
    int32_t runs = items / RING_RUN + 1;
    t->leaves = 1;
    while (t->leaves < runs)
        t->leaves *= 2;
    t->box = memory_array(ctx, 2 * (size_t)t->leaves, sizeof *t->box);
    for (int32_t i = 0; t->box && i < 2 * t->leaves; i++)
        t->box[i] = NOTHING;
    return t->box != NULL;
}

void ring_tree_free(context *ctx, ring_tree *t)
{
    memory_free(ctx, t->box);
    t->box = NULL;
}

void ring_tree_add(ring_tree *t, int32_t item, box2 box)
{
    assert(item >= 0 && item / RING_RUN < t->leaves);
    box2 *run = &t->box[t->leaves + item / RING_RUN];
    *run = both(*run, box);
}

void ring_tree_close(ring_tree *t)
{
    for (int32_t i = t->leaves - 1; i > 0; i--)
        t->box[i] = both(t->box[2 * i], t->box[2 * i + 1]);
}

void ring_tree_leave_out(ring_tree *t, int32_t run)
{
    int32_t i = t->leaves + run;
    t->box[i] = NOTHING;
    for (i /= 2; i > 0; i /= 2)
        t->box[i] = both(t->box[2 * i], t->box[2 * i + 1]);
}

/* Down to the left where a box meets, and where none does on to the next run of runs, which is the larger the farther
   it lies. */
int32_t ring_tree_find(const ring_tree *t, box2 box, int32_t run)
{
    if (run >= t->leaves)
        return -1;
    for (int32_t i = t->leaves + run;;) {
        if (meet(&t->box[i], &box)) {
            if (i >= t->leaves)
                return i - t->leaves;
            i *= 2;
            continue;
        }
        while (i % 2 == 1)
            i /= 2;
        if (i == 0)
            return -1;
        i++;
    }
}
