#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Cycles of a Cortex-M4F, estimated from the instructions that a case of the bench runs.

    cycles.py [--functions] [--calls N] OBJDUMP CASE QEMU... IMAGE

QEMU tells each instruction as it goes; what it costs is in the public table of the core: one cycle,
a word of memory one more, a product with a sum 3, a quotient or a root 14, a branch that is taken 3,
and one more where an arithmetic result of the floating-point unit is used at once. Waits for flash
are not in it.
"""
import argparse
import bisect
import collections
import os
import re
import subprocess
import tempfile

LINE = re.compile(r"^\s*([0-9a-f]+):\t[0-9a-f ]+\t(\S+)[ \t]*([^;<@\n]*)", re.M)
LABEL = re.compile(r"^([0-9a-f]{8}) <(\S+)>:$", re.M)
FLOAT_REGISTER = re.compile(r"\b[sd](\d+)(?:-[sd](\d+))?")
LONG = {"vdiv": 14, "vsqrt": 14, "vfma": 3, "vfms": 3, "vfnma": 3, "vfnms": 3, "vmla": 3,
        "vmls": 3, "vnmla": 3, "vnmls": 3, "udiv": 12, "sdiv": 12}
ARITHMETIC = ("vadd", "vsub", "vmul", "vnmul", "vcvt") + tuple(n for n in LONG if n[0] == "v")
BRANCH = 3

ENOUGH = 4000000  # instructions that are looked at, of the first calls

Instruction = collections.namedtuple("Instruction", "cycles arithmetic written read")


def words_moved(name, operands):
    """Registers that go to or come from memory."""
    if name.startswith(("ldrd", "strd")):
        return 2
    if name.startswith(("push", "pop", "ldm", "stm", "vpush", "vpop", "vldm", "vstm")):
        listed = operands[operands.index("{"):].strip("{} ")
        count = 0
        for part in listed.split(","):
            first, _, last = part.strip().strip("{}").partition("-")
            count += int(last[1:]) - int(first[1:]) + 1 if last else 1
            count += count if first.startswith("d") else 0
        return count
    if name.startswith(("vldr", "vstr")):
        return 2 if operands.startswith("d") else 1
    return 1 if name.startswith(("ldr", "str")) else 0


def float_registers(text):
    found = set()
    for first, last in FLOAT_REGISTER.findall(text):
        found.update(range(int(first), int(last or first) + 1))
    return found


def instruction(name, operands):
    stem = name.split(".")[0]
    base = next((LONG[n] for n in sorted(LONG, key=len, reverse=True) if stem.startswith(n)), 1)
    target, _, sources = operands.partition(",")
    arithmetic = stem.startswith(ARITHMETIC)
    read = float_registers(operands if stem.startswith(("vcmp", "vstr", "vfm", "vml")) else sources)
    return Instruction(base + words_moved(name, operands), arithmetic,
                       float_registers(target) if arithmetic else set(), read)


def read_code(listing):
    """({address: instruction}, {address: function}) of what objdump wrote."""
    code = {int(at, 16): instruction(name, operands.strip())
            for at, name, operands in LINE.findall(listing) if not name.startswith(".")}
    return code, {int(at, 16): name for at, name in LABEL.findall(listing)}


def cycles_of(code, after, pair):
    """Of the first of two instructions that follow each other, with the wait of the second."""
    first, second = (code[at] for at in pair)
    branch = BRANCH - 1 if after.get(pair[0]) != pair[1] else 0
    wait = 1 if first.arithmetic and first.written & second.read else 0
    return first.cycles + branch + wait


def counted(lines, begin, outside, enough=ENOUGH):
    """(calls, {pair of addresses: times}) of what runs from `begin` until it is outside again."""
    pairs, calls, last, seen = collections.Counter(), 0, None, 0
    for line in lines:
        at = int(line.split(b"/", 2)[1], 16)
        if last is not None:
            pairs[last, at] += 1
            last = None if at in outside else at
            seen += 1
            if last is None and seen >= enough:
                break
        elif at == begin:
            calls, last = calls + 1, at
    return calls, pairs


def trace(command, begin, outside):
    with tempfile.TemporaryDirectory() as folder:
        pipe = os.path.join(folder, "trace")
        os.mkfifo(pipe)
        options = ["-singlestep", "-d", "exec,nochain", "-D", pipe]
        with subprocess.Popen(command[:-2] + options + command[-2:],
                              stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL) as run:
            with open(pipe, "rb") as lines:
                found = counted((x for x in lines if x.startswith(b"Trace")), begin, outside)
            run.kill()
    return found


def function_at(names):
    """Addresses of code to the function that they are in."""
    starts = sorted(names)

    def find(at):
        return names[starts[bisect.bisect_right(starts, at) - 1]]
    return find


def for_case(command, case):
    """The command with the one case picked."""
    return [f"{word},arg=bench,arg={case}" if word.startswith("enable=on") else word
            for word in command]


def measure(objdump, case, command):
    """(cycles per call, instructions per call, {function: (cycles, instructions) per call}), of the
    first calls."""
    listing = subprocess.run([objdump, "-d", command[-1]], check=True, text=True,
                             stdout=subprocess.PIPE).stdout
    code, names = read_code(listing)
    addresses = sorted(code)
    after = dict(zip(addresses, addresses[1:]))
    function = function_at(names)
    outside = {at for at in addresses if function(at) == "ticks_of"}
    begin = next(at for at, name in names.items() if name == f"call_{case}")
    calls, pairs = trace(for_case(command, case), begin, outside)
    table = collections.defaultdict(lambda: [0, 0])
    for pair, times in pairs.items():
        row = table[function(pair[0])]
        row[0] += times * cycles_of(code, after, pair) / calls
        row[1] += times / calls
    return (round(sum(c for c, _ in table.values())), round(sum(n for _, n in table.values())),
            table)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--functions", action="store_true", help="tell what each function takes")
    parser.add_argument("objdump")
    parser.add_argument("case")
    parser.add_argument("command", nargs=argparse.REMAINDER)
    given = parser.parse_args()
    cycles, instructions, table = measure(given.objdump, given.case, given.command)
    print(f"{given.case}: {instructions} instructions, {cycles} cycles")
    for name, (c, n) in sorted(table.items(), key=lambda row: -row[1][0]) if given.functions else ():
        print(f"{c:9.1f} {n:9.1f} {name}")


if __name__ == "__main__":
    main()
