"""What each default brings: error and processor time without it, over those with it."""
from .emission import EQUAL
from .lab import error_of, geometric, is_floor, table, with_interval
from .storage import BOTH_MAPS, CLASSICAL

SCENES = ["rooms", "cornell_box", "door_slit", "glass_caustic", "ring", "pool"]
# Name: (options of both, options without the default). Density control is judged where its photons are read.
DEFAULTS = {"guided emission": (EQUAL, "--emission power"), "camera paths by noise": (EQUAL, "--adaptive-samples off"),
            "sharing among pixels": (EQUAL, "--indirect-filter off"), "surface cells": (EQUAL, "--gather-from photons"),
            "density control": (BOTH_MAPS, CLASSICAL)}


def runs_of(lab, scene, options, seeds):
    """Runs by seed: with errors against the reference of a project's scene; of a model, which has none, a seed's noise, half
    the trimmed relMSE to the next seed's image."""
    if scene in SCENES:
        return lab.over_seeds(scene, options, seeds)
    runs = [lab.render(scene, options, seed) for seed in range(1, seeds + 1)]
    for i, run in enumerate(runs):
        noise = 0.5 * lab.compare(run["image_file"], runs[i - 1]["image_file"])["relmse_trimmed"]
        run["error"] = {"relmse_trimmed": noise, "own_of_reference": 0}
    return runs


def gain(lab, scene, common, without, seeds):
    """(geometric mean of error times time without the default over with it, the cell: error × time = their product)."""
    default, other = (runs_of(lab, scene, options, seeds) for options in (common, f"{common} {without}"))
    error = [error_of(a) / error_of(b) for a, b in zip(other, default)]
    time = [a["processor_seconds"] / b["processor_seconds"] for a, b in zip(other, default)]
    both = [e * t for e, t in zip(error, time)]
    star = " \\*" if is_floor(default) or is_floor(other) else ""
    return geometric(both)[0], f"{geometric(error)[0]:.2f}{star} × {geometric(time)[0]:.2f} = {with_interval(both)}"


def gains(lab, seeds):
    """Rows of scenes, and of their geometric mean; products above 1 speak for the default."""
    rows, products = [], {name: [] for name in DEFAULTS}
    for scene in [*SCENES, *map(str, lab.models)]:
        row = [f"`{scene.split('/')[-1].split('.')[0]}`"]
        for name, (common, without) in DEFAULTS.items():
            mean, text = gain(lab, scene, common, without, seeds)
            products[name].append(mean)
            row.append(text)
        rows.append(row)
    rows.append(["geometric mean", *[f"{geometric(values)[0]:.2f}" for values in products.values()]])
    return table(["scene", *DEFAULTS], rows)
