#!/usr/bin/env python3
"""What the documentation points to is there: files, headings, scripts, and the commands and options of importon.

docs_test.py ROOT IMPORTON    ROOT: of the repository; IMPORTON: the program
"""
import pathlib
import re
import subprocess
import sys
import unittest

ROOT, IMPORTON = pathlib.Path(sys.argv[1]), sys.argv[2]
PAGES = [ROOT / "README.md", ROOT / "scenes/README.md", *sorted((ROOT / "docs").rglob("*.md"))]
PASSES_ON = {"run", "render_array"}  # scripts that hand their options to importon
SOURCES = {"", ".cpp", ".h", ".comp", ".glsl", ".py", ".sh", ".txt"}  # "": scripts
FENCE = re.compile(r"^```.*?\n(.*?)^```", re.S | re.M)
SPAN = re.compile(r"`([^`\n]+)`")
DECLARED = re.compile(r"^ {0,4}(?:-\w,)?(--[a-z-]+)", re.M)  # in the text of --help
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
ASSIGNMENT = re.compile(r"^\w+=[^\s(]*$")


def help_of(*words):
    return subprocess.run([IMPORTON, *words, "--help-all"], check=True, capture_output=True, text=True).stdout


def read_program():
    """Options of importon by command; "" has those of importon itself."""
    text = help_of()
    commands = re.findall(r"^ *([a-z]+)(?:  .*)?$", re.split(r"(?mi)^subcommands:", text)[1], re.M)
    helps = {name: help_of(name) for name in commands}
    options = {name: set(DECLARED.findall(helps[name])) for name in commands}
    for name in commands:
        if "options are those of render" in helps[name]:
            options[name] |= options["render"]
    return {"": set(DECLARED.findall(text)), **options}


def fragments(text):
    """Code of a page: lines of its blocks, continued ones joined and pipes cut, and what stands in backquotes."""
    found = []
    for block in FENCE.findall(text):
        for line in block.replace("\\\n", " ").splitlines():
            found += re.split(r"\s(?:\||&&|;)\s", line)
    return found + SPAN.findall(FENCE.sub("", text))


def without_code(text):
    return SPAN.sub("", FENCE.sub("", text))


def anchor(heading):
    """As GitHub makes it of a heading."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def anchors(page):
    return {anchor(heading) for heading in re.findall(r"^#+ (.*)$", FENCE.sub("", page.read_text()), re.M)}


def links(page):
    """Targets of a page that are no addresses of the web."""
    targets = re.findall(r"\]\(([^)\s]+)\)", without_code(page.read_text()))
    return [target for target in targets if not re.match(r"\w+:", target)]


class Documentation(unittest.TestCase):
    program = read_program()

    def missing_options(self, fragment):
        """Those that the program of a fragment does not have. None of other programs."""
        words = fragment.split()
        while words and ASSIGNMENT.match(words[0]):
            words.pop(0)
        used = set(OPTION.findall(fragment))
        if not words or not used:
            return set()
        of_importon = set.union(*self.program.values())
        script = re.fullmatch(r"scripts/(\w+)", words[0])
        if script and (ROOT / words[0]).is_file():
            known = set(OPTION.findall((ROOT / words[0]).read_text())) | {"--help"}
            return used - known - (of_importon if script[1] in PASSES_ON else set())
        if words[0] == "importon":
            command = words[1] if len(words) > 1 else ""
            return used - self.program.get(command, self.program["" if command.startswith("-") else "render"])
        return used - of_importon - self.of_scripts() if words[0].startswith("--") else set()

    @staticmethod
    def of_scripts():
        files = [file for file in (ROOT / "scripts").iterdir() if file.is_file()]
        return {option for file in files for option in OPTION.findall(file.read_text())}

    def assert_none(self, what, found):
        self.assertEqual([], [f"{page.relative_to(ROOT)}: {what} {name}" for page, name in found])

    def test_has_pages_links_and_commands(self):
        self.assertGreater(len(PAGES), 10)
        self.assertGreater(sum(len(links(page)) for page in PAGES), 50)
        self.assertLessEqual({"render", "info", "compare", "converge", "study", "merge", "devices"}, set(self.program))
        self.assertIn("--passes", self.program["render"])

    def test_links_lead_to_files_and_headings(self):
        found = []
        for page in PAGES:
            for target in links(page):
                path, _, heading = target.partition("#")
                file = page.parent / path if path else page
                if not file.exists() or (heading and file.suffix == ".md" and heading not in anchors(file)):
                    found.append((page, target))
        self.assert_none("no such place", found)

    def test_pages_that_sources_name_exist(self):
        folders = [ROOT / name for name in ("bench", "scripts", "shaders", "src", "tests")]
        sources = [file for folder in folders for file in folder.rglob("*")
                   if file.is_file() and "__pycache__" not in file.parts and file.suffix in SOURCES]
        self.assertGreater(len(sources), 400)
        named = re.compile(r"\bdocs/[\w/-]+\.(?:md|svg|jpg)\b")
        found = [(file, page) for file in sources for page in named.findall(file.read_text())
                 if not (ROOT / page).exists()]
        self.assert_none("no such page", found)

    def test_scripts_exist(self):
        found = [(page, name) for page in PAGES for name in re.findall(r"\bscripts/\w+", page.read_text())
                 if not (ROOT / name).exists()]
        self.assert_none("no such script", found)

    def test_commands_exist(self):
        found = []
        for page in PAGES:
            for fragment in fragments(page.read_text()):
                command = re.match(r"importon ([a-z]+)(?=\s|$)", fragment)
                if command and command[1] not in self.program:
                    found.append((page, fragment))
        self.assert_none("no such command", found)

    def test_options_exist(self):
        found = [(page, f"{option} ({fragment})") for page in PAGES for fragment in fragments(page.read_text())
                 for option in sorted(self.missing_options(fragment))]
        self.assert_none("no such option", found)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
