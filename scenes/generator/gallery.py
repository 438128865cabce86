"""Plain walls: a white room lit only by a strip hidden in a cove. Whatever is uneven on its walls is the renderer's."""
from .gltf_writer import GltfScene, diffuse, emitter
from .masonry import carve
from .mesh import box, quad, rounded_box, sphere

NAME = "gallery"
HALF_WIDTH, FRONT, BACK, HEIGHT = 3.0, -2.4, 2.8, 3.0
COVE_FLOOR, LIP_TOP = 2.60, 2.86       # heights, m
COVE_DEPTH, LIP = 0.30, 0.06           # of the recess behind the left wall, and of the lip that hides the strip


def build(_folder):
    scene = GltfScene(NAME, __doc__)
    scene.material("White", diffuse((0.78, 0.78, 0.77)))
    scene.material("Floor", diffuse((0.46, 0.44, 0.41)))
    scene.material("Stone", diffuse((0.62, 0.60, 0.56)))
    scene.material("Light", emitter((420.0, 385.0, 330.0)))
    scene.camera((0.7, 1.55, 2.45), (0.15, 1.5, -2.4), 50.0, 640, 480)
    add_room(scene)
    strip = (-HALF_WIDTH - COVE_DEPTH + 0.05, COVE_FLOOR + 0.01, BACK - 0.1)
    scene.add_sheet("Light", "Light", quad(strip, (0.05, 0, 0), (0, 0, FRONT - BACK + 0.2)))
    gap = 0.0005
    scene.add("Bench", {"Stone": rounded_box((1.6, 0.42, 0.45), 0.01, (-0.6, 0.21 + gap, -1.1))})
    scene.add("Plinth", {"White": box((0.4, 1.0, 0.4)).rotated("y", 25).moved((1.55, 0.5 + gap, -1.5))})
    scene.add("Ball", {"Stone": sphere(0.22, 4, (1.55, 1.2215, -1.5))})
    return scene


def add_room(scene):
    room = ((-HALF_WIDTH, 0.0, FRONT), (HALF_WIDTH, HEIGHT, BACK))
    recess = ((-HALF_WIDTH - COVE_DEPTH, COVE_FLOOR, FRONT), (-HALF_WIDTH - LIP, HEIGHT, BACK))
    opening = ((-HALF_WIDTH - LIP, LIP_TOP, FRONT), (-HALF_WIDTH, HEIGHT, BACK))
    block = ((-HALF_WIDTH - 0.6, -0.2, FRONT - 0.2), (HALF_WIDTH + 0.2, HEIGHT + 0.2, BACK + 0.2))
    scene.add("Room", carve(block, [room, recess, opening],
                            lambda center, normal: "Floor" if normal[1] > 0 and center[1] == 0.0 else "White"))
