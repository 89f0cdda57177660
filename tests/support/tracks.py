# SPDX-License-Identifier: MIT
"""Tracks that the program wrote, their errors, and tables of them in a README.

    track = Track(read_track(path))
    errors = errors_of(track, [(t, x, y), ...])
    percentile(errors, 0.9)
"""
import bisect
import math
import sys

MISSING_M = 30.0


def read_lines(path):
    return path.read_text(encoding="ascii").splitlines()


def read_track(path):
    rows = []
    for line in read_lines(path)[1:]:
        cells = line.split(",")
        rows.append((float(cells[0]), float(cells[1]), float(cells[2]), cells[-1]))
    return rows


class Track:
    """Rows by time."""

    def __init__(self, rows):
        self.rows, self.times = rows, [row[0] for row in rows]

    def place(self, t):
        """Interpolated; None where the track has nothing to say."""
        after = bisect.bisect_right(self.times, t)
        if after in (0, len(self.rows)):
            end = self.rows[after and after - 1]
            return end[1:3] if abs(t - end[0]) <= 0.5 else None
        a, b = self.rows[after - 1:after + 1]
        if t == a[0]:
            return a[1:3]
        if b[0] - a[0] > 2.0:
            return None
        leaps = math.dist(a[1:3], b[1:3]) > 20.0 * (b[0] - a[0])
        share = 1.0 if leaps else (t - a[0]) / (b[0] - a[0])
        return a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])

    def state(self, t):
        k = min(bisect.bisect_left(self.times, t), len(self.rows) - 1)
        return self.rows[k][3]


def errors_of(track, truth):
    places = [(track.place(t), (x, y)) for t, x, y in truth]
    return [math.dist(place, true) if place else MISSING_M for place, true in places]


def percentile(values, share):
    ordered = sorted(values)
    place = share * (len(ordered) - 1)
    low = int(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def show_progress(done, count, what):
    if sys.stderr.isatty():
        print(f"\r{done} of {count} replays, {what}\033[K", end="" if done < count else "\n",
              file=sys.stderr, flush=True)
