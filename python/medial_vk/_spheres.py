"""A solid approximated by balls, with a proved contract."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _native
from ._balls import Balls, as_arrays
from ._context import Context, native_context
from ._mesh import as_mesh
from ._progress import shown
from ._results import Result

if TYPE_CHECKING:
    from typing import Literal, TypeVar

    import numpy as np
    from numpy.typing import NDArray

    from ._balls import BallsLike
    from ._mesh import MeshLike
    from ._progress import Progress

    R = TypeVar("R", bound=Result)


class InsideProof(Result):
    """The proof that every centre is inside, and every radius at most the exact distance to the boundary."""

    tested: int
    failed: int
    first_failure: int  #: Index of a ball, if any failed.
    greatest_excess: float  #: Of a radius over the distance, in units of the mesh.
    proved: bool


class CoverProof(Result):
    """The proof that the balls hold every triangle, and that no vertex of their envelope lies in the solid."""

    triangles: int
    uncovered: int  #: Triangles with a point in no ball.
    undecided: int  #: Triangles for which neither is known.
    first_uncovered: NDArray[np.float64]  #: A point where the proof failed, shape (3,).
    vertices: int  #: Of the envelope.
    inside: int  #: Of these: in the solid, or too near its boundary to decide.
    first_inside: NDArray[np.float64]  #: The first of them, shape (3,).
    closed: bool  #: False: only the boundary is proved to be covered.
    surface_proved: bool
    proved: bool


class VolumeError(Result):
    """Volumes in cubed units of the mesh."""

    solid: float
    balls: float  #: Of their union.
    uncovered: float  #: Of the solid outside the balls.
    outside: float  #: Of the balls outside the solid.
    standard_error: float  #: Of the last two, if they are estimates; 0: they are exact.
    normalized: float  #: Their sum over the volume of the solid.
    normalized_lower_bound: float  #: Of the same, by the volumes alone (Lemma 7.1 of the source).


class EnvelopeDistances(Result):
    """Suprema of distances as proved intervals, in units of the mesh."""

    solid_to_balls: tuple[float, float]
    balls_to_solid: tuple[float, float]
    boundary_to_balls: tuple[float, float]  #: The greatest gap.
    boundary_to_envelope: tuple[float, float]
    between_sets: tuple[float, float]  #: Two-sided, of solid and balls.
    between_surfaces: tuple[float, float]  #: Two-sided, of boundary and envelope.
    envelope_to_boundary: tuple[float, float]


class SphereFitMetrics(Result):
    """Measures with the names and definitions of cuRobo's; lengths in units of the mesh."""

    num_spheres: int
    coverage: float
    protrusion: float
    protrusion_dist_mean: float
    protrusion_dist_p95: float
    surface_gap_mean: float
    surface_gap_p95: float
    max_uncovered_gap: float
    volume_ratio: float


class SignedDistances(Result):
    """A histogram of signed distances by area, in bins of equal width, in units of the mesh. Positive: the envelope of the
    balls is outside the solid there (Figure 8-2 of the source)."""

    lower: float  #: Of the bins.
    upper: float
    shares: NDArray[np.float64]  #: Of the area, by bin.
    least: float
    greatest: float
    mean: float
    mean_absolute: float


class SphereMeasures(Result):
    """The quality of a set of balls as an approximation of a solid. With ``balls_only`` it has nothing but the proof of
    the contract."""

    diagonal: float | None  #: Of the solid's box.
    inside: InsideProof | None  #: None if it was not tried.
    cover: CoverProof | None  #: None if it was not tried.
    volume: VolumeError | None  #: None with ``balls_only``, like the next two.
    distances: EnvelopeDistances | None
    metrics: SphereFitMetrics | None
    boundary_to_envelope: SignedDistances | None  #: By area of the boundary; estimated from samples.
    envelope_to_boundary: SignedDistances | None  #: By area of the envelope.


class SphereFit(Result):
    """The result of ``fit_spheres()``."""

    balls: Balls  #: The last of ``levels``; with contract "inside", every first part of it is a good set of its size.
    levels: list[Balls]  #: The smallest set first; one, unless ``levels`` was requested.
    reach: list[tuple[float, float, float]]  #: By level: mean, least and greatest distance by which balls reach out.
    measures: SphereMeasures  #: Of ``balls``; with ``balls_only`` the proof alone.
    solid_volume: float | None  #: If the mesh encloses one cleanly.
    aim: str  #: What the balls were chosen by: "volume" or "distance"; of ``aim`` "auto" the one that it took.

    @property
    def centres(self) -> NDArray[np.float64]:
        """Of ``balls``, shape (n, 3)."""
        return self.balls.centres

    @property
    def radii(self) -> NDArray[np.float64]:
        """Of ``balls``, shape (n,)."""
        return self.balls.radii

    def __len__(self) -> int:
        return len(self.balls)

    def plot(self, ax: Any = None, *, colour: Any = None, mesh: Any = None) -> Any:
        """Draws the balls with matplotlib, and ``mesh`` as glass around them; returns the axes.

        Args:
            ax: Axes of projection "3d"; None: new ones.
            colour: A colour of matplotlib, or a number for each ball; None: by radius.
        """
        return self.balls.plot(ax, colour=colour, mesh=mesh)


class SphereProofs(Result):
    """The result of ``prove_spheres()``."""

    inside: InsideProof | None  #: None if no ball was given.
    cover: CoverProof | None  #: None if no ball was given.


def fit_spheres(
    mesh: MeshLike,
    count: int = 0,
    *,
    contract: Literal["inside", "cover", "balanced"] = "inside",
    error: float = 0.0,
    max_gap: float = 0.0,
    max_distance: float = 0.0,
    max_reach: float = 0.0,
    aim: Literal["volume", "distance", "auto"] = "volume",
    method: Literal["best", "source"] = "best",
    resolution: int = 0,
    object_angle: float = 0.6,
    levels: bool = False,
    balls_only: bool = False,
    for_distances: bool = False,
    threads: int = 0,
    context: Context | None = None,
    progress: Progress = None,
) -> SphereFit:
    """Fits balls to the solid that a mesh encloses, proves their contract in double precision, and measures them. All
    given goals are met, with as few balls as the method finds.

    Args:
        mesh: A ``Mesh``, or an object that ``Mesh()`` accepts.
        count: Greatest number of balls; 0: as many as the other goals require, up to 20,000, or, with
            method "source", as the resolution gives.
        contract: "inside" (no ball reaches out of the solid), "cover" (no point of the solid is outside the balls) or
            "balanced" (no claim; the volume between balls and solid is small).
        error: Greatest volume error as a share of the solid's volume, in [0, 1); 0: no such goal.
        max_gap: Greatest distance from the boundary to the balls, in units of the mesh; 0: no such goal.
        max_distance: Contract "balanced": greatest Hausdorff distance of the boundary and the surface of the balls, in
            units of the mesh; 0: no such bound. With ``count`` alone, a bound for so many balls, else a goal.
        max_reach: With "cover", greatest distance by which balls reach out, in units of the mesh: as few balls as are
            found, at most ``count`` if it is given, by method "best", without ``error`` and ``levels``; 0: no such goal.
        aim: With "inside", what balls are chosen by: "volume" (little is uncovered), "distance" (no point of the boundary
            is far from all balls, as in a thin plate; without ``error``), or "auto" ("distance" where that many balls
            can have no more than half of the volume).
        method: "best", or "source": one ball per voxel (Section 7.3.2 of the source).
        resolution: Of the search for candidates; 0: derived from the count.
        object_angle: Of method "source", radians.
        levels: Also return sets of half, a quarter ... of the balls.
        balls_only: Only the balls and the proof of their contract, for a fraction of the time; without ``levels``.
        for_distances: Choose balls for tight bounds of distances instead of a small volume error: method "best", contract
            "inside" or "cover", by ``count`` alone, without ``levels``.
        threads: Of the host, 0: one per core. The result does not depend on it.
        context: Where candidates are computed; None: ``default_context()``.
        progress: A function of the stage's name and its share, or True for a bar.

    Raises:
        UsageError: No goal, a goal out of range, or one that is not reached.
        InvalidMeshError: No ball fits.
        NoDeviceError, OutOfMemoryError: As their names say.
    """
    options = fit_options(locals())
    with shown(progress) as callback:
        values = _native.fit_spheres(as_mesh(mesh)._native, native_context(context), options, callback)
    sets = [Balls(**level) for level in values["levels"]]
    return SphereFit(
        balls=sets[-1],
        levels=sets,
        reach=values["reach"],
        measures=measures_of(values["measures"]),
        solid_volume=values["solid_volume"],
        aim=values["aim"],
    )


def fit_options(arguments: dict[str, Any]) -> dict[str, Any]:
    """Of the arguments of ``fit_spheres()`` or ``fit_parts()``, by name, those that are options of a fit in the library."""
    return {name: arguments[name] for name in _FIT_OPTIONS}


_FIT_OPTIONS = (
    "contract",
    "method",
    "count",
    "error",
    "max_gap",
    "max_distance",
    "max_reach",
    "aim",
    "resolution",
    "object_angle",
    "levels",
    "balls_only",
    "for_distances",
    "threads",
)


def prove_spheres(
    mesh: MeshLike, inside: BallsLike | None = None, cover: BallsLike | None = None, *, threads: int = 0
) -> SphereProofs:
    """Tests that every ball of ``inside`` lies in the solid, and that the balls of ``cover`` hold all of it, in double
    precision and from the numbers alone: for balls of any origin.

    Raises:
        UsageError: A ball whose numbers are not finite or beyond 1e18.
    """
    values = _native.prove_spheres(as_mesh(mesh)._native, *as_arrays(inside), *as_arrays(cover), threads)
    return SphereProofs(inside=_made(InsideProof, values["inside"]), cover=_made(CoverProof, values["cover"]))


def measure_gap(mesh: MeshLike, balls: BallsLike, *, threads: int = 0) -> tuple[float, float]:
    """Bounds of the greatest distance from a point of the boundary to the balls, in units of the mesh."""
    return _native.measure_gap(as_mesh(mesh)._native, *as_arrays(balls), threads)


def measures_of(values: dict[str, Any]) -> SphereMeasures:
    """The measures that the library has made."""
    return SphereMeasures(
        diagonal=values["diagonal"],
        inside=_made(InsideProof, values["inside"]),
        cover=_made(CoverProof, values["cover"]),
        volume=_made(VolumeError, values["volume"]),
        distances=_made(EnvelopeDistances, values["distances"]),
        metrics=_made(SphereFitMetrics, values["metrics"]),
        boundary_to_envelope=_made(SignedDistances, values["boundary_to_envelope"]),
        envelope_to_boundary=_made(SignedDistances, values["envelope_to_boundary"]),
    )


def _made(kind: type[R], values: dict[str, Any] | None) -> R | None:
    return None if values is None else kind(**values)
