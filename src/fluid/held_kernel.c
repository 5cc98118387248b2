#include "fluid/held_kernel.h"

#include "base/lanes.h"

/* Between a half and twice the held motion its drag is scaled; beyond, it is computed. */
#define LEAST_SCALE 0.5
#define MOST_SCALE 2.0

V8_INLINE lanes3 lanes3_of(const held_vectors *v) { return (lanes3){v8_load(v->x), v8_load(v->y), v8_load(v->z)}; }

/* Bodies for which the row holds something. */
static unsigned find_held(const body_table *b, const held_drag_table *held, int32_t row)
{
    unsigned lanes = 0;
    int32_t slot = HELD_LANES * row;
    for (int32_t i = 0; i < HELD_LANES && slot + i < b->count; i++) {
        uint32_t generation = held->generation[row].lane[i];
        if (generation != 0 && generation == b->generation[slot + i] && body_is_dynamic(b, slot + i))
            lanes |= 1u << i;
    }
    return lanes;
}

/* How the water plane lies on the floes, body axes: height at the axis and slopes. */
typedef struct waterline {
    v8 height, x, y;
} waterline;

V8_INLINE waterline waterline_of(const lanes33 *r, v8 height)
{
    v8 scale = -1 / r->m[2][2];
    return (waterline){height * scale, r->m[2][0] * scale, r->m[2][1] * scale};
}

/* Level for sure, and the waterline where it was. */
V8_INLINE v8_mask line_holds(const lanes33 *r, const waterline *now, const held_drag_table *held, int32_t row)
{
    const held_vectors *line = &held->line[row];
    v8 half = v8_load(held->half[row].lane), reach = v8_load(held->reach[row].lane);
    v8 highest = v8_abs(now->height) + reach * (v8_abs(now->x) + v8_abs(now->y));
    v8 change = v8_abs(now->height - v8_load(line->x)) +
                reach * (v8_abs(now->x - v8_load(line->y)) + v8_abs(now->y - v8_load(line->z)));
    return v8_less(v8_set(0), r->m[2][2]) & v8_less_equal(highest, half) & v8_less_equal(change, HELD_LINE * half);
}

/* Motion through one medium: velocity, and angular velocity times the outline's radius. */
typedef struct passage {
    lanes3 go, turn;
} passage;

V8_INLINE v8 size2(const passage *m) { return lanes3_dot(m->go, m->go) + lanes3_dot(m->turn, m->turn); }

/* now is almost scale times held, measured by a speed, the square of which is given; false where a number is none. */
V8_INLINE v8_mask motion_holds(const passage *now, const passage *held, v8 speed2, v8 still2, v8 *scale)
{
    v8 held2 = size2(held), along = lanes3_dot(now->go, held->go) + lanes3_dot(now->turn, held->turn);
    v8_mask moves = v8_less(still2, held2);
    v8 s = v8_select(moves, along / v8_select(moves, held2, v8_set(1)), v8_set(1));
    s = v8_min(v8_max(s, v8_set(LEAST_SCALE)), v8_set(MOST_SCALE));
    passage apart = {lanes3_mad(now->go, held->go, -s), lanes3_mad(now->turn, held->turn, -s)};
    *scale = s;
    return v8_less_equal(size2(&apart), v8_max(HELD_MOTION * HELD_MOTION * speed2, still2));
}

/* Adds held drag, in global axes. */
V8_INLINE void add_drag(const lanes33 *r, const held_vectors *force, const held_vectors *moment, v8 scale,
                        lanes3 sum[2])
{
    v8 square = scale * scale;
    sum[0] = lanes3_add(sum[0], lanes33_mul(r, lanes3_scale(lanes3_of(force), square)));
    sum[1] = lanes3_add(sum[1], lanes33_mul(r, lanes3_scale(lanes3_of(moment), square)));
}

/* As in level_kernel.c; returns the submerged volume. */
V8_INLINE v8 hydrostatics(const lanes33 *r, const waterline *line, const held_drag_table *held, int32_t row,
                          double weight, lanes3 sum[2])
{
    const held_moments *m = &held->moments[row];
    v8 area = v8_load(m->area), x = v8_load(m->x), y = v8_load(m->y);
    v8 xx = v8_load(m->xx), yy = v8_load(m->yy), xy = v8_load(m->xy), half = v8_load(held->half[row].lane);
    v8 h = line->height, s = line->x, t = line->y, depth = h + half;
    v8 volume = area * depth + (s * x + t * y);
    v8 squares = area * (h * h - half * half) + 2 * h * (s * x + t * y) + (s * s * xx + 2 * s * t * xy + t * t * yy);
    lanes3 first = {x * depth + (s * xx + t * xy), y * depth + (s * xy + t * yy), 0.5 * squares};
    v8 gx = r->m[0][0] * first.x + r->m[0][1] * first.y + r->m[0][2] * first.z;
    v8 gy = r->m[1][0] * first.x + r->m[1][1] * first.y + r->m[1][2] * first.z;
    sum[0] = (lanes3){v8_set(0), v8_set(0), weight * volume};
    sum[1] = (lanes3){weight * gy, -weight * gx, v8_set(0)};
    return volume;
}

static void put(const lanes3 sum[2], v8 volume, unsigned lanes, wrench *loads, double *volumes)
{
    double number[7][V8_LANES];
    for (int i = 0; i < 2; i++) {
        v8_store(number[3 * i], sum[i].x);
        v8_store(number[3 * i + 1], sum[i].y);
        v8_store(number[3 * i + 2], sum[i].z);
    }
    v8_store(number[6], volume);
    for (int i = 0; i < V8_LANES; i++) {
        if (!(lanes >> i & 1u))
            continue;
        loads[i].force = (vec3){number[0][i], number[1][i], number[2][i]};
        loads[i].moment = (vec3){number[3][i], number[4][i], number[5][i]};
        volumes[i] = number[6][i];
    }
}

unsigned KERNEL(held_loads)(const held_media *media, const body_table *bodies, const held_drag_table *held, int32_t row,
                            wrench *loads, double *volume)
{
    unsigned lanes = find_held(bodies, held, row);
    if (lanes == 0)
        return 0;
    int32_t slot = HELD_LANES * row;
    lanes33 r = lanes_quat_matrix(lanes_quat_pick(bodies->orientation + slot));
    waterline line = waterline_of(&r, lanes_pick(&bodies->position[slot].x, 3, 2));
    v8_mask holds = line_holds(&r, &line, held, row);

    v8 reach = v8_load(held->reach[row].lane), half = v8_load(held->half[row].lane);
    v8 still2 = (HELD_STILL * HELD_STILL * media->gravity) * half;
    v8 water_scale = v8_set(1), air_scale = v8_set(1);
    lanes3 velocity = lanes3_pick(bodies->velocity + slot);
    lanes3 turn = lanes3_scale(lanes33_tmul(&r, lanes3_pick(bodies->angular_velocity + slot)), reach);
    lanes3 held_turn = lanes3_scale(lanes3_of(&held->spin[row]), reach);
    lanes3 wind = {v8_set(media->wind.x), v8_set(media->wind.y), v8_set(media->wind.z)};
    passage water = {lanes33_tmul(&r, lanes3_sub(velocity, lanes3_of(&media->current))), turn};
    passage air = {lanes33_tmul(&r, lanes3_sub(velocity, wind)), turn};
    passage held_water = {lanes3_of(&held->through_water[row]), held_turn};
    passage held_air = {lanes3_of(&held->through_air[row]), held_turn};
    if (media->wet)
        holds &= motion_holds(&water, &held_water, size2(&water), still2, &water_scale);
    if (media->dry)
        holds &= motion_holds(&air, &held_air, v8_max(size2(&air), size2(&water)), still2, &air_scale);
    lanes &= v8_bits(holds);
    if (lanes == 0)
        return 0;

    lanes3 sum[2];
    v8 submerged = hydrostatics(&r, &line, held, row, media->weight, sum);
    if (media->wet)
        add_drag(&r, &held->water_force[row], &held->water_moment[row], water_scale, sum);
    if (media->dry)
        add_drag(&r, &held->air_force[row], &held->air_moment[row], air_scale, sum);
    put(sum, submerged, lanes, loads, volume);
    return lanes;
}
