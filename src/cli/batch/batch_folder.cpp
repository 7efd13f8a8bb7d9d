#include "cli/batch/batch_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "common/tool_errors.h"
#include "input/csv_lines.h"
#include "output/atomic_files/atomic_file.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

/// Nothing can be written without the folder and its table.
Error folder_error(const std::string& path, int reason) {
  return {kDiskFails, fmt::format("cannot write {}: {}", path, std::generic_category().message(reason))};
}

}  // namespace

Result<BatchFolder> BatchFolder::open(const std::string& path) {
  std::error_code error;
  fs::create_directories(platform::path_of(path), error);
  if (error) return folder_error(path, error.default_error_condition().value());
  BatchFolder folder;
  folder.path_ = path;
  if (Status status = check_writable(folder.table_path()); !status) return status.error();
  const std::string lock = folder.path_of(".medial-vk.lock");
  const int reason = folder.lock_.lock(lock);
  if (reason == EWOULDBLOCK) return Error{kDiskFails, fmt::format("another medial-vk batch is writing to {}", path)};
  if (reason != 0) return folder_error(lock, reason);
  return folder;
}

std::string BatchFolder::path_of(const std::string& name) const {
  return platform::text_of(platform::path_of(path_) / platform::path_of(name));
}

Result<BatchTable> BatchFolder::read_rows() const {
  std::error_code error;
  if (!fs::exists(platform::path_of(table_path()), error)) return BatchTable();
  const Result<std::string> bytes = read_table(table_path());
  if (!bytes) return bytes.error();
  Result<BatchTable> table = decode_batch_table(bytes.value());
  if (table) return table;
  return Error{ErrorCode::kUsage,
               fmt::format("{}: {}; remove it, or name another folder with -o", table_path(), table.error().message)};
}

Status BatchFolder::replace_table(std::span<const BatchRow> rows) {
  std::string bytes = batch_table_header();
  for (const BatchRow& row : rows) bytes += encode_batch_row(row);
  table_.close();  // an open file is not replaced on Windows
  const OutputFile file = {table_path(), std::move(bytes)};
  if (Status status = write_files({&file, 1}); !status) return Error{kDiskFails, status.error().message};
  const int reason = table_.open(table_path());
  return reason != 0 ? Status(folder_error(table_path(), reason)) : Status();
}

Status BatchFolder::append(const BatchRow& row) {
  const int reason = table_.append(encode_batch_row(row));
  return reason != 0 ? Status(folder_error(table_path(), reason)) : Status();
}

}  // namespace medial_vk::cli
