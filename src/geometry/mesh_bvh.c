/* Box hierarchy by median splits; see mesh_bvh.h. */
#include "geometry/mesh_bvh.h"

enum {
    LEAF_FACES = 4,  /* fewer triangles are not worth a node */
    STACK_DEPTH = 64 /* halving 2^31 faces takes 32 levels, each leaves one node waiting */
};

/* One triangle while the tree is built. */
typedef struct build_item {
    double key; /* centre of its box along the axis of the split */
    int32_t face;
} build_item;

static double component(vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

static int longest_axis(box3 b)
{
    vec3 d = vec3_sub(b.hi, b.lo);
    if (d.x >= d.y && d.x >= d.z)
        return 0;
    return d.y >= d.z ? 1 : 2;
}

static bool item_before(build_item a, build_item b) { return a.key < b.key || (a.key == b.key && a.face < b.face); }

static build_item median_of_three(build_item a, build_item b, build_item c)
{
    if (item_before(b, a)) {
        build_item swap = a;
        a = b;
        b = swap;
    }
    return item_before(c, a) ? a : item_before(b, c) ? b : c;
}

/* Hoare's selection: afterwards item[0 .. middle) come before item[middle .. count). */
static void split_at(build_item *item, int32_t count, int32_t middle)
{
    int32_t lo = 0, hi = count - 1;
    while (lo < hi) {
        build_item pivot = median_of_three(item[lo], item[lo + (hi - lo) / 2], item[hi]);
        int32_t i = lo, j = hi;
        while (i <= j) {
            while (item_before(item[i], pivot))
                i++;
            while (item_before(pivot, item[j]))
                j--;
            if (i <= j) {
                build_item swap = item[i];
                item[i++] = item[j];
                item[j--] = swap;
            }
        }
        if (middle <= j)
            hi = j;
        else if (middle >= i)
            lo = i;
        else
            return;
    }
}

/* Node over item[first .. first + count) and everything below it.  The arrays have room for all of it. */
static void build_node(const mesh *m, build_item *item, int32_t first, int32_t count, mesh_bvh *out)
{
    mesh_bvh_node *node = &out->node.data[out->node.count++];
    *node = (mesh_bvh_node){box3_empty(), -1, first, count};
    if (count <= LEAF_FACES) {
        for (int32_t i = first; i < first + count; i++) {
            out->face.data[i] = item[i].face;
            out->box.data[i] = mesh_face_bounds(m, item[i].face);
            node->box = box3_union(node->box, out->box.data[i]);
        }
        return;
    }
    box3 centres = box3_empty();
    for (int32_t i = first; i < first + count; i++) {
        box3 b = mesh_face_bounds(m, item[i].face);
        centres = box3_add(centres, vec3_add(b.lo, b.hi));
    }
    int axis = longest_axis(centres);
    for (int32_t i = first; i < first + count; i++) {
        box3 b = mesh_face_bounds(m, item[i].face);
        item[i].key = component(b.lo, axis) + component(b.hi, axis);
    }
    int32_t half = count / 2;
    split_at(item + first, count, half);
    int32_t before = out->node.count;
    build_node(m, item, first, half, out);
    node->next = out->node.count;
    build_node(m, item, first + half, count - half, out);
    node->box = box3_union(out->node.data[before].box, out->node.data[node->next].box);
}

fram_status mesh_bvh_build(context *ctx, const mesh *m, mesh_bvh *out)
{
    int32_t count = m->face.count;
    array_clear(&out->node);
    array_clear(&out->face);
    array_clear(&out->box);
    if (count == 0)
        return FRAM_OK;
    /* Leaves hold at least (LEAF_FACES + 1) / 2 faces, and there is one inner node less than leaves. */
    int32_t nodes = count / ((LEAF_FACES + 1) / 2) * 2 + 1;
    build_item *item = memory_array(ctx, (size_t)count, sizeof *item);
    if (!item || !array_reserve(ctx, &out->node, nodes) || !array_reserve(ctx, &out->face, count) ||
        !array_reserve(ctx, &out->box, count)) {
        memory_free(ctx, item);
        mesh_bvh_free(ctx, out);
        return FRAM_ERROR_MEMORY;
    }
    for (int32_t i = 0; i < count; i++)
        item[i].face = i;
    out->face.count = out->box.count = count;
    build_node(m, item, 0, count, out);
    memory_free(ctx, item);
    return FRAM_OK;
}

void mesh_bvh_free(context *ctx, mesh_bvh *b)
{
    array_free(ctx, &b->node);
    array_free(ctx, &b->face);
    array_free(ctx, &b->box);
}

/* What a query asks of a box. */
typedef struct region {
    box3 box;
    bool slab;
    vec3 normal, reach; /* reach: absolute values of the normal, to find how far a box extends along it */
    double lo, hi;
} region;

static bool region_meets(const region *r, const box3 *b)
{
    if (!box3_meet(r->box, *b))
        return false;
    if (!r->slab)
        return true;
    vec3 twice_centre = vec3_add(b->lo, b->hi);
    double middle = vec3_dot(r->normal, twice_centre), half = vec3_dot(r->reach, vec3_sub(b->hi, b->lo));
    return middle - half <= 2 * r->hi && middle + half >= 2 * r->lo;
}

/* Shell sort with Knuth's gaps: in place, and fast for the tens to hundreds of faces that a query finds. */
static void sort_ascending(int32_t *a, int32_t count)
{
    int32_t gap = 1;
    while (gap < count / 3)
        gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (int32_t i = gap; i < count; i++) {
            int32_t value = a[i], j = i;
            for (; j >= gap && a[j - gap] > value; j -= gap)
                a[j] = a[j - gap];
            a[j] = value;
        }
}

static bool find(context *ctx, const mesh_bvh *b, const region *r, int32_array *faces_out)
{
    array_clear(faces_out);
    int32_t stack[STACK_DEPTH], waiting = 0;
    if (b->node.count)
        stack[waiting++] = 0;
    while (waiting) {
        int32_t i = stack[--waiting];
        const mesh_bvh_node *node = &b->node.data[i];
        if (!region_meets(r, &node->box))
            continue;
        if (node->next >= 0) {
            stack[waiting++] = node->next;
            stack[waiting++] = i + 1;
            continue;
        }
        for (int32_t k = node->first; k < node->first + node->count; k++)
            if (region_meets(r, &b->box.data[k]) && !array_push(ctx, faces_out, b->face.data[k]))
                return false;
    }
    sort_ascending(faces_out->data, faces_out->count);
    return true;
}

bool mesh_bvh_query(context *ctx, const mesh_bvh *b, box3 box, int32_array *faces_out)
{
    region r = {.box = box};
    return find(ctx, b, &r, faces_out);
}

bool mesh_bvh_query_slab(context *ctx, const mesh_bvh *b, box3 box, vec3 normal, double lo, double hi,
                         int32_array *faces_out)
{
    vec3 reach = {fabs(normal.x), fabs(normal.y), fabs(normal.z)};
    region r = {box, true, normal, reach, lo, hi};
    return find(ctx, b, &r, faces_out);
}
