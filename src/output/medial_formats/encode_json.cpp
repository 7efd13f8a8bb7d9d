#include "output/medial_formats/encode_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace medial_vk {
namespace {

/// The number of the layout, raised when a key changes its meaning.
constexpr int kPointsFormat = 1;

template <class T>
std::string triple(const std::array<T, 3>& x) {
  return fmt::format("[{},{},{}]", x[0], x[1], x[2]);
}

std::string header_text(const MedialHeader& header) {
  return fmt::format(
      "\"format\": {},\n\"program\": \"medial-vk\",\n\"version\": {},\n\"grid_origin\": {},\n\"voxel_size\": {},\n"
      "\"epsilon\": {},\n\"object_angle_threshold\": {},\n\"radius_threshold\": {},\n",
      kPointsFormat, nlohmann::json(header.version).dump(), triple(header.grid_origin), header.voxel_size,
      header.epsilon, header.object_angle, header.radius_threshold);
}

}  // namespace

// Written by hand: a tree of all points takes several times the memory of the file, and a library prints floats with
// the digits of doubles.
std::string encode_json(const MedialHeader& header, std::span<const MedialSphere> spheres,
                        std::span<const std::uint8_t> marks) {
  std::string out = "{\n" + header_text(header) + "\"points\": [";
  const char* separator = "\n";
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const MedialSphere& s = spheres[i];
    out += fmt::format(
        "{}{{\"centre\":{},\"radius\":{},\"spoke_a\":{},\"spoke_b\":{},\"object_angle\":{},\"flux\":{},"
        "\"sheet\":{},\"seam\":{},\"rim\":{},\"voxel\":{}{}}}",
        separator, triple(s.centre), s.radius, triple(s.spoke_a), triple(s.spoke_b), s.object_angle, s.flux, s.sheet,
        (marks[i] & kSeam) != 0, (marks[i] & kRim) != 0, triple(s.voxel),
        header.inside_count ? fmt::format(",\"side\":\"{}\"", side_name(header.side_of(i))) : "");
    separator = ",\n";
  }
  return out + "\n]\n}\n";
}

}  // namespace medial_vk
