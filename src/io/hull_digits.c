#include "io/hull_digits.h"

#include <math.h>
#include <stdio.h>

enum { MOST_DECIMALS = 6 };
/* What is left of a multiple of the step in binary, relative; coordinates read from 4-byte floats are off by more. */
#define LEFT_OF_A_STEP 1e-14
/* Steps of a hundredth of the hull and more are its shape: nobody rounds a ship of 40 m to metres. */
#define COARSEST 0.01
/* Sides of so many steps bend less between three corners than rounding moves these; a bow that is cut into longer ones
   is none that a circle was. */
#define LONGEST_SIDE 100
/* Both ends of a triangle's height are moved by less than a step. */
#define FLATTENED 2

static bool is_multiple(double x, double per_unit)
{
    double count = x * per_unit;
    return fabs(count - round(count)) <= LEFT_OF_A_STEP * fmax(1, fabs(count));
}

/* 0: they are multiples of no such step. */
static double step_of_digits(const mesh *in_file)
{
    double per_unit = 1;
    int digits = 0;
    for (int32_t i = 0; i < in_file->vertex.count && digits <= MOST_DECIMALS; i++) {
        vec3 p = in_file->vertex.data[i];
        while (digits <= MOST_DECIMALS &&
               !(is_multiple(p.x, per_unit) && is_multiple(p.y, per_unit) && is_multiple(p.z, per_unit))) {
            per_unit *= 10;
            digits++;
        }
    }
    return digits <= MOST_DECIMALS ? 1 / per_unit : 0;
}

typedef struct side_range {
    double shortest, longest;
} side_range;

static side_range sides_of(const mesh *m, int32_t face)
{
    vec3 p[3];
    side_range range = {HUGE_VAL, 0};
    mesh_face_points(m, face, p);
    for (int k = 0; k < 3; k++) {
        double side = vec3_length(vec3_sub(p[(k + 1) % 3], p[k]));
        range.shortest = fmin(range.shortest, side);
        range.longest = fmax(range.longest, side);
    }
    return range;
}

/* The least height of a triangle [m]. */
static double height_of(const mesh *m, int32_t face)
{
    double longest = sides_of(m, face).longest;
    return longest > 0 ? 2 * vec3_length(mesh_area_vector(m, face)) / longest : 0;
}

static bool share_corner(const mesh *m, const int32_t face[2])
{
    const int32_t *a = m->face.data[face[0]].v, *b = m->face.data[face[1]].v;
    for (int i = 0; i < 9; i++)
        if (a[i / 3] == b[i % 3])
            return true;
    return false;
}

static bool may_be_rounded_off(const mesh *m, const int32_t face[2], double step)
{
    box3 box = mesh_bounds(m);
    vec3 size = vec3_sub(box.hi, box.lo);
    if (!(step > 0 && step <= COARSEST * fmax(size.x, fmax(size.y, size.z))))
        return false;
    if (face[1] < 0)
        return sides_of(m, face[0]).shortest <= LONGEST_SIDE * step;
    return share_corner(m, face) && fmin(height_of(m, face[0]), height_of(m, face[1])) <= FLATTENED * step;
}

bool hull_lacks_digits(const mesh *in_file, double scale, const mesh *m, const int32_t face[2], char *advice,
                       size_t size)
{
    double step = step_of_digits(in_file);
    bool lacks = may_be_rounded_off(m, face, step * scale);
    if (lacks)
        snprintf(advice, size,
                 "the coordinates, multiples of %g, have too few digits here: export with more, or binary", step);
    return lacks;
}
