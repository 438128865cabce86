"""Furniture: functions that return {material name: Mesh}, standing on y = 0, centred, its front towards +z.

The materials they name are defined in `add_materials`; all are exactly Lambertian.
"""
import math
import random

from .gltf_writer import diffuse
from .mesh import Mesh, box, curve, cylinder, lathe, merged, rounded_box, sphere
from .vector import cross, normalize, sub

BOOKS = ["Book red", "Book blue", "Book green", "Book cream", "Book ochre"]


def add_materials(scene):
    for name, color in {
            "Oak": (0.42, 0.26, 0.13), "Walnut": (0.20, 0.11, 0.06), "Painted wood": (0.72, 0.70, 0.66),
            "Linen": (0.70, 0.66, 0.58), "Cushion": (0.62, 0.24, 0.10), "Sofa": (0.16, 0.27, 0.33),
            "Mattress": (0.78, 0.77, 0.74), "Blanket": (0.26, 0.36, 0.50), "Rug": (0.50, 0.18, 0.13),
            "Rug border": (0.62, 0.52, 0.38), "Ceramic": (0.76, 0.75, 0.72), "Terracotta": (0.52, 0.22, 0.12),
            "Leaf": (0.12, 0.30, 0.08), "Soil": (0.08, 0.05, 0.03), "Iron": (0.09, 0.09, 0.10),
            "Paper": (0.78, 0.74, 0.64), "Orange fruit": (0.75, 0.33, 0.04), "Apple": (0.50, 0.06, 0.04),
            "Book red": (0.45, 0.09, 0.07), "Book blue": (0.10, 0.18, 0.36), "Book green": (0.13, 0.28, 0.16),
            "Book cream": (0.66, 0.58, 0.42), "Book ochre": (0.55, 0.35, 0.08),
            "Picture sky": (0.35, 0.50, 0.62), "Picture field": (0.55, 0.48, 0.16),
            "Picture sun": (0.78, 0.42, 0.12)}.items():
        scene.material(name, diffuse(color))


def moved(parts, offset, turn_degrees=0.0):
    """The same object turned about y, then moved."""
    return {name: mesh.rotated("y", turn_degrees).moved(offset) for name, mesh in parts.items()}


def together(*objects):
    """One object out of several."""
    result = {}
    for parts in objects:
        for name, mesh in parts.items():
            result[name] = merged(result.get(name, Mesh()), mesh)
    return result


def table(width, depth, height, wood="Oak"):
    top = rounded_box((width, 0.035, depth), 0.008, (0, height - 0.0175, 0))
    rails = [box((width - 0.2, 0.07, 0.02), (0, height - 0.072, s * (depth / 2 - 0.08))) for s in (-1, 1)]
    rails += [box((0.02, 0.07, depth - 0.2), (s * (width / 2 - 0.08), height - 0.072, 0)) for s in (-1, 1)]
    leg = lathe([(0, 0), (0.018, 0), (0.030, height - 0.036), (0, height - 0.036)], 12)
    legs = [leg.moved((x * (width / 2 - 0.08), 0, z * (depth / 2 - 0.08))) for x in (-1, 1) for z in (-1, 1)]
    return {wood: merged(top, *rails, *legs)}


def round_table(radius, height, wood="Oak"):
    top = cylinder(radius, 0.03, 48, 0.006).moved((0, height - 0.03, 0))
    foot = lathe(curve([(0, 0.0), (0.62 * radius, 0.0), (0.60 * radius, 0.025), (0.10, 0.05), (0.045, 0.14),
                        (0.055, height * 0.6), (0.11, height - 0.031), (0, height - 0.031)], 3), 24, 50)
    return {wood: merged(top, foot)}


def chair(wood="Oak", seat="Linen"):
    legs = [rounded_box((0.035, 0.44, 0.035), 0.006, (s * 0.19, 0.22, 0.18)) for s in (-1, 1)]
    posts = [rounded_box((0.035, 0.92, 0.035), 0.006, (0, 0.46, 0)).rotated("x", -4).moved((s * 0.19, 0, -0.17))
             for s in (-1, 1)]
    frame = [box((0.38, 0.05, 0.02), (0, 0.40, 0.18)), box((0.38, 0.05, 0.02), (0, 0.40, -0.19))]
    frame += [box((0.02, 0.05, 0.36), (s * 0.19, 0.40, 0.0)) for s in (-1, 1)]
    slats = [rounded_box((0.37, 0.06, 0.016), 0.005, (0, y, -0.17 - 0.07 * y)) for y in (0.60, 0.72, 0.84)]
    cushion = rounded_box((0.42, 0.05, 0.40), 0.02, (0, 0.452, 0.0), 2)
    return {wood: merged(*legs, *posts, *frame, *slats), seat: cushion}


def sofa(width, cloth="Sofa", cushion="Cushion"):
    base = rounded_box((width, 0.22, 0.86), 0.03, (0, 0.22, 0), 2)
    back = rounded_box((width - 0.3, 0.48, 0.20), 0.07, (0, 0.58, -0.32), 3)
    arms = [rounded_box((0.18, 0.46, 0.86), 0.06, (s * (width / 2 - 0.09), 0.40, 0), 3) for s in (-1, 1)]
    count = max(1, round((width - 0.36) / 0.75))
    seat_width = (width - 0.36) / count
    seats = [rounded_box((seat_width - 0.01, 0.15, 0.66), 0.05, (seat_width * (k - (count - 1) / 2), 0.40, 0.08), 3)
             for k in range(count)]
    pillows = [rounded_box((0.42, 0.42, 0.13), 0.055, steps=3).rotated("x", -18).rotated("y", -s * 14).moved(
        (s * (width / 2 - 0.42), 0.69, -0.10)) for s in (-1, 1)]
    feet = [cylinder(0.025, 0.11, 12).moved((x * (width / 2 - 0.1), 0, z * 0.36)) for x in (-1, 1) for z in (-1, 1)]
    return {cloth: merged(base, back, *arms, *seats), cushion: merged(*pillows), "Walnut": merged(*feet)}


def bed(width):
    frame = rounded_box((width, 0.22, 2.05), 0.02, (0, 0.21, 0))
    head = rounded_box((width, 0.95, 0.06), 0.02, (0, 0.475, -1.04))
    mattress = rounded_box((width - 0.06, 0.18, 1.98), 0.05, (0, 0.40, 0), 2)
    blanket = rounded_box((width + 0.02, 0.14, 1.35), 0.05, (0, 0.45, 0.33), 2)
    count = 2 if width > 1.2 else 1
    pillows = [rounded_box((0.62, 0.15, 0.40), 0.065, steps=3).rotated("x", 12).moved(
        ((k - (count - 1) / 2) * 0.74, 0.57, -0.72)) for k in range(count)]
    return {"Oak": merged(frame, head), "Mattress": mattress, "Blanket": blanket, "Linen": merged(*pillows)}


def cupboard(width, height, depth, wood="Painted wood", doors=2):
    body = box((width, height - 0.08, depth), (0, 0.08 + (height - 0.08) / 2, 0))
    plinth = box((width - 0.06, 0.078, depth - 0.06), (0, 0.039, 0))
    leaf = (width - 0.02) / doors
    fronts = [rounded_box((leaf - 0.008, height - 0.12, 0.02), 0.005,
                          (leaf * (k - (doors - 1) / 2), 0.08 + (height - 0.08) / 2, depth / 2 + 0.0115))
              for k in range(doors)]
    knobs = [sphere(0.016, 2, (leaf * (k - (doors - 1) / 2) + (0.42 - 0.84 * (k % 2)) * leaf, height * 0.52,
                               depth / 2 + 0.037)) for k in range(doors)]
    return {wood: merged(body, plinth, *fronts), "Iron": merged(*knobs)}


def shelf(width, height, depth, boards, seed, vase_share=0.04, wood="Walnut"):
    """A book case filled with books, and in vase_share of the places a vase."""
    source = random.Random(seed)
    sides = [box((0.025, height, depth), (s * (width / 2 - 0.0125), height / 2, 0)) for s in (-1, 1)]
    back = box((width - 0.052, height - 0.02, 0.01), (0, height / 2, -depth / 2 + 0.006))
    gap = (height - 0.08) / (boards - 1)
    planes = [box((width - 0.052, 0.025, depth - 0.014), (0, 0.06 + gap * k, 0.006)) for k in range(boards)]
    result = {wood: merged(*sides, back, *planes)}
    for k in range(boards - 1):
        result = together(result, _books(width - 0.08, gap - 0.05, depth, 0.0735 + gap * k, source, vase_share))
    return result


def _books(width, room, depth, floor, source, vase_share):
    result, x = {}, -width / 2
    while x < width / 2 - 0.07:
        if source.random() < vase_share and x < width / 2 - 0.25:
            piece = vase(0.07, min(room * 0.8, 0.24), steps=3, segments=16)
            result = together(result, moved(piece, (x + 0.11, floor, 0.03)))
            x += 0.22
            continue
        thickness, tall = source.uniform(0.018, 0.05), room * source.uniform(0.62, 0.95)
        deep = depth * source.uniform(0.62, 0.8)
        cover = source.choice(BOOKS)
        center = (x + thickness / 2, floor + tall / 2, depth * 0.42 - deep / 2)
        book = {cover: box((thickness - 0.0015, tall, deep), center)}
        result = together(result, book)
        x += thickness
    return result


def vase(radius, height, material="Ceramic", steps=6, segments=24):
    outside = curve([(radius * 0.62, 0.0), (radius, height * 0.38), (radius * 0.45, height * 0.80),
                     (radius * 0.58, height)], steps)
    wall = 0.06 * radius
    inside = [(r - wall, max(y, wall)) for r, y in reversed(outside[:-1])]
    return {material: lathe([(0, 0)] + outside + [(outside[-1][0] - wall, height)] + inside + [(0, wall)], segments,
                            50)}


def bowl(radius, material="Ceramic"):
    outside = curve([(radius * 0.4, 0.0), (radius * 0.75, radius * 0.16), (radius, radius * 0.45)], 4)
    inside = [(r - 0.05 * radius, y + 0.03 * radius) for r, y in reversed(outside)]
    return {material: lathe([(0, 0)] + outside + inside + [(0, inside[-1][1])], 32, 50)}


def fruit_bowl(radius, subdivisions=2):
    fruit = [(0.38, 0.25, 0.20, "Orange fruit"), (-0.36, 0.25, 0.25, "Apple"), (0.05, 0.25, -0.42, "Orange fruit"),
             (0.02, 0.64, 0.06, "Apple")]
    pieces = [{material: sphere(0.34 * radius, subdivisions, (x * radius, (y + 0.16) * radius, z * radius))}
              for x, y, z, material in fruit]
    return together(bowl(radius), *pieces)


def plant(height, leaves, seed):
    """A potted plant: curved leaves, each a closed thin blade."""
    source = random.Random(seed)
    pot_height = 0.28 * height
    pot = lathe([(0, 0), (0.10 * height, 0), (0.14 * height, pot_height), (0.125 * height, pot_height),
                 (0.12 * height, 0.9 * pot_height), (0, 0.9 * pot_height)], 28)
    soil = cylinder(0.119 * height, 0.02, 28).moved((0, 0.9 * pot_height - 0.012, 0))
    blades = Mesh()
    for k in range(leaves):
        reach, rise = source.uniform(0.22, 0.42) * height, source.uniform(0.45, 0.75) * height
        angle = 360.0 * k / leaves + source.uniform(-18, 18)
        blades.append(_leaf(reach, rise, 0.055 * height).rotated("y", angle).moved((0, 0.9 * pot_height, 0)))
    return {"Terracotta": pot, "Soil": soil, "Leaf": blades}


def _leaf(reach, rise, width, steps=7, thickness=0.003):
    """A blade that rises and bends outwards along +z: a closed strip with a ridge."""
    mesh, rings = Mesh(), []
    for k in range(steps + 1):
        t = k / steps
        center = (0.0, rise * (t - 0.45 * t ** 3), reach * t * t)
        half = width * (0.25 + 0.75 * math.sin(math.pi * min(1.0, 0.15 + 0.85 * t))) * (1.0 - t ** 4) + 1e-3
        lift = 0.25 * half
        ring = [(-half, lift), (0.0, 0.0), (half, lift), (half, lift - thickness), (0.0, -thickness),
                (-half, lift - thickness)]
        rings.append([(center[0] + x, center[1] + y, center[2] - 0.3 * y) for x, y in ring])
    for near, far in zip(rings, rings[1:]):
        for i in range(6):
            j = (i + 1) % 6
            _flat_quad(mesh, near[j], near[i], far[i], far[j])
    for ring, is_start in ((rings[0], True), (rings[-1], False)):
        for a, b, c, d in ((0, 1, 4, 5), (1, 2, 3, 4)):
            corners = (ring[a], ring[b], ring[c], ring[d])
            _flat_quad(mesh, *(corners if is_start else corners[::-1]))
    return mesh


def _flat_quad(mesh, a, b, c, d):
    for p, q, r in ((a, b, c), (a, c, d)):
        normal = normalize(cross(sub(q, p), sub(r, p)))
        mesh.triangles.append(tuple(mesh.vertex(x, normal) for x in (p, q, r)))


def rug(width, depth):
    return {"Rug border": rounded_box((width, 0.010, depth), 0.003, (0, 0.006, 0)),
            "Rug": rounded_box((width - 0.24, 0.004, depth - 0.24), 0.001, (0, 0.0125, 0))}


def picture(width, height):
    """A framed landscape on a wall: its back at z = 0, its centre at the origin."""
    bar = 0.03
    bars = [rounded_box((width, bar, 0.025), 0.005, (0, s * (height - bar) / 2, 0.014)) for s in (-1, 1)]
    bars += [rounded_box((bar, height - 2 * bar - 0.001, 0.025), 0.005, (s * (width - bar) / 2, 0, 0.014))
             for s in (-1, 1)]
    inner_width, inner_height = width - 2 * bar - 0.002, height - 2 * bar - 0.002
    mount = box((inner_width, inner_height, 0.006), (0, 0, 0.005))
    sky = box((inner_width - 0.1, (inner_height - 0.1) * 0.6, 0.002), (0, (inner_height - 0.1) * 0.2, 0.0092))
    field = box((inner_width - 0.1, (inner_height - 0.1) * 0.4 - 0.002, 0.002),
                (0, -(inner_height - 0.1) * 0.3, 0.0092))
    sun = cylinder(0.09 * width, 0.002, 32).rotated("x", 90).moved((0.18 * width, 0.14 * height, 0.0105))
    return {"Walnut": merged(*bars), "Paper": mount, "Picture sky": sky, "Picture field": field, "Picture sun": sun}


def floor_lamp(height):
    """An unlit standard lamp with a paper shade."""
    foot = lathe([(0, 0), (0.14, 0), (0.14, 0.012), (0.012, 0.03), (0.012, height - 0.2), (0, height - 0.2)], 24)
    top, bottom, wall = 0.12, 0.19, 0.004
    shade = lathe([(bottom, height - 0.32), (top, height), (top - wall, height), (bottom - wall, height - 0.32)],
                  32, 30, is_loop=True)
    bulb = sphere(0.04, 2, (0, height - 0.17, 0))
    return {"Iron": foot, "Linen": shade, "Ceramic": bulb}


def ceiling_lamp(width, ceiling):
    """The housing of a quad light: its lower face 20 mm below the ceiling. The light hangs 5 mm lower."""
    return {"Painted wood": rounded_box((width + 0.06, 0.04, width + 0.06), 0.004, (0, ceiling, 0))}
