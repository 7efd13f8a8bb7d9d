"""Distances and collisions of solids in many poses, with proofs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from . import _native
from ._balls import Balls, as_arrays
from ._mesh import as_mesh
from ._results import Result

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._balls import BallsLike
    from ._mesh import MeshLike

#: The verdicts of collisions, by their numbers in arrays.
VERDICTS = ("free", "hit", "undecided")


class Body:
    """A solid for queries of distances: its mesh, balls inside it and balls that cover it. It never changes, so that any
    number of threads may query it.

    Args:
        mesh: For exact distances; None: balls alone.
        inside: Balls inside the solid, for upper bounds, such as ``fit_spheres(mesh, 500)``.
        cover: Balls that cover it, for lower bounds, such as ``fit_spheres(mesh, 500, contract="cover")``.

    Raises:
        UsageError: A ball whose numbers are not finite; nothing is given; balls inside a mesh that is not closed.

    The bounds hold if the balls inside are inside and the covers cover: ``prove_spheres()`` tests balls from elsewhere.
    """

    def __init__(
        self,
        mesh: MeshLike | None = None,
        inside: BallsLike | None = None,
        cover: BallsLike | None = None,
        *,
        threads: int = 0,
    ) -> None:
        self._mesh = None if mesh is None else as_mesh(mesh)
        if self._mesh is None:
            self._native = _native.body_of_balls(*as_arrays(inside), *as_arrays(cover))
        else:
            self._native = _native.body_of_mesh(self._mesh._native, *as_arrays(inside), *as_arrays(cover), threads)

    @property
    def inside(self) -> Balls:
        """The balls inside, to which pairs refer."""
        return Balls(**self._native.inside())

    @property
    def cover(self) -> Balls:
        """The balls of the cover, to which pairs refer."""
        return Balls(**self._native.cover())

    @property
    def has_mesh(self) -> bool:
        """Whether distances by triangles are known."""
        return self._native.sizes()[0]

    def __reduce__(self) -> tuple[Any, ...]:
        return Body, (self._mesh, self.inside, self.cover)

    def __repr__(self) -> str:
        has_mesh, inside, cover = self._native.sizes()
        return f"<Body of {'a mesh, ' if has_mesh else ''}{inside} balls inside and {cover} that cover>"


class DistanceBounds(Result):
    """Intervals that contain the distances in n poses, in units of the meshes: 0 where the solids have a common point.
    Of one pose, given as (4, 4): a number or a pair in the place of each array."""

    lower: NDArray[np.float64]  #: Proved by the covers, shape (n,).
    upper: NDArray[np.float64]  #: Proved by the balls inside, shape (n,).
    verdicts: NDArray[np.uint8]  #: Indices into ``VERDICTS``, shape (n,).
    cover_pairs: NDArray[np.int64]  #: The balls of the covers that give ``lower``, shape (n, 2); -1: none.
    inside_pairs: NDArray[np.int64]  #: The balls inside that give ``upper``, shape (n, 2); -1: none.


class Distances(Result):
    """Intervals that contain the distances in n poses, and points that prove their upper ends. Of one pose, given as
    (4, 4): a number, a pair or a point in the place of each array."""

    lower: NDArray[np.float64]  #: Shape (n,).
    upper: NDArray[np.float64]  #: Shape (n,).
    verdicts: NDArray[np.uint8]  #: Indices into ``VERDICTS``, shape (n,).
    on_a: NDArray[np.float64]  #: Points of the solid of a, in its frame, shape (n, 3).
    on_b: NDArray[np.float64]  #: Points of the solid of b, in the frame of a, shape (n, 3).
    triangles: NDArray[np.int64]  #: Of both meshes, which hold these points, shape (n, 2); -1: none.


class Penetration(Result):
    """What is proved about two solids that overlap."""

    depth: tuple[float, float]  #: Holds the length of the shortest translation of b that parts the solids; without covers
    #: the upper end is infinite.
    translation: NDArray[np.float64]  #: One that parts them, no longer than the upper end, shape (3,).
    common_volume_lower: float
    common_volume_of_balls: float  #: Of the two unions of balls inside.
    deepest: tuple[int, int]  #: The two balls inside that overlap most; -1: none.


class FirstContact(Result):
    """The first contact of a motion, whose time goes from 0 to 1."""

    free_until: float  #: No contact before; 1: there is none at all.
    contact_at: float  #: Contact at this time; infinite: none was found.
    verdict: str  #: "free", "hit" or "undecided".
    distance: tuple[float, float]  #: At ``contact_at``, or at the last time that was tried.
    on_a: NDArray[np.float64]  #: The nearest points then, shape (3,).
    on_b: NDArray[np.float64]


class NearBodies(Result):
    """The bodies that may be among the k nearest, by upper ends of the intervals that hold their distances. At least k,
    where there are as many within the limit: more, where intervals overlap, or where distances are the same."""

    indices: NDArray[np.int64]  #: Of the bodies, shape (n,).
    lower: NDArray[np.float64]  #: Shape (n,).
    upper: NDArray[np.float64]  #: Shape (n,).
    others: float  #: All other bodies are proved to be at least so far away; infinite: there are no others.


class PlacedBodies:
    """Bodies in the world, for queries of the nearest among many. It never changes.

    Args:
        bodies: n bodies; one body may stand in many places.
        poses: Take their frames to that of the world, shape (n, 4, 4).
    """

    def __init__(self, bodies: Sequence[Body], poses: ArrayLike) -> None:
        self._native = _native.place_bodies([body._native for body in bodies], poses)

    def __len__(self) -> int:
        return self._native.size()

    def nearest(
        self,
        body: Body,
        pose: ArrayLike,
        count: int = 1,
        *,
        limit: float = math.inf,
        by_triangles: bool = True,
        tolerance: float = 0.0,
    ) -> NearBodies:
        """The bodies that are nearest to ``body``.

        Args:
            body: Any body.
            pose: Takes its frame to that of the world, shape (4, 4).
            count: k, at least 1.
            limit: Bodies that are proved to be farther away are left out.
            by_triangles: Distances of bodies with meshes are those of their triangles; otherwise those of balls.
            tolerance: Greatest width of an interval by triangles, in units of the meshes.
        """
        options = {"count": count, "limit": limit, "by_triangles": by_triangles, "tolerance": tolerance}
        return NearBodies(**self._native.nearest(body._native, _as_many(pose)[0], options))


def distance_bounds(
    a: Body, b: Body, poses: ArrayLike, *, start: DistanceBounds | None = None, threads: int = 0
) -> DistanceBounds:
    """Intervals by balls alone, in microseconds a pose.

    Args:
        a, b: The bodies.
        poses: Matrices that take the frame of ``b`` to that of ``a``, shape (n, 4, 4), or (4, 4) for one.
        start: For one pose: the result of an earlier one of the same bodies, with whose pairs the search starts. It is
            faster if the pose has changed little. Many poses start from each other.

    Raises:
        UsageError: A matrix that is no rigid motion to within 1e-12; ``rigid_pose()`` makes the nearest one.
    """
    many, is_one = _as_many(poses)
    if is_one:
        pairs = None if start is None else (start.cover_pairs, start.inside_pairs)
        return DistanceBounds(**_native.distance_bounds_of_one(a._native, b._native, many, pairs))
    _require_no_start(start)
    return DistanceBounds(**_native.distance_bounds(a._native, b._native, many, threads))


def distances(
    a: Body,
    b: Body,
    poses: ArrayLike,
    *,
    tolerance: float = 0.0,
    limit: float = math.inf,
    surfaces_only: bool = False,
    start: Distances | None = None,
    threads: int = 0,
) -> Distances:
    """Distances by triangles, in intervals as wide as rounding, or ``tolerance``, requires.

    Args:
        a, b: Bodies with meshes.
        poses: Shape (n, 4, 4), or (4, 4) for one.
        tolerance: Greatest width of an interval, in units of the meshes.
        limit: Where the distance is greater, only that is proved.
        surfaces_only: Distances of the surfaces, even where one solid lies inside the other.
        start: As of ``distance_bounds()``.
    """
    many, is_one = _as_many(poses)
    options = {"tolerance": tolerance, "limit": limit, "surfaces_only": surfaces_only, "threads": threads}
    if is_one:
        triangles = None if start is None else start.triangles
        return Distances(**_native.distance_of_one(a._native, b._native, many, options, triangles))
    _require_no_start(start)
    return Distances(**_native.distances(a._native, b._native, many, options))


def collide(a: Body, b: Body, poses: ArrayLike, *, by_balls: bool = False, threads: int = 0) -> NDArray[np.uint8]:
    """Verdicts, as indices into ``VERDICTS``, shape (n,): by balls, and where these prove neither, by triangles.

    Args:
        a, b: The bodies.
        poses: Shape (n, 4, 4), or (4, 4) for one.
        by_balls: By balls alone.
    """
    return _native.collide(a._native, b._native, _as_many(poses)[0], by_balls, threads)


def penetration(
    a: Body,
    b: Body,
    pose: ArrayLike,
    *,
    directions: int = 128,
    most_queries: int = 2000,
    volume_tolerance: float = 1e-2,
    most_columns: int = 4000,
) -> Penetration:
    """Bounds of how far two solids lie in each other; zeros if they are proved to be apart.

    Args:
        a, b: Bodies with balls inside and covers.
        pose: Takes the frame of ``b`` to that of ``a``, shape (4, 4).
        directions: Along which a way out is sought, 1 to 2^20.
        most_queries: For the lower bound of the depth.
        volume_tolerance: Of the common volume, as a share of that of the balls; 1: no volume is measured.
        most_columns: The most that the common volume may cost.
    """
    options = {
        "directions": directions,
        "most_queries": most_queries,
        "volume_tolerance": volume_tolerance,
        "most_columns": most_columns,
    }
    return Penetration(**_native.penetration(a._native, b._native, _as_many(pose)[0], options))


def first_contact(
    a: Body,
    b: Body,
    start: ArrayLike,
    end: ArrayLike,
    *,
    pivot: ArrayLike = (0.0, 0.0, 0.0),
    clearance: float = 0.0,
    tolerance: float = 1e-6,
    surfaces_only: bool = False,
) -> FirstContact:
    """The first contact of ``b``, moving from one pose to another, with ``a``.

    Args:
        a, b: Bodies with meshes.
        start, end: Shape (4, 4). A point of the body, its pivot, moves along a straight line, and the body turns about
            it at a constant rate, by at most half a turn.
        pivot: In the frame of ``b``, shape (3,).
        clearance: Bodies count as in contact where their distance is at most this.
        tolerance: Of the time, at least 1e-12.
    """
    options = {"clearance": clearance, "tolerance": tolerance, "surfaces_only": surfaces_only}
    values = _native.first_contact(a._native, b._native, _as_many(start)[0], _as_many(end)[0], pivot, options)
    values["verdict"] = VERDICTS[values.pop("state")]
    return FirstContact(**values)


def rigid_pose(matrix: ArrayLike) -> NDArray[np.float64]:
    """The rigid motion nearest to a matrix of shape (4, 4) or (n, 4, 4): its rotation is the nearest one to the upper
    left part, as for a matrix in float32.

    Raises:
        UsageError: The part is farther than 1e-3 from a rotation: it scales, shears or mirrors. The last row is farther
            than that from 0, 0, 0, 1.
    """
    import numpy as np

    from .errors import UsageError

    shape = np.shape(matrix)
    if len(shape) not in (2, 3) or shape[-2:] != (4, 4):
        raise UsageError(f"the shape {shape} is not (4, 4) or (n, 4, 4)")
    if np.asarray(matrix).dtype.kind not in "fiu":
        raise UsageError("a matrix is not one of real numbers")
    near = np.array(matrix, dtype=np.float64)
    if not np.all(np.isfinite(near)):
        raise UsageError("a matrix is not finite")
    left, _, right = np.linalg.svd(near[..., :3, :3])
    rotation = left @ right
    if np.max(np.abs(rotation - near[..., :3, :3]), initial=0.0) > 1e-3 or np.any(np.linalg.det(rotation) < 0):
        raise UsageError("a matrix scales, shears or mirrors: it is no rigid motion")
    if np.max(np.abs(near[..., 3, :] - [0, 0, 0, 1]), initial=0.0) > 1e-3:
        raise UsageError("the last row of a matrix is not 0, 0, 0, 1: is it transposed?")
    near[..., :3, :3] = rotation
    near[..., 3, :] = (0, 0, 0, 1)
    return near


def _as_many(poses: ArrayLike) -> tuple[ArrayLike, bool]:
    shape = getattr(poses, "shape", None)
    if shape is None:
        import numpy as np

        poses = np.asarray(poses, dtype=np.float64)
        shape = poses.shape
    if len(shape) == 2:
        return poses[None], True  # type: ignore[index, call-overload]
    return poses, False


def _require_no_start(start: object) -> None:
    if start is not None:
        from .errors import UsageError

        raise UsageError("`start` is for one pose, of the shape (4, 4)")
