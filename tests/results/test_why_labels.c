/* Floes that a frame does not show are named in the picture of a peak, by their part of the load. */
#include "results/why_labels.h"

#include "results/peaks.h"
#include "testing.h"
#include <string.h>

static peak_floe floe(int32_t number, double part, double x)
{
    peak_floe f = {.number = number, .slot = 1, .force = {-part, 0, 0}, .point = {x, 2, 0}};
    f.part[MECHANISM_BENDING] = 0.75 * part;
    f.part[MECHANISM_FRICTION] = 0.25 * part;
    return f;
}

START_TEST(floes_without_an_outline)
{
    context ctx;
    context_init(&ctx);
    replay r = {.ctx = &ctx};
    replay_moment m = {0};
    static peak_detail d;
    /* The record knows floes 5 and 7; 5 is gone at the moment, 7 is there, 600 and 601 are in no frame. */
    ck_assert(array_push(&ctx, &r.bodies, (replay_body){.number = 5}) &&
              array_push(&ctx, &r.bodies, (replay_body){.number = 7}) &&
              array_push(&ctx, &m.poses, (replay_pose){.body = 1}));
    d.load = 1000;
    d.floe[0] = floe(7, 400, 10);
    d.floe[1] = floe(600, 300, 20);
    d.floe[2] = floe(5, 150, 30);
    d.floe[3] = floe(-1, 100, 40); /* a wall */
    d.floe[4] = floe(601, 9, 50);  /* too little to be told */
    d.floe_count = 5;
    plan_label labels[PEAK_FLOES];
    ck_assert_int_eq(why_labels(&r, &m, &d, 40, 0.1, labels), 2);
    ck_assert_str_eq(labels[0].text, "floe 600, 30 %");
    ck_assert_str_eq(labels[1].text, "floe 5, 15 %");
    assert_absolute((double)labels[0].value, 0.75, 1e-6);
    assert_absolute(labels[0].at.x, 20 + 0.1 * 300, 1e-9);
    assert_absolute(labels[0].at.y, 2, 1e-9);
    array_free(&ctx, &r.bodies);
    array_free(&ctx, &m.poses);
}
END_TEST

/* A moment that nothing bears on has no mechanism, not the first of their list, and no arrows; crosses are told of
   where the window has one. */
START_TEST(the_caption_tells_what_bears)
{
    static peak_detail d;
    char caption[WHY_CAPTION];
    vec2 place[2] = {{11, 3}, {9, 3}};
    const box2 window = {{-10, -10}, {10, 10}};
    replay_plan plan = {.marks = {.data = place, .count = 0}};
    why_caption(&d, &plan, window, 5, 0, caption);
    ck_assert_str_eq(caption, "no ice touches the vessel");
    plan.marks.count = 1;
    why_caption(&d, &plan, window, 5, 0, caption);
    ck_assert_str_eq(caption, "no ice touches the vessel");
    plan.marks.count = 2;
    why_caption(&d, &plan, window, 5, 0, caption);
    ck_assert_str_eq(caption, "no ice touches the vessel; crosses: breaks of the last 5 s");
    d.floe_count = 1;
    d.mechanism[MECHANISM_BENDING] = 10;
    why_caption(&d, &plan, window, 0.25, 1, caption);
    ck_assert_msg(strncmp(caption, "bending of ice", 14) == 0 && strstr(caption, "; arrows: "), "%s", caption);
    for (int i = 0; i < MECHANISM_COUNT; i++) { /* none is too long */
        memset(d.mechanism, 0, sizeof d.mechanism);
        d.mechanism[i] = 10;
        why_caption(&d, &plan, window, 0.0125, 1, caption);
        ck_assert_ptr_eq(strstr(caption, mechanism_text((ice_mechanism)i)), caption);
        ck_assert_ptr_nonnull(strstr(caption, "of the last 0.0125 s; discs: floes that no frame shows"));
    }
}
END_TEST

/* Of a vessel far from the global origin that no ice touches; else around what touches it. */
START_TEST(the_window_is_where_the_vessel_is)
{
    context ctx;
    context_init(&ctx);
    replay r = {.ctx = &ctx};
    replay_moment m = {0};
    static peak_detail d;
    ck_assert(array_push(&ctx, &r.bodies, (replay_body){.material = MATERIAL_HULL, .number = -1, .vessel = 0}) &&
              array_push(&ctx, &r.bodies, (replay_body){.material = MATERIAL_HULL, .number = -1, .vessel = 1}) &&
              array_push(&ctx, &m.poses, (replay_pose){.body = 0, .position = {5, 6, 0}}) &&
              array_push(&ctx, &m.poses, (replay_pose){.body = 1, .position = {300, -40, 1}}));
    box2 window = why_window(&r, &m, &d, 1, 45);
    assert_absolute(window.lo.x, 255, 1e-9);
    assert_absolute(window.hi.x, 345, 1e-9);
    assert_absolute(window.lo.y, -85, 1e-9);
    assert_absolute(window.hi.y, 5, 1e-9);
    d.floe[0] = floe(7, 400, 320);
    d.floe_count = 1;
    window = why_window(&r, &m, &d, 1, 45);
    assert_absolute(window.lo.x, 275, 1e-9);
    assert_absolute(window.lo.y, -43, 1e-9);
    array_free(&ctx, &r.bodies);
    array_free(&ctx, &m.poses);
}
END_TEST

TEST_MAIN("why_labels", the_window_is_where_the_vessel_is, floes_without_an_outline, the_caption_tells_what_bears)
