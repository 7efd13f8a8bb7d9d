"""Timed runs of the command line, and the fits through them."""

import json
import math
import os
import platform
import subprocess
import time
from pathlib import Path


class RunFailed(Exception):
    """A run that ended with an error or took longer than its limit."""


def wait(process, limit):
    """Waits for the process and returns its resource usage; raises RunFailed after `limit` seconds."""
    end = time.monotonic() + limit
    pause = 0.0005  # seconds; the interval of polling adds a little to the measured time
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid != 0:
            process.returncode = os.waitstatus_to_exitcode(status)
            return usage
        if time.monotonic() > end:
            process.kill()
            process.wait()
            raise RunFailed(f"more than {limit:.0f} s")
        time.sleep(pause)


def run_once(binary, mesh, folder, options=(), limit=600):
    """One whole run that writes only its points: wall and CPU seconds, and the peak memory in MiB."""
    command = [str(binary), str(mesh), "-q", "-o", str(Path(folder) / "points.ply"), *options]
    start = time.perf_counter()
    with open(Path(folder) / "errors.txt", "w+", encoding="utf-8") as errors:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors)
        usage = wait(process, limit)
        wall = time.perf_counter() - start
        errors.seek(0)
        if process.returncode != 0:
            raise RunFailed(errors.read().strip() or f"exit code {process.returncode}")
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "peak_mib": usage.ru_maxrss / 1024}


def reported_run(binary, mesh, folder, options=(), limit=600):
    """The same, with the values of its report. A run with a report takes longer, as it also measures volumes of unions."""
    report = Path(folder) / "report.json"
    run = run_once(binary, mesh, folder, [*options, "--report", str(report)], limit)
    facts = json.loads(report.read_text(encoding="utf-8"))
    return {
        **run,
        "device": sum(stage["seconds"] for stage in facts["seconds"]["device"]),
        "triangles": facts["mesh"]["triangles"],
        "points": facts["points"]["written"],
        "undecided": facts["voxels"]["undecided"],
        "host_stages": {stage["stage"]: stage["seconds"] for stage in facts["seconds"]["host"]},
        "device_stages": {stage["stage"]: stage["seconds"] for stage in facts["seconds"]["device"]},
        "device_name": facts["device"]["name"] if facts["device"] else None,
        "driver": facts["device"]["driver"] if facts["device"] else None,
    }


def median_run(binary, mesh, folder, options=(), repeats=3, limit=600):
    """The median and the least wall time of `repeats` runs, after one to warm up and one for the report."""
    run_once(binary, mesh, folder, options, limit)
    facts = reported_run(binary, mesh, folder, options, limit)
    runs = sorted((run_once(binary, mesh, folder, options, limit) for _ in range(repeats)), key=lambda r: r["wall"])
    return {**facts, **runs[(len(runs) - 1) // 2], "least_wall": runs[0]["wall"], "repeats": repeats}


def exponent(xs, ys):
    """The slope of the least-squares line through log y against log x; None for fewer than two values of x."""
    if len(set(xs)) < 2:
        return None
    u, v = [math.log(x) for x in xs], [math.log(y) for y in ys]
    mean_u, mean_v = sum(u) / len(u), sum(v) / len(v)
    return sum((a - mean_u) * (b - mean_v) for a, b in zip(u, v)) / sum((a - mean_u) ** 2 for a in u)


def processor():
    """The name of the processor, from the operating system."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def build_of(binary, root):
    """Version, revision, compiler and kind of the build that `binary` lies in."""
    version = subprocess.run([binary, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    revision = subprocess.run(["git", "-C", root, "describe", "--always", "--dirty"], capture_output=True, text=True,
                              check=False).stdout.strip()
    cache = Path(binary).parent.parent / "CMakeCache.txt"
    known = {}
    if cache.exists():
        for line in cache.read_text(encoding="utf-8", errors="replace").splitlines():
            name, _, value = line.partition("=")
            known[name.partition(":")[0]] = value
    return {"version": version, "revision": revision, "compiler": Path(known.get("CMAKE_CXX_COMPILER", "?")).name,
            "type": known.get("CMAKE_BUILD_TYPE", "?")}
