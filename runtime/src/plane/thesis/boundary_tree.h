// The nearest segment of a boundary, by a binary tree of boxes.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/sites/frame.h"
#include "plane/sites/site_set.h"

namespace medial_vk::plane {

/// The nearest point of a boundary.
struct Foot {
  std::uint32_t site = 0;
  Vec2 at;
  Vec2
      direction;  ///< Unit, towards it; across the segment where `site` is one, so that short distances lose no digits.
  double distance = 0;
};

class BoundaryTree {
 public:
  /// Keeps a reference to `sites`, which has segments. Throws std::bad_alloc.
  explicit BoundaryTree(const SiteSet& sites);
  Foot nearest(Vec2 x) const;

 private:
  static constexpr std::uint32_t kLeafSegments = 4;
  struct Node {
    Box box;
    std::uint32_t first = 0;  // of a leaf: in order_; otherwise the second child, and the first one follows the node
    std::uint32_t count = 0;  // of segments in a leaf, 0 in others
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t last);
  Box box_of_segments(std::uint32_t first, std::uint32_t last) const;
  Foot foot_on(std::uint32_t site, Vec2 x) const;

  const SiteSet& sites_;
  std::vector<std::uint32_t> order_;  // sites
  std::vector<Node> nodes_;
};

}  // namespace medial_vk::plane
