// Cells of space in which thin walls may have their middle (docs/theory.md, "Least wall").
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bvh/nearby_triangles.h"
#include "bvh/triangle_distance.h"
#include "bvh/wide_tree.h"
#include "least_wall/contact_pairs.h"
#include "least_wall/spoke_groups.h"
#include "medial_vk/least_wall.h"
#include "solid/solid.h"

namespace medial_vk {

/// The normals of triangles, with bounds of their errors, by leaf position; any direction where none is trusted: balls
/// may touch such a triangle from both sides.
std::vector<SpokeCone> normals_of(const Solid& solid);

/// A solid and what all searches on it share.
struct WallField {
  const Solid& solid;
  const WideTree& tree;
  const std::vector<SpokeCone>& normals;
  LeastWallOptions options;
  double small = 0;     ///< Half the side of cells in which more triangles are examined, as beside the apex of a fan.
  double rounding = 0;  ///< Of distances and of the centres of cells.
};

/// A cube.
struct WallCell {
  Point centre = {0, 0, 0};
  double half = 0;   // of its side
  double least = 0;  // no medial ball with the object angle around a centre in it is smaller, unless it is no smaller
                     // than the best one so far
  std::optional<Point> vertex = std::nullopt;  // of all triangles within reach of this cell, or of one that it is in
  std::uint64_t number = 0;

  WallCell part(std::size_t index) const;
};

/// Examines one cell after another in the same memory.
class WallCells {
 public:
  explicit WallCells(const WallField& field);

  /// Raises the bound of the cell: infinite if there is no medial ball with the object angle in it below the radius
  /// `best`. Looks for one, and returns it.
  std::optional<WallBall> examine(WallCell& cell, double best);

  /// Half the side of a cube around a vertex in which there is no medial ball with the object angle; 0: that is not
  /// known.
  double free_around(const Point& vertex);

 private:
  struct Start {
    Point contact;        // the point nearest to the centre of the cell
    double distance;      // of that
    double h;             // half the diagonal of the cell
    double object_angle;  // of all balls around centres in it, at least
  };
  /// What is known of the balls around centres in the cell.
  struct Known {
    bool are_possible = true;
    double object_angle = 0;
    double least_radius = 0;
  };

  bool is_on_other_side(const Point& centre, double distance) const;
  std::optional<Start> bound(WallCell& cell, double best);
  void gather(const Point& centre, double radius, std::uint32_t nearest_triangle, std::size_t most);
  Known pairs_by_normals();
  SpokeCone direction_to(const NearestOffset& offset, double distance, double h) const;
  Known pairs_by_directions(double distance, double h);
  double radius_by_pairs(const WallCell& cell, double distance, double h, double known);
  void bound_by_heights(Known& known) const;
  std::optional<Point> common_vertex() const;
  double cone_radius(const Point& vertex);
  bool is_free(WallCell cell);
  std::optional<double> step_to_middle(const Point& direction, double distance) const;
  std::optional<WallBall> touch(const Point& contact, const Point& direction, double radius) const;

  /// A triangle within reach.
  struct Near {
    std::uint32_t position;
    NearestOffset offset;  // of its nearest point from the centre of the cell
  };

  const WallField& field_;
  double toward_;  // 1: balls are on the inner side of triangles, -1: on the outer side
  double rounding_;
  double reach_ = 0;  // from the centre of the cell, of contacts
  SpokeGroups groups_;
  std::vector<std::uint32_t> nearby_;
  std::vector<Near> near_;
  std::vector<SpokeCone> cones_;  // by triangle within reach
  std::vector<const SpokeCone*> meeting_;
  std::vector<FacingTriangle> facing_;
  std::vector<std::pair<Point, Point>> edges_;  // within reach
  std::vector<PossibleContact> contacts_;
  std::size_t nearest_ = 0;  // the nearest of them
};

}  // namespace medial_vk
