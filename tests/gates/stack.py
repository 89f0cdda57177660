# SPDX-License-Identifier: MIT
"""Gate: bounded stack.  usage: stack.py BUILD

Adds up gcc's frames (-fcallgraph-info=su) along the call graph of the library's objects below
BUILD. No recursion, no frame of variable size, no call through a pointer whose targets
indirect_calls.csv does not list, no outside function whose stack arm_symbols.csv does not tell.
"""
import re
import sys
from pathlib import Path

import arm
import common

HERE = Path(__file__).parent
SOURCE = re.compile(r'^graph: \{ title: "([^"]+)"', re.M)
NODE = re.compile(r'^node: \{ title: "([^"]+)" label: "([^"]*)"', re.M)
EDGE = re.compile(r'^edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"', re.M)
FRAME = re.compile(r"\\n(\d+) bytes \(([^)]*)\)")
INDIRECT = "__indirect_call"


class CallGraph:
    def __init__(self, build):
        self.frames, self.calls, self.problems = {}, {}, []
        for path in sorted(Path(build).rglob("*.ci")):
            text = path.read_text()
            if Path(SOURCE.search(text).group(1)).exists():  # else it was renamed since
                self.read(text)

    def read(self, text):
        for name, label in NODE.findall(text):
            frame = FRAME.search(label)
            if not frame:
                continue
            self.frames[name] = int(frame.group(1))
            if "dynamic" in frame.group(2) and "bounded" not in frame.group(2):
                self.problems.append(f"{name}: a frame of variable size")
        for source, target in EDGE.findall(text):
            self.calls.setdefault(source, set()).add(target)


def short_name(title):
    """`f` of `/somewhere/file.c:f`, the title of a static function."""
    return title.rsplit(":", 1)[-1]


class Depths:
    """Worst stack of each function, found once."""

    def __init__(self, graph, outside, indirect, linked=None):
        self.graph, self.outside, self.indirect, self.linked = graph, outside, indirect, linked
        self.known, self.trail, self.problems = {}, [], []

    def targets(self, name):
        for target in sorted(self.graph.calls.get(name, ())):
            if target != INDIRECT:
                yield target
                continue
            if short_name(name) not in self.indirect:
                self.problems.append(f"{name}: a call through a pointer without listed targets")
            for callee in self.indirect.get(short_name(name), []):
                yield from self.named(callee)

    def named(self, callee):
        """A function, or all static ones of that name; of a program's, those it has."""
        if callee in self.graph.frames:
            titles = [callee]
        else:
            titles = [name for name in self.graph.frames if short_name(name) == callee] or [callee]
        return [title for title in titles
                if self.linked is None or title.rsplit("/", 1)[-1] in self.linked]

    def depth(self, name):
        if name in self.trail:
            ring = self.trail[self.trail.index(name):] + [name]
            self.problems.append("recursion: " + " -> ".join(map(short_name, ring)))
            return 0
        if name not in self.known:
            self.known[name] = self.measure(name)
        return self.known[name]

    def measure(self, name):
        if name not in self.graph.frames:
            if name not in self.outside:
                self.problems.append(f"{name}: nobody knows its stack")
            return self.outside.get(name, 0)
        self.trail.append(name)
        below = max(map(self.depth, list(self.targets(name))), default=0)
        self.trail.pop()
        return self.graph.frames[name] + below


def indirect_calls(path):
    """{caller: [callee, ...]}"""
    return {row["caller"]: row["callees"].split() for row in arm.table(path)}


def depths_of(graph, here=HERE, linked=None):
    """`linked`: what a program holds, `f` and `file.c:f`; None: all that there is"""
    outside = {row["symbol"]: int(row["stack_bytes"]) for row in arm.table(here / "arm_symbols.csv")}
    return Depths(graph, outside, indirect_calls(here / "indirect_calls.csv"), linked)


def check(build, here=HERE):
    """(problems, table of the public functions, deepest first)"""
    graph = CallGraph(build)
    depths = depths_of(graph, here)
    public = {name: depths.depth(name) for name in sorted(graph.frames) if ":" not in name}
    problems = graph.problems + depths.problems
    if not public:
        problems.append(f"no call graph below {build}")
    budgets = arm.Budgets(here / "budgets.csv")
    for name, depth in public.items():
        problems += budgets.problems("stack", name, depth)
    ranked = sorted(public.items(), key=lambda item: -item[1])
    return problems, "\n".join(f"{depth:6} {name}" for name, depth in ranked)


if __name__ == "__main__":
    common.finish("stack", *check(sys.argv[1]))
