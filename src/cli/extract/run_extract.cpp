#include "cli/extract/run_extract.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>

#include "cli/extract/mesh_run.h"
#include "cli/extract/summary.h"
#include "cli/extract/wall_run.h"
#include "cli/options/options.h"
#include "cli/shared/leave_device.h"
#include "cli/shared/load.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/tables.h"
#include "output/atomic_files/atomic_file.h"
#include "output/page/page.h"
#include "scene_files/part_names.h"

namespace medial_vk::cli {
namespace {

/// An early test, which saves hours of work.
Status check_outputs(const Options& options) {
  if (!options.html.empty()) {
    if (Status status = check_page_available(); !status) return status;
  }
  for (const NamedOutput& output : outputs_of(options)) {
    if (output.file->empty()) continue;
    if (Status status = check_writable(*output.file); !status) return status;
  }
  return {};
}

/// One run after the parsing of options: load, analyse, encode, write. With --each there are several meshes, one after
/// the other, whose files are written together at the end.
class ExtractionRun {
 public:
  explicit ExtractionRun(const Options& options) : options_(options), shared_(!options.quiet) {}

  Status run() {
    if (Status status = check_outputs(options_); !status) return status;
    if (options_.backend != Backend::kCpu)
      shared_.opening.start(options_.device, options_.threads, shared_.progress);  // while the mesh is read
    if (Status status = read(); !status) return status;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Status status = run_part(i);
      if (!status) {
        return options_.each ? error_in_part(status.error(), i, runs_.size(), runs_[i]->record().part) : status;
      }
    }
    shared_.progress.clear();
    if (interrupted()) return stopped();
    if (Status status = write_all(); !status) return status;
    leave_device(shared_.context);
    return conclude();
  }

 private:
  Status read() {
    shared_.progress.update("read", 0);
    Result<std::vector<ScenePart>> parts = read_meshes(options_.mesh, options_.each, shared_.times);
    shared_.progress.clear();
    if (!parts) return parts.error();
    parts_ = std::move(parts).value();
    std::vector<std::string> names;
    if (options_.each) names = safe_part_names(parts_);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Options of_part = options_;
      if (options_.each) {
        of_part = options_of_part(options_, names[i]);
        if (Status status = check_outputs(of_part); !status) return status;
        if (Status status = check_outputs_differ(outputs_of(of_part), of_part.mesh); !status) return status;
      }
      runs_.push_back(std::make_unique<MeshRun>(std::move(of_part), options_.each ? names[i] : std::string(), shared_));
    }
    return {};
  }

  Status run_part(std::size_t i) {
    MeshRun& run = *runs_[i];
    if (Status status = run.load(std::exchange(parts_[i].mesh, Mesh())); !status) return status;
    if (Status status = run.take_device(); !status) return status;
    if (!options_.quiet) print_message(run.opening_line());
    if (Status status = run.analyse_mesh(); !status) return status;
    if (Status status = run.measure(); !status) return status;
    return run.make_files();
  }

  /// All files of all parts, or none.
  Status write_all() const {
    std::vector<OutputFile> files;
    for (const auto& run : runs_) files.insert(files.end(), run->files().begin(), run->files().end());
    return write_files(files);
  }

  Status conclude() const {
    Status failed;
    for (const auto& run : runs_) {
      const RunRecord& record = run->record();
      if (!options_.quiet) {
        if (runs_.size() > 1) print_message(fmt::format("{}:\n", record.part));
        print_message(summary(record, run->files()));
      }
      if (options_.verbose) print_message(details(record));
      if (Status status = print_places(*run); !status) return status;
      if (Status status = verdict(record.boundary.walls); !status && failed) {
        failed = runs_.size() > 1 ? Error{status.error().code, record.part + ": " + status.error().message} : status;
      }
      if (!record.check) continue;
      if (Status status = print_table(*run, check_table(*record.check)); !status) return status;
      if (Status status = verdict(*record.check); !status && failed) failed = status;
    }
    return failed;
  }

  Status print_places(const MeshRun& run) const {
    const std::string table = places_table(run.record().boundary.walls);
    return table.empty() ? Status() : print_table(run, table);
  }

  /// To standard output unless a file is written there.
  Status print_table(const MeshRun& run, std::string table) const {
    if (runs_.size() > 1) table = run.record().part + ":\n" + table;
    const bool is_taken = std::ranges::any_of(run.files(), [](const OutputFile& file) { return file.path == "-"; });
    if (!is_taken) return print_result(table);
    print_message(table);
    return {};
  }

  const Options& options_;
  SharedOfRun shared_;
  std::vector<ScenePart> parts_;
  std::vector<std::unique_ptr<MeshRun>> runs_;  // by part
};

}  // namespace

Status run_extract(const Options& options) { return ExtractionRun(options).run(); }

}  // namespace medial_vk::cli
