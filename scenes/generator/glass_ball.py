"""A glass ball and a mirror ball in a diffuse box: caustics, and a room seen through and in them."""
from . import cornell_box
from .gltf_writer import GltfScene, emitter, glass, metal
from .mesh import quad, sphere

NAME = "glass_ball"


def build(_folder):
    scene = GltfScene(NAME, __doc__)
    cornell_box.add_walls(scene)
    scene.material("Glass", glass(1.5))
    scene.material("Silver", metal((0.95, 0.93, 0.88)))
    scene.material("Light", emitter((30.0, 26.0, 20.0)))
    scene.add("Glass ball", {"Glass": sphere(0.35, 5, (0.4, 0.4, 0.35))})
    scene.add("Silver ball", {"Silver": sphere(0.35, 5, (-0.4, 0.36, -0.3))})
    scene.add_sheet("Light", "Light", quad((-0.2, 1.99, -0.2), (0.4, 0, 0), (0, 0, 0.4)))
    return scene
