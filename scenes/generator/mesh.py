"""Triangle meshes and the shapes that the scenes are made of.

Every solid is closed and wound counter-clockwise seen from outside. Lengths are metres, y is up. Texture
coordinates are metres too; the writer divides them by the size of a material's texture.
"""
import math

from .vector import add, cross, dot, normalize, rotate, scale, sub


class Mesh:
    """Vertices (position, normal, uv) and triangles (three vertex indices)."""

    def __init__(self):
        self.positions, self.normals, self.uvs, self.triangles = [], [], [], []

    def vertex(self, position, normal, uv=(0.0, 0.0)):
        self.positions.append(position)
        self.normals.append(normal)
        self.uvs.append(uv)
        return len(self.positions) - 1

    def append(self, other):
        first = len(self.positions)
        self.positions += other.positions
        self.normals += other.normals
        self.uvs += other.uvs
        self.triangles += [tuple(first + i for i in t) for t in other.triangles]
        return self

    def moved(self, offset):
        result = self._copy()
        result.positions = [add(p, offset) for p in self.positions]
        return result

    def rotated(self, axis, degrees):
        result = self._copy()
        result.positions = [rotate(p, axis, degrees) for p in self.positions]
        result.normals = [rotate(n, axis, degrees) for n in self.normals]
        return result

    def with_uvs(self, uv_of_position):
        """The same mesh with texture coordinates (metres) computed from positions."""
        result = self._copy()
        result.uvs = [uv_of_position(p) for p in self.positions]
        return result

    def _copy(self):
        result = Mesh()
        result.positions, result.normals = list(self.positions), list(self.normals)
        result.uvs, result.triangles = list(self.uvs), list(self.triangles)
        return result


def merged(*meshes):
    result = Mesh()
    for mesh in meshes:
        result.append(mesh)
    return result


def grid(columns, rows, vertex_of, closes_u=False):
    """A sheet of columns x rows quads. vertex_of(i, j) gives (position, normal, uv); with u to the right and v
    up, the front faces the viewer. With closes_u the last column of vertices is the first one."""
    mesh = Mesh()
    width = columns if closes_u else columns + 1
    for j in range(rows + 1):
        for i in range(width):
            mesh.vertex(*vertex_of(i, j))
    for j in range(rows):
        for i in range(columns):
            a, b = j * width + i, j * width + (i + 1) % width
            c, d = b + width, a + width
            mesh.triangles += [(a, b, c), (a, c, d)]
    return without_degenerate(mesh)


def without_degenerate(mesh):
    """Drops triangles whose corners coincide, as at the poles of a sphere."""
    p = mesh.positions
    mesh.triangles = [t for t in mesh.triangles
                      if p[t[0]] != p[t[1]] and p[t[1]] != p[t[2]] and p[t[2]] != p[t[0]]]
    return mesh


def quad(corner, edge_u, edge_v, columns=1, rows=1):
    """A parallelogram that faces edge_u x edge_v."""
    normal = normalize(cross(edge_u, edge_v))
    size_u, size_v = math.sqrt(dot(edge_u, edge_u)), math.sqrt(dot(edge_v, edge_v))

    def vertex_of(i, j):
        u, v = i / columns, j / rows
        return add(corner, add(scale(edge_u, u), scale(edge_v, v))), normal, (u * size_u, v * size_v)

    return grid(columns, rows, vertex_of)


def box(size, center=(0.0, 0.0, 0.0)):
    """A box with sharp edges."""
    x, y, z = size
    low = sub(center, scale(size, 0.5))
    high = add(center, scale(size, 0.5))
    return merged(
        quad((low[0], low[1], high[2]), (x, 0, 0), (0, y, 0)), quad((high[0], low[1], low[2]), (-x, 0, 0), (0, y, 0)),
        quad((high[0], low[1], high[2]), (0, 0, -z), (0, y, 0)), quad(low, (0, 0, z), (0, y, 0)),
        quad((low[0], high[1], high[2]), (x, 0, 0), (0, 0, -z)), quad(low, (x, 0, 0), (0, 0, z)))


def rounded_box(size, radius, center=(0.0, 0.0, 0.0), steps=1):
    """A box with edges rounded to `radius` in 2·steps segments, with smooth normals."""
    mesh = Mesh()
    flat = [0.5 * s - radius for s in size]
    angles = [math.radians(45.0 * k / steps) for k in range(steps, 0, -1)]

    def offsets(half):
        return ([-half - radius * math.tan(a) for a in angles] + [-half, half]
                + [half + radius * math.tan(a) for a in reversed(angles)])

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (-1.0, 1.0):
            across, up = offsets(flat[u]), offsets(flat[v])

            def vertex_of(i, j, axis=axis, u=u, v=v, side=side, across=across, up=up):
                p = [0.0, 0.0, 0.0]
                p[axis], p[u], p[v] = side * 0.5 * size[axis], side * across[i], up[j]
                inner = tuple(min(max(p[k], -flat[k]), flat[k]) for k in range(3))
                normal = normalize(sub(p, inner))
                return add(center, add(inner, scale(normal, radius))), normal, (p[u], p[v])

            mesh.append(grid(len(across) - 1, len(up) - 1, vertex_of))
    return mesh


def sphere(radius, subdivisions, center=(0.0, 0.0, 0.0)):
    """An icosahedron whose triangles are split in four `subdivisions` times: 20·4^n triangles, smooth."""
    g = (1.0 + math.sqrt(5.0)) / 2.0
    points = [normalize(p) for p in ((-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
                                     (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1))]
    triangles = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
                 (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5),
                 (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(subdivisions):
        points, triangles = _split_in_four(points, triangles)
    mesh = Mesh()
    for p in points:
        mesh.vertex(add(center, scale(p, radius)), p)
    mesh.triangles = triangles
    return mesh


def _split_in_four(points, triangles):
    points, middle, result = list(points), {}, []

    def between(a, b):
        key = (min(a, b), max(a, b))
        if key not in middle:
            middle[key] = len(points)
            points.append(normalize(add(points[a], points[b])))
        return middle[key]

    for a, b, c in triangles:
        ab, bc, ca = between(a, b), between(b, c), between(c, a)
        result += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    return points, result


def lathe(profile, segments, crease_degrees=40.0, is_loop=False):
    """A solid of revolution about the y axis. `profile` lists (radius, y); the outside lies to the right of the
    way along it. It starts and ends on the axis, or is a loop. Edges sharper than the crease stay sharp."""
    mesh = Mesh()
    for part in _smooth_parts(profile, math.cos(math.radians(crease_degrees)), is_loop):
        lengths = [0.0]
        for (p, _), (q, _) in zip(part, part[1:]):
            lengths.append(lengths[-1] + math.dist(p, q))

        def vertex_of(i, j, part=part, lengths=lengths):
            (r, y), (nr, ny) = part[j]
            angle = -2.0 * math.pi * i / segments
            c, s = (1.0, 0.0) if i == segments else (math.cos(angle), math.sin(angle))
            return (r * c, y, r * s), (nr * c, ny, nr * s), (i / segments, lengths[j])

        mesh.append(grid(segments, len(part) - 1, vertex_of))
    return mesh


def _smooth_parts(profile, crease_cosine, is_loop):
    """Cuts a profile at its creases into lists of ((radius, y), normal)."""
    points = list(profile) + ([profile[0]] if is_loop else [])
    normals = []
    for (r0, y0), (r1, y1) in zip(points, points[1:]):
        size = math.dist((r0, y0), (r1, y1))
        normals.append(((y1 - y0) / size, (r0 - r1) / size))
    closes_smoothly = is_loop and _cosine(normals[-1], normals[0]) > crease_cosine
    seam = _mean(normals[-1], normals[0]) if closes_smoothly else None
    parts, part = [], [(points[0], seam or _end_normal(points[0], normals[0]))]
    for k in range(1, len(points) - 1):
        if _cosine(normals[k - 1], normals[k]) > crease_cosine:
            part.append((points[k], _mean(normals[k - 1], normals[k])))
        else:
            part.append((points[k], normals[k - 1]))
            parts.append(part)
            part = [(points[k], normals[k])]
    part.append((points[-1], seam or _end_normal(points[-1], normals[-1])))
    return parts + [part]


def _end_normal(point, normal):
    """On the axis a smooth surface is level: its normal points straight up or down, unless it is a cone's tip."""
    return (0.0, math.copysign(1.0, normal[1])) if point[0] == 0.0 and abs(normal[1]) > 0.7 else normal


def _cosine(a, b):
    return a[0] * b[0] + a[1] * b[1]


def _mean(a, b):
    size = math.hypot(a[0] + b[0], a[1] + b[1])
    return ((a[0] + b[0]) / size, (a[1] + b[1]) / size)


def cylinder(radius, height, segments, bevel=0.0):
    """A closed cylinder standing on y = 0, its rims cut off by `bevel`."""
    if bevel == 0.0:
        return lathe([(0.0, 0.0), (radius, 0.0), (radius, height), (0.0, height)], segments)
    return lathe([(0.0, 0.0), (radius - bevel, 0.0), (radius, bevel), (radius, height - bevel),
                  (radius - bevel, height), (0.0, height)], segments, 50.0)


def curve(points, steps):
    """A Catmull-Rom spline through 2-D points, for profiles; keeps the end points."""
    ends = [points[0]] + list(points) + [points[-1]]
    result = []
    for p0, p1, p2, p3 in zip(ends, ends[1:], ends[2:], ends[3:]):
        for k in range(steps):
            t = k / steps
            result.append(tuple(
                0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t ** 3)
                for a, b, c, d in zip(p0, p1, p2, p3)))
    return result + [tuple(points[-1])]


def rounded_rectangle(center, width, height, radius, steps):
    """The outline of a rectangle in (radius, y) with rounded corners, as a loop for lathe(): up its outer side,
    over the top, down its inner side."""
    half_width, half_height = 0.5 * width - radius, 0.5 * height - radius
    points = []
    for quarter, (sr, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        for k in range(steps + 1):
            angle = math.radians(90.0 * (quarter + k / steps))
            points.append((center[0] + sr * half_width + radius * math.cos(angle),
                           center[1] + sy * half_height + radius * math.sin(angle)))
    return points
