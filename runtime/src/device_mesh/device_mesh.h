// A mesh on the device: float, scaled to the unit box, with the tree that finds its triangles.
#pragma once

#include <volk.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "device/internals.h"
#include "device_commands/memory.h"
#include "device_commands/uploads.h"
#include "device_mesh/unit_transform.h"
#include "indexed_mesh/mesh_links.h"
#include "medial_vk/bvh.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"
#include "tree_types.h"

namespace medial_vk {

/// The destination of the bytes for a buffer of the device: the buffer itself, or memory from which a recorded job
/// copies them.
using Uploader = std::function<Status(const Buffer& buffer, std::span<const std::byte> bytes)>;

/// Positions on the device are (x - lower) / longest: the box of the search, which is that of the mesh or larger
/// (IndexedMesh::on_side()), becomes a box with longest side 1 at the origin.
/// Kernels address triangles by leaf position.
struct DeviceMesh {
  DeviceMesh(DeviceMesh&&) noexcept = default;
  DeviceMesh& operator=(DeviceMesh&&) = delete;  // it would have to wait for pending uploads
  /// Triangles in a leaf of the device's tree, at most.
  /// Two limits allow this number: leaf positions are stored as floats in the tree's texels, exact up to 2^24; and one
  /// lane of 256 tests its share of all triangles (resolve_closest_points.comp) in 31,250 of lavapipe's 65,535
  /// iterations.
  static constexpr std::uint32_t kMostTriangles = 8'000'000;

  /// Error: kOutOfMemory if a mesh of that many triangles is too large for the device, or for the kernels.
  static Status check_size(std::size_t triangles, const VkPhysicalDeviceLimits& limits);

  /// Starts all uploads; finish_uploads() must precede the first use. With links: also the data of add_links(). Errors:
  /// kInvalidMesh (no extent), kOutOfMemory.
  static Result<DeviceMesh> create(ContextImpl& context, const IndexedMesh& mesh, bool with_links);
  /// Errors: kOutOfMemory, kInternal (device lost).
  Status finish_uploads();

  /// Follows the mesh of create() after IndexedMesh::move_vertices(): positions, unit box, tree, flags, and links if
  /// there are any, in the existing buffers. The device must be idle; commands recorded with global properties of the
  /// mesh (closed, open_edge_count and so on) must be recorded again. Errors: kUsage (another mesh: nothing changes),
  /// kInvalidMesh (no extent: not intact until an update succeeds), kOutOfMemory and kInternal (device lost): likewise.
  Status update(const IndexedMesh& moved);
  /// The same with an uploader of the caller: the device need not be idle if the upload is deferred.
  Status update(const IndexedMesh& moved, const Uploader& uploader);
  /// Bytes of all buffers that an update fills.
  VkDeviceSize update_bytes() const;

  /// Adds the data that the certified extraction reads besides triangles, unless it exists already: clusters of
  /// triangles, open edges, and for the dismissal by pairs edges and vertices. The device must be idle. Error:
  /// kOutOfMemory.
  Status add_links();
  bool has_links() const { return has_links_; }

  /// The mesh on the host.
  const IndexedMesh& source() const { return source_; }
  /// The range in which kernels bind `texels`, one of the buffers here that have a view, as storage.
  BufferRange storage_of(const Buffer& texels) const { return texels.storage_range(use_texels); }

  /// The nodes of the Bvh whose leaf order is `order`.
  const std::vector<BvhNode>& tree_nodes() const { return source_.bvh().nodes(); }

  /// Bytes of device memory held.
  VkDeviceSize bytes() const { return arena_.bytes(); }

  UnitTransform transform() const { return {lower, longest}; }
  Point to_unit(const Point& p) const { return transform()(p); }
  Point to_input(const std::array<float, 3>& p) const { return transform().inverse(p); }

  /// Four texels per triangle, by leaf position (shaders/shared/tree/closest_point.glsl).
  Buffer triangles;
  VkBufferView triangle_texels = VK_NULL_HANDLE;
  /// Boxes and moments, twelve texels per inner node (shaders/shared/tree/tree.glsl).
  Buffer tree;
  VkBufferView tree_texels = VK_NULL_HANDLE;
  /// Index into MeshView::triangles, one word per leaf position.
  Buffer triangle_info;
  /// gpu::TriangleLinks by leaf position, as two texels of integers, and caps of spokes by vertex
  /// (runtime/src/indexed_mesh/mesh_links.h); null until add_links().
  Buffer triangle_links;
  VkBufferView link_texels = VK_NULL_HANDLE;
  Buffer corner_cones;
  VkBufferView corner_texels = VK_NULL_HANDLE;
  /// gpu::Cluster, in leaf order (runtime/src/device_mesh/clusters.h); null until add_links(). Every device allows a
  /// view of this number.
  static constexpr std::uint32_t kMostClusters = 8192;
  Buffer clusters;
  VkBufferView cluster_texels = VK_NULL_HANDLE;
  /// gpu::OpenEdge; at least one element, which is unused if there are none; null until add_links().
  Buffer open_edges;
  /// False if a texel view would be too large for the device: kernels that read the mesh then run in their variant for
  /// storage buffers (storage_suffix()), and the views are of a buffer that is never read.
  bool use_texels = true;
  bool intact = true;  // false after a failed update: the device may hold parts of both meshes
  bool closed = false;
  bool has_untrusted = true;  // the normal of some triangle proves nothing
  MeshSide side = MeshSide::kInside;
  std::uint32_t triangle_count = 0;
  std::uint32_t node_count = 0;  // inner nodes of the tree
  std::uint32_t cluster_count = 0, most_in_cluster = 0;
  std::uint32_t open_edge_count = 0;  // of all, listed or not (gpu::kMostOpenEdges)
  float cluster_radius = 0;           // median, in the unit box
  Point lower = {0, 0, 0};            // of the box of the search, around all triangles, input units
  Point upper = {0, 0, 0};
  double longest = 0;                // longest side of that box
  std::vector<std::uint32_t> order;  // triangle_info on the host

 private:
  DeviceMesh(ContextImpl& context, const IndexedMesh& source) : context_(&context), source_(source), arena_(context) {}
  const MeshLinks& links() const;
  Status measure();
  Status upload_mesh(const Uploader& uploader);
  Status upload_triangles(const Uploader& uploader, std::span<const float> spreads);
  Status upload_all_links(const Uploader& uploader);
  Status upload_links(const Uploader& uploader);
  Status upload_open_edges(const Uploader& uploader);
  Status upload_clusters(const Uploader& uploader);
  Status fill(const Uploader& uploader, std::span<const std::byte> bytes, MemoryKind kind, const char* purpose,
              Buffer& buffer);
  Status fill_texels(const Uploader& uploader, std::span<const std::byte> bytes, const char* purpose, VkFormat format,
                     Buffer& buffer, VkBufferView& view);
  Status create_view(const Buffer& buffer, VkFormat format, VkBufferView& view);

  ContextImpl* context_;
  IndexedMesh source_;
  Arena arena_;
  std::unique_ptr<Uploads> uploads_;  // pending uploads into buffers of the arena, or null
  bool has_links_ = false;
};

}  // namespace medial_vk
