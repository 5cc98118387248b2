/* Results of a run in the formats of other programs, as pictures, pages and video.  They read the run's folder, of a
   run that ended or goes on, do not change what it is made of, and write files that are whole or not there.  Two
   compute as well, from the run's scenario and the files that this names: fram_why with `rerun` the run from the
   nearest checkpoint, or its start, up to the moment, and a short way to it twice more; fram_pressure the run from a
   checkpoint on.  fram_capability is of a scenario and reads runs only for their ice.  Where `output` may be NULL the
   result goes into the run's folder, and fram_result.path says where, but for fram_compare, which writes no page then.
   A file that is there is replaced; one that the run is made of (series.csv, record.fram, ...) is FRAM_ERROR_USAGE. */
#ifndef FRAM_RESULTS_H
#define FRAM_RESULTS_H

#include "fram/fram.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { FRAM_PATH_ROOM = 4096 }; /* bytes of a path, the NUL included */

typedef struct fram_result {
    char path[FRAM_PATH_ROOM]; /* the file to open */
    int64_t frames;            /* of the record that are in it */
    double time;               /* of the first of them, simulated [s] */
} fram_result;

/* Whether a path names one of the files that the run in the folder is made of, over which nothing is written; false
   without a folder or a path. */
FRAM_API bool fram_run_has_file(const char *run, const char *path);
/* Whether a path names a stream: a descriptor of this program (/dev/stdout, /dev/fd/3), wherever it leads, a pipe or a
   device.  What is written there goes behind what was, and nothing can stand beside it; false without a path. */
FRAM_API bool fram_path_is_stream(const char *path);
/* Whether a file, or a folder, that is not there yet can be made where its path says.  FRAM_ERROR_INPUT says what is in
   the way, as the function would that is to write there: asked before long work. */
FRAM_API fram_status fram_path_check_place(const char *path, bool folder, fram_error *error);

/* ---- Formats of other programs ---- */

/* For ParaView: run.pvd in the folder `output` (RUN/vtk), with floes, hull and forces of every `every`-th frame, in
   place of an earlier export there; other files in it stay. */
FRAM_API fram_status fram_export_vtk(fram_context *context, const char *run, const char *output, int64_t every,
                                     fram_result *result, fram_error *error, size_t size);
#define fram_export_vtk(...) fram_export_vtk(__VA_ARGS__, sizeof(fram_result))
/* Outlines of floes, walls and vessel at a time [s], between frames by interpolation (RUN/field-TIME.geojson); what
   breaks or leaves before the next frame goes on with its velocity.  FRAM_ERROR_INPUT for a time outside the record. */
FRAM_API fram_status fram_export_geojson(fram_context *context, const char *run, const char *output, double time,
                                         fram_result *result, fram_error *error, size_t size);
#define fram_export_geojson(...) fram_export_geojson(__VA_ARGS__, sizeof(fram_result))
/* NetCDF-4, which is HDF5: all channels, all fractures, all floes over the frames that there are (RUN/run.nc).
   FRAM_ERROR_UNSUPPORTED in a build without NetCDF.  After FRAM_ERROR_IO for want of room HDF5 (1.10) may crash in its
   exit handler, when it tries again: leave by _exit. */
FRAM_API fram_status fram_export_netcdf(fram_context *context, const char *run, const char *output, fram_result *result,
                                        fram_error *error, size_t size);
#define fram_export_netcdf(...) fram_export_netcdf(__VA_ARGS__, sizeof(fram_result))

/* ---- For people ---- */

/* One self-contained HTML page about the run (RUN/report.html): scenario, loads with exceedance and confidence, field,
   fractures, station, books, solver quality, origin.  with_paths: it tells where the run's folder and its input files
   lie, not their names alone. */
FRAM_API fram_status fram_report(fram_context *context, const char *run, const char *output, bool with_paths,
                                 fram_result *result, fram_error *error, size_t size);
#define fram_report(...) fram_report(__VA_ARGS__, sizeof(fram_result))

enum { FRAM_PLOT_CHANNELS = 64 }; /* the most channels of a plot */

/* Channels of series.csv over time, those of one unit in one panel, from time `from` to `to` [s] (NaN: all), as SVG
   when output ends in .svg, else as PNG.  channel_count: 1 to FRAM_PLOT_CHANNELS, looked at before channels are.
   FRAM_ERROR_INPUT names a channel that the run does not have. */
FRAM_API fram_status fram_plot(fram_context *context, const char *run, const char *const *channels, int channel_count,
                               double from, double to, const char *output, fram_error *error);
/* "name [unit]" of every channel, a line each; the caller frees it with fram_text_free. */
FRAM_API fram_status fram_channels(fram_context *context, const char *run, char **text, fram_error *error);

typedef struct fram_comparison_row {
    const char *name, *unit; /* valid until the comparison is freed */
    double a, b;             /* NaN where a run does not have it */
} fram_comparison_row;
typedef struct fram_comparison {
    const fram_comparison_row *rows;
    int count;
    bool same_scenario, same_state; /* by hash, the files that a scenario names too; runs that were told the same
                                       things (told_a) are where they ended in the same state, or are one */
    void *inside;
    bool only_files_differ; /* the scenarios are the same but for what is in the files that they name */
    bool same_as_read; /* not by hash, but as this Fram reads both: another one made a run, or scenario.yaml was changed
                        */
    bool changed_a, changed_b;   /* scenario.yaml is not what the run was made of, or another Fram made the run */
    const char *told_a, *told_b; /* what a program told the run in place of its scenario, "wind_x, tug.path"; "":
                                    nothing; valid until the comparison is freed */
    bool only_told_differs;      /* the scenarios are the same but for that, or may be: its numbers stand in no file */
    double counted_from;         /* statistics of both are of what is after it, since the recording of one began late
                                    [s]; 0: each after its transient */
    bool no_time_shared;         /* one had ended by counted_from: no statistics are of both */
} fram_comparison;
/* Two runs in numbers and, unless output is NULL, as an HTML page with plots. */
FRAM_API fram_status fram_compare(fram_context *context, const char *run_a, const char *run_b, const char *output,
                                  fram_comparison *comparison, fram_error *error, size_t size);
#define fram_compare(...) fram_compare(__VA_ARGS__, sizeof(fram_comparison))
FRAM_API void fram_comparison_free(fram_context *context, fram_comparison *comparison, size_t size);
#define fram_comparison_free(...) fram_comparison_free(__VA_ARGS__, sizeof(fram_comparison))

typedef struct fram_video_definition {
    size_t size;           /* of this struct, set by fram_video_default */
    const char *output;    /* NULL: RUN/run.mp4, or the folder RUN/video */
    const char *colour;    /* "plain", "speed", "force", "thickness", "age" */
    double speed;          /* simulated seconds a second; <= 0: such that it lasts 30 s at most */
    const char *camera;    /* "orbit": the whole field in space; "follow": near the vessel; "plan": from above */
    double span;           /* metres across of a plan, following the vessel; <= 0: the whole domain */
    int frames_per_second; /* 25 */
    int width, height;     /* 1280 x 720, even [pixels] */
    bool pictures;         /* numbered PNG files instead of a video: needs no ffmpeg */
    bool force;            /* pictures: into a folder that is not empty, in place of those that are there */
} fram_video_definition;
FRAM_API void fram_video_default(fram_video_definition *definition, size_t size);
#define fram_video_default(definition) fram_video_default((definition), sizeof *(definition))
/* The run as MP4, drawn without a screen.  FRAM_ERROR_UNSUPPORTED when ffmpeg is not installed. */
FRAM_API fram_status fram_video(fram_context *context, const char *run, const fram_video_definition *definition,
                                fram_result *result, fram_error *error, size_t size);
#define fram_video(...) fram_video(__VA_ARGS__, sizeof(fram_result))

/* ---- Why a load was what it was ---- */

typedef struct fram_why_definition {
    size_t size;         /* of this struct, set by fram_why_default */
    int peak;            /* 1: the largest of the run's ten largest peaks of the averaged horizontal load; 0: by time */
    double time;         /* of the moment, with peak 0 [s] */
    const char *vessel;  /* its name; NULL: the first */
    bool rerun;          /* true: compute the second before again, at half the time step and with the accurate solver,
                            from the nearest checkpoint or from the start */
    bool json;           /* the text is one JSON object in SI units */
    const char *picture; /* file of the plan, SVG when its name ends in .svg, otherwise PNG; NULL: none */
    const volatile int *stop; /* non-zero: end with FRAM_INTERRUPTED; may be NULL */
} fram_why_definition;
FRAM_API void fram_why_default(fram_why_definition *definition, size_t size);
#define fram_why_default(definition) fram_why_default((definition), sizeof *(definition))
/* Explains a peak of the ice load: mechanisms, floes, the chains of contacts behind them, what broke before, and
   whether time step and solver matter.  The run's folder is not changed.  A moment that is no recorded peak needs
   `rerun`; of a recorded one that cannot be computed again, as one of another Fram, what is kept is told, and why.
   FRAM_ERROR_INPUT for a folder without a run, a peak or time that it does not have.  The caller frees the text with
   fram_text_free. */
FRAM_API fram_status fram_why(fram_context *context, const char *run, const fram_why_definition *definition,
                              char **text, fram_error *error);

/* ---- Ice management ---- */

typedef struct fram_manage_definition {
    size_t size;        /* of this struct, set by fram_manage_default */
    const char *output; /* the page; NULL: RUN/manage.html */
    const char *vessel; /* the protected one; NULL: the only one that does not drive itself */
    const char *beside; /* folder of another run, without management say; NULL: none */
    double limit;       /* largest size of a floe that counts as managed [m]; 0: the vessel's beam */
    double depth;       /* of the windows of ice along the drift [m]; 0: as the corridor is wide */
    bool json;          /* the text is one JSON object in SI units */
} fram_manage_definition;
FRAM_API void fram_manage_default(fram_manage_definition *definition, size_t size);
#define fram_manage_default(definition) fram_manage_default((definition), sizeof *(definition))
/* What ice came to a vessel: sizes and concentration in windows that drift along, upstream, behind the icebreakers and
   at the vessel; the largest floe that reached it, the managed share, the time until unmanaged ice comes, loads beside
   those of another run.  Writes the page and two tables beside it (manage.csv by time, manage-sizes.csv),
   which are left out, with a warning, where the page goes into a stream.
   FRAM_ERROR_INPUT for a folder without a run or a record, a vessel that is not there or not to be told from others.
   The caller frees the text with fram_text_free. */
FRAM_API fram_status fram_manage(fram_context *context, const char *run, const fram_manage_definition *definition,
                                 fram_result *result, char **text, fram_error *error, size_t size);
#define fram_manage(...) fram_manage(__VA_ARGS__, sizeof(fram_result))

/* ---- Pressure on the hull ---- */

enum { FRAM_PRESSURE_LINES = 10000 }; /* the most frames, and the most stringers */

typedef struct fram_pressure_definition {
    size_t size;                     /* of this struct, set by fram_pressure_default */
    const char *output;              /* folder for the results; must be named */
    double panel;                    /* side of a panel [m]; NaN: 1 at full size, with run.scale/30 at others */
    const double *frames;            /* x of frames, ascending, ship coordinates [m]; in place of every `panel` */
    const double *stringers;         /* z of stringers, ascending [m] */
    int frame_count, stringer_count; /* 0: none */
    double from, to;                 /* 0: steps after `from`, up to `to` [s]; to <= 0: the run's end */
    const char *vessel;              /* its name, where the run has several; NULL: the first */
    bool force;                      /* write into a folder that is not empty */
    const volatile int *stop;        /* non-zero: end with FRAM_INTERRUPTED, nothing written; may be NULL */
} fram_pressure_definition;
FRAM_API void fram_pressure_default(fram_pressure_definition *definition, size_t size);
#define fram_pressure_default(definition) fram_pressure_default((definition), sizeof *(definition))
/* Mean, largest and cumulative ice pressure by panel of the hull (panels.csv, hull.vtp, pressure.png) and the largest
   pressure by area beside that of ISO 19906 (area.csv; of a run.scale from 10 on), and the mean force by zone and
   mechanism (zones.csv).  The run is computed again, every step, from its nearest checkpoint before `from`, so that it
   takes as long as the run did; its folder is not changed.  FRAM_ERROR_INPUT for a folder without a run, a vessel or
   times that it does not have, a panel longer than the hull or so small that it is cut into more than half a million
   pieces, lines that do not ascend; FRAM_ERROR_USAGE where a file that the run's scenario names would be written over.
 */
FRAM_API fram_status fram_pressure(fram_context *context, const char *run, const fram_pressure_definition *definition,
                                   fram_error *error);

/* ---- Capability ---- */

typedef struct fram_capability_definition {
    size_t size;                 /* of this struct, set by fram_capability_default */
    const char *folder;          /* for the results; must be named */
    bool force;                  /* write into a folder that is not empty */
    bool formula;                /* ice load by a published formula for ships in broken ice, not measured */
    double measure;              /* 120: simulated seconds of each run that measures the ice load; formula: no other */
    int directions;              /* 36, evenly round */
    double speed_step;           /* 0.1 [m/s] */
    double speed_most;           /* 1 [m/s] */
    double allowance;            /* 1.25: what mean loads are multiplied by */
    double line_safety;          /* 2: breaking load over the tension that a line may have, intact */
    double line_safety_damaged;  /* 1.43: after a failure */
    const volatile int *stop;    /* non-zero: end with FRAM_INTERRUPTED, nothing written; may be NULL */
    const char *vessel;          /* its name, where the scenario has several, which are left out; otherwise NULL */
    const char *const *ice_from; /* runs' folders: the ice is made after that which came to the vessel there; or NULL */
    int ice_from_count;          /* up to 64 */
    const char *ice_vessel;      /* vessel of the runs that the ice came to; NULL: `vessel`, else as fram_manage */
    double unbroken_as;          /* ice_from: diameter of floes that stand for unbroken ice [m]; 0: none do */
    double window; /* ice_from: side of the square of ice about the vessel [m]; 0: three times its length */
} fram_capability_definition;
FRAM_API void fram_capability_default(fram_capability_definition *definition, size_t size);
#define fram_capability_default(definition) fram_capability_default((definition), sizeof *(definition))
/* From which direction and up to which drift speed the scenario's thrusters and mooring hold its vessel, in a static
   balance, intact and after the worst single failure: capability.csv, capability_use.csv, capability.json,
   capability.png and capability.svg (with pictures) in the folder.  Nothing is written before all is found.
   With ice_from the ice is an endless field of the sizes of floes, the concentration and the thickness that came to a
   vessel in those runs after their transient, right behind icebreakers where they broke it; FRAM_ERROR_INPUT for a
   folder without a run or a record, and when more than a twentieth of that ice was unbroken and unbroken_as is 0. */
FRAM_API fram_status fram_capability(const fram_scenario *scenario, const fram_capability_definition *definition,
                                     fram_result *result, fram_error *error, size_t size);
#define fram_capability(...) fram_capability(__VA_ARGS__, sizeof(fram_result))

#ifdef __cplusplus
}
#endif
#endif
