#include "geometry/geographic.h"

#include "base/transcendental.h"

#include <math.h>

/* tan^2 of half the conformal colatitude's complement, without the factor c: grows from 0 at the south pole without
   bound towards the north pole. */
static double isometric(double eccentricity, double n, double sine)
{
    double e = eccentricity * sine;
    double sphere = (1 + sine) / (1 - sine), flattening = real_pow((1 - e) / (1 + e), eccentricity);
    return real_pow(sphere * flattening, n);
}

stereographic stereographic_make(ellipsoid e, vec2 centre_deg, double scale)
{
    const double most = 90 - 1e-3;
    double f = 1 / e.inverse_flattening, square = f * (2 - f);
    double latitude = radians(fmax(-most, fmin(most, centre_deg.y)));
    double sine = real_sin(latitude), cosine = real_cos(latitude), root = sqrt(1 - square * sine * sine);
    stereographic s = {.eccentricity = sqrt(square), .longitude = radians(centre_deg.x)};
    s.n = sqrt(1 + square * cosine * cosine * cosine * cosine / (1 - square));
    double w = isometric(s.eccentricity, s.n, sine), chi = (w - 1) / (w + 1);
    s.c = (s.n + sine) * (1 - chi) / ((s.n - sine) * (1 + chi));
    w *= s.c;
    s.sin_latitude = (w - 1) / (w + 1);
    s.cos_latitude = 2 * sqrt(w) / (w + 1);
    /* Mean of the radii of curvature along the meridian and across it. */
    s.diameter = 2 * scale * e.a * sqrt(1 - square) / (root * root);
    return s;
}

vec2 stereographic_project(const stereographic *s, vec2 place_deg)
{
    double sine = real_sin(radians(place_deg.y)), east = radians(place_deg.x) - s->longitude;
    east -= 2 * PI * floor(east / (2 * PI) + 0.5);
    double sin_latitude = sine < 0 ? -1 : 1, cos_latitude = 0; /* of the poles */
    if (fabs(sine) < 1) {
        double w = s->c * isometric(s->eccentricity, s->n, sine);
        sin_latitude = (w - 1) / (w + 1);
        cos_latitude = 2 * sqrt(w) / (w + 1);
    }
    double c = real_cos(s->n * east), d = real_sin(s->n * east);
    double b = 1 + sin_latitude * s->sin_latitude + cos_latitude * s->cos_latitude * c;
    return vec2_make(s->diameter * cos_latitude * d / b,
                     s->diameter * (sin_latitude * s->cos_latitude - cos_latitude * s->sin_latitude * c) / b);
}
