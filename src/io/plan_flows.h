/* What moves over a plan: drift of the ice, current and wind at a time, as a scenario has them. One module with
   plan_view, which draws them. */
#ifndef IO_PLAN_FLOWS_H
#define IO_PLAN_FLOWS_H

#include "io/plan_view.h"
#include "model/scenario.h"

enum { PLAN_FLOWS_MOST = 3 };
typedef struct plan_flows {
    plan_flow flow[PLAN_FLOWS_MOST];
    int32_t count;
} plan_flows;

/* Those that are not zero at the time [s].  A file of a history that cannot be read is left out: its run has said so.
 */
plan_flows plan_flows_at(context *ctx, const scenario *s, double time);

#endif
