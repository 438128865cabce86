"""The programs that the tables of docs/experiments are measured with."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from talk_tables.lab import ROOT

SCENES = ["cornell_box", "door_slit", "rooms", "ring", "glass_ball", "pool", "glass_caustic"]


def build():
    """Builds them; returns the folder."""
    script = 'source "$root/scripts/setup.sh"; ensurePackages run build test; build test importon importon_bench'
    subprocess.run(["bash", "-c", f'set -euo pipefail; root="{ROOT}"; {script}'], check=True)
    return ROOT / "build/test"


class Programs:
    def __init__(self, folder, is_small):
        self.importon, self.bench_program = folder / "bin/importon", folder / "bench/importon_bench"
        self.is_small, self.device = is_small, None

    def bench(self, names):
        """Counters of benchmarks by name. `names`: a regular expression."""
        words = [str(self.bench_program), f"--benchmark_filter=^({names})(/|$)", "--benchmark_format=json"]
        if self.is_small:
            words.append("--benchmark_min_time=0.01")
        done = subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True)
        found = json.loads(done.stdout)["benchmarks"]
        for run in found:
            if run.get("error_occurred"):
                sys.exit(f"importon: error: {run['error_message']} ({run['name']}): run importon_bench by hand")
        return {self._plain(run["name"]): run for run in found}

    @staticmethod
    def _plain(name):
        """Without what Google Benchmark adds on how it measured."""
        return "/".join(part for part in name.split("/") if ":" not in part and part != "manual_time")

    def render(self, scene, words, environment=None):
        """The statistics of a render of one of the project's scenes."""
        with tempfile.TemporaryDirectory() as scratch:
            stats = pathlib.Path(scratch) / "stats.json"
            outputs = ["-o", f"{scratch}/image.exr", "--stats", stats, "-q"]
            command = [self.importon, ROOT / f"scenes/{scene}/{scene}.gltf", *outputs, *words]
            subprocess.run(list(map(str, command)), check=True, env={**os.environ, **(environment or {})})
            found = json.loads(stats.read_text())
        self.device = found["device"]
        return found

    def device_line(self):
        if not self.device:
            self.render("cornell_box", ["--passes", 1, "--width", 16, "--height", 16])
        return f"On {self.device['name']}, {self.device['driver']}, {os.cpu_count()} cores."
