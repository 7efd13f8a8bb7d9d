#include "output/atomic_files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "common/tool_errors.h"

namespace medial_vk {

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

namespace {

namespace fs = std::filesystem;

/// Whether the reason is the disk, and not the file.
bool is_of_disk(int system_error) {
  return system_error == ENOSPC || system_error == EDQUOT || system_error == EROFS || system_error == EIO;
}

Error write_error(const std::string& path, const char* what, int system_error) {
  return {is_of_disk(system_error) ? kDiskFails : kCannotWrite,
          fmt::format("cannot write {}: {}{}", path, what, std::strerror(system_error))};
}

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// The file behind `path` if it is a symbolic link to an existing one, else `path`.
std::string follow_links(const std::string& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path real = fs::canonical(path, error);
  return error ? path : real.string();
}

/// A replaced file keeps its permissions; a new one gets the default ones, which mkstemp does not give.
mode_t permissions_for(const std::string& target) {
  struct stat existing = {};
  if (stat(target.c_str(), &existing) == 0) return existing.st_mode & 07777;
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

/// A template for mkostemp, independent of the target's name, which with a suffix could exceed the longest name of a
/// folder.
std::string temporary_name(const std::string& target) { return folder_of(target) + "/.medial-vk.XXXXXX"; }

/// The same name with letters instead of its six X, different each time.
std::string random_name(const std::string& target) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::string name = temporary_name(target);
  std::random_device random;
  for (std::size_t i = name.size() - 6; i < name.size(); ++i) name[i] = kLetters[random() % kLetters.size()];
  return name;
}

std::string self_path(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

/// For the effective user of the process, who creates files, not the user who started it.
bool may(const std::string& path, int mode) { return ::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) == 0; }

Status write_standard_output(std::string_view bytes) {
  if (write_all(STDOUT_FILENO, bytes)) return {};
  return write_error("to standard output", "", errno);
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const std::string& path, bool may_be_unnamed) {
  AtomicFile file;
  file.path_ = path;
  file.target_ = follow_links(path);
  struct stat existing = {};
  if (stat(file.target_.c_str(), &existing) == 0 && !S_ISREG(existing.st_mode)) {
    file.descriptor_ = ::open(file.target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file.descriptor_ < 0) return file.cannot_write("", errno);
    return file;
  }
  const std::string folder = folder_of(file.target_);
  if (may_be_unnamed) file.descriptor_ = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  // The file is named through /proc, which a jail may lack.
  if (file.descriptor_ >= 0 && !may(self_path(file.descriptor_), F_OK)) ::close(std::exchange(file.descriptor_, -1));
  file.unnamed_ = file.descriptor_ >= 0;
  if (!file.unnamed_) {
    std::string name = temporary_name(file.target_);
    file.descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (file.descriptor_ < 0) return file.cannot_write("", errno);
    file.temporary_ = std::move(name);
  }
  if (::fchmod(file.descriptor_, permissions_for(file.target_)) != 0) return file.cannot_write("permissions: ", errno);
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      unnamed_(std::exchange(other.unnamed_, false)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(target_, other.target_);
  std::swap(temporary_, other.temporary_);
  std::swap(unnamed_, other.unnamed_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

AtomicFile::~AtomicFile() { discard(); }

Error AtomicFile::cannot_write(const char* what, int system_error) const {
  return write_error(path_, what, system_error);
}

void AtomicFile::discard() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(std::exchange(temporary_, {}).c_str());
}

Status AtomicFile::write(std::string_view bytes) {
  if (write_all(descriptor_, bytes)) return {};
  return cannot_write("", errno);
}

Status AtomicFile::finish() {
  // fsync is undefined for pipes and devices, and some file systems do not support it; neither is an error.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) return cannot_write("", errno);
  if (unnamed_) return {};  // closing would delete it
  if (::close(std::exchange(descriptor_, -1)) != 0) return cannot_write("", errno);
  return {};
}

// A link cannot replace a file: if one exists, the new file has a temporary name between the link and the rename. A
// process killed in that moment leaves it behind, as a complete file.
Status AtomicFile::name_it() {
  const std::string self = self_path(descriptor_);
  const auto link_to = [&](const std::string& name) {
    return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  if (!link_to(target_)) {
    if (errno != EEXIST) return cannot_write("", errno);
    constexpr int kTries = 100;
    std::string name = random_name(target_);
    for (int i = 1; !link_to(name); ++i) {
      if (errno != EEXIST || i == kTries) return cannot_write("", errno);
      name = random_name(target_);
    }
    temporary_ = std::move(name);
  }
  unnamed_ = false;
  if (::close(std::exchange(descriptor_, -1)) != 0) return cannot_write("", errno);
  return {};
}

Status AtomicFile::publish() {
  if (unnamed_) {
    if (Status named = name_it(); !named) return named;
  }
  if (temporary_.empty()) return {};
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return cannot_write("", errno);
  temporary_.clear();
  return {};
}

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
  struct stat existing = {};
  const bool exists = stat(path.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode)) return write_error(path, "", EISDIR);
  if (exists && !S_ISREG(existing.st_mode)) {
    return may(path, W_OK) ? Status() : Status(write_error(path, "", errno));
  }
  const std::string folder = folder_of(follow_links(path));
  if (!may(folder, W_OK | X_OK)) return write_error(path, fmt::format("folder {}: ", folder).c_str(), errno);
  return {};
}

}  // namespace medial_vk
