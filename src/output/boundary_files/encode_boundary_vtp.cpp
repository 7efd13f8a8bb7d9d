#include <fmt/format.h>

#include <cstdint>
#include <span>

#include "output/atomic_files/little_endian.h"
#include "output/boundary_files/encode_boundary.h"
#include "output/page/base64.h"

namespace medial_vk {
namespace {

/// The bytes of an array, behind their number, as VTK reads them from base64.
class DataArray {
 public:
  explicit DataArray(std::uint64_t bytes) {
    bytes_.reserve(bytes + sizeof(bytes));
    append_little_endian(bytes_, bytes);
  }

  template <class T>
  void add(T value) {
    append_little_endian(bytes_, value);
  }

  void write(std::string& out, const char* type, std::string_view name, std::uint32_t components) const {
    out += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">", type, name,
                       components);
    page::append_base64(out, {reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size()});
    out += "</DataArray>\n";
  }

 private:
  std::string bytes_;
};

void write_field(std::string& out, const BoundaryField& field) {
  if (field.is_whole) {
    DataArray array(field.values.size() * sizeof(std::int32_t));
    for (const double value : field.values) array.add(static_cast<std::int32_t>(value));
    array.write(out, "Int32", field.name, field.components);
  } else {
    DataArray array(field.values.size() * sizeof(double));
    for (const double value : field.values) array.add(value);
    array.write(out, "Float64", field.name, field.components);
  }
}

void write_points(std::string& out, const Mesh& mesh) {
  DataArray points(mesh.vertices.size() * sizeof(Point));
  for (const Point& p : mesh.vertices) {
    for (const double x : p) points.add(x);
  }
  points.write(out, "Float64", "Points", 3);
}

void write_triangles(std::string& out, const Mesh& mesh) {
  DataArray corners(mesh.triangles.size() * 3 * sizeof(std::int64_t));
  DataArray ends(mesh.triangles.size() * sizeof(std::int64_t));
  std::int64_t end = 0;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) corners.add(std::int64_t{corner});
    end += 3;
    ends.add(end);
  }
  corners.write(out, "Int64", "connectivity", 1);
  ends.write(out, "Int64", "offsets", 1);
}

}  // namespace

std::string encode_boundary_vtp(const Mesh& mesh, const BoundaryFields& fields) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n<PointData>\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const BoundaryField& field : fields.of_vertices) write_field(out, field);
  out += "</PointData>\n<Points>\n";
  write_points(out, mesh);
  out += "</Points>\n<Polys>\n";
  write_triangles(out, mesh);
  return out + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace medial_vk
