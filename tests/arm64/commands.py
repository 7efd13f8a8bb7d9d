#!/usr/bin/env python3
"""Every command of medial-vk from end to end, by a program for another architecture and by the one of this machine.

    commands.py NATIVE_FOLDER OTHER_FOLDER MAKE_ARM      folders with medial-vk and make_model

Both run on the driver of the same make, lavapipe of the same Mesa, and every file that they write must have the same bytes,
except for times and for what names the device, which are left out of reports, pages, tables and printed text. Pictures are
drawn by the device, whose roundings differ: as in tests/picture, one byte of a thousand may differ by more than 2 of 255.
Run by scripts/test-arm64, in an environment that starts programs of both kinds (scripts/arm64-run).
"""
import base64
import concurrent.futures
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import time
import zlib

# In this order, in one folder for each program; a line may read what an earlier one wrote.
COMMANDS = [
    "model.obj --resolution 40 --check -o a.ply --ascii --picture a.png --medial-mesh a.surface.ply --sheet-curve a.csv"
    " --ball-volumes volumes.csv --report a.json --html a.html",
    "model.obj --resolution 24 --radius 0.1 --simplify --check -o b.npz",
    "model.obj --resolution 24 --mode thesis --check -o c.json",
    "box.obj --resolution 16 --backend cpu -o cpu.csv",
    "model.obj --resolution 24 --keep-volume 0.9 -o kept.glb",
    "model.obj --resolution 24 -o balls.ply --mesh-spheres",
    "model.obj --resolution 24 --thickness --thickness-histogram t.svg --boundary t.vtp --report t.json -o t.ply",
    "open.obj --resolution 24 --check -o d.ply",
    "box.dae --resolution 24 --check -o box.ply",
    "batch parts -o results --resolution 16 --html --volumes",
    "batch parts -o listed --list",
    "batch --merge results -o merged --html",
    "spheres model.obj --count 24 --check -o e.csv --picture e.png",
    "spheres model.obj --count 16 --contract cover --check -o f.csv",
    "spheres model.obj --count 16 --contract balanced -o g.csv",
    "spheres model.obj --count 16 --method source --check -o h.csv",
    "spheres box.obj --count 12 --contract both -o box.body.npz",
    "spheres arm/robot_arm/arm.urdf --count-per-link 4 --check -o i.yaml",
    "distance box.obj far.obj --poses poses.csv --check -o j.csv --picture j.png --html j.html",
    "distance box.body.npz box.body.npz --poses poses.csv --balls -o k.csv",
    "clearance arm/robot_arm/arm.urdf --scene far.obj --joints joints.csv -o l.csv",
    "follow box.obj bent.obj --count 12 --check -o m.npz -o m.csv -o m.glb --html m.html",
    "follow box.obj bent.obj --contract cover --count 12 -o n.npz",
    "fit box.obj --count 4 --check -o v.json --report v.report.json --picture v.png",
    "fit box.obj --primitives capsules --count 4 -o w.usda",
    "spheres box.obj --primitives cones --count 4 -o x.glb",
    "curvature a.ply -o o.csv --report o.json",
    "curvature a.ply --method source -o p.npz",
    "plane letter.svg -o q.json --picture q.png --html q.html --report q.report.json",
    "plane model.obj --slice z=50% --prune-significance 5% -o r.svg",
    "voronoi box.obj far.obj --resolution 24 -o s.ply --picture s.png --roadmap s.json --html s.html",
    "voronoi letter.svg ring.svg -o u.json",
]
TEXT = (".json", ".html", ".csv", ".svg", ".txt")
LETTER = ('<svg xmlns="http://www.w3.org/2000/svg"><path fill-rule="evenodd" d="M0 0 H40 V60 C20 70 5 50 0 40 Z '
          'M10 10 V30 H30 V10 Z"/></svg>')
RING = '<svg xmlns="http://www.w3.org/2000/svg"><circle cx="90" cy="30" r="20"/></svg>'


def obj(points, faces):
    lines = ["v {!r} {!r} {!r}".format(*point) for point in points]
    return "\n".join(lines + ["f {} {} {}".format(*(i + 1 for i in face)) for face in faces]) + "\n"


def grid_box(size, cells, move=lambda point: point):
    """The surface of a box from the origin to `size`, each side cut into cells x cells squares of two triangles."""
    index, points, faces = {}, [], []

    def vertex(at):
        if at not in index:
            index[at] = len(points)
            points.append(move([s * a / cells for s, a in zip(size, at)]))
        return index[at]

    for axis in range(3):
        for side in (0, cells):
            for i in range(cells):
                for j in range(cells):
                    corners = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        at = [0, 0, 0]
                        at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3] = side, a, b
                        corners.append(vertex(tuple(at)))
                    if side == 0:
                        corners.reverse()
                    faces += [corners[:3], [corners[0], corners[2], corners[3]]]
    return points, faces


def collada(points, faces):
    positions = " ".join(f"{x!r}" for point in points for x in point)
    indices = " ".join(str(i) for face in faces for i in face)
    return f"""<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="a" count="{3 * len(points)}">{positions}</float_array><technique_common>
<accessor source="#a" count="{len(points)}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="{len(faces)}">
<input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


def make_inputs(folder, make_model, make_arm):
    subprocess.run([make_model, "model.obj"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    lines = (folder / "model.obj").read_text().splitlines()
    faces = [line for line in lines if line.startswith("f ")]
    (folder / "open.obj").write_text("\n".join([x for x in lines if not x.startswith("f ")] + faces[40:]) + "\n")
    box = grid_box((3.0, 2.0, 1.0), 4)
    bend = grid_box((3.0, 2.0, 1.0), 4, lambda p: [p[0], p[1], p[2] + 0.05 * p[0] * p[0]])
    away = grid_box((1.0, 1.0, 1.0), 2, lambda p: [p[0] + 5, p[1] + 0.3, p[2] + 0.1])
    (folder / "box.obj").write_text(obj(*box))
    (folder / "bent.obj").write_text(obj(*bend))
    (folder / "far.obj").write_text(obj(*away))
    (folder / "box.dae").write_text(collada(*box))
    (folder / "parts").mkdir()
    for name in ("box.obj", "far.obj"):
        (folder / "parts" / name).write_bytes((folder / name).read_bytes())
    (folder / "letter.svg").write_text(LETTER)
    (folder / "ring.svg").write_text(RING)
    (folder / "poses.csv").write_text("x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,1\n-3.3,0.2,0.1,0,0,0.6,0.8\n9,1,0,0.5,0.5,0.5,0.5\n")
    subprocess.run([sys.executable, make_arm, "arm"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    joints = re.findall(r'<joint name="([^"]+)" type="(?:revolute|prismatic|continuous)"(.*?)</joint>',
                        (folder / "arm/robot_arm/arm.urdf").read_text(), flags=re.S)
    names = [name for name, body in joints if "<mimic" not in body]
    rows = [",".join([str(value)] * len(names)) for value in (0, 0.01, 0.02)]
    (folder / "joints.csv").write_text("\n".join([",".join(names), *rows]) + "\n")


def without_times(text):
    """Without times and the names of the device, with which lavapipe gives the width of its vectors."""
    text = re.sub(r'("(?:\w*seconds\w*|milliseconds)": ?)[-+.0-9e]+', r"\1_", text)
    text = re.sub(r"\b[0-9.]+ (m?s|seconds|milliseconds)\b", r"_ \1", text)
    text = re.sub(r'("seconds": ?)\{[^{}]*\}', r"\1_", text)
    text = re.sub(r"llvmpipe[^\"\n]*", "_", text)
    text = re.sub(r'("memory_bytes": ?)[0-9]+', r"\1_", text)
    return text


def without_columns_of_times(text):
    rows = [line.split(",") for line in text.splitlines()]
    names = rows[0] if rows else []
    kept = [i for i, name in enumerate(names) if "seconds" not in name]
    if len(kept) == len(names) or any(len(row) != len(names) for row in rows):
        return text
    return "\n".join(",".join(row[i] for i in kept) for row in rows)


def content(folder, name):
    data = (folder / name).read_bytes()
    if name.suffix not in TEXT:
        return data
    text = without_times(data.decode()).replace(str(folder), "FOLDER")
    return (without_columns_of_times(text) if name.suffix == ".csv" else text).encode()


def pixels(png):
    """The lines of a picture of 8 bits and three colours, and its size."""
    at, body, size = 8, b"", ()
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        if kind == b"IHDR":
            size = struct.unpack(">IIBB", png[at + 8:at + 18])
        if kind == b"IDAT":
            body += png[at + 8:at + 8 + length]
        at += 12 + length
    width, height, depth, colours = size
    if (depth, colours) != (8, 2):
        raise ValueError(f"a picture of {depth} bits and of colour type {colours}")
    raw, stride, lines, above = zlib.decompress(body), 3 * width, [], bytes(3 * width)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride if kind else 0):
            left, up, corner = (line[x - 3], above[x], above[x - 3]) if x > 2 else (0, above[x], 0)
            if kind == 4:  # Paeth
                guess = left + up - corner
                near = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            else:
                near = (0, left, up, (left + up) // 2)[kind]
            line[x] = (line[x] + near) & 255
        lines.append(bytes(line))
        above = bytes(line)
    return lines, size


def look_the_same(one, other):
    (lines, size), (other_lines, other_size) = pixels(one), pixels(other)
    if size != other_size:
        return False
    apart = sum(abs(a - b) > 2 for x, y in zip(lines, other_lines) if x != y for a, b in zip(x, y))
    return 1000 * apart <= 3 * size[0] * size[1]


def same(name, one, other):
    if one == other:
        return True
    if name.suffix == ".png":
        return look_the_same(one, other)
    if name.suffix != ".html":
        return False
    # A page may hold a picture.
    parts, other_parts = (re.split(rb"data:image/png;base64,([A-Za-z0-9+/=]+)", page) for page in (one, other))
    return parts[::2] == other_parts[::2] and all(
        look_the_same(base64.b64decode(a), base64.b64decode(b)) for a, b in zip(parts[1::2], other_parts[1::2]))


def run(folder, program, command):
    begun = time.monotonic()
    # scripts/arm64-run names the driver of the other architecture.
    environment = {k: v for k, v in os.environ.items() if folder.name != "native" or not k.startswith("VK_")}
    result = subprocess.run([program, *command.split()], cwd=folder, env=environment, capture_output=True, text=True,
                            timeout=3600)
    if result.returncode != 0:
        sys.exit(f"{program} {command}: exit code {result.returncode}\n{result.stdout}{result.stderr}")
    return without_times(result.stdout), time.monotonic() - begun


def files_of(folder):
    return {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}


def first_difference(one, other):
    """Where two files differ, for a person."""
    at = next((i for i, (a, b) in enumerate(zip(one, other)) if a != b), min(len(one), len(other)))
    return f"{len(one)} and {len(other)} bytes, from byte {at}:\n  {one[max(0, at - 60):at + 60]!r}\n  {other[max(0, at - 60):at + 60]!r}"


def main():
    programs = [pathlib.Path(folder).resolve() / "medial-vk" for folder in sys.argv[1:3]]
    chosen = [c for c in COMMANDS if re.search(os.environ.get("MEDIAL_VK_COMMANDS", ""), c)]
    if not chosen:
        sys.exit(f"no command matches {os.environ['MEDIAL_VK_COMMANDS']}")
    different = 0
    keep = os.environ.get("MEDIAL_VK_KEEP")
    with tempfile.TemporaryDirectory() as temporary, concurrent.futures.ThreadPoolExecutor(2) as pool:
        folders = [pathlib.Path(keep or temporary) / name for name in ("native", "other")]
        for folder, program in zip(folders, programs):
            folder.mkdir(parents=True)
            make_inputs(folder, program.parent / "make_model", pathlib.Path(sys.argv[3]).resolve())
        inputs = files_of(folders[0])
        for name in sorted(inputs | files_of(folders[1])):
            if (folders[0] / name).read_bytes() != (folders[1] / name).read_bytes():
                sys.exit(f"make_model writes other bytes of {name}")
        written = inputs
        for command in chosen:
            done = list(pool.map(run, folders, programs, [command] * 2))
            after = [files_of(folder) for folder in folders]
            new, written = sorted(after[0] - written), after[0]
            faults = [] if after[0] == after[1] else [f"other files: {sorted(after[0] ^ after[1])}"]
            if not new and "--list" not in command:
                faults.append("no file is written")
            if done[0][0] != done[1][0]:
                faults.append(f"prints other text:\n{done[0][0]}\n{done[1][0]}")
            for name in new:
                pair = [content(folder, name) for folder in folders if (folder / name).exists()]
                if len(pair) == 2 and not same(name, *pair):
                    faults.append(f"{name}: {first_difference(*pair)}")
            print(f"medial-vk {command}: {len(new)} files, {done[0][1]:.1f} s and {done[1][1]:.1f} s: "
                  + ("the same" if not faults else "DIFFERENT"), flush=True)
            for fault in faults:
                print(f"  {fault}", flush=True)
            different += bool(faults)
        # It describes the machine, but its trial extraction has the same points.
        trials = [re.findall(r"\d+ medial spheres in|agrees with the CPU reference", run(folder, program, "doctor --time-limit 3600")[0])
                  for folder, program in zip(folders, programs)]
        if len(trials[0]) < 2 or trials[0] != trials[1]:
            sys.exit(f"medial-vk doctor: other trials: {trials}")
        print("medial-vk doctor: the same trial", flush=True)
    print(f"{len(chosen) - different} passed, {different} failed")
    if different:
        sys.exit(1)


if __name__ == "__main__":
    main()
