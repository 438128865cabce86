"""A room whose triangles and lights can be counted: the same walls, twelve round things on a floor and a table, a wall
that hides a part of it, and lights of which most are behind that wall."""
import math
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))
from generator.gltf_writer import GltfScene, diffuse, emitter  # noqa: E402
from generator.mesh import box, curve, lathe, merged, quad  # noqa: E402

WIDTH, HEIGHT, DEPTH = 5.0, 2.6, 3.6  # m
TABLE = (1.6, 0.74, 0.8)  # m
WATTS = 100.0
LIGHT_AREA = 0.25  # of all lights, m²
SEEN, HIDDEN = ((0.4, 2.9), (0.4, 3.2)), ((3.65, 4.7), (0.3, 2.0))  # where lights are, in x and z, m
LIGHT_COLOR = (1.0, 0.86, 0.68)
PLAIN_TRIANGLES = 60  # of walls, partition and table
PLACES = [  # kind, x, y, z
    ("ball", 0.6, 0.0, 0.8), ("ring", 1.5, 0.0, 0.6), ("vase", 2.4, 0.0, 0.5), ("ball", 2.7, 0.0, 1.6),
    ("ring", 0.6, 0.0, 1.9), ("vase", 0.3, 0.0, 2.8), ("ball", 1.3, 0.74, 1.4), ("ring", 1.7, 0.74, 1.3),
    ("vase", 2.1, 0.74, 1.45), ("ball", 4.2, 0.0, 0.8), ("ring", 3.9, 0.0, 1.8), ("vase", 4.6, 0.0, 2.8)]


def build(triangles, lights):
    """A GltfScene of about so many triangles, 600 at least, and two for each of so many square lights, of WATTS together."""
    scene = GltfScene("room", __doc__)
    for name, color in {"Wall": (0.72, 0.70, 0.66), "Left": (0.62, 0.30, 0.22), "Right": (0.28, 0.42, 0.60),
                        "Floor": (0.45, 0.33, 0.22), "Oak": (0.42, 0.26, 0.13), "ball": (0.70, 0.66, 0.58),
                        "ring": (0.20, 0.45, 0.25), "vase": (0.66, 0.50, 0.16)}.items():
        scene.material(name, diffuse(color))
    scene.camera((2.75, 1.6, 3.4), (1.45, 0.5, 0.9), 62.0, 640, 640)
    _add_walls(scene)
    _add_lights(scene, lights)
    _add_things(scene, max((triangles - PLAIN_TRIANGLES) / len(PLACES), 30))
    return scene


def _add_walls(scene):
    w, h, d = WIDTH, HEIGHT, DEPTH
    for name, material, sheet in (("Floor", "Floor", quad((0, 0, d), (w, 0, 0), (0, 0, -d))),
                                  ("Ceiling", "Wall", quad((0, h, 0), (w, 0, 0), (0, 0, d))),
                                  ("Back", "Wall", quad((0, 0, 0), (w, 0, 0), (0, h, 0))),
                                  ("Front", "Wall", quad((w, 0, d), (-w, 0, 0), (0, h, 0))),
                                  ("Left", "Left", quad((0, 0, d), (0, 0, -d), (0, h, 0))),
                                  ("Right", "Right", quad((w, 0, 0), (0, 0, d), (0, h, 0)))):
        scene.add_sheet(name, material, sheet)
    scene.add("Partition", {"Wall": box((0.1, h - 0.001, 2.2), (3.3, h / 2, 1.1005))})
    x, y, z = TABLE
    scene.add("Table", {"Oak": box((x, 0.04, z), (1.7, y - 0.021, 1.4))})
    for side in (-1, 1):
        scene.add("Support", {"Oak": box((0.05, y - 0.043, z - 0.1), (1.7 + side * (x / 2 - 0.1), (y - 0.041) / 2, 1.4))})


def _add_lights(scene, count):
    """Equal squares at random places under the ceiling: one in ten, the first too, before the partition."""
    side = math.sqrt(LIGHT_AREA / count)
    source = random.Random(count)
    sheets = []
    for k in range(count):
        (x0, x1), (z0, z1) = SEEN if k % 10 == 0 else HIDDEN
        x, z = source.uniform(x0, x1), source.uniform(z0, z1)
        sheets.append(quad((x - side / 2, HEIGHT - 0.01, z - side / 2), (side, 0, 0), (0, 0, side)))
    radiance = WATTS / (math.pi * LIGHT_AREA)
    scene.material("Light", emitter(tuple(round(radiance * c, 6) for c in LIGHT_COLOR)))
    scene.add_sheet("Light", "Light", merged(*sheets))


def _add_things(scene, triangles):
    """Each of about so many triangles."""
    meshes = {}
    for kind, x, y, z in PLACES:
        if kind not in meshes:
            meshes[kind] = scene.mesh(kind, {kind: _thing(kind, triangles)})
        scene.place(meshes[kind], (x, y + 0.001, z), name=f"{kind} at {x} {z}")


def _thing(kind, triangles):
    rows = max(3, round(math.sqrt(triangles / 2 / 1.5)))
    segments = max(5, round(triangles / 2 / rows))
    if kind == "ball":
        radius = 0.16
        profile = [(radius * math.sin(math.pi * k / rows), radius * (1 - math.cos(math.pi * k / rows))) for k in range(rows + 1)]
        return lathe([(0.0, 0.0)] + profile[1:-1] + [(0.0, 2 * radius)], segments, 100)
    if kind == "ring":
        angles = [2 * math.pi * k / rows for k in range(rows)]
        return lathe([(0.14 + 0.06 * math.cos(a), 0.06 + 0.06 * math.sin(a)) for a in angles], segments, 130, is_loop=True)
    outline = [(0.0, 0.0), (0.08, 0.0), (0.13, 0.15), (0.06, 0.34), (0.07, 0.42), (0.0, 0.42)]
    steps = max(1, round(rows / 3))
    return lathe([outline[0]] + curve(outline[1:-1], steps) + [outline[-1]], segments, 75)
