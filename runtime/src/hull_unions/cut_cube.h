// The volume of a cube that is cut by some half-spaces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/point_ops.h"

namespace medial_vk {

/// The cube [-1, 1]^3, and what cuts leave of it, by its faces. No memory but its own.
class CutCube {
 public:
  static constexpr std::size_t kMostCuts = 16;
  /// A bound of the error of volume() and of the error that the cuts add to it, for up to kMostCuts cuts. Each corner
  /// that a cut makes is within 2^-48 of the cut's plane, and each corner that it takes away or leaves wrongly is, so
  /// that all faces are within 16 * 2^-48 of where they belong; the surface is at most 24, and 24 * 2^-44 < 2^-39.
  static constexpr double kRounding = 0x1p-38;

  CutCube();

  /// Removes the points x with dot(normal, x) < offset, |normal| = 1. Returns false, and removes nothing, if rounding
  /// leaves no consistent surface. At most kMostCuts calls.
  bool cut(const Point& normal, double offset);

  bool empty() const { return face_count_ == 0; }
  double volume() const;

 private:
  static constexpr std::size_t kMostFaces = 6 + kMostCuts;
  static constexpr std::size_t kMostPoints = 8 + kMostCuts * (6 + kMostCuts);

  struct Face {
    std::size_t count = 0;
    std::array<std::uint16_t, kMostFaces + 2> corners;  // counter-clockwise from outside
  };
  struct CutEdge {
    std::uint16_t a, b, point;
  };
  /// The cut through one face: from where its border comes back to the kept side to where it leaves it.
  struct CutFace {
    std::uint16_t entry, exit;
  };

  std::uint16_t crossing(std::uint16_t a, std::uint16_t b);
  bool cut_face(const Face& face, Face& kept);
  bool close(Face& cap) const;

  std::array<Point, kMostPoints> points_;
  std::size_t point_count_ = 0;
  std::array<Face, kMostFaces> faces_;
  std::size_t face_count_ = 0;
  // Of the cut under way:
  std::array<double, kMostPoints> height_;
  std::array<CutEdge, 2 * kMostFaces> cut_edges_;
  std::size_t cut_edge_count_ = 0;
  std::array<CutFace, kMostFaces> cut_faces_;
  std::size_t cut_face_count_ = 0;
};

}  // namespace medial_vk
