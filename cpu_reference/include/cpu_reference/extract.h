// The independent reference: medial spheres in double precision, one thread, written for readability. It shares no code
// with the runtime or the shaders.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "cpu_reference/mesh.h"

namespace medial_vk::reference {

struct Options {
  bool certified = true;
  int resolution = 160;                              // voxels along the longest side of the bounding box
  double object_angle = 0.6;                         // radians
  double radius = 0;                                 // fraction of the longest side, 0: off
  double epsilon = 0.01;                             // fraction of the voxel side
  int extra_levels = 8;                              // certified: subdivision below the finest voxel
  bool narrow_features = true;                       // thesis: Section 2.4.3
  std::array<int, 4> samples = {400, 200, 100, 50};  // thesis
  // The object angle that a point above the radius threshold, if one is set, must have (never above object_angle).
  // Without this bound, every convex edge of a finely faceted solid would add a sheet of tiny angle to the deep voxels.
  double deep_angle = 0.15;
};

struct Sphere {
  Eigen::Vector3d centre;
  double radius;
  Eigen::Vector3d spoke_a, spoke_b;
  double object_angle;
  double flux;
  Eigen::Vector3i voxel;
};

/// The kind of a salient medial point that may lie in an undecided voxel (docs/theory.md, "What undecided means"): the
/// first of these that holds.
enum class UndecidedKind : std::uint8_t {
  kNearFace,   // within 1/64 of the voxel side of a face of its voxel
  kNearAngle,  // of an object angle less than 0.05 above the threshold
  kBoundary,   // radius below 1/8 of the voxel side, or next to untrusted triangles of the boundary
  kOther,
};

/// A finest voxel that is neither found nor proved empty.
struct Undecided {
  Eigen::Vector3i voxel;
  UndecidedKind kind;
  double width;  // greatest distance of two feet of a salient medial point that may lie there (equation 3.1)
};

struct LevelCount {
  double cell_size;
  std::uint64_t visited, kept, contacts, found;
};

struct Result {
  Eigen::Vector3d grid_origin;
  double voxel_size;
  Eigen::Vector3i grid_size;
  std::vector<Sphere> spheres;              // z slowest, then y, then x
  std::vector<Undecided> undecided_voxels;  // certified: in the same order
  std::vector<LevelCount> levels;
  std::uint64_t found = 0, undecided = 0, proved_empty = 0, queries = 0;
  bool interrupted = false;
};

/// The time that an extraction will take, extrapolated from some of its voxels, which were chosen at random.
struct TimeEstimate {
  double seconds = 0;
  int voxels = 0;           // of the sample
  bool is_cut_off = false;  // the last voxel of the sample took too long, and was not finished
};

/// The method of Sections 2.3 to 2.4 as published, or the certified method; every ball of both passes check()
/// (certificate.h). `progress` receives the completed share and returns false to stop. `on_estimate` is called once in
/// certified mode, after up to about a second of sampling, before the search.
Result extract(const Mesh& mesh, const Options& options, const std::function<bool(double)>& progress = {},
               const std::function<void(const TimeEstimate&)>& on_estimate = {});

}  // namespace medial_vk::reference
