# SPDX-License-Identifier: MIT
"""Gate: what a whole path costs on a Cortex-M4F.  usage: paths.py ROOT BUILD [--update|--check README]

Each program of paths/ is linked with the library alone, sections that nobody needs left out. Flash
is code and tables, RAM all its variables, stack the worst of its main; behind a pointer is only what
is linked. Drivers and tables in flash (the plan, the map) do not count.
"""
import sys
import tempfile
from pathlib import Path

import arm
import common
import sizes
import stack

HERE = Path(__file__).parent
BEGIN, END = "<!-- paths:begin -->", "<!-- paths:end -->"
TITLES = {
    "inertial": "inertial filter alone",
    "inertial_nine": "inertial filter alone, compiled for nine states",
    "foot": "shoe: detector, inertial filter, plan, radio, 500 particles",
    "phone": "phone: attitude, steps, fingerprints of up to 96 access points a scan, `ekf`",
}
FLAGS = [*sizes.CPU, "-std=c99", "-O2", "-ffp-contract=off", "-ffunction-sections",
         "-fdata-sections", "-fcallgraph-info=su,da"]
COMPILER = "12.2.1"  # that the table in README.md is made with
# What a firmware sets smaller: a phone hears 96 access points in a scan, a filter has nine states.
# (program, options, stems that are compiled anew)
SMALLER = {
    "phone": ("phone", ["-DINSOLE_HEARD_MAX=96"], ["place/heard", "place/map_search",
                                                   "place/kde_fix"]),
    "inertial_nine": ("inertial", ["-DINSOLE_ZUPT_STATES=9", "-fno-schedule-insns"],
                      ["move/zupt_cov", "move/zupt_ekf"]),
}
OUTSIDE = ("sensor", "compass", "shown", "building", "map", "heard")  # what a board provides


def link(root, build, name, folder):
    """The linked program, in a folder that then holds its call graph, too."""
    linked, made = folder / f"{name}.elf", []
    program, smaller, stems = SMALLER.get(name, (name, [], []))
    for source in [HERE / "paths" / f"{program}.c"] + [root / f"src/{s}.c" for s in stems]:
        made.append(folder / f"{source.stem}.o")
        arm.tool("gcc", *FLAGS, "-fno-math-errno", *smaller, "-I", root / "include", "-c", source,
                 "-o", made[-1])
    provided = [f"-Wl,--defsym={symbol}=0x60000000" for symbol in OUTSIDE]
    arm.tool("gcc", *sizes.CPU, "--specs=nano.specs", "-nostartfiles", "-Wl,-e,main,--gc-sections",
             *provided, *made, build / "src" / "libinsole.a", "-lgcc", "-lc", "-o", linked)
    return linked


def symbols(linked):
    """`f` and `file.c:f` of a program's functions"""
    names, source = set(), ""
    for line in arm.tool("objdump", "-t", linked).splitlines():
        fields = line.split()
        if "df" in fields:
            source = fields[-1]
        elif "F" in fields:
            names |= {fields[-1], f"{source}:{fields[-1]}"}
    return names


def measure(root, build, name):
    """(flash, RAM, stack) in bytes"""
    with tempfile.TemporaryDirectory() as folder:
        linked = link(root, build, name, Path(folder))
        text, data, bss = map(int, arm.tool("size", linked).splitlines()[1].split()[:3])
        graph = stack.CallGraph(build / "src")
        for path in Path(folder).glob("*.ci"):
            graph.read(path.read_text())
        depths = stack.depths_of(graph, HERE, symbols(linked))
        return text + data, data + bss, depths.depth("main")


def table(costs):
    lines = ["| path | flash, bytes | RAM, bytes | stack, bytes |", "|---|---|---|---|"]
    lines += [f"| {TITLES[name]} | {flash:,} | {ram:,} | {deep:,} |"
              for name, (flash, ram, deep) in costs.items()]
    return "\n".join(lines)


def with_table(readme, costs):
    head, rest = readme.split(BEGIN, 1)
    return f"{head}{BEGIN}\n{table(costs)}\n{END}{rest.split(END, 1)[1]}"


def check(root, build, budgets_csv=HERE / "budgets.csv"):
    """(problems, costs)"""
    budgets = arm.Budgets(budgets_csv)
    costs = {name: measure(root, build, name) for name in TITLES}
    problems = []
    for name, cost in costs.items():
        for what, value in zip(("path_flash", "path_ram", "path_stack"), cost):
            problems += budgets.problems(what, name, value)
    return problems, costs


def main(root, build, action=None, readme=None):
    if action and arm.tool("gcc", "-dumpfullversion").strip() != COMPILER:
        common.skip(f"sizes are told for arm-none-eabi-gcc {COMPILER}")
    problems, costs = check(Path(root).resolve(), Path(build))
    if action == "--update":
        Path(readme).write_text(with_table(Path(readme).read_text("utf-8"), costs), "utf-8")
    elif action == "--check":
        text = Path(readme).read_text("utf-8")
        if with_table(text, costs) != text:
            problems.append(f"{readme}: the table of paths is not what is measured")
    common.finish("paths", problems, table(costs))


if __name__ == "__main__":
    main(*sys.argv[1:])
