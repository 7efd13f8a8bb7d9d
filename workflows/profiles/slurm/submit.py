"""submit JOBSCRIPT: sbatch with the resources of the job; prints its number.

A job of this name, of this folder of results, that is in the queue already, submitted by a Snakemake that has ended since,
is taken over. MEDIAL_VK_SBATCH holds more options of sbatch, such as --account.
"""
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import time

SECONDS_WITHOUT_CONTROLLER = 600
WAITING = "PENDING,RUNNING,SUSPENDED,CONFIGURING,REQUEUED"


def properties_of(script):
    found = re.search(r"^# properties = (.*)$", pathlib.Path(script).read_text(), re.MULTILINE)
    return json.loads(found.group(1))


def name_of(job):
    """The same for the same results, whichever Snakemake submits the job."""
    outputs = [os.path.realpath(file) for file in job["output"]]
    chunk = job.get("wildcards", {}).get("chunk")
    return f"medial-vk-{job['rule']}{'-' + chunk if chunk else ''}-{hashlib.sha256(repr(outputs).encode()).hexdigest()[:12]}"


def patiently(command):
    """Its output; while the controller does not answer it is tried again."""
    end = time.monotonic() + SECONDS_WITHOUT_CONTROLLER
    while True:
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        if result.returncode == 0:
            return result.stdout.strip()
        is_away = re.search(r"[Uu]nable to contact|Socket timed out|Connection refused|[Tt]emporarily", result.stderr)
        if not is_away or time.monotonic() > end:
            sys.exit(f"{shlex.join(command)}: {result.stderr.strip()}")
        time.sleep(5)


def main():
    script = sys.argv[-1]
    job = properties_of(script)
    name, resources = name_of(job), job.get("resources", {})
    queued = patiently(["squeue", "--me", "--noheader", "--format=%i", f"--name={name}", f"--states={WAITING}"])
    if queued:
        print(queued.split()[0])
        return
    ends = pathlib.Path(".snakemake/slurm").absolute()
    ends.mkdir(parents=True, exist_ok=True)
    command = ["sbatch", "--parsable", "--requeue", f"--job-name={name}", "--ntasks=1",
               f"--cpus-per-task={job.get('threads', 1)}", f"--output={str(ends).replace('%', '%%')}/%x-%j.log",
               "--open-mode=append", "--export=ALL"]
    # In the environment, as --export ends a value at a comma.
    os.environ["MEDIAL_VK_ENDS"] = str(ends)
    for resource, option in (("mem_mb", "--mem={}M"), ("runtime", "--time={}"), ("partition", "--partition={}"),
                             ("gres", "--gres={}")):
        if resources.get(resource):
            command.append(option.format(resources[resource]))
    command += shlex.split(os.environ.get("MEDIAL_VK_SBATCH", ""))
    print(patiently([*command, script]).split(";")[0])


if __name__ == "__main__":
    main()
