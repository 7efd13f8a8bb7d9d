// Times of medial axes in the plane, beside Boost.Polygon's and CGAL's Voronoi diagrams of the same segments in the
// same run: a markdown table.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "medial_vk/plane_axis.h"
#include "plane_peers.h"

namespace medial_vk::bench {
namespace {

constexpr double kPi = std::numbers::pi;

PlanePoint on_circle(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

/// A square with turned squares cut out.
std::vector<PlaneRing> holes(int segments) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<> share(0, 1);
  const int side = std::max(1, static_cast<int>(std::sqrt(segments / 4.0)));
  std::vector<PlaneRing> rings = {{{0, 0}, {1.0 * side, 0}, {1.0 * side, 1.0 * side}, {0, 1.0 * side}}};
  for (int i = 0; i < side * side; ++i) {
    const double x = i % side + 0.45 + 0.1 * share(random), y = i / side + 0.45 + 0.1 * share(random);
    const double turn = 6 * share(random);
    PlaneRing ring;
    for (int k = 0; k < 4; ++k) {
      const PlanePoint p = on_circle(0.3, turn + k * kPi / 2);
      ring.push_back({x + p[0], y + p[1]});
    }
    rings.push_back(ring);
  }
  return rings;
}

std::vector<PlaneRing> comb(int segments) {
  const int teeth = segments / 4;
  PlaneRing ring;
  for (int i = 0; i < teeth; ++i) {
    const double x = static_cast<double>(i) / teeth, width = 0.5 / teeth;
    for (const PlanePoint& p : {PlanePoint{x, 0.8}, {x + width, 0.8}, {x + width, 0.1}, {x + 2 * width, 0.1}}) {
      ring.push_back(p);
    }
  }
  ring.push_back({1, 0});
  ring.push_back({0, 0});
  return {ring};
}

/// The same, turned, so that no segment is along an axis.
std::vector<PlaneRing> turned_comb(int segments) {
  std::vector<PlaneRing> rings = comb(segments);
  const double cosine = std::cos(0.6), sine = std::sin(0.6);
  for (PlanePoint& p : rings[0]) p = {cosine * p[0] - sine * p[1], sine * p[0] + cosine * p[1]};
  return rings;
}

std::vector<PlaneRing> regular_polygon(int segments) {
  PlaneRing ring;
  for (int i = 0; i < segments; ++i) ring.push_back(on_circle(0.4, 2 * kPi * i / segments));
  return {ring};
}

std::vector<PlaneRing> spiral(int segments) {
  const int half = segments / 2;
  const auto at = [&](int i, double width) {
    const double share = static_cast<double>(i) / half;
    return on_circle(0.02 + 0.4 * share + width, 24 * kPi * share);
  };
  PlaneRing ring;
  for (int i = 0; i < half; ++i) ring.push_back(at(i, 0));
  for (int i = half - 1; i >= 0; --i) ring.push_back(at(i, 0.012));
  return {ring};
}

/// A closed curve with lobes on lobes.
std::vector<PlaneRing> leaf(int segments) {
  PlaneRing ring;
  for (int i = 0; i < segments; ++i) {
    const double a = 2 * kPi * i / segments;
    ring.push_back(on_circle(0.3 + 0.1 * std::sin(9 * a) + 0.03 * std::sin(200 * a), a));
  }
  return {ring};
}

/// A circle with noise of half a per cent: a corner at every point.
std::vector<PlaneRing> noise(int segments) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<> share(0, 1);
  PlaneRing ring;
  for (int i = 0; i < segments; ++i) ring.push_back(on_circle(0.4 + 0.002 * share(random), 2 * kPi * i / segments));
  return {ring};
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Of the processors, on all threads of this program.
double processor_seconds_of(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

struct Settings {
  std::vector<int> sizes = {10000, 30000, 100000};
  int repeats = 3;
  unsigned threads = 0;
  double object_angle = 0.6;
};

/// Medians over rounds in which all take their turn.
bool print_row(const std::string& name, const std::vector<PlaneRing>& rings, const Settings& settings) {
  std::vector<double> prepare, find, find_processor, boost, cgal;
  std::size_t segments = 0, branches = 0;
  for (int i = 0; i < settings.repeats; ++i) {
    Result<PreparedShape> shape = Error{};
    prepare.push_back(seconds_of([&] { shape = prepare_shape(rings, FillRule::kEvenOdd, settings.threads); }));
    if (!shape) return fmt::print(stderr, "{}: {}\n", name, shape.error().message), false;
    PlaneAxisOptions options;
    options.object_angle = settings.object_angle;
    options.threads = settings.threads;
    Result<PlaneAxis> axis = Error{};
    find_processor.push_back(processor_seconds_of(
        [&] { find.push_back(seconds_of([&] { axis = find_plane_axis(shape.value(), options); })); }));
    if (!axis) return fmt::print(stderr, "{}: {}\n", name, axis.error().message), false;
    std::size_t found = 0;
    boost.push_back(seconds_of([&] { found = boost_voronoi(shape.value()); }));
    if (found == 0) boost.back() = 0;
    cgal.push_back(seconds_of([&] { found = cgal_delaunay_graph(shape.value()); }));
    if (found == 0) cgal.back() = 0;
    segments = shape.value().segments.size();
    branches = axis.value().branches.size();
  }
  const auto shown = [](double seconds) { return seconds == 0 ? std::string("–") : fmt::format("{:.2f}", seconds); };
  fmt::print("| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {} | {} |\n", name, segments, branches, median(prepare),
             median(find), median(find_processor), shown(median(boost)), shown(median(cgal)));
  std::fflush(stdout);
  return true;
}

int run(int count, char** arguments) {
  Settings settings;
  CLI::App app("Times of medial axes in the plane, beside Boost.Polygon and CGAL.");
  app.add_option("--sizes", settings.sizes, "segments of each shape")->delimiter(',');
  app.add_option("--repeats", settings.repeats, "of which the median is taken")->check(CLI::Range(1, 99));
  app.add_option("--threads", settings.threads, "of this library; the others have one");
  app.add_option("--object-angle", settings.object_angle, "radians");
  CLI11_PARSE(app, count, arguments);
  fmt::print(
      "| shape | segments | branches | prepare, s | axis, s | of the processors, s | Boost.Polygon, s | CGAL, s |\n"
      "|---|---|---|---|---|---|---|---|\n");
  const std::vector<std::pair<const char*, std::vector<PlaneRing> (*)(int)>> shapes = {
      {"square holes", holes}, {"comb", comb},   {"turned comb", turned_comb},        {"spiral", spiral},
      {"leaf", leaf},          {"noise", noise}, {"regular polygon", regular_polygon}};
  for (const auto& [name, make] : shapes) {
    for (const int size : settings.sizes) {
      if (!print_row(name, make(size), settings)) return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace medial_vk::bench

int main(int count, char** arguments) { return medial_vk::bench::run(count, arguments); }
