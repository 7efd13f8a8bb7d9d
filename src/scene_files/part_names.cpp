#include "scene_files/part_names.h"

#include <cstdint>
#include <unordered_map>
#include <unordered_set>

namespace medial_vk {
namespace {

constexpr std::size_t kLongest = 48;  // a number may follow

bool is_safe(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

/// Other characters become _, several of them one; none stays at either end.
std::string safe_characters(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    const char kept = is_safe(c) ? c : '_';
    if (kept == '_' && (safe.empty() || safe.back() == '_')) continue;
    if (kept == '-' && safe.empty()) continue;  // no option of another program
    safe += kept;
    if (safe.size() == kLongest) break;
  }
  while (!safe.empty() && safe.back() == '_') safe.pop_back();
  return safe;
}

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::vector<std::string> safe_part_names(std::span<const ScenePart> parts) {
  std::vector<std::string> names;
  std::unordered_set<std::string> taken;
  std::unordered_map<std::string, std::uint64_t>
      last_number;  // by name in lower case, so that no number is tried twice
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::string base = safe_characters(parts[i].name);
    if (base.empty()) base = std::to_string(i + 1);
    std::string name = base;
    std::uint64_t& number = last_number.try_emplace(lower_case(base), 1).first->second;
    while (!taken.insert(lower_case(name)).second) name = base + "-" + std::to_string(++number);
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace medial_vk
