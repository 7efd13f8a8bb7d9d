#include "scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "context_impl.h"
#include "device_tree.h"
#include "mesh_links.h"
#include "point_math.h"

namespace medial_vk {
namespace {

static_assert(gpu::kStackSize == Bvh::kMaxDepth);

/// Uploads to `buffer`, which is created if there is none yet.
Status fill(Context::Impl& context, Arena& arena, std::span<const std::byte> bytes, const char* purpose,
            Buffer& buffer) {
  if (buffer.handle == VK_NULL_HANDLE) {
    Result<Buffer> created = arena.create_buffer(bytes.size(), MemoryKind::kDevice, purpose);
    if (!created.ok()) return created.error();
    buffer = created.value();
  }
  return upload(context, buffer, bytes);
}

FloatBox join(const FloatBox& a, const FloatBox& b) {
  FloatBox out;
  for (int k = 0; k < 3; ++k) {
    out.lower[k] = std::min(a.lower[k], b.lower[k]);
    out.upper[k] = std::max(a.upper[k], b.upper[k]);
  }
  return out;
}

/// Before anything is built. The triangles are the largest of the buffers that grow with the mesh.
Status check_size(std::size_t triangles, const VkPhysicalDeviceLimits& limits) {
  constexpr std::size_t kBytes = kTexelsPerTriangle * sizeof(Texel);
  const std::string mesh = "the mesh has " + std::to_string(triangles) + " triangles, ";
  if (triangles > DeviceMesh::kMostTriangles) {
    return Error{ErrorCode::kOutOfMemory,
                 mesh + "the device code addresses " + std::to_string(DeviceMesh::kMostTriangles)};
  }
  const std::size_t most = limits.maxStorageBufferRange / kBytes;
  if (triangles <= most) return {};
  return Error{ErrorCode::kOutOfMemory, mesh + "this device takes " + std::to_string(most) + " at most: of " +
                                            std::to_string(kBytes) + " bytes each, its kernels see " +
                                            std::to_string(limits.maxStorageBufferRange) +
                                            " in a buffer (maxStorageBufferRange)"};
}

}  // namespace

Result<DeviceMesh> DeviceMesh::create(Context::Impl& context, const MeshView& mesh) {
  if (Status status = check_size(mesh.triangles.size(), context.limits); !status.ok()) return status.error();
  Result<Bvh> bvh = Bvh::build(mesh, kLeafSize);
  if (!bvh.ok()) return bvh.error();
  DeviceMesh device(context);
  device.bvh_ = std::move(bvh).value();
  device.order = device.bvh_.order();
  device.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
  if (Status status = device.measure(mesh); !status.ok()) return status.error();
  if (Status status = device.upload_mesh(context, mesh); !status.ok()) return status.error();
  if (Status status = device.create_views(); !status.ok()) return status.error();
  return device;
}

Status DeviceMesh::update(Context::Impl& context, const MeshView& mesh) {
  if (linked_vertices_ != 0 && mesh.vertices.size() != linked_vertices_) {
    return Error{ErrorCode::kInvalidMesh, "the mesh has " + std::to_string(mesh.vertices.size()) +
                                              " vertices, the one on the device " + std::to_string(linked_vertices_)};
  }
  const bool was_intact = intact;
  intact = false;
  if (Status status = bvh_.refit(mesh); !status.ok()) {
    intact = was_intact && status.error().code == ErrorCode::kInvalidMesh;
    return status;
  }
  if (Status status = measure(mesh); !status.ok()) return status;
  if (Status status = upload_mesh(context, mesh); !status.ok()) return status;
  if (linked_vertices_ != 0) {
    if (Status status = upload_links(context, mesh); !status.ok()) return status;
  }
  intact = true;
  return {};
}

/// What is known of the mesh as a whole. Error: it has no extent.
Status DeviceMesh::measure(const MeshView& mesh) {
  const BvhBox& box = bvh_.nodes()[0].box;
  const Point sides = box.upper - box.lower;
  const double side = std::max({sides[0], sides[1], sides[2]});
  if (!(side > 0) || !std::isfinite(side)) {
    return Error{ErrorCode::kInvalidMesh, "the mesh has no extent, or one too large for a double"};
  }
  lower = box.lower;
  upper = box.upper;
  longest = side;
  closed = mesh.closed;
  has_untrusted = mesh.flags.empty() || !std::all_of(mesh.flags.begin(), mesh.flags.end(),
                                                     [](std::uint8_t f) { return (f & kTrustedNormal) != 0; });
  return {};
}

Status DeviceMesh::upload_mesh(Context::Impl& context, const MeshView& mesh) {
  const UnitTransform to_unit_box = {lower, longest};
  const std::vector<Texel> triangle_data = make_triangle_texels(bvh_, to_unit_box, mesh.flags);
  const std::vector<Texel> tree_data = make_tree_texels(bvh_, to_unit_box);
  node_count = static_cast<std::uint32_t>(tree_data.size() / kTexelsPerNode);
  use_texels = std::max(triangle_data.size(), tree_data.size()) <= context.limits.maxTexelBufferElements;
  Status status = fill(context, arena_, std::as_bytes(std::span(triangle_data)), "triangles", triangles);
  if (!status.ok()) return status;
  status = fill(context, arena_, std::as_bytes(std::span(tree_data)), "the tree over the triangles", tree);
  if (!status.ok()) return status;
  return fill(context, arena_, std::as_bytes(std::span(order)), "triangle indices", triangle_info);
}

Status DeviceMesh::create_views() {
  Buffer unread;
  if (!use_texels) {
    Result<Buffer> buffer = arena_.create_buffer(16, MemoryKind::kDevice, "an unused texel buffer");
    if (!buffer.ok()) return buffer.error();
    unread = buffer.value();
  }
  Result<VkBufferView> triangle_view = arena_.create_texel_view(use_texels ? triangles : unread);
  if (!triangle_view.ok()) return triangle_view.error();
  Result<VkBufferView> tree_view = arena_.create_texel_view(use_texels ? tree : unread);
  if (!tree_view.ok()) return tree_view.error();
  triangle_texels = triangle_view.value();
  tree_texels = tree_view.value();
  return {};
}

Status DeviceMesh::add_links(Context::Impl& context, const MeshView& mesh) {
  if (Status status = upload_links(context, mesh); !status.ok()) return status;
  linked_vertices_ = mesh.vertices.size();
  return {};
}

Status DeviceMesh::upload_links(Context::Impl& context, const MeshView& mesh) {
  const MeshLinks cones = make_mesh_links(mesh, order);
  Status status = fill(context, arena_, std::as_bytes(std::span(cones.links)), "what triangles share with neighbours",
                       triangle_links);
  if (!status.ok()) return status;
  return fill(context, arena_, std::as_bytes(std::span(cones.corners)), "spokes to vertices", corner_cones);
}

// Subtrees of at most `least` triangles, in leaf order, joined until there are enough.
std::vector<LeafRange> DeviceMesh::leaf_ranges(std::uint32_t least) const {
  const UnitTransform to_unit_box = {lower, longest};
  const std::vector<BvhNode>& nodes = bvh_.nodes();
  std::vector<std::uint32_t> sizes(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    sizes[i] = nodes[i].count != 0 ? nodes[i].count : sizes[nodes[i].first] + sizes[nodes[i].first + 1];
  }
  std::vector<LeafRange> ranges;
  bool open = false;  // the last range may take more
  std::vector<std::uint32_t> pending = {0};
  std::uint32_t position = 0;
  while (!pending.empty()) {
    const std::uint32_t i = pending.back();
    pending.pop_back();
    if (nodes[i].count == 0 && sizes[i] > least) {
      pending.push_back(nodes[i].first + 1);
      pending.push_back(nodes[i].first);
      continue;
    }
    const FloatBox box = float_box(nodes[i].box, to_unit_box);
    if (!open) {
      ranges.push_back({box.lower, box.upper, position, 0});
    } else {
      const FloatBox both = join({ranges.back().lower, ranges.back().upper}, box);
      ranges.back().lower = both.lower;
      ranges.back().upper = both.upper;
    }
    position += sizes[i];
    ranges.back().count += sizes[i];
    open = ranges.back().count < least;
  }
  return ranges;
}

Point DeviceMesh::to_unit(const Point& p) const { return UnitTransform{lower, longest}(p); }

Point DeviceMesh::to_input(const std::array<float, 3>& p) const {
  return lower + longest * Point{double{p[0]}, double{p[1]}, double{p[2]}};
}

}  // namespace medial_vk
