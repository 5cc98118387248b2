#include "vessel/hull_panels_parts.h"

#include <stdlib.h>

/* A triangle at just 45 degrees faces the side, the bottom, before the end: rounding must not part its neighbours. */
static const double TIE = 1e-6;
/* A knuckle of more than 20 degrees parts patches. */
static const double KNUCKLE_COSINE = 0.94;
/* Where all triangles of a patch look within 60 degrees of its mean normal, panels have their size in the plane of
 * that. */
static const double FLAT_COSINE = 0.5;
/* Triangles narrower than this part of a panel are lines, which look along no direction: a corner on a panel line is
   one of a facet twice, or in the middle of one of its edges. What surrounds them holds their points too. */
static const double THIN = 1e-9;
/* Pieces cut by lines before any is refused: a grid far too fine is told so before it fills the memory. */
enum { FACETS_MOST = 500000 };

const char *hull_side_name(hull_side side)
{
    static const char *const names[SIDE_COUNT] = {"port", "starboard", "bow", "stern", "bottom", "deck"};
    return names[side];
}

static hull_side side_of(vec3 n)
{
    double x = fabs(n.x) * (1 - TIE), y = fabs(n.y), z = fabs(n.z) * (1 + TIE);
    if (z >= x && z >= y)
        return n.z > 0 ? SIDE_DECK : SIDE_BOTTOM;
    if (y >= x)
        return n.y > 0 ? SIDE_PORT : SIDE_STARBOARD;
    return n.x > 0 ? SIDE_BOW : SIDE_STERN;
}

static vec3 side_normal(hull_side side)
{
    static const vec3 normals[SIDE_COUNT] = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, -1}, {0, 0, 1}};
    return normals[side];
}

/* ---- patches ---- */

static bool spread_patch(panel_work *w, int32_t face, int32_t patch, hull_side side, int32_array *open)
{
    w->patch_of.data[face] = patch;
    array_clear(open);
    bool good = array_push(w->ctx, open, face);
    while (open->count > 0 && good) {
        int32_t f = open->data[--open->count];
        for (int k = 0; k < 3 && good; k++) {
            int32_t g = w->adjacency.neighbour.data[3 * f + k];
            if (g < 0 || w->patch_of.data[g] >= 0)
                continue;
            vec3 n = mesh_area_vector(w->hull, g), own = mesh_area_vector(w->hull, f);
            if (side_of(n) != side || vec3_dot(n, own) < KNUCKLE_COSINE * vec3_length(n) * vec3_length(own))
                continue;
            w->patch_of.data[g] = patch;
            good = array_push(w->ctx, open, g);
        }
    }
    return good;
}

static bool find_patches(panel_work *w, hull_panels *out)
{
    int32_array open = {0};
    int32_t faces = w->hull->face.count;
    bool good = array_resize(w->ctx, &w->patch_of, faces);
    for (int32_t f = 0; f < faces && good; f++)
        w->patch_of.data[f] = -1;
    for (int32_t f = 0; f < faces && good; f++) {
        if (w->patch_of.data[f] >= 0)
            continue;
        hull_side side = side_of(mesh_area_vector(w->hull, f));
        panel_patch patch = {.side = (uint8_t)side};
        int32_t number = out->patch.count;
        good = array_push(w->ctx, &out->patch, patch) && spread_patch(w, f, number, side, &open);
    }
    array_free(w->ctx, &open);
    return good;
}

static vec3 unit(vec3 v) { return vec3_scale(v, 1 / vec3_length(v)); }

/* Sums over a patch. */
typedef struct patch_sum {
    vec3 area; /* of area vectors */
    bool turns;
} patch_sum;

/* Columns are parted by sections of the ship (at its ends by buttocks), rows by waterlines (of bottom and deck by
   buttocks).  On a plane of normal n that faces axis c most, cells of d_a by d_b have the area d_a d_b / |n_c|: with
   d_a = size sqrt(1 - n_a^2), the length of a along the plane, what is left of |n_c| is d_b. */
static bool set_rulers(panel_work *w, panel_patch *p, const patch_sum *s)
{
    const panel_rules *rules = w->rules;
    bool end = p->side == SIDE_BOW || p->side == SIDE_STERN, flat = p->side == SIDE_BOTTOM || p->side == SIDE_DECK;
    bool own = rules->frame_count > 0 || rules->stringer_count > 0;
    vec3 facing = side_normal((hull_side)p->side);
    p->normal = s->turns || own ? facing : unit(s->area);
    panel_ruler columns = {.axis = end ? (vec3){0, 1, 0} : (vec3){1, 0, 0}};
    panel_ruler rows = {.axis = flat ? (vec3){0, 1, 0} : (vec3){0, 0, 1}};
    double first = vec3_dot(p->normal, flat ? columns.axis : rows.axis), reach = sqrt(fmax(1 - first * first, 0));
    double other = fabs(vec3_dot(p->normal, facing)) / reach;
    columns.size = rules->size * (flat ? reach : other);
    rows.size = rules->size * (flat ? other : reach);
    if (!end && rules->frame_count > 0) {
        columns.line = rules->frame;
        columns.count = rules->frame_count;
    }
    if (!flat && rules->stringer_count > 0) {
        rows.line = rules->stringer;
        rows.count = rules->stringer_count;
    }
    return array_push(w->ctx, &w->ruler, columns) && array_push(w->ctx, &w->ruler, rows);
}

static bool measure_patches(panel_work *w, hull_panels *out)
{
    patch_sum *sum = memory_array(w->ctx, (size_t)out->patch.count, sizeof *sum);
    bool good = sum != NULL;
    for (int32_t f = 0; f < w->hull->face.count && good; f++) {
        patch_sum *s = &sum[w->patch_of.data[f]];
        s->area = vec3_add(s->area, mesh_area_vector(w->hull, f));
    }
    for (int32_t f = 0; f < w->hull->face.count && good; f++) {
        patch_sum *s = &sum[w->patch_of.data[f]];
        vec3 n = mesh_area_vector(w->hull, f);
        s->turns |= !(vec3_dot(n, s->area) >= FLAT_COSINE * vec3_length(n) * vec3_length(s->area));
    }
    for (int32_t i = 0; i < out->patch.count && good; i++)
        good = set_rulers(w, &out->patch.data[i], &sum[i]);
    memory_free(w->ctx, sum);
    return good;
}

/* ---- cells ---- */

int32_t ruler_cell(const panel_ruler *r, double at)
{
    if (!r->line)
        return (int32_t)floor(at / r->size);
    int32_t cell = 0;
    for (int32_t step = r->count; step > 0;) {
        int32_t half = step / 2;
        if (r->line[cell + half] <= at) {
            cell += half + 1;
            step -= half + 1;
        } else {
            step = half;
        }
    }
    return cell;
}

double ruler_begin(const panel_ruler *r, int32_t cell)
{
    if (!r->line)
        return cell * r->size;
    return cell <= 0 ? -HUGE_VAL : cell > r->count ? HUGE_VAL : r->line[cell - 1];
}

/* A triangle on at most two of its cells more than it spans: convex, with at most three corners and four cuts. */
enum { CORNERS_MOST = 8 };

static int clip_to(const panel_ruler *r, int32_t cell, const vec3 *in, int n, vec3 *out)
{
    vec3 half[CORNERS_MOST];
    double lo = ruler_begin(r, cell), hi = ruler_begin(r, cell + 1);
    const vec3 *from = in;
    if (lo > -HUGE_VAL) {
        n = facet_clip(in, n, vec3_scale(r->axis, -1), -lo, half);
        from = half;
    }
    if (n >= 3 && hi < HUGE_VAL)
        return facet_clip(from, n, r->axis, hi, out);
    for (int k = 0; k < n; k++)
        out[k] = from[k];
    return n;
}

static void cells_of(const panel_ruler *r, const vec3 *c, int n, int32_t *first, int32_t *last)
{
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (int k = 0; k < n; k++) {
        lo = fmin(lo, vec3_dot(r->axis, c[k]));
        hi = fmax(hi, vec3_dot(r->axis, c[k]));
    }
    *first = ruler_cell(r, lo);
    *last = ruler_cell(r, hi);
}

static double area_of(const vec3 *c, int n)
{
    vec3 sum = {0, 0, 0};
    for (int k = 1; k + 1 < n; k++)
        sum = vec3_add(sum, vec3_cross(vec3_sub(c[k], c[0]), vec3_sub(c[k + 1], c[0])));
    return 0.5 * vec3_length(sum);
}

static bool add_facet(panel_work *w, raw_facet facet, const vec3 *c, int n)
{
    facet.first = w->corner.count;
    facet.count = n;
    facet.area = area_of(c, n);
    facet.root = w->facet.count;
    if (!(facet.area > 0))
        return true;
    bool good = array_push(w->ctx, &w->facet, facet);
    for (int k = 0; k < n && good; k++)
        good = array_push(w->ctx, &w->corner, c[k]);
    return good;
}

static bool cut_face(panel_work *w, int32_t f)
{
    int32_t patch = w->patch_of.data[f], c0, c1, r0, r1;
    const panel_ruler *columns = &w->ruler.data[2 * patch], *rows = columns + 1;
    vec3 c[3], strip[CORNERS_MOST], piece[CORNERS_MOST];
    bool good = true;
    mesh_face_points(w->hull, f, c);
    cells_of(columns, c, 3, &c0, &c1);
    for (int32_t column = c0; column <= c1 && good; column++) {
        int n = clip_to(columns, column, c, 3, strip);
        if (n < 3)
            continue;
        cells_of(rows, strip, n, &r0, &r1);
        for (int32_t row = r0; row <= r1 && good; row++) {
            int m = clip_to(rows, row, strip, n, piece);
            const raw_facet facet = {.patch = patch, .column = column, .row = row, .face = f};
            if (m >= 3)
                good = add_facet(w, facet, piece, m);
        }
    }
    return good;
}

/* Pieces at most, before any is cut. */
static double count_pieces(const panel_work *w)
{
    double count = 0;
    for (int32_t f = 0; f < w->hull->face.count; f++) {
        const panel_ruler *r = &w->ruler.data[2 * w->patch_of.data[f]];
        double cells = 1;
        vec3 c[3];
        mesh_face_points(w->hull, f, c);
        for (int k = 0; k < 2; k++) {
            double lo = HUGE_VAL, hi = -HUGE_VAL;
            for (int i = 0; i < 3; i++) {
                lo = fmin(lo, vec3_dot(r[k].axis, c[i]));
                hi = fmax(hi, vec3_dot(r[k].axis, c[i]));
            }
            cells *= r[k].line ? r[k].count + 1 : (hi - lo) / r[k].size + 1;
        }
        count += cells;
    }
    return count;
}

static fram_status cut_faces(panel_work *w, fram_error *error)
{
    if (!(count_pieces(w) <= FACETS_MOST))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "panel",
                         "panels of %g m cut this hull into more than %d pieces; expected larger ones", w->rules->size,
                         (int)FACETS_MOST);
    for (int32_t f = 0; f < w->hull->face.count; f++)
        if (!cut_face(w, f))
            return error_memory(error);
    return FRAM_OK;
}

/* ---- panels ---- */

static int compare_facets(const void *a, const void *b)
{
    const raw_facet *p = a, *q = b;
    const int32_t key[4][2] = {{p->patch, q->patch}, {p->row, q->row}, {p->column, q->column}, {p->face, q->face}};
    for (int k = 0; k < 4; k++)
        if (key[k][0] != key[k][1])
            return key[k][0] < key[k][1] ? -1 : 1;
    return 0;
}

/* By cell; roots name themselves again. */
static void sort_facets(panel_work *w)
{
    if (w->facet.count > 0)
        qsort(w->facet.data, (size_t)w->facet.count, sizeof *w->facet.data, compare_facets);
    for (int32_t i = 0; i < w->facet.count; i++)
        w->facet.data[i].root = i;
}

static void add_to_panel(panel_work *w, const raw_facet *f, hull_panel *p)
{
    const vec3 *c = &w->corner.data[f->first];
    for (int32_t k = 1; k + 1 < f->count; k++) {
        vec3 n = vec3_scale(vec3_cross(vec3_sub(c[k], c[0]), vec3_sub(c[k + 1], c[0])), 0.5);
        double area = vec3_length(n);
        p->normal = vec3_add(p->normal, n);
        p->centre = vec3_mad(p->centre, vec3_add(c[0], vec3_add(c[k], c[k + 1])), area / 3);
        p->area += area;
    }
    for (int32_t k = 0; k < f->count; k++)
        p->bounds = box3_add(p->bounds, c[k]);
}

/* The panel of a root, numbered in the order of their first facets, which bear the cell's name. */
static bool number_panels(panel_work *w, hull_panels *out, int32_t *panel_of)
{
    for (int32_t i = 0; i < w->facet.count; i++) {
        int32_t root = facet_root(w, i);
        const raw_facet *r = &w->facet.data[root];
        if (panel_of[root] < 0) {
            hull_panel p = {.side = out->patch.data[r->patch].side, .patch = r->patch, .column = r->column};
            p.row = r->row;
            p.bounds = box3_empty();
            panel_of[root] = out->panel.count;
            if (!array_push(w->ctx, &out->panel, p))
                return false;
        }
        panel_of[i] = panel_of[root];
        add_to_panel(w, &w->facet.data[i], &out->panel.data[panel_of[i]]);
    }
    for (int32_t i = 0; i < out->panel.count; i++) {
        hull_panel *p = &out->panel.data[i];
        double length = vec3_length(p->normal);
        p->centre = vec3_scale(p->centre, 1 / p->area);
        p->normal = length > 0 ? vec3_scale(p->normal, 1 / length) : out->patch.data[p->patch].normal;
        const hull_panel *before = i > 0 ? p - 1 : NULL;
        if (before && before->patch == p->patch && before->row == p->row && before->column == p->column)
            p->part = before->part + 1;
    }
    return true;
}

/* A facet as triangles. */
static bool lay_triangles(panel_work *w, hull_panels *out, const panel_facet *f)
{
    const vec3 *c = &w->corner.data[f->first];
    bool good = true;
    for (int32_t k = 1; k + 1 < f->count && good; k++) {
        vec3 a = vec3_sub(c[k], c[0]), b = vec3_sub(c[k + 1], c[0]), d = vec3_sub(b, a);
        double square = fmax(vec3_dot(a, a), fmax(vec3_dot(b, b), vec3_dot(d, d)));
        if (vec3_length(vec3_cross(a, b)) > THIN * w->rules->size * sqrt(square))
            good = mesh_add_triangle(w->ctx, &out->triangle, f->first, f->first + k, f->first + k + 1) &&
                   array_push(w->ctx, &out->triangle_panel, f->panel);
    }
    return good;
}

/* Facets by panel, and as triangles. */
static bool lay_out(panel_work *w, hull_panels *out, const int32_t *panel_of, int32_t *place)
{
    bool good = array_resize(w->ctx, &out->facet, w->facet.count);
    for (int32_t i = 0; i < w->facet.count; i++)
        place[panel_of[i] + 1]++;
    for (int32_t p = 0; p < out->panel.count; p++)
        place[p + 1] += place[p];
    for (int32_t i = 0; i < w->facet.count && good; i++)
        out->facet.data[place[panel_of[i]]++] =
            (panel_facet){panel_of[i], w->facet.data[i].face, w->facet.data[i].first, w->facet.data[i].count};
    for (int32_t i = 0; i < w->corner.count && good; i++)
        good = array_push(w->ctx, &out->corner, w->corner.data[i]) &&
               mesh_add_vertex(w->ctx, &out->triangle, w->corner.data[i]);
    for (int32_t i = 0; i < out->facet.count && good; i++)
        good = lay_triangles(w, out, &out->facet.data[i]);
    return good;
}

static fram_status gather(panel_work *w, hull_panels *out, fram_error *error)
{
    size_t count = (size_t)w->facet.count;
    int32_t *panel_of = memory_array(w->ctx, count + 1, sizeof *panel_of);
    int32_t *place = memory_array(w->ctx, count + 2, sizeof *place);
    bool good = panel_of && place;
    for (size_t i = 0; i < count && good; i++)
        panel_of[i] = -1;
    good = good && number_panels(w, out, panel_of) && lay_out(w, out, panel_of, place);
    memory_free(w->ctx, panel_of);
    memory_free(w->ctx, place);
    if (!good)
        return error_memory(error);
    if (out->panel.count > PANEL_MOST)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "panel",
                         "panels of %g m are %d on this hull, expected %d at most: take larger ones", w->rules->size,
                         (int)out->panel.count, (int)PANEL_MOST);
    out->bounds = mesh_bounds(&out->triangle);
    return mesh_bvh_build(w->ctx, &out->triangle, &out->tree) == FRAM_OK ? FRAM_OK : error_memory(error);
}

/* Finite and ascending, and one of them at least between the hull's ends: others cut nothing. */
static fram_status check_lines(const double *line, int32_t count, double lo, double hi, const char *key,
                               fram_error *error)
{
    bool inside = count == 0;
    for (int32_t i = 0; i < count; i++) {
        if (!isfinite(line[i]))
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, key, "expected finite coordinates, found %g", line[i]);
        if (i > 0 && !(line[i] > line[i - 1]))
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, key, "expected ascending coordinates, found %g after %g",
                             line[i], line[i - 1]);
        inside |= line[i] > lo && line[i] < hi;
    }
    return inside ? FRAM_OK
                  : error_set(error, FRAM_ERROR_INPUT, NULL, 0, key,
                              "expected coordinates in metres that cut the hull, which reaches from %.4g to %.4g m; "
                              "found %g to %g m",
                              lo, hi, line[0], line[count - 1]);
}

static fram_status check_rules(const mesh *hull, const panel_rules *rules, fram_error *error)
{
    box3 box = mesh_bounds(hull);
    vec3 span = vec3_sub(box.hi, box.lo);
    double longest = fmax(span.x, fmax(span.y, span.z));
    if (!(rules->size > 0 && rules->size <= longest))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "panel",
                         "expected a side above 0 and up to the hull's %g m, found %g m", longest, rules->size);
    fram_status status = check_lines(rules->frame, rules->frame_count, box.lo.x, box.hi.x, "frames", error);
    return status == FRAM_OK
               ? check_lines(rules->stringer, rules->stringer_count, box.lo.z, box.hi.z, "stringers", error)
               : status;
}

fram_status hull_panels_make(context *ctx, const mesh *hull, const panel_rules *rules, hull_panels *out,
                             fram_error *error)
{
    panel_work w = {.ctx = ctx, .hull = hull, .rules = rules};
    *out = (hull_panels){0};
    fram_status status = check_rules(hull, rules, error);
    if (status == FRAM_OK && mesh_adjacency_build(ctx, hull, &w.adjacency) != FRAM_OK)
        status = error_memory(error);
    if (status == FRAM_OK && !(find_patches(&w, out) && measure_patches(&w, out)))
        status = error_memory(error);
    if (status == FRAM_OK)
        status = cut_faces(&w, error);
    if (status == FRAM_OK) {
        sort_facets(&w);
        status = panels_connect(&w, error);
    }
    if (status == FRAM_OK)
        status = panels_join_slivers(&w, error);
    if (status == FRAM_OK)
        status = gather(&w, out, error);
    mesh_adjacency_free(ctx, &w.adjacency);
    array_free(ctx, &w.patch_of);
    array_free(ctx, &w.ruler);
    array_free(ctx, &w.facet);
    array_free(ctx, &w.corner);
    array_free(ctx, &w.first_of_face);
    array_free(ctx, &w.by_face);
    if (status != FRAM_OK)
        hull_panels_free(ctx, out);
    return status;
}

void hull_panels_free(context *ctx, hull_panels *p)
{
    array_free(ctx, &p->panel);
    array_free(ctx, &p->facet);
    array_free(ctx, &p->corner);
    array_free(ctx, &p->patch);
    mesh_free(ctx, &p->triangle);
    array_free(ctx, &p->triangle_panel);
    mesh_bvh_free(ctx, &p->tree);
    *p = (hull_panels){0};
}
