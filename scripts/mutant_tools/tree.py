"""The copy of the sources that mutants are applied to. It stays, with what was built in it."""
import contextlib
import filecmp
import hashlib
import os
import shutil

LEFT_OUT = {".git", "build", "out", "__pycache__"}
# What tells no test anything: a change there asks for no run without mutants.
SILENT = ("docs/", "tests/mutants/")


class Copy:
    def __init__(self, root, folder):
        self.root, self.folder = root, folder

    def update(self):
        """Copies what has changed, and only that, so that only that is built again. Returns a digest of the sources."""
        files = files_of(self.root)
        digest = hashlib.sha256()
        for name in files:
            source, target = self.root / name, self.folder / name
            if not target.is_file() or not filecmp.cmp(source, target, shallow=False):
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source, target)
            shutil.copymode(source, target)
            if not name.startswith(SILENT):
                digest.update(f"{name}\0{hashlib.sha256(target.read_bytes()).hexdigest()}\n".encode())
        for name in set(files_of(self.folder)) - set(files):
            (self.folder / name).unlink()
        return digest.hexdigest()

    @contextlib.contextmanager
    def broken_by(self, mutant):
        """The copy with a mutant applied; afterwards as it was."""
        file = self.folder / mutant.file
        text = file.read_text()
        file.write_text(mutant.applied(text))
        try:
            yield
        finally:
            file.write_text(text)  # newer than what was built of the mutant: built again when it is needed


def files_of(root):
    """Names of all files from `root`, sorted."""
    names = []
    for folder, folders, files in os.walk(root):
        folders[:] = [name for name in folders if name not in LEFT_OUT]
        names += [os.path.relpath(os.path.join(folder, name), root) for name in files if name not in LEFT_OUT]
    return sorted(names)
