// The sequence of all steps from an indexed mesh to the analysis of its medial surface.
#include "medial_vk/analysis.h"

#include <exception>
#include <new>
#include <utility>

#include "base/host_memory.h"
#include "base/stopwatch.h"
#include "mesh/inspect_mesh.h"
#include "sheets/check_sheet_options.h"
#include "simplification/simplify_spheres.h"
#include "whole_analysis/measure_sheets.h"

namespace medial_vk {
namespace {

class AnalysisRun {
 public:
  AnalysisRun(const IndexedMesh& mesh, const AnalysisOptions& options, const Extractor& extractor,
              const StageProgress& progress, const std::stop_token& stop)
      : mesh_(mesh), options_(options), extractor_(extractor), progress_(progress), stop_(stop) {
    if (options_.sheets) options_.sheets->areas = options_.sheets->areas || measures();
  }

  Result<Analysis> run() {
    if (!(options_.keep_volume >= 0 && options_.keep_volume <= 1)) {
      return Error{ErrorCode::kUsage, "`keep_volume` must be 0 to 1"};
    }
    if (!options_.sheets && (measures() || options_.medial_mesh)) {
      return Error{ErrorCode::kUsage, "`volumes`, `keep_volume`, `removal_orders` and `medial_mesh` require `sheets`"};
    }
    if (options_.sheets) {
      if (Status status = check_sheet_options(*options_.sheets); !status) return status.error();
    }
    if (Status status = take_threads(); !status) return status.error();
    if (Status status = extract(); !status) return status.error();
    if (Status status = reached("sheets"); !status) return status.error();
    simplify();
    if (Status status = group(); !status) return status.error();
    if (Status status = measure(); !status) return status.error();
    if (Status status = connect(); !status) return status.error();
    if (stop_.stop_requested()) return Error{ErrorCode::kInterrupted, "interrupted"};
    return std::move(out_);
  }

 private:
  Status take_threads() {
    unsigned* const nested[] = {&options_.extraction.threads, options_.sheets ? &options_.sheets->threads : nullptr};
    for (unsigned* const threads : nested) {
      if (!threads) continue;
      if (*threads != 0 && *threads != options_.threads) {
        return Error{ErrorCode::kUsage,
                     "`threads` of the extraction or of the sheets is neither 0 nor that of the analysis"};
      }
      *threads = options_.threads;
    }
    return {};
  }

  Status reached(const char* stage) const {
    if (progress_) progress_(stage, 0);
    return stop_.stop_requested() ? Status(Error{ErrorCode::kInterrupted, "interrupted"}) : Status();
  }

  Status extract() {
    Result<CertifiedExtraction> found = extract_and_certify(mesh_, options_.extraction, extractor_, progress_, stop_);
    if (!found) return found.error();
    Extraction& extraction = found.value().extraction;
    out_.grid = extraction.grid;
    out_.spheres = std::move(extraction.spheres);
    out_.undecided = std::move(extraction.undecided);
    out_.measurements = std::move(extraction.measurements);
    out_.certificate = found.value().certificate;
    return {};
  }

  double epsilon() const { return options_.extraction.epsilon * out_.grid.voxel_size; }

  void simplify() {
    if (options_.simplify) out_.simplified = simplify_spheres(epsilon(), out_.spheres);
  }

  Status group() {
    if (!options_.sheets) return {};
    Stopwatch stopwatch;
    Result<Sheets> sheets = find_sheets(out_.spheres, out_.grid, options_.extraction, *options_.sheets);
    if (!sheets) return sheets.error();
    out_.sheets = std::move(sheets).value();
    for (std::size_t i = 0; i < out_.spheres.size(); ++i) out_.spheres[i].sheet = out_.sheets->of_point[i];
    out_.measurements.host_times.push_back({"sheets", stopwatch.lap()});
    return {};
  }

  bool measures() const { return options_.volumes || options_.keep_volume > 0 || options_.removal_orders; }

  Status measure() {
    if (!measures()) return {};
    if (Status status = reached("volumes"); !status) return status;
    Stopwatch stopwatch;
    if (Status status = measure_sheets(options_, progress_, stop_, out_); !status) return status;
    out_.measurements.host_times.push_back({"volumes", stopwatch.lap()});
    return {};
  }

  Status connect() {
    if (!options_.medial_mesh) return {};
    if (Status status = reached("medial mesh"); !status) return status;
    Stopwatch stopwatch;
    Result<MedialMesh> joined =
        make_medial_mesh(out_.spheres, *out_.sheets, {out_.grid.voxel_size, epsilon(), options_.threads});
    if (!joined) return joined.error();
    out_.medial_mesh = std::move(joined).value();
    if (mesh_.side() == MeshSide::kInside) {
      out_.euler_characteristic = euler_characteristic_of_solid(mesh_.prepared());
    }
    out_.measurements.host_times.push_back({"medial mesh", stopwatch.lap()});
    return {};
  }

  const IndexedMesh& mesh_;
  AnalysisOptions options_;
  const Extractor& extractor_;
  const StageProgress& progress_;
  const std::stop_token& stop_;
  Analysis out_;
};

}  // namespace

Result<Analysis> analyse(const IndexedMesh& mesh, const AnalysisOptions& options, const Extractor& extractor,
                         const StageProgress& progress, const std::stop_token& stop) {
  try {
    return AnalysisRun(mesh, options, extractor, progress, stop).run();
  } catch (const std::bad_alloc&) {
    return out_of_memory("analysing", "try a lower `resolution`");
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, error.what()};
  }
}

Result<Analysis> analyse(const IndexedMesh& mesh, const AnalysisOptions& options, Context& context,
                         const StageProgress& progress, const std::stop_token& stop) {
  return analyse(mesh, options, device_extractor(context), progress, stop);
}

}  // namespace medial_vk
