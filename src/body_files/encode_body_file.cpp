#include "body_files/body_file.h"
#include "output/numpy_files/npz_writer.h"

namespace medial_vk {
namespace {

void add_balls(NpzWriter& out, const char* centres, const char* radii, const std::vector<Ball>& balls) {
  std::vector<double> centre, radius;
  for (const Ball& ball : balls) {
    centre.insert(centre.end(), ball.centre.begin(), ball.centre.end());
    radius.push_back(ball.radius);
  }
  out.numbers<double>(centres, {balls.size(), 3}, centre);
  out.numbers<double>(radii, {balls.size()}, radius);
}

void add_bounds(NpzWriter& out, const char* name, const Bounds& bounds) {
  const double both[] = {bounds.lower, bounds.upper};
  out.numbers<double>(name, {2}, both);
}

}  // namespace

Result<std::string> encode_body_file(const BodyFile& file) {
  NpzWriter out;
  out.text("format", "medial-vk body");
  out.number("format_version", kBodyFileFormat);
  out.text("version", file.version);
  out.text("unit", "mesh");
  std::vector<double> vertices;
  vertices.reserve(3 * file.mesh.vertices.size());
  for (const Point& p : file.mesh.vertices) vertices.insert(vertices.end(), p.begin(), p.end());
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * file.mesh.triangles.size());
  for (const Triangle& t : file.mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  out.numbers<double>("vertices", {file.mesh.vertices.size(), 3}, vertices);
  out.numbers<std::uint32_t>("triangles", {file.mesh.triangles.size(), 3}, corners);
  add_balls(out, "inside_centre", "inside_radius", file.inside);
  add_balls(out, "cover_centre", "cover_radius", file.cover);
  const BodyMeasures& measures = file.measures;
  out.number("inside_excess", measures.inside_excess);
  add_bounds(out, "inside_gap", measures.inside_gap);
  add_bounds(out, "cover_reach_out", measures.cover_reach_out);
  out.number("covered_triangles", measures.covered_triangles);
  out.number("envelope_vertices", measures.envelope_vertices);
  out.number("solid_volume", measures.solid_volume);
  out.number("inside_volume", measures.inside_volume);
  out.number("cover_volume", measures.cover_volume);
  return out.finish();
}

}  // namespace medial_vk
