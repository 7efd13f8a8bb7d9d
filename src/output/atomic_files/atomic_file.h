// Output files appear completely or not at all: they are written to an unnamed file in the same folder (O_TMPFILE;
// under a temporary name where that is not supported), which then gets its name by a link or a rename. A killed process
// leaves nothing behind, except between a link and the rename that replaces a file. On Windows the file has a temporary
// name and is deleted when the process ends before that.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "medial_vk/result.h"
#include "platform/files.h"

namespace medial_vk {

/// A file that is written without its name. Until publish() nothing appears under that name, and a previous file stays;
/// the destructor removes the unpublished file. A symbolic link is followed. A target that exists and is no regular
/// file (/dev/null, a pipe) is written directly, because a rename would destroy it.
class AtomicFile {
 public:
  /// `may_be_unnamed` false: behaves as if O_TMPFILE were not supported. Errors (all calls): kCannotWrite with the path
  /// and the reason of the system, or kDiskFails if the disk is full, over its quota, read-only or faulty.
  static Result<AtomicFile> create(const std::string& path, bool may_be_unnamed = true);
  Status write(std::string_view bytes);
  /// Flushes to the disk, so that a full disk is detected before the file has a name. No write() may follow.
  Status finish();
  /// Gives the file its name and replaces a previous file. Call after finish().
  Status publish();

 private:
  AtomicFile() = default;
  Status status_of(const platform::Fault& fault) const;

  std::string path_;  // as the caller named it, for messages
  platform::NewFile file_;
};

struct OutputFile {
  std::string path;  ///< "-": standard output.
  std::string bytes;
};

/// Writes all files or none: every byte is on disk before the first rename. Errors: kCannotWrite,
/// kDiskFails.
Status write_files(std::span<const OutputFile> files);

/// A test before hours of work: the folder of `path` exists, and `path` is no folder. Creates nothing. Errors:
/// kCannotWrite, kDiskFails; kUsage for a format that this build lacks.
Status check_writable(const std::string& path);

}  // namespace medial_vk
