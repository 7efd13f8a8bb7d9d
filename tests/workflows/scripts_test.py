#!/usr/bin/env python3
"""scripts_test.py MEDIAL_VK KILLING_LIBRARY [TEST ...]: the jobs of workflows/ and the profile for Slurm, without Snakemake and
without Slurm."""
import json
import os
import pathlib
import stat
import subprocess
import sys
import tempfile
import time
import unittest

from meshes import torus
from workflow_runs import SOURCE, Folder, WorkflowFolder

import batch_process
import files
import plan
import table

MEDIAL_VK, KILLING_LIBRARY = sys.argv[1:3]
PROFILE = SOURCE / "workflows/profiles/slurm"


class Chunk(Folder):
    """run_chunk.py on meshes of which some end the process at every try."""

    def plan(self, names, options="--resolution 6 --backend cpu"):
        self.work = WorkflowFolder(self.folder, MEDIAL_VK, options, KILLING_LIBRARY)
        self.work.meshes.mkdir()
        for i, name in enumerate(names):
            (self.work.meshes / name).write_text(torus(i))
        self.plan_of(self.work.meshes, self.work.results)

    def plan_of(self, meshes, results):
        self.key = plan.make_plan({"meshes": meshes, "output": results, "medial_vk": self.work.program, "chunk": 100,
                                   "chunk_megabytes": 1, "options": self.work.options})
        self.chunk = results / ".workflow/chunks/000000"
        (self.chunk_key,) = [record.stem[len("plan-"):] for record in self.chunk.glob("plan-*.json")]

    def start(self, attempt=1, memory=2000, minutes=1.0):
        return subprocess.Popen([sys.executable, SOURCE / "workflows/scripts/run_chunk.py", self.chunk, self.chunk_key,
                                 "--attempt", str(attempt), "--last-attempt", "2", "--threads", "1", "--memory", str(memory),
                                 "--minutes", str(minutes)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def run_once(self, **given):
        process = self.start(**given)
        text = process.communicate()[0]
        return process.returncode, text

    def record(self):
        return json.loads((self.chunk / f"done-{self.chunk_key}.json").read_text())

    def rows(self):
        return table.Table(self.chunk / "runs" / self.record()["run"]).rows

    def test_a_mesh_that_ends_its_process_fails_and_others_do_not(self):
        self.plan(["a.obj", "kills-crash.obj", "kills-crash too.obj", "z.obj"])
        code, text = self.run_once()
        self.assertEqual(code, 0, text)
        rows = self.rows()
        self.assertEqual({name: row.state for name, row in rows.items()},
                         {"a.obj": "done", "kills-crash.obj": "failed", "kills-crash too.obj": "failed", "z.obj": "done"})
        self.assertIn("SIGSEGV", rows["kills-crash.obj"].error)
        self.assertEqual(self.record()["failed"], 2)

    # Names of absolute paths, and of those that lead upwards, are paths from the root; a name may begin with a blank.
    def test_names_of_any_kind(self):
        self.plan(["a.obj", "kills-crash.obj", " b.obj", "-c.obj"])
        lists = self.folder / "lists"
        lists.mkdir()
        (lists / "some.txt").write_text(f"../meshes/a.obj\n{self.folder}/meshes/kills-crash.obj\n")
        self.assertEqual(self.run_once()[0], 0)
        self.assertEqual({name: row.state for name, row in self.rows().items()},
                         {"a.obj": "done", "kills-crash.obj": "failed", " b.obj": "done", "-c.obj": "done"})
        self.plan_of(lists / "some.txt", self.folder / "other")
        self.assertEqual(self.run_once()[0], 0)
        root = str(self.folder.resolve())[1:]
        self.assertEqual({name: row.state for name, row in self.rows().items()},
                         {f"{root}/meshes/a.obj": "done", f"{root}/meshes/kills-crash.obj": "failed"})
        subprocess.run([sys.executable, SOURCE / "workflows/scripts/merge.py", self.folder / "other", self.key], check=True,
                       stderr=subprocess.DEVNULL)
        self.assertEqual(set(table.Table(self.folder / "other").rows), set(self.rows()))
        self.assertTrue((self.folder / f"other/{root}/meshes/a.obj.medial.ply").is_file())
        self.assertIn("SIGSEGV", (self.folder / "other/failures.csv").read_text())

    def test_memory_and_time_are_decided_by_the_last_attempt(self):
        for name, given, word in (("kills-memory.obj", {"memory": 500}, "500 MB"), ("kills-time.obj", {"minutes": 0.03}, "minutes")):
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                self.folder = pathlib.Path(folder)
                self.plan(["a.obj", name])
                code, text = self.run_once(**given)  # where it is one of several
                self.assertEqual(code, 1, text)
                self.assertFalse((self.chunk / f"done-{self.chunk_key}.json").exists())
                code, text = self.run_once(attempt=2, **given)
                self.assertEqual(code, 0, text)
                self.assertIn(word, self.rows()[name].error)
                self.assertEqual(self.rows()["a.obj"].state, "done")

    def test_a_run_takes_over_what_a_killed_one_has_done(self):
        self.plan(["a.obj", "b.obj", "kills-time.obj", "z.obj"])
        process = self.start()
        (run,) = self.wait_for(lambda: list((self.chunk / "runs").glob("*")))
        self.wait_for(lambda: "kills-time.obj" in table.Table(run).rows)
        process.kill()
        process.communicate()
        before = os.stat(run / "a.obj.medial.ply").st_ino
        code, text = self.run_once(attempt=2, minutes=0.03)
        self.assertEqual(code, 0, text)
        new = self.chunk / "runs" / self.record()["run"]
        self.assertNotEqual(new, run)
        self.assertEqual(os.stat(new / "a.obj.medial.ply").st_ino, before)
        self.assertEqual({name: row.state for name, row in self.rows().items()},
                         {"a.obj": "done", "b.obj": "done", "kills-time.obj": "failed", "z.obj": "done"})

    def merge(self):
        return subprocess.run([sys.executable, SOURCE / "workflows/scripts/merge.py", self.work.results, self.key],
                              capture_output=True, text=True, check=False)

    def test_a_merge_keeps_what_a_chunk_has_lost(self):
        self.plan(["a.obj", "b.obj"])
        self.assertEqual(self.run_once()[0], 0)
        self.assertEqual(self.merge().returncode, 0)
        merged, table_before = self.work.results / "b.obj.medial.ply", (self.work.results / "batch.csv").read_bytes()
        before = merged.read_bytes()
        (self.chunk / "runs" / self.record()["run"] / "b.obj.medial.ply").unlink()
        result = self.merge()
        self.assertEqual(result.returncode, 1)
        self.assertIn("b.obj.medial.ply", result.stderr)
        self.assertEqual((merged.read_bytes(), (self.work.results / "batch.csv").read_bytes()), (before, table_before))
        self.assertFalse((self.chunk / f"done-{self.chunk_key}.json").exists())
        # The next job takes over what is there.
        (earlier,) = (self.chunk / "runs").iterdir()
        self.assertEqual(self.run_once()[0], 0)
        run = self.chunk / "runs" / self.record()["run"]
        self.assertTrue(os.path.samefile(run / "a.obj.medial.ply", earlier / "a.obj.medial.ply"))
        self.assertEqual((run / "b.obj.medial.ply").read_bytes(), before)

    def test_a_run_that_lacks_a_file_hides_no_other(self):
        self.plan(["a.obj"], "--resolution 6 --backend cpu --report .json")
        names = []
        for _ in range(2):
            self.assertEqual(self.run_once()[0], 0)
            names.append(self.record()["run"])
        (self.chunk / "runs" / max(names) / "a.obj.report.json").unlink()
        code, text = self.run_once()
        self.assertEqual(code, 0, text)
        run = self.chunk / "runs" / self.record()["run"]
        self.assertTrue(os.path.samefile(run / "a.obj.report.json", self.chunk / "runs" / min(names) / "a.obj.report.json"))

    def test_after_a_stop_no_process_begins(self):
        process = batch_process.BatchProcess(100, time.monotonic() + 60, 1)
        process.stop()
        end = process.run(["touch", self.folder / "begun"], self.folder, b"", self.folder / "log")
        self.assertEqual((end.code, end.cause), (None, "stopped"))
        self.assertFalse((self.folder / "begun").exists())

    # A job that no run sees the end of: its limit is that of the system, which kills all of it.
    def test_a_mesh_that_ends_its_jobs_fails_after_some(self):
        self.plan(["a.obj", "kills-time.obj"])
        for expected in (None, "kills-time.obj", "kills-time.obj", "kills-time.obj"):
            before = set((self.chunk / "runs").glob("*"))
            process = self.start()
            self.wait_for(lambda: self.is_at_work(before, expected))
            process.kill()
            process.communicate()
        code, text = self.run_once()
        self.assertEqual(code, 0, text)
        self.assertIn("3 jobs ended while it was at work alone", self.rows()["kills-time.obj"].error)
        self.assertEqual(self.rows()["a.obj"].state, "done")

    def is_at_work(self, before, alone):
        """Whether a run that was not there before works on the mesh."""
        for run in set((self.chunk / "runs").glob("*")) - before:
            row = table.Table(run).rows.get("kills-time.obj")
            if row is not None and row.state == "started" and files.read_json(run / "run.json")["alone"] == alone:
                return True
        return False

    # Slurm has put a job into the queue again, and its first copy still runs.
    def test_runs_at_once_do_not_interfere(self):
        self.plan([f"{i:02}.obj" for i in range(12)])
        both = [self.start(), self.start(), self.start()]
        for process in both:
            text = process.communicate()[0]
            self.assertEqual(process.returncode, 0, text)
        self.assertEqual(len(list((self.chunk / "runs").iterdir())), 3)
        self.assertEqual([row.state for row in self.rows().values()], ["done"] * 12)
        for run in (self.chunk / "runs").iterdir():
            self.assertEqual([row.state for row in table.Table(run).rows.values()], ["done"] * 12)

    def test_sigterm_ends_a_run_and_keeps_what_is_done(self):
        self.plan(["a.obj", "kills-time.obj"])
        process = self.start()
        (run,) = self.wait_for(lambda: list((self.chunk / "runs").glob("*")))
        self.wait_for(lambda: "kills-time.obj" in table.Table(run).rows)
        process.terminate()
        text = process.communicate(timeout=60)[0]
        self.assertEqual(process.returncode, 1, text)
        self.assertIn("stopped by a signal: 1 of 2 meshes are left", text)

    def wait_for(self, what):
        for _ in range(600):
            if found := what():
                return found
            time.sleep(0.05)
        self.fail("it does not happen")


class Slurm(Folder):
    """The scripts of the profile, with commands of Slurm that say what the test tells them."""

    def setUp(self):
        super().setUp()
        (self.folder / "bin").mkdir()
        for name in ("squeue", "sacct", "sbatch", "scontrol", "scancel"):
            self.program(name, 'echo "$@" >> calls; exit 1')

    def program(self, name, text):
        path = self.folder / "bin" / name
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)

    def call(self, name, *arguments):
        environment = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"}
        result = subprocess.run([PROFILE / name, *arguments], cwd=self.folder, env=environment,
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.strip()

    def queue(self, *lines):
        (self.folder / ".snakemake/slurm").mkdir(parents=True, exist_ok=True)
        (self.folder / ".snakemake/slurm/queue").unlink(missing_ok=True)
        self.program("squeue", "\n".join(["echo \"$@\" >> calls", *(f"echo '{line}'" for line in lines)]))

    def test_states_of_the_queue(self):
        for state, told in (("RUNNING", "running"), ("PENDING", "running"), ("COMPLETING", "running"), ("COMPLETED", "success"),
                            ("FAILED", "failed"), ("TIMEOUT", "failed"), ("OUT_OF_MEMORY", "failed"), ("NODE_FAIL", "failed"),
                            ("CANCELLED", "failed")):
            self.queue("17|PENDING|None", f"7|{state}|None")
            self.assertEqual(self.call("status", "7"), told, state)

    def test_a_controller_that_does_not_answer_ends_no_job(self):
        self.assertEqual(self.call("status", "7"), "running")

    def test_a_job_that_slurm_has_forgotten(self):
        self.queue("17|RUNNING|None")
        self.assertEqual(self.call("status", "7"), "failed")
        self.program("sacct", "echo COMPLETED")
        self.assertEqual(self.call("status", "7"), "success")
        self.program("sacct", "echo 'CANCELLED by 0'")
        self.assertEqual(self.call("status", "7"), "failed")
        (self.folder / ".snakemake/slurm/7").write_text("0\n")
        self.assertEqual(self.call("status", "7"), "success")
        (self.folder / ".snakemake/slurm/7").write_text("1\n")
        self.assertEqual(self.call("status", "7"), "failed")

    def test_one_answer_is_for_many_jobs_but_not_for_new_ones(self):
        self.queue(*(f"{job}|RUNNING|None" for job in range(10)))
        for job in range(10):
            self.assertEqual(self.call("status", str(job)), "running")
        self.assertLessEqual((self.folder / "calls").read_text().count("--states=all"), 3)
        (self.folder / "calls").unlink()
        self.program("squeue", 'echo "$@" >> calls; echo "11|RUNNING|None"')
        self.assertEqual(self.call("status", "11"), "running")

    def test_an_answer_with_a_time_to_come_is_old(self):
        self.queue("7|RUNNING|None")
        self.assertEqual(self.call("status", "7"), "running")
        to_come = time.time() + 3600
        os.utime(self.folder / ".snakemake/slurm/queue", (to_come, to_come))
        self.program("squeue", 'echo "7|COMPLETED|None"')
        self.assertEqual(self.call("status", "7"), "success")

    def test_a_folder_with_signs_of_slurm(self):
        self.folder = self.folder / "a, 50%x"
        (self.folder / "bin").mkdir(parents=True)
        job = {"rule": "chunk", "output": ["results/done.json"], "resources": {}}
        (self.folder / "job.sh").write_text(f"#!/bin/sh\n# properties = {json.dumps(job)}\n")
        self.program("squeue", "exit 0")
        self.program("sbatch", 'printf "%s\\n" "$MEDIAL_VK_ENDS" "$@" > calls; echo 12')
        self.assertEqual(self.call("submit", "job.sh"), "12")
        lines = (self.folder / "calls").read_text().splitlines()
        ends = str(self.folder / ".snakemake/slurm")
        self.assertEqual(lines[0], ends)
        self.assertIn("--export=ALL", lines)
        self.assertIn(f"--output={ends.replace('%', '%%')}/%x-%j.log", lines)

    def test_a_job_on_hold_after_a_failed_start_is_released(self):
        self.queue("7|PENDING|launch failed requeued held")
        self.assertEqual(self.call("status", "7"), "running")
        self.assertIn("release 7", (self.folder / "calls").read_text())

    def test_a_job_is_submitted_once(self):
        job = {"rule": "chunk", "output": ["results/done.json"], "wildcards": {"chunk": "000003"}, "threads": 2,
               "resources": {"mem_mb": 300, "runtime": 5, "partition": "main", "gres": "gpu:1"}}
        (self.folder / "job.sh").write_text(f"#!/bin/sh\n# properties = {json.dumps(job)}\n")
        self.program("squeue", "exit 0")
        self.program("sbatch", "echo \"$@\" >> calls; echo '12;cluster'")
        self.assertEqual(self.call("submit", "job.sh"), "12")
        submitted = (self.folder / "calls").read_text()
        for option in ("--mem=300M", "--time=5", "--partition=main", "--gres=gpu:1", "--cpus-per-task=2", "--requeue"):
            self.assertIn(option, submitted)
        name = submitted.split("--job-name=")[1].split()[0]
        # Snakemake was killed and started again: the job is in the queue.
        self.program("squeue", f'case "$*" in *--name={name}*) echo 12;; esac')
        self.program("sbatch", "echo 13")
        self.assertEqual(self.call("submit", "job.sh"), "12")
        job["output"] = ["other/done.json"]
        (self.folder / "job.sh").write_text(f"#!/bin/sh\n# properties = {json.dumps(job)}\n")
        self.assertEqual(self.call("submit", "job.sh"), "13")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
