#include "cli/doctor/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "platform/files.h"
#include "platform/machine.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

using platform::path_of;
using platform::text_of;
namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

/// Names in a folder, in order; none if it cannot be read.
std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    entries.push_back(it->path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// PRETTY_NAME of /etc/os-release, without its quotation marks.
std::string system_name(const fs::path& root) {
  std::ifstream file(root / "etc/os-release");
  const std::string key = "PRETTY_NAME=";
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    std::erase(line, '"');
    return line.substr(key.size());
  }
  return "unknown system";
}

/// By the marks that container engines leave.
std::string container_kind(const Environment& environment, const fs::path& root) {
  std::error_code error;
  if (fs::exists(root / ".dockerenv", error)) return "docker";
  if (fs::exists(root / "run/.containerenv", error)) return "podman";
  if (environment("KUBERNETES_SERVICE_HOST")) return "kubernetes";
  if (const auto kind = environment("container"); kind && !kind->empty()) return *kind;
  std::ifstream groups(root / "proc/1/cgroup");
  for (std::string line; std::getline(groups, line);) {
    for (const char* mark : {"docker", "kubepods", "containerd", "libpod", "lxc"})
      if (line.find(mark) != std::string::npos) return mark;
  }
  return {};
}

/// "0x10de" without its prefix.
std::string hexadecimal(const std::string& text) { return text.starts_with("0x") ? text.substr(2) : text; }

std::string vendor_name(const std::string& id) {
  constexpr std::array<std::pair<const char*, const char*>, 10> kVendors = {{{"10de", "NVIDIA"},
                                                                             {"1002", "AMD"},
                                                                             {"8086", "Intel"},
                                                                             {"1af4", "virtio"},
                                                                             {"15ad", "VMware"},
                                                                             {"1234", "QEMU"},
                                                                             {"1b36", "QXL"},
                                                                             {"1a03", "ASPEED"},
                                                                             {"102b", "Matrox"},
                                                                             {"1ed5", "Moore Threads"}}};
  for (const auto& [number, name] : kVendors)
    if (id == number) return name;
  return id;
}

/// Cards of the class "display controller", which includes those for computation alone.
std::vector<GraphicsCard> graphics_cards(const fs::path& root) {
  std::vector<GraphicsCard> cards;
  for (const fs::path& entry : entries_of(root / "sys/bus/pci/devices")) {
    if (!first_line(entry / "class").starts_with("0x03")) continue;
    GraphicsCard card;
    card.address = text_of(entry.filename());
    const std::string vendor = hexadecimal(first_line(entry / "vendor"));
    card.vendor = vendor_name(vendor);
    card.ids = vendor + ":" + hexadecimal(first_line(entry / "device"));
    std::error_code error;
    const fs::path driver = fs::read_symlink(entry / "driver", error);
    if (!error) card.kernel_driver = text_of(driver.filename());
    cards.push_back(std::move(card));
  }
  return cards;
}

DeviceNode examine_node(const fs::path& path, const fs::path& root) {
  DeviceNode node;
  node.path = "/" + text_of(path.lexically_relative(root.empty() ? "/" : root));
  node.group = platform::group_of(text_of(path));
  node.why_not = platform::why_not_open(text_of(path));
  return node;
}

/// Those through which drivers reach a card. /dev/dri/card* is for displays, and is not needed.
std::vector<DeviceNode> device_nodes(const fs::path& root) {
  std::vector<DeviceNode> nodes;
  const fs::path top = root.empty() ? fs::path("/") : root;
  for (const fs::path& entry : entries_of(top / "dev/dri"))
    if (text_of(entry.filename()).starts_with("renderD")) nodes.push_back(examine_node(entry, root));
  std::error_code error;
  for (const char* name : {"dev/nvidiactl", "dev/nvidia0", "dev/dxg"})
    if (fs::exists(top / name, error)) nodes.push_back(examine_node(top / name, root));
  return nodes;
}

/// Why no file can be made in the folder; empty: one was, and is removed.
std::string try_to_write(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fmt::format("the folder cannot be created: {}", error.default_error_condition().message());
  const int reason = platform::try_to_write(text_of(folder));
  return reason == 0 ? "" : fmt::format("no file can be written there: {}", std::strerror(reason));
}

}  // namespace

MachineRecord examine_machine(const Environment& environment, const std::string& root) {
  const fs::path top = root.empty() ? fs::path("/") : path_of(root);
  MachineRecord machine;
  machine.system = platform::system_name();
  if (machine.system.empty()) machine.system = system_name(top);
  machine.kernel = platform::kernel_name();
  if (!platform::kIsWindows) machine.container = container_kind(environment, top);
  machine.cards = graphics_cards(top);
  for (std::string& name : platform::registered_adapters()) {
    GraphicsCard card;
    card.vendor = std::move(name);
    machine.cards.push_back(std::move(card));
  }
  machine.nodes = device_nodes(path_of(root));
  std::error_code error;
  machine.has_nvidia_kernel = fs::exists(top / "proc/driver/nvidia/version", error);
  return machine;
}

CacheRecord examine_cache(const std::string& folder) {
  CacheRecord cache;
  cache.folder = folder;
  if (folder.empty()) {
    cache.problem =
        platform::kIsWindows ? "LOCALAPPDATA names no folder" : "neither XDG_CACHE_HOME nor HOME names a folder";
    return cache;
  }
  cache.problem = try_to_write(path_of(folder));
  for (const fs::path& file : entries_of(path_of(folder))) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(file, error);
    if (error) continue;
    ++cache.files;
    cache.bytes += bytes;
  }
  return cache;
}

}  // namespace medial_vk::cli
