#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Does the track know how wrong it is? Errors of simulated walks against the reported covariance.

Walks of several shapes, each with a sensor of its own, are told where they begin and in which
direction, with an error drawn from the sigmas that the start record then names. The normalised
squared error of the last place (2 degrees of freedom) and heading (1) has mean 2 and 1 when the
covariance is what it says; much more is an estimator that trusts itself too far.
"""
import math
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import program as support  # noqa: E402

SEEDS = 44
START_SIGMA_M, START_SIGMA_RAD = 0.1, 0.02
SHAPES = {
    "straight, 40 m": "walk,40,0,1.3\n",
    "there and back, 60 m": "walk,30,0,1.3\nwalk,0,0,1.3\n",
    "round a block, 80 m": "walk,25,0,1.3\nwalk,25,15,1.2\nwalk,0,15,1.4\nwalk,0,0,1.3\n",
    "with stops, 70 m": "walk,12,0,1.2\npause,3\nwalk,12,20,1.4\npause,2\nwalk,-10,20,1.3\n"
                        "walk,-10,5,1.1\n",
}


def told(walk, rng):
    """The log with the start's errors put into its record, and the errors' sigmas."""
    path = walk / "log.csv"
    lines = path.read_text(encoding="ascii").splitlines()
    _, t, x, y, heading = lines[0].split(",")
    x, y = (float(v) + rng.gauss(0.0, START_SIGMA_M) for v in (x, y))
    heading = float(heading) + rng.gauss(0.0, START_SIGMA_RAD)
    lines[0] = (f"start,{t},{x:.4f},{y:.4f},{support.wrap(heading):.5f},"
                f"{START_SIGMA_M},{START_SIGMA_RAD}")
    path.write_text("\n".join(lines) + "\n", encoding="ascii")
    return path


def squared_error(row, place):
    """(d' P^-1 d, distance)"""
    dx, dy = row["x"] - place["x"], row["y"] - place["y"]
    xx, xy, yy = row["var_x"], row["cov_xy"], row["var_y"]
    return ((yy * dx * dx - 2.0 * xy * dx * dy + xx * dy * dy) / (xx * yy - xy * xy),
            math.hypot(dx, dy))


def yaw_error(track, truth, begin_s, end_s):
    """Between track and truth in the direction of the way from one time to another."""
    def way(rows):
        a = min(rows, key=lambda r: abs(r["t"] - begin_s))
        b = min(rows, key=lambda r: abs(r["t"] - end_s))
        return math.atan2(b["y"] - a["y"], b["x"] - a["x"])
    return support.wrap(way(track) - way(truth))


def last_way(track):
    """(begin, end) of the last 5 s in which the walker got on."""
    end = track[-1]["t"] - 3.0
    return end - 5.0, end


def row_at(track, t):
    return min(track, key=lambda r: abs(r["t"] - t))


def walks(program):
    """Yields (NEES of the place, error in m, its 1-sigma, NEES of the heading) per walk."""
    rng, shapes = support.generator("starts"), list(SHAPES.values())
    for seed in range(1, SEEDS + 1):
        walk = program.simulate("start,0,0,0\n" + shapes[(seed - 1) % len(shapes)], seed)
        track, _ = program.replay(told(walk, rng))
        truth = support.read_table(walk / "truth.csv")
        begin_s, end_s = last_way(track)
        error = yaw_error(track, truth, begin_s, end_s)
        variance = row_at(track, 0.5 * (begin_s + end_s))["var_heading"]
        last = track[-1]
        place = row_at(truth, last["t"])
        yield (*squared_error(last, place), math.sqrt(last["var_x"] + last["var_y"]),
               error * error / variance)


def share(values, limit):
    return sum(v <= limit for v in values) / len(values)


def main():
    given = support.arguments(__doc__)
    checks = support.Checks()
    with support.Program(given.insole) as program:
        nees, errors, sigmas, heading = zip(*walks(program))
    print(f"{SEEDS} walks: rms error {math.sqrt(statistics.mean(e * e for e in errors)):.3f} m, "
          f"rms of the reported 1-sigma {math.sqrt(statistics.mean(s * s for s in sigmas)):.3f} m")
    checks.within("mean NEES of the last place (2 when honest)", statistics.mean(nees), 0.3, 6.0)
    for sigmas, honest in ((1, 0.393), (2, 0.865), (3, 0.989)):
        print(f"share inside {sigmas} sigma: {share(nees, sigmas * sigmas):.3f} "
              f"({honest} when honest)")
    for number, name in enumerate(SHAPES):
        print(f"  {name}: mean NEES {statistics.mean(nees[number::len(SHAPES)]):.2f}")
    checks.within("mean NEES of the heading (1 when honest)", statistics.mean(heading), 0.15, 3.0)
    checks.within("headings inside 2 sigma (0.954)", share(heading, 4.0), 0.8, 1.0)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
