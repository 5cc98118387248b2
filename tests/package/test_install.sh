#!/usr/bin/env bash
# What `make install` leaves is usable: a small program is built against it by pkg-config and by find_package, shared
# and static, and runs; a package built with DESTDIR names nothing of the building machine.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() {
    echo "$*" >&2
    exit 1
}

echo "make builds what make install installs"
built=$(cd "$FRAM_SOURCE" && make -n build | sed -n 's/.*--preset release .*--target//p')
installed=$(sed -n 's/^ *install(TARGETS \([a-z_]*\).*/\1/p' "$FRAM_SOURCE/CMakeLists.txt")
for target in $installed; do
    case " $built " in
    *" $target "*) ;;
    *) fail "make install needs $target, which make does not build" ;;
    esac
done

echo "the static library waits for what makes its objects"
# Targets that are waited for stand behind two bars.  Instrumented builds join no objects.
rules=$FRAM_BUILD/build.ninja
if [ -f "$rules" ]; then
    waits=$(sed -n 's/^build libfram\.a:.*||//p' "$rules")
    makers=$(sed -n 's/^build fram_joined\.o //p' "$rules" | grep -o '[a-z0-9_]*\.dir' | sort -u || true)
    for maker in ${makers//.dir/}; do
        [[ " $waits " = *" $maker "* ]] || fail "libfram.a does not wait for $maker"
    done
fi

version=$(sed -n 's/.*FRAM_VERSION_\(MAJOR\|MINOR\|PATCH\) \([0-9]*\)/\2/p' "$FRAM_SOURCE/include/fram/version.h" |
    paste -sd.)
prefix=$scratch/prefix
cmake --install "$FRAM_BUILD" --prefix "$prefix" >"$scratch/install.log"
consumer=$FRAM_SOURCE/tests/package/consumer
# grep reads to the end: with -q it would end nm by a broken pipe, which counts as a failure here.
if ! nm -D --defined-only "$FRAM_BUILD/libfram.so" | grep ' fram_version$' >/dev/null; then
    echo "skipped: the library has no public calls yet"
    exit 77
fi

PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name fram.pc)")
export PKG_CONFIG_PATH
lib=$(dirname "$PKG_CONFIG_PATH")
export LD_LIBRARY_PATH=$lib
# The folder that docs/packages.md names.
# shellcheck disable=SC2016  # those of Markdown
told=$(sed -n 's/.*`PKG_CONFIG_PATH=PREFIX\/\([^`]*\)`.*/\1/p' "$FRAM_SOURCE/docs/packages.md")
[ "$PKG_CONFIG_PATH" = "$prefix/$told" ] || fail "fram.pc is in $PKG_CONFIG_PATH, not in PREFIX/$told"
[ "$(pkg-config --modversion fram)" = "$version" ] || fail "fram.pc has another version than $version"

echo "pkg-config, shared"
# shellcheck disable=SC2046  # flags are words
cc -std=c17 -Wall -Wextra -Wpedantic -Werror -o "$scratch/shared" "$consumer/consumer.c" \
    $(pkg-config --cflags --libs fram)
[ "$("$scratch/shared")" = "$version" ] || fail "the shared consumer failed"
# objdump shows the soname that programs are bound to.
objdump -p "$scratch/shared" | grep "NEEDED *libfram.so.${version%%.*}$" >/dev/null || fail "bound to another soname"

echo "pkg-config, static"
# shellcheck disable=SC2046
cc -std=c17 -o "$scratch/static" "$consumer/consumer.c" $(pkg-config --cflags fram) "$lib/libfram.a" \
    $(pkg-config --static --libs fram | sed 's/-lfram\b//')
[ "$(env -u LD_LIBRARY_PATH "$scratch/static")" = "$version" ] || fail "the static consumer failed"

echo "examples at the heads of headers"
for header in fram live hull field ice; do
    # Lines of the first comment that are indented by seven; what they take as given stands before them.
    {
        echo "#include <fram/live.h>"
        echo "#include <fram/$header.h>"
        echo "#include <stdio.h>"
        echo "extern fram_world *world; extern fram_context *context; double controller(double);"
        echo "void example(void); void example(void) {"
        [ $header = fram ] || echo "fram_error error;"
        sed '/\*\//q' "$prefix/include/fram/$header.h" | sed -n 's/^       //p'
        echo "}"
    } >"$scratch/example.c"
    [ "$(wc -l <"$scratch/example.c")" -ge 11 ] || fail "$header.h begins without an example"
    # shellcheck disable=SC2046
    cc -std=c17 -Wall -Wextra -Werror -fsyntax-only $(pkg-config --cflags fram) "$scratch/example.c" ||
        fail "the example of $header.h is no C"
done

if command -v c++ >/dev/null; then
    echo "C++"
    # shellcheck disable=SC2046
    c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror -o "$scratch/plus" "$consumer/consumer.cpp" \
        $(pkg-config --cflags --libs fram)
    "$scratch/plus" || fail "the C++ consumer failed"
fi

echo "find_package, shared and static"
cmake -S "$consumer" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$prefix" -DFRAM_WANTED="$version" >"$scratch/cmake.log" ||
    fail "$(cat "$scratch/cmake.log")"
cmake --build "$scratch/build" >"$scratch/cmake.log" || fail "$(cat "$scratch/cmake.log")"
for kind in shared static; do
    [ "$("$scratch/build/consumer_$kind")" = "$version" ] || fail "the $kind consumer of find_package failed"
done

echo "find_package says what it misses"
# What pkg-config answered before is asked anew, in an empty folder.
if PKG_CONFIG_PATH='' PKG_CONFIG_LIBDIR=$scratch/none cmake -U '__pkg_config*' -DFRAM_COMPONENTS='static;shared' \
    "$scratch/build" >"$scratch/cmake.log" 2>&1; then
    fail "components that are not there were found"
fi
told=$(tr -s ' \n' ' ' <"$scratch/cmake.log")
for words in "was not found: geos, libfyaml, libpng, zlib, nettle" 'no component shared, only "static"'; do
    [[ $told = *"$words"* ]] || fail "find_package does not say \"$words\": $(cat "$scratch/cmake.log")"
done

echo "part of another project"
mkdir "$scratch/parent"
echo "cmake_minimum_required(VERSION 3.22)
project(parent NONE)
add_subdirectory(\"$FRAM_SOURCE\" fram)" >"$scratch/parent/CMakeLists.txt"
if cmake -S "$scratch/parent" -B "$scratch/parent/build" >"$scratch/cmake.log" 2>&1; then
    fail "Fram was taken as part of another project"
fi
grep -qF 'find_package(Fram)' "$scratch/cmake.log" || fail "it is not told what to do: $(cat "$scratch/cmake.log")"

echo "folders of others, whatever the umask"
private=$scratch/private/prefix
line=$(cd "$FRAM_SOURCE" && make -n install PREFIX="$private" | grep -e '--install build/release')
line=${line/--install build\/release/--install \"$FRAM_BUILD\"}
(umask 077 && cd "$FRAM_SOURCE" && sh -c "$line" >"$scratch/install.log")
closed=$(find "$private" -type d ! -perm -755)
[ -z "$closed" ] || fail "nobody else may look into: $closed"

echo "removed again, as docs/packages.md says"
line=$(sed -n 's/^    \(xargs .*install_manifest.*\)/\1/p' "$FRAM_SOURCE/docs/packages.md")
[ -n "$line" ] || fail "docs/packages.md does not say how"
sh -c "${line/build\/release/\"$FRAM_BUILD\"}"
left=$(find "$private" ! -type d)
[ -z "$left" ] || fail "left behind: $left"

echo "DESTDIR"
DESTDIR=$scratch/stage cmake --install "$FRAM_BUILD" --prefix /usr >"$scratch/install.log"
[ -x "$scratch/stage/usr/bin/fram" ] || [ -z "${FRAM:-}" ] || fail "no command in the staged package"
# Machine paths may not travel in a package.
found=$(grep -rlF -e "$FRAM_SOURCE" -e "$scratch" "$scratch/stage" || true)
[ -z "$found" ] || fail "the path of the building machine stands in: $found"
