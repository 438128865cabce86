"""Makes the project's own scenes anew and compares them with the committed files. Textures may differ in how they
are compressed, so only .gltf and .bin are compared."""
import pathlib
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).parents[2] / "scenes"


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-B", SCENES / "make_scenes.py", "--into", folder], check=True)
        made = sorted(p.relative_to(folder) for p in pathlib.Path(folder).rglob("*") if p.suffix in (".gltf", ".bin"))
        kept = sorted(p.relative_to(SCENES) for p in SCENES.rglob("*") if p.suffix in (".gltf", ".bin"))
        if made != kept:
            sys.exit(f"made {made}, but the repository has {kept}")
        changed = [str(p) for p in made if (folder / p).read_bytes() != (SCENES / p).read_bytes()]
    if changed:
        sys.exit(f"run scenes/make_scenes.py: {', '.join(changed)} differ from what it makes")


if __name__ == "__main__":
    main()
