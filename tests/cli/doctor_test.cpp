// `medial-vk doctor` from outside: with and without drivers, with broken ones, and with one that fails on request.
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "paths.h"
#include "support/device/device.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

using nlohmann::json;
using test::run_tool;
using test::ToolCall;
using test::ToolResult;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string driver_file(const std::string& library) {
  return json{{"file_format_version", "1.0.0"}, {"ICD", {{"library_path", library}, {"api_version", "1.1.0"}}}}.dump();
}

class Doctor : public test::ToolTest {
 protected:
  /// With a cache of its own, so that the user's is left alone; Mesa's own cache stays, which saves seconds.
  ToolCall usual_call(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "doctor");
    ToolCall out = {std::move(arguments), path("")};
    const char *cache = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
    if (cache != nullptr || home != nullptr) {
      out.environment["MESA_SHADER_CACHE_DIR"] = cache != nullptr ? cache : std::string(home) + "/.cache";
    }
    out.environment["XDG_CACHE_HOME"] = path("cache");
    return out;
  }

  /// And drivers from these files alone.
  ToolCall call(std::vector<std::string> arguments, const std::string& drivers) const {
    ToolCall out = usual_call(std::move(arguments));
    out.environment["VK_DRIVER_FILES"] = out.environment["VK_ICD_FILENAMES"] = drivers;
    return out;
  }

  /// The driver that fails as `fault` says, in a file of its own.
  ToolCall faulty_call(const std::string& fault, std::vector<std::string> arguments = {}) const {
    test::write_file(path("faulty.json"), driver_file(test::faulty_driver_path()));
    ToolCall out = call(std::move(arguments), path("faulty.json"));
    out.environment["FAULTY_DRIVER"] = fault;
    return out;
  }

  json report() const { return json::parse(test::read_file(path("r.json"))); }
};

/// The driver that fails is lavapipe underneath.
#define MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE() \
  if (::dlopen("libvulkan_lvp.so", RTLD_LAZY | RTLD_LOCAL) == nullptr) GTEST_SKIP() << "there is no lavapipe"

TEST_F(Doctor, HelpGoesToStandardOutput) {
  const ToolResult help = run({"doctor", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("medial-vk doctor [options]"));
  EXPECT_THAT(help.err, IsEmpty());
}

TEST_F(Doctor, WrongUsageIs2) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"doctor", "--bogus"},
                                                    {"doctor", "part.stl"},
                                                    {"doctor", "--time-limit", "0"},
                                                    {"doctor", "-q", "-v"}}) {
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(result.err, HasSubstr("Try medial-vk doctor --help.\n"));
    EXPECT_THAT(result.out, IsEmpty());
  }
}

TEST_F(Doctor, TheDefaultDeviceWorks) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const ToolResult result = run_tool(usual_call({"--report", "r.json"}));
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out, HasSubstr("agrees with the CPU reference"));
  EXPECT_THAT(result.out, testing::EndsWith("Result: the default device works.\n"));
  const json found = report();
  EXPECT_EQ(found["works"], true);
  EXPECT_THAT(found["loader"]["version"].get<std::string>(), testing::StartsWith("1."));
  const json& device = found["devices"][found["default_device"].get<std::size_t>()];
  EXPECT_EQ(device["usable"], true);
  EXPECT_GT(device["subgroups"]["size"], 0);
  EXPECT_EQ(device["limits"].size(), 10u);
  for (const json& limit : device["limits"]) EXPECT_GE(limit["there"], limit["needed"]);
  EXPECT_EQ(device["trial"]["end"], "agrees");
  EXPECT_GT(device["trial"]["spheres"], 400);
  EXPECT_GT(device["trial"]["seconds"]["search"], 0);
  // The name of the device comes from one of the driver files.
  std::vector<std::string> names;
  for (const json& driver : found["drivers"])
    for (const json& name : driver["devices"]) names.push_back(name);
  EXPECT_THAT(names, testing::Contains(device["name"]));
}

TEST_F(Doctor, QuietSaysNothingAndTheReportMayBeStandardOutput) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  const ToolResult quiet = run_tool(faulty_call("none", {"-q"}));
  EXPECT_EQ(quiet.exit_code, 0) << quiet.err;
  EXPECT_THAT(quiet.out + quiet.err, IsEmpty());
  const ToolResult streamed = run_tool(faulty_call("none", {"--report", "-"}));
  EXPECT_EQ(streamed.exit_code, 0);
  EXPECT_EQ(json::parse(streamed.out)["works"], true);
  EXPECT_THAT(streamed.err, HasSubstr("Result: the default device works."));
}

TEST_F(Doctor, VerboseAddsFoldersAndComparisons) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  const ToolResult result = run_tool(faulty_call("none", {"-v"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("searched: " + path("faulty.json")));
  EXPECT_THAT(result.out, HasSubstr("radius <= exact distance"));
}

TEST_F(Doctor, WithoutADriverItIs4AndSaysWhatToDo) {
  ASSERT_EQ(::mkdir(path("empty").c_str(), 0700), 0);
  const ToolResult result = run_tool(call({"--report", "r.json"}, path("empty")));
  EXPECT_EQ(result.exit_code, 4) << result.out << result.err;
  EXPECT_THAT(result.err, testing::StartsWith("medial-vk: "));
  EXPECT_THAT(result.out, HasSubstr("Advice"));
  EXPECT_THAT(result.out, HasSubstr("Result: there is no device that can be used.\n"));
  EXPECT_EQ(report()["works"], false);
  EXPECT_EQ(report()["default_device"], nullptr);
  EXPECT_FALSE(report()["advice"].empty());
}

TEST_F(Doctor, OtherCommandsPointToIt) {
  ToolCall none = call({}, "/nowhere/none.json");
  none.arguments = {"--list-devices"};
  EXPECT_THAT(run_tool(none).err, HasSubstr("medial-vk doctor"));
}

// volk opens libvulkan.so.1 and then libvulkan.so; both are broken here.
TEST_F(Doctor, WithoutALoaderItIs4) {
  for (const char* name : {"libvulkan.so.1", "libvulkan.so"}) test::write_file(path(name), "not a library");
  ToolCall without = call({"--report", "r.json"}, "");
  without.environment["LD_LIBRARY_PATH"] = path("");
  const ToolResult result = run_tool(without);
  EXPECT_EQ(result.exit_code, 4) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("loader      none: "));
  EXPECT_THAT(result.out, HasSubstr("apt install libvulkan1"));
  EXPECT_EQ(report()["loader"]["library"], nullptr);
  EXPECT_THAT(report()["loader"]["problem"].get<std::string>(), HasSubstr("libvulkan.so.1"));
}

TEST_F(Doctor, BrokenDriverFilesAreNamed) {
  test::write_file(path("bad.json"), "{\"broken\"");
  test::write_file(path("missing.json"), driver_file("/nowhere/libvulkan_none.so"));
  test::write_file(path("other.json"), driver_file("libm.so.6"));
  const ToolResult result =
      run_tool(call({"--report", "r.json"}, path("bad.json") + ":" + path("missing.json") + ":" + path("other.json")));
  EXPECT_EQ(result.exit_code, 4) << result.out << result.err;
  const json drivers = report()["drivers"];
  ASSERT_EQ(drivers.size(), 3u);
  EXPECT_EQ(drivers[0]["problem"], "the file is not JSON");
  EXPECT_THAT(drivers[1]["problem"].get<std::string>(), HasSubstr("/nowhere/libvulkan_none.so"));
  EXPECT_EQ(drivers[2]["problem"], "it finds no device here");
  EXPECT_THAT(drivers[2]["detail"].get<std::string>(), HasSubstr("no Vulkan driver"));
}

// Loader 1.3.239 then finds no driver at all, others pass over the file.
TEST_F(Doctor, AFileThatStopsTheLoaderIsNamedWithItsRemedy) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  test::write_file(path("bad.json"), "{\"broken\"");
  ToolCall beside = faulty_call("none");
  beside.environment["VK_DRIVER_FILES"] = path("bad.json") + ":" + path("faulty.json");
  const ToolResult result = run_tool(beside);
  EXPECT_THAT(result.out, HasSubstr("the file is not JSON"));
  if (result.exit_code != 0) {
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_THAT(result.out, HasSubstr("Until then"));
  }
}

TEST_F(Doctor, FiltersAreNamed) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  ToolCall filtered = faulty_call("none", {"--report", "r.json"});
  filtered.environment["VK_LOADER_DRIVERS_DISABLE"] = "*faulty*";
  const ToolResult result = run_tool(filtered);
  if (report()["loader"]["version"] < "1.3.234") GTEST_SKIP() << "this loader has no filters";
  EXPECT_EQ(result.exit_code, 4) << result.out;
  EXPECT_EQ(report()["drivers"][0]["excluded"], "disabled by VK_LOADER_DRIVERS_DISABLE");
}

TEST_F(Doctor, ACacheThatCannotBeWrittenIsAdvice) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  test::write_file(path("file"), "");
  ToolCall without = faulty_call("none", {"--report", "r.json"});
  without.environment["XDG_CACHE_HOME"] = path("file");
  const ToolResult result = run_tool(without);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(report()["cache"]["problem"], "the folder cannot be created: Not a directory");
  EXPECT_THAT(result.out, HasSubstr("Set XDG_CACHE_HOME"));
}

TEST_F(Doctor, AReportThatCannotBeWrittenIs6) {
  EXPECT_EQ(run_tool(call({"--report", "no/such/folder/r.json"}, "")).exit_code, 6);
}

TEST_F(Doctor, TheDeviceOfTheOptionIsTheDefault) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  EXPECT_THAT(run_tool(faulty_call("none", {"--device", "0"})).out, HasSubstr("chosen by --device 0"));
  const ToolResult other = run_tool(faulty_call("none", {"--device", "no such device"}));
  EXPECT_EQ(other.exit_code, 4);
  EXPECT_THAT(other.err, HasSubstr("--device \"no such device\" matches no usable Vulkan device"));
  ToolCall by_variable = faulty_call("none");
  by_variable.environment["MEDIAL_VK_DEVICE"] = "llvm";
  EXPECT_THAT(run_tool(by_variable).out, HasSubstr("chosen by MEDIAL_VK_DEVICE=llvm"));
}

// Each at a time when the tool itself would crash, hang or write wrong results.
TEST_F(Doctor, ADriverThatCrashesIsReported) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  const ToolResult at_once = run_tool(faulty_call("crash_at_once", {"--report", "r.json"}));
  EXPECT_EQ(at_once.exit_code, 4) << at_once.out << at_once.err;
  EXPECT_THAT(report()["drivers"][0]["problem"].get<std::string>(), HasSubstr("crashed"));
  EXPECT_THAT(at_once.out, HasSubstr("fails as soon as it is used"));
  const ToolResult later = run_tool(faulty_call("crash", {"--report", "r.json"}));
  EXPECT_EQ(later.exit_code, 4) << later.out << later.err;
  EXPECT_EQ(report()["devices"][0]["trial"]["end"], "crashed");
  EXPECT_THAT(later.err, HasSubstr("its driver crashed: "));
}

TEST_F(Doctor, ADriverThatHangsIsReported) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  const ToolResult at_once = run_tool(faulty_call("hang_at_once", {"--time-limit", "1"}));
  EXPECT_EQ(at_once.exit_code, 4) << at_once.out << at_once.err;
  EXPECT_THAT(at_once.out, HasSubstr("did not end within 1 s"));
  const ToolResult later = run_tool(faulty_call("hang", {"--time-limit", "6", "--report", "r.json"}));
  EXPECT_EQ(later.exit_code, 4) << later.out << later.err;
  EXPECT_EQ(report()["devices"][0]["trial"]["end"], "too_long");
}

TEST_F(Doctor, WrongResultsAre7) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  const ToolResult result = run_tool(faulty_call("skip_work", {"--report", "r.json"}));
  EXPECT_EQ(result.exit_code, 7) << result.out << result.err;
  EXPECT_EQ(report()["devices"][0]["trial"]["end"], "differs");
  EXPECT_THAT(result.err, HasSubstr("its results are wrong"));
  EXPECT_THAT(result.out, HasSubstr("Do not use device 0"));
}

// Some drivers do not survive what an older version of theirs has kept.
TEST_F(Doctor, ProgramsInTheCacheThatCauseACrashAreNamed) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  EXPECT_EQ(run_tool(faulty_call("crash_with_cache")).exit_code, 0);  // nothing is kept yet
  const ToolResult result = run_tool(faulty_call("crash_with_cache", {"--report", "r.json"}));
  EXPECT_EQ(result.exit_code, 4) << result.out << result.err;
  EXPECT_EQ(report()["devices"][0]["trial"]["end"], "crashed");
  EXPECT_EQ(report()["devices"][0]["trial"]["works_without_cache"], true);
  EXPECT_THAT(report()["advice"].dump(), HasSubstr("remove the folder " + path("cache/medial-vk")));
}

TEST_F(Doctor, ASignalEndsItWhileADriverHangs) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  for (const int signal : {SIGINT, SIGTERM}) {
    test::Tool tool(faulty_call("hang_at_once", {"--report", "r.json"}));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    ASSERT_TRUE(tool.running());
    const auto sent = std::chrono::steady_clock::now();
    tool.send(signal);
    EXPECT_EQ(tool.wait().exit_code, 130);
    EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(5));
    EXPECT_THAT(folder_.names(), Not(testing::Contains("r.json")));
  }
}

// Debian's chromium brings it.
TEST_F(Doctor, TwoDriversAtOnce) {
  MEDIAL_VK_SKIP_WITHOUT_LAVAPIPE();
  const std::string swiftshader = test::swiftshader_icd_path();
  if (!std::filesystem::exists(swiftshader)) GTEST_SKIP() << "there is no SwiftShader";
  ToolCall both = faulty_call("none", {"--report", "r.json", "--device", "SwiftShader"});
  both.environment["VK_DRIVER_FILES"] = path("faulty.json") + ":" + swiftshader;
  both.environment["VK_ICD_FILENAMES"] = both.environment["VK_DRIVER_FILES"];
  const ToolResult result = run_tool(both);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json found = report();
  ASSERT_EQ(found["devices"].size(), 2u);
  for (const json& device : found["devices"]) EXPECT_EQ(device["trial"]["end"], "agrees") << device["name"];
  EXPECT_THAT(result.out, HasSubstr("chosen by --device SwiftShader"));
  EXPECT_EQ(found["drivers"].size(), 2u);
}

}  // namespace
}  // namespace medial_vk
