#!/usr/bin/env python3
"""scripts/corpus: a verdict, a picture and a word for each file below a folder."""
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from corpus_sheet.run import mean_of_png  # noqa: E402
from corpus_sheet.sheet import reason  # noqa: E402

SCENE = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
         "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
         "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
         "bufferViews": [{"buffer": 0, "byteLength": 36}],
         "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,"
                                               "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}


def png(rows, kinds):
    """Of grey rows, each stored as the filter of its kind has it (0 or 2)."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    raw, above = b"", bytes(len(rows[0]))
    for row, kind in zip(rows, kinds):
        raw += bytes([kind]) + bytes((value - (up if kind == 2 else 0)) & 255 for value, up in zip(row, above))
        above = row
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


os.environ.setdefault("ASAN_OPTIONS", "detect_leaks=0")  # drivers keep memory until the process ends


class Corpus(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_on(self, importon, *words):
        command = [ROOT / "scripts/corpus", self.folder / "files", "-o", self.folder / "out", "--importon", importon, *words]
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
        return json.loads((self.folder / "out/corpus.json").read_text()), done.stdout

    def test_says_what_came_of_three_files(self):
        (self.folder / "files/below").mkdir(parents=True)
        files = {"good.gltf": SCENE, "below/strange.GLTF": {**SCENE, "scene": 7}, "bad.gltf": {**SCENE, "accessors": []}}
        for name, scene in files.items():
            (self.folder / "files" / name).write_text(json.dumps(scene))
        (self.folder / "files/readme.txt").write_text("no scene")
        found, table = self.run_on(IMPORTON, "--", "--passes", "1")
        self.assertEqual([file["name"] for file in found["files"]], ["bad.gltf", "below/strange.GLTF", "good.gltf"])
        bad, strange, good = found["files"]
        self.assertEqual((bad["verdict"], bad["status"]), ("refused", 2))
        self.assertIn("index 0 is not among the 0 accessors", bad["message"])
        self.assertEqual((strange["verdict"], len(strange["warnings"])), ("rendered", 1))
        self.assertEqual((good["verdict"], good["warnings"]), ("rendered", []))
        self.assertTrue((self.folder / "out" / good["picture"]).is_file())
        self.assertEqual(found["counts"]["rendered"], 2)
        self.assertIn("index N is not among the N accessors", table)
        page = (self.folder / "out/index.html").read_text()
        self.assertIn(good["picture"], page)
        self.assertNotIn(bad["picture"], page)

    def test_tells_a_crash_and_a_hang_from_an_error(self):
        (self.folder / "files").mkdir()
        for name, line in {"crash": "kill -SEGV $$", "hang": "exec sleep 60", "failed": "exit 3"}.items():
            (self.folder / "files" / f"{name}.gltf").write_text(line)
        program = self.folder / "importon"
        program.write_text("#!/bin/sh\n. \"$1\"\n")
        program.chmod(0o755)
        found, _ = self.run_on(program, "--timeout", "1")
        self.assertEqual({file["verdict"] for file in found["files"]}, {"crash", "hang", "failed"})
        self.assertTrue(all(pathlib.Path(file["name"]).stem == file["verdict"] for file in found["files"]))

    def test_holds_verdicts_against_reports_beside_the_files(self):
        (self.folder / "files").mkdir()
        for name, errors in {"good": 0, "wrong": 2}.items():
            (self.folder / "files" / f"{name}.gltf").write_text(json.dumps({"asset": {"version": "2.0"}}))
            report = self.folder / "files" / f"{name}.gltf.report.json"
            report.write_text(json.dumps({"issues": {"numErrors": errors}}))
        (self.folder / "files/other.gltf").write_text(json.dumps(SCENE))
        found, table = self.run_on(IMPORTON, "--", "--passes", "1")
        self.assertEqual([file["errors"] for file in found["files"]], [0, None, 2])
        self.assertIn("valid by their reports: 1 (1 refused)\n    1  the scene has no triangle\n", table)
        self.assertIn("with errors by their reports: 1 (1 refused)\n", table)

    def test_means_of_pictures(self):
        rows = [bytes([0, 10, 20]), bytes([30, 40, 50])]
        self.assertAlmostEqual(mean_of_png(png(rows, [0, 2])), 25)

    def test_reasons_are_without_what_differs(self):
        message = "index 5 is not among the 2 scenes (a b.glb#/scene): correct the file or export it again"
        self.assertEqual(reason(message), "index N is not among the N scenes")


if __name__ == "__main__":
    IMPORTON = sys.argv.pop(1)
    unittest.main()
