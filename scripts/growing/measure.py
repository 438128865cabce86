"""Renders of a series of scenes, and the time that each takes to an error that all of them reach."""
import math
import subprocess
from dataclasses import dataclass

from talk_tables.lab import Lab

from . import room

SMALL = 128  # pixels wide, where the series is not of sizes
LONG_SEEDS = (4294967294, 4294967295)  # of the two halves of a reference


@dataclass
class Member:
    """One scene of a series at one size."""
    value: int  # what grows
    triangles: int
    lights: int
    width: int


@dataclass
class Curve:
    """Error (trimmed relMSE) and seconds since the start after each pass."""
    member: Member
    errors: list
    seconds: list
    finish: float  # seconds that sharing of light and writing the image take at the end
    stats: dict

    def start_up(self):
        """What the first pass takes more than a later one, s."""
        return max(self.seconds[0] - (self.seconds[-1] - self.seconds[0]) / (len(self.seconds) - 1), 0)

    def time_to(self, error):
        """Seconds to the error, the end of the render counted; log-linear between passes."""
        for k, found in enumerate(self.errors):
            if found <= error:
                if k == 0:
                    return self.seconds[0] + self.finish
                t0, t1 = self.seconds[k - 1], self.seconds[k]
                share = math.log(self.errors[k - 1] / error) / math.log(self.errors[k - 1] / found)
                return t0 * (t1 / t0) ** share + self.finish
        return math.inf


class Bench:
    def __init__(self, options):
        self.options, self.folder = options, options.folder
        self.device = f" --device {options.device}" if options.device else ""

    def scene(self, triangles, lights):
        folder = self.folder / f"scenes/{triangles}_triangles_{lights}_lights"
        if not (folder / "room.gltf").exists():
            room.build(triangles, lights).write(folder)
        return str(folder / "room.gltf")

    def render(self, member, words, seed, reference=None):
        lab = Lab(self.options.importon, self.folder / "renders", member.width)
        known = f" --reference {reference}" if reference else ""
        return lab.render(self.scene(member.triangles, member.lights), words + known + self.device, seed)

    def reference(self, member, passes):
        """A long render without sharing of light, in two halves: the image, and the noise that is left in it."""
        lab = Lab(self.options.importon, self.folder / "renders", member.width)
        halves = [self.render(member, f"--passes {passes} --indirect-filter off", seed)["image_file"] for seed in LONG_SEEDS]
        merged = halves[0].replace(".exr", "_merged.exr")
        subprocess.run([str(self.options.importon), "merge", *halves, "-o", merged], check=True, capture_output=True)
        return merged, lab.compare(*halves)["relmse_trimmed"] / 4

    def curves(self, members, passes, reference_passes, seeds):
        """Of each member. Without reference_passes the error is noise alone: half of the difference of two seeds."""
        words = f"--passes {passes}"
        plain = [self.render(member, words, 1) for member in members]
        references = [self.reference(m, reference_passes) if reference_passes else (p["image_file"], None)
                      for m, p in zip(members, plain)]
        # In turns, so that what else the machine does meets all members alike.
        runs = [[self.render(m, words, seed, image) for m, (image, _) in zip(members, references)]
                for seed in range(2, 2 + seeds)]
        return [self.curve(member, plain[k], [turn[k] for turn in runs], references[k][1])
                for k, member in enumerate(members)]

    @staticmethod
    def curve(member, plain, runs, noise):
        steps = [run["error"]["passes"] for run in runs]
        mean = lambda key, k: sum(step[k][key] for step in steps) / len(steps)
        errors = [mean("relmse_trimmed", k) for k in range(len(steps[0]))]
        noise = errors[-1] / 2 if noise is None else noise
        least = [min(step[k]["seconds"] for step in steps) for k in range(len(errors))]  # other programs only add
        seconds = plain["seconds"]
        phases = sum(seconds[name] for name in ("load", "bvh", "device", "importance", "cells", "photons", "gather"))
        return Curve(member, [max(e - noise, 1e-9) for e in errors], least,
                     max(seconds["total"] - phases, 0), plain)


def common_error(curves):
    """The least error that all of them reach."""
    return max(curve.errors[-1] for curve in curves) * 1.0001
