/* Swaps of squeezed floes with others that are a little smaller, wherever these lie: an exchange of places moves room
   through a jammed field at once, which pushing takes ever longer to do (swap Monte Carlo, Berthier et al. 2016, Phys.
   Rev. Lett. 116, 238002).  A squeezed floe is first turned where it is. */
#include "ice/packing_work.h"

#include "base/random.h"
#include "base/transcendental.h"

/* A floe is turned where it is if that leaves less than this part of its overlap. */
static const double TURN_GAIN = 0.8;
/* Two floes swap if that leaves less than this part of the overlaps of both, each over its floe's size: a little worse
   is good enough, so that the field does not come to rest. */
static const double SWAP_GAIN = 1.2;
/* The smaller floe of a swap is no less than this part of the larger. */
static const double LEAST_RATIO = 0.7;
/* Partners that are drawn for a floe; most are of another size. */
enum { DRAWS = 30 };
/* Floes that swap are farther apart than this many times the sum of their radii: neither is in the other's way. */
static const double APART = 2;

static double over_size(const pack_layout *l, const pack_contacts *c, int32_t body)
{
    return c->squeeze.data[body] / l->bodies.data[body].size;
}

/* Turns a floe where it is to where it fits better. */
static bool try_turn(pack_work *w, int32_t body, double first, const int32_array *carried)
{
    pack_body *b = &w->layout.bodies.data[body], old = *b;
    double bound = TURN_GAIN * w->contacts.squeeze.data[body], depth = pack_turn_best(w, body, first, bound, carried);
    if (depth < bound) {
        w->contacts.squeeze.data[body] = depth;
        return true;
    }
    *b = old;
    pack_place_body(&w->layout, body);
    return false;
}

static bool may_swap(const pack_work *w, int32_t large, int32_t small)
{
    const pack_body *a = &w->layout.bodies.data[large], *b = &w->layout.bodies.data[small];
    if (small == large || b->size > a->size || b->size < LEAST_RATIO * a->size)
        return false;
    vec2 way = vec2_add(vec2_sub(b->centre, a->centre), pack_image_shift(w, a->centre, b->centre));
    return vec2_length(way) > APART * w->layout.scale * (a->radius + b->radius);
}

/* Each at the other's place, at the angles that fit best, if that is good enough. */
static bool try_swap(pack_work *w, int32_t i, int32_t k, const double first[2], const int32_array *carried)
{
    pack_body *a = &w->layout.bodies.data[i], *b = &w->layout.bodies.data[k], old_a = *a, old_b = *b;
    double bound = SWAP_GAIN * (over_size(&w->layout, &w->contacts, i) + over_size(&w->layout, &w->contacts, k));
    a->centre = old_b.centre;
    b->centre = old_a.centre;
    pack_place_body(&w->layout, k); /* out of the way */
    double depth_a = pack_turn_best(w, i, first[0], bound * a->size, carried);
    if (depth_a < bound * a->size) {
        double left = (bound - depth_a / a->size) * b->size, depth_b = pack_turn_best(w, k, first[1], left, carried);
        if (depth_b < left) {
            w->contacts.squeeze.data[i] = depth_a;
            w->contacts.squeeze.data[k] = depth_b;
            return true;
        }
    }
    *a = old_a;
    *b = old_b;
    pack_place_body(&w->layout, i);
    pack_place_body(&w->layout, k);
    return false;
}

bool pack_swap_squeezed(pack_work *w, int32_t body, int32_array *carried)
{
    random_stream r = random_begin(w->seed, PACK_STREAM_SWAP, (uint32_t)body);
    r.counter = (uint64_t)w->round * (1 + 3 * DRAWS);
    if (try_turn(w, body, 2 * PI * random_unit(&r), carried))
        return array_push(w->ctx, carried, body);
    for (int n = 0; n < DRAWS; n++) {
        int32_t other = (int32_t)(random_unit(&r) * w->layout.movable);
        double first_a = 2 * PI * random_unit(&r), first_b = 2 * PI * random_unit(&r);
        const double first[2] = {first_a, first_b};
        if (may_swap(w, body, other) && try_swap(w, body, other, first, carried))
            return array_push(w->ctx, carried, body) && array_push(w->ctx, carried, other);
    }
    return true;
}
