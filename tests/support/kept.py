# SPDX-License-Identifier: MIT
"""What scripts share that replay recordings: their options, the figures that are kept of them, and
tables in README.md.

    given = kept.recordings_parser(__doc__, seeds=20, rows=ROWS).parse_args()
    if kept.lacks(given.data / "buildings"):
        return kept.SKIPPED
"""
import argparse
import csv
import pathlib

SKIPPED = 77


def recordings_parser(doc, seeds=None, rows=None):
    """With `seeds` (how many, unless told) that of a table whose figures are kept."""
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("--insole", required=True)
    parser.add_argument("--data", required=True, type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=2)
    if rows is not None:
        parser.add_argument("--only", help="rows: " + ",".join(rows))
    if seeds is not None:
        parser.add_argument("--seeds", type=int, default=seeds)
        parser.add_argument("--update", type=pathlib.Path, help="put the table in this file")
        parser.add_argument("--expected", type=pathlib.Path, help="compare with this file")
        parser.add_argument("--expect", action="store_true", help="write that file")
    return parser


def lacks(folder):
    """True, and says so, where there are no recordings."""
    if not folder.is_dir():
        print(f"SKIPPED: there are no recordings at {folder}")
    return not folder.is_dir()


def read_rows(path):
    """Of a CSV file with comments."""
    with open(path, encoding="ascii") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def write_means(file, script, name, rows):
    """rows: (name, mean in m, tolerance in m). Equal programs give equal bits: what is allowed is
    for changes that are meant to be small."""
    file.write(f"# SPDX-License-Identifier: MIT\n# Made by {script} --expect.\n")
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow([name, "mean_m", "tolerance_m"])
    for key, mean_m, tolerance_m in rows:
        writer.writerow([key, f"{mean_m:.4f}", f"{tolerance_m:.4f}"])


def check_means(checks, name, rows, mean_of):
    """Of each row that was kept, against what there is now."""
    for row in rows:
        kept_m, tolerance_m = float(row["mean_m"]), float(row["tolerance_m"])
        checks.within(f"{row[name]}: mean error", mean_of(row[name]), kept_m - tolerance_m,
                      kept_m + tolerance_m, "m")


def put_in(text, begin, end, content):
    """The text with what stands between two marks replaced."""
    head, rest = text.split(begin, 1)
    return f"{head}{begin}\n{content}\n{end}{rest.split(end, 1)[1]}"


def update(path, begin, end, content):
    path.write_text(put_in(path.read_text(encoding="utf-8"), begin, end, content),
                    encoding="utf-8")
