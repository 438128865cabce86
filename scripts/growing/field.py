"""A field of stones: few meshes, each in many places, turned, and of different sizes, under a sky and a sun."""
import math
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))
from generator.gltf_writer import GltfScene, diffuse  # noqa: E402
from generator.mesh import grid, quad, without_degenerate  # noqa: E402
from generator.vector import normalize  # noqa: E402

SKY = (0.8, 1.0, 1.3)  # W/(m² sr)
SPACING = 1.2  # m


def build(meshes, triangles, instances):
    """A GltfScene of so many stones, of as many meshes, each of about so many triangles."""
    scene = GltfScene("field", __doc__)
    side = math.ceil(math.sqrt(instances))
    half = SPACING * side / 2
    scene.material("Ground", diffuse((0.35, 0.33, 0.28)))
    scene.add_sheet("Ground", "Ground", quad((-half, 0, half), (2 * half, 0, 0), (0, 0, -2 * half)))
    ids = []
    for kind in range(meshes):
        scene.material(f"Stone {kind}", diffuse((0.3 + 0.1 * kind % 0.4, 0.5 - 0.06 * kind, 0.35)))
        ids.append(scene.mesh(f"stone {kind}", {f"Stone {kind}": _stone(triangles, kind)}, is_closed=False))
    source = random.Random(1)
    for k in range(instances):
        turn, size = source.uniform(0, 360), source.uniform(0.6, 1.2)
        x, z = (SPACING * (at + 0.5 + source.uniform(-0.2, 0.2)) - half for at in (k % side, k // side))
        scene.place(ids[k % meshes], (x, 0.0, z), turn, f"stone {k}")
        scene.json["nodes"][-1]["scale"] = [round(size, 6), round(size * source.uniform(0.8, 1.25), 6), round(size, 6)]
    scene.camera((0.0, 3.0, 0.9 * half), (0.0, 0.0, 0.9 * half - 7), 50.0, 128, 128)
    scene.json["scenes"][0]["extras"] = {"environment": {"type": "constant", "radiance": list(SKY)}}
    return scene


def _stone(triangles, seed):
    rows = max(4, round(math.sqrt(triangles) / 2))
    source = random.Random(seed)
    waves = [(source.randint(1, 6), source.randint(1, 6), source.uniform(0, 6.28), source.uniform(0.01, 0.05)) for _ in range(5)]

    def vertex(i, j):
        around, up = 2 * math.pi * i / (2 * rows), math.pi * j / rows
        radius = 0.4 * (1 + math.sin(up) ** 2 * sum(a * math.sin(m * around + n * up + p) for m, n, p, a in waves))
        direction = (math.sin(up) * math.sin(around), -math.cos(up), math.sin(up) * math.cos(around))
        return tuple(radius * c for c in direction), normalize(direction), (0.0, 0.0)

    return without_degenerate(grid(2 * rows, rows, vertex, closes_u=True))


if __name__ == "__main__":
    build(int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])).write(pathlib.Path(sys.argv[4]))
