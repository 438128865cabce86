"""Tables made from what --stats writes."""
import statistics
import tempfile

from experiment_tables.programs import SCENES
from talk_tables.lab import table

# Columns of the table of kernels, by labels of the statistics. What stands in none is "the rest".
GROUPS = {
    "closest hits": {"trace closest"},
    "shadow rays": {"trace shadow"},
    "camera paths": {"eye emit", "eye scatter", "eye light", "film add"},
    "photons": {"photon emit", "photon emit guided", "photon scatter", "caustic scatter", "photon scatter guided"},
    "storing": {"cell find", "cell claim", "photon store", "cell settle", "cell add", "photon key", "photon resolve",
                "cell move", "flux sum"},
    "lookups": {"map lookup"},
    "cells": {"irradiance add", "cell group", "cell smooth"},
    "lists": {"set counter", "add counter", "compact count", "compact scatter", "scan", "record select", "sort count",
              "sort scatter", "grid cells", "grid points", "fill"},
    "importance": {"importon emit", "importon scatter", "importon count", "importon level", "importon entries",
                   "importon points", "importon key", "importon density", "importon resolve", "hit count",
                   "guide learn"},
}


def kernels(programs):
    """Shares of the time of all kernels, by what they do."""
    scenes = ["cornell_box"] if programs.is_small else SCENES
    side, passes = (32, 2) if programs.is_small else (256, 12)
    programs.render(scenes[0], ["--passes", 1, "--width", 16, "--height", 16])  # fills the driver's cache
    rows = []
    for scene in scenes:
        stats = programs.render(scene, ["--passes", passes, "--width", side, "--height", side])
        times = {kernel["label"]: kernel["total_ms"] / 1e3 for kernel in stats["kernels"]}
        all_kernels, seconds = sum(times.values()), stats["seconds"]["total"]
        shares = [sum(times.get(label, 0) for label in labels) / all_kernels for labels in GROUPS.values()]
        shares.append(1 - sum(shares))
        rows.append([scene, f"{seconds:.1f}", f"{all_kernels / seconds:.2f}", *(f"{share:.2f}" for share in shares)])
    return table(["scene", "s", "in kernels", *GROUPS, "the rest"], rows)


def start_up(programs):
    """Seconds of the least render, with the driver's cache of machine code warm and empty."""
    scenes, runs = (["cornell_box"], 1) if programs.is_small else (SCENES, 5)
    words = ["--passes", 1, "--width", 16, "--height", 16, "--photons", 100]
    rows = []
    for scene in scenes:
        with tempfile.TemporaryDirectory() as cache:
            cold = programs.render(scene, words, {"MESA_SHADER_CACHE_DIR": cache})["seconds"]["total"]
            found = [programs.render(scene, words, {"MESA_SHADER_CACHE_DIR": cache})["seconds"] for _ in range(runs)]
        median = lambda phase: statistics.median(seconds[phase] for seconds in found)
        phases = [median(phase) for phase in ("total", "load", "bvh", "device", "importance", "photons", "gather")]
        rows.append([scene, *(f"{seconds:.2f}" for seconds in phases), f"{cold:.2f}"])
    head = ["scene", "s in all", "reading", "tree", "device", "importance", "photons", "camera paths",
            "in all, cache empty"]
    return table(head, rows)
