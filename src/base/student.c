#include "base/student.h"

#include "base/transcendental.h"

#include <math.h>

/* Beyond, the square of t is no number. */
#define FAR_T 1e100
/* More degrees change a quantile by less than 2e-5, and have more terms than anybody waits for. */
enum { FREEDOM_MOST = 1000000 };

double student_within(double t, int freedom)
{
    if (t > FAR_T)
        return 1;
    double root = sqrt(freedom), angle = real_atan2(t, root), length = sqrt(t * t + freedom);
    double sine = t / length, cosine = root / length, square = cosine * cosine;
    int odd = freedom % 2;
    double term = odd ? cosine : 1, sum = 0;
    /* cos^k with k = 1, 3, ... or 0, 2, ... up to freedom - 2. */
    for (int k = odd; k <= freedom - 2; k += 2) {
        sum += term;
        term *= square * (k + 1) / (k + 2);
    }
    return odd ? (angle + sine * sum) * 2 / PI : sine * sum;
}

double student_quantile(double confidence, int freedom)
{
    double lo = 0, hi = 1;
    if (freedom < 1)
        return (double)NAN;
    freedom = freedom < FREEDOM_MOST ? freedom : FREEDOM_MOST;
    while (student_within(hi, freedom) < confidence && hi < 1e300)
        hi *= 2;
    /* Until the two are neighbours. */
    for (double mid = 0.5 * (lo + hi); mid > lo && mid < hi; mid = 0.5 * (lo + hi)) {
        if (student_within(mid, freedom) < confidence)
            lo = mid;
        else
            hi = mid;
    }
    return hi;
}

double student_half(double confidence, int freedom, double variance)
{
    return isfinite(variance) ? student_quantile(confidence, freedom) * sqrt(variance) : (double)NAN;
}
