#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Steps of simulated walkers with a phone in the hand, counted at 0.8 to 3 m/s, and none while they
stand, fidget with it or turn on the spot.

The simulator moves bodies and knows no step detector; what it calls a step is a foot coming down.
Of a walk the last step, which closes the feet, is hardly felt; of a run some more are lost.
"""
import json
import sys
import pathlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import program as support  # noqa: E402

PHONE = "log.sensor = phone\nlog.truth = body\n"
SPEEDS = (0.8, 1.0, 1.3, 1.6, 2.2, 3.0)
RUN_MPS = 1.9
LEG_M = 60.0
SEEDS = range(1, 5)


def counted(program, scenario, seed):
    """(steps counted, footfalls of a walk in the truth)"""
    folder = program.simulate(scenario + PHONE, seed)
    summary = json.loads(program.must("replay", folder / "log.csv", "--tracker", "phone",
                                      "--method", "pdr", "--json"))
    falls = support.read_table(folder / "steps.csv")
    return summary["steps"], sum(row["kind"] != "shuffle" for row in falls)


def check_speed(checks, program, speed):
    scenario = (f"start,0,0,0\nwalk,{LEG_M},0,{speed}\npause,3\nturn,3.1\n"
                f"walk,0,0,{speed}\npause,3\n")
    runs = [counted(program, scenario, seed) for seed in SEEDS]
    steps, falls = (sum(column) for column in zip(*runs))
    worst = max(abs(step / fall - 1.0) for step, fall in runs)
    least = 0.975 if speed < RUN_MPS else 0.92
    checks.within(f"{speed} m/s, {falls} steps: share counted", steps / falls, least, 1.02)
    checks.within(f"{speed} m/s: worst walk", 100.0 * worst, 0.0, 200.0 * (1.0 - least), "%")


def main():
    given = support.arguments(__doc__)
    checks = support.Checks()
    with support.Program(given.insole) as program:
        for speed in SPEEDS:
            check_speed(checks, program, speed)
        for seed in SEEDS:
            still = "start,0,0,0\npause,60\nturn,1.5\nturn,-1.5\nturn,3.1\npause,20\n"
            steps, _ = counted(program, still, seed)
            checks.within(f"standing and turning on the spot, seed {seed}: steps", steps, 0, 0)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
