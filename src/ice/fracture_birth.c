/* From cut outlines to new floes : cleaning, poses and velocities of the children, books. */
#include "ice/fracture_parts.h"

#include "base/transcendental.h"

#include <assert.h>

/* What the children inherit, copied before the parent goes. */
typedef struct parent {
    floe_definition definition; /* outline and motion to be set */
    uint8_t motion;
    vec3 position, velocity, angular_velocity;
    quat orientation;
    mat3 rotation;
} parent;

/* What one birth works on. */
typedef struct birth {
    const fracture_job *job;
    parent from;
    fracture_event *event;
    const edge_bend *bends;
    body_books before, after; /* of the parents and of the pieces */
} birth;

/* The tiles of a sheet break in the global plan: level and unturned. */
static parent parent_of(const fracture_job *j, int32_t floe)
{
    const body_table *b = j->state->bodies;
    const floe_table *f = j->state->floes;
    int32_t body = f->body[floe];
    bool tile = f->tile[floe] != 0;
    parent p = {.definition = {.thickness = f->thickness[floe],
                               .material = f->material[floe],
                               .breakable = f->breakable[floe] != 0,
                               .parent = f->number[floe],
                               .ice_origin = f->ice_origin[floe],
                               .ice_yaw = f->ice_yaw[floe]},
                .motion = b->motion[body],
                .position = b->position[body],
                .velocity = b->velocity[body],
                .angular_velocity = b->angular_velocity[body],
                .orientation = b->orientation[body],
                .rotation = quat_matrix(b->orientation[body])};
    if (!tile)
        return p;
    p.definition.ice_origin = vec2_sub(p.definition.ice_origin, vec2_make(p.position.x, p.position.y));
    p.position.x = p.position.y = 0;
    return p;
}

/* How a piece comes off an edge that gave, in the parent's frame, in which it lies flat until then. */
typedef struct bent_piece {
    quat turn;
    double rise;  /* of its centre [m] */
    double climb; /* of its centre [m/s] */
    vec3 spin;    /* [rad/s] */
} bent_piece;

/* Turns a piece about where it broke off until it stands at the load as the edge stood, and lets it turn on as the edge
   went: the ice keeps its place and its motion as it breaks, and the hull does not meet it anew. */
static bent_piece keep_bent(const edge_bend *bend, vec3 place)
{
    bent_piece flat = {.turn = quat_identity()};
    vec2 d = bend->start.direction, along = {-d.y, d.x}, centre = {place.x, place.y};
    double half = bend->size.width / 2, at = vec2_dot(vec2_sub(centre, bend->start.point), along);
    bool strip = half > 0 && fabs(at) < half;
    double length = strip ? bend->size.strip_length : bend->size.radius;
    vec2 tip = vec2_add(bend->start.point, vec2_scale(along, fmin(fmax(at, -half), half)));
    vec2 out = strip ? d : vec2_sub(centre, tip);
    double away = strip ? vec2_dot(vec2_sub(centre, tip), d) : vec2_length(out);
    if (!(away > 0 && away < length) || bend->rise == 0)
        return flat;
    out = vec2_scale(out, 1 / vec2_length(out));
    double half_angle = bend->rise / length / 2, spin = bend->rate / length, left = 1 - away / length;
    return (bent_piece){.turn = {real_cos(half_angle), -out.y * real_sin(half_angle), out.x * real_sin(half_angle), 0},
                        .rise = bend->rise * left,
                        .climb = bend->rate * left,
                        .spin = {-out.y * spin, out.x * spin, 0}};
}

/* The floe was made at its centroid with no turn, in the parent's frame; it goes to where its ice is, and moves as that
   ice moved: v_new = v_old + Omega x (r_new - r_old). */
static void place_child(const birth *b, int32_t body, const edge_bend *bend)
{
    body_table *bodies = b->job->state->bodies;
    vec3 place = bodies->position[body];
    bent_piece bent = bend ? keep_bent(bend, place) : (bent_piece){.turn = quat_identity()};
    place.z += bent.rise;
    vec3 arm = mat3_mul_vec(b->from.rotation, place);
    bodies->position[body] = vec3_add(b->from.position, arm);
    bodies->orientation[body] = quat_mul(b->from.orientation, bent.turn);
    if (bodies->motion[body] == MOTION_STATIC)
        return;
    vec3 climb = vec3_scale(mat3_column(b->from.rotation, 2), bent.climb);
    bodies->velocity[body] = vec3_add(vec3_add(b->from.velocity, climb), vec3_cross(b->from.angular_velocity, arm));
    bodies->angular_velocity[body] = vec3_add(b->from.angular_velocity, mat3_mul_vec(b->from.rotation, bent.spin));
}

/* *made is false when no floe can be made of the outline after all, which was tried: rounding as it is moved.  That is
   booked as lost. */
static fram_status make_floe(birth *b, polygon outline, const cut_piece *piece, bool *made)
{
    const fracture_job *j = b->job;
    const fracture_state *to = j->state;
    floe_definition d = b->from.definition;
    int32_t row;
    assert(polygon_area(outline) > 0 && !polygon_self_intersects(j->ctx, outline, NULL, NULL));
    d.outline = outline;
    d.motion = (motion)piece->motion;
    d.tile = piece->motion == MOTION_DYNAMIC ? 0 : piece->tile;
    fram_status status = floe_create(j->ctx, &d, j->settings->smallest_piece_area, j->plane, to->bodies, to->shapes,
                                     to->floes, to->next_number, &row, j->error);
    *made = status == FRAM_OK;
    if (status == FRAM_ERROR_INPUT || status == FRAM_ERROR_INTERNAL) {
        log_write(j->ctx, LOG_DEBUG, "a piece could not be made: %s", j->error ? j->error->message : "");
        return FRAM_OK;
    }
    if (status != FRAM_OK)
        return status;
    place_child(b, to->floes->body[row], piece->wedge && b->bends ? &b->bends[piece->bend] : NULL);
    body_books_add(to->bodies, to->floes->body[row], &b->after);
    b->event->pieces++;
    b->event->piece_area += to->floes->area[row];
    return FRAM_OK;
}

static void book(const birth *b, double before, double after)
{
    if (before >= after)
        b->event->area_lost += before - after;
    else
        b->event->area_gained += after - before;
}

/* Booked area may be at most this part of the parent (docs/level_ice.md, Books). */
static const double MOST_BOOKED = 1e-3;
/* Cleaning that would book more is repeated with half the edge, so often; then all of that without spikes. */
enum { FINER_CLEANINGS = 4 };

/* How a piece is cleaned, from the coarsest to the finest; its last ways leave spikes as they are. */
typedef struct cleaning_way {
    double edge; /* [m] */
    bool spikes_stay;
} cleaning_way;

static cleaning_way way_of(const fracture_job *j, int turn)
{
    int halvings = turn % (FINER_CLEANINGS + 1);
    return (cleaning_way){j->settings->edge_threshold / (1 << halvings), turn > FINER_CLEANINGS};
}

/* What is on the sides of a tile's cell stays there: the neighbours fit to it. */
static bool clean_piece(const fracture_job *j, const cut_piece *piece, polygon ring, cleaning_way way)
{
    vec2_array *clean = &j->scratch->piece.clean;
    bool tile = piece->tile != 0 && piece->motion != MOTION_DYNAMIC;
    box2 cell = tile ? tile_cell(&j->settings->tiles, piece->tile - 1) : (box2){0};
    if (way.spikes_stay)
        return polygon_merge(j->ctx, ring, way.edge, tile ? &cell : NULL, clean);
    return tile ? polygon_clean_inside(j->ctx, ring, way.edge, cell, clean)
                : polygon_clean(j->ctx, ring, way.edge, clean);
}

/* The piece's outline cleaned as far as the budget of booked area [m2] allows, itself where nothing does, in *out;
   without vertices when none is sound.  false: no memory. */
static bool clean_within(const fracture_job *j, const cut_piece *piece, double budget, polygon *out)
{
    polygon ring = polygon_list_get(&j->scratch->piece.outlines, piece->ring);
    double area = polygon_area(ring);
    for (int turn = 0; turn < 2 * (FINER_CLEANINGS + 1); turn++) {
        if (!clean_piece(j, piece, ring, way_of(j, turn)))
            return false;
        *out = (polygon){j->scratch->piece.clean.data, j->scratch->piece.clean.count};
        double after = polygon_area(*out);
        if (fabs(after - area) <= budget && after >= fmin(area, j->settings->smallest_floe_area) &&
            fracture_outline_is_sound(j->ctx, *out))
            return true;
    }
    *out = fracture_outline_is_sound(j->ctx, ring) ? ring : (polygon){0};
    return true;
}

fram_status fracture_has_parts(const fracture_job *j, polygon ring, bool *has)
{
    polygon_list *parts = &j->scratch->piece.parts;
    *has = true;
    if (polygon_is_convex(ring))
        return FRAM_OK;
    polygon_list_clear(parts);
    fram_status status = overlay_convex_pieces(j->plane, ring, j->settings->smallest_piece_area, PIECE_MOST_VERTICES,
                                               parts, NULL, j->error);
    *has = status == FRAM_OK && polygon_list_count(parts) > 0;
    return status == FRAM_ERROR_MEMORY ? status : FRAM_OK;
}

fram_status fracture_is_dust(const fracture_job *j, const cut_piece *piece, polygon ring, bool *dust)
{
    const fracture_settings *f = j->settings;
    bool tile = piece->motion != MOTION_DYNAMIC && piece->tile != 0, has;
    *dust = piece->area < (tile ? f->smallest_piece_area : f->smallest_floe_area) ||
            (tile && piece->area < f->smallest_floe_area &&
             !(tile_side_length(&f->tiles, piece->tile - 1, ring) > f->tiles.least_seam));
    /* A ring is cut into two triangles less than it has corners: one of them is large enough. */
    if (*dust || piece->area >= (ring.count - 2) * f->smallest_piece_area)
        return FRAM_OK;
    fram_status status = fracture_has_parts(j, ring, &has);
    *dust = !has;
    return status;
}

static fram_status row_is_dust(const fracture_job *j, int32_t i, bool *dust)
{
    const cut_piece *c = &j->scratch->piece.rows.data[i];
    return fracture_is_dust(j, c, polygon_list_get(&j->scratch->piece.outlines, c->ring), dust);
}

/* Area of the pieces that no sibling took: they will be lost [m2]. */
static fram_status dust_of(const fracture_job *j, double *area)
{
    *area = 0;
    for (int32_t i = 0; i < j->scratch->piece.rows.count; i++) {
        bool dust;
        fram_status status = row_is_dust(j, i, &dust);
        if (status != FRAM_OK)
            return status;
        if (dust)
            *area += j->scratch->piece.rows.data[i].area;
    }
    return FRAM_OK;
}

/* All pieces cleaned, within the budget together; *sound is false when one cannot be, or cannot be cut into convex
   parts.  Dust is left for the books. */
static fram_status clean_pieces(const fracture_job *j, double budget, bool *sound)
{
    fracture_scratch *s = j->scratch;
    *sound = true;
    for (int32_t i = 0; i < s->piece.rows.count && *sound; i++) {
        cut_piece *c = &s->piece.rows.data[i];
        bool dust;
        polygon outline;
        fram_status status = row_is_dust(j, i, &dust);
        if (status != FRAM_OK)
            return status;
        if (dust)
            continue;
        if (!clean_within(j, c, fmax(budget, 0) / (s->piece.rows.count - i), &outline))
            return error_memory(j->error);
        *sound = outline.count > 0;
        if (*sound)
            status = fracture_has_parts(j, outline, sound);
        if (status != FRAM_OK || !*sound)
            return status;
        budget -= fabs(polygon_area(outline) - c->area);
        c->ring = polygon_list_count(&s->piece.outlines);
        if (!polygon_list_push(j->ctx, &s->piece.outlines, outline))
            return error_memory(j->error);
    }
    return FRAM_OK;
}

motion fracture_motion(const fracture_job *j, int32_t floe)
{
    const body_table *b = j->state->bodies;
    int32_t body = j->state->floes->body[floe];
    return body_is_free(b, body) ? MOTION_DYNAMIC : (motion)b->motion[body];
}

bool fracture_gather(context *ctx, fracture_scratch *s, const polygon_list *rings, motion kind, int32_t tile,
                     int32_t wedge)
{
    for (int32_t i = 0; i < polygon_list_count(rings); i++) {
        polygon ring = polygon_list_get(rings, i);
        cut_piece piece = {polygon_list_count(&s->piece.outlines), (uint8_t)kind, tile, wedge, polygon_area(ring), 0};
        if (!polygon_list_push(ctx, &s->piece.outlines, ring) || !array_push(ctx, &s->piece.rows, piece))
            return false;
    }
    return true;
}

#ifndef NDEBUG
/* Area of what was cut out is that of the floes made of it and what is booked, but for this part of the parents':
   rounding of areas far from the origin.  What tiles lost as they became one floe is booked before, and what was
   trimmed away as crushed elsewhere. */
static const double AREA_ROUNDING = 1e-8;
#endif

/* Ice that breaks off what is held or carried keeps the velocity that it had: lost is only what the lost ice took. */
static void book_momentum(const birth *b)
{
    if (b->from.motion != MOTION_DYNAMIC) {
        b->event->momentum_lost = vec3_scale(b->from.velocity, b->event->mass_lost - b->event->mass_gained);
        b->event->angular_momentum_lost = vec3_cross(b->event->place, b->event->momentum_lost);
        return;
    }
    b->event->momentum_lost = vec3_sub(b->before.momentum, b->after.momentum);
    b->event->angular_momentum_lost = vec3_sub(b->before.angular_momentum, b->after.angular_momentum);
}

static fram_status make_pieces(birth *b)
{
    const fracture_job *j = b->job;
    fram_status status = FRAM_OK;
    double cut = b->event->area_lost - b->event->area_gained;
    for (int32_t i = 0; i < j->scratch->piece.rows.count && status == FRAM_OK; i++) {
        const cut_piece *c = &j->scratch->piece.rows.data[i];
        cut += c->area;
        polygon outline = polygon_list_get(&j->scratch->piece.outlines, c->ring);
        bool dust, made = false;
        status = row_is_dust(j, i, &dust);
        if (status == FRAM_OK && !dust)
            status = make_floe(b, outline, c, &made);
        book(b, c->area, made ? polygon_area(outline) : 0);
    }
    assert(status != FRAM_OK || fabs(cut - b->event->piece_area - b->event->area_lost + b->event->area_gained) <=
                                    AREA_ROUNDING * b->event->parent_area);
    (void)cut;
    double line = b->from.definition.material.density * b->from.definition.thickness;
    b->event->mass_lost = line * b->event->area_lost;
    b->event->mass_gained = line * b->event->area_gained;
    book_momentum(b);
    return status;
}

/* The bodies of these floes broke in this step. */
static void mark_broken(const fracture_job *j, const int32_t *floes, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        int32_t body = j->state->floes->body[floes[i]];
        if (body < j->scratch->broken.count)
            j->scratch->broken.data[body] = 1;
    }
}

/* The ice stays whole in this step. */
static fram_status put_off(const fracture_job *j, const char *why)
{
    log_write(j->ctx, LOG_DEBUG, "a break is put off: %s", why);
    return FRAM_OK;
}

fram_status fracture_birth(const fracture_job *j, const int32_t *parents, int32_t count, birth_terms terms,
                           fracture_event *event, bool *broke)
{
    fracture_scratch *s = j->scratch;
    birth b = {.job = j, .from = parent_of(j, parents[0]), .event = event, .bends = terms.bends};
    *broke = false;
    double parent_area = 0;
    for (int32_t i = 0; i < count; i++)
        parent_area += j->state->floes->area[parents[i]];
    double dust = 0;
    fram_status status = fracture_join_dust(j);
    if (status == FRAM_OK)
        status = dust_of(j, &dust);
    double budget = fmin(MOST_BOOKED * parent_area, terms.most) - dust;
    if (status != FRAM_OK)
        return status;
    if (s->piece.rows.count < terms.least)
        return put_off(j, "its pieces are too small to be floes, and one with what they lie against");
    /* What comes loose may be dust itself: nothing holds it. */
    if (budget < 0 && terms.least > 1)
        return put_off(j, "more of it is too small to be floes than may be lost");
    bool sound;
    status = clean_pieces(j, budget, &sound);
    if (status != FRAM_OK)
        return status;
    if (!sound)
        return put_off(j, "no floes can be made of its outlines");
    *broke = true;
    mark_broken(j, parents, count);
    event->floe = b.from.definition.parent;
    event->first_piece = *j->state->next_number;
    event->parent_area = parent_area;
    for (int32_t i = 0; i < count; i++)
        body_books_add(j->state->bodies, j->state->floes->body[parents[i]], &b.before);
    for (int32_t i = 0; i < count; i++)
        floe_remove(j->state->bodies, j->state->shapes, j->state->floes, parents[i]);
    return make_pieces(&b);
}
