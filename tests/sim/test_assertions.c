/* A state that cannot be stops the step of a build with assertions, before the next step builds on it. */
#include "scene.h"

static const char floes[] = "run: {duration: 5, time_step: 0.05}\nvessel: {present: false}\n"
                            "domain: {boundary: walls, x_min: -40, x_max: 40, y_min: -30, y_max: 30}\n"
                            "ice:\n  source: floes\n  thickness: 0.6\n  floes:\n"
                            "    - {x: 10, length: 10, width: 20, velocity_x: -1.5}\n"
                            "    - {x: -5, length: 12, width: 12, velocity_x: 1}\n";

static void step(void *user) { scene_steps(user, 1); }

#define STOPS(k, member, value)              \
    do {                                     \
        __typeof__(member) kept_ = (member); \
        (member) = (value);                  \
        assert_aborts(step, &(k));           \
        (member) = kept_;                    \
    } while (0)

START_TEST(a_state_that_cannot_be_stops_its_step)
{
    scene k;
    scene_open(&k, floes);
    scene_steps(&k, 20);
    world *w = &k.w;
    int32_t floe = scene_floe(&k, 0), wall = -1;
    for (int32_t i = 0; i < w->bodies.count; i++)
        wall = w->bodies.material[i] == MATERIAL_WALL ? i : wall;
    ck_assert(!testing_aborts(step, &k));
    STOPS(k, w->bodies.orientation[floe].w, 1.01);
    STOPS(k, w->bodies.velocity[wall].x, 1e-3);
    STOPS(k, w->bodies.inertia[floe].xx, -1);
    STOPS(k, w->floes.area[1], 0);
    STOPS(k, w->floes.thickness[1], (double)NAN);
    STOPS(k, w->bodies.owner[floe], 1);
    ck_assert(!testing_aborts(step, &k));
    scene_close(&k);
}
END_TEST

TEST_MAIN_OF_ASSERTIONS("assertions", a_state_that_cannot_be_stops_its_step)
