// Output files appear whole or not at all: a temporary file in the same folder, then rename.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "medial_vk/result.h"

namespace medial_vk {

/// A file being written under a temporary name. Until publish() nothing is seen under its own name, and what was there
/// before stays; the destructor removes the temporary file. A symbolic link is followed. A target that exists and is
/// no regular file (/dev/null, a pipe) is written in place, as renaming over it would destroy it.
class AtomicFile {
 public:
  /// Errors (all calls): kCannotWrite with the path and the system's reason.
  static Result<AtomicFile> create(const std::string& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();

  Status write(std::string_view bytes);
  /// Flushes to the disk and closes, so that a full disk is noticed before the rename. No write() after it.
  Status finish();
  /// Gives the file its name, replacing what was there. Call after finish().
  Status publish();

 private:
  AtomicFile() = default;
  Error cannot_write(const char* what, int system_error) const;
  void discard();

  std::string path_;       // As the caller named it: for messages.
  std::string target_;     // With symbolic links resolved: what is renamed to.
  std::string temporary_;  // Empty: written in place, or published.
  int descriptor_ = -1;
};

struct OutputFile {
  std::string path;  ///< "-": standard output.
  std::string bytes;
};

/// Writes all files or none: every byte is on disk before the first rename. Errors: kCannotWrite.
Status write_files(std::span<const OutputFile> files);

/// A test before hours of work: is there a folder to write `path` to, and is `path` no folder? Creates nothing.
/// Errors: kCannotWrite.
Status check_writable(const std::string& path);

}  // namespace medial_vk
