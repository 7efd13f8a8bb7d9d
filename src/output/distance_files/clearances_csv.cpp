#include "output/distance_files/clearances_csv.h"

#include <fmt/format.h>

#include "output/distance_files/distances_csv.h"

namespace medial_vk {
namespace {

/// As RFC 4180 requires.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + '"';
}

}  // namespace

std::string encode_clearances_csv(std::span<const Clearance> clearances) {
  std::string csv = "configuration,state,lower,upper,first,second\n";
  for (std::size_t i = 0; i < clearances.size(); ++i) {
    const Clearance& c = clearances[i];
    csv += fmt::format("{},{},{},{},{},{}\n", i + 1, name_of(c.collision()), c.lower, c.upper, csv_field(c.first),
                       csv_field(c.second));
  }
  return csv;
}

}  // namespace medial_vk
