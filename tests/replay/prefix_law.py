#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The prefix law: what is known of a walk does not change when the log goes on.

Every recording is cut in five places; the rows of the cut log are, byte for byte, those of the
whole log up to half a second before its end. Some are cut in the same way with a row per reading,
and come through standard input in small pieces.
"""
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import program as support  # noqa: E402

CUTS = 5
PER_READING = {"llio_36", "llio_40", "ucr_right", "vicon_2017-11-22-11-44-47", "xio_short_walk"}
HOLD_S = 0.5


def stamp(line):
    return float(line.split(b",", 1)[0])


def settled(track, end_s):
    """The lines of a track that the law speaks of; the header is one of them."""
    lines = track.splitlines(keepends=True)
    return [lines[0]] + [line for line in lines[1:] if stamp(line) <= end_s - HOLD_S + 1e-9]


def cuts(lines, rng):
    """One place in each fifth of the log, the first where there is hardly a walk yet."""
    fifth = (len(lines) - 1) // CUTS
    return [k * fifth + rng.randrange(2, fifth) for k in range(CUTS)]


def check_cut(checks, program, name, lines, whole, keep, options):
    end_s = stamp(lines[keep - 1])
    log = b"".join(lines[:keep])
    part = program.rows("-", *options, stdin=log)
    wanted, got = settled(whole, end_s), settled(part, end_s)
    different = [i for i, (a, b) in enumerate(zip(wanted, got)) if a != b]
    what = f"{name} {' '.join(options)} cut at {end_s:.3f} s"
    checks.equal(f"{what}: rows", len(got), len(wanted))
    checks.that(what, not different, f"row {different[:1]} differs")
    return len(got) - 1


def check_recording(checks, program, path, options):
    lines = path.read_bytes().splitlines(keepends=True)
    whole = program.rows(path, *options)
    piped = program.rows("-", *options, stdin=b"".join(lines))
    checks.that(f"{path.stem}: a file and standard input give the same bytes", whole == piped)
    rng = support.generator(path.stem)
    return sum(check_cut(checks, program, path.stem, lines, whole, keep, options)
               for keep in cuts(lines, rng))


def dribble(program, path):
    """The track when the log comes through a pipe in pieces of no particular length."""
    log = path.read_bytes()
    command = [str(program.path), "replay", "-", "--out", program.folder / "dribbled.csv"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        rng, at = support.generator("pieces"), 0
        while at < len(log):
            size = rng.randrange(1, 5000)
            process.stdin.write(log[at:at + size])
            process.stdin.flush()
            at += size
    return (program.folder / "dribbled.csv").read_bytes()


def main():
    given = support.arguments(__doc__, "data")
    checks, rows = support.Checks(), 0
    with support.Program(given.insole) as program:
        logs = sorted(p for p in pathlib.Path(given.data).glob("*.csv")
                      if not p.name.endswith(".truth.csv"))
        for path in logs:
            rows += check_recording(checks, program, path, ())
            if path.stem in PER_READING:
                rows += check_recording(checks, program, path, ("--rate", "0"))
                checks.that(f"{path.stem}: in pieces",
                            dribble(program, path) == program.rows(path))
    print(f"{len(logs)} recordings, {rows} rows of cut logs compared")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
