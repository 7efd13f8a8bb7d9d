"""The least distance among the links of an assembly, such as a robot and its surroundings."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from . import _native
from ._distances import Body
from ._results import Result
from .errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import ArrayLike, NDArray


class LeastDistances(Result):
    """Intervals that contain the least distance of all compared bodies in n configurations, 0 where two of them have a common
    point."""

    lower: NDArray[np.float64]  #: Shape (n,).
    upper: NDArray[np.float64]  #: Shape (n,); infinite where only the limit is proved.
    verdicts: NDArray[np.uint8]  #: Indices into ``VERDICTS``: all are free, two are a hit, or undecided. Shape (n,).
    lower_pairs: NDArray[np.int64]  #: The bodies that give ``lower``, shape (n, 2); -1: all are beyond the limit.
    upper_pairs: NDArray[np.int64]  #: Those that give ``upper``; where it is 0, two with a common point.
    _native: _native.LeastDistances

    def __len__(self) -> int:
        return len(self.lower)


class BodyGroup:
    """Bodies on links that move relative to one another, and the pairs of links that are compared. It never changes, so
    that any number of threads may query it.

    Args:
        bodies: n bodies, each with a mesh or a cover. One body may be there several times.
        links: By body: the index of its link, shape (n,). The bodies of a link move together.
        pairs: Of links that are compared, shape (m, 2); None: all pairs of different links.
        poses: Take the frames of the bodies to those of their links, shape (n, 4, 4); None: they are the same.
        count: Of the links; 0: the greatest index and one. A link may have no body.

    Raises:
        UsageError: A link out of range, a pair of a link and itself, a body with neither mesh nor cover, a pose that is
            no rigid motion.
    """

    def __init__(
        self,
        bodies: Sequence[Body],
        links: ArrayLike,
        pairs: ArrayLike | None = None,
        *,
        poses: ArrayLike | None = None,
        count: int = 0,
    ) -> None:
        import numpy as np

        of = np.asarray(links)
        if of.ndim != 1 or (of.size > 0 and of.dtype.kind not in "iu"):
            raise UsageError(f"`links` has the shape {of.shape} and the type {of.dtype}; n integers are expected")
        count = count or int(of.max(initial=-1)) + 1
        if pairs is None:
            used = np.unique(of)
            pairs = np.column_stack([used[i] for i in np.triu_indices(len(used), 1)])
        self._native = _native.make_group([body._native for body in bodies], of, poses, count, pairs)

    @property
    def links(self) -> int:
        """Their number."""
        return self._native.sizes()[1]

    def least_distances(
        self,
        poses: ArrayLike,
        *,
        exact: bool = False,
        tolerance: float = 0.0,
        limit: float = math.inf,
        start: LeastDistances | None = None,
        threads: int = 0,
    ) -> LeastDistances:
        """The least distance of all compared bodies in each configuration.

        Args:
            poses: Take the frames of the links to a common one: shape (n, links, 4, 4), or (links, 4, 4) for one
                configuration, whose result has arrays of one element.
            exact: Triangles decide where balls do not; all bodies have meshes. Otherwise balls alone.
            tolerance: With ``exact``: the greatest width of an interval, in units of the meshes.
            limit: Where the least distance is greater, only that is proved; 0: only collisions are decided, which is
                fastest.
            start: For one configuration: an earlier result of this group, from whose last configuration the search
                starts. It is faster if the poses have changed little.
            threads: Of the host, 0: one per core.

        Raises:
            UsageError: Another number of poses, a matrix that is no rigid motion to within 1e-13 (``rigid_pose()``
                makes the nearest one), an option that is negative or no number.
        """
        import numpy as np

        shape = np.shape(poses)
        if len(shape) not in (3, 4) or shape[-3:] != (self.links, 4, 4):
            raise UsageError(f"`poses` has the shape {shape} where (n, {self.links}, 4, 4) or ({self.links}, 4, 4) is expected")
        configurations = shape[0] if len(shape) == 4 else 1
        if start is not None and configurations != 1:
            raise UsageError(f"`start` is for one configuration, not {configurations}")
        options = {"exact": exact, "tolerance": tolerance, "limit": limit, "threads": threads}
        rows = np.reshape(poses, (configurations * self.links, 4, 4))
        native = self._native.least_distances(rows, configurations, options, None if start is None else start._native)
        return LeastDistances(_native=native, **native.results())

    def __repr__(self) -> str:
        bodies, links, pairs = self._native.sizes()
        return f"<BodyGroup of {bodies} bodies on {links} links, {pairs} pairs of which are compared>"
