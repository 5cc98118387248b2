/* io/geojson and ice/import: what is read, what is refused and where, what is mended, and the way out and back. */
#include "ice/import_parts.h"
#include "io/geojson.h"
#include "io/outline_file.h"
#include "scratch.h"
#include <math.h>

/* ---- helpers ---- */

typedef struct rig {
    context ctx;
    overlay *plane;
    import_rings rings;
    import_field field;
    fram_error error;
} rig;

static rig *rig_make(void)
{
    rig *r = calloc(1, sizeof *r);
    ck_assert_ptr_nonnull(r);
    context_init(&r->ctx);
    r->plane = overlay_create(&r->ctx);
    ck_assert_ptr_nonnull(r->plane);
    return r;
}

static void rig_free(rig *r)
{
    import_rings_free(&r->ctx, &r->rings);
    import_field_free(&r->ctx, &r->field);
    overlay_free(r->plane);
    free(r);
}

static fram_status parse(rig *r, const char *text)
{
    return geojson_parse(&r->ctx, "floes.geojson", text, strlen(text), &r->rings, &r->error);
}

static import_options options_of(import_bad bad)
{
    return (import_options){.name = "floes.geojson", .scale = 1, .bad = bad};
}

static fram_status import(rig *r, const import_options *o)
{
    return import_field_make(&r->ctx, r->plane, &r->rings, o, &r->field, &r->error);
}

static double floe_area(const rig *r, int32_t i) { return polygon_area(polygon_list_get(&r->field.outlines, i)); }

#define POLYGON(rings) "{\"type\":\"Polygon\",\"coordinates\":[" rings "]}"
#define FEATURE(rings) "{\"type\":\"Feature\",\"properties\":{},\"geometry\":" POLYGON(rings) "}"
#define COLLECTION(features) "{\"type\":\"FeatureCollection\",\"features\":[\n" features "]}\n"
#define SQUARE "[[0,0],[10,0],[10,10],[0,10],[0,0]]"
#define BOW_TIE "[[0,0],[10,10],[10,0],[0,10],[0,0]]"

/* ---- what is read ---- */

START_TEST(features_of_all_kinds)
{
    rig *r = rig_make();
    assert_ok(parse(r, COLLECTION("{\"geometry\":{\"coordinates\":[[[0,0,5],[2,0],[2,1],[0,0]]],\"type\":\"Polygon\"},"
                                  "\"properties\":{\"a\":[{}],\"thickness\":1.25},\"type\":\"Feature\"},\n"
                                  "{\"type\":\"Feature\",\"geometry\":null,\"properties\":null},\n"
                                  "{\"type\":\"Feature\",\"properties\":{\"thickness\":null},\"geometry\":{\"type\":"
                                  "\"MultiPolygon\",\"coordinates\":[[" SQUARE "],[" SQUARE "," SQUARE "]]}},"
                                  "{\"type\":\"Feature\",\"properties\":null,\"geometry\":{\"type\":\"Polygon\","
                                  "\"coordinates\":[ ]}}")),
              r->error);
    ck_assert_int_eq(r->rings.place.count, 4);
    const import_place *p = r->rings.place.data;
    ck_assert_int_eq(polygon_list_get(&r->rings.rings, 0).count, 3);
    assert_bits(p[0].thickness, 1.25);
    ck_assert(isnan(p[1].thickness) && isnan(p[3].thickness));
    const int expected[4][4] = {{1, 1, 1, 2}, {3, 1, 1, 4}, {3, 2, 1, 4}, {3, 2, 2, 4}};
    for (int i = 0; i < 4; i++) {
        ck_assert_int_eq(p[i].feature, expected[i][0]);
        ck_assert_int_eq(p[i].polygon, expected[i][1]);
        ck_assert_int_eq(p[i].ring, expected[i][2]);
        ck_assert_int_eq(p[i].line, expected[i][3]);
        ck_assert(!p[i].open);
    }
    rig_free(r);
}
END_TEST

/* ---- what is refused ---- */

typedef struct bad_text {
    const char *text;
    int line, column;
    const char *key, *message;
} bad_text;

static const bad_text bad_texts[] = {
    /* no JSON */
    {"", 1, 1, "", "expected an object, '{', found the end of the file"},
    {"[]", 1, 1, "", "expected an object"},
    {"\x01", 1, 1, "", "found the byte 0x01"},
    {"{\"type\":\"FeatureCollection\",\"features\":[]", 1, 42, "", "found the end of the file"},
    {"{\"type\":\"FeatureCollection\",\"features\":[]}x", 1, 43, "", "expected the end of the file, found 'x'"},
    {"{\"type\":\"FeatureCollection\",\n \"features\":[],}", 2, 16, "", "the name of a member"},
    {"{'type':\"Polygon\"}", 1, 2, "", "the name of a member in quotes"},
    {"{\"type\" \"Polygon\"}", 1, 9, "", "expected ':'"},
    {"{\"type\":\"Poly\ngon\"}", 1, 14, "", "control character"},
    {"{\"type\":\"\\x\"}", 1, 10, "", "an escape of JSON"},
    {"{\"type\":\"\\u12g4\"}", 1, 10, "", "four hexadecimal digits"},
    {"{\"type\":\"\xc3(\"}", 1, 10, "", "UTF-8"},
    {"{\"type\":\"Polygon", 1, 17, "", "at the end of a string"},
    {"{\"a\":tru}", 1, 6, "", "true, false or null"},
    {"{\"a\":nan}", 1, 6, "", "true, false or null"},
    {"{\"a\":[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[", 1, 37, "", "more than 32 deep"},
    /* no GeoJSON */
    {"{}", 1, 1, "feature 1", "found no type"},
    {"{\"type\":\"Topology\"}", 1, 9, "feature 1", "found Topology"},
    {"{\"type\":7}", 1, 9, "", "expected a string"},
    {"{\"type\":\"Polygon\",\"type\":\"Polygon\"}", 1, 26, "", "\"type\" is there twice"},
    {"{\"type\":\"FeatureCollection\"}", 1, 1, "", "no member \"features\""},
    {"{\"type\":\"FeatureCollection\",\"features\":{}}", 1, 40, "", "expected an array"},
    {COLLECTION("7"), 2, 1, "feature 1", "expected an object"},
    {COLLECTION("{\"type\":\"Polygon\"}"), 2, 9, "feature 1", "expected a Feature, found Polygon"},
    {COLLECTION("{\"type\":\"Feature\"}"), 2, 1, "feature 1", "no member \"geometry\""},
    {COLLECTION(FEATURE(SQUARE) ",\n{\"type\":\"Feature\",\"geometry\":{\"type\":\"Point\",\"coordinates\":[0,0]}}"), 3,
     38, "feature 2", "found Point"},
    {COLLECTION("{\"type\":\"Feature\",\"geometry\":{\"type\":\"Polygon\"}}"), 2, 30, "feature 1",
     "the Polygon has no member \"coordinates\""},
    {COLLECTION("{\"type\":\"Feature\",\"geometry\":null,\"properties\":{\"thickness\":-1}}"), 2, 61, "feature 1",
     "expected a thickness over 0 m, found -1"},
    {COLLECTION("{\"type\":\"Feature\",\"geometry\":null,\"properties\":{\"thickness\":150}}"), 2, 61, "feature 1",
     "expected a thickness of at most 100 m, found 150: is it in centimetres?"},
    {COLLECTION("{\"type\":\"Feature\",\"geometry\":null,\"properties\":{\"thickness\":\"1\"}}"), 2, 61, "feature 1",
     "expected a number for the property thickness, found a text"},
    {COLLECTION("{\"type\":\"Feature\",\"geometry\":null,\"properties\":[]}"), 2, 48, "feature 1",
     "expected an object"},
    {"{\"type\":\"GeometryCollection\"}", 1, 1, "feature 1", "no member \"geometries\""},
    /* coordinates */
    {"{\"type\":\"MultiPolygon\",\"coordinates\":[[]]}", 1, 39, "feature 1, polygon 1", "at least one ring"},
    {POLYGON("7"), 1, 34, "feature 1, polygon 1, ring 1", "expected an array"},
    {POLYGON("[[0,0],[1]]"), 1, 41, "feature 1, polygon 1, ring 1", "2 or 3 numbers, found 1"},
    {POLYGON("[[0,0],[1,2,3,4]]"), 1, 41, "feature 1, polygon 1, ring 1", "2 or 3 numbers, found more"},
    {POLYGON("[[0,0],[1,null]]"), 1, 44, "feature 1, polygon 1, ring 1", "expected a number, found 'n'"},
    {POLYGON("[[0,0],[1,1e999]]"), 1, 44, "", "1e999 is not finite"},
    {POLYGON("[[0,0],[01,1]]"), 1, 42, "", "without leading zeros"},
    {POLYGON("[[0,0],[.5,1]]"), 1, 42, "", "expected a value"},
    {POLYGON("[[0,0],[5.,1]]"), 1, 42, "", "a number as JSON writes it"},
    {POLYGON("[[0,0],[1e,1]]"), 1, 42, "", "a number as JSON writes it"},
    {POLYGON("[[0,0] [1,1]]"), 1, 41, "", "',' or ']'"},
};
enum { BAD_TEXTS = sizeof bad_texts / sizeof *bad_texts };

START_TEST(texts_are_refused_at_their_place)
{
    const bad_text *b = &bad_texts[_i];
    rig *r = rig_make();
    ck_assert_msg(parse(r, b->text) == FRAM_ERROR_INPUT, "%d is accepted: %s", _i, b->text);
    ck_assert_msg(strstr(r->error.message, b->message), "%d: '%s' lacks '%s'", _i, r->error.message, b->message);
    ck_assert_msg(r->error.line == b->line && r->error.column == b->column, "%d: at %d:%d, expected %d:%d: %s", _i,
                  r->error.line, r->error.column, b->line, b->column, r->error.message);
    ck_assert_msg(strcmp(r->error.key, b->key) == 0, "%d: key '%s', expected '%s'", _i, r->error.key, b->key);
    ck_assert_str_eq(r->error.file, "floes.geojson");
    ck_assert_int_eq(r->rings.place.count, 0);
    ck_assert_ptr_null(r->rings.rings.vertex.data);
    rig_free(r);
}
END_TEST

typedef struct bad_ring {
    const char *ring, *message;
    bool lost;       /* also under repair */
    double repaired; /* area that is left of it [m2] */
    import_event event;
} bad_ring;

static const bad_ring bad_rings[] = {
    {"[[0,0],[10,0],[10,10],[0,10]]", "is not closed", false, 100, IMPORT_NOTE_OPEN},
    {"[]", "fewer than 3", true, 0, IMPORT_NOTE_FEW},
    {"[[0,0],[10,0],[0,0]]", "fewer than 3", true, 0, IMPORT_NOTE_FEW},
    {"[[0,0],[0,0],[10,0],[10,0],[0,0]]", "fewer than 3", true, 0, IMPORT_NOTE_FEW},
    {"[[0,0],[10,0],[20,0],[0,0]]", "has no area", true, 0, IMPORT_NOTE_FLAT},
    {BOW_TIE, "crosses or touches itself", false, 50, IMPORT_NOTE_CROSSED},
    {"[[0,0],[10,0],[10,10],[5,0],[0,10],[0,0]]", "crosses or touches itself", false, 50, IMPORT_NOTE_CROSSED},
    {"[[0,0],[10,0],[15,0],[10,0],[10,10],[0,10],[0,0]]", "crosses or touches itself", false, 100, IMPORT_NOTE_CROSSED},
};
enum { BAD_RINGS = sizeof bad_rings / sizeof *bad_rings };

/* The square and the bad ring beside it: refused, dropped, repaired. */
START_TEST(bad_rings_are_refused_dropped_repaired)
{
    const bad_ring *b = &bad_rings[_i];
    char text[600];
    snprintf(text, sizeof text, COLLECTION(FEATURE("[[50,50],[51,50],[51,51],[50,50]]") ",\n" FEATURE("%s")), b->ring);
    for (int bad = IMPORT_REFUSE; bad <= IMPORT_REPAIR; bad++) {
        rig *r = rig_make();
        import_options o = options_of((import_bad)bad);
        assert_ok(parse(r, text), r->error);
        if (bad == IMPORT_REFUSE) {
            assert_fails(import(r, &o), r->error, FRAM_ERROR_INPUT, b->message);
            ck_assert_str_eq(r->error.key, "feature 2, polygon 1, ring 1");
            ck_assert_int_eq(r->error.line, 3);
            ck_assert_int_gt(r->error.column, 1);
            rig_free(r);
            continue;
        }
        assert_ok(import(r, &o), r->error);
        double area = -0.5;
        for (int32_t i = 0; i < polygon_list_count(&r->field.outlines); i++)
            area += floe_area(r, i);
        assert_absolute(area, bad == IMPORT_REPAIR ? b->repaired : 0, 1e-12);
        ck_assert_int_eq(r->field.notes.count, 1);
        ck_assert_int_eq(r->field.notes.data[0].event, b->event);
        ck_assert_int_eq(r->field.notes.data[0].ring, 1);
        ck_assert_int_eq(r->field.notes.data[0].dropped, bad == IMPORT_DROP || b->lost);
        rig_free(r);
    }
}
END_TEST

/* A zigzag to the right, and one over it: upwards, which crosses each of its edges with each of its own, or back along
   its mirror image.  NULL: no memory. */
static char *scribble_text(int edges, bool mirrored)
{
    enum { ROOM = 1 << 16 };
    char *text = calloc(1, ROOM);
    size_t n = text ? (size_t)snprintf(text, ROOM, "{\"type\":\"Polygon\",\"coordinates\":[[[0,0]") : 0;
    for (int i = 1; text && i <= edges; i++)
        n += (size_t)snprintf(text + n, ROOM - n, ",[%d,%d]", i, i % 2 * edges);
    for (int i = 1; text && i <= edges; i++) {
        int across = i % 2 ? 0 : edges;
        n += (size_t)snprintf(text + n, ROOM - n, ",[%d,%d]", mirrored ? edges + 1 - i : across, mirrored ? across : i);
    }
    if (text)
        snprintf(text + n, ROOM - n, ",[0,0]]]}");
    return text;
}

/* A hundred and sixty thousand crossings, which GEOS would take gigabytes and minutes for; and 1,600 of which each
   parts two floes, which are united one after the other. */
START_TEST(scribbles_are_not_repaired)
{
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        char *text = scribble_text(mirrored ? 1601 : 400, mirrored);
        ck_assert_ptr_nonnull(text);
        rig *r = rig_make();
        import_options o = options_of(IMPORT_REPAIR);
        assert_ok(parse(r, text), r->error);
        assert_fails(import(r, &o), r->error, FRAM_ERROR_INPUT,
                     "too often to be repaired; simplify it before, or have bad rings dropped");
        ck_assert_str_eq(r->error.key, "feature 1, polygon 1, ring 1");
        o.bad = IMPORT_DROP;
        assert_fails(import(r, &o), r->error, FRAM_ERROR_INPUT, "no floe is left");
        rig_free(r);
        free(text);
    }
}
END_TEST

/* A chain of squares, corner to corner, as a raster's cells are: it touches itself five thousand times, crosses itself
   nowhere and is a floe for each.  With one corner on an edge it is left to GEOS, for which that is too often. */
START_TEST(a_chain_of_squares_is_no_scribble)
{
    enum { SQUARES = 5000 };
    vec2 *v = calloc(4 * SQUARES, sizeof *v);
    ck_assert_ptr_nonnull(v);
    for (int i = 0; i < 2 * SQUARES; i++) {
        v[i] = vec2_make(i, i % 2);
        v[2 * SQUARES + i] = vec2_make(2 * SQUARES - i, -(i % 2));
    }
    rig *r = rig_make();
    import_options o = options_of(IMPORT_REPAIR);
    const import_place place = {.feature = 1, .polygon = 1, .ring = 1, .thickness = NAN};
    ck_assert(array_push(&r->ctx, &r->rings.place, place));
    ck_assert(polygon_list_push(&r->ctx, &r->rings.rings, (polygon){v, 4 * SQUARES}));
    assert_ok(import(r, &o), r->error);
    ck_assert_int_eq(polygon_list_count(&r->field.outlines), SQUARES);
    for (int i = 0; i < SQUARES; i++)
        assert_bits(floe_area(r, i), 2);
    import_field_free(&r->ctx, &r->field);
    r->rings.rings.vertex.data[4 * SQUARES - 1] = vec2_make(2.5, 0.5);
    assert_fails(import(r, &o), r->error, FRAM_ERROR_INPUT, "too often to be repaired");
    rig_free(r);
    free(v);
}
END_TEST

START_TEST(holes_are_filled_on_request)
{
    rig *r = rig_make();
    assert_ok(parse(r, FEATURE(SQUARE ",[[2,2],[3,2],[3,3],[2,2]]")), r->error);
    import_options o = options_of(IMPORT_REFUSE);
    assert_fails(import(r, &o), r->error, FRAM_ERROR_INPUT, "is a hole");
    ck_assert_str_eq(r->error.key, "feature 1, polygon 1, ring 2");
    o.bad = IMPORT_DROP;
    assert_ok(import(r, &o), r->error);
    ck_assert_int_eq(polygon_list_count(&r->field.outlines), 1);
    assert_bits(floe_area(r, 0), 100);
    rig_free(r);
}
END_TEST

/* ---- what is made of it ---- */

START_TEST(clockwise_rings_are_turned_scaled_and_moved)
{
    rig *r = rig_make();
    assert_ok(parse(r, FEATURE("[[0,0],[0,10],[10,10],[10,0],[0,0]]")), r->error);
    import_options o = options_of(IMPORT_REFUSE);
    o.scale = 2;
    o.offset = vec2_make(100, -50);
    o.centre = true;
    assert_ok(import(r, &o), r->error);
    polygon p = polygon_list_get(&r->field.outlines, 0);
    assert_bits(polygon_area(p), 400);
    box2 box = polygon_bounds(p);
    assert_vec2_close(box.lo, vec2_make(90, -60), 0);
    assert_vec2_close(box.hi, vec2_make(110, -40), 0);
    rig_free(r);
}
END_TEST

START_TEST(far_coordinates_and_empty_fields_are_refused)
{
    rig *r = rig_make();
    assert_ok(parse(r, FEATURE(SQUARE)), r->error);
    import_options o = options_of(IMPORT_REFUSE);
    o.scale = 1e9;
    assert_fails(import(r, &o), r->error, FRAM_ERROR_INPUT, "farther than 1e9 m");
    o.scale = 1;
    o.smallest_area = 101;
    assert_fails(import(r, &o), r->error, FRAM_ERROR_INPUT, "no floe is left");
    rig_free(r);
}
END_TEST

/* A U whose legs are cut off by the window, one of them too small; a floe outside; one near a zone. */
/* Of a tile that repeats itself a square over its edge stays whole, unless it lies over a copy of another floe, or one
   is farther off than it is wide. */
START_TEST(tiles_stay_whole)
{
    static const struct {
        const char *other;
        double left, area; /* of the tile [m]; of the square [m2] */
        int floes;
    } row[] = {{"[[-7,0],[-3,0],[-3,4],[-7,4],[-7,0]]", -10, 16, 2},
               {"[[-15,5],[-11,5],[-11,9],[-15,9],[-15,5]]", -10, 16, 2},
               {"[[1,0],[5,0],[5,4],[1,4],[1,0]]", 0, 8, 2},
               {"[[-20,5],[-16,5],[-16,9],[-20,9],[-20,5]]", -10, 8, 1}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        rig *r = rig_make();
        char text[600];
        snprintf(text, sizeof text, COLLECTION(FEATURE("[[18,0],[22,0],[22,4],[18,4],[18,0]]") "," FEATURE("%s")),
                 row[i].other);
        assert_ok(parse(r, text), r->error);
        import_options o = options_of(IMPORT_REFUSE);
        o.crop = o.tile = true;
        o.domain = (box2){{row[i].left, -10}, {20, 10}};
        assert_ok(import(r, &o), r->error);
        assert_absolute(floe_area(r, 0), row[i].area, 1e-12);
        ck_assert_int_eq(polygon_list_count(&r->field.outlines), row[i].floes);
        ck_assert_int_eq(r->field.notes.count, 2 - row[i].floes);
        rig_free(r);
    }
}
END_TEST

START_TEST(crop_slivers_and_keep_out)
{
    for (int near = 0; near < 2; near++) {
        rig *r = rig_make();
        assert_ok(
            parse(r,
                  COLLECTION(FEATURE("[[0,0],[10,0],[10,10],[9.9,10],[9.9,2],[3,2],[3,10],[0,10],[0,0]]") "," FEATURE(
                      "[[20,0],[30,0],[30,1],[20,0]]") "," FEATURE("[[3.5,4],[5,4],[5,9],[3.5,9],[3.5,4]]"))),
            r->error);
        polygon_list zones = {0};
        const vec2 zone[3] = {{5.5, 4}, {8, 4}, {8, 5}};
        ck_assert(polygon_list_push(&r->ctx, &zones, (polygon){zone, 3}));
        import_options o = options_of(IMPORT_REFUSE);
        o.crop = true;
        o.domain = (box2){{-1, 3}, {15, 10}};
        o.smallest_area = 1;
        o.keep_out = &zones;
        o.keep_out_margin = near ? 0.6 : 0.4;
        assert_ok(import(r, &o), r->error);
        ck_assert_int_eq(polygon_list_count(&r->field.outlines), near ? 1 : 2);
        assert_absolute(floe_area(r, 0), 21, 1e-12);
        const import_event events[3] = {IMPORT_NOTE_SMALL, IMPORT_NOTE_OUTSIDE, IMPORT_NOTE_KEPT_OUT};
        ck_assert_int_eq(r->field.notes.count, near ? 3 : 2);
        for (int i = 0; i < r->field.notes.count; i++) {
            ck_assert_int_eq(r->field.notes.data[i].event, events[i]);
            ck_assert_int_eq(r->field.notes.data[i].ring, i);
            ck_assert(r->field.notes.data[i].dropped);
        }
        polygon_list_free(&r->ctx, &zones);
        rig_free(r);
    }
}
END_TEST

/* A strip across a square: the square, which is larger, loses what they share and falls in two. */
START_TEST(overlaps_are_measured_and_cut)
{
    rig *r = rig_make();
    assert_ok(parse(r, COLLECTION(FEATURE(SQUARE) "," FEATURE("[[-1,4],[11,4],[11,6],[-1,6],[-1,4]]") "," FEATURE(
                           "[[20,0],[21,0],[21,1],[20,0]]"))),
              r->error);
    import_options o = options_of(IMPORT_REFUSE);
    import_measure m;
    assert_ok(import(r, &o), r->error);
    assert_ok(import_field_measure(&r->ctx, r->plane, NULL, &r->field.outlines, &m, &r->error), r->error);
    ck_assert_int_eq(m.floes, 3);
    ck_assert_int_eq(m.vertices, 11);
    ck_assert_int_eq(m.concave, 0);
    ck_assert_int_eq(m.overlaps, 1);
    ck_assert_int_eq(m.overlap_pair[0], 0);
    ck_assert_int_eq(m.overlap_pair[1], 1);
    assert_relative(m.overlap_area, 20, 1e-12);
    assert_relative(m.overlap_width, 2, 1e-12);
    assert_relative(m.area, 124.5, 1e-12);
    assert_relative(m.largest_diameter, sqrt(200), 1e-12);
    assert_bits(m.edge[IMPORT_HISTOGRAM_BINS], 16);
    ck_assert_int_eq(m.bin[IMPORT_HISTOGRAM_BINS - 1], 1);
    ck_assert_int_eq(m.bin[IMPORT_HISTOGRAM_BINS - 2], 1);
    ck_assert_int_eq(m.bin[IMPORT_HISTOGRAM_BINS - 5], 1);
    import_field_free(&r->ctx, &r->field);

    o.bad = IMPORT_REPAIR;
    assert_ok(import(r, &o), r->error);
    assert_ok(import_field_measure(&r->ctx, r->plane, NULL, &r->field.outlines, &m, &r->error), r->error);
    ck_assert_int_eq(m.floes, 4);
    ck_assert_int_eq(m.overlaps, 0);
    assert_relative(m.area, 104.5, 1e-12);
    const int rings[4] = {0, 0, 1, 2};
    for (int i = 0; i < 4; i++)
        ck_assert_int_eq(r->field.ring.data[i], rings[i]);
    ck_assert_int_eq(r->field.notes.count, 1);
    ck_assert_int_eq(r->field.notes.data[0].event, IMPORT_NOTE_OVERLAP);
    rig_free(r);
}
END_TEST

/* ---- many floes over one ---- */

enum { GRID = 12 }; /* floes along a side */

/* A sheet under a grid of floes, of which those of the first row reach over its rim, in an order that is not theirs. */
static void write_sheet_under_floes(char *text, size_t size)
{
    size_t at = (size_t)snprintf(text, size, "{\"type\":\"FeatureCollection\",\"features\":[\n%s",
                                 FEATURE("[[70,-1],[125,30],[119,121],[-2,118],[-3,4],[70,-1]]"));
    for (int i = 0; i < GRID * GRID; i++) {
        int k = i * 55 % (GRID * GRID), x = 10 * (k % GRID), y = 10 * (k / GRID);
        at += (size_t)snprintf(text + at, size - at, ",\n" FEATURE("[[%d,%d],[%d,%d],[%d,%d.%d],[%d,%d],[%d,%d]]"),
                               x + 1, y - 4, x + 8, y - 3, x + 7, y + 4, i % 10, x + 2, y + 5, x + 1, y - 4);
        ck_assert_uint_lt(at, size);
    }
    snprintf(text + at, size - at, "]}\n");
}

/* What the first floe loses one after the other to all others, all parts at every turn. */
static void cut_by_all(rig *r, const polygon_list *floes, polygon_list *parts)
{
    ck_assert(polygon_list_push(&r->ctx, parts, polygon_list_get(floes, 0)));
    for (int32_t i = 1; i < polygon_list_count(floes); i++) {
        polygon_list rest = {0};
        for (int32_t k = 0; k < polygon_list_count(parts); k++)
            assert_ok(
                overlay_difference(r->plane, polygon_list_get(parts, k), polygon_list_get(floes, i), &rest, &r->error),
                r->error);
        polygon_list_free(&r->ctx, parts);
        *parts = rest;
    }
}

/* A part meets only those floes that are near it, and the parts are the same to the bit, in the same order. */
START_TEST(one_floe_is_cut_by_many)
{
    enum { TEXT = 1 << 16 };
    rig *r = rig_make();
    char *text = malloc(TEXT);
    polygon_list parts = {0};
    ck_assert_ptr_nonnull(text);
    write_sheet_under_floes(text, TEXT);
    assert_ok(parse(r, text), r->error);
    import_options o = options_of(IMPORT_REFUSE);
    assert_ok(import(r, &o), r->error);
    cut_by_all(r, &r->field.outlines, &parts);
    import_field_free(&r->ctx, &r->field);
    o.bad = IMPORT_REPAIR;
    assert_ok(import(r, &o), r->error);
    int32_t count = polygon_list_count(&parts);
    ck_assert_int_gt(count, GRID * GRID / 2);
    ck_assert_int_eq(polygon_list_count(&r->field.outlines), count + GRID * GRID);
    for (int32_t i = 0; i < count; i++) {
        polygon p = polygon_list_get(&parts, i), q = polygon_list_get(&r->field.outlines, i);
        ck_assert_int_eq(p.count, q.count);
        ck_assert_mem_eq(p.vertex, q.vertex, (size_t)p.count * sizeof *p.vertex);
    }
    polygon_list_free(&r->ctx, &parts);
    free(text);
    rig_free(r);
}
END_TEST

/* A square over the inner corner of an L by a thousandth: a bent strip of 0.001 by 20 m on each side of 20.001. */
START_TEST(a_bent_overlap_is_as_wide_as_its_strip)
{
    rig *r = rig_make();
    assert_ok(parse(r, COLLECTION(FEATURE("[[0,0],[30,0],[30,10],[10,10],[10,30],[0,30],[0,0]]") "," FEATURE(
                           "[[9.999,9.999],[40,9.999],[40,40],[9.999,40],[9.999,9.999]]"))),
              r->error);
    import_options o = options_of(IMPORT_REFUSE);
    import_measure m;
    assert_ok(import(r, &o), r->error);
    assert_ok(import_field_measure(&r->ctx, r->plane, NULL, &r->field.outlines, &m, &r->error), r->error);
    assert_relative(m.overlap_area, 0.001 * (2 * 20.001 - 0.001), 1e-9);
    assert_relative(m.overlap_width, 0.001, 1e-9);
    rig_free(r);
}
END_TEST

static double overlap_width_of(const char *text)
{
    rig *r = rig_make();
    import_options o = options_of(IMPORT_REFUSE);
    import_measure m;
    assert_ok(parse(r, text), r->error);
    assert_ok(import(r, &o), r->error);
    assert_ok(import_field_measure(&r->ctx, r->plane, NULL, &r->field.outlines, &m, &r->error), r->error);
    rig_free(r);
    return m.overlap_width;
}

/* 1 mm along 100 m is as wide as the tooth of 2 by 2 m in it; a floe of 20 by 20 m inside another one, of which hollow
   sides of many corners leave 18 m, is not cut to ribbons: its rectangle is 14.6 by 25.5 m. */
START_TEST(an_overlap_is_as_wide_as_its_widest_part)
{
    double tooth = overlap_width_of(COLLECTION(FEATURE("[[0,0],[100,0],[100,10],[0,10],[0,0]]") "," FEATURE(
        "[[0,-10],[100,-10],[100,0.001],[51,0.001],[51,2],[49,2],[49,0.001],[0,0.001],[0,-10]]")));
    ck_assert_msg(tooth > 1.99 && tooth < 2.001, "%g m", tooth);
    char ring[2000], text[3000];
    int n = 0;
    for (int i = 0; i < 43; i++) { /* along below, back above, and closed */
        int k = i % 42, x = k < 21 ? k : 41 - k;
        double y = 1 - (x - 10) * (x - 10) / 100.0;
        n += snprintf(ring + n, sizeof ring - (size_t)n, "%s[%d,%g]", i > 0 ? "," : "[", x, k < 21 ? y : 20 - y);
    }
    snprintf(text, sizeof text, COLLECTION(FEATURE("[[-9,-9],[40,-9],[40,40],[-9,40],[-9,-9]]") "," FEATURE("%s]")),
             ring);
    double hollow = overlap_width_of(text);
    ck_assert_msg(hollow > 14 && hollow < 15, "%g m", hollow);
}
END_TEST

/* What a cut leaves beside the smaller floe: a tip of 18 m2 is a floe however large the one that it was of, 5 m2 of
   0.05 m by 100 are a sliver. */
START_TEST(a_sliver_is_thin_not_small)
{
    static const struct {
        const char *cut, *by;
        int floes, notes;
    } row[] = {{"[[0,0],[200,0],[200,47],[211,47],[211,50],[200,50],[200,100],[0,100],[0,0]]",
                "[[200,30],[205,30],[205,70],[200,70],[200,30]]", 3, 1},
               {"[[0,0],[100,0],[100,100],[0,100],[0,0]]", "[[90,-1],[99.95,-1],[99.95,101],[90,101],[90,-1]]", 2, 2}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        rig *r = rig_make();
        char text[600];
        snprintf(text, sizeof text, COLLECTION(FEATURE("%s") "," FEATURE("%s")), row[i].cut, row[i].by);
        assert_ok(parse(r, text), r->error);
        import_options o = options_of(IMPORT_REPAIR);
        o.smallest_area = 4;
        assert_ok(import(r, &o), r->error);
        ck_assert_int_eq(polygon_list_count(&r->field.outlines), row[i].floes);
        ck_assert_int_eq(r->field.notes.count, row[i].notes);
        ck_assert_int_eq(r->field.notes.data[0].event, IMPORT_NOTE_OVERLAP);
        ck_assert_int_eq(r->field.notes.data[row[i].notes - 1].event,
                         i == 0 ? IMPORT_NOTE_OVERLAP : IMPORT_NOTE_SLIVER);
        rig_free(r);
    }
}
END_TEST

START_TEST(simplified_within_the_tolerance)
{
    rig *r = rig_make();
    assert_ok(parse(r, FEATURE("[[0,0],[5,0.09],[10,0],[10,10],[5,10.2],[0,10],[0,0]]")), r->error);
    import_options o = options_of(IMPORT_REFUSE);
    o.simplify = 0.1;
    assert_ok(import(r, &o), r->error);
    ck_assert_int_eq(polygon_list_get(&r->field.outlines, 0).count, 5);
    rig_free(r);
}
END_TEST

/* ---- out and back ---- */

START_TEST(what_is_written_reads_back_to_the_bit)
{
    rig *r = rig_make();
    scratch place = scratch_make();
    const vec2 a[3] = {{0.1, 1.0 / 3}, {1e-300, 2e17}, {-5e-324, 0.30000000000000004}}, b[4] = {{0, 0}, {1, 0}, {1, 1}};
    /* Clockwise, as of a floe that lies upside down: written the other way round. */
    const vec2 c[3] = {{5, 1}, {6, 0}, {5, 0}};
    const double thickness[3] = {0.7, (double)NAN, 1};
    polygon_list list = {0};
    ck_assert(polygon_list_push(&r->ctx, &list, (polygon){a, 3}) && polygon_list_push(&r->ctx, &list, (polygon){b, 4}));
    const int32_t before = list.vertex.count;
    ck_assert(polygon_list_push(&r->ctx, &list, (polygon){c, 3}));
    assert_ok(geojson_write(&r->ctx, scratch_path(&place, "out.geojson"), &list, thickness, &r->error), r->error);
    assert_ok(outline_file_read(&r->ctx, place.path, &r->rings, &r->error), r->error);
    ck_assert_int_eq(r->rings.place.count, 3);
    assert_array_bits(&r->rings.rings.vertex.data->x, &list.vertex.data->x, 2 * before);
    for (int i = 0; i < 3; i++)
        assert_vec2_close(polygon_list_get(&r->rings.rings, 2).vertex[i], c[2 - i], 0);
    assert_bits(r->rings.place.data[0].thickness, 0.7);
    ck_assert(isnan(r->rings.place.data[1].thickness));
    scratch_remove(&place, "out.geojson");
    polygon_list_free(&r->ctx, &list);
    rig_free(r);
}
END_TEST

START_TEST(limits_and_files)
{
    rig *r = rig_make();
    assert_fails(outline_file_read(&r->ctx, "no/such.geojson", &r->rings, &r->error), r->error, FRAM_ERROR_INPUT, "");
    enum { POSITIONS = GEOJSON_RING_VERTICES_MOST + 1 };
    char *text = malloc(6 * POSITIONS + 100), *at = text;
    ck_assert_ptr_nonnull(text);
    at += sprintf(at, "{\"type\":\"Polygon\",\"coordinates\":[[");
    for (int i = 0; i < POSITIONS; i++)
        at += sprintf(at, "%s[%d,1]", i ? "," : "", i % 10);
    sprintf(at, "]]}");
    assert_fails(parse(r, text), r->error, FRAM_ERROR_INPUT, "more than 100000 positions");
    ck_assert_str_eq(r->error.key, "feature 1, polygon 1, ring 1");
    free(text);
    rig_free(r);
}
END_TEST

/* head, then an item so many times with commas between, then tail. */
static char *repeated(const char *head, const char *item, int32_t count, const char *tail)
{
    size_t each = strlen(item), begin = strlen(head);
    char *text = malloc(begin + (size_t)count * (each + 1) + strlen(tail) + 1), *at = text;
    ck_assert_ptr_nonnull(text);
    memcpy(at, head, begin);
    at += begin;
    for (int32_t i = 0; i < count; i++) {
        if (i > 0)
            *at++ = ',';
        memcpy(at, item, each);
        at += each;
    }
    memcpy(at, tail, strlen(tail) + 1);
    return text;
}

static void check_limit(char *text, const char *message)
{
    rig *r = rig_make();
    assert_fails(parse(r, text), r->error, FRAM_ERROR_INPUT, message);
    ck_assert_int_eq(r->rings.place.count, 0);
    free(text);
    rig_free(r);
}

START_TEST(counts_are_limited)
{
    check_limit(repeated("{\"type\":\"Polygon\",\"coordinates\":[", "[[0,0]]", GEOJSON_RINGS_MOST + 1, "]}"),
                "more than 1000000 rings");
    check_limit(repeated("{\"type\":\"FeatureCollection\",\"features\":[", "{\"type\":\"Feature\",\"geometry\":null}",
                         GEOJSON_FEATURES_MOST + 1, "]}"),
                "more than 1000000 features");
    if (getenv("FRAM_TEST_SHORT")) /* sixty million bytes, one after the other */
        return;
    enum { WHOLE_RINGS = GEOJSON_VERTICES_MOST / GEOJSON_RING_VERTICES_MOST };
    char *ring = repeated("[", "[0,0]", GEOJSON_RING_VERTICES_MOST, "]");
    char *rings = repeated("{\"type\":\"Polygon\",\"coordinates\":[", ring, WHOLE_RINGS + 1, "]}");
    check_limit(rings, "more than 10000000 positions");
    free(ring);
}
END_TEST

START_TEST(files_are_limited)
{
    rig *r = rig_make();
    scratch place = scratch_make();
    const char *path = scratch_path(&place, "large.geojson");
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    ck_assert_int_eq(ftruncate(fileno(file), (off_t)GEOJSON_BYTES_MOST + 1), 0);
    fclose(file);
    assert_fails(outline_file_read(&r->ctx, path, &r->rings, &r->error), r->error, FRAM_ERROR_INPUT,
                 "at most 268435456 bytes");
    scratch_remove(&place, "large.geojson");
    rig_free(r);
}
END_TEST

/* ---- memory ---- */

/* GEOS has its own memory; Fram's runs out at every request in turn. */
START_TEST(memory_runs_out)
{
    static const char text[] = COLLECTION(FEATURE(SQUARE) "," FEATURE("[[5,5],[15,5],[15,16],[5,5]]") "," FEATURE(
        "[[20,0],[30,10],[30,0],[20,10],[20,0]]"));
    for (failing_turn turn = {0}; failing_next(&turn);) {
        import_rings rings = {0};
        import_field field = {0};
        import_measure m;
        import_options o = options_of(IMPORT_REPAIR);
        overlay *plane = overlay_create(&turn.ctx);
        turn.status = plane ? geojson_parse(&turn.ctx, "floes.geojson", text, strlen(text), &rings, &turn.error)
                            : FRAM_ERROR_MEMORY;
        if (turn.status == FRAM_OK)
            turn.status = import_field_make(&turn.ctx, plane, &rings, &o, &field, &turn.error);
        if (turn.status == FRAM_OK)
            turn.status = import_field_measure(&turn.ctx, plane, NULL, &field.outlines, &m, &turn.error);
        import_rings_free(&turn.ctx, &rings);
        import_field_free(&turn.ctx, &field);
        if (plane)
            overlay_free(plane);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("geojson");
    TCase *cases = tcase_create("geojson");
    tcase_add_test(cases, features_of_all_kinds);
    tcase_add_loop_test(cases, texts_are_refused_at_their_place, 0, BAD_TEXTS);
    tcase_add_loop_test(cases, bad_rings_are_refused_dropped_repaired, 0, BAD_RINGS);
    tcase_add_test(cases, scribbles_are_not_repaired);
    tcase_add_test(cases, a_chain_of_squares_is_no_scribble);
    tcase_add_test(cases, holes_are_filled_on_request);
    tcase_add_test(cases, clockwise_rings_are_turned_scaled_and_moved);
    tcase_add_test(cases, far_coordinates_and_empty_fields_are_refused);
    tcase_add_test(cases, crop_slivers_and_keep_out);
    tcase_add_test(cases, tiles_stay_whole);
    tcase_add_test(cases, overlaps_are_measured_and_cut);
    tcase_add_test(cases, one_floe_is_cut_by_many);
    tcase_add_test(cases, a_sliver_is_thin_not_small);
    tcase_add_test(cases, a_bent_overlap_is_as_wide_as_its_strip);
    tcase_add_test(cases, an_overlap_is_as_wide_as_its_widest_part);
    tcase_add_test(cases, simplified_within_the_tolerance);
    tcase_add_test(cases, what_is_written_reads_back_to_the_bit);
    tcase_add_test(cases, limits_and_files);
    tcase_add_test(cases, counts_are_limited);
    tcase_add_test(cases, files_are_limited);
    tcase_add_test(cases, memory_runs_out);
    suite_add_tcase(suite, cases);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
