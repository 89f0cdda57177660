# SPDX-License-Identifier: MIT
"""Gate: who may include whom.  usage: includes.py ROOT

base <- {sense, move, place} <- fuse <- track <- tools; the three middle rooms never include each
other; between the stems of a room includes run one way; tools/sim uses base alone; the library
takes nothing from an operating system.
"""
import re
from pathlib import PurePosixPath

import common

ROOMS = {
    "base": {"base"},
    "sense": {"base", "sense"},
    "move": {"base", "move"},
    "place": {"base", "place"},
    "fuse": {"base", "sense", "move", "place", "fuse"},
    "track": {"base", "sense", "move", "place", "fuse", "track"},
}
SYSTEM = {"float.h", "limits.h", "stdbool.h", "stddef.h", "stdint.h", "string.h"}
MATH_HOME = "include/insole/base/real.h"
UMBRELLA = "include/insole/insole.h"

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.M)


def included(path):
    return INCLUDE.findall(common.without_comments(path.read_text()))


def room_and_stem(name):
    """("move", "zupt_ekf") of src/move/zupt_ekf.c, include/insole/move/... or insole/move/..."""
    parts = PurePosixPath(name).parts
    return (parts[-2], PurePosixPath(name).stem) if len(parts) >= 3 else ("", "")


def library_problems(name, includes):
    room, _ = room_and_stem(name)
    if room not in ROOMS:
        return [f"{name}: not in one of the rooms {', '.join(ROOMS)}"]
    problems = []
    for bracket, target in includes:
        if bracket == "<":
            if target not in SYSTEM and not (target == "math.h" and name == MATH_HOME):
                problems.append(f"{name}: includes <{target}>")
        elif not target.startswith("insole/"):
            problems.append(f'{name}: "{target}" is not written as "insole/room/stem.h"')
        elif room_and_stem(target)[0] not in ROOMS[room]:
            problems.append(f'{name}: {room} may not include "{target}"')
    return problems


def sim_problems(name, includes):
    return [f'{name}: tools/sim uses base alone, not "{target}"' for _, target in includes
            if target.startswith("insole/") and room_and_stem(target)[0] != "base"]


def cycle(edges):
    """A list of stems that include each other in a ring, or None."""
    state, trail = {}, []

    def visit(stem):
        state[stem] = "open"
        trail.append(stem)
        for other in sorted(edges.get(stem, ())):
            if state.get(other) == "open":
                return trail[trail.index(other):] + [other]
            if other not in state:
                found = visit(other)
                if found:
                    return found
        state[stem] = "done"
        trail.pop()
        return None

    for stem in sorted(edges):
        if stem not in state:
            found = visit(stem)
            if found:
                return found
    return None


def check(root):
    problems, edges = [], {}
    for path in common.files(root, common.LIBRARY, {".c", ".h"}):
        name = common.short(root, path)
        if name == UMBRELLA:
            continue
        includes = included(path)
        problems += library_problems(name, includes)
        stem = "/".join(room_and_stem(name))
        others = {"/".join(room_and_stem(t)) for b, t in includes if b == '"'}
        edges.setdefault(stem, set()).update(others - {stem, "/"})
    ring = cycle(edges)
    if ring:
        problems.append("includes run in a ring: " + " -> ".join(ring))
    for path in common.files(root, ["tools/sim"], {".c", ".h"}):
        problems += sim_problems(common.short(root, path), included(path))
    return problems


if __name__ == "__main__":
    common.finish("includes", check(common.root_argument()))
