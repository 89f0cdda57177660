# SPDX-License-Identifier: MIT
"""Gate: what the Cortex-M archive needs from outside.  usage: symbols.py ARCHIVE [ALLOWED.csv]"""
import sys
from pathlib import Path

import arm
import common

ALLOWED = Path(__file__).with_name("arm_symbols.csv")


def check(archive, allowed_csv=ALLOWED):
    allowed = {row["symbol"] for row in arm.table(allowed_csv)}
    return [f"{', '.join(sorted(objects))} needs {symbol}"
            for symbol, objects in sorted(arm.undefined(archive).items()) if symbol not in allowed]


if __name__ == "__main__":
    common.finish("symbols", check(*map(Path, sys.argv[1:])))
