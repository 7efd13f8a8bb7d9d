// Output files appear whole or not at all: a file in the same folder without a name (O_TMPFILE; under a temporary name
// where there is no such thing), then a link or a rename. A process that is killed leaves nothing
// behind (but for the moment between a link and the rename that replaces a file).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "medial_vk/result.h"

namespace medial_vk {

/// A file being written without its name. Until publish() nothing is seen under that, and what was there before stays;
/// the destructor removes the file. A symbolic link is followed. A target that exists and is no regular file
/// (/dev/null, a pipe) is written in place, as renaming over it would destroy it.
class AtomicFile {
 public:
  /// `may_be_unnamed` false: as where there is no O_TMPFILE. Errors (all calls): kCannotWrite with the path and the
  /// system's reason.
  static Result<AtomicFile> create(const std::string& path, bool may_be_unnamed = true);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();

  Status write(std::string_view bytes);
  /// Flushes to the disk, so that a full disk is noticed before there is a name. No write() after it.
  Status finish();
  /// Gives the file its name, replacing what was there. Call after finish().
  Status publish();

 private:
  AtomicFile() = default;
  Status name_it();
  Error cannot_write(const char* what, int system_error) const;
  void discard();

  std::string path_;       // As the caller named it: for messages.
  std::string target_;     // With symbolic links resolved: what is renamed to.
  std::string temporary_;  // Empty: written in place, without a name, or published.
  bool unnamed_ = false;
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
