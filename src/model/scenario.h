/* The scenario: everything a run is told, as plain data.  Made once (by io/scenario_file.h, or by scenario_defaults and
   assignments), checked, then never changed.  Its keys, units and defaults stand in scenario_keys.h; member names are
   the keys: `run.solver.iterations` of the file is scenario.run.solver.iterations.  Knows neither files nor physics. */
#ifndef MODEL_SCENARIO_H
#define MODEL_SCENARIO_H

#include "base/array.h"
#include "dynamics/solver.h"
#include "geometry/polygon.h"
#include "ice/field_size.h"
#include "ice/fracture.h"
#include "ice/import.h"
#include "model/scenario_keys.h"
#include "vessel/mooring.h"
#include "vessel/pattern.h"
#include "vessel/station.h"

/* Where the ice comes from. */
typedef enum ice_source { ICE_VORONOI = 0, ICE_FLOES, ICE_NONE, ICE_FILE, ICE_LEVEL, ICE_PACKED } ice_source;
typedef enum population_shape { POPULATION_CONVEX = 0, POPULATION_TEMPLATES } population_shape;
typedef enum floe_shape { FLOE_RECTANGLE = 0, FLOE_REGULAR } floe_shape;
/* Where a vessel's added mass and damping come from, and the axes of given matrices. */
typedef enum hydrodynamics_source {
    HYDRODYNAMICS_NONE = 0,
    HYDRODYNAMICS_ESTIMATE,
    HYDRODYNAMICS_GIVEN
} hydrodynamics_source;
typedef enum matrix_axes { MATRIX_AXES_UP = 0, MATRIX_AXES_DOWN } matrix_axes;
/* What closes the domain. */
typedef enum file_coordinates { FILE_PLANAR = 0, FILE_DEGREES } file_coordinates;
typedef enum domain_boundary { DOMAIN_WALLS = 0, DOMAIN_OPEN, DOMAIN_FEEDING } domain_boundary;

/* Text is held in place, so that a scenario is plain data; longer text is refused. */
enum { SCENARIO_TEXT_SIZE = 512 };
/* Of one vessel: mooring lines, those of a count each, and thrusters. */
enum { VESSEL_LINES_MOST = 64, VESSEL_THRUSTERS_MOST = 32 };
/* The largest seed, 2^53 - 1: a double tells it from its neighbours. */
#define SCENARIO_SEED_MOST 9007199254740991
typedef char scenario_text[SCENARIO_TEXT_SIZE];

/* Types of the members that the rows' specs stand for. */
#define SCENARIO_TYPE_REAL(value, lo, hi) double
#define SCENARIO_TYPE_SCALED(value, at, power, lo, hi) double
#define SCENARIO_TYPE_AUTOMATIC(lo, hi) double
#define SCENARIO_TYPE_INTEGER(value, lo, hi) int64_t
#define SCENARIO_TYPE_BOOLEAN(value) bool
#define SCENARIO_TYPE_CHOICE(type, value, names) type
#define SCENARIO_TYPE_TEXT(value) scenario_text
#define SCENARIO_TYPE_PATH(value) scenario_text
#define SCENARIO_TYPE_SECTION(noun) scenario_##noun
#define SCENARIO_TYPE_LIST(noun, most) scenario_##noun##_list

#define SCENARIO_MEMBER(name, spec, unit, meaning) SCENARIO_TYPE_##spec name;
#define SCENARIO_STRUCT(noun, KEYS)  \
    typedef struct scenario_##noun { \
        KEYS(SCENARIO_MEMBER)        \
    } scenario_##noun;               \
    typedef ARRAY(scenario_##noun) scenario_##noun##_list;

SCENARIO_SECTIONS(SCENARIO_STRUCT)

/* Where the file gave a key: for errors that are found after reading. */
typedef struct scenario_place {
    char key[96]; /* full path, "ice.floes[2].x" */
    int line, column;
    bool override; /* given on the command line, not in the file */
} scenario_place;

/* What stands for the file in errors of a value that was given over those of the file. */
#define SCENARIO_OVERRIDE "(override)"

typedef struct scenario {
    SCENARIO_KEYS(SCENARIO_MEMBER)

    /* Not part of what the scenario says: not printed, not hashed. */
    const size_law *sizes; /* of floes, in place of the file of a histogram; NULL: the file */
    scenario_text file;    /* the file it was read from, or empty */
    scenario_text folder;  /* the working folder when it was read, with a slash at its end, or empty */
    ARRAY(scenario_place) places;
    char vessel_path[24]; /* of its vessel in the list that it was taken out of; empty: it has its own place */
} scenario;

/* An AUTOMATIC value that was left to Fram. */
static inline bool is_automatic(double value) { return value != value; }
/* The value, or `otherwise` when it was left to Fram. */
static inline double automatic_or(double value, double otherwise) { return is_automatic(value) ? otherwise : value; }

/* The default of run.scale. */
double scenario_default_scale(void);
/* Size of what is simulated over full size, by run.scale: by Froude, defaults that are lengths go with it, times and
   speeds with its root. */
static inline double scenario_size(const scenario *s) { return s->run.scale / scenario_default_scale(); }
/* The freeboard of hulls that are given none, in full size [m]. */
#define SCENARIO_FREEBOARD 4.0
static inline double scenario_usual_freeboard(const scenario *s) { return SCENARIO_FREEBOARD * scenario_size(s); }
static inline double scenario_freeboard(const scenario *s, const scenario_hull *h)
{
    return automatic_or(h->freeboard, scenario_usual_freeboard(s));
}
/* Every key at its default for a scaling factor, lists empty.  Allocates nothing. */
void scenario_defaults(scenario *s, double scale);
void scenario_free(context *ctx, scenario *s);

/* Range of every key, then that the keys go together (x_min < x_max, floes with a shape, ...).  FRAM_ERROR_INPUT with
   the key at fault, and its place when the scenario came from a file. */
fram_status scenario_check(const scenario *s, fram_error *error);

/* Fill file, line and column of an error that names a key: where the key was given, or else the innermost section
   around it that was; otherwise only the file.  For errors found while a world is made from the scenario. */
void scenario_locate(const scenario *s, fram_error *error);
/* Fills an error that names a key and has its place: FRAM_ERROR_INPUT. */
fram_status scenario_fault(const scenario *s, fram_error *error, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* The domain from above. */
box2 domain_box(const scenario_domain *d);
/* Whether a place is in it, its edges included; and how far it is from the nearer edge along X, and along Y, negative
   outside. */
bool domain_has(const scenario_domain *d, double x, double y);
vec2 domain_edges_from(const scenario_domain *d, vec2 at);
/* With its walls, where it has such: what pictures show. */
box2 domain_with_walls(const scenario_domain *d);
/* Whether the ice is a field of floes that are drawn or read: what may have populations and open water. */
bool scenario_ice_is_field(const scenario_ice *i);
/* Whether floes are drawn until they cover ice.concentration: for all of a field, or for what a file leaves open. */
bool scenario_ice_is_drawn(const scenario_ice *i);
/* What moves the ice far from vessels: the current at the surface, or where an endless field is told its own, that. */
typedef struct ice_drift {
    const char *file;    /* of a history, in place of the speed; empty: none */
    const char *profile; /* of what a current has on top at depths, the surface among them; empty: none */
    double speed;        /* [m/s] */
    double towards_deg;  /* of the speed */
    bool fed;            /* the field is endless */
    bool own;            /* and this is its own drift (domain.drift_*), not the current */
} ice_drift;
ice_drift scenario_drift(const scenario *s);
/* The current by itself, whatever the ice drifts with. */
ice_drift scenario_current(const scenario *s);
/* Whether speed and direction are all there is to it: no file has a part in it. */
static inline bool ice_drift_is_of_keys(const ice_drift *d) { return !d->file[0] && !d->profile[0]; }
/* The step whose time is nearest to one [s]; steps of an interval [s], one at least. */
int64_t scenario_step_at(double time, double time_step);
int64_t scenario_steps_of(double interval, double time_step);
/* The same of an interval that may be 0, for never: 0 steps then. */
int64_t scenario_interval_steps(double interval, double time_step);
/* Horizontal velocity [m/s] of a speed and a direction in degrees, as keys give them. */
vec3 scenario_velocity(double speed, double direction_deg);

/* Steps that loads are averaged over, one at least, and how long these are [s]: output.averaging_window itself where it
   is whole steps, within rounding. */
int64_t scenario_averaging_steps(const scenario *s);
double scenario_averaging_window(const scenario *s);
/* Whether averages, the first one at this time [s], reach back to before the start of the run, where there is no load,
   and the window is a part that matters of the span [s] that they are of. */
bool scenario_averages_begin_early(const scenario *s, double first, double span);

/* Where a key, section or list was given; NULL when it was not. */
const scenario_place *scenario_given(const scenario *s, const char *key);

/* A path of the scenario, which is relative to the scenario's own folder, as one that can be opened.  false when it
   does not fit. */
bool scenario_resolve_path(const scenario *s, const char *path, char *out, size_t size);
/* The same of a file that a scenario names: FRAM_ERROR_INPUT, for the key or, where that is NULL, for the file as it is
   named, when it does not fit. */
enum { SCENARIO_PATH_ROOM = 2 * SCENARIO_TEXT_SIZE };
fram_status scenario_file_path(const scenario *s, const char *key, const char *file, char out[SCENARIO_PATH_ROOM],
                               fram_error *error);
/* The same of the file that the scenario was read from; false, too, where there is none. */
bool scenario_own_file(const scenario *s, char *out, size_t size);

#endif
