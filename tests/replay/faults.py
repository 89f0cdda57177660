#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What goes wrong with a sensor, put into real walks: the track stays, the trouble is counted.

Each fault tells by how much the error against the truth may grow over that of the clean log, which
counters of the summary must show it, and how often. Logs that nothing can be made of are refused
with a message that is compared word for word.
"""
import json
import math
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import program as support  # noqa: E402

WALKS = ["llio_36", "vicon_2017-11-22-11-44-47"]
G = 9.80665
DEGREE = math.pi / 180.0


# ---- faults ------------------------------------------------------------------------------


def jittering(samples, rng):
    """Stamps up to 40 % of an interval early or late."""
    dt = (samples[-1][0] - samples[0][0]) / (len(samples) - 1)
    return [[s[0] + rng.uniform(-0.4, 0.4) * dt, *s[1:]] for s in samples]


def repeated(samples, rng):
    return [s for sample in samples
            for s in ([sample, sample] if rng.random() < 0.02 else [sample])]


def backward(samples, rng):
    """Every hundredth sample or so comes once more, 50 ms late."""
    out = []
    for i, sample in enumerate(samples):
        out.append(sample)
        if i > 20 and rng.random() < 0.01:
            out.append(samples[i - 10])
    return out


def dropout(samples, share, seconds):
    """Nothing for so long, from this share of the log on."""
    begin = samples[0][0] + share * (samples[-1][0] - samples[0][0])
    return [s for s in samples if not begin < s[0] < begin + seconds]


def clipped(samples, columns, limit):
    return [[max(-limit, min(limit, v)) if i in columns else v for i, v in enumerate(s)]
            for s in samples]


def spiked(samples, rng, count=40):
    out = [list(s) for s in samples]
    for i in rng.sample(range(100, len(out) - 100), count):
        axis = rng.randrange(1, 7)
        out[i][axis] += rng.choice((-1, 1)) * (400.0 if axis < 4 else 30.0)
    return out


def holey(samples, rng):
    """Two fields in a hundred are empty."""
    return [[s[0], *(None if i == hole else v for i, v in enumerate(s[1:]))]
            for s in samples for hole in [rng.randrange(6) if rng.random() < 0.02 else -1]]


def resampled(samples, rate_hz):
    """Interpolated upwards, averaged downwards, as a good sensor does it."""
    begin, dt, out, k = samples[0][0], 1.0 / rate_hz, [], 0
    fine = 8
    for i in range(int((samples[-1][0] - begin) * rate_hz) - 1):
        total = [0.0] * 6
        for j in range(fine):
            t = begin + (i + (j + 0.5) / fine) * dt
            while samples[k + 1][0] < t:
                k += 1
            a, b = samples[k], samples[k + 1]
            share = (t - a[0]) / (b[0] - a[0])
            total = [s + u + share * (v - u) for s, u, v in zip(total, a[1:], b[1:])]
        out.append([begin + (i + 1) * dt, *(s / fine for s in total)])
    return out


def cut_off_lead_in(samples):
    """Without what comes before the foot has turned faster than 3 rad/s for the first time."""
    first = next(i for i, s in enumerate(samples) if math.hypot(*s[4:7]) > 3.0)
    return samples[first:]


# ---- what must come of them --------------------------------------------------------------


class Bench:
    """One recording and what its clean log gives."""

    def __init__(self, program, checks, data, name):
        self.program, self.checks, self.name = program, checks, name
        self.samples = support.read_imu(data / f"{name}.csv")
        self.truth = self.whole_truth = data / f"{name}.truth.csv"
        self.log = program.folder / "fault.csv"
        self.clean_m = self.replay(self.samples)[0]
        print(f"{name}: clean {self.clean_m:.3f} m")

    def replay(self, samples, *options):
        """(rms against the truth, summary)"""
        support.write_imu(self.log, samples)
        out = self.program.must("replay", self.log, "--truth", self.truth, "--align", "se2",
                                "--json", *options)
        summary = json.loads(out)
        return summary["score"]["rms_m"], summary

    def fault(self, what, samples, grows_m, counts=(), notes=(), options=()):
        """counts: (key, low, high); notes: texts that the summary holds."""
        rms_m, summary = self.replay(samples, *options)
        self.checks.within(f"{self.name}, {what}", rms_m, 0.0, self.clean_m + grows_m, "m")
        told = {**summary["refused"], **summary["repaired"]}
        for key, low, high in counts:
            self.checks.within(f"{self.name}, {what}: {key}", told[key], low, high)
        for note in notes:
            self.checks.that(f"{self.name}, {what}", any(note in n for n in summary["notes"]),
                             f"no note \"{note}\" among {summary['notes']}")

    def refuses(self, what, samples, message, options=()):
        support.write_imu(self.log, samples)
        refuses(self.program, self.checks, f"{self.name}, {what}", message, self.log, *options)


def refuses(program, checks, what, message, log, *options):
    done = program.run("replay", log, "--out", program.folder / "none.csv", *options)
    checks.equal(f"{what}: exit", done.returncode, 1)
    checks.equal(what, done.stderr.decode().replace(f"{program.folder}/", ""), message + "\n")


def stamps(bench, rng):
    s, n = bench.samples, len(bench.samples)
    bench.fault("uneven stamps", jittering(s, rng), 0.03)
    twice = repeated(s, rng)
    bench.fault("repeated stamps", twice, 0.001, [("repeated", len(twice) - n, len(twice) - n)])
    late = backward(s, rng)
    bench.fault("backward stamps", late, 0.001, [("backward", len(late) - n, len(late) - n)])
    bench.fault("2 s lost", dropout(s, 0.5, 2.0), math.inf, [("gaps", 1, 1)],
                ["readings are missing: 1 gap, carried over without them"])
    holes(bench, 2.0, 4.5)
    holes(bench, 0.5, 1.6)
    holes(bench, 0.06, 0.15)


def holes(bench, seconds, grows_m):
    """A hole in a turn costs the direction, and with it metres at the end: the median over many
    holes is held, and the reported sigma must know of each."""
    found = [bench.replay(dropout(bench.samples, 0.2 + 0.06 * k, seconds)) for k in range(10)]
    errors = [rms_m for rms_m, _ in found]
    honest = sum(rms_m <= 3.0 * summary["final"]["sigma_m"] for rms_m, summary in found)
    what = f"{bench.name}, {1000.0 * seconds:.0f} ms lost in ten places"
    bench.checks.within(f"{what}: median", statistics.median(errors), 0.0,
                        bench.clean_m + grows_m, "m")
    bench.checks.within(f"{what}: within 3 sigma", honest, 9, 10)


def readings(bench, rng):
    s = bench.samples
    hits = sum(max(map(abs, x[4:7])) > 5.0 for x in s)
    cut = clipped(s, (4, 5, 6), 5.0)
    bench.fault("gyro clipped at 5 rad/s, told", cut, 1.2, [("clipped", hits, 2 * hits)],
                ["cut off in"], ["--set", "screen.gyro_range_radps=5"])
    bench.fault("gyro clipped at 5 rad/s, unknown", cut, 3.5)
    bench.fault("gyro clipped at 7.5 rad/s, unknown", clipped(s, (4, 5, 6), 7.5), 0.5,
                [("clipped", 50, 2 * hits)], ["cut off in"])
    bench.fault("accelerometer clipped at 4 g", clipped(s, (1, 2, 3), 4 * G), 0.3)
    bench.fault("spikes", spiked(s, rng), 0.03, [("spikes", 36, 40)])
    gone = holey(s, rng)
    count = sum(None in x for x in gone)
    bench.fault("empty fields", gone, 0.05, [("not_finite", count, count)])


def mountings(bench, rng):
    s = bench.samples
    bench.fault("upside down", support.turned(s, [[1, 0, 0], [0, -1, 0], [0, 0, -1]]), 0.001)
    bench.fault("turned", support.turned(s, support.random_rotation(rng)), 0.2)


def rates(bench):
    for rate_hz in (60, 100, 133, 400, 1000):
        bench.fault(f"{rate_hz} Hz", resampled(bench.samples, rate_hz), 0.15)
    bench.fault("20 Hz", resampled(bench.samples, 20), 2.0,
                notes=["20 readings per second are few: 100 and more make the track better"])


def units(bench):
    s = bench.samples
    in_g = [[x[0], *(v / G for v in x[1:4]), *x[4:]] for x in s]
    in_degrees = [[*x[:4], *(v / DEGREE for v in x[4:])] for x in s]
    bench.fault("g, told", in_g, 0.001, options=["--accel-unit", "g"])
    bench.fault("deg/s, told", in_degrees, 0.001, options=["--gyro-unit", "dps"])
    done = bench.program.run("replay", support.write_imu(bench.log, in_g))
    bench.checks.equal(f"{bench.name}, g: exit", done.returncode, 1)
    said = done.stderr.decode()
    bench.checks.that(f"{bench.name}, g", said.startswith(
        "insole: the accelerometer looks like g (median of |a| is ") and said.endswith(
            "): use --accel-unit g\n"), said)
    bench.refuses("deg/s", in_degrees, "insole: the gyroscope looks like degrees per second (it "
                  "keeps beyond 40 rad/s): use --gyro-unit dps")


def begins_in_motion(bench):
    samples = cut_off_lead_in(bench.samples)
    bench.truth = bench.program.folder / "late.truth.csv"
    header, *places = bench.whole_truth.read_text(encoding="ascii").splitlines(keepends=True)
    late = [place for place in places if float(place.split(",")[0]) >= samples[0][0]]
    bench.truth.write_text(header + "".join(late), encoding="ascii")
    bench.fault("begins in motion", samples, 0.7,
                notes=["the log does not begin at rest: 2 s of standing still before the first "
                       "step make the heading and the gyro bias good"])


# ---- a gap on a walk inside a plan --------------------------------------------------------


def lies(track, truth):
    """Points of truth where all is said to be well, and is not: over 2 m and 3 sigma off."""
    rows = {round(row["t"], 1): row for row in track}
    found = 0
    for point in truth:
        row = rows.get(round(point["t"], 1))
        if row and row["state"] == "track":
            sigma_m = math.sqrt(max(0.0, 0.5 * (row["var_x"] + row["var_y"])))
            off_m = math.dist((row["x"], row["y"]), (point["x"], point["y"]))
            found += off_m > max(2.0, 3.0 * sigma_m)
    return found


def gaps_in_buildings(program, checks, data):
    """Who walks on while readings are missing is not told to be where the cloud was."""
    for folder in sorted((data / "buildings").glob("llio_*")):
        samples = support.read_imu(data / "foot" / f"{folder.name}.csv")
        truth = support.read_table(folder / "truth.csv")
        for seconds in (2.0, 8.0, 20.0, 40.0):
            begin_s = samples[0][0] + 0.3 * (samples[-1][0] - samples[0][0])
            if begin_s + seconds + 15.0 > truth[-1]["t"]:
                continue  # too little is left to be found in
            log = support.write_imu(program.folder / "gap.csv", dropout(samples, 0.3, seconds))
            track, _ = program.replay(log, folder / "radio.csv", "--plan", folder / "plan.csv",
                                      "--aps", folder / "aps.csv")
            what = f"{folder.name}, {seconds:.0f} s lost inside a plan"
            checks.within(f"{what}: rows that claim to know", lies(track, truth), 0, 0)
            end = min(track, key=lambda row: abs(row["t"] - truth[-1]["t"]))
            off_m = math.dist((end["x"], end["y"]), (truth[-1]["x"], truth[-1]["y"]))
            checks.within(f"{what}: error at the end", off_m, 0.0, 2.0, "m")


# ---- logs of nothing ---------------------------------------------------------------------


def hopeless(program, checks, source):
    log = program.folder / "log.csv"
    text = source.read_text(encoding="ascii")
    lines = text.splitlines(keepends=True)

    log.write_text("", encoding="ascii")
    expected = "log.csv: no imu record in the session: expected imu,t,ax,ay,az,gx,gy,gz"
    refuses(program, checks, "empty file", expected, log)
    log.write_text(lines[0], encoding="ascii")
    refuses(program, checks, "header only", expected, log)

    half = ",".join(lines[2000].split(",")[:4])[:-2]
    log.write_text("".join(lines[:2000]) + half, encoding="ascii")
    refuses(program, checks, "cut in the middle of a line",
            "log.csv:2001: row has 4 fields: expected 7 as in the header", log)


def never_still(program, checks):
    """A sensor that is shaken without end."""
    rng = support.generator("shake")
    samples = [[0.005 * i, *(60.0 * math.sin(0.23 * i + k) + rng.gauss(0.0, 5.0) for k in range(3)),
                *(9.0 * math.sin(0.19 * i + k) + rng.gauss(0.0, 1.0) for k in range(3))]
               for i in range(4000)]
    track, summary = program.replay(support.write_imu(program.folder / "shake.csv", samples))
    print(f"shaken: {summary['stances']} stances, {summary['strides']} strides, "
          f"state {summary['final']['state']}, notes {summary['notes']}")
    checks.within("shaken: rows that claim to know", sum(r["state"] == "track" for r in track),
                  0, 0)
    checks.that("shaken", any("never stood still" in n for n in summary["notes"]))


def main():
    given = support.arguments(__doc__, "data")
    checks, data = support.Checks(), pathlib.Path(given.data)
    with support.Program(given.insole) as program:
        for name in WALKS:
            bench, rng = Bench(program, checks, data, name), support.generator(name)
            stamps(bench, rng)
            readings(bench, rng)
            mountings(bench, rng)
            rates(bench)
            units(bench)
            begins_in_motion(bench)
        if (data.parent / "buildings").is_dir():
            gaps_in_buildings(program, checks, data.parent)
        hopeless(program, checks, data / f"{WALKS[0]}.csv")
        never_still(program, checks)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
