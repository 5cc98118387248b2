/* Words in the picture of a peak, and names of floes that it cannot colour; with why.h. */
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
/* What the picture shows of the plan: around the middle of what touches the vessel, or the vessel where nothing does,
   and what the chains reach; reach: half its sides [m]. */
box2 why_window(const replay *r, const replay_moment *m, const peak_detail *d, int32_t vessel, double reach);
/* What bears most of the load, if any does, and what the marks in the window are; span: of the crosses [s]; labels: how
   many. */
enum { WHY_CAPTION = 256 };
void why_caption(const peak_detail *d, const replay_plan *plan, box2 window, double span, int32_t labels,
                 char out[WHY_CAPTION]);

#endif
