#!/bin/sh
# Fuzz every target of a build for some seconds each, some at a time:  tools/fuzz.sh BUILD SECONDS [JOBS [TARGET...]]
# The committed seeds in fuzz/corpus/<name> and the words of the format in fuzz/words/<name>.dict are only read; what is
# found is kept in BUILD/corpus/<name>, and a failing input in BUILD/findings.
# With FUZZ_SEED each target walks the same way from the committed seeds alone, at most FUZZ_RUNS (40,000) inputs of it:
# a gate that answers the same for the same code. What a longer or another way finds is for `make fuzz` without it.
set -eu
build=$1
seconds=$2
jobs=${3:-1}
[ $# -lt 3 ] || shift
shift 2
cd "$(dirname "$0")/.."

fuzz_one() {
    name=${1##*/fuzz_}
    kept=$build/corpus/$name
    walk=""
    if [ -n "${FUZZ_SEED:-}" ]; then
        kept=$(mktemp -d)
        walk="-seed=$FUZZ_SEED -runs=${FUZZ_RUNS:-40000}"
    fi
    mkdir -p "$build/findings" "$kept"
    seeds=fuzz/corpus/$name
    [ -d "$seeds" ] || seeds=""
    words=fuzz/words/$name.dict
    [ -f "$words" ] && words=-dict=$words || words=""
    log=$build/findings/$name.log
    # GEOS 3.11 leaks rings of degenerate polygons that it fails to repair, which cannot be told from a leak of ours
    # without whole stacks (30 times as slow); ours are looked for by the tests, under the same sanitizer.
    leaks=1
    [ "$name" = overlay ] && leaks=0
    sound=0
    # shellcheck disable=SC2086  # seeds and words are one word or none, the walk two
    ASAN_OPTIONS=detect_leaks=$leaks "$1" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2560 \
        -print_final_stats=1 -artifact_prefix="$build/findings/$name-" \
        $walk $words "$kept" $seeds >"$log" 2>&1 || sound=$?
    [ -z "${FUZZ_SEED:-}" ] || rm -r "$kept"
    if [ $sound -ne 0 ]; then
        tail -n 60 "$log"
        echo "fuzz: $name failed; the input is in $build/findings" >&2
        return 1
    fi
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    echo "fuzz: $name, at most $seconds s, inputs run: $runs"
}

if [ $# -eq 1 ]; then
    fuzz_one "$1"
    exit
fi
[ $# -gt 0 ] || set -- "$build"/fuzz/fuzz_*
if [ ! -x "$1" ]; then
    echo "fuzz: there are no targets yet"
    exit 0
fi
printf '%s\n' "$@" | xargs -P "$jobs" -n 1 "tools/${0##*/}" "$build" "$seconds" 1 || exit 1
echo "fuzz: no finding in $# targets"
