/* What the watch of peaks knows goes into a checkpoint and comes back: the same peaks, and no bytes that harm.  Beside
   a world that has come some way it tells no peak by a part of it, and parts of one in a long window add up too. */
#include "scratch.h"
#include "sim/peak_chain.h"
#include "sim/peak_state.h"
#include "sim/recording.h"
#include "sim/scene.h"

#define SCENE(others)                                                                \
    "run: {duration: 4, time_step: 0.02, transient: 0}\n"                            \
    "vessel: {mode: towed, x: -26, speed: 3, ramp: 0.1,\n"                           \
    "  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}\n"                    \
    "ice: {source: floes, thickness: 0.5, breakable: true,\n"                        \
    "  floes: [" others "{length: 40, width: 40, x: 20.5, y: 20.5, fixed: true}]}\n" \
    "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44}\n"
static const char text[] = SCENE(""), beside[] = SCENE("{x: -50, y: -30, length: 2, width: 2}, "
                                                       "{x: -50, y: 30, length: 2, width: 2}, ");

static fram_error e;

static void run(scene *k, peak_watch *p, int steps)
{
    for (int i = 0; i < steps; i++) {
        scene_steps(k, 1);
        assert_ok(peak_watch_step(p, &k->w, &e), e);
    }
}

static void same(const byte_array *a, const byte_array *b)
{
    ck_assert_int_eq(a->count, b->count);
    ck_assert_mem_eq(a->data, b->data, (size_t)a->count);
}

static double sum_of(const peak_detail *d)
{
    double sum = 0;
    for (int i = 0; i < MECHANISM_COUNT; i++)
        sum += d->mechanism[i];
    return sum;
}

/* Another watch takes up what one was saved as, and is saved as the same. */
static void restore_as_saved(scene *k, peak_watch *p, peak_watch *q)
{
    byte_array a = {0}, b = {0};
    ck_assert(peak_state_save(p, &k->w, &a));
    assert_ok(peak_state_restore(q, &k->w, &a, &e), e);
    ck_assert(peak_state_save(q, &k->w, &b));
    ck_assert_int_eq(p->vessels.data[0].picker.recent_count, q->vessels.data[0].picker.recent_count);
    same(&a, &b);
    array_free(&k->ctx, &a);
    array_free(&k->ctx, &b);
}

START_TEST(what_is_restored_goes_on_as_what_was_saved)
{
    scene k;
    peak_watch p, q;
    scene_open(&k, text);
    peak_watch_init(&k.ctx, 0.02, 0, &p);
    peak_watch_init(&k.ctx, 0.02, 0, &q);
    run(&k, &p, 90);
    restore_as_saved(&k, &p, &q);
    int32_t contacts = 0;
    for (int32_t i = 0; i < q.ring.count; i++)
        contacts += q.ring.data[i].count;
    ck_assert_int_gt(contacts, 10);
    /* Less than a window on, so that what was restored still counts. */
    for (int i = 0; i < 12; i++) {
        scene_steps(&k, 1);
        assert_ok(peak_watch_step(&p, &k.w, &e), e);
        assert_ok(peak_watch_step(&q, &k.w, &e), e);
    }
    peak_detail one, other;
    assert_ok(peak_watch_explain(&p, &k.w, 0, &one, &e), e);
    assert_ok(peak_watch_explain(&q, &k.w, 0, &other, &e), e);
    ck_assert_double_gt(one.load, 0);
    for (int i = 0; i < MECHANISM_COUNT; i++)
        ck_assert(one.mechanism[i] == other.mechanism[i]);
    assert_relative(sum_of(&one), one.load, 1e-9);
    byte_array a = {0}, b = {0};
    ck_assert(peak_state_save(&p, &k.w, &a) && peak_state_save(&q, &k.w, &b));
    same(&a, &b);
    array_free(&k.ctx, &a);
    array_free(&k.ctx, &b);
    peak_watch_free(&p);
    peak_watch_free(&q);
    scene_close(&k);
}
END_TEST

/* A step without physics: the fixed floe pushes the hull by one mechanism or another, now and then much harder. */
static void make_step(world *w, int32_t floe)
{
    int64_t step = w->clock.step[0];
    ice_share s = {.body = floe, .floe = w->floes.number[w->bodies.owner[floe]], .patch = -1};
    s.mechanism = step / 5 % 3 == 0 ? MECHANISM_CRUSHING : MECHANISM_BENDING;
    s.normal = vec3_make(step % 701 < 4 ? -1e6 : -1e3 * (double)(1 + step % 7), 0, 0);
    s.friction = vec3_make(-100, 0, 300);
    s.point = vec3_make((double)(step % 4), 0, 0);
    ck_assert(w->scratch.shares.count >= 2);
    w->scratch.shares.count = 2;
    w->scratch.shares.data[0] = w->scratch.shares.data[1] = s;
    w->load_window.force[load_window_row(w, step, 0)] = vec3_scale(vec3_add(s.normal, s.friction), 2);
    w->clock.step[0] = step + 1;
}

/* What mechanisms come to in the window, by the steps themselves, of which the world knows the loads. */
static double crushed(const world *w)
{
    double sum = 0;
    int64_t now = w->clock.step[0], steps = load_window_length(w), first = now > steps ? now - steps : 0;
    for (int64_t i = first; i < now; i++)
        sum += i / 5 % 3 == 0 ? -w->load_window.force[load_window_row(w, i, 0)].x - 200 : 0;
    return sum / (double)steps;
}

static void check_parts(peak_watch *p, world *w)
{
    peak_detail d;
    assert_ok(peak_watch_explain(p, w, 0, &d, &e), e);
    double filled = fmin(1, (double)w->clock.step[0] / (double)load_window_length(w));
    ck_assert_double_gt(d.load, 2200 * filled);
    assert_relative(sum_of(&d), d.load, 1e-9);
    assert_relative(d.mechanism[MECHANISM_CRUSHING], crushed(w), 0.01);
    ck_assert_int_eq(d.bodies, 1);
    assert_relative(-d.floe[0].force.x, d.load, 1e-9);
    assert_absolute(d.floe[0].point.x, 1.5, 1);
}

/* Of 1001 steps two each make a row, of 2300 three; the window ends within one, and its state comes back there too. */
START_TEST(parts_of_a_long_window_add_up)
{
    static const char *const window[] = {"output.averaging_window=20.02", "output.averaging_window=46"};
    for (int i = 0; i < 2; i++) {
        scene k;
        peak_watch p, q;
        scene_open_with(&k, text, &window[i], 1);
        scene_steps(&k, 60);
        int32_t floe = scene_floe(&k, 0);
        k.w.clock.step[0] = 0;
        peak_watch_init(&k.ctx, 0.02, 0, &p);
        peak_watch_init(&k.ctx, 0.02, 0, &q);
        for (int step = 0; step < 6000; step++) {
            make_step(&k.w, floe);
            assert_ok(peak_watch_keep(&p, &k.w, &e), e);
            if (step % 101 == 100)
                check_parts(&p, &k.w);
        }
        ck_assert_int_le(p.ring.count, 1000);
        restore_as_saved(&k, &p, &q);
        make_step(&k.w, floe);
        assert_ok(peak_watch_keep(&q, &k.w, &e), e);
        check_parts(&q, &k.w);
        peak_watch_free(&p);
        peak_watch_free(&q);
        scene_close(&k);
    }
}
END_TEST

static int32_t last_number(const world *w)
{
    int32_t last = -1;
    for (int32_t i = 0; i < w->floes.count; i++)
        last = w->floes.body[i] >= 0 && w->floes.number[i] > last ? w->floes.number[i] : last;
    return last;
}

/* As if the hull pushed a small floe, and that one the fixed floe, which lost crushed ice in this step and is the end.
 */
static void check_chain_to_trimmed(scene *k, const peak_watch *p)
{
    const floe_trim *t = &p->trims.data[p->trims.count - 1];
    int32_t hull = k->w.vessels.body[0], small = k->w.floes.body[1];
    contact_array *all = &k->w.scratch.contacts;
    contact pushes = {.a = hull, .b = small, .normal = vec3_make(-1, 0, 0), .impulse = {1e6, 0, 0}};
    contact hands_on = pushes;
    hands_on.a = small;
    hands_on.b = t->had;
    ck_assert(array_push(&k->ctx, all, pushes) && array_push(&k->ctx, all, hands_on));
    ck_assert(contact_web_make(&k->ctx, &k->w));
    force_chain chain;
    peak_detail d = {.vessel = 0};
    peak_floe f = {.slot = small, .number = k->w.floes.number[1]};
    peak_chain_add(&k->w, 0.02, &p->trims, &chain, &f, &d);
    all->count -= 2;
    ck_assert_int_eq(f.links, 2);
    ck_assert_int_eq(f.end, CHAIN_SHEET);
    ck_assert_int_eq(d.link[1].slot, t->slot);
    assert_relative(d.link[1].push.x, 1e6 / 0.02, 1e-9);
    ck_assert(d.link[1].others == 0 && d.link[1].water == 0 && d.link[1].inertia == 0);
}

/* The hull crushes its way into a fixed floe, which has a new number each few steps and is one body, also beside a
   watch that takes the state up in a window of such steps, and whether or not the step of the peak is one. */
START_TEST(a_floe_that_is_crushed_is_one_body)
{
    static const char *const whole[] = {"ice.breakable=false", "ice.smallest_floe_area=0.05"};
    scene k;
    peak_watch p, q;
    scene_open_with(&k, beside, whole, 2);
    peak_watch_init(&k.ctx, 0.02, 0, &p);
    peak_watch_init(&k.ctx, 0.02, 0, &q);
    run(&k, &p, 90);
    restore_as_saved(&k, &p, &q);
    /* The slot of another floe is free: the next number of this one is in that. */
    floe_remove(&k.w.bodies, &k.w.shapes, &k.w.floes, 0);
    int trimmed = 0;
    for (int i = 0; i < 10; i++) {
        peak_detail one, other;
        int32_t before = last_number(&k.w);
        scene_steps(&k, 1);
        assert_ok(peak_watch_keep(&p, &k.w, &e), e);
        assert_ok(peak_watch_keep(&q, &k.w, &e), e);
        assert_ok(peak_watch_explain(&p, &k.w, 0, &one, &e), e);
        assert_ok(peak_watch_explain(&q, &k.w, 0, &other, &e), e);
        int32_t number = last_number(&k.w);
        trimmed += number != before;
        if (number != before)
            check_chain_to_trimmed(&k, &p);
        ck_assert_int_eq(one.bodies, 1);
        ck_assert_int_eq(one.floe[0].number, number);
        assert_relative(hypot(one.floe[0].force.x, one.floe[0].force.y), one.load, 1e-9);
        assert_relative(one.zone[ZONE_BOW][MECHANISM_CRUSHING], one.floe[0].part[MECHANISM_CRUSHING], 1e-9);
        ck_assert_int_eq(one.floe[0].links, 1);
        ck_assert_int_eq(one.floe[0].end, CHAIN_SHEET);
        ck_assert_int_eq(one.link[0].number, number);
        ck_assert_double_gt(one.link[0].push.x, 0);
        ck_assert_mem_eq(&one.floe[0].part, &other.floe[0].part, sizeof one.floe[0].part);
        ck_assert_int_eq(other.bodies, 1);
    }
    ck_assert(trimmed > 0 && trimmed < 10);
    peak_watch_free(&p);
    peak_watch_free(&q);
    scene_close(&k);
}
END_TEST

/* Two floes hold the hull up, and one helps it on: its three parts are all against the load, at two zones. */
START_TEST(a_floe_that_pushes_against_the_load_does_so_by_its_largest_part)
{
    static const struct {
        int32_t floe;
        uint8_t mechanism, zone;
        double normal, friction; /* against the hull's way */
    } share[] = {{5, MECHANISM_CRUSHING, ZONE_BOW, 20e3, 500},
                 {6, MECHANISM_IMPACT, ZONE_BOW, -605, 0},
                 {6, MECHANISM_CRUSHING, ZONE_BOW, -2819, 0},
                 {6, MECHANISM_ACCUMULATION, ZONE_STERN, -3549, 0},
                 {7, MECHANISM_ACCUMULATION, ZONE_STERN, -3413, 297}};
    enum { SHARES = sizeof share / sizeof *share };
    scene k;
    peak_watch p;
    peak_detail d;
    scene_open(&k, text);
    scene_steps(&k, 1);
    peak_watch_init(&k.ctx, 0.02, 0, &p);
    ck_assert(array_resize(&k.ctx, &k.w.scratch.shares, SHARES));
    vec3 sum = {0, 0, 0};
    for (int i = 0; i < SHARES; i++) {
        k.w.scratch.shares.data[i] = (ice_share){.floe = share[i].floe, .patch = -1, .body = share[i].floe};
        ice_share *c = &k.w.scratch.shares.data[i];
        c->mechanism = share[i].mechanism;
        c->zone = share[i].zone;
        c->normal = vec3_make(-share[i].normal, 0, 0);
        c->friction = vec3_make(-share[i].friction, 0, 0);
        sum = vec3_add(sum, vec3_add(c->normal, c->friction));
    }
    k.w.load_window.force[load_window_row(&k.w, 0, 0)] = sum;
    assert_ok(peak_watch_keep(&p, &k.w, &e), e);
    assert_ok(peak_watch_explain(&p, &k.w, 0, &d, &e), e);
    ck_assert_int_eq(d.floe_count, 3);
    ck_assert_int_eq(d.floe[0].mechanism, MECHANISM_CRUSHING);
    for (int i = 1; i < 3; i++) { /* the lesser push first */
        ck_assert_int_eq(d.floe[i].number, 8 - i);
        ck_assert_int_eq(d.floe[i].mechanism, MECHANISM_ACCUMULATION);
        ck_assert_int_eq(d.floe[i].zone, ZONE_STERN);
    }
    peak_watch_free(&p);
    scene_close(&k);
}
END_TEST

/* Restores or is refused; after that it is a fresh watch, which goes on. */
static bool is_taken(scene *k, const byte_array *bytes)
{
    peak_watch q;
    peak_watch_init(&k->ctx, 0.02, 0, &q);
    fram_status status = peak_state_restore(&q, &k->w, bytes, &e);
    ck_assert(status == FRAM_OK || (status == FRAM_ERROR_INPUT && q.filled == 0 && q.vessels.count == 0));
    peak_detail d;
    assert_ok(peak_watch_keep(&q, &k->w, &e), e);
    assert_ok(peak_watch_explain(&q, &k->w, 0, &d, &e), e);
    peak_watch_free(&q);
    return status == FRAM_OK;
}

START_TEST(bytes_that_are_no_state_are_refused)
{
    scene k;
    peak_watch p;
    byte_array a = {0};
    scene_open(&k, text);
    peak_watch_init(&k.ctx, 0.02, 0, &p);
    run(&k, &p, 60);
    ck_assert(peak_state_save(&p, &k.w, &a));
    ck_assert(is_taken(&k, &a));
    int32_t whole = a.count;
    for (int32_t i = 0; i < whole; i += 1 + whole / 200) {
        a.count = i;
        ck_assert(!is_taken(&k, &a));
    }
    a.count = whole;
    ck_assert(array_push(&k.ctx, &a, 0));
    ck_assert(!is_taken(&k, &a));
    a.count = whole;
    int refused = 0;
    for (int32_t i = 0; i < whole; i += 1 + whole / 2000) {
        a.data[i] ^= 0xff;
        refused += !is_taken(&k, &a);
        a.data[i] ^= 0xff;
    }
    ck_assert_int_gt(refused, 10);
    peak_watch_free(&p);
    array_free(&k.ctx, &a);
    scene_close(&k);
}
END_TEST

/* A watch that a resume makes of what was saved knows when it knows enough, as this one does. */
static void check_resumed(scene *k, peak_watch *p)
{
    peak_watch q;
    byte_array saved = {0};
    peak_watch_init(&k->ctx, 0.02, 0, &q);
    ck_assert(peak_state_save(p, &k->w, &saved));
    assert_ok(peak_state_restore(&q, &k->w, &saved, &e), e);
    ck_assert(peak_watch_await(&q, &k->w));
    assert_absolute(q.from, p->from, 1e-9);
    assert_absolute(q.vessels.data[0].picker.from, p->from, 1e-9);
    peak_watch_free(&q);
    array_free(&k->ctx, &saved);
}

/* The recording begins on a flank, with a window of 50 steps. */
START_TEST(a_recording_that_begins_late_explains_whole_peaks)
{
    static const char *const window[] = {"output.averaging_window=1"};
    char folder[SCRATCH_FOLDER];
    scene k;
    recording r;
    const recording_options options = {0};
    scratch_folder(folder);
    scene_open_with(&k, text, window, 1);
    scene_steps(&k, 50);
    assert_ok(recording_init(&k.ctx, &k.s, folder, &options, &r, &e), e);
    assert_ok(recording_prepare(&r, &e), e);
    assert_ok(recording_begin(&r, &k.w, &e), e);
    for (int i = 0; i < 100; i++) {
        scene_steps(&k, 1);
        assert_ok(recording_step(&r, 0, &e), e);
        const vessel_peaks *v = &r.recorder.peaks.vessels.data[0];
        const peak_detail *d = &v->detail.data[v->picker.candidate.room];
        if (peak_picker_keeps(&v->picker))
            assert_relative(sum_of(d), d->load, 1e-9);
        if (i == 20)
            check_resumed(&k, &r.recorder.peaks);
    }
    ck_assert(peak_picker_keeps(&r.recorder.peaks.vessels.data[0].picker));
    recording_free(&r);
    scene_close(&k);
    scratch_remove_folder(folder);
}
END_TEST

TEST_MAIN("peak_state", what_is_restored_goes_on_as_what_was_saved, parts_of_a_long_window_add_up,
          a_floe_that_is_crushed_is_one_body, a_floe_that_pushes_against_the_load_does_so_by_its_largest_part,
          bytes_that_are_no_state_are_refused, a_recording_that_begins_late_explains_whole_peaks)
