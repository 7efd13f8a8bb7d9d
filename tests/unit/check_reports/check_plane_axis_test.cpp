// `--check` of axes in the plane finds what is wrong.
#include <gtest/gtest.h>

#include <algorithm>

#include "reference_bridge/check_plane_axis.h"
#include "unit/plane_centre_lines/axes_of_shapes.h"

namespace medial_vk {
namespace {

PreparedShape star_shape() { return prepare_shape(std::vector<PlaneRing>{test::star_ring(4, 30)}).value(); }

CheckReport checked(const PreparedShape& shape, const PlaneAxisOptions& options, const PlaneAxis& axis) {
  return check_plane_axis(shape, options, axis, [](double) {});
}

/// The lines that failed, by the beginning of their conditions.
std::vector<std::string> failed(const CheckReport& report) {
  std::vector<std::string> names;
  for (const CheckLine& line : report.lines) {
    if (line.failed > 0) names.push_back(line.condition.substr(0, line.condition.find(' ')));
  }
  return names;
}

TEST(CheckPlaneAxis, PassesWhatIsFoundOnEachSide) {
  const PreparedShape shape = star_shape();
  for (const PlaneSide side : {PlaneSide::kInside, PlaneSide::kOutside, PlaneSide::kBoth}) {
    for (const double radius : {0.0, 0.1}) {
      const PlaneAxisOptions options = {.side = side, .object_angle = 0.5, .radius = radius};
      const PlaneAxis axis = find_plane_axis(shape, options).value();
      const CheckReport report = checked(shape, options, axis);
      EXPECT_TRUE(report.passed()) << testing::PrintToString(failed(report));
      for (const CheckLine& line : report.lines) {
        EXPECT_TRUE(line.tested > 20 || line.condition.starts_with("points are")) << line.condition;
      }
    }
  }
}

TEST(CheckPlaneAxis, FindsWhatIsWrong) {
  const PreparedShape shape = star_shape();
  const PlaneAxisOptions options = {.object_angle = 0.5};
  const PlaneAxis axis = find_plane_axis(shape, options).value();
  using Names = std::vector<std::string>;
  {
    PlaneAxis wrong = axis;
    wrong.nodes.front().radius += 1e-6;
    EXPECT_EQ(failed(checked(shape, options, wrong)), Names{"radius"});
  }
  {
    PlaneAxis wrong = axis;
    AxisArc& arc = wrong.arcs[wrong.arcs.size() / 2];
    arc.contacts[1] = {false, (arc.contacts[1].index + 11) % 30};
    EXPECT_EQ(failed(checked(shape, options, wrong)), Names{"both"});
  }
  {
    PlaneAxis wrong = axis;
    const auto longest = std::ranges::max_element(wrong.arcs, {}, [](const AxisArc& a) { return a.t[1] - a.t[0]; });
    wrong.arcs.erase(longest);
    EXPECT_EQ(failed(checked(shape, options, wrong)), Names{"samples"});
  }
  PlaneAxisOptions stricter = options;
  stricter.object_angle = 0.9;
  EXPECT_EQ(failed(checked(shape, stricter, axis)), Names{"object"});
  PlaneAxisOptions other = options;
  other.side = PlaneSide::kOutside;
  const std::vector<std::string> names = failed(checked(shape, other, axis));
  EXPECT_TRUE(std::ranges::count(names, "points") == 1 && std::ranges::count(names, "samples") == 1);
}

}  // namespace
}  // namespace medial_vk
