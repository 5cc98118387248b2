#include "fluid/held_drag.h"

#define TABLE_SELF held_drag_table
TABLE_DEFINE(held_drag, HELD_DRAG_FIELDS)
#undef TABLE_SELF
