#include "vessel/track.h"

#include "base/transcendental.h"

/* A corner that turns by more is turned about at on a loop. */
static const double SHARPEST = 0.75 * PI;
/* Steps by which a track is searched, and by which a foot is made better. */
enum { JOIN_PLACES = 256, FOOT_STEPS = 4 };
/* At most of a leg and the corner at its end. */
enum { CORNER_PIECES = 5 };
/* Part of a leg under which what two corners leave of it is nothing to be at work on: a square that is begun a little
   off its side's middle is all corners. */
static const double LEAST_STRAIGHT = 0.05;
/* 1 - curvature times distance falls to nothing at the centre of an arc. */
static const double LEAST_FOOT_NEARNESS = 0.2;
/* A loop that turns about turns away by 60 degrees, goes straight on for 2 cot 60 radii, so that the turn of 240
   degrees the other way ends on the line that it came from, and follows that back to where it began. */
static const double AWAY = PI / 3, ON = 1.1547005383792517, BACK = 2.3094010767585034;
/* How far such a loop reaches ahead, in radii: 2 sin 60 + 1 + cos 60 ON. */
static const double LOOP_REACH = 3.3094010767585034;

static void add(track *t, double length, double curvature, bool turning)
{
    if (!(length > 0))
        return;
    t->piece[t->count++] = (track_piece){length, curvature, turning};
    t->length += length;
}

/* Of a turn to port (side 1) or starboard (-1); no radius makes an arc of no length. */
static double curvature_of(double side, double radius) { return radius > 0 ? side / radius : 0; }

/* side: 1 turns away to port, -1 to starboard.  A loop that turns by less (135 to 180 degrees) turns away by more and
   goes on for longer, so that the same turn of 240 degrees ends on the line that leads on from where it began. */
static void add_loop(track *t, double radius, double side, double turn)
{
    double longer = ON * (1 + real_cos(turn));
    add(t, radius * (AWAY + (PI - turn)), curvature_of(side, radius), true);
    add(t, radius * (ON + longer), 0, true);
    add(t, radius * (PI + AWAY), curvature_of(-side, radius), true);
    add(t, radius * (BACK + 0.5 * longer + real_sin(turn)), 0, true);
}

/* Both loops lie to starboard of the way there: updrift of a way to the left. */
static track there_and_back(vec2 start, double heading, double length, double curvature, double radius)
{
    track t = {.start = start, .heading = heading, .closed = true};
    add(&t, length, curvature, false);
    add_loop(&t, radius, -1, PI);
    add(&t, length, -curvature, false);
    add_loop(&t, radius, 1, PI);
    return t;
}

static track square_track(const pattern_shape *p, double radius)
{
    double r = fmin(radius, 0.5 * p->width), half = 0.5 * p->width;
    bool straight = p->width > 2 * r;
    track t = {.start = {p->distance + half, r - half}, .heading = 0.5 * PI, .closed = true};
    for (int side = 0; side < 4; side++) {
        add(&t, p->width - 2 * r, 0, false);
        add(&t, 0.5 * PI * r, curvature_of(1, r), straight);
    }
    return t;
}

static track shape_track(const pattern_shape *p, double radius)
{
    double half;
    track circle;
    switch (p->kind) {
    case PATTERN_LINE:
        return there_and_back((vec2){p->distance + LOOP_REACH * radius, 0}, 0, p->width, 0, radius);
    case PATTERN_ACROSS:
        return there_and_back((vec2){p->distance, -0.5 * p->width}, 0.5 * PI, p->width, 0, radius);
    case PATTERN_CIRCLE:
        circle = (track){.start = {p->distance + 0.5 * p->width, 0}, .heading = 0.5 * PI, .closed = true};
        add(&circle, PI * p->width, 2 / p->width, false);
        return circle;
    case PATTERN_SQUARE:
        return square_track(p, radius);
    case PATTERN_SECTOR:
        half = 0.5 * p->width / p->distance;
        return there_and_back((vec2){p->distance * real_cos(half), -p->distance * real_sin(half)}, 0.5 * PI - half,
                              p->width, 1 / p->distance, radius);
    case PATTERN_AHEAD: /* no shape: it is where the ice comes from */
    case PATTERN_NONE:
        break;
    }
    return (track){.count = 0};
}

track track_of_pattern(const pattern_shape *p, double radius)
{
    track t = shape_track(p, radius);
    t.start.y += p->aside;
    return t;
}

static double angle_between(double from, double to)
{
    double a = to - from;
    return a - 2 * PI * floor((a + PI) / (2 * PI));
}

/* By which the way turns at a corner, to port. */
static double turn_at(vec2 before, vec2 corner, vec2 after)
{
    vec2 in = vec2_sub(corner, before), out = vec2_sub(after, corner);
    return angle_between(real_atan2(in.y, in.x), real_atan2(out.y, out.x));
}

static double corner_takes(vec2 before, vec2 corner, vec2 after, double radius)
{
    double sharp = fabs(turn_at(before, corner, after));
    return sharp > SHARPEST ? 0 : radius * real_tan(0.5 * sharp);
}

bool track_turns_about(vec2 before, vec2 corner, vec2 after) { return fabs(turn_at(before, corner, after)) > SHARPEST; }

/* Way points, the legs before them and what their corners take, if there is room. */
typedef struct track_course {
    const vec2 *point;
    int32_t count;
    double radius, leg[TRACK_POINTS], takes[TRACK_POINTS + 1];
} track_course;

static track_course legs_of(const vec2 *point, int32_t count, double radius)
{
    track_course c = {.point = point, .count = count < TRACK_POINTS ? count : TRACK_POINTS, .radius = radius};
    for (int32_t i = 1; i < c.count; i++)
        c.leg[i] = vec2_length(vec2_sub(point[i], point[i - 1]));
    for (int32_t i = 1; i + 1 < c.count; i++)
        c.takes[i] = corner_takes(point[i - 1], point[i], point[i + 1], radius);
    return c;
}

/* Part of its radius that a corner has: two on a leg that is too short for both share it as they would take of it. */
static double part_of(const track_course *c, int32_t i)
{
    if (!(c->takes[i] > 0))
        return 1;
    double in = c->leg[i] / (c->takes[i - 1] + c->takes[i]), out = c->leg[i + 1] / (c->takes[i] + c->takes[i + 1]);
    return fmin(1, fmin(in, out));
}

double track_corner_left(const vec2 *point, int32_t count, int32_t i, double radius)
{
    const track_course c = legs_of(point, count, radius);
    return part_of(&c, i) * radius;
}

/* What a corner takes of each of its legs. */
static double cut_of(const track_course *c, int32_t i) { return part_of(c, i) * c->takes[i]; }

/* Whether the corners at the ends of the leg to point i leave something of it. */
static bool is_straight(const track_course *c, int32_t i)
{
    return c->leg[i] - cut_of(c, i - 1) - cut_of(c, i) > LEAST_STRAIGHT * c->leg[i];
}

/* A corner between legs of which nothing is left is all that is asked for there, and no room to turn. */
static void add_corner(track *t, const track_course *c, int32_t i)
{
    double turn = turn_at(c->point[i - 1], c->point[i], c->point[i + 1]), side = turn > 0 ? 1 : -1;
    double radius = part_of(c, i) * c->radius;
    if (fabs(turn) > SHARPEST)
        add_loop(t, radius, -side, fabs(turn));
    else
        add(t, radius * fabs(turn), curvature_of(side, radius), is_straight(c, i) || is_straight(c, i + 1));
}

track track_of_legs(const vec2 *point, int32_t count, int32_t at, double radius, double *corner)
{
    const track_course c = legs_of(point, count, radius);
    vec2 leg = vec2_sub(point[at + 1], point[at]);
    double cut = cut_of(&c, at);
    track t = {.start = point[at], .heading = real_atan2(leg.y, leg.x)};
    if (cut > 0)
        t.start = vec2_add(t.start, vec2_scale(leg, cut / c.leg[at + 1]));
    *corner = HUGE_VAL;
    for (int32_t i = at + 1; i < c.count && t.count + CORNER_PIECES <= TRACK_PIECES; i++) {
        double next = cut_of(&c, i);
        add(&t, c.leg[i] - cut - next, 0, false);
        if (i + 1 == c.count)
            break;
        add_corner(&t, &c, i);
        if (i == at + 1)
            *corner = t.length;
        cut = next;
    }
    return t;
}

static track_place along(const track_place *from, const track_piece *piece, double way)
{
    double turn = piece->curvature * way, heading = from->heading, end = heading + turn;
    track_place out = {.heading = end, .curvature = piece->curvature, .turning = piece->turning};
    vec2 chord = {real_cos(heading), real_sin(heading)};
    if (piece->curvature == 0)
        chord = vec2_scale(chord, way);
    else
        chord = vec2_scale((vec2){real_sin(end) - chord.y, chord.x - real_cos(end)}, 1 / piece->curvature);
    out.at = vec2_add(from->at, chord);
    return out;
}

track track_of_bend(vec2 at, double heading, double curvature, double *way)
{
    track_piece piece = {curvature == 0 ? 1 : PI / fabs(curvature), curvature, false};
    const track_place middle = {at, heading, curvature, false};
    *way = 0.5 * piece.length;
    track_place start = along(&middle, &piece, -*way);
    track t = {.start = start.at, .heading = start.heading};
    add(&t, piece.length, curvature, false);
    return t;
}

track_place track_at(const track *t, double way)
{
    const track_piece straight = {HUGE_VAL, 0, false};
    track_place p = {t->start, t->heading, 0, false};
    if (t->closed)
        way -= t->length * floor(way / t->length);
    for (int32_t i = 0; i < t->count && way >= 0; i++) {
        if (way < t->piece[i].length)
            return along(&p, &t->piece[i], way);
        p = along(&p, &t->piece[i], t->piece[i].length);
        way -= t->piece[i].length;
    }
    return along(&p, &straight, way);
}

double track_turned(const track *t, double way)
{
    double sum = 0, rest = t->closed ? way - t->length * floor(way / t->length) : way, round = 0;
    for (int32_t i = 0; i < t->count; i++) {
        double length = t->piece[i].length;
        sum += t->piece[i].curvature * fmin(fmax(rest, 0), length);
        round += t->piece[i].curvature * length;
        rest -= length;
    }
    return t->closed ? sum + round * floor(way / t->length) : sum;
}

double track_off(const track_place *place, vec2 point)
{
    return vec2_cross((vec2){real_cos(place->heading), real_sin(place->heading)}, vec2_sub(point, place->at));
}

double track_foot(const track *t, double way, vec2 point)
{
    for (int i = 0; i < FOOT_STEPS; i++) {
        track_place p = track_at(t, way);
        vec2 from = vec2_sub(point, p.at);
        double ahead = vec2_dot((vec2){real_cos(p.heading), real_sin(p.heading)}, from);
        way += ahead / fmax(1 - p.curvature * track_off(&p, point), LEAST_FOOT_NEARNESS);
    }
    return t->closed ? way - t->length * floor(way / t->length) : way;
}

double track_join(const track *t, vec2 point, double heading, double weight)
{
    double best = 0, least = HUGE_VAL;
    for (int i = 0; i < JOIN_PLACES; i++) {
        double way = t->length * i / JOIN_PLACES;
        track_place p = track_at(t, way);
        double cost = vec2_length(vec2_sub(point, p.at)) + 0.5 * weight * (1 - real_cos(heading - p.heading));
        if (cost < least) {
            least = cost;
            best = way;
        }
    }
    return track_foot(t, best, point);
}
