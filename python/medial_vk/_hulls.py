"""A solid approximated by capsules, cone-spheres or slabs: convex hulls of two or three balls each, proved to lie inside."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _native
from ._context import Context, native_context
from ._mesh import as_mesh
from ._progress import shown
from ._results import Result

if TYPE_CHECKING:
    from typing import Literal

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._mesh import MeshLike
    from ._progress import Progress


class Hulls(Result):
    """n convex hulls of one to three balls each, in the units of the mesh."""

    centres: NDArray[np.float64]  #: Shape (n, 3, 3): of the three balls of each; unused ones repeat the last.
    radii: NDArray[np.float64]  #: Shape (n, 3).
    counts: NDArray[np.uint32]  #: Shape (n,): 1 for a ball, 2 for a capsule or a cone-sphere, 3 for a slab.

    def __len__(self) -> int:
        return len(self.counts)

    def distances(self, points: ArrayLike) -> NDArray[np.float64]:
        """The distance of each point, shape (m, 3), to the surface of the nearest hull, negative in it; shape (m,)."""
        return _native.hull_distances(*_flat(self), points)

    def volume(self, width: float, *, threads: int = 0) -> tuple[float, float]:
        """Proved bounds of the volume of the union, which differ by at most ``width``, in cubed units of the mesh,
        or by what rounding allows."""
        return _native.measure_hull_union(*_flat(self), width, threads)


class HullProof(Result):
    """The proof that hulls lie inside: for each a point that is inside, and planes between it and every triangle."""

    tested: int
    failed: int
    first_failure: int  #: Index of a hull, if any failed.
    planes: int
    greatest_lack: float  #: By how much radii would have to be smaller for the proof, in units of the mesh.
    proved: bool


class HullFit(Result):
    """The result of ``fit_hulls()``."""

    hulls: Hulls  #: Every first part of it is a good set of its size.
    proof: HullProof
    covered: tuple[float, float]  #: Bounds of the volume of the union.
    gap: tuple[float, float]  #: Bounds of the greatest distance from a point of the boundary to the hulls.
    greatest_shrink: float  #: The greatest amount by which radii gave way for the proof.
    left_out: int  #: Hulls of the search without a proof, beside openings of the boundary.
    solid_volume: float | None  #: If the mesh encloses one cleanly.

    @property
    def uncovered_share(self) -> tuple[float, float] | None:
        """Bounds of the share of the solid's volume that no hull covers, up to the rounding of that volume; None if it is not
        known."""
        if self.solid_volume is None:
            return None
        lower, upper = self.covered
        return max(0.0, 1 - upper / self.solid_volume), 1 - lower / self.solid_volume

    def __len__(self) -> int:
        return len(self.hulls)


def _flat(hulls: Hulls) -> tuple[Any, Any, Any]:
    return hulls.centres.reshape(-1, 3), hulls.radii.reshape(-1), hulls.counts


def fit_hulls(
    mesh: MeshLike,
    count: int = 0,
    *,
    kind: Literal["balls", "capsules", "cones", "slabs", "mix"] = "slabs",
    parameters: int = 0,
    error: float = 0.0,
    max_gap: float = 0.0,
    width: float = 0.0,
    resolution: int = 0,
    threads: int = 0,
    context: Context | None = None,
    progress: Progress = None,
) -> HullFit:
    """Fits hulls of balls into the solid that a mesh encloses, proves that they lie inside, and measures them. All given
    goals are met, with as few hulls as the method finds.

    Args:
        mesh: A ``Mesh``, or an object that ``Mesh()`` accepts.
        count: Greatest number of hulls, up to 4096; 0: as many as the other goals require.
        kind: "balls", "capsules" (two balls of equal radius), "cones" (two balls), "slabs" (three balls), or "mix": the
            best of these sets.
        parameters: Greatest sum of the numbers that describe the hulls: 4 a ball, 7 a capsule, 8 a cone, 12 a slab; 0: no
            such goal.
        error: Greatest uncovered share of the solid's volume, in [0, 1); 0: no such goal.
        max_gap: Greatest distance from the boundary to the hulls, in units of the mesh; 0: no such goal.
        width: Greatest difference of the bounds ``covered``, as a share of the solid's volume; 0: a fiftieth of the
            uncovered share, between 1e-5 and 1e-3.
        resolution: Of the search for medial points to start from; 0: derived.
        threads: Of the host, 0: one per core. The result does not depend on it.
        context: Where medial points are computed; None: ``default_context()``.
        progress: A function of the stage's name and its share, or True for a bar.

    Raises:
        UsageError: No goal, a goal out of range, or one that is not reached.
        InvalidMeshError: No hull fits.
        NoDeviceError, OutOfMemoryError: As their names say.
    """
    options = {
        "kind": kind,
        "count": count,
        "parameters": parameters,
        "error": error,
        "max_gap": max_gap,
        "width": width,
        "resolution": resolution,
        "threads": threads,
    }
    with shown(progress) as callback:
        values = _native.fit_hulls(as_mesh(mesh)._native, native_context(context), options, callback)
    corners = values.pop("hulls")
    hulls = Hulls(
        centres=corners["centres"].reshape(-1, 3, 3), radii=corners["radii"].reshape(-1, 3), counts=corners["counts"]
    )
    return HullFit(hulls=hulls, proof=HullProof(**values.pop("proof")), **values)


def prove_hulls(mesh: MeshLike, hulls: Hulls, *, threads: int = 0) -> HullProof:
    """Tests, from the numbers of the hulls alone, that every hull lies in the solid that the mesh encloses."""
    return HullProof(**_native.prove_hulls(as_mesh(mesh)._native, *_flat(hulls), threads))
