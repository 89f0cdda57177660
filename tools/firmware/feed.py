# SPDX-License-Identifier: MIT
"""Plays a stream to a device.  usage: feed.py STREAM COMMAND...

STREAM is what `insole stream` has made. The command emulates the device: its standard input is the
device's line, its standard output what the device says, which is passed on. Nothing is sent before
the device has said that it is ready, and after a reset nothing before it has said so again.
"""
import io
import subprocess
import sys
from pathlib import Path

MARK, FRAMING = 0xA5, 4
READY = b"# ready"


def parts(stream):
    """The stream, cut after each frame that makes the device reset."""
    begin = at = 0
    while at < len(stream):
        if stream[at] != MARK:
            raise SystemExit(f"feed.py: byte {at} of the stream is no mark")
        kind, count = stream[at + 1], stream[at + 2]
        at += count + FRAMING
        if kind == ord("Z"):
            yield stream[begin:at]
            begin = at
    yield stream[begin:]


def send(device, data):
    """A device that has ended hears nothing more; its exit code tells."""
    try:
        device.stdin.write(data)
        device.stdin.flush()
    except BrokenPipeError:
        pass


def play(stream, command, out):
    """@return exit code of the command"""
    waiting = parts(stream)
    device = subprocess.Popen(command, bufsize=0, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    with io.BufferedReader(device.stdout) as lines:
        for line in lines:
            out.write(line)
            if line.startswith(READY):
                send(device, next(waiting, b""))
    out.flush()
    device.stdin.close()
    return device.wait()


if __name__ == "__main__":
    sys.exit(play(Path(sys.argv[1]).read_bytes(), sys.argv[2:], sys.stdout.buffer))
