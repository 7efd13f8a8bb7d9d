// The findings of `medial-vk doctor`, for its text and its report.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "check_reports/check_report.h"
#include "medial_vk/context.h"

namespace medial_vk {

/// An environment variable that is set and has an effect on Vulkan, or on this program.
struct VariableRecord {
  std::string name;
  std::string value;
  std::string note;  ///< Why it has no effect, else empty.
};

/// A file of a device in /dev.
struct DeviceNode {
  std::string path;
  std::string group;    ///< The group that owns it, by name, or by number if it has none here.
  std::string why_not;  ///< Why this process cannot open it; empty: it can.
};

/// A graphics card that the kernel lists.
struct GraphicsCard {
  std::string address;        ///< On the PCI bus.
  std::string vendor;         ///< A name, or the number in hexadecimal.
  std::string ids;            ///< "10de:2684", vendor and device.
  std::string kernel_driver;  ///< Empty: none is bound to it.
};

struct MachineRecord {
  std::string system;     ///< Name and version of the distribution.
  std::string kernel;     ///< Name, release and architecture.
  std::string container;  ///< "docker", "podman" ...; empty: none was recognised.
  std::vector<GraphicsCard> cards;
  std::vector<DeviceNode> nodes;   ///< /dev/dri and those of NVIDIA.
  bool has_nvidia_kernel = false;  ///< The kernel module of NVIDIA's own driver is loaded.
};

struct LoaderRecord {
  std::string library;        ///< The file that was loaded; empty: none.
  std::uint32_t version = 0;  ///< Packed as by VK_MAKE_API_VERSION; 0: unknown.
  std::string problem;        ///< Why it cannot be used; empty: it can.
};

/// A place where the loader looks for driver files.
struct SearchedPlace {
  std::string path;
  std::string origin;  ///< The variable that names it, or the word for the default.
  bool exists = false;
};

/// A driver file (ICD file): JSON that names the library of a driver.
struct DriverRecord {
  std::string file;
  std::string library;               ///< As the file gives it; a relative path is resolved.
  std::string api_version;           ///< As the file gives it.
  std::string excluded;              ///< The filter that keeps the loader from it; empty: none.
  std::string problem;               ///< Why no device comes from it; empty: devices do.
  std::string detail;                ///< More about the problem, else empty.
  bool stops_loader = false;         ///< Some loaders fail altogether because of this file.
  bool is_broken = false;            ///< The file is at fault, or the library that it names.
  bool misbehaves = false;           ///< A process that used it crashed, or did not end.
  bool is_probed = false;            ///< The loader has been tried with this driver alone.
  std::vector<std::string> devices;  ///< The names of its devices.
};

enum class TrialEnd {
  kAgrees,   ///< The results agree with those of the CPU reference.
  kDiffers,  ///< They do not.
  kError,    ///< The library reported an error.
  kCrashed,  ///< The process ended by a signal.
  kTooLong,  ///< It did not end within the time limit.
};

/// A small extraction on one device.
struct TrialRecord {
  TrialEnd end = TrialEnd::kError;
  std::string problem;  ///< In words, if it does not agree.
  std::uint64_t spheres = 0;
  std::uint64_t undecided = 0;
  std::uint64_t programs = 0;        ///< That the driver compiled or took from the cache.
  double open_seconds = 0;           ///< Opening the device.
  double program_seconds = 0;        ///< Its programs.
  double search_seconds = 0;         ///< The extraction itself, with its certificate.
  CheckReport comparison;            ///< With the CPU reference; empty if the trial did not get that far.
  std::string messages;              ///< What loader and driver wrote meanwhile.
  bool works_without_cache = false;  ///< It agrees if the cached programs are left aside.
};

struct ExaminedDevice {
  DeviceDescription description;
  std::optional<TrialRecord> trial;  ///< None: the device is not usable.
};

struct CacheRecord {
  std::string folder;   ///< Empty: there is none.
  std::string problem;  ///< Why nothing can be kept there; empty: it can.
  std::uint64_t files = 0;
  std::uint64_t bytes = 0;
};

struct DoctorRecord {
  MachineRecord machine;
  LoaderRecord loader;
  std::vector<VariableRecord> variables;
  std::string driver_override;  ///< The variable in the place of the default folders; empty: none.
  std::vector<SearchedPlace> places;
  std::vector<DriverRecord> drivers;
  std::string listing_problem;   ///< Why devices could not be listed; empty: they were.
  std::string listing_messages;  ///< What loader and drivers wrote meanwhile.
  std::vector<ExaminedDevice> devices;
  std::optional<std::uint32_t> default_device;  ///< Its index; none: there is no usable one.
  std::string default_reason;                   ///< Why this one, or why none.
  double reference_seconds = 0;                 ///< The same small extraction by the CPU reference.
  CacheRecord cache;
  std::vector<std::string> advice;  ///< Full sentences.
};

/// The trial of the default device; null if there is none.
inline const TrialRecord* default_trial(const DoctorRecord& record) {
  if (!record.default_device || *record.default_device >= record.devices.size()) return nullptr;
  const std::optional<TrialRecord>& trial = record.devices[*record.default_device].trial;
  return trial ? &*trial : nullptr;
}

/// "1.3.239", of a packed version.
std::string version_text(std::uint32_t version);

}  // namespace medial_vk
