// The reader of the table of `medial-vk batch`, on any bytes below its names of columns: rows that are written and read
// again as they are.
#include "output/batch_files/batch_table.h"

#include <set>

#include "fuzz/require.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string text = batch_table_header() + std::string(fuzz::as_text(data, size));
  const Result<BatchTable> table = decode_batch_table(text);
  fuzz::require(table.ok(), "damaged lines are left out");
  std::set<std::string> names;
  std::string again = batch_table_header();
  for (const BatchRow& row : table.value().rows) {
    fuzz::require(names.insert(row[BatchColumn::kName]).second, "each mesh has one row");
    again += encode_batch_row(row);
  }
  const Result<BatchTable> twice = decode_batch_table(again);
  fuzz::require(twice.ok() && twice.value().damaged_lines.empty(), "what is written can be read");
  fuzz::require(twice.value().rows.size() == table.value().rows.size(), "no row is lost");
  for (std::size_t i = 0; i < twice.value().rows.size(); ++i) {
    BatchRow row = table.value().rows[i];
    for (std::string& cell : row.texts) {
      for (char& c : cell) {
        if (c == '\r') c = ' ';
      }
    }
    fuzz::require(twice.value().rows[i] == row, "rows are read as they were written");
  }
  return 0;
}
