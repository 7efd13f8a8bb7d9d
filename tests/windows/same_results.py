"""Whether two files, or two texts, tell the same where some last digits may differ (docs/windows.md): for compare_commands.py.

Each function returns None, or what is wrong.
"""
import base64
import json
import math
import re
import struct
import zlib

# A function of the C runtime differs by 14 units of the last digit at most (docs/windows.md, "Same bytes, and their limits"),
# and a volume or a thickness is made of four values of functions at most. Models have a size of about 1.
MOST_UNITS = 4 * 14 + 8  # eight for the roundings of products and sums of these values, which follow them
NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
BASE64 = re.compile(rb"[A-Za-z0-9+/]{40,}=*")
PLY_TYPES = {"double": "d", "float": "f", "int": "i", "uint": "I", "uchar": "B"}


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(inner) for key, inner in value.items() if key != "seconds"}
    return [without_times(inner) for inner in value] if isinstance(value, list) else value


def plain(name, data):
    """JSON without its times, in one form; other files as they are."""
    return json.dumps(without_times(json.loads(data)), indent=0).encode() if name.endswith(".json") else data


def form_of(data):
    """Without numbers and binary parts."""
    return NUMBER.sub(b"#", BASE64.sub(b"#", data))


def apart(one, other):
    at = next((i for i, (x, y) in enumerate(zip(one, other)) if x != y), min(len(one), len(other)))
    return f"from byte {at}: {one[max(0, at - 20):at + 30]!r} and {other[max(0, at - 20):at + 30]!r}"


def same_form(one, other):
    one, other = form_of(one), form_of(other)
    return None if one == other else f"texts differ in more than numbers, {apart(one, other)}"


# ---- Numbers that differ by roundings.
def numbers_of_vtp(data):
    numbers = []
    for kind, text in re.findall(rb'<DataArray type="(\w+)"[^>]*format="binary">([^<]*)<', data):
        values = base64.b64decode(text)[8:]
        code = {b"Float64": "d", b"Float32": "f", b"Int64": "q", b"Int32": "i", b"UInt8": "B"}[kind]
        numbers += struct.unpack(f"<{len(values) // struct.calcsize(code)}{code}", values)
    return numbers


def read_ply(data):
    """The header, the vertices as tuples, and the rest."""
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode()
    count = int(re.search(r"element vertex (\d+)", header).group(1))
    properties = header.split("element vertex")[1].split("element")[0]
    layout = "<" + "".join(PLY_TYPES[kind] for kind in re.findall(r"property (\w+) \w+", properties))
    size = struct.calcsize(layout)
    return header, [struct.unpack_from(layout, data, end + i * size) for i in range(count)], data[end + count * size:]


def numbers_and_rest(name, data):
    if name.endswith(".vtp"):
        return numbers_of_vtp(data), form_of(data)
    if name.endswith(".ply"):
        header, vertices, rest = read_ply(data)
        return [number for vertex in vertices for number in vertex], header.encode() + rest
    text = plain(name, data)
    return [float(number) for number in NUMBER.findall(text)], form_of(text)


def units_between(a, b):
    if a == b or (math.isnan(a) and math.isnan(b)):
        return 0
    return abs(a - b) / (2.0 ** -52 * max(abs(a), abs(b), 1)) if math.isfinite(a) and math.isfinite(b) else math.inf


def same_but_for_roundings(name, one, other):
    (numbers, rest), (others, other_rest) = numbers_and_rest(name, one), numbers_and_rest(name, other)
    if rest != other_rest:
        return f"more than numbers differs, {apart(rest, other_rest)}"
    if len(numbers) != len(others):
        return f"{len(numbers)} and {len(others)} numbers"
    units = max(map(units_between, numbers, others), default=0)
    return None if units <= MOST_UNITS else f"numbers differ by {units:.3g} units of the last digit, more than {MOST_UNITS}"


# ---- Choices between results that are equally good.
def faces_and_edges(header, rest):
    """Triangles as sets of their vertices, and edges with what the file says of them."""
    faces, edges = (int(re.search(rf"element {element} (\d+)", header).group(1)) for element in ("face", "edge"))
    if len(rest) != 13 * faces + 10 * edges:
        raise ValueError("other elements than triangles and edges with two marks")
    return ({tuple(sorted(struct.unpack_from("<3i", rest, 13 * i + 1))) for i in range(faces)},
            {struct.unpack_from("<iiBB", rest, 13 * faces + 10 * i) for i in range(edges)})


def same_surface(_, one, other):
    """The vertices are the same, and triangles that one file alone has close with those of the other: they lie between the
    same edges, as the two pairs of triangles of four points on a circle do. Edges that one file alone has are theirs."""
    (header, vertices, rest), (other_header, other_vertices, other_rest) = read_ply(one), read_ply(other)
    if (header, vertices) != (other_header, other_vertices):
        return "other vertices, or another number of triangles or edges"
    (faces, edges), (other_faces, other_edges) = faces_and_edges(header, rest), faces_and_edges(header, other_rest)
    outline, diagonals = set(), set()
    for a, b, c in faces ^ other_faces:
        outline ^= {(a, b), (b, c), (a, c)}
        diagonals |= {(a, b), (b, c), (a, c)}
    if outline:
        return f"other triangles, whose edges {sorted(outline)[:3]} are edges of the surface in one file alone"
    strange = {edge for edge in edges ^ other_edges if tuple(sorted(edge[:2])) not in diagonals}
    return f"other edges: {sorted(strange)[:3]}" if strange else None


def rows_of_png(data):
    """Its size and type, and the number of bytes of its pixels."""
    at, header, pixels = 8, b"", b""
    while at < len(data):
        length, = struct.unpack_from(">I", data, at)
        kind, content = data[at + 4:at + 8], data[at + 8:at + 8 + length]
        header, pixels = (content, pixels) if kind == b"IHDR" else (header, pixels + content * (kind == b"IDAT"))
        at += length + 12
    return header, len(zlib.decompress(pixels))


def same_but_for_choices(name, one, other):
    """Two fits of as many balls: the files have the same form, and finite numbers. What --check, or the proof of the contract,
    says of them is in the exit code."""
    if name.endswith(".png"):
        return None if rows_of_png(one) == rows_of_png(other) else "pictures of other sizes"
    if name.endswith(".glb"):
        if any(struct.unpack_from("<4sII", data) != (b"glTF", 2, len(data)) for data in (one, other)):
            return "no GLB, or one of another length than it says"
        one, other = (data[20:20 + struct.unpack_from("<I", data, 12)[0]] for data in (one, other))
        return same_form(one.rstrip(), other.rstrip())
    return same_form(plain(name, one), plain(name, other))
