/* How things stand with the station keeping of a run that ends: what its results page tells beside the time series. */
#ifndef VESSEL_OUTCOME_H
#define VESSEL_OUTCOME_H

#include "vessel/event.h"
#include "vessel/mooring.h"
#include "vessel/thruster.h"

/* The tables belong to the world that ends. */
typedef struct station_outcome {
    double time; /* simulated [s] */
    const line_table *lines;
    const thruster_table *thrusters;
    const event_table *events;
} station_outcome;

#endif
