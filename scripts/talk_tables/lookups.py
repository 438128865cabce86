"""How many photons a lookup reads; required density by other light."""
from .lab import error_of, number, table, with_interval, with_spread

GLOBAL, CAUSTIC = ["rooms"], ["glass_caustic", "ring", "pool"]
NUMBERS = [5, 8, 20, 80]


def sweep(lab, seeds):
    """Error, and mean over the reference's, by the number of photons of a lookup."""
    rows = []
    for scene in GLOBAL + CAUSTIC:
        source = "--gather-from photons " if scene in GLOBAL else ""
        row = [f"`{scene}`", "global" if scene in GLOBAL else "caustic"]
        for count in NUMBERS:
            runs = lab.over_seeds(scene, f"{source}--passes 2 --photons 262144 --lookup-photons {count}", seeds)
            means = [lab.compare(s["image_file"], lab.reference(scene))["mean_ratio"] for s in runs]
            row.append(f"{with_spread([error_of(s) for s in runs], 2)}; {sum(means) / len(means):.3f}")
        rows.append(row)
    return table(["scene", "map", *map(str, NUMBERS)], rows)


def other_light(lab, seeds):
    """Required density of the caustic map that knows all other light, and that knows directions."""
    rows = []
    for scene in CAUSTIC:
        common = "--passes 4 --photons 400000"
        plain = lab.over_seeds(scene, common, seeds)
        known = lab.over_seeds(scene, common + " --required-density contribution", seeds)
        stored = lambda runs: sum(s["photons"]["caustic"]["stored"] for s in runs) / len(runs)
        rows.append([f"`{scene}`", number(stored(plain)), number(stored(known)), with_spread([error_of(s) for s in plain]),
                     with_interval([error_of(a) / error_of(b) for a, b in zip(known, plain)])])
    return table(["scene", "caustic photons stored", "with other light", "error", "with other light, over it"], rows)
