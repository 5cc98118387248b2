/* geometry/geographic: the worked example of IOGP Guidance Note 7-2, lengths on the ellipsoid, symmetry, poles. */
#include "base/transcendental.h"
#include "geometry/geographic.h"
#include "testing.h"

/* Amersfoort / RD New: longitude 6 E, latitude 53 N of Bessel's ellipsoid is E 196105.283, N 557057.739 m. */
START_TEST(the_published_example_is_met)
{
    vec2 centre = {5 + 23.0 / 60 + 15.5 / 3600, 52 + 9.0 / 60 + 22.178 / 3600};
    stereographic s = stereographic_make((ellipsoid){6377397.155, 299.1528128}, centre, 0.9999079);
    vec2 p = stereographic_project(&s, vec2_make(6, 53));
    ck_assert_double_eq_tol(p.x + 155000, 196105.283, 1e-3);
    ck_assert_double_eq_tol(p.y + 463000, 557057.739, 1e-3);
}
END_TEST

/* A small step north and one east have the lengths of the meridian and of the parallel circle there, anywhere. */
START_TEST(small_lengths_are_those_of_the_ellipsoid)
{
    const double a = 6378137, f = 1 / 298.257223563, square = f * (2 - f), step = 1e-4;
    for (double latitude = -85; latitude <= 85; latitude += 17) {
        stereographic s = stereographic_make(ELLIPSOID_WGS84, vec2_make(-179.99, latitude), 1);
        double sine = real_sin(radians(latitude)), root = sqrt(1 - square * sine * sine);
        double meridian = a * (1 - square) / (root * root * root), across = a / root;
        vec2 zero = stereographic_project(&s, vec2_make(180.01, latitude)); /* the same longitude, a turn on */
        vec2 north = stereographic_project(&s, vec2_make(-179.99, latitude + step));
        vec2 east = stereographic_project(&s, vec2_make(-179.99 + step, latitude));
        ck_assert_double_eq_tol(vec2_length(zero), 0, 1e-6);
        ck_assert_double_eq_tol(north.y, meridian * radians(step), 1e-6 * meridian * radians(step));
        ck_assert_double_eq_tol(north.x, 0, 1e-6);
        ck_assert_double_eq_tol(east.x, across * real_cos(radians(latitude)) * radians(step),
                                1e-6 * across * radians(step));
    }
}
END_TEST

/* Around a pole: all longitudes at one latitude are as far from it; across the pole the way is straight. */
START_TEST(poles_are_places_like_others)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        stereographic s = stereographic_make(ELLIPSOID_WGS84, vec2_make(30, 90 * sign), 1);
        vec2 pole = stereographic_project(&s, vec2_make(0, 90 * sign));
        for (double longitude = -150; longitude <= 180; longitude += 30) {
            vec2 p = stereographic_project(&s, vec2_make(longitude, 89.0 * sign));
            /* A degree of the meridian there is 111,694 m; the centre lies 112 m from the pole. */
            ck_assert_double_eq_tol(vec2_length(vec2_sub(p, pole)), 111694, 15);
        }
    }
}
END_TEST

TEST_MAIN("geographic", the_published_example_is_met, small_lengths_are_those_of_the_ellipsoid,
          poles_are_places_like_others)
