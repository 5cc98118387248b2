/* How long the steps of a run become as its ice packs or breaks, told from two looks at it.  Knows numbers only. */
#ifndef STUDY_EXTENT_H
#define STUDY_EXTENT_H

/* What a look at some steps of a run found. */
typedef struct step_look {
    double time;     /* of a step [s] */
    double contacts; /* points */
    int floes;
    double at; /* steps since the start */
} step_look;

/* Time of a step when the ice is packed [s]: every contact more takes what it took from one look to the other, and
   there are six points to a floe at most, since of convex floes in the plane less than three pairs to a floe touch
   (Euler's formula), at two points each.  No less than either look. */
double packed_step_time(const step_look *early, const step_look *late);

/* Mean time of the steps of a run [s] in which floes are broken: between the looks the time of a step grew with the
   pieces that were made, and grows so for as long as they stay, `stay` steps (infinite without a drift), and the run
   lasts. No less than the later look; that look itself where the looks saw no more floes. */
double breaking_step_time(const step_look *early, const step_look *late, double steps, double stay);

#endif
