/* Faster than sweep by sweep.  A velocity is a linear function of the impulses, v = v0 + M^-1 J^T p, and where no bound
   is active the solution makes f(p) = v.M v / 2 - wanted.p least (driven bodies have no mass and are not in v; what
   they bring to a row counts as wanted of it).  After every other sweep p takes a step along the combination of its
   last search directions that makes f least: conjugate gradients with the sweep as preconditioner, of which the
   three-term recurrence is widened to four directions.  All scalar products are ones of velocities, hence sums over
   bodies, far fewer than contacts; p and v take the same steps, and stay true to each other.

   Bounds.  The next sweep draws p back into its bounds.  A step that did more harm than good - the sweeps after it take
   more energy than those before it, and f has grown or they take much more - is rolled back, and the next comes later.
   Sliding friction is no minimum of f, since its impulse follows the normal one, and a capped normal impulse stays at
   its cap: both are left out of the gradient; otherwise friction would come out too strong, and steps go far beyond
   caps. (After Silcowitz, Niebe and Erleben 2010, who take the ratio of two sweeps' squares in place of the products.)
 */
#include "base/pool.h"
#include "dynamics/solver_fast.h"

#include <string.h>

/* How far a step may go, in lengths of a search direction: at the start, and by what factor that grows after a step
   that was shortened and took half of its predicted decrease, and shrinks after one that failed.  Where light bodies
   carry a heavy one the best step is huge (about the ratio of masses); taken at once, what the bounds cut off from it
   would be large against the light ones. */
#define FIRST_STEP_LIMIT 16.0
#define STEP_LIMIT_FACTOR 8.0
#define LARGEST_STEP_LIMIT 1e6
#define WORTH_PREDICTING 1e-9 /* of the bodies' energy: rounding predicts as much */
#define ROUNDING 1e-14
/* A gradient below this share of the bodies' energy is rounding: that of a short direction of large velocities is known
   no better. */
#define GRADIENT_ROUNDING 1e-14
/* Sweeps that take less than this share of the bodies' energy work on rounding errors: velocities are right to 1e-13.
 */
#define NOTHING_LEFT 1e-26
/* Sweeps from one step to the next: the directions of two tell nearly as much as
   twice the number of single ones.  Twice as
   many after a step that failed. */
enum { SHORTEST_PAUSE = 2, LONGEST_PAUSE = 64 };
/* A step after which sweeps take more than so many times what they took before is rolled back though f has become less:
   it leaves friction so far from right that few bodies come to rest later than without any steps. */
#define MUCH_MORE 4.0
/* A direction that repeats others to within this share of its square adds nothing. */
#define DEPENDENT_DIRECTION 1e-10

void acceleration_free(context *ctx, acceleration *a)
{
    for (int i = 0; i < VECTORS; i++) {
        sweep_vector *v = &a->vector[i];
        array_free(ctx, &v->start.memory);
        array_free(ctx, &v->kept.memory);
        for (int w = 0; w < SEARCH_DIRECTIONS - 1; w++)
            array_free(ctx, &v->store[w].memory);
    }
}

/* No direction is remembered yet: what stands in their rows is never looked at. */
static bool vector_begin(context *ctx, sweep_vector *v, aligned_rows *x, int64_t rows)
{
    v->x = x;
    v->count = rows * BATCH_LANES;
    if (!rows_reserve(ctx, &v->start, rows) || !rows_reserve(ctx, &v->kept, rows))
        return false;
    for (int w = 1; w < SEARCH_DIRECTIONS; w++) {
        if (!rows_reserve(ctx, &v->store[w - 1], rows))
            return false;
        v->direction[w] = v->store[w - 1].rows;
    }
    return true;
}

/* Doubles of a block of a vector. */
enum { VECTOR_BLOCK = 1 << 11 };

static int32_t vector_blocks(const sweep_vector *v) { return (int32_t)((v->count + VECTOR_BLOCK - 1) / VECTOR_BLOCK); }

/* A piece of one of the vectors. */
typedef struct vector_part {
    const sweep_vector *v;
    int64_t first, end;
} vector_part;

/* Blocks of the first vector, then of the second and so on. */
static vector_part part_of(const acceleration *a, int32_t block)
{
    const sweep_vector *v = a->vector;
    for (; block >= vector_blocks(v); v++)
        block -= vector_blocks(v);
    int64_t first = (int64_t)block * VECTOR_BLOCK, end = first + VECTOR_BLOCK;
    return (vector_part){v, first, end < v->count ? end : v->count};
}

static void run_on_vectors(context *ctx, const acceleration *a, block_function fn, void *arg)
{
    int32_t blocks = 0;
    for (int i = 0; i < VECTORS; i++)
        blocks += vector_blocks(&a->vector[i]);
    pool_run(ctx, fn, arg, blocks);
}

static void start_block(void *arg, int32_t block, int32_t thread)
{
    vector_part p = part_of(arg, block);
    (void)thread;
    memcpy(p.v->start.rows + p.first, p.v->x->rows + p.first, (size_t)(p.end - p.first) * sizeof(double));
}

static void roll_back_block(void *arg, int32_t block, int32_t thread)
{
    vector_part p = part_of(arg, block);
    (void)thread;
    memcpy(p.v->x->rows + p.first, p.v->kept.rows + p.first, (size_t)(p.end - p.first) * sizeof(double));
}

/* Impulses of joints from their blocks into rows, and back. */
static void gather_joints(const solver *s)
{
    for (int32_t i = 0; i < s->joints.count; i++)
        memcpy(row_of(&s->fast->joint_impulse, i), s->joints.data[i].impulse, sizeof s->joints.data[i].impulse);
}

static void scatter_joints(solver *s)
{
    for (int32_t i = 0; i < s->joints.count; i++)
        memcpy(s->joints.data[i].impulse, row_of(&s->fast->joint_impulse, i), sizeof s->joints.data[i].impulse);
}

static void wanted_task(const stage *st, batch_task *task)
{
    task->wanted = KERNEL_PICK(st->s->ctx, solver_wanted)(&st->view, task->first, task->end);
}

double acceleration_wanted(stage *st)
{
    const batch_plan *plan = &st->s->fast->plan;
    double sum = 0;
    stage_run(st, wanted_task);
    for (int32_t t = 0; t < plan->tasks.count; t++)
        sum += plan->tasks.data[t].wanted;
    return sum;
}

/* ---- scalar products ---- */

enum { BODY_BLOCK = 512 };

static void products_of_block(void *arg, int32_t block, int32_t thread)
{
    const stage *st = arg;
    fast_rows *f = st->s->fast;
    const sweep_vector *v = &f->acceleration.vector[VECTOR_VELOCITY];
    int32_t first = BODY_BLOCK * block, end = first + BODY_BLOCK, all = padded_rows(f);
    (void)thread;
    f->blocks.data[block] = KERNEL_PICK(st->s->ctx, solver_products)(f->velocity.rows, v->start.rows, v->direction,
                                                                     1 + f->acceleration.directions, f->mass.rows,
                                                                     f->inertia.rows, first, end < all ? end : all);
}

/* A body if nothing can move it, else one at rest. */
static solver_body fixed_part(const solver_body *body)
{
    solver_body part = {.slot = body->slot};
    if (!solver_body_is_movable(body)) {
        part.velocity = body->velocity;
        part.angular_velocity = body->angular_velocity;
    }
    return part;
}

/* Products of velocities, and what joints add to them: softness, and what they and fixed bodies ask for.  value: f. */
static direction_products products_of(stage *st, double wanted, double *value)
{
    solver *s = st->s;
    fast_rows *f = s->fast;
    const sweep_vector *v = &f->acceleration.vector[VECTOR_JOINT];
    direction_products sum = {.square = 0};
    pool_run(s->ctx, products_of_block, st, f->blocks.count);
    for (int32_t i = 0; i < f->blocks.count; i++) {
        sum.square += f->blocks.data[i].square;
        for (int w = 0; w < SEARCH_DIRECTIONS; w++) {
            sum.direction[w] += f->blocks.data[i].direction[w];
            sum.velocity[w] += f->blocks.data[i].velocity[w];
        }
    }
    *value = 0.5 * sum.square - wanted;
    for (int32_t i = 0; i < s->joints.count; i++) {
        const joint_block *j = &s->joints.data[i];
        solver_body body = fixed_part(&s->bodies.data[j->body]), base = fixed_part(&s->bodies.data[j->base]);
        for (int r = 0; r < j->count; r++) {
            ptrdiff_t at = (ptrdiff_t)BATCH_LANES * i + r;
            double now = j->impulse[r] - v->start.rows[at];
            double bias = j->bias[r] + row_axis_velocity(&j->axis[r], &body, &base);
            *value += (bias + 0.5 * j->softness * j->impulse[r]) * j->impulse[r];
            for (int w = 0; w <= f->acceleration.directions; w++) {
                double along = w == 0 ? now : v->direction[w][at];
                sum.direction[w] += j->softness * now * along;
                sum.velocity[w] += (bias + j->softness * j->impulse[r]) * along;
            }
        }
    }
    return sum;
}

/* ---- begin ---- */

bool acceleration_begin(stage *st, aligned_rows *x, int64_t rows)
{
    solver *s = st->s;
    fast_rows *f = s->fast;
    acceleration *a = &f->acceleration;
    int32_t bodies = padded_rows(f), joints = s->joints.count;
    if (!rows_reserve(s->ctx, &f->joint_impulse, joints) ||
        !array_resize(s->ctx, &f->blocks, (bodies + BODY_BLOCK - 1) / BODY_BLOCK))
        return false;
    rows_clear(&f->joint_impulse, joints);
    gather_joints(s);
    a->directions = 0;
    a->step_limit = FIRST_STEP_LIMIT;
    a->predicted = 0;
    a->pause = SHORTEST_PAUSE;
    a->wanted_start = st->positions ? 0 : acceleration_wanted(st); /* a correction starts without impulses */
    memset(a->product, 0, sizeof a->product);
    if (!vector_begin(s->ctx, &a->vector[VECTOR_VELOCITY], &f->velocity, bodies) ||
        !vector_begin(s->ctx, &a->vector[VECTOR_IMPULSE], x, rows) ||
        !vector_begin(s->ctx, &a->vector[VECTOR_JOINT], &f->joint_impulse, joints))
        return false;
    run_on_vectors(s->ctx, a, start_block, a);
    double value;
    a->scale = fmax(2 * st->free_energy, products_of(st, a->wanted_start, &value).square);
    a->free_value = st->free_energy + ROUNDING * a->scale;
    return true;
}

static void slide_task(const stage *st, batch_task *task)
{
    const acceleration *a = &st->s->fast->acceleration;
    const sweep_vector *v = &a->vector[VECTOR_IMPULSE];
    KERNEL_PICK(st->s->ctx, solver_slide)
    (&st->view, task->first, task->end, v->start.rows, v->direction, 1 + a->directions, task->slide);
}

/* The work of each direction in the tangents of sliding contacts and at caps. */
static void slides_of(stage *st, double slide[SEARCH_DIRECTIONS])
{
    const batch_plan *plan = &st->s->fast->plan;
    stage_run(st, slide_task);
    for (int32_t t = 0; t < plan->tasks.count; t++)
        for (int w = 0; w < SEARCH_DIRECTIONS; w++)
            slide[w] += plan->tasks.data[t].slide[w];
}

/* ---- the step ---- */

/* Shares that make f least: product share = gradient, by Cholesky's method without the directions that repeat others.
 */
static void solve_shares(double product[SEARCH_DIRECTIONS][SEARCH_DIRECTIONS], const double gradient[SEARCH_DIRECTIONS],
                         int count, double share[SEARCH_DIRECTIONS])
{
    double l[SEARCH_DIRECTIONS][SEARCH_DIRECTIONS] = {{0}}, y[SEARCH_DIRECTIONS] = {0};
    for (int i = 0; i < count; i++) {
        double pivot = product[i][i], rest = gradient[i];
        for (int k = 0; k < i; k++) {
            double sum = product[i][k];
            for (int q = 0; q < k; q++)
                sum -= l[i][q] * l[k][q];
            l[i][k] = l[k][k] > 0 ? sum / l[k][k] : 0;
            pivot -= l[i][k] * l[i][k];
            rest -= l[i][k] * y[k];
        }
        if (pivot > DEPENDENT_DIRECTION * product[i][i]) {
            l[i][i] = sqrt(pivot);
            y[i] = rest / l[i][i];
        } else {
            memset(l[i], 0, sizeof l[i]);
        }
    }
    for (int i = count - 1; i >= 0; i--) {
        double sum = y[i];
        for (int q = i + 1; q < count; q++)
            sum -= l[q][i] * share[q];
        share[i] = l[i][i] > 0 ? sum / l[i][i] : 0;
    }
}

/* Keeps a step within its limit; true when it was longer. */
static bool shorten(double share[SEARCH_DIRECTIONS], double limit)
{
    double longest = 0;
    for (int w = 0; w < SEARCH_DIRECTIONS; w++)
        longest = fmax(longest, fabs(share[w]));
    if (longest <= limit)
        return false;
    for (int w = 0; w < SEARCH_DIRECTIONS; w++)
        share[w] *= limit / longest;
    return true;
}

/* Predicted decrease: what a step takes from f if no bound is met.  gradient: minus that of f, along each direction. */
static double decrease_of(const acceleration *a, const double gradient[SEARCH_DIRECTIONS],
                          const double share[SEARCH_DIRECTIONS])
{
    double sum = 0;
    for (int w = 0; w < SEARCH_DIRECTIONS; w++) {
        sum += share[w] * gradient[w];
        for (int k = 0; k < SEARCH_DIRECTIONS; k++)
            sum -= 0.5 * share[w] * share[k] * a->product[w][k];
    }
    return sum;
}

typedef struct combination {
    context *ctx;
    const acceleration *a;
    const double *share;
} combination;

static void combine_block(void *arg, int32_t block, int32_t thread)
{
    const combination *c = arg;
    vector_part p = part_of(c->a, block);
    (void)thread;
    KERNEL_PICK(c->ctx, solver_combine)
    (p.v->x->rows, p.v->start.rows, p.v->kept.rows, p.v->direction, 1 + c->a->directions, c->share, p.first, p.end);
}

/* Moves all vectors on; the newest direction takes the place of the oldest. */
static void move_on(context *ctx, acceleration *a, const double share[SEARCH_DIRECTIONS])
{
    combination c = {ctx, a, share};
    run_on_vectors(ctx, a, combine_block, &c);
    for (int i = 0; i < VECTORS; i++) {
        sweep_vector *v = &a->vector[i];
        double *newest = v->direction[SEARCH_DIRECTIONS - 1];
        for (int w = SEARCH_DIRECTIONS - 1; w > 1; w--)
            v->direction[w] = v->direction[w - 1];
        v->direction[1] = newest;
    }
}

/* Products of the new direction, which is made of the old ones, follow from theirs. */
static void remember_direction(acceleration *a, const double share[SEARCH_DIRECTIONS])
{
    double part[SEARCH_DIRECTIONS], with[SEARCH_DIRECTIONS], square = 0, wanted = 0;
    for (int w = 0; w < SEARCH_DIRECTIONS; w++)
        part[w] = share[w] + (w == 0 ? 1 : 0);
    for (int w = 0; w < SEARCH_DIRECTIONS; w++) {
        with[w] = 0;
        for (int k = 0; k < SEARCH_DIRECTIONS; k++)
            with[w] += part[k] * a->product[k][w];
        square += part[w] * with[w];
        wanted += part[w] * a->wanted_along[w];
    }
    for (int w = SEARCH_DIRECTIONS - 1; w > 1; w--) {
        for (int k = SEARCH_DIRECTIONS - 1; k > 1; k--)
            a->product[w][k] = a->product[w - 1][k - 1];
        a->wanted_along[w] = a->wanted_along[w - 1];
    }
    for (int w = 2; w < SEARCH_DIRECTIONS; w++)
        a->product[w][1] = a->product[1][w] = with[w - 1];
    a->product[1][1] = square;
    a->wanted_along[1] = wanted;
    a->wanted_start += wanted;
    a->directions = a->directions < SEARCH_DIRECTIONS - 1 ? a->directions + 1 : SEARCH_DIRECTIONS - 1;
}

/* Without friction f tells alone, and energies go up and down meanwhile. */
static bool failed(const acceleration *a, double value, double energy)
{
    return a->directions > 0 && energy > (value > a->kept_value ? 1 : MUCH_MORE) * a->kept_energy;
}

static void roll_back(solver *s)
{
    acceleration *a = &s->fast->acceleration;
    run_on_vectors(s->ctx, a, roll_back_block, a);
    for (int i = 0; i < VECTORS; i++) {
        sweep_vector *v = &a->vector[i];
        aligned_rows start = v->start;
        v->start = v->kept; /* sweeps go on from there; what was kept is not asked for again */
        v->kept = start;
    }
    scatter_joints(s);
    a->directions = 0;
}

bool acceleration_go_on(stage *st, double energy, double wanted)
{
    solver *s = st->s;
    acceleration *a = &s->fast->acceleration;
    double value, slide[SEARCH_DIRECTIONS] = {0}, gradient[SEARCH_DIRECTIONS], share[SEARCH_DIRECTIONS] = {0};
    gather_joints(s);
    direction_products sum = products_of(st, wanted, &value);
    a->scale = fmax(a->scale, sum.square);
    if (energy <= NOTHING_LEFT * a->scale)
        return false;
    /* Impulses on what a joint locks change no velocity, and may have far to go. */
    if (sum.direction[0] <= NOTHING_LEFT * a->scale)
        return s->guided.count > 0 && !st->positions;
    if (failed(a, value, energy)) {
        roll_back(s);
        a->wanted_start = a->kept_wanted;
        a->step_limit = fmax(1, a->step_limit / STEP_LIMIT_FACTOR);
        a->predicted = 0;
        a->pause = 2 * a->pause < LONGEST_PAUSE ? 2 * a->pause : LONGEST_PAUSE;
        return true;
    }
    if (!st->positions)
        slides_of(st, slide);
    a->wanted_along[0] = wanted - a->wanted_start;
    for (int w = 0; w < SEARCH_DIRECTIONS; w++) {
        a->product[0][w] = a->product[w][0] = sum.direction[w];
        gradient[w] = a->wanted_along[w] - sum.velocity[w] + slide[w];
    }
    for (int w = 0; w < SEARCH_DIRECTIONS; w++)
        if (fabs(gradient[w]) <= GRADIENT_ROUNDING * sum.square)
            gradient[w] = 0;
    solve_shares(a->product, gradient, a->directions + 1, share);
    if (a->predicted > WORTH_PREDICTING * a->scale && a->kept_value - value >= 0.5 * a->predicted)
        a->step_limit = fmin(LARGEST_STEP_LIMIT, a->step_limit * STEP_LIMIT_FACTOR);
    a->predicted = shorten(share, a->step_limit) ? decrease_of(a, gradient, share) : 0;
    move_on(s->ctx, a, share);
    scatter_joints(s);
    remember_direction(a, share);
    a->kept_value = value;
    a->kept_energy = energy;
    a->kept_wanted = wanted;
    a->pause = a->pause > 2 * SHORTEST_PAUSE ? a->pause / 2 : SHORTEST_PAUSE;
    return true;
}

bool acceleration_end(stage *st, double energy, double wanted)
{
    solver *s = st->s;
    acceleration *a = &s->fast->acceleration;
    double value;
    gather_joints(s);
    products_of(st, wanted, &value);
    if (a->directions > 0 && (value > a->free_value || failed(a, value, energy))) {
        roll_back(s);
        value = a->kept_value;
    }
    return value <= a->free_value;
}
