"""References that errors are measured against, and their own error.

A reference is made by another way than what it judges: by paths where they find the light, else by very many photons
without sharing of light among pixels. It is the mean of two halves of different seeds and as many passes, each of one run or
more. The variance of that mean is a quarter of the halves' squared difference, which is the squared difference of one half
from it: that, as trimmed relMSE, is the own error. A bias that both halves share is not in it.
"""
import dataclasses
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

from .pages import fill_page

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIRST_SEED = 4000000000  # that no table and no test uses
PATHS = "--integrator path --gather 64 --max-depth 32"
# Lamps that are small behind glass or water are beyond a path tracer. So many photons that lookups blur nothing.
PHOTONS = "--photons 1000000 --gather 16 --indirect-filter off"
# In pool and ring the required density has steps, beside which lookups of the caustic map lose light: the same density is
# required everywhere (photons/m²).
# So are lamps whose light all comes through a slit.
DIM = "--photons 262144 --gather 64 --indirect-filter off"
WAYS = {"cornell_box": PATHS, "gallery": DIM, "rooms": PATHS, "door_slit": DIM,
        "glass_ball": PHOTONS, "glass_caustic": PHOTONS, "pool": PHOTONS + " --constant-density 40000",
        "ring": PHOTONS + " --constant-density 100000", "window": PATHS}
# In glass_caustic some fifty pixels see the lamp through glass in one path of ten thousand or fewer and are nineteen
# twentieths of the error: with 1,500 paths a pixel it was 0.0013, with 8,200 it was 0.0016. Its aim is out of reach here.
# So wide, the worst dozen are within the thousandth of the pixels that the trimmed error leaves out.
TABLE_WIDTHS = {scene: 96 for scene in WAYS} | {"glass_caustic": 128}
FIRST_PASSES = 4
GROWTH = 3  # a further run has so many times the passes so far, at most


@dataclasses.dataclass
class Purpose:
    """References for one use: the sizes, (width, height or None for the camera's), and the own error to be reached."""
    sizes: dict
    targets: dict
    images: str  # the file, by NAME

    def image(self, scene):
        return ROOT / self.images.replace("NAME", scene)


# Targets are a tenth of the least error that is judged.
PURPOSES = {
    "tables": Purpose({scene: (width, None) for scene, width in TABLE_WIDTHS.items()},
                      {"cornell_box": 3e-5, "gallery": 1e-4, "rooms": 5e-5, "door_slit": 2e-3, "glass_ball": 6e-5,
                       "glass_caustic": 2e-4, "pool": 2e-4, "ring": 7e-5, "window": 1e-4},
                      "build/references/tables/NAME.exr"),
    "stored": Purpose({scene: (128, 128) for scene in WAYS},
                      {"cornell_box": 1e-4, "gallery": 2e-4, "rooms": 2e-4, "door_slit": 5e-3, "glass_ball": 1e-4,
                       "glass_caustic": 5e-4, "pool": 5e-4, "ring": 2e-4, "window": 2e-4}, "scenes/NAME/reference.exr"),
    "calibration": Purpose({"cornell_box": (40, None), "rooms": (40, None), "ring": (40, None), "pool": (40, None),
                            "door_slit": (64, 64), "glass_caustic": (128, None)},
                           {"cornell_box": 1e-3, "rooms": 1e-3, "ring": 1e-3, "pool": 1e-3, "door_slit": 4e-3,
                            "glass_caustic": 2e-3}, "tests/data/calibration/NAME.exr"),
    "picture": Purpose({"door_slit": (400, 300)}, {"door_slit": 1e-2}, "build/references/picture/NAME.exr"),
}


def next_passes(done, error, target, pass_seconds, seconds_left):
    """Passes of a further run of each half: what the target asks for if noise falls as one over the passes, but no more
    than GROWTH times those that are done, nor than the time left allows. 0: none."""
    if error <= target:
        return 0
    wanted = min(done * (1.1 * error / target - 1), GROWTH * done)
    return max(int(min(wanted, seconds_left / (2 * pass_seconds))), 0)


def is_whole(run):
    """Whether a run was not stopped: its image and its statistics are there."""
    return run.exists() and run.with_suffix(".json").exists()


class Reference:
    def __init__(self, importon, purpose, scene):
        self.importon, self.scene, self.purpose = importon, scene, PURPOSES[purpose]
        self.target = self.purpose.targets[scene]
        self.image = self.purpose.image(scene)
        self.facts_file = self.image.with_suffix(".json")
        self.folder = ROOT / "build/references" / purpose / scene
        self.folder.mkdir(parents=True, exist_ok=True)

    def facts(self):
        return json.loads(self.facts_file.read_text()) if self.facts_file.exists() else None

    def call(self, *words):
        """What the program prints."""
        return subprocess.run([str(self.importon), *map(str, words)], check=True, stdout=subprocess.PIPE, text=True).stdout

    def options(self):
        width, height = self.purpose.sizes[self.scene]
        return f"{WAYS[self.scene]} --width {width}" + (f" --height {height}" if height else "")

    def runs(self):
        """Files of the runs that both halves have, as pairs."""
        pairs = [(self.folder / f"a{k}.exr", self.folder / f"b{k}.exr") for k in range(100)]
        return [pair for pair in pairs if all(is_whole(file) for file in pair)]

    def add(self, passes):
        """A further run of each half; where the last call was stopped between them, one that equals the first."""
        number = len(self.runs())
        for half in range(2):
            file = self.folder / f"{'ab'[half]}{number}.exr"
            if is_whole(file):
                passes = json.loads(file.with_suffix(".json").read_text())["image"]["passes"]
            else:
                self.call(ROOT / f"scenes/{self.scene}/{self.scene}.gltf", "-o", file, "-q", "--passes", passes, "--seed",
                          FIRST_SEED + 2 * number + half, *self.options().split(), "--stats", file.with_suffix(".json"))

    def mean(self, files, name):
        """The mean of the runs of a half, or of the halves."""
        if len(files) == 1:
            return files[0]
        try:
            self.call("merge", *files, "-o", self.folder / name)
        except subprocess.CalledProcessError:
            sys.exit(f"importon: error: runs do not belong together ({self.folder}): remove it, to begin anew")
        return self.folder / name

    def merge(self):
        """Merges what is there, and keeps what is known of it beside the image."""
        pairs = self.runs()
        halves = [self.mean([pair[i] for pair in pairs], f"{'ab'[i]}.exr") for i in range(2)]
        merged = self.mean(halves, "merged.exr")
        error = json.loads(self.call("compare", halves[0], merged, "--json"))["relmse_trimmed"]
        stats = [json.loads(file.with_suffix(".json").read_text()) for pair in pairs for file in pair]
        facts = {"options": self.options(), "seeds": [FIRST_SEED, FIRST_SEED + 2 * len(pairs) - 1],
                 "passes": sum(s["image"]["passes"] for s in stats), "seconds": sum(s["seconds"]["total"] for s in stats),
                 "own_error": error, "target": self.target}
        self.image.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(merged, self.image.with_suffix(".new"))
        os.replace(self.image.with_suffix(".new"), self.image)
        self.facts_file.write_text(json.dumps(facts, indent=2) + "\n")
        return facts

    def improve(self, seconds):
        """Adds runs until the own error is at most the target, for about so many seconds; returns the facts."""
        end = time.monotonic() + seconds
        if not self.runs():
            self.add(FIRST_PASSES)
        facts = self.merge()
        while True:
            done = facts["passes"] // 2
            passes = next_passes(done, facts["own_error"], self.target, facts["seconds"] / facts["passes"],
                                 end - time.monotonic())
            if passes == 0:
                return facts
            self.add(passes)
            facts = self.merge()


def reached(facts):
    """An own error of None is not known: an image of one run, that was not made here."""
    return facts["own_error"] is not None and facts["own_error"] <= facts["target"]


def table_of(purpose):
    """Rows for the references of a purpose that are there."""
    lines = ["| reference | options | passes | own error, trimmed relMSE | aim |", "| --- | --- | --- | --- | --- |"]
    for scene in PURPOSES[purpose].sizes:
        file = PURPOSES[purpose].image(scene).with_suffix(".json")
        if file.exists():
            facts = json.loads(file.read_text())
            is_known = facts["own_error"] is not None
            aim = f"{facts['target']:.0e}" + (", not reached" if is_known and not reached(facts) else "")
            error = f"{facts['own_error']:.2g}" if is_known else "not known"
            lines.append(f"| `{scene}` | `{facts['options']}` | {facts['passes']} | {error} | {aim} |")
    return "\n".join(lines)


def write_table(purpose):
    """Into the page that lists the references of a purpose, if there is one."""
    page = {"stored": ROOT / "scenes/README.md", "calibration": ROOT / "tests/data/calibration/README.md"}.get(purpose)
    if page:
        fill_page(page, "references", table_of(purpose))
