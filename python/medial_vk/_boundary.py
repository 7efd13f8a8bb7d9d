"""Thickness and curvature of the boundary."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _native
from ._balls import as_arrays
from ._mesh import Mesh, as_mesh
from ._progress import shown
from ._results import Result

if TYPE_CHECKING:
    from typing import Literal

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._analysis import Analysis
    from ._balls import BallsLike
    from ._mesh import MeshLike
    from ._progress import Progress

#: What limits the ball at a point, by its number in arrays.
THICKNESS_KINDS = ("none", "facets", "crease", "corner", "wall")
#: What is known of a curvature, by its number in arrays: both values, from fits or differences along a sheet, in the first
#: two states; "curve" has one, "point" both of a sphere, and "exposed" those of a fit or none.
CURVATURE_STATES = (
    "known",
    "cut",
    "curve",
    "point",
    "seam",
    "few",
    "nested",
    "focal",
    "uncertain",
    "exposed",
    "edge",
)


class ThicknessHistogram(Result):
    """Shares of points by thickness, in b bins: where both agree, the thickness is known to the width of a bin."""

    edges: NDArray[np.float64]  #: Of the bins, from 0 to the greatest upper end, shape (b + 1,).
    by_lower_ends: NDArray[np.float64]  #: Of the intervals that hold the thickness, shape (b,).
    by_upper_ends: NDArray[np.float64]  #: Shape (b,).


class Thickness(Result):
    """Thickness at n points, in units of the mesh."""

    lower: NDArray[np.float64]  #: Of the interval that is proved to hold the thickness, or the limit, if that is less.
    upper: NDArray[np.float64]  #: Shape (n,).
    centres: NDArray[np.float64]  #: Of balls whose diameters are ``lower``, shape (n, 3).
    radii: NDArray[np.float64]  #: 0: no ball was found.
    object_angles: NDArray[np.float64]  #: Half the greatest angle between normals at contacts, radians.
    contacts_a: NDArray[np.float64]  #: These contacts, shape (n, 3).
    contacts_b: NDArray[np.float64]
    kinds: NDArray[np.uint8]  #: Indices into ``THICKNESS_KINDS``.
    points: NDArray[np.float64]  #: Where it was measured, shape (n, 3).
    mesh: Mesh

    @property
    def in_walls(self) -> NDArray[np.bool_]:
        """By point: whether a wall, with opposite sides, limits the ball."""
        return self.kinds == THICKNESS_KINDS.index("wall")  # type: ignore[no-any-return]

    def histogram(self, bins: int = 50) -> ThicknessHistogram:
        """Shares of the points by thickness, in bins of equal width: of the area, if it was measured at the points of
        ``Mesh.sample()``.

        Raises:
            UsageError: Not one bin at least.
        """
        import numpy as np

        if bins < 1:
            from .errors import UsageError

            raise UsageError(f"`bins` is {bins}, not 1 or more")
        greatest = float(self.upper.max(initial=0.0)) or 1.0

        def shares(ends: NDArray[np.float64]) -> NDArray[np.float64]:
            of = np.minimum((bins * ends / greatest).astype(np.int64), bins - 1)
            return np.bincount(of, minlength=bins) / max(len(ends), 1)

        return ThicknessHistogram(
            edges=greatest * np.arange(bins + 1) / bins,
            by_lower_ends=shares(self.lower),
            by_upper_ends=shares(self.upper),
        )

    def plot(self, ax: Any = None) -> Any:
        """Draws the mesh coloured by thickness, if it was measured at its vertices, else the points; returns the
        axes of matplotlib."""
        from ._plots import plot_on_surface

        return plot_on_surface(self.mesh, self.points, self.lower, ax, "thickness")


class WallBall(Result):
    """A medial ball in a wall."""

    centre: NDArray[np.float64]  #: Shape (3,).
    radius: float
    contacts: NDArray[np.float64]  #: Shape (2, 3).
    object_angle: float  #: Radians.


class LeastWall(Result):
    """The thinnest wall of a solid, or the narrowest gap outside it."""

    lower: float  #: No medial ball with the object angle has a smaller diameter, by proof; the limit, if that is less.
    upper: float
    thinnest: WallBall | None  #: The ball of the upper end.
    cells: int  #: Examined.


class Curvature(Result):
    """Curvature of the boundary at n places, in 1 / units of the mesh. Unknown numbers are NaN."""

    states: NDArray[np.uint8]  #: Indices into ``CURVATURE_STATES``.
    normals: NDArray[np.float64]  #: Outward, shape (n, 3).
    kappa: NDArray[np.float64]  #: Principal curvatures, the greater first, positive where convex, shape (n, 2).
    directions_1: NDArray[np.float64]  #: Unit vectors of the first principal direction, shape (n, 3).
    directions_2: NDArray[np.float64]  #: Of the second; in the state "curve" the tangent of the medial curve alone.
    errors: NDArray[np.float64]  #: Estimates of the errors of ``kappa``, no bounds, shape (n,).

    @property
    def known(self) -> NDArray[np.bool_]:
        """By place: whether both curvatures are known from fits or differences (states "known" and "cut")."""
        return self.states <= CURVATURE_STATES.index("cut")

    @property
    def mean(self) -> NDArray[np.float64]:
        """Mean curvatures."""
        return self.kappa.mean(axis=1)  # type: ignore[no-any-return]

    @property
    def gaussian(self) -> NDArray[np.float64]:
        """Gaussian curvatures."""
        return self.kappa.prod(axis=1)  # type: ignore[no-any-return]


class TipCurvature(Curvature):
    """Curvature of the boundary at one tip of each ball."""

    normal_errors: NDArray[np.float64]  #: Estimates of the errors of the normals, radians.
    windows: NDArray[np.float64]  #: Radii of the windows of the fits.


class BallCurvature(Result):
    """Curvature of the boundary at the two tips of each ball."""

    tip_a: TipCurvature
    tip_b: TipCurvature
    object_angles: NDArray[np.float64]  #: Half the angles between the spokes, radians.
    spacing: float  #: Of neighbouring balls along a sheet, as given or estimated.
    _native: _native.Curvature

    def at_vertices(
        self,
        mesh: MeshLike,
        *,
        assignment: Literal["along_surface", "voronoi"] = "along_surface",
        object_angle: float = 0.0,
        threads: int = 0,
        progress: Progress = None,
    ) -> Curvature:
        """Curvature at the vertices of the mesh around the balls.

        Args:
            mesh: In the same units.
            assignment: "along_surface", or "voronoi": Section 5.4.3 of the source.
            object_angle: Least one of the search that found the balls, radians; 0: that of the balls.
        """
        options = {"assignment": assignment, "object_angle": object_angle, "threads": threads}
        with shown(progress) as callback:
            return Curvature(**self._native.at_vertices(as_mesh(mesh)._native, options, callback))


def thickness(
    mesh: MeshLike,
    points: ArrayLike | None = None,
    *,
    side: Literal["walls", "gaps"] = "walls",
    delta: float = 0.0,
    width: float = 0.02,
    limit: float = 0.0,
    patience: int = 50,
    queries: int = 1000,
    wall_angle: float = 1.2,
    crease_angle: float = 0.25,
    threads: int = 0,
    progress: Progress = None,
) -> Thickness:
    """The thickness of a solid's walls at points of its boundary: the diameter of the largest ball inside that comes
    within ``delta`` of the point, in a proved interval.

    Args:
        mesh: A ``Mesh``, or an object that ``Mesh()`` accepts.
        points: Shape (n, 3); None: the vertices.
        side: "walls", or "gaps" for balls outside.
        delta: In units of the mesh; 0: a two-thousandth of the longest side.
        width: Of an interval, relative to its lower end.
        limit: Balls are not searched for beyond this diameter; 0: the longest side.
        patience: Distances for a point, after which an interval of four times the width is enough.
        queries: Distances that may be computed for a point; then its interval is left wider.
        wall_angle, crease_angle: Object angles that distinguish kinds, radians.

    Raises:
        UsageError: An argument is out of range, or a point is not finite.
    """
    of = as_mesh(mesh)
    at: Any = of.vertices if points is None else points
    options = {
        "side": side,
        "delta": delta,
        "width": width,
        "limit": limit,
        "patience": patience,
        "queries": queries,
        "wall_angle": wall_angle,
        "crease_angle": crease_angle,
        "threads": threads,
    }
    with shown(progress) as callback:
        values = _native.measure_thickness(of._native, at, options, callback)
    return Thickness(mesh=of, **values)


def least_wall(
    mesh: MeshLike,
    *,
    side: Literal["walls", "gaps"] = "walls",
    object_angle: float = 1.2,
    width: float = 0.01,
    limit: float = 0.0,
    cells: int = 1 << 21,
    threads: int = 0,
    progress: Progress = None,
) -> LeastWall:
    """The thinnest wall of a closed mesh, or the narrowest gap outside it, with a proof.

    Args:
        mesh: Closed.
        side: "walls" or "gaps".
        object_angle: Of a ball in a wall, radians, between pi / 4 and pi / 2.
        width: Of the interval, relative to its lower end.
        limit: Walls that are not thinner are not searched for; 0: the longest side.
        cells: That may be examined; then the interval is left wider.
    """
    options = {
        "side": side,
        "object_angle": object_angle,
        "width": width,
        "limit": limit,
        "cells": cells,
        "threads": threads,
    }
    with shown(progress) as callback:
        values = _native.measure_least_wall(as_mesh(mesh)._native, options, callback)
    ball = values.pop("thinnest")
    return LeastWall(thinnest=None if ball is None else WallBall(**ball), **values)


def curvature(
    balls: BallsLike | Analysis,
    spokes: tuple[ArrayLike, ArrayLike] | None = None,
    *,
    method: Literal["fits", "differences"] = "fits",
    spacing: float = 0.0,
    step: float = 6.0,
    smooth: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> BallCurvature:
    """Curvature of the boundary from medial balls alone (Chapter 5 of the source).

    Args:
        balls: An ``Analysis``, whose spokes and voxel size are used, or balls.
        spokes: Unit vectors to the two contacts, each of shape (n, 3); they decide which tip is the first.
        method: "fits" or "differences", which requires spokes.
        spacing: Of neighbouring balls along a sheet; 0: that of the analysis, else estimated.
        step: Method "differences": as a multiple of the spacing.
        smooth: Method "differences": average the spokes of neighbours first.

    Raises:
        UsageError: A radius that is not positive, a spoke that is not of unit length, an option out of range.
    """
    from ._analysis import Analysis as Found

    if isinstance(balls, Found):
        spokes = (balls.spheres.spokes_a, balls.spheres.spokes_b) if spokes is None else spokes
        spacing = spacing or balls.grid.voxel_size
        balls = balls.balls
    options = {"method": method, "spacing": spacing, "step": step, "smooth": smooth, "threads": threads}
    spokes_a, spokes_b = spokes if spokes is not None else (None, None)
    with shown(progress) as callback:
        native = _native.measure_curvature(*as_arrays(balls), spokes_a, spokes_b, options, callback)
    return BallCurvature(
        tip_a=TipCurvature(**native.tips(0)),
        tip_b=TipCurvature(**native.tips(1)),
        object_angles=native.object_angles(),
        spacing=native.spacing(),
        _native=native,
    )
