#include "motion_files/gltf_meshes.h"

#include <fmt/format.h>

#include <algorithm>

namespace medial_vk {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kTriangles = 4, kStrip = 5, kFan = 6;
constexpr std::size_t kMostSets = 16;  // of four joints

std::uint32_t vertex_of(double index, std::uint64_t count) {
  if (!(index >= 0 && index < static_cast<double>(count))) throw GltfFault{"a face uses a vertex that is not there"};
  return static_cast<std::uint32_t>(index);
}

/// The triangles of a list, a strip or a fan of vertices (glTF 2.0, 3.7.2.1).
void append_triangles(std::uint64_t mode, const std::vector<std::uint32_t>& corners, std::vector<Triangle>& triangles) {
  if (corners.size() < 3) return;
  if (mode == kTriangles) {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    return;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const bool is_turned = i % 2 == 1;
    if (mode == kFan) triangles.push_back({corners[i + 1], corners[i + 2], corners[0]});
    if (mode == kStrip)
      triangles.push_back({corners[i], corners[i + (is_turned ? 2 : 1)], corners[i + (is_turned ? 1 : 2)]});
  }
}

GltfArray array_of_vertices(GltfAccessors& accessors, std::uint64_t accessor, std::uint64_t width,
                            std::uint64_t count) {
  GltfArray array = accessors.read(accessor, width);
  if (array.count != count) {
    throw GltfFault{fmt::format("an attribute has {} values for {} vertices", array.count, count)};
  }
  return array;
}

void read_sets(const Json& attributes, GltfAccessors& accessors, std::uint64_t& values_left, GltfPrimitive& primitive) {
  for (std::size_t set = 0;; ++set) {
    const auto joints = whole_number_in(attributes, fmt::format("JOINTS_{}", set).c_str());
    const auto weights = whole_number_in(attributes, fmt::format("WEIGHTS_{}", set).c_str());
    if (!joints && !weights) return;
    if (!joints || !weights) throw GltfFault{"a mesh has joints without weights, or weights without joints"};
    if (set == kMostSets) throw GltfFault{fmt::format("its vertices have more than {} joints each", 4 * kMostSets)};
    take_values(4 * primitive.positions.count, values_left);
    primitive.joints.push_back(array_of_vertices(accessors, *joints, 4, primitive.positions.count));
    primitive.weights.push_back(array_of_vertices(accessors, *weights, 4, primitive.positions.count));
  }
}

/// Nothing if the primitive shows no faces.
bool read_primitive(const Json& json, GltfAccessors& accessors, std::uint64_t& values_left, GltfPrimitive& primitive) {
  const std::uint64_t mode = whole_number_in(json, "mode").value_or(kTriangles);
  if (mode < kTriangles) return false;  // points and lines
  if (mode > kFan) throw GltfFault{fmt::format("a primitive has the mode {}, which glTF does not have", mode)};
  const Json& attributes = list_in(json, "attributes");
  if (!attributes.contains("POSITION")) return false;
  primitive.positions = accessors.read(required_number_in(attributes, "POSITION"), 3);
  const std::uint64_t vertices = primitive.positions.count;
  std::vector<std::uint32_t> corners;
  if (const auto indices = whole_number_in(json, "indices")) {
    const GltfArray list = accessors.read(*indices, 1);
    take_values(vertices + list.count, values_left);
    for (std::uint64_t i = 0; i < list.count; ++i) corners.push_back(vertex_of(*list[i], vertices));
  } else {
    take_values(2 * vertices, values_left);
    for (std::uint64_t i = 0; i < vertices; ++i) corners.push_back(static_cast<std::uint32_t>(i));
  }
  append_triangles(mode, corners, primitive.triangles);
  if (primitive.triangles.empty()) return false;
  for (const Json& shape : list_in(json, "targets")) {
    if (!shape.is_object()) throw GltfFault{"a shape is no object"};
    const auto added = whole_number_in(shape, "POSITION");
    primitive.shapes.push_back(added ? array_of_vertices(accessors, *added, 3, vertices) : GltfArray());
  }
  read_sets(attributes, accessors, values_left, primitive);
  return true;
}

}  // namespace

void take_values(std::uint64_t values, std::uint64_t& values_left) {
  if (values > values_left)
    throw GltfFault{"its meshes and their instances have too many corners, vertices or weights"};
  values_left -= values;
}

std::uint64_t values_of(const GltfMesh& mesh) {
  std::uint64_t values = 0;
  for (const GltfPrimitive& primitive : mesh.primitives) {
    values += primitive.positions.count * (1 + 4 * primitive.joints.size()) + 3 * primitive.triangles.size();
  }
  return values;
}

std::vector<double> shape_weights_of(const Json& object, std::uint64_t count) {
  const Json& list = list_in(object, "weights");
  std::vector<double> weights(count);
  if (list.empty()) return weights;
  if (!list.is_array() || list.size() != count) {
    throw GltfFault{fmt::format("there are {} weights for {} shapes", list.size(), count)};
  }
  for (std::size_t i = 0; i < count; ++i) weights[i] = number_of_json(list[i]);
  return weights;
}

GltfMesh gltf_mesh_of(const GltfDocument& document, GltfAccessors& accessors, std::uint64_t index,
                      std::uint64_t& values_left) {
  const Json& json = document.item("meshes", index);
  GltfMesh mesh;
  for (const Json& element : list_in(json, "primitives")) {
    if (!element.is_object()) throw GltfFault{"a primitive is no object"};
    GltfPrimitive primitive;
    if (!read_primitive(element, accessors, values_left, primitive)) continue;
    if (!mesh.primitives.empty() && primitive.shapes.size() != mesh.shapes) {
      throw GltfFault{"the primitives of a mesh have different numbers of shapes"};
    }
    mesh.shapes = primitive.shapes.size();
    mesh.primitives.push_back(std::move(primitive));
  }
  if (!mesh.primitives.empty()) mesh.weights = shape_weights_of(json, mesh.shapes);
  return mesh;
}

}  // namespace medial_vk
