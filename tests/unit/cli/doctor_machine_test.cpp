// What is found around Vulkan, in a folder that stands for a machine.
#include "cli/doctor/machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/device/device.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> no_variable(const std::string&) { return std::nullopt; }

class Machine : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    const fs::path file = folder_.path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  void add_card(const std::string& address, const std::string& vendor, const std::string& of_class) {
    const std::string folder = "sys/bus/pci/devices/" + address + "/";
    write(folder + "class", of_class + "\n");
    write(folder + "vendor", vendor + "\n");
    write(folder + "device", "0x2684\n");
  }
  MachineRecord examine(const Environment& environment = no_variable) {
    return examine_machine(environment, folder_.path().string());
  }

  test::TemporaryFolder folder_;
};

TEST_F(Machine, HasASystemAndAKernel) {
  EXPECT_EQ(examine().system, "unknown system");
  write("etc/os-release", "ID=debian\nPRETTY_NAME=\"Debian GNU/Linux 12 (bookworm)\"\n");
  const MachineRecord machine = examine();
  EXPECT_EQ(machine.system, "Debian GNU/Linux 12 (bookworm)");
  EXPECT_THAT(machine.kernel, testing::StartsWith("Linux "));
  EXPECT_EQ(machine.container, "");
}

TEST_F(Machine, ListsGraphicsCardsOnly) {
  add_card("0000:01:00.0", "0x10de", "0x030000");
  add_card("0000:02:00.0", "0x1af4", "0x020000");  // a network card
  add_card("0000:03:00.0", "0xbeef", "0x038000");
  fs::create_directory_symlink("../../../bus/pci/drivers/nvidia",
                               folder_.path() / "sys/bus/pci/devices/0000:01:00.0/driver");
  const std::vector<GraphicsCard> cards = examine().cards;
  ASSERT_EQ(cards.size(), 2u);
  EXPECT_EQ(cards[0].vendor, "NVIDIA");
  EXPECT_EQ(cards[0].ids, "10de:2684");
  EXPECT_EQ(cards[0].kernel_driver, "nvidia");
  EXPECT_EQ(cards[1].vendor, "beef");
  EXPECT_EQ(cards[1].kernel_driver, "");
}

TEST_F(Machine, RecognisesContainers) {
  write("proc/1/cgroup", "0::/system.slice/docker-0123.scope\n");
  EXPECT_EQ(examine().container, "docker");
  write("run/.containerenv", "");
  EXPECT_EQ(examine().container, "podman");
  fs::remove_all(folder_.path() / "run");
  fs::remove_all(folder_.path() / "proc");
  EXPECT_EQ(examine([](const std::string& name) {
              return name == "container" ? std::optional<std::string>("lxc") : std::nullopt;
            }).container,
            "lxc");
}

TEST_F(Machine, ListsDeviceFilesAndWhetherTheyOpen) {
  EXPECT_TRUE(examine().nodes.empty());
  write("dev/dri/renderD128", "");
  write("dev/dri/card0", "");
  fs::create_symlink("nowhere", folder_.path() / "dev/dri/renderD129");
  write("dev/nvidiactl", "");
  write("proc/driver/nvidia/version", "");
  const MachineRecord machine = examine();
  ASSERT_EQ(machine.nodes.size(), 3u);
  EXPECT_EQ(machine.nodes[0].path, "/dev/dri/renderD128");
  EXPECT_EQ(machine.nodes[0].why_not, "");
  EXPECT_FALSE(machine.nodes[0].group.empty());
  EXPECT_EQ(machine.nodes[1].why_not, "No such file or directory");
  EXPECT_EQ(machine.nodes[2].path, "/dev/nvidiactl");
  EXPECT_TRUE(machine.has_nvidia_kernel);
}

TEST_F(Machine, TheCacheIsTriedByWriting) {
  const fs::path folder = folder_.path() / "cache/medial-vk";
  const CacheRecord empty = examine_cache(folder.string());
  EXPECT_EQ(empty.problem, "");
  EXPECT_EQ(empty.files, 0u);
  EXPECT_TRUE(fs::is_empty(folder));
  write("cache/medial-vk/pipelines.bin", "12345");
  EXPECT_EQ(examine_cache(folder.string()).files, 1u);
  EXPECT_EQ(examine_cache(folder.string()).bytes, 5u);
  write("file", "");
  EXPECT_EQ(examine_cache((folder_.path() / "file/medial-vk").string()).problem,
            "the folder cannot be created: Not a directory");
  EXPECT_THAT(examine_cache("/proc/medial-vk").problem, testing::HasSubstr("cannot be"));
  EXPECT_THAT(examine_cache("").problem, testing::HasSubstr("HOME"));
}

}  // namespace
}  // namespace medial_vk::cli
