/* Random fields of strength; see strength.h. */
#include "ice/strength.h"

#include "base/random.h"
#include "base/transcendental.h"

#include <math.h>
#include <string.h>

/* Two fields: of the flexural strength, and of what the crushing strength does not share with it. */
enum { ICE_STREAM_STRENGTH = 0x1ce40 };

/* Lattice points to both sides of a place along an axis; the kernel is exp(-8) of its peak where one enters. */
enum { REACH = 4, POINTS = 2 * REACH };

/* Farther cells are no places of ice: a damaged checkpoint. */
static const double FARTHEST_CELL = 1e15;

/* The kernel along one axis about `at`, in units of the lattice: weights of the points first .. first + POINTS - 1, and
   the sum of their squares. */
typedef struct kernel {
    int64_t first;
    double weight[POINTS], squares;
} kernel;

static kernel kernel_about(double at)
{
    if (!(fabs(at) < FARTHEST_CELL))
        at = 0;
    double cell = floor(at);
    kernel k = {.first = (int64_t)cell - (REACH - 1)};
    for (int i = 0; i < POINTS; i++) {
        double d = at - cell + (REACH - 1) - i;
        k.weight[i] = real_exp(-0.5 * d * d);
        k.squares += k.weight[i] * k.weight[i];
    }
    return k;
}

/* Noise of a point of the lattice, mean 0 and variance 1: the sum of eight uniform numbers of 16 bits, which under the
   kernel is normal to a kurtosis of -0.01, at a tenth of the cost of normal numbers.  The lattice wraps after 4e9
   cells. */
static double noise(const strength_field *f, uint32_t stream, int64_t column, int64_t row)
{
    const uint32_t counter[4] = {(uint32_t)column, (uint32_t)row, stream, ICE_STREAM_STRENGTH};
    const uint32_t key[2] = {(uint32_t)f->seed, (uint32_t)(f->seed >> 32)};
    uint32_t bits[4];
    random_philox(counter, key, bits);
    int32_t sum = 0;
    for (int i = 0; i < 4; i++)
        sum += (int32_t)(bits[i] & 0xffff) + (int32_t)(bits[i] >> 16);
    static const double middle = 4 * 65535.0, deviation = 53509.919921450; /* sqrt(8 (2^32 - 1) / 12) */
    return (sum - middle) / deviation;
}

/* As noise.  What a lattice of 8 points has side by side lies in different rows of the memory. */
static double noise_remembered(const strength_field *f, strength_memory *memory, uint32_t stream, int64_t column,
                               int64_t row)
{
    enum { ROW = 37 };
    if (!memory)
        return noise(f, stream, column, row);
    strength_noise *n = &memory->noise[((uint64_t)column + ROW * (uint64_t)row) % STRENGTH_NOISES];
    if (!n->known || n->column != column || n->row != row || n->stream != stream)
        *n = (strength_noise){column, row, noise(f, stream, column, row), stream, true};
    return n->value;
}

/* Normal at every place, mean 0 and variance 1. */
static double gaussian_field(const strength_field *f, strength_memory *memory, uint32_t stream, vec2 place)
{
    double pitch = 0.5 * f->length, sum = 0;
    kernel x = kernel_about(place.x / pitch), y = kernel_about(place.y / pitch);
    for (int i = 0; i < POINTS; i++) {
        double line = 0;
        for (int k = 0; k < POINTS; k++)
            line += y.weight[k] * noise_remembered(f, memory, stream, x.first + i, y.first + k);
        sum += x.weight[i] * line;
    }
    return sum / sqrt(x.squares * y.squares);
}

double strength_factor(const strength_field *f, strength_memory *memory, strength_kind kind, vec2 place)
{
    double variation = kind == STRENGTH_FLEXURAL ? f->flexural_variation : f->crushing_variation;
    if (!(variation > 0))
        return 1;
    if (memory && memory->seed != f->seed) {
        memset(memory, 0, sizeof *memory);
        memory->seed = f->seed;
    }
    double g;
    if (kind == STRENGTH_FLEXURAL || f->common >= 1)
        g = gaussian_field(f, memory, 0, place);
    else if (f->common <= 0)
        g = gaussian_field(f, memory, 1, place);
    else
        g = f->common * gaussian_field(f, memory, 0, place) +
            sqrt(1 - f->common * f->common) * gaussian_field(f, memory, 1, place);
    double variance = real_log(1 + variation * variation);
    return real_exp(sqrt(variance) * g - 0.5 * variance);
}

vec2 strength_place(const floe_table *floes, int32_t floe, vec2 point)
{
    vec2 origin = floes->ice_origin[floe];
    double yaw = floes->ice_yaw[floe];
    if (yaw == 0)
        return vec2_add(origin, point);
    double c = real_cos(yaw), s = real_sin(yaw);
    return (vec2){origin.x + c * point.x - s * point.y, origin.y + s * point.x + c * point.y};
}

ice_material strength_flexural_at(const strength_field *f, strength_memory *memory, const floe_table *floes,
                                  int32_t floe, vec2 point)
{
    ice_material ice = floes->material[floe];
    if (f->flexural_variation > 0)
        ice.flexural_strength *= strength_factor(f, memory, STRENGTH_FLEXURAL, strength_place(floes, floe, point));
    return ice;
}

ice_material strength_crushing_at(const strength_field *f, const floe_table *floes, int32_t floe, vec2 point)
{
    ice_material ice = floes->material[floe];
    if (f->crushing_variation > 0)
        ice.crushing_strength *= strength_factor(f, NULL, STRENGTH_CRUSHING, strength_place(floes, floe, point));
    return ice;
}
