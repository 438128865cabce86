"""Memory and time with and without density control, by the photons of a pass."""
from talk_tables.lab import Lab, number, table

from .figure import plot

MIB = 1 << 20
SCENE, WIDTH, PASSES, SEED = "rooms", 64, 1, 1
PHOTONS = [100_000, 1_000_000, 10_000_000]
# Where gather rays read, what is kept there, and the options for it.
WAYS = [("cells", "first of a cell", "--gather-from cells"),
        ("photons", "as many as required", "--gather-from photons --control density"),
        ("photons", "all", "--gather-from photons --control off --memory 4096")]  # as many as the device can bind
LIMIT = 5  # times that maps of all photons are larger than controlled ones, at the most photons


def measure(options, folder):
    lab = Lab(options.importon, folder / "renders", WIDTH)
    device = f" --device {options.device}" if options.device else ""
    rows = []
    for photons in [n // 100 for n in PHOTONS] if options.small else PHOTONS:
        for source, kept, words in WAYS:
            stats = lab.render(SCENE, f"--passes {PASSES} --photons {photons} {words}{device}", SEED)
            hits = stats["photons"]["global"]
            rows.append({"source": source, "kept": kept, "photons": photons, "hits": hits["hits"], "stored": hits["stored"],
                         "maps": stats["memory"]["photon_map_bytes"], "device": stats["memory"]["device_peak_bytes"],
                         "processor": stats["processor_seconds"],
                         "is_full": any(w["kind"] == "photon map full" for w in stats["warnings"])})
    return {"device": stats["device"], "rows": rows}


def text(found):
    rows = found["rows"]
    cells = [[r["source"], r["kept"], number(r["photons"]), number(r["hits"]),
              "more than fit" if r["is_full"] else number(r["stored"]), f"{r['maps'] / MIB:.1f}", f"{r['device'] / MIB:.0f}",
              f"{r['processor']:.1f}"] for r in rows]
    head = ["gathers read", "kept", "photons", "hits", "stored", "maps, MiB", "device, MiB", "processor, s"]
    most = {r["kept"]: r for r in rows[-len(WAYS):]}
    free, controlled = most["all"], most["as many as required"]
    ratio = lambda key: free[key] / controlled[key]
    says = "holds" if ratio("maps") >= LIMIT else "does not hold"
    lines = [table(head, cells), "",
             f"Limit: with control, maps of {number(free['photons'])} photons take at most 1/{LIMIT} of the memory. They take "
             f"{ratio('maps'):.1f} times less: it {says}. Of the whole device's peak it is {ratio('device'):.1f} times."]
    if free["is_full"]:
        fits = [r for r in rows if r["kept"] == "all" and not r["is_full"]][-1]
        needed = free["hits"] * fits["maps"] / fits["stored"] / MIB
        lines += ["", f"More than fit: all hits would need some {number(needed)} MiB, which is more than kernels of this device "
                      f"can bind. The map grew to {free['maps'] / MIB:.0f} MiB; then the pass began again, with control."]
    lines += ["", f"On {found['device']['name']}, {found['device']['driver']}."]
    return "\n".join(lines)


def figure(found):
    curve = lambda source, kept: [(r["photons"], r["maps"] / MIB) for r in found["rows"]
                                  if (r["source"], r["kept"]) == (source, kept)]
    return plot([(f"{source}: {kept}", curve(source, kept)) for source, kept, _ in WAYS], [], "photons of a pass", "MiB of maps")
