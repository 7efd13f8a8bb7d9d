// How different two pictures look.
#pragma once

#include "output/picture/picture.h"

namespace medial_vk::test {

/// Differences in CIELAB (1976; about 2.3 is just seen) after a blur of both pictures over 5 x 5 pixels, which forgives
/// where exactly an edge falls within a pixel, and nothing larger.
struct LookDifference {
  double mean = 0;   ///< Over all pixels.
  double worst = 0;  ///< Of the worst hundredth of the pixels, the least.
};

/// Precondition: pictures of one size.
LookDifference look_difference(const Picture& a, const Picture& b);

/// Error: what is wrong with the file.
Result<Picture> read_png(const std::string& path);

}  // namespace medial_vk::test
