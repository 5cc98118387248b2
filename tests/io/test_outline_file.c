/* io/outline_file: WKT and lines of points, what is read, what is refused and where. */
#include "io/outline_file.h"
#include "scratch.h"
#include <math.h>
#include <stdio.h>

static context ctx;
static import_rings rings;
static fram_error error;

static fram_status parse(const char *text)
{
    context_init(&ctx);
    import_rings_free(&ctx, &rings);
    error = (fram_error){0};
    return outline_file_parse(&ctx, "floes", text, strlen(text), &rings, &error);
}

/* feature, polygon, ring, line, column, vertices, open */
static void check_ring(int32_t i, const int expected[7])
{
    ck_assert_int_lt(i, rings.place.count);
    const import_place *p = &rings.place.data[i];
    const int found[7] = {p->feature, p->polygon, p->ring, p->line, p->column, polygon_list_get(&rings.rings, i).count,
                          p->open};
    for (int k = 0; k < 7; k++)
        ck_assert_msg(found[k] == expected[k], "ring %d: number %d is %d, expected %d", i, k, found[k], expected[k]);
    ck_assert(isnan(p->thickness));
}

START_TEST(wkt_of_all_kinds)
{
    assert_ok(parse("# floes of the day\n"
                    "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))\n"
                    "Polygon Z((0 0 5,\n  2 0 5, 2 1 5, 0 0 5), (1 0.1 0, 1.2 0.1 0, 1.2 0.2 0, 1 0.1 0))  # a hole\n"
                    "\n"
                    "  multipolygon(((0 0,1 0,1 1,0 0)),((5 5,6 5,6 6,5 5)))\tPOLYGON EMPTY\n"
                    "POLYGON ZM ((1e1 -2.5e-1 0 0, +3 .5 0 0, 4 4 0 0))"),
              error);
    ck_assert_int_eq(rings.place.count, 6);
    check_ring(0, (const int[]){1, 1, 1, 2, 10, 4, 0});
    check_ring(1, (const int[]){2, 1, 1, 3, 11, 3, 0});
    check_ring(2, (const int[]){2, 1, 2, 4, 25, 3, 0});
    check_ring(3, (const int[]){3, 1, 1, 6, 17, 3, 0});
    check_ring(4, (const int[]){3, 2, 1, 6, 37, 3, 0});
    check_ring(5, (const int[]){5, 1, 1, 7, 13, 3, 1});
    polygon last = polygon_list_get(&rings.rings, 5);
    assert_bits(last.vertex[0].x, 10);
    assert_bits(last.vertex[0].y, -0.25);
    assert_bits(last.vertex[1].y, 0.5);
    import_rings_free(&ctx, &rings);
}
END_TEST

/* As spreadsheets and editors write it before the first character. */
START_TEST(byte_order_mark)
{
    static const char *const texts[] = {"\xef\xbb\xbfPOLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))",
                                        "\xef\xbb\xbf"
                                        "0 0\n10 0\n10 10\n0 10\n",
                                        "\xef\xbb\xbf{\"type\": \"Polygon\", \"coordinates\": "
                                        "[[[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]]}"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        assert_ok(parse(texts[i]), error);
        ck_assert_int_eq(rings.place.count, 1);
        ck_assert_int_eq(polygon_list_get(&rings.rings, 0).count, 4);
        import_rings_free(&ctx, &rings);
    }
}
END_TEST

START_TEST(lines_of_points)
{
    assert_ok(parse("# x y\r\n0 0\r\n10\t0\r\n10,10\r\n0 ; 10\r\n\r\n\r\n> second\n1 1\n2 1\n2 2\n1 1\n>\n"
                    "   -1e0 .5\n# between\n3 4\n5 6"),
              error);
    ck_assert_int_eq(rings.place.count, 3);
    check_ring(0, (const int[]){1, 1, 1, 2, 1, 4, 0});
    check_ring(1, (const int[]){2, 1, 1, 9, 1, 3, 0});
    check_ring(2, (const int[]){3, 1, 1, 14, 4, 3, 0});
    assert_bits(polygon_list_get(&rings.rings, 2).vertex[0].x, -1);
    /* Rows that say a position twice, and an outline that touches itself where it begins. */
    assert_ok(parse("0 0\n0 0\n1 0\n1 1\n0 0\n0 0\n\n0 0\n1 0\n1 1\n0 0\n-1 0\n-1 -1\n0 0\n"), error);
    ck_assert_int_eq(rings.place.count, 2);
    check_ring(1, (const int[]){2, 1, 1, 8, 1, 6, 0});
    /* Neither a position that is said twice nor a spike ends an outline that does not come back. */
    assert_ok(parse("0 0\n0 0\n1 0\n1 1\n\n5 5\n6 5\n5 5\n6 6\n"), error);
    ck_assert_int_eq(rings.place.count, 2);
    check_ring(0, (const int[]){1, 1, 1, 1, 1, 4, 0});
    check_ring(1, (const int[]){2, 1, 1, 6, 1, 4, 0});
    import_rings_free(&ctx, &rings);
}
END_TEST

START_TEST(geojson_is_told_apart)
{
    assert_ok(parse("\n {\"type\":\"Polygon\",\"coordinates\":[[[0,0],[1,0],[1,1],[0,0]]]}"), error);
    ck_assert_int_eq(rings.place.count, 1);
    import_rings_free(&ctx, &rings);
}
END_TEST

static void check_refusal(const char *text, int line, int column, const char *key, const char *part)
{
    ck_assert_msg(parse(text) == FRAM_ERROR_INPUT, "taken: %s", text);
    ck_assert_str_eq(error.file, "floes");
    ck_assert_msg(error.line == line && error.column == column, "%s\n%d:%d: %s", text, error.line, error.column,
                  error.message);
    ck_assert_str_eq(error.key, key);
    ck_assert_msg(strstr(error.message, part), "%s", error.message);
    ck_assert(!rings.place.data && !rings.rings.vertex.data);
}

START_TEST(refusals_say_where)
{
    check_refusal("", 1, 1, "", "an empty file");
    check_refusal("# nothing\n", 1, 1, "", "an empty file");
    check_refusal("\"0 0\"", 1, 1, "", "GeoJSON, WKT or lines");
    check_refusal("POINT (1 2)", 1, 1, "feature 1", "found POINT");
    check_refusal("POLYGON ((0 0, 1 0, 1 1, 0 0))\nPOLYGON 0 0", 2, 9, "feature 2", "expected (");
    check_refusal("POLYGON ((0 0, 1 0, 1", 1, 22, "feature 1, polygon 1, ring 1", "2 to 4 numbers, found 1");
    check_refusal("POLYGON ((0 0, 1 0, 1 1, 0 0)", 1, 30, "feature 1", "expected )");
    check_refusal("POLYGON ((0 0, 1 north, 1 1, 0 0))", 1, 18, "feature 1, polygon 1, ring 1", "finite number");
    check_refusal("POLYGON ((0 0 0 0 0, 1 1))", 1, 19, "feature 1, polygon 1, ring 1", "found more");
    check_refusal("POLYGON ((0 0, 1 0,\n 1e999 1, 0 0))", 2, 2, "feature 1, polygon 1, ring 1", "finite number");
    check_refusal("POLYGON ((0 0, 1 0, 1 1, 0 0)) 5", 1, 32, "feature 2", "no word");
    check_refusal("0 0\n1 0\n1 1 7\n", 3, 5, "feature 1, polygon 1, ring 1", "found more");
    check_refusal("0 0\n1\n", 2, 2, "feature 1, polygon 1, ring 1", "found none");
    check_refusal("0 0\n1 0\n1 1\n\n2 2\n3 x", 6, 3, "feature 2, polygon 1, ring 1", "finite number");
    check_refusal("9 9\n8 9\n8 8\n\n0 0\n1 0\n1 1\n0 0\n 5 5\n6 5\n6 6\n5 5\n7 7\n8 7\n8 8\n7 7\n", 9, 2,
                  "feature 2, polygon 1, ring 1", "divided by a blank line");
    check_refusal("0 0,5", 1, 4, "feature 1, polygon 1, ring 1", "found more");
    check_refusal("0x10 3", 1, 1, "feature 1, polygon 1, ring 1", "finite number");
}
END_TEST

/* The way into a field: the same options and refusals as for GeoJSON. */
START_TEST(rings_become_floes)
{
    assert_ok(parse("0 0\n10 0\n10 10\n0 10\n\n20 0\n30 10\n30 0\n20 10\n"), error);
    overlay *plane = overlay_create(&ctx);
    import_field field = {0};
    import_options options = {.name = "floes", .scale = 2, .bad = IMPORT_REFUSE};
    ck_assert_int_eq(import_field_make(&ctx, plane, &rings, &options, &field, &error), FRAM_ERROR_INPUT);
    ck_assert_int_eq(error.line, 6);
    ck_assert_str_eq(error.key, "feature 2, polygon 1, ring 1");
    options.bad = IMPORT_REPAIR;
    assert_ok(import_field_make(&ctx, plane, &rings, &options, &field, &error), error);
    ck_assert_int_eq(polygon_list_count(&field.outlines), 3);
    assert_relative(polygon_area(polygon_list_get(&field.outlines, 0)), 400, 1e-15);
    import_field_free(&ctx, &field);
    overlay_free(plane);
    import_rings_free(&ctx, &rings);
}
END_TEST

static fram_status read_back(context *c)
{
    import_rings out = {0};
    fram_error e = {0};
    static const char text[] = "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((5 5, 6 5, 6 6, 5 5)))";
    fram_status status = outline_file_parse(c, "floes", text, sizeof text - 1, &out, &e);
    import_rings_free(c, &out);
    return status;
}

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);)
        turn.status = read_back(&turn.ctx);
}
END_TEST

TEST_MAIN("outline_file", wkt_of_all_kinds, byte_order_mark, lines_of_points, geojson_is_told_apart, refusals_say_where,
          rings_become_floes, memory_runs_out)
