#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The prefix law on real recordings: a log that is cut gives the rows of the whole log.

    prefix_law.py --insole build/bin/insole --data ../shared/data/foot

Every recording is cut in five places; the rows up to half a second before the cut must be equal,
byte for byte. The exit code is 77 where the recordings are absent.
"""
import argparse
import pathlib
import subprocess
import sys

SKIPPED = 77
CUTS = (0.13, 0.31, 0.5, 0.77, 0.93)
FINAL_S = 0.5


def rows_of(insole, log):
    """The rows of the track of a log, given as text."""
    run = subprocess.run([insole, "replay", "-", "--out", "-"], input=log, check=True,
                         capture_output=True, text=True)
    return run.stdout.splitlines()[1:]


def seconds(line):
    return float(line.split(",", 1)[0])


def up_to(rows, end_s):
    return [row for row in rows if seconds(row) <= end_s]


def broken_cuts(insole, path):
    """Where the law does not hold: (time of the cut, first row that differs)."""
    header, *lines = path.read_text(encoding="ascii").splitlines(keepends=True)
    whole = rows_of(insole, header + "".join(lines))
    begin_s, end_s = seconds(lines[0]), seconds(lines[-1])
    for share in CUTS:
        cut_s = begin_s + share * (end_s - begin_s)
        kept = [line for line in lines if seconds(line) <= cut_s]
        final_s = seconds(kept[-1]) - FINAL_S
        wanted = up_to(whole, final_s)
        given = up_to(rows_of(insole, header + "".join(kept)), final_s)
        if wanted != given:
            pairs = zip(wanted + [""], given + [""])
            yield cut_s, next((pair for pair in pairs if pair[0] != pair[1]), ("", ""))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--insole", required=True)
    parser.add_argument("--data", required=True)
    given = parser.parse_args()
    logs = [path for path in sorted(pathlib.Path(given.data).glob("*.csv"))
            if not path.name.endswith(".truth.csv")]
    if not logs:
        print(f"skipped: there are no recordings at {given.data}")
        return SKIPPED
    broken = 0
    for log in logs:
        for cut_s, (wanted, row) in broken_cuts(given.insole, log):
            print(f"{log.name} cut at {cut_s:.3f} s: {row!r} instead of {wanted!r}")
            broken += 1
    print(f"{len(logs)} recordings, {len(logs) * len(CUTS)} cuts, {broken} broken")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
