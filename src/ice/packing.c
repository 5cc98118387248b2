/* The packing's schedule: settle, shake, settle; see packing.h. */
#include "ice/packing_work.h"

/* Clear distance that the rounds aim at, in mean floe sizes: what is left of an overlap must be less. */
static const double GAP = 1e-4;
/* Settling goes on while the mean squeeze falls to this part within so many rounds. */
static const double SETTLING = 0.8;
enum { SETTLE_WATCH = 40, MOST_SETTLE = 600 };
/* Shaking: its length, its greatest amplitude in floe sizes, and how often squeezed floes are carried meanwhile. */
enum { SHAKE_ROUNDS = 1000, MOVE_EVERY = 40, ATTEMPTS = 3 };
static const double SHAKE = 0.2;
/* Growth of concave floes: where it begins, its length, and the amplitude of the shaking meanwhile. */
static const double GROW_FROM = 0.4, GROW_SHAKE = 0.1;
enum { GROW_ROUNDS = 400 };
/* New beginnings from other first places.  In a field of few floes a single large one decides, and they are cheap: as
   many as make up this many floes, and no more than the other number. */
enum { START_FLOES = 4000, MOST_STARTS = 8 };
/* Floes that overlap by this part of their size are hooked into each other: the smaller is carried away before a new
   shaking. */
static const double HOOKED = 0.05;
/* A field of concave floes that is squeezed by no more than SETTLED on the mean, relative to their size, is shaken
   gently; one squeezed by less than HOOKED_ONLY has but a few pairs that hook into each other, by UNHOOKED at least:
   their smaller floes shrink and grow again. */
static const double SETTLED = 2.5e-3, GENTLE_SHAKE = 0.03, GENTLE_LENGTH = 0.1;
static const double HOOKED_ONLY = 2e-4, UNHOOKED = 1e-3, REGROW_FROM = 0.6, REGROW_SHAKE = 0.02;
enum { MOST_FINISHES = 12, REGROW_ROUNDS = 100 };
/* A field squeezed by more than this part of a floe's size after shaking is beyond hope. */
static const double HOPELESS = 0.03;
/* From the seed of one beginning to that of the next: far from any number that is given as a seed. */
static const uint64_t ANOTHER_SEED = 0x9e3779b97f4a7c15;
/* Steps by which an impossible field shrinks until it fits. */
static const double SHRINK = 0.997;
enum { MOST_SHRINKS = 60 };

/* Mean of the floes' deepest overlaps, each over the floe's size. */
static double mean_squeeze(const pack_work *w)
{
    double sum = 0;
    for (int32_t i = 0; i < w->movable; i++)
        sum += w->squeeze.data[i] / w->bodies.data[i].size;
    return w->movable > 0 ? sum / w->movable : 0;
}

/* One round; `apart` tells that nothing overlapped before it. false: no memory. */
static bool do_round(pack_work *w, double shake, bool *apart)
{
    bool good = pack_find_pairs(w, false);
    if (!good)
        return false;
    pack_place(w);
    if (!pack_find_rows(w))
        return false;
    *apart = w->overlap <= 0;
    if (!*apart || shake > 0)
        pack_solve_rows(w, shake);
    w->round++;
    return true;
}

/* Rounds without shaking until nothing overlaps or nothing gets better. */
static bool settle(pack_work *w, bool *apart)
{
    double before = HUGE_VAL;
    *apart = false;
    for (int k = 0; k < MOST_SETTLE && !*apart; k++) {
        if (!do_round(w, 0, apart))
            return false;
        if (k % SETTLE_WATCH != SETTLE_WATCH - 1)
            continue;
        double now = mean_squeeze(w);
        if (now > SETTLING * before)
            break;
        before = now;
    }
    return true;
}

static bool shake(pack_work *w, double amplitude, double length, int32_t *moves)
{
    bool apart;
    double rounds = length * SHAKE_ROUNDS;
    for (int32_t k = 0; k < rounds; k++) {
        if (k % MOVE_EVERY == MOVE_EVERY - 1 && !pack_move_squeezed(w, 0, moves))
            return false;
        double left = 1 - k / rounds;
        if (!do_round(w, amplitude * left * left, &apart))
            return false;
    }
    return true;
}

/* Growth from a loose field of small floes: concave ones would otherwise hook into each other. */
static bool grow(pack_work *w, double length, int32_t *moves)
{
    bool apart;
    double rounds = length * GROW_ROUNDS;
    w->scale = GROW_FROM;
    if (!pack_find_pairs(w, true) || !settle(w, &apart))
        return false;
    for (int32_t k = 0; k < rounds; k++) {
        if (k % MOVE_EVERY == MOVE_EVERY - 1 && !pack_move_squeezed(w, 0, moves))
            return false;
        w->scale = GROW_FROM + (1 - GROW_FROM) * (k + 1) / rounds;
        if (!do_round(w, GROW_SHAKE, &apart))
            return false;
    }
    w->scale = 1;
    return true;
}

/* What would have fitted: all floes smaller by a common factor until they are apart. */
static bool find_fit(pack_work *w, double *scale)
{
    bool apart = false;
    *scale = 0;
    for (int k = 0; k < MOST_SHRINKS && !apart; k++) {
        w->scale *= SHRINK;
        if (!settle(w, &apart))
            return false;
    }
    *scale = apart ? w->scale : 0;
    return true;
}

/* Floes that hook into others shrink, and grow again at the same place, where they push the others aside instead. */
static bool unhook(pack_work *w)
{
    bool apart;
    pack_shrink_hooked(w, UNHOOKED, REGROW_FROM);
    for (int32_t k = 1; k <= REGROW_ROUNDS; k++) {
        for (int32_t i = 0; i < w->movable; i++) {
            pack_body *b = &w->bodies.data[i];
            if (b->grown < 1)
                b->grown = k < REGROW_ROUNDS ? REGROW_FROM + (1 - REGROW_FROM) * k / REGROW_ROUNDS : 1;
        }
        if (!do_round(w, REGROW_SHAKE, &apart))
            return false;
    }
    return true;
}

/* What settled almost: a few hooked pairs are parted, a slight squeeze is shaken gently. */
static bool finish(pack_work *w, double effort, bool *apart, int32_t *moves)
{
    for (int k = 0; k < MOST_FINISHES && !*apart && w->concave; k++) {
        double squeeze = mean_squeeze(w);
        if (squeeze > SETTLED)
            break;
        if (!(squeeze < HOOKED_ONLY ? unhook(w) : shake(w, GENTLE_SHAKE, effort * GENTLE_LENGTH, moves)) ||
            !settle(w, apart))
            return false;
    }
    return true;
}

/* First places; coarse shapes are packed before the fine ones. */
static bool begin(pack_work *w, double effort, bool *apart, int32_t *moves)
{
    w->coarse = w->request->coarse != NULL;
    if (!pack_bodies_make(w))
        return false;
    w->gap = GAP * w->mean_size;
    if (!pack_start(w) || !pack_sort_bodies(w) || (w->concave && !grow(w, effort, moves)) ||
        !pack_find_pairs(w, true) || !settle(w, apart))
        return false;
    if (!w->coarse)
        return true;
    if (!*apart && (!shake(w, SHAKE, effort, moves) || !settle(w, apart)))
        return false;
    return pack_refine(w) && pack_find_pairs(w, true) && settle(w, apart) && finish(w, effort, apart, moves);
}

/* One beginning: settle, then shake ever longer; *apart: it came to an end, *hopeless: another one need not be tried.
   false: no memory. */
static bool solve_once(pack_work *w, double effort, packing_report *report, bool *apart, bool *hopeless)
{
    if (!begin(w, effort, apart, &report->moves))
        return false;
    for (int k = 0; k < ATTEMPTS && !*apart && !*hopeless; k++) {
        if (k > 0 && !pack_move_squeezed(w, HOOKED, &report->moves))
            return false;
        if (!shake(w, SHAKE, effort * (1 << k), &report->moves) || !settle(w, apart) ||
            !finish(w, effort, apart, &report->moves))
            return false;
        *hopeless = mean_squeeze(w) > HOPELESS;
    }
    return true;
}

/* false: no memory */
static bool solve(pack_work *w, packing_report *report)
{
    bool apart = false, hopeless = false;
    double effort = w->request->effort > 0 ? w->request->effort : 1;
    int32_t floes = polygon_list_count(w->request->shapes), starts = floes > 0 ? START_FLOES / floes : 1;
    starts = starts < 1 ? 1 : starts > MOST_STARTS ? MOST_STARTS : starts;
    for (int32_t k = 0; k < starts && !apart && !hopeless; k++) {
        w->seed = w->request->seed + (uint64_t)k * ANOTHER_SEED;
        if (!solve_once(w, effort, report, &apart, &hopeless))
            return false;
    }
    report->done = apart;
    report->rounds = w->round;
    report->overlap = apart ? 0 : w->overlap;
    report->scale = 1;
    return true;
}

fram_status packing_solve(context *ctx, overlay *o, const packing_request *request, packing_pose_array *poses,
                          packing_report *report, fram_error *error)
{
    box2 d = request->domain;
    pack_work w = {.ctx = ctx, .request = request, .overlay = o, .error = error, .scale = 1};
    w.period = (vec2){request->periodic_x ? d.hi.x - d.lo.x : 0, request->periodic_y ? d.hi.y - d.lo.y : 0};
    *report = (packing_report){0};
    bool good = solve(&w, report) && array_resize(ctx, poses, w.movable);
    if (good)
        pack_poses(&w, poses);
    good = good && (report->done || find_fit(&w, &report->scale));
    pack_work_free(&w);
    return good ? FRAM_OK : w.status != FRAM_OK ? w.status : error_memory(error);
}

bool packing_outline(context *ctx, polygon shape, packing_pose pose, vec2_array *out)
{
    if (!array_resize(ctx, out, shape.count))
        return false;
    for (int32_t i = 0; i < shape.count; i++) {
        vec2 v = shape.vertex[i];
        out->data[i] = (vec2){pose.centre.x + pose.turn.x * v.x - pose.turn.y * v.y,
                              pose.centre.y + pose.turn.y * v.x + pose.turn.x * v.y};
    }
    return true;
}
