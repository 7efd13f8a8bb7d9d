// Every call of Vulkan that can fail while a picture is drawn does so once: drawing then ends with an error that names
// the call, for which the CPU draws instead (DevicePicture.SaysWhoDrewIt), and nothing stays behind.
#include <set>

#include "fault_test.h"
#include "output/picture/vulkan/device_painter.h"

namespace medial_vk::test {
namespace {

class PictureFaults : public FaultTest {
 protected:
  void SetUp() override {
    FaultTest::SetUp();
    if (IsSkipped()) return;
    device_ = open().value().device();
    MedialSphere sphere;
    sphere.centre = {0.5, 0.35, 0.225};
    sphere.radius = 0.2;
    sphere.spoke_a = {0, 0, 1};
    sphere.spoke_b = {0, 0, -1};
    scene_ = picture::make_scene(make_box({1.0, 0.7, 0.45}), {&sphere, 1}, 0.1, {.show = PictureShow::kBoth});
  }

  /// The pixels.
  Answer draw(const picture::PainterOptions& options = {.loader = VulkanInterposer::entry()}) const {
    Picture out = {60, 30, std::vector<std::uint8_t>(std::size_t{3} * 60 * 30)};
    Result<picture::DevicePainter> painter = picture::DevicePainter::open(device_, options);
    if (!painter.ok()) return painter.error();
    const auto panels = picture::panels_of(PictureShow::kBoth, out.width);
    const Status drawn = painter.value().draw(scene_, panels, {.towards = {1, 0.4, 0.3}}, out);
    if (!drawn.ok()) return drawn.error();
    return std::string(out.rgb.begin(), out.rgb.end());
  }

  /// The first call, then the second, and so on until drawing needs fewer calls. Returns the functions that failed.
  std::set<std::string> fail_every_call(Fault fault, const std::string& why) const {
    const std::string expected = draw().value();
    std::set<std::string> functions;
    for (std::uint64_t k = 1; !HasFailure(); ++k) {
      vulkan().fail_call(k, fault);
      const Answer answer = draw();
      const std::string call = vulkan().stop_failing();
      SCOPED_TRACE(std::string(fault_name(fault)) + ", call " + std::to_string(k) + " (" + call + ")");
      EXPECT_EQ(vulkan().leaks(), "");
      EXPECT_THAT(vulkan().violations(), testing::IsEmpty());
      if (call.empty()) {
        EXPECT_TRUE(answer.ok() && answer.value() == expected);
        std::cout << "a picture, " << fault_name(fault) << ": " << k - 1 << " calls, of " << functions.size()
                  << " functions\n";
        break;
      }
      functions.insert(call);
      if (answer.ok()) {
        EXPECT_EQ(call, "vkDeviceWaitIdle");  // when all is drawn
        EXPECT_TRUE(answer.value() == expected);
      } else {
        EXPECT_EQ(answer.error().code, ErrorCode::kNoDevice);
        EXPECT_EQ(answer.error().message, call + " failed: " + why);
      }
    }
    return functions;
  }

  DeviceDescription device_;
  picture::Scene scene_;
};

TEST_F(PictureFaults, OfMemory) {
  EXPECT_GT(fail_every_call(Fault::kOutOfHostMemory, "out of host memory").size(), 20u);
  EXPECT_GT(fail_every_call(Fault::kOutOfDeviceMemory, "out of device memory").size(), 20u);
  fail_every_call(Fault::kDeviceFull, "out of device memory");
}

TEST_F(PictureFaults, OfALostDevice) {
  const std::set<std::string> functions = fail_every_call(Fault::kDeviceLost, "device lost");
  EXPECT_TRUE(functions.contains("vkCreateDevice") && functions.contains("vkWaitForFences"));
}

TEST_F(PictureFaults, OfALoaderOrADeviceThatIsNotThere) {
  const auto broken = [](VkInstance, const char*) -> PFN_vkVoidFunction { return nullptr; };
  EXPECT_EQ(draw({.loader = broken}).error().message, "the Vulkan loader is broken");
  DeviceProfile none;
  none.no_devices = true;
  vulkan().set_profile(none);
  EXPECT_EQ(draw().error().message, device_.name + " is gone");
}

TEST_F(PictureFaults, OfADeviceThatDoesNotDraw) {
  DeviceProfile profile;
  profile.missing_format = VK_FORMAT_D32_SFLOAT;
  vulkan().set_profile(profile);
  EXPECT_EQ(draw().error().message, "the device does not draw with images of VkFormat 126");
  profile.no_graphics = true;
  vulkan().set_profile(profile);
  EXPECT_EQ(draw().error().message, device_.name + " has no graphics queue");
}

}  // namespace
}  // namespace medial_vk::test
