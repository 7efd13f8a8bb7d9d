"""The cases of read_back.py for --boundary: the same numbers in every format."""
import base64
import csv
import json
import math
import subprocess
import sys
import xml.etree.ElementTree

import meshio
import numpy as np

from glb_cases import accessor, parse_glb

SCALARS = ["thickness_lower", "thickness_upper", "object_angle", "thickness_kind", "kappa_1", "kappa_2", "curvature_error",
           "curvature_state", "sheet"]
VECTORS = ["direction_1", "direction_2"]
WHOLE = ["thickness_kind", "curvature_state", "sheet"]
KINDS = ["none", "facets", "crease", "corner", "wall"]
OF_BALLS = ["ball_centre", "ball_radius", "contact_a", "contact_b"]


def ellipsoid(rings=14, around=20):
    """Half axes 1, 0.7 and 0.4, off the origin: its sheet has curvatures on both sides."""
    rows = [[(math.sin(u) * math.cos(v), 0.7 * math.sin(u) * math.sin(v), 0.4 * math.cos(u))
             for v in np.linspace(0, 2 * math.pi, around, endpoint=False)] for u in np.linspace(0, math.pi, rings)]
    vertices = [(0, 0, 0.4)] + [vertex for row in rows[1:-1] for vertex in row] + [(0, 0, -0.4)]
    lines = [f"v {x + 10.25} {y - 3.5} {z}" for x, y, z in vertices]
    number = lambda row, i: 2 + (row - 1) * around + i % around
    for i in range(around):
        lines += [f"f 1 {number(1, i)} {number(1, i + 1)}",
                  f"f {len(vertices)} {number(rings - 2, i + 1)} {number(rings - 2, i)}"]
        for row in range(1, rings - 2):
            lines.append(f"f {number(row, i)} {number(row + 1, i)} {number(row + 1, i + 1)} {number(row, i + 1)}")
    return "\n".join(lines) + "\n"


def boundary_of(run, name, *options):
    (run.folder / "ellipsoid.obj").write_text(ellipsoid())
    subprocess.run([run.tool, "ellipsoid.obj", "-q", "--backend", "cpu", "--resolution", "24", "--boundary", name,
                    "--boundary-edge", "0.125", *options], cwd=run.folder, check=True)
    return run.folder / name


def fields_of_ply(path):
    """Points, triangles and fields, as meshio reads them."""
    mesh = meshio.read(path)
    data = {name: np.asarray(mesh.point_data[name]) for name in SCALARS}
    for name in VECTORS:
        data[name] = np.stack([mesh.point_data[f"{name}_{axis}"] for axis in "xyz"], axis=1)
    return mesh.points, mesh.cells_dict["triangle"], data


def expect_sense(points, triangles, data):
    """A closed surface whose numbers agree with one another."""
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    assert set(map(tuple, edges)) == set(map(tuple, edges[:, ::-1])) and len(points) > 100
    lower, upper = data["thickness_lower"], data["thickness_upper"]
    # No ball inside is larger than the short axis; an interval is at most a hundredth wider.
    assert np.all(lower <= upper) and np.all(lower >= 0) and 0.7 < lower.max() <= 0.8 and upper.max() < 0.8 * 1.02
    known = ~np.isnan(data["kappa_1"])
    assert np.all(data["kappa_1"][known & ~np.isnan(data["kappa_2"])] >=
                  data["kappa_2"][known & ~np.isnan(data["kappa_2"])])
    both = known & np.all(np.isfinite(data["direction_1"]) & np.isfinite(data["direction_2"]), axis=1)
    assert np.any(both), "a curvature is known somewhere"
    # Unit vectors, perpendicular: the errors are those of a normalisation in doubles.
    for name in VECTORS:
        assert np.abs(np.linalg.norm(data[name][both], axis=1) - 1).max() < 1e-12
    assert np.abs(np.sum(data["direction_1"][both] * data["direction_2"][both], axis=1)).max() < 1e-9
    # Opposite normals, and others.
    assert np.all((data["thickness_kind"] == 4) == (data["object_angle"] >= 1.2)) and 4 in data["thickness_kind"]
    assert np.all((data["thickness_kind"] == 1) == (data["object_angle"] < 0.25))
    assert set(np.unique(data["curvature_state"])) <= set(range(11)) and data["sheet"].min() >= -1


def expect_same(found, wanted):
    for name in SCALARS + VECTORS:
        assert np.array_equal(found[name], wanted[name], equal_nan=True), name


def boundary_ply(run):
    points, triangles, data = fields_of_ply(boundary_of(run, "boundary.ply"))
    for name in SCALARS:
        assert data[name].dtype == (np.int32 if name in WHOLE else np.float64), (name, data[name].dtype)
    expect_sense(points, triangles, data)


def boundary_ply_text(run):
    wanted = fields_of_ply(boundary_of(run, "boundary.ply"))
    points, triangles, data = fields_of_ply(boundary_of(run, "text.ply", "--ascii"))
    assert np.array_equal(points, wanted[0]) and np.array_equal(triangles, wanted[1])
    expect_same(data, wanted[2])


def array_of(element):
    """Reads a binary DataArray by the description of VTK's XML formats: base64 of its length, then of its bytes."""
    assert element.get("format") == "binary"
    data = base64.b64decode(element.text, validate=True)
    length = int(np.frombuffer(data[:8], "<u8")[0])
    assert len(data) == 8 + length
    dtype = {"Float64": "<f8", "Int32": "<i4", "Int64": "<i8"}[element.get("type")]
    numbers = np.frombuffer(data[8:], dtype)
    components = int(element.get("NumberOfComponents"))
    return numbers if components == 1 else numbers.reshape(-1, components)


def boundary_vtp(run):
    wanted = fields_of_ply(boundary_of(run, "boundary.ply"))
    root = xml.etree.ElementTree.parse(boundary_of(run, "boundary.vtp")).getroot()
    assert (root.tag, root.get("type"), root.get("header_type")) == ("VTKFile", "PolyData", "UInt64")
    assert root.get("byte_order") == "LittleEndian"
    piece = root.find("PolyData/Piece")
    assert int(piece.get("NumberOfPoints")) == len(wanted[0])
    assert int(piece.get("NumberOfPolys")) == len(wanted[1])
    assert np.array_equal(array_of(piece.find("Points/DataArray")), wanted[0])
    corners = {element.get("Name"): array_of(element) for element in piece.findall("Polys/DataArray")}
    assert np.array_equal(corners["connectivity"].reshape(-1, 3), wanted[1])
    assert np.array_equal(corners["offsets"], 3 * np.arange(1, len(wanted[1]) + 1))
    data = {element.get("Name"): array_of(element) for element in piece.findall("PointData/DataArray")}
    assert sorted(data) == sorted(SCALARS + VECTORS)
    expect_same(data, wanted[2])


def boundary_vtp_by_vtk(run):
    try:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    except ImportError as error:
        print(f"SKIPPED: {error}; Debian has it in python3-vtk9")
        sys.exit(77)
    wanted = fields_of_ply(boundary_of(run, "boundary.ply"))
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(boundary_of(run, "boundary.vtp")))
    reader.Update()
    mesh = reader.GetOutput()
    assert np.array_equal(vtk_to_numpy(mesh.GetPoints().GetData()), wanted[0])
    assert np.array_equal(vtk_to_numpy(mesh.GetPolys().GetData()).reshape(-1, 4)[:, 1:], wanted[1])
    expect_same({name: vtk_to_numpy(mesh.GetPointData().GetArray(name)) for name in SCALARS + VECTORS}, wanted[2])


def boundary_glb(run):
    points, triangles, wanted = fields_of_ply(boundary_of(run, "boundary.ply"))
    document, buffer = parse_glb(boundary_of(run, "boundary.glb"))
    primitive = document["meshes"][0]["primitives"][0]
    values = {name: accessor(document, buffer, index) for name, index in primitive["attributes"].items()}
    assert all(len(value) == len(points) for value in values.values())
    assert np.array_equal(accessor(document, buffer, primitive["indices"]).reshape(-1, 3), triangles)
    middle = np.array(document["nodes"][0]["translation"])
    extent = np.abs(points - middle).max()
    assert np.abs(middle + np.float64(values["POSITION"]) - points).max() <= np.finfo(np.float32).eps * extent
    for name, value in values.items():
        assert value.dtype != np.float32 or np.all(np.isfinite(value)), name
    # The interval in floats holds that in doubles, and is no wider than a float on each side.
    lower, upper = (np.float64(values[f"_THICKNESS_{end}"].ravel()) for end in ("LOWER", "UPPER"))
    for end, exact in ((lower, wanted["thickness_lower"]), (upper, wanted["thickness_upper"])):
        assert np.abs(end - exact).max() <= np.finfo(np.float32).eps * np.abs(exact).max()
    assert np.all(lower <= wanted["thickness_lower"]) and np.all(upper >= wanted["thickness_upper"])
    for name in set(SCALARS + VECTORS) - {"thickness_lower", "thickness_upper"}:
        found = values["_" + name.upper()]
        assert np.array_equal(found.reshape(wanted[name].shape), np.float32(np.nan_to_num(wanted[name]))), name
    # Viridis: brighter where it is thicker.
    light = (values["COLOR_0"][:, :3] / 65535) @ (0.2126, 0.7152, 0.0722)
    known = np.argsort(wanted["thickness_lower"])
    assert light[known[-1]] > 2 * light[known[0]]


def boundary_glb_by_assimp(run):
    points, triangles, _ = fields_of_ply(boundary_of(run, "boundary.ply"))
    document, buffer = run.through_assimp(boundary_of(run, "boundary.glb"))
    primitive = document["meshes"][0]["primitives"][0]
    assert document["accessors"][primitive["indices"]]["count"] == triangles.size
    positions = accessor(document, buffer, primitive["attributes"]["POSITION"])
    assert np.ptp(positions, axis=0).max() > 0.99 * np.ptp(points, axis=0).max()
    assert "COLOR_0" in primitive["attributes"]


def expect_balls(points, data, delta):
    """Each ball comes within delta of its point, and no contact is inside it or beyond the width of the interval."""
    radius, width = data["ball_radius"], data["thickness_upper"] - data["thickness_lower"]
    assert np.array_equal(2 * radius, data["thickness_lower"])
    away = np.linalg.norm(data["ball_centre"] - points, axis=1)
    assert np.all(away[radius > 0] <= (radius + delta)[radius > 0] * (1 + 1e-12))
    for name in ("contact_a", "contact_b"):
        distance = np.linalg.norm(data[name] - data["ball_centre"], axis=1)[radius > 0]
        assert np.all(distance >= radius[radius > 0] * (1 - 1e-9)), name
        assert np.all(distance <= (radius + delta + width)[radius > 0] * (1 + 1e-9)), name


def boundary_npz(run):
    points, triangles, wanted = fields_of_ply(boundary_of(run, "boundary.ply"))
    with np.load(boundary_of(run, "boundary.npz")) as file:
        data = {name: file[name] for name in file.files}
    assert set(data) == {"version", "delta", "points", "triangles", *SCALARS, *VECTORS, *OF_BALLS}
    assert np.array_equal(data["points"], points) and np.array_equal(data["triangles"], triangles)
    expect_same(data, wanted)
    expect_balls(points, data, float(data["delta"]))


def boundary_json(run):
    with np.load(boundary_of(run, "boundary.npz")) as file:
        wanted = {name: file[name] for name in file.files}
    document = json.loads(boundary_of(run, "boundary.json").read_text())
    assert document["delta"] == float(wanted["delta"]) and document["triangles"] == wanted["triangles"].tolist()
    assert len(document["points"]) == len(wanted["points"])
    for i, point in enumerate(document["points"]):
        assert point["at"] == wanted["points"][i].tolist()
        assert point["thickness_kind"] == KINDS[wanted["thickness_kind"][i]]
        for name in [*SCALARS, *VECTORS, *OF_BALLS]:
            if name not in ("thickness_kind", "curvature_state"):
                found = np.array(point[name], dtype=float)  # null is NaN
                assert np.array_equal(found, wanted[name][i], equal_nan=True), (i, name)


def thickness_points(run):
    for name in ("points.npz", "points.json", "points.csv"):
        boundary_of(run, "boundary.ply", "--thickness", "--thickness-points", name)
    with np.load(run.folder / "points.npz") as file:
        data = {name: file[name] for name in file.files}
    assert data["points"].shape == (10000, 3) and "triangles" not in data and "kappa_1" not in data
    assert {4} < set(data["thickness_kind"].tolist())
    expect_balls(data["points"], data, float(data["delta"]))
    document = json.loads((run.folder / "points.json").read_text())
    with open(run.folder / "points.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(document["points"]) == 10000
    for i in range(0, 10000, 97):
        point, row = document["points"][i], rows[i]
        assert point["thickness_kind"] == row["thickness_kind"] == KINDS[data["thickness_kind"][i]]
        for name in ("thickness_lower", "thickness_upper", "object_angle", "ball_radius"):
            assert point[name] == float(row[name]) == data[name][i], (i, name)
        for name in ("ball_centre", "contact_a", "contact_b"):
            assert point[name] == [float(row[f"{name}_{axis}"]) for axis in "xyz"] == data[name][i].tolist(), (i, name)


CASES = {"boundary_npz": boundary_npz, "boundary_json": boundary_json, "thickness_points": thickness_points,
         "boundary_ply": boundary_ply, "boundary_ply_text": boundary_ply_text, "boundary_vtp": boundary_vtp,
         "boundary_vtp_by_vtk": boundary_vtp_by_vtk, "boundary_glb": boundary_glb,
         "boundary_glb_by_assimp": boundary_glb_by_assimp}
