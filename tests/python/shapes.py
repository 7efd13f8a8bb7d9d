"""Meshes for the tests of the Python package."""

import numpy as np


def box(sides=(1.0, 1.0, 1.0), middle=(0.0, 0.0, 0.0)):
    """Eight vertices, twelve triangles."""
    corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
    vertices = (corners - 0.5) * np.asarray(sides) + np.asarray(middle)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return vertices, np.array(triangles, dtype=np.int64)


def grid(sides, count):
    """A box whose faces are grids of count squares each way."""
    vertices, index, triangles = [], {}, []

    def vertex(p):
        key = tuple(np.round(p * count).astype(int))
        if key not in index:
            index[key] = len(vertices)
            vertices.append(p)
        return index[key]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            for i in range(count):
                for j in range(count):
                    corners = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        p = np.zeros(3)
                        p[axis], p[u], p[v] = side, a / count, b / count
                        corners.append(vertex(p))
                    if side == 0:
                        corners.reverse()
                    a, b, c, d = corners
                    triangles += [(a, b, c), (a, c, d)]
    return (np.array(vertices) - 0.5) * np.asarray(sides), np.array(triangles, dtype=np.int64)


def torus(major=1.0, minor=0.4, around=48, across=24):
    """A torus about the z axis."""
    u, v = np.meshgrid(2 * np.pi * np.arange(around) / around, 2 * np.pi * np.arange(across) / across, indexing="ij")
    ring = major + minor * np.cos(v)
    vertices = np.stack([ring * np.cos(u), ring * np.sin(u), minor * np.sin(v)], axis=-1).reshape(-1, 3)
    a = np.arange(around * across).reshape(around, across)
    b, d = np.roll(a, -1, axis=0), np.roll(a, -1, axis=1)
    c = np.roll(b, -1, axis=1)
    triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    return vertices, triangles.astype(np.int64)


def pose(shift=(0.0, 0.0, 0.0), turn=0.0):
    """A turn about z, then a shift."""
    matrix = np.eye(4)
    matrix[:2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
    matrix[:3, 3] = shift
    return matrix
