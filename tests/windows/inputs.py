"""Small meshes, shapes and lists, with line ends of both kinds: the inputs of compare_commands.py."""
import json
import math
import subprocess


def obj_of(vertices, triangles, end="\n"):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles]
    return end.join(lines) + end


def ellipsoid(around, along, bend=0.0, shift=0.0):
    """A closed mesh of 2 * around * (along - 1) triangles, bent along x."""
    points = [(0.0, 0.0, 1.0)]
    for i in range(1, along):
        for j in range(around):
            v, u = math.pi * i / along, 2 * math.pi * (j + 0.5 * i) / around
            points.append((1.7 * math.sin(v) * math.cos(u), 0.9 * math.sin(v) * math.sin(u), math.cos(v)))
    points.append((0.0, 0.0, -1.0))
    triangles = []
    at = lambda i, j: 1 + (i - 1) * around + j % around
    for j in range(around):
        triangles.append((0, at(1, j), at(1, j + 1)))
        triangles.append((len(points) - 1, at(along - 1, j + 1), at(along - 1, j)))
        for i in range(1, along - 1):
            triangles.append((at(i, j), at(i + 1, j), at(i, j + 1)))
            triangles.append((at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)))
    return [(x + shift, y, z + bend * x * x) for x, y, z in points], triangles


def box(sides):
    corners = [(x, y, z) for x in (0, sides[0]) for y in (0, sides[1]) for z in (0, sides[2])]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def make_inputs(folder, make_model):
    folder.mkdir(parents=True)
    write = lambda name, text: (folder / name).write_bytes(text.encode())
    write("egg.obj", obj_of(*ellipsoid(16, 9)))
    write("egg_bent.obj", obj_of(*ellipsoid(16, 9, 0.1)))
    write("egg_more.obj", obj_of(*ellipsoid(16, 9, 0.2)))
    write("far.obj", obj_of(*ellipsoid(12, 7, 0.0, 4.0)))
    write("box.obj", obj_of(*box((3.0, 1.0, 0.5))))
    write("crlf.obj", obj_of(*ellipsoid(16, 9), end="\r\n"))
    vertices, triangles = box((3.0, 1.0, 0.5))
    facets = ["solid box"]
    for t in triangles:
        facets += ["facet normal 0 0 0", "outer loop"]
        facets += [f"vertex {x} {y} {z}" for x, y, z in (vertices[i] for i in t)] + ["endloop", "endfacet"]
    write("box.stl", "\n".join(facets + ["endsolid box", ""]))
    write("crlf.stl", "\r\n".join(facets + ["endsolid box", ""]))
    off = ["OFF", f"{len(vertices)} {len(triangles)} 0"] + [f"{x} {y} {z}" for x, y, z in vertices]
    off += [f"3 {a} {b} {c}" for a, b, c in triangles]
    write("box.off", "\n".join(off) + "\n")
    write("crlf.off", "\r\n".join(off) + "\r\n")
    ply = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}", "property double x", "property double y",
           "property double z", f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header"]
    ply += [f"{x} {y} {z}" for x, y, z in vertices] + [f"3 {a} {b} {c}" for a, b, c in triangles]
    write("box.ply", "\n".join(ply) + "\n")
    write("crlf.ply", "\r\n".join(ply) + "\r\n")
    poses = "x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,1\n0.5,0.25,3,0,0,0.6,0.8\n-1,2,0.5,0.48,0.6,0,0.64\n"
    write("poses.csv", poses)
    write("poses_crlf.csv", poses.replace("\n", "\r\n"))
    wkt = "POLYGON((0 0,4 0,4 1,1 1,1 3,0 3,0 0))\n"
    write("shape.wkt", wkt)
    write("shape_crlf.wkt", wkt.replace("\n", "\r\n"))
    write("apart.wkt", "POLYGON((2 2,5 2,5 3,2 3,2 2))\n")
    write("ring.csv", "x,y\n0,0\n4,0\n4,1\n1,1\n1,3\n0,3\n")
    write("ring_crlf.csv", "x,y\r\n0,0\r\n4,0\r\n4,1\r\n1,1\r\n1,3\r\n0,3\r\n")
    shape = {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [0, 3], [0, 0]]]}
    write("shape.geojson", json.dumps(shape, indent=1))
    write("shape_crlf.geojson", json.dumps(shape, indent=1).replace("\n", "\r\n"))
    write("list.txt", "egg.obj\nbox.stl\n")
    write("list_crlf.txt", "egg.obj\r\nbox.stl\r\n")
    write("broken.obj", "v 0 0 0\nf 1 2 3\n")
    (folder / "parts" / "deep").mkdir(parents=True)
    write("parts/egg.obj", obj_of(*ellipsoid(12, 7)))
    write("parts/deep/box.obj", obj_of(*box((3.0, 1.0, 0.5))))
    subprocess.run([str(make_model), "turtle.obj"], cwd=folder, check=True, capture_output=True)
