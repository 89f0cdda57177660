# SPDX-License-Identifier: MIT
"""What the gates share: reading C without a compiler, and saying what is wrong.

A gate is a function `check(root, ...)` that returns a list of problems, one line each; `main`
prints them and turns them into an exit code.
"""
import re
import sys
from collections import namedtuple
from pathlib import Path

LIBRARY = ("src", "include")
SKIPPED = 77

Function = namedtuple("Function", "name first last body_first")
"""A function definition: lines (from 1) of its comment's begin, its end and its signature."""


def files(root, folders, suffixes):
    """Files below the folders whose names end so, in a fixed order."""
    found = []
    for folder in folders:
        found += [p for p in (root / folder).rglob("*") if p.is_file() and p.suffix in suffixes]
    return sorted(found)


def short(root, path):
    return path.relative_to(root).as_posix()


def blank(match):
    """A replacement that keeps the line breaks, so that line numbers stay true."""
    return "\n" * match.group(0).count("\n") or " "


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", blank, text, flags=re.S)


def code_only(text):
    """Text without comments, strings, preprocessor lines and `extern "C"` blocks."""
    text = without_comments(text)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', '""', text)
    text = re.sub(r"^[ \t]*#[ \t]*ifdef __cplusplus.*?^[ \t]*#[ \t]*endif[^\n]*", blank, text,
                  flags=re.S | re.M)
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.M)


def code_lines(text):
    """Number of lines that hold more than comments and blanks."""
    return sum(1 for line in without_comments(text).splitlines() if line.strip())


def functions(text):
    """The functions that a C text defines, in order."""
    code = code_only(text)
    commented = text.splitlines()
    found, depth, statement = [], 0, 0
    for at, char in enumerate(code):
        if char == "{":
            if depth == 0:
                head = code[statement:at].strip()
                begin = statement + len(code[statement:at]) - len(code[statement:at].lstrip())
            depth += 1
        elif char == "}":
            depth -= 1
            if depth == 0:
                if head.endswith(")") and "=" not in head:
                    signature = code.count("\n", 0, begin) + 1
                    found.append(Function(defined_name(head), comment_above(commented, signature),
                                          code.count("\n", 0, at) + 1, signature))
                statement = at + 1
        elif char == ";" and depth == 0:
            statement = at + 1
    return found


def defined_name(head):
    """`f` of `static int f(int a)`."""
    head = re.sub(r"__attribute__\s*\(\(.*?\)\)", "", head, flags=re.S)
    return re.search(r"(\w+)\s*\(", head).group(1)


def comment_above(lines, signature):
    """First line of the comment that ends on the line before the signature, else the signature."""
    line = signature - 1
    if line < 1 or not lines[line - 1].rstrip().endswith("*/"):
        return signature
    while line >= 1 and "/*" not in lines[line - 1]:
        line -= 1
    return max(line, 1)


def finish(name, problems, note=""):
    """Prints what was found and ends the program."""
    for problem in problems:
        print(problem)
    if note:
        print(note)
    print(f"{name}: {len(problems)} problem(s)" if problems else f"{name}: fine")
    sys.exit(1 if problems else 0)


def skip(why):
    print(f"SKIPPED: {why}")
    sys.exit(SKIPPED)


def root_argument():
    return Path(sys.argv[1]).resolve()
