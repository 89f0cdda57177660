# SPDX-License-Identifier: MIT
"""Gate: what the images of devices took from the tool chain.  usage: images.py BUILD...

Every symbol of an image stands in the library, in the image's own objects, or in
image_symbols.csv: no heap, no stdio, no double arithmetic has come in by another door.
"""
import sys
from pathlib import Path

import arm
import common

ALLOWED = Path(__file__).with_name("image_symbols.csv")


def defined(*files):
    """Names of all symbols that are defined in objects, archives or images."""
    lines = arm.tool("nm", "--defined-only", *files).splitlines()
    return {line.split()[-1] for line in lines if len(line.split()) == 3}


def check_image(image, own_files, allowed):
    strangers = defined(image) - defined(*own_files) - allowed
    return [f"{image.name}: {name} comes from outside" for name in sorted(strangers)
            if not name.startswith("$")]


def check(build, allowed_csv=ALLOWED):
    allowed = {row["symbol"] for row in arm.table(allowed_csv)}
    problems, images = [], sorted(build.glob("bin/shoe_*")) + sorted(build.glob("bin/phone_*"))
    for image in images:
        objects = (build / "tools/firmware/CMakeFiles" / f"{image.name}.dir").rglob("*.obj")
        own_files = [build / "src/libinsole.a", *sorted(objects)]
        problems += check_image(image, own_files, allowed)
    return problems if images else [f"{build.name}: no images of devices"]


if __name__ == "__main__":
    found = [problem for build in sys.argv[1:] for problem in check(Path(build))]
    common.finish("images", found)
