"""Keller and Wald's hard case: the only light is in the next room, and the door is open by a slit."""
from . import furniture
from .gltf_writer import GltfScene, diffuse, emitter
from .masonry import carve
from .mesh import cylinder, quad, rounded_box, sphere
from .textures import planks, write_png

NAME = "door_slit"
HEIGHT, DOOR_HEIGHT = 2.6, 2.05
WALL = 0.2                # thickness of the wall between the rooms, from x = 0 to x = WALL
DOOR_Z = (-0.95, -0.05)   # the doorway, m
DOOR_ANGLE = 10.0         # degrees
GAP = 0.04                # between the closed leaf and the jamb, m


def build(folder):
    scene = GltfScene(NAME, __doc__)
    write_png(folder / "floor.png", 512, planks(512, 8, (0.50, 0.33, 0.19), (0.30, 0.17, 0.08), 3, pieces=1))
    furniture.add_materials(scene)
    scene.material("Floor", diffuse((1.0, 1.0, 1.0), "floor.png", 1.28))
    scene.material("Wall", diffuse((0.72, 0.70, 0.66)))
    scene.material("Wall of the lit room", diffuse((0.74, 0.66, 0.52)))
    scene.material("Ceiling", diffuse((0.80, 0.80, 0.79)))
    scene.material("Door", diffuse((0.62, 0.60, 0.55)))
    scene.material("Light", emitter((17000.0, 16000.0, 14000.0)))
    scene.camera((-3.7, 1.5, 1.45), (-0.9, 0.95, -0.55), 56.0, 640, 480)
    add_rooms(scene)
    add_furniture(scene)
    side = 0.3
    corner = (1.7 - side / 2, HEIGHT - 0.025, -0.5 - side / 2)
    scene.add_sheet("Light", "Light", quad(corner, (side, 0, 0), (0, 0, side)))
    scene.add("Lamp", furniture.moved(furniture.ceiling_lamp(side, HEIGHT), (1.7, 0, -0.5)))
    return scene


def add_rooms(scene):
    dark, lit = ((-4.0, 0.0, -2.0), (0.0, HEIGHT, 2.0)), ((WALL, 0.0, -2.0), (4.2, HEIGHT, 2.0))
    doorway = ((0.0, 0.0, DOOR_Z[0]), (WALL, DOOR_HEIGHT, DOOR_Z[1]))

    def material_of(center, normal):
        if normal[1]:
            return "Floor" if normal[1] > 0 and center[1] == 0.0 else "Ceiling"
        return "Wall of the lit room" if center[0] > WALL / 2 else "Wall"

    block = ((-4.2, -0.2, -2.2), (4.4, HEIGHT + 0.2, 2.2))
    scene.add("Rooms", carve(block, [dark, lit, doorway], material_of))
    add_door(scene)


def add_door(scene):
    """The leaf turns inside the depth of the wall, about its edge at the far jamb. It reaches 5 mm into the jamb,
    the floor and the lintel, so that light passes at its free edge only."""
    width, thickness = DOOR_Z[1] - DOOR_Z[0] - GAP, 0.036
    leaf = rounded_box((thickness, DOOR_HEIGHT + 0.01, width + 0.005), 0.003,
                       (0, DOOR_HEIGHT / 2, (width - 0.005) / 2))
    handle = cylinder(0.011, 0.05, 16, 0.002).rotated("z", 90).moved((-thickness / 2, 1.02, width - 0.08))
    knob = sphere(0.028, 3, (-thickness / 2 - 0.062, 1.02, width - 0.08))
    hinge = (0.022, 0.0, DOOR_Z[0])
    for name, material, mesh in (("Door", "Door", leaf), ("Door spindle", "Iron", handle), ("Door knob", "Iron", knob)):
        scene.place(scene.mesh(name, {material: mesh}), hinge, DOOR_ANGLE)


def add_furniture(scene):
    gap = 0.0005
    scene.add("Rug", furniture.moved(furniture.rug(1.9, 1.6), (-1.85, gap, -0.2)))
    scene.add("Table", furniture.moved(furniture.round_table(0.45, 0.72), (-1.9, 0.016, -0.35)))
    scene.add("Bowl with fruit", furniture.moved(furniture.fruit_bowl(0.13), (-1.86, 0.7368, -0.38)))
    scene.add("Chair", furniture.moved(furniture.chair(), (-2.42, 0.016, -0.62), 62))
    scene.add("Book case", furniture.moved(furniture.shelf(1.1, 1.9, 0.30, 6, 11), (-2.9, gap, -1.845)))
    scene.add("Plant", furniture.moved(furniture.plant(1.25, 15, 5), (-0.45, gap, -1.5)))
    scene.add("Picture", furniture.moved(furniture.picture(0.8, 0.55), (-1.45, 1.62, -1.9995)))
    scene.add("Ball", {"Cushion": sphere(0.17, 4, (-0.75, 0.1705, 0.75))})
    scene.add("Crate", {"Painted wood": rounded_box((0.38, 0.38, 0.38), 0.01, (0, 0.1905, 0)).rotated("y", 33).moved(
        (-0.42, 0, 1.25))})
    scene.add("Cupboard", furniture.moved(furniture.cupboard(1.2, 0.9, 0.42, "Walnut"), (3.9, gap, 0.6), -90))
    scene.add("Armchair", furniture.moved(furniture.sofa(1.3), (2.6, gap, 1.45), 180))
