// The reader of body files, on any bytes: numbers in range and indices of vertices, or a clear message. Input that is
// no zip becomes the array `vertices` of one, so that what is behind the CRC-32 of a zip is reached, too.
#include <cmath>

#include "body_files/body_file.h"
#include "fuzz/require.h"
#include "output/numpy_files/npz_reader.h"
#include "output/numpy_files/zip_archive.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  std::string bytes(fuzz::as_text(data, size));
  if (!bytes.starts_with("PK")) {
    const ZipMember member = {"vertices.npy", bytes};
    const Result<std::string> zip = make_zip({&member, 1});
    fuzz::require(zip.ok(), "a zip is made");
    bytes = zip.value();
    const auto arrays = read_npz(bytes, fuzz::kName);
    if (!arrays.ok()) fuzz::require_clear(arrays.error(), ErrorCode::kInvalidMesh);
  }
  const Result<BodyFile> file = decode_body_file(bytes, fuzz::kName);
  if (!file.ok()) {
    fuzz::require_clear(file.error(), ErrorCode::kInvalidMesh);
    return 0;
  }
  for (const Triangle& triangle : file.value().mesh.triangles) {
    for (const std::uint32_t v : triangle) fuzz::require(v < file.value().mesh.vertices.size(), "corners exist");
  }
  for (const auto* balls : {&file.value().inside, &file.value().cover}) {
    for (const Ball& ball : *balls) fuzz::require(ball.radius >= 0 && ball.radius <= 1e18, "radii are in range");
  }
  return 0;
}
