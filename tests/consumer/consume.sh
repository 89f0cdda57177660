#!/bin/sh
# SPDX-License-Identifier: MIT
# usage: consume.sh static|shared SOURCE WORK
# Builds and installs the library, then what a user would build: a program in C and one in C++, by
# find_package, by pkg-config and by add_subdirectory. A shared library must have a SONAME and show
# public names only.
set -eu
kind=$1 source=$2 work=$3
here=$(dirname "$0")
. "$here/common.sh"

install_library() {
    [ "$kind" = shared ] && shared=ON || shared=OFF
    rm -rf "$work"
    "$CMAKE" -S "$source" -B "$work/build" -DCMAKE_BUILD_TYPE=Debug -DBUILD_SHARED_LIBS=$shared \
        -DINSOLE_BUILD_TESTS=OFF -DINSOLE_BUILD_TOOLS=ON -DCMAKE_INSTALL_PREFIX="$work/first"
    "$CMAKE" --build "$work/build" --parallel 2
    "$CMAKE" --install "$work/build"
    mv "$work/first" "$prefix" # an installed tree may be moved
}

# The program and its manual come along.
check_program() {
    [ -f "$source/tools/insole/CMakeLists.txt" ] || return 0
    run "$prefix/bin/insole" --help >"$work/help"
    grep -q replay "$work/help" || fail 'the installed program does not tell its commands'
    find "$prefix" -path '*/man1/insole.1*' | grep -q . || fail 'no manual page is installed'
}

# Every header stands on its own, in C99 and in C++11.
check_headers() {
    (cd "$prefix/include" && find insole -name '*.h') | sort >"$work/headers"
    [ "$(grep -c . "$work/headers")" -gt 5 ] || fail 'hardly any headers were installed'
    while read -r header; do
        echo "#include <$header>" >"$work/header.c"
        $CC -std=c99 $strict $(pc --cflags) -fsyntax-only "$work/header.c" || fail "$header in C99"
        if [ -n "$cxx" ]; then
            c++ -std=c++11 -x c++ $strict $(pc --cflags) -fsyntax-only "$work/header.c" ||
                fail "$header in C++11"
        fi
    done <"$work/headers"
}

use_find_package() {
    "$CMAKE" -S "$here/app" -B "$work/app" -DCMAKE_PREFIX_PATH="$prefix" -DWITH_CXX="$cxx"
    "$CMAKE" --build "$work/app"
    run "$work/app/consumer_c"
    [ -z "$cxx" ] || run "$work/app/consumer_cxx"
}

use_pkg_config() {
    version=$(pc --modversion)
    $CC -std=c99 $strict -DPACKAGE_VERSION="\"$version\"" $(pc --cflags) "$here/app/consumer.c" \
        $(pc --libs) -o "$work/by_pkg_config"
    run "$work/by_pkg_config"
}

use_subdirectory() {
    "$CMAKE" -S "$here/app" -B "$work/whole" -DINSOLE_SOURCE="$source" -DWITH_CXX="$cxx"
    "$CMAKE" --build "$work/whole" --parallel 2
    [ ! -e "$work/whole/insole/tests" ] || fail 'a part of another project builds its tests'
    run "$work/whole/consumer_c"
}

check_shared() {
    library=$prefix/$(cd "$prefix" && find . -name libinsole.so)
    readelf -d "$library" | grep -q 'SONAME.*libinsole\.so\.[0-9]' || fail 'no SONAME'
    nm -D --defined-only "$library" | awk '{print $NF}' >"$work/exports"
    grep -q '^insole_status_text$' "$work/exports" || fail 'public names are hidden'
    while read -r name; do
        grep -rqw "$name" "$prefix/include" || fail "$name is visible, but no header tells of it"
    done <"$work/exports"
}

install_library
cxx=
if command -v c++ >/dev/null; then
    cxx=ON
else
    echo 'no C++ compiler: C++ not tried'
fi
check_program
check_headers
use_find_package
use_pkg_config
[ "$kind" = shared ] || use_subdirectory
[ "$kind" = static ] || check_shared
