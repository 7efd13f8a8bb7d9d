// Tests of `medial-vk clearance`: a robot on a rail, and the table of results.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk::test {

/// The rounding of least_distance() for sums of lengths below 20: some 2e-14 of them for the distance, and 3 defects of
/// rotations, of 108 * 2^-53 each, plus 40 * 2^-53 for the relative pose; twice that is less than 3e-12.
inline constexpr double kClearanceRounding = 3e-12;
inline constexpr const char* kClearanceColumns = "configuration,state,lower,upper,first,second\n";

struct ClearanceLine {
  std::string state;
  double lower = 0, upper = 0;
  std::string first, second;
};

inline std::vector<ClearanceLine> clearances_in(const std::string& table) {
  EXPECT_THAT(table, testing::StartsWith(kClearanceColumns));
  std::vector<ClearanceLine> lines;
  std::istringstream text(table);
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::istringstream in(line + ",");
    std::vector<std::string> words;
    for (std::string word; std::getline(in, word, ',');) words.push_back(word);
    EXPECT_EQ(words.size(), 6u) << line;
    if (words.size() != 6) continue;
    EXPECT_EQ(words[0], std::to_string(lines.size() + 1));
    lines.push_back({words[1], std::stod(words[2]), std::stod(words[3]), words[4], words[5]});
  }
  return lines;
}

inline std::vector<std::string> states_in(const std::string& table) {
  std::vector<std::string> states;
  for (const ClearanceLine& line : clearances_in(table)) states.push_back(line.state);
  return states;
}

/// A unit box, a small one that slides and turns inside it, and a unit box that this carries, which comes out and moves
/// to the right. A link without a shape is between the first two.
inline constexpr const char* kRailRobot = R"(<robot name="rail">
<link name="base"><collision><geometry><mesh filename="box.obj"/></geometry></collision></link>
<link name="between"/>
<link name="slider"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
<link name="hand"><collision><origin xyz="1.5 0 0"/><geometry><box size="1 1 1"/></geometry></collision></link>
<joint name="slide" type="prismatic"><parent link="base"/><child link="between"/><axis xyz="1 0 0"/>
  <limit lower="-0.25" upper="0.25"/></joint>
<joint name="turn" type="continuous"><parent link="between"/><child link="slider"/><origin xyz="0.5 0.5 0.5"/>
  <axis xyz="0 0 1"/></joint>
<joint name="reach" type="prismatic"><parent link="slider"/><child link="hand"/><axis xyz="1 0 0"/>
  <limit lower="-1" upper="3"/></joint>
</robot>)";

class ClearanceCommand : public ToolTest {
 protected:
  ClearanceCommand() {
    Mesh box = make_box({1, 1, 1}), wall = box;
    translate(wall, {5, 0, 0});
    write_file(path("box.obj"), to_obj(box));
    write_file(path("wall.obj"), to_obj(wall));
    write_file(path("rail.urdf"), kRailRobot);
    write_file(path("q.csv"), "slide,turn,reach\n0,0,0\n0.25,0,-1\n0,0,1.5\n0,0,3\n");
  }

  ToolResult clearance(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "clearance");
    return run(std::move(arguments));
  }
};

}  // namespace medial_vk::test
