// The folder of the results of `medial-vk batch`, with the table of its meshes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "medial_vk/result.h"
#include "output/batch_files/batch_table.h"
#include "platform/files.h"
#include "platform/paths.h"

namespace medial_vk::cli {

/// While an object exists, no other process has one of the same folder.
class BatchFolder {
 public:
  /// Makes the folder if there is none, and the file .medial-vk.lock in it. Errors: kCannotWrite and kDiskFails,
  /// the latter also while another process works in it.
  static Result<BatchFolder> open(const std::string& path);

  std::string path_of(const std::string& name) const;
  std::string table_path() const { return path_of("batch.csv"); }
  std::string page_path() const { return path_of("batch.html"); }

  /// The table that is there; without rows if there is none. Errors: kUsage if the file is no such table, kInvalidMesh
  /// if it cannot be read.
  Result<BatchTable> read_rows() const;
  /// Replaces the table, whole or not at all. Error: kDiskFails.
  Status replace_table(std::span<const BatchRow> rows);
  /// A line more at the end of the table: a kill leaves all lines before it. Call after replace_table(). Error:
  /// kDiskFails.
  Status append(const BatchRow& row);

 private:
  BatchFolder() = default;

  std::string path_;
  platform::LockedFile lock_;
  platform::AppendedFile table_;
};

}  // namespace medial_vk::cli
