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


def compiling(programs):
    """What the driver's compiler costs for each kernel: milliseconds, the most first, in the scene of the least
    features and in one of glass."""
    scenes, runs = (["cornell_box"], 1) if programs.is_small else (["cornell_box", "glass_ball"], 5)
    words = ["--passes", 1, "--width", 16, "--height", 16, "--photons", 100]
    columns = []
    for scene in scenes:
        with tempfile.TemporaryDirectory() as cache:
            environment = {"MESA_SHADER_CACHE_DIR": cache}
            cold = programs.render(scene, words, environment)["kernels"]
            found = [programs.render(scene, words, environment)["kernels"] for _ in range(runs)]
        of = lambda kernels, key: {kernel["label"]: kernel[key] for kernel in kernels}
        handed = [of(kernels, "compile_ms") for kernels in found]
        warm = [of(kernels, "total_ms") for kernels in found]
        first = of(cold, "total_ms")
        columns.append({label: (statistics.median(times.get(label, 0) for times in handed),
                                max(first[label] - statistics.median(times.get(label, 0) for times in warm), 0))
                        for label in first})
    labels = sorted(set().union(*columns), key=lambda label: -sum(sum(column.get(label, (0, 0))) for column in columns))
    figures = lambda label: (f"{ms:.1f}" for column in columns for ms in column.get(label, (0, 0)))
    heads = [f"{scene}, {part}" for scene in scenes for part in ("handed over", "machine code")]
    shown = [[label, *figures(label)] for label in labels if max(map(float, figures(label))) >= 5]
    sums = [f"{sum(column[label][part] for label in column):.0f}" for column in columns for part in (0, 1)]
    return table(["kernel", *heads], [*shown, ["all", *sums]])
