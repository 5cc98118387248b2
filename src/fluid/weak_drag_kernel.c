#include "fluid/weak_drag_kernel.h"

#include "base/lanes.h"

/* Zero in lanes that hold no dynamic prism. */
typedef struct eight_prisms {
    unsigned lanes;
    double form[V8_LANES], skin[V8_LANES], area[V8_LANES], radius[V8_LANES], half[V8_LANES];
} eight_prisms;

static void find_prisms(const drag_limits *limits, const body_table *b, const shape_table *s, int32_t slot,
                        eight_prisms *p)
{
    *p = (eight_prisms){0};
    for (int32_t i = 0; i < V8_LANES && slot + i < b->count; i++) {
        int32_t shape = b->shape[slot + i];
        if (!body_is_dynamic(b, slot + i) || shape < 0 || s->kind[shape] != SHAPE_PRISM)
            continue;
        p->lanes |= 1u << i;
        p->form[i] = limits->form[b->material[slot + i]];
        p->skin[i] = limits->skin[b->material[slot + i]];
        p->area[i] = s->area[shape];
        p->radius[i] = s->plan_radius[shape];
        p->half[i] = s->half_height[shape];
    }
}

V8_INLINE v8 one_norm(lanes3 a) { return v8_abs(a.x) + v8_abs(a.y) + v8_abs(a.z); }

/* The bound of response.c with one speed for all directions, that of the fastest point or more. */
unsigned KERNEL(weak_drag)(const drag_limits *limits, const body_table *bodies, const shape_table *shapes,
                           int32_t group)
{
    int32_t slot = V8_LANES * group;
    eight_prisms p;
    find_prisms(limits, bodies, shapes, slot, &p);
    v8 area = v8_load(p.area), r = v8_load(p.radius), h = v8_load(p.half);
    lanes3 current = {v8_set(limits->current.x), v8_set(limits->current.y), v8_set(limits->current.z)};
    v8 speed = one_norm(lanes3_sub(lanes3_pick(bodies->velocity + slot), current)) +
               r * one_norm(lanes3_pick(bodies->angular_velocity + slot));
    v8 form = v8_load(p.form) * speed, skin = v8_load(p.skin) * (2 * speed), side = 4 * r * h;
    v8 push = form * side, rub = skin * (2 * area + 4 * side), flat = push + rub;
    v8 heave = form * area + skin * (4 * side);
    v8 tilt = r * r * (1.0 / 3) * heave + h * h * flat, yaw = r * r * ((1.0 / 3) * push + 0.5 * rub);
    const sym3 *inertia = bodies->inertia + slot;
    v8 about_x = lanes_pick(&inertia->xx, 6, 0), about_y = lanes_pick(&inertia->xx, 6, 1);
    v8 about_z = lanes_pick(&inertia->xx, 6, 2);
    v8_mask weak = v8_less(v8_max(flat, heave), limits->rate * v8_load(bodies->mass + slot)) &
                   v8_less(tilt, limits->rate * v8_min(about_x, about_y)) & v8_less(yaw, limits->rate * about_z);
    return v8_bits(weak) & p.lanes;
}
