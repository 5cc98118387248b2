#!/bin/sh
# Everything about form:  tools/lint.sh [FILE...]     (needs a configured and built build/release)
# 1 form by clang-format, 2 scripts by shellcheck and pyflakes, 3 the house by check_rooms.py, check_unused.py and
# check_keys.py, 4 what documents cite by check_documents.py, 5 the faults of tests/mutants, 6 the objects by
# check_objects.py and check_together.py, 7 clang-tidy.  Given C files, 1 and 7 look at those only.
set -eu
cd "$(dirname "$0")/.."
build=${BUILD:-build/release}
jobs=${JOBS:-2}
bad=0

if [ $# -gt 0 ]; then
    sources=$(printf '%s\n' "$@")
else
    sources=$(tools/sources.sh '*.c' '*.h')
fi

echo "lint: form (clang-format)"
echo "$sources" | xargs clang-format --dry-run -Werror || bad=1

echo "lint: scripts (shellcheck)"
# bench/peers: programs of other engines, kept as they were written.
tools/sources.sh '*.sh' '.ci/run' | grep -v '^bench/peers/' | xargs shellcheck || bad=1

echo "lint: scripts (pyflakes)"
# What is imported to see whether it is there, or for what it does as it is read, is not used.
tools/sources.sh '*.py' | xargs pyflakes3 2>&1 | grep -v 'imported but unused' && bad=1

echo "lint: rooms (tools/check_rooms.py)"
python3 tools/check_rooms.py || bad=1
python3 tools/draw_architecture.py --check || bad=1
python3 tools/check_unused.py || bad=1
python3 tools/check_keys.py || bad=1

echo "lint: documents (tools/check_documents.py)"
python3 tools/check_documents.py || bad=1

echo "lint: faults to be tried (tools/mutate)"
python3 tools/mutate/mutate.py --check || bad=1

echo "lint: objects (tools/check_objects.py, tools/check_together.py)"
cmake --build "$build" -j"$jobs" >"$build/lint-build.log" || { cat "$build/lint-build.log"; exit 1; }
python3 tools/check_objects.py "$build" || bad=1
python3 tools/check_together.py "$build" || bad=1

echo "lint: analysis (clang-tidy)"
python3 tools/tidy.py "$build" "$jobs" "$@" || bad=1

[ $bad = 0 ] || { echo "lint: failed" >&2; exit 1; }
echo "lint: clean"
