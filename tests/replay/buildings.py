#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the second order reaches on real walks inside floor plans.

    buildings.py --insole build/bin/insole --data ../shared/data               the table, 20 seeds
    buildings.py ... --seeds 5 --only all,plan                                 a part of it
    buildings.py ... --update README.md                                        put it there
    buildings.py ... --expect                                                  the file buildings.csv
    buildings.py ... --expected tests/replay/buildings.csv                     one seed against it

Errors are those at the points of truth after the start, pooled over walks and seeds; the track is
interpolated at their times, a point without one counts 30 m. Whatever is random (the half of the
access points, where a wrong start lies) follows from walk and seed.
"""
import concurrent.futures
import json
import math
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import kept  # noqa: E402
import program as support  # noqa: E402
from tracks import errors_of, percentile, read_lines, read_track, show_progress, Track  # noqa: E402,E501

BEGIN, END = "<!-- buildings:begin -->", "<!-- buildings:end -->"
ASTRAY_M = 5.0
TURN_RAD, SHIFT_M = math.radians(37.0), (500.0, -500.0)
HOLD_S = 0.5
LAST_SCAN_S = 1.0


# ---- what is given -----------------------------------------------------------------------


class Walk:
    """One walk and what is to be known of its building."""

    def __init__(self, data, name):
        self.name, folder = name, data / "buildings" / name
        self.imu = data / "foot" / f"{name}.csv"
        self.plan, self.aps = read_lines(folder / "plan.csv"), read_lines(folder / "aps.csv")
        self.radio = read_lines(folder / "radio.csv")
        self.truth = [[float(cell) for cell in line.split(",")]
                      for line in read_lines(folder / "truth.csv")[1:]]
        start = next(line for line in self.radio if line.startswith("start,"))
        self.start = [float(cell) for cell in start.split(",")[1:]]
        self.first_scan_s = next(float(line.split(",")[1]) for line in self.radio
                                 if line.startswith("rss,"))
        self.options, self.since_s = [], self.start[0]

    def set_start(self, *fields):
        """Another start record; fields after the time."""
        told = ",".join(f"{field:.4f}" for field in fields)
        self.radio = [f"start,{self.start[0]},{told}" if line.startswith("start,") else line
                      for line in self.radio]

    def write(self, folder):
        """The session: what the program reads besides the IMU."""
        for name in ("plan", "aps", "radio"):
            text = "\n".join(getattr(self, name)) + "\n"
            (folder / f"{name}.csv").write_text(text, encoding="ascii")


def leave_all(walk, rng):
    pass


def with_lag(walk, rng):
    walk.options += ["--lag", "9"]


def half_of_aps(walk, rng):
    head, rows = walk.aps[0], walk.aps[1:]
    walk.aps = [head] + sorted(rng.sample(rows, (len(rows) + 1) // 2))


def plan_only(walk, rng):
    walk.aps = None


def aps_only(walk, rng):
    walk.plan = None


def no_heading(walk, rng):
    walk.set_start(*walk.start[1:3])


def no_start(walk, rng):
    walk.options += ["--no-start"]
    walk.since_s = walk.first_scan_s + LAST_SCAN_S


def wrong_start(walk, rng):
    """5 m away in any direction, 45 degrees to either side."""
    angle, side = rng.uniform(-math.pi, math.pi), rng.choice((-1.0, 1.0))
    _, x, y, heading = walk.start
    return (x + 5.0 * math.cos(angle), y + 5.0 * math.sin(angle),
            support.wrap(heading + side * math.pi / 4.0))


def wrong_start_told(walk, rng):
    walk.set_start(*wrong_start(walk, rng), 3.5, 0.785)


def wrong_start_untold(walk, rng):
    walk.set_start(*wrong_start(walk, rng))


def wrong_losses(walk, rng):
    """Walls of 8 dB instead of 4, and all access points 5 dB too strong."""
    walk.plan = ["loss,8" if line.startswith("loss,") else
                 ",".join(["wall", "8", *line.split(",")[2:]]) if line.startswith("wall,") else
                 line for line in walk.plan]
    column = walk.aps[0].split(",").index("p0_dbm")
    rows = [line.split(",") for line in walk.aps[1:]]
    for row in rows:
        row[column] = f"{float(row[column]) + 5.0:.1f}"
    walk.aps = [walk.aps[0]] + [",".join(row) for row in rows]


def turned(x, y):
    c, s = math.cos(TURN_RAD), math.sin(TURN_RAD)
    return c * x - s * y + SHIFT_M[0], s * x + c * y + SHIFT_M[1]


def turn_line(line, first):
    """The coordinates from field `first` on."""
    cells = line.split(",")
    pairs = zip(map(float, cells[first::2]), map(float, cells[first + 1::2]))
    return ",".join(cells[:first] + [f"{c:.4f}" for x, y in pairs for c in turned(x, y)])


def turned_map(walk, rng):
    first = {"outline": 1, "hole": 1, "wall": 2}
    walk.plan = [turn_line(line, first[line.split(",")[0]])
                 if line.split(",")[0] in first else line for line in walk.plan]
    rows = [line.split(",") for line in walk.aps[1:]]
    walk.aps = [walk.aps[0]] + [
        ",".join([row[0], *(f"{c:.4f}" for c in turned(float(row[1]), float(row[2]))), *row[3:]])
        for row in rows]
    _, x, y, heading = walk.start
    walk.set_start(*turned(x, y), support.wrap(heading + TURN_RAD))
    walk.truth = [[t, *turned(x, y)] for t, x, y in walk.truth]


def two_order(walk, rng):
    walk.options += ["--method", "two-order"]


def ins(walk, rng):
    walk.options += ["--method", "ins"]


CONFIGURATIONS = {
    "all": ("plan + all access points, start record", leave_all),
    "lag": ("the same with `--lag 9`", with_lag),
    "half": ("plan + a random half of the access points", half_of_aps),
    "plan": ("plan only", plan_only),
    "aps": ("access points only", aps_only),
    "no-heading": ("plan + access points, heading unknown", no_heading),
    "no-start": ("plan + access points, start unknown (from 1 s after the first scan)", no_start),
    "wrong-told": ("start 5 m and 45 degrees wrong and said to be that uncertain",
                   wrong_start_told),
    "wrong-untold": ("the same start not said to be uncertain", wrong_start_untold),
    "losses": ("assumed losses wrong: walls 8 dB for 4, p0 off by 5 dB", wrong_losses),
    "turned": ("the map turned by 37 degrees and shifted by 500 m", turned_map),
    "two-order": ("`two-order`, plan + access points, start record", two_order),
    "ins": ("`ins`: nothing but the IMU", ins),
}
NOT_RANDOM = {"ins"}


# ---- one run -----------------------------------------------------------------------------


def walls_of(plan):
    """Segments of all rings and inner walls."""
    walls = []
    for line in plan:
        cells = line.split(",")
        if cells[0] not in ("outline", "hole", "wall"):
            continue
        values = list(map(float, cells[2 if cells[0] == "wall" else 1:]))
        points = list(zip(values[::2], values[1::2]))
        if cells[0] != "wall":
            points.append(points[0])
        walls += zip(points, points[1:])
    return walls


def side(a, b, p):
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def crosses(walls, p, q):
    return any(side(a, b, p) * side(a, b, q) < 0.0 and side(p, q, a) * side(p, q, b) < 0.0
               for a, b in walls)


def count_crossings(track, events, walls):
    """(strides through a wall, strides) of those reported while the state is track."""
    crossed = count = 0
    for line in events:
        cells = line.split(",")
        if cells[0] != "stride":
            continue
        begin, end = float(cells[1]), float(cells[2])
        p, q = track.place(begin), track.place(end)
        if p and q and track.state(begin) == track.state(end) == "track":
            count += 1
            crossed += crosses(walls, p, q)
    return crossed, count


def arguments_of(walk, folder, seed):
    building = [word for name in ("plan", "aps") if getattr(walk, name)
                for word in (f"--{name}", folder / f"{name}.csv")]
    if "ins" in walk.options:
        building = []
    return [walk.imu, folder / "radio.csv", *building, "--seed", seed, *walk.options]


def prepare(data, name, configuration, seed, folder):
    """A walk as the configuration has it, written to the folder."""
    walk = Walk(data, name)
    CONFIGURATIONS[configuration][1](walk, support.generator(f"{name} {seed}"))
    kept = walk.plan, walk.aps
    walk.plan, walk.aps = walk.plan or [], walk.aps or []
    folder.mkdir(parents=True, exist_ok=True)
    walk.write(folder)
    walk.plan, walk.aps = kept
    return walk


def run(program, data, name, configuration, seed):
    """(errors, strides through walls, strides)"""
    folder = program.folder / f"{configuration}-{name}-{seed}"
    walk = prepare(data, name, configuration, seed, folder)
    out, events = folder / "track.csv", folder / "events.csv"
    program.must("replay", *arguments_of(walk, folder, seed), "--out", out, "--events", events)
    track = Track(read_track(out))
    truth = [point for point in walk.truth if point[0] > walk.since_s]
    errors = errors_of(track, truth)
    if seed == 1:
        check_score(program, folder, truth, errors)
    crossed, strides = count_crossings(track, read_lines(events), walls_of(walk.plan or []))
    for path in folder.iterdir():
        path.unlink()
    return errors, crossed, strides


def check_score(program, folder, truth, errors):
    """The program itself scores the same."""
    path = folder / "truth.csv"
    path.write_text("t,x,y\n" + "".join(f"{t:.6f},{x:.6f},{y:.6f}\n" for t, x, y in truth),
                    encoding="ascii")
    score = program.score(folder / "track.csv", path, align="none")
    if abs(score["mean_m"] - statistics.mean(errors)) > 2e-3:
        sys.exit(f"{folder.name}: insole score says {score['mean_m']} m, "
                 f"this script {statistics.mean(errors)} m")


# ---- all runs ----------------------------------------------------------------------------


class Result:
    """Everything pooled over the runs of one configuration."""

    def __init__(self, runs):
        errors = [error for run_ in runs for error in run_[0]]
        self.mean, self.p95 = statistics.mean(errors), percentile(errors, 0.95)
        self.max, self.runs = max(errors), len(runs)
        self.astray = sum(run_[0][-1] > ASTRAY_M for run_ in runs)
        strides = sum(run_[2] for run_ in runs)
        self.crossed = sum(run_[1] for run_ in runs) / strides if strides else 0.0

    def row(self, title, has_plan):
        crossed = f"{100.0 * self.crossed:.2f} %" if has_plan else ""
        return (f"| {title} | {self.mean:.3f} | {self.p95:.2f} | {self.max:.2f} | "
                f"{self.astray} of {self.runs} | {crossed} |")


def names_of(data):
    return sorted(path.name for path in (data / "buildings").iterdir() if path.is_dir())


def run_all(program, data, configurations, seeds, jobs):
    """Results by configuration."""
    todo = [(configuration, name, seed) for configuration in configurations
            for seed in range(1, 1 + (1 if configuration in NOT_RANDOM else seeds))
            for name in names_of(data)]
    runs = {configuration: [] for configuration in configurations}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        waiting = [(configuration, pool.submit(run, program, data, name, configuration, seed))
                   for configuration, name, seed in todo]
        for done, (configuration, future) in enumerate(waiting, 1):
            runs[configuration].append(future.result())
            show_progress(done, len(todo), configuration)
    return {configuration: Result(of) for configuration, of in runs.items()}


def table(results):
    lines = ["| given | mean m | 95 % m | largest m | ends over 5 m off | strides through a wall |",
             "|---|---|---|---|---|---|"]
    return "\n".join(lines + [result.row(CONFIGURATIONS[key][0], key not in ("aps", "ins"))
                              for key, result in results.items()])


# ---- prefix law --------------------------------------------------------------------------


def stamp(line):
    cell = line.split(b",")[1 if line[:1].isalpha() else 0]
    return float(cell)


def cut(path, end_s, folder):
    """The log up to a time; a header stays."""
    lines = path.read_bytes().splitlines(keepends=True)
    kept = [line for line in lines if line.startswith((b"t,", b"#")) or stamp(line) <= end_s]
    (folder / path.name).write_bytes(b"".join(kept))
    return folder / path.name


def settled(track, end_s):
    lines = track.splitlines(keepends=True)
    return [line for line in lines[1:] if float(line.split(b",", 1)[0]) <= end_s - HOLD_S + 1e-9]


def check_prefix(program, data, checks):
    """Logs cut in three places give the rows of the whole."""
    rows = 0
    for configuration in ("all", "no-start", "wrong-untold", "two-order"):
        name = support.generator(configuration).choice(names_of(data))
        folder = program.folder / f"prefix-{configuration}"
        walk = prepare(data, name, configuration, 1, folder)
        whole = program.must("replay", *arguments_of(walk, folder, 1), "--out", "-")
        end_s, begin_s = walk.truth[-1][0], walk.truth[0][0]
        parts = folder / "parts"
        parts.mkdir()
        for share in (0.05, 0.3, 0.7):
            at_s = begin_s + share * (end_s - begin_s)
            given = arguments_of(walk, folder, 1)
            given[:2] = [cut(path, at_s, parts) for path in given[:2]]
            part = settled(program.must("replay", *given, "--out", "-"), at_s)
            same = part == settled(whole, at_s)
            checks.that(f"{configuration} {name} cut at {at_s:.2f} s gives the same rows", same)
            rows += len(part)
    print(f"prefix law: {rows} rows of cut logs compared")


# ---- command -----------------------------------------------------------------------------


def write_expectations(results, file):
    kept.write_means(file, "buildings.py", "configuration",
                     [(key, result.mean, max(0.01, 0.1 * result.mean))
                      for key, result in results.items()])


def check_expectations(program, data, path, jobs):
    checks, rows = support.Checks(), kept.read_rows(path)
    results = run_all(program, data, [row["configuration"] for row in rows], 1, jobs)
    kept.check_means(checks, "configuration", rows, lambda name: results[name].mean)
    check_prefix(program, data, checks)
    return checks.exit_code()


def parse():
    parser = kept.recordings_parser(__doc__, seeds=20, rows=CONFIGURATIONS)
    parser.add_argument("--json", action="store_true", help="the figures as JSON")
    return parser.parse_args()


def main():
    given = parse()
    if kept.lacks(given.data / "buildings"):
        return kept.SKIPPED
    with support.Program(given.insole) as program:
        if given.expected:
            return check_expectations(program, given.data, given.expected, given.jobs)
        only = given.only.split(",") if given.only else list(CONFIGURATIONS)
        results = run_all(program, given.data, only, 1 if given.expect else given.seeds,
                          given.jobs)
    if given.expect:
        write_expectations(results, sys.stdout)
        return 0
    if given.json:
        print(json.dumps({key: vars(result) for key, result in results.items()}, indent=1))
        return 0
    result = table(results)
    if given.update:
        kept.update(given.update, BEGIN, END, result)
    print(result)
    return 0


if __name__ == "__main__":
    sys.exit(main())
