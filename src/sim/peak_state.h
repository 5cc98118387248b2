/* What the watch of peaks (sim/peak_watch.h) knows, as bytes of a checkpoint: the peaks so far and the contacts of the
   last averaging window, so that a run that is resumed explains the same peaks as one that was never stopped.  Numbers
   in the byte order of the machine. */
#ifndef SIM_PEAK_STATE_H
#define SIM_PEAK_STATE_H

#include "sim/peak_watch.h"

/* false: no memory. */
bool peak_state_save(peak_watch *p, const world *w, byte_array *out);
/* Into a fresh watch of the world that the bytes were saved with.  FRAM_ERROR_INPUT when they do not fit it: the watch
   then begins anew. */
fram_status peak_state_restore(peak_watch *p, const world *w, const byte_array *saved, fram_error *error);

#endif
