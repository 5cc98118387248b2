#include "results/rainflow.h"

#include "base/transcendental.h"

#include <math.h>

/* ---- turning points ---- */

static bool add_turn(context *ctx, double_array *turn, double x)
{
    if (isnan(x) || (turn->count > 0 && x == turn->data[turn->count - 1]))
        return true;
    if (turn->count > 1) {
        double before = turn->data[turn->count - 1] - turn->data[turn->count - 2];
        if ((x - turn->data[turn->count - 1]) * (before > 0 ? 1 : -1) > 0) {
            turn->data[turn->count - 1] = x;
            return true;
        }
    }
    return array_push(ctx, turn, x);
}

/* ---- counting ---- */

static bool add_cycle(context *ctx, rain_cycles *out, double a, double b, double count)
{
    const rain_cycle cycle = {fabs(a - b), 0.5 * (a + b), count};
    return array_push(ctx, &out->list, cycle);
}

/* Ranges that a larger one has closed are taken from the end of the stack; one that begins at its start is half a
   cycle. */
static bool close_ranges(context *ctx, double_array *stack, rain_cycles *out)
{
    while (stack->count >= 3) {
        double *top = stack->data + stack->count;
        double last = fabs(top[-1] - top[-2]), before = fabs(top[-2] - top[-3]);
        if (last < before)
            return true;
        bool starts = stack->count == 3;
        if (!add_cycle(ctx, out, top[-3], top[-2], starts ? 0.5 : 1))
            return false;
        if (starts) {
            stack->data[0] = stack->data[1];
            stack->data[1] = stack->data[2];
            stack->count = 2;
        } else {
            top[-3] = top[-1];
            stack->count -= 2;
        }
    }
    return true;
}

bool rainflow(context *ctx, const double *value, int32_t count, rain_cycles *out)
{
    double_array turn = {0}, stack = {0};
    bool good = true;
    array_clear(&out->list);
    for (int32_t i = 0; i < count && good; i++)
        good = add_turn(ctx, &turn, value[i]);
    for (int32_t i = 0; i < turn.count && good; i++)
        good = array_push(ctx, &stack, turn.data[i]) && close_ranges(ctx, &stack, out);
    for (int32_t i = 0; i + 1 < stack.count && good; i++)
        good = add_cycle(ctx, out, stack.data[i], stack.data[i + 1], 0.5);
    array_free(ctx, &turn);
    array_free(ctx, &stack);
    return good;
}

void rainflow_free(context *ctx, rain_cycles *c) { array_free(ctx, &c->list); }

double equivalent_range(const rain_cycles *c, double slope, double cycles)
{
    double greatest = 0, sum = 0;
    for (int32_t i = 0; i < c->list.count; i++)
        greatest = fmax(greatest, c->list.data[i].range);
    if (!(greatest > 0))
        return 0;
    for (int32_t i = 0; i < c->list.count; i++)
        sum += c->list.data[i].count * real_pow(c->list.data[i].range / greatest, slope);
    return greatest * real_pow(sum / cycles, 1 / slope);
}
