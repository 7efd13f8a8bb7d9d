#include "cli/batch/run_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iterator>
#include <new>
#include <numeric>
#include <span>
#include <string>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "cli/batch/batch_folder.h"
#include "cli/batch/find_meshes.h"
#include "cli/batch/merge_batches.h"
#include "cli/batch/mesh_digest.h"
#include "cli/batch/mesh_row.h"
#include "cli/batch/page_file.h"
#include "cli/batch/result_files.h"
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
#include "platform/files.h"
#include "platform/machine.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;
using platform::file_key;

Error stopped_batch() { return {ErrorCode::kInterrupted, "interrupted; the meshes that are done are kept"}; }

/// Errors that the next mesh would meet as well.
bool ends_batch(ErrorCode code) {
  return code == ErrorCode::kInterrupted || code == ErrorCode::kNoDevice || code == kDiskFails;
}

/// As texts of the table are written.
std::string without_line_ends(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

Status print_list(std::span<const BatchMesh> meshes) {
  std::string text;
  for (const BatchMesh& mesh : meshes) text += line_of_list(mesh) + "\n";
  return print_result(text);
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
    Result<BatchTable> table = folder_.read_rows();
    if (!table) return table.error();
    for (const BatchRow& row : table.value().rows) rows_.emplace(file_key(row[BatchColumn::kName]), row);
    if (Status status = check_files(); !status) return status;
    if (Status status = check_sources(); !status) return status;
    if (Status status = folder_.replace_table(table.value().rows); !status) return status;
    tell_of_damage(table.value().damaged_lines);
    tell_of_kept_meshes();
    std::size_t tried = 0;
    for (const std::size_t next : in_order(table.value().rows)) {
      progress_.update("meshes", static_cast<double>(tried++) / static_cast<double>(meshes_.size()));
      if (interrupted()) return stopped_batch();
      if (Status status = run_mesh(meshes_[next]); !status) {
        progress_.clear();
        return status.error().code == ErrorCode::kInterrupted ? Status(stopped_batch()) : status;
      }
    }
    progress_.clear();
    leave_device(shared_.context);
    return conclude();
  }

 private:
  struct Outcome {
    bool is_kept = false;     ///< An earlier run has done the same.
    bool is_writing = false;  ///< Some of its files may be there.
    bool has_files = false;   ///< All of them are.
  };

  std::string stem_of(const BatchMesh& mesh) const { return folder_.path_of(mesh.name); }
  Options options_of(const BatchMesh& mesh) const { return options_of_mesh(options_.each, mesh.file, stem_of(mesh)); }

  /// The endings of the files that earlier runs may have left of a mesh.
  std::string earlier_files(const BatchMesh& mesh) const {
    const auto before = rows_.find(file_key(mesh.name));
    return before == rows_.end() ? std::string() : before->second[BatchColumn::kFiles];
  }

  /// No result may replace a mesh, and none is removed that has become one.
  Status check_files() const {
    std::unordered_map<std::string, const BatchMesh*> inputs;
    for (const BatchMesh& mesh : meshes_) inputs.emplace(file_key(mesh.real), &mesh);
    for (const BatchMesh& mesh : meshes_) {
      const std::string stem = stem_of(mesh);
      const std::string endings = endings_of_both(earlier_files(mesh), endings_of(options_of(mesh), stem));
      for (const std::string& path : paths_of_results(stem, endings)) {
        if (const auto replaced = inputs.find(file_key(real_path(path))); replaced != inputs.end()) {
          return Error{ErrorCode::kUsage,
                       fmt::format("a result of {} would overwrite the mesh {}", mesh.file, replaced->second->file)};
        }
      }
    }
    return {};
  }

  /// The results of a mesh are not replaced by those of another one that happens to have its name.
  Status check_sources() const {
    for (const BatchMesh& mesh : meshes_) {
      const auto before = rows_.find(file_key(mesh.name));
      if (before == rows_.end()) continue;
      const std::string& file = before->second[BatchColumn::kFile];
      std::error_code error;
      if (file.empty() || file_key(file) == file_key(without_line_ends(mesh.real))) continue;
      if (!fs::exists(platform::path_of(file), error)) continue;
      return Error{ErrorCode::kUsage,
                   fmt::format("{} has results of {} with the name {}, and {} is another file: name another folder "
                               "with -o",
                               options_.output, file, mesh.name, mesh.file)};
    }
    return {};
  }

  void tell_of_damage(std::span<const std::uint64_t> lines) const {
    if (lines.empty()) return;
    const std::string others = lines.size() == 1 ? "" : fmt::format(", like {} others,", grouped(lines.size() - 1));
    print_message(fmt::format("{}:{}: this line{} is damaged, and its mesh is done again\n", folder_.table_path(),
                              lines.front(), others));
  }

  /// Meshes that were at work when a run ended come last, that of the oldest such run first: one that ends every run
  /// then keeps no other from its turn. `rows` are in the order of their lines.
  std::vector<std::size_t> in_order(std::span<const BatchRow> rows) const {
    std::unordered_map<std::string, std::size_t> turn_of;
    for (const BatchRow& row : rows) {
      if (row.is_at_work()) turn_of.emplace(file_key(row[BatchColumn::kName]), turn_of.size() + 1);
    }
    std::vector<std::size_t> order(meshes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
      const auto turn = turn_of.find(file_key(meshes_[i].name));
      return turn == turn_of.end() ? std::size_t{0} : turn->second;
    });
    return order;
  }

  /// Failures of the mesh become its row.
  Status run_mesh(const BatchMesh& mesh) {
    Stopwatch stopwatch;
    BatchRow row;
    row[BatchColumn::kName] = mesh.name;
    row[BatchColumn::kFile] = mesh.real;
    row[BatchColumn::kOptions] = options_.given;
    row[BatchColumn::kVersion] = version();
    Outcome outcome;
    Status status;
    try {
      status = make_results(mesh, row, outcome);
    } catch (const std::bad_alloc&) {
      status = Error{ErrorCode::kOutOfMemory, "out of memory; try a lower --resolution"};
    } catch (const std::exception& error) {
      status = Error{ErrorCode::kInternal, fmt::format("internal error: {}", error.what())};
    }
    if (!status && ends_batch(status.error().code)) return status;
    if (outcome.is_kept) {
      ++kept_;
      return status;
    }
    // Results of an earlier run, whose mesh or options were others, are no results of this one.
    if (!outcome.has_files) {
      remove_results(stem_of(mesh), outcome.is_writing ? row[BatchColumn::kFiles] : earlier_files(mesh));
      row[BatchColumn::kFiles].clear();
    }
    row[BatchColumn::kSeconds] = fmt::format("{:.6f}", stopwatch.lap());
    row[BatchColumn::kState] = status ? kBatchDone : kBatchFailed;
    if (!status) take_failure(status.error(), row);
    if (Status appended = folder_.append(row); !appended) return appended;
    tell(mesh, row);
    rows_.insert_or_assign(file_key(mesh.name), std::move(row));
    return {};
  }

  void take_failure(const Error& error, BatchRow& row) {
    row[BatchColumn::kError] = in_words_of_options(error.message, Command::kBatch);
    row[BatchColumn::kError] = without_line_ends(std::move(row[BatchColumn::kError]));
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

  Status make_results(const BatchMesh& mesh, BatchRow& row, Outcome& outcome) {
    if (!mesh.fault.empty()) return Error{ErrorCode::kInvalidMesh, mesh.fault};
    const Options of_mesh = options_of(mesh);
    // A mesh that is done already is read to compare its content, and is done if that is the same.
    BatchRow* const done = done_before(row, of_mesh);
    if (Status status = done ? append_again(*done, kBatchReading) : begin(mesh, of_mesh, row); !status) return status;
    shared_.times.clear();
    Result<std::vector<ScenePart>> parts = read_meshes(mesh.file, false, shared_.times);
    if (!parts) return parts.error();
    Mesh& read = parts.value().front().mesh;
    const std::string content = mesh_digest(read);
    outcome.is_kept = done && (*done)[BatchColumn::kContent] == content;
    if (outcome.is_kept) return append_again(*done, kBatchDone);
    if (done) {
      if (Status status = begin(mesh, of_mesh, row); !status) return status;
    }
    row[BatchColumn::kContent] = content;
    if (!is_open_ && options_.each.backend == Backend::kVulkan) {
      shared_.opening.start(options_.each.device, options_.each.threads, progress_);
      is_open_ = true;
    }
    MeshRun run(of_mesh, "", shared_);
    bool has_points = false;
    Status status = search(run, std::move(read), has_points);
    fill_row(run.record(), has_points, row);
    if (!status) return status;
    outcome.is_writing = true;
    if (status = write_results(mesh, run.files()); !status) return status;
    outcome.has_files = true;
    row[BatchColumn::kFiles] = endings_of(of_mesh, stem_of(mesh));
    if (status = verdict(run.record().boundary.walls); !status) return status;
    return run.record().check ? verdict(*run.record().check) : Status();
  }

  /// An earlier line counts again, or until another one follows, with this state.
  Status append_again(BatchRow& before, std::string_view state) {
    before[BatchColumn::kState] = state;
    return folder_.append(before);
  }

  /// From here on no earlier line of the mesh counts: its files change.
  Status begin(const BatchMesh& mesh, const Options& of_mesh, BatchRow& row) {
    row[BatchColumn::kState] = kBatchStarted;
    row[BatchColumn::kFiles] = endings_of_both(earlier_files(mesh), endings_of(of_mesh, stem_of(mesh)));
    return folder_.append(row);
  }

  Status write_results(const BatchMesh& mesh, std::span<const OutputFile> files) const {
    const std::string stem = stem_of(mesh);
    remove_results(stem, earlier_files(mesh));
    std::error_code error;
    fs::create_directories(platform::path_of(stem).parent_path(), error);  // write_files() tells what is wrong
    return write_files(files);
  }

  static Status search(MeshRun& run, Mesh mesh, bool& has_points) {
    if (Status status = run.load(std::move(mesh)); !status) return status;
    if (Status status = run.take_device(); !status) return status;
    if (Status status = run.analyse_mesh(); !status) return status;
    has_points = true;
    if (Status status = run.measure(); !status) return status;
    return run.make_files();
  }

  /// The line of an earlier run that has done the same on a mesh of this name, whose files are there; none: nullptr.
  BatchRow* done_before(const BatchRow& row, const Options& of_mesh) {
    const auto before = rows_.find(file_key(row[BatchColumn::kName]));
    if (before == rows_.end() || !before->second.has_results()) return nullptr;
    for (const BatchColumn column : {BatchColumn::kOptions, BatchColumn::kVersion}) {
      if (before->second[column] != row[column]) return nullptr;
    }
    const bool has_files = std::ranges::all_of(outputs_of(of_mesh), [](const NamedOutput& output) {
      std::error_code error;
      return output.file->empty() || fs::exists(platform::path_of(*output.file), error);
    });
    return has_files ? &before->second : nullptr;
  }

  Status conclude() {
    std::vector<BatchRow> rows;
    rows.reserve(rows_.size());
    std::size_t failed = 0;
    for (const BatchMesh& mesh : meshes_) {
      rows.push_back(std::move(rows_.extract(file_key(mesh.name)).mapped()));
      failed += rows.back().is_done() ? 0 : 1;
    }
    // Meshes of earlier runs that were not among the inputs of this one.
    std::vector<BatchRow> others;
    for (auto& [key, row] : rows_) others.push_back(std::move(row));
    std::ranges::sort(others, {}, [](const BatchRow& row) { return row[BatchColumn::kName]; });
    std::ranges::move(others, std::back_inserter(rows));
    if (Status status = folder_.replace_table(rows); !status) return status;
    if (options_.page) {
      if (Status status = write_page(folder_, std::span(rows).first(meshes_.size())); !status) return status;
    }
    if (!options_.each.quiet) print_message(batch_summary(failed));
    if (failed == 0) return {};
    return Error{kSomeFailed, fmt::format("{} of {} failed: {} has the reasons", grouped(failed),
                                          counted(meshes_.size(), "mesh", "meshes"), folder_.table_path())};
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
  std::unordered_map<std::string, BatchRow> rows_;  ///< By the key of the name, of earlier runs and of this one.
  std::size_t kept_ = 0;
};

}  // namespace

Status run_batch(const std::vector<std::string>& arguments) {
  const Result<BatchOptions> options = parse_batch_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(batch_help_text());
  if (options.value().merge) return merge_batches(options.value());
  Result<std::vector<BatchMesh>> meshes = find_meshes(options.value().inputs, options.value().output);
  if (!meshes) return meshes.error();
  if (options.value().list) return print_list(meshes.value());
  Result<BatchFolder> folder = BatchFolder::open(options.value().output);
  if (!folder) return folder.error();
  platform::return_large_blocks();
  return BatchRun(options.value(), std::move(meshes).value(), std::move(folder).value()).run();
}

}  // namespace medial_vk::cli
