#!/usr/bin/env python3
"""Makes a body file, reads it with NumPy, and compares it with what docs/formats.md says of each array.

    body_back.py MEDIAL_VK

The solid is a box, so that everything is known. The file that NumPy writes again with the same arrays is a body file,
too. The exit code is 77 without NumPy.
"""
import itertools
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError as error:
    print(f"SKIPPED: {error}; Debian has it in python3-numpy")
    sys.exit(77)

SIDES = np.array([1.0, 2.0, 3.0])
COUNT = 4

# In the order of the file: the type, and the shape, with letters for numbers of vertices, triangles and balls.
ARRAYS = {
    "format": ("<U14", ()), "format_version": ("<u4", ()), "version": ("U", ()), "unit": ("<U4", ()),
    "vertices": ("<f8", ("v", 3)), "triangles": ("<u4", ("t", 3)),
    "inside_centre": ("<f8", ("n", 3)), "inside_radius": ("<f8", ("n",)),
    "cover_centre": ("<f8", ("m", 3)), "cover_radius": ("<f8", ("m",)),
    "inside_excess": ("<f8", ()), "inside_gap": ("<f8", (2,)), "cover_reach_out": ("<f8", (2,)),
    "covered_triangles": ("<u8", ()), "envelope_vertices": ("<u8", ()),
    "solid_volume": ("<f8", ()), "inside_volume": ("<f8", ()), "cover_volume": ("<f8", ())}


def write_box(path):
    corners = list(itertools.product((0, 1), repeat=3))
    lines = ["v {} {} {}".format(*(SIDES * corner)) for corner in corners]
    for face in ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"):
        lines.append("f " + face)
    path.write_text("\n".join(lines) + "\n")


def expect_arrays(arrays):
    assert list(arrays) == list(ARRAYS), list(arrays)
    numbers = {}
    for name, (kind, shape) in ARRAYS.items():
        array = arrays[name]
        assert array.dtype.kind == "U" if kind == "U" else array.dtype == np.dtype(kind), (name, array.dtype)
        assert array.flags.c_contiguous and len(array.shape) == len(shape), (name, array.shape)
        for length, expected in zip(array.shape, shape):
            assert length == numbers.setdefault(expected, length if isinstance(expected, str) else expected), name
    assert numbers["v"] == 8 and numbers["t"] == 12
    assert 0 < numbers["n"] <= COUNT and 0 < numbers["m"] <= COUNT
    assert (arrays["format"], arrays["format_version"], arrays["unit"]) == ("medial-vk body", 1, "mesh")


def expect_mesh(vertices, triangles):
    assert sorted(map(tuple, vertices)) == sorted(tuple(SIDES * c) for c in itertools.product((0, 1), repeat=3))
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    # Counter-clockwise from outside.
    assert np.isclose((a * np.cross(b, c)).sum() / 6, SIDES.prod())


def expect_balls(arrays):
    centre, radius = arrays["inside_centre"], arrays["inside_radius"]
    room = np.minimum(centre, SIDES - centre).min(axis=1)
    assert (radius > 0).all() and (radius <= room).all()
    assert arrays["inside_excess"] <= 0 and np.isclose(arrays["inside_excess"], (radius - room).max(), atol=1e-12)
    grid = np.array(list(itertools.product(np.linspace(0, 1, 21), repeat=3))) * SIDES
    centre, radius = arrays["cover_centre"], arrays["cover_radius"]
    away = np.linalg.norm(grid[:, None] - centre, axis=2) - radius
    assert (away.min(axis=1) <= 0).all()
    reach = (np.linalg.norm(np.maximum(0, np.maximum(-centre, centre - SIDES)), axis=1) + radius).max()
    for name, least, most in [("inside_gap", 0, SIDES.max()), ("cover_reach_out", 0, reach)]:
        lower, upper = arrays[name]
        assert least <= lower <= upper <= most, (name, lower, upper)


def expect_measures(arrays):
    assert arrays["covered_triangles"] == 12 and arrays["envelope_vertices"] > 0
    assert np.isclose(arrays["solid_volume"], SIDES.prod())
    assert 0 < arrays["inside_volume"] < arrays["solid_volume"] < arrays["cover_volume"]


def main():
    tool = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_box(folder / "box.obj")
        subprocess.run([tool, "spheres", "box.obj", "--contract", "both", "--count", str(COUNT), "--resolution", "24",
                        "--backend", "cpu", "-q"], cwd=folder, check=True)
        with np.load(folder / "box.body.npz", allow_pickle=False) as file:
            arrays = dict(file)
        expect_arrays(arrays)
        expect_mesh(arrays["vertices"], arrays["triangles"])
        expect_balls(arrays)
        expect_measures(arrays)
        np.savez(folder / "again.npz", **arrays)
        found = subprocess.run([tool, "distance", "again.npz", "box.body.npz", "--balls", "-q"], cwd=folder, check=True,
                               capture_output=True, text=True).stdout
        names, line = found.splitlines()
        assert names == "lower,upper,state,ax,ay,az,bx,by,bz", found
        assert line.startswith("0,0,hit,"), found
        point = np.array(line.split(",")[3:], float)  # one of both, in a ball
        assert (point[:3] == point[3:]).all(), found
        distances = np.linalg.norm(arrays["inside_centre"] - point[:3], axis=1)
        assert (distances <= arrays["inside_radius"]).any(), found
    print("body: ok")


if __name__ == "__main__":
    main()
