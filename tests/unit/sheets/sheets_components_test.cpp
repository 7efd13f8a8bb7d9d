// Components of sheets: their joins and their distribution, against the simplest programs for the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "base/point_ops.h"
#include "sheets/absorb_components.h"
#include "sheets/join_components.h"
#include "sheets/spoke_turns.h"

namespace medial_vk {
namespace {

using testing::ElementsAreArray;

using Components = std::vector<std::uint32_t>;  // by position

MedialSphere point_at(std::uint32_t x, std::uint32_t y, const Point& normal, double radius = 4) {
  MedialSphere s;
  s.voxel = {x, y, 5};
  s.centre = {x + 0.5, y + 0.5, 5.5};
  s.radius = radius;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    s.spoke_a[axis] = static_cast<float>(normal[axis]);
    s.spoke_b[axis] = static_cast<float>(-normal[axis]);
  }
  return s;
}

/// A grid with holes: patches of random directions, and some noise of the points' own.
std::vector<MedialSphere> patches(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> coordinate;
  const auto size = static_cast<std::uint32_t>(4 + random() % 9), patch = static_cast<std::uint32_t>(1 + random() % 4);
  const double noise = random() % 2 == 0 ? 0.05 : 0.4;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Point> directions;
  std::vector<MedialSphere> out;
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      const Point drawn = {coordinate(random), coordinate(random), coordinate(random)};
      const Point& direction = directions.try_emplace({x / patch, y / patch}, drawn).first->second;
      const Point own = {coordinate(random), coordinate(random), coordinate(random)};
      const Point normal = direction + noise * own;
      if (random() % 8 != 0) out.push_back(point_at(x, y, 1 / length(normal) * normal));
    }
  }
  return out;
}

/// Components of neighbours whose spokes turn by 10 degrees at most.
Components grown(const VoxelGraph& graph) {
  Components component_of(graph.size(), std::numeric_limits<std::uint32_t>::max());
  std::uint32_t count = 0;
  for (std::uint32_t start = 0; start < graph.size(); ++start) {
    if (component_of[start] < count) continue;
    std::vector<std::uint32_t> open = {start};
    component_of[start] = count;
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      for (const std::uint32_t other : graph.neighbours(at)) {
        if (component_of[other] <= count) continue;
        if (cosine_of_turn(graph.sphere(at), graph.sphere(other)) < std::cos(10 * std::numbers::pi / 180)) continue;
        component_of[other] = count;
        open.push_back(other);
      }
    }
    ++count;
  }
  return component_of;
}

Components renumbered(Components component_of) {
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (std::uint32_t& component : component_of) {
    component = numbers.try_emplace(component, static_cast<std::uint32_t>(numbers.size())).first->second;
  }
  return component_of;
}

/// Borders of all pairs, measured again for every join.
class PlainJoining {
 public:
  PlainJoining(const VoxelGraph& graph, const Components& components) : component_of_(components) {
    for (const std::uint32_t component : components) ++points_[component];
    for (std::uint32_t point = 0; point < graph.size(); ++point) {
      std::map<std::uint32_t, float> greatest;
      for (const std::uint32_t other : graph.neighbours(point)) {
        const auto cosine = static_cast<float>(cosine_of_turn(graph.sphere(point), graph.sphere(other)));
        float& so_far = greatest.try_emplace(components[other], -1.0f).first->second;
        so_far = std::max(so_far, cosine);
      }
      greatest.erase(components[point]);
      for (const auto& [component, cosine] : greatest)
        borders_[std::minmax(components[point], component)].push_back(cosine);
    }
  }

  Components run(double limit) {
    while (!borders_.empty()) {
      const auto strongest =
          std::ranges::max_element(borders_, {}, [&](const auto& entry) { return weight(entry, limit); });
      if (weight(*strongest, limit) < 0) break;
      join(strongest->first.first, strongest->first.second);
    }
    return renumbered(component_of_);
  }

 private:
  using Borders = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<float>>;

  /// The sum of the weights of the border's points, in whole millionths of a degree. Points of repulsion are added
  /// until it has 1.75 sqrt(points of the smaller component).
  double weight(const Borders::value_type& entry, double limit) const {
    const auto& [components, cosines] = entry;
    const auto fewer = static_cast<double>(std::min(points_.at(components.first), points_.at(components.second)));
    double sum = 0;
    for (const float cosine : cosines) {
      const double turn = std::acos(std::min(double{cosine}, 1.0)) * 180 / std::numbers::pi;
      sum += std::round(std::clamp(limit - turn, -4.0, 30.0) * 1e6);
    }
    const double missing = std::max(0.0, 1.75 * std::sqrt(fewer) - static_cast<double>(cosines.size()));
    return sum * 1e-6 - 4 * missing;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    points_[a] += points_[b];
    std::ranges::replace(component_of_, b, a);
    Borders joined;
    for (const auto& [components, turns] : borders_) {
      const std::uint32_t first = components.first == b ? a : components.first;
      const std::uint32_t second = components.second == b ? a : components.second;
      if (first == second) continue;
      std::vector<float>& all = joined[std::minmax(first, second)];
      all.insert(all.end(), turns.begin(), turns.end());
    }
    borders_ = std::move(joined);
  }

  Components component_of_;
  std::map<std::uint32_t, std::size_t> points_;
  Borders borders_;
};

TEST(JoinComponents, AsAPlainProgramWould) {
  std::size_t joins = 0;
  for (std::uint32_t seed = 1; seed <= 150; ++seed) {
    const std::vector<MedialSphere> spheres = patches(seed);
    const VoxelGraph graph(spheres);
    const Components components = grown(graph);
    for (const double border : {0.0, 30.0, 77.0, 110.0, 180.0}) {
      SheetOptions options;
      options.border = border;
      Components joined = components;
      join_components(graph, options, joined);
      EXPECT_EQ(joined, PlainJoining(graph, components).run(border)) << "seed " << seed << ", border " << border;
      joins += std::set(components.begin(), components.end()).size() - std::set(joined.begin(), joined.end()).size();
    }
  }
  EXPECT_GT(joins, 1000u) << "too few joins for a meaningful test";
}

/// Rows of letters, each of which is a point and names its component. A blank is no point.
class Drawn {
 public:
  explicit Drawn(const std::vector<std::string>& rows) {
    for (std::size_t y = 0; y < rows.size(); ++y) {
      for (std::size_t x = 0; x < rows[y].size(); ++x) {
        if (rows[y][x] == ' ') continue;
        spheres_.push_back(point_at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), {0, 0, 1}));
        letters_.push_back(rows[y][x]);
      }
    }
  }

  /// The letters after the absorption of all components with fewer points than that.
  std::vector<std::string> absorbed(std::uint64_t points, std::size_t width) const {
    const std::set<char> names(letters_.begin(), letters_.end());
    const std::vector<char> alphabet(names.begin(), names.end());
    Components component_of;
    for (const char letter : letters_) {
      component_of.push_back(static_cast<std::uint32_t>(std::ranges::find(alphabet, letter) - alphabet.begin()));
    }
    SheetOptions options;
    options.width = 0;
    options.absorb_fragments = points;
    absorb_components(VoxelGraph(spheres_), 1, options, component_of);
    std::vector<std::string> rows(1 + spheres_.back().voxel[1], std::string(width, ' '));
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      rows[spheres_[i].voxel[1]][spheres_[i].voxel[0]] = alphabet[component_of[i]];
    }
    return rows;
  }

 private:
  std::vector<MedialSphere> spheres_;  // in voxel order
  std::vector<char> letters_;
};

// The point s has five points of B and three of A around it, although A comes first.
TEST(AbsorbComponents, AssignsAPointToTheComponentOfMostVoxelsAround) {
  EXPECT_THAT(Drawn({"AAABBB", "AABsBB", "AABBBB"}).absorbed(2, 6), ElementsAreArray({"AAABBB", "AABBBB", "AABBBB"}));
  EXPECT_THAT(Drawn({"BBBAAA", "BBAsAA", "BBAAAA"}).absorbed(2, 6), ElementsAreArray({"BBBAAA", "BBAAAA", "BBAAAA"}));
  EXPECT_THAT(Drawn({"AAAAAA", "BBBsBB", "BBBBBB"}).absorbed(2, 6), ElementsAreArray({"AAAAAA", "BBBBBB", "BBBBBB"}));
}

// A strip of one row between A and B is shortened from both ends, one point per layer: half of it is assigned to either
// side, and a point equally near to both to the first.
TEST(AbsorbComponents, LayerByLayer) {
  EXPECT_THAT(Drawn({"AAA       BBB", "AAAssssssBBBB", "AAA       BBB"}).absorbed(7, 13),
              ElementsAreArray({"AAA       BBB", "AAAAAABBBBBBB", "AAA       BBB"}));
  EXPECT_THAT(Drawn({"AAA        BBB", "AAAsssssssBBBB", "AAA        BBB"}).absorbed(8, 14),
              ElementsAreArray({"AAA        BBB", "AAAAAAABBBBBBB", "AAA        BBB"}));
}

// The first s has two of either around it, the second two of A and three of B, and does not depend on the assignment of
// the first.
TEST(AbsorbComponents, PointsOfALayerDoNotSeeEachOther) {
  EXPECT_THAT(Drawn({"AA ", "AA ", "ss ", "BBB"}).absorbed(3, 3), ElementsAreArray({"AA ", "AA ", "AB ", "BBB"}));
}

}  // namespace
}  // namespace medial_vk
