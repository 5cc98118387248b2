#!/usr/bin/env bash
# Both libraries show exactly the calls that the public headers declare, and no internal name.
set -euo pipefail
declared=$(cat "$FRAM_SOURCE"/include/fram/*.h | tr '\n' ' ' |
    grep -oE 'FRAM_API [^;{]*[( *]fram_[a-z0-9_]+\(' | sed 's/($//; s/.*[ *(]//' | sort -u)
scratch=$(mktemp)
trap 'rm -f "$scratch"' EXIT
status=0
check() {
    if ! diff <(echo "$declared") <(echo "$2") >"$scratch"; then
        echo "$1 differs from include/fram ('<' declared only, '>' in the library only):"
        cat "$scratch"
        status=1
    fi
}
shared=$(nm -D --defined-only "$FRAM_BUILD/libfram.so" | awk '{ print $NF }' | sort -u)
if [ -z "$shared" ]; then
    echo "skipped: the library has no public calls yet"
    exit 77
fi
check libfram.so "$shared"
static=$(nm --extern-only --defined-only "$FRAM_BUILD/libfram.a" 2>/dev/null | awk 'NF == 3 { print $3 }' | sort -u)
check libfram.a "$static"
exit $status
