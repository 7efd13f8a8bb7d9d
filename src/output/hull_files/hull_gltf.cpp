// Hulls as glTF: a mesh for each, and as colliders the implicit shapes of the drafts KHR_implicit_shapes and
// KHR_physics_rigid_bodies.
#include <fmt/format.h>

#include <cmath>
#include <span>

#include "base/point_ops.h"
#include "medial_vk/version.h"
#include "output/colours/colour_map.h"
#include "output/hull_files/encoders.h"
#include "output/hull_files/hull_files.h"
#include "output/hull_files/inner_shapes.h"
#include "output/medial_formats/glb_balls.h"
#include "output/medial_formats/glb_container.h"
#include "output/page/base64.h"

namespace medial_vk {
namespace {

constexpr const char* kShapes = "KHR_implicit_shapes";
constexpr const char* kBodies = "KHR_physics_rigid_bodies";

/// Unreal Engine imports meshes with these names as collision shapes of the mesh that follows them.
const char* unreal_prefix(const BallHull& hull) {
  switch (kind_of(hull)) {
    case HullKind::kBall:
      return "USP";
    case HullKind::kCapsule:
      return "UCP";
    case HullKind::kCone:
    case HullKind::kSlab:
      break;
  }
  return "UCX";
}

Point middle_of_hulls(std::span<const BallHull> hulls) {
  CentreBox box;
  for (const BallHull& hull : hulls) {
    for (const Ball& ball : hull.balls()) box.add(ball.centre);
  }
  return box.middle();
}

class HullGltf {
 public:
  explicit HullGltf(const HullRecord& record) : record_(record), middle_(middle_of_hulls(record.fit.hulls)) {
    glb_.document = {{"asset", {{"version", "2.0"}, {"generator", std::string("medial-vk ") + version()}}},
                     {"scene", 0},
                     {"scenes", {{{"nodes", {0}}}}}};
    nodes_.push_back({{"name", record.name}, {"translation", middle_}});
  }

  Status add_all() {
    const std::vector<BallHull>& hulls = record_.fit.hulls;
    if (!hulls.empty()) add_materials();
    for (std::size_t i = 0; i < hulls.size(); ++i) {
      const std::string number = number_text(i, hulls.size());
      if (Status added = add_hull(without_held_balls(hulls[i]), i, number); !added) {
        return with_hull(added.error(), i);
      }
    }
    if (shapes_.empty()) return {};
    glb_.document["extensionsUsed"] = {kShapes, kBodies};
    glb_.document["extensions"][kShapes]["shapes"] = shapes_;
    return {};
  }

  GlbContainer& container() { return glb_; }
  std::string nodes() const { return nodes_.dump(-1, ' ', false, GltfJson::error_handler_t::replace); }

 private:
  /// Each hull has one of the colours in turn.
  void add_materials() {
    for (std::size_t i = 1; i < picture::sheet_colours().size(); ++i) {
      const Eigen::Vector3f light = picture::to_light(picture::sheet_colours()[i]);
      glb_.document["materials"].push_back({{"name", fmt::format("colour {}", i)},
                                            {"pbrMetallicRoughness",
                                             {{"baseColorFactor", {light[0], light[1], light[2], 1}},
                                              {"metallicFactor", 0},
                                              {"roughnessFactor", 0.6}}}});
    }
  }

  Status add_hull(const BallHull& hull, std::size_t i, const std::string& number) {
    const Point at = middle_in(hull, middle_, Digits::kFloat);
    const Point origin = middle_ + at;
    const Result<Mesh> mesh = inner_mesh(hull, origin, Digits::kFloat, kHullMeshShare);
    if (!mesh) return mesh.error();
    const std::string name = fmt::format("{}_{}_{}", unreal_prefix(hull), record_.name, number);
    glb_.document["meshes"].push_back({{"name", name}, {"primitives", {primitive(mesh.value(), i)}}});
    nodes_[0]["children"].push_back(nodes_.size());
    nodes_.push_back({{"name", name}, {"mesh", i}, {"translation", at}});
    if (hull.count == 3) return {};
    nodes_.back()["children"].push_back(nodes_.size());
    return hull.count == 1 ? add_sphere_shape(hull, origin, number) : add_capsule_shape(hull, origin, number);
  }

  GltfJson primitive(const Mesh& mesh, std::size_t i) {
    std::vector<std::array<float, 3>> positions;
    positions.reserve(mesh.vertices.size());
    for (const Point& p : mesh.vertices) {
      positions.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    }
    std::vector<std::uint32_t> corners;
    corners.reserve(3 * mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
    return {{"attributes", {{"POSITION", glb_.add_vectors(positions, GltfTarget::kVertices, true)}}},
            {"indices", glb_.add_indices(corners, GltfComponent::kUnsignedInt)},
            {"material", picture::sheet_colour_index(static_cast<std::int32_t>(i)) - 1}};
  }

  void add_collider(GltfJson node, GltfJson shape) {
    node["extensions"][kBodies]["collider"]["geometry"]["shape"] = shapes_.size();
    nodes_.push_back(std::move(node));
    shapes_.push_back(std::move(shape));
  }

  Status add_sphere_shape(const BallHull& hull, const Point& origin, const std::string& number) {
    Ball inner = hull.corners[0];
    for (const double x : middle_) inner.radius -= 0x1p-50 * std::fabs(x);  // the origin is a rounded sum
    const GlbBall ball = glb_ball(inner, origin);
    if (!(ball.radius > 0)) return too_thin();
    add_collider({{"name", "collider " + number}, {"translation", ball.centre}},
                 {{"type", "sphere"}, {"sphere", {{"radius", ball.radius}}}});
    return {};
  }

  Status add_capsule_shape(const BallHull& hull, const Point& origin, const std::string& number) {
    const std::optional<PosedCapsule> posed = posed_capsule(hull, origin, Digits::kFloat);
    if (!posed) return too_thin();
    add_collider(
        {{"name", "collider " + number}, {"translation", posed->middle}, {"rotation", posed->rotation}},
        {{"type", "capsule"},
         {"capsule",
          {{"height", posed->height}, {"radiusBottom", posed->radius_bottom}, {"radiusTop", posed->radius_top}}}});
    return {};
  }

  const HullRecord& record_;
  const Point middle_;
  GlbContainer glb_;
  GltfJson nodes_ = GltfJson::array(), shapes_ = GltfJson::array();
};

}  // namespace

Result<std::string> encode_hulls_glb(const HullRecord& record) {
  HullGltf gltf(record);
  if (Status added = gltf.add_all(); !added) return added.error();
  return gltf.container().finish(gltf.nodes());
}

Result<std::string> encode_hulls_gltf(const HullRecord& record) {
  HullGltf gltf(record);
  if (Status added = gltf.add_all(); !added) return added.error();
  return gltf.container().finish_as_text(gltf.nodes(), [](std::string_view bytes) {
    std::string text;
    page::append_base64(text, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    return text;
  });
}

}  // namespace medial_vk
