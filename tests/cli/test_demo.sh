#!/usr/bin/env bash
# The demo shows what Fram is for: its beginning, in coarse steps, breaks ice at a hull of a ship's form.
. "$FRAM_SOURCE/tests/cli/common.sh"

expect 0 "$FRAM" check "$FRAM_SOURCE/scenes/demo.yaml"
grep '^warning' err && fail "the demo warns"
says "form: ship" out
expect 0 "$FRAM" run "$FRAM_SOURCE/scenes/demo.yaml" -o demo --quiet --set run.duration=9 --set run.transient=0 \
    --set run.time_step=0.02
rows=$(($(wc -l <demo/fractures.csv) - 1))
[ "$rows" -ge 5 ] || fail "only $rows floes broke in the first 9 s of the demo"
# Whoever makes the demo is told what to open first.
tail -n 1 "$FRAM_SOURCE/tools/demo.sh" | grep -q "Open first" || fail "the demo does not end with what to open"
finish "the demo breaks ice"
