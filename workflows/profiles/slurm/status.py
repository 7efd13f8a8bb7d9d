"""status JOB: prints running, success or failed.

One squeue a few seconds answers for all jobs. Of a job that Slurm has forgotten, the file that its script has written
(jobscript.sh) tells the end, else the accounts, if there are any. While the controller does not answer, jobs count as
running.
"""
import fcntl
import os
import pathlib
import subprocess
import sys
import time

SECONDS_OF_AN_ANSWER = 3
ENDED_WELL = {"COMPLETED"}
ENDED = {"BOOT_FAIL", "CANCELLED", "DEADLINE", "FAILED", "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "REVOKED",
         "SPECIAL_EXIT", "TIMEOUT"}
FOLDER = pathlib.Path(".snakemake/slurm")


def queue(at_once=False):
    """Lines "JOB|STATE|REASON" of all own jobs that Slurm remembers; None: the controller does not answer. Without
    `at_once` they may be those of some seconds ago."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    with open(FOLDER / "queue", "a+") as file:
        fcntl.lockf(file, fcntl.LOCK_EX)
        # The clock of another machine may have written a time to come.
        is_old = abs(time.time() - os.fstat(file.fileno()).st_mtime) > SECONDS_OF_AN_ANSWER
        if at_once or is_old or file.tell() == 0:
            answer = subprocess.run(["squeue", "--me", "--noheader", "--states=all", "--format=%i|%T|%r"],
                                    capture_output=True, text=True, check=False)
            if answer.returncode != 0:
                return None
            file.truncate(0)
            file.write(answer.stdout + ".\n")
            file.flush()
            os.utime(file.fileno())
        file.seek(0)
        return file.read().splitlines()


def state_in_queue(job, lines):
    for line in lines:
        number, _, rest = line.partition("|")
        if number == job:
            state, _, reason = rest.partition("|")
            # A node that fails at the start of a job leaves it on hold.
            if state == "PENDING" and "requeued held" in reason:
                subprocess.run(["scontrol", "release", job], check=False, stdout=sys.stderr)
            return state
    return None


def state_in_file(job):
    for seconds in (0, 1):
        time.sleep(seconds)
        os.listdir(FOLDER)  # a shared file system may remember that the file was not there
        try:
            code = (FOLDER / job).read_text().strip()
        except OSError:
            code = ""
        if code:
            return "COMPLETED" if code == "0" else "FAILED"
    return None


def state_in_accounts(job):
    answer = subprocess.run(["sacct", "-X", "--noheader", "--parsable2", "--format=State", "--jobs", job],
                            capture_output=True, text=True, check=False)
    return answer.stdout.split()[0].rstrip("+") if answer.returncode == 0 and answer.stdout.split() else None


def main():
    job = sys.argv[-1]
    state = None
    for at_once in (False, True):
        lines = queue(at_once) if state is None else []
        if lines is None:
            print("running")
            return
        state = state or state_in_queue(job, lines)
    # A job without any trace ended with its machine.
    state = state or state_in_file(job) or state_in_accounts(job) or "NODE_FAIL"
    print("success" if state in ENDED_WELL else "failed" if state in ENDED else "running")


if __name__ == "__main__":
    main()
