#include "sphere_fits/steps/solid_lines.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

struct Crossing {
  std::uint32_t line;
  int turns;  // of the winding number, along the line
  double at;
};

/// The crossings of the triangles of a mesh with lines along one axis.
class Shadow {
 public:
  Shadow(const Mesh& mesh, std::size_t axis, const std::array<std::size_t, 2>& across)
      : mesh_(mesh), axis_(axis), across_(across) {}

  /// Appends a crossing for every line of the bundle that passes the triangle.
  void cross(const Triangle& triangle, const SolidLines::Bundle& bundle, std::vector<Crossing>& crossings) const {
    std::array<std::ptrdiff_t, 2> begin, end;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto [least, greatest] = std::minmax({flat(triangle[0], k), flat(triangle[1], k), flat(triangle[2], k)});
      begin[k] = index(std::ceil((least - bundle.first[k]) / bundle.spacing[k]), bundle.count[k]);
      end[k] = index(std::floor((greatest - bundle.first[k]) / bundle.spacing[k]) + 1, bundle.count[k]);
    }
    for (std::ptrdiff_t j = begin[1]; j < end[1]; ++j) {
      for (std::ptrdiff_t i = begin[0]; i < end[0]; ++i) {
        cross_one(triangle, {bundle.at(0, i), bundle.at(1, j)}, static_cast<std::uint32_t>(j * bundle.count[0] + i),
                  crossings);
      }
    }
  }

 private:
  double flat(std::uint32_t vertex, std::size_t k) const { return mesh_.vertices[vertex][across_[k]]; }
  static std::ptrdiff_t index(double position, std::ptrdiff_t count) {
    return static_cast<std::ptrdiff_t>(std::clamp(position, 0.0, static_cast<double>(count)));
  }

  /// Twice the area of a, b and the line. Triangles that share an edge get the same number for it except for the sign,
  /// so the line passes exactly one of them, for any rounding.
  double side_of(std::uint32_t a, std::uint32_t b, const std::array<double, 2>& at) const {
    if (a > b) return -side_of(b, a, at);
    return (flat(b, 0) - flat(a, 0)) * (at[1] - flat(a, 1)) - (flat(b, 1) - flat(a, 1)) * (at[0] - flat(a, 0));
  }
  /// A line that meets the edge counts as on the left of it, seen from its lower vertex.
  bool is_left(std::uint32_t a, std::uint32_t b, double side) const { return a < b ? side >= 0 : side > 0; }

  void cross_one(const Triangle& t, const std::array<double, 2>& at, std::uint32_t line,
                 std::vector<Crossing>& crossings) const {
    std::array<double, 3> side;  // opposite to each corner
    int lefts = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      side[k] = side_of(a, b, at);
      lefts += is_left(a, b, side[k]) ? 1 : 0;
    }
    if (lefts != 0 && lefts != 3) return;
    const double sum = side[0] + side[1] + side[2];
    double height = 0;
    for (std::size_t k = 0; k < 3; ++k) height += (sum != 0 ? side[k] / sum : 1.0 / 3) * mesh_.vertices[t[k]][axis_];
    // Where the line leaves the solid, the corners of the triangle are counter-clockwise as seen from ahead.
    crossings.push_back({line, lefts == 3 ? -1 : 1, height});
  }

  const Mesh& mesh_;
  std::size_t axis_;
  std::array<std::size_t, 2> across_;
};

std::vector<SolidLines::Stretch> inside_of(std::span<const Crossing> crossings) {
  std::vector<SolidLines::Stretch> inside;
  int winding = 0;
  for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
    winding += crossings[k].turns;
    const double from = crossings[k].at, to = crossings[k + 1].at;
    if (from == to || winding <= 0) continue;
    if (!inside.empty() && inside.back().to == from) {
      inside.back().to = to;
    } else {
      inside.push_back({from, to});
    }
  }
  return inside;
}

SolidLines::Bundle make_bundle(const Solid& solid, std::size_t axis, double spacing, std::size_t least) {
  const Point &lower = solid.mesh().report.lower, &upper = solid.mesh().report.upper;
  SolidLines::Bundle bundle;
  bundle.across = {(axis + 1) % 3, (axis + 2) % 3};
  for (std::size_t k = 0; k < 2; ++k) {
    const double width = upper[bundle.across[k]] - lower[bundle.across[k]];
    const double count = std::max(static_cast<double>(least), std::ceil(width / spacing));
    bundle.count[k] = static_cast<std::ptrdiff_t>(count);
    bundle.spacing[k] = width / count;
    bundle.first[k] = lower[bundle.across[k]] + 0.5 * bundle.spacing[k];
  }
  const Shadow shadow(solid.mesh().mesh, axis, bundle.across);
  std::vector<Crossing> crossings;
  for (const Triangle& triangle : solid.mesh().mesh.triangles) shadow.cross(triangle, bundle, crossings);
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.line != b.line ? a.line < b.line : a.at != b.at ? a.at < b.at : a.turns > b.turns;
  });
  auto begin = crossings.begin();
  for (std::ptrdiff_t line = 0; line < bundle.count[0] * bundle.count[1]; ++line) {
    bundle.starts.push_back(bundle.inside.size());
    const auto end = std::find_if(begin, crossings.end(),
                                  [&](const Crossing& c) { return static_cast<std::ptrdiff_t>(c.line) != line; });
    const std::vector<SolidLines::Stretch> inside = inside_of({begin, end});
    bundle.inside.insert(bundle.inside.end(), inside.begin(), inside.end());
    begin = end;
  }
  bundle.starts.push_back(bundle.inside.size());
  return bundle;
}

}  // namespace

SolidLines::SolidLines(const Solid& solid, std::size_t per_side, std::size_t least) {
  const Point size = solid.mesh().report.upper - solid.mesh().report.lower;
  const double spacing = std::max({size[0], size[1], size[2]}) / static_cast<double>(per_side);
  for (std::size_t axis = 0; axis < 3; ++axis) bundles_[axis] = make_bundle(solid, axis, spacing, least);
}

double SolidLines::volume() const {
  double sum = 0;
  for (const Bundle& bundle : bundles_) {
    CompensatedSum lengths;
    for (const Stretch& part : bundle.inside) lengths.add(part.to - part.from);
    sum += lengths.value() * bundle.spacing[0] * bundle.spacing[1];
  }
  return sum / 3;
}

}  // namespace medial_vk
