"""Procedural textures that repeat without a seam, written as 8-bit sRGB PNG files."""
import math
import random
import struct
import zlib


def write_png(path, size, color_of):
    """Writes a size x size image; color_of(x, y) gives linear RGB for pixel coordinates, y downwards."""
    rows = bytearray()
    for y in range(size):
        rows.append(0)
        for x in range(size):
            rows += bytes(_srgb(c) for c in color_of(x, y))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
                     + chunk(b"IEND", b""))


def _srgb(c):
    encoded = 12.92 * c if c <= 0.0031308 else 1.055 * c ** (1.0 / 2.4) - 0.055
    return min(255, max(0, round(255.0 * encoded)))


class Noise:
    """Value noise on a lattice that repeats after columns x rows cells."""

    def __init__(self, columns, rows, seed):
        source = random.Random(seed)
        self.columns, self.rows = columns, rows
        self.values = [source.random() for _ in range(columns * rows)]

    def __call__(self, u, v):
        """u and v in periods."""
        x, y = u * self.columns, v * self.rows
        i, j = math.floor(x), math.floor(y)
        fx, fy = x - i, y - j
        fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
        low = self._at(i, j) * (1 - fx) + self._at(i + 1, j) * fx
        high = self._at(i, j + 1) * (1 - fx) + self._at(i + 1, j + 1) * fx
        return low * (1 - fy) + high * fy

    def _at(self, i, j):
        return self.values[(j % self.rows) * self.columns + i % self.columns]


def planks(size, boards, light, dark, seed, pieces=1, seam=0.35):
    """Wooden boards along u, each with its own shade and grain; `pieces` cuts a board along its length. Seams
    keep the share `seam` of the light."""
    source = random.Random(seed)
    shades = [[source.uniform(0.0, 0.45) for _ in range(pieces)] for _ in range(boards)]
    starts = [source.random() for _ in range(boards)]
    coarse, fine = Noise(3, 8 * boards, seed + 1), Noise(12, 48 * boards, seed + 2)
    pixels = size / boards

    def color_of(x, y):
        board = int(y / pixels)
        along = (x / size + starts[board]) * pieces
        piece = int(along) % pieces
        u = x / size + 0.37 * piece
        rings = coarse(u, y / size)
        grain = 0.5 + 0.5 * math.sin(16.0 * rings + 6.0 * fine(u, y / size))
        t = min(1.0, shades[board][piece] + 0.30 * grain + 0.25 * fine(u, y / size))
        t = round(20 * t) / 20
        is_seam = y % pixels < 1 or (pieces > 1 and (along % 1.0) * size / pieces < 1)
        return tuple((a + (b - a) * t) * (seam if is_seam else 1.0) for a, b in zip(light, dark))

    return color_of


def tiles(size, count, light, dark, grout, seed):
    """count x count glazed tiles of slightly differing shades between `light` and `dark`."""
    source = random.Random(seed)
    shades = [source.randrange(8) / 7 for _ in range(count * count)]
    pixels = size // count
    joint = max(1, pixels // 16)

    def color_of(x, y):
        if x % pixels < joint or y % pixels < joint:
            return grout
        t = shades[(y // pixels) * count + x // pixels]
        return tuple(a + (b - a) * t for a, b in zip(light, dark))

    return color_of
