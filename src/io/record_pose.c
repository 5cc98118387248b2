#include "io/record_pose.h"

#include <string.h>

/* A component is a whole number of steps from -1/sqrt(2) to 1/sqrt(2), so that zero is kept exactly. */
enum { HALF_MOST = 0x7bff, HALF_LEAST = -14, FORCE_MOST = 0xffff, FORCE_LEAST = -30 };
enum { HALF_STEPS = 16383, WORD_MASK = 32767, TOP_BIT = 32768 };
enum { MARKED_WORD = RECORD_POSE_SIZE - (int)sizeof(uint16_t) }; /* place of the third word of the orientation */
static const double root_half = 0.70710678118654752440;

/* 2^power, of a normal double. */
static double exponent_scale(int power)
{
    uint64_t bits = (uint64_t)(power + 1023) << 52;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Ten places of a mantissa under an exponent, of which 0 has the subnormal numbers; 2^least is the smallest that is
   none. */
static uint32_t pack_size(double size, int least)
{
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    /* The scale of the last place is 2^(exponent + least - 10): eleven binary places, or those of the smallest scale.
     */
    int first = (int)(bits >> 52) - 1023, exponent = first > least ? first - least : 0;
    double places = size * exponent_scale(10 - least - exponent);
    int whole = (int)places;
    double rest = places - whole;
    whole += rest > 0.5 || (rest == 0.5 && whole % 2 == 1);
    if (whole >= 2048) {
        whole /= 2;
        exponent++;
    }
    /* Below 1024 places the number is subnormal and its exponent field is zero. */
    return whole < 1024 ? (uint32_t)whole : (uint32_t)(exponent + 1) << 10 | ((uint32_t)whole - 1024);
}

static double unpack_size(uint32_t packed, int least)
{
    int field = (int)(packed >> 10);
    double places = (packed & 1023) + (field > 0 ? 1024 : 0);
    return places * exponent_scale((field > 0 ? field - 1 : 0) + least - 10);
}

uint16_t half_from_real(double value)
{
    uint16_t sign = value < 0 ? 0x8000 : 0;
    double size = fabs(value);
    if (!(size < 65504))
        return (uint16_t)(sign | HALF_MOST);
    return (uint16_t)(sign | pack_size(size, HALF_LEAST));
}

double real_from_half(uint16_t half) { return (half & 0x8000 ? -1 : 1) * unpack_size(half & 0x7fff, HALF_LEAST); }

uint16_t record_force_pack(double newton)
{
    double size = newton * 1e-3;
    return !(size < unpack_size(FORCE_MOST, FORCE_LEAST)) ? FORCE_MOST : (uint16_t)pack_size(size, FORCE_LEAST);
}

double record_force_unpack(uint16_t packed) { return unpack_size(packed, FORCE_LEAST) * 1e3; }

/* 15 bits of a component. */
static uint16_t pack_component(double part)
{
    double step = floor(part / root_half * HALF_STEPS + 0.5);
    return (uint16_t)(HALF_STEPS + fmin(fmax(step, -HALF_STEPS), HALF_STEPS));
}

void record_pose_pack(vec3 position, quat orientation, unsigned char out[RECORD_POSE_SIZE])
{
    const double part[4] = {orientation.w, orientation.x, orientation.y, orientation.z};
    int largest = 0;
    for (int i = 1; i < 4; i++) {
        if (fabs(part[i]) > fabs(part[largest]))
            largest = i;
    }
    double sign = part[largest] < 0 ? -1 : 1;
    uint16_t word[4] = {half_from_real(position.z)};
    for (int i = 0, k = 1; i < 4; i++) {
        if (i != largest)
            word[k++] = pack_component(sign * part[i]);
    }
    word[1] |= (uint16_t)(largest >> 1 << 15);
    word[2] |= (uint16_t)((largest & 1) << 15);
    float plan[2] = {(float)position.x, (float)position.y};
    memcpy(out, plan, sizeof plan);
    memcpy(out + sizeof plan, word, sizeof word);
}

void record_pose_unpack(const unsigned char in[RECORD_POSE_SIZE], vec3 *position, quat *orientation)
{
    float plan[2];
    uint16_t word[4];
    memcpy(plan, in, sizeof plan);
    memcpy(word, in + sizeof plan, sizeof word);
    *position = vec3_make((double)plan[0], (double)plan[1], real_from_half(word[0]));
    int largest = word[1] >> 15 << 1 | word[2] >> 15;
    double part[4] = {0}, sum = 0;
    for (int i = 0, k = 1; i < 4; i++) {
        if (i == largest)
            continue;
        part[i] = ((word[k++] & WORD_MASK) - HALF_STEPS) * root_half / HALF_STEPS;
        sum += part[i] * part[i];
    }
    part[largest] = sqrt(fmax(0, 1 - sum));
    *orientation = (quat){part[0], part[1], part[2], part[3]};
}

void record_pose_mark(unsigned char pose[RECORD_POSE_SIZE])
{
    uint16_t word;
    memcpy(&word, pose + MARKED_WORD, sizeof word);
    word |= TOP_BIT;
    memcpy(pose + MARKED_WORD, &word, sizeof word);
}

bool record_pose_is_marked(const unsigned char pose[RECORD_POSE_SIZE])
{
    uint16_t word;
    memcpy(&word, pose + MARKED_WORD, sizeof word);
    return (word & TOP_BIT) != 0;
}
