#!/usr/bin/env python3
"""scripts/growing_cost from renders to tables, with a program that only pretends to render."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# A second for the first pass and one for each later one; errors fall as one over the passes, and memory stays.
PROGRAM = """#!/usr/bin/env python3
import json, pathlib, sys
words = sys.argv[1:]
after = lambda name, default=None: words[words.index(name) + 1] if name in words else default
if words[0] == "merge":
    pathlib.Path(after("-o")).touch()
elif words[0] == "compare":
    print(json.dumps({"relmse_trimmed": 0.004}))
else:
    if "--reference" in words and not pathlib.Path(after("--reference")).exists():
        sys.exit("no such reference")
    passes = int(after("--passes"))
    steps = [{"relmse_trimmed": 1 / (k + 1), "seconds": 2 + k} for k in range(passes)]
    names = ("load", "bvh", "device", "importance", "cells", "photons", "gather")
    memory = {"photon_map_bytes": 1 << 20, "device_peak_bytes": 8 << 20, "host_peak_bytes": 9 << 20}
    pathlib.Path(after("-o")).touch()
    pathlib.Path(after("--stats")).write_text(json.dumps({
        "scene": {"triangles": 12, "lights": 1}, "device": {"name": "none", "driver": "pretended"}, "memory": memory,
        "seconds": {**{name: 1 for name in names}, "total": 10}, "warnings": [],
        "photons": {"global": {"hits": 4, "stored": 2}}, **({"error": {"passes": steps}} if "--reference" in words else {})}))
"""


class GrowingCost(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        program = self.folder / "importon"
        program.write_text(PROGRAM)
        program.chmod(0o755)
        shutil.copy(ROOT / "docs/growing-cost.md", self.folder)
        self.command = [sys.executable, str(ROOT / "scripts/growing_cost"), "--importon", str(program), "--folder",
                        str(self.folder / "renders"), "--output", str(self.folder), "--small", "--passes", "3"]

    def table(self, name):
        subprocess.run([*self.command, name], check=True, capture_output=True)
        page = (self.folder / "growing-cost.md").read_text()
        return page.split(f"<!-- table growing-{name} -->")[1].split("<!-- end -->")[0]

    def test_time_to_an_equal_error_is_told_of_each_size(self):
        text = self.table("lights")
        self.assertEqual([row.split(" | ")[0] for row in text.strip().splitlines()[2:7]],
                         ["| 1", "| 10", "| 100", "| 1,000", "| 10,000"])
        # The references' own error, a quarter of 0.004, is taken off: after the third pass 0.33; 4 s and 3 s at the end.
        self.assertIn("| 0.33 | 1.00 | 1 | 7.00 | 1.00 | 1.00 | 8 | 9 |", text)
        self.assertIn("On none, pretended.", text)

    def test_sizes_are_held_against_noise(self):
        self.assertEqual(self.table("pixels").count("| 1.00 | 1 | "), 4)

    def test_memory_is_told_by_passes_and_by_control(self):
        self.assertIn("| 512 | 1.0 | 8.0 | 9.0 |", self.table("memory"))
        self.assertIn("They take 1.0 times less: it does not hold.", self.table("control"))


if __name__ == "__main__":
    unittest.main()
