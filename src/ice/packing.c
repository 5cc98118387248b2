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
/* Growth of concave floes: it begins at this part of their size, and they grow by no more than this part in a round, as
   fast as a wanted squeeze allows; where it is exceeded they shrink at up to half that speed. */
static const double GROW_FROM = 0.4, GROW_RATE = 0.002, MOST_SHRINK = -0.5;
enum { GROW_MOVE_EVERY = 10 };
/* A growth: its length, the amplitude of the shaking at its beginning and at its end, and the mean squeeze that is
   wanted. */
typedef struct growth {
    double rounds, first_shake, last_shake, squeeze;
} growth;
/* Of coarse shapes, and of fine ones. */
static const growth COARSE_GROWTH = {1000, 0.1, 0.01, 0.01}, FINE_GROWTH = {400, 0.03, 0.005, 0.005};
/* Growths from other first places, each so many times as long: what is not dense takes a short one, and what is dense
   is no denser for several short ones. */
static const double GROWTH_LENGTH[] = {1, 5, 8, 8};
enum { MOST_GROWTHS = sizeof GROWTH_LENGTH / sizeof *GROWTH_LENGTH };
/* New beginnings from other first places.  In a field of few floes a single large one decides, and they are cheap: as
   many as make up this many floes, and no more than the other number. */
enum { START_FLOES = 4000, MOST_STARTS = 8 };
/* Floes that overlap by this part of their size are hooked into each other: the smaller is carried away before a new
   shaking. */
static const double HOOKED = 0.05;
/* Full-grown concave floes that still overlap are shaken gently so many times. */
static const double GENTLE_SHAKE = 0.01, GENTLE_LENGTH = 0.3;
enum { MOST_FINISHES = 8 };
/* Concave floes that do not grow to this part of their size are beyond hope. */
static const double STUNTED = 0.96;
/* A field squeezed by more than this part of a floe's size after shaking is beyond hope. */
static const double HOPELESS = 0.03;
/* From the seed of one beginning to that of the next: far from any number that is given as a seed. */
static const uint64_t ANOTHER_SEED = 0x9e3779b97f4a7c15;
/* Steps by which an impossible field shrinks until it fits. */
static const double SHRINK = 0.997;
enum { MOST_SHRINKS = 60 };

double pack_mean_squeeze(const pack_layout *l, const pack_contacts *c)
{
    double sum = 0;
    for (int32_t i = 0; i < l->movable; i++)
        sum += c->squeeze.data[i] / l->bodies.data[i].size;
    return l->movable > 0 ? sum / l->movable : 0;
}

/* One round; `apart` tells that nothing overlapped before it. false: no memory, or w->status. */
static bool do_round(pack_work *w, double shake, bool *apart)
{
    w->status = work_continue(w->ctx, "packing the ice", w->round, 0, w->error);
    if (w->status != FRAM_OK || !pack_find_pairs(w, false))
        return false;
    pack_place(&w->layout);
    if (!pack_find_rows(w))
        return false;
    *apart = w->contacts.overlap <= 0;
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
        double now = pack_mean_squeeze(&w->layout, &w->contacts);
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
    int32_t every = w->layout.concave ? GROW_MOVE_EVERY : MOVE_EVERY;
    for (int32_t k = 0; k < rounds; k++) {
        if (k % every == every - 1 && !pack_move_squeezed(w, 0, moves))
            return false;
        double left = 1 - k / rounds;
        if (!do_round(w, amplitude * left * left, &apart))
            return false;
    }
    return true;
}

/* Growth from where the floes are: under a steady squeeze they stay in reach of one another's edges, where full-grown
   ones would lie across each other. */
static bool grow(pack_work *w, const growth *g, double length, int32_t *moves)
{
    bool apart;
    double rounds = length * g->rounds;
    if (!pack_find_pairs(w, true))
        return false;
    for (int32_t k = 0; k < rounds && w->layout.scale < 1; k++) {
        if (k % GROW_MOVE_EVERY == GROW_MOVE_EVERY - 1 && !pack_move_squeezed(w, 0, moves))
            return false;
        if (!do_round(w, g->first_shake + (g->last_shake - g->first_shake) * k / rounds, &apart))
            return false;
        double step = fmax(MOST_SHRINK, 1 - pack_mean_squeeze(&w->layout, &w->contacts) / g->squeeze);
        w->layout.scale = fmin(1, w->layout.scale * (1 + GROW_RATE * step));
    }
    return true;
}

/* What would have fitted: all floes smaller by a common factor until they are apart. */
static bool find_fit(pack_work *w, double *scale)
{
    bool apart = false;
    *scale = 0;
    for (int k = 0; k < MOST_SHRINKS && !apart; k++) {
        w->layout.scale *= SHRINK;
        if (!settle(w, &apart))
            return false;
    }
    *scale = apart ? w->layout.scale : 0;
    return true;
}

/* Full-grown floes come to rest. */
static bool finish(pack_work *w, double effort, bool *apart, int32_t *moves)
{
    if (!settle(w, apart))
        return false;
    for (int k = 0; k < MOST_FINISHES && !*apart; k++)
        if (!shake(w, GENTLE_SHAKE, effort * GENTLE_LENGTH, moves) || !settle(w, apart))
            return false;
    return true;
}

/* First places. */
static bool begin(pack_work *w, int32_t number)
{
    w->seed = w->request->seed + (uint64_t)number * ANOTHER_SEED;
    w->layout.coarse = w->request->coarse != NULL;
    w->layout.scale = 1;
    if (!pack_bodies_make(w))
        return false;
    w->gap = GAP * w->layout.mean_size;
    return pack_start(w) && pack_sort_bodies(w->ctx, &w->layout);
}

/* One beginning of a field of concave floes: they grow, first as coarse shapes; *apart: it came to an end, *hopeless:
   another one need not be tried.  false: no memory. */
static bool solve_grown(pack_work *w, double length, packing_report *report, bool *apart, bool *hopeless)
{
    w->layout.scale = GROW_FROM;
    if (!pack_find_pairs(w, true) || !settle(w, apart) || !grow(w, &COARSE_GROWTH, length, &report->moves))
        return false;
    if (w->layout.coarse && !pack_refine(w))
        return false;
    if (!grow(w, &FINE_GROWTH, length, &report->moves))
        return false;
    *apart = false;
    *hopeless = w->layout.scale < STUNTED;
    return w->layout.scale < 1 || finish(w, fmin(1, length), apart, &report->moves);
}

/* One beginning of a field of convex floes: settle, then shake ever longer. */
static bool solve_shaken(pack_work *w, double effort, packing_report *report, bool *apart, bool *hopeless)
{
    if (!pack_find_pairs(w, true) || !settle(w, apart))
        return false;
    for (int k = 0; k < ATTEMPTS && !*apart && !*hopeless; k++) {
        if (k > 0 && !pack_move_squeezed(w, HOOKED, &report->moves))
            return false;
        if (!shake(w, SHAKE, effort * (1 << k), &report->moves) || !settle(w, apart))
            return false;
        *hopeless = pack_mean_squeeze(&w->layout, &w->contacts) > HOPELESS;
    }
    return true;
}

/* false: no memory */
static bool solve(pack_work *w, packing_report *report)
{
    bool apart = false, hopeless = false, good = true;
    double effort = w->request->effort > 0 ? w->request->effort : 1;
    int32_t floes = polygon_list_count(w->request->shapes), starts = floes > 0 ? START_FLOES / floes : 1;
    starts = starts < 1 ? 1 : starts > MOST_STARTS ? MOST_STARTS : starts;
    for (int32_t k = 0; k < starts && good && !apart && !hopeless; k++) {
        good = begin(w, k);
        bool grown = w->layout.coarse || w->layout.concave;
        starts = grown ? MOST_GROWTHS : starts;
        if (good)
            good = grown ? solve_grown(w, effort * GROWTH_LENGTH[k], report, &apart, &hopeless)
                         : solve_shaken(w, effort, report, &apart, &hopeless);
    }
    report->done = apart;
    report->rounds = w->round;
    report->overlap = apart ? 0 : w->contacts.overlap;
    report->scale = 1;
    return good;
}

fram_status packing_solve(context *ctx, overlay *o, const packing_request *request, packing_pose_array *poses,
                          packing_report *report, fram_error *error)
{
    box2 d = request->domain;
    pack_work w = {.ctx = ctx, .request = request, .overlay = o, .error = error, .layout.scale = 1};
    w.period = (vec2){request->periodic_x ? d.hi.x - d.lo.x : 0, request->periodic_y ? d.hi.y - d.lo.y : 0};
    *report = (packing_report){0};
    bool good = solve(&w, report) && array_resize(ctx, poses, w.layout.movable);
    if (good)
        pack_poses(&w.layout, poses);
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
