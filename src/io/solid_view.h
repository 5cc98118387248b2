/* Pictures of solids in space without a screen or graphics card: triangles in perspective with a depth buffer, shaded
   flat, the edges smoothed.  Z is up.  Colours are r g b from 0 to 1.  Knows nothing of what the triangles are. */
#ifndef IO_SOLID_VIEW_H
#define IO_SOLID_VIEW_H

#include "base/context.h"
#include "base/vec.h"

typedef struct solid_camera {
    vec3 eye, target; /* not one above the other [m] */
    double zoom;      /* height of the picture over the distance, of what fills it: 1.374 sees 40 degrees */
} solid_camera;

/* Rows of fine pixels, SOLID_FINE to a pixel of the picture both ways. */
enum { SOLID_FINE = 2 };
typedef struct solid_view {
    context *ctx;
    int width, height; /* fine pixels */
    vec3 eye, right, up, ahead;
    double focal;         /* fine pixels */
    double nearest;       /* depth from which on things are drawn [m] */
    float *nearness;      /* 1 over the depth along `ahead` [1/m]; 0: nothing there */
    unsigned char *pixel; /* r g b */
} solid_view;

/* A picture of width x height pixels with nothing but sky. */
fram_status solid_view_begin(context *ctx, const solid_camera *camera, int width, int height, const double sky[3],
                             solid_view *v, fram_error *error);
/* Seen from the side where its corners run counter-clockwise. */
void solid_view_triangle(solid_view *v, vec3 a, vec3 b, vec3 c, const double rgb[3]);
/* A thin line that is seen in front of faces it lies on. */
void solid_view_line(solid_view *v, vec3 a, vec3 b, const double rgb[3]);
/* The plane z = 0, let through by 1 - `cover`; after all that it may hide. */
void solid_view_water(solid_view *v, const double rgb[3], double cover);
/* Place of a point in the picture [pixels, from its top left corner]; false behind the eye. */
bool solid_view_place(const solid_view *v, vec3 p, double *x, double *y);
/* The picture as rows of `stride` bytes, four a pixel: b g r and one that is not used. */
void solid_view_copy(const solid_view *v, unsigned char *to, int stride);
void solid_view_free(solid_view *v);

#endif
