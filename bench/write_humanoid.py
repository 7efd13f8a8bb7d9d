#!/usr/bin/env python3
"""Writes a humanoid robot of 22 links, a URDF with a binary STL file for each link:
   bench/write_humanoid.py FOLDER [TRIANGLES]      (of each link, about; default: 3,900)
Every link is a shell that is open where it meets the next link, bumpy, with ribs and a motor that cross it, screws that
lie in it and a plate without thickness. So no mesh is closed, and many faces lie inside the solid."""
import math
import struct
import sys
from pathlib import Path

# Name, parent, half axes in metres, place on the parent.
LINKS = [("pelvis", None, (.09, .13, .08), (0, 0, 0)),
         ("waist", "pelvis", (.06, .08, .06), (0, 0, .1)), ("torso", "waist", (.1, .16, .2), (0, 0, .22)),
         ("neck", "torso", (.04, .04, .05), (0, 0, .24)), ("head", "neck", (.09, .08, .12), (0, 0, .14))]
# Half axes and the place on the parent, of the left side.
LIMBS = [("shoulder", "torso", (.05, .06, .05), (0, .2, .15)),
         ("upper_arm", "shoulder", (.05, .05, .14), (0, .05, -.14)),
         ("elbow", "upper_arm", (.04, .04, .05), (0, 0, -.16)), ("forearm", "elbow", (.04, .045, .13), (0, 0, -.15)),
         ("hand", "forearm", (.03, .05, .09), (0, 0, -.2)), ("thigh", "pelvis", (.08, .08, .2), (0, .1, -.24)),
         ("shin", "thigh", (.06, .06, .2), (0, 0, -.4)), ("foot", "shin", (.12, .05, .04), (.04, 0, -.24))]
for side, sign in ("left", 1), ("right", -1):
    for name, parent, size, (x, y, z) in LIMBS:
        on_trunk = parent in ("torso", "pelvis")
        LINKS.append((f"{side}_{name}", parent if on_trunk else f"{side}_{parent}", size, (x, sign * y, z)))
LINKS.append(("backpack", "torso", (.05, .1, .12), (-.13, 0, .02)))


def grid(rows, columns, point, wraps):
    """Two triangles for each cell of a grid; point(u, v) with u and v in [0, 1]."""
    at = [[point(i / rows, j / columns) for j in range(columns + 1)] for i in range(rows + 1)]
    if wraps:
        for row in at:
            row[-1] = row[0]
    for i in range(rows):
        for j in range(columns):
            a, b, c, d = at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]
            yield from (t for t in ((a, b, c), (a, c, d)) if len(set(t)) == 3)


def shell(size, triangles, phase):
    """An ellipsoid with bumps, open at its upper end."""
    rows = max(4, round(math.sqrt(triangles / 4)))

    def point(u, v):
        polar, angle = math.pi - (math.pi - .35) * u, 2 * math.pi * v
        bump = 1 + .04 * math.sin(5 * angle + phase) * math.sin(3 * polar)
        bump += .01 * math.sin(17 * angle) * math.sin(13 * polar)
        around = math.sin(polar) * bump if u > 0 else 0
        along = math.cos(polar) * bump
        return size[0] * around * math.cos(angle), size[1] * around * math.sin(angle), size[2] * along
    return grid(rows, 2 * rows, lambda u, v: point(u, v % 1), True)


def cylinder(middle, axis, radius, half, triangles):
    """Closed, along the coordinate `axis`."""
    columns = max(6, triangles // 8)

    def point(u, v):
        height, wide = ((-half, 0), (-half, radius), (half, radius), (half, 0))[round(3 * u)]
        local = [wide * math.cos(2 * math.pi * v), wide * math.sin(2 * math.pi * v)]
        local.insert(axis, height)
        if axis == 1:
            local[0], local[2] = local[2], local[0]
        return tuple(m + x for m, x in zip(middle, local))
    return grid(3, columns, lambda u, v: point(u, v % 1), True)


def box(middle, half):
    corners = [tuple(m + (h if i >> k & 1 else -h) for k, (m, h) in enumerate(zip(middle, half))) for i in range(8)]
    for a, b, c, d in (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5):
        yield from ((corners[a], corners[b], corners[c]), (corners[a], corners[c], corners[d]))


def link_mesh(size, triangles, phase):
    yield from shell(size, .7 * triangles, phase)
    motor = (0, 0, .5 * size[2])
    yield from cylinder(motor, 1, .45 * min(size), 1.1 * size[1], round(.1 * triangles))
    for k in range(3):  # ribs
        yield from box((0, 0, (k - 1) * .4 * size[2]), (1.03 * size[0], .04 * size[1], .05 * size[2]))
    for k in range(6):  # screws
        angle = 2 * math.pi * k / 6
        middle = (.9 * size[0] * math.cos(angle), .9 * size[1] * math.sin(angle), 0)
        yield from cylinder(middle, 2, .06 * min(size), .15 * size[2], round(.015 * triangles))
    rows = round(math.sqrt(.1 * triangles / 2))
    plate = 1.02 * size[1]
    yield from grid(rows, rows, lambda u, v: ((u - .5) * size[0], plate, (v - .5) * size[2]), False)


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    folder, triangles = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 3900
    (folder / "meshes").mkdir(parents=True, exist_ok=True)
    lines, count = ['<robot name="humanoid">'], 0
    for number, (name, parent, size, place) in enumerate(LINKS):
        mesh = list(link_mesh(size, triangles, number))
        count += len(mesh)
        records = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for p in t for x in p), 0) for t in mesh)
        (folder / "meshes" / f"{name}.stl").write_bytes(bytes(80) + struct.pack("<I", len(mesh)) + records)
        geometry = f'<geometry><mesh filename="meshes/{name}.stl"/></geometry>'
        lines.append(f'  <link name="{name}"><visual>{geometry}</visual><collision>{geometry}</collision></link>')
        if parent:
            lines.append(f'  <joint name="{name}_joint" type="revolute"><parent link="{parent}"/><child link="{name}"/>'
                         f'<origin xyz="{place[0]} {place[1]} {place[2]}"/><axis xyz="0 1 0"/>'
                         '<limit lower="-1" upper="1" effort="50" velocity="3"/></joint>')
    (folder / "humanoid.urdf").write_text("\n".join(lines + ["</robot>", ""]))
    print(f"{len(LINKS)} links, {count} triangles: {folder / 'humanoid.urdf'}")


main()
