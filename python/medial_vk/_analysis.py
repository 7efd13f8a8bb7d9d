"""Medial spheres of a mesh, and what follows from them."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from . import _native
from ._balls import Balls
from ._context import Context, native_context
from ._mesh import Mesh, as_mesh
from ._progress import shown
from ._results import Result
from .errors import UsageError

if TYPE_CHECKING:
    from typing import Literal

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._mesh import MeshLike
    from ._page import Page
    from ._progress import Progress


class VoxelGrid(Result):
    """The voxels of a search. The voxel of p is floor((p - origin) / voxel_size)."""

    origin: NDArray[np.float64]  #: Shape (3,).
    voxel_size: float  #: In units of the mesh.
    size: tuple[int, int, int]


class MedialSpheres(Result):
    """n medial spheres in the order of their voxels, in units of the mesh. Every ball is proved, in double precision, to
    lie inside the solid and to touch its boundary."""

    centres: NDArray[np.float64]  #: Shape (n, 3).
    radii: NDArray[np.float64]  #: Never above the exact distance from the centre to the mesh. Shape (n,).
    spokes_a: NDArray[np.float32]  #: Unit vectors to the nearest boundary points, shape (n, 3).
    spokes_b: NDArray[np.float32]  #: To the boundary points on the other side of the sheet, shape (n, 3).
    object_angles: NDArray[np.float32]  #: Half the angles between the spokes, radians.
    flux: NDArray[np.float32]  #: Average outward flux of the distance gradient (equation 2.4 of the source).
    sheets: NDArray[np.int32]  #: Numbers of medial sheets, 0 the one with the most points; -1 without sheets.
    voxels: NDArray[np.uint32]  #: Of the centres, shape (n, 3).

    def __len__(self) -> int:
        return len(self.radii)


class UndecidedVoxels(Result):
    """Voxels with neither a point nor a proof that they hold none."""

    voxels: NDArray[np.uint32]  #: Shape (n, 3).
    kinds: list[str]  #: "near face", "near angle", "boundary" or "other": docs/theory.md, "What undecided means".
    widths: NDArray[np.float32]  #: Greatest distance of the contacts of a point that the voxel may hold.

    def __len__(self) -> int:
        return len(self.widths)


class Certificate(Result):
    """Spheres by the outcome of their certificate in double precision; rejected ones are left out."""

    passed: int
    rejected: int


class Topology(Result):
    """Betti numbers."""

    components: int
    tunnels: int
    cavities: int


class Sheets(Result):
    """Medial sheets (Section 2.5 of the source), by decreasing number of points; marks are by sphere."""

    points: NDArray[np.uint64]  #: By sheet: its number of points; 0 if it was removed.
    areas: NDArray[np.float64]  #: By sheet; 0 unless volumes were requested.
    mean_radii: NDArray[np.float64]
    mean_object_angles: NDArray[np.float64]  #: Radians.
    significance: NDArray[np.float64]  #: Lambda of equation 6.2; NaN unless volumes were requested.
    is_seam: NDArray[np.bool_]  #: By sphere: another sheet is beside it.
    is_rim: NDArray[np.bool_]  #: By sphere: its sheet ends there.
    is_small: NDArray[np.bool_]  #: By sphere: its component is too small for a sheet of its own; its sheet is unreliable.
    point_areas: NDArray[np.float64]  #: By sphere: of the sheet in its voxel; empty unless volumes were requested.
    absorbed_points: int  #: Of components that were too narrow, or had too few points.
    fragments: int  #: Sheets of fewer than ten points.


class Significance(Result):
    """The share of the volume that each ball and each sheet holds (Chapter 6 of the source)."""

    volume: float  #: Of the union of the balls.
    area: float  #: Of its envelope.
    topology: Topology
    of_component: NDArray[np.float64]  #: The shares of the union's components, decreasing.
    of_ball: NDArray[np.float64]  #: Sums to 1.
    of_sheet: NDArray[np.float64]  #: Sums to 1.
    areas: NDArray[np.float64]  #: By ball: of its part of the envelope.


class SheetRemoval(Result):
    """An order in which sheets are removed."""

    removed: NDArray[np.uint32]  #: Numbers of sheets; the first removed comes first.
    volume_left: NDArray[np.float64]  #: After each removal: share of the volume of the whole union.
    kept: NDArray[np.uint32]  #: By decreasing significance.


class MedialMesh(Result):
    """The spheres joined to a surface with the topology of the union of their balls."""

    triangles: NDArray[np.uint32]  #: Indices of spheres, shape (m, 3).
    edges: NDArray[np.uint32]  #: Those of the triangles, and bare ones, shape (k, 2).
    topology: Topology
    euler_characteristic: int
    boundary_edges: int  #: Of one triangle.
    non_manifold_edges: int  #: Of three triangles or more, where sheets meet.
    bare_edges: int  #: Of no triangle, where the medial surface is a curve.
    hosted_points: int  #: Spheres that another one represents.


class Fatness(Result):
    """For which voxels a solid is fat (Section 8.3 of the source), by k object angles: medial spheres of neighbouring voxels
    then overlap. This is what a sample of medial points says; the true least radius may be smaller."""

    object_angles: NDArray[np.float64]  #: Radians, shape (k,).
    spheres: NDArray[np.uint64]  #: Numbers of medial points with at least this object angle.
    least_radii: NDArray[np.float64]  #: Of these; 0 if there are none.
    largest_voxels: NDArray[np.float64]  #: The sample is fat for voxels up to this side.
    components: NDArray[np.uint64]  #: Of their voxels, where those with a common corner are joined.
    proves_connected: NDArray[np.bool_]  #: That the union of their spheres is connected.


class Analysis(Result):
    """The result of ``analyse()``. What was not requested is None. It can be pickled, with its mesh and its arrays as the
    library has made them, and gives the same files and pages afterwards."""

    mesh: Mesh
    grid: VoxelGrid
    spheres: MedialSpheres
    undecided: UndecidedVoxels
    certificate: Certificate
    simplified: int  #: Spheres left out by ``simplify``.
    sheets: Sheets | None
    significance: Significance | None
    by_significance: SheetRemoval | None  #: The least significant sheet goes first.
    keeping_topology: SheetRemoval | None  #: The same among sheets without which the topology stays.
    removal: SheetRemoval | None  #: Sheets removed by ``keep_volume``.
    medial_mesh: MedialMesh | None
    euler_characteristic: int | None  #: Of the solid, with a medial mesh.
    seconds: dict[str, float]  #: Wall-clock times of the steps.
    _native: _native.Analysis

    @property
    def balls(self) -> Balls:
        """Centres and radii of the spheres."""
        return Balls(centres=self.spheres.centres, radii=self.spheres.radii)

    @property
    def side(self) -> str:
        """Of the boundary, on which the spheres are: "inside" or "outside"."""
        return self.mesh.side

    def __len__(self) -> int:
        return len(self.spheres)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.mesh, self._native.state())

    def fatness(self, object_angles: ArrayLike, *, threads: int = 0) -> Fatness:
        """Least radii of the medial points, and what they mean for voxels, by k object angles in radians, shape (k,)."""
        values = self._native.fatness(object_angles, threads)
        values["proves_connected"] = values["proves_connected"].view(bool)
        return Fatness(**values)

    def save(self, path: str | os.PathLike[str], *, ascii: bool = False) -> None:
        """Writes the spheres as the command-line tool does: ``.ply`` and ``.csv`` have the same bytes, ``.npz`` the
        same arrays.

        Raises:
            UsageError: Another extension.
        """
        name = os.fspath(path)
        extension = os.path.splitext(name)[1].lower()
        if ascii and extension != ".ply":
            raise UsageError("`ascii` is for .ply")
        if extension == ".npz":
            import numpy as np

            with open(name, "wb") as file:
                np.savez(file, **self._arrays())
        elif extension in (".ply", ".csv"):
            with open(name, "wb") as file:
                file.write(self._native.encode(extension[1:], ascii))
        else:
            raise UsageError(f"{name}: the extension is not .ply, .csv or .npz")

    def _arrays(self) -> dict[str, Any]:
        spheres, marks = self.spheres, dict[str, Any]()
        if self.sheets is not None:
            marks = {"seam": self.sheets.is_seam, "rim": self.sheets.is_rim}
        if self.side == "outside":
            import numpy as np

            marks["side"] = np.ones(len(spheres), dtype=np.uint8)
        return {
            "centre": spheres.centres,
            "radius": spheres.radii,
            "spoke_a": spheres.spokes_a,
            "spoke_b": spheres.spokes_b,
            "object_angle": spheres.object_angles,
            "flux": spheres.flux,
            "sheet": spheres.sheets,
            "voxel": spheres.voxels,
            "grid_origin": self.grid.origin,
            "voxel_size": self.grid.voxel_size,
            **self._native.header(),
            **marks,
        }

    def page(self, *, title: str = "mesh", up: str = "y") -> Page:
        """A page that shows mesh, balls, medial points, spokes and sheets in a browser or a notebook.

        Args:
            title: The name of the mesh on the page.
            up: The axis that points up: "x", "y", "z", "-x", "-y" or "-z".

        Raises:
            UsageError: The package was built without pages.
        """
        from ._page import Page

        return Page(self._native.page(title, {"up": up}))

    def plot(self, ax: Any = None, *, colour: str = "object_angles", mesh: bool = True) -> Any:
        """Draws the medial points with matplotlib; returns the axes.

        Args:
            ax: Axes of projection "3d"; None: new ones.
            colour: A field of ``spheres`` with one number each: "object_angles", "radii", "sheets" or "flux".
            mesh: Draw the mesh as glass, too.
        """
        from ._plots import plot_points

        return plot_points(self.spheres.centres, getattr(self.spheres, colour), ax, self.mesh if mesh else None, colour)

    def _repr_html_(self) -> str:
        rows = [("medial spheres", f"{len(self.spheres):,}"), ("undecided voxels", f"{len(self.undecided):,}")]
        if self.sheets is not None:
            rows.append(("sheets", f"{len(self.sheets.points):,}"))
        rows.append(("voxel size", f"{self.grid.voxel_size:.6g}"))
        if self.significance is not None:
            rows.append(("volume of the union", f"{self.significance.volume:.6g}"))
        cells = "".join(f"<tr><td>{name}</td><td>{value}</td></tr>" for name, value in rows)
        return f"<table><caption>medial-vk</caption>{cells}</table>"


# long: each option has three lines
def analyse(
    mesh: MeshLike,
    *,
    resolution: int = 160,
    object_angle: float = 0.6,
    radius: float = 0.0,
    mode: Literal["certified", "thesis"] = "certified",
    deep_angle: float = 0.15,
    epsilon: float = 0.01,
    extra_levels: int = 8,
    sheets: bool = True,
    sheet_angle: float = 5.7,
    sheet_crease: float = 10.0,
    sheet_border: float = 77.0,
    sheet_width: float = 0.17,
    absorb_fragments: int = 0,
    simplify: bool = False,
    volumes: bool = False,
    keep_volume: float = 0.0,
    keep_topology: bool = False,
    removal_orders: bool = False,
    medial_mesh: bool = False,
    memory_budget: int = 1 << 30,
    threads: int = 0,
    context: Context | None = None,
    progress: Progress = None,
) -> Analysis:
    """Finds the medial spheres of a mesh, certifies them, and groups them into sheets.

    Args:
        mesh: A ``Mesh``, or an object that ``Mesh()`` accepts.
        resolution: Voxels along the longest side of the bounding box, 1 to 4096.
        object_angle: Least half angle between the spokes, radians, in (0, pi / 2).
        radius: Also keep spheres with at least this radius, a fraction of the longest side in [0, 1), whose object angle
            is at least ``deep_angle``; 0: none.
        mode: "certified" (every voxel has a point, a proof that it holds none, or is listed as undecided) or "thesis"
            (Sections 2.3 and 2.4 of the source as published).
        deep_angle: With ``radius``: least object angle of these, radians.
        epsilon: Greatest distance from a medial point, in voxel sides, 0.001 to 0.5.
        extra_levels: Levels of subdivision below the finest voxel, 0 to 10.
        sheets: Group the spheres into sheets; the next five arguments are those of ``SheetOptions`` (docs/theory.md).
        simplify: Leave out spheres whose centre lies within epsilon of another's.
        volumes: Measure the union of the balls, and the significance of balls and sheets.
        keep_volume: Remove the least significant sheets while the others hold this share of the volume; 0: none.
        keep_topology: With ``keep_volume``: keep sheets whose removal would change the topology.
        removal_orders: Find the complete orders of removal by both rules.
        medial_mesh: Join the spheres to a surface with the topology of their union.
        memory_budget: Of the device, in bytes.
        threads: Of the host, 0: as many as the context has. No result depends on it.
        context: Where it is computed; None: ``default_context()``.
        progress: A function of the stage's name and its share, or True for a bar.

    Raises:
        UsageError: An argument is out of range.
        InvalidMeshError: The mesh has no extent.
        NoDeviceError: There is no device.
        OutOfMemoryError: Memory does not suffice.

    The same mesh, arguments and device give the same bytes, those of the command-line tool.
    """
    if keep_topology and keep_volume == 0:
        raise UsageError("`keep_topology` has no effect without `keep_volume`")
    of = as_mesh(mesh)
    options = {
        "mode": mode,
        "resolution": resolution,
        "object_angle": object_angle,
        "radius": radius,
        "deep_angle": deep_angle,
        "epsilon": epsilon,
        "extra_levels": extra_levels,
        "memory_budget": memory_budget,
        "sheets": sheets,
        "sheet_angle": sheet_angle,
        "sheet_crease": sheet_crease,
        "sheet_border": sheet_border,
        "sheet_width": sheet_width,
        "absorb_fragments": absorb_fragments,
        "simplify": simplify,
        "volumes": volumes,
        "keep_volume": keep_volume,
        "keep_topology": keep_topology,
        "removal_orders": removal_orders,
        "medial_mesh": medial_mesh,
        "threads": threads,
    }
    with shown(progress) as callback:
        native = _native.analyse(of._native, native_context(context), options, callback)
    return _analysis_of(of, native)


def _analysis_of(mesh: Mesh, native: _native.Analysis) -> Analysis:
    values = native.results()
    passed, rejected = values.pop("certificate")
    significance = values.pop("significance")
    medial_mesh = values.pop("medial_mesh")
    for part in (significance, medial_mesh):
        if part is not None:
            part["topology"] = Topology(**part["topology"])
    removals = {}
    for name in ("by_significance", "keeping_topology", "removal"):
        removal = values.pop(name)
        removals[name] = None if removal is None else SheetRemoval(**removal)
    return Analysis(
        mesh=mesh,
        grid=VoxelGrid(**values.pop("grid")),
        spheres=MedialSpheres(**values.pop("spheres")),
        undecided=UndecidedVoxels(**values.pop("undecided")),
        certificate=Certificate(passed=passed, rejected=rejected),
        sheets=sheets_of(values.pop("sheets")),
        significance=None if significance is None else Significance(**significance),
        medial_mesh=None if medial_mesh is None else MedialMesh(**medial_mesh),
        _native=native,
        **removals,
        **values,
    )


def _restored(mesh: Mesh, state: bytes) -> Analysis:
    """An analysis that was pickled."""
    return _analysis_of(mesh, _native.restore_analysis(mesh._native, state))


def sheets_of(values: dict[str, Any] | None) -> Sheets | None:
    """The sheets that the library has found."""
    if values is None:
        return None
    for name in ("is_seam", "is_rim", "is_small"):
        values[name] = values[name].view(bool)
    return Sheets(**values)
