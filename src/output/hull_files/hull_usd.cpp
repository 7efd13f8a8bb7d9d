// Hulls as USD text (openusd.org: the grammar of .usda files, and the schemas UsdGeom and UsdPhysics).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "medial_vk/version.h"
#include "output/hull_files/encoders.h"
#include "output/hull_files/hull_files.h"
#include "output/hull_files/inner_shapes.h"

namespace medial_vk {
namespace {

constexpr Point kNoOrigin = {0, 0, 0};

/// A name of a prim: letters, digits and underscores, the first of them no digit.
std::string prim_name(const std::string& text) {
  std::string name = text;
  for (char& c : name) {
    const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (!fits) c = '_';
  }
  if (name.empty() || (name[0] >= '0' && name[0] <= '9')) name.insert(0, "_");
  return name;
}

/// A float that is not below a double: extents may be larger than what they hold.
double above(double x) {
  const auto rounded = static_cast<float>(x);
  return double{rounded} < x ? double{std::nextafter(rounded, std::numeric_limits<float>::infinity())}
                             : double{rounded};
}

class UsdText {
 public:
  void begin(const char* type, const std::string& name, const char* schemas) {
    fmt::format_to(std::back_inserter(text_),
                   "\n    def {} \"{}\" (\n        prepend apiSchemas = [{}]\n    )\n    {{\n", type, name, schemas);
  }
  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    text_ += "        ";
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    text_ += '\n';
  }
  /// The box around the origin that reaches `half` far along each axis.
  void extent(const Point& half) {
    const double x = above(half[0]), y = above(half[1]), z = above(half[2]);
    line("float3[] extent = [({}, {}, {}), ({}, {}, {})]", -x, -y, -z, x, y, z);
  }
  void translate(const Point& to) { line("double3 xformOp:translate = ({}, {}, {})", to[0], to[1], to[2]); }
  void end() { text_ += "    }\n"; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

constexpr const char* kCollision = "\"PhysicsCollisionAPI\"";

void add_sphere(const Ball& ball, const std::string& name, UsdText& usd) {
  usd.begin("Sphere", name, kCollision);
  usd.extent({ball.radius, ball.radius, ball.radius});
  usd.line("double radius = {}", ball.radius);
  usd.translate(ball.centre);
  usd.line("uniform token[] xformOpOrder = [\"xformOp:translate\"]");
  usd.end();
}

void add_capsule(const PosedCapsule& capsule, const std::string& name, UsdText& usd) {
  const bool is_cone = capsule.radius_bottom != capsule.radius_top;
  usd.begin(is_cone ? "Capsule_1" : "Capsule", name, kCollision);
  // By the wider reading of the radii, a ball at an end has a radius of at most sqrt(2) of its rim's, around a centre
  // at most that radius from the rim: 2.5 radii hold both.
  const double radius = std::max(capsule.radius_bottom, capsule.radius_top);
  const double across = is_cone ? 1.5 * radius : radius, beyond = is_cone ? 2.5 * radius : radius;
  usd.extent({across, capsule.height / 2 + beyond, across});
  usd.line("uniform token axis = \"Y\"");
  usd.line("double height = {}", capsule.height);
  if (is_cone) {
    usd.line("double radiusBottom = {}", capsule.radius_bottom);
    usd.line("double radiusTop = {}", capsule.radius_top);
  } else {
    usd.line("double radius = {}", capsule.radius_bottom);
  }
  const auto& [x, y, z, w] = capsule.rotation;
  usd.line("quatd xformOp:orient = ({}, {}, {}, {})", w, x, y, z);
  usd.translate(capsule.middle);
  usd.line("uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]");
  usd.end();
}

std::string points_text(const std::vector<Point>& points) {
  std::string text;
  const auto write = std::back_inserter(text);
  for (const Point& p : points) fmt::format_to(write, "{}({}, {}, {})", text.empty() ? "" : ", ", p[0], p[1], p[2]);
  return text;
}

Status add_hull_mesh(const BallHull& hull, const std::string& name, UsdText& usd) {
  const Point middle = middle_in(hull, kNoOrigin, Digits::kDouble);
  const Result<Mesh> mesh = inner_mesh(hull, middle, Digits::kFloat, kHullMeshShare);
  if (!mesh) return mesh.error();
  usd.begin("Mesh", name, "\"PhysicsCollisionAPI\", \"PhysicsMeshCollisionAPI\"");
  Point half = {0, 0, 0};
  for (const Point& p : mesh.value().vertices) {
    for (std::size_t k = 0; k < 3; ++k) half[k] = std::max(half[k], std::fabs(p[k]));
  }
  usd.extent(half);
  std::vector<std::uint32_t> corners;
  for (const Triangle& triangle : mesh.value().triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  const std::vector<int> counts(mesh.value().triangles.size(), 3);
  usd.line("int[] faceVertexCounts = [{}]", fmt::join(counts, ", "));
  usd.line("int[] faceVertexIndices = [{}]", fmt::join(corners, ", "));
  usd.line("point3f[] points = [{}]", points_text(mesh.value().vertices));
  usd.line("uniform token physics:approximation = \"convexHull\"");
  usd.line("uniform token subdivisionScheme = \"none\"");
  usd.translate(middle);
  usd.line("uniform token[] xformOpOrder = [\"xformOp:translate\"]");
  usd.end();
  return {};
}

/// A steep cone is nearly its larger ball, and is written as that if this has more of its volume.
Status add_two_balls(const BallHull& hull, const std::string& name, UsdText& usd) {
  const std::optional<BallHull> inner = for_both_readings(hull);
  const bool second = hull.corners[1].radius > hull.corners[0].radius;
  const Ball& larger = hull.corners[second ? 1 : 0];
  if (!inner || volume_of(*inner) < volume_of(hull_of(larger))) {
    add_sphere(larger, name, usd);
    return {};
  }
  const std::optional<PosedCapsule> posed = posed_capsule(*inner, kNoOrigin, Digits::kDouble);
  if (!posed) return too_thin();
  add_capsule(*posed, name, usd);
  return {};
}

}  // namespace

Result<std::string> encode_hulls_usd(const HullRecord& record) {
  const std::vector<BallHull>& hulls = record.fit.hulls;
  const std::string root = prim_name(record.name);
  UsdText usd;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    const BallHull hull = without_held_balls(hulls[i]);
    const std::string name = fmt::format("{}_{}", name_of(kind_of(hull)), number_text(i, hulls.size()));
    if (hull.count == 1) {
      add_sphere(hull.corners[0], name, usd);
      continue;
    }
    const Status added = hull.count == 2 ? add_two_balls(hull, name, usd) : add_hull_mesh(hull, name, usd);
    if (!added) return with_hull(added.error(), i);
  }
  return fmt::format(
      "#usda 1.0\n(\n    defaultPrim = \"{0}\"\n    doc = \"medial-vk {1}: {2} hulls of balls\"\n    metersPerUnit = "
      "1\n"
      "    upAxis = \"Y\"\n)\n\ndef Xform \"{0}\"\n{{{3}}}\n",
      root, version(), hulls.size(), usd.text());
}

}  // namespace medial_vk
