# SPDX-License-Identifier: MIT
"""Gate: the tree is complete and tidy.  usage: tree.py ROOT

Nothing stands outside the agreed top level, every file names its licence, every stem has header,
source and suite, the umbrella header names them all, version numbers agree, no note of unfinished
work is left, and there is at least twice as much test as library.
"""
import re
import subprocess

import common

TOP = {"CMakeLists.txt", "README.md", "LICENSE", "CHANGELOG.md", "CITATION.cff", ".gitignore",
       ".clang-format", ".clang-tidy", "CMakePresets.json", "src", "include", "tests", "tools",
       "maps", ".ci"}
# Headers of types and macros alone: nothing in them could be tested.
DATA_HEADERS = {"base/config", "base/real", "base/types"}
NO_LICENCE_LINE = re.compile(r"^LICENSE$|^tests/fuzz/corpus/|\.(png|bin)$")
UNFINISHED = re.compile(r"\b(?:TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b")
MACHINE_PATH = re.compile(r"(?<![\w.])/(?:wor" r"k|home|roo" r"t)/")
MIN_TEST_RATIO = 2.0
TEST_SUFFIXES = {".c", ".h", ".cpp", ".py", ".sh", ".cmake"}


def tracked(root):
    """Names of the files under version control; without git, of those in the agreed places."""
    listing = subprocess.run(["git", "-C", str(root), "ls-files", "-co", "--exclude-standard"],
                             capture_output=True, text=True, check=False)
    if listing.returncode == 0:
        names = listing.stdout.splitlines()
    else:
        names = [common.short(root, p) for top in TOP for p in
                 ([root / top] if (root / top).is_file() else (root / top).rglob("*"))]
    return sorted(n for n in names if (root / n).is_file() and "__pycache__" not in n)


def text_problems(root, name):
    text = (root / name).read_text(errors="replace")
    problems = []
    if not NO_LICENCE_LINE.search(name) and "SPDX-License-Identifier: MIT" not in text:
        problems.append(f"{name}: no SPDX-License-Identifier: MIT")
    for number, line in enumerate(text.splitlines(), 1):
        for what, pattern in (("left unfinished", UNFINISHED), ("machine path", MACHINE_PATH)):
            if pattern.search(line):
                problems.append(f"{name}:{number}: {what}: {line.strip()}")
    return problems


def stem_problems(root, names):
    headers = {n[len("include/insole/"):-2] for n in names
               if re.fullmatch(r"include/insole/\w+/\w+\.h", n)}
    sources = {n[len("src/"):-2] for n in names if re.fullmatch(r"src/\w+/\w+\.c", n)}
    suites = {re.sub(r".*/test_(\w+)\.c", r"\1", n) for n in names
              if re.fullmatch(r"tests/unit/test_\w+\.c", n)}
    umbrella = (root / "include/insole/insole.h").read_text()
    problems = [f"src/{s}.c has no header include/insole/{s}.h" for s in sorted(sources - headers)]
    for stem in sorted(headers):
        if stem not in DATA_HEADERS and stem.split("/")[1] not in suites:
            problems.append(f"{stem} has no suite tests/unit/test_{stem.split('/')[1]}.c")
        if f'#include "insole/{stem}.h"' not in umbrella:
            problems.append(f"include/insole/insole.h does not include insole/{stem}.h")
    return problems


def version_problems(root):
    """The project's number stands in CMakeLists.txt; others must follow it."""
    number = re.search(r"project\(insole VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())
    version = number.group(1)
    escaped = re.escape(version)
    parts = zip(("MAJOR", "MINOR", "PATCH"), version.split("."))
    wanted = {
        "include/insole/insole.h": [rf'INSOLE_VERSION\s+"{escaped}"$']
        + [rf"INSOLE_VERSION_{name}\s+{number}$" for name, number in parts],
        "CITATION.cff": [f"^version: {escaped}$"],
        "CHANGELOG.md": [rf"^## \[{escaped}\]"],
    }
    return [f"{name}: does not say {pattern}" for name, patterns in wanted.items()
            for pattern in patterns if not re.search(pattern, (root / name).read_text(), re.M)]


def script_lines(text):
    return sum(1 for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#"))


def test_ratio(root):
    """(code lines of the library, of the tests); comments and blanks do not count."""
    library = sum(common.code_lines(p.read_text())
                  for p in common.files(root, common.LIBRARY, {".c", ".h"}))
    tests = sum(common.code_lines(p.read_text()) if p.suffix in {".c", ".h", ".cpp"}
                else script_lines(p.read_text())
                for p in common.files(root, ["tests"], TEST_SUFFIXES))
    return library, tests


def check(root):
    names = tracked(root)
    problems = [f"{n}: outside the agreed top level" for n in names if n.split("/")[0] not in TOP]
    for name in names:
        problems += text_problems(root, name)
    problems += stem_problems(root, names) + version_problems(root)
    library, tests = test_ratio(root)
    if tests < MIN_TEST_RATIO * library:
        problems.append(f"{tests} code lines of tests for {library} of library: "
                        f"less than {MIN_TEST_RATIO:g} to 1")
    return problems, f"{library} code lines of library, {tests} of tests"


if __name__ == "__main__":
    common.finish("tree", *check(common.root_argument()))
