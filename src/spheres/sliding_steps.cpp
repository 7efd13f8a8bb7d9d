#include <algorithm>
#include "mesh/point_ops.h"
#include "spheres/ball_steps.h"
#include "spheres/maximal_ball.h"

#include "spheres/slide.h"

namespace medial_vk {
namespace {

class SlidingSteps : public BallSteps {
 public:
  explicit SlidingSteps(const Solid& solid) : solid_(solid), slider_(solid) {}

  Result<double> take(DynamicUnion& balls, std::uint32_t place, double& step) override {
    const Ball ball = balls.ball(place);
    if (step < kShortestStep * ball.radius) return 0.0;
    const Point move = slider_.direction(ball, balls.exposure(place), step);
    if (move == Point{}) {
      step /= 4;
      return 0.0;
    }
    const Ball moved = maximal_ball(solid_, ball.centre + move);
    if (!(moved.radius > 0) || !stays_inside(solid_, moved)) {
      step /= 2;
      return 0.0;
    }
    const double before = balls.volume();
    if (Status status = balls.move(place, moved); !status.ok()) return status.error();
    const double gain = balls.volume() - before;
    if (!(gain > 0)) {
      balls.undo();
      step /= 2;
      return 0.0;
    }
    step = std::min(1.3 * step, kLongestStep * moved.radius);
    return gain;
  }

  void came(const DynamicUnion& /*balls*/, std::uint32_t /*place*/) override {}

  double error(const DynamicUnion& balls) const override { return 1 - balls.volume() / solid_.volume(); }

 private:
  const Solid& solid_;
  Slider slider_;
};

}  // namespace

std::unique_ptr<BallSteps> sliding_steps(const Solid& solid) { return std::make_unique<SlidingSteps>(solid); }

}  // namespace medial_vk
