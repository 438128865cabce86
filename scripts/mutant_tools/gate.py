"""The gate: the tests that a plain scripts/test runs, as test programs that are built and run one by one."""
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import signal
import subprocess
import time

LABELS, LEFT_OUT = {"unit", "gpu", "render"}, {"slow"}  # as in scripts/test
LEAST_TIMEOUT = 300     # seconds
TIMEOUT_FACTOR = 10     # times what a program takes without a mutant: then it hangs
LONG_TIMEOUT = 7200     # without a mutant
TIMED_OUT = " (timeout)"
ARGUMENT_LIMIT = 100_000  # bytes of one argument that every Linux takes


class GateError(Exception):
    """The gate cannot be built, or fails without a mutant."""


class DoesNotCompile(Exception):
    """A mutant that the compiler finds is none."""


@dataclasses.dataclass
class Program:
    """Tests that are run by one command, one after the other."""
    name: str
    target: str    # what to build
    command: list  # without the choice of tests
    tests: list    # their names
    takes_choice: bool  # of tests; else the command is a single test
    folder: str    # to run it in
    digest: str = ""  # of the sources
    key: str = ""  # of the binaries that it ran
    passed: list = dataclasses.field(default_factory=list)  # tests that were seen to pass without a mutant
    seconds: float = 0  # that they took


@dataclasses.dataclass(frozen=True)
class Failure:
    program: str
    test: str


class Gate:
    def __init__(self, tree, folder, jobs, say):
        self.build_folder, self.tree, self.folder, self.say = tree / "build/test", tree, folder, say
        self.jobs = ["--parallel", str(jobs)] if jobs else []
        self.programs, self.digest = {}, ""
        (folder / "logs").mkdir(parents=True, exist_ok=True)
        self.environment = {**os.environ, "IMPORTON_REQUIRE_VULKAN": "1", "GTEST_COLOR": "no"}
        if not {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"} & set(os.environ):
            drivers = sorted(pathlib.Path("/usr/share/vulkan/icd.d").glob("lvp_icd*.json"))
            self.environment["VK_DRIVER_FILES"] = str(drivers[0]) if drivers else ""

    def pass_without_mutants(self, digest, likely=None):
        """Sees that the sources of a digest pass all tests, or those that are `likely` to fail by a mutant. What passed
        is kept: of other sources only programs that became others run again."""
        file = self.folder / "baseline.json"
        known = json.loads(file.read_text()) if file.exists() else {"whole": "", "programs": {}}
        self.programs = {name: Program(**entry) for name, entry in known["programs"].items()}
        self.digest = digest
        missing = {"all"} if likely is None else {failure.program for failure in likely if not self.knows(failure)}
        if known["whole"] == digest or not missing:
            return
        self._configure()
        self._build(sorted(missing), GateError)
        for program in self._programs_of_ctest():
            if likely is None or program.target in missing:
                wanted = {failure.test for failure in likely or []}
                self._renew(program, [test for test in program.tests if likely is None or test in wanted])
                self._keep(file, "")
        if likely is None:
            self._keep(file, digest)

    def _renew(self, program, wanted):
        """Runs what has not been seen to pass as it is now."""
        before = self.programs.get(program.name)
        program.digest, program.key = self.digest, self._key(program)
        if before and before.key == program.key:
            program.passed, program.seconds = before.passed, before.seconds
        self.programs[program.name] = program
        missing = [test for test in wanted if test not in program.passed]
        if not missing:
            return
        began = time.monotonic()
        failed = self._run(program, missing, LONG_TIMEOUT) and self._run(program, missing, LONG_TIMEOUT)
        if failed:
            raise GateError(f"without a mutant {failed} fails: {self._log(program)}")
        program.seconds += time.monotonic() - began
        program.passed += missing
        self.say(f"without mutants {program.name} passes {len(missing)} tests ({time.monotonic() - began:.0f} s)")

    def _of_these_sources(self):
        return [program for program in self.programs.values() if program.digest == self.digest]

    def knows(self, failure):
        """True if that test is one of the gate, and was seen to pass without a mutant."""
        return any(p.target == failure.program and failure.test in p.passed for p in self._of_these_sources())

    def first_failure(self, likely=None):
        """The first test that fails, of all or of one that is `likely`; None if all pass."""
        for program in sorted(self._of_these_sources(), key=lambda program: program.seconds):
            if likely and program.target != likely.program:
                continue
            failed = self._failure(program, [likely.test] if likely else program.passed)
            if failed:
                return Failure(program.target, failed)
        return None

    def _failure(self, program, tests):
        """Builds and runs a program; what was built as it was without the mutant passes as it did."""
        self._build([program.target], DoesNotCompile)
        if self._key(program) == program.key:
            return None
        failed = self._run(program, tests)
        # A test that fails once in a while is not a catch: a mutant fails it again. Nobody waits twice where one hangs.
        if not failed or failed.endswith(TIMED_OUT) or self._run(program, [failed] if failed in tests else tests):
            return failed
        self.say(f"  {failed} failed once and then passed")
        return self._run(program, tests)

    def _keep(self, file, whole):
        programs = {name: dataclasses.asdict(program) for name, program in self.programs.items()}
        file.write_text(json.dumps({"whole": whole, "programs": programs}))

    def _configure(self):
        if not (self.build_folder / "build.ninja").exists():
            command = ["cmake", "--preset", "test"]
            if subprocess.run(command, cwd=self.tree, stdout=subprocess.DEVNULL, check=False).returncode:
                raise GateError("cmake --preset test fails in the copy")

    def _build(self, targets, error):
        command = ["cmake", "--build", str(self.build_folder), *self.jobs, "--target", *targets]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            (self.folder / "logs/build.log").write_text(done.stdout + done.stderr)
            first = re.search(r"^.*(?:error|ERROR): .*$", done.stdout, re.M)
            raise error(f"{first[0] if first else 'building fails'}: {self.folder / 'logs/build.log'}")

    def _programs_of_ctest(self):
        command = ["ctest", "--test-dir", str(self.build_folder), "--show-only=json-v1"]
        listed = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
        return programs_of(listed["tests"], self.build_folder)

    def _key(self, program):
        """Of the binaries that a program is made of: itself, and the renderer if it runs that."""
        renderer = self.build_folder / "bin/importon"
        files = [pathlib.Path(word) for word in program.command if word.startswith(str(self.build_folder))]
        key = hashlib.sha256()
        for file in files:
            content = file.read_bytes()
            key.update(content)
            if file != renderer and str(renderer).encode() in content:
                key.update(renderer.read_bytes())
        return key.hexdigest()

    def _log(self, program):
        return self.folder / "logs" / (program.name + ".log")

    def _run(self, program, tests, timeout=None):
        """Runs tests of a program up to the first failure; returns its name, or None."""
        choice = ["--gtest_fail_fast", "--gtest_filter=" + ":".join(tests)] if program.takes_choice else []
        if choice and len(choice[1]) > ARGUMENT_LIMIT:
            raise GateError(f"{program.name} has too many tests for one command")
        log = self._log(program)
        with log.open("w") as out:
            process = subprocess.Popen(program.command + choice, cwd=program.folder, env=self.environment, stdout=out,
                                       stderr=subprocess.STDOUT, start_new_session=True)
            end = ""
            try:
                status = process.wait(timeout or max(LEAST_TIMEOUT, TIMEOUT_FACTOR * program.seconds))
            except subprocess.TimeoutExpired:
                status, end = 1, TIMED_OUT
            finally:
                if process.poll() is None:
                    os.killpg(process.pid, signal.SIGKILL)
                    process.wait()
        return (failed_test(log.read_text(errors="replace")) or program.tests[0]) + end if status else None


def failed_test(log):
    """The first test that failed by a log of GoogleTest; if none says so, the one that was running."""
    failed = re.search(r"^\[  FAILED  \] ([^\s,]+)", log, re.M)
    if failed:
        return failed[1]
    running = re.findall(r"^\[ RUN      \] (\S+)", log, re.M)
    return running[-1] if running else None


def programs_of(tests, build_folder):
    """The programs of the gate from CTest's list of tests: each program of GoogleTest once, with its tests of the gate;
    and single tests that run the renderer. Other scripts see nothing of what mutants change."""
    programs = {}
    for test in tests:
        properties = {entry["name"]: entry["value"] for entry in test.get("properties", [])}
        labels = set(properties.get("LABELS", []))
        command = test.get("command", [])
        if not labels & LABELS or labels & LEFT_OUT or not command:
            continue
        folder = properties.get("WORKING_DIRECTORY", str(build_folder))
        binary = pathlib.Path(command[0])
        choice = [word.removeprefix("--gtest_filter=") for word in command if word.startswith("--gtest_filter=")]
        if choice:
            program = programs.setdefault(command[0], Program(binary.name, binary.name, [command[0]], [], True, folder))
            program.tests.append(choice[0])
        elif str(build_folder / "bin/importon") in command:
            programs[test["name"]] = Program(test["name"], "importon", command, [test["name"]], False, folder)
    return list(programs.values())
