#include "dynamics/rest.h"

#include <string.h>

#define TABLE_SELF rest_table
TABLE_DEFINE(rest, REST_FIELDS)
#undef TABLE_SELF

/* What touches a body that sleeps wakes it from this many times the speed at which it fell asleep, and so do pushes
   that would have brought it there: bodies at rest waver up to once. */
static const double STRIKING = 2;

/* Means of pushes go on over this many times the time in which what differs from them is remembered. */
static const double MEAN_TIMES = 4;

/* Pushes are forgotten when they, and what they would do until they have faded, are this part of what wakes: what is
   left out is as small beside the speed at which bodies sleep. */
static const double FADED = 1e-6;

/* Slots that are passed over together where none of them has another body than before; a number of this file's own. */
enum { CHUNK = 64 };

static bool is_asleep(const body_table *b, int32_t slot) { return b->motion[slot] == MOTION_ASLEEP; }

/* Ice that moves freely, awake. */
static bool may_sleep(const body_table *b, int32_t slot)
{
    return body_is_dynamic(b, slot) && b->material[slot] == MATERIAL_ICE && b->shape[slot] >= 0;
}

static void forget(rest_table *rest, int32_t slot)
{
    const vec3 none = {0, 0, 0};
    rest->touch[slot] = 0;
    rest->still[slot] = rest->age[slot] = 0;
    rest->wind[slot] = rest->current[slot] = none;
    rest->push[slot] = rest->mean_push[slot] = rest->gain[slot] = none;
    rest->turn[slot] = rest->mean_turn[slot] = rest->spin[slot] = none;
}

static double age_most(const rest_settings *settings) { return MEAN_TIMES * settings->time; }

void rest_wake(body_table *bodies, rest_table *rest, int32_t slot)
{
    if (!is_asleep(bodies, slot))
        return;
    bodies->motion[slot] = MOTION_DYNAMIC;
    if (slot < rest->count)
        forget(rest, slot);
}

/* ---- what has changed since the last step ---- */

static bool is_within(double most, vec3 a, vec3 b) { return vec3_length(vec3_sub(a, b)) <= most; }

/* The media pass it as when it fell asleep, and the ground goes on as it did: its velocity is still that of the last
   step. */
static bool is_undisturbed(const rest_media *media, const body_table *bodies, const rest_table *rest, int32_t i)
{
    return is_within(media->slack, rest->wind[i], media->wind) &&
           is_within(media->slack, rest->current[i], media->current) &&
           is_within(media->swerve, bodies->velocity[i], media->ground);
}

static void wake_in(body_table *bodies, const broad_table *boxes, rest_table *rest, int32_t gone)
{
    box3 box = {boxes->lo[gone], boxes->hi[gone]};
    for (int32_t i = 0; i < bodies->count && i < boxes->count; i++)
        if (is_asleep(bodies, i) && boxes->generation[i] != 0 && box3_meet(box, (box3){boxes->lo[i], boxes->hi[i]}))
            rest_wake(bodies, rest, i);
}

/* The body that stood in this box has gone. */
static bool has_left(const body_table *bodies, const broad_table *boxes, int32_t slot)
{
    return boxes->generation[slot] != 0 &&
           (!body_is_alive(bodies, slot) || boxes->generation[slot] != bodies->generation[slot]);
}

static bool same_media(const rest_media *a, const rest_media *b)
{
    return is_within(0, a->wind, b->wind) && is_within(0, a->current, b->current) &&
           is_within(0, a->ground, b->ground) && a->slack == b->slack && a->swerve == b->swerve;
}

/* In the slots of a chunk are the bodies that these rows tell of. */
static bool are_known(const body_table *bodies, const uint32_t *generation, int32_t first, int32_t end)
{
    return body_slots_are_taken(bodies, first, end) &&
           memcmp(generation + first, bodies->generation + first, (size_t)(end - first) * sizeof *generation) == 0;
}

/* Rows of bodies that came or went begin anew. */
static void know_bodies(const body_table *bodies, rest_table *rest)
{
    for (int32_t first = 0; first < bodies->count; first += CHUNK) {
        int32_t end = first + CHUNK < bodies->count ? first + CHUNK : bodies->count;
        for (int32_t i = are_known(bodies, rest->generation, first, end) ? end : first; i < end; i++) {
            uint32_t now = body_is_alive(bodies, i) ? bodies->generation[i] : 0;
            if (rest->generation[i] != now)
                forget(rest, i);
            rest->generation[i] = now;
        }
    }
}

/* What sleeps sleeps on in the same media, and goes with the ground. */
static void look_at_media(const rest_media *media, body_table *bodies, rest_table *rest, rest_seen *seen)
{
    if (seen->known && same_media(media, &seen->media))
        return;
    for (int32_t i = 0; i < bodies->count; i++) {
        if (!is_asleep(bodies, i))
            continue;
        if (is_undisturbed(media, bodies, rest, i))
            bodies->velocity[i] = media->ground;
        else
            rest_wake(bodies, rest, i);
    }
    *seen = (rest_seen){*media, true};
}

bool rest_follow(context *ctx, const rest_settings *settings, const rest_media *media, body_table *bodies,
                 const broad_table *boxes, rest_table *rest, rest_seen *seen)
{
    if (!(settings->speed > 0))
        return true;
    if (!table_resize(ctx, rest, &rest_table_info, bodies->count))
        return false;
    know_bodies(bodies, rest);
    look_at_media(media, bodies, rest, seen);
    int32_t count = boxes->count < bodies->count ? boxes->count : bodies->count;
    for (int32_t first = 0; first < count; first += CHUNK) {
        int32_t end = first + CHUNK < count ? first + CHUNK : count;
        for (int32_t i = are_known(bodies, boxes->generation, first, end) ? end : first; i < end; i++)
            if (has_left(bodies, boxes, i))
                wake_in(bodies, boxes, rest, i);
    }
    return true;
}

/* ---- what comes near ---- */

/* A body that keeps others awake wherever it may reach them: of another material and able to move, or driven by
   itself.  A sheet that is carried is the ground. */
static bool stirs(const body_table *b, int32_t slot)
{
    switch ((motion)b->motion[slot]) {
    case MOTION_DYNAMIC:
        return b->material[slot] != MATERIAL_ICE;
    case MOTION_PRESCRIBED:
        return true;
    default:
        return false;
    }
}

static void come_near(body_table *bodies, rest_table *rest, int32_t slot, int32_t other)
{
    if (!stirs(bodies, other))
        return;
    rest_wake(bodies, rest, slot);
    rest->still[slot] = 0;
}

void rest_wake_near(const rest_settings *settings, body_table *bodies, const pair_table *pairs, rest_table *rest)
{
    if (!(settings->speed > 0))
        return;
    for (int32_t i = 0; i < pairs->count; i++) {
        come_near(bodies, rest, pairs->a[i], pairs->b[i]);
        come_near(bodies, rest, pairs->b[i], pairs->a[i]);
    }
}

static bool is_faster(double least, vec3 ground, const body_table *bodies, int32_t slot, vec3 point)
{
    return !is_within(least, body_point_velocity(bodies, slot, point), ground);
}

static void strike(double least, vec3 ground, body_table *bodies, rest_table *rest, int32_t sleeper, int32_t other,
                   vec3 point)
{
    if (is_asleep(bodies, sleeper) && is_faster(least, ground, bodies, other, point))
        rest_wake(bodies, rest, sleeper);
}

void rest_wake_struck(const rest_settings *settings, const rest_media *media, body_table *bodies,
                      const contact_array *contacts, rest_table *rest)
{
    if (!(settings->speed > 0))
        return;
    double least = STRIKING * settings->speed;
    for (int32_t i = 0; i < contacts->count; i++) {
        const contact *c = &contacts->data[i];
        strike(least, media->ground, bodies, rest, c->a, c->b, c->point);
        strike(least, media->ground, bodies, rest, c->b, c->a, c->point);
    }
}

/* ---- what a step did ---- */

static void note_motion(const rest_settings *settings, vec3 ground, double dt, const body_table *b,
                        const shape_store *shapes, rest_table *rest, int32_t i)
{
    rest->touch[i] = 0;
    if (!may_sleep(b, i)) {
        rest->still[i] = 0;
        return;
    }
    double rim = vec3_length(b->angular_velocity[i]) * shapes->shapes.radius[b->shape[i]];
    bool slow = vec3_length(vec3_sub(b->velocity[i], ground)) + rim < settings->speed;
    rest->still[i] = slow ? rest->still[i] + dt : 0;
}

/* What the other body of a contact is to one that is awake. */
static void note_touch(double least, vec3 ground, const body_table *b, rest_table *rest, int32_t slot, int32_t other,
                       const contact *c)
{
    if (!may_sleep(b, slot))
        return;
    bool stirred = stirs(b, other) || is_faster(least, ground, b, other, c->point);
    rest->touch[slot] |= (uint8_t)((stirred ? REST_BUSY : 0) | (c->impulse[0] > 0 ? REST_HELD : 0));
}

/* A push of one that is awake on one that is asleep. */
static void note_push(const body_table *b, rest_table *rest, int32_t slot, int32_t other, vec3 impulse, vec3 point)
{
    if (!is_asleep(b, slot) || !may_sleep(b, other))
        return;
    rest->touch[slot] |= REST_RECALLS;
    rest->push[slot] = vec3_add(rest->push[slot], impulse);
    rest->turn[slot] = vec3_add(rest->turn[slot], vec3_cross(vec3_sub(point, b->position[slot]), impulse));
}

/* One more value of a mean; then what the value has over it, on what fades. */
static void follow_mean(double part, double left, vec3 now, vec3 *mean, vec3 *beyond)
{
    *mean = vec3_mad(*mean, vec3_sub(now, *mean), part);
    *beyond = vec3_add(vec3_scale(*beyond, left), vec3_sub(now, *mean));
}

static void sum_pushes(const rest_settings *settings, double dt, rest_table *rest, int32_t i)
{
    rest->age[i] = fmin(rest->age[i] + dt, age_most(settings));
    double part = dt / rest->age[i], left = fmax(0, 1 - dt / settings->time);
    follow_mean(part, left, rest->push[i], &rest->mean_push[i], &rest->gain[i]);
    follow_mean(part, left, rest->turn[i], &rest->mean_turn[i], &rest->spin[i]);
}

/* Speed of the centre or of the rim, whichever is greater, that an impulse and an angular one [N s, N m s] would have
   given a body. */
static double missed_speed(const body_table *b, const shape_store *shapes, int32_t i, double impulse, double turn)
{
    sym3 inertia = b->inertia[i];
    double least = fmin(inertia.xx, fmin(inertia.yy, inertia.zz));
    return fmax(impulse / b->mass[i], turn * shapes->shapes.radius[b->shape[i]] / least);
}

/* Nothing has pushed it in this step, and what did before is next to nothing by now; a mean that is left goes on to be
   missed for the time in which pushes are remembered. */
static bool has_faded(const rest_settings *settings, double dt, const body_table *b, const shape_store *shapes,
                      const rest_table *rest, int32_t i)
{
    const vec3 none = {0, 0, 0};
    if (rest->age[i] < age_most(settings) || !is_within(0, rest->push[i], none) || !is_within(0, rest->turn[i], none))
        return false;
    double steps = settings->time / dt;
    double impulse = vec3_length(rest->gain[i]) + steps * vec3_length(rest->mean_push[i]);
    double turn = vec3_length(rest->spin[i]) + steps * vec3_length(rest->mean_turn[i]);
    return missed_speed(b, shapes, i, impulse, turn) < FADED * STRIKING * settings->speed;
}

static void forget_pushes(rest_table *rest, int32_t i)
{
    rest->touch[i] = 0;
    rest->mean_push[i] = rest->gain[i] = rest->mean_turn[i] = rest->spin[i] = (vec3){0, 0, 0};
}

/* The first row of first..end-1 of a body asleep that recalls something, `end` without. */
static int32_t next_recalling(const body_table *bodies, const rest_table *rest, int32_t first, int32_t end)
{
    static const uint8_t none[8] = {0};
    while (first < end) {
        if (is_asleep(bodies, first) && rest->touch[first] != 0)
            return first;
        first += end - first >= 8 && memcmp(rest->touch + first, none, sizeof none) == 0 ? 8 : 1;
    }
    return end;
}

void rest_note(const rest_settings *settings, const rest_media *media, double dt, body_table *bodies,
               const shape_store *shapes, const contact_array *contacts, rest_table *rest)
{
    if (!(settings->speed > 0))
        return;
    double least = STRIKING * settings->speed;
    int32_t rows = rest->count;
    for (int32_t i = body_next_moving(bodies, 0, rows); i < rows; i = body_next_moving(bodies, i + 1, rows))
        note_motion(settings, media->ground, dt, bodies, shapes, rest, i);
    for (int32_t i = next_recalling(bodies, rest, 0, rows); i < rows; i = next_recalling(bodies, rest, i + 1, rows))
        rest->push[i] = rest->turn[i] = (vec3){0, 0, 0};
    for (int32_t i = 0; i < contacts->count; i++) {
        const contact *c = &contacts->data[i];
        note_touch(least, media->ground, bodies, rest, c->a, c->b, c);
        note_touch(least, media->ground, bodies, rest, c->b, c->a, c);
        if (!(c->impulse[0] > 0) || is_asleep(bodies, c->a) == is_asleep(bodies, c->b))
            continue;
        vec3 impulse = contact_impulse(c);
        note_push(bodies, rest, c->a, c->b, impulse, c->point);
        note_push(bodies, rest, c->b, c->a, vec3_neg(impulse), c->point);
    }
    for (int32_t i = next_recalling(bodies, rest, 0, rows); i < rows; i = next_recalling(bodies, rest, i + 1, rows)) {
        sum_pushes(settings, dt, rest, i);
        if (missed_speed(bodies, shapes, i, vec3_length(rest->gain[i]), vec3_length(rest->spin[i])) > least)
            rest_wake(bodies, rest, i);
        else if (has_faded(settings, dt, bodies, shapes, rest, i))
            forget_pushes(rest, i);
    }
}

/* ---- falling asleep ---- */

static bool rests(const rest_settings *settings, const rest_media *media, const body_table *b, const rest_table *rest,
                  int32_t i)
{
    bool known = rest->generation[i] == b->generation[i] && may_sleep(b, i);
    bool held = media->calm || (rest->touch[i] & REST_HELD);
    return known && held && !(rest->touch[i] & REST_BUSY) && rest->still[i] >= settings->time;
}

static void fall_asleep(const rest_media *media, body_table *b, rest_table *rest, int32_t i)
{
    const vec3 none = {0, 0, 0};
    b->motion[i] = MOTION_ASLEEP;
    b->velocity[i] = media->ground;
    b->angular_velocity[i] = none;
    rest->wind[i] = media->wind;
    rest->current[i] = media->current;
    rest->age[i] = 0;
    rest->touch[i] = REST_RECALLS;
}

void rest_settle(const rest_settings *settings, const rest_media *media, body_table *bodies,
                 const contact_array *contacts, rest_table *rest, rest_seen *seen)
{
    if (!(settings->speed > 0))
        return;
    bool any = false;
    seen->known = seen->known && same_media(media, &seen->media);
    int32_t rows = rest->count;
    for (int32_t i = body_next_moving(bodies, 0, rows); i < rows; i = body_next_moving(bodies, i + 1, rows)) {
        if (!rests(settings, media, bodies, rest, i))
            continue;
        fall_asleep(media, bodies, rest, i);
        any = true;
    }
    /* One that fell asleep no longer pushes those that sleep already: the means of these begin anew. */
    for (int32_t i = 0; i < contacts->count && any; i++) {
        int32_t a = contacts->data[i].a, b = contacts->data[i].b;
        if (a >= rest->count || b >= rest->count || !is_asleep(bodies, a) || !is_asleep(bodies, b))
            continue;
        rest->age[a] = rest->age[b] = 0;
        rest->touch[a] |= REST_RECALLS;
        rest->touch[b] |= REST_RECALLS;
    }
}
