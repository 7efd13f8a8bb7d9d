// The reader of GeoJSON, on any bytes: rings, or a clear message.
#include "fuzz/shapes.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  fuzz::require_shape(fuzz::as_text(data, size), fuzz::kName + ".geojson");
  return 0;
}
