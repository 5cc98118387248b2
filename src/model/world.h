/* The world: all that changes in a simulation, as the rooms' tables strung together, and the scratch of one step; what
   it is stepped with stands in the model (model.h).  Plain data: init, free, copy, hash.  No physics. */
#ifndef MODEL_WORLD_H
#define MODEL_WORLD_H

#include "dynamics/collision.h"
#include "dynamics/joint.h"
#include "dynamics/rest.h"
#include "dynamics/solver.h"
#include "fluid/fluid.h"
#include "ice/crushing.h"
#include "ice/drift.h"
#include "ice/edge_rows.h"
#include "ice/feeding.h"
#include "ice/floe.h"
#include "ice/fracture.h"
#include "model/inputs.h"
#include "model/mechanism.h"
#include "model/model.h"
#include "vessel/approach.h"
#include "vessel/mooring.h"
#include "vessel/propulsion.h"
#include "vessel/station.h"

/* One row. */
#define CLOCK_FIELDS(X)                                                                                 \
    X(step, int64_t, FIELD_I64, 1, "1", "steps done")                                                   \
    X(time, double, FIELD_F64, 1, "s", "simulated time = step * time step")                             \
    X(next_floe, int32_t, FIELD_I32, 1, "1", "next running number of a floe")                           \
    X(ice_left, double, FIELD_F64, 1, "kg", "mass of ice that left through an open boundary")           \
    X(ice_lost, double, FIELD_F64, 1, "kg", "mass of ice booked as lost in fracture")                   \
    X(ice_gained, double, FIELD_F64, 1, "kg", "mass booked as gained where outlines were cleaned")      \
    X(ice_crushed, double, FIELD_F64, 1, "kg", "mass of static ice cut away where the hull had been")   \
    X(brash_mass, double, FIELD_F64, 1, "kg", "mass of pieces too small to be floes, kept as brash")    \
    X(brash_momentum, vec3, FIELD_F64, 3, "N s", "their momentum when they became brash, global frame") \
    X(splits, int64_t, FIELD_I64, 1, "1", "floes that split")                                           \
    X(bendings, int64_t, FIELD_I64, 1, "1", "floes that broke in bending")                              \
    X(work_crushed, double, FIELD_F64, 1, "J", "energy dissipated by rows at their crushing limit")
TABLE_DECLARE(clock, CLOCK_FIELDS)

/* The ice loads of the last steps: for each vessel a ring of as many rows as the averaging window has steps, the oldest
   overwritten.  Steps follow one another, the vessels of a step stand together: load_window_row(). */
#define LOAD_WINDOW_FIELDS(X)                                                                      \
    X(force, vec3, FIELD_F64, 3, "N", "ice force on the vessel, mean over the step, global frame") \
    X(moment, vec3, FIELD_F64, 3, "N m", "ice moment about its centre of mass, global frame")
TABLE_DECLARE(load_window, LOAD_WINDOW_FIELDS)

/* What other hulls and walls did to each vessel in the last step.  Empty until the first such contact. */
#define HULL_CONTACT_FIELDS(X)                                                                              \
    X(force, vec3, FIELD_F64, 3, "N", "of hulls and walls on the vessel, mean over the step, global frame") \
    X(moment, vec3, FIELD_F64, 3, "N m", "about its centre of mass, global frame")
TABLE_DECLARE(hull_contact, HULL_CONTACT_FIELDS)

/* Which bodies the record already knows, one row per body slot that it has seen. */
#define RECORDED_FIELDS(X) X(generation, uint32_t, FIELD_U32, 1, "1", "generation in the record, 0: none")
TABLE_DECLARE(recorded, RECORDED_FIELDS)

/* What the ice does to one vessel in a step: means over the step, on the vessel, global frame, moments about its centre
   of mass. Scratch. */
typedef struct ice_load {
    wrench total;
    wrench capped;    /* normal forces of contacts at their crushing limit */
    wrench below_cap; /* normal forces of the others */
    wrench friction;
    wrench zone[ZONE_COUNT];           /* total, split by hull zone */
    wrench mechanism[MECHANISM_COUNT]; /* total, split by what makes it (sim/mechanisms.h) */
    int32_t contacts;
    wrench hulls; /* no ice: of other hulls and of walls */
} ice_load;

/* What the water that moves with a vessel exerts on it in a step: added mass and linear damping.  Scratch. */
typedef struct hull_response {
    vec3 force;    /* mean over the step, global frame [N] */
    vec3 velocity; /* of the centre of mass before the step [m/s] */
} hull_response;

/* What a jet does to a floe in a step.  Scratch. */
typedef struct wash_push {
    int32_t body;
    wrench load;
} wash_push;

typedef struct world {
    /* State: everything that outlives a step; world_tables() lists the tables. */
    clock_table clock;
    body_table bodies;
    shape_store shapes; /* its solids are the model's */
    floe_table floes;
    vessel_table vessels;
    joint_table joints;
    pair_table pairs;
    broad_table boxes;
    contact_memory_table memory;
    load_window_table load_window;
    recorded_table recorded;
    hull_contact_table hull_contacts; /* row i belongs to vessel i, or none */
    line_table lines;
    thruster_table thrusters;
    waypoint_table waypoints;
    station_table stations; /* row i belongs to vessel i */
    event_table events;
    feeding_table feeding; /* one row, or none */
    pattern_table pattern;
    pattern_vertex_table pattern_vertices;
    input_table inputs;
    drift_table drift; /* one row, or none */
    drift_cell_table drift_cells;
    drift_vertex_table drift_vertices;
    propulsion_table propulsion; /* a row for each vessel that drives itself */
    course_table course;
    approach_table approaches; /* a row for each vessel that watches and each other one */
    edge_load_table edge_loads;
    edge_support_table edge_supports;
    hull_retreat_table hull_retreats;
    pattern_copy_table pattern_copies;
    held_drag_table held_drag; /* a row for every eight body slots, where there is water */
    flooding_table flooding;   /* a row for each body slot, with ventilation */
    rest_table rest;           /* a row for each body slot, where floes may fall asleep */

    /* Scratch: written anew each step. */
    struct {
        int64_t step;            /* that left what follows; 0: none, as when a state was loaded */
        ARRAY(wrench) loads;     /* one per body slot */
        ARRAY(double) submerged; /* volume, one per body slot [m3] */
        ARRAY(fluid_load) fluid; /* one per solid of the shape store; rows of static bodies mean nothing */
        contact_array contacts;
        ARRAY(uint32_t) contact_generations; /* of each body slot, when the contacts were found */
        index_array patch_pairs;
        crushing_patch_array patches;
        edge_rows_work edge_rows;
        int32_array load_contacts;      /* rows of contacts with a hull, and of those at their limit */
        ARRAY(double) contact_work;     /* of each of them: energy that it dissipates in crushing [J] */
        ARRAY(ice_load) ice_loads;      /* one per vessel */
        ARRAY(ice_share) shares;        /* the vessels' contacts with other bodies that carry something */
        int32_array web_first;          /* sim/force_chain.h: one per body slot */
        int32_array web_next;           /* two per contact */
        ARRAY(hull_response) responses; /* one per vessel */
        ARRAY(wash_push) wash;          /* of one jet */
        ARRAY(vec3) wash_force;         /* of each vessel on all floes; empty without wash [N] */
        fracture_event_array fractures;
        solver_report solver;
        rest_seen rest_seen;
        feeding_near feeding_near;
        collision_scratch *collision;
        crushing_scratch *crushing;
        fracture_scratch *fracture;
        solver *solve;
        overlay *plane;
    } scratch;

    bool without_ice; /* made to look at its vessels alone (sim/build.h, build_check): what ice it had is not known */
} world;

/* One entry of the list of state tables. */
typedef struct world_table {
    const table_info *info;
    void *table;
} world_table;
enum { WORLD_TABLE_COUNT = 36 };
/* The state tables in their fixed order. */
void world_tables(const world *w, world_table out[WORLD_TABLE_COUNT]);

/* An empty world of a model, which must stay where it is until the world is freed. */
fram_status world_init(context *ctx, const model *m, world *w, fram_error *error);
/* dst, which is not yet a world, becomes one of the same model in the same state; what the last step left for readers
   (contacts, patches, loads, fractures, the solver's report) comes along. */
fram_status world_copy(context *ctx, const world *src, world *dst, fram_error *error);
void world_free(context *ctx, world *w);
/* Debug builds call this before each step: the scratch of the step before becomes garbage (all bits set, so that reals
   are not numbers), and a stage that reads what it should have written is found.  Allocated scratch objects are left
   alone. */
void world_poison_scratch(world *w);
/* 64-bit hash of the whole state, but for `recorded`, which is no part of what is simulated: a world has the same hash
   whether it is recorded or not.  Inputs, and contacts between hulls, count from the first on. */
uint64_t world_hash(const world *w);
/* Whether a slot had none, or another body, when the contacts of the last step were found. */
bool world_came_since_contacts(const world *w, int32_t slot);
/* What scratch remembers of the state goes: call it when the tables are given another one. */
void world_forget(world *w);
/* dst's state becomes src's; both are of the same model. */
fram_status world_copy_state(context *ctx, world *dst, const world *src, fram_error *error);
/* The first differing table, field and row of two states, as text; false when they are equal. */
enum { WORLD_DIFFERENCE_SIZE = 200 };
bool world_difference(const world *a, const world *b, char text[WORLD_DIFFERENCE_SIZE]);

/* How far a body reaches from its centre of mass [m]; 0 without a shape. */
double world_reach(const world *w, int32_t body);
/* How far from an axis through its centre of mass, of any length, global: what turns about it is fastest there [m]. */
double world_reach_about(const world *w, int32_t body, vec3 axis);

/* Steps of the load window; 0 without vessels. */
int64_t load_window_length(const world *w);
/* Row of the load window for a vessel at the end of a step. */
int64_t load_window_row(const world *w, int64_t step, int32_t vessel);

/* Of the table, without those that are gone. */
int32_t world_floe_count(const world *w);

#endif
