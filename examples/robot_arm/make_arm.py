#!/usr/bin/env python3
"""Makes a robot arm to try `medial-vk spheres` on: arm.urdf and the meshes of its seven links.

    make_arm.py FOLDER

The script needs only Python and writes the same bytes each time. The arm has the difficulties of real ones: links that
are thin (a plate, a flange), concave (a fork, a bracket, fingers) or hollow on one side (a shell), turned and scaled
meshes, a package:// path, and primitives. Lengths are in metres, except for one mesh in millimetres.
"""
import math
import pathlib
import sys


class Mesh:
    """Triangles, counter-clockwise from outside."""

    def __init__(self):
        self.vertices, self.triangles = [], []

    def add(self, vertices, triangles):
        first = len(self.vertices)
        self.vertices += vertices
        self.triangles += [tuple(first + i for i in t) for t in triangles]
        return self


def polygon_triangles(outline):
    """Cuts ears off a simple polygon that runs counter-clockwise."""
    def doubled(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    left, triangles = list(range(len(outline))), []
    while len(left) > 3:
        for k, i in enumerate(left):
            before, after = left[k - 1], left[(k + 1) % len(left)]
            a, b, c = outline[before], outline[i], outline[after]
            if doubled(a, b, c) <= 0:
                continue
            others = (outline[j] for j in left if j not in (before, i, after))
            if any(doubled(a, b, p) >= 0 and doubled(b, c, p) >= 0 and doubled(c, a, p) >= 0 for p in others):
                continue
            triangles.append((before, i, after))
            del left[k]
            break
        else:
            raise ValueError("no simple polygon")
    return triangles + [tuple(left)]


def extruded(outline, low, high, axes=(0, 1, 2)):
    """A prism: the outline in two axes, from low to high in the third."""
    n, mesh = len(outline), Mesh()

    def point(p, height):
        result = [0.0, 0.0, 0.0]
        for axis, x in zip(axes, (*p, height)):
            result[axis] = x
        return tuple(result)

    vertices = [point(p, low) for p in outline] + [point(p, high) for p in outline]
    flat = polygon_triangles(outline)
    triangles = [(a, c, b) for a, b, c in flat] + [(n + a, n + b, n + c) for a, b, c in flat]
    for i in range(n):
        j = (i + 1) % n
        triangles += [(i, j, n + j), (i, n + j, n + i)]
    if axes not in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        triangles = [(a, c, b) for a, b, c in triangles]
    return mesh.add(vertices, triangles)


def revolved(profile, sides=48):
    """A solid about z from (radius, height) points, counter-clockwise: the inside is on the left."""
    mesh, n = Mesh(), len(profile)
    vertices = [(r * math.cos(2 * math.pi * i / sides), r * math.sin(2 * math.pi * i / sides), z)
                for i in range(sides) for r, z in profile]
    triangles = []
    for i in range(sides):
        for k in range(n):
            a, b = i * n + k, i * n + (k + 1) % n
            c, d = (i + 1) % sides * n + k, (i + 1) % sides * n + (k + 1) % n
            if profile[k][0] > 0:
                triangles.append((a, c, b))
            if profile[(k + 1) % n][0] > 0:
                triangles.append((b, c, d))
    # Points on the axis coincide: those of the first turn are used.
    merged = {}
    index = [merged.setdefault(tuple(round(x, 12) + 0.0 for x in v), i) for i, v in enumerate(vertices)]
    kept = {old: new for new, old in enumerate(sorted(set(index)))}
    return mesh.add([vertices[old] for old in kept],
                    [tuple(kept[index[i]] for i in t) for t in triangles])


def to_obj(mesh, scale=1.0):
    lines = ["v " + " ".join(f"{scale * x:.9g}" for x in v) for v in mesh.vertices]
    lines += ["f " + " ".join(str(i + 1) for i in t) for t in mesh.triangles]
    return "\n".join(lines) + "\n"


def to_stl(mesh, name):
    lines = [f"solid {name}"]
    for t in mesh.triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(f"{x:.9g}" for x in mesh.vertices[i]) for i in t]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + [f"endsolid {name}", ""])


def base():
    """A foot with a groove around it."""
    return revolved([(0, 0), (0.11, 0), (0.11, 0.03), (0.075, 0.045), (0.075, 0.09), (0.09, 0.105), (0.09, 0.14),
                     (0, 0.14)])


def fork():
    """Two prongs that hold the upper arm, and the block below them."""
    outline = [(-0.075, 0), (0.075, 0), (0.075, 0.16), (0.045, 0.16), (0.045, 0.05), (-0.045, 0.05), (-0.045, 0.16),
               (-0.075, 0.16)]
    return extruded(outline, -0.05, 0.05, axes=(1, 2, 0))


def upper_arm():
    """An I-beam: thin flanges and a thin web."""
    outline = [(-0.04, -0.035), (0.04, -0.035), (0.04, -0.027), (0.005, -0.027), (0.005, 0.027), (0.04, 0.027),
               (0.04, 0.035), (-0.04, 0.035), (-0.04, 0.027), (-0.005, 0.027), (-0.005, -0.027), (-0.04, -0.027)]
    return extruded(outline, 0, 0.36)


def elbow():
    """An L-shaped bracket."""
    return extruded([(0, 0), (0.12, 0), (0.12, 0.025), (0.025, 0.025), (0.025, 0.11), (0, 0.11)], -0.035, 0.035,
                    axes=(0, 2, 1))


def forearm():
    """A cover: half a tube, 4 mm thick, in millimetres."""
    outer = [(45 * math.cos(math.pi * i / 24), 45 * math.sin(math.pi * i / 24)) for i in range(25)]
    inner = [(41 * math.cos(math.pi * i / 24), 41 * math.sin(math.pi * i / 24)) for i in range(24, -1, -1)]
    return extruded(outer + inner, 0, 280)


def wrist():
    """A plate of 6 mm with rounded ends."""
    ends = [(0.05 * s + 0.03 * math.cos(math.pi * (i / 12 - 0.5) + (0 if s > 0 else math.pi)),
             0.03 * math.sin(math.pi * (i / 12 - 0.5) + (0 if s > 0 else math.pi))) for s in (1, -1)
            for i in range(13)]
    return extruded(ends, -0.003, 0.003)


def gripper():
    """A palm with two thin fingers, bent at their tips."""
    outline = [(-0.05, 0), (0.05, 0), (0.05, 0.10), (0.03, 0.10), (0.03, 0.09), (0.042, 0.09), (0.042, 0.025),
               (-0.042, 0.025), (-0.042, 0.09), (-0.03, 0.09), (-0.03, 0.10), (-0.05, 0.10)]
    return extruded(outline, -0.012, 0.012, axes=(0, 2, 1))


URDF = """<?xml version="1.0"?>
<!-- Made by examples/robot_arm/make_arm.py. -->
<robot name="arm">
  <link name="base">
    <visual><geometry><mesh filename="meshes/base.obj"/></geometry></visual>
    <collision><geometry><mesh filename="meshes/base.obj"/></geometry></collision>
  </link>
  <link name="shoulder">
    <visual><geometry><mesh filename="package://robot_arm/meshes/fork.stl"/></geometry></visual>
    <collision><geometry><mesh filename="package://robot_arm/meshes/fork.stl"/></geometry></collision>
  </link>
  <link name="upper_arm">
    <visual><geometry><mesh filename="meshes/upper_arm.obj"/></geometry></visual>
    <collision><geometry><mesh filename="meshes/upper_arm.obj"/></geometry></collision>
    <collision>
      <origin xyz="0 0 0" rpy="0 1.5707963267948966 0"/>
      <geometry><cylinder radius="0.042" length="0.07"/></geometry>
    </collision>
  </link>
  <link name="elbow">
    <visual><geometry><mesh filename="meshes/elbow.obj"/></geometry></visual>
    <collision><geometry><mesh filename="meshes/elbow.obj"/></geometry></collision>
    <collision>
      <origin xyz="0.06 0 0.06"/>
      <geometry><sphere radius="0.03"/></geometry>
    </collision>
  </link>
  <link name="forearm">
    <visual><geometry><mesh filename="meshes/forearm.obj" scale="0.001 0.001 0.001"/></geometry></visual>
    <collision>
      <origin xyz="0 0 0" rpy="0 0 0.7"/>
      <geometry><mesh filename="meshes/forearm.obj" scale="0.001 0.001 0.001"/></geometry>
    </collision>
  </link>
  <link name="wrist">
    <visual><geometry><mesh filename="meshes/wrist.stl"/></geometry></visual>
    <collision><geometry><mesh filename="meshes/wrist.stl"/></geometry></collision>
    <collision>
      <origin xyz="0 0 0.03"/>
      <geometry><box size="0.04 0.04 0.05"/></geometry>
    </collision>
  </link>
  <link name="gripper">
    <visual><geometry><mesh filename="meshes/gripper.obj"/></geometry></visual>
    <collision><geometry><mesh filename="meshes/gripper.obj"/></geometry></collision>
  </link>
{joints}</robot>
"""

JOINTS = [("base", "shoulder", "0 0 0.14", "0 0 0", "0 0 1"), ("shoulder", "upper_arm", "0 0 0.11", "0 0.4 0", "0 1 0"),
          ("upper_arm", "elbow", "0 0 0.36", "0 0 0", "0 1 0"), ("elbow", "forearm", "0.06 0 0.06", "0 1.2 0", "0 1 0"),
          ("forearm", "wrist", "0 0 0.29", "0 0 0", "0 0 1"), ("wrist", "gripper", "0 0 0.055", "0 0 0", "0 1 0")]


def joints():
    return "".join(f"""  <joint name="joint{i}" type="revolute">
    <parent link="{parent}"/>
    <child link="{child}"/>
    <origin xyz="{xyz}" rpy="{rpy}"/>
    <axis xyz="{axis}"/>
    <limit lower="-2.8" upper="2.8" effort="50" velocity="2"/>
  </joint>
""" for i, (parent, child, xyz, rpy, axis) in enumerate(JOINTS, 1))


def main():
    if sys.argv[1:] in (["-h"], ["--help"]):
        print(__doc__)
        return
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    if sys.argv[1].startswith("-"):  # a mistyped option, not a folder
        sys.exit(f"make_arm.py: {sys.argv[1]} is no option; the folder of that name is ./{sys.argv[1]}")
    folder = pathlib.Path(sys.argv[1]) / "robot_arm"
    (folder / "meshes").mkdir(parents=True, exist_ok=True)
    for name, mesh in [("base", base()), ("upper_arm", upper_arm()), ("elbow", elbow()), ("forearm", forearm()),
                       ("gripper", gripper())]:
        (folder / "meshes" / f"{name}.obj").write_text(to_obj(mesh))
    for name, mesh in [("fork", fork()), ("wrist", wrist())]:
        (folder / "meshes" / f"{name}.stl").write_text(to_stl(mesh, name))
    (folder / "arm.urdf").write_text(URDF.replace("{joints}", joints()))


if __name__ == "__main__":
    main()
