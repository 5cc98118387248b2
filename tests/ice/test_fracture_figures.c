/* Figures 22 to 28 of the reference, rebuilt: each construction on a floe like that of the figure, with what the text
   says about it, and drawn.  docs/pictures/fracture_figures.svg is what this test draws; FRAM_UPDATE=1 in the
   environment writes it anew. */
#include "fracture_rig.h"

#include "ice/fracture_parts.h"

#include <stdarg.h>
#include <stdio.h>

static const char *const PICTURE = "docs/pictures/fracture_figures.svg";

/* ---- drawing ---- */

enum { PANEL = 300, SVG_ROOM = 60000 };

typedef struct drawing {
    char text[SVG_ROOM];
    size_t size;
    double x, y, scale; /* of the panel: origin in pixels, pixels per metre */
} drawing;

static void put(drawing *d, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void put(drawing *d, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int n = vsnprintf(d->text + d->size, SVG_ROOM - d->size, format, arguments);
    va_end(arguments);
    ck_assert_int_gt(n, 0);
    d->size += (size_t)n;
    ck_assert_uint_lt(d->size, SVG_ROOM);
}

static void panel(drawing *d, int column, int row, double scale, const char *title)
{
    d->x = PANEL * (column + 0.5);
    d->y = PANEL * (row + 0.5) + 14;
    d->scale = scale;
    put(d, "<text x=\"%d\" y=\"%d\">%s</text>\n", PANEL * column + 12, PANEL * row + 22, title);
}

static void ring(drawing *d, polygon p, const char *style)
{
    put(d, "<polygon class=\"%s\" points=\"", style);
    for (int32_t i = 0; i < p.count; i++)
        put(d, "%.1f,%.1f ", d->x + d->scale * p.vertex[i].x, d->y - d->scale * p.vertex[i].y);
    put(d, "\"/>\n");
}

static void rings(drawing *d, const polygon_list *list, const char *style)
{
    for (int32_t i = 0; i < polygon_list_count(list); i++)
        ring(d, polygon_list_get(list, i), style);
}

static void line(drawing *d, vec2 a, vec2 b, const char *style)
{
    put(d, "<line class=\"%s\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>\n", style, d->x + d->scale * a.x,
        d->y - d->scale * a.y, d->x + d->scale * b.x, d->y - d->scale * b.y);
}

static void dot(drawing *d, vec2 p, const char *style)
{
    put(d, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"4\"/>\n", style, d->x + d->scale * p.x,
        d->y - d->scale * p.y);
}

static void circle(drawing *d, vec2 p, double radius, const char *style)
{
    put(d, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"/>\n", style, d->x + d->scale * p.x,
        d->y - d->scale * p.y, d->scale * radius);
}

static const char *const HEAD =
    "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\""
    " font-family=\"sans-serif\" font-size=\"14\">\n"
    "<style>polygon,line,circle{stroke-width:1.5;stroke-linejoin:round}.floe{fill:#d2e6f5;stroke:#33658a}"
    ".one{fill:#9fc5e8;stroke:#1c4587}.two{fill:#f4b6a6;stroke:#a61c00}.wedge{fill:#7fd6c2;stroke:#0b6e5a}"
    ".gone{fill:none;stroke:#1a237e;stroke-dasharray:5 4}.crack{stroke:#d00000;stroke-width:3}"
    ".ray{stroke:#888;stroke-dasharray:3 3}.hit{fill:#fff;stroke:#d00000}.load{fill:#d00000;stroke:none}"
    ".reach{fill:none;stroke:#666;stroke-dasharray:4 4}.spike{fill:#d00000;stroke:none}"
    ".merged{fill:#2e9e3f;stroke:none}"
    ".smooth{fill:#1f5fd0;stroke:none}</style>\n<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n";

/* ---- figures ---- */

/* A concave floe: an arm on each side of a bay. */
static const vec2 CONCAVE[] = {{-10, -9}, {8, -10}, {11, 2}, {9, 10}, {4, 9},
                               {2, -1},   {-2, -2}, {-4, 8}, {-9, 9}, {-11, 0}};
enum { CONCAVE_COUNT = sizeof CONCAVE / sizeof *CONCAVE };

/* 22: the crack's line meets the boundary several times; the shortest way is the crack. */
static crack_start figure_22(drawing *d)
{
    polygon p = {CONCAVE, CONCAVE_COUNT};
    crack_start start = crack_start_of(p, (vec2){-10.2, 3.7}, 1e-9);
    int32_t edge;
    double way = crack_length(p, &start, &edge);
    panel(d, 0, 0, 11, "22  splitting points, and the crack");
    ring(d, p, "floe");
    line(d, start.point, vec2_add(start.point, vec2_scale(start.direction, 24)), "ray");
    int hits = 0;
    for (int32_t i = 0; i < p.count; i++) {
        vec2 a = vec2_sub(p.vertex[i], start.point), b = vec2_sub(p.vertex[(i + 1) % p.count], start.point);
        double u = vec2_cross(start.direction, a), v = vec2_cross(start.direction, b);
        if (i == start.edge || (u > 0) == (v > 0))
            continue;
        vec2 at = vec2_add(start.point, vec2_add(a, vec2_scale(vec2_sub(b, a), u / (u - v))));
        ck_assert_double_ge(vec2_length(vec2_sub(at, start.point)), way * (1 - 1e-12));
        dot(d, at, "hit");
        hits++;
    }
    ck_assert_int_eq(hits, 3);
    ck_assert(way > 4 && way < 9);
    line(d, start.point, vec2_add(start.point, vec2_scale(start.direction, way)), "crack");
    dot(d, start.point, "load");
    return start;
}

/* 23: the crack runs through when it is longer than R_bending and shorter than S_k R_bending. */
static void figure_23(drawing *d, const crack_start *start)
{
    polygon p = {CONCAVE, CONCAVE_COUNT};
    fracture_settings settings = fracture_rig_settings();
    double length, way;
    int32_t edge;
    way = crack_length(p, start, &edge);
    fracture_load load = {.radial_ratio = 2, .stress = {.breaking_radius = way / 2}};
    panel(d, 1, 0, 6.5, "23  S_k R: too short, and far enough");
    ring(d, p, "floe");
    const double factors[] = {1.5, 2.6};
    for (int i = 0; i < 2; i++) {
        settings.splitting_factor = factors[i];
        ck_assert_int_eq(fracture_splits(&settings, p, &load, 1, start, &length), i);
        circle(d, start->point, factors[i] * way / 2, "reach");
    }
    circle(d, start->point, way / 2, "gone");
    line(d, start->point, vec2_add(start->point, vec2_scale(start->direction, way)), "crack");
    dot(d, start->point, "load");
}

/* 24: the two children share the crack points and nothing else. */
static void figure_24(drawing *d, const crack_start *start)
{
    context ctx;
    context_init(&ctx);
    polygon p = {CONCAVE, CONCAVE_COUNT};
    fracture_settings settings = fracture_rig_settings();
    polygon_list out = {0};
    bool memory = false;
    panel(d, 2, 0, 11, "24  the two floes of a split");
    ck_assert(fracture_split(&ctx, &settings, p, start, &out, &memory));
    ck_assert_int_eq(polygon_list_count(&out), 2);
    polygon a = polygon_list_get(&out, 0), b = polygon_list_get(&out, 1);
    ck_assert_int_eq(a.count + b.count, CONCAVE_COUNT + 4);
    assert_relative(polygon_area(a) + polygon_area(b), polygon_area(p), 1e-14);
    ring(d, a, "one");
    ring(d, b, "two");
    polygon_list_free(&ctx, &out);
}

/* 25: a circle in 2 N wedges, N = 3. */
static void figure_25(drawing *d)
{
    const crack_start start = {.point = {0, 0}, .direction = {1, 0}};
    vec2 stencil[MOST_STENCIL];
    int count = fracture_stencil(3, 10, &start, stencil);
    ck_assert_int_eq(count, 6);
    panel(d, 3, 0, 11, "25  the stencil, N = 3");
    ring(d, (polygon){stencil, count}, "wedge");
    for (int i = 0; i < count; i++) {
        assert_relative(vec2_length(stencil[i]), 10, 1e-14);
        assert_relative(vec2_dot(stencil[i], stencil[(i + 1) % count]), 50, 1e-12);
        line(d, start.point, stencil[i], "ray");
        dot(d, stencil[i], "hit");
    }
}

/* 26, 27: what the stencil leaves of a floe, and the wedges; of a small floe it leaves several remnants. */
static void bending(drawing *d, int column, const char *title, polygon p, vec2 load, double radius, int remnants)
{
    context ctx;
    context_init(&ctx);
    overlay *plane = overlay_create(&ctx);
    polygon_list left = {0}, wedges = {0};
    fram_error e = {0};
    crack_start start = crack_start_of(p, load, 1e-9);
    vec2 stencil[MOST_STENCIL];
    int count = fracture_stencil(3, radius, &start, stencil);
    panel(d, column, 1, 9.5, title);
    break_shape shape;
    fracture_shape(3, &start, &(break_size){.side = radius}, &shape);
    assert_ok(fracture_bend(&ctx, plane, &shape, p, &left, &wedges, &e), e);
    ck_assert_int_eq(polygon_list_count(&left), remnants);
    double area = 0;
    for (int32_t i = 0; i < polygon_list_count(&left); i++)
        area += polygon_area(polygon_list_get(&left, i));
    for (int32_t i = 0; i < polygon_list_count(&wedges); i++)
        area += polygon_area(polygon_list_get(&wedges, i));
    assert_relative(area, polygon_area(p), 1e-12);
    rings(d, &left, "floe");
    rings(d, &wedges, "wedge");
    ring(d, (polygon){stencil, count}, "gone");
    dot(d, start.point, "load");
    polygon_list_free(&ctx, &left);
    polygon_list_free(&ctx, &wedges);
    overlay_free(plane);
}

/* 28: near vertices become one, a spike goes, a smooth corner becomes straight. */
static void figure_28(drawing *d)
{
    context ctx;
    context_init(&ctx);
    const vec2 dirty[] = {{-10, -8},   {-0.2, -8.08}, {10, -8},    {10.05, -7.96}, {10, 8},
                          {2.02, 7.9}, {2, 14},       {1.98, 7.9}, {-10, 8}};
    polygon p = {dirty, sizeof dirty / sizeof *dirty};
    vec2_array out = {0};
    ck_assert(polygon_clean(&ctx, p, 0.15, &out));
    panel(d, 2, 1, 8, "28  cleaning");
    ring(d, p, "gone");
    ring(d, (polygon){out.data, out.count}, "floe");
    dot(d, dirty[1], "smooth");
    dot(d, dirty[2], "merged");
    dot(d, dirty[6], "spike");
    for (int32_t i = 0; i < out.count; i++) {
        ck_assert(out.data[i].y < 13);
        vec2 e = vec2_sub(out.data[(i + 1) % out.count], out.data[i]);
        ck_assert_double_ge(vec2_length(e), 0.15);
    }
    ck_assert_int_le(out.count, 5);
    array_free(&ctx, &out);
}

static void draw_all(drawing *d)
{
    put(d, HEAD, 4 * PANEL, 2 * PANEL);
    crack_start start = figure_22(d);
    figure_23(d, &start);
    figure_24(d, &start);
    figure_25(d);
    const vec2 large[] = {{-12, -11}, {11, -11}, {12, 6}, {4, 11}, {-9, 10}};
    bending(d, 0, "26  wedges out of a large floe", (polygon){large, 5}, (vec2){2, -11}, 7, 1);
    const vec2 small[] = {{-11, -6}, {-2, -5}, {9, -6}, {12, 1}, {3, 1.5}, {-4, 1}, {-12, 2}};
    bending(d, 1, "27  wedges out of a small floe", (polygon){small, 7}, (vec2){-1, -5}, 7.2, 2);
    figure_28(d);
    put(d, "</svg>\n");
}

START_TEST(figures)
{
    drawing *d = calloc(1, sizeof *d);
    char *old = calloc(1, SVG_ROOM);
    ck_assert(d && old);
    draw_all(d);
    if (getenv("FRAM_UPDATE")) {
        FILE *f = fopen(PICTURE, "wb");
        ck_assert(f);
        ck_assert_uint_eq(fwrite(d->text, 1, d->size, f), d->size);
        ck_assert_int_eq(fclose(f), 0);
    }
    FILE *f = fopen(PICTURE, "rb");
    ck_assert_msg(f != NULL, "%s is missing: run this test with FRAM_UPDATE=1", PICTURE);
    size_t n = fread(old, 1, SVG_ROOM, f);
    ck_assert_int_eq(fclose(f), 0);
    ck_assert_msg(n == d->size && memcmp(old, d->text, n) == 0, "%s is out of date: run this test with FRAM_UPDATE=1",
                  PICTURE);
    free(d);
    free(old);
}
END_TEST

TEST_MAIN("fracture_figures", figures)
