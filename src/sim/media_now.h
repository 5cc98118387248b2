/* Water and air at a time: as the scenario has them, where nobody has told anything else from outside. */
#ifndef SIM_MEDIA_NOW_H
#define SIM_MEDIA_NOW_H

#include "model/inputs.h"
#include "model/model.h"

/* A wind or a current that was told stands for the constant one and its history; what the current changes with depth
   stays on top of it. */
media media_now(const model *m, const input_table *inputs, double time);

#endif
