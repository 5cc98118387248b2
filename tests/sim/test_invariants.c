/* model/world_invariants: they hold in runs of every kind, and each is found when it does not. */
#include "model/world_invariants.h"
#include "scene.h"

static const char moored[] =
    "run: {duration: 5, time_step: 0.05}\nvessel:\n  mode: free\n"
    "  hull: {length: 30, beam: 10, draught: 3, freeboard: 2, parallel_midbody: 0.3}\n"
    "  hydrodynamics: {source: estimate}\n"
    "  mooring:\n    lines:\n      - {count: 4, spacing_deg: 90, direction_deg: 45, distance: 200, pretension: 2e5}\n"
    "domain: {boundary: walls, x_min: -40, x_max: 40, y_min: -30, y_max: 30}\n"
    "ice:\n  source: floes\n  thickness: 0.6\n  floes:\n"
    "    - {x: 22, y: 1, length: 12, width: 20, velocity_x: -1.5}\n"
    "    - {x: -2, y: 12, length: 12, width: 12, velocity_y: -0.6}\n"
    "    - {x: 30, y: 1, length: 3, width: 20, velocity_x: -2}\n";

/* A world in which ice presses on the hull. */
static void open_pressed(scene *k)
{
    fram_error error = {0};
    char text[INVARIANT_TEXT];
    scene_open(k, moored);
    int32_t pressed = 0;
    for (int i = 0; i < 60 && pressed < 4; i++) {
        assert_ok(world_step(&k->ctx, &k->m, &k->w, &error), error);
        ck_assert_msg(!world_invariant_broken(&k->m, &k->w, text), "%s", text);
        ck_assert_msg(!contact_invariant_broken(&k->w, text), "%s", text);
        pressed = 0;
        for (int32_t c = 0; c < k->w.scratch.contacts.count; c++)
            pressed += k->w.scratch.contacts.data[c].impulse[0] > 0;
    }
    ck_assert_int_ge(pressed, 4);
}

/* One number of the world changed, found, and put back. */
#define FOUND(k, call, member, value, word)                                          \
    do {                                                                             \
        char text_[INVARIANT_TEXT];                                                  \
        double kept_ = (double)(member);                                             \
        (member) = (value);                                                          \
        ck_assert_msg(call, "%s", #member " = " #value " is not found");             \
        ck_assert_msg(strstr(text_, word) != NULL, "%s instead of %s", text_, word); \
        (member) = (__typeof__(member))kept_;                                        \
        ck_assert(!world_invariant_broken(&(k).m, &(k).w, text_));                   \
        ck_assert(!contact_invariant_broken(&(k).w, text_));                         \
    } while (0)
#define STATE world_invariant_broken(&k.m, &k.w, text_)
#define CONTACTS contact_invariant_broken(&k.w, text_)

START_TEST(what_does_not_hold_of_the_state_is_found)
{
    scene k;
    open_pressed(&k);
    world *w = &k.w;
    int32_t floe = scene_floe(&k, 0), wall = -1;
    for (int32_t i = 0; i < w->bodies.count; i++)
        wall = w->bodies.material[i] == MATERIAL_WALL ? i : wall;
    FOUND(k, STATE, w->bodies.orientation[floe].w, 1.001, "quaternion");
    FOUND(k, STATE, w->bodies.mass[floe], 0, "mass");
    FOUND(k, STATE, w->bodies.mass[floe], (double)NAN, "mass");
    FOUND(k, STATE, w->bodies.inertia[floe].yy, -1, "inertia");
    FOUND(k, STATE, w->bodies.shape[floe], w->shapes.shapes.count, "shape");
    FOUND(k, STATE, w->bodies.velocity[wall].x, 1e-3, "static");
    FOUND(k, STATE, w->bodies.owner[floe], 1, "not its own");
    FOUND(k, STATE, w->floes.body[1], w->floes.body[0], "not its own");
    FOUND(k, STATE, w->floes.area[1], 0, "area");
    FOUND(k, STATE, w->vessels.body[0], floe, "vessel[0]");
    FOUND(k, STATE, k.m.vessels.count, 2, "another number");
    ck_assert_int_gt(w->pairs.count, 1);
    FOUND(k, STATE, w->pairs.a[0], w->pairs.b[0], "pair[0]");
    FOUND(k, STATE, w->pairs.a[1], -1, "pair[1]");
    ck_assert_int_gt(w->memory.count, 1);
    uint64_t key = w->memory.key[1];
    char text[INVARIANT_TEXT];
    w->memory.key[1] = w->memory.key[0];
    ck_assert(world_invariant_broken(&k.m, w, text));
    w->memory.key[1] = key;
    scene_close(&k);
}
END_TEST

START_TEST(what_does_not_hold_of_contacts_is_found)
{
    scene k;
    open_pressed(&k);
    contact *c = k.w.scratch.contacts.data;
    while (!(c->impulse[0] > 0))
        c++;
    FOUND(k, CONTACTS, c->a, c->b, "living");
    FOUND(k, CONTACTS, c->b, k.w.bodies.count, "living");
    FOUND(k, CONTACTS, c->normal.x, 2, "normal");
    FOUND(k, CONTACTS, c->impulse[0], -1e-300, "limit");
    FOUND(k, CONTACTS, c->impulse_limit, c->impulse[0] * (1 - 1e-9), "limit");
    FOUND(k, CONTACTS, c->impulse[1], 1.001 * fmax(c->friction_static, c->friction_kinetic) * c->impulse[0], "cone");
    FOUND(k, CONTACTS, c->impulse[2], (double)NAN, "cone");
    scene_close(&k);
}
END_TEST

TEST_MAIN("invariants", what_does_not_hold_of_the_state_is_found, what_does_not_hold_of_contacts_is_found)
