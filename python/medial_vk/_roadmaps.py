"""What roadmaps in the plane and in space have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, TypeVar

from ._results import Result

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


class Path(Result):
    """A path; a disc or a ball of radius ``width`` around its points meets no site."""

    line: NDArray[np.float64]  #: From the first place to the last, shape (n, 2) in the plane, (n, 3) in space.
    width: float  #: In units of the sites.
    length: float


P = TypeVar("P", bound=Path)


class Roadmap(Result, Generic[P]):
    """A graph of greatest clearance between sites, of m links. It never changes."""

    lengths: NDArray[np.float64]  #: By link, in units of the sites, shape (m,).
    widths: NDArray[np.float64]  #: A disc or a ball of this radius passes along the link, by proof.
    components: int
    _native: Any

    def __len__(self) -> int:
        return len(self.lengths)

    def widest_path(self, start: ArrayLike, end: ArrayLike) -> P | None:
        """Of the paths on the graph with the greatest width, the shortest; a path beside the graph may be wider.

        Args:
            start, end: Places outside of all sites, shape (2,) in the plane, (3,) in space.

        Returns:
            None if no straight lines to the graph are found, or both ends are in different components.

        Raises:
            UsageError: A place that is not finite, or in or on a site.
        """
        values = self._native.widest_path(start, end)
        return None if values is None else self._path_of(values)

    def _path_of(self, values: dict[str, Any]) -> P:
        raise NotImplementedError
