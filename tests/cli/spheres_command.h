// A fixture for tests of `medial-vk spheres`: a part and a robot of two links in a folder.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "input/read_mesh.h"
#include "medial_vk/prepare.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk::test {

inline constexpr const char* kRobot = R"(<robot name="two">
  <link name="a">
    <collision><geometry><mesh filename="part.obj"/></geometry></collision>
    <collision><origin xyz="0 0 3"/><geometry><sphere radius="0.5"/></geometry></collision>
  </link>
  <link name="b">
    <visual><geometry><mesh filename="part.obj"/></geometry></visual>
    <collision>
      <origin xyz="1 0 0" rpy="0.1 0.2 0.3"/>
      <geometry><mesh filename="package://here/part.obj" scale="0.5 0.5 0.5"/></geometry>
    </collision>
  </link>
  <link name="c"/>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
</robot>
)";

class SpheresCommand : public ToolTest {
 protected:
  SpheresCommand() {
    Mesh mesh = make_l_shape(2.0, 0.6, 0.8);
    rotate(mesh, {1, 2, 3}, 0.4);
    write_file(path("part.obj"), to_obj(mesh));
    write_file(path("two.urdf"), kRobot);
  }

  /// Runs the source's method on the CPU.
  ToolResult spheres(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"spheres", "--method", "source", "--backend", "cpu"});
    return run(std::move(arguments));
  }

  /// Runs the best method on the CPU, with few candidates, which takes a second at most. The report is in report().
  ToolResult best(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"spheres", "--backend", "cpu", "--resolution", "20", "--report", "r.json"});
    return run(std::move(arguments));
  }
  nlohmann::json report() const { return nlohmann::json::parse(read_file(path("r.json"))); }
  nlohmann::json measures() const { return report()["parts"][0]["measures"]; }

  /// The mesh of part.obj in the form that the library takes.
  PreparedMesh part() const { return std::move(prepare_mesh(std::move(read_mesh(path("part.obj"))).value())).value(); }

  std::vector<std::string> robot_arguments(const std::string& goal, const std::string& number) const {
    return {"two.urdf", "--package", "here=" + path(""), goal, number};
  }
};

}  // namespace medial_vk::test
