"""Runs of mutants, what is kept of them, and the table in docs/testing.md."""
import json
import sys
import time
import pathlib

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
from talk_tables.pages import filled  # noqa: E402

from .gate import DoesNotCompile, Failure, TIMED_OUT  # noqa: E402


class Results:
    """For each mutant the test that caught it, or none, and the seconds that it took to build and run until then."""

    def __init__(self, file):
        self.file = file
        self.all = json.loads(file.read_text()) if file.exists() else {}

    def of(self, mutant):
        """What was found; None if it has not been run since it was changed."""
        result = self.all.get(mutant.name)
        return result if result and result["mutant"] == mutant.digest() else None

    def likely(self, mutant):
        """What caught a mutant of this name the last time."""
        result = self.all.get(mutant.name)
        return Failure(result["program"], result["test"].removesuffix(TIMED_OUT)) if result and result["test"] else None

    def put(self, mutant, failure, seconds):
        program, test = (failure.program, failure.test) if failure else (None, None)
        self.all[mutant.name] = {"mutant": mutant.digest(), "program": program, "test": test, "seconds": round(seconds)}
        lines = [f"  {json.dumps(name)}: {json.dumps(self.all[name])}" for name in sorted(self.all)]
        self.file.write_text("{\n" + ",\n".join(lines) + "\n}\n")

    def told(self, mutant):
        result = self.of(mutant)
        if not result:
            return "Not run yet."
        return f"Caught by {result['test']}." if result["test"] else "It lives."


def run_all(mutants, copy, gate, results, say, only_likely=False):
    """Runs mutants one by one. Returns the exit status: 0 all caught, 1 one not, 2 one does not compile."""
    digest = copy.update()
    likely = [results.likely(mutant) for mutant in mutants]
    gate.pass_without_mutants(digest, [failure for failure in likely if failure])
    return max([run(*one, digest, copy, gate, results, say, only_likely) for one in zip(mutants, likely)], default=0)


def run(mutant, likely, digest, copy, gate, results, say, only_likely):
    """Runs one: the test that is likely to catch it, then all."""
    began = time.monotonic()
    try:
        failure = None
        if likely and gate.knows(likely):
            with copy.broken_by(mutant):
                failure = gate.first_failure(likely)
        if not failure and only_likely:
            say(f"{mutant.name}: not caught by {likely.test if likely else 'a test that is known'}")
            return 1
        if not failure:
            gate.pass_without_mutants(digest)
            with copy.broken_by(mutant):
                failure = gate.first_failure()
    except DoesNotCompile as error:
        say(f"{mutant.name}: does not compile: {error}")
        return 2
    seconds = time.monotonic() - began
    results.put(mutant, failure, seconds)
    say(f"{mutant.name}: {'caught by ' + failure.test if failure else 'LIVES'} ({seconds:.0f} s)")
    return 0 if failure else 1


def write_page(page, mutants, results):
    """Puts the table into the page. Nothing is known of mutants that were not run."""
    rows = ["| mutant | what is broken | caught by |", "| --- | --- | --- |"]
    for mutant in mutants:
        result = results.of(mutant)
        by = "not run yet" if not result else f"`{result['test']}`" if result["test"] else "**lives**"
        rows.append(f"| `{mutant.name}` | {mutant.breaks} | {by} |")
    if page.exists():
        page.write_text(filled(page.read_text(), "mutants", "\n".join(rows)))
