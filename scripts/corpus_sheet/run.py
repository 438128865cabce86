"""One render of a scene, and what is to be said of it."""
import json
import pathlib
import struct
import subprocess
import tempfile
import time
import zlib

WIDTH, HEIGHT = 160, 120
BLACK = 1.0  # of 255: the mean of a picture that shows nothing

PREDICTORS = (lambda a, b, c: 0, lambda a, b, c: a, lambda a, b, c: b, lambda a, b, c: (a + b) // 2)


def paeth(a, b, c):
    """The predictor of PNG, section 9.4."""
    p = a + b - c
    distances = (abs(p - a), abs(p - b), abs(p - c))
    return (a, b, c)[distances.index(min(distances))]


def mean_of_png(data):
    """The mean of the red, green and blue of a PNG of 8 bits without a palette and not interlaced, 0 to 255."""
    at, idat, header = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        if kind == b"IDAT":
            idat += body
        at += 12 + length
    width, height, _, color = header[:4]
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    stride, raw = width * channels, zlib.decompress(idat)
    above, total = bytes(stride), 0
    colors = channels - (1 if color in (4, 6) else 0)
    for y in range(height):
        start = y * (stride + 1)
        kind, row = raw[start], bytearray(raw[start + 1:start + 1 + stride])
        predict = (PREDICTORS + (paeth,))[kind]
        for x in range(stride):
            left = row[x - channels] if x >= channels else 0
            corner = above[x - channels] if x >= channels else 0
            row[x] = (row[x] + predict(left, above[x], corner)) & 255
        total += sum(sum(row[c::channels]) for c in range(colors))
        above = bytes(row)
    return total / (width * height * colors)


def verdict_of(status, picture):
    """A word for an exit status; None stands for no end."""
    if status is None:
        return "hang"
    if status == 0:
        return "black" if mean_of_png(picture.read_bytes()) < BLACK else "rendered"
    if status == 2:
        return "refused"
    return "failed" if status in (1, 3, 4) else "crash"


def errors_of(scene):
    """How many errors the report of the glTF validator beside a scene lists; None without one."""
    report = scene.with_name(scene.name + ".report.json")
    return json.loads(report.read_text())["issues"]["numErrors"] if report.is_file() else None


def render(importon, scene, picture, options, timeout):
    """Renders to `picture`: verdict, status (None after `timeout` seconds), seconds, warnings, message of the error."""
    picture.unlink(missing_ok=True)
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        command = [importon, scene, "-o", pathlib.Path(folder) / "image.exr", "--png", picture, "-q",
                   "--width", str(WIDTH), "--height", str(HEIGHT), *options]
        try:
            done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=timeout, check=False)
            status, said = done.returncode, done.stderr.decode(errors="replace")
        except subprocess.TimeoutExpired as expired:
            status, said = None, (expired.stderr or b"").decode(errors="replace")
    seconds = time.monotonic() - start
    lines = [line.removeprefix("importon: ") for line in said.splitlines()]
    return {"verdict": verdict_of(status, picture), "status": status, "seconds": round(seconds, 2),
            "warnings": [line.removeprefix("warning: ") for line in lines if line.startswith("warning: ")],
            "message": next((line.removeprefix("error: ") for line in lines if line.startswith("error: ")), "")}
