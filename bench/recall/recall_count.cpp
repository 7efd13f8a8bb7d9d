#include "recall_count.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace medial_vk::bench {
namespace {

using test::MedialSample;
using Voxel = std::array<std::uint32_t, 3>;

constexpr std::size_t kMostNamed = 5;

/// The voxel of a point, and the distance of the point from its faces as a share of the voxel side.
struct Position {
  Voxel voxel;
  double depth;
};

Position position_of(const VoxelGrid& grid, const Eigen::Vector3d& p) {
  Position position = {{}, 1};
  for (int axis = 0; axis < 3; ++axis) {
    const double x = (p[axis] - grid.origin[axis]) / grid.voxel_size, cell = std::floor(x);
    position.voxel[axis] = static_cast<std::uint32_t>(cell);
    position.depth = std::min({position.depth, x - cell, cell + 1 - x});
  }
  return position;
}

std::size_t angle_bin(double angle) {
  const auto above = std::upper_bound(kAngleEdges.begin() + 1, kAngleEdges.end() - 1, angle);
  return static_cast<std::size_t>(above - kAngleEdges.begin()) - 1;
}

void remember(std::vector<MedialSample>& first, const MedialSample& sample) {
  if (first.size() < kMostNamed) first.push_back(sample);
}

RecallRow describe(const ExtractionOptions& options, const Extraction& extraction) {
  RecallRow row;
  row.mode = options.mode;
  row.resolution = options.resolution;
  row.angle = options.object_angle;
  const ExtractionCounters& c = extraction.measurements.counters;
  row.points = c.found;
  row.undecided = c.undecided;
  row.visited = c.found + c.undecided + c.proved_empty;
  row.undecided_listed = extraction.undecided.size() == c.undecided;
  for (const UndecidedVoxel& u : extraction.undecided) ++row.undecided_by_kind[static_cast<std::size_t>(u.kind)];
  return row;
}

}  // namespace

Tally& Tally::operator+=(const Tally& other) {
  samples += other.samples;
  found += other.found;
  undecided += other.undecided;
  return *this;
}

Tally RecallRow::of(RadiusClass radius) const {
  Tally sum;
  for (const Tally& bin : recall[radius]) sum += bin;
  return sum;
}

RecallRow count_recall(const std::string& mesh, const std::vector<MedialSample>& samples,
                       const ExtractionOptions& options, const Extraction& extraction) {
  RecallRow row = describe(options, extraction);
  row.mesh = mesh;
  std::set<Voxel> found, undecided;
  for (const MedialSphere& s : extraction.spheres) found.insert(s.voxel);
  for (const UndecidedVoxel& u : extraction.undecided) undecided.insert(u.voxel);
  const double narrow = (1 + std::sqrt(0.75)) * extraction.grid.voxel_size;
  for (const MedialSample& sample : samples) {
    if (sample.object_angle < row.angle + kAngleSlack) continue;
    const Position position = position_of(extraction.grid, sample.centre);
    Tally one = {1, found.contains(position.voxel), 0};
    one.undecided = one.found == 0 && undecided.contains(position.voxel);
    row.dismissal += one;
    if (one.lost() > 0) remember(row.first_lost, sample);
    if (sample.object_angle < row.angle + kClearAngle || position.depth < kClearOfFaces) continue;
    row.recall[sample.radius < narrow ? kNarrow : kWide][angle_bin(sample.object_angle)] += one;
    if (one.missed() > 0) remember(row.first_missed, sample);
  }
  return row;
}

}  // namespace medial_vk::bench
