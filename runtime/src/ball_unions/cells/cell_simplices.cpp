#include "ball_unions/cells/cell_simplices.h"

#include <algorithm>

#include "ball_unions/cells/cell_edge.h"

namespace medial_vk {
namespace {

// Closed balls that touch have a simplex. Two balls touch up to rounding (are_apart); where three or four spheres meet,
// a corner this near to a sphere, in radii, counts as on it. The limit is far above the rounding of a corner that makes
// a simplex, and far below any relevant gap.
constexpr double kTouch = 0x1p-36;
// A foot this near to an edge's line, in radii, counts as outside: if it is on the edge, the edge meets the ball, too,
// and if it is on the line beyond the edge, the sign of the gap is rounding.
constexpr double kOnEdge = 0x1p-40;

/// The ball behind a plane of the cell that may be in a simplex with the cell's own; below 0 if there is none.
std::int32_t partner(const Bisector& plane) { return plane.is_apart ? -1 : plane.ball; }

template <std::size_t N>
std::array<std::uint32_t, N> sorted(std::array<std::uint32_t, N> simplex) {
  std::sort(simplex.begin(), simplex.end());
  return simplex;
}

}  // namespace

/// An edge of the cell that meets the ball makes a triangle, and its two faces meet the ball, too. A face is also met
/// where the centre's foot lies in it, clearly on the inner side of all its edges.
void SimplexCollector::collect_edges(const PowerCell& cell, const Ball& ball, DualComplex& complex,
                                     std::vector<EnvelopeVertex>& vertices) {
  const std::uint32_t i = cell.ball();
  for_each_edge(cell, ball.radius, [&](const CellEdge& edge) {
    for (std::size_t side = 0; side < 2; ++side) {
      if (edge.gap[side] < kOnEdge) faces_[edge.planes[side]] |= kFootOutside;
    }
    if (edge.half_chord_squared < -kTouch) return;
    const double half = std::sqrt(std::max(0.0, edge.half_chord_squared));
    if (edge.from > half + kTouch || edge.to < -half - kTouch) return;
    for (const std::uint32_t plane : edge.planes) faces_[plane] |= kMeetsBall;
    const std::int32_t j = partner(cell.planes()[edge.planes[0]]), k = partner(cell.planes()[edge.planes[1]]);
    if (j < 0 || k < 0) return;
    const auto triangle = sorted<3>({i, static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(k)});
    if (triangle[0] != i) return;
    complex.triangles.push_back(triangle);
    for (const double t : {-half, half}) {
      if (t > edge.from && t < edge.to) {
        vertices.push_back({ball.centre + ball.radius * (edge.foot + t * edge.direction), triangle});
      }
    }
  });
}

void SimplexCollector::collect_corners(const PowerCell& cell, double radius, DualComplex& complex) const {
  const std::uint32_t i = cell.ball();
  const double reach = radius * (1 + kTouch);
  for (const PowerCell::Corner& corner : cell.corners()) {
    if (dot(corner.at, corner.at) > reach * reach) continue;
    std::array<std::uint32_t, 4> tetrahedron = {i, 0, 0, 0};
    bool is_whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t j = partner(cell.planes()[corner.planes[k]]);
      is_whole = is_whole && j >= 0;
      tetrahedron[k + 1] = static_cast<std::uint32_t>(j);
    }
    tetrahedron = sorted(tetrahedron);
    if (is_whole && tetrahedron[0] == i) complex.tetrahedra.push_back(tetrahedron);
  }
}

void SimplexCollector::collect(const PowerCell& cell, const Ball& ball, DualComplex& complex,
                               std::vector<EnvelopeVertex>& vertices) {
  if (cell.empty()) return;
  const std::uint32_t i = cell.ball();
  faces_.assign(cell.planes().size(), kFootOutside);
  for (const PowerCell::Corner& corner : cell.corners()) {
    for (const std::uint32_t plane : corner.planes) faces_[plane] = 0;
  }
  collect_edges(cell, ball, complex, vertices);
  collect_corners(cell, ball.radius, complex);
  bool meets = false, holds_centre = true;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Bisector& plane = cell.planes()[k];
    if (plane.offset < 0) holds_centre = false;
    const bool foot = faces_[k] == 0 && std::fabs(plane.offset) <= ball.radius * (1 + kTouch);
    if (!foot && (faces_[k] & kMeetsBall) == 0) continue;
    meets = true;
    if (partner(plane) > static_cast<std::int32_t>(i)) {
      complex.edges.push_back({i, static_cast<std::uint32_t>(plane.ball)});
    }
  }
  if (meets || holds_centre) complex.vertices.push_back(i);
}

}  // namespace medial_vk
