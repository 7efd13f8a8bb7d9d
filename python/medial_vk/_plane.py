"""The medial axis of shapes in the plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _native
from ._plane_shape import PlaneShape, as_shape
from ._progress import shown
from ._results import Result

if TYPE_CHECKING:
    from typing import Literal

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._plane_shape import ShapeLike
    from ._progress import Progress

#: Why a node of an axis is one, by its number in arrays: equally far from three contacts or more, a corner of the
#: boundary, a point beyond which the thresholds are not passed, or one at the border of the box that was searched.
AXIS_NODE_KINDS = ("meeting", "corner", "threshold", "border")
#: What an arc is equally far from, by its number in arrays.
PLANE_CURVE_KINDS = ("points", "point_and_segment", "segments")


class AxisNodes(Result):
    """n points at which arcs end."""

    points: NDArray[np.float64]  #: Shape (n, 2).
    radii: NDArray[np.float64]  #: Distances to the boundary, or to the nearest site.
    object_angles: NDArray[np.float64]  #: The greatest between two of its contacts, radians.
    kinds: NDArray[np.uint8]  #: Indices into ``AXIS_NODE_KINDS``.
    degrees: NDArray[np.uint32]  #: Numbers of arcs that end there: 1 at ends, 3 or more at junctions.

    def __len__(self) -> int:
        return len(self.radii)


class AxisArcs(Result):
    """m lines and parabolas of points that are equally far from two contacts, each with a parameter t: the distance
    from its apex along a straight line. ``PlaneAxis.at()`` evaluates them."""

    nodes: NDArray[np.uint32]  #: The ends, shape (m, 2).
    t: NDArray[np.float64]  #: Parameters of these, ascending, shape (m, 2).
    contacts: NDArray[np.uint32]  #: Indices of points or segments of the shape, shape (m, 2).
    contact_is_point: NDArray[np.bool_]  #: Which of both, shape (m, 2).
    kinds: NDArray[np.uint8]  #: Indices into ``PLANE_CURVE_KINDS``.
    origins: NDArray[np.float64]  #: Shape (m, 2).
    along: NDArray[np.float64]  #: Unit vectors, shape (m, 2).
    up: NDArray[np.float64]  #: Unit vectors from the segment to the point, of parabolas, shape (m, 2).
    focus: NDArray[np.float64]  #: Half the distance of two points; the distance of a point from the line of a segment.
    radii: NDArray[np.float64]  #: Of two segments: the radius at t is radii + slopes t.
    slopes: NDArray[np.float64]
    object_angles: NDArray[np.float64]  #: Of two segments, radians.

    def __len__(self) -> int:
        return len(self.kinds)


class AxisBranches(Result):
    """b branches: arcs in a row between two junctions or ends."""

    ends: NDArray[np.uint32]  #: Nodes, shape (b, 2); those of a loop without a junction are the same.
    lengths: NDArray[np.float64]  #: In units of the shape.
    significance: NDArray[np.float64]  #: Erosion thickness; NaN unless one end is free.
    first: NDArray[np.uint64]  #: The arcs of branch i are ``arcs[first[i]:first[i + 1]]``, shape (b + 1,).
    arcs: NDArray[np.uint32]
    reversed: NDArray[np.bool_]  #: By element of ``arcs``: passed from its second node to its first.

    def __len__(self) -> int:
        return len(self.lengths)


class AxisLine(Result):
    """k points of an axis."""

    points: NDArray[np.float64]  #: Shape (k, 2).
    radii: NDArray[np.float64]  #: Distances to the boundary, or to the nearest site.
    object_angles: NDArray[np.float64]  #: Radians.

    def __len__(self) -> int:
        return len(self.radii)


class PlaneAxis(Result):
    """The medial axis of a shape in the plane as a graph of exact lines and parabolas, in units of the shape."""

    shape: PlaneShape | None  #: None of curves between sites.
    nodes: AxisNodes
    arcs: AxisArcs
    branches: AxisBranches
    junctions: int  #: Nodes of three arcs or more.
    epsilon: float  #: Arcs and the exact axis are within this distance of each other.
    excess: float  #: After ``longest_paths()``: no path is longer than the one that was found by more than this.
    cells: int  #: Of the partition of the plane by which it was found.
    _native: _native.PlaneAxis

    @property
    def length(self) -> float:
        """Of all branches."""
        return float(self.branches.lengths.sum())

    def prune(self, length: float = 0.0, significance: float = 0.0) -> PlaneAxis:
        """The axis without short or insignificant branches. Its parts keep their connections and loops.

        Args:
            length: Branches stay from which the way outwards to an end is at least that long, in units of the shape.
            significance: Then, branches of at least this erosion thickness stay. Each point of a disc that is lost is
                within this distance of a disc that is left.

        Raises:
            UsageError: A number that is negative or not finite.
        """
        return _axis_of(self._native.pruned(length, significance), self.shape)

    def longest_paths(self) -> PlaneAxis:
        """A centre line: for each part of the axis the longest of the shortest paths between two ends."""
        native, excess = self._native.longest_paths()
        return _axis_of(native, self.shape, excess)

    def lines(self, *, step: float = 0.0, smooth: float = 0.0) -> list[AxisLine]:
        """Each branch as a polyline from its first end to its second.

        Args:
            step: Points and radii on the polyline are within this of those of the branch, in units of the shape; 0:
                1e-4 of the longest side. It is at least 1e-9 of that.
            smooth: Average points along the length by a Gaussian of this standard deviation, in units of the shape. Ends
                stay, no point moves by more than half its radius, and the radius becomes smaller by that.
        """
        return [AxisLine(**line) for line in self._native.lines(step, smooth)]

    def at(self, arcs: ArrayLike, t: ArrayLike) -> AxisLine:
        """Points of the curves of k arcs at parameters, which may lie beyond the ends of the arcs.

        Args:
            arcs: Indices, shape (k,).
            t: Parameters, shape (k,).
        """
        return AxisLine(**self._native.at(arcs, t))

    def plot(self, ax: Any = None, *, colour: Literal["radii", "object_angles"] = "radii", discs: int = 0) -> Any:
        """Draws boundary and branches with matplotlib; returns the axes.

        Args:
            ax: Axes of the plane; None: new ones.
            colour: The field of ``AxisLine`` that colours show.
            discs: Also draw about this number of medial discs.
        """
        from ._plane_plots import plot_axis

        return plot_axis(self, ax, colour, discs)


class PublishedAxis(Result):
    """Points of the medial axis, found as Chapter 4 of the source publishes it, in units of the shape."""

    points: NDArray[np.float64]  #: Shape (n, 2).
    radii: NDArray[np.float64]
    feet_a: NDArray[np.float64]  #: Ends of the first spokes, shape (n, 2).
    feet_b: NDArray[np.float64]  #: Of the second: estimates (Lemma 2.4 of the source).
    object_angles: NDArray[np.float64]  #: Radians.
    discs: int
    undetermined: int  #: Discs for which Algorithm 4 draws no conclusion.
    decided: tuple[int, int, int]  #: Discs with a medial point, by the line of the algorithm: 3, 8 and 13.
    samples: int  #: Of each circle.
    missed_angle: float  #: Every medial point with a larger object angle, and at least ``missed_radius``, lies in a disc
    #: that is decided.
    missed_radius: float

    def __len__(self) -> int:
        return len(self.radii)


def plane_axis(
    shape: ShapeLike,
    *,
    side: Literal["inside", "outside", "both"] = "inside",
    object_angle: float = 0.6,
    radius: float = 0.0,
    margin: float = 0.0,
    threads: int = 0,
    progress: Progress = None,
) -> PlaneAxis:
    """The exact medial axis of a shape in the plane (docs/theory.md, "In the plane"). No device is needed.

    Args:
        shape: A ``PlaneShape``, or what ``PlaneShape()`` accepts.
        side: Of the boundary.
        object_angle: Least half angle between the directions to both contacts, radians, 0 to pi / 2.
        radius: Points of at least this radius need an object angle of 0.15 only, in units of the shape; 0: off.
        margin: Outside, the square around the box is searched that reaches this far beyond it, in units of the shape;
            0: half the longest side.
        threads: Of the host, 0: one per core. The result does not depend on it.
        progress: A function of the stage's name and its share, or True for a bar.

    Raises:
        UsageError: An argument is out of range.
    """
    of = as_shape(shape)
    options = {"side": side, "object_angle": object_angle, "radius": radius, "margin": margin, "threads": threads}
    with shown(progress) as callback:
        return _axis_of(_native.find_plane_axis(of._native, options, callback), of)


def plane_axis_as_published(
    shape: ShapeLike,
    *,
    object_angle: float = 0.6,
    radius: float = 0.0,
    samples: int = 0,
    largest_disc: float = 0.0,
    least_disc: float = 0.0,
    epsilon: float = 0.0,
    threads: int = 0,
    progress: Progress = None,
) -> PublishedAxis:
    """Points of the medial axis inside a shape as Section 4.4 of the source publishes it: Algorithm 4 on overlapping
    discs, and bisection in those that hold a medial point.

    Args:
        shape: A ``PlaneShape``, or what ``PlaneShape()`` accepts.
        object_angle, radius: As of ``plane_axis()``.
        samples: Of each circle, at least 6; 0: as many as are proved to miss no point of that object angle.
        largest_disc: Its radius, in units of the shape; 0: a 50th of the longest side.
        least_disc: No disc is smaller than half of it; 0: a 16th of the largest.
        epsilon: Greatest distance of a point from the medial axis; 0: 2^-30 of the longest side.
        threads: Of the host, 0: one per core. The result does not depend on it.

    Raises:
        UsageError: An argument is out of range.
    """
    options = {
        "object_angle": object_angle,
        "radius": radius,
        "samples": samples,
        "largest_disc": largest_disc,
        "least_disc": least_disc,
        "epsilon": epsilon,
        "threads": threads,
    }
    with shown(progress) as callback:
        return PublishedAxis(**as_shape(shape)._native.axis_as_published(options, callback))


def axis_fields(native: _native.PlaneAxis) -> dict[str, Any]:
    """Those of ``PlaneAxis`` that the library gives."""
    values = native.results()
    arcs, branches = values.pop("arcs"), values.pop("branches")
    arcs["contact_is_point"] = arcs["contact_is_point"].view(bool)
    branches["reversed"] = branches["reversed"].view(bool)
    nodes = AxisNodes(**values.pop("nodes"))
    return {"nodes": nodes, "arcs": AxisArcs(**arcs), "branches": AxisBranches(**branches), "_native": native, **values}


def _axis_of(native: _native.PlaneAxis, shape: PlaneShape | None, excess: float = 0.0) -> PlaneAxis:
    return PlaneAxis(shape=shape, excess=excess, **axis_fields(native))
