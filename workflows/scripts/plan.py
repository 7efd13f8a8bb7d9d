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
from table import Table, name_of_line

FORMAT = 1
SETTINGS = ("-o", "--output", "--threads")
OF_THE_WORKFLOW = ("--list", "--merge", "-q", "--quiet", "-v", "--verbose", "-h", "--help")


def options_of(config):
    options = config["options"]
    options = shlex.split(options) if isinstance(options, str) else [str(option) for option in options]
    for option in options:
        name = option.split("=")[0]
        short = name[:2] if name[:1] == "-" and name[:2] != "--" else None  # a value may stand behind it: -oDIR
        if name in SETTINGS or short in SETTINGS:
            sys.exit(f"options: {option}: the folder of results and the threads are settings of the workflow, no options")
        if name in OF_THE_WORKFLOW or short in OF_THE_WORKFLOW:
            sys.exit(f"options: {option}: the workflow itself calls medial-vk batch with or without this option")
    return options


def check_folders(config):
    """Of what Snakemake, or a command line, would take for something else."""
    for name in ("meshes", "output"):
        if str(config[name]).startswith("-"):
            sys.exit(f"{name}: {config[name]} begins like an option: write ./{config[name]}")
    if any(sign in str(config["output"]) for sign in "{}"):
        sys.exit(f"output: {config['output']} has braces, between which Snakemake expects a wildcard: name another folder")


def program_of(config):
    """A path is made absolute, since jobs work in other folders."""
    program = str(config["medial_vk"])
    return os.path.abspath(program) if "/" in program else program


def run_tool(arguments):
    result = subprocess.run([bytes_of(argument) for argument in arguments], stdout=subprocess.PIPE, check=False)
    if result.returncode != 0:
        sys.exit(f"{shlex.join(arguments)} ended with {result.returncode}")
    return text_of(result.stdout)


def find_meshes(config, options):
    """As lists name them, from the folder that paths begin with."""
    meshes = str(config["meshes"])
    lines = run_tool([program_of(config), "batch", "--list", meshes, "-o", str(config["output"]), *options])
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


def lost_result(run, names):
    """What the folder of a run lacks of its results: the line of a mesh, or a file; None if all are there."""
    table = Table(run)
    without_line = next((name for name in names if name not in table.rows), None)
    return f"the line of {without_line!r}" if without_line is not None else table.missing_file(run)


def forget_lost_results(folder, key, names):
    """A record whose run is gone, or lacks a file, is none: its chunk runs again."""
    file = folder / f"done-{key}.json"
    record = read_json(file)
    if record is not None and lost_result(folder / "runs" / record["run"], map(name_of_line, names)) is not None:
        file.unlink(missing_ok=True)


def forget_lost_merge(output, key):
    """Neither is a merge done whose table, or one of whose files, is gone."""
    record = output / ".workflow" / f"merged-{key}.json"
    merged = read_json(record)
    if merged is None:
        return
    table = Table(output)
    is_whole = (len(table.rows) == merged["meshes"] and all(row.is_settled() for row in table.rows.values()) and
                table.missing_file(output) is None)
    if not is_whole or not all((output / name).exists() for name in merged["beside"]):
        record.unlink(missing_ok=True)


def make_plan(config):
    """Writes the plan and returns its key."""
    check_folders(config)
    options, output = options_of(config), pathlib.Path(str(config["output"]))
    if int(config["chunk"]) < 1 or float(config["chunk_megabytes"]) <= 0:
        sys.exit("chunk and chunk_megabytes: at least one mesh must fit into a chunk")
    program = program_of(config)
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
            forget_lost_results(folder, keys[number], names)
            if not (folder / f"plan-{keys[number]}.json").exists():
                write_json(folder / f"plan-{keys[number]}.json", requested)
        key = digest_of(keys)
        forget_lost_merge(output, key)
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
