# SPDX-License-Identifier: MIT
"""Each gate must refuse what it is there to refuse, and let pass what is right."""
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import arm
import common
import images
import includes
import ledger
import paths
import sizes
import stack
import style
import symbols
import tree

HERE = Path(__file__).parent
ARM_FLAGS = ["-std=c99", "-O2", "-fcallgraph-info=su,da", *sizes.CPU]


class Scratch(unittest.TestCase):
    """A test with a folder of its own that files are written into."""

    def setUp(self):
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def assert_refused(self, problems, *needles):
        """Exactly one problem, which tells all the needles."""
        self.assertEqual(len(problems), 1, problems)
        for needle in needles:
            self.assertIn(needle, problems[0])


class ReadingC(unittest.TestCase):
    def names(self, text):
        return [f.name for f in common.functions(text)]

    def test_definitions_are_found_and_nothing_else(self):
        text = """typedef struct { int a; } t;
            int declared(int a);
            static const int table[2] = {1, 2};
            static inline t first(int a)
            { if (a) { return (t){1}; } return (t){0}; }
            enum { A };
            __attribute__((noreturn)) void second(int (*call)(int)) { for (;;) { call(1); } }
            """
        self.assertEqual(self.names(text), ["first", "second"])

    def test_strings_comments_and_macros_do_not_confuse(self):
        text = '#define M(a) \\\n  void a(void) {\nint f(void) /* { */\n{ return "}{"[0] == \'{\'; }\n'
        self.assertEqual(self.names(text + "int g(void) { return 0; } // {\n"), ["f", "g"])

    def test_linkage_blocks_are_looked_through(self):
        text = '#ifdef __cplusplus\nextern "C" {\n#endif\nint f(void) { return 1; }\n'
        self.assertEqual(self.names(text + "#ifdef __cplusplus\n}\n#endif\n"), ["f"])

    def test_lines_of_a_function_start_with_its_comment(self):
        function = common.functions("int a;\n/** Does\n *  it. */\nint f(void)\n{\n}\n")[0]
        self.assertEqual((function.first, function.body_first, function.last), (2, 4, 6))

    def test_code_lines_leave_out_comments_and_blanks(self):
        self.assertEqual(common.code_lines("int a; /* x\n y */\n\n// z\nint b;\n"), 2)


class Includes(Scratch):
    def check(self, name, text):
        self.write(name, text)
        return includes.check(self.root)

    def test_right_directions_pass(self):
        self.write("src/move/walk.c", '#include <string.h>\n#include "insole/base/vec3.h"\n')
        self.write("include/insole/fuse/f.h", '#include "insole/place/plan.h"\n')
        self.write("include/insole/base/real.h", "#include <math.h>\n")
        self.write("include/insole/insole.h", '#include "insole/fuse/f.h"\n')
        self.write("tools/sim/walk.c", '#include <stdio.h>\n#include "insole/base/rng.h"\n')
        self.assertEqual(includes.check(self.root), [])

    def test_middle_rooms_do_not_know_each_other(self):
        self.assert_refused(self.check("src/move/a.c", '#include "insole/sense/step.h"\n'),
                            "move may not include")

    def test_base_knows_nobody(self):
        self.assert_refused(self.check("include/insole/base/a.h", '#  include "insole/move/b.h"\n'),
                            "base may not include")

    def test_library_does_not_include_the_umbrella(self):
        self.assert_refused(self.check("src/track/a.c", '#include "insole/insole.h"\n'), "track")

    def test_operating_system_stays_outside(self):
        for header in ("stdio.h", "stdlib.h", "time.h", "locale.h", "math.h"):
            self.assert_refused(self.check("src/base/a.c", f"#include <{header}>\n"), header)

    def test_simulator_uses_base_alone(self):
        self.assert_refused(self.check("tools/sim/a.h", '#include "insole/move/zupt_ekf.h"\n'),
                            "base alone")

    def test_rings_are_found(self):
        self.write("include/insole/move/a.h", '#include "insole/move/b.h"\n')
        self.assert_refused(self.check("src/move/b.c", '#include "insole/move/a.h"\n'),
                            "move/a -> move/b -> move/a")

    def test_commented_includes_do_not_count(self):
        self.assertEqual(self.check("src/base/a.c", "/*\n#include <stdio.h>\n*/\n"), [])

    def test_no_file_outside_a_room(self):
        self.assert_refused(self.check("src/other/a.c", ""), "not in one of the rooms")


class Ledger(Scratch):
    def setUp(self):
        super().setUp()
        self.rows = {1: "theory: not computed", 2: "move/ekf.c:gain", 3: "not yet"}
        self.code = "/* [TwoOrder (2)] */\nint gain(void)\n{\n    return 1;\n}\n"

    def check(self, code=None, heading="## TwoOrder (3)"):
        rows = "".join(f"| [TwoOrder ({n})] | what | {where} |\n" for n, where in self.rows.items())
        self.write("src/EQUATIONS.md", f"{heading}\n\n{rows}")
        self.write("src/move/ekf.c", self.code if code is None else code)
        return ledger.check(self.root)

    def test_matching_table_and_code_pass(self):
        self.assertEqual(self.check(), [])

    def test_a_tag_needs_a_row(self):
        self.assert_refused(self.check(self.code + "/* [TwoOrder (4)] */\n"), "(4)]", "no row")

    def test_a_row_must_name_who_carries_the_tag(self):
        other = "int other(void)\n{\n    return 2; /* [TwoOrder (2)] */\n}\n"
        self.assert_refused(self.check(self.code + other), "does not name move/ekf.c:other")

    def test_a_computed_equation_is_not_yet_in_no_row(self):
        self.rows[2] = "not yet"
        self.assert_refused(self.check(), "does not name move/ekf.c:gain")

    def test_a_computed_row_needs_its_tag(self):
        self.assert_refused(self.check(self.code.replace("[TwoOrder (2)]", "")),
                            "does not carry the tag")

    def test_a_row_names_what_exists(self):
        self.rows[2] = "move/ekf.c:gain, move/ekf.c:gone"
        self.assert_refused(self.check(), "there is no move/ekf.c:gone")

    def test_a_missing_row_is_found(self):
        del self.rows[1]
        self.assert_refused(self.check(), "(1)] has no row")

    def test_a_row_beyond_the_paper_is_found(self):
        self.rows[4] = "not yet"
        self.assert_refused(self.check(), "(4)] is beyond the paper")

    def test_two_rows_for_one_equation_are_found(self):
        problems = self.check(heading="| [TwoOrder (3)] | twice | not yet |\n## TwoOrder (3)")
        self.assert_refused(problems, "(3)] has two rows")

    def test_ranges_and_lists_expand(self):
        expanded = ledger.equations("[TwoOrder 3.1, (12)-(14), (20), table 1]")
        self.assertEqual({n for _, n in expanded}, {12, 13, 14, 20})

    def test_a_range_in_the_code_needs_all_its_rows(self):
        problems = self.check(self.code.replace("(2)]", "(1)-(3)]"))
        self.assertEqual(len(problems), 2, problems)

    def test_a_declaration_may_cite_without_computing(self):
        self.write("include/insole/move/ekf.h", "/** By [TwoOrder (3)]. */\nint gain(void);\n")
        self.assertEqual(self.check(), [])

    def test_an_inline_function_computes(self):
        self.write("include/insole/move/ekf.h",
                   "/** [TwoOrder (3)] */\nstatic inline int f(void)\n{\n    return 0;\n}\n")
        self.assert_refused(self.check(), "does not name move/ekf.h:f")
        self.rows[3] = "move/ekf.h:f"
        self.assertEqual(self.check(), [])


class Style(Scratch):
    def check(self, text, name="src/base/a.c"):
        self.write(name, text)
        return style.check(self.root)[0]

    @staticmethod
    def function(lines, name="f"):
        return f"void {name}(void)\n{{\n" + "    g();\n" * (lines - 3) + "}\n"

    def test_short_functions_pass(self):
        self.assertEqual(self.check(self.function(8)), [])

    def test_long_functions_are_found(self):
        few = "".join(self.function(4, f"f{n}") for n in range(20))
        self.assertEqual(self.check(few + self.function(60)), [])
        self.assert_refused(self.check(few + self.function(61)), "f has 61 code lines")

    def test_many_middling_functions_are_found(self):
        text = self.function(8) * 8 + self.function(40) * 2
        self.assert_refused(self.check(text), "90 % of the functions")
        self.assert_refused(self.check(self.function(13) * 5), "the median function")

    def test_comments_do_not_count(self):
        self.assertEqual(self.check(self.function(8).replace("g();", "g(); /*\n */", 1)), [])

    def test_branches_are_counted(self):
        text = "int f(int a) {\n" + "    if (a || a) {}\n" * 6 + "}\n"
        self.assert_refused(self.check(text), "f branches 13 times")

    def test_long_files_and_lines_are_found(self):
        self.assert_refused(self.check("int a;\n" * 401), "401 lines")
        self.assert_refused(self.check("/* " + "x" * 98 + "\n*/\n"), "101 columns")

    def test_tools_are_held_to_it_too(self):
        few = "".join(self.function(4, f"f{n}") for n in range(20))
        self.assert_refused(self.check(few + self.function(61), "tools/insole/a.c"), "61")


class Tree(Scratch):
    """Starts from a small tree in which all is well."""

    def setUp(self):
        super().setUp()
        licence = "SPDX-License-Identifier: MIT\n"
        version = ('#define INSOLE_VERSION_MAJOR 1\n#define INSOLE_VERSION_MINOR 2\n'
                   '#define INSOLE_VERSION_PATCH 3\n#define INSOLE_VERSION "1.2.3"\n')
        self.write("CMakeLists.txt", f"# {licence}project(insole VERSION 1.2.3)\n")
        self.write("CITATION.cff", f"# {licence}version: 1.2.3\n")
        self.write("CHANGELOG.md", f"<!-- {licence} -->\n## [1.2.3] - now\n")
        self.umbrella = f"// {licence}{version}#include \"insole/base/a.h\"\n"
        self.write("include/insole/insole.h", self.umbrella)
        self.write("include/insole/base/a.h", f"// {licence}int a(void);\n")
        self.write("src/base/a.c", f"// {licence}int a(void) {{ return 1; }}\n")
        self.suite = f"// {licence}" + "int t;\n" * 20
        self.write("tests/unit/test_a.c", self.suite)

    def problems(self):
        return tree.check(self.root)[0]

    def test_a_good_tree_passes(self):
        self.assertEqual(self.problems(), [])

    def test_the_top_level_is_agreed(self):
        subprocess.run(["git", "init", "-q", str(self.root)], check=True)
        self.write("notes.txt", "SPDX-License-Identifier: MIT\n")
        self.assert_refused(self.problems(), "notes.txt", "outside")

    def test_every_file_names_its_licence(self):
        self.write("src/base/b.md", "nothing\n")
        self.assert_refused(self.problems(), "src/base/b.md", "no SPDX")

    def test_unfinished_work_is_found(self):
        for word in ("TO" "DO", "FIX" "ME", "XX" "X"):
            self.write("tests/unit/test_a.c", self.suite + f"// {word}: later\n")
            self.assert_refused(self.problems(), "left unfinished")

    def test_machine_paths_are_found(self):
        self.write("tests/unit/test_a.c", self.suite + "// see /ho" "me/me/a.csv\n")
        self.assert_refused(self.problems(), "machine path")

    def test_a_source_needs_its_header(self):
        self.write("src/base/b.c", "// SPDX-License-Identifier: MIT\n")
        self.assert_refused(self.problems(), "src/base/b.c has no header")

    def test_a_stem_needs_its_suite(self):
        (self.root / "tests/unit/test_a.c").rename(self.root / "tests/unit/test_b.c")
        self.assert_refused(self.problems(), "base/a has no suite")

    def test_the_umbrella_is_complete(self):
        self.write("include/insole/insole.h", self.umbrella.replace("base/a.h", "base/b.h"))
        self.assert_refused(self.problems(), "does not include insole/base/a.h")

    def test_versions_agree(self):
        for name in ("include/insole/insole.h", "CITATION.cff", "CHANGELOG.md"):
            text = (self.root / name).read_text()
            self.write(name, text.replace("1.2.3", "1.2.4"))
            self.assert_refused(self.problems(), name, "does not say")
            self.write(name, text)

    def test_the_library_is_tested_twice_over(self):
        self.write("src/base/a.c", "// SPDX-License-Identifier: MIT\n" + "int x;\n" * 10)
        self.assert_refused(self.problems(), "less than 2 to 1")


@unittest.skipUnless(shutil.which("arm-none-eabi-gcc"), "no Cortex-M compiler")
class CortexM(Scratch):
    """Gates on what the Cortex-M compiler made of a small library."""

    def archive(self, code):
        source = self.write("src/base/a.c", code)
        made = self.root / "a.c.o"
        arm.tool("gcc", *ARM_FLAGS, "-c", source, "-o", made)
        archive = self.root / "liba.a"
        archive.unlink(missing_ok=True)
        arm.tool("ar", "rcs", archive, made)
        return archive

    def stack_problems(self, code, limit=100, indirect=""):
        self.archive(code)
        self.write("arm_symbols.csv", "symbol,stack_bytes,why\nmemcpy,8,copies\n")
        self.write("indirect_calls.csv", f"caller,callees\n{indirect}")
        self.write("budgets.csv", f"what,name,limit\nstack,*,{limit}\n")
        return stack.check(self.root, self.root)[0]

    def test_allowed_symbols_pass(self):
        code = "#include <string.h>\nvoid f(char *a, char *b, unsigned n) { memcpy(a, b, n); }\n"
        self.assertEqual(symbols.check(self.archive(code)), [])

    def test_heap_doubles_and_printing_are_found(self):
        for code, symbol in (("void *f(void) { return malloc(3); }", "malloc"),
                             ("double f(double a) { return a * a; }", "__aeabi_dmul"),
                             ("float f(float a) { return sinf(a); }", "sinf"),
                             ("int f(int a) { return printf(\"%d\", a); }", "printf")):
            headers = "#include <math.h>\n#include <stdio.h>\n#include <stdlib.h>\n"
            self.assert_refused(symbols.check(self.archive(headers + code)), f"needs {symbol}")

    def image_problems(self, code):
        """Of an image of that code beside an empty library."""
        source = self.write("image.c", code + "\nvoid reset(void) { use(3); }\n")
        made = self.write("tools/firmware/CMakeFiles/shoe_board.dir/image.c.obj", "")
        arm.tool("gcc", *ARM_FLAGS, "-c", source, "-o", made)
        library = self.archive("int nothing;\n")
        (self.root / "src/libinsole.a").write_bytes(library.read_bytes())
        image = self.write("bin/shoe_board", "")
        arm.tool("gcc", *ARM_FLAGS, "-nostartfiles", "-Ttext=0", "-Wl,-ereset,--gc-sections",
                 made, "-o", image)
        allowed = self.write("allowed.csv", "symbol,why\nmemset,zero\n" + "".join(
            f"{name},linker\n" for name in images.defined(image)
            if re.match(r"_|end$", name) and not name.startswith("__aeabi")))
        return images.check(self.root, allowed)

    def test_an_image_of_its_own_and_allowed_code_passes(self):
        code = ("#include <string.h>\nvoid use(unsigned n);\nstatic volatile char a[40];\n"
                "void use(unsigned n) { memset((char *)a, 7, n); }\n")
        self.assertEqual(self.image_problems(code), [])

    def test_doubles_in_an_image_are_found(self):
        code = ("void use(unsigned n);\nvolatile double a;\n"
                "void use(unsigned n) { a = a * (double)n; }\n")
        problems = "\n".join(self.image_problems(code))
        self.assertIn("shoe_board: __aeabi_dmul comes from outside", problems)

    def test_a_build_without_images_is_no_proof(self):
        self.assert_refused(images.check(self.root), "no images of devices")

    def test_stack_adds_up_along_calls(self):
        code = ("void use(char *a);\nvoid use(char *a) { *(volatile char *)a = 1; }\n"
                "__attribute__((noinline)) static void inner(void)\n"
                "{ volatile char a[40]; a[0] = 1; }\n"
                "void outer(void) { volatile char a[40]; a[0] = 1; inner(); a[1] = 2; }\n")
        self.assertEqual(self.stack_problems(code, limit=200), [])
        self.assert_refused(self.stack_problems(code, limit=79), "stack of outer")

    def test_recursion_is_found(self):
        code = "int f(int a);\nint g(int a);\nint f(int a) { return a ? 1 + g(a) : 0; }\n"
        code += "int g(int a) { return a > 3 ? 2 * f(a - 1) : 1; }\n"
        code = code.replace("int f(int a) {", "__attribute__((noinline)) int f(int a) {")
        code = code.replace("int g(int a) {", "__attribute__((noinline)) int g(int a) {")
        self.assert_refused(self.stack_problems(code), "recursion: ")

    def test_variable_frames_are_found(self):
        code = "int f(int n);\nint f(int n) { volatile int a[n]; a[n - 1] = n; return a[0]; }\n"
        self.assert_refused(self.stack_problems(code), "frame of variable size")

    def test_calls_through_pointers_need_their_targets(self):
        code = ("int small(int a);\nint small(int a) { volatile char b[90]; b[0] = 1; return a; }\n"
                "int f(int (*call)(int));\nint f(int (*call)(int)) { return 1 + call(2); }\n")
        self.assert_refused(self.stack_problems(code), "without listed targets")
        self.assertEqual(self.stack_problems(code, 120, "f,small\n"), [])
        self.assert_refused(self.stack_problems(code, 97, "f,small\n"), "stack of f")

    def test_of_a_program_only_what_it_holds_stands_behind_a_pointer(self):
        code = "".join(f"static int deep(int a) {{ volatile char b[{size}]; b[0] = 1; return a; }}\n"
                       f"int (*volatile {name})(int) = deep;\n@" for name, size in
                       (("here", 40), ("there", 400))).split("@")
        graph = stack.CallGraph(self.root)
        for name, text in zip(("here", "there"), code):
            source = self.write(f"{name}.c", "extern int (*volatile here)(int);\n"
                                "extern int (*volatile there)(int);\n" + text)
            arm.tool("gcc", *ARM_FLAGS, "-c", source, "-o",
                     self.root / f"{name}.o")
            graph.read((self.root / f"{name}.ci").read_text())
        graph.frames["f"], graph.calls["f"] = 0, {stack.INDIRECT}
        program = self.root / "program.elf"
        arm.tool("gcc", *ARM_FLAGS, "-nostdlib", "-Wl,-e0", self.root / "here.o", "-o", program)
        held = paths.symbols(program)
        self.assertIn("here.c:deep", held)
        all_of, of_program = (stack.Depths(graph, {}, {"f": ["deep"]}, names).depth("f")
                              for names in (None, held))
        self.assertGreaterEqual(all_of, 400)
        self.assertLess(of_program, 100)

    def test_unknown_functions_are_found(self):
        code = "int other(int);\nint f(int a);\nint f(int a) { return 1 + other(a); }\n"
        self.assert_refused(self.stack_problems(code), "nobody knows its stack")

    def test_an_empty_build_is_no_proof(self):
        self.write("arm_symbols.csv", "symbol,stack_bytes,why\n")
        self.write("indirect_calls.csv", "caller,callees\n")
        self.write("budgets.csv", "what,name,limit\nstack,*,1\n")
        self.assert_refused(stack.check(self.root, self.root)[0], "no call graph")

    def size_problems(self, code, flash=100, ram=16):
        archive = self.archive(code)
        self.write("include/insole/base/a.h", "typedef struct {\n    char x[20];\n} insole_a_t;\n"
                   "typedef struct {\n    char x[2];\n} insole_part_t;\n")
        budgets = self.write("budgets.csv", f"what,name,limit\nflash,*,{flash}\nram,*,{ram}\n")
        return sizes.check(self.root, archive, budgets)

    def test_flash_and_ram_have_limits(self):
        code = "const char text[] = \"0123456789\";\n"
        problems, listing = self.size_problems(code, ram=20)
        self.assertEqual(problems, [])
        self.assertRegex(listing, r"a +11 +20")
        self.assert_refused(self.size_problems(code, flash=10, ram=20)[0], "flash of a: 11 bytes")
        self.assert_refused(self.size_problems(code, ram=19)[0], "ram of a: 20 bytes")

    def test_only_structs_are_states(self):
        self.write("include/insole/base/kind.h", "typedef enum {\n    A\n} insole_kind_t;\n")
        self.write("include/insole/base/deep.h",
                   "typedef struct {\n    struct {\n        int a;\n    } x;\n} insole_deep_t;\n")
        self.write("include/insole/base/set.h", "typedef struct {\n    int a;\n} insole_set_config_t;\n")
        self.assertEqual(sizes.state_types(self.root), {"insole_deep_t": "deep"})

    def test_variables_of_the_library_are_found(self):
        self.assert_refused(self.size_problems("int counter;\n", ram=20)[0],
                            "4 bytes of variables")


class Paths(unittest.TestCase):
    COSTS = {"inertial": (1000, 200, 30), "foot": (2000, 300, 40), "phone": (3000, 400, 50)}

    def test_the_table_is_put_between_the_marks(self):
        text = f"before\n{paths.BEGIN}\nold\n{paths.END}\nafter\n"
        fresh = paths.with_table(text, self.COSTS)
        self.assertTrue(fresh.startswith("before\n") and fresh.endswith("\nafter\n"))
        self.assertIn("| inertial filter alone | 1,000 | 200 | 30 |", fresh)
        self.assertNotIn("old", fresh)
        self.assertEqual(paths.with_table(fresh, self.COSTS), fresh)

    def test_every_path_has_its_limits(self):
        budgets = arm.Budgets(paths.HERE / "budgets.csv")
        for name in paths.TITLES:
            for what in ("path_flash", "path_ram", "path_stack"):
                self.assertEqual(budgets.problems(what, name, 100), [])
                self.assertEqual(len(budgets.problems(what, name, 10 ** 6)), 1)


class Tools(Scratch):
    """The gates that run somebody else's program."""

    def run_gate(self, gate, code, name="src/a.c"):
        shutil.copy(HERE.parents[1] / ".clang-format", self.root)
        shutil.copy(HERE.parents[1] / ".clang-tidy", self.root)
        self.write("include/.keep", "")
        self.write("tools/.keep", "")
        self.write(name, code)
        done = subprocess.run(["sh", str(HERE / "tools.sh"), gate, str(self.root)],
                              capture_output=True, text=True, check=False)
        if done.returncode == common.SKIPPED:
            self.skipTest(done.stdout)
        return done.returncode

    def assert_gate(self, gate, good, bad):
        self.assertEqual(self.run_gate(gate, good), 0)
        self.assertNotEqual(self.run_gate(gate, bad), 0)

    def test_format(self):
        self.assert_gate("format", "int a;\n", "int  a ;\n")

    def test_cppcheck(self):
        code = "int f(void);\nint f(void)\n{\n    int a[2] = {0, 1};\n    return a[%d];\n}\n"
        self.assert_gate("cppcheck", code % 1, code % 2)

    def test_tidy(self):
        code = "int f(int a);\nint f(int a)\n{\n    return %s;\n}\n"
        self.assert_gate("tidy", code % "a", code % "a - a")

    def test_warnings(self):
        code = "int f(void);\nint f(void)\n{\n%s    return 1;\n}\n"
        self.assert_gate("warnings", code % "", code % "    int unused;\n")


if __name__ == "__main__":
    unittest.main()
