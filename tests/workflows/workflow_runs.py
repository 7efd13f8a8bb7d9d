"""Runs of the workflow in a temporary folder, and what must hold when one has ended."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
sys.path.insert(0, str(SOURCE / "workflows/scripts"))
from table import TABLE, Table  # noqa: E402

# The table's columns that are the same in every run.
TIMES = {"seconds_read", "seconds_prepare", "seconds_search", "seconds"}


class Folder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)


class WorkflowFolder:
    """`meshes` and `results` in a folder, a program, and its options."""

    def __init__(self, folder, program, options, killing_library=None):
        self.folder = pathlib.Path(folder)
        self.meshes, self.results = self.folder / "meshes", self.folder / "results"
        self.state = self.results / ".workflow"
        self.real_program, self.options = os.path.abspath(program), options
        self.program = self.real_program
        if killing_library:
            self.program = str(self.folder / "medial-vk")
            pathlib.Path(self.program).write_text(
                f"#!/bin/sh\nLD_PRELOAD='{os.path.abspath(killing_library)}' exec '{self.real_program}' \"$@\"\n")
            os.chmod(self.program, 0o755)

    def snakemake(self, profile, *more, **settings):
        """The command line."""
        settings = {"meshes": "meshes", "output": "results", "medial_vk": self.program, "options": self.options, **settings}
        return ["snakemake", "--snakefile", str(SOURCE / "workflows/Snakefile"), "--profile",
                str(SOURCE / "workflows/profiles" / profile), *more, "--config",
                *(f"{name}={value}" for name, value in settings.items())]

    def run(self, *more, environment=None, **settings):
        """With the profile `local`, to the end."""
        result = subprocess.run(self.snakemake("local", *more, **settings), cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, errors="replace", env=environment, check=False)
        return result.returncode, result.stdout

    def keys(self):
        return {record.parent.name: (record.name, record.stat().st_mtime_ns)
                for record in (self.state / "chunks").glob("*/done-*.json")}

    # ---- What must hold at the end.

    def alone(self, without=()):
        """The results of one run of the program on all meshes, but for those that would end it."""
        folder = self.folder / "alone"
        shutil.rmtree(folder, ignore_errors=True)
        names = subprocess.run([self.real_program, "batch", "--list", "meshes", "-o", "alone"], cwd=self.folder,
                               stdout=subprocess.PIPE, check=True).stdout.decode().splitlines()
        requested = "".join(f"{name}\n" for name in names if name not in without)
        code = subprocess.run([self.real_program, "batch", "-q", *self.options.split(), "-", "-o", folder],
                              input=requested.encode(), cwd=self.meshes, stderr=subprocess.DEVNULL, check=False).returncode
        check(code in (0, 9), f"the batch alone ended with {code}")
        return folder, set(names)

    def check_results(self, failures, killers=()):
        """Every mesh once, the bytes of a run alone, the failures that are known, and nothing else."""
        alone, names = self.alone(killers)
        lines = (self.results / TABLE).read_bytes().splitlines()[1:]
        rows, rows_alone = Table(self.results).rows, Table(alone).rows
        check(len(lines) == len(names), f"{len(lines)} lines for {len(names)} meshes")
        check(set(rows) == names, f"other meshes: {sorted(set(rows) ^ names)[:3]}")
        failed = {name for name, row in rows.items() if row.state != "done"}
        check(failed == set(failures), f"failed: {sorted((name, rows[name].error) for name in failed ^ set(failures))[:5]}")
        for name, row in rows_alone.items():
            mine = {column: cell for column, cell in rows[name].cells.items() if column not in TIMES}
            for column, cell in mine.items():
                check(row.cells[column] == cell, f"{name}: {column} is {cell}, alone {row.cells[column]}")
        files, files_alone = files_below(self.results), files_below(alone)
        own = {TABLE, "failures.csv", ".medial-vk.lock", *({"batch.html"} if "--html" in self.options else ())}
        check(set(files) - own == set(files_alone) - own,
              f"other files: {sorted((set(files) - own) ^ (set(files_alone) - own))[:5]}")
        for file in set(files_alone) - own:
            check(files[file].read_bytes() == files_alone[file].read_bytes(), f"{file} has other bytes than alone")
        if "--html" in self.options:
            page = (self.results / "batch.html").read_text()
            check(page.count("<article") == len(names), "the page has another number of meshes")
        self.check_state()
        return rows

    def check_state(self):
        """Of every chunk the plan, the record and the run of its results; no temporary file."""
        plan = json.loads((self.state / "plan.json").read_text())["chunks"]
        chunks = {folder.name for folder in (self.state / "chunks").iterdir()}
        check(chunks == set(plan), f"chunks of no plan: {sorted(chunks ^ set(plan))}")
        for number in chunks:
            folder = self.state / "chunks" / number
            check(len(list(folder.glob("plan-*.json"))) == 1, f"{number} has several plans")
            (record,) = folder.glob("done-*.json")
            runs = [run.name for run in (folder / "runs").iterdir()]
            check(runs == [json.loads(record.read_text())["run"]], f"{number} has the runs {runs}")
        for path in self.folder.rglob("*"):
            is_temporary = path.name.endswith(".part") or (path.name.startswith(".medial-vk.") and path.name != ".medial-vk.lock")
            check(not is_temporary, f"{path} is left behind")


def files_below(folder):
    """By relative name, without what the workflow keeps for itself."""
    return {str(path.relative_to(folder)): path for path in folder.rglob("*")
            if path.is_file() and ".workflow" not in path.relative_to(folder).parts}


def check(holds, message):
    if not holds:
        raise AssertionError(message)
