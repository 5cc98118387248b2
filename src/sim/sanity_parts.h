/* Inner header of what tells slips (sim/sanity.h): who is told, and what its parts ask of a scenario. */
#ifndef SIM_SANITY_PARTS_H
#define SIM_SANITY_PARTS_H

#include "model/scenario_schema.h"
#include "sim/sanity.h"
#include "sim/usual.h"

typedef struct teller {
    const scenario *s;
    sanity_teller tell;
    const void *to;
    const vessel_entry *e;     /* NULL where no vessel is looked at */
    const world *made;         /* NULL: none, or not asked */
    const model *model;        /* the same */
    const media_history *read; /* what files tell of flows; NULL: not read, or not asked */
} teller;

enum { SANITY_PATTERN = 96 };
/* A path without its indices, and with vessels in a list read as the one vessel. */
void sanity_pattern(const char *path, char out[SANITY_PATTERN]);

/* A hull by its particulars; that of a file has its size in the file. */
static inline bool sanity_own_hull(const scenario_vessel *v) { return v->hull.form != HULL_MESH; }

/* Whether its thrusters push, whatever meets it: positioning looks at no settings. */
static inline bool sanity_has_settings(const scenario_vessel *v)
{
    bool set = false;
    for (int32_t i = 0; i < v->thrusters.count && !v->positioning.active; i++)
        set = set || v->thrusters.data[i].setting != 0;
    return set;
}

/* Whether its thrusters answer to what meets it. */
static inline bool sanity_is_positioned(const scenario_vessel *v)
{
    return v->positioning.active && v->thrusters.count > 0;
}

/* Whether it goes anywhere by itself or as it is led. */
static inline bool sanity_vessel_moves(const scenario_vessel *v)
{
    bool steered = sanity_is_positioned(v) && v->positioning.waypoints.count > 0;
    bool driven = sanity_has_settings(v) || steered || vessel_drives_itself(v);
    return v->speed > 0 || v->path.count > 0 || (v->mode == VESSEL_FREE && driven);
}

/* How far a hull reaches from where its vessel is, turned any way [m]; 0 of one of a file that was not read (NULL). */
double sanity_hull_reach(const scenario_vessel *v, const vessel_model *made);

/* Of what a box of its hull displaces. */
#define SANITY_BLOCK 0.7

/* About the mass of a vessel [kg]; 0: not known. */
static inline double sanity_about_mass(const scenario *s, const scenario_vessel *v)
{
    const scenario_hull *h = &v->hull;
    if (!is_automatic(v->mass) || !sanity_own_hull(v))
        return automatic_or(v->mass, 0);
    return s->environment.water_density * h->length * h->beam * h->draught *
           automatic_or(h->block_coefficient, SANITY_BLOCK);
}

/* The least that the band of an endless field is wide [m], 0 without one: where it is not given it goes by the largest
   floe, of which something is known before it is drawn (sanity_ice.c). */
double sanity_least_band(const scenario *s);

/* Of three poles alike, of either observer, called once in `interval` s [rad/s]. */
double sanity_observer_bandwidth(const scenario *s, const scenario_positioning *p, double interval);

/* Whether some ice takes the strength that is a member of the ice's keys: not where all populations have their own.
   True of any other member. */
bool sanity_is_taken(const scenario_ice *i, const void *member);
/* Whether a member of the keys is the freeboard of a hull from a file, which is added to what that has:
   vessel_mesh_warnings judges the whole. */
bool sanity_is_added(const scenario *s, const void *member);
/* The thinnest ice that takes ice.crushing_strength [m], where some does; NaN: not known. */
double sanity_own_thickness(const scenario_ice *i, const world *made);
/* The crushing pressure on an area of ice of a strength [Pa], and the words that say so after the strength. */
enum { SANITY_ON_AREA = 80 };
double sanity_pressure_on(const scenario_ice *i, double strength, double area, char words[SANITY_ON_AREA]);

#endif
