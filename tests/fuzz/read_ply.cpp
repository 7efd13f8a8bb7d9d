// The PLY reader, on any bytes.
#include "fuzz/require.h"
#include "input/readers.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string_view bytes = fuzz::as_text(data, size);
  fuzz::require_mesh_or_message(read_ply(bytes, fuzz::kName), bytes);
  return 0;
}
