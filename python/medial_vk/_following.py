"""Balls that follow a mesh as its vertices move."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import _native
from ._balls import Balls, as_arrays
from ._mesh import as_mesh
from ._results import Result

if TYPE_CHECKING:
    from typing import Literal

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._balls import BallsLike
    from ._mesh import MeshLike

#: The states of balls that follow, by their numbers in arrays.
FOLLOW_STATES = ("medial", "flat", "shrunk", "lost")
#: Where the balls of a frame come from, by their numbers in arrays.
FOLLOW_ORIGINS = ("followed", "renewed", "returned")


class FollowedBalls(Balls):
    """The balls inside of one frame, in the order in which they were given; lost ones have the radius 0."""

    states: NDArray[np.uint8]  #: Indices into ``FOLLOW_STATES``.
    origins: NDArray[np.uint8]  #: Indices into ``FOLLOW_ORIGINS``.


class FollowMeasures(Result):
    """Volumes of a frame, in cubed units of the mesh."""

    solid_volume: float  #: NaN if it is known not to be that of the solid, as of a mesh that is not closed.
    ball_volume: float  #: Of the union.
    outside_bound: float  #: Of the balls outside the solid; rule "tangent": 0.

    @property
    def uncovered(self) -> float:
        """The volume of the solid in no ball; rule "published": less than that, by the volume of the balls outside."""
        return self.solid_volume - self.ball_volume


class CoverFollowMeasures(Result):
    """Volumes of a frame, in cubed units of the mesh."""

    solid_volume: float  #: NaN as above.
    ball_volume: float  #: Of the union.

    @property
    def added(self) -> float:
        """The volume of the balls outside of the solid, if that is covered."""
        return self.ball_volume - self.solid_volume


class Follower:
    """Balls inside a solid that stay inside, by proof, as the vertices of its mesh move (Section 7.4 of the source).

    Args:
        mesh: The rest pose.
        balls: Inside it, such as those of ``fit_spheres()`` or ``analyse()``.
        rule: "tangent" (balls keep two contacts, and are inside or lost) or "published" (they may reach out a little).
        steps: Steps towards a greater volume in every frame; 0: fastest.
        protrusion: Rule "published": how far a ball may reach out, as a share of the longest side.
        shrunk: A ball whose radius falls below this share of its first one counts as shrunk.
        object_angle: A ball with a smaller one, in radians, counts as flat.
        renewed: The most balls that are chosen anew in a frame; of closed meshes.
        renewal_factor: How much more than in the rest pose must be uncovered for that, from 1 up.
        threads: Of the host, 0: one per core. The result does not depend on it.

    Raises:
        UsageError: An argument is out of range, or a ball is not inside.
    """

    def __init__(
        self,
        mesh: MeshLike,
        balls: BallsLike,
        *,
        rule: Literal["tangent", "published"] = "tangent",
        steps: int = 1,
        protrusion: float = 0.0025,
        shrunk: float = 0.5,
        object_angle: float = 0.5,
        renewed: int = 0,
        renewal_factor: float = 1.5,
        threads: int = 0,
    ) -> None:
        options = {
            "rule": rule,
            "steps": steps,
            "protrusion": protrusion,
            "shrunk": shrunk,
            "object_angle": object_angle,
            "renewed": renewed,
            "renewal_factor": renewal_factor,
            "threads": threads,
        }
        self._native = _native.make_follower(as_mesh(mesh)._native, *as_arrays(balls), options)

    def update(self, vertices: ArrayLike) -> FollowedBalls:
        """The next frame.

        Args:
            vertices: Positions for the rows of ``Mesh.vertices``, shape (n, 3).

        Raises:
            InvalidMeshError: Another number of vertices, or one that is not finite; nothing has changed.
        """
        return FollowedBalls(**self._native.update(vertices))

    @property
    def balls(self) -> FollowedBalls:
        """Those of the present frame."""
        return FollowedBalls(**self._native.present())

    def measure(self) -> FollowMeasures:
        """Volumes of the present frame."""
        return FollowMeasures(**self._native.measure())

    def reset(self) -> None:
        """Returns to the rest pose, as if no frame had been seen."""
        self._native.reset()


class CoverFollower:
    """Balls that cover a solid in every frame, by proof, as the vertices of its mesh move.

    Args:
        mesh: The rest pose.
        balls: That cover it, such as those of ``fit_spheres(mesh, 500, contract="cover")``.
        surface_only: Cover only the triangles, for a small share of the time.
        steps: Steps towards a smaller volume in every frame.
        threads: Of the host, 0: one per core. The result does not depend on it.
    """

    def __init__(
        self, mesh: MeshLike, balls: BallsLike, *, surface_only: bool = False, steps: int = 0, threads: int = 0
    ) -> None:
        options = {"surface_only": surface_only, "steps": steps, "threads": threads}
        self._native = _native.make_cover_follower(as_mesh(mesh)._native, *as_arrays(balls), options)

    def update(self, vertices: ArrayLike) -> Balls:
        """A frame: positions for the rows of ``Mesh.vertices``, shape (n, 3). Balls that are not needed have the radius
        0. Frames do not depend on each other."""
        return _cover_of(self._native.update(vertices))

    @property
    def balls(self) -> Balls:
        """Those of the present frame."""
        return _cover_of(self._native.present())

    @property
    def covers_solid(self) -> bool:
        """Whether all of the solid is proved to be covered, not only its triangles."""
        return self._native.covers_solid()

    def measure(self) -> CoverFollowMeasures:
        """Volumes of the present frame."""
        return CoverFollowMeasures(**self._native.measure())

    def tighten(self) -> None:
        """Divides the boundary of the present frame among the balls anew, so that they become smaller."""
        self._native.tighten()

    def reset(self) -> None:
        """Returns to the rest pose."""
        self._native.reset()


def _cover_of(values: dict[str, NDArray[np.float64]]) -> Balls:
    return Balls(centres=values["centres"], radii=values["radii"])
