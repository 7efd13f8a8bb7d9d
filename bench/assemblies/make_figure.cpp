// Writes a figure of overlapping, open and double parts, as artists make them (tests/support/solids/assembly.h):
//   bench_make_figure FILE.obj TRIANGLES [sheets]
// With `sheets` it also has a cape and hair of one sheet, with thousands of open edges.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "support/solids/assembly.h"
#include "support/solids/mesh_files.h"

int main(int argc, char** argv) {
  using namespace medial_vk;
  const long triangles = argc > 2 ? std::atol(argv[2]) : 0;
  const bool has_sheets = argc > 3 && argv[3] == std::string_view("sheets");
  if (argc < 3 || argc > (has_sheets ? 4 : 3) || triangles < 10'000 || triangles > 5'000'000) {
    std::fprintf(stderr, "usage: bench_make_figure FILE.obj TRIANGLES [sheets]   (TRIANGLES 10000 to 5000000)\n");
    return 2;
  }
  constexpr double kTriangles = 170'000;  // at fineness 1, about
  const Mesh mesh = test::make_assembly(
      {.fineness = std::sqrt(static_cast<double>(triangles) / kTriangles), .has_sheets = has_sheets});
  std::ofstream out(argv[1]);
  if (!(out << test::to_obj(mesh)).flush()) {
    std::fprintf(stderr, "bench_make_figure: cannot write %s\n", argv[1]);
    return 1;
  }
  std::printf("%zu triangles\n", mesh.triangles.size());
  return 0;
}
