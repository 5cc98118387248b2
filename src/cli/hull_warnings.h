/* What fram hull warns of in the condition that it was given. */
#ifndef CLI_HULL_WARNINGS_H
#define CLI_HULL_WARNINGS_H

#include "cli/cli.h"

#include "fram/hull.h"

/* Of a file in another unit, or with other axes, as fram check tells of a scenario's. */
void hull_warn_of_file(const common_options *common, const fram_hull_floating *floating);
/* Of masses, water and centres of gravity as no ship has. */
void hull_warn_of_condition(const common_options *common, const fram_hull_condition *condition,
                            const fram_hull_surface *surface, const fram_hull_floating *floating);
/* Of a file of panels, whose readers have the waterline in its z = 0, where the hull floats at another.  output: NULL
   where none is written. */
void hull_warn_of_level(const common_options *common, const fram_hull_condition *condition,
                        const fram_hull_surface *surface, const fram_hull_floating *floating, const char *output);

#endif
