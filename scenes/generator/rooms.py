"""The talk's global-map figure: a flat of twelve lit rooms, of which the camera sees a corner of one."""
from . import furniture
from .furniture import moved
from .gltf_writer import GltfScene, diffuse, emitter
from .masonry import carve
from .mesh import quad
from .textures import planks, write_png

NAME = "rooms"
WIDTHS, DEPTHS = (4.4, 3.2, 4.0, 3.2), (3.6, 4.2, 3.4)  # of the columns of rooms (x) and the rows (z), m
WALL, OUTER_WALL, HEIGHT = 0.15, 0.3, 2.6
DOOR_WIDTH, DOOR_HEIGHT = 0.9, 2.05
LIGHT = 0.5  # side of a ceiling light, m
GAP = 0.0005
# Doorways between neighbours: (column, row, 'x' or 'z' for the neighbour's direction, offset from the middle).
DOORWAYS = [(0, 0, "x", 0.6), (1, 0, "x", -0.5), (2, 0, "x", 0.7), (0, 1, "x", 0.9), (1, 1, "x", 0.6),
            (2, 1, "x", -0.8), (0, 2, "x", -0.7), (1, 2, "x", 0.6), (2, 2, "x", 0.2), (1, 0, "z", 0.4),
            (3, 0, "z", -0.6), (0, 1, "z", 1.2), (1, 1, "z", -0.6), (2, 1, "z", 0.9), (2, 0, "z", -0.9)]
WALL_COLORS = {(0, 0): (0.60, 0.66, 0.58), (1, 0): (0.66, 0.70, 0.72), (2, 0): (0.70, 0.58, 0.50),
               (3, 0): (0.72, 0.68, 0.46), (0, 1): (0.70, 0.67, 0.60), (1, 1): (0.72, 0.71, 0.68),
               (2, 1): (0.68, 0.50, 0.40), (3, 1): (0.62, 0.70, 0.66), (0, 2): (0.56, 0.62, 0.70),
               (1, 2): (0.72, 0.66, 0.66), (2, 2): (0.52, 0.60, 0.50), (3, 2): (0.70, 0.70, 0.70)}


def build(folder):
    scene = GltfScene(NAME, __doc__)
    write_png(folder / "floor.png", 512, planks(512, 8, (0.52, 0.36, 0.21), (0.34, 0.20, 0.10), 3))
    furniture.add_materials(scene)
    scene.material("Floor", diffuse((1.0, 1.0, 1.0), "floor.png", 1.28))
    scene.material("Ceiling", diffuse((0.80, 0.80, 0.79)))
    scene.material("Outside", diffuse((0.5, 0.5, 0.5)))
    scene.material("Light", emitter((100.0, 90.0, 74.0)))
    for (column, row), color in WALL_COLORS.items():
        scene.material(f"Wall {column} {row}", diffuse(color))
    x, z = origin(0, 1)
    scene.camera((x + 3.95, 1.5, z + 3.9), (x + 1.25, 0.93, z + 0.85), 50.0, 640, 480)
    add_masonry(scene)
    add_lights(scene)
    furnish(scene)
    return scene


def origin(column, row):
    """The corner of a room with least x and z, on its floor."""
    return (OUTER_WALL + sum(WIDTHS[:column]) + WALL * column, OUTER_WALL + sum(DEPTHS[:row]) + WALL * row)


def all_rooms():
    return [(column, row) for row in range(len(DEPTHS)) for column in range(len(WIDTHS))]


def room_box(column, row):
    x, z = origin(column, row)
    return (x, 0.0, z), (x + WIDTHS[column], HEIGHT, z + DEPTHS[row])


def doorway(column, row, direction, offset):
    (x0, _, z0), (x1, _, z1) = room_box(column, row)
    if direction == "x":
        middle = 0.5 * (z0 + z1) + offset
        return (x1, 0.0, middle - DOOR_WIDTH / 2), (x1 + WALL, DOOR_HEIGHT, middle + DOOR_WIDTH / 2)
    middle = 0.5 * (x0 + x1) + offset
    return (middle - DOOR_WIDTH / 2, 0.0, z1), (middle + DOOR_WIDTH / 2, DOOR_HEIGHT, z1 + WALL)


def add_masonry(scene):
    def material_of(center, normal):
        if not (0.0 <= center[1] <= HEIGHT):
            return "Outside"
        if normal[1] > 0:
            return "Floor"
        if normal[1] < 0:
            return "Ceiling"
        x, z = center[0] + 0.01 * normal[0], center[2] + 0.01 * normal[2]
        for column, row in all_rooms():
            (x0, _, z0), (x1, _, z1) = room_box(column, row)
            if x0 <= x <= x1 and z0 <= z <= z1:
                return f"Wall {column} {row}"
        is_jamb = OUTER_WALL < x < size[0] - OUTER_WALL and OUTER_WALL < z < size[1] - OUTER_WALL
        return "Painted wood" if is_jamb else "Outside"

    last = room_box(len(WIDTHS) - 1, len(DEPTHS) - 1)[1]
    size = (last[0] + OUTER_WALL, last[2] + OUTER_WALL)
    holes = [room_box(*room) for room in all_rooms()] + [doorway(*d) for d in DOORWAYS]
    scene.add("Masonry", carve(((0.0, -0.2, 0.0), (size[0], HEIGHT + 0.2, size[1])), holes, material_of))


def add_lights(scene):
    half = LIGHT / 2
    lamp = scene.mesh("Lamp", furniture.ceiling_lamp(LIGHT, 0.0))
    light = scene.mesh("Light", {"Light": quad((-half, -0.025, -half), (LIGHT, 0, 0), (0, 0, LIGHT))}, is_closed=False)
    for column, row in all_rooms():
        x, z = origin(column, row)
        center = (x + WIDTHS[column] / 2, HEIGHT, z + DEPTHS[row] / 2)
        scene.place(lamp, center, name=f"Lamp {column} {row}")
        scene.place(light, center, name=f"Light {column} {row}")


class Furnisher:
    """Places objects by room, in metres from the room's corner; each kind is stored once."""

    def __init__(self, scene):
        self.scene = scene
        self.meshes = {}

    def put(self, room, name, make, x, z, turn=0.0, height=GAP):
        if name not in self.meshes:
            self.meshes[name] = self.scene.mesh(name, make())
        corner = origin(*room)
        self.scene.place(self.meshes[name], (corner[0] + x, height, corner[1] + z), turn)


def furnish(scene):
    put = Furnisher(scene).put
    furnish_living_room(put)
    furnish_kitchen_and_dining_room(put)
    furnish_bedrooms(put)
    furnish_other_rooms(put)


def furnish_living_room(put):
    room = (0, 1)
    put(room, "Sofa", lambda: furniture.sofa(2.1), 1.95, 0.48)
    put(room, "Rug", lambda: furniture.rug(2.2, 1.5), 1.95, 1.75)
    put(room, "Coffee table", lambda: furniture.round_table(0.48, 0.42, "Walnut"), 1.95, 1.70, height=0.016)
    put(room, "Bowl with fruit", lambda: furniture.fruit_bowl(0.15), 1.86, 1.66, height=0.4368)
    put(room, "Book on the table", lambda: moved({"Book red": furniture.rounded_box((0.16, 0.025, 0.22), 0.002)},
                                                 (0, 0.0126, 0)), 2.2, 1.78, 25, 0.4205)
    put(room, "Book case", lambda: furniture.shelf(1.3, 2.0, 0.30, 6, 4), 0.16, 2.05, 90)
    put(room, "Plant", lambda: furniture.plant(1.35, 17, 9), 0.45, 0.55)
    put(room, "Floor lamp", lambda: furniture.floor_lamp(1.65), 3.35, 0.38)
    put(room, "Picture", lambda: furniture.picture(0.95, 0.65), 1.95, 0.0, height=1.62)
    put(room, "Armchair", lambda: furniture.sofa(0.95, "Linen"), 3.7, 1.55, -70)
    put(room, "Sideboard", lambda: furniture.cupboard(1.5, 0.75, 0.42, "Walnut", 3), 1.6, 3.98, 180)


def furnish_kitchen_and_dining_room(put):
    dining, kitchen = (2, 1), (3, 1)
    put(dining, "Dining table", lambda: furniture.table(1.8, 0.9, 0.74), 2.0, 2.1)
    for x, z, turn in ((1.5, 1.55, 0), (2.5, 1.55, 0), (1.5, 2.65, 180), (2.5, 2.65, 180), (0.85, 2.1, 90),
                       (3.15, 2.1, -90)):
        put(dining, "Chair", furniture.chair, x, z, turn)
    put(dining, "Vase", lambda: furniture.vase(0.09, 0.28), 2.0, 2.1, height=0.7405)
    put(dining, "Bowl with fruit", None, 2.45, 2.1, height=0.7405)
    put(dining, "Sideboard", None, 1.2, 3.96, 180)
    put(dining, "Picture", None, 1.2, 0.0, height=1.6)
    put(kitchen, "Kitchen unit", lambda: furniture.cupboard(2.4, 0.9, 0.6, doors=4), 1.6, 0.33)
    put(kitchen, "Wall unit", lambda: furniture.cupboard(2.4, 0.7, 0.32, doors=4), 1.6, 0.18, height=1.5)
    put(kitchen, "Kitchen table", lambda: furniture.round_table(0.5, 0.74), 1.9, 2.7)
    for x, z, turn in ((1.2, 2.7, 90), (2.6, 2.7, -90), (1.9, 3.4, 180)):
        put(kitchen, "Chair", None, x, z, turn)
    put(kitchen, "Bowl with fruit", None, 1.9, 2.7, height=0.7405)


def furnish_bedrooms(put):
    for room, x in (((0, 2), 2.7), ((2, 0), 2.9)):
        put(room, "Double bed", lambda: furniture.bed(1.6), x, 1.1)
        put(room, "Wardrobe", lambda: furniture.cupboard(1.8, 2.1, 0.6, "Oak", 3), 0.95, 0.34)
        put(room, "Picture", None, x, 0.0, height=1.6)
    for room in ((1, 2), (3, 0)):
        put(room, "Single bed", lambda: furniture.bed(0.95), 0.52, 1.12)
        put(room, "Desk", lambda: furniture.table(1.2, 0.6, 0.74, "Painted wood"), 2.2, 0.34)
        put(room, "Chair", None, 2.2, 0.85, 180)
        put(room, "Floor lamp", None, 1.3, 0.3)


def furnish_other_rooms(put):
    study, bath, hall, library, store = (0, 0), (1, 0), (1, 1), (2, 2), (3, 2)
    put(study, "Writing table", lambda: furniture.table(1.6, 0.75, 0.74, "Walnut"), 2.0, 1.9)
    put(study, "Chair", None, 2.0, 1.3)
    put(study, "Plain book case", lambda: furniture.shelf(1.3, 2.0, 0.30, 6, 8, 0.0), 1.2, 0.16)
    put(study, "Plain book case", None, 2.6, 0.16)
    put(study, "Plant", None, 3.8, 0.6)
    put(bath, "Vanity", lambda: furniture.cupboard(1.0, 0.85, 0.5, doors=2), 1.2, 0.28)
    put(bath, "Basin", lambda: furniture.bowl(0.2), 1.2, 0.28, height=0.851)
    put(bath, "Stool", lambda: furniture.round_table(0.2, 0.45), 2.4, 2.6)
    put(hall, "Sideboard", None, 1.6, 0.24)
    put(hall, "Vase", None, 1.2, 0.24, height=0.751)
    put(hall, "Rug", None, 1.6, 2.1, 90)
    put(library, "Plain book case", None, 1.0, 0.16)
    put(library, "Plain book case", None, 0.16, 2.5, 90)
    put(library, "Armchair", None, 2.0, 1.9, -20)
    put(library, "Floor lamp", None, 2.9, 1.6)
    put(store, "Wardrobe", None, 1.1, 0.34)
    put(store, "Stool", None, 2.4, 2.4)
    put(store, "Plant", None, 2.6, 0.6)
