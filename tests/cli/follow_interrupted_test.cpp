// Signals to `medial-vk follow`: nothing half stays behind, and little work follows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/solids/mesh_files.h"
#include "support/solids/motions.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

using test::ToolResult;
using testing::HasSubstr;

class InterruptedFollow : public test::ToolTest, public testing::WithParamInterface<int> {
 protected:
  InterruptedFollow() {
    Mesh torus = test::make_torus(2, 0.75, 96, 48);
    test::write_file(path("rest.obj"), test::to_obj(torus));
    torus.vertices = test::moved_vertices(torus.vertices, test::Motion::kBend, 1);
    test::write_file(path("bent.obj"), test::to_obj(torus));
    std::string balls = "x,y,z,radius\n";
    for (int i = 0; i < 300; ++i) {
      balls += std::to_string(2 * std::cos(0.0209 * i)) + "," + std::to_string(2 * std::sin(0.0209 * i)) + ",0,0.7\n";
    }
    test::write_file(path("balls.csv"), balls);
  }

  /// So few that they are soon known by their names, and more than are followed before the signal comes.
  std::vector<std::string> many_frames(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"follow", "rest.obj"};
    arguments.resize(arguments.size() + 1000, "bent.obj");
    arguments.insert(arguments.end(), {"--balls", "balls.csv"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  /// A second of the processor is that of some hundred updates, or of some distances between surface and balls.
  void expect_stop_in_frames(std::vector<std::string> outputs) const {
    test::Tool tool(call(many_frames(std::move(outputs))));
    while (tool.running() && tool.seconds_of_processor() < 1) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_TRUE(tool.running());
    const double before = tool.seconds_of_processor();
    tool.send(GetParam());
    const ToolResult result = tool.wait();
    EXPECT_LT(tool.seconds_of_processor() - before, 1);
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_THAT(result.err, HasSubstr("interrupted; nothing was written"));
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(folder_.names(), testing::ElementsAre("balls.csv", "bent.obj", "rest.obj"));
  }
};

TEST_P(InterruptedFollow, UpdatesStop) { expect_stop_in_frames({"-o", "a.npz", "-o", "a.glb"}); }

TEST_P(InterruptedFollow, MeasuresOfFramesStop) { expect_stop_in_frames({"-o", "a.csv", "--picture", "a.png"}); }

TEST_P(InterruptedFollow, TablesOnStandardOutputStayEmpty) { expect_stop_in_frames({"-o", "-", "--from-rest"}); }

TEST_P(InterruptedFollow, ChecksStop) { expect_stop_in_frames({"-o", "a.npz", "--check"}); }

INSTANTIATE_TEST_SUITE_P(, InterruptedFollow, testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace medial_vk
