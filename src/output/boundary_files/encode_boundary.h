// What was measured at vertices or other points of the boundary as a file: the mesh as PLY, glTF or the XML of VTK, and
// tables.
#pragma once

#include <span>
#include <string>

#include "boundary_fields/boundary_fields.h"
#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

struct BoundaryFileOptions {
  bool ascii = false;                                  ///< PLY as text.
  BoundaryColour colour = BoundaryColour::kThickness;  ///< Of the vertices in glTF.
  double longest_side = 0;                             ///< Of the mesh.
  double delta = 0;                                    ///< Of thickness, in mesh units; NaN: it was not measured.
};

/// One property or three for each field: `name`, or `name_x`, `name_y` and `name_z`; double or int. Text has 17
/// significant digits, and "nan".
std::string encode_boundary_ply(const Mesh& mesh, const BoundaryFields& fields, bool ascii);
/// PolyData, one array for each field, Float64 or Int32, in base64.
std::string encode_boundary_vtp(const Mesh& mesh, const BoundaryFields& fields);
/// Accessors of float named _THICKNESS_LOWER and so on: glTF has no other type for attributes of programs, and no NaN,
/// so that numbers that are not known are 0. Positions are relative to the node, which lies in the middle. Error
/// kCannotWrite: the file would exceed the size limit of its format.
Result<std::string> encode_boundary_glb(const Mesh& mesh, const BoundaryFields& fields, BoundaryColour colour,
                                        double longest_side);

struct PointTable {
  std::span<const Point> points;
  std::span<const Triangle> triangles;  ///< None: the points are no vertices.
  const BoundaryFields& fields;
  double delta = 0;  ///< As in BoundaryFileOptions.
};

/// All fields, those of balls, too: NumPy arrays for .npz, an object for each point for .json, else CSV. Text has the
/// shortest digits that give the same doubles, and words for kinds and states.
Result<std::string> encode_point_table(const std::string& path, const PointTable& table);

/// Chooses the format by the extension of `path`: .glb, .vtp, .npz, .json; else PLY, also for standard output.
Result<std::string> encode_boundary(const std::string& path, const Mesh& mesh, const BoundaryFields& fields,
                                    const BoundaryFileOptions& options);

}  // namespace medial_vk
