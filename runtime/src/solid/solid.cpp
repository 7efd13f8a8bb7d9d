#include "solid/solid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/point_ops.h"
#include "bvh/refined_tree.h"

namespace medial_vk {
namespace {

// The error of the tree of winding numbers is at most 0.03, which suffices for the integer of a closed mesh, and for
// other meshes away from 1/2.
constexpr double kDoubt = 0.05;

// Above the rounding of a sum of a million angles, each with an error of some 2^-50. The angle of a triangle has a
// greater error next to one of its edges: at a distance of s times its size, some 2^-50 / s.
constexpr double kSharp = 1e-6;

}  // namespace

// The distance is the length of a difference of points that are themselves sums of at most three products: with
// u = 2^-53, below 16 u times the lengths involved (query to corner, edge), which stay below twice the longest side.
// The units of the mesh add one rounding of the coordinates, u times their magnitude, if the origin is moved.
double distance_rounding(const Bvh& bvh) {
  constexpr double u = 0x1p-53;
  const BvhBox& box = bvh.nodes().front().box;
  double magnitude = 0, longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    magnitude = std::max({magnitude, std::fabs(box.lower[axis]), std::fabs(box.upper[axis])});
    longest = std::max(longest, box.upper[axis] - box.lower[axis]);
  }
  return 32 * u * longest + 4 * u * magnitude;
}

Solid::Solid(const IndexedMesh& mesh, Bvh bvh)
    : mesh_(mesh),
      bvh_(std::move(bvh)),
      rounding_(distance_rounding(bvh_)),
      triangles_(std::make_unique<TriangleTree>(mesh.prepared().mesh)),
      winding_(std::make_unique<WindingTree>(*triangles_)) {
  const Mesh& corners = mesh.prepared().mesh;
  if (mesh.prepared().report.closed) return;
  const MeshTopology topology(corners);
  change_ = std::make_unique<WindingChange>(corners, topology);
  closure_ = std::make_unique<WindingClosure>(corners, topology);
}

Result<Solid> Solid::build(const IndexedMesh& mesh) {
  constexpr std::uint32_t kLeafSize = 4;
  Result<Bvh> bvh = refined_tree(mesh.bvh(), kLeafSize);
  if (!bvh) return bvh.error();
  return Solid(mesh, std::move(bvh).value());
}

double Solid::distance(const Point& p) const { return std::sqrt(bvh().closest(p).squared_distance); }

double Solid::sharpened(const Point& p, double rough) const {
  if (closure_->size() < mesh().mesh.triangles.size()) {
    if (const std::optional<double> sharp = closure_->sharpened(p, rough, kDoubt)) return *sharp;
  }
  return exact_winding_number(mesh().mesh, p);
}

bool Solid::contains(const Point& p) const {
  const double rough = winding_->at(p);
  if (!closure_ || std::fabs(rough - 0.5) > kDoubt) return rough >= 0.5;
  return sharpened(p, rough) >= 0.5;
}

SolidSide Solid::side_around(const Point& p, double radius) const {
  const double rough = winding_->at(p);
  const auto side = [](double number) { return number >= 0.5 ? SolidSide::kInside : SolidSide::kOutside; };
  const auto holds = [&](double number, double error) {
    const double most = std::fabs(number - 0.5) - error;
    return most > 0 && change_->stays_within(p, most, radius);
  };
  if (!change_ || holds(rough, kDoubt)) return side(rough);
  // No number that the rough one permits has a margin.
  if (!change_->stays_within(p, std::fabs(rough - 0.5) + kDoubt, radius)) return SolidSide::kUnknown;
  const double sharp = sharpened(p, rough);
  return holds(sharp, kSharp) ? side(sharp) : SolidSide::kUnknown;
}

double Solid::diagonal() const { return length(mesh().report.upper - mesh().report.lower); }

bool Solid::has_volume() const {
  const MeshReport& report = mesh().report;
  return report.closed && report.faces_within == 0 && report.faces_without == 0 && report.intersecting_faces == 0 &&
         report.intersections_known;
}

}  // namespace medial_vk
