// The table of distances: numbers that read back as the same doubles, and states.
#include "output/distance_files/distances_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace medial_vk {
namespace {

const std::string kDistanceNames = "lower,upper,state,ax,ay,az,bx,by,bz\n";

Distance distance_between(double lower, double upper, const Point& on_a, const Point& on_b) {
  Distance distance;
  distance.lower = lower;
  distance.upper = upper;
  distance.on_a = on_a;
  distance.on_b = on_b;
  return distance;
}

TEST(DistancesCsv, ALinePerDistance) {
  const std::vector<Distance> distances = {distance_between(0.5, 0.75, {1, 2, 3}, {1.5, 2, -3}),
                                           distance_between(0, 0, {1, 0, 0}, {1, 0, 0}),
                                           distance_between(0, 1e-15, {0, 0, 0}, {0, 0, 1e-15}), Distance()};
  EXPECT_EQ(encode_distances_csv(distances), kDistanceNames +
                                                 "0.5,0.75,free,1,2,3,1.5,2,-3\n"
                                                 "0,0,hit,1,0,0,1,0,0\n"
                                                 "0,1e-15,undecided,0,0,0,0,0,1e-15\n"
                                                 "0,inf,undecided,0,0,0,0,0,0\n");
  EXPECT_EQ(encode_distances_csv({}), kDistanceNames);
}

TEST(DistancesCsv, StatesHaveNames) {
  EXPECT_STREQ(name_of(Collision::kFree), "free");
  EXPECT_STREQ(name_of(Collision::kHit), "hit");
  EXPECT_STREQ(name_of(Collision::kUndecided), "undecided");
}

TEST(DistancesCsv, NumbersReadBackAsTheSameDoubles) {
  using Limits = std::numeric_limits<double>;
  const Point on_a = {0.1, -1.0 / 3, std::nextafter(0.3, 1)};
  const Point on_b = {Limits::denorm_min(), -Limits::max(), 12345.678901234567};
  const Distance distance = distance_between(2e-308, Limits::infinity(), on_a, on_b);
  std::istringstream text(encode_distances_csv({&distance, 1}).substr(kDistanceNames.size()));
  std::vector<double> numbers;
  for (std::string word; std::getline(text, word, ',');) {
    if (word != "free") numbers.push_back(std::strtod(word.c_str(), nullptr));
  }
  EXPECT_THAT(numbers,
              testing::ElementsAre(2e-308, Limits::infinity(), on_a[0], on_a[1], on_a[2], on_b[0], on_b[1], on_b[2]));
}

}  // namespace
}  // namespace medial_vk
