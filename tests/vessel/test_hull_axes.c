/* Axes of hulls, by a ship, a box and a catamaran that are turned and moved. */
#include "vessel/hull_axes.h"

#include "testing.h"
#include "vessel/hull.h"

typedef struct turned_hull {
    context ctx;
    mesh m;
    polyhedron_array pieces;
} turned_hull;

static turned_hull hull_of(hull_form form)
{
    turned_hull h = {0};
    const double usual = (double)NAN;
    hull_particulars p = {form, 60, 16, 5, 3, usual, usual, usual, usual, usual, 0, usual, usual, 0};
    fram_error error = {0};
    context_init(&h.ctx);
    hull_particulars_fill(&p);
    assert_ok(hull_make(&h.ctx, &p, &h.m, &h.pieces, &error), error);
    return h;
}

static void free_turned(turned_hull *h)
{
    mesh_free(&h->ctx, &h->m);
    polyhedron_array_free(&h->ctx, &h->pieces);
}

/* x forward, z up; y forward; y up, z to starboard. */
static vec3 ships(vec3 p) { return p; }
static vec3 y_forward(vec3 p) { return (vec3){-p.y, p.x, p.z}; }
static vec3 y_up(vec3 p) { return (vec3){p.x, p.z, -p.y}; }

static hull_axes axes_when(hull_form form, vec3 (*turn)(vec3), vec3 by, vec3 origin)
{
    turned_hull h = hull_of(form);
    for (int32_t i = 0; i < h.m.vertex.count; i++)
        h.m.vertex.data[i] = vec3_add(turn(h.m.vertex.data[i]), by);
    bool across = turn == y_forward;
    hull_axes found = hull_axes_of(&h.m, origin, across ? 16 : 60, across ? 60 : 16);
    free_turned(&h);
    return found;
}

START_TEST(axes_are_told_of_what_is_turned)
{
    static const hull_form forms[3] = {HULL_BOX, HULL_ICEBREAKER, HULL_SHIP};
    const vec3 none = {0, 0, 0}, some = {12, -3, 7};
    for (int i = 0; i < 3; i++) {
        ck_assert_int_eq(axes_when(forms[i], ships, none, none), HULL_AXES_OF_SHIPS);
        ck_assert_int_eq(axes_when(forms[i], y_forward, none, none), HULL_Y_FORWARD);
        ck_assert_int_eq(axes_when(forms[i], y_up, none, none), HULL_Y_UP);
        ck_assert_int_eq(axes_when(forms[i], y_up, some, some), HULL_Y_UP);
        /* Beside its centre line, and off its waterline: it is to be moved. */
        ck_assert_int_eq(axes_when(forms[i], ships, vec3_make(0, 8, 0), none), HULL_AXES_OF_SHIPS);
        ck_assert_int_eq(axes_when(forms[i], ships, vec3_make(0, 0, 2), none), HULL_AXES_OF_SHIPS);
        ck_assert_int_eq(axes_when(forms[i], ships, vec3_make(0, 8, 1), none), HULL_AXES_OF_SHIPS);
    }
}
END_TEST

/* A round hull of ten facets is 5 % wider than long, or longer than wide. */
START_TEST(round_hulls_have_no_bow)
{
    turned_hull h = hull_of(HULL_BOX);
    const vec3 none = {0, 0, 0};
    ck_assert_int_eq(hull_axes_of(&h.m, none, 19.02, 20), HULL_AXES_OF_SHIPS);
    ck_assert_int_eq(hull_axes_of(&h.m, none, 20, 19.02), HULL_AXES_OF_SHIPS);
    ck_assert_int_eq(hull_axes_of(&h.m, none, 15, 20), HULL_Y_FORWARD);
    free_turned(&h);
}
END_TEST

TEST_MAIN("hull axes", round_hulls_have_no_bow, axes_are_told_of_what_is_turned)
