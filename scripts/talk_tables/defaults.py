"""What each default brings: error and processor time without it, over those with it."""
from .emission import EQUAL
from .lab import error_of, geometric, table, with_interval
from .storage import BOTH_MAPS

SCENES = ["rooms", "cornell_box", "door_slit", "glass_caustic", "ring", "pool"]
DEFAULTS = {"guided emission": (EQUAL, "--emission power"), "density control": (BOTH_MAPS, "--control off")}


def runs_of(lab, scene, options, seeds):
    """(error, processor seconds) by seed: against the reference of a project's scene; of a model, which has none, a seed's
    noise, half the trimmed relMSE to the next seed's image."""
    if scene in SCENES:
        return [(error_of(s), s["processor_seconds"]) for s in lab.over_seeds(scene, options, seeds)]
    runs = [lab.render(scene, options, seed) for seed in range(1, seeds + 1)]
    noise = lambda a, b: 0.5 * lab.compare(a["image_file"], b["image_file"])["relmse_trimmed"]
    return [(noise(a, runs[i - 1]), a["processor_seconds"]) for i, a in enumerate(runs)]


def gains(lab, seeds):
    """Rows of scenes, and of their geometric mean; products above 1 speak for the default."""
    rows, products = [], {name: [] for name in DEFAULTS}
    for scene in [*SCENES, *map(str, lab.models)]:
        row = [f"`{scene.split('/')[-1].split('.')[0]}`"]
        for name, (common, without) in DEFAULTS.items():
            default, other = (runs_of(lab, scene, options, seeds) for options in (common, f"{common} {without}"))
            error, time = ([a[i] / b[i] for a, b in zip(other, default)] for i in (0, 1))
            both = [e * t for e, t in zip(error, time)]
            products[name].append(geometric(both)[0])
            row += [f"{geometric(error)[0]:.2f}", f"{geometric(time)[0]:.2f}", with_interval(both)]
        rows.append(row)
    means = [geometric(values)[0] for values in products.values()]
    rows.append(["geometric mean", *[cell for mean in means for cell in ("", "", f"{mean:.2f}")]])
    return table(["scene", *[f"{name}: {what}" for name in DEFAULTS for what in ("error", "time", "product")]], rows)
