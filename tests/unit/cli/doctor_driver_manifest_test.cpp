// Driver files: what is read from them, and what keeps the loader from using them.
#include "cli/doctor/driver_manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "support/device/device.h"

namespace medial_vk::cli {
namespace {

DriverRecord read(const std::string& bytes) {
  DriverRecord driver;
  driver.file = "/opt/driver/icd.d/some.json";
  read_manifest(bytes, driver);
  return driver;
}

std::string with(const std::string& icd) { return R"({"file_format_version": "1.0.0", "ICD": {)" + icd + "}}"; }

TEST(DriverManifest, NamesLibraryAndVersion) {
  const DriverRecord driver = read(with(R"("library_path": "/usr/lib/libvulkan_lvp.so", "api_version": "1.1.230")"));
  EXPECT_EQ(driver.problem, "");
  EXPECT_EQ(driver.library, "/usr/lib/libvulkan_lvp.so");
  EXPECT_EQ(driver.api_version, "1.1.230");
  EXPECT_FALSE(driver.stops_loader);
}

TEST(DriverManifest, RelativePathsStartAtTheFile) {
  const auto library = [](const std::string& path) {
    return read(with(R"("library_path": ")" + path + R"(", "api_version": "1.0.5")")).library;
  };
  EXPECT_EQ(library("./libvk_swiftshader.so"), "/opt/driver/icd.d/libvk_swiftshader.so");
  EXPECT_EQ(library("../lib/x.so"), "/opt/driver/lib/x.so");
  EXPECT_EQ(library("libGLX_nvidia.so.0"), "libGLX_nvidia.so.0");  // found by the system
}

TEST(DriverManifest, FaultsAreNamed) {
  EXPECT_EQ(read("").problem, "the file is empty");
  EXPECT_EQ(read(" \n").problem, "the file is empty");
  EXPECT_EQ(read("{\"broken\"").problem, "the file is not JSON");
  EXPECT_EQ(read("[1]").problem, "the file is not a JSON object");
  EXPECT_EQ(read(R"({"ICD": {}})").problem, "the file has no \"file_format_version\"");
  EXPECT_EQ(read(R"({"file_format_version": "1.0.0"})").problem, "the file has no object \"ICD\"");
  EXPECT_EQ(read(R"({"file_format_version": "1.0.0", "ICD": "x"})").problem, "the file has no object \"ICD\"");
  EXPECT_EQ(read(with("")).problem, "the file has no \"library_path\" in \"ICD\"");
  EXPECT_EQ(read(with(R"("library_path": 7)")).problem, "the file has no \"library_path\" in \"ICD\"");
  EXPECT_EQ(read(with(R"("library_path": "a.so")")).problem, "the file has no \"api_version\" in \"ICD\"");
  const char* const other_bits = sizeof(void*) == 8 ? "32" : "64";
  EXPECT_THAT(read(with(R"("library_path": "a.so", "api_version": "1.3.0", "library_arch": ")" +
                        std::string(other_bits) + "\""))
                  .problem,
              testing::HasSubstr(other_bits));
  EXPECT_THAT(read(with(R"("library_path": "a.so", "api_version": "1.3.0", "is_portability_driver": true)")).problem,
              testing::HasSubstr("is_portability_driver"));
}

// As loader 1.3.239: it finds no driver at all beside the first, and crashes at the second.
TEST(DriverManifest, SomeFaultsStopTheLoader) {
  EXPECT_TRUE(read("{\"broken\"").stops_loader);
  EXPECT_TRUE(read("[1]").stops_loader);
  EXPECT_FALSE(read("").stops_loader);
  EXPECT_FALSE(read(with("")).stops_loader);
}

TEST(DriverManifest, DeepAndBinaryFilesAreNoJson) {
  EXPECT_EQ(read(std::string(200000, '[')).problem, "the file is not JSON");
  EXPECT_EQ(read(std::string("\x7f"
                             "ELF\0\xff",
                             6))
                .problem,
            "the file is not JSON");
}

TEST(DriverManifest, FilesThatCannotBeReadSayWhy) {
  const test::TemporaryFolder folder;
  DriverRecord driver;
  driver.file = (folder.path() / "none.json").string();
  read_manifest(driver);
  EXPECT_EQ(driver.problem, "the file cannot be read: No such file or directory");
  EXPECT_TRUE(driver.is_broken);
  driver = {};
  driver.file = folder.path().string();
  read_manifest(driver);
  EXPECT_EQ(driver.problem, "the file cannot be read: Is a directory");
  driver = {};
  driver.file = (folder.path() / "long.json").string();
  std::ofstream(driver.file) << std::string((1 << 20) + 1, ' ');
  read_manifest(driver);
  EXPECT_EQ(driver.problem, "the file is too long for a driver file");
  std::ofstream(driver.file, std::ios::trunc) << with(R"("library_path": "a.so", "api_version": "1.3.0")");
  driver.problem.clear();
  read_manifest(driver);
  EXPECT_EQ(driver.problem, "");
  EXPECT_FALSE(driver.is_broken);
}

}  // namespace
}  // namespace medial_vk::cli
