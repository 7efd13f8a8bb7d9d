// The distance of two meshes in many poses, again by pairs of triangles, of which those are left out whose balls are
// farther apart than some points that were found. As accurate as cpu_reference/distance.h.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cpu_reference/distance.h"
#include "cpu_reference/mesh.h"

namespace medial_vk::reference {

class DistanceMesh {
 public:
  /// Precondition: the mesh has a triangle.
  explicit DistanceMesh(const Mesh& mesh);

  /// A ball that holds a triangle, or some consecutive ones.
  struct Around {
    Eigen::Vector3d centre;
    double radius;
  };
  static constexpr std::size_t kRun = 16;  ///< Triangles that have a ball in common.

  bool is_closed() const { return closed_; }
  const std::vector<Corners>& triangles() const { return triangles_; }
  const std::vector<Around>& balls() const { return balls_; }  ///< By triangle, around its centroid.
  const std::vector<Around>& runs() const { return runs_; }    ///< Number i: of the triangles from kRun i on.
  const Around& whole() const { return whole_; }               ///< Holds all triangles.
  /// One corner of each set of triangles that share corners.
  const std::vector<Eigen::Vector3d>& components() const { return components_; }
  double reach() const { return reach_; }  ///< The greatest distance of a corner from the origin.

 private:
  std::vector<Corners> triangles_;
  std::vector<Around> balls_, runs_;
  Around whole_;
  std::vector<Eigen::Vector3d> components_;
  bool closed_;
  double reach_ = 0;
};

/// As for meshes.
NearestPair nearest_of_meshes(const DistanceMesh& a, const DistanceMesh& b, const Motion& motion);
bool one_holds_the_other(const DistanceMesh& a, const DistanceMesh& b, const Motion& motion);

}  // namespace medial_vk::reference
