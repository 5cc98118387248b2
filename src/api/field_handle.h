/* What stands behind fram_field. */
#ifndef API_FIELD_HANDLE_H
#define API_FIELD_HANDLE_H

#include "api/handles.h"
#include "fram/field.h"
#include "io/path.h"
#include "sim/draw_ice.h"

struct fram_field {
    fram_context *context;
    bool generated;      /* by a scenario */
    import_rings source; /* of a file, also of that of a scenario, then without the rings themselves */
    import_field floes;  /* those of a file come first and have a ring each, drawn ones have none */
    drawn_ice drawn;     /* of a scenario, without what is in source and floes */
    bool tile;           /* of a scenario that is fed: what repeats itself */
    bool other_ice;      /* some are not as strong as the scenario's ice, or do not break: files keep nothing of it */
    double target;       /* concentration that the scenario asks for, or NaN [1] */
    box2 window;         /* what is shown [m] */
    vec2 period;         /* of an endless field, whose tile is the window; 0, 0: it ends [m] */
    fram_field_definition made;
    fram_field_summary about;
    text_buffer read; /* paths from the root of the files that it is made of, each ended by a NUL */
};

/* Measures the outlines: window (unless given by a scenario) and summary. */
fram_status field_describe(fram_field *f, overlay *plane, const char *name, fram_error *error);
/* What is asked of every output of a field: neither is NULL, and nothing is written over a file that the field is made
   of.  FRAM_ERROR_USAGE, key "path" for that. */
fram_status field_check_output(const fram_field *f, const char *path, fram_error *error);

#endif
