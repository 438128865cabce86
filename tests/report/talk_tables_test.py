"""The statistics, marks and kept renders behind scripts/talk, with a program that only pretends to render."""
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))
from talk_tables import emission, lab, pages  # noqa: E402

# Counts its calls and writes statistics with an error that falls as one over the photons.
PROGRAM = """#!/usr/bin/env python3
import json, pathlib, sys
words = sys.argv[1:]
calls = pathlib.Path(__file__).with_suffix(".calls")
calls.write_text(calls.read_text() + "x" if calls.exists() else "x")
photons = int(words[words.index("--photons") + 1])
pathlib.Path(words[words.index("--stats") + 1]).write_text(json.dumps(
    {"command": words, "error": {"relmse_trimmed": 1 / photons}, "photons": {"emitted": photons, "pilot": 100}}))
"""


class Statistics(unittest.TestCase):
    def test_interval_is_students(self):
        mean, half = lab.mean_and_half([1, 2, 3])
        self.assertEqual(mean, 2)
        self.assertAlmostEqual(half, 4.303 / math.sqrt(3), places=6)

    def test_geometric_mean_has_an_interval_of_ratios(self):
        mean, low, high = lab.geometric([0.5, 2])
        self.assertAlmostEqual(mean, 1)
        self.assertAlmostEqual(low * high, 1)

    def test_photons_to_an_error_lie_on_the_curve(self):
        curve = [(100, 1.0), (400, 0.25)]
        self.assertAlmostEqual(emission.photons_at(curve, 0.5), 200)
        self.assertIsNone(emission.photons_at(curve, 0.1))


class Pages(unittest.TestCase):
    def test_a_table_replaces_what_stood_between_its_marks(self):
        page = "a\n<!-- table x -->\nold\n<!-- end -->\nb\n<!-- table y -->\nkept\n<!-- end -->\n"
        new = pages.filled(page, "x", "| 1\\2 |")
        self.assertEqual(new.replace("| 1\\2 |", "old").replace("\n\n", "\n"), page)
        self.assertEqual(pages.filled(new, "x", "| 1\\2 |"), new)
        self.assertIsNone(pages.filled(page, "z", ""))


class Renders(unittest.TestCase):
    def test_are_made_once_and_give_shares_of_photons(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "program"
            program.write_text(PROGRAM)
            program.chmod(0o755)
            bench = lab.Lab(program, pathlib.Path(folder) / "kept", 8)
            few, many, power = (bench.render("scene.glb", f"--photons {n}", 1) for n in (1000, 4000, 2000))
            self.assertEqual(bench.render("scene.glb", "--photons 2000", 1)["photons"], power["photons"])
            self.assertEqual(len(program.with_suffix(".calls").read_text()), 3)
            sign, share = emission.share_of_power([few, many], power, lambda s: s["photons"]["emitted"])
            self.assertEqual(sign, "")
            self.assertAlmostEqual(share, 1)
            self.assertEqual(emission.lessons(power), 100)


if __name__ == "__main__":
    unittest.main()
