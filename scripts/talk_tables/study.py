"""The talk's figures, by `importon study`: counts over seeds, and sheets of pictures (ImageMagick's montage)."""
import base64
import json
import pathlib
import re
import subprocess
import tempfile

from .lab import table, with_spread
from .references import ROOT

OPTIONS = "--width 160 --photons 400000 --importons 80000 --passes 1 --indirect-filter off"
# Pictures of a sheet, row by row: the end of a figure's title, and which of its pictures.
MAP_SHEET = [("Importons, {map} map", 0), ("Required density, {map} map", 0), ("Photons stored, {map} map", 0),
             ("Photons stored, {map} map", 1), ("Density stored, {map} map", 0), ("Density stored, {map} map", 1),
             ("The {map} map seen directly", 0), ("The {map} map seen directly", 1), ("Image", 0), ("Image", 1),
             ("Difference of the images", 0), ("Difference of the images", 2)]
DOOR_SHEET = [("Importance Γ, global map", 0), ("Photons stored, global map", 0), ("Photons stored, global map", 1),
              ("Photons stored, global map", "by probability"), ("The global map seen directly", 0),
              ("The global map seen directly", 1), ("The global map seen directly", 3), ("The global map seen directly", 4),
              ("Image", 0), ("Image", 1), ("Image", 3), ("Image", 4)]
SHEETS = {"talk_rooms": ("rooms", "global", MAP_SHEET), "talk_glass": ("glass_caustic", "caustic", MAP_SHEET),
          "talk_door": ("door_slit", "global", DOOR_SHEET)}


def study(lab, scene, seed):
    """The folder of a study."""
    folder = lab.folder / f"study_{scene}_{seed}"
    if not (folder / "study.json").exists():
        subprocess.run([str(lab.importon), "study", lab.scene_file(scene), "-o", str(folder), *OPTIONS.split(), "--seed",
                        str(seed)], check=True, capture_output=True)
    return folder


def studies(lab, scene, seeds):
    """For each seed the ways to render, by name."""
    found = [json.loads((study(lab, scene, seed) / "study.json").read_text()) for seed in range(1, seeds + 1)]
    return [{config["name"]: config for config in one["configs"]} for one in found]


def row(runs, name, kind):
    of = lambda value: with_spread([value(run[name]) for run in runs])
    stored = lambda c: c["photons"][kind]["stored"]
    return [name, of(stored), of(lambda c: c["photons"][kind]["hits"] / stored(c)),
            of(lambda c: c["mean_where_seen"][kind]["required"]), of(lambda c: c["mean_where_seen"][kind]["density"]),
            of(lambda c: sum(c["photons"][kind]["flux_map"])),
            of(lambda c: c["against_first"]["relmse_trimmed"]), with_spread([r[name]["against_first"]["mean_ratio"] for r in runs], 5)]


def counts(scene, kind):
    """A table of a scene's map by the ways of the study."""
    def make(lab, seeds):
        runs = studies(lab, scene, seeds)
        hits = with_spread([r["standard"]["photons"][kind]["hits"] for r in runs])
        names = [n for n in runs[0]]
        head = [f"of {hits} hits", "stored", "times fewer", "required where seen, photons/m²", "stored where seen",
                "W in the map", "relMSE against `standard`", "ratio of means"]
        return table(head, [row(runs, name, kind) for name in names])
    return make


def pictures_of(page):
    data = json.loads(re.search(r'<script id="data" type="application/json">(.*?)</script>', page, re.S).group(1))
    return {figure["title"]: figure["pictures"] for figure in data["figures"]}


def picture(figures, title, which):
    """By number, or by the start of its name."""
    pictures = figures[title]
    chosen = pictures[which] if isinstance(which, int) else next(p for p in pictures if p["name"].startswith(which))
    return base64.b64decode(chosen["image"].split(",", 1)[1])


def make_sheets(lab):
    """Writes docs/images/talk_*.jpg from the studies of seed 1."""
    for name, (scene, kind, sheet) in SHEETS.items():
        figures = pictures_of((study(lab, scene, 1) / "index.html").read_text())
        with tempfile.TemporaryDirectory() as scratch:
            files = []
            for i, (title, which) in enumerate(sheet):
                files.append(pathlib.Path(scratch) / f"{i:02}.png")
                files[-1].write_bytes(picture(figures, title.format(map=kind), which))
            subprocess.run(["montage", *map(str, files), "-tile", "4x3", "-geometry", "160x120+2+2", "-quality", "60",
                            str(ROOT / f"docs/images/{name}.jpg")], check=True)
