"""The parts of an assembly, such as the links of a robot, as balls."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _native
from ._balls import Balls
from ._context import Context, native_context
from ._mesh import as_mesh
from ._progress import shown
from ._results import Result
from ._spheres import SphereMeasures, fit_options, measures_of

if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Literal

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._mesh import MeshLike
    from ._progress import Progress


class Part:
    """A solid of an assembly: a mesh, or a ball. The parts of a link move together. It never changes.

    Args:
        mesh: In the frame of the part. Parts of the same shape may share a ``Mesh``, which is then prepared once.
        ball: Centre and radius, instead of a mesh: a part that is a ball is approximated by itself.
        link: The name of its link. Parts with the same name belong together.
        name: For messages.
        pose: Takes the frame of the part to that of its link, shape (4, 4); None: they are the same.
        volume: The exact volume of the shape that the mesh approximates, such as a cylinder, if errors shall be relative to
            that. The mesh lies inside the shape (contract "inside") or encloses it (contract "cover").

    Raises:
        UsageError, InvalidMeshError: Those of ``Mesh()``.
    """

    def __init__(
        self,
        mesh: MeshLike | None = None,
        *,
        ball: tuple[ArrayLike, float] | None = None,
        link: str = "",
        name: str = "",
        pose: ArrayLike | None = None,
        volume: float | None = None,
    ) -> None:
        self.mesh = None if mesh is None else as_mesh(mesh)  #: The mesh, or None.
        self.link = link  #: The name of its link.
        self.name = name  #: For messages.
        self._values: dict[str, Any] = {
            "link": link,
            "name": name,
            "pose": None if pose is None else _in_a_row(pose),
            "centre": None if ball is None else ball[0],
            "radius": None if ball is None else ball[1],
            "volume": volume,
        }

    def _given(self) -> dict[str, Any]:
        """For the library."""
        return {**self._values, "mesh": None if self.mesh is None else self.mesh._native}

    def __repr__(self) -> str:
        return f"<Part {self.name!r} of link {self.link!r}>"


class PartFit(Result):
    """The balls of one part."""

    balls: Balls  #: The last of ``levels``.
    levels: list[Balls]  #: In the frame of the link, the smallest set first; one, unless ``levels`` was requested.
    reach: list[tuple[float, float, float]]  #: By level: mean, least and greatest distance by which balls reach out.
    count: int  #: The number of balls assigned to the part; 0: the number that its other goals require.
    solid_volume: float | None  #: Of the shape, if ``of_shape``, else of the mesh, if it encloses one cleanly.
    aim: str  #: What the balls were chosen by: "volume" or "distance"; of ``aim`` "auto" the one that it took.
    of_shape: bool  #: Volumes are those of the ball, or of ``Part(volume=...)``.
    spheres_volume: float | None  #: Of the union of ``balls``.
    measures: SphereMeasures | None  #: Of ``proved``; None for a part that is a ball.
    proved: Balls  #: The last level in the frame of the part, where its contract was proved; none for a ball.
    seconds: float

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


def fit_parts(
    parts: Iterable[Part],
    count: int = 0,
    *,
    count_per_link: int = 0,
    total: int = 0,
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
) -> list[PartFit]:
    """Fits balls to every part, proves their contract, and measures them, as ``fit_spheres()`` does. Numbers of balls for
    several parts are distributed among them by the volume that one more ball would cover, or, with ``aim`` "distance", to
    the part with the widest gap.

    Args:
        parts: Meshes and balls, in one unit.
        count: Greatest number of balls of each part; without effect beside one of the next two.
        count_per_link: Greatest number of balls of each link, for its parts together.
        total: Greatest number of balls of all parts together.
        contract, error, max_gap, max_reach, max_distance, aim, method, resolution, object_angle, levels, balls_only,
            for_distances: As of ``fit_spheres()``, for each part.
        threads: Of the host, 0: one per core. The result does not depend on it.
        context: Where candidates are computed; None: ``default_context()``.
        progress: A function of the stage's name and its share, or True for a bar.

    Returns:
        The fits in the order of the parts.

    Raises:
        UsageError: As of ``fit_spheres()``, with the names of link and part; fewer balls than parts, a part with neither
            mesh nor ball or with both, a pose that is no rigid motion.
        InvalidMeshError: No ball fits.
        NoDeviceError, OutOfMemoryError: As their names say.
    """
    options = {"count_per_link": count_per_link, "total": total, **fit_options(locals())}
    given = [part._given() for part in parts]
    with shown(progress) as callback:
        fits = _native.fit_parts(given, native_context(context), options, callback)
    return [_part_fit_of(values) for values in fits]


def _part_fit_of(values: dict[str, Any]) -> PartFit:
    sets = [Balls(**level) for level in values.pop("levels")]
    measures = values.pop("measures")
    return PartFit(
        balls=sets[-1],
        levels=sets,
        measures=None if measures is None else measures_of(measures),
        proved=Balls(**values.pop("proved")),
        **values,
    )


def _in_a_row(pose: ArrayLike) -> Any:
    import numpy as np

    return np.asarray(pose)[None]
