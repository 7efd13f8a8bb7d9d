// The table of `medial-vk batch`: texts with commas and quotes, lines that were cut off, and lines of the same mesh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  const Result<std::vector<BatchRow>> read = decode_batch_table(text);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value(), rows);
  EXPECT_FALSE(read.value()[0].is_done());
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
    const Result<std::vector<BatchRow>> read =
        decode_batch_table(std::string_view(whole).substr(0, whole.size() - cut));
    ASSERT_TRUE(read.ok());
    ASSERT_EQ(read.value().size(), 2u);
    EXPECT_EQ(read.value()[0].is_done(), cut == 0);
    EXPECT_TRUE(read.value()[1].is_done());
  }
}

TEST(BatchTable, OtherTablesAreRefusedWithTheirLine) {
  const std::string row = encode_batch_row(batch_row("a", kBatchDone));
  const auto fault = [&](const std::string& text) {
    const Result<std::vector<BatchRow>> read = decode_batch_table(text);
    return read.ok() ? std::string("none") : read.error().message;
  };
  EXPECT_EQ(fault(batch_table_header()), "none");
  EXPECT_THAT(fault(""), HasSubstr("line 1"));
  EXPECT_THAT(fault("x,y\n1,2\n"), HasSubstr("line 1"));
  for (const std::string& wrong :
       {std::string("a,done\n"), "," + row, std::string("\"") + row, "a\"b\"" + row.substr(1),
        encode_batch_row(batch_row("", kBatchDone)), encode_batch_row(batch_row("a", "?"))}) {
    EXPECT_THAT(fault(batch_table_header() + row + wrong), HasSubstr("line 3")) << wrong;
  }
}

}  // namespace
}  // namespace medial_vk
