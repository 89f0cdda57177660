#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How well a forest grown on simulated walkers tells where others carry their phones.

    carry_forest.py --insole build/bin/insole

Each walker carries the phone in each of four positions, turned in any way. Those it is judged on,
and how their phones lie, are none of those it is grown on. No such table is shipped: the hand and
the ear look alike to it.
"""
import argparse
import concurrent.futures
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import program as support  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
POSITIONS = ("hand", "ear", "swing", "pocket")
GROWN, JUDGED = range(1, 17), range(1001, 1013)


def simulate(program, position, seed):
    """The log of one walker; the building and the errands are those of the office."""
    scenario = (ROOT / "maps" / "office" / "handheld").read_text(encoding="ascii")
    folder = program.folder / f"{position}-{seed}"
    path = ROOT / "maps" / "office" / f".{position}-{seed}"
    path.write_text(scenario + f"\nphone.pose = {position}\nphone.mounting = random\n"
                    "radio.model = off\nphone.rate_hz = 50\n", encoding="ascii")
    try:
        program.must("simulate", path, "--out", folder, "--seed", seed)
    finally:
        path.unlink()
    log = program.folder / f"{position}-{seed}.csv"
    lines = (folder / "log.csv").read_text(encoding="ascii").splitlines()
    log.write_text("t,ax,ay,az\n" + "\n".join(",".join(line.split(",")[1:5]) for line in lines
                                              if line.startswith("imu,")) + "\n", encoding="ascii")
    for file in folder.iterdir():
        file.unlink()
    return log


def make_index(program, name, seeds, jobs):
    path = program.folder / name
    tasks = [(position, seed) for seed in seeds for position in POSITIONS]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        logs = list(pool.map(lambda task: simulate(program, *task), tasks))
    path.write_text("file,person,position\n" + "".join(
        f"{log.name},{seed},{position}\n" for log, (position, seed) in zip(logs, tasks)),
        encoding="ascii")
    return path


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--insole", required=True)
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    with support.Program(given.insole) as program:
        grown = make_index(program, "grown.csv", GROWN, given.jobs)
        judged = make_index(program, "judged.csv", JUDGED, given.jobs)
        out = program.folder / "carry_table.c"
        classes = ",".join(POSITIONS)
        print(program.must("train-carry", grown, "--test", judged, "--classes", classes, "--name",
                           "insole_carry", "--out", out).decode(), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
