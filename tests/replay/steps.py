#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Steps and distances of a phone's walker against counted steps and surveyed ways.

    steps.py --steps build/bin/replay_steps --data ../shared/data

Counts: every recording of carry/ on the same settings, whatever its position. Distances: the walks
of phone/mall_F1 whose number is divisible by 4 (the default coefficients come from the others).
Fails over the limits below. The exit code is 77 where the recordings are absent.
"""
import argparse
import csv
import math
import pathlib
import statistics
import subprocess
import sys

SKIPPED = 77
MOST_MEAN, MOST_ONE = 1.5, 4.0  # % of the steps: over all counted recordings, of any of them
MODELS = ["root", "linear", "mixed", "constant"]
MOST_ROOT = 10.0  # % of the way, mean over the walks
LATE_S = 0.3  # a step's peak comes after the foot, and the filter's after it


def steps_of(program, log):
    out = subprocess.run([program, str(log)], check=True, capture_output=True, text=True).stdout
    return [[float(cell) for cell in line.split(",")] for line in out.split()]


def counts(program, folder):
    """Mean and worst error of the counted recordings, %; prints all."""
    with open(folder / "index.csv", encoding="ascii") as index:
        recordings = list(csv.DictReader(index))
    errors = {}
    print(f"{'recording':32s} {'position':12s} steps counted error")
    for row in recordings:
        found = len(steps_of(program, folder / row["file"]))
        line = f"{row['file'][:-4]:32s} {row['position']:12s} {found:5d}"
        if row["true_steps"]:
            true = int(row["true_steps"])
            errors.setdefault(row["position"], []).append(100.0 * (found - true) / true)
            line += f" {true:7d} {errors[row['position']][-1]:+.1f} %"
        print(line)
    for position, signed in sorted(errors.items()):
        print(f"{position:12s} mean error {statistics.mean(map(abs, signed)):.2f} %")
    every = [abs(error) for signed in errors.values() for error in signed]
    print(f"all {len(every)}: mean {statistics.mean(every):.2f} %, largest {max(every):.2f} %")
    return statistics.mean(every), max(every)


def way(truth):
    with open(truth, encoding="ascii") as file:
        points = [[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]
    length = sum(math.dist(a[1:3], b[1:3]) for a, b in zip(points, points[1:]))
    return length, points[0][0], points[-1][0]


def distances(program, folder):
    """Mean error of each model, % of the way; prints them."""
    walks = [path for path in sorted(folder.glob("p[0-9]*")) if int(path.name[1:]) % 4 == 0]
    errors = {model: [] for model in MODELS}
    for walk in walks:
        length, begin_s, end_s = way(walk / "truth.csv")
        steps = [s for s in steps_of(program, walk / "imu.csv") if begin_s < s[1] <= end_s + LATE_S]
        for k, model in enumerate(MODELS):
            walked = sum(step[2 + k] for step in steps)
            errors[model].append(100.0 * abs(walked / length - 1.0))
    for model in MODELS:
        print(f"distance of {len(walks)} walks by {model:9s} mean error "
              f"{statistics.mean(errors[model]):.1f} %")
    return {model: statistics.mean(errors[model]) for model in MODELS}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--steps", required=True)
    parser.add_argument("--data", required=True, type=pathlib.Path)
    options = parser.parse_args()
    carry, mall = options.data / "carry", options.data / "phone" / "mall_F1"
    if not (carry / "index.csv").exists() or not mall.exists():
        print(f"SKIPPED: no recordings in {options.data}")
        return SKIPPED
    mean, largest = counts(options.steps, carry)
    by_model = distances(options.steps, mall)
    failed = [text for text, bad in [
        (f"mean error of the counts over {MOST_MEAN} %", mean > MOST_MEAN),
        (f"a count off by more than {MOST_ONE} %", largest > MOST_ONE),
        (f"mean error of the root's distance over {MOST_ROOT} %", by_model["root"] > MOST_ROOT),
    ] if bad]
    for text in failed:
        print("FAILED:", text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
