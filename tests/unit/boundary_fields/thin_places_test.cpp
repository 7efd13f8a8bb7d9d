// Thin points are grouped into places.
#include "boundary_fields/thin_places.h"

#include <gtest/gtest.h>

#include <vector>

namespace medial_vk {
namespace {

Thickness in_a_wall(double lower, double upper, const Point& centre) {
  Thickness thickness;
  thickness.ball = {centre, 0.5 * lower};
  thickness.diameter = {lower, upper};
  thickness.object_angle = 1.5;
  return thickness;
}

TEST(ThinPlaces, AreGroupsOfPointsThatAreCloseToEachOther) {
  // With an area of 1 a point, those with centres up to 3 from each other are in one place, such as both sides of a
  // wall.
  const std::vector<Point> points = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {20, 0, 0}, {-20, 0, 0}, {2, 2, 0}, {2, 1, 0}};
  std::vector<Thickness> at_points;
  at_points.reserve(points.size());
  for (const Point& p : points) at_points.push_back(in_a_wall(0.5, 0.51, p));
  at_points[1] = in_a_wall(0.4, 0.41, points[1]);
  at_points[2] = in_a_wall(0.5, 0.51, {3, 0, 5});
  at_points[3] = in_a_wall(0.6, 0.61, {3, 1, 5});
  at_points[4] = in_a_wall(2, 2.1, points[4]);    // thick enough
  at_points[5] = in_a_wall(0.1, 0.5, points[5]);  // thinner than a wall can be
  at_points[6].object_angle = 0.9;                // at an edge
  const std::vector<ThinPlace> places = group_thin_places(points, at_points, 1, {0.3, 1}, 1.2);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].area, 2);
  EXPECT_EQ(places[0].at, points[1]);
  EXPECT_EQ(places[0].least.lower, 0.4);
  EXPECT_EQ(places[0].least.upper, 0.41);
  EXPECT_EQ(places[1].area, 2);
  EXPECT_EQ(places[1].at, points[2]);
}

// With no wall below 0.3, a thickness below it is not that of a wall; an interval of a hundredth may begin below it.
TEST(ThinPlaces, AreNotThinnerThanWalls) {
  const std::vector<Point> points = {{0, 0, 0}, {20, 0, 0}, {40, 0, 0}};
  const std::vector<Thickness> at_points = {in_a_wall(0.298, 0.299, points[0]), in_a_wall(0.298, 0.301, points[1]),
                                            in_a_wall(0.29, 0.31, points[2])};
  const std::vector<ThinPlace> places = group_thin_places(points, at_points, 1, {0.3, 1}, 1.2);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].at, points[1]);
}

TEST(ThinPlaces, NeedNotExist) { EXPECT_TRUE(group_thin_places({}, {}, 1, {0.3, 1}, 1.2).empty()); }

}  // namespace
}  // namespace medial_vk
