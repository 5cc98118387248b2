/* Packed fields; see field_pack.h. */
#include "ice/field_pack.h"

#include "base/transcendental.h"
#include "ice/field_cells.h"
#include "ice/field_measure.h"
#include "ice/packing.h"

#include <stdio.h>

/* Random streams: sizes and shapes of population p have the number of their stream plus p. */
enum { STREAM_SIZE = 0x1cf000, STREAM_SHAPE = 0x1d0000, MOST_POPULATIONS = 1000 };

/* Vertices of a piece of a floe that is present: as the packing takes them. */
enum { OBSTACLE_VERTICES = 24 };

/* A floe wider than this part of the domain leaves more water along its walls than the floes around can fill. */
static const double LARGE_FLOE = 0.1;

/* Area that the cover of a concave floe of mean diameter adds, relative; smaller ones, of which there are most and
   which hold little of the ice, have coarser covers, and all within limits. */
static const double COVER = 0.04, FINEST_COVER = 0.02, COARSEST_COVER = 0.06;

static fram_status check_population(const field_population *p, int32_t number, fram_error *error)
{
    const char *fault = size_law_fault(&p->size);
    const shape_law *s = &p->shape;
    if (!fault && !(p->share > 0 && p->share < HUGE_VAL))
        fault = "the share must be positive";
    if (!fault && s->templates && polygon_list_count(s->templates) < 1)
        fault = "there are no templates";
    if (!fault && !s->templates && !(s->least_vertices >= 3 && s->most_vertices <= SHAPE_MOST_VERTICES))
        fault = "polygons must have 3 to 64 vertices";
    if (!fault && !s->templates && s->most_vertices < s->least_vertices)
        fault = "the largest number of vertices must not be less than the smallest";
    if (!fault && !s->templates && !(s->elongation >= 1 && s->elongation <= 20))
        fault = "the elongation must be between 1 and 20";
    if (!fault)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "populations", "population %d: %s", number + 1, fault);
}

static fram_status check_request(const field_packed_request *r, fram_error *error)
{
    fram_status status = field_area_check(r->domain, r->concentration, r->keep_out, r->keep_out_margin, error);
    if (status != FRAM_OK)
        return status;
    if (r->population_count < 1 || r->population_count > MOST_POPULATIONS)
        return error_value(error, "populations", "1 to 1000 of them", r->population_count);
    for (int32_t i = 0; i < r->population_count; i++) {
        status = check_population(&r->populations[i], i, error);
        if (status != FRAM_OK)
            return status;
    }
    return FRAM_OK;
}

/* Scratch of one generation. */
typedef struct pack_state {
    polygon_list zones;     /* grown */
    polygon_list obstacles; /* zones and convex pieces of what is present */
    polygon_list shapes;    /* about their centroids */
    polygon_list covers;    /* of the shapes, with fewer vertices: what is packed first */
    vec2_array cover;
    bool ragged;            /* some cover is not the shape itself */
    field_floe_array drawn; /* of each shape */
    packing_pose_array poses;
    polygon_list floes;
    vec2_array ring;
    double free_area, present_area, drawn_area, largest;
} pack_state;

static void state_free(context *ctx, pack_state *s)
{
    polygon_list_free(ctx, &s->zones);
    polygon_list_free(ctx, &s->obstacles);
    polygon_list_free(ctx, &s->shapes);
    polygon_list_free(ctx, &s->covers);
    array_free(ctx, &s->cover);
    array_free(ctx, &s->drawn);
    array_free(ctx, &s->poses);
    polygon_list_free(ctx, &s->floes);
    array_free(ctx, &s->ring);
}

static void corners_of(box2 b, vec2 out[4])
{
    out[0] = b.lo;
    out[1] = (vec2){b.hi.x, b.lo.y};
    out[2] = b.hi;
    out[3] = (vec2){b.lo.x, b.hi.y};
}

/* Area of the domain outside all zones. */
static fram_status find_free_area(context *ctx, const field_packed_request *r, pack_state *s, fram_error *error)
{
    vec2 corner[4];
    corners_of(r->domain, corner);
    return cells_area_outside(ctx, (polygon){corner, 4}, &s->zones, &s->free_area, error);
}

/* Zones and floes that are there already. */
static fram_status find_obstacles(context *ctx, overlay *o, const field_packed_request *r, pack_state *s,
                                  fram_error *error)
{
    if (r->keep_out && !zones_grow(ctx, r->keep_out, r->keep_out_margin, &s->zones))
        return error_memory(error);
    for (int32_t i = 0; i < polygon_list_count(&s->zones); i++)
        if (!polygon_list_push(ctx, &s->obstacles, polygon_list_get(&s->zones, i)))
            return error_memory(error);
    vec2 corner[4];
    corners_of(r->domain, corner);
    for (int32_t i = 0; r->present && i < polygon_list_count(r->present); i++) {
        polygon p = polygon_list_get(r->present, i);
        s->present_area += polygon_overlap_area(p, (polygon){corner, 4});
        if (!polygon_is_convex(p)) {
            fram_status status = overlay_convex_pieces(o, p, 0, OBSTACLE_VERTICES, &s->obstacles, NULL, error);
            if (status != FRAM_OK)
                return status;
        } else if (!polygon_list_push(ctx, &s->obstacles, p)) {
            return error_memory(error);
        }
    }
    return find_free_area(ctx, r, s, error);
}

/* ---- drawing ---- */

static polygon ring_of(const pack_state *s) { return (polygon){s->ring.data, s->ring.count}; }

/* A ragged outline has many convex pieces, and hooks: what is packed first in its place covers it with far fewer.
   size: of the floe, over the mean. */
static bool add_cover(context *ctx, pack_state *s, double size)
{
    polygon shape = ring_of(s);
    if (polygon_is_convex(shape))
        return polygon_list_push(ctx, &s->covers, shape);
    s->ragged = true;
    double part = fmax(FINEST_COVER, fmin(COVER / size, COARSEST_COVER));
    return polygon_cover(ctx, shape, part, &s->cover) &&
           polygon_list_push(ctx, &s->covers, (polygon){s->cover.data, s->cover.count});
}

static fram_status draw_shapes(context *ctx, const field_packed_request *r, int32_t number, const real_array *sizes,
                               pack_state *s, fram_error *error)
{
    double mean = 0;
    for (int32_t i = 0; i < sizes->count; i++)
        mean += sizes->data[i] / sizes->count;
    for (int32_t i = 0; i < sizes->count; i++) {
        fram_status status = work_continue(ctx, "drawing the shapes of the floes", i, sizes->count, error);
        if (status != FRAM_OK)
            return status;
        random_stream stream = random_begin(r->seed, (uint32_t)(STREAM_SHAPE + number), (uint32_t)i);
        if (!shape_draw(ctx, &r->populations[number].shape, sizes->data[i], &stream, &s->ring) ||
            !polygon_list_push(ctx, &s->shapes, ring_of(s)) || !add_cover(ctx, s, sizes->data[i] / mean) ||
            !array_push(ctx, &s->drawn, ((field_floe){number, s->ring.count, polygon_area(ring_of(s))})))
            return error_memory(error);
        double d = sizes->data[i];
        s->drawn_area += PI / 4 * d * d;
        s->largest = fmax(s->largest, d);
    }
    return FRAM_OK;
}

static bool is_of_one_size(const field_packed_request *r, int32_t number, double *size)
{
    return size_law_is_one_size(&r->populations[number].size, size);
}

/* Whole floes of one size miss their part of the area: they are drawn first, the largest before the others. */
static int32_t next_to_draw(const field_packed_request *r, const real_array *sizes)
{
    int32_t next = -1;
    double largest = 0, size;
    for (int32_t p = 0; p < r->population_count; p++) {
        bool one = is_of_one_size(r, p, &size);
        if (sizes[p].count > 0 || !(next < 0 || (one && size > largest)))
            continue;
        next = p;
        largest = one ? size : 0;
    }
    return next;
}

/* Shares of those among which the area that is left goes. */
static double shares_left(const field_packed_request *r, const real_array *sizes)
{
    double sum = 0, size;
    for (int32_t p = 0; p < r->population_count; p++)
        if (sizes[p].count == 0 || !is_of_one_size(r, p, &size))
            sum += r->populations[p].share;
    return sum;
}

/* sizes: of each population, empty. */
static fram_status draw_sizes(context *ctx, const field_packed_request *r, double wanted, real_array *sizes,
                              fram_error *error)
{
    double left = wanted, size;
    fram_status status = FRAM_OK;
    for (int32_t k = 0; status == FRAM_OK && k < r->population_count; k++) {
        int32_t p = next_to_draw(r, sizes);
        const field_population *one = &r->populations[p];
        double area = left * one->share / shares_left(r, sizes);
        double floe = is_of_one_size(r, p, &size) ? PI / 4 * size * size : 0;
        /* Half a floe more would be drawn as a whole one, with no room for those that follow. */
        if (floe > 0 && k + 1 < r->population_count)
            area = fmin(area, left - floe / 2);
        status = size_law_draw(ctx, &one->size, area, r->seed, (uint32_t)(STREAM_SIZE + p), &sizes[p], error);
        left -= floe * sizes[p].count;
    }
    return status;
}

static fram_status draw_floes(context *ctx, const field_packed_request *r, pack_state *s, fram_error *error)
{
    double wanted = r->concentration * s->free_area - s->present_area;
    if (!(wanted > 0))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "concentration",
                         "concentration %g is reached already: the floes that are there cover %.6f of %g m2 of free "
                         "area; ask for more",
                         r->concentration, s->free_area > 0 ? s->present_area / s->free_area : 0, s->free_area);
    real_array *sizes = memory_array(ctx, (size_t)r->population_count, sizeof *sizes);
    fram_status status = sizes ? draw_sizes(ctx, r, wanted, sizes, error) : error_memory(error);
    for (int32_t p = 0; status == FRAM_OK && p < r->population_count; p++)
        status = draw_shapes(ctx, r, p, &sizes[p], s, error);
    for (int32_t p = 0; sizes && p < r->population_count; p++)
        array_free(ctx, &sizes[p]);
    memory_free(ctx, sizes);
    return status == FRAM_OK ? field_width_check(r->domain, s->largest, error) : status;
}

/* ---- packing ---- */

static fram_status impossible(const field_packed_request *r, const pack_state *s, const packing_report *p,
                              fram_error *error)
{
    double drawn = (s->present_area + s->drawn_area) / s->free_area;
    double reached = (s->present_area + p->scale * p->scale * s->drawn_area) / s->free_area;
    double narrow = fmin(r->domain.hi.x - r->domain.lo.x, r->domain.hi.y - r->domain.lo.y);
    bool walls = !(r->periodic_x && r->periodic_y) && s->largest > LARGE_FLOE * narrow;
    char found[100], why[120] = "";
    if (p->scale > 0)
        snprintf(found, sizeof found, "concentration %.4f was reached", reached);
    else
        snprintf(found, sizeof found, "not even a much lower concentration was reached");
    if (walls)
        snprintf(why, sizeof why, ", and walls keep water beside floes of up to %.3g m in a domain %.4g m wide",
                 s->largest, narrow);
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "concentration",
                     "concentration %g cannot be reached with these floes: at %.4f, %d floes overlap by up to %.3g m "
                     "after %d rounds and jam; %s. Rigid floes that are nearly equal or round leave the most water%s: "
                     "ask for less, or for a wider size law, fewer vertices%s, or source voronoi",
                     r->concentration, drawn, polygon_list_count(&s->shapes), p->overlap, p->rounds, found, why,
                     walls ? ", a larger domain" : "");
}

static fram_status place_floes(context *ctx, overlay *o, const field_packed_request *r, pack_state *s,
                               field_packed_report *report, fram_error *error)
{
    const packing_request packing = {.domain = r->domain,
                                     .periodic_x = r->periodic_x,
                                     .periodic_y = r->periodic_y,
                                     .shapes = &s->shapes,
                                     .coarse = s->ragged ? &s->covers : NULL,
                                     .obstacles = &s->obstacles,
                                     .seed = r->seed,
                                     .effort = r->effort};
    packing_report found;
    fram_status status = packing_solve(ctx, o, &packing, &s->poses, &found, error);
    if (status != FRAM_OK)
        return status;
    if (!found.done)
        return impossible(r, s, &found, error);
    report->rounds = found.rounds;
    report->moves = found.moves;
    for (int32_t i = 0; i < polygon_list_count(&s->shapes); i++) {
        const field_floe *drawn = &s->drawn.data[i];
        if (!packing_outline(ctx, polygon_list_get(&s->shapes, i), s->poses.data[i], &s->ring) ||
            !polygon_list_push(ctx, &s->floes, ring_of(s)))
            return error_memory(error);
        double change = fabs(polygon_area(ring_of(s)) - drawn->area) / drawn->area;
        report->area_change = fmax(report->area_change, change);
        report->vertex_changes += s->ring.count != drawn->vertices;
    }
    return FRAM_OK;
}

/* ---- what came of it ---- */

bool field_population_measure(context *ctx, const size_law *law, const polygon_list *floes, const field_floe *drawn,
                              int32_t number, field_population_report *out)
{
    real_array diameter = {0};
    bool good = true;
    *out = (field_population_report){0};
    for (int32_t i = 0; good && i < polygon_list_count(floes); i++) {
        if (drawn && drawn[i].population != number)
            continue;
        double area = polygon_area(polygon_list_get(floes, i));
        out->area += area;
        good = array_push(ctx, &diameter, sqrt(area * 4 / PI));
    }
    out->floes = diameter.count;
    out->size_distance = size_law_distance(law, diameter.data, diameter.count);
    size_law_histogram(law, diameter.data, diameter.count, &out->sizes);
    array_free(ctx, &diameter);
    return good;
}

static fram_status report_field(context *ctx, overlay *o, const field_packed_request *r, const pack_state *s,
                                field_population_report *parts, field_packed_report *report, fram_error *error)
{
    for (int32_t p = 0; p < r->population_count; p++)
        if (!field_population_measure(ctx, &r->populations[p].size, &s->floes, s->drawn.data, p, &parts[p]))
            return error_memory(error);
    double area = s->present_area;
    for (int32_t p = 0; p < r->population_count; p++)
        area += parts[p].area;
    report->field = (field_report){
        .floes = polygon_list_count(&s->floes), .concentration = area / s->free_area, .free_area = s->free_area};
    return field_largest_overlap(ctx, o, &s->floes, r->present, &report->field.largest_overlap, error);
}

static bool append_floes(context *ctx, const pack_state *s, polygon_list *outlines, field_floe_array *floes)
{
    /* All room is made before anything is appended, so that a failure changes nothing. */
    if (!array_reserve(ctx, &outlines->vertex, outlines->vertex.count + s->floes.vertex.count) ||
        !array_reserve(ctx, &outlines->start, outlines->start.count + s->floes.start.count + 1) ||
        !array_reserve(ctx, floes, floes->count + s->drawn.count))
        return false;
    for (int32_t i = 0; i < polygon_list_count(&s->floes); i++) {
        polygon_list_push(ctx, outlines, polygon_list_get(&s->floes, i));
        floes->data[floes->count++] = s->drawn.data[i];
    }
    return true;
}

fram_status field_packed(context *ctx, overlay *o, const field_packed_request *request, polygon_list *outlines,
                         field_floe_array *floes, field_population_report *parts, field_packed_report *report,
                         fram_error *error)
{
    fram_status status = check_request(request, error);
    if (status != FRAM_OK)
        return status;
    pack_state s = {0};
    field_packed_report found = {0};
    status = find_obstacles(ctx, o, request, &s, error);
    if (status == FRAM_OK)
        status = field_room_check(s.free_area, error);
    if (status == FRAM_OK)
        status = draw_floes(ctx, request, &s, error);
    if (status == FRAM_OK)
        status = place_floes(ctx, o, request, &s, &found, error);
    if (status == FRAM_OK)
        status = report_field(ctx, o, request, &s, parts, &found, error);
    if (status == FRAM_OK && !append_floes(ctx, &s, outlines, floes))
        status = error_memory(error);
    if (status == FRAM_OK)
        *report = found;
    state_free(ctx, &s);
    return status;
}
