#include "reference_bridge/check_hulls.h"

#include <utility>

#include "cpu_reference/hull_certificate.h"
#include "reference_bridge/reference_bridge.h"

namespace medial_vk {

CheckReport check_hulls_inside(const PreparedMesh& mesh, std::span<const BallHull> hulls,
                               const std::function<void(double)>& progress) {
  std::vector<reference::Hull> copies;
  copies.reserve(hulls.size());
  for (const BallHull& hull : hulls) {
    reference::Hull& copy = copies.emplace_back();
    for (const Ball& ball : hull.balls()) copy.balls.push_back({to_eigen(ball.centre), ball.radius});
  }
  reference::Certificate certificate = reference::check_hulls(to_reference(mesh), copies, [&](std::size_t i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(copies.size()));
  });
  CheckReport report;
  report.lines.reserve(certificate.lines.size());
  for (reference::CertificateLine& line : certificate.lines) {
    report.lines.push_back({std::move(line.condition), line.tested, line.failed, line.worst, std::move(line.unit),
                            std::move(line.first_failure)});
  }
  return report;
}

}  // namespace medial_vk
