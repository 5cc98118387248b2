#!/bin/sh
# Build the simulator as WebAssembly and the page that runs it, build/wasm/fram.html: one file that works from disk.
#   tools/wasm.sh     FRAM_WASM: folder for the libraries (~/.cache/fram-wasm), built there once by wasm_libraries.sh
set -eu
cd "$(dirname "$0")/.."
libraries=${FRAM_WASM:-${XDG_CACHE_HOME:-$HOME/.cache}/fram-wasm}
# Modules of Debian's node packages, where another node would not look for them.
export NODE_PATH="${NODE_PATH:-/usr/share/nodejs}" EMSDK_PYTHON="${EMSDK_PYTHON:-/usr/bin/python3}"

tools/wasm_libraries.sh "$libraries"
libraries=$(cd "$libraries" && pwd)
export PKG_CONFIG_LIBDIR="$libraries/prefix/lib/pkgconfig" PKG_CONFIG_PATH=
if [ ! -e build/wasm/build.ninja ]; then
    mkdir -p build/wasm
    # The compiler that emcc would call, with what emcc would tell it: without emcc's own second for each file.
    compile="clang-14 $(emcc --cflags | sed 's/-fvisibility=default//')"
    compile="$compile <DEFINES> <INCLUDES> <FLAGS> -o <OBJECT> -c <SOURCE>"
    emcmake cmake -S . -B build/wasm -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release -DFRAM_UNITY=OFF \
        "-DCMAKE_C_FLAGS=-msimd128" "-DCMAKE_C_FLAGS_RELEASE=-O2 -DNDEBUG" "-DFRAM_WITHOUT=cairo;netcdf;libmicrohttpd" \
        -DFRAM_TESTS=OFF -DFRAM_CCACHE=OFF "-DCMAKE_C_COMPILE_OBJECT=$compile" \
        "-DCMAKE_FIND_ROOT_PATH=$libraries/prefix" >build/wasm/configure.log 2>&1 ||
        { tail -n 20 build/wasm/configure.log >&2; rm -f build/wasm/build.ninja; exit 1; }
fi
nice -n 10 cmake --build build/wasm -j"${JOBS:-2}" --target simulator
python3 tools/wasm_page.py build/wasm/simulator.js build/viewer/playback.html build/wasm/fram.html \
    "$libraries"/prefix/licences/*.txt
