#!/usr/bin/env python3
"""Writes the medial points of one solid in one format, opens the file with an independent reader, and compares.

    read_back.py CASE MEDIAL_VK ASSIMP

The reference is the medial PLY of the same run, since the same options give the same points. The exit code is 77 if a
reader is missing.
"""
import csv
import itertools
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

try:
    import meshio
    import numpy as np
except ImportError as error:
    print(f"SKIPPED: {error}; Debian has it in python3-numpy and python3-meshio")
    sys.exit(77)

import boundary_cases  # noqa: E402
from glb_cases import glb, glb_gpu_instancing, glb_mesh_by_assimp, glb_nodes_by_assimp  # noqa: E402

COLUMNS = ["x", "y", "z", "radius"] + [f"spoke_{s}_{a}" for s in "ab" for a in "xyz"] + ["object_angle", "flux", "sheet"]


class Run:
    """The tool in a folder of its own."""

    def __init__(self, tool, assimp, folder):
        self.tool, self.assimp, self.folder = tool, assimp, pathlib.Path(folder)
        self.write_solid()
        self.reference = self.read_ply(self.make("reference.ply"))
        self.header = self.read_comments("reference.ply")

    def write_solid(self):
        """A wedge of a prism, far from the origin, so that the error of single precision is visible."""
        corners = [(0, 0), (2, 0), (2, 0.6), (0.7, 0.7), (0.5, 2), (0, 2)]
        offset = (1000.25, -77.5, 3.125)
        lines = []
        for z in (0, 0.8):
            lines += [f"v {x + offset[0]} {y + offset[1]} {z + offset[2]}" for x, y in corners]
        n = len(corners)
        lines.append("f " + " ".join(str(n - i) for i in range(n)))
        lines.append("f " + " ".join(str(n + 1 + i) for i in range(n)))
        for i in range(n):
            j = (i + 1) % n
            lines.append(f"f {i + 1} {j + 1} {n + j + 1} {n + i + 1}")
        (self.folder / "solid.obj").write_text("\n".join(lines) + "\n")

    def make(self, name, *options):
        subprocess.run([self.tool, "solid.obj", "-q", "--backend", "cpu", "--resolution", "16", "-o", name, *options],
                       cwd=self.folder, check=True)
        return self.folder / name

    def read_ply(self, path):
        mesh = meshio.read(path)
        columns = {name: np.asarray(values) for name, values in mesh.point_data.items()}
        columns.update(zip("xyz", mesh.points.T))
        assert mesh.points.dtype == np.float64, mesh.points.dtype
        assert len(mesh.points) > 100, len(mesh.points)
        return columns

    def read_comments(self, name):
        """The comments, read from the header, since meshio drops them."""
        text = (self.folder / name).read_bytes().split(b"end_header\n")[0].decode()
        found = dict(re.findall(r"^comment (\S+) (.+)$", text, re.MULTILINE))
        return {key: np.array([float(word) for word in value.split()]) for key, value in found.items()
                if key != "medial-vk"} | {"version": found["medial-vk"]}

    def centres(self):
        return np.stack([self.reference[axis] for axis in "xyz"], axis=1)

    def voxels(self):
        return np.floor((self.centres() - self.header["grid_origin"]) / self.header["voxel_size"]).astype(np.int64)

    def through_assimp(self, path):
        """The result of Assimp, written again by it: a glTF document and its buffer."""
        out = self.folder / "assimp.gltf"
        try:
            subprocess.run([self.assimp, "export", str(path), str(out)], check=True, stdout=subprocess.DEVNULL)
        except FileNotFoundError:
            print("SKIPPED: no assimp; Debian has it in assimp-utils")
            sys.exit(77)
        document = json.loads(out.read_text())
        return document, (self.folder / document["buffers"][0]["uri"]).read_bytes()


def expect_same(run, columns):
    """Compares all columns by name, bit by bit."""
    assert sorted(columns) == sorted(COLUMNS), columns.keys()
    for name in COLUMNS:
        wanted = run.reference[name]
        assert columns[name].dtype == wanted.dtype, (name, columns[name].dtype, wanted.dtype)
        assert np.array_equal(columns[name], wanted), name


def by_column(run, words):
    """Lists of numbers by name as arrays of the types that the PLY has."""
    return {name: np.array(words[name], dtype=run.reference[name].dtype) for name in COLUMNS}


def expect_header(run, values):
    assert values["version"] == run.header["version"]
    for name, comment in [("grid_origin", "grid_origin"), ("voxel_size", "voxel_size"), ("epsilon", "epsilon"),
                          ("object_angle_threshold", "object_angle"), ("radius_threshold", "radius_threshold")]:
        assert np.array_equal(np.ravel(values[name]), run.header[comment]), name


def ply(run):
    types = {"x": "f8", "y": "f8", "z": "f8", "radius": "f8", "sheet": "i4"}
    assert sorted(run.reference) == sorted(COLUMNS)
    for name, values in run.reference.items():
        assert values.dtype == np.dtype(types.get(name, "f4")), (name, values.dtype)
    assert np.all(run.reference["radius"] > 0)
    assert len(np.unique(run.voxels(), axis=0)) == len(run.voxels())


def ply_text(run):
    expect_same(run, run.read_ply(run.make("text.ply", "--ascii")))


def csv_table(run):
    with open(run.make("table.csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    expect_same(run, by_column(run, {name: [float(row[name]) for row in rows] for name in COLUMNS}))


def expect_marks(run, seam, rim):
    """Computes seams again from the neighbouring voxels; some points, but not all, must be at rims."""
    assert seam.dtype == rim.dtype == bool
    sheets = {tuple(voxel): sheet for voxel, sheet in zip(run.voxels().tolist(), run.reference["sheet"].tolist())}
    around = list(itertools.product((-1, 0, 1), repeat=3))
    expected = [any(sheets.get((x + i, y + j, z + k), sheet) != sheet for i, j, k in around)
                for (x, y, z), sheet in sheets.items()]
    assert np.array_equal(seam, expected) and 0 < np.mean(seam) < 1 and 0 < np.mean(rim) < 1


def npz(run):
    arrays = np.load(run.make("points.npz"), allow_pickle=False)
    columns = {name: arrays[name] for name in ("radius", "object_angle", "flux", "sheet")}
    for name, prefix in [("centre", ""), ("spoke_a", "spoke_a_"), ("spoke_b", "spoke_b_")]:
        assert arrays[name].shape == (len(columns["radius"]), 3)
        columns |= {prefix + axis: arrays[name][:, i] for i, axis in enumerate("xyz")}
    expect_same(run, columns)
    assert arrays["voxel"].dtype == np.uint32 and np.array_equal(arrays["voxel"], run.voxels())
    expect_marks(run, arrays["seam"], arrays["rim"])
    expect_header(run, {name: arrays[name] if name != "version" else str(arrays[name]) for name in arrays})


def json_points(run):
    document = json.loads(run.make("points.json").read_text())
    points = document["points"]
    words = {name: [point[name] for point in points] for name in ("radius", "object_angle", "flux", "sheet")}
    for name, prefix in [("centre", ""), ("spoke_a", "spoke_a_"), ("spoke_b", "spoke_b_")]:
        words |= {prefix + axis: [point[name][i] for point in points] for i, axis in enumerate("xyz")}
    expect_same(run, by_column(run, words))
    assert np.array_equal([point["voxel"] for point in points], run.voxels())
    expect_marks(run, np.array([point["seam"] for point in points]), np.array([point["rim"] for point in points]))
    assert (document["format"], document["program"]) == (1, "medial-vk")
    expect_header(run, document)


def mesh_ply(run, *options):
    path = run.make("balls.ply", "--mesh-spheres", *options)
    mesh = meshio.read(path)
    detail = int(run.read_comments("balls.ply")["sphere_detail"][0])
    vertices, triangles = 10 * 4**detail + 2, 20 * 4**detail
    n = len(run.reference["radius"])
    assert detail == 2 and mesh.points.shape == (n * vertices, 3), (detail, mesh.points.shape)
    expect_inside(run, mesh.points.reshape(n, vertices, 3))
    for name in ("radius", "object_angle", "sheet"):
        values = np.asarray(mesh.point_data[name]).reshape(n, vertices)
        assert np.array_equal(values, np.repeat(run.reference[name].astype(values.dtype)[:, None], vertices, 1)), name
    assert all(name in mesh.point_data for name in ("red", "green", "blue"))
    expect_closed_balls(mesh.cells_dict["triangle"].reshape(n, triangles, 3), vertices)
    expect_volumes(run, mesh.points, mesh.cells_dict["triangle"], detail)


def expect_inside(run, balls):
    """In exact arithmetic no vertex lies outside its ball; in doubles each lies on its surface."""
    off = np.linalg.norm(balls - run.centres()[:, None, :], axis=2) - run.reference["radius"][:, None]
    assert np.abs(off).max() < 1e-11, np.abs(off).max()
    for ball, centre, radius in zip(balls[::20], run.centres()[::20], run.reference["radius"][::20]):
        for vertex in ball:
            squared = sum((Fraction(p) - Fraction(c))**2 for p, c in zip(vertex.tolist(), centre.tolist()))
            assert squared <= Fraction(float(radius))**2


def expect_closed_balls(triangles, vertices):
    for i, ball in enumerate(triangles):
        assert ball.min() == i * vertices and ball.max() == (i + 1) * vertices - 1
    edges = triangles[0][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    assert set(map(tuple, edges)) == set(map(tuple, edges[:, ::-1])) and len(edges) == len(set(map(tuple, edges)))


def expect_volumes(run, points, triangles, detail):
    """Triangles face outwards, and the solid misses little of the ball."""
    a, b, c = (points[triangles[:, i]].reshape(len(run.reference["radius"]), -1, 3) - run.centres()[:, None, :]
               for i in range(3))
    volumes = np.einsum("ijk,ijk->i", a, np.cross(b, c)) / 6
    share = volumes / (4 / 3 * math.pi * run.reference["radius"]**3)
    assert np.all((share > 1 - 0.6 / 4**detail) & (share < 1)), (share.min(), share.max())


def mesh_ply_text(run):
    mesh_ply(run, "--ascii")


def without_edges(run, name):
    """meshio refuses an element `edge`; as the last one it is cut off here, and decoded from the text of its header."""
    header, body = (run.folder / name).read_bytes().split(b"end_header\n", 1)
    count = int(re.search(rb"element edge (\d+)\n", header)[1])
    start = header.index(b"element edge")
    assert header[start:].count(b"element") == 1, "the last element"
    if b"format ascii" in header:
        lines = body.splitlines(keepends=True)
        edges = np.array([line.split() for line in lines[-count:]], dtype=np.int64)
        body = b"".join(lines[:-count])
    else:
        row = np.dtype([("ends", "<i4", 2), ("seam", "u1"), ("rim", "u1")])
        cut = len(body) - count * row.itemsize
        found = np.frombuffer(body[cut:], dtype=row)
        edges = np.column_stack([found["ends"], found["seam"], found["rim"]]).astype(np.int64)
        body = body[:cut]
    (run.folder / "faces.ply").write_bytes(header[:start] + b"end_header\n" + body)
    return meshio.read(run.folder / "faces.ply"), edges


def expect_medial_mesh(run, edges, triangles):
    """Edges join neighbouring voxels, with few exceptions; the sides of triangles are edges."""
    ends = np.concatenate([edges, triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [0, 2]]])
    assert len(triangles) > 50 and ends.min() >= 0 and ends.max() < len(run.reference["radius"])
    apart = np.abs(run.voxels()[ends[:, 0]] - run.voxels()[ends[:, 1]]).max(axis=1)
    assert apart.min() == 1 and np.mean(apart == 1) > 0.9, np.bincount(apart)
    assert {tuple(sorted(pair)) for pair in ends.tolist()} == {tuple(pair) for pair in edges.tolist()}
    assert len(np.unique(edges, axis=0)) == len(edges) and len(np.unique(triangles, axis=0)) == len(triangles)


def medial_mesh_ply(run, *options):
    run.make("other.ply", "--medial-mesh", "mesh.ply", *options)
    mesh, edges = without_edges(run, "mesh.ply")
    assert np.array_equal(mesh.points, run.centres())
    for name in ("radius", "sheet"):
        assert np.array_equal(mesh.point_data[name], run.reference[name]), name
    triangles = mesh.cells_dict["triangle"]
    expect_medial_mesh(run, edges[:, :2], triangles)
    sheets = run.reference["sheet"]
    across = sheets[edges[:, 0]] != sheets[edges[:, 1]]
    assert np.any(across) and np.all(edges[across, 2] == 1)
    counts = {}
    for t in triangles.tolist():
        for a, b in ((0, 1), (1, 2), (0, 2)):
            side = tuple(sorted((t[a], t[b])))
            counts[side] = counts.get(side, 0) + 1
    assert np.array_equal(edges[:, 3] == 1, [counts.get(tuple(pair), 0) == 1 for pair in edges[:, :2].tolist()])
    assert set(np.unique(mesh.point_data["seam"])) == set(np.unique(mesh.point_data["rim"])) == {0, 1}


def medial_mesh_ply_text(run):
    medial_mesh_ply(run, "--ascii")


def medial_mesh_ma(run):
    run.make("other.ply", "--medial-mesh", "mesh.ma")
    lines = [line.split() for line in (run.folder / "mesh.ma").read_text().splitlines()]
    vertices, edges, faces = (int(word) for word in lines[0])
    assert len(lines) == 1 + vertices + edges + faces and vertices == len(run.reference["radius"])
    parts = {kind: [line[1:] for line in lines[1:] if line[0] == kind] for kind in "vef"}
    assert [len(parts[kind]) for kind in "vef"] == [vertices, edges, faces]
    values = np.array(parts["v"], dtype=np.float64)
    assert np.array_equal(values[:, :3], run.centres()) and np.array_equal(values[:, 3], run.reference["radius"])
    expect_medial_mesh(run, np.array(parts["e"], dtype=np.int64), np.array(parts["f"], dtype=np.int64))


CASES = {"ply": ply, "ply_text": ply_text, "csv": csv_table, "npz": npz, "json": json_points, "mesh_ply": mesh_ply,
         "mesh_ply_text": mesh_ply_text, "glb": glb, "glb_nodes_by_assimp": glb_nodes_by_assimp,
         "glb_gpu_instancing": glb_gpu_instancing, "glb_mesh_by_assimp": glb_mesh_by_assimp,
         "medial_mesh_ply": medial_mesh_ply, "medial_mesh_ply_text": medial_mesh_ply_text,
         "medial_mesh_ma": medial_mesh_ma, **boundary_cases.CASES}


def main():
    case, tool, assimp = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        CASES[case](Run(tool, assimp, folder))
    print(f"{case}: ok")


if __name__ == "__main__":
    main()
