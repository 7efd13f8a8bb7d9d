#!/usr/bin/env python3
"""Measures the time from a signal to the end of the program (docs/reliability.md): SIGTERM, spread evenly over a run.

  bench/signal_stops.py [--stops N] PROGRAM ARGUMENT ...

Prints one row of a table: seconds of an undisturbed run, number of stops, median and worst milliseconds from the signal to
the end of the process. It runs in a folder of its own and fails if a stopped run leaves a file or does not exit with 130.
"""
import os
import signal
import subprocess
import sys
import tempfile
import time


def run(command, folder, stop_after=None):
    """Returns the seconds from the signal to the end, or of the whole run, and the exit code."""
    begin = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
    if stop_after is not None:
        time.sleep(stop_after)
        begin = time.monotonic()
        process.send_signal(signal.SIGTERM)
    _, messages = process.communicate()
    return time.monotonic() - begin, process.returncode, messages.decode()


def main(arguments):
    count = 40
    if arguments[:1] == ["--stops"]:
        count = int(arguments[1])
        arguments = arguments[2:]
    if not arguments:
        sys.exit(__doc__)
    # The paths of meshes are relative to the folder of the caller.
    command = [os.path.abspath(a) if os.path.exists(a) else a for a in arguments]
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(2):  # the first run compiles kernels
            whole, code, messages = run(command, folder)
            if code != 0:
                sys.exit(f"{messages}exit code {code}")
    stops = []
    for i in range(count):
        with tempfile.TemporaryDirectory() as folder:
            # The handlers are installed some milliseconds after the start.
            seconds, code, messages = run(command, folder, 0.03 + (whole - 0.03) * i / count)
            if code == 0:
                continue  # the run had already finished
            if code != 130 or os.listdir(folder):
                sys.exit(f"{messages}exit code {code}, left {os.listdir(folder)}")
            stops.append(seconds)
    if not stops:
        sys.exit("every run had finished before its signal")
    stops.sort()
    name = " ".join(os.path.basename(a) for a in arguments[1:])
    print(f"| `{name}` | {whole:.1f} | {len(stops)} | {1e3 * stops[len(stops) // 2]:.0f} | {1e3 * stops[-1]:.0f} |")


main(sys.argv[1:])
