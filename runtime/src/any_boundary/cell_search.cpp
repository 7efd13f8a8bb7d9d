#include "any_boundary/cell_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk::any_boundary {
namespace {

// "Near the angle" means below the object angle plus this, as in an extraction from a mesh.
constexpr double kNearAngle = 0.05;
// Of the object angle: two contacts are worth a line if they tie at this share of it. Their angle changes on the way.
constexpr double kWorthALine = 0.75;
constexpr std::size_t kLinesOfCell = 2;
// Of the side of the cell: by so much lines reach beyond the point that they are aimed at.
constexpr double kBeyond = 0.125;

/// The foot on the bisector of two contacts, and how far it is from the centre of the cell.
struct Aim {
  double way;
  Point foot, contact;
};

/// Of least squares: |x - q|^2 = t for all q, an equation linear in x and t - |x|^2. Directions in which the contacts
/// hardly differ keep the coordinate of `centre`.
Point point_of_equal_distances(const Point& centre, const std::array<Point, kSamples>& contacts) {
  constexpr double kFlat = 0x1p-16;  // of the greatest eigenvalue
  Point mean = {0, 0, 0};
  double mean_square = 0;
  for (const Point& q : contacts) {
    mean = mean + (1.0 / kSamples) * (q - centre);
    mean_square += dot(q - centre, q - centre) / kSamples;
  }
  std::array<Point, 3> rows = {};
  Point right = {0, 0, 0};
  for (const Point& q : contacts) {
    const Point offset = q - centre - mean;
    const double excess = 0.5 * (dot(q - centre, q - centre) - mean_square);
    for (std::size_t k = 0; k < 3; ++k) rows[k] = rows[k] + offset[k] * offset;
    right = right + excess * offset;
  }
  const double trace = rows[0][0] + rows[1][1] + rows[2][2];
  for (std::size_t k = 0; k < 3; ++k) rows[k][k] += kFlat * trace;
  const double determinant = dot(rows[0], cross(rows[1], rows[2]));
  if (!(determinant > 0)) return centre;
  // Cramer's rule; the matrix is symmetric.
  const Point x = {dot(right, cross(rows[1], rows[2])), dot(rows[0], cross(right, rows[2])),
                   dot(rows[0], cross(rows[1], right))};
  return centre + (1 / determinant) * x;
}

}  // namespace

void CellSearch::run(int depth, std::span<const std::uint64_t> codes, SearchedCells& out) {
  side_ = frame_.grid.side(depth);
  half_diagonal_ = kHalfDiagonal * side_;
  const bool is_fine = depth >= frame_.grid.voxel_depth();
  block_.begin(frame_.grid, depth, codes, frame_.queries);
  is_wanted_.assign(codes.size(), 0);
  for (std::size_t i = 0; i < codes.size(); ++i) {
    is_wanted_[i] = !is_outside(i) && (is_fine || distance(i) > half_diagonal_) ? 1 : 0;
  }
  block_.query_samples(is_wanted_, frame_.queries);
  lines_.clear();
  const double voxel = frame_.grid.voxels().voxel_size;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (is_outside(i)) continue;
    const double angle = least_angle(i);
    if (is_wanted_[i] != 0 && is_dismissed(i, angle)) continue;
    const double bound = distance(i) + frame_.queries.error() + half_diagonal_;  // of the radius
    OpenCell cell = {.code = codes[i], .width = 2 * bound, .is_shallow = bound < voxel};
    if (is_fine) {
      cell.is_near_angle = is_dismissed(i, std::min(angle + kNearAngle, 0.5 * std::numbers::pi));
      aim(i, depth);
    }
    out.open.push_back(cell);
  }
  const auto& found = narrowing_.narrow(lines_);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (found[i]) out.found.push_back({lines_[i].voxel, *found[i]});
  }
}

bool CellSearch::is_outside(std::size_t cell) const {
  return !block_.is_centre_inside(cell) && distance(cell) - frame_.queries.error() > half_diagonal_;
}

double CellSearch::distance(std::size_t cell) const { return length(block_.centre(cell) - block_.nearest(cell)); }

double CellSearch::least_angle(std::size_t cell) const {
  return frame_.salience.least_angle(distance(cell) + frame_.queries.error() + half_diagonal_);
}

bool CellSearch::is_dismissed(std::size_t cell, double object_angle) const {
  std::array<Point, kSamples> contacts;
  block_.contacts(cell, contacts);
  return frame_.test.dismisses({block_.centre(cell), side_, block_.nearest(cell), contacts, frame_.queries.error()},
                               object_angle);
}

/// Lines from the centre across the bisectors of its contact and those of the samples, the shortest ways first.
void CellSearch::aim(std::size_t cell, int depth) {
  const std::uint64_t voxel = frame_.grid.voxel_of(block_.code(cell), depth);
  const Point &centre = block_.centre(cell), &a = block_.nearest(cell);
  const double least = kWorthALine * least_angle(cell);
  std::array<Point, kSamples> contacts;
  block_.contacts(cell, contacts);
  std::array<Aim, kSamples> aims;
  std::size_t count = 0;
  for (const Point& b : contacts) {
    if (length(b - a) <= 8 * frame_.queries.error()) continue;
    const Point foot = foot_on_bisector(centre, a, b);
    if (object_angle({foot, a, a, b}) < least || !frame_.grid.holds(voxel, foot)) continue;
    aims[count++] = {length(foot - centre), foot, b};
  }
  std::sort(aims.begin(), aims.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Aim& p, const Aim& q) { return std::pair(p.way, p.contact) < std::pair(q.way, q.contact); });
  std::size_t made = 0;
  for (std::size_t i = 0; i < count && made < kLinesOfCell; ++i) {
    if (i > 0 && aims[i].contact == aims[i - 1].contact) continue;
    // Beyond the bisector by as much as the way to it, and by a little where the centre lies on it.
    const Point across = (1 / length(aims[i].contact - a)) * (aims[i].contact - a);
    lines_.push_back({voxel, centre, aims[i].foot + (aims[i].way + kBeyond * side_) * across, {}, {}});
    ++made;
  }
  if (count > 0) aim_at_tie(voxel, centre, a, contacts);
}

/// Curves of the medial axis are met by no line through a centre: one more line passes the point where all contacts
/// are equally far, or most nearly so, in the direction between the contact of the centre and the one farthest from it.
void CellSearch::aim_at_tie(std::uint64_t voxel, const Point& centre, const Point& a,
                            const std::array<Point, kSamples>& contacts) {
  const Point tie = point_of_equal_distances(centre, contacts);
  if (!frame_.grid.holds(voxel, tie)) return;
  const auto from_a = [&](const Point& p, const Point& q) { return length(p - a) < length(q - a); };
  const Point& b = *std::max_element(contacts.begin(), contacts.end(), from_a);
  const Point along = (kBeyond * side_ / length(b - a)) * (b - a);
  lines_.push_back({voxel, tie - along, tie + along, {}, {}});
}

}  // namespace medial_vk::any_boundary
