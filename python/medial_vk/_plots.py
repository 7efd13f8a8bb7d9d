"""Plots with matplotlib, which is imported when one is drawn."""

from __future__ import annotations

from typing import Any

import numpy as np


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt  # type: ignore[import]

    return plt.figure(figsize=(6, 6)).add_subplot(projection="3d")


def _fit(ax: Any, lower: Any, upper: Any) -> None:
    """Equal scales on all axes."""
    middle, reach = (lower + upper) / 2, max(float(np.max(upper - lower)) / 2, 1e-300)
    ax.set_xlim(middle[0] - reach, middle[0] + reach)
    ax.set_ylim(middle[1] - reach, middle[1] + reach)
    ax.set_zlim(middle[2] - reach, middle[2] + reach)
    ax.set_box_aspect((1, 1, 1))


def _draw_mesh(ax: Any, mesh: Any) -> None:
    from ._mesh import as_mesh

    of = as_mesh(mesh)
    corners = of.vertices
    ax.plot_trisurf(
        corners[:, 0], corners[:, 1], corners[:, 2], triangles=of.triangles, color=(0.5, 0.6, 0.7, 0.08), linewidth=0
    )


def plot_points(centres: Any, values: Any, ax: Any, mesh: Any, label: str) -> Any:
    """Points coloured by a number each."""
    axes = _axes(ax)
    if mesh is not None:
        _draw_mesh(axes, mesh)
    drawn = axes.scatter(
        centres[:, 0], centres[:, 1], centres[:, 2], c=values, s=2, cmap="tab20" if label == "sheets" else "viridis"
    )
    axes.figure.colorbar(drawn, ax=axes, shrink=0.6, label=label.replace("_", " "))
    around = mesh.vertices if mesh is not None else centres
    if len(around):
        _fit(axes, around.min(axis=0), around.max(axis=0))
    return axes


def plot_balls(centres: Any, radii: Any, ax: Any, colour: Any, mesh: Any) -> Any:
    """Balls as surfaces, coloured by radius unless a colour is given."""
    from matplotlib import colormaps
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import]

    axes = _axes(ax)
    if mesh is not None:
        _draw_mesh(axes, mesh)
    seen = radii > 0
    centres, radii = centres[seen], radii[seen]
    if len(radii) == 0:
        return axes
    quads = _sphere_quads(12 if len(radii) <= 200 else 6)
    faces = centres[:, None, None, :] + radii[:, None, None, None] * quads[None]
    shade = 0.55 + 0.45 * (quads.mean(axis=1) @ np.array([0.4, -0.5, 0.77]))
    if colour is None:
        spread = max(float(np.ptp(radii)), 1e-300)
        base = colormaps["viridis"]((radii - radii.min()) / spread)[:, :3]
    else:
        from matplotlib.colors import to_rgb  # type: ignore[import]

        base = np.tile(to_rgb(colour), (len(radii), 1))
    colours = np.clip(base[:, None, :] * shade[None, :, None], 0, 1)
    axes.add_collection3d(Poly3DCollection(faces.reshape(-1, 4, 3), facecolors=colours.reshape(-1, 3), linewidths=0))
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
    vertices = mesh.vertices
    if points.shape != vertices.shape or not np.array_equal(points, vertices):
        return plot_points(points, values, ax, mesh, label)
    axes = _axes(ax)
    drawn = axes.plot_trisurf(
        vertices[:, 0], vertices[:, 1], vertices[:, 2], triangles=mesh.triangles, cmap="viridis", linewidth=0
    )
    drawn.set_array(values[mesh.triangles].mean(axis=1))
    axes.figure.colorbar(drawn, ax=axes, shrink=0.6, label=label)
    _fit(axes, vertices.min(axis=0), vertices.max(axis=0))
    return axes
