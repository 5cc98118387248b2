#!/bin/sh
# Build for WebAssembly, from Debian's sources, the libraries that Fram cannot do without: GEOS, libfyaml, zlib, libpng,
# nettle.  They and all that is made on the way lie outside the repository.
#   tools/wasm_libraries.sh FOLDER     about 60 MB of sources, 20 minutes of one core; a second call finds them there
# Needs emscripten, dpkg-dev and an apt that reaches Debian's archive; no root, and apt's own lists are left alone.
set -eu

[ $# -eq 1 ] || [ $# -eq 2 ] || { echo "usage: tools/wasm_libraries.sh FOLDER" >&2; exit 2; }
mkdir -p "$1"
here=$(cd "$(dirname "$0")" && pwd)
self=$here/$(basename "$0")
top=$(cd "$1" && pwd)
prefix=$top/prefix
# Whoever works on the machine meanwhile goes first.
run() { nice -n 10 "$@"; }
jobs=${JOBS:-1}
# Modules of Debian's node packages, where another node would not look for them.
export NODE_PATH="${NODE_PATH:-/usr/share/nodejs}" EMSDK_PYTHON="${EMSDK_PYTHON:-/usr/bin/python3}"
# The arithmetic of Fram (docs/decisions/0002).
flags="-O2 -ffp-contract=off"
release=bookworm

fetch() {
    mkdir -p "$top/apt/lists/partial" "$top/sources"
    printf 'deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] %s %s main\n' \
        "$("$here/mirror.sh" "$release")" "$release" >"$top/apt/sources.list"
    set -- -qq -o "Dir::Etc::sourcelist=$top/apt/sources.list" -o Dir::Etc::sourceparts=/dev/null \
        -o "Dir::State::lists=$top/apt/lists" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache=
    apt-get "$@" update
    (cd "$top/sources" && apt-get "$@" source geos libfyaml zlib libpng1.6 nettle)
}

# The folder of an unpacked source.
source_of() {
    for folder in "$top/sources/$1"-[0-9]*; do
        [ -d "$folder" ] && echo "$folder" && return
    done
    echo "wasm_libraries: the source of $1 was not unpacked under $top/sources" >&2
    return 1
}

# What is said of those who made what goes into the page, for who hands it on: prefix/licences/NAME.txt.
carry_licences() {
    mkdir -p "$prefix/licences"
    for name in geos libfyaml zlib libpng1.6 nettle; do
        [ -e "$prefix/licences/$name.txt" ] || cp "$(source_of "$name")/debian/copyright" "$prefix/licences/$name.txt"
    done
    # Its C and C++ library.
    [ -e "$prefix/licences/emscripten.txt" ] ||
        cp /usr/share/doc/emscripten/copyright "$prefix/licences/emscripten.txt"
}

# pkg-config's description: NAME VERSION LIBRARIES
describe() {
    mkdir -p "$prefix/lib/pkgconfig"
    cat >"$prefix/lib/pkgconfig/$1.pc" <<END_OF_PC
Name: $1
Description: $1 for WebAssembly
Version: $2
Libs: -L$prefix/lib $3
Cflags: -I$prefix/include
END_OF_PC
}

version_of() { basename "$1" | sed 's|^[a-z]*1*[.6]*-||; s|[^0-9.].*||; s|[.]$||'; }

build_zlib() {
    cd "$(source_of zlib)"
    mkdir -p objects
    for file in adler32 compress crc32 deflate gzclose gzlib gzread gzwrite infback inffast inflate inftrees trees \
        uncompr zutil; do
        # shellcheck disable=SC2086  # flags are words
        run emcc $flags -DHAVE_UNISTD_H -c "$file.c" -o "objects/$file.o"
    done
    emar rcs "$prefix/lib/libz.a" objects/*.o
    cp zlib.h zconf.h "$prefix/include"
    describe zlib "$(version_of "$PWD")" -lz
}

build_png() {
    cd "$(source_of libpng1.6)"
    cp scripts/pnglibconf.h.prebuilt pnglibconf.h
    mkdir -p objects
    for file in png pngerror pngget pngmem pngpread pngread pngrio pngrtran pngrutil pngset pngtrans pngwio pngwrite \
        pngwtran pngwutil; do
        # shellcheck disable=SC2086  # flags are words
        run emcc $flags -I. "-I$prefix/include" -c "$file.c" -o "objects/$file.o"
    done
    emar rcs "$prefix/lib/libpng.a" objects/*.o
    cp png.h pngconf.h pnglibconf.h "$prefix/include"
    describe libpng "$(version_of "$PWD")" "-lpng -lz"
}

# What Fram calls of it alone: SHA-256 and base64.
build_nettle() {
    cd "$(source_of nettle)"
    mkdir -p objects "$prefix/include/nettle"
    printf '#define ALIGNOF_UINT64_T 8\n' >config.h
    for file in sha256 sha256-compress base64-encode base64-decode write-be32; do
        # shellcheck disable=SC2086
        run emcc $flags -DHAVE_CONFIG_H -I. -c "$file.c" -o "objects/$file.o"
    done
    emar rcs "$prefix/lib/libnettle.a" objects/*.o
    cp base64.h nettle-types.h sha2.h "$prefix/include/nettle"
    describe nettle "$(version_of "$PWD")" -lnettle
}

build_fyaml() {
    cd "$(source_of libfyaml)"
    mkdir -p objects
    cat >config.h <<END_OF_CONFIG
#define VERSION "$(version_of "$PWD")"
#define PACKAGE_VERSION VERSION
#define HAVE_BYTESWAP_H 1
#define HAVE_DECL_ENVIRON 0
#define HAVE_TERMIOS_H 1
#define HAVE_UNISTD_H 1
END_OF_CONFIG
    for file in src/lib/*.c; do
        # shellcheck disable=SC2086
        run emcc $flags -D_GNU_SOURCE -DHAVE_CONFIG_H -I. -Iinclude -Isrc/lib -Isrc/xxhash -c "$file" \
            -o "objects/$(basename "$file" .c).o"
    done
    # shellcheck disable=SC2086
    run emcc $flags -Isrc/xxhash -c src/xxhash/xxhash.c -o objects/xxhash.o
    emar rcs "$prefix/lib/libfyaml.a" objects/*.o
    cp include/libfyaml.h "$prefix/include"
    describe libfyaml "$(version_of "$PWD")" -lfyaml
}

build_geos() {
    source=$(source_of geos)
    mkdir -p "$top/geos" && cd "$top/geos"
    emcmake cmake "$source" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF \
        -DBUILD_BENCHMARKS=OFF -DBUILD_GEOSOP=OFF "-DCMAKE_INSTALL_PREFIX=$prefix" \
        "-DCMAKE_PROJECT_GEOS_INCLUDE=$here/../cmake/wasm_geos.cmake" \
        "-DCMAKE_CXX_FLAGS=-fexceptions -ffp-contract=off" "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG"
    run cmake --build . -j"$jobs"
    cmake --install . >/dev/null
    describe geos "$(version_of "$source")" "-lgeos_c -lgeos"
}

# One library, unless it is there; what its making says goes to a file.
library() {
    [ -e "$prefix/$1.done" ] && return
    echo "wasm_libraries: building $1"
    # A shell of its own: within a condition this one would not stop at a failure.
    if ! "$self" "$top" "$1" >"$top/$1.log" 2>&1; then
        tail -n 20 "$top/$1.log" >&2
        echo "wasm_libraries: $1 could not be built; the whole log is $top/$1.log" >&2
        exit 1
    fi
    touch "$prefix/$1.done"
}

mkdir -p "$prefix/lib" "$prefix/include"
if [ $# -eq 2 ]; then
    "build_$2"
    exit
fi
if [ -e "$prefix/complete" ]; then
    carry_licences
    exit
fi
if [ ! -e "$top/sources/complete" ]; then
    echo "wasm_libraries: fetching Debian's sources"
    fetch >"$top/fetch.log" 2>&1 || { tail -n 5 "$top/fetch.log" >&2; exit 1; }
    touch "$top/sources/complete"
fi
for name in zlib png nettle fyaml geos; do
    library "$name"
done
carry_licences
touch "$prefix/complete"
