#include "mesh_curvature.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

#include "base/point_ops.h"

namespace medial_vk::bench {
namespace {

using Eigen::Vector3d;

Vector3d eigen(const Point& p) { return {p[0], p[1], p[2]}; }
Point point(const Vector3d& v) { return {v[0], v[1], v[2]}; }

struct Face {
  std::array<Vector3d, 3> corners, sides;  // side k is opposite corner k
  Vector3d doubled_normal;
  std::array<double, 3> shares;  // the areas of the corners' Voronoi cells
};

Face face_of(const Mesh& mesh, const Triangle& t) {
  Face face;
  for (std::size_t k = 0; k < 3; ++k) face.corners[k] = eigen(mesh.vertices[t[k]]);
  std::array<double, 3> squares, weights;
  for (std::size_t k = 0; k < 3; ++k) {
    face.sides[k] = face.corners[(k + 2) % 3] - face.corners[(k + 1) % 3];
    squares[k] = face.sides[k].squaredNorm();
  }
  face.doubled_normal = face.sides[0].cross(face.sides[1]);
  const double area = 0.5 * face.doubled_normal.norm();
  // Barycentric weights of the circumcentre; an obtuse corner gets half of the face.
  for (std::size_t k = 0; k < 3; ++k)
    weights[k] = squares[k] * (squares[(k + 1) % 3] + squares[(k + 2) % 3] - squares[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    const double sum = weights[0] + weights[1] + weights[2];
    face.shares[k] = 0.5 * area * (weights[next] + weights[last]) / sum;
    if (weights[k] <= 0) {
      face.shares = {area / 4, area / 4, area / 4};
      face.shares[k] = area / 2;
      break;
    }
  }
  return face;
}

/// The form of a face in space: symmetric, on its plane.
Eigen::Matrix3d form_of(const Face& face, const std::array<Vector3d, 3>& normals) {
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = face.sides[0].normalized();
  axes.col(1) = face.doubled_normal.normalized().cross(axes.col(0));
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector2d e = axes.transpose() * face.sides[k];
    const Eigen::Vector2d turn = axes.transpose() * (normals[(k + 2) % 3] - normals[(k + 1) % 3]);
    const Vector3d u(e[0], e[1], 0), v(0, e[0], e[1]);
    matrix += u * u.transpose() + v * v.transpose();
    right += turn[0] * u + turn[1] * v;
  }
  const Vector3d entries = matrix.fullPivLu().solve(right);
  Eigen::Matrix2d form;
  form << entries[0], entries[1], entries[1], entries[2];
  return axes * form * axes.transpose();
}

}  // namespace

std::vector<MeshCurvature> mesh_curvature(const Mesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  std::vector<Vector3d> normals(count, Vector3d::Zero());
  std::vector<Eigen::Matrix3d> forms(count, Eigen::Matrix3d::Zero());
  std::vector<double> areas(count, 0);
  for (const Triangle& t : mesh.triangles) {
    const Face face = face_of(mesh, t);
    // Weights of N. Max, 1999: exact on spheres.
    for (std::size_t k = 0; k < 3; ++k) {
      const double sides = face.sides[(k + 1) % 3].squaredNorm() * face.sides[(k + 2) % 3].squaredNorm();
      normals[t[k]] += face.doubled_normal / sides;
    }
  }
  for (Vector3d& normal : normals) normal.normalize();
  for (const Triangle& t : mesh.triangles) {
    const Face face = face_of(mesh, t);
    const Eigen::Matrix3d form = form_of(face, {normals[t[0]], normals[t[1]], normals[t[2]]});
    for (std::size_t k = 0; k < 3; ++k) {
      // Turned from the plane of the face to that of the vertex, as the article does.
      const Eigen::Matrix3d turn =
          Eigen::Quaterniond::FromTwoVectors(face.doubled_normal, normals[t[k]]).toRotationMatrix();
      forms[t[k]] += face.shares[k] * (turn * form * turn.transpose());
      areas[t[k]] += face.shares[k];
    }
  }
  std::vector<MeshCurvature> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    out[i].normal = point(normals[i]);
    const Vector3d x = eigen(perpendicular_to(out[i].normal)), y = normals[i].cross(x);
    Eigen::Matrix<double, 3, 2> axes;
    axes << x, y;
    const Eigen::Matrix2d form = axes.transpose() * forms[i] * axes / areas[i];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(form);
    for (int k = 0; k < 2; ++k) {
      out[i].kappa[static_cast<std::size_t>(k)] = solver.eigenvalues()[1 - k];
      out[i].directions[static_cast<std::size_t>(k)] = point(axes * solver.eigenvectors().col(1 - k));
    }
  }
  return out;
}

}  // namespace medial_vk::bench
