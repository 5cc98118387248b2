#!/usr/bin/env bash
# The example of a controller of one's own runs, and holds the vessel on its station while ice drifts against it.
set -euo pipefail
controller=$FRAM_BUILD/examples/controller
seconds=5
[ -z "${FRAM_TEST_SHORT:-}" ] || seconds=1
table=$(mktemp)
trap 'rm -f "$table"' EXIT
"$controller" scenes/free_vessel.yaml $seconds >"$table"
head -n 1 "$table" | grep -q '^time\[s\],x\[m\],y\[m\],ice_force_x\[N\],ice_force_y\[N\]$'
# The last row is at the end, and the vessel within half a metre of where it began (x and y are 0 in the scene).
awk -F, -v end=$seconds '
    NR == 2 { x = $2; y = $3 }
    END {
        if (NR < 11 || $1 < end - 1e-6) { print "too few rows, the last at " $1 " s"; exit 1 }
        drift = sqrt(($2 - x)^2 + ($3 - y)^2)
        if (!(drift < 0.5)) { print "drifted " drift " m"; exit 1 }
    }' "$table"
# A mistake is told with its place, not by a crash.
if "$controller" scenes/absent.yaml 2>"$table"; then exit 1; fi
grep -q 'absent.yaml' "$table"
