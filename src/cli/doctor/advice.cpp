#include "cli/doctor/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "cli/doctor/driver_search.h"
#include "platform/machine.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

/// Collects advice from the loader up to the cache.
class Adviser {
 public:
  explicit Adviser(const DoctorRecord& record) : record_(record) {
    const TrialRecord* const trial = default_trial(record);
    works_ = trial != nullptr && trial->end == TrialEnd::kAgrees;
  }

  std::vector<std::string> run() {
    about_loader();
    about_variables();
    about_driver_files();
    about_choice();
    about_trials();
    about_cards();
    about_missing_drivers();
    about_cache();
    return std::move(advice_);
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) {
    advice_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  void about_loader() {
    if (record_.loader.problem.empty()) return;
    if (platform::kIsWindows) {
      say("Install the driver of the graphics card in its newest version, which brings the Vulkan loader, or use "
          "--backend cpu, which needs no Vulkan.");
      return;
    }
    say("Install the Vulkan loader{} (Debian and Ubuntu: apt install libvulkan1; Fedora: dnf install vulkan-loader; "
        "Arch: pacman -S vulkan-icd-loader), or use --backend cpu, which needs no Vulkan.",
        record_.loader.library.empty() ? "" : " in a newer version");
  }

  void about_variables() {
    const auto gives_devices = [](const DriverRecord& driver) { return !driver.devices.empty(); };
    if (!record_.loader.problem.empty() || std::ranges::any_of(record_.drivers, gives_devices)) return;
    const std::string& name = record_.driver_override;
    if (!name.empty() && record_.drivers.empty()) {
      say("{} is set, but names no driver file, so that the loader uses no driver: unset it, or name a file.", name);
    } else if (!name.empty()) {
      say("{} takes the place of the default folders, and no file that it names leads to a device: unset it, or name "
          "another file.",
          name);
    } else if (std::ranges::any_of(record_.drivers, [](const DriverRecord& d) { return !d.excluded.empty(); })) {
      say("The drivers that are left lead to no device: unset VK_LOADER_DRIVERS_SELECT and VK_LOADER_DRIVERS_DISABLE.");
    }
  }

  void about_driver_files() {
    for (const DriverRecord& driver : record_.drivers) {
      const std::string name = platform::file_name_of(driver.file);
      if (driver.stops_loader) {
        say("{}: {}. Some loaders then use no driver at all, or crash. Repair the file or remove it; if it belongs to "
            "a "
            "package, reinstall the package.{}",
            driver.file, driver.problem, other_files());
      } else if (driver.misbehaves) {
        say("The driver of {} fails as soon as it is used. Update it.{}", driver.file,
            has_driver_filters(record_.loader.version)
                ? fmt::format(" Until then leave it out: VK_LOADER_DRIVERS_DISABLE={}", name)
                : other_files());
      } else if (driver.is_broken && !works_) {
        say("{}: {}. Reinstall the package of this driver, or remove the file.", driver.file, driver.problem);
      }
    }
  }

  /// How to go on without the broken files, if the loader does not by itself.
  std::string other_files() const {
    if (record_.listing_problem.empty()) return {};
    std::string files;
    for (const DriverRecord& driver : record_.drivers) {
      if (driver.devices.empty()) continue;
      if (!files.empty()) files += platform::kListSeparator;
      files += driver.file;
    }
    return files.empty() ? "" : fmt::format(" Until then name the others: VK_DRIVER_FILES={}", files);
  }

  /// MEDIAL_VK_DEVICE or --device names none of the devices.
  void about_choice() {
    const bool any = std::ranges::any_of(record_.devices, [](const ExaminedDevice& d) { return d.description.usable; });
    if (record_.default_device || !any) return;
    say("Name one of the devices above that is usable, by its index or a part of its name, in --device or in "
        "MEDIAL_VK_DEVICE, or leave both out.");
  }

  void about_trials() {
    for (const ExaminedDevice& device : record_.devices) {
      if (!device.trial || device.trial->end == TrialEnd::kAgrees) continue;
      const DeviceDescription& description = device.description;
      if (device.trial->works_without_cache) {
        say("Device {} works without the programs that were kept for it: remove the folder {}.", description.index,
            record_.cache.folder);
        continue;
      }
      say("Do not use device {}, {}: {}. Update its driver; until then choose another device by --device or "
          "MEDIAL_VK_DEVICE, or use --backend cpu.",
          description.index, description.name, device.trial->problem);
    }
  }

  static bool is_gpu(const DeviceDescription& device) {
    return device.type == "discrete" || device.type == "integrated" || device.type == "virtual";
  }

  bool has_card_of(const char* vendor) const {
    return std::ranges::any_of(record_.machine.cards, [=](const GraphicsCard& card) { return card.vendor == vendor; });
  }

  bool has_node(std::string_view beginning) const {
    return std::ranges::any_of(record_.machine.nodes,
                               [=](const DeviceNode& node) { return node.path.starts_with(beginning); });
  }

  /// A graphics card that no device stands for.
  void about_cards() {
    if (platform::kIsWindows) return;  // the driver that brings the loader is that of a card
    if (std::ranges::any_of(record_.devices, [](const ExaminedDevice& d) { return is_gpu(d.description); })) return;
    about_access();
    const bool has_nvidia = has_card_of("NVIDIA") || record_.machine.has_nvidia_kernel || has_node("/dev/nvidia");
    if (has_nvidia) about_nvidia();
    if (has_card_of("AMD") || has_card_of("Intel")) about_mesa();
  }

  void about_access() {
    for (const DeviceNode& node : record_.machine.nodes) {
      if (node.why_not.empty()) continue;
      say("This process cannot open {} ({}), which belongs to the group {}. Join the group and log in again: sudo "
          "usermod -aG {} \"$USER\"; for a container: --group-add with the number of that group.",
          node.path, node.why_not, node.group, node.group);
    }
  }

  void about_nvidia() {
    const bool has_file = std::ranges::any_of(
        record_.drivers, [](const DriverRecord& driver) { return driver.file.find("nvidia") != std::string::npos; });
    const bool in_container = !record_.machine.container.empty();
    if (in_container && has_file) {
      say("NVIDIA's driver for Vulkan is in this container, but finds no device. The image lacks libraries that it "
          "loads (Debian and Ubuntu: apt install libegl1 libgl1 libxext6), or the container lacks the capability "
          "\"graphics\": docker run --gpus all -e NVIDIA_DRIVER_CAPABILITIES=graphics,compute,utility ... "
          "Neither a display nor an X server is needed.");
    } else if (in_container) {
      say("The NVIDIA card is not usable in this container, which has no driver file of NVIDIA. It needs the NVIDIA "
          "Container Toolkit, and the capability \"graphics\": docker run --gpus all -e "
          "NVIDIA_DRIVER_CAPABILITIES=graphics,compute,utility ... The toolkit then adds nvidia_icd.json and its "
          "libraries; the image must have libvulkan1, libegl1, libgl1 and libxext6.");
    } else if (!record_.machine.has_nvidia_kernel) {
      say("The kernel module of NVIDIA's driver is not loaded: install the driver of the card (Debian: nvidia-driver; "
          "Ubuntu: ubuntu-drivers install), then restart.");
    } else if (!has_file) {
      say("NVIDIA's driver is there, but not its part for Vulkan, the file nvidia_icd.json (Debian: apt install "
          "nvidia-vulkan-icd; Ubuntu: the package libnvidia-gl of the driver's version; servers often have the "
          "packages for computation alone). No display and no X server is needed.");
    } else {
      say("NVIDIA's driver for Vulkan finds no device. On a server without a display its libraries may lack others "
          "(Debian and Ubuntu: apt install libxext6 libegl1 libgl1); the versions of kernel module and libraries must "
          "be the same. No display and no X server is needed.");
    }
  }

  void about_mesa() {
    if (!has_node("/dev/dri")) {
      if (record_.machine.container.empty()) {
        say("The kernel offers no /dev/dri for the graphics card: its kernel driver (amdgpu, i915 or xe) is not "
            "loaded, "
            "or is switched off by nomodeset.");
      } else {
        say("The container has no /dev/dri, through which drivers reach the graphics card of AMD or Intel: start it "
            "with --device /dev/dri.");
      }
    } else if (works_) {
      say("The graphics card of AMD or Intel is not used: its driver is missing or too old (Debian and Ubuntu: apt "
          "install mesa-vulkan-drivers). No display and no X server is needed.");
    }
  }

  /// A machine without any driver that works here.
  void about_missing_drivers() {
    // Where variables hide drivers, or a file stops the loader, that is the matter.
    const auto is_other_matter = [](const DriverRecord& driver) {
      return !driver.devices.empty() || !driver.excluded.empty() || driver.stops_loader || driver.misbehaves;
    };
    if (!record_.devices.empty() || !record_.driver_override.empty() ||
        std::ranges::any_of(record_.drivers, is_other_matter))
      return;
    if (platform::kIsWindows) {
      say("No driver leads to a device: install the driver of the graphics card. Without one, --backend cpu runs on "
          "one thread.");
      return;
    }
    say("No driver leads to a device. For a graphics card install its driver: that of NVIDIA, or Mesa's for AMD and "
        "Intel. Without a card, on servers and in containers, Mesa's lavapipe computes on the CPU. Those of Mesa are "
        "in one "
        "package (Debian and Ubuntu: apt install mesa-vulkan-drivers; Fedora: dnf install mesa-vulkan-drivers; Arch: "
        "pacman -S vulkan-swrast, vulkan-radeon or vulkan-intel). Without any driver, --backend cpu runs on one "
        "thread.");
    if (!record_.machine.container.empty())
      say("In a container these packages belong in the image; the driver of the host is not seen there.");
  }

  void about_cache() {
    if (record_.cache.problem.empty()) return;
    say("Set {} to a folder that can be written. Without a cache every run compiles its programs again, "
        "which takes some drivers seconds to minutes.",
        platform::kIsWindows ? "LOCALAPPDATA" : "XDG_CACHE_HOME");
  }

  const DoctorRecord& record_;
  bool works_ = false;
  std::vector<std::string> advice_;
};

}  // namespace

std::vector<std::string> advice_on(const DoctorRecord& record) { return Adviser(record).run(); }

}  // namespace medial_vk::cli
