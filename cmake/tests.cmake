# Tests and fuzz targets.
#   tests/<room>/test_<topic>.c    one program, linked to that room and the floors below it, run as <room>/<topic>
#   tests/<group>/test_<topic>.sh  a script, run as <group>/<topic> with FRAM (the command), FRAM_BUILD and
#   tests/<group>/test_<topic>.py  FRAM_SOURCE set; exit code 77 means skipped (say why on standard output)
#   fuzz/fuzz_<name>.c             LLVMFuzzerTestOneInput; the committed corpus is replayed as fuzz/<name>
# Every test runs in the source folder, and none reads the clock to pass.
# Each has its room for a label; those that make threads are labelled so too, since a race needs two of them.

# libcheck kills a test after 4 s by default: too little for a sanitizer on a busy machine.
set(test_environment "CK_DEFAULT_TIMEOUT=300" "FRAM=${CMAKE_BINARY_DIR}/fram" "FRAM_BUILD=${CMAKE_BINARY_DIR}"
    "FRAM_SOURCE=${CMAKE_SOURCE_DIR}" "LC_ALL=C.UTF-8")
option(FRAM_SHORT_TESTS "tests with long scenes shorten them" OFF)
if(FRAM_SANITIZE OR FRAM_COVERAGE OR FRAM_FUZZ OR FRAM_SHORT_TESTS)
    # Tests with long scenes shorten them when this is set.
    list(APPEND test_environment "FRAM_TEST_SHORT=1")
endif()
if(FRAM_SANITIZE)
    # LeakSanitizer guesses where a library opened late, as NetCDF is, has its variables of each thread: of a place that
    # ends in 0x010 it takes what stands before it for a header of glibc 2.19, and faults. They are found without.
    list(APPEND test_environment "FRAM_TEST_SANITIZE=${FRAM_SANITIZE}" "ASAN_OPTIONS=intercept_tls_get_addr=0"
        "LSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/tools/leaks.txt:print_suppressions=0"
        "UBSAN_OPTIONS=print_stacktrace=1" "TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1")
endif()

function(fram_label_threads name source program)
    file(STRINGS "${source}" mentions REGEX "pool_create|threads")
    if(mentions)
        set_property(TEST ${name} APPEND PROPERTY LABELS threads)
        add_dependencies(tests_threads ${program})
    endif()
endfunction()

# Builds the programs of the tests that have a label: for who runs those only.
function(fram_tests_target label)
    if(NOT TARGET tests_${label})
        add_custom_target(tests_${label})
    endif()
endfunction()

# Tests and fuzz targets are linked by the quickest linker that is there: two hundred programs, for which lld is half
# started when gold is done, which has warnings without end of clang's sanitizers.  What users get is linked by the
# compiler's own.
find_program(FRAM_GOLD ld.gold)
find_program(FRAM_LLD ld.lld)
mark_as_advanced(FRAM_GOLD FRAM_LLD)
function(fram_link_quickly program)
    if(FRAM_GOLD AND NOT (FRAM_LLD AND CMAKE_C_COMPILER_ID MATCHES "Clang"))
        target_link_options(${program} PRIVATE -fuse-ld=gold)
    elseif(FRAM_LLD)
        target_link_options(${program} PRIVATE -fuse-ld=lld)
    endif()
endfunction()

# Links a program to a room and what stands below it, or to all rooms where there is none of that name.  Programs of
# sanitized builds share one library of all rooms: with the rooms inside, each would take 25 to 50 MB.
function(fram_link_rooms program room)
    if(FRAM_SANITIZE)
        target_link_libraries(${program} PRIVATE fram_shared ${fram_parts})
        target_link_options(${program} PRIVATE -Wl,-z,now) # a name looked up at its first call leaves its traces
    elseif(TARGET room_${room})
        target_link_libraries(${program} PRIVATE room_${room})
    else()
        target_link_libraries(${program} PRIVATE fram_objects)
    endif()
    if(CMAKE_BUILD_TYPE STREQUAL "Release")
        target_link_options(${program} PRIVATE -Wl,--strip-debug) # the debug build has them
    endif()
endfunction()

# The interpreter itself: what is found may be a script that looks for it anew at every start, in ten times the time,
# and tests start it thousands of times.
find_package(Python3 COMPONENTS Interpreter QUIET)
if(Python3_FOUND)
    execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import sys; print(sys.executable)"
                    OUTPUT_VARIABLE fram_python OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    cmake_path(GET fram_python PARENT_PATH fram_python_folder)
endif()

function(fram_test name label)
    add_test(NAME ${name} COMMAND ${ARGN} WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}")
    set_tests_properties(${name} PROPERTIES LABELS ${label} TIMEOUT 600 SKIP_RETURN_CODE 77
                         ENVIRONMENT "${test_environment}")
    if(Python3_FOUND)
        set_tests_properties(${name} PROPERTIES ENVIRONMENT_MODIFICATION "PATH=path_list_prepend:${fram_python_folder}")
    endif()
endfunction()

if(FRAM_TESTS)
    pkg_check_modules(check REQUIRED IMPORTED_TARGET check)
    fram_tests_target(threads)
    file(GLOB tests CONFIGURE_DEPENDS "tests/*/test_*.c")
    foreach(source ${tests})
        get_filename_component(room "${source}" DIRECTORY)
        get_filename_component(room "${room}" NAME)
        get_filename_component(topic "${source}" NAME_WE)
        string(REGEX REPLACE "^test_" "" topic "${topic}")
        set(program test_${room}_${topic})
        add_executable(${program} "${source}")
        if(room STREQUAL fmi)
            # The unit is opened as importers do.
            add_dependencies(${program} fram_fmu)
        endif()
        target_include_directories(${program} PRIVATE src include tests)
        fram_link_rooms(${program} ${room})
        target_link_libraries(${program} PRIVATE PkgConfig::check)
        # As for kernels: vectors pass between static functions only.  A test is compiled without optimisation, in a
        # third of the time: what it calls stands in the library, optimised, and no bit depends on how it was compiled.
        target_compile_options(${program} PRIVATE -Wno-psabi -O0)
        if(FRAM_SANITIZE MATCHES "undefined")
            # What a test itself does with numbers is of no user; its arrays, which the library writes to, are watched.
            target_compile_options(${program} PRIVATE
                                   -fno-sanitize=undefined,float-cast-overflow,float-divide-by-zero)
        endif()
        fram_link_quickly(${program})
        set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
        fram_test(${room}/${topic} ${room} ${program})
        fram_tests_target(${room})
        add_dependencies(tests_${room} ${program})
        fram_label_threads(${room}/${topic} "${source}" ${program})
    endforeach()

    file(GLOB scripts CONFIGURE_DEPENDS "tests/*/test_*.sh" "tests/*/test_*.py")
    foreach(script ${scripts})
        get_filename_component(group "${script}" DIRECTORY)
        get_filename_component(group "${group}" NAME)
        get_filename_component(topic "${script}" NAME_WE)
        string(REGEX REPLACE "^test_" "" topic "${topic}")
        if(NOT script MATCHES "\\.py$")
            fram_test(${group}/${topic} ${group} bash "${script}")
        elseif(Python3_FOUND)
            fram_test(${group}/${topic} ${group} "${fram_python}" "${script}")
        else()
            message(STATUS "no Python: ${group}/${topic} is left out")
        endif()
    endforeach()
    include(cmake/long_tests.cmake)
    fram_limit_tests()
endif()

add_custom_target(fuzz_targets) # all of them, and nothing else
file(GLOB fuzzers CONFIGURE_DEPENDS "fuzz/fuzz_*.c")
foreach(source ${fuzzers})
    get_filename_component(program "${source}" NAME_WE)
    string(REGEX REPLACE "^fuzz_" "" name "${program}")
    add_executable(${program} "${source}" fuzz/memory_file.c)
    target_include_directories(${program} PRIVATE src include fuzz)
    fram_link_rooms(${program} all)
    fram_link_quickly(${program})
    add_dependencies(fuzz_targets ${program})
    set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/fuzz")
    if(FRAM_FUZZ)
        target_link_options(${program} PRIVATE -fsanitize=fuzzer)
    else()
        target_sources(${program} PRIVATE fuzz/replay.c)
        fram_test(fuzz/${name} fuzz ${program} "fuzz/corpus/${name}")
    endif()
endforeach()
