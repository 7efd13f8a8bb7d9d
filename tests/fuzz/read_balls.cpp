// The reader of tables of balls, on any bytes: finite balls, or a clear message.
#include "ball_files/read_balls.h"

#include <cmath>

#include "fuzz/require.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string_view text = fuzz::as_text(data, size);
  const Result<std::vector<Ball>> balls = parse_balls(text, fuzz::kName);
  if (!balls.ok()) {
    const bool is_outside = balls.error().code == ErrorCode::kUsage;  // a ball with this side
    fuzz::require(!is_outside || text.find("outside") != std::string_view::npos, "a file without one is no such error");
    fuzz::require_clear(balls.error(), is_outside ? ErrorCode::kUsage : ErrorCode::kInvalidMesh);
    fuzz::require(balls.error().message.starts_with(fuzz::kName + ":"), "a message begins with the name of the file");
    return 0;
  }
  fuzz::require(!balls.value().empty(), "there is a ball");
  fuzz::require(balls.value().size() <= text.size() / 8, "balls take bytes");
  for (const Ball& ball : balls.value()) {
    for (const double x : ball.centre) fuzz::require(std::isfinite(x), "centres are finite");
    fuzz::require(std::isfinite(ball.radius) && ball.radius > 0, "radii are positive and finite");
  }
  return 0;
}
