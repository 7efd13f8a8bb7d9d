// --side and --margin of the main command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/options/options.h"
#include "unit/cli/parse_results.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;

Options sided(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "a.obj");
  return value_of(parse_options(arguments), arguments);
}

std::string refused(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "a.obj");
  return message_of(parse_options(arguments), arguments);
}

TEST(SideOptions, InsideUnlessTheOutsideIsNamed) {
  const Options usual = sided({});
  EXPECT_EQ(usual.side, SearchSide::kInside);
  EXPECT_TRUE(usual.searches_inside() && !usual.searches_outside());
  const Options outside = sided({"--side", "outside", "--margin", "2.5"});
  EXPECT_TRUE(!outside.searches_inside() && outside.searches_outside());
  EXPECT_EQ(outside.margin->of(10), 2.5);
  const Options both = sided({"--side", "both", "--margin", "30%"});
  EXPECT_TRUE(both.searches_inside() && both.searches_outside());
  EXPECT_DOUBLE_EQ(both.margin->of(10), 3);
  EXPECT_FALSE(sided({"--side", "both"}).margin.has_value());
}

TEST(SideOptions, BadValuesAreNamed) {
  EXPECT_THAT(refused({"--side", "left"}), HasSubstr("use inside or outside or both"));
  EXPECT_THAT(refused({"--margin", "1"}), HasSubstr("--side outside"));
  EXPECT_THAT(refused({"--side", "outside", "--margin", "0"}), HasSubstr("--margin must be more than 0"));
  EXPECT_THAT(refused({"--side", "outside", "--margin", "-1"}), HasSubstr("--margin"));
  EXPECT_THAT(refused({"--side", "outside", "--margin", "1001%"}), HasSubstr("% of the longest side"));
  EXPECT_THAT(refused({"--side", "outside", "--margin", "wide"}), HasSubstr("is not a number"));
}

TEST(SideOptions, WhatHasNoOutsideIsRefused) {
  EXPECT_THAT(refused({"--side", "outside", "--mode", "thesis"}), HasSubstr("searches the inside only"));
  for (const std::vector<std::string>& measure : {std::vector<std::string>{"--curvature"},
                                                  {"--boundary", "b.ply"},
                                                  {"--picture", "p.png", "--show", "boundary", "--colour", "kappa1"}}) {
    std::vector<std::string> arguments = measure;
    arguments.insert(arguments.end(), {"--side", "outside"});
    EXPECT_THAT(refused(arguments), HasSubstr("balls inside")) << measure[0];
    arguments.back() = "both";
    EXPECT_EQ(sided(arguments).side, SearchSide::kBoth);
  }
  EXPECT_EQ(sided({"--side", "outside", "--thickness", "--boundary", "b.ply"}).side, SearchSide::kOutside);
  for (const std::vector<std::string>& of_one : {std::vector<std::string>{"--medial-mesh", "m.ply"},
                                                 {"--sheet-curve", "c.csv"},
                                                 {"--ball-volumes", "v.csv"},
                                                 {"--keep-volume", "0.9"}}) {
    std::vector<std::string> arguments = of_one;
    arguments.insert(arguments.end(), {"--side", "both"});
    EXPECT_THAT(refused(arguments), HasSubstr(of_one[0] + " is about one union of balls")) << of_one[0];
    arguments.back() = "outside";
    EXPECT_EQ(sided(arguments).side, SearchSide::kOutside);
  }
}

}  // namespace
}  // namespace medial_vk::cli
