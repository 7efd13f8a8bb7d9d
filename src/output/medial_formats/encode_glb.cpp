#include "output/medial_formats/encode_glb.h"

#include <fmt/format.h>

#include <cmath>

#include "output/medial_formats/ball_colours.h"
#include "output/medial_formats/ball_mesh.h"
#include "output/medial_formats/glb_balls.h"
#include "output/medial_formats/glb_container.h"
#include "output/medial_formats/icosphere.h"

namespace medial_vk {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

using Vector = std::array<float, 3>;

GltfJson asset(const MedialHeader& header) {
  return {{"version", "2.0"},
          {"generator", "medial-vk " + header.version},
          {"extras",
           {{"grid_origin", header.grid_origin},
            {"voxel_size", header.voxel_size},
            {"epsilon", header.epsilon},
            {"object_angle_threshold", header.object_angle},
            {"radius_threshold", header.radius_threshold}}}};
}

/// Neither metallic nor reflective, so that the colour can be read.
GltfJson material(const std::string& name, const Vector& colour) {
  return {
      {"name", name},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {colour[0], colour[1], colour[2], 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.6}}}};
}

/// The first node, the parent of all others: 1 to `children`.
std::string root_node(const Point& middle, std::size_t children) {
  std::string out =
      fmt::format("[{{\"name\":\"medial spheres\",\"translation\":[{},{},{}]", middle[0], middle[1], middle[2]);
  for (std::size_t i = 1; i <= children; ++i) {
    out += fmt::format("{}{}", i == 1 ? ",\"children\":[" : ",", i);
  }
  return out + (children > 0 ? "]}" : "}");
}

Point middle_of(std::span<const MedialSphere> spheres) {
  CentreBox box;
  for (const MedialSphere& sphere : spheres) box.add(sphere.centre);
  return box.middle();
}

class GlbEncoder {
 public:
  GlbEncoder(const MedialHeader& header, std::span<const MedialSphere> spheres)
      : header_(header), spheres_(spheres), middle_(middle_of(spheres)) {
    glb_.document = {{"asset", asset(header)}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
  }

  Result<std::string> nodes(std::uint32_t detail) {
    const auto by_colour = add_unit_balls(detail);
    std::string out = root_node(middle_, spheres_.size());
    std::vector<std::uint32_t> mesh_of(spheres_.size());
    for (std::uint32_t mesh = 0; mesh < by_colour.size(); ++mesh) {
      for (const std::uint32_t i : by_colour[mesh]) mesh_of[i] = mesh;
    }
    for (std::size_t i = 0; i < spheres_.size(); ++i) append_node(out, i, mesh_of[i]);
    return glb_.finish(out + "]");
  }

  Result<std::string> gpu_instances(std::uint32_t detail) {
    const auto by_colour = add_unit_balls(detail);
    std::string out = root_node(middle_, by_colour.size());
    if (!by_colour.empty()) {
      for (const char* list : {"extensionsUsed", "extensionsRequired"}) glb_.document[list] = {kExtension};
    }
    for (std::uint32_t mesh = 0; mesh < by_colour.size(); ++mesh) {
      out += "," + instances_node(mesh, by_colour[mesh]).dump();
    }
    return glb_.finish(out + "]");
  }

  Result<std::string> one_mesh(std::uint32_t detail) {
    if (!spheres_.empty()) add_mesh_of_all(make_icosphere(detail));
    const char* node = spheres_.empty() ? "]" : R"(,{"mesh":0,"name":"balls"}])";
    return glb_.finish(root_node(middle_, spheres_.empty() ? 0 : 1) + node);
  }

 private:
  using Indices = std::vector<std::uint32_t>;

  /// A mesh and a material for every colour that occurs, all with the same triangles; returns the spheres of each.
  std::vector<Indices> add_unit_balls(std::uint32_t detail) {
    std::vector<Indices> occurring;
    if (spheres_.empty()) return occurring;
    const GltfJson attributes = add_unit_ball(glb_, detail);
    auto by_colour = spheres_by_colour(spheres_, header_.object_angle);
    for (std::uint32_t step = 0; step < kColourSteps; ++step) {
      if (by_colour[step].empty()) continue;
      const std::string name = fmt::format("object angle {} of {}", step + 1, kColourSteps);
      GltfJson primitive = attributes;
      primitive["material"] = occurring.size();
      glb_.document["materials"].push_back(material(name, linear_colour_of(share_of_step(step))));
      glb_.document["meshes"].push_back({{"name", name}, {"primitives", {primitive}}});
      occurring.push_back(std::move(by_colour[step]));
    }
    return occurring;
  }

  /// Values have the digits of doubles, so that programs that read nodes as doubles and as floats get the same numbers.
  void append_node(std::string& out, std::size_t i, std::uint32_t mesh) const {
    const MedialSphere& sphere = spheres_[i];
    const GlbBall ball = glb_ball({sphere.centre, sphere.radius}, middle_);
    const std::array<double, 3> centre = {ball.centre[0], ball.centre[1], ball.centre[2]};
    const double radius = ball.radius;
    out += fmt::format(
        ",{{\"mesh\":{},\"name\":\"{}\",\"translation\":[{},{},{}],\"scale\":[{},{},{}],\"extras\":"
        "{{\"object_angle\":{},\"sheet\":{}{}}}}}",
        mesh, i, centre[0], centre[1], centre[2], radius, radius, radius, sphere.object_angle, sphere.sheet,
        header_.inside_count ? fmt::format(",\"side\":\"{}\"", side_name(header_.side_of(i))) : "");
  }

  GltfJson instances_node(std::uint32_t mesh, const Indices& indices) {
    std::vector<Vector> centres, sizes;
    for (const std::uint32_t i : indices) {
      const GlbBall ball = glb_ball({spheres_[i].centre, spheres_[i].radius}, middle_);
      centres.push_back(ball.centre);
      sizes.push_back({ball.radius, ball.radius, ball.radius});
    }
    const GltfJson attributes = {{"TRANSLATION", glb_.add_vectors(centres, GltfTarget::kNone, false)},
                                 {"SCALE", glb_.add_vectors(sizes, GltfTarget::kNone, false)}};
    return {{"mesh", mesh},
            {"name", fmt::format("balls {}", mesh)},
            {"extensions", {{kExtension, {{"attributes", attributes}}}}}};
  }

  void add_mesh_of_all(const Icosphere& unit) {
    std::vector<Vector> points, normals;
    std::vector<std::array<std::uint16_t, 4>> colours;
    Indices corners;
    for (const MedialSphere& sphere : spheres_) {
      const auto first = static_cast<std::uint32_t>(points.size());
      append_ball(unit, sphere, points, normals);
      colours.resize(points.size(), vertex_colour(sphere));
      for (const auto& triangle : unit.triangles) {
        for (const std::uint32_t corner : triangle) corners.push_back(first + corner);
      }
    }
    const GltfJson attributes = {{"POSITION", glb_.add_vectors(points, GltfTarget::kVertices, true)},
                                 {"NORMAL", glb_.add_vectors(normals, GltfTarget::kVertices, false)},
                                 {"COLOR_0", glb_.add_colours(colours)}};
    const GltfJson primitive = {{"attributes", attributes},
                                {"indices", glb_.add_indices(corners, GltfComponent::kUnsignedInt)},
                                {"material", 0}};
    glb_.document["materials"].push_back(material("object angle", {1, 1, 1}));
    glb_.document["meshes"].push_back({{"name", "balls"}, {"primitives", {primitive}}});
  }

  void append_ball(const Icosphere& unit, const MedialSphere& sphere, std::vector<Vector>& points,
                   std::vector<Vector>& normals) const {
    const Point& c = sphere.centre;
    const Point centre = {c[0] - middle_[0], c[1] - middle_[1], c[2] - middle_[2]};
    const double radius = inscribed_radius(centre, sphere.radius, 0x1p-23);
    for (const Point& v : unit.vertices) {
      Vector point, normal;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        point[axis] = static_cast<float>(centre[axis] + radius * v[axis]);
        normal[axis] = static_cast<float>(v[axis]);
      }
      points.push_back(point);
      normals.push_back(normal);
    }
  }

  std::array<std::uint16_t, 4> vertex_colour(const MedialSphere& sphere) const {
    const Vector colour = linear_colour_of(colour_share(sphere.object_angle, header_.object_angle));
    const auto part = [](float share) { return static_cast<std::uint16_t>(std::lround(65535 * share)); };
    return {part(colour[0]), part(colour[1]), part(colour[2]), 65535};
  }

  const MedialHeader& header_;
  std::span<const MedialSphere> spheres_;
  Point middle_;
  GlbContainer glb_;
};

std::uint64_t bytes_per_node(std::uint32_t detail) {
  constexpr std::uint64_t kVertex = 2 * sizeof(Vector) + 4 * sizeof(std::uint16_t);
  return kVertex * icosphere_vertices(detail) + 3 * sizeof(std::uint32_t) * icosphere_triangles(detail);
}

}  // namespace

Result<std::string> encode_glb(const MedialHeader& header, std::span<const MedialSphere> spheres, GlbLayout layout,
                               std::optional<std::uint32_t> detail) {
  GlbEncoder encoder(header, spheres);
  if (layout == GlbLayout::kNodes) return encoder.nodes(detail.value_or(kUsualSphereDetail));
  if (layout == GlbLayout::kGpuInstances) return encoder.gpu_instances(detail.value_or(kUsualSphereDetail));
  const Result<std::uint32_t> chosen = choose_sphere_detail(detail, spheres.size(), bytes_per_node);
  if (!chosen) return chosen.error();
  return encoder.one_mesh(chosen.value());
}

}  // namespace medial_vk
