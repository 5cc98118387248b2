/* Plan views: tilted prisms stand with their sides, and what lies under other ice is covered. */
#include "io/image.h"
#include "io/plan_flows.h"
#include "io/plan_view.h"

#include "base/transcendental.h"
#include "io/scenario_file.h"
#include "scratch.h"

START_TEST(level_prism)
{
    plan_shape s = {.style = PLAN_FLOE};
    plan_shape_stand(&s, (vec3){5, 6, 0.2}, (quat){1, 0, 0, 0}, 1.5);
    assert_bits(vec2_length(s.drop), 0);
    assert_bits(s.height, 0.2 + 0.75);
}
END_TEST

/* Rolled by an angle about x: its axis leans along -y; over 90 degrees the lower face is up. */
START_TEST(tilted_prism)
{
    const double angles[] = {0.3, PI / 2, 2, 3};
    for (int i = 0; i < 4; i++) {
        plan_shape s = {.style = PLAN_FLOE};
        double a = angles[i], axis_z = real_cos(a), axis_y = -real_sin(a), sign = axis_z < 0 ? 1 : -1;
        plan_shape_stand(&s, (vec3){0, 0, 0}, quat_from_roll_pitch_yaw(a, 0, 0), 2);
        assert_absolute(s.drop.x, 0, 1e-12);
        if (fabs(axis_z) > 1e-9)
            assert_absolute(s.drop.y, 2 * sign * axis_y, 1e-12);
        assert_absolute(fabs(s.drop.y), 2 * fabs(axis_y), 1e-12);
        assert_absolute(s.height, fabs(axis_z), 1e-12);
    }
}
END_TEST

START_TEST(sorted)
{
    const vec2 corner[4] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
    plan_shape s[4] = {{.outline = {corner + 2, 1}, .height = 1},
                       {.outline = {corner + 3, 1}, .height = -1},
                       {.outline = {corner, 1}, .height = 1},
                       {.outline = {corner + 1, 1}, .height = 0}};
    const int expected[4] = {3, 1, 0, 2};
    plan_shapes_sort(s, 4);
    for (int i = 0; i < 4; i++)
        ck_assert_ptr_eq(s[i].outline.vertex, corner + expected[i]);
    plan_shapes_sort(s, 0);
}
END_TEST

/* A field of 100 by 40 m and a ship of 20 by 4 m on course along X, with half its length of water around it outside,
   in windows of the field's proportions. */
START_TEST(a_hull_outside)
{
    const box2 usual = {{0, 0}, {100, 40}};
    const struct {
        vec2 ship, other; /* their centres */
        box2 window;
        int32_t owner[2];
    } rows[] = {
        {{50, 20}, {500, 20}, usual, {0, 1}}, /* one is seen */
        {{109, 20}, {-9, 41}, usual, {0, 1}}, /* parts are */
        {{140, 20}, {120, 20}, {{0, -12}, {160, 52}}, {0, 1}},
        {{-30, 20}, {50, -20}, {{-65, -32}, {115, 40}}, {0, 1}},
        {{50, -100}, {50, -100}, {{-140, -112}, {240, 40}}, {0, 1}}, /* 3.8 times as large */
        {{50, -130}, {50, -130}, {{0, -150}, {100, -110}}, {0, 1}},  /* more than 4 times */
        {{50, 20}, {(double)NAN, 20}, usual, {0, 1}},
        {{(double)NAN, 20}, {140, 20}, {{0, -12}, {160, 52}}, {0, 1}},
        {{(double)NAN, 20}, {1000, 20}, {{950, 0}, {1050, 40}}, {0, 1}},
        {{1000, 20}, {120, 20}, {{950, 0}, {1050, 40}}, {0, 1}}, /* too far off */
        {{120, 20}, {1e300, 20}, {{70, 0}, {170, 40}}, {0, 1}},
        {{1000, 20}, {-4000, 20}, {{-4050, 0}, {-3950, 40}}, {1, 0}},
        {{1000, 10}, {1000, 30}, {{940, -4}, {1060, 44}}, {0, 0}}, /* the hulls of a catamaran */
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        vec2 hull[2][4];
        for (int k = 0; k < 4; k++) {
            vec2 corner = {k == 1 || k == 2 ? 10 : -10, k < 2 ? -2 : 2};
            hull[0][k] = vec2_add(rows[i].ship, corner);
            hull[1][k] = vec2_add(rows[i].other, corner);
        }
        const plan_shape s[] = {{.outline = {hull[0], 4}, .style = PLAN_FLOE},
                                {.outline = {hull[0], 4}, .style = PLAN_DECK, .owner = rows[i].owner[0]},
                                {.outline = {hull[1], 4}, .style = PLAN_WATERLINE, .owner = rows[i].owner[1]}};
        box2 found = plan_window(usual, s, 3), expected = rows[i].window;
        assert_vec2_close(found.lo, expected.lo, 1e-9);
        assert_vec2_close(found.hi, expected.hi, 1e-9);
        found = plan_window(usual, s, 1); /* of floes alone */
        assert_vec2_close(found.lo, usual.lo, 0);
    }
}
END_TEST

/* One across a corner of the field is in it by its edges, not by the bounds around it. */
START_TEST(a_hull_across_a_corner)
{
    const box2 usual = {{-10, -10}, {10, 10}}, larger = {{-15.5, -15.5}, {46.5, 46.5}};
    const vec2 ring[2][4] = {{{30, 0}, {31, 1}, {1, 31}, {0, 30}}, {{24, -6}, {25, -5}, {-5, 25}, {-6, 24}}};
    for (int i = 0; i < 2; i++) {
        const plan_shape s = {.outline = {ring[i], 4}, .style = PLAN_DECK};
        box2 found = plan_window(usual, &s, 1), expected = i == 0 ? larger : usual;
        assert_vec2_close(found.lo, expected.lo, 1e-9);
        assert_vec2_close(found.hi, expected.hi, 1e-9);
    }
}
END_TEST

/* A legend names what the window shows a part of, a tilted prism by its sides, and not what lies beside it, though the
   bounds of an outline across a corner meet the window. */
START_TEST(styles_in_the_window)
{
    const struct {
        vec2 ring[4], drop;
        bool seen;
    } rows[] = {
        {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {0, 0}, true},
        {{{10, -12}, {12, -12}, {12, 12}, {10, 12}}, {0, 0}, false},
        {{{9, 9}, {11, 9}, {11, 11}, {9, 11}}, {0, 0}, true},
        {{{11, 0}, {12, 0}, {12, 1}, {11, 1}}, {3, 0}, true},
        {{{11, 0}, {12, 0}, {12, 1}, {11, 1}}, {-3, 0}, true},
        {{{11, 0}, {12, 0}, {12, 1}, {11, 1}}, {0, 0}, false},
        {{{-20, -1}, {20, -1}, {20, 1}, {-20, 1}}, {0, 0}, true}, /* from side to side */
        {{{-90, -90}, {90, -90}, {90, 90}, {-90, 90}}, {0, 0}, true},
        {{{30, 0}, {31, 1}, {1, 31}, {0, 30}}, {0, 0}, false}, /* across a corner */
        {{{30, 0}, {31, 1}, {1, 31}, {0, 30}}, {8, 8}, false},
        {{{30, 0}, {31, 1}, {1, 31}, {0, 30}}, {12, 12}, true},
    };
    for (int i = 0; i < (int)(sizeof rows / sizeof *rows); i++) {
        plan_style style = (plan_style)(i % PLAN_STYLE_COUNT);
        const plan_shape shape = {.outline = {rows[i].ring, 4}, .drop = rows[i].drop, .style = style};
        const plan_view view = {.window = {{-10, -10}, {10, 10}}, .shapes = &shape, .shape_count = 1};
        const plan_used seen = plan_find_used(&view);
        for (int k = 0; k < PLAN_STYLE_COUNT; k++)
            ck_assert_msg(seen.style[k] == (k == i % PLAN_STYLE_COUNT && rows[i].seen), "row %d, style %d", i, k);
    }
}
END_TEST

START_TEST(lines_in_the_window)
{
    const plan_line lines[] = {
        {{11, 0}, {40, 0}}, {{25, 0}, {0, 25}},  {{40, 10}, {-40, 10}}, /* beside, along a side */
        {{5, 0}, {40, 0}},  {{-40, 3}, {40, 4}}, {{15, 0}, {0, 15}},    {{5, 5}, {5, 5}}};
    for (int i = 0; i < 7; i++) {
        const plan_view view = {.window = {{-10, -10}, {10, 10}}, .lines = &lines[i], .line_count = 1};
        ck_assert_msg(plan_find_used(&view).line == (i > 2), "line %d", i);
    }
}
END_TEST

static plan_flows flows_of(const char *text, double time)
{
    context ctx;
    scenario s;
    fram_error error;
    context_init(&ctx);
    ck_assert_msg(scenario_parse(&ctx, "flows.yaml", text, strlen(text), NULL, &s, &error) == FRAM_OK, "%s",
                  error.message);
    plan_flows flows = plan_flows_at(&ctx, &s, time);
    scenario_free(&ctx, &s);
    return flows;
}

/* Drift of its own, current and wind towards 90, 180 and -30 degrees; what stands still is not there. */
START_TEST(flows_that_move)
{
    plan_flows f = flows_of("domain: {boundary: feeding, drift_speed: 0.5, drift_direction_deg: 90}\n"
                            "environment: {current_speed: 0.4, current_direction_deg: 180, wind_speed: 10,\n"
                            "              wind_direction_deg: -30}\n",
                            0);
    ck_assert_int_eq(f.count, 3);
    ck_assert_str_eq(f.flow[0].name, "drift");
    assert_absolute(f.flow[0].velocity.y, 0.5, 1e-12);
    ck_assert_str_eq(f.flow[1].name, "current");
    assert_absolute(f.flow[1].velocity.x, -0.4, 1e-12);
    ck_assert_str_eq(f.flow[2].name, "wind");
    assert_absolute(f.flow[2].velocity.x, 10 * sqrt(0.75), 1e-12);
    assert_absolute(f.flow[2].velocity.y, -5, 1e-12);
    f = flows_of("ice: {source: none}\nenvironment: {wind_speed: 3}\n", 0);
    ck_assert_int_eq(f.count, 1);
    ck_assert_str_eq(f.flow[0].name, "wind");
}
END_TEST

/* scenes/drift_reversal.csv: 0.3 m/s towards -X until 240 s, (0.3, 0.06) from 480 s on. */
START_TEST(flows_of_a_history)
{
    const char *text = "environment: {current_file: scenes/drift_reversal.csv}\n";
    plan_flows before = flows_of(text, 0), after = flows_of(text, 1700);
    ck_assert_int_eq(before.count, 1);
    assert_absolute(before.flow[0].velocity.x, -0.3, 1e-12);
    assert_absolute(after.flow[0].velocity.x, 0.3, 1e-12);
    assert_absolute(after.flow[0].velocity.y, 0.06, 1e-12);
}
END_TEST

/* What a profile has at the surface is on top of the rest, and is all where there is no rest. */
START_TEST(flows_of_a_profile)
{
    char text[400];
    scratch folder = scratch_make();
    FILE *file = fopen(scratch_path(&folder, "profile.csv"), "w");
    ck_assert_ptr_nonnull(file);
    fputs("depth [m],x [m/s],y [m/s]\n2,-1,0.5\n50,-0.2,0\n", file);
    ck_assert_int_eq(fclose(file), 0);
    for (int keys = 0; keys < 2; keys++) {
        snprintf(text, sizeof text, "environment: {current_speed: %d, current_profile_file: %s}\n", keys, folder.path);
        plan_flows f = flows_of(text, 0);
        ck_assert_int_eq(f.count, 1);
        assert_absolute(f.flow[0].velocity.x, keys - 1, 1e-12);
        assert_absolute(f.flow[0].velocity.y, 0.5, 1e-12);
    }
    scratch_remove(&folder, "profile.csv");
}
END_TEST

#ifdef FRAM_HAVE_CAIRO

/* Colour at a place of a view of -10 to 10 m in both directions on 20 pixels a metre, 0 to 255. */
static void colour_at(cairo_surface_t *page, int longest, vec2 place, int rgb[3])
{
    const int margin = 14, above = 64, below = 44;
    int least = longest - above - below < longest - 2 * margin ? longest - above - below : longest - 2 * margin;
    double scale = least / 20.0, left = (longest - 20 * scale) / 2;
    int x = (int)(left + (place.x + 10) * scale), y = (int)(above + (10 - place.y) * scale);
    const unsigned char *row = cairo_image_surface_get_data(page) + y * cairo_image_surface_get_stride(page);
    for (int k = 0; k < 3; k++)
        rgb[k] = row[4 * x + 2 - k];
}

static bool is_floe(cairo_surface_t *page, int longest, vec2 place)
{
    int rgb[3];
    colour_at(page, longest, place, rgb);
    return rgb[0] > 235;
}

static cairo_surface_t *drawn(const plan_view *view, int longest)
{
    cairo_surface_t *page = cairo_image_surface_create(CAIRO_FORMAT_RGB24, longest, longest);
    cairo_t *pen = cairo_create(page);
    plan_view_draw(pen, view, longest, longest);
    cairo_destroy(pen);
    cairo_surface_flush(page);
    return page;
}

/* On edge, a piece is seen as wide as it is thick; one under the sheet is not seen, one on it is. */
START_TEST(pieces_on_edge_and_under_the_sheet)
{
    enum { LONGEST = 800 };
    const vec2 ring[3][4] = {{{-10, -10}, {10, -10}, {10, 0}, {-10, 0}},
                             {{-4, 5}, {4, 5}, {4, 5}, {-4, 5}},
                             {{-5, -6}, {5, -6}, {5, -3}, {-5, -3}}};
    for (int on = 0; on < 2; on++) {
        plan_shape s[3] = {{.outline = {ring[0], 4}, .style = PLAN_LEVEL_ICE},
                           {.outline = {ring[1], 4}, .style = PLAN_FLOE},
                           {.outline = {ring[2], 4}, .style = PLAN_FLOE}};
        plan_shape_stand(&s[0], (vec3){0, 0, 0}, (quat){1, 0, 0, 0}, 1);
        plan_shape_stand(&s[1], (vec3){0, 5, 0}, quat_from_roll_pitch_yaw(PI / 2, 0, 0), 1);
        plan_shape_stand(&s[2], (vec3){0, -4.5, on ? 0.5 : -0.5}, (quat){1, 0, 0, 0}, 1);
        plan_shapes_sort(s, 3);
        plan_view view = {.window = {{-10, -10}, {10, 10}}, .title = "", .caption = "", .shapes = s, .shape_count = 3};
        cairo_surface_t *page = drawn(&view, LONGEST);
        ck_assert(is_floe(page, LONGEST, (vec2){0, 5.3}));
        ck_assert(is_floe(page, LONGEST, (vec2){3, 4.7}));
        ck_assert(!is_floe(page, LONGEST, (vec2){0, 5.8}));
        ck_assert(!is_floe(page, LONGEST, (vec2){0, 4.2}));
        ck_assert_int_eq(is_floe(page, LONGEST, (vec2){0, -4.5}), on);
        cairo_surface_destroy(page);
    }
}
END_TEST

/* A floe has a line: at an edge 0.6 of a pixel down the row, its pixels are 0.7 line, which no mix of ice and water is
   as dark as.  Which way round the outline goes does not matter, and a tip is neither lost nor drawn far beyond itself.
 */
START_TEST(floes_have_lines)
{
    enum { LONGEST = 800 };
    const double pixel = 20.0 / (LONGEST - 64 - 44);
    const vec2 ring[2][5] = {{{-6, -6}, {6, -6}, {6, 6}, {5.9, 9}, {-6, 6}},
                             {{-6, 6}, {5.9, 9}, {6, 6}, {6, -6}, {-6, -6}}};
    cairo_surface_t *page[2];
    for (int way = 0; way < 2; way++) {
        const plan_shape s = {.outline = {ring[way], 5}, .style = PLAN_FLOE};
        const plan_view view = {
            .window = {{-10, -10}, {10, 10}}, .title = "", .caption = "", .shapes = &s, .shape_count = 1};
        page[way] = drawn(&view, LONGEST);
        int found[3];
        for (double x = -5.5; x < 5.5; x += 0.07) {
            colour_at(page[way], LONGEST, (vec2){x, -6}, found);
            ck_assert_msg(found[0] < 145, "no line at x = %g: %d", x, found[0]);
            ck_assert(is_floe(page[way], LONGEST, (vec2){x, -6 + 1.5 * pixel}));
        }
        ck_assert(is_floe(page[way], LONGEST, (vec2){5.6, 8.6}));
        colour_at(page[way], LONGEST, (vec2){5.9, 9 + 4 * pixel}, found);
        ck_assert_int_lt(found[0], 60);
    }
    size_t size = (size_t)LONGEST * (size_t)cairo_image_surface_get_stride(page[0]);
    ck_assert_mem_eq(cairo_image_surface_get_data(page[0]), cairo_image_surface_get_data(page[1]), size);
    cairo_surface_destroy(page[0]);
    cairo_surface_destroy(page[1]);
}
END_TEST

/* Tiles of level ice show no seams, nor what lies under them; a floe on them and the water between parts are seen. */
START_TEST(level_ice_has_no_seams)
{
    enum { LONGEST = 793, ACROSS = 3, TILES = ACROSS * ACROSS };
    const vec2 floe[4] = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, apart[3] = {{8, 8}, {9, 8}, {9, 9}};
    vec2 ring[TILES][4];
    plan_shape s[TILES + 2] = {{.outline = {floe, 4}, .style = PLAN_FLOE},
                               {.outline = {apart, 3}, .style = PLAN_LEVEL_ICE}};
    for (int i = 0; i < TILES; i++) {
        double x = -9 + 5.1 * (i % ACROSS), y = -8 + 5.3 * (i - i % ACROSS) / ACROSS;
        const vec2 corner[4] = {{x, y}, {x + 5.1, y}, {x + 5.1, y + 5.3}, {x, y + 5.3}};
        memcpy(ring[i], corner, sizeof corner);
        s[i + 2] = (plan_shape){.outline = {ring[i], 4}, .style = PLAN_LEVEL_ICE};
    }
    const plan_view view = {
        .window = {{-10, -10}, {10, 10}}, .title = "", .caption = "", .shapes = s, .shape_count = TILES + 2};
    for (int on = 0; on < 2; on++) {
        int ice[3], water[3], found[3];
        for (int i = 0; i < TILES + 2; i++)
            s[i].height = s[i].style == PLAN_FLOE ? on : 0;
        plan_shapes_sort(s, TILES + 2);
        ck_assert_int_eq(s[on ? TILES + 1 : 0].style, PLAN_FLOE);
        cairo_surface_t *page = drawn(&view, LONGEST);
        colour_at(page, LONGEST, (vec2){-7, -7}, ice);
        colour_at(page, LONGEST, (vec2){9, 0}, water);
        ck_assert_int_ne(ice[0], water[0]);
        for (double x = -8.9; x < 6.2; x += 0.01) {
            colour_at(page, LONGEST, (vec2){x, 5}, found);
            ck_assert_msg(memcmp(found, ice, sizeof ice) == 0, "%d %d %d at x = %g", found[0], found[1], found[2], x);
        }
        colour_at(page, LONGEST, (vec2){7, 7.8}, found);
        ck_assert_mem_eq(found, water, sizeof water);
        ck_assert_int_eq(is_floe(page, LONGEST, (vec2){0, 0}), on);
        cairo_surface_destroy(page);
    }
}
END_TEST

/* A sheet whose tiles have colours, and a piece between them in their order, in rows so that no seam lies on a line of
   pixels: no water shines through. */
START_TEST(level_ice_of_several_colours_has_no_seams)
{
    enum { LONGEST = 793, TILES = 5 };
    const vec2 piece[3] = {{-9, -9}, {-8, -9}, {-9, -8}};
    vec2 ring[TILES][4];
    plan_shape s[TILES + 1];
    for (int i = 0; i < TILES; i++) {
        double y = -8 + 3.03 * i;
        const vec2 corner[4] = {{-9, y}, {9, y}, {9, y + 3.03}, {-9, y + 3.03}};
        memcpy(ring[i], corner, sizeof corner);
        s[i < 3 ? i : i + 1] = (plan_shape){.outline = {ring[i], 4}, .style = PLAN_LEVEL_ICE, .has_value = i % 2 == 1};
    }
    s[3] = (plan_shape){.outline = {piece, 3}, .style = PLAN_FLOE};
    const plan_view view = {
        .window = {{-10, -10}, {10, 10}}, .title = "", .caption = "", .shapes = s, .shape_count = TILES + 1};
    cairo_surface_t *page = drawn(&view, LONGEST);
    for (double y = -7.9; y < -8 + 3.03 * TILES - 0.1; y += 0.01) {
        int found[3];
        colour_at(page, LONGEST, (vec2){0, y}, found);
        ck_assert_msg(found[0] >= 209, "%d %d %d at y = %g", found[0], found[1], found[2], y);
    }
    cairo_surface_destroy(page);
}
END_TEST

/* A mooring line runs over the ice from its upper end to its anchor, and no further. */
START_TEST(mooring_lines)
{
    enum { LONGEST = 800 };
    const vec2 ring[4] = {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
    plan_shape s = {.outline = {ring, 4}, .style = PLAN_FLOE};
    const plan_line line = {{-5, 1}, {5, 1}};
    for (int32_t count = 0; count < 2; count++) {
        const plan_view view = {.window = {{-10, -10}, {10, 10}},
                                .title = "",
                                .caption = "",
                                .shapes = &s,
                                .shape_count = 1,
                                .lines = &line,
                                .line_count = count};
        cairo_surface_t *page = drawn(&view, LONGEST);
        for (double x = -4.9; x < 4.9; x += 0.1)
            ck_assert_int_eq(is_floe(page, LONGEST, (vec2){x, 1}), !count);
        ck_assert(is_floe(page, LONGEST, (vec2){-6, 1}) && is_floe(page, LONGEST, (vec2){6, 1}));
        cairo_surface_destroy(page);
    }
}
END_TEST

static bool is_white(cairo_surface_t *page, int longest, vec2 place)
{
    int rgb[3];
    colour_at(page, longest, place, rgb);
    return rgb[0] > 240 && rgb[1] > 240 && rgb[2] > 240;
}

/* Arrows, crosses and tracks have white on both sides on water, on a hull and on ice of any colour. */
START_TEST(what_is_drawn_over_ice_has_white_round_it)
{
    enum { LONGEST = 800, GROUNDS = 4 };
    const double beside = 2 * 20.0 / (LONGEST - 64 - 44); /* two pixels */
    const vec2 ring[4] = {{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}, track[2] = {{-8, -4}, {8, -4}};
    const plan_arrow arrow = {{-8, 4}, {8, 4}};
    const vec2 cross = {0, 0};
    for (int ground = 0; ground < GROUNDS; ground++) {
        const plan_shape s = {.outline = {ring, 4},
                              .style = ground == 1 ? PLAN_DECK : PLAN_FLOE,
                              .has_value = ground > 1,
                              .value = ground == 2 ? 0.5F : 1};
        const plan_view view = {.window = {{-10, -10}, {10, 10}},
                                .title = "",
                                .caption = "",
                                .shapes = &s,
                                .shape_count = ground > 0,
                                .arrows = &arrow,
                                .arrow_count = 1,
                                .marks = &cross,
                                .mark_count = 1,
                                .track = track,
                                .track_count = 2};
        cairo_surface_t *page = drawn(&view, LONGEST);
        for (double x = -6; x <= 6; x += 1.5) {
            ck_assert(!is_white(page, LONGEST, (vec2){x, 4}) && !is_white(page, LONGEST, (vec2){x, 4 + 3 * beside}));
            ck_assert(is_white(page, LONGEST, (vec2){x, 4 + beside}) && is_white(page, LONGEST, (vec2){x, 4 - beside}));
        }
        bool seen = false, covers = false;
        for (double y = -4 - beside; y <= -4 + beside; y += beside / 8) {
            seen = seen || is_white(page, LONGEST, (vec2){0, y});
            covers = covers || !is_white(page, LONGEST, (vec2){0, y});
        }
        ck_assert(seen && covers);
        seen = covers = false;
        for (double x = -3 * beside; x <= 3 * beside; x += beside / 8) {
            seen = seen || is_white(page, LONGEST, (vec2){x, beside});
            covers = covers || !is_white(page, LONGEST, (vec2){x, beside});
        }
        ck_assert(seen && covers);
        cairo_surface_destroy(page);
    }
}
END_TEST

/* Pixels of ink and colour over the plan, and the mean of their places. */
static double header_middle(cairo_surface_t *page, int width, int *count)
{
    double sum = 0;
    *count = 0;
    for (int y = 0; y < 64; y++) {
        const unsigned char *row = cairo_image_surface_get_data(page) + y * cairo_image_surface_get_stride(page);
        for (int x = 0; x < width - 80; x++)
            if (row[4 * x] > row[4 * x + 2] + 60) { /* blue, as no letter is */
                sum += x;
                ++*count;
            }
    }
    return *count > 0 ? sum / *count : 0;
}

/* The arrow of a flow is as long whatever the speed, and heavier at its head. */
START_TEST(flows_are_drawn)
{
    enum { LONGEST = 800 };
    double middle[2];
    for (int way = 0; way < 3; way++) {
        const plan_flow flow = {"wind", {way == 0 ? 12 : way == 1 ? -0.1 : 0, 0}};
        const plan_view view = {
            .window = {{-10, -10}, {10, 10}}, .title = "", .caption = "", .flows = &flow, .flow_count = 1};
        cairo_surface_t *page = drawn(&view, LONGEST);
        int count;
        double at = header_middle(page, LONGEST, &count);
        if (way < 2)
            middle[way] = at;
        ck_assert_msg(way == 2 ? count == 0 : count > 40, "%d pixels", count);
        cairo_surface_destroy(page);
    }
    ck_assert_msg(middle[0] > middle[1] + 2, "%g and %g", middle[0], middle[1]);
}
END_TEST

/* A disc in the colour of its value; of two names in one place the first one stands, and no line leads to a disc. */
START_TEST(labels_that_cover_each_other)
{
    enum { LONGEST = 800 };
    double high[3];
    const plan_label labels[3] = {
        {{-5, 5}, 1, "floe 600, 21 %", false}, {{-5, 4.9}, 0, "|", false}, {{5, -5}, 0.5F, "floe 7, 2 %", false}};
    plan_view view = {.window = {{-10, -10}, {10, 10}}, .title = "", .caption = "", .labels = labels};
    image_ramp(1, high);
    int bright[4] = {0}, rgb[3];
    for (view.label_count = 0; view.label_count < 4; view.label_count++) {
        cairo_surface_t *page = drawn(&view, LONGEST);
        colour_at(page, LONGEST, (vec2){-5, 5}, rgb);
        for (int k = 0; k < 3 && view.label_count > 0; k++)
            ck_assert_int_le(abs(rgb[k] - (int)(255 * high[k])), 2);
        for (double x = -10; x < 10; x += 0.05)
            for (double y = -10; y < 10; y += 0.05) {
                colour_at(page, LONGEST, (vec2){x, y}, rgb);
                bright[view.label_count] += rgb[0] > 210;
            }
        colour_at(page, LONGEST, (vec2){0, 0}, rgb);
        ck_assert_int_eq(rgb[0], 40); /* water */
        cairo_surface_destroy(page);
    }
    ck_assert_int_eq(bright[0], 0);
    ck_assert_int_gt(bright[1], 200);
    /* The second disc is half under the first one, and has no ground for its name. */
    ck_assert_int_lt(bright[2] - bright[1], 60);
    ck_assert_int_gt(bright[3] - bright[2], 150);
}
END_TEST

/* How many pixels of a row, from one on to the right, are of ink, or of colours. */
static int run_of(cairo_surface_t *page, int width, int y, int from, bool coloured)
{
    const unsigned char *row = cairo_image_surface_get_data(page) + y * cairo_image_surface_get_stride(page);
    int x = from;
    for (; x < width; x++) {
        bool colour = row[4 * x + 2] > row[4 * x] + 15, dark = row[4 * x + 2] < 40 && row[4 * x] < 40;
        if (!(coloured ? colour : dark))
            break;
    }
    return x - from;
}

/* Under a plan that is narrow, as of a tall field, bar and colours stand side by side all the same; names without discs
   have none. */
START_TEST(texts_beside_a_narrow_plan)
{
    enum { WIDE = 720, HIGH = 900 };
    const vec2 ring[4] = {{-5, -50}, {5, -50}, {5, 50}, {-5, 50}};
    const plan_shape s = {.outline = {ring, 4}, .style = PLAN_FLOE};
    const plan_label name = {.at = {-4, 20}, .text = "|", .bare = true};
    const plan_view view = {.window = {{-5, -50}, {5, 50}},
                            .title = "",
                            .caption = "",
                            .shapes = &s,
                            .shape_count = 1,
                            .labels = &name,
                            .label_count = 1,
                            .no_axes = true,
                            .scale_name = "a quantity that is told",
                            .scale_hi = 1};
    cairo_surface_t *page = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDE, HIGH);
    cairo_t *pen = cairo_create(page);
    cairo_set_source_rgb(pen, 1, 1, 1);
    cairo_paint(pen);
    plan_view_draw(pen, &view, WIDE, HIGH);
    cairo_destroy(pen);
    cairo_surface_flush(page);
    /* 7.92 pixels a metre: a bar of 2 m at the left margin, and the colours between the numbers at the right. */
    const int y = HIGH - 44 + 28 - 6;
    ck_assert_int_ge(run_of(page, WIDE, y, 15, false), 12);
    int longest = 0;
    for (int x = WIDE / 2; x < WIDE; x++)
        longest = run_of(page, WIDE, y, x, true) > longest ? run_of(page, WIDE, y, x, true) : longest;
    ck_assert_int_gt(longest, 120);
    /* The disc would be in the colour of 0, white with an edge of ink. */
    const unsigned char *row =
        cairo_image_surface_get_data(page) + (64 + (int)(30 * 7.92)) * cairo_image_surface_get_stride(page);
    const int at = WIDE / 2 - (int)(4 * 7.92);
    for (int x = at - 8; x < at + 8; x++)
        ck_assert_int_gt(row[4 * x], 200);
    /* No axes. */
    for (int x = WIDE - 64; x < WIDE - 30; x++)
        ck_assert_int_eq(run_of(page, WIDE, 44, x, false), 0);
    cairo_surface_destroy(page);
}
END_TEST

/* Pictures of a ship that leaves the field are as large as those before, rounding included. */
START_TEST(pictures_of_one_size)
{
    enum { LONGEST = 800, WIDE = LONGEST + 28, HIGH = LONGEST * 2 / 5 + 108 };
    context ctx;
    context_init(&ctx);
    for (int k = 0; k < 5; k++) {
        double x = k == 0 ? 50 : 110 + 1.7 * k, y = 20 + 0.9 * k;
        const vec2 ring[4] = {{x - 10, y - 2}, {x + 10, y - 2}, {x + 10, y + 2}, {x - 10, y + 2}};
        const plan_shape s = {.outline = {ring, 4}, .style = PLAN_DECK};
        const plan_view view = {.window = plan_window((box2){{0, 0}, {100, 40}}, &s, 1),
                                .title = "",
                                .caption = "",
                                .shapes = &s,
                                .shape_count = 1};
        text_buffer png = {0};
        fram_error error;
        assert_ok(plan_view_png(&ctx, &view, LONGEST, &png, &error), error);
        const unsigned char *size = (const unsigned char *)png.data + 16; /* behind the words PNG and IHDR */
        ck_assert_int_eq(256 * size[2] + size[3], WIDE);
        ck_assert_int_eq(256 * size[6] + size[7], HIGH);
        text_free(&ctx, &png);
    }
}
END_TEST

typedef struct png_bytes {
    const text_buffer *png;
    int32_t read;
} png_bytes;

static cairo_status_t take_bytes(void *user, unsigned char *data, unsigned int length)
{
    png_bytes *b = user;
    if (length > (unsigned int)(b->png->count - b->read))
        return CAIRO_STATUS_READ_ERROR;
    memcpy(data, b->png->data + b->read, length);
    b->read += (int32_t)length;
    return CAIRO_STATUS_SUCCESS;
}

/* Pixels of a page below its title that are of water or ice, first to last of them, along x or y. */
static int extent_of(cairo_surface_t *page, bool upright)
{
    const int wide = cairo_image_surface_get_width(page), high = cairo_image_surface_get_height(page);
    int first = INT32_MAX, last = -1;
    for (int y = 60; y < high - 40; y++) {
        const unsigned char *row = cairo_image_surface_get_data(page) + y * cairo_image_surface_get_stride(page);
        for (int x = 0; x < wide; x++)
            if (row[4 * x] > row[4 * x + 2] + 10) { /* blue */
                first = (upright ? y : x) < first ? (upright ? y : x) : first;
                last = (upright ? y : x) > last ? (upright ? y : x) : last;
            }
    }
    return last - first + 1;
}

/* Long and narrow fields fill the longer side of their pictures, though they are of a few pixels across, or of less
   than one. */
START_TEST(strips)
{
    enum { LONGEST = 1600 };
    const double across[] = {80, 24, 12, 8, 1, 1e-5};
    context ctx;
    context_init(&ctx);
    for (int i = 0; i < 12; i++) {
        bool upright = i % 2;
        double w = upright ? across[i / 2] : 20000, h = upright ? 20000 : across[i / 2];
        const vec2 ring[4] = {{0, 0}, {w, 0}, {w, h}, {0, h}};
        const plan_shape s = {.outline = {ring, 4}, .style = PLAN_LEVEL_ICE};
        text_buffer png = {0};
        png_bytes bytes = {&png, 0};
        fram_error error;
        for (int32_t count = 0; count < 2; count++) {
            const plan_view view = {
                .window = {{0, 0}, {w, h}}, .title = "", .caption = "", .shapes = &s, .shape_count = count};
            assert_ok(plan_view_png(&ctx, &view, LONGEST, &png, &error), error);
            cairo_surface_t *page = cairo_image_surface_create_from_png_stream(take_bytes, &bytes);
            ck_assert_int_eq(cairo_surface_status(page), CAIRO_STATUS_SUCCESS);
            int found = extent_of(page, upright);
            ck_assert_msg(found >= LONGEST - 1 && found <= LONGEST + 1, "%g by %g m: %d pixels", w, h, found);
            cairo_surface_destroy(page);
        }
        text_free(&ctx, &png);
    }
}
END_TEST

TEST_MAIN("plan_view", level_prism, tilted_prism, sorted, a_hull_outside, a_hull_across_a_corner, styles_in_the_window,
          lines_in_the_window, flows_that_move, flows_of_a_history, flows_of_a_profile,
          pieces_on_edge_and_under_the_sheet, floes_have_lines, level_ice_has_no_seams,
          level_ice_of_several_colours_has_no_seams, mooring_lines, what_is_drawn_over_ice_has_white_round_it,
          flows_are_drawn, labels_that_cover_each_other, texts_beside_a_narrow_plan, pictures_of_one_size, strips)

#else

TEST_MAIN("plan_view", level_prism, tilted_prism, sorted, a_hull_outside, a_hull_across_a_corner, styles_in_the_window,
          lines_in_the_window, flows_that_move, flows_of_a_history, flows_of_a_profile)

#endif
