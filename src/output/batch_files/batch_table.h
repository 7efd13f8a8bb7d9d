// The table of `medial-vk batch` (docs/formats.md): a line for each mesh. It is written line by line while meshes are
// done, and read again by the next run, which goes on from it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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
  kFile,
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
  kLeastWallLower,
  kLeastWallUpper,
  kLeastGapLower,
  kLeastGapUpper,
  kThicknessLower,
  kThicknessUpper,
  kSecondsRead,
  kSecondsPrepare,
  kSecondsSearch,
  kSeconds,
  kDevice,
  kFiles,
  kContent,
  kOptions,
  kVersion,
};
inline constexpr std::size_t kBatchColumns = static_cast<std::size_t>(BatchColumn::kVersion) + 1;

/// The states of a mesh. Done: its files are written. Failed: it has none, or they did not pass a check. Started: a run
/// has begun it, and its files may be those of any run. Reading: it was done, and a run reads it to see whether it has
/// changed; all other texts are those of the line that it was done.
inline constexpr std::string_view kBatchDone = "done", kBatchFailed = "failed", kBatchStarted = "started",
                                  kBatchReading = "reading";

/// A line of the table as texts; an empty one is unknown or has not been measured. No text contains a line break:
/// encode_batch_row() writes a space instead.
struct BatchRow {
  std::array<std::string, kBatchColumns> texts;

  std::string& operator[](BatchColumn column) { return texts[static_cast<std::size_t>(column)]; }
  const std::string& operator[](BatchColumn column) const { return texts[static_cast<std::size_t>(column)]; }
  bool is_done() const { return (*this)[BatchColumn::kState] == kBatchDone; }
  /// Its files are those that the line describes.
  bool has_results() const { return is_done() || (*this)[BatchColumn::kState] == kBatchReading; }
  /// A run works on this mesh, or ended while it did.
  bool is_at_work() const {
    return (*this)[BatchColumn::kState] == kBatchStarted || (*this)[BatchColumn::kState] == kBatchReading;
  }
  bool operator==(const BatchRow&) const = default;
};

/// The first line: the names of the columns.
std::string batch_table_header();

/// A line with its end. Texts with commas or quotes are quoted as RFC 4180 says.
std::string encode_batch_row(const BatchRow& row);

struct BatchTable {
  std::vector<BatchRow> rows;                ///< One for each mesh: its last line. In the order of these lines.
  std::vector<std::uint64_t> damaged_lines;  ///< The numbers of lines that are no rows, from 1.
};

/// An end that was cut off by a kill is left out. What a damaged line said is unknown: if its name can be read, an
/// earlier row of that mesh becomes one with the state kBatchStarted. Error: kInvalidMesh with the line, if the first
/// line does not have these columns.
Result<BatchTable> decode_batch_table(std::string_view bytes);

}  // namespace medial_vk
