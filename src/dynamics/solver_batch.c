/* Which contacts are solved together: groups, tasks and their colours, batches. */
#include "dynamics/solver_batch.h"

#include "base/pool.h"

#include <assert.h>
#include <string.h>

/* More groups than this make a body a hub: its contacts would need as many colours and batches. */
enum { HUB_DEGREE = 32 };
/* Batches that are open for more lanes at a time, one bit each. */
enum { OPEN_BATCHES = 64 };

void batch_plan_free(context *ctx, batch_plan *plan)
{
    array_free(ctx, &plan->degree);
    array_free(ctx, &plan->chunk);
    array_free(ctx, &plan->row);
    array_free(ctx, &plan->owner);
    array_free(ctx, &plan->touched);
    array_free(ctx, &plan->hubs);
    array_free(ctx, &plan->runs);
    array_free(ctx, &plan->run_count);
    array_free(ctx, &plan->groups);
    array_free(ctx, &plan->order);
    array_free(ctx, &plan->slot);
    array_free(ctx, &plan->edges);
    array_free(ctx, &plan->within);
    array_free(ctx, &plan->batches);
    array_free(ctx, &plan->tasks);
    array_free(ctx, &plan->code);
    array_free(ctx, &plan->code_count);
    array_free(ctx, &plan->colour_end);
}

/* ---- groups ---- */

static bool count_touch(context *ctx, batch_plan *plan, const body_table *bodies, int32_t slot)
{
    if (!body_is_dynamic(bodies, slot))
        return true;
    return plan->degree.data[slot]++ > 0 || array_push(ctx, &plan->touched, slot);
}

typedef struct run_work {
    batch_plan *plan;
    const body_table *bodies;
    const contact_array *contacts;
} run_work;
enum { RUN_BLOCK = 512 };

/* The runs of a block of contacts: one look at each; what follows looks at the first of each group. */
static void find_runs(void *arg, int32_t block, int32_t thread)
{
    const run_work *w = arg;
    int32_t first = RUN_BLOCK * block, found = 0;
    contact_run *runs = &w->plan->runs.data[first];
    (void)thread;
    for (int32_t i = first; i < pool_block_end(block, RUN_BLOCK, w->contacts->count); i++) {
        const contact *c = &w->contacts->data[i];
        if (!body_is_dynamic(w->bodies, c->a) && !body_is_dynamic(w->bodies, c->b))
            continue;
        bool continues = i > 0 && contact_same_group(c - 1, c);
        if (continues && i > first)
            runs[found - 1].count++;
        else
            runs[found++] = (contact_run){c->a, c->b, i, 1, continues};
    }
    w->plan->run_count.data[block] = found;
}

/* Cuts a run into groups. */
static bool add_run(context *ctx, batch_plan *plan, const body_table *bodies, contact_run run)
{
    if (run.continues) {
        contact_group *last = &plan->groups.data[plan->groups.count - 1];
        int32_t room = BATCH_MOST_POINTS - last->count, more = run.count < room ? run.count : room;
        last->count += more;
        run.first += more;
        run.count -= more;
    }
    while (run.count > 0) {
        int32_t count = run.count < BATCH_MOST_POINTS ? run.count : BATCH_MOST_POINTS;
        if (!array_push(ctx, &plan->groups, (contact_group){run.first, count, -1}) ||
            !count_touch(ctx, plan, bodies, run.a) || !count_touch(ctx, plan, bodies, run.b))
            return false;
        run.first += count;
        run.count -= count;
    }
    return true;
}

static bool find_groups(context *ctx, batch_plan *plan, const body_table *bodies, const contact_array *contacts)
{
    int32_t slots = bodies->count, blocks = pool_blocks(contacts->count, RUN_BLOCK);
    array_clear(&plan->groups);
    array_clear(&plan->touched);
    if (!array_resize(ctx, &plan->degree, slots) || !array_resize(ctx, &plan->chunk, slots) ||
        !array_resize(ctx, &plan->row, slots) || !array_resize(ctx, &plan->owner, slots) ||
        !array_resize(ctx, &plan->runs, contacts->count) || !array_resize(ctx, &plan->run_count, blocks))
        return false;
    pool_run(ctx, find_runs, &(run_work){plan, bodies, contacts}, blocks);
    for (int32_t i = 0; i < slots; i++) {
        plan->degree.data[i] = 0;
        plan->row.data[i] = plan->owner.data[i] = -1;
    }
    for (int32_t b = 0; b < blocks; b++)
        for (int32_t i = 0; i < plan->run_count.data[b]; i++)
            if (!add_run(ctx, plan, bodies, plan->runs.data[RUN_BLOCK * b + i]))
                return false;
    return true;
}

/* Takes the hubs out of the touched bodies. */
static bool find_hubs(context *ctx, batch_plan *plan)
{
    array_clear(&plan->hubs);
    int32_t kept = 0;
    for (int32_t i = 0; i < plan->touched.count; i++) {
        int32_t slot = plan->touched.data[i];
        if (plan->degree.data[slot] <= HUB_DEGREE) {
            plan->touched.data[kept++] = slot;
            continue;
        }
        if (!array_push(ctx, &plan->hubs, slot))
            return false;
        plan->chunk.data[slot] = -plan->hubs.count;
    }
    plan->touched.count = kept;
    return true;
}

/* ---- body rows ---- */

static int32_t new_row(context *ctx, batch_plan *plan, int32_t slot)
{
    if (!array_push(ctx, &plan->slot, slot) || !array_push(ctx, &plan->within, 0))
        return -1;
    return plan->slot.count - 1;
}

/* Movable bodies by regions, then hubs and their copies. */
static bool number_rows(context *ctx, batch_plan *plan)
{
    int32_t start[PARTITION_MOST + 1] = {0}, count = plan->touched.count;
    array_clear(&plan->slot);
    array_clear(&plan->within);
    if (!array_resize(ctx, &plan->slot, count) || !array_resize(ctx, &plan->within, count))
        return false;
    for (int32_t i = 0; i < count; i++)
        start[plan->chunk.data[plan->touched.data[i]] + 1]++;
    for (int32_t c = 0; c < plan->chunks; c++)
        start[c + 1] += start[c];
    for (int32_t i = 0; i < count; i++) {
        int32_t slot = plan->touched.data[i], row = start[plan->chunk.data[slot]]++;
        plan->row.data[slot] = row;
        plan->slot.data[row] = slot;
        plan->within.data[row] = 0;
    }
    for (int32_t h = 0; h < plan->hubs.count; h++) {
        plan->row.data[plan->hubs.data[h]] = new_row(ctx, plan, plan->hubs.data[h]);
        if (plan->row.data[plan->hubs.data[h]] < 0)
            return false;
    }
    plan->movable = plan->slot.count;
    for (int32_t i = 0; i < BATCH_LANES * plan->hubs.count; i++)
        if (new_row(ctx, plan, -1) < 0)
            return false;
    return true;
}

int32_t batch_plan_row(context *ctx, batch_plan *plan, const body_table *bodies, int32_t slot)
{
    if (slot < 0 || !body_is_dynamic(bodies, slot))
        return new_row(ctx, plan, slot);
    if (plan->row.data[slot] < 0)
        plan->row.data[slot] = new_row(ctx, plan, slot);
    return plan->row.data[slot];
}

/* The row of a body in a task. */
static int32_t task_row(context *ctx, batch_plan *plan, const body_table *bodies, int32_t slot, int32_t task)
{
    if (body_is_dynamic(bodies, slot))
        return plan->row.data[slot];
    if (plan->owner.data[slot] != task) {
        plan->owner.data[slot] = task;
        plan->row.data[slot] = new_row(ctx, plan, slot);
    }
    return plan->row.data[slot];
}

/* The row of the body of a contact that begins a group; its own where that body bends under it. */
static int32_t group_row(context *ctx, batch_plan *plan, const body_table *bodies, const contact_array *contacts,
                         int32_t first, int32_t slot, int32_t task)
{
    if (body_is_dynamic(bodies, slot) || contacts->data[first].give == 0)
        return task_row(ctx, plan, bodies, slot, task);
    int32_t row = new_row(ctx, plan, slot);
    return row >= 0 && array_push(ctx, &plan->edges, (bending_edge){row, first}) ? row : -1;
}

/* ---- tasks ---- */

/* Regions i <= j that a group joins, as i chunks + j; beyond those: of its hub; the last: two hubs. */
static int32_t code_of(const batch_plan *plan, const body_table *bodies, const contact *c)
{
    int32_t n = plan->chunks;
    bool a = body_is_dynamic(bodies, c->a), b = body_is_dynamic(bodies, c->b);
    int32_t i = plan->chunk.data[a ? c->a : c->b], j = plan->chunk.data[b ? c->b : c->a];
    if (i < 0 && j < 0 && i != j)
        return n * n + plan->hubs.count;
    if (i < 0 || j < 0)
        return n * n - 1 - (i < j ? i : j);
    return i < j ? i * n + j : j * n + i;
}

static bool add_task(context *ctx, batch_plan *plan, int32_t code, int32_t colour)
{
    int32_t hub = code - plan->chunks * plan->chunks;
    batch_task t = {.colour = colour, .hub = hub >= 0 && hub < plan->hubs.count ? hub : -1};
    t.first_group = plan->tasks.count > 0 ? plan->tasks.data[plan->tasks.count - 1].end_group : 0;
    t.end_group = t.first_group + plan->code_count.data[code];
    plan->code.data[code] = plan->tasks.count;
    return array_push(ctx, &plan->tasks, t);
}

static bool end_colour(context *ctx, batch_plan *plan)
{
    int32_t begun = plan->colour_end.count > 0 ? plan->colour_end.data[plan->colour_end.count - 1] : 0;
    return plan->tasks.count == begun || array_push(ctx, &plan->colour_end, plan->tasks.count);
}

/* Colours of pairs of regions, greedily in ascending order, so that no region occurs twice in a colour; colour 0 is
   that of the regions themselves.  Returns the number of colours. */
static int32_t colour_pairs(const batch_plan *plan, uint8_t colour[PARTITION_MOST * PARTITION_MOST])
{
    uint64_t used[2 * PARTITION_MOST] = {0}; /* regions of each colour */
    int32_t n = plan->chunks, colours = 1;
    for (int32_t i = 0; i < n; i++) {
        colour[i * n + i] = 0;
        for (int32_t j = i + 1; j < n; j++) {
            if (plan->code_count.data[i * n + j] == 0)
                continue;
            uint64_t both = ((uint64_t)1 << i) | ((uint64_t)1 << j);
            int32_t c = 1;
            while (used[c] & both)
                c++;
            used[c] |= both;
            colour[i * n + j] = (uint8_t)c;
            colours = c >= colours ? c + 1 : colours;
        }
    }
    return colours;
}

/* Tasks by colours: regions, pairs of regions, hubs one after the other, what joins two hubs. */
static bool number_tasks(context *ctx, batch_plan *plan)
{
    uint8_t colour[PARTITION_MOST * PARTITION_MOST];
    int32_t n = plan->chunks, codes = n * n + plan->hubs.count + 1, colours = colour_pairs(plan, colour);
    array_clear(&plan->tasks);
    array_clear(&plan->colour_end);
    for (int32_t c = 0; c < colours; c++) {
        for (int32_t i = 0; i < n; i++)
            for (int32_t j = i; j < n; j++)
                if (plan->code_count.data[i * n + j] > 0 && colour[i * n + j] == c &&
                    !add_task(ctx, plan, i * n + j, c))
                    return false;
        if (!end_colour(ctx, plan))
            return false;
    }
    for (int32_t k = n * n; k < codes; k++)
        if (plan->code_count.data[k] > 0 && (!add_task(ctx, plan, k, colours++) || !end_colour(ctx, plan)))
            return false;
    return true;
}

/* Every group gets its task, and the order of groups becomes that of their tasks. */
static bool share_out_groups(context *ctx, batch_plan *plan, const body_table *bodies, const contact_array *contacts)
{
    int32_t codes = plan->chunks * plan->chunks + plan->hubs.count + 1, groups = plan->groups.count;
    if (!array_resize(ctx, &plan->code, codes) || !array_resize(ctx, &plan->code_count, codes) ||
        !array_resize(ctx, &plan->order, groups))
        return false;
    memset(plan->code_count.data, 0, (size_t)codes * sizeof(int32_t));
    for (int32_t g = 0; g < groups; g++) {
        contact_group *group = &plan->groups.data[g];
        group->task = code_of(plan, bodies, &contacts->data[group->first]);
        plan->code_count.data[group->task]++;
    }
    if (!number_tasks(ctx, plan))
        return false;
    for (int32_t t = 0; t < plan->tasks.count; t++)
        plan->tasks.data[t].end_group = plan->tasks.data[t].first_group;
    for (int32_t g = 0; g < groups; g++) {
        contact_group *group = &plan->groups.data[g];
        group->task = plan->code.data[group->task];
        plan->order.data[plan->tasks.data[group->task].end_group++] = g;
    }
    return true;
}

/* ---- batches ---- */

/* The batches of a task that still take groups.  A group goes into the oldest open batch of its number of points that
   holds none of its movable bodies; which those are, each body's row tells by one bit per open batch. */
typedef struct open_batches {
    uint64_t open, of_points[BATCH_MOST_POINTS + 1];
    int32_t batch[OPEN_BATCHES]; /* numbers */
    int32_t lanes[OPEN_BATCHES]; /* taken */
    int32_t next;                /* place of the next batch; the oldest one that is open is closed for it */
} open_batches;

static void close_batch(batch_plan *plan, open_batches *o, int32_t place)
{
    const contact_batch *batch = &plan->batches.data[o->batch[place]];
    uint64_t keep = ~((uint64_t)1 << place);
    for (int32_t lane = 0; lane < o->lanes[place]; lane++) {
        plan->within.data[batch->a[lane]] &= keep;
        plan->within.data[batch->b[lane]] &= keep;
    }
    o->open &= keep;
    o->of_points[batch->points] &= keep;
}

static bool open_batch(context *ctx, batch_plan *plan, open_batches *o, int32_t points, int32_t hub, int32_t idle,
                       int32_t *place)
{
    contact_batch fresh = {.points = points, .first = plan->points, .hub = -1, .copies = -1};
    if (hub >= 0) {
        fresh.hub = plan->row.data[plan->hubs.data[hub]];
        fresh.copies = plan->movable + BATCH_LANES * hub;
    }
    for (int32_t lane = 0; lane < BATCH_LANES; lane++) {
        fresh.a[lane] = fresh.b[lane] = idle;
        for (int32_t k = 0; k < BATCH_MOST_POINTS; k++)
            fresh.contact[k][lane] = -1;
    }
    *place = o->next++ % OPEN_BATCHES;
    if (o->open >> *place & 1u)
        close_batch(plan, o, *place);
    o->open |= (uint64_t)1 << *place;
    o->of_points[points] |= (uint64_t)1 << *place;
    o->batch[*place] = plan->batches.count;
    o->lanes[*place] = 0;
    plan->points += points;
    return array_push(ctx, &plan->batches, fresh);
}

static bool row_is_movable(const batch_plan *plan, int32_t row) { return row < plan->movable; }

/* Puts a group into a lane of the batch at `place`, and closes that when it is full. */
static void put_group(batch_plan *plan, open_batches *o, int32_t place, const contact_group *group, int32_t a,
                      int32_t b)
{
    contact_batch *batch = &plan->batches.data[o->batch[place]];
    int32_t lane = o->lanes[place]++;
    batch->a[lane] = a == batch->hub ? batch->copies + lane : a;
    batch->b[lane] = b == batch->hub ? batch->copies + lane : b;
    for (int32_t k = 0; k < group->count; k++)
        batch->contact[k][lane] = group->first + k;
    if (row_is_movable(plan, batch->a[lane]))
        plan->within.data[a] |= (uint64_t)1 << place;
    if (row_is_movable(plan, batch->b[lane]))
        plan->within.data[b] |= (uint64_t)1 << place;
    if (o->lanes[place] == BATCH_LANES)
        close_batch(plan, o, place);
}

static int lowest_bit(uint64_t x) { return __builtin_ctzll(x); }

/* The oldest of some open batches: `next` points at where the oldest may be. */
static int32_t oldest(const open_batches *o, uint64_t candidates)
{
    int from = o->next % OPEN_BATCHES;
    uint64_t older = candidates & (~(uint64_t)0 << from);
    return lowest_bit(older ? older : candidates);
}

static bool make_batches(context *ctx, batch_plan *plan, const body_table *bodies, const contact_array *contacts,
                         int32_t task)
{
    batch_task *t = &plan->tasks.data[task];
    int32_t hub_row = t->hub >= 0 ? plan->row.data[plan->hubs.data[t->hub]] : -1, idle = new_row(ctx, plan, -1);
    if (idle < 0)
        return false;
    open_batches o = {.open = 0};
    t->first = plan->batches.count;
    for (int32_t i = t->first_group; i < t->end_group; i++) {
        const contact_group *group = &plan->groups.data[plan->order.data[i]];
        const contact *c = &contacts->data[group->first];
        int32_t a = group_row(ctx, plan, bodies, contacts, group->first, c->a, task), place;
        int32_t b = group_row(ctx, plan, bodies, contacts, group->first, c->b, task);
        if (a < 0 || b < 0)
            return false;
        uint64_t taken = (a == hub_row ? 0 : plan->within.data[a]) | (b == hub_row ? 0 : plan->within.data[b]);
        uint64_t candidates = o.of_points[group->count] & ~taken;
        if (candidates)
            place = oldest(&o, candidates);
        else if (!open_batch(ctx, plan, &o, group->count, t->hub, idle, &place))
            return false;
        put_group(plan, &o, place, group, a, b);
    }
    while (o.open)
        close_batch(plan, &o, lowest_bit(o.open));
    t->end = plan->batches.count;
    return true;
}

#ifndef NDEBUG
/* No movable body stands in two lanes of a batch, and all rows exist. */
static void assert_lanes_share_nothing(const batch_plan *plan, const contact_batch *batch)
{
    for (int32_t i = 0; i < 2 * BATCH_LANES; i++) {
        int32_t row = i < BATCH_LANES ? batch->a[i] : batch->b[i - BATCH_LANES];
        assert(row >= 0 && row < plan->slot.count);
        for (int32_t k = 0; k < i; k++) {
            int32_t other = k < BATCH_LANES ? batch->a[k] : batch->b[k - BATCH_LANES];
            assert(row != other || !row_is_movable(plan, row));
        }
    }
}
#endif

bool batch_plan_make(context *ctx, batch_plan *plan, const body_table *bodies, const contact_array *contacts)
{
    array_clear(&plan->batches);
    array_clear(&plan->edges);
    plan->points = 0;
    if (!find_groups(ctx, plan, bodies, contacts) || !find_hubs(ctx, plan))
        return false;
    bodies_partition(bodies, plan->touched.data, plan->touched.count, plan->groups.count, plan->chunk.data,
                     &plan->chunks);
    if (!number_rows(ctx, plan) || !share_out_groups(ctx, plan, bodies, contacts))
        return false;
    for (int32_t t = 0; t < plan->tasks.count; t++)
        if (!make_batches(ctx, plan, bodies, contacts, t))
            return false;
#ifndef NDEBUG
    for (int32_t i = 0; i < plan->batches.count; i++)
        assert_lanes_share_nothing(plan, &plan->batches.data[i]);
#endif
    return true;
}
