#include "hull_unions/union_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "hull_unions/cut_cube.h"

namespace medial_vk {
namespace {

constexpr CoveredCell kCovered = {8, 8}, kOutside = {0, 0}, kUnknown = {0, 8};

/// Planes across one direction, in a cell of half side 1: the hull is before `outer`, and the part of the cell before
/// `inner` is in the hull.
struct CellPlanes {
  Point normal;
  double outer = 0, inner = 0;
};

class CellCover {
 public:
  CellCover(const UnionHulls& hulls, const Point& centre, double half_side)
      : hulls_(hulls), centre_(centre), half_(half_side) {
    for (std::size_t k = 0; k < 8; ++k) {
      corners_[k] = {(k & 1) != 0 ? half_ : -half_, (k & 2) != 0 ? half_ : -half_, (k & 4) != 0 ? half_ : -half_};
    }
  }

  CoveredCell bounds(std::span<const std::uint32_t> may_meet, std::vector<HullAtCell>& meets) {
    meets.clear();
    const double reach = half_ * std::numbers::sqrt3 * (1 + 0x1p-50) + hulls_.rounding;
    for (const std::uint32_t hull : may_meet) {
      const AxisPoint nearest = hulls_.queries[hull].nearest(centre_);
      if (nearest.distance > reach) continue;
      if (nearest.distance < -reach) return kCovered;
      meets.push_back({hull, nearest});
      if (meets.size() <= CutCube::kMostCuts) move_to_place(meets);  // longer lists are not used in order
    }
    if (meets.size() > CutCube::kMostCuts) return kUnknown;
    std::size_t count = 0;
    for (std::size_t i = 0; i < meets.size(); ++i) {
      switch (planes_of(meets[i], planes_[count])) {
        case Meeting::kNone:
          break;
        case Meeting::kWhole:
          return kCovered;
        case Meeting::kPart:
          meets[count++] = meets[i];
      }
    }
    meets.resize(count);
    return count == 0 ? kOutside : bounds_by_planes(count);
  }

 private:
  /// Moves the last hull before those that are farther from the centre: most lists are short and nearly in order.
  static void move_to_place(std::vector<HullAtCell>& meets) {
    for (std::size_t i = meets.size() - 1; i > 0; --i) {
      if (meets[i - 1].nearest.distance <= meets[i].nearest.distance) return;
      std::swap(meets[i - 1], meets[i]);
    }
  }

  enum class Meeting : std::uint8_t { kNone, kPart, kWhole };

  /// The signed distance g is convex. Less a linear function it is convex, too, and greatest at a corner: if g is at
  /// most g(c) + n (x - c) + d at the corners, it is so in the whole cell. The plane behind the hull along n touches
  /// it.
  Meeting planes_of(const HullAtCell& meeting, CellPlanes& planes) const {
    const AxisQuery& query = hulls_.queries[meeting.hull];
    const Point out = centre_ - ball_at(query.hull(), meeting.nearest.weight).centre;
    const double size = length(out);
    planes.normal = size > 0 ? (1 / size) * out : Point{0, 0, 1};
    const Point& n = planes.normal;
    double outer = -std::numeric_limits<double>::infinity();
    for (const Ball& ball : query.hull().balls()) outer = std::max(outer, dot(n, ball.centre - centre_) + ball.radius);
    outer += hulls_.rounding;
    const double extent = half_ * (std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2])) * (1 + 0x1p-50);
    if (outer < -extent) return Meeting::kNone;
    double greatest = -std::numeric_limits<double>::infinity(), excess = 0;
    for (const Point& corner : corners_) {
      const double distance = query.distance(centre_ + corner);
      greatest = std::max(greatest, distance);
      excess = std::max(excess, distance - meeting.nearest.distance - dot(n, corner));
    }
    if (greatest <= -hulls_.rounding) return Meeting::kWhole;
    planes.outer = outer / half_;
    planes.inner = (-meeting.nearest.distance - excess - 3 * hulls_.rounding) / half_;
    return Meeting::kPart;
  }

  /// What no hull covers is in the cell beyond all inner planes, and what is beyond all outer planes is not covered. A
  /// cut that fails is left out of the first, and the second is then nothing.
  CoveredCell bounds_by_planes(std::size_t count) const {
    CutCube most, least_uncovered;
    bool all = true;
    for (std::size_t i = 0; i < count; ++i) {
      most.cut(planes_[i].normal, planes_[i].inner);
      all = all && least_uncovered.cut(planes_[i].normal, planes_[i].outer);
    }
    if (most.empty()) return kCovered;
    CoveredCell cell = kUnknown;
    cell.lower = std::clamp(8 - most.volume() - CutCube::kRounding, 0.0, 8.0);
    if (all && !least_uncovered.empty()) {
      cell.upper = std::clamp(8 - least_uncovered.volume() + CutCube::kRounding, cell.lower, 8.0);
    }
    return cell;
  }

  const UnionHulls& hulls_;
  const Point centre_;
  const double half_;
  std::array<Point, 8> corners_ = {};
  std::array<CellPlanes, CutCube::kMostCuts> planes_ = {};
};

}  // namespace

CoveredCell cover_cell(const UnionHulls& hulls, const Point& centre, double half_side,
                       std::span<const std::uint32_t> may_meet, std::vector<HullAtCell>& meets) {
  return CellCover(hulls, centre, half_side).bounds(may_meet, meets);
}

}  // namespace medial_vk
