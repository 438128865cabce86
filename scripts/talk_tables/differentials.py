"""Importance by the footprints of paths, against the density of importons."""
from .emission import EQUAL
from .lab import errors_text, number, ratio_text, table

BOUNDS = {"screen": "--importance differentials --differential-bound screen",
          "pixel": "--importance differentials --differential-bound pixel"}


def stored(runs, kind):
    """Photons a pass, in thousands."""
    if not any(s["photons"][kind]["stored"] for s in runs):
        return ""
    return number(sum(s["photons"][kind]["stored"] / s["image"]["passes"] for s in runs) / len(runs) / 1e3)


def bounds(lab, seeds):
    """Photons stored and error; gathers read photons in all three."""
    rows = []
    for scene in ("rooms", "door_slit", "pool", "ring"):
        common = f"{EQUAL} --gather-from photons"
        runs = [lab.over_seeds(scene, f"{common} {way}".strip(), seeds) for way in ("", *BOUNDS.values())]
        rows.append([f"`{scene}`", *(" / ".join(stored(r, kind) or "–" for r in runs) for kind in ("caustic", "global")),
                     errors_text(runs[0]), *(ratio_text(r, runs[0]) for r in runs[1:])])
    return table(["scene", "caustic photons a pass, thousands: map / screen / pixel", "global photons", "error, map",
                  "screen, over it", "pixel, over it"], rows)
