// Geometric queries on a triangle mesh, in double precision, for all other parts of the reference and for comparison
// with device kernels. Lengths are in the units of the mesh.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "cpu_reference/mesh.h"

namespace medial_vk::reference {

/// The part of a triangle that holds the nearest point.
enum class Feature : std::uint8_t { kFace, kEdge, kVertex };

/// The point of one triangle that is nearest to a query.
struct TrianglePoint {
  Eigen::Vector3d point;
  double squared_distance;
  Feature feature;
};

/// The nearest point of the triangle abc to p. Safe for needles and for triangles without area: the point is always a
/// convex combination of the corners, so the distance is below the true one by rounding at most.
TrianglePoint closest_point_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                        const Eigen::Vector3d& c);

/// The point of a mesh that is nearest to a query.
struct Closest {
  Eigen::Vector3d point;
  double distance;
  int triangle;  // the smallest index among exact ties
  Feature feature;
};

/// The gradient of D at p, Definition 2.2: the unit direction from p to its nearest boundary point (0 on the boundary).
Eigen::Vector3d direction_to(const Eigen::Vector3d& p, const Closest& nearest);

/// A bounding volume hierarchy: boxes, split at the median of the longest side of the centroids.
class Tree {
 public:
  /// Copies the required data of the mesh, which must have at least one triangle and valid indices.
  explicit Tree(const Mesh& mesh);

  Closest closest(const Eigen::Vector3d& p) const;

  /// True if no point of the mesh lies strictly inside the ball. Stops at the first one found.
  bool ball_is_empty(const Eigen::Vector3d& centre, double radius) const;

  /// Triangles within `radius` of the centre, touching included, in the order of the tree.
  std::vector<int> gather(const Eigen::Vector3d& centre, double radius) const;

  int triangle_count() const { return static_cast<int>(corners_.size()); }
  TrianglePoint closest_on(int triangle, const Eigen::Vector3d& p) const;
  const Eigen::Vector3d& corner(int triangle, int k) const { return corners_[triangle][k]; }
  /// Unit outward normal, zero if the triangle has no area.
  const Eigen::Vector3d& normal(int triangle) const { return normals_[triangle]; }

  /// Of the box in which medial points are sought (Mesh::room).
  const Eigen::Vector3d& lower() const { return lower_; }
  const Eigen::Vector3d& upper() const { return upper_; }
  double longest_side() const { return (upper() - lower()).maxCoeff(); }

  /// A bound on the rounding error of any distance computed by this class, derived in tree.cpp.
  double rounding() const { return rounding_; }

  /// The winding number far away.
  double far_number() const { return far_number_; }

 private:
  friend double winding_number(const Tree& tree, const Eigen::Vector3d& p, double tolerance);

  struct Node {
    Eigen::Vector3d lower, upper;
    int first = 0, last = 0;    // a range of order_
    int left = -1, right = -1;  // -1 in a leaf
    // Moments for the winding number (winding.cpp).
    Eigen::Vector3d centre;  // area-weighted centroid
    double reach = 0;        // largest distance of a corner from the centre
    double area = 0;
    Eigen::Vector3d area_normal;  // sum of area times normal
    Eigen::Matrix3d moment;       // sum of area times (centroid - centre) normal^T
  };

  double winding_number_by_moments(const Eigen::Vector3d& p, double opening, double& error) const;
  int build(int first, int last, const std::vector<Eigen::Vector3d>& centroids);
  void add_moments(Node& node) const;

  std::vector<std::array<Eigen::Vector3d, 3>> corners_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<double> areas_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  Eigen::Vector3d lower_, upper_;
  double rounding_ = 0, far_number_ = 0;
};

/// The generalised winding number (Jacobson et al. 2013), exact: the sum of all solid angles over 4 pi. Up to rounding:
/// the sign of the angle of a triangle of the area A is noise if p is nearer to it than some 2^-52 L^3 / A, where L is
/// the distance from its corners. Beside a sliver that may be far more than a rounding of the coordinates. Of an
/// unbounded solid, whose triangles are turned over, it is greater by one.
double winding_number(const Tree& tree, const Eigen::Vector3d& p);

/// The winding number within `tolerance`: far nodes contribute by their first two moments (Barill et al. 2018), and a
/// proved bound decides which nodes are far.
double winding_number(const Tree& tree, const Eigen::Vector3d& p, double tolerance);

/// True if the winding number is at least 1/2. The approximation decides unless it is too close to 1/2; otherwise the
/// exact sum does.
bool is_inside(const Tree& tree, const Eigen::Vector3d& p);

/// N unit vectors spread over the sphere by the generalised spiral of Rakhmanov, Saff and Zhou (1994), Section 2.3.2.
std::vector<Eigen::Vector3d> spiral_points(int n);

/// The other intersection of the sphere with the line through its point p with direction d, Definition 2.3.
Eigen::Vector3d opposite(const Eigen::Vector3d& centre, const Eigen::Vector3d& p, const Eigen::Vector3d& direction);

/// Outward flux of the gradient of D through a sphere: equation 2.4, over the samples that are not two-sided fans.
struct Flux {
  double average = 0;  // sum / (samples - fans), 0 if every sample is a fan
  double sum = 0;      // of gradient . outward normal
  int samples = 0;
  int fans = 0;                  // samples left out, Definition 2.4
  double greatest_distance = 0;  // from a sample, fans included, to the boundary (2.4.2)
};

/// Returns nearest boundary points: a tree, or a list that is known to suffice.
using ClosestFunction = std::function<Closest(const Eigen::Vector3d&)>;

/// `directions` are unit vectors (spiral_points). Two gradients are the same if they differ by at most `same`.
Flux outward_flux(const ClosestFunction& closest, const Eigen::Vector3d& centre, double radius,
                  const std::vector<Eigen::Vector3d>& directions, double same = 1e-7);
Flux outward_flux(const Tree& tree, const Eigen::Vector3d& centre, double radius,
                  const std::vector<Eigen::Vector3d>& directions, double same = 1e-7);

/// The result of Algorithm 1: p, its distance and both gradients; q is the other end, within epsilon of p.
struct Retraction {
  Eigen::Vector3d p, q;
  double radius;
  Eigen::Vector3d spoke_p, spoke_q;
};

/// Algorithm 1: q = p + gamma grad D(p) with different nearest points B(p), B(q). Points at most `same` apart are the
/// same contact (rounding).
Retraction retract(const ClosestFunction& closest, Eigen::Vector3d p, Eigen::Vector3d q, double epsilon, double same);
Retraction retract(const Tree& tree, const Eigen::Vector3d& p, const Eigen::Vector3d& q, double epsilon);

/// Half the angle between two unit vectors, accurate for all of [0, pi/2].
double half_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace medial_vk::reference
