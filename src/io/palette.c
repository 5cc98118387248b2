#include "io/palette.h"

/* Five of Okabe and Ito (2008): vermillion, bluish green, orange, sky blue, and their blue darker. */
const double palette_lines[PALETTE_LINES][3] = {{0.55, 0.67, 0.71}, {0.00, 0.27, 0.55}, {0.84, 0.37, 0.00},
                                                {0.00, 0.62, 0.45}, {0.72, 0.31, 0.56}, {0.90, 0.62, 0.00},
                                                {0.34, 0.71, 0.91}, {0.45, 0.35, 0.30}};

const double palette_curves[PALETTE_CURVES][3] = {{0.00, 0.00, 0.00}, {0.00, 0.62, 0.45}, {0.84, 0.37, 0.00}};

const double palette_pieces[PALETTE_PIECES][3] = {{0.30, 0.64, 0.85}, {0.72, 0.56, 0.31}, {0.63, 0.78, 0.72},
                                                  {0.53, 0.14, 0.27}, {0.32, 0.15, 0.64}, {0.90, 0.91, 0.50},
                                                  {0.12, 0.52, 0.50}, {0.55, 0.34, 0.00}};
