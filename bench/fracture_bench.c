/* The cost of fracture:  fracture_bench [ROUNDS]

   1. A bending event (a floe of 16 vertices, N = 3), re-meshing included, beside the bare GEOS calls of the same cuts:
      one difference and six intersections, geometries made and read back, on the same outline, interleaved.
   2. Bites along a channel in a level sheet: time of an event, and size of the shape store as the channel grows: what
   it holds, what of that lives, and what an event finds around itself.
   3. Fracture's share of the steps of scenes/level_ice.yaml (run it in the folder of the sources). */
#include "base/random.h"
#include "base/transcendental.h"
#include "fracture_rig.h"
#include "ice/fracture_parts.h"
#include "io/scenario_file.h"
#include "sim/build.h"
#include "sim/step.h"

#include <geos_c.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { CORNERS = 16, STENCIL = 2 * WEDGES, SAMPLES = 20000, BITES = 5100, NEAR = 200 };

/* What counts as around a bite [m]. */
static const double AROUND = 100;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static double median(double *x, int n)
{
    qsort(x, (size_t)n, sizeof *x, compare);
    return n > 0 ? x[n / 2] : 0;
}

/* Returns the time [s]. */
static double break_once(rig *r)
{
    double begin = now();
    break_loaded(r);
    return now() - begin;
}

/* ---- bare GEOS ---- */

static void quiet(const char *format, ...) { (void)format; }

static GEOSGeometry *geometry_of(GEOSContextHandle_t g, polygon p)
{
    GEOSCoordSequence *c = GEOSCoordSeq_create_r(g, (unsigned)p.count + 1, 2);
    for (int32_t i = 0; i <= p.count; i++)
        GEOSCoordSeq_setXY_r(g, c, (unsigned)i, p.vertex[i % p.count].x, p.vertex[i % p.count].y);
    return GEOSGeom_createPolygon_r(g, GEOSGeom_createLinearRing_r(g, c), NULL, 0);
}

static double read_back(GEOSContextHandle_t g, const GEOSGeometry *made)
{
    double sum = 0;
    for (int i = 0; i < GEOSGetNumGeometries_r(g, made); i++) {
        const GEOSGeometry *part = GEOSGetGeometryN_r(g, made, i);
        if (GEOSGeomTypeId_r(g, part) != GEOS_POLYGON)
            continue;
        const GEOSCoordSequence *c = GEOSGeom_getCoordSeq_r(g, GEOSGetExteriorRing_r(g, part));
        unsigned n = 0;
        GEOSCoordSeq_getSize_r(g, c, &n);
        for (unsigned k = 0; k < n; k++) {
            double x, y;
            GEOSCoordSeq_getXY_r(g, c, k, &x, &y);
            sum += x + y;
        }
    }
    return sum;
}

static double bare(GEOSContextHandle_t g, polygon floe, const vec2 stencil[STENCIL], vec2 tip, double *check)
{
    double begin = now();
    GEOSGeometry *subject = geometry_of(g, floe);
    GEOSGeometry *clip = geometry_of(g, (polygon){stencil, STENCIL}), *made = GEOSDifference_r(g, subject, clip);
    *check += read_back(g, made);
    GEOSGeom_destroy_r(g, made);
    GEOSGeom_destroy_r(g, clip);
    for (int i = 0; i < STENCIL; i++) {
        const vec2 wedge[3] = {tip, stencil[i], stencil[(i + 1) % STENCIL]};
        clip = geometry_of(g, (polygon){wedge, 3});
        made = GEOSIntersection_r(g, subject, clip);
        *check += read_back(g, made);
        GEOSGeom_destroy_r(g, made);
        GEOSGeom_destroy_r(g, clip);
    }
    GEOSGeom_destroy_r(g, subject);
    return now() - begin;
}

static void bench_event(int rounds, bool concave)
{
    rig r;
    rig_make(&r);
    GEOSContextHandle_t g = GEOS_init_r();
    GEOSContext_setNoticeHandler_r(g, quiet);
    GEOSContext_setErrorHandler_r(g, quiet);
    double *ours = calloc((size_t)rounds, sizeof *ours), *theirs = calloc((size_t)rounds, sizeof *theirs), check = 0;
    int n = 0;
    for (int i = 0; i < rounds; i++) {
        random_stream s = random_begin(1, 1, (uint32_t)i);
        vec2 outline[CORNERS];
        for (int k = 0; k < CORNERS; k++) {
            double angle = 2 * PI * (k + 0.5 * random_unit(&s)) / CORNERS;
            double radius = concave ? random_uniform(&s, 24, 30) : 30;
            outline[k] = (vec2){radius * real_cos(angle), radius * real_sin(angle)};
        }
        int32_t row = add_floe(&r, (polygon){outline, CORNERS}, MOTION_DYNAMIC, 0);
        vec2 load = vec2_scale(outline[i % CORNERS], 0.98);
        add_load(&r, row, load, 1e7, 1);
        double time = break_once(&r);
        if (r.events.count == 1) {
            crack_start start = crack_start_of((polygon){outline, CORNERS}, load, 1e-6);
            vec2 stencil[MOST_STENCIL];
            fracture_stencil(WEDGES, fracture_wedge_side(&r.settings, r.events.data[0].crack_length), &start, stencil);
            ours[n] = time;
            theirs[n++] = bare(g, (polygon){outline, CORNERS}, stencil, start.point, &check);
        }
        remove_moving(&r);
    }
    double a = median(ours, n), b = median(theirs, n);
    printf("%s floe, 16 vertices, N = 3: event %.1f us, bare GEOS %.1f us, ratio %.2f (%d events)\n",
           concave ? "concave" : "convex", 1e6 * a, 1e6 * b, a / b, n);
    free(ours);
    free(theirs);
    GEOS_finish_r(g);
}

/* ---- a channel ---- */

static int32_t tile_at(const rig *r, vec2 place)
{
    int32_t best = -1;
    double least = HUGE_VAL;
    for (int32_t i = 0; i < r->floes.count; i++) {
        if (r->floes.body[i] < 0 || r->floes.tile[i] == 0)
            continue;
        vec3 at = r->bodies.position[r->floes.body[i]];
        if (fabs(at.x - place.x) + fabs(at.y - place.y) > 100)
            continue;
        polygon p = shape_outline(&r->shapes, r->bodies.shape[r->floes.body[i]]);
        vec2 local = {place.x - at.x, place.y - at.y}, near = polygon_nearest_boundary(p, local, NULL);
        double way = polygon_contains(p, local) ? 0 : vec2_length(vec2_sub(near, local));
        if (way < least) {
            least = way;
            best = i;
        }
    }
    return best;
}

/* Vertices of a shape: its outline, and its convex pieces where there are several. */
static int vertices_of(const shape_store *s, int32_t shape)
{
    int sum = s->shapes.outline_count[shape];
    for (int32_t p = 0; p < s->shapes.piece_count[shape] && s->shapes.piece_count[shape] > 1; p++)
        sum += shape_piece(s, shape, p).count;
    return sum;
}

/* Of the shapes of all tiles, or of those whose centre is within `reach` of x. */
static int living_vertices(const rig *r, double x, double reach)
{
    int sum = 0;
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0 && fabs(r->bodies.position[r->floes.body[i]].x - x) <= reach)
            sum += vertices_of(&r->shapes, r->bodies.shape[r->floes.body[i]]);
    return sum;
}

/* What is measured at every bite. */
typedef struct channel_log {
    double time[BITES];   /* of the event [s] */
    double around[BITES]; /* vertices within AROUND of the bite */
    double tile[BITES];   /* vertices of the tile that is loaded, before the bite */
    int held[BITES];      /* vertices that the shape store has room in use for, dead ones too */
    int living[BITES];    /* vertices of shapes that floes have */
} channel_log;

static void early_and_late(const char *what, double *value, int first, int bites)
{
    double early = median(value + first, NEAR), late = median(value + bites - NEAR, NEAR);
    printf("%s: %.4g at bites %d to %d, %.4g at the last %d (ratio %.3f)\n", what, early, first, first + NEAR, late,
           NEAR, late / early);
}

/* Living vertices that a bite adds, over bites `first` to `last`. */
static double growth(const channel_log *l, int first, int last)
{
    return (double)(l->living[last] - l->living[first]) / (last - first);
}

static void report_channel(int bites, int tiles, channel_log *l)
{
    const int early = 99, late = bites - 1;
    printf("channel: %d bites in a sheet of %d tiles\n", bites, tiles);
    early_and_late("time of an event [s]", l->time, 0, bites);
    early_and_late("vertices of the tile that is bitten", l->tile, early + 1, bites);
    early_and_late("vertices within 100 m of a bite", l->around, early + 1, bites);
    printf("living vertices: %d at bite 100, %d at the last; a bite adds %.2f over bites 100 to 1,100, %.2f over the "
           "last 1,000\n",
           l->living[early], l->living[late], growth(l, early, early + 1000), growth(l, late - 1000, late));
    double most = 0;
    for (int i = 0; i < bites; i++)
        most = fmax(most, (double)l->held[i] / l->living[i]);
    printf("shape store: %d vertices at bite 100, %d at the last (ratio %.3f); at most %.3f times what lives\n",
           l->held[early], l->held[late], (double)l->held[late] / l->held[early], most);
}

static void bench_channel(void)
{
    rig r;
    rig_make(&r);
    polygon_list none = {0}, outlines = {0};
    int32_array cells = {0};
    fram_error e = {0};
    tile_grid g = tile_grid_over((box2){{0, -100}, {8000, 100}}, 28);
    for (int i = 0; i < SHEET_SIDES; i++)
        g.anchored[i] = true;
    g.least_seam = r.settings.edge_threshold;
    r.settings.tiles = g;
    if (tile_sheet(&r.ctx, &g, r.plane, &none, r.settings.smallest_floe_area, &outlines, &cells, &e) != FRAM_OK)
        stop(e.message);
    for (int32_t i = 0; i < polygon_list_count(&outlines); i++)
        add_floe(&r, polygon_list_get(&outlines, i), MOTION_STATIC, cells.data[i] + 1);
    static channel_log l;
    int bites = 0;
    random_stream s = random_begin(3, 1, 0);
    for (int turn = 0; bites < BITES && turn < 40 * BITES; turn++) {
        vec2 place = {1.0 * turn, random_uniform(&s, -7, 7)};
        if (place.x > 7900)
            break;
        int32_t row = tile_at(&r, place);
        if (row < 0)
            continue;
        add_load(&r, row, place, 1e7, 1);
        int vertices = vertices_of(&r.shapes, r.bodies.shape[r.floes.body[row]]);
        double taken = break_once(&r);
        if (r.events.count == 0)
            continue;
        l.time[bites] = taken;
        l.tile[bites] = vertices;
        remove_moving(&r);
        l.held[bites] = r.shapes.vertices.count;
        l.living[bites] = living_vertices(&r, 0, HUGE_VAL);
        l.around[bites++] = living_vertices(&r, place.x, AROUND);
    }
    report_channel(bites, (int)polygon_list_count(&outlines), &l);
}

/* ---- a scene ---- */

enum { WARM_STEPS = 2500, MEASURED_STEPS = 1000 };

typedef struct stage_clock {
    double last, part[STAGE_COUNT];
} stage_clock;

static void stage_done(void *user, step_stage stage)
{
    stage_clock *c = user;
    double t = now();
    c->part[stage] += t - c->last;
    c->last = t;
}

static void bench_scene(const char *path)
{
    context ctx;
    scenario s;
    model m;
    world w;
    field_report report;
    fram_error e = {0};
    context_init(&ctx);
    if (scenario_read(&ctx, path, NULL, &s, &e) != FRAM_OK || build_model(&ctx, &s, &m, &e) != FRAM_OK ||
        build_world(&ctx, &s, &m, &w, &report, &e) != FRAM_OK)
        stop(e.message);
    stage_clock clock = {0};
    const step_watch watch = {stage_done, &clock};
    int64_t before = 0;
    for (int i = 0; i < WARM_STEPS + MEASURED_STEPS; i++) {
        if (i == WARM_STEPS) {
            clock = (stage_clock){0};
            before = w.clock.bendings[0];
        }
        clock.last = now();
        if (world_step_watched(&ctx, &m, &w, &watch, &e) != FRAM_OK)
            stop(e.message);
    }
    double sum = 0;
    for (int i = 0; i < STAGE_COUNT; i++)
        sum += clock.part[i];
    printf("%s: %.2f ms a step, fracture %.3f ms, %.1f %% (%d events in %d steps)\n", path, 1e3 * sum / MEASURED_STEPS,
           1e3 * clock.part[STAGE_FRACTURE] / MEASURED_STEPS, 100 * clock.part[STAGE_FRACTURE] / sum,
           (int)(w.clock.bendings[0] - before), MEASURED_STEPS);
    world_free(&ctx, &w);
    model_free(&ctx, &m);
    scenario_free(&ctx, &s);
}

int main(int count, char **value)
{
    int rounds = count > 1 ? atoi(value[1]) : SAMPLES;
    bench_event(rounds, false);
    bench_event(rounds, true);
    bench_channel();
    bench_scene("scenes/level_ice.yaml");
    return EXIT_SUCCESS;
}
