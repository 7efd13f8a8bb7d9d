// Fits with windows of several widths, of which the best is chosen by tip.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "curvature/exposed_spokes.h"
#include "curvature/sheet_fit.h"
#include "curvature/tip_fit.h"
#include "curvature/width_choice.h"
#include "medial_vk/progress.h"

namespace medial_vk {

/// The radii of the windows on the boundary, in spacings, each about sqrt(2) of the one before.
inline constexpr std::array<double, 6> kWindows = {5.0, 7.0, 10.0, 14.0, 20.0, 28.0};
/// The radius of the window on the sheet that gives the spokes, as a share of the one on the boundary.
inline constexpr double kSheetShare = 0.65;

/// Points closer than this share of a window's radius to another one are left out of it: some 200 remain.
inline constexpr double kThinning = 1.0 / 9;

/// What one width gives.
struct LadderStep {
  TipCloud cloud;                      ///< The tips that are known.
  std::vector<std::uint32_t> numbers;  ///< Of those: twice the ball's, and one more for its second tip; ascending.
  std::vector<std::uint8_t> is_kept;   ///< By place in the cloud: that the windows on the boundary hold it. Exposed
                                       ///< regions tell where a tip is, but not well enough to take part in fits.
  std::vector<std::uint8_t> is_cut;    ///< By ball: that the window on its sheet is cut.
  std::vector<TipFit> fits;            ///< By number of the tip.
};

class FitLadder {
 public:
  FitLadder(const SheetLinks& links, unsigned threads, const StageProgress& progress, const std::stop_token& stop);

  const LadderStep& step(std::size_t i) const { return steps_[i]; }

  /// The width chosen for a tip, and how much its results differ from those of the next ones: upper quartiles over the
  /// tips around.
  const WidthChoice& choice(std::size_t tip) const { return choices_[tip]; }

  /// Of a ball that no width gives spokes along its sheet, and that exposed regions give one or two spokes; otherwise
  /// null.
  const ExposedSpokes* exposed(std::uint32_t ball) const {
    return exposed_of_[ball] == kNone ? nullptr : &exposed_[exposed_of_[ball]];
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// By width and number of the tip: whether it is in the cloud.
  using Uses = std::array<std::vector<std::uint8_t>, kWindows.size()>;

  void fit_sheets(const SheetLinks& links, unsigned threads, Uses& used);
  void add_exposed(const SheetLinks& links, unsigned threads, Uses& used);
  void fit_tips(std::size_t step, double radius, unsigned threads);
  void choose(double spacing, unsigned threads);
  std::vector<WidthDifference> usual_of(const LadderStep& step, std::span<const WidthDifference> squares, double reach,
                                        unsigned threads) const;

  std::array<LadderStep, kWindows.size()> steps_;
  std::vector<WidthChoice> choices_;
  std::vector<std::uint32_t> exposed_of_;  // by ball: its place, or kNone
  std::vector<ExposedSpokes> exposed_;
  std::stop_token stop_;
};

}  // namespace medial_vk
