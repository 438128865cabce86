"""scripts/mutants: every mutant fits the sources; and on a small tree, whose test program is a shell script, each is
caught by the right test, or is said to live, to hang or not to compile."""
import contextlib
import importlib.machinery
import importlib.util
import io
import json
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from mutant_tools import gate, table  # noqa: E402

loader = importlib.machinery.SourceFileLoader("mutants", str(ROOT / "scripts/mutants"))
mutants = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutants", loader))
loader.exec_module(mutants)

CMAKE = """cmake_minimum_required(VERSION 3.25)
project(toy LANGUAGES NONE)
enable_testing()
foreach(name IN ITEMS first_tests second_tests)
  add_custom_command(OUTPUT ${name} DEPENDS ${CMAKE_SOURCE_DIR}/src/${name}.sh
                     COMMAND sh -n ${CMAKE_SOURCE_DIR}/src/${name}.sh
                     COMMAND cp ${CMAKE_SOURCE_DIR}/src/${name}.sh ${name} COMMAND chmod +x ${name})
  add_custom_target(make_${name} ALL DEPENDS ${name})
endforeach()
foreach(test IN ITEMS first_tests/Sum.IsRight first_tests/Sum.IsQuick second_tests/Other.IsRight)
  string(REPLACE "/" ";" parts ${test})
  list(GET parts 0 program)
  list(GET parts 1 name)
  add_test(NAME ${name} COMMAND ${CMAKE_BINARY_DIR}/${program} --gtest_filter=${name})
  set_tests_properties(${name} PROPERTIES LABELS unit)
endforeach()
add_test(NAME Sum.IsSlow COMMAND ${CMAKE_BINARY_DIR}/first_tests --gtest_filter=Sum.IsSlow)
set_tests_properties(Sum.IsSlow PROPERTIES LABELS slow)
"""
PRESETS = {"version": 6, "configurePresets": [
    {"name": "test", "generator": "Ninja", "binaryDir": "${sourceDir}/build/${presetName}"}]}
# Runs the tests of the last argument as a program of GoogleTest does, and counts its calls.
PROGRAM = """#!/bin/sh
echo "$0" >> CALLS
for word; do case $word in --gtest_filter=*) filter=${word#*=} ;; esac; done
IFS=:
for test in $filter; do
  echo "[ RUN      ] $test"
  case $test in
    *.IsRight) test $((1 + 1)) -eq 2 ;;
    *.IsQuick) sleep 0 ;;
    *.IsSlow) false ;;
  esac || { echo "[  FAILED  ] $test (0 ms)"; exit 1; }
done
"""
TABLE = """
[wrong]
file = "src/first_tests.sh"
breaks = "One and one is three."
old = '1 + 1'
new = '1 + 2'

[harmless]
file = "src/first_tests.sh"
breaks = "Nothing that a test sees."
old = 'sleep 0'
new = 'sleep 0.01'

[hanging]
file = "src/first_tests.sh"
breaks = "It never ends."
old = 'sleep 0'
new = 'sleep 60'

[once]
file = "src/first_tests.sh"
breaks = "It fails the first time that it is seen."
old = 'sleep 0'
new = 'test -e SEEN || { touch SEEN; false; }'

[nonsense]
file = "src/first_tests.sh"
breaks = "It is no program."
old = 'esac ||'
new = '||'

[elsewhere]
file = "src/second_tests.sh"
breaks = "One and one is three in the other program."
old = '1 + 1'
new = '1 + 2'
"""
PAGE = "Mutants:\n\n<!-- table mutants -->\n<!-- end -->\n"


class Table(unittest.TestCase):
    def test_every_mutant_fits_the_sources(self):
        found = table.read(ROOT / "tests/mutants")
        self.assertGreaterEqual(len(found), 45)
        table.check(found, ROOT)

    def test_no_mutant_is_outside_of_the_program(self):
        for mutant in table.read(ROOT / "tests/mutants"):
            self.assertRegex(mutant.file, r"^(src|shaders)/", mutant.name)
            self.assertRegex(mutant.breaks, r"^[^|]+\.$", mutant.name)


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        for name in ("src", "tests/mutants", "docs"):
            (self.root / name).mkdir(parents=True)
        self.calls = self.root / "calls"
        program = PROGRAM.replace("CALLS", str(self.calls))
        self.write("CMakeLists.txt", CMAKE)
        self.write("CMakePresets.json", json.dumps(PRESETS))
        self.write("src/first_tests.sh", program)
        self.write("src/second_tests.sh", program)
        self.write("tests/mutants/all.toml", TABLE.replace("SEEN", str(self.root / "seen")))
        self.write("docs/testing.md", PAGE)
        self.old = gate.LEAST_TIMEOUT, gate.TIMEOUT_FACTOR
        gate.LEAST_TIMEOUT, gate.TIMEOUT_FACTOR = 3, 1

    def tearDown(self):
        gate.LEAST_TIMEOUT, gate.TIMEOUT_FACTOR = self.old

    def write(self, name, text):
        (self.root / name).write_text(text)

    def run_script(self, *arguments):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            status = mutants.main(list(arguments), self.root)
        return status, out.getvalue()

    def programs_called(self):
        called = [pathlib.Path(line).name for line in self.calls.read_text().split()] if self.calls.exists() else []
        self.calls.unlink(missing_ok=True)
        return called

    def test_says_which_test_caught_it(self):
        status, said = self.run_script("wrong", "elsewhere")
        self.assertEqual(status, 0, said)
        self.assertIn("wrong: caught by Sum.IsRight", said)
        self.assertIn("elsewhere: caught by Other.IsRight", said)
        page = (self.root / "docs/testing.md").read_text()
        self.assertIn("| `wrong` | One and one is three. | `Sum.IsRight` |", page)
        self.assertIn("| `harmless` | Nothing that a test sees. | not run yet |", page)
        self.assertIn("1 + 1", (self.root / "src/first_tests.sh").read_text())
        self.assertIn("1 + 1", (self.root / "build/mutants/tree/src/first_tests.sh").read_text())

    def test_runs_without_mutants_once_and_then_only_what_a_mutant_changes(self):
        self.run_script("elsewhere")
        # Both without a mutant, and one twice with it.
        self.assertEqual(sorted(self.programs_called()), ["first_tests"] + 3 * ["second_tests"])
        self.run_script("elsewhere", "wrong")
        self.assertEqual(self.programs_called(), 2 * ["second_tests"] + 2 * ["first_tests"])
        source = self.root / "src/first_tests.sh"
        source.write_text(source.read_text() + "# another version\n")
        self.run_script("wrong")
        self.assertEqual(self.programs_called(), 3 * ["first_tests"])  # the likely test alone, and twice for the mutant
        self.run_script("hanging")
        self.assertEqual(self.programs_called(), 2 * ["first_tests"])  # its other tests, and once for the mutant

    def test_runs_only_the_likely_test_if_asked(self):
        self.run_script("wrong")
        self.programs_called()
        status, said = self.run_script("--likely", "wrong", "elsewhere")
        self.assertEqual(status, 1)
        self.assertIn("wrong: caught by Sum.IsRight", said)
        self.assertIn("elsewhere: not caught by a test that is known", said)
        self.assertEqual(self.programs_called(), 2 * ["first_tests"])

    def test_says_that_it_lives_with_what_fails_only_once_in_a_while(self):
        for name in ("harmless", "once"):
            status, said = self.run_script(name)
            self.assertEqual(status, 1, said)
            self.assertIn(f"{name}: LIVES", said)

    def test_counts_what_hangs_as_caught(self):
        status, said = self.run_script("hanging")
        self.assertEqual(status, 0, said)
        self.assertIn("hanging: caught by Sum.IsQuick (timeout)", said)

    def test_takes_what_does_not_compile_for_an_error_of_the_table(self):
        status, said = self.run_script("nonsense", "wrong")
        self.assertEqual(status, 2)
        self.assertIn("nonsense: does not compile", said)
        self.assertIn("wrong: caught by Sum.IsRight", said)

    def test_refuses_sources_that_fail_without_a_mutant(self):
        source = self.root / "src/second_tests.sh"
        source.write_text(source.read_text().replace("1 + 1", "1 + 3"))
        status, said = self.run_script("wrong")
        self.assertEqual(status, 2)
        self.assertIn("without a mutant Other.IsRight fails", said)

    def test_refuses_a_mutant_that_is_out_of_date(self):
        source = self.root / "src/second_tests.sh"
        source.write_text(source.read_text() + "# 1 + 1\n")
        for arguments in ([], ["--list"], ["elsewhere"]):
            status, said = self.run_script(*arguments)
            self.assertEqual(status, 2)
            self.assertIn("elsewhere is out of date", said)

    def test_a_changed_mutant_is_no_longer_known(self):
        self.run_script("wrong")
        self.assertIn("One and one is three. Caught by Sum.IsRight.", self.run_script("--list")[1])
        self.write("tests/mutants/all.toml", TABLE.replace("1 + 2", "1 + 3"))
        self.assertIn("One and one is three. Not run yet.", self.run_script("--list")[1])


class Programs(unittest.TestCase):
    def test_are_those_of_the_gate_by_label(self):
        def test(name, command, labels):
            return {"name": name, "command": command, "properties": [{"name": "LABELS", "value": labels}]}
        found = gate.programs_of([
            test("A.One", ["/b/tests/a", "--gtest_filter=A.One"], ["unit"]),
            test("A.Two", ["/b/tests/a", "--gtest_filter=A.Two"], ["slow"]),
            test("A.Three", ["/b/tests/a", "--gtest_filter=A.Three"], ["render"]),
            test("Array", ["/s/array_test.sh", "/b/bin/importon"], ["render"]),
            test("Other", ["/s/other_test.sh"], ["unit"])], pathlib.Path("/b"))
        self.assertEqual([(p.name, p.target, p.tests) for p in found],
                         [("a", "a", ["A.One", "A.Three"]), ("Array", "importon", ["Array"])])


if __name__ == "__main__":
    unittest.main()
