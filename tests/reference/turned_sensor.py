#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A turned sensor sees another log of the same walk: the track must stay where it is.

Seeded random rotations and some special ones are applied to a simulated walk of 100 m and, with
--data, to real walks whose gyro nowhere clips, with its range told: clipping is of the axes as they
are mounted, so what looks like a clipped peak to one mounting does not to another. Turns that carry
axes onto axes hold with the range unknown, and for clipped walks.
"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import program as support  # noqa: E402

LIMIT_MM = 5.0
RANDOM_TURNS = 6
UPSIDE_DOWN = [[1, 0, 0], [0, -1, 0], [0, 0, -1]]
AXES_ONTO_AXES = [UPSIDE_DOWN, [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
                  [[0, -1, 0], [1, 0, 0], [0, 0, 1]], [[0, 0, 1], [0, -1, 0], [1, 0, 0]]]
UNCLIPPED = ["llio_32", "llio_45", "vicon_2017-11-22-11-37-47", "openshoe_31"]
CLIPPED = ["llio_36", "vicon_2017-11-22-11-44-47"]
RANGE_TOLD = ["--set", "screen.gyro_range_radps=60"]
SCENARIO = "start,0,0,0\nwalk,30,0,1.3\nwalk,30,18,1.2\nwalk,0,18,1.4\npause,2\nwalk,0,0,1.3\n"


def check(checks, program, name, path, rotations, options=()):
    samples = support.read_imu(path)
    plain, _ = program.replay(support.write_imu(program.folder / "plain.csv", samples),
                              *options)
    apart_mm = []
    for rotation in rotations:
        log = support.write_imu(program.folder / "turned.csv", support.turned(samples, rotation))
        track, _ = program.replay(log, *options)
        checks.equal(f"{name}: rows", len(track), len(plain))
        apart_mm.append(1000.0 * support.largest_distance(track, plain))
    checks.within(f"{name}, {len(apart_mm)} mountings: largest difference", max(apart_mm), 0.0,
                  LIMIT_MM, "mm")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--insole", required=True)
    parser.add_argument("--data")
    given = parser.parse_args()
    if given.data and not pathlib.Path(given.data).is_dir():
        print(f"SKIPPED: there are no recordings at {given.data}")
        return support.SKIPPED
    checks, rng = support.Checks(), support.generator("mountings")
    any_turns = AXES_ONTO_AXES + [support.random_rotation(rng) for _ in range(RANDOM_TURNS)]
    with support.Program(given.insole) as program:
        if given.data:
            folder = pathlib.Path(given.data)
            unclipped = [folder / f"{name}.csv" for name in UNCLIPPED]
            clipped = [folder / f"{name}.csv" for name in CLIPPED]
        else:
            unclipped = [program.simulate(SCENARIO, 1) / "log.csv"]
            clipped = unclipped
        for path in unclipped:
            check(checks, program, path.stem, path, any_turns, RANGE_TOLD)
        for path in clipped:
            check(checks, program, f"{path.stem}, range unknown", path, AXES_ONTO_AXES)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
