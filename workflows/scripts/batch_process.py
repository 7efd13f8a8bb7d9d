"""`medial-vk batch` as a process that is watched: its memory, its time, and how it ended."""
import ctypes
import os
import pathlib
import signal
import subprocess
import time

SECONDS_BETWEEN_LOOKS = 0.2
SECONDS_TO_END = 20
PR_SET_PDEATHSIG = 1


def end_with_parent():
    """If the process that watches is killed, this one ends, too."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def children_of(process):
    try:
        tasks = list(pathlib.Path(f"/proc/{process}/task").iterdir())
        return [int(child) for task in tasks for child in (task / "children").read_text().split()]
    except (OSError, ValueError):
        return []


def resident_megabytes(process):
    """Of a process and those that it has started."""
    try:
        pages = int(pathlib.Path(f"/proc/{process}/statm").read_text().split()[1])
    except (OSError, IndexError, ValueError):
        pages = 0
    return pages * os.sysconf("SC_PAGESIZE") / 1e6 + sum(resident_megabytes(child) for child in children_of(process))


class End:
    """How a run ended: `code` of the process, negative for a signal, None if it has not begun, and what ended it from
    here, if anything did."""

    def __init__(self, code, cause):
        self.code, self.cause = code, cause

    def is_death(self):
        """By a signal, or with an error that is none of a mesh: 1 internal, 5 out of memory."""
        return self.cause is None and (self.code < 0 or self.code in (1, 5))

    def reason(self):
        if self.cause:
            return self.cause
        if self.code < 0:
            return f"its process ended by {signal.Signals(-self.code).name}"
        return f"its process ended with {self.code}"


class BatchProcess:
    """Runs commands one after the other. After stop() the one at work ends, and no other begins."""

    def __init__(self, megabytes, end_time, threads):
        self._megabytes, self._end_time = megabytes, end_time
        # Lavapipe would take all cores of a machine that other jobs share.
        self._environment = {"LP_NUM_THREADS": str(threads), **os.environ}
        self._process, self.stopped = None, False

    def stop(self):
        self.stopped = True

    def run(self, command, folder, names, log):
        """`names` are the lines of its standard input."""
        with open(log, "ab") as messages:
            if self.stopped:
                return End(None, "stopped")
            self._process = subprocess.Popen(command, cwd=folder, stdin=subprocess.PIPE, stdout=messages,
                                             stderr=messages, preexec_fn=end_with_parent,
                                             env=self._environment)
            try:
                self._process.stdin.write(names)
                self._process.stdin.close()
            except BrokenPipeError:
                pass
            return self._watch()

    def _watch(self):
        cause = None
        while self._process.poll() is None:
            if self.stopped or time.monotonic() > self._end_time:
                cause = "stopped" if self.stopped else "time"
                self._end()
            elif resident_megabytes(self._process.pid) > self._megabytes:
                cause = "memory"
                self._process.kill()
                self._process.wait()
            else:
                time.sleep(SECONDS_BETWEEN_LOOKS)
        return End(self._process.returncode, cause)

    def _end(self):
        """Ends as after Ctrl-C, so that a table has no cut line; by force if that takes long."""
        self._process.terminate()
        try:
            self._process.wait(SECONDS_TO_END)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
