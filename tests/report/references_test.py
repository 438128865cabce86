"""The arithmetic and the kept runs behind scripts/references, with a program that only pretends to render."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))
from talk_tables import references  # noqa: E402

# Writes its passes where an image would be; merged, their sum. The own error falls as one over the passes of both halves.
PROGRAM = """#!/usr/bin/env python3
import json, pathlib, sys
words = sys.argv[1:]
after = lambda word: words[words.index(word) + 1]
calls = pathlib.Path(__file__).with_suffix(".calls")
calls.write_text((calls.read_text() if calls.exists() else "") + words[0].split("/")[-1] + "\\n")
if words[0] == "compare":
    print(json.dumps({"relmse_trimmed": 0.02 / int(pathlib.Path(words[2]).read_text())}))
elif words[0] == "merge":
    images = words[1:words.index("-o")]
    if any(pathlib.Path(i).read_text() == "stranger" for i in images):
        sys.exit(2)
    pathlib.Path(after("-o")).write_text(str(sum(int(pathlib.Path(i).read_text()) for i in images)))
else:
    passes = int(after("--passes"))
    pathlib.Path(after("-o")).write_text(str(passes))
    pathlib.Path(after("--stats")).write_text(json.dumps(
        {"seed": int(after("--seed")), "image": {"passes": passes}, "seconds": {"total": 0.001 * passes}}))
"""


class NextPasses(unittest.TestCase):
    def test_are_what_the_target_asks_for(self):
        self.assertEqual(references.next_passes(100, 0.02, 0.01, 1, 1e9), 120)

    def test_are_none_at_the_target(self):
        self.assertEqual(references.next_passes(100, 0.01, 0.01, 1, 1e9), 0)

    def test_grow_by_steps(self):
        self.assertEqual(references.next_passes(4, 1, 0.001, 1, 1e9), 4 * references.GROWTH)

    def test_of_both_halves_fit_the_time(self):
        self.assertEqual(references.next_passes(100, 1, 0.001, 0.5, 20), 20)
        self.assertEqual(references.next_passes(100, 1, 0.001, 0.5, -1), 0)


class Runs(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)
        self.program = self.folder / "program"
        self.program.write_text(PROGRAM)
        self.program.chmod(0o755)
        self.root, references.ROOT = references.ROOT, self.folder

    def tearDown(self):
        references.ROOT = self.root
        self.scratch.cleanup()

    def make(self, target, seconds=60):
        references.PURPOSES["tables"].targets["ring"] = target
        return references.Reference(self.program, "tables", "ring").improve(seconds)

    def renders(self):
        return self.program.with_suffix(".calls").read_text().split().count("ring.gltf")

    def test_are_added_until_the_own_error_is_small_enough(self):
        facts = self.make(0.0005)
        self.assertLessEqual(facts["own_error"], 0.0005)
        self.assertGreaterEqual(facts["passes"], 40)
        self.assertLess(facts["passes"], 60)
        self.assertTrue(references.reached(facts))

    def test_have_seeds_of_their_own(self):
        facts = self.make(0.0005)
        kept = self.folder / "build/references/tables/ring"
        seeds = [json.loads(file.read_text())["seed"] for file in kept.glob("[ab][0-9].json")]
        self.assertEqual(sorted(seeds), list(range(facts["seeds"][0], facts["seeds"][1] + 1)))

    def test_are_kept_and_added_to(self):
        first = self.make(0.002)
        made = self.renders()
        self.assertEqual(self.make(0.002), first)
        self.assertEqual(self.renders(), made)
        self.assertGreater(self.make(0.0005)["passes"], first["passes"])

    def test_of_both_halves_are_alike_after_a_stop_between_them(self):
        kept = self.folder / "build/references/tables/ring"
        kept.mkdir(parents=True)
        (kept / "a0.exr").write_text("7")
        (kept / "a0.json").write_text(json.dumps({"image": {"passes": 7}, "seconds": {"total": 0.007}}))
        self.assertEqual(self.make(1)["passes"], 14)
        self.assertEqual(self.renders(), 1)

    def test_of_another_program_are_told_of(self):
        self.make(0.002)
        (self.folder / "build/references/tables/ring/a0.exr").write_text("stranger")
        with self.assertRaisesRegex(SystemExit, "remove it, to begin anew"):
            self.make(0.002)

    def test_stop_when_time_is_up(self):
        facts = self.make(1e-9, 0)
        self.assertEqual(facts["passes"], 2 * references.FIRST_PASSES)
        self.assertFalse(references.reached(facts))

    def test_stand_beside_the_image_with_their_facts(self):
        facts = self.make(0.002)
        image = self.folder / "build/references/tables/ring.exr"
        self.assertEqual(int(image.read_text()), facts["passes"])
        self.assertEqual(json.loads(image.with_suffix(".json").read_text()), facts)


if __name__ == "__main__":
    unittest.main()
