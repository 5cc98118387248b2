#!/usr/bin/env bash
# docs/channels.md names every column of series.csv and fractures.csv.
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
echo "$count columns"
[ "$count" -ge 150 ]
