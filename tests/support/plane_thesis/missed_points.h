// The medial points in a circle that Algorithm 4 misses, against the conditions of Theorem 4.1 and against the tighter
// ones of docs/theory.md ("What finitely many samples of a circle can miss").
#pragma once

#include <array>
#include <span>
#include <vector>

#include "medial_vk/plane_axis.h"
#include "medial_vk/plane_thesis.h"

namespace medial_vk::test {

/// A medial point with two of its nearest boundary points.
struct MedialPoint {
  PlanePoint point = {};
  std::array<PlanePoint, 2> feet = {};
  double distance = 0;
  double angle = 0;  ///< Between both spokes: twice the object angle.
};

/// At the parameter t of an arc.
MedialPoint medial_point(const PreparedShape& shape, const AxisArc& arc, double t);

/// Theta of an undetermined circle.
class CombedCircle {
 public:
  CombedCircle(const PlaneCircle& circle, std::span<const CirclePoint> theta);

  /// L of Theorem 4.1.
  double longest_gap() const { return longest_gap_; }
  bool hull_contains(PlanePoint p) const;

  /// Where a spoke leaves the hull of Theta.
  struct Exit {
    std::uint32_t edge = 0;  ///< From the point of Theta with this number to the next one.
    double dip = 0;          ///< From the medial point to the hull's border, along the spoke.
    double bend = 0;         ///< By how much the medial point sees the edge under less than a straight angle.
  };
  Exit exit_of(const MedialPoint& p, int spoke) const;

  /// Of the six conditions, each as a share of its bound: some share is below 1, says the theorem.
  std::array<double, 6> published_shares(const MedialPoint& p) const;
  /// Of the conditions of the corollary: radius, angle, and the bend of the edge that either spoke crosses.
  std::array<double, 4> corollary_shares(const MedialPoint& p) const;
  /// Of the theorem on strips. Negative where it says nothing.
  struct StripShares {
    double with_the_flow = -1;     ///< Of the angle, where both spokes leave between heads.
    double against_the_flow = -1;  ///< Of the bend, where a spoke leaves between tails.
    bool is_combed = true;         ///< False where rounding decided about a sample.
  };
  StripShares strip_shares(const MedialPoint& p) const;

 private:
  bool is_tail(std::uint32_t i) const;
  /// The share of the bound where spokes leave through the edge after `edge`'s point: the angle or twice the bend.
  double strip_share(const MedialPoint& p, std::uint32_t edge) const;

  PlaneCircle circle_;
  std::span<const CirclePoint> theta_;
  double longest_gap_ = 0;
};

}  // namespace medial_vk::test
