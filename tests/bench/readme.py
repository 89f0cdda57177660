#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The table of instruction counts in README.md, out of expected.csv.

    readme.py --update README.md     puts it there
    readme.py --check README.md      is it what expected.csv says?
"""
import argparse
import csv
import pathlib
import sys

BEGIN, END = "<!-- bench:begin -->", "<!-- bench:end -->"
TITLES = {
    "insole_screen_push": "screen, a sample",
    "insole_still_bias_take": "rest bias, a sample",
    "insole_zero_velocity_push_next": "adaptive stance detector, a sample",
    "insole_zupt_ekf_predict_9": "filter with 9 states, predict",
    "insole_zupt_ekf_predict_12": "filter with 12 states, predict",
    "insole_zupt_ekf_settle_9":
        "of these with 9 states, the covariance carried on with each eighth sample",
    "insole_zupt_ekf_settle_12": "the same with 12",
    "insole_zupt_ekf_correct_9": "filter with 9 states, zero-velocity correction",
    "insole_zupt_ekf_correct_12": "filter with 12 states, zero-velocity correction",
    "insole_foot_tracker_imu_next": "the whole tracker, a sample of a walk (12 states)",
    "insole_foot_tracker_imu_next_9": "the same with 9 states",
    "insole_foot_tracker_imu_next_9_moving": "of these, a sample without a correction",
    "insole_foot_tracker_imu_next_9_corrected": "of these, a sample with one",
    "insole_particle_filter_1000":
        "particle filter, a particle's stride: 8 access points heard, 1,000 walls",
    "insole_particle_filter_two_order_1000":
        "the same by the paper: inertial position, a range, inside or not",
    "insole_foot_fusion_second":
        "the whole shoe, a second of a walk at 200 Hz: 500 particles, 1,000 walls, 8 access points",
    "insole_foot_fusion_second_9": "the same with 9 states",
    "insole_foot_fusion_second_two_order": "by the paper's second order (12 states)",
    "insole_attitude_push_ekf": "attitude of a phone by Kalman filter, a sample",
    "insole_attitude_push_ukf": "the same unscented",
}
PARTS = {"insole_particle_filter": 500}  # a call works through so many, a row tells of one
SECOND, PROCESSOR_HZ = "insole_foot_fusion_second", 64e6


def table():
    path = pathlib.Path(__file__).with_name("expected.csv")
    with open(path, encoding="ascii") as file:
        rows = {row["name"]: row for row in
                csv.DictReader(line for line in file if not line.startswith("#"))}
    lines = ["| call | x86-64 | Cortex-M4F, mean | largest | cycles |", "|---|---|---|---|---|"]
    for name, title in TITLES.items():
        parts = next((n for start, n in PARTS.items() if name.startswith(start)), 1)
        counts = (round(int(rows[name][c]) / parts) if rows[name][c] else ""
                  for c in ("host", "m4", "m4_max", "m4_cycles"))
        lines.append(f"| {title} | {' | '.join(map(str, counts))} |")
    shares = [100 * int(rows[SECOND + which]["m4_cycles"]) / PROCESSOR_HZ
              for which in ("", "_9", "_two_order")]
    lines += ["", "By the cycles, the whole shoe keeps a processor of "
              f"{PROCESSOR_HZ / 1e6:.0f} MHz busy for {shares[0]:.2f} % of the time,",
              f"{shares[1]:.2f} % with nine states, {shares[2]:.2f} % by the paper's second order."]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--update")
    parser.add_argument("--check")
    given = parser.parse_args()
    path = pathlib.Path(given.update or given.check)
    text = path.read_text(encoding="utf-8")
    head, rest = text.split(BEGIN, 1)
    fresh = f"{head}{BEGIN}\n{table()}\n{END}{rest.split(END, 1)[1]}"
    if given.update:
        path.write_text(fresh, encoding="utf-8")
    elif fresh != text:
        print(f"{path}: the table of instructions is not what expected.csv says:\n{table()}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
