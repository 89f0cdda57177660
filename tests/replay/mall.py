#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the phone tracker reaches on recorded walks through one floor of a shopping mall.

    mall.py --insole build/bin/insole --data ../shared/data                the table, 20 seeds
    mall.py ... --seeds 5 --only pdr,best                                  a part of it
    mall.py ... --update README.md                                         put it there
    mall.py ... --expect --only pdr,wifi-kde,...                           the file mall.csv
    mall.py ... --expected tests/replay/mall.csv                           one seed against it

Walks whose number is divisible by 4 are the test; the others are the survey that the radio map is
made of. Each of these is replayed, too, with a map of the others: a setting that helps the test
alone would show. Errors are those at all waypoints, pooled over walks and seeds; where the start is
not told, at those from one second after the first scan on. A waypoint without a row counts 30 m.
"""
import concurrent.futures
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import kept  # noqa: E402
import program as support  # noqa: E402
from tracks import errors_of, percentile, read_lines, read_track  # noqa: E402
from tracks import show_progress, Track  # noqa: E402

BEGIN, END = "<!-- mall:begin -->", "<!-- mall:end -->"
LAST_SCAN_S = 1.0
HOLD_S = 0.5

# Rows: method, and what is told besides the log and, to all but the steps alone, the radio map.
TOLD, AUTO, PLAN = "start record", "automatic start", "plan, "
ROWS = {
    "pdr-gyro": ("pdr-gyro", TOLD),
    "pdr": ("pdr", TOLD),
    "wifi-ml": ("wifi-ml", AUTO),
    "wifi-kde": ("wifi-kde", AUTO),
    "ekf": ("ekf", AUTO),
    "ekf-told": ("ekf", TOLD),
    "ukf": ("ukf", AUTO),
    "ukf-told": ("ukf", TOLD),
    "ml-shift": ("ml-shift", AUTO),
    "ml-shift-told": ("ml-shift", TOLD),
    "pf": ("pf", AUTO),
    "pf-told": ("pf", TOLD),
    "pf-kde": ("pf-kde", AUTO),
    "pf-kde-told": ("pf-kde", TOLD),
    "best": ("best", AUTO),
    "best-told": ("best", TOLD),
    "best-plan": ("best", PLAN + AUTO),
    "best-plan-told": ("best", PLAN + TOLD),
}
STEPS_ALONE = ("pdr", "pdr-gyro")
RANDOM = ("pf", "pf-told", "pf-kde", "pf-kde-told", "best-plan", "best-plan-told")


# ---- the recordings ----------------------------------------------------------------------


class Walk:
    """One walk and what is known of it."""

    def __init__(self, folder):
        self.folder, self.name = folder, folder.name
        self.is_test = int(folder.name[1:]) % 4 == 0
        self.truth = [[float(cell) for cell in line.split(",")]
                      for line in read_lines(folder / "truth.csv")[1:]]
        self.first_scan_s = next(float(line.split(",")[1])
                                 for line in read_lines(folder / "radio.csv")
                                 if line.startswith("rss,"))

    def waypoints(self, is_told):
        since_s = -1e9 if is_told else self.first_scan_s + LAST_SCAN_S
        return [point for point in self.truth if point[0] >= since_s]


def walks_of(data):
    return [Walk(path) for path in sorted((data / "phone" / "mall_F1").glob("p[0-9]*"))]


def make_map(program, walks, name):
    path = program.folder / f"{name}.csv"
    program.must("radiomap", *(walk.folder for walk in walks), "--out", path)
    return path


# ---- runs --------------------------------------------------------------------------------


def arguments_of(walk, row, radiomap, seed):
    method, given = ROWS[row]
    arguments = [walk.folder / "imu.csv", walk.folder / "radio.csv", "--tracker", "phone",
                 "--method", method, "--seed", seed]
    if given.endswith(TOLD):
        arguments.append(walk.folder / "start.csv")
    if method not in STEPS_ALONE:
        arguments += ["--radiomap", radiomap]
    if given.startswith(PLAN):
        arguments += ["--plan", walk.folder.parent / "plan.csv"]
    return arguments


def run(program, walk, row, radiomap, seed):
    """Errors at the waypoints."""
    out = program.folder / f"{row}-{walk.name}-{seed}.csv"
    program.must("replay", *arguments_of(walk, row, radiomap, seed), "--out", out)
    track = Track(read_track(out))
    out.unlink()
    return errors_of(track, walk.waypoints(ROWS[row][1].endswith(TOLD)))


class Result:
    """Errors of one row, pooled."""

    def __init__(self, errors):
        self.mean, self.p50 = statistics.mean(errors), percentile(errors, 0.5)
        self.p75, self.p90 = percentile(errors, 0.75), percentile(errors, 0.9)


def run_all(program, tasks, jobs):
    """Results by key of (key, walk, row, map, seed)."""
    errors = {}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        waiting = [(task[0], pool.submit(run, program, *task[1:])) for task in tasks]
        for done, (key, future) in enumerate(waiting, 1):
            errors.setdefault(key, []).extend(future.result())
            show_progress(done, len(tasks), key[1])
    return {key: Result(of) for key, of in errors.items()}


def seeds_of(row, seeds):
    return range(1, 1 + (seeds if row in RANDOM else 1))


def test_tasks(program, walks, rows, seeds):
    radiomap = make_map(program, [walk for walk in walks if not walk.is_test], "survey")
    return [(("test", row), walk, row, radiomap, seed) for row in rows
            for seed in seeds_of(row, seeds) for walk in walks if walk.is_test]


def survey_tasks(program, walks, rows):
    """Each walk of the survey against a map of the others."""
    survey = [walk for walk in walks if not walk.is_test]
    tasks = []
    for walk in survey:
        others = [other for other in survey if other is not walk]
        radiomap = make_map(program, others, f"without-{walk.name}")
        tasks += [(("survey", row), walk, row, radiomap, 1) for row in rows]
    return tasks


def table(results, rows):
    lines = ["| method | given | mean m | 50 % m | 75 % m | 90 % m | survey, each against the "
             "others: mean m | 90 % m |", "|---|---|---|---|---|---|---|---|"]
    for row in rows:
        test, left = results["test", row], results["survey", row]
        lines.append(f"| `{ROWS[row][0]}` | {ROWS[row][1]} | {test.mean:.2f} | {test.p50:.2f} | "
                     f"{test.p75:.2f} | {test.p90:.2f} | {left.mean:.2f} | {left.p90:.2f} |")
    return "\n".join(lines)


# ---- prefix law --------------------------------------------------------------------------


def cut(path, end_s, folder):
    """The log up to a time; a header stays."""
    kept = []
    for line in path.read_bytes().splitlines(keepends=True):
        cells = line.split(b",")
        is_record = cells[0] in (b"rss", b"start")
        if cells[0] == b"t" or line[:1] == b"#" or float(cells[1 if is_record else 0]) <= end_s:
            kept.append(line)
    (folder / path.name).write_bytes(b"".join(kept))
    return folder / path.name


def settled(track, end_s):
    lines = track.splitlines(keepends=True)
    return [line for line in lines[1:] if float(line.split(b",", 1)[0]) <= end_s - HOLD_S + 1e-9]


def check_prefix(program, walks, checks, wanted):
    """Logs cut in three places give the rows of the whole."""
    radiomap = make_map(program, [walk for walk in walks if not walk.is_test], "survey")
    rows = 0
    for row in wanted:
        walk = support.generator(row).choice([walk for walk in walks if walk.is_test])
        given = arguments_of(walk, row, radiomap, 1)
        whole = program.must("replay", *given, "--out", "-")
        for share in (0.1, 0.4, 0.8):
            end_s = share * walk.truth[-1][0]
            given[:2] = [cut(walk.folder / name, end_s, program.folder)
                         for name in ("imu.csv", "radio.csv")]
            part = settled(program.must("replay", *given, "--out", "-"), end_s)
            checks.that(f"{row} {walk.name} cut at {end_s:.2f} s gives the same rows",
                        part == settled(whole, end_s))
            rows += len(part)
    print(f"prefix law: {rows} rows of cut logs compared")


# ---- command -----------------------------------------------------------------------------


def write_expectations(results, rows, file):
    means = [(row, results["test", row].mean) for row in rows]
    kept.write_means(file, "mall.py", "row", [(row, mean, 0.05 * mean) for row, mean in means])


def check_expectations(program, walks, path, jobs):
    checks, rows = support.Checks(), kept.read_rows(path)
    names = [row["row"] for row in rows]
    results = run_all(program, test_tasks(program, walks, names, 1), jobs)
    kept.check_means(checks, "row", rows, lambda name: results["test", name].mean)
    check_prefix(program, walks, checks, names)
    return checks.exit_code()


def main():
    given = kept.recordings_parser(__doc__, seeds=20, rows=ROWS).parse_args()
    if kept.lacks(given.data / "phone" / "mall_F1"):
        return kept.SKIPPED
    walks = walks_of(given.data)
    rows = given.only.split(",") if given.only else list(ROWS)
    with support.Program(given.insole) as program:
        if given.expected:
            return check_expectations(program, walks, given.expected, given.jobs)
        tasks = test_tasks(program, walks, rows, 1 if given.expect else given.seeds)
        if given.expect:
            write_expectations(run_all(program, tasks, given.jobs), rows, sys.stdout)
            return 0
        results = run_all(program, tasks + survey_tasks(program, walks, rows), given.jobs)
    result = table(results, rows)
    if given.update:
        kept.update(given.update, BEGIN, END, result)
    print(result)
    return 0


if __name__ == "__main__":
    sys.exit(main())
