"""Medial spheres of triangle meshes, with proofs: spheres and sheets, sphere approximations, unions of balls, distances
and collisions, balls that follow a deforming mesh, thickness and curvature.

    >>> import medial_vk
    >>> found = medial_vk.analyse(medial_vk.read_mesh("part.stl"), resolution=80)
    >>> found.spheres.centres, found.spheres.radii

Lengths are in units of the mesh, angles in radians. Meshes never change, and results belong to the caller; calls release the interpreter's
lock, stop at Ctrl-C, and give the same bytes for the same input on the same device. The exceptions are in
``medial_vk.errors``. The method is that of S. Stolpner, *Medial Spheres for Shape Representation*, 2011.
"""

from __future__ import annotations

import atexit as _atexit

from . import _native, errors
from ._analysis import (
    Analysis,
    Certificate,
    Fatness,
    MedialMesh,
    MedialSpheres,
    SheetRemoval,
    Sheets,
    Significance,
    Topology,
    UndecidedVoxels,
    VoxelGrid,
    analyse,
)
from ._any_boundary import BoundaryAnalysis, analyse_boundary
from ._balls import Balls
from ._boundary import (
    CURVATURE_STATES,
    THICKNESS_KINDS,
    BallCurvature,
    Curvature,
    LeastWall,
    Thickness,
    ThicknessHistogram,
    TipCurvature,
    WallBall,
    curvature,
    least_wall,
    thickness,
)
from ._context import Context, Device, default_context, list_devices
from ._distances import (
    VERDICTS,
    Body,
    DistanceBounds,
    Distances,
    FirstContact,
    NearBodies,
    Penetration,
    PlacedBodies,
    collide,
    distance_bounds,
    distances,
    first_contact,
    penetration,
    rigid_pose,
)
from ._following import (
    FOLLOW_ORIGINS,
    FOLLOW_STATES,
    CoverFollower,
    CoverFollowMeasures,
    FollowedBalls,
    Follower,
    FollowMeasures,
)
from ._groups import BodyGroup, LeastDistances
from ._hulls import HullFit, HullProof, Hulls, fit_hulls, prove_hulls
from ._mesh import ClosestPoints, Mesh, MeshReport, read_mesh
from ._native import VERSION as __version__
from ._page import Page
from ._parts import Part, PartFit, fit_parts
from ._plane import (
    AXIS_NODE_KINDS,
    PLANE_CURVE_KINDS,
    AxisArcs,
    AxisBranches,
    AxisLine,
    AxisNodes,
    PlaneAxis,
    PublishedAxis,
    plane_axis,
    plane_axis_as_published,
)
from ._plane_shape import CircleDecision, NearestOnBoundary, PlaneShape, ShapeReport
from ._plane_sites import PlanePath, PlaneRoadmap, PlaneVoronoi, plane_voronoi
from ._sites import Site, SiteFaces, SitePath, SitePieces, SitePoints, SiteRoadmap, SiteVoronoi, site_voronoi
from ._spheres import (
    CoverProof,
    EnvelopeDistances,
    InsideProof,
    SignedDistances,
    SphereFit,
    SphereFitMetrics,
    SphereMeasures,
    SphereProofs,
    VolumeError,
    fit_spheres,
    measure_gap,
    prove_spheres,
)
from ._unions import BallUnion, DeviceBallUnion, DualComplex, measure_union, measure_union_on_device

__all__ = [
    "AXIS_NODE_KINDS",
    "Analysis",
    "AxisArcs",
    "AxisBranches",
    "AxisLine",
    "AxisNodes",
    "BallCurvature",
    "BallUnion",
    "Balls",
    "Body",
    "BodyGroup",
    "BoundaryAnalysis",
    "CURVATURE_STATES",
    "Certificate",
    "CircleDecision",
    "ClosestPoints",
    "Context",
    "CoverFollowMeasures",
    "CoverFollower",
    "CoverProof",
    "Curvature",
    "Device",
    "DeviceBallUnion",
    "DistanceBounds",
    "Distances",
    "DualComplex",
    "EnvelopeDistances",
    "FOLLOW_ORIGINS",
    "FOLLOW_STATES",
    "Fatness",
    "FirstContact",
    "FollowMeasures",
    "FollowedBalls",
    "Follower",
    "HullFit",
    "HullProof",
    "Hulls",
    "InsideProof",
    "LeastDistances",
    "LeastWall",
    "MedialMesh",
    "MedialSpheres",
    "Mesh",
    "MeshReport",
    "NearBodies",
    "NearestOnBoundary",
    "PLANE_CURVE_KINDS",
    "Page",
    "Part",
    "PartFit",
    "Penetration",
    "PlacedBodies",
    "PlaneAxis",
    "PlanePath",
    "PlaneRoadmap",
    "PlaneShape",
    "PlaneVoronoi",
    "PublishedAxis",
    "ShapeReport",
    "SheetRemoval",
    "Sheets",
    "SignedDistances",
    "Significance",
    "Site",
    "SiteFaces",
    "SitePath",
    "SitePieces",
    "SitePoints",
    "SiteRoadmap",
    "SiteVoronoi",
    "SphereFit",
    "SphereFitMetrics",
    "SphereMeasures",
    "SphereProofs",
    "THICKNESS_KINDS",
    "Thickness",
    "ThicknessHistogram",
    "TipCurvature",
    "Topology",
    "UndecidedVoxels",
    "VERDICTS",
    "VolumeError",
    "VoxelGrid",
    "WallBall",
    "__version__",
    "analyse",
    "analyse_boundary",
    "collide",
    "curvature",
    "default_context",
    "distance_bounds",
    "distances",
    "errors",
    "first_contact",
    "fit_hulls",
    "fit_parts",
    "fit_spheres",
    "least_wall",
    "list_devices",
    "measure_gap",
    "measure_union",
    "measure_union_on_device",
    "penetration",
    "plane_axis",
    "plane_axis_as_published",
    "plane_voronoi",
    "prove_hulls",
    "prove_spheres",
    "read_mesh",
    "rigid_pose",
    "site_voronoi",
    "thickness",
]

# Calls that Ctrl-C has ended may still use a device. Those of other threads may call functions.
_atexit.register(_native.wait_for_abandoned)
_atexit.register(_native.end_functions)
