#!/usr/bin/env python3
"""slurm_test.py MEDIAL_VK KILLING_LIBRARY [--meshes N] [--seed S] [--chunk N]: the workflow on a cluster that fails.

Starts a cluster of two nodes on loopback, generates N meshes (1000) and runs the workflow, while jobs are cancelled, put
into the queue again and killed, nodes lose their power, the controller ends, and Snakemake is killed: in an order that the
seed decides, at targets that it decides. All is started again until the workflow ends. Then every mesh must be in the table
once, with the bytes of a run on one machine, and nothing may be left behind. Exit code 77: Slurm or Snakemake is missing.
"""
import argparse
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import cluster
from meshes import KILLERS, write_meshes
from workflow_runs import WorkflowFolder, check

KINDS = {"cancel a job": 3, "put a job into the queue again": 3, "kill the processes of a job": 3, "kill medial-vk": 3,
         "kill a node": 3, "kill the controller": 2, "kill snakemake": 3}
SECONDS_AT_MOST = 2400


def plan_of_failures(seed):
    """Kinds in their order, each with the pause before it, in seconds, a target as a share of those that there are, and how
    long what was killed is away."""
    draw = random.Random(seed)
    kinds = [kind for kind, count in KINDS.items() for _ in range(count)]
    draw.shuffle(kinds)
    failures = []
    for kind in kinds:
        pause, target = draw.uniform(1, 6), draw.random()
        away = draw.uniform(1, 15)
        failures.append((kind, pause, target, away))
    return failures


class Run:
    def __init__(self, work, slurm, settings):
        self.work, self.slurm, self.settings = work, slurm, settings
        self.snakemake, self.starts = None, 0
        self.returns = []  # of daemons: time and call

    def start_snakemake(self):
        """A Snakemake that was killed leaves the lock of its folder."""
        subprocess.run(self.work.snakemake("local", "--unlock", **self.settings), cwd=self.work.folder,
                       env=self.slurm.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        with open(self.work.folder / "snakemake.log", "ab") as log:
            self.snakemake = subprocess.Popen(
                self.work.snakemake("slurm", "--latency-wait", "5", **self.settings), cwd=self.work.folder,
                env=self.slurm.environment, stdout=log, stderr=log, preexec_fn=cluster.end_with_parent)
        self.starts += 1

    def processes_of_job(self, target, program_alone):
        jobs = sorted(process for node in self.slurm.nodes for process in self.slurm.processes_of_node(node))
        if program_alone:
            name = pathlib.Path(self.work.real_program).name[:15].encode()  # as the kernel keeps it
            jobs = [process for process in jobs if cluster.read(pathlib.Path(f"/proc/{process}/comm")).strip() == name]
            return [jobs[int(target * len(jobs))]] if jobs else []
        node = self.slurm.nodes[int(target * len(self.slurm.nodes))]
        return sorted(self.slurm.processes_of_node(node))

    def fail(self, kind, target, away):
        """Whether there was something to fail."""
        if kind in ("cancel a job", "put a job into the queue again"):
            jobs = self.slurm.running_jobs()
            if not jobs:
                return False
            job = jobs[int(target * len(jobs))]
            self.slurm.call(*(["scancel"] if kind == "cancel a job" else ["scontrol", "requeue"]), job)
        elif kind in ("kill the processes of a job", "kill medial-vk"):
            processes = self.processes_of_job(target, kind == "kill medial-vk")
            cluster.kill(processes)
            return bool(processes)
        elif kind == "kill a node":
            node = self.slurm.nodes[int(target * len(self.slurm.nodes))]
            if node not in self.slurm.daemons or not self.slurm.processes_of_node(node):
                return False
            self.slurm.kill_node(node)
            self.returns.append((time.monotonic() + away, lambda: self.slurm.start_node(node)))
        elif kind == "kill the controller":
            if "slurmctld" not in self.slurm.daemons:
                return False
            self.slurm.kill_daemon("slurmctld")
            self.returns.append((time.monotonic() + away, self.slurm.start_controller))
        elif kind == "kill snakemake":
            if self.snakemake.poll() is not None:
                return False
            self.snakemake.kill()
            self.snakemake.wait()
        return True

    def keep_running(self):
        """What was killed comes back; Snakemake is started again until it ends well. True: it has."""
        now = time.monotonic()
        for back in [back for back in self.returns if back[0] <= now]:
            self.returns.remove(back)
            back[1]()
        self.slurm.repair_nodes()
        cluster.reap({self.snakemake.pid, *(daemon.pid for daemon in self.slurm.daemons.values())})
        code = self.snakemake.poll()
        if code is None:
            return False
        if code != 0:
            print(f"snakemake ended with {code}: it is started again", flush=True)
            self.start_snakemake()
        return code == 0

    def to_the_end(self, failures):
        end = time.monotonic() + SECONDS_AT_MOST
        self.start_snakemake()
        waiting = list(failures)
        next_time = time.monotonic() + 8  # the first jobs run
        while not self.keep_running():
            check(time.monotonic() < end, "the workflow does not end:\n" + self.slurm.logs())
            if waiting and time.monotonic() >= next_time:
                kind, pause, target, away = waiting[0]
                if self.fail(kind, target, away):
                    print(f"{kind} ({target:.3f}, {away:.1f} s)", flush=True)
                    waiting.pop(0)
                    next_time = time.monotonic() + pause
            time.sleep(0.25)
        return waiting


def wait_for_jobs(slurm, run):
    """Nothing of the run is in the queue, or runs, after it."""
    end = time.monotonic() + 120
    while time.monotonic() < end:
        for _, back in run.returns:
            back()
        run.returns.clear()
        slurm.repair_nodes()
        if not slurm.call("squeue", "--noheader", "--format=%i").strip() and slurm.wait_until_idle(5):
            break
    check(not slurm.call("squeue", "--noheader").strip(), "jobs are left in the queue:\n" + slurm.call("squeue"))
    left = [process for node in slurm.nodes for process in slurm.processes_of_node(node)]
    check(not left, f"processes of jobs are left: {[cluster.read(pathlib.Path(f'/proc/{p}/cmdline')) for p in left]}")


def test(folder, given):
    work = WorkflowFolder(folder, given.medial_vk, "--resolution 12 --sheet-curve .csv", given.killing_library)
    killers = KILLERS[:2]
    failures = write_meshes(work.meshes, given.meshes, given.seed, killers)
    killers = {name for name in failures if name.rsplit("/", 1)[-1] in killers}
    slurm = cluster.Cluster(folder / "slurm", nodes=2, cpus=1, megabytes=4000)
    slurm.start()
    run = Run(work, slurm, {"chunk": given.chunk, "threads": 1, "memory": 800, "minutes": 5, "retries": 3})
    begin = time.monotonic()
    planned = plan_of_failures(given.seed)
    late = run.to_the_end(planned)
    print(f"the workflow took {time.monotonic() - begin:.0f} s, with {run.starts} starts of Snakemake; "
          f"{len(planned) - len(late)} failures of {len(planned)} came before its end", flush=True)
    check(not late, f"the workflow ended before {len(late)} failures came: use more --meshes than {given.meshes}")
    wait_for_jobs(slurm, run)
    rows = work.check_results(failures, killers)
    for name in killers:
        reason = "memory" if "memory" in name else "SIGSEGV"
        check(reason in rows[name].error, f"{name}: {rows[name].error}")
    # Once more: nothing is left to do, and nothing is done.
    before = work.keys()
    code, text = work.run(**run.settings)
    check(code == 0 and work.keys() == before, "a second run does something again:\n" + text[-2000:])
    print(f"{given.meshes} meshes, each once, with the bytes of a run alone: passed", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("medial_vk")
    parser.add_argument("killing_library")
    parser.add_argument("--meshes", type=int, default=1000)
    parser.add_argument("--chunk", type=int, default=25)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for all files, which stay there")
    given = parser.parse_args()
    missing = cluster.missing_programs() + ([] if shutil.which("snakemake") else ["snakemake"])
    if missing:
        print(f"SKIPPED: no {', '.join(missing)}")
        sys.exit(77)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("stopped"))
    with tempfile.TemporaryDirectory(prefix="mvk") as temporary:
        folder = given.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        try:
            test(folder, given)
        finally:
            cluster.adopt_orphans()
            cluster.kill_descendants()


main()
