#include "results/replay_parts.h"

#include "base/sort.h"
#include "base/transcendental.h"
#include "geometry/overlay.h"
#include "vessel/hull_plan.h"

#include <stdlib.h>

/* Part of its convex outline that a solid must leave open: as in the picture of the plan (sim/build_ice.c). */
#define OPEN_SHARE 0.01

/* Lines across the plan on which it is looked for open water. */
enum { SCAN_LINES = 200 };

/* So many triangles at most are united one after the other; more by halves, so that what is united stays small. */
enum { UNITED_AT_ONCE = 8 };

typedef ARRAY(double) number_array;

typedef struct placed_triangle {
    vec2 corner[3];
    double key; /* by which they are sorted [m] */
} placed_triangle;

typedef struct solid_plan {
    context *ctx;
    overlay *plane;
    ARRAY(placed_triangle) upper; /* those that look upwards: of a closed surface they cover all that it covers */
    vec2_array around;            /* convex outline */
    fram_error *error;
} solid_plan;

/* Upright, about its centre of mass. */
static bool find_upper(const replay *r, const replay_body *b, solid_plan *s)
{
    vec2_array points = {0};
    bool good = true;
    for (int32_t f = 0; f < b->face_count && good; f++) {
        placed_triangle t;
        for (int k = 0; k < 3; k++) {
            vec3 v = r->points.data[b->vertex_first + r->faces.data[3 * (b->face_first + f) + k]];
            t.corner[k] = vec2_make(v.x, v.y);
        }
        polygon triangle = {t.corner, 3};
        if (polygon_orientation(triangle) > 0 && polygon_area(triangle) > 0)
            good = array_push(s->ctx, &s->upper, t);
    }
    for (int32_t i = 0; i < b->vertex_count && good; i++) {
        vec3 v = r->points.data[b->vertex_first + i];
        good = array_push(s->ctx, &points, vec2_make(v.x, v.y));
    }
    good = good && polygon_convex_hull(s->ctx, (polygon){points.data, points.count}, &s->around);
    array_free(s->ctx, &points);
    return good;
}

/* Where a line of this y crosses a triangle; false where it does not. */
static bool crossing_of(const placed_triangle *t, double y, double *from, double *to)
{
    *from = HUGE_VAL;
    *to = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        vec2 a = t->corner[k], b = t->corner[(k + 1) % 3];
        if ((a.y <= y) == (b.y <= y))
            continue;
        double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        *from = fmin(*from, x);
        *to = fmax(*to, x);
    }
    return *from < *to;
}

/* Length of a line that triangles cover, from where they begin and end on it. */
static double length_covered(number_array *begins, number_array *ends)
{
    double length = 0, since = 0;
    int32_t over = 0, next = 0;
    numbers_sort(begins->data, begins->count);
    numbers_sort(ends->data, ends->count);
    for (int32_t i = 0; i < ends->count; i++) {
        for (; next < begins->count && begins->data[next] <= ends->data[i]; next++)
            if (over++ == 0)
                since = begins->data[next];
        if (--over == 0)
            length += ends->data[i] - since;
    }
    return length;
}

/* Whether the solid leaves more than a small share of its convex outline open. */
static bool is_open(const solid_plan *s, bool *open)
{
    number_array begins = {0}, ends = {0};
    double low = HUGE_VAL, high = -HUGE_VAL, covered = 0, from, to;
    bool good = true;
    for (int32_t i = 0; i < s->around.count; i++) {
        low = fmin(low, s->around.data[i].y);
        high = fmax(high, s->around.data[i].y);
    }
    double apart = (high - low) / SCAN_LINES;
    for (int line = 0; line < SCAN_LINES && good; line++) {
        array_clear(&begins);
        array_clear(&ends);
        for (int32_t i = 0; i < s->upper.count && good; i++)
            if (crossing_of(&s->upper.data[i], low + (line + 0.5) * apart, &from, &to))
                good = array_push(s->ctx, &begins, from) && array_push(s->ctx, &ends, to);
        covered += apart * length_covered(&begins, &ends);
    }
    *open = covered > 0 && covered < (1 - OPEN_SHARE) * polygon_area((polygon){s->around.data, s->around.count});
    array_free(s->ctx, &begins);
    array_free(s->ctx, &ends);
    return good;
}

static int by_key(const void *a, const void *b)
{
    double p = ((const placed_triangle *)a)->key, q = ((const placed_triangle *)b)->key;
    return (p > q) - (p < q);
}

/* Sorts triangles along the longer side of the box around their middles. */
static void sort_along(placed_triangle *t, int32_t count)
{
    vec2 low = {HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL};
    for (int32_t i = 0; i < count; i++) {
        vec2 sum = vec2_add(vec2_add(t[i].corner[0], t[i].corner[1]), t[i].corner[2]);
        low = (vec2){fmin(low.x, sum.x), fmin(low.y, sum.y)};
        high = (vec2){fmax(high.x, sum.x), fmax(high.y, sum.y)};
    }
    bool along_x = high.x - low.x > high.y - low.y;
    for (int32_t i = 0; i < count; i++)
        t[i].key = along_x ? t[i].corner[0].x + t[i].corner[1].x + t[i].corner[2].x
                           : t[i].corner[0].y + t[i].corner[1].y + t[i].corner[2].y;
    qsort(t, (size_t)count, sizeof *t, by_key);
}

static fram_status unite(solid_plan *s, int32_t first, int32_t count, polygon_list *out)
{
    polygon_list parts = {0};
    fram_status status = FRAM_OK;
    if (count > UNITED_AT_ONCE) {
        sort_along(s->upper.data + first, count);
        status = unite(s, first, count / 2, &parts);
        if (status == FRAM_OK)
            status = unite(s, first + count / 2, count - count / 2, &parts);
    }
    for (int32_t i = first; count <= UNITED_AT_ONCE && i < first + count && status == FRAM_OK; i++)
        if (!polygon_list_push(s->ctx, &parts, (polygon){s->upper.data[i].corner, 3}))
            status = error_memory(s->error);
    if (status == FRAM_OK)
        status = hull_plan_unite(s->ctx, s->plane, &parts, out, s->error);
    polygon_list_free(s->ctx, &parts);
    return status;
}

/* Looks at a solid once: what it covers is kept where it is open; nothing where GEOS finds no union that is right. */
static fram_status find_open_parts(replay *r, replay_body *b, fram_error *error)
{
    solid_plan s = {.ctx = r->ctx, .plane = overlay_create(r->ctx), .error = error};
    int32_t before = polygon_list_count(&r->parts);
    bool open = false;
    fram_status status = s.plane && find_upper(r, b, &s) && is_open(&s, &open) ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK && open)
        status = unite(&s, 0, s.upper.count, &r->parts);
    b->part_first = before;
    b->part_count = status == FRAM_OK ? polygon_list_count(&r->parts) - before : 0;
    b->looked_at = true;
    array_free(r->ctx, &s.upper);
    array_free(r->ctx, &s.around);
    overlay_free(s.plane);
    return status == FRAM_ERROR_MEMORY ? status : FRAM_OK;
}

fram_status replay_parts_add(replay *r, const replay_pose *p, polygon_list *out, fram_error *error)
{
    replay_body *b = &r->bodies.data[p->body];
    fram_status status = b->solid && !b->looked_at ? find_open_parts(r, b, error) : FRAM_OK;
    double heading = quat_roll_pitch_yaw(p->orientation).z;
    vec2 along = {real_cos(heading), real_sin(heading)};
    vec2_array ring = {0};
    bool good = true;
    for (int32_t i = 0; b->solid && i < b->part_count && status == FRAM_OK && good; i++) {
        polygon part = polygon_list_get(&r->parts, b->part_first + i);
        array_clear(&ring);
        for (int32_t k = 0; k < part.count && good; k++) {
            vec2 v = part.vertex[k];
            good = array_push(r->ctx, &ring,
                              vec2_make(p->position.x + along.x * v.x - along.y * v.y,
                                        p->position.y + along.y * v.x + along.x * v.y));
        }
        good = good && polygon_list_push(r->ctx, out, (polygon){ring.data, ring.count});
    }
    array_free(r->ctx, &ring);
    return good ? status : error_memory(error);
}
