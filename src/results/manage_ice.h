/* What lies in a window of an ice field, and how far off the ice is that nobody has broken yet: the measures of ice
   management.  Sizes are diameters of discs of the same area.  Pure geometry; knows no runs. */
#ifndef RESULTS_MANAGE_ICE_H
#define RESULTS_MANAGE_ICE_H

#include "base/context.h"
#include "geometry/polygon.h"
#include "ice/managed_ice.h"

/* A floe as it lies at a moment. */
typedef struct manage_floe {
    polygon outline; /* global plan; may be clockwise or touch itself */
    box2 box;
    double area;      /* [m2] */
    bool sheet;       /* part of level ice that is still whole: larger than any floe */
    double thickness; /* [m] */
} manage_floe;

/* A rectangle: `length` along, `width` across. */
typedef struct manage_window {
    vec2 centre, along; /* along: unit */
    double length, width;
} manage_window;

/* Upper sizes of the classes, in full size [m]; above the last one more class, and the sheet beside them. */
enum { MANAGE_CLASSES = 10 };
extern const double manage_class_size[MANAGE_CLASSES];

/* Areas over that of the window. */
typedef struct manage_cover {
    double ice;                          /* all: the concentration */
    double managed;                      /* of floes no larger than the limit */
    double sheet;                        /* of unbroken level ice */
    double of_class[MANAGE_CLASSES + 1]; /* of floes, by size; the sum with `sheet` is `ice` */
    double size_area;                    /* of floes, each times its size [m] */
    double largest;                      /* size of the largest floe of which a part lies in it; 0: none [m] */
} manage_cover;

double manage_size(double area);
/* limit: the largest size that counts as managed [m].  fine: the same by finer bins of size, with the volume; may be
   NULL.  unit: a metre of full size in the ice that is measured [m]; classes and bins are of full size. */
fram_status manage_measure(context *ctx, const manage_floe *floes, int32_t count, const manage_window *window,
                           double limit, double unit, manage_cover *out, managed_cover *fine, fram_error *error);

/* Unmanaged ice in a strip that begins at a vessel: infinite distances where there is none. */
typedef struct manage_threat {
    double nearest; /* way along the strip to the first of it [m] */
    double largest; /* to the largest of it: the sheet where there is one, else the largest floe [m] */
    double size;    /* of that floe; infinity: the sheet; 0: none [m] */
} manage_threat;

/* The strip: a window whose `along` points away from the vessel, which is at its near end. */
fram_status manage_threat_in(context *ctx, const manage_floe *floes, int32_t count, const manage_window *strip,
                             double limit, manage_threat *out, fram_error *error);

#endif
