#include <fcntl.h>
#include <fnmatch.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <random>

#include "platform/files.h"
#include "platform/paths.h"

namespace medial_vk::platform {
namespace {

namespace fs = std::filesystem;

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

std::string self_path(std::intptr_t descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

/// For the effective user of the process, who creates files, not the user who started it.
bool may(const std::string& path, int mode) { return ::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) == 0; }

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

std::FILE* open_to_read(const std::string& path) { return std::fopen(path.c_str(), "rb"); }

std::uint64_t length_of_regular(std::FILE* file) {
  struct stat status = {};
  if (::fstat(::fileno(file), &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  return static_cast<std::uint64_t>(status.st_size);
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string file_key(const std::string& path) { return path; }

void remove_file(const std::string& path) { ::unlink(path.c_str()); }

bool is_of_disk(int code) { return code == ENOSPC || code == EDQUOT || code == EROFS || code == EIO; }

Fault check_target(const std::string& path) {
  struct stat existing = {};
  const bool exists = stat(path.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode)) return {EISDIR};
  if (exists && !S_ISREG(existing.st_mode)) return {may(path, W_OK) ? 0 : errno};
  const std::string folder = folder_of(follow_links(path));
  if (!may(folder, W_OK | X_OK)) return {errno, "folder " + folder + ": "};
  return {};
}

bool matches_pattern(const std::string& name, const std::string& pattern) {
  return ::fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD | FNM_NOESCAPE) == 0;
}

int try_to_write(const std::string& folder) {
  std::string name = folder + "/doctor.XXXXXX";
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) return errno;
  constexpr char kByte = '\n';
  const bool is_written = ::write(file, &kByte, 1) == 1 && ::fsync(file) == 0;
  const int reason = errno;
  ::close(file);
  ::unlink(name.c_str());
  return is_written ? 0 : reason;
}

Fault NewFile::create(const std::string& path, bool may_be_unnamed) {
  target_ = follow_links(path);
  struct stat existing = {};
  if (stat(target_.c_str(), &existing) == 0 && !S_ISREG(existing.st_mode)) {
    handle_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    return {handle_ < 0 ? errno : 0};
  }
  const std::string folder = folder_of(target_);
  if (may_be_unnamed) handle_ = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  // The file is named through /proc, which a jail may lack.
  if (handle_ >= 0 && !may(self_path(handle_), F_OK)) ::close(static_cast<int>(std::exchange(handle_, kNone)));
  unnamed_ = handle_ >= 0;
  if (!unnamed_) {
    std::string name = temporary_name(target_);
    handle_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (handle_ < 0) return {errno};
    temporary_ = std::move(name);
  }
  if (::fchmod(static_cast<int>(handle_), permissions_for(target_)) != 0) return {errno, "permissions: "};
  return {};
}

void NewFile::discard() {
  if (handle_ >= 0) ::close(static_cast<int>(std::exchange(handle_, kNone)));
  if (!temporary_.empty()) ::unlink(std::exchange(temporary_, {}).c_str());
}

Fault NewFile::write(std::string_view bytes) {
  if (write_all(static_cast<int>(handle_), bytes)) return {};
  return {errno};
}

Fault NewFile::finish() {
  // fsync is undefined for pipes and devices, and some file systems do not support it; neither is an error.
  if (::fsync(static_cast<int>(handle_)) != 0 && errno != EINVAL && errno != ENOTSUP) return {errno};
  if (unnamed_) return {};  // closing would delete it
  if (::close(static_cast<int>(std::exchange(handle_, kNone))) != 0) return {errno};
  return {};
}

// A link cannot replace a file: if one exists, the new file has a temporary name between the link and the rename. A
// process killed in that moment leaves it behind, as a complete file.
Fault NewFile::name_it() {
  const std::string self = self_path(handle_);
  const auto link_to = [&](const std::string& name) {
    return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  if (!link_to(target_)) {
    if (errno != EEXIST) return {errno};
    constexpr int kTries = 100;
    std::string name = random_name(target_);
    for (int i = 1; !link_to(name); ++i) {
      if (errno != EEXIST || i == kTries) return {errno};
      name = random_name(target_);
    }
    temporary_ = std::move(name);
  }
  unnamed_ = false;
  if (::close(static_cast<int>(std::exchange(handle_, kNone))) != 0) return {errno};
  return {};
}

Fault NewFile::publish() {
  if (unnamed_) {
    if (Fault fault = name_it(); fault.code != 0) return fault;
  }
  if (temporary_.empty()) return {};
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return {errno};
  temporary_.clear();
  return {};
}

int LockedFile::lock(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  handle_ = file;
  return take_lock(file);
}

LockedFile::~LockedFile() {
  if (handle_ >= 0) ::close(static_cast<int>(handle_));
}

int AppendedFile::open(const std::string& path) {
  close();
  handle_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  return handle_ < 0 ? errno : 0;
}

int AppendedFile::append(std::string_view bytes) { return write_all(static_cast<int>(handle_), bytes) ? 0 : errno; }

void AppendedFile::close() {
  if (handle_ >= 0) ::close(static_cast<int>(std::exchange(handle_, kNone)));
}

}  // namespace medial_vk::platform
