#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Carrying positions of real people: a forest grown on one person, judged by the other.

    carry.py --insole build/bin/insole --data ../shared/data [--seeds N]

Both ways, with hand, pocket and bag, and with armband and neck pouch as well; on our features and
on the paper's. Fails over the limits below, and when a table is larger than the flash it may take.
The exit code is 77 where the recordings are absent.
"""
import argparse
import csv
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

SKIPPED = 77
THREE = "hand=hand+inhand,pocket=frontpocket+backpocket,bag=bag+purse"
FIVE = THREE + ",armband,neckpouch"
LEAST = {THREE: 85.0, FIVE: 72.0}  # % of the windows, mean of both ways
MOST_BYTES = 24 * 1024
ALL = re.compile(r"all: ([\d.]+) % of")


def write_index(folder, path):
    """The first person is user1; all other logs are of one person with several phones."""
    with open(folder / "index.csv", encoding="ascii") as file:
        recordings = list(csv.DictReader(file))
    with open(path, "w", encoding="ascii") as file:
        file.write("file,person,position\n")
        for row in recordings:
            person = "first" if row["user"] == "user1" else "second"
            file.write(f"{(folder / row['file']).resolve()},{person},{row['position']}\n")


def train(program, index, *options):
    command = [program, "train-carry", str(index), "--leave-out", "each", *options]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def both_ways(program, index, seeds, *options):
    """[% right of the first person, of the second], mean over the seeds; bytes of the table."""
    ways, largest = [[], []], 0
    for seed in range(1, seeds + 1):
        report = train(program, index, "--seed", str(seed), *options)
        for way, right in zip(ways, ALL.findall(report)):
            way.append(float(right))
        largest = max(largest, int(re.search(r"(\d+) bytes", report).group(1)))
    return [statistics.mean(way) for way in ways], largest


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--insole", required=True)
    parser.add_argument("--data", required=True, type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=3)
    options = parser.parse_args()
    folder, failed = options.data / "carry", []
    if not (folder / "index.csv").exists():
        print(f"SKIPPED: no recordings in {folder}")
        return SKIPPED
    with tempfile.TemporaryDirectory() as scratch:
        index = pathlib.Path(scratch, "people.csv")
        write_index(folder, index)
        print(train(options.insole, index, "--classes", FIVE))
        print(f"{'classes':>7} {'features':>8} {'as others':>9} {'first':>6} {'second':>6}   mean  bytes")
        for classes in (THREE, FIVE):
            for features in ("accel", "paper"):
                for plain in ([], ["--plain"]):
                    ways, size = both_ways(options.insole, index, options.seeds, "--classes",
                                           classes, "--features", features, *plain)
                    mean = statistics.mean(ways)
                    print(f"{classes.count(',') + 1:7} {features:>8} {'no' if plain else 'yes':>9} "
                          f"{ways[0]:6.1f} {ways[1]:6.1f} {mean:6.1f} {size:6}")
                    if features == "accel" and not plain:
                        if mean < LEAST[classes]:
                            failed.append(f"{mean:.1f} % right, expected {LEAST[classes]} %")
                        if size > MOST_BYTES:
                            failed.append(f"a table of {size} bytes, expected {MOST_BYTES}")
    for text in failed:
        print("FAILED:", text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
