#include "output/doctor_report/doctor_report.h"

#include <nlohmann/json.hpp>

#include "medial_vk/version.h"
#include "output/doctor_report/findings_json.h"

namespace medial_vk {
namespace {

using Json = nlohmann::ordered_json;  // Keys keep their order, which is chosen for readers.

/// The number of the layout, raised when a key changes its meaning.
constexpr int kReportFormat = 1;

Json or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

Json machine_json(const MachineRecord& machine) {
  Json cards = Json::array();
  for (const GraphicsCard& card : machine.cards) {
    cards.push_back({{"address", card.address},
                     {"vendor", card.vendor},
                     {"ids", card.ids},
                     {"kernel_driver", or_null(card.kernel_driver)}});
  }
  Json nodes = Json::array();
  for (const DeviceNode& node : machine.nodes)
    nodes.push_back({{"path", node.path}, {"group", node.group}, {"why_not", or_null(node.why_not)}});
  return {{"system", machine.system},
          {"kernel", machine.kernel},
          {"container", or_null(machine.container)},
          {"graphics_cards", cards},
          {"device_files", nodes}};
}

Json loader_json(const LoaderRecord& loader) {
  return {{"library", or_null(loader.library)},
          {"version", loader.version == 0 ? Json() : Json(version_text(loader.version))},
          {"problem", or_null(loader.problem)}};
}

Json variables_json(const std::vector<VariableRecord>& variables) {
  Json json = Json::array();
  for (const VariableRecord& variable : variables)
    json.push_back({{"name", variable.name}, {"value", variable.value}, {"note", or_null(variable.note)}});
  return json;
}

Json places_json(const std::vector<SearchedPlace>& places) {
  Json json = Json::array();
  for (const SearchedPlace& place : places)
    json.push_back({{"path", place.path}, {"origin", place.origin}, {"exists", place.exists}});
  return json;
}

Json drivers_json(const std::vector<DriverRecord>& drivers) {
  Json json = Json::array();
  for (const DriverRecord& driver : drivers) {
    json.push_back({{"file", driver.file},
                    {"library", or_null(driver.library)},
                    {"api_version", or_null(driver.api_version)},
                    {"excluded", or_null(driver.excluded)},
                    {"problem", or_null(driver.problem)},
                    {"detail", or_null(driver.detail)},
                    {"devices", driver.devices}});
  }
  return json;
}

Json devices_json(const std::vector<ExaminedDevice>& devices) {
  Json json = Json::array();
  for (const ExaminedDevice& device : devices) {
    Json one = device_json(device.description);
    one["trial"] = device.trial ? trial_json(*device.trial) : Json();
    json.push_back(std::move(one));
  }
  return json;
}

}  // namespace

std::string version_text(std::uint32_t version) {
  // The fields of VK_API_VERSION_MAJOR and its companions.
  return std::to_string((version >> 22) & 0x7fu) + "." + std::to_string((version >> 12) & 0x3ffu) + "." +
         std::to_string(version & 0xfffu);
}

std::string doctor_report_json(const DoctorRecord& record, const Status& verdict) {
  const Json report = {
      {"format", kReportFormat},
      {"program", "medial-vk doctor"},
      {"version", version()},
      {"works", verdict.ok()},
      {"problem", verdict.ok() ? Json() : Json(verdict.error().message)},
      {"machine", machine_json(record.machine)},
      {"environment", variables_json(record.variables)},
      {"loader", loader_json(record.loader)},
      {"driver_override", or_null(record.driver_override)},
      {"driver_folders", places_json(record.places)},
      {"drivers", drivers_json(record.drivers)},
      {"listing", {{"problem", or_null(record.listing_problem)}, {"messages", record.listing_messages}}},
      {"devices", devices_json(record.devices)},
      {"default_device", record.default_device ? Json(*record.default_device) : Json()},
      {"default_reason", record.default_reason},
      {"reference_seconds", record.reference_seconds},
      {"cache",
       {{"folder", or_null(record.cache.folder)},
        {"problem", or_null(record.cache.problem)},
        {"files", record.cache.files},
        {"bytes", record.cache.bytes}}},
      {"advice", record.advice}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk
