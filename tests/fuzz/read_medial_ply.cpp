// The reader of the medial PLY, on any bytes; accepted input is written and read again.
#include <cmath>

#include "fuzz/require.h"
#include "output/medial_ply/medial_file.h"

namespace medial_vk::fuzz {
namespace {

void require_same(const MedialFile& a, const MedialFile& b) {
  require(a.header.version == b.header.version && a.header.grid_origin == b.header.grid_origin &&
              a.header.voxel_size == b.header.voxel_size && a.header.epsilon == b.header.epsilon &&
              a.header.object_angle == b.header.object_angle && a.header.radius_threshold == b.header.radius_threshold,
          "a header reads back as written");
  require(a.spheres.size() == b.spheres.size(), "every point reads back");
  for (std::size_t i = 0; i < a.spheres.size(); ++i) {
    const MedialSphere &s = a.spheres[i], &t = b.spheres[i];
    require(s.centre == t.centre && s.radius == t.radius && s.spoke_a == t.spoke_a && s.spoke_b == t.spoke_b &&
                s.object_angle == t.object_angle && s.flux == t.flux && s.sheet == t.sheet && s.voxel == t.voxel,
            "a point reads back as written");
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string_view bytes = fuzz::as_text(data, size);
  const Result<MedialFile> file = decode_ply(bytes, fuzz::kName);
  if (!file.ok()) {
    fuzz::require_clear(file.error(), ErrorCode::kInvalidMesh);
    return 0;
  }
  fuzz::require(file.value().spheres.size() <= bytes.size() / 26, "points take bytes");
  for (const MedialSphere& s : file.value().spheres) {
    for (const double x : {s.centre[0], s.centre[1], s.centre[2], s.radius}) {
      fuzz::require(std::isfinite(x), "balls are finite");
    }
  }
  for (const bool ascii : {false, true}) {
    const std::string written = encode_ply(file.value().header, file.value().spheres, ascii);
    const Result<MedialFile> again = decode_ply(written, fuzz::kName);
    fuzz::require(again.ok(), "a written file can be read");
    fuzz::require_same(file.value(), again.value());
  }
  return 0;
}
