"""Runs commands of medial-vk for Windows under Wine, and the same ones of this system's build, and compares what they write.

    compare_commands.py NATIVE MEDIAL_VK.exe INTERRUPT.exe MAKE_MODEL WORK [STEP ...]

Files and standard output have the same bytes, but for the files in LAST_DIGITS, which same_results.py compares, and exit codes
are equal. Left out of the comparison are times: the key `seconds` of JSON, the columns `seconds...` of the table of a batch, and
standard error, whose summary has them; of an error its message is compared. The column `file` of that table has the whole path,
which differs. Called by scripts/test-windows. A STEP is a name in STEPS.
"""
import csv
import io
import json
import pathlib
import shutil
import subprocess
import sys

import same_results
from inputs import make_inputs
from same_results import same_but_for_choices, same_but_for_roundings, same_surface, without_times

NATIVE, WINDOWS, INTERRUPT, MAKE_MODEL, WORK = (pathlib.Path(word).resolve() for word in sys.argv[1:6])
failures = []
compared = 0
declared, alike = [], []  # of the files that may differ, as LAST_DIGITS says: those that do, and those that do not


def note(ok, what):
    print(("ok    " if ok else "FAILS ") + what, flush=True)
    if not ok:
        failures.append(what)


def run(program, words, folder, **options):
    command = ([] if program == NATIVE else ["wine"]) + [str(program), *words]
    return subprocess.run(command, cwd=folder, capture_output=True, timeout=900, **options)


# ---- Comparison.
def same_table(a, b):
    tables = [list(csv.DictReader(io.StringIO(text.decode()))) for text in (a, b)]
    for row in (row for table in tables for row in table):
        for name in [name for name in row if name.startswith("seconds") or name == "file"]:
            del row[name]
    return tables[0] == tables[1]


def messages(outcome):
    return [line for line in outcome.stderr.decode().splitlines() if line.startswith("medial-vk: ")]


def same_json(a, b):
    return without_times(json.loads(a)) == without_times(json.loads(b))


def files_of(folder, inputs):
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*")
            if p.is_file() and p.relative_to(folder).as_posix() not in inputs}


def difference(a, b):
    return f"{len(a)} and {len(b)} bytes, {same_results.apart(a, b)}"


def difference_in_digits(may_differ, file, a, b):
    """None if two files differ as LAST_DIGITS allows."""
    try:
        return may_differ[file](file, a, b) if file in may_differ else difference(a, b)
    except Exception as error:  # a file that is none of its kind
        return f"cannot be compared: {error!r}; {difference(a, b)}"


def compare(name, words, stdin=None):
    """Runs a command in two copies of the inputs, and compares all that it writes."""
    global compared
    outcomes, contents = [], []
    for program in (NATIVE, WINDOWS):
        folder = WORK / ("native" if program == NATIVE else "windows") / name
        shutil.copytree(WORK / "inputs", folder)
        outcomes.append(run(program, words, folder, input=stdin))
        contents.append(files_of(folder, INPUTS))
    native, windows = outcomes
    wrong = []
    if native.returncode != windows.returncode:
        wrong.append(f"exit codes {native.returncode} and {windows.returncode}: {windows.stderr.decode()[-300:]}")
    # Reports of --check hold worst cases, so they follow the numbers.
    may_differ = LAST_DIGITS.get(name, {})
    texts = (native.stdout, windows.stdout)
    if texts[0] != texts[1] and not (texts[0][:1] == b"{" and same_json(*texts)):
        problem = same_results.same_form(*texts) if may_differ else difference(*texts)
        if problem:
            wrong.append(f"standard output: {problem}")
    if messages(native) != messages(windows):
        wrong.append(f"messages {messages(native)} and {messages(windows)}")
    if set(contents[0]) != set(contents[1]):
        wrong.append(f"files {sorted(contents[0])} and {sorted(contents[1])}")
    for file in sorted(set(contents[0]) & set(contents[1])):
        a, b = contents[0][file], contents[1][file]
        compared += 1
        if a == b and file in may_differ:
            alike.append(f"{name}/{file}")
        if a == b or file.endswith(".json") and same_json(a, b):
            continue
        if file.endswith("batch.csv") and same_table(a, b):
            continue
        problem = difference_in_digits(may_differ, file, a, b)
        if problem:
            wrong.append(f"{file}: {problem}")
        else:
            declared.append(f"{name}/{file}")
    note(not wrong, f"{name}: medial-vk {' '.join(words)}" + "".join("\n        " + w for w in wrong))
    return native, windows


COMMANDS = {
    "help": ["--help"],
    "devices": ["--list-devices"],
    "analysis": ["egg.obj", "--resolution", "32", "--check", "--report", "egg.json", "--html", "egg.html", "--medial-mesh",
                 "egg.ply", "--ball-volumes", "egg.csv", "--sheet-curve", "curve.svg", "--picture", "egg.png"],
    "analysis_balls": ["egg.obj", "--resolution", "16", "--mesh-spheres"],
    "analysis_json": ["box.stl", "--resolution", "30", "-o", "box.json", "--sheet-curve", "curve.csv"],
    "analysis_csv": ["box.off", "--resolution", "30", "-o", "box.csv", "--medial-mesh", "box.ma"],
    "analysis_glb": ["box.ply", "--resolution", "20", "-o", "box.glb"],
    "analysis_ascii": ["egg.obj", "--resolution", "20", "--ascii", "-o", "-"],
    "analysis_outside": ["box.obj", "--resolution", "24", "--side", "outside"],
    "analysis_thesis": ["egg.obj", "--resolution", "20", "--mode", "thesis"],
    "analysis_reference": ["egg.obj", "--resolution", "12", "--backend", "cpu"],
    "analysis_perturbed": ["box.obj", "--resolution", "20", "--perturb", "0.001", "--seed", "7"],
    "analysis_pruned": ["turtle.obj", "--resolution", "30", "--keep-volume", "0.9", "--simplify"],
    "thickness": ["egg.obj", "--resolution", "24", "--thickness", "--curvature", "--boundary", "egg.vtp", "--thickness-histogram",
                  "egg.svg", "--thickness-points", "points.csv", "--least-wall", "--report", "report.json"],
    "boundary": ["box.obj", "--resolution", "16", "--boundary", "b.glb", "--boundary-edge", "0.2", "--thickness-histogram", "h.csv",
                 "--picture", "b.png", "--show", "boundary"],
    "wall": ["box.obj", "--resolution", "16", "--min-wall", "0.6"],
    "spheres": ["spheres", "egg.obj", "--count", "8", "--check", "--report", "r.json", "--picture", "s.png", "--histogram", "s.svg"],
    "spheres_cover": ["spheres", "egg.obj", "--count", "12", "--contract", "cover", "-o", "s.json", "--check"],
    "spheres_balanced": ["spheres", "box.obj", "--count", "6", "--contract", "balanced", "-o", "s.yml", "--format", "curobo"],
    "fit": ["fit", "egg.obj", "--count", "4", "--check", "--report", "r.json", "--picture", "f.png"],
    "fit_usd": ["fit", "box.obj", "--primitives", "capsules", "--count", "4", "-o", "f.usda"],
    "fit_glb": ["spheres", "box.obj", "--primitives", "cones", "--count", "4", "-o", "f.glb"],
    "distance": ["distance", "egg.obj", "far.obj", "--check", "--picture", "d.png", "--html", "d.html"],
    "collisions": ["distance", "egg.obj", "box.obj", "--poses", "poses.csv", "-o", "d.csv"],
    "follow": ["follow", "egg.obj", "egg_bent.obj", "egg_more.obj", "--count", "16", "-o", "f.csv", "-o", "f.glb", "--html", "f.html",
               "--picture", "f.png", "--check"],
    "follow_pattern": ["follow", "egg*.obj", "--count", "8", "--contract", "cover", "-o", "f.csv", "--check"],
    "plane": ["plane", "shape.wkt", "-o", "a.json", "--picture", "a.png", "--html", "a.html", "--check"],
    "plane_pruned": ["plane", "ring.csv", "--prune-significance", "5%", "-o", "a.geojson"],
    "plane_svg": ["plane", "shape.geojson", "-o", "a.svg"],
    "plane_slice": ["plane", "egg.obj", "--slice", "z=50%", "-o", "a.csv"],
    "voronoi": ["voronoi", "egg.obj", "far.obj", "--resolution", "20", "--picture", "v.png", "--roadmap", "v.json", "--html", "v.html",
                "--check"],
    "voronoi_plane": ["voronoi", "shape.wkt", "apart.wkt", "-o", "v.svg"],
    "batch": ["batch", "list.txt", "-o", "out", "--resolution", "20", "--report", ".json", "--picture", ".png"],
    "list": ["batch", "parts", "-o", "out", "--list"],
    "list_of_list": ["batch", "list_crlf.txt", "parts/deep/box.obj", "-o", "out", "--list"],
    "missing_file": ["nowhere.obj"],
    "broken_file": ["broken.obj"],
    "wrong_option": ["egg.obj", "--resolution", "none"],
    "missing_folder": ["egg.obj", "--resolution", "10", "-o", "no/such/folder/egg.ply"],
    "folder_as_file": ["egg.obj", "--resolution", "10", "-o", "."],
}
# Files in which hypot(), atan2() and other functions of the C runtime, whose last digits differ (docs/windows.md), reach the
# numbers, or decide between choices that are equally good. Both results pass --check, or their proofs.
LAST_DIGITS = {
    "analysis": {"egg.csv": same_but_for_roundings, "egg.ply": same_surface},
    "thickness": dict.fromkeys(("egg.vtp", "points.csv"), same_but_for_roundings),
    "spheres": dict.fromkeys(("egg.spheres.csv", "r.json", "s.png", "s.svg"), same_but_for_choices),
    "spheres_cover": {"s.json": same_but_for_choices}, "spheres_balanced": {"s.yml": same_but_for_choices},
    "follow": dict.fromkeys(("f.csv", "f.glb", "f.html", "f.png"), same_but_for_choices),
    "follow_pattern": {"f.csv": same_but_for_choices},
}
# Parts that the build for Windows has not: what it says.
ABSENT = {
    "npz": (["egg.obj", "--resolution", "10", "-o", "egg.npz"], 2, "this build writes no .npz files, for which it needs libzip"),
    "urdf": (["spheres", "robot.urdf", "--count-per-link", "4", "-o", "s.csv"], 3, "this build reads no URDF files"),
    "svg": (["plane", "letter.svg"], 3, "this build reads no SVG files"),
    "gltf": (["scene.gltf"], 3, "this build reads no .gltf files"),
}


def compare_all():
    for name, words in COMMANDS.items():
        compare(name, words)
    # The balls of one command are the input of the next one.
    for program, folder in ((NATIVE, "native"), (WINDOWS, "windows")):
        shutil.copy(WORK / folder / "analysis" / "egg.medial.ply", WORK / "inputs" / f"{folder}.medial.ply")
    INPUTS.update({"native.medial.ply", "windows.medial.ply"})
    compare("curvature", ["curvature", "windows.medial.ply", "-o", "c.csv", "--report", "c.json"])
    compare("curvature_source", ["curvature", "native.medial.ply", "-o", "c.ply", "--method", "source"])
    compare("standard_input", ["-", "--resolution", "16", "-o", "-"], stdin=(WORK / "inputs" / "egg.obj").read_bytes())


def compare_line_ends():
    """Files with CRLF give what the same files with LF give."""
    for name, words in {
        "obj": ["FILE.obj", "--resolution", "16", "-o", "out.ply"], "stl": ["FILE.stl", "--resolution", "16", "-o", "out.ply"],
        "off": ["FILE.off", "--resolution", "16", "-o", "out.ply"], "ply": ["FILE.ply", "--resolution", "16", "-o", "out.ply"],
        "wkt": ["plane", "FILE.wkt", "-o", "out.csv"], "geojson": ["plane", "FILE.geojson", "-o", "out.csv"],
        "ring": ["plane", "FILE.csv", "-o", "out.csv"], "poses": ["distance", "egg.obj", "far.obj", "--poses", "FILE.csv", "-o", "out.csv"],
        "list": ["batch", "FILE.txt", "-o", "out", "--resolution", "12", "-q"],
    }.items():
        stems = {"obj": ("egg", "crlf"), "wkt": ("shape", "shape_crlf"), "geojson": ("shape", "shape_crlf"),
                 "ring": ("ring", "ring_crlf"), "poses": ("poses", "poses_crlf"), "list": ("list", "list_crlf")}.get(
                     name, ("box", "crlf"))
        found = []
        for stem in stems:
            folder = WORK / "ends" / name / stem
            shutil.copytree(WORK / "inputs", folder)
            outcome = run(WINDOWS, [word.replace("FILE", stem) for word in words], folder)
            files = {path: data for path, data in files_of(folder, INPUTS).items() if not path.endswith(("batch.csv", ".lock"))}
            found.append((outcome.returncode, outcome.stdout, files))
        # Comments in a PLY name no input; JSON would.
        note(found[0] == found[1] and found[0][0] == 0 and found[0][2] != {}, f"CRLF: {name}")


def check_absent():
    folder = WORK / "absent"
    shutil.copytree(WORK / "inputs", folder)
    (folder / "robot.urdf").write_text('<robot name="r"><link name="a"/></robot>')
    (folder / "letter.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h4v1z"/></svg>')
    (folder / "scene.gltf").write_text('{"asset": {"version": "2.0"}}')
    for name, (words, code, text) in ABSENT.items():
        outcome = run(WINDOWS, words, folder)
        said = outcome.stderr.decode()
        note(outcome.returncode == code and text in said, f"absent: {name}: {outcome.returncode}, {said.strip()}")
    said = run(WINDOWS, ["--version"], folder).stdout.decode()
    note(all(f"without {part}: " in said for part in ("assimp", "libzip", "tinyxml2")), "absent: --version")


def check_paths():
    """Names beyond ASCII, and paths of more than 260 characters, absolute and relative."""
    folder = WORK / "paths" / "Lösung – 物体 🐢"
    folder.mkdir(parents=True)
    source = (WORK / "inputs" / "egg.obj").read_bytes()
    expected = WORK / "paths" / "expected.ply"
    run(NATIVE, [str(WORK / "inputs" / "egg.obj"), "--resolution", "16", "-q", "-o", str(expected)], WORK)
    for name, at in {"beyond ASCII": folder / "Körper 体.obj",
                     "long": folder.joinpath(*["a folder with a long name " + str(i) * 20 for i in range(7)], "egg.obj")}.items():
        at.parent.mkdir(parents=True, exist_ok=True)
        at.write_bytes(source)
        for kind, word in {"relative": at.relative_to(folder), "absolute": "Z:" + str(at)}.items():
            made = at.with_suffix(f".{kind}.ply")
            word_out = made.relative_to(folder) if kind == "relative" else "Z:" + str(made)
            outcome = run(WINDOWS, [str(word), "--resolution", "16", "-q", "-o", str(word_out)], folder)
            ok = outcome.returncode == 0 and made.exists() and made.read_bytes() == expected.read_bytes()
            note(ok, f"paths: {name}, {kind}, {len(str(at))} characters {outcome.stderr.decode().strip()[-200:]}")
        left = [p.name for p in at.parent.iterdir() if p.name.startswith(".medial-vk")]
        note(not left, f"paths: nothing is left beside {name} {left}")
    (folder / "Stücke").mkdir()
    (folder / "Stücke" / "ä.obj").write_bytes(source)
    outcome = run(WINDOWS, ["batch", "Stücke", "-o", "Ergebnisse", "--resolution", "12", "-q"], folder)
    table = folder / "Ergebnisse" / "batch.csv"
    note(outcome.returncode == 0 and table.exists() and "ä" in table.read_text() and (folder / "Ergebnisse" / "ä.obj.medial.ply").exists(),
         f"paths: batch of a folder beyond ASCII {outcome.stderr.decode().strip()[-200:]}")


def check_lists_and_merge():
    """What --list prints names the same meshes in another run, and --merge makes the results of one run of those of two."""
    folder = WORK / "lists"
    shutil.copytree(WORK / "inputs", folder)
    batch = lambda words, where=folder, **options: run(WINDOWS, ["batch", *words, "--backend", "cpu", "--resolution", "8", "-q"],
                                                       where, **options)
    lines = run(WINDOWS, ["batch", "parts", "-o", "alone", "--list"], folder).stdout.decode().splitlines()
    note(lines == ["deep/box.obj", "egg.obj"], f"batch: --list names {lines}")
    whole = "Z:" + (folder / "parts" / "deep" / "box.obj").as_posix()
    (folder / "whole.txt").write_text(whole + "\n")
    said = run(WINDOWS, ["batch", "whole.txt", "-o", "alone", "--list"], folder).stdout.decode()
    note(said == whole + "\n", f"batch: --list keeps the drive: {said.strip()}")
    codes = [batch(["parts", "-o", "alone"]).returncode]
    for i, line in enumerate(lines):
        codes.append(batch(["-", "-o", f"../part{i}"], folder / "parts", input=f"{line}\n".encode()).returncode)
    codes.append(run(WINDOWS, ["batch", "--merge", "part0", "part1", "-o", "all"], folder).returncode)
    alone, merged = ({path.relative_to(folder / name).as_posix(): path.read_bytes() for path in (folder / name).rglob("*.ply")}
                     for name in ("alone", "all"))
    note(codes == [0, 0, 0, 0] and len(alone) == 2 and alone == merged, f"batch: --merge: exit codes {codes}, {sorted(merged)}")
    # One file by two names; a name that is no UTF-8 is that of no file, and fails alone.
    (folder / "names.txt").write_bytes(b"parts/egg.obj\nPARTS\\Egg.OBJ\ncaf\xe9.obj\n")
    outcome = batch(["names.txt", "-o", "names"])
    table = folder / "names" / "batch.csv"
    rows = table.read_text(errors="replace").splitlines()[1:] if table.exists() else []
    states = [row.split(",")[:2] for row in rows]
    note(outcome.returncode == 9 and [state for _, state in states] == ["done", "failed"],
         f"batch: names without regard to case, and of any bytes: {outcome.returncode}, {states}")


def check_batch_lock_and_resume():
    folder = WORK / "resume"
    shutil.copytree(WORK / "inputs", folder)
    words = ["batch", "list.txt", "-o", "out", "--resolution", "20"]
    first, again = run(WINDOWS, words, folder), run(WINDOWS, words, folder)
    note(first.returncode == 0 and again.returncode == 0, "batch: a second run goes on where the first has ended")
    note("2 done before" in again.stderr.decode(), "batch: the second run does nothing again")
    rows = (folder / "out" / "batch.csv").read_text().splitlines()
    note(len(rows) == 3, f"batch: {len(rows) - 1} lines for two meshes")
    slow = subprocess.Popen(["wine", str(WINDOWS), "batch", "turtle.obj", "-o", "other", "--resolution", "120"], cwd=folder,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for _ in range(600):
        if (folder / "other" / ".medial-vk.lock").exists():
            break
        try:
            slow.wait(0.1)
            break
        except subprocess.TimeoutExpired:
            pass
    refused = run(WINDOWS, ["batch", "box.obj", "-o", "other", "--resolution", "12"], folder)
    note(refused.returncode == 6 and "another medial-vk batch is writing" in refused.stderr.decode(),
         f"batch: the folder of another process is refused: {refused.returncode}, {refused.stderr.decode().strip()[-120:]}")
    slow.wait(900)


def check_interrupt():
    """Ctrl-C ends with exit code 130, and leaves the previous file and nothing else. It comes two seconds after the start,
    and each of these runs takes much longer."""
    for name, words in {
        "analysis": ["turtle.obj", "--resolution", "1200", "-o", "out.ply"],
        "reference": ["turtle.obj", "--resolution", "300", "--backend", "cpu", "-o", "out.ply"],
        "spheres": ["spheres", "turtle.obj", "--count", "4000", "-o", "out.csv"],
        "batch": ["batch", "turtle.obj", "-o", "results", "--resolution", "1200"],
    }.items():
        folder = WORK / "interrupt" / name
        shutil.copytree(WORK / "inputs", folder)
        out = folder / words[-1] if "-o" == words[-2] and name != "batch" else folder / "kept"
        out.write_text("before")
        outcome = subprocess.run(["wine", str(INTERRUPT), "2000", str(WINDOWS), *words], cwd=folder, capture_output=True,
                                 timeout=300)
        left = sorted(set(files_of(folder, INPUTS)) - {out.name})
        if name == "batch":
            left = [file for file in left if file not in ("results/.medial-vk.lock", "results/batch.csv")]
        said = outcome.stderr.decode().strip()
        note(outcome.returncode == 130 and out.read_text() == "before" and not left and "interrupted" in said,
             f"Ctrl-C: {name}: exit code {outcome.returncode}, left {left}, {said[-120:]}")


def check_doctor():
    folder = WORK / "doctor"
    folder.mkdir()
    outcome = run(WINDOWS, ["doctor", "--report", "doctor.json"], folder)
    text = outcome.stdout.decode()
    note(outcome.returncode == 0 and "Result: the default device works" in text, f"doctor: exit code {outcome.returncode}\n{text}")
    report = json.loads((folder / "doctor.json").read_text())
    note("by Wine" in text and report["devices"], "doctor: names the system and a device")


STEPS = {step.__name__: step for step in (compare_all, compare_line_ends, check_absent, check_paths, check_lists_and_merge,
                                          check_batch_lock_and_resume, check_interrupt, check_doctor)}
unknown = set(sys.argv[6:]) - set(STEPS)
if unknown:
    sys.exit(f"compare_commands.py: no steps: {', '.join(unknown)}; there are {', '.join(STEPS)}")
make_inputs(WORK / "inputs", MAKE_MODEL)
INPUTS = {path.relative_to(WORK / "inputs").as_posix() for path in (WORK / "inputs").rglob("*")}
for name, step in STEPS.items():
    if not sys.argv[6:] or name in sys.argv[6:]:
        step()
print(f"{compared} files compared, {len(failures)} failures")
print(f"other last digits of functions: {declared}; allowed, but not found: {alike}")
sys.exit(1 if failures else 0)
