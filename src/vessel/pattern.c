#include "vessel/pattern.h"

#include "base/transcendental.h"

/* 0 to 1 and back in a round. */
static double to_and_fro(double share) { return share < 0.5 ? 2 * share : 2 - 2 * share; }

/* Counter-clockwise from the corner at the right of the updrift side. */
static vec2 square_point(double share)
{
    double at = 4 * share, part = at - floor(at);
    switch ((int)floor(at)) {
    case 0:
        return (vec2){0.5, part - 0.5};
    case 1:
        return (vec2){0.5 - part, 0.5};
    case 2:
        return (vec2){-0.5, 0.5 - part};
    default:
        return (vec2){part - 0.5, -0.5};
    }
}

vec2 pattern_point(const pattern_shape *p, double share)
{
    double turn = 2 * PI * share, angle;
    vec2 corner;
    switch (p->kind) {
    case PATTERN_LINE:
        return (vec2){p->distance + p->width * to_and_fro(share), 0};
    case PATTERN_ACROSS:
        return (vec2){p->distance, p->width * (to_and_fro(share) - 0.5)};
    case PATTERN_CIRCLE:
        return (vec2){p->distance + p->width / 2 * real_cos(turn), p->width / 2 * real_sin(turn)};
    case PATTERN_SQUARE:
        corner = square_point(share);
        return (vec2){p->distance + p->width * corner.x, p->width * corner.y};
    case PATTERN_SECTOR:
        angle = p->width * (to_and_fro(share) - 0.5) / p->distance;
        return (vec2){p->distance * real_cos(angle), p->distance * real_sin(angle)};
    case PATTERN_NONE:
        break;
    }
    return (vec2){0, 0};
}

double pattern_length(const pattern_shape *p)
{
    switch (p->kind) {
    case PATTERN_CIRCLE:
        return PI * p->width;
    case PATTERN_SQUARE:
        return 4 * p->width;
    case PATTERN_LINE:
    case PATTERN_ACROSS:
    case PATTERN_SECTOR:
        return 2 * p->width;
    case PATTERN_NONE:
        break;
    }
    return 0;
}
