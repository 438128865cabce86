"""Packs small glTF scenes with their buffers into .glb files: pack_scenes.py OUT_FOLDER SCENE.gltf..."""

import json
import pathlib
import struct
import sys

LARGEST = 64 * 1024  # bytes; larger ones slow a fuzzer down


def chunk(kind, data, filler):
    data += filler * (-len(data) % 4)
    return struct.pack("<I4s", len(data), kind) + data


def pack(scene):
    document = json.loads(scene.read_text())
    binary = b"".join((scene.parent / b["uri"]).read_bytes() for b in document["buffers"])
    document["buffers"] = [{"byteLength": len(binary)}]
    document.pop("images", None)
    document.pop("textures", None)
    body = chunk(b"JSON", json.dumps(document).encode(), b" ") + chunk(b"BIN\0", binary, b"\0")
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


out = pathlib.Path(sys.argv[1])
for name in map(pathlib.Path, sys.argv[2:]):
    data = pack(name)
    if len(data) <= LARGEST:
        (out / f"{name.stem}.glb").write_bytes(data)
    (out / f"{name.stem}.gltf").write_bytes(name.read_bytes())
