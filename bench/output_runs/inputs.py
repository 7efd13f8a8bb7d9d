"""The inputs of the compared runs. A mesh is a pair: points, and faces of any number of corners, counter-clockwise from
outside."""

import math
import shutil
import subprocess
import sys
from pathlib import Path

from whole_runs import meshes

ROOT = Path(__file__).resolve().parent.parent.parent


def box(low=(0, 0, 0), high=(1, 0.7, 0.4)):
    points = [tuple((low, high)[i >> axis & 1][axis] for axis in range(3)) for i in range(8)]
    return points, [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def tube(curve, radius, along=60, around=12):
    """A tube around a closed curve near the plane of x and y: curve(t) for t from 0 to 2 pi."""
    points, faces = [], []
    for i in range(along):
        t = 2 * math.pi * i / along
        (x, y, z), (ahead_x, ahead_y, _) = curve(t), curve(t + 1e-4)
        length = math.hypot(ahead_x - x, ahead_y - y)
        aside_x, aside_y = (ahead_y - y) / length, -(ahead_x - x) / length
        for j in range(around):
            aside = radius * math.cos(2 * math.pi * j / around)
            points.append((x + aside * aside_x, y + aside * aside_y, z + radius * math.sin(2 * math.pi * j / around)))
            row, ahead, beside = i * around, (i + 1) % along * around, (j + 1) % around
            faces.append((row + j, ahead + j, ahead + beside, row + beside))
    return points, faces


def ring(t):
    return math.cos(t), math.sin(t), 0.1 * math.cos(3 * t)


def ball(around=20, along=10):
    points = [(math.sin(v) * math.cos(u), math.sin(v) * math.sin(u), math.cos(v))
              for v in (math.pi * i / along for i in range(1, along))
              for u in (2 * math.pi * j / around for j in range(around))]
    north, south, last = len(points), len(points) + 1, len(points) - around
    faces = [(i * around + j, (i + 1) * around + j, (i + 1) * around + (j + 1) % around, i * around + (j + 1) % around)
             for i in range(along - 2) for j in range(around)]
    for j in range(around):
        faces += [(north, j, (j + 1) % around), (south, last + (j + 1) % around, last + j)]
    return [*points, (0, 0, 1), (0, 0, -1)], faces


def moved(mesh, by, turn=0.0):
    """The points, turned about the x axis and then moved."""
    c, s = math.cos(turn), math.sin(turn)
    return [(x + by[0], c * y - s * z + by[1], s * y + c * z + by[2]) for x, y, z in mesh[0]], mesh[1]


def turned_over(mesh):
    return mesh[0], [face[::-1] for face in mesh[1]]


def joined(*parts):
    points, faces = [], []
    for more_points, more_faces in parts:
        faces += [tuple(len(points) + i for i in face) for face in more_faces]
        points += more_points
    return points, faces


def eight():
    """A tube that crosses itself in the middle."""
    return tube(lambda t: (math.cos(t), 0.5 * math.sin(2 * t), 0.05 * math.sin(t)), 0.15)


def opened():
    """A tube with a hole."""
    points, faces = tube(ring, 0.3)
    return points, [face for i, face in enumerate(faces) if not (i // 12 < 3 and i % 12 < 4)]


def messy():
    """A box with flat and repeated faces, a crack, two points at one position and one of no face, and a turned face."""
    points, faces = box()
    middle, copy = len(points), len(points) + 1
    points += [(0.5, 0, 0), points[7], (3, 3, 3)]  # the first lies inside the side from 0 to 1
    faces = [face for face in faces if face not in ((0, 2, 3, 1), (1, 3, 7, 5))]
    faces += [(0, 2, middle), (middle, 2, 3), (middle, 3, 1), (0, middle, 1), (1, 3, copy), (5, 1, copy)]
    return points, [*faces, (0, 0, 4), (4, 5, 7, 6), (5, 4, 0)]


def edge_of_two():
    """Two boxes that share an edge, which has four faces."""
    points, faces = box()
    shared = {0: 6, 1: 7}  # corners of the second and of the first
    second = moved((points, faces), (0, 0.7, 0.4))
    index = [shared.get(i, 8 + i) for i in range(8)]
    return points + second[0], faces + [tuple(index[i] for i in face) for face in faces]


def write_obj(path, mesh):
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in mesh[0]]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in mesh[1]]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def write_off(path, mesh):
    lines = ["OFF", f"{len(mesh[0])} {len(mesh[1])} 0", *(f"{x:.9g} {y:.9g} {z:.9g}" for x, y, z in mesh[0])]
    lines += [f"{len(face)} " + " ".join(map(str, face)) for face in mesh[1]]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def write_stl(path, mesh):
    lines = ["solid made"]
    for face in mesh[1]:
        for corners in ((face[0], face[i], face[i + 1]) for i in range(1, len(face) - 1)):
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += ["vertex {:.9g} {:.9g} {:.9g}".format(*mesh[0][i]) for i in corners]
            lines += ["endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid made", ""]), encoding="ascii")


WRITERS = {".obj": write_obj, ".off": write_off, ".stl": write_stl}


def made_meshes():
    cube = box((0, 0, 0), (1, 1, 1))
    return {
        "box.off": box(),
        "plate.stl": box((0, 0, 0), (1, 0.6, 0.05)),
        "ball.stl": ball(),
        "cavity.obj": joined(cube, turned_over(moved(box((0, 0, 0), (0.4, 0.3, 0.5)), (0.2, 0.3, 0.2)))),
        "two.obj": joined(tube(ring, 0.25), moved(box(), (1.6, 0, 0), 0.5)),
        "crossing.obj": joined(box(), moved(box(), (0.45, 0.3, 0.1), 0.6)),
        "inside_out.obj": turned_over(tube(ring, 0.3)),
        "eight.obj": eight(),
        "open.obj": opened(),
        "messy.obj": messy(),
        "edge_of_two.obj": edge_of_two(),
    }


def write_meshes(folder, programs):
    """Generates the meshes and returns their names."""
    for name, mesh in made_meshes().items():
        WRITERS[Path(name).suffix](folder / name, mesh)
    subprocess.run([sys.executable, ROOT / "bench" / "write_torus.py", folder / "torus.ply", "2000"], check=True)
    meshes.write_torus(folder / "turned_torus.obj", around=24, along=48)
    if programs:
        meshes.make("turtle-6k", folder, programs)
    else:
        print("There is no make_model beside either program, so the turtle is left out.", file=sys.stderr)
    return sorted(path.name for path in folder.iterdir())


def write_broken_files(folder):
    """Writes files that must be refused, from torus.ply, and returns their names."""
    folder.mkdir()
    torus = (folder.parent / "torus.ply").read_bytes()
    contents = {
        "empty.obj": b"",
        "noise.ply": bytes(i * i * 7 % 251 for i in range(500)),
        "cut.ply": torus[:len(torus) // 2],
        "cut.off": b"OFF\n4 4 0\n0 0 0\n1 0 0\n",
        "infinite.obj": b"v 0 0 0\nv 1 0 inf\nv 0 1 0\nf 1 2 3\n",
        "no_such_corner.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
        "sheet.obj": b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
        "no_xml.urdf": b"<robot name='broken'><link",
        "no_mesh.urdf": b"<robot name='r'><link name='a'><collision><geometry><mesh filename='none.stl'/></geometry>"
                        b"</collision></link></robot>",
        "no_package.urdf": b"<robot name='r'><link name='a'><collision><geometry>"
                           b"<mesh filename='package://none/a.stl'/></geometry></collision></link></robot>",
    }
    for name, data in contents.items():
        (folder / name).write_bytes(data)
    return [f"{folder.name}/{name}" for name in contents]


def copy_models(paths, folder):
    folder.mkdir()
    for path in paths:
        if (folder / path.name).exists():
            raise OSError(f"two meshes are called {path.name}")
        shutil.copy(path, folder)
    return [f"{folder.name}/{path.name}" for path in paths]
