#include "cli/batch/run_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "base/stopwatch.h"
#include "cli/batch/batch_folder.h"
#include "cli/batch/find_meshes.h"
#include "cli/batch/mesh_digest.h"
#include "cli/batch/mesh_row.h"
#include "cli/extract/mesh_run.h"
#include "cli/extract/wall_run.h"
#include "cli/help/help_texts.h"
#include "cli/options/batch/batch_options.h"
#include "cli/shared/leave_device.h"
#include "cli/shared/load.h"
#include "cli/shared/shared_of_run.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/tables.h"
#include "common/tool_errors.h"
#include "medial_vk/version.h"
#include "output/atomic_files/atomic_file.h"
#include "output/batch_page/batch_page.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

Error stopped_batch() { return {ErrorCode::kInterrupted, "interrupted; the meshes that are done are kept"}; }

/// Errors that the next mesh would meet as well.
bool ends_batch(ErrorCode code) {
  return code == ErrorCode::kInterrupted || code == ErrorCode::kNoDevice || code == kCannotWrite;
}

class BatchRun {
 public:
  BatchRun(const BatchOptions& options, std::vector<BatchMesh> meshes, BatchFolder folder)
      : options_(options),
        meshes_(std::move(meshes)),
        folder_(std::move(folder)),
        progress_(!options.each.quiet),
        shared_(false) {}  // several meshes a second have one line of progress

  Status run() {
    if (Status status = check_files(); !status) return status;
    Result<std::vector<BatchRow>> rows = folder_.read_rows();
    if (!rows) return rows.error();
    if (Status status = folder_.replace_table(rows.value()); !status) return status;
    for (BatchRow& row : rows.value()) {
      std::string name = row[BatchColumn::kName];
      rows_.insert_or_assign(std::move(name), std::move(row));
    }
    tell_of_kept_meshes();
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      progress_.update("meshes", static_cast<double>(i) / static_cast<double>(meshes_.size()));
      if (interrupted()) return stopped_batch();
      if (Status status = run_mesh(meshes_[i]); !status) {
        progress_.clear();
        return status.error().code == ErrorCode::kInterrupted ? Status(stopped_batch()) : status;
      }
    }
    progress_.clear();
    leave_device(shared_.context);
    return conclude();
  }

 private:
  std::string stem_of(const BatchMesh& mesh) const { return folder_.path_of(mesh.name); }
  Options options_of(const BatchMesh& mesh) const { return options_of_mesh(options_.each, mesh.file, stem_of(mesh)); }

  /// No result may replace a mesh.
  Status check_files() const {
    const auto real = [](const std::string& path) {
      std::error_code error;
      return fs::weakly_canonical(fs::absolute(path, error), error).string();
    };
    std::unordered_map<std::string, const BatchMesh*> inputs;
    for (const BatchMesh& mesh : meshes_) inputs.emplace(real(mesh.file), &mesh);
    for (const BatchMesh& mesh : meshes_) {
      const Options of_mesh = options_of(mesh);
      for (const NamedOutput& output : outputs_of(of_mesh)) {
        if (output.file->empty()) continue;
        if (const auto replaced = inputs.find(real(*output.file)); replaced != inputs.end()) {
          return Error{ErrorCode::kUsage,
                       fmt::format("a result of {} would overwrite the mesh {}", mesh.file, replaced->second->file)};
        }
      }
    }
    return {};
  }

  /// Failures of the mesh become its row.
  Status run_mesh(const BatchMesh& mesh) {
    Stopwatch stopwatch;
    BatchRow row;
    row[BatchColumn::kName] = mesh.name;
    row[BatchColumn::kOptions] = options_.given;
    row[BatchColumn::kVersion] = version();
    bool is_kept = false;
    Status status;
    try {
      status = make_results(mesh, row, is_kept);
    } catch (const std::bad_alloc&) {
      status = Error{ErrorCode::kOutOfMemory, "out of memory; try a lower --resolution"};
    } catch (const std::exception& error) {
      status = Error{ErrorCode::kInternal, fmt::format("internal error: {}", error.what())};
    }
    if (!status && ends_batch(status.error().code)) return status;
    if (is_kept) {
      ++kept_;
      return {};
    }
    row[BatchColumn::kSeconds] = fmt::format("{:.6f}", stopwatch.lap());
    row[BatchColumn::kState] = status ? kBatchDone : kBatchFailed;
    if (!status) take_failure(status.error(), row);
    if (Status appended = folder_.append(row); !appended) return appended;
    tell(mesh, row);
    rows_.insert_or_assign(mesh.name, std::move(row));
    return {};
  }

  void take_failure(const Error& error, BatchRow& row) {
    row[BatchColumn::kError] = in_words_of_options(error.message, Command::kBatch);
    std::ranges::replace(row[BatchColumn::kError], '\n', ' ');
    // A device that was lost, or has no memory left, is opened again for the next mesh.
    if (error.code != ErrorCode::kInternal && error.code != ErrorCode::kOutOfMemory) return;
    shared_.context.reset();
    is_open_ = false;
  }

  void tell(const BatchMesh& mesh, const BatchRow& row) {
    const std::string& error = row[BatchColumn::kError];
    if (!row.is_done()) {
      progress_.clear();
      const bool has_name = error.starts_with(mesh.file);
      print_message(fmt::format("{}{}{}\n", has_name ? "" : mesh.file, has_name ? "" : ": ", error));
    } else if (options_.each.verbose) {
      progress_.clear();
      print_message(fmt::format("{}: {} points, {} s\n", row[BatchColumn::kName], row[BatchColumn::kPoints],
                                row[BatchColumn::kSeconds]));
    }
  }

  Status make_results(const BatchMesh& mesh, BatchRow& row, bool& is_kept) {
    shared_.times.clear();
    Result<std::vector<ScenePart>> parts = read_meshes(mesh.file, false, shared_.times);
    if (!parts) return fail_without_files(mesh, parts.error());
    Mesh& read = parts.value().front().mesh;
    row[BatchColumn::kContent] = mesh_digest(read);
    const Options of_mesh = options_of(mesh);
    is_kept = is_done(row, of_mesh);
    if (is_kept) return {};
    if (!is_open_ && options_.each.backend == Backend::kVulkan) {
      shared_.opening.start(options_.each.device, options_.each.threads, progress_);
      is_open_ = true;
    }
    MeshRun run(of_mesh, "", shared_);
    bool has_points = false;
    Status status = search(run, std::move(read), has_points);
    fill_row(run.record(), has_points, row);
    if (!status) return fail_without_files(mesh, status.error());
    std::error_code error;
    fs::create_directories(fs::path(of_mesh.output).parent_path(), error);  // write_files() tells what is wrong
    if (status = write_files(run.files()); !status) return status;
    if (status = verdict(run.record().boundary.walls); !status) return status;
    return run.record().check ? verdict(*run.record().check) : Status();
  }

  static Status search(MeshRun& run, Mesh mesh, bool& has_points) {
    if (Status status = run.load(std::move(mesh)); !status) return status;
    if (Status status = run.take_device(); !status) return status;
    if (Status status = run.analyse_mesh(); !status) return status;
    has_points = true;
    if (Status status = run.measure(); !status) return status;
    return run.make_files();
  }

  /// Results of an earlier run, whose mesh or options were others, are no results of this one.
  Status fail_without_files(const BatchMesh& mesh, const Error& why) const {
    if (ends_batch(why.code) || !rows_.contains(mesh.name)) return why;
    const Options of_mesh = options_of(mesh);
    for (const NamedOutput& output : outputs_of(of_mesh)) {
      std::error_code ignored;
      if (!output.file->empty()) fs::remove(*output.file, ignored);
    }
    return why;
  }

  /// Whether an earlier run has done the same on the same mesh, and its files are there.
  bool is_done(const BatchRow& row, const Options& of_mesh) const {
    const auto before = rows_.find(row[BatchColumn::kName]);
    if (before == rows_.end() || !before->second.is_done()) return false;
    for (const BatchColumn column : {BatchColumn::kContent, BatchColumn::kOptions, BatchColumn::kVersion}) {
      if (before->second[column] != row[column]) return false;
    }
    return std::ranges::all_of(outputs_of(of_mesh), [](const NamedOutput& output) {
      std::error_code error;
      return output.file->empty() || fs::exists(*output.file, error);
    });
  }

  Status conclude() {
    std::vector<BatchRow> rows;
    rows.reserve(rows_.size());
    std::size_t failed = 0;
    for (const BatchMesh& mesh : meshes_) {
      rows.push_back(std::move(rows_.extract(mesh.name).mapped()));
      failed += rows.back().is_done() ? 0 : 1;
    }
    // Meshes of earlier runs that were not among the inputs of this one.
    std::vector<BatchRow> others;
    for (auto& [name, row] : rows_) others.push_back(std::move(row));
    std::ranges::sort(others, {}, [](const BatchRow& row) { return row[BatchColumn::kName]; });
    std::ranges::move(others, std::back_inserter(rows));
    if (Status status = folder_.replace_table(rows); !status) return status;
    if (Status status = write_page(std::span(rows).first(meshes_.size())); !status) return status;
    if (!options_.each.quiet) print_message(batch_summary(failed));
    if (failed == 0) return {};
    return Error{kSomeFailed, fmt::format("{} of {} failed: {} has the reasons", grouped(failed),
                                          counted(meshes_.size(), "mesh", "meshes"), folder_.table_path())};
  }

  Status write_page(std::span<const BatchRow> rows) const {
    if (!options_.page) return {};
    std::vector<BatchCard> cards;
    cards.reserve(rows.size());
    for (const BatchRow& row : rows) {
      const std::string& name = row[BatchColumn::kName];
      const Options of_mesh = options_of_mesh(options_.each, "", name);
      BatchCard card = {&row, "", ""};
      std::error_code error;
      if (fs::exists(folder_.path_of(of_mesh.picture), error)) card.picture = of_mesh.picture;
      if (fs::exists(folder_.path_of(of_mesh.output), error)) card.points = of_mesh.output;
      cards.push_back(std::move(card));
    }
    const OutputFile page = {folder_.page_path(), encode_batch_page(cards)};
    return write_files({&page, 1});
  }

  std::string batch_summary(std::size_t failed) {
    const std::size_t done = meshes_.size() - kept_ - failed;
    std::string meshes = fmt::format("{} done", grouped(done));
    if (kept_ > 0) meshes += fmt::format(", {} done before", grouped(kept_));
    if (failed > 0) meshes += fmt::format(", {} failed", grouped(failed));
    std::string text = labelled("meshes", meshes);
    text += labelled("time", duration(whole_.lap()));
    text += labelled("table", folder_.table_path());
    if (options_.page) text += labelled("page", folder_.page_path());
    return text;
  }

  const BatchOptions& options_;
  const std::vector<BatchMesh> meshes_;
  BatchFolder folder_;
  Progress progress_;
  SharedOfRun shared_;
  Stopwatch whole_;
  bool is_open_ = false;                            ///< The device is open, or is being opened.
  std::unordered_map<std::string, BatchRow> rows_;  ///< By name, of earlier runs and of this one.
  std::size_t kept_ = 0;
};

}  // namespace

Status run_batch(const std::vector<std::string>& arguments) {
  const Result<BatchOptions> options = parse_batch_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(batch_help_text());
  Result<std::vector<BatchMesh>> meshes = find_meshes(options.value().inputs, options.value().output);
  if (!meshes) return meshes.error();
  Result<BatchFolder> folder = BatchFolder::open(options.value().output);
  if (!folder) return folder.error();
  return BatchRun(options.value(), std::move(meshes).value(), std::move(folder).value()).run();
}

}  // namespace medial_vk::cli
