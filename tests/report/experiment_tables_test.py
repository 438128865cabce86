#!/usr/bin/env python3
"""scripts/experiments: tables from what programs print, and a place for each in docs/experiments."""
import json
import pathlib
import runpy
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from experiment_tables import bench, renders  # noqa: E402
from experiment_tables.programs import Programs  # noqa: E402

TABLES = runpy.run_path(str(ROOT / "scripts/experiments"))["TABLES"]

BENCH = """#!/usr/bin/env python3
import json, re, sys
chosen = sys.argv[1].removeprefix("--benchmark_filter=")
runs = [{"name": "closest_hit/cornell_box/manual_time", "triangles": 36, "Mrays/s": 20, "ratio": 0.75},
        {"name": "any_hit/cornell_box/manual_time", "triangles": 36, "Mrays/s": 10},
        {"name": "cutting/cornell_box/iterations:1", "is_same_tree": 1, "records": 1, "closest": 1, "any_hit": 1},
        {"name": "cutting/cornell_box_turned/iterations:1", "is_same_tree": 0, "records": 1.1, "closest": 0.9,
         "any_hit": 1.05}]
print(json.dumps({"benchmarks": [run for run in runs if re.search(chosen, run["name"])]}))
"""

BROKEN = """#!/usr/bin/env python3
import json
run = {"name": "lights/100/iterations:1", "error_occurred": True, "error_message": "rays were given up"}
print(json.dumps({"benchmarks": [run]}))
"""

IMPORTON = """#!/usr/bin/env python3
import json, os, sys
words = sys.argv[1:]
kernels = [{"label": "trace closest", "total_ms": 500, "compile_ms": 20},
           {"label": "a new kernel", "total_ms": 1500, "compile_ms": 30}]
cold = "MESA_SHADER_CACHE_DIR" in os.environ and not os.listdir(os.environ["MESA_SHADER_CACHE_DIR"])
if cold: open(os.environ["MESA_SHADER_CACHE_DIR"] + "/kernel", "w")
phases = {name: 0.25 for name in ("load", "bvh", "device", "importance", "photons", "gather")}
json.dump({"kernels": kernels, "seconds": {"total": 9 if cold else 4, **phases}, "device": {"name": "D", "driver": "V"}},
          open(words[words.index("--stats") + 1], "w"))
"""


class ExperimentTables(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.put("bin/importon", IMPORTON)
        self.put("bench/importon_bench", BENCH)
        self.programs = Programs(self.folder, is_small=True)

    def put(self, name, text):
        file = self.folder / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
        file.chmod(0o755)

    def test_each_has_one_place_in_the_pages(self):
        pages = "".join(page.read_text() for page in (ROOT / "docs/experiments").glob("*.md"))
        self.assertEqual({name: 1 for name in TABLES}, {name: pages.count(f"<!-- table {name} -->") for name in TABLES})
        self.assertEqual(len(TABLES), pages.count("<!-- table "))

    def test_rates_stand_beside_embrees_where_it_ran(self):
        self.assertIn("| cornell_box | 36 | 20.0 | 0.75 | 10.0 | – |", bench.traversal(self.programs))

    def test_compiling_tells_what_is_paid_each_time_and_once(self):
        text = renders.compiling(self.programs)
        self.assertIn("| a new kernel | 30.0 | 0.0 |", text)
        self.assertIn("| all | 50 | 0 |", text)

    def test_cutting_names_scenes_whose_tree_is_the_same(self):
        text = bench.cutting(self.programs)
        self.assertIn("| cornell_box, turned | 1.10 | 0.90 | 1.05 |", text)
        self.assertTrue(text.endswith("The same tree: cornell_box."))

    def test_a_benchmark_that_fails_ends_it(self):
        self.put("bench/importon_bench", BROKEN)
        with self.assertRaisesRegex(SystemExit, "rays were given up"):
            bench.lights(self.programs)

    def test_shares_of_kernels_are_of_all_kernels(self):
        row = renders.kernels(self.programs).splitlines()[-1]
        self.assertEqual(["cornell_box", "4.0", "0.50", "0.25"] + ["0.00"] * 8 + ["0.75"], row.strip("| ").split(" | "))

    def test_labels_of_kernels_are_those_of_the_program(self):
        source = "".join(file.read_text() for file in (ROOT / "src").rglob("*.[ch]*"))
        kernels = {file.stem.replace("_", " ") for file in (ROOT / "shaders/kernels").rglob("*.comp")}
        labels = set.union(*renders.GROUPS.values())
        self.assertEqual([], sorted(label for label in labels - kernels if f'"{label}"' not in source))
        self.assertEqual(len(labels), sum(map(len, renders.GROUPS.values())))

    def test_start_up_tells_warm_and_empty_caches_apart(self):
        row = renders.start_up(self.programs).splitlines()[-1]
        self.assertEqual(["cornell_box", "4.00"] + ["0.25"] * 6 + ["9.00"], row.strip("| ").split(" | "))


if __name__ == "__main__":
    unittest.main()
