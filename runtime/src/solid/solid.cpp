#include "solid/solid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/point_ops.h"
#include "bvh/refined_tree.h"
#include "indexed_mesh/bounded_mesh.h"
#include "solid/number_by_rays.h"

namespace medial_vk {
namespace {

// The error of a winding number by a tree is at most 0.03, which suffices away from 1/2.
constexpr double kDoubt = 0.05;

// The distance is the length of a difference of points that are themselves sums of at most three products: with
// u = 2^-53, below 16 u times the lengths involved (query to corner, edge), which stay below twice the longest side of
// a box with all of them. The units of the mesh add one rounding of the coordinates, u times their magnitude, if the
// origin is moved.
double rounding_in_box(const Point& lower, const Point& upper) {
  constexpr double u = 0x1p-53;
  double magnitude = 0, longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    magnitude = std::max({magnitude, std::fabs(lower[axis]), std::fabs(upper[axis])});
    longest = std::max(longest, upper[axis] - lower[axis]);
  }
  return 32 * u * longest + 4 * u * magnitude;
}

// Above the rounding of a sum of a million angles, each with an error of some 2^-50. The angle of a triangle has a
// greater error next to one of its edges: at a distance of s times its size, some 2^-50 / s.
constexpr double kSharp = 1e-6;

}  // namespace

double distance_rounding(const Bvh& bvh) {
  const BvhBox& box = bvh.nodes().front().box;
  return rounding_in_box(box.lower, box.upper);
}

double distance_rounding(const IndexedMesh& mesh) { return rounding_in_box(mesh.region_lower(), mesh.region_upper()); }

Solid::Solid(const IndexedMesh& mesh, Bvh bvh)
    : mesh_(mesh),
      bvh_(std::move(bvh)),
      wide_(bvh_),
      rounding_(distance_rounding(bvh_)),
      triangles_(std::make_unique<TriangleTree>(mesh.prepared().mesh)),
      winding_(std::make_unique<WindingTree>(*triangles_)) {}

Result<Solid> Solid::build(const IndexedMesh& mesh) {
  constexpr std::uint32_t kLeafSize = 4;
  if (Status status = check_bounded(mesh); !status) return status.error();
  Result<Bvh> bvh = refined_tree(mesh.bvh(), kLeafSize);
  if (!bvh) return bvh.error();
  Solid solid(mesh, std::move(bvh).value());
  if (mesh.prepared().report.closed) return solid;
  const Mesh& corners = mesh.prepared().mesh;
  const MeshTopology topology(corners);
  Result<std::unique_ptr<ClosingSurface>> closing = ClosingSurface::build(corners, topology);
  if (!closing) return closing.error();
  solid.closing_ = std::move(closing).value();
  if (solid.closing_) solid.change_ = std::make_unique<WindingChange>(corners, topology);
  return solid;
}

double Solid::distance(const Point& p) const { return std::sqrt(closest(p).squared_distance); }

std::optional<std::int64_t> Solid::whole_number(const Point& p) const {
  return closing_ ? number_by_rays({&bvh_, &closing_->bvh()}, p) : number_by_rays({&bvh_}, p);
}

double Solid::rough_number(const Point& p, const std::optional<std::int64_t>& whole) const {
  return whole ? static_cast<double>(*whole) - closing_->rough_number(p) : winding_->at(p);
}

double Solid::sharp_number(const Point& p, const std::optional<std::int64_t>& whole) const {
  const bool closing_is_small = closing_->size() < mesh().mesh.triangles.size();
  return whole && closing_is_small ? static_cast<double>(*whole) - closing_->number(p)
                                   : exact_winding_number(mesh().mesh, p);
}

bool Solid::contains(const Point& p) const {
  const std::optional<std::int64_t> whole = whole_number(p);
  if (!closing_) return whole ? *whole > 0 : winding_->at(p) >= 0.5;
  const double rough = rough_number(p, whole);
  return (std::fabs(rough - 0.5) > kDoubt ? rough : sharp_number(p, whole)) >= 0.5;
}

SolidSide Solid::side_around(const Point& p, double radius) const {
  const auto side = [](bool is_inside) { return is_inside ? SolidSide::kInside : SolidSide::kOutside; };
  if (!closing_) return side(contains(p));
  const auto holds = [&](double number, double error) {
    const double most = std::fabs(number - 0.5) - error;
    return most > 0 && change_->stays_within(p, most, radius);
  };
  const std::optional<std::int64_t> whole = whole_number(p);
  const double rough = rough_number(p, whole);
  if (holds(rough, kDoubt)) return side(rough >= 0.5);
  // No number that the rough one permits has a margin.
  if (!change_->stays_within(p, std::fabs(rough - 0.5) + kDoubt, radius)) return SolidSide::kUnknown;
  const double sharp = sharp_number(p, whole);
  return holds(sharp, kSharp) ? side(sharp >= 0.5) : SolidSide::kUnknown;
}

double Solid::diagonal() const { return length(mesh().report.upper - mesh().report.lower); }

bool Solid::has_volume() const {
  const MeshReport& report = mesh().report;
  return report.closed && report.faces_within == 0 && report.faces_without == 0 && report.intersecting_faces == 0 &&
         report.intersections_known;
}

}  // namespace medial_vk
