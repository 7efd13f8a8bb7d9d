// The contacts that are chosen in float, against all contacts in double precision.
#include "thickness/contact_lists.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "thickness/contact_pool.h"

namespace medial_vk {
namespace {

constexpr Slack kSlack = {0.01, 0.01};
constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Products of vectors of lengths up to 2 have errors of some 2^-23 in float, and less the slack they are 2^-6 or more
// of those that are compared here: the chosen reach exceeds the least one by less than this share.
constexpr double kChoice = 0x1p-14;

class Contacts : public testing::Test {
 protected:
  Point random_point() {
    const double x = normal_(random_), y = normal_(random_), z = normal_(random_);
    return {x, y, z};
  }
  Point random_direction() {
    const Point p = random_point();
    return (1 / length(p)) * p;
  }
  /// As far away as a surface is from a point on it, beside a point or opposite to it.
  void add(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const Point at = (scale_ * (0.2 + 0.8 * share_(random_))) * random_direction();
      all_.push_back({at, dot(at, at)});
      lists_.add(all_.back());
    }
  }
  void start(double scale) {
    scale_ = scale;
    slack_ = {scale * kSlack.distance, scale * kSlack.product};
    all_.clear();
    lists_.start(scale, slack_);
  }
  double least_along(const Point& direction) const {
    double least = kInfinite;
    for (const Contact& contact : all_) least = std::min(least, reach_by(contact, dot(direction, contact.at), slack_));
    return least;
  }
  double least_in(const DirectionCell& cell) const {
    double least = kInfinite;
    for (const Contact& contact : all_) {
      least = std::min(least, reach_by(contact, least_of(along(cell.corners(), contact.at)), slack_));
    }
    return least;
  }

  std::mt19937_64 random_{3};
  std::normal_distribution<> normal_;
  std::uniform_real_distribution<> share_{0, 1};
  double scale_ = 1;
  Slack slack_;
  std::vector<Contact> all_;
  ContactLists lists_;
};

TEST_F(Contacts, WithTheLeastReachAreChosen) {
  for (const double scale : {1e-12, 1.0, 1e12}) {
    for (const std::size_t count : {1, 7, 8, 9, 40}) {
      start(scale);
      EXPECT_EQ(lists_.reach_along({0, 0, 1}, kInfinite).by, ContactLists::kNone);
      EXPECT_EQ(lists_.least_squared_distance({0, 0, 0}), kInfinite);
      add(count);
      for (int i = 0; i < 50; ++i) {
        const Point direction = random_direction();
        const double least = least_along(direction);
        const ContactLists::Reach found = lists_.reach_along(direction, 20 * scale);
        if (least >= 20 * scale) {
          EXPECT_EQ(found.by, ContactLists::kNone);
          continue;
        }
        EXPECT_LE(found.most, least * (1 + kChoice));
        EXPECT_EQ(found.most, reach_by(all_[found.by], dot(direction, all_[found.by].at), slack_));
        // None is closer than the least of all.
        EXPECT_EQ(lists_.reach_along(direction, least / 2).by, ContactLists::kNone);
      }
    }
  }
}

// Contacts that may bound balls in a part of a cell stay in its list, those added since the list was made among them.
TEST_F(Contacts, OfACellBoundItsParts) {
  std::size_t chosen = 0;
  for (int i = 0; i < 60; ++i) {
    start(1);
    add(21);
    const Point middle = random_direction();
    const CubeFrame frame = CubeFrame::around(middle);
    const auto corner = [&](double x, double y) {
      const Point p = middle + x * frame.axes[0] + y * frame.axes[1];
      return (1 / length(p)) * p;
    };
    const DirectionCell cell({corner(-0.3, -0.2), corner(0.3, -0.2), corner(0, 0.3)});
    ContactLists::List list;
    const double first = lists_.narrow(cell, 20, list).most;
    EXPECT_LE(first, std::min(20.0, least_in(cell) * (1 + kChoice)));
    EXPECT_GE(first, std::min(20.0, least_in(cell)));
    add(3);
    for (std::size_t k = 0; k < DirectionCell::kParts; ++k) {
      const DirectionCell part = cell.part(k);
      ContactLists::List of_part = list;
      const ContactLists::Reach found = lists_.narrow(part, first, of_part);
      const double least = std::min(first, least_in(part));
      EXPECT_LE(found.most, least * (1 + kChoice));
      EXPECT_GE(found.most, least);
      if (found.by != ContactLists::kNone) ++chosen;
      EXPECT_EQ(of_part.seen, all_.size());
      const double on_ray = lists_.reach_along(part.middle(), found.most, of_part).most;
      EXPECT_LE(on_ray, std::min(found.most, least_along(part.middle())) * (1 + kChoice));
    }
  }
  EXPECT_GT(chosen, 20u);
}

TEST_F(Contacts, NearestToAPointAreChosen) {
  start(1);
  add(37);
  for (int i = 0; i < 100; ++i) {
    const Point m = 0.5 * random_point();
    double least = kInfinite;
    for (const Contact& contact : all_) least = std::min(least, dot(m - contact.at, m - contact.at));
    // Squares of up to 16 have errors of 2^-19.
    EXPECT_NEAR(lists_.least_squared_distance(m), least, 0x1p-17);
  }
}

// The interval that holds a distance and ends last.
TEST_F(Contacts, ThatHoldADistanceAreChosen) {
  // Radicands below 4 have errors of less than 2^-20 in float, and their roots of 2^-10.
  constexpr double kRadius = 0.8, kFrom = 0.6, kRounding = 0x1p-10;
  std::size_t chosen = 0;
  for (int i = 0; i < 100; ++i) {
    start(1);
    add(19);
    const ContactScale scale(1, slack_);
    std::vector<EightContacts> blocks(3);
    for (std::uint32_t k = 0; k < all_.size(); ++k) scale.write(all_[k], k, blocks[k / 8], k % 8);
    const Point direction = random_direction();
    const auto near = [&](const Contact& contact) {
      return distances_near(dot(direction, contact.at), contact.squared, kRadius);
    };
    const auto last_of = [&](double from) {
      double last = kFrom;
      for (const Contact& contact : all_) {
        const Bounds one = near(contact);
        if (one.lower <= from && one.upper > last) last = one.upper;
      }
      return last;
    };
    NearIntervals intervals;
    intervals.measure(scale, {blocks}, direction, kRadius);
    const std::uint32_t number = intervals.farthest(kFrom);
    const double found = number == kNoContact ? kFrom : near(all_[number]).upper;
    if (number != kNoContact) ++chosen;
    EXPECT_GE(found, last_of(kFrom - kRounding) - kRounding);
    EXPECT_LE(found, last_of(kFrom + kRounding) + kRounding);
  }
  EXPECT_GT(chosen, 20u);
}

// The last 128, from the next start on.
TEST_F(Contacts, OfThePoolAreTheLastOnes) {
  ContactPool pool;
  const Point ahead = {0, 0, 1};
  pool.start({0, 0, 0}, 1, kSlack);
  pool.add({{0, 0, 0.5}, ahead});
  EXPECT_EQ(pool.least_reach(ahead, kInfinite), kNoContact);
  pool.start({0, 0, -1}, 1, kSlack);
  const std::uint32_t number = pool.least_reach(ahead, kInfinite);
  ASSERT_NE(number, kNoContact);
  EXPECT_EQ(pool[number].at, (Point{0, 0, 0.5}));
  // Straight ahead at 1.5 from the new point, the reach is (1.5 + slack) / 2.
  EXPECT_EQ(pool.least_reach(ahead, 0.75), kNoContact);
  for (int i = 0; i < 128; ++i) pool.add({{0, 0, 1}, ahead});
  pool.start({0, 0, -1}, 1, kSlack);
  const std::uint32_t other = pool.least_reach(ahead, kInfinite);
  ASSERT_NE(other, kNoContact);
  EXPECT_EQ(pool[other].at, (Point{0, 0, 1}));
}

}  // namespace
}  // namespace medial_vk
