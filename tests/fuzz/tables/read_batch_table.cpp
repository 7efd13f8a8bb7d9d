// The reader of the table of `medial-vk batch`, on any bytes: rows that are written and read again as they are, or a
// clear message.
#include "output/batch_files/batch_table.h"

#include <set>

#include "fuzz/require.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string text = batch_table_header() + std::string(fuzz::as_text(data, size));
  const Result<std::vector<BatchRow>> rows = decode_batch_table(text);
  if (!rows.ok()) {
    fuzz::require_clear(rows.error(), ErrorCode::kInvalidMesh);
    fuzz::require(rows.error().message.starts_with("line "), "a message names the line");
    return 0;
  }
  std::set<std::string> names;
  std::string again = batch_table_header();
  for (const BatchRow& row : rows.value()) {
    fuzz::require(names.insert(row[BatchColumn::kName]).second, "each mesh has one row");
    again += encode_batch_row(row);
  }
  const Result<std::vector<BatchRow>> twice = decode_batch_table(again);
  fuzz::require(twice.ok() && twice.value().size() == rows.value().size(), "what is written can be read");
  for (std::size_t i = 0; i < rows.value().size(); ++i) {
    BatchRow row = rows.value()[i];
    for (std::string& cell : row.texts) {
      for (char& c : cell) {
        if (c == '\r') c = ' ';
      }
    }
    fuzz::require(twice.value()[i] == row, "rows are read as they were written");
  }
  return 0;
}
