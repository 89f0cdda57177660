# SPDX-License-Identifier: MIT
# Sourced by the scripts beside it. $work is the scratch folder; the library lands in $work/prefix.
prefix=$work/prefix
strict='-Wall -Wextra -Wpedantic -Werror'

fail() {
    printf 'FAILED: %s\n' "$1" >&2
    exit 1
}

# The flags that the installed insole.pc gives.
pc() {
    PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name insole.pc)") pkg-config "$@" insole
}

# Finds a shared library where it was installed, the way a user's LD_LIBRARY_PATH would.
run() {
    LD_LIBRARY_PATH=$(pc --variable=libdir) "$@" || fail "$* exits with $?"
}
