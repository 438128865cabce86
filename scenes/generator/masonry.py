"""Walls, floors and ceilings: a block of masonry with boxes cut out of it.

All faces come from one grid of cells, so the surface is closed and has no T-junctions: no ray slips through.
"""
from .mesh import Mesh

_AXES = "xyz"


def carve(block, holes, material_of):
    """Cuts the boxes `holes` out of the box `block`; a box is (low corner, high corner), in metres.
    material_of(center, normal) names the material of a face. Returns {material: Mesh}, flat shaded."""
    block = _rounded(block)
    holes = [_rounded(hole) for hole in holes]
    planes = [sorted({c[axis] for box in [block] + holes for c in box
                      if block[0][axis] <= c[axis] <= block[1][axis]}) for axis in range(3)]
    meshes, vertices = {}, {}
    for axis in range(3):
        for cell in _cells([len(p) - (0 if a == axis else 1) for a, p in enumerate(planes)]):
            before = list(cell)
            before[axis] -= 1
            is_solid, was_solid = _is_solid(planes, cell, holes), _is_solid(planes, before, holes)
            if is_solid != was_solid:
                _add_face(meshes, vertices, planes, cell, axis, 1 if was_solid else -1, material_of)
    return meshes


def _rounded(box):
    """To the micrometre, so that planes meant to coincide do."""
    return tuple(tuple(round(c, 6) for c in corner) for corner in box)


def _cells(counts):
    return [(i, j, k) for i in range(counts[0]) for j in range(counts[1]) for k in range(counts[2])]


def _is_solid(planes, cell, holes):
    if any(not 0 <= cell[a] < len(planes[a]) - 1 for a in range(3)):
        return False
    center = [0.5 * (planes[a][cell[a]] + planes[a][cell[a] + 1]) for a in range(3)]
    return not any(all(low[a] < center[a] < high[a] for a in range(3)) for low, high in holes)


def _add_face(meshes, vertices, planes, cell, axis, sign, material_of):
    """Adds the face between a cell and the one before it along `axis`, with its normal along sign·axis."""
    u, v = ((axis + 1) % 3, (axis + 2) % 3)[::sign]
    normal = tuple(float(sign) if a == axis else 0.0 for a in range(3))
    corners = []
    for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
        index = list(cell)
        index[u] += du
        index[v] += dv
        corners.append(tuple(float(planes[a][index[a]]) for a in range(3)))
    center = tuple(sum(c[a] for c in corners) / 4.0 for a in range(3))
    material = material_of(center, normal)
    mesh = meshes.setdefault(material, Mesh())
    ids = []
    for corner in corners:
        key = (material, corner, normal)
        if key not in vertices:
            vertices[key] = mesh.vertex(corner, normal, _wall_uv(corner, axis))
        ids.append(vertices[key])
    mesh.triangles += [(ids[0], ids[1], ids[2]), (ids[0], ids[2], ids[3])]


def _wall_uv(p, axis):
    """Metres along and up a wall; on floors and ceilings along x and z."""
    return (p[0], p[2]) if axis == 1 else (p[2], -p[1]) if axis == 0 else (p[0], -p[1])
