#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the shoe tracker reaches on the real recordings.

    results.py --insole build/bin/insole --data ../shared/data/foot            the table
    results.py ... --update README.md                                          put it there
    results.py ... --check README.md                                           is it still true?
    results.py ... --file llio_36 --expected tests/replay/expected.csv         one recording
    results.py ... --expect                                                    the file expected.csv

Every replay runs on defaults but for what its row says.
The exit code is 77 where the recordings are absent.
"""
import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import kept  # noqa: E402

BEGIN, END = "<!-- results:begin -->", "<!-- results:end -->"
DETECTORS = ["two-step", "shoe", "mv", "mag", "are"]


class Bench:
    """The program and the recordings it runs on."""

    def __init__(self, insole, data):
        self.insole, self.data = insole, pathlib.Path(data)
        self.scratch = tempfile.TemporaryDirectory()

    def names(self, prefix=""):
        truths = sorted(self.data.glob(prefix + "*.truth.csv"))
        return [path.name[: -len(".truth.csv")] for path in truths]

    def score(self, name, options=(), log=None):
        log = log or self.data / f"{name}.csv"
        command = [self.insole, "replay", str(log), "--out",
                   f"{self.scratch.name}/track.csv", *options]
        subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
        command = [self.insole, "score", f"{self.scratch.name}/track.csv",
                   str(self.data / f"{name}.truth.csv"), "--align", "se2", "--json"]
        return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)

    def averaged(self, name, rate_hz):
        """The recording with neighbours averaged until at most rate_hz are left."""
        path = pathlib.Path(self.scratch.name) / f"{name}.csv"
        with open(self.data / f"{name}.csv", encoding="ascii") as source:
            rows = [[float(cell) for cell in row] for row in list(csv.reader(source))[1:]]
        group = max(1, round((len(rows) - 1) / (rows[-1][0] - rows[0][0]) / rate_hz))
        with open(path, "w", encoding="ascii") as target:
            target.write("t,ax,ay,az,gx,gy,gz\n")
            for i in range(0, len(rows) - group + 1, group):
                part = rows[i:i + group]
                means = [sum(row[k] for row in part) / group for k in range(1, 7)]
                target.write(f"{part[-1][0]:.6f}," + ",".join(f"{m:.6f}" for m in means) + "\n")
        return path


def replay_set(bench, prefix, options=(), rate_hz=None):
    return [bench.score(name, options, bench.averaged(name, rate_hz) if rate_hz else None)
            for name in bench.names(prefix)]


def column(scores, key):
    return [score[key] for score in scores]


def end_3d(score):
    return score["end_2d_m"] if score["end_3d_m"] is None else score["end_3d_m"]


def row(bench, title, options=(), rate_hz=None):
    """One row of the table: every set under one choice of options."""
    sets = {key: replay_set(bench, key, options, rate_hz)
            for key in ("vicon_2017", "llio", "vicon_2018", "ucr", "openshoe", "xio_short",
                        "xio_long")}
    vicon, llio, odd = sets["vicon_2017"], sets["llio"], sets["vicon_2018"]
    cells = [
        f"{statistics.mean(column(vicon, 'rms_m')):.3f} / {max(column(vicon, 'rms_m')):.2f} / "
        f"{statistics.mean(column(vicon, 'z_rms_m')):.3f}",
        f"{statistics.mean(column(llio, 'rms_m')):.3f} / {max(column(llio, 'rms_m')):.2f} / "
        f"{statistics.median(column(llio, 'end_percent')):.2f} %",
        f"{statistics.mean(column(odd, 'rms_m')):.3f} / "
        f"{statistics.mean(column(odd, 'z_rms_m')):.2f}",
        f"{sets['ucr'][0]['rms_m']:.3f}",
        f"{statistics.median(map(end_3d, sets['openshoe'])):.2f} / "
        f"{statistics.median(column(sets['openshoe'], 'end_2d_m')):.2f}",
        f"{end_3d(sets['xio_short'][0]):.3f}, {end_3d(sets['xio_long'][0]):.3f}",
    ]
    return f"| {title} | " + " | ".join(cells) + " |"


def table(bench):
    lines = [
        "| | vicon_2017 (23): mean / worst / height | llio (8): mean / worst / median end error "
        "| vicon_2018 (5): mean / height | ucr | openshoe (5): median end 3-D / horizontal "
        "| xio short, long: end 3-D |",
        "|---|---|---|---|---|---|---|",
        row(bench, "**defaults**: adaptive detector, 12 states"),
        row(bench, "smoothed (`--smooth`)", ["--smooth"]),
        row(bench, "9 states (no accelerometer bias)",
            ["--set", "zupt_ekf.sigma_accel_bias_mps2=0"]),
        row(bench, "without the level-floor rule", ["--set", "foot_tracker.floor_step_m=0"]),
        row(bench, "averaged down to 100 Hz", rate_hz=100.0),
    ]
    lines += [row(bench, f"detector {name}", ["--set", f"zero_velocity.detector={name}"])
              for name in DETECTORS]
    lines.append(row(bench, "method `pdr`", ["--method", "pdr"]))
    return "\n".join(lines)


def expectation(bench, name):
    """What is held on to for one recording: key, value, tolerance."""
    score = bench.score(name)
    if score["n"] == 2:
        return [("end_3d_m", end_3d(score), 0.05)]
    rows = [("rms_m", score["rms_m"], max(0.01, 0.1 * score["rms_m"]))]
    if score["z_rms_m"] is not None:
        rows.append(("z_rms_m", score["z_rms_m"], max(0.02, 0.1 * score["z_rms_m"])))
    return rows


def write_expectations(bench, file):
    writer = csv.writer(file, lineterminator="\n")
    file.write("# SPDX-License-Identifier: MIT\n# Made by results.py --expect.\n")
    writer.writerow(["recording", "key", "value", "tolerance"])
    for name in bench.names():
        for key, value, tolerance in expectation(bench, name):
            writer.writerow([name, key, f"{value:.4f}", f"{tolerance:.4f}"])


def check_file(bench, name, expected):
    wanted = [row for row in kept.read_rows(expected) if row["recording"] == name]
    if not wanted:
        print(f"{name}: no expectation in {expected}")
        return 1
    score, failed = bench.score(name), 0
    for row_ in wanted:
        value = end_3d(score) if row_["key"] == "end_3d_m" else score[row_["key"]]
        low, high = (float(row_["value"]) + s * float(row_["tolerance"]) for s in (-1, 1))
        fits = low <= value <= high
        failed += not fits
        print(f"{name}: {row_['key']} = {value:.4f} m, expected {low:.4f} to {high:.4f} m"
              f"{'' if fits else ' - outside'}")
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--insole", required=True)
    parser.add_argument("--data", required=True)
    parser.add_argument("--update")
    parser.add_argument("--check")
    parser.add_argument("--file")
    parser.add_argument("--expected")
    parser.add_argument("--expect", action="store_true")
    given = parser.parse_args()
    if not pathlib.Path(given.data).is_dir():
        print(f"skipped: there are no recordings at {given.data}")
        return kept.SKIPPED
    bench = Bench(given.insole, given.data)
    if given.file:
        return check_file(bench, given.file, given.expected)
    if given.expect:
        write_expectations(bench, sys.stdout)
        return 0
    result = table(bench)
    if given.update or given.check:
        path = pathlib.Path(given.update or given.check)
        text = path.read_text(encoding="utf-8")
        fresh = kept.put_in(text, BEGIN, END, result)
        if given.check and fresh != text:
            print(f"{path}: the table of results is not what the program gives now:\n{result}")
            return 1
        path.write_text(fresh, encoding="utf-8")
    print(result)
    return 0


if __name__ == "__main__":
    sys.exit(main())
