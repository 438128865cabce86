"""Photons by power and guided ones: error at equal photons, and photons to equal error."""
import math

from .lab import error_of, errors_text, number, ratio_text, table, with_interval

SCENES = ["rooms", "cornell_box", "door_slit", "glass_caustic", "ring", "pool"]
EQUAL = "--passes 8 --photons 32768"
POTENTIAL = "--emission guided --guide-by potential --scatter guided"


def equal_photons(lab, seeds):
    """The default against emission by power, at equal photons a pass and at equal passes."""
    rows = []
    for scene in SCENES:
        power, default = (lab.over_seeds(scene, EQUAL + way, seeds) for way in (" --emission power", ""))
        rows.append([f"`{scene}`", errors_text(power), ratio_text(default, power)])
    return table(["scene", "error by power", "error by default, over it"], rows)


FORCED = {"`importance`": "--emission guided --guide-by importance", "`deficit`": "--emission guided",
          "`potential`, `--scatter guided`": POTENTIAL}


def guides(lab, seeds):
    """Guides of both maps, forced, against emission by power at equal photons: also where they cannot help."""
    rows = []
    for scene in ("rooms", "cornell_box", "door_slit"):
        power = lab.over_seeds(scene, EQUAL + " --emission power", seeds)
        rows.append([f"`{scene}`", *(ratio_text(lab.over_seeds(scene, f"{EQUAL} {way}", seeds), power)
                                     for way in FORCED.values())])
    return table(["scene", *FORCED], rows)


def lessons(stats):
    """Photons and importons that taught guides or were counted, and are in no map."""
    return stats["photons"]["pilot"]


def photons_at(curve, error):
    """Photons at which a falling curve of (photons, error) has an error, log-log between its points; None outside."""
    for (n0, e0), (n1, e1) in zip(curve, curve[1:]):
        if e0 >= error >= e1:
            part = math.log(e0 / error) / math.log(e0 / e1) if e0 > e1 else 0
            return n0 * (n1 / n0) ** part
    return None


def share_of_power(runs_by_photons, power, count):
    """Photons of the guided runs of a seed to the error of a run by power, over that run's. `count`: photons of a run."""
    curve = [(count(s), error_of(s)) for s in runs_by_photons]
    found = photons_at(curve, error_of(power))
    if found is None:
        return ("<" if error_of(power) > curve[0][1] else ">"), curve[0 if error_of(power) > curve[0][1] else -1][0] / count(power)
    return "", found / count(power)


def share_text(shares):
    """Geometric mean with its interval, or bounds where a curve does not reach the error."""
    if all(sign == "" for sign, _ in shares):
        return with_interval([value for _, value in shares])
    return ", ".join(f"{sign} {value:.2f}".strip() for sign, value in shares)


LEVELS = [(8, 131072, (8192, 16384, 32768))]  # passes, photons a pass by power and guided ones
WAYS = {"`deficit`": "--emission guided", "`potential`, `--scatter guided`": POTENTIAL}


def equal_error(lab, seeds):
    """Photons in `rooms` to the error of emission by power, without and with the lessons."""
    rows = []
    for passes, most, counts in LEVELS:
        power = lab.over_seeds("rooms", f"--passes {passes} --photons {most} --emission power", seeds)
        for name, way in WAYS.items():
            runs = [lab.over_seeds("rooms", f"--passes {passes} --photons {n} {way}", seeds) for n in counts]
            by_seed = list(zip(*runs))
            plain = [share_of_power(r, p, lambda s: s["photons"]["emitted"]) for r, p in zip(by_seed, power)]
            full = [share_of_power(r, p, lambda s: s["photons"]["emitted"] + lessons(s)) for r, p in zip(by_seed, power)]
            rows.append([f"{passes} × {number(most)}", errors_text(power), name, share_text(plain), share_text(full)])
    return table(["passes × photons by power", "its error", "guided by", "share of power's photons", "lessons counted"], rows)
