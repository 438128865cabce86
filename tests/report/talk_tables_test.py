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
    {"command": words, "error": {"relmse_trimmed": 1 / photons, "own_of_reference": 0},
     "photons": {"emitted": photons, "pilot": 100}}))
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

    def test_what_is_not_known_within_a_factor_of_two_is_not_told(self):
        self.assertTrue(lab.is_known(1, 0.6, 1.9))
        self.assertFalse(lab.is_known(1, 0.4, 1.9))
        self.assertFalse(lab.is_known(1, 0.6, 2.1))
        self.assertEqual(lab.with_spread([1, 1.01, 1.02]), "1.01 ± 0.025")
        self.assertEqual(lab.with_spread([1, 2, 3]), lab.NOT_KNOWN)
        self.assertEqual(lab.with_interval([1, 1.01, 1.02]), "1.01 (0.99 … 1.04)")
        self.assertEqual(lab.with_interval([1, 2, 3]), lab.NOT_KNOWN)

    def test_an_error_near_the_references_own_is_an_upper_bound(self):
        runs = lambda error, own: [{"error": {"relmse_trimmed": error, "own_of_reference": own}}] * 4
        good, poor = runs(0.01, 0.0009), runs(0.01, 0.0011)
        self.assertEqual(lab.errors_text(good), "0.01")
        self.assertEqual(lab.errors_text(poor), "< 0.01")
        self.assertEqual(lab.ratio_text(good, good), "1.00 (1.00 … 1.00)")
        self.assertEqual(lab.ratio_text(runs(0.1, 0.0011), poor), "10.00 (10.00 … 10.00) \\*")
        self.assertTrue(lab.table(["a"], [[lab.ratio_text(poor, poor)]]).endswith(lab.FLOOR_NOTE))
        self.assertFalse(lab.table(["a"], [["b"]]).endswith(lab.FLOOR_NOTE))

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
