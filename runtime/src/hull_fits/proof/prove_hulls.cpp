#include <cmath>
#include <cstddef>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "hull_fits/proof/hull_prover.h"
#include "medial_vk/hull_proofs.h"

namespace medial_vk {
namespace {

constexpr double kFarthest = 1e18;  // squares of what is nearer stay far from the ends of double
constexpr std::size_t kMostProved = std::size_t{1} << 20;

Status check_numbers(std::span<const BallHull> hulls) {
  if (hulls.size() > kMostProved) {
    return Error{ErrorCode::kUsage, format_text("`hulls` has {} hulls, more than {}", hulls.size(), kMostProved)};
  }
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    if (hulls[i].count < 1 || hulls[i].count > 3) {
      return Error{ErrorCode::kUsage, format_text("hull {} of `hulls` has {} balls, not 1 to 3", i, hulls[i].count)};
    }
    for (const Ball& ball : hulls[i].balls()) {
      bool is_good = ball.radius >= 0 && ball.radius <= kFarthest;
      for (const double x : ball.centre) is_good = is_good && std::fabs(x) <= kFarthest;
      if (is_good) continue;
      return Error{
          ErrorCode::kUsage,
          format_text("hull {} of `hulls` is not finite, has a negative radius or is beyond {:g}", i, kFarthest)};
    }
  }
  return {};
}

}  // namespace

Result<HullProof> prove_hulls(const IndexedMesh& mesh, std::span<const BallHull> hulls, const ProofOptions& options,
                              const std::stop_token& stop) {
  if (Status status = check_numbers(hulls); !status) return status.error();
  const Threads threads(options.threads, [&stop] { return !stop.stop_requested(); });
  return catch_out_of_memory("proving a set of hulls", [&]() -> Result<HullProof> {
    const Result<Solid> solid = Solid::build(mesh);
    if (!solid) return solid.error();
    try {
      return prove_hulls(solid.value(), hulls, threads);
    } catch (const Stopped&) {
      return Error{ErrorCode::kInterrupted, "interrupted"};
    }
  });
}

}  // namespace medial_vk
