# SPDX-License-Identifier: MIT
"""The comparison of counts must see what is off, and nothing else."""
import unittest

import bench
import cycles

REPORT = "compiler,12.2.0\ninsole_sin,256,40,55,abc123\n"
CALLGRIND = """fn=run_case
10 5
cfn=call_insole_sin
calls=200 0
42 8000
cfn=other
calls=1 0
43 7
fn=main
cfn=call_init
calls=1 0
49 500
cfn=call_insole_sin
calls=56 0
50 2240
fn=call_insole_sin
1 256
"""


class Reading(unittest.TestCase):
    def test_report(self):
        self.assertEqual(bench.read_report(REPORT),
                         ("12.2.0", {"insole_sin": (40, 55, "abc123")}))

    def test_what_is_no_report_is_refused(self):
        for text in ("", "fault\n"):
            with self.assertRaises(ValueError):
                bench.read_report(text)

    def test_callgrind_costs_add_up_over_callers(self):
        self.assertEqual(bench.read_callgrind(CALLGRIND), {"insole_sin": 40})

    def test_expectations_survive_writing_and_reading(self):
        compilers = {"host": "12.2.0", "m4": "12.2.1 20221205"}
        cases = {"a": {"host": 1, "m4": 2, "m4_max": 3},
                 "b": {"host": 1, "m4": 2, "m4_max": 3, "m4_cycles": 4}}
        text = bench.write_expected(compilers, cases)
        self.assertEqual(bench.read_expected(text), (compilers, cases))


LISTING = """
00000100 <call_f>:
     100:\tee77 7a87 \tvadd.f32\ts15, s15, s14
     104:\teee7 7a27 \tvmul.f32\ts15, s14, s15
     108:\teec7 7a26 \tvdiv.f32\ts15, s14, s13
     10c:\ted97 7a00 \tvldr\ts14, [r7]
     110:\tb530      \tpush\t{r4, r5, lr}
     112:\te001      \tb.n\t118 <call_f+0x18>
     114:\tbf00      \tnop
     118:\tbd30      \tpop\t{r4, r5, pc}

00000200 <ticks_of>:
     200:\tbf00      \tnop
"""


class Cycles(unittest.TestCase):
    code, names = cycles.read_code(LISTING)

    def cost(self, at, then):
        after = {0x100: 0x104, 0x104: 0x108, 0x108: 0x10C, 0x10C: 0x110, 0x110: 0x112,
                 0x112: 0x114, 0x118: 0x200}
        return cycles.cycles_of(self.code, after, (at, then))

    def test_a_result_used_at_once_is_waited_for(self):
        self.assertEqual(self.cost(0x100, 0x104), 2)
        self.assertEqual(self.cost(0x104, 0x108), 1)

    def test_what_takes_longer(self):
        self.assertEqual(self.cost(0x108, 0x10C), 14)
        self.assertEqual(self.cost(0x10C, 0x110), 2)
        self.assertEqual(self.cost(0x110, 0x112), 4)

    def test_branches_cost_when_they_are_taken(self):
        self.assertEqual(self.cost(0x112, 0x118), 3)
        self.assertEqual(self.cost(0x112, 0x114), 1)

    def test_a_case_is_counted_from_its_call_to_its_return(self):
        lines = [b"Trace 0: 0x7f [0/%08x/0/0] f" % at
                 for at in (0x300, 0x100, 0x104, 0x200, 0x104, 0x100, 0x118, 0x200)]
        calls, pairs = cycles.counted(lines, 0x100, {0x200})
        self.assertEqual(calls, 2)
        self.assertEqual(dict(pairs), {(0x100, 0x104): 1, (0x104, 0x200): 1, (0x100, 0x118): 1,
                                       (0x118, 0x200): 1})


class Comparing(unittest.TestCase):
    expected = {"f": {"host": 1000, "m4": 2000, "m4_max": 3000}}

    def problems(self, measured):
        return bench.compare(measured, self.expected)[0]

    def test_within_three_percent_passes(self):
        self.assertEqual(self.problems({"f": {"host": 1030}}), [])
        self.assertEqual(self.problems({"f": {"m4": 1940, "m4_max": 3090}}), [])

    def test_more_and_less_are_found(self):
        for count in (1031, 969):
            self.assertEqual(len(self.problems({"f": {"host": count}})), 1)

    def test_the_largest_count_is_held_too(self):
        self.assertEqual(len(self.problems({"f": {"m4": 2000, "m4_max": 3091}})), 1)

    def test_cases_come_and_go_only_with_their_expectation(self):
        self.assertEqual(len(self.problems({"f": {"host": 1000}, "g": {"host": 1}})), 1)
        self.assertEqual(len(self.problems({})), 1)

    def test_other_bits_are_found(self):
        self.assertEqual(bench.differing({"f": "1"}, {"f": "1"}), [])
        self.assertEqual(len(bench.differing({"f": "1"}, {"f": "2"})), 1)
        self.assertEqual(len(bench.differing({"f": "1"}, {})), 1)


class Limits(unittest.TestCase):
    measured = {"small": {"host": 1000, "m4": 900}, "large": {"host": 1500, "m4": 1351}}

    def problems(self, *row):
        limit = dict(zip(("machine", "name", "of", "limit"), row))
        return bench.over_limit(row[0], self.measured, [limit])

    def test_parts_of_a_call(self):
        self.assertEqual(self.problems("host", "small", "500", "2"), [])
        self.assertEqual(len(self.problems("host", "small", "500", "1.99")), 1)

    def test_growth_from_case_to_case(self):
        self.assertEqual(self.problems("host", "large", "small", "1.5"), [])
        self.assertEqual(len(self.problems("m4", "large", "small", "1.5")), 1)

    def test_a_limit_holds_on_its_machine(self):
        limit = {"machine": "m4", "name": "large", "of": "small", "limit": "1.5"}
        self.assertEqual(bench.over_limit("host", self.measured, [limit]), [])

    def test_what_has_a_limit_is_measured(self):
        self.assertEqual(len(self.problems("host", "gone", "small", "2")), 1)
        self.assertEqual(len(self.problems("host", "small", "gone", "2")), 1)

    def test_the_limits_kept_are_of_cases_that_are_known(self):
        _, expected = bench.read_expected(bench.EXPECTED.read_text())
        limits = list(bench.rows_of(bench.LIMITS.read_text()))
        self.assertGreater(len(limits), 0)
        for machine in ("host", "m4"):
            self.assertEqual(bench.over_limit(machine, expected, limits), [])


if __name__ == "__main__":
    unittest.main()
