"""The plan: which meshes are a chunk, and what the results of each chunk depend on.

A mesh stays in its chunk for as long as it exists; new meshes get new chunks. The key of a chunk is a digest of its meshes,
with the size and time of their files, the options and the version of the program. A chunk is done if there is a record with
its key, so that a change of one mesh changes the key of one chunk, and a restart changes none.
"""
import fcntl
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys
import urllib.parse

from files import bytes_of, read_json, text_of, write_json

FORMAT = 1


def options_of(config):
    options = config["options"]
    options = shlex.split(options) if isinstance(options, str) else [str(option) for option in options]
    for name in ("-o", "--output", "--threads"):
        if any(option == name or option.startswith(f"{name}=") for option in options):
            sys.exit(f"options: {name} is a setting of the workflow, not an option")
    return options


def run_tool(arguments):
    result = subprocess.run([bytes_of(argument) for argument in arguments], stdout=subprocess.PIPE, check=False)
    if result.returncode != 0:
        sys.exit(f"{shlex.join(arguments)} ended with {result.returncode}")
    return text_of(result.stdout)


def find_meshes(config, options):
    """As lists name them, from the folder that paths begin with."""
    meshes = str(config["meshes"])
    lines = run_tool([str(config["medial_vk"]), "batch", "--list", meshes, "-o", str(config["output"]), *options])
    base = pathlib.Path(meshes) if pathlib.Path(meshes).is_dir() else pathlib.Path(meshes).parent
    return os.path.realpath(base), [line for line in lines.split("\n") if line]


def times_of(path):
    try:
        status = os.stat(path)
    except OSError:
        return None
    return [status.st_size, status.st_mtime_ns]


def files_beside(path):
    """The files that a glTF names; all other formats of meshes hold their triangles themselves."""
    if not path.lower().endswith(".gltf"):
        return []
    scene = read_json(path)
    buffers = scene.get("buffers", []) if isinstance(scene, dict) else []
    names = [buffer.get("uri") for buffer in buffers if isinstance(buffer, dict)] if isinstance(buffers, list) else []
    return [os.path.join(os.path.dirname(path), urllib.parse.unquote(name))
            for name in names if isinstance(name, str) and not name.startswith("data:")]


def state_of_mesh(base, name):
    path = os.path.join(base, name)
    return [name, times_of(path), *(times_of(file) for file in files_beside(path))]


def size_of(state):
    return state[1][0] if state[1] else 0


def digest_of(value):
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()[:16]


def assign(earlier, states, most, most_bytes):
    """Chunks as lists of names: those of the earlier plan without meshes that are gone, then new ones. `states` is a
    dictionary by name, in the order of the meshes."""
    chunks = {number: [name for name in names if name in states] for number, names in earlier.items()}
    known = {name for names in chunks.values() for name in names}
    number = max((int(number) for number in earlier), default=-1)
    current, size = None, 0
    for name in states:
        if name in known:
            continue
        if current is None or len(current) == most or size + size_of(states[name]) > most_bytes:
            number += 1
            current, size = chunks.setdefault(f"{number:06}", []), 0
        current.append(name)
        size += size_of(states[name])
    return {number: names for number, names in chunks.items() if names}


def forget_lost_results(folder, key):
    """A record whose run is gone is none: its chunk runs again."""
    file = folder / f"done-{key}.json"
    record = read_json(file)
    if record is not None and not (folder / "runs" / record["run"] / "batch.csv").exists():
        file.unlink(missing_ok=True)


def make_plan(config):
    """Writes the plan and returns its key."""
    options, output = options_of(config), pathlib.Path(str(config["output"]))
    if int(config["chunk"]) < 1 or float(config["chunk_megabytes"]) <= 0:
        sys.exit("chunk and chunk_megabytes: at least one mesh must fit into a chunk")
    program = str(config["medial_vk"])
    version = run_tool([program, "--version"]).strip()
    base, meshes = find_meshes(config, options)
    states = {name: state_of_mesh(base, name) for name in meshes}
    state = output / ".workflow"
    state.mkdir(parents=True, exist_ok=True)
    with open(state / "plan.lock", "w") as lock:
        fcntl.lockf(lock, fcntl.LOCK_EX)  # two plans at once would give one number to two chunks
        earlier = read_json(state / "plan.json") or {"chunks": {}}
        chunks = assign(earlier["chunks"], states, int(config["chunk"]), 1e6 * float(config["chunk_megabytes"]))
        write_json(state / "plan.json", {"format": FORMAT, "chunks": chunks})
        keys = {}
        for number, names in chunks.items():
            requested = {"format": FORMAT, "program": program, "version": version, "options": options, "base": base,
                      "meshes": names}
            keys[number] = digest_of([requested, [states[name] for name in names], str(config.get("verify", ""))])
            folder = state / "chunks" / number
            folder.mkdir(parents=True, exist_ok=True)
            forget_lost_results(folder, keys[number])
            if not (folder / f"plan-{keys[number]}.json").exists():
                write_json(folder / f"plan-{keys[number]}.json", requested)
        key = digest_of(keys)
        if not (state / f"plan-{key}.json").exists():
            write_json(state / f"plan-{key}.json",
                       {"format": FORMAT, "program": program, "options": options, "chunks": keys})
    return key


def record_of(state, number, key):
    return f"{state}/chunks/{number}/done-{key}.json"


def records_of(state, key):
    """The records of all chunks of a plan."""
    requested = read_json(f"{state}/plan-{key}.json")
    if requested is None:
        sys.exit(f"there is no plan {state}/plan-{key}.json")
    return [record_of(state, number, of_chunk) for number, of_chunk in requested["chunks"].items()]


def tell_result(state, key):
    merged = read_json(f"{state}/merged-{key}.json")
    if merged:
        print(f"{merged['meshes']} meshes: {merged['done']} done, {merged['failed']} failed; {merged['table']}",
              file=sys.stderr)
