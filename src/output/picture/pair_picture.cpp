#include "output/picture/pair_picture.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "medial_vk/medial_spheres.h"
#include "output/colours/colour_map.h"
#include "output/picture/panels/panel.h"
#include "output/picture/panels/scene.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;

// Colours of sheets, by number.
constexpr int kOfA = 0, kOfB = 1, kLine = 4;
// Radii of points and lines, as shares of the diagonal of everything: by themselves, and at least, beside small balls.
constexpr double kPoint = 0.012, kThin = 0.004, kFinest = 0.0015;

Vector3d vector(const Point& p) { return Vector3d(p.data()); }

/// Balls of the picture in the form in which scenes take them.
class Marks {
 public:
  /// `size` is the diagonal of everything: marks are thick in proportion.
  Marks(double size, const Vector3d& towards) : size_(size), across_(towards.unitOrthogonal()) {
    along_ = towards.normalized().cross(across_);
  }

  void ball(const Vector3d& centre, double radius, int colour) {
    MedialSphere mark{};
    for (Eigen::Index k = 0; k < 3; ++k) mark.centre[static_cast<std::size_t>(k)] = centre[k];
    mark.radius = radius;
    mark.sheet = colour;
    marks_.push_back(mark);
  }

  void point(const Point& p, double radius, int colour) { ball(vector(p), radius, colour); }

  /// A tube of balls that overlap.
  void line(const Point& from, const Point& to, double radius) {
    const Vector3d a = vector(from), b = vector(to);
    const int count = count_along((b - a).norm(), radius);
    for (int i = 0; i <= count; ++i) ball(a + (b - a) * i / count, radius, kLine);
  }

  /// The circle in which a ball is seen, nearly.
  void circle(const Ball& of, int colour) { circle(of, across_, along_, colour); }

  /// That circle, and two others whose planes are perpendicular to one another and oblique to the view.
  void globe(const Ball& of, int colour) {
    const Vector3d pole = (along_ + 0.5 * across_.cross(along_)).normalized(), side = across_.cross(pole);
    circle(of, colour);
    circle(of, across_, side, colour);
    circle(of, (across_ + side).normalized(), pole, colour);
  }

  const std::vector<MedialSphere>& marks() const { return marks_; }

 private:
  /// In the plane of two perpendicular unit vectors.
  void circle(const Ball& of, const Vector3d& first, const Vector3d& second, int colour) {
    const int count = count_along(2 * std::numbers::pi * of.radius, kThin * size_);
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      const Vector3d at = std::cos(angle) * first + std::sin(angle) * second;
      ball(vector(of.centre) + of.radius * at, 0.5 * kThin * size_, colour);
    }
  }

  static int count_along(double length, double radius) {
    constexpr double kMost = 4000;
    return static_cast<int>(std::clamp(std::ceil(length / (0.4 * radius)), 1.0, kMost));
  }

  double size_;
  Vector3d across_, along_;
  std::vector<MedialSphere> marks_;
};

double diagonal_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Point& p : mesh.vertices) box.extend(vector(p));
  return box.isEmpty() ? 0 : box.diagonal().stableNorm();
}

/// The colours of the glass are those of the marks.
std::vector<picture::Tint> tints_of(const PairPicture& pair) {
  std::vector<picture::Tint> tints(pair.mesh.triangles.size(), picture::Tint::kNone);
  const auto end_of_a = std::ranges::next(tints.begin(), static_cast<std::ptrdiff_t>(pair.triangles_of_a), tints.end());
  const auto end_of_b = std::ranges::next(end_of_a, static_cast<std::ptrdiff_t>(pair.triangles_of_b), tints.end());
  std::fill(tints.begin(), end_of_a, picture::Tint::kWarm);
  std::fill(end_of_a, end_of_b, picture::Tint::kCold);
  return tints;
}

/// Without the middle of a long name, so that both fit the picture.
std::string shortened(const std::string& name) {
  constexpr std::size_t kMost = 30, kEnd = 13;
  if (name.size() <= kMost) return name;
  const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(name[i]) & 0xc0u) == 0x80u; };
  std::size_t cut = kMost - kEnd - 2, rest = name.size() - kEnd;
  while (cut > 0 && continues(cut)) --cut;
  while (rest < name.size() && continues(rest)) ++rest;
  return name.substr(0, cut) + ".." + name.substr(rest);
}

bool has_common_point(const PairPicture& pair) { return pair.has_points && pair.on_a == pair.on_b; }

bool holds(const Ball& ball, std::span<const Ball> others) {
  return std::ranges::any_of(others, [&](const Ball& other) {
    return (vector(other.centre) - vector(ball.centre)).norm() + other.radius < ball.radius;
  });
}

/// That of a mark beside balls inside, which it must not hide: no more than a share of the smallest one.
double mark_radius(double size, double usual, double share, std::span<const Ball> balls) {
  double radius = usual * size;
  for (const Ball& ball : balls) radius = std::min(radius, share * ball.radius);
  return std::max(radius, kFinest * size);
}

double point_radius(double size, std::span<const Ball> balls) { return mark_radius(size, kPoint, 0.5, balls); }
double common_radius(double size, std::span<const Ball> balls) { return mark_radius(size, kPoint, 0.3, balls); }

std::vector<MedialSphere> marks_of(const PairPicture& pair, const PictureView& view) {
  Marks marks(diagonal_of(pair.mesh), Vector3d(view.towards.data()));
  const auto draw_inside = [&](const std::vector<Ball>& balls, const std::vector<Ball>& others, int colour) {
    for (const Ball& ball : balls) {
      if (holds(ball, others)) {
        marks.globe(ball, colour);
      } else {
        marks.ball(vector(ball.centre), ball.radius, colour);
      }
    }
  };
  draw_inside(pair.inside_a, pair.inside_b, kOfA);
  draw_inside(pair.inside_b, pair.inside_a, kOfB);
  for (const Ball& ball : pair.cover_a) marks.circle(ball, kOfA);
  for (const Ball& ball : pair.cover_b) marks.circle(ball, kOfB);
  if (!pair.has_points || has_common_point(pair)) return marks.marks();
  const double size = diagonal_of(pair.mesh);
  const double of_a = mark_radius(size, kThin, 0.35, pair.inside_a);
  marks.line(pair.on_a, pair.on_b, std::min(of_a, mark_radius(size, kThin, 0.35, pair.inside_b)));
  marks.point(pair.on_a, point_radius(size, pair.inside_a), kOfA);
  marks.point(pair.on_b, point_radius(size, pair.inside_b), kOfB);
  return marks.marks();
}

/// Which balls are which.
std::string note_of(const PairPicture& pair) {
  const bool has_inside = !pair.inside_a.empty() || !pair.inside_b.empty();
  const bool has_cover = !pair.cover_a.empty() || !pair.cover_b.empty();
  if (!has_inside && !has_cover) return {};
  std::string note = pair.balls_decide ? "balls " : "balls that bound the distance, ";
  if (has_inside) {
    const bool is_nested = std::ranges::any_of(pair.inside_a, [&](const Ball& b) { return holds(b, pair.inside_b); }) ||
                           std::ranges::any_of(pair.inside_b, [&](const Ball& b) { return holds(b, pair.inside_a); });
    note += is_nested ? "inside: solid or wires around it" : "inside: solid";
  }
  if (has_inside && has_cover) note += ", ";
  return has_cover ? note + "of covers: rings" : note;
}

}  // namespace

Picture draw_pair(const PairPicture& pair, const PictureView& view) {
  PictureOptions options;
  options.view = view;
  options.show = PictureShow::kBalls;
  options.colour = PictureColour::kSheet;
  picture::Scene scene = picture::make_scene(pair.mesh, marks_of(pair, view), 0, options);
  const auto colour = [](int sheet) { return picture::sheet_colour_index(sheet); };
  scene.mesh.tints = tints_of(pair);
  scene.legend.title = pair.title;
  auto& swatches = scene.legend.swatches;
  swatches.clear();
  for (const auto& [name, number] : {std::pair(&pair.name_a, kOfA), {&pair.name_b, kOfB}}) {
    if (!name->empty()) swatches.emplace_back(colour(number), shortened(*name));
  }
  if (swatches.empty()) swatches.emplace_back(scene.palette.size(), "");  // no colour, and no bar of all of them
  if (pair.has_points) swatches.emplace_back(colour(kLine), pair.is_hit ? "common point" : "nearest points");
  scene.legend.note = note_of(pair);
  // In both solids, it would be hidden behind them and by the balls. With its rims it is twice as large.
  if (has_common_point(pair)) {
    const double size = diagonal_of(pair.mesh);
    const double radius = std::min(common_radius(size, pair.inside_a), common_radius(size, pair.inside_b));
    scene.on_top = {picture::make_mark(pair.mesh, pair.on_a, radius, colour(kLine))};
  }
  Picture out;
  out.width = 1200;
  out.height = 900;
  out.rgb.assign(std::size_t{out.width} * out.height * 3, 255);
  picture::draw_panel(scene, {0, out.width, false, true}, view, out);
  picture::draw_legend(scene, out);
  return out;
}

}  // namespace medial_vk
