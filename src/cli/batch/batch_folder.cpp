#include "cli/batch/batch_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "common/tool_errors.h"
#include "input/csv_lines.h"
#include "output/atomic_files/atomic_file.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

Error folder_error(const std::string& path, int reason) {
  return {kCannotWrite, fmt::format("cannot write {}: {}", path, std::generic_category().message(reason))};
}

}  // namespace

Result<BatchFolder> BatchFolder::open(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return folder_error(path, error.value());
  BatchFolder folder;
  folder.path_ = path;
  if (Status status = check_writable(folder.table_path()); !status) return status.error();
  folder.lock_ = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder.lock_ < 0) return folder_error(path, errno);
  // File systems without locks have none to be held by others.
  if (::flock(folder.lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    return Error{kCannotWrite, fmt::format("another medial-vk batch is writing to {}", path)};
  }
  return folder;
}

BatchFolder::BatchFolder(BatchFolder&& other) noexcept
    : path_(std::move(other.path_)), lock_(std::exchange(other.lock_, -1)), table_(std::exchange(other.table_, -1)) {}

BatchFolder::~BatchFolder() {
  for (const int descriptor : {table_, lock_}) {
    if (descriptor >= 0) ::close(descriptor);
  }
}

std::string BatchFolder::path_of(const std::string& name) const { return (fs::path(path_) / name).string(); }

Result<std::vector<BatchRow>> BatchFolder::read_rows() const {
  std::error_code error;
  if (!fs::exists(table_path(), error)) return std::vector<BatchRow>();
  const Result<std::string> bytes = read_table(table_path());
  if (!bytes) return bytes.error();
  Result<std::vector<BatchRow>> rows = decode_batch_table(bytes.value());
  if (rows) return rows;
  return Error{ErrorCode::kUsage,
               fmt::format("{}: {}; remove it, or name another folder with -o", table_path(), rows.error().message)};
}

Status BatchFolder::replace_table(std::span<const BatchRow> rows) {
  std::string bytes = batch_table_header();
  for (const BatchRow& row : rows) bytes += encode_batch_row(row);
  const OutputFile file = {table_path(), std::move(bytes)};
  if (Status status = write_files({&file, 1}); !status) return status;
  if (table_ >= 0) ::close(table_);
  table_ = ::open(table_path().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  return table_ < 0 ? Status(folder_error(table_path(), errno)) : Status();
}

Status BatchFolder::append(const BatchRow& row) {
  const std::string line = encode_batch_row(row);
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t written = ::write(table_, line.data() + done, line.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return folder_error(table_path(), errno);
    done += static_cast<std::size_t>(written);
  }
  return {};
}

}  // namespace medial_vk::cli
