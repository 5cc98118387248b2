#!/usr/bin/env bash
# Packages of this tree:   tools/package.sh deb|archive
#   deb      build/packages/*.deb by Debian's own tools, checked by lintian; needs the packages of the group `deb`
#   archive  build/packages/fram-VERSION-linux-MACHINE.tar.gz: unpack it anywhere and run bin/fram; it carries the
#            libraries that it needs beside the C library (glibc of this machine or newer), but not NetCDF
# Both carry the page that plays a run in a browser if npm is here to build it or it was built before (make viewer).
set -euo pipefail
cd "$(dirname "$0")/.."
# What others unpack is theirs to read.
umask 022
jobs=${JOBS:-2}
version=$(sed -n 's/.*FRAM_VERSION_\(MAJOR\|MINOR\|PATCH\) \([0-9]*\)/\2/p' include/fram/version.h | paste -sd.)
packages=build/packages
# One time for all files, so that the same sources give the same packages.
SOURCE_DATE_EPOCH=$(git --git-dir=.git log -1 --format=%ct 2>/dev/null || date +%s)
# debhelper gives programs a home of their own, where ccache knows nothing.
CCACHE_DIR=${CCACHE_DIR:-$HOME/.cache/ccache}
export SOURCE_DATE_EPOCH CCACHE_DIR JOBS=$jobs
mkdir -p $packages

make_page() {
    # make knows whether the page is older than what it is made of.
    if command -v npm >/dev/null && make --no-print-directory viewer; then return; fi
    if [ ! -f build/viewer/playback.html ]; then
        echo "package: without the page that plays a run in a browser: \`make viewer\` makes it and needs npm" >&2
    elif [ -n "$(find viewer/*.json viewer/*.mjs viewer/.npmrc viewer/src -type f -newer build/viewer/playback.html)" ]
    then
        echo "package: the page that plays a run in a browser is older than viewer/: \`make viewer\` makes it anew" >&2
    fi
}

# A copy of what git knows of the tree, which nothing that was built before can reach.
copy_tree() { # FOLDER
    rm -rf "$1"
    mkdir -p "$1"
    tools/sources.sh | grep -v '^tests/\|^validation/\|^viewer/' | tar -c -T - | tar -x -C "$1"
    # What scenes/real_input.yaml reads.
    mkdir -p "$1/tests/data"
    cp tests/data/cracked_panels.gdf tests/data/floes.geojson "$1/tests/data"
    if [ -f build/viewer/playback.html ]; then
        mkdir -p "$1/build/viewer"
        cp build/viewer/playback.html "$1/build/viewer"
    fi
}

deb() {
    local tree=build/deb/fram-$version
    copy_tree "$tree"
    cp -r packaging/debian "$tree/debian"
    # The top-level domain `invalid` is reserved for addresses that are none (RFC 2606).
    cat >"$tree/debian/changelog" <<END
fram ($version) unstable; urgency=medium

  * See changelog.gz for what changed.

 -- Fram contributors <maintainers@fram.invalid>  $(date -R -u -d "@$SOURCE_DATE_EPOCH")
END
    echo "package: building in $tree (log: build/deb/build.log)"
    (cd "$tree" && DEB_BUILD_OPTIONS="noautodbgsym parallel=$jobs" dpkg-buildpackage -us -uc -b) \
        >build/deb/build.log 2>&1 || { tail -n 30 build/deb/build.log >&2; exit 1; }
    tools/check_documents.py --installed "$tree/debian/fram/usr/share/doc/fram"
    rm -f $packages/*.deb
    mv build/deb/*.deb $packages
    lintian --allow-root --fail-on warning $packages/*.deb
    ls -s --human-readable -1 $packages/*.deb
}

# Letters for pictures where the system has none.
carry_font() { # FOLDER
    mkdir -p "$1/share/fram/fonts"
    cp /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf /usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf \
        "$1/share/fram/fonts/"
    cp packaging/archive/fonts.conf "$1/share/fram/"
    cp /usr/share/doc/fonts-dejavu-core/copyright "$1/share/doc/fram/licences/fonts-dejavu-core.txt"
}

archive() {
    local name folder
    name=fram-$version-linux-$(uname -m)
    folder=build/archive_tree/$name
    rm -rf build/archive_tree
    cmake --preset archive --log-level=WARNING
    cmake --build --preset archive -j"$jobs" --target fram_command fram_shared fram_static fram_fmu
    python3 tools/manual_page.py build/archive/fram build/archive/fram.1
    cmake --install build/archive --prefix "$folder" --strip >/dev/null
    mkdir -p "$folder/bin" "$folder/tests/data"
    cp packaging/archive/fram "$folder/bin/fram"
    cp packaging/archive/README.md CHANGELOG.md "$folder"
    cp -r scenes "$folder"
    cp tests/data/cracked_panels.gdf tests/data/floes.geojson "$folder/tests/data"
    tools/carried.py "$folder/libexec/fram" "$folder"
    carry_font "$folder"
    tools/check_documents.py --installed "$folder" --without docs/
    tar -c -z -C build/archive_tree --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" \
        -f "$packages/$name.tar.gz" "$name"
    ls -s --human-readable -1 "$packages/$name.tar.gz"
}

case ${1:-} in
deb) make_page && deb ;;
archive) make_page && archive ;;
*)
    echo "usage: tools/package.sh deb|archive" >&2
    exit 2
    ;;
esac
