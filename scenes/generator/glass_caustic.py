"""The talk's caustic figure: glass and metal on a table, under one small bright light, in a room."""
from . import furniture
from .gltf_writer import GltfScene, diffuse, emitter, glass, metal
from .masonry import carve
from .mesh import box, curve, lathe, rounded_box, rounded_rectangle, sphere
from .ring import light_quad
from .textures import planks, write_png

NAME = "glass_caustic"
TABLE = 0.74  # height of the table top, m


def build(folder):
    scene = GltfScene(NAME, __doc__)
    write_png(folder / "wood.png", 512, planks(512, 4, (0.38, 0.22, 0.11), (0.17, 0.085, 0.04), 7))
    furniture.add_materials(scene)
    scene.material("Table top", diffuse((1.0, 1.0, 1.0), "wood.png", 0.48))
    scene.material("Wall", diffuse((0.62, 0.60, 0.56)))
    scene.material("Ceiling", diffuse((0.78, 0.78, 0.77)))
    scene.material("Floor", diffuse((0.36, 0.30, 0.25)))
    scene.material("Glass", glass(1.5))
    scene.material("Cognac glass", glass(1.5, (0.96, 0.66, 0.24), 0.06))
    scene.material("Tinted glass", glass(1.5, (0.42, 0.80, 0.78), 0.05))
    scene.material("Gold", metal((1.0, 0.78, 0.34)))
    scene.material("Silver", metal((0.95, 0.93, 0.88)))
    scene.material("Light", emitter((1900.0, 1750.0, 1500.0)))
    scene.camera((0.03, TABLE + 0.37, 0.56), (0.03, TABLE + 0.02, 0.0), 31.0, 640, 480)
    add_room(scene)
    add_objects(scene)
    scene.add_sheet("Light", "Light", light_quad((-0.62, TABLE + 0.46, -0.30), (0.0, TABLE, 0.0), 0.05))
    return scene


def add_room(scene):
    def material_of(_center, normal):
        return {1.0: "Floor", -1.0: "Ceiling"}.get(normal[1], "Wall")

    scene.add("Room", carve(((-2.2, -0.2, -1.0), (2.2, 2.8, 3.2)), [((-2.0, 0.0, -0.8), (2.0, 2.6, 3.0))], material_of))
    top = rounded_box((1.3, 0.03, 0.8), 0.006, (0, TABLE - 0.015, 0), 2).with_uvs(lambda p: (p[0], p[2]))
    scene.add("Table top", {"Table top": top})
    leg = scene.mesh("Table leg", {"Walnut": box((0.06, TABLE - 0.031, 0.06), (0, (TABLE - 0.03) / 2, 0))})
    for x in (-0.55, 0.55):
        for z in (-0.32, 0.32):
            scene.place(leg, (x, 0.0, z))


def add_objects(scene):
    """Everything stands 0.3 mm above the table, so that no surfaces coincide."""
    level = TABLE + 0.0003
    scene.place(scene.mesh("Cognac glass", {"Cognac glass": cognac_glass(1.15)}), (-0.085, level, -0.055))
    scene.place(scene.mesh("Glass ball", {"Glass": sphere(0.03, 5)}), (0.055, level + 0.03, 0.085))
    scene.place(scene.mesh("Gold ring", {"Gold": lathe(rounded_rectangle((0.04, 0.0095), 0.004, 0.019, 0.0015, 4),
                                                       160, is_loop=True)}), (-0.085, level, 0.09))
    scene.place(scene.mesh("Tinted block", {"Tinted glass": rounded_box((0.05, 0.05, 0.05), 0.003, (0, 0.025, 0), 3)}),
                (0.115, level, -0.03), 28)
    scene.place(scene.mesh("Silver ball", {"Silver": sphere(0.019, 3)}), (0.165, level + 0.019, 0.06))
    add_still_life(scene, level)


def add_still_life(scene, level):
    """Diffuse things that catch caustics."""
    books = [("Book blue", (0.23, 0.028, 0.16), 8), ("Book cream", (0.21, 0.022, 0.15), -4)]
    height = level
    for material, size, turn in books:
        block = rounded_box(size, 0.002, (0, size[1] / 2, 0))
        scene.place(scene.mesh(material, {material: block}), (0.2, height, -0.19), turn)
        height += size[1] + 0.0003
    scene.place(scene.mesh("Bowl with fruit", furniture.fruit_bowl(0.05, 3)), (0.2, height, -0.19), 40)


def cognac_glass(size):
    """A cognac glass, half full: foot, stem and a thin bowl; the profile is scaled by `size`. Glass and cognac are
    one solid of one material, whose tint shows where it is thick: so no two interfaces touch."""
    foot = curve([(0.0345, 0.0008), (0.030, 0.0026), (0.014, 0.0046), (0.0062, 0.0095), (0.0046, 0.020),
                  (0.0075, 0.0300), (0.0185, 0.0365), (0.0340, 0.0500), (0.0415, 0.0680), (0.0400, 0.0880),
                  (0.0340, 0.1080), (0.0312, 0.1170)], 5)
    rim = [(0.0309, 0.1178), (0.0304, 0.1181), (0.0299, 0.1178)]
    inside = curve([(0.0297, 0.1170), (0.0325, 0.1080), (0.0385, 0.0880), (0.0401, 0.0735)], 8)
    level = curve([(0.0400, 0.0725), (0.0392, 0.0719), (0.0370, 0.0717), (0.0200, 0.0717)], 4)
    profile = [(0.0, 0.0), (0.0340, 0.0)] + foot + rim + inside + level + [(0.0, 0.0717)]
    return lathe([(size * r, size * y) for r, y in profile], 112, 50.0)
