#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Float against double: ten minutes of walking end up in the same places."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import program as support  # noqa: E402

LIMIT_MM = 20.0
SEEDS = (1, 2, 3)


def place(row):
    return (row["x"], row["y"], row["z"])


def compare(checks, what, track, oracle):
    apart = [math.dist(place(a), place(b)) for a, b in zip(track, oracle)]
    worst = max(range(len(apart)), key=apart.__getitem__)
    checks.within(f"{what}: largest difference, at {track[worst]['t']:.1f} s",
                  1000.0 * apart[worst], 0.001, LIMIT_MM, "mm")
    # A stride may end one sample earlier: then a row beside its end has another heading or state.
    turned = sum(abs(support.wrap(a["heading"] - b["heading"])) > 0.005
                 for a, b in zip(track, oracle))
    checks.within(f"{what}: rows of another heading", 100.0 * turned / len(track), 0.0, 0.5, "%")
    other = sum(a["state"] != b["state"] for a, b in zip(track, oracle))
    checks.within(f"{what}: rows of another state", other, 0, 3)


def main():
    given = support.arguments(__doc__, "double", "scenario")
    checks = support.Checks()
    scenario = pathlib.Path(given.scenario).read_text(encoding="ascii")
    with support.Program(given.insole) as single, support.Program(given.double) as double:
        for seed in SEEDS:
            walk = single.simulate(scenario, seed)
            track, summary = single.replay(walk)
            oracle, _ = double.replay(walk)
            checks.equal("rows", len(track), len(oracle))
            checks.within(f"seed {seed}: duration", summary["duration_s"], 600.0, 900.0, "s")
            compare(checks, f"seed {seed}, {summary['distance_m']:.0f} m", track, oracle)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
