"""The classic diffuse box: colour bleeding, soft shadows, one light. Reflectances are the measured ones of the
Cornell University Program of Computer Graphics, in round figures; the geometry is our own, 2 m wide."""
from .gltf_writer import GltfScene, diffuse, emitter
from .mesh import box, quad

NAME = "cornell_box"


def build(_folder):
    scene = GltfScene(NAME, __doc__)
    add_walls(scene)
    scene.material("Light", emitter((20.0, 16.0, 11.0)))
    scene.add("Short block", {"White": box((0.6, 0.6, 0.6)).rotated("y", -17).moved((0.33, 0.3, 0.35))})
    scene.add("Tall block", {"White": box((0.6, 1.2, 0.6)).rotated("y", 18).moved((-0.34, 0.6, -0.30))})
    scene.add_sheet("Light", "Light", quad((-0.24, 1.99, -0.2), (0.48, 0, 0), (0, 0, 0.4)))
    return scene


def add_walls(scene):
    """The box, its materials, and the camera before it."""
    scene.material("White", diffuse((0.73, 0.73, 0.73)))
    scene.material("Red", diffuse((0.63, 0.06, 0.05)))
    scene.material("Green", diffuse((0.14, 0.45, 0.09)))
    scene.camera((0.0, 1.0, 3.85), (0.0, 1.0, 0.0), 38.9, 512, 512)
    scene.add_sheet("Floor", "White", quad((-1, 0, 1), (2, 0, 0), (0, 0, -2)))
    scene.add_sheet("Ceiling", "White", quad((-1, 2, -1), (2, 0, 0), (0, 0, 2)))
    scene.add_sheet("Back wall", "White", quad((-1, 0, -1), (2, 0, 0), (0, 2, 0)))
    scene.add_sheet("Left wall", "Red", quad((-1, 0, 1), (0, 0, -2), (0, 2, 0)))
    scene.add_sheet("Right wall", "Green", quad((1, 0, -1), (0, 0, 2), (0, 2, 0)))
