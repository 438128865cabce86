"""Holds that a mesh is closed and that its front is its outside."""
from collections import Counter

from .vector import cross, dot, normalize, sub


def require_closed(name, mesh):
    """Raises ValueError unless every edge is shared by triangles of opposite sense, the enclosed volume is
    positive, and no vertex normal leans away from its triangle."""
    points = [tuple(round(c, 6) for c in p) for p in mesh.positions]
    edges = Counter()
    for a, b, c in mesh.triangles:
        for p, q in ((a, b), (b, c), (c, a)):
            edges[points[p], points[q]] += 1
    is_open = [e for e, count in edges.items() if edges[e[1], e[0]] != count]
    if is_open:
        raise ValueError(f"{name}: {len(is_open)} open edges, the first at {is_open[0]}")
    volume = sum(dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c])) for a, b, c in mesh.triangles) / 6
    if volume <= 0:
        raise ValueError(f"{name}: encloses {volume} m³: wound inside out")
    for triangle in mesh.triangles:
        _require_normals_agree(name, mesh, triangle)


def _require_normals_agree(name, mesh, triangle):
    a, b, c = (mesh.positions[i] for i in triangle)
    face = normalize(cross(sub(b, a), sub(c, a)))
    for i in triangle:
        if dot(face, mesh.normals[i]) <= 0.1:
            raise ValueError(f"{name}: normal {mesh.normals[i]} at {mesh.positions[i]} leans away from {face}")
