"""A room lit by sun and sky through a window, as most rooms of houses are."""
import math

from . import furniture
from .furniture import moved, table, chair, vase
from .gltf_writer import GltfScene, diffuse, pane
from .masonry import carve
from .mesh import quad
from .textures import planks, write_png

NAME = "window"
WIDTH, DEPTH, HEIGHT, WALL = 4.6, 5.2, 2.7, 0.3
SILL, LINTEL, LEFT, RIGHT = 0.9, 2.35, -1.3, 1.1  # of the window, m; in the wall at x = -WIDTH / 2, along z
SUN_HEIGHT, SUN_TURN = 34.0, 28.0  # degrees above the horizon, and from the window's axis
SUN = (16.0, 14.4, 12.2)  # irradiance across its rays, W/m²
FACES = ("east", "west", "up", "down", "south", "north")


def build(folder):
    scene = GltfScene(NAME, __doc__)
    furniture.add_materials(scene)
    scene.material("White", diffuse((0.76, 0.75, 0.72)))
    scene.material("Floor", diffuse((1.0, 1.0, 1.0), "floor.png", 2.0))
    scene.material("Ground", diffuse((0.22, 0.24, 0.16)))
    scene.material("Pane", pane())
    write_png(folder / "floor.png", 256, planks(256, 8, (0.50, 0.36, 0.22), (0.30, 0.20, 0.11), 7, pieces=2))
    add_sky(scene, folder)
    scene.sun(SUN, (math.cos(math.radians(SUN_HEIGHT)) * math.cos(math.radians(SUN_TURN)),
                    -math.sin(math.radians(SUN_HEIGHT)),
                    -math.cos(math.radians(SUN_HEIGHT)) * math.sin(math.radians(SUN_TURN))))
    scene.camera((1.75, 1.5, 2.3), (-0.75, 0.95, -1.1), 55.0, 640, 480)
    add_room(scene)
    scene.add_sheet("Ground", "Ground", quad((-30.0, -0.5, 30.0), (60.0, 0, 0), (0, 0, -60.0)))
    scene.add_sheet("Pane", "Pane", quad((-WIDTH / 2 - WALL / 2, SILL, RIGHT), (0, 0, LEFT - RIGHT),
                                         (0, LINTEL - SILL, 0)))
    gap = 0.0005
    scene.add("Table", moved(table(1.3, 0.8, 0.74), (-0.5, gap, -0.9)))
    scene.add("Chair", moved(chair(), (0.25, gap, -0.2), 205.0))
    scene.add("Vase", moved(vase(0.09, 0.28), (-0.6, 0.74 + 2 * gap, -0.95)))
    return scene


def add_room(scene):
    half, deep = WIDTH / 2, DEPTH / 2
    room = ((-half, 0.0, -deep), (half, HEIGHT, deep))
    opening = ((-half - WALL, SILL, LEFT), (-half, LINTEL, RIGHT))
    block = ((-half - WALL, -0.2, -deep - WALL), (half + WALL, HEIGHT + 0.2, deep + WALL))
    scene.add("Room", carve(block, [room, opening],
                            lambda center, normal: "Floor" if normal[1] > 0 and center[1] == 0.0 else "White"))


def sky(direction):
    """Radiance: a blue dome, brighter towards the horizon; below it the ground."""
    up = direction[1]
    if up < 0.0:
        return (0.20, 0.20, 0.16)
    haze = (1.0 - up) ** 3
    return (0.30 + 0.60 * haze, 0.48 + 0.50 * haze, 0.85 + 0.15 * haze)


def add_sky(scene, folder):
    size = 32
    axes = (((1, 0, 0), (0, 0, 1), (0, -1, 0)), ((-1, 0, 0), (0, 0, -1), (0, -1, 0)),
            ((0, 1, 0), (-1, 0, 0), (0, 0, 1)), ((0, -1, 0), (-1, 0, 0), (0, 0, -1)),
            ((0, 0, 1), (-1, 0, 0), (0, -1, 0)), ((0, 0, -1), (1, 0, 0), (0, -1, 0)))
    for name, (forward, right, down) in zip(FACES, axes):
        def color_of(x, y, forward=forward, right=right, down=down):
            u, v = (2 * x + 1) / size - 1, (2 * y + 1) / size - 1
            direction = [f + u * r + v * d for f, r, d in zip(forward, right, down)]
            length = math.sqrt(sum(c * c for c in direction))
            return sky([c / length for c in direction])
        write_png(folder / f"sky_{name}.png", size, color_of)
    scene.image_light([f"sky_{name}.png" for name in FACES], 2.2)
