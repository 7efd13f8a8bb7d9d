#include "motion_files/moving_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quoted.h"
#include "mesh/clean_mesh.h"

namespace medial_vk {
namespace {

constexpr std::uint64_t kOfNodes = ~std::uint64_t{0};  // the group of joints that are nodes which show meshes

Point point_at(const GltfArray& array, std::uint64_t element) {
  const double* values = array[element];
  return {values[0], values[1], values[2]};
}

AffineMap matrix_at(const GltfArray& array, std::uint64_t element) {
  const double* columns = array[element];
  AffineMap::Rows rows;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) rows[i][j] = columns[4 * j + i];
  }
  return AffineMap(rows);
}

/// The weighted mean of the places that the joints give to a point.
Point blend(std::span<const RigInfluence> influences, std::span<const AffineMap> maps, const Point& bind) {
  Point sum = {0, 0, 0};
  for (const RigInfluence& influence : influences) {
    const Point p = maps[influence.joint](bind);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += influence.weight * p[k];
  }
  return sum;
}

bool have_same_shapes(const GltfPrimitive& a, std::uint64_t of_a, const GltfPrimitive& b, std::uint64_t of_b) {
  for (std::size_t i = 0; i < a.shapes.size(); ++i) {
    const Point zero = {0, 0, 0};
    const Point first = a.shapes[i].values ? point_at(a.shapes[i], of_a) : zero;
    const Point second = b.shapes[i].values ? point_at(b.shapes[i], of_b) : zero;
    if (first != second) return false;
  }
  return true;
}

}  // namespace

/// Appends a part: first all of its vertices, then without those that coincide at rest.
class MovingMesh::PartBuilder {
 public:
  PartBuilder(MovingMesh& owner, const GltfMesh& mesh, const GltfNodes& nodes, std::uint32_t node)
      : owner_(owner), mesh_(mesh), nodes_(nodes), node_(node) {}

  /// The joints of a skin begin with `first`.
  void add_primitive(std::uint32_t index, std::uint32_t first, std::uint32_t joint_count) {
    const GltfPrimitive& primitive = mesh_.primitives[index];
    const auto first_vertex = static_cast<std::uint32_t>(part_.vertices.size());
    turned_ = 0;
    for (std::uint64_t v = 0; v < primitive.positions.count; ++v) {
      const std::size_t begin = influences_.size();
      add_influences(primitive, v, first, joint_count);
      const std::span<const RigInfluence> own = std::span(influences_).subspan(begin);
      part_.vertices.push_back(blend(own, owner_.rest_maps_, point_at(primitive.positions, v)));
      sources_.push_back({index, static_cast<std::uint32_t>(v)});
      ends_.push_back(influences_.size());
    }
    const bool is_reflected = turned_ > 0;
    for (const Triangle& t : primitive.triangles) {
      const Triangle own = is_reflected ? Triangle{t[2], t[1], t[0]} : t;
      part_.triangles.push_back({first_vertex + own[0], first_vertex + own[1], first_vertex + own[2]});
    }
  }

  void finish() {
    const std::vector<std::uint32_t> kept = merge_equal_vertices(part_);
    const auto first_vertex = static_cast<std::uint32_t>(owner_.rest_.vertices.size());
    std::vector<std::uint32_t> first_of;  // by kept vertex, the first that became it
    std::vector<std::uint8_t> is_separable;
    for (std::uint32_t old = 0; old < kept.size(); ++old) {
      if (kept[old] == first_of.size()) {
        first_of.push_back(old);
        is_separable.push_back(0);
        append(old);
      } else if (!move_alike(old, first_of[kept[old]])) {
        is_separable[kept[old]] = 1;
      }
    }
    for (const std::uint8_t separable : is_separable) owner_.separable_ += separable;
    Mesh& rest = owner_.rest_;
    rest.vertices.insert(rest.vertices.end(), part_.vertices.begin(), part_.vertices.end());
    for (const Triangle& t : part_.triangles) {
      rest.triangles.push_back({first_vertex + t[0], first_vertex + t[1], first_vertex + t[2]});
    }
  }

 private:
  void add_influences(const GltfPrimitive& primitive, std::uint64_t vertex, std::uint32_t first, std::uint32_t count) {
    const std::size_t begin = influences_.size();
    double sum = 0;
    for (std::size_t set = 0; set < primitive.joints.size() && count > 0; ++set) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double weight = primitive.weights[set][vertex][k];
        if (!(weight > 0)) continue;
        const double joint = primitive.joints[set][vertex][k];
        if (!(joint >= 0 && joint < count)) throw GltfFault{"a vertex follows a joint that is not there"};
        influences_.push_back({first + static_cast<std::uint32_t>(joint), weight});
        sum += weight;
      }
    }
    if (influences_.size() == begin) {
      influences_.push_back({owner_.joint_of_node(nodes_, node_), 1});
      sum = 1;
    }
    for (std::size_t i = begin; i < influences_.size(); ++i) {
      influences_[i].weight /= sum;
      turned_ += (owner_.is_reflection_[influences_[i].joint] ? 1 : -1) * influences_[i].weight;
    }
  }

  std::span<const RigInfluence> influences_of(std::uint32_t vertex) const {
    const std::size_t begin = vertex == 0 ? 0 : ends_[vertex - 1];
    return std::span(influences_).subspan(begin, ends_[vertex] - begin);
  }

  Point bind_position(std::uint32_t vertex) const {
    return point_at(mesh_.primitives[sources_[vertex].primitive].positions, sources_[vertex].element);
  }

  bool move_alike(std::uint32_t a, std::uint32_t b) const {
    return bind_position(a) == bind_position(b) && std::ranges::equal(influences_of(a), influences_of(b)) &&
           have_same_shapes(mesh_.primitives[sources_[a].primitive], sources_[a].element,
                            mesh_.primitives[sources_[b].primitive], sources_[b].element);
  }

  void append(std::uint32_t vertex) {
    MotionRig& rig = owner_.rig_;
    rig.bind_positions.push_back(bind_position(vertex));
    const std::span<const RigInfluence> own = influences_of(vertex);
    rig.influences.insert(rig.influences.end(), own.begin(), own.end());
    rig.first_influence.push_back(rig.influences.size());
    owner_.sources_.push_back(sources_[vertex]);
  }

  MovingMesh& owner_;
  const GltfMesh& mesh_;
  const GltfNodes& nodes_;
  std::uint32_t node_;
  Mesh part_;
  std::vector<Source> sources_;           // by vertex of the part
  std::vector<RigInfluence> influences_;  // of all vertices
  std::vector<std::size_t> ends_;         // by vertex, where its influences end
  double turned_ = 0;                     // the weights of joints that reflect, less those of others
};

MovingMesh::MovingMesh(const GltfDocument& document, GltfAccessors& accessors, const GltfNodes& nodes,
                       std::uint64_t most_values) {
  nodes.find_places(nodes.rest_poses(), rest_places_);
  rig_.first_influence.push_back(0);
  std::map<std::uint64_t, std::shared_ptr<const GltfMesh>> meshes;
  std::uint64_t values_left = most_values;
  for (const std::uint32_t node : nodes.shown()) {
    std::shared_ptr<const GltfMesh>& mesh = meshes[*nodes[node].mesh];
    if (mesh) take_values(values_of(*mesh), values_left);
    if (!mesh) {
      mesh = std::make_shared<const GltfMesh>(gltf_mesh_of(document, accessors, *nodes[node].mesh, values_left));
    }
    if (mesh->primitives.empty()) continue;
    Part part = {node, rest_.vertices.size(), 0, mesh, mesh->weights};
    if (document.item("nodes", node).contains("weights")) {
      part.weights = shape_weights_of(document.item("nodes", node), mesh->shapes);
    }
    std::pair<std::uint32_t, std::uint32_t> skin = {0, 0};
    if (nodes[node].skin) {
      const std::uint32_t first = first_joint_of_skin(document, accessors, nodes, *nodes[node].skin);
      skin = {first, skins_.at(*nodes[node].skin).second};
    }
    PartBuilder builder(*this, *mesh, nodes, node);
    for (std::uint32_t i = 0; i < mesh->primitives.size(); ++i) builder.add_primitive(i, skin.first, skin.second);
    builder.finish();
    part.end_vertex = rest_.vertices.size();
    rig_.has_shapes = rig_.has_shapes || mesh->shapes > 0;
    parts_.push_back(std::move(part));
  }
  find_parents(nodes);
  if (rest_.triangles.empty()) throw GltfFault{fmt::format("no faces ({} meshes)", document.count("meshes"))};
  for (const Point& p : rest_.vertices) {
    for (const double x : p) {
      if (!std::isfinite(x)) throw GltfFault{"a coordinate of a mesh is not finite"};
    }
  }
}

std::uint32_t MovingMesh::add_joint(const GltfNodes& nodes, std::uint64_t group, std::uint64_t node,
                                    const AffineMap& inverse_bind) {
  const auto joint = static_cast<std::uint32_t>(rig_.joints.size());
  rig_.joints.push_back(
      {nodes[node].name, static_cast<std::uint32_t>(node), RigJoint::kNone, inverse_bind, rest_places_[node]});
  group_of_joint_.push_back(group);
  joint_of_.try_emplace({group, node}, joint);
  rest_maps_.push_back(rest_places_[node] * inverse_bind);
  is_reflection_.push_back(rest_maps_.back().determinant() < 0 ? 1 : 0);
  return joint;
}

std::uint32_t MovingMesh::joint_of_node(const GltfNodes& nodes, std::uint32_t node) {
  const auto known = joint_of_.find({kOfNodes, node});
  return known != joint_of_.end() ? known->second : add_joint(nodes, kOfNodes, node, AffineMap());
}

std::uint32_t MovingMesh::first_joint_of_skin(const GltfDocument& document, GltfAccessors& accessors,
                                              const GltfNodes& nodes, std::uint64_t skin) {
  if (const auto known = skins_.find(skin); known != skins_.end()) return known->second.first;
  const nlohmann::json& json = document.item("skins", skin);
  const nlohmann::json& joints = list_in(json, "joints");
  GltfArray matrices;
  if (const auto accessor = whole_number_in(json, "inverseBindMatrices")) {
    matrices = accessors.read(*accessor, 16);
    if (matrices.count < joints.size()) throw GltfFault{"a skin has fewer matrices than joints"};
  }
  const auto first = static_cast<std::uint32_t>(rig_.joints.size());
  std::uint32_t index = 0;
  for (const nlohmann::json& joint : joints) {
    add_joint(nodes, skin, whole_number_of_json(joint), matrices.values ? matrix_at(matrices, index) : AffineMap());
    ++index;
  }
  skins_[skin] = {first, index};
  return first;
}

/// The joint above is that of the nearest node above which has one: of the same skin if there is one, or any other.
void MovingMesh::find_parents(const GltfNodes& nodes) {
  std::map<std::uint32_t, std::uint32_t> any_of;  // by node
  for (const auto& [key, joint] : joint_of_) any_of.try_emplace(static_cast<std::uint32_t>(key.second), joint);
  std::vector<std::uint32_t> nearest(nodes.size(), GltfNode::kNone);  // by node, the nearest one above with a joint
  for (const std::uint32_t node : nodes.order()) {
    const std::uint32_t above = nodes[node].parent;
    if (above != GltfNode::kNone) nearest[node] = any_of.contains(above) ? above : nearest[above];
  }
  for (std::uint32_t joint = 0; joint < rig_.joints.size(); ++joint) {
    const std::uint32_t above = nearest[rig_.joints[joint].node];
    if (above == GltfNode::kNone) continue;
    const auto same = joint_of_.find({group_of_joint_[joint], above});
    rig_.joints[joint].parent = same != joint_of_.end() ? same->second : any_of.at(above);
  }
}

std::vector<std::uint8_t> MovingMesh::nodes_that_carry(const GltfNodes& nodes) const {
  std::vector<std::uint8_t> carry(nodes.size());
  for (const RigInfluence& influence : rig_.influences) carry[rig_.joints[influence.joint].node] = 1;
  for (std::uint32_t node = 0; node < nodes.size(); ++node) {
    if (carry[node] != 1) continue;
    for (std::uint32_t above = nodes[node].parent; above != GltfNode::kNone && carry[above] == 0;
         above = nodes[above].parent) {
      carry[above] = 2;  // and so do all above it, which this walk marks
    }
  }
  return carry;
}

void MovingMesh::place_vertices(std::span<const AffineMap> places, std::span<const std::vector<double>> weights,
                                std::vector<AffineMap>& joints, std::vector<Point>& positions) const {
  joints.resize(rig_.joints.size());
  std::vector<AffineMap> maps(rig_.joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i] = places[rig_.joints[i].node];
    maps[i] = joints[i] * rig_.joints[i].inverse_bind;
  }
  positions.resize(rest_.vertices.size());
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const GltfMesh& mesh = *parts_[part].mesh;
    for (std::size_t v = parts_[part].first_vertex; v < parts_[part].end_vertex; ++v) {
      Point bind = rig_.bind_positions[v];
      const std::vector<GltfArray>& shapes = mesh.primitives[sources_[v].primitive].shapes;
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        if (weights[part][i] == 0 || !shapes[i].values) continue;
        const double* added = shapes[i][sources_[v].element];
        for (std::size_t k = 0; k < 3; ++k) bind[k] += weights[part][i] * added[k];
      }
      positions[v] = blend(rig_.influences_of(v), maps, bind);
    }
  }
}

}  // namespace medial_vk
