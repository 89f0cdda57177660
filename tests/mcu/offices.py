# SPDX-License-Identifier: MIT
"""A building of 1,018 walls and walks in it.  usage: offices.py FOLDER

Seven wings off one corridor, two rows of 24 rooms in each, every room with its door. Writes
plan.csv, aps.csv, and the scenarios shoe, phone and survey.
"""
import sys
from pathlib import Path

WINGS, ROOMS = 7, 24
ROOM_X, ROOM_Y, CORRIDOR, DOOR = 3.0, 4.0, 2.0, 0.9
WING_Y = 2 * ROOM_Y + CORRIDOR
WIDTH, HEIGHT = CORRIDOR + ROOMS * ROOM_X, WINGS * WING_Y
LICENCE = "# SPDX-License-Identifier: MIT\n"


def wall(*points):
    return "wall,4," + ",".join(f"{value:g}" for point in points for value in point) + "\n"


def row(front, back):
    """Rooms between a corridor and what lies behind them."""
    lines = []
    for room in range(ROOMS):
        left, right = CORRIDOR + room * ROOM_X, CORRIDOR + (room + 1) * ROOM_X
        door = (left + right - DOOR) / 2
        lines += [wall((left, front), (left, back)), wall((left, front), (door, front)),
                  wall((door + DOOR, front), (right, front))]
    return lines


def plan():
    lines = [LICENCE, f"outline,0,0,{WIDTH:g},0,{WIDTH:g},{HEIGHT:g},0,{HEIGHT:g}\n"]
    for wing in range(WINGS):
        south, north = wing * WING_Y, (wing + 1) * WING_Y
        lines += row(south + ROOM_Y, south) + row(north - ROOM_Y, north)
        if wing > 0:
            lines.append(wall((CORRIDOR, south), (WIDTH, south)))
    return "".join(lines)


def aps():
    lines = [LICENCE, "id,x,y,z,p0_dbm,exponent,near_dbm\n"]
    for wing in range(WINGS):
        for third in range(3):
            x = 8 + 25 * third + 6 * (wing % 2)
            lines.append(f"w{wing}-{third},{x},{wing * WING_Y + 5},2.6,-38,2.2,-42\n")
    return "".join(lines)


WALK = """plan,plan.csv
aps,aps.csv

start,1,15,0
walk,18.5,15,1.3
walk,18.5,18,1.2   # into a room
pause,1
walk,18.5,15,1.2
walk,1,15,1.3
walk,1,25,1.3      # to the next wing
walk,12.5,25,1.3

radio.place = body
"""
SURVEY = """plan,plan.csv
aps,aps.csv

start,1,15,0
survey,5

survey.pause_s = 1
survey.directions = 1
imu.rate_hz = 50
radio.place = body
radio.period_s = 0.5
log.imu = none
log.truth = body
log.truth_hz = 5
"""
PHONE = "log.sensor = phone\nlog.truth = body\nlog.truth_hz = 10\nradio.period_s = 0.5\n"


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (("plan.csv", plan()), ("aps.csv", aps()), ("shoe", LICENCE + WALK),
                       ("phone", LICENCE + WALK + PHONE), ("survey", LICENCE + SURVEY)):
        (folder / name).write_text(text)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
