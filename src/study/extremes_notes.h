/* Sentences of what the data do not carry.  One module with extremes, whose inside this is. */
#ifndef STUDY_EXTREMES_NOTES_H
#define STUDY_EXTREMES_NOTES_H

#include "study/extremes.h"

/* A result without an answer. */
void extremes_begin(extreme_result *out, extreme_method method, const extreme_request *ask);
/* No answer, and why; returns FRAM_OK: that the data do not carry an answer is one. */
fram_status extremes_refuse(extreme_result *out, const char *why);
fram_status extremes_refuse_few(extreme_result *out);
/* Of rates, too few batches of so many time scales. */
fram_status extremes_refuse_scales(extreme_result *out);
/* No series holds a block. */
fram_status extremes_refuse_short(extreme_result *out);
/* No law fits the sample (ascending); of maxima, laws up to a shape (0: of peaks). */
fram_status extremes_refuse_sample(extreme_result *out, const double *sorted, int32_t count, double shape);
/* The same of the runs of a condition that all came to one value, with what to do about it; idle: they met no ice. */
void extremes_doubt_alike(extreme_result *out, bool idle);
/* The law is one of values over `least`: levels that are not are not told. */
void extremes_cut_low(extreme_result *out, int levels, double least);
/* What speaks against an answer that was found, of data that are `time` long [s]. */
void extremes_doubt(extreme_result *out, const extreme_request *ask, double time);
/* Where the sample (ascending) speaks for another tail than Gumbel's: the ratio of likelihoods (Coles 2001, 3.3). */
bool extremes_against_gumbel(const double *sorted, int32_t count);
void extremes_doubt_gumbel(extreme_result *out, const double *sorted, int32_t count);
/* Where the largest of the sample (ascending) is one that the law of peaks hardly ever has, or passes far more often.
 */
void extremes_doubt_largest(extreme_result *out, const double *sorted, int32_t count);
/* Tensions of runs in which lines parted are told up to the least that was the largest of such a run [N], infinite:
   all; offsets have no levels, since the vessel drifts on from there. */
void extremes_cut_parted(extreme_result *out, int levels, int32_t parted, int32_t runs, bool offset, double least);
/* The same of the series: halves that differ (study/steadiness.h).  Of a series without an answer, where that may come
   of its time scale, it stands first: blocks and batches are of so many of them, and these are then those of the
   change. Where what was asked for is in the way of the answer it is not told.  FRAM_ERROR_MEMORY. */
fram_status extremes_doubt_series(context *ctx, extreme_result *out, const extreme_request *ask, const series_set *s,
                                  fram_error *error);

/* Of rates: draws without a fit, and a tail that does not go on as it begins. */
void extremes_doubt_tail(extreme_result *out, const acer_doubt *doubt);

#endif
