#!/bin/sh
# Run the demo, make its playback page if that can be, and name the files to look at.
set -eu
cd "$(dirname "$0")/.."
build/release/fram run scenes/demo.yaml -o out/demo --force

# The page needs npm, which may be out of reach: everything else is worth having without it.
page=no
if make --no-print-directory viewer && build/release/fram view out/demo; then
    page=yes
fi
echo
echo "The demo is in out/demo. Look at:"
for file in out/demo/*; do
    case ${file##*/} in
    series*.csv) meaning="time series: one row a step, one column per quantity and unit" ;;
    fractures*.csv) meaning="every floe that broke: when, where, how" ;;
    *.csv) meaning="table" ;;
    plan*.png) meaning="the hull and the ice seen from above" ;;
    load*.png) meaning="the ice load on the hull over time" ;;
    *.png) meaning="picture" ;;
    *.html) meaning="playback: open it in a browser" ;;
    *) continue ;;
    esac
    printf '  %-26s %s\n' "$file" "$meaning"
done
[ $page = yes ] || echo "The playback page was skipped: see the message about the viewer above."
