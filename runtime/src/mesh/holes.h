// The holes of an open mesh and their fillings, for holes that lie inside other parts.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk {

/// A *hole* is a connected set of open edges, at which the triangles do not cancel; its *filling* is the fan of
/// triangles between them and their mean, which cancels with them.
class Holes {
 public:
  /// `component_of`: by triangle. There are no holes if more than `kMostOpenEdges` edges are open.
  Holes(const Mesh& mesh, const std::vector<std::uint32_t>& component_of);

  static constexpr std::size_t kMostOpenEdges = 4096;
  /// All triangles of a filling share a corner, so their boxes overlap: the search for crossings tests half the square
  /// of this many pairs, far below its budget.
  static constexpr std::uint64_t kMostOfOne = 512;

  std::uint32_t count() const { return static_cast<std::uint32_t>(apexes_.size()); }
  std::uint64_t open_edges(std::uint32_t hole) const { return open_edges_[hole]; }
  /// False if it has more than `kMostOfOne` edges, or one with a multiplicity above one.
  bool can_be_filled(std::uint32_t hole) const { return can_be_filled_[hole] != 0; }

  struct Filled {
    Mesh mesh;                                ///< The triangles of the mesh, then the fillings.
    std::vector<std::uint32_t> component_of;  ///< By triangle. A filling belongs to the component of its hole.
    std::vector<std::uint32_t> hole_of;       ///< By triangle of the fillings.
  };
  /// With the fillings of these holes.
  Filled fill(const Mesh& mesh, const std::vector<std::uint32_t>& component_of, const std::vector<char>& wanted) const;

 private:
  struct OpenEdge {
    std::uint32_t from, to;  // as the triangle runs that has no partner
    std::uint32_t component, hole;
  };

  std::vector<OpenEdge> edges_;
  std::vector<Point> apexes_;              // by hole
  std::vector<std::uint64_t> open_edges_;  // by hole
  std::vector<char> can_be_filled_;        // by hole
};

}  // namespace medial_vk
