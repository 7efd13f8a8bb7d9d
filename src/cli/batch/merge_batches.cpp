#include "cli/batch/merge_batches.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "cli/batch/batch_folder.h"
#include "cli/batch/find_meshes.h"
#include "cli/batch/page_file.h"
#include "cli/batch/result_files.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"
#include "common/file_extension.h"
#include "common/tool_errors.h"
#include "input/csv_lines.h"
#include "output/atomic_files/atomic_file.h"
#include "platform/files.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;
using platform::file_key;
using platform::path_of;
using platform::text_of;

/// A line of a table, and the folder with its files.
struct Merged {
  BatchRow row;
  std::string folder;
};

Error unusable(const std::string& path, const std::string& reason) {
  return {ErrorCode::kInvalidMesh, fmt::format("{}: {}", path, reason)};
}

/// Folders are named as meshes are: one by one, or in the lines of a .txt, from its folder.
Result<std::vector<std::string>> folders_of(const std::vector<std::string>& inputs) {
  std::vector<std::string> folders;
  for (const std::string& input : inputs) {
    if (file_extension(input) != ".txt" && input != "-") {
      folders.push_back(input);
      continue;
    }
    const Result<std::string> text = read_table(input);
    if (!text) return text.error();
    const fs::path beside = input == "-" ? fs::path() : path_of(input).parent_path();
    for (CsvLines lines(text.value()); lines.next();) folders.push_back(text_of(beside / path_of(lines.line())));
  }
  return folders;
}

/// A name that leads out of the folder is none that this program writes.
bool stays_in_folder(const std::string& name) {
  const fs::path normal = path_of(name).lexically_normal();
  return !normal.empty() && !normal.has_root_path() && text_of(normal) == name && *normal.begin() != "..";
}

void fail(BatchRow& row, std::string reason) {
  row[BatchColumn::kState] = kBatchFailed;
  row[BatchColumn::kError] = std::move(reason);
  row[BatchColumn::kFiles].clear();
}

/// Whether `to` already is `from`, by a link of an earlier merge.
bool is_same_file(const std::string& from, const std::string& to) {
  std::error_code error;
  return fs::equivalent(path_of(from), path_of(to), error) && !error;
}

/// Neither file is ever written to in place, so that both names of it stay whole. A file system without links gets a
/// copy. A link cannot replace a file, which a rename does at once: until then it has the name `temporary`.
Status link_or_copy(const std::string& from, const std::string& to, const std::string& temporary) {
  if (is_same_file(from, to)) return {};
  std::error_code error;
  fs::create_hard_link(path_of(from), path_of(temporary), error);
  if (!error) {
    fs::rename(path_of(temporary), path_of(to), error);
    if (!error) return {};
    platform::remove_file(temporary);
    if (error != std::errc::cross_device_link) {
      return Error{kCannotWrite, fmt::format("cannot write {}: {}", to, error.default_error_condition().message())};
    }
  }
  Result<std::string> bytes = read_table(from);
  if (!bytes) return bytes.error();
  const OutputFile file = {to, std::move(bytes).value()};
  return write_files({&file, 1});
}

constexpr std::string_view kTemporary = ".medial-vk.link.";

/// Of merges that were killed.
void remove_temporary_links(const std::string& folder) {
  std::error_code error;
  fs::directory_iterator at(folder, error);
  for (const fs::directory_iterator end; !error && at != end; at.increment(error)) {
    if (text_of(at->path().filename()).starts_with(kTemporary)) platform::remove_file(text_of(at->path()));
  }
}

class Merge {
 public:
  Merge(const BatchOptions& options, BatchFolder folder) : options_(options), folder_(std::move(folder)) {}

  Status run(const std::vector<std::string>& folders) {
    for (const std::string& folder : folders) {
      if (interrupted()) return stopped();
      if (Status status = add_folder(folder); !status) return status;
    }
    const Result<BatchTable> before = folder_.read_rows();
    if (!before) return before.error();
    for (const BatchRow& row : before.value().rows) {
      if (!stays_in_folder(row[BatchColumn::kName])) {
        return Error{ErrorCode::kUsage, fmt::format("{}: a name leads out of the folder; remove it, or name another "
                                                    "folder with -o",
                                                    folder_.table_path())};
      }
      earlier_.emplace(file_key(row[BatchColumn::kName]), row);
    }
    if (Status status = check_files(); !status) return status;
    if (Status status = begin(); !status) return status;
    remove_temporary_links(options_.output);
    for (const auto& [key, row] : earlier_) {
      if (of_name_.contains(key)) continue;
      remove_results(folder_.path_of(row[BatchColumn::kName]), row[BatchColumn::kFiles]);
    }
    for (Merged& mesh : meshes_) {
      if (interrupted()) return stopped();
      if (Status status = take_files(mesh); !status) return status;
    }
    return conclude();
  }

 private:
  Status add_folder(const std::string& folder) {
    const std::string path = text_of(path_of(folder) / "batch.csv");
    if (real_path(folder) == real_path(options_.output)) {
      return Error{ErrorCode::kUsage,
                   fmt::format("{} is among the folders to merge: name another one with -o", folder)};
    }
    const Result<std::string> bytes = read_table(path);
    if (!bytes) return bytes.error();
    Result<BatchTable> table = decode_batch_table(bytes.value());
    if (!table) return unusable(path, table.error().message);
    if (!table.value().damaged_lines.empty()) {
      return unusable(fmt::format("{}:{}", path, table.value().damaged_lines.front()), "this line is damaged");
    }
    for (BatchRow& row : table.value().rows) {
      if (!stays_in_folder(row[BatchColumn::kName])) return unusable(path, "a name leads out of the folder");
      if (Status status = add_row(std::move(row), folder); !status) return status;
    }
    return {};
  }

  Status add_row(BatchRow row, const std::string& folder) {
    if (row.has_results()) row[BatchColumn::kState] = kBatchDone;
    if (row.is_at_work()) fail(row, "a run ended while it was at work on this mesh");
    const auto [at, is_new] = of_name_.try_emplace(file_key(row[BatchColumn::kName]), meshes_.size());
    if (is_new) {
      meshes_.push_back({std::move(row), folder});
      return {};
    }
    Merged& other = meshes_[at->second];
    if (file_key(other.row[BatchColumn::kFile]) != file_key(row[BatchColumn::kFile])) {
      return Error{ErrorCode::kUsage,
                   fmt::format("the results of {} and {} would have one name, {}", other.row[BatchColumn::kFile],
                               row[BatchColumn::kFile], row[BatchColumn::kName])};
    }
    // Two runs were given the mesh: the first result counts.
    if (row.is_done() && !other.row.is_done()) other = {std::move(row), folder};
    return {};
  }

  std::string earlier_files(const std::string& name) const {
    const auto before = earlier_.find(file_key(name));
    return before == earlier_.end() ? std::string() : before->second[BatchColumn::kFiles];
  }

  /// No result may replace a mesh, and none is removed that has become one.
  Status check_files() const {
    std::unordered_set<std::string> files;
    for (const Merged& mesh : meshes_) files.insert(file_key(mesh.row[BatchColumn::kFile]));
    for (const Merged& mesh : meshes_) {
      const std::string& name = mesh.row[BatchColumn::kName];
      const std::string endings = endings_of_both(earlier_files(name), mesh.row[BatchColumn::kFiles]);
      for (const std::string& path : paths_of_results(folder_.path_of(name), endings)) {
        if (files.contains(file_key(real_path(path)))) {
          return Error{ErrorCode::kUsage, fmt::format("a result of {} would overwrite the mesh {}", name, path)};
        }
      }
    }
    return {};
  }

  /// While files change, the table says of no mesh that it is done, but names all files that may be there: after a kill
  /// another merge, or a run, removes what does not belong to its results.
  Status begin() {
    std::vector<BatchRow> rows;
    rows.reserve(meshes_.size() + earlier_.size());
    for (const Merged& mesh : meshes_) {
      BatchRow row = mesh.row;
      row[BatchColumn::kState] = kBatchStarted;
      row[BatchColumn::kFiles] = endings_of_both(earlier_files(row[BatchColumn::kName]), row[BatchColumn::kFiles]);
      rows.push_back(std::move(row));
    }
    for (const auto& [key, earlier] : earlier_) {
      if (of_name_.contains(key)) continue;
      rows.push_back(earlier);
      rows.back()[BatchColumn::kState] = kBatchStarted;
    }
    return folder_.replace_table(rows);
  }

  /// An earlier merge, or a run, has made the results of this line here.
  bool has_results_of(const BatchRow& row) const {
    const auto before = earlier_.find(file_key(row[BatchColumn::kName]));
    if (before == earlier_.end() || !before->second.has_results()) return false;
    const BatchRow& earlier = before->second;
    for (const BatchColumn column : {BatchColumn::kName, BatchColumn::kContent, BatchColumn::kOptions,
                                     BatchColumn::kVersion, BatchColumn::kFiles}) {
      if (earlier[column] != row[column]) return false;
    }
    std::error_code error;
    return std::ranges::all_of(paths_of_results(folder_.path_of(row[BatchColumn::kName]), row[BatchColumn::kFiles]),
                               [&](const auto& file) { return fs::exists(path_of(file), error); });
  }

  Status take_files(Merged& mesh) {
    BatchRow& row = mesh.row;
    const std::string& name = row[BatchColumn::kName];
    const std::string from = text_of(path_of(mesh.folder) / path_of(name)), to = folder_.path_of(name);
    const std::vector<std::string> sources = paths_of_results(from, row[BatchColumn::kFiles]);
    std::error_code error;
    const auto missing =
        std::ranges::find_if(sources, [&](const auto& file) { return !fs::exists(path_of(file), error); });
    if (missing != sources.end() && has_results_of(row)) return {};
    if (missing != sources.end()) fail(row, fmt::format("its result {} is missing", *missing));
    const std::vector<std::string> targets = paths_of_results(to, row[BatchColumn::kFiles]);
    for (const std::string& path : paths_of_results(to, earlier_files(name))) {
      if (std::ranges::find(targets, path) == targets.end()) platform::remove_file(path);
    }
    fs::create_directories(path_of(to).parent_path(), error);  // link_or_copy() tells what is wrong
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (Status status = link_or_copy(sources[i], targets[i], temporary_); !status) return status;
    }
    return {};
  }

  Status conclude() {
    std::vector<BatchRow> rows;
    rows.reserve(meshes_.size());
    for (Merged& mesh : meshes_) rows.push_back(std::move(mesh.row));
    if (Status status = folder_.replace_table(rows); !status) return status;
    if (options_.page) {
      if (Status status = write_page(folder_, rows); !status) return status;
    }
    const auto failed =
        static_cast<std::size_t>(std::ranges::count_if(rows, [](const BatchRow& row) { return !row.is_done(); }));
    if (!options_.each.quiet) print_message(summary(rows.size() - failed, failed));
    if (failed == 0) return {};
    return Error{kSomeFailed, fmt::format("{} of {} failed: {} has the reasons", grouped(failed),
                                          counted(rows.size(), "mesh", "meshes"), folder_.table_path())};
  }

  std::string summary(std::size_t done, std::size_t failed) {
    std::string meshes = fmt::format("{} done", grouped(done));
    if (failed > 0) meshes += fmt::format(", {} failed", grouped(failed));
    std::string text = labelled("meshes", meshes) + labelled("time", duration(whole_.lap()));
    text += labelled("table", folder_.table_path());
    if (options_.page) text += labelled("page", folder_.page_path());
    return text;
  }

  const BatchOptions& options_;
  BatchFolder folder_;
  std::vector<Merged> meshes_;
  std::unordered_map<std::string, std::size_t> of_name_;  ///< The number in meshes_, by the key of the name.
  std::unordered_map<std::string, BatchRow> earlier_;     ///< By the key of the name: what the folder had before.
  const std::string temporary_ = folder_.path_of(fmt::format("{}{:08x}", kTemporary, std::random_device()()));
  Stopwatch whole_;
};

}  // namespace

Status merge_batches(const BatchOptions& options) {
  const Result<std::vector<std::string>> folders = folders_of(options.inputs);
  if (!folders) return folders.error();
  if (folders.value().empty()) {
    return Error{ErrorCode::kInvalidMesh, fmt::format("there is no folder in {}", fmt::join(options.inputs, ", "))};
  }
  Result<BatchFolder> folder = BatchFolder::open(options.output);
  if (!folder) return folder.error();
  return Merge(options, std::move(folder).value()).run(folders.value());
}

}  // namespace medial_vk::cli
