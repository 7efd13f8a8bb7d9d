// Poor devices: the same spheres as on a good one, or one error that names the missing feature.
#include <gmock/gmock.h>

#include <cmath>

#include "fault_test.h"
#include "lent_device.h"
#include "vulkan_minimum.h"

namespace medial_vk::test {
namespace {

using testing::HasSubstr;

class PoorDevice : public FaultTest {
 protected:
  /// The error of opening a device with these properties; --list-devices prints the same.
  static Error refused(const DeviceProfile& profile) {
    vulkan().set_profile(profile);
    const Result<Context> context = open();
    EXPECT_FALSE(context.ok());
    if (context.ok()) return {};
    EXPECT_EQ(context.error().code, ErrorCode::kNoDevice);
    const auto devices = Context::list_devices();
    EXPECT_TRUE(devices.ok());
    for (const DeviceDescription& device : devices.value()) {
      EXPECT_FALSE(device.usable);
      EXPECT_FALSE(device.why_not.empty());
      for (const std::string& reason : device.why_not) EXPECT_THAT(context.error().message, HasSubstr(reason));
    }
    return context.error();
  }
};

TEST_F(PoorDevice, WithTheLeastThatVulkanAllowsIsRefusedByName) {
  EXPECT_THAT(refused(minimum_profile(false)).message,
              HasSubstr("its maxPerStageDescriptorStorageBuffers is 4, 16 are needed"));
}

TEST_F(PoorDevice, IsRefusedForEachRequiredLimit) {
  for (const RequiredLimit& required : required_limits()) {
    DeviceProfile profile;
    profile.limits = [&required](VkPhysicalDeviceLimits& limits) { required.of(limits) = required.needed - 1; };
    EXPECT_THAT(refused(profile).message,
                HasSubstr(std::string(required.name) + " is " + std::to_string(required.needed - 1)));
  }
}

TEST_F(PoorDevice, WithoutAComputeQueueIsRefused) {
  DeviceProfile profile;
  profile.no_compute = true;
  EXPECT_THAT(refused(profile).message, HasSubstr("it has no compute queue"));
}

TEST_F(PoorDevice, OfAnOlderVulkanIsRefused) {
  DeviceProfile profile;
  profile.api_version = VK_API_VERSION_1_1;
  EXPECT_THAT(refused(profile).message, HasSubstr("it has Vulkan 1.1.0, 1.2 is needed"));
}

TEST_F(PoorDevice, ThatDoesNotExistIsNotFound) {
  DeviceProfile profile;
  profile.no_devices = true;
  EXPECT_THAT(refused(profile).message, HasSubstr("Vulkan lists no device"));
}

TEST_F(PoorDevice, WhoseListNeverEndsIsTakenAsItIs) {
  DeviceProfile profile;
  profile.never_complete = true;
  vulkan().set_profile(profile);
  const Result<Context> context = open();
  EXPECT_TRUE(context.ok()) << context.error().message;
}

PreparedMesh torus(std::uint32_t around, std::uint32_t along) {
  Mesh mesh = make_torus(1.0, 0.4, around, along);
  rotate(mesh, {1, 2, 3}, 0.7);
  return prepare(std::move(mesh));
}

std::vector<Answer> all_answers(Context& context) {
  std::vector<Answer> answers;
  for (const PreparedMesh& mesh : {small_box(), torus(30, 15)}) {
    for (const Mode mode : {Mode::kCertified, Mode::kThesis}) answers.push_back(extract(context, mesh, mode));
    answers.push_back(make_scene_and_query(context, mesh));
  }
  return answers;
}

TEST_F(PoorDevice, WithNoMoreThanWhatIsRequiredGivesTheSameAnswers) {
  std::vector<std::vector<Answer>> answers;
  for (const bool poor : {false, true}) {
    DeviceProfile profile = poor ? minimum_profile(true) : DeviceProfile{};
    if (poor) {
      // Below the minimum of Vulkan, so that a small mesh is already read through storage buffers.
      profile.limits = [least = profile.limits](VkPhysicalDeviceLimits& limits) {
        least(limits);
        limits.maxTexelBufferElements = 1000;
      };
    }
    vulkan().set_profile(profile);
    vulkan().clear_usage();
    Result<Context> context = open();
    ASSERT_TRUE(context.ok()) << context.error().message;
    answers.push_back(all_answers(context.value()));
    EXPECT_THAT(vulkan().violations(), testing::IsEmpty());
  }
  for (std::size_t i = 0; i < answers[0].size(); ++i) {
    ASSERT_TRUE(answers[0][i].ok()) << answers[0][i].error().message;
    ASSERT_TRUE(answers[1][i].ok()) << answers[1][i].error().message;
    EXPECT_GT(answers[0][i].value().size(), 0u);
    EXPECT_TRUE(answers[1][i].value() == answers[0][i].value()) << "answer " << i;
  }

  // The table of requirements covers the usage.
  const Usage usage = vulkan().usage();
  const std::map<std::string, std::uint32_t> used = {{"maxPerStageDescriptorStorageBuffers", usage.storage_buffers},
                                                     {"maxDescriptorSetStorageBuffers", usage.storage_buffers},
                                                     {"maxPerStageDescriptorSampledImages", usage.texel_buffers},
                                                     {"maxPerStageResources", usage.buffers},
                                                     {"maxPushConstantsSize", usage.push_constant_bytes},
                                                     {"maxComputeSharedMemorySize", usage.shared_bytes},
                                                     {"maxComputeWorkGroupInvocations", usage.workgroup_size},
                                                     {"maxComputeWorkGroupSize[0]", usage.workgroup_size}};
  for (const RequiredLimit& required : required_limits())
    if (used.contains(required.name)) {
      EXPECT_LE(used.at(required.name), required.needed) << required.name;
    }
  EXPECT_EQ(usage.sets, 1u);
  for (const auto& [name, count] : used) std::cout << name << " " << count << "\n";
  std::cout << "allocations of device memory at one time " << usage.allocations << "\n";
}

// A host's device, on which 16 balls follow a torus that bends, and the bytes of those balls.
TEST_F(PoorDevice, FollowsBallsAsAGoodOneDoes) {
  const IndexedMesh mesh = indexed(prepare(make_torus(1.0, 0.4, 24, 12)));
  std::vector<Ball> balls;
  for (int i = 0; i < 16; ++i) balls.push_back({{std::cos(0.35 * i), std::sin(0.35 * i), 0}, 0.3});
  std::vector<Point> bent(mesh.view().vertices.begin(), mesh.view().vertices.end());
  for (Point& p : bent) p[2] += 0.3 * p[0] * p[0];
  std::vector<std::string> followed;
  for (const bool poor : {false, true}) {
    DeviceProfile profile = poor ? minimum_profile(true) : DeviceProfile{};
    if (poor) {
      profile.limits = [least = profile.limits](VkPhysicalDeviceLimits& limits) {
        least(limits);
        limits.maxTexelBufferElements = 1000;  // of 2,304 vectors: they are read through storage buffers
      };
    }
    vulkan().set_profile(profile);
    LentDevice host(open().value());
    Context context = Context::adopt(host.lend()).value();
    Internals::of(context).has_lockstep_lanes = false;  // on both each ball walks the tree by itself
    FollowerJob job = FollowerJob::create(context, mesh, balls).value();
    ASSERT_TRUE(job.set_vertices(bent).ok());
    const Answer answer = host.record_and_run(job, 16);
    ASSERT_TRUE(answer.ok()) << answer.error().message;
    followed.push_back(answer.value());
    EXPECT_THAT(vulkan().violations(), testing::IsEmpty());
  }
  EXPECT_NE(followed[0], std::string(followed[0].size(), '\0'));
  EXPECT_EQ(followed[0], followed[1]);
}

// The least maxTexelBufferElements that Vulkan allows is too low for this mesh.
TEST_F(PoorDevice, ReadsALargeMeshThroughStorageBuffers) {
  const PreparedMesh mesh = torus(140, 64);
  ASSERT_GT(4 * mesh.mesh.triangles.size(), 65536u);
  std::vector<Answer> answers;
  for (const bool poor : {false, true}) {
    vulkan().set_profile(poor ? minimum_profile(true) : DeviceProfile{});
    Result<Context> context = open();
    ASSERT_TRUE(context.ok()) << context.error().message;
    answers.push_back(make_scene_and_query(context.value(), mesh));
    ASSERT_TRUE(answers.back().ok()) << answers.back().error().message;
    EXPECT_THAT(vulkan().violations(), testing::IsEmpty());
  }
  EXPECT_TRUE(answers[0].value() == answers[1].value());
}

// A mesh that exceeds the range of a storage buffer is read as texels: the same number of results, with the same bytes.
TEST_F(PoorDevice, ReadsAMeshBeyondTheStorageBuffersAsTexels) {
  constexpr std::uint32_t kBytes = 1u << 22;  // below the minimum of Vulkan, so that a small mesh is too large
  const PreparedMesh mesh = torus(280, 120);
  ASSERT_GT(64 * mesh.mesh.triangles.size(), kBytes);
  std::vector<std::vector<Answer>> answers;
  for (const bool poor : {false, true}) {
    DeviceProfile profile;
    if (poor) profile.limits = [](VkPhysicalDeviceLimits& limits) { limits.maxStorageBufferRange = kBytes; };
    vulkan().set_profile(profile);
    Result<Context> context = open();
    ASSERT_TRUE(context.ok()) << context.error().message;
    answers.push_back({extract(context.value(), mesh, Mode::kCertified), extract(context.value(), mesh, Mode::kThesis),
                       make_scene_and_query(context.value(), mesh)});
    const Answer& first = answers.back().front();
    if (poor && !first.ok() && first.error().message.find("or 65536 texels") != std::string::npos) {
      GTEST_SKIP() << "this device reads no more texels than the least that Vulkan allows";
    }
    EXPECT_THAT(vulkan().violations(), testing::IsEmpty());
  }
  for (std::size_t i = 0; i < answers[0].size(); ++i) {
    ASSERT_TRUE(answers[0][i].ok()) << answers[0][i].error().message;
    ASSERT_TRUE(answers[1][i].ok()) << answers[1][i].error().message;
    EXPECT_GT(answers[0][i].value().size(), 0u);
    EXPECT_TRUE(answers[1][i].value() == answers[0][i].value()) << "answer " << i;
  }
}

TEST_F(PoorDevice, RefusesAMeshThatItCanReadNeitherWay) {
  vulkan().set_profile(minimum_profile(true));
  Result<Context> context = open();
  ASSERT_TRUE(context.ok()) << context.error().message;
  PreparedMesh mesh = small_box();
  mesh.mesh.triangles.resize((1u << 27) / 64 + 1, mesh.mesh.triangles[0]);
  mesh.flags.resize(mesh.mesh.triangles.size(), mesh.flags[0]);
  const Answer answer = extract(context.value(), mesh, Mode::kCertified);
  ASSERT_FALSE(answer.ok());
  EXPECT_EQ(answer.error().code, ErrorCode::kOutOfMemory);
  EXPECT_THAT(answer.error().message, HasSubstr("the mesh has 2097153 triangles, this device takes 2097152 at most"));
}

}  // namespace
}  // namespace medial_vk::test
