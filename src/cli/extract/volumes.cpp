#include "cli/extract/volumes.h"

#include <utility>

#include "common/file_extension.h"
#include "output/charts/ball_volumes.h"
#include "output/charts/volume_curve.h"

namespace medial_vk::cli {
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

class VolumeStep {
 public:
  VolumeStep(const Options& options, const std::function<bool(const char*, double)>& progress,
             std::vector<MedialSphere>& spheres, RunRecord& record, std::vector<OutputFile>& files)
      : options_(options),
        progress_(progress),
        spheres_(spheres),
        record_(record),
        files_(files),
        balls_(balls_of(spheres)),
        sheets_{balls_, record.sheets.of_point, record.sheets.sheets.size()} {}

  Status run() {
    if (Status status = measure(); !status.ok()) return status;
    if (options_.keep_volume > 0 || !options_.sheet_curve.empty()) {
      if (Status status = find_orders(); !status.ok()) return status;
    }
    if (!options_.sheet_curve.empty()) draw_curve();
    if (options_.keep_volume > 0) keep_sheets();
    if (!options_.ball_volumes.empty()) {
      files_.push_back({options_.ball_volumes, encode_ball_volumes(significance_, spheres_)});
    }
    return {};
  }

 private:
  Status measure() {
    if (!progress_("volume", 0)) return Error{ErrorCode::kInterrupted, "interrupted"};
    const VoxelGraph graph(spheres_);
    sheets_.graph = &graph;
    sheets_.voxel_size = record_.grid.voxel_size;
    const std::vector<double> weights = seam_weights(record_.sheets);
    sheets_.weights = weights;
    Result<Significance> measured = measure_significance(sheets_, options_.threads);
    sheets_.graph = nullptr;
    sheets_.weights = {};
    if (!measured) return measured.error();
    significance_ = std::move(measured).value();
    record_.ball_union = UnionRecord{significance_.volume, significance_.area, significance_.topology};
    for (std::size_t sheet = 0; sheet < sheets_.sheets; ++sheet) {
      record_.sheets.sheets[sheet].significance = significance_.of_sheet[sheet];
    }
    return {};
  }

  Result<SheetRemoval> order(RemovalRule rule, double least_volume) {
    return remove_sheets(sheets_, significance_, rule, least_volume, options_.threads, [this, rule](double done) {
      return progress_(rule == RemovalRule::kTopology ? "topology" : "sheets", done);
    });
  }

  /// To their ends for the curve, which asks for both; else as far as --keep-volume goes.
  Status find_orders() {
    const bool to_the_end = !options_.sheet_curve.empty();
    record_.orders_end_at = to_the_end ? 0 : options_.keep_volume;
    Result<SheetRemoval> by_significance = order(RemovalRule::kSignificance, record_.orders_end_at);
    if (!by_significance) return by_significance.error();
    record_.by_significance = std::move(by_significance).value();
    if (!to_the_end && !options_.keep_topology) return {};
    Result<SheetRemoval> keeping_topology = order(RemovalRule::kTopology, record_.orders_end_at);
    if (!keeping_topology) return keeping_topology.error();
    record_.keeping_topology = std::move(keeping_topology).value();
    return {};
  }

  void draw_curve() {
    const VolumeCurves curves = {*record_.by_significance, *record_.keeping_topology};
    const bool is_drawing = file_extension(options_.sheet_curve) == ".svg";  // standard output gets the table
    files_.push_back({options_.sheet_curve, is_drawing ? encode_curve_svg(curves) : encode_curve_csv(curves)});
  }

  void keep_sheets() {
    SheetRemoval removal = stop_at_volume(options_.keep_topology ? *record_.keeping_topology : *record_.by_significance,
                                          significance_, options_.keep_volume);
    std::vector<bool> is_kept_sheet(sheets_.sheets, true);
    for (const std::uint32_t sheet : removal.sheets) is_kept_sheet[sheet] = false;
    std::vector<bool> keep(spheres_.size());
    for (std::size_t i = 0; i < keep.size(); ++i) {
      keep[i] = is_kept_sheet[static_cast<std::size_t>(sheets_.sheet_of[i])];
    }
    keep_marked(keep, spheres_);
    keep_marked(keep, record_.sheets.of_point);
    keep_marked(keep, record_.sheets.marks);
    keep_marked(keep, record_.sheets.areas);
    keep_marked(keep, significance_.of_ball);
    keep_marked(keep, significance_.areas);
    record_.removal = std::move(removal);
    record_.keep_volume = options_.keep_volume;
    record_.keep_topology = options_.keep_topology;
  }

  const Options& options_;
  const std::function<bool(const char*, double)>& progress_;
  std::vector<MedialSphere>& spheres_;
  RunRecord& record_;
  std::vector<OutputFile>& files_;
  std::vector<Ball> balls_;
  SheetBalls sheets_;
  Significance significance_;
};

}  // namespace

bool needs_volumes(const Options& options) {
  return options.keep_volume > 0 || !options.sheet_curve.empty() || !options.ball_volumes.empty() ||
         !options.report.empty() || !options.html.empty();
}

Status measure_volumes(const Options& options, const std::function<bool(const char*, double)>& progress,
                       std::vector<MedialSphere>& spheres, RunRecord& record, std::vector<OutputFile>& files) {
  return VolumeStep(options, progress, spheres, record, files).run();
}

}  // namespace medial_vk::cli
