#include <algorithm>
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
  std::optional<Ball> propose(const DynamicUnion& balls, std::uint32_t slot, double step) override {
    const Ball& ball = balls.ball(slot);
    if (slot >= touched_.size()) touched_.resize(slot + 1);
    const Point move = slider_.direction(ball, balls.exposure(slot), step, touched_[slot]);
    return move == Point{} ? std::nullopt : std::optional(maximal_ball(solid_, ball.centre + move));
  }

  Result<double> try_move(DynamicUnion& balls, std::uint32_t slot, const Ball& to) override {
    if (!(to.radius > 0) || !stays_inside(solid_, to)) return 0.0;
    const double before = balls.volume();
    if (Status status = balls.move(slot, to); !status.ok()) return status.error();
    const double gain = balls.volume() - before;
    if (gain > 0) return gain;
    balls.undo();
    return 0.0;
  }

  const Solid& solid_;
  Slider slider_;
  std::vector<std::vector<std::uint32_t>> touched_;  // triangles, by slot
};

}  // namespace

std::unique_ptr<BallSteps> sliding_steps(const Solid& solid) { return std::make_unique<SlidingSteps>(solid); }

}  // namespace medial_vk
