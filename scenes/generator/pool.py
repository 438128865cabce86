"""A basin of wavy water under one distant light: caustics on the floor, seen through the water."""
import math

from . import furniture
from .gltf_writer import GltfScene, diffuse, emitter, glass
from .masonry import carve
from .mesh import Mesh, grid, rounded_box, sphere
from .ring import light_quad
from .textures import tiles, write_png
from .vector import normalize

NAME = "pool"
HALF_X, HALF_Z, DEPTH = 2.2, 1.5, 1.3  # of the basin, m
LEVEL = -0.10                          # of the water
OVERLAP = 0.03                         # the water reaches into the walls by this much, so that no gap is left
# (amplitude m, wavelength m, direction degrees, phase)
WAVES = [(0.0130, 1.30, 20, 0.3), (0.0090, 0.95, 75, 1.9), (0.0065, 0.70, -35, 4.1), (0.0045, 0.52, 110, 2.2),
         (0.0030, 0.43, 50, 5.0), (0.0022, 0.36, -80, 0.9)]


def build(folder):
    scene = GltfScene(NAME, __doc__)
    write_png(folder / "tiles.png", 256, tiles(256, 8, (0.42, 0.68, 0.76), (0.18, 0.42, 0.56), (0.70, 0.72, 0.70), 5))
    furniture.add_materials(scene)
    scene.material("Basin", diffuse((1.0, 1.0, 1.0), "tiles.png", 1.2))
    scene.material("Stone", diffuse((0.52, 0.48, 0.42)))
    scene.material("Coping", diffuse((0.66, 0.64, 0.60)))
    scene.material("Water", glass(1.33, (0.55, 0.85, 0.92), 4.0))
    scene.material("Light", emitter((3600.0, 3450.0, 3150.0)))
    scene.camera((0.7, 2.35, 3.1), (-0.05, -0.72, 0.0), 46.0, 640, 480)
    add_basin(scene)
    scene.add("Water", {"Water": water(136, 92)})
    scene.add("Red ball", {"Apple": sphere(0.20, 4, (0.95, -DEPTH + 0.2005, 0.15))})
    scene.add("Yellow ball", {"Book ochre": sphere(0.12, 3, (0.45, -DEPTH + 0.1205, 0.62))})
    scene.add_sheet("Light", "Light", light_quad((-3.2, 7.9, -2.9), (0.0, 0.0, 0.0), 0.3))
    return scene


def add_basin(scene):
    steps = [((-HALF_X + 0.35 * k, -0.30 * (k + 1), -HALF_Z), (-HALF_X + 0.35 * (k + 1), 0.0, HALF_Z))
             for k in range(3)]
    deep = ((-HALF_X + 1.05, -DEPTH, -HALF_Z), (HALF_X, 0.0, HALF_Z))

    def material_of(center, _normal):
        is_inside = abs(center[0]) <= HALF_X and abs(center[2]) <= HALF_Z and center[1] > -DEPTH - 0.1
        return "Basin" if is_inside else "Stone"

    scene.add("Ground", carve(((-7.0, -DEPTH - 0.4, -7.0), (7.0, 0.0, 7.0)), steps + [deep], material_of))
    bar, rise = 0.32, 0.05
    long_bar = rounded_box((2 * HALF_X + 2 * bar, rise, bar), 0.015, steps=2)
    short_bar = rounded_box((bar, rise, 2 * HALF_Z - 0.004), 0.015, steps=2)
    for s in (-1, 1):
        scene.add("Coping", {"Coping": long_bar.moved((0, rise / 2 + 0.0005, s * (HALF_Z + bar / 2)))})
        scene.add("Coping", {"Coping": short_bar.moved((s * (HALF_X + bar / 2), rise / 2 + 0.0005, 0))})


def height(x, z):
    """Height of the water above its level, and its slopes along x and z."""
    y = slope_x = slope_z = 0.0
    for amplitude, wavelength, degrees, phase in WAVES:
        k = 2.0 * math.pi / wavelength
        kx, kz = k * math.cos(math.radians(degrees)), k * math.sin(math.radians(degrees))
        angle = kx * x + kz * z + phase
        y += amplitude * math.sin(angle)
        slope_x += amplitude * kx * math.cos(angle)
        slope_z += amplitude * kz * math.cos(angle)
    return y, slope_x, slope_z


def water(columns, rows):
    """The body of water: a wavy top, sides and bottom hidden in the walls and the floor of the basin."""
    half_x, half_z, bottom = HALF_X + OVERLAP, HALF_Z + OVERLAP, -DEPTH - OVERLAP

    def surface(i, j):
        x, z = half_x * (2.0 * i / columns - 1.0), half_z * (1.0 - 2.0 * j / rows)
        y, slope_x, slope_z = height(x, z)
        return (x, LEVEL + y, z), normalize((-slope_x, 1.0, -slope_z)), (x, z)

    mesh = grid(columns, rows, surface)
    border = ([(i, 0) for i in range(columns)] + [(columns, j) for j in range(rows)]
              + [(i, rows) for i in range(columns, 0, -1)] + [(0, j) for j in range(rows, 0, -1)])
    rim = [surface(i, j)[0] for i, j in border]
    mesh.append(_skirt(rim, bottom))
    return mesh


def _skirt(rim, bottom):
    """Walls from a closed rim, counter-clockwise seen from above, down to a flat bottom."""
    mesh = Mesh()
    center = mesh.vertex((0.0, bottom, 0.0), (0.0, -1.0, 0.0))
    for p, q in zip(rim, rim[1:] + rim[:1]):
        p_low, q_low = (p[0], bottom, p[2]), (q[0], bottom, q[2])
        outward = normalize((p[2] - q[2], 0.0, q[0] - p[0]))
        a, b, c, d = (mesh.vertex(x, outward) for x in (p_low, q_low, q, p))
        mesh.triangles += [(a, b, c), (a, c, d)]
        e, f = mesh.vertex(p_low, (0.0, -1.0, 0.0)), mesh.vertex(q_low, (0.0, -1.0, 0.0))
        mesh.triangles.append((center, f, e))
    return mesh
