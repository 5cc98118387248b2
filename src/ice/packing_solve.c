/* Projected Gauss-Seidel on the contact rows: the least pushes that part all of them, to first order. */
#include "ice/packing_work.h"

#include "base/random.h"
#include <string.h>

enum { SWEEPS = 10 };
/* Over-relaxation: between 1 and 2. */
static const double RELAXATION = 1.3;
/* A body moves by no more than this part of its size in a round, and turns by no more than this [rad]. */
static const double MOST_WAY = 0.15, MOST_TURN = 0.15;
/* A shaken floe turns by this many radians for every floe size that it moves. */
static const double SHAKE_TURN = 2;

static void sweep(const pack_layout *l, pack_contacts *c, int32_t first, int32_t end, int32_t by)
{
    pack_step *step = c->steps.data;
    for (int32_t i = first; i != end; i += by) {
        pack_row *r = &c->rows.data[i];
        pack_step *p = &step[r->a], *q = r->b >= 0 ? &step[r->b] : NULL;
        double gap = r->gap - (r->normal.x * p->x + r->normal.y * p->y + r->arm_a * p->turn);
        if (q)
            gap += r->normal.x * q->x + r->normal.y * q->y + r->arm_b * q->turn;
        double push = r->push - RELAXATION * gap * r->mass;
        push = push > 0 ? push : 0;
        double d = push - r->push;
        if (d == 0)
            continue;
        r->push = push;
        const pack_body *a = &l->bodies.data[r->a];
        p->x -= d * a->weight * r->normal.x;
        p->y -= d * a->weight * r->normal.y;
        p->turn -= d * a->spin_weight * r->arm_a;
        if (q) {
            const pack_body *b = &l->bodies.data[r->b];
            q->x += d * b->weight * r->normal.x;
            q->y += d * b->weight * r->normal.y;
            q->turn += d * b->spin_weight * r->arm_b;
        }
    }
}

static double limited(double x, double most) { return x > most ? most : x < -most ? -most : x; }

static void move_bodies(pack_layout *l, const pack_contacts *by)
{
    for (int32_t i = 0; i < l->movable; i++) {
        pack_body *b = &l->bodies.data[i];
        pack_step s = by->steps.data[i];
        double way = sqrt(s.x * s.x + s.y * s.y), most = MOST_WAY * fmin(b->size, l->grain);
        double part = way > most ? most / way : 1;
        b->centre.x += part * s.x;
        b->centre.y += part * s.y;
        /* Cayley's rotation: on the unit circle without sines. */
        double h = 0.5 * limited(s.turn, MOST_TURN), f = 1 / (1 + h * h), c = (1 - h * h) * f, sn = 2 * h * f;
        vec2 u = {c * b->turn.x - sn * b->turn.y, sn * b->turn.x + c * b->turn.y};
        b->turn = vec2_scale(u, 1 / vec2_length(u));
    }
}

/* -1 to 1 from 32 bits. */
static double signed_unit(uint32_t bits) { return bits * 0x1p-31 - 1; }

/* Steps at random, which the sweeps then bend around the contacts. */
static void shake_steps(pack_work *w, double shake)
{
    for (int32_t i = 0; i < w->layout.movable; i++) {
        random_stream r = random_begin(w->seed, PACK_STREAM_SHAKE, (uint32_t)i);
        r.counter = (uint64_t)w->round * 2;
        uint64_t way = random_bits(&r), turn = random_bits(&r);
        /* Large floes by no more than a mean one: they would be carried right across the small ones. */
        const pack_body *b = &w->layout.bodies.data[i];
        double way_size = shake * fmin(b->size, w->layout.grain), turn_size = SHAKE_TURN * way_size / b->size;
        w->contacts.steps.data[i] =
            (pack_step){way_size * signed_unit((uint32_t)way), way_size * signed_unit((uint32_t)(way >> 32)),
                        turn_size * signed_unit((uint32_t)turn)};
    }
}

void pack_solve_rows(pack_work *w, double shake)
{
    memset(w->contacts.steps.data, 0, (size_t)w->layout.bodies.count * sizeof *w->contacts.steps.data);
    if (shake > 0)
        shake_steps(w, shake);
    for (int k = 0; k < SWEEPS; k++) {
        if (k % 2 == 0)
            sweep(&w->layout, &w->contacts, 0, w->contacts.rows.count, 1);
        else
            sweep(&w->layout, &w->contacts, w->contacts.rows.count - 1, -1, -1);
    }
    move_bodies(&w->layout, &w->contacts);
}
