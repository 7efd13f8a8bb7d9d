// Every call of Vulkan that can fail does so once, in the jobs that a host records.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "fault_test.h"
#include "lent_device.h"
#include "medial_vk/cover_follower.h"
#include "medial_vk/extraction_job.h"
#include "medial_vk/follower.h"
#include "medial_vk/follower_job.h"
#include "medial_vk/proximity_job.h"
#include "support/indexed.h"
#include "support/recorded_job.h"

namespace medial_vk::test {
namespace {

class RecordedJobFaults : public VulkanFaults {
 protected:
  void SetUp() override {
    VulkanFaults::SetUp();
    if (!IsSkipped()) host_.emplace(open().value());
  }
  void TearDown() override {
    host_.reset();
    VulkanFaults::TearDown();
  }
  /// After `prepare()`, the calls of `run()` fail one by one. It then gives `expected`, or an error, and `expected`
  /// when it runs again.
  template <class Prepare, class Run>
  void fail_every_recording(const char* what, const Prepare& prepare, const Run& run, const std::string& expected) {
    std::uint64_t failures = 0;
    for (const Fault fault : kMemoryFaults) {
      for (std::uint64_t k = 1; !HasFailure(); k += fault_stride()) {
        prepare();
        vulkan().fail_call(k, fault);
        const Answer answer = run();
        const std::string call = vulkan().stop_failing();
        SCOPED_TRACE(std::string(fault_name(fault)) + ", call " + std::to_string(k) + " (" + call + ")");
        EXPECT_TRUE(answer.ok() ? answer.value() == expected : answer.error().code == ErrorCode::kOutOfMemory);
        if (call.empty()) break;
        if (answer.ok()) continue;
        ++failures;
        EXPECT_TRUE(run().value() == expected);
      }
    }
    EXPECT_GT(failures, 0u);
    std::cout << what << ": " << failures << " errors\n";
  }

  std::optional<LentDevice> host_;
};

TEST_F(RecordedJobFaults, OfTakingOverADevice) {
  const std::set<ProgramKey> keys = {{"prepare_resolve", 1, 0, 0, 1, {}}};
  const auto job = [&]() -> Answer {
    Result<Context> context = in_runtime([&] { return Context::adopt(host_->lend()); });
    if (!context.ok()) return context.error();
    if (Status made = Internals::of(context.value()).make_programs(keys); !made.ok()) return made.error();
    return std::string("made");
  };
  for (const Fault fault : {Fault::kOutOfHostMemory, Fault::kOutOfDeviceMemory})
    fail_every_call(fault, "taking over a device", job, [](std::uint64_t) {});
}

TEST_F(RecordedJobFaults, OfAJob) {
  const PreparedMesh mesh = small_box(), moved = sheared(mesh);
  Context context = Context::adopt(host_->lend()).value();
  const auto run = [&] { return make_job_and_record(*host_, context, mesh, moved); };
  for (const Fault fault : kMemoryFaults) fail_every_call(fault, "a recorded job", run, [](std::uint64_t) {});
}

// A sequence that could not be recorded is recorded again, with the mesh that was to be moved.
TEST_F(RecordedJobFaults, OfASequenceThatIsRecordedAgain) {
  const PreparedMesh mesh = small_box(), moved = sheared(mesh);
  Context context = Context::adopt(host_->lend()).value();
  IndexedMesh indexed = test::indexed(mesh);
  ExtractionJob job = ExtractionJob::create(context, indexed, small_job(Mode::kCertified)).value();
  const auto move_and_run = [&](const PreparedMesh& to) {
    EXPECT_TRUE(move(job, indexed, to.view()).ok());
    return host_->record_and_run(job);
  };
  const std::string before = move_and_run(mesh).value(), after = move_and_run(moved).value();
  ASSERT_TRUE(before != after);
  const auto prepare = [&] {
    EXPECT_TRUE(move_and_run(mesh).value() == before);
    EXPECT_TRUE(move(job, indexed, moved.view()).ok());
  };
  fail_every_recording(
      "a sequence that is recorded again", prepare, [&] { return host_->record_and_run(job); }, after);
}

TEST_F(RecordedJobFaults, OfAJobOfPoses) {
  const std::vector<Body> bodies = two_bodies();
  const std::vector<PosedPair> pairs = poses_of_two();
  Context context = Context::adopt(host_->lend()).value();
  const auto run = [&]() -> Answer {
    Result<DeviceBodies> on_device = in_runtime([&] { return DeviceBodies::create(context, bodies); });
    if (!on_device.ok()) return on_device.error();
    Result<ProximityJob> job = in_runtime([&] { return ProximityJob::create(on_device.value(), {.poses = 8}); });
    if (!job.ok()) return job.error();
    if (Status set = in_runtime([&] { return job.value().set_poses(pairs, {1}); }); !set.ok()) return set.error();
    return host_->record_and_run(job.value(), 8);
  };
  for (const Fault fault : kMemoryFaults) fail_every_call(fault, "a job of poses", run, [](std::uint64_t) {});
}

// Poses that were set stay set until a sequence has been recorded.
TEST_F(RecordedJobFaults, OfASequenceOfPosesThatIsRecordedAgain) {
  Context context = Context::adopt(host_->lend()).value();
  DeviceBodies on_device = DeviceBodies::create(context, two_bodies()).value();
  ProximityJob job = ProximityJob::create(on_device, {.poses = 8}).value();
  const auto set = [&](std::uint32_t first) { EXPECT_TRUE(job.set_poses(poses_of_two(first), {1}).ok()); };
  set(0);
  const std::string near = host_->record_and_run(job, 8).value();
  set(6);
  const std::string far = host_->record_and_run(job, 8).value();
  ASSERT_TRUE(near != far);
  const auto prepare = [&] {
    job = ProximityJob::create(on_device, {.poses = 8}).value();  // whose first sequence is not recorded yet
    set(6);
  };
  fail_every_recording(
      "a sequence of poses that is recorded again", prepare, [&] { return host_->record_and_run(job, 8); }, far);
}

// Later sequences have the descriptor sets of the first, so that nothing is left that can fail.
TEST_F(RecordedJobFaults, LaterSequencesOfPosesCreateNothing) {
  Context context = Context::adopt(host_->lend()).value();
  DeviceBodies on_device = DeviceBodies::create(context, two_bodies()).value();
  ProximityJob job = ProximityJob::create(on_device, {.poses = 8, .frames = 2}).value();
  std::string first;
  for (int sequence = 0; sequence < 6; ++sequence) {
    SCOPED_TRACE(sequence);
    ASSERT_TRUE(job.set_poses(poses_of_two(), {1}).ok());
    vulkan().fail_call(~std::uint64_t{0}, Fault::kOutOfHostMemory);  // none fails, all are counted
    const Answer answer = host_->record_and_run(job, 8);
    ASSERT_TRUE(answer.ok());
    if (sequence == 0) first = answer.value();
    EXPECT_EQ(answer.value(), first);
    if (sequence < 2) {
      EXPECT_GT(vulkan().calls(), 0u);
    } else {
      EXPECT_EQ(vulkan().calls(), 0u);
    }
  }
}

/// Around the middle of small_box(), whose sides are 0.45 and longer.
std::vector<Ball> balls_to_follow(const PreparedMesh& box) {
  Point middle = {0, 0, 0};
  for (const Point& p : box.mesh.vertices) middle = middle + 1.0 / static_cast<double>(box.mesh.vertices.size()) * p;
  return {{middle, 0.2}, {middle + Point{0.05, 0, 0}, 0.1}};
}

TEST_F(RecordedJobFaults, OfAJobOfBallsThatFollow) {
  const PreparedMesh mesh = small_box(), moved = sheared(mesh);
  const IndexedMesh indexed = test::indexed(mesh);
  const std::vector<Ball> balls = balls_to_follow(mesh);
  Context context = Context::adopt(host_->lend()).value();
  const auto run = [&]() -> Answer {
    FollowerJobOptions options;
    options.threads = 1;
    const auto create = [&] { return FollowerJob::create(context, indexed, balls, options); };
    Result<FollowerJob> job = in_runtime(create);
    if (!job.ok()) return job.error();
    const auto set = [&] { return job.value().set_vertices(moved.mesh.vertices); };
    if (Status status = in_runtime(set); !status.ok()) return status.error();
    return host_->record_and_run(job.value(), 2);
  };
  for (const Fault fault : kMemoryFaults)
    fail_every_call(fault, "a job of balls that follow", run, [](std::uint64_t) {});
}

// A sequence that could not be recorded is recorded again, from the rest pose and with the vertices that were set.
TEST_F(RecordedJobFaults, OfASequenceOfBallsThatIsRecordedAgain) {
  const PreparedMesh mesh = small_box(), moved = sheared(mesh);
  const IndexedMesh indexed = test::indexed(mesh);
  const std::vector<Ball> balls = balls_to_follow(mesh);
  Context context = Context::adopt(host_->lend()).value();
  const auto make = [&] { return FollowerJob::create(context, indexed, balls).value(); };
  FollowerJob job = make();
  const auto set = [&](const PreparedMesh& to) { EXPECT_TRUE(job.set_vertices(to.mesh.vertices).ok()); };
  set(mesh);
  const std::string at_rest = host_->record_and_run(job, 2).value();
  job.reset();
  set(moved);
  const std::string expected = host_->record_and_run(job, 2).value();
  ASSERT_TRUE(at_rest != expected);
  const auto prepare = [&] {
    job = make();  // whose first sequence is not recorded yet
    set(moved);
  };
  fail_every_recording(
      "a sequence of balls that is recorded again", prepare, [&] { return host_->record_and_run(job, 2); }, expected);
}

// 10,000 frames must take no more memory than a few do, of neither kind.
TEST_F(RecordedJobFaults, LaterSequencesOfBallsAllocateNothing) {
  const PreparedMesh mesh = small_box(), moved = sheared(mesh);
  Context context = Context::adopt(host_->lend()).value();
  FollowerJobOptions options;
  options.frames = 2;
  FollowerJob job = FollowerJob::create(context, test::indexed(mesh), balls_to_follow(mesh), options).value();
  std::vector<std::string> answers;
  for (int sequence = 0; sequence < 8; ++sequence) {
    SCOPED_TRACE(sequence);
    const std::vector<Point>& frame = (sequence % 2 == 0 ? moved : mesh).mesh.vertices;
    ASSERT_TRUE(in_runtime([&] { return job.set_vertices(frame); }).ok());
    vulkan().fail_call(~std::uint64_t{0}, Fault::kOutOfHostMemory);  // none fails, all are counted
    const bool is_first = sequence < 2;
    if (!is_first) fail_new(1);
    const Answer answer = host_->record_and_run(job, 2);
    const bool has_allocated = stop_failing_new();
    EXPECT_FALSE(has_allocated && !is_first);
    ASSERT_TRUE(answer.ok()) << answer.error().message;
    answers.push_back(answer.value());
    EXPECT_EQ(vulkan().calls() > 0, is_first) << vulkan().calls();
  }
  EXPECT_NE(answers[6], answers[7]);
}

std::vector<Point> bent(const IndexedMesh& mesh, int frame) {
  std::vector<Point> vertices(mesh.view().vertices.begin(), mesh.view().vertices.end());
  for (Point& p : vertices) p[2] += 0.03 * frame * p[0] * p[0];
  return vertices;
}

/// In, or around, the tube of a torus.
std::vector<Ball> balls_on_a_circle(double radius) {
  constexpr int kBalls = 80;
  std::vector<Ball> balls;
  balls.reserve(kBalls);
  for (int i = 0; i < kBalls; ++i) balls.push_back({{std::cos(0.08 * i), std::sin(0.08 * i), 0}, radius});
  return balls;
}

/// True if the update has allocated, on this thread.
template <class AnyFollower>
bool allocates(AnyFollower& follower, const std::vector<Point>& frame) {
  fail_new(1);
  const Status status = in_runtime([&] { return follower.update(frame); });
  const bool has_allocated = stop_failing_new();
  EXPECT_TRUE(status.ok() || has_allocated) << status.error().message;
  return has_allocated;
}

// The same on the host, where a frame writes to memory that create() has allocated. The unions of balls that steps
// measure write to the memory of earlier ones.
TEST(FramesOfBalls, AllocateNothing) {
  const IndexedMesh mesh = indexed(prepare(make_torus(1.0, 0.4, 24, 12)));
  const std::vector<Ball> balls = balls_on_a_circle(0.3);
  struct Case {
    FollowRule rule;
    unsigned threads;
    std::uint32_t steps;
    std::uint32_t renewed = 0;
  };
  for (const auto& [rule, threads, steps, renewed] :
       {Case{FollowRule::kTangent, 1, 0}, Case{FollowRule::kTangent, 3, 0}, Case{FollowRule::kTangent, 1, 1},
        Case{FollowRule::kTangent, 3, 2}, Case{FollowRule::kTangent, 1, 1, 5}, Case{FollowRule::kPublished, 1, 0},
        Case{FollowRule::kPublished, 3, 0}}) {
    SCOPED_TRACE(testing::Message() << static_cast<int>(rule) << ", " << threads << " threads, steps: " << steps);
    FollowerOptions options;
    options.rule = rule;
    options.threads = threads;
    options.steps = steps;
    options.renewed = renewed;
    options.renewal_factor = 4;  // where no ball leaves
    Follower follower = Follower::create(mesh, balls, options).value();
    const int motions = steps > 0 ? 3 : 1;
    for (int motion = 1; motion <= motions; ++motion) {
      for (int frame = 0; frame < 10; ++frame) {
        const bool has_memory = steps > 0 ? motion == motions : frame > 0;
        const std::vector<Point> vertices = bent(mesh, frame);
        if (has_memory) {
          EXPECT_FALSE(allocates(follower, vertices)) << "frame " << frame;
        } else {
          EXPECT_TRUE(in_runtime([&] { return follower.update(vertices); }).ok());
        }
      }
      fail_new(1);
      EXPECT_TRUE(in_runtime([&] { return follower.reset(); }).ok());
      EXPECT_FALSE(stop_failing_new());
    }
  }
}

/// Along the boundary of a cube of side 2, whose middle they leave out, and one of radius 0, for which there is a
/// place.
std::vector<Ball> balls_around_a_cavity() {
  constexpr double kCell = 0.4;
  std::vector<Ball> balls;
  for (const int x : {0, 1, 2, 3, 4, 5}) {
    for (const int y : {0, 1, 2, 3, 4, 5}) {
      for (const int z : {0, 1, 2, 3, 4, 5}) {
        const bool is_outer = std::ranges::any_of(std::array{x, y, z}, [](int k) { return k == 0 || k == 5; });
        if (is_outer) balls.push_back({{kCell * x, kCell * y, kCell * z}, 0.9 * kCell});
      }
    }
  }
  balls.push_back({{5, 5, 5}, 0});
  return balls;
}

// Likewise covers, whether or not there are cavities to be searched for and filled.
TEST(FramesOfCovers, AllocateNothing) {
  const IndexedMesh torus = indexed(prepare(make_torus(1.0, 0.4, 24, 12)));
  const IndexedMesh box = indexed(prepare(make_box({2, 2, 2})));
  struct Case {
    bool surface_only, cavity;
    unsigned threads;
    std::uint32_t steps;
  };
  for (const auto& [surface_only, cavity, threads, steps] :
       {Case{true, false, 1, 0}, Case{true, false, 3, 0}, Case{true, false, 1, 1}, Case{true, false, 3, 2},
        Case{false, false, 1, 0}, Case{false, false, 3, 2}, Case{false, true, 1, 0}, Case{false, true, 3, 1}}) {
    SCOPED_TRACE(testing::Message() << threads << " threads, steps: " << steps << ", cavity: " << cavity);
    const IndexedMesh& mesh = cavity ? box : torus;
    CoverFollowerOptions options;
    options.surface_only = surface_only;
    options.threads = threads;
    options.steps = steps;
    CoverFollower follower =
        CoverFollower::create(mesh, cavity ? balls_around_a_cavity() : balls_on_a_circle(0.5), options).value();
    const int motions = steps > 0 || !surface_only ? 3 : 1;
    for (int motion = 1; motion <= motions; ++motion) {
      for (int frame = 0; frame < 10; ++frame) {
        const std::vector<Point> vertices = bent(mesh, frame);
        if (motion == motions) {
          EXPECT_FALSE(allocates(follower, vertices)) << "frame " << frame;
        } else {
          EXPECT_TRUE(in_runtime([&] { return follower.update(vertices); }).ok());
        }
        EXPECT_EQ(follower.state(), surface_only ? CoverState::kSurface : CoverState::kSolid);
        EXPECT_TRUE(!cavity || follower.balls().back().radius > 0) << "no cavity was filled";
      }
    }
    fail_new(1);
    EXPECT_TRUE(in_runtime([&] { return follower.reset(); }).ok());
    EXPECT_FALSE(stop_failing_new());
  }
}

}  // namespace
}  // namespace medial_vk::test
