#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Walking directions of simulated people with a phone carried four ways, turned anyhow.

Errands in an office full of steel; a phone in the hand, at the ear, in a swinging hand, in a
pocket, each mounting and person by its seed. Share of the steps within 15 degrees of where they
led, by RMPCA on the UKF, on the EKF and on the true attitude, as printed in the paper (each step
for itself), by uDirect, and as the mean that phone_walk keeps; the share of wrong ends; and
whether the reported sigma is honest. `--walks N`: of each way to carry it; 2 are quick, but what
steel and iron do to the compass of eight people is no measure of which steps are worse: that is
checked from 10 on.
"""
import argparse
import math
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import program as support  # noqa: E402

POSES = ("hand", "ear", "swing", "pocket")
ROWS = (("ukf", "rmpca"), ("ekf", "rmpca"), ("true", "rmpca"), ("ukf", "mean"), ("ukf", "paper"),
        ("ekf", "paper"), ("ukf", "udirect"))
NEAR_RAD = math.radians(15.0)
# A phone's gyroscope after its own calibration, and no radio. With a compass the gyroscope's noise
# need not cover what a bias does over the whole walk.
SETTINGS = ("phone.mounting=random", "radio.model=off", "imu.gyro_bias_radps=0.001",
            "attitude.gyro_noise_rad_rts=0.006")


def walk(given, pose, seed):
    """{(attitude, method): [(error, sigma, certain), ...]}"""
    done = subprocess.run([given.headings, given.scenario, str(seed), f"phone.pose={pose}",
                           *SETTINGS, *given.settings], capture_output=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr.decode())
    rows = {}
    for line in done.stdout.decode().splitlines()[1:]:
        attitude, method, _, error, sigma, certain = line.split(",")
        rows.setdefault((attitude, method), []).append(
            (float(error), float(sigma), certain == "1"))
    return rows


def share(items, is_one):
    return sum(map(is_one, items)) / len(items)


def near(steps):
    return share(steps, lambda s: abs(s[0]) <= NEAR_RAD)


def within_sigma(steps):
    return share(steps, lambda s: abs(s[0]) <= s[1])


def mean_error(steps):
    return sum(abs(s[0]) for s in steps) / len(steps)


def sharpness(steps):
    """Mean error of the quarter with the largest sigma over that of the one with the smallest."""
    ordered = sorted(steps, key=lambda s: s[1])
    quarter = len(ordered) // 4
    return mean_error(ordered[-quarter:]) / mean_error(ordered[:quarter])


def line(name, steps):
    wrong = share(steps, lambda s: abs(s[0]) > math.pi / 2)
    sure = share(steps, lambda s: abs(s[0]) > math.pi / 2 and s[2])
    print(f"{name:22} {100 * near(steps):6.1f} {100 * wrong:7.1f} {100 * sure:6.1f} "
          f"{math.degrees(mean_error(steps)):6.1f} {100 * within_sigma(steps):8.1f} "
          f"{sharpness(steps):6.2f} {len(steps):6}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--headings", required=True)
    parser.add_argument("--scenario", required=True)
    parser.add_argument("--insole", help="not used")
    parser.add_argument("--walks", type=int, default=2)
    parser.add_argument("--first", type=int, default=101)
    parser.add_argument("settings", nargs="*")
    given = parser.parse_args()
    print(f"{'':22} {'<15deg':>6} {'wrong':>7} {'sure':>6} {'mean':>6} {'<sigma':>8} "
          f"{'sharp':>6} {'steps':>6}")
    total = {}
    for number, pose in enumerate(POSES):
        rows = {}
        for i in range(given.walks):
            seed = given.first + number * given.walks + i
            for key, steps in walk(given, pose, seed).items():
                rows.setdefault(key, []).extend(steps)
                total.setdefault(key, []).extend(steps)
        for key in ROWS:
            line(f"{pose} {key[1]}({key[0]})", rows[key])
    for key in ROWS:
        line(f"all {key[1]}({key[0]})", total[key])
    checks = support.Checks()
    ours, ekf, rival = total[ROWS[0]], total[ROWS[1]], total[("ukf", "udirect")]
    checks.within("RMPCA(UKF) within 15 degrees", near(ours), 0.90, 1.0)
    checks.within("RMPCA(UKF) less RMPCA(EKF)", near(ours) - near(ekf), -0.005, 1.0)
    checks.within("RMPCA(UKF) less uDirect", near(ours) - near(rival), 0.1, 1.0)
    checks.within("errors inside 1 sigma", within_sigma(ours), 0.60, 0.76)
    least = 1.5 if given.walks >= 10 else 0.0
    checks.within("error of the largest sigmas over that of the smallest", sharpness(ours), least,
                  100.0)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
