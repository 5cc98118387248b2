/* How a drifting sheet moves; see drift.h. */
#include "ice/drift_parts.h"

#include <math.h>

#define TABLE_SELF drift_table
TABLE_DEFINE(drift, DRIFT_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF drift_cell_table
TABLE_DEFINE(drift_cell, DRIFT_CELL_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF drift_vertex_table
TABLE_DEFINE(drift_vertex, DRIFT_VERTEX_FIELDS)
#undef TABLE_SELF

/* Ways are multiples of 1/QUANTA m: exact in a double up to 1000 km from the origin, and 2e-10 m, far below what moves
   anything. */
static const double QUANTA = 4294967296.0;

static double whole_quanta(double x) { return floor(x * QUANTA + 0.5) / QUANTA; }

tile_grid drift_grid(const tile_grid *start, const drift_table *drift)
{
    tile_grid g = *start;
    if (drift->count == 0)
        return g;
    g.moved = drift->moved[0];
    g.column = drift->column[0];
    g.row = drift->row[0];
    g.plan = tile_grid_plan(&g);
    return g;
}

double drift_tile_mass(const drift_world *w)
{
    double sum = 0;
    for (int32_t i = 0; i < w->floes->count; i++)
        if (w->floes->body[i] >= 0 && w->floes->tile[i] != 0)
            sum += w->bodies->mass[w->floes->body[i]];
    return sum;
}

/* ---- a step ---- */

/* Metres of the window across a direction. */
static double width_across(box2 window, vec2 along)
{
    vec2 size = vec2_sub(window.hi, window.lo);
    double length = vec2_length(along);
    return (fabs(along.x) * size.y + fabs(along.y) * size.x) / length;
}

/* What the ice far away drives with: all that is wanted, or the most that it can. */
static vec2 drive_of(const drift_definition *d, vec2 wanted)
{
    double size = vec2_length(wanted);
    if (!(size > 0))
        return (vec2){0, 0};
    double most = d->line_load * width_across(d->window, wanted);
    return size <= most ? wanted : vec2_scale(wanted, most / size);
}

static void set_velocity(const drift_world *w, double dt)
{
    vec2 v = vec2_scale(w->drift->way[0], 1 / dt);
    for (int32_t i = 0; i < w->floes->count; i++)
        if (w->floes->body[i] >= 0 && w->floes->tile[i] != 0)
            w->bodies->velocity[w->floes->body[i]] = vec3_make(v.x, v.y, 0);
}

void drift_drive(const drift_world *w, vec2 far, vec2 fluid, double dt)
{
    drift_table *t = w->drift;
    if (t->count == 0)
        return;
    if (isfinite(w->definition->line_load)) {
        vec2 other = vec2_add(t->load[0], fluid);
        vec2 gain = vec2_scale(vec2_sub(far, t->velocity[0]), t->mass[0] / dt);
        t->drive[0] = drive_of(w->definition, vec2_sub(gain, other));
        t->fluid[0] = fluid;
        vec2 change = vec2_scale(vec2_add(other, t->drive[0]), dt / t->mass[0]);
        t->velocity[0] = vec2_add(t->velocity[0], change);
    } else {
        t->velocity[0] = far;
    }
    vec2 way = vec2_add(vec2_scale(t->velocity[0], dt), t->rest[0]);
    t->way[0] = vec2_make(whole_quanta(way.x), whole_quanta(way.y));
    t->rest[0] = vec2_sub(way, t->way[0]);
    set_velocity(w, dt);
}

void drift_load(const drift_world *w, const contact_array *contacts, double dt)
{
    if (w->drift->count == 0)
        return;
    vec3 sum = {0, 0, 0};
    for (int32_t i = 0; i < contacts->count; i++) {
        const contact *c = &contacts->data[i];
        if (w->bodies->motion[c->a] == MOTION_CARRIED)
            sum = vec3_add(sum, contact_impulse(c));
        if (w->bodies->motion[c->b] == MOTION_CARRIED)
            sum = vec3_sub(sum, contact_impulse(c));
    }
    w->drift->load[0] = vec2_make(sum.x / dt, sum.y / dt);
}

/* Of its mass at the start: what a floe that has broken up goes on with, so that forces still divide by it. */
static const double LEAST_MASS = 1e-3;

/* Where the ice far away drives with whatever is needed, the mass decides nothing: it is that of the tiles at least. */
static double least_mass(const drift_definition *d, double tiles)
{
    return isfinite(d->line_load) ? LEAST_MASS * d->mass : tiles;
}

/* What broke off since the last step took its share of the momentum with it. */
static void book_broken(const drift_world *w)
{
    drift_table *t = w->drift;
    double now = drift_tile_mass(w), broken = t->ice[0] - now;
    t->broken[0] += broken;
    if (w->definition->bounded)
        t->mass[0] = fmax(t->mass[0] - broken, least_mass(w->definition, now));
    t->ice[0] = now;
}

fram_status drift_step(context *ctx, overlay *plane, const drift_world *w, fram_error *error)
{
    drift_table *t = w->drift;
    if (t->count == 0)
        return FRAM_OK;
    t->moved[0] = vec2_add(t->moved[0], t->way[0]);
    book_broken(w);
    fram_status status = drift_shift(ctx, plane, w, error);
    t->ice[0] = drift_tile_mass(w);
    return status;
}

fram_status drift_begin(context *ctx, const drift_world *w, vec2 velocity, fram_error *error)
{
    drift_table *t = w->drift;
    if (!table_resize(ctx, t, &drift_table_info, 1))
        return error_memory(error);
    t->velocity[0] = velocity;
    t->column[0] = w->start->column;
    t->row[0] = w->start->row;
    t->ice[0] = drift_tile_mass(w);
    t->mass[0] = fmax(w->definition->mass, least_mass(w->definition, t->ice[0]));
    for (int32_t i = 0; i < w->floes->count; i++)
        if (w->floes->body[i] >= 0 && w->floes->tile[i] != 0)
            w->bodies->velocity[w->floes->body[i]] = vec3_make(velocity.x, velocity.y, 0);
    return FRAM_OK;
}
