#include "sphere_fits/cover/cover_search.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sphere_fits/cover/cover_column.h"
#include "sphere_fits/cover/smallest_ball.h"
#include "sphere_fits/measures/nearest_ball_tree.h"

namespace medial_vk {

CoverSearch::CoverSearch(CoverPieces pieces, std::vector<Ball> balls, double ease, Threads threads)
    : pieces_(std::move(pieces)), balls_(std::move(balls)), ease_(ease), threads_(std::move(threads)) {
  const NearestBallTree tree(balls_);
  std::vector<std::uint32_t> owner(pieces_.size());
  for_all(pieces_.size(), 64, threads_, [&](std::size_t piece) {
    owner[piece] = tree.nearest(pieces_.middle(static_cast<std::uint32_t>(piece))).ball;
  });
  for (std::uint32_t piece = 0; piece < owner.size(); ++piece) {
    Ball& ball = balls_[owner[piece]];
    ball.radius = std::max(ball.radius, pieces_.needed(ball.centre, piece) * kCoverRoom);
  }
  recount();
}

double CoverSearch::cost_of(std::uint32_t piece, double height) const { return pieces_.area(piece) * column(height); }

/// Of a column over a unit of area.
double CoverSearch::column(double height) const {
  const double spread = height / ease_;
  return height * (1 + spread + spread * spread / 3);
}

double CoverSearch::highest(std::uint32_t piece, std::uint32_t but) const {
  const Highest& two = highest_[piece];
  return two[0].ball == but ? two[1].height : two[0].height;
}

void CoverSearch::rank(const Holder& holder, Highest& two) {
  if (holder.height > two[0].height) {
    two = {holder, two[0]};
  } else if (holder.height > two[1].height) {
    two[1] = holder;
  }
}

void CoverSearch::add_holder(std::uint32_t piece, const Holder& holder) {
  holders_[piece].push_back(holder);
  rank(holder, highest_[piece]);
}

/// Its height.
double CoverSearch::remove_holder(std::uint32_t piece, std::uint32_t ball) {
  std::vector<Holder>& holders = holders_[piece];
  const auto at = std::find_if(holders.begin(), holders.end(), [ball](const Holder& h) { return h.ball == ball; });
  const double height = at->height;
  *at = holders.back();
  holders.pop_back();
  Highest& two = highest_[piece];
  if (two[0].ball != ball && two[1].ball != ball) return height;
  two = {};
  for (const Holder& holder : holders) rank(holder, two);
  return height;
}

void CoverSearch::recount() {
  touched_.assign(balls_.size(), {});
  holders_.assign(pieces_.size(), {});
  highest_.assign(pieces_.size(), {});
  total_ = 0;
  std::vector<Ball> balls(balls_.size());
  balls.swap(balls_);
  for (std::uint32_t i = 0; i < balls.size(); ++i) balls_[i] = {balls[i].centre, 0};
  for (std::uint32_t i = 0; i < balls.size(); ++i) replace(i, balls[i]);
}

void CoverSearch::replace(std::uint32_t i, const Ball& ball) {
  for (const std::uint32_t piece : touched_[i]) {
    const double height = remove_holder(piece, i), rest = highest(piece, i);
    if (height > rest) total_ += cost_of(piece, rest) - cost_of(piece, height);
  }
  balls_[i] = ball;
  touched_[i].clear();
  if (ball.radius == 0) return;
  pieces_.gather(ball, touched_[i]);
  for (const std::uint32_t piece : touched_[i]) {
    const double height = pieces_.area(piece) > 0 ? height_over(ball, pieces_.middle(piece), pieces_.normal(piece)) : 0;
    const double rest = highest(piece, i);
    if (height > rest) total_ += cost_of(piece, height) - cost_of(piece, rest);
    add_holder(piece, {i, pieces_.needed(ball.centre, piece) <= ball.radius, height});
  }
}

void CoverSearch::undo(const std::vector<Saved>& saved) {
  for (std::size_t n = saved.size(); n-- > 0;) replace(saved[n].ball, saved[n].before);
}

std::vector<std::uint32_t> CoverSearch::exclusive(std::uint32_t i) const {
  std::vector<std::uint32_t> alone;
  for (const std::uint32_t piece : touched_[i]) {
    bool is_held = false, by_other = false;
    for (const Holder& holder : holders_[piece]) (holder.ball == i ? is_held : by_other) |= holder.holds;
    if (is_held && !by_other) alone.push_back(piece);
  }
  return alone;
}

double CoverSearch::needed(const Point& centre, const std::vector<std::uint32_t>& some) const {
  double radius = 0;
  for (const std::uint32_t piece : some) radius = std::max(radius, pieces_.needed(centre, piece));
  return radius * kCoverRoom;
}

Ball CoverSearch::around(const std::vector<std::uint32_t>& some) const {
  std::vector<Point> points;
  for (const std::uint32_t piece : some) {
    points.insert(points.end(), pieces_.points(piece).begin(), pieces_.points(piece).end());
  }
  Ball ball = smallest_ball(points);
  ball.radius *= kCoverRoom;
  return ball;
}

double CoverSearch::share(std::uint32_t i) const {
  double sum = 0;
  for (const std::uint32_t piece : touched_[i]) {
    const double rest = highest(piece, i);
    for (const Holder& holder : holders_[piece]) {
      if (holder.ball == i && holder.height > rest) sum += cost_of(piece, holder.height) - cost_of(piece, rest);
    }
  }
  return sum;
}

bool CoverSearch::costs_more(std::uint32_t i, double radius, double most) const {
  const Ball ball = {balls_[i].centre, radius};
  double sum = 0;
  for (const std::uint32_t piece : touched_[i]) {
    if (!(pieces_.area(piece) > 0)) continue;
    const double height = height_over(ball, pieces_.middle(piece), pieces_.normal(piece));
    const double paid = highest_[piece][0].height;
    if (height > paid) sum += cost_of(piece, height) - cost_of(piece, paid);
    if (sum > most) return true;
  }
  return false;
}

void CoverSearch::refine() {
  constexpr double kSmall = 0.05;  // of the ball's radius: the protrusion of such a piece is negligible
  std::vector<bool> which(pieces_.size());
  for (std::uint32_t i = 0; i < balls_.size(); ++i) {
    for (const std::uint32_t piece : exclusive(i)) {
      const bool holds_up = pieces_.needed(balls_[i].centre, piece) > 0.98 * balls_[i].radius;
      if (holds_up && pieces_.needed(pieces_.middle(piece), piece) > kSmall * balls_[i].radius) which[piece] = true;
    }
  }
  pieces_.refine(which);
  recount();
}

void CoverSearch::restore(std::vector<Ball> balls) {
  balls_ = std::move(balls);
  recount();
}

void CoverSearch::add(std::span<const Point> points) {
  for (const Point& p : points) {
    pieces_.add({&p, 1});
    Ball* taker = &balls_.front();
    double least = std::numeric_limits<double>::infinity();
    for (Ball& ball : balls_) {
      const double growth = std::max(0.0, length(p - ball.centre) - ball.radius);
      if (ball.radius > 0 && growth < least) least = growth, taker = &ball;
    }
    taker->radius = std::max(taker->radius, length(p - taker->centre) * kCoverRoom);
  }
  recount();
}

}  // namespace medial_vk
