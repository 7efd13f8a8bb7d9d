"""The cases of read_back.py for glTF: against the specification, and by assimp."""
import json
import struct

import numpy as np

SINGLE = float(np.finfo(np.float32).eps)


def parse_glb(path):
    """Reads a GLB by Section 4 of the specification, for parts that no reader of Debian supports."""
    data = path.read_bytes()
    magic, version, length, json_length, json_type = struct.unpack_from("<4sIII4s", data)
    assert (magic, version, length, json_type) == (b"glTF", 2, len(data), b"JSON")
    document = json.loads(data[20:20 + json_length])
    buffer_length, buffer_type = struct.unpack_from("<I4s", data, 20 + json_length)
    buffer = data[28 + json_length:]
    assert buffer_type == b"BIN\0" and buffer_length == len(buffer) == document["buffers"][0]["byteLength"]
    return document, buffer


def accessor(document, buffer, index):
    description = document["accessors"][index]
    view = document["bufferViews"][description["bufferView"]]
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[description["type"]]
    dtype = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}[description["componentType"]]
    offset = view.get("byteOffset", 0) + description.get("byteOffset", 0)
    assert "byteStride" not in view or view["byteStride"] == width * np.dtype(dtype).itemsize
    return np.frombuffer(buffer, dtype, description["count"] * width, offset).reshape(-1, width)


def expect_glb_balls(run, indices, middle, centres, radii):
    """Centres are relative to the middle, in single precision, and the drawn ball lies inside the exact one."""
    assert sorted(indices) == list(range(len(run.reference["radius"])))
    exact, exact_radius = run.centres()[indices], run.reference["radius"][indices]
    extent = np.abs(exact - middle).max()
    assert extent < 2, "positions are relative to the middle of all points"
    distance = np.linalg.norm(middle + np.float64(centres) - exact, axis=1)
    assert distance.max() <= SINGLE * extent, distance.max()
    missing = exact_radius - np.float64(radii)
    assert missing.min() >= 0 and missing.max() <= 2 * SINGLE * extent, (missing.min(), missing.max())
    assert np.all(distance <= missing + 1e-13)


def scene_of(document):
    root = document["nodes"][document["scenes"][document["scene"]]["nodes"][0]]
    assert root["children"] == list(range(1, len(document["nodes"])))
    return np.array(root["translation"]), [document["nodes"][i] for i in root["children"]]


def expect_unit_ball(points):
    lengths = np.linalg.norm(np.float64(points), axis=1)
    assert lengths.max() <= 1 and lengths.min() > 1 - 4 * SINGLE, (lengths.min(), lengths.max())


def expect_brighter_with_angle(angles, colours):
    """Expects the colours of Viridis; `colours` are linear."""
    light = (colours @ (0.2126, 0.7152, 0.0722))[np.argsort(angles)]
    light /= light.max()
    assert np.diff(light).min() >= -0.01 and light.min() < 0.5 * light.max(), (np.diff(light).min(), light.min())


def glb(run):
    document, buffer = parse_glb(run.make("balls.glb"))
    middle, nodes = scene_of(document)
    expect_glb_balls(run, [int(node["name"]) for node in nodes], middle, [node["translation"] for node in nodes],
                     [node["scale"][0] for node in nodes])
    for i, node in enumerate(nodes):
        assert np.float32(node["extras"]["object_angle"]) == run.reference["object_angle"][i]
        assert node["extras"]["sheet"] == run.reference["sheet"][i]
    assert "extensionsUsed" not in document
    for mesh in document["meshes"]:
        expect_unit_ball(accessor(document, buffer, mesh["primitives"][0]["attributes"]["POSITION"]))


def glb_nodes_by_assimp(run):
    document, buffer = run.through_assimp(run.make("balls.glb"))
    named = {node["name"]: node for node in document["nodes"]}
    nodes = [node for node in document["nodes"] if "mesh" in node]
    matrices = np.array([node["matrix"] for node in nodes], dtype=np.float32).reshape(-1, 4, 4)  # by columns
    scales = matrices[:, [0, 1, 2], [0, 1, 2]]
    assert np.array_equal(scales[:, 0], scales[:, 1]) and np.array_equal(scales[:, 0], scales[:, 2])
    root = np.array(named["medial spheres"]["matrix"])[12:15]
    expect_glb_balls(run, [int(node["name"]) for node in nodes], root, matrices[:, 3, :3], scales[:, 0])
    assert document["meshes"], "colours"
    for mesh in document["meshes"]:
        primitive = mesh["primitives"][0]
        expect_unit_ball(accessor(document, buffer, primitive["attributes"]["POSITION"]))
        assert document["accessors"][primitive["indices"]]["count"] == 3 * 320
    materials = [document["materials"][mesh["primitives"][0]["material"]] for mesh in document["meshes"]]
    colours = [material["pbrMetallicRoughness"]["baseColorFactor"][:3] for material in materials]
    expect_brighter_with_angle(run.reference["object_angle"][[int(node["name"]) for node in nodes]],
                               np.array([colours[node["mesh"]] for node in nodes]))


def glb_gpu_instancing(run):
    document, buffer = parse_glb(run.make("instances.glb", "--gpu-instancing"))
    assert document["extensionsRequired"] == ["EXT_mesh_gpu_instancing"] == document["extensionsUsed"]
    middle, nodes = scene_of(document)
    centres, sizes = [], []
    for node in nodes:
        attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
        centres.append(accessor(document, buffer, attributes["TRANSLATION"]))
        sizes.append(accessor(document, buffer, attributes["SCALE"]))
        assert len(centres[-1]) == len(sizes[-1]) > 0
    centres, sizes = np.concatenate(centres), np.concatenate(sizes)
    assert len(centres) == len(run.reference["radius"]), "an instance for each point"
    assert np.array_equal(sizes[:, 0], sizes[:, 1]) and np.array_equal(sizes[:, 0], sizes[:, 2])
    found = np.linalg.norm(run.centres()[None] - (middle + np.float64(centres))[:, None], axis=2).argmin(axis=1)
    expect_glb_balls(run, found.tolist(), middle, centres, sizes[:, 0])


def glb_mesh_by_assimp(run):
    path = run.make("mesh.glb", "--mesh-spheres", "--sphere-detail", "1")
    middle, nodes = scene_of(parse_glb(path)[0])
    assert len(nodes) == 1
    document, buffer = run.through_assimp(path)
    attributes = document["meshes"][0]["primitives"][0]["attributes"]
    n = len(run.reference["radius"])
    balls = middle + np.float64(accessor(document, buffer, attributes["POSITION"])).reshape(n, 42, 3)
    off = np.linalg.norm(balls - run.centres()[:, None, :], axis=2) - run.reference["radius"][:, None]
    assert off.max() <= 0 and off.min() > -8 * SINGLE, (off.min(), off.max())
    normals = accessor(document, buffer, attributes["NORMAL"])
    assert np.abs(np.linalg.norm(normals, axis=1) - 1).max() < 4 * SINGLE
    colours = accessor(document, buffer, attributes["COLOR_0"]).reshape(n, 42, -1)
    assert np.array_equal(colours, np.repeat(colours[:, :1], 42, axis=1)), "a ball has one colour"
    expect_brighter_with_angle(run.reference["object_angle"], np.float64(colours[:, 0, :3]))
