#include "cli/doctor/driver_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

#include "platform/machine.h"
#include "platform/paths.h"
#include "platform/processes.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolder = "vulkan/icd.d";
constexpr const char* kSelect = "VK_LOADER_DRIVERS_SELECT";
constexpr const char* kDisable = "VK_LOADER_DRIVERS_DISABLE";

std::vector<std::string> split(const std::string& list, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= list.size()) {
    const std::size_t end = std::min(list.find(separator, begin), list.size());
    if (end > begin) parts.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// A variable that is empty counts as not set, as in the XDG rules.
std::optional<std::string> non_empty(const Environment& environment, const char* name) {
  std::optional<std::string> value = environment(name);
  if (value && value->empty()) value.reset();
  return value;
}

/// Collects places in the order of the loader, and the files in them.
class Search {
 public:
  Search(const Environment& environment, const SearchRules& rules) : environment_(environment), rules_(rules) {}

  DriverSearch run() {
    if (const char* name = override_variable(environment_, rules_)) {
      search_.driver_override = name;
      add_list(name);
    } else {
      if (!rules_.is_elevated) add_list("VK_ADD_DRIVER_FILES");
      add_default_folders();
    }
    for (const SearchedPlace& place : search_.places) add_files(place);
    if (search_.driver_override.empty()) add_registered();
    if (rules_.has_filters) filter();
    return std::move(search_);
  }

  /// The one that counts, if it is set, even to nothing.
  static const char* override_variable(const Environment& environment, const SearchRules& rules) {
    if (rules.is_elevated) return nullptr;
    for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"})
      if (environment(name)) return name;
    return nullptr;
  }

 private:
  void add_list(const char* variable) {
    for (const std::string& path : split(environment_(variable).value_or(""), platform::kListSeparator))
      add(path, variable);
  }

  void add_default_folders() {
    if (platform::kIsWindows) return;  // drivers are registered there
    add_home("XDG_CONFIG_HOME", ".config");
    add_folders("XDG_CONFIG_DIRS", "/etc/xdg");
    add(std::string("/etc/") + kFolder, "default");  // SYSCONFDIR of the loader's build
    add_home("XDG_DATA_HOME", ".local/share");
    add_folders("XDG_DATA_DIRS", "/usr/local/share:/usr/share");
  }

  void add_home(const char* variable, const char* below_home) {
    if (rules_.is_elevated) return;
    if (const auto folder = non_empty(environment_, variable)) {
      add(platform::text_of(platform::path_of(*folder) / kFolder), variable);
    } else if (const auto home = non_empty(environment_, "HOME")) {
      add(platform::text_of(platform::path_of(*home) / below_home / kFolder), "default");
    }
  }

  void add_folders(const char* variable, const char* otherwise) {
    const auto given = non_empty(environment_, variable);
    for (const std::string& folder : split(given.value_or(otherwise), ':'))
      add(platform::text_of(platform::path_of(folder) / kFolder), given ? variable : "default");
  }

  void add(const std::string& path, const char* origin) {
    std::error_code ignored;
    const bool is_new = std::none_of(search_.places.begin(), search_.places.end(),
                                     [&](const SearchedPlace& place) { return place.path == path; });
    if (is_new) search_.places.push_back({path, origin, fs::exists(platform::path_of(path), ignored)});
  }

  void add_registered() {
    for (const std::string& file : platform::registered_drivers()) {
      DriverRecord driver;
      driver.file = file;
      search_.drivers.push_back(std::move(driver));
    }
  }

  /// A folder stands for its files. A file need not exist: that is for the loader to report.
  void add_files(const SearchedPlace& place) {
    std::error_code error;
    std::vector<std::string> files;
    const fs::path path = platform::path_of(place.path);
    if (fs::is_directory(path, error)) {
      for (fs::directory_iterator it(path, error), end; !error && it != end; it.increment(error))
        files.push_back(platform::text_of(it->path()));
      std::sort(files.begin(), files.end());
    } else if (!search_.driver_override.empty() || place.origin == "VK_ADD_DRIVER_FILES") {
      files.push_back(place.path);
    }
    for (std::string& file : files) {
      if (!file.ends_with(".json")) continue;
      DriverRecord driver;
      driver.file = std::move(file);
      search_.drivers.push_back(std::move(driver));
    }
  }

  void filter() {
    const std::string select = environment_(kSelect).value_or(""), disable = environment_(kDisable).value_or("");
    for (DriverRecord& driver : search_.drivers) {
      const std::string name = platform::file_name_of(driver.file);
      const bool is_selected = !select.empty() && is_in_filter(select, name);
      const bool is_disabled = !disable.empty() && (is_in_filter(disable, name) || is_in_filter(disable, "~all~"));
      if (!select.empty() && !is_selected) {
        driver.excluded = fmt::format("not selected by {}", kSelect);
      } else if (is_disabled && !is_selected) {
        driver.excluded = fmt::format("disabled by {}", kDisable);
      }
    }
  }

  const Environment& environment_;
  SearchRules rules_;
  DriverSearch search_;
};

/// Why a variable has no effect, or nothing.
std::string note_on(const std::string& name, const Environment& environment, const SearchRules& rules) {
  const bool is_path = name == "VK_DRIVER_FILES" || name == "VK_ICD_FILENAMES" || name == "VK_ADD_DRIVER_FILES";
  const bool is_filter = name == kSelect || name == kDisable;
  if (is_path && rules.is_elevated) return "ignored by the loader: the program has more rights than its user";
  if (is_filter && !rules.has_filters) return "ignored by this loader, which is older than 1.3.234";
  const char* const used = Search::override_variable(environment, rules);
  if (is_path && used != nullptr && name != used) return fmt::format("ignored by the loader: {} is set", used);
  return {};
}

}  // namespace

bool has_driver_filters(std::uint32_t loader_version) {
  constexpr std::uint32_t kFirst = (1u << 22) | (3u << 12) | 234u;  // 1.3.234
  return loader_version == 0 || loader_version >= kFirst;
}

Environment process_environment() {
  return [](const std::string& name) -> std::optional<std::string> { return platform::variable_of(name); };
}

bool is_in_filter(const std::string& filter, const std::string& name) {
  const std::string wanted = lower_case(name);
  for (const std::string& entry : split(filter, ',')) {
    std::string text = lower_case(entry);
    const bool open_begin = text.starts_with('*'), open_end = text.size() > 1 && text.ends_with('*');
    text = text.substr(open_begin ? 1 : 0, text.size() - (open_begin ? 1 : 0) - (open_end ? 1 : 0));
    const bool matches = open_begin && open_end ? wanted.find(text) != std::string::npos
                         : open_begin           ? wanted.ends_with(text)
                         : open_end             ? wanted.starts_with(text)
                                                : wanted == text;
    if (matches) return true;
  }
  return false;
}

DriverSearch search_drivers(const Environment& environment, const SearchRules& rules) {
  return Search(environment, rules).run();
}

std::vector<VariableRecord> relevant_variables(const Environment& environment, const SearchRules& rules) {
  std::vector<VariableRecord> variables;
  for (const char* name : {"MEDIAL_VK_DEVICE",
                           "VK_DRIVER_FILES",
                           "VK_ICD_FILENAMES",
                           "VK_ADD_DRIVER_FILES",
                           kSelect,
                           kDisable,
                           "VK_LOADER_DEBUG",
                           "VK_INSTANCE_LAYERS",
                           "VK_LAYER_PATH",
                           "VK_LOADER_LAYERS_ENABLE",
                           "VK_LOADER_LAYERS_DISABLE",
                           "VK_LOADER_DEVICE_SELECT",
                           "MESA_VK_DEVICE_SELECT",
                           "DRI_PRIME",
                           "LD_LIBRARY_PATH",
                           "XDG_CONFIG_HOME",
                           "XDG_CONFIG_DIRS",
                           "XDG_DATA_HOME",
                           "XDG_DATA_DIRS",
                           "XDG_CACHE_HOME",
                           "NVIDIA_VISIBLE_DEVICES",
                           "NVIDIA_DRIVER_CAPABILITIES"}) {
    if (const std::optional<std::string> value = environment(name))
      variables.push_back({name, *value, note_on(name, environment, rules)});
  }
  return variables;
}

}  // namespace medial_vk::cli
