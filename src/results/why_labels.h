/* The names of floes that the picture of a peak cannot colour; with why.h. */
#ifndef RESULTS_WHY_LABELS_H
#define RESULTS_WHY_LABELS_H

#include "io/peak_block.h"
#include "io/plan_view.h"
#include "results/replay_plan.h"

/* A floe that was born and broke between two frames of the record has no outline in it.  Such floes of the peak, those
   of a hundredth of the load at least: a disc at the tail of the force's arrow (`length` metres a newton), where the
   push comes from, its colour the part of the load up to `most` [%].  Returns how many. */
int32_t why_labels(const replay *r, const replay_moment *m, const peak_detail *d, double most, double length,
                   plan_label labels[PEAK_FLOES]);

#endif
