"""merge.py OUTPUT KEY: one table, one page and one tree of files of all chunks of the plan KEY.

Every planned mesh must be in the table once. Runs of chunks that no result comes from are removed.
"""
import collections
import csv
import io
import pathlib
import shutil
import subprocess
import sys

from files import bytes_of, read_json, write_json, write_whole
from plan import lost_result
from table import TABLE, Table, name_of_line


def runs_of(state, chunks):
    """The folder with the results of each chunk, and its meshes. A chunk that lacks a file is done again by the next run;
    until then the results that an earlier merge has made stay."""
    runs, meshes, lost = [], [], []
    for number, key in chunks.items():
        folder = state / "chunks" / number
        record, requested = read_json(folder / f"done-{key}.json"), read_json(folder / f"plan-{key}.json")
        if record is None or requested is None:
            sys.exit(f"chunk {number} has no record of its end")
        runs.append(folder / "runs" / record["run"])
        names = [name_of_line(line) for line in requested["meshes"]]
        meshes += names
        missing = lost_result(runs[-1], names)
        if missing is not None:
            lost.append(f"chunk {number} has lost {missing}")
            (folder / f"done-{key}.json").unlink(missing_ok=True)
    if lost:
        sys.exit(f"{lost[0]}; chunks that the next run of Snakemake does again: {len(lost)}")
    return runs, meshes


def merge(program, runs, state, output, page):
    """The folders of runs are named from the folder that they lie in, so that no name has a line end."""
    folders = b"".join(bytes_of(run.relative_to(state)) + b"\n" for run in runs)
    command = [program, "batch", "--merge", "-", "-o", output.absolute(), *(["--html"] if page else [])]
    code = subprocess.run(command, input=folders, cwd=state, check=False).returncode
    if code not in (0, 9):
        sys.exit(f"medial-vk batch --merge ended with {code}")


def check_count(meshes, rows):
    missing = sorted(set(meshes) - set(rows))
    others = sorted(set(rows) - set(meshes))
    twice = [name for name, count in collections.Counter(meshes).items() if count > 1]
    if missing or others or twice:
        sys.exit(f"the table does not have every mesh once: {len(missing)} missing, such as {missing[:1]}, "
                 f"{len(others)} more, such as {others[:1]}, {len(twice)} planned twice")


def remove_parts(folder):
    """Files of processes that were killed before they renamed them."""
    for file in folder.glob(".*.part"):
        file.unlink(missing_ok=True)


def remove_others(state, chunks, runs, key):
    """What no result of this plan comes from. A job that should have ended may still write there, and fails."""
    kept = {run.name for run in runs}
    for folder in (state.parent, state):
        remove_parts(folder)
    for folder in (state / "chunks").iterdir():
        of_chunk = chunks.get(folder.name)
        if of_chunk is None:
            shutil.rmtree(folder, ignore_errors=True)
            continue
        remove_parts(folder)
        for file in folder.glob("*.json"):
            if file.name not in (f"plan-{of_chunk}.json", f"done-{of_chunk}.json"):
                file.unlink(missing_ok=True)
        record = read_json(folder / f"done-{of_chunk}.json") or {}  # a second copy of its job may have ended meanwhile
        for run in (folder / "runs").iterdir():
            if run.name not in kept and run.name != record.get("run"):
                shutil.rmtree(run, ignore_errors=True)
    for pattern in ("plan-*.json", "merged-*.json", "all-done-*"):
        for file in state.glob(pattern):
            if key not in file.name:
                file.unlink(missing_ok=True)


def main():
    output, key = pathlib.Path(sys.argv[1]), sys.argv[2]
    state = output / ".workflow"
    plan = read_json(state / f"plan-{key}.json")
    if plan is None:
        sys.exit(f"there is no plan {state}/plan-{key}.json")
    runs, meshes = runs_of(state, plan["chunks"])
    for record in state.glob("merged-*.json"):  # of other plans: the results are theirs no longer
        record.unlink(missing_ok=True)
    page = "--html" in plan["options"]
    merge(plan["program"], runs, state, output, page)
    rows = Table(output).rows
    check_count(meshes, rows)
    failed = [row for row in rows.values() if row.state != "done"]
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([("name", "error"), *((row.name, row.error) for row in failed)])
    write_whole(output / "failures.csv", text.getvalue().encode(errors="surrogateescape"))
    write_json(state / f"merged-{key}.json",
               {"meshes": len(rows), "done": len(rows) - len(failed), "failed": len(failed),
                "chunks": len(runs), "table": str(output / TABLE), "failures": str(output / "failures.csv"),
                "beside": ["failures.csv", *(["batch.html"] if page else [])]})
    remove_others(state, plan["chunks"], runs, key)


if __name__ == "__main__":
    main()
