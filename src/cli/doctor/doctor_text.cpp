#include "cli/doctor/doctor_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"
#include "common/absent_parts.h"
#include "medial_vk/version.h"
#include "platform/machine.h"

namespace medial_vk::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t kWidth = 100;

/// Words in lines of at most kWidth characters where that is possible; the first begins with `first`, the others with
/// as many blanks.
std::string wrapped(const std::string& first, const std::string& text) {
  const std::string indent(first.size(), ' ');
  std::string out, line = first;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (line.size() > indent.size() && line.size() + 1 + word.size() > kWidth) {
      out += line + "\n";
      line = indent;
    }
    line += (line.size() > indent.size() ? " " : "") + word;
  }
  return out + line + "\n";
}

/// "  driver      llvmpipe ..."
std::string field(const char* name, const std::string& text) { return wrapped(fmt::format("  {:<11} ", name), text); }

std::string indented(const std::string& text, const char* by) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) out += by + line + "\n";
  return out;
}

std::string joined(const std::vector<std::string>& texts) { return fmt::format("{}", fmt::join(texts, ", ")); }

std::string machine_text(const MachineRecord& machine) {
  std::string out = field("system", fmt::format("{}; {}", machine.system, machine.kernel));
  if (!machine.container.empty()) out += field("container", machine.container);
  for (const GraphicsCard& card : machine.cards) {
    out += field("card", card.ids.empty()
                             ? card.vendor
                             : fmt::format("{} ({}) at {}, {}", card.vendor, card.ids, card.address,
                                           card.kernel_driver.empty() ? "without a kernel driver"
                                                                      : "kernel driver " + card.kernel_driver));
  }
  if (platform::kIsWindows) return machine.cards.empty() ? out + field("card", "none is registered") : out;
  if (machine.cards.empty()) out += field("card", "none on the PCI bus");
  for (const DeviceNode& node : machine.nodes) {
    out += field("file", fmt::format("{}, group {}: {}", node.path, node.group,
                                     node.why_not.empty() ? "can be opened" : "cannot be opened, " + node.why_not));
  }
  if (machine.nodes.empty()) out += field("files", "no /dev/dri/renderD*, no /dev/nvidia*: no GPU can be reached");
  return out;
}

std::string loader_text(const LoaderRecord& loader) {
  if (loader.library.empty()) return field("loader", "none: " + loader.problem);
  std::string out = field("loader", fmt::format("{}, version {}", loader.library, version_text(loader.version)));
  if (!loader.problem.empty()) out += field("", loader.problem);
  return out;
}

std::string variables_text(const std::vector<VariableRecord>& variables) {
  std::string out;
  for (const VariableRecord& variable : variables) {
    out += field("variable", fmt::format("{}={}{}", variable.name, variable.value,
                                         variable.note.empty() ? "" : "  (" + variable.note + ")"));
  }
  return out;
}

std::string driver_result(const DriverRecord& driver, bool verbose) {
  if (!driver.excluded.empty()) return wrapped("    left out  ", driver.excluded);
  if (!driver.devices.empty()) return wrapped("    devices   ", joined(driver.devices));
  const bool is_at_fault = driver.is_broken || driver.misbehaves;
  const std::string text = driver.problem.empty() ? "not tried" : driver.problem;
  const bool has_detail = verbose && !driver.detail.empty();
  return wrapped(is_at_fault ? "    problem   " : "    devices   ",
                 (is_at_fault ? "" : "none: ") + text + (has_detail ? fmt::format(" ({})", driver.detail) : ""));
}

std::string drivers_text(const DoctorRecord& record, bool verbose) {
  const bool is_default = record.driver_override.empty();
  std::string out =
      fmt::format("Driver files ({})\n",
                  is_default ? platform::kIsWindows ? "from the registry" : "from the default folders of the loader"
                             : "from " + record.driver_override + " alone");
  if (verbose || record.drivers.empty()) {
    for (const SearchedPlace& place : record.places)
      out += fmt::format("  searched: {} ({}{})\n", place.path, place.origin, place.exists ? "" : ", does not exist");
  }
  if (record.drivers.empty()) return out + "  none\n";
  for (const DriverRecord& driver : record.drivers) {
    out += "  " + driver.file + "\n";
    if (verbose && !driver.library.empty())
      out += wrapped("    library   ", fmt::format("{}, Vulkan {}", driver.library, driver.api_version));
    out += driver_result(driver, verbose);
  }
  return out;
}

std::string subgroups_text(const DeviceSubgroups& subgroups) {
  if (subgroups.size == 0) return "unknown";
  return fmt::format("{} invocations; {}{}", subgroups.size, joined(subgroups.operations),
                     subgroups.in_compute ? "" : "; not in compute shaders");
}

std::string heaps_text(const std::vector<DeviceHeap>& heaps) {
  std::vector<std::string> texts;
  texts.reserve(heaps.size());
  for (const DeviceHeap& heap : heaps)
    texts.push_back(memory_size(heap.bytes) + (heap.is_local ? " of the device" : " of the host"));
  return joined(texts);
}

std::string limits_text(const std::vector<DeviceLimit>& limits) {
  Rows rows;
  for (const DeviceLimit& limit : limits) {
    rows.push_back(
        {limit.name, grouped(limit.needed), grouped(limit.there), limit.there >= limit.needed ? "" : "too low"});
  }
  return indented(format_table({{"limit"}, {"needed", true}, {"there", true}, {""}}, rows), "  ");
}

std::string trial_text(const TrialRecord& trial, double reference_seconds) {
  if (trial.end != TrialEnd::kAgrees && trial.comparison.lines.empty()) return "fails: " + trial.problem;
  const double all = trial.open_seconds + trial.program_seconds + trial.search_seconds;
  const std::string time =
      fmt::format("{} medial spheres in {} ({} to open the device, {} for {}, {} for the search)",
                  grouped(trial.spheres), duration(all), duration(trial.open_seconds), duration(trial.program_seconds),
                  counted(trial.programs, "program", "programs"), duration(trial.search_seconds));
  if (trial.end != TrialEnd::kAgrees) return fmt::format("fails: {}; {}", trial.problem, time);
  return fmt::format("{}; agrees with the CPU reference ({})", time, duration(reference_seconds));
}

/// Vulkan does not tell which driver a device comes from; its name does, where drivers were tried one by one.
std::string files_of(const std::string& device, const std::vector<DriverRecord>& drivers) {
  std::vector<std::string> files;
  for (const DriverRecord& driver : drivers)
    if (std::ranges::find(driver.devices, device) != driver.devices.end()) files.push_back(driver.file);
  return files.empty() ? "unknown" : joined(files);
}

std::string device_text(const ExaminedDevice& device, const DoctorRecord& record, bool verbose) {
  const DeviceDescription& description = device.description;
  std::string out = fmt::format("Device {}: {}\n", description.index, description.name);
  out += field("type", description.type);
  out += field("file", files_of(description.name, record.drivers));
  out += field("driver", description.driver);
  out += field("Vulkan", version_text(description.api_version) + " (1.2 is needed)");
  out += field("memory", heaps_text(description.heaps));
  out += field("subgroups", subgroups_text(description.subgroups));
  out += field("features", "none beyond the core of Vulkan 1.2 is needed");
  out += limits_text(description.limits);
  if (!device.trial) return out + field("not usable", fmt::format("{}", fmt::join(description.why_not, "; ")));
  out += field("trial", trial_text(*device.trial, record.reference_seconds));
  if (verbose && !device.trial->comparison.lines.empty())
    out += indented(check_table(device.trial->comparison), "    ");
  if (device.trial->end != TrialEnd::kAgrees || verbose) out += indented(device.trial->messages, "    | ");
  return out;
}

std::string default_text(const DoctorRecord& record) {
  if (!record.default_device) return "Default device: none\n" + wrapped("  ", record.default_reason);
  return wrapped("Default device: ", fmt::format("{}, {}", *record.default_device, record.default_reason));
}

std::string cache_text(const CacheRecord& cache) {
  if (cache.folder.empty()) return field("cache", "none: " + cache.problem);
  return field("cache",
               fmt::format("{}, {}, {}", cache.folder, cache.problem.empty() ? "can be written" : cache.problem,
                           cache.files == 0 ? "empty"
                                            : counted(cache.files, "file", "files") + " of " + byte_size(cache.bytes)));
}

std::string listing_text(const DoctorRecord& record, bool verbose) {
  if (!record.loader.problem.empty()) return {};
  std::string out;
  if (!record.listing_problem.empty()) {
    out = "Devices\n" + wrapped("  none: ", record.listing_problem);
  } else if (record.devices.empty()) {
    out = "Devices\n  none\n";
  }
  const bool shows = !record.listing_messages.empty() && (verbose || record.devices.empty());
  return shows ? out + "  Messages of loader and drivers:\n" + indented(record.listing_messages, "  | ") : out;
}

const char* result_text(const DoctorRecord& record, const Status& verdict) {
  if (verdict.ok()) return "the default device works";
  return record.default_device ? "the default device does not work" : "there is no device that can be used";
}

}  // namespace

std::string doctor_text(const DoctorRecord& record, const Status& verdict, bool verbose) {
  std::string without;
  for (const std::string& part : absent_parts()) without += field("without", part);
  std::vector<std::string> parts = {fmt::format("medial-vk {}\n", version()) + without + machine_text(record.machine) +
                                    loader_text(record.loader) + variables_text(record.variables) +
                                    cache_text(record.cache)};
  parts.push_back(drivers_text(record, verbose));
  parts.push_back(listing_text(record, verbose));
  for (const ExaminedDevice& device : record.devices) parts.push_back(device_text(device, record, verbose));
  parts.push_back(default_text(record));
  if (!record.advice.empty()) {
    std::string advice = "Advice\n";
    for (const std::string& text : record.advice) advice += wrapped("  - ", text);
    parts.push_back(std::move(advice));
  }
  parts.push_back(fmt::format("Result: {}.\n", result_text(record, verdict)));
  std::erase_if(parts, [](const std::string& part) { return part.empty(); });
  return fmt::format("{}", fmt::join(parts, "\n"));
}

}  // namespace medial_vk::cli
