#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What radio alone reaches: method `wifi` on real round-trip times and signal strengths.

    rtt.py --insole build/bin/insole --data ../shared/data/rtt              the table
    rtt.py ... --update README.md                                           put it there
    rtt.py ... --check                                                      is it still so?

The logs have no IMU. Errors are those at all points of truth of a scene's runs.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import kept  # noqa: E402
import program as support  # noqa: E402

BEGIN, END = "<!-- rtt:begin -->", "<!-- rtt:end -->"
USES = {"range": "round-trip times", "rss": "signal strengths"}

# Mean errors in m to be reached: by ranges what a good robust fit does, by strengths what the
# weighted centroid of the access points was measured to do.
WANTED_M = {("Laboratory", "range"): 1.35, ("Shopping_Mall", "range"): 0.95,
            ("Laboratory", "rss"): 3.29, ("Shopping_Mall", "rss"): 3.74}

# What is reached; equal programs give equal bits.
EXPECTED_M = {("Laboratory", "range"): 0.763, ("Shopping_Mall", "range"): 0.691,
              ("Laboratory", "rss"): 2.878, ("Shopping_Mall", "rss"): 3.933}


def runs_of(scene):
    return sorted(path for path in scene.glob("run_*.csv")
                  if not path.name.endswith(".truth.csv"))


def replay_scene(program, scene, use):
    """Scores of the scene's runs, each with as many rows as the log has moments."""
    scores = []
    for log in runs_of(scene):
        out = program.folder / "track.csv"
        program.must("replay", log, "--aps", scene / "aps.csv", "--method", "wifi", "--use", use,
                     "--out", out)
        scores.append(program.score(out, log.with_suffix(".truth.csv"), align="none"))
    return scores


def pooled(scores):
    """(mean, largest) over all points."""
    points = sum(score["n"] for score in scores)
    return (sum(score["n"] * score["mean_m"] for score in scores) / points,
            max(score["max_m"] for score in scores))


def measure(program, data):
    return {(scene.name, use): pooled(replay_scene(program, scene, use))
            for scene in sorted(data.iterdir()) if scene.is_dir() for use in USES}


def table(results):
    lines = ["| scene | by | mean m | to reach | largest m |", "|---|---|---|---|---|"]
    lines += [f"| {scene} | {USES[use]} | {mean:.2f} | {WANTED_M[scene, use]:.2f} | {largest:.1f} |"
              for (scene, use), (mean, largest) in results.items()]
    return "\n".join(lines)


def check(results):
    checks = support.Checks()
    for key, (mean, _) in results.items():
        checks.within(f"{key[0]} by {key[1]}: mean error", mean, 0.97 * EXPECTED_M[key],
                      1.03 * EXPECTED_M[key], "m")
    return checks.exit_code()


def main():
    parser = kept.recordings_parser(__doc__)
    parser.add_argument("--update", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    given = parser.parse_args()
    if kept.lacks(given.data):
        return kept.SKIPPED
    with support.Program(given.insole) as program:
        results = measure(program, given.data)
    print(table(results))
    if given.update:
        kept.update(given.update, BEGIN, END, table(results))
    return check(results) if given.check else 0


if __name__ == "__main__":
    sys.exit(main())
