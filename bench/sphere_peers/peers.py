"""Other methods that put balls in the place of a solid, beside medial-vk's: runs of both, their measures, and the table.

Seconds are those of the whole program. That of medial-vk also proves and measures its balls; the others only fit.
"""

import json
import os
import subprocess
import time

from whole_runs import measure

OWN = {"medial-vk inside": "inside", "medial-vk cover": "cover", "medial-vk balanced": "balanced"}
PEERS = ("set-cover", "set-cover-fitted", "k-means-inside", "voxel-inside", "k-means-cover", "voxel-cover",
         "gradient-published", "gradient-tuned")
PROGRAM = "bench_sphere_peers"


def order(names):
    """Rows of a table: those that stay inside, covers, and those on both sides, each after medial-vk's."""
    inside = ("set-cover", "set-cover-fitted", "k-means-inside", "voxel-inside")
    cover = ("k-means-cover", "voxel-cover")
    both = ("gradient-published", "gradient-tuned")
    groups = zip(OWN, (inside, cover, both))
    return [name for own, group in groups for name in (own, *(peer for peer in group if peer in names))]


def timed(command, errors, output, limit):
    """The facts of a run, with `failed` if it fails, and its standard output."""
    facts = {"load_before": os.getloadavg()[0]}
    start = time.perf_counter()
    with open(errors, "w", encoding="utf-8") as stream, open(output, "w", encoding="utf-8") as out:
        process = subprocess.Popen(list(map(str, command)), stdout=out, stderr=stream)
        try:
            usage = measure.wait(process, limit)
        except measure.RunFailed as error:
            return facts | {"failed": str(error)}, ""
    facts |= {"wall": time.perf_counter() - start, "cpu": usage.ru_utime + usage.ru_stime}
    if process.returncode != 0:
        return facts | {"failed": errors.read_text(encoding="utf-8").strip() or f"exit code {process.returncode}"}, ""
    return facts, output.read_text(encoding="utf-8")


def run(programs, folder, mesh, name, count, arguments):
    """One fit and its measures. A fit that is not what it is by construction has failed."""
    balls, errors, output = folder / "peer.csv", folder / "peer_errors.txt", folder / "peer_output.txt"
    row = {"mesh": mesh.stem, "method": name, "wanted": count}
    if name in OWN:
        promise = OWN[name] if OWN[name] != "balanced" else None
        command = [programs / "medial-vk", "spheres", mesh, "--count", count, "--contract", OWN[name], "-q", "-o", balls,
                   *arguments.option]
        facts, _ = timed(command, errors, output, arguments.limit)
    else:
        command = [programs / PROGRAM, "fit", name, mesh, "--count", count, "-o", balls]
        facts, said = timed(command, errors, output, arguments.limit)
        promise = None if "failed" in facts else json.loads(said)["promise"]
    if "failed" in facts:
        return row | facts
    measuring, said = timed([programs / PROGRAM, "measure", mesh, balls], errors, output, arguments.limit)
    if "failed" in measuring:
        return row | {"failed": measuring["failed"]}
    row |= facts | json.loads(said)
    row["error_percent"] = row["uncovered_percent"] + row["added_percent"]
    if promise and not row[promise]:
        row["failed"] = f"not {promise}"
    return row


def cells(row):
    proved = "inside" if row["inside"] else "cover" if row["cover"] else ""
    deviation = row["error_standard_error_percent"]
    error = f"{row['error_percent']:.3g}" + (f" ± {deviation:.2g}" if deviation > 0 else "")
    return [str(row["spheres"]), proved, f"{row['uncovered_percent']:.3g}", f"{row['added_percent']:.3g}", error,
            f"{row['protrusion_percent']:.3g}", f"{row['hausdorff_percent']:.3g}", f"{row['wall']:.2f}",
            f"{row['cpu']:.2f}"]


def table(rows):
    """Lines of Markdown; none without rows."""
    if not rows:
        return []
    names = ["mesh", "N", "method", "spheres", "proved", "uncovered %", "added %", "both %", "protrusion %",
             "Hausdorff %", "wall s", "CPU s"]
    out = ["| " + " | ".join(names) + " |", "|---" * len(names) + "|"]
    last = None
    for row in rows:
        key = [row["mesh"], str(row["wanted"])]
        words = [*(key if key != last else ["", ""]), row["method"]]
        last = key
        words += [row["failed"], *[""] * 8] if "failed" in row else cells(row)
        out.append("| " + " | ".join(words) + " |")
    return out
