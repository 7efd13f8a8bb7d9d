"""Meshes for the examples of this folder: solids of boxes, and what NumPy makes of them."""

import numpy as np


def solid_of_boxes(add, cut=(), size=1.0):
    """The boundary of some boxes less others: vertices of shape (n, 3) and triangles of shape (m, 3).

    Args:
        add, cut: Boxes as (x0, y0, z0, x1, y1, z1). Two of them must not touch at an edge alone.
        size: Greatest side of a face; the faces are cut where any box ends.
    """
    lines = [_lines(np.array([*add, *cut])[:, axis::3].ravel(), size) for axis in range(3)]
    middles = np.stack(np.meshgrid(*[(line[1:] + line[:-1]) / 2 for line in lines], indexing="ij"), axis=-1)

    def within(boxes):
        return sum(np.all((box[:3] < middles) & (middles < box[3:]), axis=-1) for box in map(np.array, boxes)) > 0

    filled = np.pad((within(add) & ~within(cut) if cut else within(add)).astype(int), 1)
    points = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
    numbers = np.arange(points[..., 0].size).reshape(points.shape[:3])
    quads = []
    for turn in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):  # a face where a cell is filled and the next one is not
        change = np.diff(filled.transpose(turn), axis=0)[:, 1:-1, 1:-1]
        at = numbers.transpose(turn)
        corners = np.stack([at[:, :-1, :-1], at[:, 1:, :-1], at[:, 1:, 1:], at[:, :-1, 1:]], axis=-1)
        quads += [corners[change < 0], corners[change > 0][:, ::-1]]
    used, faces = np.unique(np.concatenate(quads), return_inverse=True)
    faces = faces.reshape(-1, 4)
    return points.reshape(-1, 3)[used], np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])


def smoothed(vertices, triangles, rounds):
    """The vertices, each moved half of the way to the mean of its neighbours, some times."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    number = np.bincount(edges[:, 0], minlength=len(vertices))[:, None]
    for _ in range(rounds):
        sums = np.stack([np.bincount(edges[:, 0], vertices[edges[:, 1], axis], len(vertices)) for axis in range(3)], 1)
        vertices = (vertices + sums / number) / 2
    return vertices


def _lines(ends, size):
    """The ends, and between them as many more that no two neighbours are farther apart than the size."""
    ends = np.unique(ends)
    between = [np.linspace(a, b, int(np.ceil((b - a) / size)) + 1) for a, b in zip(ends, ends[1:])]
    return np.unique(np.concatenate(between))
