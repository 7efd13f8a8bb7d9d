// The source leaves open at which depth each test discards. As for meshes (docs/theory.md), cells above the voxels are
// discarded if their sphere lies inside and has no positive flux; the thresholds of 2.4.2 are applied to voxels; a cell
// whose sphere meets the boundary is divided without a test, and searched if narrow features are (2.4.3).
#include "any_boundary/thesis_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "any_boundary/sphere_samples.h"
#include "base/parallel.h"
#include "base/point_ops.h"

namespace medial_vk::any_boundary {
namespace {

constexpr std::size_t kCellsOfABlock = 64;

/// What is left of a block of cells.
struct Kept {
  std::vector<std::uint64_t> cells;
  std::vector<FoundBall> found;
};

class CellVisit {
 public:
  CellVisit(const SearchFrame& frame, const ThesisOptions& options,
            const std::array<std::vector<Point>, kThesisDepths>& spirals)
      : frame_(frame), options_(options), spirals_(spirals) {}

  void visit(std::span<const std::uint64_t> codes, int depth, Kept& kept) {
    std::vector<Point> centres, nearest(codes.size());
    std::vector<std::uint8_t> inside(codes.size());
    centres.reserve(codes.size());
    for (const std::uint64_t code : codes) centres.push_back(frame_.grid.centre(code, depth));
    frame_.queries.nearest(centres, nearest);
    frame_.queries.contains(centres, inside);
    for (std::size_t i = 0; i < codes.size(); ++i) {
      visit(codes[i], depth, centres[i], length(nearest[i] - centres[i]), inside[i] != 0, kept);
    }
  }

 private:
  void visit(std::uint64_t code, int depth, const Point& centre, double distance, bool is_inside, Kept& kept) {
    const double side = frame_.grid.side(depth);
    if (!is_inside && distance - frame_.queries.error() > kHalfDiagonal * side) return;
    const bool sphere_inside = is_inside && distance >= side;
    if (depth < frame_.grid.voxel_depth()) {
      if (!sphere_inside || sample(centre, side, depth) > 0) kept.cells.push_back(code);
      return;
    }
    if (!sphere_inside && !options_.narrow_features) return;
    const double flux = sample(centre, side, depth);
    if (sphere_inside && !is_preselected(flux)) return;
    kept.cells.push_back(code);
    std::optional<ApproximateBall> ball = search(code, centre);
    if (!ball) return;
    ball->sphere.flux = static_cast<float>(flux);
    kept.found.push_back({code, *ball});
  }

  double sample(const Point& centre, double side, int depth) {
    const int from_last = frame_.grid.voxel_depth() - depth;
    samples_.query(centre, side, spirals_.at(static_cast<std::size_t>(kThesisDepths - 1 - from_last)), frame_.queries);
    return samples_.flux();
  }

  /// Section 2.4.2: 2 sin(theta) pi (sqrt(3) l / 2)^2 / (4 pi l^2) = (3/8) sin(theta).
  bool is_preselected(double flux) const {
    if (flux > 0.375 * std::sin(frame_.salience.object_angle)) return true;
    return frame_.salience.radius > 0 &&
           samples_.greatest_distance() > frame_.salience.radius - 2 * frame_.grid.voxels().voxel_size;
  }

  /// Algorithm 2, on the lines of all samples at once: from each to its opposite (Definition 2.3). Of those that lead
  /// to a salient point in the voxel, the first counts, as in the source.
  std::optional<ApproximateBall> search(std::uint64_t voxel, const Point& centre) {
    lines_.clear();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const Point& p = samples_.point(i);
      const Point spoke = samples_.nearest(i) - p;
      if (!(length(spoke) > 0)) continue;
      const Point direction = (1 / length(spoke)) * spoke;
      lines_.push_back({voxel, p, p - (2 * dot(p - centre, direction)) * direction, samples_.nearest(i), {}});
    }
    retract();
    Salience salience = frame_.salience;
    salience.deep_angle = 0;  // mode thesis has no least angle of deep points
    for (const AimedLine& line : lines_) {
      if (!frame_.grid.holds(voxel, line.begin)) continue;
      Contacts contacts = {line.begin, {}, line.a, line.b};
      // `a` was as near as the answer at `begin` only up to errors.
      frame_.queries.nearest({&contacts.at, 1}, {&contacts.nearest, 1});
      std::optional<ApproximateBall> ball =
          ball_at(contacts, voxel, salience, frame_.queries.error(), std::numeric_limits<double>::max());
      if (ball && is_inside(line.begin)) return ball;
    }
    return std::nullopt;
  }

  bool is_inside(const Point& p) const {
    std::uint8_t answer = 0;
    frame_.queries.contains({&p, 1}, {&answer, 1});
    return answer != 0;
  }

  /// Algorithm 1, RETRACT: lines along which the contact stays the same are dropped, others are bisected to epsilon.
  void retract() {
    query([](const AimedLine& line) { return line.end; });
    std::size_t kept = 0;
    double longest = 0;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (is_contact(lines_[i].a, i)) continue;
      lines_[kept] = lines_[i];
      lines_[kept].b = answers_[i];
      longest = std::max(longest, length(lines_[kept].end - lines_[kept].begin));
      ++kept;
    }
    lines_.resize(kept);
    for (; longest > frame_.epsilon; longest /= 2) {
      query([](const AimedLine& line) { return 0.5 * (line.begin + line.end); });
      for (std::size_t i = 0; i < lines_.size(); ++i) {
        if (is_contact(lines_[i].a, i)) {
          lines_[i].begin = points_[i];
        } else {
          lines_[i].end = points_[i];
          lines_[i].b = answers_[i];
        }
      }
    }
  }

  template <class Where>
  void query(const Where& where) {
    points_.clear();
    points_.reserve(lines_.size());
    for (const AimedLine& line : lines_) points_.push_back(where(line));
    answers_.resize(points_.size());
    frame_.queries.nearest(points_, answers_);
  }

  /// True if `contact` is as near to the point of query i as its answer is, up to errors. (The source compares the
  /// contacts themselves, which requires exact answers.)
  bool is_contact(const Point& contact, std::size_t i) const {
    return length(contact - points_[i]) <= length(answers_[i] - points_[i]) + 4 * frame_.queries.error();
  }

  const SearchFrame& frame_;
  const ThesisOptions& options_;
  const std::array<std::vector<Point>, kThesisDepths>& spirals_;
  SphereSamples samples_;
  std::vector<AimedLine> lines_;
  std::vector<Point> points_, answers_;
};

/// The cells of the first depth, in order.
std::vector<std::uint64_t> first_cells(const CellGrid& grid, int depth) {
  CellIndex count;
  for (std::size_t k = 0; k < 3; ++k) {
    const int above = grid.voxel_depth() - depth;
    count[k] = (grid.voxels().size[k] + (1u << above) - 1) >> above;
  }
  std::vector<std::uint64_t> cells;
  cells.reserve(std::size_t{count[0]} * count[1] * count[2]);
  for (std::uint32_t z = 0; z < count[2]; ++z) {
    for (std::uint32_t y = 0; y < count[1]; ++y) {
      for (std::uint32_t x = 0; x < count[0]; ++x) cells.push_back(morton_code({x, y, z}));
    }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

}  // namespace

SearchResult search_as_published(const SearchFrame& frame, const ThesisOptions& options,
                                 const std::array<std::vector<Point>, kThesisDepths>& spirals, unsigned threads,
                                 LoopWatch& watch) {
  const int last = frame.grid.voxel_depth();
  int depth = std::max(0, last - kThesisDepths + 1);
  SearchResult out;
  std::vector<std::uint64_t> cells = first_cells(frame.grid, depth);
  for (; depth <= last; ++depth) {
    std::vector<Kept> blocks((cells.size() + kCellsOfABlock - 1) / kCellsOfABlock);
    parallel_blocks(cells.size(), kCellsOfABlock, threads, [&](std::size_t begin, std::size_t end) {
      watch.check();
      CellVisit(frame, options, spirals)
          .visit(std::span(cells).subspan(begin, end - begin), depth, blocks[begin / kCellsOfABlock]);
    });
    watch.finish(1, kThesisDepths);
    ExtractionCounters::Level level;
    level.cell_size = frame.grid.share_of_longest_side(depth);
    level.visited = cells.size();
    cells.clear();
    for (const Kept& kept : blocks) {
      level.kept += kept.cells.size();
      level.found += kept.found.size();
      out.found.insert(out.found.end(), kept.found.begin(), kept.found.end());
      if (depth < last) frame.grid.add_parts(kept.cells, depth, cells);
    }
    out.counters.levels.push_back(level);
  }
  out.counters.found = out.found.size();
  return out;
}

}  // namespace medial_vk::any_boundary
