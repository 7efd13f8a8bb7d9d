// Every call of Vulkan that can fail does so once, in every job: the job then ends with an error that gives the cause,
// nothing is leaked, and the context continues to give right results.
#include <gmock/gmock.h>

#include <numeric>
#include <set>

#include "echo_queries.h"
#include "fault_test.h"
#include "lent_device.h"
#include "support/indexed.h"
#include "support/recorded_job.h"

namespace medial_vk::test {
namespace {

TEST_F(VulkanFaults, OfOpeningADevice) {
  // Two small programs: the creation of programs is the same for all.
  const std::set<ProgramKey> keys = {{"prepare_dispatch", 3, 0, sizeof(gpu::DispatchConstants), 1, {}},
                                     {"prepare_resolve", 1, 0, 0, 1, {}}};
  const auto job = [&]() -> Answer {
    Result<Context> context = open();
    if (!context.ok()) return context.error();
    if (Status made = Internals::of(context.value()).make_programs(keys); !made.ok()) return made.error();
    return std::string("made");
  };
  for (const Fault fault : {Fault::kOutOfHostMemory, Fault::kOutOfDeviceMemory})
    fail_every_call(fault, "opening a device", job, [](std::uint64_t) {});
}

TEST_F(VulkanFaults, ADeviceThatIsLostWhileItIsOpenedIsNoDevice) {
  vulkan().fail_call(1, Fault::kDeviceLost);
  const Result<Context> context = open();
  EXPECT_EQ(vulkan().stop_failing(), "vkCreateDevice");
  ASSERT_FALSE(context.ok());
  EXPECT_EQ(context.error().code, ErrorCode::kNoDevice);
  EXPECT_THAT(context.error().message, testing::HasSubstr("the device was lost"));
}

TEST_F(VulkanFaults, OfListingDevices) {
  for (const Fault fault : {Fault::kOutOfHostMemory, Fault::kOutOfDeviceMemory}) {
    for (std::uint64_t k = 1;; k += fault_stride()) {
      vulkan().fail_call(k, fault);
      const auto devices = Context::list_devices();
      if (vulkan().stop_failing().empty()) break;
      ASSERT_FALSE(devices.ok());
      EXPECT_EQ(devices.error().code, ErrorCode::kOutOfMemory);
      EXPECT_EQ(vulkan().leaks(), "");
    }
  }
}

TEST_F(VulkanFaults, OfQueries) {
  const PreparedMesh mesh = small_box();
  fail_every_call_of("queries", [&](Context& context) { return make_scene_and_query(context, mesh); });
}

TEST_F(VulkanFaults, OfManyPoses) {
  fail_every_call_of("many poses", [](Context& context) { return query_bodies(context); });
}

TEST_F(VulkanFaults, OfPosesInBatches) {
  fail_every_call_of("poses in batches", [](Context& context) { return query_bodies(context, true); });
}

TEST_F(VulkanFaults, OfCertifiedExtraction) {
  const PreparedMesh mesh = small_box();
  fail_every_call_of("certified extraction",
                     [&](Context& context) { return extract(context, mesh, Mode::kCertified); });
}

TEST_F(VulkanFaults, OfThesisExtraction) {
  const PreparedMesh mesh = small_box();
  fail_every_call_of("thesis extraction", [&](Context& context) { return extract(context, mesh, Mode::kThesis); });
}

// Semaphores, command buffers on two queues, staging memory; several batches and chunks in progress.
class TwoQueueFaults : public VulkanFaults, public testing::WithParamInterface<LateQueue> {
 protected:
  void SetUp() override {
    VulkanFaults::SetUp();
    DeviceProfile discrete;
    discrete.split_memory = true;
    discrete.copying_queue = GetParam();
    vulkan().set_profile(discrete);
  }
};

TEST_P(TwoQueueFaults, OfQueries) {
  const PreparedMesh mesh = small_box();
  fail_every_call_of("queries, two queues", [&](Context& context) { return make_scene_and_query(context, mesh); });
}

TEST_P(TwoQueueFaults, OfCertifiedExtraction) {
  const PreparedMesh mesh = small_box();
  fail_every_call_of("certified extraction, two queues",
                     [&](Context& context) { return extract(context, mesh, Mode::kCertified); });
}

TEST_P(TwoQueueFaults, OfManyBatches) {
  std::vector<float> values(290);
  std::iota(values.begin(), values.end(), 1.0f);
  fail_every_call_of("many batches, two queues", [&](Context& context) -> Answer {
    std::vector<float> answers;
    QueryBatches batches(Internals::of(context), 64, false);
    const Status status = in_runtime([&] { return batches.run(echo(values, answers)); });
    if (!status.ok()) return status.error();
    std::string out;
    for (const float a : answers) append_bytes(out, a);
    return out;
  });
}

// After any failure the same batches complete all queries again.
TEST_P(TwoQueueFaults, OfBatchesThatStartOver) {
  Context context = open().value();
  QueryBatches batches(Internals::of(context), 64, false);
  std::vector<float> values(290), answers;
  std::iota(values.begin(), values.end(), 1.0f);
  std::uint64_t failures = 0;
  for (const Fault fault : kMemoryFaults) {
    for (std::uint64_t k = 1; !HasFailure(); k += fault_stride()) {
      batches = QueryBatches(Internals::of(context), 64, false);
      vulkan().fail_call(k, fault);
      const Status status = in_runtime([&] { return batches.run(echo(values, answers)); });
      if (vulkan().stop_failing().empty()) break;
      failures += status.ok() ? 0 : 1;
      ASSERT_TRUE(batches.run(echo(values, answers)).ok());
      EXPECT_EQ(answers, values);
    }
  }
  EXPECT_GT(failures * fault_stride(), 100u);
}

// Too many calls to fail each: every 41st; and of the fewer calls that can lose the device, every fifth.
TEST_P(TwoQueueFaults, OfManyChunks) {
  const PreparedMesh mesh = small_box();
  Context context = open().value();
  const auto job = [&]() -> Answer {
    const auto extraction =
        in_runtime([&] { return test::extract_spheres(context, mesh.view(), job_of_many_chunks()); });
    if (!extraction.ok()) return extraction.error();
    return answer_of(extraction.value());
  };
  const std::string expected = job().value();
  for (const Fault fault : {Fault::kOutOfHostMemory, Fault::kOutOfDeviceMemory, Fault::kDeviceLost}) {
    std::uint64_t failures = 0;
    for (std::uint64_t k = 1; !HasFailure(); k += fault_stride() * (fault == Fault::kDeviceLost ? 5 : 41)) {
      vulkan().fail_call(k, fault);
      const Answer answer = job();
      const std::string call = vulkan().stop_failing();
      EXPECT_TRUE(answer.ok() ? answer.value() == expected : answer.error().code == expected_code(fault)) << call;
      EXPECT_THAT(vulkan().violations(), testing::IsEmpty()) << call;
      if (call.empty()) break;
      failures += answer.ok() ? 0 : 1;
    }
    std::cout << "many chunks, " << fault_name(fault) << ": " << failures << " errors\n";
    EXPECT_GT(failures * fault_stride(), 10u);
    EXPECT_TRUE(job().value() == expected);
  }
}

INSTANTIATE_TEST_SUITE_P(, TwoQueueFaults, testing::Values(LateQueue::kCopies, LateQueue::kKernels),
                         [](const auto& test) {
                           return test.param == LateQueue::kCopies ? "CopiesAreLate" : "KernelsAreLate";
                         });

// On a device whose memory the host does not see, where everything goes through staging buffers.
TEST_F(VulkanFaults, OfAnUpdatedScene) {
  DeviceProfile discrete;
  discrete.split_memory = true;
  vulkan().set_profile(discrete);
  {
    Result<Context> context = open();
    ASSERT_TRUE(context.ok()) << context.error().message;
    const PreparedMesh mesh = small_box();
    const PreparedMesh moved = sheared(mesh);
    const IndexedMesh indexed = test::indexed(mesh);
    IndexedMesh indexed_moved = indexed;
    ASSERT_TRUE(indexed_moved.move_vertices(moved.mesh.vertices).ok());
    Scene scene = Scene::create(context.value(), indexed).value();
    const std::string before = query_everything(scene).value();
    const auto job = [&]() -> Answer {
      const Status updated = scene.update(indexed_moved);
      // Afterwards: a scene that is in an intermediate state must report that, and not give results for a mixture of
      // two meshes.
      Answer now = query_everything(scene);
      if (!updated.ok()) {
        EXPECT_TRUE(!now.ok() || now.value() == before);
        return updated.error();
      }
      return now;
    };
    const auto back = [&](std::uint64_t) {
      const Status updated = scene.update(indexed);
      ASSERT_TRUE(updated.ok()) << updated.error().message;
      const Answer now = query_everything(scene);
      ASSERT_TRUE(now.ok());
      EXPECT_TRUE(now.value() == before);
    };
    // Handles change with the resources that a failed update has freed: only the last count is compared, by the
    // fixture.
    const std::string after = job().value();
    for (const Fault fault : {Fault::kOutOfHostMemory, Fault::kOutOfDeviceMemory, Fault::kDeviceFull}) {
      for (std::uint64_t k = 1; !HasFailure(); k += fault_stride()) {
        back(k);
        vulkan().fail_call(k, fault);
        const Answer answer = job();
        const std::string call = vulkan().stop_failing();
        SCOPED_TRACE(std::string(fault_name(fault)) + ", call " + std::to_string(k) + " (" + call + ")");
        if (!answer.ok()) {
          EXPECT_EQ(answer.error().code, ErrorCode::kOutOfMemory) << answer.error().message;
        } else {
          EXPECT_TRUE(answer.value() == after);
        }
        if (call.empty()) {
          std::cout << "update of a scene, " << fault_name(fault) << ": up to call " << k - 1 << "\n";
          break;
        }
      }
    }
  }
}

// A lost device remains lost, and reports that: no call hangs or gives a result.
TEST_F(VulkanFaults, ALostDeviceIsNamed) {
  Result<Context> context = open();
  ASSERT_TRUE(context.ok());
  const PreparedMesh mesh = small_box();
  Scene scene = test::make_scene(context.value(), mesh.view()).value();
  vulkan().fail_call(1, Fault::kDeviceLost);
  for (int i = 0; i < 2; ++i) {
    const auto closest = scene.closest_points(points_around(5));
    ASSERT_FALSE(closest.ok());
    EXPECT_EQ(closest.error().code, ErrorCode::kInternal);
    EXPECT_THAT(closest.error().message, testing::HasSubstr(context.value().device().name));
    EXPECT_THAT(closest.error().message, testing::HasSubstr("was lost"));
  }
}

}  // namespace
}  // namespace medial_vk::test
