// The table of `medial-vk batch` (docs/formats.md): a line for each mesh. It is written line by line while meshes are
// done, and read again by the next run, which goes on from it.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk {

/// The columns, in their order.
enum class BatchColumn {
  kName,
  kState,
  kError,
  kTriangles,
  kClosed,
  kLongestSide,
  kVolume,
  kPoints,
  kSheets,
  kUndecided,
  kLeastRadius,
  kGreatestRadius,
  kBallsVolume,
  kBallsArea,
  kSecondsRead,
  kSecondsPrepare,
  kSecondsSearch,
  kSeconds,
  kDevice,
  kContent,
  kOptions,
  kVersion,
};
inline constexpr std::size_t kBatchColumns = static_cast<std::size_t>(BatchColumn::kVersion) + 1;

/// The state of a mesh whose files are written, and of one without files.
inline constexpr std::string_view kBatchDone = "done", kBatchFailed = "failed";

/// A line of the table as texts; an empty one is unknown or has not been measured. No text contains a line break:
/// encode_batch_row() writes a space instead.
struct BatchRow {
  std::array<std::string, kBatchColumns> texts;

  std::string& operator[](BatchColumn column) { return texts[static_cast<std::size_t>(column)]; }
  const std::string& operator[](BatchColumn column) const { return texts[static_cast<std::size_t>(column)]; }
  bool is_done() const { return (*this)[BatchColumn::kState] == kBatchDone; }
  bool operator==(const BatchRow&) const = default;
};

/// The first line: the names of the columns.
std::string batch_table_header();

/// A line with its end. Texts with commas or quotes are quoted as RFC 4180 says.
std::string encode_batch_row(const BatchRow& row);

/// The rows of a table, in its order; an end that was cut off by a kill is left out. A table may have several lines of
/// a mesh: the last one counts, and is the only one returned. Error: kInvalidMesh with the line, if the bytes are no
/// such table.
Result<std::vector<BatchRow>> decode_batch_table(std::string_view bytes);

}  // namespace medial_vk
