#include "output/medial_formats/ball_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/tool_errors.h"
#include "output/atomic_files/little_endian.h"
#include "output/medial_formats/ball_colours.h"
#include "output/medial_formats/icosphere.h"

namespace medial_vk {
namespace {

constexpr double kRounding = 0x1p-50;

/// The size in the binary format.
std::uint64_t bytes_per_ball(std::uint32_t detail) {
  constexpr std::uint64_t kVertex = 3 * sizeof(double) + 2 * sizeof(float) + sizeof(std::int32_t) + 3;
  constexpr std::uint64_t kTriangle = 1 + 3 * sizeof(std::uint32_t);
  return kVertex * icosphere_vertices(detail) + kTriangle * icosphere_triangles(detail);
}

std::string ply_header(const MedialHeader& header, std::uint64_t balls, std::uint32_t detail, bool ascii) {
  return fmt::format(
      "ply\nformat {} 1.0\n{}comment sphere_detail {}\n"
      "element vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property float radius\nproperty float object_angle\nproperty int sheet\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      ascii ? "ascii" : "binary_little_endian", ply_comments(header), detail, balls * icosphere_vertices(detail),
      balls * icosphere_triangles(detail));
}

/// The values that all vertices of a ball share.
struct Look {
  float radius = 0;
  float object_angle = 0;
  std::int32_t sheet = 0;
  std::array<std::uint8_t, 3> colour;
};

Look look_of(const MedialSphere& sphere, double least_angle) {
  Look look = {static_cast<float>(sphere.radius), sphere.object_angle, sphere.sheet, {}};
  const std::array<float, 3> colour = colour_of(colour_share(sphere.object_angle, least_angle));
  std::transform(colour.begin(), colour.end(), look.colour.begin(),
                 [](float part) { return static_cast<std::uint8_t>(std::lround(255 * part)); });
  return look;
}

void append_vertex(std::string& out, const Point& p, const Look& look, bool ascii) {
  if (ascii) {
    out += fmt::format("{:.17g} {:.17g} {:.17g} {:.9g} {:.9g} {} {} {} {}\n", p[0], p[1], p[2], look.radius,
                       look.object_angle, look.sheet, look.colour[0], look.colour[1], look.colour[2]);
    return;
  }
  for (const double x : p) append_little_endian(out, x);
  append_little_endian(out, look.radius);
  append_little_endian(out, look.object_angle);
  append_little_endian(out, look.sheet);
  for (const std::uint8_t part : look.colour) append_little_endian(out, part);
}

void append_triangle(std::string& out, const std::array<std::uint32_t, 3>& t, std::uint32_t first, bool ascii) {
  if (ascii) {
    out += fmt::format("3 {} {} {}\n", first + t[0], first + t[1], first + t[2]);
    return;
  }
  append_little_endian(out, std::uint8_t{3});
  for (const std::uint32_t corner : t) append_little_endian(out, first + corner);
}

void append_ball(std::string& out, const Icosphere& unit, const MedialSphere& sphere, const Look& look, bool ascii) {
  const double radius = inscribed_radius(sphere.centre, sphere.radius, kRounding);
  for (const Point& v : unit.vertices) {
    const Point p = {sphere.centre[0] + radius * v[0], sphere.centre[1] + radius * v[1],
                     sphere.centre[2] + radius * v[2]};
    append_vertex(out, p, look, ascii);
  }
}

}  // namespace

Result<std::uint32_t> choose_sphere_detail(std::optional<std::uint32_t> requested, std::uint64_t balls,
                                           std::uint64_t (*bytes)(std::uint32_t detail)) {
  const auto fits = [&](std::uint32_t detail) { return balls <= kLargestBallFile / bytes(detail); };
  std::uint32_t detail = requested.value_or(kUsualSphereDetail);
  while (!requested && detail > 0 && !fits(detail)) --detail;
  if (fits(detail)) return detail;
  return Error{kCannotWrite,
               fmt::format("{} balls as a mesh of sphere detail {} take {} MiB, more than {}; use {}, or write them as "
                           ".glb, .npz or .ply without --mesh-spheres",
                           balls, detail, balls * bytes(detail) >> 20, kLargestBallFile >> 20,
                           detail > 0 ? "a lower --sphere-detail or --resolution" : "a lower --resolution")};
}

// A coordinate is c + r v with |v| <= 1 + 3u in length, u the unit of rounding. In each coordinate the product is wrong
// by at most u r and the sum by at most u (m + r), m the largest |c|; in length that is sqrt(3) u (m + 2 r), and 3 u r
// for |v|: less than 8 u (m + r). Doubles: u = 2^-53, so 2^-50 (m + r). Floats, rounded once from doubles: only the
// last rounding counts, sqrt(3) u (m + r) with u = 2^-24, less than 2^-23 (m + r) by more than all errors of the
// doubles.
double inscribed_radius(const Point& centre, double radius, double rounding) {
  const double largest = std::max({std::abs(centre[0]), std::abs(centre[1]), std::abs(centre[2])});
  return std::max(0.0, radius - rounding * (largest + radius));
}

Result<std::string> encode_ball_mesh_ply(const MedialHeader& header, std::span<const MedialSphere> spheres, bool ascii,
                                         std::optional<std::uint32_t> wanted_detail) {
  const Result<std::uint32_t> detail = choose_sphere_detail(wanted_detail, spheres.size(), bytes_per_ball);
  if (!detail) return detail.error();
  const Icosphere unit = make_icosphere(detail.value());
  std::string out = ply_header(header, spheres.size(), detail.value(), ascii);
  if (!ascii) out.reserve(out.size() + spheres.size() * bytes_per_ball(detail.value()));
  for (const MedialSphere& sphere : spheres)
    append_ball(out, unit, sphere, look_of(sphere, header.object_angle), ascii);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(i * unit.vertices.size());
    for (const auto& triangle : unit.triangles) append_triangle(out, triangle, first, ascii);
  }
  return out;
}

}  // namespace medial_vk
