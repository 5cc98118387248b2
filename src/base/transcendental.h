/* sin, cos, tan, exp, log, pow, atan2 and friends made of + - * / sqrt only, the same to the bit everywhere
   (glibc picks other bits by processor).  Accurate to 2 ulp or better on their stated range; libm's own
   transcendental functions must not be used from the scenario to the state. */
#ifndef BASE_TRANSCENDENTAL_H
#define BASE_TRANSCENDENTAL_H

#define PI 3.14159265358979323846

double real_sin(double x); /* |x| <= 1e6 */
double real_cos(double x); /* |x| <= 1e6 */
double real_tan(double x);
double real_exp(double x);
double real_log(double x); /* x > 0 */
double real_pow(double base, double exponent); /* base >= 0 */
double real_atan2(double y, double x);
double real_atan(double x);
double real_asin(double x);
double real_acos(double x);
double real_cbrt(double x);
double real_tanh(double x);

static inline double radians(double degrees) { return degrees * (PI / 180); }
static inline double degrees(double rad) { return rad * (180 / PI); }

#endif
