#include "output/charts_and_tables/thickness_histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "output/charts_and_tables/svg_drawing.h"

namespace medial_vk {
namespace {

constexpr std::size_t kThicknessBins = 50;

/// Shares of the area by bin, from 0 to `upper`.
struct ThicknessBins {
  double upper = 1;
  std::vector<double> by_lower_ends, by_upper_ends;

  double edge(std::size_t i) const { return upper * static_cast<double>(i) / kThicknessBins; }
};

ThicknessBins bins_of(const ThicknessRecord& record) {
  ThicknessBins bins;
  if (record.greatest > 0) bins.upper = record.greatest;
  bins.by_lower_ends.assign(kThicknessBins, 0);
  bins.by_upper_ends.assign(kThicknessBins, 0);
  const auto bin_of = [&](double thickness) {
    return std::min(static_cast<std::size_t>(kThicknessBins * thickness / bins.upper), kThicknessBins - 1);
  };
  for (const Bounds& interval : record.intervals) {
    ++bins.by_lower_ends[bin_of(interval.lower)];
    ++bins.by_upper_ends[bin_of(interval.upper)];
  }
  const auto count = static_cast<double>(std::max<std::size_t>(record.intervals.size(), 1));
  for (double& share : bins.by_lower_ends) share /= count;
  for (double& share : bins.by_upper_ends) share /= count;
  return bins;
}

class ThicknessDrawing {
 public:
  explicit ThicknessDrawing(ThicknessBins bins) : bins_(std::move(bins)), out_(kAcross, kDown) {
    most_ = std::max({0.01, std::ranges::max(bins_.by_lower_ends), std::ranges::max(bins_.by_upper_ends)});
  }

  void axes() {
    const double share_step = tick_step(100 * most_);
    for (int k = 0; share_step * k <= 100 * most_; ++k) {
      const double share = share_step * k / 100;
      out_.line(kFrameLeft, y(share), kAcross - kFrameRight, y(share), "grid");
      out_.text(kFrameLeft - 8, y(share) + 4, "end", fmt::format("{:.3g} %", share_step * k));
    }
    const double step = tick_step(bins_.upper);
    for (int k = 0; step * k <= bins_.upper; ++k) {
      out_.line(x(step * k), y(0), x(step * k), y(0) + 4, "axis");
      out_.text(x(step * k), y(0) + 18, "middle", fmt::format("{:.3g}", step * k));
    }
    out_.text(x(bins_.upper / 2), y(0) + 38, "middle", "thickness of the walls, in the units of the mesh");
    out_.text(kFrameLeft, 20, "start", "share of the area of the boundary");
  }

  void bars() {
    const double width = x(bins_.edge(1)) - x(0);
    std::vector<std::pair<double, double>> steps;
    for (std::size_t i = 0; i < kThicknessBins; ++i) {
      const double left = x(bins_.edge(i)), top = y(bins_.by_lower_ends[i]);
      if (bins_.by_lower_ends[i] > 0) out_.bar(left + 0.04 * width, top, 0.92 * width, y(0) - top, "bar");
      steps.emplace_back(left, y(bins_.by_upper_ends[i]));
      steps.emplace_back(left + width, y(bins_.by_upper_ends[i]));
    }
    out_.curve(steps, "upper");
    out_.line(kFrameLeft, y(0), kAcross - kFrameRight, y(0), "axis");
    out_.line(kFrameLeft, y(0), kFrameLeft, y(most_), "axis");
  }

  /// Above the frame, where no bar reaches.
  void keys(const Bounds& median) {
    out_.line(x(median.lower), y(0), x(median.lower), y(most_), "median");
    const double line = 40;
    out_.bar(kFrameLeft, line - 10, 12, 10, "bar");
    out_.text(kFrameLeft + 18, line, "start", "at least");
    out_.key(kFrameLeft + 90, line - 5, "upper");
    out_.text(kFrameLeft + 120, line, "start", "at most");
    out_.key(kFrameLeft + 190, line - 5, "median");
    out_.text(kFrameLeft + 220, line, "start",
              fmt::format("median, between {:.4g} and {:.4g}", median.lower, median.upper));
  }

  std::string finish() const {
    return out_.finish(
        "polyline,path{fill:none;stroke-width:2}.bar{fill:#7fb4dc}.upper{stroke:#d55e00}"
        ".median{stroke:#222;stroke-dasharray:6 3}");
  }

 private:
  static constexpr double kAcross = 640, kDown = 360, kFrameLeft = 64, kFrameRight = 16, kFrameTop = 56,
                          kFrameBottom = 52;

  double x(double thickness) const {
    return kFrameLeft + (kAcross - kFrameLeft - kFrameRight) * thickness / bins_.upper;
  }
  double y(double share) const { return kDown - kFrameBottom - (kDown - kFrameTop - kFrameBottom) * share / most_; }

  ThicknessBins bins_;
  double most_ = 1;
  SvgDrawing out_;
};

}  // namespace

std::string encode_thickness_svg(const ThicknessRecord& record) {
  ThicknessDrawing drawing(bins_of(record));
  drawing.axes();
  drawing.bars();
  drawing.keys(record.median);
  return drawing.finish();
}

std::string encode_thickness_csv(const ThicknessRecord& record) {
  const ThicknessBins bins = bins_of(record);
  std::string text = "lower,upper,share_by_lower_ends,share_by_upper_ends\n";
  for (std::size_t i = 0; i < kThicknessBins; ++i) {
    text += fmt::format("{},{},{},{}\n", bins.edge(i), bins.edge(i + 1), bins.by_lower_ends[i], bins.by_upper_ends[i]);
  }
  return text;
}

}  // namespace medial_vk
