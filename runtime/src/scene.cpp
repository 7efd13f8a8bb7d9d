#include "scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "clusters.h"
#include "context_impl.h"
#include "device_tree.h"
#include "mesh_links.h"
#include "open_edges.h"
#include "point_math.h"

namespace medial_vk {
namespace {

static_assert(gpu::kStackSize == Bvh::kMaxDepth);

/// Uploads to `buffer`, which is created if there is none yet, or too small a one.
Status fill(Context::Impl& context, Arena& arena, std::span<const std::byte> bytes, const char* purpose,
            Buffer& buffer) {
  if (buffer.handle == VK_NULL_HANDLE || buffer.size < bytes.size()) {
    Result<Buffer> created = arena.create_buffer(bytes.size(), MemoryKind::kDevice, purpose);
    if (!created.ok()) return created.error();
    buffer = created.value();
  }
  return upload(context, buffer, bytes);
}

constexpr std::uint32_t kMostClusters = 8192;
constexpr std::uint32_t kTrianglesOfCluster = 16;

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
    if (Status status = upload_clusters(context, mesh); !status.ok()) return status;
    if (Status status = upload_open_edges(context, mesh); !status.ok()) return status;
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
  if (Status status = upload_clusters(context, mesh); !status.ok()) return status;
  if (Status status = upload_open_edges(context, mesh); !status.ok()) return status;
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

Status DeviceMesh::upload_clusters(Context::Impl& context, const MeshView& mesh) {
  const std::vector<gpu::Cluster> made =
      make_clusters(bvh_, {lower, longest}, mesh.flags, kTrianglesOfCluster, kMostClusters);
  cluster_count = static_cast<std::uint32_t>(made.size());
  most_in_cluster = std::ranges::max_element(made, {}, &gpu::Cluster::count)->count;
  cluster_radius = median_radius(made);
  return fill(context, arena_, std::as_bytes(std::span(made)), "clusters of triangles", clusters);
}

Status DeviceMesh::upload_open_edges(Context::Impl& context, const MeshView& mesh) {
  OpenEdges edges;
  if (!mesh.closed) edges = find_open_edges(mesh, {lower, longest}, gpu::kMostOpenEdges);
  open_edge_count = edges.count;
  if (edges.listed.empty()) edges.listed.resize(1);
  return fill(context, arena_, std::as_bytes(std::span(edges.listed)), "open edges", open_edges);
}

Point DeviceMesh::to_unit(const Point& p) const { return UnitTransform{lower, longest}(p); }

Point DeviceMesh::to_input(const std::array<float, 3>& p) const {
  return lower + longest * Point{double{p[0]}, double{p[1]}, double{p[2]}};
}

}  // namespace medial_vk
