"""Renders for the tables of the documentation: each is kept in a folder, so that a second call goes on, and no render is
made twice. Means over seeds come with 95 % intervals (Student)."""
import hashlib
import json
import math
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
REFERENCE_SEED = 4294967295
# Options of a scene's reference: caustics of small lights are beyond a path tracer, and need so many photons that lookups
# blur nothing.
CAUSTIC = "--photons 1000000 --gather 16 --passes 16"
REFERENCES = {"cornell_box": "--integrator path --passes 2000", "rooms": "--integrator path --passes 1600",
              "door_slit": "--passes 400"}
# Quantiles of Student's distribution, 97.5 %, by degrees of freedom.
STUDENT = [None, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145]


class Lab:
    def __init__(self, importon, folder, width):
        self.importon, self.folder, self.width = importon, pathlib.Path(folder), width
        self.folder.mkdir(parents=True, exist_ok=True)

    def scene_file(self, scene):
        """A scene of the project by its name, or any file."""
        return scene if scene.endswith((".gltf", ".glb")) else str(ROOT / f"scenes/{scene}/{scene}.gltf")

    def render(self, scene, options, seed, reference=None):
        """Statistics of a render (the file that --stats writes), with `processor_seconds`. `reference`: an image."""
        words = [*options.split(), "--width", str(self.width), "--seed", str(seed)]
        key = hashlib.sha1(" ".join([scene, str(reference or ""), *words]).encode()).hexdigest()[:20]
        image, stats = self.folder / f"{key}.exr", self.folder / f"{key}.json"
        if not stats.exists():
            known = ["--reference", str(reference)] if reference else []
            with tempfile.TemporaryDirectory() as scratch:
                new = pathlib.Path(scratch) / "stats.json"
                before = os.times()
                subprocess.run([str(self.importon), self.scene_file(scene), "-o", str(image), "--stats", str(new), "-q",
                                *words, *known], check=True)
                after = os.times()
                result = json.loads(new.read_text())
            result["processor_seconds"] = (after.children_user + after.children_system -
                                           before.children_user - before.children_system)
            stats.write_text(json.dumps(result))
        result = json.loads(stats.read_text())
        result["image_file"] = str(image)
        return result

    def reference(self, scene):
        """The image that errors are measured against: many passes, without sharing of light among pixels."""
        options = REFERENCES.get(scene, CAUSTIC) + " --indirect-filter off"
        return self.render(scene, options, REFERENCE_SEED)["image_file"]

    def over_seeds(self, scene, options, seeds):
        """Statistics by seeds 1 to `seeds`, with errors against the scene's reference."""
        reference = self.reference(scene)
        return [self.render(scene, options, seed, reference) for seed in range(1, seeds + 1)]

    def compare(self, image, reference):
        """What `importon compare` says of an image against another."""
        found = subprocess.run([str(self.importon), "compare", image, reference, "--json"], check=True,
                               capture_output=True, text=True)
        return json.loads(found.stdout)


def error_of(stats):
    return stats["error"]["relmse_trimmed"]


def mean_and_half(values):
    """Mean, and half of its 95 % interval (None of one value)."""
    n = len(values)
    mean = sum(values) / n
    if n < 2:
        return mean, None
    variance = sum((v - mean) ** 2 for v in values) / (n - 1)
    return mean, STUDENT[n - 1] * math.sqrt(variance / n)


def geometric(values):
    """Geometric mean with its 95 % interval: (mean, low, high)."""
    mean, half = mean_and_half([math.log(v) for v in values])
    half = half or 0
    return math.exp(mean), math.exp(mean - half), math.exp(mean + half)


def number(value, digits=3):
    """With thousands separated from 100 on, else so many digits."""
    if abs(value) >= 100:
        return f"{value:,.0f}"
    return f"{value:.{digits}g}"


def with_spread(values, digits=3):
    """Mean ± half of its 95 % interval."""
    mean, half = mean_and_half(values)
    return number(mean, digits) + (f" ± {number(half, 2)}" if half else "")


def with_interval(values):
    """Geometric mean (low … high)."""
    mean, low, high = geometric(values)
    return f"{mean:.2f} ({low:.2f} … {high:.2f})"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| --- " * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])
