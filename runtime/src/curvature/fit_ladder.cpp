#include "curvature/fit_ladder.h"

#include "base/parallel.h"
#include "curvature/patch_blend.h"

namespace medial_vk {
namespace {

constexpr std::size_t kSteps = kWindows.size();
constexpr double kSameSide = 0.7;     // of spokes of tips that are compared
constexpr double kLeastReach = 10.0;  // spacings from a tip to others whose windows tell what is usual

double angle_of(const Point& a, const Point& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

/// Squares.
std::vector<WidthDifference> differences_of(const LadderStep& wide, const LadderStep& narrow) {
  std::vector<WidthDifference> out(wide.fits.size(), WidthDifference{std::nan(""), std::nan("")});
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!wide.fits[i].is_known || !narrow.fits[i].is_known) continue;
    const double angle = angle_of(wide.fits[i].normal, narrow.fits[i].normal);
    out[i] = {(wide.fits[i].form - narrow.fits[i].form).squaredNorm(), angle * angle};
  }
  return out;
}

double upper_quartile(std::vector<double>& values) {
  const auto quartile = values.begin() + static_cast<std::ptrdiff_t>(3 * values.size() / 4);
  std::nth_element(values.begin(), quartile, values.end());
  return *quartile;
}

/// Leaves the tips that are known, without gaps: all others lie in one place.
void compact(const std::vector<std::uint8_t>& is_used, LadderStep& step) {
  TipCloud& cloud = step.cloud;
  const auto known = static_cast<std::size_t>(std::ranges::count(is_used, std::uint8_t{1}));
  step.numbers.reserve(known);
  for (std::uint32_t i = 0; i < is_used.size(); ++i) {
    if (is_used[i] == 0) continue;
    const std::size_t place = step.numbers.size();
    cloud.tips[place] = cloud.tips[i];
    cloud.normals[place] = cloud.normals[i];
    step.numbers.push_back(i);
  }
  cloud.tips.resize(known);
  cloud.normals.resize(known);
}

TipCloud part_of(const TipCloud& cloud, std::span<const std::uint32_t> numbers) {
  TipCloud out;
  out.tips.reserve(numbers.size());
  out.normals.reserve(numbers.size());
  for (const std::uint32_t i : numbers) {
    out.tips.push_back(cloud.tips[i]);
    out.normals.push_back(cloud.normals[i]);
  }
  return out;
}

}  // namespace

FitLadder::FitLadder(const SheetLinks& links, unsigned threads, const StageProgress& progress,
                     const std::stop_token& stop)
    : stop_(stop) {
  const auto report = [&](const char* stage, double done) {
    if (progress) progress(stage, done);
  };
  report("sheets", 0);
  Uses used;
  fit_sheets(links, threads, used);
  report("regions", 0);
  add_exposed(links, threads, used);
  for (std::size_t k = 0; k < kSteps; ++k) compact(used[k], steps_[k]);
  for (std::size_t i = 0; i < kSteps; ++i) {
    report("tips", static_cast<double>(i) / kSteps);
    if (stop.stop_requested()) return;
    fit_tips(i, kWindows[i] * links.spacing(), threads);
  }
  report("windows", 0);
  choose(links.spacing(), threads);
  report("windows", 1);
}

void FitLadder::fit_sheets(const SheetLinks& links, unsigned threads, Uses& used) {
  const std::size_t count = links.balls().size();
  for (LadderStep& step : steps_) {
    step.cloud = {std::vector<Point>(2 * count), std::vector<Point>(2 * count)};
    step.is_cut.resize(count);
  }
  std::array<std::vector<std::uint8_t>, kSteps> kept;
  for (std::size_t k = 0; k < kSteps; ++k) {
    used[k].resize(2 * count);
    kept[k].assign(count, 1);
    thin_out(links.centres(), links.grid(), kThinning * kSheetShare * kWindows[k] * links.spacing(), kept[k]);
  }
  parallel_blocks(count, 512, threads, [&](std::size_t begin, std::size_t end) {
    SheetWindow window(links);
    for (std::size_t i = begin; i < end && !stop_.stop_requested(); ++i) {
      const auto ball = static_cast<std::uint32_t>(i);
      if (links.shape(ball).state != CurvatureState::kKnown) continue;
      const double unit = kSheetShare * links.spacing();
      const auto& members = window.collect(ball, kWindows.back() * unit);
      for (std::size_t k = 0; k < kSteps; ++k) {
        const SheetFit fit = fit_sheet(links, ball, members, kWindows[k] * unit, kept[k]);
        if (!fit.is_known) continue;
        steps_[k].is_cut[i] = fit.is_cut ? 1 : 0;
        for (std::size_t side = 0; side < 2; ++side) {
          steps_[k].cloud.tips[2 * i + side] = fit.tips[side];
          steps_[k].cloud.normals[2 * i + side] = fit.spokes[side];
          used[k][2 * i + side] = 1;
        }
      }
    }
  });
}

/// Where the gradient of the radius along the sheet is not known, at seams and where neighbours are few, the exposed
/// regions of the ball tell the places of its tips.
void FitLadder::add_exposed(const SheetLinks& links, unsigned threads, Uses& used) {
  const auto count = static_cast<std::uint32_t>(links.balls().size());
  std::vector<std::uint32_t> numbers;
  numbers.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const CurvatureState state = links.shape(i).state;
    const auto is_used = [i](const std::vector<std::uint8_t>& of_width) { return of_width[2 * std::size_t{i}] != 0; };
    const bool has_no_fit = state == CurvatureState::kKnown && std::ranges::none_of(used, is_used);
    if (state == CurvatureState::kSeam || state == CurvatureState::kFew || has_no_fit) numbers.push_back(i);
  }
  exposed_ = exposed_spokes(links, numbers, threads, stop_);
  exposed_of_.assign(count, kNone);
  for (std::uint32_t place = 0; place < numbers.size(); ++place) {
    if (exposed_[place].count == 0) continue;
    const std::uint32_t ball = numbers[place];
    exposed_of_[ball] = place;
    const auto& [centre, radius] = links.balls()[ball];
    for (std::size_t side = 0; side < exposed_[place].count; ++side) {
      const std::size_t tip = 2 * std::size_t{ball} + side;
      const Point& spoke = exposed_[place].spokes[side];
      for (std::size_t k = 0; k < kSteps; ++k) {
        steps_[k].cloud.tips[tip] = centre + radius * spoke;
        steps_[k].cloud.normals[tip] = spoke;
        used[k][tip] = 1;
      }
    }
  }
}

void FitLadder::fit_tips(std::size_t step, double radius, unsigned threads) {
  LadderStep& at = steps_[step];
  at.fits.resize(2 * at.is_cut.size());
  const double apart = kAnchorShare * radius;
  std::vector<std::uint32_t> kept, anchors;
  {
    const PointGrid grid(at.cloud.tips, apart);
    at.is_kept.resize(at.numbers.size());
    const auto is_of_sheet = [&](std::uint32_t tip) -> std::uint8_t { return exposed_of_[tip / 2] == kNone ? 1 : 0; };
    std::ranges::transform(at.numbers, at.is_kept.begin(), is_of_sheet);
    thin_out(at.cloud.tips, grid, kThinning * radius, at.is_kept);
    anchors = anchors_of(at.cloud, grid, apart);
  }
  kept.reserve(at.numbers.size());
  for (std::uint32_t i = 0; i < at.is_kept.size(); ++i) {
    if (at.is_kept[i] != 0) kept.push_back(i);
  }
  const TipCloud members = part_of(at.cloud, kept), middles = part_of(at.cloud, anchors);
  const PointGrid around(members.tips, radius / 3);
  const auto patch_at = [&](std::uint32_t i) { return fit_patch(at.cloud, i, members, around, radius, step > 1); };
  std::vector<TipPatch> patches(anchors.size());
  parallel_for(anchors.size(), 16, threads, [&](std::size_t i) {
    if (!stop_.stop_requested()) patches[i] = patch_at(anchors[i]);
  });
  const double reach = kBlendShare * radius;
  const PointGrid grid(middles.tips, reach);
  parallel_for(at.numbers.size(), 64, threads, [&](std::size_t i) {
    if (stop_.stop_requested()) return;
    const Point& tip = at.cloud.tips[i];
    TipFit& fit = at.fits[at.numbers[i]];
    fit = blend_patches(patches, middles, grid, tip, at.cloud.normals[i], reach);
    if (fit.is_known) return;
    const TipPatch own = patch_at(static_cast<std::uint32_t>(i));
    if (!own.is_known) return;
    own.add_at(tip, 1, fit);
    fit.is_cut = own.is_cut;
    fit = mean_of(fit, 1);
  });
}

void FitLadder::choose(double spacing, unsigned threads) {
  const std::size_t count = steps_[0].fits.size();
  std::array<std::vector<WidthDifference>, kSteps> differences;
  for (std::size_t k = 1; k < kSteps; ++k) {
    const double reach = std::max(kWindows[k] / 2, kLeastReach) * spacing;
    differences[k] = usual_of(steps_[k], differences_of(steps_[k], steps_[k - 1]), reach, threads);
  }
  choices_.resize(count);
  parallel_for(count, 1024, threads, [&](std::size_t i) {
    std::array<WidthDifference, kSteps> of_tip = {};
    for (std::size_t k = 1; k < kSteps; ++k) of_tip[k] = differences[k][i];
    choices_[i] = choose_width(of_tip);
  });
}

/// The upper quartile over the tips around, in the place of the value of one: within a facet, narrow windows agree, and
/// those across its edges do not.
std::vector<WidthDifference> FitLadder::usual_of(const LadderStep& step, std::span<const WidthDifference> squares,
                                                 double reach, unsigned threads) const {
  std::vector<std::uint32_t> witnesses;  // places in the cloud
  witnesses.reserve(step.numbers.size());
  for (std::uint32_t place = 0; place < step.numbers.size(); ++place) {
    if (step.is_kept[place] != 0 && !std::isnan(squares[step.numbers[place]].form)) witnesses.push_back(place);
  }
  const TipCloud around = part_of(step.cloud, witnesses);
  const PointGrid grid(around.tips, reach / 2);
  std::vector<WidthDifference> usual(squares.size(), WidthDifference{std::nan(""), std::nan("")});
  parallel_blocks(step.numbers.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<double> forms, angles;
    for (std::size_t place = begin; place < end && !stop_.stop_requested(); ++place) {
      const std::uint32_t i = step.numbers[place];
      const WidthDifference& own = squares[i];
      if (std::isnan(own.form)) continue;
      forms.clear();
      angles.clear();
      grid.visit_within(step.cloud.tips[place], reach, [&](std::uint32_t other, double) {
        if (dot(around.normals[other], step.cloud.normals[place]) < kSameSide) return;
        const WidthDifference& there = squares[step.numbers[witnesses[other]]];
        forms.push_back(there.form);
        angles.push_back(there.angle);
      });
      if (forms.empty()) continue;
      // A tip that differs by more than twice what is usual around it is a stray.
      usual[i] = {std::sqrt(std::max(upper_quartile(forms), own.form / 4)),
                  std::sqrt(std::max(upper_quartile(angles), own.angle / 4))};
    }
  });
  return usual;
}

}  // namespace medial_vk
