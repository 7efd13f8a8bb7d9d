#include "any_boundary/spread_test.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "any_boundary/cell_grid.h"
#include "any_boundary/unit_vector.h"
#include "base/point_ops.h"

namespace medial_vk::any_boundary {
namespace {

// Patches along an edge of a face of the cube that they divide.
constexpr int kPatches = 6;
// More than the rounding of the cosines below.
constexpr double kRoundedCosine = 0x1p-40;

constexpr std::array<std::array<int, 3>, kSamples> make_offsets() {
  std::array<std::array<int, 3>, kSamples> offsets = {};
  std::size_t count = 0;
  for (int z = -kSampleReach; z <= kSampleReach; ++z) {
    for (int y = -kSampleReach; y <= kSampleReach; ++y) {
      for (int x = -kSampleReach; x <= kSampleReach; ++x) {
        const int squared = x * x + y * y + z * z;
        if (squared > 0 && squared <= 5) offsets.at(count++) = {x, y, z};
      }
    }
  }
  return offsets;
}

constexpr std::array<std::array<int, 3>, kSamples> kOffsets = make_offsets();

/// The direction through a point of the cube's face `face`, 0 to 5, with angles of up to pi / 4 along its edges.
Point through_face(int face, int i, int j) {
  const auto along = [](int k) { return std::tan(std::numbers::pi * (0.5 * k / kPatches - 0.25)); };
  const auto axis = static_cast<std::size_t>(face / 2);
  Point p;
  p[axis] = face % 2 == 0 ? 1 : -1;
  p[(axis + 1) % 3] = along(i);
  p[(axis + 2) % 3] = along(j);
  return unit(p);
}

double angle_between(const Point& a, const Point& b) { return 2 * std::atan2(length(a - b), length(a + b)); }

/// Of a direction in the cap with v.
double greatest_product(const Cap& cap, const Point& v) {
  const double squared = dot(v, v), size = std::sqrt(squared), along = dot(cap.middle, v);
  if (along >= size * cap.cosine) return size;
  return along * cap.cosine + std::sqrt(std::max(0.0, squared - along * along)) * cap.sine;
}

/// How a sample limits the contacts of the points of a cell.
struct Limit {
  Point apex;        // from the nearest point of the sample to the nearest point of the centre
  double along;      // of `apex`, in the direction of the sample
  double squared;    // size of `apex`
  double ratio;      // of half the diagonal to the offset of the sample
  double shortfall;  // that errors may make up
};

}  // namespace

const std::array<std::array<int, 3>, kSamples>& sample_offsets() { return kOffsets; }

SpreadTest::SpreadTest() {
  for (std::size_t s = 0; s < kSamples; ++s) {
    const auto& [x, y, z] = kOffsets.at(s);
    const Point offset = {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
    lengths_[s] = length(offset);
    directions_[s] = unit(offset);
  }
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < kPatches; ++i) {
      for (int j = 0; j < kPatches; ++j) {
        // A spherical quadrilateral lies in every cap that holds its corners and is smaller than a hemisphere.
        const std::array<Point, 4> corners = {through_face(face, i, j), through_face(face, i + 1, j),
                                              through_face(face, i, j + 1), through_face(face, i + 1, j + 1)};
        add_patch(corners);
      }
    }
  }
}

void SpreadTest::add_patch(const std::array<Point, 4>& corners) {
  const Point middle = unit(corners[0] + corners[1] + corners[2] + corners[3]);
  double radius = 0;
  for (const Point& corner : corners) radius = std::max(radius, angle_between(middle, corner));
  const auto begin = static_cast<std::ptrdiff_t>(cones_.size());
  const auto margin = [&](const Cone& cone) { return cone.cosine - kHalfDiagonal / lengths_[cone.sample]; };
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    const Cone cone = {s, std::cos(angle_between(middle, directions_[s]) + radius) - kRoundedCosine};
    if (margin(cone) > 0) cones_.push_back(cone);
  }
  // Cones that hold the patch by a wide margin are likely to hold contacts.
  std::stable_sort(cones_.begin() + begin, cones_.end(),
                   [&](const Cone& a, const Cone& b) { return margin(a) > margin(b); });
  patches_.push_back({{middle, std::cos(radius), std::sin(radius)}, static_cast<std::uint32_t>(cones_.size())});
}

bool SpreadTest::dismisses(const SampledCell& cell, double object_angle) const {
  const double half_diagonal = kHalfDiagonal * cell.side * (1 + kRoundedCosine);
  const double distance = length(cell.centre - cell.nearest);
  const double radius = (distance - cell.error - half_diagonal) * std::sin(object_angle) * (1 - kRoundedCosine);
  if (!(radius > 0)) return false;
  std::array<Limit, kSamples> limits;
  for (std::size_t s = 0; s < kSamples; ++s) {
    const double offset = lengths_[s] * cell.side;
    const Point apex = cell.nearest - cell.contacts[s];
    const double reach = length(cell.centre + offset * directions_[s] - cell.contacts[s]);
    limits[s] = {apex, dot(apex, directions_[s]), dot(apex, apex), half_diagonal / offset,
                 cell.error * (distance + cell.error + half_diagonal + reach) / offset};
  }
  std::uint32_t begin = 0;
  for (const Patch& patch : patches_) {
    const auto first = cones_.begin() + begin, last = cones_.begin() + patch.end;
    begin = patch.end;
    const auto excludes = [&](const Cone& cone) {
      const Limit& limit = limits[cone.sample];
      const double squared = radius * radius + 2 * radius * greatest_product(patch.cap, limit.apex) + limit.squared;
      return radius * cone.cosine + limit.along - limit.ratio * std::sqrt(std::max(0.0, squared)) > limit.shortfall;
    };
    if (std::none_of(first, last, excludes)) return false;
  }
  return true;
}

}  // namespace medial_vk::any_boundary
