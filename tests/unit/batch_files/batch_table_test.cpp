// The table of `medial-vk batch`: texts with commas and quotes, lines that were cut off, and lines of the same mesh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output/batch_files/batch_table.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

BatchRow batch_row(const std::string& name, std::string_view state) {
  BatchRow row;
  row[BatchColumn::kName] = name;
  row[BatchColumn::kState] = state;
  return row;
}

TEST(BatchTable, RowsAreReadAsTheyWereWritten) {
  std::vector<BatchRow> rows = {batch_row("a, \"b\".obj", kBatchFailed), batch_row("c.obj", kBatchDone)};
  rows[0][BatchColumn::kError] = "\"";
  rows[1][BatchColumn::kPoints] = "17";
  rows[1][BatchColumn::kVersion] = "1,2";
  std::string text = batch_table_header();
  for (const BatchRow& row : rows) text += encode_batch_row(row);
  const Result<BatchTable> read = decode_batch_table(text);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value().rows, rows);
  EXPECT_TRUE(read.value().damaged_lines.empty());
  EXPECT_FALSE(read.value().rows[0].is_done());
}

TEST(BatchTable, LineEndsBecomeSpaces) {
  BatchRow row = batch_row("a.obj", kBatchFailed);
  row[BatchColumn::kError] = "one\r\ntwo";
  const std::string line = encode_batch_row(row);
  EXPECT_THAT(line, HasSubstr(",one  two,"));
  EXPECT_EQ(line.find('\n'), line.size() - 1);
}

TEST(BatchTable, TheLastLineOfAMeshCountsAndACutOneDoesNot) {
  const std::string whole = batch_table_header() + encode_batch_row(batch_row("a", kBatchFailed)) +
                            encode_batch_row(batch_row("b", kBatchDone)) + encode_batch_row(batch_row("a", kBatchDone));
  for (std::size_t cut = 0; cut < 3; ++cut) {
    const Result<BatchTable> read = decode_batch_table(std::string_view(whole).substr(0, whole.size() - cut));
    ASSERT_TRUE(read.ok());
    const std::vector<BatchRow>& rows = read.value().rows;
    ASSERT_EQ(rows.size(), 2u);
    // In the order of the lines that count.
    EXPECT_EQ(rows[0][BatchColumn::kName], cut == 0 ? "b" : "a");
    EXPECT_EQ(rows[0].is_done(), cut == 0);
    EXPECT_TRUE(rows[1].is_done());
  }
}

TEST(BatchTable, AMeshThatIsBegunIsNotDone) {
  const Result<BatchTable> read =
      decode_batch_table(batch_table_header() + encode_batch_row(batch_row("a", kBatchDone)) +
                         encode_batch_row(batch_row("a", kBatchStarted)));
  ASSERT_TRUE(read.ok());
  ASSERT_EQ(read.value().rows.size(), 1u);
  EXPECT_FALSE(read.value().rows[0].is_done());
}

TEST(BatchTable, AMeshThatIsReadAgainHasItsResultsAndIsAtWork) {
  const BatchRow done = batch_row("a", kBatchDone);
  BatchRow reading = done;
  reading[BatchColumn::kState] = kBatchReading;
  const Result<BatchTable> read =
      decode_batch_table(batch_table_header() + encode_batch_row(done) + encode_batch_row(reading));
  ASSERT_TRUE(read.ok());
  EXPECT_TRUE(read.value().damaged_lines.empty());
  ASSERT_EQ(read.value().rows.size(), 1u);
  const BatchRow& row = read.value().rows[0];
  EXPECT_EQ(row, reading);
  EXPECT_TRUE(row.has_results() && row.is_at_work() && !row.is_done());
  EXPECT_TRUE(done.has_results() && !done.is_at_work());
  EXPECT_FALSE(batch_row("a", kBatchStarted).has_results());
  EXPECT_FALSE(batch_row("a", kBatchFailed).has_results() || batch_row("a", kBatchFailed).is_at_work());
}

TEST(BatchTable, DamagedLinesAreLeftOutAndTheirMeshIsNotDone) {
  const std::string row = encode_batch_row(batch_row("a", kBatchDone));
  for (const auto& [wrong, has_name] : {std::pair(std::string("a,done\n"), true),
                                        {"," + row, false},
                                        {std::string("\"") + row, false},
                                        {"a\"b\"" + row.substr(1), true},
                                        {row.substr(0, 8) + "\"" + row.substr(8), true},
                                        {encode_batch_row(batch_row("", kBatchDone)), false},
                                        {encode_batch_row(batch_row("a", "?")), true}}) {
    const Result<BatchTable> read =
        decode_batch_table(batch_table_header() + row + wrong + encode_batch_row(batch_row("b", kBatchDone)));
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read.value().damaged_lines, std::vector<std::uint64_t>{3}) << wrong;
    ASSERT_EQ(read.value().rows.size(), 2u) << wrong;
    EXPECT_EQ(read.value().rows[0][BatchColumn::kState], has_name ? kBatchStarted : kBatchDone) << wrong;
    EXPECT_TRUE(read.value().rows[1].is_done());
  }
}

TEST(BatchTable, OtherTablesAreRefusedWithTheirLine) {
  for (const std::string text : {"", "x,y\n1,2\n"}) {
    const Result<BatchTable> read = decode_batch_table(text);
    ASSERT_FALSE(read.ok());
    EXPECT_THAT(read.error().message, HasSubstr("line 1"));
  }
}

}  // namespace
}  // namespace medial_vk
