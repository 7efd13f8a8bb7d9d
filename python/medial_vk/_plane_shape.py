"""Shapes in the plane: polygons with holes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _native
from ._results import Result
from .errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Literal, Union

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    #: A PlaneShape; one closed polygon, shape (n, 2), or a sequence of them; or an object with ``__geo_interface__``,
    #: such as a polygon of Shapely.
    ShapeLike = Union["PlaneShape", ArrayLike, Sequence[ArrayLike], Any]


class ShapeReport(Result):
    """What preparation of a shape found and changed."""

    rings: int  #: Given, those of fewer than three different points not counted.
    segments: int  #: Of the boundary, after all changes.
    merged_points: int  #: At the position of another one, or within the tolerance of it.
    degenerate_rings: int  #: Of fewer than three different points, left out.
    crossings: int  #: Points at which segments crossed, and are cut.
    touching_points: int  #: Points of one segment on another one, which is cut there.
    inner_segments: int  #: Left out: the inside, or the outside, lies on both sides of them.
    tolerance: float  #: No point was moved farther: 2^-44 of the longest side.
    area: float
    perimeter: float
    lower: NDArray[np.float64]  #: Corner of the bounding box, shape (2,).
    upper: NDArray[np.float64]  #: The opposite corner, shape (2,).
    assumptions: list[str]  #: Sentences for people.


class NearestOnBoundary(Result):
    """The nearest points of the boundary of a shape to n points."""

    points: NDArray[np.float64]  #: Shape (n, 2).
    directions: NDArray[np.float64]  #: Unit vectors to them, shape (n, 2).
    distances: NDArray[np.float64]  #: Shape (n,).
    inside: NDArray[np.bool_]  #: Shape (n,).


class CircleDecision(Result):
    """What Algorithm 4 of the source concludes from k points of a circle: samples, and the opposites of samples."""

    has_medial_point: bool  #: True: proved. False: no conclusion can be drawn.
    line: int  #: Of the algorithm, at which it is proved: 3, 8 or 13; 0: it is not.
    found: NDArray[np.uint32]  #: Two of the points, with a medial point between them; empty if it is not proved.
    points: NDArray[np.float64]  #: Counter-clockwise, shape (k, 2).
    feet: NDArray[np.float64]  #: Their nearest points of the boundary, shape (k, 2).
    directions: NDArray[np.float64]  #: Unit vectors to these, shape (k, 2).
    opposites: NDArray[np.uint32]  #: By point: the number of its opposite, shape (k,).


class PlaneShape:
    """A shape in the plane: polygons with holes, of any number of parts, cut where they cross. It never changes, so that
    any number of threads may use it.

    Args:
        rings: One closed polygon as an array of shape (n, 2), or a sequence of such arrays, of any unit. The last point
            is joined to the first. Or an object with ``__geo_interface__``, such as a polygon of Shapely or GeoPandas:
            the union of its polygons.
        fill: What is inside of rings that cross or overlap: "nonzero" (around which they wind) or "evenodd".
        threads: Of the host, 0: one per core. The shape does not depend on it.

    Raises:
        UsageError: Wrong shapes or types.
        InvalidMeshError: A coordinate that is not finite or beyond 1e150, or no ring that encloses anything.
    """

    def __init__(
        self, rings: ShapeLike, *, fill: Literal["nonzero", "evenodd"] = "nonzero", threads: int = 0
    ) -> None:
        self._native = _native.make_shape(_rings_of(rings), {"fill": fill, "threads": threads})

    @property
    def points(self) -> NDArray[np.float64]:
        """Those of the prepared boundary, shape (n, 2)."""
        return self._native.points()

    @property
    def segments(self) -> NDArray[np.uint32]:
        """Those of the prepared boundary by the indices of their points, shape (m, 2); the inside is on the left."""
        return self._native.segments()

    @property
    def report(self) -> ShapeReport:
        """What preparation found and changed."""
        return ShapeReport(**self._native.report())

    def nearest(self, points: ArrayLike) -> NearestOnBoundary:
        """The nearest points of the boundary to each point, shape (n, 2), in double precision, on one core."""
        values = self._native.nearest(points)
        values["inside"] = values["inside"].view(bool)
        return NearestOnBoundary(**values)

    def decide_circle(self, centre: ArrayLike, radius: float, samples: int | ArrayLike = 12) -> CircleDecision:
        """Whether a circle inside the shape contains a point of its medial axis, by Algorithm 4 of the source.

        Args:
            centre: Shape (2,).
            radius: In units of the shape.
            samples: Their number, or their angles in radians; at least three.

        Raises:
            UsageError: The circle is not inside the shape, or there are too few samples.
        """
        return CircleDecision(**self._native.decide_circle(centre, radius, samples))

    def plot(self, ax: Any = None) -> Any:
        """Draws the boundary with matplotlib; returns the axes.

        Args:
            ax: Axes of the plane; None: new ones.
        """
        from ._plane_plots import plot_shape

        return plot_shape(self, ax)

    def __repr__(self) -> str:
        report = self.report
        return f"<PlaneShape of {report.segments} segments, area {report.area:.6g}>"


def as_shape(shape: ShapeLike) -> PlaneShape:
    """The shape itself, or one made of rings."""
    return shape if isinstance(shape, PlaneShape) else PlaneShape(shape)


def _rings_of(shape: Any) -> list[Any]:
    geometry = getattr(shape, "__geo_interface__", None)
    if geometry is not None:
        return _rings_of_geometry(geometry)
    import numpy as np

    if isinstance(shape, memoryview):
        shape = np.asarray(shape)  # its rows cannot be taken
    try:
        rings = list(shape)
    except TypeError:
        raise UsageError(f"{type(shape).__name__} is no shape: rings of shape (n, 2) are expected") from None
    try:
        is_ring = len(rings) > 0 and np.ndim(rings[0]) == 1
    except (TypeError, ValueError):
        is_ring = False  # its reader says what is wrong with it
    return [shape] if is_ring else rings


def _rings_of_geometry(geometry: Any) -> list[Any]:
    """Of GeoJSON objects: outer rings counter-clockwise and holes clockwise, so that they wind around their union."""
    try:
        if geometry["type"] == "FeatureCollection":
            return [ring for feature in geometry["features"] for ring in _rings_of_geometry(feature["geometry"])]
        if geometry["type"] == "Feature":
            return _rings_of_geometry(geometry["geometry"])
        if geometry["type"] == "GeometryCollection":
            return [ring for member in geometry["geometries"] for ring in _rings_of_geometry(member)]
        if geometry["type"] == "Polygon":
            return [_turned(ring, hole > 0) for hole, ring in enumerate(geometry["coordinates"])]
        if geometry["type"] == "MultiPolygon":
            polygons = geometry["coordinates"]
            return [_turned(ring, hole > 0) for polygon in polygons for hole, ring in enumerate(polygon)]
        kind = geometry["type"]
    except (KeyError, TypeError, IndexError, ValueError) as error:
        raise UsageError(f"`__geo_interface__` is no geometry of GeoJSON: {error!r}") from None
    raise UsageError(f"a {kind} encloses nothing: polygons are expected")


def _turned(ring: Any, is_hole: bool) -> Any:
    import numpy as np

    points = np.asarray(ring, dtype=np.float64)[:, :2]  # without heights
    x, y = (points - points[:1]).T
    area = float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
    return points[::-1] if (area > 0) == is_hole else points
