#include "hull_fits/search/hull_family.h"

#include <algorithm>
#include <queue>

namespace medial_vk {
namespace {

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

HullFamily::HullFamily(const Solid& solid, std::span<const Ball> medial, const HullShape& shape,
                       const HullSearchEffort& effort, const Threads& threads)
    : search_(solid, medial, shape, effort, threads),
      lower_(solid.mesh().report.lower),
      upper_(solid.mesh().report.upper),
      effort_(effort) {}

/// Powers of two, from 16 on with those half-way.
std::size_t HullFamily::top_for(std::size_t count) {
  std::size_t top = 1;
  while (top < count) top *= 2;
  return top > 16 && count <= top / 4 * 3 ? top / 4 * 3 : top;
}

void HullFamily::search_up_to(std::size_t count, const std::function<void(double)>& progress) {
  while (!has_ended_ && (tops_.empty() || tops_.back().count < count)) {
    const std::size_t next = top_for(tops_.empty() ? 1 : tops_.back().count + 1);
    const auto report = [&](double share) {
      const double from = static_cast<double>(search_.lines().size());
      if (progress) progress(std::min(1.0, (from + share) / static_cast<double>(2 * top_for(count))));
    };
    while (search_.lines().size() < next && search_.grow()) report(0);
    has_ended_ = search_.lines().size() < next;
    Top top;
    top.count = next;
    CoverageLines grown(lower_, upper_, effort_.lines);
    double sum = 0;
    for (std::size_t i = 0; i < search_.lines().size(); ++i) {
      const BallHull& hull = search_.lines().hull(i);
      sum += grown.gain(hull, CoverageLines::kNone);
      grown.add(hull);
      top.before.push_back(hull);
      top.covered_before.push_back(sum);
    }
    for (std::size_t round = 0; round < effort_.rounds; ++round) {
      search_.improve();
      report(static_cast<double>((round + 1) * next) / static_cast<double>(effort_.rounds));
    }
    std::vector<BallHull> improved;
    for (std::size_t i = 0; i < search_.lines().size(); ++i) improved.push_back(search_.lines().hull(i));
    CoverageLines lines(lower_, upper_, effort_.lines);
    top.ordered = ordered_by_gain(improved, lines, top.covered);
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
  const bool grown = top.covered_before[size - 1] > top.covered[size - 1];
  const std::vector<BallHull>& set = grown ? top.before : top.ordered;
  return {set.begin(), set.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace medial_vk
