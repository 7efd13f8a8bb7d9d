#include "any_boundary/certified_search.h"

#include <algorithm>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "base/parallel.h"

namespace medial_vk::any_boundary {
namespace {

// Of the first cells: the box has about as many along its longest side.
constexpr int kFirstDepth = 3;
// Of a voxel at one depth: with more, the voxel is left undecided, as their number grows fourfold with each depth.
constexpr std::size_t kCellsOfVoxel = 512;
constexpr std::size_t kVoxelsAtATime = 4096;

/// What is left of an undecided voxel: the first kind that all of its cells have.
class Remains {
 public:
  void add(const OpenCell& cell) {
    is_near_angle_ = is_near_angle_ && cell.is_near_angle;
    is_shallow_ = is_shallow_ && cell.is_shallow;
    width_ = std::max(width_, cell.width);
  }
  UndecidedVoxel voxel(std::uint64_t code) const {
    UndecidedVoxel out;
    out.voxel = cell_of_code(code);
    out.kind = is_near_angle_ ? UndecidedKind::kNearAngle
               : is_shallow_  ? UndecidedKind::kBoundary
                              : UndecidedKind::kOther;
    out.width = static_cast<float>(width_);
    return out;
  }

 private:
  bool is_near_angle_ = true, is_shallow_ = true;
  double width_ = 0;
};

class CertifiedSearch {
 public:
  CertifiedSearch(const SearchFrame& frame, unsigned threads, LoopWatch& watch)
      : frame_(frame), threads_(threads), watch_(watch) {}

  SearchResult run() {
    const CellGrid& grid = frame_.grid;
    int depth = std::min(kFirstDepth, grid.voxel_depth());
    begin(depth);
    for (; depth < grid.voxel_depth(); ++depth) {
      search(depth);
      divide(depth);
    }
    voxels_ = cells_.size();
    search(depth);
    keep_found(depth);
    settle(depth);
    // Voxels are independent: so many at a time need little memory.
    const std::vector<OpenCell> voxels = std::move(open_);
    for (std::size_t first = 0; first < voxels.size(); first += kVoxelsAtATime) {
      const auto begin = voxels.begin() + static_cast<std::ptrdiff_t>(first);
      open_.assign(begin, begin + static_cast<std::ptrdiff_t>(std::min(kVoxelsAtATime, voxels.size() - first)));
      search_parts(depth);
      watch_.finish(std::min(kVoxelsAtATime, voxels.size() - first), voxels.size());
    }
    return result();
  }

 private:
  using Span = std::pair<std::size_t, std::size_t>;

  void begin(int depth) {
    for (std::uint64_t code = 0; code < std::uint64_t{1} << (3 * depth); ++code) {
      if (frame_.grid.reaches(code, depth)) cells_.push_back(code);
    }
  }

  /// Divides the open voxels down to the last depth.
  void search_parts(int depth) {
    for (divide(depth); !cells_.empty(); divide(depth)) {
      search(++depth);
      keep_found(depth);
      settle(depth);
    }
  }

  /// Fills open_ and found_ with what is left of cells_.
  void search(int depth) {
    std::vector<Span> blocks;
    const auto cube = [&](std::size_t i) { return cells_[i] >> (3 * CellBlock::kDepths); };
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (i == 0 || cube(i) != cube(i - 1)) blocks.emplace_back(i, i);
      ++blocks.back().second;
    }
    std::vector<SearchedCells> parts(blocks.size());
    parallel_blocks(blocks.size(), 4, threads_, [&](std::size_t begin, std::size_t end) {
      CellSearch cell_search(frame_);
      for (std::size_t i = begin; i < end; ++i) {
        watch_.check();
        const auto [first, last] = blocks[i];
        cell_search.run(depth, std::span(cells_).subspan(first, last - first), parts[i]);
      }
    });
    open_.clear();
    found_.clear();
    for (const SearchedCells& part : parts) {
      open_.insert(open_.end(), part.open.begin(), part.open.end());
      found_.insert(found_.end(), part.found.begin(), part.found.end());
    }
    ExtractionCounters::Level& level = level_of(depth);
    level.cell_size = frame_.grid.share_of_longest_side(depth);
    level.visited += cells_.size();
    level.kept += open_.size();
  }

  ExtractionCounters::Level& level_of(int depth) {
    const auto index = static_cast<std::size_t>(depth - std::min(kFirstDepth, frame_.grid.voxel_depth()));
    if (out_.counters.levels.size() <= index) out_.counters.levels.resize(index + 1);
    return out_.counters.levels[index];
  }

  /// Of each voxel, the ball with the greatest object angle. Their cells need no more search.
  void keep_found(int depth) {
    const auto rank = [](const FoundBall& ball) {
      return std::tuple(ball.voxel, -ball.ball.sphere.object_angle, ball.ball.sphere.centre);
    };
    std::sort(found_.begin(), found_.end(), [&](const FoundBall& a, const FoundBall& b) { return rank(a) < rank(b); });
    const auto same = [](const FoundBall& a, const FoundBall& b) { return a.voxel == b.voxel; };
    found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
    level_of(depth).found += found_.size();
    std::vector<OpenCell> left;
    auto ball = found_.begin();
    for (const OpenCell& cell : open_) {
      const std::uint64_t voxel = frame_.grid.voxel_of(cell.code, depth);
      while (ball != found_.end() && ball->voxel < voxel) ++ball;
      if (ball == found_.end() || ball->voxel != voxel) left.push_back(cell);
    }
    open_.swap(left);
    for (const FoundBall& found : found_) remains_.erase(found.voxel);
    out_.found.insert(out_.found.end(), found_.begin(), found_.end());
  }

  /// Cells are given up, and their voxels undecided: shallow ones, those of the last depth, and those of voxels with
  /// too many.
  void settle(int depth) {
    std::vector<OpenCell> left;
    for (auto first = open_.begin(); first != open_.end();) {
      const std::uint64_t voxel = frame_.grid.voxel_of(first->code, depth);
      const auto last = std::find_if(
          first, open_.end(), [&](const OpenCell& cell) { return frame_.grid.voxel_of(cell.code, depth) != voxel; });
      const bool is_last =
          depth == frame_.grid.last_depth() || last - first > static_cast<std::ptrdiff_t>(kCellsOfVoxel);
      for (; first != last; ++first) {
        if (is_last || first->is_shallow) {
          remains_[voxel].add(*first);
        } else {
          left.push_back(*first);
        }
      }
    }
    open_.swap(left);
  }

  void divide(int depth) {
    std::vector<std::uint64_t> codes;
    codes.reserve(open_.size());
    for (const OpenCell& cell : open_) codes.push_back(cell.code);
    cells_.clear();
    frame_.grid.add_parts(codes, depth, cells_);
  }

  SearchResult result() {
    std::sort(out_.found.begin(), out_.found.end(),
              [](const FoundBall& a, const FoundBall& b) { return a.voxel < b.voxel; });
    for (const auto& [voxel, remains] : remains_) out_.undecided.push_back(remains.voxel(voxel));
    out_.counters.found = out_.found.size();
    out_.counters.undecided = out_.undecided.size();
    out_.counters.proved_empty = voxels_ - out_.found.size() - out_.undecided.size();
    return std::move(out_);
  }

  const SearchFrame& frame_;
  unsigned threads_;
  LoopWatch& watch_;
  std::vector<std::uint64_t> cells_;  // of a depth, in order
  std::vector<OpenCell> open_;
  std::vector<FoundBall> found_;
  std::map<std::uint64_t, Remains> remains_;  // by voxel
  std::uint64_t voxels_ = 0;                  // visited
  SearchResult out_;
};

}  // namespace

SearchResult search_certified(const SearchFrame& frame, unsigned threads, LoopWatch& watch) {
  return CertifiedSearch(frame, threads, watch).run();
}

}  // namespace medial_vk::any_boundary
