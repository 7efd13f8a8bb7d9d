#include "output/charts_and_tables/ball_volumes.h"

#include <fmt/format.h>

namespace medial_vk {

std::string encode_ball_volumes(const Significance& significance, const std::vector<MedialSphere>& spheres) {
  std::string text = "point,sheet,volume,area,significance\n";
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double share = significance.of_ball[i];
    text +=
        fmt::format("{},{},{},{},{}\n", i, spheres[i].sheet, share * significance.volume, significance.areas[i], share);
  }
  return text;
}

}  // namespace medial_vk
