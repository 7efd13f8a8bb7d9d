"""Curves between sites in the plane, and the paths of greatest clearance along them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _native
from ._plane import PlaneAxis, axis_fields
from ._plane_shape import PlaneShape
from ._progress import shown
from ._roadmaps import Path, Roadmap
from .errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Union

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._progress import Progress

    #: A PlaneShape, a solid; or a line through points, shape (n, 2): with n = 1 a point.
    PlaneSiteLike = Union[PlaneShape, ArrayLike]


class PlanePath(Path):
    """A path in the plane."""


class PlaneRoadmap(Roadmap[PlanePath]):
    """Curves between sites as a graph for motion planning, of m links."""

    arcs: NDArray[np.uint32]  #: By link: its arc of ``PlaneVoronoi.arcs``, shape (m,).
    component_of_node: NDArray[np.uint32]  #: By node of ``PlaneVoronoi.nodes``.

    def _path_of(self, values: dict[str, Any]) -> PlanePath:
        return PlanePath(**values)


class PlaneVoronoi(PlaneAxis):
    """The curves between sites: the points at equal distance from two different sites at least, and from no site less.
    Fields are those of an axis; contacts are indices of ``points`` and ``segments``."""

    points: NDArray[np.float64]  #: Of the sites, shape (n, 2).
    segments: NDArray[np.uint32]  #: Of the sites, by indices of points, shape (m, 2).
    site_of_point: NDArray[np.uint32]  #: By point.
    site_of_segment: NDArray[np.uint32]  #: By segment.

    @property
    def arc_sites(self) -> NDArray[np.uint32]:
        """The sites on both sides of each arc, shape (number of arcs, 2)."""
        import numpy as np

        contacts, is_point = self.arcs.contacts, self.arcs.contact_is_point
        sites = np.empty(contacts.shape, dtype=np.uint32)
        sites[is_point] = self.site_of_point[contacts[is_point]]
        sites[~is_point] = self.site_of_segment[contacts[~is_point]]
        return sites

    def roadmap(self, *, threads: int = 0) -> PlaneRoadmap:
        """The graph of greatest clearance; its links are arcs with proved widths."""
        native = self._native.roadmap(threads)
        return PlaneRoadmap(_native=native, **native.links())


def plane_voronoi(
    sites: Iterable[PlaneSiteLike],
    *,
    object_angle: float = 0.0,
    margin: float = 0.0,
    threads: int = 0,
    progress: Progress = None,
) -> PlaneVoronoi:
    """The generalised Voronoi diagram of sites in the plane (Section 2.6 of the source). No device is needed.

    Args:
        sites: Two at least, which are apart: ``PlaneShape`` for a solid, or the points of a line, shape (n, 2), one row
            for a point. A line may cross itself.
        object_angle: Least half angle between the directions to both sites, radians.
        margin: The square around the box of all sites is searched that reaches this far beyond it, in units of the
            sites; 0: half the longest side.
        threads: Of the host, 0: one per core. The result does not depend on it.
        progress: A function of the stage's name and its share, or True for a bar.

    Raises:
        UsageError: Fewer than two sites, or an argument that is out of range, or neither shape nor line.
        InvalidMeshError: A coordinate that is not finite, a line with the same point twice in a row, or sites that
            cross, touch or overlap; the message names two of them.
    """
    elements = [site._native if isinstance(site, PlaneShape) else site for site in sites]
    if len(elements) < 2:
        raise UsageError(f"two sites at least are expected, not {len(elements)}")
    options = {"object_angle": object_angle, "margin": margin, "threads": threads}
    with shown(progress) as callback:
        native = _native.find_plane_voronoi(elements, options, callback)
    return PlaneVoronoi(shape=None, excess=0.0, **axis_fields(native), **native.sites())
