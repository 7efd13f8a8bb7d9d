#include "output/hull_files/hull_record.h"

#include <algorithm>

namespace medial_vk {

const char* name_of(HullKind kind) {
  switch (kind) {
    case HullKind::kBall:
      break;
    case HullKind::kCapsule:
      return "capsule";
    case HullKind::kCone:
      return "cone";
    case HullKind::kSlab:
      return "slab";
  }
  return "ball";
}

const char* name_of(HullChoice choice) {
  switch (choice) {
    case HullChoice::kBalls:
      break;
    case HullChoice::kCapsules:
      return "capsules";
    case HullChoice::kCones:
      return "cones";
    case HullChoice::kSlabs:
      return "slabs";
    case HullChoice::kMix:
      return "mix";
  }
  return "balls";
}

std::array<std::size_t, 4> kinds_of(std::span<const BallHull> hulls) {
  std::array<std::size_t, 4> kinds = {};
  for (const BallHull& hull : hulls) ++kinds[static_cast<std::size_t>(kind_of(hull))];
  return kinds;
}

std::size_t parameters_in(std::span<const BallHull> hulls) {
  std::size_t sum = 0;
  for (const BallHull& hull : hulls) sum += parameters_of(kind_of(hull));
  return sum;
}

std::optional<Bounds> uncovered_share(const HullRecord& record) {
  if (!record.fit.solid_volume || !(*record.fit.solid_volume > 0)) return std::nullopt;
  const double whole = *record.fit.solid_volume;
  return Bounds{std::max(0.0, 1 - record.fit.covered.upper / whole),
                std::clamp(1 - record.fit.covered.lower / whole, 0.0, 1.0)};
}

}  // namespace medial_vk
