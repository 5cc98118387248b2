/* Answers of fram field. */
#include "cli/field_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Notes that are printed for people; JSON has all. */
enum { NOTES_SHOWN = 12 };
/* Coordinates are written without a power of ten up to this [m], with so many decimals at most. */
#define COORDINATE_FIXED 1e9
enum { COORDINATE_DECIMALS = 9, COORDINATE_SIZE = 32 };

const char *field_title(const field_words *w)
{
    const char *slash = strrchr(w->path, '/');
    return slash ? slash + 1 : w->path;
}

/* What the concentration is of. */
static const char *whole_of(const field_words *w, const fram_field *field)
{
    fram_field_making m;
    if (fram_field_making_get(field, &m))
        return m.tile ? "the tile" : "the domain";
    return w->crop ? "the window" : "the box around it";
}

/* Decimals that tell the extent of a field to five digits at least, wherever it lies: a UTM northing has seven before
   the point. */
static int coordinate_decimals(const fram_field_summary *s)
{
    double extent = fmax(s->hi[0] - s->lo[0], s->hi[1] - s->lo[1]);
    int decimals = 0;
    for (; decimals < COORDINATE_DECIMALS && extent < 1e5; extent *= 10)
        decimals++;
    return decimals;
}

/* Without zeros at the end. */
static const char *box_text(double value, int decimals, char text[COORDINATE_SIZE])
{
    if (!(fabs(value) <= COORDINATE_FIXED)) {
        snprintf(text, COORDINATE_SIZE, "%.9g", value);
        return text;
    }
    int length = snprintf(text, COORDINATE_SIZE, "%.*f", decimals, value);
    while (decimals > 0 && text[length - 1] == '0')
        text[--length] = '\0';
    if (decimals > 0 && text[length - 1] == '.')
        text[--length] = '\0';
    return strcmp(text, "-0") == 0 ? "0" : text;
}

static void print_box(const fram_field_summary *s)
{
    char text[4][COORDINATE_SIZE];
    int decimals = coordinate_decimals(s);
    printf("  x from %s to %s m, y from %s to %s m\n", box_text(s->lo[0], decimals, text[0]),
           box_text(s->hi[0], decimals, text[1]), box_text(s->lo[1], decimals, text[2]),
           box_text(s->hi[1], decimals, text[3]));
}

static void print_overlaps(const fram_field_summary *s)
{
    const int *feature = s->overlap_features, *polygon = s->overlap_polygons;
    if (s->overlaps == 0) {
        printf("  no overlaps\n");
        return;
    }
    printf("  overlaps: %d pairs share %.4g m2, at most %.4g m wide; the most, features %d and %d", s->overlaps,
           s->overlap_area, s->overlap_width, feature[0], feature[1]);
    if (polygon[0] > 1 || polygon[1] > 1)
        printf(", polygons %d and %d", polygon[0], polygon[1]);
    printf("\n");
}

static void print_summary(const field_words *w, const fram_field *field, const fram_field_summary *s)
{
    if (w->scenario)
        tell(stdout, "%s: %d floe%s\n", field_title(w), s->floes, plural(s->floes));
    else
        tell(stdout, "%s: %d floe%s of %d ring%s\n", field_title(w), s->floes, plural(s->floes), s->rings,
             plural(s->rings));
    printf("  %d vertices, %d floe%s concave\n", s->vertices, s->concave, plural(s->concave));
    print_box(s);
    printf("  ice of %.6g m2, concentration %.2f %% of %s\n", s->area, 100 * s->concentration, whole_of(w, field));
    printf("  floes of %.6g to %.6g m2, the largest %.4g m across\n", s->smallest_area, s->largest_area,
           s->largest_diameter);
    printf("  diameter of equal area   floes\n");
    for (int i = 0; i < FRAM_FIELD_BINS; i++)
        if (s->bin[i] > 0)
            printf("    %8.4g to %8.4g m %6d\n", s->bin_edge[i], s->bin_edge[i + 1], s->bin[i]);
    print_overlaps(s);
    if (!w->scenario || s->dropped > 0 || s->repaired > 0)
        printf("  left out: %d, repairs: %d\n", s->dropped, s->repaired);
    if (s->passed_over > 0)
        printf("  passed over: %d feature%s of kind vessel or wall, not ice\n", s->passed_over, plural(s->passed_over));
}

static void print_windows(const field_words *w, const fram_field *field)
{
    for (int i = 0; i < w->windows; i++)
        printf("  concentration %.2f %% of the window %s\n",
               100 * fram_field_concentration(field, w->window[i].lo, w->window[i].hi), w->window_words.value[i]);
}

static void print_population(const fram_field *field, int number)
{
    fram_field_population p;
    fram_error error;
    if (fram_field_population_get(field, number, &p, &error) != FRAM_OK)
        return;
    printf("  population %d: %d floe%s, %.6g m2; distance from its size law %.2g (Kolmogorov and Smirnov)\n",
           number + 1, p.floes, plural(p.floes), p.area, p.size_distance);
    printf("    diameter of equal area   floes   the law\n");
    for (int i = 0; i < FRAM_FIELD_BINS; i++)
        if (p.bin[i] > 0 || p.expected[i] >= 0.5)
            printf("    %8.4g to %8.4g m %6d  %8.1f\n", p.bin_edge[i], p.bin_edge[i + 1], p.bin[i], p.expected[i]);
}

static void print_making(const fram_field *field)
{
    fram_field_making m;
    if (!fram_field_making_get(field, &m))
        return;
    printf("  concentration %.3f %% of %.6g m2 free for ice", 100 * m.reached, m.free_area);
    if (isnan(m.target))
        printf("\n");
    else
        printf("; asked for: %.3f %%\n", 100 * m.target);
    printf("  largest overlap %.2g m\n", m.largest_overlap);
    if (m.tile)
        printf("  the tile repeats itself after %.12g m in x and %.12g m in y\n", m.tile_x, m.tile_y);
    for (int i = 0; i < m.populations; i++)
        print_population(field, i);
    if (m.rounds > 0)
        printf("  moved rigidly: areas changed by at most %.1g of themselves, numbers of vertices of %d floe%s\n",
               m.area_change, m.vertex_changes, plural(m.vertex_changes));
}

/* How many are shown with those that were before. */
static int print_notes_of(const fram_field_note *notes, int count, bool outside, int shown)
{
    for (int i = 0; i < count && shown < NOTES_SHOWN; i++) {
        if (notes[i].outside != outside)
            continue;
        tell(stdout, "    %s: feature %d, polygon %d, ring %d (line %d): %s\n",
             notes[i].dropped ? "left out" : "repaired", notes[i].feature, notes[i].polygon, notes[i].ring,
             notes[i].line, notes[i].reason);
        shown++;
    }
    return shown;
}

/* Most of a large file may lie outside of a small domain: what happened inside of it comes first. */
static void print_notes(const fram_field_note *notes, int count)
{
    int shown = print_notes_of(notes, count, false, 0);
    print_notes_of(notes, count, true, shown);
    if (count > NOTES_SHOWN)
        printf("    and %d more; --json lists all\n", count - NOTES_SHOWN);
}

static void json_notes(json *j, const char *key, bool dropped, const fram_field_note *notes, int count)
{
    json_open_list(j, key);
    for (int i = 0; i < count; i++) {
        if (notes[i].dropped != dropped)
            continue;
        json_open(j, NULL);
        json_integer(j, "feature", notes[i].feature);
        json_integer(j, "polygon", notes[i].polygon);
        json_integer(j, "ring", notes[i].ring);
        json_integer(j, "line", notes[i].line);
        json_text(j, "reason", notes[i].reason);
        json_close(j);
    }
    json_close_list(j);
}

static void json_windows(json *j, const field_words *w, const fram_field *field)
{
    json_open_list(j, "windows");
    for (int i = 0; i < w->windows; i++) {
        const field_window *at = &w->window[i];
        const double bounds[4] = {at->lo[0], at->lo[1], at->hi[0], at->hi[1]};
        json_open(j, NULL);
        json_reals(j, "bounds_m", bounds, 4);
        json_real(j, "concentration", fram_field_concentration(field, at->lo, at->hi));
        json_close(j);
    }
    json_close_list(j);
}

static void json_population(json *j, const fram_field_population *p)
{
    double bins[FRAM_FIELD_BINS];
    for (int i = 0; i < FRAM_FIELD_BINS; i++)
        bins[i] = p->bin[i];
    json_open(j, NULL);
    json_integer(j, "floes", p->floes);
    json_real(j, "area_m2", p->area);
    json_real(j, "kolmogorov_smirnov", p->size_distance);
    json_reals(j, "diameter_edges_m", p->bin_edge, FRAM_FIELD_BINS + 1);
    json_reals(j, "counted", bins, FRAM_FIELD_BINS);
    json_reals(j, "expected", p->expected, FRAM_FIELD_BINS);
    json_close(j);
}

static void json_making(json *j, const fram_field *field)
{
    fram_field_making m;
    fram_field_population p;
    fram_error error;
    if (!fram_field_making_get(field, &m))
        return;
    json_open(j, "made");
    json_real(j, "asked_concentration", m.target);
    json_real(j, "concentration", m.reached);
    json_real(j, "free_area_m2", m.free_area);
    if (m.tile)
        json_reals(j, "tile_m", (const double[]){m.tile_x, m.tile_y}, 2);
    json_real(j, "largest_overlap_m", m.largest_overlap);
    json_integer(j, "placed", m.placed);
    json_integer(j, "rounds", m.rounds);
    json_integer(j, "carried", m.moves);
    json_real(j, "largest_area_change", m.area_change);
    json_integer(j, "vertex_changes", m.vertex_changes);
    json_open_list(j, "populations");
    for (int i = 0; i < m.populations; i++)
        if (fram_field_population_get(field, i, &p, &error) == FRAM_OK)
            json_population(j, &p);
    json_close_list(j);
    json_close(j);
}

static void print_field_json(const field_words *w, const fram_field *field, const fram_field_summary *s,
                             const fram_field_note *notes, int count)
{
    const double bounds[4] = {s->lo[0], s->lo[1], s->hi[0], s->hi[1]};
    double bins[FRAM_FIELD_BINS];
    for (int i = 0; i < FRAM_FIELD_BINS; i++)
        bins[i] = s->bin[i];
    json j = json_begin();
    json_text(&j, "field", w->path);
    json_integer(&j, "rings", s->rings);
    json_integer(&j, "passed_over", s->passed_over);
    json_integer(&j, "floes", s->floes);
    json_real(&j, "area_m2", s->area);
    json_real(&j, "concentration", s->concentration);
    json_reals(&j, "bounds_m", bounds, 4);
    json_integer(&j, "vertices", s->vertices);
    json_integer(&j, "concave", s->concave);
    json_real(&j, "largest_diameter_m", s->largest_diameter);
    json_real(&j, "smallest_area_m2", s->smallest_area);
    json_real(&j, "largest_area_m2", s->largest_area);
    json_open(&j, "overlap");
    json_integer(&j, "pairs", s->overlaps);
    json_real(&j, "area_m2", s->overlap_area);
    json_real(&j, "largest_width_m", s->overlap_width);
    json_integer(&j, "feature_a", s->overlap_features[0]);
    json_integer(&j, "feature_b", s->overlap_features[1]);
    json_integer(&j, "polygon_a", s->overlap_polygons[0]);
    json_integer(&j, "polygon_b", s->overlap_polygons[1]);
    json_close(&j);
    json_open(&j, "histogram");
    json_reals(&j, "diameter_edges_m", s->bin_edge, FRAM_FIELD_BINS + 1);
    json_reals(&j, "floes", bins, FRAM_FIELD_BINS);
    json_close(&j);
    json_windows(&j, w, field);
    json_making(&j, field);
    json_notes(&j, "dropped", true, notes, count);
    json_notes(&j, "repaired", false, notes, count);
    if (w->draw)
        json_text(&j, "drawing", w->draw);
    if (w->cover)
        json_text(&j, "cover_map", w->cover);
    if (w->table)
        json_text(&j, "table", w->table);
    if (w->output)
        json_text(&j, "written", w->output);
    json_end(&j);
}

int field_answer(const field_words *w, const common_options *common, const fram_field *field)
{
    fram_field_summary summary;
    fram_field_summary_get(field, &summary);
    int count = fram_field_notes(field, NULL, 0);
    fram_field_note *notes = calloc((size_t)count + 1, sizeof *notes);
    if (!notes)
        return answer_memory(common);
    fram_field_notes(field, notes, count);
    if (common->json) {
        print_field_json(w, field, &summary, notes, count);
    } else {
        print_summary(w, field, &summary);
        print_windows(w, field);
        print_making(field);
        print_notes(notes, count);
    }
    free(notes);
    return EXIT_GOOD;
}
