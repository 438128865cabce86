#!/usr/bin/env python3
"""Makes the project's own scenes: `scenes/make_scenes.py [NAME ...]` writes scenes/NAME/NAME.gltf and what belongs
to it; `--into FOLDER` puts them there instead. Needs Python 3 only, and gives the same files each time."""
import argparse
import pathlib

from generator import cornell_box, door_slit, gallery, glass_ball, glass_caustic, pool, ring, rooms, window

SCENES = {module.NAME: module for module in (cornell_box, glass_ball, glass_caustic, rooms, door_slit, gallery, ring,
                                          pool, window)}


def main():
    parser = argparse.ArgumentParser(description="Makes the project's own scenes.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"one of {', '.join(SCENES)}; all if none is given")
    parser.add_argument("--into", type=pathlib.Path, default=pathlib.Path(__file__).parent, help="folder to write to")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.names if name not in SCENES]
    if unknown:
        parser.error(f"unknown scene {unknown[0]}: choose from {', '.join(SCENES)}")
    for name in arguments.names or SCENES:
        folder = arguments.into / name
        folder.mkdir(parents=True, exist_ok=True)
        scene = SCENES[name].build(folder)
        scene.write(folder)
        print(f"{name}: {scene.triangles} triangles, {len(scene.data) / 1024:.0f} KiB")


if __name__ == "__main__":
    main()
