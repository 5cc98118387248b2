/* Sobol's indices and Morris's effects against closed forms. */
#include "testing.h"

#include "base/transcendental.h"
#include "study/sensitivity.h"

/* Ishigami and Homma (1990): sin x1 + 7 sin^2 x2 + 0.1 x3^4 sin x1 of x in (-pi, pi). */
static double ishigami(const double *u)
{
    double x1 = PI * (2 * u[0] - 1), x2 = PI * (2 * u[1] - 1), x3 = PI * (2 * u[2] - 1);
    return real_sin(x1) + 7 * real_sin(x2) * real_sin(x2) + 0.1 * x3 * x3 * x3 * x3 * real_sin(x1);
}

/* Closed form with a = 7, b = 0.1: V = a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2, V1 = (1 + b pi^4/5)^2/2, V2 = a^2/8, V3 =
   0, V13 = b^2 pi^8 (1/18 - 1/50). */
START_TEST(indices_of_ishigamis_function)
{
    enum { N = 4096, K = 3 };
    context ctx;
    context_init(&ctx);
    double *x = calloc((size_t)N * (K + 2) * K, sizeof *x), *y = calloc((size_t)N * (K + 2), sizeof *y);
    ck_assert(sobol_points(&ctx, N, K, 1, x));
    for (int i = 0; i < N * (K + 2); i++)
        y[i] = ishigami(x + (ptrdiff_t)i * K);
    sobol_index s[K];
    ck_assert_int_eq(sobol_indices(&ctx, y, N, K, s), N);
    double p4 = PI * PI * PI * PI, v1 = 0.5 * (1 + 0.1 * p4 / 5) * (1 + 0.1 * p4 / 5), v2 = 49.0 / 8;
    double v13 = 0.01 * p4 * p4 * (1.0 / 18 - 1.0 / 50), v = v1 + v2 + v13;
    assert_relative(v, 49.0 / 8 + 0.1 * p4 / 5 + 0.01 * p4 * p4 / 18 + 0.5, 1e-12);
    const double first[K] = {v1 / v, v2 / v, 0}, total[K] = {(v1 + v13) / v, v2 / v, v13 / v};
    for (int k = 0; k < K; k++) {
        assert_absolute(s[k].first, first[k], 0.03);
        assert_absolute(s[k].total, total[k], 0.03);
        ck_assert(s[k].first_low <= first[k] && first[k] <= s[k].first_high);
        ck_assert(s[k].total_low <= total[k] && total[k] <= s[k].total_high);
    }
    /* Rows that lack an answer are left out, and too few of them say nothing. */
    for (int i = 9; i < N; i++)
        y[i] = (double)NAN;
    ck_assert_int_eq(sobol_indices(&ctx, y, N, K, s), 9);
    ck_assert(isnan(s[0].first) && isnan(s[2].total_high));
    free(x);
    free(y);
}
END_TEST

/* Each column of A and of B meets every stratum once. */
START_TEST(samples_are_hypercubes)
{
    enum { N = 50, K = 4 };
    context ctx;
    context_init(&ctx);
    double x[N * (K + 2) * K];
    ck_assert(sobol_points(&ctx, N, K, 7, x));
    for (int block = 0; block < 2; block++) {
        for (int k = 0; k < K; k++) {
            int met[N] = {0};
            for (int i = 0; i < N; i++)
                met[(int)(x[(block * N + i) * K + k] * N)]++;
            for (int i = 0; i < N; i++)
                ck_assert_int_eq(met[i], 1);
        }
    }
}
END_TEST

/* 3 u1 - 2 u2 + 0 u3 + u1 u4: effects are exact; only u1 and u4 depend on others. */
START_TEST(effects_of_a_polynomial)
{
    enum { R = 40, K = 4 };
    double x[R * (K + 1) * K], y[R * (K + 1)];
    morris_points(R, K, 4, 3, x);
    for (int i = 0; i < R * (K + 1); i++) {
        const double *u = x + (ptrdiff_t)i * K;
        for (int k = 0; k < K; k++)
            ck_assert(u[k] >= 0 && u[k] <= 1 + 1e-12 && fabs(u[k] * 3 - floor(u[k] * 3 + 0.5)) < 1e-9);
        y[i] = 3 * u[0] - 2 * u[1] + u[0] * u[3];
    }
    morris_effect e[K];
    morris_effects(y, x, R, K, e);
    assert_absolute(e[1].mu, -2, 1e-12);
    assert_absolute(e[1].mu_star, 2, 1e-12);
    assert_absolute(e[1].sigma, 0, 1e-12);
    assert_absolute(e[2].mu_star, 0, 1e-12);
    ck_assert(e[0].mu > 3.2 && e[0].mu < 3.8 && e[0].sigma > 0.1);
    ck_assert(e[3].mu > 0.2 && e[3].mu < 0.8 && e[3].sigma > 0.1);
    for (int k = 0; k < K; k++)
        ck_assert_int_eq(e[k].count, R);
}
END_TEST

/* Answers that are all equal, though sums of them round, move by no key; where but one differs, most draws of the
   bootstrap have no variance. */
START_TEST(equal_answers_have_no_indices)
{
    enum { N = 10, K = 2 };
    context ctx;
    context_init(&ctx);
    double y[N * (K + 2)];
    sobol_index s[K];
    for (int i = 0; i < N * (K + 2); i++)
        y[i] = 0.1;
    ck_assert_int_eq(sobol_indices(&ctx, y, N, K, s), N);
    ck_assert(isnan(s[0].first) && isnan(s[1].total) && isnan(s[0].first_low));
    /* Row 3 of B and of its mixture: 65 % of draws have it. */
    y[N + 3] = y[3 * N + 3] = 0.2;
    ck_assert_int_eq(sobol_indices(&ctx, y, N, K, s), N);
    assert_absolute(s[0].total, 0, 0);
    ck_assert(s[1].total > 0.5 && isfinite(s[1].first_low) && isfinite(s[1].total_high));
}
END_TEST

TEST_MAIN("sensitivity", equal_answers_have_no_indices, indices_of_ishigamis_function, samples_are_hypercubes,
          effects_of_a_polynomial)
