#include "hull_fits/search/hull_family.h"

#include <algorithm>
#include <queue>

namespace medial_vk {
namespace {

/// The top at which a second search contends with the first.
constexpr std::size_t kContended = 16;

/// The hulls by the volume that each adds to those before it, and the volumes of the first 1, 2 ... of them. A gain
/// never grows while others are added, so that few are computed anew for each choice.
std::vector<BallHull> ordered_by_gain(std::span<const BallHull> hulls, CoverageLines& lines,
                                      std::vector<double>& covered) {
  struct Entry {
    double gain;
    std::size_t hull, round;
    bool operator<(const Entry& other) const { return gain != other.gain ? gain < other.gain : hull > other.hull; }
  };
  std::priority_queue<Entry> queue;
  for (std::size_t i = 0; i < hulls.size(); ++i) queue.push({lines.gain(hulls[i], CoverageLines::kNone), i, 0});
  std::vector<BallHull> ordered;
  double sum = 0;
  while (!queue.empty()) {
    Entry best = queue.top();
    queue.pop();
    if (best.round == ordered.size()) {
      sum += best.gain;
      lines.add(hulls[best.hull]);
      ordered.push_back(hulls[best.hull]);
      covered.push_back(sum);
    } else {
      queue.push({lines.gain(hulls[best.hull], CoverageLines::kNone), best.hull, ordered.size()});
    }
  }
  return ordered;
}

}  // namespace

HullFamily::HullFamily(const Solid& solid, std::span<const Ball> medial, const SoughtHulls& shape,
                       const HullSearchEffort& effort, const Threads& threads)
    : solid_(solid),
      medial_(medial),
      shape_(shape),
      effort_(effort),
      threads_(threads),
      search_(std::make_unique<HullSearch>(solid, medial, shape, effort, threads)) {}

/// Powers of two, from 16 on with those half-way.
std::size_t HullFamily::top_for(std::size_t count) {
  std::size_t top = 1;
  while (top < count) top *= 2;
  return top > 16 && count <= top / 4 * 3 ? top / 4 * 3 : top;
}

/// The hulls as they are before the top's improvement, and what the first 1, 2 ... of them cover.
void HullFamily::note_growth(Top& top) const {
  CoverageLines grown(solid_.mesh().report.lower, solid_.mesh().report.upper, effort_.lines);
  double sum = 0;
  for (std::size_t i = 0; i < search_->lines().size(); ++i) {
    const BallHull& hull = search_->lines().hull(i);
    sum += grown.gain(hull, CoverageLines::kNone);
    grown.add(hull);
    top.before.push_back(hull);
    top.covered_before.push_back(sum);
  }
}

void HullFamily::improve(HullSearch& search) const {
  for (std::size_t round = 0; round < effort_.rounds; ++round) search.improve();
}

/// Takes a search that was not improved with fewer hulls, if it covers more with `count`.
void HullFamily::contend(std::size_t count) {
  auto other = std::make_unique<HullSearch>(solid_, medial_, shape_, effort_, threads_);
  while (other->lines().size() < count && other->grow()) {
  }
  improve(*other);
  if (other->lines().covered() > search_->lines().covered()) search_ = std::move(other);
}

void HullFamily::search_up_to(std::size_t count, const std::function<void(double)>& progress) {
  const auto report = [&](std::size_t improved) {
    const auto done = static_cast<double>(search_->lines().size() + improved);
    if (progress) progress(std::min(1.0, done / static_cast<double>(2 * top_for(count))));
  };
  while (!has_ended_ && (tops_.empty() || tops_.back().count < count)) {
    Top top;
    top.count = top_for(tops_.empty() ? 1 : tops_.back().count + 1);
    const std::size_t improved = tops_.empty() ? 0 : tops_.back().count;
    while (search_->lines().size() < top.count && search_->grow()) report(improved);
    has_ended_ = search_->lines().size() < top.count;
    note_growth(top);
    improve(*search_);
    if (top.count == kContended) contend(top.count);
    report(top.count);
    std::vector<BallHull> hulls;
    for (std::size_t i = 0; i < search_->lines().size(); ++i) hulls.push_back(search_->lines().hull(i));
    CoverageLines lines(solid_.mesh().report.lower, solid_.mesh().report.upper, effort_.lines);
    top.ordered = ordered_by_gain(hulls, lines, top.covered);
    tops_.push_back(std::move(top));
  }
}

std::vector<BallHull> HullFamily::set_of(std::size_t count, const std::function<void(double)>& progress) {
  search_up_to(count, progress);
  const auto at_least = [&](const Top& top) { return top.count >= count; };
  const auto found = std::find_if(tops_.begin(), tops_.end(), at_least);
  const Top& top = found == tops_.end() ? tops_.back() : *found;
  const std::size_t size = std::min(count, top.ordered.size());
  if (size == 0) return {};
  const bool grown = size <= top.before.size() && top.covered_before[size - 1] > top.covered[size - 1];
  const std::vector<BallHull>& set = grown ? top.before : top.ordered;
  return {set.begin(), set.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace medial_vk
