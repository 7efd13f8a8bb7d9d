#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/mesh_topology.h"

namespace medial_vk {

/// Triangles that close an open mesh: each open edge is joined to one point. With these, winding numbers are integers
/// (docs/theory.md, "Outside"), so a rough one and the winding number of the added triangles, which are few, give that
/// of the mesh.
class WindingClosure {
 public:
  WindingClosure(const Mesh& mesh, const MeshTopology& topology);

  std::size_t size() const { return triangles_.size(); }

  /// The winding number of the mesh at `p`, up to rounding. The error of `rough` is at most `doubt`, which is below
  /// 1/4. No value: the sum of both numbers is farther than `doubt` from every integer, as it may be on an edge of the
  /// added triangles, where their angles are not defined.
  std::optional<double> sharpened(const Point& p, double rough, double doubt) const;

 private:
  struct Closing {
    std::array<Point, 3> corners;
    double times;  // the edge is open so often
  };

  std::vector<Closing> triangles_;
};

}  // namespace medial_vk
