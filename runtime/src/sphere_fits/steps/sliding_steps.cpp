#include "base/point_ops.h"
#include "sphere_fits/steps/ball_steps.h"
#include "sphere_fits/steps/maximal_ball.h"
#include "sphere_fits/steps/slide.h"

namespace medial_vk {
namespace {

class SlidingSteps : public BallSteps {
 public:
  explicit SlidingSteps(const Solid& solid) : solid_(solid), slider_(solid) {}

  void came(const DynamicUnion& /*balls*/, std::uint32_t /*slot*/) override {}

  double error(const DynamicUnion& balls) const override { return 1 - balls.volume() / solid_.volume(); }

 private:
  Result<std::optional<Ball>> propose(DynamicUnion& balls, std::uint32_t slot, double step) override {
    const Ball& ball = balls.ball(slot);
    const Result<Exposure> exposure = balls.exposure_at(slot, ball);
    if (!exposure.ok()) return exposure.error();
    exposure_ = exposure.value();
    if (slot >= touched_.size()) touched_.resize(slot + 1);
    std::vector<std::uint32_t>& touched = touched_[slot];
    const Point move = slider_.direction(ball, exposure_, step, touched);
    if (move == Point{}) return std::optional<Ball>();
    return std::optional(maximal_ball(solid_, ball.centre + move, touched));
  }

  /// The volume of the union changes by the integral of vector . d + area e along the way, here by the trapezoidal
  /// rule: the cells of other balls need not be computed.
  Result<double> try_move(DynamicUnion& balls, std::uint32_t slot, const Ball& to) override {
    if (!(to.radius > 0) || !stays_inside(solid_, to)) return 0.0;
    const Result<Exposure> there = balls.exposure_at(slot, to);
    if (!there.ok()) return there.error();
    const Ball& from = balls.ball(slot);
    const double gain = 0.5 * (dot(exposure_.vector + there.value().vector, to.centre - from.centre) +
                               (exposure_.area + there.value().area) * (to.radius - from.radius));
    if (!(gain > 0)) return 0.0;
    if (Status status = balls.shift(slot, to); !status.ok()) return status.error();
    return gain;
  }

  const Solid& solid_;
  Slider slider_;
  Exposure exposure_;                                // of the ball whose move propose() returned
  std::vector<std::vector<std::uint32_t>> touched_;  // triangles, by slot
};

}  // namespace

std::unique_ptr<BallSteps> sliding_steps(const Solid& solid) { return std::make_unique<SlidingSteps>(solid); }

}  // namespace medial_vk
