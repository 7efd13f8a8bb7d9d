#pragma once

#include <array>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/mesh_topology.h"

namespace medial_vk {

/// Triangles that close an open mesh: each open edge is joined to the mean of all of them. With these, winding numbers
/// are integers (docs/theory.md, "Outside"), so a rough one and the winding number of the added triangles, which are
/// few, give that of the mesh.
class WindingClosure {
 public:
  WindingClosure(const Mesh& mesh, const MeshTopology& topology);

  std::size_t size() const { return triangles_.size(); }

  /// The winding number of the mesh at `p`, up to rounding. The error of `rough` is below 1/2.
  double sharpened(const Point& p, double rough) const;

 private:
  struct Closing {
    std::array<Point, 3> corners;
    double times;  // the edge is open so often
  };

  std::vector<Closing> triangles_;
};

}  // namespace medial_vk
