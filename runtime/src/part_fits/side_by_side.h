#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "medial_vk/part_fits.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// Calls work(number, threads) for each of `numbers`, which are indices into `parts`. As many parts as there are
/// `threads` (0: one per core) are worked on at a time, each by one thread, since the work on a part has stretches for
/// one thread only. A part with more triangles than a thread's share of all of them would end long after the others: it
/// is worked on alone, by all threads, before them.
///
/// Returns the error of the part with the least number that fails, whatever the number of threads; parts with greater
/// numbers may then be left out.
Status work_side_by_side(std::span<const Part> parts, std::span<const std::size_t> numbers, unsigned threads,
                         const std::function<Status(std::size_t number, unsigned threads)>& work);

}  // namespace medial_vk
