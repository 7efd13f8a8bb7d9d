#include "output/distance_files/clearances_csv.h"

#include <fmt/format.h>

#include "common/csv_cell.h"
#include "output/distance_files/distances_csv.h"

namespace medial_vk {

std::string encode_clearances_csv(std::span<const Clearance> clearances) {
  std::string csv = "configuration,state,lower,upper,first,second\n";
  for (std::size_t i = 0; i < clearances.size(); ++i) {
    const Clearance& c = clearances[i];
    csv += fmt::format("{},{},{},{},{},{}\n", i + 1, name_of(c.collision()), c.lower, c.upper, csv_cell(c.first),
                       csv_cell(c.second));
  }
  return csv;
}

}  // namespace medial_vk
