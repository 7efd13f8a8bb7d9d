#include "sphere_fits/cover/cover_family.h"

#include <algorithm>
#include <deque>
#include <mutex>
#include <utility>

#include "medial_vk/ball_union.h"
#include "sphere_fits/quality/branch_and_bound.h"

namespace medial_vk {

CoverFamily::Answer CoverFamily::certify(const std::vector<Ball>& balls) const {
  const Result<BallUnion> measured = measure_ball_union(balls, {1, false});
  if (!measured) throw std::bad_alloc();
  return {balls, measured.value().volume};
}

/// A proof may enlarge a cover, and then one of fewer balls may be smaller: such covers are examined as long as that is
/// possible. Before its proof, no remaining cover of fewer balls has less volume. Where all are left out, as for a
/// solid that is nearly a ball, the smallest ball around it is the answer.
CoverFamily::Answer CoverFamily::best_below(std::size_t top, std::size_t count, const Cover::Report& report,
                                            std::optional<Cover>& found) const {
  if (top == 1) return certify({ball_around(solid_)});
  Cover cover = search_cover(solid_, starts_.at(top), 1, report);
  found.emplace(cover);
  Answer best;
  for (double last = cover.volume();; cover.shrink()) {
    const bool is_left_out = cover.volume() < last;
    if (!is_left_out) last = cover.volume();
    if (!is_left_out && cover.count() <= count) {
      if (!best.balls.empty() && last >= best.volume) return best;
      Answer next = certify(cover.certified());
      if (best.balls.empty() || next.volume < best.volume) best = std::move(next);
    }
    if (cover.count() <= 2) break;
  }
  return best.balls.empty() ? certify({ball_around(solid_)}) : best;
}

/// `shown`: this search reports the progress of all.
Cover::Report CoverFamily::report(bool shown) {
  return [this, shown](double done) {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    if (shown) shown_ = std::max(shown_, done);
    if (!progress_("cover", shown_)) throw Stopped();
  };
}

CoverFamily::Answer CoverFamily::of(std::size_t count) {
  // The most work first, each on one thread.
  struct Job {
    std::size_t top, count;
  };
  std::vector<Job> jobs;
  const std::size_t greatest = starts_.rbegin()->first;
  for (const auto& [top, start] : starts_) {
    if (top < count && tops_.count(top) == 0) jobs.insert(jobs.begin(), {top, top});
  }
  const std::size_t last = std::min(greatest, cover_top(count));
  if (last > count || (last == count && tops_.count(last) == 0)) jobs.insert(jobs.begin(), {last, count});
  std::vector<Answer> answers(jobs.size());
  std::vector<std::optional<Cover>> found(jobs.size());
  shown_ = 0;
  for_all(jobs.size(), 1, threads_,
          [&](std::size_t k) { answers[k] = best_below(jobs[k].top, jobs[k].count, report(k == 0), found[k]); });
  if (!jobs.empty()) {
    found_.clear();
    if (found.front()) found_.emplace(jobs.front().top, *found.front());
  }
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (jobs[k].count >= jobs[k].top) tops_[jobs[k].top] = answers[k];
  }
  const Answer* best = answers.empty() ? nullptr : &answers.front();
  for (const auto& [top, answer] : tops_) {
    if (top <= count && (best == nullptr || answer.volume < best->volume)) best = &answer;
  }
  return *best;
}

/// Removes balls while the volume permits it. If the proof adds too much, tries covers of more balls.
std::vector<Ball> CoverFamily::few(std::size_t count, double volume) {
  constexpr std::size_t kKept = 8;
  Answer most = of(count);
  if (most.volume > volume) return {};
  const std::size_t top = cover_top(count);
  if (top == 1) return most.balls;
  const std::size_t start = std::min(top, starts_.rbegin()->first);
  const auto found = found_.find(start);
  Cover cover = found != found_.end() ? found->second : search_cover(solid_, starts_.at(start), 1, report(true));
  std::deque<Cover> kept;
  for (double last = cover.volume(); cover.volume() <= volume; cover.shrink()) {
    const bool is_left_out = cover.volume() < last;
    if (!is_left_out) last = cover.volume();
    if (!is_left_out && cover.count() < most.balls.size()) kept.push_back(cover);
    if (kept.size() > kKept) kept.pop_front();
    if (cover.count() <= 2) break;
  }
  for (; !kept.empty(); kept.pop_back()) {
    Answer fewer = certify(kept.back().certified());
    if (fewer.volume <= volume) return std::move(fewer.balls);
  }
  return std::move(most.balls);
}

}  // namespace medial_vk
