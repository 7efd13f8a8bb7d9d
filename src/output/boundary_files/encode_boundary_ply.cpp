#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>

#include "common/file_extension.h"
#include "medial_vk/version.h"
#include "output/atomic_files/little_endian.h"
#include "output/boundary_files/encode_boundary.h"

namespace medial_vk {
namespace {

std::string header_of(const Mesh& mesh, const BoundaryFields& fields, bool ascii) {
  std::string out =
      fmt::format("ply\nformat {} 1.0\ncomment medial-vk {}\n", ascii ? "ascii" : "binary_little_endian", version());
  out +=
      fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n", mesh.vertices.size());
  for (const BoundaryField& field : fields.of_vertices) {
    const char* type = field.is_whole ? "int" : "double";
    if (field.components == 1) {
      out += fmt::format("property {} {}\n", type, field.name);
    } else {
      for (const char axis : {'x', 'y', 'z'}) out += fmt::format("property {} {}_{}\n", type, field.name, axis);
    }
  }
  return out +
         fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
}

void append_binary(std::string& out, const Mesh& mesh, const BoundaryFields& fields) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (const double x : mesh.vertices[i]) append_little_endian(out, x);
    for (const BoundaryField& field : fields.of_vertices) {
      for (std::size_t k = 0; k < field.components; ++k) {
        const double value = field.values[i * field.components + k];
        if (field.is_whole) {
          append_little_endian(out, static_cast<std::int32_t>(value));
        } else {
          append_little_endian(out, value);
        }
      }
    }
  }
  for (const Triangle& t : mesh.triangles) {
    append_little_endian(out, std::uint8_t{3});
    for (const std::uint32_t corner : t) append_little_endian(out, corner);
  }
}

/// A sign of NaN has no meaning, and some readers do not know it.
double without_sign_of_nan(double value) { return std::isnan(value) ? std::abs(value) : value; }

void append_text(std::string& out, const Mesh& mesh, const BoundaryFields& fields) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Point& p = mesh.vertices[i];
    fmt::format_to(std::back_inserter(out), "{:.17g} {:.17g} {:.17g}", p[0], p[1], p[2]);
    for (const BoundaryField& field : fields.of_vertices) {
      for (std::size_t k = 0; k < field.components; ++k) {
        fmt::format_to(std::back_inserter(out), " {:.17g}",
                       without_sign_of_nan(field.values[i * field.components + k]));
      }
    }
    out += '\n';
  }
  for (const Triangle& t : mesh.triangles) {
    fmt::format_to(std::back_inserter(out), "3 {} {} {}\n", t[0], t[1], t[2]);
  }
}

}  // namespace

std::string encode_boundary_ply(const Mesh& mesh, const BoundaryFields& fields, bool ascii) {
  std::string out = header_of(mesh, fields, ascii);
  if (ascii) {
    append_text(out, mesh, fields);
  } else {
    append_binary(out, mesh, fields);
  }
  return out;
}

Result<std::string> encode_boundary(const std::string& path, const Mesh& mesh, const BoundaryFields& fields,
                                    const BoundaryFileOptions& options) {
  const std::string extension = file_extension(path);
  if (extension == ".glb") return encode_boundary_glb(mesh, fields, options.colour, options.longest_side);
  if (extension == ".vtp") return encode_boundary_vtp(mesh, fields);
  if (extension == ".npz" || extension == ".json") {
    return encode_point_table(path, {mesh.vertices, mesh.triangles, fields, options.delta});
  }
  return encode_boundary_ply(mesh, fields, options.ascii);
}

}  // namespace medial_vk
