"""The mutants: tests/mutants/*.toml, a file for each area, a table for each mutant."""
import dataclasses
import hashlib
import tomllib


class TableError(Exception):
    """The table does not fit itself or the sources."""


@dataclasses.dataclass(frozen=True)
class Mutant:
    """A small breakage: `old`, which stands once in `file`, becomes `new`."""
    name: str
    file: str    # from the top of the sources
    breaks: str  # a sentence that says what is broken
    old: str
    new: str

    def digest(self):
        """Tells whether a result is this mutant's or that of an earlier one of its name."""
        return hashlib.sha256("\0".join((self.file, self.old, self.new)).encode()).hexdigest()[:12]

    def applied(self, text):
        """The file's text with the breakage."""
        count = text.count(self.old)
        if count != 1:
            raise TableError(f"{self.name} is out of date: its old text stands {count} times in {self.file}, not once")
        return text.replace(self.old, self.new)


def read(folder):
    """All mutants, by file and in the order of each file."""
    mutants, names = [], set()
    for file in sorted(folder.glob("*.toml")):
        for name, entry in tomllib.loads(file.read_text()).items():
            if set(entry) != {"file", "breaks", "old", "new"} or entry["old"] == entry["new"]:
                raise TableError(f"{file.name}: {name} needs file, breaks, old and another new, and nothing else")
            if name in names:
                raise TableError(f"{file.name}: there is another {name}")
            names.add(name)
            mutants.append(Mutant(name=name, **entry))
    return mutants


def chosen(mutants, names):
    """Those of these names, in the order of the names; all if there are none."""
    by_name = {mutant.name: mutant for mutant in mutants}
    unknown = [name for name in names if name not in by_name]
    if unknown:
        raise TableError(f"unknown mutant {unknown[0]}: see --list")
    return [by_name[name] for name in names] or mutants


def check(mutants, root):
    """Throws if one does not fit the sources."""
    for mutant in mutants:
        file = root / mutant.file
        if not file.is_file():
            raise TableError(f"{mutant.name} is out of date: there is no {mutant.file}")
        mutant.applied(file.read_text())
