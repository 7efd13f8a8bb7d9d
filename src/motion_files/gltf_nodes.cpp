#include "motion_files/gltf_nodes.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace medial_vk {
namespace {

using Json = nlohmann::json;

template <std::size_t N>
void read_numbers(const Json& node, const char* key, std::array<double, N>& numbers) {
  const auto at = node.find(key);
  if (at == node.end()) return;
  if (!at->is_array() || at->size() != N) throw GltfFault{fmt::format("the {} of a node has not {} numbers", key, N)};
  for (std::size_t k = 0; k < N; ++k) numbers[k] = number_of_json((*at)[k]);
}

void normalize_rotation(std::array<double, 4>& rotation) {
  double norm = 0;
  for (const double x : rotation) norm = std::hypot(norm, x);
  if (!(norm > 0) || !std::isfinite(norm)) throw GltfFault{"the rotation of a node has no direction"};
  for (double& x : rotation) x /= norm;
}

std::optional<AffineMap> matrix_of(const Json& node) {
  if (!node.contains("matrix")) return {};
  std::array<double, 16> columns{};
  read_numbers(node, "matrix", columns);
  AffineMap::Rows rows;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) rows[i][j] = columns[4 * j + i];
  }
  return AffineMap(rows);
}

GltfNode node_of(const Json& json) {
  GltfNode node;
  node.name = text_in(json, "name");
  read_numbers(json, "translation", node.pose.translation);
  read_numbers(json, "rotation", node.pose.rotation);
  read_numbers(json, "scale", node.pose.scale);
  normalize_rotation(node.pose.rotation);
  node.matrix = matrix_of(json);
  node.mesh = whole_number_in(json, "mesh");
  node.skin = whole_number_in(json, "skin");
  return node;
}

}  // namespace

AffineMap map_of(const NodePose& pose) {
  const auto [x, y, z, w] = pose.rotation;
  const AffineMap::Rows rotation = {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
                                     {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
                                     {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0}}};
  AffineMap::Rows rows;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) rows[i][j] = rotation[i][j] * pose.scale[j];
    rows[i][3] = pose.translation[i];
  }
  return AffineMap(rows);
}

GltfNodes::GltfNodes(const GltfDocument& document) {
  read_nodes(document);
  order_nodes(document);
  find_shown(document);
}

const GltfNode& GltfNodes::operator[](std::uint64_t node) const {
  if (node >= nodes_.size()) throw GltfFault{fmt::format("node {} of {} is not there", node, nodes_.size())};
  return nodes_[node];
}

void GltfNodes::read_nodes(const GltfDocument& document) {
  const std::uint64_t count = document.count("nodes");
  if (count >= GltfNode::kNone) throw GltfFault{"it has too many nodes"};
  for (std::uint64_t i = 0; i < count; ++i) nodes_.push_back(node_of(document.item("nodes", i)));
}

/// Finds the parents, and an order in which they are before their children. A node on a cycle has no place in it.
void GltfNodes::order_nodes(const GltfDocument& document) {
  for (std::uint32_t i = 0; i < size(); ++i) {
    for (const Json& child : list_in(document.item("nodes", i), "children")) {
      const std::uint64_t index = whole_number_of_json(child);
      if ((*this)[index].parent != GltfNode::kNone) throw GltfFault{fmt::format("node {} has two parents", index)};
      nodes_[index].parent = i;
    }
  }
  for (std::uint32_t i = 0; i < size(); ++i) {
    if (nodes_[i].parent == GltfNode::kNone) order_.push_back(i);
  }
  for (std::size_t at = 0; at < order_.size(); ++at) {
    for (const Json& child : list_in(document.item("nodes", order_[at]), "children")) {
      order_.push_back(static_cast<std::uint32_t>(whole_number_of_json(child)));
    }
  }
  if (order_.size() != nodes_.size()) throw GltfFault{"a node is below itself"};
}

void GltfNodes::find_shown(const GltfDocument& document) {
  std::vector<std::uint32_t> open;
  const auto open_in_order = [&](const Json& list) {  // the first is the last to be put on the stack
    for (std::size_t i = list.size(); i-- > 0;) {
      const std::uint64_t index = whole_number_of_json(list[i]);
      if (index >= size()) throw GltfFault{fmt::format("node {} of {} is not there", index, size())};
      open.push_back(static_cast<std::uint32_t>(index));
    }
  };
  const std::uint64_t scene = whole_number_in(document.root(), "scene").value_or(0);
  if (document.count("scenes") == 0) throw GltfFault{"it has no scene"};
  const Json& roots = list_in(document.item("scenes", scene), "nodes");
  if (!roots.is_array()) throw GltfFault{"the nodes of the scene are no list"};
  open_in_order(roots);
  std::vector<std::uint8_t> is_known(nodes_.size());
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    if (std::exchange(is_known[node], std::uint8_t{1}) != 0)
      throw GltfFault{fmt::format("the scene has node {} twice", node)};
    if (nodes_[node].mesh) shown_.push_back(node);
    open_in_order(list_in(document.item("nodes", node), "children"));
  }
}

void GltfNodes::find_places(const std::vector<NodePose>& poses, std::vector<AffineMap>& places) const {
  places.resize(nodes_.size());
  for (const std::uint32_t node : order_) {
    const AffineMap local = nodes_[node].matrix ? *nodes_[node].matrix : map_of(poses[node]);
    const std::uint32_t parent = nodes_[node].parent;
    places[node] = parent == GltfNode::kNone ? local : places[parent] * local;
  }
}

std::vector<NodePose> GltfNodes::rest_poses() const {
  std::vector<NodePose> poses;
  poses.reserve(nodes_.size());
  for (const GltfNode& node : nodes_) poses.push_back(node.pose);
  return poses;
}

}  // namespace medial_vk
