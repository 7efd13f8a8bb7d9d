#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "medial_vk/version.h"
#include "output/curvature_files/curvature_files.h"
#include "output/medial_formats/glb_balls.h"
#include "output/medial_formats/glb_container.h"

namespace medial_vk {
namespace {

using FloatVector = std::array<float, 3>;

/// 0 if it is not known, as glTF has no NaN.
float float_or_zero(double value) {
  if (std::isnan(value)) return 0;
  constexpr double kGreatest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kGreatest, kGreatest));
}

FloatVector vector_or_zero(const Point& p) { return {float_or_zero(p[0]), float_or_zero(p[1]), float_or_zero(p[2])}; }

/// Attributes of the points of a mesh, one for each tip.
class TipAttributes {
 public:
  TipAttributes(GlbContainer& glb, const CurvatureTable& table) : glb_(glb), table_(table) {}

  /// `value`: of the number of a ball and that of a tip.
  template <class Value>
  void add_numbers(const char* name, const Value& value) {
    std::vector<float> numbers;
    numbers.reserve(2 * table_.balls.size());
    visit([&](std::size_t ball, std::size_t side) { numbers.push_back(float_or_zero(value(ball, side))); });
    attributes[name] = glb_.add_numbers(numbers);
  }
  template <class Value>
  void add_vectors(const char* name, bool is_position, const Value& value) {
    std::vector<FloatVector> vectors;
    vectors.reserve(2 * table_.balls.size());
    visit([&](std::size_t ball, std::size_t side) { vectors.push_back(vector_or_zero(value(ball, side))); });
    attributes[name] = glb_.add_vectors(vectors, GltfTarget::kVertices, is_position);
  }

  GltfJson attributes = GltfJson::object();

 private:
  template <class Visit>
  void visit(const Visit& one) const {
    for (std::size_t ball = 0; ball < table_.balls.size(); ++ball) {
      for (const std::size_t side : {0, 1}) one(ball, side);
    }
  }

  GlbContainer& glb_;
  const CurvatureTable& table_;
};

GltfJson add_tips(GlbContainer& glb, const CurvatureTable& table, const Point& middle) {
  TipAttributes tips(glb, table);
  const auto tip_of = [&](std::size_t ball, std::size_t side) -> const TipCurvature& {
    return table.curvature.balls[ball].tips[side];
  };
  tips.add_vectors("POSITION", true, [&](std::size_t ball, std::size_t side) {
    const Point at = tip_position(table.balls[ball], tip_of(ball, side));
    return Point{at[0] - middle[0], at[1] - middle[1], at[2] - middle[2]};
  });
  tips.add_vectors("_SPOKE", false, [&](std::size_t ball, std::size_t side) { return tip_of(ball, side).normal; });
  tips.add_numbers("_BALL", [](std::size_t ball, std::size_t) { return static_cast<double>(ball); });
  tips.add_numbers("_TIP", [](std::size_t, std::size_t side) { return static_cast<double>(side); });
  tips.add_numbers("_STATE", [&](std::size_t b, std::size_t s) { return static_cast<double>(tip_of(b, s).state); });
  tips.add_numbers("_RADIUS", [&](std::size_t ball, std::size_t) { return table.balls[ball].radius; });
  for (const std::size_t k : {0, 1}) {
    const std::array<const char*, 2> kappas = {"_KAPPA_1", "_KAPPA_2"}, along = {"_DIRECTION_1", "_DIRECTION_2"};
    tips.add_numbers(kappas[k], [&](std::size_t ball, std::size_t side) { return tip_of(ball, side).kappa[k]; });
    tips.add_vectors(along[k], false,
                     [&](std::size_t ball, std::size_t side) { return tip_of(ball, side).directions[k]; });
  }
  tips.add_numbers("_ERROR", [&](std::size_t ball, std::size_t side) { return tip_of(ball, side).error; });
  tips.add_numbers("_SPREAD", [&](std::size_t ball, std::size_t side) { return tip_of(ball, side).spread; });
  tips.add_numbers("_OBJECT_ANGLE",
                   [&](std::size_t ball, std::size_t) { return table.curvature.balls[ball].object_angle; });
  return tips.attributes;
}

}  // namespace

Result<std::string> encode_curvature_glb(const CurvatureTable& table) {
  constexpr int kPoints = 0;  // a mode of primitives
  CentreBox box;
  for (std::size_t ball = 0; ball < table.balls.size(); ++ball) {
    for (const TipCurvature& tip : table.curvature.balls[ball].tips) box.add(tip_position(table.balls[ball], tip));
  }
  const Point middle = box.middle();
  GlbContainer glb;
  glb.document = {{"asset",
                   {{"version", "2.0"},
                    {"generator", std::string("medial-vk ") + version()},
                    {"extras", {{"curvature", name_of(table.method)}, {"spacing", table.curvature.spacing}}}}},
                  {"scene", 0},
                  {"scenes", {{{"nodes", {0}}}}}};
  std::string node = R"([{"name":"tips")";
  if (!table.balls.empty()) {
    const GltfJson primitive = {{"attributes", add_tips(glb, table, middle)}, {"mode", kPoints}};
    glb.document["meshes"] = {{{"name", "tips"}, {"primitives", {primitive}}}};
    node += R"(,"mesh":0)";
  }
  return glb.finish(node + fmt::format(R"(,"translation":[{},{},{}]}}])", middle[0], middle[1], middle[2]));
}

}  // namespace medial_vk
