#include "sim/scene_size.h"

#include "base/number_text.h"
#include "sim/build_feeding.h"
#include "sim/build_level.h"
#include "sim/build_packed.h"
#include "sim/frame_size.h"
#include "sim/series.h"

#include <math.h>
#include <string.h>

/* Memory of a run: the program itself, and what a floe takes with its shape, its contacts and the making of the field.
   Measured, resident, runs of ten steps: 1.4 to 1.6 kB for each of 40,000 and 160,000 tiles of a level sheet; 1.9 to
   3.1 kB for each of 10,000 and 40,000 Voronoi floes at 90 and 97 %; 5.7 and 9.2 kB for 12,800 and 2,600 packed ones.
 */
static const double PROGRAM_BYTES = 15e6, TILE_BYTES = 2e3, CELL_BYTES = 4e3, PACKED_BYTES = 10e3;
/* The folder but for its record (sim/frame_size.h), measured on the ready scenes and others: the texts beside
   series.csv about 30 kB, a checkpoint 15 kB and about 1,050 bytes for each floe, of which two are kept, the chart of
   the loads about 40 kB, a picture from above 0.1 to 0.3 MB, of open water 15 kB. */
static const double TEXT_BYTES = 3e4, CHECKPOINTS = 2, CHECKPOINT_BYTES = 15e3, KEPT_FLOE_BYTES = 1050,
                    CHART_BYTES = 4e4, PICTURE_BYTES = 2e5, EMPTY_BYTES = 2e4;
/* A number of series.csv, in the mean of its columns, by whether a vessel moves freely and meets ice: 2 bytes of a
   column that has nothing to tell, up to 14 of one that has.  Rows of 191 to 201 columns had 430 and 950 bytes in open
   water, of led and of free vessels, and 730 to 1,540 and 1,360 to 1,890 in ice. */
static const double NUMBER_BYTES[2][2] = {{2.5, 7}, {5, 8.5}};
/* What output.record_limit counts in [bytes]. */
static const double MEGABYTE = 1e6;
/* Vertices are numbered in 32 bits, and a floe has up to a hundred. */
static const double MOST_FLOES = 20e6;
/* Slices of a law of size, for its mean area within a few per cent: each condition of a study is asked for its size. */
enum { ROUGH_SLICES = 256 };

static double domain_area(const scenario *s)
{
    return (s->domain.x_max - s->domain.x_min) * (s->domain.y_max - s->domain.y_min);
}

/* 0 for a histogram, which stands in a file. */
static double mean_area(const scenario_population *p)
{
    const size_law law = population_size_law(p);
    return p->size == SIZE_HISTOGRAM ? 0 : size_law_mean_area(&law, ROUGH_SLICES);
}

static double share_sum(const scenario *s)
{
    double shares = 0;
    for (int32_t i = 0; i < s->ice.populations.count; i++)
        shares += s->ice.populations.data[i].share;
    return shares;
}

/* The mean floe by which a tile is found (build_feeding.h), as far as it is known here. */
static double tile_floe_area(const scenario *s)
{
    double sum = 0, shares = share_sum(s);
    for (int32_t i = 0; i < s->ice.populations.count; i++)
        sum += s->ice.populations.data[i].share / shares * mean_area(&s->ice.populations.data[i]);
    return s->ice.populations.count > 0 ? sum : s->ice.mean_floe_area;
}

static double population_floes(const scenario *s)
{
    double shares = share_sum(s), floes = 0;
    for (int32_t i = 0; i < s->ice.populations.count; i++) {
        const scenario_population *p = &s->ice.populations.data[i];
        double each = mean_area(p);
        floes += each > 0 ? s->ice.concentration * domain_area(s) * p->share / shares / each : 0;
    }
    return floes;
}

/* How often something happens that comes every interval, 0: at the end alone. */
static double times_within(const scenario *s, double interval)
{
    return 1 + (interval > 0 ? s->run.duration / fmax(interval, s->run.time_step) : 0);
}

static double row_bytes(const scenario *s, bool ice)
{
    int32_t vessels = scenario_vessel_count(s);
    bool is_free = false;
    for (int32_t i = 0; i < vessels; i++)
        is_free = is_free || scenario_vessel_entry(s, i).keys->mode == VESSEL_FREE;
    return series_column_number(s) * NUMBER_BYTES[is_free][vessels > 0 && ice];
}

scene_disk scene_disk_of(const scenario *s, double floes)
{
    const scenario_output *o = &s->output;
    double rows = s->run.duration / fmax(o->csv_interval, s->run.time_step);
    bool ice = floes > 0 || s->ice.source != ICE_NONE; /* floes of a file are not counted before it is read */
    scene_disk d = {
        .rows = TEXT_BYTES + rows * row_bytes(s, ice),
        .frames = o->frame_interval > 0 ? times_within(s, o->frame_interval) * frame_size_of_scenario(s, floes) : 0,
        .checkpoints = CHECKPOINTS * (CHECKPOINT_BYTES + KEPT_FLOE_BYTES * floes),
        .pictures = CHART_BYTES + times_within(s, o->picture_interval) * (ice ? PICTURE_BYTES : EMPTY_BYTES)};
    if (o->record_limit > 0)
        d.frames = fmin(d.frames, o->record_limit * MEGABYTE);
    d.all = d.rows + d.frames + d.checkpoints + d.pictures;
    return d;
}

static double floe_bytes(ice_source source)
{
    if (source == ICE_LEVEL)
        return TILE_BYTES;
    return source == ICE_FILE || source == ICE_PACKED ? PACKED_BYTES : CELL_BYTES;
}

static scene_size size_of_floes(const scenario *s, double floes)
{
    return (scene_size){floes, PROGRAM_BYTES + floe_bytes(s->ice.source) * floes, scene_disk_of(s, floes).all, NULL};
}

static const char *uncounted_floes(const scenario *s)
{
    const char *of = s->ice.source == ICE_FILE ? "the floes of its file" : NULL;
    for (int32_t i = 0; scenario_ice_is_field(&s->ice) && i < s->ice.populations.count; i++)
        if (s->ice.populations.data[i].size == SIZE_HISTOGRAM)
            return of ? "the floes of its file and of histograms" : "the floes of histograms";
    return of;
}

scene_size scene_size_of(const scenario *s)
{
    scenario larger = *s;
    if (s->domain.boundary == DOMAIN_FEEDING && s->ice.source != ICE_LEVEL)
        larger = feeding_scenario(s, tile_floe_area(s));
    double floes = 0;
    switch (s->ice.source) {
    case ICE_NONE:
        break;
    case ICE_FLOES:
        floes = s->ice.floes.count;
        break;
    case ICE_LEVEL:
        floes = build_tile_number(s);
        break;
    case ICE_VORONOI:
        floes = s->ice.populations.count > 0 ? population_floes(&larger) : domain_area(&larger) / s->ice.mean_floe_area;
        break;
    case ICE_FILE:
    case ICE_PACKED:
        floes = population_floes(&larger);
        break;
    }
    scene_size size = size_of_floes(s, floes);
    size.uncounted = uncounted_floes(s);
    return size;
}

scene_size scene_size_made(const scenario *s, int32_t floes)
{
    scene_size size = scene_size_of(s);
    /* What is counted goes before: of an endless field the tile, not what of it is in the domain. */
    return size.uncounted ? size_of_floes(s, fmax(size.floes, floes)) : size;
}

/* What makes the scenario large. */
static const char *size_key(const scenario *s)
{
    if (s->ice.source == ICE_LEVEL)
        return "ice.level.tile_size";
    return s->ice.populations.count > 0 ? "ice.populations" : "ice.mean_floe_area";
}

/* Tiles under the smallest floe are not made: there would be no sheet, or holes in it. */
static fram_status check_tiles(const scenario *s, fram_error *error)
{
    if (s->ice.source != ICE_LEVEL)
        return FRAM_OK;
    tile_grid g = build_tiles(s);
    box2 cell = tile_cell(&g, 0);
    double area = (cell.hi.x - cell.lo.x) * (cell.hi.y - cell.lo.y), least = s->ice.smallest_floe_area;
    if (area >= least)
        return FRAM_OK;
    if (is_automatic(s->ice.level.tile_size))
        return scenario_fault(s, error, "ice.smallest_floe_area",
                              "expected no more than a tile of the sheet, %s m2, or nothing is left of it, found %g m2",
                              most_text_of(area, 4).text, least);
    return scenario_fault(
        s, error, "ice.level.tile_size",
        "expected tiles no smaller than ice.smallest_floe_area, %g m2, or nothing is left of the sheet, "
        "found %g m, %.4g m2",
        least, s->ice.level.tile_size, area);
}

fram_status scene_size_check(const scenario *s, fram_error *error)
{
    fram_status status = check_tiles(s, error);
    if (status != FRAM_OK)
        return status;
    scene_size size = scene_size_of(s);
    double limit = s->run.memory_limit * 1e9;
    if (size.bytes <= limit && size.floes <= MOST_FLOES)
        return FRAM_OK;
    const char *key = size_key(s);
    if (size.floes > MOST_FLOES)
        return scenario_fault(s, error, key,
                              "expected at most %.3g floes, found about %.4g: make them larger or the domain smaller",
                              MOST_FLOES, size.floes);
    return scenario_fault(
        s, error, key,
        "expected a scenario of at most run.memory_limit, %g GB, found about %.4g GB for %.4g million floes: make "
        "them larger, the domain smaller, or raise the limit where there is so much memory",
        s->run.memory_limit, size.bytes * 1e-9, size.floes * 1e-6);
}
