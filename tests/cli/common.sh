# What the tests of the command share: to be sourced first, by
#     . "$FRAM_SOURCE/tests/cli/common.sh"
# It goes to a scratch folder, which is removed in the end.  A test ends with `finish WORDS`.
# shellcheck shell=bash
set -euo pipefail
scratch=$(mktemp -d)
failures=0
# A test that forgets to finish fails all the same.
leave() {
    local code=$?
    rm -rf "$scratch"
    [ "$code" != 0 ] || [ "$failures" = 0 ] || exit 1
}
trap leave EXIT
cd "$scratch"
fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}
# finish WORDS: ends the test; the words say what holds when nothing failed.
finish() {
    [ "$failures" = 0 ] || exit 1
    echo "$*"
}
# expect CODE COMMAND...: runs it, keeps its output in out and err.
expect() {
    local wanted=$1 code=0
    shift
    "$@" >out 2>err || code=$?
    [ "$code" = "$wanted" ] || fail "exit code $code instead of $wanted: $*: $(tail -n 2 err)"
}
# Whether the command has an optional library: built_with cairo, built_with netcdf.
built_with() { "$FRAM" --version | grep -q "$1"; }
# The value of an expression of the JSON object j on the last line of out.
value() { tail -n 1 out | python3 -S -c 'import json, sys; j = json.load(sys.stdin); print('"$1"')'; }
# same FOUND WANTED NAME
same() { [ "$1" = "$2" ] || fail "$3: '$1' instead of '$2'"; }
# says WORDS FILE, holds PATTERN FILE: the file has the words, or a line of the pattern.
says() { grep -qF -- "$1" "$2" || fail "$2 lacks '$1': $(cat "$2")"; }
holds() { grep -q -- "$1" "$2" || fail "$2 lacks '$1'"; }
# as_killed RUN: its run.json becomes that of a run which goes on, or was killed: as at its start, before its track.
as_killed() {
    python3 -S - "$1/run.json" <<'PY'
import json, sys
note = json.load(open(sys.argv[1]))
track = {"limit_m": 9, "largest_m": 0, "rms_m": 0, "time_s": 0, "rounds": 0}
note |= {"status": "running", "steps": 0, "time_s": 0, "tracks": [track], "events": []}
json.dump(note, open(sys.argv[1], "w"))
PY
}
# told_defaults PATTERN NUMBER: options of the help in out whose words have the pattern, each with the number that the
# second pattern finds in them: "(" finds 30 in "(30; ship 75)", 3h in "(3h)" and 3,5 in "(3,5)", "ship " finds 75.
told_defaults() { sed -nE "s/^  (-., )?(--[a-z-]+) .* .*($1).*$2([0-9][0-9.e,]*[a-z]*).*/\\2 \\4/p" out; }
