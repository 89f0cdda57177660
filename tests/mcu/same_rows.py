# SPDX-License-Identifier: MIT
"""An image under QEMU says what the same C says at the desk, byte for byte.

The desk is given the walk without a reset, the device the one with a reset in its middle: only the
lines that begin with # may tell the difference, and the last of them, whose CRC is that of all
fixes, must agree in all but the resets and the stack.
"""
import argparse
import io
import shutil
import subprocess
import sys
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools" / "firmware"))
import feed  # noqa: E402

QEMU = "qemu-system-arm"
SKIPPED = 77
STACK_LIMIT = 2560


def frames(stream):
    at = 0
    while at < len(stream):
        size = stream[at + 2] + feed.FRAMING
        yield stream[at:at + size]
        at += size


def cut(stream, share):
    """The first part of a stream, as a stream of its own."""
    end = bytes([ord("E"), 0])
    kept, size = [], 0
    for frame in frames(stream):
        if size + len(frame) > share * len(stream):
            break
        kept.append(frame)
        size += len(frame)
    return b"".join(kept) + bytes([feed.MARK]) + end + bytes([zlib.crc32(end) & 0xFF])


def without_resets(stream):
    return b"".join(frame for frame in frames(stream) if frame[1] != ord("Z"))


def at_the_desk(host, stream):
    return subprocess.run([host], input=stream, stdout=subprocess.PIPE, check=False)


def command_of(options):
    command = [QEMU, "-machine", options.machine, "-display", "none", "-monitor", "none",
               "-kernel", options.image]
    if options.semihost:
        return command + ["-serial", "none", "-chardev", "stdio,id=out", "-semihosting-config",
                          f"enable=on,target=native,chardev=out,arg=image,arg={options.stream}"]
    return command + ["-semihosting-config", "enable=on,target=native", "-chardev",
                      "stdio,id=line,signal=off", "-serial", "chardev:line"]


def on_the_board(options, stream):
    """@return exit code and what the device said"""
    if options.semihost:
        done = subprocess.run(command_of(options), stdin=subprocess.DEVNULL, check=False,
                              stdout=subprocess.PIPE)
        return done.returncode, done.stdout
    said = io.BytesIO()
    return feed.play(stream, command_of(options), said), said.getvalue()


def rows(text):
    return [line for line in text.splitlines() if line and not line.startswith("#")]


def summary(text):
    """{what: value} of the last line."""
    lines = [line.split()[1:] for line in text.splitlines() if line.startswith("# fixes ")]
    return dict(zip(lines[-1][::2], lines[-1][1::2])) if lines else {}


def differences(desk, board, resets):
    """What is wrong with what the board said."""
    problems = []
    for number, (here, there) in enumerate(zip(rows(desk), rows(board)), 1):
        if here != there:
            problems.append(f"row {number}: {there}, at the desk {here}")
            break
    if len(rows(desk)) != len(rows(board)):
        problems.append(f"{len(rows(board))} rows, at the desk {len(rows(desk))}")
    here, there = summary(desk), summary(board)
    if not here or int(here["fixes"]) == 0:
        problems.append("the desk made no fixes: nothing is compared")
    for what in ("fixes", "rows", "crc", "bad"):
        if here.get(what) != there.get(what):
            problems.append(f"{what} {there.get(what)}, at the desk {here.get(what)}")
    if int(there.get("resets", -1)) != resets:
        problems.append(f"resets {there.get('resets')}, expected {resets}")
    if int(there.get("stack", 0)) > STACK_LIMIT:
        problems.append(f"stack {there['stack']} bytes, at most {STACK_LIMIT}")
    return problems


def main():
    parser = argparse.ArgumentParser()
    for name in ("machine", "image", "host", "plain", "stream"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--share", type=float, default=1.0)
    parser.add_argument("--semihost", action="store_true")
    options = parser.parse_args()
    if shutil.which(QEMU) is None:
        print(f"SKIPPED: {QEMU} is not installed, nothing is run on a board")
        return SKIPPED
    stream, plain = Path(options.stream).read_bytes(), Path(options.plain).read_bytes()
    if options.share < 1.0: # frames are not cut at the same places when a reset parts them
        stream = cut(stream, options.share)
        plain = without_resets(stream)
    desk = at_the_desk(options.host, plain)
    code, said = on_the_board(options, stream)
    board = said.decode()
    resets = sum(frame[1] == ord("Z") for frame in frames(stream))
    problems = differences(desk.stdout.decode(), board, resets)
    if code != 0 or desk.returncode != 0:
        problems.append(f"exit code {code}, at the desk {desk.returncode}")
    print(*problems, board.splitlines()[-1] if board else "the board said nothing", sep="\n")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
