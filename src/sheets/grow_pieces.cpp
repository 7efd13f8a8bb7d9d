#include "sheets/grow_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/parallel_for.h"
#include "sheets/concurrent_sets.h"
#include "sheets/tangent_frame.h"

namespace medial_vk {
namespace {

double cosine(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
}

/// Cosine of the greater turn of the two spokes, paired so that it is smaller: which of them is the nearer one may
/// change from voxel to voxel.
double cosine_of_turn(const MedialSphere& p, const MedialSphere& q) {
  const double straight = std::min(cosine(p.spoke_a, q.spoke_a), cosine(p.spoke_b, q.spoke_b));
  const double crossed = std::min(cosine(p.spoke_a, q.spoke_b), cosine(p.spoke_b, q.spoke_a));
  return std::max(straight, crossed);
}

/// Cosine of the angle between the lines along the two normals.
double cosine_of_normals(const MedialSphere& p, const MedialSphere& q) {
  const Point a = sheet_normal(p), b = sheet_normal(q);
  return std::abs(dot(a, b)) / std::max(length(a) * length(b), 1e-300);
}

/// Are neighbours of one sheet? Two spokes that differ by 2 theta or more are those of a salient sheet, which may pass
/// between the two points: then it does not help that their normals agree (docs/theory.md, "Sheets").
struct LinkTest {
  double normals, crease, salient;  // cosines

  LinkTest(double object_angle, const SheetParameters& parameters)
      : normals(std::cos(parameters.angle * std::numbers::pi / 180)),
        crease(parameters.crease > 0 ? std::cos(parameters.crease * std::numbers::pi / 180) : 2),
        salient(parameters.crease > 0 ? std::cos(2 * object_angle) : -2) {}

  bool operator()(const MedialSphere& p, const MedialSphere& q) const {
    const double turn = cosine_of_turn(p, q);
    return turn >= crease || (turn > salient && cosine_of_normals(p, q) >= normals);
  }
};

}  // namespace

std::vector<std::uint32_t> grow_pieces(const VoxelGraph& graph, double object_angle,
                                       const SheetParameters& parameters) {
  const LinkTest linked(object_angle, parameters);
  ConcurrentSets sets(graph.size());
  parallel_for(graph.size(), 1024, [&](std::size_t i) {
    const auto place = static_cast<std::uint32_t>(i);
    for (const std::uint32_t other : graph.neighbours(place)) {
      if (other > place && linked(graph.sphere(place), graph.sphere(other))) sets.join(place, other);
    }
  });
  std::vector<std::uint32_t> piece_of(graph.size());
  std::uint32_t pieces = 0;
  for (std::uint32_t place = 0; place < graph.size(); ++place) {
    const std::uint32_t root = sets.root(place);  // never above `place`
    piece_of[place] = root == place ? pieces++ : piece_of[root];
  }
  return piece_of;
}

}  // namespace medial_vk
