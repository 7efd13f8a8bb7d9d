"""apt_mirrors.py SOURCE_DIR: what scripts/list-mirrors says where apt knows other things than a mirror of Debian 12."""
import os
import pathlib
import subprocess
import sys
import tempfile

CASES = {  # what apt-get indextargets prints, and what of it is said; None: it is a mirror
    "": "apt has no mirror of Debian 12",
    "deb http://mirror/debian trixie main|Debian": "apt has no mirror of Debian 12",
    "deb http://mirror/debian bookworm main|": "apt has no lists of packages: run apt-get update",
    "deb http://mirror/debian bookworm main|Debian": None,
}


def outcome(script, lines):
    with tempfile.TemporaryDirectory() as folder:
        apt = pathlib.Path(folder, "apt-get")
        apt.write_text(f"#!/bin/sh\necho '{lines}'\n")
        apt.chmod(0o755)
        result = subprocess.run([script, folder], env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"},
                                capture_output=True, text=True, check=False)
        return result, pathlib.Path(folder, "mirrors").read_text()


failures = 0
for lines, said in CASES.items():
    result, mirrors = outcome(f"{sys.argv[1]}/scripts/list-mirrors", lines)
    if said is None:  # a user who is not root may lack what makes a root
        is_right = mirrors == "deb http://mirror/debian bookworm main\n" and "apt has" not in result.stderr
    else:
        is_right = result.returncode == 1 and f"scripts/list-mirrors: {said}" in result.stderr and not mirrors
    if not is_right:
        print(f"FAILED: {lines!r}: {result.returncode}, {result.stderr!r}, {mirrors!r}")
        failures += 1
sys.exit(failures)
