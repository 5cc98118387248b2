#!/bin/sh
# Run the tests of a coverage build and report the lines of src/ they reach:  tools/coverage.sh BUILD JOBS
# Fails below COVERAGE_MINIMUM percent (90).
set -eu
build=$1
jobs=$2
cd "$(dirname "$0")/.."
find "$build" -name '*.gcda' -delete
(cd "$build" && ctest --output-on-failure --no-label-summary -j"$jobs" -LE package)
gcovr --root . --filter 'src/' --exclude-unreachable-branches --print-summary --object-directory "$build" \
    --fail-under-line "${COVERAGE_MINIMUM:-90}" --html-details "$build/coverage.html" -j "$jobs" "$build"
echo "coverage: pages begin at $build/coverage.html"
