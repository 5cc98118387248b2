/* Colours that lie beside each other in pictures, to be told apart by who sees no red or no green too: two of a palette
   differ by 12 at least in CIEDE2000, in daylight as for protanopes and deuteranopes (io/palette tests it).  Knows
   colours alone, red, green and blue from 0 to 1. */
#ifndef IO_PALETTE_H
#define IO_PALETTE_H

enum { PALETTE_LINES = 8, PALETTE_CURVES = 3, PALETTE_PIECES = 8 };
/* Of charts: the first is for what lies behind. */
extern const double palette_lines[PALETTE_LINES][3];
/* Of curves in polar charts. */
extern const double palette_curves[PALETTE_CURVES][3];
/* Of the convex pieces of a hull, which light makes darker and brighter. */
extern const double palette_pieces[PALETTE_PIECES][3];

#endif
