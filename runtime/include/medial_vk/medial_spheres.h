// Medial spheres: the result of an extraction, and its options.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "medial_vk/measurements.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

enum class Mode : std::uint32_t {
  kThesis,     ///< Sections 2.3 to 2.4 as published (with the corrected sign of 2.4.2); inside only.
  kCertified,  ///< Proved dismissal, inherited contacts, aimed search, subdivision (docs/theory.md).
};

/// Options of mode thesis only.
struct ThesisOptions {
  bool narrow_features = true;  ///< Also search voxels whose sphere meets the boundary (2.4.3).
  std::array<std::uint32_t, 4> samples = {400, 200, 100, 50};  ///< Points per sphere, 1 to 4096, from coarse to fine.

  bool operator==(const ThesisOptions&) const = default;
};

/// Options of an extraction. Lengths are fractions, so that they do not depend on the units of the mesh.
struct ExtractionOptions {
  Mode mode = Mode::kCertified;
  /// Voxels along the longest side of the bounding box, or of the box of IndexedMesh::on_side(), 1 to 4096.
  std::uint32_t resolution = 160;
  double object_angle = 0.6;  ///< Threshold theta in radians, in (0, pi/2).
  double radius = 0.0;        ///< Radius threshold as a fraction of the longest side, in [0, 1); 0: off.
  /// Mode certified, with a radius threshold: the least object angle of a point whose radius reaches the threshold, in
  /// radians, in (0, pi/2). A value above object_angle has the effect of object_angle. Spokes turn by less at the
  /// creases between the facets of a smooth solid, and by more across medial sheets.
  double deep_angle = 0.15;
  double epsilon = 0.01;           ///< Largest distance from a medial point, in voxel sides: [1e-3, 0.5].
  std::uint32_t extra_levels = 8;  ///< Mode certified: levels of subdivision below the finest voxel, 0 to 10.
  ThesisOptions thesis;            ///< Of mode thesis only.
  /// The device memory to stay below, in bytes. It includes the mesh and the staging memory of copies, but not the
  /// staging memory of moved vertices (ExtractionJob). At least a quarter of it is left for the search, so the total
  /// exceeds the budget if the mesh takes more than three quarters.
  std::uint64_t memory_budget = 1ull << 30;
  /// Of the host; 0: as many as the context has, or one per core without a context. The result does not depend on it.
  unsigned threads = 0;
  MeasurementOptions measurements;

  bool operator==(const ExtractionOptions&) const = default;
};

/// The voxel grid of the output, in the units of the mesh. Voxel of p: floor((p - origin) / voxel_size).
struct VoxelGrid {
  Point origin = {0, 0, 0};
  double voxel_size = 0;
  std::array<std::uint32_t, 3> size = {0, 0, 0};
};

/// One medial sphere, in the units of the mesh.
struct MedialSphere {
  Point centre;
  double radius = 0;                   ///< Distance from the centre to the mesh; certify_spheres() rounds it down.
  std::array<float, 3> spoke_a;        ///< Unit vector from the centre to its nearest boundary point.
  std::array<float, 3> spoke_b;        ///< Unit vector to the boundary point on the other side of the medial sheet.
  float object_angle = 0;              ///< Half the angle between the spokes, radians.
  float flux = 0;                      ///< Average outward flux through the sphere around its voxel (equation 2.4).
  std::int32_t sheet = -1;             ///< -1 until sheets are found (Section 2.5).
  std::array<std::uint32_t, 3> voxel;  ///< Grid coordinates of the voxel that holds the centre.
};

/// The reason why a finest voxel stayed undecided, as a property of any salient medial point that it may still hold.
/// The first kind that applies is given (docs/theory.md, "What undecided means").
enum class UndecidedKind : std::uint32_t {
  kNearFace,   ///< It lies within 1/64 of the voxel side of a face of its voxel.
  kNearAngle,  ///< Its object angle is below object_angle + 0.05.
  /// Its radius is below 1/8 of the voxel side, or the boundary passes through that part of the voxel with triangles
  /// whose normals are not trusted. (Without triangles: its radius is below the voxel side; any_boundary.h.)
  kBoundary,
  kOther,
};
inline constexpr std::size_t kUndecidedKinds = 4;

/// A finest voxel with neither a point found nor a proof that it holds none.
struct UndecidedVoxel {
  std::array<std::uint32_t, 3> voxel;
  UndecidedKind kind = UndecidedKind::kOther;
  /// The greatest distance of the two contacts of a salient medial point that the voxel may hold: the width of equation
  /// 3.1, in the units of the mesh.
  float width = 0;
};

struct Extraction {
  VoxelGrid grid;
  MeshSide side = MeshSide::kInside;      ///< That of the mesh (IndexedMesh::on_side()).
  std::vector<MedialSphere> spheres;      ///< In voxel order: z slowest, then y, then x.
  std::vector<UndecidedVoxel> undecided;  ///< Certified mode, in voxel order.
  ExtractionMeasurements measurements;
};

}  // namespace medial_vk
