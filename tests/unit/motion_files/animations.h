// Animated glTF files whose frames are known.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "support/scenes/gltf_writer.h"
#include "support/solids/mesh_files.h"

namespace medial_vk::test {

/// A tetrahedron with its corners on the axes.
inline Mesh animated_tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

struct AnimationWriter : GltfWriter {
  /// A scene of the nodes, of which the roots are given.
  explicit AnimationWriter(const nlohmann::json& nodes, const std::vector<int>& roots = {0}) {
    document["nodes"] = nodes;
    document["scenes"] = nlohmann::json::array({{{"nodes", roots}}});
  }

  int add_mesh(const Mesh& mesh) {
    document["meshes"].push_back({{"primitives", nlohmann::json::array({primitive_of(mesh, 4, false)})}});
    return static_cast<int>(document["meshes"].size()) - 1;
  }

  nlohmann::json& primitive(std::size_t mesh = 0) { return document["meshes"][mesh]["primitives"][0]; }

  void add_shape(const std::vector<double>& displacements) {
    primitive()["targets"].push_back({{"POSITION", add_floats(displacements, "VEC3", 3)}});
  }

  /// Four joints of each vertex as bytes, and their weights.
  void add_influences(int set, const std::vector<std::array<int, 4>>& joints, const std::vector<double>& weights) {
    std::string bytes;
    for (const std::array<int, 4>& four : joints) {
      for (const int joint : four) bytes += static_cast<char>(joint);
    }
    nlohmann::json& attributes = primitive()["attributes"];
    const std::string number = std::to_string(set);
    const int at = add_accessor(bytes, kByte, "VEC4", joints.size());
    attributes["JOINTS_" + number] = at;
    attributes["WEIGHTS_" + number] = add_floats(weights, "VEC4", 4);
  }

  /// `type`: of the values, VEC3, VEC4 or SCALAR.
  void add_channel(int node, const std::string& path, const std::vector<double>& times,
                   const std::vector<double>& values, const std::string& interpolation = "LINEAR",
                   std::size_t animation = 0) {
    const std::size_t width = path == "weights" ? 1 : path == "rotation" ? 4 : 3;
    const char* const type = width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4";
    const int input = add_floats(times, "SCALAR", 1), output = add_floats(values, type, width);
    nlohmann::json& to = document["animations"][animation];
    to["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    to["channels"].push_back({{"sampler", to["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }
};

/// A tetrahedron whose tip, the last corner, has a joint of its own above the base, which turns about x in the first
/// second, by a quarter if nothing else is said. The second corner follows both joints, in the parts 3/4 and 1/4.
inline AnimationWriter skinned_animation(double turn = std::acos(0)) {
  AnimationWriter writer(
      nlohmann::json::array({{{"name", "base"}, {"children", {1}}, {"translation", {5, 0, 0}}},
                             {{"name", "tip"}, {"translation", {0, 0, 1}}},
                             {{"name", "body"}, {"mesh", 0}, {"skin", 0}, {"translation", {100, 100, 100}}}}),
      {0, 2});
  writer.add_mesh(animated_tetrahedron());
  writer.add_influences(0, {{0, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}},
                        {1, 0, 0, 0, .75, .25, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  // The joints at rest are at (5, 0, 0) and (5, 0, 1), and the mesh was bound to them at the origin and (0, 0, 1).
  const std::vector<double> matrices = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0,  1,
                                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1};
  writer.document["skins"] = {{{"joints", {0, 1}}, {"inverseBindMatrices", writer.add_floats(matrices, "MAT4", 16)}}};
  writer.add_channel(1, "rotation", {0, 1}, {0, 0, 0, 1, std::sin(turn / 2), 0, 0, std::cos(turn / 2)});
  writer.document["animations"][0]["name"] = "bow";
  return writer;
}

/// Its positions at the time t, from 0 to 1.
inline std::vector<Point> skinned_frame(double t) {
  const double angle = t * std::acos(0), c = std::cos(angle), s = std::sin(angle);
  // The tip turns about the line through (5, 0, 1) along x.
  const auto turned = [&](const Point& p) {
    return Point{p[0] + 5, c * p[1] - s * (p[2] - 1), 1 + s * p[1] + c * (p[2] - 1)};
  };
  const Point second = turned({1, 0, 0});
  return {{5, 0, 0}, {6, .75 * 0 + .25 * second[1], .25 * second[2]}, {5, 2, 0}, turned({0, 0, 3})};
}

/// The tetrahedron with two shapes: one lifts the tip by 4, the other moves the second corner along y by 2.
inline AnimationWriter morphing_animation(const std::string& interpolation, const std::vector<double>& times,
                                          const std::vector<double>& weights) {
  AnimationWriter writer(nlohmann::json::array({{{"name", "face"}, {"mesh", 0}}}));
  writer.add_mesh(animated_tetrahedron());
  writer.add_shape({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4});
  writer.add_shape({0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0});
  writer.add_channel(0, "weights", times, weights, interpolation);
  return writer;
}

inline std::vector<Point> morphed(double first, double second) {
  std::vector<Point> vertices = animated_tetrahedron().vertices;
  vertices[3][2] += 4 * first;
  vertices[1][1] += 2 * second;
  return vertices;
}

}  // namespace medial_vk::test
