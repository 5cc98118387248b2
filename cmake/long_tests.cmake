# Tests that take more than about 5 s (release build, quiet machine of 2 cores), each with its reason.  They alone have
# the long time limit: a test that is not named here and grows long is stopped.  `make test` begins with them.
set(fram_long_tests
    "cli/bench:            the bench's own times are long enough to be measured"
    "cli/check:            each thing a vessel cannot be or is told of, a command of its own"
    "cli/command:          every command and its refusals, and signals to runs that go on"
    "cli/field:            fields of all sources drawn, written and read again"
    "cli/hull:             hulls of every form read, drawn, cut into convex pieces and written, a command each"
    "cli/hull_files:       hull files of every exporter and kind, and the remedy of each that is refused"
    "cli/manage:           known ice past known places in several runs, and each refusal a command"
    "cli/packed_field:     ten thousand steps at rest, as the promise says"
    "cli/results:          every export, report, plot and video of a run, and what is refused, a command each"
    "cli/why:              a chain of floes explained, and computed again by three methods, six times"
    "dynamics/packed:      packed fields must come to rest under each solver"
    "dynamics/solver:      oracles of friction and stacking under each solver"
    "fmi/unit:             units of both versions packed, opened, stepped and held against the command"
    "geometry/overlay:     twenty thousand random pairs of outlines against areas"
    "geometry/polygon_clip: random pairs of outlines, every kind of degeneracy"
    "ice/field:            managed ice of every concentration and law of size, two seeds each"
    "ice/field_pack:       six kinds of field, two seeds each (FRAM_TEST_LONG: twenty)"
    "ice/field_sized:      power diagrams to 0.2 % of the areas, two seeds (FRAM_TEST_LONG: twenty)"
    "ice/fracture_algorithms: random outlines against slow and plain versions of each algorithm"
    "ice/fracture_fuzz:    twenty thousand random breaks, each with its books (5,000 where tests are short)"
    "ice/packing_ragged:   an impossible field is tried to the end before it is refused"
    "io/geojson:           files of ten million positions, one over the limit"
    "results/report:       runs with a fed field and with level ice, long enough for their books to matter"
    "sim/build_stopped:    six builds, each interrupted after a second or two"
    "sim/drift:            a sheet that drifts over its ship, comes back and is met again, at two time steps"
    "sim/propulsion:       ten minutes of tracks in open water, and an icebreaker in ice until its speed is steady"
    "sim/feeding:          hours of drift: the field must not change by being fed"
    "sim/level_ice:        ships through level ice, far enough to see the channel and the loads"
    "sim/real_input:       a run of 60 s through outlined floes, repaired (FRAM_TEST_LONG: 462 observed ones too)"
    "slurm/arrays:         a cluster is started, loses a node and gets its runs back"
    "study/annual_coverage: levels of a year of two diagrams, twelve trials each, and bootstraps by the generalized law"
    "study/extremes_coverage: intervals of eleven cases, twelve trials each (FRAM_TEST_LONG: a thousand)"
    "runs/resume:          golden scenes straight and through a checkpoint"
    "study/study:          studies of several runs each: stopped, killed, widened, in parallel"
    "study/worst:          studies whose worst runs are made again, killed on the way and widened"
    "views/live_view:      a browser beside runs that go on"
    "views/peaks:          a browser opens the page at each peak of several runs"
    "views/playback:       a browser plays several runs, looks at pixels and clicks"
    "tools/failing_memory: fifty commands, each with another allocation that fails, on files of their own"
    "tools/torture:        the campaign of faults tried on commands that misbehave on purpose")
set(fram_short_limit 150) # [s]: thirty times 5 s, for machines that are busy or slow
set(fram_long_limit 600)  # [s]

# Sets the limit of every test that is there; a name that no test has is a mistake.
function(fram_limit_tests)
    get_property(tests DIRECTORY PROPERTY TESTS)
    if(NOT FRAM_SANITIZE AND NOT FRAM_COVERAGE)
        foreach(test ${tests})
            set_tests_properties(${test} PROPERTIES TIMEOUT ${fram_short_limit})
        endforeach()
    endif()
    foreach(line ${fram_long_tests})
        string(REGEX REPLACE ":.*" "" name "${line}")
        if(name IN_LIST tests)
            set_tests_properties(${name} PROPERTIES TIMEOUT ${fram_long_limit} COST 100)
        elseif(Python3_FOUND)
            message(FATAL_ERROR "cmake/long_tests.cmake names ${name}, and there is no such test")
        endif()
    endforeach()
endfunction()
