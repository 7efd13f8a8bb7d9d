// Findings as JSON: in the report, and on their way from the processes that examine drivers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "medial_vk/context.h"
#include "medial_vk/result.h"
#include "output/doctor_report/doctor_record.h"

namespace medial_vk {

nlohmann::ordered_json device_json(const DeviceDescription& device);
nlohmann::ordered_json trial_json(const TrialRecord& trial);

/// Texts of drivers need not be UTF-8: other bytes are replaced.
std::string encode_devices(const std::vector<DeviceDescription>& devices);
std::string encode_trial(const TrialRecord& trial);
std::string encode_loader(const LoaderRecord& loader);
/// The opposite of the encoders. Error: kInternal, of text that they did not write.
Result<std::vector<DeviceDescription>> decode_devices(std::string_view text);
Result<TrialRecord> decode_trial(std::string_view text);
Result<LoaderRecord> decode_loader(std::string_view text);

}  // namespace medial_vk
