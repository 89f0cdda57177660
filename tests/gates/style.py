# SPDX-License-Identifier: MIT
"""Gate: sizes of functions and files.  usage: style.py ROOT

Code lines are lines without comments and blanks. The statistics are printed for the library and
for the tools; the limits hold for both.
"""
import re

import common

MAX_FUNCTION = 60
MAX_NINETY_PERCENT = 30
MAX_MEDIAN = 12
MAX_FILE = 400
MAX_COLUMNS = 100
MAX_BRANCHES = 12

BRANCH = re.compile(r"\b(?:if|for|while|case)\b|&&|\|\||\?")


def quantile(values, share):
    return sorted(values)[min(int(share * len(values)), len(values) - 1)]


def measure(path):
    """[(function, code lines, cyclomatic complexity)]"""
    text = path.read_text()
    lines = common.code_only(text).splitlines()
    measured = []
    for function in common.functions(text):
        body = [line for line in lines[function.body_first - 1:function.last] if line.strip()]
        measured.append((function.name, len(body), 1 + len(BRANCH.findall("\n".join(body)))))
    return measured


def check_file(root, path):
    name, text = common.short(root, path), path.read_text()
    problems = [f"{name}:{n}: {len(line)} columns, at most {MAX_COLUMNS}"
                for n, line in enumerate(text.splitlines(), 1) if len(line) > MAX_COLUMNS]
    length = len(text.splitlines())
    if length > MAX_FILE:
        problems.append(f"{name}: {length} lines, at most {MAX_FILE}")
    for function, lines, branches in measure(path):
        if lines > MAX_FUNCTION:
            problems.append(f"{name}: {function} has {lines} code lines, at most {MAX_FUNCTION}")
        if branches > MAX_BRANCHES:
            problems.append(f"{name}: {function} branches {branches} times, at most {MAX_BRANCHES}")
    return problems


def check_group(root, name, folders):
    """(problems, one line of statistics)"""
    paths = common.files(root, folders, {".c", ".h"})
    problems = [p for path in paths for p in check_file(root, path)]
    lengths = [lines for path in paths for _, lines, _ in measure(path)]
    if not lengths:
        return problems, f"{name}: no functions"
    median, ninety = quantile(lengths, 0.5), quantile(lengths, 0.9)
    if median > MAX_MEDIAN:
        problems.append(f"{name}: the median function has {median} code lines, at most {MAX_MEDIAN}")
    if ninety > MAX_NINETY_PERCENT:
        problems.append(f"{name}: 90 % of the functions have up to {ninety} code lines, "
                        f"at most {MAX_NINETY_PERCENT}")
    return problems, (f"{name}: {len(lengths)} functions, code lines median {median}, "
                      f"90 % {ninety}, longest {max(lengths)}")


def check(root):
    problems, notes = [], []
    for name, folders in (("library", common.LIBRARY), ("tools", ["tools"])):
        found, statistics = check_group(root, name, folders)
        problems += found
        notes.append(statistics)
    return problems, "\n".join(notes)


if __name__ == "__main__":
    common.finish("style", *check(common.root_argument()))
