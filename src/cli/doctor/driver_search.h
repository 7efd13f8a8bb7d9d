// The driver files (ICD files) that the Vulkan loader finds, by the rules of its documentation
// (LoaderDriverInterface.md, "Driver Discovery"). They are computed here without the loader, to say what it leaves out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "output/doctor_report/doctor_record.h"

namespace medial_vk::cli {

/// The value of an environment variable; none: it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// That of this process.
Environment process_environment();

struct SearchRules {
  /// A program with more rights than its user (setuid): the loader ignores variables that could bring in libraries.
  bool is_elevated = false;
  /// Loaders since 1.3.234 select and disable drivers by the names of their files.
  bool has_filters = true;
};

struct DriverSearch {
  std::string driver_override;  ///< The variable in the place of the default folders; empty: none.
  std::vector<SearchedPlace> places;
  std::vector<DriverRecord> drivers;  ///< Each with its file and filter; the files are not read.
};

/// Whether a loader of this packed version has them; an unknown one, 0, is taken for a recent one.
bool has_driver_filters(std::uint32_t loader_version);

DriverSearch search_drivers(const Environment& environment, const SearchRules& rules = {});

/// Whether a list such as "intel*,*lvp*" holds the name. As in the loader, letters match in either case, and a star
/// counts at the beginning and the end of an entry only.
bool is_in_filter(const std::string& filter, const std::string& name);

/// The variables that are set and concern Vulkan or this program.
std::vector<VariableRecord> relevant_variables(const Environment& environment, const SearchRules& rules = {});

}  // namespace medial_vk::cli
