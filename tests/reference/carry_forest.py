#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The forest of the library, which tells where a phone is carried, grown once more.

    carry_forest.py --insole build/bin/insole --table src/sense/carry_table.c
    carry_forest.py ... --write                                  put it there
    carry_forest.py ... --data ../shared/data                    and what it makes of real people

Simulated walkers carry a phone in each of four positions, turned in any way. Those that the forest
is judged on, and how their phones lie, are none of those it is grown on. Fails when it tells too
few windows of these, or is not the table that the library has.
"""
import argparse
import concurrent.futures
import csv
import pathlib
import re
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import program as support  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
OFFICE = ROOT / "maps" / "office"
POSITIONS = ("hand", "ear", "swing", "pocket")
GROWN, JUDGED = range(1, 61), range(1001, 1041)  # people differ more than their errands do
RECIPE = ("--trees", 30, "--depth", 6, "--bag", 600, "--plain", "--seed", 1)
NAME = "insole_carry_table"
LEAST = 97.0  # % of the windows
REAL = "hand=hand+inhand,ear,swing=swing+swingingarm,pocket=pocket+frontpocket+backpocket"
ALL = re.compile(r"all: ([\d.]+) % of")


def simulate(program, folder, position, seed):
    """The samples of one walker; the building and the errands are those of the office."""
    scenario = (OFFICE / "handheld").read_text(encoding="ascii")
    scenario = scenario.replace("errands,10", "errands,2")
    path, log = folder / f"{position}-{seed}", folder / f"{position}-{seed}.csv"
    path.write_text(f"{scenario}\nphone.pose = {position}\nphone.mounting = random\n"
                    "radio.model = off\nphone.rate_hz = 50\n", encoding="ascii")
    program.must("simulate", path, "--out", folder / f"{path.name}.walk", "--seed", seed)
    lines = (folder / f"{path.name}.walk" / "log.csv").read_text(encoding="ascii").splitlines()
    rows = (line.split(",", 1)[1] for line in lines if line.startswith("imu,"))
    log.write_text("t,ax,ay,az,gx,gy,gz\n" + "\n".join(rows) + "\n", encoding="ascii")
    return log


def write_index(path, rows):
    path.write_text("file,person,position\n" + "".join(f"{','.join(row)}\n" for row in rows),
                    encoding="ascii")
    return path


def make_index(program, name, seeds, jobs):
    tasks = [(position, seed) for seed in seeds for position in POSITIONS]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        logs = list(pool.map(lambda task: simulate(program, program.folder, *task), tasks))
    return write_index(program.folder / name, [(log.name, str(seed), position)
                                               for log, (position, seed) in zip(logs, tasks)])


def grow(program, grown, judged, *options):
    return program.must("train-carry", grown, "--test", judged, *RECIPE, *options).decode()


def held_out(report):
    return report[report.index("Held out"):]


def table_of(path):
    """The generated text as a part of the library."""
    text = path.read_text(encoding="ascii")
    begin, end = text.index("#include"), text.index("static const")
    return ("/* SPDX-License-Identifier: MIT */\n" + text[:begin] +
            '#include "insole/sense/carry_table.h"\n\n/* clang-format off */\n' + text[end:])


def print_real(program, grown, data):
    """Recordings of people: two walk with an accelerometer, many hold a phone in a mall."""
    people = data / "carry" / "index.csv"
    with open(people, encoding="ascii") as file:
        rows = [(str((people.parent / row["file"]).resolve()), row["user"], row["position"])
                for row in csv.DictReader(file)]
    index = write_index(program.folder / "people.csv", rows)
    print("Real people, by a forest of the same walkers that asks the accelerometer alone")
    print(held_out(grow(program, grown, index, "--classes", REAL, "--features", "accel")))
    walks = sorted((data / "phone" / "mall_F1").glob("p*/imu.csv"))
    index = write_index(program.folder / "mall.csv",
                        [(str(walk.resolve()), walk.parent.name, "hand") for walk in walks])
    print("Real phones in the hand")
    print(held_out(grow(program, grown, index, "--classes", ",".join(POSITIONS))))


def copy_office(folder):
    for name in ("plan.csv", "aps.csv"):
        shutil.copy(OFFICE / name, folder / name)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--insole", required=True)
    parser.add_argument("--table", required=True, type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--data", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    failed = []
    with support.Program(given.insole) as program:
        copy_office(program.folder)
        grown = make_index(program, "grown.csv", GROWN, given.jobs)
        judged = make_index(program, "judged.csv", JUDGED, given.jobs)
        out = program.folder / "carry_table.c"
        report = grow(program, grown, judged, "--classes", ",".join(POSITIONS), "--name", NAME,
                      "--out", out)
        print(report)
        table = table_of(out)
        for features in ("accel", "paper"):
            print(f"--features {features}:", ALL.findall(grow(
                program, grown, judged, "--classes", ",".join(POSITIONS), "--features",
                features))[-1], "% held out")
        if given.data is not None and (given.data / "carry" / "index.csv").exists():
            print_real(program, grown, given.data)
    right = float(ALL.findall(report)[-1])
    if right < LEAST:
        failed.append(f"{right} % right, expected {LEAST} %")
    if given.write:
        given.table.write_text(table, encoding="ascii")
    elif given.table.read_text(encoding="ascii") != table:
        failed.append(f"{given.table} is another forest: grow it again by --write")
    for text in failed:
        print("FAILED:", text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
