#include "camera.h"

#include <cmath>

// Columns of perspective times view, depth 0 to 1, y down.
FrameConstants camera(VkExtent2D size) {
  constexpr float kFar = 10, kNear = 0.1f, kZoom = 2.4f, kDistance = 3.6f, kHeight = 0.62f;  // kHeight: sine
  constexpr float kRaised = 0.2f;  // the near part appears larger
  const float across = std::sqrt(1 - kHeight * kHeight);
  const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
  const float eye[3] = {0, -kDistance * across, kDistance * kHeight};
  const float axes[3][3] = {{1, 0, 0}, {0, kHeight, across}, {0, across, -kHeight}};  // right, up, ahead
  FrameConstants c{};
  for (int column = 0; column < 4; ++column) {
    float seen[3];
    for (int i = 0; i < 3; ++i) {
      seen[i] = column < 3 ? axes[i][column] : -(axes[i][0] * eye[0] + axes[i][1] * eye[1] + axes[i][2] * eye[2]);
    }
    float* out = c.to_clip + 4 * column;
    out[0] = kZoom / aspect * seen[0];
    out[1] = -kZoom * seen[1] - kRaised * seen[2];
    out[2] = kFar / (kFar - kNear) * (seen[2] - (column == 3 ? kNear : 0));
    out[3] = seen[2];
  }
  for (int k = 0; k < 3; ++k) c.eye[k] = eye[k];
  return c;
}
