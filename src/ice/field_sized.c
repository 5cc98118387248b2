#include "ice/field_sized.h"

#include "base/transcendental.h"
#include "geometry/voronoi.h"
#include "ice/field_cells.h"
#include "ice/packing.h"

/* Cells begin at the middles of packed regular polygons, of as many vertices and of this part of the cells' areas. */
enum { MARKER_VERTICES = 8 };
static const double MARKER_PART = 0.65;
/* Rounds of moving weights at most, in the first of which sites move too, and the mean relative error of the floes'
   areas that ends them; one over POOR_AREAS in the end is no field of the law: its Kolmogorov and Smirnov's distance
   is about as large. */
enum { MOST_ROUNDS = 300, SITE_ROUNDS = 50 };
static const double GOOD_AREAS = 0.002, POOR_AREAS = 0.02;
/* What a weight does to the area of its cell is edge over twice the distance, summed over the edges: 2 sqrt(3) / 2 for
   a hexagon.  Steps are this part of what would set one cell right alone: its neighbours move too. */
static const double AREA_PER_WEIGHT = 1.7320508075688772, STEP = 0.4;
/* Part of a step that the next one goes on with (heavy ball, Polyak 1964): errors that reach over many cells would take
   rounds like the square of their number otherwise. */
static const double MOMENTUM = 0.85;
/* Copies of sites beyond the edge are needed as far as this many of the largest diameters. */
static const double RIM = 1.5;

typedef struct sized_work {
    real_array diameter;     /* of the floes */
    real_array weight, step; /* the last change of each weight */
    double floes;            /* area of all [m2] */
    vec2_array site;
    vec2_array all_site; /* with copies beyond the edge */
    real_array all_weight;
    polygon_list cells, cut, shrunk; /* shrunk: the floes that the cells would become */
    cells_scratch scratch;
    double largest;
} sized_work;

static void sized_work_free(context *ctx, sized_work *w)
{
    array_free(ctx, &w->diameter);
    array_free(ctx, &w->weight);
    array_free(ctx, &w->step);
    array_free(ctx, &w->site);
    array_free(ctx, &w->all_site);
    array_free(ctx, &w->all_weight);
    polygon_list_free(ctx, &w->cells);
    polygon_list_free(ctx, &w->cut);
    polygon_list_free(ctx, &w->shrunk);
    cells_scratch_free(ctx, &w->scratch);
}

static double floe_area(const sized_work *w, int32_t i)
{
    double d = w->diameter.data[i];
    return PI / 4 * d * d;
}

/* Diameters of the floes, and weights that would make discs of the cells. */
static fram_status find_areas(context *ctx, const sized_request *r, sized_work *w, fram_error *error)
{
    vec2 size = vec2_sub(r->domain.hi, r->domain.lo);
    double whole = size.x * size.y, floes = 0;
    fram_status status =
        size_law_draw(ctx, r->law, r->concentration * whole, r->seed, ICE_STREAM_SIZED, &w->diameter, error);
    if (status != FRAM_OK)
        return status;
    for (int32_t i = 0; i < w->diameter.count; i++) {
        floes += floe_area(w, i);
        w->largest = fmax(w->largest, w->diameter.data[i]);
    }
    status = field_width_check(r->domain, w->largest, error);
    if (status != FRAM_OK)
        return status;
    if (floes > whole)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "domain",
                         "the fewest floes of this law for the concentration, %d, cover %g m2 and the domain "
                         "has only %g m2; make the domain larger or the floes smaller",
                         w->diameter.count, floes, whole);
    w->floes = floes;
    for (int32_t i = 0; i < w->diameter.count; i++)
        if (!array_push(ctx, &w->weight, floe_area(w, i) / floes * whole / PI) || !array_push(ctx, &w->step, 0))
            return error_memory(error);
    return FRAM_OK;
}

/* First sites: where polygons of such sizes lie when they are packed loosely. */
static fram_status find_sites(context *ctx, const sized_request *r, sized_work *w, fram_error *error)
{
    polygon_list markers = {0};
    packing_pose_array poses = {0};
    packing_report report;
    double unit = 0.5 * MARKER_VERTICES * real_sin(2 * PI / MARKER_VERTICES); /* area at radius 1 */
    bool good = true;
    for (int32_t i = 0; good && i < w->weight.count; i++) {
        vec2 corner[MARKER_VERTICES];
        double radius = sqrt(MARKER_PART * PI * w->weight.data[i] / unit);
        for (int k = 0; k < MARKER_VERTICES; k++) {
            double angle = 2 * PI * k / MARKER_VERTICES;
            corner[k] = (vec2){radius * real_cos(angle), radius * real_sin(angle)};
        }
        good = polygon_list_push(ctx, &markers, (polygon){corner, MARKER_VERTICES});
    }
    const packing_request packing = {.domain = r->domain,
                                     .periodic_x = r->periodic,
                                     .periodic_y = r->periodic,
                                     .shapes = &markers,
                                     .seed = r->seed,
                                     .effort = 0.1};
    fram_status status = good ? packing_solve(ctx, NULL, &packing, &poses, &report, error) : error_memory(error);
    for (int32_t i = 0; status == FRAM_OK && i < poses.count; i++)
        if (!array_push(ctx, &w->site, poses.data[i].centre))
            status = error_memory(error);
    polygon_list_free(ctx, &markers);
    array_free(ctx, &poses);
    return status;
}

/* ---- rounds ---- */

static double back_inside(double x, double lo, double hi, bool periodic)
{
    if (periodic)
        return x - (hi - lo) * floor((x - lo) / (hi - lo));
    return x < lo ? lo : x > hi ? hi : x;
}

/* All sites, and copies of those near the other edge. */
static bool list_sites(context *ctx, const sized_request *r, sized_work *w, box2 *box)
{
    vec2 size = vec2_sub(r->domain.hi, r->domain.lo);
    double rim = r->periodic ? fmin(RIM * w->largest, 0.5 * fmin(size.x, size.y)) : 0;
    *box = (box2){{r->domain.lo.x - rim, r->domain.lo.y - rim}, {r->domain.hi.x + rim, r->domain.hi.y + rim}};
    array_clear(&w->all_site);
    array_clear(&w->all_weight);
    for (int n = 0; n < (r->periodic ? 9 : 1); n++) {
        /* The sites themselves come first. */
        int x = n == 0 ? 0 : n % 3 - 1, y = n == 0 ? 0 : n / 3 - 1;
        if (n == 4)
            x = y = -1;
        for (int32_t i = 0; i < w->site.count; i++) {
            vec2 p = vec2_add(w->site.data[i], (vec2){x * size.x, y * size.y});
            bool in = p.x >= box->lo.x && p.x <= box->hi.x && p.y >= box->lo.y && p.y <= box->hi.y;
            if ((n == 0 || in) &&
                (!array_push(ctx, &w->all_site, p) || !array_push(ctx, &w->all_weight, w->weight.data[i])))
                return false;
        }
    }
    return true;
}

static fram_status make_weighted_cells(context *ctx, const sized_request *r, sized_work *w, fram_error *error)
{
    box2 box;
    if (!list_sites(ctx, r, w, &box))
        return error_memory(error);
    polygon_list_clear(&w->cells);
    fram_status status =
        voronoi_cells(ctx, w->all_site.data, w->all_weight.data, w->all_site.count, box, &w->cells, error);
    if (status == FRAM_OK) {
        /* The copies have shaped the cells along the seams, and come after all others. */
        w->cells.start.count = w->site.count + 1;
        w->cells.vertex.count = w->cells.start.data[w->site.count];
    }
    return status;
}

/* Weights towards the areas that the floes should have, by the floes that the cells would become.  off: the mean
   relative error of their areas before. */
static fram_status improve_weights(context *ctx, const sized_request *r, sized_work *w, double momentum, double *off,
                                   fram_error *error)
{
    double inset;
    fram_status status =
        cells_shrink(ctx, &w->cells, r->corners, w->floes, &w->scratch, &w->cut, &w->shrunk, &inset, error);
    if (status != FRAM_OK)
        return status;
    *off = 0;
    for (int32_t i = 0; i < w->site.count; i++) {
        polygon floe = polygon_list_get(&w->shrunk, i);
        double missing = floe_area(w, i) - (floe.count >= 3 ? polygon_area(floe) : 0);
        *off += fabs(missing) / floe_area(w, i) / w->site.count;
        w->step.data[i] = momentum * w->step.data[i] + STEP * missing / AREA_PER_WEIGHT;
        w->weight.data[i] += w->step.data[i];
    }
    return FRAM_OK;
}

/* Sites to the middles of their cells. */
static void move_sites(const sized_request *r, sized_work *w)
{
    for (int32_t i = 0; i < w->site.count; i++) {
        polygon cell = polygon_list_get(&w->cells, i);
        if (cell.count < 3)
            continue;
        vec2 middle = polygon_moments_of(cell).centroid;
        w->site.data[i] = (vec2){back_inside(middle.x, r->domain.lo.x, r->domain.hi.x, r->periodic),
                                 back_inside(middle.y, r->domain.lo.y, r->domain.hi.y, r->periodic)};
    }
}

/* Rounds until the areas are met. */
static fram_status improve_cells(context *ctx, const sized_request *r, sized_work *w, fram_error *error)
{
    double off = 0;
    for (int k = 0; k < MOST_ROUNDS; k++) {
        fram_status status = improve_weights(ctx, r, w, k < SITE_ROUNDS ? 0 : MOMENTUM, &off, error);
        if (status != FRAM_OK || (k >= SITE_ROUNDS && off < GOOD_AREAS))
            return status;
        if (k < SITE_ROUNDS)
            move_sites(r, w);
        status = make_weighted_cells(ctx, r, w, error);
        if (status != FRAM_OK)
            return status;
    }
    if (off <= POOR_AREAS)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "populations",
                     "the law of size is not met by cells: after %d rounds the areas of %d floes are off by %.2g %% on "
                     "the mean (%g %% is allowed); ask for a narrower law, a larger domain%s or source packed",
                     MOST_ROUNDS, w->site.count, 100 * off, 100 * POOR_AREAS,
                     r->periodic ? "" : ", a periodic boundary");
}

fram_status sized_cells(context *ctx, const sized_request *r, polygon_list *cells, fram_error *error)
{
    sized_work w = {0};
    fram_status status = find_areas(ctx, r, &w, error);
    if (status == FRAM_OK)
        status = find_sites(ctx, r, &w, error);
    if (status == FRAM_OK)
        status = make_weighted_cells(ctx, r, &w, error);
    if (status == FRAM_OK)
        status = improve_cells(ctx, r, &w, error);
    for (int32_t i = 0; status == FRAM_OK && i < w.site.count; i++)
        if (!polygon_list_push(ctx, cells, polygon_list_get(&w.cells, i)))
            status = error_memory(error);
    sized_work_free(ctx, &w);
    return status;
}
