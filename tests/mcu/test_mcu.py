# SPDX-License-Identifier: MIT
"""same_rows.py sees what differs, and feed.py waits.  usage: test_mcu.py HOST STREAM"""
import io
import sys
import unittest
from pathlib import Path

import same_rows
from same_rows import feed

HOST, STREAM = (sys.argv.pop(1), Path(sys.argv.pop(1)).read_bytes())
HALF = same_rows.cut(STREAM, 0.3)


def said(stream):
    return same_rows.at_the_desk(HOST, stream).stdout.decode()


class Streams(unittest.TestCase):
    def test_frames_make_up_the_stream(self):
        frames = list(same_rows.frames(STREAM))
        self.assertEqual(b"".join(frames), STREAM)
        kinds = [chr(frame[1]) for frame in frames]
        self.assertEqual((kinds[0], kinds[-1], kinds.count("Z")), ("H", "E", 1))

    def test_what_is_cut_ends_as_a_stream_does(self):
        frames = list(same_rows.frames(HALF))
        self.assertEqual(frames[-1], list(same_rows.frames(STREAM))[-1])
        self.assertIn(b"Z", [frame[1:2] for frame in frames])
        self.assertLess(len(HALF), 0.31 * len(STREAM))

    def test_a_reset_ends_a_part(self):
        parts = list(feed.parts(STREAM))
        self.assertEqual(len(parts), 2)
        self.assertEqual(b"".join(parts), STREAM)

    def test_nothing_is_sent_before_the_device_is_ready(self):
        device = [sys.executable, "-c", "import sys\n"
                  "print('# ready', flush=True)\nfirst = sys.stdin.buffer.read(3)\n"
                  "print(first.hex(), flush=True)\n"]
        heard = io.BytesIO()
        self.assertEqual(feed.play(HALF, device, heard), 0)
        self.assertEqual(heard.getvalue().split()[-1].decode(), HALF[:3].hex())


class Rows(unittest.TestCase):
    def setUp(self):
        self.reset, self.plain = said(HALF), said(same_rows.without_resets(HALF))

    def test_a_reset_makes_no_difference(self):
        self.assertEqual(same_rows.differences(self.plain, self.reset, 1), [])
        self.assertGreater(len(same_rows.rows(self.plain)), 100)

    def test_resets_are_counted(self):
        self.assertIn("resets", same_rows.differences(self.plain, self.reset, 0)[0])

    def test_a_changed_digit_is_seen(self):
        at = self.reset.rindex("track,") + len("track,")
        digit = "0" if self.reset[at] != "0" else "1"
        changed = self.reset[:at] + digit + self.reset[at + 1:]
        self.assertIn("row", same_rows.differences(self.plain, changed, 1)[0])

    def test_a_lost_frame_is_seen(self):
        frames = list(same_rows.frames(HALF))
        lost = said(b"".join(frames[:300] + frames[301:]))
        what = " ".join(same_rows.differences(self.plain, lost, 1))
        for word in ("row ", "fixes", "crc"):
            self.assertIn(word, what)

    def test_a_changed_byte_is_seen(self):
        frames = list(same_rows.frames(HALF))
        broken = bytearray(frames[150])
        broken[10] ^= 1
        frames[150] = bytes(broken)
        what = " ".join(same_rows.differences(self.plain, said(b"".join(frames)), 1))
        self.assertIn("bad 1", what)

    def test_silence_is_no_agreement(self):
        self.assertTrue(same_rows.differences("", "", 0))

    def test_a_deep_stack_is_seen(self):
        deep = self.reset.replace("stack 0", "stack 99999")
        self.assertIn("stack", same_rows.differences(self.plain, deep, 1)[0])


if __name__ == "__main__":
    unittest.main()
