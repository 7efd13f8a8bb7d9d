"""Triangle meshes, prepared and indexed."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from . import _native
from ._results import Result

if TYPE_CHECKING:
    from typing import Union

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    #: A Mesh, or an object with ``vertices`` (or ``points``) and ``triangles`` (or ``faces``), such as those of trimesh,
    #: Open3D and PyVista.
    MeshLike = Union["Mesh", Any]


class MeshReport(Result):
    """What preparation found and changed. Counts are of vertices, faces or edges."""

    vertices: int
    triangles: int  #: After cleaning.
    merged_vertices: int  #: At exactly the position of an earlier one.
    unused_vertices: int  #: Of no triangle, left out.
    fallback_polygons: int  #: Of a file: polygons that cross themselves or would take too long, cut into a fan.
    degenerates_dropped: int  #: Of zero area, or with a repeated corner.
    caps_repaired: int  #: Of these: with a corner on the opposite side, at which the neighbour was divided.
    duplicates_dropped: int  #: With the same three corners as an earlier face.
    inner_walls_dropped: int  #: Of these: between two solids that touch; both copies are dropped.
    open_edges: int  #: Of one triangle.
    non_manifold_edges: int  #: Of three or more triangles.
    inconsistent_edges: int  #: That two triangles traverse in the same direction.
    non_manifold_vertices: int
    components: int  #: Connected by shared edges.
    reoriented_faces: int  #: Turned over, counted once for each of the next three reasons.
    minority_faces: int  #: Turned over to agree with their neighbours.
    reoriented_components: int  #: Turned over as a whole, because they were inside out.
    inside_out: bool  #: All faces were turned over: the signed volume was negative.
    intersecting_faces: int  #: That meet another one outside their shared corners and edges.
    intersections_known: bool  #: False if that test was cut short by its budget.
    cut_faces: int  #: Cut along their crossings with others.
    inner_faces: int  #: Left out: the inside lies on both sides of them.
    outer_faces: int  #: Of membranes outside the solid, left out.
    hidden_open_edges: int  #: Of the given mesh, at holes inside other parts, which were filled.
    closed: bool
    faces_within: int  #: With the inside on both sides.
    faces_without: int  #: With the outside on both sides.
    sides_known: bool  #: False if only a part of the faces was tested for these two.
    trusted_triangles: int  #: Whose outward normal the proofs may use.
    signed_volume: float  #: In cubed units of the mesh.
    assumptions: list[str]  #: Sentences for people.
    lower: NDArray[np.float64]  #: Corner of the bounding box, shape (3,).
    upper: NDArray[np.float64]  #: The opposite corner, shape (3,).


class ClosestPoints(Result):
    """The nearest points of a mesh to n points."""

    points: NDArray[np.float64]  #: Shape (n, 3).
    distances: NDArray[np.float64]  #: Shape (n,).
    triangles: NDArray[np.uint32]  #: Of the mesh, shape (n,); the smallest index among exact ties.


class Mesh:
    """A triangle mesh, cleaned, oriented and indexed: the input of every call. It never changes, so that any number of
    threads may use it.

    Args:
        vertices: Positions, shape (n, 3), in any unit; float64 and float32 are read in place, whatever their strides.
            Or, without ``triangles``, an object with ``vertices`` (or ``points``) and ``triangles`` (or ``faces``), such
            as a mesh of trimesh, Open3D or PyVista.
        triangles: Indices, shape (m, 3), counter-clockwise seen from outside; int32, int64, uint32 and uint64 are read
            in place.
        keep_inner_faces: Keep faces that do not bound the solid, and cut no faces where they cross.
        keep_outer_faces: Keep parts of membranes outside the solid.
        threads: Of the host, 0: one per core. The mesh does not depend on it.

    Raises:
        UsageError: Wrong shapes or types.
        InvalidMeshError: An index out of range, a coordinate that is not finite, or nothing is enclosed.

    The library keeps its own copy of the arrays, the only one that is made; they may change afterwards. A mesh can be
    pickled, for other processes: its prepared arrays are, and it is indexed again.
    """

    def __init__(
        self,
        vertices: ArrayLike | MeshLike,
        triangles: ArrayLike | None = None,
        *,
        keep_inner_faces: bool = False,
        keep_outer_faces: bool = False,
        threads: int = 0,
    ) -> None:
        if triangles is None:
            vertices, triangles = _arrays_of(vertices)
        options = {"keep_inner_faces": keep_inner_faces, "keep_outer_faces": keep_outer_faces, "threads": threads}
        self._native = _native.make_mesh(vertices, triangles, options)

    @classmethod
    def _of(cls, native: _native.Mesh) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._native = native
        return mesh

    @property
    def vertices(self) -> NDArray[np.float64]:
        """Those of the prepared mesh, shape (n, 3): a view that cannot be written to."""
        return self._native.vertices()

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """Those of the prepared mesh, shape (m, 3): a view that cannot be written to."""
        return self._native.triangles()

    @property
    def vertex_of_input(self) -> NDArray[np.int64]:
        """By given vertex: its index in ``vertices``, or -1 if it was left out."""
        return self._native.vertex_of_input()

    @property
    def triangle_of_input(self) -> NDArray[np.uint32]:
        """By triangle of ``triangles``: its index among the given ones."""
        return self._native.triangle_of_input()

    @property
    def report(self) -> MeshReport:
        """What preparation found and changed."""
        return MeshReport(**self._native.report())

    @property
    def longest_side(self) -> float:
        """Of the bounding box, or of the box of ``on_side()``: the unit of all fractions."""
        return self._native.longest_side()

    @property
    def side(self) -> str:
        """Where medial points are sought: "inside" or "outside"."""
        return "outside" if self._native.is_outside() else "inside"

    def on_side(self, side: str = "outside", *, margin: float = 0, threads: int = 0) -> Mesh:
        """The same boundary for a search on one side of it, within a box.

        Args:
            side: "inside" or "outside".
            margin: The box reaches this far beyond the bounding box, in units of the mesh; 0: half of its longest side.
        """
        return Mesh._of(self._native.on_side({"side": side, "margin": margin, "threads": threads}))

    def moved(self, vertices: ArrayLike) -> Mesh:
        """The mesh with its vertices elsewhere, the triangles as they are. It is indexed again in a small share of the
        time, but not prepared again: faces that cross now are not cut.

        Args:
            vertices: Shape (n, 3), for the n rows of ``Mesh.vertices``.
        """
        return Mesh._of(self._native.moved(vertices))

    def closest_points(self, points: ArrayLike) -> ClosestPoints:
        """The nearest points of the mesh to each point, shape (n, 3), in double precision, on one core."""
        return ClosestPoints(**self._native.closest_points(points))

    def depths(self, points: ArrayLike, *, threads: int = 0) -> NDArray[np.float64]:
        """A proved lower bound of the depth of each point in the solid: its distance to the boundary inside, and minus
        that distance outside, less a bound of the rounding. Shape (n,)."""
        return self._native.depths(points, threads)

    def sample(self, count: int) -> NDArray[np.float64]:
        """Points of the boundary that stand for equal parts of its area, shape (count, 3): the same ones at every call."""
        return self._native.sample(count)

    def plot(self, ax: Any = None, *, colour: Any = None, alpha: float = 1.0, label: str = "") -> Any:
        """Draws the triangles with matplotlib, shaded; returns the axes.

        Args:
            ax: Axes of projection "3d"; None: new ones.
            colour: A colour of matplotlib, or a number for each vertex or triangle; triangles of NaN are grey.
            alpha: Opacity, from 0 (glass) to 1.
            label: Of the bar that numbers have.

        Raises:
            UsageError: Another number of numbers.
        """
        from ._plots import plot_mesh

        return plot_mesh(self, ax, colour, alpha, label)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._native.state(),)

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Mesh:
        return self

    def __repr__(self) -> str:
        closed = "closed" if self.report.closed else "not closed"
        return f"<Mesh of {len(self.vertices)} vertices and {len(self.triangles)} triangles, {closed}>"


def read_mesh(
    path: str | os.PathLike[str], *, keep_inner_faces: bool = False, keep_outer_faces: bool = False, threads: int = 0
) -> Mesh:
    """Reads OBJ, PLY, STL or OFF. For other formats, pass the mesh of another reader, such as trimesh, to ``Mesh``.

    Raises:
        InvalidMeshError: The file cannot be read; the message has the line, face or byte.
    """
    options = {"keep_inner_faces": keep_inner_faces, "keep_outer_faces": keep_outer_faces, "threads": threads}
    return Mesh._of(_native.read_mesh(os.fsencode(path), options))


def as_mesh(mesh: MeshLike) -> Mesh:
    """The mesh itself, or one made of another package's."""
    return mesh if isinstance(mesh, Mesh) else Mesh(mesh)


def _arrays_of(mesh: Any) -> tuple[Any, Any]:
    vertices = _first_of(mesh, ("vertices", "points"))
    triangles = _first_of(mesh, ("triangles", "faces"))
    if vertices is None or triangles is None:
        from .errors import UsageError

        raise UsageError(
            f"{type(mesh).__name__} has no vertices (or points) and triangles (or faces): pass two arrays, or a mesh"
        )
    return vertices, _rows_of_three(triangles)


def _first_of(mesh: Any, names: tuple[str, ...]) -> Any:
    for name in names:
        value = getattr(mesh, name, None)
        if value is not None and not callable(value):
            return value
    return None


def _rows_of_three(faces: Any) -> Any:
    """PyVista's faces are one row of numbers, each face after the number of its corners."""
    import numpy as np

    array = np.asarray(faces)
    if array.ndim != 1 or array.size == 0:
        return faces
    if array.size % 4 != 0 or np.any(array[::4] != 3):
        from .errors import UsageError

        raise UsageError("the mesh has faces that are no triangles: triangulate it first")
    return array.reshape(-1, 4)[:, 1:]


def _restored(state: dict[str, Any]) -> Mesh:
    """A mesh that was pickled."""
    return Mesh._of(_native.restore_mesh(state))
