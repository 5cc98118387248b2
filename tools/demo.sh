#!/bin/sh
# Run the demo, make its report and playback page if that can be, and name what to open first.
set -eu
cd "$(dirname "$0")/.."
out=out/demo
build/release/fram run scenes/demo.yaml -o $out --force
build/release/fram report $out

# The page needs npm, which may be out of reach: everything else is worth having without it.
first=$out/report.html
if make --no-print-directory viewer && build/release/fram view $out; then
    first=$out/playback.html
else
    echo "The playback page was skipped: see the message about the viewer above."
fi
echo
echo "The demo is in $out:"
for file in "$out"/*; do
    case ${file##*/} in
    series*.csv) meaning="time series: one row a step, one column per quantity and unit" ;;
    fractures*.csv) meaning="every floe that broke: when, where, how" ;;
    *.csv) meaning="table" ;;
    plan*.png) meaning="the ship and the ice seen from above" ;;
    load*.png) meaning="the ice load on the ship over time" ;;
    *.png) meaning="picture" ;;
    report.html) meaning="the run on one page: loads, field, what broke, how good it is" ;;
    *.html) meaning="playback in 3-D" ;;
    *) continue ;;
    esac
    printf '  %-26s %s\n' "$file" "$meaning"
done
echo
echo "Open first, in a browser: $PWD/$first"
