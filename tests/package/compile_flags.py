#!/usr/bin/env python3
"""Every source of the project is compiled for IEEE arithmetic as it is written: without fused operations where the source has
none, and without options that permit a compiler to change sums and products.

    compile_flags.py COMPILE_COMMANDS      the file that CMake writes for the build

A processor without fused operations hides a missing option from every test of results.
"""
import json
import pathlib
import shlex
import sys

CHANGES_ARITHMETIC = ("-ffast-math", "-Ofast", "-funsafe-math-optimizations", "-fassociative-math", "-freciprocal-math",
                      "-ffinite-math-only", "-fno-signed-zeros", "-fsingle-precision-constant")


def fault(arguments):
    contraction = [a.partition("=")[2] for a in arguments if a.startswith("-ffp-contract=")]
    if contraction[-1:] != ["off"]:
        return "fused operations are permitted: -ffp-contract=off is missing"
    wrong = [a for a in arguments if a in CHANGES_ARITHMETIC]
    return f"{wrong[0]} changes arithmetic" if wrong else None


def main():
    commands = json.loads(pathlib.Path(sys.argv[1]).read_text())
    faults = {(entry["file"], reason) for entry in commands if (reason := fault(shlex.split(entry["command"])))}
    for file, reason in sorted(faults):
        print(f"{file}: {reason}")
    print(f"{len(commands)} compilations, {len(faults)} faults")
    sys.exit(1 if faults or len(commands) < 100 else 0)


if __name__ == "__main__":
    main()
