/* Which floes of a step are others that lost crushed ice: those alone that came of one that is gone and did not break.
 */
#include "sim/floe_trims.h"
#include "sim/scene.h"

static const char text[] = "run: {duration: 1, time_step: 0.02}\n"
                           "vessel: {mode: towed, x: -26, hull: {length: 20, beam: 6, draught: 2, freeboard: 2}}\n"
                           "ice: {source: floes, thickness: 0.5, floes: [{length: 2, width: 2, x: 0},\n"
                           "  {length: 2, width: 2, x: 5}, {length: 2, width: 2, x: 10},\n"
                           "  {length: 2, width: 2, x: 15}, {length: 2, width: 2, x: 20},\n"
                           "  {length: 2, width: 2, x: 25}, {length: 2, width: 2, x: 30}]}\n"
                           "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}\n";

/* Numbers that no floe has any more. */
enum { TRIMMED = 1000, CUT_IN_TWO, BROKEN, OTHER };
enum { SLOT = 77 };

static void comes_of(world *w, int32_t floe, int32_t parent)
{
    w->floes.parent[floe] = parent;
    w->scratch.contact_generations.data[w->floes.body[floe]]++;
}

START_TEST(those_of_one_that_is_gone)
{
    scene k;
    scene_open(&k, text);
    scene_steps(&k, 1);
    world *w = &k.w;
    floe_trim_array trims = {0};
    ck_assert_int_eq(w->floes.count, 7);
    /* The first floe is there yet, and the last one is a piece of a break. */
    comes_of(w, 1, TRIMMED);
    comes_of(w, 2, CUT_IN_TWO);
    comes_of(w, 3, CUT_IN_TWO);
    comes_of(w, 4, BROKEN);
    comes_of(w, 5, w->floes.number[0]);
    comes_of(w, 6, OTHER);
    const fracture_event events[] = {{.floe = BROKEN, .first_piece = OTHER + 1, .pieces = 2},
                                     {.floe = OTHER + 5, .first_piece = w->floes.number[6], .pieces = 1}};
    w->scratch.fractures.count = w->scratch.shares.count = w->scratch.patches.count = 0;
    for (int i = 0; i < 2; i++)
        ck_assert(array_push(&k.ctx, &w->scratch.fractures, events[i]));
    ck_assert(floe_trims_note(&k.ctx, w, &trims));
    ck_assert_int_eq(trims.count, 0); /* no patch: nothing was crushed */
    ck_assert(array_push(&k.ctx, &w->scratch.patches, (crushing_patch){0}));
    for (int touched = 0; touched < 2; touched++) {
        trims.count = 0;
        ck_assert(floe_trims_note(&k.ctx, w, &trims));
        ck_assert_int_eq(trims.count, 1);
        const floe_trim *t = &trims.data[0];
        ck_assert(t->step == w->clock.step[0] && t->from == TRIMMED && t->to == w->floes.number[1]);
        ck_assert_int_eq(t->slot, w->floes.body[1]);
        ck_assert_int_eq(t->had, touched ? SLOT : -1);
        ck_assert(array_push(&k.ctx, &w->scratch.shares, ((ice_share){.floe = TRIMMED, .body = SLOT})));
    }
    const floe_trim *t = &trims.data[0];
    ck_assert_ptr_eq(floe_trims_find(&trims, t->step, t->to), t);
    ck_assert_ptr_eq(floe_trims_find_slot(&trims, t->step, SLOT), t);
    ck_assert_ptr_null(floe_trims_find(&trims, t->step + 1, t->to));
    ck_assert_ptr_null(floe_trims_find(&trims, t->step, t->from));
    ck_assert_ptr_null(floe_trims_find_slot(&trims, t->step, t->slot));
    array_free(&k.ctx, &trims);
    scene_close(&k);
}
END_TEST

TEST_MAIN("floe_trims", those_of_one_that_is_gone)
