/* The autopilot of a ship that drives itself: which rate of turn keeps it on its track, and which steering angle gives
   that (docs/decisions/0380).  The rate is that of the track where the ship is going to be, and a correction by
   line of sight (Fossen 2011, 10.3); the angle is what the moments that act ask for.  All of it follows from the ship's
   own data.  Angles and rates positive to port.  Knows no tables, and what the ice does only as a moment that is left
   over. */
#ifndef VESSEL_AUTOPILOT_H
#define VESSEL_AUTOPILOT_H

#include "vessel/manoeuvre.h"
#include "vessel/rudder.h"
#include "vessel/track.h"

/* How a ship turns at its demanded speed in open water: found from its data when it is built (sim/turning.h). */
typedef struct turning_ability {
    double radius; /* of the steady turn at full helm [m] */
    double corner; /* of the arcs of corners and loops: wide enough to be gone into and out of, for two thirds of
                      the helm, so that some is left to correct, and for the helm to stop the turn [m] */
    double reach;  /* speed over the root of the yaw acceleration that this helm gives as it comes over: the way in
                      which a ship takes up a curvature is that times its square [m] */
    double drift;  /* angle between heading and course in a steady turn, over its curvature; 0: no such turn was found,
                      and the distances are the ship's length [m] */
    double speed;  /* all that at this speed [m/s] */
} turning_ability;

/* A ship as its autopilot sees it.  The frame is one that turns with the track. */
typedef struct autopilot_view {
    vec2 place;          /* in the track's frame [m] */
    vec2 velocity;       /* past the track, in its frame [m/s] */
    vec2 current;        /* of the water, over the ground as that velocity is, along the frame's axes [m/s] */
    double heading;      /* in its frame [rad] */
    double turn;         /* over the ground [rad/s] */
    double frame_turn;   /* of the track's frame [rad/s] */
    double ahead, aside; /* through the water [m/s] */
    double drag_aside;   /* of the water beside the hull's lift, to port [N] */
    double drag_moment;  /* [N m] */
    double thrust;       /* gross [N] */
    double lookahead;    /* [m] */
    double lag;          /* in which it is to turn as it is told [s] */
    double course_speed; /* slower over the ground it has a heading and no course [m/s] */
} autopilot_view;

/* What a ship with this steering gear can be told to need for it [s]. */
double autopilot_lag(const turning_ability *t, double length, double ahead, double steering_most, double steering_rate);
/* What the ship knows of its motion beyond its data: what ice and wind do, and what is not known of the current. */
typedef struct motion_observer {
    double rate;   /* of turn that is expected [rad/s] */
    double moment; /* that is left over [N m] */
    double drift;  /* angle by which the course is to port of the heading, over that of the turn, in the mean [rad] */
} motion_observer;

/* A ship's steering. */
typedef struct steering_gear {
    const manoeuvring *ship;
    const rudder *rudder;
    double x;     /* of the rudders, forward of the centre of mass [m] */
    double angle; /* present [rad] */
} steering_gear;

/* The rate of turn that is wanted to stay on a track, whose foot is near a way along it [rad/s]. */
double autopilot_rate(const autopilot_view *v, const turning_ability *t, const motion_observer *seen, const track *path,
                      double way);
/* The rate that keeps a heading [rad/s]. */
double autopilot_rate_to(const autopilot_view *v, const turning_ability *t, double heading);
/* The steering angle for a rate of turn [rad]. */
double autopilot_angle(const autopilot_view *v, const steering_gear *g, const motion_observer *seen, double rate);
/* One step of the observer. */
void autopilot_observe(const autopilot_view *v, const turning_ability *t, const steering_gear *g, double dt,
                       motion_observer *seen);

#endif
