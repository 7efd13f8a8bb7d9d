#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "medial_vk/version.h"
#include "output/boundary_colours/boundary_colours.h"
#include "output/boundary_files/encode_boundary.h"
#include "output/colours/colour_map.h"
#include "output/medial_formats/glb_balls.h"
#include "output/medial_formats/glb_container.h"

namespace medial_vk {
namespace {

/// In float, on the side where an interval still holds what it held; 0 if it is not known.
float rounded(double value, FieldRounding rounding) {
  if (std::isnan(value)) return 0;
  constexpr double kMost = std::numeric_limits<float>::max();
  const auto nearest = static_cast<float>(std::clamp(value, -kMost, kMost));
  if (rounding == FieldRounding::kDown && double{nearest} > value) return std::nextafter(nearest, -INFINITY);
  if (rounding == FieldRounding::kUp && double{nearest} < value) return std::nextafter(nearest, INFINITY);
  return nearest;
}

std::string attribute_name(std::string_view field) {
  std::string name = "_";
  for (const char c : field) name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::size_t add_field(GlbContainer& glb, const BoundaryField& field) {
  std::vector<float> numbers;
  numbers.reserve(field.values.size());
  for (const double value : field.values) numbers.push_back(rounded(value, field.rounding));
  if (field.components == 1) return glb.add_numbers(numbers);
  std::vector<std::array<float, 3>> vectors(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) vectors[i / 3][i % 3] = numbers[i];
  return glb.add_vectors(vectors, GltfTarget::kVertices, false);
}

std::size_t add_positions(GlbContainer& glb, const Mesh& mesh, const Point& middle) {
  std::vector<std::array<float, 3>> positions;
  positions.reserve(mesh.vertices.size());
  for (const Point& p : mesh.vertices) {
    std::array<float, 3> position{};
    for (std::size_t k = 0; k < 3; ++k) position[k] = static_cast<float>(p[k] - middle[k]);
    positions.push_back(position);
  }
  return glb.add_vectors(positions, GltfTarget::kVertices, true);
}

/// Vertex colours are linear light.
std::size_t add_vertex_colours(GlbContainer& glb, std::span<const Eigen::Vector3f> colours) {
  std::vector<std::array<std::uint16_t, 4>> parts;
  parts.reserve(colours.size());
  for (const Eigen::Vector3f& colour : colours) {
    const Eigen::Vector3f light = picture::to_light(colour);
    std::array<std::uint16_t, 4> part = {0, 0, 0, 65535};
    for (std::size_t k = 0; k < 3; ++k) {
      const float share = std::clamp(light[static_cast<Eigen::Index>(k)], 0.0f, 1.0f);
      part[k] = static_cast<std::uint16_t>(std::lround(65535 * share));
    }
    parts.push_back(part);
  }
  return glb.add_colours(parts);
}

std::size_t add_corners(GlbContainer& glb, const Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  return glb.add_indices(corners, GltfComponent::kUnsignedInt);
}

}  // namespace

Result<std::string> encode_boundary_glb(const Mesh& mesh, const BoundaryFields& fields, BoundaryColour colour,
                                        double longest_side) {
  const BoundaryColours colours = colour_boundary(fields, colour, longest_side);
  CentreBox box;
  for (const Point& p : mesh.vertices) box.add(p);
  const Point middle = box.middle();
  GlbContainer glb;
  GltfJson attributes = {{"POSITION", add_positions(glb, mesh, middle)},
                         {"COLOR_0", add_vertex_colours(glb, colours.of_vertices)}};
  for (const BoundaryField& field : fields.of_vertices) attributes[attribute_name(field.name)] = add_field(glb, field);
  const GltfJson primitive = {{"attributes", attributes}, {"indices", add_corners(glb, mesh)}, {"material", 0}};
  glb.document = {{"asset", {{"version", "2.0"}, {"generator", std::string("medial-vk ") + version()}}},
                  {"scene", 0},
                  {"scenes", {{{"nodes", {0}}}}},
                  {"materials",
                   {{{"name", colours.title},
                     {"doubleSided", true},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.6}}}}}},
                  {"meshes", {{{"name", "boundary"}, {"primitives", {primitive}}}}}};
  return glb.finish(
      fmt::format(R"([{{"mesh":0,"name":"boundary","translation":[{},{},{}]}}])", middle[0], middle[1], middle[2]));
}

}  // namespace medial_vk
