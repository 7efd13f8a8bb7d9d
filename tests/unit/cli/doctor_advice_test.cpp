// The advice on the findings, and the text for readers.
#include "cli/doctor/advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/doctor/doctor_text.h"
#include "medial_vk/host_device.h"

namespace medial_vk::cli {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

DriverRecord driver(const std::string& file, const std::vector<std::string>& devices) {
  DriverRecord record;
  record.file = file;
  record.library = "libvulkan_x.so";
  record.api_version = "1.3.230";
  record.devices = devices;
  record.is_probed = true;
  if (devices.empty()) record.problem = "it finds no device here";
  return record;
}

ExaminedDevice device(const std::string& name, const std::string& type, TrialEnd end = TrialEnd::kAgrees) {
  ExaminedDevice examined;
  examined.description.name = name;
  examined.description.type = type;
  examined.description.driver = "some driver 1.0";
  examined.description.api_version = (1u << 22) | (3u << 12) | 230u;
  examined.description.usable = true;
  examined.description.limits = {{"maxPushConstantsSize", 128, 256}};
  examined.description.heaps = {{2ull << 30, true}, {8ull << 30, false}};
  examined.description.subgroups = {8, {"basic", "vote"}, true};
  examined.trial.emplace();
  examined.trial->end = end;
  examined.trial->spheres = 460;
  examined.trial->programs = 29;
  return examined;
}

DoctorRecord on_lavapipe() {
  DoctorRecord record;
  record.machine.system = "Some Linux";
  record.loader = {"/usr/lib/libvulkan.so.1", (1u << 22) | (3u << 12) | 239u, ""};
  record.drivers = {driver("/usr/share/vulkan/icd.d/lvp.json", {"llvmpipe"})};
  record.devices = {device("llvmpipe", "cpu")};
  record.default_device = 0;
  record.default_reason = "the only usable one";
  record.cache.folder = "/home/me/.cache/medial-vk";
  return record;
}

DoctorRecord without_devices() {
  DoctorRecord record = on_lavapipe();
  record.drivers.clear();
  record.devices.clear();
  record.default_device.reset();
  record.listing_problem = record.default_reason = "no Vulkan driver found";
  return record;
}

TEST(DoctorAdvice, ThereIsNoneWhereAllIsWell) { EXPECT_THAT(advice_on(on_lavapipe()), IsEmpty()); }

TEST(DoctorAdvice, WithoutALoader) {
  DoctorRecord record = without_devices();
  record.loader = {"", 0, "libvulkan.so.1: cannot open shared object file"};
  EXPECT_THAT(advice_on(record), Contains(HasSubstr("apt install libvulkan1")));
}

TEST(DoctorAdvice, WithoutADriver) {
  EXPECT_THAT(advice_on(without_devices()), ElementsAre(HasSubstr("apt install mesa-vulkan-drivers")));
  DoctorRecord record = without_devices();
  record.machine.container = "docker";
  EXPECT_THAT(advice_on(record), Contains(HasSubstr("belong in the image")));
}

TEST(DoctorAdvice, VariablesThatHideDriversAreNamed) {
  DoctorRecord record = without_devices();
  record.driver_override = "VK_ICD_FILENAMES";
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("VK_ICD_FILENAMES is set, but names no driver file")));
  record.drivers = {driver("/a.json", {})};
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("unset it")));
  record.driver_override.clear();
  record.drivers[0].excluded = "disabled by VK_LOADER_DRIVERS_DISABLE";
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("unset VK_LOADER_DRIVERS_SELECT")));
}

TEST(DoctorAdvice, ABrokenFileIsToBeRemovedAndTheOthersNamed) {
  DoctorRecord record = without_devices();
  record.drivers = {driver("/bad.json", {}), driver("/good.json", {"llvmpipe"})};
  record.drivers[0].problem = "the file is not JSON";
  record.drivers[0].stops_loader = record.drivers[0].is_broken = true;
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("VK_DRIVER_FILES=/good.json")));
  // Also where this loader passes over it.
  DoctorRecord works = on_lavapipe();
  works.drivers.push_back(record.drivers[0]);
  EXPECT_THAT(advice_on(works), ElementsAre(HasSubstr("/bad.json: the file is not JSON")));
}

TEST(DoctorAdvice, AMissingLibraryMattersOnlyWithoutAnotherDevice) {
  DoctorRecord record = on_lavapipe();
  record.drivers.push_back(driver("/old.json", {}));
  record.drivers[1].problem = "its library cannot be loaded: x.so";
  record.drivers[1].is_broken = true;
  EXPECT_THAT(advice_on(record), IsEmpty());
  record.devices.clear();
  record.default_device.reset();
  EXPECT_THAT(advice_on(record), Contains(HasSubstr("Reinstall the package")));
}

TEST(DoctorAdvice, ADriverThatCrashesIsLeftOut) {
  DoctorRecord record = without_devices();
  record.drivers = {driver("/x/bad_icd.json", {})};
  record.drivers[0].misbehaves = true;
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("VK_LOADER_DRIVERS_DISABLE=bad_icd.json")));
  record.loader.version = (1u << 22) | (3u << 12) | 200u;  // knows no such variable
  record.drivers.push_back(driver("/good.json", {"llvmpipe"}));
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("VK_DRIVER_FILES=/good.json")));
}

TEST(DoctorAdvice, ADeviceThatFailsIsNotToBeUsed) {
  DoctorRecord record = on_lavapipe();
  record.devices[0].trial->end = TrialEnd::kCrashed;
  record.devices[0].trial->problem = "its driver crashed";
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("Do not use device 0, llvmpipe: its driver crashed")));
  record.devices[0].trial->works_without_cache = true;
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("remove the folder /home/me/.cache/medial-vk")));
}

TEST(DoctorAdvice, AChoiceWithoutADeviceIsNamed) {
  DoctorRecord record = on_lavapipe();
  record.default_device.reset();
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("MEDIAL_VK_DEVICE")));
}

TEST(DoctorAdvice, FilesOfTheCardThatDoNotOpenNameTheirGroup) {
  DoctorRecord record = on_lavapipe();
  record.machine.nodes = {{"/dev/dri/renderD128", "render", "Permission denied"}};
  EXPECT_THAT(advice_on(record), Contains(HasSubstr("usermod -aG render")));
  record.devices[0].description.type = "integrated";  // one that is used nevertheless
  EXPECT_THAT(advice_on(record), IsEmpty());
}

TEST(DoctorAdvice, CardsOfNvidiaNeedTheGraphicsPartOfTheirDriver) {
  DoctorRecord record = on_lavapipe();
  record.machine.cards = {{"0000:01:00.0", "NVIDIA", "10de:2684", "nvidia"}};
  EXPECT_THAT(advice_on(record), Contains(HasSubstr("kernel module")));
  record.machine.has_nvidia_kernel = true;
  EXPECT_THAT(advice_on(record), Contains(HasSubstr("nvidia_icd.json")));
  record.machine.container = "docker";
  EXPECT_THAT(advice_on(record), Contains(HasSubstr("NVIDIA_DRIVER_CAPABILITIES=graphics")));
  record.drivers.push_back(driver("/usr/share/vulkan/icd.d/nvidia_icd.json", {}));
  EXPECT_THAT(advice_on(record), Contains(HasSubstr("The image lacks libraries that it loads")));
  record.machine.container.clear();
  EXPECT_THAT(advice_on(record), Contains(HasSubstr("On a server without a display")));
  record.devices.push_back(device("GeForce", "discrete"));
  EXPECT_THAT(advice_on(record), IsEmpty());
}

TEST(DoctorAdvice, CardsOfMesaNeedDevDri) {
  DoctorRecord record = on_lavapipe();
  record.machine.cards = {{"0000:01:00.0", "AMD", "1002:744c", "amdgpu"}};
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("nomodeset")));
  record.machine.container = "docker";
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("--device /dev/dri")));
  record.machine.nodes = {{"/dev/dri/renderD128", "render", ""}};
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("mesa-vulkan-drivers")));
}

TEST(DoctorAdvice, ACacheThatCannotBeWritten) {
  DoctorRecord record = on_lavapipe();
  record.cache.problem = "no file can be written there: Read-only file system";
  EXPECT_THAT(advice_on(record), ElementsAre(HasSubstr("XDG_CACHE_HOME")));
}

TEST(DoctorText, ShowsADeviceWithItsLimits) {
  const std::string text = doctor_text(on_lavapipe(), {}, false);
  EXPECT_THAT(text, HasSubstr("loader      /usr/lib/libvulkan.so.1, version 1.3.239\n"));
  EXPECT_THAT(text, HasSubstr("Device 0: llvmpipe\n"));
  EXPECT_THAT(text, HasSubstr("  file        /usr/share/vulkan/icd.d/lvp.json\n"));
  EXPECT_THAT(text, HasSubstr("  driver      some driver 1.0\n"));
  EXPECT_THAT(text, HasSubstr("  memory      2.0 GiB of the device, 8.0 GiB of the host\n"));
  EXPECT_THAT(text, HasSubstr("  subgroups   8 invocations; basic, vote\n"));
  EXPECT_THAT(text, HasSubstr("  maxPushConstantsSize     128    256\n"));
  EXPECT_THAT(text, HasSubstr("agrees with the CPU reference"));
  EXPECT_THAT(text, HasSubstr("Default device: 0, the only usable one\n"));
  EXPECT_THAT(text, testing::EndsWith("\nResult: the default device works.\n"));
  EXPECT_THAT(text, Not(HasSubstr("Advice")));
  EXPECT_THAT(text, Not(HasSubstr("\x1b")));
}

TEST(DoctorText, ShowsWhatComesOfEachDriverFile) {
  DoctorRecord record = on_lavapipe();
  record.drivers = {driver("/a.json", {"one", "two"}), driver("/b.json", {}), driver("/c.json", {}),
                    driver("/d.json", {})};
  record.drivers[1].detail = "no Vulkan driver finds a device";
  record.drivers[2].problem = "the file is not JSON";
  record.drivers[2].is_broken = true;
  record.drivers[3].excluded = "not selected by VK_LOADER_DRIVERS_SELECT";
  const std::string text = doctor_text(record, {}, false);
  EXPECT_THAT(text, HasSubstr("  /a.json\n    devices   one, two\n"));
  EXPECT_THAT(text, HasSubstr("  /b.json\n    devices   none: it finds no device here\n"));
  EXPECT_THAT(text, HasSubstr("  /c.json\n    problem   the file is not JSON\n"));
  EXPECT_THAT(text, HasSubstr("  /d.json\n    left out  not selected by VK_LOADER_DRIVERS_SELECT\n"));
  EXPECT_THAT(text, HasSubstr("  file        unknown\n"));
  EXPECT_THAT(doctor_text(record, {}, true), HasSubstr("it finds no device here (no Vulkan driver finds a device)\n"));
}

TEST(DoctorText, LinesAreAtMost100CharactersLong) {
  DoctorRecord record = without_devices();
  record.machine.container = "docker";
  record.advice = advice_on(record);
  const std::string text = doctor_text(record, Error{ErrorCode::kNoDevice, "none"}, true);
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; begin = end + 1, end = text.find('\n', begin))
    EXPECT_LE(end - begin, 100u) << text.substr(begin, end - begin);
  EXPECT_THAT(text, testing::EndsWith("Result: there is no device that can be used.\n"));
}

TEST(DoctorText, SaysWhyADeviceIsNotUsable) {
  DoctorRecord record = on_lavapipe();
  ExaminedDevice& poor = record.devices[0];
  poor.trial.reset();
  poor.description.usable = false;
  poor.description.why_not = {"it has no compute queue", "its maxPushConstantsSize is 64, 128 are needed"};
  poor.description.limits[0].there = 64;
  const std::string text = doctor_text(record, Error{ErrorCode::kNoDevice, "none"}, false);
  EXPECT_THAT(text, HasSubstr("not usable  it has no compute queue; its maxPushConstantsSize is 64, 128 are needed\n"));
  EXPECT_THAT(text, HasSubstr("too low\n"));
}

// The text says so of every device.
TEST(DoctorText, NoFeatureIsNeeded) {
  const DeviceRequirements needs = device_requirements();
  EXPECT_THAT(needs.device_extensions, IsEmpty());
  EXPECT_THAT(needs.instance_extensions, IsEmpty());
  const VkPhysicalDeviceFeatures none{};
  EXPECT_EQ(std::memcmp(&needs.features, &none, sizeof(none)), 0);
  EXPECT_EQ(needs.api_version, VK_API_VERSION_1_2);
}

}  // namespace
}  // namespace medial_vk::cli
