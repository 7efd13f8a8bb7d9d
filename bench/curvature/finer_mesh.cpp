#include "finer_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/point_ops.h"
#include "curvature/point_grid.h"
#include "curvature_errors.h"

namespace medial_vk::bench {
namespace {

/// The side of the voxels, the distance of neighbouring balls.
double spacing_of(const SmoothBoundary& solid, const Settings& settings) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (const Point& v : solid.mesh.vertices) {
      least = std::min(least, v[k]);
      greatest = std::max(greatest, v[k]);
    }
    longest = std::max(longest, greatest - least);
  }
  return longest / settings.resolution;
}

class ChangeRow {
 public:
  explicit ChangeRow(double greatest) : greatest_(greatest) {}
  void add(const MeasuredTip& coarse, const MeasuredTip& fine) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double of_coarse = coarse.tip.kappa[k] - coarse.truth.kappa[k];
      const double of_fine = fine.tip.kappa[k] - fine.truth.kappa[k];
      changes_[k].add(100 * std::fabs(of_fine - of_coarse) / error_scale(coarse.truth, greatest_));
    }
  }
  void add_alone() { ++alone_; }
  void print(const std::string& solid, const std::string& method) {
    const auto all = static_cast<double>(changes_[0].count() + alone_);
    fmt::print("| {} | {} | {} | {:.1f} % | {:.2f} / {:.2f} | {:.2f} / {:.2f} | {:.1f} / {:.1f} |\n", solid, method,
               changes_[0].count(), 100 * static_cast<double>(alone_) / all, changes_[0].mean(), changes_[1].mean(),
               changes_[0].quantile(0.95), changes_[1].quantile(0.95), changes_[0].quantile(1),
               changes_[1].quantile(1));
    std::fflush(stdout);
  }

 private:
  double greatest_;
  std::size_t alone_ = 0;
  std::array<Numbers, 2> changes_;
};

void compare(const std::vector<MeasuredTip>& coarse, const std::vector<MeasuredTip>& fine, double spacing,
             ChangeRow& row) {
  std::vector<Point> places;
  places.reserve(fine.size());
  for (const MeasuredTip& at : fine) places.push_back(at.truth.position);
  const PointGrid grid(places, spacing);
  for (const MeasuredTip& at : coarse) {
    if (!is_known(at.tip.state)) continue;
    double least = std::numeric_limits<double>::infinity();
    const MeasuredTip* nearest = nullptr;
    grid.visit_within(at.truth.position, spacing, [&](std::uint32_t other, double squared) {
      const MeasuredTip& there = fine[other];
      if (squared >= least || !is_known(there.tip.state) || dot(there.truth.normal, at.truth.normal) <= 0) return;
      least = squared;
      nearest = &there;
    });
    if (nearest == nullptr) {
      row.add_alone();
    } else {
      row.add(at, *nearest);
    }
  }
}

}  // namespace

void print_head_of_finer_mesh() {
  fmt::print(
      "| solid | method | tips | without a tip near | mean change, % | 95th percentile | greatest |\n"
      "|---|---|---|---|---|---|---|\n");
}

void print_finer_mesh(const std::string& name, const Settings& settings, Context& context) {
  const SmoothBoundary coarse = solid_of(settings, name, settings.triangles);
  const SmoothBoundary fine = solid_of(settings, name, 4 * settings.triangles);
  const std::vector<MedialSphere> of_coarse = extract(coarse, settings, context);
  const std::vector<MedialSphere> of_fine = extract(fine, settings, context);
  for (const CurvatureMethod method : {CurvatureMethod::kFits, CurvatureMethod::kDifferences}) {
    ChangeRow row(greatest_curvature(coarse));
    compare(tips_of(coarse, of_coarse, method, settings), tips_of(fine, of_fine, method, settings),
            spacing_of(coarse, settings), row);
    row.print(name, method == CurvatureMethod::kFits ? "fits" : "differences");
  }
}

}  // namespace medial_vk::bench
