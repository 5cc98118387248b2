/* Exact sign of the 3 x 3 determinant of differences; see predicate3.h. */
#include "geometry/predicate3.h"

#include "geometry/expansion.h"

/* Relative errors of Shewchuk (1997), section 4.3, with e = 2^-53: of the plain determinant, (7 + 56 e) e; of the exact
   one of rounded differences, (3 + 28 e) e; of the latter corrected to first order, (26 + 288 e) e^2; of an estimate,
   (3 + 8 e) e. */
#define HALF_ULP 1.1102230246251565e-16
#define PLAIN_ERROR ((7 + 56 * HALF_ULP) * HALF_ULP)
#define ROUNDED_ERROR ((3 + 28 * HALF_ULP) * HALF_ULP)
#define CORRECTED_ERROR ((26 + 288 * HALF_ULP) * HALF_ULP * HALF_ULP)
#define ESTIMATE_ERROR ((3 + 8 * HALF_ULP) * HALF_ULP)

/* Rows are a - d, b - d, c - d as head and exact tail: the determinant of heads + tails has the sign that is asked for
   (with the sign turned, because d is the origin). */
typedef struct differences {
    double head[3][3], tail[3][3];
    bool exact; /* all tails are zero */
} differences;

static double tail_of_difference(double a, double b, double difference)
{
    double b_part = a - difference, a_part = difference + b_part;
    return (a - a_part) + (b_part - b);
}

static void find_tails(differences *m, const vec3 *p, vec3 d)
{
    m->exact = true;
    for (int i = 0; i < 3; i++) {
        m->tail[i][0] = tail_of_difference(p[i].x, d.x, m->head[i][0]);
        m->tail[i][1] = tail_of_difference(p[i].y, d.y, m->head[i][1]);
        m->tail[i][2] = tail_of_difference(p[i].z, d.z, m->head[i][2]);
        for (int k = 0; k < 3; k++)
            m->exact = m->exact && m->tail[i][k] == 0;
    }
}

/* Add x y z exactly to an expansion with room for n + 4. */
static int add_triple(double *e, int n, double x, double y, double z)
{
    double product, tail;
    if (x == 0 || y == 0 || z == 0)
        return n;
    exact_product(x, y, &product, &tail);
    n = expansion_add_product(e, n, tail, z);
    return expansion_add_product(e, n, product, z);
}

/* The determinant of the heads: sum over rows i of z_i (x_j y_k - x_k y_j).  At most 24 components. */
static int determinant_of_heads(const differences *m, double *e)
{
    int n = 0;
    for (int i = 0; i < 3; i++) {
        const double *row = m->head[i], *next = m->head[(i + 1) % 3], *last = m->head[(i + 2) % 3];
        n = add_triple(e, n, next[0], last[1], row[2]);
        n = add_triple(e, n, -last[0], next[1], row[2]);
    }
    return n;
}

/* First order in the tails. */
static double tail_correction(const differences *m)
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        const double *row = m->head[i], *next = m->head[(i + 1) % 3], *last = m->head[(i + 2) % 3];
        const double *row_t = m->tail[i], *next_t = m->tail[(i + 1) % 3], *last_t = m->tail[(i + 2) % 3];
        sum += row[2] * ((next[0] * last_t[1] + last[1] * next_t[0]) - (next[1] * last_t[0] + last[0] * next_t[1])) +
               row_t[2] * (next[0] * last[1] - next[1] * last[0]);
    }
    return sum;
}

/* Every product of heads and tails: 6 x 8 triples of 4 components. */
static int exact_determinant_sign(const differences *m)
{
    double e[192];
    int n = 0;
    for (int i = 0; i < 3; i++)
        for (int part = 0; part < 8; part++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            const double(*row)[3] = part & 1 ? m->tail : m->head;
            const double(*x)[3] = part & 2 ? m->tail : m->head;
            const double(*y)[3] = part & 4 ? m->tail : m->head;
            n = add_triple(e, n, x[j][0], y[k][1], row[i][2]);
            n = add_triple(e, n, -x[k][0], y[j][1], row[i][2]);
        }
    return expansion_sign(e, n);
}

static int sign(double x) { return (x > 0) - (x < 0); }

/* Sign of the determinant where plain arithmetic does not tell; scale is its permanent. */
static int adaptive_sign(differences *m, const vec3 *p, vec3 d, double scale)
{
    double e[24];
    int n = determinant_of_heads(m, e);
    double estimate = expansion_estimate(e, n);
    if (fabs(estimate) > ROUNDED_ERROR * scale)
        return sign(estimate);
    find_tails(m, p, d);
    if (m->exact)
        return expansion_sign(e, n);
    double corrected = estimate + tail_correction(m);
    if (fabs(corrected) > CORRECTED_ERROR * scale + ESTIMATE_ERROR * fabs(estimate))
        return sign(corrected);
    return exact_determinant_sign(m);
}

int orientation3(vec3 a, vec3 b, vec3 c, vec3 d)
{
    const vec3 p[3] = {a, b, c};
    differences m;
    for (int i = 0; i < 3; i++) {
        m.head[i][0] = p[i].x - d.x;
        m.head[i][1] = p[i].y - d.y;
        m.head[i][2] = p[i].z - d.z;
    }
    double det = 0, scale = 0;
    for (int i = 0; i < 3; i++) {
        const double *row = m.head[i], *next = m.head[(i + 1) % 3], *last = m.head[(i + 2) % 3];
        double left = next[0] * last[1], right = last[0] * next[1];
        det += row[2] * (left - right);
        scale += fabs(row[2]) * (fabs(left) + fabs(right));
    }
    double bound = PLAIN_ERROR * scale;
    if (fabs(det) > bound)
        return -sign(det);
    /* A scale of zero means that every product is: flat boxes and walls end here. */
    return scale > 0 ? -adaptive_sign(&m, p, d, scale) : 0;
}
