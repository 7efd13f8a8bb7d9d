// The reader of SVG, on any bytes: areas, or a clear message. Areas of few points are united, too; that of many takes
// as long as they have crossings.
#include "shape_files/svg/read_svg.h"

#include "fuzz/shapes.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string_view text = fuzz::as_text(data, size);
  const std::string name = fuzz::kName + ".svg";
  const Result<SvgAreas> read = read_svg(text, name, {}, kDefaultFlatness);
  if (!read.ok()) {
    fuzz::require_message(read.error(), name);
    return 0;
  }
  const SvgAreas& svg = read.value();
  std::uint64_t points = 0;
  for (const ShapeArea& area : svg.areas) points += fuzz::require_rings(area.rings);
  fuzz::require(!svg.areas.empty() && points <= kMostShapePoints, "there are areas, of a bounded number of points");
  fuzz::require_sentences(svg.assumptions);
  constexpr std::uint64_t kFewPoints = 200;
  if (points <= kFewPoints) fuzz::require_shape(text, name);
  return 0;
}
