// The visible difference of two pictures.
#pragma once

#include "output/picture/picture.h"

namespace medial_vk::test {

/// Differences in CIELAB (1976; about 2.3 is just visible) after a blur of both pictures over 5 x 5 pixels, which
/// ignores the exact position of an edge within a pixel, and nothing larger.
struct LookDifference {
  double mean = 0;   ///< Over all pixels.
  double worst = 0;  ///< Of the worst hundredth of the pixels, the least.
};

/// Precondition: pictures of one size.
LookDifference look_difference(const Picture& a, const Picture& b);

/// Error: the fault of the file.
Result<Picture> read_png(const std::string& path);

}  // namespace medial_vk::test
