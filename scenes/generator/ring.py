"""A polished gold ring on a pale floor: the light that its inner side reflects draws a cardioid."""
from .gltf_writer import GltfScene, diffuse, emitter, metal
from .mesh import lathe, quad, rounded_rectangle
from .vector import add, cross, normalize, scale

NAME = "ring"


def build(_folder):
    scene = GltfScene(NAME, __doc__)
    scene.material("Floor", diffuse((0.62, 0.60, 0.56)))
    scene.material("Gold", metal((1.0, 0.78, 0.34)))
    scene.material("Light", emitter((1300.0, 1220.0, 1100.0)))
    scene.camera((0.0, 0.66, 0.62), (0.02, 0.0, 0.02), 36.0, 640, 480)
    scene.add_sheet("Floor", "Floor", quad((-3, 0, 3), (6, 0, 0), (0, 0, -6)))
    profile = rounded_rectangle((0.19, 0.0405), 0.016, 0.08, 0.0075, 11)
    scene.add("Ring", {"Gold": lathe(profile, 256, is_loop=True)})
    scene.add_sheet("Light", "Light", light_quad((-1.65, 0.95, -0.6), (0.0, 0.0, 0.0), 0.1))
    return scene


def light_quad(center, target, side):
    """A square that faces a target."""
    normal = normalize(tuple(t - c for t, c in zip(target, center)))
    u = normalize(cross((0.0, 1.0, 0.0), normal))
    v = cross(normal, u)
    corner = add(center, add(scale(u, -side / 2), scale(v, -side / 2)))
    return quad(corner, scale(u, side), scale(v, side))
