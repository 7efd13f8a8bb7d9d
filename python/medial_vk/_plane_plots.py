"""Plots in the plane with matplotlib, which is imported when one is drawn."""

from __future__ import annotations

from typing import Any

import numpy as np

from .errors import UsageError

_GREY = (0.45, 0.48, 0.52)


def _axes(ax: Any) -> Any:
    if ax is None:
        import matplotlib.pyplot as plt  # type: ignore[import]

        ax = plt.figure(figsize=(6, 6)).add_subplot()
    elif hasattr(ax, "set_zlim"):
        raise UsageError("`ax` has the projection 3d; axes of the plane are expected")
    ax.set_aspect("equal", adjustable="datalim")
    return ax


def _draw_segments(ax: Any, pairs: Any, **look: Any) -> Any:
    from matplotlib.collections import LineCollection  # type: ignore[import]

    drawn = ax.add_collection(LineCollection(pairs, **look))
    ax.autoscale_view()
    return drawn


def plot_shape(shape: Any, ax: Any) -> Any:
    """The boundary."""
    axes = _axes(ax)
    _draw_segments(axes, shape.points[shape.segments], colors=[_GREY], linewidths=1.2)
    return axes


def _draw_discs(ax: Any, lines: list[Any], count: int) -> None:
    """Of points at equal distances along all lines."""
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Circle  # type: ignore[import]

    steps = [np.linalg.norm(np.diff(line.points, axis=0), axis=1) for line in lines]
    total = float(sum(step.sum() for step in steps))
    if total <= 0:
        return
    circles = []
    for line, step in zip(lines, steps):
        at = np.concatenate([[0.0], np.cumsum(step)])
        places = np.arange(0.5, max(round(count * at[-1] / total), 1)) / max(round(count * at[-1] / total), 1) * at[-1]
        x, y, radius = (np.interp(places, at, values) for values in (*line.points.T, line.radii))
        circles += [Circle(centre, r) for centre, r in zip(np.column_stack([x, y]), radius)]
    ax.add_collection(PatchCollection(circles, facecolors="none", edgecolors=[(0.3, 0.5, 0.7, 0.35)], linewidths=0.7))


def plot_axis(axis: Any, ax: Any, colour: str, discs: int) -> Any:
    """Boundary and branches, coloured by a number along them."""
    if colour not in ("radii", "object_angles"):
        raise UsageError(f'`colour` is "{colour}", not one of: radii, object_angles')
    axes = _axes(ax)
    if axis.shape is not None:
        plot_shape(axis.shape, axes)
    lines = axis.lines()
    if discs > 0:
        _draw_discs(axes, lines, discs)
    pairs = [np.stack([line.points[:-1], line.points[1:]], axis=1) for line in lines]
    values = [(getattr(line, colour)[:-1] + getattr(line, colour)[1:]) / 2 for line in lines]
    if lines:
        drawn = _draw_segments(axes, np.concatenate(pairs), array=np.concatenate(values), cmap="viridis", linewidths=2)
        axes.figure.colorbar(drawn, ax=axes, shrink=0.6, label=colour.replace("_", " "))
    alone = axis.nodes.degrees == 0
    if alone.any():
        axes.scatter(*axis.nodes.points[alone].T, s=12, color=[_GREY])
    return axes
