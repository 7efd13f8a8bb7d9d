#include "reference_bridge/reference_bridge.h"

#include <cmath>

namespace medial_vk {
namespace {

Eigen::Vector3d floats_to_eigen(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

template <class To>
Eigen::Vector3i to_eigen_integers(const To& v) {
  return {static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])};
}

Point to_point(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::array<float, 3> to_floats(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

std::array<std::uint32_t, 3> to_unsigned(const Eigen::Vector3i& v) {
  return {static_cast<std::uint32_t>(v.x()), static_cast<std::uint32_t>(v.y()), static_cast<std::uint32_t>(v.z())};
}

reference::Sphere to_reference(const MedialSphere& sphere) {
  reference::Sphere out;
  out.centre = to_eigen(sphere.centre);
  out.radius = sphere.radius;
  out.spoke_a = floats_to_eigen(sphere.spoke_a);
  out.spoke_b = floats_to_eigen(sphere.spoke_b);
  out.object_angle = static_cast<double>(sphere.object_angle);
  out.flux = static_cast<double>(sphere.flux);
  out.voxel = to_eigen_integers(sphere.voxel);
  return out;
}

MedialSphere from_reference(const reference::Sphere& sphere) {
  MedialSphere out;
  out.centre = to_point(sphere.centre);
  out.radius = sphere.radius;
  out.spoke_a = to_floats(sphere.spoke_a);
  out.spoke_b = to_floats(sphere.spoke_b);
  out.object_angle = static_cast<float>(sphere.object_angle);
  out.flux = static_cast<float>(sphere.flux);
  out.voxel = to_unsigned(sphere.voxel);
  return out;
}

UndecidedVoxel from_reference(const reference::Undecided& undecided) {
  UndecidedVoxel out;
  out.voxel = to_unsigned(undecided.voxel);
  out.kind = static_cast<UndecidedKind>(undecided.kind);
  out.width = static_cast<float>(undecided.width);
  return out;
}

}  // namespace

reference::Mesh to_reference(const PreparedMesh& mesh) {
  reference::Mesh out;
  out.vertices.reserve(mesh.mesh.vertices.size());
  for (const Point& vertex : mesh.mesh.vertices) out.vertices.push_back(to_eigen(vertex));
  out.triangles.reserve(mesh.mesh.triangles.size());
  for (const Triangle& triangle : mesh.mesh.triangles) out.triangles.push_back(to_eigen_integers(triangle));
  out.trusted.reserve(mesh.flags.size());
  for (const std::uint8_t flags : mesh.flags) out.trusted.push_back((flags & kTrustedNormal) != 0 ? 1 : 0);
  out.closed = mesh.report.closed;
  return out;
}

reference::Mesh to_reference(const IndexedMesh& mesh) {
  reference::Mesh out = to_reference(mesh.prepared());
  out.unbounded = mesh.side() == MeshSide::kOutside;
  out.room = mesh.margin();
  return out;
}

reference::Options to_reference(const ExtractionOptions& options) {
  reference::Options out;
  out.certified = options.mode == Mode::kCertified;
  out.resolution = static_cast<int>(options.resolution);
  out.object_angle = options.object_angle;
  out.radius = options.radius;
  out.deep_angle = options.deep_angle;
  out.epsilon = options.epsilon;
  out.extra_levels = static_cast<int>(options.extra_levels);
  out.narrow_features = options.thesis.narrow_features;
  for (std::size_t i = 0; i < out.samples.size(); ++i) out.samples[i] = static_cast<int>(options.thesis.samples[i]);
  return out;
}

reference::Result to_reference(const VoxelGrid& grid, const std::vector<MedialSphere>& spheres) {
  reference::Result out;
  out.grid_origin = to_eigen(grid.origin);
  out.voxel_size = grid.voxel_size;
  out.grid_size = to_eigen_integers(grid.size);
  out.spheres.reserve(spheres.size());
  for (const MedialSphere& sphere : spheres) out.spheres.push_back(to_reference(sphere));
  return out;
}

Extraction from_reference(const reference::Result& result) {
  Extraction out;
  out.grid = {to_point(result.grid_origin), result.voxel_size, to_unsigned(result.grid_size)};
  out.spheres.reserve(result.spheres.size());
  for (const reference::Sphere& sphere : result.spheres) out.spheres.push_back(from_reference(sphere));
  out.undecided.reserve(result.undecided_voxels.size());
  for (const reference::Undecided& undecided : result.undecided_voxels) {
    out.undecided.push_back(from_reference(undecided));
  }
  for (const reference::LevelCount& level : result.levels) {
    out.measurements.counters.levels.push_back(
        {level.cell_size, level.visited, level.kept, level.contacts, level.found, 0, 0});
  }
  out.measurements.counters.found = result.found;
  out.measurements.counters.undecided = result.undecided;
  out.measurements.counters.proved_empty = result.proved_empty;
  out.measurements.counters.queries = result.queries;
  return out;
}

}  // namespace medial_vk
