# SPDX-License-Identifier: MIT
"""Counts instructions per call and compares them with expected.csv and limits.csv.

usage: bench.py host BENCH              counted by callgrind
       bench.py m4 QEMU... IMAGE        counted by the emulated board
       bench.py same_bits BENCH QEMU... IMAGE
       bench.py renew BENCH QEMU... IMAGE    writes expected.csv; in a build tree this is
                                             `cmake --build build --target bench_expected`;
                                             cycles are estimated by cycles.py for some cases

Exit 77: what it takes is not installed, or another compiler made the code.
"""
import csv
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import cycles

EXPECTED = Path(__file__).with_name("expected.csv")
LIMITS = Path(__file__).with_name("limits.csv")
TOLERANCE = 0.03
SKIPPED = 77
COLUMNS = ("host", "m4", "m4_max")
CYCLES = "m4_cycles"
ESTIMATED = ("insole_screen_push", "insole_still_bias_take", "insole_zero_velocity_push_next",
             "insole_zupt_ekf_predict_9", "insole_zupt_ekf_predict_12",
             "insole_zupt_ekf_settle_9", "insole_zupt_ekf_settle_12",
             "insole_zupt_ekf_correct_9", "insole_zupt_ekf_correct_12",
             "insole_foot_tracker_imu_next", "insole_foot_tracker_imu_next_9",
             "insole_foot_tracker_imu_next_9_moving", "insole_foot_tracker_imu_next_9_corrected",
             "insole_foot_fusion_second", "insole_foot_fusion_second_9",
             "insole_foot_fusion_second_two_order",
             "insole_particle_filter_1000", "insole_particle_filter_two_order_1000",
             "insole_attitude_push_ekf", "insole_attitude_push_ukf")


class Skip(Exception):
    """Not a failure: it cannot be measured here."""


def output_of(command):
    if not shutil.which(command[0]):
        raise Skip(f"{command[0]} is not installed")
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE,
                          stdin=subprocess.DEVNULL).stdout


def read_report(text):
    """(compiler, {case: (mean, max, crc)}) of what the bench printed."""
    lines = [line.split(",") for line in text.splitlines()]
    if not lines or lines[0][0] != "compiler":
        raise ValueError(f"not a report of the bench: {text[:200]!r}")
    return lines[0][1], {name: (int(mean), int(largest), crc)
                         for name, _, mean, largest, crc in lines[1:]}


def read_callgrind(text):
    """{case: instructions per call} of the calls to functions named call_<case>."""
    calls, cost = {}, {}
    for name, count, inclusive in re.findall(
            r"^cfn=call_(insole_\w+)\ncalls=(\d+) .*\n\S+ (\d+)$", text, re.M):
        calls[name] = calls.get(name, 0) + int(count)
        cost[name] = cost.get(name, 0) + int(inclusive)
    return {name: round(cost[name] / calls[name]) for name in calls}


def measure_host(bench):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder, "out")
        compiler, _ = read_report(output_of(
            ["valgrind", "--quiet", "--tool=callgrind", "--compress-strings=no",
             "--compress-pos=no", f"--callgrind-out-file={out}", bench]))
        return compiler, {name: {"host": count}
                          for name, count in read_callgrind(out.read_text()).items()}


def measure_m4(command):
    compiler, cases = read_report(output_of(command))
    return compiler, {name: {"m4": mean, "m4_max": largest}
                      for name, (mean, largest, _) in cases.items()}


def rows_of(text):
    return csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))


def read_expected(text):
    """({machine: compiler}, {case: {column: count}})"""
    compilers = dict(re.findall(r"^# (\w+): compiler (.+)$", text, re.M))
    return compilers, {row["name"]: {c: int(row[c]) for c in COLUMNS + (CYCLES,) if row.get(c)}
                       for row in rows_of(text)}


def write_expected(compilers, cases):
    lines = ["# SPDX-License-Identifier: MIT",
             "# Instructions per call: mean on the host (x86-64), mean and largest on a Cortex-M4F;",
             "# of some their cycles there, as cycles.py estimates them."]
    lines += [f"# {machine}: compiler {version}" for machine, version in compilers.items()]
    lines.append(",".join(("name",) + COLUMNS + (CYCLES,)))
    lines += [",".join([name] + [str(counts.get(c, "")) for c in COLUMNS + (CYCLES,)])
              for name, counts in cases.items()]
    return "\n".join(lines) + "\n"


def compare(measured, expected):
    """(problems, table); a case without expectation, or the other way round, is a problem."""
    problems = [f"{name}: expected but not measured" for name in expected if name not in measured]
    table = [f"{'instructions per call':36} {'measured':>9} {'expected':>9}"]
    for name, counts in sorted(measured.items()):
        if name not in expected:
            problems.append(f"{name}: nothing is expected; write expected.csv anew")
            continue
        for column, count in counts.items():
            wanted = expected[name][column]
            table.append(f"{name + ' ' + column:36} {count:9} {wanted:9}")
            if abs(count - wanted) > max(TOLERANCE * wanted, 1):
                problems.append(f"{name}: {count} instructions on {column}, expected {wanted} "
                                f"within {TOLERANCE:.0%}")
    return problems, table


def over_limit(machine, measured, limits):
    """Problems of the counts with the rows of limits.csv, whichever compiler made the code."""
    problems = []
    for row in (row for row in limits if row["machine"] == machine):
        name, of, limit = row["name"], row["of"], row["limit"]
        missing = [case for case in (name, of) if not case.isdigit() and case not in measured]
        problems += [f"{case}: has a limit but is not measured" for case in missing]
        if not missing:
            times = measured[name][machine] / (int(of) if of.isdigit() else measured[of][machine])
            if times > float(limit):
                problems.append(f"{name}: {times:.5g} times {of} on {machine}, limit {limit}")
    return problems


def check_counts(machine, compiler, measured):
    compilers, expected = read_expected(EXPECTED.read_text())
    problems, table = compare(measured, expected)
    beyond = over_limit(machine, measured, rows_of(LIMITS.read_text()))
    print("\n".join(table))
    if compiler != compilers[machine] and not beyond:
        raise Skip(f"expected.csv is for compiler {compilers[machine]}, this is {compiler}")
    return problems + beyond


def differing(host, m4):
    """Cases whose results are not the same bits on both machines."""
    return [f"{name}: results differ, crc {host.get(name)} on the host, {m4.get(name)} on the chip"
            for name in sorted(set(host) | set(m4)) if host.get(name) != m4.get(name)]


def check_bits(bench, emulated):
    host, m4 = ({name: crc for name, (_, _, crc) in read_report(output_of(command))[1].items()}
                for command in ([bench], emulated))
    print(f"{len(host)} cases compared")
    return differing(host, m4)


def renew(bench, emulated):
    host_compiler, host = measure_host(bench)
    m4_compiler, m4 = measure_m4(emulated)
    cases = {name: {**host[name], **counts} for name, counts in m4.items()}
    for name in (name for name in ESTIMATED if name in cases):
        took, ran, _ = cycles.measure("arm-none-eabi-objdump", name, emulated)
        cases[name][CYCLES] = round(cases[name]["m4"] * took / ran)
    EXPECTED.write_text(write_expected({"host": host_compiler, "m4": m4_compiler}, cases))
    return []


def run(action, *arguments):
    if action in ("-h", "--help"):
        print(__doc__.strip())
        sys.exit(0)
    if action == "host":
        return check_counts("host", *measure_host(arguments[0]))
    if action == "m4":
        return check_counts("m4", *measure_m4(list(arguments)))
    work = {"same_bits": check_bits, "renew": renew}[action]
    return work(arguments[0], list(arguments[1:]))


if __name__ == "__main__":
    try:
        found = run(*(sys.argv[1:] or ["--help"]))
    except Skip as why:
        print(f"SKIPPED: {why}")
        sys.exit(SKIPPED)
    print("\n".join(found) if found else "bench: fine")
    sys.exit(1 if found else 0)
