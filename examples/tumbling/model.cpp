#include "model.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

namespace tumbling {

using medial_vk::Error;
using medial_vk::ErrorCode;
using medial_vk::Mesh;
using medial_vk::Result;

Result<Mesh> read_obj(const std::string& file) {
  Mesh mesh;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      auto& p = mesh.vertices.emplace_back();
      words >> p[0] >> p[1] >> p[2];
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      while (words >> word) corners.push_back(static_cast<std::uint32_t>(std::atoi(word.c_str()) - 1));
      for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  if (mesh.triangles.empty()) return Error{ErrorCode::kInvalidMesh, file + " is no OBJ with faces"};
  return mesh;
}

Result<medial_vk::Body> body_of(const Mesh& mesh, std::size_t count) {
  auto prepared = medial_vk::prepare_mesh(mesh);
  if (!prepared) return prepared.error();
  const auto indexed = medial_vk::IndexedMesh::build(std::move(prepared).value());
  if (!indexed) return indexed.error();
  auto context = medial_vk::Context::create();
  if (!context) return context.error();
  medial_vk::SphereFitOptions options;
  options.count = count;
  const auto inside = medial_vk::fit_spheres(indexed.value(), options, context.value());
  if (!inside) return inside.error();
  options.contract = medial_vk::SphereContract::kCover;
  const auto cover = medial_vk::fit_spheres(indexed.value(), options, context.value());
  if (!cover) return cover.error();
  return medial_vk::Body::create(indexed.value(), inside.value().levels.back(), cover.value().levels.back());
}

double longest_side(const Mesh& mesh) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                                 [&](const auto& p, const auto& q) { return p[k] < q[k]; });
    longest = std::max(longest, (*high)[k] - (*low)[k]);
  }
  return longest;
}

}  // namespace tumbling
