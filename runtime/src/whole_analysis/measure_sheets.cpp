#include "whole_analysis/measure_sheets.h"

#include <utility>
#include <vector>

#include "sheets/significance.h"

namespace medial_vk {
namespace {

std::vector<Ball> balls_of(const std::vector<MedialSphere>& spheres) {
  std::vector<Ball> balls;
  balls.reserve(spheres.size());
  for (const MedialSphere& sphere : spheres) balls.push_back({sphere.centre, sphere.radius});
  return balls;
}

template <class T>
void keep_marked(const std::vector<bool>& keep, std::vector<T>& list) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (keep[i]) list[count++] = list[i];
  }
  list.resize(count);
}

class SheetMeasuring {
 public:
  SheetMeasuring(const AnalysisOptions& options, const StageProgress& progress, const std::stop_token& stop,
                 Analysis& analysis)
      : options_(options),
        progress_(progress),
        stop_(stop),
        out_(analysis),
        balls_(balls_of(analysis.spheres)),
        sheets_{balls_, analysis.sheets->of_point, analysis.sheets->sheets.size()} {}

  Status run() {
    if (Status status = measure(); !status.ok()) return status;
    if (Status status = find_orders(); !status.ok()) return status;
    if (options_.keep_volume > 0) keep_sheets();
    return {};
  }

 private:
  Status measure() {
    const VoxelGraph graph(out_.spheres, options_.threads);
    sheets_.graph = &graph;
    sheets_.voxel_size = out_.grid.voxel_size;
    const std::vector<double> weights = seam_weights(*out_.sheets);
    sheets_.weights = weights;
    Result<Significance> measured = measure_significance(sheets_, options_.threads);
    sheets_.graph = nullptr;
    sheets_.weights = {};
    if (!measured) return measured.error();
    out_.significance = std::move(measured).value();
    for (std::size_t sheet = 0; sheet < sheets_.sheets; ++sheet) {
      out_.sheets->sheets[sheet].significance = out_.significance->of_sheet[sheet];
    }
    return {};
  }

  Result<SheetRemoval> order(RemovalRule rule, double least_volume) {
    const double begin = rule == RemovalRule::kTopology ? 0.5 : 0;  // of the two orders
    return remove_sheets(sheets_, *out_.significance, rule, least_volume, options_.threads, [&, begin](double done) {
      if (progress_) progress_("volumes", begin + done / 2);
      return !stop_.stop_requested();
    });
  }

  /// Complete orders if they are requested; otherwise only as far as keep_volume permits.
  Status find_orders() {
    if (!options_.removal_orders && !(options_.keep_volume > 0)) return {};
    const double least_volume = options_.removal_orders ? 0 : options_.keep_volume;
    Result<SheetRemoval> by_significance = order(RemovalRule::kSignificance, least_volume);
    if (!by_significance) return by_significance.error();
    out_.by_significance = std::move(by_significance).value();
    if (!options_.removal_orders && !options_.keep_topology) return {};
    Result<SheetRemoval> keeping_topology = order(RemovalRule::kTopology, least_volume);
    if (!keeping_topology) return keeping_topology.error();
    out_.keeping_topology = std::move(keeping_topology).value();
    return {};
  }

  void keep_sheets() {
    Significance& significance = *out_.significance;
    SheetRemoval removal = stop_at_volume(options_.keep_topology ? *out_.keeping_topology : *out_.by_significance,
                                          significance, options_.keep_volume);
    std::vector<bool> is_kept_sheet(sheets_.sheets, true);
    for (const std::uint32_t sheet : removal.sheets) is_kept_sheet[sheet] = false;
    std::vector<bool> keep(out_.spheres.size());
    for (std::size_t i = 0; i < keep.size(); ++i) {
      keep[i] = is_kept_sheet[static_cast<std::size_t>(sheets_.sheet_of[i])];
    }
    keep_marked(keep, out_.spheres);
    keep_marked(keep, out_.sheets->of_point);
    keep_marked(keep, out_.sheets->marks);
    keep_marked(keep, out_.sheets->areas);
    keep_marked(keep, significance.of_ball);
    keep_marked(keep, significance.areas);
    out_.removal = std::move(removal);
  }

  const AnalysisOptions& options_;
  const StageProgress& progress_;
  const std::stop_token& stop_;
  Analysis& out_;
  std::vector<Ball> balls_;
  SheetBalls sheets_;
};

}  // namespace

Status measure_sheets(const AnalysisOptions& options, const StageProgress& progress, const std::stop_token& stop,
                      Analysis& analysis) {
  return SheetMeasuring(options, progress, stop, analysis).run();
}

}  // namespace medial_vk
