"""How lookups read the maps: how many photons, irradiance computed before, required density by other light."""
from .emission import EQUAL
from .lab import errors_text, number, ratio_text, table, with_spread

CAUSTIC = ["glass_caustic", "ring", "pool"]
NUMBERS = ["8", "20", "80"]


def mean_ratios(lab, scene, runs):
    return with_spread([s["error"]["mean_ratio"] for s in runs])


def sweep(lab, seeds):
    """Error, and mean over the reference's, by the number of photons of a lookup."""
    rows = []
    for scene in ("rooms", "ring"):
        row = [f"`{scene}`"]
        for count in NUMBERS:
            runs = lab.over_seeds(scene, f"--gather-from photons --passes 2 --photons 262144 --lookup-photons {count}", seeds)
            row.append(f"{errors_text(runs, 2)}; {mean_ratios(lab, scene, runs)}")
        rows.append(row)
    return table(["scene", *NUMBERS], rows)


def irradiance(lab, seeds):
    """Irradiance read where it was computed before, at photons or importons, against lookups of the same map."""
    rows = []
    for scene in ("cornell_box", "rooms", "door_slit"):
        plain = lab.over_seeds(scene, f"{EQUAL} --gather-from photons", seeds)
        row = [f"`{scene}`"]
        for place in ("photons", "importons"):
            runs = lab.over_seeds(scene, f"{EQUAL} --gather-from photons --irradiance {place}", seeds)
            row.append(with_spread([a["error"]["mean_ratio"] / b["error"]["mean_ratio"] for a, b in zip(runs, plain)]))
        rows.append(row)
    return table(["ratio of means", "photons", "importons"], rows)


def other_light(lab, seeds):
    """Required density of the caustic map that knows all other light."""
    rows = []
    for scene in CAUSTIC:
        common = "--passes 2 --photons 524288"
        plain, known = (lab.over_seeds(scene, common + way, seeds) for way in ("", " --required-density contribution"))
        stored = lambda runs: number(sum(s["photons"]["caustic"]["stored"] for s in runs) / len(runs))
        rows.append([f"`{scene}`", stored(plain), stored(known), errors_text(plain), ratio_text(known, plain)])
    return table(["scene", "caustic photons stored", "with other light", "error", "with other light, over it"], rows)
