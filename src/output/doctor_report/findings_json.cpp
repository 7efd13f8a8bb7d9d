#include "output/doctor_report/findings_json.h"

#include <array>
#include <utility>

namespace medial_vk {
namespace {

using Json = nlohmann::ordered_json;  // Keys keep their order, which is chosen for readers.

constexpr std::array kTrialEnds = {std::pair{TrialEnd::kAgrees, "agrees"}, std::pair{TrialEnd::kDiffers, "differs"},
                                   std::pair{TrialEnd::kError, "error"}, std::pair{TrialEnd::kCrashed, "crashed"},
                                   std::pair{TrialEnd::kTooLong, "too_long"}};

const char* end_name(TrialEnd end) {
  for (const auto& [value, name] : kTrialEnds)
    if (value == end) return name;
  return "";
}

TrialEnd end_of(const std::string& name) {
  for (const auto& [value, known] : kTrialEnds)
    if (known == name) return value;
  return TrialEnd::kError;
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// The result of `read(json)`, which throws where keys are missing or of another type.
template <class Read>
auto decode(std::string_view text, const Read& read) -> Result<decltype(read(Json()))> {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& error) {
    return Error{ErrorCode::kInternal, std::string("a result cannot be read: ") + error.what()};
  }
}

Json comparison_json(const CheckReport& comparison) {
  Json lines = Json::array();
  for (const CheckLine& line : comparison.lines) {
    lines.push_back({{"condition", line.condition},
                     {"tested", line.tested},
                     {"failed", line.failed},
                     {"worst", line.worst},
                     {"unit", line.unit},
                     {"first_failure", line.first_failure}});
  }
  return lines;
}

CheckReport comparison_of(const Json& lines) {
  CheckReport comparison;
  for (const Json& line : lines) {
    comparison.lines.push_back({line.at("condition"), line.at("tested"), line.at("failed"), line.at("worst"),
                                line.at("unit"), line.at("first_failure")});
  }
  return comparison;
}

DeviceDescription device_of(const Json& json) {
  DeviceDescription device;
  device.index = json.at("index");
  device.name = json.at("name");
  device.type = json.at("type");
  device.driver = json.at("driver");
  device.api_version = json.at("api_version");
  device.memory_bytes = json.at("memory_bytes");
  device.usable = json.at("usable");
  device.why_not = json.at("why_not").get<std::vector<std::string>>();
  for (const Json& limit : json.at("limits"))
    device.limits.push_back({limit.at("name"), limit.at("needed"), limit.at("there")});
  for (const Json& heap : json.at("heaps")) device.heaps.push_back({heap.at("bytes"), heap.at("device_local")});
  const Json& subgroups = json.at("subgroups");
  device.subgroups.size = subgroups.at("size");
  device.subgroups.operations = subgroups.at("operations").get<std::vector<std::string>>();
  device.subgroups.in_compute = subgroups.at("in_compute");
  return device;
}

TrialRecord trial_of(const Json& json) {
  TrialRecord trial;
  trial.end = end_of(json.at("end"));
  trial.problem = json.at("problem");
  trial.spheres = json.at("spheres");
  trial.undecided = json.at("undecided");
  trial.programs = json.at("programs");
  trial.open_seconds = json.at("seconds").at("open");
  trial.program_seconds = json.at("seconds").at("programs");
  trial.search_seconds = json.at("seconds").at("search");
  trial.comparison = comparison_of(json.at("comparison"));
  trial.messages = json.at("messages");
  trial.works_without_cache = json.at("works_without_cache");
  return trial;
}

}  // namespace

Json device_json(const DeviceDescription& device) {
  Json limits = Json::array();
  for (const DeviceLimit& limit : device.limits)
    limits.push_back({{"name", limit.name}, {"needed", limit.needed}, {"there", limit.there}});
  Json heaps = Json::array();
  for (const DeviceHeap& heap : device.heaps) heaps.push_back({{"bytes", heap.bytes}, {"device_local", heap.is_local}});
  return {{"index", device.index},
          {"name", device.name},
          {"type", device.type},
          {"driver", device.driver},
          {"api_version", device.api_version},
          {"vulkan", version_text(device.api_version)},
          {"memory_bytes", device.memory_bytes},
          {"usable", device.usable},
          {"why_not", device.why_not},
          {"limits", limits},
          {"heaps", heaps},
          {"subgroups",
           {{"size", device.subgroups.size},
            {"operations", device.subgroups.operations},
            {"in_compute", device.subgroups.in_compute}}}};
}

Json trial_json(const TrialRecord& trial) {
  return {{"end", end_name(trial.end)},
          {"problem", trial.problem},
          {"spheres", trial.spheres},
          {"undecided", trial.undecided},
          {"programs", trial.programs},
          {"seconds",
           {{"open", trial.open_seconds}, {"programs", trial.program_seconds}, {"search", trial.search_seconds}}},
          {"comparison", comparison_json(trial.comparison)},
          {"messages", trial.messages},
          {"works_without_cache", trial.works_without_cache}};
}

std::string encode_devices(const std::vector<DeviceDescription>& devices) {
  Json json = Json::array();
  for (const DeviceDescription& device : devices) json.push_back(device_json(device));
  return text_of(json);
}

std::string encode_trial(const TrialRecord& trial) { return text_of(trial_json(trial)); }

std::string encode_loader(const LoaderRecord& loader) {
  return text_of({{"library", loader.library}, {"version", loader.version}, {"problem", loader.problem}});
}

Result<std::vector<DeviceDescription>> decode_devices(std::string_view text) {
  return decode(text, [](const Json& json) {
    std::vector<DeviceDescription> devices;
    for (const Json& device : json) devices.push_back(device_of(device));
    return devices;
  });
}

Result<TrialRecord> decode_trial(std::string_view text) { return decode(text, trial_of); }

Result<LoaderRecord> decode_loader(std::string_view text) {
  return decode(text, [](const Json& json) {
    return LoaderRecord{json.at("library"), json.at("version"), json.at("problem")};
  });
}

}  // namespace medial_vk
