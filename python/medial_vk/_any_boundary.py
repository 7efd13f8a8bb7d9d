"""Medial spheres of a boundary that a function knows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _native
from ._analysis import MedialSpheres, Sheets, UndecidedVoxels, VoxelGrid, sheets_of
from ._balls import Balls
from ._progress import shown
from ._results import Result

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Literal

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._progress import Progress


class BoundaryAnalysis(Result):
    """The result of ``analyse_boundary()``, in units of the points. No point of the boundary is in an open ball."""

    grid: VoxelGrid
    spheres: MedialSpheres  #: Spokes lead to the two boundary points between which the search ended, the nearer one first.
    axis_distances: NDArray[np.float64]  #: By sphere: a point of the medial axis is within this of the centre, proved.
    undecided: UndecidedVoxels  #: Of kind "boundary": medial points there have radii below the side of a voxel.
    sheets: Sheets | None
    queries: int  #: Points for which the nearest one was requested.

    @property
    def balls(self) -> Balls:
        """Centres and radii of the spheres."""
        return Balls(centres=self.spheres.centres, radii=self.spheres.radii)

    def __len__(self) -> int:
        return len(self.spheres)

    def plot(self, ax: Any = None, *, colour: str = "object_angles") -> Any:
        """Draws the medial points with matplotlib; returns the axes.

        Args:
            ax: Axes of projection "3d"; None: new ones.
            colour: A field of ``spheres`` with one number each: "object_angles", "radii", "sheets" or "flux".
        """
        from ._plots import plot_points

        return plot_points(self.spheres.centres, getattr(self.spheres, colour), ax, None, colour)


def analyse_boundary(
    nearest: Callable[[NDArray[np.float64]], ArrayLike],
    lower: ArrayLike,
    upper: ArrayLike,
    *,
    contains: Callable[[NDArray[np.float64]], ArrayLike] | None = None,
    error: float = 0.0,
    resolution: int = 40,
    object_angle: float = 0.6,
    radius: float = 0.0,
    mode: Literal["certified", "thesis"] = "certified",
    deep_angle: float = 0.15,
    epsilon: float = 0.01,
    extra_levels: int = 3,
    sheets: bool = True,
    threads: int = 0,
    progress: Progress = None,
) -> BoundaryAnalysis:
    """Finds medial spheres of any closed set S of points of space by its nearest points alone: an analytic solid, a cloud of
    points, an implicit surface (docs/theory.md, "Any boundary"). No device is needed.

    Args:
        nearest: A function of points, shape (n, 3), that returns for each a point of S nearest to it, shape (n, 3). It
            must be valid within three diagonals of the box, and give the same answers whenever it is called.
        lower, upper: Opposite corners of the box in which centres are searched for, shape (3,).
        contains: A function of points, shape (n, 3), that returns whether each is inside, shape (n,); it may change only
            across S. None: all of the box is searched.
        error: Answers are within this distance of S, and no farther than the nearest point by more; at most
            epsilon (1 - cos object_angle) / 2 voxel sides, with ``deep_angle`` in its place if there is a radius.
        resolution: Voxels along the longest side of the box, 1 to 4096.
        object_angle, radius, mode, deep_angle, epsilon: As of ``analyse()``; ``radius`` is a fraction of the box.
        extra_levels: Levels of subdivision below the finest voxel, 0 to 10; at object angles below 0.6 more are useful.
        sheets: Group the spheres into sheets.
        threads: Of the host, 0: one per core. The result does not depend on it. They call both functions, one at a time
            where these do not release the interpreter's lock; with 1, one thread does.
        progress: A function of the stage's name and its share, or True for a bar.

    Raises:
        UsageError: An argument is out of range, an answer has another shape, is not finite, or too far away.

    An exception of either function ends the call and leaves it.
    """
    options = {
        "mode": mode,
        "resolution": resolution,
        "object_angle": object_angle,
        "radius": radius,
        "deep_angle": deep_angle,
        "epsilon": epsilon,
        "extra_levels": extra_levels,
        "error": error,
        "sheets": sheets,
        "threads": threads,
    }
    with shown(progress) as callback:
        values = _native.search_boundary(nearest, contains, lower, upper, options, callback)
    return BoundaryAnalysis(
        grid=VoxelGrid(**values.pop("grid")),
        spheres=MedialSpheres(**values.pop("spheres")),
        undecided=UndecidedVoxels(**values.pop("undecided")),
        sheets=sheets_of(values.pop("sheets")),
        **values,
    )
