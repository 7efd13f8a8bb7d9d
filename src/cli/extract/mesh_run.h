// One mesh of a run of the main command: from its triangles to the bytes of its files.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "check_reports/check_report.h"
#include "cli/extract/boundary_run.h"
#include "cli/options/options.h"
#include "cli/shared/shared_of_run.h"
#include "medial_vk/analysis.h"
#include "medial_vk/indexed_mesh.h"
#include "output/atomic_files/atomic_file.h"
#include "output/extraction_report/run_record.h"
#include "output/medial_ply/medial_file.h"
#include "output/picture/panels/image.h"

namespace medial_vk::cli {

/// The calls come in the order of their declaration, each once.
class MeshRun {
 public:
  /// `options` name the files of this mesh. `part` is its name among several; empty: it is the only one.
  MeshRun(Options options, std::string part, SharedOfRun& shared);

  /// Cleans the mesh, perturbs it if requested, and indexes it.
  Status load(Mesh mesh);
  /// Waits until the device of the run is open. Only the first mesh waits, and its report has the time.
  Status take_device();
  /// For people, before the search.
  std::string opening_line() const;
  Status analyse_mesh();
  /// Thickness and curvature, if an output needs them. The first signal ends the program at once.
  Status measure();
  /// Encodes all files; with --check it also tests them. Then only the results are kept, and not the mesh.
  Status make_files();

  const std::vector<OutputFile>& files() const { return files_; }
  const RunRecord& record() const { return record_; }

 private:
  Status index(PreparedMesh mesh);
  Status choose_sides(unsigned threads);
  Result<Analysis> analyse_side(const IndexedMesh& mesh, const Extractor& extractor);
  bool reports_index() const;
  void describe();
  Status measure_fat();
  Status encode_boundary();
  void encode_volumes();
  void encode_mesh();
  Status encode();
  Status check();
  CheckReport check_side(const IndexedMesh& searched, const MedialFile& written) const;
  std::span<const MedialSphere> spheres_inside() const;
  Status draw();
  Status add_picture(const Picture& picture, std::string drawn_by, Stopwatch& stopwatch);
  void make_page();
  void encode_report();

  const Options options_;
  SharedOfRun& shared_;
  std::optional<IndexedMesh> mesh_;
  std::vector<IndexedMesh> searched_;  // by side, inside first
  Analysis analysis_;
  MeasuredBoundary boundary_;
  MedialHeader header_;
  std::vector<OutputFile> files_;
  double index_seconds_ = 0;
  std::vector<StageTime> medial_mesh_times_;  // reported last
  std::size_t points_file_ = 0;               // its index among them
  RunRecord record_;
};

}  // namespace medial_vk::cli
