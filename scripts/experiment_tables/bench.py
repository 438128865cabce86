"""Tables made from importon_bench, whose counters are explained in bench/."""
from experiment_tables.programs import SCENES
from talk_tables.lab import number, table


def scene_names(programs):
    return ["cornell_box"] if programs.is_small else SCENES + ["height_field"]


def any_of(names):
    return f"({'|'.join(names)})"


def ratio(counters, key="ratio"):
    """A ratio to Embree; a dash where Embree is missing or the device is a GPU."""
    return f"{counters[key]:.2f}" if key in counters else "–"


def traversal(programs):
    names = scene_names(programs)
    found = programs.bench(f"(closest_hit|any_hit)/{any_of(names)}")
    rows = []
    for name in names:
        closest, shadow = found[f"closest_hit/{name}"], found[f"any_hit/{name}"]
        rates = [cell for run in (closest, shadow) for cell in (f"{run['Mrays/s']:.1f}", ratio(run))]
        rows.append([name, number(closest["triangles"]), *rates])
    return table(["scene", "triangles", "closest, Mrays/s", "of Embree's", "any hit, Mrays/s", "of Embree's"], rows)


def building(programs):
    names = scene_names(programs)
    found = programs.bench(f"build/{any_of(names)}")
    rows = []
    for name in names:
        run = found[f"build/{name}"]
        embree = f"{run['Embree_ms']:.3g}" if "Embree_ms" in run else "–"
        rows.append([name, number(run["triangles"]), f"{run['median_ms']:.3g}", embree, ratio(run),
                     ratio(run, "processor_ratio"), f"{run['bytes/triangle']:.0f}"])
    return table(["scene", "triangles", "ms", "Embree, ms", "ratio", "of processor time", "bytes a triangle"], rows)


def cutting(programs):
    """Scenes in which triangles are cut, as they are or turned."""
    names = scene_names(programs)
    found = programs.bench(f"cutting/{any_of(names)}(_turned)?")
    rows, same = [], []
    for name, run in found.items():
        scene = name.split("/")[1].replace("_turned", ", turned")
        if run["is_same_tree"]:
            same.append(scene)
        else:
            rows.append([scene, f"{run['records']:.2f}", f"{run['closest']:.2f}", f"{run['any_hit']:.2f}"])
    parts = [table(["scene", "records of the tree", "time of closest hits", "time of any hits"], rows)] if rows else []
    parts += [f"The same tree: {'; '.join(same)}."] if same else []
    return "\n\n".join(parts)


def lights(programs):
    counts = [100, 1000] if programs.is_small else [100, 1000, 10_000, 100_000, 1_000_000]
    found = programs.bench("lights/" + any_of(map(str, counts)))
    rows = [[number(count), f"{run['relative_noise']:.2g}", f"{run['shade_ms_per_pass']:.2g}"]
            for count, run in ((count, found[f"lights/{count}"]) for count in counts)]
    return table(["triangles", "noise of one sample", "shading, ms a pass"], rows)


def features(programs):
    found = programs.bench("renderBox/path_.*" if programs.is_small else "renderBox/.*")
    rows = [[name.split("/")[1].replace("_", ", "),
             *(f"{run[counter]:.0f}" for counter in ("kernel_ms_per_pass", "start_ms", "device_MiB"))]
            for name, run in found.items()]
    return table(["", "kernels, ms a pass", "start, ms", "device memory, MiB"], rows)
