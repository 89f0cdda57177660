#!/bin/sh
# SPDX-License-Identifier: MIT
# usage: readme.sh SOURCE WORK
# The first C program of README.md compiles against the library installed in WORK, and runs.
set -eu
source=$1 work=$2
. "$(dirname "$0")/common.sh"

if ! grep -qs '^```c$' "$source/README.md"; then
    echo 'SKIPPED: README.md holds no C program yet'
    exit 77
fi
awk '/^```/ { if (inside) exit; if ($0 == "```c") { inside = 1; next } } inside' \
    "$source/README.md" >"$work/readme.c"
$CC -std=c99 $strict $(pc --cflags) "$work/readme.c" $(pc --libs) -o "$work/readme" ||
    fail 'the program of README.md does not compile'
run "$work/readme"
