/* The block of a record that explains one peak of the ice load on a vessel (BLOCK_PEAK, io/record_layout.h): which
   floes carried it, by which mechanism, and what stood behind them.  Plain data and its bytes. */
#ifndef IO_PEAK_BLOCK_H
#define IO_PEAK_BLOCK_H

#include "base/context.h"
#include "model/mechanism.h"

/* Of a chain of more links the first ones and the last ones are kept. */
enum { PEAK_FLOES = 24, PEAK_CHAINS = 8, PEAK_CHAIN_LINKS = 24, PEAK_LINKS = PEAK_CHAINS * PEAK_CHAIN_LINKS };
enum { PEAK_CHAIN_FIRST = 16 };
enum { PEAK_ZONES = 5 };

/* A body that loads the vessel: means over the averaging window. */
typedef struct peak_floe {
    int32_t number, slot;         /* running number of the floe, -1: a wall or another vessel; slot in the record */
    uint8_t mechanism;            /* the one with the largest part in the direction of their sum */
    uint8_t zone;                 /* where the largest part is, likewise */
    uint8_t links;                /* of its chain, in peak_detail.link: this floe first; 0: not followed */
    uint8_t end;                  /* enum chain_end, with links */
    uint16_t left_out;            /* links of its chain that are not kept, before that of number PEAK_CHAIN_FIRST */
    int16_t end_vessel;           /* row of the vessel at the end, -1: none, or not known */
    vec3 force, point;            /* on the vessel [N]; weighted by the sizes of the contacts' forces [m] */
    double part[MECHANISM_COUNT]; /* along the load [N] */
} peak_floe;

/* A body of a chain, in the step of the peak: sim/force_chain.h. */
typedef struct peak_link {
    int32_t slot, number; /* number -1: no floe, or one that broke in the step */
    vec3 place, push; /* centre of mass, of a body that forces do not move or that broke where it is pushed [m]; [N] */
    double others, water, inertia;
} peak_link;

typedef struct peak_detail {
    double time, load;                        /* of the horizontal load, averaged over the window [N] */
    double window;                            /* [s] */
    int32_t vessel, bodies;                   /* that touch it in the window; the largest PEAK_FLOES are listed */
    vec3 force;                               /* averaged [N] */
    double mechanism[MECHANISM_COUNT];        /* along the load, horizontal; they add up to `load` [N] */
    double zone[PEAK_ZONES][MECHANISM_COUNT]; /* the same by zone of the hull */
    int32_t floe_count, link_count;
    peak_floe floe[PEAK_FLOES]; /* by falling part of the load */
    peak_link link[PEAK_LINKS]; /* chains one after another, of the floes that have one */
} peak_detail;

/* Links are left out between this one, counted from 0, and the one before it. */
static inline bool peak_chain_jumps_to(const peak_floe *f, int32_t link)
{
    return f->left_out > 0 && link == PEAK_CHAIN_FIRST;
}

/* The largest size of a block. */
enum { PEAK_BLOCK_ROOM = 16384 };
/* Numbers in the byte order of this machine, reals of the parts as f32, places from the origin (BLOCK_ORIGIN); returns
   the size. */
size_t peak_block_pack(const peak_detail *d, vec2 origin, unsigned char out[PEAK_BLOCK_ROOM]);
/* Blocks of earlier layouts too.  false: the bytes are no such block. */
bool peak_block_unpack(const void *data, size_t size, vec2 origin, peak_detail *d);

#endif
