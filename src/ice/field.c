/* Managed ice from Voronoi cells; see field.h. */
#include "ice/field.h"

#include "base/random.h"
#include "geometry/voronoi.h"
#include "ice/field_cells.h"
#include "ice/field_measure.h"
#include "ice/field_sized.h"

/* More cells than this are a mistake in the units rather than a field. */
enum { MOST_CELLS = 20000000 };

/* Share of the open water that corners never take: with roundness 1 neighbours still stay apart. */
static const double GAP_SHARE = 0.1;

/* Pieces of cells beside a keep-out zone under this part of the mean cell are slivers, and left as open water. */
static const double SMALLEST_PIECE = 0.02;

static fram_status request_check(const field_request *r, fram_error *error)
{
    fram_status status = field_area_check(r->domain, r->concentration, r->keep_out, r->keep_out_margin, error);
    if (status != FRAM_OK)
        return status;
    vec2 size = vec2_sub(r->domain.hi, r->domain.lo);
    if (!r->size && !(r->mean_area > 0 && size.x * size.y / r->mean_area <= MOST_CELLS))
        return error_value(error, "mean_area", "an area over 0 m2 that makes at most 20 million cells", r->mean_area);
    if (!(r->size_deviation >= 0 && r->size_deviation <= 1))
        return error_value(error, "size_deviation", "a number from 0 to 1", r->size_deviation);
    if (!(r->roundness >= 0 && r->roundness <= 1))
        return error_value(error, "roundness", "a number from 0 to 1", r->roundness);
    if (!(r->smallest_area >= 0 && r->smallest_area < HUGE_VAL))
        return error_value(error, "smallest_area", "an area of 0 m2 or more", r->smallest_area);
    if (r->size && size_law_fault(r->size))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "populations", "%s", size_law_fault(r->size));
    return FRAM_OK;
}

/* A coordinate that the scatter took out of [lo, hi] comes back from the edge as from a mirror. */
static double reflect(double x, double lo, double hi) { return x < lo ? 2 * lo - x : x > hi ? 2 * hi - x : x; }

/* Sites and their copies in the neighbouring tiles are looked for this many grid cells beyond the edge: far enough that
   nothing farther off has a say in a cell. */
enum { PERIODIC_CELLS = 4 };

/* Copies of the sites around the domain, as they repeat themselves; box: what they fill. */
static bool repeat_sites(context *ctx, const field_request *r, vec2 step, vec2_array *sites, box2 *box)
{
    vec2 size = vec2_sub(r->domain.hi, r->domain.lo);
    vec2 rim = vec2_make(fmin(PERIODIC_CELLS * step.x, size.x / 2), fmin(PERIODIC_CELLS * step.y, size.y / 2));
    *box = (box2){vec2_sub(r->domain.lo, rim), vec2_add(r->domain.hi, rim)};
    int32_t own = sites->count;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++)
            for (int32_t k = 0; (i || j) && k < own; k++) {
                vec2 p = vec2_add(sites->data[k], vec2_make(i * size.x, j * size.y));
                bool near = p.x >= box->lo.x && p.x <= box->hi.x && p.y >= box->lo.y && p.y <= box->hi.y;
                if (near && !array_push(ctx, sites, p))
                    return false;
            }
    return true;
}

/* Rows of a triangular grid, whose Voronoi cells are hexagons, each site moved at random within its grid cell.
   own: their number, without copies; box: what cells and copies fill. */
static bool scatter_sites(context *ctx, const field_request *r, vec2_array *sites, int32_t *own, box2 *box)
{
    vec2 size = vec2_sub(r->domain.hi, r->domain.lo);
    /* A domain narrower than a cell is one row: no more columns than cells. */
    double columns = floor(fmin(size.x / sqrt(2 * r->mean_area / sqrt(3)), size.x * size.y / r->mean_area) + 0.5);
    int32_t nx = columns < 1 ? 1 : (int32_t)columns;
    double rows = floor(size.x * size.y / (r->mean_area * nx) + 0.5);
    int32_t ny = rows < 1 ? 1 : (int32_t)rows;
    if (r->periodic && ny % 2)
        ny++; /* every other row is staggered, across the seam too */
    vec2 step = {size.x / nx, size.y / ny};
    if (!array_reserve(ctx, sites, nx * ny))
        return false;
    for (int32_t j = 0; j < ny; j++)
        for (int32_t i = 0; i < nx; i++) {
            random_stream stream = random_begin(r->seed, ICE_STREAM_VORONOI_SITE, (uint32_t)(j * nx + i));
            double u = random_unit(&stream) - 0.5, v = random_unit(&stream) - 0.5;
            /* One row alone has nothing to be staggered against. */
            double stagger = ny == 1 ? 0.5 : j % 2 ? 0.75 : 0.25;
            vec2 site = {r->domain.lo.x + (i + stagger + r->size_deviation * u) * step.x,
                         r->domain.lo.y + (j + 0.5 + r->size_deviation * v) * step.y};
            if (!r->periodic)
                site = vec2_make(reflect(site.x, r->domain.lo.x, r->domain.hi.x),
                                 reflect(site.y, r->domain.lo.y, r->domain.hi.y));
            sites->data[sites->count++] = site;
        }
    *own = sites->count;
    *box = r->domain;
    return !r->periodic || repeat_sites(ctx, r, step, sites, box);
}

/* Scratch of one generation. */
typedef struct field_work {
    vec2_array sites;
    polygon_list zones;   /* grown */
    polygon_list voronoi; /* the cells as they tile the domain */
    polygon_list parts;   /* of cells, outside the zones */
    polygon_list kept;    /* parts that are large enough so far */
    polygon_list cut;     /* kept, with cut corners */
    polygon_list floes;   /* cut, moved inwards */
    cells_scratch scratch;
} field_work;

static void field_work_free(context *ctx, field_work *w)
{
    array_free(ctx, &w->sites);
    polygon_list_free(ctx, &w->zones);
    polygon_list_free(ctx, &w->voronoi);
    polygon_list_free(ctx, &w->parts);
    polygon_list_free(ctx, &w->kept);
    polygon_list_free(ctx, &w->cut);
    polygon_list_free(ctx, &w->floes);
    cells_scratch_free(ctx, &w->scratch);
}

/* Appends the members of `in` whose counterparts in `measured` have at least `least` area. */
static bool keep_large(context *ctx, const polygon_list *in, const polygon_list *measured, double least,
                       polygon_list *out)
{
    for (int32_t i = 0; i < polygon_list_count(in); i++) {
        polygon p = polygon_list_get(measured, i);
        if (p.count >= 3 && polygon_area(p) >= least && !polygon_list_push(ctx, out, polygon_list_get(in, i)))
            return false;
    }
    return true;
}

static fram_status unreachable(const field_request *r, const field_work *w, double free_area, double covered,
                               fram_error *error)
{
    return error_set(
        error, FRAM_ERROR_INPUT, NULL, 0, "concentration",
        "concentration %g cannot be reached: without any gap the %d cells that may become floes cover %.6f of "
        "%g m2 of free area; %d of %d pieces are under the smallest area (%g m2) or slivers beside a keep-out "
        "zone; lower the concentration or the smallest area",
        r->concentration, polygon_list_count(&w->kept), covered / free_area, free_area,
        polygon_list_count(&w->parts) - polygon_list_count(&w->kept), polygon_list_count(&w->parts), r->smallest_area);
}

/* Cuts corners and widens the gap of w->kept until w->floes has the target area; drops what becomes too small and
   starts over with the rest. */
static fram_status shrink_to_target(context *ctx, const field_request *r, field_work *w, double free_area, double *gap,
                                    fram_error *error)
{
    double target = r->concentration * free_area;
    for (;;) {
        double covered = cells_area(&w->kept), surplus = covered - target;
        if (!(surplus >= 0))
            return unreachable(r, w, free_area, covered, error);
        double inset;
        fram_status status = cells_shrink(ctx, &w->kept, r->roundness * (1 - GAP_SHARE), target, &w->scratch, &w->cut,
                                          &w->floes, &inset, error);
        if (status != FRAM_OK)
            return status;
        *gap = 2 * inset;
        polygon_list_clear(&w->cut);
        if (!keep_large(ctx, &w->kept, &w->floes, r->smallest_area, &w->cut))
            return error_memory(error);
        if (polygon_list_count(&w->cut) == polygon_list_count(&w->kept))
            return FRAM_OK;
        polygon_list swap = w->kept;
        w->kept = w->cut;
        w->cut = swap;
    }
}

/* The cells as they tile the domain. */
static fram_status make_cells(context *ctx, const field_request *r, field_work *w, fram_error *error)
{
    if (r->size) {
        const sized_request sized = {.domain = r->domain,
                                     .periodic = r->periodic,
                                     .concentration = r->concentration,
                                     .corners = r->roundness * (1 - GAP_SHARE),
                                     .law = r->size,
                                     .seed = r->seed};
        return sized_cells(ctx, &sized, &w->voronoi, error);
    }
    box2 box;
    int32_t own = 0;
    if (!scatter_sites(ctx, r, &w->sites, &own, &box))
        return error_memory(error);
    fram_status status = voronoi_cells(ctx, w->sites.data, NULL, w->sites.count, box, &w->voronoi, error);
    if (status == FRAM_OK && r->periodic) {
        /* The copies have shaped the cells along the seams, and come after all others. */
        w->voronoi.start.count = own + 1;
        w->voronoi.vertex.count = w->voronoi.start.data[own];
    }
    return status;
}

static fram_status make_floes(context *ctx, const field_request *r, field_work *w, field_report *report,
                              fram_error *error)
{
    if (r->keep_out && !zones_grow(ctx, r->keep_out, r->keep_out_margin, &w->zones))
        return error_memory(error);
    fram_status status = make_cells(ctx, r, w, error);
    if (status != FRAM_OK)
        return status;
    status = cells_outside_zones(ctx, &w->voronoi, &w->zones, &w->scratch, &w->parts, error);
    if (status != FRAM_OK)
        return status;
    /* The cells tile the domain, so that what is left of them is the free area. */
    double free_area = cells_area(&w->parts);
    status = field_room_check(free_area, error);
    if (status != FRAM_OK)
        return status;
    double mean_area = cells_area(&w->voronoi) / polygon_list_count(&w->voronoi);
    double sliver = polygon_list_count(&w->zones) ? SMALLEST_PIECE * mean_area : 0;
    if (!keep_large(ctx, &w->parts, &w->parts, fmax(r->smallest_area, sliver), &w->kept))
        return error_memory(error);
    double gap = 0;
    status = shrink_to_target(ctx, r, w, free_area, &gap, error);
    if (status != FRAM_OK)
        return status;
    double overlap = 0;
    status = field_largest_overlap(ctx, NULL, &w->floes, NULL, &overlap, error);
    if (status != FRAM_OK)
        return status;
    *report = (field_report){.floes = polygon_list_count(&w->floes),
                             .concentration = cells_area(&w->floes) / free_area,
                             .free_area = free_area,
                             .largest_overlap = overlap,
                             .gap = gap};
    return FRAM_OK;
}

fram_status field_voronoi(context *ctx, const field_request *request, polygon_list *outlines, field_report *report,
                          fram_error *error)
{
    fram_status status = request_check(request, error);
    if (status != FRAM_OK)
        return status;
    field_work work = {0};
    field_report found = {0};
    status = make_floes(ctx, request, &work, &found, error);
    /* All room is made before anything is appended, so that a failure changes nothing. */
    if (status == FRAM_OK &&
        (!array_reserve(ctx, &outlines->vertex, outlines->vertex.count + work.floes.vertex.count) ||
         !array_reserve(ctx, &outlines->start, outlines->start.count + work.floes.start.count + 1)))
        status = error_memory(error);
    if (status == FRAM_OK) {
        for (int32_t i = 0; i < found.floes; i++)
            polygon_list_push(ctx, outlines, polygon_list_get(&work.floes, i));
        *report = found;
    }
    field_work_free(ctx, &work);
    return status;
}
