#include "device_mesh/device_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/point_ops.h"
#include "device/context_impl.h"
#include "device_mesh/clusters.h"
#include "device_mesh/device_tree.h"
#include "device_mesh/open_edges.h"
#include "indexed_mesh/indexed_mesh_impl.h"

namespace medial_vk {
namespace {

static_assert(gpu::kStackSize == Bvh::kMaxDepth);

Uploader through(Uploads& uploads) {
  return [&uploads](const Buffer& buffer, std::span<const std::byte> bytes) { return uploads.add(buffer, bytes); };
}

constexpr VkFormat kFloats = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr std::uint32_t kTrianglesOfCluster = 16;

}  // namespace

/// Tested before anything is built. The triangles are the largest of the buffers that grow with the mesh.
Status DeviceMesh::check_size(std::size_t triangles, const VkPhysicalDeviceLimits& limits) {
  constexpr std::size_t kBytes = kTexelsPerTriangle * sizeof(Texel);
  const std::string mesh = "the mesh has " + std::to_string(triangles) + " triangles, ";
  if (triangles > kMostTriangles) {
    return Error{ErrorCode::kOutOfMemory, mesh + "the device code addresses " + std::to_string(kMostTriangles)};
  }
  const std::size_t in_storage = limits.maxStorageBufferRange / kBytes;
  const std::size_t in_texels = limits.maxTexelBufferElements / kTexelsPerTriangle;
  if (triangles <= std::max(in_storage, in_texels)) return {};
  return Error{ErrorCode::kOutOfMemory, mesh + "this device takes " + std::to_string(std::max(in_storage, in_texels)) +
                                            " at most: of " + std::to_string(kBytes) + " bytes each, its kernels see " +
                                            std::to_string(limits.maxStorageBufferRange) +
                                            " in a buffer (maxStorageBufferRange), or " +
                                            std::to_string(limits.maxTexelBufferElements) + " texels of " +
                                            std::to_string(sizeof(Texel)) + " bytes (maxTexelBufferElements)"};
}

Result<DeviceMesh> DeviceMesh::create(ContextImpl& context, const IndexedMesh& mesh, bool with_links) {
  if (Status status = check_size(mesh.view().triangles.size(), context.limits); !status.ok()) return status.error();
  DeviceMesh device(context, mesh);
  device.order = mesh.bvh().order();
  device.triangle_count = static_cast<std::uint32_t>(device.order.size());
  if (Status status = device.measure(); !status.ok()) return status.error();
  device.has_links_ = with_links;
  device.uploads_ = std::make_unique<Uploads>(context);
  const Uploader uploader = through(*device.uploads_);
  if (Status status = device.upload_mesh(uploader); !status.ok()) return status.error();
  if (with_links) {
    if (Status status = device.upload_all_links(uploader); !status.ok()) return status.error();
  }
  if (Status status = device.uploads_->flush(); !status.ok()) return status.error();
  return device;
}

const MeshLinks& DeviceMesh::links() const { return Internals::of(source_).links; }

Status DeviceMesh::finish_uploads() {
  if (uploads_ == nullptr) return {};
  const std::unique_ptr<Uploads> uploads = std::move(uploads_);
  Status there = uploads->finish();
  intact = intact && there.ok();
  return there;
}

Status DeviceMesh::update(const IndexedMesh& moved) {
  Uploads uploads(*context_);
  if (Status status = update(moved, through(uploads)); !status.ok()) return status;
  intact = false;  // also after an exception
  Status there = uploads.finish();
  intact = there.ok();
  return there;
}

Status DeviceMesh::update(const IndexedMesh& moved, const Uploader& uploader) {
  const bool is_same_mesh = moved.bvh().order() == order && moved.side() == source_.side() &&
                            moved.view().vertices.size() == source_.view().vertices.size();
  if (!is_same_mesh) {
    return Error{ErrorCode::kUsage, "the mesh is not a moved copy of the one on the device"};
  }
  source_ = moved;
  intact = false;
  if (Status status = measure(); !status.ok()) return status;
  if (Status status = upload_mesh(uploader); !status.ok()) return status;
  if (has_links_) {
    if (Status status = upload_all_links(uploader); !status.ok()) return status;
  }
  intact = true;
  return {};
}

VkDeviceSize DeviceMesh::update_bytes() const {
  VkDeviceSize sum = 0;
  for (const Buffer* b : {&triangles, &tree, &triangle_info, &triangle_links, &corner_cones, &clusters, &open_edges})
    sum += b->size;
  return sum;
}

/// The global properties of the mesh. Error: it has no extent.
Status DeviceMesh::measure() {
  const MeshView mesh = source_.view();
  const BvhBox& box = tree_nodes()[0].box;
  const Point sides = box.upper - box.lower;
  const double extent = std::max({sides[0], sides[1], sides[2]});
  if (!(extent > 0) || !std::isfinite(extent) || !std::isfinite(source_.longest_side())) {
    return Error{ErrorCode::kInvalidMesh, "the mesh has no extent, or one too large for a double"};
  }
  lower = source_.region_lower();
  upper = source_.region_upper();
  longest = source_.longest_side();
  side = source_.side();
  closed = mesh.closed;
  has_untrusted = mesh.flags.empty() || !std::all_of(mesh.flags.begin(), mesh.flags.end(),
                                                     [](std::uint8_t f) { return (f & kTrustedNormal) != 0; });
  return {};
}

Status DeviceMesh::upload_mesh(const Uploader& uploader) {
  const std::vector<Texel> tree_data = make_tree_texels(source_.bvh(), {lower, longest}, context_->host_threads);
  node_count = static_cast<std::uint32_t>(tree_data.size() / kTexelsPerNode);
  // Links of vertices are a texel each.
  use_texels = std::max({kTexelsPerTriangle * order.size(), tree_data.size(), source_.view().vertices.size()}) <=
               context_->limits.maxTexelBufferElements;
  if (Status status = upload_triangles(uploader, has_links_ ? std::span(links().spreads) : std::span<const float>());
      !status.ok())
    return status;
  Status status = fill_texels(uploader, std::as_bytes(std::span(tree_data)), "the tree over the triangles", kFloats,
                              tree, tree_texels);
  if (!status.ok()) return status;
  return fill(uploader, std::as_bytes(std::span(order)), MemoryKind::kDevice, "triangle indices", triangle_info);
}

Status DeviceMesh::upload_triangles(const Uploader& uploader, std::span<const float> spreads) {
  const std::vector<Texel> made =
      make_triangle_texels(source_.bvh(), {lower, longest}, source_.view().flags, spreads, context_->host_threads);
  return fill_texels(uploader, std::as_bytes(std::span(made)), "triangles", kFloats, triangles, triangle_texels);
}

/// Uploads to a buffer, which is created if there is none or it is too small.
Status DeviceMesh::fill(const Uploader& uploader, std::span<const std::byte> bytes, MemoryKind kind,
                        const char* purpose, Buffer& buffer) {
  if (buffer.handle == VK_NULL_HANDLE || buffer.size < bytes.size()) {
    Result<Buffer> created = arena_.create_buffer(bytes.size(), kind, purpose);
    if (!created.ok()) return created.error();
    buffer = created.value();
  }
  return uploader(buffer, bytes);
}

/// The same with a view, which is of a buffer that is never read where kernels read storage.
Status DeviceMesh::fill_texels(const Uploader& uploader, std::span<const std::byte> bytes, const char* purpose,
                               VkFormat format, Buffer& buffer, VkBufferView& view) {
  const MemoryKind kind = use_texels ? MemoryKind::kTexels : MemoryKind::kDevice;
  const VkBuffer before = buffer.handle;
  if (Status status = fill(uploader, bytes, kind, purpose, buffer); !status.ok()) return status;
  if (view != VK_NULL_HANDLE && buffer.handle == before) return {};
  if (use_texels) return create_view(buffer, format, view);
  Result<Buffer> unused = arena_.create_buffer(16, MemoryKind::kDevice, "an unused texel buffer");
  if (!unused.ok()) return unused.error();
  return create_view(unused.value(), format, view);
}

Status DeviceMesh::create_view(const Buffer& buffer, VkFormat format, VkBufferView& view) {
  Result<VkBufferView> created = arena_.create_texel_view(buffer, format);
  if (!created.ok()) return created.error();
  view = created.value();
  return {};
}

Status DeviceMesh::add_links() {
  if (has_links_) return {};
  if (Status status = finish_uploads(); !status.ok()) return status;
  Uploads uploads(*context_);
  // A failure before the triangles are overwritten leaves the mesh unchanged, without links.
  if (Status status = upload_all_links(through(uploads)); !status.ok()) return status;
  if (Status status = uploads.finish(); !status.ok()) return status;
  intact = false;  // until the triangles have their spreads
  Uploads again(*context_);
  if (Status status = upload_triangles(through(again), links().spreads); !status.ok()) return status;
  if (Status there = again.finish(); !there.ok()) return there;
  has_links_ = intact = true;
  return {};
}

Status DeviceMesh::upload_all_links(const Uploader& uploader) {
  if (Status status = upload_links(uploader); !status.ok()) return status;
  if (Status status = upload_clusters(uploader); !status.ok()) return status;
  return upload_open_edges(uploader);
}

Status DeviceMesh::upload_links(const Uploader& uploader) {
  const MeshLinks& links = this->links();
  static_assert(sizeof(gpu::TriangleLinks) == 2 * sizeof(Texel));
  has_untrusted = has_untrusted || std::ranges::any_of(links.links, [](const gpu::TriangleLinks& l) {
                    return (l.flags & (gpu::kLinkWhole | gpu::kLinkBothSides)) != 0u;
                  });
  Status status = fill_texels(uploader, std::as_bytes(std::span(links.links)), "links of triangles to neighbours",
                              VK_FORMAT_R32G32B32A32_UINT, triangle_links, link_texels);
  if (!status.ok()) return status;
  return fill_texels(uploader, std::as_bytes(std::span(links.corners)), "spokes to vertices", kFloats, corner_cones,
                     corner_texels);
}

Status DeviceMesh::upload_clusters(const Uploader& uploader) {
  static_assert(sizeof(gpu::Cluster) == 6 * sizeof(Texel));  // kTexelsPerCluster
  static_assert(6 * kMostClusters <= 65536);                 // the least maxTexelBufferElements that Vulkan allows
  const std::vector<gpu::Cluster> made = make_clusters(source_.bvh(), {lower, longest}, source_.view().flags,
                                                       kTrianglesOfCluster, kMostClusters, context_->host_threads);
  cluster_count = static_cast<std::uint32_t>(made.size());
  most_in_cluster = std::ranges::max_element(made, {}, &gpu::Cluster::count)->count;
  cluster_radius = median_radius(made);
  const VkBuffer before = clusters.handle;
  Status status =
      fill(uploader, std::as_bytes(std::span(made)), MemoryKind::kTexels, "clusters of triangles", clusters);
  if (!status.ok() || (cluster_texels != VK_NULL_HANDLE && clusters.handle == before)) return status;
  return create_view(clusters, kFloats, cluster_texels);
}

Status DeviceMesh::upload_open_edges(const Uploader& uploader) {
  const MeshView mesh = source_.view();
  OpenEdges edges;
  if (!mesh.closed) edges = find_open_edges(mesh, {lower, longest}, gpu::kMostOpenEdges);
  open_edge_count = edges.count;
  if (edges.listed.empty()) edges.listed.resize(1);
  return fill(uploader, std::as_bytes(std::span(edges.listed)), MemoryKind::kDevice, "open edges", open_edges);
}

}  // namespace medial_vk
