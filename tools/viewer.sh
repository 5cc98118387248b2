#!/bin/sh
# Build the playback page, build/viewer/playback.html, with the exact versions of viewer/package-lock.json.
set -eu
cd "$(dirname "$0")/../viewer"
log=../build/viewer/build.log
mkdir -p ../build/viewer
# Nothing else of Fram needs npm.
command -v npm >/dev/null || { echo "viewer: the page that plays a run needs npm, which is not here" >&2; exit 1; }
[ -d node_modules ] || echo "viewer: npm fetches three.js and esbuild, 35 MB on disk, into viewer/node_modules"
if ! npm ci --fetch-retries=1 --fetch-timeout=30000 >"$log" 2>&1; then
    tail -n 5 "$log" >&2
    echo "viewer: npm could not fetch what the page is made of; the log is build/viewer/build.log" >&2
    exit 1
fi
node build.mjs
