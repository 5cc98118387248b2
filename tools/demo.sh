#!/bin/sh
# Run the demo and name the files to look at.
set -eu
cd "$(dirname "$0")/.."
build/release/fram run scenes/demo.yaml -o out/demo --force
echo
echo "The demo is in out/demo. Look at:"
for file in out/demo/*; do
    case $file in
    *.csv) echo "  $file   time series, one column per quantity and unit" ;;
    *.png) echo "  $file   picture" ;;
    *.html) echo "  $file   playback: open it in a browser" ;;
    esac
done
