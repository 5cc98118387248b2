/* The largest peaks of the ice load on a vessel, as the run explained them (peaks.fram), and what else its results tell
   of them. */
#ifndef RESULTS_PEAKS_H
#define RESULTS_PEAKS_H

#include "base/peak_picker.h"
#include "io/peak_block.h"
#include "io/text_buffer.h"
#include "results/run_data.h"

typedef struct peak_list {
    int32_t count;
    peak_detail *peak[PEAKS_KEPT]; /* by falling load */
} peak_list;

/* The peaks of a vessel (row); none without a file.  FRAM_ERROR_INPUT when the file is of no run of this Fram. */
fram_status peak_list_read(context *ctx, const char *folder, int32_t vessel, peak_list *list, fram_error *error);
/* The same, with none where the file cannot be read: the first time, as *unread tells, a warning says that `what`, "the
   report", tells no peaks, and why. */
fram_status peak_list_try(context *ctx, const char *folder, int32_t vessel, const char *what, bool *unread,
                          peak_list *list, fram_error *error);
void peak_list_free(context *ctx, peak_list *list);

/* How far before a peak it is told what broke [s]: five seconds at full size, at other scales by Froude. */
double peak_span_before(const scenario *s);
/* How much of it up to a time was recorded: less where a program had the run recorded later [s]. */
double peak_span_recorded(const run_data *d, double time);

/* The floes that broke in that span up to a time: how many by kind.  Parts of a sheet that came loose did not break. */
typedef struct peak_breaks {
    int32_t splits, bendings;
    double last; /* time of the latest, that time itself where both are of one step; NaN without [s] */
} peak_breaks;
peak_breaks peak_breaks_before(const run_data *d, double time);
/* In words: "2 breaks in bending and 1 split". */
void peak_tell_breaks(context *ctx, const peak_breaks *b, text_buffer *out);

/* One sentence about a peak, ended by a full stop. */
void peak_sentence(context *ctx, const run_data *run, const peak_detail *d, text_buffer *out);

/* "crushing"; "crushing at the limit"; "bow"; "inertia"; "its own inertia". */
const char *mechanism_name(ice_mechanism m);
const char *mechanism_text(ice_mechanism m);
const char *peak_zone_name(int32_t zone);
const char *chain_end_name(chain_end e);
const char *chain_end_text(chain_end e);
/* What a body is called that is no floe and ends a chain. */
const char *chain_end_noun(chain_end e);
/* What holds the end of a chain: a vessel that is alone can only have come back to itself, which older runs did not
   tell. */
chain_end peak_end(const run_data *d, const peak_floe *f);
/* The name of the vessel that a chain ends at; NULL: it ends at none, or at one without a name. */
const char *peak_end_vessel(const run_data *d, const peak_floe *f);
/* The mechanism with the largest part. */
ice_mechanism peak_main_mechanism(const double part[MECHANISM_COUNT]);

#endif
