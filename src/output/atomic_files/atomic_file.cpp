#include "output/atomic_files/atomic_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "common/absent_parts.h"
#include "common/tool_errors.h"
#include "platform/files.h"

namespace medial_vk {
namespace {

Error write_error(const std::string& path, const platform::Fault& fault) {
  return {platform::is_of_disk(fault.code) ? kDiskFails : kCannotWrite,
          fmt::format("cannot write {}: {}{}", path, fault.what, std::strerror(fault.code))};
}

Status write_standard_output(std::string_view bytes) {
  if (platform::write_all(platform::kStandardOutput, bytes)) return {};
  return write_error("to standard output", {errno});
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const std::string& path, bool may_be_unnamed) {
  AtomicFile file;
  file.path_ = path;
  if (Status status = file.status_of(file.file_.create(path, may_be_unnamed)); !status) return status.error();
  return file;
}

Status AtomicFile::status_of(const platform::Fault& fault) const {
  return fault.code == 0 ? Status() : Status(write_error(path_, fault));
}

Status AtomicFile::write(std::string_view bytes) { return status_of(file_.write(bytes)); }
Status AtomicFile::finish() { return status_of(file_.finish()); }
Status AtomicFile::publish() { return status_of(file_.publish()); }

Status write_files(std::span<const OutputFile> files) {
  std::vector<AtomicFile> finished;
  for (const OutputFile& file : files) {
    if (file.path == "-") continue;
    Result<AtomicFile> atomic = AtomicFile::create(file.path);
    if (!atomic) return atomic.error();
    if (Status status = atomic.value().write(file.bytes); !status) return status;
    if (Status status = atomic.value().finish(); !status) return status;
    finished.push_back(std::move(atomic).value());
  }
  for (const OutputFile& file : files) {
    if (file.path != "-") continue;
    if (Status status = write_standard_output(file.bytes); !status) return status;
  }
  for (AtomicFile& file : finished) {
    if (Status status = file.publish(); !status) return status;
  }
  return {};
}

Status check_writable(const std::string& path) {
  if (path == "-") return {};
  if (Status status = check_format_is_built(path); !status) return status;
  const platform::Fault fault = platform::check_target(path);
  return fault.code == 0 ? Status() : Status(write_error(path, fault));
}

}  // namespace medial_vk
