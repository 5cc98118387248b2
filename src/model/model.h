/* The model: all that a world is stepped with and that stays as it was built: method, media and their histories, hulls,
   and what is fixed of each vessel.  What changes stands in the world (world.h), so that a world can be copied,
   compared and written, and any number of worlds can be stepped with one model.  Plain data, no physics. */
#ifndef MODEL_MODEL_H
#define MODEL_MODEL_H

#include "dynamics/collision.h"
#include "dynamics/rest.h"
#include "dynamics/solver.h"
#include "fluid/columns.h"
#include "fluid/flow_apply.h"
#include "fluid/response.h"
#include "ice/crushing.h"
#include "ice/drift.h"
#include "ice/fracture.h"
#include "model/scenario.h"
#include "model/scenario_vessel.h"
#include "vessel/approach.h"
#include "vessel/hull.h"

/* Where external forces come from. */
typedef enum force_source {
    FORCES_NONE = 0, /* neither fluid nor gravity acts */
    FORCES_FLUID,    /* water, air and gravity on every body's own surface (fluid/fluid.h) */
    FORCES_COLUMNS   /* the water of the benchmark scenes, with weight */
} force_source;

/* The jets of a vessel's propellers, as fluid/jet.h means them. */
typedef struct wash_model {
    bool active;
    double spread;                          /* C [1] */
    double reach;                           /* in diameters [1] */
    double thruster[VESSEL_THRUSTERS_MOST]; /* diameter of each thruster, in their order [m] */
    int32_t propellers;                     /* of the propulsion */
    double diameter, spacing;               /* of those [m] */
    double z;                               /* of their axes, body frame about the centre of mass [m] */
} wash_model;

/* What is fixed of a vessel: its hull as it was made, and what the fluids do to it. */
typedef struct vessel_model {
    int32_t solid;                   /* of the hull, in model.solids, about the centre of mass */
    vec3 centre;                     /* of mass, ship coordinates [m] */
    double displaced_mass;           /* at the draught [kg] */
    hull_particulars particulars;    /* of a file: measured at z = 0 */
    hull_hydrostatics floats;        /* at the draught, ship coordinates */
    double yielding;                 /* of its fenders: depth over force; 0: rigid [m/N] */
    char name[VESSEL_NAME_MOST + 1]; /* "" without */
    approach_settings approach;
    wash_model wash;
    vec2_array plan; /* convex outline of the whole hull seen from above, about the centre of mass [m] */
    bool has_hydrodynamics;
    hydrodynamics hydrodynamics;
    hull_flows flows;
} vessel_model;
typedef ARRAY(vessel_model) vessel_model_array;

typedef struct model {
    double time_step;   /* [s] */
    int32_t step_parts; /* such steps that a step of the run takes: 1, or more where shorter ones are tried */
    force_source forces;
    media media;           /* where the histories do not say otherwise */
    media_history history; /* of current, wind and drift */
    drag_coefficients drag[MATERIAL_COUNT];
    prism_response floe_response;
    bool ventilation;            /* upper faces of floes are dry until water has run over them (fluid/flooding.h) */
    const column_water *columns; /* of FORCES_COLUMNS, else NULL */
    collision_settings collision;
    pair_policies policies;
    crushing_settings crushing;
    fracture_settings fracture;
    drift_definition sheet; /* of level ice that drifts; its grid at the start is that of fracture */
    bool brash;             /* what fracture loses goes to the brash account */
    solver_settings solver;
    rest_settings rest;
    domain_boundary boundary;
    box2 domain;                /* [m] */
    bool drift_given;           /* an endless field goes with `drift`, otherwise with the current at the surface */
    vec2 drift;                 /* [m/s] */
    double speed_limit;         /* a faster body means that the run went wrong [m/s] */
    double course_speed;        /* a ship slower than this over the ground has a heading and no course [m/s] */
    solid_array solids;         /* worlds refer to them: a model stays where it is in memory as long as it has worlds */
    vessel_model_array vessels; /* row i belongs to vessel i */
} model;

void model_free(context *ctx, model *m);

#endif
