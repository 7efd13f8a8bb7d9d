"""run_chunk.py CHUNK KEY --attempt N --last-attempt N --threads N --memory MB --minutes M

Runs `medial-vk batch` on the meshes of a chunk until each of them is done or has failed, and writes the record
CHUNK/done-KEY.json. Every run works in a folder of its own, CHUNK/runs/..., which no other run writes to: two runs of one
chunk, such as a job that Slurm has put into the queue again and its first copy, on a node that does not answer, do not
interfere, and no lock of a file system is relied on. A run takes over what earlier ones have done, by links to their
files, which `medial-vk batch` never changes in place.

A mesh at whose work the process ends is tried again, alone. If it then ends the process again, it has failed, and the
others go on. Where memory or time were short, that is decided by the last attempt, which has most of both: --memory is that
of this attempt, --minutes that of the first one.
"""
import argparse
import errno
import os
import pathlib
import shutil
import signal
import socket
import sys
import time

from batch_process import BatchProcess
from files import bytes_of, read_json, write_json
from table import AT_WORK, WITH_RESULTS, Table, name_of_line, write_table

# A mesh that ends its process so often, alone, has failed.
DEATHS_ALONE = 2
# So many jobs ended while a mesh was alone at work, for reasons that no run has seen.
JOBS_ENDED_ALONE = 3
# Kept free for the interpreter of this program and for Snakemake's.
MEGABYTES_OF_OTHERS = 250
BATCH_ENDS_WELL = (0, 9)


def parse_arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("chunk", type=pathlib.Path)
    parser.add_argument("key")
    for name in ("--attempt", "--last-attempt", "--threads", "--memory"):
        parser.add_argument(name, type=int, required=True)
    parser.add_argument("--minutes", type=float, required=True)
    return parser.parse_args()


def link_or_copy(source, target):
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        os.link(source, target)
    except OSError as error:
        if error.errno not in (errno.EXDEV, errno.EPERM, errno.EMLINK, errno.ENOTSUP, errno.EOPNOTSUPP):
            raise
        shutil.copyfile(source, target)


class ChunkRun:
    def __init__(self, arguments):
        self.given = arguments
        self.chunk = arguments.chunk.absolute()
        self.plan = read_json(self.chunk / f"plan-{arguments.key}.json")
        if self.plan is None:
            sys.exit(f"there is no plan {self.chunk}/plan-{arguments.key}.json")
        self.line_of = {name_of_line(line): line for line in self.plan["meshes"]}
        self.names = list(self.line_of)
        self.is_last = arguments.attempt >= arguments.last_attempt
        self.minutes = arguments.minutes * min(arguments.attempt, arguments.last_attempt)
        seconds = 60 * self.minutes
        megabytes = max(arguments.memory - MEGABYTES_OF_OTHERS, arguments.memory / 2)
        self.process = BatchProcess(megabytes, time.monotonic() + seconds - min(60, seconds / 10), arguments.threads)
        self.earlier = self.earlier_runs()
        name = f"{time.strftime('%Y%m%dT%H%M%S', time.gmtime())}-{socket.gethostname()}-{os.getpid()}-{os.urandom(4).hex()}"
        self.run = self.chunk / "runs" / name
        self.run.mkdir(parents=True)
        self.about = {"key": arguments.key, "attempt": arguments.attempt, "job": os.environ.get("SLURM_JOB_ID", ""),
                      "alone": None, "ended": False, "suspects": []}
        self.tell()

    def tell(self):
        write_json(self.run / "run.json", self.about)

    def earlier_runs(self):
        """Newest first, those of the same key before others."""
        runs = [(read_json(folder / "run.json") or {}, folder) for folder in (self.chunk / "runs").glob("*")]
        runs.sort(key=lambda run: (run[0].get("key") == self.given.key, run[1].name), reverse=True)
        return runs

    # ---- What earlier runs have done.

    def take_over(self, suspects):
        """Results, whose meshes are read again to compare their content, and failures of the same key; nothing of
        suspects."""
        lines, requested, header = {}, set(self.names) - set(suspects), b""
        for about, folder in self.earlier:
            table = Table(folder)
            header = header or table.header
            for name, row in table.rows.items():
                if name not in requested or name in lines or table.header != header:
                    continue
                is_failure = row.state == "failed" and about.get("key") == self.given.key
                if is_failure and not row.files():
                    lines[name] = row.line
                elif (row.state in WITH_RESULTS or is_failure) and self.take_files(row, folder):
                    lines[name] = row.line
        if header:
            write_table(self.run, header, lines.values())

    def take_files(self, row, folder):
        taken = []
        try:
            for file in row.files():
                link_or_copy(folder / file, self.run / file)
                taken.append(self.run / file)
        except FileNotFoundError:  # removed by a merge, or by the run that made it
            for file in taken:  # another run may have all of them
                file.unlink()
            return False
        return True

    def suspects_of_earlier_jobs(self):
        """Meshes that ended a process, were at work when time was over, or when a job ended without a word; each with the
        number of jobs that ended without a word while it was alone."""
        suspects = {}
        for about, folder in self.earlier:
            if about.get("key") != self.given.key:
                continue
            has_ended = about.get("ended", True)
            at_work = [] if has_ended else [name for name, row in Table(folder).rows.items() if row.state in AT_WORK]
            for name in dict.fromkeys([*about.get("suspects", []), *at_work]):
                was_alone = not has_ended and about.get("alone") == name and name in at_work
                suspects[name] = suspects.get(name, 0) + was_alone
        return suspects

    # ---- Runs of the program.

    def batch(self, names):
        """Lists leave out blanks at the ends of lines, so that such names are arguments."""
        given = [self.line_of[name] for name in names]
        in_list = [line for line in given if line == line.strip()]
        others = [line if os.path.isabs(line) else f"./{line}" for line in given if line != line.strip()]
        command = [self.plan["program"], "batch", "-q", *self.plan["options"], "--threads", str(self.given.threads),
                   *(["-"] if in_list else []), *others, "-o", str(self.run)]
        lines = b"".join(bytes_of(line) + b"\n" for line in in_list)
        return self.process.run([bytes_of(word) for word in command], self.plan["base"], lines, self.run / "log")

    def settled(self):
        return {name for name, row in Table(self.run).rows.items() if row.is_settled()}

    def failed_before(self):
        """Of this key: they are not tried again."""
        return {name for name, row in Table(self.run).rows.items() if row.state == "failed"}

    def at_work(self):
        return [name for name, row in Table(self.run).rows.items() if row.state in AT_WORK]

    def run_together(self, suspects):
        """All meshes but those that may end the process, and those that an earlier run of this key saw fail."""
        pending = [name for name in self.names if name not in self.failed_before()]
        ends_without_mesh = 0
        while names := [name for name in pending if name not in suspects]:
            end = self.batch(names)
            if end.code in BATCH_ENDS_WELL and end.cause is None:
                return
            found = [name for name in self.at_work() if name not in suspects]
            if end.cause != "stopped":
                self.about["suspects"] += found
            if end.cause in ("stopped", "time"):
                self.leave(end)
            if not end.is_death() and end.cause is None:
                self.give_up(f"medial-vk batch ended with {end.code}")
            print(f"{', '.join(map(repr, found)) or 'no mesh'} at work: {end.reason()}", flush=True)
            suspects.update((name, 0) for name in found)
            ends_without_mesh += not found
            if ends_without_mesh >= DEATHS_ALONE:
                self.give_up("medial-vk batch ends before it begins a mesh")

    def run_alone(self, name, jobs_ended):
        if jobs_ended >= JOBS_ENDED_ALONE:
            return self.fail(name, f"{jobs_ended} jobs ended while it was at work alone")
        self.about["alone"] = name
        self.tell()
        deaths, begin = 0, time.monotonic()
        while True:
            end = self.batch([name])
            if end.code in BATCH_ENDS_WELL and end.cause is None:
                return None
            if end.cause == "stopped":
                self.leave(end)
            if end.cause in ("time", "memory"):
                # Where others took most of the time of this job, the next one begins with this mesh.
                had_time = end.cause == "memory" or time.monotonic() - begin > 30 * self.minutes
                if not self.is_last or not had_time:
                    self.leave(end)
                return self.fail(name, f"it needs more than {self.minutes:g} minutes" if end.cause == "time" else
                                 f"it needs more than {self.given.memory} MB of memory")
            if not end.is_death():
                self.give_up(f"medial-vk batch ended with {end.code}")
            deaths += 1
            print(f"{name!r} alone: {end.reason()}", flush=True)
            if deaths < DEATHS_ALONE:
                continue
            # The kernel ends processes so where memory is short.
            if end.code in (-signal.SIGKILL, 5) and not self.is_last:
                self.give_up("another attempt has more memory")
            return self.fail(name, end.reason())

    def fail(self, name, reason):
        """The line is that of a batch whose mesh has failed; its files, if there are any, are no results."""
        print(f"{name!r} failed: {reason}", flush=True)
        table = Table(self.run)
        at_work = table.rows.pop(name, None)
        for file in at_work.files() if at_work else []:
            (self.run / file).unlink(missing_ok=True)
        file = os.path.realpath(os.path.join(self.plan["base"], self.line_of[name]))
        line = table.failed_line(name, file, reason)
        write_table(self.run, table.header, [*(row.line for row in table.rows.values()), line])

    def leave(self, end):
        self.give_up({"stopped": "stopped by a signal", "time": "its time is over", "memory": "its memory is too small"}
                     [end.cause])

    def give_up(self, reason):
        self.about["ended"] = True
        self.tell()
        print((self.run / "log").read_text(errors="replace")[-4000:], file=sys.stderr)
        sys.exit(f"{reason}: {len(self.names) - len(self.settled())} of {len(self.names)} meshes are left")

    # ---- The end.

    def record(self):
        table = Table(self.run)
        missing = [name for name in self.names if name not in self.settled()]
        if missing or set(table.rows) != set(self.names):
            self.give_up(f"the table lacks {missing[:1]}")
        write_table(self.run, table.header, [table.rows[name].line for name in self.names])
        for file in [*self.run.rglob(".medial-vk.*"), *self.run.glob(".*.part")]:  # of processes that were killed
            file.unlink(missing_ok=True)
        self.about.update(ended=True, alone=None)
        self.tell()
        failed = sum(table.rows[name].state == "failed" for name in self.names)
        write_json(self.chunk / f"done-{self.given.key}.json",
                   {"run": self.run.name, "meshes": len(self.names), "failed": failed})
        print(f"{len(self.names)} meshes, {failed} failed", flush=True)

    def work(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, lambda *_: self.process.stop())
        suspects = self.suspects_of_earlier_jobs()
        self.take_over(suspects)
        self.run_together(suspects)
        for name, jobs in suspects.items():
            self.run_alone(name, jobs)
        self.record()


if __name__ == "__main__":
    ChunkRun(parse_arguments()).work()
