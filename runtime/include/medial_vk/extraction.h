// The main job: medial spheres of a mesh, found on the device.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "medial_vk/mesh_index.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

class Context;

enum class Mode : std::uint32_t {
  kThesis,     ///< Sections 2.3 to 2.4 as published (with the corrected sign of 2.4.2).
  kCertified,  ///< Proved dismissal, inherited contacts, aimed search, subdivision (docs/theory.md).
};

/// Parameters of an extraction. Lengths are fractions, so that they do not depend on the units of the mesh.
struct ExtractionParameters {
  Mode mode = Mode::kCertified;
  std::uint32_t resolution = 160;  ///< Voxels along the longest side of the bounding box, 1 to 4096.
  double object_angle = 0.6;       ///< Threshold theta in radians, in (0, pi/2).
  double radius = 0.0;             ///< Radius threshold as a fraction of the longest side; 0: off (angle only).
  /// Certified, with a radius threshold: the object angle that a point of that radius must have (never above
  /// object_angle), radians. Creases between the facets of a smooth solid turn by less, medial sheets by more.
  double deep_angle = 0.15;
  double epsilon = 0.01;           ///< Tolerance as a fraction of the voxel side, in [1e-3, 0.5].
  std::uint32_t extra_levels = 6;  ///< Certified: levels of subdivision below the finest voxel before giving up.
  bool narrow_features = true;     ///< Thesis: also search voxels whose sphere meets the boundary (2.4.3).
  std::array<std::uint32_t, 4> samples = {400, 200, 100, 50};  ///< Thesis: points per sphere, coarse to fine.
  /// Bytes of device memory to stay below, the mesh and what copies pass through included, but not what moved vertices
  /// go up through (ExtractionJob). A mesh that takes more than three quarters of it comes on top.
  std::uint64_t memory_budget = 1ull << 30;
  /// Certified: Extraction::device_times by kernel and level ("mark_contacts@2"; a number after a slash tells variants
  /// of a kernel apart, "/second" the tasks of one that has two) instead of by stage. Every dispatch then ends with a
  /// timestamp.
  bool kernel_times = false;

  bool operator==(const ExtractionParameters&) const = default;
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
  float flux = 0;                      ///< Average outward flux through the sphere around its voxel (2.4).
  std::int32_t sheet = -1;             ///< -1 until sheets are grown (Section 2.5).
  std::array<std::uint32_t, 3> voxel;  ///< Grid coordinates of the voxel that holds the centre.
};

/// Why a finest voxel stayed undecided: what a salient medial point that hides in it must be like. A voxel counts under
/// the first of these that holds (docs/theory.md, "What undecided means").
enum class UndecidedKind : std::uint32_t {
  kNearFace,   ///< It lies within 1/64 of the voxel side of a face of its voxel.
  kNearAngle,  ///< Its object angle is below object_angle + 0.05.
  /// Its radius is below 1/8 of the voxel side; or the boundary passes through that part of the voxel, with triangles
  /// whose normals cannot be trusted.
  kBoundary,
  kOther,
};
inline constexpr std::size_t kUndecidedKinds = 4;

/// A finest voxel that is neither found nor proved empty.
struct UndecidedVoxel {
  std::array<std::uint32_t, 3> voxel;
  UndecidedKind kind = UndecidedKind::kOther;
  /// The two contacts of a salient medial point that hides there are at most this far apart: the width of equation 3.1,
  /// in the units of the mesh.
  float width = 0;
};

/// Voxel order: z slowest, then y, then x.
inline bool is_earlier_voxel(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
}

/// Where the voxels and the time went. Counts do not depend on the machine.
struct ExtractionCounters {
  struct Level {
    double cell_size = 0;        ///< As a fraction of the longest side.
    std::uint64_t visited = 0;   ///< Cells examined.
    std::uint64_t kept = 0;      ///< Cells that could not be dismissed.
    std::uint64_t contacts = 0;  ///< Sum of the lengths of the kept cells' contact lists.
    std::uint64_t found = 0;     ///< Voxels that got their point at this level (finest level and below).
    std::uint64_t lines = 0;     ///< Certified on a device: lines narrowed, by narrowing_steps steps each.
    /// On a device: distances between points and triangles of contact lists, for dismissal, lines and flux, but not
    /// those of the features of pairs; and triangles in leaves that walks of the tree get to (of which winding numbers
    /// ask solid angles).
    std::uint64_t triangle_tests = 0;
    /// Certified on a device: distances between points and clusters of triangles, where cells are large; `contacts`
    /// counts clusters there.
    std::uint64_t cluster_tests = 0;
    /// On a device: boxes, or moments, of the tree that walks have tested. The walk of a packet tests a box against the
    /// ball around its points and, if it gets there, once more for all of them; empty places of wide nodes count, too.
    std::uint64_t node_tests = 0;
  };
  std::vector<Level> levels;
  std::uint64_t found = 0;            ///< Finest voxels with a point.
  std::uint64_t undecided = 0;        ///< Finest voxels neither found nor proved empty when the levels ran out.
  std::uint64_t proved_empty = 0;     ///< Finest voxels visited and dismissed, themselves or in all their parts.
  std::uint64_t queries = 0;          ///< Closest-point queries asked (contact lists and trees).
  std::uint32_t narrowing_steps = 0;  ///< Certified on a device: of every line, nine parts a step.
  std::uint64_t retries = 0;  ///< Chunks run again: in smaller parts since a buffer was full, or for longer lists.
};

struct StageTime {
  std::string stage;
  double seconds = 0;
};

struct Extraction {
  VoxelGrid grid;
  std::vector<MedialSphere> spheres;      ///< In voxel order.
  std::vector<UndecidedVoxel> undecided;  ///< Certified mode, in voxel order; counters.undecided of them.
  ExtractionCounters counters;
  std::vector<StageTime> device_times;  ///< By timestamps on the device, empty if it has none.
};

/// Called with the share done, 0 to 1, between pieces of work and every ten milliseconds while the device computes;
/// return false to stop (Error kInterrupted).
using ProgressCallback = std::function<bool(double done)>;

/// Finds the medial spheres of `mesh` on the device of `context`. Blocks until done, or until `stop` is requested from
/// any thread: then the device finishes the dispatch it is at, and the context is as before. The spheres are exact to
/// float: certify() (src/medial/certify.h) makes the guarantee in double. Errors: kUsage (a parameter out of range),
/// kInvalidMesh, kOutOfMemory, kInterrupted, kInternal (device lost).
Result<Extraction> extract_medial_spheres(Context& context, const MeshView& mesh,
                                          const ExtractionParameters& parameters, const ProgressCallback& progress = {},
                                          const std::stop_token& stop = {});

/// The same with an index of `mesh` that is there already: made while the device was opened, or to be used again. Mode
/// thesis does not use it. Errors: also kUsage (the index is that of another mesh, MeshIndex::is_of()).
Result<Extraction> extract_medial_spheres(Context& context, const MeshView& mesh, const MeshIndex& index,
                                          const ExtractionParameters& parameters, const ProgressCallback& progress = {},
                                          const std::stop_token& stop = {});

}  // namespace medial_vk
