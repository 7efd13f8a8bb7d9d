// The proof that a cell holds no medial point with an object angle, by the nearest points of samples around the cell
// alone (docs/theory.md, "Any boundary").
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk::any_boundary {

/// From the centre of a cell to its samples, in sides of the cell: all up to a length of sqrt(5).
inline constexpr std::size_t kSamples = 56;
inline constexpr int kSampleReach = 2;
const std::array<std::array<int, 3>, kSamples>& sample_offsets();

/// A cell, and what is known of the boundary around it.
struct SampledCell {
  Point centre;
  double side = 0;
  Point nearest;                    ///< To the centre.
  std::span<const Point> contacts;  ///< Nearest to the samples, in the order of sample_offsets().
  double error = 0;                 ///< Of the nearest points: BoundaryFunctions::error.
};

/// Unit vectors within an angle of one of them.
struct Cap {
  Point middle;
  double cosine, sine;  ///< Of the angle, at most a right one.
};

class SpreadTest {
 public:
  SpreadTest();

  /// True: no point of the cell has two nearest boundary points, seen from it at an angle of twice `object_angle` or
  /// more. In radians, in (0, pi / 2).
  bool dismisses(const SampledCell& cell, double object_angle) const;

 private:
  /// A piece of the unit sphere, and the samples whose cones hold all of its directions.
  struct Patch {
    Cap cap;            ///< That holds it.
    std::uint32_t end;  ///< Of its entries in `cones_`.
  };
  struct Cone {
    std::uint32_t sample;
    double cosine;  ///< The least of the angle between a direction of the patch and that of the sample.
  };

  void add_patch(const std::array<Point, 4>& corners);

  std::array<Point, kSamples> directions_ = {};  // of the samples,
  std::array<double, kSamples> lengths_ = {};    // and their offsets' lengths
  std::vector<Patch> patches_;
  std::vector<Cone> cones_;
};

}  // namespace medial_vk::any_boundary
