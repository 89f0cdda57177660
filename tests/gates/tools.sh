#!/bin/sh
# SPDX-License-Identifier: MIT
# usage: tools.sh format|cppcheck|tidy|warnings ROOT [FOLDER...]
# Gates that are somebody else's program: clang-format, cppcheck, clang-tidy, and the warnings of
# gcc and clang as errors, in float and in double. Exit 77: not installed here.
set -u
gate=$1 root=$2
shift 2
cd "$root" || exit 1
[ $# -gt 0 ] || set -- src include tools

need() {
    command -v "$1" >/dev/null || { echo "SKIPPED: $1 is not installed"; exit 77; }
}

sources() { # FOLDER... : C files of a host build; the firmware is the cross compiler's
    find "$@" -name '*.c' ! -path '*/firmware/*' | sort
}

check_format() {
    need clang-format
    clang-format --version | grep -q 'version 14\.' ||
        { echo 'SKIPPED: other versions than clang-format 14 lay out differently'; exit 77; }
    find "$@" -name '*.[ch]' | sort | xargs clang-format --dry-run -Werror
}

check_cppcheck() {
    need cppcheck
    cppcheck --quiet --std=c99 --enable=warning,performance,portability --inline-suppr \
        -U INSOLE_DOUBLE -U __GNUC__ \
        --error-exitcode=1 -I include -I tools "$@"
}

check_tidy() {
    need clang-tidy
    sources "$@" | xargs -r -n 1 -P 2 sh -c \
        'clang-tidy --quiet --warnings-as-errors="*" "$0" -- -std=c99 -I include -I tools 2>/dev/null'
}

check_warnings() {
    failed=0
    flags='-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wstrict-prototypes'
    for compiler in gcc clang; do
        need $compiler
        for real in '' -DINSOLE_DOUBLE; do
            for source in $(sources "$@"); do
                $compiler -std=c99 -fsyntax-only $flags -Werror $real -I include -I tools \
                    -I "$(dirname "$source")" "$source" || failed=1
            done
        done
    done
    return $failed
}

"check_$gate" "$@"
status=$?
[ $status -eq 0 ] && echo "$gate: fine"
exit $status
