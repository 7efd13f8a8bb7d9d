#include "support/solids/mutation_check.h"
#include "support/indexed.h"

#include <fmt/format.h>

#include <set>

#include "medial_vk/prepare.h"
#include "support/extraction.h"
#include "support/solids/mutations.h"

namespace medial_vk::test {
namespace {

constexpr double kAngleMargin = 0.05;  // near the threshold the two may differ (theory.md, "What undecided means")
// The device's statements concern the mesh with vertices in float; balls smaller than this share of the longest side
// are within its rounding (theory.md, "Rounding": 8 times 2e-6).
constexpr double kLeastRadius = 1.6e-5;

// All voxels that one side fills or leaves undecided. All others are proved empty.
class Answers {
 public:
  void add(const Voxel& v) { voxels_.insert(v); }
  /// True if this voxel or one beside it is in the set. A point is within epsilon of the medial surface, which may pass
  /// on the other side of a face.
  bool any_around(const Voxel& v) const {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (voxels_.contains({v[0] + x, v[1] + y, v[2] + z})) return true;
    return false;
  }

 private:
  std::set<Voxel> voxels_;
};

Voxel to_voxel(const Eigen::Vector3i& v) { return {v.x(), v.y(), v.z()}; }
Voxel to_voxel(const std::array<std::uint32_t, 3>& v) {
  return {static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])};
}

Answers answers_of(const Extraction& extraction) {
  Answers out;
  for (const MedialSphere& s : extraction.spheres) out.add(to_voxel(s.voxel));
  for (const UndecidedVoxel& u : extraction.undecided) out.add(to_voxel(u.voxel));
  return out;
}

Answers answers_of(const reference::Result& result) {
  Answers out;
  for (const reference::Sphere& s : result.spheres) out.add(to_voxel(s.voxel));
  for (const reference::Undecided& u : result.undecided_voxels) out.add(to_voxel(u.voxel));
  return out;
}

void compare(const Extraction& device, const reference::Result& reference, const ExtractionOptions& options,
             std::vector<std::string>& faults) {
  const double threshold = options.object_angle;
  const double least_radius = kLeastRadius * options.resolution * reference.voxel_size;
  const Answers of_device = answers_of(device), of_reference = answers_of(reference);
  for (const MedialSphere& s : device.spheres) {
    const Voxel v = to_voxel(s.voxel);
    if (s.object_angle < threshold + kAngleMargin || of_reference.any_around(v)) continue;
    faults.push_back(fmt::format(
        "the device has a point in voxel {} {} {}, the reference has proved all around it empty", v[0], v[1], v[2]));
  }
  for (const reference::Sphere& s : reference.spheres) {
    const Voxel v = to_voxel(s.voxel);
    if (s.radius < least_radius || s.object_angle < threshold + kAngleMargin || of_device.any_around(v)) continue;
    faults.push_back(fmt::format(
        "the reference has a point in voxel {} {} {}, the device has proved all around it empty", v[0], v[1], v[2]));
  }
}

}  // namespace

MutationOutcome check_mutation(Context& context, std::uint64_t seed) {
  MutationOutcome out;
  Mutation mutation = make_mutation(seed);
  out.description = fmt::format("seed {}: {}", seed, mutation.description);
  Result<PreparedMesh> prepared = prepare_mesh(std::move(mutation.mesh));
  out.rejected = !prepared.ok();
  if (out.rejected) {
    const Error& error = prepared.error();
    if (error.code != ErrorCode::kInvalidMesh || error.message.empty())
      out.faults.push_back("refused: " + error.message);
    return out;
  }
  const PreparedMesh& mesh = prepared.value();
  ExtractionOptions options;
  options.resolution = 14;
  options.extra_levels = 2;
  options.threads = 1;
  const Result<CertifiedExtraction> extracted = extract_and_certify(indexed(mesh), options, context);
  if (!extracted.ok()) {
    out.faults.push_back("extraction: " + extracted.error().message);
    return out;
  }
  const Extraction& extraction = extracted.value().extraction;
  out.closed = mesh.report.closed;
  out.points = extraction.spheres.size();
  out.undecided = extraction.undecided.size();
  const testing::AssertionResult certified = passes_certificate(mesh, extraction, options);
  if (!certified) out.faults.emplace_back(certified.message());
  if (out.closed) compare(extraction, extract_with_reference(mesh, options), options, out.faults);
  return out;
}

}  // namespace medial_vk::test
