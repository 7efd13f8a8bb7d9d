// Segments between points with different contacts, narrowed to the point where both contacts are equally far.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "any_boundary/approximate_ball.h"

namespace medial_vk::any_boundary {

struct AimedLine {
  std::uint64_t voxel = 0;  ///< In which a centre is searched for.
  Point begin = {0, 0, 0}, end = {0, 0, 0};
  Point a = {0, 0, 0}, b = {0, 0, 0};  ///< The boundary points nearest to begin and end.
};

/// The point closest to `p` of the plane whose points are equally far from a and b.
Point foot_on_bisector(const Point& p, const Point& a, const Point& b);

/// Narrows lines, all at once, so that queries come in batches.
class LineNarrowing {
 public:
  /// `most`: greatest axis_distance() that is accepted. Keeps references.
  LineNarrowing(const CellGrid& grid, const Salience& salience, double most, const BoundaryQueries& queries)
      : grid_(grid), salience_(salience), most_(most), queries_(queries) {}

  /// Finds `a` and `b` first. By line: a salient ball inside the boundary with its centre in the voxel, if the line
  /// leads to one.
  const std::vector<std::optional<ApproximateBall>>& narrow(std::vector<AimedLine>& lines);

 private:
  void find_contacts(std::vector<AimedLine>& lines);
  void step(std::vector<AimedLine>& lines);
  void leave_out_those_outside();

  const CellGrid& grid_;
  const Salience& salience_;
  double most_;
  const BoundaryQueries& queries_;
  std::vector<std::uint32_t> open_, still_open_;  // lines
  std::vector<Point> points_, answers_;
  std::vector<std::uint8_t> inside_;
  std::vector<std::optional<ApproximateBall>> found_;
};

}  // namespace medial_vk::any_boundary
