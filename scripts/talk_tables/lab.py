"""Renders for the tables of the documentation: each is kept in a folder, so that a second call goes on, and no render is
made twice. Means over seeds come with 95 % intervals (Student)."""
import hashlib
import json
import math
import os
import pathlib
import subprocess

from .references import Reference, ROOT, TABLE_WIDTHS

# Quantiles of Student's distribution, 97.5 %, by degrees of freedom.
STUDENT = [None, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145]
NOT_KNOWN = "not known"
FLOOR = 10  # times the reference's own error, below which an error is only an upper bound
FLOOR_NOTE = ("\\* The reference's own error is more than a tenth of one of the two errors: the true ratio is further "
              "from 1.")


class Lab:
    def __init__(self, importon, folder, width=96, reference_seconds=300):
        self.importon, self.folder, self.width = importon, pathlib.Path(folder), width
        self.reference_seconds, self.references, self.models = reference_seconds, {}, []
        self.folder.mkdir(parents=True, exist_ok=True)

    def scene_file(self, scene):
        """A scene of the project by its name, or any file."""
        return scene if scene.endswith((".gltf", ".glb")) else str(ROOT / f"scenes/{scene}/{scene}.gltf")

    def render(self, scene, options, seed):
        """Statistics of a render (the file that --stats writes), with `processor_seconds` and `image_file`."""
        words = [*options.split(), "--width", str(TABLE_WIDTHS.get(scene, self.width)), "--seed", str(seed)]
        key = hashlib.sha1(" ".join([scene, *words]).encode()).hexdigest()[:20]
        image, stats, new = (self.folder / f"{key}.{end}" for end in ("exr", "json", "new"))
        if not stats.exists():
            before = os.times()
            subprocess.run([str(self.importon), self.scene_file(scene), "-o", str(image), "--stats", str(new), "-q", *words],
                           check=True)
            after = os.times()
            result = json.loads(new.read_text())
            result["processor_seconds"] = (after.children_user + after.children_system -
                                           before.children_user - before.children_system)
            new.write_text(json.dumps(result))
            new.rename(stats)
        return {**json.loads(stats.read_text()), "image_file": str(image)}

    def reference(self, scene):
        """The image that errors are measured against, and its own error; made if there is none yet."""
        if scene not in self.references:
            reference = Reference(self.importon, "tables", scene)
            facts = reference.facts() or reference.improve(self.reference_seconds)
            self.references[scene] = reference.image, facts["own_error"]
        return self.references[scene]

    def over_seeds(self, scene, options, seeds):
        """Statistics by seeds 1 to `seeds`, with errors against the scene's reference."""
        image, own_error = self.reference(scene)
        runs = [self.render(scene, options, seed) for seed in range(1, seeds + 1)]
        for run in runs:
            run["error"] = {**self.compare(run["image_file"], image), "own_of_reference": own_error}
        return runs

    def compare(self, image, reference):
        """What `importon compare` says of an image against another."""
        found = subprocess.run([str(self.importon), "compare", str(image), str(reference), "--json"], check=True,
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


def is_known(mean, low, high):
    """Within a factor of two."""
    return mean / 2 <= low and high <= 2 * mean


def with_spread(values, digits=3):
    """Mean ± half of its 95 % interval."""
    mean, half = mean_and_half(values)
    if half and not is_known(mean, mean - half, mean + half):
        return NOT_KNOWN
    return number(mean, digits) + (f" ± {number(half, 2)}" if half else "")


def with_interval(values):
    """Geometric mean (low … high)."""
    mean, low, high = geometric(values)
    return f"{mean:.2f} ({low:.2f} … {high:.2f})" if is_known(mean, low, high) else NOT_KNOWN


def is_floor(runs):
    """Whether the own error of the reference is more than a tenth of the mean error of the runs."""
    return mean_and_half([error_of(s) for s in runs])[0] < FLOOR * runs[0]["error"]["own_of_reference"]


def errors_text(runs, digits=3):
    """Mean error ± half of its interval; an upper bound where the reference is no better."""
    errors = [error_of(s) for s in runs]
    return f"< {number(mean_and_half(errors)[0], digits)}" if is_floor(runs) else with_spread(errors, digits)


def ratio_text(runs, others):
    """Errors of runs over those of others, seed by seed; with a star where the reference is no better (FLOOR_NOTE)."""
    text = with_interval([error_of(a) / error_of(b) for a, b in zip(runs, others)])
    return text + (" \\*" if text != NOT_KNOWN and (is_floor(runs) or is_floor(others)) else "")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| --- " * len(head) + "|"]
    text = "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])
    return text + (f"\n\n{FLOOR_NOTE}" if "\\*" in text else "")
