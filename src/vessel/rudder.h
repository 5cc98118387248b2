/* Rudders in the race of the propellers (docs/decisions/0380).  Speeds through the water along the ship's axes (x
   forward, y to port), angles positive where they turn the ship to port, forces on the ship.  Knows no vessels. */
#ifndef VESSEL_RUDDER_H
#define VESSEL_RUDDER_H

typedef struct rudder {
    double area;      /* of all of them; 0: none, the thrust itself turns, as that of azimuthing units does [m2] */
    double slope;     /* of their normal force over the sine of the angle of attack [1] */
    double wake;      /* part of the ship's speed that the water at the propellers lacks [1] */
    double disc_area; /* of all propellers [m2] */
    double covered;   /* part of the rudders that the race meets [1] */
    double density;   /* of the water [kg/m3] */
} rudder;

/* Of propellers of this diameter that share the work, one rudder behind each. */
rudder rudder_of(double area, int propellers, double diameter, double block_coefficient, double density);
/* The least area by the rule of Det Norske Veritas [m2]. */
double rudder_area(double length, double beam, double draught, double block_coefficient);

/* Speed of the water past the rudders [m/s]. */
double rudder_speed(const rudder *r, double ahead, double thrust);

/* The largest angle of use where the ship moves so: past it the force to starboard, which turns to port, grows no more.
   A thrust that turns has one of 90 degrees. */
double rudder_most_angle(const rudder *r, double ahead, double aside, double thrust);

typedef struct steering_force {
    double ahead, aside; /* to port [N] */
} steering_force;
/* Of thrust and rudders at a steering angle; aside: velocity of the ship to port where the rudders are; a thrust astern
   leaves the rudders the water that the ship's way brings. */
steering_force rudder_force(const rudder *r, double ahead, double aside, double thrust, double angle);
/* The angle that gives a force to port [N], or the nearest that can be had; now: the present angle. */
double rudder_angle_for(const rudder *r, double ahead, double aside, double thrust, double force, double now);

#endif
