#include "output/curvature_files/curvature_files.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/point_ops.h"
#include "boundary_fields/boundary_fields.h"
#include "medial_vk/version.h"
#include "output/atomic_files/little_endian.h"
#include "output/numpy_files/npz_writer.h"

namespace medial_vk {
namespace {

std::string json_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

std::string json_point(const Point& p) {
  if (std::isnan(p[0])) return "null";
  return fmt::format("[{},{},{}]", p[0], p[1], p[2]);
}

std::string json_tip(const TipCurvature& tip) {
  return fmt::format(
      R"({{"state":"{}","spoke":{},"kappa":[{},{}],"directions":[{},{}],"error":{},"spread":{},"window":{}}})",
      state_name(tip.state), json_point(tip.normal), json_number(tip.kappa[0]), json_number(tip.kappa[1]),
      json_point(tip.directions[0]), json_point(tip.directions[1]), json_number(tip.error), json_number(tip.spread),
      json_number(tip.window));
}

void append_floats(std::string& out, const Point& p) {
  for (const double x : p) append_little_endian(out, static_cast<float>(x));
}

/// The numbers of all tips, one after the other.
template <class T>
class TipArray {
 public:
  explicit TipArray(std::size_t balls, std::size_t numbers) { values_.reserve(2 * balls * numbers); }
  void add(T value) { values_.push_back(value); }
  void add_point(const Point& p) { values_.insert(values_.end(), p.begin(), p.end()); }
  std::span<const T> values() const { return values_; }

 private:
  std::vector<T> values_;
};

}  // namespace

const char* name_of(CurvatureMethod method) { return method == CurvatureMethod::kFits ? "fits" : "source"; }

Point tip_position(const Ball& ball, const TipCurvature& tip) {
  return std::isnan(tip.normal[0]) ? ball.centre : ball.centre + ball.radius * tip.normal;
}

std::string encode_curvature_csv(const CurvatureTable& table) {
  std::string out =
      "ball,tip,state,x,y,z,radius,spoke_x,spoke_y,spoke_z,kappa_1,kappa_2,direction_1_x,direction_1_y,direction_1_z,"
      "direction_2_x,direction_2_y,direction_2_z,error,spread,object_angle\n";
  for (std::size_t i = 0; i < table.balls.size(); ++i) {
    const Ball& ball = table.balls[i];
    const BallCurvature& known = table.curvature.balls[i];
    for (std::size_t side = 0; side < 2; ++side) {
      const TipCurvature& tip = known.tips[side];
      out += fmt::format("{},{},{},{},{},{},{}", i, side, state_name(tip.state), ball.centre[0], ball.centre[1],
                         ball.centre[2], ball.radius);
      for (const double x : tip.normal) out += fmt::format(",{}", x);
      for (const double x : tip.kappa) out += fmt::format(",{}", x);
      for (const Point& direction : tip.directions) {
        for (const double x : direction) out += fmt::format(",{}", x);
      }
      out += fmt::format(",{},{},{}\n", tip.error, tip.spread, known.object_angle);
    }
  }
  return out;
}

std::string encode_curvature_ply(const CurvatureTable& table) {
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment medial-vk {}\ncomment curvature {}\ncomment spacing {}\n"
      "element vertex {}\n",
      version(), name_of(table.method), table.curvature.spacing, 2 * table.balls.size());
  for (const char* name : {"x", "y", "z"}) out += fmt::format("property double {}\n", name);
  for (const char* name : {"nx", "ny", "nz"}) out += fmt::format("property float {}\n", name);
  out += "property uint ball\nproperty uchar tip\nproperty uchar state\n";
  for (const char* name : {"radius", "kappa_1", "kappa_2", "error", "spread"}) {
    out += fmt::format("property double {}\n", name);
  }
  for (const char* name : {"direction_1_x", "direction_1_y", "direction_1_z", "direction_2_x", "direction_2_y",
                           "direction_2_z", "object_angle"}) {
    out += fmt::format("property float {}\n", name);
  }
  out += "end_header\n";
  for (std::size_t i = 0; i < table.balls.size(); ++i) {
    const BallCurvature& known = table.curvature.balls[i];
    for (std::size_t side = 0; side < 2; ++side) {
      const TipCurvature& tip = known.tips[side];
      for (const double x : tip_position(table.balls[i], tip)) append_little_endian(out, x);
      // Viewers have no use for a normal that is no number.
      append_floats(out, std::isnan(tip.normal[0]) ? Point{0, 0, 0} : tip.normal);
      append_little_endian(out, static_cast<std::uint32_t>(i));
      out += static_cast<char>(side);
      out += static_cast<char>(tip.state);
      for (const double x : {table.balls[i].radius, tip.kappa[0], tip.kappa[1], tip.error, tip.spread}) {
        append_little_endian(out, x);
      }
      for (const Point& direction : tip.directions) append_floats(out, direction);
      append_little_endian(out, static_cast<float>(known.object_angle));
    }
  }
  return out;
}

Result<std::string> encode_curvature_npz(const CurvatureTable& table) {
  const std::size_t n = table.balls.size();
  std::vector<double> radii, angles;
  std::vector<double> centres;
  radii.reserve(n);
  angles.reserve(n);
  centres.reserve(3 * n);
  TipArray<double> tips(n, 3), spokes(n, 3), kappas(n, 2), directions(n, 6), errors(n, 1), spreads(n, 1), windows(n, 1),
      spoke_errors(n, 1);
  TipArray<std::uint32_t> states(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const Ball& ball = table.balls[i];
    centres.insert(centres.end(), ball.centre.begin(), ball.centre.end());
    radii.push_back(ball.radius);
    angles.push_back(table.curvature.balls[i].object_angle);
    for (const TipCurvature& tip : table.curvature.balls[i].tips) {
      tips.add_point(tip_position(ball, tip));
      spokes.add_point(tip.normal);
      for (const double x : tip.kappa) kappas.add(x);
      for (const Point& direction : tip.directions) directions.add_point(direction);
      errors.add(tip.error);
      spreads.add(tip.spread);
      windows.add(tip.window);
      spoke_errors.add(tip.normal_error);
      states.add(static_cast<std::uint32_t>(tip.state));
    }
  }
  NpzWriter out;
  out.text("version", version());
  out.text("method", name_of(table.method));
  out.number("spacing", table.curvature.spacing);
  out.numbers<double>("centre", {n, 3}, centres);
  out.numbers<double>("radius", {n}, radii);
  out.numbers<double>("object_angle", {n}, angles);
  out.numbers<std::uint32_t>("state", {n, 2}, states.values());
  out.numbers("tip", {n, 2, 3}, tips.values());
  out.numbers("spoke", {n, 2, 3}, spokes.values());
  out.numbers("spoke_error", {n, 2}, spoke_errors.values());
  out.numbers("kappa", {n, 2, 2}, kappas.values());
  out.numbers("directions", {n, 2, 2, 3}, directions.values());
  out.numbers("error", {n, 2}, errors.values());
  out.numbers("spread", {n, 2}, spreads.values());
  out.numbers("window", {n, 2}, windows.values());
  return out.finish();
}

std::string encode_curvature_json(const CurvatureTable& table) {
  std::string out = fmt::format("{{\"version\":\"{}\",\"method\":\"{}\",\"spacing\":{},\"balls\":[", version(),
                                name_of(table.method), table.curvature.spacing);
  for (std::size_t i = 0; i < table.balls.size(); ++i) {
    const Ball& ball = table.balls[i];
    const BallCurvature& known = table.curvature.balls[i];
    out += fmt::format("{}\n{{\"centre\":{},\"radius\":{},\"object_angle\":{},\"tips\":[{},{}]}}", i > 0 ? "," : "",
                       json_point(ball.centre), ball.radius, json_number(known.object_angle), json_tip(known.tips[0]),
                       json_tip(known.tips[1]));
  }
  return out + "]}\n";
}

}  // namespace medial_vk
