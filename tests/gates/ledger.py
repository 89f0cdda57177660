# SPDX-License-Identifier: MIT
"""Gate: the equation ledger.  usage: ledger.py ROOT

src/EQUATIONS.md has one row per numbered equation of each paper,
    | [TwoOrder (24)] | what it says | move/zupt_ekf.c:propagate_covariance |
whose last column lists `file:function` (below src/ or include/insole/), or is
`theory: not computed`, or `not yet`. A paper's heading, `## TwoOrder (42)`, tells how many there
are. In code `[TwoOrder (24)]`, also `[TwoOrder (12)-(14), (16)]`, marks what computes them.
No tag without its row, no computed row without its tag.
"""
import re

import common

PAPERS = ("TwoOrder", "PhoneEKF", "PhoneUKF", "WifiShift")
NOT_COMPUTED = ("theory: not computed", "not yet")
LEDGER = "src/EQUATIONS.md"

TAG = re.compile(r"\[(%s)\b([^\]]*)\]" % "|".join(PAPERS), re.S)
NUMBERS = re.compile(r"\((\d+)\)(?:\s*-\s*\((\d+)\))?")
HEADING = re.compile(r"^## (\w+) \((\d+)\)", re.M)
ROW = re.compile(r"^\|\s*(\[[^\]]*\])\s*\|([^|\n]*)\|([^|\n]*)\|\s*$", re.M)


def equations(tag):
    """{("TwoOrder", 12), ...} of the text of one tag."""
    paper, rest = TAG.match(tag).groups()
    return {(paper, n) for first, last in NUMBERS.findall(rest)
            for n in range(int(first), int(last or first) + 1)}


def text_of(equation):
    return "[%s (%d)]" % equation


def read_ledger(text):
    """({equation: set of places}, problems); an equation that is not computed has no place."""
    rows, problems = {}, []
    for tag, what, where in ROW.findall(text):
        if not TAG.match(tag):
            problems.append(f"{LEDGER}: no such paper: {tag}")
            continue
        places = set() if where.strip() in NOT_COMPUTED else set(re.split(r",\s*", where.strip()))
        if not what.strip():
            problems.append(f"{LEDGER}: {tag} does not say what it is")
        for equation in equations(tag):
            if equation in rows:
                problems.append(f"{LEDGER}: {text_of(equation)} has two rows")
            rows[equation] = places
    counts = {paper: int(count) for paper, count in HEADING.findall(text)}
    wanted = {(paper, n) for paper, count in counts.items() for n in range(1, count + 1)}
    problems += [f"{LEDGER}: {text_of(e)} has no row" for e in sorted(wanted - set(rows))]
    problems += [f"{LEDGER}: {text_of(e)} is beyond the paper" for e in sorted(set(rows) - wanted)]
    return rows, problems


def tags_in(path):
    """[(equation, line, function or None)] of a C file; a function owns the comment above it."""
    text = path.read_text()
    owners = common.functions(text)
    found = []
    for match in TAG.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        owner = next((f.name for f in owners if f.first <= line <= f.last), None)
        found += [(equation, line, owner) for equation in sorted(equations(match.group(0)))]
    return found


def place_name(root, path):
    return re.sub(r"^(src|include/insole)/", "", common.short(root, path))


def check(root):
    rows, problems = read_ledger((root / LEDGER).read_text())
    tagged, defined = set(), set()
    for path in common.files(root, common.LIBRARY, {".c", ".h"}):
        place = place_name(root, path)
        defined |= {f"{place}:{f.name}" for f in common.functions(path.read_text())}
        for equation, line, owner in tags_in(path):
            at = f"{common.short(root, path)}:{line}: {text_of(equation)}"
            if equation not in rows:
                problems.append(f"{at} has no row in {LEDGER}")
            elif owner and f"{place}:{owner}" not in rows[equation]:
                problems.append(f"{at}: its row does not name {place}:{owner}")
            tagged.add((equation, f"{place}:{owner}"))
    for equation, places in sorted(rows.items()):
        for place in sorted(places):
            if place not in defined:
                problems.append(f"{LEDGER}: {text_of(equation)}: there is no {place}")
            elif (equation, place) not in tagged:
                problems.append(f"{LEDGER}: {text_of(equation)}: {place} does not carry the tag")
    return problems


def note(root):
    rows, _ = read_ledger((root / LEDGER).read_text())
    computed = sum(1 for places in rows.values() if places)
    return f"{len(rows)} equations, {computed} computed"


if __name__ == "__main__":
    where = common.root_argument()
    common.finish("ledger", check(where), note(where))
