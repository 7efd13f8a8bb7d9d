#include "support/extraction.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "cpu_reference/certificate.h"
#include "cpu_reference/queries.h"
#include "medial_vk/prepare.h"
#include "reference_bridge/reference_bridge.h"
#include "support/indexed.h"

namespace medial_vk::test {
namespace {

template <class T>
T value_or_throw(Result<T> result) {
  if (!result.ok()) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

// The properties of every extraction.
void check(const Extraction& extraction) {
  for (const ExtractionCounters::Level& level : extraction.measurements.counters.levels)
    if (level.kept > level.visited) throw std::runtime_error("more cells are kept than were visited");
  const auto share_a_voxel = [](const MedialSphere& a, const MedialSphere& b) { return a.voxel == b.voxel; };
  if (std::ranges::adjacent_find(extraction.spheres, share_a_voxel) != extraction.spheres.end())
    throw std::runtime_error("two points share a voxel");
}

}  // namespace

PreparedMesh prepare(Mesh mesh) { return value_or_throw(prepare_mesh(std::move(mesh))); }

Context make_context(bool validation) {
  return value_or_throw(Context::create({.device = "", .validation = validation, .cache_folder = "/dev/null"}));
}

CertifiedExtraction extract_on_device(Context& context, const PreparedMesh& mesh, const ExtractionOptions& options) {
  return extract_on_device(context, indexed(mesh), options);
}

CertifiedExtraction extract_on_device(Context& context, const IndexedMesh& mesh, const ExtractionOptions& options) {
  ExtractionOptions on_one_thread = options;
  on_one_thread.threads = 1;
  CertifiedExtraction result = value_or_throw(extract_and_certify(mesh, on_one_thread, context));
  check(result.extraction);
  return result;
}

reference::Result extract_with_reference(const PreparedMesh& mesh, const ExtractionOptions& options) {
  return reference::extract(medial_vk::to_reference(mesh), medial_vk::to_reference(options));
}

testing::AssertionResult passes_certificate(const PreparedMesh& mesh, const Extraction& extraction,
                                            const ExtractionOptions& options) {
  return passes_certificate(medial_vk::to_reference(mesh), extraction, options);
}

testing::AssertionResult passes_certificate(const reference::Mesh& mesh, const Extraction& extraction,
                                            const ExtractionOptions& options) {
  const VoxelGrid& grid = extraction.grid;
  const double longest_side = reference::Tree(mesh).longest_side();
  const reference::Certificate certificate =
      reference::check(mesh, medial_vk::to_reference(grid, extraction.spheres), options.epsilon * grid.voxel_size,
                       options.object_angle, options.radius * longest_side);
  if (certificate.passed()) return testing::AssertionSuccess();
  testing::AssertionResult failure = testing::AssertionFailure();
  for (const reference::CertificateLine& line : certificate.lines) {
    if (line.failed == 0) continue;
    failure << line.condition << ": " << line.failed << " of " << line.tested << " fail, worst " << line.worst << " "
            << line.unit << "; " << line.first_failure << "\n";
  }
  return failure;
}

std::string describe(const CertifiedExtraction& result) {
  const ExtractionCounters& c = result.extraction.measurements.counters;
  std::ostringstream out;
  out << "found " << c.found << ", undecided " << c.undecided << ", rejected " << result.certificate.rejected
      << ", proved empty " << c.proved_empty << ", queries " << c.queries << ", retries " << c.retries << "; levels";
  for (const ExtractionCounters::Level& level : c.levels) {
    out << " [" << level.cell_size << ": " << level.visited << " visited, " << level.kept << " kept, " << level.contacts
        << " contacts, " << level.found << " found]";
  }
  out << "; seconds";
  for (const StageTime& t : result.extraction.measurements.host_times) out << " " << t.stage << " " << t.seconds;
  for (const StageTime& t : result.extraction.measurements.device_times)
    out << ", device " << t.stage << " " << t.seconds;
  return out.str();
}

SphereByVoxel spheres_by_voxel(const Extraction& extraction) {
  SphereByVoxel out;
  for (std::size_t i = 0; i < extraction.spheres.size(); ++i) {
    const std::array<std::uint32_t, 3>& v = extraction.spheres[i].voxel;
    out[{static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])}] = i;
  }
  return out;
}

Voxel voxel_of(const VoxelGrid& grid, const Eigen::Vector3d& p) {
  const Eigen::Vector3d scaled = ((p - to_eigen(grid.origin)) / grid.voxel_size).array().floor();
  return {static_cast<int>(scaled.x()), static_cast<int>(scaled.y()), static_cast<int>(scaled.z())};
}

double depth_in_voxel(const VoxelGrid& grid, const Eigen::Vector3d& p) {
  const Eigen::Array3d scaled = (p - to_eigen(grid.origin)).array() / grid.voxel_size;
  const Eigen::Array3d inside = scaled - scaled.floor();
  return inside.min(1 - inside).minCoeff();
}

}  // namespace medial_vk::test
