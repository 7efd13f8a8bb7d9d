// Files and standard streams, as far as systems differ. Reasons are numbers of errno on every system.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace medial_vk::platform {

/// Why a call of the system failed; the code 0: it did not. `what` precedes the reason in messages: "permissions: ".
struct Fault {
  int code = 0;
  std::string what = {};
};

inline constexpr int kStandardOutput = 1, kStandardError = 2;

/// Opens a file to be read as bytes. Null: errno says why.
std::FILE* open_to_read(const std::string& path);

/// The length of a regular file; 0 for streams and devices, whose length is unknown.
std::uint64_t length_of_regular(std::FILE* file);

/// Writes until all bytes are written. False: errno says why. May be called in a handler of signals.
bool write_all(int descriptor, std::string_view bytes);

/// The same text for all paths that this system, as it is by default, takes for one: on Windows, where case does not
/// matter. Whether two existing files are one, std::filesystem::equivalent() tells.
std::string file_key(const std::string& path);

/// Removes a file if it is there, and is no folder.
void remove_file(const std::string& path);

/// True if the reason is the disk, and not the file: it is full, over its quota, read-only or faulty.
bool is_of_disk(int code);

/// Whether a file of that path can be made or replaced, as far as that can be told without making one.
Fault check_target(const std::string& path);

/// Whether a name matches a pattern of the shell: `*`, `?` and `[a-z]`, none of which stands for a dot at the
/// beginning.
bool matches_pattern(const std::string& name, const std::string& pattern);

/// Makes a file in the folder and removes it. 0, or why that failed.
int try_to_write(const std::string& folder);

/// A file that is written without its name, which it gets by publish(). A process that is killed before leaves nothing
/// behind. A symbolic link is followed; a target that exists and is no regular file is written directly. One after the
/// other: create(), write(), finish(), publish().
class NewFile {
 public:
  NewFile() = default;
  NewFile(NewFile&& other) noexcept
      : target_(std::move(other.target_)),
        temporary_(std::exchange(other.temporary_, {})),
        unnamed_(std::exchange(other.unnamed_, false)),
        handle_(std::exchange(other.handle_, kNone)) {}
  NewFile& operator=(NewFile&& other) noexcept {
    std::swap(target_, other.target_);
    std::swap(temporary_, other.temporary_);
    std::swap(unnamed_, other.unnamed_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~NewFile() { discard(); }

  /// `may_be_unnamed` false: behaves as if the system had no files without names.
  Fault create(const std::string& path, bool may_be_unnamed);
  Fault write(std::string_view bytes);
  /// Flushes to the disk, so that a full disk is detected before the file has a name.
  Fault finish();
  Fault publish();

 private:
  static constexpr std::intptr_t kNone = -1;
  void discard();
  Fault name_it();

  std::string target_;     // with symbolic links resolved
  std::string temporary_;  // empty if written directly, without a name, or published
  bool unnamed_ = false;
  std::intptr_t handle_ = kNone;
};

/// A file that no other process can lock meanwhile.
class LockedFile {
 public:
  LockedFile() = default;
  LockedFile(LockedFile&& other) noexcept : handle_(std::exchange(other.handle_, kNone)) {}
  LockedFile& operator=(LockedFile&&) = delete;
  ~LockedFile();

  /// Makes the file if there is none, and locks it, unless the file system has no locks that others could hold. 0,
  /// EWOULDBLOCK if another process holds the lock, or the reason.
  int lock(const std::string& path);

 private:
  static constexpr std::intptr_t kNone = -1;
  std::intptr_t handle_ = kNone;
};

/// A file whose end moves: a killed process leaves all that was appended before.
class AppendedFile {
 public:
  AppendedFile() = default;
  AppendedFile(AppendedFile&& other) noexcept : handle_(std::exchange(other.handle_, kNone)) {}
  AppendedFile& operator=(AppendedFile&&) = delete;
  ~AppendedFile() { close(); }

  int open(const std::string& path);  ///< An existing file; one that was open before is closed. 0, or the reason.
  int append(std::string_view bytes);
  void close();

 private:
  static constexpr std::intptr_t kNone = -1;
  std::intptr_t handle_ = kNone;
};

}  // namespace medial_vk::platform
