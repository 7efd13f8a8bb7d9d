"""Exact measures of unions of balls."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import _native
from ._analysis import Topology
from ._balls import as_arrays
from ._context import Context
from ._results import Result

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ._balls import BallsLike


class DualComplex(Result):
    """The nerve of the balls, each restricted to its power cell: it has the topology of the union. Indices of balls
    ascend within a simplex."""

    vertices: NDArray[np.uint32]  #: Balls with a share of the union, shape (n,).
    edges: NDArray[np.uint32]  #: Shape (m, 2).
    triangles: NDArray[np.uint32]  #: Shape (k, 3).
    tetrahedra: NDArray[np.uint32]  #: Shape (l, 4).
    _native: _native.DualComplex

    def topology(self) -> Topology:
        """Betti numbers over Z/2 of the union."""
        components, tunnels, cavities = self._native.betti_numbers()
        return Topology(components=components, tunnels=tunnels, cavities=cavities)


class BallUnion(Result):
    """Measures of a union of n balls, in their units. Arrays are by ball."""

    volume: float
    area: float  #: Of the envelope.
    volumes: NDArray[np.float64]  #: Of the ball in its power cell; sums to ``volume``.
    areas: NDArray[np.float64]  #: Of the part of its sphere on the envelope; sums to ``area``.
    vectors: NDArray[np.float64]  #: Integrals of the outward unit normals over that part, shape (n, 3).
    complex: DualComplex | None
    envelope_vertices: NDArray[np.float64]  #: Where three spheres meet, shape (v, 3); with ``complex``.
    envelope_balls: NDArray[np.uint32]  #: These three, shape (v, 3).


class DeviceBallUnion(Result):
    """The same in float, on a device, with error bounds."""

    volume: float
    area: float
    volume_bound: float  #: Of the error of ``volume``.
    area_bound: float
    volumes: NDArray[np.float64]
    areas: NDArray[np.float64]
    volume_bounds: NDArray[np.float64]  #: By ball.
    area_bounds: NDArray[np.float64]
    redone: NDArray[np.uint32]  #: Balls that the host measured in double precision.


def measure_union(balls: BallsLike, *, complex: bool = False, threads: int = 0) -> BallUnion:
    """Volume, area and each ball's share of both, exact up to the rounding of double precision.

    Args:
        balls: A result with ``centres`` and ``radii``, a pair of such arrays, or an array of shape (n, 4).
        complex: Also find the dual complex and the vertices of the envelope.

    Raises:
        UsageError: A number that is not finite, or a negative radius; names the ball.
    """
    values = _native.measure_union(*as_arrays(balls), complex, threads)
    native = values.pop("complex")
    return BallUnion(
        complex=None if native is None else DualComplex(_native=native, **native.simplices()), **values
    )


def measure_union_on_device(
    balls: BallsLike, *, tolerance: float = 1e-3, threads: int = 0, context: Context | None = None
) -> DeviceBallUnion:
    """The same on a device, in float with error bounds.

    Args:
        tolerance: Of a ball of radius r: the error bound of its volume is at most tolerance r^3, that of its area
            10 tolerance r^2.
    """
    from ._context import native_context

    values = _native.measure_union_on_device(*as_arrays(balls), native_context(context), tolerance, threads)
    return DeviceBallUnion(**values)
