#include <cmath>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "medial_vk/sphere_proofs.h"
#include "sphere_fits/quality/sphere_certificate.h"

namespace medial_vk {
namespace {

constexpr double kFarthest = 1e18;  // squares and volumes of what is nearer stay far from the ends of double
constexpr std::size_t kMostProved = std::size_t{1} << 24;

Status check_numbers(std::span<const Ball> balls, const char* set) {
  if (balls.size() > kMostProved) {
    return Error{ErrorCode::kUsage, format_text("{} has {} balls, more than {}", set, balls.size(), kMostProved)};
  }
  for (std::size_t i = 0; i < balls.size(); ++i) {
    bool is_good = balls[i].radius >= 0 && balls[i].radius <= kFarthest;
    for (const double x : balls[i].centre) is_good = is_good && std::fabs(x) <= kFarthest;
    if (is_good) continue;
    return Error{ErrorCode::kUsage, format_text("ball {} of {} is not finite, has a negative radius or is beyond {:g}",
                                                i, set, kFarthest)};
  }
  return {};
}

/// The empty set covers nothing.
CoverProof without_balls(const Solid& solid) {
  CoverProof proof;
  proof.closed = solid.mesh().report.closed;
  proof.triangles = proof.uncovered = solid.mesh().mesh.triangles.size();
  proof.first_uncovered = solid.mesh().mesh.vertices[solid.mesh().mesh.triangles.front()[0]];
  return proof;
}

Result<SphereProofs> prove(const IndexedMesh& mesh, std::span<const Ball> inside, std::span<const Ball> cover,
                           const Threads& threads) {
  Result<Solid> built = Solid::build(mesh);
  if (!built) return built.error();
  const Solid& solid = built.value();
  SphereProofs proofs;
  proofs.inside = prove_inside(solid, inside, threads);
  if (cover.empty()) {
    proofs.cover = without_balls(solid);
    return proofs;
  }
  Result<CoverProof> covers = prove_cover(solid, cover, threads);
  if (!covers) return covers.error();
  proofs.cover = covers.value();
  return proofs;
}

}  // namespace

Result<SphereProofs> prove_spheres(const IndexedMesh& mesh, std::span<const Ball> inside, std::span<const Ball> cover,
                                   const ProofOptions& options, const std::stop_token& stop) {
  if (Status status = check_numbers(inside, "`inside`"); !status) return status.error();
  if (Status status = check_numbers(cover, "`cover`"); !status) return status.error();
  const Threads threads(options.threads, [&stop] { return !stop.stop_requested(); });
  return catch_out_of_memory("proving a set of balls", [&]() -> Result<SphereProofs> {
    try {
      return prove(mesh, inside, cover, threads);
    } catch (const Stopped&) {
      return Error{ErrorCode::kInterrupted, "interrupted"};
    }
  });
}

}  // namespace medial_vk
