"""Sets of balls: what most results hold, and what many calls take."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._results import Result

if TYPE_CHECKING:
    from typing import Union

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    #: A result with ``centres`` and ``radii``, a pair of such arrays, or one array of shape (n, 4): x, y, z, radius.
    BallsLike = Union["Balls", tuple[ArrayLike, ArrayLike], ArrayLike, Any]


class Balls(Result):
    """n balls, in the units of the mesh."""

    centres: NDArray[np.float64]  #: Shape (n, 3).
    radii: NDArray[np.float64]  #: Shape (n,).

    def __len__(self) -> int:
        return len(self.radii)

    def plot(self, ax: Any = None, *, colour: Any = None, mesh: Any = None) -> Any:
        """Draws the balls with matplotlib, and ``mesh`` as glass around them; returns the axes.

        Args:
            ax: Axes of projection "3d"; None: new ones.
            colour: A colour of matplotlib, or a number for each ball; None: by radius.
        """
        from ._plots import plot_balls

        return plot_balls(self.centres, self.radii, ax, colour, mesh)


def as_arrays(balls: BallsLike | None) -> tuple[Any, Any]:
    """Centres and radii; none for None."""
    if balls is None:
        return (), ()
    balls = getattr(balls, "balls", balls)  # those of an analysis
    centres, radii = getattr(balls, "centres", None), getattr(balls, "radii", None)
    if centres is not None and radii is not None:
        return centres, radii
    if isinstance(balls, tuple) and len(balls) == 2:
        return balls[0], balls[1]
    import numpy as np

    array = np.asarray(balls)
    if array.ndim != 2 or array.shape[1] != 4:
        from .errors import UsageError

        raise UsageError(
            f"an array of the shape {array.shape} is no set of balls: (n, 4) is expected, or centres and radii"
        )
    return array[:, :3], array[:, 3]
