#include "queries/packet_tree.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "device/context_impl.h"
#include "device_commands/uploads.h"

namespace medial_vk {
namespace {

/// Triangles below a node: they are neighbours in leaf order.
struct Run {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Children come after their parents in a Bvh, so a pass in reverse order visits them first.
std::vector<Run> all_runs(std::span<const BvhNode> nodes) {
  std::vector<Run> runs(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const BvhNode& node = nodes[i];
    if (node.count != 0) {
      runs[i] = {node.first, node.count};
    } else {
      const Run &a = runs[node.first], &b = runs[node.first + 1];
      runs[i] = {std::min(a.first, b.first), a.count + b.count};
    }
  }
  return runs;
}

double half_area(const BvhBox& box) {
  const Point s = box.upper - box.lower;
  return s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
}

/// The binary nodes that become children of the wide node made from `root`.
std::vector<std::uint32_t> wide_children(std::span<const BvhNode> nodes, std::span<const Run> runs, std::uint32_t root,
                                         std::uint32_t arity) {
  std::vector<std::uint32_t> children = {root};
  while (children.size() < arity) {
    std::size_t largest = children.size();
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (runs[children[i]].count <= gpu::kMostLeafTriangles) continue;
      const bool first = largest == children.size();
      if (first || half_area(nodes[children[i]].box) > half_area(nodes[children[largest]].box)) largest = i;
    }
    if (largest == children.size()) break;
    const std::uint32_t opened = children[largest];
    children[largest] = nodes[opened].first;
    children.push_back(nodes[opened].first + 1);
  }
  return children;
}

Texel texel(const Point& xyz, double w) {
  return {static_cast<float>(xyz[0]), static_cast<float>(xyz[1]), static_cast<float>(xyz[2]), static_cast<float>(w)};
}

Point rounded(const Point& p) {
  return {double{static_cast<float>(p[0])}, double{static_cast<float>(p[1])}, double{static_cast<float>(p[2])}};
}

/// `v` scaled to length 1, or `otherwise` if its length is negligible.
Point unit_or(const Point& v, const Point& otherwise) {
  const double size = length(v);
  return size > 1e-30 ? (1 / size) * v : otherwise;
}

Point any_perpendicular(const Point& t) {
  const Point axis = std::abs(t[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  return unit_or(cross(t, axis), {0, 0, 1});
}

/// The normal is that of the exact triangle, as in make_triangle_texels(): rounded corners may turn a thin one visibly.
/// Edges without length get the direction t, so that no point counts as inside.
void put_frame(Texel* out, const std::array<Point, 3>& exact, std::uint32_t index) {
  const Point a = rounded(exact[0]), ab = rounded(exact[1]) - a, ac = rounded(exact[2]) - a;
  const Point longer = dot(ab, ab) > 0 ? ab : (dot(ac, ac) > 0 ? ac : Point{1, 0, 0});
  const Point n =
      unit_or(cross(exact[1] - exact[0], exact[2] - exact[0]), any_perpendicular(unit_or(longer, {1, 0, 0})));
  const Point t = unit_or(longer - dot(longer, n) * n, any_perpendicular(n));
  const Point s = cross(n, t);
  const double ab_size = dot(ab, t);
  const Point flat_ac = {dot(ac, t), dot(ac, s), 0};
  const Point flat_bc = {flat_ac[0] - ab_size, flat_ac[1], 0};
  const Point along_ac = unit_or(flat_ac, {1, 0, 0}), along_bc = unit_or(flat_bc, {1, 0, 0});
  out[0] = texel(a, ab_size);
  out[1] = texel(t, length(flat_ac));
  out[2] = texel(s, length(flat_bc));
  out[3] = texel(n, static_cast<double>(index));
  out[4] = texel({along_ac[0], along_ac[1], along_bc[0]}, along_bc[1]);
}

}  // namespace

std::vector<Texel> make_wide_tree_texels(std::span<const BvhNode> nodes, const UnitTransform& to_unit,
                                         std::uint32_t arity) {
  const std::vector<Run> runs = all_runs(nodes);
  const std::size_t node_texels = std::size_t{kTexelsPerWideChild} * arity;
  std::vector<Texel> texels;
  std::vector<std::uint32_t> roots = {0};  // of the wide nodes, in their order
  for (std::size_t i = 0; i < roots.size(); ++i) {
    texels.resize(texels.size() + node_texels, Texel{0, 0, 0, -1});
    Texel* out = &texels[i * node_texels];
    for (const std::uint32_t child : wide_children(nodes, runs, roots[i], arity)) {
      const bool leaf = runs[child].count <= gpu::kMostLeafTriangles;
      const FloatBox box = float_box(nodes[child].box, to_unit);
      const std::uint32_t first = leaf ? runs[child].first : static_cast<std::uint32_t>(roots.size());
      if (!leaf) roots.push_back(child);
      *out++ = {box.lower[0], box.lower[1], box.lower[2], static_cast<float>(first)};
      *out++ = {box.upper[0], box.upper[1], box.upper[2], leaf ? static_cast<float>(runs[child].count) : 0.0f};
    }
  }
  return texels;
}

std::vector<Texel> make_frame_texels(const MeshView& mesh, std::span<const std::uint32_t> order,
                                     const UnitTransform& to_unit) {
  std::vector<Texel> texels(std::size_t{kTexelsPerFrame} * order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Triangle& triangle = mesh.triangles[order[i]];
    std::array<Point, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = to_unit(mesh.vertices[triangle[k]]);
    put_frame(&texels[kTexelsPerFrame * i], corners, order[i]);
  }
  return texels;
}

Result<PacketTree> PacketTree::create(ContextImpl& context, const DeviceMesh& device, std::uint32_t arity) {
  const UnitTransform to_unit = {device.lower, device.longest};
  const std::vector<Texel> node_data = make_wide_tree_texels(device.tree_nodes(), to_unit, arity);
  const std::vector<Texel> frame_data = make_frame_texels(device.source().view(), device.order, to_unit);
  std::vector<std::uint32_t> positions(device.order.size());
  for (std::size_t i = 0; i < positions.size(); ++i) positions[device.order[i]] = static_cast<std::uint32_t>(i);
  PacketTree tree(context);
  const auto position_bytes = std::as_bytes(std::span(positions));
  tree.arena_.expect(position_bytes.size() + sizeof(Texel) * (node_data.size() + frame_data.size()));
  Result<Buffer> table = tree.arena_.create_buffer(position_bytes.size(), MemoryKind::kDevice, "leaf positions");
  if (!table.ok()) return table.error();
  tree.positions = table.value();
  Uploads uploads(context);
  if (Status status = uploads.add(tree.positions, position_bytes); !status.ok()) return status.error();
  tree.use_texels =
      device.use_texels && std::max(node_data.size(), frame_data.size()) <= context.limits.maxTexelBufferElements;
  const MemoryKind kind = tree.use_texels ? MemoryKind::kTexels : MemoryKind::kDevice;
  struct Part {
    Buffer* buffer;
    VkBufferView* view;
    const std::vector<Texel>* texels;
    const char* purpose;
  };
  for (const Part& part : {Part{&tree.nodes, &tree.node_texels, &node_data, "the wide tree over the triangles"},
                           Part{&tree.frames, &tree.frame_texels, &frame_data, "frames of triangles"}}) {
    const auto bytes = std::as_bytes(std::span(*part.texels));
    Result<Buffer> buffer = tree.arena_.create_buffer(bytes.size(), kind, part.purpose);
    if (!buffer.ok()) return buffer.error();
    *part.buffer = buffer.value();
    if (Status status = uploads.add(*part.buffer, bytes); !status.ok()) return status.error();
    Result<Buffer> unread = buffer;
    if (!tree.use_texels) unread = tree.arena_.create_buffer(16, MemoryKind::kDevice, "an unused texel buffer");
    if (!unread.ok()) return unread.error();
    Result<VkBufferView> view = tree.arena_.create_texel_view(unread.value());
    if (!view.ok()) return view.error();
    *part.view = view.value();
  }
  if (Status there = uploads.finish(); !there.ok()) return there.error();
  return tree;
}

}  // namespace medial_vk
