#!/usr/bin/env python3
"""Makes the project's own scenes: `scenes/make_scenes.py [NAME ...]` writes scenes/NAME/NAME.gltf and what belongs
to it. Needs Python 3 only, and gives the same files each time."""
import pathlib
import sys

from generator import cornell_box, door_slit, glass_caustic, pool, ring, rooms

SCENES = {module.NAME: module for module in (cornell_box, glass_caustic, rooms, door_slit, ring, pool)}


def main(names):
    unknown = [name for name in names if name not in SCENES]
    if unknown:
        sys.exit(f"unknown scene {unknown[0]}: choose from {', '.join(SCENES)}")
    for name in names or SCENES:
        folder = pathlib.Path(__file__).parent / name
        folder.mkdir(exist_ok=True)
        scene = SCENES[name].build(folder)
        scene.write(folder)
        print(f"{name}: {scene.triangles} triangles, {len(scene.data) / 1024:.0f} KiB")


if __name__ == "__main__":
    main(sys.argv[1:])
