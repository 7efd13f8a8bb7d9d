// A prism with a polygonal base, known exactly: nearest boundary points and medial points without any mesh.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace medial_vk::test {

class ExtrudedPolygon {
 public:
  /// Base counter-clockwise in the plane z = 0, extruded to z = `height`.
  ExtrudedPolygon(std::vector<Eigen::Vector2d> base, double height) : base_(std::move(base)), height_(height) {}

  bool contains(const Eigen::Vector3d& p) const;
  /// The nearest boundary point of a point inside.
  Eigen::Vector3d nearest(const Eigen::Vector3d& p) const;

  struct MedialPoint {
    Eigen::Vector3d centre;
    double radius;
    double object_angle;
    double travelled;  ///< From the point that it was found from.
  };
  /// The centre of the ball that touches the boundary at nearest(p) and stops growing while its centre moves from p
  /// away from that contact: the first point on the way with a second nearest point.
  MedialPoint medial_point_behind(const Eigen::Vector3d& p) const;

  /// Points just inside the boundary, `step` apart on every face. Every medial point has a contact on the boundary, so
  /// the medial points behind all of these cover the medial surface; they are at most sqrt(2) * step apart on the
  /// bisectors of faces that meet at right angles, the steepest against their faces here.
  std::vector<Eigen::Vector3d> boundary_samples(double step) const;

 private:
  bool base_contains(const Eigen::Vector2d& p) const;

  std::vector<Eigen::Vector2d> base_;
  double height_;
};

}  // namespace medial_vk::test
