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
/* A field squeezed by more than this part of a floe's size after shaking is beyond hope. */
static const double HOPELESS = 0.03;
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
        if (k % MOVE_EVERY == MOVE_EVERY - 1 && !pack_move_squeezed(w, false, moves))
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
        if (k % MOVE_EVERY == MOVE_EVERY - 1 && !pack_move_squeezed(w, false, moves))
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

/* false: no memory */
static bool solve(pack_work *w, packing_report *report)
{
    bool apart = false;
    double effort = w->request->effort > 0 ? w->request->effort : 1;
    if (!pack_start(w) || !pack_sort_bodies(w) || (w->concave && !grow(w, effort, &report->moves)) ||
        !pack_find_pairs(w, true) || !settle(w, &apart))
        return false;
    for (int k = 0; k < ATTEMPTS && !apart; k++) {
        if (k > 0 && !pack_move_squeezed(w, true, &report->moves))
            return false;
        if (!shake(w, SHAKE, effort * (1 << k), &report->moves) || !settle(w, &apart))
            return false;
        if (mean_squeeze(w) > HOPELESS)
            break;
    }
    report->done = apart;
    report->rounds = w->round;
    report->overlap = apart ? 0 : w->overlap;
    report->scale = 1;
    return true;
}

static void copy_poses(const pack_work *w, packing_pose_array *poses)
{
    for (int32_t i = 0; i < w->movable; i++)
        poses->data[w->shape.data[i]] = (packing_pose){w->bodies.data[i].centre, w->bodies.data[i].turn};
}

fram_status packing_solve(context *ctx, overlay *o, const packing_request *request, packing_pose_array *poses,
                          packing_report *report, fram_error *error)
{
    box2 d = request->domain;
    pack_work w = {.ctx = ctx, .request = request, .scale = 1};
    w.period = (vec2){request->periodic_x ? d.hi.x - d.lo.x : 0, request->periodic_y ? d.hi.y - d.lo.y : 0};
    *report = (packing_report){0};
    fram_status status = pack_bodies_make(&w, o, error);
    w.gap = GAP * w.mean_size;
    if (status == FRAM_OK && (!solve(&w, report) || !array_resize(ctx, poses, w.movable)))
        status = error_memory(error);
    if (status == FRAM_OK) {
        copy_poses(&w, poses);
        if (!report->done && !find_fit(&w, &report->scale))
            status = error_memory(error);
    }
    pack_work_free(&w);
    return status;
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
