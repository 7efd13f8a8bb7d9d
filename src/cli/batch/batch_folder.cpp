#include "cli/batch/batch_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "common/tool_errors.h"
#include "input/csv_lines.h"
#include "output/atomic_files/atomic_file.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

/// Nothing can be written without the folder and its table.
Error folder_error(const std::string& path, int reason) {
  return {kDiskFails, fmt::format("cannot write {}: {}", path, std::generic_category().message(reason))};
}

/// On NFS a file is locked as a whole, for which it must be open to write. 0: the lock is held, or the file system has
/// none that others could hold.
int take_lock(int file) {
  while (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (errno == ENOLCK || errno == ENOTSUP || errno == ENOSYS) return 0;
    if (errno != EINTR) return errno;
  }
  return 0;
}

}  // namespace

Result<BatchFolder> BatchFolder::open(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return folder_error(path, error.value());
  BatchFolder folder;
  folder.path_ = path;
  if (Status status = check_writable(folder.table_path()); !status) return status.error();
  const std::string lock = folder.path_of(".medial-vk.lock");
  folder.lock_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (folder.lock_ < 0) return folder_error(lock, errno);
  const int reason = take_lock(folder.lock_);
  if (reason == EWOULDBLOCK) return Error{kDiskFails, fmt::format("another medial-vk batch is writing to {}", path)};
  if (reason != 0) return folder_error(lock, reason);
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

Result<BatchTable> BatchFolder::read_rows() const {
  std::error_code error;
  if (!fs::exists(table_path(), error)) return BatchTable();
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
  const OutputFile file = {table_path(), std::move(bytes)};
  if (Status status = write_files({&file, 1}); !status) return Error{kDiskFails, status.error().message};
  if (table_ >= 0) ::close(table_);
  table_ = ::open(table_path().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  return table_ < 0 ? Status(folder_error(table_path(), errno)) : Status();
}

Status BatchFolder::append(const BatchRow& row) {
  if (write_all(table_, encode_batch_row(row))) return {};
  return folder_error(table_path(), errno);
}

}  // namespace medial_vk::cli
