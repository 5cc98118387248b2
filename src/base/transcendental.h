/* sin, cos, tan, exp, log, pow, atan2 and friends made of + - * / sqrt only, the same to the bit everywhere
   (glibc picks other bits by processor).  Each is within 1 ulp of the true value over its whole range (measured by
   tests/base/test_transcendental.c); libm's own transcendental functions must not be used from the scenario to the
   state.  A NaN gives NaN, limits are C's: exp(-inf) = 0, log(0) = -inf, atan2(-0, -1) = -pi.  exponential.c and
   trigonometric.c. */
#ifndef BASE_TRANSCENDENTAL_H
#define BASE_TRANSCENDENTAL_H

#define PI 3.14159265358979323846

/* Any finite angle [rad]; infinities give NaN. */
double real_sin(double x);
double real_cos(double x);
double real_tan(double x);

double real_exp(double x);
double real_log(double x); /* NaN for x < 0 */
/* base >= 0; a negative base gives NaN.  Exactly 1 for exponent 0, base for exponent 1, and exact whenever the result
   is a double. */
double real_pow(double base, double exponent);
double real_cbrt(double x);

double real_atan2(double y, double x); /* the angle of (x, y) in [-pi, pi]; 0 or +-pi for the origin, by signs */
double real_acos(double x);            /* NaN for |x| > 1 */

static inline double radians(double degrees) { return degrees * (PI / 180); }
static inline double degrees(double rad) { return rad * (180 / PI); }

#endif
