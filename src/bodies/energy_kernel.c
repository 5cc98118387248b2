/* See energy_kernel.h.  Each lane holds the bits that kinetic_energy of body.c gives; the sum goes slot by slot. */
#include "bodies/energy_kernel.h"

#include "base/lanes.h"

/* Of eight slots, whatever stands in them. */
V8_INLINE v8 energies(const body_table *b, int32_t slot)
{
    lanes3 velocity = lanes3_pick(b->velocity + slot);
    lanes33 r = lanes_quat_matrix(lanes_quat_pick(b->orientation + slot));
    lanes3 spin = lanes33_tmul(&r, lanes3_pick(b->angular_velocity + slot));
    lanes3 momentum = lanes3_scale(velocity, v8_load(b->mass + slot));
    v8 inertia[6];
    lanes_sym3_pick(b->inertia + slot, inertia);
    return 0.5 * (lanes3_dot(momentum, velocity) + lanes3_dot(lanes_sym3_mul(inertia, spin), spin));
}

double KERNEL(energy_sum)(const body_table *bodies)
{
    double sum = 0;
    for (int32_t slot = 0; slot < bodies->count; slot += V8_LANES) {
        int32_t end = slot + V8_LANES < bodies->count ? slot + V8_LANES : bodies->count;
        if (body_slots_stand(bodies, slot, end))
            continue;
        double energy[V8_LANES];
        v8_store(energy, energies(bodies, slot));
        for (int32_t i = 0; i < V8_LANES && slot + i < bodies->count; i++)
            sum += body_is_free(bodies, slot + i) ? energy[i] : 0;
    }
    return sum;
}
