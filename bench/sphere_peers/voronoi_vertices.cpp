#include "voronoi_vertices.h"

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "ball_unions/cells/ball_tree.h"
#include "ball_unions/triangulation/regular_triangulation.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/point_ops.h"

namespace medial_vk::bench {

std::vector<VoronoiVertex> voronoi_vertices(std::span<const Point> points, unsigned threads) {
  std::vector<Ball> balls;
  balls.reserve(points.size());
  for (const Point& p : points) balls.push_back({p, 0});
  const double scale = scale_of(balls);
  const std::vector<Ball> unit = scaled_balls(balls, scale);
  const std::optional<RegularTriangulation> found =
      RegularTriangulation::build(unit, BallTree(unit, threads).order(), threads);
  if (!found) {
    std::fprintf(stderr, "the points have too many Voronoi vertices\n");
    std::exit(1);
  }
  std::vector<VoronoiVertex> vertices;
  for (std::uint32_t t = 0; t < found->tetrahedra().size(); ++t) {
    const auto& corners = found->tetrahedra()[t].balls;
    bool is_far = false;
    for (const std::uint32_t ball : corners) is_far = is_far || found->is_far(ball);
    if (is_far) continue;
    const RegularTriangulation::Corner& corner = found->corner(t);
    vertices.push_back({(1 / scale) * (unit[corners[0]].centre + corner.from_first), corner.slack / scale, corners});
  }
  return vertices;
}

}  // namespace medial_vk::bench
