#!/usr/bin/env python3
"""Runs every command that README.md, docs/, `medial-vk --help` and the manual page show.

    shown_commands.py SOURCE_DIR PROGRAM=FILE ...

A command is a line of a code block that is marked `sh` or unmarked, an example of the help or of the manual page, or words
in backticks that call one of the project's programs or scripts. Each must exit with 0 and write the files that it names.
Every document has a folder of its own, in which its commands run in their order; two documents run at a time. A command
that has run for another document, on files with the same bytes, is not run again: its files are copied.
NOT_RUN lists the commands that cannot be run here, with the reasons; a command that is neither run nor listed fails the
test, and so does an entry that no command matches. The exit code is 77 if there is no Vulkan device.
"""
import concurrent.futures
import hashlib
import json
import pathlib
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time

# The beginnings of commands that are not run, and the reasons.
NOT_RUN = {
    r"scripts/(run$|run MESH|test|fuzz|soak|lint)|\.ci/run": "installs packages and builds, or runs for hours; .ci/run calls scripts/test",
    r"build/release/bin/test_": "is a program of tests that ctest runs, too",
    r"scripts/install-dependencies": "installs packages",
    r"scripts/build-deb": "builds packages for many minutes; package.debian runs it",
    r"scripts/build-zip": "builds for Windows for many minutes; scripts/test-windows runs it",
    r"scripts/arm64-run ": "needs a build for another architecture; scripts/test-arm64 runs it",
    r"bench/|build/release/bin/bench_": "needs libraries, models or hours that the tests do not have",
    r"cmake ": "has configured and built this test; package.consumer installs",
    r"ctest ": "runs this test",
    r"node tests/page/look.mjs PAGE": "names no file; with files it is run",
    r"medial-vk batch( FOLDER -o OUT)?$": "names the command; a run of it has meshes",
    r"medial-vk spheres( MESH| ROBOT.urdf)?$": "names the command; a run of it has a goal",
    r"medial-vk fit( MESH)?$": "names the command; a run of it has a goal",
    r"medial-vk distance( A B)?$": "names the command; a run of it has two meshes",
    r"medial-vk clearance( ROBOT.urdf)?$": "names the command; a run of it has joints",
    r"medial-vk clearance robot.urdf --joints joints.csv --balls": "fits covers to all links, which takes minutes",
    r"medial-vk follow( REST FRAME...)?$": "names the command; a run of it has meshes",
    r"medial-vk curvature( BALLS)?$": "names the command; a run of it has balls",
    r"medial-vk plane( SHAPE)?$": "names the command; a run of it has a shape",
    r"medial-vk voronoi( SITE SITE)?$": "names the command; a run of it has sites",
    r"medial-vk VERSION": "is not a command but a comment of the PLY",
    r"medial-vk out/torus.ply": "needs a mesh of 5,000,000 triangles",
    r"yes \| medial-vk": "reads 4 GiB",
}
# Replacements for words that readers supply, and for commands that cannot run here in the documented form.
WORDS = [(r"\bMESH\b", "turtle.obj"), (r"\bFILE\b", "report.json"), (r"^perf record ", ""),
         (r"^scripts/run (\S+) -- ", r"medial-vk \1 "), (r"build/release/bin/", "")]
CALLS = re.compile(r"(^|\s)(medial-vk|make_model|renderer|examples/robot_arm/make_arm.py|scripts/[\w-]+|bench/[\w-]+|cmake|ctest|node) \S")


def commands_of_markdown(text):
    for language, body in re.findall(r"^```(\w*)\n(.*?)^```$", text, flags=re.M | re.S):
        if language in ("", "sh"):
            yield from (re.sub(r"\s+#.*", "", line) for line in body.splitlines() if line and not line.startswith("#"))
    prose = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    for words in re.findall(r"`([^`]+)`", prose):
        if CALLS.search(words):
            yield " ".join(words.split()).replace("\\|", "|")


def commands_of_help(text):
    examples = text.split("Examples:\n")[1].split("\n\n")[0]
    return [re.split(r"\s{2,}", line.strip())[0] for line in examples.splitlines()]


def commands_of_manual_page(text):
    examples = text.split(".SH EXAMPLES\n")[1].split(".SH ")[0]
    return [line[3:].replace("\\-", "-") for line in examples.splitlines() if line.startswith(".B ")]


def shown(source, programs):
    """All commands, as pairs of document and command."""
    documents = [source / "README.md", *sorted((source / "docs").glob("*.md"))]
    found = [(d.name, command) for d in documents for command in commands_of_markdown(d.read_text())]
    for words in ([], ["batch"], ["spheres"], ["fit"], ["distance"], ["clearance"], ["follow"], ["curvature"], ["plane"], ["voronoi"], ["doctor"]):
        text = subprocess.run([programs["medial-vk"], *words, "--help"], check=True, capture_output=True, text=True).stdout
        found += [(" ".join([*words, "--help"]), command) for command in commands_of_help(text)]
    for page in sorted((source / "docs").glob("*.1")):
        found += [(page.name, command) for command in commands_of_manual_page(page.read_text())]
    return list(dict.fromkeys(found))


def outputs_of(words):
    """The files that a command must write."""
    program, arguments = words[0], words[1:]
    if program == "make_model":
        return arguments[:1]
    if program == "renderer":
        return [f"{arguments[0]}/frame-{i}.png" for i in range(int(arguments[1]))]
    if program == "node":
        return arguments[2:3]
    if arguments[:1] == ["batch"]:
        if "--list" in arguments:
            return []
        folders = [b for a, b in zip(arguments, arguments[1:]) if a in ("-o", "--output")]
        names = ["batch.csv", *(["batch.html"] if "--html" in arguments else [])]
        return [f"{folder}/{name}" for folder in folders for name in names]
    files = [b for a, b in zip(arguments, arguments[1:])
             if a in ("-o", "--output", "--html", "--picture", "--report", "--histogram", "--write-srdf", "--rig",
                      "--boundary", "--thickness-histogram", "--thickness-points")]
    if arguments[:1] in (["distance"], ["clearance"]):
        return files
    if arguments[:1] == ["follow"]:
        is_named = {"-o", "--output", "--help"} & set(arguments)
        return files if is_named else [*files, pathlib.Path(arguments[1]).stem + ".follow.npz"]
    if arguments[:1] == ["curvature"]:
        is_named = {"-o", "--output", "--help"} & set(arguments)
        return files if is_named else [*files, re.sub(r"\.(medial|spheres|body)$", "", pathlib.Path(arguments[-1]).stem) + ".curvature.ply"]
    if arguments[:1] == ["plane"]:
        is_named = {"-o", "--output", "--help"} & set(arguments)
        return files if is_named else [*files, pathlib.Path(arguments[1]).stem + ".axis.json"]
    if arguments[:1] == ["voronoi"]:
        files += [b for a, b in zip(arguments, arguments[1:]) if a == "--roadmap"]
        is_named = {"-o", "--output", "--help"} & set(arguments)
        ending = ".voronoi.json" if arguments[1:2] and arguments[1].endswith(".svg") else ".voronoi.ply"
        return files if is_named else [*files, pathlib.Path(arguments[1]).stem + ending]
    meshes = [a for a in arguments if re.search(r"\.(obj|stl|ply)$", a) and a not in files]
    if arguments[:1] == ["fit"] or "--primitives" in arguments:
        is_named = {"-o", "--output", "--help"} & set(arguments)
        return files if is_named else [*files, *(pathlib.Path(mesh).stem + ".hulls.json" for mesh in meshes)]
    if arguments[:1] == ["spheres"]:
        robots = [a for a in arguments if a.endswith(".urdf") and a not in files]
        if "--frames" in arguments:  # the others are frames
            meshes = meshes[:1]
        if not {"-o", "--output"} & set(arguments):
            both = "both" in words and words[words.index("both") - 1] == "--contract"
            ending = ".spheres.urdf" if robots else ".body.npz" if both else ".spheres.csv"
            files += [pathlib.Path(a).stem + ending for a in robots or meshes]
    elif meshes and not {"-o", "--output"} & set(arguments):
        files.append(pathlib.Path(meshes[0]).stem + (".spheres.ply" if "--mesh-spheres" in arguments else ".medial.ply"))
    return files


class Skip(Exception):
    """The reason why no command can be tested here."""


class Done:
    """The commands that have run, and the files that they wrote, by their words and the bytes of their inputs."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.path.mkdir()
        self.lock, self.runs = threading.Lock(), {}

    def once(self, key, run):
        """Returns the result of run(folder for copies of its files), now or earlier, and whether it was earlier."""
        with self.lock:
            before = key in self.runs
            if not before:
                self.runs[key] = concurrent.futures.Future(), self.path / str(len(self.runs))
        result, copies = self.runs[key]
        if not before:
            copies.mkdir()
            try:
                result.set_result(run(copies))
            except BaseException as error:
                result.set_exception(error)
        return result.result(), copies, before


class Folder:
    """The folder in which the commands of one document run, with the models that they name."""

    def __init__(self, path, source, programs, done=None, models=None):
        self.path, self.source, self.programs, self.done = pathlib.Path(path), source, programs, done
        if models:
            shutil.copytree(models, self.path)
        else:
            self.make_models()

    def make_models(self):
        self.path.mkdir()
        for folder in ("out", "path"):
            (self.path / folder).mkdir()
        self.call(["make_model", "turtle.obj"])
        for name in ("bunny.obj", "spot.obj", "out/turtle.obj"):
            shutil.copy(self.path / "turtle.obj", self.path / name)
        self.write_part()
        (self.path / "poses.csv").write_text("x,y,z,qx,qy,qz,qw\n3,0,0,0,0,0,1\n0,4,0,0.6,0,0,0.8\n")
        (self.path / "joints.csv").write_text("joint1,joint2,joint3,joint4,joint5,joint6\n0,0,0,0,0,0\n0.5,1,-1,0.25,0,1\n")
        (self.path / "letter.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 24">'
                                              '<path d="M2 2h4v8h8v-8h4v20h-4v-8q-4 2-8 0v8h-4z"/></svg>')
        (self.path / "ring.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 24">'
                                            '<circle cx="40" cy="12" r="8"/></svg>')
        self.call(["make_arm.py", "."])
        shutil.copytree(self.path / "robot_arm/meshes", self.path / "meshes")
        for name in ("arm.urdf", "robot.urdf"):
            shutil.copy(self.path / "robot_arm/arm.urdf", self.path / name)

    def write_part(self):
        """An STL: the coarsest turtle; and part.obj bent and twisted, as the frames of a motion."""
        self.call(["make_model", "part.obj", "52"])
        for name, lift in (("bent.obj", lambda x, z: x * x / 4), ("twisted.obj", lambda x, z: x * z / 4)):
            self.write_moved("part.obj", name, lift)
        self.write_moved("part.obj", "other.obj", lambda x, z: 3)
        for frame in range(3):
            self.write_moved("part.obj", f"walk_{frame:04d}.obj", lambda x, z: frame * x * x / 8)
        corners, triangles, lines = [], [], ["solid part"]
        for kind, *rest in (line.split() for line in (self.path / "part.obj").read_text().splitlines() if line):
            if kind == "v":
                corners.append(" ".join(rest))
            elif kind == "f":
                triangles += [int(word.split("/")[0]) - 1 for word in rest]
                triangle = [corners[i] for i in triangles[-3:]]
                lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {c}" for c in triangle), "endloop", "endfacet"]
        self.write_dancer(corners, triangles)
        text = "\n".join(lines + ["endsolid part", ""])
        for name in ("part.stl", "path/part.stl"):
            (self.path / name).write_text(text)
        (self.path / "parts").mkdir()
        for name in ("part.obj", "other.obj"):
            shutil.copy(self.path / name, self.path / "parts")
        (self.path / "list.txt").write_text("part.stl\nother.obj\n")

    def write_dancer(self, corners, triangles):
        """A glTF of the part, which turns by a quarter about x in a second, as an animation of its node."""
        data = struct.pack(f"<{3 * len(corners)}f", *(float(x) for corner in corners for x in corner.split()))
        data += struct.pack(f"<{len(triangles)}I", *triangles) + struct.pack("<10f", 0, 1, 0, 0, 0, 1, 0.5**0.5, 0, 0, 0.5**0.5)
        counts = [len(corners), len(triangles), 2, 2]
        sizes = [12 * len(corners), 4 * len(triangles), 8, 32]
        document = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}],
                            "samplers": [{"input": 2, "output": 3}]}],
            "accessors": [{"bufferView": i, "count": counts[i], "componentType": 5125 if i == 1 else 5126,
                           "type": ("VEC3", "SCALAR", "SCALAR", "VEC4")[i]} for i in range(4)],
            "bufferViews": [{"buffer": 0, "byteOffset": sum(sizes[:i]), "byteLength": sizes[i]} for i in range(4)],
            "buffers": [{"byteLength": len(data)}]}
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
        (self.path / "dancer.glb").write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)

    def write_moved(self, source, name, lift):
        """The same triangles, with vertices lifted by a function of the other two coordinates."""
        lines = []
        for line in (self.path / source).read_text().splitlines():
            if line.startswith("v "):
                x, y, z = map(float, line.split()[1:4])
                line = f"v {x!r} {y + lift(x, z)!r} {z!r}"
            lines.append(line)
        (self.path / name).write_text("\n".join(lines) + "\n")

    def call(self, words):
        words = [self.programs.get(words[0], words[0]), *words[1:]]
        if words[0].endswith("make_arm.py"):
            words[:1] = [sys.executable, str(self.source / "examples/robot_arm/make_arm.py")]
        if words[1:] and words[1].startswith("tests/"):
            words[1] = str(self.source / words[1])
        return subprocess.run(words, cwd=self.path, capture_output=True, text=True)

    def run(self, command):
        """Returns the fault of a command, empty if there is none; None if this build cannot run the command."""
        words = shlex.split(command)
        if words[0] == "node" and not shutil.which("node"):
            return None
        if words[0] not in (*self.programs, "node", "examples/robot_arm/make_arm.py"):
            return "is neither a program of this test nor listed in NOT_RUN"
        files = outputs_of(words)
        for file in files:
            (self.path / file).unlink(missing_ok=True)
        (wrong, wall), copies, before = self.done.once(self.key(words), lambda to: self.run_now(words, files, to))
        if before:
            for copy in copies.rglob("*"):
                if copy.is_file():
                    to = self.path / copy.relative_to(copies)
                    to.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(copy, to)
        self.seconds = 0 if before else wall
        return wrong

    def key(self, words):
        """The words, and the bytes of the files that they name. A robot names the same files in all folders."""
        named = [self.path / word for word in words[1:]]
        files = [f for n in named for f in ([n] if n.is_file() else sorted(n.rglob("*")) if n.is_dir() else []) if f.is_file()]
        return (*words, *((str(f.relative_to(self.path)), hashlib.sha256(f.read_bytes()).digest()) for f in files))

    def run_now(self, words, files, copies):
        """Like run(), and returns the seconds as well; all written files are copied."""
        there = {f: f.stat().st_mtime_ns for f in self.path.rglob("*") if f.is_file()}
        begin = time.monotonic()
        wrong = self.judge(words, files)
        seconds = time.monotonic() - begin
        for file in self.path.rglob("*"):
            if file.is_file() and there.get(file) != file.stat().st_mtime_ns:
                copy = copies / file.relative_to(self.path)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, copy)
        return wrong, seconds

    def judge(self, words, files):
        done = self.call(words)
        output = done.stdout + done.stderr
        if words[0] == "medial-vk" and done.returncode == 4 or "no device that draws" in output:
            raise Skip(f"there is no Vulkan device: {output}")
        # Without npm at the build there is no page to be examined; without Chromium no program to examine it.
        if "was built without its page" in output or (words[0] == "node" and done.returncode == 77):
            return None
        if done.returncode != 0:
            return f"exit status {done.returncode}\n{output}"
        missing = [file for file in files if not (self.path / file).is_file() or not (self.path / file).stat().st_size]
        return f"has not written {', '.join(missing)}" if missing else ""


def not_run(command):
    return next((pattern for pattern in NOT_RUN if re.match(pattern, command)), None)


def run_document(where, commands, folder):
    """Runs the commands and prints each result at once; returns (command, fault or None, seconds) for each."""
    results = []
    for command in commands:
        for shown_as, meant in WORDS:
            command = re.sub(shown_as, meant, command)
        folder.seconds = 0
        wrong = folder.run(command)
        result = "cannot be run by this build" if wrong is None else wrong or "ok"
        print(f"{where}: {command}: {result} ({folder.seconds:.1f} s)", flush=True)
        results.append((command, wrong))
    return results


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    programs = dict(argument.split("=", 1) for argument in sys.argv[2:])
    listed, failures, ran, documents = set(), [], 0, {}
    for where, command in shown(source, programs):
        pattern = not_run(command)
        if pattern:
            listed.add(pattern)
        else:
            documents.setdefault(where, []).append(command)
    with tempfile.TemporaryDirectory() as top, concurrent.futures.ThreadPoolExecutor(2) as workers:
        top = pathlib.Path(top)
        models = Folder(top / "models", source, programs).path
        done = Done(top / "done")
        running = {where: workers.submit(run_document, where, commands, Folder(top / where, source, programs, done, models))
                   for where, commands in documents.items()}
        for where, document in running.items():
            try:
                for command, wrong in document.result():
                    ran += wrong == ""
                    if wrong:
                        failures.append(f"{where}: {command}: {wrong}")
            except Skip as skip:
                workers.shutdown(cancel_futures=True)
                print(f"SKIPPED: {skip}")
                sys.exit(77)
    failures += [f"NOT_RUN lists {p}, which no document shows" for p in NOT_RUN if p not in listed]
    print(f"{ran} commands were run, {len(done.runs)} of them different")
    if ran < 20:
        failures.append("too few commands were found")
    if failures:
        print("\n".join(["", *failures]))
        sys.exit(1)


if __name__ == "__main__":
    main()
