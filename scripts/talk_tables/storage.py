"""What density control saves, and what the required density of the caustic map is worth."""
from .lab import error_of, table, with_interval, with_spread

SCENES = ["rooms", "cornell_box", "door_slit", "glass_caustic", "ring", "pool"]
BOTH_MAPS = "--gather-from photons --passes 2 --photons 524288"


def share(stats, maps):
    """Hits over photons stored, of both runs' maps together."""
    hits = sum(stats["photons"][m]["hits"] for m in maps)
    stored = sum(stats["photons"][m]["stored"] for m in maps)
    return hits / stored if stored else None


def fewer(runs, *maps):
    if not any(s["photons"][m]["hits"] for s in runs for m in maps):
        return ""
    return with_spread([share(s, maps) for s in runs])


def control(lab, seeds):
    """Photons stored by density control, and the error it adds."""
    rows = []
    for scene in SCENES:
        off = lab.over_seeds(scene, BOTH_MAPS + " --control off", seeds)
        on = lab.over_seeds(scene, BOTH_MAPS, seeds)
        rows.append([f"`{scene}`", fewer(on, "global"), fewer(on, "caustic"), fewer(on, "global", "caustic"),
                     with_spread([error_of(s) for s in off]),
                     with_interval([error_of(a) / error_of(b) for a, b in zip(on, off)])])
    return table(["scene", "global map: times fewer", "caustic map", "both", "error of all hits",
                  "error with control, over it"], rows)


def caustic_density(lab, seeds):
    """The caustic map alone by its required density, M_r."""
    rows = []
    for scene in SCENES[3:]:
        common = "--passes 2 --photons 524288 "
        off = lab.over_seeds(scene, common + "--control off", seeds)
        row = [f"`{scene}`"]
        for density in ("", "--caustic-density 10", "--caustic-density 5"):
            on = lab.over_seeds(scene, common + density, seeds)
            row += [fewer(on, "caustic"), with_interval([error_of(a) / error_of(b) for a, b in zip(on, off)])]
        rows.append(row)
    return table(["scene", *[w for m in (20, 10, 5) for w in (f"M_r = {m}: times fewer", "error")]], rows)
