#include "curvature/width_choice.h"

#include <algorithm>
#include <cmath>

namespace medial_vk {
namespace {

constexpr double kBiasShare = 0.25;  // of the fourth power of widths whose squares are as 1 to 2
// Of the difference of a width from the next narrower one, about so much is its own noise, which falls with the third
// power of the width. If the difference is bias, so many times it is the bias of the width itself, which has no wider
// one.
constexpr double kNoiseShare = 0.354, kWidestFactor = 1 / (1 - kBiasShare);
// Of the difference of the next wider one from it. A third would be its bias; a half, since part of the bias is of
// lower powers.
constexpr double kBiasOfNext = 0.5;

/// Estimates of the error of a width, by its difference from the next narrower one and the differences of wider ones.
struct WidthErrors {
  double likely;    // by which widths are compared
  double reported;  // both differences in full

  WidthErrors(double own, double of_wider, bool is_widest)
      : likely(std::max((is_widest ? kWidestFactor : kNoiseShare) * own, kBiasOfNext * of_wider)),
        reported(std::max(own, of_wider)) {}
};

}  // namespace

WidthChoice choose_width(std::span<const WidthDifference> differences) {
  WidthChoice best;
  WidthDifference wider = {0, 0};
  double least = 0;
  bool is_widest = true;
  for (std::size_t i = differences.size(); i-- > 1;) {
    const WidthDifference& at = differences[i];
    // What is left of the wider ones' bias in the next one's difference.
    const WidthDifference bias = {kBiasShare * wider.form, kBiasShare * wider.angle};
    if (std::isnan(at.form)) {
      wider = bias;
      continue;
    }
    const WidthErrors form(at.form, wider.form, is_widest), angle(at.angle, wider.angle, is_widest);
    if (best.step == 0 || form.likely < least) {
      best = {i, form.reported, angle.reported};
      least = form.likely;
    }
    wider = {std::max(bias.form, at.form), std::max(bias.angle, at.angle)};
    is_widest = false;
  }
  return best;
}

}  // namespace medial_vk
