#!/bin/sh
# Fuzz every target of a build for some seconds each:  tools/fuzz.sh BUILD SECONDS
# The committed seeds in fuzz/corpus/<name> and the words of the format in fuzz/words/<name>.dict are only read; what is
# found is kept in BUILD/corpus/<name>, and a failing input in BUILD/findings.
set -eu
build=$1
seconds=$2
cd "$(dirname "$0")/.."
set -- "$build"/fuzz/fuzz_*
if [ ! -x "$1" ]; then
    echo "fuzz: there are no targets yet"
    exit 0
fi
mkdir -p "$build/findings"
for target; do
    name=${target##*/fuzz_}
    mkdir -p "$build/corpus/$name"
    seeds=fuzz/corpus/$name
    [ -d "$seeds" ] || seeds=""
    words=fuzz/words/$name.dict
    [ -f "$words" ] && words=-dict=$words || words=""
    echo "fuzz: $name for $seconds s"
    log=$build/findings/$name.log
    # GEOS 3.11 leaks rings of degenerate polygons that it fails to repair, which cannot be told from a leak of ours
    # without whole stacks (30 times as slow); ours are looked for by the tests, under the same sanitizer.
    leaks=1
    [ "$name" = overlay ] && leaks=0
    # shellcheck disable=SC2086  # seeds and words are one word or none
    if ! ASAN_OPTIONS=detect_leaks=$leaks "$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2560 \
        -print_final_stats=1 -artifact_prefix="$build/findings/$name-" \
        $words "$build/corpus/$name" $seeds >"$log" 2>&1; then
        tail -n 60 "$log"
        echo "fuzz: $name failed; the input is in $build/findings" >&2
        exit 1
    fi
    sed -n 's/^stat::number_of_executed_units: */fuzz:   inputs run: /p' "$log"
done
echo "fuzz: no finding in $# targets"
