#include "vessel/hull_plan.h"

#include "geometry/box_pairs.h"
#include "geometry/polygon_pieces.h"

#include <math.h>

/* Boxes are wider by this part of the size of all: parts that touch lie together, and rounding parts none. */
#define TOGETHER 1e-9

/* Parts whose boxes meet, and those that lie together by others, are a group. */
typedef struct plan_groups {
    int32_array before; /* of each part: one of its group, before it; itself: the first one */
    int32_array next;   /* of each part: the next one of its group, -1: there is none */
} plan_groups;

static int32_t first_of_group(int32_array *before, int32_t i)
{
    int32_t *b = before->data;
    while (b[i] != i)
        i = b[i] = b[b[i]];
    return i;
}

static fram_status join_groups(void *user, int32_t a, int32_t b, fram_error *error)
{
    (void)error;
    plan_groups *g = user;
    int32_t p = first_of_group(&g->before, a), q = first_of_group(&g->before, b);
    g->before.data[p > q ? p : q] = p < q ? p : q;
    return FRAM_OK;
}

static fram_status find_groups(context *ctx, const polygon_list *parts, plan_groups *g, fram_error *error)
{
    context own = context_unstopped(ctx);
    own.work = NULL;
    int32_t count = polygon_list_count(parts);
    box2 all = polygon_bounds((polygon){parts->vertex.data, parts->vertex.count});
    double margin = TOGETHER * fmax(all.hi.x - all.lo.x, all.hi.y - all.lo.y);
    box2 *box = memory_array(ctx, (size_t)count, sizeof *box);
    bool good = box && array_resize(ctx, &g->before, count) && array_resize(ctx, &g->next, count);
    for (int32_t i = 0; good && i < count; i++) {
        box[i] = polygon_bounds(polygon_list_get(parts, i));
        box[i].lo = vec2_sub(box[i].lo, vec2_make(margin, margin));
        box[i].hi = vec2_add(box[i].hi, vec2_make(margin, margin));
        g->before.data[i] = i;
    }
    fram_status status =
        good ? box_pairs(&own, box, count, "uniting a plan", join_groups, g, error) : error_memory(error);
    memory_free(ctx, box);
    return status;
}

/* Strings the parts of each group together, in their order. */
static bool link_groups(context *ctx, plan_groups *g)
{
    int32_array last = {0};
    int32_t count = g->next.count;
    bool good = array_resize(ctx, &last, count);
    for (int32_t i = 0; good && i < count; i++) {
        int32_t first = first_of_group(&g->before, i);
        g->next.data[i] = -1;
        if (first < i)
            g->next.data[last.data[first]] = i;
        last.data[first] = i;
    }
    array_free(ctx, &last);
    return good;
}

static fram_status unite_group(context *ctx, overlay *o, const polygon_list *parts, const plan_groups *g, int32_t first,
                               polygon_list *out, fram_error *error)
{
    polygon_list group = {0};
    fram_status status = FRAM_OK;
    for (int32_t i = first; i >= 0 && status == FRAM_OK; i = g->next.data[i])
        if (!polygon_list_push(ctx, &group, polygon_list_get(parts, i)))
            status = error_memory(error);
    if (status == FRAM_OK)
        status = overlay_union(o, &group, out, error);
    polygon_list_free(ctx, &group);
    return status;
}

fram_status hull_plan_unite(context *ctx, overlay *o, const polygon_list *parts, polygon_list *out, fram_error *error)
{
    plan_groups g = {0};
    polygon_list united = {0};
    fram_status status = find_groups(ctx, parts, &g, error);
    if (status == FRAM_OK && !link_groups(ctx, &g))
        status = error_memory(error);
    for (int32_t i = 0; status == FRAM_OK && i < g.before.count; i++)
        if (g.before.data[i] == i)
            status = unite_group(ctx, o, parts, &g, i, &united, error);
    if (status == FRAM_OK && !polygon_list_append_sorted(ctx, out, &united))
        status = error_memory(error);
    polygon_list_free(ctx, &united);
    array_free(ctx, &g.before);
    array_free(ctx, &g.next);
    return status;
}
