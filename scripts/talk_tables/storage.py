"""What density control saves, and what the required density of the caustic map is worth."""
from .lab import errors_text, ratio_text, table, with_spread

SCENES = ["rooms", "cornell_box", "door_slit", "glass_caustic", "ring", "pool"]
# Photons are read on both sides: with control, and all hits, the classical photon map.
BOTH_MAPS = "--gather-from photons --passes 2 --photons 524288"
CLASSICAL = "--control off"


def share(stats, maps):
    """Hits over photons stored, of both runs' maps together."""
    hits = sum(stats["photons"][m]["hits"] for m in maps)
    stored = sum(stats["photons"][m]["stored"] for m in maps)
    return hits / stored if stored else None


def fewer(runs, *maps):
    if not any(s["photons"][m]["hits"] for s in runs for m in maps):
        return ""
    return with_spread([share(s, maps) for s in runs])


def megabytes(runs):
    return with_spread([s["memory"]["photon_map_bytes"] / 1e6 for s in runs])


def control(lab, seeds):
    """Photons stored by density control and the error it adds to the classical map's; the default, cells, beside."""
    rows = []
    for scene in SCENES:
        off = lab.over_seeds(scene, f"{BOTH_MAPS} {CLASSICAL}", seeds)
        on = lab.over_seeds(scene, BOTH_MAPS, seeds)
        cells = lab.over_seeds(scene, BOTH_MAPS.replace("--gather-from photons ", ""), seeds)
        rows.append([f"`{scene}`", fewer(on, "global"), fewer(on, "caustic"), fewer(on, "global", "caustic"),
                     errors_text(off), ratio_text(on, off), ratio_text(cells, off), megabytes(off), megabytes(on),
                     megabytes(cells)])
    return table(["scene", "global map: times fewer", "caustic map", "both", "error, classical", "error with control, over it",
                  "cells, over it", "MB, classical", "MB, control", "MB, cells"], rows)


def caustic_density(lab, seeds):
    """The caustic map alone by its required density, M_r."""
    rows = []
    for scene in SCENES[3:]:
        off = lab.over_seeds(scene, f"{BOTH_MAPS} {CLASSICAL}", seeds)
        row = [f"`{scene}`"]
        for density in ("", " --caustic-density 10"):
            on = lab.over_seeds(scene, BOTH_MAPS + density, seeds)
            row += [fewer(on, "caustic"), ratio_text(on, off)]
        rows.append(row)
    return table(["scene", *[w for m in (20, 10) for w in (f"M_r = {m}: times fewer", "error")]], rows)
