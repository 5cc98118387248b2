/* Warm start without gain of energy.  Each sweep lowers f(p) = p.A p / 2 + b.p, A = J M^-1 J^T and b the rows'
   velocities without impulses: the kinetic energy that impulses give, up to what open gaps add.  From p = 0 the result
   therefore never has more energy than the bodies had.  From the impulses p0 of the last step that holds while f(p0) <=
   0, which a blow of the last step breaks: so p0 is scaled, island by island, by the largest share in [0, 1] with
   f(share p0) <= 0. */
#include "dynamics/solver_rows.h"

int32_t island_leader(int32_t *parent, int32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

static bool is_movable(const solver *s, int32_t place) { return solver_body_is_movable(&s->bodies.data[place]); }

void island_join(int32_t *parent, int32_t i, int32_t j)
{
    int32_t x = island_leader(parent, i), y = island_leader(parent, j);
    parent[x > y ? x : y] = x < y ? x : y;
}

static void join(solver *s, int32_t a, int32_t b)
{
    if (is_movable(s, a) && is_movable(s, b))
        island_join(s->island.data, a, b);
}

static int32_t leader(solver *s, int32_t a, int32_t b)
{
    return island_leader(s->island.data, is_movable(s, a) ? a : b);
}

static bool find_islands(solver *s)
{
    if (!array_resize(s->ctx, &s->island, s->bodies.count) || !array_resize(s->ctx, &s->gain, s->bodies.count))
        return false;
    for (int32_t i = 0; i < s->bodies.count; i++) {
        s->island.data[i] = i;
        s->gain.data[i] = (energy_gain){0, 0};
    }
    for (int32_t i = 0; i < s->contacts.count; i++)
        join(s, s->contacts.data[i].a, s->contacts.data[i].b);
    for (int32_t i = 0; i < s->joints.count; i++)
        join(s, s->joints.data[i].body, s->joints.data[i].base);
    return true;
}

/* p . (velocities - wanted ones) of a contact, of a joint. */
static double contact_work(const solver *s, const contact_row *row)
{
    const solver_body *a = &s->bodies.data[row->a], *b = &s->bodies.data[row->b];
    double sum = -row->impulse[0] * row->bias;
    for (int k = 0; k < 3; k++)
        sum += row->impulse[k] * row_axis_velocity(&row->axis[k], a, b);
    return sum;
}

double joint_row_work(const solver *s, const joint_block *j)
{
    double sum = 0;
    for (int r = 0; r < j->count; r++)
        sum += j->impulse[r] *
               (row_axis_velocity(&j->axis[r], &s->bodies.data[j->body], &s->bodies.data[j->base]) + j->bias[r]);
    return sum;
}

static void push_contact(solver *s, const contact_row *row, double share)
{
    for (int k = 0; k < 3; k++)
        row_axis_push(&row->axis[k], &s->bodies.data[row->a], &s->bodies.data[row->b], share * row->impulse[k]);
}

void joint_row_push(solver *s, const joint_block *j, double share)
{
    for (int r = 0; r < j->count; r++)
        row_axis_push(&j->axis[r], &s->bodies.data[j->body], &s->bodies.data[j->base], share * j->impulse[r]);
}

/* Linear and quadratic part of f along p0, the latter doubled, of each island; afterwards p0 is applied. */
static void apply_and_weigh(solver *s)
{
    energy_gain *gain = s->gain.data;
    for (int32_t i = 0; i < s->contacts.count; i++)
        gain[leader(s, s->contacts.data[i].a, s->contacts.data[i].b)].linear += contact_work(s, &s->contacts.data[i]);
    for (int32_t i = 0; i < s->joints.count; i++)
        gain[leader(s, s->joints.data[i].body, s->joints.data[i].base)].linear += joint_row_work(s, &s->joints.data[i]);
    for (int32_t i = 0; i < s->contacts.count; i++)
        push_contact(s, &s->contacts.data[i], 1);
    for (int32_t i = 0; i < s->joints.count; i++)
        joint_row_push(s, &s->joints.data[i], 1);
    for (int32_t i = 0; i < s->contacts.count; i++)
        gain[leader(s, s->contacts.data[i].a, s->contacts.data[i].b)].square += contact_work(s, &s->contacts.data[i]);
    for (int32_t i = 0; i < s->joints.count; i++) {
        const joint_block *j = &s->joints.data[i];
        energy_gain *g = &gain[leader(s, j->body, j->base)];
        g->square += joint_row_work(s, j);
        for (int r = 0; r < j->count; r++)
            g->square += j->softness * j->impulse[r] * j->impulse[r];
    }
    for (int32_t i = 0; i < s->bodies.count; i++)
        gain[i].square -= gain[i].linear;
}

double energy_share(energy_gain g)
{
    if (g.linear + 0.5 * g.square <= 0)
        return 1;
    return g.linear < 0 ? -2 * g.linear / g.square : 0;
}

bool solver_warm_start(solver *s)
{
    if (!find_islands(s))
        return false;
    apply_and_weigh(s);
    for (int32_t i = 0; i < s->contacts.count; i++) {
        contact_row *row = &s->contacts.data[i];
        double share = energy_share(s->gain.data[leader(s, row->a, row->b)]);
        if (share == 1)
            continue;
        push_contact(s, row, share - 1);
        for (int k = 0; k < 3; k++)
            row->impulse[k] *= share;
    }
    for (int32_t i = 0; i < s->joints.count; i++) {
        joint_block *j = &s->joints.data[i];
        double share = energy_share(s->gain.data[leader(s, j->body, j->base)]);
        if (share == 1)
            continue;
        joint_row_push(s, j, share - 1);
        for (int r = 0; r < j->count; r++)
            j->impulse[r] *= share;
    }
    return true;
}
