# SPDX-License-Identifier: MIT
"""What the Python tests share: the program run, logs read and written, and checks with limits.

    with Program(path) as program:
        track, summary = program.replay(log)
        checks.within("what", value, low, high, "m")
    return checks.exit_code()
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

SKIPPED = 77


class Program:
    """The program `insole` and a folder for what it makes."""

    def __init__(self, path):
        self.path = path
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.scratch.cleanup()

    def run(self, *arguments, stdin=None):
        """Text or bytes on standard input; what came of it."""
        given = stdin.encode("ascii") if isinstance(stdin, str) else stdin or b""
        return subprocess.run([str(self.path), *map(str, arguments)], input=given,
                              capture_output=True, check=False)

    def must(self, *arguments, stdin=None):
        done = self.run(*arguments, stdin=stdin)
        if done.returncode != 0:
            sys.exit(f"insole {' '.join(map(str, arguments))}: exit {done.returncode}: "
                     f"{done.stderr.decode()}")
        return done.stdout

    def rows(self, log, *options, stdin=None):
        """The bytes of the track."""
        return self.must("replay", log, "--out", "-", *options, stdin=stdin)

    def replay(self, log, *options):
        """(track, summary)"""
        out = self.folder / "track.csv"
        summary = self.must("replay", log, "--out", out, "--json", *options)
        return read_table(out), json.loads(summary)

    def score(self, track, truth, align="se2"):
        return json.loads(self.must("score", track, truth, "--align", align, "--json"))

    def simulate(self, scenario, seed):
        """The folder with log.csv and truth.csv; `scenario` is its text."""
        path = self.folder / "scenario"
        path.write_text(scenario, encoding="ascii")
        out = self.folder / f"walk{seed}"
        self.must("simulate", path, "--out", out, "--seed", seed)
        return out


# ---- tables ------------------------------------------------------------------------------


def to_number(text):
    try:
        return float(text)
    except ValueError:
        return text


def read_table(path):
    """A CSV with a header: a list of dictionaries."""
    lines = pathlib.Path(path).read_text(encoding="ascii").splitlines()
    names = lines[0].split(",")
    return [dict(zip(names, map(to_number, line.split(",")))) for line in lines[1:]]


def read_imu(path):
    """[t, ax, ay, az, gx, gy, gz] of a table or of the imu records of a log."""
    samples = []
    for line in pathlib.Path(path).read_text(encoding="ascii").splitlines():
        fields = line.split(",")
        if fields[0] == "imu":
            samples.append([float(f) for f in fields[1:]])
        elif fields[0][0] in "-.0123456789":
            samples.append([float(f) for f in fields])
    return samples


def imu_text(samples):
    """The samples as a table; None becomes an empty field."""
    lines = ["t,ax,ay,az,gx,gy,gz"]
    for sample in samples:
        fields = ("" if value is None else f"{value:.9g}" for value in sample[1:])
        lines.append(f"{sample[0]:.6f},{','.join(fields)}")
    return "\n".join(lines) + "\n"


def write_imu(path, samples):
    pathlib.Path(path).write_text(imu_text(samples), encoding="ascii")
    return path


# ---- geometry ----------------------------------------------------------------------------


def random_rotation(rng):
    """Rows of a rotation, evenly distributed."""
    while True:
        q = [rng.gauss(0.0, 1.0) for _ in range(4)]
        norm = math.sqrt(sum(c * c for c in q))
        if norm > 1e-3:
            break
    w, x, y, z = (c / norm for c in q)
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def turned(samples, rotation):
    """What the sensor reads when it is mounted otherwise."""
    def turn(v):
        return [sum(r * c for r, c in zip(row, v)) for row in rotation]
    return [[s[0], *turn(s[1:4]), *turn(s[4:7])] for s in samples]


def wrap(angle_rad):
    return math.remainder(angle_rad, 2.0 * math.pi)


def largest_distance(track, other):
    """Between rows of equal number, in space, after the best turn about the vertical at (0, 0)."""
    pairs = list(zip(track, other))
    cross = sum(a["x"] * b["y"] - a["y"] * b["x"] for a, b in pairs)
    dot = sum(a["x"] * b["x"] + a["y"] * b["y"] for a, b in pairs)
    c, s = math.cos(math.atan2(cross, dot)), math.sin(math.atan2(cross, dot))
    return max(math.dist((c * a["x"] - s * a["y"], s * a["x"] + c * a["y"], a["z"]),
                         (b["x"], b["y"], b["z"])) for a, b in pairs)


# ---- checks ------------------------------------------------------------------------------


class Checks:
    """Prints each measured value beside its limits and remembers what failed."""

    def __init__(self):
        self.count = self.failed = 0

    def that(self, what, is_true, why=""):
        self.count += 1
        self.failed += not is_true
        if not is_true:
            print(f"FAILED: {what}{': ' if why else ''}{why}")
        return is_true

    def within(self, what, value, low, high, unit=""):
        fits = low <= value <= high
        self.count += 1
        self.failed += not fits
        print(f"{what}: {value:.4g} {unit} (expected {low:.4g} to {high:.4g})"
              f"{'' if fits else ' - FAILED'}")
        return fits

    def equal(self, what, value, expected):
        return self.that(what, value == expected, f"{value!r} instead of {expected!r}")

    def exit_code(self):
        print(f"{self.count} checks, {self.failed} failed")
        return 1 if self.failed or not self.count else 0


def arguments(doc, *names):
    """--insole, and what else the test needs; a --data that is absent ends it as skipped."""
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    for name in ("insole", *names):
        parser.add_argument(f"--{name}", required=True)
    given = parser.parse_args()
    if "data" in names and not pathlib.Path(given.data).is_dir():
        print(f"SKIPPED: there are no recordings at {given.data}")
        sys.exit(SKIPPED)
    return given


def generator(text):
    """Random numbers of this test's own, the same on every run."""
    return random.Random(text)
