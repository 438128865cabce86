"""Writes NAME.gltf, NAME.bin and textures: glTF 2.0, float32 positions and normals, uint16 or uint32 indices."""
import json
import math
import struct

from .mesh import merged
from .soundness import require_closed
from .vector import cross, normalize, sub

_ARRAY_BUFFER, _ELEMENT_ARRAY_BUFFER = 34962, 34963
_UINT16, _UINT32, _FLOAT = 5123, 5125, 5126


def diffuse(color, texture=None, texture_size=1.0):
    """An exactly Lambertian material (no specular lobe): albedo `color`, times a texture (a file name in the
    scene's folder) that covers texture_size metres."""
    material = {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0], "metallicFactor": 0.0,
                                         "roughnessFactor": 1.0},
                "extensions": {"KHR_materials_specular": {"specularFactor": 0.0}}}
    return {"gltf": material, "texture": texture, "texture_size": texture_size}


def emitter(radiance):
    """A single-sided black emitter of constant radiance, W/(m² sr)."""
    strength = max(radiance)
    material = diffuse((0.0, 0.0, 0.0))
    material["gltf"]["emissiveFactor"] = [round(c / strength, 9) for c in radiance]
    material["gltf"]["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
    return material


def metal(color, roughness=0.0):
    """A metal with reflectance `color` at normal incidence."""
    return {"gltf": {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0], "metallicFactor": 1.0,
                                              "roughnessFactor": roughness}}, "texture": None, "texture_size": 1.0}


def glass(ior, attenuation_color=None, attenuation_distance=1.0):
    """A smooth solid dielectric; light keeps attenuation_color per attenuation_distance metres inside."""
    volume = {"thicknessFactor": 1.0}
    if attenuation_color:
        volume.update(attenuationColor=list(attenuation_color), attenuationDistance=attenuation_distance)
    extensions = {"KHR_materials_transmission": {"transmissionFactor": 1.0},
                  "KHR_materials_ior": {"ior": ior}, "KHR_materials_volume": volume}
    return {"gltf": {"pbrMetallicRoughness": {"baseColorFactor": [1.0, 1.0, 1.0, 1.0], "metallicFactor": 0.0,
                                              "roughnessFactor": 0.0}, "extensions": extensions},
            "texture": None, "texture_size": 1.0}


def pane(ior=1.5):
    """A smooth thin dielectric: light goes straight through it."""
    extensions = {"KHR_materials_transmission": {"transmissionFactor": 1.0}, "KHR_materials_ior": {"ior": ior}}
    return {"gltf": {"pbrMetallicRoughness": {"baseColorFactor": [1.0, 1.0, 1.0, 1.0], "metallicFactor": 0.0,
                                              "roughnessFactor": 0.0}, "extensions": extensions},
            "texture": None, "texture_size": 1.0}


class GltfScene:
    """Collects materials, meshes, nodes and a camera, then writes them."""

    def __init__(self, name, description):
        self.name = name
        self.json = {"asset": {"version": "2.0", "generator": "scenes/make_scenes.py",
                               "copyright": "Part of importon, MIT licence", "extras": {"description": description}},
                     "scene": 0, "scenes": [{"name": name, "nodes": []}], "nodes": [], "meshes": [], "materials": [],
                     "accessors": [], "bufferViews": [], "cameras": []}
        self.data = bytearray()
        self.materials = {}
        self.material_ids = {}
        self.textures = []
        self.triangles = 0

    def material(self, name, definition):
        self.materials[name] = definition

    def camera(self, position, target, yfov_degrees, width, height):
        """A perspective camera at `position` that looks at `target`, with y up."""
        camera = {"yfov": round(math.radians(yfov_degrees), 6), "aspectRatio": round(width / height, 6),
                  "znear": 0.01, "zfar": 100.0}
        self.json["cameras"].append({"name": "Camera", "type": "perspective", "perspective": camera,
                                     "extras": {"width": width, "height": height}})
        self.node({"name": "Camera", "camera": len(self.json["cameras"]) - 1, "translation": list(position),
                   "rotation": look_at(position, target)})

    def sun(self, irradiance, direction):
        """Light along `direction`, W/m² across it."""
        strength = max(irradiance)
        self._extension("KHR_lights_punctual")["lights"] = [
            {"name": "Sun", "type": "directional", "color": [round(c / strength, 9) for c in irradiance],
             "intensity": strength}]
        self.node({"name": "Sun", "rotation": look_at((0.0, 0.0, 0.0), direction),
                   "extensions": {"KHR_lights_punctual": {"light": 0}}})

    def image_light(self, faces, intensity):
        """Light from all around, by six pictures: +x, -x, +y, -y, +z, -z."""
        images = self.json.setdefault("images", [])
        indices = [len(images) + k for k in range(6)]
        images.extend({"uri": uri} for uri in faces)
        self._extension("EXT_lights_image_based")["lights"] = [
            {"intensity": intensity, "irradianceCoefficients": [[0.0, 0.0, 0.0]] * 9, "specularImageSize": 32,
             "specularImages": [indices]}]
        self.json["scenes"][0]["extensions"] = {"EXT_lights_image_based": {"light": 0}}

    def mesh(self, name, parts, is_closed=True):
        """Adds a mesh with one primitive for each of `parts` ({material: Mesh}); returns its index."""
        if is_closed:
            require_closed(name, merged(*parts.values()))
        primitives = [self._primitive(material, mesh) for material, mesh in parts.items()]
        self.json["meshes"].append({"name": name, "primitives": primitives})
        return len(self.json["meshes"]) - 1

    def place(self, mesh_id, translation=(0.0, 0.0, 0.0), turn_degrees=0.0, name=None):
        """Puts a mesh into the scene, turned about the y axis."""
        mesh = self.json["meshes"][mesh_id]
        node = {"name": name or mesh["name"], "mesh": mesh_id}
        if any(translation):
            node["translation"] = [round(c, 6) for c in translation]
        if turn_degrees:
            half = math.radians(turn_degrees) / 2.0
            node["rotation"] = [0.0, round(math.sin(half), 7), 0.0, round(math.cos(half), 7)]
        self.triangles += sum(self.json["accessors"][p["indices"]]["count"] // 3 for p in mesh["primitives"])
        self.node(node)

    def add(self, name, parts):
        """Adds a closed solid and places it once."""
        self.place(self.mesh(name, parts))

    def add_sheet(self, name, material, mesh):
        """Adds a sheet, seen from its front only: a light, or a wall whose back nothing can reach."""
        self.place(self.mesh(name, {material: mesh}, is_closed=False))

    def node(self, node):
        self.json["nodes"].append(node)
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def write(self, folder):
        self.json["buffers"] = [{"uri": f"{self.name}.bin", "byteLength": len(self.data)}]
        used = {e for m in self.json["materials"] for e in m.get("extensions", {})}
        used |= set(self.json.get("extensions", {}))
        self.json["extensionsUsed"] = sorted(used)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f"{self.name}.bin").write_bytes(self.data)
        (folder / f"{self.name}.gltf").write_text(_readable(self.json), encoding="utf-8")

    def _extension(self, name):
        return self.json.setdefault("extensions", {}).setdefault(name, {})

    def _primitive(self, material, mesh):
        size = self.materials[material]["texture_size"]
        attributes = {"POSITION": self._floats(mesh.positions, "VEC3", has_bounds=True),
                      "NORMAL": self._floats(mesh.normals, "VEC3", digits=7)}
        if self.materials[material]["texture"]:
            attributes["TEXCOORD_0"] = self._floats([(u / size, v / size) for u, v in mesh.uvs], "VEC2")
        kind, code = (_UINT16, "H") if len(mesh.positions) < 65535 else (_UINT32, "I")
        flat = [i for t in mesh.triangles for i in t]
        view = self._view(struct.pack(f"<{len(flat)}{code}", *flat), _ELEMENT_ARRAY_BUFFER)
        return {"attributes": attributes, "indices": self._accessor(view, kind, len(flat), "SCALAR"),
                "material": self._material_id(material)}

    def _floats(self, rows, shape, has_bounds=False, digits=6):
        """Rounded, so that the last bit of a platform's sine does not show in the file."""
        flat = [round(c, digits) + 0.0 for row in rows for c in row]
        data = struct.pack(f"<{len(flat)}f", *flat)
        accessor = self._accessor(self._view(data, _ARRAY_BUFFER), _FLOAT, len(rows), shape)
        if has_bounds:
            stored = struct.unpack(f"<{len(flat)}f", data)
            self.json["accessors"][accessor].update(min=[min(stored[a::3]) for a in range(3)],
                                                    max=[max(stored[a::3]) for a in range(3)])
        return accessor

    def _view(self, data, target):
        self.data += b"\0" * (-len(self.data) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data),
                                         "target": target})
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def _accessor(self, view, component_type, count, shape):
        self.json["accessors"].append({"bufferView": view, "componentType": component_type, "count": count,
                                       "type": shape})
        return len(self.json["accessors"]) - 1

    def _material_id(self, name):
        if name not in self.material_ids:
            definition = self.materials[name]
            material = {"name": name, **definition["gltf"]}
            if definition["texture"]:
                texture = {"index": self._texture_id(definition["texture"])}
                material["pbrMetallicRoughness"]["baseColorTexture"] = texture
            self.json["materials"].append(material)
            self.material_ids[name] = len(self.json["materials"]) - 1
        return self.material_ids[name]

    def _texture_id(self, uri):
        if uri not in self.textures:
            self.textures.append(uri)
            self.json.setdefault("samplers", [{"magFilter": 9729, "minFilter": 9729, "wrapS": 10497, "wrapT": 10497}])
            self.json.setdefault("images", []).append({"uri": uri})
            self.json.setdefault("textures", []).append({"sampler": 0, "source": len(self.json["images"]) - 1})
        return self.textures.index(uri)


def _readable(value):
    """JSON with one line for each element of a top-level array."""
    lines = []
    for key, item in value.items():
        if isinstance(item, list) and item and isinstance(item[0], dict):
            rows = ",\n".join("  " + json.dumps(row) for row in item)
            lines.append(f" {json.dumps(key)}: [\n{rows}\n ]")
        else:
            lines.append(f" {json.dumps(key)}: {json.dumps(item)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def look_at(position, target):
    """The rotation, as a glTF quaternion, of a camera that looks along its -z at target, with its y up."""
    back = normalize(sub(position, target))
    right = normalize(cross((0.0, 1.0, 0.0), back))
    up = cross(back, right)
    m = [[right[k], up[k], back[k]] for k in range(3)]
    w = math.sqrt(max(0.0, 1.0 + m[0][0] + m[1][1] + m[2][2])) / 2.0
    x = math.copysign(math.sqrt(max(0.0, 1.0 + m[0][0] - m[1][1] - m[2][2])) / 2.0, m[2][1] - m[1][2])
    y = math.copysign(math.sqrt(max(0.0, 1.0 - m[0][0] + m[1][1] - m[2][2])) / 2.0, m[0][2] - m[2][0])
    z = math.copysign(math.sqrt(max(0.0, 1.0 - m[0][0] - m[1][1] + m[2][2])) / 2.0, m[1][0] - m[0][1])
    return [round(c, 7) for c in (x, y, z, w)]
