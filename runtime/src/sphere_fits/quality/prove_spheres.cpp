#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "medial_vk/sphere_proofs.h"
#include "sphere_fits/quality/envelope_distance.h"
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

Result<Bounds> measure_gap(const IndexedMesh& mesh, std::span<const Ball> balls, const ProofOptions& options,
                           const std::stop_token& stop) {
  if (Status status = check_numbers(balls, "`balls`"); !status) return status.error();
  return catch_out_of_memory("measuring the gap of a set of balls", [&]() -> Result<Bounds> {
    std::vector<Ball> present;
    std::ranges::copy_if(balls, std::back_inserter(present), [](const Ball& ball) { return ball.radius > 0; });
    if (present.empty()) return Error{ErrorCode::kUsage, "`balls` has no ball with a positive radius"};
    Result<Solid> solid = Solid::build(mesh);
    if (!solid) return solid.error();
    EnvelopeOptions measured;
    measured.threads = {options.threads, [&stop] { return !stop.stop_requested(); }};
    return measure_greatest_gap(solid.value(), present, measured);
  });
}

Status measure_depths(const IndexedMesh& mesh, std::span<const Point> points, std::span<double> depths,
                      const ProofOptions& options, const std::stop_token& stop) {
  if (points.size() != depths.size()) {
    return Error{ErrorCode::kUsage,
                 format_text("`depths` has {} elements for {} `points`", depths.size(), points.size())};
  }
  const Threads threads(options.threads, [&stop] { return !stop.stop_requested(); });
  return catch_out_of_memory("measuring depths in a solid", [&]() -> Status {
    std::vector<Ball> balls;
    for (const Point& point : points) balls.push_back({point, 0});
    if (Status status = check_numbers(balls, "`points`"); !status) return status;
    const Result<Solid> solid = Solid::build(mesh);
    if (!solid) return solid.error();
    try {
      for_all(points.size(), 16, threads, [&](std::size_t i) {
        const double distance = solid.value().distance(points[i]);
        depths[i] = (solid.value().contains(points[i]) ? distance : -distance) - solid.value().rounding();
      });
    } catch (const Stopped&) {
      return Error{ErrorCode::kInterrupted, "interrupted"};
    }
    return {};
  });
}

}  // namespace medial_vk
