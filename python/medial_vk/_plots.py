"""Plots with matplotlib, which is imported when one is drawn."""

from __future__ import annotations

from typing import Any

import numpy as np

_LIGHT = np.array([0.4, -0.5, 0.77])  # towards it, of unit length to within a hundredth
_GREY = (0.82, 0.84, 0.87)


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt  # type: ignore[import]

    return plt.figure(figsize=(6, 6)).add_subplot(projection="3d")


def _fit(ax: Any, lower: Any, upper: Any) -> None:
    """Equal scales on all axes, around all that was drawn in them by this module."""
    before = getattr(ax, "_medial_vk_box", None)
    if before is not None:
        lower, upper = np.minimum(before[0], lower), np.maximum(before[1], upper)
    ax._medial_vk_box = (lower, upper)
    sides = np.maximum(upper - lower, max(1e-2 * float(np.max(upper - lower)), 1e-300))  # a flat box has no aspect
    low, high = (lower + upper - sides) / 2, (lower + upper + sides) / 2
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_zlim(low[2], high[2])
    ax.set_box_aspect(sides / sides.max(), zoom=1.1)  # matplotlib leaves wide margins


def _is_colour(value: Any) -> bool:
    return value is None or isinstance(value, str) or np.shape(value) in ((3,), (4,))


def _split(corners: Any, colours: Any) -> tuple[Any, Any]:
    """The triangles, long ones halved: matplotlib draws them in the order of their middles, which is that of their
    depths only if they are small."""
    longest = float(np.max(np.ptp(corners.reshape(-1, 3), axis=0), initial=0.0)) / 24
    while len(corners) < 30_000:
        lengths = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
        is_long = lengths.max(axis=1) > longest
        if not is_long.any():
            break
        first = lengths[is_long].argmax(axis=1)  # turned so that the longest side comes first
        a, b, c = (np.take_along_axis(corners[is_long], ((first + k) % 3)[:, None, None], 1)[:, 0] for k in range(3))
        middle = (a + b) / 2
        halves = np.concatenate([np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)])
        corners = np.concatenate([corners[~is_long], halves])
        colours = np.concatenate([colours[~is_long], colours[is_long], colours[is_long]])
    return corners, colours


def _triangle_colours(mesh: Any, colour: Any) -> tuple[Any, Any]:
    """Red, green and blue of each triangle, shape (m, 3), and what a colour bar needs."""
    from matplotlib.cm import ScalarMappable  # type: ignore[import]
    from matplotlib.colors import Normalize, to_rgb  # type: ignore[import]

    if _is_colour(colour):
        return np.tile(to_rgb(_GREY if colour is None else colour), (len(mesh.triangles), 1)), None
    values = np.asarray(colour, dtype=np.float64)
    if values.shape == (len(mesh.vertices),):
        values = values[mesh.triangles].mean(axis=1)
    if values.shape != (len(mesh.triangles),):
        from .errors import UsageError

        raise UsageError(
            f"colours of the shape {values.shape}: one number for each of {len(mesh.vertices)} vertices or"
            f" {len(mesh.triangles)} triangles is expected"
        )
    known = np.isfinite(values)
    ends = (values[known].min(), values[known].max()) if known.any() else (0.0, 1.0)
    scale = ScalarMappable(norm=Normalize(*ends))
    return np.where(known[:, None], scale.to_rgba(values)[:, :3], _GREY), scale


def plot_mesh(mesh: Any, ax: Any, colour: Any, alpha: float, label: str) -> Any:
    """The triangles, shaded."""
    axes = _axes(ax)  # first, so that an error names matplotlib where it is not installed
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import]

    base, scale = _triangle_colours(mesh, colour)
    corners = mesh.vertices[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    corners, colours = _split(corners, np.clip(base * (0.72 + 0.28 * (normals @ _LIGHT))[:, None], 0, 1))
    drawn = Poly3DCollection(corners, facecolors=np.column_stack([colours, np.full(len(colours), alpha)]), linewidths=0)
    if alpha >= 1:  # lines of the same colour close the seams between triangles
        drawn.set_edgecolor(colours)
        drawn.set_linewidth(0.4)
    axes.add_collection3d(drawn)
    if scale is not None:
        axes.figure.colorbar(scale, ax=axes, shrink=0.6, label=label)
    if len(mesh.vertices):
        _fit(axes, mesh.vertices.min(axis=0), mesh.vertices.max(axis=0))
    return axes


def _draw_glass(ax: Any, mesh: Any) -> None:
    from ._mesh import as_mesh

    plot_mesh(as_mesh(mesh), ax, (0.5, 0.6, 0.7), 0.1, "")


def plot_points(centres: Any, values: Any, ax: Any, mesh: Any, label: str) -> Any:
    """Points coloured by a number each."""
    axes = _axes(ax)
    if mesh is not None:
        _draw_glass(axes, mesh)
    if label == "sheets":  # numbers, not amounts: neighbouring ones must differ, however many there are
        look = {"c": values % 10, "cmap": "tab10", "vmin": 0, "vmax": 9}
    else:
        look = {"c": values, "cmap": "viridis"}
    drawn = axes.scatter(centres[:, 0], centres[:, 1], centres[:, 2], s=2, **look)
    if label != "sheets":
        axes.figure.colorbar(drawn, ax=axes, shrink=0.6, label=label.replace("_", " "))
    if len(centres):
        _fit(axes, centres.min(axis=0), centres.max(axis=0))
    return axes


def plot_balls(centres: Any, radii: Any, ax: Any, colour: Any, mesh: Any) -> Any:
    """Balls as surfaces, coloured by radius unless a colour or numbers are given."""
    from matplotlib import colormaps
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    axes = _axes(ax)
    if mesh is not None:
        _draw_glass(axes, mesh)
    seen = radii > 0
    values = np.asarray(radii if colour is None else [] if _is_colour(colour) else colour, dtype=np.float64)
    if values.size and values.shape != radii.shape:
        from .errors import UsageError

        raise UsageError(f"colours of the shape {values.shape}: one number for each of {len(radii)} balls is expected")
    centres, radii = centres[seen], radii[seen]
    if len(radii) == 0:
        return axes
    quads = _sphere_quads(12 if len(radii) <= 200 else 6)
    faces = centres[:, None, None, :] + radii[:, None, None, None] * quads[None]
    shade = 0.66 + 0.34 * (quads.mean(axis=1) @ _LIGHT)
    if values.size:
        spread = max(float(np.ptp(values)), 1e-300)
        base = colormaps["viridis"]((values[seen] - values.min()) / spread)[:, :3]
    else:
        from matplotlib.colors import to_rgb

        base = np.tile(to_rgb(colour), (len(radii), 1))
    colours = np.clip(base[:, None, :] * shade[None, :, None], 0, 1).reshape(-1, 3)
    axes.add_collection3d(
        Poly3DCollection(faces.reshape(-1, 4, 3), facecolors=colours, edgecolors=colours, linewidths=0.4)
    )
    _fit(axes, (centres - radii[:, None]).min(axis=0), (centres + radii[:, None]).max(axis=0))
    return axes


def _sphere_quads(rings: int) -> Any:
    """The unit sphere as quadrangles, shape (m, 4, 3)."""
    polar, around = np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1)
    ring, turn = np.meshgrid(polar, around, indexing="ij")
    grid = np.stack([np.sin(ring) * np.cos(turn), np.sin(ring) * np.sin(turn), np.cos(ring)], axis=-1)
    quads = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=2)
    return quads.reshape(-1, 4, 3)


def plot_on_surface(mesh: Any, points: Any, values: Any, ax: Any, label: str) -> Any:
    """The mesh coloured by numbers at its vertices, or points."""
    if points.shape != mesh.vertices.shape or not np.array_equal(points, mesh.vertices):
        return plot_points(points, values, ax, mesh, label)
    return plot_mesh(mesh, ax, values, 1.0, label)


def plot_faces(points: Any, corners: Any, pairs: Any, ax: Any, meshes: Any, alpha: float) -> Any:
    """Faces of four corners, in a colour for each pair of numbers."""
    from types import SimpleNamespace

    axes = _axes(ax)
    from matplotlib import colormaps

    for mesh in meshes:
        _draw_glass(axes, mesh)
    triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]).astype(np.int64)
    known, number = np.unique(pairs, axis=0, return_inverse=True)
    number = np.tile(np.ravel(number), 2)
    for i in range(len(known)):
        used, own = np.unique(triangles[number == i], return_inverse=True)
        part = SimpleNamespace(vertices=points[used], triangles=np.reshape(own, (-1, 3)))
        plot_mesh(part, axes, colormaps["tab10"](i % 10)[:3], alpha, "")
    return axes
