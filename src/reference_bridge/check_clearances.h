// `--check` of `medial-vk clearance`: every interval against all pairs of triangles of all compared solids.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "check_reports/check_report.h"
#include "medial_vk/mesh.h"
#include "medial_vk/pose.h"

namespace medial_vk {

/// A solid that is fixed to a link, or to the scene.
struct CheckedSolid {
  const PreparedMesh* mesh = nullptr;
  std::uint32_t link = 0;
  Pose pose;  ///< From the frame of the mesh to that of the link.
};

/// Two solids, by their indices, that are compared.
struct SolidPair {
  std::size_t a = 0, b = 0;
};

struct CheckedInterval {
  double lower = 0, upper = 0;
};

/// Two sets of the same solids: one around the shapes, for lower ends, and one inside them, for upper ends. They are
/// the same if all shapes are meshes.
struct CheckedSolids {
  std::vector<CheckedSolid> around, inside;
  bool are_same = false;
  std::vector<SolidPair> pairs;
};

/// Tests that the least distance of the compared solids is in its interval, for each configuration; `poses` has one
/// pose of each of `links` links for each interval. `seen(i)` is called before configuration i. Time: the product of
/// the numbers of triangles of each pair, times a few nanoseconds.
CheckReport check_clearances(const CheckedSolids& solids, std::span<const Pose> poses, std::size_t links,
                             std::span<const CheckedInterval> intervals, const std::function<void(std::size_t)>& seen);

}  // namespace medial_vk
