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
# Two seconds of rest at 100 Hz go in; 200 places come out, none of them far away.
awk 'BEGIN { for (i = 0; i < 200; i++) printf "%.2f,0.1,-0.2,9.8,0,0,0\n", i / 100 }' >"$work/rest"
run "$work/readme" <"$work/rest" >"$work/fixes"
awk '$3 * $3 + $4 * $4 < 0.01 { n++ } END { exit n != 200 }' "$work/fixes" ||
    fail "the program of README.md should print 200 places near the start: $(wc -l <"$work/fixes")"
