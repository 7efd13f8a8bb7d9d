// The distribution of thickness as a drawing and as a table.
#include "output/charts_and_tables/thickness_histogram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace medial_vk {
namespace {

using testing::HasSubstr;

struct Row {
  double lower = 0, upper = 0, by_lower_ends = 0, by_upper_ends = 0;
};

std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "lower,upper,share_by_lower_ends,share_by_upper_ends");
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    Row row;
    char comma = 0;
    std::istringstream(line) >> row.lower >> comma >> row.upper >> comma >> row.by_lower_ends >> comma >>
        row.by_upper_ends;
    rows.push_back(row);
  }
  return rows;
}

/// Four points: the bars of lower ends and of upper ends differ where an interval is wide.
ThicknessRecord record() {
  ThicknessRecord out;
  out.intervals = {{1, 1}, {1, 1}, {1, 2}, {0, 2}};
  out.median = {1, 2};
  out.greatest = 2;
  return out;
}

TEST(ThicknessHistogram, SharesAddUpAndLieAtTheEnds) {
  double lower_ends = 0, upper_ends = 0;
  for (const Row& row : rows_of(encode_thickness_csv(record()))) {
    lower_ends += row.by_lower_ends;
    upper_ends += row.by_upper_ends;
    if (row.lower <= 1 && 1 < row.upper) {
      EXPECT_EQ(row.by_lower_ends, 0.75);
      EXPECT_EQ(row.by_upper_ends, 0.5);
    }
  }
  EXPECT_EQ(lower_ends, 1);
  EXPECT_EQ(upper_ends, 1);
  const std::vector<Row> rows = rows_of(encode_thickness_csv(record()));
  EXPECT_EQ(rows.front().by_lower_ends, 0.25);
  EXPECT_EQ(rows.back().by_upper_ends, 0.5);
  EXPECT_EQ(rows.back().upper, 2);
}

TEST(ThicknessHistogram, TheDrawingSaysWhatItShows) {
  const std::string svg = encode_thickness_svg(record());
  EXPECT_THAT(svg, HasSubstr("thickness of the walls, in the units of the mesh"));
  EXPECT_THAT(svg, HasSubstr("share of the area of the boundary"));
  EXPECT_THAT(svg, HasSubstr("median, between 1 and 2"));
  std::size_t bars = 0;
  for (std::size_t at = svg.find("<rect"); at != std::string::npos; at = svg.find("<rect", at + 1)) ++bars;
  EXPECT_EQ(bars, 3u);  // of 0 and of 1, and the key
}

TEST(ThicknessHistogram, WithoutPointsThereIsADrawing) {
  EXPECT_THAT(encode_thickness_svg({}), HasSubstr("</svg>"));
  EXPECT_EQ(rows_of(encode_thickness_csv({})).size(), rows_of(encode_thickness_csv(record())).size());
}

}  // namespace
}  // namespace medial_vk
