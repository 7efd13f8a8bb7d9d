#!/usr/bin/env python3
"""Thin parts, on which balls do badly: a plate, a bracket and a pipe elbow.

    thin_parts.py FOLDER      writes plate.obj, bracket.obj and elbow.obj

The plate is 1 x 0.3 x 0.02 with two holes of radius 0.06. The bracket has two such plates, 1 x 0.3 and 0.6 x 0.3, at a
right angle, with a hole of radius 0.08 in each. The elbow is a pipe of outer radius 0.08 and wall 0.012: a quarter bend of
radius 0.35 between two straight ends of 0.3.
"""
import math
import pathlib
import sys

SIDES = 96  # of a circle


class Surface:
    """Triangles over points that are shared where they coincide."""

    def __init__(self):
        self.index, self.points, self.faces = {}, [], []

    def vertex(self, point):
        key = tuple(round(x, 9) for x in point)
        if key not in self.index:
            self.index[key] = len(self.points)
            self.points.append(key)
        return self.index[key]

    def polygon(self, points, flipped=False):
        corners = [self.vertex(point) for point in (reversed(points) if flipped else points)]
        for b, c in zip(corners[1:], corners[2:]):
            if len({corners[0], b, c}) == 3:
                self.faces.append((corners[0], b, c))

    def write(self, path):
        lines = ["v {!r} {!r} {!r}".format(*point) for point in self.points]
        lines += ["f {} {} {}".format(*(i + 1 for i in face)) for face in self.faces]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def around_hole(x0, x1, y0, y1, hole):
    """Quadrilaterals, counter-clockwise, between a rectangle and a circle in it: centre x, y and radius."""
    cx, cy, radius = hole
    corners = {math.atan2(y - cy, x - cx) % (2 * math.pi) for x in (x0, x1) for y in (y0, y1)}
    angles = sorted({2 * math.pi * k / SIDES for k in range(SIDES)} | corners)

    def on_rectangle(angle):
        c, s = math.cos(angle), math.sin(angle)
        ways = [(x1 - cx) / c if c > 1e-12 else math.inf, (x0 - cx) / c if c < -1e-12 else math.inf,
                (y1 - cy) / s if s > 1e-12 else math.inf, (y0 - cy) / s if s < -1e-12 else math.inf]
        return cx + min(ways) * c, cy + min(ways) * s

    inner = [(cx + radius * math.cos(a), cy + radius * math.sin(a)) for a in angles]
    outer = [on_rectangle(a) for a in angles]
    count = len(angles)
    return [(inner[k], outer[k], outer[(k + 1) % count], inner[(k + 1) % count]) for k in range(count)]


def add_plate(surface, cells, place, thickness, is_open=lambda point: False):
    """Rectangles with a hole each, of a thickness; place(u, v, w) is the point of space. Border edges between two points
    that are open get no wall."""
    borders = {}
    for cell in cells:
        for quad in around_hole(*cell):
            surface.polygon([place(u, v, thickness) for u, v in quad])
            surface.polygon([place(u, v, 0) for u, v in quad], flipped=True)
            for a, b in zip(quad, quad[1:] + quad[:1]):
                keys = tuple(tuple(round(x, 9) for x in point) for point in (a, b))
                if keys[0] == keys[1]:
                    continue
                if borders.pop(keys[::-1], None) is None:
                    borders[keys] = (a, b)
    for a, b in borders.values():
        if not (is_open(a) and is_open(b)):
            surface.polygon([place(*a, 0), place(*b, 0), place(*b, thickness), place(*a, thickness)])


def plate():
    surface = Surface()
    cells = [(0, 0.5, 0, 0.3, (0.25, 0.15, 0.06)), (0.5, 1, 0, 0.3, (0.75, 0.15, 0.06))]
    add_plate(surface, cells, lambda u, v, w: (u, v, w), 0.02)
    return surface


def bracket():
    surface, t = Surface(), 0.02
    hole = (t + 0.3, 0.15, 0.08)  # as far from the corner in both plates, so that their edges there have equal points
    at_corner = lambda point: abs(point[0] - t) < 1e-9  # noqa: E731
    add_plate(surface, [(t, 1, 0, 0.3, hole)], lambda u, v, w: (u, v, w), t, at_corner)
    add_plate(surface, [(t, 0.6, 0, 0.3, hole)], lambda u, v, w: (t - w, v, u), t, at_corner)
    heights = sorted({round(v, 9) for quad in around_hole(t, 1, 0, 0.3, hole) for u, v in quad if abs(u - t) < 1e-9})
    # The block in the corner: outer faces along both plates, and two ends.
    surface.polygon([(0, 0, 0)] + [(t, v, 0) for v in heights] + [(0, 0.3, 0)], flipped=True)
    surface.polygon([(0, 0, 0)] + [(0, v, t) for v in heights] + [(0, 0.3, 0)])
    surface.polygon([(0, 0, 0), (t, 0, 0), (t, 0, t), (0, 0, t)])
    surface.polygon([(0, 0.3, 0), (0, 0.3, t), (t, 0.3, t), (t, 0.3, 0)])
    return surface


def elbow():
    surface, bend = Surface(), 0.35
    path = [((-0.3 + 0.3 * k / 12, 0), (1, 0)) for k in range(13)]
    for k in range(1, 49):
        angle = math.pi / 2 * k / 48
        path.append(((bend * math.sin(angle), bend - bend * math.cos(angle)), (math.cos(angle), math.sin(angle))))
    path += [((bend, bend + 0.3 * k / 12), (0, 1)) for k in range(1, 13)]

    def ring(centre, along, radius):
        turns = [2 * math.pi * k / SIDES for k in range(SIDES)]
        return [(centre[0] - along[1] * radius * math.cos(a), centre[1] + along[0] * radius * math.cos(a),
                 radius * math.sin(a)) for a in turns]

    outer = [ring(*step, 0.08) for step in path]
    inner = [ring(*step, 0.068) for step in path]
    for k in range(len(path) - 1):
        for i in range(SIDES):
            j = (i + 1) % SIDES
            surface.polygon([outer[k][i], outer[k + 1][i], outer[k + 1][j], outer[k][j]], flipped=True)
            surface.polygon([inner[k][i], inner[k + 1][i], inner[k + 1][j], inner[k][j]])
    for end, flipped in ((0, False), (-1, True)):
        for i in range(SIDES):
            j = (i + 1) % SIDES
            surface.polygon([outer[end][i], inner[end][i], inner[end][j], outer[end][j]], flipped)
    return surface


PARTS = {"plate": plate, "bracket": bracket, "elbow": elbow}


def write_all(folder):
    """Writes all parts; returns their paths."""
    paths = []
    for name, make in PARTS.items():
        paths.append(pathlib.Path(folder) / f"{name}.obj")
        make().write(paths[-1])
    return paths


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write_all(sys.argv[1])
