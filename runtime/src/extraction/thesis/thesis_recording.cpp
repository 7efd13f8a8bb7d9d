// The dispatches of the published method in their order; thesis_pipeline.h has the overview.
#include <cmath>

#include "extraction/thesis/thesis_pipeline.h"

namespace medial_vk {

using namespace gpu;

std::uint32_t ThesisPipeline::part_count() const {
  return levels_ + (samples(levels_ - 1) + kRetractionsPerRound - 1) / kRetractionsPerRound;
}

Status ThesisPipeline::record_part(Recorder& r, std::uint32_t part, std::uint32_t first, std::uint32_t count) {
  if (part == 0) {
    next_argument_ = 0;
    r.fill(counters_, 0, kCounterCount * 4, 0);
    r.barrier();
    r.fill(counters_, kThesisParents * 4, 4, count);
    r.barrier();
    queries_->clear_tests(r);
    packets_->clear_tests(r);
  }
  if (part < levels_) {
    record_level(r, part, first);
  } else {
    r.begin_stage("retraction");
    if (part == levels_) copy_counter(r, kThesisKept, kThesisActive);
    record_round(r, (part - levels_) * kRetractionsPerRound);
  }
  if (part + 1 == part_count()) record_result(r);
  return r.status();
}

void ThesisPipeline::record_level(Recorder& r, std::uint32_t level, std::uint32_t first_cell) {
  const ThesisConstants step = level_constants(level, first_cell);
  const Items cells{kThesisParents, level == 0 ? 1u : 8u};
  r.begin_stage("cells");
  run(r, "list_cells", cells, step, {kept_.range(), cells_.range(), queries_at_.range()});
  const QueryCount count = query_count(cells, cells_of(level));
  queries_->closest(r, count, queries_at_.range(), nearest_.range(), hits_.range());
  run(r, "list_side_queries", cells, step, {cells_.range(), nearest_.range(), queries_at_.range()});
  // A closed boundary has integer winding numbers: an error below 1/2 suffices.
  queries_->winding(r, count, queries_at_.range(), numbers_.range(), mesh_->closed ? 0.25f : 0.02f);
  run(r, "choose_spheres", cells, step, {cells_.range(), numbers_.range(), states_.range()});
  scan(r, cells, kThesisSpheres);
  run(r, "gather_spheres", cells, step, {cells_.range(), states_.range(), offsets_.range(), spheres_.range()});
  r.begin_stage("flux");
  record_flux(r, level);
  r.begin_stage("cells");
  run(r, "choose_cells", cells, step, {cells_.range(), states_.range(), fluxes_.range()});
  scan(r, cells, kThesisKept);
  run(r, "keep_cells", cells, step,
      {cells_.range(), states_.range(), offsets_.range(), kept_.range(), active_.range(), points_.range()});
  copy_counter(r, kThesisKept, kThesisParents);
  const std::uint32_t statistics = kThesisLevels + kThesisCountsPerLevel * level;
  copy_counter(r, kThesisKept, statistics + 1);
  copy_counter(r, kThesisSpheres, statistics + 2);
  if (level + 1 < levels_) copy_tests(r, level);
}

void ThesisPipeline::copy_tests(Recorder& r, std::uint32_t level) {
  const VkDeviceSize first = kThesisLevels + kThesisCountsPerLevel * level + kThesisTests;
  queries_->copy_tests(r, counters_, first * 4);
  packets_->copy_tests(r, counters_, (first + 4) * 4);
}

void ThesisPipeline::record_flux(Recorder& r, std::uint32_t level) {
  SphereCount count;
  count.counters = &counters_;
  count.counter = kThesisSpheres;
  count.arguments = &arguments_;
  count.sphere_arguments = prepare(r, {kThesisSpheres});
  count.sample_arguments = prepare(r, {kThesisSpheres, samples(level)});
  const std::uint32_t packets = packets_->shape().packets(samples(level));
  count.packets =
      slices({kThesisSpheres, packets}, cells_of(level) * packets, queries_per_slice_ / packets_->shape().slots(), 1);
  flux_->record(r, count, samples(level), spheres_.range(),
                directions_.range(directions_at_[level], VkDeviceSize{samples(level)} * 16), slots_[level].range(),
                fluxes_.range());
}

void ThesisPipeline::record_round(Recorder& r, std::uint32_t first_sample) {
  ThesisConstants step = level_constants(levels_ - 1, 0);
  step.first_sample = first_sample;
  const Items tried{kThesisActive, kRetractionsPerRound};
  run(r, "start_retractions", tried, step,
      {kept_.range(), active_.range(), flux_->samples(), flux_->nearest(), lines_.range(), queries_at_.range(),
       accepted_.range()});
  queries_->empty(r, query_count(tried, most_lines()), queries_at_.range(), empty_.range());
  run(r, "choose_retractions", tried, step, {lines_.range(), empty_.range(), states_.range()});
  scan(r, tried, kThesisRetractions);
  run(r, "keep_retractions", tried, step,
      {lines_.range(), states_.range(), offsets_.range(), narrowed_.range(), queries_at_.range()});
  record_narrowing(r, step);
  record_judgement(r, step);
  const Items active{kThesisActive};
  run(r, "choose_points", active, step,
      {kept_.range(), active_.range(), narrowed_.range(), accepted_.range(), points_.range(), states_.range()});
  scan(r, active, kThesisStillActive);
  run(r, "keep_active", active, step, {active_.range(), states_.range(), offsets_.range(), still_active_.range()});
  copy_counter(r, kThesisStillActive, kThesisActive);
  std::swap(active_, still_active_);
}

// Algorithm 1: segments are chords of a sphere whose radius is a voxel's side; halved until they are within epsilon / 2
// (judge_retractions.comp needs the other half).
void ThesisPipeline::record_narrowing(Recorder& r, const ThesisConstants& step) {
  const Items lines{kThesisRetractions};
  const QueryCount count = query_count(lines, most_lines());
  const int halvings = std::max(1, static_cast<int>(std::ceil(std::log2(4.0 / options_.epsilon))));
  for (int k = 0; k < halvings; ++k) {
    queries_->empty(r, count, queries_at_.range(), empty_.range());
    const bool last = k + 1 == halvings;
    run(r, "narrow_retractions", lines, step, {kept_.range(), narrowed_.range(), empty_.range(), queries_at_.range()},
        {last ? 1u : 0u});
  }
  queries_->closest(r, count, queries_at_.range(), nearest_.range(), hits_.range());
}

void ThesisPipeline::record_judgement(Recorder& r, const ThesisConstants& step) {
  const Items lines{kThesisRetractions};
  run(r, "judge_retractions", lines, step,
      {kept_.range(), narrowed_.range(), nearest_.range(), queries_at_.range(), sides_at_.range()});
  const QueryCount count = query_count(lines, most_lines());
  queries_->empty(r, count, queries_at_.range(), empty_.range());
  queries_->winding(r, count, sides_at_.range(), numbers_.range(), mesh_->closed ? 0.25f : 0.02f);
  run(r, "accept_retractions", lines, step,
      {narrowed_.range(), empty_.range(), sides_at_.range(), numbers_.range(), accepted_.range()});
}

void ThesisPipeline::record_result(Recorder& r) {
  const ThesisConstants step = level_constants(levels_ - 1, 0);
  const Items voxels{kThesisKept};
  run(r, "mark_found", voxels, step, {points_.range(), states_.range()});
  scan(r, voxels, kThesisFound);
  copy_tests(r, levels_ - 1);  // the finest level and the retractions in its voxels
  run(r, "keep_found", voxels, step, {points_.range(), states_.range(), offsets_.range(), found_.range()});
  r.copy(counters_, 0, counters_readback_, 0, kCounterCount * 4);
  r.barrier_to_host();
}

}  // namespace medial_vk
