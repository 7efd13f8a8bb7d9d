#!/usr/bin/env python3
"""local_test.py MEDIAL_VK: the workflow on this machine: restarts, meshes that change, come and go.

Exit code 77: Snakemake is missing.
"""
import os
import pathlib
import shutil
import sys
import tempfile

from meshes import torus, write_meshes
from workflow_runs import TABLE, WorkflowFolder, check


def main():
    if shutil.which("snakemake") is None:
        print("SKIPPED: no snakemake")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as temporary:
        # A blank in the path of the results is nothing special.
        folder = pathlib.Path(temporary) / "a folder"
        folder.mkdir()
        work = WorkflowFolder(folder, sys.argv[1], "--resolution 12 --backend cpu --html")
        failures = write_meshes(work.meshes, 12, seed=1)
        code, text = work.run(chunk=4, threads=1)
        check(code == 0, text)
        work.check_results(failures)
        before = work.keys()
        check(len(before) == 3, f"{len(before)} chunks of 12 meshes by 4")

        # One mesh changes, one is written again with the same bytes, one goes, two come. Chunks of others stay.
        names = sorted(str(path.relative_to(work.meshes)) for path in work.meshes.rglob("*.obj")
                       if path.stat().st_size > 200)
        (work.meshes / names[0]).write_text(torus(77))
        (work.meshes / names[-1]).unlink()
        (work.meshes / "new.obj").write_text(torus(78))
        (work.meshes / "newer.obj").write_text(torus(79))
        kept = {name: os.stat(work.results / f"{name}.medial.ply").st_ino for name in names[1:-1]}
        code, text = work.run(chunk=4, threads=1, strict=True)
        check(code == 1 and "meshes failed" in text, "with strict, failures of meshes are a failure of the workflow")
        work.check_results(failures)
        after = work.keys()
        changed = {number for number in after if before.get(number) != after[number]}
        check(len(after) == 4 and len(changed) <= 3, f"chunks that ran: {sorted(changed)}")
        for name, number in kept.items():
            check(os.stat(work.results / f"{name}.medial.ply").st_ino == number, f"{name} was done again")

        # Files are lost: in the folder of a chunk, while another mesh comes, and among the results, with their table.
        lost = f"{names[1]}.medial.ply"
        for path in (work.state / "chunks").rglob(lost):
            path.unlink()
        (work.meshes / "newest.obj").write_text(torus(80))
        code, text = work.run(chunk=4, threads=1)
        check(code == 0, text)
        work.check_results(failures)
        (work.results / lost).unlink()
        (work.results / TABLE).unlink()
        code, text = work.run(chunk=4, threads=1)
        check(code == 0, text)
        work.check_results(failures)


main()
