#include "cli/doctor/examine_vulkan.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/doctor/child_process.h"
#include "medial_vk/context.h"
#include "medial_vk/host_device.h"
#include "output/doctor_report/findings_json.h"
#include "platform/libraries.h"
#include "platform/processes.h"

namespace medial_vk::cli {
namespace {

// How the texts of the child processes begin.
constexpr std::string_view kDevices = "devices ", kError = "error ", kNoLibrary = "no library ";

/// Usual for drivers of cards that the machine does not have.
constexpr const char* kFindsNone = "it finds no device here";

/// In the child process. volk opens the same names in the same order.
LoaderRecord open_loader() {
  LoaderRecord loader;
  void* const library = platform::load_vulkan(loader.problem);
  if (library == nullptr) return loader;
  loader.problem.clear();
  loader.library = platform::file_of(library);
  const auto enumerate =
      reinterpret_cast<PFN_vkEnumerateInstanceVersion>(platform::function_of(library, "vkEnumerateInstanceVersion"));
  if (enumerate == nullptr || enumerate(&loader.version) != VK_SUCCESS) loader.version = VK_API_VERSION_1_0;
  const std::uint32_t needed = device_requirements().api_version;
  if (loader.version < needed) loader.problem = fmt::format("it is too old, {} is needed", version_text(needed));
  return loader;
}

/// In a child process: the list, or the message of an error, in one text.
std::string encoded_list() {
  // The loader reports drivers that it leaves out only on request; the user's own request stays.
  platform::set_variable("VK_LOADER_DEBUG", "error,warn", false);
  const Result<std::vector<DeviceDescription>> devices = Context::list_devices();
  return devices ? std::string(kDevices) + encode_devices(devices.value())
                 : std::string(kError) + devices.error().message;
}

/// The list, or the message of the child.
Result<std::vector<DeviceDescription>> decoded_list(const std::string& text) {
  if (text.starts_with(kDevices)) return decode_devices(std::string_view(text).substr(kDevices.size()));
  return Error{ErrorCode::kNoDevice, text.starts_with(kError) ? text.substr(kError.size()) : text};
}

/// In a child process.
void use_only(const std::string& driver_file) {
  for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) platform::set_variable(name, driver_file, true);
  for (const char* name : {"VK_LOADER_DRIVERS_SELECT", "VK_LOADER_DRIVERS_DISABLE"}) platform::unset_variable(name);
}

}  // namespace

LoaderRecord examine_loader(std::chrono::milliseconds limit) {
  const Result<ChildOutcome> outcome = run_in_child([] { return encode_loader(open_loader()); }, limit);
  LoaderRecord loader;
  if (!outcome) {
    loader.problem = outcome.error().message;
  } else if (outcome.value().end != ChildEnd::kDone) {
    loader.problem = "the process that opened it " + outcome.value().how;
  } else {
    Result<LoaderRecord> decoded = decode_loader(outcome.value().result);
    if (decoded) return std::move(decoded).value();
    loader.problem = decoded.error().message;
  }
  return loader;
}

void list_devices(std::chrono::milliseconds limit, DoctorRecord& record) {
  Result<ChildOutcome> outcome = run_in_child(encoded_list, limit);
  if (!outcome) {
    record.listing_problem = outcome.error().message;
    return;
  }
  record.listing_messages = std::move(outcome.value().messages);
  if (outcome.value().end != ChildEnd::kDone) {
    record.listing_problem = "the process that listed the devices " + outcome.value().how;
    return;
  }
  Result<std::vector<DeviceDescription>> devices = decoded_list(outcome.value().result);
  if (!devices) {
    record.listing_problem = devices.error().message;
    return;
  }
  for (DeviceDescription& device : devices.value()) record.devices.push_back({std::move(device), std::nullopt});
}

void examine_driver(std::chrono::milliseconds limit, DriverRecord& driver) {
  driver.is_probed = true;
  const auto work = [&driver]() -> std::string {
    std::string problem;
    if (platform::load_library(driver.library, problem) == nullptr) return std::string(kNoLibrary) + problem;
    use_only(driver.file);
    return encoded_list();
  };
  const Result<ChildOutcome> outcome = run_in_child(work, limit);
  if (!outcome) {
    driver.problem = outcome.error().message;
    return;
  }
  if (outcome.value().end != ChildEnd::kDone) {
    driver.problem = "the process that used it alone " + outcome.value().how;
    driver.misbehaves = true;
    return;
  }
  if (outcome.value().result.starts_with(kNoLibrary)) {
    driver.problem = "its library cannot be loaded: " + outcome.value().result.substr(kNoLibrary.size());
    driver.is_broken = true;
    return;
  }
  const Result<std::vector<DeviceDescription>> devices = decoded_list(outcome.value().result);
  if (!devices) {
    driver.problem = kFindsNone;
    driver.detail = devices.error().message;
    return;
  }
  for (const DeviceDescription& device : devices.value()) driver.devices.push_back(device.name);
  if (driver.devices.empty()) driver.problem = kFindsNone;
}

}  // namespace medial_vk::cli
