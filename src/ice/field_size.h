/* Laws of floe size: the diameter of the disc of a floe's area, by number.  Knows no shapes and no places. */
#ifndef ICE_FIELD_SIZE_H
#define ICE_FIELD_SIZE_H

#include "base/array.h"

typedef ARRAY(double) real_array;

typedef enum size_law_kind {
    SIZE_CONSTANT = 0, /* mean */
    SIZE_UNIFORM,      /* lo to hi */
    SIZE_LOGNORMAL,    /* mean and deviation of the diameter itself, cut to lo .. hi */
    SIZE_POWER,        /* N(>D) ~ D^-exponent, lo to hi */
    SIZE_HISTOGRAM     /* bins */
} size_law_kind;

typedef struct size_law {
    size_law_kind kind;
    double mean, deviation; /* [m] */
    double lo, hi;          /* [m]; hi 0: no limit */
    double exponent;
    const double *edge;   /* bins + 1 ascending edges [m] */
    const double *weight; /* of each bin, any common factor; even within a bin */
    int32_t bins;
} size_law;

/* NULL, or what is wrong with the law ("the largest diameter must not be less than the smallest"). */
const char *size_law_fault(const size_law *law);
/* The same of the bins of a histogram; bin: the first at fault, or -1 for all of them together. */
const char *size_bins_fault(const double *edge, const double *weight, int32_t bins, int32_t *bin);
/* The diameter that a part u of all floes is smaller than, 0 <= u <= 1 [m]. */
double size_law_quantile(const size_law *law, double u);
/* Mean area of a floe [m2], by the middles of so many equal slices of the law: fields are drawn by SIZE_SLICES, which
   of a lognormal law take 30 ms. */
enum { SIZE_SLICES = 8192 };
double size_law_mean_area(const size_law *law, int slices);
/* Whether all floes of the law have one diameter, which is `size`. */
bool size_law_is_one_size(const size_law *law, double *size);
/* The part of all floes that is no larger than d. */
double size_law_part(const size_law *law, double d);

/* The fewest diameters that make up `area` [m2] of discs: one from each of n equal slices of the law, at random within
   its slice, all moved within their slices by as much as it takes to meet the area.  So the sample follows the law to
   1/n, whatever the seed, and where the law has any width the area is met: exactly, or to the floe that would have to
   stand in a gap of the law.  Appended in random order.  FRAM_ERROR_INPUT for more than 5 million, FRAM_ERROR_MEMORY;
   `out` is then as it was. */
fram_status size_law_draw(context *ctx, const size_law *law, double area, uint64_t seed, uint32_t stream,
                          real_array *out, fram_error *error);

/* Kolmogorov and Smirnov's distance of a sample from the law; of a law of one diameter the part of the sample that is
   more than 1 % off it.  The sample is sorted by it. */
double size_law_distance(const size_law *law, double *sample, int32_t count);

/* A sample by size, and as many as the law expects of so many: bin i holds up to edge[i + 1], edge[i] excluded (but for
   the first).  The bins cover the sample in equal ratios; the first and the last count what the law has beyond.  What
   is within 1 % of the only diameter of a law counts as of that. */
enum { SIZE_BINS = 12 };
typedef struct size_histogram {
    double edge[SIZE_BINS + 1]; /* [m] */
    int32_t bin[SIZE_BINS];
    double expected[SIZE_BINS];
} size_histogram;
void size_law_histogram(const size_law *law, const double *sample, int32_t count, size_histogram *out);

/* Normal distribution function, to about 1e-15 (Hart 1968, algorithm 5666, as given by West 2005). */
double normal_distribution(double x);

#endif
