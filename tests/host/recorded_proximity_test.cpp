// Verdicts and bounds that a host records into its own commands, for poses that it has set or written itself.
#include <gtest/gtest.h>
#include <medial_vk/device_bodies.h>
#include <medial_vk/proximity_job.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "recording_test.h"

namespace medial_vk::test {
namespace {

std::vector<Ball> balls_around(std::mt19937& random, std::size_t count, double middle) {
  std::uniform_real_distribution<> in(-1, 1), radius(0, 0.2);
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < count; ++i) {
    balls.push_back({{middle + in(random), middle + in(random), in(random)}, radius(random)});
  }
  return balls;
}

RecordedPose recorded(const PosedPair& pair) {
  RecordedPose out = {};
  float* const rows[] = {out.row_x, out.row_y, out.row_z};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) rows[i][j] = static_cast<float>(pair.pose.rotation[i][j]);
    rows[i][3] = static_cast<float>(pair.pose.shift[i]);
  }
  out.a = pair.a;
  out.b = pair.b;
  return out;
}

class RecordedProximity : public RecordingTest {
 protected:
  void SetUp() override {
    RecordingTest::SetUp();
    if (!vulkan_) return;
    std::mt19937 random(31);
    std::uniform_real_distribution<> in(-3, 3), angle(-3, 3);
    for (const std::size_t count : {300, 40}) {
      const std::vector<Ball> inside = balls_around(random, count, 0.5);
      std::vector<Ball> cover = inside;
      for (Ball& ball : cover) ball.radius += 0.05;
      bodies_.push_back(Body::create(inside, cover).value());
    }
    for (std::uint32_t i = 0; i < 400; ++i) {
      const Point shift = {in(random), in(random), in(random)};
      pairs_.push_back({make_pose(shift, {angle(random), angle(random), angle(random)}), i % 2, i / 2 % 2});
    }
  }

  /// The answers of a sequence for the first `count` poses, after a copy of `written`, if any, into the poses.
  template <class Answer>
  std::vector<Answer> run(ProximityJob& job, std::uint32_t count, const std::vector<RecordedPose>& written = {}) {
    const VkCommandBuffer commands = begin();
    HostBuffer from = vulkan_->create_buffer(std::max<std::size_t>(written.size(), 1) * sizeof(RecordedPose),
                                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    if (!written.empty()) {
      std::memcpy(from.mapped, written.data(), written.size() * sizeof(RecordedPose));
      const VkBufferCopy region = {0, 0, written.size() * sizeof(RecordedPose)};
      vkCmdCopyBuffer(commands, from.handle, job.buffers().poses, 1, &region);
    }
    const Status status = job.record(commands, count);
    EXPECT_TRUE(status.ok()) << status.error().message;
    HostBuffer answers = copy_of(commands, job.buffers().answers, count * sizeof(Answer));
    end_and_submit(commands);
    EXPECT_EQ(vkQueueWaitIdle(vulkan_->queue), VK_SUCCESS);
    const auto* first = static_cast<const Answer*>(answers.mapped);
    std::vector<Answer> out(first, first + count);
    vulkan_->destroy(answers);
    vulkan_->destroy(from);
    return out;
  }

  std::vector<Body> bodies_;
  std::vector<PosedPair> pairs_;
};

TEST_F(RecordedProximity, GivesTheVerdictsOfADirectQuery) {
  Context context = adopt();
  DeviceBodies on_device = DeviceBodies::create(context, bodies_).value();
  ProximityJob job = ProximityJob::create(on_device, {.poses = 400}).value();
  std::vector<Collision> direct(pairs_.size());
  ASSERT_TRUE(on_device.collide_by_balls(pairs_, direct).ok());
  ASSERT_TRUE(job.set_poses(pairs_).ok());
  const auto all = run<std::uint32_t>(job, 400);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(static_cast<Collision>(all[i]), direct[i]) << i;
  // Later poses are set, the others stay.
  ASSERT_TRUE(job.set_poses({pairs_.data() + 100, 50}).ok());
  const auto some = run<std::uint32_t>(job, 60);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(some[i], all[100 + i]) << i;
  for (std::size_t i = 50; i < 60; ++i) EXPECT_EQ(some[i], all[i]) << i;
}

// The poses in float are others than those in double: by at most 2^-24 in each entry, so that no point of a body, which
// lies within 4 of its origin, and no shift of up to 6, moves by more than 2e-6.
TEST_F(RecordedProximity, BoundsPosesThatTheHostWrites) {
  Context context = adopt();
  DeviceBodies on_device = DeviceBodies::create(context, bodies_).value();
  ProximityJob job = ProximityJob::create(on_device, {.poses = 500, .answers = ProximityAnswers::kBounds}).value();
  std::vector<RecordedPose> written;
  for (const PosedPair& pair : pairs_) written.push_back(recorded(pair));
  const auto found = run<RecordedBounds>(job, 400, written);
  // The errors of the kernel, 22.1 and 14 and 16 of 2^-23 times lengths of together at most 20, and those of the poses.
  constexpr double kMoved = 2e-6, kNear = 2 * (22.1 + 14 + 16) * 0x1p-23 * 20 + kMoved;
  std::vector<DistanceBounds> host(pairs_.size());
  distance_bounds(bodies_, pairs_, host);
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "pose " << i);
    EXPECT_LE(found[i].lower, host[i].lower + kMoved);
    EXPECT_GE(found[i].lower, host[i].lower - kNear);
    EXPECT_LE(found[i].upper, host[i].upper + kNear);
    EXPECT_GE(found[i].upper, host[i].upper - kMoved - 1e-7 * host[i].upper);
    EXPECT_LT(found[i].cover_pair.a, bodies_[pairs_[i].a].cover().size());
  }
}

// Errors include how far rows are from those of a rotation; what is no rotation is not answered.
TEST_F(RecordedProximity, OfPosesThatAreNone) {
  Context context = adopt();
  const std::vector<Ball> ball = {{{0, 0, 0}, 1}};
  const std::vector<Body> bodies = {Body::create(ball, ball).value()};
  DeviceBodies on_device = DeviceBodies::create(context, bodies).value();
  ProximityJob job = ProximityJob::create(on_device, {.poses = 12}).value();
  const RecordedPose apart = recorded({make_pose({2.01, 0, 0}, {0, 0, 0}), 0, 0}),
                     close = recorded({make_pose({2.0004, 0, 0}, {0, 0, 0}), 0, 0});
  std::vector<RecordedPose> written(9, apart);
  written[1].row_x[0] = 1.0003f;  // no rotation, but close to one: the error is 6e-4 of the lengths
  written[2].row_x[0] = 1.1f;
  written[3].row_x[0] = std::numeric_limits<float>::quiet_NaN();
  written[4].row_y[3] = std::numeric_limits<float>::infinity();
  written[5].a = 1;
  written[6].b = ~std::uint32_t{0};
  written[7].row_x[3] = 0;
  written[8].row_z[2] = -1;
  written.insert(written.end(), {close, close, apart});
  written[10].row_x[0] = 1.0003f;
  written[11].a = 0x7fffffff;
  const auto found = run<std::uint32_t>(job, 12, written);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 0, 2, 2, 2, 2, 2, 1, 2, 0, 2, 2}));
}

// A host's kernel writes over poses that were set, and need not write the words that it has no use for.
TEST_F(RecordedProximity, ReservedWordsAreNotRead) {
  Context context = adopt();
  DeviceBodies on_device = DeviceBodies::create(context, bodies_).value();
  ProximityJob job = ProximityJob::create(on_device, {.poses = 400}).value();
  std::vector<RecordedPose> written;
  for (const PosedPair& pair : pairs_) written.push_back(recorded(pair));
  const auto expected = run<std::uint32_t>(job, 400, written);
  for (RecordedPose& pose : written) pose.reserved[0] = pose.reserved[1] = 1e-3f;
  EXPECT_EQ(run<std::uint32_t>(job, 400, written), expected);
}

// The balls are 1e4 away from the origins of the frames, so that centres, shifts and rotations in float cost up to 0.1.
TEST_F(RecordedProximity, FarFromTheOriginsOfTheFrames) {
  Context context = adopt();
  const std::vector<Ball> ball = {{{1e4, 0, 0}, 1}};
  const std::vector<Body> bodies = {Body::create(ball, ball).value()};
  DeviceBodies on_device = DeviceBodies::create(context, bodies).value();
  ProximityJob job = ProximityJob::create(on_device, {.poses = 4}).value();
  const double apart[] = {2.0, 2.01, 2.5, 1.5};  // of the middles of the balls
  std::vector<RecordedPose> written;
  std::vector<PosedPair> pairs;
  for (const double by : apart) {
    pairs.push_back({make_pose({0, by, 0}, {0, 0, 0}), 0, 0});
    written.push_back(recorded(pairs.back()));
  }
  EXPECT_EQ(run<std::uint32_t>(job, 4, written), (std::vector<std::uint32_t>{2, 2, 0, 1}));
  ASSERT_TRUE(job.set_poses(pairs).ok());  // these are relative to the bodies
  EXPECT_EQ(run<std::uint32_t>(job, 4), (std::vector<std::uint32_t>{2, 0, 0, 1}));
}

// Small balls at one distance from the middle of a large one, around which groups of them overlap it: no group is
// passed over, and the search takes too many steps for lavapipe. Other devices complete it.
TEST_F(RecordedProximity, SearchesThatAreTooLongAreUndecided) {
  Context context = adopt();
  std::mt19937 random(32);
  std::normal_distribution<> normal;
  std::vector<Ball> shell;
  while (shell.size() < 60'000) {
    const Point p = {normal(random), normal(random), normal(random)};
    const double length = std::hypot(p[0], p[1], p[2]);
    shell.push_back({{p[0] / length, p[1] / length, p[2] / length}, 0.002});
  }
  const std::vector<Ball> middle = {{{0, 0, 0}, 0.985}};
  const std::vector<Body> bodies = {Body::create(shell, shell).value(), Body::create(middle, middle).value()};
  DeviceBodies on_device = DeviceBodies::create(context, bodies).value();
  const PosedPair pair = {Pose(), 0, 1};
  ProximityJob verdicts = ProximityJob::create(on_device, {.poses = 1}).value(),
               bounds = ProximityJob::create(on_device, {.poses = 1, .answers = ProximityAnswers::kBounds}).value();
  ASSERT_TRUE(verdicts.set_poses({&pair, 1}).ok());
  ASSERT_TRUE(bounds.set_poses({&pair, 1}).ok());
  const bool is_too_long = context.device().driver.find("llvmpipe") != std::string::npos;
  EXPECT_EQ(run<std::uint32_t>(verdicts, 1).front(), is_too_long ? 2u : 0u);
  const auto found = run<RecordedBounds>(bounds, 1).front();
  EXPECT_NEAR(found.lower, is_too_long ? 0 : 0.013, 1e-4);
  EXPECT_GE(found.upper, 0.013 - 1e-4);
  Collision completed = Collision::kUndecided;
  ASSERT_TRUE(on_device.collide_by_balls({&pair, 1}, {&completed, 1}).ok());
  EXPECT_EQ(completed, Collision::kFree);
}

// Each sequence has the poses that were set before it was recorded.
TEST_F(RecordedProximity, TwoFramesInFlightHaveTheirOwnPoses) {
  Context context = adopt();
  DeviceBodies on_device = DeviceBodies::create(context, bodies_).value();
  ProximityJob job = ProximityJob::create(on_device, {.poses = 200, .frames = 2}).value();
  std::vector<Collision> expected(400);
  ASSERT_TRUE(on_device.collide_by_balls(pairs_, expected).ok());
  const VkCommandBuffer commands = begin();
  std::vector<HostBuffer> answers;
  for (const std::size_t first : {0, 200}) {
    ASSERT_TRUE(job.set_poses({pairs_.data() + first, 200}).ok());
    ASSERT_TRUE(job.record(commands, 200).ok());
    answers.push_back(copy_of(commands, job.buffers().answers, 200 * sizeof(std::uint32_t)));
  }
  end_and_submit(commands);
  ASSERT_EQ(vkQueueWaitIdle(vulkan_->queue), VK_SUCCESS);
  for (std::size_t i = 0; i < 400; ++i) {
    const auto* words = static_cast<const std::uint32_t*>(answers[i / 200].mapped);
    EXPECT_EQ(static_cast<Collision>(words[i % 200]), expected[i]) << i;
  }
  for (HostBuffer& buffer : answers) vulkan_->destroy(buffer);
}

TEST_F(RecordedProximity, RefusesWhatIsWrong) {
  Context context = adopt();
  DeviceBodies on_device = DeviceBodies::create(context, bodies_).value();
  EXPECT_EQ(ProximityJob::create(on_device, {.poses = 0}).error().code, ErrorCode::kUsage);
  EXPECT_EQ(ProximityJob::create(on_device, {.poses = 1, .frames = 0}).error().code, ErrorCode::kUsage);
  ProximityJob job = ProximityJob::create(on_device, {.poses = 2}).value();
  EXPECT_EQ(job.set_poses(pairs_).error().code, ErrorCode::kUsage);
  const PosedPair none[] = {{Pose(), 0, 2}};
  EXPECT_EQ(job.set_poses(none).error().code, ErrorCode::kUsage);
  const VkCommandBuffer commands = begin();
  EXPECT_EQ(job.record(commands, 3).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace medial_vk::test
