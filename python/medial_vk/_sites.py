"""The surface between sites in space, and the paths of greatest clearance on it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _native
from ._analysis import VoxelGrid
from ._mesh import Mesh, as_mesh
from ._progress import shown
from ._results import Result
from ._roadmaps import Path, Roadmap
from .errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Union

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._mesh import MeshLike
    from ._progress import Progress

    #: A Site; a mesh, or an object that ``Mesh()`` accepts; or points, shape (n, 3).
    SiteLike = Union["Site", MeshLike, ArrayLike]


class Site:
    """A set of points of space: the union of its elements. It never changes.

    Args:
        mesh: A closed one is a solid, and the points inside belong to it; an open one is a surface.
        points: Shape (n, 3).
        segments: Pairs of ends, shape (n, 2, 3).
        triangles: Triples of corners, shape (n, 3, 3).
    """

    def __init__(
        self,
        mesh: MeshLike | None = None,
        *,
        points: ArrayLike = (),
        segments: ArrayLike = (),
        triangles: ArrayLike = (),
    ) -> None:
        self.mesh = None if mesh is None else as_mesh(mesh)  #: The mesh, or None.
        self._elements = (points, _rows(segments, 2, "segments"), _rows(triangles, 3, "triangles"))

    def _parts(self) -> tuple[Any, ...]:
        return (None if self.mesh is None else self.mesh._native, *self._elements)

    def __repr__(self) -> str:
        return f"<Site{f' of {self.mesh}' if self.mesh is not None else ''}>"


class SitePoints(Result):
    """n points at equal distance from two sites or more, and from no site less, in the order of their voxels."""

    positions: NDArray[np.float64]  #: Shape (n, 3).
    distances: NDArray[np.float64]  #: To the nearest sites: the clearance.
    errors: NDArray[np.float64]  #: The exact distances of these sites differ by no more, and no site is nearer by more.
    object_angles: NDArray[np.float64]  #: Half the greatest angle between the directions to contacts, radians.
    counts: NDArray[np.uint32]  #: Sites, 2 to 4: 3 on a curve of three sites, 4 where such curves meet.
    sites: NDArray[np.int64]  #: These, ascending, then -1, shape (n, 4).
    contacts: NDArray[np.float64]  #: Their nearest points, then NaN, shape (n, 4, 3).
    voxels: NDArray[np.uint32]  #: Shape (n, 3).

    def __len__(self) -> int:
        return len(self.distances)


class SiteFaces(Result):
    """m faces of the surface, each between two sites."""

    corners: NDArray[np.uint32]  #: Four points in a ring, shape (m, 4).
    sites: NDArray[np.uint32]  #: Ascending; the ring turns left around the way from first to second, shape (m, 2).
    pieces: NDArray[np.uint32]  #: Numbers of pieces.

    def __len__(self) -> int:
        return len(self.pieces)


class SitePieces(Result):
    """Connected faces of one pair of sites."""

    sites: NDArray[np.uint32]  #: Ascending, shape (k, 2).
    faces: NDArray[np.uint64]  #: Their number.
    areas: NDArray[np.float64]  #: In squared units of the sites.
    least_clearances: NDArray[np.float64]  #: At the points of the piece.
    greatest_clearances: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.areas)


class SitePath(Path):
    """A path in space."""

    points: NDArray[np.int64]  #: By point of the line: its number in ``SiteVoronoi.points``; -1 of others.


class SiteRoadmap(Roadmap[SitePath]):
    """The points of a surface between sites as a graph for motion planning, of m links."""

    points: NDArray[np.uint32]  #: By link: two of ``SiteVoronoi.points``, shape (m, 2).
    component_of_point: NDArray[np.uint32]  #: By point.

    def _path_of(self, values: dict[str, Any]) -> SitePath:
        return SitePath(**values)


class SiteVoronoi(Result):
    """The surface between sites: the generalised Voronoi diagram of Section 2.6 of the source. Each voxel has a point, or
    is in one of the three lists, or is proved to have none."""

    grid: VoxelGrid
    points: SitePoints
    faces: SiteFaces
    pieces: SitePieces
    undecided: NDArray[np.uint32]  #: Voxels with neither a point nor a proof that there is none, shape (n, 3).
    tied: NDArray[np.uint32]  #: Voxels where only points with the same contacts on both sites were found, shape (n, 3).
    overlapping: NDArray[np.uint32]  #: Voxels in which sites overlap, shape (n, 3).
    overlaps: NDArray[np.uint32]  #: Pairs of sites that overlap, shape (n, 2).
    cells: int  #: Examined, voxels and smaller ones included.
    sites: list[Site]
    _native: _native.SiteVoronoi

    def __len__(self) -> int:
        return len(self.points)

    def roadmap(self, *, threads: int = 0, progress: Progress = None) -> SiteRoadmap:
        """The graph of greatest clearance between the points; each link has a proved width."""
        with shown(progress) as callback:
            native = self._native.roadmap(threads, callback)
        return SiteRoadmap(_native=native, **native.links())

    def plot(self, ax: Any = None, *, sites: bool = True, alpha: float = 1.0) -> Any:
        """Draws the faces with matplotlib, in a colour for each pair of sites; returns the axes.

        Args:
            ax: Axes of projection "3d"; None: new ones.
            sites: Draw the meshes of the sites as glass, too.
            alpha: Opacity of the faces.
        """
        from ._plots import plot_faces

        meshes = [site.mesh for site in self.sites if sites and site.mesh is not None]
        return plot_faces(self.points.positions, self.faces.corners, self.faces.sites, ax, meshes, alpha)


def site_voronoi(
    sites: Iterable[SiteLike],
    *,
    resolution: int = 160,
    margin: float = 0.0,
    threads: int = 0,
    progress: Progress = None,
) -> SiteVoronoi:
    """The surface between sites in space (docs/theory.md, "Between sites"). No device is needed.

    Args:
        sites: Two at least: ``Site``, meshes, or points of shape (n, 3).
        resolution: Voxels along the longest side of the box, 1 to 2048.
        margin: The box reaches this far beyond the box of all sites, in their units; 0: a quarter of its longest side.
        threads: Of the host, 0: one per core. The result does not depend on it.
        progress: A function of the stage's name and its share, or True for a bar.

    Raises:
        UsageError: An argument is out of range, or has a wrong shape.
        InvalidMeshError: Fewer than two sites, a site without elements, a coordinate that is not finite or beyond 1e75,
            or two sites with the same elements.
    """
    of = [as_site(site) for site in sites]
    options = {"resolution": resolution, "margin": margin, "threads": threads}
    with shown(progress) as callback:
        native = _native.find_site_voronoi([site._parts() for site in of], options, callback)
    values = native.results()
    points = values.pop("points")
    points["contacts"] = points["contacts"].reshape(-1, 4, 3)
    return SiteVoronoi(
        grid=VoxelGrid(**values.pop("grid")),
        points=SitePoints(**points),
        faces=SiteFaces(**values.pop("faces")),
        pieces=SitePieces(**values.pop("pieces")),
        sites=of,
        _native=native,
        **values,
    )


def as_site(site: SiteLike) -> Site:
    """The site itself, or one made of a mesh or of points."""
    if isinstance(site, Site):
        return site
    of: Any = site
    is_mesh = isinstance(site, Mesh) or hasattr(site, "triangles") or hasattr(site, "faces")
    return Site(of) if is_mesh else Site(points=of)


def _rows(elements: Any, corners: int, name: str) -> Any:
    """Elements of several points each as rows of one point."""
    import numpy as np

    try:
        array = np.asarray(elements)
    except ValueError:
        return elements  # its reader says what is wrong with it
    if array.size == 0:
        return ()
    if array.ndim != 3 or array.shape[1:] != (corners, 3):
        raise UsageError(f"`{name}` has the shape {array.shape} where (n, {corners}, 3) is expected")
    return array.reshape(-1, 3)
