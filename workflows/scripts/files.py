"""Files of the workflow: whole or not at all, and names of any bytes."""
import json
import os
import pathlib
import secrets


def write_whole(path, data):
    """Writes a file under a name of its own and renames it: a reader, on any machine, sees the old or the new one."""
    path = pathlib.Path(path)
    temporary = path.with_name(f".{secrets.token_hex(8)}.part")
    try:
        with open(temporary, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def write_json(path, value):
    write_whole(path, (json.dumps(value, indent=1) + "\n").encode())


def read_json(path):
    """None if there is no such file, or it is none of ours."""
    try:
        with open(path, "rb") as file:
            return json.load(file)
    except (OSError, ValueError):
        return None


def bytes_of(name):
    return os.fsencode(name)


def text_of(data):
    return os.fsdecode(data)
