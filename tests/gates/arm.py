# SPDX-License-Identifier: MIT
"""Reading what the Cortex-M tool chain made: archives, call graphs, limits."""
import csv
import re
import subprocess

PREFIX = "arm-none-eabi-"


def tool(name, *arguments, **options):
    """Standard output of arm-none-eabi-<name>."""
    return subprocess.run([PREFIX + name, *map(str, arguments)], check=True, text=True,
                          capture_output=True, **options).stdout


def table(path):
    """Rows of a CSV file with a header line and # comments, as dictionaries."""
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return list(csv.DictReader(lines))


class Budgets:
    """The limits of budgets.csv."""

    def __init__(self, path):
        self.rows = {(row["what"], row["name"]): int(row["limit"]) for row in table(path)}

    def problems(self, what, name, value):
        limit = self.rows[(what, name if (what, name) in self.rows else "*")]
        return [f"{what} of {name}: {value} bytes, at most {limit}"] if value > limit else []


def undefined(archive):
    """{symbol: objects that want it} of all that an archive does not define itself."""
    wanted, defined = {}, set()
    for line in tool("nm", "-A", archive).splitlines():
        where, rest = line.rsplit(":", 1)
        kind, symbol = rest.split()[-2:]
        if kind in "Uw":
            wanted.setdefault(symbol, set()).add(where.rsplit(":", 1)[-1])
        elif kind.isupper():
            defined.add(symbol)
    return {s: objects for s, objects in wanted.items() if s not in defined}


def object_sizes(archive):
    """{stem: (text, data, bss)}"""
    rows = re.findall(r"^\s*(\d+)\s+(\d+)\s+(\d+)\s+\d+\s+\w+\s+(\w+)\.[\w.]+ \(ex",
                      tool("size", archive), re.M)
    return {stem: tuple(map(int, sizes)) for *sizes, stem in rows}
