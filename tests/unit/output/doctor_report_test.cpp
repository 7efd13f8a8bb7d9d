// The report of `medial-vk doctor`, and findings on their way between processes.
#include "output/doctor_report/doctor_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "output/doctor_report/findings_json.h"

namespace medial_vk {
namespace {

DeviceDescription some_device() {
  DeviceDescription device;
  device.index = 1;
  device.name = "Some GPU";
  device.type = "discrete";
  device.driver = "driver 1.2";
  device.api_version = (1u << 22) | (3u << 12) | 230u;
  device.memory_bytes = 8ull << 30;
  device.usable = true;
  device.why_not = {};
  device.limits = {{"maxPushConstantsSize", 128, 4294967295u}};
  device.heaps = {{8ull << 30, true}, {1, false}};
  device.subgroups = {32, {"basic", "ballot"}, true};
  return device;
}

TrialRecord some_trial() {
  TrialRecord trial;
  trial.end = TrialEnd::kDiffers;
  trial.problem = "its results are wrong";
  trial.spheres = 460;
  trial.undecided = 2;
  trial.programs = 29;
  trial.open_seconds = 0.125;
  trial.program_seconds = 0.25;
  trial.search_seconds = 0.5;
  trial.comparison.lines = {{"radius", 460, 3, 0.5, "length", "ball 3"}};
  trial.messages = "a line\n";
  trial.works_without_cache = true;
  return trial;
}

TEST(DoctorFindings, DevicesComeBackAsTheyWere) {
  DeviceDescription poor = some_device();
  poor.usable = false;
  poor.why_not = {"it has no compute queue", "its maxPushConstantsSize is 64, 128 are needed"};
  const auto devices = decode_devices(encode_devices({some_device(), poor}));
  ASSERT_TRUE(devices.ok()) << devices.error().message;
  ASSERT_EQ(devices.value().size(), 2u);
  EXPECT_EQ(device_json(devices.value()[0]), device_json(some_device()));
  EXPECT_EQ(devices.value()[0].limits[0].there, 4294967295u);
  EXPECT_EQ(devices.value()[1].why_not, poor.why_not);
  EXPECT_TRUE(decode_devices(encode_devices({})).value().empty());
}

TEST(DoctorFindings, TrialsComeBackAsTheyWere) {
  for (const TrialEnd end :
       {TrialEnd::kAgrees, TrialEnd::kDiffers, TrialEnd::kError, TrialEnd::kCrashed, TrialEnd::kTooLong}) {
    TrialRecord trial = some_trial();
    trial.end = end;
    const auto back = decode_trial(encode_trial(trial));
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back.value().end, end);
    EXPECT_EQ(trial_json(back.value()), trial_json(trial));
  }
}

TEST(DoctorFindings, NamesNeedNotBeUtf8) {
  DeviceDescription device = some_device();
  device.name = "GPU \xff\xfe";
  const auto back = decode_devices(encode_devices({device}));
  ASSERT_TRUE(back.ok());
  EXPECT_THAT(back.value()[0].name, testing::StartsWith("GPU "));
}

TEST(DoctorFindings, OtherTextIsAnError) {
  for (const char* text : {"", "{", "[1]", "[{\"index\": -1}]", "null"}) {
    EXPECT_FALSE(decode_trial(text).ok()) << text;
    EXPECT_FALSE(decode_loader(text).ok()) << text;
  }
  EXPECT_FALSE(decode_devices("[{\"index\": 0}]").ok());
  EXPECT_EQ(decode_devices("x").error().code, ErrorCode::kInternal);
}

TEST(DoctorReport, HasTheVerdictAndEveryFinding) {
  DoctorRecord record;
  record.machine.cards = {{"0000:01:00.0", "NVIDIA", "10de:2684", ""}};
  record.machine.nodes = {{"/dev/dri/renderD128", "render", "Permission denied"}};
  record.loader = {"/usr/lib/libvulkan.so.1", (1u << 22) | (3u << 12) | 239u, ""};
  record.variables = {{"VK_ICD_FILENAMES", "a.json", "ignored"}};
  record.places = {{"/etc/vulkan/icd.d", "default", true}};
  DriverRecord driver;
  driver.file = "/etc/vulkan/icd.d/a.json";
  driver.problem = "the file is empty";
  record.drivers = {driver};
  record.devices = {{some_device(), some_trial()}, {some_device(), std::nullopt}};
  record.default_device = 0;
  record.advice = {"Do this."};

  const Error error = {ErrorCode::kNoDevice, "does not work"};
  const nlohmann::json report = nlohmann::json::parse(doctor_report_json(record, error));
  EXPECT_EQ(report["format"], 1);
  EXPECT_EQ(report["program"], "medial-vk doctor");
  EXPECT_EQ(report["works"], false);
  EXPECT_EQ(report["problem"], "does not work");
  EXPECT_EQ(report["machine"]["graphics_cards"][0]["vendor"], "NVIDIA");
  EXPECT_EQ(report["machine"]["graphics_cards"][0]["kernel_driver"], nullptr);
  EXPECT_EQ(report["machine"]["device_files"][0]["why_not"], "Permission denied");
  EXPECT_EQ(report["loader"]["version"], "1.3.239");
  EXPECT_EQ(report["environment"][0]["name"], "VK_ICD_FILENAMES");
  EXPECT_EQ(report["driver_folders"][0]["exists"], true);
  EXPECT_EQ(report["drivers"][0]["problem"], "the file is empty");
  EXPECT_EQ(report["devices"][0]["vulkan"], "1.3.230");
  EXPECT_EQ(report["devices"][0]["trial"]["end"], "differs");
  EXPECT_EQ(report["devices"][1]["trial"], nullptr);
  EXPECT_EQ(report["default_device"], 0);
  EXPECT_EQ(report["advice"][0], "Do this.");

  const nlohmann::json works = nlohmann::json::parse(doctor_report_json(record, {}));
  EXPECT_EQ(works["works"], true);
  EXPECT_EQ(works["problem"], nullptr);
}

}  // namespace
}  // namespace medial_vk
