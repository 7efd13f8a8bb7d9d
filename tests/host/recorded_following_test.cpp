// Balls that follow a mesh, recorded into a host's own commands.
#include <gtest/gtest.h>
#include <medial_vk/follower.h>
#include <medial_vk/follower_job.h>
#include <medial_vk/prepare.h>

#include <array>
#include <cstring>
#include <optional>
#include <vector>

#include "recording_test.h"

namespace medial_vk::test {
namespace {

/// A box of 2 by 1 by 1, and five balls along its middle.
class RecordedFollowing : public RecordingTest {
 protected:
  void SetUp() override {
    RecordingTest::SetUp();
    if (!vulkan_) return;
    Mesh box;
    for (int i = 0; i < 8; ++i) box.vertices.push_back({i & 1 ? 2.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0});
    box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    mesh_.emplace(IndexedMesh::build(prepare_mesh(box).value()).value());
    for (int i = 0; i < 5; ++i) balls_.push_back({{0.4 + 0.3 * i, 0.5, 0.45 + 0.02 * i}, 0.3});
  }

  /// The box, higher and sheared.
  std::vector<Point> frame(double by) const {
    std::vector<Point> out(mesh_->view().vertices.begin(), mesh_->view().vertices.end());
    for (Point& p : out) p = {p[0] + by * p[2], p[1], (1 + by) * p[2]};
    return out;
  }

  std::vector<RecordedBall> balls_in(const HostBuffer& buffer) const {
    const auto* first = static_cast<const RecordedBall*>(buffer.mapped);
    return {first, first + balls_.size()};
  }

  /// The balls after one sequence.
  std::vector<RecordedBall> run(FollowerJob& job) {
    const VkCommandBuffer commands = begin();
    const Status status = job.record(commands);
    EXPECT_TRUE(status.ok()) << status.error().message;
    HostBuffer copied = copy_of(commands, job.buffers().balls, balls_.size() * sizeof(RecordedBall));
    end_and_submit(commands);
    EXPECT_EQ(vkQueueWaitIdle(vulkan_->queue), VK_SUCCESS);
    std::vector<RecordedBall> out = balls_in(copied);
    vulkan_->destroy(copied);
    return out;
  }

  static bool are_same(const std::vector<RecordedBall>& a, const std::vector<RecordedBall>& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(RecordedBall)) == 0;
  }

  std::optional<IndexedMesh> mesh_;
  std::vector<Ball> balls_;
};

TEST_F(RecordedFollowing, GivesTheBallsOfTheHost) {
  Context context = adopt();
  FollowerJob job = FollowerJob::create(context, *mesh_, balls_).value();
  Follower host = Follower::create(*mesh_, balls_, {.steps = 0}).value();  // the device takes none
  for (const double by : {0.0, 0.2, 0.4}) {
    ASSERT_TRUE(job.set_vertices(frame(by)).ok());
    ASSERT_TRUE(host.update(frame(by)).ok());
    const std::vector<RecordedBall> found = run(job);
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      // 75 of 2^-23 times the longest side and the greatest coordinate, which are 2.4 each at most.
      EXPECT_NEAR(found[i].radius, host.balls()[i].radius, 75 * 0x1p-23 * 4.8) << by << ", ball " << i;
      EXPECT_LT(found[i].radius, host.balls()[i].radius) << by << ", ball " << i;
    }
  }
}

// Without set_vertices() a sequence reads what the host has written.
TEST_F(RecordedFollowing, ReadsVerticesThatTheHostWrites) {
  Context context = adopt();
  FollowerJob job = FollowerJob::create(context, *mesh_, balls_).value(),
              other = FollowerJob::create(context, *mesh_, balls_).value();
  ASSERT_TRUE(other.set_vertices(frame(0.3)).ok());
  const std::vector<RecordedBall> expected = run(other);
  std::vector<RecordedVertex> written;
  for (const Point& p : frame(0.3)) {
    written.push_back({{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}});
  }
  const VkDeviceSize bytes = written.size() * sizeof(RecordedVertex);
  HostBuffer from = vulkan_->create_buffer(bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  std::memcpy(from.mapped, written.data(), bytes);
  const VkCommandBuffer commands = begin();
  const VkBufferCopy region = {0, 0, bytes};
  vkCmdCopyBuffer(commands, from.handle, job.buffers().vertices, 1, &region);
  ASSERT_TRUE(job.record(commands).ok());
  HostBuffer copied = copy_of(commands, job.buffers().balls, balls_.size() * sizeof(RecordedBall));
  end_and_submit(commands);
  ASSERT_EQ(vkQueueWaitIdle(vulkan_->queue), VK_SUCCESS);
  EXPECT_TRUE(are_same(balls_in(copied), expected));
  vulkan_->destroy(copied);
  vulkan_->destroy(from);
}

// Each sequence has the vertices that were set before it was recorded, and follows the one before it: in one buffer of
// commands, or submitted after the one before it, for whose end nothing waits.
TEST_F(RecordedFollowing, TwoFramesInFlightAreAsOneByOne) {
  Context context = adopt();
  FollowerJobOptions options;
  options.frames = 2;
  FollowerJob one_by_one = FollowerJob::create(context, *mesh_, balls_).value(),
              job = FollowerJob::create(context, *mesh_, balls_, options).value();
  for (const bool is_one_buffer : {true, false}) {
    const double first = is_one_buffer ? 0.1 : 0.3;
    const std::array times = {first, first + 0.1};
    VkCommandBuffer commands = begin();
    std::vector<HostBuffer> copies;
    for (const double by : times) {
      if (by != first && !is_one_buffer) {
        end_and_submit(commands);
        commands = begin();
      }
      ASSERT_TRUE(job.set_vertices(frame(by)).ok());
      ASSERT_TRUE(job.record(commands).ok());
      copies.push_back(copy_of(commands, job.buffers().balls, balls_.size() * sizeof(RecordedBall)));
    }
    end_and_submit(commands);
    ASSERT_EQ(vkQueueWaitIdle(vulkan_->queue), VK_SUCCESS);
    for (std::size_t i = 0; i < times.size(); ++i) {
      ASSERT_TRUE(one_by_one.set_vertices(frame(times[i])).ok());
      EXPECT_TRUE(are_same(balls_in(copies[i]), run(one_by_one))) << times[i];
      vulkan_->destroy(copies[i]);
    }
  }
  job.reset();
  one_by_one.reset();
  ASSERT_TRUE(job.set_vertices(frame(0.2)).ok());
  ASSERT_TRUE(one_by_one.set_vertices(frame(0.2)).ok());
  EXPECT_TRUE(are_same(run(job), run(one_by_one)));
}

}  // namespace
}  // namespace medial_vk::test
