// The reader of tables of poses, on any bytes: rigid motions, or a clear message.
#include "pose_files/read_poses.h"

#include <algorithm>
#include <cmath>

#include "fuzz/require.h"

namespace medial_vk::fuzz {
namespace {

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool is_finite(const Point& p) {
  return std::ranges::all_of(p, [](double x) { return std::isfinite(x); });
}

void require_rigid(const Pose& pose) {
  require(is_finite(pose.shift), "shifts are finite");
  for (std::size_t i = 0; i < 3; ++i) {
    require(is_finite(pose.rotation[i]), "rotations are finite");
    for (std::size_t j = 0; j < 3; ++j) {
      const double product = dot(pose.rotation[i], pose.rotation[j]);
      require(std::fabs(product - (i == j ? 1 : 0)) <= 1e-9, "rows are perpendicular unit vectors");
    }
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string_view text = fuzz::as_text(data, size);
  const Result<std::vector<Pose>> poses = parse_poses(text, fuzz::kName);
  if (!poses.ok()) {
    fuzz::require_clear(poses.error(), ErrorCode::kInvalidMesh);
    fuzz::require(poses.error().message.starts_with(fuzz::kName + ":"), "a message begins with the name of the file");
    return 0;
  }
  fuzz::require(!poses.value().empty(), "there is a pose");
  fuzz::require(poses.value().size() <= text.size() / 6, "poses take bytes");
  for (const Pose& pose : poses.value()) fuzz::require_rigid(pose);
  return 0;
}
