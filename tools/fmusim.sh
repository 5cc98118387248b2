#!/usr/bin/env bash
# Build fmusim, the Modelica Association's program that simulates FMI units, outside the repository, so that the test
# fmi/fmusim can try Fram's units with it.
#   git clone --branch v0.0.39 https://github.com/modelica/Reference-FMUs
#   tools/fmusim.sh Reference-FMUs FOLDER
#   FRAM_FMUSIM=FOLDER/fmusim ctest --test-dir build/release -R fmi/fmusim -V
#
# v0.0.39 is the last version of fmusim in C (2025; 0.8 of 2026, github.com/modelica/fmusim, is in Rust and takes some
# two hundred crates).  Its own build downloads CVODE, libxml2 and zlib; here Debian's packages stand in, unpacked into
# FOLDER without being installed: libsundials-dev with what it links to, libminizip-dev, libxml2-dev, zlib1g-dev.
# Debian 12's SUNDIALS is 6.4, which has no SUN_COMM_NULL; that is a NULL there.  Units for co-simulation do not use it.
set -euo pipefail
[ $# -eq 2 ] || {
    echo "usage: tools/fmusim.sh SOURCES FOLDER" >&2
    exit 2
}
source=$(realpath "$1")
[ -f "$source/fmusim/fmusim.c" ] || {
    echo "$source holds no fmusim/fmusim.c: take Reference-FMUs v0.0.39" >&2
    exit 2
}
mkdir -p "$2/packages" "$2/root"
folder=$(realpath "$2")
packages=(libsundials-dev libsundials-cvode6 libsundials-nvecserial6 libsundials-sunlinsol3 libsundials-sunmatrix4
    libminizip-dev libxml2-dev zlib1g-dev)
(cd "$folder/packages" && apt-get download "${packages[@]}")
for package in "$folder"/packages/*.deb; do dpkg-deb -x "$package" "$folder/root"; done

root=$folder/root/usr
libraries=$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || gcc -print-multiarch)
lib=$root/lib/$libraries
cd "$source"
parts=(fmusim/{csv,FMIUtil,FMIEuler,FMICVode,FMIModelDescription,FMIRecorder,FMIZip,FMISimulation,FMIStaticInput}.c
    fmusim/FMI{1,2,3}{CS,ME}Simulation.c fmusim/{fmusim,miniunzip}.c src/FMI{,1,2,3}.c
    src/structured_variable_name.{yy,tab}.c)
gcc -O1 -w -fvisibility=hidden -DFMUSIM_VERSION='"0.0.39"' -DSUN_COMM_NULL=NULL \
    -Ifmusim -Iinclude -I"$root/include" -I"$root/include/libxml2" -I"$root/include/minizip" "${parts[@]}" \
    "$lib"/libsundials_{cvode,sunlinsoldense,sunmatrixdense,nvecserial,generic}.a "$lib/libminizip.a" \
    -lxml2 -lz -ldl -lm -o "$folder/fmusim"
"$folder/fmusim" --version
