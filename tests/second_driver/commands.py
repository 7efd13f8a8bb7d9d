#!/usr/bin/env python3
"""Runs every command of medial-vk from end to end on the only driver that the environment names.

    commands.py MEDIAL_VK MAKE_MODEL MAKE_ARM DEVICE

DEVICE is part of the name of its device. Every command must end with 0, with --check where there is one, and write its
files. The commands marked TWICE must write the same bytes when they are run again (the report, with its times, is not
compared). SIGTERM must end a run within a second of the processor while the driver compiles.
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

ONCE, TWICE = 1, 2
# The arguments of medial-vk, the files that it writes, and how often it runs.
COMMANDS = [
    ("model.obj --resolution 60 --check -o a.ply --picture a.png --medial-mesh a.medial-mesh.ply "
     "--sheet-curve a.csv --ball-volumes volumes.csv --report a.json",
     ["a.ply", "a.png", "a.medial-mesh.ply", "a.csv", "volumes.csv"], TWICE),
    ("model.obj --resolution 40 --radius 0.1 --simplify --check -o b.npz", ["b.npz"], ONCE),
    ("model.obj --resolution 24 --mode thesis --check -o c.json", ["c.json"], ONCE),
    ("open.obj --resolution 30 --check -o d.ply", ["d.ply"], ONCE),
    ("spheres model.obj --count 24 --check -o e.csv", ["e.csv"], TWICE),
    ("spheres model.obj --count 24 --contract cover --check -o f.csv", ["f.csv"], ONCE),
    ("spheres model.obj --count 24 --contract balanced -o g.csv", ["g.csv"], ONCE),
    ("spheres model.obj --count 16 --method source --check -o h.csv", ["h.csv"], ONCE),
    ("spheres arm/robot_arm/arm.urdf --count-per-link 6 --check -o i.yaml", ["i.yaml"], ONCE),
]


def run(folder, program, arguments):
    result = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, timeout=600)
    if result.returncode != 0:
        sys.exit(f"{program} {' '.join(arguments)}: exit code {result.returncode}\n{result.stdout}{result.stderr}")
    return result.stdout


def make_inputs(folder, make_model, make_arm):
    run(folder, make_model, ["model.obj"])
    lines = (folder / "model.obj").read_text().splitlines()
    faces = [line for line in lines if line.startswith("f ")]
    kept = [line for line in lines if not line.startswith("f ")] + faces[40:]
    (folder / "open.obj").write_text("\n".join(kept) + "\n")
    run(folder, sys.executable, [make_arm, "arm"])


def processor_seconds(process):
    """Of a running process, which the load of the machine does not change as it does the clock."""
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def end_while_compiling(folder, medial_vk):
    """The driver compiles for seconds; SIGTERM ends the program meanwhile."""
    arguments = ["model.obj", "--threads", "1", "-o", "never.ply"]
    run = subprocess.Popen([medial_vk, *arguments], cwd=folder, stderr=subprocess.DEVNULL)
    time.sleep(1)
    if run.poll() is not None:
        sys.exit("the driver compiled all programs, and the run ended, within a second")
    run.send_signal(signal.SIGTERM)
    before = processor_seconds(run.pid)
    _, status, usage = os.wait4(run.pid, 0)
    run.returncode = os.waitstatus_to_exitcode(status)
    seconds = usage.ru_utime + usage.ru_stime - before
    if run.returncode != 130 or seconds > 1 or (folder / "never.ply").exists():
        sys.exit(f"SIGTERM while programs are compiled: exit code {run.returncode} after {seconds:.2f} s of the processor")


def main():
    medial_vk, make_model, make_arm, device = sys.argv[1:]
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        make_inputs(folder, make_model, make_arm)
        devices = run(folder, medial_vk, ["--list-devices"])
        if device not in devices:
            sys.exit(f"no device {device} in\n{devices}")
        end_while_compiling(folder, medial_vk)
        for command, files, runs in COMMANDS:
            written = []
            for _ in range(runs):
                run(folder, medial_vk, command.split())
                written.append([(folder / file).read_bytes() for file in files])
            for file, first, last in zip(files, written[0], written[-1]):
                if first != last:
                    sys.exit(f"medial-vk {command}: two runs write different bytes of {file}")
            print(f"medial-vk {command}: ok", flush=True)


if __name__ == "__main__":
    main()
