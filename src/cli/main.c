/* fram: the table of commands and the help that teaches them. */
/* ptsname is not in every standard's stdlib.h. */
#define _GNU_SOURCE
#include "cli/cli.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const command_row commands[] = {
    {"run", "SCENARIO -o DIR", "simulate a scenario and write its results to a folder",
     "  fram run scenes/demo.yaml -o out/demo\n"
     "  fram run scenes/demo.yaml -o out/thick --set ice.thickness=1.5 --threads 2\n"
     "  fram run scenes/demo.yaml -o out/half --until 30     stop at 30 s with a checkpoint\n",
     command_run},
    {"resume", "DIR", "continue a run from its newest checkpoint",
     "  fram resume out/half --until 45\n"
     "  fram resume out/half\n",
     command_resume},
    {"check", "SCENARIO", "check a scenario; print it with every default filled in, and what follows from it",
     "  fram check scenes/demo.yaml\n"
     "  fram check scenes/demo.yaml --set ice.concentration=0.7 > full.yaml\n"
     "  fram check scenes/packed_field.yaml --build\n",
     command_check},
    {"bench", "SCENARIO | --scene FILE", "time the steps of a scenario, without output",
     "  fram bench scenes/demo.yaml --warm 5 --time 10\n"
     "  fram bench scenes/demo.yaml --threads 2 --json\n"
     "  python3 bench/peers/gen_scene.py --n 1000 --coverage 0.9 -o floes.scene\n"
     "  fram bench --scene floes.scene --dt 0.02 --iterations 10 --json\n",
     command_bench},
    {"study", "[check | list] STUDY -o DIR",
     "run a scenario under many conditions with several seeds each; report means with confidence intervals",
     "  fram study check study.yaml              how many runs, how long, how much disk\n"
     "  fram study study.yaml -o out/study       after a stop, the same command continues\n"
     "  fram study list out/study                how each condition stands, also while it runs\n"
     "  fram study study.yaml -o out/study --on slurm --partition short --time 1:00:00\n"
     "A study in six lines:\n"
     "  scenario: demo.yaml\n"
     "  set: {run.duration: 60, run.transient: 15}\n"
     "  seeds: {least: 6, most: 60, mean_within: 0.05}\n"
     "  vary:\n"
     "    grid: {ice.thickness: [0.6, 1.1], vessel.speed: [1, 2]}\n"
     "  keep: summary\n",
     command_study},
    {"extremes", "RUN | FILE.csv...",
     "extreme load, tension or offset in three hours, or any other duration, with confidence intervals",
     "  fram extremes out/demo --duration 3h                     the load, by all methods\n"
     "  fram extremes out/a out/b --channel line_tension_max     several runs of one condition\n"
     "  fram extremes tension.csv --channel T --from 60 --method acer --level 0.9,0.99 --json\n"
     "  fram extremes out/study/summary.csv --channel load_largest --maxima --block 45s\n",
     command_extremes},
    {"fatigue", "RUN | FILE.csv...",
     "count the cycles of a load or tension (rainflow), and give damage-equivalent ranges",
     "  fram fatigue out/turret --channel line_tension_max --slope 3,5\n"
     "  fram fatigue tension.csv --channel T --frequency 0.1 -o cycles.csv\n",
     command_fatigue},
    {"fmu", "SCENARIO -o NAME.fmu",
     "make a co-simulation unit of FMI 2.0 or 3.0 of a scenario, for programs that import such",
     "  fram fmu scenes/supply_ship.yaml -o supply.fmu\n"
     "  fram fmu scenes/supply_ship.yaml -o supply.fmu --fmi 3\n"
     "  fram fmu scenes/demo.yaml -o towed.fmu --in 'tow_velocity_*' --out 'ice_force_*' --out position_x\n",
     command_fmu},
    {"view", "RUN", "make a page that plays a run back in a browser, from disk",
     "  fram view out/demo                      writes out/demo/playback.html\n"
     "  fram view out/demo -o demo.html\n"
     "  fram view out/demo --pressure out/demo-pressure\n",
     command_view},
    {"export", "RUN --vtk | --netcdf | --geojson", "write the results of a run in the formats of other programs",
     "  fram export out/demo --vtk                       for ParaView: out/demo/vtk/run.pvd\n"
     "  fram export out/demo --netcdf                    for xarray and h5py: out/demo/run.nc\n"
     "  fram export out/demo --geojson --time 30         the field at 30 s\n",
     command_export},
    {"report", "RUN",
     "report on one page: loads, ice field, fractures, station keeping, balances, solver quality; prints well",
     "  fram report out/demo                    writes out/demo/report.html\n", command_report},
    {"plot", "RUN [CHANNEL...] -o FILE",
     "draw channels of a run over time, as PNG or SVG; without a channel, list them",
     "  fram plot out/demo\n"
     "  fram plot out/demo ice_force_averaged_x ice_force_averaged_y -o load.svg\n"
     "  fram plot out/demo ice_force_x roll pitch --from 20 --to 40 -o part.png\n",
     command_plot},
    {"why", "RUN --peak N | --time T",
     "explain a peak ice load: mechanisms, floes, force chains, fractures before it, time step and solver",
     "  fram why out/demo --peak 1\n"
     "  fram why out/demo --peak 3 -o peak3.png --no-rerun\n"
     "  fram why out/demo --time 12.5 --json\n",
     command_why},
    {"pressure", "RUN -o DIR",
     "ice pressure on the hull by panel (mean, largest, cumulative) and by area; repeats the run",
     "  fram pressure out/demo -o out/demo-pressure\n"
     "  fram pressure out/demo -o out/fine --panel 0.5 --from 20 --to 40\n"
     "  fram pressure out/demo -o out/frames --frames -30:0.6:30 --stringers -4,-2.5,-1,0.5,2\n",
     command_pressure},
    {"compare", "RUN RUN", "compare two runs, in numbers and plots",
     "  fram compare out/demo out/thick\n"
     "  fram compare out/demo out/thick -o both.html\n",
     command_compare},
    {"manage", "RUN",
     "what ice management achieves: floe sizes updrift, behind the icebreakers and at the vessel, warning times, loads",
     "  fram manage out/managed\n"
     "  fram manage out/managed --beside out/alone\n"
     "  fram manage out/escort --vessel tanker --limit 20 --json\n",
     command_manage},
    {"video", "RUN", "make an MP4 of a run, in perspective or in plan; needs ffmpeg, but no screen",
     "  fram video out/demo\n"
     "  fram video out/demo --camera plan --span 200 --colour force -o bow.mp4\n"
     "  fram video out/demo --pictures -o frames\n",
     command_video},
    {"capability", "SCENARIO -o DIR",
     "capability plot: drift speed from each direction up to which a vessel holds station, intact and after a failure",
     "  fram capability scenes/supply_ship.yaml -o out/capability\n"
     "  fram capability scenes/supply_ship.yaml -o out/measured --measure 300 --speed-most 1.5\n"
     "  fram capability scenes/turret_ship.yaml -o out/formula --formula --set ice.thickness=1.5\n"
     "  fram capability scenes/drillship_one_icebreaker.yaml --vessel drillship --ice-from out/managed -o out/held\n",
     command_capability},
    {"hull", "[FILE]",
     "hydrostatics of a hull, from a mesh file (STL, OBJ, GDF) or from main particulars; draw it, write it",
     "  fram hull ship.stl --draught 7.5\n"
     "  fram hull panels.gdf --freeboard 6 --draw hull.png --json\n"
     "  fram hull ship.obj --mass 9.5e6 --kg 8.2 --repair -o closed.stl\n"
     "  fram hull --ship --length 220 --beam 42 --draught 12 --freeboard 7 --block-coefficient 0.84 --draw tanker.png\n"
     "  fram hull --length 100 --beam 20 --draught 7 --stem-angle-deg 30 --block-coefficient 0.55 -o ship.stl\n",
     command_hull},
    {"field", "FILE | SCENARIO",
     "statistics of an ice field, of a scenario or of observed floes; scale, crop, repair, draw and write it",
     "  fram field floes.geojson\n"
     "  fram field scenes/packed_field.yaml --window -50,-50,50,50 --cover cover.png --table floes.csv\n"
     "  fram field outlines.wkt --draw field.png           WKT, or rows of x and y, as well as GeoJSON\n"
     "  fram field floes.geojson --scale 0.01 --crop -300,-200,300,200 --smallest 20 --draw field.png\n"
     "  fram field outlines.geojson --bad repair --simplify 0.5 -o clean.geojson --json\n",
     command_field},
    {"ice", "wedge | sheet | break | split",
     "breaking loads of floating ice by hand formulas: a wedge, a sheet, a load on an edge, a floe that splits",
     "  fram ice wedge --a-over-l 0.1\n"
     "  fram ice sheet --a-over-l 0.1 --nu 0.3 --json\n"
     "  fram ice break --force 3e5 --contact-area 0.2 --thickness 0.8 --flexural-strength 6e5\n"
     "  fram ice split --length 80 --width 50 --place 10 --thickness 0.8\n",
     command_ice},
    {"keys", "", "list every scenario key with unit, default, range and meaning (Markdown)", "  fram keys | less\n",
     command_keys},
};
enum { COMMAND_COUNT = sizeof commands / sizeof *commands };

static const char help_before[] =
    "fram simulates a vessel in broken sea ice: the loads the ice puts on it, and whether it stays on station.\n\n"
    "Usage: fram COMMAND ...        fram COMMAND --help tells more\n\nCommands:\n";
static const char help_after[] =
    "\nA first run, from the folder of the sources:\n"
    "  fram check scenes/demo.yaml                what will be simulated\n"
    "  fram run scenes/demo.yaml -o out/demo      takes some twelve seconds; then look into out/demo:\n"
    "      plan.png         the field seen from above\n"
    "      loads.png        ice load on the vessel over time\n"
    "      series.csv       all channels, one row per time step, headings name[unit]\n"
    "      record.fram      every frame, for playback\n"
    "\nExit codes: 0 success, 1 the run failed, 2 bad input or usage, 130 interrupted (a run has written a\n"
    "checkpoint then).\n"
    "fram --version prints the version and the optional parts of this build.\n";

static void print_help(FILE *file)
{
    fputs(help_before, file);
    for (int i = 0; i < COMMAND_COUNT; i++)
        fprintf(file, "  %-10s %s\n", commands[i].name, commands[i].summary);
    fputs(help_after, file);
}

static int answer_help(const common_options *common)
{
    print_help(stdout);
    if (common->json) {
        json j = json_begin();
        json_text(&j, "help", "fram");
        json_end(&j);
    }
    return EXIT_GOOD;
}

static int answer_version(const common_options *common)
{
    const char *features = fram_features();
    if (common->json) {
        json j = json_begin();
        json_text(&j, "version", fram_version());
        json_text(&j, "optional_parts", features);
        json_end(&j);
        return EXIT_GOOD;
    }
    printf("fram %s\n", fram_version());
    printf("optional parts: %s\n", *features ? features : "none");
    return EXIT_GOOD;
}

/* Options that every command has may stand before it: `fram --json run` is `fram run --json`. */
static bool is_shared_flag(const char *word)
{
    static const char *const flags[] = {"--json", "--quiet", "-q", "--verbose", "-v", "--force"};
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++) {
        if (strcmp(word, flags[i]) == 0)
            return true;
    }
    return false;
}

/* The command goes before the flags that stood before it. */
static void bring_command_forward(int argc, char **argv)
{
    int at = 1;
    while (at < argc && is_shared_flag(argv[at]))
        at++;
    if (at == argc)
        return;
    char *command = argv[at];
    memmove(argv + 2, argv + 1, (size_t)(at - 1) * sizeof *argv);
    argv[1] = command;
}

static int run_words(const common_options *common, int argc, char **argv)
{
    const char *word = argv[1];
    if (is_shared_flag(word))
        return answer_usage(common, "COMMAND", "is missing; fram --help lists them");
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0)
        return answer_help(common);
    if (strcmp(word, "--version") == 0)
        return answer_version(common);
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(word, commands[i].name) == 0)
            return commands[i].run(&commands[i], argc - 2, argv + 2);
    }
    return answer_usage(common, *word ? word : "COMMAND",
                        *word ? "is not a command; fram --help lists them"
                              : "expected a command, found an empty word; fram --help lists them");
}

/* A standard stream that is closed at the start would be the next file that is opened, and progress lines would go into
   results.  Opened the wrong way round, so that what is lost is told as for any other stream that cannot be written. */
static bool open_standard_streams(void)
{
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; descriptor++) {
        int flags = descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY;
        if (fcntl(descriptor, F_GETFD) < 0 && open("/dev/null", flags) != descriptor)
            return false;
    }
    return true;
}

/* Opened once more a pipe is the same pipe, and a terminal the same terminal; the master of one would be that of a new
   terminal, which nobody reads. */
static bool opens_as_itself(int descriptor, const struct stat *about)
{
    return S_ISFIFO(about->st_mode) || (isatty(descriptor) && !ptsname(descriptor));
}

/* Who shares the stream may have set it not to wait, and what a full one does not take is lost to stdio.  Opened once
   more it waits, for this command alone; one that cannot be, as a socket, waits for all that share it. */
static void wait_at_standard_output(void)
{
    struct stat about;
    int flags = fcntl(STDOUT_FILENO, F_GETFL);
    if (flags < 0 || !(flags & O_NONBLOCK) || (flags & O_ACCMODE) == O_RDONLY || fstat(STDOUT_FILENO, &about) != 0)
        return;
    if (opens_as_itself(STDOUT_FILENO, &about)) {
        /* Nor does it wait here, for a reader that has gone. */
        int own = open("/proc/self/fd/1", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
        if (own >= 0) {
            (void)dup2(own, STDOUT_FILENO);
            close(own);
        }
    }
    (void)fcntl(STDOUT_FILENO, F_SETFL, flags & ~O_NONBLOCK);
}

int main(int argc, char **argv)
{
    if (!open_standard_streams())
        return EXIT_RUN_FAILED;
    wait_at_standard_output();
    if (argc < 2) {
        print_help(stderr);
        return EXIT_BAD_INPUT;
    }
    /* A limit on the size of files is an error of the write that meets it, with its message and its tidying up. */
    signal(SIGXFSZ, SIG_IGN);
    /* Whoever started this may have ignored it: then nobody could tell how runs of a study and ffmpeg end. */
    signal(SIGCHLD, SIG_DFL);
    common_options common = {0};
    common.json = words_ask_for_json(argc - 1, argv + 1);
    bring_command_forward(argc, argv);
    int code = run_words(&common, argc, argv);
    /* A full disk or a closed pipe shows here at the latest. */
    bool lost = ferror(stdout) != 0;
    if (fflush(stdout) == 0 && !lost)
        return code;
    fputs("fram: standard output: cannot be written; the answer is not complete\n", stderr);
    return code == EXIT_GOOD ? EXIT_RUN_FAILED : code;
}
