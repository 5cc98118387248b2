#include "fluid/added_mass.h"

#include "base/transcendental.h"

/* Coefficient of a rectangle, by shorter over longer side (DNV-RP-C205 2010, table D-2, which has longer over
   shorter). */
static double rectangle_coefficient(double ratio)
{
    static const double table[][2] = {{0, 1},       {0.1, 0.947},  {0.125, 0.934},    {0.16, 0.917},
                                      {0.2, 0.897}, {0.25, 0.872}, {0.315457, 0.840}, {1.0 / 3, 0.830},
                                      {0.4, 0.801}, {0.5, 0.757},  {0.628931, 0.704}, {2.0 / 3, 0.690},
                                      {0.8, 0.642}, {1, 0.579}};
    int k = 1;
    while (k < (int)(sizeof table / sizeof *table) - 1 && ratio > table[k][0])
        k++;
    double share = (ratio - table[k - 1][0]) / (table[k][0] - table[k - 1][0]);
    return table[k - 1][1] + share * (table[k][1] - table[k - 1][1]);
}

plate_added_mass plate_added_mass_of(const polygon_moments *outline, double water_density)
{
    /* Principal second moments; those of a rectangle are in the ratio of its sides squared. */
    double middle = 0.5 * (outline->xx + outline->yy), half = 0.5 * (outline->xx - outline->yy);
    double spread = sqrt(half * half + outline->xy * outline->xy);
    double ratio = middle + spread > 0 ? sqrt(fmax(0, middle - spread) / (middle + spread)) : 1;
    /* a = sqrt(area ratio), b = sqrt(area / ratio): a^2 b. */
    double product = outline->area * sqrt(outline->area * ratio);
    double heave = 0.5 * rectangle_coefficient(ratio) * (PI / 4) * water_density * product;
    double per_moment = outline->area > 0 ? 8.0 / 15 * heave / outline->area : 0;
    return (plate_added_mass){heave, per_moment * outline->xx, per_moment * outline->yy};
}

/* Each halves the differences of the three arguments twice: after so many they are equal to the last bit. */
enum { DUPLICATIONS = 40 };

/* R_D(x, y, z) = 3/2 int_0^inf dt / (sqrt(t + x) sqrt(t + y) (t + z)^(3/2)) by duplication (Carlson 1979). */
static double carlson_rd(double x, double y, double z)
{
    double sum = 0, factor = 1;
    for (int i = 0; i < DUPLICATIONS; i++) {
        double rx = sqrt(x), ry = sqrt(y), rz = sqrt(z), shift = rx * ry + ry * rz + rz * rx;
        sum += factor / (rz * (z + shift));
        factor *= 0.25;
        x = 0.25 * (x + shift);
        y = 0.25 * (y + shift);
        z = 0.25 * (z + shift);
    }
    /* All equal by now: to second order they do not matter. */
    double mean = (x + y + 3 * z) / 5;
    return 3 * sum + factor / (mean * sqrt(mean));
}

/* Turning about the axis across semi-axes p and q, of which the first shape factor is a and the second b: Lamb's
   (p^2 - q^2)^2 (b - a) / (2 (p^2 - q^2) + (p^2 + q^2) (a - b)) / 5 of the displaced mass; nothing for a round one. */
static double turning(double p, double q, double a, double b)
{
    double difference = p * p - q * q, sum = p * p + q * q;
    double below = 2 * difference + sum * (a - b);
    return below == 0 ? 0 : difference * difference * (b - a) / (5 * below);
}

matrix6 ellipsoid_added_mass(vec3 s, double volume, double water_density)
{
    double a = s.x, b = s.y, c = s.z, product = 2.0 / 3 * a * b * c;
    double alpha = product * carlson_rd(b * b, c * c, a * a), beta = product * carlson_rd(c * c, a * a, b * b),
           gamma = product * carlson_rd(a * a, b * b, c * c), mass = water_density * volume;
    return (matrix6){{{[0] = mass * alpha / (2 - alpha)},
                      {[1] = mass * beta / (2 - beta)},
                      {[2] = mass * gamma / (2 - gamma)},
                      {[3] = mass * turning(b, c, beta, gamma)},
                      {[4] = mass * turning(c, a, gamma, alpha)},
                      {[5] = mass * turning(a, b, alpha, beta)}}};
}
