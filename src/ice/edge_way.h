/* Loads along one edge: how far a place is from another along the edge of the ice, and what an even load bends the edge
   by there (docs/decisions/0564).  Knows boundaries and numbers, neither floes nor patches. */
#ifndef ICE_EDGE_WAY_H
#define ICE_EDGE_WAY_H

#include "ice/tiles.h"

/* Way along the boundary from a start [m]: on to a segment's a, back to its b; infinite where it was not reached, under
   0 on the start's own. */
typedef struct edge_arc {
    double on, back;
} edge_arc;
typedef ARRAY(edge_arc) edge_arc_array;

/* One arc per segment, from a start on the boundary as far as `reach` both ways.  Ends nearer than `snap` [m] to each
   other are one corner; where several segments leave it, the edge goes on around the ice that it came along. */
bool edge_arcs(context *ctx, const tile_segment_array *line, vec2 start, double snap, double reach,
               edge_arc_array *arcs);

/* Where a place's nearest point of the boundary is [m], and on which segment: along the edge from the start, with the
   ice to the left positive; infinite where the edge does not lead there within reach. */
double edge_way(const tile_segment_array *line, const edge_arc_array *arcs, vec2 place, int32_t *segment);

/* Loads that an edge bears [N], and [N] for each metre that they are wide. */
typedef struct edge_strength {
    double wedges, metre;
} edge_strength;

/* Moment that 1 N, even over `width` along the edge, makes at a way from its middle, over the edge's strength [1/N]:
       1/width (H(way + width/2) - H(way - width/2)),   H(x) = x/(wedges + 2 metre |x|);
   in its middle 1/(wedges + metre width), so that a load that is divided bends the edge as it did whole. */
double edge_share(edge_strength e, double width, double way);

#endif
