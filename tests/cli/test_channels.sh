#!/usr/bin/env bash
# docs/channels.md names every column of series.csv and fractures.csv, docs/station.md every member of station.json,
# docs/results.md every kind of event.
. "$FRAM_SOURCE/tests/cli/common.sh"
page=$FRAM_SOURCE/docs/channels.md
"$FRAM" run "$FRAM_SOURCE/scenes/turret_ship.yaml" -o moored --quiet --set=run.duration=0.1 --set=run.transient=0 \
    --set=output.frame_interval=0 >/dev/null
"$FRAM" run "$FRAM_SOURCE/scenes/level_ice.yaml" -o level --quiet --set=run.duration=0.1 --set=run.transient=0 \
    --set=output.frame_interval=0 --set=domain.x_max=40 >/dev/null
count=0
for file in moored/series.csv level/series.csv level/fractures.csv; do
    for head in $(head -n 1 "$file" | tr ',' '\n' | sed 's/\[.*//'); do
        stem=$(sed -E 's/_[0-9]+_/_1_/; s/_[xyz]$//' <<<"$head")
        short=_${stem#ice_force_} # zones: `ice_force_bow_*`, `_stern_*`
        grep -qF -e "\`$head\`" -e "\`${stem}_*\`" -e "\`${stem}_x\`" -e "\`$stem\`" -e "\`${short}_*\`" "$page" || {
            echo "FAILED: docs/channels.md does not name $head of $file"
            exit 1
        }
        count=$((count + 1))
    done
done
[ "$count" -ge 150 ] || fail "only $count columns"
python3 - moored/station.json "$FRAM_SOURCE/docs/station.md" <<'END' || fail "docs/station.md: a member of station.json"
import json, sys
page = open(sys.argv[2]).read()
station = json.load(open(sys.argv[1]))
for name in [*station, *station["lines"][0], *station["offset_m"], "energy_J", "failed", "largest_use"]:
    assert f"`{name}`" in page, name
END
kinds=$(sed -n '/names\[EVENT_COUNT\]/,/};/s/^ *"\(.*\)",$/\1/p' "$FRAM_SOURCE/src/vessel/event.c")
[ "$(wc -w <<<"$kinds")" -ge 14 ] || fail "the names of events are not found"
for kind in $kinds; do
    grep -qF "\`$kind\`" "$FRAM_SOURCE/docs/results.md" || fail "docs/results.md does not name $kind"
done
finish "$count columns, $(wc -w <<<"$kinds") kinds of events"
