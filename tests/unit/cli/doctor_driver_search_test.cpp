// Where the Vulkan loader looks for drivers: the rules of its documentation, and what loader 1.3.239 prints with
// VK_LOADER_DEBUG=driver.
#include "cli/doctor/driver_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "support/device/device.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

using Variables = std::map<std::string, std::string>;

Environment environment(const Variables& variables) {
  return [variables](const std::string& name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found != variables.end() ? std::optional<std::string>(found->second) : std::nullopt;
  };
}

std::vector<std::string> places(const Variables& variables, const SearchRules& rules = {}) {
  std::vector<std::string> paths;
  for (const SearchedPlace& place : search_drivers(environment(variables), rules).places) paths.push_back(place.path);
  return paths;
}

TEST(DriverSearch, DefaultFoldersInTheOrderOfTheLoader) {
  EXPECT_THAT(places({{"HOME", "/home/me"}}), ElementsAre("/home/me/.config/vulkan/icd.d", "/etc/xdg/vulkan/icd.d",
                                                          "/etc/vulkan/icd.d", "/home/me/.local/share/vulkan/icd.d",
                                                          "/usr/local/share/vulkan/icd.d", "/usr/share/vulkan/icd.d"));
  // Without a home folder, as for some services.
  EXPECT_THAT(places({}), ElementsAre("/etc/xdg/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d",
                                      "/usr/share/vulkan/icd.d"));
}

TEST(DriverSearch, VariablesOfXdgReplaceTheirDefaults) {
  EXPECT_THAT(places({{"HOME", "/home/me"},
                      {"XDG_CONFIG_HOME", "/c"},
                      {"XDG_CONFIG_DIRS", "/x/:/y"},
                      {"XDG_DATA_HOME", "/d"},
                      {"XDG_DATA_DIRS", "/a::/b"}}),
              ElementsAre("/c/vulkan/icd.d", "/x/vulkan/icd.d", "/y/vulkan/icd.d", "/etc/vulkan/icd.d",
                          "/d/vulkan/icd.d", "/a/vulkan/icd.d", "/b/vulkan/icd.d"));
  // An empty one counts as not set.
  EXPECT_EQ(places({{"HOME", "/h"}, {"XDG_DATA_DIRS", ""}, {"XDG_CONFIG_HOME", ""}}), places({{"HOME", "/h"}}));
}

class DriverFiles : public testing::Test {
 protected:
  std::string make(const std::string& name) {
    const fs::path file = folder_.path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "{}";
    return file.string();
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  static std::vector<std::string> files(const Variables& variables, const SearchRules& rules = {}) {
    std::vector<std::string> out;
    for (const DriverRecord& driver : search_drivers(environment(variables), rules).drivers) out.push_back(driver.file);
    return out;
  }
  /// The variables of a machine on which all default folders but /etc are in the test's folder.
  Variables here() const {
    return {{"XDG_CONFIG_HOME", path("config")},
            {"XDG_CONFIG_DIRS", path("none")},
            {"XDG_DATA_HOME", path("home")},
            {"XDG_DATA_DIRS", path("data")}};
  }

  test::TemporaryFolder folder_;
};

TEST_F(DriverFiles, AreThoseThatEndInJson) {
  const std::string b = make("data/vulkan/icd.d/b.json"), a = make("data/vulkan/icd.d/a.json");
  make("data/vulkan/icd.d/note.txt");
  const std::string first = make("config/vulkan/icd.d/z.json");
  EXPECT_THAT(files(here()), testing::IsSupersetOf({first, a, b}));
  EXPECT_THAT(files(here()), testing::Not(testing::Contains(path("data/vulkan/icd.d/note.txt"))));
}

TEST_F(DriverFiles, OverridesTakeThePlaceOfAllFolders) {
  const std::string a = make("a.json"), b = make("more/b.json"), c = make("c.json");
  make("data/vulkan/icd.d/d.json");
  Variables variables = here();
  variables["VK_ICD_FILENAMES"] = a + "::" + path("more");
  variables["VK_ADD_DRIVER_FILES"] = c;
  EXPECT_THAT(files(variables), ElementsAre(a, b));
  variables["VK_DRIVER_FILES"] = c + ":" + path("missing.json") + ":" + path("data/vulkan/icd.d/note.txt");
  EXPECT_THAT(files(variables), ElementsAre(c, path("missing.json")));  // the loader reports that it is missing
  EXPECT_EQ(search_drivers(environment(variables)).driver_override, "VK_DRIVER_FILES");
  variables["VK_DRIVER_FILES"] = "";  // set, but to nothing: no driver
  EXPECT_THAT(files(variables), IsEmpty());
  variables.erase("VK_DRIVER_FILES");
  variables.erase("VK_ICD_FILENAMES");
  EXPECT_EQ(files(variables).front(), c);
  EXPECT_THAT(files(variables), testing::Contains(path("data/vulkan/icd.d/d.json")));
}

TEST_F(DriverFiles, OfAProgramWithMoreRightsIgnoreTheVariablesOfItsUser) {
  const std::string a = make("a.json"), system = make("data/vulkan/icd.d/d.json");
  make("home/vulkan/icd.d/e.json");
  Variables variables = here();
  variables["VK_DRIVER_FILES"] = variables["VK_ADD_DRIVER_FILES"] = a;
  const std::vector<std::string> found = files(variables, {.is_elevated = true});
  EXPECT_THAT(found, testing::Contains(system));
  EXPECT_THAT(found, testing::Not(testing::Contains(a)));
  EXPECT_THAT(found, testing::Not(testing::Contains(path("home/vulkan/icd.d/e.json"))));
}

TEST_F(DriverFiles, AreFilteredByName) {
  const std::string all = make("intel_icd.x86_64.json") + ":" + make("lvp_icd.x86_64.json");
  const auto used = [&](const std::string& select, const std::string& disable, const SearchRules& rules = {}) {
    Variables variables = {{"VK_DRIVER_FILES", all}};
    if (select != "-") variables["VK_LOADER_DRIVERS_SELECT"] = select;
    if (disable != "-") variables["VK_LOADER_DRIVERS_DISABLE"] = disable;
    std::string names;
    for (const DriverRecord& driver : search_drivers(environment(variables), rules).drivers)
      if (driver.excluded.empty()) names += fs::path(driver.file).filename().string().substr(0, 1);
    return names;
  };
  EXPECT_EQ(used("-", "-"), "il");
  EXPECT_EQ(used("", ""), "il");
  EXPECT_EQ(used("lvp*", "-"), "l");
  EXPECT_EQ(used("-", "lvp*"), "i");
  EXPECT_EQ(used("-", "*"), "");
  EXPECT_EQ(used("-", "~all~"), "");
  EXPECT_EQ(used("lvp*", "*"), "l");  // what is selected is not disabled
  EXPECT_EQ(used("LVP*", "lvp*"), "l");
  EXPECT_EQ(used("radeon*,x", "-"), "");
  EXPECT_EQ(used("lvp*", "-", {.has_filters = false}), "il");
}

TEST(DriverFilter, StarsCountAtBothEndsOnly) {
  EXPECT_TRUE(is_in_filter("lvp_icd.json", "lvp_icd.json"));
  EXPECT_FALSE(is_in_filter("lvp_icd", "lvp_icd.json"));
  EXPECT_TRUE(is_in_filter("a,*LVP*", "lvp_icd.json"));
  EXPECT_TRUE(is_in_filter("*.json", "lvp_icd.json"));
  EXPECT_TRUE(is_in_filter("*", "lvp_icd.json"));
  EXPECT_FALSE(is_in_filter("lvp*json", "lvp_icd.json"));
  EXPECT_FALSE(is_in_filter("**vp_icd*", "lvp_icd.json"));
  EXPECT_FALSE(is_in_filter("", "lvp_icd.json"));
}

TEST(DriverFilter, IsOfRecentLoaders) {
  const auto version = [](std::uint32_t major, std::uint32_t minor, std::uint32_t patch) {
    return (major << 22) | (minor << 12) | patch;
  };
  EXPECT_FALSE(has_driver_filters(version(1, 3, 233)));
  EXPECT_TRUE(has_driver_filters(version(1, 3, 234)));
  EXPECT_TRUE(has_driver_filters(version(1, 4, 0)));
  EXPECT_TRUE(has_driver_filters(0));
}

TEST(DriverVariables, ThatHaveNoEffectSayWhy) {
  const std::vector<VariableRecord> variables = relevant_variables(
      environment({{"VK_DRIVER_FILES", "a.json"}, {"VK_ICD_FILENAMES", "b.json"}, {"PATH", "/bin"}}));
  ASSERT_EQ(variables.size(), 2u);
  EXPECT_EQ(variables[0].name, "VK_DRIVER_FILES");
  EXPECT_EQ(variables[0].note, "");
  EXPECT_EQ(variables[1].note, "ignored by the loader: VK_DRIVER_FILES is set");
  EXPECT_EQ(relevant_variables(environment({{"VK_LOADER_DRIVERS_SELECT", "*"}}), {.has_filters = false})[0].note,
            "ignored by this loader, which is older than 1.3.234");
  EXPECT_THAT(relevant_variables(environment({})), IsEmpty());
}

}  // namespace
}  // namespace medial_vk::cli
