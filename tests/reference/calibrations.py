#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Calibrations find what was put into simulated sensors; what they print makes tracks better."""
import math
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import program as support  # noqa: E402

GYRO_BIAS = (0.012, -0.007, 0.004)
ACCEL_BIAS = (0.11, -0.06, 0.08)
GRAVITY = 9.815
RATE_HZ = 200
SIDES = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
WALK = "start,0,0,0\nwalk,30,0,1.3\nwalk,30,12,1.2\nwalk,0,12,1.4\nwalk,0,0,1.3\n"


def settings(text):
    """{key: value} of config lines."""
    return {key: float(value) for key, value in re.findall(r"^([\w.]+) = (\S+)$", text, re.M)}


def calibrate(program, *arguments):
    return program.must("calibrate", *arguments).decode()


def rest(rng, seconds, up):
    """A sensor that lies with this side up."""
    return [[i / RATE_HZ,
             *(GRAVITY * u + b + rng.gauss(0.0, 0.01) for u, b in zip(up, ACCEL_BIAS)),
             *(b + rng.gauss(0.0, 0.002) for b in GYRO_BIAS)]
            for i in range(seconds * RATE_HZ)]


def check_imu(program, checks):
    rng = support.generator("rests")
    logs = [support.write_imu(program.folder / f"side{i}.csv", rest(rng, 10, side))
            for i, side in enumerate(SIDES)]
    found = settings(calibrate(program, "imu", *logs))
    for axis, gyro, accel in zip("xyz", GYRO_BIAS, ACCEL_BIAS):
        checks.within(f"gyro bias {axis}", found[f"sensor.gyro_bias_{axis}_radps"],
                      gyro - 1e-4, gyro + 1e-4, "rad/s")
        checks.within(f"accelerometer bias {axis}", found[f"sensor.accel_bias_{axis}_mps2"],
                      accel - 2e-3, accel + 2e-3, "m/s^2")
    for key in ("still_bias", "zero_velocity", "zupt_ekf"):
        checks.within(f"{key}.gravity_mps2", found[f"{key}.gravity_mps2"],
                      GRAVITY - 2e-3, GRAVITY + 2e-3, "m/s^2")
    alone = settings(calibrate(program, "imu", logs[4]))
    checks.within("gravity and bias along it, from one pose", alone["zupt_ekf.gravity_mps2"],
                  GRAVITY + ACCEL_BIAS[2] - 3e-3, GRAVITY + ACCEL_BIAS[2] + 3e-3, "m/s^2")


def turning(rng, turns, scale, axis):
    """Rest, whole turns at uneven speed about one axis, rest."""
    seconds, samples = 2.0 * turns, []
    norm = math.hypot(*axis)
    for i in range(int((seconds + 6.0) * RATE_HZ)):
        u = min(max((i / RATE_HZ - 3.0) / seconds, 0.0), 1.0)
        rate = 2.0 * math.pi * turns / seconds * (1.0 - math.cos(2.0 * math.pi * u))
        samples.append([i / RATE_HZ, *(GRAVITY * a / norm for a in axis),
                        *(rate * a / norm / scale + b + rng.gauss(0.0, 0.002)
                          for a, b in zip(axis, GYRO_BIAS))])
    return samples


def check_gyro_scale(program, checks):
    rng = support.generator("turns")
    for turns, scale, axis in ((3, 1.012, (0, 0, 1)), (10, 0.985, (1, 2, -1)),
                               (20, 1.0, (1, 0, 0))):
        log = support.write_imu(program.folder / "turns.csv", turning(rng, turns, scale, axis))
        found = settings(calibrate(program, "gyro-scale", log, "--turns", turns))
        checks.within(f"gyro scale from {turns} turns", found["sensor.gyro_scale"],
                      scale - 5e-4, scale + 5e-4)
    done = program.run("calibrate", "gyro-scale", log, "--turns", 15)
    checks.equal("turns miscounted: exit", done.returncode, 1)
    checks.that("turns miscounted", b"the gyroscope saw 20.0" in done.stderr and
                b"is --turns right?" in done.stderr, done.stderr.decode())


def check_scale_is_used(program, checks):
    """The scale put right turns a walk's track back onto its truth."""
    walk = program.simulate(WALK + "imu.model = matched\n", 3)
    samples = [[s[0], *s[1:4], *(w / 1.03 for w in s[4:])]
               for s in support.read_imu(walk / "log.csv")]
    log, truth = program.folder / "scaled.csv", walk / "truth.csv"
    support.write_imu(log, samples)
    errors = []
    for options in ((), ("--set", "sensor.gyro_scale=1.03")):
        program.replay(log, *options)
        errors.append(program.score(program.folder / "track.csv", truth)["rms_m"])
    checks.within("gyro 3 % low: error", errors[0], 0.3, 10.0, "m")
    checks.within("the same, put right", errors[1], 0.0, 0.5 * errors[0], "m")


def check_stride(program, checks):
    walk = program.simulate(WALK, 5)
    text = calibrate(program, "stride", walk)
    config = program.folder / "stride.conf"
    config.write_text(text, encoding="ascii")
    k = settings(text)["stride.k_stride"]
    truth, found = walk / "truth.csv", {}
    for name, options in (("default", ()), ("calibrated", ("--config", config)),
                          ("half", ("--set", f"stride.k_stride={0.5 * k:.5f}"))):
        rows, _ = program.replay(walk, "--method", "pdr", *options)
        found[name] = (way(rows), program.score(program.folder / "track.csv", truth)["rms_m"])
    true_m = way(support.read_table(truth)[::50])
    print(f"K = {k:.4f}; way {true_m:.1f} m, by pdr "
          + ", ".join(f"{name} {m:.1f} m (rms {rms:.2f} m)" for name, (m, rms) in found.items()))
    checks.within("way by pdr with its K over the true one", found["calibrated"][0] / true_m,
                  0.97, 1.03)
    checks.within("half of K makes half the way", found["half"][0] / found["calibrated"][0],
                  0.48, 0.52)
    checks.that("K makes the error smaller than the default's, or as small",
                found["calibrated"][1] <= found["default"][1] + 0.1)
    checks.within("error with its K", found["calibrated"][1], 0.0, 1.5, "m")


def way(rows):
    """Length of what the rows show, in steps of a second: of the walker's way, not the foot's."""
    places = [rows[0]]
    for row in rows:
        if row["t"] - places[-1]["t"] >= 1.0:
            places.append(row)
    return sum(math.hypot(b["x"] - a["x"], b["y"] - a["y"]) for a, b in zip(places, places[1:]))


def main():
    given = support.arguments(__doc__)
    checks = support.Checks()
    with support.Program(given.insole) as program:
        check_imu(program, checks)
        check_gyro_scale(program, checks)
        check_scale_is_used(program, checks)
        check_stride(program, checks)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
