# SPDX-License-Identifier: MIT
"""Gate: flash and RAM of each module on a Cortex-M4F.  usage: sizes.py ROOT ARCHIVE

Flash is code and tables of the module's object; RAM is the largest struct of its header but the
settings: the state, which the caller owns. The library holds no variables: .data and .bss are empty.
"""
import re
import sys
import tempfile
from pathlib import Path

import arm
import common

BUDGETS = Path(__file__).with_name("budgets.csv")
CPU = "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16".split()


STRUCT = re.compile(r"typedef\s+struct\s*\{(?:[^{}]|\{[^{}]*\})*\}\s*(\w+)\s*;")


def state_types(root):
    """{type: stem of the header that defines it} of all structs but settings."""
    return {name: path.stem for path in common.files(root, ["include/insole"], {".h"})
            for name in STRUCT.findall(common.code_only(path.read_text()))
            if not name.endswith("_config_t")}


def struct_sizes(root, types):
    """{stem: bytes of its largest}, by compiling one array of that size per struct."""
    if not types:
        return {}
    headers = "".join(f'#include "{path.relative_to(root / "include").as_posix()}"\n'
                      for path in common.files(root, ["include/insole"], {".h"}))
    arrays = "".join(f"char size_of_{name}[sizeof({name})];\n" for name in types)
    with tempfile.TemporaryDirectory() as folder:
        source, made = Path(folder, "sizes.c"), Path(folder, "sizes.o")
        source.write_text(headers + arrays)
        arm.tool("gcc", *CPU, "-std=c99", "-fno-common", "-I", root / "include", "-c", source,
                 "-o", made)
        listing = arm.tool("nm", "-S", made)
    largest = {}
    for size, name in re.findall(r"^\w+ (\w+) \w size_of_(\w+)$", listing, re.M):
        largest[types[name]] = max(int(size, 16), largest.get(types[name], 0))
    return largest


def check(root, archive, budgets_csv=BUDGETS):
    budgets = arm.Budgets(budgets_csv)
    objects, states = arm.object_sizes(archive), struct_sizes(root, state_types(root))
    problems = [] if objects else [f"{archive} holds no objects"]
    lines = [f"{'module':20} {'flash':>7} {'ram':>7}"]
    for stem in sorted(set(objects) | set(states)):
        text, data, bss = objects.get(stem, (0, 0, 0))
        ram = states.get(stem, 0)
        lines.append(f"{stem:20} {text:7} {ram:7}")
        problems += budgets.problems("flash", stem, text) + budgets.problems("ram", stem, ram)
        if data + bss:
            problems.append(f"{stem}: {data + bss} bytes of variables of its own")
    lines.append(f"{'all':20} {sum(sizes[0] for sizes in objects.values()):7}")
    return problems, "\n".join(lines)


if __name__ == "__main__":
    common.finish("sizes", *check(Path(sys.argv[1]).resolve(), sys.argv[2]))
