#include "vertex_curvature/unknown_reasons.h"

#include <cmath>

#include "base/point_ops.h"

namespace medial_vk {

UnknownReasons::UnknownReasons(std::span<const Ball> balls, const BoundaryCurvature& curvature)
    : balls_(balls), curvature_(curvature), tree_(balls) {}

CurvatureState UnknownReasons::at(const Point& p) const {
  if (balls_.empty()) return CurvatureState::kFew;
  const std::uint32_t ball = tree_.nearest(p).ball;
  const auto& [first, second] = curvature_.balls[ball].tips;
  const Point towards = p - balls_[ball].centre;
  const bool is_second = dot(second.normal, towards) > dot(first.normal, towards);  // not if one is NaN
  switch (const CurvatureState state = is_second ? second.state : first.state) {
    case CurvatureState::kSeam:
    case CurvatureState::kFew:
    case CurvatureState::kNested:
    case CurvatureState::kFocal:
    case CurvatureState::kUncertain:
    case CurvatureState::kExposed:
      return state;
    default:
      return CurvatureState::kEdge;
  }
}

}  // namespace medial_vk
