#include "medial_vk/indexed_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/host_memory.h"
#include "indexed_mesh/indexed_mesh_impl.h"
#include "tree_types.h"

namespace medial_vk {
namespace {

/// The report of a mesh without an inspection.
MeshReport report_of(const MeshView& mesh) {
  MeshReport report;
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  report.closed = mesh.closed;
  report.trusted_triangles = static_cast<std::uint64_t>(
      std::ranges::count_if(mesh.flags, [](std::uint8_t f) { return (f & kTrustedNormal) != 0; }));
  return report;
}

Status check_flags(std::size_t flags, std::size_t triangles) {
  if (flags == 0 || flags == triangles) return {};
  return Error{ErrorCode::kInvalidMesh,
               "there are " + std::to_string(flags) + " flags for " + std::to_string(triangles) + " triangles"};
}

void take_box(const Bvh& bvh, MeshReport& report) {
  report.lower = bvh.nodes().front().box.lower;
  report.upper = bvh.nodes().front().box.upper;
}

Status check_moved(const PreparedMesh& mesh, std::span<const Point> vertices, std::span<const std::uint8_t> flags) {
  if (vertices.size() != mesh.mesh.vertices.size()) {
    return Error{ErrorCode::kInvalidMesh, "the moved mesh has " + std::to_string(vertices.size()) +
                                              " vertices, the mesh has " + std::to_string(mesh.mesh.vertices.size())};
  }
  return check_flags(flags.size(), mesh.mesh.triangles.size());
}

// Rounding on the device is in proportion to the box: at ten times the longest side it takes 21 times as much of the
// mesh as without a margin.
constexpr double kMostMargin = 10;

// (sqrt(5) - 1) / 86. It is irrational, so that no plane at a rational share of the box of the mesh lies in a face of
// voxels (docs/theory.md, "The complement"). With the usual margin, faces of a box of which a side is all or half of
// the longest are at least 0.04 of a voxel away from those at the resolutions that are usual.
constexpr double kShift = 0.61803398874989485 / 43;

Status check_side(const SideOptions& options, MeshSide present, double longest_side) {
  if (present != MeshSide::kInside) {
    return Error{ErrorCode::kUsage, "the mesh is that of the outside already: its side cannot be chosen again"};
  }
  if (options.margin >= 0 && options.margin <= kMostMargin * longest_side) return {};
  return Error{ErrorCode::kUsage, "`margin` must be above 0 and at most 10 times the longest side of the mesh"};
}

// Beside an open mesh, points outside lie behind triangles, too: of these no normal proves anything about the outside
// (docs/theory.md, "The complement").
void drop_trust_of_open(PreparedMesh& mesh) {
  if (mesh.report.closed) return;
  for (std::uint8_t& flags : mesh.flags) {
    if ((flags & kTrustedNormal) != 0) flags = kUncrossed;
  }
}

}  // namespace

double IndexedMesh::Impl::room() const {
  if (!margin) return 0;
  return *margin > 0 ? *margin : 0.5 * prepared.report.longest_side();
}

double IndexedMesh::Impl::shift() const { return margin ? kShift * prepared.report.longest_side() : 0; }

IndexedMesh::IndexedMesh(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

Result<IndexedMesh> IndexedMesh::build(PreparedMesh mesh, const IndexOptions& options) {
  return catch_out_of_memory("indexing a mesh", [&]() -> Result<IndexedMesh> {
    if (Status status = check_flags(mesh.flags.size(), mesh.mesh.triangles.size()); !status.ok()) return status.error();
    Result<Bvh> bvh = Bvh::build(mesh.view(), {.leaf_size = gpu::kMostLeafTriangles, .threads = options.threads});
    if (!bvh.ok()) return bvh.error();
    take_box(bvh.value(), mesh.report);  // a caller may have filled in the mesh
    MeshLinks links = make_mesh_links(mesh.view(), bvh.value().order(), options.threads);
    return IndexedMesh(std::make_shared<const Impl>(
        Impl{std::move(mesh), std::move(bvh).value(), std::move(links), MeshSide::kInside, {}}));
  });
}

Result<IndexedMesh> IndexedMesh::build(const MeshView& mesh, const IndexOptions& options) {
  return catch_out_of_memory("indexing a mesh", [&]() -> Result<IndexedMesh> {
    PreparedMesh copy;
    copy.mesh.vertices.assign(mesh.vertices.begin(), mesh.vertices.end());
    copy.mesh.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    copy.flags.assign(mesh.flags.begin(), mesh.flags.end());
    copy.report = report_of(mesh);
    if (Status status = check_flags(mesh.flags.size(), mesh.triangles.size()); !status.ok()) return status.error();
    Result<Bvh> bvh = Bvh::build(copy.view(), {.leaf_size = gpu::kMostLeafTriangles, .threads = options.threads});
    if (!bvh.ok()) return bvh.error();
    take_box(bvh.value(), copy.report);
    MeshLinks links = make_mesh_links(copy.view(), bvh.value().order(), options.threads);
    return IndexedMesh(std::make_shared<const Impl>(
        Impl{std::move(copy), std::move(bvh).value(), std::move(links), MeshSide::kInside, {}}));
  });
}

const PreparedMesh& IndexedMesh::prepared() const { return impl_->prepared; }
MeshView IndexedMesh::view() const { return impl_->prepared.view(); }
const Bvh& IndexedMesh::bvh() const { return impl_->bvh; }

MeshSide IndexedMesh::side() const { return impl_->side; }

double IndexedMesh::longest_side() const {
  return impl_->prepared.report.longest_side() + 2 * impl_->room() + impl_->shift();
}

double IndexedMesh::margin() const { return impl_->room(); }

Point IndexedMesh::region_lower() const {
  const Point& lower = impl_->prepared.report.lower;
  const double room = margin() + impl_->shift();
  return {lower[0] - room, lower[1] - room, lower[2] - room};
}

Point IndexedMesh::region_upper() const {
  const Point& upper = impl_->prepared.report.upper;
  const double room = margin();
  return {upper[0] + room, upper[1] + room, upper[2] + room};
}

Result<IndexedMesh> IndexedMesh::on_side(const SideOptions& options) const {
  const double longest = impl_->prepared.report.longest_side();
  if (Status status = check_side(options, side(), longest); !status.ok()) return status.error();
  return catch_out_of_memory("turning a mesh over", [&]() -> Result<IndexedMesh> {
    auto turned = std::make_shared<Impl>(*impl_);
    turned->side = options.side;
    turned->margin = options.margin;
    if (options.side == MeshSide::kInside) return IndexedMesh(std::move(turned));
    for (Triangle& t : turned->prepared.mesh.triangles) std::swap(t[1], t[2]);
    drop_trust_of_open(turned->prepared);
    const MeshView view = turned->prepared.view();
    Result<Bvh> bvh = Bvh::build(view, {.leaf_size = gpu::kMostLeafTriangles, .threads = options.threads});
    if (!bvh.ok()) return bvh.error();
    turned->bvh = std::move(bvh).value();
    turned->links = make_mesh_links(view, turned->bvh.order(), options.threads);
    return IndexedMesh(std::move(turned));
  });
}

Status IndexedMesh::move_vertices(std::span<const Point> vertices, const MoveOptions& options) {
  const std::span<const std::uint8_t> flags = options.flags;
  if (Status status = check_moved(impl_->prepared, vertices, flags); !status.ok()) return status;
  return catch_out_of_memory("moving a mesh", [&]() -> Status {
    // A copy, since others may share the data, and an error must leave them unchanged.
    auto moved = std::make_shared<Impl>(*impl_);
    moved->prepared.mesh.vertices.assign(vertices.begin(), vertices.end());
    if (!flags.empty()) moved->prepared.flags.assign(flags.begin(), flags.end());
    if (moved->side == MeshSide::kOutside) drop_trust_of_open(moved->prepared);
    const MeshView view = moved->prepared.view();
    if (Status status = moved->bvh.refit(view, {.threads = options.threads}); !status.ok()) return status;
    take_box(moved->bvh, moved->prepared.report);
    moved->links = make_mesh_links(view, moved->bvh.order(), options.threads);
    impl_ = std::move(moved);
    return {};
  });
}

}  // namespace medial_vk
