#!/usr/bin/env python3
"""Writes the binary seeds of the fuzz targets, and those of the medial PLY, into tests/fuzz/corpus.

  tests/fuzz/make_seeds.py

The other seeds there are text, written by hand.
"""
import base64
import json
import pathlib
import struct

CORPUS = pathlib.Path(__file__).parent / "corpus"
VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
MEDIAL_PROPERTIES = ["double x", "double y", "double z", "double radius", "float spoke_a_x", "float spoke_a_y",
                     "float spoke_a_z", "float spoke_b_x", "float spoke_b_y", "float spoke_b_z", "float object_angle",
                     "float flux", "int sheet"]


def write(name, data):
    (CORPUS / name).write_bytes(data)


def stl(declared, faces, vertices=VERTICES, title=b"binary", tail=b""):
    data = title.ljust(80, b"\0") + struct.pack("<I", declared)
    for face in faces:
        data += struct.pack("<12fH", 0, 0, 0, *(x for v in face for x in vertices[v]), 0)
    return data + tail


def ply(order, element_vertex, vertex_format, element_face, face_format, faces=FACES):
    name = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    data = f"ply\nformat {name} 1.0\nelement vertex 4\n{element_vertex}element face {len(faces)}\n{element_face}"
    data = data.encode() + b"end_header\n"
    for vertex in VERTICES:
        data += struct.pack(order + vertex_format, *vertex)
    for face in faces:
        data += struct.pack(order + face_format, 3, *face)
    return data


def strips(order, types, form, indices):
    """The tetrahedron as a list of triangle strips."""
    name = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    data = f"ply\nformat {name} 1.0\nelement vertex 4\nproperty char x\nproperty char y\nproperty char z\n"
    data += f"element tristrips 1\nproperty list {types} vertex_indices\nend_header\n"
    data = data.encode() + b"".join(struct.pack("3b", *vertex) for vertex in VERTICES)
    return data + struct.pack(f"{order}{form[0]}{len(indices)}{form[1]}", len(indices), *indices)


def medial(ascii_form, points, count=None, header=("grid_origin -1 -1 -1", "voxel_size 0.5")):
    lines = ["ply", "format " + ("ascii" if ascii_form else "binary_little_endian") + " 1.0", "comment medial-vk 1.0"]
    lines += ["comment " + line for line in header]
    lines += ["comment epsilon 0.005", "comment object_angle 0.6", "comment radius_threshold 0"]
    lines += [f"element vertex {len(points) if count is None else count}"]
    lines += ["property " + p for p in MEDIAL_PROPERTIES] + ["end_header"]
    data = ("\n".join(lines) + "\n").encode()
    for point in points:
        data += (" ".join(map(repr, point)) + "\n").encode() if ascii_form else struct.pack("<4d8fi", *point)
    return data


def scene(parts, vertices=VERTICES, faces=FACES):
    """What the process of assimp hands over (src/scene_files/scene_parts.cpp)."""
    data = b"medial-vk scene 1\n" + struct.pack("=Q", len(parts))
    for name in parts:
        data += struct.pack("=Q", len(name)) + name + struct.pack("=QQ", 1, 0) + struct.pack("=Q", len(vertices))
        data += b"".join(struct.pack("=3d", *vertex) for vertex in vertices) + struct.pack("=Q", len(faces))
        data += b"".join(struct.pack("=3I", *face) for face in faces)
    return data


def animation(path, values, interpolation="LINEAR", sparse=False):
    """A glTF of a tetrahedron with a skin of two joints and a shape; the second node or the weights of the shape move."""
    arrays = []

    def add(form, kind, component, numbers):
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[kind]
        arrays.append((struct.pack(f"<{len(numbers)}{form}", *numbers), kind, component, len(numbers) // width))
        return len(arrays) - 1

    position = add("f", "VEC3", 5126, [x for v in VERTICES for x in v])
    indices = add("H", "SCALAR", 5123, [v for face in FACES for v in face])
    joints = add("B", "VEC4", 5121, [0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0])
    weights = add("f", "VEC4", 5126, [1, 0, 0, 0, 0.5, 0.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0])
    identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    matrices = add("f", "MAT4", 5126, identity * 2)
    times = add("f", "SCALAR", 5126, [0, 1])
    kind = {"rotation": "VEC4", "weights": "SCALAR"}.get(path, "VEC3")
    output = add("f", kind, 5126, values)
    document = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": [],
                "scenes": [{"nodes": [0, 2]}],
                "nodes": [{"children": [1]}, {"translation": [0, 0, 1]}, {"mesh": 0, "skin": 0}],
                "skins": [{"joints": [0, 1], "inverseBindMatrices": matrices}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": position, "JOINTS_0": joints, "WEIGHTS_0": weights},
                                            "indices": indices, "targets": [{"POSITION": position}]}]}],
                "animations": [{"channels": [{"sampler": 0, "target": {"node": 2 if path == "weights" else 1, "path": path}}],
                                "samplers": [{"input": times, "output": output, "interpolation": interpolation}]}]}
    data = b""
    for number, (part, kind, component, count) in enumerate(arrays):
        document["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
        document["accessors"].append({"bufferView": number, "componentType": component, "count": count, "type": kind})
        data += part + b"\0" * (-len(part) % 4)
    if sparse:
        document["accessors"][position]["sparse"] = {"count": 1, "indices": {"bufferView": times, "componentType": 5125},
                                                     "values": {"bufferView": position}}
    return document, data


def animation_text(*arguments, **options):
    document, data = animation(*arguments, **options)
    document["buffers"] = [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}]
    return json.dumps(document, separators=(",", ":")).encode()


def animation_glb(*arguments):
    document, data = animation(*arguments)
    document["buffers"] = [{"byteLength": len(data)}]
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I", len(text)) + b"JSON" + text + struct.pack("<I", len(data)) + b"BIN\0" + data
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def npy(kind, columns, values):
    shape = f"({len(values) // columns}, {columns})" if columns > 1 else f"({len(values)},)"
    header = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}"
    header = header.ljust(-(len(header) + 11) % 64 + len(header)) + "\n"
    code = {"<f8": "d", "<f4": "f"}[kind]
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + struct.pack(f"<{len(values)}{code}", *values)


def main():
    (CORPUS / "read_ball_lists").mkdir(exist_ok=True)
    balls = npy("<f8", 3, [0, 0, 0, 1, 2, 3]) + npy("<f8", 1, [1, 0.5])
    spokes = npy("<f4", 3, [0, 0, 1, 0.6, 0, 0.8])
    write("read_ball_lists/arrays", balls)
    write("read_ball_lists/arrays_with_spokes", balls + spokes + spokes)
    write("read_ball_lists/arrays_with_a_spoke", balls + spokes)
    (CORPUS / "read_animation").mkdir(exist_ok=True)
    turn = [0, 0, 0, 1, 0.6, 0, 0, 0.8]
    write("read_animation/rotation", animation_text("rotation", turn))
    write("read_animation/glb", animation_glb("rotation", turn))
    write("read_animation/glb_cut", animation_glb("rotation", turn)[:-9])
    write("read_animation/translation", animation_text("translation", [0, 0, 1, 0, 0, 2], "STEP"))
    write("read_animation/weights", animation_text("weights", [0, 1, 2, 3, 4, 5], "CUBICSPLINE"))
    write("read_animation/sparse", animation_text("scale", [1, 1, 1, 2, 2, 2], sparse=True))
    write("read_animation/still", animation_text("scale", [1] * 6))
    write("read_animation/infinite", animation_text("scale", [1, 1, 1, 3e38, 3e38, float("inf")]))
    write("read_animation/none", b'{"asset":{"version":"2.0"}}')
    write("read_animation/arrays", struct.pack("<9f12B12f3f32f", *(x for v in VERTICES[1:] for x in v), *[0, 1, 0, 0] * 3,
                                               *[0.5, 0.5, 0, 0.1] * 3, 0, 1, 2, *[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] * 2))
    (CORPUS / "decode_scene").mkdir(exist_ok=True)
    write("decode_scene/one", scene([b"part"]))
    write("decode_scene/two", scene([b"", b"\xff"]))
    write("decode_scene/none", scene([]))
    write("decode_scene/bad_index", scene([b"a"], faces=[(0, 1, 4)]))
    write("decode_scene/infinite", scene([b"a"], vertices=[(0, 0, float("inf"))]))
    write("decode_scene/cut", scene([b"a"])[:-7])
    message = b"input: assimp cannot read it"
    write("decode_scene/error", b"medial-vk scene 1\n" + struct.pack("=QQQ", 2**64 - 1, 2, len(message)) + message)
    write("decode_scene/glb", b"glTF\2\0\0\0")
    write("decode_scene/gltf", b' {"asset":{}}')
    write("decode_scene/collada", b"<?xml?><COLLADA/>")
    write("read_stl/binary", stl(4, FACES))
    write("read_stl/binary_solid", stl(4, FACES, title=b"solid facet endsolid"))
    write("read_stl/binary_nothing", stl(0, []))
    write("read_stl/binary_longer", stl(1, FACES))
    write("read_stl/binary_cut", stl(4, FACES)[:200])
    write("read_stl/binary_lies", stl(0xFFFFFFFF, FACES[:1]))
    write("read_stl/binary_infinite", stl(1, FACES[:1], [(float("inf"), 0, 0)] * 4))
    write("read_stl/binary_no_header", b"\0" * 40)

    xyz = "property {0} x\nproperty {0} y\nproperty {0} z\n"
    indices = "property list {0} {1} vertex_indices\n"
    for order, name in (("<", "little"), (">", "big")):
        write(f"read_ply/{name}_float", ply(order, xyz.format("float"), "3f", indices.format("uchar", "int"), "B3i"))
        write(f"read_ply/{name}_double", ply(order, xyz.format("double"), "3d", indices.format("int", "uint"), "i3I"))
        write(f"read_ply/{name}_short", ply(order, xyz.format("short"), "3h", indices.format("ushort", "ushort"), "H3H"))
        write(f"read_ply/{name}_char", ply(order, xyz.format("char"), "3b", indices.format("char", "uchar"), "b3B"))
        write(f"read_ply/{name}_long", ply(order, xyz.format("int64"), "3q", indices.format("uint64", "int64"), "Q3q"))
        write(f"read_ply/{name}_float_index",
              ply(order, xyz.format("uint64"), "3Q", indices.format("uint", "double"), "I3d"))
        write(f"read_ply/{name}_bad_index",
              ply(order, xyz.format("float"), "3f", indices.format("uchar", "int"), "B3i", [(0, 1, 4)]))
    whole = [0, 2, 1, 3, -1, 3, 0, 2, 2, 3]
    write("read_ply/little_strips", strips("<", "int int", "ii", whole))
    write("read_ply/big_strips", strips(">", "uchar short", "Bh", whole))
    write("read_ply/float_strips", strips("<", "ushort float", "Hf", whole))
    write("read_ply/strips_bad_index", strips("<", "uchar char", "Bb", [-1, 0, 1, 2, -2]))
    extras = xyz.format("float") + "property uchar red\nproperty list uchar short more\n"
    write("read_ply/little_extras", ply("<", extras, "3fxx", indices.format("uchar", "int"), "B3i"))
    write("read_ply/little_cut", ply("<", xyz.format("float"), "3f", indices.format("uchar", "int"), "B3i")[:-5])
    write("prepare_mesh/stl_binary", stl(4, FACES))
    write("prepare_mesh/ply_binary", ply("<", xyz.format("float"), "3f", indices.format("uchar", "int"), "B3i"))

    points = [(0.25, 0.25, 0.25, 0.125, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.75, -0.25, -1),
              (1.25, 0.25, 3.25, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 1.5, -0.5, 7)]
    for ascii_form, name in ((False, "binary"), (True, "text")):
        write(f"read_medial_ply/{name}", medial(ascii_form, points))
        write(f"read_medial_ply/{name}_empty", medial(ascii_form, []))
        write(f"read_medial_ply/{name}_cut", medial(ascii_form, points)[:-9])
        write(f"read_medial_ply/{name}_longer", medial(ascii_form, points, 1))
        write(f"read_medial_ply/{name}_lies", medial(ascii_form, points, 2**40))
        write(f"read_medial_ply/{name}_outside", medial(ascii_form, [(-2.0,) + points[0][1:]]))
    write("read_medial_ply/no_grid", medial(True, points, header=()))
    write("read_medial_ply/bad_grid", medial(True, points, header=("grid_origin 0 0", "voxel_size -1")))
    write("read_medial_ply/foreign_comment", medial(True, points, header=("hello", "voxel_size 1e300")))


if __name__ == "__main__":
    main()
